#include "tools/flaneur/gait/cane.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/gait/curves/norms.h"

namespace flaneur {

namespace {

constexpr float k_still = 0.03f;    // m/s
constexpr double k_least = 0.1;     // seconds that a stand lasts
constexpr float k_ground = 0.005f;  // metres, of a tip that is on it
constexpr float k_leg = 0.06f;      // metres round a bone

float between(Vec3 a, Vec3 b) {
    return arccos(clamp(dot(normalize_or(a, {}), normalize_or(b, {})), -1, 1)) / k_radians;
}

float elbow_of(const Instant& now) {
    Vec3 elbow = place(now, right_lower_arm);
    return between(elbow - place(now, right_upper_arm), place(now, right_hand) - elbow);
}

// From points on one stretch to the other.
float apart(Vec3 from, Vec3 to, Vec3 a, Vec3 b) {
    float least = k_leg;
    Vec3 along = b - a;
    for (int i = 0; i <= 32; ++i) {
        Vec3 p = lerp(from, to, static_cast<float>(i) / 32);
        least = std::min(least, length(p - a - along * clamp(dot(p - a, along) / dot(along, along), 0, 1)));
    }
    return least;
}

float leg_distance(const Instant& now) {
    float least = k_leg;
    Vec3 hand = place(now, right_hand), tip = now.cane.tip;
    for (const LimbJoints& limb : k_limbs) {
        Vec3 knee = place(now, limb.lower_leg);
        least = std::min({least, apart(hand, tip, place(now, limb.upper_leg), knee),
                          apart(hand, tip, knee, place(now, limb.foot))});
    }
    return least;
}

// Ticks [begin, end) in which the tip stands.
struct Stand {
    size_t begin, end;
};

std::vector<Stand> stands_of(const Walk& w, size_t first) {
    std::vector<Stand> stands;
    const auto least = static_cast<size_t>(k_least * w.rate);
    for (size_t t = first; t < w.ticks.size();) {
        size_t end = t + 1;
        while (end < w.ticks.size() &&
               length(w.ticks[end].cane.tip - w.ticks[end - 1].cane.tip) * static_cast<float>(w.rate) <
                   k_still)
            ++end;
        if (end - t >= least) stands.push_back({t, end});
        t = end;
    }
    return stands;
}

}  // namespace

Quantities measure_cane(const Walk& w, size_t first) {
    if (w.body.cane == Vec3{}) return {};
    first = std::max<size_t>(first, 1);
    float drift = 0, off = 0, below = 0, speed = 0, bent = 0, near = 0, planted = 0, plants = 0;
    std::vector<bool> on(w.ticks.size());
    for (const Stand& stand : stands_of(w, first)) {
        Vec3 middle = w.ticks[(stand.begin + stand.end) / 2].cane.tip;
        for (size_t t = stand.begin; t < stand.end; ++t) {
            const CaneInstant& cane = w.ticks[t].cane;
            float over = std::fabs(cane.tip.y - cane.ground);
            drift = std::max(drift, length(cane.tip - middle));
            off = std::max(off, over);
            on[t] = over < k_ground;
        }
        if (stand.begin == first) continue;
        planted += elbow_of(w.ticks[stand.begin]);
        ++plants;
    }
    double stood = 0, carried = 0;
    for (size_t t = first; t < w.ticks.size(); ++t) {
        const Instant& now = w.ticks[t];
        below = std::max(below, now.cane.ground - now.cane.tip.y);
        speed = std::max(speed, length(now.cane.tip - w.ticks[t - 1].cane.tip) * static_cast<float>(w.rate));
        bent = std::max(bent, elbow_of(now));
        near = std::max(near, k_leg - leg_distance(now));
        if (now.feet[k_left].swinging) continue;
        ++stood;
        carried += !on[t];
    }
    auto mm = [](float metres) { return 1000 * static_cast<double>(metres); };
    Quantities all{{"cane_drift.mm", mm(drift)},
                   {"cane_float.mm", mm(off)},
                   {"cane_below.mm", mm(below)},
                   {"cane_carried.pct", stood > 0 ? 100 * carried / stood : 0},
                   {"cane_tip_speed.m_s", static_cast<double>(speed)},
                   {"cane_elbow_most.deg", static_cast<double>(bent)},
                   {"cane_leg.mm", mm(near)}};
    if (plants > 0) all.push_back({"cane_elbow.deg", static_cast<double>(planted / plants)});
    return all;
}

double fastest_with_cane(const Body& body) {
    return std::sqrt(k_run_froude * static_cast<double>(k_gravity * leg_length(body)));
}

std::vector<Bar> cane_bars(bool is_level) {
    constexpr const char *k_stands = "canes stand",
                         *k_fitted = "fitted for 20 to 30; Sainsbury & Mulley 1982";
    return {{"cane_drift.mm", 0, 5, 0, k_stands},
            {"cane_float.mm", 0, 5, 0, k_stands},
            {"cane_below.mm", -k_open, 5, 0, k_stands},
            {"cane_carried.pct", 0, is_level ? 30.0 : 60.0, 0, "it goes with the other side's foot"},
            {"cane_tip_speed.m_s", 0, 6, 0, "twice that of a foot"},
            {"cane_elbow.deg", 15, is_level ? 45.0 : 75.0, 0, k_fitted},
            {"cane_elbow_most.deg", 0, 95, 0, "bent to lift the tip over an edge"},
            {"cane_leg.mm", 0, 0, 0, "legs are thick"}};
}

}  // namespace flaneur
