// The built-in places of a scene, as files and the command line say them.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/scene.h"
#include "sim/base/tick.h"
#include "sim/ways/platform.h"

namespace flaneur {

namespace {

// The number at the beginning of a text, which is taken away.
std::optional<float> take_number(std::string_view& text) {
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return {};
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    return value;
}

bool take_letter(std::string_view& text, char letter) {
    if (text.empty() || text[0] != letter) return false;
    text.remove_prefix(1);
    return true;
}

// Faults of scenes end without their full stop.
std::string without_stop(std::string sentence) {
    if (!sentence.empty() && sentence.back() == '.') sentence.pop_back();
    return sentence;
}

}  // namespace

Result<std::vector<Vec2>> parse_platform(const std::string& text) {
    std::vector<Vec2> corners;
    std::string_view left = text;
    while (!left.empty()) {
        const auto x = take_number(left);
        const bool has_comma = x && take_letter(left, ',');
        const auto z = has_comma ? take_number(left) : std::nullopt;
        if (!z || (!left.empty() && left[0] != ' '))
            return Error{excerpt(text) +
                         " is no outline: corners X,Z in metres with spaces between, such as -8,-5 8,-5 0,9"};
        corners.push_back({*x, *z});
        while (take_letter(left, ' ')) {
        }
    }
    if (const Result<Platform> platform = make_platform(corners); !platform)
        return Error{excerpt(text) + ": " + without_stop(platform.error().message)};
    for (const Vec2 corner : corners)
        if (!(length(corner) <= k_widest_platform))
            return Error{excerpt(text) + ": The platform must lie within 400 m of the origin"};
    return corners;
}

Result<PlannedPush> parse_push(const std::string& text) {
    constexpr float k_longest = 1e5f, k_hardest = 1000;  // seconds, newton seconds
    std::string_view left = text;
    const auto seconds = take_number(left);
    bool is_push = seconds && *seconds >= 0 && *seconds <= k_longest && take_letter(left, ' ');
    PlannedPush push;
    if (is_push && take_letter(left, '*')) {
        push.walker = k_everybody;
    } else if (is_push) {
        const auto walker = take_number(left);
        is_push = walker && *walker >= 0 && *walker < k_max_walkers && *walker == std::floor(*walker);
        if (is_push) push.walker = static_cast<uint32_t>(*walker);
    }
    is_push = is_push && take_letter(left, ' ');
    const auto x = is_push ? take_number(left) : std::nullopt;
    const auto z = x && take_letter(left, ',') ? take_number(left) : std::nullopt;
    if (!z || !left.empty() || !std::isfinite(*x) || !std::isfinite(*z))
        return Error{excerpt(text) +
                     " is no push: SECONDS WALKER X,Z, such as 2.5 12 60,0, or with * for everybody"};
    push.impulse = {*x, *z};
    if (!(length(push.impulse) <= k_hardest))
        return Error{excerpt(text) + ": Pushes are of up to 1000 newton seconds"};
    push.tick = static_cast<uint32_t>(std::lround(*seconds * k_ticks_a_second));
    return push;
}

std::string told_push(const PlannedPush& push) {
    return plainly(static_cast<float>(push.tick) * k_tick) + " " +
           (push.walker == k_everybody ? "*" : std::to_string(push.walker)) + " " + plainly(push.impulse.x) +
           "," + plainly(push.impulse.z);
}

std::string told_platform(const std::vector<Vec2>& corners) {
    std::string text;
    for (const Vec2 corner : corners)
        text.append(text.empty() ? "" : " ").append(plainly(corner.x)).append(",").append(plainly(corner.z));
    return text;
}

}  // namespace flaneur
