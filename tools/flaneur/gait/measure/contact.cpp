#include "tools/flaneur/gait/measure/contact.h"

#include <algorithm>
#include <cmath>

#include "tools/flaneur/output/figures.h"

namespace flaneur {

namespace {

constexpr float k_rests = 0.002f;  // metres; nearer to the ground a point rests on it

double metres(float v) { return static_cast<double>(v); }

}  // namespace

std::optional<Stance> watch_stance(StanceWatch& watch, const FootInstant& foot) {
    if (foot.swinging) {
        bool ended = watch.standing;
        watch.standing = watch.resting[0] = watch.resting[1] = false;
        watch.slip = 0;
        return ended ? std::optional(watch.stance) : std::nullopt;
    }
    const Vec3 points[3] = {foot.sole.heel, foot.sole.ball, foot.sole.tip};
    if (!watch.standing) watch.stance = {};
    float lowest = points[0].y - foot.ground[0];
    for (int i = 0; i < 3; ++i) lowest = std::min(lowest, points[i].y - foot.ground[i]);
    Stance& stance = watch.stance;
    stance.below = std::max(stance.below, -lowest);
    stance.above = std::max(stance.above, lowest);
    float pace[2] = {0, 0}, came[2];
    bool rests[2];
    for (int i = 0; i < 2; ++i) rests[i] = std::fabs(points[i].y - foot.ground[i]) <= k_rests;
    for (int i = 0; i < 2; ++i) {
        if (watch.standing) pace[i] = length(points[i] - watch.last[i]);
        watch.last[i] = points[i];
        bool left_alone = watch.resting[1 - i] && !rests[1 - i];
        if (rests[i] && (!watch.resting[i] || left_alone)) watch.anchor[i] = points[i];
        came[i] = length(on_ground(points[i]) - on_ground(watch.anchor[i]));
    }
    for (int i = 0; i < 2; ++i) watch.resting[i] = rests[i];
    if (rests[0] || rests[1]) {
        float drift = rests[0] && rests[1] ? std::min(came[0], came[1]) : came[rests[0] ? 0 : 1];
        stance.drift = std::max(stance.drift, drift);
    }
    watch.slip = std::min(pace[0], pace[1]);
    watch.standing = true;
    return std::nullopt;
}

Quantities measure_contact(const Walk& walk, const std::vector<MeasuredStride>& strides) {
    double ankle = 0, toe = 0, skate = 0, skated = 0, swing_below = 0, hangs = 0;
    Stance worst;
    std::vector<double> slips{0};
    for (const MeasuredStride& s : strides) {
        auto at = [&](double percent) {
            return static_cast<size_t>(std::ceil(s.begin + (s.end - s.begin) * percent / 100));
        };
        const Instant& start = walk.ticks[at(15)];
        Joint foot = k_limbs[s.side].foot;
        for (size_t t = at(15); t <= at(45) && static_cast<double>(t) < s.toe_off; ++t) {
            const Instant &now = walk.ticks[t], &before = walk.ticks[t - 1];
            if (t <= at(30)) ankle = std::max(ankle, metres(length(place(now, foot) - place(start, foot))));
            const FootInstant& f = now.feet[s.side];
            toe = std::max(toe, metres(length(f.sole.ball - start.feet[s.side].sole.ball)));
            hangs = std::max(hangs, metres(f.sole.ball.y - f.ground[1]));
            // Displacement in a frame of 1/30 s, weighted by 2 - 2^(height / 25 mm).
            double height = std::clamp(metres(f.sole.ball.y - f.ground[1]) / 0.025, 0.0, 1.0);
            Vec2 moved = on_ground(f.sole.ball) - on_ground(before.feet[s.side].sole.ball);
            skate += metres(length(moved)) * walk.rate / 30 * (2 - std::exp2(height));
            ++skated;
        }
        StanceWatch watch;
        for (size_t t = at(0); t < at(100); ++t) {
            const FootInstant& f = walk.ticks[t].feet[s.side];
            watch_stance(watch, f);
            if (!f.swinging) slips.push_back(metres(watch.slip) * walk.rate);
            if (!f.swinging) continue;
            const Vec3 points[3] = {f.sole.heel, f.sole.ball, f.sole.tip};
            for (int i = 0; i < 3; ++i)
                swing_below = std::max(swing_below, metres(f.ground[i] - points[i].y));
        }
        worst.drift = std::max(worst.drift, watch.stance.drift);
        worst.below = std::max(worst.below, watch.stance.below);
        worst.above = std::max(worst.above, watch.stance.above);
    }
    return {{"planted_ankle_drift.mm", 1000 * ankle},
            {"planted_toe_drift.mm", 1000 * toe},
            {"stance_drift.mm", 1000 * metres(worst.drift)},
            {"slip_speed_p99.m_s", quantile(slips, 0.99)},
            {"skate_zhang.mm", skated > 0 ? 1000 * skate / skated : 0},
            {"penetration.mm", 1000 * metres(worst.below)},
            {"float.mm", 1000 * metres(worst.above)},
            {"ball_over_ground.mm", 1000 * hangs},
            {"swing_penetration.mm", 1000 * swing_below}};
}

}  // namespace flaneur
