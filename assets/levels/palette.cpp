#include "assets/levels/palette.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <utility>

#include "assets/levels/texel.h"

namespace flaneur {

namespace {

constexpr int k_same = 6;               // of 255, in each channel: a compressed picture's noise
constexpr size_t k_most_colours = 256;  // of a palette
constexpr int k_finest_steps = 24;      // along the edges of a triangle

bool same(uint32_t a, uint32_t b) {
    for (int shift : {0, 8, 16, 24})
        if (std::abs(int(a >> shift & 0xff) - int(b >> shift & 0xff)) > k_same) return false;
    return true;
}

uint32_t packed_texel(const Texture& t, float u, float v) {
    const uint8_t* rgba = texel(t, u, v);
    return uint32_t(rgba[0]) | uint32_t(rgba[1]) << 8 | uint32_t(rgba[2]) << 16 | uint32_t(rgba[3]) << 24;
}

// The one colour that a triangle shows, if it is opaque and one: in its middle, as all over it.
std::optional<uint32_t> one_colour(const Texture& t, const std::array<const CharacterVertex*, 3>& corner) {
    float longest = 0;  // edge, texels
    for (size_t i = 0; i < 3; ++i) {
        const CharacterVertex &a = *corner[i], &b = *corner[(i + 1) % 3];
        longest = std::max(
            {longest, std::fabs(a.u - b.u) * float(t.width), std::fabs(a.v - b.v) * float(t.height)});
    }
    auto at = [&](float a, float b, float c) {
        return packed_texel(t, corner[0]->u * a + corner[1]->u * b + corner[2]->u * c,
                            corner[0]->v * a + corner[1]->v * b + corner[2]->v * c);
    };
    const uint32_t middle = at(1 / 3.0f, 1 / 3.0f, 1 / 3.0f);
    if (middle >> 24 < 128) return {};
    const int steps = int(clamp(longest, 1, k_finest_steps));
    // Just within the corners, which may lie on the border of two swatches.
    constexpr float k_inner = 0.96f, k_edge = (1 - k_inner) / 3;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            float a = k_inner * float(i) / float(steps) + k_edge,
                  b = k_inner * float(j) / float(steps) + k_edge;
            if (!same(at(a, b, 1 - a - b), middle)) return {};
        }
    return middle;
}

// Colours that differ by noise alone are one: the first of them.
struct Swatches {
    std::vector<uint32_t> colours;
    std::map<uint32_t, uint32_t> known;

    uint32_t of(uint32_t colour) {
        auto [found, fresh] = known.try_emplace(colour, colour);
        if (!fresh || colours.size() > k_most_colours) return found->second;
        auto near = std::find_if(colours.begin(), colours.end(), [&](uint32_t c) { return same(c, colour); });
        if (near == colours.end()) near = colours.insert(colours.end(), colour);
        return found->second = *near;
    }
};

uint32_t product(uint32_t a, uint32_t b) {
    uint32_t out = 0xff000000u;
    for (int shift : {0, 8, 16}) out |= ((a >> shift & 0xff) * (b >> shift & 0xff) + 127) / 255 << shift;
    return out;
}

}  // namespace

std::vector<uint32_t> without_palettes(Character& c) {
    struct Use {
        size_t triangles = 0, plain = 0;
        Swatches swatches;
    };
    std::vector<Use> uses(c.textures.size());
    std::vector<uint32_t> corners = c.lods[0];
    std::vector<std::optional<uint32_t>> shown(corners.size() / 3);
    for (size_t t = 0; t < shown.size(); ++t) {
        std::array<const CharacterVertex*, 3> corner;
        for (size_t i = 0; i < 3; ++i) corner[i] = &c.vertices[corners[3 * t + i]];
        if (!is_textured(c, *corner[0])) continue;
        Use& use = uses[corner[0]->texture];
        ++use.triangles;
        shown[t] = one_colour(c.textures[corner[0]->texture], corner);
        if (!shown[t]) continue;
        ++use.plain;
        shown[t] = use.swatches.of(*shown[t]);
    }
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> plain;  // by vertex and colour
    for (size_t t = 0; t < shown.size(); ++t) {
        if (!shown[t]) continue;
        const Use& use = uses[c.vertices[corners[3 * t]].texture];
        if (use.plain * 10 < use.triangles * 9 || use.swatches.colours.size() > k_most_colours) continue;
        for (size_t i = 0; i < 3; ++i) {
            uint32_t& corner = corners[3 * t + i];
            auto [known, fresh] = plain.try_emplace({corner, *shown[t]}, uint32_t(c.vertices.size()));
            if (fresh) {
                CharacterVertex v = c.vertices[corner];
                v.colour = product(v.colour, *shown[t]);
                v.texture = CharacterVertex::k_no_texture;
                v.u = v.v = 0;
                c.vertices.push_back(v);
            }
            corner = known->second;
        }
    }
    return corners;
}

}  // namespace flaneur
