#include "assets/gltf/city/triangles.h"

#include <tiny_gltf.h>

#include <utility>

#include "assets/gltf/read.h"

namespace flaneur {

Result<GltfTriangles> load_triangles(const std::string& path) {
    Result<tinygltf::Model> model = parse_gltf(path);
    if (!model) return model.error();
    Result<GltfScene> scene = read_scene(*model, path, k_city_use);
    if (!scene) return scene.error();
    GltfTriangles out;
    for (const GltfNode& node : scene->nodes) {
        if (!node.shown || node.mesh < 0) continue;
        const bool is_mirrored = determinant(node.world) < 0;
        for (const GltfPrimitive& p : scene->meshes[static_cast<size_t>(node.mesh)]) {
            // The file may show a mesh many times.
            if (out.vertices.size() + p.positions.size() > k_city_use.most_vertices ||
                out.indices.size() + p.indices.size() > k_city_use.most_corners)
                return Error{path + ": " + too_much(k_city_use).message};
            const auto first = static_cast<uint32_t>(out.vertices.size());
            for (const Vec3 v : p.positions) out.vertices.push_back(transform(node.world, v));
            for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
                uint32_t b = first + p.indices[i + 1], c = first + p.indices[i + 2];
                if (is_mirrored) std::swap(b, c);
                for (const uint32_t v : {first + p.indices[i], b, c}) out.indices.push_back(v);
            }
        }
    }
    return out;
}

}  // namespace flaneur
