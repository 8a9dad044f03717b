// Arms of single walkers that are set anew after the kernels, for what they hold.
#pragma once

#include "sim/pose/pose.h"

namespace flaneur {

// The lane of one walker.
template <class Block>
struct PosedAt {
    Block& block;
    size_t lane;

    Vec3 place_os(int j) const {
        const auto& p = block.position[j];
        return {p[0][lane], p[1][lane], p[2][lane]};
    }
    Quat rotation(int j) const {
        const auto& q = block.rotation[j];
        return {q[0][lane], q[1][lane], q[2][lane], q[3][lane]};
    }
    void set(int j, Vec3 p, Quat q) {
        const float place[] = {p.x, p.y, p.z}, turn[] = {q.x, q.y, q.z, q.w};
        for (size_t i = 0; i < 3; ++i) block.position[j][i][lane] = place[i];
        for (size_t i = 0; i < 4; ++i) block.rotation[j][i][lane] = turn[i];
    }
    Vec3 origin() const { return {block.origin[0][lane], block.origin[1][lane], block.origin[2][lane]}; }
};

using Posed = PosedAt<PoseBlock>;
using PosedBefore = PosedAt<const PoseBlock>;

// The joints of an arm as they were, to be set again.
struct KeptArm {
    JointPose joints[3];  // from the block's origin
};
KeptArm keep_arm(const Posed& pose, Side side);
void set_arm(Posed pose, Side side, const KeptArm& kept);

// Turns -y along `bone`, unit, and +z as near to `front` as that allows.
Quat bone_rotation(Vec3 bone, Vec3 front);

// A hand against its forearm, bent no farther than a wrist is.
Quat within_wrist(Quat hand_ps);

// Whether an arm is as arms go, half a degree within its joints' limits.
bool is_sound(const Posed& pose, Side side);

// Brings the joints of an arm, below the chest, so far from where they were to where they are.
void part_arm(const PosedBefore& before, Posed now, Side side, float part);
// The same from `before` in the block that it is in now.
void part_arm(const KeptArm& before, Posed now, Side side, float part);
// The same, as far as none of them turns by more than `most` radians. Returns whether one would have.
bool slow_arm(const PosedBefore& before, Posed now, Side side, float most);

}  // namespace flaneur
