#include "tools/rendercheck/check/things.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace flaneur {
namespace {

using Json = nlohmann::json;

constexpr size_t k_most_told = 8;
constexpr int64_t k_not_numbered = 1048575;

std::string name_of(const Json& thing) {
    const std::string kind = thing.value("kind", "thing"), what = thing.value("what", "");
    const int64_t number = thing.value("number", k_not_numbered);
    std::string name = what.empty() ? kind : what;
    if (kind == "nothing") return "sky";
    if (kind != "ground" && number != k_not_numbered) name += " " + std::to_string(number);
    return name;
}

std::string name_in(const IdPicture& picture, uint32_t id) {
    const auto found = picture.names.find(id);
    return found == picture.names.end() ? "thing " + std::to_string(id) : found->second;
}

std::map<uint32_t, size_t> counted(const IdPicture& picture) {
    std::map<uint32_t, size_t> out;
    for (uint32_t id : picture.ids) ++out[id];
    return out;
}

// "walker 12 (38), house 3 (2)", most first.
std::string told_counts(const std::map<std::string, size_t>& counts, size_t most) {
    std::vector<std::pair<std::string, size_t>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    std::string out;
    for (size_t n = 0; n < std::min(sorted.size(), most); ++n)
        out += (n ? ", " : "") + sorted[n].first + " (" + std::to_string(sorted[n].second) + ")";
    if (sorted.size() > most) out += ", and " + std::to_string(sorted.size() - most) + " more";
    return out;
}

}  // namespace

std::string short_legend(const std::string& legend) {
    const Json read = Json::parse(legend, nullptr, false);
    if (!read.is_object() || !read.contains("things") || !read["things"].is_array()) return "";
    Json things = Json::array();
    for (const Json& thing : read["things"]) {
        if (!thing.is_object()) return "";
        Json kept = Json::object();
        for (const char* key : {"id", "kind", "number", "what"})
            if (thing.contains(key)) kept[key] = thing[key];
        things.push_back(std::move(kept));
    }
    return Json{{"things", things}}.dump() + "\n";
}

bool read_ids(const std::vector<uint8_t>& file, const std::string& legend, IdPicture& to) {
    const Result<CheckedPicture> picture = read_picture(file);
    if (!picture || picture->precision == Precision::sixteen) return false;
    to.width = picture->width;
    to.ids.resize(picture->rgba.size() / 4);
    for (size_t i = 0; i < to.ids.size(); ++i)
        to.ids[i] = picture->deep.empty() ? picture->rgba[4 * i] + 256u * picture->rgba[4 * i + 1] +
                                                65536u * picture->rgba[4 * i + 2]
                    : std::isfinite(picture->deep[4 * i])
                        ? static_cast<uint32_t>(std::clamp(picture->deep[4 * i], 0.0f, 4.0e9f))
                        : 0;
    const Json read = Json::parse(legend, nullptr, false);
    if (!read.is_object() || !read.contains("things") || !read["things"].is_array()) return false;
    try {
        for (const Json& thing : read["things"]) to.names[thing.at("id").get<uint32_t>()] = name_of(thing);
    } catch (const Json::exception&) {
        return false;
    }
    return true;
}

std::vector<std::string> told_things(const Judgement& judgement, const IdPicture& now,
                                     const IdPicture* before) {
    std::vector<std::string> out;
    if (judgement.differences.size() != now.ids.size()) return out;
    if (before && before->ids.size() != now.ids.size()) before = nullptr;
    if (before) {
        const std::map<uint32_t, size_t> here = counted(now), there = counted(*before);
        std::map<std::string, size_t> missing, added, moved;
        for (const auto& [id, count] : there)
            if (!here.contains(id)) missing[name_in(*before, id)] = count;
        for (const auto& [id, count] : here)
            if (!there.contains(id)) added[name_in(now, id)] = count;
        for (size_t i = 0; i < now.ids.size(); ++i)
            if (now.ids[i] != before->ids[i] && here.contains(before->ids[i]) && there.contains(now.ids[i]))
                ++moved[name_in(now, now.ids[i])];
        if (!missing.empty())
            out.push_back("Gone from the picture: " + told_counts(missing, k_most_told) + ".");
        if (!added.empty()) out.push_back("New in the picture: " + told_counts(added, k_most_told) + ".");
        if (!moved.empty()) out.push_back("Elsewhere than before: " + told_counts(moved, k_most_told) + ".");
    }
    for (size_t n = 0; n < std::min<size_t>(judgement.boxes.size(), 6); ++n) {
        const PixelBox& box = judgement.boxes[n].box;
        std::map<std::string, size_t> there;
        for (int y = box.top; y < box.top + box.height; ++y)
            for (int x = box.left; x < box.left + box.width; ++x) {
                const size_t i =
                    static_cast<size_t>(y) * static_cast<size_t>(now.width) + static_cast<size_t>(x);
                if (!(judgement.differences[i] > judgement.limit)) continue;
                ++there[name_in(now, now.ids[i])];
                if (before && before->ids[i] != now.ids[i])
                    ++there[name_in(*before, before->ids[i]) + " before"];
            }
        out.push_back("At " + std::to_string(box.left) + "," + std::to_string(box.top) + ": " +
                      told_counts(there, 5) + ".");
    }
    return out;
}

}  // namespace flaneur
