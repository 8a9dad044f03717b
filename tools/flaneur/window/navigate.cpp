#include "tools/flaneur/window/navigate.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/window/cameras/map.h"
#include "tools/flaneur/window/pick.h"

namespace flaneur {
namespace {

constexpr float k_nowhere = 30;                   // metres: where nothing is met
constexpr float k_notch = 0.85f;                  // of the distance is left after one
constexpr float k_nearest = 0.6f;                 // metres before what is zoomed to
constexpr float k_turn = 0.005f;                  // radians a pixel
constexpr float k_side_pixels = 60;               // that one notch goes to the side
constexpr float k_level = 0.03f, k_steep = 1.5f;  // radians above and below a place that one looks at it from

glm::vec3 turned(glm::vec3 v, float yaw) {
    const SinCos a = sin_cos(yaw);
    return {v.x * a.cosine + v.z * a.sine, v.y, v.z * a.cosine - v.x * a.sine};
}

}  // namespace

glm::vec3 place_along(const World& world, const Camera& camera, glm::vec3 way) {
    float distance = k_nowhere;
    if (world.ground && !world.roam)
        if (const auto hit = raycast(*world.ground, {camera.eye.x, camera.eye.y, camera.eye.z},
                                     {way.x, way.y, way.z}, k_far_sight))
            distance = hit->distance;
    return camera.eye + way * distance;
}

void zoom(glm::vec3 place, float notches, Viewer& v) {
    const glm::vec3 to = place - v.camera.eye;
    const float distance = glm::length(to);
    if (notches == 0 || !(distance > 1e-3f)) return;
    float left = distance * std::pow(k_notch, notches);
    if (notches > 0) left = std::max(left, std::min(k_nearest, distance));
    take_off(v);
    const glm::vec3 step = to * ((distance - left) / distance);
    v.camera.eye += step, v.camera.target += step;
}

void pan(glm::vec3 place, glm::vec2 from, glm::vec2 to, Size size, Viewer& v) {
    if (from == to) return;
    const glm::vec3 ahead = glm::normalize(v.camera.target - v.camera.eye);
    const float depth = std::max(glm::dot(place - v.camera.eye, ahead), k_nearest);
    const glm::vec3 before = ray_through(v.camera, size, from), after = ray_through(v.camera, size, to);
    const glm::vec3 step = (before / glm::dot(before, ahead) - after / glm::dot(after, ahead)) * depth;
    take_off(v);
    v.camera.eye += step, v.camera.target += step;
}

void orbit(glm::vec3 place, glm::vec2 pixels, Viewer& v) {
    if (pixels == glm::vec2(0)) return;
    const glm::vec3 out = v.camera.eye - place, ahead = glm::normalize(v.camera.target - v.camera.eye);
    const float distance = glm::length(out);
    if (!(distance > 1e-3f)) return;
    take_off(v);
    // The eye goes round the place, and what is looked at keeps its bearing against it.
    const float yaw = -pixels.x * k_turn;
    const glm::vec3 round = turned(out, yaw);
    const float flat = std::hypot(round.x, round.z), height = arctan2(round.y, flat);
    const float wanted =
        std::clamp(height + pixels.y * k_turn, std::min(height, k_level), std::max(height, k_steep));
    const SinCos up = sin_cos(wanted);
    const glm::vec3 level =
        flat > 1e-4f ? glm::vec3(round.x / flat, 0, round.z / flat) : turned({0, 0, -1}, yaw);
    v.camera.eye = place + distance * (level * up.cosine + glm::vec3(0, up.sine, 0));
    const glm::vec3 way = turned(ahead, yaw);
    const float way_flat = std::hypot(way.x, way.z);
    const float pitch = std::clamp(arctan2(way.y, way_flat) - (wanted - height), -k_steep, k_steep);
    const SinCos down = sin_cos(pitch);
    const glm::vec3 along = way_flat > 1e-4f ? glm::vec3(way.x / way_flat, 0, way.z / way_flat) : -level;
    v.camera.target = v.camera.eye + along * down.cosine + glm::vec3(0, down.sine, 0);
}

// Where the cursor is, clockwise about the picture's middle, radians.
static float bearing_on_screen(glm::vec2 pixel, Size size) {
    return arctan2(pixel.y - 0.5f * static_cast<float>(size.height),
                   pixel.x - 0.5f * static_cast<float>(size.width));
}

static bool navigate_map(const Mouse& before, const Mouse& now, Wheel wheel, Size size, glm::vec2 from,
                         glm::vec2 to, CameraChoice& map) {
    const CameraChoice was = map;
    if (wheel.away != 0) zoom_map(map, size, to, wheel.away);
    if (wheel.right != 0) pan_map(map, size, {k_side_pixels * wheel.right, 0}, {0, 0});
    if ((before.is_held && now.is_held) || (before.pans && now.pans)) pan_map(map, size, from, to);
    if (before.orbits && now.orbits)
        turn_map(map, wrap_angle(bearing_on_screen(from, size) - bearing_on_screen(to, size)));
    return map != was;
}

bool navigate(const World& world, const Mouse& before, const Mouse& now, Wheel wheel, Size size, Grip& grip,
              Viewer& v) {
    if (size.width <= 0 || size.height <= 0) return false;
    const glm::vec2 from(static_cast<float>(before.x), static_cast<float>(before.y));
    const glm::vec2 to(static_cast<float>(now.x), static_cast<float>(now.y));
    if (v.choice.kind == CameraChoice::Kind::map)
        return navigate_map(before, now, wheel, size, from, to, v.choice);
    auto under = [&](glm::vec2 pixel) {
        return place_along(world, v.camera, ray_through(v.camera, size, pixel));
    };
    const glm::vec3 eye = v.camera.eye, target = v.camera.target;
    if (wheel.away != 0) zoom(under(to), wheel.away, v);
    if (wheel.right != 0) pan(under(to), to, to - glm::vec2(k_side_pixels * wheel.right, 0), size, v);
    if (!now.pans && !now.orbits)
        grip.place.reset();
    else if (!grip.place)
        grip.place = under(to);
    else if (now.pans)
        pan(*grip.place, from, to, size, v);
    else
        orbit(*grip.place, to - from, v);
    return eye != v.camera.eye || target != v.camera.target;
}

}  // namespace flaneur
