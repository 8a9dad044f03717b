#include "assets/gltf/character/rig_carry.h"

namespace flaneur {

namespace {

// The joint of the body that is nearest to a joint of the rig when all rests.
uint8_t nearest_at_rest(const std::vector<RigJoint>& rig, const RigMap& map, const RigJoint& joint) {
    float least = 1e30f;
    size_t best = hips;
    for (size_t j = 0; j < k_joint_count; ++j) {
        if (map.joints[j] == k_not_found || rig[size_t(map.joints[j])].made_up) continue;
        float distance = length(rig[size_t(map.joints[j])].rest - joint.rest);
        if (distance < least) least = distance, best = j;
    }
    return uint8_t(best);
}

}  // namespace

float settle(const std::vector<RigJoint>& rig, const RigTree& tree, RigMap& map) {
    std::vector<int> found(rig.size(), k_not_found);
    std::vector<uint8_t> done(rig.size(), 0), above(tree.joints.size(), 0);
    for (int j = 0; j < k_joint_count; ++j) {
        int& joint = map.joints[size_t(j)];
        if (joint == k_not_found) continue;
        for (int up = joint; up >= 0; up = tree.joints[size_t(up)].parent) above[size_t(up)] = 1;
        joint = tree.original[size_t(joint)];
        found[size_t(joint)] = j;
    }
    map.carried_by.assign(rig.size(), hips);
    std::vector<uint8_t> adrift(rig.size(), 0);
    auto carry = [&](size_t joint, int parent) {
        done[joint] = 1;
        adrift[joint] = found[joint] == k_not_found && (parent < 0 || adrift[size_t(parent)]);
        if (found[joint] != k_not_found)
            map.carried_by[joint] = uint8_t(found[joint]);
        else if (parent >= 0)
            map.carried_by[joint] = map.carried_by[size_t(parent)];
        // A foot may be two bones that begin at one ankle, of which one hangs from elsewhere.
        for (size_t foot : {size_t(left_foot), size_t(right_foot)}) {
            if (found[joint] != k_not_found || map.joints[foot] == k_not_found) continue;
            const RigJoint &ankle = rig[size_t(map.joints[foot])], &knee = rig[size_t(map.joints[foot - 1])];
            bool hangs_from_shin = parent >= 0 && found[size_t(parent)] == int(foot) - 1;
            if (hangs_from_shin && rig[joint].parent != rig[size_t(map.joints[foot])].parent &&
                length(rig[joint].place - ankle.place) < 0.02f * length(ankle.place - knee.place))
                map.carried_by[joint] = uint8_t(foot);
        }
    };
    float lost = 0, all = 0;
    for (size_t t = 0; t < tree.joints.size(); ++t) {
        int parent = tree.joints[t].parent;
        carry(size_t(tree.original[t]), parent < 0 ? -1 : tree.original[size_t(parent)]);
        all += tree.joints[t].mass;
        if (adrift[size_t(tree.original[t])] && !above[t]) lost += tree.joints[t].mass;
    }
    std::vector<uint8_t> root(rig.size(), 0);  // what the body hangs from
    for (int joint : map.joints)
        for (int up = joint; up >= 0; up = rig[size_t(up)].parent) root[size_t(up)] = 1;
    map.loose.assign(rig.size(), 0);
    for (size_t j = 0; j < rig.size(); ++j) {
        if (done[j]) continue;
        int parent = rig[j].parent;
        carry(j, parent);
        bool goes_along = parent >= 0 && map.loose[size_t(parent)];
        if (!adrift[j] || root[j] || (rig[j].mass <= 0 && !goes_along)) continue;
        map.loose[j] = 1;
        if (!goes_along) map.carried_by[j] = nearest_at_rest(rig, map, rig[j]);
    }
    return all > 0 ? lost / all : 0;
}

}  // namespace flaneur
