#include "sim/figures/key_poses.h"

#include <algorithm>
#include <cassert>

#include "sim/base/math.h"

namespace flaneur {

namespace {

// Degrees. `thigh` is against the vertical, forward +; `knee` bends back, `ankle` lifts the toes, `toes` too,
// arms go forward, elbows bend. Left, then right.
struct KeyRow {
    float thigh[2], knee[2], ankle[2], toes[2], arm[2], elbow[2];
    float out;                   // arms, away from the body
    float pitch, twist, roll;    // of the pelvis: ahead, to the left, to the left
    float trunk, against, side;  // of the trunk against it, over three joints: the same
    float nod;                   // of the head, ahead
    float lift;                  // metres that the lower sole is above the ground
};

constexpr KeyRow k_table[k_key_pose_count] = {
    // thigh      knee       ankle       toes      arm         elbow       out  pitch twist roll trunk agst
    // side nod lift
    {{2, 2}, {4, 4}, {2, 2}, {0, 0}, {2, 2}, {12, 12}, 6, 0, 0, 0, 1, 0, 0, 0, 0},
    {{1, 3}, {2, 7}, {1, 4}, {0, 0}, {0, 1}, {16, 15}, 8, -1, 0, 1, -3, 0, -2, 4, 0},
    {{27, -15}, {4, 11}, {-7, 4}, {0, 22}, {-22, 20}, {10, 28}, 7, 2, -5, 0, 4, 9, 0, -2, 0},
    {{2, 20}, {7, 56}, {5, 2}, {0, 0}, {-1, 1}, {14, 18}, 7, 2, 0, 2, 3, 0, -2, -1, 0},
    {{36, -2}, {24, 96}, {-8, -12}, {0, 0}, {-34, 26}, {88, 96}, 12, 7, -6, 0, 9, 13, 0, -8, 0},
    {{-20, 50}, {10, 82}, {-14, 4}, {32, 0}, {28, -38}, {96, 84}, 12, 9, 7, 0, 10, -14, 0, -9, 0.03f},
    {{62, 66}, {92, 96}, {30, 30}, {0, 0}, {22, 26}, {62, 58}, 14, 20, 0, 0, 16, 0, 0, -22, 0},
    {{58, 4}, {52, 62}, {2, 28}, {0, 26}, {6, 34}, {58, 66}, 14, 18, -6, 0, 16, 10, 0, -22, 0},
    {{46, 62}, {74, 112}, {28, 8}, {0, 0}, {22, 22}, {62, 62}, 14, 18, 0, 3, 16, 0, -3, -22, 0},
    {{2, 2}, {4, 4}, {2, 2}, {0, 0}, {2, 2}, {16, 12}, 12, 0, 4, 8, 2, 6, 9, 0, 0},
    {{14, -8}, {16, 12}, {-26, -28}, {10, 10}, {128, 120}, {24, 30}, 18, 4, 0, 0, -6, 0, 0, -8, 0.1f},
    {{54, 34}, {66, 58}, {-6, -12}, {0, 0}, {58, 50}, {38, 44}, 46, 8, 0, 0, 10, 0, 0, -4, 0.1f},
    {{60, 64}, {88, 90}, {28, 26}, {0, 0}, {-24, -18}, {20, 24}, 22, 18, 0, 0, 24, 0, 0, -22, 0},
};

const KeyRow& row_of(KeyPose pose) { return k_table[static_cast<size_t>(pose)]; }

Quat about_x(float degrees) { return rotation_x(degrees * k_radians); }
Quat about_y(float degrees) { return rotation_y(degrees * k_radians); }
Quat about_z(float degrees) { return rotation_z(degrees * k_radians); }

void set_limbs(const KeyRow& k, int side, std::vector<Quat>& r) {
    const size_t leg = side == k_left ? left_upper_leg : right_upper_leg,
                 arm = side == k_left ? left_upper_arm : right_upper_arm;
    const float outward = side == k_left ? 1.0f : -1.0f;
    // Thighs are told against the vertical, not against a pelvis that tips, turns and rolls.
    const Quat pelvis = r[hips];
    const Quat upright{-pelvis.x, -pelvis.y, -pelvis.z, pelvis.w};
    r[leg] = normalize(upright * about_x(-k.thigh[side]));
    r[leg + 1] = about_x(k.knee[side]);
    r[leg + 2] = about_x(-k.ankle[side]);
    r[leg + 3] = about_x(-k.toes[side]);
    r[arm] = normalize(about_z(outward * k.out) * about_x(-k.arm[side]));
    r[arm + 1] = about_x(-k.elbow[side]);
}

struct Places {
    Vec3 joint[k_joint_count];
    Quat turn[k_joint_count];
};
// From where the canonical pose stands.
Places places_of(const Body& body, const LocalPose& pose) {
    Places out;
    for (size_t j = 0; j < k_joint_count; ++j) {
        const int parent = k_joint_parents[j];
        if (parent < 0) {
            out.joint[j] = body.joints[j] + pose.offset;
            out.turn[j] = pose.rotations[j];
            continue;
        }
        const auto p = static_cast<size_t>(parent);
        out.joint[j] = out.joint[p] + rotate(out.turn[p], body.joints[j] - body.joints[p]);
        out.turn[j] = normalize(out.turn[p] * pose.rotations[j]);
    }
    return out;
}

float lowest_sole(const Body& body, const Places& at) {
    float low = 1e9f;
    for (const size_t foot : {static_cast<size_t>(left_foot), static_cast<size_t>(right_foot)}) {
        const size_t toes = foot + 1;
        const Vec3 heel = at.joint[foot] + rotate(at.turn[foot], {0, -body.joints[foot].y, -body.heel});
        const Vec3 ball = at.joint[toes] + rotate(at.turn[toes], {0, -body.joints[toes].y, 0});
        const Vec3 tip = ball + rotate(at.turn[toes], {0, 0, body.toe});
        low = std::min({low, heel.y, ball.y, tip.y});
    }
    return low;
}

LocalPose mirrored(const LocalPose& pose) {
    constexpr size_t k_arms = right_shoulder - left_shoulder, k_legs = right_upper_leg - left_upper_leg;
    LocalPose out = pose;
    for (size_t j = 0; j < k_joint_count; ++j) {
        size_t other = j;
        if (j >= left_shoulder && j < right_shoulder) other = j + k_arms;
        if (j >= right_shoulder && j < left_upper_leg) other = j - k_arms;
        if (j >= left_upper_leg && j < right_upper_leg) other = j + k_legs;
        if (j >= right_upper_leg) other = j - k_legs;
        const Quat q = pose.rotations[other];
        out.rotations[j] = {q.x, -q.y, -q.z, q.w};
    }
    out.offset.x = -pose.offset.x;
    return out;
}

Clip clip_of(const Body& body, Curve curve, bool loops,
             std::initializer_list<std::pair<KeyPose, bool>> keys) {
    std::vector<LocalPose> poses;
    for (const auto& [pose, is_mirrored] : keys) poses.push_back(key_pose(body, pose, is_mirrored));
    return *make_clip(humanoid(body), poses, 4, loops, curve);
}

// A lane of a block as one.
JointPose joint_of(const PoseBlock& b, size_t j, size_t lane) {
    return {{b.position[j][0][lane], b.position[j][1][lane], b.position[j][2][lane]},
            {b.rotation[j][0][lane], b.rotation[j][1][lane], b.rotation[j][2][lane], b.rotation[j][3][lane]}};
}
void set_joint(PoseBlock& b, size_t j, size_t lane, const JointPose& pose) {
    const float place[] = {pose.position.x, pose.position.y, pose.position.z};
    const Quat turn = normalize(pose.rotation);
    const float parts[] = {turn.x, turn.y, turn.z, turn.w};
    for (size_t i = 0; i < 3; ++i) b.position[j][i][lane] = place[i];
    for (size_t i = 0; i < 4; ++i) b.rotation[j][i][lane] = parts[i];
}

float smooth(float share) {
    const float t = clamp(share, 0, 1);
    return t * t * (3 - 2 * t);
}

// How much a foot is where the gait has it: wholly while it stands, and not at all in the middle of its way.
float stands(const GaitBlock& g, int side, size_t lane) {
    const FootBlock& foot = g.feet[side];
    if (!foot.swinging[lane]) return 1;
    const float share = (foot.phase[lane] - g.duty[lane]) / std::max(1 - g.duty[lane], 0.05f);
    return 1 - smooth(2.5f * std::min(share, 1 - share));
}

// The leg from the hip of the key pose to `ankle`, each of its bones turned no farther than that takes.
struct Leg {
    Vec3 knee, ankle;
    Quat upper, lower;
};
Leg solve_leg(const Vec3& hip, const JointPose& thigh, const JointPose& knee, const JointPose& key_ankle,
              Vec3 ankle) {
    const float upper = length(knee.position - thigh.position),
                lower = length(key_ankle.position - knee.position);
    const Vec3 way = ankle - hip;
    const float most = 0.9995f * (upper + lower);
    const float reach = std::clamp(length(way), std::fabs(upper - lower) + 0.01f, most);
    const Vec3 aim = normalize_or(way, {0, -1, 0});
    // The knee goes where the thigh of the key faces.
    const Vec3 faces = rotate(thigh.rotation, {0, 0, 1}),
               front = normalize_or(faces - aim * dot(faces, aim), {0, 0, 1});
    const float along = (upper * upper - lower * lower + reach * reach) / (2 * reach);
    const float ahead = std::sqrt(std::max(upper * upper - along * along, 0.0f));
    Leg leg;
    leg.knee = hip + aim * along + front * ahead;
    leg.ankle = hip + aim * reach;
    auto turned = [](const JointPose& bone, Vec3 before, Vec3 after) {
        return rotation_between(normalize_or(before, {0, -1, 0}), normalize_or(after, {0, -1, 0})) *
               bone.rotation;
    };
    leg.upper = turned(thigh, knee.position - thigh.position, leg.knee - hip);
    leg.lower = turned(knee, key_ankle.position - knee.position, leg.ankle - leg.knee);
    return leg;
}

// How far hips may be above `ankle` for a leg of this length to reach it.
float highest(Vec3 hip, Vec3 ankle, float leg) {
    const Vec3 way = ankle - hip;
    const float flat2 = way.x * way.x + way.z * way.z;
    return ankle.y + std::sqrt(std::max(leg * leg - flat2, 0.0f));
}

// A model's pose from the ground below it, set onto a walker's root.
void set_onto_root(const GaitBlock& g, size_t lane, float up, PoseBlock& pose) {
    const Quat heading = rotation_y(g.heading[lane]);
    for (size_t j = 0; j < k_joint_count; ++j) {
        const JointPose at = joint_of(pose, j, lane);
        set_joint(pose, j, lane, {rotate(heading, at.position) + Vec3{0, up, 0}, heading * at.rotation});
    }
}

void copy_lane(const PoseBlock& from, size_t lane, PoseBlock& to) {
    for (size_t j = 0; j < k_joint_count; ++j) set_joint(to, j, lane, joint_of(from, j, lane));
}

}  // namespace

LocalPose key_pose(const Body& body, KeyPose pose, bool is_mirrored) {
    const KeyRow& k = row_of(pose);
    LocalPose out;
    out.rotations.assign(k_joint_count, Quat{0, 0, 0, 1});
    std::vector<Quat>& r = out.rotations;
    r[hips] = normalize(about_y(k.twist) * about_z(-k.roll) * about_x(k.pitch));
    for (const size_t j :
         {static_cast<size_t>(spine), static_cast<size_t>(chest), static_cast<size_t>(upper_chest)})
        r[j] = normalize(about_y(k.against / 3) * about_z(-k.side / 3) * about_x(k.trunk / 3));
    r[neck] = about_x(0.4f * k.nod);
    r[head] = about_x(0.6f * k.nod);
    set_limbs(k, k_left, r);
    set_limbs(k, k_right, r);
    out.offset.y = k.lift - lowest_sole(body, places_of(body, out));
    return is_mirrored ? mirrored(out) : out;
}

BlendTree key_tree(const Body& body, KeyCurves curves) {
    using P = KeyPose;
    using Kind = BlendNode::Kind;
    const Curve along = curves.along;
    auto cycle = [&](P contact, P passing) {
        return clip_of(body, along, true,
                       {{contact, false}, {passing, false}, {contact, true}, {passing, true}});
    };
    BlendTree tree;
    tree.clips = {clip_of(body, along, true, {{P::stand, false}, {P::rest, false}}),
                  cycle(P::walk_contact, P::walk_passing), cycle(P::run_contact, P::run_off),
                  clip_of(body, along, true, {{P::crouch, false}, {P::crouch, true}}),
                  cycle(P::sneak_contact, P::sneak_passing)};
    const LocalPose upright = key_pose(body, P::stand);
    tree.clips.push_back(
        *make_additive_clip(humanoid(body), {key_pose(body, P::lean, true), upright, key_pose(body, P::lean)},
                            upright, 4, false, along));
    tree.clips.push_back(clip_of(body, along, false,
                                 {{P::land, false}, {P::rise, false}, {P::fall, false}, {P::land, false}}));
    auto play = [](uint16_t clip, uint16_t input) {
        return BlendNode{Kind::clip, Curve::linear, {input, 0}, clip, 1, 1};
    };
    tree.nodes = {{Kind::grid, curves.across, {key_speed, key_crouch}, 1, 3, 2},
                  play(0, key_breath),
                  play(1, key_phase),
                  play(2, key_phase),
                  play(3, key_breath),
                  play(4, key_phase),
                  play(4, key_phase),
                  play(5, key_lean),
                  play(6, key_flight)};
    tree.layers = {{}, {7, true, key_whole, {}}, {8, false, key_leap, {}}};
    tree.inputs = k_key_inputs;
    return tree;
}

KeyInputs key_inputs(const GaitBlock& g, size_t lane, float crouch) {
    constexpr float k_steepest = 0.35f;  // of gravity: a bend into which one leans wholly
    constexpr float k_sunk = 0.12f;      // metres of a leap's crouch, and of its flight, that are all of it
    constexpr float k_before = 0.7f * k_jump_crouch;
    KeyInputs in{};
    in.rows[key_phase] = g.phase[lane];
    in.rows[key_speed] = 0.5f * (g.amplitude[lane] + g.running[lane]);
    in.rows[key_crouch] = crouch;
    in.rows[key_lean] = 0.5f + 0.5f * clamp(g.bank[lane] / k_steepest, -1, 1);
    in.rows[key_leap] = smooth((g.lift[lane] + g.crouch[lane]) / k_sunk);
    in.rows[key_flight] =
        clamp((g.jump[lane] - k_before) / std::max(g.flight[lane] + 0.5f * k_jump_crouch, 0.3f), 0, 1);
    in.rows[key_breath] = g.breath[lane];
    in.rows[key_whole] = 1;
    return in;
}

void pose_by_keys(const BlendTree& tree, const KeyInputs& inputs, const Gait& gait, size_t walker,
                  PoseBlock& posed) {
    const size_t block = walker / k_block, lane = walker % k_block;
    const GaitBlock& g = gait.blocks[block];
    assert(tree.inputs == k_key_inputs);
    LaneRow rows[k_key_inputs], local[local_rows(k_joint_count)];
    for (size_t i = 0; i < k_key_inputs; ++i) std::fill_n(rows[i].lanes, k_block, inputs.rows[i]);
    evaluate_blends(tree, rows, 0, 1, local);
    PoseBlock keys;
    world_pose(gait.people[block], local, keys);
    for (size_t j = 0; j < k_joint_count; ++j)  // from the walker's root
        for (size_t i = 0; i < 3; ++i) keys.position[j][i][lane] += keys.origin[i][lane];
    set_onto_root(g, lane, g.lift[lane], keys);
    // How far down the legs ask the hips to be.
    JointPose ankles[2];
    float down = 0;
    for (int side = 0; side < 2; ++side) {
        const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg, foot = thigh + 2;
        const JointPose own = joint_of(posed, foot, lane), key = joint_of(keys, foot, lane);
        const float share = stands(g, side, lane);
        ankles[side] = {lerp(key.position, own.position, share), nlerp(key.rotation, own.rotation, share)};
        const Vec3 hip = joint_of(keys, thigh, lane).position,
                   knee = joint_of(keys, thigh + 1, lane).position;
        const float leg = 0.998f * (length(knee - hip) + length(key.position - knee));
        down = std::max(down, share * (hip.y - highest(hip, ankles[side].position, leg)));
    }
    for (size_t j = 0; j < k_joint_count; ++j) keys.position[j][1][lane] -= down;
    for (int side = 0; side < 2; ++side) {
        const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
        const JointPose hip = joint_of(keys, thigh, lane), knee = joint_of(keys, thigh + 1, lane),
                        ankle = joint_of(keys, thigh + 2, lane), own = joint_of(posed, thigh + 2, lane),
                        own_toes = joint_of(posed, thigh + 3, lane), toes = joint_of(keys, thigh + 3, lane);
        const Leg leg = solve_leg(hip.position, hip, knee, ankle, ankles[side].position);
        set_joint(keys, thigh, lane, {hip.position, leg.upper});
        set_joint(keys, thigh + 1, lane, {leg.knee, leg.lower});
        set_joint(keys, thigh + 2, lane, {leg.ankle, ankles[side].rotation});
        const Quat back{-own.rotation.x, -own.rotation.y, -own.rotation.z, own.rotation.w};
        const Vec3 to_ball = rotate(back, own_toes.position - own.position);
        set_joint(keys, thigh + 3, lane,
                  {leg.ankle + rotate(ankles[side].rotation, to_ball),
                   nlerp(toes.rotation, own_toes.rotation, stands(g, side, lane))});
    }
    copy_lane(keys, lane, posed);
}

void pose_as(const LocalPose& pose, const Body& body, const Gait& gait, size_t walker, PoseBlock& posed) {
    const size_t lane = walker % k_block;
    const Places at = places_of(body, pose);
    for (size_t j = 0; j < k_joint_count; ++j) set_joint(posed, j, lane, {at.joint[j], at.turn[j]});
    set_onto_root(gait.blocks[walker / k_block], lane, 0, posed);
}

}  // namespace flaneur
