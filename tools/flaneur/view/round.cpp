#include "tools/flaneur/view/round.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/view/camera.h"

namespace flaneur {
namespace {

struct Followed {
    Vec3 place, up, ahead;
    float height = 1.7f;
};

Followed followed(const World& world, uint32_t who) {
    const SurfaceWalkers& w = world.roam->walkers;
    Followed f{w.position[who], w.up[who], w.ahead[who]};
    const Crowd& crowd = world.crowd;
    if (who < crowd.count)
        f.height = world.kinds[crowd.identity.body[who]].body.height * crowd.identity.scale[who];
    else
        f.height = 1.3f * world.roam->creatures[who - crowd.count].size;
    return f;
}

Vec3 square(Vec3 v, Vec3 up, Vec3 otherwise) { return normalize_or(v - up * dot(v, up), otherwise); }

// A share of the way from one unit vector to another; where they are opposite by way of `aside`.
Vec3 part_of_way(Vec3 from, Vec3 to, Vec3 aside, float share) {
    constexpr float k_opposite = -0.995f;
    const float angle = arccos(clamp(dot(from, to), -1, 1));
    return turned_towards(from, dot(from, to) < k_opposite ? aside : to, angle * share);
}

}  // namespace

void follow_round(RoundRig& rig, const World& world, uint32_t who, bool is_new, float seconds) {
    constexpr float k_place = 10, k_up = 2.6f, k_ahead = 2, k_in = 12, k_out = 2;  // a second
    constexpr float k_behind = 2.3f, k_high = 1.75f, k_aside = 0.25f;              // of the height: the eye,
    constexpr float k_look = 0.5f, k_look_ahead = 0.5f;                            // and what it looks at
    constexpr float k_clear = 0.3f;                                                // metres
    const Followed f = followed(world, who);
    if (is_new) {
        rig.place = f.place, rig.up = f.up, rig.ahead = f.ahead;
    } else {
        // The middle of the body, about which one turns in the air, stays in the picture.
        const float middle = world.roam->walkers.middle[who];
        const Vec3 here = f.place + (f.up - rig.up) * middle;
        rig.place = rig.place + (here - rig.place) * std::min(k_place * seconds, 1.0f);
        rig.up = part_of_way(rig.up, f.up, f.ahead, std::min(k_up * seconds, 1.0f));
        rig.ahead = square(rig.ahead, rig.up, f.ahead);
        rig.ahead = part_of_way(rig.ahead, square(f.ahead, rig.up, rig.ahead), cross(rig.up, rig.ahead),
                                std::min(k_ahead * seconds, 1.0f));
        rig.ahead = square(rig.ahead, rig.up, f.ahead);
    }
    const Vec3 right = cross(rig.ahead, rig.up);
    auto at = [&](float ahead, float high, float aside) {
        return rig.place + (rig.ahead * ahead + rig.up * high + right * aside) * f.height;
    };
    const Vec3 target = at(k_look_ahead, k_look, 0), crown = at(0, 1, 0);
    const Vec3 way = at(-k_behind, k_high, k_aside) - crown;
    const float far = length(way);
    const auto rock = cast_ray(world.roam->compound, crown, way / far, far + k_clear);
    const float clear = rock ? clamp((rock->distance - k_clear) / far, 0.15f, 1) : 1;
    const float rate = clear < rig.reach ? k_in : k_out;
    rig.reach = is_new ? clear : rig.reach + (clear - rig.reach) * std::min(rate * seconds, 1.0f);
    rig.before = rig.now;
    rig.now = make_camera(crown + way * rig.reach, target);
    rig.now.up = to_glm(rig.up);
    if (is_new) rig.before = rig.now;
}

Camera mixed_camera(const Camera& from, const Camera& to, float share) {
    Camera camera = to;
    camera.eye = glm::mix(from.eye, to.eye, share);
    camera.target = glm::mix(from.target, to.target, share);
    const glm::vec3 up = glm::mix(from.up, to.up, share);
    camera.up = glm::length(up) > 1e-3f ? glm::normalize(up) : to.up;
    camera.vertical_fov = glm::mix(from.vertical_fov, to.vertical_fov, share);
    return camera;
}

Camera camera_of(const RoundRig& rig, float share) {
    return share == 1 ? rig.now : mixed_camera(rig.before, rig.now, share);
}

}  // namespace flaneur
