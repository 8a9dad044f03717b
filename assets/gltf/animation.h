// One animation of a glTF file: curves for nodes, and the nodes where the curves put them.
#pragma once

#include <string>
#include <vector>

#include "assets/gltf/read.h"

namespace flaneur {

struct GltfTrack {
    enum class Path : uint8_t { translation, rotation, scale };
    enum class Way : uint8_t { linear, step, cubic_spline };
    int node = -1;
    Path path = Path::translation;
    Way way = Way::linear;
    std::vector<float> times;   // rising, seconds
    std::vector<float> values;  // 3 or 4 a key; with cubic_spline in-tangent, value and out-tangent
};

struct GltfAnimation {
    std::string name;
    std::vector<GltfTrack> tracks;
    float begin = 0, end = 0;  // seconds
};

// Morph weights and channels without a node are left out. Refuses, in a sentence, what is broken.
Result<GltfAnimation> read_animation(const tinygltf::Model& model, size_t index);

// By node: to scene, at `time`; before and after its keys a track stays.
std::vector<Affine> pose_nodes(const GltfScene& scene, const GltfAnimation& animation, float time);

// The rotation in a transform that may scale and shear.
Quat rotation_in(const Affine& a);

}  // namespace flaneur
