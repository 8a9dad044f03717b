// Charts as SVG: lines over a quantity, and bars beside each other. Pure functions; whatever is in the data,
// everything that they draw lies within the picture. Colours are those of Okabe and Ito, which people tell
// apart however they see colours; each line has its name at its end and a mark of its own too.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace flaneur {

struct PlotPoint {
    double x = 0, y = 0;
};

enum class PlotMarks : uint8_t {
    each,   // joined, with a mark on each point
    none,   // joined: of points so close that marks would hide the line
    cloud,  // marks alone, pale, which darken where there are many
};
struct PlotLine {
    std::string name;
    std::vector<PlotPoint> points;  // in the order in which they are joined
    bool is_faint = false;          // grey and dashed: what others are held against
    PlotMarks marks = PlotMarks::each;
};

struct PlotAxis {
    std::string title;  // with the unit
    bool is_log = false;
};

// A value of y that is marked by a dashed line all across.
struct PlotLevel {
    std::string name;
    double y = 0;
};

struct LinePlot {
    std::string title, note = {};
    PlotAxis x, y;
    std::vector<PlotLine> lines = {};
    std::vector<PlotLevel> levels = {};
};

// Points that are not finite, or not above 0 where an axis is logarithmic, are left out. Where nothing is
// left, the picture says so.
std::string plot_svg(const LinePlot& plot);

// Bars from 0 to the right, a group a row with a bar a column.
struct BarGroup {
    std::string name;
    std::vector<double> values;  // one a column; NaN: none
    std::string note;            // to the right of its bars
};
struct BarPlot {
    std::string title, note = {}, unit = {};
    std::vector<std::string> columns = {};  // what each bar of a group is; told where there are several
    std::vector<BarGroup> groups = {};
};
std::string bars_svg(const BarPlot& plot);

// Pictures of svg_begin(), one below the other.
std::string stacked(const std::vector<std::string>& pictures);

// "1,000,000", "0.25", "12.3": as short as it tells three digits.
std::string short_number(double value);

}  // namespace flaneur
