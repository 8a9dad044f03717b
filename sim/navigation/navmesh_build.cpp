// Puts tiles together and prepares what the queries look up.
#include <recastnavigation/DetourAlloc.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <numeric>
#include <optional>

#include "sim/base/parallel_for.h"
#include "sim/ground/grid.h"
#include "sim/navigation/navmesh_data.h"

namespace flaneur {

static constexpr int k_most_nodes = 16;        // of searches that are not made with Detour
static constexpr double k_least_island = 300;  // square metres that are worth walking about in

void NavmeshDelete::operator()(Navmesh* m) const { delete m; }

static bool is_place(uint8_t area) {
    return area == area_of(Surface::sidewalk) || area == area_of(Surface::plaza) ||
           area == area_of(Surface::path) || area == area_of(Surface::crossing) ||
           area == area_of(Surface::steps);
}

static double triangle_area(Vec3 a, Vec3 b, Vec3 c) {
    return 0.5 *
           std::fabs(static_cast<double>(cross(on_ground(b) - on_ground(a), on_ground(c) - on_ground(a))));
}

// For each polygon the first of those that it is joined to.
static std::vector<uint32_t> find_joined(const Gates& gates, By by) {
    std::vector<uint32_t> parent(gates.steps.size());
    std::iota(parent.begin(), parent.end(), 0u);
    auto root = [&](uint32_t i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Gate& gate : gates.gates) {
        if (by == By::wheels && (gates.steps[gate.polygons[0]] || gates.steps[gate.polygons[1]])) continue;
        const uint32_t a = root(gate.polygons[0]), b = root(gate.polygons[1]);
        parent[std::max(a, b)] = std::min(a, b);
    }
    for (uint32_t i = 0; i < parent.size(); ++i) parent[i] = root(i);
    return parent;
}

// Numbers the connected pieces by falling area; `areas` receives the area of each.
static void find_islands(Navmesh& m, std::vector<double>& areas) {
    const std::vector<uint32_t> first = find_joined(m.gates, By::feet);
    m.wheel_islands = find_joined(m.gates, By::wheels);
    std::vector<double> area(first.size(), 0.0);
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t reference) {
        const dtPoly& polygon = tile.polys[p];
        uint32_t number = polygon_number(m, reference);
        for (int i = 2; i < polygon.vertCount; ++i) {
            area[number] +=
                triangle_area(tile_vertex(tile, polygon.verts[0]), tile_vertex(tile, polygon.verts[i - 1]),
                              tile_vertex(tile, polygon.verts[i]));
        }
    });
    std::vector<uint32_t> roots;
    for (uint32_t i = 0; i < first.size(); ++i) {
        if (first[i] == i) {
            roots.push_back(i);
        } else {
            area[first[i]] += area[i];
        }
    }
    std::sort(roots.begin(), roots.end(),
              [&](uint32_t a, uint32_t b) { return area[a] != area[b] ? area[a] > area[b] : a < b; });
    std::vector<uint32_t> number_of_root(first.size(), 0);
    for (uint32_t r = 0; r < roots.size(); ++r) {
        number_of_root[roots[r]] = r;
        areas.push_back(area[roots[r]]);
    }
    for (uint32_t i = 0; i < first.size(); ++i) m.islands[i] = number_of_root[first[i]];
}

// Cuts the places into triangles, sorted by cell, with their areas summed up.
static void find_places(Navmesh& m, Vec2 low, Vec2 high, const std::vector<double>& island_areas) {
    std::vector<PlacePiece> places, others;
    double least = std::min(k_least_island, island_areas.front());
    while (m.worthy_islands < island_areas.size() && island_areas[m.worthy_islands] >= least)
        ++m.worthy_islands;
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t reference) {
        const dtPoly& polygon = tile.polys[p];
        if (m.islands[polygon_number(m, reference)] >= m.worthy_islands) return;
        Vec3 a = tile_vertex(tile, polygon.verts[0]);
        for (int i = 2; i < polygon.vertCount; ++i) {
            Vec3 b = tile_vertex(tile, polygon.verts[i - 1]), c = tile_vertex(tile, polygon.verts[i]);
            (is_place(polygon.getArea()) ? places : others).push_back({a, b, c, reference});
        }
    });
    if (places.empty()) places.swap(others);  // roads or grass alone

    m.place_grid = make_weighted_grid(
        low, high, m.settings.tile, places.size(),
        [&](uint32_t i) { return on_ground(places[i].a + places[i].b + places[i].c) / 3; },
        [&](uint32_t i) { return triangle_area(places[i].a, places[i].b, places[i].c); });
    for (uint32_t i : m.place_grid.grid.items) m.places.push_back(places[i]);
}

// Whether the mesh goes on beyond a border: Recast leaves seams that join nothing, where it simplifies the
// outlines of neighbours in different ways. Beyond all else there is room for a body.
static bool is_seam(const Navmesh& m, const BorderLine& line) {
    constexpr float k_beyond = 0.015f, k_beside = 0.005f;  // metres
    const Vec3 out = at_height(inward_of(line) * -k_beyond, 0);
    for (const float share : {0.25f, 0.5f, 0.75f}) {
        const Vec3 there = lerp(line.a, line.b, share) + out;
        const auto place = nearest(m, 0, there, {k_beside, 0.3f, k_beside});
        if (!place || length(on_ground(place->position - there)) > k_beside) return false;
    }
    return true;
}

static void find_borders(Navmesh& m, Vec2 low, Vec2 high) {
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t reference) {
        constexpr int k_most = 64;
        float ends[k_most][6];
        int count = 0;
        m.queries[0]->getPolyWallSegments(reference, &m.filter, ends[0], nullptr, &count, k_most);
        const dtPoly& polygon = tile.polys[p];
        Vec3 centre;
        for (int i = 0; i < polygon.vertCount; ++i) centre += tile_vertex(tile, polygon.verts[i]);
        centre = centre / static_cast<float>(polygon.vertCount);
        for (int i = 0; i < count; ++i) {
            BorderLine line{{ends[i][0], ends[i][1], ends[i][2]}, {ends[i][3], ends[i][4], ends[i][5]}};
            Vec2 along = on_ground(line.b) - on_ground(line.a);
            if (length_squared(along) < 1e-8f) continue;
            if (cross(along, on_ground(centre) - on_ground(line.a)) < 0) std::swap(line.a, line.b);
            if (!is_seam(m, line)) m.borders.push_back(line);
        }
    });
    m.border_grid = make_grid(low, high, 3);
    fill_grid(m.border_grid, static_cast<uint32_t>(m.borders.size()), [&](uint32_t i, auto visit) {
        for_cells_of_segment(m.border_grid, on_ground(m.borders[i].a), on_ground(m.borders[i].b), visit);
    });
    m.cell_borders.reserve(m.border_grid.items.size());
    for (uint32_t i : m.border_grid.items) {
        const Vec3 a = m.borders[i].a, along = m.borders[i].b - a;
        m.cell_borders.push_back({a, along, 1 / length_squared(on_ground(along)), i});
    }
}

static void find_steps(Navmesh& m, Vec2 low, Vec2 high) {
    constexpr float k_square = 4;
    m.step_grid = make_grid(low, high, k_square);
    m.near_steps.assign(static_cast<size_t>(m.step_grid.width) * m.step_grid.height, 0);
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t) {
        const dtPoly& polygon = tile.polys[p];
        if (polygon.getArea() != area_of(Surface::steps)) return;
        Vec2 least = on_ground(tile_vertex(tile, polygon.verts[0])), most = least;
        for (int i = 1; i < polygon.vertCount; ++i) {
            const Vec2 corner = on_ground(tile_vertex(tile, polygon.verts[i]));
            least = {std::min(least.x, corner.x), std::min(least.z, corner.z)};
            most = {std::max(most.x, corner.x), std::max(most.z, corner.z)};
        }
        constexpr Vec2 k_around{k_steps_ahead, k_steps_ahead};
        const CellRange r = cells_of_box(m.step_grid, least - k_around, most + k_around);
        for (int z = r.z0; z <= r.z1; ++z)
            for (int x = r.x0; x <= r.x1; ++x)
                m.near_steps[static_cast<size_t>(z) * m.step_grid.width + x] = 1;
    });
}

// What people rather walk on: sidewalks, then crossings, pedestrian streets, grass, and roads last.
static void set_costs(dtQueryFilter& filter) {
    for (int a = 0; a < DT_MAX_AREAS; ++a) filter.setAreaCost(a, 1);
    filter.setAreaCost(area_of(Surface::crossing), 1.2f);
    filter.setAreaCost(area_of(Surface::plaza), 1.3f);
    filter.setAreaCost(area_of(Surface::grass), 3);
    filter.setAreaCost(area_of(Surface::road), 25);
}

// So that a filter can leave them out.
static constexpr unsigned short k_steps_flag = 2;
static void mark_steps(dtNavMesh& mesh) {
    for_polygons(mesh, [&](const dtMeshTile& tile, int p, uint32_t reference) {
        if (tile.polys[p].getArea() == area_of(Surface::steps))
            mesh.setPolyFlags(reference, static_cast<unsigned short>(tile.polys[p].flags | k_steps_flag));
    });
}

// What find_path() looks up.
static void find_ways(Navmesh& m, int threads) {
    for_polygons(*m.mesh,
                 [&](const dtMeshTile&, int, uint32_t reference) { m.references.push_back(reference); });
    m.gates = find_gates(m);
    m.shortcuts = find_shortcuts(m.gates, threads);
    const std::vector<uint8_t>& steps = m.gates.steps;
    const bool any_steps = std::find(steps.begin(), steps.end(), 1) != steps.end();
    WorkersPtr workers = make_workers(std::min(threads, 2));
    parallel_for(*workers, any_steps ? 2 : 1, 1, [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k)
            (k ? m.wheel_costs : m.costs) = find_costs(m.gates, m.shortcuts, k == 1);
    });
}

static float tile_edge(const NavmeshSettings& s) {
    return std::max(1.0f, std::floor(s.tile / s.cell + 0.5f)) * s.cell;
}

// Detour's references have 22 bits for the tile and for the polygon in it, and the fullest tile says how many
// of them go to polygons. Many small tiles leave too few; in larger ones the full and the empty even out.
// Ground that small tiles are enough for keeps them.
static NavmeshSettings suited(const Ground& ground, NavmeshSettings settings) {
    constexpr float k_most_tiles = 8192, k_few_tiles = 2048;
    Vec2 size = ground.high - ground.low;
    auto tiles = [&] { return size.x * size.z / (settings.tile * settings.tile); };
    if (tiles() <= k_most_tiles) return settings;
    while (tiles() > k_few_tiles) settings.tile *= 2;
    return settings;
}

// Owns what it takes out of `tiles`.
static Result<NavmeshPtr> join_tiles(const Ground& ground, const NavmeshSettings& settings,
                                     std::vector<TileData>& tiles, int threads) {
    NavmeshPtr m(new Navmesh);
    m->settings = settings;
    int most_polygons = 1, used_tiles = 0;
    std::string failure;
    for (size_t t = 0; t < tiles.size(); ++t) {
        if (tiles[t].bytes) {
            ++used_tiles;
            most_polygons =
                std::max(most_polygons, reinterpret_cast<const dtMeshHeader*>(tiles[t].bytes)->polyCount);
        }
        if (tiles[t].failure && failure.empty()) {
            failure = "tile " + std::to_string(t) + " of the navigation mesh failed: " + tiles[t].failure;
        }
    }
    if (failure.empty() && used_tiles == 0) {
        failure = "'" + ground.name +
                  "' has no ground that a walker can stand on: it is too narrow, small or steep.";
    }
    dtNavMeshParams p{};
    p.orig[0] = ground.low.x;
    p.orig[2] = ground.low.z;
    p.tileWidth = p.tileHeight = tile_edge(settings);
    p.maxTiles = used_tiles;
    p.maxPolys = most_polygons;
    m->mesh.reset(dtAllocNavMesh());
    if (failure.empty() && dtStatusFailed(m->mesh->init(&p))) {
        failure = "'" + ground.name + "' is too large for one navigation mesh: cut out a smaller area";
    }
    for (TileData& t : tiles) {
        if (!t.bytes) continue;
        if (!failure.empty() ||
            dtStatusFailed(m->mesh->addTile(t.bytes, t.size, DT_TILE_FREE_DATA, 0, nullptr))) {
            dtFree(t.bytes);
            if (failure.empty()) failure = "a tile of the navigation mesh could not be added";
        }
        t.bytes = nullptr;
    }
    if (!failure.empty()) return Error{failure};

    uint32_t polygons = 0;
    for (int t = 0; t < m->mesh->getMaxTiles(); ++t) {
        m->first_polygon.push_back(polygons);
        const dtMeshTile* added = static_cast<const dtNavMesh&>(*m->mesh).getTile(t);
        if (added->header) polygons += static_cast<uint32_t>(added->header->polyCount);
    }
    m->islands.resize(polygons);
    set_costs(m->filter);
    set_costs(m->wheels);
    mark_steps(*m->mesh);
    m->wheels.setExcludeFlags(k_steps_flag);
    find_ways(*m, threads);
    prepare_queries(*m, threads);
    std::vector<double> island_areas;
    find_islands(*m, island_areas);
    find_places(*m, ground.low, ground.high, island_areas);
    find_borders(*m, ground.low, ground.high);
    find_steps(*m, ground.low, ground.high);
    return m;
}

namespace {
// The parts of the ground by tile.
struct TileGrids {
    Grid triangles, walls, solids, obstacles;
};
}  // namespace

static std::span<const uint32_t> items_of(const Grid& grid, size_t cell) {
    return {grid.items.data() + grid.first[cell], grid.first[cell + 1] - grid.first[cell]};
}

static TileParts parts_of(const TileGrids& grids, size_t tile) {
    return {items_of(grids.triangles, tile), items_of(grids.walls, tile), items_of(grids.solids, tile),
            items_of(grids.obstacles, tile)};
}

static TileGrids sort_by_tile(const Ground& ground, const NavmeshSettings& settings) {
    TileGrids grids;
    float tile = tile_edge(settings);
    Vec2 rim{tile_rim(settings), tile_rim(settings)}, size = ground.high - ground.low;
    Grid& triangles = grids.triangles;
    triangles.origin = ground.low;
    triangles.cell = tile;
    triangles.width = static_cast<int>(size.x / tile) + 1;
    triangles.height = static_cast<int>(size.z / tile) + 1;
    triangles.first.assign(static_cast<size_t>(triangles.width) * triangles.height + 1, 0);
    grids.walls = grids.solids = grids.obstacles = triangles;
    auto cells_of = [&](std::initializer_list<Vec3> corners, auto visit) {
        Vec2 low = on_ground(*corners.begin()), high = low;
        for (Vec3 c : corners) {
            low = {std::min(low.x, c.x), std::min(low.z, c.z)};
            high = {std::max(high.x, c.x), std::max(high.z, c.z)};
        }
        CellRange r = cells_of_box(triangles, low - rim, high + rim);
        for (int z = r.z0; z <= r.z1; ++z) {
            for (int x = r.x0; x <= r.x1; ++x) visit(static_cast<size_t>(z) * triangles.width + x);
        }
    };
    fill_grid(triangles, static_cast<uint32_t>(ground.kinds.size()), [&](uint32_t i, auto visit) {
        const uint32_t* index = &ground.indices[i * 3];
        cells_of({ground.vertices[index[0]], ground.vertices[index[1]], ground.vertices[index[2]]}, visit);
    });
    fill_grid(grids.walls, static_cast<uint32_t>(ground.faces.size()), [&](uint32_t i, auto visit) {
        const Face& f = ground.faces[i];
        if (f.kind == FaceKind::facade || f.kind == FaceKind::garden_wall) cells_of({f.a, f.b}, visit);
    });
    fill_grid(grids.solids, static_cast<uint32_t>(ground.solids.size()), [&](uint32_t i, auto visit) {
        const Solid& s = ground.solids[i];
        cells_of({s.a, s.b, s.c}, visit);
    });
    fill_grid(grids.obstacles, static_cast<uint32_t>(ground.obstacles.size()), [&](uint32_t i, auto visit) {
        const Obstacle& o = ground.obstacles[i];
        float reach = o.half.x + o.half.z + 2 * settings.agent_radius;
        cells_of({o.position - Vec3{reach, 0, reach}, o.position + Vec3{reach, 0, reach}}, visit);
    });
    return grids;
}

Result<NavmeshPtr> build_navmesh(const Ground& ground, const NavmeshSettings& wanted, int threads,
                                 const std::function<bool(float)>& progress) {
    const NavmeshSettings settings = suited(ground, wanted);
    TileGrids grids = sort_by_tile(ground, settings);
    size_t width = static_cast<size_t>(grids.triangles.width), tile_count = grids.triangles.first.size() - 1;
    std::vector<TileData> tiles(tile_count);
    std::atomic<size_t> done = 0;
    std::atomic<bool> given_up = false;
    WorkersPtr workers = make_workers(threads);
    parallel_for(*workers, tile_count, 1, [&](size_t begin, size_t end, int thread) {
        for (size_t t = begin; t < end && !given_up; ++t) {
            tiles[t] = build_tile(ground, settings, static_cast<int>(t % width), static_cast<int>(t / width),
                                  parts_of(grids, t));
            size_t so_far = ++done;
            if (progress && thread == 0 &&
                !progress(static_cast<float>(so_far) / static_cast<float>(tile_count)))
                given_up = true;
        }
    });
    if (given_up) {
        for (TileData& t : tiles) dtFree(t.bytes);
        return Error{"the navigation mesh of '" + ground.name + "' was given up"};
    }
    auto mesh = join_tiles(ground, settings, tiles, thread_count(*workers));
    if (progress) progress(1);
    return mesh;
}

std::string navmesh_bytes(const Navmesh& m) {
    std::string bytes;
    for (int t = 0; t < m.mesh->getMaxTiles(); ++t) {
        const dtMeshTile* tile = static_cast<const dtNavMesh&>(*m.mesh).getTile(t);
        if (!tile->header) continue;
        uint64_t size = static_cast<uint64_t>(tile->dataSize);
        bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
        bytes.append(reinterpret_cast<const char*>(tile->data), tile->dataSize);
    }
    return bytes;
}

// Takes bytes apart; none: they are damaged.
static std::optional<std::vector<TileData>> tiles_of(std::string_view bytes) {
    std::vector<TileData> tiles;
    bool whole = true;
    while (!bytes.empty() && whole) {
        uint64_t size = 0;
        whole = bytes.size() >= sizeof size;
        if (!whole) break;
        std::memcpy(&size, bytes.data(), sizeof size);
        bytes.remove_prefix(sizeof size);
        whole = size >= sizeof(dtMeshHeader) && size <= bytes.size();
        if (!whole) break;
        TileData tile;
        tile.size = static_cast<int>(size);
        tile.bytes = static_cast<unsigned char*>(dtAlloc(size, DT_ALLOC_PERM));
        std::memcpy(tile.bytes, bytes.data(), size);
        bytes.remove_prefix(size);
        tiles.push_back(tile);
    }
    if (whole) return tiles;
    for (TileData& t : tiles) dtFree(t.bytes);
    return std::nullopt;
}

static Error damaged(const Ground& ground) {
    return Error{"what was kept of the navigation mesh of '" + ground.name + "' is damaged"};
}

Result<NavmeshPtr> restore_navmesh(const Ground& ground, const NavmeshSettings& wanted,
                                   std::string_view bytes, int threads) {
    auto tiles = tiles_of(bytes);
    if (!tiles) return damaged(ground);
    WorkersPtr workers = make_workers(threads);
    return join_tiles(ground, suited(ground, wanted), *tiles, thread_count(*workers));
}

Result<NavmeshPtr> rebuild_navmesh(const Ground& ground, const NavmeshSettings& wanted,
                                   std::string_view bytes, Vec2 low, Vec2 high,
                                   std::span<const Rectangle> changed, int threads) {
    if (ground.low != low || ground.high != high) return build_navmesh(ground, wanted, threads);
    auto kept = tiles_of(bytes);
    if (!kept) return damaged(ground);
    const NavmeshSettings settings = suited(ground, wanted);
    const TileGrids grids = sort_by_tile(ground, settings);
    const auto width = static_cast<size_t>(grids.triangles.width);
    std::vector<TileData> tiles(grids.triangles.first.size() - 1);
    for (const TileData& tile : *kept) {
        const auto* header = reinterpret_cast<const dtMeshHeader*>(tile.bytes);
        tiles[static_cast<size_t>(header->y) * width + static_cast<size_t>(header->x)] = tile;
    }
    std::vector<size_t> touched;
    const float edge = tile_edge(settings);
    for (size_t t = 0; t < tiles.size(); ++t) {
        const size_t row = t / width, column = t % width;
        const Vec2 corner = ground.low + Vec2{static_cast<float>(column), static_cast<float>(row)} * edge;
        const Rectangle tile = widened({corner, corner + Vec2{edge, edge}}, tile_rim(settings));
        if (std::any_of(changed.begin(), changed.end(),
                        [&](const Rectangle& area) { return touch(area, tile); }))
            touched.push_back(t);
    }
    WorkersPtr workers = make_workers(threads);
    parallel_for(*workers, touched.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k) {
            const size_t t = touched[k];
            dtFree(tiles[t].bytes);
            tiles[t] = build_tile(ground, settings, static_cast<int>(t % width), static_cast<int>(t / width),
                                  parts_of(grids, t));
        }
    });
    return join_tiles(ground, settings, tiles, thread_count(*workers));
}

void prepare_queries(Navmesh& m, int threads) {
    while (static_cast<int>(m.queries.size()) < threads) {
        m.queries.emplace_back(dtAllocNavMeshQuery());
        m.queries.back()->init(m.mesh.get(), k_most_nodes);
        m.searches.push_back(make_search(m.gates, m.shortcuts));
    }
}

}  // namespace flaneur
