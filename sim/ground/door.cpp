#include "sim/ground/door.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

static constexpr float k_near = 1.3f;        // metres from whoever stands before a door to the wall, at most
static constexpr float k_faces = 0.8f;       // cosine between where it looks and the way in, at least
static constexpr float k_square = 0.97f;     // the same of the way in and what is wall beside it
static constexpr float k_wide = 0.45f;       // metres of wall to either side
static constexpr float k_room = 0.5f;        // metres behind the wall without another
static constexpr float k_threshold = 0.25f;  // metres up or down from whoever stands there
static constexpr float k_before = 0.45f;     // metres before the wall from which on one is in the doorway
static constexpr float k_clear = 0.25f;      // metres before the wall that one keeps beside the door
static constexpr float k_some = 0.05f;
static constexpr float k_farthest_in = k_door_depth + k_room - 2 * k_some;  // that one may be pushed

float depth_in(const Door& door, Vec2 place) { return dot(place - on_ground(door.at), door.way); }

float aside_in(const Door& door, Vec2 place) { return cross(door.way, place - on_ground(door.at)); }

static Vec2 side_of(const Door& door) { return {-door.way.z, door.way.x}; }

static Vec3 place_in(const Door& door, float depth, float aside, float up) {
    return door.at + at_height(door.way * depth + side_of(door) * aside, up);
}

// Whether the wall is one plane about the door, as high as people are.
static bool is_walled(const Surroundings& around, const Door& door) {
    constexpr float k_off = 0.2f;
    for (const float aside : {-k_wide, 0.0f, k_wide})
        for (const float up : {0.3f, 1.0f, 1.9f}) {
            const auto wall = closest_wall(around, place_in(door, -k_off, aside, up), k_off + k_some);
            if (!wall || wall->distance < k_off - k_some ||
                dot(on_ground(wall->normal), door.way) > -k_square)
                return false;
        }
    return true;
}

static bool is_hidden(const Surroundings& around, const Door& door) {
    for (const float depth : {0.3f, 0.65f, k_door_depth, k_door_depth + 0.4f})
        for (const float aside : {-k_door_half, 0.0f, k_door_half})
            if (ground_at(around, place_in(door, depth, aside, 0), 2, 1)) return false;
    for (const float depth : {k_room + 2 * k_some, k_door_depth + k_some})
        if (closest_wall(around, place_in(door, depth, 0, 1), k_room)) return false;
    return true;
}

std::optional<Door> door_at(const Surroundings& around, Vec3 place, Vec2 facing) {
    const auto wall = closest_wall(around, place + Vec3{0, 1, 0}, k_near);
    if (!wall) return std::nullopt;
    Door door{at_height(on_ground(wall->point), place.y), normalize_or(on_ground(wall->normal) * -1, {0, 0})};
    if (dot(door.way, facing) < k_faces || std::fabs(aside_in(door, on_ground(place))) > k_some)
        return std::nullopt;
    std::optional<GroundHit> before;
    for (const float off : {0.02f, 0.1f, 0.25f})
        if (!before) before = ground_at(around, place_in(door, -off, 0, 0), k_threshold, k_threshold);
    if (!before) return std::nullopt;
    door.at.y = before->height;
    return is_walled(around, door) && is_hidden(around, door) ? std::optional(door) : std::nullopt;
}

Vec3 kept_in_line(const Door& door, Vec3 from, Vec3 to) {
    const float was = depth_in(door, on_ground(from)), most = std::fabs(aside_in(door, on_ground(from)));
    const float aside = clamp(aside_in(door, on_ground(to)), -most, most);
    float depth = depth_in(door, on_ground(to));
    if (std::fabs(aside) > k_door_half)
        depth = std::min(depth, std::max(was, k_door_half - std::fabs(aside) - k_clear));
    depth = std::min(depth, std::max(was, k_farthest_in));
    const Vec2 place = on_ground(door.at) + door.way * depth + side_of(door) * aside;
    return at_height(place, to.y);
}

bool is_within(const Door& door, Vec3 place) {
    const float depth = depth_in(door, on_ground(place));
    return depth > -k_before && depth < k_door_depth + k_room &&
           std::fabs(aside_in(door, on_ground(place))) < k_door_half + k_some &&
           std::fabs(place.y - door.at.y) < k_threshold;
}

Surroundings surroundings_of(const Indoors& indoors) {
    return {&indoors,
            [](const void* asked, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits) {
                const Indoors& in = *static_cast<const Indoors*>(asked);
                ground_at(in.around, points, up, down, hits);
                for (size_t k = 0; k < points.size(); ++k) {
                    const float over = points[k].y - in.door.at.y;
                    if (!hits[k] && over >= -up && over <= down &&
                        depth_in(in.door, on_ground(points[k])) > -k_some)
                        hits[k] = GroundHit{in.door.at.y, {0, 1, 0}, Surface::plaza};
                }
            },
            nullptr};
}

}  // namespace flaneur
