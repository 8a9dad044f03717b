#include "tools/flaneur/validate/tests.h"

#include "tools/flaneur/plot/plot.h"

namespace flaneur {

namespace {

constexpr ValidationTest k_tests[] = {
    {"R1", "a corridor", "corridor 2 x 40 m, one person who likes 1.33 m/s", test_corridor},
    {"R2/3", "stairs up and down",
     "stairs 2 m wide, 10 m along the slope (0.17 x 0.29 m steps), one person up, one down", test_stairs},
    {"R4", "the fundamental diagram",
     "corridor 5 m wide, crowds 60 m long set down evenly and sent off at once; over 10 m of their front "
     "half, "
     "8 to 18 s later",
     test_diagram},
    {"R5", "premovement times", "room 8 x 5 m, exit 1 m, 10 people who set off after 10 to 100 s",
     test_premovement},
    {"R6", "round a corner", "20 people round the corner of a corridor 2 m wide", test_corner},
    {"R7", "speeds by age", "400 adults of 20 to 80 years, half of them women, alone over 20 m", test_ages},
    {"R9", "many exits and few", "room 30 x 20 m, 1000 people, exits of 1 m: four, then two", test_exits},
    {"R12", "bottlenecks", "room 10 x 10 m, 150 people, necks of 0.8 to 2.4 m", test_bottleneck},
    {"R15", "a large crowd round a corner",
     "500 people, corridor 6 m wide: round a corner, straight by its inner way, straight by its outer way",
     test_large_corner},
    {"R16", "single file", "ring of 26 m, too narrow to pass, people who like 1.24 m/s", test_ring},
    {"N2.8", "counterflow",
     "rooms 10 x 10 m joined by a corridor 10 x 2 m, 100 people one way, 0/10/50/100 the other",
     test_counterflow},
    {"N2.9", "groups",
     "five who like 0.8 to 1.6 m/s walk 38 m and through a door of 1.2 m, alone and as a group", test_groups},
    {"BI", "a measured corridor again",
     "those who are in each --measured corridor, entering when and where they did", test_rerun},
};

}  // namespace

std::span<const ValidationTest> validation_tests() { return k_tests; }

Validity verdict_of(bool is_met) { return is_met ? Validity::passed : Validity::missed; }

std::string told_number(double value, const char* unit) {
    std::string text = short_number(value);
    if (*unit) text.append(" ").append(unit);
    return text;
}

ValidationFinding within(std::string what, double value, double low, double high, const char* unit) {
    return {std::move(what), short_number(low) + " - " + told_number(high, unit), told_number(value, unit),
            verdict_of(value >= low && value <= high)};
}

}  // namespace flaneur
