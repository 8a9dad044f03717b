#include <algorithm>
#include <cassert>
#include <optional>
#include <span>

#include "assets/outfit.h"
#include "sim/base/levels.h"
#include "sim/base/spans.h"
#include "sim/coming/passages.h"
#include "sim/without.h"
#include "sim/world.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/followers.h"
#include "tools/extract/ids.h"
#include "tools/extract/strides.h"

namespace flaneur {

namespace {

PersonVertex to_vertex(const CharacterVertex& v) {
    PersonVertex out{};
    out.position = to_glm(v.position);
    out.colour = v.colour;
    out.uv = {v.u, v.v};
    out.normal[0] = packed(v.normal.x);
    out.normal[1] = packed(v.normal.y);
    out.normal[2] = packed(v.normal.z);
    out.normal[3] = static_cast<int8_t>(v.tint);
    const bool hangs = v.hung_weights[0] > 0;
    std::ranges::copy(hangs ? v.hung_joints : v.joints, out.joints);
    std::ranges::copy(hangs ? v.hung_weights : v.weights, out.weights);
    out.texture = v.texture == CharacterVertex::k_no_texture ? ~0u : v.texture;
    return out;
}

Quat nearest_mix(Quat a, Quat b, float t) {
    float sign = dot(a, b) < 0 ? -1.0f : 1.0f;
    return normalize(Quat{lerp(a.x, sign * b.x, t), lerp(a.y, sign * b.y, t), lerp(a.z, sign * b.z, t),
                          lerp(a.w, sign * b.w, t)});
}

// From the stage onto the compound.
void set_onto_surface(const Roam& roam, const Crowd& crowd, size_t walker, float between,
                      std::span<JointPose> joints) {
    const Roam::Frame &before = roam.previous_frames[walker], &last = roam.frames[walker];
    Roam::Frame frame{lerp(before.position, last.position, between),
                      nearest_mix(before.rotation, last.rotation, between)};
    for (JointPose& joint : joints)
        joint = set_onto(frame, crowd.motion.position[walker], crowd.motion.heading[walker], joint);
}

void set_onto_surface(const Roam& roam, const Crowd& crowd, size_t walker, float between,
                      GroundPlane& plane) {
    if (plane.normal == glm::vec3(0)) return;
    JointPose pose{{plane.place.x, plane.place.y, plane.place.z}, {0, 0, 0, 1}};
    set_onto_surface(roam, crowd, walker, between, std::span(&pose, 1));
    plane = {to_glm(pose.position), to_glm(rotate(pose.rotation, {0, 1, 0}))};
}

// What a walker wears, and whoever takes its index later does not.
PeopleFrame::Outfit dress(const World& world, const Character& character, WalkerId wearer) {
    PeopleFrame::Outfit out{wearer, {}};
    const uint64_t seed = world.seed ^ static_cast<uint64_t>(wearer.generation) << 32;
    std::ranges::copy(outfit(character.person, seed, wearer.index), out.tints);
    static_assert(k_tint_count == k_tints);
    return out;
}

// Where the stick of one who has fallen is, between two ticks.
std::optional<JointPose> fallen_stick(const World& world, size_t walker, float between) {
    const LooseRod* rod = own_of(world.falls.rods, walker);
    if (!rod) return std::nullopt;
    return JointPose{lerp(rod->grip_before, rod->grip, between), rod->turn};
}

// About the hips, with what is pushed.
float body_sphere(const Character& character) {
    const float front = character.body.pram.z + k_pram_behind + k_pram_base + k_pram_front;
    const float body = k_body_sphere * character.body.height;
    if (character.body.pram == Vec3{}) return body;
    return std::max(body, length(Vec3{0.5f * k_pram_track, character.body.joints[hips].y, front}));
}

constexpr uint32_t k_no_mesh = ~0u;  // nobody is drawn
constexpr float k_walks = 0.5f;      // amplitude from which a walker is nearer to walking than to standing

}  // namespace

PersonMesh extract_character(const Character& character) {
    PersonMesh mesh;
    mesh.vertices.reserve(character.vertices.size());
    for (const CharacterVertex& v : character.vertices) mesh.vertices.push_back(to_vertex(v));
    mesh.lods = character.lods;
    for (const Texture& t : character.textures) {
        mesh.textures.push_back({static_cast<uint32_t>(t.width), static_cast<uint32_t>(t.height), t.rgba});
    }
    mesh.strides = extract_strides(character);
    return mesh;
}

void pose_character(const Character& character, float scale, const JointPose* joints, JointTransform* palette,
                    const Trail* trail, const PramPlace* pram, const JointPose* stick) {
    static_assert(k_palette_joints == k_joint_count + k_follower_count);
    auto write = [&](size_t to, const JointPose& pose, size_t bound, Vec3 place) {
        const Quat turn = pose.rotation * character.bind_to_canonical[bound];
        const Vec3 shift = pose.position - rotate(turn, place * scale);
        palette[to] = {{turn.x, turn.y, turn.z, turn.w}, {shift.x, shift.y, shift.z, 0}};
    };
    for (size_t j = 0; j < k_joint_count; ++j) write(j, joints[j], j, character.bind_joints[j]);
    if (!has_followers(character)) {
        std::fill_n(palette + k_joint_count, k_follower_count, palette[hips]);
        return;
    }
    const auto hanging = followers(character, scale, joints, trail, pram, stick);
    for (size_t f = 0; f < hanging.size(); ++f) {
        const Hung& hung = character.followers[f];
        write(k_joint_count + f, hanging[f], hung.joint, hung.place);
    }
}

GroundBelow find_ground_below(const Surroundings& around, const JointPose* joints, const PramPlace* pram) {
    constexpr float up = 0.25f, down = 2;  // metres; what is farther below is not darkened
    const Vec3 left = (joints[left_foot].position + joints[left_toes].position) * 0.5f;
    const Vec3 right = (joints[right_foot].position + joints[right_toes].position) * 0.5f;
    const Vec3 hip = joints[hips].position, low{hip.x, std::min(left.y, right.y), hip.z};
    const Vec3 points[] = {left, right, low};
    std::optional<GroundHit> hits[std::size(points)];
    ground_at(around, points, up, down, hits);
    GroundBelow out;
    GroundPlane* const planes[] = {&out.feet[0], &out.feet[1], &out.body};
    for (size_t i = 0; i < std::size(points); ++i)
        if (hits[i]) *planes[i] = {{points[i].x, hits[i]->height, points[i].z}, to_glm(hits[i]->normal)};
    if (pram) {
        const Quat turn = pram_rotation(*pram);
        out.pram = {to_glm(pram->place + rotate(turn, {0, 0, 0.5f * k_pram_base})),
                    to_glm(rotate(turn, {0, 1, 0}))};
    }
    return out;
}

void extract_people(const World& world, const std::vector<Character>& characters, PeopleFrame& frame,
                    float between, const PoseNeeds& needs, const Without* without) {
    const Crowd& crowd = world.crowd;
    const bool is_bare = without && !is_whole(*without);
    auto joint_of = [&](size_t walker, int joint) {
        return is_bare ? joint_between(*without, walker, static_cast<Joint>(joint), between)
                       : joint_between(world, walker, static_cast<Joint>(joint), between);
    };
    assert(characters.size() >= world.kinds.size());
    frame.walkers.resize(crowd.count);
    frame.outfits.resize(crowd.count);
    parallel_for(*world.workers, crowd.count, 256, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) {
            WalkerDraw& draw = frame.walkers[i];
            const auto number = static_cast<uint32_t>(i);
            if (!is_there(crowd, number) || is_creature(world.herd, number)) {
                draw = {};
                draw.mesh = k_no_mesh;
                draw.instance.palette = k_no_palette;
                continue;
            }
            const Character& character = characters[crowd.identity.body[i]];
            JointPose root = joint_of(i, hips);
            if (world.roam) set_onto_surface(*world.roam, crowd, i, between, std::span(&root, 1));
            draw.centre = to_glm(root.position);
            draw.radius = body_sphere(character) * crowd.identity.scale[i];
            draw.mesh = crowd.identity.body[i];
            draw.id = id_of(IdKind::walker, static_cast<uint32_t>(i));
            draw.is_upright = !world.roam;
            draw.instance.palette =
                draw.is_upright && !needs_pose(needs, draw.centre, draw.radius) ? k_no_palette : 0;
            draw.instance.scale = crowd.identity.scale[i];
            const WalkerId wearer{static_cast<uint32_t>(i), crowd.slots.generation[i]};
            PeopleFrame::Outfit& worn = frame.outfits[i];
            if (worn.wearer != wearer) worn = dress(world, character, wearer);
            std::ranges::copy(worn.tints, draw.instance.tints);
            const GaitBlock& gait = world.gait.blocks[i / k_block];
            draw.heading = gait.heading[i % k_block];
            draw.presence = 255;
            draw.phase = gait.amplitude[i % k_block] > k_walks ? gait.phase[i % k_block] : -1;
        }
    });
    for (const Passage& passage : crowd.passages)
        frame.walkers[passage.walker].presence =
            static_cast<uint8_t>(255 * presence(passage, between) + 0.5f);
    frame.posed.clear();
    for (uint32_t i = 0; i < crowd.count; ++i) {
        uint32_t& first = frame.walkers[i].instance.palette;
        if (first == k_no_palette) continue;
        first = static_cast<uint32_t>(frame.posed.size()) * k_palette_joints;
        frame.posed.push_back(i);
    }
    frame.palette.resize(frame.posed.size() * k_palette_joints);
    frame.grounds.resize(frame.posed.size());
    parallel_for(*world.workers, frame.posed.size(), 32, [&](size_t begin, size_t end, int) {
        for (size_t p = begin; p < end; ++p) {
            const uint32_t i = frame.posed[p];
            JointPose joints[k_joint_count];
            for (int j = 0; j < k_joint_count; ++j) joints[j] = joint_of(i, j);
            const Trail trail = trail_between(world, i, between);
            const std::optional<PramPlace> pram = pram_between(world, i, between);
            const std::optional<JointPose> stick = fallen_stick(world, i, between);
            GroundBelow& ground_below = frame.grounds[p] =
                find_ground_below(world.around, joints, pram && !world.roam ? &*pram : nullptr);
            // Over the edges of treads a wide spot would hang in the air.
            if (world.gait.blocks[i / k_block].tread[i % k_block] > 0) ground_below.body = {};
            if (world.roam) {
                bend_in_leap(*world.roam, i, between, joints);
                set_onto_surface(*world.roam, crowd, i, between, joints);
                for (GroundPlane* plane : {&ground_below.feet[0], &ground_below.feet[1], &ground_below.body})
                    set_onto_surface(*world.roam, crowd, i, between, *plane);
            }
            // Trails do not know how a surface moves under its stage.
            pose_character(characters[crowd.identity.body[i]], crowd.identity.scale[i], joints,
                           &frame.palette[p * k_palette_joints], world.roam ? nullptr : &trail,
                           pram && !world.roam ? &*pram : nullptr, stick ? &*stick : nullptr);
        }
    });
}

}  // namespace flaneur
