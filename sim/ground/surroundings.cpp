#include "sim/ground/surroundings.h"

namespace flaneur {

static const Ground& as_ground(const void* asked) { return *static_cast<const Ground*>(asked); }

Surroundings surroundings_of(const Ground& ground) {
    return {&ground,
            [](const void* asked, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits) {
                // One point needs no batch.
                if (points.size() == 1) {
                    hits[0] = ground_at(as_ground(asked), points[0], up, down);
                } else {
                    ground_at(as_ground(asked), points, up, down, hits);
                }
            },
            [](const void* asked, Vec3 point, float radius) {
                return closest_wall(as_ground(asked), point, radius);
            }};
}

std::optional<GroundHit> ground_at(const Surroundings& around, Vec3 point, float up, float down) {
    std::optional<GroundHit> hit;
    around.ground(around.asked, {&point, 1}, up, down, &hit);
    return hit;
}

void ground_at(const Surroundings& around, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits) {
    around.ground(around.asked, points, up, down, hits);
}

std::optional<WallPoint> closest_wall(const Surroundings& around, Vec3 point, float radius) {
    if (!around.wall) return std::nullopt;
    return around.wall(around.asked, point, radius);
}

std::optional<WallPoint> wall_beside(const Surroundings& around, Vec3 point, float radius) {
    constexpr float k_at_top = 0.1f, k_down = 3;  // metres
    const auto wall = closest_wall(around, point, radius);
    if (!wall || point.y <= wall->point.y || dot(point - wall->point, wall->normal) >= 0) return wall;
    const auto below = ground_at(around, point, 0, k_down);
    return below && below->height > wall->point.y - k_at_top ? std::nullopt : wall;
}

}  // namespace flaneur
