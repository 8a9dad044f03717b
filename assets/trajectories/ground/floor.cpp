// Floors of crowd:it: layers of walls, lines or outlines of corners. What is walked on is told by no outline.
#include <cmath>

#include "assets/files/words.h"
#include "assets/trajectories/formats/xml.h"
#include "assets/trajectories/geometry.h"

namespace flaneur {

Result<WalkableGeometry> parse_floor(std::string_view xml) {
    constexpr size_t k_most_points = 1'000'000;
    WalkableGeometry geometry;
    bool is_in_wall = false;
    size_t points = 0;
    std::vector<Vec2> wall;
    Result<void> walked =
        walk_xml(xml, {.begin = [&](std::string_view name, XmlAttributes a) -> std::string {
                           if (name == "wall") {
                               is_in_wall = true;
                               wall.clear();
                           } else if (is_in_wall && name == "point") {
                               Vec2 at{};
                               if (!parse_number(a["x"], at.x) || !parse_number(a["y"], at.z) ||
                                   !(std::fabs(at.x) <= 1e5f) || !(std::fabs(at.z) <= 1e5f))
                                   return "a point without x and y within 100 km";
                               if (++points > k_most_points) return "more points than are read";
                               wall.push_back({at.x, 0 - at.z});
                           }
                           return {};
                       },
                       .end = [&](std::string_view name, std::string_view) -> std::string {
                           if (name != "wall" || !is_in_wall) return {};
                           is_in_wall = false;
                           if (wall.size() > 1) geometry.walls.push_back(wall);
                           return {};
                       }});
    if (!walked) return walked.error();
    if (geometry.walls.empty()) return Error{"has no wall"};
    geometry.assumed.push_back("A floor of crowd:it has walls, and no outline of where people can be.");
    return geometry;
}

}  // namespace flaneur
