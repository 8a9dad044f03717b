// Characters that levels of detail used to break, made of balls about bones.
#pragma once

#include <string>
#include <vector>

#include "assets/character.h"

namespace flaneur {

// How a ball looks, row by row from its foot: one colour or place on a texture for each triangle.
struct BallLook {
    std::vector<uint32_t> colours = {0xffffffffu};  // in turn
    std::vector<float> swatches;                    // u, in turn; of v the middle
    bool is_mapped = false;                         // all of the texture once around
    uint16_t texture = CharacterVertex::k_no_texture;
};

// A body without a mesh, bound as it stands.
Character bare_body();

// A ball of some rows and columns between two places, that goes with a joint. Neighbouring rows of another
// colour or swatch share no vertices.
void add_ball(Character& c, Joint joint, Vec3 from, Vec3 to, float radius, int rows, int columns,
              const BallLook& look);

// The place that a joint's bone reaches to.
Vec3 end_of(const Character& c, Joint joint);

// One ball, or `each`, along every bone; looks in turn.
Character ball_man(int each, int rows, int columns, const std::vector<BallLook>& looks);

// 256 x 1, neighbours far apart in colour.
Texture palette_texture();

// Numbers what hangs together, in CharacterVertex::spare, which copies of a vertex keep.
void number_parts(Character& c);

// Of a character whose parts were numbered. Checks each level against the finest: every part of two pixels or
// more, where the level is seen from nearest, is there and as large as it was, and shows no colour that it
// did not.
void expect_whole(const Character& c, int colour_tolerance);

}  // namespace flaneur
