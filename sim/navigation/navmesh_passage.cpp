// From one mesh to another that is the same but for some tiles.
#include <cstddef>
#include <cstring>

#include "sim/base/hash.h"
#include "sim/navigation/navmesh_data.h"

namespace flaneur {

// Of a polygon all but its links, which addresses of other tiles are in.
static constexpr size_t k_shape_at = offsetof(dtPoly, verts), k_shape_size = sizeof(dtPoly) - k_shape_at;

static bool is_same(const dtMeshTile& a, const dtMeshTile& b) {
    const dtMeshHeader &one = *a.header, &other = *b.header;
    if (one.polyCount != other.polyCount || one.vertCount != other.vertCount) return false;
    if (std::memcmp(a.verts, b.verts, sizeof(float) * 3 * static_cast<size_t>(one.vertCount)) != 0)
        return false;
    for (int p = 0; p < one.polyCount; ++p) {
        const auto* shape = reinterpret_cast<const std::byte*>(&a.polys[p]) + k_shape_at;
        const auto* same = reinterpret_cast<const std::byte*>(&b.polys[p]) + k_shape_at;
        if (std::memcmp(shape, same, k_shape_size) != 0) return false;
    }
    return true;
}

NavmeshPassage passage(const Navmesh& from, const Navmesh& to) {
    const dtNavMesh &before = *from.mesh, &after = *to.mesh;
    NavmeshPassage p{std::vector<uint32_t>(static_cast<size_t>(before.getMaxTiles()), 0), &from};
    for (int t = 0; t < before.getMaxTiles(); ++t) {
        const dtMeshTile* tile = before.getTile(t);
        if (!tile->header) continue;
        const dtMeshTile* same = after.getTileAt(tile->header->x, tile->header->y, tile->header->layer);
        if (same && is_same(*tile, *same)) p.bases[static_cast<size_t>(t)] = after.getPolyRefBase(same);
    }
    return p;
}

uint32_t passed(const NavmeshPassage& p, uint32_t polygon) {
    const dtNavMesh& before = *p.from->mesh;
    if (!before.isValidPolyRef(polygon)) return 0;
    const uint32_t base = p.bases[before.decodePolyIdTile(polygon)];
    return base ? base | before.decodePolyIdPoly(polygon) : 0;
}

uint64_t hash_navmesh(const Navmesh& m) {
    uint64_t hash = 0;
    for_polygons(*m.mesh, [&](const dtMeshTile& tile, int p, uint32_t) {
        const dtPoly& polygon = tile.polys[p];
        for (int i = 0; i < polygon.vertCount; ++i)
            hash = hash_bytes(hash, &tile.verts[polygon.verts[i] * 3], 3 * sizeof(float));
        uint64_t joined = 0;
        for (uint32_t l = polygon.firstLink; l != DT_NULL_LINK; l = tile.links[l].next)
            if (tile.links[l].ref) joined += mix(polygon_number(m, tile.links[l].ref));  // in any order
        hash = mix(hash ^ joined ^ uint64_t{polygon.areaAndtype} << 32);
    });
    return hash;
}

}  // namespace flaneur
