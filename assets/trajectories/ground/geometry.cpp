#include "assets/trajectories/geometry.h"

#include <algorithm>
#include <filesystem>

#include "assets/files/file.h"
#include "assets/trajectories/wkt.h"

namespace flaneur {
namespace {

constexpr size_t k_most_beside = 10'000;     // files of a folder that are looked at
constexpr size_t k_most_mentions = 1 << 20;  // bytes of a file in which a name is looked for
constexpr size_t k_least_fit = 3;            // letters

// How far both begin the same, up to the end of a word.
size_t fit_of(std::string_view a, std::string_view b) {
    size_t same = 0, words = 0;
    const auto is_end = [](std::string_view text, size_t at) {
        return at == text.size() || text[at] == '_' || text[at] == '-' || text[at] == '.' || text[at] == ' ';
    };
    while (same < a.size() && same < b.size() && a[same] == b[same]) {
        ++same;
        if (is_end(a, same) && is_end(b, same)) words = same;
    }
    return words;
}

bool file_mentions(const std::string& path, const std::string& name) {
    const Result<Bytes> bytes = read_bytes(path, k_most_mentions);
    if (!bytes) return false;
    const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    return text.find("\"" + name + "\"") != std::string_view::npos;
}

}  // namespace

Result<WalkableGeometry> parse_geometry(std::string_view text) {
    const std::string_view head = text.substr(0, 16'384);
    const size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string_view::npos) return Error{"is empty"};
    auto has = [&](std::string_view what) { return head.find(what) != std::string_view::npos; };
    if (head[first] == '{') return parse_vadere_scenario(text);
    if (head[first] == '<') {
        if (has("<geometry")) return parse_jps_geometry(text);
        if (has("<net")) return parse_sumo_net(text);
        if (has("<floor") || has("<layer")) return parse_floor(text);
        return Error{"is no geometry of JuPedSim, SUMO or crowd:it"};
    }
    if (head[first] != 'P' && head[first] != 'M')
        return Error{
            "is no well-known text, no geometry of JuPedSim, no net of SUMO, no scenario of Vadere and no "
            "floor of crowd:it"};
    Result<std::vector<WalkablePolygon>> area = parse_wkt(text);
    if (!area) return area.error();
    WalkableGeometry geometry;
    geometry.area = std::move(*area);
    return geometry;
}

std::string geometry_beside(const std::string& path, std::string_view ending, std::string_view mentioned) {
    namespace fs = std::filesystem;
    const fs::path own(path);
    const std::string name = own.filename().string();
    const fs::path folder = own.has_parent_path() ? own.parent_path() : fs::path(".");
    std::vector<std::string> names;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        std::string other = at->path().filename().string();
        std::error_code ignored;
        if (other != name && has_ending(other, ending) && at->is_regular_file(ignored))
            names.push_back(std::move(other));
        if (names.size() > k_most_beside) return {};
    }
    std::sort(names.begin(), names.end());
    if (const size_t slash = mentioned.rfind('/'); slash != std::string_view::npos)
        mentioned.remove_prefix(slash + 1);
    auto beside = [&](const std::string& found) { return (folder / found).string(); };
    for (const std::string& other : names)
        if (other == mentioned) return beside(other);
    for (const std::string& other : names)
        if (mentioned.size() > k_least_fit && other.ends_with(mentioned)) return beside(other);
    const std::string* best = nullptr;
    size_t fit = 0;
    for (const std::string& other : names) {
        if (ending == ".scenario" && file_mentions(beside(other), name)) return beside(other);
        // A net's whole name begins that of its output; outlines are called the same.
        const std::string_view stem(other.data(), other.size() - ending.size());
        const size_t same = fit_of(stem, name);
        if (same == stem.size() && same >= k_least_fit && same > fit) best = &other, fit = same;
    }
    if (best) return beside(*best);
    const bool is_of_one_run = ending != ".xml" && ending != ".wkt";
    return is_of_one_run && names.size() == 1 ? beside(names[0]) : std::string();
}

}  // namespace flaneur
