#include "tools/flaneur/gait/people/who.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/body/pace.h"
#include "tools/flaneur/gait/bars.h"

namespace flaneur {

namespace {

// Middle heights, metres, at 4, 6 .. 18 years.
constexpr double k_girls_grow[] = {1.03, 1.15, 1.27, 1.39, 1.51, 1.60, 1.625, 1.63};
constexpr double k_boys_grow[] = {1.03, 1.16, 1.27, 1.38, 1.49, 1.63, 1.73, 1.765};

// m/s at 65, 75 and 85 years.
constexpr double k_women_at_most[] = {1.87, 1.71, 1.59};
constexpr double k_men_at_most[] = {2.05, 1.83, 1.65};

// From a table of N values, `step` apart from `first` on; beyond its ends, the end's.
template <size_t N>
double look_up(const double (&table)[N], double first, double step, double x) {
    double at = std::clamp((x - first) / step, 0.0, static_cast<double>(N - 1));
    size_t i = std::min(static_cast<size_t>(at), N - 2);
    return table[i] + (table[i + 1] - table[i]) * (at - static_cast<double>(i));
}

std::string years(double age) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", age);
    return text;
}

}  // namespace

std::string word_of(const Who& who) {
    std::string word = (who.sex == Sex::woman ? "woman_" : "man_") + years(who.age);
    return who.style == 0 ? word : word + "_style_" + std::to_string(who.style);
}

std::string name_of(const Who& who) {
    std::string name = (who.sex == Sex::woman ? "a woman of " : "a man of ") + years(who.age);
    return who.style == 0 ? name : name + ", style " + std::to_string(who.style);
}

double usual_height(const Who& who) {
    return look_up(who.sex == Sex::woman ? k_girls_grow : k_boys_grow, 4, 2, who.age);
}

double liked_speed(const Who& who, double leg) {
    return static_cast<double>(
        usual_speed(static_cast<float>(who.age), who.sex == Sex::woman, static_cast<float>(leg)));
}

double fastest_speed(const Who& who, double leg) {
    double run = std::sqrt(k_run_froude * static_cast<double>(k_gravity) * leg);
    if (who.age < 60) return run;
    return std::min(run, look_up(who.sex == Sex::woman ? k_women_at_most : k_men_at_most, 65, 10, who.age));
}

Manner manner_of(const Who& who) {
    Manner middle = manner_at_age(static_cast<float>(who.age));
    if (who.style > 0) return draw_manner(middle, {who.style, 0, 0, Purpose::style});
    middle.unevenness = 0;
    return middle;
}

void free_hands(Manner& manner, const Who& who, const GaitOptions& gait) {
    if (gait.stand == 0 && gait.bag == Bag::none && gait.posture.empty()) return;
    manner.postures = postures_at_age(static_cast<float>(who.age), who.sex == Sex::woman);
    if (who.style > 0) vary_postures(manner, {who.style, 0, 0, Purpose::style});
    for (size_t i = 1; i < k_posture_count && !gait.posture.empty(); ++i)
        manner.postures[i] = k_posture_names[i] == gait.posture ? 1e6f : 0;
}

}  // namespace flaneur
