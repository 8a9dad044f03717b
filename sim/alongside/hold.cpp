// Hands on leads, white canes and umbrellas; where those are.
#include <algorithm>
#include <cmath>

#include "sim/alongside/parts.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/fall/limbs.h"
#include "sim/world.h"

namespace flaneur {

namespace {

// The body's own axes on the plane, and joints that hands go by.
struct Stance {
    Vec3 ahead, left;
    std::array<Vec3, k_joint_count> at;
    float height;
};
Stance stance_of(const World& w, const Holder& h, const BodyPose& pose) {
    const Vec3 front = rotate(pose.rotation[upper_chest], Vec3{0, 0, 1});
    const Vec2 way =
        normalize_or(Vec2{front.x, front.z}, heading_direction(w.crowd.motion.heading[h.walker]));
    return {at_height(way, 0), at_height(left_of(way), 0), places_of(pose, h.person, h.lane),
            h.person.height[h.lane]};
}

float out_of(Side side) { return side == k_left ? 1.0f : -1.0f; }
int arm_of(Side side) { return side == k_left ? left_upper_arm : right_upper_arm; }

// Of a white cane, radians to the left: on the side of the foot that is to land next.
// `ago` seconds ago.
float sweep_of(const GaitBlock& g, size_t lane, float ago) {
    constexpr float k_sweeps = 0.36f, k_still = -0.12f;
    const float turn = sin_cos(2 * k_pi * (g.phase[lane] - g.frequency[lane] * ago)).cosine;
    return lerp(k_still, -k_sweeps * turn, smoothstep(0.1f, 0.6f, g.amplitude[lane]));
}

// Its tip is lifted a little in the middle of its way (two-point touch).
float lift_of(const GaitBlock& g, size_t lane) {
    constexpr float k_lifts = 0.025f;  // metres
    const float turn = sin_cos(2 * k_pi * g.phase[lane]).cosine;
    return 0.012f + k_lifts * (1 - turn * turn) * smoothstep(0.1f, 0.6f, g.amplitude[lane]);
}

}  // namespace

Holder holder_of(const World& w, uint32_t i) { return {person_of(w, i), static_cast<int>(i % k_block), i}; }

void bring_palm(BodyPose& pose, const Holder& h, Side side, Vec3 palm, Vec3 elbow_way, float part) {
    const BodyPose was = pose;
    const ArmPlaces arm = arm_places(pose, h.person, h.lane, side);
    place_arm(pose, h.person, h.lane, side, palm, lerp(arm.shoulder, palm, 0.5f) + elbow_way);
    if (part >= 1) return;
    const BodyPose there = pose;
    pose = was;
    blend_arm(pose, there, side, part);
}

Side lead_hand(const World& w, uint32_t i) {
    const Dog* dog = own_of(w.alongside->dogs, i);
    return dog && dog->side > 0 ? k_left : k_right;
}

void hold_lead(const World& w, const Companion& c, BodyPose& pose) {
    const Dog* dog = own_of(w.alongside->dogs, c.walker);
    if (!dog) return;
    const Holder h = holder_of(w, c.walker);
    const Stance s = stance_of(w, h, pose);
    const Side side = lead_hand(w, c.walker);
    const Vec3 shoulder = s.at[static_cast<size_t>(arm_of(side))];
    const float reach = reach_of_arm(h.person, h.lane);
    // The forearm is a little raised; a lead that grows taut takes the hand along.
    const Vec3 to = dog->position - shoulder;
    const Vec2 off = on_ground(to);
    const float pulls = smoothstep(0.8f, 1.8f, length(off));
    const Vec3 rests = shoulder + s.left * (out_of(side) * 0.05f * reach) + s.ahead * (0.26f * reach) -
                       Vec3{0, 0.84f * reach, 0};
    const Vec3 pulled = rests + at_height(normalize_or(off, {0, 0}), 0) * (0.30f * reach * pulls) +
                        Vec3{0, 0.10f * reach * pulls, 0};
    bring_palm(pose, h, side, pulled, s.ahead * -1.0f + s.left * (0.35f * out_of(side)), c.holds);
}

void hold_white_cane(const World& w, const Companion& c, BodyPose& pose) {
    const Holder h = holder_of(w, c.walker);
    const Stance s = stance_of(w, h, pose);
    const GaitBlock& g = w.gait.blocks[c.walker / k_block];
    // The hand stays before the middle of the body and turns a little with the cane.
    const float sweep = sweep_of(g, c.walker % k_block, 0);
    const Vec3 palm = s.at[hips] + s.ahead * (0.195f * s.height) +
                      s.left * ((0.10f * sweep - 0.018f) * s.height) + Vec3{0, 0.055f * s.height, 0};
    bring_palm(pose, h, k_right, palm, s.left * -0.7f - Vec3{0, 0.6f, 0} - s.ahead * 0.7f, c.holds);
}

void hold_umbrella(const World& w, const Companion& c, BodyPose& pose) {
    const Holder h = holder_of(w, c.walker);
    const Stance s = stance_of(w, h, pose);
    const Vec3 palm = s.at[upper_chest] + s.ahead * (0.135f * s.height) - s.left * (0.085f * s.height) -
                      Vec3{0, 0.075f * s.height, 0};
    bring_palm(pose, h, k_right, palm, s.left * -0.55f - Vec3{0, 1, 0} - s.ahead * 0.2f, c.holds);
}

BodyAt body_between(const World& w, uint32_t i, float between) {
    auto at = [&](Joint j) { return joint_between(w, i, j, between); };
    BodyAt b;
    b.height = person_of(w, i).height[i % k_block];
    b.hips = at(hips).position;
    b.chest = at(upper_chest).position, b.chest_turn = at(upper_chest).rotation;
    b.head = at(head).position, b.head_turn = at(head).rotation;
    for (const Side side : {k_left, k_right}) b.palms[side] = palm_between(w, i, side, between);
    return b;
}

Vec3 palm_between(const World& w, uint32_t i, Side side, float between) {
    constexpr float k_palm = 0.06f;  // of the height, from the wrist: as palm_of() has it
    const JointPose hand = joint_between(w, i, side == k_left ? left_hand : right_hand, between);
    const float height = person_of(w, i).height[i % k_block];
    return hand.position + rotate(hand.rotation, Vec3{0, -k_palm * height, 0});
}

Placement white_cane_between(const World& w, const Companion& c, float between) {
    const BodyAt b = body_between(w, c.walker, between);
    const size_t block = c.walker / k_block, lane = c.walker % k_block;
    const GaitBlock& g = w.gait.blocks[block];
    const float size = b.height / 1.72f, far = k_white_cane * size;
    const float ago = (1 - between) * k_tick;
    const float yaw =
        w.crowd.motion.heading[c.walker] - w.crowd.motion.turn_rate[c.walker] * ago + sweep_of(g, lane, ago);
    const Vec3 grip = b.palms[k_right];
    const Vec2 way = heading_direction(yaw);
    float down = grip.y - w.crowd.motion.position[c.walker].y;
    // The tip is on the ground that is there: where that is not level, found in two steps.
    for (int k = 0; k < 3; ++k) {
        const float on = std::sqrt(std::max(far * far - down * down, 0.04f * far * far));
        const Vec3 at = grip + at_height(way * on, 0);
        if (const auto hit = ground_at(w.around, {at.x, grip.y - down, at.z}, 0.4f, 0.6f))
            down = clamp(grip.y - hit->height - lift_of(g, lane), 0.2f * far, 0.98f * far);
    }
    const float on = std::sqrt(std::max(far * far - down * down, 0.0f));
    const Vec3 to = at_height(way * on, -down);
    return {grip, rotation_between({0, -1, 0}, normalize_or(to, {0, -1, 0}))};
}

Placement umbrella_between(const World& w, const Companion& c, float between) {
    const BodyAt b = body_between(w, c.walker, between);
    const float far = k_umbrella * b.height / 1.72f;
    const Vec3 front = rotate(b.chest_turn, Vec3{0, 0, 1}), grip = b.palms[k_right];
    const Vec2 ahead = normalize_or(Vec2{front.x, front.z}, {0, 1});
    const Vec2 over = on_ground(b.head) + ahead * (0.06f * b.height) - left_of(ahead) * (0.012f * b.height);
    const Vec2 aside = over - on_ground(grip);
    const float up = std::sqrt(std::max(far * far - length_squared(aside), 0.25f * far * far));
    return {grip, rotation_y(heading_of(ahead)) *
                      rotation_between({0, 1, 0}, rotate(rotation_y(-heading_of(ahead)),
                                                         normalize_or(at_height(aside, up), {0, 1, 0})))};
}

}  // namespace flaneur
