// What a built-in person wears and carries beside clothes: hats, glasses, bags, a phone, a stick.
#pragma once

#include <vector>

#include "assets/people/shape.h"
#include "assets/people/shapes/solid.h"

namespace flaneur {

// A piece, the colours it shows, and the joint that it moves with; -1: it lies on cloth and moves with that.
struct Accessory {
    SolidMesh solid;
    Tint tint = Tint::none;
    uint32_t colour = 0xffffffff;
    int joint = -1;
    bool painted_afar = false;  // coarse levels have it painted on instead
    // What swings does so about a place of that joint; whole, or more and more between two distances from
    // there.
    int follower = -1;
    Vec3 pivot{};
    float from = 0, to = 0;
};

// The rim of the left glass, head heights, counter-clockwise from ahead; of glasses so much wider and taller.
std::vector<Vec3> glasses_rim(const Figure& figure, int corners, float wider);
inline constexpr float k_glasses_thick = .0098f;  // half of the rim's, head heights
uint32_t glasses_colour(const Figure& figure);

bool has_stick(const Figure& figure);
// Where its tip is in the bind pose, body heights.
Vec3 stick_tip(const Figure& figure);

std::vector<Accessory> make_accessories(const Figure& figure, const Field& field);

}  // namespace flaneur
