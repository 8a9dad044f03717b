// What a joint's name suggests it is, in the tongues of Mixamo, VRM, Unreal, Biped, Blender, CMU and their
// kin.
#pragma once

#include <string_view>

namespace flaneur {

enum class BoneKind {
    none,
    clavicle,
    upper_arm,
    lower_arm,
    hand,
    upper_leg,
    lower_leg,
    foot,
    toes,
    neck,
    head
};

BoneKind bone_kind(std::string_view name);

// 1 for a name that says left, -1 for right, 0 for neither.
int bone_side(std::string_view name);

// Whether the name is of a part that lies ahead of what carries it: a thumb, or eyes, nose and mouth.
bool lies_in_front(std::string_view name);

}  // namespace flaneur
