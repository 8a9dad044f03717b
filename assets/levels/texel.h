// What a texture shows at a place.
#pragma once

#include <algorithm>
#include <cmath>

#include "assets/character.h"

namespace flaneur {

// The texel at (u, v) of a texture that repeats and has texels.
inline const uint8_t* texel(const Texture& t, float u, float v) {
    auto at = [](float x, int size) {
        float share = x - std::floor(x);
        return share >= 0 ? std::min(size_t(share * float(size)), size_t(size) - 1) : 0;  // not a number: 0
    };
    return &t.rgba[4 * (at(v, t.height) * size_t(t.width) + at(u, t.width))];
}

// Whether a vertex shows a texture that is there.
inline bool is_textured(const Character& c, const CharacterVertex& v) {
    return v.texture < c.textures.size() && !c.textures[v.texture].rgba.empty();
}

}  // namespace flaneur
