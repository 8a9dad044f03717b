#include "renderer/view.h"

#include <algorithm>
#include <cmath>

namespace flaneur {
namespace {

constexpr float k_least_tan_elevation = 0.1f;  // shadows are not followed farther than ten times the body

bool is_finite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

glm::vec4 plane_through(glm::vec3 point, glm::vec3 normal) {
    normal = glm::normalize(normal);
    return {normal, -glm::dot(normal, point)};
}

}  // namespace

glm::mat4 from_rows(glm::vec4 a, glm::vec4 b, glm::vec4 c, glm::vec4 d) {
    return glm::transpose(glm::mat4(a, b, c, d));
}

glm::vec3 level_across(glm::vec3 v) {
    const glm::vec3 across = glm::cross(v, glm::vec3(0, 1, 0));
    const float length = glm::length(across);
    return length > 1e-4f ? across / length : glm::vec3(1, 0, 0);
}

View make_view(const Camera& camera, uint32_t width, uint32_t height) {
    const bool is_sane = is_finite(camera.eye) && is_finite(camera.target);
    const glm::vec3 eye = is_sane ? camera.eye : Camera{}.eye;
    const glm::vec3 target = is_sane ? camera.target : Camera{}.target;
    const float fov =
        std::isfinite(camera.vertical_fov) ? std::clamp(camera.vertical_fov, 0.01f, 3.0f) : 0.6f;
    const float near_plane = std::isfinite(camera.near_plane) ? std::max(camera.near_plane, 1e-3f) : 0.1f;

    const float distance = glm::length(target - eye);
    const glm::vec3 forward = distance > 1e-6f ? (target - eye) / distance : glm::vec3(0, 0, 1);
    const bool is_usual = camera.up == glm::vec3(0, 1, 0) || !is_finite(camera.up);
    const glm::vec3 across = glm::cross(forward, camera.up);
    const bool is_level = is_usual || !(glm::length(across) > 1e-4f);
    const glm::vec3 right = is_level ? level_across(forward) : glm::normalize(across);
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

bool is_cut(const View& before, const View& now) {
    constexpr float farthest = 3, widest = 1.05f;  // metres; factor on the size of what is seen
    const float zoom = now.pixels_at_one_metre / before.pixels_at_one_metre;
    return !(glm::length(now.eye - before.eye) <= farthest && zoom <= widest && zoom >= 1 / widest);
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

float pixels_of(const View& view, glm::vec3 centre, float radius) {
    return 2 * radius * view.pixels_at_one_metre / glm::length(centre - view.eye);
}

BodySphere with_shadow(glm::vec3 centre, float radius, glm::vec3 to_sun) {
    const float across = std::sqrt(to_sun.x * to_sun.x + to_sun.z * to_sun.z);
    const float fall = 2 * radius / std::max(to_sun.y / std::max(across, 1e-3f), k_least_tan_elevation);
    return {centre - glm::vec3(to_sun.x, 0, to_sun.z) * (fall / 2), radius + fall / 2};
}

bool needs_pose(const PoseNeeds& needs, glm::vec3 centre, float radius) {
    if (!(pixels_of(needs.view, centre, radius) >= needs.pixels)) return false;
    const BodySphere both = with_shadow(centre, radius, needs.to_sun);
    return sees_sphere(needs.view, both.centre, both.radius);
}

}  // namespace flaneur
