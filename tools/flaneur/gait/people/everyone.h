// A whole population put through every way of walking, each judged by what applies to it.
#pragma once

#include <iterator>

#include "sim/base/parallel_for.h"
#include "sim/base/result.h"
#include "tools/flaneur/gait/people/norms.h"
#include "tools/flaneur/gait/trials.h"

namespace flaneur {

inline constexpr int k_styles = 10;

struct Task {
    Trial trial;
    double share;  // of one's fastest walk; 0: the speed that one likes
};
inline constexpr Task k_tasks[] = {
    {Trial::level, 0.6},   {Trial::level, 0.7},     {Trial::level, 0.8},  {Trial::level, 0.9},
    {Trial::level, 1},     {Trial::usual, 0},       {Trial::turn, 0},     {Trial::bends, 0},
    {Trial::stairs_up, 0}, {Trial::stairs_down, 0}, {Trial::slope_up, 0}, {Trial::slope_down, 0},
    {Trial::kerb, 0},
};
inline constexpr size_t k_task_count = std::size(k_tasks);

// Women, then men, of 4, 8, 14, 20, 40, 60 and 80 years; after each middle manner its k_styles styles.
std::vector<Who> everyone();

// m/s.
double speed_of(const Who& who, const Task& task);

// One after the other, k_task_count reports each, whatever the threads. Curves are kept of the middle manners
// alone. An Error only if somebody asks the program to stop.
Result<std::vector<Report>> try_everyone(const std::vector<Who>& people, Workers& workers);

}  // namespace flaneur
