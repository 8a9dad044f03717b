#include "renderer/visible/cull.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flaneur {
namespace {

bool has_joints(const WalkerDraw& walker) { return walker.instance.palette != k_no_palette; }

bool has_impostors(const CrowdInput& input, const WalkerDraw& walker) {
    return walker.is_upright && input.people[walker.mesh].first_cell != PersonRanges::k_no_cell;
}

ImpostorInstance impostor_of(const WalkerDraw& walker, uint32_t first_cell) {
    const float phase = walker.phase - std::floor(walker.phase);
    int pose = k_stride_phases;
    if (walker.phase >= 0 && phase < 1)
        pose = static_cast<int>(phase * k_stride_phases + 0.5f) % k_stride_phases;
    ImpostorInstance out{};
    out.place = glm::vec4(walker.centre, walker.instance.scale);
    out.heading = walker.heading;
    out.first_cell = first_cell + static_cast<uint32_t>(pose * k_impostor_views);
    std::copy(std::begin(walker.instance.tints), std::end(walker.instance.tints), std::begin(out.tints));
    return out;
}

// The pixels of a square of 4x4 that are the first ones hidden, so that those left are spread evenly.
uint16_t first_hidden(int count) {
    constexpr uint8_t order[16] = {0, 10, 2, 8, 5, 15, 7, 13, 1, 11, 3, 9, 4, 14, 6, 12};  // Bayer's
    uint32_t hidden = 0;
    for (int i = 0; i < count; ++i) hidden |= 1u << order[i];
    return static_cast<uint16_t>(hidden);
}

// The pixels in which one who is only partly there is not seen.
uint16_t absent(const WalkerDraw& walker) { return first_hidden((255 - walker.presence) * 17 / 256); }

// A stable counting sort of the walkers by `levels_of(walker)`, which is asked on every thread: how many of
// each bucket come before a chunk says where its own go.
template <class LevelsOf>
void sort_into_draws(const CrowdInput& input, CrowdDraws& out, LevelsOf&& levels_of) {
    const size_t mesh_count = input.people.size(), bucket_count = mesh_count * k_max_lods;
    const size_t impostors = bucket_count, columns = bucket_count + 1, count = input.walkers.size();
    const size_t chunks = chunk_count(input);
    auto bucket_of = [&](const WalkerDraw& walker, uint8_t level) {
        return level == k_impostor_level ? impostors : level * mesh_count + walker.mesh;
    };
    out.levels.resize(count);
    out.firsts.assign(chunks * columns, 0);
    out.draws.clear();
    out.triangles = 0;
    in_chunks(input, [&](size_t chunk, size_t begin, size_t end) {
        uint32_t* counts = &out.firsts[chunk * columns];
        for (size_t i = begin; i < end; ++i) {
            const WalkerDraw& walker = input.walkers[i];
            Levels& levels = out.levels[i];
            levels = is_drawable(input, walker) && absent(walker) != 0xffff ? levels_of(walker) : Levels{};
            if (levels.fine == k_unseen) continue;
            ++counts[bucket_of(walker, levels.fine)];
            if (levels.coarse != levels.fine) ++counts[bucket_of(walker, levels.coarse)];
        }
    });
    uint32_t total = 0, drawn = 0;
    for (size_t bucket = 0; bucket < columns; ++bucket) {
        const uint32_t first = total;
        for (size_t chunk = 0; chunk < chunks; ++chunk)
            total += std::exchange(out.firsts[chunk * columns + bucket], total);
        if (bucket == impostors || total == first) continue;
        drawn = total;
        const PersonRanges& person = input.people[bucket % mesh_count];
        const MeshRange& range = person.lods[bucket / mesh_count];
        out.draws.push_back(
            {range.index_count, total - first, range.first_index, person.vertex_offset, first});
        out.triangles += range.index_count / 3 * (total - first);
    }
    out.triangles += 2 * (total - drawn);
    out.instances.resize(drawn);
    out.impostors.resize(total - drawn);
    out.spheres.resize(total);
    in_chunks(input, [&](size_t chunk, size_t begin, size_t end) {
        uint32_t* next = &out.firsts[chunk * columns];
        for (size_t i = begin; i < end; ++i) {
            const WalkerDraw& walker = input.walkers[i];
            const Levels levels = out.levels[i];
            auto put = [&](uint8_t level, uint16_t hidden) {
                const size_t bucket = bucket_of(walker, level);
                const uint32_t at = next[bucket]++;
                out.spheres[at] = glm::vec4(walker.centre, walker.radius);
                if (bucket == impostors) {
                    out.impostors[at - drawn] = impostor_of(walker, input.people[walker.mesh].first_cell);
                    out.impostors[at - drawn].hidden = hidden;
                } else {
                    out.instances[at] = walker.instance;
                    out.instances[at].hidden = hidden;
                }
            };
            if (levels.fine == k_unseen) continue;
            const uint16_t never = absent(walker);
            put(levels.fine, levels.hidden | never);
            if (levels.coarse != levels.fine)
                put(levels.coarse, static_cast<uint16_t>(~levels.hidden | never));
        }
    });
}

// Appends what there is to draw; returns how many draws that is.
uint32_t append_draw(const MeshRange& range, std::vector<DrawCommand>& draws) {
    if (range.index_count == 0) return 0;
    draws.push_back({range.index_count, 1, range.first_index, 0, 0});
    return 1;
}

uint32_t lod_of(float pixels) {
    uint32_t lod = 0;
    while (lod < k_max_lods - 1 && !(pixels >= k_level_pixels[lod])) ++lod;
    return lod;
}

bool is_impostor(const CrowdInput& input, const WalkerDraw& walker, float pixels) {
    return has_impostors(input, walker) && !(has_joints(walker) && pixels >= input.impostor_pixels);
}

// Who fills as much of the picture as this eye's companion does is seen longest: a little finer than others.
constexpr float k_companion = 1.15f;

constexpr uint8_t k_casts = 128;  // presence from which on one throws a shadow, all of it

// All by one level.
Levels whole(const CrowdInput& input, const WalkerDraw& walker, uint32_t level) {
    if (level != k_impostor_level)
        level = std::min(level, static_cast<uint32_t>(input.people[walker.mesh].lods.size() - 1));
    return {static_cast<uint8_t>(level), static_cast<uint8_t>(level), 0};
}

Levels levels_at(const CrowdInput& input, const WalkerDraw& walker, float pixels) {
    auto level_at = [&](float size) {
        return is_impostor(input, walker, size) ? k_impostor_level : lod_of(size);
    };
    const Levels fine = whole(input, walker, level_at(pixels / (1 - k_turns)));
    const uint32_t next = level_at(pixels / (1 + k_turns));
    const Levels coarse = whole(input, walker, next);
    if (fine.fine == coarse.fine) return fine;
    const float border = next == k_impostor_level ? input.impostor_pixels : k_level_pixels[next - 1];
    const float hidden = 17 * (0.5f + (border - pixels) / (2 * k_turns * border));  // of 16 pixels
    if (!(hidden >= 1)) return fine;
    if (hidden >= 16) return coarse;
    return {fine.fine, coarse.fine, first_hidden(static_cast<int>(hidden))};
}

bool is_sphere_hidden(const CrowdInput& input, const View& view, glm::vec3 centre, float radius) {
    return input.hidden && is_hidden(*input.hidden, view, centre - radius, centre + radius);
}

}  // namespace

bool is_drawable(const CrowdInput& input, const WalkerDraw& walker) {
    if (walker.mesh >= input.people.size() || input.people[walker.mesh].lods.empty()) return false;
    if (!has_joints(walker)) return has_impostors(input, walker);
    return uint64_t{walker.instance.palette} + k_palette_joints <= input.palette_size;
}

glm::vec3 moved_by(const JointTransform& joint, glm::vec3 v) {
    const glm::vec3 u(joint.rotation);
    const glm::vec3 t = 2.0f * glm::cross(u, v);
    return v + joint.rotation.w * t + glm::cross(u, t) + glm::vec3(joint.translation);
}

// Whether the eye is within a standing body, of which only shards beyond the near plane would be seen.
static bool is_eye_inside(const View& view, const WalkerDraw& walker) {
    constexpr float k_girth = 0.4f;  // share of the radius
    const glm::vec3 away = view.eye - walker.centre;
    return std::sqrt(away.x * away.x + away.z * away.z) < k_girth * walker.radius &&
           std::fabs(away.y) < walker.radius;
}

void cull_crowd(const CrowdInput& input, const View& view, CrowdDraws& out) {
    sort_into_draws(input, out, [&](const WalkerDraw& walker) -> Levels {
        if (!sees_sphere(view, walker.centre, walker.radius) || is_eye_inside(view, walker) ||
            is_sphere_hidden(input, view, walker.centre, walker.radius))
            return {};
        if (input.is_finest && has_joints(walker)) return whole(input, walker, 0);
        const float pixels = pixels_of(view, walker.centre, walker.radius);
        const bool is_companion = input.companion < input.walkers.size() &&
                                  &walker == &input.walkers[input.companion] && has_joints(walker);
        return is_companion ? whole(input, walker, lod_of(k_companion * pixels))
                            : levels_at(input, walker, pixels);
    });
}

void cull_shadow_casters(const CrowdInput& input, const View& view, const ShadowBox& box, glm::vec3 to_sun,
                         float reach, CrowdDraws& out) {
    sort_into_draws(input, out, [&](const WalkerDraw& walker) -> Levels {
        if (walker.presence < k_casts || !(glm::length(walker.centre - view.eye) <= reach) ||
            !casts_into(box, walker.centre, walker.radius))
            return {};
        const BodySphere both = with_shadow(walker.centre, walker.radius, to_sun);
        if (!sees_sphere(view, both.centre, both.radius) ||
            is_sphere_hidden(input, view, both.centre, both.radius))
            return {};
        const float pixels = pixels_of(view, walker.centre, walker.radius);
        // Only of those that are seen as nothing but impostors: a mesh would be shaded by the picture in its
        // middle.
        if (is_impostor(input, walker, pixels / (1 - k_turns))) return whole(input, walker, k_impostor_level);
        const uint32_t in_texels = lod_of(2 * walker.radius / box.texel);
        return whole(input, walker, std::max(in_texels, std::min(lod_of(pixels) + 1, k_max_lods - 1)));
    });
}

uint32_t cull_chunks(std::span<const CityChunk> chunks, const View& view, const OcclusionMap& hidden,
                     std::vector<DrawCommand>& draws) {
    std::vector<std::pair<float, uint32_t>> order;
    for (uint32_t i = 0; i < chunks.size(); ++i) {
        if (!sees_box(view, chunks[i].low, chunks[i].high) ||
            is_hidden(hidden, view, chunks[i].low, chunks[i].high))
            continue;
        const glm::vec3 nearest = glm::clamp(view.eye, chunks[i].low, chunks[i].high) - view.eye;
        order.emplace_back(glm::dot(nearest, nearest), i);
    }
    std::sort(order.begin(), order.end());
    uint32_t count = 0;
    for (const auto& [distance, i] : order) {
        const bool is_near = view.pixels_at_one_metre >= k_fine_pixels * std::sqrt(distance);
        count += append_draw(is_near ? chunks[i].near : chunks[i].far, draws);
    }
    return count;
}

uint32_t cull_chunk_casters(std::span<const CityChunk> chunks, const ShadowBox& box, bool is_near,
                            std::vector<DrawCommand>& draws) {
    uint32_t count = 0;
    for (const CityChunk& chunk : chunks)
        if (casts_into(box, chunk.low, chunk.high))
            count += append_draw(is_near ? chunk.near : chunk.far, draws);
    return count;
}

}  // namespace flaneur
