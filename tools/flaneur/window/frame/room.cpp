#include "tools/flaneur/window/frame/room.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr float k_width = 320;  // of the room, at scale 1

// A name, milliseconds, and a bar of their share of `whole`.
void lay_out_cost(const char* name, double ms, double whole, float indent, float scale) {
    const float width = fitted(k_width, scale), line = ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float share = whole > 0 ? static_cast<float>(std::clamp(ms / whole, 0.0, 1.0)) : 0;
    const float left = at.x + 0.68f * width, most = 0.32f * width;
    ImGui::GetWindowDrawList()->AddRectFilled({left, at.y + 0.2f * line},
                                              {left + share * most, at.y + 0.85f * line},
                                              ImGui::GetColorU32(ImGuiCol_SliderGrab), 2 * scale);
    ImGui::BeginGroup();  // what is told of it is told over all of it
    ImGui::SetCursorScreenPos({at.x + indent * scale, at.y});
    ImGui::TextUnformatted(name);
    char text[24];
    std::snprintf(text, sizeof text, "%.1f ms", ms);
    ImGui::SameLine();
    ImGui::SetCursorScreenPos({left - 10 * scale - ImGui::CalcTextSize(text).x, at.y});
    ImGui::TextUnformatted(text);
    ImGui::EndGroup();
}

std::string thousands(uint64_t count) {
    char text[24];
    if (count >= 1'000'000)
        std::snprintf(text, sizeof text, "%.1f M", static_cast<double>(count) / 1e6);
    else if (count >= 10'000)
        std::snprintf(text, sizeof text, "%.0f k", static_cast<double>(count) / 1e3);
    else
        std::snprintf(text, sizeof text, "%llu", static_cast<unsigned long long>(count));
    return text;
}

// A bar for each of the last pictures, the newest on the right; those that are higher than there is room for
// in the colour of what is not as one would expect.
void lay_out_past_pictures(const Costs& costs, float scale) {
    const PictureCost mean = mean_of(costs);
    const Spread spread = spread_of(costs);
    ImGui::Text("%.1f ms a picture, mean of the last %zu", static_cast<double>(mean.whole),
                std::min(costs.pictures.size(), Costs::k_meant));
    const ImVec2 size{fitted(k_width, scale), 40 * scale}, at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("pictures", size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    const float top = std::max(2 * spread.median, 1.0f), wide = size.x / static_cast<float>(Costs::k_kept);
    const auto gap = static_cast<float>(Costs::k_kept - costs.pictures.size());
    for (size_t i = 0; i < costs.pictures.size(); ++i) {
        const float share = costs.pictures[i].whole / top;
        const float x = at.x + (gap + static_cast<float>(i)) * wide;
        list.AddRectFilled(
            {x, at.y + size.y * (1 - std::min(share, 1.0f))}, {x + wide, at.y + size.y},
            share > 1 ? ImGui::GetColorU32(warning_colour()) : ImGui::GetColorU32(ImGuiCol_PlotLines));
    }
    if (ImGui::IsItemHovered()) {
        const float place = (ImGui::GetIO().MousePos.x - at.x) / wide - gap;
        const auto i = static_cast<size_t>(std::max(place, 0.0f));
        if (place >= 0 && i < costs.pictures.size())
            tip((std::to_string(costs.pictures.size() - i) + " pictures ago: " + told(costs.pictures[i]))
                    .c_str());
    }
    ImGui::PushTextWrapPos(size.x);
    ImGui::TextDisabled("of the last %zu: median %.1f ms; longest %s", costs.pictures.size(),
                        static_cast<double>(spread.median), told(spread.worst).c_str());
    ImGui::PopTextWrapPos();
}

// As high as three lines, so that what is below stays where it is.
void lay_out_sentence(const Show& show, const Costs& costs, float scale) {
    const bool is_plainest = quality_name(*show.renderer) == k_quality_names[0];
    const float top = ImGui::GetCursorPosY();
    ImGui::PushTextWrapPos(fitted(k_width, scale));
    ImGui::TextUnformatted(costliest(costs, is_plainest).c_str());
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(),
                                  top + 3 * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y));
}

void lay_out_counts(const FrameStats& stats, const Viewer& v) {
    auto row = [](const char* name, const std::string& text, const char* what) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", name);
        tip(what);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
    };
    if (!ImGui::BeginTable("counts", 4, ImGuiTableFlags_SizingFixedFit)) return;
    row("people drawn", thousands(stats.walkers_drawn), "in the picture, as bodies or as impostors");
    row("impostors", thousands(stats.impostors), "people so far off that a flat picture of them is drawn");
    row("in shadows", thousands(stats.walkers_in_shadow), "people whose shadow may be seen");
    row("triangles", thousands(stats.triangles), "of people and city");
    row("draws", thousands(stats.sub_draws + stats.direct_draws),
        "pieces that are handed to the device one by one");
    char size[24];
    std::snprintf(size, sizeof size, "%.0f %%", static_cast<double>(v.resolution) * 100);
    row("resolution", size, "of the window, each way; coarser while the eye moves where pictures take long");
    ImGui::EndTable();
}

// Automatic, or one of them.
void lay_out_quality(const Show& show, Viewer& v, float scale) {
    const std::string now = quality_name(*show.renderer);
    ImGui::SetNextItemWidth(150 * scale);
    if (!ImGui::BeginCombo("quality", v.quality.empty() ? (now + ", by itself").c_str() : now.c_str()))
        return;
    if (ImGui::Selectable("what suits the device", v.quality.empty())) v.quality.clear();
    for (const char* name : k_quality_names)
        if (ImGui::Selectable(name, v.quality == name)) v.quality = name;
    ImGui::EndCombo();
}

}  // namespace

void lay_out_frame(Show& show, Viewer& v, float scale) {
    Costs& costs = v.costs;
    lay_out_past_pictures(costs, scale);
    lay_out_sentence(show, costs, scale);
    const PictureCost mean = mean_of(costs);
    const auto whole = static_cast<double>(mean.whole);
    double device = 0;
    for (size_t i = 0; i < k_costs; ++i) {
        const auto part = static_cast<CostOf>(i);
        const auto ms = static_cast<double>(mean.parts[i]);
        char name[48];
        std::snprintf(name, sizeof name, part == CostOf::ticks ? "%s, %.1f of them" : "%s", k_cost_names[i],
                      static_cast<double>(mean.ticks));
        lay_out_cost(name, ms, whole, 0, scale);
        tip(what_is(part).c_str());
        if (part != CostOf::draw) continue;
        lay_out_cost("recording", costs.record, whole, 14, scale);
        lay_out_cost("waiting for device", std::max(ms - costs.record, 0.0), whole, 14, scale);
        tip("until the device has done what is listed below, of which some goes on meanwhile,\n"
            "has laid panels over it, and the display has taken the picture");
    }
    ImGui::Separator();
    ImGui::TextDisabled("%s", device_name(*show.renderer).c_str());
    for (const Costs::Stage& stage : costs.stages) device += stage.ms;
    for (const Costs::Stage& stage : costs.stages) {
        lay_out_cost(stage.name.c_str(), stage.ms, device, 0, scale);
        std::string what = what_is(stage.name);
        if (stage.fragments > 0)
            what.append(what.empty() ? "" : "; ")
                .append(thousands(stage.fragments))
                .append(" fragments shaded");
        if (!what.empty()) tip(what.c_str());
    }
    ImGui::Checkbox("crowd, city and sky apart", &costs.is_apart);
    tip("drawn one after the other, which takes longer; point at a row for how many fragments it shades");
    ImGui::Separator();
    lay_out_counts(frame_stats(*show.renderer), v);
    lay_out_quality(show, v, scale);
    if (ImGui::Button("Copy as flaneur bench frame")) v.wants_bench_command = true;
    tip("the command that measures this view without a window, from this moment on");
}

}  // namespace flaneur
