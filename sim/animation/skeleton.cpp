#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/animation/skeleton.cpp"
#include "sim/animation/skeleton.h"

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Ends of names say spaces: _ps the parent's axes and origin, _ms the model's, _ws the world's axes, _os
// places from a pose's origin along the world's axes. A joint's place in its parent is constant; below the
// parent's rotation R and place p it stands at p + R place_ps, turned by R rotation_ps.

void model_pose_here(const Skeleton& skeleton, const LaneRow* local, LaneRow* model) {
    size_t joints = skeleton.parents.size();
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        for (size_t j = 0; j < joints; ++j) {
            Vec3 rest_ps = skeleton.places[j];
            V3<Lanes> place_ms{Lanes(rest_ps.x), Lanes(rest_ps.y), Lanes(rest_ps.z)};
            Q4<Lanes> rotation_ms = load_rotation<Lanes>(rows_of(local + 4 * j), lane);
            if (j == 0) {
                place_ms = place_ms + load_place<Lanes>(rows_of(local + 4 * joints), lane);
            } else {
                LaneRow* parent = model + 7 * size_t(skeleton.parents[j]);
                Q4<Lanes> above_ms = load_rotation<Lanes>(rows_of(parent + 3), lane);
                place_ms = load_place<Lanes>(rows_of(parent), lane) + rotate(above_ms, place_ms);
                rotation_ms = above_ms * rotation_ms;
            }
            store_place(place_ms, rows_of(model + 7 * j), lane);
            store_rotation(rotation_ms, rows_of(model + 7 * j + 3), lane);
        }
    }
}

void world_pose_here(const PersonBlock& people, const LaneRow* local, PoseBlock& out) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        for (size_t j = 0; j < k_joint_count; ++j) {
            V3<Lanes> place_os = load_place<Lanes>(people.joints[j], lane);
            Q4<Lanes> rotation_ws = load_rotation<Lanes>(rows_of(local + 4 * j), lane);
            if (k_joint_parents[j] == k_no_parent) {
                store_place(load_place<Lanes>(rows_of(local + 4 * k_joint_count), lane), out.origin, lane);
            } else {
                auto parent = size_t(k_joint_parents[j]);
                Q4<Lanes> above_ws = load_rotation<Lanes>(out.rotation[parent], lane);
                V3<Lanes> bone_ps = place_os - load_place<Lanes>(people.joints[parent], lane);
                place_os = load_place<Lanes>(out.position[parent], lane) + rotate(above_ws, bone_ps);
                rotation_ws = above_ws * rotation_ws;
            }
            store_place(place_os, out.position[j], lane);
            store_rotation(rotation_ws, out.rotation[j], lane);
        }
    }
}

void local_pose_here(const PersonBlock& people, const PoseBlock& poses, LaneRow* local) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        for (size_t j = 0; j < k_joint_count; ++j) {
            Q4<Lanes> rotation = load_rotation<Lanes>(poses.rotation[j], lane);
            if (k_joint_parents[j] != k_no_parent) {
                auto parent = size_t(k_joint_parents[j]);
                rotation = conjugate(load_rotation<Lanes>(poses.rotation[parent], lane)) * rotation;
            }
            store_rotation(rotation, rows_of(local + 4 * j), lane);
        }
        // From where the canonical pose would have the hips.
        V3<Lanes> from_rest_os =
            load_place<Lanes>(poses.position[hips], lane) - load_place<Lanes>(people.joints[hips], lane);
        V3<Lanes> offset_ws = load_place<Lanes>(poses.origin, lane) + from_rest_os;
        store_place(offset_ws, rows_of(local + 4 * k_joint_count), lane);
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

Skeleton humanoid(const Body& body) {
    Skeleton s;
    s.parents.assign(k_joint_parents.begin(), k_joint_parents.end());
    s.rotations.resize(k_joint_count);
    for (size_t j = 0; j < k_joint_count; ++j) {
        Vec3 parent = s.parents[j] < 0 ? Vec3{} : body.joints[size_t(s.parents[j])];
        s.places.push_back(body.joints[j] - parent);
    }
    return s;
}

Result<void> check_skeleton(const Skeleton& s) {
    size_t count = s.parents.size();
    if (count == 0 || count > k_most_joints || s.places.size() != count || s.rotations.size() != count)
        return Error{"a skeleton needs 1 to " + std::to_string(k_most_joints) +
                     " joints, each with a parent, a place and a rotation"};
    for (size_t j = 0; j < count; ++j) {
        std::string which = "joint " + std::to_string(j);
        bool before = j == 0 ? s.parents[0] == k_no_parent : s.parents[j] >= 0 && size_t(s.parents[j]) < j;
        if (!before) return Error{which + " does not come after its parent; sort parents before children"};
        Vec3 p = s.places[j];
        Quat q = s.rotations[j];
        float norm = dot(q, q);
        if (!(length_squared(p) < 1e12f) || !(norm > 0.999f && norm < 1.001f))
            return Error{which + " has no finite place or no unit rotation at rest"};
    }
    return {};
}

HWY_EXPORT(model_pose_here);
HWY_EXPORT(world_pose_here);
HWY_EXPORT(local_pose_here);

void model_pose(const Skeleton& skeleton, const LaneRow* local, LaneRow* model) {
    HWY_DYNAMIC_DISPATCH(model_pose_here)(skeleton, local, model);
}
void world_pose(const PersonBlock& people, const LaneRow* local, PoseBlock& out) {
    HWY_DYNAMIC_DISPATCH(world_pose_here)(people, local, out);
}
void local_pose(const PersonBlock& people, const PoseBlock& poses, LaneRow* local) {
    HWY_DYNAMIC_DISPATCH(local_pose_here)(people, poses, local);
}

}  // namespace flaneur
#endif
