// A yard of 24 by 12 m in which people do things with their hands: a brick wall with four doors, three low
// walls, and tables with boxes and crates; see sim/deeds/deeds.h. It can lie beside another stage.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "assets/city.h"
#include "sim/deeds/deeds.h"
#include "sim/movers/movers.h"
#include "sim/sim.h"

namespace flaneur {

inline constexpr Vec2 k_yard_half{12, 6};  // metres

// What stands in it, its floor too, with its middle `at`; level at height 0.
void add_yard(Scenery& scenery, Vec2 at);
Things yard_things(Vec2 at);
// Who is there, some of the world's kinds.
std::vector<DoerPlan> yard_plans(std::span<const Kind> kinds, Vec2 at);
std::shared_ptr<const Ground> make_yard_ground(Vec2 at);
// Its parcels, then of each door its leaf and its levers, as lead_movers() leads them.
std::vector<Mover> yard_movers(const Things& things);

// A yard by itself, with a way before it.
City build_yard(uint64_t seed);

}  // namespace flaneur
