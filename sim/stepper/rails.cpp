#include <algorithm>
#include <cmath>

#include "sim/base/tick.h"
#include "sim/stepper/own.h"

namespace flaneur {

namespace {

constexpr float k_near = 0.9f;                          // metres from the body, of ropes that are looked at
constexpr float k_onward = 0.16f;                       // legs, that a hand is ahead
constexpr float k_takes = 1.1f;                         // a second, of HandBlock::reach
constexpr float k_stretched = 0.9f, k_lets_go = 0.95f;  // of an arm's length
constexpr float k_catches_up = 0.5f;                    // m/s, of a hand over the body
constexpr float k_ends = 0.08f;                         // metres that a rope has ended before

// A place on a rope, and from its middle to its surface.
struct OnRope {
    Vec3 place;
    float radius;
};

Vec3 joint_of(const PersonBlock& p, int lane, int joint) {
    return {p.joints[joint][0][lane], p.joints[joint][1][lane], p.joints[joint][2][lane]};
}

// The nearest of a rope that lies along the way, on that side.
std::optional<OnRope> rope_beside(const Own& o, Side side, Vec2 at) {
    const Movers& movers = *o.on.ground.movers;
    const Vec2 facing = o.facing(), left{facing.z, -facing.x};
    std::optional<OnRope> best;
    float least = k_near;
    for (size_t n = 0; n < movers.all.size(); ++n) {
        const Placement& frame = movers.places[n];
        if (length(on_ground(frame.position) - at) > k_near) continue;
        for (const MoverSolid& solid : movers.all[n].solids) {
            if (solid.matter != Matter::rope || solid.bears || solid.half.x < 4 * solid.half.y) continue;
            const Vec3 own = to_own(frame, at_height(at, to_world(frame, solid.middle).y)) - solid.middle;
            const Vec3 place =
                to_world(frame, solid.middle + Vec3{clamp(own.x, -solid.half.x, solid.half.x), 0, 0});
            if (dot(on_ground(place) - o.b.body, left) * outward(side) < 0) continue;
            const float off = length(on_ground(place) - at);
            if (off < least) least = off, best = OnRope{place, solid.half.y};
        }
    }
    return best;
}

}  // namespace

void hold_rails(const Own& o) {
    const Vec2 facing = o.facing(), left{facing.z, -facing.x};
    for (const Side side : {k_left, k_right}) {
        HandBlock& hand = o.g.hands[side];
        const int upper = side == k_left ? left_upper_arm : right_upper_arm;
        const Vec3 shoulder = joint_of(o.p, o.lane, upper), elbow = joint_of(o.p, o.lane, upper + 1),
                   wrist = joint_of(o.p, o.lane, upper + 2);
        const float fore = length(wrist - elbow), arm = length(elbow - shoulder) + 1.32f * fore;
        const Vec2 root = o.b.body + left * shoulder.x;
        const Vec2 at = root + facing * (k_onward * o.leg);
        const auto rope = rope_beside(o, side, at);
        const Vec3 from = at_height(root, o.g.base[o.lane] + shoulder.y);
        const float most = hand.reach[o.lane] > 0 ? k_lets_go : k_stretched;
        const bool is_within = rope && length(rope->place - from) < most * arm &&
                               std::fabs(dot(on_ground(rope->place) - at, facing)) < k_ends &&
                               (o.p.free_hands[o.lane] & (side == k_left ? 1 : 2)) != 0;
        float& reach = hand.reach[o.lane];
        reach = clamp(reach + (is_within ? k_takes : -k_takes) * k_tick, 0, 1);
        if (reach <= 0) continue;
        Vec3 palm{hand.x[o.lane], hand.y[o.lane], hand.z[o.lane]};
        if (is_within) {
            const Vec2 in = left * -outward(side);
            const Vec3 missing = rope->place + at_height(in * rope->radius, 0) - palm;
            const float step = (length(o.b.velocity) + k_catches_up) * k_tick;
            palm += missing * (reach < 0.3f ? 1 : std::min(step / std::max(length(missing), step), 1.0f));
            hand.normal_x[o.lane] = in.x, hand.normal_z[o.lane] = in.z;
        } else {
            palm += at_height(o.b.velocity * k_tick, 0);
        }
        hand.x[o.lane] = palm.x, hand.y[o.lane] = palm.y, hand.z[o.lane] = palm.z;
    }
}

}  // namespace flaneur
