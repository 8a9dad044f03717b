// One chain at a time by each of five ways of inverse kinematics, to be compared: how many iterations they
// take, and what they do with a chain meanwhile. People are posed by two_bone-inl.h and, many at once, by
// solve.h.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sim/base/vec.h"

namespace flaneur {

enum class Solver : uint32_t {
    fabrik,     // fabrik-inl.h
    ccd,        // cyclic coordinate descent (Wang & Chen 1991): joint by joint from the last, turned so that
                // the end points at the target
    transpose,  // Jacobian transpose (Wolovich & Elliott 1984), with the step that Buss (2004) takes
    damped,     // damped least squares (Wampler 1986; Buss 2004)
    two_bone,   // two_bone-inl.h, in closed form, for chains of three joints alone
};
inline constexpr int k_solver_count = 5;
inline constexpr std::string_view k_solver_names[k_solver_count] = {"FABRIK", "CCD", "Jacobian transpose",
                                                                    "damped least squares", "two bones"};

// When to stop: within so many metres of the target, or after so many iterations.
struct Patience {
    float tolerance = 0.001f;
    int iterations = 2000;
    bool operator==(const Patience&) const = default;
};
struct Solved {
    int iterations = 0;
    float off = 0;  // metres from the target
};

// Moves all joints but the first so that the last comes to the target. `bones[i]` is the length from
// places[i] to places[i + 1]; it is kept to rounding. 2 to k_most_chain_joints joints, any of which may turn
// any way. The same input gives the same bits everywhere.
Solved solve_chain(Solver solver, std::span<Vec3> places, std::span<const float> bones, Vec3 target,
                   const Patience& patience);

}  // namespace flaneur
