#include "tools/flaneur/window/ask/find.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tools/flaneur/overlay/shapes.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr double k_again_seconds = 0.25;
constexpr size_t k_most_rings = 150;
constexpr uint32_t k_found = ink(0xf2c14e);

void select(uint32_t walker, Viewer& v) {
    v.selected = walker;
    v.asking.selected.reset();
}

void open_room(Show&, Viewer& v) {
    v.room = Room::find;
    v.search.is_opening = true;
}

constexpr std::array k_actions = {
    Action{"Find people", "/", GLFW_KEY_SLASH, 0, open_room},
    Action{"Search among people", "Ctrl+F", GLFW_KEY_F, GLFW_MOD_CONTROL, open_room},
};

void understand(Viewer& v) {
    PeopleSearch& search = v.search;
    Zones zones;
    for (const ZoneCount& zone : v.measure.counts.zones) zones.names.push_back(zone.zone.name);
    zones.holds = [&v](const std::string& name, Vec3 place) {
        for (const ZoneCount& zone : v.measure.counts.zones)
            if (zone.zone.name == name) return is_within(zone.zone.corners, on_ground(place));
        return false;  // it has been removed meanwhile
    };
    search.parsed = search.typed;
    search.refused.clear();
    Result<Filter> filter = parse_filter(search.typed, zones);
    if (!filter) search.refused = filter.error().message;
    search.filter = filter ? std::move(*filter) : Filter();
}

void lay_out_hints(float scale) {
    if (!ImGui::BeginTable("words", 2)) return;
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthFixed, 110 * scale);
    for (const FilterHint& hint : filter_hints()) {
        ImGui::TableNextColumn(), ImGui::TextDisabled("%s", hint.what);
        ImGui::TableNextColumn(), ImGui::TextUnformatted(hint.words);
    }
    ImGui::EndTable();
}

void lay_out_row(const PeopleSearch::One& one, Viewer& v, float scale) {
    const WalkerFacts& f = one.facts;
    ImGui::PushID(static_cast<int>(f.number));
    char number[16];
    std::snprintf(number, sizeof number, "%u", f.number);
    if (ImGui::Selectable(number, v.selected == f.number, ImGuiSelectableFlags_AllowDoubleClick)) {
        select(f.number, v);
        if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            v.choice.walker = f.number, choose(v, CameraChoice::Kind::follow);
    }
    if (ImGui::IsItemHovered()) v.search.pointed = f.number;
    ImGui::SameLine(56 * scale), ImGui::TextUnformatted(told_who(f).c_str());
    ImGui::SameLine(170 * scale), ImGui::TextDisabled("%.0f m", static_cast<double>(one.away));
    ImGui::SameLine(225 * scale), ImGui::TextDisabled("%.2f m/s", static_cast<double>(f.speed));
    ImGui::SameLine(300 * scale), ImGui::TextDisabled("%s", told_doing(f).c_str());
    ImGui::PopID();
}

}  // namespace

std::span<const Action> find_actions() { return k_actions; }

void find_people(const Show& show, Viewer& v) {
    PeopleSearch& search = v.search;
    if (v.room != Room::find) return search.found.clear();
    const double now = glfwGetTime();
    if (search.parsed != search.typed) understand(v), search.looked_at = -1e9;
    if (now - search.looked_at < k_again_seconds) return;
    if (!search.refused.empty()) understand(v);  // a zone may have been drawn meanwhile
    search.looked_at = now;
    search.found.clear();
    if (search.filter.any.empty()) return;
    for (WalkerId id : show.loaded.world->crowd.slots.living) {
        WalkerFacts facts =
            search.filter.asks_where_to ? facts_of(show, id.index) : quick_facts_of(show, id.index);
        if (!holds(search.filter, facts)) continue;
        const float away = glm::length(show.people.walkers[id.index].centre - v.camera.eye);
        search.found.push_back({std::move(facts), away});
    }
    std::sort(search.found.begin(), search.found.end(),
              [](const PeopleSearch::One& a, const PeopleSearch::One& b) { return a.away < b.away; });
}

void mark_found(Show& show, Viewer& v, FrameInput& frame) {
    if (v.room != Room::find || !v.has_panels) return;
    const World& world = *show.loaded.world;
    const Crowd& crowd = world.crowd;
    std::vector<GizmoLine>& lines = show.overlay.lines;
    for (size_t i = 0; i < v.search.found.size(); ++i) {
        const WalkerFacts& facts = v.search.found[i].facts;
        if (!is_there(crowd, facts.number)) continue;
        const WalkerDraw& drawn = show.people.walkers[facts.number];
        Pen pen{.pixels = 2.5f};
        pen.colour = v.search.pointed == facts.number ? ink(0xffffff) : k_found;
        if (i < k_most_rings && !world.roam) {
            const float foot = crowd.motion.position[facts.number].y;
            add_circle(lines, pen, {drawn.centre.x, foot + 0.05f, drawn.centre.z}, {0, 1, 0}, 0.5f);
        }
        pen.pixels = 6;
        add_point(lines, pen, drawn.centre + glm::vec3(0, drawn.radius + 0.15f, 0));
    }
    frame.lines = lines;
}

void lay_out_finding(Show& show, Viewer& v, float scale) {
    PeopleSearch& search = v.search;
    if (search.is_opening) ImGui::SetKeyboardFocusHere(), search.is_opening = false;
    ImGui::SetNextItemWidth(fitted(460, scale));
    ImGui::InputTextWithHint("##who", "woman over 70 with cane", search.typed, sizeof search.typed);
    if (!search.refused.empty()) {
        ImGui::PushTextWrapPos(fitted(460, scale));
        ImGui::TextUnformatted(search.refused.c_str());
        ImGui::PopTextWrapPos();
        return;
    }
    if (search.filter.any.empty()) return lay_out_hints(scale);
    ImGui::TextDisabled("%zu of %u people, the nearest first; a double click follows", search.found.size(),
                        static_cast<uint32_t>(show.loaded.world->crowd.slots.living.size()));
    search.pointed.reset();
    if (search.found.empty()) return;
    const auto rows = static_cast<float>(std::min<size_t>(search.found.size(), 16));
    if (ImGui::BeginChild("found", {fitted(520, scale), rows * ImGui::GetTextLineHeightWithSpacing()})) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(search.found.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
                lay_out_row(search.found[static_cast<size_t>(i)], v, scale);
    }
    ImGui::EndChild();
}

}  // namespace flaneur
