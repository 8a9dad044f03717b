// Bodies that sit, one by one: on the seat, feet on the ground, hands where they belong, joints within range.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/gait/gait.h"
#include "sim/pastimes/handheld.h"
#include "sim/pastimes/seated.h"
#include "sim/pose/joint_limits.h"
#include "sim/pose/pose.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr float k_heights[] = {1.16f, 1.32f, 1.5f, 1.62f, 1.75f, 1.86f, 1.98f};
constexpr Side k_sides[] = {k_left, k_right};

float beyond(DegreeSpan span, float angle) {
    return std::max({0.0f, span.low - angle / k_radians, angle / k_radians - span.high});
}
Quat against_parent(const BodyPose& pose, int joint) {
    const auto parent = static_cast<size_t>(k_joint_parents[static_cast<size_t>(joint)]);
    return conjugate(pose.rotation[parent]) * pose.rotation[static_cast<size_t>(joint)];
}

// Degrees by which a body's hips, knees, shoulders, elbows and wrists are beyond what they can.
float beyond_limits(const BodyPose& pose) {
    float worst = 0;
    for (const Side side : k_sides) {
        const int leg = side == k_left ? left_upper_leg : right_upper_leg,
                  arm = side == k_left ? left_upper_arm : right_upper_arm;
        const float mirror = side == k_left ? 1.0f : -1.0f;
        auto hanging = [&](int joint, const JointLimits& limits) {
            const Vec3 along = rotate(against_parent(pose, joint), Vec3{0, -1, 0});
            worst = std::max({worst, beyond(limits.bend, arctan2(along.z, -along.y)),
                              beyond(limits.side, mirror * (k_pi / 2 - arccos(clamp(along.x, -1, 1))))});
        };
        auto hinge = [&](int joint, const JointLimits& limits) {
            const Vec3 along = rotate(against_parent(pose, joint), Vec3{0, -1, 0});
            const float bend = arccos(clamp(-along.y, -1, 1)) * (along.z < 0 ? -1 : 1);
            worst = std::max(worst, beyond(limits.bend, bend));
        };
        hanging(leg, joint_limits::k_hip), hinge(leg + 1, joint_limits::k_knee);
        hinge(arm + 1, joint_limits::k_elbow), hanging(arm + 2, joint_limits::k_wrist);
        const Vec3 toes = rotate(against_parent(pose, leg + 2), Vec3{0, 0, 1});
        worst = std::max(worst, beyond(joint_limits::k_ankle.bend, arctan2(toes.y, toes.z)));
    }
    return worst;
}

// One who stands half a metre before a bench, on level ground.
struct Sitter {
    Ground ground = square(20);
    Gait gait;
    std::vector<PoseBlock> poses;
    Seat seat{{0, 0.46f, 0}, {0, 1}, 0.44f, 1, 0};

    explicit Sitter(float height) {
        index_ground(ground);
        const std::vector<Body> bodies{standard_body(height)};
        const uint32_t body = 0;
        const float scale = 1, heading = 0, rate = 0;
        const Vec3 place{0.02f, 0, 0.4f};
        const Vec2 still{};
        start_gait(gait, 1, bodies, &body, &scale, {&place, &still, &heading, &rate}, surroundings_of(ground),
                   3);
        poses.resize(gait.blocks.size());
        pose_blocks(gait, 0, poses.size(), poses);
    }
    Someone who() const { return {gait.people[0], 0}; }
    BodyPose standing() const { return body_pose_of(poses, 0); }
    BodyPose seated(SatAs how) const { return seated_pose(who(), seat, how, surroundings_of(ground)); }
};

std::vector<SatAs> ways() {
    std::vector<SatAs> all;
    for (const SatTrunk trunk : {SatTrunk::back, SatTrunk::upright, SatTrunk::ahead})
        for (const SatLegs legs : {SatLegs::flat, SatLegs::apart, SatLegs::stretched, SatLegs::crossed})
            for (const SatHands hands : {SatHands::thighs, SatHands::lap})
                if (trunk != SatTrunk::ahead || hands == SatHands::thighs)
                    all.push_back({trunk, legs, hands});
    return all;
}

TEST(Seated, HipsAreOnTheSeatFeetOnTheGroundAndHandsOnThighs) {
    float worst = 0, palms = 0;
    for (const float height : k_heights) {
        const Sitter one(height);
        const auto& joints = one.who().person.joints;
        for (const SatAs how : ways()) {
            const BodyPose pose = one.seated(how);
            const auto places = places_of(pose, one.who().person, 0);
            for (const Side side : k_sides) {
                const int hip = side == k_left ? left_upper_leg : right_upper_leg;
                EXPECT_NEAR(places[hip].y, one.seat.edge.y + seat_of(one.who()), 0.004f);
                EXPECT_LT(places[hip].z, one.seat.edge.z) << "over the seat";
                EXPECT_GT(places[hip + 1].z, one.seat.edge.z) << "knees before it";
                const float ankle = joints[left_foot][1][0];
                if (height > 1.45f) {
                    EXPECT_NEAR(places[hip + 2].y, ankle, 0.005f);
                } else {
                    EXPECT_GE(places[hip + 2].y, ankle - 0.001f);
                }
                const int hand = side == k_left ? left_hand : right_hand;
                const Vec3 palm = palm_of(pose, one.who(), side).place;
                // From the middle of the thigh, or in the lap between both.
                const Vec3 along = normalize_or(places[hip + 1] - places[hip], {0, 0, 1});
                const Vec3 off = palm - places[hip], away = off - along * dot(off, along);
                if (how.hands == SatHands::thighs)
                    palms = std::max(palms, std::fabs(length(away) - 0.043f * height));
                EXPECT_LT(length(places[hand] - places[hip]), 0.6f * height);
            }
            worst = std::max(worst, beyond_limits(pose));
            EXPECT_LT(beyond_limits(pose), 1.5f)
                << height << " " << int(how.trunk) << int(how.legs) << int(how.hands);
        }
    }
    std::printf("joints beyond their range by %.2f degrees, palms off thighs by %.1f mm at most\n",
                wide(worst), wide(palms * 1000));
    EXPECT_LT(palms, 0.01f);
}

TEST(Seated, TwoWhoSitSideBySideDoNotTouch) {
    // Shoulders and elbows of one stay on its part of the bench, 0.6 m.
    for (const float height : k_heights) {
        const Sitter one(height);
        for (const SatAs how : ways()) {
            const auto places = places_of(one.seated(how), one.who().person, 0);
            for (const Vec3 p : places) EXPECT_LT(std::fabs(p.x), 0.335f) << height;
        }
    }
}

// A flight down along +z from the edge of the seat, and its seat.
struct Flight {
    Ground ground;
    Seat seat;

    Flight(float rise, float tread) : seat{{0, 0, 0}, {0, 1}, tread, 1, 0, SeatOn::steps, tread} {
        for (int k = -1; k < 6; ++k) {
            const float z = tread * static_cast<float>(k);
            add_floor(ground, {-3, z}, {3, z + tread}, -rise * static_cast<float>(k + 1), Surface::steps);
        }
        index_ground(ground);
    }
    float floor(Vec3 at) const {
        const auto hit = ground_at(ground, {at.x, 0.05f, at.z}, 0, 3);
        return hit ? hit->height : 1;
    }
};

TEST(Seated, OnStepsFeetAreWholeOnTreadsAndNothingIsInStone) {
    constexpr float k_leg = 0.025f;  // heights: half as thick as a shank is
    float worst = 0, closest = 1;
    int lowest_feet = 0;
    for (const auto& [rise, tread] :
         {std::pair{0.155f, 0.34f}, {0.15f, 0.3f}, {0.17f, 0.29f}, {0.12f, 0.36f}, {0.13f, 0.45f}}) {
        const Flight flight(rise, tread);
        for (const float height : k_heights) {
            const Sitter one(height);
            for (const SatAs how : ways()) {
                if (how.trunk == SatTrunk::back) continue;  // nobody can, without a back
                const BodyPose pose =
                    seated_pose(one.who(), flight.seat, how, surroundings_of(flight.ground));
                const auto places = places_of(pose, one.who().person, 0);
                const float ankle = one.who().person.joints[left_foot][1][0];
                for (const Side side : k_sides) {
                    const int hip = side == k_left ? left_upper_leg : right_upper_leg;
                    const Vec3 foot = places[hip + 2];
                    EXPECT_NEAR(places[hip].y, seat_of(one.who()), 0.004f);
                    const float floor = flight.floor(foot);
                    EXPECT_NEAR(foot.y, floor + ankle, 0.005f) << height << ", " << rise;
                    lowest_feet += floor < -1.5f * rise;
                    // Heel and ball on the same tread.
                    const Vec2 ahead = heading_direction(foot_of(pose, one.who(), side).yaw);
                    for (const float along : {-0.035f, 0.085f}) {
                        const Vec3 at = foot + at_height(ahead * (along * height), 0);
                        EXPECT_NEAR(flight.floor(at), floor, 0.001f) << height << ", " << tread;
                    }
                    for (float t = 0.1f; t < 0.95f; t += 0.05f) {
                        const Vec3 shin = lerp(places[hip + 1], foot, t);
                        closest =
                            std::min(closest, shin.y - flight.floor(shin + Vec3{0, 0, -k_leg * height}));
                    }
                }
                worst = std::max(worst, beyond_limits(pose));
                EXPECT_LT(beyond_limits(pose), 1.5f) << height << " " << int(how.trunk) << int(how.legs)
                                                     << int(how.hands) << ", " << rise << " x " << tread;
                for (const Vec3 p : places) EXPECT_LT(std::fabs(p.x), 0.335f) << height;
            }
        }
    }
    std::printf("joints beyond their range by %.2f degrees, shins over treads by %.0f mm, %d feet two down\n",
                wide(worst), wide(closest * 1000), lowest_feet);
    EXPECT_GT(closest, -0.005f);  // the tallest of all on the shallowest treads
    EXPECT_GT(lowest_feet, 0);
}

TEST(Seated, SitsDownWithoutAJumpWithTheTrunkAheadAndFeetOnTheGround) {
    float fastest = 0, deepest = 1, most_lean = 0;
    for (const float height : k_heights) {
        const Sitter one(height);
        const BodyPose standing = one.standing();
        const FootAt stands[2] = {foot_of(standing, one.who(), k_left),
                                  foot_of(standing, one.who(), k_right)};
        for (const SatAs how : ways()) {
            const BodyPose seated = one.seated(how);
            BodyPose before = sitting_down(standing, stands, seated, one.who(), 0);
            const auto first = places_of(before, one.who().person, 0),
                       stood = places_of(standing, one.who().person, 0);
            for (int j = 0; j < k_joint_count; ++j) EXPECT_LT(length(first[j] - stood[j]), 0.004f) << j;
            for (float t = k_tick; t < k_sits_down; t += k_tick) {
                const BodyPose now = sitting_down(standing, stands, seated, one.who(), t);
                for (int j = 1; j < k_joint_count; ++j) {
                    const float same = std::fabs(dot(against_parent(before, j), against_parent(now, j)));
                    const float turns = 2 * arccos(clamp(same, -1, 1)) / k_tick;
                    fastest = std::max(fastest, turns);
                }
                EXPECT_LT(length(now.hips - before.hips), 1.1f * k_tick) << "m/s of the hips";
                const auto places = places_of(now, one.who().person, 0);
                deepest = std::min({deepest, places[left_foot].y - stood[left_foot].y,
                                    places[right_foot].y - stood[right_foot].y});
                const Vec3 up = rotate(now.rotation[upper_chest], Vec3{0, 1, 0});
                most_lean = std::max(most_lean, arctan2(up.z, up.y));
                before = now;
            }
            const BodyPose last = sitting_down(standing, stands, seated, one.who(), k_sits_down);
            const auto ends = places_of(last, one.who().person, 0),
                       sits = places_of(seated, one.who().person, 0);
            for (int j = 0; j < k_joint_count; ++j) EXPECT_LT(length(ends[j] - sits[j]), 0.004f) << j;
        }
    }
    std::printf("fastest joint %.1f rad/s, trunk %.0f degrees ahead, feet %.1f mm in the ground\n",
                wide(fastest), wide(most_lean / k_radians), wide(-deepest * 1000));
    EXPECT_LT(fastest, k_fastest_walking);
    EXPECT_GT(most_lean, 25 * k_radians);
    EXPECT_LT(most_lean, 70 * k_radians);
    EXPECT_GT(deepest, -0.004f);
}

TEST(Handheld, ThePalmIsAtTheEarAndAtTheTextBeforeTheChest) {
    for (const float height : k_heights) {
        const Sitter one(height);
        for (const float seconds : {0.0f, 2.5f, 9.0f}) {
            BodyPose pose = one.standing();
            hold_phone(pose, one.who(), PhoneUse::calls, 1, true, seconds);
            const Palm palm = palm_of(pose, one.who(), k_right);
            EXPECT_NEAR(length(palm.place - ear_of(pose, one.who(), k_right)), k_off_ear, 0.008f) << height;
            EXPECT_LT(beyond_limits(pose), 2) << height;
            pose = one.standing();
            hold_phone(pose, one.who(), PhoneUse::texts, 1, true, seconds);
            EXPECT_LT(beyond_limits(pose), 2) << height;
            const auto places = places_of(pose, one.who().person, 0);
            const Vec3 right = palm_of(pose, one.who(), k_right).place,
                       left = palm_of(pose, one.who(), k_left).place;
            EXPECT_LT(length(right - left), 0.1f * height);
            EXPECT_GT(right.z, places[upper_chest].z + 0.1f * height);
            pose = one.standing();
            hold_phone(pose, one.who(), PhoneUse::photographs, 1, true, seconds);
            EXPECT_LT(beyond_limits(pose), 2) << height;
        }
    }
}

}  // namespace
}  // namespace flaneur
