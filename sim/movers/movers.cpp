#include "sim/movers/movers.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_steepest = 0.5f;  // the least y of a normal that bears

float reach_of(const MoverSolid& solid) { return length(solid.middle) + length(solid.half); }

// Where a ray goes in, `along` it, and the normal there.
struct Entry {
    float along;
    Vec3 normal;
};

std::optional<Entry> entry(const MoverSolid& solid, Vec3 from, Vec3 way) {
    const float start[] = {from.x, from.y, from.z}, step[] = {way.x, way.y, way.z},
                half[] = {solid.half.x, solid.half.y, solid.half.z};
    if (solid.form == MoverSolid::Form::cylinder) {
        if (way.y == 0) return std::nullopt;
        const float side = way.y < 0 ? 1.0f : -1.0f, along = (side * solid.half.y - from.y) / way.y;
        const Vec3 at = from + way * along;
        if (at.x * at.x + at.z * at.z > solid.half.x * solid.half.x) return std::nullopt;
        return Entry{along, {0, side, 0}};
    }
    constexpr float k_far = 1e9f;
    float in = -k_far, out = k_far;
    int face = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(step[axis]) < 1e-9f) {
            if (std::fabs(start[axis]) > half[axis]) return std::nullopt;
            continue;
        }
        const float a = (-half[axis] - start[axis]) / step[axis], b = (half[axis] - start[axis]) / step[axis];
        if (std::min(a, b) > in) in = std::min(a, b), face = axis;
        out = std::min(out, std::max(a, b));
    }
    if (in > out) return std::nullopt;
    const float side = step[face] < 0 ? 1.0f : -1.0f;
    return Entry{in, {face == 0 ? side : 0, face == 1 ? side : 0, face == 2 ? side : 0}};
}

}  // namespace

Placement placement_between(const Placement& before, const Placement& last, float between) {
    return {lerp(before.position, last.position, between), nlerp(before.turn, last.turn, between)};
}

Placement placement_at(const Mover& mover, uint32_t tick) {
    const Vec3 angles = sway_at(mover.angles, tick);
    return {sway_at(mover.place, tick),
            normalize(rotation_y(angles.y) * rotation_z(angles.z) * rotation_x(angles.x))};
}

Movers make_movers(std::vector<Mover> all) {
    Movers movers;
    movers.all = std::move(all);
    for (const Mover& mover : movers.all) {
        float radius = 0;
        for (const MoverSolid& solid : mover.solids) radius = std::max(radius, reach_of(solid));
        movers.radius.push_back(radius);
        movers.places.push_back(mover.kind == Mover::Kind::led ? mover.at_first : placement_at(mover, 0));
    }
    forget_previous(movers);
    return movers;
}

void step_movers(Movers& movers, uint32_t tick) {
    std::ranges::copy(movers.places, movers.previous_places.begin());
    for (size_t i = 0; i < movers.all.size(); ++i)
        if (movers.all[i].kind == Mover::Kind::by_itself)
            movers.places[i] = placement_at(movers.all[i], tick + 1);
}

void forget_previous(Movers& movers) { movers.previous_places = movers.places; }

std::optional<MoverHit> mover_below(const Movers& movers, Vec3 point, float up, float down) {
    const Vec3 from{point.x, point.y + up, point.z};
    const float reach = up + down;
    std::optional<MoverHit> best;
    for (uint32_t i = 0; i < movers.all.size(); ++i) {
        const Placement& place = movers.places[i];
        const float radius = movers.radius[i];
        if (length_squared(on_ground(place.position - point)) > radius * radius) continue;
        const Quat back = conjugate(place.turn);
        const Vec3 own_from = rotate(back, from - place.position), own_way = rotate(back, {0, -1, 0});
        for (const MoverSolid& solid : movers.all[i].solids) {
            if (!solid.bears) continue;
            const Quat home = conjugate(solid.turn);
            const auto hit = entry(solid, rotate(home, own_from - solid.middle), rotate(home, own_way));
            if (!hit || hit->along < 0 || hit->along > reach) continue;
            const Vec3 normal = rotate(place.turn, rotate(solid.turn, hit->normal));
            const float height = from.y - hit->along;
            if (normal.y < k_steepest || (best && best->point.y >= height)) continue;
            best = MoverHit{i, {point.x, height, point.z}, normal};
        }
    }
    return best;
}

Surroundings surroundings_of(const MovingGround& ground) {
    Surroundings around;
    around.asked = &ground;
    around.ground = [](const void* asked, std::span<const Vec3> points, float up, float down,
                       std::optional<GroundHit>* hits) {
        const auto& both = *static_cast<const MovingGround*>(asked);
        ground_at(*both.ground, points, up, down, hits);
        for (size_t i = 0; i < points.size(); ++i)
            if (const auto hit = mover_below(*both.movers, points[i], up, down);
                hit && (!hits[i] || hits[i]->height < hit->point.y))
                hits[i] = GroundHit{hit->point.y, hit->normal, Surface::plaza};
    };
    around.wall = [](const void* asked, Vec3 point, float radius) {
        return closest_wall(*static_cast<const MovingGround*>(asked)->ground, point, radius);
    };
    return around;
}

}  // namespace flaneur
