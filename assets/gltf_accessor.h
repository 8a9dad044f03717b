// Bounds-checked reading of glTF accessors.
#pragma once

#include <vector>

#include "sim/base/result.h"

namespace tinygltf {
class Model;
}

namespace flaneur {

struct AccessorData {
    int components = 0;         // 1..16 for each element
    size_t count = 0;           // elements
    std::vector<float> values;  // normalised integers as fractions; all finite
};

// An accessor's elements as floats, sparse substitutions applied. `what` names it in messages.
Result<AccessorData> read_accessor(const tinygltf::Model& model, int accessor, const std::string& what);

// A scalar accessor of unsigned integers.
Result<std::vector<uint32_t>> read_indices(const tinygltf::Model& model, int accessor,
                                           const std::string& what);

}  // namespace flaneur
