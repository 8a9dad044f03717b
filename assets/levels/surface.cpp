#include "assets/levels/surface.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <span>

#include "assets/levels/texel.h"

namespace flaneur {

namespace {

uint32_t root_of(std::vector<uint32_t>& above, uint32_t v) {
    while (above[v] != v) v = above[v] = above[above[v]];
    return v;
}

void join(std::vector<uint32_t>& above, uint32_t a, uint32_t b) {
    above[root_of(above, a)] = root_of(above, b);
}

// Numbers the sets from 0, in the order of their first members; returns how many.
uint32_t number_sets(std::vector<uint32_t>& above) {
    std::vector<uint32_t> number(above.size(), ~0u), out(above.size());
    uint32_t count = 0;
    for (uint32_t v = 0; v < above.size(); ++v) {
        uint32_t& n = number[root_of(above, v)];
        if (n == ~0u) n = count++;
        out[v] = n;
    }
    above = std::move(out);
    return count;
}

using PointKey = std::array<uint32_t, 10>;  // place first

PointKey key_of(const Character& c, const CharacterVertex& v, const std::vector<uint8_t>& cut,
                bool keeps_uv) {
    auto bits = [](float f) { return std::bit_cast<uint32_t>(f + 0.0f); };  // -0 is 0
    PointKey key = {bits(v.position.x), bits(v.position.y), bits(v.position.z),
                    v.colour,           v.texture,          uint32_t(v.tint)};
    for (size_t n = 0; n < 4; ++n) {
        key[6] |= uint32_t(v.joints[n]) << (8 * n);
        key[7] |= uint32_t(v.weights[n]) << (8 * n);
    }
    if (is_textured(c, v) && (keeps_uv || cut[v.texture])) key[8] = bits(v.u), key[9] = bits(v.v);
    return key;
}

// Leaves out triangles without area in points and those that lie back to back with one before, whose points
// become two-sided.
void leave_out_backs(LevelSurface& s) {
    struct Face {
        std::array<uint32_t, 3> sorted;
        bool turned;
        uint32_t number;
    };
    std::vector<Face> faces;
    for (uint32_t t = 0; t < s.corners.size() / 3; ++t) {
        std::array<uint32_t, 3> p = {s.corners[3 * t], s.corners[3 * t + 1], s.corners[3 * t + 2]};
        if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
        std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
        const bool turned = p[1] > p[2];
        if (turned) std::swap(p[1], p[2]);
        faces.push_back({p, turned, t});
    }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) {
        return a.sorted != b.sorted ? a.sorted < b.sorted : a.number < b.number;
    });
    std::vector<uint8_t> kept(s.corners.size() / 3, 0);
    for (size_t i = 0; i < faces.size(); ++i) {
        const bool again = i > 0 && faces[i].sorted == faces[i - 1].sorted;
        if (!again) kept[faces[i].number] = 1;
        if (again && faces[i].turned != faces[i - 1].turned)
            for (uint32_t p : faces[i].sorted) s.two_sided[p] = 1;
    }
    std::vector<uint32_t> corners;
    for (size_t t = 0; t < kept.size(); ++t)
        if (kept[t])
            corners.insert(corners.end(), s.corners.begin() + std::ptrdiff_t(3 * t),
                           s.corners.begin() + std::ptrdiff_t(3 * t + 3));
    s.corners = std::move(corners);
}

float area_of(const std::vector<Vec3>& places, const uint32_t* corners) {
    return 0.5f *
           length(cross(places[corners[1]] - places[corners[0]], places[corners[2]] - places[corners[0]]));
}

float area_of(const std::vector<Vec3>& places, std::span<const uint32_t> corners) {
    float sum = 0;
    for (size_t t = 0; t + 2 < corners.size(); t += 3) sum += area_of(places, &corners[t]);
    return sum;
}

struct Extent {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
    void add(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    std::array<float, 3> size() const { return {high.x - low.x, high.y - low.y, high.z - low.z}; }
};

// How far head, hands and feet reach, and at the end all together.
constexpr size_t k_limbs = 6;

std::array<Extent, k_limbs> limbs_of(const Character& c, const LevelSurface& s,
                                     std::span<const uint32_t> corners) {
    std::array<Extent, k_limbs> limbs;
    for (uint32_t p : corners) {
        const int joint = c.vertices[s.members[s.first[p]]].joints[0];
        limbs.back().add(s.places[p]);
        if (joint == head) limbs[0].add(s.places[p]);
        if (joint == left_hand) limbs[1].add(s.places[p]);
        if (joint == right_hand) limbs[2].add(s.places[p]);
        if (joint == left_foot || joint == left_toes) limbs[3].add(s.places[p]);
        if (joint == right_foot || joint == right_toes) limbs[4].add(s.places[p]);
    }
    return limbs;
}

// Whether `after` still shows what `before` did: most of its area, each limb along its length, and the whole
// along, across and through.
bool is_whole(const Character& c, const LevelSurface& s, std::span<const uint32_t> before,
              std::span<const uint32_t> after, float least) {
    constexpr float k_least_area = 0.6f, k_least_reach = 0.6f, k_usual_reach = 0.85f;
    auto is_shorter = [&](float is, float was) {
        return is < k_least_reach * was || is < std::min(k_usual_reach * was, was - 0.5f * least);
    };
    const auto was = limbs_of(c, s, before), is = limbs_of(c, s, after);
    for (size_t limb = 0; limb < k_limbs; ++limb) {
        const std::array<float, 3> long_was = was[limb].size(), long_is = is[limb].size();
        const float longest = *std::max_element(long_was.begin(), long_was.end());
        for (size_t axis = 0; axis < 3; ++axis) {
            const bool counts = limb + 1 == k_limbs || long_was[axis] == longest;
            if (counts && long_was[axis] >= least && is_shorter(long_is[axis], long_was[axis])) return false;
        }
    }
    const float area = area_of(s.places, before);
    return area < least * least || area_of(s.places, after) >= k_least_area * area;
}

// By part: six times what its triangles enclose, as seen from its own middle, and twice their area.
struct PartVolume {
    double volume = 0, area = 0;
};

std::vector<PartVolume> volumes_of(const LevelSurface& s, const std::vector<Vec3>& middles,
                                   std::span<const uint32_t> corners) {
    std::vector<PartVolume> out(s.parts);
    for (size_t t = 0; t + 2 < corners.size(); t += 3) {
        const uint32_t part = s.part[corners[t]];
        const Vec3 a = s.places[corners[t]] - middles[part], b = s.places[corners[t + 1]] - middles[part],
                   c = s.places[corners[t + 2]] - middles[part];
        out[part].volume += double(dot(a, cross(b, c)));
        out[part].area += double(length(cross(b - a, c - a)));
    }
    return out;
}

// By point: how far it moves outward so that its part holds what it held.
std::vector<Vec3> growth_of(const LevelSurface& s, std::span<const uint32_t> corners, float most) {
    std::vector<Vec3> middles(s.parts), ways(s.places.size());
    std::vector<float> counts(s.parts, 0);
    for (uint32_t p : s.corners) middles[s.part[p]] += s.places[p], counts[s.part[p]] += 1;
    for (uint32_t part = 0; part < s.parts; ++part)
        if (counts[part] > 0) middles[part] = middles[part] / counts[part];
    const auto was = volumes_of(s, middles, s.corners), is = volumes_of(s, middles, corners);
    for (size_t t = 0; t + 2 < corners.size(); t += 3) {
        const Vec3 a = s.places[corners[t]];
        const Vec3 normal = cross(s.places[corners[t + 1]] - a, s.places[corners[t + 2]] - a);
        for (size_t i = 0; i < 3; ++i) ways[s.place[corners[t + i]]] += normal * 1e4f;
    }
    std::vector<Vec3> growth(s.places.size());
    for (uint32_t p = 0; p < s.places.size(); ++p) {
        const uint32_t part = s.part[p];
        if (s.two_sided[p] || !(is[part].volume > 0) || !(was[part].volume > is[part].volume)) continue;
        const auto by = float((was[part].volume - is[part].volume) / (3 * is[part].area));
        growth[p] = normalize_or(ways[s.place[p]], {}) * std::min(by, most);
    }
    return growth;
}

// The points of some triangles by themselves.
struct LooseMesh {
    std::vector<uint32_t> corners, points;
    std::vector<Vec3> weighed;
};

// By part, its triangles.
std::vector<LooseMesh> take_apart(const LevelSurface& s) {
    std::vector<LooseMesh> parts(s.parts);
    std::vector<uint32_t> own(s.places.size(), ~0u);
    for (uint32_t p : s.corners) {
        LooseMesh& part = parts[s.part[p]];
        if (own[p] == ~0u) {
            own[p] = uint32_t(part.points.size());
            part.points.push_back(p);
            part.weighed.push_back(s.weighed[p]);
        }
        part.corners.push_back(own[p]);
    }
    return parts;
}

std::vector<uint32_t> simplified(const LooseMesh& part, size_t triangles, float most_error) {
    std::vector<uint32_t> out(part.corners.size());
    const float scale = meshopt_simplifyScale(&part.weighed[0].x, part.weighed.size(), sizeof(Vec3));
    if (scale > 0)
        out.resize(meshopt_simplify(out.data(), part.corners.data(), part.corners.size(), &part.weighed[0].x,
                                    part.weighed.size(), sizeof(Vec3), 3 * triangles, most_error / scale, 0,
                                    nullptr));
    else
        out = part.corners;
    for (uint32_t& p : out) p = part.points[p];
    return out;
}

}  // namespace

std::vector<uint8_t> find_cut(const std::vector<Texture>& textures) {
    std::vector<uint8_t> cut(textures.size(), 0);
    for (size_t t = 0; t < textures.size(); ++t)
        for (size_t i = 3; i < textures[t].rgba.size() && !cut[t]; i += 4) cut[t] = textures[t].rgba[i] < 128;
    return cut;
}

LevelSurface make_surface(const Character& c, const std::vector<uint32_t>& corners,
                          const std::vector<Vec3>& weighed, bool keeps_uv) {
    const std::vector<uint8_t> cut = find_cut(c.textures);
    std::vector<uint32_t> used = corners;
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::vector<std::pair<PointKey, uint32_t>> order;
    order.reserve(used.size());
    for (uint32_t v : used) order.push_back({key_of(c, c.vertices[v], cut, keeps_uv), v});
    std::sort(order.begin(), order.end());

    LevelSurface s;
    std::vector<uint32_t> point(c.vertices.size(), ~0u), together;
    uint32_t first_there = 0;  // point at this place
    for (size_t i = 0; i < order.size(); ++i) {
        const auto& [key, v] = order[i];
        const bool moved = i == 0 || !std::equal(key.begin(), key.begin() + 3, order[i - 1].first.begin());
        if (i == 0 || key != order[i - 1].first) {
            const auto p = uint32_t(s.places.size());
            if (moved) first_there = p;
            s.places.push_back(c.vertices[v].position);
            // One place moves as one, whatever the weights of its vertices.
            s.weighed.push_back(moved ? weighed[v] : s.weighed[first_there]);
            s.first.push_back(uint32_t(s.members.size()));
            together.push_back(first_there);
        }
        point[v] = uint32_t(s.places.size() - 1);
        s.members.push_back(v);
    }
    s.first.push_back(uint32_t(s.members.size()));
    for (uint32_t v : corners) s.corners.push_back(point[v]);
    s.two_sided.assign(s.places.size(), 0);
    leave_out_backs(s);

    s.place = together;
    s.part = std::move(together);
    s.chart.resize(s.places.size());
    std::iota(s.chart.begin(), s.chart.end(), 0u);
    for (size_t t = 0; t + 2 < s.corners.size(); t += 3)
        for (size_t i : {1, 2}) {
            join(s.part, s.corners[t], s.corners[t + i]);
            join(s.chart, s.corners[t], s.corners[t + i]);
        }
    s.parts = number_sets(s.part);
    s.charts = number_sets(s.chart);
    return s;
}

std::vector<uint32_t> simplified(const Character& c, const LevelSurface& s, size_t triangles, float least,
                                 float most_error) {
    constexpr size_t k_fewest = 8;  // triangles of a part
    const float whole = std::max(area_of(s.weighed, s.corners), 1e-12f);
    std::vector<uint32_t> out;
    for (const LooseMesh& part : take_apart(s)) {
        if (part.corners.empty()) continue;
        std::vector<uint32_t> before;
        for (uint32_t p : part.corners) before.push_back(part.points[p]);
        const size_t fine = before.size() / 3;
        const float share = area_of(part.weighed, part.corners) / whole;
        size_t wanted = std::max(size_t(share * float(triangles)), k_fewest);
        float error = most_error;
        std::vector<uint32_t> after = before;
        for (; wanted < fine; wanted += wanted / 2, error *= 0.7f) {
            after = simplified(part, wanted, error);
            if (is_whole(c, s, before, after, least)) break;
            after = before;
        }
        out.insert(out.end(), after.begin(), after.end());
    }
    return out;
}

DrawnTriangles with_vertices(Character& c, const LevelSurface& s, const std::vector<uint32_t>& corners,
                             float most_growth) {
    DrawnTriangles out;
    const std::vector<Vec3> growth = growth_of(s, corners, most_growth);
    std::vector<uint32_t> grown(c.vertices.size(), ~0u);  // by vertex
    auto moved = [&](uint32_t v, uint32_t p) {
        if (growth[p] == Vec3{}) return v;
        if (grown[v] == ~0u) {
            grown[v] = uint32_t(c.vertices.size());
            CharacterVertex vertex = c.vertices[v];
            vertex.position += growth[p];
            c.vertices.push_back(vertex);
        }
        return grown[v];
    };
    auto add = [&](const std::array<uint32_t, 3>& points) {
        const Vec3 a = s.places[points[0]];
        const Vec3 normal = cross(s.places[points[1]] - a, s.places[points[2]] - a);
        for (uint32_t p : points) {
            uint32_t chosen = s.members[s.first[p]];
            float fit = -1e30f;
            for (uint32_t m = s.first[p]; m < s.first[p + 1]; ++m) {
                const float f = dot(c.vertices[s.members[m]].normal, normal);
                if (f > fit) fit = f, chosen = s.members[m];
            }
            out.vertices.push_back(moved(chosen, p));
            out.points.push_back(p);
        }
    };
    for (size_t t = 0; t + 2 < corners.size(); t += 3) {
        const std::array<uint32_t, 3> p = {corners[t], corners[t + 1], corners[t + 2]};
        add(p);
        if (s.two_sided[p[0]] && s.two_sided[p[1]] && s.two_sided[p[2]]) add({p[0], p[2], p[1]});
    }
    return out;
}

}  // namespace flaneur
