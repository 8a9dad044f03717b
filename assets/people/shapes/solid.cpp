#include "assets/people/shapes/solid.h"

#include <cmath>

namespace flaneur {

namespace {

constexpr float k_turn = 6.2831853f;

// Smooth normals from the triangles round each vertex, weighed by area.
void smooth_normals(SolidMesh& s) {
    s.normals.assign(s.positions.size(), {});
    for (size_t t = 0; t < s.indices.size(); t += 3) {
        uint32_t a = s.indices[t], b = s.indices[t + 1], c = s.indices[t + 2];
        Vec3 n = cross(s.positions[b] - s.positions[a], s.positions[c] - s.positions[a]);
        s.normals[a] += n, s.normals[b] += n, s.normals[c] += n;
    }
    for (Vec3& n : s.normals) n = normalize_or(n, {0, 1, 0});
}

// Rows of `around` vertices each, joined into a tube whose ends meet in `first` and `last`, or in each other.
SolidMesh lofted(const std::vector<std::vector<Vec3>>& rows, bool closed) {
    SolidMesh s;
    auto around = uint32_t(rows[0].size()), count = uint32_t(rows.size());
    for (const auto& row : rows) s.positions.insert(s.positions.end(), row.begin(), row.end());
    auto quad = [&](uint32_t row, uint32_t next) {
        for (uint32_t i = 0; i < around; ++i) {
            uint32_t j = (i + 1) % around;
            uint32_t a = row * around + i, b = row * around + j, c = next * around + j, d = next * around + i;
            s.indices.insert(s.indices.end(), {a, b, c, a, c, d});
        }
    };
    for (uint32_t r = 0; r + 1 < count; ++r) quad(r, r + 1);
    if (closed) {
        quad(count - 1, 0);
    } else {
        auto cap = [&](uint32_t row, bool flip) {
            Vec3 middle;
            for (uint32_t i = 0; i < around; ++i) middle += s.positions[row * around + i] / float(around);
            auto m = uint32_t(s.positions.size());
            s.positions.push_back(middle);
            for (uint32_t i = 0; i < around; ++i) {
                uint32_t a = row * around + i, b = row * around + (i + 1) % around;
                if (flip) std::swap(a, b);
                s.indices.insert(s.indices.end(), {m, b, a});
            }
        };
        cap(0, false);
        cap(count - 1, true);
    }
    smooth_normals(s);
    // The winding of the rows is their maker's; the whole is turned so that it encloses its volume.
    double volume = 0;
    for (size_t t = 0; t < s.indices.size(); t += 3)
        volume += double(dot(s.positions[s.indices[t]],
                             cross(s.positions[s.indices[t + 1]], s.positions[s.indices[t + 2]])));
    if (volume < 0) {
        for (size_t t = 0; t < s.indices.size(); t += 3) std::swap(s.indices[t + 1], s.indices[t + 2]);
        for (Vec3& n : s.normals) n = -n;
    }
    return s;
}

float power(float v, float e) { return v < 0 ? -std::pow(-v, e) : std::pow(v, e); }

std::vector<Vec3> section(Vec3 centre, Vec3 across, Vec3 up, float width, float thick, int sides) {
    std::vector<Vec3> row;
    for (int i = 0; i < sides; ++i) {
        float a = k_turn * (float(i) + .5f) / float(sides);
        row.push_back(centre + across * (std::cos(a) * width) + up * (std::sin(a) * thick));
    }
    return row;
}

}  // namespace

Frame make_frame(Vec3 origin, Vec3 up, Vec3 front) {
    Frame f;
    f.origin = origin;
    f.up = normalize_or(up, {0, 1, 0});
    f.side = normalize_or(cross(f.up, front), {1, 0, 0});
    f.front = cross(f.side, f.up);
    return f;
}

SolidMesh make_pillow(const Frame& frame, Vec3 half, float soft, int around, int rings) {
    std::vector<std::vector<Vec3>> rows;
    for (int r = 0; r < rings; ++r) {
        float b = k_turn * .5f * ((float(r) + .5f) / float(rings) - .5f);
        std::vector<Vec3> row;
        for (int i = 0; i < around; ++i) {
            float a = k_turn * (float(i) + .5f) / float(around);
            float out = power(std::cos(b), soft);
            row.push_back(
                frame.at({half.x * out * power(std::cos(a), soft), half.y * power(std::sin(b), soft),
                          half.z * out * power(std::sin(a), soft)}));
        }
        rows.push_back(std::move(row));
    }
    return lofted(rows, false);
}

SolidMesh make_band(std::span<const Vec3> path, Vec3 across, float width, float thick, int sides) {
    std::vector<std::vector<Vec3>> rows;
    for (size_t i = 0; i < path.size(); ++i) {
        Vec3 along =
            normalize_or(path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0], {0, 1, 0});
        Vec3 side = normalize_or(across - along * dot(across, along), {1, 0, 0}), up = cross(side, along);
        if (i == 0)
            rows.push_back(
                section(path[i] - along * (thick * .6f), side, up, width * .7f, thick * .5f, sides));
        rows.push_back(section(path[i], side, up, width, thick, sides));
        if (i + 1 == path.size())
            rows.push_back(
                section(path[i] + along * (thick * .6f), side, up, width * .7f, thick * .5f, sides));
    }
    return lofted(rows, false);
}

SolidMesh make_ring(std::span<const Vec3> path, Vec3 across, float width, float thick, int sides) {
    std::vector<std::vector<Vec3>> rows;
    size_t n = path.size();
    for (size_t i = 0; i < n; ++i) {
        Vec3 along = normalize_or(path[(i + 1) % n] - path[(i + n - 1) % n], {0, 1, 0});
        Vec3 side = normalize_or(across - along * dot(across, along), {1, 0, 0}), up = cross(side, along);
        rows.push_back(section(path[i], side, up, width, thick, sides));
    }
    return lofted(rows, true);
}

SolidMesh make_turned(const Frame& frame, std::span<const Turn> profile, float depth, int around) {
    std::vector<std::vector<Vec3>> rows;
    for (const Turn& t : profile) {
        std::vector<Vec3> row;
        for (int i = 0; i < around; ++i) {
            float a = k_turn * float(i) / float(around);
            row.push_back(frame.at({std::sin(a) * t.radius, t.height, std::cos(a) * t.radius * depth}));
        }
        rows.push_back(std::move(row));
    }
    return lofted(rows, false);
}

}  // namespace flaneur
