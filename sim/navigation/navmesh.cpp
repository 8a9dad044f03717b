// Queries of places: Detour's, and look-ups in the tables made beside the mesh.
#include "sim/navigation/navmesh.h"

#include <recastnavigation/DetourCommon.h>

#include <algorithm>
#include <cmath>

#include "sim/base/planar.h"
#include "sim/ground/grid.h"
#include "sim/navigation/navmesh_data.h"

namespace flaneur {

const NavmeshSettings& settings_of(const Navmesh& mesh) { return mesh.settings; }

std::optional<NavPoint> nearest(const Navmesh& m, int thread, Vec3 point, Vec3 reach) {
    NavPoint found;
    m.queries[thread]->findNearestPoly(floats(point), floats(reach), &m.filter, &found.polygon,
                                       floats(found.position));
    // Detour looks at all polygons whose boxes touch the reach, and takes the closest wherever it is.
    Vec3 off = found.position - point;
    bool within = std::fabs(off.x) <= reach.x && std::fabs(off.y) <= reach.y && std::fabs(off.z) <= reach.z;
    if (!found.polygon || !within) return std::nullopt;
    return found;
}

static NavPoint inside_place(const Navmesh& m, int thread, size_t index, float v, float w) {
    const PlacePiece& place = m.places[index];
    if (v + w > 1) v = 1 - v, w = 1 - w;
    NavPoint p{place.a + (place.b - place.a) * v + (place.c - place.a) * w, place.polygon};
    m.queries[thread]->getPolyHeight(p.polygon, floats(p.position), &p.position.y);
    return p;
}

NavPoint random_place(const Navmesh& m, int thread, float u, float v, float w) {
    size_t last = m.places.size();
    return inside_place(
        m, thread, item_at(m.place_grid, static_cast<double>(u) * m.place_grid.before[last], 0, last), v, w);
}

double place_area_near(const Navmesh& m, Vec2 centre, float radius) {
    return weight_near(m.place_grid, centre, radius);
}

NavPoint random_place_near(const Navmesh& m, int thread, Vec2 centre, float radius, float u, float v,
                           float w) {
    auto place = item_near(m.place_grid, centre, radius, u);
    return place ? inside_place(m, thread, *place, v, w) : random_place(m, thread, u, v, w);
}

uint32_t island(const Navmesh& m, uint32_t polygon) {
    return m.mesh->isValidPolyRef(polygon) ? m.islands[polygon_number(m, polygon)] : ~0u;
}

bool are_joined(const Navmesh& m, uint32_t from, uint32_t to, By by) {
    if (!m.mesh->isValidPolyRef(from) || !m.mesh->isValidPolyRef(to)) return false;
    const uint32_t a = polygon_number(m, from), b = polygon_number(m, to);
    if (m.islands[a] != m.islands[b]) return false;
    if (by == By::feet || m.wheel_islands[a] == m.wheel_islands[b]) return true;
    return m.gates.steps[a] && !m.gates.steps[b];
}

bool is_worth_walking(const Navmesh& m, uint32_t polygon) { return island(m, polygon) < m.worthy_islands; }

Surface surface_of(const Navmesh& m, uint32_t polygon) {
    const dtMeshTile* tile = nullptr;
    const dtPoly* found = nullptr;
    if (dtStatusFailed(m.mesh->getTileAndPolyByRef(polygon, &tile, &found))) return Surface::road;
    return surface_of_area(found->getArea());
}

bool is_near_steps(const Navmesh& m, Vec2 p) {
    const Grid& grid = m.step_grid;
    const int x = grid_column(p.x - grid.origin.x, grid.cell, grid.width),
              z = grid_column(p.z - grid.origin.z, grid.cell, grid.height);
    return m.near_steps[static_cast<size_t>(z) * grid.width + x] != 0;
}

static const dtQueryFilter& filter_of(const Navmesh& m, By by) {
    return by == By::wheels ? m.wheels : m.filter;
}

// Whether `p` lies in the polygon seen from above, or no farther than `slack` metres beside it.
static bool in_polygon(const dtMeshTile& tile, const dtPoly& polygon, Vec2 p, float slack = 0) {
    bool left = false, right = false;
    for (int i = 0, j = polygon.vertCount - 1; i < polygon.vertCount; j = i++) {
        const float *a = &tile.verts[polygon.verts[j] * 3], *b = &tile.verts[polygon.verts[i] * 3];
        const Vec2 along{b[0] - a[0], b[2] - a[2]};
        const float side = cross(along, p - Vec2{a[0], a[2]}), least = slack > 0 ? slack * length(along) : 0;
        left |= side < -least;
        right |= side > least;
    }
    return !(left && right);
}

// Where one comes to over seams that join nothing but are no border; Detour stops at them, or goes far off.
static std::optional<NavPoint> over_seam(const Navmesh& m, int thread, NavPoint from, Vec3 to, By by) {
    constexpr float k_beside = 0.01f, k_rise = 0.5f;  // metres, half extents
    if (first_border(m, from.position, to)) return {};
    const auto place = nearest(m, thread, to, {k_beside, k_rise, k_beside});
    if (!place || length(on_ground(place->position - to)) > k_beside) return {};
    if (by == By::wheels && surface_of(m, place->polygon) == Surface::steps) return {};
    return place;
}

NavPoint move_along(const Navmesh& m, int thread, NavPoint from, Vec3 to, By by) {
    constexpr float k_rounding = 2e-3f, k_slack = 0.05f;  // metres
    constexpr Vec3 k_beside{0.2f, 1, 0.2f};               // likewise, half extents
    constexpr int k_most_visited = 16;
    const dtMeshTile* tile = nullptr;
    const dtPoly* polygon = nullptr;
    if (dtStatusFailed(m.mesh->getTileAndPolyByRef(from.polygon, &tile, &polygon))) return from;
    if (in_polygon(*tile, *polygon, on_ground(to))) return {to, from.polygon};

    // Next to slivers one may come to lie beside one's polygon. From there Detour goes nowhere, or far off.
    if (!in_polygon(*tile, *polygon, on_ground(from.position), k_rounding))
        from = nearest(m, thread, from.position, k_beside).value_or(from);
    NavPoint result = from;
    dtPolyRef visited[k_most_visited];
    int count = 0;
    dtStatus status = m.queries[thread]->moveAlongSurface(from.polygon, floats(from.position), floats(to),
                                                          &filter_of(m, by), floats(result.position), visited,
                                                          &count, k_most_visited);
    if (dtStatusFailed(status) || count == 0) return from;
    result.polygon = visited[count - 1];
    if (length_squared(on_ground(to - result.position)) < k_rounding * k_rounding) return result;
    if (const auto place = over_seam(m, thread, from, to, by)) return *place;
    // Along the border one may come a little farther than one went.
    const float went = length(on_ground(result.position - from.position)),
                way = length(on_ground(to - from.position));
    const bool is_far_off = went > 1.25f * way + k_slack;
    return is_far_off ? from : result;
}

static Vec3 closest_on_line(const BorderLine& line, Vec3 p) {
    return lerp(line.a, line.b, closest_on(on_ground(line.a), on_ground(line.b), on_ground(p)));
}

// Borders of another level do not count, metres.
static constexpr float k_same_level = 1.5f;

// Whether `p`, no farther than `reach` from the border, lies beyond it by more than `most`.
static bool is_beyond(const Navmesh& m, Vec3 p, float reach, float most) {
    BorderLine lines[4];
    int count = borders_near(m, p, reach, lines, 4);
    Vec2 at = on_ground(p);
    float least = 0, side = most;
    for (int i = 0; i < count; ++i) {
        Vec2 a = on_ground(lines[i].a), ab = on_ground(lines[i].b) - a;
        float distance = length_squared(on_ground(closest_on_line(lines[i], p)) - at);
        float inside = cross(ab, at - a) / length(ab);
        // Of lines whose common end is the closest, the one that is most athwart tells.
        if (i > 0 && (distance > least + 1e-6f || std::fabs(inside) < std::fabs(side))) continue;
        if (i == 0) least = distance;
        side = inside;
    }
    return side < -most;
}

// Not Detour's raycast: it can run for ever along an edge that the ray touches.
std::optional<BorderLine> first_border(const Navmesh& m, Vec3 from, Vec3 to, float forgiven_start,
                                       float forgiven_end) {
    Vec2 p = on_ground(from), way = on_ground(to) - p;
    const float distance = length(way);
    if (distance <= forgiven_end) return {};
    const Vec2 direction = way / distance;
    float first = distance - forgiven_end;
    std::optional<BorderLine> found;
    for_cells_of_ray(m.border_grid, p, direction, distance, [&](size_t cell, float exit) {
        for (uint32_t k = m.border_grid.first[cell]; k < m.border_grid.first[cell + 1]; ++k) {
            const CellBorder& line = m.cell_borders[k];
            Vec2 ab = on_ground(line.along), to_a = on_ground(line.a) - p;
            float outward = cross(direction, ab);  // positive when the way leaves the mesh here
            if (outward <= 1e-6f) continue;
            float t = cross(to_a, ab) / outward, s = cross(to_a, direction) / outward;
            if (t <= forgiven_start || t >= first || s < 0 || s > 1) continue;
            float rise = line.a.y + line.along.y * s - lerp(from.y, to.y, t / distance);
            if (std::fabs(rise) < k_same_level) first = t, found = m.borders[line.line];
        }
        return first > exit;
    });
    return found;
}

bool is_clear(const Navmesh& m, Vec3 from, Vec3 to) {
    constexpr float k_forgiven_start = 0.02f, k_forgiven_end = 0.05f;
    const float distance = length(on_ground(to - from));
    if (distance <= k_forgiven_end) return true;
    // From a place on the border straight out over it, maybe to another place on the border.
    constexpr float k_look = 0.1f, k_beyond = 0.015f;
    if (is_beyond(m, lerp(from, to, std::min(k_look / distance, 0.5f)), k_look + 0.05f, k_beyond))
        return false;
    return !first_border(m, from, to, k_forgiven_start, k_forgiven_end);
}

int borders_near(const Navmesh& m, Vec3 point, float radius, BorderLine* lines, int capacity) {
    const Grid& grid = m.border_grid;
    Vec2 reach{radius, radius}, p = on_ground(point);
    CellRange r = cells_of_box(grid, p - reach, p + reach);
    struct Entry {
        float distance;
        uint32_t line;
        bool operator<(const Entry& e) const {
            return distance != e.distance ? distance < e.distance : line < e.line;
        }
    };
    constexpr int k_most = 32;
    Entry best[k_most];
    int count = 0;
    capacity = std::min(capacity, k_most);
    for (int z = r.z0; z <= r.z1; ++z) {
        for (int x = r.x0; x <= r.x1; ++x) {
            size_t cell = static_cast<size_t>(z) * grid.width + x;
            for (uint32_t k = grid.first[cell]; k < grid.first[cell + 1]; ++k) {
                const CellBorder& border = m.cell_borders[k];
                const Vec2 from_a = p - on_ground(border.a), along = on_ground(border.along);
                const float t = clamp(dot(from_a, along) * border.per_length_squared, 0, 1);
                const Entry e{length_squared(from_a - along * t), border.line};
                if (e.distance > radius * radius) continue;
                if (std::fabs(border.a.y + border.along.y * t - point.y) > k_same_level) continue;
                if (count == capacity && !(e < best[count - 1])) continue;
                int at = 0;
                while (at < count && best[at] < e) ++at;
                if (at < count && best[at].line == e.line) continue;  // seen in another cell
                if (count < capacity) ++count;
                for (int i = count - 1; i > at; --i) best[i] = best[i - 1];
                best[at] = e;
            }
        }
    }
    for (int i = 0; i < count; ++i) lines[i] = m.borders[best[i].line];
    return count;
}

std::vector<Vec3> navmesh_triangles(const Navmesh& m) {
    std::vector<Vec3> corners;
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t) {
        const dtPoly& polygon = tile.polys[p];
        // Detour winds clockwise seen from above.
        for (int i = 2; i < polygon.vertCount; ++i) {
            corners.push_back(tile_vertex(tile, polygon.verts[0]));
            corners.push_back(tile_vertex(tile, polygon.verts[i - 1]));
            corners.push_back(tile_vertex(tile, polygon.verts[i]));
        }
    });
    return corners;
}

std::vector<Surface> navmesh_kinds(const Navmesh& m) {
    std::vector<Surface> kinds;
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t) {
        const dtPoly& polygon = tile.polys[p];
        kinds.insert(kinds.end(), static_cast<size_t>(polygon.vertCount) - 2,
                     surface_of_area(polygon.getArea()));
    });
    return kinds;
}

}  // namespace flaneur
