// The tests of RiMEA 4 ("Guideline for Microscopic Evacuation Analysis") and NIST Technical Note 1822 (Ronchi
// et al. 2013), on floors made for them, and what comes of them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "assets/trajectories/trajectories.h"
#include "sim/base/result.h"
#include "tools/flaneur/validate/flow.h"

namespace flaneur {

enum class Validity : uint8_t { passed, missed };

struct ValidationFinding {
    std::string what, expected, measured;
    Validity verdict = Validity::missed;
};
using Findings = std::vector<ValidationFinding>;

// What is brought along and handed on.
struct Measured {
    std::string name;  // of the file
    Trajectories tracks;
};
struct ValidationNotes {
    std::vector<Measured> measured;
    std::vector<MeanFlow> diagram;  // ours, by rising density, once R4 has run
};

struct ValidationTest {
    std::string_view id, name, set_up;
    Result<Findings> (*run)(ValidationNotes& notes);
};
// In the order in which they are told.
std::span<const ValidationTest> validation_tests();

// walks.cpp
Result<Findings> test_corridor(ValidationNotes&);
Result<Findings> test_stairs(ValidationNotes&);
Result<Findings> test_premovement(ValidationNotes&);
Result<Findings> test_corner(ValidationNotes&);
Result<Findings> test_ages(ValidationNotes&);
// rooms.cpp
Result<Findings> test_exits(ValidationNotes&);
Result<Findings> test_bottleneck(ValidationNotes&);
Result<Findings> test_large_corner(ValidationNotes&);
// flows.cpp
Result<Findings> test_diagram(ValidationNotes&);
Result<Findings> test_ring(ValidationNotes&);
Result<Findings> test_counterflow(ValidationNotes&);
Result<Findings> test_groups(ValidationNotes&);
// rerun.cpp
Result<Findings> test_rerun(ValidationNotes&);

// For measured ways: where they are measured, and how they are rerun.
// A square of 2 m about the middle ones of all x and z: where people are densest.
Rectangle busiest_square(const Trajectories& tracks);
// The walkable area of the file or, where it has none, a rectangle 0.2 m beyond all but 2 in a thousand of
// the places on each side.
std::vector<WalkablePolygon> area_or_box(const Trajectories& tracks);
// Whether people go from end to end of it, nine of ten by more than half of its length, and fill six tenths
// of its width everywhere.
bool is_corridor(const Trajectories& tracks);

// A finding of a number that is to lie within [low, high].
ValidationFinding within(std::string what, double value, double low, double high, const char* unit);
// "12.3 s"
std::string told_number(double value, const char* unit);
Validity verdict_of(bool is_met);

}  // namespace flaneur
