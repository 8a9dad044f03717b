// Where sky is hidden from the ground: along walls and kerbs, under trees and cars.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/extract/parts.h"

namespace flaneur {

namespace {

constexpr float k_lift = 0.012f;     // over the ground, metres
constexpr float k_step_over = 0.7f;  // the ground is looked for so far above and below, metres
constexpr float k_most_length = 6;   // of a piece along a wall, metres
constexpr float k_gap = 0.004f;  // between a wall and its shade, so that there is ground below for certain

// How wide and how dark the foot of a wall makes the ground before it.
struct Strip {
    float width, strength;
};

struct Shades {
    CityMesh& mesh;
    const City& city;
};

// A vertex on the ground at `at`, which is near `height`. `share` is 0 where it is darkest and 1 where it
// ends.
std::optional<uint32_t> add_vertex(Shades& out, Vec2 at, float height, float share, float strength) {
    std::optional<GroundHit> hit =
        ground_at(out.city.ground, at_height(at, height), k_step_over, k_step_over);
    if (!hit) return {};
    CityVertex vertex{};
    vertex.position = {at.x, hit->height + k_lift, at.z};
    vertex.uv = {share, strength};
    vertex.normal[1] = 127;
    vertex.material = static_cast<uint16_t>(k_material_shade);
    out.mesh.vertices.push_back(vertex);
    return static_cast<uint32_t>(out.mesh.vertices.size() - 1);
}

void add_quad(Shades& out, const std::optional<uint32_t> (&corners)[4]) {
    for (const auto& corner : corners)
        if (!corner) return;
    for (int i : {0, 1, 2, 0, 2, 3}) out.mesh.indices.push_back(*corners[i]);
}

void add_strip(Shades& out, const Face& f, Strip strip) {
    Vec2 a = on_ground(f.a), along = on_ground(f.b) - a;
    float width = length(along);
    if (width < 0.05f) return;
    Vec2 outwards = Vec2{-along.z, along.x} / width;
    int pieces = std::max(1, static_cast<int>(std::ceil(width / k_most_length)));
    auto height_at = [&](float share, float off) {
        Vec2 at = a + along * share + outwards * off;
        std::optional<GroundHit> hit =
            ground_at(out.city.ground, at_height(at, lerp(f.a.y, f.b.y, share)), k_step_over, k_step_over);
        return hit ? hit->height : 1e6f;
    };
    bool is_even = true;
    for (float off : {k_gap, strip.width}) {
        float first = height_at(0, off), last = height_at(1, off);
        for (int i = 1; i < pieces; ++i) {
            float share = static_cast<float>(i) / static_cast<float>(pieces);
            is_even = is_even && std::fabs(height_at(share, off) - lerp(first, last, share)) < k_lift / 3;
        }
    }
    if (is_even) pieces = 1;
    std::optional<uint32_t> before[2];
    for (int i = 0; i <= pieces; ++i) {
        float share = static_cast<float>(i) / static_cast<float>(pieces);
        Vec2 foot = a + along * share;
        float height = lerp(f.a.y, f.b.y, share);
        std::optional<uint32_t> inner = add_vertex(out, foot + outwards * k_gap, height, 0, strip.strength);
        std::optional<uint32_t> outer =
            add_vertex(out, foot + outwards * strip.width, height, 1, strip.strength);
        if (i > 0) add_quad(out, {before[0], inner, outer, before[1]});
        before[0] = inner, before[1] = outer;
    }
    // Round a corner that points outwards, behind which there is ground; the next wall leaves it out.
    Vec2 ahead = along / width, corner = a + along;
    if (!ground_at(out.city.ground, at_height(corner + (ahead - outwards) * 0.3f, f.b.y), k_step_over,
                   k_step_over))
        return;
    constexpr int k_pieces = 3;
    for (int i = 1; i <= k_pieces; ++i) {
        SinCos turn = sin_cos(static_cast<float>(i) * (k_pi / 2 / k_pieces));
        Vec2 way = outwards * turn.cosine + ahead * turn.sine;
        std::optional<uint32_t> outer = add_vertex(out, corner + way * strip.width, f.b.y, 1, strip.strength);
        if (before[0] && before[1] && outer)
            for (uint32_t v : {*before[0], *outer, *before[1]}) out.mesh.indices.push_back(v);
        before[1] = outer;
    }
}

// From `inner` metres about a prop to `outer`; 0 is its middle.
void add_ring(Shades& out, const Prop& prop, float inner, float outer, float strength, int sides) {
    Vec2 middle = on_ground(prop.position);
    std::optional<uint32_t> before[2];
    std::optional<uint32_t> near = add_vertex(out, middle, prop.position.y, 0, strength);
    for (int i = 0; i <= sides; ++i) {
        Vec2 way = heading_direction(static_cast<float>(i % sides) * (2 * k_pi / static_cast<float>(sides)));
        if (inner > 0) near = add_vertex(out, middle + way * inner, prop.position.y, 0, strength);
        std::optional<uint32_t> far = add_vertex(out, middle + way * outer, prop.position.y, 1, strength);
        if (i > 0 && near && far && before[1])
            for (uint32_t v : {*near, *far, *before[1]}) out.mesh.indices.push_back(v);
        if (i > 0 && inner > 0 && near && before[0] && before[1])
            for (uint32_t v : {*near, *before[1], *before[0]}) out.mesh.indices.push_back(v);
        before[0] = near, before[1] = far;
    }
}

// Darkest within `margin` of a prop's footprint, gone as far outside.
void add_footprint(Shades& out, const Prop& prop, float margin, float strength) {
    Vec2 half = half_footprint(prop), ahead = heading_direction(prop.yaw), side{ahead.z, -ahead.x};
    std::optional<uint32_t> corners[16];
    for (int i = 0; i < 16; ++i) {
        const float signs[] = {-1, -1, 1, 1};
        int column = i % 4, row = i / 4;
        bool is_inner = (column == 1 || column == 2) && (row == 1 || row == 2);
        float x = signs[column] * std::max(half.x + (column % 3 ? -margin : margin) * 0.8f, 0.02f);
        float z = signs[row] * std::max(half.z + (row % 3 ? -margin : margin) * 0.8f, 0.02f);
        corners[i] = add_vertex(out, on_ground(prop.position) + side * x + ahead * z, prop.position.y,
                                is_inner ? 0.0f : 1.0f, strength);
    }
    for (int i = 0; i < 11; ++i)
        if (i % 4 < 3) add_quad(out, {corners[i], corners[i + 1], corners[i + 5], corners[i + 4]});
}

void add_prop_shade(Shades& out, const Prop& prop) {
    switch (prop.kind) {
        case PropKind::tree:
            add_ring(out, prop, 0, prop.radius * 1.1f, 0.36f, 10);
            return;
        case PropKind::fountain:
            add_ring(out, prop, prop.radius * 0.97f, prop.radius + 0.6f, 0.4f, 20);
            return;
        case PropKind::car:
            add_footprint(out, prop, 0.5f, 0.75f);
            return;
        case PropKind::bench:
        case PropKind::shelter:
        case PropKind::barrier:
            add_footprint(out, prop, 0.25f, 0.3f);
            return;
        case PropKind::statue:
        case PropKind::planter:
        case PropKind::bin:
            add_footprint(out, prop, 0.25f, 0.45f);
            return;
        case PropKind::lamp:
        case PropKind::bollard:
        case PropKind::signal:
            add_ring(out, prop, 0, 0.38f, 0.5f, 6);
            return;
    }
}

void add_groove(Shades& out, const City::Groove& groove) {
    constexpr float k_half = 0.045f, k_strength = 0.55f;
    Vec2 a = on_ground(groove.a), b = on_ground(groove.b), along = normalize_or(b - a, {1, 0});
    Vec2 side = Vec2{-along.z, along.x} * k_half;
    add_quad(out, {add_vertex(out, a - side, groove.a.y, 0, k_strength),
                   add_vertex(out, b - side, groove.b.y, 0, k_strength),
                   add_vertex(out, b + side, groove.b.y, 0, k_strength),
                   add_vertex(out, a + side, groove.a.y, 0, k_strength)});
}

Strip strip_of(const City& city, const Face& f) {
    switch (f.kind) {
        case FaceKind::facade:
            // Windows in roofs have no street before them.
            if (f.building < city.buildings.size() && f.a.y > city.buildings[f.building].top) return {0, 0};
            return {1.2f, 0.40f};
        case FaceKind::garden_wall:
            return {0.8f, 0.36f};
        case FaceKind::kerb:
        case FaceKind::riser:
            return {0, 0};  // too low for their triangles' worth
    }
    return {0, 0};
}

}  // namespace

void add_shades(const City& city, CityMesh& mesh) {
    Shades out{mesh, city};
    for (const Face& f : city.ground.faces) {
        Strip strip = strip_of(city, f);
        if (strip.width > 0) add_strip(out, f, strip);
    }
    for (const Prop& prop : city.props) add_prop_shade(out, prop);
    for (const City::Groove& groove : city.grooves) add_groove(out, groove);
}

}  // namespace flaneur
