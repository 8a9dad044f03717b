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

void lay_out_past_pictures(const Costs& costs, double whole, float scale) {
    const Spread spread = spread_of(costs);
    ImGui::Text("%.1f ms a picture, of the last ten or so", whole);
    ImGui::PlotLines("##pictures", costs.wholes.data(), static_cast<int>(costs.wholes.size()), 0, nullptr, 0,
                     std::max(2 * spread.median, 1.0f), {fitted(k_width, scale), 46 * scale});
    tip("each of the last pictures; the middle of the height is the median");
    ImGui::TextDisabled("of the last %zu: median %.1f ms, at worst %.0f ms", costs.wholes.size(),
                        static_cast<double>(spread.median), static_cast<double>(spread.worst));
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

}  // namespace

void lay_out_frame(Show& show, Viewer& v, float scale) {
    Costs& costs = v.costs;
    double whole = 0, device = 0;
    for (const double ms : costs.parts) whole += ms;
    lay_out_past_pictures(costs, whole, scale);
    for (size_t i = 0; i < k_costs; ++i) {
        lay_out_cost(k_cost_names[i], costs.parts[i], whole, 0, scale);
        if (static_cast<CostOf>(i) != CostOf::draw) continue;
        lay_out_cost("recording", costs.record, whole, 14, scale);
        lay_out_cost("waiting for device", std::max(costs.parts[i] - costs.record, 0.0), whole, 14, scale);
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
    tip("with how many fragments are shaded; pictures take longer meanwhile");
    ImGui::Separator();
    lay_out_counts(frame_stats(*show.renderer), v);
    ImGui::PushTextWrapPos(fitted(k_width, scale));
    ImGui::TextUnformatted(costliest(costs).c_str());
    ImGui::TextDisabled("flaneur bench frame measures the same without a window.");
    ImGui::PopTextWrapPos();
}

}  // namespace flaneur
