#include "renderer/light/shadow_box.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

Slice fine_shadow_slice(const View& view, float height) {
    constexpr float step = 4;
    const float h = std::clamp(std::floor(height / step) * step, 0.0f, 200.0f);
    const float fall = -(view.forward.y + view.down.y);  // of the lowest ray, for each metre ahead
    float near = 2 * h;
    if (fall > 0) near = std::min(near, std::floor(0.8f * h / fall / step) * step);
    return {near, std::max(60 + 3 * h, near + 60)};
}

namespace {

struct Ball {
    glm::vec3 centre;
    float radius;
};

// Through the corners of both ends of a slice, or about the far end if that is smaller.
Ball ball_about(const View& view, Slice slice) {
    const float spread = glm::dot(view.right, view.right) + glm::dot(view.down, view.down);
    const float ahead = std::min((slice.near + slice.far) / 2 * (1 + spread), slice.far);
    const float rest = slice.far - ahead;
    return {view.eye + view.forward * ahead,
            std::ceil(std::sqrt(rest * rest + spread * slice.far * slice.far))};
}

// Whether a box lies like `wanted`, if elsewhere, and holds a ball.
bool holds(const ShadowBox& box, const ShadowBox& wanted, const Ball& ball) {
    if (box.size != wanted.size || glm::mat3(box.map_from_world) != glm::mat3(wanted.map_from_world))
        return false;
    const glm::vec3 off = glm::abs(glm::vec3(box.map_from_world * glm::vec4(ball.centre, 1)) - 0.5f);
    return std::max({off.x, off.y, off.z}) + ball.radius / box.size <= 0.5f;
}

}  // namespace

ShadowBox fit_shadow(const View& view, glm::vec3 to_sun, Slice slice, uint32_t resolution) {
    const auto [centre, radius] = ball_about(view, slice);
    ShadowBox box;
    const float step_wish = radius / 8;
    box.size = 2 * radius + 2 * step_wish;
    box.texel = box.size / static_cast<float>(resolution);
    const float step = std::max(std::floor(step_wish / box.texel), 1.0f) * box.texel;
    const glm::vec3 u = level_across(to_sun), v = glm::cross(u, to_sun);
    auto snapped = [&, middle = centre](glm::vec3 axis) {
        return std::round(glm::dot(axis, middle) / step) * step;
    };
    // From the axis' coordinate to 0..1 over the box.
    auto row = [&](glm::vec3 axis) { return glm::vec4(axis / box.size, 0.5f - snapped(axis) / box.size); };
    box.map_from_world = from_rows(row(u), row(v), row(-to_sun), {0, 0, 0, 1});
    return box;
}

ShadowBoxes move_shadows(const ShadowBoxes& held, const View& view, glm::vec3 to_sun, Slice near, Slice far,
                         uint32_t resolution) {
    ShadowBoxes now{fit_shadow(view, to_sun, near, resolution), fit_shadow(view, to_sun, far, resolution)};
    now.is_near_new = now.near != held.near;
    now.is_far_new = now.far != held.far;
    if (now.is_near_new && now.is_far_new) {
        if (holds(held.far, now.far, ball_about(view, far)))
            now.far = held.far, now.is_far_new = false;
        else if (holds(held.near, now.near, ball_about(view, near)))
            now.near = held.near, now.is_near_new = false;
    }
    return now;
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
