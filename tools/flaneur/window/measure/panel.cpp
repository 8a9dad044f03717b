// The room Measure.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/measure/moments.h"
#include "tools/flaneur/window/measure/plot.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr float k_wide = 380;       // of the room, at scale 1
constexpr double k_a_moment = 0.1;  // seconds: a run counts from its first tick on
constexpr uint32_t k_grey = IM_COL32(200, 196, 188, 255);
constexpr uint32_t k_line_right = panel_colour(k_right_rgb), k_line_left = panel_colour(k_left_rgb);
constexpr const char* k_tips[] = {"click from point to point; Enter or a double click ends it",
                                  "click its corners; Enter or a double click ends it",
                                  "counts who crosses it, each way: click its two ends",
                                  "counts who is in it: click its corners; Enter or a double click ends it"};

void lay_out_tools(const Show& show, Viewer& v, float scale) {
    for (size_t i = 0; i < std::size(k_drawn_names); ++i) {
        const auto kind = static_cast<MarkingKind>(i);
        if (i > 0) ImGui::SameLine();
        if (toggle_button(k_drawn_names[i], v.measure.tool == kind)) take_tool(kind, v);
        tip(k_tips[i]);
    }
    go_beside("Count anew", scale);
    ImGui::BeginDisabled(is_empty(plan_of(v.measure.counts)));
    if (ImGui::Button("Count anew")) count_anew(show, v);
    ImGui::EndDisabled();
    tip("forgets what lines and zones have counted");
}

// What the next click does.
std::string hint_of(const MeasureRoom& room) {
    if (room.tool) {
        if (room.draft.empty())
            return std::string("Now ").append(k_tips[static_cast<size_t>(*room.tool)]) + ".";
        return *room.tool == MarkingKind::line
                   ? "Click its other end; Ctrl+Z takes the first one back, Esc gives it up."
                   : "Enter or a double click ends it, Ctrl+Z takes a point back, Esc gives it up.";
    }
    if (room.drawn.empty()) return "Choose what to draw, then click on the ground.";
    if (room.selected) return "Drag its points; Delete removes it, Ctrl+Z goes back.";
    return "Click a line or a zone, here or in the city, for more.";
}

const LineCount* line_called(const Counts& counts, const std::string& name) {
    for (const LineCount& line : counts.lines)
        if (line.line.name == name) return &line;
    return nullptr;
}
const ZoneCount* zone_called(const Counts& counts, const std::string& name) {
    for (const ZoneCount& zone : counts.zones)
        if (zone.zone.name == name) return &zone;
    return nullptr;
}

// What is in a row of the list, behind the name.
std::string told_row(const Marking& drawn, const Counts& counts) {
    char text[128] = "";
    if (const LineCount* line = line_called(counts, drawn.name); line && drawn.kind == MarkingKind::line) {
        const Flow all = flow_of(*line, counts.shown, 1e9),
                   lately = flow_of(*line, counts.shown, k_flow_seconds);
        if (is_settled(lately))
            std::snprintf(text, sizeof text, "%u + %u people, %.1f a minute", all.left, all.right,
                          lately.per_minute);
        else
            std::snprintf(text, sizeof text, "%u + %u people", all.left, all.right);
    }
    if (const ZoneCount* zone = zone_called(counts, drawn.name); zone && drawn.kind == MarkingKind::zone) {
        const ZoneSample now = zone_now(*zone, counts);
        std::snprintf(text, sizeof text, "%u %s, %.3f/m\u00b2, level %c", now.people,
                      now.people == 1 ? "person" : "people", static_cast<double>(now.density),
                      'A' + fruin_level(now.density));
    }
    if (drawn.kind == MarkingKind::distance) {
        const Length length = length_of(drawn.points, false);
        std::snprintf(text, sizeof text, "%.2f m, %.2f m on a map", length.along, length.flat);
    }
    if (drawn.kind == MarkingKind::area) {
        const Length length = length_of(drawn.points, true);
        std::snprintf(text, sizeof text, "%.1f m\u00b2, %.1f m round it", area_of(on_map(drawn.points)),
                      length.flat);
    }
    return text;
}

void lay_out_list(MeasureRoom& room, float scale) {
    if (ImGui::IsWindowHovered()) room.hovered.reset();
    float widest = 30 * scale;
    for (const Marking& drawn : room.drawn)
        widest = std::max(widest, ImGui::CalcTextSize(drawn.name.c_str()).x);
    for (size_t i = 0; i < room.drawn.size(); ++i) {
        const Marking& drawn = room.drawn[i];
        ImGui::PushID(static_cast<int>(i));
        const bool is_selected = room.selected == i;
        if (ImGui::Selectable(drawn.name.c_str(), is_selected)) {
            room.tool.reset(), room.draft.clear();
            room.selected = is_selected ? std::nullopt : std::optional(i);
        }
        if (ImGui::IsItemHovered()) room.hovered = i;
        ImGui::SameLine(widest + 22 * scale);
        ImGui::TextDisabled("%s", told_row(drawn, room.counts).c_str());
        ImGui::PopID();
    }
}

// A hand on a chart goes to its moment, as far as is counted.
void go_where_held(std::optional<float> seconds, const World& world, Viewer& v) {
    if (!seconds) return;
    const auto tick = static_cast<uint32_t>(std::lround(std::max(*seconds, 0.0f) * 60));
    const uint32_t to = std::min(tick, v.time.latest);
    const uint32_t going = v.time.going ? v.time.going->to : world.tick;
    if (to != going) go_to(v, world, to);
}

Plot over_time(const char* title, Stretch time, float most, const Viewer& v) {
    Plot plot{title, "minutes of the run", {time.from, 0}, {time.to, round_top(most)}};
    plot.mark = static_cast<float>(v.measure.counts.shown / 60.0);
    plot.changes = v.time.changes;
    plot.is_time = true;
    return plot;
}

// The last change of the city after one tick and before another.
std::optional<uint32_t> change_since(const Timeline& time, uint32_t since, uint32_t now) {
    std::optional<uint32_t> last;
    for (const uint32_t tick : time.changes)
        if (tick > since && tick < now) last = tick;
    return last;
}

void lay_out_line(const LineCount& line, const World& world, Viewer& v, float scale) {
    const Counts& counts = v.measure.counts;
    const Flow all = flow_of(line, counts.shown, 1e9), lately = flow_of(line, counts.shown, k_flow_seconds);
    ImGui::Text("%.2f m long, counted for %.0f s", static_cast<double>(length_of(line.line)), all.seconds);
    if (ImGui::BeginTable("flow", 4, ImGuiTableFlags_SizingStretchSame, {fitted(k_wide - 20, scale), 0})) {
        auto row = [](const char* what, const Flow& flow, const char* form_left) {
            ImGui::TableNextColumn(), ImGui::TextDisabled("%s", what);
            ImGui::TableNextColumn(), ImGui::Text(form_left, flow.left, flow.right);
            if (!is_settled(flow)) {
                ImGui::TableNextColumn(), ImGui::TextDisabled("after %.0f s", k_settled_seconds);
                ImGui::TableNextColumn();
                return;
            }
            ImGui::TableNextColumn(), ImGui::Text("%.1f /min", flow.per_minute);
            ImGui::TableNextColumn(), ImGui::Text("%.3f /(m s)", flow.per_metre_second);
        };
        row("all", all, "%u + %u");
        if (const auto change = change_since(v.time, line.since, counts.shown))
            row("since change", flow_of(line, counts.shown, (counts.shown - *change) / 60.0), "%u + %u");
        row("last 60 s", lately, "%u + %u");
        ImGui::EndTable();
    }
    // How many a minute, each way, in each step of time.
    const Stretch time = plotted(line.since, counts.tick, counts.shown);
    const double first = std::floor(time.from / k_step_seconds) * k_step_seconds;
    const auto steps = static_cast<size_t>(std::ceil((time.to - first) / k_step_seconds));
    std::array<std::vector<float>, 2> sums{std::vector<float>(steps), std::vector<float>(steps)};
    for (auto c = line.crossings.rbegin(); c != line.crossings.rend() && c->seconds >= first; ++c)
        if (const auto i = static_cast<size_t>((c->seconds - first) / k_step_seconds); i < steps)
            ++sums[c->to_right ? 1 : 0][i];
    std::array<std::vector<glm::vec2>, 2> curves;
    float most = 6;
    for (size_t side = 0; side < 2; ++side)
        for (size_t i = 0; i < steps; ++i) {
            const double begin = first + static_cast<double>(i) * k_step_seconds,
                         end = begin + k_step_seconds;
            if (end > counts.tick / 60.0 || begin + k_a_moment < line.since / 60.0) continue;
            const float value = sums[side][i] * static_cast<float>(60 / k_step_seconds);
            most = std::max(most, value);
            curves[side].push_back({begin, value});
            curves[side].push_back({end, value});
        }
    const std::string left = std::string("to the ") + compass(line.line, -1),
                      right = std::string("to the ") + compass(line.line, 1);
    const PlotCurve all_curves[] = {{left.c_str(), k_line_left, curves[0]},
                                    {right.c_str(), k_line_right, curves[1]}};
    Plot plot = over_time("people/min", time, most, v);
    plot.curves = all_curves;
    go_where_held(lay_out_plot(plot, {fitted(k_wide, scale), 150 * scale}, scale), world, v);
    if (ImGui::Button("Fullest")) go_to_fullest(world, v);
    tip("goes to when most crossed it");
}

// Square metres.
double walkable_in(const MeasureRoom& room, const ZoneCount& zone) {
    for (size_t i = 0; i < room.drawn.size() && i < room.walkable.size(); ++i)
        if (room.drawn[i].name == zone.zone.name) return room.walkable[i];
    return zone.area;
}

void lay_out_zone(const ZoneCount& zone, const World& world, Viewer& v, float scale) {
    const Counts& counts = v.measure.counts;
    const ZoneSample now = zone_now(zone, counts);
    const double counted = (counts.shown - zone.since) / 60.0, walkable = walkable_in(v.measure, zone);
    if (walkable < 0.95 * zone.area) {
        ImGui::Text("%.1f m\u00b2, %.0f m\u00b2 of it to walk on, counted for %.0f s", zone.area, walkable,
                    counted);
        tip("densities are people over all of it");
    } else {
        ImGui::Text("%.1f m\u00b2, counted for %.0f s", zone.area, counted);
    }
    ImGui::Text("%u %s, %.3f/m\u00b2; by Voronoi cells %.3f/m\u00b2", now.people,
                now.people == 1 ? "person" : "people", static_cast<double>(now.density),
                static_cast<double>(now.voronoi));
    tip("Voronoi: everybody's ground is what is nearer to them than to anybody else, 3 m at most;\n"
        "after Steffen & Seyfried 2010, once a second");
    if (now.people > 0)
        ImGui::Text("mean speed %.2f m/s, level of service %c", static_cast<double>(now.speed),
                    'A' + fruin_level(now.density));
    else
        ImGui::Text("nobody is inside, level of service A");
    tip("Fruin's, of walkways: A below 0.31 people/m\u00b2, B 0.43, C 0.72, D 1.08, E 2.15, F above");
    const Stretch time = plotted(zone.since, counts.tick, counts.shown);
    std::vector<glm::vec2> density, voronoi, speed;
    float most = 0.1f, fastest = 1;
    for (auto s = zone.samples.rbegin(); s != zone.samples.rend(); ++s) {
        const double seconds = s->tick / 60.0;
        if (seconds < time.from) break;
        if (seconds > time.to) continue;
        density.push_back({seconds, s->density}), voronoi.push_back({seconds, s->voronoi});
        if (s->people > 0) speed.push_back({seconds, s->speed});
        most = std::max({most, s->density, s->voronoi}), fastest = std::max(fastest, s->speed);
    }
    for (std::vector<glm::vec2>* curve : {&density, &voronoi, &speed})
        std::reverse(curve->begin(), curve->end());
    const PlotCurve densities[] = {{"count / area", k_line_right, density},
                                   {"Voronoi", k_line_left, voronoi}};
    const PlotCurve speeds[] = {{"", k_grey, speed}};
    Plot plot = over_time("people/m\u00b2", time, most, v);
    plot.curves = densities;
    go_where_held(lay_out_plot(plot, {fitted(k_wide, scale), 140 * scale}, scale), world, v);
    if (ImGui::Button("Densest")) go_to_densest(world, v);
    tip("goes to when most people to a square metre were in it");
    Plot below = over_time("mean speed, m/s", time, fastest, v);
    below.curves = speeds;
    go_where_held(lay_out_plot(below, {fitted(k_wide, scale), 120 * scale}, scale), world, v);
}

void lay_out_selected(const World& world, Viewer& v, float scale) {
    const MeasureRoom& room = v.measure;
    if (!room.selected) return;
    const Marking& drawn = room.drawn[*room.selected];
    const LineCount* line = line_called(room.counts, drawn.name);
    const ZoneCount* zone = zone_called(room.counts, drawn.name);
    if (!line && !zone) return;
    ImGui::Separator();
    if (drawn.kind == MarkingKind::line && line) lay_out_line(*line, world, v, scale);
    if (drawn.kind == MarkingKind::zone && zone) lay_out_zone(*zone, world, v, scale);
}

// Where to and from.
void lay_out_files(Show& show, Viewer& v, float scale) {
    MeasureRoom& room = v.measure;
    ImGui::Separator();
    const float field = fitted(k_wide, scale) - 150 * scale;
    ImGui::SetNextItemWidth(field);
    ImGui::InputText("##csv", room.csv, sizeof room.csv);
    tip("a file for each line and zone: out/measures-L1.csv ...");
    ImGui::SameLine();
    if (ImGui::Button("Write CSV")) write_counts_as_csv(show, v);
    ImGui::SetNextItemWidth(field);
    ImGui::InputText("##json", room.json, sizeof room.json);
    tip("lines and zones, for here and for flaneur sim --measures-of");
    ImGui::SameLine();
    if (ImGui::Button("Save")) write_plan(v);
    ImGui::SameLine();
    if (ImGui::Button("Read")) read_plan(show, v);
    if (ImGui::Button("Copy as options of flaneur sim")) copy_options(v);
}

}  // namespace

void lay_out_measures(Show& show, Viewer& v, float scale) {
    if (show.loaded.world->roam) {
        ImGui::TextDisabled("On the asteroid there is no ground plane to measure on.");
        return;
    }
    lay_out_tools(show, v, scale);
    ImGui::PushTextWrapPos(fitted(k_wide, scale));
    ImGui::TextDisabled("%s", hint_of(v.measure).c_str());
    ImGui::PopTextWrapPos();
    if (!v.measure.drawn.empty()) ImGui::Separator();
    lay_out_list(v.measure, scale);
    lay_out_selected(*show.loaded.world, v, scale);
    lay_out_files(show, v, scale);
}

}  // namespace flaneur
