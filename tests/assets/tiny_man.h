// A glTF file with a man of boxes who stands with his arms held out, to be read as he is or broken first.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "assets/gltf_file.h"
#include "assets/gltf_json.h"
#include "sim/pose/body.h"

namespace flaneur {

// Node j is joint j of standard_body; node 22 carries the mesh. Accessors: positions, joints, weights,
// indices, inverse bind matrices.
struct TinyMan {
    Json gltf;
    Bytes bytes;  // buffer 0
};
inline constexpr int k_tiny_mesh = k_joint_count;  // node
enum TinyAccessor { tiny_positions, tiny_joints, tiny_weights, tiny_indices, tiny_binds };

// The file's axes may be turned as a whole.
TinyMan tiny_man(Quat turn = {});

// Appends data as an accessor with a view of its own; returns its number.
int add_accessor(TinyMan& man, const void* data, size_t bytes, int component, const char* type, size_t count);

template <class T>
int add_accessor(TinyMan& man, const std::vector<T>& values, const char* type) {
    std::string_view kind = type;
    size_t each = kind == "SCALAR" ? 1 : kind == "MAT4" ? 16 : size_t(type[3] - '0');
    int component = std::is_same_v<T, float> ? 5126 : std::is_same_v<T, uint16_t> ? 5123 : 5121;
    return add_accessor(man, values.data(), values.size() * sizeof(T), component, type, values.size() / each);
}

// The bytes of an accessor as added, to be read or changed.
template <class T>
T* data_of(TinyMan& man, int accessor) {
    size_t view = man.gltf["accessors"][size_t(accessor)]["bufferView"];
    return reinterpret_cast<T*>(man.bytes.data() + man.gltf["bufferViews"][view]["byteOffset"].get<size_t>());
}

// Adds a channel to the one animation, "Man|Sway".
void animate(TinyMan& man, int node, const char* path, const char* way, const std::vector<float>& times,
             const std::vector<float>& values);

Bytes as_glb(const TinyMan& man);
// JSON with the buffer in a data URI.
Bytes as_gltf(const TinyMan& man);
std::string as_base64(const Bytes& bytes);

}  // namespace flaneur
