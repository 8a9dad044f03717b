// The walks that a person is put through, measured and judged.
#pragma once

#include <string>
#include <vector>

#include "tools/flaneur/gait/bars.h"

namespace flaneur {

// Bars that do not apply to who was measured, which is why they were not judged.
struct LeftOut {
    std::vector<std::string> quantities;
    std::string why;
};

struct Report {
    std::string name;   // a word, for files
    std::string title;  // for people
    Curves curves;
    Quantities quantities;
    std::vector<Verdict> verdicts;
    uint64_t poses = 0;    // the hash of its walks
    std::string person{};  // whose they are, a word, for files; empty: a crowd's
    std::vector<LeftOut> left_out{};
};

// Stands, walks straight on level ground at `speed` and stands again, in `seconds`. A run if that is the
// speed of one.
Report try_level(const Person& person, double speed, double seconds);
// Stands for so many seconds.
Report try_stand(const Person& person, double seconds);
// Walks at `speed` and turns by `degrees`.
Report try_turn(const Person& person, double speed, double degrees);
// Round circles that ask for ever sharper bends: the exponent of the speed against the curvature, where it
// slows the walk.
Report try_bends(const Person& person, double speed);
// Up or down a long flight, by one who walks at `speed` on the level.
Report try_stairs(const Person& person, double speed, bool up, double riser, double tread);
// Up (or down) ground that rises so many metres in a hundred.
Report try_slope(const Person& person, double speed, double percent);
// Over one kerb up and one down.
Report try_kerb(const Person& person, double speed, double height);
// A leap on level ground, at `speed`, over a puddle so wide, metres.
Report try_leap(const Person& person, double speed, double width);
// From a walk at `speed` to a run at 3.1 m/s for a leg of 0.9 m, and back.
Report try_change(const Person& person, double speed);
// The lowest of the speeds 1.6, 1.7 .. 2.8 m/s at which both feet are in the air for a while.
Report try_gaits(const Person& person);

}  // namespace flaneur
