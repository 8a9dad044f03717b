// The room about time: this run, its past, marks and events.
#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/time/colours.h"
#include "tools/flaneur/window/time/time.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

void heading(const char* text, float scale) {
    ImGui::Dummy({0, 4 * scale});
    ImGui::TextDisabled("%s", text);
}

void lay_out_run(Show& show, Viewer& v, float scale) {
    const World& world = *show.loaded.world;
    ImGui::Text("Seed %llu, %u people, %s so far", static_cast<unsigned long long>(world.seed),
                people_count(world), run_time(v.time.latest).c_str());
    if (ImGui::Button("Restart")) restart(show, v, world.seed);
    tip("the same people from the start; events of this run go, its marks stay");
    ImGui::SameLine();
    if (ImGui::Button("Start with seed")) restart(show, v, static_cast<uint64_t>(v.time.seed));
    tip("other people in the same city");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(110 * scale);
    if (ImGui::InputInt("##seed", &v.time.seed)) v.time.seed = std::max(v.time.seed, 0);
    ImGui::TextDisabled("the time of day is set in Change");
}

void lay_out_side_by_side(Show& show, Viewer& v, float scale) {
    if (v.time.beside) {
        if (ImGui::Button("End comparing")) v.time.beside.reset();
        return;
    }
    const World& world = *show.loaded.world;
    const auto people = people_count(world);
    auto number = [&](const char* name, int& value) {
        ImGui::SameLine(170 * scale);
        ImGui::SetNextItemWidth(110 * scale);
        if (ImGui::InputInt(name, &value)) value = std::max(value, 0);
    };
    if (ImGui::Button("With seed", {150 * scale, 0}))
        set_beside(show, v, {static_cast<uint64_t>(v.time.beside_seed), people});
    tip("the same city with other people, beside this run");
    number("##beside seed", v.time.beside_seed);
    if (ImGui::Button("With so many people", {150 * scale, 0}))
        set_beside(show, v, {world.seed, static_cast<uint32_t>(v.time.beside_people)});
    tip("the same seed with another number of people, beside this run");
    number("##beside people", v.time.beside_people);
    if (ImGui::Button("With this moment", {150 * scale, 0})) set_beside_this_moment(show, v);
    tip("this run as it is now, at rest, beside what becomes of it");
    if (ImGui::Button("With the streets as opened", {fitted(290, scale), 0})) set_beside_before(show, v);
    tip("before and after what was put into the streets: as many people, from the start (Ctrl+B)");
    if (ImGui::Button("With all of the city as opened", {fitted(290, scale), 0}))
        set_beside_as_opened(show, v);
    tip("streets, hour, weather and people of the scene that was opened, from its start");
}

void lay_out_past(Viewer& v, float scale) {
    const HistoryUse use = history_use(*v.time.history);
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%zu moments are kept, in %zu MiB of", use.states, (use.bytes + (size_t{1} << 19)) >> 20);
    tip("what lies between two of them is simulated again; it comes out the same to the last bit");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(80 * scale);
    constexpr int k_least = 16, k_most = 1 << 16;
    if (ImGui::InputInt("##most", &v.time.most_mib, 0, 0, ImGuiInputTextFlags_EnterReturnsTrue)) {
        v.time.most_mib = std::clamp(v.time.most_mib, k_least, k_most);
        set_most_bytes(*v.time.history, static_cast<size_t>(v.time.most_mib) << 20);
    }
    tip("MiB; Enter takes it");
}

void lay_out_marks(const Show& show, Viewer& v, float scale) {
    const World& world = *show.loaded.world;
    if (ImGui::Button("Mark this moment")) mark_moment(v, world);
    tip("B; Alt+Left and Alt+Right go from mark to mark");
    std::optional<size_t> gone;
    for (size_t i = 0; i < v.time.marks.size(); ++i) {
        Mark& mark = v.time.marks[i];
        ImGui::PushID(static_cast<int>(mark.tick));
        if (ImGui::Button(run_time(mark.tick).c_str(), {72 * scale, 0})) go_to_mark(v, world, mark);
        tip("go there, and look from where it was marked");
        ImGui::SameLine();
        char name[64];
        std::snprintf(name, sizeof name, "%s", mark.name.c_str());
        ImGui::SetNextItemWidth(170 * scale);
        if (ImGui::InputText("##name", name, sizeof name)) mark.name = name;
        ImGui::SameLine();
        if (ImGui::Button("Remove")) gone = i;
        ImGui::PopID();
    }
    if (gone) v.time.marks.erase(v.time.marks.begin() + static_cast<std::ptrdiff_t>(*gone));
}

void lay_out_bound(EventKind kind, EventBounds& bounds, float scale) {
    ImGui::SameLine(120 * scale);
    ImGui::SetNextItemWidth(kind == EventKind::near_miss ? 90 * scale : 188 * scale);
    constexpr ImGuiSliderFlags k_clamped = ImGuiSliderFlags_AlwaysClamp;
    switch (kind) {
        case EventKind::stuck:
            ImGui::SliderFloat("##stuck", &bounds.stuck_seconds, 3, 9, "for %.0f s", k_clamped);
            tip("without getting on; people give their goal up after some 12 s");
            break;
        case EventKind::crowding:
            ImGui::SliderFloat("##density", &bounds.density, 0.2f, 5, "from %.1f people/m2", k_clamped);
            tip("in a square of 3 m");
            break;
        case EventKind::near_miss:
            ImGui::SliderFloat("##gap", &bounds.gap, 0.02f, 0.5f, "%.2f m", k_clamped);
            tip("nearer than that");
            ImGui::SameLine();
            ImGui::SetNextItemWidth(90 * scale);
            ImGui::SliderFloat("##closing", &bounds.closing, 0.1f, 2, "%.1f m/s", k_clamped);
            tip("while they close in as fast");
            break;
        case EventKind::arrival:
            ImGui::TextDisabled("the first; faster than all before");
            break;
    }
}

void lay_out_events(Show& show, Viewer& v, float scale) {
    const World& world = *show.loaded.world;
    if (world.roam) return ImGui::TextDisabled("Nothing is watched for where people roam a compound.");
    Watch& watched = v.time.watch;
    for (int i = 0; i < k_event_kinds; ++i) {
        const auto kind = static_cast<EventKind>(i);
        ImGui::PushStyleColor(ImGuiCol_CheckMark, panel_colour(k_event_colours[i]));
        ImGui::Checkbox(k_event_names[i], &v.time.wants[static_cast<size_t>(i)]);
        ImGui::PopStyleColor();
        lay_out_bound(kind, watched.bounds, scale);
    }
    if (ImGui::Button("Before")) go_to_event_before(show, v);
    tip("Shift+N");
    ImGui::SameLine();
    if (ImGui::Button("Next")) go_to_next_event(show, v);
    tip("N: where none is known yet, the run goes on until there is one");
    std::vector<const Event*> shown;
    for (const Event& event : watched.events)
        if (v.time.wants[static_cast<size_t>(event.kind)]) shown.push_back(&event);
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled(shown.empty() ? "none so far" : "%zu", shown.size());
    if (shown.empty()) return;
    const auto rows = static_cast<float>(std::min<size_t>(shown.size(), 9));
    if (ImGui::BeginChild("events", {fitted(330, scale), rows * ImGui::GetTextLineHeightWithSpacing()})) {
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(shown.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
                const Event& event = *shown[static_cast<size_t>(i)];
                ImGui::PushID(i);
                const ImVec2 at = ImGui::GetCursorScreenPos();
                const float middle = at.y + 0.5f * ImGui::GetTextLineHeight();
                ImGui::GetWindowDrawList()->AddCircleFilled(
                    {at.x + 6 * scale, middle}, 4 * scale,
                    panel_colour(k_event_colours[static_cast<size_t>(event.kind)]));
                ImGui::SetCursorScreenPos({at.x + 18 * scale, at.y});
                if (ImGui::Selectable(run_time(event.tick).c_str(), event.tick == world.tick))
                    go_to_event(v, world, event);
                ImGui::SameLine(90 * scale);
                ImGui::Text("%s", event_text(event).c_str());
                ImGui::SameLine(250 * scale);
                ImGui::TextDisabled("no. %u", event.walker);
                ImGui::PopID();
            }
    }
    ImGui::EndChild();
}

}  // namespace

void lay_out_time(Show& show, Viewer& v, float scale) {
    lay_out_run(show, v, scale);
    heading("Side by side", scale);
    lay_out_side_by_side(show, v, scale);
    heading("The past", scale);
    lay_out_past(v, scale);
    heading("Marks", scale);
    lay_out_marks(show, v, scale);
    heading("Events", scale);
    lay_out_events(show, v, scale);
}

}  // namespace flaneur
