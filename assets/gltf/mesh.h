// The triangles and base colours of a parsed glTF file.
#pragma once

#include <vector>

#include "assets/gltf/read.h"

namespace tinygltf {
class Model;
}

namespace flaneur {

// Every mesh's triangle primitives; points and lines are left out. Adds the textures in use, and notes, to
// `scene`.
Result<std::vector<std::vector<GltfPrimitive>>> read_meshes(const tinygltf::Model& model, const GltfUse& use,
                                                            GltfScene& scene);

}  // namespace flaneur
