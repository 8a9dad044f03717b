#include <algorithm>
#include <cmath>

#include "sim/base/planar.h"
#include "sim/stepper/stepper.h"

namespace flaneur {

BipedWay make_way(std::vector<Vec2> line) {
    BipedWay way;
    way.line = std::move(line);
    way.along = {0};
    for (size_t i = 0; i < way.line.size(); ++i)
        way.along.push_back(way.along.back() + length(way.line[(i + 1) % way.line.size()] - way.line[i]));
    return way;
}

static float within(const BipedWay& way, float along) {
    const float whole = way.along.back();
    return along - whole * std::floor(along / whole);
}

WayPoint point_on(const BipedWay& way, float along) {
    const float at = within(way, along);
    const auto after = std::upper_bound(way.along.begin() + 1, way.along.end() - 1, at);
    const auto i = static_cast<size_t>(after - way.along.begin()) - 1;
    const Vec2 a = way.line[i], b = way.line[(i + 1) % way.line.size()];
    const float piece = way.along[i + 1] - way.along[i];
    return {lerp(a, b, piece > 0 ? clamp((at - way.along[i]) / piece, 0, 1) : 0),
            normalize_or(b - a, {0, 1})};
}

float nearest_along(const BipedWay& way, Vec2 place) {
    float best = 0, least = 1e30f;
    for (size_t i = 0; i < way.line.size(); ++i) {
        const Vec2 a = way.line[i], b = way.line[(i + 1) % way.line.size()];
        const float share = closest_on(a, b, place);
        const float off = length(a + (b - a) * share - place);
        if (off < least) least = off, best = lerp(way.along[i], way.along[i + 1], share);
    }
    return best;
}

float nearest_along(const BipedWay& way, Vec2 place, float from, float most) {
    constexpr float k_apart = 0.05f;  // metres
    float best = from, least = length(point_on(way, from).place - place);
    for (float off = k_apart; off <= most; off += k_apart)
        for (const float along : {from + off, from - off}) {
            const float far = length(point_on(way, along).place - place);
            if (far < least) least = far, best = along;
        }
    return best;
}

}  // namespace flaneur
