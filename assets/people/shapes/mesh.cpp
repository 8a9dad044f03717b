#include "assets/people/shapes/mesh.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>

namespace flaneur {

namespace {

constexpr int k_block = 4;  // samples along a block's edge

struct Samples {
    int nx, ny, nz, half;
    std::vector<float> x, y, z, value;
    std::vector<uint8_t> crossed;  // by block of the positive half: whether the surface may be near
    size_t at(int i, int j, int k) const {
        return (size_t(k) * size_t(ny) + size_t(j)) * size_t(nx) + size_t(i);
    }
    bool inside(int i, int j, int k) const { return value[at(i, j, k)] < 0; }
    Vec3 place(int i, int j, int k) const { return {x[size_t(i)], y[size_t(j)], z[size_t(k)]}; }
    size_t block(int folded_i, int j, int k) const {
        size_t bx = size_t((half + k_block - 1) / k_block), by = size_t((ny + k_block - 1) / k_block);
        return (size_t(k / k_block) * by + size_t(j / k_block)) * bx + size_t(folded_i / k_block);
    }
};

// visit(i, j, k) for every cell, by its lowest corner, that the surface may cross, in a fixed order.
template <class Visit>
void for_crossed_cells(const Samples& s, Visit&& visit) {
    for (int k0 = 0; k0 + 1 < s.nz; k0 += k_block)
        for (int j0 = 0; j0 + 1 < s.ny; j0 += k_block)
            for (int i0 = 0; i0 < s.half; i0 += k_block) {
                if (!s.crossed[s.block(i0, j0, k0)]) continue;
                int k1 = std::min(k0 + k_block, s.nz - 1), j1 = std::min(j0 + k_block, s.ny - 1);
                int i1 = std::min(i0 + k_block, s.half);
                for (int k = k0; k < k1; ++k)
                    for (int j = j0; j < j1; ++j)
                        for (int i = i0; i < i1; ++i) {
                            if (s.half + i + 1 < s.nx) visit(s.half + i, j, k);
                            if (s.half - 2 - i >= 0) visit(s.half - 2 - i, j, k);
                            if (i == 0) visit(s.half - 1, j, k);
                        }
            }
}

// The distance is sampled only in blocks that the surface may cross; elsewhere its sign will do.
Samples sample(const Field& field, const FieldGrid& grid) {
    Samples s;
    s.half = int(grid.half_x.size());
    s.nx = 2 * s.half, s.ny = int(grid.y.size()), s.nz = int(grid.z.size());
    for (int i = s.half; i-- > 0;) s.x.push_back(-grid.half_x[size_t(i)]);
    s.x.insert(s.x.end(), grid.half_x.begin(), grid.half_x.end());
    s.y = grid.y;
    s.z = grid.z;
    s.value.resize(size_t(s.nx) * size_t(s.ny) * size_t(s.nz));
    s.crossed.assign(s.block(s.half - 1, s.ny - 1, s.nz - 1) + 1, 0);
    std::vector<uint16_t> near;
    for (int k0 = 0; k0 < s.nz; k0 += k_block)
        for (int j0 = 0; j0 < s.ny; j0 += k_block)
            for (int i0 = s.half; i0 < s.nx; i0 += k_block) {
                int i1 = std::min(i0 + k_block, s.nx), j1 = std::min(j0 + k_block, s.ny),
                    k1 = std::min(k0 + k_block, s.nz);
                Vec3 low = s.place(i0, j0, k0), high = s.place(i1 - 1, j1 - 1, k1 - 1);
                Vec3 middle = (low + high) * 0.5f;
                float reach = length(high - low) + 0.004f;  // twice the radius: distances are approximate
                parts_touching(field, middle, reach, near);
                float at_middle = distance(layer_distances(field, near, middle));
                bool crossed = (at_middle < 0 ? -at_middle : at_middle) < reach;
                s.crossed[s.block(i0 - s.half, j0, k0)] = crossed;
                for (int k = k0; k < k1; ++k)
                    for (int j = j0; j < j1; ++j)
                        for (int i = i0; i < i1; ++i) {
                            float v = crossed ? distance(layer_distances(field, near, s.place(i, j, k)))
                                              : at_middle;
                            s.value[s.at(i, j, k)] = s.value[s.at(s.nx - 1 - i, j, k)] = v;
                        }
            }
    return s;
}

// Fills samples until the set inside is well-composed (Latecki 1997): no two of its samples, nor two outside,
// touch across a diagonal only. The surface net of such a set is a two-manifold.
void repair(Samples& s) {
    auto fill_nearest = [&](std::span<const size_t> outside) {
        size_t best = outside[0];
        for (size_t o : outside)
            if (s.value[o] < s.value[best]) best = o;
        s.value[best] = -1e-5f;
    };
    size_t sx = 1, sy = size_t(s.nx), sz = size_t(s.nx) * size_t(s.ny);
    auto square = [&](size_t a, size_t u, size_t v) {
        size_t c[4] = {a, a + u, a + u + v, a + v};
        bool in[4];
        for (int n = 0; n < 4; ++n) in[n] = s.value[c[n]] < 0;
        if (in[0] != in[2] || in[1] != in[3] || in[0] == in[1]) return false;
        size_t outside[2] = {in[0] ? c[1] : c[0], in[0] ? c[3] : c[2]};
        fill_nearest(outside);
        return true;
    };
    auto cube = [&](size_t a) {
        size_t c[8];
        int count = 0;
        unsigned mask = 0;
        for (unsigned n = 0; n < 8; ++n) {
            c[n] = a + (n & 1 ? sx : 0) + (n & 2 ? sy : 0) + (n & 4 ? sz : 0);
            if (s.value[c[n]] < 0) mask |= 1u << n, ++count;
        }
        for (unsigned n = 0; n < 4; ++n) {
            unsigned pair = 1u << n | 1u << (7 - n);
            if (mask != pair && mask != (0xffu ^ pair)) continue;
            std::vector<size_t> outside;
            for (unsigned m = 0; m < 8; ++m)
                if (!(mask >> m & 1)) outside.push_back(c[m]);
            fill_nearest(outside);
            return true;
        }
        return false;
    };
    for (bool changed = true; changed;) {
        changed = false;
        for_crossed_cells(s, [&](int i, int j, int k) {
            size_t a = s.at(i, j, k);
            bool in = s.value[a] < 0, all = true;
            for (size_t corner : {sx, sy, sz, sx + sy, sy + sz, sz + sx, sx + sy + sz})
                all = all && (s.value[a + corner] < 0) == in;
            if (all) return;
            for (auto [u, v] : {std::pair{sx, sy}, {sy, sz}, {sz, sx}})
                if (square(a, u, v)) changed = true;
            if (cube(a)) changed = true;
        });
    }
}

uint32_t add_vertex(const Samples& s, int i, int j, int k, FieldMesh& mesh) {
    Vec3 sum;
    float count = 0;
    for (unsigned e = 0; e < 12; ++e) {
        unsigned axis = e / 4, a = e & 1, b = e >> 1 & 1;
        int from[3], to[3];
        from[axis] = 0, to[axis] = 1;
        from[(axis + 1) % 3] = to[(axis + 1) % 3] = int(a);
        from[(axis + 2) % 3] = to[(axis + 2) % 3] = int(b);
        float v0 = s.value[s.at(i + from[0], j + from[1], k + from[2])];
        float v1 = s.value[s.at(i + to[0], j + to[1], k + to[2])];
        if ((v0 < 0) == (v1 < 0)) continue;
        sum += lerp(s.place(i + from[0], j + from[1], k + from[2]), s.place(i + to[0], j + to[1], k + to[2]),
                    v0 / (v0 - v1));
        count += 1;
    }
    mesh.positions.push_back(sum / count);
    return uint32_t(mesh.positions.size() - 1);
}

}  // namespace

FieldMesh polygonise(const Field& field, const FieldGrid& grid) {
    Samples s = sample(field, grid);
    repair(s);
    FieldMesh mesh;
    std::vector<uint32_t> vertex(s.value.size());
    for_crossed_cells(s, [&](int i, int j, int k) {
        int count = 0;
        for (unsigned n = 0; n < 8; ++n)
            count += s.inside(i + int(n & 1), j + int(n >> 1 & 1), k + int(n >> 2 & 1));
        if (count > 0 && count < 8) vertex[s.at(i, j, k)] = add_vertex(s, i, j, k, mesh);
    });
    auto quad = [&](uint32_t a, uint32_t b, uint32_t c, uint32_t d, bool flip) {
        if (flip) std::swap(b, d);
        const auto& p = mesh.positions;
        if (length_squared(p[a] - p[c]) <= length_squared(p[b] - p[d]))
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        else
            mesh.indices.insert(mesh.indices.end(), {b, c, d, b, d, a});
    };
    for_crossed_cells(s, [&](int i, int j, int k) {
        bool in = s.inside(i, j, k);
        auto v = [&](int di, int dj, int dk) { return vertex[s.at(i + di, j + dj, k + dk)]; };
        if (in != s.inside(i + 1, j, k)) quad(v(0, -1, -1), v(0, 0, -1), v(0, 0, 0), v(0, -1, 0), !in);
        if (in != s.inside(i, j + 1, k)) quad(v(-1, 0, -1), v(-1, 0, 0), v(0, 0, 0), v(0, 0, -1), !in);
        if (in != s.inside(i, j, k + 1)) quad(v(-1, -1, 0), v(0, -1, 0), v(0, 0, 0), v(-1, 0, 0), !in);
    });
    mesh.materials.assign(mesh.positions.size(), 0);
    return mesh;
}

FieldMesh cut_materials(const FieldMesh& mesh, const Field& field, std::span<const Layer> layer_of,
                        const PaintDistances& paint) {
    size_t count = mesh.positions.size(), stride = layer_of.size();
    std::vector<LayerDistances> layers(count);
    std::vector<float> paints(count * stride);
    FieldMesh out;
    out.positions = mesh.positions;
    out.materials.resize(count);
    std::vector<uint16_t> near;
    for (size_t v = 0; v < count; ++v) {
        Vec3 p = mesh.positions[v];
        parts_near(field, p, 0.01f, near);
        layers[v] = layer_distances(field, near, p);
        std::span<float> row(&paints[v * stride], stride);
        paint(layers[v], p, row);
        auto visible = Layer(std::min_element(layers[v].begin(), layers[v].end()) - layers[v].begin());
        size_t best = stride;
        for (size_t m = 0; m < stride; ++m)
            if (layer_of[m] == visible && (best == stride || row[m] < row[best])) best = m;
        out.materials[v] = uint8_t(best);
    }
    // By how much `mine` wins over `other` at v.
    auto lead = [&](uint32_t v, uint8_t mine, uint8_t other) {
        if (layer_of[mine] != layer_of[other]) return layers[v][layer_of[other]] - layers[v][layer_of[mine]];
        return paints[v * stride + other] - paints[v * stride + mine];
    };

    struct Cut {
        uint64_t edge;       // lower vertex, higher vertex
        uint32_t low, high;  // the new vertices on either side
    };
    std::vector<Cut> cuts;
    for (size_t t = 0; t < mesh.indices.size(); ++t) {
        uint32_t a = mesh.indices[t], b = mesh.indices[t % 3 == 2 ? t - 2 : t + 1];
        if (a < b && out.materials[a] != out.materials[b]) cuts.push_back({uint64_t{a} << 32 | b, 0, 0});
    }
    std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.edge < b.edge; });
    auto add = [&](Vec3 p, uint8_t material) {
        out.positions.push_back(p);
        out.materials.push_back(material);
        return uint32_t(out.positions.size() - 1);
    };
    for (Cut& cut : cuts) {
        auto a = uint32_t(cut.edge >> 32), b = uint32_t(cut.edge);
        uint8_t ma = out.materials[a], mb = out.materials[b];
        float at_a = lead(a, ma, mb), at_b = lead(b, mb, ma);
        Vec3 p =
            lerp(mesh.positions[a], mesh.positions[b], clamp(at_a / (at_a + at_b + 1e-9f), 0.05f, 0.95f));
        cut.low = add(p, ma);
        cut.high = add(p, mb);
    }
    // The vertex on the edge from a to b on the side of a.
    auto cut_at = [&](uint32_t a, uint32_t b) {
        uint64_t edge = a < b ? uint64_t{a} << 32 | b : uint64_t{b} << 32 | a;
        const Cut& cut = *std::lower_bound(cuts.begin(), cuts.end(), edge,
                                           [](const Cut& c, uint64_t e) { return c.edge < e; });
        return a < b ? cut.low : cut.high;
    };
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        std::array<uint32_t, 3> v = {mesh.indices[t], mesh.indices[t + 1], mesh.indices[t + 2]};
        auto differ = [&](size_t i, size_t j) { return out.materials[v[i]] != out.materials[v[j]]; };
        auto emit = [&](uint32_t a, uint32_t b, uint32_t c) {
            out.indices.insert(out.indices.end(), {a, b, c});
        };
        if (!differ(0, 1) && !differ(1, 2)) {
            emit(v[0], v[1], v[2]);
        } else if (differ(0, 1) && differ(1, 2) && differ(2, 0)) {
            Vec3 middle = (out.positions[v[0]] + out.positions[v[1]] + out.positions[v[2]]) / 3;
            for (size_t i = 0; i < 3; ++i) {
                uint32_t a = v[i], b = v[(i + 1) % 3], c = v[(i + 2) % 3];
                uint32_t m = add(middle, out.materials[a]);
                emit(a, cut_at(a, b), m);
                emit(a, m, cut_at(a, c));
            }
        } else {
            size_t i = !differ(1, 2) ? 0 : (!differ(2, 0) ? 1 : 2);  // the odd one out
            uint32_t a = v[i], b = v[(i + 1) % 3], c = v[(i + 2) % 3];
            emit(a, cut_at(a, b), cut_at(a, c));
            emit(cut_at(b, a), b, c);
            emit(cut_at(b, a), c, cut_at(c, a));
        }
    }
    return out;
}

std::vector<uint32_t> place_numbers(const std::vector<Vec3>& positions) {
    std::vector<uint32_t> order(positions.size()), number(positions.size());
    for (size_t v = 0; v < order.size(); ++v) order[v] = uint32_t(v);
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        Vec3 p = positions[a], q = positions[b];
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        return p.z != q.z ? p.z < q.z : a < b;
    });
    for (size_t i = 0; i < order.size(); ++i)
        number[order[i]] =
            i > 0 && positions[order[i]] == positions[order[i - 1]] ? number[order[i - 1]] : order[i];
    return number;
}

std::vector<uint32_t> painted_over(FieldMesh& mesh, bool (*hidden)(uint8_t), uint8_t material) {
    const std::vector<uint32_t> place = place_numbers(mesh.positions);
    constexpr uint32_t k_none = ~0u;
    std::vector<uint32_t> shown(place.size(), k_none);  // by place
    for (uint32_t v : mesh.indices)
        if (mesh.materials[v] == material) shown[place[v]] = v;
    std::vector<uint32_t> out;
    for (uint32_t v : mesh.indices) {
        if (hidden(mesh.materials[v])) {
            uint32_t& other = shown[place[v]];
            if (other == k_none) {
                other = uint32_t(mesh.positions.size());
                Vec3 p = mesh.positions[v];
                mesh.positions.push_back(p);
                mesh.materials.push_back(material);
            }
            v = other;
        }
        out.push_back(v);
    }
    return out;
}

namespace {

// Drops triangles without area and pairs of triangles back to back.
void drop_flat(FieldMesh& mesh, const std::vector<uint32_t>& place) {
    struct Flat {
        std::array<uint32_t, 3> corners;  // sorted
        size_t triangle;
    };
    std::vector<Flat> all;
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        std::array<uint32_t, 3> c = {place[mesh.indices[t]], place[mesh.indices[t + 1]],
                                     place[mesh.indices[t + 2]]};
        std::sort(c.begin(), c.end());
        all.push_back({c, t});
    }
    std::vector<uint8_t> drop(mesh.indices.size(), 0);
    std::sort(all.begin(), all.end(), [](const Flat& a, const Flat& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.triangle < b.triangle;
    });
    for (size_t i = 0; i < all.size(); ++i) {
        const auto& c = all[i].corners;
        if (c[0] == c[1] || c[1] == c[2]) drop[all[i].triangle] = 1;
        if (i > 0 && c == all[i - 1].corners && !drop[all[i - 1].triangle])
            drop[all[i].triangle] = drop[all[i - 1].triangle] = 1;
    }
    std::vector<uint32_t> kept;
    for (size_t t = 0; t < mesh.indices.size(); t += 3)
        if (!drop[t])
            kept.insert(kept.end(), mesh.indices.begin() + long(t), mesh.indices.begin() + long(t) + 3);
    mesh.indices = std::move(kept);
}

// The simplifier may pinch the surface until four triangles meet at an edge. Two and two of them are given a
// place of their own in the middle of the edge, so that each edge has two sides again.
void open_pinches(FieldMesh& mesh) {
    struct Side {
        uint64_t edge;  // lower place, higher place
        bool falls;     // the triangle runs from the higher to the lower
        size_t corner;  // in the index list, where the side begins
    };
    for (int round = 0; round < 10; ++round) {
        std::vector<uint32_t> place = place_numbers(mesh.positions);
        drop_flat(mesh, place);
        auto next = [](size_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
        std::vector<Side> sides;
        for (size_t t = 0; t < mesh.indices.size(); ++t) {
            uint32_t a = place[mesh.indices[t]], b = place[mesh.indices[next(t)]];
            sides.push_back({uint64_t{std::min(a, b)} << 32 | std::max(a, b), a > b, t});
        }
        std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
            if (a.edge != b.edge) return a.edge < b.edge;
            return a.falls != b.falls ? b.falls : a.corner < b.corner;
        });
        auto normal = [&](size_t corner) {
            size_t t = corner - corner % 3;
            Vec3 p[3];
            for (size_t i = 0; i < 3; ++i) p[i] = mesh.positions[mesh.indices[t + i]];
            return normalize_or(cross(p[1] - p[0], p[2] - p[0]), {0, 1, 0});
        };
        std::vector<uint8_t> split(mesh.indices.size(), 0);  // by first corner of a triangle
        bool pinched = false;
        for (size_t first = 0, last = 0; first < sides.size(); first = last) {
            while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
            if (last - first != 4 || sides[first + 1].falls || !sides[first + 2].falls) continue;
            pinched = true;
            std::array<size_t, 4> c;
            bool free = true;
            for (size_t i = 0; i < 4; ++i) {
                c[i] = sides[first + i].corner;
                free = free && !split[c[i] - c[i] % 3];
            }
            if (!free) continue;
            // A rising side goes with the falling one whose triangle faces most nearly where its own does.
            if (dot(normal(c[0]), normal(c[2])) + dot(normal(c[1]), normal(c[3])) <
                dot(normal(c[0]), normal(c[3])) + dot(normal(c[1]), normal(c[2])))
                std::swap(c[2], c[3]);
            const Vec3 off[2] = {normal(c[0]) + normal(c[2]), normal(c[1]) + normal(c[3])};
            for (size_t i = 0; i < 4; ++i) {
                size_t corner = c[i], pair = i % 2;
                uint32_t a = mesh.indices[corner], b = mesh.indices[next(corner)],
                         apex = mesh.indices[next(next(corner))];
                auto m = uint32_t(mesh.positions.size());
                Vec3 middle = (mesh.positions[a] + mesh.positions[b]) * .5f;
                mesh.positions.push_back(middle + off[pair] * (pair == 0 ? 2e-5f : 1e-5f));
                mesh.materials.push_back(mesh.materials[a]);
                split[corner - corner % 3] = 1;
                mesh.indices[next(corner)] = m;
                mesh.indices.insert(mesh.indices.end(), {m, b, apex});
            }
        }
        if (!pinched) return;
    }
}

}  // namespace

void simplify_mesh(FieldMesh& mesh, size_t triangles, const std::function<Vec3(Vec3)>& importance) {
    std::vector<Vec3> scaled(mesh.positions.size());
    std::transform(mesh.positions.begin(), mesh.positions.end(), scaled.begin(), importance);
    std::vector<uint32_t> indices(mesh.indices.size());
    indices.resize(meshopt_simplify(indices.data(), mesh.indices.data(), mesh.indices.size(), &scaled[0].x,
                                    scaled.size(), sizeof(Vec3), triangles * 3, 0.02f, 0, nullptr));
    std::vector<uint32_t> remap(mesh.positions.size());
    FieldMesh out;
    size_t kept =
        meshopt_optimizeVertexFetchRemap(remap.data(), indices.data(), indices.size(), remap.size());
    out.positions.resize(kept);
    out.materials.resize(kept);
    for (size_t v = 0; v < remap.size(); ++v)
        if (remap[v] != ~0u) {
            out.positions[remap[v]] = mesh.positions[v];
            out.materials[remap[v]] = mesh.materials[v];
        }
    out.indices.resize(indices.size());
    meshopt_remapIndexBuffer(out.indices.data(), indices.data(), indices.size(), remap.data());
    mesh = std::move(out);
    open_pinches(mesh);
}

}  // namespace flaneur
