#include "assets/levels/raster.h"

#include <algorithm>
#include <array>

#include "assets/levels/texel.h"

namespace flaneur {

namespace {

constexpr float k_dark = 0.4f;  // share of the light that comes from everywhere

// A corner as it is interpolated.
struct SideCorner {
    float x, y;  // pixels
    float near, u, v;
    std::array<float, 3> colour;
};

SideCorner corner_of(const CharacterVertex& v, Vec3 place, Vec3 normal, const SideView& view) {
    const float right = view.cosine * place.x - view.sine * place.z;
    const float lit = std::max(view.sine * normal.x + view.cosine * normal.z, 0.0f);
    const float light = k_dark + (1 - k_dark) * lit;
    SideCorner out{(right - view.left) * view.pixels_per_metre,
                   (place.y - view.bottom) * view.pixels_per_metre,
                   view.sine * place.x + view.cosine * place.z,
                   v.u,
                   v.v,
                   {}};
    for (size_t n = 0; n < 3; ++n) out.colour[n] = float(v.colour >> (8 * n) & 0xffu) * light;
    return out;
}

float doubled_area(const SideCorner& a, const SideCorner& b, float x, float y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

void draw_triangle(const std::array<SideCorner, 3>& p, const Texture* texture, const SideView& view,
                   SidePicture& picture) {
    const float area = doubled_area(p[0], p[1], p[2].x, p[2].y);
    if (!(area > 0)) return;
    auto first = [](float from) { return int(std::ceil(clamp(from - 0.5f, 0, 1e6f))); };
    auto last = [](float to, int size) { return int(std::floor(clamp(to - 0.5f, -1, float(size - 1)))); };
    const int left = first(std::min({p[0].x, p[1].x, p[2].x})),
              low = first(std::min({p[0].y, p[1].y, p[2].y}));
    const int right = last(std::max({p[0].x, p[1].x, p[2].x}), view.width);
    const int high = last(std::max({p[0].y, p[1].y, p[2].y}), view.height);
    // Shares of the corners, which change evenly along a row.
    const float to_share = 1 / area;
    const float a_step = (p[1].y - p[2].y) * to_share, b_step = (p[2].y - p[0].y) * to_share;
    const float x = float(left) + 0.5f;
    for (int row = low; row <= high; ++row) {
        const float y = float(row) + 0.5f;
        const float a_left = doubled_area(p[1], p[2], x, y) * to_share;
        const float b_left = doubled_area(p[2], p[0], x, y) * to_share;
        size_t at = size_t(row) * size_t(view.width) + size_t(left);
        for (int column = left; column <= right; ++column, ++at) {
            const float a = a_left + a_step * float(column - left),
                        b = b_left + b_step * float(column - left);
            const float c = 1 - a - b;
            if (!(a >= 0 && b >= 0 && c >= 0)) continue;  // nor what is too thin for numbers
            const float near = p[0].near * a + p[1].near * b + p[2].near * c;
            if (near <= picture.nearness[at]) continue;
            std::array<float, 3> colour;
            for (size_t n = 0; n < 3; ++n)
                colour[n] = p[0].colour[n] * a + p[1].colour[n] * b + p[2].colour[n] * c;
            if (texture) {
                const uint8_t* rgba = texel(*texture, p[0].u * a + p[1].u * b + p[2].u * c,
                                            p[0].v * a + p[1].v * b + p[2].v * c);
                if (rgba[3] < 128) continue;
                for (size_t n = 0; n < 3; ++n) colour[n] *= float(rgba[n]) / 255;
            }
            picture.nearness[at] = near;
            picture.rgba[at] = 0xff000000u;
            for (size_t n = 0; n < 3; ++n) picture.rgba[at] |= uint32_t(clamp(colour[n], 0, 255)) << (8 * n);
        }
    }
}

}  // namespace

void draw_side(const Character& c, const PosedMesh& mesh, std::span<const uint32_t> triangles,
               const SideView& view, SidePicture& picture) {
    const size_t pixels = size_t(view.width) * size_t(view.height);
    picture.rgba.assign(pixels, 0);
    picture.nearness.assign(pixels, -1e30f);
    for (size_t t = 0; t + 2 < triangles.size(); t += 3) {
        std::array<SideCorner, 3> corners;
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t v = triangles[t + i];
            corners[i] = corner_of(c.vertices[v], mesh.places[v], mesh.normals[v], view);
        }
        const CharacterVertex& v = c.vertices[triangles[t]];
        draw_triangle(corners, is_textured(c, v) ? &c.textures[v.texture] : nullptr, view, picture);
    }
}

}  // namespace flaneur
