#include "tools/flaneur/window/frame/room.h"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "renderer/quality.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/command.h"
#include "tools/flaneur/window/panels.h"
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

void lay_out_past_pictures(const Costs& costs, double whole, float scale) {
    const Spread spread = spread_of(costs);
    ImGui::Text("%.1f ms a picture, of the last ten or so", whole);
    ImGui::PlotLines("##pictures", costs.wholes.data(), static_cast<int>(costs.wholes.size()), 0, nullptr, 0,
                     std::max(2 * spread.median, 1.0f), {fitted(k_width, scale), 46 * scale});
    tip("each of the last pictures; the middle of the height is the median");
    ImGui::TextDisabled("of the last %zu: median %.1f ms, at worst %.0f ms", costs.wholes.size(),
                        static_cast<double>(spread.median), static_cast<double>(spread.worst));
}

// As high as three lines, so that what is below stays where it is.
void lay_out_sentence(const Costs& costs, float scale) {
    const float top = ImGui::GetCursorPosY();
    ImGui::PushTextWrapPos(fitted(k_width, scale));
    ImGui::TextUnformatted(costliest(costs).c_str());
    ImGui::PopTextWrapPos();
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(),
                                  top + 3 * ImGui::GetTextLineHeight() + ImGui::GetStyle().ItemSpacing.y));
}

void lay_out_counts(const FrameStats& stats, const Viewer& v) {
    auto row = [](const char* name, const std::string& text) {
        ImGui::TableNextColumn();
        ImGui::TextDisabled("%s", name);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(text.c_str());
    };
    if (!ImGui::BeginTable("counts", 4, ImGuiTableFlags_SizingFixedFit)) return;
    row("people drawn", thousands(stats.walkers_drawn));
    row("impostors", thousands(stats.impostors));
    row("in shadows", thousands(stats.walkers_in_shadow));
    row("triangles", thousands(stats.triangles));
    row("draws", thousands(stats.sub_draws + stats.direct_draws));
    char size[24];
    std::snprintf(size, sizeof size, "%.0f %%", static_cast<double>(v.resolution) * 100);
    row("resolution", size);
    ImGui::EndTable();
}

// Automatic, or one of them.
void lay_out_quality(const Show& show, Viewer& v, float scale) {
    const std::string now = quality_name(*show.renderer);
    ImGui::SetNextItemWidth(150 * scale);
    if (!ImGui::BeginCombo("quality", v.quality.empty() ? (now + ", by itself").c_str() : now.c_str()))
        return;
    if (ImGui::Selectable("what suits the device", v.quality.empty())) v.quality.clear();
    for (size_t i = 0; i < k_qualities; ++i) {
        const char* name = quality_level(static_cast<Quality>(i)).name;
        if (ImGui::Selectable(name, v.quality == name)) v.quality = name;
    }
    ImGui::EndCombo();
}

}  // namespace

void copy_bench_command(const Show& show, Viewer& v) {
    const glm::vec2 window = v.layout.wish.window;
    const std::string command =
        bench_command_now(show, v, {static_cast<int>(window.x), static_cast<int>(window.y)});
    ImGui::SetClipboardText(command.c_str());
    say(command);
    tell(v, "Copied: " + printable(command));
}

void lay_out_frame(Show& show, Viewer& v, float scale) {
    Costs& costs = v.costs;
    double whole = 0, device = 0;
    for (const double ms : costs.parts) whole += ms;
    lay_out_past_pictures(costs, whole, scale);
    lay_out_sentence(costs, scale);
    for (size_t i = 0; i < k_costs; ++i) {
        lay_out_cost(k_cost_names[i], costs.parts[i], whole, 0, scale);
        if (static_cast<CostOf>(i) != CostOf::draw) continue;
        lay_out_cost("recording", costs.record, whole, 14, scale);
        lay_out_cost("waiting for device", std::max(costs.parts[i] - costs.record, 0.0), whole, 14, scale);
        tip("until the device has done what is listed below, of which some goes on meanwhile,\n"
            "and the display has taken the picture");
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
    if (ImGui::Checkbox("crowd, city and sky apart", &costs.is_apart)) costs.stages.clear();
    tip("with how many fragments are shaded; pictures take longer meanwhile");
    ImGui::Separator();
    lay_out_counts(frame_stats(*show.renderer), v);
    lay_out_quality(show, v, scale);
    if (ImGui::Button("Copy as flaneur bench frame")) copy_bench_command(show, v);
    tip("the command that measures this view without a window, from this moment on");
}

}  // namespace flaneur
