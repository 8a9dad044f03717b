// Meshes compressed by Draco: the extension KHR_draco_mesh_compression.
#pragma once

#include "assets/gltf/file.h"
#include "assets/gltf/json.h"

namespace flaneur {

// Decodes each compressed primitive into buffers of its own behind the others, and points its attributes and
// indices at them, as floats and 32-bit numbers. Refuses what is broken, and more than k_most_gltf_bytes in
// all.
Result<void> decode_draco(Json& gltf, std::vector<Bytes>& buffers);

}  // namespace flaneur
