// What the room Measure can do, by name and key, and the files that it writes.
#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>
#include <utility>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/measure/csv.h"
#include "tools/flaneur/output/measures.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/measure/moments.h"
#include "tools/flaneur/window/panels.h"

namespace flaneur {
namespace {

template <MarkingKind Kind>
void draw(Show&, Viewer& v) {
    take_tool(Kind, v);
}

constexpr std::array k_actions = {
    Action{"Measure", "M", GLFW_KEY_M, 0,
           [](Show&, Viewer& v) { v.room = v.room == Room::measure ? Room::none : Room::measure; }},
    Action{"Measure a distance", "", 0, 0, draw<MarkingKind::distance>},
    Action{"Measure an area", "", 0, 0, draw<MarkingKind::area>},
    Action{"Measure flow: draw a counting line", "", 0, 0, draw<MarkingKind::line>},
    Action{"Measure density: draw a zone", "", 0, 0, draw<MarkingKind::zone>},
    Action{"Finish what is drawn", "Enter", GLFW_KEY_ENTER, 0,
           [](Show& show, Viewer& v) { finish_draft(show, v); }},
    Action{"To when the zone was densest", "", 0, 0,
           [](Show& show, Viewer& v) { go_to_densest(*show.loaded.world, v); }},
    Action{"To when most crossed the line", "", 0, 0,
           [](Show& show, Viewer& v) { go_to_fullest(*show.loaded.world, v); }},
    Action{"Count people anew on all lines and zones", "", 0, 0,
           [](Show& show, Viewer& v) { count_anew(show, v); }},
    Action{"Write what lines and zones counted, as CSV", "", 0, 0,
           [](Show& show, Viewer& v) { write_counts_as_csv(show, v); }},
    Action{"Save lines and zones", "", 0, 0, [](Show&, Viewer& v) { write_plan(v); }},
    Action{"Read lines and zones", "", 0, 0, [](Show& show, Viewer& v) { read_plan(show, v); }},
    Action{"Copy lines and zones as options of flaneur sim", "", 0, 0,
           [](Show&, Viewer& v) { copy_options(v); }},
};

// As far as the past goes back.
uint32_t first_tick(const Viewer& v) {
    const std::vector<uint32_t> kept = kept_ticks(*v.time.history);
    return kept.empty() ? v.time.latest : kept.front();
}

void go_to_peak(const std::optional<CountPeak>& peak, const char* none, const World& world, Viewer& v) {
    if (!peak) return tell(v, none);
    v.clock.is_paused = true;
    go_to(v, world, peak->tick);
    tell(v, run_time(peak->tick) + ": " + peak->told + ". Space goes on.");
}

// The height of the highest ground, for places that come from a file.
glm::vec3 set_down(const Ground* ground, Vec2 place) {
    constexpr float k_high = 5000;
    const auto hit = ground ? ground_at(*ground, {place.x, k_high, place.z}, 0, 2 * k_high) : std::nullopt;
    return {place.x, hit ? hit->height : 0, place.z};
}

}  // namespace

std::span<const Action> measure_actions() { return k_actions; }

void go_to_densest(const World& world, Viewer& v) {
    go_to_peak(peak_of_zones(v.measure, first_tick(v)), "Nobody has been counted in a zone yet.", world, v);
}
void go_to_fullest(const World& world, Viewer& v) {
    go_to_peak(peak_of_lines(v.measure, first_tick(v)),
               "Nobody has been counted on a line yet, in ten whole seconds.", world, v);
}

std::string options_of(const MeasurePlan& plan) {
    std::string words;
    for (const CountLine& line : plan.lines)
        words.append(words.empty() ? "" : " ").append("--line ").append(told(line));
    for (const CountZone& zone : plan.zones)
        words.append(words.empty() ? "" : " ").append("--zone ").append(told(zone));
    return words;
}

void copy_options(Viewer& v) {
    const std::string words = options_of(plan_of(v.measure.counts));
    if (words.empty()) return tell(v, "Draw a line or a zone first.");
    ImGui::SetClipboardText(words.c_str());
    say(words);
    tell(v, "Copied: " + words);
}

void write_counts_as_csv(const Show&, Viewer& v) {
    const Counts& counts = v.measure.counts;
    const MeasurePlan plan = plan_of(counts);
    if (is_empty(plan)) return tell(v, "Nothing is counted: draw a line or a zone first.");
    Result<std::vector<PartFilePtr>> files = open_counts(v.measure.csv, plan);
    Result<void> written = files ? write_counts(std::move(*files), counts) : files.error();
    std::string told = "Wrote ";
    for (const CountLine& line : plan.lines) told.append(csv_path(v.measure.csv, line.name)).append(" ");
    for (const CountZone& zone : plan.zones) told.append(csv_path(v.measure.csv, zone.name)).append(" ");
    told = written ? told : written.error().message;
    say(told);
    tell(v, printable(told));
}

void write_plan(Viewer& v) {
    const MeasurePlan plan = plan_of(v.measure.counts);
    if (is_empty(plan)) return tell(v, "There is nothing to save: draw a line or a zone first.");
    const Result<void> written = write_file(v.measure.json, plan_json(plan));
    const std::string told = written ? std::string("Wrote ").append(v.measure.json) : written.error().message;
    say(told);
    tell(v, printable(told));
}

void read_plan(const Show& show, Viewer& v) {
    const Result<MeasurePlan> plan = read_plan(std::string(v.measure.json));
    if (!plan) return tell(v, printable(plan.error().message));
    MeasureRoom& room = v.measure;
    const Ground* ground = show.loaded.world->ground.get();
    remember(v);
    std::erase_if(room.drawn, [](const Marking& one) {
        return one.kind == MarkingKind::line || one.kind == MarkingKind::zone;
    });
    for (const CountLine& line : plan->lines)
        room.drawn.push_back(
            {MarkingKind::line, line.name, {set_down(ground, line.a), set_down(ground, line.b)}});
    for (const CountZone& zone : plan->zones) {
        Marking& drawn = room.drawn.emplace_back(Marking{MarkingKind::zone, zone.name, {}});
        for (Vec2 corner : zone.corners) drawn.points.push_back(set_down(ground, corner));
    }
    room.tool.reset(), room.draft.clear(), room.selected.reset();
    count_drawn(show, v);
    auto many = [](size_t count, const char* what) {
        return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
    };
    tell(v, printable("Read " + many(plan->lines.size(), "line") + " and " +
                      many(plan->zones.size(), "zone") + " from " + room.json + "."));
}

}  // namespace flaneur
