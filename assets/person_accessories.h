// What a built-in person wears and carries beside clothes: hats, glasses, bags, a phone, a stick.
#pragma once

#include <vector>

#include "assets/person_shape.h"
#include "assets/person_solid.h"

namespace flaneur {

// A piece, the colours it shows, and what it moves with: one joint, or, for what lies on cloth, the skin
// weights of `layer`.
struct Accessory {
    Solid solid;
    Tint tint = Tint::none;
    uint32_t colour = 0xffffffff;
    int joint = -1;
    Layer layer = layer_top;
};

std::vector<Accessory> make_accessories(const Figure& figure, const Field& field);

}  // namespace flaneur
