#include "tools/flaneur/window/open/complete.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include "assets/files/file.h"

namespace flaneur {

namespace fs = std::filesystem;

namespace {

bool can_be_opened(const std::string& name) {
    if (kind_of(name) != FileKind::other) return true;
    for (const char* ending : {".json", ".hgt", ".hgt.zip", ".tif", ".tiff"})
        if (has_ending(name, ending)) return true;
    return false;
}

}  // namespace

std::string full_path(const std::string& typed) {
    const char* home = std::getenv("HOME");
    const bool is_at_home = home && (typed == "~" || typed.starts_with("~/"));
    const fs::path path = is_at_home ? home + typed.substr(1) : typed;
    std::error_code error;
    const fs::path full = fs::absolute(path, error);
    return error ? path.string() : full.lexically_normal().string();
}

std::string folder_above(const std::string& typed) {
    const size_t slash = typed.rfind('/');
    const fs::path folder = full_path(slash == std::string::npos ? "." : typed.substr(0, slash + 1));
    const fs::path plain = folder.has_filename() ? folder : folder.parent_path();  // with no / behind it
    if (!plain.has_relative_path()) return "";
    const std::string above = plain.parent_path().string();
    return above.ends_with('/') ? above : above + "/";
}

std::vector<std::string> completions(const std::string& typed, size_t most) {
    const size_t slash = typed.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : typed.substr(0, slash + 1);
    const std::string begun = typed.substr(folder.size());
    std::vector<std::string> folders, files;
    std::error_code error;
    for (fs::directory_iterator at(full_path(folder.empty() ? "." : folder), error), end; !error && at != end;
         at.increment(error)) {
        const std::string name = at->path().filename().string();
        if (!name.starts_with(begun) || (name.starts_with('.') && begun.empty())) continue;
        std::error_code unknown;
        if (at->is_directory(unknown))
            folders.push_back(folder + name + "/");
        else if (can_be_opened(name) && at->is_regular_file(unknown))
            files.push_back(folder + name);
    }
    std::sort(folders.begin(), folders.end());
    std::sort(files.begin(), files.end());
    folders.insert(folders.end(), files.begin(), files.end());
    if (folders.size() > most) folders.resize(most);
    return folders;
}

std::string completed(const std::string& typed, const std::vector<std::string>& found) {
    if (found.empty()) return typed;
    std::string_view shared = found.front();
    for (const std::string_view other : found)
        shared = shared.substr(
            0, static_cast<size_t>(
                   std::mismatch(shared.begin(), shared.end(), other.begin(), other.end()).first -
                   shared.begin()));
    return shared.size() > typed.size() ? std::string(shared) : typed;
}

}  // namespace flaneur
