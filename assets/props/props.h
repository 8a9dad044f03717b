// Street furniture and trees as small meshes made by formula.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/city.h"
#include "sim/base/vec.h"

namespace flaneur {

enum class PropPart : uint8_t {
    trunk,
    leaves,
    metal,
    wood,
    light,
    paint,  // of a car: one of a few quiet colours
    glass,
    tyre,
    alloy,
    stone,
    bronze,
    water,
    foam,
    red,
    green,
    sign,
    white
};

// Triangles wound counter-clockwise from outside, in the world. Each vertex has its own normal; a triangle's
// three vertices are of one part.
struct PropMesh {
    struct Vertex {
        Vec3 position, normal;
        PropPart part;
        float shade;  // lightness, about 1: leaves within the crown and near its foot are darker
    };
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
    bool is_far =
        false;  // what is added is for eyes to whom a metre is 20 pixels or less: a third of the triangles
};

// Appends a prop to `mesh`: some 500 triangles for a tree or a car, twice as many for a fountain, under 300
// for the others.
void add_prop(PropMesh& mesh, const Prop& prop);

}  // namespace flaneur
