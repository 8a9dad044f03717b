#include "tools/flaneur/gait/bars.h"

#include <algorithm>

namespace flaneur {

namespace {

constexpr const char* k_norms = "Winter 1991, Fukuchi 2018";

// Bars at natural speed.
constexpr Bar k_natural[] = {
    {"thigh.rmse", -k_open, 4.0, 2.5, k_norms},
    {"thigh.rmse0", -k_open, 3.0, 0, k_norms},
    {"thigh.r", 0.98, k_open, 0, k_norms},
    {"knee.rmse", -k_open, 5.0, 3.0, k_norms},
    {"knee.rmse0", -k_open, 4.0, 0, k_norms},
    {"knee.r", 0.97, k_open, 0, k_norms},
    {"ankle.rmse", -k_open, 5.0, 3.0, k_norms},
    {"ankle.rmse0", -k_open, 3.5, 0, k_norms},
    {"ankle.r", 0.90, k_open, 0, k_norms},
    {"foot_pitch.rmse", -k_open, 6.0, 0, k_norms},
    {"foot_pitch.r", 0.97, k_open, 0, k_norms},
    {"pelvis_list.rmse", -k_open, 2.0, 0, k_norms},
    {"pelvis_list.range", 8, 14, 0, k_norms},
    {"pelvis_rotation.rmse", -k_open, 2.5, 0, k_norms},
    {"pelvis_rotation.range", 7, 15, 0, k_norms},
    {"knee_swing_peak.deg", 58, 68, 0, k_norms},
    {"knee_swing_peak.pct", 70, 75, 0, k_norms},
    {"knee_loading_peak.deg", 13, 24, 0, k_norms},
    {"knee_loading_peak.pct", 10, 17, 0, k_norms},
    {"knee_contact.deg", -1, 9, 0, k_norms},
    {"thigh_back.deg", -18, -8, 0, k_norms},
    {"thigh_back.pct", 50, 56, 0, k_norms},
    {"ankle_up.deg", 8, 16, 0, k_norms},
    {"ankle_up.pct", 40, 50, 0, k_norms},
    {"ankle_down.deg", -21, -9, 0, k_norms},
    {"ankle_down.pct", 61, 67, 0, k_norms},
    {"foot_pitch_contact.deg", 14, 27, 0, k_norms},
    {"foot_flat.pct", 6, 13, 0, k_norms},
    {"heel_off.pct", 36, 48, 0, k_norms},
    {"foot_pitch_low.deg", -75, -55, 0, k_norms},
    {"foot_pitch_low.pct", 62, 69, 0, k_norms},
    {"knee_speed.deg_s", 280, 430, 0, k_norms},
    {"step_width.m", 0.06, 0.13, 0, "Hollman 2011"},
    {"toe_out.deg", 2, 12, 0, "Hollman 2011"},
    {"toe_clearance.mm", 10, 35, 0, "Winter 1991, Schulz 2011"},
    {"toe_clearance.pct", 78, 87, 0, "Winter 1991, Schulz 2011"},
    {"pelvis_low.pct", -2, 8, 0, "Orendurff 2004"},
    {"pelvis_high.pct", 25, 35, 0, "Orendurff 2004"},
    {"trunk_pelvis.deg", 120, 240, 0, "Murakami & Otaka 2017"},
    {"head_yaw.deg", 0, 6, 0, "Murakami & Otaka 2017"},
    {"head_pitch.deg", 0, 5, 0, "Murakami & Otaka 2017"},
    {"upper_arm.range", 20, 40, 0, "Murakami & Otaka 2017"},
    {"elbow.range", 12, 35, 0, "Murakami & Otaka 2017"},
    {"elbow.mean", 25, 42, 0, "Murakami & Otaka 2017"},
    {"arm_leg.deg", 150, 210, 0, "Murakami & Otaka 2017"},
    {"planted_ankle_drift.mm", 0, 2, 0, "CMU motion capture: 7"},
    {"planted_toe_drift.mm", 0, 3, 0, "CMU motion capture: 13"},
    {"slip_speed_p99.m_s", 0, 0.05, 0, ""},
    {"skate_zhang.mm", 0, 0.2, 0, "Zhang 2018; motion capture: 1.2"},
    {"penetration.mm", -k_open, 3, 0, ""},
    {"float.mm", -k_open, 5, 0, ""},
    {"jerk_pelvis.m_s3", 50, 140, 0, "CMU motion capture"},
    {"jerk_head.m_s3", 50, 140, 0, "CMU motion capture"},
    {"jerk_wrist.m_s3", 60, 205, 0, "CMU motion capture"},
    {"jerk_ankle.m_s3", 110, 300, 0, "CMU motion capture"},
};

// A bar that follows the speed: linear between the points and beyond them, with a tolerance around it.
struct SpeedBar {
    const char* quantity;
    double speeds[3], values[3];
    double tolerance;
    bool relative;
    const char* source;
};
constexpr SpeedBar k_by_speed[] = {
    {"stance.pct", {0.94, 1.24, 1.50}, {62.5, 60.3, 59.1}, 2.5, false, "Fukuchi 2018"},
    {"double_support.pct", {0.94, 1.24, 1.50}, {23.7, 20.4, 17.9}, 4, false, "Fukuchi 2018"},
    {"cadence.spm", {0.94, 1.24, 1.50}, {98, 115, 132}, 0.1, true, "Fukuchi 2018"},
    {"pelvis_vertical.mm", {0.7, 1.15, 1.6}, {27, 37.5, 48}, 0.3, true, "Orendurff 2004"},
    {"pelvis_lateral.mm", {0.7, 1.15, 1.6}, {70, 54.5, 39}, 0.4, true, "Orendurff 2004"},
};
constexpr Bar k_any_speed[] = {
    {"step_length.ratio", 0.9, 1.1, 0, "1.16 L (v / sqrt(g L))^0.5"},
    {"walk_ratio.m_spm", 0.0052, 0.0073, 0, "Murakami & Otaka 2017"},
};

Bar at_speed(const SpeedBar& b, double speed) {
    size_t i = speed < b.speeds[1] ? 0 : 1;
    double t = (speed - b.speeds[i]) / (b.speeds[i + 1] - b.speeds[i]);
    double value = b.values[i] + (b.values[i + 1] - b.values[i]) * t;
    double slack = b.relative ? b.tolerance * value : b.tolerance;
    return {b.quantity, value - slack, value + slack, 0, b.source};
}

}  // namespace

std::vector<Bar> level_bars(double speed) {
    std::vector<Bar> bars;
    bool natural = speed > 1.2 && speed < 1.4;
    if (natural) bars.assign(std::begin(k_natural), std::end(k_natural));
    bars.insert(bars.end(), std::begin(k_any_speed), std::end(k_any_speed));
    for (const SpeedBar& b : k_by_speed) bars.push_back(at_speed(b, speed));
    return bars;
}

std::vector<Verdict> judge(const Quantities& quantities, const std::vector<Bar>& bars) {
    std::vector<Verdict> verdicts;
    for (const Bar& bar : bars) {
        Verdict v{bar};
        auto it = std::find_if(quantities.begin(), quantities.end(),
                               [&](const Quantity& q) { return q.name == bar.quantity; });
        v.measured = it != quantities.end();
        if (v.measured) v.value = it->value;
        v.pass = v.measured && v.value >= bar.low && v.value <= bar.high;
        verdicts.push_back(v);
    }
    return verdicts;
}

}  // namespace flaneur
