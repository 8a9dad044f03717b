#include "tools/flaneur/window/frame/costs.h"

#include <algorithm>
#include <cstdio>

#include "renderer/renderer.h"
#include "sim/base/zone.h"

namespace flaneur {
namespace {

constexpr double k_new = 0.3;  // weight of the last picture

void mix(double& average, double value) {
    average = average == 0 ? value : average + k_new * (value - average);
}

// What a stage of the device does, and what lessens it; also where a lower quality does.
struct StageWords {
    const char *name, *what, *less;
    bool has_quality = false;
};
constexpr StageWords k_stages[] = {
    {"crowd", "people who are near enough for bodies", "fewer people near the eye", true},
    {"city", "houses, ground and what stands there, pixel by pixel",
     "a smaller window, or less of the city in view"},
    {"scene", "people, city and sky: what each pixel shows",
     "a smaller window, or less in view; the box below times city and people apart"},
    {"sky", "", "a smaller window, or less sky in view"},
    {"light", "sun, shadows, sky and lamps on each pixel, once", "a smaller window", true},
    {"crowd shadows", "people, seen from the sun", "fewer people near the eye", true},
    {"city shadows", "the city, seen from the sun: when that or the eye moves",
     "an eye and a sun that rest: shadows are drawn anew", true},
    {"surfaces to host", "what each pixel shows, for the CPU to light", "a smaller window"},
    {"paint", "a layer that shows its own surfaces, in place of the city", "without that layer (L)"},
    {"overlay", "lines, dots and colours over the city", "fewer layers (L)"},
};

constexpr const char* k_parts[k_costs] = {
    "what keys, clicks and panels asked for: a city that is changed, people who come, another quality",
    "the simulation: so many ticks of 1/60 s as time has gone by",
    "getting people and layers ready to be drawn",
    "laying panels out; the device draws them with the picture",
    "handing over what is drawn, and waiting until the device has drawn it",
    "waiting for the display, or for the pictures a second that the settings allow"};

const StageWords* words_of(const std::string& stage) {
    for (const StageWords& words : k_stages)
        if (stage == words.name) return &words;
    return nullptr;
}

size_t most_of(const PictureCost& picture) {
    return static_cast<size_t>(std::max_element(picture.parts.begin(), picture.parts.end()) -
                               picture.parts.begin());
}

}  // namespace

void begin_picture(Costs& c, double time) {
    if (c.began > 0) {
        c.now.parts[static_cast<size_t>(CostOf::rest)] += static_cast<float>((time - c.ended) * 1000);
        c.now.whole = static_cast<float>((time - c.began) * 1000);
        c.pictures.push_back(c.now);
        if (c.pictures.size() > Costs::k_kept) c.pictures.erase(c.pictures.begin());
    }
    c.now = {};
    c.began = c.ended = time;
    c.traced = is_tracing() ? trace_now() : 0;
}

void end_part(Costs& c, CostOf part, double time) {
    c.now.parts[static_cast<size_t>(part)] += static_cast<float>((time - c.ended) * 1000);
    c.ended = time;
    if (!is_tracing() || c.traced == 0) return;
    const int64_t now = trace_now();
    record_trace({k_cost_names[static_cast<size_t>(part)], c.traced, now, 0, TraceKind::zone});
    c.traced = now;
}

void end_picture(Costs& c, const FrameStats& stats, bool is_apart) {
    mix(c.record, stats.cpu_record_ms);
    if (c.were_apart != is_apart) c.stages.clear();
    c.were_apart = is_apart;
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

PictureCost mean_of(const Costs& c) {
    PictureCost mean;
    const size_t count = std::min(c.pictures.size(), Costs::k_meant);
    for (size_t i = c.pictures.size() - count; i < c.pictures.size(); ++i) {
        const PictureCost& picture = c.pictures[i];
        const float share = 1 / static_cast<float>(count);
        for (size_t part = 0; part < k_costs; ++part) mean.parts[part] += share * picture.parts[part];
        mean.whole += share * picture.whole;
        mean.ticks += share * picture.ticks;
    }
    return mean;
}

Spread spread_of(const Costs& c) {
    if (c.pictures.empty()) return {};
    std::vector<float> sorted;
    for (const PictureCost& picture : c.pictures) sorted.push_back(picture.whole);
    std::sort(sorted.begin(), sorted.end());
    const auto worst =
        std::max_element(c.pictures.begin(), c.pictures.end(),
                         [](const PictureCost& a, const PictureCost& b) { return a.whole < b.whole; });
    return {sorted[sorted.size() / 2], *worst};
}

std::string told(const PictureCost& picture) {
    char text[96];
    const size_t most = most_of(picture);
    std::snprintf(text, sizeof text, "%.0f ms, of it %s %.0f", static_cast<double>(picture.whole),
                  k_cost_names[most], static_cast<double>(picture.parts[most]));
    return text;
}

std::string what_is(const std::string& stage) {
    const StageWords* words = words_of(stage);
    return words ? words->what : "";
}

std::string what_is(CostOf part) { return k_parts[static_cast<size_t>(part)]; }

std::string costliest(const Costs& c, bool is_plainest) {
    const PictureCost mean = mean_of(c);
    if (mean.whole <= 0) return "";
    const size_t most = most_of(mean);
    char share[64];
    std::snprintf(share, sizeof share, "%.0f %% of a picture is ",
                  static_cast<double>(100 * mean.parts[most] / mean.whole));
    std::string text = share;
    switch (static_cast<CostOf>(most)) {
        case CostOf::asked:
            return text + "making anew what was asked for: it passes.";
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
    double stages = 0;
    const Costs::Stage* stage = nullptr;
    for (const Costs::Stage& s : c.stages) {
        stages += s.ms;
        if (!stage || s.ms > stage->ms) stage = &s;
    }
    if (!stage || stages <= 0) return text + ".";
    std::snprintf(share, sizeof share, "; %s takes %.0f %% of the device's time", stage->name.c_str(),
                  100 * stage->ms / stages);
    text += share;
    if (const StageWords* words = words_of(stage->name)) {
        text.append(": ").append(words->less);
        if (words->has_quality && !is_plainest) text.append(", or a lower quality");
    }
    return text + ".";
}

}  // namespace flaneur
