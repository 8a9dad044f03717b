// All triangles of a glTF file as one mesh, without colours.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/gltf/affine.h"
#include "sim/base/result.h"

namespace flaneur {

struct GltfTriangles {
    std::vector<Vec3> vertices;
    std::vector<uint32_t> indices;  // three a triangle
};

// What the scene shows that the file opens with, each mesh where its node puts it at rest; skins are left out
// of account. Refuses, in a sentence that begins with `path`, what cannot be read.
Result<GltfTriangles> load_triangles(const std::string& path);

}  // namespace flaneur
