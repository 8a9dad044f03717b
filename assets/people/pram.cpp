#include "assets/people/pram.h"

#include <algorithm>
#include <cmath>

#include "assets/colour.h"
#include "assets/people/shape.h"
#include "assets/people/shapes/solid.h"
#include "sim/base/rng.h"
#include "sim/body/pram.h"

namespace flaneur {

namespace {

constexpr float k_turn = 6.2831853f;
constexpr float k_side = 0.215f;   // metres, of the frame from the middle
constexpr float k_tube = 0.0115f;  // radius

struct Colours {
    uint32_t cloth, lining, frame, tyre = rgb(0x2a2a2b), rim = rgb(0x8d9092), blanket;
};

Colours choose_colours(uint64_t seed) {
    constexpr uint32_t cloths[] = {rgb(0x2c3a52), rgb(0x4a4d50), rgb(0x5d2f38), rgb(0x5c6148),
                                   rgb(0x2a2a2d), rgb(0x2f6266), rgb(0x9a8a6c), rgb(0x8a3d33)};
    constexpr uint32_t linings[] = {rgb(0x8d8f90), rgb(0xc7bca6), rgb(0x3a3c40)};
    constexpr uint32_t frames[] = {rgb(0x303236), rgb(0x9a9c9e), rgb(0x303236)};
    constexpr uint32_t blankets[] = {rgb(0xe3d9c4), rgb(0xa9c0cc), rgb(0xd9b8ae), rgb(0xb9c4a4)};
    const RandomKey key{seed, 0, 0, Purpose::accessory};
    auto pick = [&](const auto& from, uint32_t draw) {
        return from[random_bits(key, 900 + draw) % std::size(from)];
    };
    return {.cloth = pick(cloths, 0),
            .lining = pick(linings, 1),
            .frame = pick(frames, 2),
            .blanket = pick(blankets, 3)};
}

// How finely a level is drawn.
struct Detail {
    int around;       // of a wheel
    int sides;        // of a tube
    int rings;        // of what is padded
    bool has_spokes;  // and tyres that are round
    bool has_bars;    // axles, rear legs, a basket
};
constexpr std::array<Detail, k_person_levels> k_details = {{{20, 6, 7, true, true},
                                                            {14, 4, 5, true, true},
                                                            {10, 3, 4, false, true},
                                                            {8, 3, 3, false, true},
                                                            {6, 3, 2, false, false}}};

// Puts pieces on the pram, which stands level with the ground between its rear wheels at the origin.
struct Maker {
    Character& person;
    float ahead;  // of the origin in the bind pose
    std::vector<uint32_t>* level = nullptr;

    void add(const SolidMesh& solid, uint32_t colour, int follower = carried_bag, Tint tint = Tint::none) {
        const auto first = static_cast<uint32_t>(person.vertices.size());
        for (size_t i = 0; i < solid.positions.size(); ++i) {
            CharacterVertex v;
            v.position = solid.positions[i] + Vec3{0, 0, ahead};
            v.normal = solid.normals[i];
            v.tint = tint;
            // The sky lights what faces up, the ground and the cloth around take it from what does not.
            v.colour = scaled_colour(colour, 0.80f + 0.20f * v.normal.y);
            v.joints[0] = hips;
            v.hung_joints[0] = static_cast<uint8_t>(follower);
            v.hung_weights[0] = 255;
            person.vertices.push_back(v);
        }
        for (uint32_t i : solid.indices) level->push_back(first + i);
    }
    void tube(std::vector<Vec3> path, uint32_t colour, int sides, float radius = k_tube) {
        add(make_band(path, {1, 0.1f, 0}, radius, radius, sides), colour);
    }
};

void add_wheel(Maker& m, const Detail& d, const Colours& c, Vec3 middle, float radius, int follower) {
    const float out = middle.x > 0 ? 1.0f : -1.0f;
    const Frame frame = make_frame(middle, {out, 0, 0}, {0, 0, 1});
    const float thick = 0.135f * radius;
    if (!d.has_spokes) {
        const Turn tyre[] = {{radius * 0.8f, -thick}, {radius, 0}, {radius * 0.8f, thick}};
        m.add(make_turned(frame, tyre, 1, d.around), c.tyre, follower);
        // As dark as spokes and what is seen between them are on average.
        const Turn rim[] = {{radius * 0.7f, -1.1f * thick}, {radius * 0.7f, 1.1f * thick}};
        if (d.has_bars) m.add(make_turned(frame, rim, 1, 8), rgb(0x646567), follower);
        return;
    }
    std::vector<Vec3> path;
    for (int i = 0; i < d.around; ++i) {
        const float a = k_turn * static_cast<float>(i) / static_cast<float>(d.around);
        path.push_back(frame.at({(radius - thick) * std::sin(a), 0, (radius - thick) * std::cos(a)}));
    }
    m.add(make_ring(path, {1, 0, 0}, thick, thick, d.sides), c.tyre, follower);
    const Turn hub[] = {{radius * 0.22f, -thick}, {radius * 0.22f, thick}};
    m.add(make_turned(frame, hub, 1, 8), c.frame, follower);
    for (int i = 0; i < 5; ++i) {
        const float a = k_turn * static_cast<float>(i) / 5;
        const Vec3 way{std::sin(a), 0, std::cos(a)};
        const Vec3 spoke[] = {frame.at(way * (0.18f * radius)), frame.at(way * (radius - 1.4f * thick))};
        m.add(make_band(spoke, {1, 0, 0}, 0.4f * thick, 0.07f * radius, 4), c.rim, follower);
    }
}

void add_frame(Maker& m, const Detail& d, const Colours& c, float handle) {
    const Vec3 front{k_side, k_pram_front + 0.02f, k_pram_base}, fold{k_side, 0.56f, 0.13f};
    const Vec3 grip{k_side, handle, -k_pram_behind}, rear{k_side, k_pram_rear, 0};
    const Vec3 below = lerp(fold, grip, 0.88f);
    auto mirrored = [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; };
    const Vec3 end = grip - Vec3{0.03f, 0, 0};
    if (d.has_bars) {
        m.tube({front, fold, below, lerp(below, grip, 0.75f) + Vec3{0, 0.01f, -0.01f}, end, mirrored(end),
                mirrored(lerp(below, grip, 0.75f)) + Vec3{0, 0.01f, -0.01f}, mirrored(below), mirrored(fold),
                mirrored(front)},
               c.frame, d.sides);
        m.tube({end, mirrored(end)}, c.tyre, d.sides, 1.4f * k_tube);
        for (float side : {1.0f, -1.0f}) {
            const Vec3 leg[] = {{side * k_side, 0.50f, 0.175f}, {side * rear.x, rear.y, rear.z}};
            m.tube({leg[0], leg[1]}, c.frame, d.sides);
        }
        for (Vec3 axle : {Vec3{0.5f * k_pram_track, k_pram_rear, 0},
                          Vec3{0.5f * k_pram_track, k_pram_front, k_pram_base}})
            m.tube({axle, mirrored(axle)}, c.frame, d.sides, 0.009f);
    } else {
        m.tube({front, grip, mirrored(grip), mirrored(front)}, c.frame, d.sides, 1.2f * k_tube);
    }
}

// Cloth over bows that turn about the sides of the seat: from behind the head to over it.
SolidMesh make_hood(int bows, int arc) {
    constexpr float k_from = 2.95f, k_to = 1.05f;  // radians from ahead over the top
    constexpr float k_reach = 0.33f, k_half = 0.195f, k_thick = 0.012f;
    const Vec3 pivot{0, 0.585f, 0.15f};
    SolidMesh s;
    auto grid = [&](float in, bool inward) {
        const auto first = static_cast<uint32_t>(s.positions.size());
        for (int b = 0; b <= bows; ++b) {
            const float t = k_from + (k_to - k_from) * static_cast<float>(b) / static_cast<float>(bows);
            const Vec3 way{0, std::sin(t), std::cos(t)};
            for (int a = 0; a <= arc; ++a) {
                const float u = (static_cast<float>(a) / static_cast<float>(arc) - 0.5f) * 0.5f * k_turn;
                const float up = std::sqrt(std::max(std::cos(u), 0.0f));
                const float across = std::sin(u) < 0 ? -std::sqrt(-std::sin(u)) : std::sqrt(std::sin(u));
                s.positions.push_back(pivot + way * ((k_reach - in) * up) +
                                      Vec3{across * (k_half - in), 0, 0});
                const Vec3 n = normalize_or(way * up + Vec3{std::sin(u), 0, 0}, way);
                s.normals.push_back(inward ? -n : n);
            }
        }
        for (int b = 0; b < bows; ++b)
            for (int a = 0; a < arc; ++a) {
                const uint32_t row = static_cast<uint32_t>(arc + 1);
                const uint32_t p = first + static_cast<uint32_t>(b) * row + static_cast<uint32_t>(a);
                const uint32_t quad[] = {p, p + 1, p + row + 1, p, p + row + 1, p + row};
                for (int i = 0; i < 6; i += 3) {
                    s.indices.push_back(quad[i]);
                    s.indices.push_back(quad[inward ? i + 2 : i + 1]);
                    s.indices.push_back(quad[inward ? i + 1 : i + 2]);
                }
            }
    };
    grid(0, false);
    grid(k_thick, true);
    return s;
}

void add_seat(Maker& m, const Detail& d, const Colours& c) {
    const int around = 2 * d.rings + 2;
    // A tub: the back leans, the seat is level, the lower legs hang before it.
    const Frame back = make_frame({0, 0.565f, 0.075f}, {0, 1, -0.42f}, {0, 0.42f, 1});
    m.add(make_pillow(back, {0.185f, 0.225f, 0.028f}, 0.45f, around, d.rings), c.cloth);
    const Frame seat = make_frame({0, 0.365f, 0.28f}, {0, 1, -0.12f}, {0, 0.12f, 1});
    m.add(make_pillow(seat, {0.185f, 0.030f, 0.165f}, 0.45f, around, d.rings), c.cloth);
    const Frame rest = make_frame({0, 0.275f, 0.465f}, {0, 1, -0.55f}, {0, 0.55f, 1});
    m.add(make_pillow(rest, {0.15f, 0.125f, 0.020f}, 0.45f, around, d.rings), c.cloth);
    if (d.has_bars) {
        for (float side : {1.0f, -1.0f}) {
            const Frame wall = make_frame({side * 0.180f, 0.435f, 0.22f}, {0, 1, -0.2f}, {0, 0.2f, 1});
            m.add(make_pillow(wall, {0.014f, 0.085f, 0.17f}, 0.5f, around, d.rings), c.cloth);
        }
        const Frame basket = make_frame({0, 0.215f, 0.27f}, {0, 1, 0}, {0, 0, 1});
        m.add(make_pillow(basket, {0.175f, 0.065f, 0.19f}, 0.4f, around, d.rings), c.tyre);
    }
    m.add(make_hood(d.has_spokes ? 8 : d.has_bars ? 4 : 2, d.has_spokes ? 10 : d.has_bars ? 6 : 4), c.cloth);
}

void add_child(Maker& m, const Detail& d, const Colours& c) {
    const int around = 2 * d.rings + 2;
    const Frame blanket = make_frame({0, 0.425f, 0.33f}, {0, 1, 0.18f}, {0, -0.18f, 1});
    m.add(make_pillow(blanket, {0.150f, 0.060f, 0.175f}, 0.7f, around, d.rings), c.blanket);
    if (!d.has_bars) return;
    const Frame body = make_frame({0, 0.530f, 0.165f}, {0, 1, -0.40f}, {0, 0.40f, 1});
    m.add(make_pillow(body, {0.115f, 0.130f, 0.075f}, 0.8f, around, d.rings), c.lining);
    const Frame head = make_frame({0, 0.700f, 0.130f}, {0, 1, -0.25f}, {0, 0.25f, 1});
    m.add(make_pillow(head, {0.068f, 0.080f, 0.074f}, 1, around, d.rings), rgb(0xffffff), carried_bag,
          Tint::skin);
    const Frame hat = make_frame({0, 0.738f, 0.100f}, {0, 1, -0.55f}, {0, 0.55f, 1});
    m.add(make_pillow(hat, {0.080f, 0.062f, 0.084f}, 0.95f, around, d.rings), c.blanket);
}

}  // namespace

PramLevels add_pram(uint64_t seed, Character& person) {
    person.body.pram = standard_pram(person.body);
    const float ahead = person.body.pram.z + k_pram_behind;
    person.followers[carried_bag - k_joint_count] = {{0, 0, ahead}, hips};
    person.followers[scarf_end - k_joint_count] = {{0, k_pram_rear, ahead}, hips};
    const Colours colours = choose_colours(seed);
    PramLevels levels;
    for (size_t l = 0; l < levels.size(); ++l) {
        const Detail& detail = k_details[l];
        Maker maker{person, ahead, &levels[l]};
        for (float side : {0.5f, -0.5f}) {
            add_wheel(maker, detail, colours, {side * k_pram_track, k_pram_rear, 0}, k_pram_rear, scarf_end);
            add_wheel(maker, detail, colours, {side * k_pram_track, k_pram_front, k_pram_base}, k_pram_front,
                      carried_bag);
        }
        add_frame(maker, detail, colours, person.body.pram.y);
        add_seat(maker, detail, colours);
        add_child(maker, detail, colours);
    }
    person.lods[0].insert(person.lods[0].end(), levels[0].begin(), levels[0].end());
    return levels;
}

}  // namespace flaneur
