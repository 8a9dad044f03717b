// What a Navmesh holds. Private to sim/navigation.
#pragma once

#include <recastnavigation/DetourNavMesh.h>
#include <recastnavigation/DetourNavMeshQuery.h>

#include <memory>
#include <span>
#include <vector>

#include "sim/navigation/gates.h"
#include "sim/navigation/navmesh.h"
#include "sim/navigation/shortcuts.h"
#include "sim/navigation/weighted_grid.h"

namespace flaneur {

struct DetourDelete {
    void operator()(dtNavMesh* mesh) const { dtFreeNavMesh(mesh); }
    void operator()(dtNavMeshQuery* query) const { dtFreeNavMeshQuery(query); }
};

// A piece of a polygon where walkers may start or wish to go.
struct PlacePiece {
    Vec3 a, b, c;
    uint32_t polygon = 0;
};

// A border line as what asks for the nearest reads it.
struct CellBorder {
    Vec3 a, along;                 // from end to end
    float per_length_squared = 0;  // on the ground plane
    uint32_t line = 0;             // in `borders`
};

struct Navmesh {
    NavmeshSettings settings;
    std::unique_ptr<dtNavMesh, DetourDelete> mesh;
    dtQueryFilter filter, wheels;  // of who walks; of who has wheels, and takes no steps
    std::vector<std::unique_ptr<dtNavMeshQuery, DetourDelete>> queries;  // one a thread

    std::vector<uint32_t> first_polygon;  // one a tile: the number of its first polygon
    std::vector<uint32_t> islands;        // one a polygon
    std::vector<uint32_t> wheel_islands;  // the same for wheels: steps are pieces of their own
    uint32_t worthy_islands = 0;          // so many, the largest, are worth walking about in
    std::vector<PlacePiece> places;       // in the order of the grid's items
    WeightedGrid place_grid;              // cells as large as tiles; weights are square metres

    std::vector<uint32_t> references;  // Detour's, by polygon number
    Gates gates;
    Shortcuts shortcuts;
    ShortcutCosts costs, wheel_costs;                  // these are empty where there are no steps
    std::vector<std::unique_ptr<WaySearch>> searches;  // one a thread

    std::vector<BorderLine> borders;
    Grid border_grid;
    Grid step_grid;                        // only its squares:
    std::vector<uint8_t> near_steps;       // whether steps are within k_steps_ahead of one
    std::vector<CellBorder> cell_borders;  // one for each item of border_grid, side by side in memory
};

// The area id of a surface on the mesh; Recast keeps 0 for what cannot be walked on.
inline uint8_t area_of(Surface s) { return static_cast<uint8_t>(static_cast<int>(s) + 1); }
inline Surface surface_of_area(uint8_t area) { return static_cast<Surface>(area - 1); }

inline const float* floats(const Vec3& v) { return &v.x; }
inline float* floats(Vec3& v) { return &v.x; }

inline uint32_t polygon_number(const Navmesh& m, uint32_t polygon) {
    const dtNavMesh& mesh = *m.mesh;
    return m.first_polygon[mesh.decodePolyIdTile(polygon)] + mesh.decodePolyIdPoly(polygon);
}

// Calls visit(tile, polygon index, reference) for every polygon, tile by tile.
template <class Visit>
void for_polygons(const dtNavMesh& mesh, Visit visit) {
    for (int t = 0; t < mesh.getMaxTiles(); ++t) {
        const dtMeshTile* tile = mesh.getTile(t);
        if (!tile->header) continue;
        uint32_t base = mesh.getPolyRefBase(tile);
        for (int p = 0; p < tile->header->polyCount; ++p) visit(*tile, p, base | static_cast<uint32_t>(p));
    }
}

inline Vec3 tile_vertex(const dtMeshTile& tile, uint16_t index) {
    const float* v = &tile.verts[index * 3];
    return {v[0], v[1], v[2]};
}

// One tile's Detour data, empty if nothing in it can be walked on; why it failed, if it did.
struct TileData {
    unsigned char* bytes = nullptr;  // dtFree
    int size = 0;
    const char* failure = nullptr;
};
// What of the ground touches a tile or its rim, by index.
struct TileParts {
    // Of the ground: its triangles, faces, solids and obstacles.
    std::span<const uint32_t> triangles, walls, solids, obstacles;
};
TileData build_tile(const Ground& ground, const NavmeshSettings& settings, int x, int z,
                    const TileParts& parts);

// How far beyond its edges a tile must know the ground, metres.
float tile_rim(const NavmeshSettings& settings);

}  // namespace flaneur
