// How feet find the ground and hands find walls: by a Ground, or by whatever another program has instead.
#pragma once

#include <optional>
#include <span>

#include "sim/ground/ground.h"

namespace flaneur {

// Two questions, of which `ground` must be set, answered on any thread at once, the same each time: nothing
// may be changed by asking. `asked` is handed back with each question.
struct Surroundings {
    const void* asked = nullptr;
    // For each of `points`, what ground_at(.., up, down) says: the highest ground between `down` metres below
    // the point and `up` above it, if there is any. Normals are unit vectors.
    void (*ground)(const void* asked, std::span<const Vec3> points, float up, float down,
                   std::optional<GroundHit>* hits) = nullptr;
    // The closest point of a wall within `radius` metres of a point. Null: there are no walls.
    std::optional<WallPoint> (*wall)(const void* asked, Vec3 point, float radius) = nullptr;
};

// Answers by `ground`, which must outlive what asks.
Surroundings surroundings_of(const Ground& ground);

std::optional<GroundHit> ground_at(const Surroundings& around, Vec3 point, float up = 0.5f, float down = 3);
void ground_at(const Surroundings& around, std::span<const Vec3> points, float up, float down,
               std::optional<GroundHit>* hits);
std::optional<WallPoint> closest_wall(const Surroundings& around, Vec3 point, float radius);
// The same of a wall that one is beside: none where that is a drop, as of a quay, and one is on the ground at
// its top.
std::optional<WallPoint> wall_beside(const Surroundings& around, Vec3 point, float radius);

}  // namespace flaneur
