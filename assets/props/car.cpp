// Parked cars.
#include <algorithm>
#include <iterator>

#include "assets/props/shapes.h"

namespace flaneur {

namespace {

// Kinds of body: heights and places in metres, places counted from the middle towards the front.
struct CarShape {
    float half_length, half_width, height;
    float belt, nose;  // height of the sills of the windows, and of the bonnet's front edge
    float screen_foot, screen_top, back_top, back_foot;  // of windscreen and rear window
    float boot;                                          // height behind the rear window
};

constexpr CarShape k_shapes[] = {
    {2.12f, 0.87f, 1.47f, 0.95f, 0.74f, 0.95f, 0.28f, -1.35f, -1.98f, 0.98f},  // hatchback
    {2.15f, 0.88f, 1.44f, 0.94f, 0.72f, 0.90f, 0.22f, -0.95f, -1.55f, 0.98f},  // saloon
    {2.15f, 0.88f, 1.50f, 0.96f, 0.76f, 0.98f, 0.34f, -1.78f, -2.06f, 1.00f},  // estate
};

void add_shell(PropMesh& mesh, const PropFrame& f, const CarShape& s) {
    struct Section {
        float z, top, width, foot;
    };
    const Section sections[] = {
        {-s.half_length, 0.55f, 0.86f, 0.36f},          {-s.half_length + 0.04f, s.boot - 0.1f, 0.91f, 0.27f},
        {-s.half_length + 0.25f, s.boot, 0.97f, 0.22f}, {-0.6f, s.belt + 0.01f, 1, 0.22f},
        {s.screen_foot, s.belt, 0.99f, 0.22f},          {s.half_length - 0.45f, s.nose + 0.1f, 0.96f, 0.22f},
        {s.half_length - 0.08f, s.nose, 0.88f, 0.26f},  {s.half_length, 0.52f, 0.82f, 0.36f},
    };
    // Each section runs from the right sill over the top to the left one.
    std::vector<Vec3> points;
    for (const Section& c : sections) {
        float w = s.half_width * c.width;
        const Vec2 half[] = {{w * 0.95f, c.foot},
                             {w, lerp(c.foot, c.top, 0.38f)},
                             {w * 0.985f, lerp(c.foot, c.top, 0.78f)},
                             {w * 0.93f, c.top - 0.025f},
                             {w * 0.80f, c.top}};
        const int step = mesh.is_far ? 2 : 1;
        for (int k = 0; k < 5; k += step) points.push_back(f.at(-half[k].x, half[k].z, c.z));
        for (int k = 4; k >= 0; k -= step) points.push_back(f.at(half[k].x, half[k].z, c.z));
    }
    const size_t columns = points.size() / std::size(sections);
    add_sheet(mesh, points, columns, PropPart::paint);
    for (bool front : {false, true}) {
        size_t row = front ? std::size(sections) - 1 : 0;
        for (size_t k = 0; k + 1 < columns / 2; ++k) {
            const Vec3 *left = &points[row * columns + k], *right = &points[(row + 1) * columns - 1 - k];
            Vec3 a = left[0], b = left[1], c = right[-1], d = right[0];
            PropPart part = k == 0 ? PropPart::tyre : PropPart::paint;
            front ? add_quad(mesh, a, d, c, b, part) : add_quad(mesh, a, b, c, d, part);
        }
    }
    // Bumpers' undersides and sills are dark.
    for (float side : {-1.0f, 1.0f}) {
        float x = side * s.half_width * 0.955f;
        Vec3 a = f.at(x, 0.2f, -1.7f), b = f.at(x, 0.2f, 1.7f), c = f.at(x + side * 0.012f, 0.33f, 1.7f),
             d = f.at(x + side * 0.012f, 0.33f, -1.7f);
        side > 0 ? add_quad(mesh, b, a, d, c, PropPart::tyre) : add_quad(mesh, a, b, c, d, PropPart::tyre);
    }
}

void add_cabin(PropMesh& mesh, const PropFrame& f, const CarShape& s) {
    float low = s.half_width * 0.90f, high = s.half_width * 0.70f, edge = s.height - 0.06f;
    float foot = s.belt - 0.02f;
    auto side_point = [&](float side, float u, bool top) {
        float z = top ? lerp(s.screen_top, s.back_top, u) : lerp(s.screen_foot, s.back_foot, u);
        return f.at(side * (top ? high : low), top ? edge : foot, z);
    };
    const float cuts[] = {0, 0.07f, 0.45f, 0.495f, 0.84f, 1};
    for (float side : {-1.0f, 1.0f}) {
        for (int k = 0; k < 5; ++k) {
            PropPart part = k % 2 == 1 ? PropPart::glass : PropPart::paint;
            Vec3 a = side_point(side, cuts[k], false), b = side_point(side, cuts[k + 1], false),
                 c = side_point(side, cuts[k + 1], true), d = side_point(side, cuts[k], true);
            side > 0 ? add_quad(mesh, a, b, c, d, part) : add_quad(mesh, b, a, d, c, part);
        }
    }
    auto across = [&](float z_low, float z_high, bool front) {
        Vec3 a = f.at(-low, foot, z_low), b = f.at(low, foot, z_low), c = f.at(high, edge, z_high),
             d = f.at(-high, edge, z_high);
        front ? add_quad(mesh, a, b, c, d, PropPart::glass) : add_quad(mesh, b, a, d, c, PropPart::glass);
    };
    across(s.screen_foot, s.screen_top, true);
    across(s.back_foot, s.back_top, false);
    float front = s.screen_top, back = s.back_top;
    if (mesh.is_far) {
        add_quad(mesh, f.at(-high, edge, front), f.at(high, edge, front), f.at(high, edge, back),
                 f.at(-high, edge, back), PropPart::paint);
        return;
    }
    std::vector<Vec3> roof;
    const Vec2 rows[] = {
        {back, 0}, {lerp(back, front, 0.12f), 0.05f}, {lerp(back, front, 0.8f), 0.06f}, {front, 0}};
    for (Vec2 row : rows) {
        for (float x : {-1.0f, -0.8f, 0.8f, 1.0f})
            roof.push_back(f.at(x * high, edge + (x * x < 0.9f ? row.z : 0), row.x));
    }
    add_sheet(mesh, roof, 4, PropPart::paint);
}

void add_wheel(PropMesh& mesh, const PropFrame& f, float x, float z) {
    constexpr float k_radius = 0.31f;
    const uint32_t sides = mesh.is_far ? 4 : 8;
    float side = x > 0 ? 1.0f : -1.0f;
    auto rim = [&](float radius, float out, uint32_t i) {
        SinCos turn = sin_cos(2 * k_pi * static_cast<float>(i % sides) / static_cast<float>(sides));
        return f.at(x + side * out, k_radius + radius * turn.sine, z + radius * turn.cosine);
    };
    struct Ring {
        float radius, out;
        PropPart part;
    };
    if (mesh.is_far) {
        for (auto [radius, out, part] :
             {Ring{0.36f, 0.01f, PropPart::tyre}, {0.2f, 0.03f, PropPart::alloy}}) {
            Vec3 a = rim(radius, out, 0), b = rim(radius, out, 1), c = rim(radius, out, 2),
                 d = rim(radius, out, 3);
            side < 0 ? add_quad(mesh, a, b, c, d, part) : add_quad(mesh, b, a, d, c, part);
        }
        return;
    }
    // The arch's shade over the wheel, the tyre's side, the dish, each a ring to the next.
    const Ring rings[] = {{0.375f, 0.004f, PropPart::tyre},
                          {k_radius, 0.012f, PropPart::tyre},
                          {0.2f, 0.03f, PropPart::alloy},
                          {0.0f, 0.02f, PropPart::alloy}};
    for (size_t r = 0; r + 1 < std::size(rings); ++r) {
        for (uint32_t i = 0; i < (r == 0 ? sides / 2 : sides); ++i) {
            Vec3 a = rim(rings[r].radius, rings[r].out, i), b = rim(rings[r].radius, rings[r].out, i + 1);
            Vec3 c = rim(rings[r + 1].radius, rings[r + 1].out, i + 1),
                 d = rim(rings[r + 1].radius, rings[r + 1].out, i);
            side < 0 ? add_quad(mesh, a, b, c, d, rings[r].part) : add_quad(mesh, b, a, d, c, rings[r].part);
        }
    }
    // What touches the road, below the sill.
    for (uint32_t i = sides / 2; i < sides; ++i) {
        Vec3 a = rim(k_radius, 0, i), b = rim(k_radius, 0, i + 1), c = rim(k_radius, -0.18f, i + 1),
             d = rim(k_radius, -0.18f, i);
        side > 0 ? add_quad(mesh, a, b, c, d, PropPart::tyre) : add_quad(mesh, b, a, d, c, PropPart::tyre);
    }
}

void add_lamps(PropMesh& mesh, const PropFrame& f, const CarShape& s) {
    for (float side : {-1.0f, 1.0f}) {
        float z = s.half_length - 0.05f, x = side * 0.56f, y = s.nose - 0.09f;
        if (mesh.is_far) {
            float end = -s.half_length - 0.01f, low = s.boot - 0.28f;
            add_quad(mesh, f.at(x - 0.16f, y - 0.055f, z + 0.03f), f.at(x + 0.16f, y - 0.055f, z + 0.03f),
                     f.at(x + 0.16f, y + 0.055f, z + 0.03f), f.at(x - 0.16f, y + 0.055f, z + 0.03f),
                     PropPart::light);
            add_quad(mesh, f.at(side * 0.66f + 0.1f, low, end), f.at(side * 0.66f - 0.1f, low, end),
                     f.at(side * 0.66f - 0.1f, low + 0.16f, end), f.at(side * 0.66f + 0.1f, low + 0.16f, end),
                     PropPart::red);
            continue;
        }
        add_box(mesh, f.at(x, y, z - 0.02f), {0.16f, 0.055f, 0.05f}, f.yaw, PropPart::light);
        add_box(mesh, f.at(side * 0.66f, s.boot - 0.2f, -s.half_length + 0.04f), {0.1f, 0.08f, 0.05f}, f.yaw,
                PropPart::red);
        add_box(mesh, f.at(side * (s.half_width + 0.07f), s.belt + 0.04f, s.screen_foot - 0.28f),
                {0.08f, 0.06f, 0.05f}, f.yaw, PropPart::paint);
    }
}

}  // namespace

void add_car(PropMesh& mesh, const Prop& car) {
    PropFrame f(car);
    const CarShape& s = k_shapes[random_bits({car.seed, 0, 0, Purpose::style}) % std::size(k_shapes)];
    add_shell(mesh, f, s);
    add_cabin(mesh, f, s);
    for (float z : {-1.28f, 1.32f}) {
        for (float side : {-1.0f, 1.0f}) add_wheel(mesh, f, side * s.half_width * (z > 0 ? 0.98f : 1), z);
    }
    add_lamps(mesh, f, s);
}

void add_car_body(PropMesh& mesh, const PropFrame& f, size_t shape) {
    const CarShape& s = k_shapes[shape % std::size(k_shapes)];
    add_shell(mesh, f, s);
    add_cabin(mesh, f, s);
    add_lamps(mesh, f, s);
}

}  // namespace flaneur
