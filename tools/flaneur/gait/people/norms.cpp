#include "tools/flaneur/gait/people/norms.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "sim/base/math.h"
#include "tools/flaneur/gait/crowd.h"
#include "tools/flaneur/gait/people/ages.h"

namespace flaneur {

namespace {

constexpr const char* k_schwartz = "trend: Schwartz 2008";
constexpr const char* k_cmu = "trend: CMU motion capture";
constexpr const char* k_hof = "scaled: Hof 1996";

enum class Moved { not_at_all, by_difference, by_ratio };

// How a bar goes on from the natural speed to others, and from the norm's leg to others.
struct Rule {
    const char* quantity;
    double leg_power = 0;  // of leg / k_norm_leg
    Moved moved = Moved::not_at_all;
    const double* paces = nullptr;  // where the means of people are, five of each
    double means[5] = {};
    const char* source = nullptr;  // besides the bar's own
    double from_pace = 0;          // slower, it is not asked
};

// Schwartz, Rozumalski & Trost, J Biomech 41, 2008: the middles of the five classes of speed.
constexpr double k_classes[] = {0.159, 0.295, 0.432, 0.568, 0.704};
// CMU motion capture: 1.01, 1.23, 1.63 m/s, and beyond along the last two.
constexpr double k_captured[] = {0.15, 0.340, 0.414, 0.549, 0.710};
// Of the norms over speed: 0.94, 1.24, 1.50 and 1.94 m/s; and of Orendurff 2004: 0.7, 1.15, 1.6 m/s.
constexpr double k_pooled[] = {0.15, 0.316, 0.417, 0.505, 0.653};
constexpr double k_orendurff[] = {0.15, 0.236, 0.387, 0.539, 0.710};

const Rule k_rules[] = {
    {"knee_swing_peak.deg", 0, Moved::by_difference, k_classes, {44.7, 55.3, 59.2, 61.0, 61.9}, k_schwartz},
    {"knee_swing_peak.pct", 0, Moved::by_difference, k_classes, {76.1, 72.6, 72.4, 72.0, 72.2}, k_schwartz},
    {"knee_loading_peak.deg", 0, Moved::by_difference, k_classes, {7.9, 12.7, 19.3, 23.8, 22.7}, k_schwartz},
    {"knee_loading_peak.pct", 0, Moved::by_difference, k_classes, {12.1, 12.3, 12.8, 12.7, 12.6}, k_schwartz},
    {"knee_contact.deg", 0, Moved::by_difference, k_classes, {4.9, 4.6, 5.6, 7.5, 8.8}, k_schwartz},
    // Of the hip less that of the pelvis' tilt.
    {"thigh_back.deg", 0, Moved::by_difference, k_classes, {-10.7, -13.8, -17.6, -21.4, -24.1}, k_schwartz},
    {"thigh_back.pct", 0, Moved::by_difference, k_classes, {56.5, 54.3, 52.7, 51.8, 50.9}, k_schwartz},
    {"ankle_up.deg", 0, Moved::by_difference, k_classes, {13.1, 13.8, 11.9, 8.9, 7.9}, k_schwartz},
    {"ankle_down.deg", 0, Moved::by_difference, k_classes, {-4.3, -13.6, -19.8, -22.1, -22.0}, k_schwartz},
    {"ankle_down.pct", 0, Moved::by_difference, k_classes, {69.8, 65.8, 63.8, 62.2, 60.7}, k_schwartz},
    {"pelvis_list.range", 0, Moved::by_difference, k_classes, {4.3, 6.0, 8.2, 11.0, 12.8}, k_schwartz},
    {"pelvis_rotation.range", 0, Moved::by_difference, k_classes, {8.6, 6.9, 8.9, 12.8, 16.0}, k_schwartz},
    {"knee_speed.deg_s", -0.5, Moved::by_ratio, k_captured, {343, 343, 420, 494, 582}, k_cmu},
    {"upper_arm.range", 0, Moved::by_ratio, k_captured, {23.1, 23.1, 23.0, 39.0, 58.1}, k_cmu},
    {"elbow.range", 0, Moved::by_ratio, k_captured, {16.7, 16.7, 25.9, 44.4, 66.5}, k_cmu},
    {"elbow.mean", 0, Moved::by_difference, k_captured, {30.5, 30.5, 29.7, 34.2, 39.6}, k_cmu},
    {"jerk_pelvis.m_s3", -0.5, Moved::by_ratio, k_captured, {92, 92, 107.5, 131, 159}, k_cmu},
    {"jerk_head.m_s3", -0.5, Moved::by_ratio, k_captured, {79, 79, 85.5, 104.5, 127}, k_cmu},
    {"jerk_wrist.m_s3", -0.5, Moved::by_ratio, k_captured, {121, 121, 103, 139, 182}, k_cmu},
    {"jerk_ankle.m_s3", -0.5, Moved::by_ratio, k_captured, {157, 157, 209, 273, 349}, k_cmu},
    {"stance.pct", 0, Moved::by_difference, k_pooled, {66.1, 62.5, 60.3, 59.1, 57.1}},
    {"double_support.pct", 0, Moved::by_difference, k_pooled, {29.1, 23.7, 20.4, 17.9, 13.7}},
    // The last: fast walks of 18 to 29 years by GAITRite, both sexes.
    {"cadence.spm", -0.5, Moved::by_ratio, k_pooled, {70, 98, 115, 132, 136}, "GAITRite norms"},
    {"pelvis_vertical.mm", 1, Moved::by_ratio, k_orendurff, {21, 27, 37.5, 48, 60}},
    // Nobody was measured beyond the last but one; motion capture shows no less there.
    {"pelvis_lateral.mm", 1, Moved::by_ratio, k_orendurff, {79, 70, 54.5, 39, 39}},
    // As people's, and beyond 1.63 m/s as the square of the speed: none falls faster than freely.
    {"pelvis_up.m_s2",
     0,
     Moved::by_ratio,
     k_captured,
     {1, 1, 1, 1, 1.63},
     "by Froude number beyond 1.63 m/s"},
    {"pelvis_down.m_s2",
     0,
     Moved::by_ratio,
     k_captured,
     {1, 1, 1, 1, 1.63},
     "by Froude number beyond 1.63 m/s"},
    {"pelvis_jolt.m_s2",
     0,
     Moved::by_ratio,
     k_captured,
     {1, 1, 1, 1, 1.63},
     "by Froude number beyond 1.63 m/s"},
    {"walk_ratio.m_spm", 1.5, Moved::not_at_all, nullptr, {}, k_hof},
    {"step_width.m", 1, Moved::not_at_all, nullptr, {}, k_hof},
    {"toe_clearance.mm", 1, Moved::not_at_all, nullptr, {}, k_hof},
    {"step_length.ratio"},
    {"toe_out.deg"},
    {"pelvis_low.pct"},
    {"pelvis_high.pct"},
    {"trunk_pelvis.deg", 0, Moved::not_at_all, nullptr, {}, nullptr, 0.37},
    {"head_yaw.deg"},
    {"head_pitch.deg"},
    {"arm_leg.deg"},
    {"trunk_lean.deg"},
    {"trunk_lean.range"},
    // Turns and stairs.
    {"turn.s", 0.5, Moved::not_at_all, nullptr, {}, k_hof},
    {"turn_peak.deg_s", -0.5, Moved::not_at_all, nullptr, {}, k_hof},
    {"turn_least_speed.m_s", 0.5, Moved::not_at_all, nullptr, {}, k_hof},
};

// Physics, which a style does not change: how the names begin.
constexpr std::string_view k_physics[] = {
    "planted_",    "stance_drift",     "slip_speed", "skate_zhang", "penetration",   "float",
    "swing_",      "ball_over_ground", "jerk_",      "pelvis_up",   "pelvis_down",   "pelvis_jolt",
    "pelvis_fall", "head_rise",        "joint_",     "odd_steps",   "stairs_a_step",
};

constexpr Bar k_body[] = {
    {"joint_speed.deg_s", 0, static_cast<double>(k_jump), 0, "faster is a jump"},
    {"joint_outside.deg", 0, 0, 0, "AAOS 1965, Kapandji"},
    {"pelvis_fall.m_s2", -k_open, static_cast<double>(k_gravity), 0, "nobody falls faster on a foot"},
};

// People's, of CMU motion capture, up to 1.63 m/s.
constexpr double k_head_rise = 0.46, k_fast_pace = 0.549;

bool starts(std::string_view text, std::string_view with) { return text.substr(0, with.size()) == with; }

double mean_at(const Rule& rule, double pace) {
    size_t i = 0;
    while (i + 2 < 5 && rule.paces[i + 1] < pace) ++i;
    double t = (pace - rule.paces[i]) / (rule.paces[i + 1] - rule.paces[i]);
    return rule.means[i] + (rule.means[i + 1] - rule.means[i]) * t;
}

double natural_pace() { return pace_of(1.3, k_norm_leg); }

const Rule* rule_of(const Bar& bar) {
    auto it = std::find_if(std::begin(k_rules), std::end(k_rules),
                           [&](const Rule& rule) { return std::string_view(rule.quantity) == bar.quantity; });
    return it == std::end(k_rules) ? nullptr : it;
}

void carry(Bar& bar, const Rule& rule, double pace, double leg) {
    double more = 0, times = std::pow(leg / k_norm_leg, rule.leg_power);
    if (rule.moved == Moved::by_difference) more = mean_at(rule, pace) - mean_at(rule, natural_pace());
    if (rule.moved == Moved::by_ratio) times *= mean_at(rule, pace) / mean_at(rule, natural_pace());
    for (double* bound : {&bar.low, &bar.high})
        if (std::fabs(*bound) < k_open) *bound = (*bound + more) * times;
    if (rule.source) bar.also = rule.source;
}

bool is_physics(const Bar& bar) {
    return std::any_of(std::begin(k_physics), std::end(k_physics),
                       [&](std::string_view name) { return starts(bar.quantity, name); });
}

double grown_mean(const char* quantity, double pace) {
    return mean_at(*rule_of({quantity, 0, 0, 0, ""}), pace);
}
constexpr GrownTrend k_grown = {[](double pace) { return grown_mean("stance.pct", pace); },
                                [](double pace) { return grown_mean("double_support.pct", pace); },
                                [](double pace) { return grown_mean("cadence.spm", pace); }};

std::vector<Bar> bars_on_level(const Who& who, double leg, double speed, bool is_usual) {
    double pace = pace_of(speed, leg);
    bool is_natural = pace > pace_of(1.2, k_norm_leg) && pace < pace_of(1.4, k_norm_leg);
    std::vector<Bar> bars;
    for (Bar bar : level_bars(1.3, k_norm_leg)) {
        std::string_view quantity = bar.quantity;
        const Rule* rule = rule_of(bar);
        bool is_asked = is_natural || is_physics(bar) || (rule && pace >= rule->from_pace);
        if (starts(quantity, "start.") || starts(quantity, "stop.")) is_asked = is_usual;
        if (!is_asked || !is_asked_of_age(who, quantity)) continue;
        if (rule) carry(bar, *rule, pace, leg);
        carry_to_age(who, bar);
        bars.push_back(bar);
    }
    for (const Bar& bar : bars_of_age(who, leg, pace, k_grown)) bars.push_back(bar);
    double rise = k_head_rise * std::max(1.0, pace / k_fast_pace) * std::sqrt(leg / k_norm_leg);
    bars.push_back({"head_rise.m_s", 0, rise, 0, "CMU motion capture", k_hof});
    return bars;
}

// Riener 2002 had grown people, none of them old, on stairs of this size.
bool is_asked_on_stairs(const Who& who, std::string_view quantity) {
    if (quantity == "speed.m_s") return !is_child(who) && !is_old(who);
    return quantity != "knee_swing_peak.deg" || who.age >= 14;
}

std::vector<Bar> bars_on_stairs(const Who& who, bool up, double leg) {
    std::vector<Bar> bars;
    for (const Bar& bar : stairs_bars(up, leg))
        if (is_asked_on_stairs(who, bar.quantity)) bars.push_back(bar);
    return bars;
}

std::vector<Bar> bars_of_turn(double leg) {
    std::vector<Bar> bars = turn_bars(180);
    for (Bar& bar : bars)
        if (const Rule* rule = rule_of(bar)) carry(bar, *rule, natural_pace(), leg);
    return bars;
}

std::vector<Bar> bars_of_trial(const Who& who, double leg, Trial trial, double speed) {
    switch (trial) {
        case Trial::level:
        case Trial::usual:
            return bars_on_level(who, leg, speed, trial == Trial::usual);
        case Trial::turn:
            return bars_of_turn(leg);
        case Trial::bends:
            return bends_bars();
        case Trial::stairs_up:
        case Trial::stairs_down:
            return bars_on_stairs(who, trial == Trial::stairs_up, leg);
        case Trial::slope_up:
            return slope_bars(k_slope);
        case Trial::slope_down:
            return slope_bars(-k_slope);
        case Trial::kerb:
            break;
    }
    return kerb_bars();
}

}  // namespace

double pace_of(double speed, double leg) { return speed / std::sqrt(static_cast<double>(k_gravity) * leg); }

std::vector<Bar> bars_of(const Who& who, double leg, Trial trial, double speed) {
    std::vector<Bar> bars = bars_of_trial(who, leg, trial, speed);
    for (const Bar& bar : k_body) bars.push_back(bar);
    if (who.style == 0) return bars;
    bars.erase(std::remove_if(bars.begin(), bars.end(), [](const Bar& bar) { return !is_physics(bar); }),
               bars.end());
    return bars;
}

}  // namespace flaneur
