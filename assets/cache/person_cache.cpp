#include "assets/cache/person_cache.h"

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <span>

#include "assets/cache/bytes.h"
#include "assets/cache/cache_file.h"
#include "assets/cache/mesh_bytes.h"
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
                               o.stick,
                               o.pram};
    return hash_bytes(0, fields, sizeof fields);
}

std::string written(const Character& c) {
    std::string bytes;
    put(bytes, std::span<const char>(c.name));
    put(bytes, std::span(&c.body, 1));
    put(bytes, std::span<const Vec3>(c.bind_joints));
    put(bytes, std::span<const Quat>(c.bind_to_canonical));
    put(bytes, std::span<const Hung>(c.followers));
    put(bytes, std::span(&c.robe_hem, 1));
    put_mesh(bytes, c);
    return bytes;
}

bool read(std::span<const char> bytes, Character& c) {
    std::array<Body, 1> body;
    std::array<float, 1> hem{};
    bool whole = take<char>(bytes, c.name) && take<Body>(bytes, body) && take<Vec3>(bytes, c.bind_joints) &&
                 take<Quat>(bytes, c.bind_to_canonical) && take<Hung>(bytes, c.followers) &&
                 take<float>(bytes, hem) && take_mesh(bytes, 0, c) && bytes.empty() &&
                 std::ranges::all_of(c.followers, [](Hung hung) { return hung.joint < k_joint_count; });
    c.body = body[0];
    c.robe_hem = hem[0];
    return whole;
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
