#include "sim/fall/body_pose.h"

#include "sim/base/math.h"
#include "sim/fall/lane.h"
#include "sim/pose/arm.h"

namespace flaneur {

namespace {

Vec3 joint_at(const PersonBlock& person, int lane, int joint) {
    return {person.joints[joint][0][lane], person.joints[joint][1][lane], person.joints[joint][2][lane]};
}

// The turn that takes x, y and z to these orthonormal axes.
Quat rotation_of(Vec3 x, Vec3 y, Vec3 z) {
    const float trace = x.x + y.y + z.z;
    if (trace > 0) return normalize({y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace});
    if (x.x > y.y && x.x > z.z) return normalize({1 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y});
    if (y.y > z.z) return normalize({x.y + y.x, 1 + y.y - x.x - z.z, y.z + z.y, z.x - x.z});
    return normalize({z.x + x.z, y.z + z.y, 1 + z.z - x.x - y.y, x.y - y.x});
}

// Both bones of a limb turned about themselves so that it bends about its own x: `ahead` +1 where it bends to
// +z, as elbows do, -1 as knees do.
void lay_limb(std::array<Quat, k_segment_count>& turn, int upper, float ahead) {
    constexpr float k_bent = 0.06f;  // sine, below which its own x is as good as any
    const Vec3 down{0, -1, 0};
    const Vec3 first = rotate(turn[upper], down), second = rotate(turn[upper + 1], down);
    Vec3 axis = cross(first, second) * -ahead;
    const Vec3 own = rotate(turn[upper], {1, 0, 0});
    const float bent = length(axis);
    axis = bent > k_bent ? axis / bent : normalize_or(own - first * dot(own, first), own);
    if (bent <= k_bent) axis = normalize_or(axis - second * dot(axis, second), axis);
    for (int i : {upper, upper + 1}) {
        const Vec3 y = -rotate(turn[i], down);
        const Vec3 x = normalize_or(axis - y * dot(axis, y), own);
        turn[i] = rotation_of(x, y, cross(x, y));
    }
}

struct Segmented {
    std::array<Vec3, k_segment_count> place;
    std::array<Quat, k_segment_count> turn;
};

Segmented segmented(const BodyPose& p, const Segments& segments, const PersonBlock& person, int lane) {
    Segmented s;
    const auto places = places_of(p, person, lane);
    for (int i = 0; i < k_segment_count; ++i) s.turn[i] = p.rotation[k_segments[i].joint];
    s.turn[thorax] = p.rotation[upper_chest];
    s.turn[skull] = p.rotation[head];
    lay_limb(s.turn, left_arm, 1), lay_limb(s.turn, right_arm, 1);
    lay_limb(s.turn, left_thigh, -1), lay_limb(s.turn, right_thigh, -1);
    for (int i = 0; i < k_segment_count; ++i)
        s.place[i] = places[k_segments[i].joint] - rotate(s.turn[i], segments.pivot[i]);
    return s;
}

}  // namespace

BodyPose body_pose_of(const std::vector<PoseBlock>& poses, size_t walker) {
    const PosedBefore pose{poses[walker / k_block], walker % k_block};
    BodyPose p{pose.origin() + pose.place_os(hips), {}};
    for (int j = 0; j < k_joint_count; ++j) p.rotation[j] = pose.rotation(j);
    return p;
}

std::array<Vec3, k_joint_count> places_of(const BodyPose& pose, const PersonBlock& person, int lane) {
    std::array<Vec3, k_joint_count> places;
    places[hips] = pose.hips;
    for (int j = 1; j < k_joint_count; ++j) {
        const int parent = k_joint_parents[j];
        const Vec3 bone = joint_at(person, lane, j) - joint_at(person, lane, parent);
        places[j] = places[parent] + rotate(pose.rotation[parent], bone);
    }
    return places;
}

Vec3 place_of(const BodyPose& pose, const PersonBlock& person, int lane, int joint) {
    if (joint == hips) return pose.hips;
    const int parent = k_joint_parents[joint];
    const Vec3 bone = joint_at(person, lane, joint) - joint_at(person, lane, parent);
    return place_of(pose, person, lane, parent) + rotate(pose.rotation[parent], bone);
}

void set_body_pose(std::vector<PoseBlock>& poses, const PersonBlock& person, size_t walker,
                   const BodyPose& to) {
    Posed pose{poses[walker / k_block], walker % k_block};
    const auto lane = static_cast<int>(pose.lane);
    BodyPose from_origin = to;  // far from the world's, metres are coarser than bones may be
    from_origin.hips -= pose.origin();
    const auto places = places_of(from_origin, person, lane);
    for (int j = 0; j < k_joint_count; ++j) pose.set(j, places[j], to.rotation[j]);
}

BodyPose mixed(const BodyPose& from, const BodyPose& to, float t) {
    BodyPose p{lerp(from.hips, to.hips, t), {}};
    p.rotation[hips] = nlerp(from.rotation[hips], to.rotation[hips], t);
    for (int j = 1; j < k_joint_count; ++j) {
        const int parent = k_joint_parents[j];
        p.rotation[j] =
            normalize(p.rotation[parent] * nlerp(conjugate(from.rotation[parent]) * from.rotation[j],
                                                 conjugate(to.rotation[parent]) * to.rotation[j], t));
    }
    return p;
}

Residue take_over(TumbleBlock& block, int lane, const Segments& segments, const PersonBlock& person,
                  int person_lane, const BodyPose& before, const BodyPose& now, float dt, Vec3 origin) {
    const Segmented was = segmented(before, segments, person, person_lane);
    const Segmented is = segmented(now, segments, person, person_lane);
    for (int i = 0; i < k_segment_count; ++i) {
        set_row(block.place[i], lane, is.place[i] - origin);
        set_row(block.rotation[i], lane, is.turn[i]);
        set_row(block.velocity[i], lane, (is.place[i] - was.place[i]) / dt);
        const Joint joint = k_segments[i].joint;  // as drawn: planes of limbs may turn about with the bend
        Quat turn = now.rotation[joint] * conjugate(before.rotation[joint]);
        if (turn.w < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
        set_row(block.spin[i], lane, Vec3{turn.x, turn.y, turn.z} * (2 / dt));
    }
    Residue residue;
    for (int j = 0; j < k_joint_count; ++j)
        residue[j] = conjugate(is.turn[k_segment_of[j]]) * now.rotation[j];
    return residue;
}

BodyPose body_pose_of(const TumbleBlock& block, int lane, const Segments& segments, const Residue& residue,
                      Vec3 origin) {
    BodyPose p;
    const Quat root = turn_of(block.rotation[pelvis], lane);
    p.hips = origin + row_of(block.place[pelvis], lane) + rotate(root, segments.pivot[pelvis]);
    for (int j = 0; j < k_joint_count; ++j)
        p.rotation[j] = normalize(turn_of(block.rotation[k_segment_of[j]], lane) * residue[j]);
    return p;
}

std::array<Vec3, k_ball_count> balls_of(const BodyPose& pose, const Segments& segments,
                                        const PersonBlock& person, int lane) {
    const Segmented s = segmented(pose, segments, person, lane);
    std::array<Vec3, k_ball_count> balls;
    for (int k = 0; k < k_ball_count; ++k) {
        const Segment i = k_segment_of_ball[k];
        balls[k] = s.place[i] + rotate(s.turn[i], segments.ball[k]);
    }
    return balls;
}

}  // namespace flaneur
