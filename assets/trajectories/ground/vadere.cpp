// Scenarios of Vadere: the ground is its bounds, less a wall round them and obstacles.
#include <algorithm>
#include <cmath>

#include "assets/files/file.h"
#include "assets/trajectories/formats/json.h"
#include "assets/trajectories/geometry.h"
#include "assets/trajectories/ground/outlines.h"

namespace flaneur {
namespace {

constexpr size_t k_most_scenario_values = 2'000'000;

// None where it is no number within 100 km.
std::optional<float> number_in(const TracksJson& object, const char* key) {
    const TracksJson& value = in_json(object, key);
    if (!value.is_number() || !(std::fabs(value.get<double>()) <= 1e5)) return std::nullopt;
    return static_cast<float>(value.get<double>());
}

std::optional<Vec2> place_in(const TracksJson& object) {
    const auto x = number_in(object, "x"), y = number_in(object, "y");
    if (!x || !y) return std::nullopt;
    return Vec2{*x, 0 - *y};
}

// Of a rectangle that is `inset` smaller all round.
std::vector<Vec2> rectangle_of(const TracksJson& shape, float inset) {
    const auto corner = place_in(shape);
    const auto width = number_in(shape, "width"), height = number_in(shape, "height");
    if (!corner || !width || !height || *width <= 2 * inset || *height <= 2 * inset) return {};
    const float west = corner->x + inset, east = corner->x + *width - inset;
    const float south = corner->z - inset, north = corner->z - *height + inset;
    return {{west, south}, {east, south}, {east, north}, {west, north}};
}

// Empty: of no kind that is known.
std::vector<Vec2> outline_of(const TracksJson& shape) {
    std::vector<Vec2> outline;
    const TracksJson& type = in_json(shape, "type");
    if (type == "RECTANGLE") return rectangle_of(shape, 0);
    if (type == "CIRCLE") {
        const auto middle = place_in(in_json(shape, "center"));
        const auto radius = number_in(shape, "radius");
        return middle && radius && *radius > 0 ? circle_about(*middle, *radius) : outline;
    }
    if (type == "POLYGON" && in_json(shape, "points").is_array())
        for (const TracksJson& point : in_json(shape, "points"))
            if (const auto place = place_in(point)) outline.push_back(*place);
    return outline;
}

}  // namespace

Result<WalkableGeometry> parse_vadere_scenario(std::string_view json) {
    Result<TracksJson> parsed = parse_tracks_json(json, k_most_scenario_values);
    if (!parsed) return parsed.error();
    const TracksJson& root = *parsed;
    // Whole scenarios, and topographies alone.
    const TracksJson& scenario = in_json(root, "scenario").is_object() ? in_json(root, "scenario") : root;
    const TracksJson& topography =
        in_json(scenario, "topography").is_object() ? in_json(scenario, "topography") : scenario;
    const TracksJson& attributes = in_json(topography, "attributes");
    const bool is_bounded = in_json(attributes, "bounded") == true;
    const float wall = is_bounded ? number_in(attributes, "boundingBoxWidth").value_or(0) : 0;
    const std::vector<Vec2> bounds = rectangle_of(in_json(attributes, "bounds"), std::max(wall, 0.0f));
    if (bounds.empty()) return Error{"is JSON without the bounds of a topography of Vadere"};
    Rings inside, obstacles;
    add_outline(inside, bounds);
    WalkableGeometry geometry;
    size_t left_out = 0;
    if (in_json(topography, "obstacles").is_array())
        for (const TracksJson& obstacle : in_json(topography, "obstacles")) {
            const std::vector<Vec2> outline = outline_of(in_json(obstacle, "shape"));
            if (outline.size() < 3)
                ++left_out;
            else
                add_outline(obstacles, outline);
        }
    if (left_out > 0)
        geometry.assumed.push_back(std::to_string(left_out) +
                                   " obstacles without a known shape are left out.");
    geometry.area = area_without(inside, obstacles);
    if (geometry.area.empty()) return Error{"has no ground between its obstacles"};
    if (const auto step = number_in(in_json(scenario, "attributesSimulation"), "simTimeStepLength");
        step && *step > 0)
        geometry.seconds_a_step = static_cast<double>(*step);
    return geometry;
}

}  // namespace flaneur
