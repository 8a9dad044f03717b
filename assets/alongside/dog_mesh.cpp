// Dogs as bodies of rounded parts that grow into each other, cut from a field as people are.
#include <algorithm>
#include <array>
#include <cmath>

#include "assets/alongside/thing.h"
#include "assets/colour.h"
#include "assets/people/shapes/mesh.h"
#include "assets/people/shapes/solid.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_round = 0.045f;  // withers, over which parts grow into each other

struct Look {
    float stout;   // widths, times as much
    float muzzle;  // withers
    float tail;    // how bushy
    bool ears_hang;
    uint32_t coat[k_coats], pale[k_coats], patch[k_coats];
};
constexpr Look k_looks[k_breeds] = {{1.02f,
                                     0.21f,
                                     0.8f,
                                     false,
                                     {rgb(0xd8cdb9), rgb(0x5b5550), rgb(0x8a6236)},
                                     {rgb(0xe9e2d3), rgb(0x9b948c), rgb(0xc7a878)},
                                     {rgb(0x8a5a34), rgb(0x3b3735), rgb(0x3a2b20)}},
                                    {1.0f,
                                     0.23f,
                                     1.25f,
                                     true,
                                     {rgb(0x7a4526), rgb(0x26231f), rgb(0xb9894d)},
                                     {rgb(0xe4dccb), rgb(0xded8cc), rgb(0xdcc096)},
                                     {rgb(0x5d3219), rgb(0x191715), rgb(0xa37440)}},
                                    {0.95f,
                                     0.25f,
                                     1.35f,
                                     false,
                                     {rgb(0x8b6b43), rgb(0xcdb182), rgb(0x4a3526)},
                                     {rgb(0xb08d5c), rgb(0xe0cda6), rgb(0x7d5c3e)},
                                     {rgb(0x2a2420), rgb(0xb4935f), rgb(0x2c2019)}}};

struct Sculptor {
    Field field;
    void add(Loft loft, float round = k_round) {
        field.parts.push_back({.layer = layer_skin, .round = round, .loft = std::move(loft)});
    }
    void limb(Vec3 a, Vec3 b, float ra, float rb, float round = k_round) {
        add(make_capsule(a, b, ra, rb), round);
    }
};

Vec3 left_of(Vec3 p) { return {std::fabs(p.x), p.y, p.z}; }

Field dog_field(Breed breed) {
    const DogShape& s = shape_of(breed);
    const Look& look = k_looks[static_cast<size_t>(breed)];
    const auto& j = s.joints;
    const float l = j[dog_neck].z - 0.02f, g = look.stout;
    Sculptor m;
    m.add(make_ellipsoid({0, .715f, l - .11f}, {.125f * g, .195f, .225f}));
    m.add(make_ellipsoid({0, .755f, -.06f}, {.110f * g, .135f * g, .33f}), .09f);
    m.add(make_ellipsoid({0, .775f, -l + .03f}, {.112f * g, .125f, .17f}), .09f);
    m.limb({0, .885f, l - .08f}, {0, .845f, -l + .02f}, .072f, .075f, .08f);
    const Vec3 nape = j[dog_neck] + Vec3{0, -.075f, -.06f}, skull = j[dog_head] + Vec3{0, .035f, .035f};
    m.limb(nape, lerp(nape, skull, .85f), .118f * g, .078f, .08f);
    m.limb(nape + Vec3{0, -.10f, .03f}, lerp(nape, skull, .5f), .095f, .07f, .08f);
    m.add(make_ellipsoid(skull + Vec3{0, .012f, .02f}, {.085f, .080f, .098f}));
    m.limb(skull + Vec3{0, -.020f, .07f}, skull + Vec3{0, -.036f, look.muzzle}, .056f, .036f, .05f);
    m.limb(skull + Vec3{0, -.052f, .06f}, skull + Vec3{0, -.062f, look.muzzle - .03f}, .040f, .026f, .04f);
    const Vec3 arm = left_of(j[dog_left_arm]), elbow = left_of(j[dog_left_forearm]),
               wrist = left_of(j[dog_left_paw]), pad = left_of(s.pads[k_fore_left]);
    m.add(make_ellipsoid(arm + Vec3{-.03f, -.11f, -.01f}, {.052f, .165f, .10f}), .06f);
    m.limb(lerp(arm, elbow, .35f), elbow, .066f, .050f, .05f);
    m.limb(elbow, wrist, .046f, .031f, .03f);
    m.limb(wrist, lerp(wrist, pad, .85f), .031f, .027f, .02f);
    m.add(make_ellipsoid(pad + Vec3{0, .026f, .026f}, {.035f, .026f, .058f}), .02f);
    const Vec3 hip = left_of(j[dog_left_thigh]), knee = left_of(j[dog_left_shank]),
               hock = left_of(j[dog_left_hind_paw]), toe = left_of(s.pads[k_hind_left]);
    m.limb(hip + Vec3{-.02f, -.02f, 0}, lerp(hip, knee, .8f), .115f * g, .072f, .06f);
    m.limb(hip + Vec3{-.01f, -.03f, -.03f}, lerp(knee, hock, .35f) + Vec3{0, 0, -.02f}, .085f, .05f, .06f);
    m.limb(knee, hock, .056f, .029f, .04f);
    m.limb(hock, lerp(hock, toe, .88f), .030f, .027f, .02f);
    m.add(make_ellipsoid(toe + Vec3{0, .026f, .026f}, {.034f, .026f, .056f}), .02f);
    const float t = look.tail;
    m.limb(j[dog_tail] + Vec3{0, 0, .05f}, j[dog_tail_middle], .034f, .034f * t, .05f);
    m.limb(j[dog_tail_middle], j[dog_tail_end], .034f * t, .030f * t, .03f);
    const Vec3 tip = j[dog_tail_end] + (j[dog_tail_end] - j[dog_tail_middle]) * .6f;
    m.limb(j[dog_tail_end], tip, .030f * t, .012f, .03f);
    const Vec3 ear = left_of(j[dog_left_ear]);
    if (look.ears_hang)
        m.add(make_ellipsoid(ear + Vec3{.022f, -.075f, .0f}, {.017f, .088f, .050f}), .012f);
    else
        m.add(make_ellipsoid(ear + Vec3{-.012f, .045f, .0f}, {.030f, .078f, .016f}), .022f);
    return m.field;
}

FieldGrid dog_grid(Breed breed) {
    const DogShape& s = shape_of(breed);
    constexpr float k_step = 0.0135f;
    FieldGrid grid;
    auto fill = [&](std::vector<float>& to, float from, float end) {
        for (float v = from; v <= end; v += k_step) to.push_back(v);
    };
    fill(grid.half_x, 0, 0.27f);
    fill(grid.y, -0.03f, s.joints[dog_head].y + 0.30f);
    fill(grid.z, s.joints[dog_tail_end].z - 0.26f, s.joints[dog_head].z + 0.40f);
    return grid;
}

// A bone from place to place, and how far it holds on to flesh.
struct Bone {
    int joint;
    Vec3 from, to;
    float wide;
};

std::vector<Bone> bones_of(Breed breed) {
    const DogShape& s = shape_of(breed);
    const auto& j = s.joints;
    const Vec3 nose = j[dog_head] + Vec3{0, 0, .25f};
    std::vector<Bone> bones = {
        {dog_pelvis, j[dog_tail] + Vec3{0, -.06f, .05f}, j[dog_loin] + Vec3{0, -.06f, -.12f}, .12f},
        {dog_loin, j[dog_loin] + Vec3{0, -.08f, -.06f}, j[dog_chest] + Vec3{0, -.08f, -.12f}, .12f},
        {dog_chest, j[dog_chest] + Vec3{0, -.10f, -.02f}, j[dog_neck] + Vec3{0, -.14f, -.06f}, .13f},
        {dog_neck, lerp(j[dog_neck], j[dog_head], .15f), lerp(j[dog_neck], j[dog_head], .8f), .09f},
        {dog_head, j[dog_head] + Vec3{0, .04f, .03f}, nose, .07f},
        {dog_tail, j[dog_tail] + Vec3{0, 0, -.03f}, j[dog_tail_middle], .03f},
        {dog_tail_middle, j[dog_tail_middle], j[dog_tail_end], .03f},
        {dog_tail_end, j[dog_tail_end], j[dog_tail_end] * 2.0f - j[dog_tail_middle], .03f}};
    const bool hang = k_looks[static_cast<size_t>(breed)].ears_hang;
    for (int ear : {int(dog_left_ear), int(dog_right_ear)}) {
        const Vec3 at = j[static_cast<size_t>(ear)], out{at.x > 0 ? .02f : -.02f, 0, 0};
        const Vec3 up{0, hang ? -1.0f : 1.0f, 0};
        bones.push_back({ear, at + out + up * .04f, at + out + up * .14f, .022f});
    }
    for (int leg = 0; leg < 4; ++leg) {
        constexpr int k_first[] = {dog_left_arm, dog_right_arm, dog_left_thigh, dog_right_thigh};
        const auto first = static_cast<size_t>(k_first[leg]);
        const Vec3 root = j[first], middle = j[first + 1], end = j[first + 2];
        const bool fore = leg < k_hind_left;
        bones.push_back({int(first), lerp(root, middle, fore ? .25f : .2f), middle, fore ? .06f : .085f});
        bones.push_back({int(first) + 1, middle, end, .045f});
        bones.push_back({int(first) + 2, end, s.pads[static_cast<size_t>(leg)] + Vec3{0, .02f, .02f}, .035f});
    }
    return bones;
}

float away_from(const Bone& bone, Vec3 p) {
    const Vec3 along = bone.to - bone.from;
    const float t = clamp(dot(p - bone.from, along) / std::max(dot(along, along), 1e-6f), 0, 1);
    return length(p - (bone.from + along * t)) / bone.wide;
}

void bind(const std::vector<Bone>& bones, ThingVertex& v) {
    float weights[k_dog_joints] = {};
    for (const Bone& bone : bones) {
        // Legs hold nothing of the other side.
        const float aside = bone.from.x;
        if (aside * v.position.x < 0 && std::fabs(aside) > .05f && bone.joint >= dog_left_arm &&
            std::fabs(v.position.x) > .01f)
            continue;
        const float away = away_from(bone, v.position);
        const float near = 1 / (0.02f + away * away * away * away);
        weights[bone.joint] = std::max(weights[bone.joint], near * near);
    }
    int order[k_dog_joints];
    for (int k = 0; k < k_dog_joints; ++k) order[k] = k;
    std::ranges::stable_sort(order, [&](int a, int b) { return weights[a] > weights[b]; });
    const float sum = weights[order[0]] + weights[order[1]] + weights[order[2]] + weights[order[3]];
    int left = 255;
    for (int k = 3; k >= 0; --k) {
        const int share = k == 0 ? left : static_cast<int>(255 * weights[order[k]] / sum);
        v.joints[k] = static_cast<uint8_t>(order[k]);
        v.weights[k] = static_cast<uint8_t>(share);
        left -= share;
    }
}

uint32_t mixed(uint32_t a, uint32_t b, float t) {
    uint32_t out = 0xff000000u;
    for (int shift : {0, 8, 16}) {
        const auto from = static_cast<float>(a >> shift & 0xffu), to = static_cast<float>(b >> shift & 0xffu);
        out |= static_cast<uint32_t>(clamp(lerp(from, to, t), 0, 255)) << shift;
    }
    return out;
}

// Rounded noise of some 0.2 withers, -1..1.
float patches(Vec3 p, float seed) {
    auto wave = [](float v) { return sin_cos(v - 2 * k_pi * std::floor(v / (2 * k_pi))).sine; };
    return 0.5f * wave(9 * p.z + 4 * p.y + seed) + 0.3f * wave(14 * p.y - 7 * p.z + 5 * p.x + 2 * seed) +
           0.2f * wave(21 * p.x + 11 * p.z + 3 * seed);
}

uint32_t coat_at(Breed breed, uint32_t coat, Vec3 p, Vec3 n) {
    const Look& look = k_looks[static_cast<size_t>(breed)];
    const DogShape& s = shape_of(breed);
    const float l = s.joints[dog_neck].z;
    // Pale below, at the chest, on paws, at the tip of the tail and about the mouth.
    const float below = smoothstep(.1f, .7f, -n.y) * smoothstep(.30f, .45f, p.y);
    const float paws = 1 - smoothstep(.07f, .16f, p.y);
    const float breast =
        smoothstep(l - .10f, l + .02f, p.z) * (1 - smoothstep(.72f, .88f, p.y)) * smoothstep(.35f, .5f, p.y);
    const float mouth = smoothstep(.15f, .22f, p.z - s.joints[dog_head].z) *
                        smoothstep(.0f, .08f, s.joints[dog_head].y + .05f - p.y);
    const float tip =
        smoothstep(.12f, .02f, length(p - (s.joints[dog_tail_end] * 1.5f - s.joints[dog_tail_middle] * .5f)));
    const float pale = clamp(std::max({below, paws, breast, mouth, tip}), 0, 1);
    // Dark on the back, the ears and in patches.
    const float back = smoothstep(.3f, .9f, n.y) * smoothstep(.78f, .90f, p.y) * (p.z < l ? 1.0f : 0.4f);
    const float spots =
        smoothstep(.18f, .34f, patches(p, 1.7f * static_cast<float>(coat) + static_cast<float>(breed)));
    const float ears =
        smoothstep(.07f, .10f, p.y - s.joints[dog_head].y) * smoothstep(.05f, .08f, std::fabs(p.x));
    const float dark = breed == Breed::shepherd  ? clamp(back + ears, 0, 1)
                       : breed == Breed::terrier ? std::max(spots, ears)
                                                 : .6f * ears;
    uint32_t colour = mixed(look.coat[coat], look.patch[coat], dark);
    colour = mixed(colour, look.pale[coat], pale);
    const float strand = 1 + .05f * patches(p * 9.0f, 4);
    return shaded(colour, strand * (.80f + .20f * n.y));
}

// Pieces beside the field: nose, eyes and the collar.
void add_solid(ThingMesh& mesh, std::vector<uint32_t>& level, const SolidMesh& solid, uint32_t colour,
               uint8_t joint) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (size_t i = 0; i < solid.positions.size(); ++i) {
        ThingVertex v{.position = solid.positions[i], .normal = solid.normals[i], .colour = colour};
        v.joints[0] = joint;
        mesh.vertices.push_back(v);
    }
    for (uint32_t i : solid.indices) level.push_back(first + i);
}

void add_face(ThingMesh& mesh, std::vector<uint32_t>& level, Breed breed, int around) {
    const DogShape& s = shape_of(breed);
    const Look& look = k_looks[static_cast<size_t>(breed)];
    const Vec3 skull = s.joints[dog_head] + Vec3{0, .035f, .035f};
    const Frame nose = make_frame(skull + Vec3{0, -.020f, look.muzzle + .030f}, {0, 1, 0}, {0, 0, 1});
    add_solid(mesh, level, make_pillow(nose, {.021f, .016f, .014f}, .9f, around, around / 2), rgb(0x151314),
              dog_head);
    for (const float side : {1.0f, -1.0f}) {
        const Frame eye = make_frame(skull + Vec3{side * .050f, .030f, .092f}, {0, 1, 0}, {side * .5f, 0, 1});
        add_solid(mesh, level, make_pillow(eye, {.013f, .013f, .009f}, 1, around, around / 2), rgb(0x1a120d),
                  dog_head);
    }
    std::vector<Vec3> ring;
    const Vec3 at = lerp(s.joints[dog_neck], s.joints[dog_head], .42f) + Vec3{0, -.025f, -.02f};
    const Vec3 along = normalize_or(s.joints[dog_head] - s.joints[dog_neck], {0, 1, 0}),
               ahead = cross(Vec3{1, 0, 0}, along);
    for (int k = 0; k < 2 * around; ++k) {
        const SinCos a = sin_cos(k_pi * static_cast<float>(k) / static_cast<float>(around));
        ring.push_back(at + Vec3{1, 0, 0} * (.108f * look.stout * a.sine) + ahead * (.118f * a.cosine));
    }
    add_solid(mesh, level, make_ring(ring, along, .020f, .009f, 4), rgb(0x8c2f2a), dog_neck);
}

}  // namespace

std::vector<ThingMesh> make_dog_meshes(Breed breed) {
    const Field field = dog_field(breed);
    const FieldMesh whole = polygonise(field, dog_grid(breed));
    const std::vector<Bone> bones = bones_of(breed);
    ThingMesh mesh;
    constexpr size_t k_triangles[] = {3200, 1300, 500, 180};
    std::vector<uint16_t> near;
    for (const size_t triangles : k_triangles) {
        FieldMesh cut = whole;
        simplify_mesh(cut, triangles, [](Vec3 p) { return p; });
        const auto first = static_cast<uint32_t>(mesh.vertices.size());
        for (const Vec3 p : cut.positions) {
            ThingVertex v;
            v.position = p;
            parts_near(field, p, .06f, near);  // as far as parts grow into each other
            v.normal = normalize_or(gradient(field, near, p), {0, 1, 0});
            bind(bones, v);
            mesh.vertices.push_back(v);
        }
        std::vector<uint32_t>& level = mesh.lods.emplace_back();
        for (const uint32_t i : cut.indices) level.push_back(first + i);
    }
    std::vector<ThingMesh> coats(k_coats, mesh);
    for (uint32_t c = 0; c < k_coats; ++c) {
        for (ThingVertex& v : coats[c].vertices) v.colour = coat_at(breed, c, v.position, v.normal);
        add_face(coats[c], coats[c].lods[0], breed, 10);
        add_face(coats[c], coats[c].lods[1], breed, 6);
    }
    return coats;
}

}  // namespace flaneur
