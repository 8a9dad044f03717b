// The parts of a figure's implicit body, by region. See shape.h for units and pose.
#pragma once

#include "assets/people/shape.h"

namespace flaneur {

inline constexpr float k_head_height = 0.130f;  // chin to crown
inline constexpr float k_chin_y = 0.868f;
inline constexpr float k_head_z = 0.012f;  // of the ears
inline constexpr float k_mouth_y = 0.190f;

// Head heights, from the chin up and from the ears ahead.
constexpr Vec3 to_face(Vec3 p) {
    return {p.x / k_head_height, (p.y - k_chin_y) / k_head_height, (p.z - k_head_z) / k_head_height};
}
constexpr Vec3 from_face(Vec3 f) {
    return {f.x * k_head_height, k_chin_y + f.y * k_head_height, k_head_z + f.z * k_head_height};
}

// In head heights, as places of the face are.
Loft face_ellipsoid(Vec3 centre, Vec3 radii);
// Rings in head heights, t upward from the chin.
Loft head_loft(std::span<const BodyRing> rings, float cap_begin, float cap_end);

// The left shoulder joint.
inline Vec3 figure_shoulder(const Figure& figure) {
    float broad = lerp(.1035f, .0950f, figure.feminine) - .004f * (1 - figure.grown);
    return {broad, .796f, -.010f};
}

// Bare lofts that skin and garments share.
Loft torso_loft(const Figure& figure);
Loft shoulder_loft(const Figure& figure);
Loft arm_loft(const Figure& figure);
Loft leg_loft(const Figure& figure);
Loft neck_loft(const Figure& figure);
Loft foot_loft(const Figure& figure);   // in a shoe
Loft skirt_loft(const Figure& figure);  // from its hem up, where there is one
Loft skull_loft(const Figure& figure);

// The lower end of what is outermost above, in body heights; a skirt or trousers end a little higher.
float top_hem(const Figure& figure);

void add_body(Field& field, const Figure& figure);  // neck, hands, what skin shows
void add_head(Field& field, const Figure& figure);
void add_hair(Field& field, const Figure& figure);
void add_beard(Field& field, const Figure& figure);
void add_upper_clothes(Field& field, const Figure& figure);
void add_lower_clothes(Field& field, const Figure& figure);

}  // namespace flaneur
