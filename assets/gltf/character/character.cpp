#include "assets/gltf/character/character.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/cache/levels_cache.h"
#include "assets/gltf/character/bake.h"
#include "assets/gltf/character/body.h"
#include "assets/people/skin.h"

namespace flaneur {

namespace {

constexpr float k_low_height = 0.9f, k_high_height = 2.2f, k_usual_height = 1.7f;

// From the file's axes and units to metres, +y up, facing +z, standing on 0 above the middle of the ankles.
struct Canon {
    Vec3 left, up, ahead, origin;
    float scale;
    Vec3 direction(Vec3 v) const { return {dot(v, left), dot(v, up), dot(v, ahead)}; }
    Vec3 place(Vec3 p) const { return direction(p - origin) * scale; }
};

std::string rounded(float v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", double(v));
    return text;
}

Canon make_canon(const BakedMesh& mesh, const RigMap& map, const std::vector<uint8_t>& in_hand,
                 std::vector<std::string>& notes) {
    Canon c{map.left, map.up, map.ahead, {}, 1};
    float low = 1e30f, high = -1e30f;
    for (uint32_t i : mesh.indices) {
        if (in_hand[i]) continue;  // a raised sword makes nobody taller
        float level = dot(mesh.vertices[i].position, map.up);
        low = std::min(low, level);
        high = std::max(high, level);
    }
    float height = std::max(high - low, 1e-9f);
    auto sensible = [](float metres) { return metres >= k_low_height && metres <= k_high_height; };
    if (!sensible(height)) {
        bool centimetres = sensible(height * 0.01f);
        c.scale = centimetres ? 0.01f : k_usual_height / height;
        notes.push_back("It stands " + rounded(height) + " units tall; " +
                        (centimetres ? "taken for centimetres." : "scaled to 1.7 m."));
    }
    Vec3 feet =
        (mesh.rig[size_t(map.joints[left_foot])].place + mesh.rig[size_t(map.joints[right_foot])].place) *
        0.5f;
    c.origin = feet + map.up * (low - dot(feet, map.up));
    return c;
}

using Places = std::array<Vec3, k_joint_count>;

// Of what has neither arms nor a head: where people have them between hips and crown.
void place_as_usual(const BakedMesh& mesh, const RigMap& map, const Canon& canon, Places& p) {
    Body usual = standard_body(k_usual_height);
    float top = 0;
    for (uint32_t i : mesh.indices) top = std::max(top, canon.place(mesh.vertices[i].position).y);
    Vec3 hip = (p[left_upper_leg] + p[right_upper_leg]) * 0.5f;
    float usual_hip = usual.joints[left_upper_leg].y;
    float scale = std::max(top - hip.y, 0.1f * k_usual_height) / (usual.height - usual_hip);
    for (size_t j = hips; j < left_upper_leg; ++j)
        if (map.joints[j] == k_not_found) p[j] = hip + (usual.joints[j] - Vec3{0, usual_hip, 0}) * scale;
}

// Joints that the file lacks, placed by the proportions of those it has.
Places fill_places(const BakedMesh& mesh, const RigMap& map, const Canon& canon) {
    Places p{};
    auto has = [&](int j) { return map.joints[size_t(j)] != k_not_found; };
    for (int j = 0; j < k_joint_count; ++j)
        if (has(j)) p[size_t(j)] = canon.place(mesh.rig[size_t(map.joints[size_t(j)])].place);
    if (!has(head)) return place_as_usual(mesh, map, canon, p), p;
    Vec3 hip_middle = (p[left_upper_leg] + p[right_upper_leg]) * 0.5f;
    Vec3 shoulder_middle = (p[left_upper_arm] + p[right_upper_arm]) * 0.5f;
    if (!has(hips)) p[hips] = lerp(hip_middle, shoulder_middle, 0.04f);
    if (!has(neck)) p[neck] = lerp(shoulder_middle, p[head], 0.35f);
    // The trunk's missing joints stand evenly between those it has.
    constexpr std::array<int, 5> k_trunk = {hips, spine, chest, upper_chest, neck};
    for (size_t n = 1; n < 4; ++n) {
        if (has(k_trunk[n])) continue;
        size_t above = n + 1;
        while (above < 4 && !has(k_trunk[above])) ++above;
        p[size_t(k_trunk[n])] =
            lerp(p[size_t(k_trunk[n - 1])], p[size_t(k_trunk[above])], 1.0f / float(above - n + 1));
    }
    // A wrist that the file lacks is as far down its forearm as the other.
    for (int side : {0, right_shoulder - left_shoulder}) {
        auto elbow = size_t(left_lower_arm + side), wrist = elbow + 1;
        if (has(int(wrist))) continue;
        size_t other = size_t(left_lower_arm + right_lower_arm) - elbow;
        const RigJoint& bone = mesh.rig[size_t(map.joints[elbow])];
        Vec3 along = normalize_or(canon.direction(bone.flesh - bone.place), p[elbow] - p[elbow - 1]);
        p[wrist] = p[elbow] + along * length(p[other + 1] - p[other]);
    }
    for (int side : {0, right_shoulder - left_shoulder})
        if (!has(left_shoulder + side)) {
            Vec3 joint = p[size_t(left_upper_arm + side)];
            p[size_t(left_shoulder + side)] = lerp({p[upper_chest].x, joint.y, joint.z}, joint, 0.2f);
        }
    return p;
}

// By vertex: the rig's joint that moves it most.
std::vector<int> most_moved_by(const BakedMesh& mesh) {
    std::vector<int> by;
    for (const auto& influences : mesh.influences)
        by.push_back(std::max_element(influences.begin(), influences.end(), [](auto& a, auto& b) {
                         return a.second < b.second;
                     })->first);
    return by;
}

// Loose things are held as they are at rest, however far away they were bound.
void bring_loose(const GltfScene& scene, const RigMap& map, BakedMesh& mesh) {
    auto at_rest = [&](int joint) -> const Affine& {
        return scene.nodes[size_t(mesh.nodes[size_t(joint)])].world;
    };
    std::vector<int> moved_by = most_moved_by(mesh);
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
        int thing = moved_by[v], holder = map.joints[map.carried_by[size_t(thing)]];
        if (!map.loose[size_t(thing)] || holder == k_not_found || mesh.rig[size_t(holder)].made_up) continue;
        const Affine& bound = mesh.binds[size_t(thing)];
        if (!invertible(at_rest(holder)) || !invertible(bound)) continue;
        Affine moved =
            mesh.binds[size_t(holder)] * inverse(at_rest(holder)) * at_rest(thing) * inverse(bound);
        CharacterVertex& vertex = mesh.vertices[v];
        vertex.position = transform(moved, vertex.position);
        vertex.normal = normalize_or(rotate_scale(moved, vertex.normal), vertex.normal);
    }
}

// By vertex: 1 where it is of a thing that hangs from a bone, or whose joint below a hand reaches farther
// than fingers do.
std::vector<uint8_t> held_things(const BakedMesh& mesh, const RigMap& map, const Character& c) {
    std::vector<int> moved_by = most_moved_by(mesh);
    std::vector<uint8_t> held = mesh.rigid, far(mesh.rig.size(), 0);
    for (size_t v = 0; v < c.vertices.size(); ++v) {
        size_t hand = c.vertices[v].joints[0];
        if ((hand != left_hand && hand != right_hand) || moved_by[v] == map.joints[hand]) continue;
        float forearm = length(c.bind_joints[hand] - c.bind_joints[hand - 1]);
        float fingers = std::max(1.1f * forearm, 0.14f * c.bind_joints[head].y);
        if (length(c.vertices[v].position - c.bind_joints[hand]) > fingers) far[size_t(moved_by[v])] = 1;
    }
    for (size_t v = 0; v < held.size(); ++v) held[v] |= far[size_t(moved_by[v])];
    return held;
}

std::string file_name(const std::string& path) {
    size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
    size_t begin = slash == std::string::npos ? 0 : slash + 1;
    return path.substr(begin, dot == std::string::npos || dot < begin ? std::string::npos : dot - begin);
}

bool is_made_up(const BakedMesh& mesh, const RigMap& map, size_t joint) {
    int rig = map.joints[joint];
    return rig == k_not_found || mesh.rig[size_t(rig)].made_up;
}

// "left upper arm".
std::string plain_name(size_t joint) {
    std::string name(k_joint_names[joint]);
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

Result<Character> assemble(BakedMesh mesh, const RigMap& map, float& scale) {
    Character c;
    c.notes = std::move(mesh.notes);
    c.notes.insert(c.notes.end(), map.notes.begin(), map.notes.end());
    const std::vector<uint8_t>& joint_of = map.carried_by;
    std::vector<uint8_t> in_hand;
    for (const auto& influences : mesh.influences) {
        int joint = joint_of[size_t(influences[0].first)];
        in_hand.push_back(joint == left_hand || joint == right_hand);
    }
    Canon canon = make_canon(mesh, map, in_hand, c.notes);
    scale = canon.scale;
    c.bind_joints = fill_places(mesh, map, canon);
    c.vertices = std::move(mesh.vertices);
    for (size_t v = 0; v < c.vertices.size(); ++v) {
        c.vertices[v].position = canon.place(c.vertices[v].position);
        c.vertices[v].normal = canon.direction(c.vertices[v].normal);
        std::array<float, k_joint_count> weights{};
        for (auto [joint, weight] : mesh.influences[v]) weights[joint_of[size_t(joint)]] += weight;
        pack_weights(weights, c.vertices[v]);
    }
    c.lods.push_back(std::move(mesh.indices));

    std::string missing;
    for (size_t j = 0; j < k_joint_count; ++j)
        if (is_made_up(mesh, map, j)) missing += (missing.empty() ? "" : ", ") + plain_name(j);
    if (!missing.empty()) c.notes.push_back("Joints made up by proportion: " + missing + ".");
    std::array<bool, 2> stiff{};
    for (int side : {0, 1}) {
        auto toes = size_t(side == 0 ? left_toes : right_toes);
        if (map.joints[toes] != k_not_found) continue;
        stiff[size_t(side)] = true;
        FootShape shape = foot_shape(c, int(toes) - 1, {});
        c.bind_joints[toes] =
            c.bind_joints[toes - 1] + Vec3{0, -0.7f * shape.sole, std::max(0.65f * shape.tip, 0.01f)};
    }
    bend_feet(c, stiff);
    set_body(c, held_things(mesh, map, c),
             map.joints[left_shoulder] != k_not_found && map.joints[right_shoulder] != k_not_found);
    auto [low, high] = canonical_extent(c);
    c.body.height = high;
    bool plausible = low > -0.2f * high && leg_length(c.body) > 0.1f * high && high > 0.2f;
    if (!plausible) return Error{"its legs do not carry its body when it stands upright"};
    return c;
}

std::string node_name(const GltfScene& scene, const BakedMesh& mesh, int rig_joint) {
    auto node = size_t(mesh.nodes[size_t(rig_joint)]);
    const std::string& name = scene.nodes[node].name;
    return name.empty() ? "node " + std::to_string(node) : name;
}

}  // namespace

Result<MappedCharacter> map_character(const GltfScene& scene, const CharacterOptions& options) {
    auto mesh = bake(scene);
    if (!mesh) return mesh.error();
    auto map = map_rig(mesh->rig, mesh->low, mesh->high, options.force);
    if (!map) return map.error();
    bring_loose(scene, *map, *mesh);
    MappedCharacter out;
    out.map = *map;
    out.nodes = mesh->nodes;
    out.binds = mesh->binds;
    Found found;
    for (size_t j = 0; j < k_joint_count; ++j)
        if (!is_made_up(*mesh, *map, j)) found.nodes[j] = node_name(scene, *mesh, map->joints[j]);
    found.up = map->up;
    found.ahead = map->ahead;
    found.skins = mesh->skins;
    found.materials = mesh->materials;
    found.triangles = mesh->indices.size() / 3;
    found.clips = scene.clips;
    auto character = assemble(std::move(*mesh), *map, out.scale);
    if (!character) return character.error();
    out.character = std::move(*character);
    found.scale = out.scale;
    out.character.found = std::move(found);
    return out;
}

Result<Character> load_character(const std::string& path, const CharacterOptions& options) {
    auto model = parse_gltf(path);
    return model ? make_character(*model, path, options) : model.error();
}

bool has_skin(const std::string& path) {
    auto model = parse_gltf(path);
    return model && !model->skins.empty();
}

Result<Character> make_character(const tinygltf::Model& model, const std::string& path,
                                 const CharacterOptions& options) {
    auto scene = read_scene(model, path);
    if (!scene) return scene.error();
    auto mapped = map_character(*scene, options);
    if (!mapped) return Error{path + ": " + mapped.error().message};
    Character& character = mapped->character;
    character.name = file_name(path);
    character.textures = std::move(scene->textures);
    cached_lods(character, options.cache);
    return std::move(character);
}

}  // namespace flaneur
