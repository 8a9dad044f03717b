// The timeline along the lower edge.
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/time/colours.h"
#include "tools/flaneur/window/time/time.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr uint32_t k_least_span = 10 * 60;  // ticks that the timeline is long at least
constexpr float k_snap = 4;                 // pixels, at scale 1, to a mark or an event

// Ticks as pixels along the bar.
struct Bar {
    ImVec2 low, high;  // corners on the screen
    uint32_t first, end;
    float x_of(uint32_t tick) const {
        const float share =
            static_cast<float>(tick - std::min(tick, first)) / static_cast<float>(std::max(end - first, 1u));
        return low.x + std::min(share, 1.0f) * (high.x - low.x);
    }
    uint32_t tick_at(float x) const {
        const float share = std::clamp((x - low.x) / std::max(high.x - low.x, 1.0f), 0.0f, 1.0f);
        return first + static_cast<uint32_t>(std::lround(share * static_cast<float>(end - first)));
    }
};

// What lies under the cursor has a name, and the hand finds its very tick.
struct Pointed {
    uint32_t tick = 0;
    std::string name;
};
Pointed pointed_at(const Timeline& time, const Bar& bar, float x, float scale) {
    Pointed found{std::min(bar.tick_at(x), time.latest), ""};
    float nearest = k_snap * scale;
    auto look_at = [&](uint32_t tick, const auto& name) {
        const float off = std::fabs(bar.x_of(tick) - x);
        if (off >= nearest) return;
        nearest = off;
        found = {tick, name()};
    };
    for (const uint32_t tick : time.changes) look_at(tick, [] { return "changed by hand"; });
    for (const Mark& mark : time.marks) look_at(mark.tick, [&] { return mark.name; });
    for (const Event& event : time.watch.events)
        if (time.wants[static_cast<size_t>(event.kind)])
            look_at(event.tick, [&] { return event_text(event); });
    return found;
}

void draw_kept(ImDrawList& list, const Bar& bar, const std::vector<uint32_t>& kept, uint32_t latest) {
    list.AddRectFilled(bar.low, bar.high, ImGui::GetColorU32(ImGuiCol_FrameBg), 3);
    list.AddRectFilled(bar.low, {bar.x_of(latest), bar.high.y}, ImGui::GetColorU32(ImGuiCol_FrameBgActive),
                       3);
    // The brighter, the closer together what is kept, and the sooner one is there.
    for (size_t i = 0; i < kept.size(); ++i) {
        const uint32_t next = i + 1 < kept.size() ? kept[i + 1] : latest;
        const float gap = static_cast<float>(std::max(next - kept[i], k_history_ticks));
        const float alpha = 0.75f * std::sqrt(static_cast<float>(k_history_ticks) / gap);
        list.AddRectFilled({bar.x_of(kept[i]), bar.low.y}, {bar.x_of(next), bar.high.y},
                           panel_colour(0x2f7f8c, alpha));
    }
}

void draw_events(ImDrawList& list, const Bar& bar, const Timeline& time, float scale) {
    const float middle = 0.5f * (bar.low.y + bar.high.y);
    float last[k_event_kinds];
    std::fill(std::begin(last), std::end(last), -1e9f);
    for (const Event& event : time.watch.events) {
        const auto kind = static_cast<size_t>(event.kind);
        const float x = bar.x_of(event.tick);
        if (!time.wants[kind] || x - last[kind] < 1) continue;
        last[kind] = x;
        list.AddRectFilled({x - scale, middle}, {x + scale, bar.high.y}, panel_colour(k_event_colours[kind]));
    }
}

void draw_changes(ImDrawList& list, const Bar& bar, const Timeline& time, float scale) {
    const float middle = 0.5f * (bar.low.y + bar.high.y), half = 4 * scale;
    for (const uint32_t tick : time.changes) {
        if (tick < bar.first) continue;
        const float x = bar.x_of(tick);
        list.AddQuadFilled({x, middle - half}, {x + half, middle}, {x, middle + half}, {x - half, middle},
                           ImGui::GetColorU32(ImGuiCol_Text));
    }
}

void draw_marks(ImDrawList& list, const Bar& bar, const Timeline& time, float scale) {
    for (const Mark& mark : time.marks) {
        const float x = bar.x_of(mark.tick), side = 5 * scale;
        list.AddLine({x, bar.low.y}, {x, bar.high.y}, ImGui::GetColorU32(ImGuiCol_Text), scale);
        list.AddTriangleFilled({x, bar.low.y - 2 * scale}, {x + 1.6f * side, bar.low.y + 0.5f * side},
                               {x, bar.low.y + side}, ImGui::GetColorU32(ImGuiCol_Text));
    }
}

void lay_out_progress(const Show& show, const Viewer& v, Size size, float scale) {
    const auto progress = progress_of(v.time, *show.loaded.world, glfwGetTime());
    if (!progress || !progress->is_long) return;
    ImGui::SetNextWindowPos(
        {static_cast<float>(size.width) / 2, v.layout.plan.row_foot - v.layout.wish.note.y}, ImGuiCond_Always,
        {0.5f, 1});
    ImGui::SetNextWindowSize({fitted(320, scale), 0});
    if (ImGui::Begin("going", nullptr, k_plain)) {
        const std::string at = run_time(show.loaded.world->tick);
        if (v.time.anew)
            ImGui::Text("Making people, seed %llu", static_cast<unsigned long long>(v.time.anew->seed));
        else if (is_search(*v.time.going))
            ImGui::Text("On to the next event: %s", at.c_str());
        else
            ImGui::Text("%s of %s", at.c_str(), run_time(v.time.going->to).c_str());
        ImGui::SameLine(fitted(230, scale));
        ImGui::TextDisabled("Esc stops");
        if (v.time.anew || !is_search(*v.time.going))
            ImGui::ProgressBar(progress->share, {-1, 6 * scale}, "");
    }
    ImGui::End();
}

}  // namespace

void lay_out_timeline(Show& show, Viewer& v, Size size, float scale) {
    lay_out_progress(show, v, size, scale);
    Timeline& time = v.time;
    const World& world = *show.loaded.world;
    const PanelPlan& plan = v.layout.plan;
    ImGui::SetNextWindowPos({plan.edge, plan.timeline_top});
    ImGui::SetNextWindowSize({static_cast<float>(size.width) - 2 * plan.edge, k_timeline * scale});
    if (!ImGui::Begin("timeline", nullptr, k_plain & ~ImGuiWindowFlags_AlwaysAutoResize)) return ImGui::End();
    const std::vector<uint32_t> kept = kept_ticks(*time.history);
    const uint32_t first = kept.empty() ? 0 : kept.front(), now = time.scrubbed_to.value_or(world.tick);
    const float letters = 62 * scale, height = 12 * scale;
    const ImVec2 from = ImGui::GetCursorScreenPos();
    ImGui::Text("%s", run_time(now).c_str());
    tip("since the run began");
    float start = letters;
    if (first > 0) {
        ImGui::SetCursorScreenPos({from.x + letters, from.y});
        const bool is_changed = !time.changes.empty() && time.changes.front() <= first + 1;
        const std::string begin = (is_changed ? "changed at " : "kept from ") + run_time(first);
        ImGui::TextDisabled("%s", begin.c_str());
        tip(is_changed ? "as far as the past goes back: there the city was changed; Undo takes that back,\n"
                         "and Compare puts the city as it was opened beside this one"
                       : "as far as the past goes back: memory is short before; the room Time gives it more");
        start += ImGui::CalcTextSize(begin.c_str()).x + 12 * scale;
    }
    const float bar_width = ImGui::GetContentRegionAvail().x - start - letters;
    ImGui::SetCursorScreenPos({from.x + start, from.y - 2 * scale});
    ImGui::InvisibleButton("bar", {std::max(bar_width, 40.0f), height + 10 * scale});
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const Bar bar{
        {low.x, low.y + 5 * scale},
        {high.x, high.y - 5 * scale},
        first,
        std::max({time.latest, first + k_least_span, time.marks.empty() ? 0 : time.marks.back().tick})};
    const Pointed pointed = pointed_at(time, bar, ImGui::GetIO().MousePos.x, scale);
    if (ImGui::IsItemActive()) {
        time.going.reset();
        time.scrubbed_to = pointed.tick;
    } else if (time.scrubbed_to) {
        go_to(v, world, *std::exchange(time.scrubbed_to, std::nullopt));
    }
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetNextWindowPos({bar.x_of(pointed.tick), bar.low.y - 16 * scale}, ImGuiCond_Always,
                                {0.5f, 1});
        ImGui::SetTooltip("%s%s%s", run_time(pointed.tick).c_str(), pointed.name.empty() ? "" : "  ",
                          pointed.name.c_str());
    }

    ImDrawList& list = *ImGui::GetWindowDrawList();
    draw_kept(list, bar, kept, time.latest);
    draw_events(list, bar, time, scale);
    draw_changes(list, bar, time, scale);
    draw_marks(list, bar, time, scale);
    const float x = bar.x_of(now), middle = 0.5f * (bar.low.y + bar.high.y);
    list.AddLine({x, bar.low.y - 4 * scale}, {x, bar.high.y + 4 * scale},
                 ImGui::GetColorU32(ImGuiCol_CheckMark), 2 * scale);
    list.AddCircleFilled({x, middle}, 5 * scale, ImGui::GetColorU32(ImGuiCol_CheckMark));
    ImGui::SetCursorScreenPos({high.x + 10 * scale, from.y});
    ImGui::TextDisabled("%s", run_time(time.latest).c_str());
    tip("as far as the run has come (End)");
    ImGui::End();
}

}  // namespace flaneur
