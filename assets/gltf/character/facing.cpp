#include "assets/gltf/character/facing.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

namespace {

// Flesh of the foot and all below it, seen from the ankle.
Vec3 foot_lead(const Rig& rig, int ankle) {
    Vec3 sum;
    float mass = 0;
    for (int j = ankle; j < rig.root(); ++j) {
        if (!rig.below(j, ankle)) continue;
        const RigJoint& joint = rig.joints[size_t(j)];
        sum += joint.flesh * joint.mass;
        mass += joint.mass;
    }
    return mass > 0 ? sum / mass - rig.place(ankle) : Vec3{};
}

float feet_ahead(const Rig& rig, const std::array<LegJoints, 2>& legs, Vec3 ahead) {
    float lead = 0;
    for (const LegJoints& leg : legs) {
        lead += dot(foot_lead(rig, leg[2]), ahead);
        if (leg[3] != k_not_found) lead += 0.3f * dot(rig.place(leg[3]) - rig.place(leg[2]), ahead);
    }
    return lead;
}

// 1 where every joint that is called left lies on the left and every right one on the right, -1 where they
// lie the other way round.
float names_agree(const Rig& rig, const std::array<LegJoints, 2>& legs, Vec3 left, float height) {
    Vec3 middle = (rig.place(legs[0][0]) + rig.place(legs[1][0])) * 0.5f;
    float agree = 0, count = 0;
    for (const RigJoint& joint : rig.joints) {
        auto side = float(bone_side(joint.name));
        float out = dot(joint.place - middle, left);
        if (side == 0 || std::fabs(out) < 0.02f * height) continue;
        agree += out * side > 0 ? 1.0f : -1.0f;
        ++count;
    }
    return count > 0 ? agree / count : 0;
}

// How far thumbs lie ahead of their hands, and the parts of a face ahead of the head.
float fronts_ahead(const Rig& rig, Vec3 ahead) {
    float lead = 0, count = 0;
    for (const RigJoint& joint : rig.joints) {
        if (joint.parent < 0 || !lies_in_front(joint.name)) continue;
        const RigJoint& parent = rig.joints[size_t(joint.parent)];
        if (lies_in_front(parent.name)) continue;
        lead += dot((joint.mass > 0 ? joint.flesh : joint.place) - parent.place, ahead);
        ++count;
    }
    return count > 0 ? lead / count : 0;
}

// How far knees lie ahead of the way from hip to ankle, of its length.
float knees_ahead(const Rig& rig, const std::array<LegJoints, 2>& legs, Vec3 ahead) {
    float lead = 0;
    for (const LegJoints& leg : legs) {
        Vec3 way = rig.place(leg[2]) - rig.place(leg[0]), knee = rig.place(leg[1]) - rig.place(leg[0]);
        float square = std::max(dot(way, way), 1e-12f);
        lead += dot(knee - way * (dot(knee, way) / square), ahead) / std::sqrt(square);
    }
    return lead;
}

}  // namespace

Facing weigh_facing(const Rig& rig, const std::array<LegJoints, 2>& legs, Vec3 up, Vec3 ahead, float height) {
    // Each tells no more than so much, however far it points: heel spurs may be longer than toes, names may
    // have left and right swapped, and knees may bend as a bird's. A glTF file faces +z, if nothing else
    // tells.
    constexpr float k_feet = 1, k_names = 0.6f, k_fronts = 0.8f, k_knees = 0.25f, k_file = 0.1f;
    auto told = [](float lead, float plain) { return clamp(lead / plain, -1, 1); };
    float feet = feet_ahead(rig, legs, ahead) / height;
    Facing facing;
    facing.feet_tell = std::fabs(feet) >= 0.01f;
    facing.sure = k_feet * told(feet, 0.06f) + k_names * names_agree(rig, legs, cross(up, ahead), height) +
                  k_fronts * told(fronts_ahead(rig, ahead) / height, 0.02f) +
                  k_knees * told(knees_ahead(rig, legs, ahead), 0.1f) + k_file * ahead.z;
    return facing;
}

}  // namespace flaneur
