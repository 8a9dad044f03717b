#include "assets/character.h"
#include "assets/person_mesh.h"
#include "assets/person_shape.h"
#include "assets/person_skin.h"

namespace flaneur {

namespace {

constexpr size_t k_finest_triangles = 7600;

void steps(std::vector<float>& out, float to, float step) {
    while (out.back() < to) out.push_back(out.back() + step);
}

// Finer at the head and the hands.
FieldGrid person_grid() {
    FieldGrid g{{.0012f}, {-.008f}, {-.125f}};
    steps(g.half_x, .052f, .0024f);
    steps(g.half_x, .300f, .0045f);
    steps(g.half_x, .430f, .0028f);
    steps(g.y, .440f, .0045f);
    steps(g.y, .560f, .0032f);
    steps(g.y, .855f, .0045f);
    steps(g.y, 1.020f, .0023f);
    steps(g.z, -.042f, .0036f);
    steps(g.z, .030f, .0026f);
    steps(g.z, .140f, .0036f);
    return g;
}

// The eye looks at faces first, then at hands: they get more triangles than their size asks for.
Vec3 importance(Vec3 p) {
    Vec3 neck{0, .86f, 0};
    float face = smoothstep(.850f, .885f, p.y) * (p.z > 0 ? 2.4f : 1.0f);
    if (p.y > .84f) return p + (p - neck) * face;
    Vec3 wrist{p.x < 0 ? -.315f : .315f, .545f, 0};
    float hand = smoothstep(.295f, .325f, p.x < 0 ? -p.x : p.x);
    return p + (p - wrist) * hand;
}

Vec3 gradient(const Field& field, std::span<const uint16_t> near, Vec3 p, int layer) {
    constexpr float h = 8e-4f;
    auto at = [&](Vec3 q) {
        LayerDistances d = layer_distances(field, near, q);
        return layer < 0 ? distance(d) : d[size_t(layer)];
    };
    Vec3 g{at(p + Vec3{h, 0, 0}) - at(p - Vec3{h, 0, 0}), at(p + Vec3{0, h, 0}) - at(p - Vec3{0, h, 0}),
           at(p + Vec3{0, 0, h}) - at(p - Vec3{0, 0, h})};
    return g / (2 * h);
}

// How open the surroundings are, 0..1: distances ahead of the surface compared with what a plane would give.
float openness(const Field& field, Vec3 p, Vec3 normal, std::vector<uint16_t>& near) {
    float open = 1;
    for (float reach : {.008f, .025f, .060f}) {
        Vec3 q = p + normal * reach;
        parts_near(field, q, reach, near);
        float d = clamp(distance(layer_distances(field, near, q)) / reach, 0, 1);
        open -= (1 - d) * .28f;
    }
    return open;
}

uint32_t scaled_colour(uint32_t colour, float f) {
    uint32_t out = colour & 0xff000000u;
    for (int shift = 0; shift < 24; shift += 8)
        out |= uint32_t(clamp(float(colour >> shift & 0xff) * f, 0, 255)) << shift;
    return out;
}

}  // namespace

Character generate_person(const PersonOptions& options) {
    Figure figure = choose_figure(options);
    Field field = figure_field(figure);
    FieldMesh mesh = polygonise(field, person_grid());
    std::array<Layer, k_material_count> layer_of;
    for (size_t m = 0; m < layer_of.size(); ++m) layer_of[m] = k_materials[m].layer;
    mesh =
        cut_materials(mesh, field, layer_of, [&](const LayerDistances& layers, Vec3 p, std::span<float> out) {
            material_distances(figure, layers, p, out);
        });
    simplify_mesh(mesh, k_finest_triangles, importance);

    Character person;
    person.person = options;
    person.name = options.woman ? "woman" : "man";
    person.body = figure_body(figure);
    auto bind = figure_bind_joints(person.body);
    std::vector<uint16_t> near;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const MaterialLook& look = k_materials[mesh.materials[v]];
        Vec3 p = mesh.positions[v];
        parts_near(field, p, .01f, near);
        CharacterVertex vertex;
        vertex.normal = normalize_or(gradient(field, near, p, look.layer), {0, 1, 0});
        vertex.tint = look.tint;
        pack_weights(skin_weights(p, look.layer, figure, bind), vertex);
        vertex.colour = scaled_colour(look.colour, .55f + .45f * openness(field, p, vertex.normal, near));
        vertex.position = p * options.height;
        person.vertices.push_back(vertex);
    }
    person.lods.push_back(std::move(mesh.indices));

    for (size_t j = 0; j < k_joint_count; ++j) {
        person.body.joints[j] = person.body.joints[j] * options.height;
        person.bind_joints[j] = bind[j] * options.height;
        person.bind_to_canonical[j] = {};
    }
    person.body.height = options.height;
    person.body.heel *= options.height;
    person.body.toe *= options.height;
    Vec3 arm = bind_arm_direction();
    for (int j = left_upper_arm; j <= left_hand; ++j) {
        person.bind_to_canonical[size_t(j)] = rotation_between(arm, {0, -1, 0});
        person.bind_to_canonical[size_t(j + right_hand - left_hand)] =
            rotation_between({-arm.x, arm.y, 0}, {0, -1, 0});
    }
    build_lods(person);
    return person;
}

}  // namespace flaneur
