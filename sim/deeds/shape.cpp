#include "sim/deeds/shape.h"

#include "sim/gait/footing.h"

namespace flaneur {

namespace {

constexpr float k_grown = 1.75f;

float scale_of(Someone who) { return who.person.height[who.lane] / k_grown; }

}  // namespace

LegBalls leg_balls(const BodyPose& pose, Someone who, Side side) {
    const float k = scale_of(who), thick = 0.033f * k;
    const auto thigh = static_cast<size_t>(side == k_left ? left_upper_leg : right_upper_leg),
               knee = thigh + 1, ankle = thigh + 2, toes = thigh + 3;
    const auto places = places_of(pose, who.person, who.lane);
    const FootSize size = foot_size(who.person, who.lane);
    const float high = who.person.joints[left_foot][1][who.lane],
                low = who.person.joints[left_toes][1][who.lane];
    LegBalls all;
    size_t n = 0;
    auto add = [&](Vec3 at, float radius, size_t of) { all[n++] = {at, radius, static_cast<Joint>(of)}; };
    for (int m = 0; m < 5; ++m) {
        const float t = 0.25f * static_cast<float>(m);
        add(lerp(places[thigh], places[knee], 0.12f + 0.88f * t), (0.072f - 0.02f * t) * k, thigh);
        if (m > 0) add(lerp(places[knee], places[ankle], t), (0.05f - 0.015f * t) * k, knee);
    }
    const Vec3 heel = places[ankle] + rotate(pose.rotation[ankle], {0, thick - high, thick - size.heel}),
               ball = places[toes] + rotate(pose.rotation[toes], {0, thick - low, 0}),
               tip = ball + rotate(pose.rotation[toes], {0, 0, size.tip - size.ball - thick});
    for (int m = 0; m < 4; ++m) add(lerp(heel, ball, static_cast<float>(m) / 3), thick, ankle);
    add(lerp(ball, tip, 0.5f), thick, ankle), add(tip, thick, ankle);
    return all;
}

ArmBalls arm_balls(const BodyPose& pose, Someone who, Side side) {
    const float k = scale_of(who);
    const auto upper = static_cast<size_t>(side == k_left ? left_upper_arm : right_upper_arm);
    const auto places = places_of(pose, who.person, who.lane);
    ArmBalls all;
    size_t n = 0;
    for (int m = 1; m <= 3; ++m) {
        const float t = static_cast<float>(m) / 3;
        all[n++] = {lerp(places[upper], places[upper + 1], t), 0.042f * k, static_cast<Joint>(upper)};
        all[n++] = {lerp(places[upper + 1], places[upper + 2], 0.9f * t), 0.033f * k,
                    static_cast<Joint>(upper + 1)};
    }
    for (int m = 1; m <= 4; ++m)
        all[n++] = {
            places[upper + 2] + rotate(pose.rotation[upper + 2], {0, -0.045f * k * static_cast<float>(m), 0}),
            0.012f * k, static_cast<Joint>(upper + 2)};
    return all;
}

TrunkBalls trunk_balls(const BodyPose& pose, Someone who) {
    const float k = scale_of(who);
    const auto places = places_of(pose, who.person, who.lane);
    TrunkBalls all;
    size_t n = 0;
    for (size_t j = hips; j < upper_chest; ++j)
        for (int m = 0; m < 3; ++m)
            all[n++] = {lerp(places[j], places[j + 1], static_cast<float>(m) / 3), 0.095f * k,
                        static_cast<Joint>(j)};
    all[n++] = {places[upper_chest], 0.095f * k, upper_chest};
    for (const Joint j : {left_upper_arm, right_upper_arm}) all[n++] = {places[j], 0.05f * k, j};
    all[n++] = {places[neck], 0.06f * k, neck};
    all[n++] = {places[head] + rotate(pose.rotation[head], {0, 0.1f * k, 0.01f * k}), 0.09f * k, head};
    return all;
}

}  // namespace flaneur
