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

inline constexpr size_t k_most_elements = size_t{1} << 23;  // more would be no character

// An accessor's elements as floats, sparse substitutions applied. `what` names it in messages. Refuses more
// than `most` elements before it reads any.
Result<AccessorData> read_accessor(const tinygltf::Model& model, int accessor, const std::string& what,
                                   size_t most = k_most_elements);

// A scalar accessor of unsigned integers.
Result<std::vector<uint32_t>> read_indices(const tinygltf::Model& model, int accessor,
                                           const std::string& what);

}  // namespace flaneur
