// The figure of a built-in person: proportions, face, hair and clothes as an implicit body. Lengths in body
// heights, bind pose: standing on y = 0, facing +z, arms straight and 40 degrees out.
#pragma once

#include "assets/character.h"
#include "assets/person_field.h"

namespace flaneur {

struct Figure : PersonOptions {
    bool skirt = false;  // of any length
};

// What a vertex shows. The order is that of k_materials.
enum Material : uint8_t {
    material_skin,
    material_lips,
    material_eye_white,
    material_iris,
    material_lash,
    material_brow,
    material_hair,
    material_inner,
    material_top,
    material_bottom,
    material_belt,
    material_shoes,
    material_sole,
};
inline constexpr int k_material_count = 13;
struct MaterialLook {
    Layer layer;
    Tint tint;
    uint32_t colour;
};
extern const std::array<MaterialLook, k_material_count> k_materials;

Figure choose_figure(const PersonOptions& options);

// Joints of the canonical pose, body height 1.
Body figure_body(const Figure& figure);
// Joints of the bind pose, body height 1.
std::array<Vec3, k_joint_count> figure_bind_joints(const Body& body);
// The unit direction of the left arm in the bind pose.
Vec3 bind_arm_direction();

Field figure_field(const Figure& figure);
void material_distances(const Figure& figure, const LayerDistances& layers, Vec3 p, std::span<float> out);

}  // namespace flaneur
