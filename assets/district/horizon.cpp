// The country around: meadows that rise from the edge of the map to low hills, woods and farms. Only looked
// at.
#include <algorithm>
#include <array>
#include <cmath>

#include "assets/colour.h"
#include "assets/district/district.h"
#include "assets/plan/streets.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_reach = 300;  // how far beyond the map, metres
constexpr uint32_t k_meadow = rgb(0x748c50), k_field = rgb(0x93955c), k_wood = rgb(0x5c7a43),
                   k_road = rgb(0x55565a);

struct Country {
    Vec2 low, high;  // the map within
    const District& d;
    RandomKey key;

    // How far out a point is, and the height of the land there.
    float away(Vec2 p) const {
        Vec2 out{std::max({low.x - p.x, p.x - high.x, 0.0f}), std::max({low.z - p.z, p.z - high.z, 0.0f})};
        return length(out);
    }
    float height(Vec2 p) const {
        Vec2 edge{clamp(p.x, low.x, high.x), clamp(p.z, low.z, high.z)};
        float far = away(p), up = smoothstep(0, k_reach * 0.8f, far);
        auto roll = [&](float x, float turn) { return sin_cos(x * 0.016f + turn).sine; };
        float turn = 2 * k_pi * random_unit(key);
        float hills = 15 + 5 * roll(p.x + 0.6f * p.z, turn) + 4 * roll(1.7f * p.z - p.x, 2 * turn);
        return terrain_at(d, edge) + k_kerb + up * hills;
    }
    Vec3 at(Vec2 p) const { return at_height(p, height(p)); }
};

void add_triangle(Scenery& scenery, const std::array<Vec3, 3>& points, const std::array<Vec3, 3>& normals,
                  uint32_t colour) {
    for (size_t k = 0; k < 3; ++k) {
        scenery.indices.push_back(static_cast<uint32_t>(scenery.vertices.size()));
        scenery.vertices.push_back({points[k], normals[k], {}, colour});
    }
    scenery.pictures.push_back(~0u);
    scenery.uses.push_back(SceneryUse::backdrop);
}

void add_flat(Scenery& scenery, Vec3 a, Vec3 b, Vec3 c, uint32_t colour) {
    Vec3 n = normalize_or(cross(b - a, c - a), {0, 1, 0});
    add_triangle(scenery, {a, b, c}, {n, n, n}, colour);
}

// A tree seen from far away: a crown down to the ground, round by its normals.
void add_crown(Scenery& scenery, Vec3 middle, float radius, float half, float turn, uint32_t colour) {
    constexpr size_t k_sides = 5;
    Vec3 top = middle + Vec3{0, half, 0}, foot = middle - Vec3{0, 1.1f * half, 0};
    std::array<Vec3, k_sides> low, high;
    for (size_t i = 0; i < k_sides; ++i) {
        Vec2 out = heading_direction(turn + 2 * k_pi * static_cast<float>(i) / k_sides) * radius;
        low[i] = middle + Vec3{out.x, -0.35f * half, out.z};
        high[i] = middle + Vec3{out.x * 0.78f, 0.5f * half, out.z * 0.78f};
    }
    auto add = [&](Vec3 a, Vec3 b, Vec3 c, float shade) {
        auto normal = [&](Vec3 p) { return normalize_or(p - middle + Vec3{0, 0.25f * half, 0}, {0, 1, 0}); };
        add_triangle(scenery, {a, b, c}, {normal(a), normal(b), normal(c)}, shaded(colour, shade));
    };
    for (size_t i = 0; i < k_sides; ++i) {
        size_t k = (i + 1) % k_sides;
        add(high[i], high[k], top, 1);
        add(low[i], low[k], high[k], 0.92f);
        add(low[i], high[k], high[i], 0.92f);
        add(low[k], low[i], foot, 0.7f);
    }
}

void add_farm(Scenery& scenery, Dice& dice, Vec3 at) {
    Vec2 u = heading_direction(dice.between(0, k_pi)), v{-u.z, u.x};
    float half_length = dice.between(5, 9), half_width = dice.between(3.5f, 4.5f),
          eaves = dice.between(3.5f, 6.5f);
    float ridge = eaves + half_width * 0.9f;
    uint32_t wall = dice.chance(0.7f) ? rgb(0xe0d5c1) : rgb(0xc7a988),
             roof = dice.chance(0.7f) ? rgb(0xb0684b) : rgb(0x5b626b);
    auto corner = [&](float x, float z, float y) {
        return at_height(on_ground(at) + u * (x * half_length) + v * (z * half_width), at.y + y);
    };
    auto quad = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 e, uint32_t colour) {
        add_flat(scenery, a, b, c, colour);
        add_flat(scenery, a, c, e, colour);
    };
    for (float side : {-1.0f, 1.0f}) {
        quad(corner(side, side, -2), corner(-side, side, -2), corner(-side, side, eaves),
             corner(side, side, eaves), wall);
        quad(corner(side, -side, -2), corner(side, side, -2), corner(side, side, eaves),
             corner(side, -side, eaves), wall);
        add_flat(scenery, corner(side, -side, eaves), corner(side, side, eaves), corner(side, 0, ridge),
                 wall);
        quad(corner(side, side, eaves), corner(-side, side, eaves), corner(-side, 0, ridge),
             corner(side, 0, ridge), roof);
    }
}

}  // namespace

void add_horizon(District& d, uint64_t seed) {
    Country land{d.plan.low, d.plan.high, d, {seed, 0x40121302u, 0, Purpose::city}};
    Scenery& scenery = d.city.scenery;
    // Rings of quads around the map, wider outwards. Each side has as many columns in every ring.
    constexpr float k_rings[] = {0, 12, 35, 75, 130, 200, k_reach};
    constexpr size_t k_columns = 14;
    std::vector<std::vector<Vec2>> rings;
    for (float far : k_rings) {
        Vec2 low = land.low - Vec2{far, far}, high = land.high + Vec2{far, far};
        const Vec2 corners[] = {low, {high.x, low.z}, high, {low.x, high.z}};
        std::vector<Vec2> ring;
        for (size_t side = 0; side < 4; ++side) {
            for (size_t k = 0; k < k_columns; ++k)
                ring.push_back(lerp(corners[side], corners[(side + 1) % 4],
                                    static_cast<float>(k) / static_cast<float>(k_columns)));
        }
        rings.push_back(ring);
    }
    auto normal = [&](Vec2 p) {
        float step = 4, east = land.height(p + Vec2{step, 0}) - land.height(p - Vec2{step, 0}),
              south = land.height(p + Vec2{0, step}) - land.height(p - Vec2{0, step});
        return normalize_or(Vec3{-east, 2 * step, -south}, {0, 1, 0});
    };
    for (size_t r = 0; r + 1 < rings.size(); ++r) {
        for (size_t k = 0; k < rings[r].size(); ++k) {
            size_t next = (k + 1) % rings[r].size();
            Vec2 a = rings[r][k], b = rings[r][next], c = rings[r + 1][next], e = rings[r + 1][k];
            RandomKey key{seed, static_cast<uint32_t>(r * 4096 + k / 3), 8, Purpose::city};
            uint32_t colour = r > 1 && random_unit(key) < 0.4f ? k_field : k_meadow;
            colour = shaded(colour, random_between(key, 0.92f, 1.06f, 1));
            add_triangle(scenery, {land.at(a), land.at(b), land.at(c)}, {normal(a), normal(b), normal(c)},
                         colour);
            add_triangle(scenery, {land.at(a), land.at(c), land.at(e)}, {normal(a), normal(c), normal(e)},
                         colour);
        }
    }
    // The streets that lead out go on over the meadows.
    for (const Way& way : d.streets.ways) {
        if (!way.leads_out) continue;
        Vec2 out = normalize_or(way.line.back() - way.line.front(), {1, 0}),
             side = Vec2{-out.z, out.x} * (way.width * 0.5f);
        Vec2 edge = way.line.front();
        while (land.away(edge) <= 0) edge += out;
        edge += -out * 0.8f;
        for (size_t r = 0; r + 2 < std::size(k_rings); ++r) {
            Vec2 from = edge + out * k_rings[r], to = edge + out * k_rings[r + 1];
            Vec3 a = at_height(from - side, land.height(from) + (r > 0 ? 0.28f : 0.02f)),
                 b = at_height(from + side, a.y);
            Vec3 c = at_height(to + side, land.height(to) + 0.28f), e = at_height(to - side, c.y);
            add_flat(scenery, a, b, c, k_road);
            add_flat(scenery, a, c, e, k_road);
        }
    }
    // Woods in patches, hedges and single trees between; farms here and there.
    Dice dice{{seed, 0x40121303u, 0, Purpose::city}};
    float around = 2 * (land.high.x - land.low.x + land.high.z - land.low.z);
    auto somewhere = [&](float least, float most) {
        float far = lerp(least, most, dice.unit()), along = dice.unit();
        Vec2 low = land.low - Vec2{far, far}, high = land.high + Vec2{far, far};
        std::vector<Vec2> edge{low, {high.x, low.z}, high, {low.x, high.z}, low};
        return station(edge, along * length_of(edge)).at;
    };
    auto plant = [&](Vec2 p, float size) {
        float half = dice.between(2.6f, 4.2f) * size, radius = half * dice.between(0.75f, 1.05f);
        float turn = dice.between(0, 6), tone = dice.between(0.85f, 1.12f);
        add_crown(scenery, land.at(p) + Vec3{0, half * 0.8f, 0}, radius, half, turn, shaded(k_wood, tone));
    };
    int woods = static_cast<int>(around / 60);
    for (int i = 0; i < woods; ++i) {
        Vec2 middle = somewhere(30, k_reach - 30);
        int trees = 6 + dice.pick(14);
        float wide = dice.between(8, 24);
        for (int t = 0; t < trees; ++t) {
            Vec2 off{dice.between(-wide, wide), dice.between(-wide, wide)};
            if (land.away(middle + off) > 40) plant(middle + off, 1.15f);
        }
    }
    for (int i = 0; i < static_cast<int>(around / 16); ++i) plant(somewhere(45, 200), 0.9f);
    for (int i = 0; i < static_cast<int>(around / 55); ++i) {
        Vec2 p = somewhere(30, 190);
        add_farm(scenery, dice, land.at(p));
    }
}

}  // namespace flaneur
