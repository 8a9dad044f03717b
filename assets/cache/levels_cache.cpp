#include "assets/cache/levels_cache.h"

#include <optional>
#include <span>
#include <type_traits>

#include "assets/cache/bytes.h"
#include "assets/cache/cache_file.h"
#include "assets/cache/mesh_bytes.h"
#include "sim/base/hash.h"

namespace flaneur {

namespace {

constexpr size_t k_most_bytes = 512 << 20;             // of one character
constexpr uint64_t k_builder = FLANEUR_LEVEL_BUILDER;  // a hash of what they are made by

template <class T>
uint64_t hash_all(uint64_t hash, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return hash_bytes(hash, values.data(), values.size_bytes());
}

uint64_t key_of(const Character& c) {
    uint64_t key = hash_all(k_builder, std::span(&c.body, 1));
    key = hash_all(key, std::span<const Vec3>(c.bind_joints));
    key = hash_all(key, std::span<const Quat>(c.bind_to_canonical));
    key = hash_all(key, std::span<const CharacterVertex>(c.vertices));
    key = hash_all(key, std::span<const uint32_t>(c.lods.front()));
    for (const Texture& t : c.textures) {
        const int size[] = {t.width, t.height};
        key = hash_all(hash_all(key, std::span<const int>(size)), std::span<const uint8_t>(t.rgba));
    }
    return key;
}

struct Measures {
    uint64_t triangles, refused;
    float pixels, silhouette, colour, spare;  // so that all bytes are set
};

std::string written(const Character& c) {
    std::string bytes;
    put_mesh(bytes, c);
    std::vector<Measures> measures;
    for (const MeasuredLevel& m : c.found.levels)
        measures.push_back({m.triangles, m.refused.size(), m.pixels, m.silhouette, m.colour, 0});
    put(bytes, std::span<const Measures>(measures));
    for (const MeasuredLevel& m : c.found.levels)
        for (const std::string& why : m.refused) put(bytes, std::span<const char>(why));
    return bytes;
}

bool read(std::span<const char> bytes, size_t textures, Character& c) {
    std::vector<Measures> measures;
    if (!take_mesh(bytes, textures, c) || !take<Measures>(bytes, measures)) return false;
    for (const Measures& m : measures) {
        MeasuredLevel& level = c.found.levels.emplace_back();
        level.pixels = m.pixels;
        level.triangles = m.triangles;
        level.silhouette = m.silhouette;
        level.colour = m.colour;
        for (uint64_t i = 0; i < m.refused; ++i)
            if (!take<char>(bytes, level.refused.emplace_back())) return false;
    }
    return bytes.empty();
}

}  // namespace

void cached_lods(Character& character, const std::string& folder) {
    if (folder.empty() || character.lods.empty()) return build_lods(character);
    character.lods.resize(1);
    const uint64_t key = key_of(character);
    const std::string path = kept_path(folder, "levels", key);
    if (std::optional<std::string> kept = read_kept(path, key, k_most_bytes)) {
        Character leveled;
        if (read(*kept, character.textures.size(), leveled)) {
            character.vertices = std::move(leveled.vertices);
            character.lods = std::move(leveled.lods);
            character.found.levels = std::move(leveled.found.levels);
            return;
        }
    }
    build_lods(character);
    keep(path, key, written(character));
}

}  // namespace flaneur
