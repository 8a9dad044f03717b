#include "tools/flaneur/gait/measure/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/base/math.h"
#include "sim/gait/curves/norms.h"
#include "tools/flaneur/gait/measure/contact.h"
#include "tools/flaneur/gait/measure/signal.h"

namespace flaneur {

namespace {

constexpr double k_degrees = 180 / std::numbers::pi;

Vec3 ahead(const Instant& now) { return at_height(heading_direction(now.heading), 0); }
Vec3 left(const Instant& now) {
    Vec2 d = heading_direction(now.heading);
    return {d.z, 0, -d.x};
}
double dot_d(Vec3 a, Vec3 b) { return static_cast<double>(dot(a, b)); }
double metres(float v) { return static_cast<double>(v); }

// Degrees that a hanging bone is swung forward from the vertical, seen from the side.
double inclination(const Instant& now, Joint top, Joint bottom) {
    Vec3 bone = place(now, bottom) - place(now, top);
    return std::atan2(dot_d(bone, ahead(now)), -metres(bone.y)) * k_degrees;
}

double pitch(const Instant& now, Side side) {
    Vec3 foot = now.feet[side].sole.ball - now.feet[side].sole.heel;
    return std::asin(std::clamp(metres(foot.y) / metres(length(foot)), -1.0, 1.0)) * k_degrees;
}

// Degrees between two bones that meet in `middle`; 0 when straight.
double bend(const Instant& now, Joint top, Joint middle, Joint bottom) {
    Vec3 a = place(now, middle) - place(now, top), b = place(now, bottom) - place(now, middle);
    return std::atan2(metres(length(cross(a, b))), dot_d(a, b)) * k_degrees;
}

// Yaw to the left of where the body heads.
double yaw(const Instant& now, Joint joint) {
    Vec3 front = rotate(now.joints[joint].rotation, Vec3{0, 0, 1});
    return std::atan2(dot_d(front, left(now)), dot_d(front, ahead(now))) * k_degrees;
}

template <class F>
Samples series(const Walk& walk, const F& value) {
    Samples s;
    s.reserve(walk.ticks.size());
    for (const Instant& now : walk.ticks) s.push_back(value(now));
    return s;
}

// The mean over strides of both sides of a value that `value(now, side)` gives, seen from that side.
template <class F>
Cycle mean_curve(const Walk& walk, const std::vector<MeasuredStride>& strides, const F& value,
                 bool centre = false) {
    Samples sides[2];
    for (Side side : {k_left, k_right})
        sides[side] = series(walk, [&](const Instant& now) { return value(now, side); });
    Cycle sum{};
    for (const MeasuredStride& s : strides) {
        Cycle one = cycle_of(sides[s.side], s.begin, s.end);
        // What a slope or stairs add from stride to stride is no part of the curve.
        double gain = one[100] - one[0];
        if (centre) {
            for (size_t p = 0; p < one.size(); ++p) one[p] -= gain * static_cast<double>(p) / 100;
            one = centred(one);
        }
        for (size_t p = 0; p < sum.size(); ++p) sum[p] += one[p] / static_cast<double>(strides.size());
    }
    return sum;
}

double mirror(Side side) { return side == k_left ? 1 : -1; }

// First event in `events` after `tick`, or -1.
double next_after(const std::vector<double>& events, double tick) {
    auto it = std::upper_bound(events.begin(), events.end(), tick);
    return it == events.end() ? -1 : *it;
}

// A share of a cycle, brought near 0: 0.98 becomes -0.02.
double near_zero(double share) {
    double s = std::fmod(share, 1.0);
    return s > 0.5 ? s - 1 : s;
}

double first_below(const Cycle& c, size_t from, double value) {
    for (size_t p = from; p < c.size(); ++p) {
        if (c[p] <= value) {
            if (p == 0) return 0;
            return static_cast<double>(p) - (value - c[p]) / std::max(c[p - 1] - c[p], 1e-9);
        }
    }
    return 100;
}

void measure_joints(const Curves& c, Quantities& q) {
    auto compare = [&](const std::string& name, const Cycle& is, const Cycle& norm) {
        q.push_back({name + ".rmse", rmse(is, norm)});
        q.push_back({name + ".rmse0", rmse(centred(is), centred(norm))});
        q.push_back({name + ".r", correlation(is, norm)});
        q.push_back({name + ".range", range(is)});
    };
    compare("thigh", c.thigh, k_reference.thigh);
    compare("knee", c.knee, k_reference.knee);
    compare("ankle", c.ankle, k_reference.ankle);
    compare("foot_pitch", c.foot_pitch, k_reference.foot_pitch);
    compare("pelvis_list", c.pelvis_list, centred(k_reference.pelvis_list));
    compare("pelvis_rotation", c.pelvis_rotation, centred(k_reference.pelvis_rotation));

    auto peak = [&](const std::string& name, Peak p) {
        q.push_back({name + ".deg", p.value});
        q.push_back({name + ".pct", p.percent});
    };
    peak("knee_swing_peak", highest(c.knee, 55, 95));
    peak("knee_loading_peak", highest(c.knee, 4, 28));
    q.push_back({"knee_contact.deg", c.knee[0]});
    q.push_back({"knee_stance_low.deg", lowest(c.knee, 25, 55).value});
    q.push_back({"thigh_contact.deg", c.thigh[0]});
    peak("thigh_back", lowest(c.thigh, 35, 70));
    peak("ankle_up", highest(c.ankle, 20, 58));
    peak("ankle_down", lowest(c.ankle, 50, 80));
    q.push_back({"foot_pitch_contact.deg", c.foot_pitch[0]});
    peak("foot_pitch_low", lowest(c.foot_pitch, 50, 85));
    // Thresholds that the norm's own foot pitch passes at 8.6 and 42.8 percent.
    double flat = first_below(c.foot_pitch, 0, 3);
    q.push_back({"foot_flat.pct", flat});
    q.push_back({"heel_off.pct", first_below(c.foot_pitch, static_cast<size_t>(flat) + 1, -5)});
}

void measure_timing(const Walk& walk, const std::vector<MeasuredStride>& all, const Curves& c,
                    Quantities& q) {
    double n = static_cast<double>(all.size());
    double seconds = 0, stance = 0, both = 0, distance = 0, length_sum = 0, width = 0, out = 0;
    for (const MeasuredStride& s : all) {
        double ticks = s.end - s.begin;
        seconds += ticks / walk.rate;
        stance += (s.toe_off - s.begin) / ticks;
        // In a run the other foot leaves before this one comes: a negative share, flight.
        auto share = [&](double from, double to) { return near_zero((to - from) / ticks + 1); };
        both += share(s.begin, s.other_toe_off) + share(s.other_contact, s.toe_off);
        auto at = [&](double percent) -> const Instant& {
            return walk.ticks[static_cast<size_t>(std::lround(s.begin + percent / 100 * ticks))];
        };
        const Instant &start = at(0), &here = at(20), &other = at(70), &end = at(100);
        Side far = s.side == k_left ? k_right : k_left;
        distance += metres(length(on_ground(end.root) - on_ground(start.root)));
        Vec3 step = place(other, k_limbs[far].foot) - place(here, k_limbs[s.side].foot);
        length_sum += dot_d(step, ahead(here));
        width += -mirror(s.side) * dot_d(step, left(here));
        Vec3 foot = here.feet[s.side].sole.ball - here.feet[s.side].sole.heel;
        out += mirror(s.side) * std::atan2(dot_d(foot, left(here)), dot_d(foot, ahead(here))) * k_degrees;
    }
    double speed = distance / seconds, step = length_sum / n, cadence = 120 * n / seconds;
    double leg = metres(leg_length(walk.body)), g = metres(k_gravity);
    q.push_back({"speed.m_s", speed});
    q.push_back({"leg.m", leg});
    q.push_back({"stride.s", seconds / n});
    q.push_back({"step_length.m", step});
    q.push_back({"step_length.ratio", step / (1.16 * leg * std::sqrt(speed / std::sqrt(g * leg)))});
    q.push_back({"cadence.spm", cadence});
    q.push_back({"walk_ratio.m_spm", step / cadence});
    q.push_back({"stance.pct", 100 * stance / n});
    q.push_back({"double_support.pct", 100 * both / n});
    q.push_back({"step_width.m", width / n});
    q.push_back({"toe_out.deg", out / n});

    q.push_back({"knee_toe_off.deg", c.knee[static_cast<size_t>(std::lround(100 * stance / n))]});

    // The toe's low point in mid-swing: lowest after the hump that follows toe-off.
    Peak hump = highest(c.toe_height, static_cast<int>(100 * stance / n), 84);
    Peak low = lowest(c.toe_height, static_cast<int>(hump.percent) + 1, 92);
    q.push_back({"toe_clearance.mm", low.value});
    q.push_back({"toe_clearance.pct", low.percent});

    double fastest = 0;
    for (size_t p = 0; p < 100; ++p) {
        double slope = (c.knee[p + 1] - c.knee[p]) * 100 / (seconds / n);
        fastest = std::max(fastest, std::fabs(slope));
    }
    q.push_back({"knee_speed.deg_s", fastest});
}

void measure_trunk(const Walk& walk, const std::vector<MeasuredStride>& all, const Curves& c, Side arm_side,
                   Quantities& q) {
    q.push_back({"pelvis_vertical.mm", range(c.pelvis_height)});
    q.push_back({"pelvis_lateral.mm", range(c.pelvis_side)});
    // Twice a cycle: both halves laid over each other.
    Cycle half;
    for (size_t p = 0; p < half.size(); ++p)
        half[p] = (c.pelvis_height[p % 100] + c.pelvis_height[(p + 50) % 100]) / 2;
    q.push_back({"pelvis_low.pct", lowest(half, -20, 24).percent});
    q.push_back({"pelvis_low.of_stance", lowest(half, -20, 24).percent / value_of(q, "stance.pct")});
    q.push_back({"pelvis_high.pct", highest(half, 10, 45).percent});
    q.push_back(
        {"trunk_pelvis.deg", phase_between(harmonic(c.pelvis_rotation, 1), harmonic(c.trunk_rotation, 1))});
    q.push_back({"trunk_rotation.deg", range(c.trunk_rotation)});
    q.push_back({"head_yaw.deg", range(c.head_rotation)});
    q.push_back({"head_pitch.deg", range(c.head_pitch)});
    q.push_back({"head_roll.deg", range(c.head_roll)});
    q.push_back({"trunk_lean.deg", mean(c.trunk_lean)});
    q.push_back({"trunk_lean.range", range(c.trunk_lean)});
    q.push_back({"trunk_list.range", range(c.trunk_list)});
    q.push_back({"upper_arm.range", range(c.upper_arm)});
    q.push_back({"elbow.range", range(c.elbow)});
    q.push_back({"elbow.mean", mean(c.elbow)});
    Wave arm = harmonic(c.upper_arm, 1), arm2 = harmonic(c.upper_arm, 2);
    q.push_back({"arm_leg.deg", phase_between(harmonic(c.thigh, 1), arm)});
    q.push_back({"arm_twice.ratio", arm2.amplitude / std::max(arm.amplitude, 1e-9)});

    auto begin = static_cast<size_t>(all.front().begin), end = static_cast<size_t>(all.back().end);
    auto jerk = [&](const char* name, Joint joint) {
        std::vector<Vec3> path;
        for (const Instant& now : walk.ticks) path.push_back(place(now, joint));
        q.push_back({name, mean_jerk(path, walk.rate, begin, end)});
    };
    jerk("jerk_pelvis.m_s3", hips);
    jerk("jerk_head.m_s3", head);
    jerk("jerk_wrist.m_s3", k_limbs[arm_side].hand);
    jerk("jerk_ankle.m_s3", left_foot);
    q.push_back({"jerk_head.ratio", value_of(q, "jerk_head.m_s3") / value_of(q, "jerk_pelvis.m_s3")});

    // After the 10 Hz low-pass, like the jerk.
    Samples height = series(walk, [](const Instant& now) { return metres(place(now, hips).y); });
    Samples smooth = low_pass(height, walk.rate, 10);
    double up = 0, down = 0, jolt = 0;
    for (size_t t = begin + 1; t + 1 < end; ++t) {
        auto acceleration = [&](const Samples& y) {
            return (y[t + 1] - 2 * y[t] + y[t - 1]) * walk.rate * walk.rate;
        };
        up = std::max(up, acceleration(smooth)), down = std::min(down, acceleration(smooth));
        jolt = std::max(jolt, std::fabs(acceleration(height)));
    }
    q.push_back({"pelvis_up.m_s2", up});
    q.push_back({"pelvis_down.m_s2", down});
    // As it is, tick by tick: a knock that one frame shows.
    q.push_back({"pelvis_jolt.m_s2", jolt});
}

}  // namespace

void append(Quantities& to, const Quantities& more) { to.insert(to.end(), more.begin(), more.end()); }

double value_of(const Quantities& quantities, std::string_view name) {
    auto it =
        std::find_if(quantities.begin(), quantities.end(), [&](const Quantity& q) { return q.name == name; });
    return it == quantities.end() ? std::numeric_limits<double>::quiet_NaN() : it->value;
}

std::vector<MeasuredStride> strides(const Walk& walk, size_t first, size_t last) {
    std::vector<double> contacts[2], toe_offs[2];
    for (Side side : {k_left, k_right}) {
        for (size_t t = 1; t < walk.ticks.size(); ++t) {
            bool was = walk.ticks[t - 1].feet[side].swinging, is = walk.ticks[t].feet[side].swinging;
            if (was && !is) contacts[side].push_back(static_cast<double>(t) - 0.5);
            if (!was && is) toe_offs[side].push_back(static_cast<double>(t) - 0.5);
        }
    }
    std::vector<MeasuredStride> found;
    for (Side side : {k_left, k_right}) {
        Side other = side == k_left ? k_right : k_left;
        for (size_t i = 0; i + 1 < contacts[side].size(); ++i) {
            MeasuredStride s{side, contacts[side][i], 0, contacts[side][i + 1], 0, 0};
            if (s.begin < static_cast<double>(first) || s.end > static_cast<double>(last)) continue;
            s.toe_off = next_after(toe_offs[side], s.begin);
            s.other_contact = next_after(contacts[other], s.begin);
            s.other_toe_off = next_after(toe_offs[other], s.begin);
            bool whole = s.other_contact > 0 && s.other_contact <= s.end && s.other_toe_off > 0 &&
                         s.other_toe_off <= s.end;
            if (whole) found.push_back(s);
        }
    }
    std::sort(found.begin(), found.end(),
              [](const MeasuredStride& a, const MeasuredStride& b) { return a.begin < b.begin; });
    return found;
}

Curves curves_of(const Walk& walk, const std::vector<MeasuredStride>& all) {
    auto of = [&](auto value, bool centre = false) { return mean_curve(walk, all, value, centre); };
    auto shank = [](const Instant& now, Side s) {
        return inclination(now, k_limbs[s].lower_leg, k_limbs[s].foot);
    };
    Curves c;
    c.thigh = of([](const Instant& now, Side s) {
        return inclination(now, k_limbs[s].upper_leg, k_limbs[s].lower_leg);
    });
    c.knee = of([&](const Instant& now, Side s) {
        return inclination(now, k_limbs[s].upper_leg, k_limbs[s].lower_leg) - shank(now, s);
    });
    c.ankle = of([&](const Instant& now, Side s) { return pitch(now, s) - shank(now, s); });
    c.foot_pitch = of([](const Instant& now, Side s) { return pitch(now, s); });
    c.pelvis_list = of(
        [](const Instant& now, Side s) {
            Vec3 across = rotate(now.joints[hips].rotation, Vec3{1, 0, 0});
            return mirror(s) * std::asin(std::clamp(metres(across.y), -1.0, 1.0)) * k_degrees;
        },
        true);
    // A pelvis that yaws to the left has its right side forward.
    auto turned = [](Joint joint) {
        return [joint](const Instant& now, Side s) { return -mirror(s) * yaw(now, joint); };
    };
    c.pelvis_rotation = of(turned(hips), true);
    c.trunk_rotation = of(turned(upper_chest), true);
    c.head_rotation = of(turned(head), true);
    auto upness = [](const Instant& now, Vec3 axis) {
        return std::asin(std::clamp(metres(rotate(now.joints[head].rotation, axis).y), -1.0, 1.0)) *
               k_degrees;
    };
    c.head_pitch = of([&](const Instant& now, Side) { return upness(now, {0, 0, 1}); }, true);
    c.head_roll = of([&](const Instant& now, Side s) { return mirror(s) * upness(now, {1, 0, 0}); }, true);
    // Against the line's slant in the body at rest.
    auto rest = walk.body.joints[neck] - walk.body.joints[hips];
    double slant = std::atan2(metres(rest.z), metres(rest.y)) * k_degrees;
    auto trunk = [](const Instant& now) { return place(now, neck) - place(now, hips); };
    c.trunk_lean = of([&](const Instant& now, Side) {
        Vec3 line = trunk(now);
        return std::atan2(dot_d(line, ahead(now)), metres(line.y)) * k_degrees - slant;
    });
    c.trunk_list = of(
        [&](const Instant& now, Side s) {
            Vec3 line = trunk(now);
            return mirror(s) * std::atan2(dot_d(line, left(now)), metres(line.y)) * k_degrees;
        },
        true);
    c.upper_arm = of([](const Instant& now, Side s) {
        return inclination(now, k_limbs[s].upper_arm, k_limbs[s].lower_arm);
    });
    c.elbow = of([](const Instant& now, Side s) {
        return bend(now, k_limbs[s].upper_arm, k_limbs[s].lower_arm, k_limbs[s].hand);
    });
    c.pelvis_height = of([](const Instant& now, Side) { return 1000 * metres(place(now, hips).y); }, true);
    c.pelvis_side =
        of([](const Instant& now,
              Side s) { return 1000 * mirror(s) * dot_d(place(now, hips) - now.root, left(now)); },
           true);
    c.heel_height = of([](const Instant& now, Side s) {
        return 1000 * metres(now.feet[s].sole.heel.y - now.feet[s].ground[0]);
    });
    c.toe_height = of([](const Instant& now, Side s) {
        const FootInstant& f = now.feet[s];
        return 1000 * metres(std::min(f.sole.ball.y - f.ground[1], f.sole.tip.y - f.ground[2]));
    });
    return c;
}

Level measure_level(const Walk& walk, size_t first, size_t last) {
    std::vector<MeasuredStride> all = strides(walk, first, last);
    Level level;
    if (all.size() < 2) return level;
    level.curves = curves_of(walk, all);
    // A hand that has something keeps its arm from swinging.
    bool holds[2] = {};
    for (size_t t = first; t < std::min(last, walk.ticks.size()); ++t)
        for (Side side : {k_left, k_right}) holds[side] = holds[side] || walk.ticks[t].holds[side];
    level.has_free_arm = !holds[k_left] || !holds[k_right];
    const Side arm_side = holds[k_left] && !holds[k_right] ? k_right : k_left;
    if (holds[k_left] != holds[k_right]) {
        std::vector<MeasuredStride> free = all;
        std::erase_if(free, [&](const MeasuredStride& s) { return s.side != arm_side; });
        Curves swinging = curves_of(walk, free);
        level.curves.upper_arm = swinging.upper_arm;
        level.curves.elbow = swinging.elbow;
    }
    measure_joints(level.curves, level.quantities);
    measure_timing(walk, all, level.curves, level.quantities);
    measure_trunk(walk, all, level.curves, arm_side, level.quantities);
    append(level.quantities, measure_contact(walk, all));
    return level;
}

}  // namespace flaneur
