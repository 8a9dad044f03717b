#include "assets/gltf/character/bake.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "assets/gltf/character/rig_tree.h"

namespace flaneur {

namespace {

constexpr size_t k_most_joints = 2048;

struct Pose {
    std::vector<Affine> world;   // by node
    std::vector<int> rig_of;     // by node: index into rig_nodes, or -1
    std::vector<int> rig_nodes;  // nodes that are joints, parents first
};

std::vector<uint8_t> skins_in_use(const GltfScene& scene) {
    std::vector<uint8_t> used(scene.skins.size(), 0);
    for (const GltfNode& node : scene.nodes)
        if (node.mesh >= 0 && node.shown && node.skin >= 0 && !scene.meshes[size_t(node.mesh)].empty())
            used[size_t(node.skin)] = 1;
    return used;
}

void collect_joints(const GltfScene& scene, const std::vector<uint8_t>& used, Pose& pose) {
    std::vector<uint8_t> is_joint(scene.nodes.size(), 0);
    for (size_t s = 0; s < scene.skins.size(); ++s)
        if (used[s])
            for (int joint : scene.skins[s].joints) is_joint[size_t(joint)] = 1;
    std::vector<std::pair<int, int>> by_depth;
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        if (!is_joint[n]) continue;
        int depth = 0;
        for (int p = scene.nodes[n].parent; p >= 0; p = scene.nodes[size_t(p)].parent) ++depth;
        by_depth.push_back({depth, int(n)});
    }
    std::sort(by_depth.begin(), by_depth.end());
    pose.rig_of.assign(scene.nodes.size(), -1);
    for (auto [depth, node] : by_depth) {
        pose.rig_of[size_t(node)] = int(pose.rig_nodes.size());
        pose.rig_nodes.push_back(node);
    }
}

int parent_joint(const GltfScene& scene, const Pose& pose, int node) {
    for (int p = scene.nodes[size_t(node)].parent; p >= 0; p = scene.nodes[size_t(p)].parent)
        if (pose.rig_of[size_t(p)] >= 0) return p;
    return -1;
}

// Where the joints stood when the mesh was bound: by the inverse bind matrices, each skin joined to those
// before it by a joint they share. The first joint stays where it rests.
std::vector<Affine> bind_pose(const GltfScene& scene, const std::vector<uint8_t>& used) {
    std::vector<Affine> world(scene.nodes.size());
    for (size_t n = 0; n < world.size(); ++n) world[n] = scene.nodes[n].world;
    std::vector<uint8_t> known(world.size(), 0);
    for (size_t s = 0; s < scene.skins.size(); ++s) {
        const GltfSkin& skin = scene.skins[s];
        if (!used[s] || skin.joints.empty()) continue;
        size_t anchor = 0;
        for (size_t j = 0; j < skin.joints.size(); ++j)
            if (known[size_t(skin.joints[j])]) {
                anchor = j;
                break;
            }
        Affine skin_to_world = world[size_t(skin.joints[anchor])] * skin.inverse_binds[anchor];
        for (size_t j = 0; j < skin.joints.size(); ++j) {
            auto node = size_t(skin.joints[j]);
            if (!known[node]) world[node] = skin_to_world * inverse(skin.inverse_binds[j]);
            known[node] = 1;
        }
    }
    return world;
}

// Whether most bones are as long in the pose as at rest. Some may differ: feet and poles that an animator
// moves freely.
bool same_bones(const GltfScene& scene, const Pose& pose, const std::vector<Affine>& world) {
    std::vector<float> ratios;
    auto compare = [&](int node, int other) {
        float rest = length(scene.nodes[size_t(node)].world.t - scene.nodes[size_t(other)].world.t);
        float bound = length(world[size_t(node)].t - world[size_t(other)].t);
        if (rest > 1e-5f) ratios.push_back(bound / rest);
    };
    for (int node : pose.rig_nodes)
        if (int parent = parent_joint(scene, pose, node); parent >= 0) compare(node, parent);
    if (ratios.empty())  // no joint hangs from another
        for (int node : pose.rig_nodes) compare(node, pose.rig_nodes[0]);
    if (ratios.empty()) return false;
    std::sort(ratios.begin(), ratios.end());
    float middle = ratios[ratios.size() / 2];
    size_t odd = 0;
    for (float r : ratios) odd += std::fabs(r - middle) > 0.1f * middle;
    return middle > 0.8f && middle < 1.25f && odd * 3 <= ratios.size();
}

Vec3 skinned(const std::vector<std::pair<Affine, float>>& bones, Vec3 v, bool point) {
    Vec3 sum;
    for (const auto& [bone, weight] : bones)
        sum += (point ? transform(bone, v) : rotate_scale(bone, v)) * weight;
    return sum;
}

void add_primitive(const GltfPrimitive& p, BakedMesh& out) {
    auto base = uint32_t(out.vertices.size());
    for (size_t v = 0; v < p.positions.size(); ++v) {
        CharacterVertex vertex;
        vertex.position = p.positions[v];
        vertex.normal = p.normals.empty() ? Vec3{} : p.normals[v];
        if (!p.uvs.empty()) vertex.u = p.uvs[v].x, vertex.v = p.uvs[v].z;
        vertex.colour = p.colours[v];
        vertex.texture = p.texture;
        out.vertices.push_back(vertex);
    }
    for (uint32_t i : p.indices) out.indices.push_back(base + i);
}

// Whether most triangles from `corner` on face against their normals.
bool faces_inward(const BakedMesh& mesh, size_t corner) {
    double along = 0;
    for (size_t t = corner; t + 2 < mesh.indices.size(); t += 3) {
        const CharacterVertex &a = mesh.vertices[mesh.indices[t]], &b = mesh.vertices[mesh.indices[t + 1]],
                              &c = mesh.vertices[mesh.indices[t + 2]];
        const Vec3 across = cross(b.position - a.position, c.position - a.position);
        along += double(dot(across, a.normal + b.normal + c.normal));
    }
    return along < 0;
}

// Exports from left-handed programs mirror bones or nodes, and the triangles from `corner` on with them,
// which face outward again. Where only the node is mirrored, or both, their normals tell which way that is.
void turn_mirrored(const GltfPrimitive& p, const GltfNode& node, const Affine& moved, size_t corner,
                   BakedMesh& mesh) {
    bool mirrored = determinant(moved) < 0;
    if (!p.normals.empty() && (mirrored || determinant(node.world) < 0))
        mirrored = faces_inward(mesh, corner);
    if (!mirrored) return;
    for (size_t t = corner; t + 2 < mesh.indices.size(); t += 3)
        std::swap(mesh.indices[t + 1], mesh.indices[t + 2]);
}

// Returns how many vertices had weights that did not sum to 1.
Result<size_t> add_skinned(const Pose& pose, const GltfPrimitive& p, const GltfSkin& skin, BakedMesh& out) {
    size_t base = out.vertices.size(), repaired = 0;
    add_primitive(p, out);
    out.rigid.resize(out.vertices.size(), 0);
    std::vector<std::pair<Affine, float>> bones;
    for (size_t v = 0; v < p.positions.size(); ++v) {
        bones.clear();
        auto& influences = out.influences.emplace_back();
        float sum = 0;
        auto per_vertex = size_t(p.influences_per_vertex);
        for (size_t i = 0; i < per_vertex; ++i) {
            auto [joint, weight] = p.influences[v * per_vertex + i];
            if (weight <= 0) continue;
            if (joint >= skin.joints.size()) return Error{"a vertex is bound to a joint that its skin lacks"};
            sum += weight;
            int node = skin.joints[joint];
            influences.push_back({pose.rig_of[size_t(node)], weight});
            bones.push_back({pose.world[size_t(node)] * skin.inverse_binds[joint], weight});
        }
        if (bones.empty()) {
            influences.push_back({pose.rig_of[size_t(skin.joints[0])], 1.0f});
            bones.push_back({pose.world[size_t(skin.joints[0])] * skin.inverse_binds[0], 1.0f});
            sum = 1, ++repaired;
        }
        repaired += std::fabs(sum - 1) > 0.01f;
        for (auto& influence : influences) influence.second /= sum;
        for (auto& bone : bones) bone.second /= sum;
        CharacterVertex& vertex = out.vertices[base + v];
        vertex.position = skinned(bones, vertex.position, true);
        vertex.normal = normalize_or(skinned(bones, vertex.normal, false), {});
    }
    return repaired;
}

// A mesh without a skin that hangs from a bone: glasses, a bag, a sword.
void add_rigid(const GltfPrimitive& p, const Affine& to_world, int rig_joint, BakedMesh& out) {
    size_t base = out.vertices.size();
    add_primitive(p, out);
    for (size_t v = base; v < out.vertices.size(); ++v) {
        out.vertices[v].position = transform(to_world, out.vertices[v].position);
        out.vertices[v].normal = normalize_or(rotate_scale(to_world, out.vertices[v].normal), {});
        out.influences.push_back({{rig_joint, 1.0f}});
        out.rigid.push_back(1);
    }
}

// Things that share a joint which moves nothing else, a slot in the hand, are there to choose from: all but
// the first of each slot.
std::vector<uint8_t> spare_things(const GltfScene& scene, const Pose& pose, const std::vector<uint8_t>& used,
                                  std::vector<std::string>& notes) {
    std::vector<uint8_t> moves(scene.nodes.size(), 0), spare(scene.nodes.size(), 0);
    for (const GltfNode& node : scene.nodes) {
        if (node.mesh < 0 || node.skin < 0 || !used[size_t(node.skin)]) continue;
        const GltfSkin& skin = scene.skins[size_t(node.skin)];
        for (const GltfPrimitive& p : scene.meshes[size_t(node.mesh)])
            for (auto [joint, weight] : p.influences)
                if (weight > 0 && joint < skin.joints.size()) moves[size_t(skin.joints[joint])] = 1;
    }
    std::vector<int> kept(scene.nodes.size(), -1);
    size_t count = 0;
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        const GltfNode& node = scene.nodes[n];
        if (node.mesh < 0 || node.skin >= 0 || node.parent < 0) continue;
        auto slot = size_t(node.parent);
        if (pose.rig_of[slot] < 0 || moves[slot]) continue;
        if (kept[slot] < 0) kept[slot] = int(n);
        spare[n] = kept[slot] != int(n);
        count += spare[n];
    }
    if (count > 0)
        notes.push_back(std::to_string(count) +
                        " things share a slot with another; the first of each is kept.");
    return spare;
}

// Area-weighted normals for vertices that came without, smooth over vertices at one place.
void fill_normals(BakedMesh& mesh) {
    std::vector<uint32_t> order(mesh.vertices.size());
    for (size_t v = 0; v < order.size(); ++v) order[v] = uint32_t(v);
    auto place = [&](uint32_t v) { return mesh.vertices[v].position; };
    std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        Vec3 p = place(a), q = place(b);
        if (p.x != q.x) return p.x < q.x;
        if (p.y != q.y) return p.y < q.y;
        return p.z != q.z ? p.z < q.z : a < b;
    });
    std::vector<uint32_t> first(order.size());
    for (size_t i = 0; i < order.size(); ++i)
        first[order[i]] = i > 0 && place(order[i]) == place(order[i - 1]) ? first[order[i - 1]] : order[i];
    std::vector<Vec3> sums(order.size());
    for (size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        uint32_t a = mesh.indices[t], b = mesh.indices[t + 1], c = mesh.indices[t + 2];
        Vec3 n = cross(place(b) - place(a), place(c) - place(a));
        for (uint32_t v : {a, b, c}) sums[first[v]] += n;
    }
    for (size_t v = 0; v < order.size(); ++v) {
        Vec3& n = mesh.vertices[v].normal;
        float longest =
            std::max({std::fabs(sums[first[v]].x), std::fabs(sums[first[v]].y), std::fabs(sums[first[v]].z)});
        if (n == Vec3{}) n = longest > 0 ? normalize_or(sums[first[v]] / longest, {0, 1, 0}) : Vec3{0, 1, 0};
    }
}

void measure_rig(const GltfScene& scene, const Pose& pose, BakedMesh& mesh) {
    for (int node : pose.rig_nodes) {
        RigJoint joint;
        joint.name = scene.humanoid[size_t(node)].empty() ? scene.nodes[size_t(node)].name
                                                          : scene.humanoid[size_t(node)];
        int parent = parent_joint(scene, pose, node);
        joint.parent = parent < 0 ? -1 : pose.rig_of[size_t(parent)];
        joint.place = pose.world[size_t(node)].t;
        joint.rest = scene.nodes[size_t(node)].world.t;
        mesh.rig.push_back(joint);
        mesh.nodes.push_back(node);
        mesh.binds.push_back(pose.world[size_t(node)]);
    }
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
        for (auto [joint, weight] : mesh.influences[v]) {
            mesh.rig[size_t(joint)].mass += weight;
            mesh.rig[size_t(joint)].flesh += mesh.vertices[v].position * weight;
        }
    for (RigJoint& joint : mesh.rig) joint.flesh = joint.mass > 0 ? joint.flesh / joint.mass : joint.place;
    add_ends(mesh.rig);
}

bool sane(Vec3 p) {
    for (float f : {p.x, p.y, p.z})
        if (!(f > -1e8f && f < 1e8f)) return false;
    return true;
}

}  // namespace

Result<BakedMesh> bake(const GltfScene& scene) {
    std::vector<uint8_t> used = skins_in_use(scene);
    if (std::find(used.begin(), used.end(), 1) == used.end())
        return Error{
            "has no skinned mesh: it is a thing without a skeleton; a character needs one that moves it (rig "
            "it, then export with skin)"};
    Pose pose;
    collect_joints(scene, used, pose);
    if (pose.rig_nodes.size() > k_most_joints)
        return Error{"has " + std::to_string(pose.rig_nodes.size()) +
                     " joints; simplify its skeleton to at most " + std::to_string(k_most_joints)};
    pose.world = bind_pose(scene, used);
    BakedMesh mesh;
    mesh.notes = scene.notes;
    if (!same_bones(scene, pose, pose.world)) {
        for (size_t n = 0; n < scene.nodes.size(); ++n) pose.world[n] = scene.nodes[n].world;
        mesh.notes.push_back("Its skins agree on no bind pose; its rest pose is taken.");
    }

    std::vector<uint8_t> spare = spare_things(scene, pose, used, mesh.notes);
    mesh.skins = size_t(std::count(used.begin(), used.end(), 1));
    std::set<int> materials;
    size_t repaired = 0, skipped = 0, unskinned = 0;
    for (size_t n = 0; n < scene.nodes.size(); ++n) {
        const GltfNode& node = scene.nodes[n];
        if (node.mesh < 0 || !node.shown || spare[n]) continue;
        int bone = pose.rig_of[n] >= 0 ? int(n) : parent_joint(scene, pose, int(n));
        for (const GltfPrimitive& p : scene.meshes[size_t(node.mesh)]) {
            if (mesh.vertices.size() + p.positions.size() > k_character_use.most_vertices ||
                mesh.indices.size() + p.indices.size() > k_character_use.most_corners)
                return too_much(k_character_use);
            const size_t corner = mesh.indices.size();
            if (node.skin >= 0 && p.influences_per_vertex > 0 &&
                !scene.skins[size_t(node.skin)].joints.empty()) {
                const GltfSkin& skin = scene.skins[size_t(node.skin)];
                auto done = add_skinned(pose, p, skin, mesh);
                if (!done) return done.error();
                repaired += *done;
                turn_mirrored(p, node, pose.world[size_t(skin.joints[0])] * skin.inverse_binds[0], corner,
                              mesh);
            } else if (bone >= 0) {
                const Affine& rest = scene.nodes[size_t(bone)].world;
                if (!invertible(rest)) continue;
                const Affine moved = pose.world[size_t(bone)] * inverse(rest) * node.world;
                add_rigid(p, moved, pose.rig_of[size_t(bone)], mesh);
                turn_mirrored(p, node, moved, corner, mesh);
            } else {
                ++(node.skin >= 0 ? unskinned : skipped);
                continue;
            }
            materials.insert(p.material);
        }
    }
    mesh.materials = materials.size();
    if (mesh.indices.empty() || pose.rig_nodes.empty())
        return Error{"has a skin but no triangles bound to it"};
    if (repaired > 0)
        mesh.notes.push_back("The weights of " + std::to_string(repaired) +
                             " vertices did not sum to 1; they do now.");
    if (skipped > 0)
        mesh.notes.push_back(std::to_string(skipped) +
                             " meshes hang from no bone of the skeleton; they are left out.");
    if (unskinned > 0)
        mesh.notes.push_back(std::to_string(unskinned) +
                             " meshes have a skin but no weights; they are left out.");

    mesh.low = mesh.high = mesh.vertices[mesh.indices[0]].position;
    for (const CharacterVertex& v : mesh.vertices)
        if (!sane(v.position)) return Error{"has a skinned mesh that reaches beyond reason"};
    for (uint32_t i : mesh.indices) {
        Vec3 p = mesh.vertices[i].position;
        mesh.low = {std::min(mesh.low.x, p.x), std::min(mesh.low.y, p.y), std::min(mesh.low.z, p.z)};
        mesh.high = {std::max(mesh.high.x, p.x), std::max(mesh.high.y, p.y), std::max(mesh.high.z, p.z)};
    }
    fill_normals(mesh);
    measure_rig(scene, pose, mesh);
    return mesh;
}

}  // namespace flaneur
