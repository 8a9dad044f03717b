// Buffer views compressed by gltfpack: the extension EXT_meshopt_compression.
#pragma once

#include "assets/gltf/file.h"
#include "assets/gltf/json.h"

namespace flaneur {

// Decodes each compressed view into a buffer of its own behind the others, and points the view at it. Refuses
// what is broken, and more than k_most_gltf_bytes in all.
Result<void> decode_meshopt(Json& gltf, std::vector<Bytes>& buffers);

}  // namespace flaneur
