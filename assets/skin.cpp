#include "assets/skin.h"

#include <algorithm>
#include <cmath>

#include "sim/base/parallel_for.h"

namespace flaneur {

namespace {

// A depth buffer and the rounding of corners tell 2 mm apart at 300 m; the rest is for what is not quite
// parallel.
constexpr double k_one_plane = 0.006;
constexpr float k_parallel = 0.9976f;  // four degrees
constexpr double k_under = 0.0002;     // what is left reaches so far under what is drawn before it, metres
constexpr double k_least_area = 1e-4, k_least_width = 1e-3;  // of what is cut away or left

enum class Sort : uint8_t { ground, facade, wall, roof };

struct Sheet {
    Vec3 corners[4];
    uint32_t count;  // of corners
    uint32_t index;  // of the face or the triangle
    uint32_t building;
    Vec3 normal, low, high;
    Sort sort;
    FaceKind kind;
};

void add_sheet(std::vector<Sheet>& out, Sheet s) {
    Vec3 n = cross(s.corners[1] - s.corners[0], s.corners[2] - s.corners[0]);
    if (s.count == 4) n = n + cross(s.corners[2] - s.corners[0], s.corners[3] - s.corners[0]);
    if (!(length(n) > 1e-4f)) return;
    s.normal = n / length(n);
    s.low = s.high = s.corners[0];
    for (uint32_t k = 1; k < s.count; ++k) {
        Vec3 p = s.corners[k];
        s.low = {std::min(s.low.x, p.x), std::min(s.low.y, p.y), std::min(s.low.z, p.z)};
        s.high = {std::max(s.high.x, p.x), std::max(s.high.y, p.y), std::max(s.high.z, p.z)};
    }
    out.push_back(s);
}

std::vector<Sheet> walls_and_roofs(const City& city) {
    std::vector<Sheet> all;
    all.reserve(city.ground.faces.size() + city.roof_buildings.size());
    for (uint32_t i = 0; i < city.ground.faces.size(); ++i) {
        const Face& f = city.ground.faces[i];
        Sort sort = f.kind == FaceKind::facade ? Sort::facade : Sort::wall;
        Vec3 c{f.b.x, f.b_top, f.b.z}, d{f.a.x, f.a_top, f.a.z};
        add_sheet(all, {{f.a, f.b, c, d}, 4, i, f.building, {}, {}, {}, sort, f.kind});
    }
    for (uint32_t t = 0; t < city.roof_buildings.size(); ++t) {
        auto corner = [&](size_t k) { return city.roof_vertices[city.roof_indices[3 * size_t{t} + k]]; };
        add_sheet(all, {{corner(0), corner(1), corner(2), {}},
                        3,
                        t,
                        city.roof_buildings[t],
                        {},
                        {},
                        {},
                        Sort::roof,
                        {}});
    }
    return all;
}

// Surfaces by squares of the map that their boxes touch.
struct Squares {
    static constexpr float k_side = 8, k_margin = 0.01f;  // metres
    Vec2 low{1e9f, 1e9f};
    int columns = 1, rows = 1;
    std::vector<uint32_t> first, items;

    int column(float x) const { return std::clamp(static_cast<int>((x - low.x) / k_side), 0, columns - 1); }
    int row(float z) const { return std::clamp(static_cast<int>((z - low.z) / k_side), 0, rows - 1); }

    // Whether of the squares that both touch this is the first, in which they meet once.
    bool is_first(size_t square, const Sheet& a, const Sheet& b) const {
        auto x = static_cast<size_t>(column(std::max(a.low.x, b.low.x) - k_margin)),
             z = static_cast<size_t>(row(std::max(a.low.z, b.low.z) - k_margin));
        return square == z * static_cast<size_t>(columns) + x;
    }

    template <class Visit>
    void visit(Vec3 from, Vec3 to, Visit each) const {
        for (int z = row(from.z - k_margin); z <= row(to.z + k_margin); ++z)
            for (int x = column(from.x - k_margin); x <= column(to.x + k_margin); ++x)
                each(static_cast<size_t>(z) * static_cast<size_t>(columns) + static_cast<size_t>(x));
    }

    explicit Squares(const std::vector<Sheet>& all) {
        Vec2 high{-1e9f, -1e9f};
        for (const Sheet& s : all) {
            low = {std::min(low.x, s.low.x), std::min(low.z, s.low.z)};
            high = {std::max(high.x, s.high.x), std::max(high.z, s.high.z)};
        }
        if (all.empty()) low = high = {};
        columns = static_cast<int>((high.x - low.x) / k_side) + 1;
        rows = static_cast<int>((high.z - low.z) / k_side) + 1;
        first.assign(static_cast<size_t>(columns) * static_cast<size_t>(rows) + 1, 0);
        for (const Sheet& s : all) visit(s.low, s.high, [&](size_t square) { ++first[square + 1]; });
        for (size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
        items.resize(first.back());
        std::vector<uint32_t> next(first.begin(), first.end() - 1);
        for (uint32_t i = 0; i < all.size(); ++i)
            visit(all[i].low, all[i].high, [&](size_t square) { items[next[square]++] = i; });
    }
};

bool look_alike(const Sheet& a, const Sheet& b) {
    return a.sort == b.sort && a.sort != Sort::facade && a.kind == b.kind && a.building == b.building;
}

bool boxes_meet(const Sheet& a, const Sheet& b) {
    constexpr float m = Squares::k_margin;
    return a.low.x <= b.high.x + m && b.low.x <= a.high.x + m && a.low.y <= b.high.y + m &&
           b.low.y <= a.high.y + m && a.low.z <= b.high.z + m && b.low.z <= a.high.z + m;
}

bool may_share_a_plane(const Sheet& a, const Sheet& b) {
    if (dot(a.normal, b.normal) < k_parallel || !boxes_meet(a, b) || look_alike(a, b)) return false;
    bool is_before = false, is_behind = false;
    for (uint32_t k = 0; k < b.count; ++k) {
        float off = dot(a.normal, b.corners[k] - a.corners[0]);
        is_before = is_before || off < 0.01f;
        is_behind = is_behind || off > -0.01f;
    }
    return is_before && is_behind;
}

// A place in the plane of a surface, metres from its first corner.
struct Flat {
    double u, v;
};
// Convex, counter-clockwise from outside.
using Polygon = std::vector<Flat>;

struct Plane {
    Vec3 origin;
    double ux, uy, uz, vx, vy, vz;

    explicit Plane(const Sheet& s) : origin(s.corners[0]) {
        Vec3 along = s.corners[1] - s.corners[0], n = s.normal;
        double x = double(along.x), y = double(along.y), z = double(along.z);
        double l = std::sqrt(x * x + y * y + z * z);
        ux = x / l, uy = y / l, uz = z / l;
        vx = double(n.y) * uz - double(n.z) * uy, vy = double(n.z) * ux - double(n.x) * uz,
        vz = double(n.x) * uy - double(n.y) * ux;
    }
    Flat at(Vec3 p) const {
        double x = double(p.x) - double(origin.x), y = double(p.y) - double(origin.y),
               z = double(p.z) - double(origin.z);
        return {x * ux + y * uy + z * uz, x * vx + y * vy + z * vz};
    }
    Vec3 operator()(Flat p) const {
        return {static_cast<float>(double(origin.x) + p.u * ux + p.v * vx),
                static_cast<float>(double(origin.y) + p.u * uy + p.v * vy),
                static_cast<float>(double(origin.z) + p.u * uz + p.v * vz)};
    }
    Polygon outline(const Sheet& s) const {
        Polygon out;
        for (uint32_t k = 0; k < s.count; ++k) out.push_back(at(s.corners[k]));
        return out;
    }
};

// What of a polygon lies where `side` is not negative.
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

bool is_something(const Polygon& p) {
    double twice = 0, longest = 0;
    for (size_t i = 0; i < p.size(); ++i) {
        twice += (p[i].u - p[0].u) * (p[(i + 1) % p.size()].v - p[0].v) -
                 (p[(i + 1) % p.size()].u - p[0].u) * (p[i].v - p[0].v);
        for (size_t k = 0; k < i; ++k)
            longest = std::max(longest, std::hypot(p[i].u - p[k].u, p[i].v - p[k].v));
    }
    return twice > 2 * k_least_area && twice > 2 * k_least_width * longest;
}

// How far `p` lies to the left of the line from a to b, less `in`; metres.
auto left_of(Flat a, Flat b, double in) {
    double l = std::max(std::hypot(b.u - a.u, b.v - a.v), 1e-9);
    return [=](Flat p) { return ((b.u - a.u) * (p.v - a.v) - (b.v - a.v) * (p.u - a.u)) / l - in; };
}

// What of `winner` lies in the plane.
Polygon share_of(const Sheet& winner, const Sheet& loser, const Plane& plane) {
    Polygon outline = plane.outline(winner);
    Vec3 n = winner.normal, m = loser.normal;
    auto over = [&](Flat p) { return double(dot(n, plane(p) - winner.corners[0]) / dot(n, m)); };
    outline = clip(outline, [&](Flat p) { return k_one_plane - over(p); });
    return clip(outline, [&](Flat p) { return k_one_plane + over(p); });
}

// Cuts the share out of every piece; whether there was something to cut.
bool cut(std::vector<Polygon>& pieces, const Polygon& share) {
    if (!is_something(share)) return false;
    std::vector<Polygon> left;
    bool is_cut = false;
    for (Polygon& piece : pieces) {
        Polygon inside = piece;
        std::vector<Polygon> outside;
        for (size_t k = 0; k < share.size() && !inside.empty(); ++k) {
            Flat a = share[k], b = share[(k + 1) % share.size()];
            if (std::hypot(b.u - a.u, b.v - a.v) < 1e-6) continue;
            auto in = left_of(a, b, k_under);
            Polygon beyond = clip(inside, [&](Flat p) { return -in(p); });
            if (is_something(beyond)) outside.push_back(std::move(beyond));
            inside = clip(inside, in);
        }
        if (!is_something(inside)) {
            left.push_back(std::move(piece));
            continue;
        }
        is_cut = true;
        for (Polygon& part : outside) left.push_back(std::move(part));
    }
    pieces = std::move(left);
    return is_cut;
}

struct Meeting {
    uint32_t loser;
    Sheet winner;
};

}  // namespace

Skin skin_of(const City& city) {
    const std::vector<Sheet> all = walls_and_roofs(city);
    const Squares squares(all);
    WorkersPtr workers = make_workers(0);
    const auto rows = static_cast<size_t>(squares.rows);
    std::vector<std::vector<Meeting>> met(rows + 1);
    parallel_for(*workers, rows, 1, [&](size_t begin, size_t end, int) {
        for (size_t z = begin; z < end; ++z)
            for (int x = 0; x < squares.columns; ++x) {
                size_t square = z * static_cast<size_t>(squares.columns) + static_cast<size_t>(x);
                for (uint32_t i = squares.first[square]; i < squares.first[square + 1]; ++i)
                    for (uint32_t k = i + 1; k < squares.first[square + 1]; ++k) {
                        const Sheet &a = all[squares.items[i]], &b = all[squares.items[k]];
                        if (!squares.is_first(square, a, b) || !may_share_a_plane(a, b)) continue;
                        bool first = a.sort <= b.sort;  // items are in the order of the city
                        met[z].push_back({squares.items[first ? k : i], first ? a : b});
                    }
            }
    });
    // Ground does not give way: of roofs what lies in its plane is not drawn.
    for (uint32_t t = 0; t < city.ground.kinds.size(); ++t) {
        auto corner = [&](size_t k) { return city.ground.vertices[city.ground.indices[3 * size_t{t} + k]]; };
        std::vector<Sheet> one;
        add_sheet(one, {{corner(0), corner(1), corner(2), {}}, 3, t, ~0u, {}, {}, {}, Sort::ground, {}});
        if (one.empty()) continue;
        squares.visit(one[0].low, one[0].high, [&](size_t square) {
            for (uint32_t i = squares.first[square]; i < squares.first[square + 1]; ++i) {
                const Sheet& s = all[squares.items[i]];
                if (s.sort == Sort::roof && squares.is_first(square, one[0], s) &&
                    may_share_a_plane(one[0], s))
                    met[rows].push_back({squares.items[i], one[0]});
            }
        });
    }
    std::vector<Meeting> meetings;
    for (std::vector<Meeting>& some : met) meetings.insert(meetings.end(), some.begin(), some.end());
    std::stable_sort(meetings.begin(), meetings.end(),
                     [](const Meeting& a, const Meeting& b) { return a.loser < b.loser; });
    Skin skin;
    for (size_t i = 0; i < meetings.size();) {
        const Sheet& loser = all[meetings[i].loser];
        const Plane plane(loser);
        std::vector<Polygon> pieces{plane.outline(loser)};
        bool is_cut = false;
        for (uint32_t of = meetings[i].loser; i < meetings.size() && meetings[i].loser == of; ++i)
            is_cut |= cut(pieces, share_of(meetings[i].winner, loser, plane));
        if (!is_cut) continue;
        Remnant remnant{loser.index, {}};
        for (const Polygon& piece : pieces) {
            remnant.pieces.emplace_back();
            for (Flat p : piece) remnant.pieces.back().push_back(plane(p));
        }
        (loser.sort == Sort::roof ? skin.roofs : skin.faces).push_back(std::move(remnant));
    }
    return skin;
}

}  // namespace flaneur
