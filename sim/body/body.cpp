#include "sim/body/body.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

Body standard_body(float height) {
    Body b;
    b.height = height;
    auto& j = b.joints;
    j[hips] = {0, 0.545f, 0};
    j[spine] = {0, 0.585f, -0.005f};
    j[chest] = {0, 0.655f, -0.010f};
    j[upper_chest] = {0, 0.730f, -0.012f};
    j[neck] = {0, 0.830f, -0.010f};
    j[head] = {0, 0.885f, 0.005f};
    auto both = [&](Joint left, Joint right, Vec3 place) {
        j[left] = place;
        j[right] = {-place.x, place.y, place.z};
    };
    both(left_shoulder, right_shoulder, {0.012f, 0.808f, -0.008f});
    both(left_upper_arm, right_upper_arm, {0.108f, 0.815f, -0.010f});
    both(left_lower_arm, right_lower_arm, {0.108f, 0.629f, -0.010f});
    both(left_hand, right_hand, {0.108f, 0.483f, -0.010f});
    both(left_upper_leg, right_upper_leg, {0.052f, 0.530f, 0});
    both(left_lower_leg, right_lower_leg, {0.052f, 0.285f, 0});
    both(left_foot, right_foot, {0.052f, 0.039f, 0});
    both(left_toes, right_toes, {0.052f, 0.014f, 0.078f});
    for (Vec3& joint : j) joint = joint * height;
    b.heel = 0.033f * height;
    b.toe = 0.041f * height;
    return b;
}

Vec3 standard_cane(float height) { return Vec3{0.006f, -0.473f, -0.163f} * height; }

Girth girth_of(const Body& b) {
    if (b.girth.hip > 0) return b.girth;
    return {0.100f * b.height, 0.076f * b.height, 0.078f * b.height, 0.095f * b.height};
}

Vec3 standard_pram(const Body& body) {
    constexpr float k_cosine = 0.30f;                // of that bend
    constexpr float k_over = 0.05f, k_palm = 0.09f;  // metres that wrists are above the handle, and behind it
    constexpr float k_lean = 0.07f;                  // radians, of the trunk
    constexpr float k_nearest = 0.20f;
    Vec3 shoulder = body.joints[left_upper_arm], elbow = body.joints[left_lower_arm];
    float a = length(elbow - shoulder), b = length(body.joints[left_hand] - elbow);
    float height = std::clamp(0.6f * body.height, 0.84f, 1.20f);
    float down = shoulder.y - height - k_over, reach2 = a * a + b * b + 2 * a * b * k_cosine;
    float ahead = std::sqrt(std::max(reach2 - down * down, k_nearest * k_nearest));
    return {0, height, shoulder.z + k_lean * (shoulder.y - body.joints[hips].y) + ahead + k_palm};
}

}  // namespace flaneur
