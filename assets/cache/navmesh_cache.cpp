#include "assets/cache/navmesh_cache.h"

#include <optional>

#include "assets/cache/cache_file.h"
#include "sim/base/hash.h"

namespace flaneur {

static constexpr uint64_t k_most_bytes = uint64_t{2} << 30;
static constexpr uint64_t k_builder = FLANEUR_NAVMESH_BUILDER;  // a hash of its sources and libraries

static uint64_t key_of(const Ground& ground, const NavmeshSettings& s) {
    const float settings[] = {s.cell,      s.cell_height,       s.agent_radius, s.agent_height,
                              s.max_climb, s.max_slope_degrees, s.tile};
    uint64_t h = hash_bytes(k_builder, settings, sizeof settings);
    uint64_t whole = hash_ground(ground);
    return hash_bytes(h, &whole, sizeof whole);
}

Result<NavmeshPtr> cached_navmesh(const Ground& ground, const NavmeshSettings& settings, int threads,
                                  const std::string& folder, const std::function<bool(float)>& progress) {
    if (folder.empty()) return build_navmesh(ground, settings, threads, progress);
    uint64_t key = key_of(ground, settings);
    std::string path = kept_path(folder, "navmesh", key);
    if (std::optional<std::string> bytes = read_kept(path, key, k_most_bytes)) {
        auto mesh = restore_navmesh(ground, settings, *bytes, threads);
        if (mesh) return mesh;
    }
    auto mesh = build_navmesh(ground, settings, threads, progress);
    if (mesh) keep(path, key, navmesh_bytes(**mesh));
    return mesh;
}

}  // namespace flaneur
