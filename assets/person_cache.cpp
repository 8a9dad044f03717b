#include "assets/person_cache.h"

#include <unistd.h>

#include <atomic>
#include <bit>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <type_traits>

#include "sim/base/hash.h"

namespace flaneur {

namespace {

namespace fs = std::filesystem;

constexpr size_t k_most_bytes = 16 << 20;                   // of one person
constexpr uint64_t k_generator = FLANEUR_PERSON_GENERATOR;  // a hash of what it is made of

struct Head {
    char magic[8] = {'f', 'l', 'a', 'n', 'p', 'p', 'l', '1'};
    uint64_t key = 0;
    uint64_t size = 0, hash = 0;  // of the bytes that follow
};

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

bool load(const fs::path& path, uint64_t key, Character& c) {
    std::error_code failed;
    uintmax_t size = fs::is_regular_file(path, failed) ? fs::file_size(path, failed) : 0;
    if (failed || size > k_most_bytes) return false;
    std::string bytes(size, '\0');
    std::ifstream file(path, std::ios::binary);
    if (!file.read(bytes.data(), static_cast<std::streamsize>(size))) return false;
    Head head, sound;
    if (bytes.size() < sizeof head) return false;
    std::memcpy(&head, bytes.data(), sizeof head);
    std::span<const char> rest = std::span<const char>(bytes).subspan(sizeof head);
    return std::memcmp(head.magic, sound.magic, sizeof head.magic) == 0 && head.key == key &&
           head.size == rest.size() && head.hash == hash_bytes(key, rest.data(), rest.size()) &&
           read(rest, c);
}

// Written beside its place, under a name of this thread's own, and renamed, so that nobody reads half of one.
void keep(const fs::path& path, uint64_t key, const Character& c) {
    std::error_code failed;
    fs::create_directories(path.parent_path(), failed);
    fs::path part = path;
    part += ".";
    static std::atomic<int> number{0};
    part += std::to_string(getpid()) + "-" + std::to_string(number++);
    part += ".part";
    std::string bytes = written(c);
    Head head;
    head.key = key;
    head.size = bytes.size();
    head.hash = hash_bytes(key, bytes.data(), bytes.size());
    {
        std::ofstream file(part, std::ios::binary);
        file.write(reinterpret_cast<const char*>(&head), sizeof head);
        file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        file.flush();
        if (!file) failed = std::make_error_code(std::errc::io_error);
    }
    if (!failed) fs::rename(part, path, failed);
    std::error_code ignored;
    if (failed) fs::remove(part, ignored);
}

}  // namespace

Character cached_person(const PersonOptions& options, const std::string& folder) {
    if (folder.empty()) return generate_person(options);
    uint64_t key = key_of(options);
    char name[32];
    std::snprintf(name, sizeof name, "person-%016llx", static_cast<unsigned long long>(key));
    fs::path path = fs::path(folder) / name;
    Character person;
    if (load(path, key, person)) {
        person.person = options;
        return person;
    }
    person = generate_person(options);
    keep(path, key, person);
    return person;
}

}  // namespace flaneur
