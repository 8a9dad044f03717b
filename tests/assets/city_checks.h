// What holds for every city, wherever it comes from.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/cities.h"
#include "sim/base/rng.h"

namespace flaneur {

inline Vec3 corner(const City& city, size_t triangle, size_t k) {
    return city.ground.vertices[city.ground.indices[triangle * 3 + k]];
}

inline Vec3 triangle_normal(const City& city, size_t t) {
    return normalize_or(
        cross(corner(city, t, 1) - corner(city, t, 0), corner(city, t, 2) - corner(city, t, 0)), {0, 0, 0});
}

// Seen from above, m^2; positive when wound counter-clockwise.
inline double map_area(const City& city, size_t t) {
    Vec2 a = on_ground(corner(city, t, 0)), b = on_ground(corner(city, t, 1)),
         c = on_ground(corner(city, t, 2));
    return -0.5 * static_cast<double>(cross(b - a, c - a));
}

// How many ground triangles hold a point, their borders left out.
inline int triangles_at(const City& city, Vec2 p) {
    const Grid& grid = city.ground.triangle_grid;
    int x = static_cast<int>((p.x - grid.origin.x) / grid.cell),
        z = static_cast<int>((p.z - grid.origin.z) / grid.cell);
    if (x < 0 || z < 0 || x >= grid.width || z >= grid.height) return 0;
    size_t cell = static_cast<size_t>(z) * grid.width + x;
    int count = 0;
    for (uint32_t k = grid.first[cell]; k < grid.first[cell + 1]; ++k) {
        bool inside = true;
        for (size_t e = 0; e < 3; ++e) {
            Vec2 a = on_ground(corner(city, grid.items[k], e)),
                 b = on_ground(corner(city, grid.items[k], (e + 1) % 3));
            // A millimetre inside.
            inside &= cross(p - a, b - a) > 1e-3f * length(b - a);
        }
        count += inside;
    }
    return count;
}

// The ground at a place and about a height, the nearest first.
inline bool ground_has_height(const City& city, Vec2 p, float y) {
    for (float tolerance : {0.02f, 0.05f}) {
        if (ground_at(city.ground, at_height(p, y), tolerance, tolerance)) return true;
    }
    return false;
}

inline void check_city(const City& city) {
    ASSERT_FALSE(city.ground.kinds.empty());
    ASSERT_EQ(city.ground.indices.size(), city.ground.kinds.size() * 3);
    ASSERT_EQ(city.ground_axes.size(), city.ground.kinds.size());
    ASSERT_EQ(city.roof_indices.size(), city.roof_buildings.size() * 3);
    EXPECT_FALSE(city.ground.triangle_grid.items.empty());
    for (uint32_t i : city.ground.indices) ASSERT_LT(i, city.ground.vertices.size());
    for (uint32_t i : city.roof_indices) ASSERT_LT(i, city.roof_vertices.size());
    for (uint32_t b : city.roof_buildings) ASSERT_LT(b, city.buildings.size());
    for (Vec3 v : city.ground.vertices)
        ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));
    for (Vec3 v : city.roof_vertices)
        ASSERT_TRUE(std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z));

    size_t steep = 0;
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        float longest = 0;
        for (size_t k = 0; k < 3; ++k) {
            longest = std::max(longest, length(corner(city, t, k) - corner(city, t, (k + 1) % 3)));
        }
        bool sliver = map_area(city, t) < 0.005 * static_cast<double>(longest);
        steep += !sliver && triangle_normal(city, t).y < 0.95f;
        EXPECT_GT(map_area(city, t), -1e-3);
        bool may_be_bare =
            city.ground.kinds[t] == Surface::crossing || city.ground.kinds[t] == Surface::plaza;
        if (!may_be_bare || city.ground_axes[t] != Vec2{}) {
            EXPECT_NEAR(length(city.ground_axes[t]), 1, 1e-3);
        }
    }
    EXPECT_EQ(steep, 0u);

    size_t facades = 0, loose_kerbs = 0, kerbs = 0, hidden_fronts = 0;
    for (const Face& f : city.ground.faces) {
        ASSERT_TRUE(f.building == ~0u || f.building < city.buildings.size());
        EXPECT_GE(f.a_top, f.a.y - 1e-3f);
        EXPECT_GE(f.b_top, f.b.y - 1e-3f);
        facades += f.kind == FaceKind::facade;
        Vec2 middle = lerp(on_ground(f.a), on_ground(f.b), 0.5f), along = on_ground(f.b) - on_ground(f.a);
        Vec2 out = normalize_or(Vec2{-along.z, along.x}, {1, 0}) * 0.005f;
        if (f.kind == FaceKind::facade || length(along) < 0.05f || f.building != ~0u) continue;
        // Kerbs, risers and retaining walls join two grounds: the low one in front, the high one behind.
        ++kerbs;
        float low = (f.a.y + f.b.y) * 0.5f, high = (f.a_top + f.b_top) * 0.5f;
        loose_kerbs +=
            !ground_has_height(city, middle + out, low) || !ground_has_height(city, middle - out, high);
        hidden_fronts += f.kind != FaceKind::garden_wall && high - low > 0.36f;
    }
    EXPECT_GT(facades, 0u);
    EXPECT_EQ(hidden_fronts, 0u);
    EXPECT_LE(loose_kerbs, 5 + kerbs / 50);  // tips of wedges are narrower than the probe

    // Behind a wall that stands on the ground there is no ground.
    size_t checked = 0, filled = 0;
    for (const Face& f : city.ground.faces) {
        if (f.building == ~0u) continue;
        Vec2 along = on_ground(f.b) - on_ground(f.a);
        if (length(along) < 0.5f) continue;
        Vec2 in = normalize_or(Vec2{along.z, -along.x}, {1, 0}) * 0.05f,
             p = lerp(on_ground(f.a), on_ground(f.b), 0.5f);
        std::optional<GroundHit> front = ground_at(city.ground, at_height(p - in, f.a.y), 0.6f, 0.6f);
        if (!front) continue;
        ++checked;
        filled += ground_at(city.ground, at_height(p + in, f.a.y), 0.6f, 0.6f).has_value();
    }
    EXPECT_GT(checked, 0u);
    EXPECT_LE(filled, checked / 100);

    for (const Prop& prop : city.props) {
        std::optional<GroundHit> hit = ground_at(city.ground, prop.position, 0.1f, 0.1f);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->height, prop.position.y, 1e-3f);
        EXPECT_GT(prop.height, 0);
    }
}

}  // namespace flaneur
