// Bars of the product that it does not meet yet. A test holds what is to a bound that nothing may pass, and
// says how far it is from its goal, in a line that ./tools/test repeats at the end.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace flaneur {

// `value` is at most `bound`; where it is more than `goal`, the rest is a debt.
inline void expect_at_most(const std::string& what, double value, double goal, double bound) {
    EXPECT_LE(value, bound) << what;
    if (value > goal) std::printf("DEBT %s: %.3g, goal <= %.3g\n", what.c_str(), value, goal);
}

}  // namespace flaneur
