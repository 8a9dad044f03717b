// What a population meets and misses, on paper.
#pragma once

#include "tools/flaneur/gait/people/everyone.h"

namespace flaneur {

// A bar that somebody misses. People are told apart by age and sex, not by style.
struct Miss {
    std::string place, quantity;    // "stairs up", "knee_swing_peak.deg"
    int people = 0, of_people = 0;  // who miss it, of whom it is asked
    int walks = 0, of_walks = 0;    // the same of walks
    Verdict worst;
    std::string whose;  // the worst: "a woman of 8, style 3, 1.23 m/s"
};

// `reports` are try_everyone's of these people. Bars that most people miss come first, then those of most
// walks.
std::vector<Miss> misses_of(const std::vector<Who>& people, const std::vector<Report>& reports);

// Bars met of bars asked: a row for each person and one for its styles together, a column for each way; on
// level ground one for each share of the fastest walk.
void print_table(const std::vector<Who>& people, const std::vector<Report>& reports);
void print_misses(const std::vector<Miss>& misses);

}  // namespace flaneur
