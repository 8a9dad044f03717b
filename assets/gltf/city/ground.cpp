#include "assets/gltf/city/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

#include "sim/ground/grid.h"

namespace flaneur {

namespace {

constexpr float k_steepest = 0.766f;  // cosine of 40 degrees
constexpr float k_climb = 0.35f;      // highest step from one stretch of ground to another, metres
constexpr float k_head = 1.9f;        // headroom, metres
constexpr float k_cell = 4, k_least_cell = 0.1f;  // of grids of triangles, metres
// Pairs of triangles in one cell; each takes some nanoseconds.
constexpr double k_most_meetings = 2e9;
constexpr double k_most_items = 16e6;  // of such a grid: triangles by cells
constexpr float k_least_ground = 25;   // of a city, square metres
constexpr float k_least_piece = 2;     // of what is kept beside the largest, square metres
constexpr float k_slab =
    1.2f;  // what ground is made of may be as thick as this without being a house, metres
constexpr float k_sample = 0.5f;                // along rims, metres
constexpr float k_beside[] = {0.05f, 0.3f};     // how far beyond a rim to look for more ground, metres
constexpr float k_before = 0.1f;                // how far before a wall to look for its foot, metres
constexpr float k_outside[] = {0.5f, 3, 12};    // where there is nothing beyond an edge of the map, metres
constexpr size_t k_most_edges = 64;             // destinations
constexpr float k_between_edges = 6, k_in = 1;  // them from each other, and from the rim, metres

using Corners = std::array<Vec3, 3>;

Corners corners_of(const Scenery& s, size_t t) {
    return {s.vertices[s.indices[3 * t]].position, s.vertices[s.indices[3 * t + 1]].position,
            s.vertices[s.indices[3 * t + 2]].position};
}

// Twice the area along the normal.
Vec3 normal_of(const Corners& c) { return cross(c[1] - c[0], c[2] - c[0]); }

// Triangles by what they cover of the ground plane.
struct Columns {
    const Scenery& scenery;
    Grid grid;
};

// How many cells of such an edge the triangles touch, at most.
double cells_touched(const Scenery& s, float cell) {
    double touched = 0;
    for (size_t t = 0; 3 * t < s.indices.size(); ++t) {
        Corners c = corners_of(s, t);
        auto [x0, x1] = std::minmax({c[0].x, c[1].x, c[2].x});
        auto [z0, z1] = std::minmax({c[0].z, c[1].z, c[2].z});
        touched += (static_cast<double>((x1 - x0) / cell) + 1) * (static_cast<double>((z1 - z0) / cell) + 1);
    }
    return touched;
}

Error crowded() {
    return Error{
        "has too many triangles that lie over each other; leave out what is no city, or give a smaller "
        "--scale"};
}

Result<Columns> make_columns(const Scenery& s) {
    Vec2 low{1e30f, 1e30f}, high{-1e30f, -1e30f};
    for (uint32_t i : s.indices) {
        Vec3 p = s.vertices[i].position;
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    // City's own grids have cells as large as this.
    float cell = make_grid(low, high, k_cell).cell;
    if (cells_touched(s, cell) > k_most_items) return crowded();
    // Small things lie close: smaller cells where that pays.
    size_t count = s.indices.size() / 3;
    while (cell > k_least_cell &&
           cells_touched(s, cell / 2) < k_most_items / 4 + 2 * static_cast<double>(count))
        cell /= 2;
    Columns out{s, make_grid(low, high, cell)};
    fill_grid(out.grid, static_cast<uint32_t>(count), [&](uint32_t t, auto visit) {
        Corners c = corners_of(s, t);
        if (normal_of(c).y < 0) std::swap(c[1], c[2]);
        for_cells_of_triangle(out.grid, on_ground(c[0]), on_ground(c[1]), on_ground(c[2]), visit);
    });
    // Each asks about all that are in its cell.
    double meetings = 0;
    for (size_t i = 0; i + 1 < out.grid.first.size(); ++i) {
        double there = out.grid.first[i + 1] - out.grid.first[i];
        meetings += there * there;
    }
    if (meetings > k_most_meetings) return crowded();
    return out;
}

// Calls visit(triangle, height) for those above and below a place.
template <class Visit>
void for_column(const Columns& columns, Vec2 at, Visit visit) {
    const Grid& grid = columns.grid;
    Vec2 offset = at - grid.origin;
    if (!(offset.x >= 0 && offset.z >= 0)) return;
    int x = static_cast<int>(offset.x / grid.cell), z = static_cast<int>(offset.z / grid.cell);
    if (x >= grid.width || z >= grid.height) return;
    size_t cell = static_cast<size_t>(z) * static_cast<size_t>(grid.width) + static_cast<size_t>(x);
    for (uint32_t i = grid.first[cell]; i < grid.first[cell + 1]; ++i) {
        Corners c = corners_of(columns.scenery, grid.items[i]);
        Vec2 a = on_ground(c[0]), b = on_ground(c[1]), d = on_ground(c[2]);
        float whole = cross(b - a, d - a);
        if (!(std::fabs(whole) > 1e-9f)) continue;
        float v = cross(at - a, d - a) / whole, w = cross(b - a, at - a) / whole, u = 1 - v - w;
        if (u < 0 || v < 0 || w < 0) continue;
        visit(grid.items[i], c[0].y * u + c[1].y * v + c[2].y * w);
    }
}

bool has_headroom(const Columns& columns, const std::vector<Hint>& hints, const Corners& c) {
    Vec3 middle = (c[0] + c[1] + c[2]) / 3;
    auto is_free = [&](Vec3 p) {
        bool covered = false;
        for_column(columns, on_ground(p), [&](uint32_t t, float height) {
            covered |= hints[t].is_solid && height > p.y + k_climb && height < p.y + k_head;
        });
        return !covered;
    };
    return is_free(middle) || is_free(lerp(middle, c[0], 0.7f)) || is_free(lerp(middle, c[1], 0.7f)) ||
           is_free(lerp(middle, c[2], 0.7f));
}

// Sets of triangles, each known by one of them.
struct Sets {
    std::vector<uint32_t> above;
    explicit Sets(size_t count) : above(count) { std::iota(above.begin(), above.end(), 0u); }
    uint32_t root(uint32_t t) {
        while (above[t] != t) t = above[t] = above[above[t]];
        return t;
    }
    void join(uint32_t a, uint32_t b) {
        a = root(a), b = root(b);
        above[std::max(a, b)] = std::min(a, b);
    }
};

// Ground while it is being found. Vertices at one place have one number.
struct SampledGround {
    std::vector<uint8_t> is_ground, is_main;  // by triangle; main: of the largest stretch
    std::vector<uint32_t> places;             // by vertex
};

using Key = std::pair<uint32_t, uint32_t>;  // an edge's places, rising

void find_places(const Scenery& s, SampledGround& field) {
    std::vector<uint32_t> order(s.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    auto key = [&](uint32_t v) {
        Vec3 p = s.vertices[v].position;
        return std::tuple(p.x, p.y, p.z, v);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    field.places.resize(order.size());
    uint32_t place = 0;
    for (size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && !(s.vertices[order[i]].position == s.vertices[order[i - 1]].position)) ++place;
        field.places[order[i]] = place;
    }
}

// Every edge of the ground with a triangle that has it, sorted; a rim's edge is there once.
struct SampleEdge {
    Key key;
    uint32_t triangle;
    int side;
};
std::vector<SampleEdge> edges_of(const Scenery& s, const SampledGround& field) {
    std::vector<SampleEdge> edges;
    for (uint32_t t = 0; t < field.is_ground.size(); ++t) {
        if (!field.is_ground[t]) continue;
        for (int k = 0; k < 3; ++k) {
            uint32_t a = field.places[s.indices[3 * t + size_t(k)]],
                     b = field.places[s.indices[3 * t + size_t((k + 1) % 3)]];
            edges.push_back({{std::min(a, b), std::max(a, b)}, t, k});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const SampleEdge& a, const SampleEdge& b) {
        return std::tie(a.key, a.triangle, a.side) < std::tie(b.key, b.triangle, b.side);
    });
    return edges;
}

// Calls visit(edge) for edges that one triangle alone has, and join(a, b) for neighbours.
template <class Rim, class Join>
void for_edges(const std::vector<SampleEdge>& edges, Rim rim, Join join) {
    for (size_t i = 0; i < edges.size();) {
        size_t end = i + 1;
        while (end < edges.size() && edges[end].key == edges[i].key) join(edges[i], edges[end++]);
        if (end == i + 1) rim(edges[i]);
        i = end;
    }
}

// Calls visit(point on the edge, unit direction out of its triangle) along an edge.
template <class Visit>
void for_samples(const Scenery& s, const SampleEdge& edge, Visit visit) {
    Corners c = corners_of(s, edge.triangle);
    Vec3 a = c[size_t(edge.side)], b = c[size_t((edge.side + 1) % 3)];
    Vec2 along = on_ground(b - a);
    Vec2 out = normalize_or(Vec2{-along.z, along.x}, {1, 0});
    int count = static_cast<int>(clamp(length(along) / k_sample, 1, 64));
    for (int i = 0; i < count; ++i)
        visit(lerp(a, b, (static_cast<float>(i) + 0.5f) / static_cast<float>(count)), out);
}

// Takes away stretches of ground to which nothing leads and from which one could only jump down, and small
// ones. Gives the largest one's area.
double keep_reachable(const Columns& columns, SampledGround& field) {
    const Scenery& s = columns.scenery;
    Sets sets(field.is_ground.size());
    std::vector<SampleEdge> edges = edges_of(s, field), rims;
    for_edges(
        edges, [&](const SampleEdge& e) { rims.push_back(e); },
        [&](const SampleEdge& a, const SampleEdge& b) { sets.join(a.triangle, b.triangle); });
    struct Drop {
        uint32_t from, to;
    };
    std::vector<Drop> drops;
    for (const SampleEdge& rim : rims)
        for_samples(s, rim, [&](Vec3 p, Vec2 out) {
            for (float beyond : k_beside) {
                float below = -1e30f;
                uint32_t lower = ~0u;
                bool is_level = false;
                for_column(columns, on_ground(p) + out * beyond, [&](uint32_t t, float height) {
                    if (!field.is_ground[t] || t == rim.triangle) return;
                    if (std::fabs(height - p.y) <= k_climb) {
                        sets.join(rim.triangle, t);
                        is_level = true;
                    } else if (height < p.y && height > below) {
                        below = height, lower = t;
                    }
                });
                if (!is_level && lower != ~0u) drops.push_back({rim.triangle, lower});
            }
        });
    std::vector<double> area(sets.above.size());
    uint32_t largest = 0;
    for (uint32_t t = 0; t < area.size(); ++t)
        if (field.is_ground[t])
            area[sets.root(t)] += static_cast<double>(length(normal_of(corners_of(s, t)))) / 2;
    for (uint32_t t = 0; t < area.size(); ++t)
        if (area[t] > area[largest]) largest = t;
    std::vector<uint8_t> is_high(area.size(), 0);
    field.is_main.assign(area.size(), 0);
    for (const Drop& d : drops)
        if (sets.root(d.from) != sets.root(d.to)) is_high[sets.root(d.from)] = 1;
    for (uint32_t t = 0; t < area.size(); ++t) {
        uint32_t root = sets.root(t);
        if (root != largest && (is_high[root] || area[root] < static_cast<double>(k_least_piece)))
            field.is_ground[t] = 0;
        field.is_main[t] = field.is_ground[t] && root == largest;
    }
    return area[largest];
}

// Whether most of what there is besides ground lies below it: a house with a flat roof, not a city.
bool stands_on_top(const Scenery& s, const SampledGround& field) {
    double sum = 0, weight = 0, above = 0, below = 0;
    for (size_t t = 0; t < field.is_ground.size(); ++t) {
        if (!field.is_ground[t]) continue;
        Corners c = corners_of(s, t);
        double size = static_cast<double>(length(normal_of(c)));
        sum += size * static_cast<double>((c[0].y + c[1].y + c[2].y) / 3);
        weight += size;
    }
    float level = static_cast<float>(sum / weight);
    for (size_t t = 0; t < field.is_ground.size(); ++t) {
        Corners c = corners_of(s, t);
        Vec3 n = normal_of(c);
        float size = length(n), y = (c[0].y + c[1].y + c[2].y) / 3;
        if (field.is_ground[t] || std::fabs(n.y) > k_steepest * size) continue;
        if (y > level) above += static_cast<double>(size);
        if (y < level - k_slab) below += static_cast<double>(size);
    }
    return below > 2 * above && below > weight / 2;
}

void fill_ground(City& city, const std::vector<Hint>& hints, const SampledGround& field) {
    const Scenery& s = city.scenery;
    std::vector<uint32_t> numbers(field.places.size(), ~0u);
    for (uint32_t t = 0; t < field.is_ground.size(); ++t) {
        if (!field.is_ground[t]) continue;
        for (size_t k = 0; k < 3; ++k) {
            uint32_t v = s.indices[3 * t + k], place = field.places[v];
            if (numbers[place] == ~0u) {
                numbers[place] = static_cast<uint32_t>(city.ground.vertices.size());
                city.ground.vertices.push_back(s.vertices[v].position);
            }
            city.ground.indices.push_back(numbers[place]);
        }
        city.ground.kinds.push_back(hints[t].kind);
        city.ground_axes.push_back({1, 0});
    }
}

// How high a steep triangle reaches in its middle.
float top_in_middle(const Corners& c, Vec2 along) {
    Vec3 middle = (c[0] + c[1] + c[2]) / 3;
    float at = dot(on_ground(middle), along), top = middle.y;
    for (size_t k = 0; k < 3; ++k) {
        Vec3 a = c[k], b = c[(k + 1) % 3];
        float from = dot(on_ground(a), along), to = dot(on_ground(b), along);
        float t = (at - from) / (to - from);
        if (t >= 0 && t <= 1) top = std::max(top, lerp(a.y, b.y, t));
    }
    return top;
}

// What stops walkers, all but ground, leaves, and what is no higher than a step above all ground before it.
void find_walls(const Columns& columns, const std::vector<Hint>& hints, const SampledGround& field,
                std::vector<SceneryUse>& uses) {
    const Scenery& s = columns.scenery;
    uses.assign(field.is_ground.size(), SceneryUse::ground);
    for (uint32_t t = 0; t < uses.size(); ++t) {
        if (!hints[t].is_bare && !hints[t].is_solid) uses[t] = SceneryUse::backdrop;
        if (field.is_ground[t] || !hints[t].is_solid) continue;
        Corners c = corners_of(s, t);
        Vec2 out = normalize_or(on_ground(normal_of(c)), {1, 0});
        float top = top_in_middle(c, {-out.z, out.x});
        bool is_step = false, is_wall = false;
        for_column(columns, on_ground((c[0] + c[1] + c[2]) / 3) + out * k_before,
                   [&](uint32_t other, float height) {
                       if (!field.is_ground[other]) return;
                       (top <= height + k_climb ? is_step : is_wall) = true;
                   });
        if (is_wall || !is_step) uses[t] = SceneryUse::solid;
    }
}

// Where the largest stretch of ground ends and nothing at all lies beyond: places to come from and go to.
void add_edges(const Columns& columns, const SampledGround& field, City& city) {
    std::vector<Destination> found;
    auto is_empty = [&](Vec2 at) {
        bool empty = true;
        for_column(columns, at,
                   [&](uint32_t t, float) { empty &= columns.scenery.uses[t] == SceneryUse::backdrop; });
        return empty;
    };
    for_edges(
        edges_of(columns.scenery, field),
        [&](const SampleEdge& rim) {
            if (!field.is_main[rim.triangle]) return;
            for_samples(columns.scenery, rim, [&](Vec3 p, Vec2 out) {
                for (float beyond : k_outside)
                    if (!is_empty(on_ground(p) + out * beyond)) return;
                Vec2 in = on_ground(p) - out * k_in;
                for_column(columns, in, [&](uint32_t t, float height) {
                    if (field.is_main[t] && std::fabs(height - p.y) <= k_climb)
                        found.push_back({DestinationKind::edge, at_height(in, height), out});
                });
            });
        },
        [](const SampleEdge&, const SampleEdge&) {});
    std::vector<Destination> kept(k_most_edges + 1);
    for (float apart = k_between_edges; kept.size() > k_most_edges; apart *= 1.5f) {
        kept.clear();
        for (const Destination& d : found) {
            bool is_near = std::any_of(kept.begin(), kept.end(), [&](const Destination& k) {
                return length(d.position - k.position) < apart;
            });
            if (!is_near) kept.push_back(d);
            if (kept.size() > k_most_edges) break;
        }
    }
    city.destinations = std::move(kept);
}

}  // namespace

Result<void> find_ground(City& city, const std::vector<Hint>& hints) {
    Scenery& s = city.scenery;
    auto columns = make_columns(s);
    if (!columns) return columns.error();
    SampledGround field;
    field.is_ground.assign(hints.size(), 0);
    for (size_t t = 0; t < hints.size(); ++t) {
        Corners c = corners_of(s, t);
        Vec3 n = normal_of(c);
        float least = k_steepest * length(n);
        field.is_ground[t] = hints[t].is_bare && n.y >= least && has_headroom(*columns, hints, c);
    }
    find_places(s, field);
    double area = keep_reachable(*columns, field);
    if (area < static_cast<double>(k_least_ground))
        return Error{
            "has " + std::to_string(static_cast<int>(area)) +
            " m2 of connected ground to walk on (level within 40 degrees, with headroom), and a city "
            "needs 25; it is a single thing, or give --scale if its unit is not the metre"};
    if (stands_on_top(s, field))
        return Error{
            "has nothing to walk on but its top: it is a single thing, no city; put it on some ground"};
    fill_ground(city, hints, field);
    find_walls(*columns, hints, field, s.uses);
    add_edges(*columns, field, city);
    return {};
}

}  // namespace flaneur
