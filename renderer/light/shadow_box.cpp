#include "renderer/light/shadow_box.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

Slice fine_shadow_slice(const View& view, float height) {
    constexpr float highest = 8000;
    height = std::clamp(height, 0.0f, highest);
    const float step = std::max(std::exp2(std::floor(std::log2(std::max(height, 1.0f)))) / 32, 4.0f);
    const float h = std::floor(height / step) * step;
    const float fall = -(view.forward.y + view.down.y);  // of the lowest ray, for each metre ahead
    float near = 2 * h;
    if (fall > 0) near = std::min(near, std::floor(0.8f * h / fall / step) * step);
    // Maps, which are looked at from straight above: no farther than the ground, and from roofs and hills on.
    constexpr float plunging = 0.9f;
    const float least_fall = -(view.forward.y - view.down.y);
    if (least_fall > plunging)
        return {std::floor(0.5f * h / step) * step,
                std::ceil(1.02f * height / least_fall / step) * step + step};
    return {near, std::max(60 + 3 * h, near + 60)};
}

Slice far_shadow_slice(Slice fine) {
    float far = 250;
    while (far < 1.3f * fine.far) far *= 2;
    return {0, far};
}

namespace {

constexpr float k_depth = 1.4f;  // of a box, against its edges: it seldom needs to move along the light

constexpr float k_ball_step = 8;  // metres between radii, so that lenses that change a little keep theirs

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
            std::ceil(std::sqrt(rest * rest + spread * slice.far * slice.far) / k_ball_step) * k_ball_step};
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
    // From the axis' coordinate to 0..1 over so many metres about the ball, in steps.
    auto row = [&, middle = centre](glm::vec3 axis, float size, float by) {
        const float snapped = std::round(glm::dot(axis, middle) / by) * by;
        return glm::vec4(axis / size, 0.5f - snapped / size);
    };
    const float deep = box.size * k_depth;
    box.map_from_world = from_rows(row(u, box.size, step), row(v, box.size, step),
                                   row(-to_sun, deep, (deep - 2 * radius) / 2), {0, 0, 0, 1});
    return box;
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
