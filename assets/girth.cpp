#include "assets/girth.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

bool is_of_trunk(int joint) {
    return joint <= upper_chest || joint == left_upper_leg || joint == right_upper_leg;
}

Girth measure_girth(const Body& body, std::span<const Vec3> surface) {
    const Vec3 hip = body.joints[hips], middle = body.joints[upper_chest];
    const float shoulder = body.joints[left_upper_arm].y, trunk = shoulder - hip.y;
    Girth girth;
    for (Vec3 p : surface) {
        const float up = (p.y - hip.y) / trunk, x = std::fabs(p.x), z = p.z - hip.z;
        if (up > -0.12f && up < 0.04f && std::fabs(z) < 0.2f * trunk) girth.hip = std::max(girth.hip, x);
        if (up > -0.06f && up < 0.16f && x < 0.25f * trunk) {
            girth.belly = std::max(girth.belly, z);
            girth.back = std::max(girth.back, -z);
        }
        if (up > 0.4f && up < 0.7f && x < 0.35f * trunk) girth.chest = std::max(girth.chest, p.z - middle.z);
    }
    const Girth usual = girth_of({.joints = {}, .height = body.height});
    for (float Girth::*size : {&Girth::hip, &Girth::belly, &Girth::back, &Girth::chest})
        if (!(girth.*size > 0.4f * usual.*size)) girth.*size = usual.*size;
    return girth;
}

}  // namespace flaneur
