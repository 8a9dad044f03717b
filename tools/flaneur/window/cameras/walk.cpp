#include "tools/flaneur/window/cameras/walk.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {
namespace {

constexpr float k_pace = 1.8f, k_run = 5;    // metres a second
constexpr float k_quickness = 9;             // how fast one gets up to it, 1/s
constexpr float k_climb = 11;                // stiffness of the eye's height
constexpr float k_crouch = 1.2f;             // metres that the eye is above the ground in any case
constexpr float k_step_seconds = 1.0f / 30;  // at a time: never so far as past a wall
constexpr float k_longest = 0.25f;           // seconds that are made up for
constexpr float k_steepest = 1.5f;           // radians

std::optional<GroundHit> ground_under(const World& world, Vec3 at) {
    constexpr float k_up = 0.6f, k_down = 1.5f;  // how far the mesh may be off
    return ground_at(*world.ground, at, k_up, k_down);
}

float ground_height(const World& world, Vec3 at) {
    const auto hit = ground_under(world, at);
    return hit ? hit->height : at.y;
}

// A step on the mesh, which is coarser than the ground and may reach beyond it: never there.
NavPoint stepped(const World& world, NavPoint from, Vec2 step) {
    for (const Vec2 tried : {step, Vec2{step.x, 0}, Vec2{0, step.z}}) {
        const NavPoint to = move_along(*world.navmesh, 0, from, from.position + at_height(tried, 0));
        if (ground_under(world, to.position)) return to;
    }
    return from;
}

std::optional<NavPoint> near(const World& world, Vec3 place) {
    // Farther up, for who looks at a facade, or down at a house.
    for (const Vec3 reach : {Vec3{3, 3, 3}, Vec3{12, 60, 12}, Vec3{40, 20'000, 40}})
        if (const auto found = nearest(*world.navmesh, 0, place, reach)) return found;
    return {};
}

}  // namespace

std::optional<Stroll> set_foot(const World& world, const Camera& camera) {
    constexpr float k_on_foot = 6, k_sight = 1500;  // metres
    if (!world.navmesh || world.roam) return {};
    const Gaze gaze = gaze_of(camera);
    std::optional<NavPoint> at;
    if (const auto hit = ground_at(*world.ground, gaze.eye, 0.3f, k_on_foot))
        at = near(world, {gaze.eye.x, hit->height, gaze.eye.z});
    if (!at) {
        const glm::vec3 way = glm::normalize(camera.target - camera.eye);
        const Vec3 ahead{way.x, way.y, way.z};
        const auto hit = raycast(*world.ground, gaze.eye, ahead, k_sight);
        // Before a wall, not behind it.
        if (hit) at = near(world, gaze.eye + ahead * std::max(hit->distance - 0.5f, 0.0f));
    }
    if (!at) at = near(world, gaze.eye);
    if (!at) return {};
    Stroll walk;
    walk.at = *at;
    walk.height.value = ground_height(world, at->position) + k_walking_eye;
    walk.yaw = gaze.yaw;
    // One who comes down from the sky looks ahead.
    walk.pitch = gaze.eye.y - walk.height.value < k_on_foot ? std::clamp(gaze.pitch, -0.6f, 0.6f) : 0;
    return walk;
}

bool walk(const World& world, const Steering& hands, float seconds, Stroll& walk) {
    const Stroll before = walk;
    walk.yaw = wrap_angle(walk.yaw + hands.turn);
    walk.pitch = std::clamp(walk.pitch + hands.tilt, -k_steepest, k_steepest);
    const Vec2 ahead = heading_direction(walk.yaw), left{ahead.z, -ahead.x};
    Vec2 wish = ahead * hands.ahead + left * hands.left;
    if (const float most = length(wish); most > 1) wish = wish / most;
    wish = wish * (hands.is_fast ? k_run : k_pace);
    for (float rest = std::min(seconds, k_longest); rest > 1e-6f; rest -= k_step_seconds) {
        const float dt = std::min(rest, k_step_seconds);
        walk.velocity += (wish - walk.velocity) * (1 - std::exp(-k_quickness * dt));
        if (wish == Vec2{} && length(walk.velocity) < 0.02f) walk.velocity = {};
        const Vec3 from = walk.at.position;
        if (!(walk.velocity == Vec2{})) walk.at = stepped(world, walk.at, walk.velocity * dt);
        walk.velocity = on_ground(walk.at.position - from) / dt;  // walls take what goes against them
        const float ground = ground_height(world, walk.at.position);
        draw_towards(walk.height, ground + k_walking_eye, k_climb, dt);
        walk.height.value = std::max(walk.height.value, ground + k_crouch);
    }
    return !(walk.at.position == before.at.position) || walk.yaw != before.yaw ||
           walk.pitch != before.pitch || std::fabs(walk.height.value - before.height.value) > 1e-4f;
}

Gaze gaze_of(const Stroll& walk, float fov) {
    const Vec3 at = walk.at.position;
    return {{at.x, walk.height.value, at.z}, walk.yaw, walk.pitch, fov};
}

}  // namespace flaneur
