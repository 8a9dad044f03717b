// Those who step when they must, on the course that is built in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "assets/scene.h"
#include "assets/stages/course.h"
#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/fields.h"
#include "sim/state.h"
#include "sim/stepper/foothold.h"
#include "sim/stepping.h"

namespace flaneur {
namespace {

// So many of four sizes on the course.
std::unique_ptr<World> walked(uint64_t seed, uint32_t walkers, int threads = 1, bool is_flat = false) {
    static const auto city = std::make_shared<const City>(build_course(1, false));
    WorldOptions options;
    options.walkers = walkers;
    options.seed = seed;
    options.threads = threads;
    options.kinds.clear();
    for (const float height : {1.78f, 1.63f, 1.5f, 1.2f}) {
        Kind kind;
        kind.body = standard_body(height);
        kind.age = height < 1.3f ? 8 : height < 1.55f ? 75 : 35;
        options.kinds.push_back(kind);
    }
    auto world = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
    EXPECT_TRUE(world) << world.error().message;
    const Result<void> set = set_on_course(**world, make_course(is_flat));
    EXPECT_TRUE(set) << set.error().message;
    return std::move(world).value();
}

bool is_down(const Biped& b, Side side) { return b.swings != static_cast<uint32_t>(side); }

// What of a sole is lowest over the ground, and its least height; of no more than its heel, ball and toes.
float over_ground(const World& w, size_t i, Side side) {
    const Sole at = sole(w.poses, w.gait, i, side);
    float least = 1e9f;
    for (const Vec3 point : {at.heel, at.ball, at.tip})
        if (const auto hit = ground_at(w.around, point, 0.15f, 0.5f))
            least = std::min(least, point.y - hit->height);
    return least;
}

constexpr uint32_t k_walkers = 12;
constexpr int k_two_minutes = 7200;

TEST(Course, APlantedFootStaysInTheFrameOfWhatItStandsOn) {
    for (const uint64_t seed : {1u, 2u, 3u}) {
        auto w = walked(seed, k_walkers);
        const Bipeds& bipeds = w->stepping->bipeds;
        std::vector<Biped> before = bipeds.all;
        int on_movers = 0, steps = 0;
        for (int tick = 0; tick < k_two_minutes; ++tick) {
            step(*w);
            for (size_t i = 0; i < k_walkers; ++i)
                for (const Side side : {k_left, k_right}) {
                    const Foothold &was = before[i].feet[side], &is = bipeds.all[i].feet[side];
                    const bool stood = is_down(before[i], side) && is_down(bipeds.all[i], side);
                    steps += !is_down(before[i], side) && is_down(bipeds.all[i], side);
                    if (!stood) continue;
                    on_movers += is.mover != k_still_ground;
                    ASSERT_TRUE(was.place == is.place && was.yaw == is.yaw && was.mover == is.mover)
                        << i << " at " << tick << " of seed " << seed;
                    // And the gait has it where that frame is.
                    const FootPlaces& at = w->gait.blocks[0].feet[side].from;
                    const Vec3 place = in_world(w->movers, is).place;
                    ASSERT_TRUE((place == Vec3{at.x[i], at.y[i], at.z[i]}));
                }
            before = bipeds.all;
        }
        EXPECT_GT(on_movers, 20'000);
        EXPECT_GT(steps, 800);
    }
}

TEST(Course, PlantedSolesAreOnTheGround) {
    constexpr float k_near = 0.005f, k_most = 0.03f;  // metres
    int planted = 0, off = 0;
    float worst = 0;
    for (const uint64_t seed : {1u, 2u, 3u}) {
        auto w = walked(seed, k_walkers);
        for (int tick = 0; tick < k_two_minutes; ++tick) {
            step(*w);
            for (size_t i = 0; i < k_walkers; ++i)
                for (const Side side : {k_left, k_right}) {
                    if (!is_down(w->stepping->bipeds.all[i], side)) continue;
                    const float over = std::fabs(over_ground(*w, i, side));
                    ++planted;
                    off += over > k_near;
                    worst = std::max(worst, over);
                }
        }
    }
    // Soles that come down late, or cross from plank to plank.
    EXPECT_LT(static_cast<float>(off) / static_cast<float>(planted), 0.005f);
    EXPECT_LT(worst, k_most);
}

// Metres from a place to the nearest rope of a bridge, less its thickness.
float from_ropes(const Movers& movers, Vec3 place) {
    float least = 1e9f;
    for (size_t n = 0; n < movers.all.size(); ++n)
        for (const MoverSolid& solid : movers.all[n].solids) {
            if (solid.matter != Matter::rope || solid.half.x < 4 * solid.half.y) continue;
            const Vec3 own = to_own(movers.places[n], place) - solid.middle;
            const Vec3 off{own.x - clamp(own.x, -solid.half.x, solid.half.x), own.y, own.z};
            least = std::min(least, length(off) - solid.half.y);
        }
    return least;
}

TEST(Course, HandsGoAlongTheRopesOfTheBridge) {
    constexpr float k_middle =
        2.2f;  // metres along the way from the bridge's middle, where all hands are there
    int on_bridge = 0, held = 0, palms = 0;
    float worst = 0, sum = 0;
    for (const uint64_t seed : {1u, 2u}) {
        auto w = walked(seed, k_walkers);
        for (int tick = 0; tick < k_two_minutes; ++tick) {
            step(*w);
            for (size_t i = 0; i < k_walkers; ++i) {
                const Biped& b = w->stepping->bipeds.all[i];
                const bool is_there = b.body.z > 1 && std::fabs(b.body.x + 4.7f) < k_middle;
                for (const Side side : {k_left, k_right}) {
                    const float reach = w->gait.blocks[0].hands[side].reach[i];
                    on_bridge += is_there, held += is_there && reach >= 1;
                    if (reach < 1) continue;
                    // The palm: a third of a forearm from the wrist.
                    const Joint hand = side == k_left ? left_hand : right_hand,
                                lower = side == k_left ? left_lower_arm : right_lower_arm;
                    const JointPose wrist = joint_pose(w->poses, i, hand);
                    const float fore = length(wrist.position - joint_pose(w->poses, i, lower).position);
                    const float k = w->gait.people[0].height[i] / 1.75f, in = side == k_left ? -0.02f : 0.02f;
                    const Vec3 palm = wrist.position + rotate(wrist.rotation, {k * in, -0.32f * fore, 0});
                    const float off = from_ropes(w->movers, palm);
                    sum += off;
                    worst = std::max(worst, off), ++palms;
                }
            }
        }
    }
    EXPECT_GT(held, 9 * on_bridge / 10);
    EXPECT_GT(palms, 2000);
    EXPECT_LT(sum / static_cast<float>(palms), 0.01f);
    EXPECT_LT(worst, 0.045f);
}

TEST(Course, LegsAreAsLongAsTheyAreAndKneesBendForward) {
    auto w = walked(4, k_walkers);
    constexpr Joint k_legs[2][3] = {{left_upper_leg, left_lower_leg, left_foot},
                                    {right_upper_leg, right_lower_leg, right_foot}};
    for (int tick = 0; tick < k_two_minutes; ++tick) {
        step(*w);
        for (size_t i = 0; i < k_walkers; ++i)
            for (const auto& leg : k_legs) {
                const JointPose hip = joint_pose(w->poses, i, leg[0]), knee = joint_pose(w->poses, i, leg[1]),
                                ankle = joint_pose(w->poses, i, leg[2]);
                const auto& joints = w->gait.people[0].joints;
                const float thigh = joints[left_upper_leg][1][i] - joints[left_lower_leg][1][i],
                            shank = joints[left_lower_leg][1][i] - joints[left_foot][1][i];
                ASSERT_NEAR(length(knee.position - hip.position), thigh, 1e-3f) << tick;
                ASSERT_NEAR(length(ankle.position - knee.position), shank, 1e-3f) << tick;
                // Seen along the body's left, from the line between hip and ankle.
                const Vec3 left = rotate(joint_pose(w->poses, i, hips).rotation, {1, 0, 0});
                const Vec3 way = ankle.position - hip.position, bend = knee.position - hip.position;
                ASSERT_GT(dot(cross(bend, way), left), -0.01f) << i << " at " << tick;
            }
    }
}

TEST(Course, JointsDoNotJump) {
    constexpr float k_fastest = 6.5f, k_jerk = 0.2f;  // m/s; metres that one is off where it was going
    float fastest = 0, jerk = 0;
    for (const uint64_t seed : {1u, 5u}) {
        auto w = walked(seed, k_walkers);
        std::vector<Vec3> was(k_walkers * k_joint_count), before = was;
        for (int tick = 0; tick < k_two_minutes; ++tick) {
            step(*w);
            for (size_t i = 0; i < k_walkers; ++i)
                for (size_t j = 0; j < k_joint_count; ++j) {
                    const size_t n = i * k_joint_count + j;
                    const Vec3 now = joint_pose(w->poses, i, static_cast<Joint>(j)).position;
                    if (tick > 1) {
                        fastest = std::max(fastest, length(now - was[n]) / k_tick);
                        jerk = std::max(jerk, length(now - was[n] * 2 + before[n]));
                    }
                    before[n] = was[n], was[n] = now;
                }
        }
    }
    EXPECT_LT(fastest, k_fastest);
    EXPECT_LT(jerk, k_jerk);
}

TEST(Course, NobodyFallsIntoAGapOrStaysBehindInTenMinutes) {
    for (const uint64_t seed : {1u, 6u}) {
        auto w = walked(seed, k_walkers);
        const Bipeds& bipeds = w->stepping->bipeds;
        std::vector<float> start;
        for (const Biped& b : bipeds.all) start.push_back(b.along);
        for (int tick = 0; tick < 36'000; ++tick) {
            step(*w);
            for (size_t i = 0; i < k_walkers; ++i) {
                const Biped& b = bipeds.all[i];
                for (const Side side : {k_left, k_right}) {
                    if (!is_down(b, side)) continue;
                    const Vec3 at = in_world(w->movers, b.feet[side]).place;
                    const auto hit = ground_at(w->around, at, 0.03f, 0.03f);
                    ASSERT_TRUE(hit && is_walked(hit->kind)) << i << " at " << tick;
                }
                // Hips over the feet: nobody hangs in the air.
                const Vec3 hip = joint_pose(w->poses, i, hips).position;
                const float leg = w->gait.people[0].joints[left_upper_leg][1][i];
                const Vec3 left = in_world(w->movers, b.feet[0]).place,
                           right = in_world(w->movers, b.feet[1]).place;
                const float low = std::min(left.y, right.y);
                ASSERT_LT(hip.y - low, 1.4f * leg) << i << " at " << tick;
            }
        }
        const float round = bipeds.ways[0].along.back();
        for (size_t i = 0; i < k_walkers; ++i)
            EXPECT_GT(bipeds.all[i].along - start[i], 2 * round) << i << " of seed " << seed;
    }
}

TEST(Course, EachKeepsItsDistance) {
    auto w = walked(7, 20);
    const Bipeds& bipeds = w->stepping->bipeds;
    float least = 1e9f;
    for (int tick = 0; tick < k_two_minutes; ++tick) {
        step(*w);
        for (size_t i = 0; i < bipeds.all.size(); ++i)
            for (size_t k = 0; k < i; ++k)
                least = std::min(least, length(bipeds.all[i].body - bipeds.all[k].body));
    }
    EXPECT_GT(least, 0.33f);
}

TEST(Course, IsTheSameOnAnyNumberOfThreadsAndFromASavedState) {
    auto one = walked(8, 24, 1), four = walked(8, 24, 4);
    for (int tick = 0; tick < 900; ++tick) step(*one), step(*four);
    ASSERT_EQ(hash_world(*one), hash_world(*four));
    std::vector<std::byte> bytes;
    save_state(*one, bytes);
    for (int tick = 0; tick < 600; ++tick) step(*one), step(*four);
    const uint64_t end = hash_world(*one);
    EXPECT_EQ(end, hash_world(*four));
    auto other = walked(8, 24, 2);
    const Result<void> loaded = load_state(*other, bytes);
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (int tick = 0; tick < 600; ++tick) step(*other);
    EXPECT_EQ(hash_world(*other), end);
}

TEST(Course, WhoIsDrivenGoesWhereThePointerIsAndComesBack) {
    auto w = walked(9, 6);
    const Bipeds& bipeds = w->stepping->bipeds;
    drive(w->crowd, 2);
    const Vec2 free{0, -12};
    go_to(*w, at_height(free, 0));
    for (int tick = 0; tick < 3000; ++tick) step(*w);
    EXPECT_LT(length(bipeds.all[2].body - free), 0.6f);
    for (const Biped& b : bipeds.all)
        if (&b != &bipeds.all[2]) {
            EXPECT_GT(std::fabs(b.body.z), 0.5f);
        }
    let_go(w->crowd);
    go_to(*w, {});
    for (int tick = 0; tick < 3000; ++tick) step(*w);
    const WayPoint here = point_on(bipeds.ways[0], bipeds.all[2].along);
    EXPECT_LT(length(here.place - bipeds.all[2].body), 0.6f);
}

TEST(Course, HeadsTurnAsFarAsNecksDo) {
    auto w = walked(3, k_walkers);
    const Vec3 place{0, 1.2f, -11};
    look_at(*w, place);
    int seen = 0;
    for (int tick = 0; tick < 900; ++tick) {
        step(*w);
        if (tick < 120) continue;
        for (size_t i = 0; i < k_walkers; ++i) {
            const JointPose at = joint_pose(w->poses, i, head);
            const Vec3 nose = rotate(at.rotation, {0, 0, 1}),
                       to = normalize_or(place - at.position, {0, 0, 1});
            const float heading = w->stepping->bipeds.all[i].heading;
            const float yaw = wrap_angle(heading_of(on_ground(to)) - heading);
            const float turned = wrap_angle(heading_of(on_ground(nose)) - heading);
            ASSERT_LT(std::fabs(turned), 1.5f);
            if (std::fabs(yaw) > 1.0f || std::fabs(w->stepping->bipeds.all[i].turn_rate) > 0.3f) continue;
            ++seen;
            ASSERT_GT(dot(nose, to), 0.9f) << i << " at " << tick;
        }
    }
    EXPECT_GT(seen, 500);
    look_at(*w, {});
    for (int tick = 0; tick < 120; ++tick) step(*w);
    for (const Biped& b : w->stepping->bipeds.all) EXPECT_LT(length(b.gaze), 0.02f);
}

TEST(Course, FlatOnesStayInTheirPlanes) {
    auto w = walked(1, 8, 1, true);
    const Bipeds& bipeds = w->stepping->bipeds;
    std::vector<float> least(8, 1e9f), most(8, -1e9f);
    for (int tick = 0; tick < 2 * k_two_minutes; ++tick) {
        step(*w);
        for (size_t i = 0; i < 8; ++i) {
            const Biped& b = bipeds.all[i];
            least[i] = std::min(least[i], b.body.x), most[i] = std::max(most[i], b.body.x);
            for (const Side side : {k_left, k_right})
                ASSERT_NEAR(in_world(w->movers, b.feet[side]).place.z, bipeds.ways[b.way].line[0].z, 0.25f);
        }
    }
    for (size_t i = 0; i < 8; ++i) EXPECT_GT(most[i] - least[i], 30) << i;
}

// The number that is told is one that finds room, whoever they are.
TEST(Course, RefusesMoreThanFindRoomAndSaysHowManyDo) {
    static const auto city = std::make_shared<const City>(build_course(1, false));
    for (const bool is_flat : {false, true})
        for (const uint64_t seed : {1u, 2u, 3u, 4u}) {
            WorldOptions options;
            options.seed = seed;
            auto asked_for = [&](uint32_t walkers) {
                options.walkers = walkers;
                auto world = make_world(std::shared_ptr<const Ground>(city, &city->ground), options);
                EXPECT_TRUE(world);
                return set_on_course(**world, make_course(is_flat));
            };
            const Result<void> set = asked_for(150);
            ASSERT_FALSE(set);
            uint32_t fit = 0;
            ASSERT_EQ(std::sscanf(set.error().message.c_str(), "Only %u of 150 walkers find room", &fit), 1)
                << set.error().message;
            EXPECT_GE(fit, static_cast<uint32_t>(k_course_walkers)) << "flat " << is_flat;
            EXPECT_TRUE(asked_for(fit)) << fit << " of seed " << seed;
            EXPECT_TRUE(asked_for(k_course_walkers)) << seed;
        }
}

// Whoever is felled, shoved from the way or into others: in the last minute all go on.
TEST(Course, GoesOnAfterPushes) {
    struct Pushed {
        uint64_t seed;
        int tick;
        Vec2 by;
    };
    for (const auto& [seed, at, by] : {Pushed{3, 900, {0, 200}}, {4, 420, {100, 100}}, {6, 300, {-150, 0}}}) {
        auto w = walked(seed, 24, 2);
        std::vector<float> gone(24);
        for (int tick = 0; tick < 10800; ++tick) {
            if (tick == at) {
                for (const WalkerId id : w->crowd.slots.living) EXPECT_TRUE(push(*w, id, by));
            }
            const std::vector<Vec3> before = w->crowd.motion.position;
            step(*w);
            for (size_t i = 0; i < gone.size() && tick >= 7200; ++i)
                gone[i] += length(on_ground(w->crowd.motion.position[i] - before[i]));
        }
        for (size_t i = 0; i < gone.size(); ++i)
            EXPECT_GT(gone[i], 4) << "walker " << i << " of seed " << seed << " stands";
    }
}

}  // namespace
}  // namespace flaneur
