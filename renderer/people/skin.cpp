#include "renderer/people/skin.h"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/people/skin.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/vec-inl.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

using L = Lanes;

// Rows of a joint in the palette and of a vertex, each one number of every walker that is skinned together.
enum JointRow { k_turn, k_shift = 4, k_joint_rows = 7 };
enum VertexRow { k_place, k_normal = 3, k_seen, k_vertex_rows = 6 };

HWY_INLINE L row_at(const float* rows, size_t row) {
    L out;
    load(out, rows + row * lane_count());
    return out;
}
HWY_INLINE void put_row(L value, float* rows, size_t row) { store(value, rows + row * lane_count()); }

// Into rows, by joint; lanes beyond the walkers keep what was there.
void gather_palette(std::span<const WalkerInstance> walkers, std::span<const JointTransform> palette,
                    float* rows) {
    const size_t lanes = lane_count();
    for (size_t lane = 0; lane < walkers.size(); ++lane) {
        const JointTransform* joints = &palette[walkers[lane].palette];
        for (size_t j = 0; j < k_palette_joints; ++j) {
            float* out = rows + j * k_joint_rows * lanes + lane;
            for (int c = 0; c < 4; ++c) out[(k_turn + c) * lanes] = joints[j].rotation[c];
            for (int c = 0; c < 3; ++c) out[(k_shift + c) * lanes] = joints[j].translation[c];
        }
        rows[k_palette_joints * k_joint_rows * lanes + lane] = walkers[lane].scale;
    }
}

HWY_INLINE Q4<L> turn_of(const float* joint) {
    return {row_at(joint, 0), row_at(joint, 1), row_at(joint, 2), row_at(joint, 3)};
}
HWY_INLINE V3<L> moved_by(const float* joint, Q4<L> turn, V3<L> v) {
    return rotate(turn, v) +
           V3<L>{row_at(joint, k_shift), row_at(joint, k_shift + 1), row_at(joint, k_shift + 2)};
}

// As bits of a float: x, y, z times 511, ten bits each. Normals of meshes, in 127ths, may be longer than one.
HWY_INLINE L packed(V3<L> n) {
    const LaneTag tag;
    const hn::Rebind<int32_t, LaneTag> whole;
    const auto low = hn::Set(whole, 1023);
    auto part = [&](L v) HWY_ATTR {
        return hn::And(hn::NearestInt((clamp(v, L(-1.0f), L(1.0f)) * L(511.0f)).v), low);
    };
    return hn::BitCast(tag,
                       hn::Or(part(n.x), hn::Or(hn::ShiftLeft<10>(part(n.y)), hn::ShiftLeft<20>(part(n.z)))));
}

// Every vertex of a mesh for the walkers of a palette: the formula of skin.glsl, then where it is seen, in
// pixels; not a number if that is not before the near plane.
void skin_vertices(const SkinMesh& mesh, const float* palette, const SkinView& view, float* out) {
    const glm::mat4& m = view.clip_from_world;
    const size_t joint_stride = k_joint_rows * lane_count();
    const L scale = row_at(palette, k_palette_joints * k_joint_rows);
    const L near(view.near), none(std::numeric_limits<float>::quiet_NaN());
    const L half_width(0.5f * view.width), half_height(0.5f * view.height), one(1.0f);
    auto clip = [&](int c, V3<L> p)
                    HWY_ATTR { return L(m[0][c]) * p.x + L(m[1][c]) * p.y + L(m[2][c]) * p.z + L(m[3][c]); };
    for (const SkinMesh::Vertex& vertex : mesh.vertices) {
        const V3<L> v{L(vertex.place[0]) * scale, L(vertex.place[1]) * scale, L(vertex.place[2]) * scale};
        const float* joint = palette + vertex.joints[0] * joint_stride;
        const Q4<L> own = turn_of(joint);
        V3<L> place = moved_by(joint, own, v);
        Q4<L> turn = own;
        const uint32_t bones = std::min(vertex.bones, view.bones);
        if (bones > 1) {
            L weight(vertex.weights[0]);
            place = place * weight;
            turn = {turn.x * weight, turn.y * weight, turn.z * weight, turn.w * weight};
            for (uint32_t k = 1; k < bones; ++k) {
                joint = palette + vertex.joints[k] * joint_stride;
                weight = L(vertex.weights[k]);
                const Q4<L> q = turn_of(joint);
                place = place + moved_by(joint, q, v) * weight;
                const L along = own.x * q.x + own.y * q.y + own.z * q.z + own.w * q.w;
                const L share = select(along < L(0.0f), -weight, weight);
                turn = {turn.x + q.x * share, turn.y + q.y * share, turn.z + q.z * share,
                        turn.w + q.w * share};
            }
            turn = normalize(turn);
        }
        const V3<L> normal =
            rotate(turn, V3<L>{L(vertex.normal[0]), L(vertex.normal[1]), L(vertex.normal[2])});
        put_row(place.x, out, k_place);
        put_row(place.y, out, k_place + 1);
        put_row(place.z, out, k_place + 2);
        put_row(packed(normal), out, k_normal);
        const L w = clip(3, place), inverse = one / w;
        const auto is_before = w > near;
        put_row(select(is_before, (clip(0, place) * inverse + one) * half_width, none), out, k_seen);
        put_row(select(is_before, (clip(1, place) * inverse + one) * half_height, none), out, k_seen + 1);
        out += k_vertex_rows * lane_count();
    }
}

// What a view sees for certain not, of triangles as they are seen.
//
// The rasteriser snaps corners to 1/256 of a pixel: k_snap and k_area are more than that moves an edge, over
// the width of two pixels, and the sums of rounding errors.
struct Sieve {
    static constexpr float k_snap = 1.0f / 128, k_area = 1.0f / 64;
    L reach, last_x, last_y;  // of samples about a pixel's centre; last centres of the picture

    // The first and the last pixel whose samples an extent may cover.
    HWY_INLINE L first_of(L low) const { return max(-floor(-(low - reach - L(0.5f))), L(0.0f)); }
    HWY_INLINE static L last_of(L high, L reach, L last) { return min(floor(high + reach - L(0.5f)), last); }

    HWY_INLINE LaneMask loses(L ax, L ay, L bx, L by, L cx, L cy) const {
        const L ux = bx - ax, uy = by - ay, vx = cx - bx, vy = cy - by, wx = ax - cx, wy = ay - cy;
        const L area = ux * vy - uy * vx;  // twice; below 0 in front
        const L left = first_of(min(min(ax, bx), cx)), top = first_of(min(min(ay, by), cy));
        const L right = last_of(max(max(ax, bx), cx), reach, last_x);
        const L bottom = last_of(max(max(ay, by), cy), reach, last_y);
        const L size = abs(ux) + abs(uy) + abs(vx) + abs(vy);
        auto lost = (left > right) | (top > bottom) | (area > L(k_snap) * size);
        // Where there is but one pixel: whether that is beyond an edge.
        const auto is_one = (left >= right) & (top >= bottom);
        const L x = left + L(0.5f), y = top + L(0.5f);
        auto is_beyond = [&](L px, L py, L dx, L dy) HWY_ATTR {
            const L across = dx * (y - py) - dy * (x - px);
            return across > (reach * (abs(dx) + abs(dy)) + L(k_area));
        };
        lost = lost |
               (is_one & (is_beyond(ax, ay, ux, uy) | is_beyond(bx, by, vx, vy) | is_beyond(cx, cy, wx, wy)));
        // Not where a corner is not a number.
        return lost & (abs(area) <= L(std::numeric_limits<float>::max()));
    }
};

// Lists, for each lane, the triangles that may be seen: lane l's from survivors[l * triangles] on.
void sieve_triangles(const SkinMesh& mesh, const float* vertices, const SkinView& view, uint64_t lanes_used,
                     uint32_t* survivors, uint32_t* counts) {
    const LaneTag tag;
    const size_t stride = k_vertex_rows * lane_count(), triangles = mesh.indices.size() / 3;
    const Sieve sieve{L(Sieve::k_snap), L(view.width - 1), L(view.height - 1)};
    for (size_t t = 0; t < triangles; ++t) {
        const uint32_t* corner = &mesh.indices[3 * t];
        const float *a = vertices + corner[0] * stride, *b = vertices + corner[1] * stride,
                    *c = vertices + corner[2] * stride;
        const LaneMask lost = sieve.loses(row_at(a, k_seen), row_at(a, k_seen + 1), row_at(b, k_seen),
                                          row_at(b, k_seen + 1), row_at(c, k_seen), row_at(c, k_seen + 1));
        uint64_t bits = 0;
        uint8_t bytes[8] = {};
        hn::StoreMaskBits(tag, lost.m, bytes);
        for (size_t i = 0; i < 8; ++i) bits |= uint64_t{bytes[i]} << 8 * i;
        for (uint64_t left = ~bits & lanes_used; left != 0; left &= left - 1) {
            const auto lane = static_cast<size_t>(std::countr_zero(left));
            survivors[lane * triangles + counts[lane]++] = static_cast<uint32_t>(t);
        }
    }
}

struct Written {
    uint32_t vertices = 0, indices = 0;
};

// The triangles of one lane, with their vertices in the order of first use.
void write_walker(const SkinMesh& mesh, const float* rows, size_t lane, const WalkerInstance& walker,
                  std::span<const uint32_t> survivors, std::vector<uint32_t>& numbers,
                  SkinnedVertex* vertices, uint32_t* indices, Written& written) {
    constexpr uint32_t none = ~0u;
    numbers.assign(mesh.vertices.size(), none);
    const size_t lanes = lane_count();
    for (const uint32_t triangle : survivors) {
        for (uint32_t k = 0; k < 3; ++k) {
            const uint32_t corner = mesh.indices[3 * triangle + k];
            uint32_t& number = numbers[corner];
            if (number == none) {
                number = written.vertices++;
                const float* row = rows + corner * k_vertex_rows * lanes + lane;
                const SkinMesh::Vertex& from = mesh.vertices[corner];
                vertices[number] = {{row[0], row[lanes], row[2 * lanes]},
                                    std::bit_cast<uint32_t>(row[3 * lanes]),
                                    from.uv,
                                    from.colour,
                                    walker.tints[from.tint],
                                    from.layer | walker.hidden << 16};
            }
            indices[written.indices++] = number;
        }
    }
}

void skin_run(const SkinRun& run, std::span<const WalkerInstance> instances,
              std::span<const JointTransform> palette, const SkinView& view, SkinScratch& scratch,
              SkinnedVertex* vertices, uint32_t* indices, Written& written) {
    const SkinMesh& mesh = *run.mesh;
    const size_t lanes = lane_count(), triangles = mesh.indices.size() / 3;
    constexpr size_t alignment = 64 / sizeof(float);
    auto aligned = [](std::vector<float>& rows, size_t size) {
        if (rows.size() < size + alignment) rows.resize(size + alignment);
        const auto address = reinterpret_cast<uintptr_t>(rows.data());
        return rows.data() + (64 - address % 64) % 64 / sizeof(float);
    };
    float* joints = aligned(scratch.palette, (k_palette_joints * k_joint_rows + 1) * lanes);
    float* rows = aligned(scratch.vertices, mesh.vertices.size() * k_vertex_rows * lanes);
    if (scratch.survivors.size() < lanes * triangles) scratch.survivors.resize(lanes * triangles);
    for (uint32_t first = 0; first < run.count; first += static_cast<uint32_t>(lanes)) {
        const auto walkers =
            instances.subspan(run.first_instance + first, std::min<size_t>(lanes, run.count - first));
        gather_palette(walkers, palette, joints);
        skin_vertices(mesh, joints, view, rows);
        uint32_t counts[64] = {};
        sieve_triangles(mesh, rows, view, (uint64_t{1} << walkers.size()) - 1, scratch.survivors.data(),
                        counts);
        for (size_t lane = 0; lane < walkers.size(); ++lane)
            write_walker(mesh, rows, lane, walkers[lane],
                         std::span(scratch.survivors).subspan(lane * triangles, counts[lane]),
                         scratch.numbers, vertices, indices, written);
    }
}

DrawCommand skin_batch_here(const SkinPlan& plan, const SkinBatch& batch,
                            std::span<const WalkerInstance> instances,
                            std::span<const JointTransform> palette, const SkinView& view,
                            SkinScratch& scratch, SkinnedVertex* vertices, uint32_t* indices) {
    Written written;
    for (const SkinRun& run : std::span(plan.runs).subspan(batch.first_run, batch.run_count))
        skin_run(run, instances, palette, view, scratch, vertices + batch.first_vertex,
                 indices + batch.first_index, written);
    return {written.indices, 1, batch.first_index, static_cast<int32_t>(batch.first_vertex), 0};
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(skin_batch_here);

namespace {

constexpr uint32_t k_most_batches = 64;        // about so many: enough to share them out among threads
constexpr uint32_t k_least_batch = 1u << 12;   // vertices
constexpr uint32_t k_most_skinned = 1u << 22;  // vertices: buffers take memory for all, though few are used
constexpr uint32_t k_run = 16;                 // walkers: a multiple of all that are skinned together

const SkinMesh& mesh_of(const DrawCommand& draw, std::span<const SkinMesh> meshes) {
    return *std::lower_bound(
        meshes.begin(), meshes.end(), draw.first_index,
        [](const SkinMesh& mesh, uint32_t first_index) { return mesh.first_index < first_index; });
}

}  // namespace

SkinMesh make_skin_mesh(std::span<const PersonVertex> vertices, std::span<const uint32_t> indices,
                        uint32_t first_index) {
    SkinMesh mesh;
    mesh.first_index = first_index;
    constexpr uint32_t none = ~0u;
    std::vector<uint32_t> numbers(vertices.size(), none);
    for (const uint32_t index : indices) {
        if (numbers[index] == none) {
            numbers[index] = static_cast<uint32_t>(mesh.vertices.size());
            const PersonVertex& from = vertices[index];
            SkinMesh::Vertex to{};
            for (int c = 0; c < 3; ++c) {
                to.place[c] = from.position[c];
                to.normal[c] = static_cast<float>(from.normal[c]) * (1.0f / 127.0f);
            }
            for (int k = 0; k < 4; ++k) {
                to.joints[k] = from.joints[k];
                to.weights[k] = static_cast<float>(from.weights[k]) / 255.0f;
                if (from.weights[k] > 0) to.bones = static_cast<uint32_t>(k) + 1;
            }
            to.uv = from.uv;
            to.colour = from.colour;
            to.tint = static_cast<uint8_t>(from.normal[3]);
            to.layer = from.texture;
            mesh.vertices.push_back(to);
        }
        mesh.indices.push_back(numbers[index]);
    }
    return mesh;
}

SkinPlan plan_skin(std::span<const DrawCommand> draws, std::span<const SkinMesh> meshes) {
    SkinPlan plan;
    uint64_t total = 0;
    for (const DrawCommand& draw : draws) {
        if (draw.index_count > 0)
            total += uint64_t{draw.instance_count} * mesh_of(draw, meshes).vertices.size();
        if (total > k_most_skinned) break;
        ++plan.draws;
    }
    const uint64_t enough = std::max<uint64_t>(total / k_most_batches, k_least_batch);
    uint32_t batch_vertices = 0;
    for (const DrawCommand& draw : draws.first(plan.draws)) {
        if (draw.index_count == 0) continue;
        const SkinMesh& mesh = mesh_of(draw, meshes);
        for (uint32_t first = 0; first < draw.instance_count; first += k_run) {
            if (plan.batches.empty() || batch_vertices >= enough) {
                plan.batches.push_back(
                    {static_cast<uint32_t>(plan.runs.size()), 0, plan.vertices, plan.indices});
                batch_vertices = 0;
            }
            const uint32_t count = std::min(k_run, draw.instance_count - first);
            const uint32_t vertices = count * static_cast<uint32_t>(mesh.vertices.size());
            plan.runs.push_back({&mesh, draw.first_instance + first, count});
            ++plan.batches.back().run_count;
            batch_vertices += vertices;
            plan.vertices += vertices;
            plan.indices += count * static_cast<uint32_t>(mesh.indices.size());
        }
    }
    return plan;
}

SkinView skin_view(const View& view, uint32_t width, uint32_t height) {
    const float near = view.clip_from_world[3][2];  // the depth there is 1
    return {view.clip_from_world, static_cast<float>(width), static_cast<float>(height), near};
}

SkinView skin_view(const ShadowBox& box, uint32_t resolution) {
    glm::mat4 clip_from_map(1);
    clip_from_map[0][0] = clip_from_map[1][1] = 2;
    clip_from_map[3] = {-1, -1, 0, 1};
    const float size = static_cast<float>(resolution);
    return {clip_from_map * box.map_from_world, size, size, 0, 1};
}

DrawCommand skin_batch(const SkinPlan& plan, const SkinBatch& batch,
                       std::span<const WalkerInstance> instances, std::span<const JointTransform> palette,
                       const SkinView& view, SkinScratch& scratch, SkinnedVertex* vertices,
                       uint32_t* indices) {
    return HWY_DYNAMIC_DISPATCH(skin_batch_here)(plan, batch, instances, palette, view, scratch, vertices,
                                                 indices);
}

}  // namespace flaneur
#endif
