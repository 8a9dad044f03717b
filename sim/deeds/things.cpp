#include "sim/deeds/things.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

float leaf_yaw(const SwingDoor& door, float angle) {
    // A hinge on the right opens to the left of one who comes, as seen from above against the clock.
    return door.hinge_left ? door.heading + angle : door.heading - angle;
}

Vec3 on_leaf(const SwingDoor& door, float angle, Vec3 own) {
    const Vec2 out = heading_direction(leaf_yaw(door, angle));
    const Vec2 left{out.z, -out.x};  // of one who faces along `out`
    const Vec2 along = door.hinge_left ? -left : left;
    const Vec2 at = door.hinge + along * own.x + out * own.z;
    return {at.x, door.floor + own.y, at.z};
}

Vec3 handle_of(const SwingDoor& door, const LeafNow& now, bool pushes) {
    const SinCos turn = sin_cos(now.lever);
    const float x = door.width - k_handle_from_edge - k_lever * turn.cosine,
                y = k_handle_high - k_lever * turn.sine;
    const float out = 0.5f * door.thick + k_lever_out;
    return on_leaf(door, now.angle, {x, y, pushes ? -out : out});
}

void step_closer(LeafNow& now, float dt) {
    constexpr float k_lever_rate = 4, k_drag = 0.8f, k_rubs = 0.4f, k_pull = 0.9f, k_most = 0.75f,
                    k_widest = 1.65f;
    now.lever = std::max(now.lever - k_lever_rate * dt, 0.0f);
    now.waits = std::max(now.waits - dt, 0.0f);
    // Slower towards the end, as closers latch.
    const float wanted = now.waits > 0 ? 0 : -std::min(k_most, 0.12f + 0.9f * now.angle);
    const float change = now.waits > 0 ? k_drag * std::fabs(now.speed) + k_rubs : k_pull;
    now.speed += clamp(wanted - now.speed, -change * dt, change * dt);
    now.angle = clamp(now.angle + now.speed * dt, 0, k_widest);
    if (now.angle <= 0 || now.angle >= k_widest) now.speed = 0;
}

}  // namespace flaneur
