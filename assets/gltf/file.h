// A glTF file taken apart: its JSON and the bytes that belong to it, held within limits before a parser sees
// them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "assets/files/file.h"
#include "sim/base/result.h"

namespace flaneur {

struct GltfFile {
    std::string json;  // all that makes a character or a city; buffers and images are taken out of it
    std::vector<Bytes> buffers;  // as many as the file says and those of compressed views
    std::vector<Bytes> images;   // encoded; empty where there is none to be had
};

// Together these keep the loader under a gigabyte.
inline constexpr size_t k_most_gltf_bytes = size_t{128} << 20;  // of the file, all buffers, all images

// From the bytes of a .gltf, .glb or .vrm file. Other files that it names are looked for in `folder`.
// Refuses, in a sentence, what is no glTF 2.0, claims more than it holds, or needs an extension that is not
// supported.
Result<GltfFile> open_gltf(std::span<const uint8_t> bytes, const std::string& folder);

// The files beside it that a .gltf, .glb or .vrm file says its buffers and images are in, whether they are
// there or not. None of what is no glTF 2.0.
std::vector<std::string> files_named_by(const std::string& path);

}  // namespace flaneur
