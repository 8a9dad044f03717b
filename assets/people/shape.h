// The figure of a built-in person: proportions, face, hair and clothes as an implicit body. Lengths in body
// heights of an adult of that shape, bind pose: standing on y = 0, facing +z, arms straight and 40 degrees
// out. Children and the stooped are made of the same body, bent at last by `warped`.
#pragma once

#include "assets/character.h"
#include "assets/people/shapes/field.h"

namespace flaneur {

// Factors of about 1 on a middle face, but for the eye: its place on the left, in head heights above the
// chin.
struct FaceShape {
    float jaw = 1, chin = 1, cheek = 1, brow = 1;
    float nose_length = 1, nose_width = 1, nose_out = 1;
    float lips = 1, mouth = 1, eye_size = 1, ear = 1;
    Vec3 eye{0.140f, 0.485f, 0.345f};
};

struct Figure : PersonOptions {
    float grown = 1;     // 0 a small child .. 1 an adult
    float feminine = 0;  // 0 a man's body .. 1 a woman's
    float robe_hem = 0;  // lower end of a skirt or coat that hangs round both legs; 0 without
    FaceShape face;
    float head_scale = 1, leg_scale = 1, torso_scale = 1, stoop = 0;  // see warped

    bool has_skirt() const { return bottom >= Bottom::skirt; }
    bool bare_arms() const { return top == Top::t_shirt && (over == Over::none || over == Over::vest); }
    bool bare_legs() const { return has_skirt() || bottom == Bottom::shorts; }
};

// What a vertex shows. The order is that of material_looks.
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
    material_zip,
    material_top_lining,
    material_bottom,
    material_bottom_lining,
    material_belt,
    material_shoes,
    material_sole,
    material_collar,
    material_trim,
};
inline constexpr int k_material_count = 18;
struct MaterialLook {
    Layer layer;
    Tint tint;
    uint32_t colour;
};
std::array<MaterialLook, k_material_count> material_looks(const Figure& figure);

uint32_t scaled_colour(uint32_t colour, float by);  // but for its alpha

Figure choose_figure(const PersonOptions& options);

// From the adult body to this person's: the legs' and the torso's length, the size of the head about the
// neck, the bent back.
Vec3 warped(const Figure& figure, Vec3 p);

// Joints of the bind pose, not warped.
std::array<Vec3, k_joint_count> bind_joints(const Figure& figure);
// Joints of the canonical pose, made of the bind pose's, warped, with the arms let down.
Body figure_body(const std::array<Vec3, k_joint_count>& warped_bind_joints);
// The unit direction of the left arm in the bind pose, not warped.
Vec3 bind_arm_direction();

Field figure_field(const Figure& figure);
void material_distances(const Figure& figure, const LayerDistances& layers, Vec3 p, std::span<float> out);

}  // namespace flaneur
