#include "assets/cache/person_cache.h"

#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

#include "assets/cache/cache_file.h"
#include "sim/base/hash.h"

namespace flaneur {

namespace {

constexpr size_t k_most_bytes = 16 << 20;                   // of one person
constexpr uint64_t k_generator = FLANEUR_PERSON_GENERATOR;  // a hash of what it is made of

uint64_t key_of(const PersonOptions& o) {
    const uint64_t fields[] = {k_generator,
                               o.seed,
                               std::bit_cast<uint32_t>(o.height),
                               std::bit_cast<uint32_t>(o.age),
                               std::bit_cast<uint32_t>(o.build),
                               o.woman,
                               static_cast<uint64_t>(o.hair),
                               static_cast<uint64_t>(o.beard),
                               static_cast<uint64_t>(o.top),
                               static_cast<uint64_t>(o.over),
                               static_cast<uint64_t>(o.bottom),
                               static_cast<uint64_t>(o.shoes),
                               static_cast<uint64_t>(o.hat),
                               static_cast<uint64_t>(o.bag),
                               o.glasses,
                               o.scarf,
                               o.headphones,
                               o.phone,
                               o.stick};
    return hash_bytes(0, fields, sizeof fields);
}

template <class T>
void put(std::string& bytes, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    uint64_t count = values.size();
    bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

// Takes what `put` put from the front of `bytes`; false if there is less.
template <class T, class Values>
bool take(std::span<const char>& bytes, Values& values) {
    uint64_t count = 0;
    if (bytes.size() < sizeof count) return false;
    std::memcpy(&count, bytes.data(), sizeof count);
    bytes = bytes.subspan(sizeof count);
    if (count > bytes.size() / sizeof(T)) return false;
    if constexpr (requires { values.resize(count); }) {
        values.resize(count);
    } else if (count != std::size(values)) {
        return false;
    }
    if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes = bytes.subspan(count * sizeof(T));
    return true;
}

std::string written(const Character& c) {
    std::string bytes;
    put(bytes, std::span<const char>(c.name));
    put(bytes, std::span(&c.body, 1));
    put(bytes, std::span<const Vec3>(c.bind_joints));
    put(bytes, std::span<const Quat>(c.bind_to_canonical));
    put(bytes, std::span<const CharacterVertex>(c.vertices));
    uint64_t lods[] = {c.lods.size()};
    put(bytes, std::span<const uint64_t>(lods));
    for (const auto& lod : c.lods) put(bytes, std::span<const uint32_t>(lod));
    return bytes;
}

bool read(std::span<const char> bytes, Character& c) {
    std::array<Body, 1> body;
    std::array<uint64_t, 1> lods;
    bool whole = take<char>(bytes, c.name) && take<Body>(bytes, body) && take<Vec3>(bytes, c.bind_joints) &&
                 take<Quat>(bytes, c.bind_to_canonical) && take<CharacterVertex>(bytes, c.vertices) &&
                 take<uint64_t>(bytes, lods) && lods[0] >= 1 && lods[0] <= 8;
    if (!whole) return false;
    c.body = body[0];
    c.lods.resize(lods[0]);
    for (auto& lod : c.lods) {
        if (!take<uint32_t>(bytes, lod) || lod.size() % 3 != 0) return false;
        for (uint32_t v : lod)
            if (v >= c.vertices.size()) return false;
    }
    for (const CharacterVertex& v : c.vertices) {
        if (static_cast<int>(v.tint) >= k_tint_count) return false;
        for (uint8_t joint : v.joints)
            if (joint >= k_joint_count) return false;
    }
    return bytes.empty();
}

}  // namespace

Character cached_person(const PersonOptions& options, const std::string& folder) {
    if (folder.empty()) return generate_person(options);
    uint64_t key = key_of(options);
    std::string path = kept_path(folder, "person", key);
    Character person;
    std::optional<std::string> kept = read_kept(path, key, k_most_bytes);
    if (kept && read(*kept, person)) {
        person.person = options;
        return person;
    }
    person = generate_person(options);
    keep(path, key, written(person));
    return person;
}

}  // namespace flaneur
