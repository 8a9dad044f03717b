#include "tools/flaneur/gait/people/ages.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/flaneur/gait/people/norms.h"

namespace flaneur {

namespace {

constexpr double k_leg_share = 0.53;  // of the height; Drillis & Contini 1966

struct Spread {
    double mean, deviation;
};
struct Measured {
    double speed;                   // m/s
    Spread cadence, step, width;    // steps a minute, metres
    Spread stance, double_support;  // percent
};

// Lythgo, Wilson & Galea, Gait & Posture 33, 2011: slow, free and fast; heights of the WHO growth reference.
struct ChildNorm {
    double up_to, height;
    Measured at[3];
};
constexpr ChildNorm k_children[] = {
    {6.5,
     1.095,
     {{0.950, {122.0, 13.9}, {0.477, 0.050}, {0.079, 0.016}, {58.0, 2.2}, {16.1, 3.7}},
      {1.300, {140.0, 12.9}, {0.545, 0.051}, {0.078, 0.018}, {57.6, 1.8}, {15.1, 2.9}},
      {1.700, {170.0, 14.6}, {0.607, 0.045}, {0.079, 0.022}, {56.2, 1.9}, {12.2, 3.1}}}},
    {10.5,
     1.27,
     {{1.025, {117.0, 6.4}, {0.542, 0.052}, {0.085, 0.021}, {57.9, 2.4}, {15.3, 4.1}},
      {1.350, {130.8, 11.7}, {0.631, 0.056}, {0.080, 0.022}, {57.1, 1.9}, {14.0, 3.6}},
      {1.725, {152.9, 16.9}, {0.686, 0.056}, {0.082, 0.021}, {56.3, 1.8}, {12.4, 3.4}}}},
    {18,
     1.53,
     {{1.075, {100.9, 8.2}, {0.634, 0.060}, {0.091, 0.021}, {58.9, 1.8}, {17.6, 3.5}},
      {1.350, {114.6, 7.7}, {0.726, 0.079}, {0.087, 0.019}, {58.1, 1.6}, {16.1, 3.3}},
      {1.725, {129.3, 10.8}, {0.802, 0.085}, {0.089, 0.020}, {57.1, 1.7}, {14.5, 2.9}}}},
};

// Hollman, McDade & Petersen, Gait & Posture 34, 2011: at the speed they like, men of 1.72 m and women
// of 1.58 m.
struct OldNorm {
    double up_to;
    Measured at[2];  // women, men
};
constexpr double k_old_heights[] = {1.58, 1.72};
constexpr OldNorm k_old[] = {
    {75,
     {{1.16, {113, 20}, {0.61, 0.09}, {0.070, 0.035}, {63.3, 3.1}, {27.1, 4.0}},
      {1.17, {102, 8}, {0.69, 0.08}, {0.097, 0.030}, {63.2, 2.1}, {26.3, 3.0}}}},
    {80,
     {{1.12, {114, 13}, {0.59, 0.07}, {0.077, 0.040}, {63.9, 3.0}, {28.4, 6.4}},
      {1.22, {106, 10}, {0.68, 0.07}, {0.089, 0.052}, {64.0, 2.5}, {26.5, 2.3}}}},
    {85,
     {{1.01, {110, 9}, {0.55, 0.07}, {0.079, 0.041}, {64.5, 2.6}, {29.0, 4.6}},
      {1.12, {103, 8}, {0.65, 0.08}, {0.112, 0.040}, {63.8, 2.7}, {27.4, 4.7}}}},
    {200,
     {{0.98, {108, 10}, {0.54, 0.09}, {0.091, 0.026}, {64.5, 2.5}, {28.7, 4.8}},
      {1.01, {102, 11}, {0.59, 0.10}, {0.099, 0.048}, {64.9, 2.7}, {30.3, 3.5}}}},
};

constexpr std::string_view k_own_of_age[] = {"stance.pct", "double_support.pct", "cadence.spm",
                                             "step_length.ratio", "walk_ratio.m_spm"};

template <class Norm, size_t N>
const Norm& norm_of(const Norm (&norms)[N], double age) {
    size_t i = 0;
    while (i + 1 < N && age >= norms[i].up_to) ++i;
    return norms[i];
}

Bar within(const char* quantity, Spread spread, double times, const char* source) {
    return {quantity, (spread.mean - 2 * spread.deviation) * times,
            (spread.mean + 2 * spread.deviation) * times, 0, source};
}

Spread between(Spread a, Spread b, double t) {
    return {a.mean + (b.mean - a.mean) * t,
            a.deviation + (b.deviation - a.deviation) * std::clamp(t, 0.0, 1.0)};
}

std::vector<Bar> bars_of_child(const Who& who, double leg, double pace) {
    const ChildNorm& norm = norm_of(k_children, who.age);
    double norm_leg = k_leg_share * norm.height, longer = leg / norm_leg;
    int i = pace < pace_of(norm.at[1].speed, norm_leg) ? 0 : 1;
    const Measured &a = norm.at[i], &b = norm.at[i + 1];
    double from = pace_of(a.speed, norm_leg), t = (pace - from) / (pace_of(b.speed, norm_leg) - from);
    constexpr const char* k_source = "Lythgo 2011";
    return {within("stance.pct", between(a.stance, b.stance, t), 1, k_source),
            within("double_support.pct", between(a.double_support, b.double_support, t), 1, k_source),
            within("cadence.spm", between(a.cadence, b.cadence, t), 1 / std::sqrt(longer), k_source),
            within("step_length.m", between(a.step, b.step, t), longer, k_source),
            within("step_width.m", between(a.width, b.width, t), longer, k_source)};
}

std::vector<Bar> bars_of_old(const Who& who, double leg, double pace, const GrownTrend& trend) {
    int man = who.sex == Sex::man ? 1 : 0;
    const Measured& m = norm_of(k_old, who.age).at[man];
    double norm_leg = k_leg_share * k_old_heights[man], longer = leg / norm_leg;
    double liked = pace_of(m.speed, norm_leg);
    Spread stance = m.stance, both = m.double_support;
    stance.mean += trend.stance(pace) - trend.stance(liked);
    both.mean += trend.double_support(pace) - trend.double_support(liked);
    constexpr const char* k_source = "Hollman 2011, over speed as grown people";
    return {within("stance.pct", stance, 1, k_source), within("double_support.pct", both, 1, k_source),
            within("cadence.spm", m.cadence, trend.cadence(pace) / trend.cadence(liked) / std::sqrt(longer),
                   k_source),
            within("step_length.m", m.step, std::sqrt(pace / liked) * longer, k_source)};
}

bool ends(std::string_view text, std::string_view with) {
    return text.size() >= with.size() && text.substr(text.size() - with.size()) == with;
}

}  // namespace

std::vector<Bar> bars_of_age(const Who& who, double leg, double pace, const GrownTrend& trend) {
    if (is_child(who)) return bars_of_child(who, leg, pace);
    if (is_old(who)) return bars_of_old(who, leg, pace, trend);
    return {};
}

bool is_asked_of_age(const Who& who, std::string_view quantity) {
    if (!is_child(who) && !is_old(who)) return true;
    if (std::find(std::begin(k_own_of_age), std::end(k_own_of_age), quantity) != std::end(k_own_of_age))
        return false;
    if (is_child(who)) return quantity != "step_width.m";
    bool of_the_young = ends(quantity, ".rmse") || ends(quantity, ".rmse0") || ends(quantity, ".r");
    return !of_the_young && quantity != "trunk_lean.deg";
}

void carry_to_age(const Who& who, Bar& bar) {
    if (!is_old(who)) return;
    std::string_view quantity = bar.quantity;
    double less = quantity == "thigh_back.deg" ? 6 : quantity == "ankle_down.deg" ? 4 : 0;
    if (less == 0) return;
    bar.high += less;
    bar.also = "Kerrigan 1998";
}

}  // namespace flaneur
