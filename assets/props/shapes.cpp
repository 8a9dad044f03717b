#include "assets/props/shapes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace flaneur {

namespace {

struct SphereMesh {
    std::vector<Vec3> points;
    std::vector<uint32_t> triangles, coarse;  // coarse: over the first 12 points
};

// An icosahedron, and each of its triangles split into four and brought to the unit sphere: 42 points, 80
// triangles.
SphereMesh make_sphere() {
    constexpr float g = 1.618034f;
    SphereMesh s;
    s.points = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    const uint32_t faces[] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                              4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                              6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    auto middle = [&](uint32_t a, uint32_t b) {
        auto [place, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(s.points.size()));
        if (fresh) s.points.push_back((s.points[a] + s.points[b]) * 0.5f);
        return place->second;
    };
    for (size_t t = 0; t < std::size(faces); t += 3) {
        uint32_t a = faces[t], b = faces[t + 1], c = faces[t + 2];
        uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        for (uint32_t i : {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca}) s.triangles.push_back(i);
        for (uint32_t i : {a, b, c}) s.coarse.push_back(i);
    }
    for (Vec3& p : s.points) p = p / length(p);
    return s;
}

}  // namespace

void add_clump(PropMesh& mesh, Vec3 centre, Vec3 size, Vec3 crown, Vec3 crown_size, RandomKey key,
               uint32_t draw, float lightness, PropPart part) {
    static const SphereMesh sphere = make_sphere();
    constexpr size_t k_coarse_points = 12;
    constexpr float k_swell = 1.09f;  // makes up for what lies beyond the coarse sphere's faces
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    if (mesh.is_far) size = size * k_swell;
    for (size_t i = 0; i < (mesh.is_far ? k_coarse_points : sphere.points.size()); ++i) {
        const Vec3& p = sphere.points[i];
        float bump = random_between(key, 0.86f, 1.12f, draw + static_cast<uint32_t>(i));
        Vec3 at = centre + Vec3{p.x * size.x, (p.y < 0 ? p.y * 0.8f : p.y) * size.y, p.z * size.z} * bump;
        Vec3 out{(at.x - crown.x) / crown_size.x, (at.y - crown.y) / crown_size.y,
                 (at.z - crown.z) / crown_size.z};
        float depth = length(out);  // 0 in the middle of the crown .. 1 at its skin
        float shade = lightness * lerp(0.62f, 1.04f, smoothstep(0.25f, 1.0f, depth)) *
                      lerp(0.80f, 1.06f, smoothstep(-0.8f, 0.6f, out.y));
        mesh.vertices.push_back({at, normalize_or(p * 0.65f + out, p), part, shade});
    }
    for (uint32_t i : mesh.is_far ? sphere.coarse : sphere.triangles) mesh.indices.push_back(first + i);
}

void add_post(PropMesh& mesh, Vec3 foot, Vec3 top, float foot_radius, float top_radius, uint32_t sides,
              PropPart part, bool cap) {
    if (mesh.is_far) sides = std::min(sides, 4u), cap = false;
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    Vec3 axis = normalize_or(top - foot, {0, 1, 0});
    Quat stand = rotation_between({0, 1, 0}, axis);
    for (uint32_t i = 0; i < sides; ++i) {
        SinCos around = sin_cos(2 * k_pi * (static_cast<float>(i) + 0.5f) / static_cast<float>(sides));
        Vec3 out = rotate(stand, Vec3{around.sine, 0, around.cosine});
        mesh.vertices.push_back({foot + out * foot_radius, out, part, 0.9f});
        mesh.vertices.push_back({top + out * top_radius, out, part, 1});
    }
    for (uint32_t i = 0; i < sides; ++i) {
        uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides);
        for (uint32_t v : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(v);
    }
    if (!cap) return;
    auto rim = static_cast<uint32_t>(mesh.vertices.size());
    for (uint32_t i = 0; i < sides; ++i) {
        PropMesh::Vertex v = mesh.vertices[first + 2 * i + 1];
        v.normal = axis;
        mesh.vertices.push_back(v);
    }
    for (uint32_t i = 1; i + 1 < sides; ++i) {
        for (uint32_t v : {rim, rim + i, rim + i + 1}) mesh.indices.push_back(v);
    }
}

void add_box(PropMesh& mesh, Vec3 centre, Vec3 half, float yaw, PropPart part) {
    Quat turn = rotation_y(yaw);
    for (int axis = 0; axis < 3; ++axis) {
        for (float sign : {-1.0f, 1.0f}) {
            Vec3 n{axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0};
            Vec3 u{n.y, n.z, n.x};
            Vec3 v = cross(n, u);
            auto first = static_cast<uint32_t>(mesh.vertices.size());
            for (auto [a, b] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
                Vec3 corner = n + u * a + v * b;
                Vec3 scaled{corner.x * half.x, corner.y * half.y, corner.z * half.z};
                mesh.vertices.push_back({centre + rotate(turn, scaled), rotate(turn, n), part, 1});
            }
            for (uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
        }
    }
}

void add_quad(PropMesh& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d, PropPart part, float shade) {
    Vec3 normal = normalize_or(cross(c - a, d - b), {0, 1, 0});
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (Vec3 p : {a, b, c, d}) mesh.vertices.push_back({p, normal, part, shade});
    for (uint32_t i : {0, 1, 2, 0, 2, 3}) mesh.indices.push_back(first + i);
}

void add_sheet(PropMesh& mesh, const std::vector<Vec3>& points, size_t columns, PropPart part) {
    size_t rows = points.size() / columns;
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (size_t r = 0; r < rows; ++r) {
        for (size_t c = 0; c < columns; ++c) {
            auto at = [&](size_t row, size_t column) { return points[row * columns + column]; };
            Vec3 up = at(std::min(r + 1, rows - 1), c) - at(r > 0 ? r - 1 : 0, c);
            Vec3 left = at(r, std::min(c + 1, columns - 1)) - at(r, c > 0 ? c - 1 : 0);
            mesh.vertices.push_back({at(r, c), normalize_or(cross(up, left), {0, 1, 0}), part, 1});
        }
    }
    for (size_t r = 0; r + 1 < rows; ++r) {
        for (size_t c = 0; c + 1 < columns; ++c) {
            auto a = first + static_cast<uint32_t>(r * columns + c), b = a + static_cast<uint32_t>(columns);
            for (uint32_t i : {a, b, b + 1, a, b + 1, a + 1}) mesh.indices.push_back(i);
        }
    }
}

void add_turned(PropMesh& mesh, Vec3 foot, const std::vector<Vec2>& profile, uint32_t sides, PropPart part) {
    if (mesh.is_far) sides = (sides + 1) / 2;
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    auto rows = static_cast<uint32_t>(profile.size());
    for (uint32_t r = 0; r < rows; ++r) {
        Vec2 along = profile[std::min(r + 1, rows - 1)] - profile[r > 0 ? r - 1 : 0];
        Vec2 out = normalize_or(Vec2{along.z, -along.x}, {1, 0});  // radius, height
        for (uint32_t s = 0; s <= sides; ++s) {
            SinCos turn = sin_cos(2 * k_pi * static_cast<float>(s % sides) / static_cast<float>(sides));
            Vec3 at{turn.sine * profile[r].x, profile[r].z, turn.cosine * profile[r].x};
            mesh.vertices.push_back({foot + at, {turn.sine * out.x, out.z, turn.cosine * out.x}, part, 1});
        }
    }
    for (uint32_t r = 0; r + 1 < rows; ++r) {
        for (uint32_t s = 0; s < sides; ++s) {
            uint32_t a = first + r * (sides + 1) + s, b = a + sides + 1;
            for (uint32_t i : {a, a + 1, b + 1, a, b + 1, b}) mesh.indices.push_back(i);
        }
    }
}

}  // namespace flaneur
