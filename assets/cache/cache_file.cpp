#include "assets/cache/cache_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <tuple>
#include <vector>

#include "assets/files/file.h"
#include "sim/base/hash.h"

namespace flaneur {

namespace {

namespace fs = std::filesystem;

struct Head {
    char magic[8] = {'f', 'l', 'a', 'n', 'k', 'e', 'p', '2'};
    uint64_t key = 0;
    uint64_t size = 0, hash = 0;  // of the bytes that follow
};

struct KeptFile {
    fs::path path;
    uint64_t bytes;
    fs::file_time_type used;
    bool part;  // being written, or left behind
};

// Ours, and none of what else lies there: none where there is no folder. `failed` where they cannot be seen.
std::vector<KeptFile> files_in(const fs::path& folder, std::error_code& failed) {
    std::vector<KeptFile> files;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        std::string name = at->path().filename().string();
        std::error_code gone;
        auto is = [&](const char* kind) { return name.starts_with(kind); };
        if (!is("impostors-") && !is("levels-") && !is("navmesh-") && !is("person-")) continue;
        if (!at->is_regular_file(gone)) continue;
        KeptFile file{at->path(), at->file_size(gone), at->last_write_time(gone), name.ends_with(".part")};
        if (gone == std::errc::permission_denied) return failed = gone, files;
        if (!gone) files.push_back(std::move(file));
    }
    if (failed == std::errc::no_such_file_or_directory || failed == std::errc::not_a_directory)
        failed.clear();
    return files;
}

// What was left half-written goes, and then, until the rest is no more than `limit`, what was used least
// recently.
void make_room(const fs::path& folder, uint64_t limit) {
    std::error_code ignored;
    std::vector<KeptFile> files = files_in(folder, ignored);
    auto stale = fs::file_time_type::clock::now() - std::chrono::hours(1);
    auto order = [&](const KeptFile& file) {
        return std::tuple(!(file.part && file.used < stale), file.used, file.path);
    };
    std::sort(files.begin(), files.end(),
              [&](const KeptFile& a, const KeptFile& b) { return order(a) < order(b); });
    uint64_t bytes = 0;
    for (const KeptFile& file : files) bytes += file.bytes;
    for (const KeptFile& file : files) {
        if (file.part ? file.used >= stale : bytes <= limit) continue;
        if (fs::remove(file.path, ignored)) bytes -= file.bytes;
    }
}

// Makes it, for its owner alone.
void make_folder(const fs::path& folder) {
    std::error_code ignored;
    fs::create_directories(folder.parent_path(), ignored);
    mkdir(folder.c_str(), 0700);
    if (auto status = fs::status(folder, ignored); (status.permissions() & fs::perms(077)) != fs::perms::none)
        fs::permissions(folder, fs::perms::owner_all, ignored);
}

bool write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        ssize_t done = write(file, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) return false;
        bytes.remove_prefix(static_cast<size_t>(done));
    }
    return true;
}

}  // namespace

std::string cache_folder() {
    if (cache_limit() == 0) return "";
    return user_folder("XDG_CACHE_HOME", ".cache");
}

Result<uint64_t> read_cache_limit() {
    constexpr uint64_t k_most = 1 << 20;
    const char* said = std::getenv("FLANEUR_CACHE_MAX");
    if (!said) return k_usual_cache_limit;
    std::string_view text = said;
    uint64_t mebibytes = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mebibytes);
    if (error == std::errc::invalid_argument || end != text.data() + text.size())
        return Error{"FLANEUR_CACHE_MAX is " + excerpt(text) +
                     "; it must be a whole number of MiB, 0 to keep nothing."};
    return std::min(error == std::errc() ? mebibytes : k_most, k_most) << 20;
}

uint64_t cache_limit() {
    Result<uint64_t> said = read_cache_limit();
    return said ? *said : k_usual_cache_limit;
}

Result<CacheStatus> cache_status(const std::string& folder) {
    CacheStatus status;
    std::error_code failed;
    for (const KeptFile& file : files_in(folder, failed)) ++status.files, status.bytes += file.bytes;
    if (failed) return Error{"Cannot look into " + folder + ": " + failed.message() + "."};
    return status;
}

Result<CacheStatus> clear_cache(const std::string& folder) {
    CacheStatus removed;
    std::error_code failed;
    std::vector<KeptFile> files = files_in(folder, failed);
    if (failed) return Error{"Cannot look into " + folder + ": " + failed.message() + "."};
    for (const KeptFile& file : files) {
        if (fs::remove(file.path, failed)) ++removed.files, removed.bytes += file.bytes;
        if (failed) return Error{"Cannot remove " + file.path.string() + ": " + failed.message() + "."};
    }
    return removed;
}

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
    if (!whole) return std::nullopt;
    utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // used now
    return bytes;
}

void keep(const std::string& path, uint64_t key, std::string_view bytes, uint64_t limit) {
    Head head;
    if (bytes.size() + sizeof head > limit) return;
    fs::path folder = fs::path(path).parent_path();
    make_folder(folder);
    static std::atomic<int> number{0};
    std::string part = path + "." + std::to_string(getpid()) + "-" + std::to_string(number++) + ".part";
    head.key = key;
    head.size = bytes.size();
    head.hash = hash_bytes(key, bytes.data(), bytes.size());
    int file = open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (file < 0) return;
    bool whole =
        write_all(file, {reinterpret_cast<const char*>(&head), sizeof head}) && write_all(file, bytes);
    whole = close(file) == 0 && whole;
    std::error_code failed, ignored;
    if (whole) fs::rename(part, path, failed);
    if (!whole || failed) fs::remove(part, ignored);
    make_room(folder, limit);
}

}  // namespace flaneur
