#include "assets/stages/dais.h"

#include <algorithm>
#include <string>

#include "assets/colour.h"
#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_top = 0.45f;  // metres over the terrace
constexpr uint32_t k_paving = rgb(0xc9c2b4), k_stone = rgb(0xa9a294), k_plinth = rgb(0xd8d0c0),
                   k_wood = rgb(0x8a6f52);

// Where the pairs are, the whole ones: low things in front.
enum Pair { stairs, slope, rubble, wall, rail, look };
constexpr Vec2 k_pairs[] = {{-11.3f, -9.4f}, {-2.3f, -9.4f}, {6.7f, -9.4f},
                            {-9.6f, -12.9f}, {4.4f, -12.9f}, {-1.2f, -12.4f}};
constexpr Vec2 k_twins[] = {{4.6f, 0}, {4.6f, 0}, {4.6f, 0}, {5.2f, 0}, {5.2f, 0}, {2.2f, 0}};  // their twins
constexpr float k_straight = 1.5f, k_bend = 0.7f;  // of their ways: half of a straight, and what joins two

constexpr float k_round_x = 8.9f, k_round = 4.2f, k_round_z = -11.2f;  // of the way round all
constexpr float k_keys_z = -16.3f, k_keys_apart = 2.15f, k_key_plinth = 0.3f;

// A block whose top goes evenly from `from` at its low x to `to` at its high one, over the dais.
struct Piece {
    Vec2 low, high;
    float from, to;
    uint32_t colour;
    Surface kind = Surface::plaza;
};
// A wall of `height`, from a to b: its free side is where one who goes that way has its right.
struct Wall {
    Vec2 a, b;
    float height;
};

void add_stairs(Vec2 at, std::vector<Piece>& pieces) {
    constexpr float k_tread = 0.3f, k_rise = 0.165f, k_landing = 0.3f, k_half = 1.15f;
    for (int step = 0; step < 3; ++step) {
        const float x = k_landing + k_tread * static_cast<float>(3 - step),
                    inner = k_landing + (step == 2 ? -k_landing : k_tread * static_cast<float>(2 - step)),
                    height = k_rise * static_cast<float>(step + 1);
        pieces.push_back({{at.x - x, at.z - k_half},
                          {at.x - inner, at.z + k_half},
                          height,
                          height,
                          k_stone,
                          Surface::steps});
        pieces.push_back({{at.x + inner, at.z - k_half},
                          {at.x + x, at.z + k_half},
                          height,
                          height,
                          k_stone,
                          Surface::steps});
    }
}

void add_slope(Vec2 at, std::vector<Piece>& pieces) {
    constexpr float k_long = 1.25f, k_landing = 0.25f, k_high = 0.3f, k_half = 1.15f;
    pieces.push_back(
        {{at.x - k_landing - k_long, at.z - k_half}, {at.x - k_landing, at.z + k_half}, 0, k_high, k_wood});
    pieces.push_back(
        {{at.x - k_landing, at.z - k_half}, {at.x + k_landing, at.z + k_half}, k_high, k_high, k_wood});
    pieces.push_back(
        {{at.x + k_landing, at.z - k_half}, {at.x + k_landing + k_long, at.z + k_half}, k_high, 0, k_wood});
}

// The same in each of a pair.
void add_rubble(Vec2 at, std::vector<Piece>& pieces) {
    constexpr float k_cell = 0.34f, k_least = 0.02f, k_most = 0.14f;
    constexpr int k_along = 9, k_across = 6;
    for (int i = 0; i < k_along; ++i)
        for (int k = 0; k < k_across; ++k) {
            const RandomKey key{7, static_cast<uint32_t>(i), static_cast<uint32_t>(k), Purpose::city};
            const Vec2 low{at.x + k_cell * (static_cast<float>(i) - 0.5f * k_along),
                           at.z + k_cell * (static_cast<float>(k) - 0.5f * k_across)};
            const float from = random_between(key, k_least, k_most, 0),
                        to = clamp(from + random_between(key, -0.05f, 0.05f, 1), k_least, k_most);
            pieces.push_back({low, low + Vec2{k_cell, k_cell}, from, to,
                              shaded(k_stone, random_between(key, 0.86f, 1.1f, 2))});
        }
}

// Along it the rear straight comes nearer and nearer.
void add_wall(Vec2 at, std::vector<Wall>& walls) {
    constexpr float k_far = 0.75f, k_near = 0.32f, k_height = 1.32f;
    const float z = at.z - k_bend;
    walls.push_back(
        {{at.x - k_straight - 0.3f, z - k_far}, {at.x + k_straight + 0.3f, z - k_near}, k_height});
}
// Round the corner from the rear straight to the bend beside it.
void add_rail(Vec2 at, std::vector<Wall>& walls) {
    constexpr float k_beside = 0.4f, k_height = 1.12f;
    const float z = at.z - k_bend - k_beside, x = at.x + k_straight + k_bend + k_beside;
    walls.push_back({{at.x - k_straight, z}, {x, z}, k_height});
    walls.push_back({{x, z}, {x, at.z + k_bend}, k_height});
}

struct Furniture {
    std::vector<Piece> pieces;
    std::vector<Wall> walls;
};
Furniture furniture() {
    Furniture all;
    for (const float twin : {0.0f, 1.0f}) {
        auto at = [twin](Pair pair) { return k_pairs[pair] + k_twins[pair] * twin; };
        add_stairs(at(stairs), all.pieces);
        add_slope(at(slope), all.pieces);
        add_rubble(at(rubble), all.pieces);
        add_wall(at(wall), all.walls);
        add_rail(at(rail), all.walls);
    }
    for (int n = 0; n < k_key_pose_count; ++n) {
        const Vec2 at{k_keys_apart * (static_cast<float>(n) - 0.5f * (k_key_pose_count - 1)), k_keys_z};
        const Vec2 half{0.45f, 0.4f};
        all.pieces.push_back({at - half, at + half, k_key_plinth, k_key_plinth, k_plinth});
    }
    return all;
}

// Two straights along x with half circles between, the rear one first; `turned`: the other way round.
std::vector<Vec2> stadium(Vec2 middle, float half, float radius, bool turned) {
    constexpr int k_pieces = 16;
    std::vector<Vec2> way;
    for (const float end : {1.0f, -1.0f})
        for (int i = 0; i <= k_pieces; ++i) {
            const SinCos at = sin_cos(k_pi * static_cast<float>(i) / k_pieces);
            way.push_back(middle + Vec2{end * (half + radius * at.sine), -end * radius * at.cosine});
        }
    if (turned) std::ranges::reverse(way);
    return way;
}

// Whom figures are like.
uint32_t kind_of(std::span<const Kind> kinds, bool woman, uint32_t skipped) {
    uint32_t last = 0;
    for (uint32_t i = 0; i < kinds.size(); ++i) {
        const Kind& kind = kinds[i];
        const bool is_plain = kind.body.cane == Vec3{} && kind.body.pram == Vec3{} && kind.age >= 18 &&
                              kind.age < 60 && kind.body.wear.bag == Bag::none;
        if (!is_plain || kind.woman != woman) continue;
        last = i;
        if (skipped-- == 0) break;
    }
    return last;
}

}  // namespace

void build_dais(Scenery& s, Vec2 low, Vec2 high) {
    constexpr float k_thick = 0.16f;
    add_block(s, low, high, 0, k_top, k_paving, SceneryUse::solid);
    const Furniture all = furniture();
    for (const Piece& piece : all.pieces) {
        const std::vector<Vec2> o = box_outline(piece.low, piece.high);
        auto corner = [&](size_t i, float height) { return at_height(o[i], k_top + height); };
        const float tops[] = {piece.from, piece.to, piece.to, piece.from};
        for (size_t i = 0; i < 4; ++i) {
            const size_t next = (i + 1) % 4;
            const Vec3 side[4] = {corner(i, tops[i]), corner(next, tops[next]), corner(next, 0),
                                  corner(i, 0)};
            add_quad(s, side, shaded(piece.colour, 0.9f), SceneryUse::backdrop);
        }
        const Vec3 lid[4] = {corner(3, tops[3]), corner(2, tops[2]), corner(1, tops[1]), corner(0, tops[0])};
        add_quad(s, lid, piece.colour, SceneryUse::backdrop);
    }
    for (const Wall& w : all.walls) {
        const Vec2 along = normalize_or(w.b - w.a, {1, 0}), out = Vec2{along.z, -along.x} * k_thick;
        const std::vector<Vec2> outline = {w.b, w.a, w.a + out, w.b + out};
        add_courses(s, outline, k_top, k_top + w.height, k_plinth, SceneryUse::backdrop);
        add_lid(s, outline, k_top + w.height, shaded(k_plinth, 1.04f), SceneryUse::backdrop);
    }
}

std::shared_ptr<const Ground> make_figure_ground() {
    constexpr float k_far = 20;
    auto ground = std::make_shared<Ground>();
    ground->name = "dais";
    auto add = [&](Vec2 low, Vec2 high, float from, float to, Surface kind) {
        const auto first = static_cast<uint32_t>(ground->vertices.size());
        ground->vertices.push_back({low.x, k_top + from, low.z});
        ground->vertices.push_back({low.x, k_top + from, high.z});
        ground->vertices.push_back({high.x, k_top + to, high.z});
        ground->vertices.push_back({high.x, k_top + to, low.z});
        for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) ground->indices.push_back(first + k);
        ground->kinds.insert(ground->kinds.end(), 2, kind);
    };
    add({-k_far, k_round_z - k_far}, {k_far, k_round_z + k_far}, 0, 0, Surface::plaza);
    const Furniture all = furniture();
    for (const Piece& p : all.pieces) add(p.low, p.high, p.from, p.to, p.kind);
    for (const Wall& w : all.walls) {
        const float top = k_top + w.height;
        ground->faces.push_back(
            {at_height(w.a, k_top), at_height(w.b, k_top), top, top, FaceKind::garden_wall});
    }
    index_ground(*ground);
    return ground;
}

std::vector<FigurePlan> make_figure_plans(std::span<const Kind> kinds) {
    using Made = FigurePlan::By;
    std::vector<FigurePlan> plans;
    auto add_pair = [&](Pair pair, const char* on, const char* off, const Techniques& without, bool turned,
                        float speed) {
        for (const bool is_twin : {false, true}) {
            FigurePlan plan;
            plan.name = is_twin ? off : on;
            if (speed > 0)
                plan.way = stadium(k_pairs[pair], k_straight, k_bend, turned);
            else
                plan.way = {k_pairs[pair]};
            plan.speed = speed;
            if (is_twin) {
                plan.on = without;
                plan.twin_of = static_cast<uint32_t>(plans.size()) - 1;
                plan.aside = at_height(k_twins[pair], 0);
            }
            plan.kind = kind_of(kinds, pair % 2 == 1, static_cast<uint32_t>(pair));
            plans.push_back(std::move(plan));
        }
    };
    Techniques no_feet, no_walls, no_look;
    no_feet.feet = no_feet.soles = no_feet.heels = no_feet.pelvis = no_feet.limits = false;
    no_walls.walls = false;
    no_look.look = false;
    add_pair(stairs, "foot IK on steps", "without", no_feet, false, 0.9f);
    add_pair(slope, "foot IK on a slope", "without", no_feet, true, 1.0f);
    add_pair(rubble, "foot IK on rubble", "without", no_feet, false, 0.9f);
    add_pair(wall, "hand IK along a wall", "without", no_walls, true, 0.9f);
    add_pair(rail, "hand IK round a corner", "without", no_walls, false, 0.8f);
    add_pair(look, "heads that look about", "without", no_look, false, 0);
    for (const bool is_cubic : {true, false}) {
        FigurePlan plan;
        plan.name = is_cubic ? "thirteen poses, curves" : "thirteen poses, straight";
        plan.by = Made::keys;
        plan.way = stadium({0, k_round_z}, k_round_x, k_round, false);
        if (!is_cubic) plan.start = 2 * k_round_x + k_pi * k_round;
        plan.curves.along = is_cubic ? Curve::cubic : Curve::linear;
        plan.varies = true;
        plan.speed = 1.3f;
        plan.kind = kind_of(kinds, !is_cubic, 0);
        plans.push_back(std::move(plan));
    }
    for (int n = 0; n < k_key_pose_count; ++n) {
        FigurePlan plan;
        plan.name = k_key_pose_names[static_cast<size_t>(n)];
        plan.by = Made::statue;
        plan.way = {{k_keys_apart * (static_cast<float>(n) - 0.5f * (k_key_pose_count - 1)), k_keys_z}};
        plan.heading = 0.9f;
        plan.key = static_cast<KeyPose>(n);
        plan.kind = kind_of(kinds, false, 0);
        plans.push_back(std::move(plan));
    }
    return plans;
}

}  // namespace flaneur
