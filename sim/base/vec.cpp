#include "sim/base/vec.h"

namespace flaneur {

Quat rotation_between(Vec3 from, Vec3 to) {
    Vec3 axis = cross(from, to);
    float w = 1 + dot(from, to);
    if (w > 1e-6f) return normalize({axis.x, axis.y, axis.z, w});
    Vec3 other = std::fabs(from.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    Vec3 a = normalize_or(cross(from, other), {0, 0, 1});
    return {a.x, a.y, a.z, 0};
}

}  // namespace flaneur
