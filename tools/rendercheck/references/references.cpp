#include "tools/rendercheck/references/references.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "sim/base/hash.h"

namespace flaneur {

namespace fs = std::filesystem;

std::string golden_folder(const Suite& suite) {
    return (fs::path(suite.folder) / suite.golden).lexically_normal().string();
}

std::vector<std::string> keys_in(const std::string& golden) {
    std::vector<std::string> keys;
    std::error_code failed;
    for (fs::directory_iterator at(golden, failed), end; !failed && at != end; at.increment(failed)) {
        std::error_code ignored;
        if (at->is_directory(ignored)) keys.push_back(at->path().filename().string());
    }
    std::sort(keys.begin(), keys.end());
    return keys;
}

std::string reference_path(const std::string& golden, const std::string& key, const SuiteCase& one,
                           size_t picture) {
    const fs::path file = one.pictures[picture];
    const std::string ending = file.extension() == ".exr" ? ".exr" : ".png";
    const fs::path folder = fs::path(golden) / key;
    if (one.pictures.size() == 1) return (folder / (one.name + ending)).string();
    return (folder / one.name / (file.stem().string() + ending)).string();
}

std::string part_path(const std::string& golden, const std::string& key, const SuiteCase& one,
                      const SuitePart& part) {
    return (fs::path(golden) / key / (one.name + ".parts") / part.name).string();
}

Result<std::vector<uint8_t>> kept_bytes(const CheckedPicture& picture, const std::vector<uint8_t>& file) {
    if (picture.precision != Precision::eight) return file;
    return write_png(picture.rgba, picture.width, picture.height);
}

std::string pixel_hash(const CheckedPicture& picture) {
    uint64_t hash = k_no_bytes;
    auto take = [&hash](const void* bytes, size_t count) {
        hash = sum_bytes(hash, {static_cast<const char*>(bytes), count});
    };
    take(&picture.width, sizeof picture.width);
    take(&picture.height, sizeof picture.height);
    if (picture.deep.empty())
        take(picture.rgba.data(), picture.rgba.size());
    else
        take(picture.deep.data(), picture.deep.size() * sizeof(float));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

}  // namespace flaneur
