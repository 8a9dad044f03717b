// Those who drive: cars, vans, buses and bicycles on a city's lanes, and trams on its tracks. Each follows
// the one ahead by the intelligent driver model (Treiber, Hennecke & Helbing 2000), stops for lamps, for
// people on crossings or on their way onto one, for whatever is ahead on what it would sweep, and for those
// who go first at a junction; it leaves at a gate of the map and comes in at another, so that their number is
// kept.
//
// A quarter of them decides in each tick, all go on, one after the other; none moves a tick's way that would
// bring its box onto a body or another box.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/crowd/crowd.h"
#include "sim/lanes/roadway.h"

namespace flaneur {

enum class VehicleKind : uint32_t { car, van, bus, bicycle, tram };
inline constexpr int k_vehicle_kinds = 5;

// Metres; of the places counted back from the front of a section. A tram's sections are joined where both of
// their ends run along the track.
struct VehicleShape {
    float length, width, height;  // all sections together
    float front_axle, rear_axle;
    float wheel;         // radius
    float acceleration;  // m/s2, at most
    float comfort;       // m/s2 of braking as usual,
    float hardest;       // and as hard as one can, on dry ground; a tram's emergency brake (EN 13452-1)
    float fastest;       // m/s, whatever the limit
    uint32_t sections = 1;
};
inline constexpr uint32_t k_tram_sections = 5;
inline constexpr VehicleShape k_vehicle_shapes[k_vehicle_kinds] = {
    {4.28f, 1.76f, 1.47f, 0.82f, 3.42f, 0.31f, 1.6f, 1.7f, 7.5f, 30},
    {5.3f, 1.94f, 2.35f, 0.95f, 4.25f, 0.34f, 1.3f, 1.7f, 7.5f, 30},
    {11.6f, 2.5f, 3.05f, 2.6f, 8.4f, 0.48f, 1, 1.7f, 7.5f, 22},
    {1.76f, 0.56f, 1.75f, 0.34f, 1.41f, 0.34f, 0.8f, 1.7f, 7.5f, 6},
    {30, 2.4f, 3.4f, 0, 6, 0.3f, 1, 1.2f, 2.8f, 14, k_tram_sections},
};

// What it brakes for, or goes slowly.
enum class Brakes : uint32_t { no, ahead, lamp, crossing, people, junction, stop };

inline constexpr int k_route = 13, k_here = 6;  // lanes of a route; which of them it is on

// Plain, all of four bytes each.
struct Vehicle {
    VehicleKind kind = VehicleKind::car;
    uint32_t route[k_route];            // lanes it came by, is on and will take; k_no_lane: none
    float metres = 0;                   // of its front along the lane that it is on
    float speed = 0, acceleration = 0;  // m/s, m/s2
    float rolled = 0;                   // metres it has gone, of wheels
    float taste = 1;                    // times the limit that it likes to go
    Brakes brakes = Brakes::no;
    uint32_t whom = 0;             // number of the person or vehicle that it brakes for, or of people
    uint32_t wants = k_no_lane;    // the curve that it has come to,
    uint32_t granted = k_no_lane;  // and the one that it may enter
    uint32_t stood_since = 0;      // tick since which it stands; k_never: it moves
    uint32_t stays_until = 0;      // tick, at a stop
    uint32_t served = k_no_lane;   // the lane whose stop it has been at; of a tram which of Lanes::stops
    uint32_t turns = 0;            // chosen so far
};
inline bool is_there(const Vehicle& v) { return v.route[k_here] != k_no_lane; }

// Where it is drawn, and collides.
struct VehiclePlace {
    Vec3 middle;         // of the ground under it
    float heading = 0;   // yaw about +y
    float pitch = 0;     // radians, more than 0 uphill
    float steer = 0;     // of its front wheels, more than 0 to the left, radians
    float rolled = 0;    // metres
    float presence = 0;  // how much of it is seen, 0..1
};

struct Vehicles {
    std::shared_ptr<const RoadMap> map;          // null: nobody drives
    float traffic = 0;                           // see WorldOptions
    std::vector<uint8_t> takes_buses;            // by lane: a bus that goes there gets on
    std::vector<uint32_t> gates, tram_gates;     // lanes that one comes in by
    std::vector<Vehicle> all;                    // trams last,
    uint32_t first_tram = 0;                     // from this one on
    std::vector<VehiclePlace> places, previous;  // by section, after the last tick and the one before
    // Of a tick: by lane how many hold it, and how many metres of it are free from its start.
    std::vector<uint32_t> held;
    std::vector<float> free;
    std::vector<uint32_t> comers;    // who want to enter a junction
    std::vector<uint32_t> shown_as;  // by vehicle: which of Roadway::boxes is its first section
    uint32_t held_back = 0;          // measured, never read: how often one was stopped at the last moment
};
inline bool has_traffic(const Vehicles& vehicles) { return !vehicles.all.empty(); }

inline constexpr float k_usual_traffic = 0.5f;
inline constexpr float k_vehicles_a_kilometre = 24;  // of lane, in a rush hour: `traffic` 1
// Of track, then: one in 80 s where they go at 5 m/s, stops and all, as on trunk lines of several routes.
inline constexpr float k_trams_a_kilometre = 2.5f;

// Sets as many down as that makes on the lanes, where nobody is. Allocates.
void make_vehicles(Vehicles& vehicles, Crowd& crowd, std::shared_ptr<const RoadMap> map, float traffic,
                   uint64_t seed);
// A tick, after people have moved.
void step_vehicles(Vehicles& vehicles, Crowd& crowd, uint32_t tick, uint64_t seed);
// What people see of them, made anew; after their state was set from outside.
void show_vehicles(Vehicles& vehicles, Crowd& crowd);

// So many metres ahead of its front, less than 0 behind it.
OnLane ahead_of(const Lanes& lanes, const Vehicle& vehicle, float metres);
VehiclePlace place_of(const Lanes& lanes, const Vehicle& vehicle, uint32_t section = 0);
VehicleBox box_of(const Vehicle& vehicle, const VehiclePlace& place);
// Where all are by their lanes, after their state was set from outside.
void find_places(Vehicles& vehicles);
VehiclePlace place_between(const VehiclePlace& before, const VehiclePlace& now, float between);

// Its sections in Vehicles::places: the first, and how many.
inline uint32_t sections_of(const Vehicle& v) {
    return k_vehicle_shapes[static_cast<size_t>(v.kind)].sections;
}
inline uint32_t first_section(const Vehicles& vehicles, uint32_t number) {
    const uint32_t first = vehicles.first_tram;
    return number < first ? number : first + (number - first) * k_tram_sections;
}

uint64_t hash_vehicles(const Vehicles& vehicles);

}  // namespace flaneur
