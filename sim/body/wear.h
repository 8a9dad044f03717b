// What a body wears and carries, for its hands and arms.
#pragma once

#include <cstdint>

namespace flaneur {

// A backpack hangs on both shoulders, a shoulder bag by a strap from the left one to the right hip, a handbag
// in the left hand.
enum class Bag : uint8_t { none, backpack, shoulder_bag, handbag };

struct Wear {
    Bag bag = Bag::none;
    bool pockets = false;  // at the hips
    bool phone = false;    // in the right hand
    uint8_t spare = 0;     // so that all bytes are set
};

// How far the surface, clothes and all, is from the middle of the trunk, metres: there hands find it.
struct Girth {
    float hip = 0;    // aside, where trousers have their pockets
    float belly = 0;  // ahead of the hips' joint, from there to the navel
    float back = 0;   // behind it, at the same height
    float chest = 0;  // ahead of the upper chest's joint, below it
};

}  // namespace flaneur
