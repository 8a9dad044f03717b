#include "tools/flaneur/view/ids.h"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

#include "tools/extract/ids.h"
#include "tools/flaneur/output/channels.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array k_kind_names = {"nothing", "ground",  "house",  "wall",     "tree",    "car",
                                     "prop",    "scenery", "walker", "creature", "exhibit", "mover"};
static_assert(k_kind_names.size() == static_cast<size_t>(IdKind::mover) + 1);
constexpr std::array k_surface_names = {"road",  "sidewalk", "crossing", "plaza", "path",
                                        "steps", "grass",    "water",    "track", "kerb"};
static_assert(k_surface_names.size() == k_surface_count + 1 && k_kerb_number == k_surface_count);
constexpr std::array k_prop_names = {"tree",     "lamp",   "bench",   "bollard", "bin",     "car",
                                     "fountain", "statue", "planter", "signal",  "shelter", "barrier"};
static_assert(k_prop_names.size() == k_prop_count);

struct Seen {
    uint32_t pixels = 0;
    int left, upper, right, lower;  // of the box, ends included
};

std::map<uint32_t, Seen> seen_in(const std::vector<uint32_t>& ids, Size size) {
    std::map<uint32_t, Seen> seen;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const size_t at =
                static_cast<size_t>(y) * static_cast<size_t>(size.width) + static_cast<size_t>(x);
            Seen& one = seen.try_emplace(ids[at], Seen{0, x, y, x, y}).first->second;
            ++one.pixels;
            one.left = std::min(one.left, x), one.right = std::max(one.right, x), one.lower = y;
        }
    return seen;
}

// What kind of ground or prop; null where there is no more to say.
const char* what_is(IdKind kind, uint32_t number, const City& city) {
    if (kind == IdKind::ground && number < k_surface_names.size()) return k_surface_names[number];
    if (kind == IdKind::prop && number < city.props.size())
        return k_prop_names[static_cast<size_t>(city.props[number].kind)];
    return nullptr;
}

}  // namespace

std::string legend_of(const std::vector<uint32_t>& ids, Size size, const City& city) {
    std::string text = "{\n \"width\": " + std::to_string(size.width) +
                       ",\n \"height\": " + std::to_string(size.height) + ",\n \"things\": [";
    const char* before = "\n  ";
    for (const auto& [id, seen] : seen_in(ids, size)) {
        const IdKind kind = kind_of_id(id);
        const uint32_t number = number_of_id(id);
        Json thing = {{"id", id}, {"kind", k_kind_names[static_cast<size_t>(kind)]}, {"number", number}};
        if (const char* what = what_is(kind, number, city)) thing["what"] = what;
        thing["pixels"] = seen.pixels;
        thing["box"] = {seen.left, seen.upper, seen.right - seen.left + 1, seen.lower - seen.upper + 1};
        text.append(std::exchange(before, ",\n  ")).append(thing.dump());
    }
    return text + "\n ]\n}\n";
}

Result<ChannelFiles> open_channels(const std::string& depth, const std::string& ids) {
    ChannelFiles files;
    auto open = [](const std::string& path, PartFilePtr& file) -> Result<void> {
        if (path.empty()) return {};
        Result<PartFilePtr> opened = open_file(path);
        if (!opened) return opened.error();
        file = std::move(*opened);
        return {};
    };
    if (Result<void> done = open(depth, files.depths); !done) return done.error();
    if (Result<void> done = open(ids, files.ids); !done) return done.error();
    if (Result<void> done = open(ids.empty() ? ids : legend_path(ids), files.legend); !done)
        return done.error();
    return files;
}

Result<void> write_channels(ChannelFiles files, const Image& image, const City& city) {
    const Size size{static_cast<int>(image.width), static_cast<int>(image.height)};
    if (files.depths) {
        if (Result<void> done = write_depths(std::move(files.depths), image.depths, size); !done) return done;
    }
    if (!files.ids) return {};
    if (Result<void> done = write_file(std::move(files.legend), legend_of(image.ids, size, city)); !done)
        return done;
    return write_ids(std::move(files.ids), image.ids, size);
}

}  // namespace flaneur
