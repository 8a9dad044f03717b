#include "assets/gltf_character.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "assets/gltf_bake.h"
#include "assets/person_skin.h"

namespace flaneur {

namespace {

constexpr float k_low_height = 0.5f, k_high_height = 2.5f, k_usual_height = 1.7f;

// From the file's axes and units to metres, +y up, facing +z, standing on 0 above the middle of the ankles.
struct Canon {
    Vec3 left, up, ahead, origin;
    float scale;
    Vec3 direction(Vec3 v) const { return {dot(v, left), dot(v, up), dot(v, ahead)}; }
    Vec3 place(Vec3 p) const { return direction(p - origin) * scale; }
};

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
    if (height < k_low_height || height > k_high_height) {
        c.scale = k_usual_height / height;
        notes.push_back("It stands " + std::to_string(height) + " units tall; scaled to 1.7 m.");
    }
    Vec3 feet =
        (mesh.rig[size_t(map.joints[left_foot])].place + mesh.rig[size_t(map.joints[right_foot])].place) *
        0.5f;
    c.origin = feet + map.up * (low - dot(feet, map.up));
    return c;
}

using Places = std::array<Vec3, k_joint_count>;

// Extent of a foot's flesh, seen from its ankle, in canonical axes.
struct FootShape {
    float sole = 0, heel = 0, tip = 0;  // below, behind and ahead of the ankle
};

// Joints that the file lacks, placed by the proportions of those it has.
Places fill_places(const BakedMesh& mesh, const RigMap& map, const Canon& canon) {
    Places p{};
    auto has = [&](int j) { return map.joints[size_t(j)] != k_not_found; };
    for (int j = 0; j < k_joint_count; ++j)
        if (has(j)) p[size_t(j)] = canon.place(mesh.rig[size_t(map.joints[size_t(j)])].place);
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
    for (int side : {0, right_shoulder - left_shoulder})
        if (!has(left_shoulder + side)) {
            Vec3 joint = p[size_t(left_upper_arm + side)];
            p[size_t(left_shoulder + side)] = lerp({p[upper_chest].x, joint.y, joint.z}, joint, 0.2f);
        }
    return p;
}

// The nearest mapped joint at or above each rig joint.
std::vector<uint8_t> collapse(const BakedMesh& mesh, const RigMap& map) {
    std::vector<int> mapped(mesh.rig.size(), -1);
    for (int j = 0; j < k_joint_count; ++j)
        if (map.joints[size_t(j)] != k_not_found) mapped[size_t(map.joints[size_t(j)])] = j;
    std::vector<uint8_t> out(mesh.rig.size(), hips);
    for (size_t n = 0; n < mesh.rig.size(); ++n) {
        if (mapped[n] >= 0)
            out[n] = uint8_t(mapped[n]);
        else if (mesh.rig[n].parent >= 0)
            out[n] = out[size_t(mesh.rig[n].parent)];
    }
    return out;
}

FootShape foot_shape(const Character& c, int ankle, Quat turn) {
    FootShape shape;
    bool found = false;
    auto measure = [&](auto&& belongs) {
        for (const CharacterVertex& v : c.vertices) {
            Vec3 p = rotate(turn, v.position - c.bind_joints[size_t(ankle)]);
            if (v.weights[0] < 128 || !belongs(v.joints[0], p)) continue;
            found = true;
            shape.sole = std::max(shape.sole, -p.y);
            shape.heel = std::max(shape.heel, -p.z);
            shape.tip = std::max(shape.tip, p.z);
        }
    };
    measure([&](int joint, Vec3) { return joint == ankle || joint == ankle + 1; });
    // A foot without a joint of its own is the lowest part of the shin.
    if (!found) measure([&](int joint, Vec3 p) { return joint == ankle - 1 && p.y < 0; });
    return shape;
}

Vec3 flesh_middle(const Character& c, int joint, Vec3 otherwise) {
    Vec3 sum;
    float mass = 0;
    for (const CharacterVertex& v : c.vertices)
        if (v.joints[0] == joint) sum += v.position, mass += 1;
    return mass > 0 ? sum / mass : otherwise;
}

// Turns about +y only, so that `v` heads for +z.
Quat turn_ahead(Vec3 v) {
    Vec3 level = normalize_or(Vec3{v.x, 0, v.z}, {0, 0, 1});
    return rotation_between(level, {0, 0, 1});
}

// `turn`, followed by the shortest rotation that brings `v` to `wanted`.
Quat then_towards(Quat turn, Vec3 v, Vec3 wanted) {
    return normalize(rotation_between(normalize_or(rotate(turn, v), wanted), wanted) * turn);
}

// Arms and legs straight down, feet ahead; the trunk stays as it was bound.
void set_rotations(Character& c) {
    constexpr Vec3 k_down{0, -1, 0};
    const auto& b = c.bind_joints;
    c.bind_to_canonical.fill({});
    for (size_t s : {0, right_upper_arm - left_upper_arm}) {
        size_t upper = left_upper_arm + s, lower = left_lower_arm + s, hand = left_hand + s;
        Quat q = then_towards({}, b[lower] - b[upper], k_down);
        c.bind_to_canonical[upper] = q;
        q = then_towards(q, b[hand] - b[lower], k_down);
        c.bind_to_canonical[lower] = q;
        Vec3 fingers = flesh_middle(c, int(hand), b[hand] + (b[hand] - b[lower])) - b[hand];
        c.bind_to_canonical[hand] = then_towards(q, fingers, k_down);
    }
    for (size_t s : {0, right_upper_leg - left_upper_leg}) {
        size_t upper = left_upper_leg + s, lower = left_lower_leg + s, foot = left_foot + s,
               toes = left_toes + s;
        Quat q = then_towards({}, b[lower] - b[upper], k_down);
        c.bind_to_canonical[upper] = q;
        c.bind_to_canonical[lower] = then_towards(q, b[foot] - b[lower], k_down);
        c.bind_to_canonical[foot] = c.bind_to_canonical[toes] = turn_ahead(b[toes] - b[foot]);
    }
}

void set_body(Character& c) {
    const auto& b = c.bind_joints;
    auto& j = c.body.joints;
    // The trunk on the middle plane; left and right by their mean.
    for (Joint n : {hips, spine, chest, upper_chest, neck, head}) j[n] = {0, b[n].y, b[n].z};
    auto mean = [&](int left, int right) {
        Vec3 l = b[size_t(left)], r = b[size_t(right)];
        return Vec3{std::max((l.x - r.x) * 0.5f, 0.0f), (l.y + r.y) * 0.5f, (l.z + r.z) * 0.5f};
    };
    auto mean_length = [&](int from, int to, int mirror) {
        return (length(b[size_t(to)] - b[size_t(from)]) +
                length(b[size_t(to + mirror)] - b[size_t(from + mirror)])) *
               0.5f;
    };
    constexpr int k_arm = right_shoulder - left_shoulder, k_leg = right_upper_leg - left_upper_leg;
    j[left_shoulder] = mean(left_shoulder, right_shoulder);
    j[left_upper_arm] = mean(left_upper_arm, right_upper_arm);
    j[left_lower_arm] = j[left_upper_arm] - Vec3{0, mean_length(left_upper_arm, left_lower_arm, k_arm), 0};
    j[left_hand] = j[left_lower_arm] - Vec3{0, mean_length(left_lower_arm, left_hand, k_arm), 0};

    FootShape left = foot_shape(c, left_foot, c.bind_to_canonical[left_foot]);
    FootShape right = foot_shape(c, right_foot, c.bind_to_canonical[right_foot]);
    float sole = std::max(left.sole, right.sole), tip = std::max(left.tip, right.tip);
    float thigh = mean_length(left_upper_leg, left_lower_leg, k_leg),
          shank = mean_length(left_lower_leg, left_foot, k_leg);
    Vec3 hip = mean(left_upper_leg, right_upper_leg);
    float rise = sole + shank + thigh - hip.y, shift = -hip.z;
    for (int n = hips; n <= left_hand; ++n) j[size_t(n)] += Vec3{0, rise, shift};
    j[left_upper_leg] = {hip.x, hip.y + rise, 0};
    j[left_lower_leg] = j[left_upper_leg] - Vec3{0, thigh, 0};
    j[left_foot] = j[left_lower_leg] - Vec3{0, shank, 0};
    Vec3 ball = rotate(c.bind_to_canonical[left_foot], b[left_toes] - b[left_foot]);
    Vec3 other = rotate(c.bind_to_canonical[right_foot], b[right_toes] - b[right_foot]);
    j[left_toes] = j[left_foot] + Vec3{0, (ball.y + other.y) * 0.5f, (ball.z + other.z) * 0.5f};
    for (auto [from, to] :
         {std::pair{int(left_shoulder), int(right_shoulder)}, {left_upper_leg, right_upper_leg}})
        for (int n = 0; n < 4; ++n) {
            Vec3 p = j[size_t(from + n)];
            j[size_t(to + n)] = {-p.x, p.y, p.z};
        }
    c.body.heel = std::max({left.heel, right.heel, 0.01f});
    c.body.toe = std::max(tip - (j[left_toes].z - j[left_foot].z), 0.01f);
}

// The lowest that a leg's vertex, and the highest that any but a hand's, stands in the canonical pose.
std::pair<float, float> canonical_extent(const Character& c) {
    float low = 1e9f, high = -1e9f;
    for (uint32_t i : c.lods[0]) {
        const CharacterVertex& v = c.vertices[i];
        float y = 0;
        for (size_t n = 0; n < 4; ++n) {
            size_t j = v.joints[n];
            Vec3 p = c.body.joints[j] + rotate(c.bind_to_canonical[j], v.position - c.bind_joints[j]);
            y += p.y * (float(v.weights[n]) / 255);
        }
        if (v.joints[0] >= left_upper_leg) low = std::min(low, y);
        if (v.joints[0] != left_hand && v.joints[0] != right_hand) high = std::max(high, y);
    }
    return {low, high};
}

std::string file_name(const std::string& path) {
    size_t slash = path.find_last_of('/'), dot = path.find_last_of('.');
    size_t begin = slash == std::string::npos ? 0 : slash + 1;
    return path.substr(begin, dot == std::string::npos || dot < begin ? std::string::npos : dot - begin);
}

Result<Character> assemble(BakedMesh mesh, const RigMap& map, float& scale) {
    Character c;
    c.notes = std::move(mesh.notes);
    if (!map.note.empty()) c.notes.push_back(map.note);
    std::vector<uint8_t> joint_of = collapse(mesh, map), in_hand;
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
    for (int j : {spine, chest, upper_chest, neck, left_shoulder, left_toes})
        if (map.joints[size_t(j)] == k_not_found)
            missing += (missing.empty() ? "" : ", ") + std::string(k_joint_names[size_t(j)]);
    if (!missing.empty()) c.notes.push_back("Joints made up by proportion: " + missing + ".");
    for (int side : {0, right_toes - left_toes}) {
        if (map.joints[size_t(left_toes + side)] != k_not_found) continue;
        FootShape shape = foot_shape(c, left_foot + side, {});
        c.bind_joints[size_t(left_toes + side)] =
            c.bind_joints[size_t(left_foot + side)] +
            Vec3{0, -0.7f * shape.sole, std::max(0.6f * shape.tip, 0.01f)};
    }
    set_rotations(c);
    set_body(c);
    auto [low, high] = canonical_extent(c);
    c.body.height = high;
    bool plausible = low > -0.2f * high && leg_length(c.body) > 0.1f * high && high > 0.2f;
    if (!plausible) return Error{"its legs do not carry its body when it stands upright"};
    return c;
}

// Joints behind the nodes stand where a chain's last bone ends.
std::string node_name(const GltfScene& scene, const BakedMesh& mesh, int rig_joint) {
    auto joint = size_t(rig_joint);
    if (joint >= mesh.nodes.size()) return "end of " + node_name(scene, mesh, mesh.rig[joint].parent);
    auto node = size_t(mesh.nodes[joint]);
    const std::string& name = scene.nodes[node].name;
    return name.empty() ? "node " + std::to_string(node) : name;
}

}  // namespace

Result<MappedCharacter> map_character(const GltfScene& scene) {
    auto mesh = bake(scene);
    if (!mesh) return mesh.error();
    auto map = map_rig(mesh->rig, mesh->low, mesh->high);
    if (!map) return map.error();
    MappedCharacter out;
    out.map = *map;
    out.nodes = mesh->nodes;
    out.binds = mesh->binds;
    Found found;
    for (size_t j = 0; j < k_joint_count; ++j)
        if (int rig = map->joints[j]; rig != k_not_found) found.nodes[j] = node_name(scene, *mesh, rig);
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

Result<Character> load_character(const std::string& path) {
    auto model = parse_gltf(path);
    return model ? make_character(*model, path) : model.error();
}

Result<Character> make_character(const tinygltf::Model& model, const std::string& path) {
    auto scene = read_scene(model, path);
    if (!scene) return scene.error();
    auto mapped = map_character(*scene);
    if (!mapped) return Error{path + ": " + mapped.error().message};
    Character& character = mapped->character;
    character.name = file_name(path);
    character.textures = std::move(scene->textures);
    build_lods(character);
    return std::move(character);
}

}  // namespace flaneur
