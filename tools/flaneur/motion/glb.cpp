#include "tools/flaneur/motion/glb.h"

#include <algorithm>

#include "assets/gltf/write.h"

namespace flaneur {

namespace {

// One end of a block: a rectangle.
struct Face {
    Vec3 middle;
    Vec3 u, v;  // half its edges
};

// Four corners of a side, in either order round it.
void add_side(Character& doll, Joint joint, uint32_t colour, const Vec3 (&corners)[4], Vec3 inside) {
    Vec3 normal = normalize_or(cross(corners[1] - corners[0], corners[3] - corners[0]), {0, 1, 0});
    const bool is_inward = dot(normal, corners[0] - inside) < 0;
    auto first = static_cast<uint32_t>(doll.vertices.size());
    for (Vec3 corner : corners) {
        CharacterVertex& v = doll.vertices.emplace_back();
        v.position = corner;
        v.normal = is_inward ? -normal : normal;
        v.colour = colour;
        v.joints[0] = joint;
    }
    for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) doll.lods[0].push_back(first + (is_inward ? 3 - i : i));
}

void add_block(Character& doll, Joint joint, uint32_t colour, const Face& from, const Face& to) {
    auto corner = [](const Face& face, int i) {
        return face.middle + face.u * (i == 0 || i == 3 ? -1.0f : 1.0f) + face.v * (i < 2 ? -1.0f : 1.0f);
    };
    Vec3 inside = (from.middle + to.middle) * 0.5f;
    for (const Face& end : {from, to})
        add_side(doll, joint, colour, {corner(end, 0), corner(end, 1), corner(end, 2), corner(end, 3)},
                 inside);
    for (int i = 0; i < 4; ++i) {
        int next = (i + 1) % 4;
        add_side(doll, joint, colour, {corner(from, i), corner(from, next), corner(to, next), corner(to, i)},
                 inside);
    }
}

// From a joint to the next, upright in the canonical pose: half its width and depth at either end, of the
// body's height.
struct Block {
    Joint joint, next;  // the same: to the bone's end
    float wide, deep, next_wide, next_deep;
};
constexpr Block k_middle[] = {
    {hips, spine, 0.040f, 0.052f, 0.078f, 0.048f},        {spine, chest, 0.072f, 0.046f, 0.070f, 0.046f},
    {chest, upper_chest, 0.072f, 0.048f, 0.082f, 0.054f}, {upper_chest, neck, 0.084f, 0.055f, 0.050f, 0.036f},
    {neck, head, 0.026f, 0.028f, 0.026f, 0.028f},         {head, head, 0.036f, 0.044f, 0.040f, 0.048f}};
// Of a left limb; the right one's joints stand k_to_right further on.
constexpr Block k_limb[] = {{left_upper_arm, left_lower_arm, 0.025f, 0.028f, 0.020f, 0.022f},
                            {left_lower_arm, left_hand, 0.020f, 0.021f, 0.014f, 0.016f},
                            {left_hand, left_hand, 0.010f, 0.020f, 0.008f, 0.016f},
                            {left_upper_leg, left_lower_leg, 0.044f, 0.046f, 0.030f, 0.032f},
                            {left_lower_leg, left_foot, 0.029f, 0.031f, 0.020f, 0.022f}};
constexpr int k_to_right = right_hand - left_hand;
static_assert(right_toes - left_toes == k_to_right);

constexpr uint32_t k_plain = 0xffd0ccc8, k_left = 0xffc8a070, k_right = 0xff7088d0;  // sRGB, red lowest

void add_upright(Character& doll, const Block& block, int shift, uint32_t colour) {
    const Body& body = doll.body;
    auto joint = static_cast<Joint>(block.joint + shift);
    Vec3 from = body.joints[joint];
    Vec3 to = block.next == block.joint ? from + bone_end(body, joint)
                                        : body.joints[static_cast<size_t>(block.next + shift)];
    const float h = body.height;
    float wide = block.wide * h;
    if (joint == hips) {  // down to the legs, and as wide as they stand
        from.y = body.joints[left_upper_leg].y;
        wide += body.joints[left_upper_leg].x;
    }
    add_block(doll, joint, colour, {from, {wide, 0, 0}, {0, 0, block.deep * h}},
              {to, {block.next_wide * h, 0, 0}, {0, 0, block.next_deep * h}});
}

// From heel over ball to tip, on the ground.
void add_foot(Character& doll, int shift, uint32_t colour) {
    const Body& body = doll.body;
    auto foot = static_cast<Joint>(left_foot + shift), toes = static_cast<Joint>(left_toes + shift);
    Vec3 ankle = body.joints[foot], ball = body.joints[toes];
    auto across = [&](float x, float z, float wide, float high) -> Face {
        high = std::max(high, 0.005f * body.height);  // where ankles are on the ground, too
        return {{x, high, z}, {wide * body.height, 0, 0}, {0, high, 0}};
    };
    Face heel = across(ankle.x, ankle.z - body.heel, 0.018f, 0.5f * ankle.y);
    Face middle = across(ball.x, ball.z, 0.026f, ball.y);
    Face tip = across(ball.x, ball.z + body.toe, 0.020f, 0.5f * ball.y);
    add_block(doll, foot, colour, heel, middle);
    add_block(doll, toes, colour, middle, tip);
}

void add_shoulder(Character& doll, int shift, uint32_t colour) {
    auto shoulder = static_cast<Joint>(left_shoulder + shift);
    const float thick = 0.020f * doll.body.height;
    auto at = [&](int joint) -> Face {
        return {doll.body.joints[static_cast<size_t>(joint + shift)], {0, thick, 0}, {0, 0, thick}};
    };
    add_block(doll, shoulder, colour, at(left_shoulder), at(left_upper_arm));
}

Character doll_of(const Body& body) {
    Character doll;
    doll.name = "walker";
    doll.body = body;
    doll.bind_joints = body.joints;
    doll.lods.emplace_back();
    for (const Block& block : k_middle) add_upright(doll, block, 0, k_plain);
    for (int shift : {0, k_to_right}) {
        const uint32_t colour = shift == 0 ? k_left : k_right;
        for (const Block& block : k_limb) add_upright(doll, block, shift, colour);
        add_shoulder(doll, shift, colour);
        add_foot(doll, shift, colour);
    }
    return doll;
}

GlbMotion motion_of(const std::vector<JointPoses>& ticks, double rate) {
    GlbMotion motion;
    for (const JointPoses& poses : ticks) {
        motion.times.push_back(static_cast<float>(static_cast<double>(motion.times.size()) / rate));
        motion.hips.push_back(poses[hips].position);
        for (size_t j = 0; j < k_joint_count; ++j) {
            std::vector<Quat>& turns = motion.turns[j];
            Quat turn = normalize(own_turn(poses, j));
            // A turn has two quaternions: the one nearer to the tick before.
            const bool is_near = dot(turn, turns.empty() ? Quat{} : turns.back()) >= 0;
            turns.push_back(is_near ? turn : Quat{-turn.x, -turn.y, -turn.z, -turn.w});
        }
    }
    return motion;
}

}  // namespace

std::string motion_glb(const Body& body, const std::vector<JointPoses>& ticks, double rate) {
    std::array<uint32_t, k_tint_count> tints;
    tints.fill(0xffffffffu);
    return character_glb(doll_of(body), tints, motion_of(ticks, rate));
}

}  // namespace flaneur
