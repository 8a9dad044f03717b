#include "tools/flaneur/window/cameras/glide.h"

#include <algorithm>
#include <cmath>

#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/rig.h"

namespace flaneur {
namespace {

bool is_map(const Camera& camera) { return camera.clear_air > 0; }

// Heights over a map's ground go by factors, as distances of a zoom do.
float height_between(const Glide& glide, float share) {
    const float ground = (is_map(glide.to) ? glide.to : glide.from).target.y;
    const float from = std::max(glide.from.eye.y - ground, 1.0f),
                to = std::max(glide.to.eye.y - ground, 1.0f);
    return ground + from * std::pow(to / from, share);
}

Vec3 eye_at(const Glide& glide, float share) {
    const glm::vec3 straight = glm::mix(glide.from.eye, glide.to.eye, share);
    Vec3 eye{straight.x, straight.y + glide.rise * 4 * share * (1 - share), straight.z};
    if (is_map(glide.from) || is_map(glide.to)) eye.y = height_between(glide, share);
    return eye;
}

bool is_free(const Glide& glide, const Ground& ground) {
    constexpr int k_pieces = 8;
    Vec3 last = eye_at(glide, 0);
    for (int i = 1; i <= k_pieces; ++i) {
        const Vec3 next = eye_at(glide, static_cast<float>(i) / k_pieces);
        if (!sees(ground, last, next)) return false;
        last = next;
    }
    return true;
}

}  // namespace

void begin(Glide& glide, const World& world, const Camera& from, const Camera& to) {
    constexpr float k_rises[] = {0, 0.15f, 0.3f, 0.5f, 0.8f};  // of the distance
    constexpr float k_near = 2;                                // metres that need no way round
    glide = {from, to, 0, 0};
    const float distance = glm::length(to.eye - from.eye);
    if (is_map(from) || is_map(to) || world.roam || distance < k_near) return;
    for (const float rise : k_rises) {
        glide.rise = rise * distance;
        if (is_free(glide, *world.ground)) break;
    }
}

Camera camera_of(const Glide& glide) {
    if (!is_gliding(glide)) return glide.to;
    const float share = smoothstep(0, k_glide_seconds, glide.passed);
    const glm::vec3 usual(0, 1, 0);
    if (glide.from.up != usual || glide.to.up != usual) return mixed_camera(glide.from, glide.to, share);
    Gaze gaze = between(gaze_of(glide.from), gaze_of(glide.to), share);
    gaze.eye = eye_at(glide, share);
    Camera camera = camera_of(gaze);
    camera.clear_air = glm::mix(glide.from.clear_air, glide.to.clear_air, share);
    return camera;
}

}  // namespace flaneur
