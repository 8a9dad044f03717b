// The past of a world, kept in the background: states of it (sim/state.h), packed by a thread of their own,
// within so many bytes. What lies between two of them is had again by stepping on from the earlier one: the
// simulation is deterministic.
//
// Where memory runs short, what is kept thins out: the farther from the newest, the wider apart. The first
// state stays for good, and so do those that were kept by keep_for_good().
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sim/base/result.h"
#include "sim/world.h"

namespace flaneur {

struct History;
struct HistoryDelete {
    void operator()(History*) const;
};
using HistoryPtr = std::unique_ptr<History, HistoryDelete>;

inline constexpr size_t k_history_bytes = size_t{512} << 20;
inline constexpr uint32_t k_history_ticks = 60;  // between two states, as long as there is room

// `most_bytes`: of all that is kept, work in progress included; only the first state and the newest are kept
// whatever they take.
HistoryPtr make_history(size_t most_bytes = k_history_bytes);
void set_most_bytes(History& history, size_t most_bytes);

// To be called after every tick, and once before the first: keeps a state where one is due. Copies it in
// about a millisecond for 2000 people, and never waits: where packing lags behind, one is left out.
void follow(History& history, const World& world);
// Keeps the state of now, if it is not kept yet and packing does not lag behind.
void keep_now(History& history, const World& world);

// The world has been changed by other than its ticks (people added, goals given): what was kept of later
// ticks is no longer to come, and the way there from earlier ones leads through this state, which is kept for
// good.
void keep_for_good(History& history, const World& world);
// The world is another one, or stands on other ground: nothing of before can be had again.
void forget(History& history);

// Of those kept, rising.
std::vector<uint32_t> kept_ticks(const History& history);
// The latest at or before `tick`.
std::optional<uint32_t> kept_before(const History& history, uint32_t tick);
// Whether the one of this tick is kept for good: no other way leads to it.
bool is_for_good(const History& history, uint32_t tick);
// Loads the one that is kept of `tick`.
Result<void> restore(const History& history, uint32_t tick, World& world);

struct HistoryUse {
    size_t states = 0;
    size_t bytes = 0;         // of memory, work in progress included
    size_t state_bytes = 0;   // of the last state, as it was copied,
    size_t packed_bytes = 0;  // and what it took once it was packed
    double copy_ms = 0, pack_ms = 0;
};
HistoryUse history_use(const History& history);

// Waits until all is packed. For tests and measurements.
void settle(const History& history);

}  // namespace flaneur
