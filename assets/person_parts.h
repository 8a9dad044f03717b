// The parts of a figure's implicit body, by region. See person_shape.h for units and pose.
#pragma once

#include "assets/person_shape.h"

namespace flaneur {

inline constexpr float k_head_height = 0.130f;  // chin to crown
inline constexpr float k_chin_y = 0.868f;
inline constexpr float k_head_z = 0.012f;                // of the ears
inline constexpr Vec3 k_eye = {0.140f, 0.485f, 0.345f};  // the left eye, head heights above the chin
inline constexpr float k_mouth_y = 0.190f;

// Head heights, from the chin up and from the ears ahead.
constexpr Vec3 to_face(Vec3 p) {
    return {p.x / k_head_height, (p.y - k_chin_y) / k_head_height, (p.z - k_head_z) / k_head_height};
}
constexpr Vec3 from_face(Vec3 f) {
    return {f.x * k_head_height, k_chin_y + f.y * k_head_height, k_head_z + f.z * k_head_height};
}

// The left shoulder joint.
constexpr Vec3 figure_shoulder(const Figure& figure) { return {figure.woman ? .095f : .105f, .798f, -.010f}; }

// Bare lofts that skin and garments share.
Loft torso_loft(const Figure& figure);
Loft shoulder_loft(const Figure& figure);
Loft arm_loft(const Figure& figure);
Loft leg_loft(const Figure& figure);
Loft neck_loft(const Figure& figure);
Loft skull_loft(const Figure& figure);

// Legs show below a skirt.
inline bool bare_legs(const Figure& figure) { return figure.skirt; }

void add_body(Field& field, const Figure& figure);  // neck, hands, what skin shows
void add_head(Field& field, const Figure& figure);
void add_hair(Field& field, const Figure& figure);
void add_clothes(Field& field, const Figure& figure);

}  // namespace flaneur
