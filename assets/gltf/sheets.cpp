#include "assets/gltf/sheets.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace flaneur {

namespace {

// Volume over area^1.5: 0.094 for a sphere, 0.03 for half a pipe, 0 for a sheet.
constexpr float k_thin = 0.015f;

uint32_t root_of(std::vector<uint32_t>& above, uint32_t v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
}

// By vertex: one that stands for its connected part; vertices at one place are one.
std::vector<uint32_t> parts_of(const GltfPrimitive& p) {
    std::vector<uint32_t> above(p.positions.size()), order(p.positions.size());
    std::iota(above.begin(), above.end(), 0u);
    std::iota(order.begin(), order.end(), 0u);
    auto key = [&](uint32_t v) {
        Vec3 q = p.positions[v];
        return std::tuple(q.x, q.y, q.z, v);
    };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
    auto join = [&](uint32_t a, uint32_t b) { above[root_of(above, a)] = root_of(above, b); };
    for (size_t i = 1; i < order.size(); ++i)
        if (p.positions[order[i]] == p.positions[order[i - 1]]) join(order[i], order[i - 1]);
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        join(p.indices[i], p.indices[i + 1]);
        join(p.indices[i], p.indices[i + 2]);
    }
    for (uint32_t v = 0; v < above.size(); ++v) above[v] = root_of(above, v);
    return above;
}

struct PartExtent {
    Vec3 middle;
    double count = 0, area = 0, volume = 0;
};

}  // namespace

void add_backs(GltfPrimitive& p) {
    if (!p.two_sided || p.normals.empty()) return;
    std::vector<uint32_t> part = parts_of(p);
    std::vector<PartExtent> extents(part.size());
    for (uint32_t i : p.indices) extents[part[i]].middle += p.positions[i], extents[part[i]].count += 1;
    for (PartExtent& e : extents)
        if (e.count > 0) e.middle = e.middle / float(e.count);
    size_t corners = p.indices.size();
    for (size_t i = 0; i + 2 < corners; i += 3) {
        PartExtent& e = extents[part[p.indices[i]]];
        Vec3 a = p.positions[p.indices[i]] - e.middle, b = p.positions[p.indices[i + 1]] - e.middle,
             c = p.positions[p.indices[i + 2]] - e.middle;
        e.area += double(length(cross(b - a, c - a))) / 2;
        e.volume += double(dot(a, cross(b, c))) / 6;
    }

    constexpr uint32_t k_none = ~0u;
    std::vector<uint32_t> back(p.positions.size(), k_none);
    auto behind = [&](uint32_t v) {
        if (back[v] != k_none) return back[v];
        back[v] = uint32_t(p.positions.size());
        p.positions.push_back(Vec3(p.positions[v]));
        p.normals.push_back(-p.normals[v]);
        if (!p.uvs.empty()) p.uvs.push_back(Vec2(p.uvs[v]));
        p.colours.push_back(uint32_t(p.colours[v]));
        auto each = size_t(p.influences_per_vertex);
        for (size_t n = 0; n < each; ++n)
            p.influences.push_back(GltfPrimitive::Influence(p.influences[v * each + n]));
        return back[v];
    };
    for (size_t i = 0; i + 2 < corners; i += 3) {
        const PartExtent& e = extents[part[p.indices[i]]];
        if (std::fabs(e.volume) > double(k_thin) * e.area * std::sqrt(e.area)) continue;
        uint32_t a = behind(p.indices[i]), b = behind(p.indices[i + 1]), c = behind(p.indices[i + 2]);
        p.indices.insert(p.indices.end(), {a, c, b});
    }
}

}  // namespace flaneur
