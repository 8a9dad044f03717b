#include "renderer/view.h"

#include <algorithm>
#include <cmath>

namespace flaneur {
namespace {

bool is_finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

glm::mat4 from_rows(glm::vec4 a, glm::vec4 b, glm::vec4 c, glm::vec4 d) {
    return glm::transpose(glm::mat4(a, b, c, d));
}

// A unit vector square to `v`, level where that is possible.
glm::vec3 level_across(glm::vec3 v) {
    const glm::vec3 across = glm::cross(v, glm::vec3(0, 1, 0));
    const float length = glm::length(across);
    return length > 1e-4f ? across / length : glm::vec3(1, 0, 0);
}

glm::vec4 plane_through(glm::vec3 point, glm::vec3 normal) {
    normal = glm::normalize(normal);
    return {normal, -glm::dot(normal, point)};
}

}  // namespace

View make_view(const Camera& camera, uint32_t width, uint32_t height) {
    const bool is_sane = is_finite(camera.eye) && is_finite(camera.target);
    const glm::vec3 eye = is_sane ? camera.eye : Camera{}.eye;
    const glm::vec3 target = is_sane ? camera.target : Camera{}.target;
    const float fov =
        std::isfinite(camera.vertical_fov) ? std::clamp(camera.vertical_fov, 0.01f, 3.0f) : 0.6f;
    const float near_plane = std::isfinite(camera.near_plane) ? std::max(camera.near_plane, 1e-3f) : 0.1f;

    const float distance = glm::length(target - eye);
    const glm::vec3 forward = distance > 1e-6f ? (target - eye) / distance : glm::vec3(0, 0, 1);
    const glm::vec3 right = level_across(forward);
    const glm::vec3 up = glm::cross(right, forward);
    const float tan_y = std::tan(fov / 2);
    const float tan_x = tan_y * static_cast<float>(width) / static_cast<float>(height);

    View view;
    auto row = [&](glm::vec3 axis, float scale) {
        return glm::vec4(axis * scale, -glm::dot(axis, eye) * scale);
    };
    view.clip_from_world =
        from_rows(row(right, 1 / tan_x), row(up, -1 / tan_y), {0, 0, 0, near_plane}, row(forward, 1));
    view.eye = eye;
    view.forward = forward;
    view.right = right * tan_x;
    view.down = up * -tan_y;
    view.pixels_at_one_metre = static_cast<float>(height) / (2 * tan_y);
    view.planes = {plane_through(eye, forward * tan_x + right), plane_through(eye, forward * tan_x - right),
                   plane_through(eye, forward * tan_y - up), plane_through(eye, forward * tan_y + up),
                   plane_through(eye + forward * near_plane, forward)};
    return view;
}

glm::vec3 sun_direction(const Sun& sun) {
    glm::vec3 direction = sun.direction;
    const float length = glm::length(direction);
    if (!std::isfinite(length) || length < 1e-6f) direction = Sun{}.direction;
    return glm::normalize(direction);
}

glm::vec3 above_horizon(glm::vec3 direction, float lowest) {
    if (direction.y >= std::sin(lowest)) return direction;
    const glm::vec3 level(direction.x, 0, direction.z);
    const float across = glm::length(level);
    return (across > 1e-6f ? level / across : glm::vec3(1, 0, 0)) * std::cos(lowest) +
           glm::vec3(0, std::sin(lowest), 0);
}

Slice fine_shadow_slice(const View& view, float height) {
    constexpr float step = 4;
    const float h = std::clamp(std::floor(height / step) * step, 0.0f, 200.0f);
    const float fall = -(view.forward.y + view.down.y);  // of the lowest ray, for each metre ahead
    float near = 2 * h;
    if (fall > 0) near = std::min(near, std::floor(0.8f * h / fall / step) * step);
    return {near, std::max(60 + 3 * h, near + 60)};
}

ShadowBox fit_shadow(const View& view, glm::vec3 to_sun, Slice slice, uint32_t resolution) {
    // The sphere through the corners of both ends, or about the far end if that is smaller.
    const float spread = glm::dot(view.right, view.right) + glm::dot(view.down, view.down);
    const float ahead = std::min((slice.near + slice.far) / 2 * (1 + spread), slice.far);
    const glm::vec3 centre = view.eye + view.forward * ahead;
    const float rest = slice.far - ahead;
    const float radius = std::ceil(std::sqrt(rest * rest + spread * slice.far * slice.far));

    ShadowBox box;
    const float step_wish = radius / 8;
    box.size = 2 * radius + 2 * step_wish;
    box.texel = box.size / static_cast<float>(resolution);
    const float step = std::max(std::floor(step_wish / box.texel), 1.0f) * box.texel;
    const glm::vec3 u = level_across(to_sun), v = glm::cross(u, to_sun);
    auto snapped = [&](glm::vec3 axis) { return std::round(glm::dot(axis, centre) / step) * step; };
    // From the axis' coordinate to 0..1 over the box.
    auto row = [&](glm::vec3 axis) { return glm::vec4(axis / box.size, 0.5f - snapped(axis) / box.size); };
    box.map_from_world = from_rows(row(u), row(v), row(-to_sun), {0, 0, 0, 1});
    return box;
}

bool sees_sphere(const View& view, glm::vec3 centre, float radius) {
    return std::all_of(view.planes.begin(), view.planes.end(), [&](const glm::vec4& plane) {
        return glm::dot(glm::vec3(plane), centre) + plane.w >= -radius;
    });
}

bool sees_box(const View& view, glm::vec3 low, glm::vec3 high) {
    return std::all_of(view.planes.begin(), view.planes.end(), [&](const glm::vec4& plane) {
        const glm::vec3 normal(plane);
        const glm::vec3 farthest(normal.x > 0 ? high.x : low.x, normal.y > 0 ? high.y : low.y,
                                 normal.z > 0 ? high.z : low.z);
        return glm::dot(normal, farthest) + plane.w >= 0;
    });
}

bool casts_into(const ShadowBox& box, glm::vec3 low, glm::vec3 high) {
    const glm::vec3 centre = (low + high) * 0.5f, half = (high - low) * 0.5f;
    const glm::vec3 middle(box.map_from_world * glm::vec4(centre, 1));
    glm::vec3 reach(0);
    for (int axis = 0; axis < 3; ++axis) reach += glm::abs(glm::vec3(box.map_from_world[axis])) * half[axis];
    return middle.x + reach.x >= 0 && middle.x - reach.x <= 1 && middle.y + reach.y >= 0 &&
           middle.y - reach.y <= 1 && middle.z - reach.z <= 1;
}

bool casts_into(const ShadowBox& box, glm::vec3 centre, float radius) {
    const glm::vec3 middle(box.map_from_world * glm::vec4(centre, 1));
    const float reach = radius / box.size;
    return middle.x + reach >= 0 && middle.x - reach <= 1 && middle.y + reach >= 0 && middle.y - reach <= 1 &&
           middle.z - reach <= 1;
}

}  // namespace flaneur
