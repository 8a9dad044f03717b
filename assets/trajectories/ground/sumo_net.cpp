// Nets of SUMO as ground: lanes, crossings, walking areas and junctions.
#include <cmath>

#include "assets/files/words.h"
#include "assets/trajectories/formats/xml.h"
#include "assets/trajectories/geometry.h"
#include "assets/trajectories/ground/outlines.h"

namespace flaneur {
namespace {

constexpr double k_usual_lane_width = 3.2;  // metres, SUMO's default
constexpr size_t k_most_net_corners = 2'000'000;

// "1,2 3,4 5,6,0"; no corner where it is none.
std::vector<Vec2> lane_shape_of(std::string_view text) {
    std::vector<Vec2> shape;
    for (const std::string_view corner : split(text, ' ')) {
        if (corner.empty()) continue;
        const std::vector<std::string_view> parts = split(corner, ',');
        double x = 0, y = 0;
        if (parts.size() < 2 || !parse_number(parts[0], x) || !parse_number(parts[1], y) ||
            !(std::fabs(x) <= 1e5) || !(std::fabs(y) <= 1e5))
            return {};
        shape.push_back({static_cast<float>(x), 0 - static_cast<float>(y)});
    }
    return shape;
}

}  // namespace

Result<WalkableGeometry> parse_sumo_net(std::string_view xml) {
    WalkableGeometry geometry;
    Rings rings;
    size_t corners = 0;
    std::string function;
    Result<void> walked =
        walk_xml(xml, {.begin = [&](std::string_view name, XmlAttributes a) -> std::string {
                           if (name == "edge") function = std::string(a["function"]);
                           const bool is_lane = name == "lane";
                           if ((!is_lane && name != "junction") || !a.has("shape")) return {};
                           const std::vector<Vec2> shape = lane_shape_of(a["shape"]);
                           if (shape.empty())
                               return a["shape"].empty() ? "" : "a shape that is none within 100 km";
                           corners += shape.size();
                           if (corners > k_most_net_corners) return "more corners than are read";
                           if (!is_lane || function == "walkingarea") {
                               if (shape.size() > 2) add_outline(rings, shape);
                               return {};
                           }
                           double width = 0;
                           if (!parse_number(a["width"], width) || !(width > 0 && width < 100))
                               width = k_usual_lane_width;
                           const auto half = static_cast<float>(width / 2);
                           if (function != "internal") add_strip(rings, shape, half, half, false);
                           return {};
                       },
                       .end = {}});
    if (!walked) return walked.error();
    geometry.area = united_area(rings);
    if (geometry.area.empty()) return Error{"has no lane and no junction"};
    return geometry;
}

}  // namespace flaneur
