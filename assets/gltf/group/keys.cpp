#include "assets/gltf/group/keys.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

namespace {

Vec3 between(Vec3 a, Vec3 b, float t) { return lerp(a, b, t); }
Quat between(Quat a, Quat b, float t) { return slerp(a, b, t); }
float apart(Vec3 a, Vec3 b) { return length(a - b); }
float apart(Quat a, Quat b) { return radians_apart(a, b); }

template <class T>
bool holds(std::span<const float> times, std::span<const T> values, size_t from, size_t to, float most) {
    for (size_t i = from + 1; i < to; ++i) {
        const float t = (times[i] - times[from]) / (times[to] - times[from]);
        if (!(apart(between(values[from], values[to], t), values[i]) <= most)) return false;
    }
    return true;
}

// Each key as far behind the one before it as doubling finds, and then halving.
template <class T>
std::vector<uint32_t> find_keys(std::span<const float> times, std::span<const T> values, float most) {
    std::vector<uint32_t> keys{0};
    if (std::all_of(values.begin(), values.end(), [&](T v) { return apart(v, values[0]) <= most; }))
        return keys;
    const size_t last = values.size() - 1;
    for (size_t at = 0; at < last;) {
        size_t good = at + 1, bad = at + 2;
        while (bad <= last && holds(times, values, at, bad, most)) good = bad, bad = at + 2 * (bad - at);
        bad = std::min(bad, last + 1);
        while (bad - good > 1) {
            const size_t middle = (good + bad) / 2;
            (holds(times, values, at, middle, most) ? good : bad) = middle;
        }
        keys.push_back(static_cast<uint32_t>(good));
        at = good;
    }
    return keys;
}

}  // namespace

Quat slerp(Quat from, Quat to, float t) {
    const float sign = dot(from, to) < 0 ? -1.0f : 1.0f;
    const float angle = 0.5f * radians_apart(from, to);
    float a = 1 - t, b = t;
    if (constexpr float k_tiny = 1e-3f; angle > k_tiny) {
        a = std::sin(a * angle) / std::sin(angle);
        b = std::sin(b * angle) / std::sin(angle);
    }
    b *= sign;
    return normalize(
        Quat{a * from.x + b * to.x, a * from.y + b * to.y, a * from.z + b * to.z, a * from.w + b * to.w});
}

// By the chord, which is exact where they are near each other.
float radians_apart(Quat a, Quat b) {
    const float sign = dot(a, b) < 0 ? -1.0f : 1.0f;
    const Quat d{a.x - sign * b.x, a.y - sign * b.y, a.z - sign * b.z, a.w - sign * b.w};
    return 4 * std::asin(std::min(0.5f * std::sqrt(dot(d, d)), 1.0f));
}

std::vector<uint32_t> keys_of(std::span<const float> times, std::span<const Vec3> places, float most) {
    return find_keys(times, places, most);
}
std::vector<uint32_t> keys_of(std::span<const float> times, std::span<const Quat> turns, float most) {
    return find_keys(times, turns, most);
}

}  // namespace flaneur
