#include "renderer/passes/cull.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flaneur {
namespace {

constexpr uint16_t k_no_bucket = 0xffff;
constexpr float k_least_tan_elevation = 0.1f;  // shadows are not followed farther than ten times the body

bool has_joints(const WalkerDraw& walker) { return walker.instance.palette != k_no_palette; }

bool has_impostors(const CrowdInput& input, const WalkerDraw& walker) {
    return walker.is_upright && input.people[walker.mesh].first_cell != PersonRanges::k_no_cell;
}

bool is_drawable(const CrowdInput& input, const WalkerDraw& walker) {
    if (walker.mesh >= input.people.size() || input.people[walker.mesh].lods.empty()) return false;
    if (!has_joints(walker)) return has_impostors(input, walker);
    return uint64_t{walker.instance.palette} + k_palette_joints <= input.palette_size;
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

// A stable counting sort of the walkers by `level_of(walker, number)` (k_unseen: left out).
template <class LevelOf>
void sort_into_draws(const CrowdInput& input, CrowdDraws& out, LevelOf&& level_of) {
    const size_t mesh_count = input.people.size(), bucket_count = mesh_count * k_max_lods;
    out.buckets.assign(input.walkers.size(), k_no_bucket);
    out.firsts.assign(bucket_count + 1, 0);
    out.draws.clear();
    out.impostors.clear();
    out.triangles = 0;
    for (size_t i = 0; i < input.walkers.size(); ++i) {
        const WalkerDraw& walker = input.walkers[i];
        if (!is_drawable(input, walker)) continue;
        const uint32_t wanted = level_of(walker, i);
        if (wanted == k_unseen) continue;
        const PersonRanges& person = input.people[walker.mesh];
        if (wanted == k_impostor_level) {
            out.impostors.push_back(impostor_of(walker, person.first_cell));
            continue;
        }
        const size_t level = std::min<size_t>(wanted, person.lods.size() - 1);
        const size_t bucket = level * mesh_count + walker.mesh;
        out.buckets[i] = static_cast<uint16_t>(bucket);
        ++out.firsts[bucket + 1];
    }
    for (size_t bucket = 0; bucket < bucket_count; ++bucket) {
        const uint32_t count = out.firsts[bucket + 1];
        out.firsts[bucket + 1] += out.firsts[bucket];
        if (count == 0) continue;
        const PersonRanges& person = input.people[bucket % mesh_count];
        const size_t level = bucket / mesh_count;
        const MeshRange& range = person.lods[level];
        out.draws.push_back(
            {range.index_count, count, range.first_index, person.vertex_offset, out.firsts[bucket]});
        out.triangles += range.index_count / 3 * count;
    }
    out.triangles += static_cast<uint32_t>(2 * out.impostors.size());
    out.instances.resize(out.firsts[bucket_count]);
    for (size_t i = 0; i < input.walkers.size(); ++i)
        if (out.buckets[i] != k_no_bucket)
            out.instances[out.firsts[out.buckets[i]]++] = input.walkers[i].instance;
}

// Appends what there is to draw; returns how many draws that is.
uint32_t append_draw(const MeshRange& range, std::vector<DrawCommand>& draws) {
    if (range.index_count == 0) return 0;
    draws.push_back({range.index_count, 1, range.first_index, 0, 0});
    return 1;
}

// How many pixels high a sphere is seen.
float pixels_of(const View& view, glm::vec3 centre, float radius) {
    return 2 * radius * view.pixels_at_one_metre / glm::length(centre - view.eye);
}

uint32_t lod_of(float pixels) {
    uint32_t lod = 0;
    while (lod < k_max_lods - 1 && !(pixels >= k_lod_pixels[lod])) ++lod;
    return lod;
}

bool is_impostor(const CrowdInput& input, const WalkerDraw& walker, float pixels) {
    return has_impostors(input, walker) && !(has_joints(walker) && pixels >= input.impostor_pixels);
}

bool is_sphere_hidden(const CrowdInput& input, const View& view, glm::vec3 centre, float radius) {
    return input.hidden && is_hidden(*input.hidden, view, centre - radius, centre + radius);
}

struct Sphere {
    glm::vec3 centre;
    float radius;
};

// About the middle of a body and its shadow on the ground, both within it.
Sphere with_shadow(glm::vec3 centre, float radius, glm::vec3 to_sun) {
    const float across = std::sqrt(to_sun.x * to_sun.x + to_sun.z * to_sun.z);
    const float fall = 2 * radius / std::max(to_sun.y / std::max(across, 1e-3f), k_least_tan_elevation);
    return {centre - glm::vec3(to_sun.x, 0, to_sun.z) * (fall / 2), radius + fall / 2};
}

}  // namespace

bool needs_pose(const PoseNeeds& needs, glm::vec3 centre, float radius) {
    if (!(pixels_of(needs.view, centre, radius) >= needs.pixels)) return false;
    const Sphere both = with_shadow(centre, radius, needs.to_sun);
    return sees_sphere(needs.view, both.centre, both.radius);
}

glm::vec3 moved_by(const JointTransform& joint, glm::vec3 v) {
    const glm::vec3 u(joint.rotation);
    const glm::vec3 t = 2.0f * glm::cross(u, v);
    return v + joint.rotation.w * t + glm::cross(u, t) + glm::vec3(joint.translation);
}

uint32_t lod_of(const View& view, glm::vec3 centre, float radius) {
    return lod_of(pixels_of(view, centre, radius));
}

// Whether the eye is within a standing body, of which only shards beyond the near plane would be seen.
static bool is_eye_inside(const View& view, const WalkerDraw& walker) {
    constexpr float k_girth = 0.4f;  // share of the radius
    const glm::vec3 away = view.eye - walker.centre;
    return std::sqrt(away.x * away.x + away.z * away.z) < k_girth * walker.radius &&
           std::fabs(away.y) < walker.radius;
}

void cull_crowd(const CrowdInput& input, const View& view, CrowdDraws& out) {
    out.levels.resize(input.walkers.size(), k_unseen);
    sort_into_draws(input, out, [&](const WalkerDraw& walker, size_t i) -> uint32_t {
        const uint8_t before = std::exchange(out.levels[i], k_unseen);
        if (!sees_sphere(view, walker.centre, walker.radius) || is_eye_inside(view, walker) ||
            is_sphere_hidden(input, view, walker.centre, walker.radius))
            return k_unseen;
        if (input.is_finest && has_joints(walker)) return 0;
        auto level_at = [&](float pixels) {
            return is_impostor(input, walker, pixels) ? k_impostor_level : lod_of(pixels);
        };
        const float pixels = pixels_of(view, walker.centre, walker.radius);
        uint32_t level = level_at(pixels);
        if (before != k_unseen)
            level = std::clamp<uint32_t>(before, level_at(pixels * k_lod_hysteresis),
                                         level_at(pixels / k_lod_hysteresis));
        out.levels[i] = static_cast<uint8_t>(level);
        return level;
    });
}

void cull_shadow_casters(const CrowdInput& input, const View& view, const ShadowBox& box, glm::vec3 to_sun,
                         float reach, CrowdDraws& out) {
    sort_into_draws(input, out, [&](const WalkerDraw& walker, size_t) -> uint32_t {
        if (!(glm::length(walker.centre - view.eye) <= reach) ||
            !casts_into(box, walker.centre, walker.radius))
            return k_unseen;
        const Sphere both = with_shadow(walker.centre, walker.radius, to_sun);
        if (!sees_sphere(view, both.centre, both.radius) ||
            is_sphere_hidden(input, view, both.centre, both.radius))
            return k_unseen;
        const float pixels = pixels_of(view, walker.centre, walker.radius);
        // Only of those that are sure to be seen as impostors: a mesh would be shaded by the picture in its
        // middle.
        if (is_impostor(input, walker, pixels * k_lod_hysteresis)) return k_impostor_level;
        return std::min(lod_of(pixels) + 1, k_max_lods - 1);
    });
}

void find_contacts(const CrowdInput& input, std::span<const JointTransform> palette, const View& view,
                   std::vector<Contact>& contacts) {
    constexpr float foot_radius = 0.19f, body_radius = 0.55f;
    constexpr float foot_strength = 0.55f, body_strength = 0.28f;
    constexpr float lifted = 0.12f;  // a foot this high above the other leaves no spot, metres
    constexpr float gone = k_least_contact, whole = 48;  // pixels between which spots fade in
    contacts.clear();
    for (const WalkerDraw& walker : input.walkers) {
        if (!walker.is_upright || !has_joints(walker) || !is_drawable(input, walker) ||
            !sees_sphere(view, walker.centre, walker.radius))
            continue;
        const float size = pixels_of(view, walker.centre, walker.radius);
        const float shown = std::clamp((size - gone) / (whole - gone), 0.0f, 1.0f);
        if (!(shown > 0)) continue;
        const PersonRanges& person = input.people[walker.mesh];
        const JointTransform* joints = &palette[walker.instance.palette];
        const float scale = walker.instance.scale;
        const glm::vec3 left = moved_by(joints[k_left_foot], person.soles[0] * scale);
        const glm::vec3 right = moved_by(joints[k_right_foot], person.soles[1] * scale);
        const float ground = std::min(left.y, right.y);
        for (const glm::vec3& sole : {left, right}) {
            const float near = 1 - (sole.y - ground) / (lifted * scale);
            if (near > 0)
                contacts.push_back(
                    {{sole.x, ground, sole.z}, foot_radius * scale, foot_strength * near * shown});
        }
        const glm::vec3 middle = (left + right) * 0.5f;
        contacts.push_back({{middle.x, ground, middle.z}, body_radius * scale, body_strength * shown});
    }
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
