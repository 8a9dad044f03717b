#include "sim/lanes/lines.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

float length_along(const std::vector<Vec2>& line) {
    float sum = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) sum += length(line[i + 1] - line[i]);
    return sum;
}

static Vec2 place_at(const std::vector<Vec2>& line, float metres) {
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        const float far = length(line[i + 1] - line[i]);
        if (metres <= far || i + 2 == line.size())
            return lerp(line[i], line[i + 1], far > 0 ? clamp(metres / far, 0, 1) : 0);
        metres -= far;
    }
    return line.front();
}

std::vector<Vec2> evenly(const std::vector<Vec2>& line) {
    const float whole = length_along(line);
    const int pieces = std::max(2, static_cast<int>(whole + 0.5f));
    std::vector<Vec2> out;
    out.reserve(static_cast<size_t>(pieces) + 1);
    const float piece = whole / static_cast<float>(pieces);
    size_t at = 0;
    float before = 0;
    for (int k = 0; k <= pieces; ++k) {
        const float metres = piece * static_cast<float>(k);
        float far = length(line[at + 1] - line[at]);
        while (at + 2 < line.size() && before + far < metres)
            before += far, ++at, far = length(line[at + 1] - line[at]);
        out.push_back(lerp(line[at], line[at + 1], far > 0 ? clamp((metres - before) / far, 0, 1) : 0));
    }
    return out;
}

std::vector<Vec2> piece_of(const std::vector<Vec2>& line, float from, float to) {
    std::vector<Vec2> out{place_at(line, from)};
    float passed = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        if (passed > from + 0.01f && passed < to - 0.01f) out.push_back(line[i]);
        passed += length(line[i + 1] - line[i]);
    }
    out.push_back(place_at(line, to));
    return out;
}

std::vector<Vec2> beside(const std::vector<Vec2>& line, float left) {
    constexpr float k_sharpest = 0.5f;  // cosine of half the angle of a bend, at least
    std::vector<Vec2> out;
    out.reserve(line.size());
    for (size_t i = 0; i < line.size(); ++i) {
        const Vec2 next = normalize_or(line[std::min(i + 1, line.size() - 1)] - line[i], {0, 0});
        const Vec2 last = normalize_or(line[i] - line[i > 0 ? i - 1 : 0], next);
        const Vec2 ahead = normalize_or(last + (next == Vec2{} ? last : next), last);
        const float wider = 1 / std::max(dot(ahead, last), k_sharpest);
        out.push_back(line[i] + Vec2{ahead.z, -ahead.x} * (left * wider));
    }
    return out;
}

std::vector<Vec2> rounded(std::vector<Vec2> line) {
    constexpr float k_most = 6;  // metres cut off each side of a corner
    for (int pass = 0; pass < 3 && line.size() > 2; ++pass) {
        std::vector<Vec2> out{line.front()};
        out.reserve(2 * line.size());
        for (size_t i = 1; i + 1 < line.size(); ++i) {
            for (const Vec2 to : {line[i - 1], line[i + 1]}) {
                const float far = length(to - line[i]);
                if (far > 1e-3f)
                    out.push_back(line[i] + (to - line[i]) * (std::min(0.25f * far, k_most) / far));
            }
        }
        out.push_back(line.back());
        line = std::move(out);
    }
    return line;
}

std::vector<Vec2> curve_between(const std::vector<Vec2>& from, const std::vector<Vec2>& to) {
    constexpr float k_handle = 0.39f;  // of the distance, which makes about a circle of a right angle
    constexpr int k_pieces = 24;
    const Vec2 a = from.back(), d = to.front();
    const float reach = k_handle * length(d - a);
    const Vec2 b = a + normalize_or(a - from[from.size() - 2], {0, 0}) * reach,
               c = d - normalize_or(to[1] - d, {0, 0}) * reach;
    std::vector<Vec2> out;
    out.reserve(k_pieces + 1);
    for (int k = 0; k <= k_pieces; ++k) {
        const float t = static_cast<float>(k) / k_pieces, u = 1 - t;
        out.push_back(a * (u * u * u) + b * (3 * u * u * t) + c * (3 * u * t * t) + d * (t * t * t));
    }
    return out;
}

}  // namespace flaneur
