#include "sim/fall/segments.h"

#include <algorithm>

namespace flaneur {

namespace {

// Of one side's segments; those of the trunk once.
struct Share {
    float mass;             // of the whole body's
    float middle;           // of the way from the joint to the end, at which the mass lies
    float length, breadth;  // shares of height, of those whose end is no joint; of all
};
constexpr Share k_shares[k_segment_count] = {
    {0.1117f, 0.5f, 0.12f, 0.080f},   // pelvis
    {0.1633f, 0.5f, 0.09f, 0.072f},   // belly
    {0.1596f, 0.5f, 0.175f, 0.085f},  // thorax
    {0.0694f, 0.5f, 0.15f, 0.055f},   // skull
    {0.0271f, 0.577f, 0, 0.027f},     // upper arm
    {0.0162f, 0.457f, 0, 0.024f},     // forearm
    {0.0061f, 0.0f, 0.09f, 0.024f},   // palm
    {0.0271f, 0.577f, 0, 0.027f},    {0.0162f, 0.457f, 0, 0.024f}, {0.0061f, 0.0f, 0.09f, 0.024f},
    {0.1416f, 0.41f, 0, 0.045f},     // thigh
    {0.0433f, 0.446f, 0, 0.030f},    // shank
    {0.0137f, 0.0f, 0.14f, 0.024f},  // sole
    {0.1416f, 0.41f, 0, 0.045f},     {0.0433f, 0.446f, 0, 0.030f}, {0.0137f, 0.0f, 0.14f, 0.024f},
};
constexpr float k_per_height = 23;         // kg/m2: the body mass index of a population that is well
constexpr float k_least_inertia = 0.004f;  // of one of 1.7 m: what is lighter would have to be reckoned in
                                           // shorter ticks, and nobody sees it

bool is_sole(int segment) { return segment == left_sole || segment == right_sole; }
bool is_palm(int segment) { return segment == left_palm || segment == right_palm; }

}  // namespace

float mass_of(const PersonBlock& person, size_t lane) {
    return k_per_height * person.height[lane] * person.height[lane];
}

Segments segments_of(const PersonBlock& person, int lane) {
    Segments s;
    const float height = person.height[lane];
    s.whole = mass_of(person, static_cast<size_t>(lane));
    auto joint = [&](Joint j) {
        return Vec3{person.joints[j][0][lane], person.joints[j][1][lane], person.joints[j][2][lane]};
    };
    std::array<Vec3, k_segment_count> middle;
    for (int i = 0; i < k_segment_count; ++i) {
        const SegmentShape& shape = k_segments[i];
        const Share& share = k_shares[i];
        const Vec3 from = joint(shape.joint), to = joint(shape.end);
        middle[i] = from + (to - from) * share.middle;
        if (i == skull) middle[i] = {from.x, 0.93f * height, from.z + 0.012f * height};
        if (is_palm(i)) middle[i] = from + Vec3{0, -0.045f * height, 0};
        if (is_sole(i)) middle[i] = from + Vec3{0, -0.45f * from.y, 0.03f * height};
        const float m = share.mass * s.whole;
        const float long_m = share.length > 0 ? share.length * height : length(to - from);
        const float r = share.breadth * height;
        const float least = k_least_inertia * height * height * height / (1.7f * 1.7f * 1.7f);
        const float across = std::max(m * (3 * r * r + long_m * long_m) / 12, least);
        const float about = std::max(m * r * r / 2, least);
        s.mass[i] = m;
        s.inertia[i] = is_sole(i) ? Vec3{across, across, about} : Vec3{across, about, across};
        s.pivot[i] = from - middle[i];
        s.socket[i] = shape.parent < 0 ? Vec3{} : from - middle[shape.parent];
    }

    const float hip = person.girth[0][lane], front = person.girth[1][lane], back = person.girth[2][lane];
    int next = 0;
    auto ball = [&](Vec3 place, float radius) {
        s.ball[next] = place - middle[k_segment_of_ball[next]];
        s.radius[next++] = radius;
    };
    const float seat = 0.9f * back;
    for (float side : {1.0f, -1.0f})
        ball(joint(hips) + Vec3{side * std::max(hip - seat, 0.02f * height), -0.01f * height, 0}, seat);
    ball(lerp(joint(spine), joint(chest), 0.6f), 0.9f * front);
    const Vec3 shoulder = joint(left_upper_arm);
    for (float side : {1.0f, -1.0f})
        ball({side * 0.6f * shoulder.x, shoulder.y - 0.03f * height, shoulder.z}, 0.056f * height);
    ball(lerp(joint(chest), joint(upper_chest), 0.5f), 0.085f * height);
    ball({0, 0.935f * height, joint(head).z + 0.01f * height}, 0.062f * height);
    struct Limbs {
        Joint elbow, wrist, thigh, knee, ankle, toes;
    };
    for (const Limbs& l :
         {Limbs{left_lower_arm, left_hand, left_upper_leg, left_lower_leg, left_foot, left_toes},
          Limbs{right_lower_arm, right_hand, right_upper_leg, right_lower_leg, right_foot, right_toes}}) {
        const Vec3 wrist = joint(l.wrist), knee = joint(l.knee), ankle = joint(l.ankle);
        ball(joint(l.elbow), 0.024f * height);
        ball(wrist, 0.018f * height);
        ball(wrist + Vec3{0, -0.06f * height, 0}, 0.016f * height);
        ball(lerp(joint(l.thigh), knee, 0.5f), 0.045f * height);
        ball(knee, 0.032f * height);
        ball(lerp(knee, ankle, 0.3f) + Vec3{0, 0, -0.005f * height}, 0.032f * height);
        const float heel = 0.02f * height, tip = 0.014f * height;
        ball({ankle.x, heel, ankle.z - person.heel[lane] + heel}, heel);
        ball({ankle.x, tip, joint(l.toes).z + person.toe[lane] - tip}, tip);
    }
    return s;
}

}  // namespace flaneur
