#include "assets/cache/mesh_bytes.h"

#include <algorithm>
#include <array>

#include "assets/cache/bytes.h"

namespace flaneur {

void put_mesh(std::string& bytes, const Character& c) {
    put(bytes, std::span<const CharacterVertex>(c.vertices));
    const uint64_t lods[] = {c.lods.size()};
    put(bytes, std::span<const uint64_t>(lods));
    for (const auto& lod : c.lods) put(bytes, std::span<const uint32_t>(lod));
}

bool take_mesh(std::span<const char>& bytes, size_t textures, Character& c) {
    std::array<uint64_t, 1> lods;
    if (!take<CharacterVertex>(bytes, c.vertices) || !take<uint64_t>(bytes, lods)) return false;
    if (lods[0] < 1 || lods[0] > 8) return false;
    c.lods.resize(lods[0]);
    for (auto& lod : c.lods) {
        if (!take<uint32_t>(bytes, lod) || lod.size() % 3 != 0) return false;
        if (std::ranges::any_of(lod, [&](uint32_t v) { return v >= c.vertices.size(); })) return false;
    }
    return std::ranges::all_of(c.vertices, [&](const CharacterVertex& v) {
        return static_cast<int>(v.tint) < k_tint_count &&
               (v.texture == CharacterVertex::k_no_texture || v.texture < textures) &&
               std::ranges::all_of(v.joints, [](uint8_t joint) { return joint < k_joint_count; }) &&
               std::ranges::all_of(v.hung_joints,
                                   [](uint8_t joint) { return joint < k_joint_count + k_follower_count; });
    });
}

}  // namespace flaneur
