// How values on the command line are read.
#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "tools/flaneur/options.h"

namespace flaneur {

namespace {

template <class T>
bool parse_number(std::string_view text, T& to) {
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
    return error == std::errc() && end == text.data() + text.size();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    for (size_t at = 0;;) {
        size_t next = text.find(separator, at);
        parts.push_back(text.substr(at, next - at));
        if (next == std::string_view::npos) return parts;
        at = next + 1;
    }
}

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

}  // namespace

Result<PeopleShare> parse_people(const std::string& text) {
    PeopleShare people{text};
    size_t colon = text.rfind(':');
    if (colon != std::string::npos && parse_number(std::string_view(text).substr(colon + 1), people.share)) {
        people.character.resize(colon);
        if (!(people.share >= k_least_share && people.share <= k_most_share))
            return Error{"--character " + text + " has a share that is not from 0.001 to 1000."};
    }
    if (people.character.empty()) return Error{"--character " + text + " names no file."};
    if (people.character == "builtin") people.character.clear();
    return people;
}

Result<uint64_t> parse_seed(const std::string& text) {
    uint64_t seed = 0;
    if (parse_number(text, seed)) return seed;
    return Error{"--seed " + text + " is not a whole number from 0 to 18446744073709551615."};
}

Result<CameraChoice> parse_camera(const std::string& text) {
    CameraChoice camera;
    if (text == "street") return camera;
    camera.kind = CameraChoice::Kind::overview;
    if (text == "overview") return camera;
    constexpr std::string_view k_follow = "follow:";
    camera.kind = CameraChoice::Kind::follow;
    if (text.starts_with(k_follow) &&
        parse_number(std::string_view(text).substr(k_follow.size()), camera.walker))
        return camera;
    camera.kind = CameraChoice::Kind::fixed;
    auto points = split(text, '/');
    if (points.size() == 2 && parse_point(points[0], camera.eye) && parse_point(points[1], camera.target)) {
        if (length(camera.target - camera.eye) > 1e-3f) return camera;
        return Error{"--camera " + text + " looks at where it stands; eye and target must differ."};
    }
    return Error{
        "--camera " + text +
        " is none of overview, street, follow:ID (a walker's number) and EX,EY,EZ/TX,TY,TZ (metres)."};
}

static uint32_t rivals_of(WorkView view) {
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

static Error no_such_view(const std::string& text, std::string_view name) {
    std::string names;
    for (const char* known : k_work_view_names) {
        names += names.empty() ? "" : ", ";
        names += known;
    }
    return Error{"--view " + text + ": there is no view \"" + std::string(name) + "\"; there are " + names +
                 "."};
}

Result<WorkViews> parse_work_views(const std::string& text) {
    WorkViews views;
    for (std::string_view name : split(text, ',')) {
        const auto* at = std::find(std::begin(k_work_view_names), std::end(k_work_view_names), name);
        if (at == std::end(k_work_view_names)) return no_such_view(text, name);
        const auto view = static_cast<WorkView>(at - std::begin(k_work_view_names));
        if (views.mask & rivals_of(view))
            return Error{
                "--view " + text +
                " asks for too much at once: one of wireframe, normals and overdraw, one of lods and "
                "speed, one of density and walkable."};
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
    return Error{"--size " + text + " is not a width and a height from 1 to 8192, such as 1280x720."};
}

Result<TickRange> parse_ticks(const std::string& text) {
    constexpr uint32_t k_most = 10'000'000;
    auto parts = split(text, ':');
    TickRange ticks;
    bool good = parts.size() <= 3 && parse_number(parts[0], ticks.first);
    ticks.last = ticks.first;
    if (good && parts.size() > 1) good = parse_number(parts[1], ticks.last);
    if (good && parts.size() > 2) good = parse_number(parts[2], ticks.step) && ticks.step > 0;
    if (!good)
        return Error{"--frames " + text + " is not a tick (600) or a range of ticks (0:600 or 0:600:2)."};
    if (ticks.first > ticks.last) return Error{"--frames " + text + " ends before it begins."};
    if (ticks.last > k_most)
        return Error{"--frames " + text + " goes beyond tick 10000000, 46 hours of simulated time."};
    return ticks;
}

}  // namespace flaneur
