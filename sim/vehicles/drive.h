// How those who drive decide. Private to sim/vehicles.
#pragma once

#include "sim/vehicles/vehicles.h"

namespace flaneur {

inline const VehicleShape& shape_of(const Vehicle& v) {
    return k_vehicle_shapes[static_cast<size_t>(v.kind)];
}

// What is ahead on the way of a vehicle: so far from its front, with that speed along its way.
struct Ahead {
    float gap = 1e9f, speed = 0;
    Brakes why = Brakes::no;
    uint32_t whom = 0;
};

// m/s2 by the intelligent driver model, towards what is ahead; free of it: without. `wanted`: m/s.
float driven(const VehicleShape& shape, float speed, float wanted, const Ahead& ahead, float keeps);

// The nearest of people on the carriageway and of vehicles, on what it would sweep within so many metres.
Ahead look_ahead(const Vehicles& vehicles, const Crowd& crowd, uint32_t number, float far);

// Whom it gives way to on a crossing: how many, of those on it or, unless it insists, about to step on it.
int count_on_crossing(const Crowd& crowd, const Crossing& crossing, Vec2 lane_at, bool insists);

// What it does in the next ticks: how it brakes or speeds up, and whether it wants to enter a junction.
void decide(Vehicles& vehicles, const Crowd& crowd, uint32_t number, uint32_t tick);

// Of Vehicle::whom, of one that has given way on a crossing for long: others do not step before it any more.
inline constexpr uint32_t k_insists_on_it = 1u << 16;

// The number of seconds it has stood.
float stood(const Vehicle& vehicle, uint32_t tick);

// Who holds which lanes, and how much of each is free.
void find_held(Vehicles& vehicles);
// Lets those enter junctions who may, one after the other.
void grant(Vehicles& vehicles, uint32_t tick);

// Chooses lanes until the route is full or ends.
void extend_route(const Vehicles& vehicles, Vehicle& vehicle, uint32_t number, uint64_t seed);

}  // namespace flaneur
