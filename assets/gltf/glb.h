// Putting a binary glTF file (.glb) together: what people and cities have in common.
#pragma once

#include <tiny_gltf.h>

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// A model of one empty buffer, made by flaneur.
tinygltf::Model begin_glb();

// The file's bytes.
std::string finish_glb(tinygltf::Model& model);

std::vector<double> numbers(Vec3 v);

// A channel, 8 bits at `shift`, of an sRGB colour as light, 0..1.
float light_of(uint32_t colour, int shift);

// Appends bytes, four of them aligned, as a buffer view; gives its number. `target` 0: neither vertices nor
// indices.
int add_view(tinygltf::Model& model, std::span<const uint8_t> bytes, int target);

// Appends a texture of a PNG, pixels of four channels; gives its number.
int add_texture(tinygltf::Model& model, std::span<const uint8_t> rgba, int width, int height);

// Appends an accessor over a view of its own; gives its number. `type` and `component` are TINYGLTF_TYPE_*
// and TINYGLTF_COMPONENT_TYPE_*.
template <class T>
int add_accessor(tinygltf::Model& model, const T& values, int type, int component, int target,
                 bool normalized = false) {
    std::span items(values);
    auto* bytes = reinterpret_cast<const uint8_t*>(items.data());
    tinygltf::Accessor accessor;
    accessor.bufferView = add_view(model, {bytes, items.size_bytes()}, target);
    accessor.type = type;
    accessor.componentType = component;
    accessor.normalized = normalized;
    auto size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component)) *
                                    tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    accessor.count = items.size_bytes() / size;
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

// Positions, which bear their extent. Not empty.
int add_positions(tinygltf::Model& model, std::span<const Vec3> positions);

}  // namespace flaneur
