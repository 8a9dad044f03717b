#include "assets/people/lods.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

namespace flaneur {

namespace {

constexpr std::array<size_t, 4> k_level_triangles = {3150, 1540, 500, 180};
constexpr size_t k_near_above = 2000;     // levels that keep glasses
constexpr size_t k_welded_below = 300;    // levels this coarse may collapse across seams of colour
constexpr size_t k_mingled_below = 200;   // and these across borders of garments
constexpr size_t k_smoothed_below = 600;  // levels this coarse have vertices of their own, painted anew

// How much of a vertex goes with any of `joints`.
float share_of(const CharacterVertex& v, std::initializer_list<uint8_t> joints) {
    float share = 0;
    for (int n = 0; n < 4; ++n)
        for (uint8_t joint : joints)
            if (v.joints[n] == joint) share += float(v.weights[n]) / 255;
    return share;
}

std::vector<uint32_t> simplify(const std::vector<uint32_t>& indices, const std::vector<Vec3>& places,
                               size_t triangles) {
    std::vector<uint32_t> out(indices.size());
    out.resize(meshopt_simplify(out.data(), indices.data(), indices.size(), &places[0].x, places.size(),
                                sizeof(Vec3), triangles * 3, 1.0f, 0, nullptr));
    return out;
}

std::vector<uint32_t> simplify_sloppily(const std::vector<uint32_t>& indices, const std::vector<Vec3>& places,
                                        size_t triangles) {
    std::vector<uint32_t> out(indices.size());
    out.resize(meshopt_simplifySloppy(out.data(), indices.data(), indices.size(), &places[0].x, places.size(),
                                      sizeof(Vec3), triangles * 3, 1.0f, nullptr));
    return out;
}

// Vertices at one place, as one: a surface without the seams of colour, texture and hard edges.
struct Weld {
    std::vector<uint32_t> place;                 // by vertex: the number of its place
    std::vector<std::vector<uint32_t>> members;  // by place: the vertices there
    std::vector<Vec3> places;                    // as the simplifier measures errors
};

// The garments whose borders are still seen from afar.
int garment(Tint tint) {
    switch (tint) {
        case Tint::hair:
            return 1;
        case Tint::top:
        case Tint::accent:
            return 2;
        case Tint::bottom:
        case Tint::shoes:
            return 3;
        default:
            return 0;
    }
}

// With `keep_garments`, vertices of two garments at one place stay two.
Weld weld(const Character& c, const std::vector<uint32_t>& shown, const std::vector<Vec3>& weighed,
          bool keep_garments) {
    auto group = [&](uint32_t v) { return keep_garments ? garment(c.vertices[v].tint) : 0; };
    Weld w;
    std::vector<uint32_t> order = shown;
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        Vec3 p = c.vertices[a].position, q = c.vertices[b].position;
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        if (p.z != q.z) return p.z < q.z;
        return group(a) != group(b) ? group(a) < group(b) : a < b;
    });
    w.place.resize(c.vertices.size());
    for (size_t i = 0; i < order.size(); ++i) {
        uint32_t v = order[i];
        bool same = i > 0 && c.vertices[v].position == c.vertices[order[i - 1]].position &&
                    group(v) == group(order[i - 1]);
        if (!same) {
            w.members.emplace_back();
            w.places.push_back(weighed[v]);
        }
        w.place[v] = uint32_t(w.members.size() - 1);
        w.members.back().push_back(v);
    }
    return w;
}

// From places back to vertices: each corner of a triangle takes, among the vertices at its place, one that
// shows what most of the triangle shows and whose normal fits best.
std::vector<uint32_t> unweld(const std::vector<uint32_t>& places, const Character& c, const Weld& w) {
    auto look = [&](uint32_t v) { return c.vertices[v].tint; };
    auto shows = [&](uint32_t place, Tint wanted) {
        const auto& m = w.members[place];
        return std::any_of(m.begin(), m.end(), [&](uint32_t v) { return look(v) == wanted; });
    };
    std::vector<uint32_t> out;
    for (size_t t = 0; t + 2 < places.size(); t += 3) {
        std::array<uint32_t, 3> corner = {places[t], places[t + 1], places[t + 2]};
        std::array<Vec3, 3> p;
        for (size_t i = 0; i < 3; ++i) p[i] = c.vertices[w.members[corner[i]][0]].position;
        Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
        Tint best = Tint::none;
        int best_votes = 0;
        for (uint32_t place : corner)
            for (uint32_t v : w.members[place]) {
                int votes = 0;
                for (uint32_t other : corner) votes += shows(other, look(v));
                if (votes > best_votes) best_votes = votes, best = look(v);
            }
        for (uint32_t place : corner) {
            uint32_t chosen = w.members[place][0];
            float fit = -1e30f;
            for (uint32_t v : w.members[place]) {
                float f = dot(c.vertices[v].normal, normal) + (look(v) == best ? 1e6f : 0.0f);
                if (f > fit) fit = f, chosen = v;
            }
            out.push_back(chosen);
        }
    }
    return out;
}

// How much of the fine surface shows each tint, and in what colour.
struct Shown {
    std::array<float, k_tint_count> areas{};
    std::array<std::array<float, 3>, k_tint_count> colours{};  // times those areas
};

void add(Shown& to, const Shown& other) {
    for (size_t tint = 0; tint < k_tint_count; ++tint) {
        to.areas[tint] += other.areas[tint];
        for (size_t i = 0; i < 3; ++i) to.colours[tint][i] += other.colours[tint][i];
    }
}

struct Triangle {
    std::array<Vec3, 3> corners;
    Vec3 middle, normal;  // as long as twice its area
    float reach;          // of the corners from the middle
};

std::vector<Triangle> triangles_of(const std::vector<uint32_t>& indices, const Character& c) {
    std::vector<Triangle> out;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        std::array<Vec3, 3> p;
        for (size_t k = 0; k < 3; ++k) p[k] = c.vertices[indices[i + k]].position;
        Triangle& made =
            out.emplace_back(Triangle{p, (p[0] + p[1] + p[2]) / 3, cross(p[1] - p[0], p[2] - p[0]), 0});
        for (const Vec3& corner : p) made.reach = std::max(made.reach, length(corner - made.middle));
    }
    return out;
}

float distance_to(const Triangle& triangle, Vec3 place) {
    const auto& [p, middle, normal, reach] = triangle;
    const Vec3 away = place - p[0];
    const float area = length_squared(normal);
    const float s = dot(cross(away, p[2] - p[0]), normal), t = dot(cross(p[1] - p[0], away), normal);
    if (s >= 0 && t >= 0 && s + t <= area && area > 0) return std::fabs(dot(away, normal)) / std::sqrt(area);
    float nearest = 1e30f;
    for (size_t i = 0; i < 3; ++i) {
        const Vec3 from = place - p[i], edge = p[(i + 1) % 3] - p[i];
        const float along = dot(from, edge) / std::max(length_squared(edge), 1e-12f);
        nearest = std::min(nearest, length_squared(from - edge * clamp(along, 0.0f, 1.0f)));
    }
    return std::sqrt(nearest);
}

// What the fine surface shows of each triangle of a level: each fine triangle counts for the one nearest to
// it that faces its way.
std::vector<Shown> shown_by(const std::vector<uint32_t>& level, const Character& c,
                            const std::vector<uint32_t>& fine) {
    const std::vector<Triangle> few = triangles_of(level, c), many = triangles_of(fine, c);
    std::vector<Shown> out(few.size());
    for (size_t f = 0; f < many.size(); ++f) {
        const Triangle& seen = many[f];
        size_t nearest = few.size();
        float best = 1e15f;
        for (size_t t = 0; t < few.size(); ++t) {
            const float beyond = best + few[t].reach;
            if (length_squared(few[t].middle - seen.middle) > beyond * beyond ||
                dot(few[t].normal, seen.normal) <= 0)
                continue;
            const float d = distance_to(few[t], seen.middle);
            if (d < best) best = d, nearest = t;
        }
        if (nearest == few.size()) continue;
        const float area = length(seen.normal);
        for (size_t i = 0; i < 3; ++i) {
            const CharacterVertex& v = c.vertices[fine[3 * f + i]];
            const auto tint = static_cast<size_t>(v.tint);
            out[nearest].areas[tint] += area;
            for (size_t k = 0; k < 3; ++k)
                out[nearest].colours[tint][k] += area * float(v.colour >> (8 * k) & 0xffu);
        }
    }
    return out;
}

// Where a level has lost the borders of garments, each of its triangles takes the tint that is most of it.
void repaint(std::vector<uint32_t>& level, Character& c, const std::vector<Shown>& shown) {
    for (size_t t = 0; t < shown.size(); ++t) {
        const auto& areas = shown[t].areas;
        const auto most = std::max_element(areas.begin(), areas.end());
        if (!(*most > 0)) continue;
        const Tint tint = static_cast<Tint>(most - areas.begin());
        for (size_t i = 3 * t; i < 3 * t + 3; ++i) {
            if (c.vertices[level[i]].tint == tint) continue;
            CharacterVertex corner = c.vertices[level[i]];
            corner.tint = tint;
            level[i] = uint32_t(c.vertices.size());
            c.vertices.push_back(corner);
        }
    }
}

// A coarse level takes vertices of its own: their normals are those of its few triangles, their colours the
// means of what the fine surface shows about them, so that no single dark fold spreads over half a body.
void smooth_out(std::vector<uint32_t>& level, Character& c, const std::vector<Shown>& shown) {
    std::map<std::array<float, 3>, Vec3> normals;
    auto place = [&](uint32_t v) {
        Vec3 p = c.vertices[v].position;
        return std::array<float, 3>{p.x, p.y, p.z};
    };
    for (size_t t = 0; t + 2 < level.size(); t += 3) {
        Vec3 a = c.vertices[level[t]].position;
        Vec3 n = cross(c.vertices[level[t + 1]].position - a, c.vertices[level[t + 2]].position - a);
        for (size_t i = 0; i < 3; ++i) normals[place(level[t + i])] += n;
    }
    std::map<std::pair<std::array<float, 3>, Tint>, uint32_t> own;
    std::vector<Shown> about;  // by number among those
    const size_t first = c.vertices.size();
    for (size_t i = 0; i < level.size(); ++i) {
        uint32_t& v = level[i];
        auto [known, fresh] = own.try_emplace({place(v), c.vertices[v].tint}, uint32_t(c.vertices.size()));
        if (fresh) {
            CharacterVertex vertex = c.vertices[v];
            vertex.normal = normalize_or(normals[place(v)] * 1e4f, vertex.normal);
            c.vertices.push_back(vertex);
            about.emplace_back();
        }
        v = known->second;
        add(about[v - first], shown[i / 3]);
    }
    for (size_t o = 0; o < about.size(); ++o) {
        CharacterVertex& vertex = c.vertices[first + o];
        const auto tint = static_cast<size_t>(vertex.tint);
        if (!(about[o].areas[tint] > 0)) continue;
        vertex.colour &= 0xff000000u;
        for (size_t i = 0; i < 3; ++i)
            vertex.colour |= uint32_t(about[o].colours[tint][i] / about[o].areas[tint]) << (8 * i);
    }
}

// The triangles that levels are made of, ready to be simplified.
struct Base {
    std::vector<uint32_t> triangles;
    std::vector<uint32_t> shown;  // the vertices in use, rising
    // The same alone, by their numbers among `shown`: others at their places would pass for seams.
    std::vector<uint32_t> numbered;
    std::vector<Vec3> places;
    std::array<Weld, 2> welds;  // with the borders of garments, without
};

Base make_base(const Character& c, const std::vector<uint32_t>& triangles, const std::vector<Vec3>& places) {
    Base base{triangles, triangles, {}, {}, {}};
    std::sort(base.shown.begin(), base.shown.end());
    base.shown.erase(std::unique(base.shown.begin(), base.shown.end()), base.shown.end());
    for (uint32_t v : base.shown) base.places.push_back(places[v]);
    for (uint32_t v : triangles) {
        auto found = std::lower_bound(base.shown.begin(), base.shown.end(), v);
        base.numbered.push_back(uint32_t(found - base.shown.begin()));
    }
    base.welds = {weld(c, base.shown, places, true), weld(c, base.shown, places, false)};
    return base;
}

// About so many triangles of it.
std::vector<uint32_t> coarse(const Character& c, const Base& base, size_t triangles) {
    auto fits = [&](const std::vector<uint32_t>& level) {
        return !level.empty() && level.size() / 3 <= triangles + triangles / 4;
    };
    std::vector<uint32_t> level;
    if (triangles > k_welded_below) {
        level = simplify(base.numbered, base.places, triangles);
        for (uint32_t& v : level) v = base.shown[v];
    }
    // Where seams stand in the way, fewer are kept, and in the end not even the shape of every part.
    const auto& welds = base.welds;
    for (size_t w = triangles < k_mingled_below ? 1 : 0; w < welds.size() && !fits(level); ++w) {
        std::vector<uint32_t> whole;
        for (uint32_t v : base.triangles) whole.push_back(welds[w].place[v]);
        level = simplify(whole, welds[w].places, triangles);
        if (w + 1 == welds.size() && level.size() / 3 > 2 * triangles)
            level = simplify_sloppily(whole, welds[w].places, triangles);
        level = unweld(level, c, welds[w]);
    }
    return level;
}

}  // namespace

std::vector<Vec3> weighed_places(const Character& c) {
    constexpr float k_sine = 0.75f, k_cosine = 0.66f;  // of 0.85 radians
    constexpr uint8_t k_none = k_joint_count;
    constexpr std::array<std::array<uint8_t, 3>, 4> k_hinges = {{{left_lower_arm, left_hand, k_none},
                                                                 {right_lower_arm, right_hand, k_none},
                                                                 {left_lower_leg, left_foot, left_toes},
                                                                 {right_lower_leg, right_foot, right_toes}}};
    std::vector<Vec3> places;
    Vec3 pivot = c.bind_joints[head];
    for (const CharacterVertex& v : c.vertices) {
        Vec3 place = v.position + (v.position - pivot) * (0.8f * share_of(v, {head}));
        for (const auto& [hinge, end, tip] : k_hinges) {
            const float share = share_of(v, {hinge, end, tip});
            if (share <= 0) continue;
            const Vec3 limb = normalize_or(c.bind_joints[end] - c.bind_joints[hinge], {0, -1, 0});
            const Vec3 axis = normalize_or(cross(limb, Vec3{0.1f, 0, 1}), {1, 0, 0});
            const Vec3 arm = v.position - c.bind_joints[hinge];
            const Vec3 turned =
                arm * k_cosine + cross(axis, arm) * k_sine + axis * (dot(axis, arm) * (1 - k_cosine));
            place = place + (turned - arm) * std::min(share, 1.0f);
        }
        places.push_back(place);
    }
    return places;
}

void build_person_lods(Character& c, const Unpainted& unpainted) {
    c.lods.resize(1);
    if (c.vertices.empty() || unpainted.triangles.empty()) return;
    const Base base = make_base(c, unpainted.triangles, weighed_places(c));
    const auto& glasses = unpainted.glasses;
    for (size_t l = 0; l < k_level_triangles.size(); ++l) {
        const size_t triangles = k_level_triangles[l];
        const size_t before = c.lods.back().size();
        if (before / 3 <= triangles + triangles / 4) continue;
        const bool is_near = triangles > k_near_above, is_painted = triangles > k_welded_below;
        size_t wanted = is_painted ? triangles - triangles / 10 : triangles;
        if (is_near) wanted -= glasses.size() / 3;
        std::vector<uint32_t> level = coarse(c, base, wanted);
        if (level.empty() || level.size() * 10 > before * 9) continue;
        if (triangles <= k_smoothed_below) {
            const std::vector<Shown> shown = shown_by(level, c, base.triangles);
            repaint(level, c, shown);
            smooth_out(level, c, shown);
        }
        // Where rims would be a sixth of a pixel, none are painted.
        const bool has_rims = !is_near && triangles > k_smoothed_below;
        if (is_painted) lay_on(has_rims ? unpainted.face_with_glasses : unpainted.face, level, c);
        if (is_near) level.insert(level.end(), glasses.begin(), glasses.end());
        level.insert(level.end(), unpainted.pram[l + 1].begin(), unpainted.pram[l + 1].end());
        c.lods.push_back(std::move(level));
    }
    order_levels(c);
}

void order_levels(Character& c) {
    for (std::vector<uint32_t>& level : c.lods)
        meshopt_optimizeVertexCache(level.data(), level.data(), level.size(), c.vertices.size());

    // One order of vertices serves all levels: the coarse ones' vertices come first.
    std::vector<uint32_t> all;
    for (size_t l = c.lods.size(); l-- > 0;) all.insert(all.end(), c.lods[l].begin(), c.lods[l].end());
    std::vector<uint32_t> remap(c.vertices.size());
    size_t kept = meshopt_optimizeVertexFetchRemap(remap.data(), all.data(), all.size(), c.vertices.size());
    std::vector<CharacterVertex> vertices(kept);
    for (size_t v = 0; v < remap.size(); ++v)
        if (remap[v] != ~0u) vertices[remap[v]] = c.vertices[v];
    c.vertices = std::move(vertices);
    for (std::vector<uint32_t>& level : c.lods)
        for (uint32_t& v : level) v = remap[v];
}

}  // namespace flaneur
