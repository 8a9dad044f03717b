#include "tools/extract/convert.h"
#include "tools/extract/ids.h"
#include "tools/extract/parts.h"

namespace flaneur {

void add_scenery(const Scenery& scenery, CityMesh& mesh) {
    auto first = static_cast<uint32_t>(mesh.vertices.size());
    for (const Scenery::Vertex& v : scenery.vertices) {
        CityVertex out{};
        out.position = to_glm(v.position);
        out.colour = v.colour;
        out.uv = {v.uv.x, v.uv.z};
        out.normal[0] = packed(v.normal.x);
        out.normal[1] = packed(v.normal.y);
        out.normal[2] = packed(v.normal.z);
        out.material = static_cast<uint16_t>(k_material_scenery);
        out.id = id_of(IdKind::scenery, 0);
        mesh.vertices.push_back(out);
    }
    for (size_t i = 0; i < scenery.indices.size(); ++i) {
        uint32_t index = first + scenery.indices[i], picture = scenery.pictures[i / 3];
        if (picture < scenery.images.size()) mesh.vertices[index].extra = static_cast<uint16_t>(picture + 1);
        mesh.indices.push_back(index);
    }
    for (const Scenery::Picture& picture : scenery.images)
        mesh.textures.push_back(
            {static_cast<uint32_t>(picture.width), static_cast<uint32_t>(picture.height), picture.rgba});
}

}  // namespace flaneur
