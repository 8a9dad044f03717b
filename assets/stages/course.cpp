#include "assets/stages/course.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "assets/colour.h"
#include "assets/stages/meadow.h"
#include "assets/stages/solids.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_above_meadow = 0.34f, k_water = -0.22f, k_pool_floor = -0.5f;  // metres
constexpr uint32_t k_paving = rgb(0xc4bcac), k_stone = rgb(0xa8a193), k_slab = rgb(0xb6ad9c);

// One straight of the course, on which things have places along the way that people go, and aside.
struct Line {
    float from, turn;  // x of its middle; 1: along +x, -1: along -x
    float z, half;     // its middle, and half its width
    float x(float along) const { return from + turn * along; }
};
struct Layout {
    bool is_flat;
    Line front, back;
    Vec2 low, high;               // of the terrace
    float pools_low, pools_high;  // along z
};
constexpr Layout k_round{false, {0, 1, 2.7f, 0.95f}, {0, -1, -2.7f, 0.95f}, {-17, -18.5f}, {17, 6.5f}, -4.1f,
                         -1.3f};
constexpr Layout k_flat{true, {-11.3f, 1, 0, 3.7f}, {11.3f, 1, 0, 3.7f}, {-25, -5}, {25, 5}, -4, 4};
const Layout& layout(bool is_flat) { return is_flat ? k_flat : k_round; }

constexpr float k_lawn_x = 11, k_lawn_z = 1.35f;    // of the lawn within the round way
constexpr float k_turn = 2.7f, k_turns_at = 12.2f;  // of the round way: radius, and x of the turns' middles
constexpr float k_lanes_apart = 0.9f, k_ends = 22.6f;  // of the flat one

// Along the front line, metres.
constexpr float k_rise = 0.16f, k_tread = 0.35f;
constexpr int k_steps = 5;
constexpr float k_up = -10.4f, k_landing = 1.3f, k_bridge = k_up + k_tread * (k_steps - 1) + k_landing,
                k_bridge_long = 6, k_down = k_bridge + k_bridge_long + k_landing;
constexpr float k_tilts = 3.8f, k_tilts_half = 1.35f, k_lifts = 6.9f, k_lift_half = 0.7f;
// Along the back line.
constexpr float k_rubble = -10.6f, k_cell = 0.46f;
constexpr int k_rubble_long = 9;
constexpr float k_pool_1 = -5.2f, k_pool_1_end = -0.06f, k_stones = -4.78f, k_stones_apart = 0.6f,
                k_stone_radius = 0.265f;
constexpr int k_stone_count = 8;
constexpr float k_pool_2 = 2.2f, k_pool_2_end = 7.4f, k_ferry_half = 1.05f;

// A block whose top goes evenly from `from` at its low x to `to` at its high one.
struct Piece {
    Vec2 low, high;
    float from, to;
    uint32_t colour;
    Surface kind = Surface::plaza;
};

Piece piece(const Line& line, float from, float to, float height, uint32_t colour,
            Surface kind = Surface::plaza) {
    const float a = line.x(from), b = line.x(to);
    return {{std::min(a, b), line.z - line.half},
            {std::max(a, b), line.z + line.half},
            height,
            height,
            colour,
            kind};
}

void add_stairs(const Line& line, std::vector<Piece>& pieces) {
    for (int step = 0; step < k_steps; ++step) {
        const float height = k_rise * static_cast<float>(step + 1), at = k_tread * static_cast<float>(step);
        const bool is_last = step + 1 == k_steps;
        pieces.push_back(piece(line, k_up + at, is_last ? k_bridge : k_up + at + k_tread, height, k_stone,
                               Surface::steps));
        const float down = k_down + k_tread * (k_steps - 1);
        pieces.push_back(piece(line, is_last ? k_bridge + k_bridge_long : down - at - k_tread, down - at,
                               height, k_stone, Surface::steps));
    }
}

void add_rubble(const Line& line, std::vector<Piece>& pieces) {
    const int across = static_cast<int>(2 * line.half / k_cell);
    for (int i = 0; i < k_rubble_long; ++i)
        for (int k = 0; k < across; ++k) {
            const RandomKey key{11, static_cast<uint32_t>(i), static_cast<uint32_t>(k), Purpose::city};
            const float at = k_rubble + k_cell * static_cast<float>(i);
            Piece slab =
                piece(line, at, at + k_cell, 0, shaded(k_slab, random_between(key, 0.84f, 1.08f, 2)));
            slab.low.z = line.z + k_cell * (static_cast<float>(k) - 0.5f * static_cast<float>(across));
            slab.high.z = slab.low.z + k_cell;
            slab.from = random_between(key, 0.03f, 0.15f, 0);
            slab.to = slab.from + random_between(key, -0.045f, 0.045f, 1);
            pieces.push_back(slab);
        }
}

std::vector<Piece> pieces_of(const Layout& l) {
    std::vector<Piece> pieces;
    add_stairs(l.front, pieces);
    add_rubble(l.back, pieces);
    return pieces;
}

// The pools' ends along x, the lower first.
std::array<std::pair<float, float>, 2> pools_of(const Layout& l) {
    auto pool = [&](float a, float b) {
        return std::pair{std::min(l.back.x(a), l.back.x(b)), std::max(l.back.x(a), l.back.x(b))};
    };
    std::array pools = {pool(k_pool_1, k_pool_1_end), pool(k_pool_2, k_pool_2_end)};
    if (pools[0].first > pools[1].first) std::swap(pools[0], pools[1]);
    return pools;
}

void add_level(Ground& ground, Vec2 low, Vec2 high, float from, float to, Surface kind) {
    const auto first = static_cast<uint32_t>(ground.vertices.size());
    for (const Vec3 corner :
         {Vec3{low.x, from, low.z}, {low.x, from, high.z}, {high.x, to, high.z}, {high.x, to, low.z}})
        ground.vertices.push_back(corner);
    for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) ground.indices.push_back(first + k);
    ground.kinds.insert(ground.kinds.end(), 2, kind);
}

// The terrace with its pools.
void add_terrace(Ground& ground, const Layout& l) {
    auto level = [&](float low_x, float high_x, float low_z, float high_z, float y, Surface kind) {
        add_level(ground, {low_x, low_z}, {high_x, high_z}, y, y, kind);
    };
    const auto pools = pools_of(l);
    level(l.low.x, l.high.x, l.low.z, l.pools_low, 0, Surface::plaza);
    if (l.is_flat) {
        level(l.low.x, l.high.x, l.pools_high, l.high.z, 0, Surface::plaza);
    } else {
        level(-k_lawn_x, k_lawn_x, l.pools_high, k_lawn_z, 0, Surface::grass);
        level(l.low.x, -k_lawn_x, l.pools_high, k_lawn_z, 0, Surface::plaza);
        level(k_lawn_x, l.high.x, l.pools_high, k_lawn_z, 0, Surface::plaza);
        level(l.low.x, l.high.x, k_lawn_z, l.high.z, 0, Surface::plaza);
    }
    level(l.low.x, pools[0].first, l.pools_low, l.pools_high, 0, Surface::plaza);
    level(pools[0].second, pools[1].first, l.pools_low, l.pools_high, 0, Surface::plaza);
    level(pools[1].second, l.high.x, l.pools_low, l.pools_high, 0, Surface::plaza);
    for (const auto& [from, to] : pools) level(from, to, l.pools_low, l.pools_high, k_water, Surface::water);
}

void add_pool_walls(Scenery& s, const Layout& l) {
    for (const auto& [from, to] : pools_of(l)) {
        // The other way round than a block's: its inside is seen.
        std::vector<Vec2> outline = box_outline({from, l.pools_low}, {to, l.pools_high});
        std::reverse(outline.begin(), outline.end());
        add_courses(s, outline, k_pool_floor, 0, shaded(k_stone, 0.9f), SceneryUse::backdrop);
    }
}

void add_pieces(Scenery& s, const std::vector<Piece>& pieces) {
    for (const Piece& p : pieces) {
        const std::vector<Vec2> o = box_outline(p.low, p.high);
        const float tops[] = {p.from, p.to, p.to, p.from};
        for (size_t i = 0; i < 4; ++i) {
            const size_t next = (i + 1) % 4;
            const Vec3 side[4] = {at_height(o[i], tops[i]), at_height(o[next], tops[next]),
                                  at_height(o[next], 0), at_height(o[i], 0)};
            add_quad(s, side, shaded(p.colour, 0.9f), SceneryUse::backdrop);
        }
        const Vec3 lid[4] = {at_height(o[3], tops[3]), at_height(o[2], tops[2]), at_height(o[1], tops[1]),
                             at_height(o[0], tops[0])};
        add_quad(s, lid, p.colour, SceneryUse::backdrop);
    }
}

Mover thing(const char* name, Vec3 middle) {
    Mover mover;
    mover.name = name;
    mover.place.middle = middle;
    return mover;
}

// So narrow that both hands are at its ropes, where one line alone goes over it.
void add_bridge(const Line& line, bool is_wide, std::vector<Mover>& movers) {
    constexpr float k_narrow = 0.44f;
    const float side = is_wide ? 0.9f * line.half : k_narrow;
    constexpr int k_planks = 24;
    constexpr float k_plank = k_bridge_long / k_planks, k_top = k_rise * k_steps, k_thick = 0.05f,
                    k_sag = 0.34f;
    constexpr float k_rail = 0.97f, k_rope = 0.014f;
    constexpr uint32_t k_lag = 3;  // ticks from plank to plank
    for (int n = 0; n < k_planks; ++n) {
        const float share = (static_cast<float>(n) + 0.5f) / k_planks, bow = 4 * share * (1 - share);
        const float slope = k_sag * (8 * share - 4) / k_bridge_long;
        Mover m = thing("plank", {line.x(k_bridge + k_plank * (static_cast<float>(n) + 0.5f)),
                                  k_top - 0.5f * k_thick - k_sag * bow, line.z});
        const auto late = k_lag * static_cast<uint32_t>(n);
        m.place.reach = {0, 0.025f * bow, 0.075f * bow};
        m.angles.middle = {0, 0, arctan2(slope, 1) * line.turn};
        m.angles.reach = {0.045f * bow, 0, 0};
        m.place.period[1] = 190, m.place.period[2] = m.angles.period[0] = 260;
        m.place.start[1] = 600 - late, m.place.start[2] = m.angles.start[0] = 700 - late;
        const float wear = random_between({5, static_cast<uint32_t>(n), 0, Purpose::city}, 0.86f, 1.08f);
        m.solids.push_back({.half = {0.5f * k_plank + 0.001f, 0.5f * k_thick, side}, .shade = wear});
        for (const float z : {-side, side}) {
            m.solids.push_back({.middle = {0, k_rail, z},
                                .half = {0.5f * k_plank + 0.006f, k_rope, k_rope},
                                .matter = Matter::rope,
                                .bears = false});
            if (n % 3 == 1)
                m.solids.push_back({.middle = {0, 0.5f * k_rail, z},
                                    .half = {0.6f * k_rope, 0.5f * k_rail, 0.6f * k_rope},
                                    .matter = Matter::rope,
                                    .shade = 0.9f,
                                    .bears = false});
        }
        movers.push_back(std::move(m));
    }
    // What it hangs on.
    for (const float end : {k_bridge - 0.2f, k_bridge + k_bridge_long + 0.2f})
        for (const float z : {-side, side}) {
            Mover post = thing("post", {line.x(end), k_top + 0.5f, line.z + z});
            post.solids = {{.form = MoverSolid::Form::cylinder,
                            .half = {0.06f, 0.5f, 0.06f},
                            .matter = Matter::dark_wood,
                            .bears = false}};
            movers.push_back(std::move(post));
        }
}

void add_tilting(const Line& line, std::vector<Mover>& movers) {
    Mover m = thing("plate that tilts", {line.x(k_tilts), 0.1f, line.z});
    m.solids = {{.half = {k_tilts_half, 0.035f, 0.95f * line.half}, .matter = Matter::steel},
                {.middle = {0, -0.06f, 0},
                 .half = {0.07f, 0.05f, 0.9f * line.half},
                 .matter = Matter::dark_wood,
                 .bears = false}};
    m.angles.reach = {0.03f, 0, 0.062f};
    m.angles.period[0] = 410, m.angles.period[2] = 330;
    movers.push_back(std::move(m));
}

void add_lifts(const Line& line, std::vector<Mover>& movers) {
    for (int n = 0; n < 2; ++n) {
        const float at = k_lifts + (2 * k_lift_half + 0.04f) * static_cast<float>(n);
        Mover m = thing("plate that rises", {line.x(at), 0.1f, line.z});
        m.solids = {{.half = {k_lift_half, 0.03f, 0.95f * line.half}, .matter = Matter::wood},
                    {.middle = {0, -0.35f, 0},
                     .half = {0.16f, 0.32f, 0.16f},
                     .matter = Matter::steel,
                     .bears = false}};
        m.solids.back().form = MoverSolid::Form::cylinder;
        m.place.reach = {0, 0.1f, 0};
        m.place.period[1] = 420, m.place.start[1] = n == 0 ? 0 : 210;
        movers.push_back(std::move(m));
    }
}

void add_stones(const Layout& l, std::vector<Mover>& movers) {
    for (int n = 0; n < k_stone_count; ++n) {
        const RandomKey key{13, static_cast<uint32_t>(n), 0, Purpose::city};
        const float aside =
            l.is_flat ? 0 : (n % 2 == 0 ? 0.07f : -0.07f) + random_between(key, -0.04f, 0.04f, 0);
        Mover m = thing("stepping stone", {l.back.x(k_stones + k_stones_apart * static_cast<float>(n)),
                                           -0.22f, l.back.z + aside});
        MoverSolid stone{.half = {k_stone_radius, 0.25f, k_stone_radius},
                         .matter = Matter::stone,
                         .shade = random_between(key, 0.85f, 1.05f, 1)};
        stone.half.x = stone.half.z = k_stone_radius * random_between(key, 1, 1.1f, 2);
        if (l.is_flat)
            stone.half.z = 0.95f * l.back.half;
        else
            stone.form = MoverSolid::Form::cylinder;
        m.solids = {stone};
        // Some float.
        if (n % 3 == 2) {
            m.place.reach = {0, 0.03f, 0};
            m.place.period[1] = 170 + 20 * static_cast<uint32_t>(n);
            m.solids[0].matter = Matter::dark_wood;
        }
        movers.push_back(std::move(m));
    }
}

void add_ferry(const Line& line, std::vector<Mover>& movers) {
    constexpr float k_gap = 0.03f;
    const float low = k_pool_2 + k_gap + k_ferry_half, high = k_pool_2_end - k_gap - k_ferry_half;
    Mover m = thing("ferry", {line.x(0.5f * (low + high)), -0.02f, line.z});
    m.place.reach = {0.5f * (high - low), 0, 0};
    m.place.period[0] = 1080;
    m.place.rests = 2;
    constexpr int k_boards = 6;
    for (int n = 0; n < k_boards; ++n) {
        constexpr float k_board = 2 * k_ferry_half / k_boards;
        m.solids.push_back({.middle = {-k_ferry_half + k_board * (static_cast<float>(n) + 0.5f), 0, 0},
                            .half = {0.5f * k_board, 0.04f, 0.95f * line.half},
                            .shade = n % 2 == 0 ? 1.0f : 0.93f});
    }
    for (const float side : {-1.0f, 1.0f})
        m.solids.push_back({.middle = {0, -0.18f, side * 0.7f * line.half},
                            .half = {0.95f * k_ferry_half, 0.14f, 0.16f},
                            .matter = Matter::dark_wood,
                            .bears = false});
    movers.push_back(std::move(m));
}

// Two straights with half circles between.
std::vector<Vec2> round_way() {
    constexpr int k_pieces = 24;
    std::vector<Vec2> way;
    for (const float end : {1.0f, -1.0f})
        for (int i = 0; i <= k_pieces; ++i) {
            const SinCos at = sin_cos(k_pi * static_cast<float>(i) / k_pieces);
            way.push_back(Vec2{end * (k_turns_at + k_turn * at.sine), end * k_turn * at.cosine});
        }
    return way;
}

}  // namespace

City build_course(uint64_t seed, bool is_flat) {
    const RandomKey key{seed, 0, 0, Purpose::city};
    const Layout& l = layout(is_flat);
    City city;
    city.ground.name = "course";
    add_terrace(city.ground, l);
    city.ground_axes.assign(city.ground.kinds.size(), {1, 0});
    add_courses(city.scenery, box_outline(l.low, l.high), -2 * k_above_meadow, 0, k_paving,
                SceneryUse::backdrop);
    add_pool_walls(city.scenery, l);
    add_pieces(city.scenery, pieces_of(l));
    const float half = std::max(l.high.x, -l.low.z);
    const Meadow meadow{
        .level = 1.5f * half, .from = 3, .below = k_above_meadow, .turn = 2 * k_pi * random_unit(key)};
    add_land(city.scenery, meadow);
    index_city(city);
    // From the side they would stand before it.
    if (!is_flat) add_trees(city, meadow, 1.5f * half, key);
    list_obstacles(city);
    return city;
}

StepCourse make_course(bool is_flat) {
    const Layout& l = layout(is_flat);
    StepCourse course;
    course.is_flat = is_flat;
    auto ground = std::make_shared<Ground>();
    ground->name = "course";
    add_terrace(*ground, l);
    for (const Piece& p : pieces_of(l)) add_level(*ground, p.low, p.high, p.from, p.to, p.kind);
    index_ground(*ground);
    course.ground = std::move(ground);
    add_bridge(l.front, is_flat, course.movers);
    add_tilting(l.front, course.movers);
    add_lifts(l.front, course.movers);
    add_stones(l, course.movers);
    add_ferry(l.back, course.movers);
    if (!is_flat) {
        course.ways = {round_way()};
        return course;
    }
    for (int lane = 0; lane < k_flat_lanes; ++lane) {
        const float z = k_lanes_apart * (static_cast<float>(lane) - 0.5f * (k_flat_lanes - 1));
        course.ways.push_back({{-k_ends, z}, {k_ends, z}});
    }
    return course;
}

}  // namespace flaneur
