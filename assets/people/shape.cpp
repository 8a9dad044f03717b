#include "assets/people/shape.h"

#include <algorithm>

#include "assets/people/face.h"
#include "assets/people/parts.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_hip_y = .53f, k_neck_y = .845f;

void choose_face(Figure& f) {
    RandomKey key{f.seed, 0, 0, Purpose::look};
    uint32_t draw = 0;
    // A middle for a man, one for a woman, and what a child's face has of them.
    auto feature = [&](float man, float woman, float child, float spread) {
        float middle = lerp(child, lerp(man, woman, f.feminine), f.grown);
        return middle * (1 + spread * clamp(random_normal(key, draw++), -2, 2));
    };
    float old = smoothstep(50, 80, f.age), heavy = std::max(f.build, 0.0f);
    f.face.jaw = feature(1, .87f, .82f, .045f) * (1 + .07f * heavy);
    f.face.chin = feature(1, .74f, .62f, .10f);
    f.face.cheek = feature(1, 1, 1.08f, .06f) * (1 + .08f * heavy - .08f * old);
    f.face.brow = feature(1, .72f, .55f, .18f);
    f.face.nose_length = feature(1, .95f, .84f, .05f) * (1 + .05f * old);
    f.face.nose_width = feature(1, .86f, .84f, .12f) * (1 + .06f * old);
    f.face.nose_out = feature(1, .88f, .68f, .13f);
    f.face.lips = feature(.92f, 1.15f, 1, .14f) * (1 - .2f * old);
    f.face.mouth = feature(1, .95f, .84f, .06f);
    f.face.eye_size = feature(.93f, 1.02f, 1.14f, .05f) * (1 - .06f * old);
    f.face.ear = feature(1, .9f, 1, .07f) * (1 + .1f * old);
    f.face.eye.x = feature(.140f, .140f, .146f, .022f);
    f.face.eye.y = feature(.487f, .485f, .462f, .008f);
}

}  // namespace

Figure choose_figure(const PersonOptions& options) {
    Figure f;
    static_cast<PersonOptions&>(f) = options;
    f.age = clamp(f.age, 5, 85);
    f.build = clamp(f.build, -1, 1);
    f.grown = smoothstep(4, 17, f.age);
    f.feminine = f.woman ? smoothstep(6, 16, f.age) : .25f * (1 - smoothstep(8, 16, f.age));
    if (f.bottom == Bottom::skirt) f.robe_hem = .292f;
    if (f.bottom == Bottom::dress) f.robe_hem = .275f;
    if (f.bottom == Bottom::long_skirt) f.robe_hem = .105f;
    if (f.over == Over::coat) f.robe_hem = f.robe_hem > 0 ? f.robe_hem - .012f : .300f;
    choose_face(f);

    // A child of five is about six of its heads tall, an adult seven and a half (Stratz 1903); its legs are
    // the shorter part.
    f.head_scale = lerp(1.27f, 1, f.grown);
    f.torso_scale = 1;
    f.leg_scale = lerp(.955f, 1, f.grown);
    float height =
        k_hip_y * f.leg_scale + (k_neck_y - k_hip_y) * f.torso_scale + (1 - k_neck_y) * f.head_scale;
    f.head_scale /= height, f.leg_scale /= height, f.torso_scale /= height;
    f.stoop = smoothstep(62, 88, f.age) * (.7f + .5f * random_unit({f.seed, 1, 0, Purpose::look}));
    return f;
}

Vec3 warped(const Figure& f, Vec3 p) {
    Vec3 out = p;
    // A bend sets the chest ahead of the hips and lowers the head a little, which stays level.
    float chest = smoothstep(.56f, .86f, p.y), neck = smoothstep(.79f, .90f, p.y);
    float lost = .020f * f.stoop;
    float low = std::min(p.y, k_hip_y) * f.leg_scale, middle = clamp(p.y - k_hip_y, 0, k_neck_y - k_hip_y);
    float high = std::max(p.y - k_neck_y, 0.0f), grow = lerp(1, f.head_scale, smoothstep(.815f, .870f, p.y));
    out.y = low + middle * f.torso_scale + high * f.head_scale;
    out.x *= grow;
    out.z *= grow;
    // What the back loses in height the legs have, so that the crown stays where it is.
    out.y = out.y * (1 + lost) - lost * (chest * .6f + neck * .4f);
    out.z += f.stoop * (.034f * chest * chest + .026f * neck);
    return out;
}

Vec3 bind_arm_direction() { return {0.6427876f, -0.7660444f, 0}; }

std::array<Vec3, k_joint_count> bind_joints(const Figure& figure) {
    auto joints = standard_body(1).joints;
    Vec3 shoulder = figure_shoulder(figure);
    constexpr float k_elbow = .183f, k_wrist = .327f;
    auto both = [&](Joint left, Joint right, Vec3 place) {
        joints[left] = place;
        joints[right] = {-place.x, place.y, place.z};
    };
    both(left_upper_arm, right_upper_arm, shoulder);
    both(left_lower_arm, right_lower_arm, shoulder + bind_arm_direction() * k_elbow);
    both(left_hand, right_hand, shoulder + bind_arm_direction() * k_wrist);
    return joints;
}

Body figure_body(const std::array<Vec3, k_joint_count>& bind) {
    Body b;
    b.joints = bind;
    for (int first : {int(left_upper_arm), int(right_upper_arm)})
        for (int j = first + 1; j <= first + 2; ++j)
            b.joints[size_t(j)] =
                b.joints[size_t(j - 1)] - Vec3{0, length(bind[size_t(j)] - bind[size_t(j - 1)]), 0};
    b.height = 1;
    b.heel = .040f;
    b.toe = .046f;
    return b;
}

Field figure_field(const Figure& figure) {
    Field field;
    add_body(field, figure);
    add_head(field, figure);
    add_hair(field, figure);
    add_beard(field, figure);
    add_upper_clothes(field, figure);
    add_lower_clothes(field, figure);
    return field;
}

uint32_t scaled_colour(uint32_t colour, float f) {
    uint32_t out = colour & 0xff000000u;
    for (int shift = 0; shift < 24; shift += 8)
        out |= uint32_t(clamp(float(colour >> shift & 0xff) * f, 0, 255)) << shift;
    return out;
}

std::array<MaterialLook, k_material_count> material_looks(const Figure& figure) {
    // What is under a jacket takes the third colour; a dress is one with its top.
    bool covered = figure.over != Over::none;
    Tint inner = covered ? Tint::accent : Tint::top;
    Tint bottom = figure.bottom == Bottom::dress && !covered ? Tint::top : Tint::bottom;
    bool sporty = figure.shoes == Shoes::sneakers;
    uint32_t lips = figure.feminine > .6f && figure.age < 70 ? 0xff9392d2 : 0xffa9a8dc;
    return {{{layer_skin, Tint::skin, 0xffffffff},
             {layer_skin, Tint::skin, lips},
             {layer_skin, Tint::none, 0xffc8d0d6},
             {layer_skin, Tint::none, 0xff1c242e},
             {layer_skin, Tint::none, 0xff20242c},
             {layer_skin, Tint::hair, 0xffd0d0d0},
             {layer_hair, Tint::hair, 0xffffffff},
             {layer_inner, inner, 0xffffffff},
             {layer_top, Tint::top, 0xffffffff},
             {layer_top, Tint::top, 0xffa8a8a8},
             {layer_top, Tint::top, 0xff343434},
             {layer_bottom, bottom, 0xffffffff},
             {layer_bottom, bottom, 0xff343434},
             {layer_bottom, Tint::shoes, 0xffc8c8c8},
             {layer_shoes, Tint::shoes, 0xffffffff},
             {layer_shoes, sporty ? Tint::none : Tint::shoes, sporty ? 0xffdce2e4 : 0xff707070},
             {layer_collar, inner, 0xffffffff},
             {layer_trim, Tint::top, 0xfff4f4f4}}};
}

void material_distances(const Figure& figure, const LayerDistances& layers, Vec3 p, std::span<float> out) {
    std::fill(out.begin(), out.end(), 2.0f);  // farther than any layer
    out[material_skin] = layers[layer_skin];
    out[material_hair] = layers[layer_hair];
    out[material_inner] = layers[layer_inner];
    out[material_top] = layers[layer_top];
    out[material_bottom] = layers[layer_bottom];
    out[material_shoes] = layers[layer_shoes];
    out[material_collar] = layers[layer_collar];
    out[material_trim] = layers[layer_trim];

    Vec3 face = to_face(p);
    if (face.y > 0 && face.y < 1 && face.z > .1f) paint_face(figure, face, out);
    float sole = figure.shoes == Shoes::sneakers ? .0125f : .0075f;
    out[material_sole] = layers[layer_shoes] + p.y - sole;
    float x = p.x < 0 ? -p.x : p.x;
    if (figure.over == Over::jacket || figure.over == Over::vest || figure.over == Over::coat)
        if (p.z > 0) out[material_zip] = layers[layer_top] + x - .0035f;
    // Up a skirt it is dark, and under the hem of a shirt, but not up sleeves.
    float inside = p.y - figure.robe_hem - .0008f;
    if (x < .150f) out[material_top_lining] = layers[layer_top] + p.y - top_hem(figure) - .0008f;
    if (figure.has_skirt()) out[material_bottom_lining] = layers[layer_bottom] + inside;
    float band = p.y - .583f;
    if (!figure.has_skirt()) out[material_belt] = layers[layer_bottom] + (band > 0 ? band : -band) - .011f;
}

}  // namespace flaneur
