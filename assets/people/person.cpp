#include <algorithm>
#include <span>

#include "assets/character.h"
#include "assets/girth.h"
#include "assets/people/accessories.h"
#include "assets/people/face.h"
#include "assets/people/lods.h"
#include "assets/people/parts.h"
#include "assets/people/pram.h"
#include "assets/people/shape.h"
#include "assets/people/shapes/mesh.h"
#include "assets/people/skin.h"

namespace flaneur {

namespace {

constexpr size_t k_finest_triangles = 7600;
constexpr float k_thighs = .45f, k_shoulders = .80f;  // between them is what girths are measured of

void steps(std::vector<float>& out, float to, float step) {
    while (out.back() < to) out.push_back(out.back() + step);
}

// Samples close above and below `hem`, which is even then, instead of what was there.
void add_hem(std::vector<float>& out, float hem) {
    std::erase_if(out, [&](float y) { return y > hem - .0055f && y < hem + .0055f; });
    for (float y : {-.0036f, -.0012f, .0012f, .0036f}) out.push_back(hem + y);
    std::sort(out.begin(), out.end());
}

// Finer at the head, the hands and hems.
FieldGrid person_grid(const Figure& figure) {
    FieldGrid g{{.0012f}, {-.008f}, {-.125f}};
    steps(g.half_x, .052f, .0027f);
    steps(g.half_x, .290f, .0068f);
    steps(g.half_x, .430f, .0034f);
    steps(g.y, .060f, .0046f);
    steps(g.y, .430f, .0080f);
    steps(g.y, .560f, .0042f);
    steps(g.y, .800f, .0072f);
    steps(g.y, 1.030f, .0027f);
    add_hem(g.y, top_hem(figure));
    if (figure.robe_hem > 0) add_hem(g.y, figure.robe_hem);
    steps(g.z, -.042f, .0050f);
    steps(g.z, .030f, .0034f);
    steps(g.z, .140f, .0042f);
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

// By vertex, where its triangles face on average.
std::vector<Vec3> facing_of(const FieldMesh& mesh) {
    std::vector<Vec3> facing(mesh.positions.size());
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        const uint32_t* v = &mesh.indices[t];
        Vec3 a = mesh.positions[v[0]];
        Vec3 n = cross(mesh.positions[v[1]] - a, mesh.positions[v[2]] - a);
        for (int i = 0; i < 3; ++i) facing[v[i]] += n;
    }
    for (Vec3& f : facing) f = normalize_or(f * 1e6f, {0, 1, 0});
    return facing;
}

// Locks of hair, lighter and darker, that fall from the crown.
float strand(Vec3 p) {
    Vec3 f = to_face(p) - Vec3{0, 0, -.05f};
    float out = std::sqrt(f.x * f.x + f.z * f.z) + .05f, x = f.x < 0 ? -f.x : f.x;
    float turn = (f.z > 0 ? 1 - x / out : x / out - 1) * 11;  // from the front round to the back
    float place = turn - float(int(turn + 16) - 16), wave = place * (1 - place) * 4;
    return .84f + .20f * wave;
}

void add_accessory(const Accessory& a, const Figure& figure, const Field& field,
                   const std::array<Vec3, k_joint_count>& bind, Character& person) {
    auto first = uint32_t(person.vertices.size());
    std::vector<uint16_t> near;
    for (size_t i = 0; i < a.solid.positions.size(); ++i) {
        CharacterVertex v;
        v.position = a.solid.positions[i];
        v.normal = a.solid.normals[i];
        v.tint = a.tint;
        float open = openness(field, v.position + v.normal * .004f, v.normal, near);
        v.colour = scaled_colour(a.colour, .55f + .45f * open);
        std::array<float, k_joint_count> weights{};
        if (a.joint >= 0)
            weights[size_t(a.joint)] = 1;
        else
            weights = skin_weights(v.position, layer_top, figure, bind);
        pack_weights(weights, v);
        if (a.follower >= 0) {
            float share = a.from == a.to ? 1 : smoothstep(a.from, a.to, length(v.position - a.pivot));
            pack_weights(hung_on(a.follower, share, weights), v.hung_joints, v.hung_weights);
        }
        person.vertices.push_back(v);
    }
    if (a.follower >= 0 && a.joint >= 0)
        person.followers[size_t(a.follower - k_joint_count)] = {a.pivot, uint32_t(a.joint)};
    for (uint32_t i : a.solid.indices) person.lods[0].push_back(first + i);
}

// The normal of a surface that had normal n at p before it was warped.
Vec3 warped_normal(const Figure& figure, Vec3 p, Vec3 n) {
    constexpr float h = 1e-3f;
    Vec3 u = normalize_or(cross(n, n.y * n.y < .5f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}), {1, 0, 0});
    Vec3 v = cross(n, u);
    return normalize_or(cross(warped(figure, p + u * h) - warped(figure, p - u * h),
                              warped(figure, p + v * h) - warped(figure, p - v * h)),
                        n);
}

// Of places (see place_numbers) where something hangs; elsewhere nothing.
std::vector<HungWeights> hung_weights(const FieldMesh& mesh, std::span<const MaterialLook> looks,
                                      std::span<const uint32_t> place, const Figure& figure,
                                      const std::array<Vec3, k_joint_count>& bind) {
    enum Way : uint8_t { body, hair, robe, leg };  // of several at a place the last holds: legs stay legs
    std::vector<uint8_t> ways(mesh.positions.size(), body);
    auto way_of = [&](size_t v) -> Way {
        const Layer layer = looks[mesh.materials[v]].layer;
        if (layer == layer_hair) return hair;
        if (figure.robe_hem == 0 || mesh.positions[v].y > .57f) return body;
        if (is_robe(layer, figure)) return robe;
        return mesh.positions[v].y < figure.robe_hem + .05f ? leg : body;
    };
    for (size_t v = 0; v < mesh.positions.size(); ++v)
        ways[place[v]] = std::max<uint8_t>(ways[place[v]], way_of(v));
    std::vector<HungWeights> out(mesh.positions.size());
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const Way way = way_of(v);
        if (way == body || way != ways[place[v]]) continue;
        const Vec3 p = mesh.positions[v];
        const auto own = skin_weights(p, looks[mesh.materials[v]].layer, figure, bind, true);
        HungWeights here = hung_on(skirt_front, 0, own);
        if (way == robe) here = robe_weights(p, own);
        if (way == hair) here = hair_weights(p, figure, own);
        for (size_t j = 0; j < here.size(); ++j) out[place[v]][j] += here[j];
    }
    return out;
}

// But for what is carried.
std::array<Hung, k_follower_count> followers_of(const Figure& figure) {
    std::array<Hung, k_follower_count> out;
    const Vec3 hip = bind_joints(figure)[left_upper_leg];
    for (int skirt : {skirt_front, skirt_back})
        out[size_t(skirt - k_joint_count)] = {{0, hip.y, hip.z}, hips};
    const bool tied = figure.hair == Hair::ponytail;
    out[loose_hair - k_joint_count] = {tied ? from_face({0, .76f, -.50f}) : from_face({0, -.02f, -.30f}),
                                       head};
    out[scarf_end - k_joint_count] = {{.019f, .795f, .065f}, upper_chest};
    return out;
}

// Of the trunk's surface before it was simplified, which another machine's library may do in another way:
// what bodies do follows from it.
std::vector<Vec3> trunk_of(const FieldMesh& mesh, std::span<const MaterialLook> looks, const Figure& figure,
                           const std::array<Vec3, k_joint_count>& bind) {
    std::vector<Vec3> surface;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const Vec3 p = mesh.positions[v];
        const Layer layer = looks[mesh.materials[v]].layer;
        if (layer == layer_hair || p.y < k_thighs || p.y > k_shoulders) continue;
        const auto weights = skin_weights(p, layer, figure, bind);
        const auto heaviest = std::ranges::max_element(weights) - weights.begin();
        if (is_of_trunk(int(heaviest))) surface.push_back(p);
    }
    return surface;
}

// From the adult of height 1 to the person, and the joints that go with it.
void warp_person(const Figure& figure, std::array<Vec3, k_joint_count> bind, Character& person) {
    for (CharacterVertex& v : person.vertices) {
        v.normal = warped_normal(figure, v.position, v.normal);
        v.position = warped(figure, v.position) * figure.height;
    }
    for (Hung& hung : person.followers) hung.place = warped(figure, hung.place) * figure.height;
    if (figure.robe_hem > 0) person.robe_hem = warped(figure, {0, figure.robe_hem, 0}).y * figure.height;
    for (Vec3& joint : bind) joint = warped(figure, joint);
    Body& body = person.body = figure_body(bind);
    for (size_t j = 0; j < k_joint_count; ++j) {
        body.joints[j] = body.joints[j] * figure.height;
        person.bind_joints[j] = bind[j] * figure.height;
    }
    body.height *= figure.height;
    body.heel *= figure.height;
    body.toe *= figure.height;
    for (int first : {int(left_upper_arm), int(right_upper_arm)})
        for (int j = first; j <= first + 2; ++j) {
            int from = std::min(j, first + 1);  // the hand is held as the forearm is
            Vec3 way = normalize_or(bind[size_t(from + 1)] - bind[size_t(from)], {0, -1, 0});
            person.bind_to_canonical[size_t(j)] = rotation_between(way, {0, -1, 0});
        }
    if (!has_stick(figure)) return;
    Vec3 tip = warped(figure, stick_tip(figure)) * figure.height;
    body.cane = rotate(person.bind_to_canonical[right_hand], tip - person.bind_joints[right_hand]);
}

// Skirts and dresses have pockets only under a coat or a jacket.
Wear wear_of(const PersonOptions& p) {
    bool skirted = p.bottom == Bottom::skirt || p.bottom == Bottom::long_skirt || p.bottom == Bottom::dress;
    return {p.bag, !skirted || p.over != Over::none, p.phone};
}

}  // namespace

Character generate_person(const PersonOptions& options) {
    Figure figure = choose_figure(options);
    Field field = figure_field(figure);
    FieldMesh mesh = polygonise(field, person_grid(figure));
    const auto looks = material_looks(figure);
    std::array<Layer, k_material_count> layer_of;
    for (size_t m = 0; m < layer_of.size(); ++m) layer_of[m] = looks[m].layer;
    mesh =
        cut_materials(mesh, field, layer_of, [&](const LayerDistances& layers, Vec3 p, std::span<float> out) {
            material_distances(figure, layers, p, out);
        });
    const std::vector<Accessory> accessories = make_accessories(figure, field);
    size_t carried = 0;
    for (const Accessory& a : accessories) carried += a.solid.indices.size() / 3;
    const auto bind = bind_joints(figure);
    std::vector<Vec3> trunk = trunk_of(mesh, looks, figure, bind);
    simplify_mesh(mesh, k_finest_triangles - carried, importance);
    Unpainted unpainted{painted_over(mesh, is_painted, material_skin),
                        {},
                        face_patches(figure, false),
                        face_patches(figure, figure.glasses),
                        {}};

    Character person;
    person.person = options;
    person.followers = followers_of(figure);
    person.name = figure.age < 16 ? (options.woman ? "girl" : "boy") : (options.woman ? "woman" : "man");
    const std::vector<Vec3> facing = facing_of(mesh);
    const std::vector<uint32_t> place = place_numbers(mesh.positions);
    // What lies at one place goes one way, or garments would come apart where they meet.
    std::vector<std::array<float, k_joint_count>> weights(mesh.positions.size());
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const auto own = skin_weights(mesh.positions[v], looks[mesh.materials[v]].layer, figure, bind);
        for (size_t j = 0; j < own.size(); ++j) weights[place[v]][j] += own[j];
    }
    const std::vector<HungWeights> hung = hung_weights(mesh, looks, place, figure, bind);
    std::vector<uint16_t> near;
    for (size_t v = 0; v < mesh.positions.size(); ++v) {
        const MaterialLook& look = looks[mesh.materials[v]];
        Vec3 p = mesh.positions[v];
        parts_near(field, p, .01f, near);
        CharacterVertex vertex;
        vertex.normal = normalize_or(gradient(field, near, p, look.layer), {0, 1, 0});
        // Where garments meet, the field of one bends away under the other.
        if (dot(vertex.normal, facing[v]) < .6f) vertex.normal = facing[v];
        vertex.tint = look.tint;
        pack_weights(weights[place[v]], vertex);
        if (std::ranges::any_of(hung[place[v]], [](float w) { return w > 0; }))
            pack_weights(hung[place[v]], vertex.hung_joints, vertex.hung_weights);
        float light = .55f + .45f * openness(field, p, vertex.normal, near);
        if (look.layer == layer_hair) light = strand(p) * (.3f + .7f * light);
        vertex.colour = scaled_colour(look.colour, light);
        vertex.position = p;
        person.vertices.push_back(vertex);
    }
    person.lods.push_back(std::move(mesh.indices));
    for (const Accessory& a : accessories) {
        const auto first = std::ptrdiff_t(person.lods[0].size());
        add_accessory(a, figure, field, bind, person);
        const auto from = person.lods[0].begin() + first, to = person.lods[0].end();
        auto& level = a.painted_afar ? unpainted.glasses : unpainted.triangles;
        level.insert(level.end(), from, to);
    }

    warp_person(figure, bind, person);
    for (Vec3& p : trunk) p = warped(figure, p) * figure.height;
    person.body.girth = measure_girth(person.body, trunk);
    person.body.wear = wear_of(options);
    if (figure.pram) unpainted.pram = add_pram(figure.seed, person);
    build_person_lods(person, unpainted);
    return person;
}

}  // namespace flaneur
