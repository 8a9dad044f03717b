// From an implicit body to triangles: surface nets on a rectilinear grid, always a closed two-manifold, cut
// along the borders between materials and simplified. Lengths are in body heights.
#pragma once

#include <functional>
#include <vector>

#include "assets/people/shapes/field.h"

namespace flaneur {

struct FieldMesh {
    std::vector<Vec3> positions;
    std::vector<uint8_t>
        materials;  // one a vertex; border vertices stand twice at one place, once for each side
    std::vector<uint32_t> indices;  // triangles, counter-clockwise seen from outside
};

// Samples of the grid along each axis, rising. `half_x` holds the positive half only: the field is symmetric.
struct FieldGrid {
    std::vector<float> half_x, y, z;
};

// The zero level of the field, materials all 0.
FieldMesh polygonise(const Field& field, const FieldGrid& grid);

// What is seen of each layer: of its materials, the one with the smallest value in `out`.
using PaintDistances = std::function<void(const LayerDistances& layers, Vec3 p, std::span<float> out)>;

// Splits triangles where another layer comes to the surface, or another material of the same layer wins.
// `layer_of` tells each material's layer.
FieldMesh cut_materials(const FieldMesh& mesh, const Field& field, std::span<const Layer> layer_of,
                        const PaintDistances& paint);

// For each vertex, a number that those at one place share.
std::vector<uint32_t> place_numbers(const std::vector<Vec3>& positions);

// The triangles with what `hidden` tells of shown in `material` instead, without the borders between them.
// Adds the vertices that this takes.
std::vector<uint32_t> painted_over(FieldMesh& mesh, bool (*hidden)(uint8_t), uint8_t material);

// Down to about `triangles`, keeping the borders; `importance` maps a place to the space where errors are
// measured.
void simplify_mesh(FieldMesh& mesh, size_t triangles, const std::function<Vec3(Vec3)>& importance);

}  // namespace flaneur
