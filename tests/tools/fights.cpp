#include "tests/tools/fights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

namespace flaneur {

namespace {

struct Spot {
    double x = 0, y = 0, z = 0;
};
Spot operator+(Spot a, Spot b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Spot operator-(Spot a, Spot b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Spot operator*(Spot a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(Spot a, Spot b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Spot cross(Spot a, Spot b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }

struct Triangle {
    Spot p[3], normal;
    Spot low, high;
    Drawn kind;
    uint32_t house, material, colour;
};

std::optional<Drawn> drawn_as(uint32_t material) {
    if (material == k_material_facade) return Drawn::facade;
    if (material == k_material_stone) return Drawn::wall;
    if (material == k_material_roof) return Drawn::roof;
    if (material < k_material_facade) return Drawn::ground;
    return std::nullopt;
}

std::vector<Triangle> drawn_triangles(const CityMesh& mesh) {
    std::vector<Triangle> all;
    for (size_t i = 0; i < mesh.indices.size(); i += 3) {
        const CityVertex& first = mesh.vertices[mesh.indices[i + 1]];
        std::optional<Drawn> kind = drawn_as(first.material);
        if (!kind) continue;
        Triangle t{};
        t.low = {1e9, 1e9, 1e9}, t.high = {-1e9, -1e9, -1e9};
        for (size_t k = 0; k < 3; ++k) {
            glm::dvec3 at = mesh.vertices[mesh.indices[i + k]].position;
            t.p[k] = {at.x, at.y, at.z};
            // Walls are darker at their foot.
            t.colour = std::max(t.colour, mesh.vertices[mesh.indices[i + k]].colour);
            t.low = {std::min(t.low.x, at.x), std::min(t.low.y, at.y), std::min(t.low.z, at.z)};
            t.high = {std::max(t.high.x, at.x), std::max(t.high.y, at.y), std::max(t.high.z, at.z)};
        }
        Spot n = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
        double twice = std::sqrt(dot(n, n));
        if (twice < 2 * double(k_least_area)) continue;
        t.normal = n * (1 / twice);
        t.kind = *kind;
        t.house = first.house, t.material = first.material;
        all.push_back(t);
    }
    return all;
}

// Facades have windows, each its own.
bool look_alike(const Triangle& a, const Triangle& b) {
    return a.kind != Drawn::facade && a.material == b.material && a.colour == b.colour;
}

struct Flat {
    double u, v;
};
// Convex, counter-clockwise.
using Polygon = std::vector<Flat>;

// What of `polygon` lies where `side` is not negative.
template <class Side>
Polygon clip(const Polygon& polygon, Side side) {
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        Flat p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        double sp = side(p), sq = side(q);
        if (sp >= 0) kept.push_back(p);
        if ((sp >= 0) == (sq >= 0)) continue;
        double t = sp / (sp - sq);
        kept.push_back({p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)});
    }
    return kept;
}

double area_of(const Polygon& p) {
    double twice = 0;
    for (size_t i = 1; i + 1 < p.size(); ++i)
        twice += (p[i].u - p[0].u) * (p[i + 1].v - p[0].v) - (p[i + 1].u - p[0].u) * (p[i].v - p[0].v);
    return 0.5 * twice;
}

double length_of(const Polygon& p) {
    double square = 0;
    for (Flat a : p)
        for (Flat b : p) square = std::max(square, (a.u - b.u) * (a.u - b.u) + (a.v - b.v) * (a.v - b.v));
    return std::sqrt(square);
}

// Triangles by squares of the map that their boxes touch.
struct Squares {
    static constexpr double k_side = 6;  // metres
    double x0 = 1e9, z0 = 1e9;
    size_t columns = 0, rows = 0;
    std::vector<std::vector<uint32_t>> items;

    explicit Squares(const std::vector<Triangle>& all) {
        double x1 = -1e9, z1 = -1e9;
        for (const Triangle& t : all) {
            x0 = std::min(x0, t.low.x), z0 = std::min(z0, t.low.z);
            x1 = std::max(x1, t.high.x), z1 = std::max(z1, t.high.z);
        }
        columns = size_t((x1 - x0) / k_side) + 1, rows = size_t((z1 - z0) / k_side) + 1;
        items.resize(columns * rows);
        for (uint32_t i = 0; i < all.size(); ++i) {
            const Triangle& t = all[i];
            for (size_t z = row(t.low.z - k_margin); z <= row(t.high.z + k_margin); ++z)
                for (size_t x = column(t.low.x - k_margin); x <= column(t.high.x + k_margin); ++x)
                    items[z * columns + x].push_back(i);
        }
    }
    static constexpr double k_margin = 0.01;
    size_t column(double x) const { return std::min(size_t(std::max(0.0, (x - x0) / k_side)), columns - 1); }
    size_t row(double z) const { return std::min(size_t(std::max(0.0, (z - z0) / k_side)), rows - 1); }
};

// On which side of a-b `p` lies on the map; the same number, negated, for b-a.
double side_of(Spot a, Spot b, Spot p) {
    bool swapped = a.x != b.x ? a.x > b.x : a.z > b.z;
    if (swapped) std::swap(a, b);
    double s = (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x);
    return swapped ? -s : s;
}

// How many times a solid holds the place: of what lies above, tops less undersides.
bool is_within(const std::vector<Triangle>& all, const Squares& squares, Spot p) {
    int times = 0;
    for (uint32_t i : squares.items[squares.row(p.z) * squares.columns + squares.column(p.x)]) {
        const Triangle& t = all[i];
        if (std::fabs(t.normal.y) < 1e-3 || t.high.y < p.y) continue;
        bool in = true;
        for (size_t k = 0; k < 3 && in; ++k) {
            double side = side_of(t.p[k], t.p[(k + 1) % 3], p);
            in = t.normal.y > 0 ? side <= 0 : side > 0;
        }
        if (!in || dot(t.normal, p - t.p[0]) / t.normal.y >= 0) continue;
        times += t.normal.y > 0 ? 1 : -1;
    }
    return times > 0;
}

}  // namespace

std::vector<Fight> find_fights(const CityMesh& mesh) {
    constexpr double k_parallel = 0.9986;  // three degrees
    constexpr double k_off = 0.03;         // from a surface to the eye that is looked for before it, metres
    constexpr Spot k_aside{1.7e-4, 0, 0.9e-4};  // so that no edge is met
    const std::vector<Triangle> all = drawn_triangles(mesh);
    std::vector<Fight> fights;
    if (all.empty()) return fights;
    const Squares squares(all);
    auto consider = [&](const Triangle& a, const Triangle& b) {
        Spot n = a.normal, u = a.p[1] - a.p[0];
        u = u * (1 / std::sqrt(dot(u, u)));
        Spot v = cross(n, u);
        auto flat = [&](Spot p) { return Flat{dot(p - a.p[0], u), dot(p - a.p[0], v)}; };
        Polygon shared{flat(a.p[0]), flat(a.p[1]), flat(a.p[2])};
        for (size_t k = 0; k < 3 && !shared.empty(); ++k) {
            Flat from = flat(b.p[k]), to = flat(b.p[(k + 1) % 3]);
            shared = clip(shared, [&](Flat p) {
                return (to.u - from.u) * (p.v - from.v) - (to.v - from.v) * (p.u - from.u);
            });
        }
        // How far b's plane lies over a's.
        auto over = [&](Flat p) {
            Spot at = a.p[0] + u * p.u + v * p.v;
            return dot(b.normal, b.p[0] - at) / dot(b.normal, n);
        };
        shared = clip(shared, [&](Flat p) { return double(k_apart) - over(p); });
        shared = clip(shared, [&](Flat p) { return double(k_apart) + over(p); });
        double area = area_of(shared);
        if (area < double(k_least_area) || area < double(k_least_width) * length_of(shared)) return;
        Flat middle{};
        for (Flat p : shared) middle = {middle.u + p.u, middle.v + p.v};
        middle = {middle.u / double(shared.size()), middle.v / double(shared.size())};
        bool is_seen = false;
        for (size_t i = 0; i <= shared.size() && !is_seen; ++i) {
            Flat p = middle;
            if (i > 0) p = {0.7 * shared[i - 1].u + 0.3 * middle.u, 0.7 * shared[i - 1].v + 0.3 * middle.v};
            is_seen = !is_within(all, squares, a.p[0] + u * p.u + v * p.v + n * k_off + k_aside);
        }
        if (!is_seen) return;
        Spot at = a.p[0] + u * middle.u + v * middle.v;
        fights.push_back({a.kind,
                          b.kind,
                          a.house,
                          b.house,
                          {float(at.x), float(at.y), float(at.z)},
                          {float(n.x), float(n.y), float(n.z)},
                          float(area),
                          float(std::fabs(over(middle)))});
    };
    for (size_t z = 0; z < squares.rows; ++z) {
        for (size_t x = 0; x < squares.columns; ++x) {
            const std::vector<uint32_t>& here = squares.items[z * squares.columns + x];
            for (size_t i = 0; i < here.size(); ++i) {
                const Triangle& a = all[here[i]];
                for (size_t k = i + 1; k < here.size(); ++k) {
                    const Triangle& b = all[here[k]];
                    if (dot(a.normal, b.normal) < k_parallel || look_alike(a, b)) continue;
                    const double m = Squares::k_margin;
                    if (a.low.x > b.high.x + m || b.low.x > a.high.x + m || a.low.z > b.high.z + m ||
                        b.low.z > a.high.z + m || a.low.y > b.high.y + m || b.low.y > a.high.y + m)
                        continue;
                    // Each pair once: in the first square that both touch.
                    if (squares.column(std::max(a.low.x, b.low.x) - m) != x ||
                        squares.row(std::max(a.low.z, b.low.z) - m) != z)
                        continue;
                    consider(a, b);
                }
            }
        }
    }
    return fights;
}

std::string told(std::vector<Fight> fights, size_t most) {
    static const char* const k_names[] = {"facade", "wall", "roof", "ground"};
    std::sort(fights.begin(), fights.end(), [](const Fight& a, const Fight& b) { return a.area > b.area; });
    std::map<std::string, std::pair<size_t, double>> kinds;
    double sum = 0;
    for (const Fight& f : fights) {
        size_t low = static_cast<size_t>(std::min(f.a, f.b)), high = static_cast<size_t>(std::max(f.a, f.b));
        auto& [count, area] = kinds[std::string(k_names[low]) + '-' + k_names[high]];
        ++count, area += double(f.area), sum += double(f.area);
    }
    char text[160];
    std::snprintf(text, sizeof text, "%zu pairs, %.2f m2", fights.size(), sum);
    std::string all = text;
    for (const auto& [name, kind] : kinds) {
        std::snprintf(text, sizeof text, "; %s %zu, %.2f m2", name.c_str(), kind.first, kind.second);
        all += text;
    }
    for (size_t i = 0; i < std::min(most, fights.size()); ++i) {
        const Fight& f = fights[i];
        std::snprintf(text, sizeof text,
                      "\n    %s-%s %.3f m2, %.2f mm apart, at %.2f,%.2f,%.2f facing %.2f,%.2f,%.2f",
                      k_names[static_cast<int>(f.a)], k_names[static_cast<int>(f.b)], double(f.area),
                      1000 * double(f.apart), double(f.at.x), double(f.at.y), double(f.at.z), double(f.out.x),
                      double(f.out.y), double(f.out.z));
        all += text;
    }
    return all;
}

}  // namespace flaneur
