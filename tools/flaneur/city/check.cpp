#include "tools/flaneur/city/check.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "assets/files/words.h"
#include "sim/base/rng.h"
#include "sim/ground/grid.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {

namespace {

constexpr size_t k_most_places = 5;  // told of each finding

std::string told(Vec3 p, const std::string& why = "") {
    char text[96];
    std::snprintf(text, sizeof text, "%.1f,%.1f,%.1f", static_cast<double>(p.x), static_cast<double>(p.y),
                  static_cast<double>(p.z));
    return why.empty() ? text : text + (" " + why);
}

void add_place(Finding& finding, Vec3 p, const std::string& why = "") {
    if (finding.where.size() < k_most_places) finding.where.push_back(told(p, why));
}

// The facades of each building, and the buildings by place.
struct Houses {
    std::vector<std::vector<const Face*>> walls;
    Grid grid;
};

Houses sort_houses(const City& city) {
    Houses houses;
    houses.walls.resize(city.buildings.size());
    for (const Face& f : city.ground.faces) {
        if (f.kind == FaceKind::facade && f.building < houses.walls.size())
            houses.walls[f.building].push_back(&f);
    }
    houses.grid = make_grid(city.ground.low, city.ground.high, 16);
    fill_grid(houses.grid, static_cast<uint32_t>(houses.walls.size()), [&](uint32_t i, auto visit) {
        if (houses.walls[i].empty()) return;
        Vec2 low = on_ground(houses.walls[i][0]->a), high = low;
        for (const Face* f : houses.walls[i]) {
            for (Vec2 p : {on_ground(f->a), on_ground(f->b)}) {
                low = {std::min(low.x, p.x), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.z, p.z)};
            }
        }
        CellRange r = cells_of_box(houses.grid, low, high);
        for (int z = r.z0; z <= r.z1; ++z) {
            for (int x = r.x0; x <= r.x1; ++x) visit(static_cast<size_t>(z) * houses.grid.width + x);
        }
    });
    return houses;
}

// Whether an odd number of walls lie that way. At slopes a wall may begin above or end below `p`: one way
// alone proves nothing.
bool is_behind(const std::vector<const Face*>& walls, Vec3 p, Vec2 way) {
    int count = 0;
    for (const Face* f : walls) {
        Vec2 a = on_ground(f->a) - on_ground(p), b = on_ground(f->b) - on_ground(p);
        float side_a = cross(way, a), side_b = cross(way, b);
        if ((side_a > 0) == (side_b > 0)) continue;
        float s = side_a / (side_a - side_b);
        if (dot(lerp(a, b, s), way) <= 0) continue;
        count += p.y >= lerp(f->a.y, f->b.y, s) && p.y <= lerp(f->a_top, f->b_top, s);
    }
    return count % 2 == 1;
}

bool is_inside(const Houses& houses, Vec3 p) {
    constexpr Vec2 k_ways[] = {{0.8f, 0.6f}, {-0.6f, 0.8f}, {-0.8f, -0.6f}, {0.6f, -0.8f}};
    CellRange r = cells_of_box(houses.grid, on_ground(p), on_ground(p));
    size_t cell = static_cast<size_t>(r.z0) * houses.grid.width + r.x0;
    for (uint32_t k = houses.grid.first[cell]; k < houses.grid.first[cell + 1]; ++k) {
        const auto& walls = houses.walls[houses.grid.items[k]];
        auto count = std::count_if(std::begin(k_ways), std::end(k_ways),
                                   [&](Vec2 way) { return is_behind(walls, p, way); });
        if (count >= 3) return true;
    }
    return false;
}

Vec3 drawn_corner(const CityMesh& mesh, size_t index) {
    const glm::vec3& p = mesh.vertices[mesh.indices[index]].position;
    return {p.x, p.y, p.z};
}

// What is drawn, as the queries take it.
Ground drawn_ground(const CityMesh& mesh) {
    Ground drawn;
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        if (mesh.seen_from[t / 3] == SeenFrom::far ||
            mesh.vertices[mesh.indices[t]].material == k_material_shade)
            continue;
        Vec3 a = drawn_corner(mesh, t), b = drawn_corner(mesh, t + 1), c = drawn_corner(mesh, t + 2);
        Vec3 normal = cross(b - a, c - a);
        if (normal.y < 0) std::swap(b, c);
        for (Vec3 v : {a, b, c}) {
            drawn.indices.push_back(static_cast<uint32_t>(drawn.vertices.size()));
            drawn.vertices.push_back(v);
        }
        drawn.kinds.push_back(Surface::road);
    }
    index_ground(drawn);
    return drawn;
}

// Where the drawn ground lies against the walked one, as feet look for it; nothing is drawn: far off.
float drawn_off(const Ground& ground, const Ground& drawn, Vec3 p) {
    auto walked = ground_at(ground, p, 0.3f, 0.5f);
    if (!walked) return 1;
    p.y = walked->height;
    auto seen = ground_at(drawn, p, 0.3f, 0.5f);
    return seen ? std::fabs(seen->height - walked->height) : 1;
}

Finding in_percent(std::string name, size_t good, size_t all, double bar) {
    double share = all ? 100 * static_cast<double>(good) / static_cast<double>(all) : 100;
    return {std::move(name), share, bar, true, {}};
}

// The connected pieces of ground: triangles that share an edge, or lie on either side of one no higher than a
// step.
struct Pieces {
    std::vector<uint32_t> parent;
    uint32_t root(uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    }
};

Pieces join_ground(const City& city, float climb) {
    Pieces pieces;
    pieces.parent.resize(city.ground.kinds.size());
    std::iota(pieces.parent.begin(), pieces.parent.end(), 0u);
    struct Edge {
        int64_t a, b;  // its ends on the plane in millimetres
        float height;
        uint32_t triangle;
        bool operator<(const Edge& e) const {
            return std::tie(a, b, height, triangle) < std::tie(e.a, e.b, e.height, e.triangle);
        }
    };
    std::vector<Edge> edges;
    auto key = [](Vec3 p) {
        return static_cast<int64_t>(std::lround(p.x * 1000)) * (int64_t{1} << 32) + std::lround(p.z * 1000);
    };
    for (uint32_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (!is_walked(city.ground.kinds[t])) continue;
        for (uint32_t k = 0; k < 3; ++k) {
            Vec3 a = city.ground.vertices[city.ground.indices[t * 3 + k]],
                 b = city.ground.vertices[city.ground.indices[t * 3 + (k + 1) % 3]];
            int64_t first = key(a), second = key(b);
            edges.push_back({std::min(first, second), std::max(first, second), (a.y + b.y) * 0.5f, t});
        }
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 1; i < edges.size(); ++i) {
        const Edge &e = edges[i - 1], &f = edges[i];
        if (e.a != f.a || e.b != f.b || f.height - e.height > climb) continue;
        uint32_t a = pieces.root(e.triangle), b = pieces.root(f.triangle);
        pieces.parent[std::max(a, b)] = std::min(a, b);
    }
    return pieces;
}

// Whether one gets from place to place, way after way as walkers go them.
bool is_reached(const Navmesh& mesh, NavPoint from, NavPoint to) {
    constexpr int k_most_ways = 200, k_most_corners = 32;
    float left = length(on_ground(to.position - from.position));
    int idle = 0;
    for (int way = 0; way < k_most_ways && idle < 3; ++way) {
        Vec3 corners[k_most_corners];
        int count = find_path(mesh, 0, from, to, corners, k_most_corners);
        if (count == 0) return false;
        Vec3 end = corners[count - 1];
        float now = length(on_ground(to.position - end));
        if (now < 0.1f && std::fabs(end.y - to.position.y) < 1) return true;
        auto next = nearest(mesh, 0, end, {0.5f, 1, 0.5f});
        if (!next) return false;
        idle = now < left ? 0 : idle + 1;
        left = std::min(left, now);
        from = *next;
    }
    return false;
}

}  // namespace

bool is_met(const Finding& f) {
    return (f.at_least ? f.value >= f.bar : f.value <= f.bar) && (!f.most || f.value <= *f.most);
}

Finding check_buildings(const City& city, const Navmesh& mesh) {
    Finding finding{"places inside buildings", 0, 0, false, {}};
    Houses houses = sort_houses(city);
    std::vector<Vec3> corners = navmesh_triangles(mesh);
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
        Vec3 middle = (corners[i] + corners[i + 1] + corners[i + 2]) / 3;
        for (Vec3 p : {middle, lerp(middle, corners[i], 0.8f), lerp(middle, corners[i + 1], 0.8f),
                       lerp(middle, corners[i + 2], 0.8f)}) {
            if (!is_inside(houses, p + Vec3{0, 1, 0})) continue;
            ++finding.value;
            add_place(finding, p);
        }
    }
    return finding;
}

std::vector<Finding> check_drawn(const City& city, const Navmesh& mesh) {
    constexpr uint32_t k_points = 100'000;
    constexpr float k_tolerance = 0.005f, k_beside = 0.01f;
    Ground drawn = drawn_ground(extract_scene(city, {}).city);
    size_t agree = 0;
    Finding places;
    for (uint32_t i = 0; i < k_points; ++i) {
        RandomKey key{2, i, 0, Purpose::spawn};
        Vec3 p =
            random_place(mesh, 0, random_unit(key, 0), random_unit(key, 1), random_unit(key, 2)).position;
        float off = drawn_off(city.ground, drawn, p);
        agree += off <= k_tolerance;
        if (off > k_tolerance) add_place(places, p, "off by " + std::to_string(off));
    }
    Finding walked = in_percent("drawn as walked, %", agree, k_points, 99.9);
    walked.where = std::move(places.where);

    size_t edges = 0, reported = 0;
    Finding missed;
    for (const Face& f : city.ground.faces) {
        if (f.kind != FaceKind::kerb && f.kind != FaceKind::riser) continue;
        Vec2 along = on_ground(f.b) - on_ground(f.a);
        float width = length(along);
        if (width < 0.1f) continue;
        Vec2 out = Vec2{-along.z, along.x} * (k_beside / width);
        float low = (f.a.y + f.b.y) * 0.5f, high = (f.a_top + f.b_top) * 0.5f;
        Vec2 middle = lerp(on_ground(f.a), on_ground(f.b), 0.5f);
        auto before = ground_at(city.ground, at_height(middle + out, low), 0.03f, 0.03f),
             behind = ground_at(city.ground, at_height(middle - out, high), 0.03f, 0.03f);
        bool is_there = before && behind &&
                        drawn_off(city.ground, drawn, at_height(middle + out, low)) <= k_tolerance &&
                        drawn_off(city.ground, drawn, at_height(middle - out, high)) <= k_tolerance;
        ++edges;
        reported += is_there;
        if (!is_there)
            add_place(missed, at_height(middle, high),
                      !before   ? "no lower side"
                      : !behind ? "no upper side"
                                : "drawn elsewhere");
    }
    Finding stepped = in_percent("edges drawn that are stepped, %", reported, edges, 99);
    stepped.where = std::move(missed.where);
    return {walked, stepped};
}

Finding check_paths(const City& city, const Navmesh& mesh) {
    constexpr uint32_t k_pairs = 400;
    Pieces pieces = join_ground(city, NavmeshSettings{}.max_climb);
    // Sidewalks by area.
    std::vector<uint32_t> triangles;
    std::vector<double> before{0};
    for (uint32_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (city.ground.kinds[t] != Surface::sidewalk) continue;
        const GridTriangle& g = city.ground.grid_triangles[t];
        triangles.push_back(t);
        before.push_back(before.back() + std::fabs(cross(on_ground(g.b - g.a), on_ground(g.c - g.a))));
    }
    struct Spot {
        NavPoint place;
        uint32_t piece = 0;
    };
    auto spot = [&](uint32_t number) -> std::optional<Spot> {
        RandomKey key{3, number, 0, Purpose::spawn};
        auto after = std::upper_bound(before.begin(), before.end(),
                                      static_cast<double>(random_unit(key, 0)) * before.back());
        size_t at = std::min(static_cast<size_t>(after - before.begin()) - 1, triangles.size() - 1);
        const GridTriangle& g = city.ground.grid_triangles[triangles[at]];
        float u = random_unit(key, 1), v = random_unit(key, 2);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        auto place = nearest(mesh, 0, g.a + (g.b - g.a) * u + (g.c - g.a) * v, {0.5f, 0.5f, 0.5f});
        if (!place) return std::nullopt;  // too narrow to stand on
        return Spot{*place, pieces.root(triangles[at])};
    };
    size_t pairs = 0, reached = 0;
    Finding missed;
    for (uint32_t i = 0; i < k_pairs * 20 && pairs < k_pairs && !triangles.empty(); ++i) {
        auto from = spot(i * 2), to = spot(i * 2 + 1);
        if (!from || !to || from->piece != to->piece) continue;
        ++pairs;
        bool there = is_reached(mesh, from->place, to->place);
        reached += there;
        if (there) continue;
        const bool is_joined = are_joined(mesh, from->place.polygon, to->place.polygon);
        add_place(missed, from->place.position,
                  (is_joined ? "finds no way to " : "is apart from ") + told(to->place.position));
    }
    Finding finding = in_percent("pairs of places with a way, %", reached, pairs, 95);
    finding.where = std::move(missed.where);
    return finding;
}

Result<void> check_city(const Options& options) {
    if (options.scene.built != BuiltIn::district && options.scene.built != BuiltIn::quayside)
        return Error{"--check is for cities: the built-in " +
                     std::string(k_built_in_names[static_cast<int>(options.scene.built)]) +
                     " has neither houses nor streets to check."};
    if (is_recorded(options.scene))
        return Error{"--check is for crowds that find their ways, and those in " +
                     options.scene.trajectories +
                     " go as they were recorded; flaneur gait --crowd 1 --check looks at their bodies."};
    if (options.scene.walkers == 0) return Error{"--check watches walkers: --walkers 0 leaves it nobody."};
    Result<PartFilePtr> file = open_if_asked(options.json);
    if (!file) return file.error();
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    const City& city = *loaded->city;

    std::vector<Finding> findings{check_buildings(city, *world.navmesh)};
    for (Finding& f : check_drawn(city, *world.navmesh)) findings.push_back(std::move(f));
    findings.push_back(check_paths(city, *world.navmesh));
    Result<std::vector<Finding>> crowd = check_crowd(world, city, options.seconds);
    if (!crowd) return crowd.error();
    for (Finding& f : *crowd) findings.push_back(std::move(f));

    nlohmann::ordered_json json;
    const std::string name = city_name(options.scene);
    json["city"] = name;
    std::printf("%s, with %d walkers for %g s\n", printable(name).c_str(), options.scene.walkers,
                options.seconds);
    std::printf("%-36s %10s %10s\n", "", "found", "bar");
    std::vector<std::string> missed;
    for (const Finding& f : findings) {
        char most[24] = "";
        if (f.most) std::snprintf(most, sizeof most, " .. %.3f", *f.most);
        std::printf("%-36s %10.3f %s%8.3f%s%s\n", f.name.c_str(), f.value, f.at_least ? ">=" : "<=", f.bar,
                    most, is_met(f) ? "" : "  MISSED");
        for (const std::string& place : f.where) std::printf("    at %s\n", place.c_str());
        if (!is_met(f)) missed.push_back(f.name);
        json["findings"].push_back(
            {{"name", f.name}, {"value", f.value}, {"bar", f.bar}, {"met", is_met(f)}, {"where", f.where}});
        if (f.most) json["findings"].back()["most"] = *f.most;
    }
    if (*file) {
        if (Result<void> kept = write_file(std::move(*file), json.dump(2) + "\n"); !kept) return kept;
    }
    if (!missed.empty())
        return Error{name + " misses " + std::to_string(missed.size()) + " of " +
                     std::to_string(findings.size()) + " bars: " + joined(missed) + "."};
    std::printf("%s meets all %zu bars.\n", printable(name).c_str(), findings.size());
    return {};
}

}  // namespace flaneur
