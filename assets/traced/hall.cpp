#include "assets/traced/hall.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <unordered_map>

#include "assets/colour.h"
#include "assets/plan/polygons.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"

namespace flaneur {

static float height_on(const WalkablePolygon& p, Vec2 at) { return p.level + dot(p.rise, at); }

namespace {

constexpr float k_thick = 0.14f, k_line_thick = 0.08f;  // metres, of walls
constexpr float k_opening = 0.45f;                      // metres to each side of who crosses an edge
constexpr float k_stride = 0.3f;                        // metres, in which ways are looked at
constexpr float k_plate_thick = 0.3f, k_table = 60;     // metres; what the plate lies on reaches so far
constexpr float k_skirting = 0.02f;                     // metres that walls reach below the floor
constexpr float k_cell = 0.5f, k_storey = 1.2f;         // metres, of ground that ways tell
constexpr int k_rings = 2;                              // of such squares, beside them
constexpr uint32_t k_floor = rgb(0xdcd8cf), k_plate = rgb(0xbdb8ae), k_table_top = rgb(0xb3b1ad),
                   k_wall = rgb(0xf3f0ea), k_wall_top = rgb(0x6f6a64);

Ring ring_of(const std::vector<Vec2>& outline) {
    Ring ring;
    for (const Vec2 corner : outline) ring.push_back(to_point(corner));
    return positive(ring);
}

Rings rings_of_area(const WalkablePolygon& p) {
    Rings holes;
    for (const auto& hole : p.holes) holes.push_back(ring_of(hole));
    return subtract({ring_of(p.outer)}, holes);
}

bool is_level(const Trajectories& t) {
    if (t.area.empty() && t.heights == HeightsOf::ground) {
        const auto [low, high] = std::ranges::minmax(t.sightings, {}, &Sighting::height);
        return high.height - low.height < 0.3f;
    }
    return std::ranges::all_of(
        t.area, [&](const WalkablePolygon& p) { return p.rise == Vec2{} && p.level == t.area[0].level; });
}

// Where people go, in strides: pairs of places.
std::vector<std::pair<Vec2, Vec2>> strides_of(const Trajectories& t) {
    std::vector<std::pair<Vec2, Vec2>> strides;
    std::unordered_map<uint32_t, Vec2> last;
    constexpr float k_jump = 3;  // metres
    for (const Sighting& s : t.sightings) {
        const auto [at, is_new] = last.try_emplace(s.id, s.at);
        const float far = length(s.at - at->second);
        if (is_new || far < k_stride) continue;
        if (far < k_jump) strides.push_back({at->second, s.at});
        at->second = s.at;
    }
    return strides;
}

// Squares round where people cross the edges of an area.
Rings openings_in(const Rings& area, const std::vector<std::pair<Vec2, Vec2>>& strides) {
    Rings openings;
    std::map<std::pair<int, int>, bool> known;  // by squares of a third of an opening
    for (const Ring& ring : area)
        for (size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
            const Vec2 a = to_metres(ring[k]), b = to_metres(ring[i]), along = b - a;
            for (const auto& [from, to] : strides) {
                const Vec2 way = to - from;
                const float det = along.x * way.z - along.z * way.x;
                if (std::fabs(det) < 1e-9f) continue;
                const Vec2 off = from - a;
                const float on = (off.x * way.z - off.z * way.x) / det,
                            when = (off.x * along.z - off.z * along.x) / det;
                if (on < 0 || on > 1 || when < 0 || when > 1) continue;
                const Vec2 at = a + along * on;
                const std::pair square{static_cast<int>(std::floor(at.x * 3 / k_opening)),
                                       static_cast<int>(std::floor(at.z * 3 / k_opening))};
                if (!known.try_emplace(square, true).second) continue;
                const Vec2 half{k_opening, k_opening};
                openings.push_back(rectangle(to_point(at - half), to_point(at + half)));
            }
        }
    return unite(openings);
}

// Without its holes.
Rings filled(const Rings& area) {
    Rings outers;
    for (const Region& region : regions_of(area)) outers.push_back(region.outer);
    return unite(outers);
}

void add_triangle(Scenery& s, Vec3 a, Vec3 b, Vec3 c, uint32_t colour, SceneryUse use) {
    const Vec3 normal = normalize_or(cross(b - a, c - a), {0, 1, 0});
    for (const Vec3 corner : {a, b, c}) {
        s.indices.push_back(static_cast<uint32_t>(s.vertices.size()));
        s.vertices.push_back({corner, normal, {}, colour});
    }
    s.pictures.push_back(~0u);
    s.uses.push_back(use);
}

// A region from above, at heights that `height` tells.
template <class Height>
void add_top(Scenery& s, Ground* ground, const Region& region, const Height& height, uint32_t colour,
             SceneryUse use) {
    std::vector<Vec3> corners;
    auto add = [&](const Ring& ring) {
        for (const Point p : ring) corners.push_back(at_height(to_metres(p), height(to_metres(p))));
    };
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
    const std::vector<uint32_t> triangles = triangulate(region);
    const auto first = ground ? static_cast<uint32_t>(ground->vertices.size()) : 0;
    if (ground) ground->vertices.insert(ground->vertices.end(), corners.begin(), corners.end());
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const uint32_t a = triangles[i], b = triangles[i + 2], c = triangles[i + 1];
        add_triangle(s, corners[a], corners[b], corners[c], colour, use);
        if (!ground) continue;
        for (const uint32_t corner : {a, b, c}) ground->indices.push_back(first + corner);
        ground->kinds.push_back(Surface::plaza);
    }
}

// Upright sides below the rings of a region.
template <class Height>
void add_sides(Scenery& s, const Region& region, const Height& top, const Height& bottom, uint32_t colour,
               SceneryUse use) {
    auto add = [&](const Ring& ring) {
        for (size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
            const Vec2 a = to_metres(ring[k]), b = to_metres(ring[i]);
            const Vec3 corners[4] = {at_height(a, bottom(a)), at_height(a, top(a)), at_height(b, top(b)),
                                     at_height(b, bottom(b))};
            add_triangle(s, corners[0], corners[1], corners[2], colour, use);
            add_triangle(s, corners[0], corners[2], corners[3], colour, use);
        }
    };
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
}

using HeightAt = std::function<float(Vec2)>;

void add_walls(Scenery& s, const Rings& walls, const HeightAt& level) {
    const HeightAt top = [&](Vec2 at) { return level(at) + k_cut_wall; },
                   bottom = [&](Vec2 at) { return level(at) - k_skirting; };
    for (const Region& region : regions_of(walls)) {
        add_top(s, nullptr, region, top, k_wall_top, SceneryUse::solid);
        add_sides(s, region, top, bottom, k_wall, SceneryUse::solid);
    }
}

struct Box {
    Vec2 low{1e9f, 1e9f}, high{-1e9f, -1e9f};
};
void take_in(Box& box, Vec2 at) {
    box.low = {std::min(box.low.x, at.x), std::min(box.low.z, at.z)};
    box.high = {std::max(box.high.x, at.x), std::max(box.high.z, at.z)};
}

Box bounds_of(const Trajectories& t) {
    Box box;
    for (const Sighting& s : t.sightings) take_in(box, s.at);
    for (const WalkablePolygon& p : t.area)
        for (const Vec2 corner : p.outer) take_in(box, corner);
    for (const auto& line : t.walls)
        for (const Vec2 corner : line) take_in(box, corner);
    return box;
}

struct Level {
    double sum = 0;
    int count = 0;
    float middle() const { return static_cast<float>(sum / count); }
};
// Of squares of the ground plane.
using Cells = std::map<std::pair<int, int>, std::vector<Level>>;

Level* level_near(std::vector<Level>& levels, float height) {
    const auto at = std::ranges::find_if(
        levels, [&](const Level& l) { return std::fabs(l.middle() - height) < k_storey; });
    return at == levels.end() ? nullptr : &*at;
}

// By the squares beside those that are there, as high as these in the middle.
void grow(Cells& cells) {
    Cells beside;
    for (const auto& [square, levels] : cells)
        for (const Level& level : levels)
            for (const auto& [dx, dz] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                const std::pair at{square.first + dx, square.second + dz};
                const auto there = cells.find(at);
                if (there != cells.end() && level_near(there->second, level.middle())) continue;
                std::vector<Level>& to = beside[at];
                Level* known = level_near(to, level.middle());
                if (!known) known = &to.emplace_back();
                known->sum += static_cast<double>(level.middle()), ++known->count;
            }
    for (auto& [square, levels] : beside)
        for (const Level& level : levels) cells[square].push_back({static_cast<double>(level.middle()), 1});
}

// Squares of ground where people are, and a metre beside them, where the area has none, at the heights at
// which they are.
void add_ground_of_ways(City& city, const Trajectories& t) {
    if (t.heights != HeightsOf::ground) return;
    Cells cells;
    for (const Sighting& s : t.sightings) {
        const bool is_known = std::ranges::any_of(t.area, [&](const WalkablePolygon& p) {
            return std::fabs(height_on(p, s.at) - s.height) < 0.4f && is_within(p.outer, s.at);
        });
        if (is_known) continue;
        auto& levels = cells[{static_cast<int>(std::floor(s.at.x / k_cell)),
                              static_cast<int>(std::floor(s.at.z / k_cell))}];
        Level* level = level_near(levels, s.height);
        if (!level) level = &levels.emplace_back();
        level->sum += static_cast<double>(s.height), ++level->count;
    }
    for (int ring = 0; ring < k_rings; ++ring) grow(cells);
    // A corner lies between the cells about it that are on its level.
    auto corner_height = [&](int x, int z, float near) {
        float sum = 0;
        int count = 0;
        for (const int dx : {-1, 0})
            for (const int dz : {-1, 0})
                if (const auto cell = cells.find({x + dx, z + dz}); cell != cells.end())
                    for (const Level& l : cell->second)
                        if (std::fabs(l.middle() - near) < k_storey) sum += l.middle(), ++count;
        return count > 0 ? sum / static_cast<float>(count) : near;
    };
    for (const auto& [square, levels] : cells)
        for (const Level& level : levels) {
            const auto [x, z] = square;
            Vec3 corners[4];
            int k = 0;
            for (const auto& [dx, dz] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}})
                corners[k++] = {static_cast<float>(x + dx) * k_cell,
                                corner_height(x + dx, z + dz, level.middle()),
                                static_cast<float>(z + dz) * k_cell};
            const auto first = static_cast<uint32_t>(city.ground.vertices.size());
            city.ground.vertices.insert(city.ground.vertices.end(), corners, corners + 4);
            for (const uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) city.ground.indices.push_back(first + i);
            city.ground.kinds.insert(city.ground.kinds.end(), 2, Surface::plaza);
            add_triangle(city.scenery, corners[0], corners[1], corners[2], k_floor, SceneryUse::ground);
            add_triangle(city.scenery, corners[0], corners[2], corners[3], k_floor, SceneryUse::ground);
        }
}

void add_table(Scenery& s, const Box& box, float height) {
    const Vec2 low = box.low - Vec2{k_table, k_table}, high = box.high + Vec2{k_table, k_table};
    const HeightAt top = [&](Vec2) { return height; };
    add_top(s, nullptr, {rectangle(to_point(low), to_point(high)), {}}, top, k_table_top,
            SceneryUse::backdrop);
}

}  // namespace

float level_at(const Trajectories& t, Vec2 at) {
    if (t.area.size() == 1) return height_on(t.area[0], at);
    float best = 0, least = 1e30f;
    for (const WalkablePolygon& p : t.area) {
        float far = is_within(p.outer, at) ? 0 : 1e30f;
        for (size_t i = 0, k = p.outer.size() - 1; far > 0 && i < p.outer.size(); k = i++) {
            const Vec2 a = p.outer[k], b = p.outer[i];
            far = std::min(far, length(at - lerp(a, b, closest_on(a, b, at))));
        }
        if (far < least) least = far, best = height_on(p, at);
    }
    return best;
}

City build_hall(const Trajectories& t, const std::string& name) {
    City city;
    city.ground.name = name;
    city.scenery.holds_ground = true;
    Rings area;
    for (const WalkablePolygon& p : t.area) {
        const Rings rings = rings_of_area(p);
        area.insert(area.end(), rings.begin(), rings.end());
    }
    area = unite(area);
    Box box = bounds_of(t);
    const Vec2 margin{k_hall_margin, k_hall_margin};
    box.low = box.low - margin, box.high = box.high + margin;
    const HeightAt level = [&](Vec2 at) { return level_at(t, at); };
    float lowest = 0;
    if (is_level(t)) {
        const float plane = t.area.empty() && t.heights == HeightsOf::ground ? t.sightings[0].height
                            : t.area.empty()                                 ? 0.0f
                                                                             : t.area[0].level;
        const HeightAt at_plane = [&](Vec2) { return plane; },
                       under = [&](Vec2) { return plane - k_plate_thick; };
        const Rings plate{rectangle(to_point(box.low), to_point(box.high))};
        for (const Region& region : regions_of(area))
            add_top(city.scenery, &city.ground, region, at_plane, k_floor, SceneryUse::ground);
        for (const Region& region : regions_of(subtract(plate, area)))
            add_top(city.scenery, &city.ground, region, at_plane, t.area.empty() ? k_floor : k_plate,
                    SceneryUse::ground);
        add_sides(city.scenery, {plate[0], {}}, at_plane, under, k_plate, SceneryUse::backdrop);
        lowest = plane;
    } else {
        for (const WalkablePolygon& p : t.area) {
            const HeightAt height = [&](Vec2 at) { return height_on(p, at); };
            for (const Region& region : regions_of(rings_of_area(p)))
                add_top(city.scenery, &city.ground, region, height, k_floor, SceneryUse::ground);
        }
        add_ground_of_ways(city, t);
        lowest = std::ranges::min(city.ground.vertices, {}, &Vec3::y).y;
    }
    Rings walls;
    if (!area.empty())
        walls =
            subtract(subtract(inset_rings(filled(area), -k_thick), area), openings_in(area, strides_of(t)));
    for (const auto& line : t.walls) add_strip(walls, line, k_line_thick / 2, k_line_thick / 2, false);
    add_walls(city.scenery, unite(walls), level);
    add_table(city.scenery, box, lowest - k_plate_thick);
    city.ground_axes.assign(city.ground.kinds.size(), {1, 0});
    index_city(city);
    list_obstacles(city);
    return city;
}

}  // namespace flaneur
