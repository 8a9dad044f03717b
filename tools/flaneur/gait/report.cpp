#include "tools/flaneur/gait/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "sim/base/tick.h"
#include "tools/flaneur/gait/measure/signal.h"

namespace flaneur {

const std::vector<NamedCurve> k_named_curves = {
    {"thigh", "Thigh to the vertical", "°, forward +", &Curves::thigh, &k_reference.thigh,
     &k_reference.thigh_sd},
    {"knee", "Knee", "°, flexion +", &Curves::knee, &k_reference.knee, &k_reference.knee_sd},
    {"ankle", "Ankle", "°, dorsiflexion +", &Curves::ankle, &k_reference.ankle, &k_reference.ankle_sd},
    {"foot_pitch", "Foot pitch", "°, toes up +", &Curves::foot_pitch, &k_reference.foot_pitch, nullptr},
    {"pelvis_list", "Pelvic list", "°, same side up +", &Curves::pelvis_list, &k_reference.pelvis_list,
     nullptr},
    {"pelvis_rotation", "Pelvic rotation", "°, same side forward +", &Curves::pelvis_rotation,
     &k_reference.pelvis_rotation, nullptr},
    {"pelvis_height", "Pelvis, height", "mm", &Curves::pelvis_height, nullptr, nullptr},
    {"pelvis_side", "Pelvis, to the side", "mm, same side +", &Curves::pelvis_side, nullptr, nullptr},
    {"upper_arm", "Upper arm to the vertical", "°, forward +", &Curves::upper_arm, nullptr, nullptr},
    {"elbow", "Elbow", "°, flexion +", &Curves::elbow, nullptr, nullptr},
    {"trunk_rotation", "Shoulders, rotation", "°, same side forward +", &Curves::trunk_rotation, nullptr,
     nullptr},
    {"toe_height", "Toe over the ground", "mm", &Curves::toe_height, nullptr, nullptr},
};

namespace {

using Json = nlohmann::ordered_json;

bool has_bar(const Report& report, const std::string& name) {
    return std::any_of(report.verdicts.begin(), report.verdicts.end(),
                       [&](const Verdict& v) { return name == v.bar.quantity; });
}

bool has_curves(const Report& report) { return range(report.curves.thigh) > 0; }

std::string number(double v) {
    if (!std::isfinite(v)) return "null";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", v);
    return text;
}

bool is_bound(double v) { return std::fabs(v) < k_open; }
std::string bound(double v) { return is_bound(v) ? number(v) : ""; }

std::string source_of(const Bar& bar) {
    return bar.also ? std::string(bar.source) + "; " + bar.also : bar.source;
}

}  // namespace

std::string bar_text(const Bar& bar) {
    char text[64];
    if (bar.low <= -k_open) {
        std::snprintf(text, sizeof text, "<= %.4g", bar.high);
    } else if (bar.high >= k_open) {
        std::snprintf(text, sizeof text, ">= %.4g", bar.low);
    } else {
        std::snprintf(text, sizeof text, "%.4g .. %.4g", bar.low, bar.high);
    }
    return text;
}

std::string measured_text(const Verdict& v) {
    if (!v.measured || !std::isfinite(v.value)) return "none";
    char text[32];
    // A millionth is as good as nothing in any of the units.
    std::snprintf(text, sizeof text, "%.4g", std::fabs(v.value) < 5e-7 ? 0 : v.value);
    return text;
}

int failed_count(const Report& report) {
    return static_cast<int>(std::count_if(report.verdicts.begin(), report.verdicts.end(),
                                          [](const Verdict& v) { return !v.pass; }));
}

void print_report(const Report& report, bool all) {
    std::printf("\n%s\n  %-30s %10s   %-18s\n", report.title.c_str(), "quantity", "measured", "bar");
    for (const Verdict& v : report.verdicts) {
        std::printf("  %-30s %10s   %-18s %s", v.bar.quantity, measured_text(v).c_str(),
                    bar_text(v.bar).c_str(), v.pass ? "pass" : "FAIL");
        if (v.bar.stretch > 0) std::printf("   stretch %.4g: %+.2f", v.bar.stretch, v.value - v.bar.stretch);
        std::printf("\n");
    }
    for (const LeftOut& out : report.left_out) {
        std::printf("  %zu bar%s left out, as %s:", out.quantities.size(),
                    out.quantities.size() == 1 ? "" : "s", out.why.c_str());
        for (const std::string& name : out.quantities) std::printf(" %s", name.c_str());
        std::printf("\n");
    }
    for (const Quantity& q : report.quantities) {
        if (all && !has_bar(report, q.name)) std::printf("  %-30s %10.4g\n", q.name.c_str(), q.value);
    }
}

std::string reports_csv(const std::vector<Report>& reports) {
    std::string text = "person,trial,quantity,percent,value,norm,low,high,pass\n";
    for (const Report& r : reports) {
        for (const Quantity& q : r.quantities) {
            auto v = std::find_if(r.verdicts.begin(), r.verdicts.end(),
                                  [&](const Verdict& one) { return q.name == one.bar.quantity; });
            text += r.person + "," + r.name + "," + q.name + ",," + number(q.value) + ",,";
            if (v != r.verdicts.end())
                text += bound(v->bar.low) + "," + bound(v->bar.high) + "," + (v->pass ? "1" : "0");
            else
                text += ",,";
            text += "\n";
        }
        if (!has_curves(r)) continue;
        for (const NamedCurve& c : k_named_curves) {
            for (size_t p = 0; p < k_percents; ++p) {
                text += r.person + "," + r.name + "," + c.name + "," + std::to_string(p) + "," +
                        number((r.curves.*c.curve)[p]) + "," + (c.norm ? number((*c.norm)[p]) : "") + ",,,\n";
            }
        }
    }
    return text;
}

std::string reports_json(const std::vector<Report>& reports) {
    Json json;
    json["trials"] = Json::array();
    for (const Report& r : reports) {
        Json trial;
        if (!r.person.empty()) trial["person"] = r.person;
        trial["name"] = r.name;
        trial["title"] = r.title;
        trial["quantities"] = Json::array();
        for (const Quantity& q : r.quantities) {
            auto v = std::find_if(r.verdicts.begin(), r.verdicts.end(),
                                  [&](const Verdict& one) { return q.name == one.bar.quantity; });
            Json quantity = {{"name", q.name}, {"value", q.value}};
            if (q.moment) {
                quantity["walker"] = q.moment->walker;
                quantity["tick"] = q.moment->tick;
                quantity["second"] = q.moment->tick / std::round(1 / static_cast<double>(k_tick));
            }
            if (v != r.verdicts.end()) {
                if (is_bound(v->bar.low)) quantity["low"] = v->bar.low;
                if (is_bound(v->bar.high)) quantity["high"] = v->bar.high;
                if (v->bar.stretch > 0) quantity["stretch"] = v->bar.stretch;
                quantity["source"] = source_of(v->bar);
                quantity["pass"] = v->pass;
            }
            trial["quantities"].push_back(std::move(quantity));
        }
        for (const LeftOut& out : r.left_out)
            trial["left_out"].push_back({{"quantities", out.quantities}, {"why", out.why}});
        for (const NamedCurve& c : k_named_curves)
            if (has_curves(r)) trial["curves"][c.name] = r.curves.*c.curve;
        json["trials"].push_back(std::move(trial));
    }
    json["norm"] = Json::object();
    for (const NamedCurve& c : k_named_curves)
        if (c.norm) json["norm"][c.name] = *c.norm;
    return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace flaneur
