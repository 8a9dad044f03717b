#include "assets/cache_file.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "sim/base/hash.h"

namespace flaneur {

namespace {

namespace fs = std::filesystem;

struct Head {
    char magic[8] = {'f', 'l', 'a', 'n', 'k', 'e', 'p', '2'};
    uint64_t key = 0;
    uint64_t size = 0, hash = 0;  // of the bytes that follow
};

}  // namespace

std::string kept_path(const std::string& folder, const char* kind, uint64_t key) {
    char name[64];
    std::snprintf(name, sizeof name, "%s-%016llx", kind, static_cast<unsigned long long>(key));
    return (fs::path(folder) / name).string();
}

std::optional<std::string> read_kept(const std::string& path, uint64_t key, uint64_t most) {
    std::error_code failed;
    uintmax_t size = fs::is_regular_file(path, failed) ? fs::file_size(path, failed) : 0;
    Head head, sound;
    if (failed || size < sizeof head || size - sizeof head > most) return std::nullopt;
    std::string bytes(size - sizeof head, '\0');
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(&head), sizeof head) ||
        !file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
        return std::nullopt;
    }
    bool whole = std::memcmp(head.magic, sound.magic, sizeof head.magic) == 0 && head.key == key &&
                 head.size == bytes.size() && head.hash == hash_bytes(key, bytes.data(), bytes.size());
    return whole ? std::optional(std::move(bytes)) : std::nullopt;
}

void keep(const std::string& path, uint64_t key, std::string_view bytes) {
    std::error_code failed;
    fs::create_directories(fs::path(path).parent_path(), failed);
    static std::atomic<int> number{0};
    std::string part = path + "." + std::to_string(getpid()) + "-" + std::to_string(number++) + ".part";
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

}  // namespace flaneur
