#include "sim/pastimes/handheld.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/fall/limbs.h"

namespace flaneur {

namespace {

constexpr Vec3 k_up{0, 1, 0};

float height_of(Someone who) { return who.person.height[who.lane]; }
Vec3 own_place(Someone who, int joint) {
    const auto& at = who.person.joints[joint];
    return {at[0][who.lane], at[1][who.lane], at[2][who.lane]};
}

// The chest's axes but upright: left, up and ahead; from between the shoulders.
struct ChestFrame {
    Vec3 origin, left, ahead;
    Vec3 way(float x, float y, float z) const { return left * x + k_up * y + ahead * z; }
};
ChestFrame chest_of(const BodyPose& pose, Someone who) {
    const Vec3 of_left = place_of(pose, who.person, who.lane, left_upper_arm),
               of_right = place_of(pose, who.person, who.lane, right_upper_arm);
    const Vec3 across = of_left - of_right;
    const Vec3 left = normalize_or({across.x, 0, across.z}, {1, 0, 0});
    return {lerp(of_left, of_right, 0.5f), left, cross(left, k_up)};
}

// At right angles to `faces`, as near to `fingers` as that allows.
Palm palm_at(Vec3 place, Vec3 faces, Vec3 fingers) {
    const Vec3 out = normalize_or(faces, k_up);
    return {place, out, normalize_or(fingers - out * dot(fingers, out), {0, 0, 1})};
}

void text(BodyPose& pose, Someone who, float share, bool both, float seconds) {
    const ChestFrame f = chest_of(pose, who);
    const float h = height_of(who);
    const float bobs = 0.003f * sin_cos(5.1f * seconds).sine;
    const Vec3 at = f.origin + f.way(both ? -0.008f : -0.05f, -0.125f, 0.185f) * h + k_up * bobs;
    const Vec3 eyes = f.origin + f.way(0, 0.085f, 0.06f) * h;
    const Vec3 faces = normalize_or(eyes - at, k_up);
    // The phone stands in the hand, which comes from below on its own side.
    reach_for(pose, who, k_right, palm_at(at - f.left * 0.018f, faces, f.way(0.42f, 0.5f, 0.75f)),
              {0.45f, -0.85f, -0.35f}, share);
    if (!both) return;
    reach_for(pose, who, k_left,
              palm_at(at + f.left * 0.04f - k_up * 0.02f - faces * 0.012f, faces, f.way(-0.42f, 0.5f, 0.75f)),
              {0.45f, -0.85f, -0.35f}, share);
}

void call_by_phone(BodyPose& pose, Someone who, float share, bool both, float seconds) {
    const ChestFrame f = chest_of(pose, who);
    const Vec3 ear = ear_of(pose, who, k_right);
    const Quat skull = pose.rotation[head];
    const Vec3 right = rotate(skull, {-1, 0, 0});
    const Vec3 faces = normalize_or(-right - rotate(skull, {0, 0, 0.22f}), -right);
    reach_for(pose, who, k_right,
              palm_at(ear + right * k_off_ear, faces, rotate(skull, {0.15f, 0.65f, -0.85f})),
              {0.5f, -0.9f, 0.5f}, share);
    if (!both) return;
    // Now and then the other hand says something too.
    constexpr float k_every = 7;
    const float turn = seconds / k_every, in = (turn - std::floor(turn)) * k_every;
    const float says = smoothstep(1.2f, 2, in) * (1 - smoothstep(3.6f, 4.6f, in));
    if (says <= 0) return;
    const SinCos beat = sin_cos(2.4f * k_pi * in);
    const Vec3 at = f.origin + f.way(0.14f, -0.2f + 0.02f * beat.sine, 0.17f) * height_of(who);
    reach_for(pose, who, k_left, palm_at(at, f.way(-0.7f, 0.7f, 0.1f), f.way(-0.2f, 0.15f, 1)),
              {0.6f, -0.8f, -0.3f}, share * says);
}

void photograph(BodyPose& pose, Someone who, float share, bool both) {
    const ChestFrame f = chest_of(pose, who);
    const float h = height_of(who);
    const Vec3 at = f.origin + f.way(0, 0.075f, 0.215f) * h;
    const Vec3 faces = f.way(0, 0.1f, -1);
    reach_for(pose, who, k_right, palm_at(at - f.left * 0.03f, faces, f.way(0.35f, 1, 0.1f)),
              {0.6f, -0.9f, 0.05f}, share);
    if (both)
        reach_for(pose, who, k_left, palm_at(at + f.left * 0.045f, faces, f.way(-0.35f, 1, 0.1f)),
                  {0.6f, -0.9f, 0.05f}, share);
}

}  // namespace

float phone_out(const Pastime& p, uint32_t tick) {
    if (p.phone == PhoneUse::none || tick >= p.phone_until) return 0;
    const float out = static_cast<float>(tick - p.phone_began) * k_tick / k_takes_out,
                in = static_cast<float>(p.phone_until - tick) * k_tick / k_takes_out;
    return bell(std::min(out, in));
}

Vec3 ear_of(const BodyPose& pose, Someone who, Side side) {
    // As heads are made: see assets/people/parts.h.
    const float h = height_of(who), out = side == k_left ? 1.0f : -1.0f;
    const Vec3 ear{out * 0.046f * h, 0.924f * h, own_place(who, head).z + 0.004f * h};
    const Vec3 joint = own_place(who, head);
    return place_of(pose, who.person, who.lane, head) +
           rotate(pose.rotation[head], {ear.x, ear.y - joint.y, ear.z - joint.z});
}

void hold_phone(BodyPose& pose, Someone who, PhoneUse use, float share, bool both, float seconds) {
    if (share <= 0) return;
    switch (use) {
        case PhoneUse::none:
            return;
        case PhoneUse::texts:
            return text(pose, who, share, both, seconds);
        case PhoneUse::calls:
            return call_by_phone(pose, who, share, both, seconds);
        case PhoneUse::photographs:
            return photograph(pose, who, share, both);
    }
}

JointPose phone_in_hand(const JointPose& wrist, Someone who) {
    const Vec3 faces = rotate(wrist.rotation, {1, 0, 0}), fingers = rotate(wrist.rotation, {0, -1, 0});
    const float thick = 0.021f * height_of(who) / 1.75f + 0.5f * k_phone.z;
    const Vec3 at = wrist.position + faces * thick + fingers * (0.46f * forearm_of(who));
    // The turn that takes y along the fingers and z to where the palm faces.
    return {at, normalize(wrist.rotation * rotation_y(-0.5f * k_pi) * rotation_x(k_pi))};
}

}  // namespace flaneur
