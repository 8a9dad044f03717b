// What people may do where they stay, and where: how many do, and the places that a city has for it.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// How many do what, 0..1; where all are 0 nobody does anything and nothing else changes.
struct PastimeShares {
    float sitting = 0;  // of those who stop beside a free seat; of those who pass one, a tenth of that
    float leaning = 0;  // of those who stop beside a wall or a railing; of who passes one, a tenth of that
    float phones = 0;   // of all, at any time; 0.1 .. 0.3 is usual (Thompson et al. 2013)
    // Of those who would look into shop windows that they pass: at 1 some 15 % glance and 3.5 % stop, by our
    // own estimate.
    float windows = 0;
    float queues = 0;  // of those who pass a place of service, who line up there
    // Of those who go alone: who look about as in a strange town, and of each trip, who hurry and who stroll.
    float tourists = 0, hurrying = 0, strolling = 0;
    bool operator==(const PastimeShares&) const = default;
};
inline bool is_any(const PastimeShares& s) {
    return s.sitting > 0 || s.leaning > 0 || s.phones > 0 || s.windows > 0 || s.queues > 0 ||
           s.tourists > 0 || s.hurrying > 0 || s.strolling > 0;
}

// What a seat is a part of.
enum class SeatOn : uint32_t { bench, fountain, planter, wall, steps };

// Room for one to sit.
struct Seat {
    Vec3 edge;           // the middle of its front edge, on top
    Vec2 facing{0, 1};   // unit: where one looks who sits there
    float depth = 0.4f;  // metres from the edge to what is behind
    uint32_t bench = 0;  // seats side by side have the same
    // 0: at an end, 1: between two; who comes takes an end first (Whyte, "The Social Life of Small Urban
    // Spaces", 1980).
    uint32_t rank = 0;
    SeatOn on = SeatOn::bench;
    float tread = 0;  // metres: of the steps below it, on which feet stand; 0: on level ground
};
// Whether one may lean back there.
inline bool has_back(const Seat& seat) { return seat.on == SeatOn::bench; }

// Room for one to put both hands on, and look out over.
struct Railing {
    Vec3 at;            // on top, its edge on this side
    Vec2 facing{0, 1};  // unit, outward: where one looks
};

// Glass that one looks through.
struct ShopWindow {
    Vec3 at;             // its middle, on the ground
    Vec2 out{0, 1};      // unit, to the street
    float width = 1.5f;  // metres
};

// Where one is served after another.
struct Service {
    Vec3 at;             // where who is served stands
    Vec2 facing{0, 1};   // unit: to the counter
    Vec2 along{1, 0};    // unit: from there to the end of the line
    float seconds = 25;  // that it takes to serve one, on average
};

struct PastimePlaces {
    std::vector<Seat> seats;
    std::vector<Railing> railings;
    std::vector<ShopWindow> windows;
    std::vector<Service> services;
    std::vector<Vec3> sights;  // that one takes pictures of; about the middle of each
    std::vector<Vec3> doors;   // before which nobody leans
};

}  // namespace flaneur
