// From the wanted velocity to one that avoids the others and the border of the mesh.
#include <algorithm>
#include <cmath>

#include "sim/crowd/crowd.h"
#include "sim/crowd/deciders.h"
#include "sim/crowd/half_planes.h"

namespace flaneur {

static constexpr float k_horizon = 1.5f;         // seconds within which no one shall be met
static constexpr float k_untangle = 0.3f;        // seconds to end an overlap in
static constexpr float k_margin = 0.04f;         // metres kept between bodies
static constexpr float k_border_horizon = 0.2f;  // seconds to the border
static constexpr float k_border_reach = 1;       // metres
static constexpr int k_borders = 6;
static constexpr float k_headway = 0.5f;      // seconds: a walker needs this long to cover the gap ahead
static constexpr float k_keep_right = 0.15f;  // of the speed, where others come the other way
static constexpr float k_patience = 0.7f;     // seconds without getting nearer before one gives way
static constexpr float k_give_way = 0.6f;     // of the speed, to the right, for each second of that
static constexpr float k_haste = 1.1f;        // times the preferred speed, at most

// Walkers who meet head-on must not both wait: half the change each, on the side where it is smallest.
static HalfPlane avoid(Vec2 between, Vec2 velocity, Vec2 other_velocity, float radius) {
    Vec2 relative = velocity - other_velocity, change;
    Vec2 normal;
    float distance_squared = length_squared(between);
    float horizon = distance_squared > radius * radius ? k_horizon : k_untangle;
    Vec2 w = relative - between / horizon;  // from the centre of the cut-off circle
    float along = dot(w, between);
    if (distance_squared <= radius * radius ||
        (along < 0 && along * along > radius * radius * length_squared(w))) {
        float l = length(w);
        // Two at one place and speed: apart along x, each its way would need an id; the push of `move` parts
        // them.
        normal = l > 1e-6f ? w / l : Vec2{1, 0};
        change = normal * (radius / horizon - l);
    } else {
        // The nearer leg of the cone that touches the other's circle.
        float leg = std::sqrt(distance_squared - radius * radius);
        Vec2 side;
        if (cross(between, w) > 0) {
            side = Vec2{between.x * leg - between.z * radius, between.x * radius + between.z * leg} /
                   distance_squared;
            normal = {-side.z, side.x};
        } else {
            side = Vec2{between.x * leg + between.z * radius, -between.x * radius + between.z * leg} /
                   distance_squared;
            normal = {side.z, -side.x};
        }
        change = side * dot(relative, side) - relative;
    }
    return {normal, dot(velocity + change * 0.5f, normal)};
}

// V(s) = (s - l) / T with s the distance to the first body in the way (Tordeux, Chraibi and Seyfried 2016,
// without their force: ORCA has done that). Those who walk ahead at a like speed leave room as they go.
static float headway_speed(const Crowd& c, uint32_t i, Vec2 direction) {
    float speed = 1e9f;
    const uint32_t* ids = &c.neighbours[size_t{i} * k_neighbours];
    for (int k = 0; k < c.neighbour_count[i]; ++k) {
        uint32_t j = ids[k];
        Vec2 between = on_ground(c.position[j] - c.position[i]);
        float ahead = dot(between, direction), aside = std::fabs(cross(direction, between));
        float l = room_between(c, i, j);
        if (ahead <= 0 || aside >= l) continue;
        float gap = ahead - std::sqrt(l * l - aside * aside);
        float leaving = std::max(0.0f, dot(c.velocity[j], direction));
        speed = std::min(speed, std::max(0.0f, gap / k_headway) + 0.9f * leaving);
    }
    return speed;
}

static Vec2 choose_velocity(const Crowd& c, const Navmesh& mesh, uint32_t i, uint32_t tick) {
    HalfPlane planes[k_borders + k_neighbours];
    Vec2 p = on_ground(c.position[i]), velocity = c.velocity[i], wish = c.wanted[i];

    int count = 0;
    BorderLine lines[k_borders];
    int borders = borders_near(mesh, c.position[i], k_border_reach, lines, k_borders);
    for (int b = 0; b < borders; ++b) {
        Vec2 a = on_ground(lines[b].a), ab = on_ground(lines[b].b) - a;
        float t = clamp(dot(p - a, ab) / length_squared(ab), 0, 1);
        Vec2 away = p - (a + ab * t), inward = normalize_or(Vec2{-ab.z, ab.x}, {0, 0});
        if (dot(away, inward) < -0.05f) continue;  // seen from behind: the border of another part of the mesh
        float distance = length(away);
        bool tip = t <= 0 || t >= 1;  // passed to either side
        if (tip && distance < 0.02f) continue;
        planes[count++] = {tip ? away / distance : inward, -distance / k_border_horizon};
    }
    int firm = count;

    const uint32_t* ids = &c.neighbours[size_t{i} * k_neighbours];
    float oncoming = 0;
    for (int k = 0; k < c.neighbour_count[i]; ++k) {
        uint32_t j = ids[k];
        Vec2 between = on_ground(c.position[j] - c.position[i]);
        // Those who slip past each other keep a smaller margin too.
        float radii = c.radius[i] + c.radius[j], apart = room_between(c, i, j);
        apart += k_margin * apart / radii;
        planes[count++] = avoid(between, velocity, c.velocity[j], apart);
        if (dot(c.velocity[j], wish) < 0 && dot(between, wish) > 0) oncoming = 1;
    }
    // Those who do not get on in a jam give way to the right, ever more, until two streams have sorted
    // themselves.
    float waited = static_cast<float>(tick - c.closest_tick[i]) * k_tick;
    float right = oncoming * (k_keep_right + k_give_way * clamp(waited - k_patience, 0, 2));
    wish += Vec2{-wish.z, wish.x} * right;

    float most = std::max(c.preferred_speed[i], 0.3f) * k_haste;
    Vec2 v = best_velocity(planes, count, firm, most, wish);
    float speed = length(v);
    if (speed < 1e-4f) return {0, 0};
    return v * std::min(1.0f, headway_speed(c, i, v / speed) / speed);
}

void steer(Crowd& c, const Navmesh& mesh, Workers& workers, uint32_t tick) {
    for_deciders(c, workers, tick, [&](uint32_t i) { c.chosen[i] = choose_velocity(c, mesh, i, tick); });
}

}  // namespace flaneur
