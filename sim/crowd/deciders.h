// Private to sim/crowd.
#pragma once

#include <functional>

#include "sim/crowd/crowd.h"

namespace flaneur {

// Calls decide(walker) on the workers for each walker that decides this tick, in the order of places, so that
// those who share neighbours and ground find them in the cache. Needs the walkers sorted by find_neighbours.
template <class Decide>
void for_deciders(const Crowd& crowd, Workers& workers, uint32_t tick, Decide decide) {
    auto decide_some = [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k) {
            uint32_t walker = crowd.sorted[k].id;
            if ((walker ^ tick) % k_decision_ticks == 0) decide(walker);
        }
    };
    parallel_for(workers, crowd.count, 512, std::ref(decide_some));
}

}  // namespace flaneur
