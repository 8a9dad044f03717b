#include "assets/look.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/scene.h"

namespace flaneur {

namespace {

bool parse_point(std::string_view text, Vec3& to) {
    auto parts = split(text, ',');
    constexpr float k_far = 1e6f;
    float* values[] = {&to.x, &to.y, &to.z};
    if (parts.size() != 3) return false;
    for (size_t i = 0; i < 3; ++i) {
        if (!parse_number(parts[i], *values[i]) || !(*values[i] >= -k_far && *values[i] <= k_far))
            return false;
    }
    return true;
}

// Digits with a sign and a point at most, not in the words and powers that numbers may be written in.
bool is_plain(std::string_view text) {
    const size_t first = text.starts_with('-');
    return text.size() > first && text[first] != '.' &&
           text.find_first_not_of("0123456789.", first) == std::string_view::npos;
}

// "map" or "map:X,Z,ACROSS[,BEARING]".
bool parse_map(std::string_view text, CameraChoice& to) {
    constexpr float k_far = 1e6f, k_round = 360;
    if (text == "map") return true;
    if (!text.starts_with("map:")) return false;
    const auto parts = split(text.substr(4), ',');
    if (parts.size() != 3 && parts.size() != 4) return false;
    if (!std::all_of(parts.begin() + 2, parts.end(), is_plain)) return false;
    const bool are_numbers = parse_number(parts[0], to.middle.x) && parse_number(parts[1], to.middle.z) &&
                             parse_number(parts[2], to.across) &&
                             (parts.size() == 3 || parse_number(parts[3], to.bearing));
    return are_numbers && std::fabs(to.middle.x) <= k_far && std::fabs(to.middle.z) <= k_far &&
           to.across >= k_least_across && to.across <= k_most_across && std::fabs(to.bearing) <= k_round;
}

// "eyes:12" after `word`, "eyes:".
bool parse_walker(std::string_view text, std::string_view word, uint32_t& to) {
    return text.starts_with(word) && parse_number(text.substr(word.size()), to) && to < k_max_walkers;
}

}  // namespace

float fov_of(double degrees) { return static_cast<float>(degrees * (3.14159265358979323846 / 180)); }

std::string told_fov(float radians) {
    const double degrees = static_cast<double>(radians) * (180 / 3.14159265358979323846);
    char text[40];
    for (int digits = 1; digits <= 17; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, degrees);
        if (fov_of(std::strtod(text, nullptr)) == radians) break;
    }
    return text;
}

Result<float> parse_fov(const std::string& text) {
    double degrees = 0;
    if (parse_number(text, degrees) && degrees >= k_least_fov && degrees <= k_most_fov)
        return fov_of(degrees);
    return Error{
        excerpt(text) +
        " is not a field of view from 1 to 150 degrees, from the lower border to the upper one, such "
        "as 32, the usual one"};
}

Result<CameraChoice> parse_camera(const std::string& text) {
    CameraChoice camera;
    if (text == "street") return camera;
    camera.kind = CameraChoice::Kind::overview;
    if (text == "overview") return camera;
    camera.kind = CameraChoice::Kind::crowd;
    if (text == "crowd") return camera;
    camera.kind = CameraChoice::Kind::follow;
    if (parse_walker(text, "follow:", camera.walker)) return camera;
    camera.kind = CameraChoice::Kind::eyes;
    if (parse_walker(text, "eyes:", camera.walker)) return camera;
    camera.kind = CameraChoice::Kind::map;
    if (parse_map(text, camera)) return camera;
    camera = {CameraChoice::Kind::fixed, 0, {}, {}};
    auto points = split(text, '/');
    if (points.size() == 2 && parse_point(points[0], camera.eye) && parse_point(points[1], camera.target)) {
        if (length(camera.target - camera.eye) > 1e-3f) return camera;
        return Error{excerpt(text) + " looks at where it stands; eye and target must differ"};
    }
    if (text.starts_with("map"))
        return Error{excerpt(text) +
                     " is no map: say map, or map:X,Z,ACROSS with its middle and 5 to 20000 metres from left "
                     "to right, or map:X,Z,ACROSS,BEARING with the degrees clockwise from north that are up"};
    return Error{excerpt(text) +
                 " is none of overview, street, crowd, follow:ID and eyes:ID (a walker's number), map, "
                 "map:X,Z,ACROSS and EX,EY,EZ/TX,TY,TZ (metres)"};
}

Result<Vec3> parse_spot(const std::string& text) {
    Vec3 place;
    if (parse_point(text, place)) return place;
    return Error{excerpt(text) + " is not a place X,Y,Z in metres, such as 12.5,0,-3"};
}

std::string told_spot(Vec3 v) { return plainly(v.x) + "," + plainly(v.y) + "," + plainly(v.z); }

uint32_t rivals_of(WorkView view) {
    auto bit = [](WorkView v) { return 1u << static_cast<int>(v); };
    using enum WorkView;
    for (uint32_t group : {bit(wireframe) | bit(normals) | bit(overdraw), bit(lods) | bit(speed),
                           bit(density) | bit(walkable)})
        if (group & bit(view)) return group & ~bit(view);
    return 0;
}

WorkViews toggled(WorkViews views, WorkView view) {
    views.mask &= ~rivals_of(view);
    views.mask ^= 1u << static_cast<int>(view);
    return views;
}

Result<WorkViews> parse_work_views(const std::vector<std::string>& names) {
    WorkViews views;
    for (const std::string& name : names) {
        const auto* at = std::find(std::begin(k_work_view_names), std::end(k_work_view_names), name);
        if (at == std::end(k_work_view_names))
            return Error{excerpt(name) + " is no view; there are " + joined(k_work_view_names)};
        const auto view = static_cast<WorkView>(at - std::begin(k_work_view_names));
        if (views.mask & rivals_of(view))
            return Error{joined(names) +
                         " ask for too much at once: one of wireframe, normals and overdraw, one of lods and "
                         "speed, one of density and walkable"};
        views.mask |= 1u << static_cast<int>(view);
    }
    return views;
}

Result<Size> parse_size(const std::string& text) {
    constexpr int k_most = 8192;
    auto parts = split(text, 'x');
    Size size;
    if (parts.size() == 2 && parse_number(parts[0], size.width) && parse_number(parts[1], size.height) &&
        size.width >= 1 && size.width <= k_most && size.height >= 1 && size.height <= k_most)
        return size;
    return Error{excerpt(text) + " is not a width and a height from 1 to 8192, such as 1280x720"};
}

Result<MapPlace> parse_place(const std::string& text) {
    auto parts = split(text, ',');
    MapPlace place;
    // "52.5163, 13.3777", as sites with maps have it copied.
    if (parts.size() == 2) parts[1].remove_prefix(std::min(parts[1].find_first_not_of(' '), parts[1].size()));
    if (parts.size() == 2 && is_plain(parts[0]) && is_plain(parts[1]) &&
        parse_number(parts[0], place.latitude) && parse_number(parts[1], place.longitude) &&
        std::abs(place.latitude) <= 90 && std::abs(place.longitude) <= 180)
        return place;
    return Error{excerpt(text) +
                 " is not a latitude from -90 to 90 and a longitude from -180 to 180 in degrees, such as "
                 "52.5163,13.3777"};
}

Result<float> parse_time(const std::string& text) {
    // About when the sun rises, stands highest and sets on the day that it is of, and long after.
    for (auto [word, hour] : {std::pair{"dawn", 6.5f}, {"noon", 13.25f}, {"dusk", 20.25f}, {"night", 23.0f}})
        if (text == word) return hour;
    auto digit = [&](size_t i) { return text[i] >= '0' && text[i] <= '9' ? text[i] - '0' : 99; };
    bool shaped = text.size() == 5 && text[2] == ':';
    int hours = shaped ? digit(0) * 10 + digit(1) : 99, minutes = shaped ? digit(3) * 10 + digit(4) : 99;
    if (hours > 23 || minutes > 59)
        return Error{excerpt(text) +
                     " is not a time from 00:00 to 23:59, such as 17:30, or dawn, noon, dusk or night"};
    return static_cast<float>(hours) + static_cast<float>(minutes) / 60;
}

Result<bool> parse_weather(const std::string& text) {
    if (text == "clear" || text == "overcast") return text == "overcast";
    return Error{excerpt(text) + " is neither clear nor overcast, which weather is"};
}

Result<PassOn> parse_side(const std::string& text) {
    if (text == "right" || text == "left") return text == "right" ? PassOn::right : PassOn::left;
    return Error{excerpt(text) + " is neither right nor left, the sides on which people pass"};
}

Result<std::string> parse_quality(const std::string& text) {
    const auto* at = std::find(std::begin(k_quality_names), std::end(k_quality_names), text);
    if (at != std::end(k_quality_names)) return text;
    return Error{excerpt(text) + " is none of " + joined(k_quality_names)};
}

std::string told_camera(const CameraChoice& camera) {
    auto map = [&] {
        std::string text("map:");
        text.append(plainly(camera.middle.x)).append(",").append(plainly(camera.middle.z));
        text.append(",").append(plainly(camera.across));
        if (camera.bearing != 0) text.append(",").append(plainly(camera.bearing));
        return text;
    };
    switch (camera.kind) {
        case CameraChoice::Kind::overview:
            return "overview";
        case CameraChoice::Kind::street:
            return "street";
        case CameraChoice::Kind::crowd:
            return "crowd";
        case CameraChoice::Kind::follow:
            return "follow:" + std::to_string(camera.walker);
        case CameraChoice::Kind::eyes:
            return "eyes:" + std::to_string(camera.walker);
        case CameraChoice::Kind::map:
            if (camera.across == 0) return "map";
            return map();
        default:
            return told_spot(camera.eye) + "/" + told_spot(camera.target);
    }
}

std::vector<std::string> names_of(WorkViews views) {
    std::vector<std::string> names;
    for (int view = 0; view < k_work_views; ++view)
        if (views[static_cast<WorkView>(view)]) names.emplace_back(k_work_view_names[view]);
    return names;
}

}  // namespace flaneur
