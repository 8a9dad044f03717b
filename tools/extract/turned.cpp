#include "tools/extract/turned.h"

#include <algorithm>

#include "sim/base/math.h"
#include "tools/extract/convert.h"

namespace flaneur {

static constexpr int k_sides = 16;

void add_turned(PersonMesh& mesh, std::span<const TurnedRing> rings, uint8_t joint) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (size_t r = 0; r < rings.size(); ++r) {
        const TurnedRing &before = rings[r == 0 ? 0 : r - 1],
                         &after = rings[std::min(r + 1, rings.size() - 1)];
        const Vec2 out =
            normalize_or(Vec2{after.height - before.height, before.radius - after.radius}, {1, 0});
        for (int side = 0; side < k_sides; ++side) {
            const SinCos at = sin_cos(2 * k_pi * static_cast<float>(side) / k_sides);
            PersonVertex v{};
            v.position = {at.sine * rings[r].radius, rings[r].height, at.cosine * rings[r].radius};
            v.colour = rings[r].colour;
            v.normal[0] = packed(at.sine * out.x);
            v.normal[1] = packed(out.z);
            v.normal[2] = packed(at.cosine * out.x);
            v.joints[0] = joint;
            v.weights[0] = 255;
            v.texture = ~0u;
            mesh.vertices.push_back(v);
        }
    }
    for (uint32_t r = 0; r + 1 < rings.size(); ++r)
        for (uint32_t side = 0; side < k_sides; ++side) {
            const uint32_t next = (side + 1) % k_sides, a = first + r * k_sides + side,
                           b = first + r * k_sides + next, c = a + k_sides, d = b + k_sides;
            for (const uint32_t k : {a, b, c, b, d, c}) mesh.lods[0].push_back(k);
        }
}

}  // namespace flaneur
