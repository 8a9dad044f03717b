#include "tools/flaneur/window/measure/moments.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tools/flaneur/window/measure/measure.h"

namespace flaneur {
namespace {

// The one of that name, or else the first one.
template <class Count>
const Count* counted(const std::vector<Count>& all, auto name_of, const std::string& name) {
    for (const Count& one : all)
        if (name_of(one) == name) return &one;
    return all.empty() ? nullptr : &all.front();
}

std::string selected_name(const MeasureRoom& room) {
    return room.selected ? room.drawn[*room.selected].name : std::string();
}

}  // namespace

Stretch plotted(uint32_t since, uint32_t latest, uint32_t shown) {
    constexpr double k_least = 60, k_most = 300;
    const double begin = since / 60.0, end = std::max(since, latest) / 60.0, now = shown / 60.0;
    const double span = std::clamp(std::ceil((end - begin) / 60) * 60, k_least, k_most);
    double from = std::max(begin, end - span);
    if (now < from) from = std::max(begin, now - span / 2);
    return {from, from + span};
}

std::optional<Height> densest(const ZoneCount& zone, uint32_t from) {
    std::optional<Height> most;
    for (const ZoneSample& sample : zone.samples)
        if (sample.tick >= from && sample.density > (most ? most->value : 0))
            most = {sample.tick, sample.density};
    return most;
}

std::optional<Height> fullest(const LineCount& line, uint32_t from, uint32_t latest) {
    const double begin = std::max(line.since, from) / 60.0;
    const auto first = static_cast<size_t>(std::ceil(begin / k_step_seconds));
    const auto end = static_cast<size_t>(latest / 60.0 / k_step_seconds);
    if (end <= first) return {};
    std::vector<uint32_t> steps(end - first);
    for (const LineCrossing& crossing : line.crossings) {
        const auto step = static_cast<size_t>(crossing.seconds / k_step_seconds);
        if (step >= first && step < end) ++steps[step - first];
    }
    const auto most = std::max_element(steps.begin(), steps.end());
    if (*most == 0) return {};
    const double middle = (static_cast<double>(first + static_cast<size_t>(most - steps.begin())) + 0.5);
    return Height{static_cast<uint32_t>(std::lround(middle * k_step_seconds * 60)),
                  static_cast<float>(*most * 60 / k_step_seconds)};
}

std::optional<CountPeak> peak_of_zones(const MeasureRoom& room, uint32_t from) {
    const ZoneCount* zone = counted(
        room.counts.zones, [](const ZoneCount& z) { return z.zone.name; }, selected_name(room));
    const std::optional<Height> most = zone ? densest(*zone, from) : std::nullopt;
    if (!most) return {};
    char text[96];
    std::snprintf(text, sizeof text, "%s was densest, %.3f people/m\u00b2", zone->zone.name.c_str(),
                  static_cast<double>(most->value));
    return CountPeak{most->tick, text};
}

std::optional<CountPeak> peak_of_lines(const MeasureRoom& room, uint32_t from) {
    const LineCount* line = counted(
        room.counts.lines, [](const LineCount& l) { return l.line.name; }, selected_name(room));
    const std::optional<Height> most = line ? fullest(*line, from, room.counts.tick) : std::nullopt;
    if (!most) return {};
    char text[96];
    std::snprintf(text, sizeof text, "over %s went most, %.0f people a minute", line->line.name.c_str(),
                  static_cast<double>(most->value));
    return CountPeak{most->tick, text};
}

}  // namespace flaneur
