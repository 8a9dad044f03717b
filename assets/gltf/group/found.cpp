#include <tiny_gltf.h>

#include <set>

#include "assets/gltf/group/group.h"
#include "assets/gltf/read.h"

namespace flaneur {

namespace {

const std::string& topmost_name(const GltfScene& scene, int node) {
    while (scene.nodes[static_cast<size_t>(node)].parent >= 0)
        node = scene.nodes[static_cast<size_t>(node)].parent;
    return scene.nodes[static_cast<size_t>(node)].name;
}

}  // namespace

Result<GroupFound> find_group(const std::string& path) {
    Result<tinygltf::Model> model = parse_gltf(path);
    if (!model) return model.error();
    const Result<GltfScene> scene = read_scene(*model, path, k_city_use);
    if (!scene) return scene.error();
    GroupFound found;
    std::set<int> joints;  // of those before
    for (const GltfNode& node : scene->nodes) {
        if (!node.shown || node.mesh < 0 || node.skin < 0) continue;
        for (const GltfPrimitive& primitive : scene->meshes[static_cast<size_t>(node.mesh)])
            found.triangles += primitive.indices.size() / 3;
        const std::vector<int>& own = scene->skins[static_cast<size_t>(node.skin)].joints;
        const size_t before = joints.size();
        joints.insert(own.begin(), own.end());
        if (own.size() >= k_joint_count && joints.size() == before + own.size())
            found.names.push_back(topmost_name(*scene, own[0]));
    }
    if (found.names.size() < 2) return Error{path + " has fewer than two skeletons of its own"};
    found.clips = scene->clips;
    return found;
}

}  // namespace flaneur
