// A glTF file with a man of boxes who stands with his arms held out, to be read as he is or broken first.
#pragma once

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "assets/gltf/file.h"
#include "assets/gltf/json.h"
#include "sim/body/body.h"

namespace flaneur {

// Node j is joint j of standard_body; node 22 carries the mesh. Accessors: positions, joints, weights,
// indices, inverse bind matrices.
struct TinyMan {
    Json gltf;
    Bytes bytes;  // buffer 0
};
inline constexpr int k_tiny_mesh = k_joint_count;  // node
enum TinyAccessor { tiny_positions, tiny_joints, tiny_weights, tiny_indices, tiny_binds };

// A joint and the box of flesh that hangs from it.
struct TinyBone {
    std::string name;
    int parent;      // -1: none; else one before it
    Vec3 place, to;  // of the joint, and where its flesh ends
    bool carries_flesh = true;
};

// The bones of the man; bone j is joint j of standard_body, which names it.
std::vector<TinyBone> tiny_bones();

// The number of a bone that is there.
int find_bone(const std::vector<TinyBone>& bones, const std::string& name);

// Appends a bone, or one without flesh; `parent` is a name, empty for none.
void add_bone(std::vector<TinyBone>& bones, const std::string& name, const std::string& parent, Vec3 place,
              Vec3 to);
void add_helper(std::vector<TinyBone>& bones, const std::string& name, const std::string& parent, Vec3 place);

// Takes out a bone; its flesh, if it is to stay, and its children go to its parent.
void drop_bone(std::vector<TinyBone>& bones, const std::string& name, bool keep_flesh = false);

// `bones` below one of others, which come first.
std::vector<TinyBone> bones_below(const std::vector<TinyBone>& first, int parent,
                                  std::vector<TinyBone> bones);

// Cuts a limb's bone in two: the second half, NAME.001, carries what hung from the first.
void split_bone(std::vector<TinyBone>& bones, const std::string& name);

// Node j is bone j, the last one carries the mesh. The file's axes may be turned as a whole.
TinyMan tiny_rig(const std::vector<TinyBone>& bones, Quat turn = {});
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
