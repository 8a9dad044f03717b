#include "tools/flaneur/window/measure/plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace flaneur {
namespace {

constexpr uint32_t k_grid = IM_COL32(255, 255, 255, 26), k_axis = IM_COL32(255, 255, 255, 70),
                   k_words = IM_COL32(167, 162, 154, 255), k_title = IM_COL32(242, 239, 233, 255);

struct Frame {
    ImVec2 low, high;  // of the plotted ground, pixels: left and above, right and below
    const Plot& plot;

    float x(float value) const {
        return low.x + (high.x - low.x) * (value - plot.low.x) / (plot.high.x - plot.low.x);
    }
    float y(float value) const {
        return high.y - (high.y - low.y) * (value - plot.low.y) / (plot.high.y - plot.low.y);
    }
    ImVec2 at(glm::vec2 p) const { return {x(p.x), y(p.y)}; }
};

void add_grid(ImDrawList& list, const Frame& frame) {
    char text[32];
    const Plot& plot = frame.plot;
    const float line = ImGui::GetFontSize();
    auto label = [&](float value, float step) {
        std::snprintf(text, sizeof text, "%.*f",
                      step < 0.1f ? 2
                      : step < 1  ? 1
                                  : 0,
                      static_cast<double>(value == 0 ? 0 : value));
        return ImGui::CalcTextSize(text);
    };
    const float step_y = grid_step(plot.high.y - plot.low.y);
    for (float v = std::ceil(plot.low.y / step_y - 1e-3f) * step_y; v <= plot.high.y + 1e-3f * step_y;
         v += step_y) {
        if (std::fabs(v) < 1e-3f * step_y) v = 0;
        list.AddLine({frame.low.x, frame.y(v)}, {frame.high.x, frame.y(v)}, v == 0 ? k_axis : k_grid);
        const ImVec2 size = label(v, step_y);
        list.AddText({frame.low.x - size.x - line * 0.3f, frame.y(v) - size.y / 2}, k_words, text);
    }
    const float step_x = grid_step(plot.high.x - plot.low.x);
    for (float v = std::ceil(plot.low.x / step_x - 1e-3f) * step_x; v <= plot.high.x + 1e-3f * step_x;
         v += step_x) {
        if (std::fabs(v) < 1e-3f * step_x) v = 0;
        list.AddLine({frame.x(v), frame.low.y}, {frame.x(v), frame.high.y}, k_grid);
        const ImVec2 size = label(v, step_x);
        list.AddText({frame.x(v) - size.x / 2, frame.high.y + line * 0.3f}, k_words, text);
    }
    const ImVec2 unit = ImGui::CalcTextSize(plot.x_unit);
    list.AddText({frame.high.x - unit.x, frame.high.y + line * 1.2f}, k_words, plot.x_unit);
}

void add_curve(ImDrawList& list, const Frame& frame, const PlotCurve& curve, float width) {
    std::vector<ImVec2> points;
    for (size_t i = 0; i < curve.points.size(); ++i) {
        const glm::vec2 p = curve.points[i];
        if (curve.is_stepped && i > 0) points.push_back(frame.at({p.x, curve.points[i - 1].y}));
        points.push_back(frame.at(p));
    }
    list.AddPolyline(points.data(), static_cast<int>(points.size()), curve.colour, ImDrawFlags_None, width);
}

// The title, and behind it what the curves are.
void add_names(ImDrawList& list, const Plot& plot, ImVec2 at, float right) {
    list.AddText(at, k_title, plot.title);
    float x = right;
    for (size_t i = plot.curves.size(); i-- > 0;) {
        const PlotCurve& curve = plot.curves[i];
        if (!*curve.name) continue;
        const ImVec2 size = ImGui::CalcTextSize(curve.name);
        x -= size.x;
        list.AddText({x, at.y}, curve.colour, curve.name);
        x -= ImGui::GetFontSize() * 0.8f;
    }
}

}  // namespace

float grid_step(float span) {
    float step = 0.01f;
    for (int i = 0; span / step > 5.001f && i < 60; ++i) step *= i % 3 == 1 ? 2.5f : 2;  // 1, 2, 5, 10 ..
    return step;
}

float round_top(float most) {
    const float step = grid_step(std::max(most, 1e-3f));
    return std::max(std::ceil(most / step - 1e-3f), 1.0f) * step;
}

void lay_out_plot(const Plot& plot, glm::vec2 size, float scale) {
    const float line = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({size.x, size.y});
    if (!ImGui::IsItemVisible()) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Frame frame{{at.x + 2.6f * line, at.y + 1.4f * line},
                      {at.x + size.x - 0.5f * line, at.y + size.y - (*plot.x_unit ? 2.4f : 1.5f) * line},
                      plot};
    add_names(list, plot, at, frame.high.x);
    list.PushClipRect({frame.low.x, frame.low.y - 1}, {frame.high.x, frame.high.y + 1}, true);
    for (const PlotBand& band : plot.bands)
        for (size_t i = 1; i < std::min(band.low.size(), band.high.size()); ++i)
            list.AddQuadFilled(frame.at(band.low[i - 1]), frame.at(band.high[i - 1]), frame.at(band.high[i]),
                               frame.at(band.low[i]), band.colour);
    list.PopClipRect();
    add_grid(list, frame);
    list.PushClipRect({frame.low.x, frame.low.y - 1}, {frame.high.x, frame.high.y + 1}, true);
    if (plot.mark >= plot.low.x && plot.mark <= plot.high.x)
        list.AddLine({frame.x(plot.mark), frame.low.y}, {frame.x(plot.mark), frame.high.y}, k_axis);
    for (const PlotCurve& curve : plot.curves)
        if (curve.points.size() > 1) add_curve(list, frame, curve, 1.6f * scale);
    list.PopClipRect();
}

}  // namespace flaneur
