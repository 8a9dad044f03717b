// Blend trees: poses and clips as points of one or two parameters, trees of them blended with each other, and
// layers on top.
//
// After Rosen, Animation Bootcamp (Overgrowth; GDC 2014) and the implementation guide to procedural
// animation, section 3.6: a few key poses stand at even distances along a parameter and the pose follows a
// curve through them. A key pose is a clip of one key.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/animation/clip.h"

namespace flaneur {

// A point of a tree. Nodes are data: a tree is made by writing them down.
struct BlendNode {
    enum class Kind : uint8_t {
        clip,  // plays clips[first] at the phase inputs[input[0]]
        grid,  // columns x rows children at even distances: inputs[input[0]] in [0, 1] runs along a row,
               // inputs[input[1]] from row to row (not read where there is one row)
    };
    Kind kind = Kind::clip;
    Curve curve = Curve::linear;  // of a grid, through its children; clips have their own
    uint16_t input[2] = {0, 0};
    uint16_t first = 0;  // the clip, or the first child; children lie side by side, behind their parent
    uint16_t columns = 1, rows = 1;
};

// One tree's result, laid over the layers below it.
struct BlendLayer {
    uint16_t root = 0;  // its nodes reach from here to the next layer's root
    // An additive layer turns each joint further, by clips of make_additive_clip; another takes its place.
    bool additive = false;
    uint16_t weight = 0;      // input: 0 leaves what is below as it is .. 1; not read of the first layer
    std::vector<float> mask;  // by joint, a factor on the weight; empty: 1. The offset follows joint 0.
};

inline constexpr size_t k_most_nodes = 64, k_most_leaves = 32;  // in a tree; in a layer

struct BlendTree {
    std::vector<Clip> clips;  // of one skeleton
    std::vector<BlendNode> nodes;
    std::vector<BlendLayer> layers;  // the first is the base
    uint16_t inputs = 0;             // values a character
};

// Refuses, in a sentence, what evaluate_blends could not walk: nodes with no or two parents, children before
// their parents, inputs and clips that are not there, clips of different skeletons, too much of anything.
Result<void> check_tree(const BlendTree& tree);

// Poses blocks [begin, end): block b reads tree.inputs rows from inputs + b * tree.inputs and writes
// local_rows(joints) from out + b * local_rows(joints). `tree` has passed check_tree. Inputs that are no
// number count as 0. A pure function, the same bits on every instruction set; nothing is allocated.
void evaluate_blends(const BlendTree& tree, const LaneRow* inputs, size_t begin, size_t end, LaneRow* out);

}  // namespace flaneur
