#include "tools/flaneur/window/measure/plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "tools/flaneur/window/time/time.h"

namespace flaneur {
namespace {

// Of lines and letters, in a dark theme and a light one.
uint32_t grid_colour() { return ImGui::GetColorU32(ImGuiCol_Text, 0.12f); }
uint32_t axis_colour() { return ImGui::GetColorU32(ImGuiCol_Text, 0.3f); }
uint32_t words_colour() { return ImGui::GetColorU32(ImGuiCol_TextDisabled); }
uint32_t title_colour() { return ImGui::GetColorU32(ImGuiCol_Text); }

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
    // The abscissa at a pixel.
    float value(float x_pixel) const {
        const float share = (x_pixel - low.x) / (high.x - low.x);
        return plot.low.x + std::clamp(share, 0.0f, 1.0f) * (plot.high.x - plot.low.x);
    }
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
        list.AddLine({frame.low.x, frame.y(v)}, {frame.high.x, frame.y(v)},
                     v == 0 ? axis_colour() : grid_colour());
        const ImVec2 size = label(v, step_y);
        list.AddText({frame.low.x - size.x - line * 0.3f, frame.y(v) - size.y / 2}, words_colour(), text);
    }
    const float span_x = plot.high.x - plot.low.x;
    const float step_x = plot.is_time ? time_step(span_x) : grid_step(span_x);
    for (float v = std::ceil(plot.low.x / step_x - 1e-3f) * step_x; v <= plot.high.x + 1e-3f * step_x;
         v += step_x) {
        if (std::fabs(v) < 1e-3f * step_x) v = 0;
        list.AddLine({frame.x(v), frame.low.y}, {frame.x(v), frame.high.y}, grid_colour());
        ImVec2 size = label(v, step_x);
        if (plot.is_time) {
            const auto seconds = static_cast<int>(std::lround(v));
            std::snprintf(text, sizeof text, "%d:%02d", seconds / 60, seconds % 60);
            size = ImGui::CalcTextSize(text);
        }
        list.AddText({frame.x(v) - size.x / 2, frame.high.y + line * 0.3f}, words_colour(), text);
    }
    const ImVec2 unit = ImGui::CalcTextSize(plot.x_unit);
    list.AddText({frame.high.x - unit.x, frame.high.y + line * 1.2f}, words_colour(), plot.x_unit);
}

void add_curve(ImDrawList& list, const Frame& frame, const PlotCurve& curve, float width) {
    std::vector<ImVec2> points;
    for (size_t i = 0; i < curve.points.size(); ++i) {
        const glm::vec2 p = curve.points[i];
        // A place that is there twice would make the line bulge.
        auto add = [&](ImVec2 at) {
            if (points.empty() || points.back().x != at.x || points.back().y != at.y) points.push_back(at);
        };
        if (curve.is_stepped && i > 0) add(frame.at({p.x, curve.points[i - 1].y}));
        add(frame.at(p));
    }
    list.AddPolyline(points.data(), static_cast<int>(points.size()), curve.colour, ImDrawFlags_None, width);
}

// Keys move about in panels.
bool has_nav() { return (ImGui::GetIO().ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) != 0; }

float last_of(const Plot& plot) {
    float last = plot.low.x;
    for (const PlotCurve& curve : plot.curves)
        if (!curve.points.empty()) last = std::max(last, curve.points.back().x);
    return last;
}

// At an abscissa: a line, a dot on each curve, and in words what they are there.
void tell_values(ImDrawList& list, const Frame& frame, float x, float scale) {
    std::string text;
    char line[96];
    auto add = [&](const char* form, const char* name, float value) {
        std::snprintf(line, sizeof line, form, name, static_cast<double>(value));
        text.append(text.empty() ? "" : "\n").append(line);
    };
    list.AddLine({frame.x(x), frame.low.y}, {frame.x(x), frame.high.y}, axis_colour());
    for (const PlotCurve& curve : frame.plot.curves) {
        const std::optional<float> value = value_at(curve, x);
        if (!value) continue;
        list.AddCircleFilled(frame.at({x, *value}), 3.5f * scale, curve.colour);
        add("%s: %.3g", *curve.name ? curve.name : frame.plot.title, *value);
    }
    if (text.empty() && !frame.plot.is_time) return;
    if (!frame.plot.is_time)
        add("%s: %.3g", *frame.plot.x_unit ? frame.plot.x_unit : "at", std::fabs(x));
    else {
        const uint32_t tick = static_cast<uint32_t>(std::lround(std::max(x, 0.0f) * 60));
        text.append(text.empty() ? "" : "\n").append("at ").append(run_time(tick));
        if (x <= last_of(frame.plot)) text.append(", a click goes there");
        if (!frame.plot.changes.empty()) text.append("\ndashed: the city was changed");
    }
    ImGui::SetTooltip("%s", text.c_str());
}

// The title, and behind it what the curves are.
void add_names(ImDrawList& list, const Plot& plot, ImVec2 at, float right) {
    list.AddText(at, title_colour(), plot.title);
    float x = right;
    for (size_t i = plot.curves.size(); i-- > 0;) {
        const PlotCurve& curve = plot.curves[i];
        if (!*curve.name) continue;
        const ImVec2 size = ImGui::CalcTextSize(curve.name);
        x -= size.x;
        if (x < at.x + ImGui::CalcTextSize(plot.title).x + ImGui::GetFontSize()) return;
        list.AddText({x, at.y}, curve.colour, curve.name);
        x -= ImGui::GetFontSize() * 0.8f;
    }
}

}  // namespace

std::optional<float> value_at(const PlotCurve& curve, float x) {
    const std::span<const glm::vec2> points = curve.points;
    if (points.empty() || x < points.front().x || x > points.back().x) return {};
    size_t i = 0;
    while (i + 1 < points.size() && points[i + 1].x <= x) ++i;
    if (i + 1 == points.size() || curve.is_stepped) return points[i].y;
    const glm::vec2 a = points[i], b = points[i + 1];
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
}

float grid_step(float span) {
    float step = 0.01f;
    for (int i = 0; span / step > 5.001f && i < 60; ++i) step *= i % 3 == 1 ? 2.5f : 2;  // 1, 2, 5, 10 ..
    return step;
}

float time_step(float span) {
    constexpr float k_steps[] = {1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800};
    for (const float step : k_steps)
        if (span / step <= 5.001f) return step;
    return std::ceil(span / (5 * 3600)) * 3600;
}

float round_top(float most) {
    const float step = grid_step(std::max(most, 1e-3f));
    return std::max(std::ceil(most / step - 1e-3f), 1.0f) * step;
}

std::optional<float> lay_out_plot(const Plot& plot, glm::vec2 size, float scale) {
    const float line = ImGui::GetFontSize();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton(plot.title, {size.x, size.y});
    if (!ImGui::IsItemVisible()) return {};
    const bool is_held = ImGui::IsItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left);
    const bool is_pointed_at = ImGui::IsItemHovered(), has_keys = ImGui::IsItemFocused() && has_nav();
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
        list.AddLine({frame.x(plot.mark), frame.low.y}, {frame.x(plot.mark), frame.high.y},
                     ImGui::GetColorU32(ImGuiCol_CheckMark), 1.5f * scale);
    for (const uint32_t tick : plot.changes) {
        const auto x = frame.x(static_cast<float>(tick) / 60);
        for (float y = frame.low.y; y < frame.high.y; y += 6 * scale)
            list.AddLine({x, y}, {x, y + 3 * scale}, words_colour(), scale);
    }
    for (const PlotCurve& curve : plot.curves)
        if (curve.points.size() > 1) add_curve(list, frame, curve, 1.6f * scale);
    list.PopClipRect();
    if (is_pointed_at)
        tell_values(list, frame, frame.value(ImGui::GetIO().MousePos.x), scale);
    else if (has_keys)
        tell_values(list, frame, last_of(plot), scale);
    return is_held ? std::optional(frame.value(ImGui::GetIO().MousePos.x)) : std::nullopt;
}

}  // namespace flaneur
