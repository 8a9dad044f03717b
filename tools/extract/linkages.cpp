// Linkages as skinned meshes: each bone, and each target, is a solid of revolution that moves with a joint of
// its own.
#include <algorithm>
#include <vector>

#include "assets/colour.h"
#include "sim/base/math.h"
#include "sim/world.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"
#include "tools/extract/turned.h"

namespace flaneur {

namespace {

constexpr float k_target = 0.05f;  // metres, radius, at least
constexpr uint32_t k_colours[] = {rgb(0x3f7fa6), rgb(0xc9603f), rgb(0x7a9a3c), rgb(0xc59a2e),
                                  rgb(0x6d5aa8), rgb(0x2f9189), rgb(0xc98f6a), rgb(0xd8a98a),
                                  rgb(0x5d6f86), rgb(0xa8496b), rgb(0x7c6144)};
constexpr uint32_t k_target_colour = rgb(0xe8402f);

// Bone j, from its parent to joint j, or target e.
struct Part {
    bool is_target;
    uint32_t number;
};
// Bones first, then targets.
size_t part_count(const Linkage& f) { return f.rest.size() + f.leads.size(); }
Part part_of(const Linkage& f, size_t p) {
    const size_t bones = f.rest.size();
    return {p >= bones, static_cast<uint32_t>(p < bones ? p : p - bones)};
}

// So that it is seen round the end that has come there.
float target_radius(const Linkage& f, uint32_t target) {
    const auto joint = static_cast<size_t>(std::ranges::find(f.shape.effectors, static_cast<int>(target)) -
                                           f.shape.effectors.begin());
    return std::max(k_target, 1.05f * f.girth[joint]);
}

void add_ball_rings(std::vector<TurnedRing>& rings, float radius, float middle, float from, float to,
                    uint32_t colour) {
    constexpr int k_rings = 6;
    for (int k = 0; k <= k_rings; ++k) {
        const SinCos at = sin_cos(lerp(from, to, static_cast<float>(k) / k_rings));
        rings.push_back({radius * at.cosine, middle + radius * at.sine, colour});
    }
}

void add_part(PersonMesh& mesh, const Linkage& f, const Part& part, uint32_t colour, uint8_t joint) {
    constexpr float k_quarter = k_pi / 2, k_knuckle = 1.2f, k_end = 0.8f;  // of the girth
    std::vector<TurnedRing> rings;
    if (part.is_target) {
        add_ball_rings(rings, target_radius(f, part.number), 0, -k_quarter, k_quarter, k_target_colour);
    } else if (part.number == 0) {
        add_ball_rings(rings, 1.35f * f.girth[0], 0, -k_quarter, k_quarter, shaded(colour, 0.75f));
    } else {
        const float girth = f.girth[part.number], bone = f.bones[part.number];
        add_ball_rings(rings, k_knuckle * girth, 0, -k_quarter, 0.6f, shaded(colour, 0.75f));
        rings.push_back({girth, rings.back().height, colour});
        add_ball_rings(rings, k_end * girth, bone, 0, k_quarter, colour);
    }
    add_turned(mesh, rings, joint);
}

}  // namespace

std::vector<PersonMesh> extract_linkages(const Linkages& linkages) {
    std::vector<PersonMesh> meshes;
    for (size_t i = 0; i < linkages.all.size(); ++i) {
        const Linkage& f = linkages.all[i];
        for (size_t p = 0; p < part_count(f); ++p) {
            if (p % k_palette_joints == 0) {
                meshes.emplace_back().lods.resize(1);
                meshes.back().is_thing = true;
            }
            add_part(meshes.back(), f, part_of(f, p), k_colours[i % std::size(k_colours)],
                     static_cast<uint8_t>(p % k_palette_joints));
        }
    }
    return meshes;
}

void add_linkages(const Linkages& linkages, uint32_t first_mesh, PeopleFrame& frame, float between,
                  uint32_t first_id) {
    uint32_t mesh = first_mesh;
    for (size_t i = 0; i < linkages.all.size(); ++i) {
        const Linkage& f = linkages.all[i];
        const uint32_t joints = linkages.ranges[i].joints, targets = linkages.ranges[i].targets;
        auto joint_at = [&](size_t j) {
            return lerp(linkages.previous_places[joints + j], linkages.places[joints + j], between);
        };
        auto target_at = [&](size_t e) {
            return lerp(linkages.previous_targets[targets + e], linkages.targets[targets + e], between);
        };
        // Where the part is, and where its own +y points.
        auto place = [&](const Part& part) -> std::pair<Vec3, Vec3> {
            if (part.is_target) return {target_at(part.number), {0, 1, 0}};
            if (part.number == 0) return {joint_at(0), {0, 1, 0}};
            const Vec3 from = joint_at(static_cast<size_t>(f.shape.parents[part.number]));
            return {from, normalize_or(joint_at(part.number) - from, {0, 1, 0})};
        };
        for (size_t first = 0; first < part_count(f); first += k_palette_joints, ++mesh) {
            const size_t end = std::min(first + k_palette_joints, part_count(f));
            const auto number = static_cast<uint32_t>(i);
            const uint32_t id = f.kind == Linkage::Kind::led ? id_of(IdKind::creature, number)
                                                             : id_of(IdKind::exhibit, first_id + number);
            WalkerDraw draw = thing_to_draw(frame, mesh, id, {}, 0);
            Vec3 low = place(part_of(f, first)).first, high = low;
            float longest = k_target;
            for (size_t p = first; p < end; ++p) {
                const Part part = part_of(f, p);
                const auto [at, up] = place(part);
                low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
                high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
                longest = std::max(longest, part.is_target ? target_radius(f, part.number)
                                                           : f.bones[part.number] + 2 * f.girth[part.number]);
                frame.palette.push_back(transform_of(at, rotation_between({0, 1, 0}, up)));
            }
            frame.palette.resize(draw.instance.palette + k_palette_joints, frame.palette.back());
            draw.centre = to_glm((low + high) * 0.5f);
            draw.radius = 0.5f * length(high - low) + longest;
            frame.walkers.push_back(draw);
        }
    }
}

}  // namespace flaneur
