#include "tools/flaneur/gait/measure/stance.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/gait/measure/limits.h"

namespace flaneur {

namespace {

constexpr float k_carries = 0.6f;  // of the body

float knee(const Instant& now, Side side) {
    const LimbJoints& limb = k_limbs[side];
    return angle_between(now.joints[limb.upper_leg].rotation, now.joints[limb.lower_leg].rotation);
}

// Radians that a foot points outward of the heading.
float toe_out(const Instant& now, Side side) {
    Vec2 foot = on_ground(now.feet[side].sole.ball - now.feet[side].sole.heel);
    float yaw = wrap_angle(heading_of(foot) - now.heading);
    return side == k_left ? yaw : -yaw;
}

double deviation(const std::vector<Quantities>& people, std::string_view name) {
    double n = static_cast<double>(people.size()), sum = 0, squares = 0;
    for (const Quantities& q : people) sum += value_of(q, name);
    for (const Quantities& q : people) squares += std::pow(value_of(q, name) - sum / n, 2);
    return std::sqrt(squares / n);
}

}  // namespace

Quantities measure_stance(const Walk& walk, size_t first) {
    double bent = 0, rests = 0, out = 0, apart = 0, ahead = 0, turned = 0, stood = 0, carried = 0;
    for (size_t t = first; t < walk.ticks.size(); ++t) {
        const Instant& now = walk.ticks[t];
        if (now.feet[k_left].swinging || now.feet[k_right].swinging) continue;
        Vec3 across = place(now, left_foot) - place(now, right_foot);
        Vec2 facing = heading_direction(now.heading), between = on_ground(across);
        ++stood;
        ahead += static_cast<double>(dot(between, facing));
        apart += static_cast<double>(between.x * facing.z - between.z * facing.x) /
                 static_cast<double>(walk.body.height);
        turned += static_cast<double>((toe_out(now, k_left) - toe_out(now, k_right)) / k_radians);
        if (std::max(now.load, 1 - now.load) < k_carries) continue;
        Side side = now.load > 0.5f ? k_left : k_right, other = side == k_left ? k_right : k_left;
        ++carried;
        bent = std::max(bent, static_cast<double>(knee(now, side)));
        rests += static_cast<double>(knee(now, other));
        out += static_cast<double>(toe_out(now, other) / k_radians);
    }
    stood = std::max(stood, 1.0);
    if (carried == 0) return {};
    return {{"stand_knee.deg", bent},
            {"rest_knee.deg", rests / carried},
            {"rest_toe_out.deg", out / carried},
            {"stand_ahead.mm", 1000 * ahead / stood},
            {"stand_width.of_height", apart / stood},
            {"stand_turned.deg", turned / stood}};
}

Quantities measure_stances(const std::vector<Quantities>& people) {
    double bent = 0, rests = 0, n = static_cast<double>(people.size()), least = 1, most = 0, ahead = 0;
    for (const Quantities& q : people) {
        bent = std::max(bent, value_of(q, "stand_knee.deg"));
        rests += value_of(q, "rest_knee.deg") / n;
        ahead = std::max(ahead, std::fabs(value_of(q, "stand_ahead.mm")));
        least = std::min(least, value_of(q, "stand_width.of_height"));
        most = std::max(most, value_of(q, "stand_width.of_height"));
    }
    return {{"all_stand_knee.deg", bent},
            {"all_rest_knee.deg", rests},
            {"all_ahead.mm", ahead},
            {"narrowest.of_height", least},
            {"widest.of_height", most},
            {"spread_ahead.mm", deviation(people, "stand_ahead.mm")},
            {"spread_turned.deg", deviation(people, "stand_turned.deg")},
            {"spread_toe_out.deg", deviation(people, "rest_toe_out.deg")},
            {"spread_width.of_height", deviation(people, "stand_width.of_height")}};
}

}  // namespace flaneur
