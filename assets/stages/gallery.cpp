#include "assets/stages/gallery.h"

#include "assets/colour.h"
#include "assets/stages/dais.h"
#include "assets/stages/meadow.h"
#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_half = 15, k_back = -6, k_front = 9;  // metres: of the terrace, along x and z
constexpr float k_dais_back = -17.4f;                   // the same, of what people do not walk on
constexpr float k_above_meadow = 0.3f;
constexpr float k_wall = 2.75f, k_thick = 0.4f;            // metres, of the wall behind
constexpr float k_plinth = 0.825f, k_plinth_half = 0.45f;  // metres
constexpr float k_apart = 3.3f;                            // metres between plinths
constexpr float k_rows[] = {-3, 1.6f};                     // along z
constexpr int k_in_rows[] = {6, 5};
constexpr uint32_t k_paving = rgb(0xbdb7ab), k_limestone = rgb(0xd8d0c0), k_plaster = rgb(0xe4dfd5);

// Periods of some seconds, no two axes alike, so that a target goes on and on where it has not been.
Sway swaying(Vec3 middle, Vec3 reach, RandomKey key, uint32_t draw) {
    Sway sway{.middle = middle, .reach = reach};
    for (uint32_t axis = 0; axis < 3; ++axis) {
        sway.period[axis] = 240 + static_cast<uint32_t>(random_unit(key, draw + 2 * axis) * 300);
        sway.start[axis] = static_cast<uint32_t>(random_unit(key, draw + 2 * axis + 1) * 600);
    }
    return sway;
}

// Stands a linkage on `place`: its targets, which are at so much of the way out to where its ends rest, sway
// by so much.
void stand(Linkage& f, Vec3 place, float out, Vec3 reach, RandomKey key) {
    f.root = {.middle = place};
    for (size_t e = 0; e < f.leads.size(); ++e)
        f.leads[e] = swaying(place + f.leads[e].middle * out, reach, key, static_cast<uint32_t>(10 * e));
}

// What the chains are to reach, the same for all of them: well within what ten joints can.
void lead_chain(Linkage& f, Vec3 place, float reach, RandomKey key) {
    f.root = {.middle = place};
    f.leads[0] = swaying(place + Vec3{0, 0.52f, 0.16f} * reach, Vec3{0.36f, 0.26f, 0.28f} * reach, key, 0);
}

Linkage standing_body(Vec3 place, RandomKey key) {
    constexpr float k_height = 1.8f, k_pelvis = 0.53f * k_height;
    Linkage f = body_linkage(k_height);
    stand(f, place + Vec3{0, k_pelvis, 0}, 1, {0.1f, 0.18f, 0.1f}, key);
    f.root = swaying(f.root.middle - Vec3{0, 0.14f, 0}, {0.08f, 0.07f, 0.05f}, key, 900);
    f.leads[0].middle = f.leads[0].middle - Vec3{0, 0.27f, -0.05f};
    f.leads[0].reach = {0.08f, 0.03f, 0.06f};
    for (const size_t hand : {1u, 3u}) f.leads[hand].middle = f.leads[hand].middle + Vec3{0, 0.24f, 0.2f};
    for (const size_t foot : {2u, 4u}) f.leads[foot].reach = {};
    return f;
}

// The middles of their tops.
std::vector<Vec3> plinths() {
    std::vector<Vec3> places;
    for (size_t row = 0; row < std::size(k_rows); ++row)
        for (int n = 0; n < k_in_rows[row]; ++n)
            places.push_back(
                {k_apart * (static_cast<float>(n) - 0.5f * static_cast<float>(k_in_rows[row] - 1)), k_plinth,
                 k_rows[row]});
    return places;
}

}  // namespace

City build_gallery(uint64_t seed) {
    const RandomKey key{seed, 0, 0, Purpose::city};
    City hall;
    hall.ground.name = "gallery";
    hall.ground.vertices = {
        {-k_half, 0, k_back}, {-k_half, 0, k_front}, {k_half, 0, k_front}, {k_half, 0, k_back}};
    hall.ground.indices = {0, 1, 2, 0, 2, 3};
    hall.ground.kinds.assign(2, Surface::plaza);
    hall.ground_axes.assign(2, {1, 0});
    Scenery& s = hall.scenery;
    add_courses(s, box_outline({-k_half, k_back}, {k_half, k_front}), -2 * k_above_meadow, 0, k_paving,
                SceneryUse::backdrop);
    build_dais(s, {-k_half, k_dais_back}, {k_half, k_back});
    add_block(s, {-k_half, k_dais_back - k_thick}, {k_half, k_dais_back}, -2 * k_above_meadow, k_wall,
              k_plaster, SceneryUse::solid);
    for (const Vec3 place : plinths()) {
        const Vec2 half{k_plinth_half, k_plinth_half}, middle = on_ground(place);
        add_block(s, middle - half, middle + half, 0, k_plinth, k_limestone, SceneryUse::solid);
    }
    const Meadow meadow{
        .level = 1.45f * k_half, .from = 6, .below = k_above_meadow, .turn = 2 * k_pi * random_unit(key)};
    add_land(s, meadow);
    index_city(hall);
    add_trees(hall, meadow, 1.4f * k_half, key);
    list_obstacles(hall);
    return hall;
}

std::vector<Linkage> make_exhibits(uint64_t seed) {
    const std::vector<Vec3> places = plinths();
    constexpr int k_joints = 10;
    constexpr float k_bone = 0.2f;
    // Else what a method leaves of each tick adds up, and chains curl up in minutes.
    constexpr float k_recoil = 0.03f;
    auto key = [&](uint32_t n) { return RandomKey{seed, n, 0, Purpose::city}; };
    std::vector<Linkage> linkages;
    auto place = [&] { return places[linkages.size()]; };
    for (const Solver solver : {Solver::fabrik, Solver::ccd, Solver::transpose, Solver::damped}) {
        Linkage f = chain_linkage(k_joints, k_bone, solver);
        f.method.patience.iterations = 200;
        f.recoil = k_recoil;
        lead_chain(f, place(), k_bone * (k_joints - 1), key(0));
        linkages.push_back(std::move(f));
    }
    Linkage limb = chain_linkage(3, 0.8f, Solver::two_bone);
    lead_chain(limb, place() + Vec3{0, 0.4f, 0}, 1.15f, key(0));
    limb.root.middle = place();
    linkages.push_back(std::move(limb));

    Linkage cones = cone_linkage(k_joints, k_bone, 25 * k_radians);
    cones.root.middle = place();
    cones.leads[0] = swaying(place() + Vec3{0, 1.35f, 0.25f}, {0.4f, 0.12f, 0.35f}, key(0), 0);
    linkages.push_back(std::move(cones));

    constexpr float k_finger = 1.6f;
    Linkage finger = finger_linkage(k_finger);
    finger.root = {.middle = place()};
    finger.leads[0] =
        swaying(place() + Vec3{0, 0.56f, 0.6f} * k_finger, Vec3{0, 0.12f, 0.12f} * k_finger, key(1), 0);
    linkages.push_back(std::move(finger));

    constexpr float k_hand = 1.7f;
    Linkage hand = hand_linkage(k_hand);
    stand(hand, place(), 1, {0.05f, 0.12f, 0.16f}, key(2));
    for (Sway& lead : hand.leads) lead.middle = lead.middle + Vec3{0, -0.24f, 0.2f};
    hand.leads[0].middle = lerp(hand.leads[0].middle, place(), 0.1f);
    linkages.push_back(std::move(hand));

    linkages.push_back(standing_body(place(), key(3)));

    Linkage octopus = octopus_linkage(6, 1.1f);
    stand(octopus, place() + Vec3{0, 0.5f, 0}, 0.72f, {0.18f, 0.14f, 0.18f}, key(4));
    octopus.root = swaying(octopus.root.middle, {0.1f, 0.12f, 0.1f}, key(4), 900);
    linkages.push_back(std::move(octopus));

    Linkage tree = random_tree_linkage(40, 0.24f, seed);
    stand(tree, place(), 0.99f, {0.04f, 0.04f, 0.04f}, key(5));
    linkages.push_back(std::move(tree));
    return linkages;
}

}  // namespace flaneur
