#include "tools/flaneur/window/pick.h"

#include <algorithm>
#include <cmath>

#include "renderer/view.h"

namespace flaneur {
namespace {

constexpr float k_girth = 0.27f, k_inside = 0.42f;  // of a body, metres

// How near a way from `eye` gets to an upright stretch of `height` above `foot`, and how far along the way
// that is. The nearest points of two lines, each held within its end.
struct Meeting {
    float apart, along;
};
Meeting meeting(glm::vec3 eye, glm::vec3 way, glm::vec3 foot, float height) {
    const glm::vec3 between = eye - foot;
    const float slope = way.y, flat = 1 - slope * slope;
    float up = flat > 1e-6f ? (between.y - slope * glm::dot(between, way)) / flat : 0;
    up = std::clamp(up, 0.0f, height);
    const glm::vec3 point = foot + glm::vec3(0, up, 0);
    const float along = std::max(glm::dot(point - eye, way), 0.0f);
    return {glm::length(eye + way * along - point), along};
}

}  // namespace

glm::vec3 ray_through(const Camera& camera, Size size, glm::vec2 pixel) {
    const View view = make_view(camera, static_cast<uint32_t>(std::max(size.width, 1)),
                                static_cast<uint32_t>(std::max(size.height, 1)));
    const float x = 2 * (pixel.x + 0.5f) / static_cast<float>(size.width) - 1;
    const float y = 2 * (pixel.y + 0.5f) / static_cast<float>(size.height) - 1;
    return glm::normalize(view.forward + view.right * x + view.down * y);
}

std::optional<uint32_t> walker_along(const World& world, const Camera& camera, glm::vec3 way, float slack) {
    const Crowd& crowd = world.crowd;
    std::optional<uint32_t> nearest;
    float least = 1e9f;
    for (uint32_t i = 0; i < crowd.count; ++i) {
        if (!is_there(crowd, i)) continue;
        const Vec3 at = crowd.motion.position[i];
        const float height = world.kinds[crowd.identity.body[i]].body.height * crowd.identity.scale[i];
        // Nobody is seen from within.
        if (std::hypot(camera.eye.x - at.x, camera.eye.z - at.z) < k_inside &&
            camera.eye.y < at.y + height + k_inside)
            continue;
        const Meeting met = meeting(camera.eye, way, {at.x, at.y, at.z}, height);
        if (met.apart > k_girth + slack * met.along || met.along >= least || met.along < 1e-3f) continue;
        least = met.along;
        nearest = i;
    }
    if (!nearest || !world.ground) return nearest;
    const Vec3 eye{camera.eye.x, camera.eye.y, camera.eye.z};
    const bool is_hidden = raycast(*world.ground, eye, {way.x, way.y, way.z}, least - k_girth).has_value();
    return is_hidden ? std::nullopt : nearest;
}

}  // namespace flaneur
