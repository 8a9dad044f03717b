// Recast: from a tile's triangles to Detour's polygons.
#include <recastnavigation/DetourAlloc.h>
#include <recastnavigation/DetourNavMeshBuilder.h>
#include <recastnavigation/Recast.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/navigation/navmesh_data.h"

namespace flaneur {

// How far a polygon's edge may lie from the voxels' outline, in voxels. Less than one would keep every stair
// that voxels make of an oblique street, at four times the polygons.
static constexpr float k_outline_error = 1.1f;
static constexpr int k_vertices_per_polygon = 6;
static_assert(k_vertices_per_polygon <= DT_VERTS_PER_POLYGON);
// Voxels of ground that takes a walker less than this many square metres to stand on are noise.
static constexpr float k_least_region = 1, k_merged_region = 8;

// A voxel counts as ground when any part of it is, and the outline may cut into it: one voxel more than the
// radius keeps the distance everywhere.
static int radius_in_voxels(const NavmeshSettings& s) {
    return static_cast<int>(std::ceil(s.agent_radius / s.cell)) + 1;
}
static int rim_in_voxels(const NavmeshSettings& s) { return radius_in_voxels(s) + 3; }
float tile_rim(const NavmeshSettings& s) { return static_cast<float>(rim_in_voxels(s)) * s.cell; }

namespace {
struct RecastDelete {
    void operator()(rcHeightfield* p) const { rcFreeHeightField(p); }
    void operator()(rcCompactHeightfield* p) const { rcFreeCompactHeightfield(p); }
    void operator()(rcContourSet* p) const { rcFreeContourSet(p); }
    void operator()(rcPolyMesh* p) const { rcFreePolyMesh(p); }
    void operator()(rcPolyMeshDetail* p) const { rcFreePolyMeshDetail(p); }
};
template <class T>
using RecastPtr = std::unique_ptr<T, RecastDelete>;
}  // namespace

// Where two surfaces share a voxel the later one names it: a kerb's upper level wins over the road.
static constexpr Surface k_order[] = {Surface::water, Surface::track,    Surface::road,
                                      Surface::grass, Surface::crossing, Surface::path,
                                      Surface::plaza, Surface::sidewalk, Surface::steps};
static_assert(std::size(k_order) == k_surface_count);

static bool rasterize(rcContext& context, const Ground& ground, const NavmeshSettings& s,
                      const TileParts& parts, rcHeightfield& field) {
    constexpr int k_merge = 1;  // voxels of height that are one surface
    float least_normal = sin_cos(s.max_slope_degrees * k_radians).cosine;
    for (Surface kind : k_order) {
        for (uint32_t triangle : parts.triangles) {
            if (ground.kinds[triangle] != kind) continue;
            const uint32_t* index = &ground.indices[triangle * 3];
            const Vec3 &a = ground.vertices[index[0]], &b = ground.vertices[index[1]],
                       &c = ground.vertices[index[2]];
            Vec3 normal = normalize_or(cross(b - a, c - a), {0, 0, 0});
            bool walkable = is_walked(kind) && normal.y >= least_normal;
            if (!rcRasterizeTriangle(&context, floats(a), floats(b), floats(c),
                                     walkable ? area_of(kind) : RC_NULL_AREA, field, k_merge)) {
                return false;
            }
        }
    }
    // Walls come last, so that the voxels they share with ground are lost to walkers. A wall's foot may hang
    // a little above uneven ground, or lie far below it on a slope.
    constexpr float k_foot = 0.3f;
    for (uint32_t wall : parts.walls) {
        const Face& f = ground.faces[wall];
        Vec3 a = f.a, b = f.b;
        Vec3 a_top{a.x, f.a_top, a.z}, b_top{b.x, f.b_top, b.z};
        a.y -= k_foot, b.y -= k_foot;
        if (!rcRasterizeTriangle(&context, floats(a), floats(b), floats(b_top), RC_NULL_AREA, field,
                                 k_merge) ||
            !rcRasterizeTriangle(&context, floats(a), floats(b_top), floats(a_top), RC_NULL_AREA, field,
                                 k_merge)) {
            return false;
        }
    }
    for (uint32_t solid : parts.solids) {
        const auto& [a, b, c] = ground.solids[solid];
        if (!rcRasterizeTriangle(&context, floats(a), floats(b), floats(c), RC_NULL_AREA, field, k_merge)) {
            return false;
        }
    }
    return true;
}

// Takes what trunks, benches and cars stand on away from walkers. Comes after the erosion, with the walker's
// radius in the outlines: voxels would widen a post to a metre and a half, and a sidewalk has no room for
// that.
static void mark_obstacles(rcContext& context, const Ground& ground, const NavmeshSettings& s,
                           const TileParts& parts, rcCompactHeightfield& field) {
    constexpr float k_foot = 0.5f;               // its foot may hang a little
    float r = s.agent_radius, cut = r * 0.586f;  // corners are cut so that the outline touches the circle
    for (uint32_t obstacle : parts.obstacles) {
        const Obstacle& o = ground.obstacles[obstacle];
        Vec3 p = o.position;
        Vec2 half = o.half + Vec2{r, r};
        float reach = half.x + half.z;
        if (p.x < field.bmin[0] - reach || p.x > field.bmax[0] + reach || p.z < field.bmin[2] - reach ||
            p.z > field.bmax[2] + reach) {
            continue;
        }
        Vec2 ahead = heading_direction(o.yaw), left{ahead.z, -ahead.x};
        const Vec2 corners[] = {{half.x, half.z - cut},  {half.x - cut, half.z},  {cut - half.x, half.z},
                                {-half.x, half.z - cut}, {-half.x, cut - half.z}, {cut - half.x, -half.z},
                                {half.x - cut, -half.z}, {half.x, cut - half.z}};
        float outline[std::size(corners) * 3];
        for (size_t i = 0; i < std::size(corners); ++i) {
            Vec2 at = on_ground(p) + left * corners[i].x + ahead * corners[i].z;
            outline[i * 3] = at.x, outline[i * 3 + 1] = p.y, outline[i * 3 + 2] = at.z;
        }
        rcMarkConvexPolyArea(&context, outline, static_cast<int>(std::size(corners)), p.y - k_foot,
                             p.y + s.agent_height, RC_NULL_AREA, field);
    }
}

TileData build_tile(const Ground& ground, const NavmeshSettings& s, int x, int z, const TileParts& parts) {
    TileData result;
    auto fail = [&](const char* what) {
        result.failure = what;
        return result;
    };
    if (parts.triangles.empty()) return result;
    float low_y = 1e30f, high_y = -1e30f;
    for (uint32_t triangle : parts.triangles) {
        for (size_t k = 0; k < 3; ++k) {
            float y = ground.vertices[ground.indices[triangle * 3 + k]].y;
            low_y = std::min(low_y, y);
            high_y = std::max(high_y, y);
        }
    }

    int rim = rim_in_voxels(s), inner = static_cast<int>(std::lround(s.tile / s.cell)),
        size = inner + 2 * rim;
    float tile = static_cast<float>(inner) * s.cell, rim_metres = static_cast<float>(rim) * s.cell;
    Vec3 low{ground.low.x + static_cast<float>(x) * tile, low_y - 1,
             ground.low.z + static_cast<float>(z) * tile};
    Vec3 high{ground.low.x + static_cast<float>(x + 1) * tile, high_y + 1,
              ground.low.z + static_cast<float>(z + 1) * tile};
    Vec3 rim_low = low - Vec3{rim_metres, 0, rim_metres}, rim_high = high + Vec3{rim_metres, 0, rim_metres};
    int climb = static_cast<int>(std::floor(s.max_climb / s.cell_height));
    int headroom = static_cast<int>(std::ceil(s.agent_height / s.cell_height));

    rcContext context(false);
    RecastPtr<rcHeightfield> field(rcAllocHeightfield());
    if (!rcCreateHeightfield(&context, *field, size, size, floats(rim_low), floats(rim_high), s.cell,
                             s.cell_height) ||
        !rasterize(context, ground, s, parts, *field)) {
        return fail("its voxels took more memory than there is");
    }
    rcFilterWalkableLowHeightSpans(&context, headroom, *field);

    RecastPtr<rcCompactHeightfield> compact(rcAllocCompactHeightfield());
    int least = static_cast<int>(k_least_region / (s.cell * s.cell));
    int merged = static_cast<int>(k_merged_region / (s.cell * s.cell));
    if (!rcBuildCompactHeightfield(&context, headroom, climb, *field, *compact) ||
        !rcErodeWalkableArea(&context, radius_in_voxels(s), *compact)) {
        return fail("its heightfield could not be made");
    }
    mark_obstacles(context, ground, s, parts, *compact);
    field.reset();
    // Monotone regions cost an eighth of the watershed's and serve as well in streets; layer regions would
    // mix surfaces.
    if (!rcBuildRegionsMonotone(&context, *compact, rim, least, merged)) {
        return fail("its regions could not be made");
    }

    RecastPtr<rcContourSet> contours(rcAllocContourSet());
    RecastPtr<rcPolyMesh> polygons(rcAllocPolyMesh());
    RecastPtr<rcPolyMeshDetail> detail(rcAllocPolyMeshDetail());
    int longest_edge = static_cast<int>(12 / s.cell);
    if (!rcBuildContours(&context, *compact, k_outline_error, longest_edge, *contours) ||
        !rcBuildPolyMesh(&context, *contours, k_vertices_per_polygon, *polygons)) {
        return fail("its outlines could not be made");
    }
    if (polygons->npolys == 0) return result;
    if (!rcBuildPolyMeshDetail(&context, *polygons, *compact, 12 * s.cell, 6 * s.cell_height, *detail)) {
        return fail("its heights could not be made");
    }

    std::fill_n(polygons->flags, polygons->npolys, static_cast<unsigned short>(1));
    dtNavMeshCreateParams p{};
    p.verts = polygons->verts;
    p.vertCount = polygons->nverts;
    p.polys = polygons->polys;
    p.polyAreas = polygons->areas;
    p.polyFlags = polygons->flags;
    p.polyCount = polygons->npolys;
    p.nvp = polygons->nvp;
    p.detailMeshes = detail->meshes;
    p.detailVerts = detail->verts;
    p.detailVertsCount = detail->nverts;
    p.detailTris = detail->tris;
    p.detailTriCount = detail->ntris;
    p.walkableHeight = s.agent_height;
    p.walkableRadius = s.agent_radius;
    p.walkableClimb = s.max_climb;
    p.tileX = x;
    p.tileY = z;
    std::copy_n(polygons->bmin, 3, p.bmin);
    std::copy_n(polygons->bmax, 3, p.bmax);
    p.cs = s.cell;
    p.ch = s.cell_height;
    p.buildBvTree = true;
    if (!dtCreateNavMeshData(&p, &result.bytes, &result.size)) {
        return fail("it holds more polygons than a tile may; try a smaller tile");
    }
    return result;
}

}  // namespace flaneur
