// The dais behind the gallery's plinths, on which figures show what bodies do: pairs that walk in step, with
// a technique on the left and without it on the right, over stairs, a slope, rubble, along a wall and a rail,
// and who stands and looks about; the thirteen key poses in a row; and round all of it two bodies that these
// make, one along curves and one straight from key to key.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "assets/city.h"
#include "sim/figures/figures.h"
#include "sim/sim.h"

namespace flaneur {

// What is seen of it, within this area of the ground plane.
void build_dais(Scenery& scenery, Vec2 low, Vec2 high);
// What figures stand on and touch.
std::shared_ptr<const Ground> make_figure_ground();
// Whom they are like: a grown man of `kinds` who carries and pushes nothing, a woman for every other pair.
std::vector<FigurePlan> make_figure_plans(std::span<const Kind> kinds);

}  // namespace flaneur
