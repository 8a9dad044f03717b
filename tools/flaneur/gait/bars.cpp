#include "tools/flaneur/gait/bars.h"

#include <algorithm>
#include <cmath>

#include "sim/body/body.h"
#include "sim/gait/curves/norms.h"

namespace flaneur {

namespace {

constexpr const char* k_mocap = "CMU motion capture";
// Pooled from Winter 1991, Fukuchi 2018, Hollman 2011, Bohannon & Andrews 2011 and CMU motion capture.
constexpr const char* k_pooled = "pooled norms";
constexpr const char* k_rigid = "feet are rigid and stand";
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
    {"toe_out.deg", 2, 12, 0, k_pooled},
    {"toe_clearance.mm", 10, 35, 0, "Winter 1991, Schulz 2011"},
    {"toe_clearance.pct", 78, 87, 0, "Winter 1991, Schulz 2011"},
    {"pelvis_low.pct", -2, 8, 0, "Orendurff 2004"},
    {"pelvis_high.pct", 25, 35, 0, "Orendurff 2004"},
    {"trunk_pelvis.deg", 120, 240, 0, k_pooled},
    {"trunk_list.range", 2.2, 6.7, 0, k_mocap},
    {"head_yaw.deg", 0, 6, 0, k_pooled},
    {"head_pitch.deg", 0, 5, 0, k_pooled},
    {"upper_arm.range", 20, 40, 0, k_pooled},
    {"elbow.range", 12, 35, 0, k_pooled},
    {"elbow.mean", 25, 42, 0, k_pooled},
    {"arm_leg.deg", 150, 210, 0, k_pooled},
    {"jerk_pelvis.m_s3", 50, 140, 0, k_mocap},
    {"jerk_head.m_s3", 50, 140, 0, k_mocap},
    {"jerk_wrist.m_s3", 60, 205, 0, k_mocap},
    {"jerk_ankle.m_s3", 110, 300, 0, k_mocap},
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
    {"stance.pct", {0.94, 1.24, 1.50}, {62.5, 60.3, 59.1}, 2.5, false, k_pooled},
    {"double_support.pct", {0.94, 1.24, 1.50}, {23.7, 20.4, 17.9}, 4, false, k_pooled},
    {"cadence.spm", {0.94, 1.24, 1.50}, {98, 115, 132}, 0.1, true, k_pooled},
    {"pelvis_vertical.mm", {0.7, 1.15, 1.6}, {27, 37.5, 48}, 0.3, true, "Orendurff 2004"},
    {"pelvis_lateral.mm", {0.7, 1.15, 1.6}, {70, 54.5, 39}, 0.4, true, "Orendurff 2004"},
};
constexpr Bar k_any_speed[] = {
    {"step_length.ratio", 0.9, 1.1, 0, "1.16 L (v / sqrt(g L))^0.5"},
    {"walk_ratio.m_spm", 0.0052, 0.0073, 0, "Murakami & Otaka 2017"},
    {"pelvis_up.m_s2", 0, 8, 0, k_mocap},
    {"pelvis_down.m_s2", -6, 0, 0, k_mocap},
    {"pelvis_jolt.m_s2", 0, 14, 0, "no knock as a heel comes down"},
    {"trunk_lean.deg", 2.2, 8, 0, k_mocap},
    {"trunk_lean.range", 1.9, 5.1, 0, k_mocap},
};

constexpr Bar k_slow[] = {{"arm_twice.ratio", 1, k_open, 0, k_pooled}};
constexpr Bar k_transients[] = {
    {"start.steps", 2, 3, 0, k_pooled},
    {"stop.steps", 1, 3, 0, k_pooled},
};
// On level ground, and wherever the whole foot finds room.
constexpr Bar k_contact[] = {
    {"planted_ankle_drift.mm", 0, 2, 0, "motion capture: 7"},
    {"planted_toe_drift.mm", 0, 3, 0, "motion capture: 13"},
    {"stance_drift.mm", 0, 3, 0, k_rigid},
    {"slip_speed_p99.m_s", 0, 0.05, 0, k_rigid},
    {"skate_zhang.mm", 0, 0.2, 0, "Zhang 2018; motion capture: 1.2"},
    {"penetration.mm", -k_open, 3, 0, k_rigid},
    {"float.mm", -k_open, 5, 0, k_rigid},
    {"swing_penetration.mm", -k_open, 3, 0, k_rigid},
};
// Where a foot rests on a part of its sole.
constexpr Bar k_rough_contact[] = {
    {"stance_drift.mm", 0, 3, 0, k_rigid},
    {"slip_speed_p99.m_s", 0, 0.05, 0, k_rigid},
    {"penetration.mm", -k_open, 5, 0, k_rigid},
    {"float.mm", -k_open, 5, 0, k_rigid},
    {"swing_penetration.mm", -k_open, 5, 0, k_rigid},
};
// Of runs, for a leg of k_run_leg metres: 43 %, 94 degrees and 155 steps a minute at 3.1 m/s are of CMU
// motion capture.
constexpr double k_run_leg = 0.94;
constexpr const char* k_runs = "CMU motion capture, Novacheck 1998, Fukuchi 2017";
constexpr SpeedBar k_run_by_speed[] = {
    {"cadence.spm", {2.2, 3.1, 5}, {152, 155, 170}, 0.097, true, k_runs},
    {"stance.pct", {2.2, 3.1, 5}, {44, 43, 29}, 5, false, k_runs},
    {"knee_swing_peak.deg", {2.2, 3.1, 5}, {80, 94, 115}, 10, false, k_runs},
};
constexpr Bar k_any_run[] = {
    {"knee_contact.deg", 10, 30, 0, "20; Novacheck 1998"},
    {"knee_loading_peak.deg", 36, 54, 0, "45; Novacheck 1998"},
    {"knee_toe_off.deg", 10, 30, 0, "15 to 25; Novacheck 1998"},
    {"pelvis_low.of_stance", 0.38, 0.62, 0, "a spring and a mass; McMahon & Cheng 1990"},
    {"flight_fall.m_s2", 8.8, 10.8, 0, "free fall"},
    {"stance_fall.m_s2", -k_open, 9.81, 0, "free fall, by the mean of three ticks"},
    {"elbow.mean", 91, 121, 0, "106 at 3.1 m/s, CMU motion capture"},
    {"trunk_lean.deg", 3, 12, 0, "5 to 8; Novacheck 1998"},
    {"double_support.pct", -k_open, 0, 0, "a run has flight"},
    {"stance_drift.mm", 0, 3, 0, k_rigid},
    {"slip_speed_p99.m_s", 0, 0.05, 0, k_rigid},
    {"penetration.mm", -k_open, 3, 0, k_rigid},
    {"float.mm", -k_open, 5, 0, k_rigid},
    {"swing_penetration.mm", -k_open, 3, 0, k_rigid},
};
// Speed goes with curvature to the power -1/3.
constexpr Bar k_bends[] = {{"bend_exponent", -0.40, -0.25, 0, "Vieilledent 2001, Hicheur 2005"}};
constexpr Bar k_half_turn[] = {
    {"turn.s", 1.6, 2.8, 0, k_mocap},
    {"turn_peak.deg_s", 110, 170, 0, k_mocap},
    {"turn_least_speed.m_s", 0.05, 0.3, 0, "0.1 to 0.2; Hase & Stein 1999, CMU motion capture"},
};
constexpr Bar k_turn[] = {{"head_lead.ms", 150, 350, 0, "Grasso 1996"}};
constexpr Bar k_stairs[] = {
    {"foot_pitch_contact.deg", -k_open, 0, 0, "forefoot first; Riener 2002"},
    {"ball_over_ground.mm", -k_open, 5, 0, "the ball of the foot carries"},
};
constexpr Bar k_stairs_by_turns[] = {
    {"speed.m_s", 0.45, 0.65, 0, "0.5 to 0.6; Riener 2002"},
    {"stairs_a_step", 0.95, 1.05, 0, "one stair a step"},
    {"odd_steps.pct", 0, 0, 0, "one stair a step"},
};
constexpr Bar k_stairs_twice[] = {
    {"stairs_a_step", 0.45, 0.55, 0, "both feet on each stair; Gesell 1940"},
    {"odd_steps.pct", 0, 0, 0, "both feet on each stair; Gesell 1940"},
};
// Of one who takes them at a run. Rhythm, knees and trunk have no source: about twice the rhythm of the walk,
// knees that bend some more.
constexpr Bar k_stairs_run[] = {
    {"speed.m_s", 1, 1.6, 0, "no source: asked for"},
    {"cadence.spm", 190, 290, 0, "no source: twice that of the walk"},
    {"stairs_a_step", 0.95, 1.05, 0, "one stair a step"},
    {"odd_steps.pct", 0, 0, 0, "one stair a step"},
    {"knee_swing_peak.deg", 85, 115, 0, "no source: 90 to 100 of a walk"},
    {"joint_speed.deg_s", -k_open, 1260, 0, "runners' legs are kept to 1250"},
    {"joint_outside.deg", -k_open, 0, 0, "AAOS 1965, Kapandji"},
    {"head_rise.m_s", -k_open, 1.6, 0, "nobody drops"},
};
constexpr Bar k_stairs_run_up[] = {{"trunk_lean.deg", 6, 25, 0, "no source: ahead"}};
constexpr Bar k_stairs_up[] = {{"knee_swing_peak.deg", 85, 105, 0, "90 to 100; Riener 2002"}};
constexpr Bar k_stairs_down[] = {{"knee_swing_peak.deg", 80, 95, 0, "85 to 90; Riener 2002"}};
// Self-chosen speed: Tobler's hiking function (1993), exp(-3.5 |s + 0.05|), 15 % either way. Knees meet an
// upward slope more bent (Leroux 2002; Lay 2006).
constexpr Bar k_slope_up[] = {{"knee_contact.against_level", 0, 20, 0, "Leroux 2002, Lay 2006"}};
constexpr Bar k_crowd[] = {
    {"drift_p99.mm", 0, 3, 0, k_rigid},
    {"penetration_p99.mm", -k_open, 5, 0, k_rigid},
    {"float_p99.mm", -k_open, 5, 0, k_rigid},
    {"joints_outside", 0, 0, 0, "AAOS 1965, Kapandji"},
    {"not_finite", 0, 0, 0, ""},
    {"bone_error.m", 0, 1e-5, 0, "bones are rigid"},
    {"joint_speed.deg_s", 0, 900, 0, "faster is a jump"},
};
constexpr Bar k_crowd_spread[] = {
    {"spread_thigh.deg", 3, 9, 0, "6; Winter 1991, Fukuchi 2018"},
    {"spread_knee.deg", 2.6, 7.8, 0, "5.2; Winter 1991, Fukuchi 2018"},
    {"spread_ankle.deg", 2, 5.9, 0, "3.9; Winter 1991, Fukuchi 2018"},
    {"spread_speed.m_s", 0.1, 0.35, 0, "0.94 to 1.43 m/s by age and sex; Bohannon & Andrews 2011"},
};
// Nothing of it has a source but that bodies are rigid and fall.
constexpr Bar k_leap[] = {
    {"flight.s", 0, 0.7, 0, "a body thrown up by 0.6 m at most"},
    {"flight_least.s", 0.2, k_open, 0, "a leap"},
    {"joint_speed.deg_s", -k_open, 1260, 0, "runners' legs are kept to 1250"},
    {"joint_outside.deg", -k_open, 0, 0, "AAOS 1965, Kapandji"},
    {"pelvis_fall.m_s2", -k_open, 20, 0, "no knock as it lands"},
    {"stance_drift.mm", 0, 10, 0, k_rigid},
    {"penetration.mm", -k_open, 5, 0, k_rigid},
    {"float.mm", -k_open, 5, 0, k_rigid},
    {"swing_penetration.mm", -k_open, 5, 0, k_rigid},
};
// From a walk to a run and back.
constexpr Bar k_change[] = {
    {"both_knees.deg", 0, 60, 0, "nobody squats on the way"},
    {"between.steps", 0, 2, 0, "one step each way; Segers 2007"},
    {"pelvis_fall.m_s2", 0, 20, 0, "twice free fall in one tick: no knock"},
    {"joint_speed.deg_s", 0, 1250, 0, "as fast as legs are let"},
    {"stance_drift.mm", 0, 3, 0, k_rigid},
    {"slip_speed_p99.m_s", 0, 0.05, 0, k_rigid},
    {"penetration.mm", -k_open, 5, 0, k_rigid},
    {"float.mm", -k_open, 5, 0, k_rigid},
    {"swing_penetration.mm", -k_open, 5, 0, k_rigid},
};
constexpr Bar k_stand[] = {
    {"joint_speed.deg_s", 0, 900, 0, "faster is a jump"},
    {"joint_outside.deg", 0, 0, 0, "AAOS 1965, Kapandji"},
    {"stand_knee.deg", 0, 8, 0, "a physiotherapist: 0 to 5, the leg that carries"},
    {"stop_knee.deg", 0, 8, 0, "the same, after a walk"},
    {"all_stand_knee.deg", 0, 8, 0, "the same, of 24 people"},
    {"all_rest_knee.deg", 8, 25, 0, "a physiotherapist: 10 to 25, the leg that rests"},
    {"all_ahead.mm", 40, 120, 0, "a physiotherapist: 0 to 120"},
    {"narrowest.of_height", 0.08, 0.12, 0, "a physiotherapist: 0.08 to 0.16"},
    {"widest.of_height", 0.12, 0.16, 0, "the same"},
    {"spread_ahead.mm", 20, 70, 0, "no source: no two alike; a crowd of clones has 0"},
    {"spread_turned.deg", 3, 15, 0, "no source: the same"},
    {"spread_toe_out.deg", 2, 8, 0, "no source: the same"},
    {"spread_width.of_height", 0.01, 0.03, 0, "no source: the same"},
};
constexpr Bar k_gaits[] = {{"run_from.m_s", 1.9, 2.3, 0, "Froude number 0.5"}};

Bar at_speed(const SpeedBar& b, double speed) {
    size_t i = speed < b.speeds[1] ? 0 : 1;
    double t = (speed - b.speeds[i]) / (b.speeds[i + 1] - b.speeds[i]);
    double value = b.values[i] + (b.values[i + 1] - b.values[i]) * t;
    double slack = b.relative ? b.tolerance * value : b.tolerance;
    return {b.quantity, value - slack, value + slack, 0, b.source};
}

template <size_t N>
void add(std::vector<Bar>& bars, const Bar (&more)[N]) {
    for (const Bar& bar : more) bars.push_back(bar);
}

}  // namespace

std::vector<Bar> level_bars(double speed, double leg) {
    std::vector<Bar> bars;
    if (speed * speed / (static_cast<double>(k_gravity) * leg) > k_run_froude) {
        double slower = std::sqrt(k_run_leg / leg);
        for (const SpeedBar& b : k_run_by_speed) bars.push_back(at_speed(b, speed * slower));
        bars[0].low *= slower, bars[0].high *= slower;  // the cadence
        bars.push_back({"pelvis_vertical.mm", 64 * leg, 117 * leg, 0, "60 to 110; Novacheck 1998"});
        add(bars, k_any_run);
        return bars;
    }
    bool natural = speed > 1.2 && speed < 1.4;
    if (natural) add(bars, k_natural);
    if (speed < 0.75) add(bars, k_slow);
    add(bars, k_any_speed);
    for (const SpeedBar& b : k_by_speed) bars.push_back(at_speed(b, speed));
    add(bars, k_contact);
    if (natural) add(bars, k_transients);
    return bars;
}

std::vector<Bar> turn_bars(double degrees) {
    std::vector<Bar> bars;
    if (std::fabs(degrees) > 170) add(bars, k_half_turn);
    add(bars, k_turn);
    add(bars, k_rough_contact);
    return bars;
}

std::vector<Bar> stairs_bars(bool up, double leg) {
    std::vector<Bar> bars;
    add(bars, k_stairs);
    if (sets_both_feet(static_cast<float>(leg))) {
        add(bars, k_stairs_twice);
    } else {
        add(bars, k_stairs_by_turns);
        if (up) {
            add(bars, k_stairs_up);
        } else {
            add(bars, k_stairs_down);
        }
    }
    add(bars, k_rough_contact);
    return bars;
}

std::vector<Bar> stairs_run_bars(bool up) {
    std::vector<Bar> bars;
    add(bars, k_stairs);
    add(bars, k_stairs_run);
    if (up) add(bars, k_stairs_run_up);
    add(bars, k_rough_contact);
    return bars;
}

std::vector<Bar> slope_bars(double percent) {
    double ratio = std::exp(-3.5 * std::fabs(percent / 100 + 0.05)) / std::exp(-3.5 * 0.05);
    std::vector<Bar> bars;
    bars.push_back({"speed.against_level", 0.85 * ratio, 1.15 * ratio, 0, "Tobler 1993"});
    if (percent > 0) add(bars, k_slope_up);
    add(bars, k_contact);
    return bars;
}

std::vector<Bar> kerb_bars() {
    std::vector<Bar> bars;
    add(bars, k_rough_contact);
    return bars;
}

std::vector<Bar> leap_bars(double width) {
    std::vector<Bar> bars{{"leapt_least.m", width, k_open, 0, "nobody gets wet"}};
    add(bars, k_leap);
    return bars;
}

std::vector<Bar> bends_bars() {
    std::vector<Bar> bars;
    add(bars, k_bends);
    return bars;
}

std::vector<Bar> stand_bars() {
    std::vector<Bar> bars;
    add(bars, k_stand);
    return bars;
}

std::vector<Bar> gaits_bars() {
    std::vector<Bar> bars;
    add(bars, k_gaits);
    return bars;
}

std::vector<Bar> change_bars() {
    std::vector<Bar> bars;
    add(bars, k_change);
    return bars;
}

std::vector<Bar> crowd_bars(size_t steady_walkers) {
    std::vector<Bar> bars;
    add(bars, k_crowd);
    if (steady_walkers >= 10) add(bars, k_crowd_spread);
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
