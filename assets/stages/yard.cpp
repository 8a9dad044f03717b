#include "assets/stages/yard.h"

#include <algorithm>

#include "assets/colour.h"
#include "assets/stages/meadow.h"
#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr uint32_t k_paving = rgb(0xb9b2a5), k_brick = rgb(0xa8654c), k_coping = rgb(0xcfc6b6),
                   k_stone = rgb(0xb9b0a0), k_oak = rgb(0x9a7650), k_frame = rgb(0x5d4630);
constexpr float k_rear_wall = 2.3f, k_brick_thick = 0.3f, k_door_wall = 2.55f;
constexpr float k_doors_low = -12, k_doors_high = -0.8f;       // of the wall with doors, along x
constexpr float k_openings[] = {-11.0f, -8.2f, -5.5f, -2.7f};  // where they begin
constexpr bool k_hinge_left[] = {false, true, false, true};
constexpr float k_opening = 0.98f, k_opening_high = 2.07f, k_gap = 0.012f;
constexpr float k_walls_at[] = {-3.4f, -0.2f, 3.0f}, k_wall_heights[] = {0.5f, 0.8f, 1.1f};
constexpr float k_walls_x = 2.4f, k_walls_half = 2.2f, k_walls_thick = 0.28f;

struct Table {
    Vec2 edge;      // the middle of the edge at which one stands
    float heading;  // of one who stands there, along x alone
    float height;
};
constexpr float k_quarter = 0.5f * k_pi, k_table_half = 0.42f, k_table_deep = 0.62f;
constexpr Table k_tables[] = {{{6.5f, -4}, -k_quarter, 0.75f},   {{11.2f, -4}, k_quarter, 1.0f},
                              {{6.5f, -0.2f}, -k_quarter, 0.9f}, {{11.2f, -0.2f}, k_quarter, 0.6f},
                              {{6.5f, 3.8f}, -k_quarter, 0.45f}, {{11.2f, 3.8f}, k_quarter, 0.6f}};
constexpr Vec2 k_on_ground[] = {{8.9f, -5.2f}, {8.9f, -1.5f}, {8.9f, 2.6f}};  // their edges; one faces -z
constexpr float k_inset = 0.04f;

void add_table(Scenery& s, const Table& table, Vec2 at) {
    constexpr float k_top = 0.035f, k_leg = 0.06f, k_in = 0.05f;
    const float far = table.edge.x + (table.heading > 0 ? k_table_deep : -k_table_deep);
    const Vec2 low = Vec2{std::min(table.edge.x, far), table.edge.z - k_table_half} + at,
               high = Vec2{std::max(table.edge.x, far), table.edge.z + k_table_half} + at;
    add_block(s, low, high, table.height - k_top, table.height, k_oak, SceneryUse::backdrop);
    const std::vector<Vec2> under = box_outline(low, high);
    const Vec3 bottom[4] = {
        at_height(under[0], table.height - k_top), at_height(under[1], table.height - k_top),
        at_height(under[2], table.height - k_top), at_height(under[3], table.height - k_top)};
    add_quad(s, bottom, shaded(k_oak, 0.7f), SceneryUse::backdrop);
    for (const float x : {low.x + k_in, high.x - k_in - k_leg})
        for (const float z : {low.z + k_in, high.z - k_in - k_leg})
            add_block(s, {x, z}, {x + k_leg, z + k_leg}, 0, table.height - k_top, shaded(k_oak, 0.85f),
                      SceneryUse::backdrop);
}

void add_capped(Scenery& s, Vec2 low, Vec2 high, float height, uint32_t colour, float cap) {
    constexpr float k_over = 0.025f;
    add_block(s, low, high, 0, height - cap, colour, SceneryUse::backdrop);
    const Vec2 over{k_over, k_over};
    add_block(s, low - over, high + over, height - cap, height, k_coping, SceneryUse::backdrop);
    const std::vector<Vec2> o = box_outline(low - over, high + over);
    const Vec3 under[4] = {at_height(o[0], height - cap), at_height(o[1], height - cap),
                           at_height(o[2], height - cap), at_height(o[3], height - cap)};
    add_quad(s, under, shaded(k_coping, 0.7f), SceneryUse::backdrop);
}

void add_door_wall(Scenery& s, Vec2 at) {
    constexpr float k_half = 0.5f * k_brick_thick, k_jamb = 0.05f;
    float from = k_doors_low;
    auto piece = [&](float low, float high, float bottom, float top, uint32_t colour, float half) {
        add_block(s, Vec2{low, -half} + at, Vec2{high, half} + at, bottom, top, colour, SceneryUse::backdrop);
    };
    for (const float opening : k_openings) {
        piece(from, opening - k_jamb, 0, k_door_wall, k_brick, k_half);
        piece(opening - k_jamb, opening, 0, k_opening_high, k_frame, k_half - 0.02f);
        from = opening + k_opening;
        piece(from, from + k_jamb, 0, k_opening_high, k_frame, k_half - 0.02f);
        piece(opening - k_jamb, from + k_jamb, k_opening_high + k_jamb, k_door_wall, k_brick, k_half);
        piece(opening - k_jamb, from + k_jamb, k_opening_high, k_opening_high + 2 * k_jamb, k_frame,
              k_half - 0.02f);
        const Vec3 lintel[4] = {{opening - k_jamb + at.x, k_opening_high, k_half - 0.02f + at.z},
                                {opening - k_jamb + at.x, k_opening_high, -k_half + 0.02f + at.z},
                                {from + k_jamb + at.x, k_opening_high, -k_half + 0.02f + at.z},
                                {from + k_jamb + at.x, k_opening_high, k_half - 0.02f + at.z}};
        add_quad(s, lintel, shaded(k_frame, 0.6f), SceneryUse::backdrop);
        from += k_jamb;
    }
    piece(from, k_doors_high, 0, k_door_wall, k_brick, k_half);
    piece(k_doors_low - 0.04f, k_doors_high + 0.04f, k_door_wall, k_door_wall + 0.08f, k_coping,
          k_half + 0.04f);
}

// Whom people there are like.
uint32_t kind_like(std::span<const Kind> kinds, bool woman, float youngest, float oldest, uint32_t skipped) {
    uint32_t last = 0;
    for (uint32_t i = 0; i < kinds.size(); ++i) {
        const Kind& kind = kinds[i];
        const bool is_plain = kind.body.cane == Vec3{} && kind.body.pram == Vec3{} &&
                              kind.body.wear.bag == Bag::none && !kind.body.wear.phone;
        if (!is_plain || kind.woman != woman || kind.age < youngest || kind.age > oldest) continue;
        last = i;
        if (skipped-- == 0) break;
    }
    return last;
}

MoverSolid solid(Vec3 middle, Vec3 half, Matter matter, float shade = 1) {
    MoverSolid s;
    s.middle = middle, s.half = half, s.matter = matter, s.shade = shade, s.bears = false;
    return s;
}

// A crate of planks, or a box of cardboard with a strip of tape.
std::vector<MoverSolid> parcel_solids(const Parcel& p) {
    std::vector<MoverSolid> all;
    const Vec3 h = p.half;
    if (p.mass < 10) {
        all.push_back(solid({}, h, Matter::cardboard));
        all.push_back(solid({0, h.y - 0.001f, 0}, {h.x + 0.001f, 0.002f, 0.025f}, Matter::rope, 1.25f));
        all.push_back(solid({0, h.y, 0}, {0.002f, 0.0015f, h.z}, Matter::dark_wood, 0.9f));
        return all;
    }
    constexpr float k_plank = 0.011f, k_slit = 0.006f;
    const int rows = 3;
    const float high = h.y / static_cast<float>(rows);
    all.push_back(
        solid({0, -0.02f, 0}, h - Vec3{k_plank, 0.02f + k_plank, k_plank}, Matter::dark_wood, 0.6f));
    for (int r = 0; r < rows; ++r) {
        const float y = -h.y + high * static_cast<float>(2 * r + 1),
                    shade = 1.0f + 0.06f * static_cast<float>(r % 2);
        for (const float side : {-1.0f, 1.0f}) {
            all.push_back(
                solid({side * (h.x - k_plank), y, 0}, {k_plank, high - k_slit, h.z}, Matter::wood, shade));
            all.push_back(solid({0, y, side * (h.z - k_plank)}, {h.x - 2 * k_plank, high - k_slit, k_plank},
                                Matter::wood, 1.04f - 0.05f * static_cast<float>(r % 2)));
        }
    }
    for (int n = 0; n < 3; ++n) {
        const float wide = h.z / 3, z = -h.z + wide * static_cast<float>(2 * n + 1);
        all.push_back(solid({0, h.y - k_plank, z}, {h.x - 2 * k_plank, k_plank, wide - k_slit}, Matter::wood,
                            0.97f + 0.05f * static_cast<float>(n % 2)));
    }
    return all;
}

// From the hinge: x to the edge, z to where it opens.
std::vector<MoverSolid> leaf_solids(const SwingDoor& door) {
    std::vector<MoverSolid> all;
    const float side = door.hinge_left ? -1.0f : 1.0f, half = 0.5f * door.thick;
    constexpr int k_planks = 6;
    const float wide = door.width / k_planks;
    all.reserve(2 * k_planks);
    for (int n = 0; n < k_planks; ++n)
        all.push_back(solid({side * wide * (static_cast<float>(n) + 0.5f), 0.5f * door.height + 0.005f, 0},
                            {0.5f * wide - 0.003f, 0.5f * door.height - 0.005f, half - 0.01f}, Matter::wood,
                            0.78f + 0.05f * static_cast<float>(n * 7 % 3)));
    all.push_back(solid({side * 0.5f * door.width, 0.5f * door.height + 0.005f, 0},
                        {0.5f * door.width - 0.002f, 0.5f * door.height - 0.006f, half - 0.016f},
                        Matter::dark_wood, 0.5f));
    for (const float y : {0.25f, door.height - 0.25f})
        for (const float face : {-1.0f, 1.0f})
            all.push_back(solid({side * 0.5f * door.width, y, face * (half - 0.006f)},
                                {0.5f * door.width - 0.03f, 0.06f, 0.006f}, Matter::dark_wood, 1.1f));
    const float x = side * (door.width - k_handle_from_edge);
    for (const float face : {-1.0f, 1.0f})
        all.push_back(
            solid({x, k_handle_high - 0.03f, face * half}, {0.022f, 0.11f, 0.005f}, Matter::steel, 0.8f));
    return all;
}

// About its spindle.
std::vector<MoverSolid> lever_solids(const SwingDoor& door) {
    std::vector<MoverSolid> all;
    const float side = door.hinge_left ? -1.0f : 1.0f, half = 0.5f * door.thick;
    for (const float face : {-1.0f, 1.0f}) {
        all.push_back(solid({0, 0, face * (half + 0.5f * k_lever_out)},
                            {k_lever_thick, k_lever_thick, 0.5f * k_lever_out}, Matter::steel));
        all.push_back(solid({-side * 0.065f, 0, face * (half + k_lever_out)},
                            {0.065f + k_lever_thick, k_lever_thick, k_lever_thick}, Matter::steel));
    }
    return all;
}

}  // namespace

void add_yard(Scenery& s, Vec2 at) {
    const Vec2 half = k_yard_half;
    constexpr float k_below = 0.6f;
    add_block(s, at - half, at + half, -k_below, 0, k_paving, SceneryUse::backdrop);
    add_capped(s, Vec2{-half.x, -half.z - k_brick_thick} + at, Vec2{half.x, -half.z} + at, k_rear_wall,
               k_brick, 0.07f);
    add_door_wall(s, at);
    for (size_t n = 0; n < std::size(k_walls_at); ++n) {
        const Vec2 middle = Vec2{k_walls_x, k_walls_at[n]} + at, out{k_walls_half, 0.5f * k_walls_thick};
        add_block(s, middle - out, middle + out, 0, k_wall_heights[n], k_stone, SceneryUse::backdrop);
    }
    for (const Table& table : k_tables) add_table(s, table, at);
}

Things yard_things(Vec2 at) {
    Things things;
    for (size_t strip = 0; strip < std::size(k_on_ground); ++strip) {
        for (size_t n = 0; n < 2; ++n) {
            const Table& table = k_tables[2 * strip + n];
            things.shelves.push_back({table.edge + at, table.height, table.heading, k_inset});
        }
        things.shelves.push_back({k_on_ground[strip] + at, 0, k_pi, 0});
    }
    things.parcels = {{{0.21f, 0.15f, 0.16f}, 18, 0}, {{0.19f, 0.14f, 0.15f}, 10, 2},
                      {{0.18f, 0.13f, 0.14f}, 10, 3}, {{0.17f, 0.15f, 0.13f}, 2, 5},
                      {{0.13f, 0.1f, 0.1f}, 2, 6},    {{0.12f, 0.08f, 0.11f}, 1, 8}};
    for (size_t n = 0; n < std::size(k_openings); ++n) {
        SwingDoor door;
        door.hinge_left = k_hinge_left[n];
        door.width = k_opening - 2 * k_gap, door.height = k_opening_high - k_gap;
        door.hinge = Vec2{k_openings[n] + (door.hinge_left ? k_opening - k_gap : k_gap),
                          0.5f * k_brick_thick - 0.5f * door.thick} +
                     at;
        things.doors.push_back(door);
    }
    for (size_t n = 0; n < std::size(k_walls_at); ++n)
        things.walls.push_back(
            {Vec2{k_walls_x, k_walls_at[n]} + at, 0, 0, k_wall_heights[n], k_walls_thick, k_walls_half});
    return things;
}

std::vector<DoerPlan> yard_plans(std::span<const Kind> kinds, Vec2 at) {
    using What = Deed::What;
    std::vector<DoerPlan> plans;
    const uint32_t man = kind_like(kinds, false, 20, 50, 0), woman = kind_like(kinds, true, 20, 50, 0),
                   other_man = kind_like(kinds, false, 20, 60, 1),
                   other_woman = kind_like(kinds, true, 20, 60, 1), child = kind_like(kinds, true, 8, 12, 0),
                   boy = kind_like(kinds, false, 7, 13, 0);
    const uint32_t carriers[] = {man, woman, child};
    for (uint32_t strip = 0; strip < 3; ++strip) {
        DoerPlan plan;
        plan.name = strip == 2 ? "a child, small boxes" : strip == 0 ? "10 and 18 kg" : "2 and 10 kg";
        plan.kind = carriers[strip];
        plan.at = at + Vec2{8.9f, k_tables[2 * strip].edge.z};
        plan.speed = strip == 2 ? 1.05f : 1.2f;
        // The free shelf first: the second of its three.
        for (uint32_t n = 0; n < 3; ++n) {
            plan.round.push_back({What::take, 3 * strip + (n + 2) % 3, {}});
            plan.round.push_back({What::put, 3 * strip + (n + 1) % 3, {}});
        }
        plans.push_back(plan);
    }
    auto walk = [&](float x, float z) { return Deed{What::walk, 0, at + Vec2{x, z}}; };
    for (uint32_t pair = 0; pair < 2; ++pair) {
        const uint32_t out = pair == 0 ? 0 : 3, back = pair == 0 ? 1 : 2;
        const float a = k_openings[out] + 0.5f * k_opening, b = k_openings[back] + 0.5f * k_opening;
        DoerPlan plan;
        plan.name = "doors";
        plan.kind = pair == 0 ? other_man : other_woman;
        plan.at = at + Vec2{a, -2.6f};
        plan.round = {{What::push, out, {}},  walk(a, 2.7f),  walk(b, 3.0f),
                      {What::pull, back, {}}, walk(b, -2.7f), walk(a, -3.0f)};
        plans.push_back(plan);
    }
    const float lanes[] = {0.95f, 2.4f, 3.85f};
    const uint32_t climbers[] = {kind_like(kinds, true, 20, 60, 2), kind_like(kinds, false, 20, 60, 2), boy};
    for (size_t n = 0; n < std::size(lanes); ++n) {
        const float x = lanes[n];
        DoerPlan plan;
        plan.name = "low walls";
        plan.kind = climbers[n];
        plan.at = at + Vec2{x, n == 1 ? 5.0f : -5.2f};
        plan.heading = n == 1 ? k_pi : 0;
        auto over = [&](uint32_t wall) { return Deed{What::climb, wall, at + Vec2{x, k_walls_at[wall]}}; };
        const Deed low = over(0), middle = over(1), high = over(2);
        const Deed front = walk(x, 5.0f), rear = walk(x, -5.2f);
        if (n == 0) plan.round = {low, middle, high, front, high, middle, low, rear};
        if (n == 1) plan.round = {high, middle, low, rear, low, middle, high, front};
        if (n == 2) plan.round = {low, middle, walk(x, 1.9f), middle, low, rear};
        plans.push_back(plan);
    }
    return plans;
}

std::shared_ptr<const Ground> make_yard_ground(Vec2 at) {
    auto ground = std::make_shared<Ground>();
    ground->name = "yard";
    const Vec2 low = at - k_yard_half, high = at + k_yard_half;
    ground->vertices = {{low.x, 0, low.z}, {low.x, 0, high.z}, {high.x, 0, high.z}, {high.x, 0, low.z}};
    ground->indices = {0, 1, 2, 0, 2, 3};
    ground->kinds.assign(2, Surface::plaza);
    index_ground(*ground);
    return ground;
}

std::vector<Mover> yard_movers(const Things& things) {
    std::vector<Mover> all;
    auto add = [&](const char* name, std::vector<MoverSolid> solids) {
        Mover mover;
        mover.name = name, mover.kind = Mover::Kind::led, mover.solids = std::move(solids);
        all.push_back(std::move(mover));
    };
    for (const Parcel& parcel : things.parcels)
        add(parcel.mass < 10 ? "box" : "crate", parcel_solids(parcel));
    for (const SwingDoor& door : things.doors) {
        add("door", leaf_solids(door));
        add("handle", lever_solids(door));
    }
    return all;
}

City build_yard(uint64_t seed) {
    constexpr float k_way = 4.5f;  // metres, before it
    const RandomKey key{seed, 0, 0, Purpose::city};
    City city;
    city.ground.name = "yard";
    const float x = k_yard_half.x, z = k_yard_half.z;
    city.ground.vertices = {{-x, 0, z}, {-x, 0, z + k_way}, {x, 0, z + k_way}, {x, 0, z}};
    city.ground.indices = {0, 1, 2, 0, 2, 3};
    city.ground.kinds.assign(2, Surface::plaza);
    city.ground_axes.assign(2, {1, 0});
    add_yard(city.scenery, {});
    const Meadow meadow{.level = 22, .from = 5.5f, .below = 0.3f, .turn = 2 * k_pi * random_unit(key)};
    add_land(city.scenery, meadow);
    index_city(city);
    add_trees(city, meadow, 19, key);
    list_obstacles(city);
    return city;
}

}  // namespace flaneur
