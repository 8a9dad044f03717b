// What the cutters of upper and lower garments share. Body heights, bind pose.
#pragma once

#include <utility>

#include "assets/people/parts.h"

namespace flaneur {

struct Tailor {
    Field& field;
    const Figure& figure;
    Layer layer;

    void add(Loft loft, float grow, float round = 0) const {
        field.parts.push_back({layer, FieldBlend::add, round, grow, std::move(loft)});
    }
    void carve(Loft loft, float round = 0, float grow = 0) const {
        field.parts.push_back({layer, FieldBlend::carve, round, grow, std::move(loft)});
    }
    void keep(Loft loft, float round = 0) const {
        field.parts.push_back({layer, FieldBlend::keep, round, 0, std::move(loft)});
    }
    // Cut off beyond the plane through `point`.
    void crop(Vec3 normal, Vec3 point, float round = 0) const {
        normal = normalize_or(normal, {0, -1, 0});
        field.parts.push_back({layer, FieldBlend::keep, round, 0, {}, true, normal, dot(normal, point)});
    }
};

}  // namespace flaneur
