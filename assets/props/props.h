// Street furniture and trees as small meshes made by formula.
#pragma once

#include <cstdint>
#include <optional>
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
    white,
    // Lenses that light by turns: of those who drive, and of people.
    drive_red,
    drive_amber,
    drive_green,
    walk_red,
    walk_green
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

// Where a signal that works shows which lamps.
struct SignalHeads {
    float walk_yaw = 0;              // to those who want to cross,
    std::optional<float> drive_yaw;  // and to those who drive, if it stands where they see it
};
SignalHeads heads_of(const Prop& signal, const Crossing& crossing);
// In place of what add_prop() makes of a signal.
void add_working_signal(PropMesh& mesh, const Prop& signal, const SignalHeads& heads);

}  // namespace flaneur
