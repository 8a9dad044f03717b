// Maps of a value over the ground, as SVG. Colours run from dark to light as viridis does (S. van der Walt,
// N. Smith, 2015), which people tell apart however they see colours, and in grey.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace flaneur {

struct HeatMap {
    std::string title, note = {}, unit = {};
    double x = 0, y = 0;  // of the upper left corner, y upwards
    double square = 1;    // the side of each square, in the same unit
    size_t columns = 0;
    std::vector<float> values = {};                                     // rows from above; NaN: left white
    std::vector<std::vector<std::pair<double, double>>> outlines = {};  // drawn over it
};
// The scale begins at 0, and ends at the largest value.
std::string heat_svg(const HeatMap& map);

}  // namespace flaneur
