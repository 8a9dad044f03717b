#include "tools/flaneur/measure/plan.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "assets/files/file.h"
#include "assets/files/words.h"

namespace flaneur {
namespace {

using Json = nlohmann::ordered_json;

constexpr float k_farthest = 1e6f;  // metres
constexpr size_t k_longest_name = 32;
constexpr const char* k_line_form =
    " is no line X1,Z1/X2,Z2 in metres, such as 3,-4/8,-4, with NAME: before it if it is to have one";
constexpr const char* k_zone_form =
    " is no zone X,Z/X,Z/X,Z... in metres, such as 0,0/8,0/8,5/0,5, with NAME: before it if it is to have "
    "one";

// Whether `p`, on the line through `a` and `b`, lies between them.
bool is_between(Vec2 a, Vec2 b, Vec2 p) {
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.z, b.z) <= p.z &&
           p.z <= std::max(a.z, b.z);
}

bool do_touch(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
    const double abc = crossed(a, b, c), abd = crossed(a, b, d), cda = crossed(c, d, a),
                 cdb = crossed(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && is_between(a, b, c)) || (abd == 0 && is_between(a, b, d)) ||
           (cda == 0 && is_between(c, d, a)) || (cdb == 0 && is_between(c, d, b));
}

bool is_name(std::string_view name) {
    return !name.empty() && name.size() <= k_longest_name &&
           std::all_of(name.begin(), name.end(),
                       [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; });
}

bool is_far(Vec2 p) {
    return !(std::fabs(p.x) <= k_farthest && std::fabs(p.z) <= k_farthest);  // no number is far too
}

// The name before a colon is cut off `text`. False if it is none.
bool take_name(std::string_view& text, std::string& name) {
    const size_t colon = text.find(':');
    if (colon == std::string_view::npos) return true;
    name = text.substr(0, colon);
    text.remove_prefix(colon + 1);
    return is_name(name);
}

bool parse_places(std::string_view text, std::vector<Vec2>& places) {
    for (std::string_view part : split(text, '/')) {
        const std::vector<std::string_view> numbers = split(part, ',');
        Vec2 place;
        if (numbers.size() != 2 || !parse_number(numbers[0], place.x) || !parse_number(numbers[1], place.z) ||
            is_far(place))
            return false;
        places.push_back(place);
    }
    return true;
}

// What is wrong with it, as the end of a sentence; null: nothing.
const char* fault_of(const CountLine& line) {
    return length_of(line) < k_least_line ? " is a line of less than 5 cm" : nullptr;
}
const char* fault_of(const CountZone& zone) {
    if (zone.corners.size() < 3 || zone.corners.size() > k_most_corners)
        return " is a zone of fewer than 3 or more than 200 corners";
    if (!is_simple(zone.corners)) return " is a zone whose outline crosses or touches itself";
    if (area_of(zone.corners) < static_cast<double>(k_least_zone))
        return " is a zone of less than 0.05 square metres";
    return nullptr;
}

std::string told_place(Vec2 p) {
    std::string text = plainly(p.x);
    return text.append(",").append(plainly(p.z));
}
std::string told_name(const std::string& name) { return name.empty() ? std::string() : name + ":"; }

std::string json_of(Vec2 p) {
    std::string text = "[";
    return text.append(plainly(p.x)).append(", ").append(plainly(p.z)).append("]");
}
bool read_place(const Json& json, Vec2& to) {
    if (!json.is_array() || json.size() != 2 || !json[0].is_number() || !json[1].is_number()) return false;
    to = {json[0].get<float>(), json[1].get<float>()};
    return !is_far(to);
}
bool read_name(const Json& json, std::string& to) {
    if (!json.is_object()) return false;
    if (!json.contains("name")) return true;
    if (!json["name"].is_string()) return false;
    to = json["name"].get<std::string>();
    return is_name(to);
}

}  // namespace

float length_of(const CountLine& line) { return length(line.b - line.a); }

bool is_simple(std::span<const Vec2> corners) {
    const size_t n = corners.size();
    for (size_t i = 0; i < n; ++i) {
        const Vec2 a = corners[i], b = corners[(i + 1) % n], c = corners[(i + 2) % n];
        if (a == b) return false;
        // Two edges that meet must not fold back over each other.
        if (crossed(a, b, c) == 0 && dot(b - a, c - b) < 0) return false;
        for (size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && do_touch(a, b, corners[j], corners[(j + 1) % n])) return false;
    }
    return true;
}

// Ears are cut off one after the other (Meisters, American Mathematical Monthly 82, 1975).
std::vector<uint32_t> fill_of(std::span<const Vec2> corners) {
    std::vector<uint32_t> left(corners.size()), triangles;
    double twice = 0;
    for (uint32_t i = 0; i < left.size(); ++i) {
        left[i] = i;
        if (i > 1) twice += crossed(corners[0], corners[i - 1], corners[i]);
    }
    if (twice < 0) std::reverse(left.begin(), left.end());
    auto is_ear = [&](size_t at) {
        const size_t n = left.size();
        const uint32_t i = left[(at + n - 1) % n], k = left[at], l = left[(at + 1) % n];
        const Vec2 a = corners[i], b = corners[k], c = corners[l];
        if (crossed(a, b, c) <= 0) return false;
        return std::none_of(left.begin(), left.end(), [&](uint32_t other) {
            const Vec2 p = corners[other];
            return other != i && other != k && other != l && crossed(a, b, p) >= 0 && crossed(b, c, p) >= 0 &&
                   crossed(c, a, p) >= 0;
        });
    };
    while (left.size() >= 3) {
        size_t at = 0;
        while (at < left.size() && !is_ear(at)) ++at;
        if (at == left.size()) at = 0;  // only corners on one line are left, or all but that
        const size_t n = left.size();
        triangles.insert(triangles.end(), {left[(at + n - 1) % n], left[at], left[(at + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    return triangles;
}

Result<CountLine> parse_count_line(const std::string& text) {
    CountLine line;
    std::string_view rest = text;
    std::vector<Vec2> places;
    if (!take_name(rest, line.name) || !parse_places(rest, places) || places.size() != 2)
        return Error{excerpt(text) + k_line_form};
    line.a = places[0], line.b = places[1];
    if (const char* fault = fault_of(line)) return Error{excerpt(text) + fault};
    return line;
}

Result<CountZone> parse_count_zone(const std::string& text) {
    CountZone zone;
    std::string_view rest = text;
    if (!take_name(rest, zone.name) || !parse_places(rest, zone.corners) || zone.corners.size() < 3)
        return Error{excerpt(text) + k_zone_form};
    if (const char* fault = fault_of(zone)) return Error{excerpt(text) + fault};
    return zone;
}

std::string told(const CountLine& line) {
    std::string text = told_name(line.name);
    return text.append(told_place(line.a)).append("/").append(told_place(line.b));
}

std::string told(const CountZone& zone) {
    std::string text = told_name(zone.name);
    for (size_t i = 0; i < zone.corners.size(); ++i)
        text.append(i > 0 ? "/" : "").append(told_place(zone.corners[i]));
    return text;
}

Result<void> name_all(MeasurePlan& plan) {
    std::set<std::string> names;
    for (const auto& line : plan.lines)
        if (!line.name.empty() && !names.insert(line.name).second)
            return Error{"Two are called " + line.name};
    for (const auto& zone : plan.zones)
        if (!zone.name.empty() && !names.insert(zone.name).second)
            return Error{"Two are called " + zone.name};
    auto name = [&](std::string& to, char letter) {
        for (int number = 1; to.empty() || !names.insert(to).second; ++number)
            to = std::string(1, letter).append(std::to_string(number));
    };
    for (auto& line : plan.lines)
        if (line.name.empty()) name(line.name, 'L');
    for (auto& zone : plan.zones)
        if (zone.name.empty()) name(zone.name, 'Z');
    return {};
}

// Names need no quotation.
std::string plan_json(const MeasurePlan& plan) {
    std::vector<std::string> lines, zones;
    for (const CountLine& line : plan.lines) {
        std::string& text = lines.emplace_back("{\"name\": \"" + line.name);
        text.append("\", \"from\": ").append(json_of(line.a)).append(", \"to\": ").append(json_of(line.b));
        text.append("}");
    }
    for (const CountZone& zone : plan.zones) {
        std::vector<std::string> corners;
        for (Vec2 corner : zone.corners) corners.push_back(json_of(corner));
        std::string& text = zones.emplace_back("{\"name\": \"" + zone.name);
        text.append("\", \"corners\": [").append(joined(corners)).append("]}");
    }
    std::string text = "{\n  \"lines\": [";
    auto add = [&text](const std::vector<std::string>& all) {
        for (size_t i = 0; i < all.size(); ++i) text.append(i > 0 ? ",\n    " : "\n    ").append(all[i]);
    };
    add(lines);
    text.append("\n  ],\n  \"zones\": [");
    add(zones);
    return text.append("\n  ]\n}\n");
}

Result<MeasurePlan> parse_plan(std::string_view text, const std::string& name) {
    constexpr size_t k_deepest = 8, k_most_values = 100'000;
    auto refused = [&](const std::string& what) { return Error{excerpt(name) + " " + what + "."}; };
    if (Result<void> checked = check_json(text, k_deepest, k_most_values); !checked)
        return refused(checked.error().message);
    const Json json = Json::parse(text, nullptr, false);
    const std::string form =
        "holds no lines and zones as the window's room Measure writes them: {\"lines\": [{\"name\": \"L1\", "
        "\"from\": [x, z], \"to\": [x, z]}], \"zones\": [{\"name\": \"Z1\", \"corners\": [[x, z], ...]}]}";
    if (!json.is_object()) return refused(form);
    MeasurePlan plan;
    for (const Json& one : json.value("lines", Json::array())) {
        CountLine line;
        if (!read_name(one, line.name) || !one.contains("from") || !one.contains("to") ||
            !read_place(one["from"], line.a) || !read_place(one["to"], line.b))
            return refused(form);
        if (const char* fault = fault_of(line)) return refused("says: " + told(line) + fault);
        plan.lines.push_back(std::move(line));
    }
    for (const Json& one : json.value("zones", Json::array())) {
        CountZone zone;
        if (!read_name(one, zone.name) || !one.contains("corners")) return refused(form);
        for (const Json& corner : one["corners"])
            if (!read_place(corner, zone.corners.emplace_back())) return refused(form);
        if (const char* fault = fault_of(zone)) return refused("says: " + excerpt(told(zone)) + fault);
        plan.zones.push_back(std::move(zone));
    }
    if (Result<void> named = name_all(plan); !named) return refused("says: " + named.error().message);
    return plan;
}

Result<MeasurePlan> read_plan(const std::string& path) {
    constexpr size_t k_most = 4 << 20;
    const Result<Bytes> bytes = read_bytes(path, k_most);
    if (!bytes) return Error{excerpt(path) + " " + bytes.error().message};
    return parse_plan({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

}  // namespace flaneur
