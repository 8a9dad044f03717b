// What drives, as meshes whose wheels are pieces of their own.
#pragma once

#include <span>

#include "assets/props/props.h"

namespace flaneur {

// A tram's sections are models of their own: with doors, and on bogies at both ends and below the collector.
enum class VehicleModel : uint8_t {
    hatchback,
    saloon,
    estate,
    van,
    bus,
    bicycle,
    tram_head,
    tram_middle,
    tram_collector,
    tram_tail
};
inline constexpr int k_vehicle_models = 10;
inline bool is_tram(VehicleModel model) { return model >= VehicleModel::tram_head; }

// From the middle of the ground below: x to the left, z ahead, metres.
struct VehicleWheel {
    Vec3 hub;
    float radius = 0.31f;
    bool steers = false;
};
std::span<const VehicleWheel> wheels_of(VehicleModel model);

// All but its wheels, and the ground below darkened. Lamps at its end are PropPart::red, those at its front
// PropPart::light.
void add_vehicle(PropMesh& mesh, VehicleModel model);
// A wheel about its hub, which turns about x.
void add_wheel(PropMesh& mesh, VehicleModel model, const VehicleWheel& wheel);

// The cranks of a bicycle and its pedals, about RiderHolds::crank; the left one ahead.
void add_cranks(PropMesh& mesh);

// Where who rides a bicycle sits and holds on, and what its pedals turn about: as places of wheels.
struct RiderHolds {
    Vec3 saddle{0, 0.92f, -0.24f}, grip{0.24f, 1.02f, 0.38f}, crank{0, 0.3f, -0.04f};
    float crank_length = 0.17f, pedal_aside = 0.11f;
};

}  // namespace flaneur
