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

// Corners X,Z; what they are of for the fault.
static Result<std::vector<Vec2>> parse_corners(const std::string& text, const char* of) {
    std::vector<Vec2> corners;
    std::string_view left = text;
    while (!left.empty()) {
        const auto x = take_number(left);
        const bool has_comma = x && take_letter(left, ',');
        const auto z = has_comma ? take_number(left) : std::nullopt;
        if (!z || (!left.empty() && left[0] != ' '))
            return Error{excerpt(text) + " is no " + of +
                         ": corners X,Z in metres with spaces between, such as -8,-5 8,-5 0,9"};
        corners.push_back({*x, *z});
        while (take_letter(left, ' ')) {
        }
    }
    return corners;
}

Result<std::vector<Vec2>> parse_platform(const std::string& text) {
    Result<std::vector<Vec2>> corners = parse_corners(text, "outline");
    if (!corners) return corners;
    if (const Result<Platform> platform = make_platform(*corners); !platform)
        return Error{excerpt(text) + ": " + without_stop(platform.error().message)};
    for (const Vec2 corner : *corners)
        if (!(length(corner) <= k_widest_platform))
            return Error{excerpt(text) + ": The platform must lie within 400 m of the origin"};
    return corners;
}

Result<std::vector<Vec2>> parse_way(const std::string& text) {
    constexpr size_t k_most = 64;
    constexpr float k_apart = 0.5f, k_longest = 2000;  // metres
    Result<std::vector<Vec2>> corners = parse_corners(text, "way");
    if (!corners) return corners;
    if (corners->size() < 2 || corners->size() > k_most)
        return Error{excerpt(text) + ": A way has 2 to 64 corners"};
    float whole = 0;
    for (size_t k = 0; k < corners->size(); ++k) {
        const float far = length((*corners)[(k + 1) % corners->size()] - (*corners)[k]);
        if (!std::isfinite(far))
            return Error{excerpt(text) + ": Corners of a way are pairs of numbers, X,Z in metres"};
        if (far < k_apart) return Error{excerpt(text) + ": Corners of a way are 0.5 m apart at least"};
        whole += far;
    }
    if (!(whole <= k_longest)) return Error{excerpt(text) + ": Ways are of up to 2000 m"};
    return corners;
}

// With no more digits than tell it from the ticks beside it.
static std::string seconds_of(uint32_t tick) {
    constexpr double k_digits = 1000;
    return plainly(std::round(tick * k_digits / double{k_ticks_a_second}) / k_digits);
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

Result<PlannedThrow> parse_throw(const std::string& text) {
    constexpr float k_longest = 1e5f;  // seconds
    const auto words = split(text, ' ');
    float seconds = 0, speed = 0, mass = k_ball_mass;
    bool is_throw = (words.size() == 4 || words.size() == 5) && parse_number(words[0], seconds) &&
                    seconds >= 0 && seconds <= k_longest && parse_number(words[3], speed) &&
                    (words.size() == 4 || parse_number(words[4], mass));
    Result<Vec3> from = Vec3{}, at = Vec3{};
    if (is_throw) from = parse_spot(std::string(words[1])), at = parse_spot(std::string(words[2]));
    is_throw = is_throw && from && at;
    if (!is_throw)
        return Error{excerpt(text) +
                     " is no throw: SECONDS X,Y,Z X,Y,Z SPEED, such as 2 0,1.6,9 0,1.2,0 12, "
                     "and kilograms after that"};
    if (!(speed >= k_slowest_throw && speed <= k_fastest_throw))
        return Error{excerpt(text) + ": Balls are thrown at 1 to 40 m/s"};
    if (from->x == at->x && from->y == at->y && from->z == at->z)
        return Error{excerpt(text) + ": A ball is thrown from one place at another"};
    if (!(mass >= k_lightest_ball && mass <= k_heaviest_ball))
        return Error{excerpt(text) + ": Balls have 0.05 to 20 kg"};
    return PlannedThrow{static_cast<uint32_t>(std::lround(seconds * k_ticks_a_second)), *from, *at, speed,
                        mass};
}

std::string told_throw(const PlannedThrow& how) {
    std::string text = seconds_of(how.tick);
    for (const Vec3 place : {how.from, how.at}) text.append(" ").append(told_spot(place));
    text.append(" ").append(plainly(how.speed));
    if (how.mass != k_ball_mass) text.append(" ").append(plainly(how.mass));
    return text;
}

std::string told_push(const PlannedPush& push) {
    return seconds_of(push.tick) + " " + (push.walker == k_everybody ? "*" : std::to_string(push.walker)) +
           " " + plainly(push.impulse.x) + "," + plainly(push.impulse.z);
}

std::string told_corners(const std::vector<Vec2>& corners) {
    std::string text;
    for (const Vec2 corner : corners)
        text.append(text.empty() ? "" : " ").append(plainly(corner.x)).append(",").append(plainly(corner.z));
    return text;
}

}  // namespace flaneur
