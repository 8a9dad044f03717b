#include "assets/person_shape.h"

#include <algorithm>

#include "assets/person_parts.h"
#include "sim/base/rng.h"

namespace flaneur {

const std::array<MaterialLook, k_material_count> k_materials = {{
    {layer_skin, Tint::skin, 0xffffffff},
    {layer_skin, Tint::skin, 0xffa3a0e4},
    {layer_skin, Tint::none, 0xffe4e8ec},
    {layer_skin, Tint::none, 0xff1c242e},
    {layer_skin, Tint::none, 0xff20242c},
    {layer_skin, Tint::hair, 0xffd8d8d8},
    {layer_hair, Tint::hair, 0xffffffff},
    {layer_inner, Tint::accent, 0xffffffff},
    {layer_top, Tint::top, 0xffffffff},
    {layer_bottom, Tint::bottom, 0xffffffff},
    {layer_bottom, Tint::shoes, 0xffc8c8c8},
    {layer_shoes, Tint::shoes, 0xffffffff},
    {layer_shoes, Tint::shoes, 0xff707070},
}};

Figure choose_figure(const PersonOptions& options) {
    Figure f{options};
    f.skirt = options.bottom >= Bottom::skirt && options.over != Over::coat;
    return f;
}

Vec3 bind_arm_direction() { return {0.6427876f, -0.7660444f, 0}; }

Body figure_body(const Figure& figure) {
    Body b = standard_body(1);
    Vec3 shoulder = figure_shoulder(figure);
    auto both = [&](Joint left, Joint right, Vec3 place) {
        b.joints[left] = place;
        b.joints[right] = {-place.x, place.y, place.z};
    };
    both(left_upper_arm, right_upper_arm, shoulder);
    both(left_lower_arm, right_lower_arm, shoulder - Vec3{0, 0.183f, 0});
    both(left_hand, right_hand, shoulder - Vec3{0, 0.327f, 0});
    b.heel = 0.038f;
    b.toe = 0.046f;
    return b;
}

std::array<Vec3, k_joint_count> figure_bind_joints(const Body& body) {
    auto joints = body.joints;
    for (int left = left_lower_arm; left <= left_hand; ++left) {
        float along = body.joints[left_upper_arm].y - body.joints[size_t(left)].y;
        Vec3 place = body.joints[left_upper_arm] + bind_arm_direction() * along;
        joints[size_t(left)] = place;
        joints[size_t(left + right_hand - left_hand)] = {-place.x, place.y, place.z};
    }
    return joints;
}

Field figure_field(const Figure& figure) {
    Field field;
    add_body(field, figure);
    add_head(field, figure);
    add_hair(field, figure);
    add_clothes(field, figure);
    return field;
}

namespace {

// Inside an almond `half_width` long that rises `up` above its axis and `down` below: negative.
float almond(float x, float y, float half_width, float up, float down) {
    float height = y > 0 ? up : down;
    float bow = height * (1 - x * x / (half_width * half_width));
    return (y > 0 ? y : -y) - bow;
}

}  // namespace

void material_distances(const Figure& figure, const LayerDistances& layers, Vec3 p, std::span<float> out) {
    for (float& d : out) d = 2;  // farther than any layer
    for (Material m :
         {material_skin, material_hair, material_inner, material_top, material_bottom, material_shoes})
        out[m] = layers[k_materials[m].layer];
    // Over whatever its layer shows so far, where `inside` is negative.
    auto paint = [&](Material m, float inside) {
        float below = 2;
        for (size_t n = 0; n < k_material_count; ++n)
            if (k_materials[n].layer == k_materials[m].layer) below = std::min(below, out[n]);
        out[m] = below + inside;
    };

    Vec3 face = to_face(p);
    if (face.y > 0 && face.y < 1 && face.z > 0.1f) {
        float s = k_head_height, x = face.x < 0 ? -face.x : face.x;
        float ex = x - k_eye.x, ey = face.y - k_eye.y - 0.12f * ex;
        float eye = almond(ex, ey, 0.074f, 0.032f, 0.022f), lid = almond(ex, ey, 0.084f, 0.046f, 0.012f);
        paint(material_lash, std::max(lid, -ey) * s);
        paint(material_eye_white, eye * s);
        paint(material_iris, std::max(eye, std::sqrt(ex * ex + ey * ey) - 0.028f) * s);
        float arch = 0.012f - 1.1f * (x - 0.16f) * (x - 0.16f);
        float by = face.y - (figure.woman ? 0.582f : 0.568f) - arch;
        float thick = (figure.woman ? 0.011f : 0.017f) * (1 - smoothstep(0.15f, 0.26f, x) * 0.6f);
        paint(material_brow,
              std::max((by > 0 ? by : -by) - thick, (x > 0.145f ? x - 0.145f : 0.145f - x) - 0.085f) * s);
        paint(material_lips,
              almond(x, face.y - k_mouth_y, figure.woman ? 0.098f : 0.105f, 0.030f, 0.036f) * s);
    }
    paint(material_sole, p.y - 0.0085f);
    float band = p.y - 0.583f;
    if (!figure.skirt) paint(material_belt, (band > 0 ? band : -band) - 0.011f);
}

}  // namespace flaneur
