// FABRIK for a tree of joints with any number of end effectors and sub-bases, nested as they come (Aristidou
// & Lasenby 2011, section 5), over float, Lanes or Wide: one tree a lane, all of one shape.
//
// Inwards, each joint is drawn towards where its children have gone; a sub-base, which has several, takes the
// centroid of the places that they propose. The root then goes back to its place, and outwards each joint is
// drawn towards its parent. A chain is the case without sub-bases. All of one tree is in one space, the
// caller's.
#if defined(FLANEUR_SIM_IK_FABRIK_TREE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_IK_FABRIK_TREE_INL_H
#undef FLANEUR_SIM_IK_FABRIK_TREE_INL_H
#else
#define FLANEUR_SIM_IK_FABRIK_TREE_INL_H
#endif

#include "sim/ik/fabrik-inl.h"
#include "sim/ik/solve.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

// Moves p[1 .. joints) so that effector e comes to targets[e]. bones[j] is the length from joint j to its
// parent; bones[0] is not read. Bone lengths are kept to rounding. Branches without an effector keep the
// directions of their bones. `offsets` and `proposed` are room for a value a joint.
template <class T>
HWY_INLINE void fabrik_tree(const TreeShape& shape, V3<T>* p, const T* bones, const V3<T>* targets,
                            int iterations, V3<T>* offsets, V3<T>* proposed) {
    int joints = static_cast<int>(shape.parents.size());
    for (int j = 1; j < joints; ++j) offsets[j] = p[j] - p[shape.parents[j]];
    V3<T> none{T(0.0f), T(0.0f), T(0.0f)};
    for (int k = 0; k < iterations; ++k) {
        for (int j = 0; j < joints; ++j) {
            int e = shape.effectors[j];
            proposed[j] = e == k_no_effector ? none : targets[e];
        }
        for (int j = joints - 1; j > 0; --j) {
            if (shape.proposals[j] == 0) continue;
            p[j] = proposed[j];
            if (shape.proposals[j] > 1) p[j] = p[j] * T(1.0f / static_cast<float>(shape.proposals[j]));
            int parent = shape.parents[j];
            if (parent > 0) proposed[parent] = proposed[parent] + drawn(p[j], p[parent], bones[j]);
        }
        for (int j = 1; j < joints; ++j) {
            V3<T> from = p[shape.parents[j]];
            p[j] = shape.proposals[j] == 0 ? from + offsets[j] : drawn(from, p[j], bones[j]);
        }
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
