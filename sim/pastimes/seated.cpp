#include "sim/pastimes/seated.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/fall/limbs.h"
#include "sim/pose/arm.h"

namespace flaneur {

namespace {

constexpr Vec3 k_up{0, 1, 0};
constexpr float k_flesh = 0.046f;      // heights, from the hip joint to under the thigh
constexpr float k_over_edge = 0.05f;   // metres that a knee is before the edge, at least
constexpr float k_palm_over = 0.043f;  // heights, from the middle of a thigh to the palm that lies on it

Vec3 own_place(Someone who, int joint) {
    const auto& at = who.person.joints[joint];
    return {at[0][who.lane], at[1][who.lane], at[2][who.lane]};
}
float height_of(Someone who) { return who.person.height[who.lane]; }
size_t thigh_of(Side side) { return side == k_left ? left_upper_leg : right_upper_leg; }
float outward_of(Side side) { return side == k_left ? 1.0f : -1.0f; }

// The axes of one who sits there: left, up and ahead.
struct SeatFrame {
    Vec3 origin, left, ahead;
    Vec3 at(float x, float y, float z) const { return origin + left * x + k_up * y + ahead * z; }
};
SeatFrame frame_of(const Seat& seat) {
    const Vec3 ahead = at_height(seat.facing, 0);
    return {seat.edge, cross(k_up, ahead), ahead};
}

// Trunk, neck and head, bent ahead by so many radians in all, of which the pelvis has `of_pelvis`, and
// turned to the left by `turned`, of which it has nothing.
void bend_trunk(BodyPose& pose, Quat yaw, float of_pelvis, float ahead, float turned) {
    pose.rotation.fill(yaw);
    pose.rotation[hips] = normalize(yaw * rotation_x(of_pelvis));
    float bent = of_pelvis;
    for (const int j : {spine, chest, upper_chest}) {
        bent += (ahead - of_pelvis) / 3;
        yaw = normalize(yaw * rotation_y(turned / 3));
        pose.rotation[static_cast<size_t>(j)] = normalize(yaw * rotation_x(bent));
    }
    for (size_t j = left_shoulder; j <= right_hand; ++j) pose.rotation[j] = pose.rotation[upper_chest];
    pose.rotation[neck] = normalize(yaw * rotation_x(0.55f * ahead));
    pose.rotation[head] = normalize(yaw * rotation_x(0.2f * ahead));
}

// Where the hip joints are, from the edge: ahead, and up.
struct HipsAt {
    float ahead, up;
};
HipsAt hips_at(Someone who, const Seat& seat, SatTrunk trunk) {
    const float thigh = length(own_place(who, left_lower_leg) - own_place(who, left_upper_leg));
    const float back = who.person.girth[2][who.lane];
    const float slides = trunk == SatTrunk::back ? 0.05f : 0.0f;
    float ahead = -seat.depth + back + slides + 0.01f;
    if (!has_back(seat)) ahead = std::max(ahead, -0.62f * thigh);
    if (trunk != SatTrunk::back) ahead = std::max(ahead, -0.75f * thigh);
    return {std::max(ahead, k_over_edge - thigh), seat_of(who)};
}

// Legs that hang.
FootAt hanging_foot(Someone who, const SeatFrame& f, HipsAt hips_are, float aside, float yaw) {
    const float thigh = length(own_place(who, left_lower_leg) - own_place(who, left_upper_leg));
    const float shank = length(own_place(who, left_foot) - own_place(who, left_lower_leg));
    const float ahead = hips_are.ahead + 0.97f * thigh - 0.02f;
    return {f.at(aside, hips_are.up - 0.22f * thigh - 0.97f * shank, ahead), yaw, 0.35f};
}

// On the middle of a tread two below the seat, three where legs are stretched, or as far down as they are
// long.
FootAt foot_on_tread(Someone who, const Seat& seat, HipsAt hips_are, SatLegs legs, Side side,
                     const Surroundings& around) {
    constexpr float k_straightest = 0.94f, k_heel = 0.028f;  // of a leg; heights, from a foot's middle back
    const SeatFrame f = frame_of(seat);
    const float leg = length(own_place(who, left_lower_leg) - own_place(who, left_upper_leg)) +
                      length(own_place(who, left_foot) - own_place(who, left_lower_leg));
    const float ankle = own_place(who, left_foot).y, out = outward_of(side);
    const float hip_aside = out * own_place(who, left_upper_leg).x;
    const float aside = hip_aside * (legs == SatLegs::apart ? 1.3f : 1.1f);
    const float yaw = heading_of(seat.facing) + out * (legs == SatLegs::apart ? 0.2f : 0.12f);
    const Vec3 hip = f.at(hip_aside, hips_are.up, hips_are.ahead);
    for (int down = legs == SatLegs::stretched ? 3 : 2; down > 0; --down) {
        const float middle = (static_cast<float>(down) - 0.5f) * seat.tread;
        const auto ground = ground_at(around, f.at(aside, 0, middle), 0, 1.5f);
        if (!ground) continue;
        const float floor = ground->height - seat.edge.y;
        const Vec3 at = f.at(aside, floor + ankle, middle - k_heel * height_of(who));
        if (length(at - hip) < k_straightest * leg) return {at, yaw, 0};
    }
    return hanging_foot(who, f, hips_are, aside, yaw);
}

// Where a foot is of one who sits with its hips there.
FootAt foot_before(Someone who, const Seat& seat, HipsAt hips_are, SatLegs legs, Side side,
                   const Surroundings& around) {
    if (seat.tread > 0) return foot_on_tread(who, seat, hips_are, legs, side, around);
    const SeatFrame f = frame_of(seat);
    const float thigh = length(own_place(who, left_lower_leg) - own_place(who, left_upper_leg));
    const float shank = length(own_place(who, left_foot) - own_place(who, left_lower_leg));
    const float ankle = own_place(who, left_foot).y, out = outward_of(side);
    float aside = own_place(who, left_upper_leg).x * (legs == SatLegs::apart ? 1.2f : 1.05f);
    const float yaw = heading_of(seat.facing) + out * (legs == SatLegs::apart ? 0.2f : 0.12f);
    const auto ground = ground_at(around, f.at(out * aside, 0, 0.3f), 0, 1.5f);
    const float floor = ground ? ground->height - seat.edge.y : -0.45f;
    const float lowest = hips_are.up - 0.35f * thigh;  // of a knee
    const float knee = floor + ankle + shank;
    if (knee < lowest) return hanging_foot(who, f, hips_are, out * aside, yaw);
    const float drop = hips_are.up - knee;
    float ahead = hips_are.ahead + std::sqrt(std::max(thigh * thigh - drop * drop, 0.0f));
    if (legs == SatLegs::stretched) ahead += 0.5f * shank;
    // One ankle over the other: the left one is farther out.
    if (legs == SatLegs::crossed) {
        ahead += 0.35f * shank + (side == k_left ? 0.06f : -0.02f);
        aside = -0.045f;
    }
    Vec3 at = f.at(out * aside, floor + ankle, ahead);
    const float most = 0.985f * (thigh + shank);
    const Vec3 hip = f.at(out * own_place(who, left_upper_leg).x, hips_are.up, hips_are.ahead);
    if (length(at - hip) > most) at = hip + (at - hip) * (most / length(at - hip));
    return {at, yaw, 0};
}

Vec3 pole_of(const Seat& seat, SatLegs legs, Side side) {
    const SeatFrame f = frame_of(seat);
    const float out = legs == SatLegs::apart ? 0.3f : legs == SatLegs::crossed ? 0.02f : 0.1f;
    return normalize_or(f.ahead * 0.6f + k_up + f.left * (out * outward_of(side)), k_up);
}

void lay_hand(BodyPose& pose, Someone who, Side side, SatAs how) {
    const auto places = places_of(pose, who.person, who.lane);
    const size_t thigh = thigh_of(side);
    const Vec3 hip = places[thigh], knee = places[thigh + 1], along = normalize_or(knee - hip, {0, 0, 1});
    const Vec3 left = rotate(pose.rotation[hips], {1, 0, 0}), out = left * outward_of(side);
    const Vec3 over = normalize_or(cross(along, left) - along * dot(along, cross(along, left)), k_up);
    const float h = height_of(who);
    Palm palm;
    if (how.hands == SatHands::lap) {
        const Vec3 middle = lerp(places[left_upper_leg], places[right_upper_leg], 0.5f);
        const float lift = side == k_right ? 0.058f : 0.044f;
        palm.place = middle + along * (0.36f * length(knee - hip)) + over * (lift * h) + out * (0.012f * h);
        palm.fingers = normalize_or(along * 0.8f - out, along);
    } else {
        // As far out as arms are long.
        const float out_to = how.trunk == SatTrunk::back      ? 0.5f
                             : how.trunk == SatTrunk::upright ? 0.58f
                                                              : 0.66f;
        palm.place = lerp(hip, knee, out_to) + over * (k_palm_over * h);
        palm.fingers = normalize_or(along - out * 0.3f, along);
    }
    palm.faces = normalize_or(-over + palm.fingers * dot(over, palm.fingers), -k_up);
    reach_for(pose, who, side, palm, {0.4f, -0.5f, -0.8f}, 1);
}

// `s` of the way of a foot, lifted.
FootAt stepped(const FootAt& from, const FootAt& to, float s) {
    const float far = length(to.ankle - from.ankle), t = bell(s);
    const float lift = std::min(0.05f, 0.35f * far) * 4 * t * (1 - t);
    return {lerp(from.ankle, to.ankle, t) + k_up * lift, from.yaw + wrap_angle(to.yaw - from.yaw) * t,
            lerp(from.down, to.down, t)};
}

void set_foot(BodyPose& pose, Side side, const FootAt& foot) {
    const size_t j = thigh_of(side) + 2;
    pose.rotation[j] = pose.rotation[j + 1] = normalize(rotation_y(foot.yaw) * rotation_x(foot.down));
}

}  // namespace

SatAs sat_as(uint32_t posture, const Seat& seat, bool has_robe) {
    const uint32_t trunk = posture & 15, legs = posture >> 4 & 15, hands = posture >> 8 & 15;
    SatAs how;
    how.trunk = trunk < 8 && has_back(seat) ? SatTrunk::back
                : trunk < 13                ? SatTrunk::upright
                                            : SatTrunk::ahead;
    how.legs = legs < 7    ? SatLegs::flat
               : legs < 10 ? SatLegs::apart
               : legs < 13 ? SatLegs::stretched
                           : SatLegs::crossed;
    if (has_robe && how.legs == SatLegs::apart) how.legs = SatLegs::flat;
    how.hands = hands < 9 || how.trunk == SatTrunk::ahead ? SatHands::thighs : SatHands::lap;
    return how;
}

float seat_of(Someone who) { return k_flesh * height_of(who); }

FootAt foot_of(const BodyPose& pose, Someone who, Side side) {
    const size_t j = thigh_of(side) + 2;
    const Vec3 ahead = rotate(pose.rotation[j], {0, 0, 1});
    const float flat = std::sqrt(ahead.x * ahead.x + ahead.z * ahead.z);
    return {places_of(pose, who.person, who.lane)[j], heading_of({ahead.x, ahead.z}),
            arctan2(-ahead.y, flat)};
}

Vec3 knee_of(const BodyPose& pose, Someone who, Side side) {
    const size_t j = thigh_of(side);
    const auto places = places_of(pose, who.person, who.lane);
    const Vec3 line = normalize_or(places[j + 2] - places[j], {0, -1, 0});
    const Vec3 front = rotate(pose.rotation[j], {0, 0, 1});
    return normalize_or(front - line * dot(front, line), {0, 0, 1});
}

void set_leg(BodyPose& pose, Someone who, Side side, const FootAt& foot, Vec3 pole) {
    const size_t j = thigh_of(side);
    const Vec3 hip = place_of(pose, who.person, who.lane, static_cast<int>(j)), to = foot.ankle - hip;
    const float a = length(own_place(who, static_cast<int>(j) + 1) - own_place(who, static_cast<int>(j))),
                b = length(own_place(who, static_cast<int>(j) + 2) - own_place(who, static_cast<int>(j) + 1));
    const float reach = clamp(length(to), std::fabs(a - b) + 0.02f, 0.9995f * (a + b));
    const Vec3 way = normalize_or(to, {0, -1, 0});
    const Vec3 aside = normalize_or(pole - way * dot(pole, way), {0, 0, 1});
    const float along = (a * a - b * b + reach * reach) / (2 * reach);
    const Vec3 knee = way * along + aside * std::sqrt(std::max(a * a - along * along, 0.0f));
    const Vec3 upper = normalize_or(knee, {0, -1, 0}), lower = normalize_or(way * reach - knee, {0, -1, 0});
    // The knee is a hinge: both bones keep their fronts in the plane that it bends in.
    const Vec3 hinge = cross(way, aside);
    pose.rotation[j] = bone_rotation(upper, cross(hinge, upper));
    pose.rotation[j + 1] = bone_rotation(lower, cross(hinge, lower));
    set_foot(pose, side, foot);
}

void keep_knees_bent(BodyPose& pose, Someone who, const FootAt (&feet)[2], float straightest, float share) {
    const auto places = places_of(pose, who.person, who.lane);
    const float leg = length(own_place(who, left_lower_leg) - own_place(who, left_upper_leg)) +
                      length(own_place(who, left_foot) - own_place(who, left_lower_leg));
    float lower = 0;
    for (const Side side : {k_left, k_right}) {
        const Vec3 off = places[thigh_of(side)] - feet[side].ankle;
        const float most = straightest * leg, flat = off.x * off.x + off.z * off.z;
        lower = std::max(lower, off.y - std::sqrt(std::max(most * most - flat, 0.01f)));
    }
    pose.hips.y -= share * lower;
}

BodyPose seated_pose(Someone who, const Seat& seat, SatAs how, const Surroundings& around) {
    const SeatFrame f = frame_of(seat);
    const HipsAt at = hips_at(who, seat, how.trunk);
    BodyPose pose;
    // The pelvis rolls back as one sits, the more the more one leans back, or the higher knees are.
    const float rolls = seat.tread > 0 ? 0.34f : 0;
    const float pelvis = (how.trunk == SatTrunk::back      ? -0.24f
                          : how.trunk == SatTrunk::upright ? -0.1f
                                                           : 0.18f) -
                         rolls;
    const float ahead = how.trunk == SatTrunk::back ? -0.13f : how.trunk == SatTrunk::upright ? 0.02f : 0.55f;
    bend_trunk(pose, rotation_y(heading_of(seat.facing)), pelvis, ahead, how.turned);
    const Vec3 joints = lerp(own_place(who, left_upper_leg), own_place(who, right_upper_leg), 0.5f);
    pose.hips = f.at(0, at.up, at.ahead) - rotate(pose.rotation[hips], joints - own_place(who, hips));
    for (const Side side : {k_left, k_right})
        set_leg(pose, who, side, foot_before(who, seat, at, how.legs, side, around),
                pole_of(seat, how.legs, side));
    for (const Side side : {k_left, k_right}) lay_hand(pose, who, side, how);
    return pose;
}

BodyPose sitting_down(const BodyPose& standing, const FootAt (&stands)[2], const BodyPose& seated,
                      Someone who, float seconds) {
    constexpr float k_straightest = 0.975f;
    constexpr float k_step = 0.45f, k_second = 0.3f;     // seconds: of a step, and until the other begins
    constexpr float k_with_feet = 0.2f, k_most = 0.72f;  // of the way of the hips; radians
    const float rest = k_sits_down - k_hips_move;
    const float time = clamp((seconds - rest) / k_hips_move, 0, 1), u = bell(time);
    // Arms, head and back follow a little later, and are there at the end.
    BodyPose pose = mixed(standing, seated, u);
    const float steps = bell(clamp(seconds / (k_step + k_second), 0, 1));
    const float back = k_with_feet * steps + (1 - k_with_feet) * u;
    const Vec3 way = seated.hips - standing.hips;
    pose.hips = standing.hips + Vec3{way.x * back, way.y * u, way.z * back};
    const float lean = k_most * sin_cos(k_pi * bell(clamp(1.04f * time, 0, 1))).sine;
    const Vec3 axis = rotate(pose.rotation[hips], {1, 0, 0});
    pose.rotation[hips] = normalize(rotation_about(axis, 0.45f * lean) * pose.rotation[hips]);
    lean_trunk(pose, lean);
    FootAt feet[2];
    for (const Side side : {k_left, k_right}) {
        const float begins = side == k_left ? 0 : k_second;
        feet[side] =
            stepped(stands[side], foot_of(seated, who, side), clamp((seconds - begins) / k_step, 0, 1));
    }
    keep_knees_bent(pose, who, feet, k_straightest, bell(clamp(seconds / k_second, 0, 1)) * (1 - u));
    for (const Side side : {k_left, k_right}) {
        const Vec3 pole = lerp(knee_of(standing, who, side), knee_of(seated, who, side), std::max(steps, u));
        set_leg(pose, who, side, feet[side], normalize_or(pole, {0, 0, 1}));
    }
    return pose;
}

BodyPose sitting_otherwise(const BodyPose& from, const BodyPose& to, Someone who, float share) {
    BodyPose pose = mixed(from, to, bell(share));
    for (const Side side : {k_left, k_right}) {
        const float late = side == k_left ? 0 : 0.3f;
        const FootAt foot =
            stepped(foot_of(from, who, side), foot_of(to, who, side), clamp((share - late) / 0.7f, 0, 1));
        const Vec3 pole = lerp(knee_of(from, who, side), knee_of(to, who, side), bell(share));
        set_leg(pose, who, side, foot, normalize_or(pole, {0, 0, 1}));
    }
    return pose;
}

}  // namespace flaneur
