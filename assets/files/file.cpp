#include "assets/files/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>

namespace flaneur {

bool has_ending(std::string_view path, std::string_view ending) {
    auto same = [](char a, char b) { return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b); };
    return path.size() >= ending.size() && std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                                                      [&](char e, char p) { return same(p, e); });
}

FileKind kind_of(std::string_view path) {
    for (const char* ending : {".osm", ".pbf", ".osm.gz", ".osm.bz2"})
        if (has_ending(path, ending)) return FileKind::map;
    for (const char* ending : {".glb", ".gltf", ".vrm"})
        if (has_ending(path, ending)) return FileKind::gltf;
    return FileKind::other;
}

Result<void> find_file(const std::string& path) {
    std::error_code error;
    std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::is_regular_file(status)) return {};
    if (std::filesystem::is_directory(status)) return Error{path + " is a folder, where a file is needed."};
    if (std::filesystem::exists(status))
        return Error{path + " is a pipe or a device, where a file is needed: write it to one first."};
    if (!std::filesystem::status_known(status))
        return Error{"Cannot look for the file " + path + ": " + error.message() + "."};
    return Error{"There is no file " + path + "; check the path."};
}

Result<Bytes> read_bytes(const std::string& path, size_t most) {
    struct Descriptor {
        int number;
        ~Descriptor() {
            if (number >= 0) close(number);
        }
    } file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
    struct stat about;
    if (file.number < 0 || fstat(file.number, &about) != 0)
        return Error{"cannot be opened as a file; check the path and its permissions"};
    if (S_ISDIR(about.st_mode)) return Error{"is a folder, where a file is needed"};
    if (!S_ISREG(about.st_mode))
        return Error{"is a pipe or a device, where a file is needed: write it to one first"};
    auto size = static_cast<size_t>(about.st_size);
    if (size > most) {
        std::string limit =
            most < size_t{1} << 20 ? std::to_string(most >> 10) + " kB" : std::to_string(most >> 20) + " MB";
        return Error{"is larger than the " + limit + " that can be taken in; simplify it"};
    }
    Bytes bytes(size);
    for (size_t done = 0; done < size;) {
        ssize_t got = read(file.number, bytes.data() + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return Error{"cannot be read to its end; check the disk"};
        done += static_cast<size_t>(got);
    }
    return bytes;
}

std::string user_folder(const char* variable, const char* usual) {
    namespace fs = std::filesystem;
    const char* named = std::getenv(variable);
    if (named && *named == '/') return (fs::path(named) / "flaneur").string();
    const char* home = std::getenv("HOME");
    return home && *home == '/' ? (fs::path(home) / usual / "flaneur").string() : "";
}

std::string excerpt(std::string_view text) {
    constexpr size_t k_most = 60;
    auto continues = [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
    };  // within a UTF-8 letter
    std::string out(text.substr(0, k_most));
    if (text.size() > k_most) {
        size_t end = k_most - 3;
        while (end > 0 && continues(out[end])) --end;
        out.resize(end);
        out += "...";
    }
    for (char& c : out)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return out;
}

Result<void> check_json(std::string_view json, size_t depth, size_t values) {
    size_t open = 0, seen = 0;
    bool in_text = false;
    for (size_t i = 0; i < json.size(); ++i) {
        char c = json[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
            continue;
        }
        if (c == '"') in_text = true;
        if (c == '[' || c == '{') ++open;
        if ((c == ']' || c == '}') && open > 0) --open;
        if (c == ',' || c == '[' || c == '{') ++seen;
        if (open > depth)
            return Error{"has JSON nested too deep, beyond " + std::to_string(depth) + " levels"};
    }
    if (seen > values)
        return Error{"has more than " + std::to_string(values) + " values in its JSON; simplify it"};
    return {};
}

}  // namespace flaneur
