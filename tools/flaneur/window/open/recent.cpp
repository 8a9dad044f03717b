#include "tools/flaneur/window/open/recent.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/output/output.h"

namespace flaneur {
namespace {

constexpr size_t k_most_bytes = 1 << 16;

// Whether a line of the file can hold it.
bool is_kept(std::string_view path) {
    return path.starts_with('/') && path.size() < 4096 &&
           std::none_of(path.begin(), path.end(), [](unsigned char c) { return c < ' '; });
}

}  // namespace

std::string recent_file() {
    const std::string folder = user_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? "" : folder + "/recent";
}

std::vector<std::string> read_recent(const std::string& file) {
    std::vector<std::string> paths;
    const Result<Bytes> bytes = file.empty() ? Error{""} : read_bytes(file, k_most_bytes);
    if (!bytes) return paths;
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    for (const std::string_view line : split(text, '\n')) {
        const bool is_new = std::find(paths.begin(), paths.end(), line) == paths.end();
        if (is_kept(line) && is_new && paths.size() < k_most_recent) paths.emplace_back(line);
    }
    return paths;
}

void keep_recent(const std::string& file, const std::vector<std::string>& paths) {
    if (file.empty()) return;
    Result<PartFilePtr> part = open_file(file);
    if (!part) return;
    for (const std::string& path : paths) std::fprintf((*part)->file, "%s\n", path.c_str());
    static_cast<void>(keep_file(std::move(*part)));
}

void remember(std::vector<std::string>& paths, const std::string& path) {
    if (!is_kept(path)) return;
    std::erase(paths, path);
    paths.insert(paths.begin(), path);
    if (paths.size() > k_most_recent) paths.resize(k_most_recent);
}

}  // namespace flaneur
