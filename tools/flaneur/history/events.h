// What is worth a look in a run: found after each tick, kept as a list by time.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/world.h"

namespace flaneur {

enum class EventKind : uint8_t {
    stuck,      // somebody has not got on for Bounds::stuck_seconds
    crowding,   // a cell of k_crowd_cell is denser than Bounds::density
    near_miss,  // two bodies are nearer than Bounds::gap, and close in faster than Bounds::closing
    arrival,    // the first of all to reach a goal, and each trip that is faster than all before
};
inline constexpr int k_event_kinds = 4;
inline constexpr const char* k_event_names[k_event_kinds] = {"stuck", "crowding", "near miss", "arrival"};

inline constexpr float k_crowd_cell = 3;         // metres, edge
inline constexpr size_t k_most_events = 10'000;  // beyond these the oldest go

struct Event {
    uint32_t tick = 0;
    EventKind kind{};
    uint32_t walker = 0;        // whom it is about, by slot,
    uint32_t other = k_nobody;  // and the other one of a near miss
    Vec3 place;
    float value = 0;  // stuck: seconds; crowding: people/m2; near miss: metres between bodies; arrival: m/s
};
// "near miss, 0.07 m"
std::string event_text(const Event& event);

// From when on something is an event. Changes hold for what comes after.
struct EventBounds {
    float stuck_seconds = 6;  // noticed every 3 s
    float density = 1;        // people/m2
    float gap = 0.05f;        // metres between the rooms that bodies keep to themselves
    float closing = 0.5f;     // m/s
};

// Of one world. Where people roam round a compound nothing is found: they neither have goals nor meet.
struct Watch {
    EventBounds bounds;
    std::vector<Event> events;  // by tick
    uint32_t seen = 0;          // the last tick that was looked at
    bool has_begun = false;

    // What goes on, so that nothing is told twice.
    struct Person {
        uint32_t generation = 0, trip = 0, began = 0,
                 missed = 0;  // ticks of the trip and of the last near miss
        Vec2 from;            // where the trip began
        bool is_stuck = false, has_arrived = false;
    };
    std::vector<Person> people;   // by slot
    std::vector<uint64_t> dense;  // cells, rising
    bool has_anybody_arrived = false;
    float fastest = 0;  // m/s, from start to goal as the crow flies, of trips of 20 m and more

    // Scratch.
    std::vector<uint32_t> first, sorted;
    std::vector<uint64_t> dense_now;
};

// Looks at the world after a tick. A tick that was looked at before is left out, so that going back and
// coming again tells nothing twice; but none may be left out. Takes some 0.2 ms for 2000 people every fourth
// tick, and little else.
void watch(Watch& watch, const World& world);

// The first of the kinds that `wants` says, by EventKind, after `tick`; or the last before it.
using EventFilter = std::array<bool, k_event_kinds>;
const Event* event_after(std::span<const Event> events, uint32_t tick, const EventFilter& wants);
const Event* event_before(std::span<const Event> events, uint32_t tick, const EventFilter& wants);

}  // namespace flaneur
