#include "tools/flaneur/window/frame/costs.h"

#include <algorithm>
#include <cstdio>

#include "renderer/renderer.h"
#include "sim/base/zone.h"

namespace flaneur {
namespace {

constexpr double k_new = 0.1;  // weight of the last picture

void mix(double& average, double value) {
    average = average == 0 ? value : average + k_new * (value - average);
}

// What a stage of the device does, and what lessens it.
struct StageWords {
    const char *name, *what, *less;
};
constexpr StageWords k_stages[] = {
    {"crowd", "people who are near enough for bodies",
     "people near the eye: the layers overdraw and levels of detail show where"},
    {"city", "houses, ground and what stands there",
     "the city in view: the layer overdraw shows where, and a lower quality draws plainer"},
    {"scene", "people, city and sky: what each pixel shows",
     "city and people in view: time them apart, above"},
    {"sky", "", "the sky in view"},
    {"light", "sun, shadows, sky and lamps on each pixel, once", "the picture's size"},
    {"crowd shadows", "people, seen from the sun",
     "people whose shadows are near: a lower quality has fewer"},
    {"city shadows", "the city, seen from the sun: when that or the eye moves",
     "the sun, or an eye that moves: shadows are drawn anew"},
    {"surfaces to host", "what each pixel shows, for the CPU to light", "the picture's size"},
    {"paint", "a layer that shows its own surfaces", "the layer: L lists them"},
    {"overlay", "lines and colours of layers", "the layers: L lists them"},
};

const StageWords* words_of(const std::string& stage) {
    for (const StageWords& words : k_stages)
        if (stage == words.name) return &words;
    return nullptr;
}

}  // namespace

void begin_picture(Costs& c, double time) {
    if (c.began > 0) {
        c.wholes.push_back(static_cast<float>((time - c.began) * 1000));
        if (c.wholes.size() > Costs::k_kept) c.wholes.erase(c.wholes.begin());
        c.now[static_cast<size_t>(CostOf::rest)] += time - c.ended;
        for (size_t i = 0; i < k_costs; ++i) mix(c.parts[i], c.now[i] * 1000);
    }
    c.now = {};
    c.began = c.ended = time;
    c.traced = is_tracing() ? trace_now() : 0;
}

void end_part(Costs& c, CostOf part, double time) {
    c.now[static_cast<size_t>(part)] += time - c.ended;
    c.ended = time;
    if (!is_tracing() || c.traced == 0) return;
    const int64_t now = trace_now();
    record_trace({k_cost_names[static_cast<size_t>(part)], c.traced, now, 0, TraceKind::zone});
    c.traced = now;
}

void end_picture(Costs& c, const FrameStats& stats) {
    mix(c.record, stats.cpu_record_ms);
    size_t place = 0;  // behind the stage before
    for (const FrameStats::Stage& now : stats.stages) {
        auto is_it = [&](const Costs::Stage& stage) { return stage.name == now.name; };
        auto there = std::find_if(c.stages.begin(), c.stages.end(), is_it);
        if (there == c.stages.end())
            there = c.stages.insert(c.stages.begin() + static_cast<std::ptrdiff_t>(place), {now.name});
        mix(there->ms, now.gpu_ms);
        there->fragments = now.fragments;
        place = static_cast<size_t>(there - c.stages.begin()) + 1;
    }
    for (Costs::Stage& stage : c.stages) {
        auto is_it = [&](const FrameStats::Stage& now) { return stage.name == now.name; };
        if (std::any_of(stats.stages.begin(), stats.stages.end(), is_it)) continue;
        mix(stage.ms, 0);
        stage.fragments = 0;
    }
}

Spread spread_of(const Costs& c) {
    if (c.wholes.empty()) return {};
    std::vector<float> sorted = c.wholes;
    std::sort(sorted.begin(), sorted.end());
    return {sorted[sorted.size() / 2], sorted.back()};
}

std::string what_is(const std::string& stage) {
    const StageWords* words = words_of(stage);
    return words ? words->what : "";
}

std::string costliest(const Costs& c) {
    double whole = 0, stages = 0;
    for (const double ms : c.parts) whole += ms;
    const Costs::Stage* stage = nullptr;
    for (const Costs::Stage& s : c.stages) {
        stages += s.ms;
        if (!stage || s.ms > stage->ms) stage = &s;
    }
    if (whole <= 0) return "";
    const auto most = static_cast<size_t>(std::max_element(c.parts.begin(), c.parts.end()) - c.parts.begin());
    char share[64];
    std::snprintf(share, sizeof share, "%.0f %% of a picture is ", 100 * c.parts[most] / whole);
    std::string text = share;
    switch (static_cast<CostOf>(most)) {
        case CostOf::ticks:
            return text + "stepping people: fewer of them, or slower time, would lessen it.";
        case CostOf::people:
            return text + "getting people and layers ready: fewer people, or fewer layers, would lessen it.";
        case CostOf::panels:
            return text + "these panels: H hides them.";
        case CostOf::rest:
            return text + "waiting for the display, or for the pictures a second that the settings allow.";
        case CostOf::draw:
            break;
    }
    text += "drawing";
    if (!stage || stages <= 0) return text + ".";
    std::snprintf(share, sizeof share, "; %s takes %.0f %% of the device's time", stage->name.c_str(),
                  100 * stage->ms / stages);
    text += share;
    if (const StageWords* words = words_of(stage->name)) text.append(": ").append(words->less);
    return text + ".";
}

}  // namespace flaneur
