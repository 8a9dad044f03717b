// The cheapest ways between gates, in microseconds. Private to sim/navigation.
//
// Customizable contraction hierarchies (Dibbelt, Strasser and Wagner, "Customizable contraction hierarchies",
// 2016). Gates are taken out one after the other (dissection.h), and those that were joined through one are
// joined by shortcuts instead: that depends on the mesh alone. What a shortcut costs is the cheaper of the
// way straight on and of those through gates taken out before; so other costs for the same mesh are soon put
// in. From any gate the shortcuts to gates taken out later reach, up a tree, all gates that a cheapest way
// can be found through: no queue, no field, no bound on how far it is.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "sim/navigation/gates.h"
#include "sim/navigation/string_pulling.h"

namespace flaneur {

inline constexpr uint32_t k_no_gate = ~0u;

// Gates are numbered by rank here: in the order in which they are taken out. Of a rank's shortcuts the first
// leads to its parent in the tree, and the others to ranks farther up from there.
struct Shortcuts {
    std::vector<uint32_t> rank_of, gate_of;  // by gate, by rank
    std::vector<uint32_t> first;             // of rank r: those numbered first[r] .. first[r + 1] - 1,
    std::vector<uint32_t> to;                // which lead to these ranks, in rising order,
    std::vector<uint16_t> to_depth;          // of which so many lie farther up
    std::vector<uint16_t> depth;             // by rank
    uint32_t height = 0;                     // of the tree: more than any depth
};
Shortcuts find_shortcuts(const Gates& gates, int threads);

// What each shortcut costs, and the rank through which it leads, or k_no_gate.
struct ShortcutCosts {
    std::vector<float> costs;
    std::vector<uint32_t> through;
};
// `wheels`: no way leads over steps. `slow`, one a polygon, is what costs there are times; none: 1.
ShortcutCosts find_costs(const Gates& gates, const Shortcuts& shortcuts, bool wheels,
                         std::span<const float> slow = {});
// The same bit by bit. First without costs; then those of the ways straight on through polygons [begin, end);
// once all of these are put in, through ranks [begin, end), in rising order.
void forget_costs(const Shortcuts& shortcuts, ShortcutCosts& costs);
void put_in_polygons(const Gates& gates, const Shortcuts& shortcuts, ShortcutCosts& costs, uint32_t begin,
                     uint32_t end, bool wheels, std::span<const float> slow);
void put_in_ranks(const Shortcuts& shortcuts, ShortcutCosts& costs, uint32_t begin, uint32_t end);

// The cheapest ways from one end to the gates up the tree, by depth.
struct Climb {
    std::vector<float> costs;
    std::vector<uint32_t> ranks;
    std::vector<uint32_t> by;    // the shortcut that came there, or k_no_shortcut,
    std::vector<uint16_t> from;  // and from which depth
};
inline constexpr uint32_t k_no_shortcut = ~0u;

struct Unfolding {
    uint32_t shortcut, from, to;  // ranks
};

// What one thread's searches write.
struct WaySearch {
    Climb up, down;                 // from the start; from the goal
    std::vector<Unfolding> todo;    // the next one last
    std::vector<uint32_t> way;      // gates
    std::vector<Doorway> doorways;  // the same as they are passed
    std::vector<uint32_t> reached;  // polygons
    std::vector<uint32_t> seen;     // by polygon: when last
    uint32_t times = 0;             // that anything was looked for
};
std::unique_ptr<WaySearch> make_search(const Gates& gates, const Shortcuts& shortcuts);

struct WayEnds {
    Vec3 from, to;
    uint32_t from_polygon, to_polygon;  // numbers, not the same
};

// The gates of the cheapest way, from first to last; none where none leads there. Valid until the next
// search.
std::span<const uint32_t> cheapest_way(const Gates& gates, const Shortcuts& shortcuts,
                                       const ShortcutCosts& costs, WaySearch& search, const WayEnds& ends);

}  // namespace flaneur
