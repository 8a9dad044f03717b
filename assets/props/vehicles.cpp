#include "assets/props/vehicles.h"

#include <algorithm>
#include <iterator>

#include "assets/props/bodies.h"
#include "assets/props/shapes.h"

namespace flaneur {

namespace {

constexpr VehicleWheel k_car_wheels[] = {{{0.79f, 0.31f, 1.32f}, 0.31f, true},
                                         {{-0.79f, 0.31f, 1.32f}, 0.31f, true},
                                         {{0.8f, 0.31f, -1.28f}, 0.31f, false},
                                         {{-0.8f, 0.31f, -1.28f}, 0.31f, false}};
constexpr VehicleWheel k_van_wheels[] = {{{0.9f, 0.34f, 1.7f}, 0.34f, true},
                                         {{-0.9f, 0.34f, 1.7f}, 0.34f, true},
                                         {{0.9f, 0.34f, -1.6f}, 0.34f, false},
                                         {{-0.9f, 0.34f, -1.6f}, 0.34f, false}};
constexpr VehicleWheel k_bus_wheels[] = {{{1.13f, 0.48f, 3.2f}, 0.48f, true},
                                         {{-1.13f, 0.48f, 3.2f}, 0.48f, true},
                                         {{1.13f, 0.48f, -2.6f}, 0.48f, false},
                                         {{-1.13f, 0.48f, -2.6f}, 0.48f, false}};
// Of a bogie.
constexpr VehicleWheel k_tram_wheels[] = {{{0.71f, 0.3f, 0.9f}, 0.3f, false},
                                          {{-0.71f, 0.3f, 0.9f}, 0.3f, false},
                                          {{0.71f, 0.3f, -0.9f}, 0.3f, false},
                                          {{-0.71f, 0.3f, -0.9f}, 0.3f, false}};
constexpr VehicleWheel k_bicycle_wheels[] = {{{0, 0.34f, 0.54f}, 0.34f, true},
                                             {{0, 0.34f, -0.53f}, 0.34f, false}};

// The shade of arches over wheels.
void add_arches(PropMesh& mesh, std::span<const VehicleWheel> wheels, float half_width) {
    constexpr int k_sides = 8;
    for (const VehicleWheel& w : wheels) {
        const float side = w.hub.x > 0 ? 1.0f : -1.0f, x = side * (half_width + 0.006f), r = w.radius + 0.07f;
        auto rim = [&](int k) {
            const SinCos turn = sin_cos(k_pi * static_cast<float>(k) / k_sides);
            return Vec3{x, w.hub.y + r * turn.sine, w.hub.z + r * turn.cosine};
        };
        const Vec3 middle{x, w.hub.y, w.hub.z};
        for (int k = 0; k < k_sides; k += 2)
            side < 0 ? add_quad(mesh, middle, rim(k), rim(k + 1), rim(k + 2), PropPart::tyre)
                     : add_quad(mesh, middle, rim(k + 2), rim(k + 1), rim(k), PropPart::tyre);
    }
}

void add_lamps(PropMesh& mesh, float x, float front_y, float front_z, float back_y, float back_z) {
    for (const float side : {-1.0f, 1.0f}) {
        add_box(mesh, {side * x, front_y, front_z}, {0.15f, 0.08f, 0.03f}, 0, PropPart::light);
        add_box(mesh, {side * (x + 0.05f), back_y, back_z}, {0.08f, 0.16f, 0.03f}, 0, PropPart::red);
    }
}

void add_van(PropMesh& mesh) {
    const BodySection sections[] = {
        {-2.65f, 0.32f, 0.88f, 1.3f, 0.93f, 2.24f, 0.84f}, {-2.58f, 0.25f, 0.92f, 1.3f, 0.97f, 2.33f, 0.88f},
        {0.95f, 0.25f, 0.93f, 1.3f, 0.97f, 2.35f, 0.88f},  {1.25f, 0.25f, 0.93f, 1.28f, 0.97f, 2.28f, 0.84f},
        {2.0f, 0.25f, 0.92f, 1.14f, 0.95f, 1.3f, 0.84f},   {2.5f, 0.25f, 0.9f, 0.95f, 0.92f, 1.1f, 0.82f},
        {2.65f, 0.34f, 0.82f, 0.62f, 0.86f, 0.8f, 0.78f}};
    add_skin(mesh, sections, PropPart::paint);
    add_across(mesh, 0.8f, 1.34f, 2.03f, 2.18f, 1.34f, true, PropPart::glass);
    add_on_side(mesh, 0.983f, 0.93f, 0.55f, 1.42f, 1.32f, 1.95f, PropPart::glass);
    add_across(mesh, 0.7f, 1.4f, -2.665f, 2.0f, -2.64f, false, PropPart::glass);
    add_on_side(mesh, 0.982f, 0.982f, -2.4f, 1.2f, 0.55f, 0.62f, PropPart::tyre);
    add_lamps(mesh, 0.66f, 0.92f, 2.55f, 1.0f, -2.64f);
    add_arches(mesh, k_van_wheels, 0.97f);
    for (const float side : {-1.0f, 1.0f})
        add_box(mesh, {side * 1.05f, 1.45f, 1.5f}, {0.09f, 0.15f, 0.06f}, 0, PropPart::tyre);
}

void add_bus(PropMesh& mesh) {
    const BodySection sections[] = {{-5.8f, 0.4f, 1.16f, 1.2f, 1.2f, 2.9f, 1.08f},
                                    {-5.68f, 0.3f, 1.2f, 1.2f, 1.25f, 3.03f, 1.16f},
                                    {5.45f, 0.3f, 1.2f, 1.2f, 1.25f, 3.05f, 1.16f},
                                    {5.7f, 0.32f, 1.16f, 1.2f, 1.22f, 2.98f, 1.12f},
                                    {5.8f, 0.42f, 1.1f, 1.15f, 1.15f, 2.86f, 1.02f}};
    add_skin(mesh, sections, PropPart::paint);
    // Panes all along, with posts between.
    for (int k = 0; k < 7; ++k) {
        const float z = -5.3f + 1.52f * static_cast<float>(k);
        add_on_side(mesh, 1.257f, 1.235f, z, z + 1.42f, 1.25f, 2.5f, PropPart::glass);
    }
    add_across(mesh, 1.02f, 1.05f, 5.815f, 2.5f, 5.805f, true, PropPart::glass);
    add_across(mesh, 0.95f, 2.6f, 5.81f, 2.82f, 5.803f, true, PropPart::tyre);
    add_across(mesh, 1.0f, 1.55f, -5.812f, 2.55f, -5.806f, false, PropPart::glass);
    // Doors, at the right.
    for (const float z : {3.95f, -0.6f}) {
        const Vec3 a{-1.262f, 0.36f, z}, b{-1.262f, 0.36f, z + 1.25f}, c{-1.24f, 2.5f, z + 1.25f},
            d{-1.24f, 2.5f, z};
        add_quad(mesh, a, b, c, d, PropPart::glass);
    }
    add_on_side(mesh, 1.256f, 1.256f, -5.6f, 5.4f, 0.62f, 0.72f, PropPart::white);
    add_lamps(mesh, 0.85f, 0.75f, 5.76f, 1.05f, -5.79f);
    add_arches(mesh, k_bus_wheels, 1.25f);
    for (const float side : {-1.0f, 1.0f})
        add_box(mesh, {side * 1.36f, 2.25f, 5.75f}, {0.09f, 0.22f, 0.07f}, 0, PropPart::tyre);
}

void add_bicycle(PropMesh& mesh) {
    auto tube = [&](Vec3 a, Vec3 b, float radius, PropPart part) {
        add_post(mesh, a, b, radius, radius, 6, part, false);
    };
    const RiderHolds holds;
    const Vec3 crank = holds.crank, rear{0, 0.34f, -0.53f}, front{0, 0.34f, 0.54f}, head{0, 0.86f, 0.33f},
               neck{0, 0.72f, 0.38f}, seat{0, 0.76f, -0.19f};
    const Vec3 bars{0, 1.0f, 0.31f};
    tube(crank, neck, 0.018f, PropPart::paint), tube(crank, seat, 0.016f, PropPart::paint);
    tube(seat, head, 0.016f, PropPart::paint), tube(neck, head, 0.02f, PropPart::paint);
    for (const float side : {-0.03f, 0.03f}) {
        const Vec3 off{side, 0, 0};
        tube(rear + off, crank + off, 0.01f, PropPart::paint), tube(rear + off, seat, 0.01f, PropPart::paint);
        tube(front + off, neck, 0.013f, PropPart::paint);
    }
    tube(seat, {0, 0.88f, -0.23f}, 0.013f, PropPart::alloy), tube(head, bars, 0.013f, PropPart::alloy);
    add_box(mesh, {0, 0.895f, -0.24f}, {0.07f, 0.025f, 0.13f}, 0, PropPart::tyre);
    for (const float side : {-1.0f, 1.0f})
        tube(bars, {side * holds.grip.x, holds.grip.y - 0.03f, holds.grip.z - 0.06f}, 0.012f,
             PropPart::alloy),
            tube({side * (holds.grip.x - 0.06f), holds.grip.y - 0.03f, holds.grip.z - 0.06f},
                 {side * (holds.grip.x + 0.05f), holds.grip.y - 0.03f, holds.grip.z - 0.09f}, 0.017f,
                 PropPart::tyre);
    add_box(mesh, {0, 0.9f, 0.42f}, {0.03f, 0.03f, 0.03f}, 0, PropPart::light);
    add_box(mesh, {0, 0.72f, -0.5f}, {0.025f, 0.03f, 0.02f}, 0, PropPart::red);
}

// A tyre with a dish and spokes to either side.
void add_car_wheel(PropMesh& mesh, const VehicleWheel& w, float half_width) {
    constexpr int k_sides = 16, k_spokes = 5;
    const float side = w.hub.x > 0 ? 1.0f : -1.0f;
    auto rim = [&](float radius, float out, float turn) {
        const SinCos at = sin_cos(turn);
        return Vec3{side * out, radius * at.sine, radius * at.cosine};
    };
    auto add = [&](Vec3 a, Vec3 b, Vec3 c, Vec3 d, PropPart part) {
        side < 0 ? add_quad(mesh, a, b, c, d, part) : add_quad(mesh, b, a, d, c, part);
    };
    const float inner = w.radius * 0.66f;
    for (int k = 0; k < k_sides; ++k) {
        const float a = 2 * k_pi * static_cast<float>(k) / k_sides,
                    b = 2 * k_pi * static_cast<float>(k + 1) / k_sides;
        add(rim(w.radius, -half_width, a), rim(w.radius, -half_width, b), rim(w.radius, half_width, b),
            rim(w.radius, half_width, a), PropPart::tyre);
        add(rim(w.radius, half_width, a), rim(w.radius, half_width, b), rim(inner, half_width + 0.01f, b),
            rim(inner, half_width + 0.01f, a), PropPart::tyre);
        add(rim(inner, half_width + 0.01f, a), rim(inner, half_width + 0.01f, b),
            rim(0, half_width - 0.02f, b), rim(0, half_width - 0.02f, a), PropPart::metal);
    }
    for (int k = 0; k < k_spokes; ++k) {
        const float at = 2 * k_pi * static_cast<float>(k) / k_spokes, wide = 0.28f;
        add(rim(inner * 0.95f, half_width + 0.012f, at - wide),
            rim(inner * 0.95f, half_width + 0.012f, at + wide),
            rim(inner * 0.22f, half_width + 0.004f, at + 2 * wide),
            rim(inner * 0.22f, half_width + 0.004f, at - 2 * wide), PropPart::alloy);
    }
}

void add_bicycle_wheel(PropMesh& mesh, const VehicleWheel& w) {
    constexpr int k_sides = 20;
    constexpr float k_half = 0.018f;
    for (int k = 0; k < k_sides; ++k) {
        auto at = [&](float radius, float x, int n) {
            const SinCos turn = sin_cos(2 * k_pi * static_cast<float>(n % k_sides) / k_sides);
            return Vec3{x, -radius * turn.sine, radius * turn.cosine};
        };
        const float r = w.radius, in = r - 0.045f;
        add_quad(mesh, at(r, k_half, k), at(r, -k_half, k), at(r, -k_half, k + 1), at(r, k_half, k + 1),
                 PropPart::tyre);
        add_quad(mesh, at(in, -k_half, k), at(in, k_half, k), at(in, k_half, k + 1), at(in, -k_half, k + 1),
                 PropPart::tyre);
        add_quad(mesh, at(r, -k_half, k), at(in, -k_half, k), at(in, -k_half, k + 1), at(r, -k_half, k + 1),
                 PropPart::tyre);
        add_quad(mesh, at(in, k_half, k), at(r, k_half, k), at(r, k_half, k + 1), at(in, k_half, k + 1),
                 PropPart::tyre);
    }
    for (int k = 0; k < 8; ++k) {
        const SinCos turn = sin_cos(k_pi * static_cast<float>(k) / 8);
        const Vec3 out{0, turn.sine * (w.radius - 0.03f), turn.cosine * (w.radius - 0.03f)};
        add_post(mesh, -out, out, 0.003f, 0.003f, 3, PropPart::alloy, false);
    }
}

}  // namespace

void add_skin(PropMesh& mesh, std::span<const BodySection> sections, PropPart part) {
    std::vector<Vec3> points;
    for (const BodySection& s : sections) {
        const Vec2 half[] = {{s.half_foot, s.foot},
                             {s.half, lerp(s.foot, s.shoulder, 0.25f)},
                             {s.half, s.shoulder},
                             {s.half_top + 0.04f, s.top - 0.06f},
                             {s.half_top - 0.06f, s.top}};
        for (const Vec2 p : half) points.push_back({-p.x, p.z, s.z});
        for (size_t k = std::size(half); k-- > 0;) points.push_back({half[k].x, half[k].z, s.z});
    }
    constexpr size_t k_columns = 10;
    add_sheet(mesh, points, k_columns, part);
    for (const bool front : {false, true}) {
        const Vec3* row = &points[front ? points.size() - k_columns : 0];
        for (size_t k = 0; k + 1 < k_columns / 2; ++k) {
            const Vec3 a = row[k], b = row[k_columns - 1 - k], c = row[k_columns - 2 - k], d = row[k + 1];
            front ? add_quad(mesh, a, b, c, d, part) : add_quad(mesh, b, a, d, c, part);
        }
    }
}

void add_on_side(PropMesh& mesh, float x, float top_x, float z0, float z1, float y0, float y1,
                 PropPart part) {
    for (const float side : {-1.0f, 1.0f}) {
        const Vec3 a{side * x, y0, z0}, b{side * x, y0, z1}, c{side * top_x, y1, z1}, d{side * top_x, y1, z0};
        side > 0 ? add_quad(mesh, b, a, d, c, part) : add_quad(mesh, a, b, c, d, part);
    }
}

void add_across(PropMesh& mesh, float x, float y0, float z0, float y1, float z1, bool front, PropPart part) {
    const Vec3 a{-x, y0, z0}, b{x, y0, z0}, c{x * 0.96f, y1, z1}, d{-x * 0.96f, y1, z1};
    front ? add_quad(mesh, a, b, c, d, part) : add_quad(mesh, b, a, d, c, part);
}

std::span<const VehicleWheel> wheels_of(VehicleModel model) {
    switch (model) {
        case VehicleModel::van:
            return k_van_wheels;
        case VehicleModel::bus:
            return k_bus_wheels;
        case VehicleModel::bicycle:
            return k_bicycle_wheels;
        case VehicleModel::tram_head:
        case VehicleModel::tram_collector:
        case VehicleModel::tram_tail:
            return k_tram_wheels;
        case VehicleModel::tram_middle:
            return {};
        default:
            return k_car_wheels;
    }
}

void add_vehicle(PropMesh& mesh, VehicleModel model) {
    if (model == VehicleModel::bicycle) return add_bicycle(mesh);
    Vec2 below{0.8f, 2};
    if (model == VehicleModel::van) {
        add_van(mesh), below = {0.9f, 2.5f};
    } else if (model == VehicleModel::bus) {
        add_bus(mesh), below = {1.15f, 5.6f};
    } else if (is_tram(model)) {
        add_tram(mesh, model), below = {1.1f, 3};
    } else {
        add_car_body(mesh, PropFrame(Prop{}), static_cast<size_t>(model));
        add_arches(mesh, k_car_wheels, 0.875f);
    }
    // No sky is seen from the road below.
    const float y = 0.03f;
    add_quad(mesh, {below.x, y, -below.z}, {-below.x, y, -below.z}, {-below.x, y, below.z},
             {below.x, y, below.z}, PropPart::tyre, 0.6f);
}

void add_cranks(PropMesh& mesh) {
    const RiderHolds holds;
    for (const float side : {1.0f, -1.0f}) {
        const Vec3 hub{side * 0.06f, 0, 0}, end{side * 0.07f, 0, side * holds.crank_length};
        add_post(mesh, hub, end, 0.012f, 0.01f, 6, PropPart::alloy, false);
        add_box(mesh, end + Vec3{side * 0.05f, 0, 0}, {0.045f, 0.012f, 0.04f}, 0, PropPart::tyre);
    }
}

void add_wheel(PropMesh& mesh, VehicleModel model, const VehicleWheel& wheel) {
    if (model == VehicleModel::bicycle) return add_bicycle_wheel(mesh, wheel);
    add_car_wheel(mesh, wheel, model == VehicleModel::bus ? 0.14f : is_tram(model) ? 0.06f : 0.09f);
}

}  // namespace flaneur
