// What goes along with people, as meshes that move by joints of their own: dogs, wheelchairs, umbrellas,
// canes, instruments. Each is made for one frame, which sim/alongside/alongside.h says of what is held.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/alongside/dog.h"
#include "sim/base/vec.h"

namespace flaneur {

struct ThingVertex {
    Vec3 position, normal;
    uint32_t colour = 0xffffffff;  // sRGB, R in the lowest byte
    bool tinted = false;           // takes the colour of Tint::top too
    uint8_t joints[4] = {0, 0, 0, 0};
    uint8_t weights[4] = {255, 0, 0, 0};  // sum to 255
};

struct ThingMesh {
    std::vector<ThingVertex> vertices;
    std::vector<std::vector<uint32_t>> lods;  // triangles, finest first
};

inline constexpr uint32_t k_coats = 3;
// A dog of a breed, withers 1 high, in its bind pose; its joints are by DogJoint.
std::vector<ThingMesh> make_dog_meshes(Breed breed);  // one for each of its coats
// The frame is joint 0; left and right wheel are 1 and 2, about their axle in the origin. For a body of 1.72
// m, the ground below the axle in the origin of joint 0.
ThingMesh make_wheelchair();
ThingMesh make_white_cane();
ThingMesh make_umbrella();
ThingMesh make_guitar();
ThingMesh make_violin();
ThingMesh make_bow();
// The right hand's half is joint 0, the left one's joint 1.
ThingMesh make_accordion();
ThingMesh make_hat_on_ground();
// A cord of so many joints, each a ring of it square to its y.
inline constexpr int k_lead_joints = 24;
ThingMesh make_lead();

}  // namespace flaneur
