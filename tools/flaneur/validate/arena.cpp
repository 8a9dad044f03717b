#include "tools/flaneur/validate/arena.h"

#include <algorithm>

#include "assets/trajectories/walkable.h"
#include "tools/flaneur/measure/plan.h"

namespace flaneur {
namespace {

constexpr float k_wall_height = 3;

// The ground is to the left of the way round, if x were to the right and z up.
void add_walls(Ground& ground, std::span<const Vec2> ring) {
    for (size_t i = 0; i < ring.size(); ++i) {
        const Vec3 a = at_height(ring[i], 0), b = at_height(ring[(i + 1) % ring.size()], 0);
        ground.faces.push_back({a, b, 0, 0, FaceKind::facade});
    }
}

}  // namespace

FloorQuad floor_of(const Rectangle& r) {
    return {{{r.low.x, 0, r.low.z}, {r.low.x, 0, r.high.z}, {r.high.x, 0, r.high.z}, {r.high.x, 0, r.low.z}}};
}

Arena make_arena(std::span<const FloorQuad> floors, std::span<const Face> risers) {
    Arena arena;
    Ground& ground = arena.ground;
    ground.name = "arena";
    float highest = 0;
    for (const FloorQuad& floor : floors) {
        const auto base = static_cast<uint32_t>(ground.vertices.size());
        for (const Vec3 corner : floor.corners) {
            ground.vertices.push_back(corner);
            highest = std::max(highest, corner.y);
        }
        for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) ground.indices.push_back(base + i);
        ground.kinds.insert(ground.kinds.end(), 2, floor.kind);
    }
    arena.area = walkable_area(ground);
    ground.faces.assign(risers.begin(), risers.end());
    for (const WalkablePolygon& polygon : arena.area) {
        add_walls(ground, polygon.outer);
        for (const std::vector<Vec2>& hole : polygon.holes) add_walls(ground, hole);
    }
    for (Face& face : ground.faces)
        if (face.kind == FaceKind::facade) face.a_top = face.b_top = highest + k_wall_height;
    index_ground(ground);
    return arena;
}

Arena make_arena(std::span<const Rectangle> floors) {
    std::vector<FloorQuad> quads;
    for (const Rectangle& floor : floors) quads.push_back(floor_of(floor));
    return make_arena(quads);
}

NavmeshSettings arena_mesh() {
    NavmeshSettings settings;
    settings.cell = 0.05f;
    settings.agent_radius = 0.2f;
    return settings;
}

bool is_on(const Arena& arena, Vec2 place) {
    return std::any_of(arena.area.begin(), arena.area.end(), [&](const WalkablePolygon& polygon) {
        return is_within(polygon.outer, place) &&
               std::none_of(polygon.holes.begin(), polygon.holes.end(),
                            [&](const std::vector<Vec2>& hole) { return is_within(hole, place); });
    });
}

}  // namespace flaneur
