// Plots in panels: curves over axes that name their units.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace flaneur {

struct PlotCurve {
    const char* name;  // "": it is not listed
    uint32_t colour;   // as ImGui has it: R in the lowest byte
    std::span<const glm::vec2> points;
    bool is_stepped = false;  // holds its value until the next point
};
// Between two curves over the same abscissas.
struct PlotBand {
    std::span<const glm::vec2> low, high;
    uint32_t colour;
};
struct Plot {
    const char* title;    // what is plotted, with its unit
    const char* x_unit;   // of the axis below; "": it is another plot's, below this one
    glm::vec2 low, high;  // of both axes
    std::span<const PlotBand> bands = {};
    std::span<const PlotCurve> curves = {};
    float mark = -1e9f;                      // an abscissa that is marked by an upright line
    std::span<const uint32_t> changes = {};  // ticks that are marked faintly, where the axis is of time
    bool is_time = false;                    // the axis below is of seconds since the run began
};

// A round distance between grid lines: five of them at most.
float grid_step(float span);
// The same of time, seconds.
float time_step(float span);
// `high` of an axis from 0 that holds `most`: a whole number of grid lines.
float round_top(float most);

// What a curve is at an abscissa: between its points; none outside of them.
std::optional<float> value_at(const PlotCurve& curve, float x);

// What the curves are under the cursor is told; while the plot has the keys, what they are at its right end.
// The abscissa under the cursor while it is held down there.
std::optional<float> lay_out_plot(const Plot& plot, glm::vec2 size, float scale);

}  // namespace flaneur
