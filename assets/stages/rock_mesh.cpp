// Solids of triangles that anybody may have made.
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "assets/stages/rocks.h"

namespace flaneur {

namespace {

constexpr double k_least_volume = 1e-4;  // of the cube of its longest side

bool is_sane(Vec3 v) { return std::fabs(v.x) < 1e9f && std::fabs(v.y) < 1e9f && std::fabs(v.z) < 1e9f; }

// Corners in one place become one; triangles that then have two in one place go.
void weld(RockMesh& solid) {
    std::map<std::tuple<float, float, float>, uint32_t> at;
    std::vector<uint32_t> joined(solid.vertices.size());
    std::vector<Vec3> kept;
    for (size_t v = 0; v < solid.vertices.size(); ++v) {
        const Vec3 p = solid.vertices[v] + Vec3{0, 0, 0};  // -0 is 0
        const auto [slot, is_new] = at.insert({{p.x, p.y, p.z}, static_cast<uint32_t>(kept.size())});
        if (is_new) kept.push_back(p);
        joined[v] = slot->second;
    }
    std::vector<uint32_t> indices;
    for (size_t i = 0; i + 2 < solid.indices.size(); i += 3) {
        const uint32_t a = joined[solid.indices[i]], b = joined[solid.indices[i + 1]],
                       c = joined[solid.indices[i + 2]];
        if (a != b && b != c && c != a) indices.insert(indices.end(), {a, b, c});
    }
    solid = {std::move(kept), std::move(indices)};
}

struct Borders {
    size_t open = 0;    // edges with a triangle on one side only
    size_t turned = 0;  // between triangles that face different ways
};

Borders borders_of(const RockMesh& solid) {
    // How often each edge is passed, from its lower corner and back.
    std::map<std::pair<uint32_t, uint32_t>, std::pair<int, int>> edges;
    for (size_t i = 0; i < solid.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = solid.indices[i + k], b = solid.indices[i + (k + 1) % 3];
            auto& [up, down] = edges[std::minmax(a, b)];
            ++(a < b ? up : down);
        }
    Borders borders;
    for (const auto& [edge, passed] : edges) {
        borders.open += (passed.first + passed.second) % 2 != 0;
        borders.turned += passed.first != passed.second && (passed.first + passed.second) % 2 == 0;
    }
    return borders;
}

double volume_of(const RockMesh& solid) {
    double volume = 0;
    for (size_t i = 0; i < solid.indices.size(); i += 3) {
        const Vec3 a = solid.vertices[solid.indices[i]], b = solid.vertices[solid.indices[i + 1]],
                   c = solid.vertices[solid.indices[i + 2]];
        volume += static_cast<double>(dot(a, cross(b, c))) / 6;
    }
    return volume;
}

std::string counted(size_t count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

Result<RockMesh> make_rock_mesh(std::vector<Vec3> vertices, std::vector<uint32_t> indices, float size) {
    RockMesh solid{std::move(vertices), std::move(indices)};
    solid.indices.resize(solid.indices.size() / 3 * 3);
    if (solid.indices.empty()) return Error{"has no triangles to walk on"};
    if (solid.indices.size() / 3 > k_most_rock_triangles)
        return Error{"has " + std::to_string(solid.indices.size() / 3) + " triangles; take " +
                     std::to_string(k_most_rock_triangles) + " at most"};
    if (!std::ranges::all_of(solid.vertices, is_sane))
        return Error{"has vertices beyond reason; export it again"};
    if (std::ranges::any_of(solid.indices, [&](uint32_t v) { return v >= solid.vertices.size(); }))
        return Error{"has triangles of vertices that are not there"};
    weld(solid);
    if (solid.indices.empty()) return Error{"has no triangles of any extent to walk on"};
    Vec3 low = solid.vertices[solid.indices[0]], high = low;
    for (const uint32_t v : solid.indices) {
        const Vec3 p = solid.vertices[v];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const Vec3 wide = high - low, middle = (low + high) * 0.5f;
    const float longest = std::max({wide.x, wide.y, wide.z});
    if (!(longest > 0)) return Error{"has no extent"};
    for (Vec3& v : solid.vertices) v = (v - middle) * (size / longest);
    const Borders borders = borders_of(solid);
    if (borders.open > 0)
        return Error{"is not closed: " + counted(borders.open, "edge") +
                     " of it have a triangle on one side only, and walkers would fall in"};
    if (borders.turned > 0)
        return Error{"does not face out everywhere: at " + counted(borders.turned, "edge") +
                     " triangles meet that face different ways"};
    const double volume = volume_of(solid), cube = std::pow(static_cast<double>(size), 3);
    if (std::fabs(volume) < k_least_volume * cube) return Error{"encloses next to nothing"};
    if (volume < 0)
        for (size_t i = 0; i < solid.indices.size(); i += 3)
            std::swap(solid.indices[i], solid.indices[i + 1]);
    return solid;
}

}  // namespace flaneur
