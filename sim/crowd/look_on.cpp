// Simulation level of detail: by where somebody looks on from.
#include <algorithm>

#include "sim/crowd/crowd.h"

namespace flaneur {

static bool is_seen(const Crowd& c, uint32_t i) {
    const float reach2 = c.onlookers.reach * c.onlookers.reach;
    if (i == c.driven.walker) return true;
    return std::any_of(c.onlookers.eyes.begin(), c.onlookers.eyes.end(),
                       [&](Vec3 eye) { return length_squared(c.motion.position[i] - eye) <= reach2; });
}

void look_on(Crowd& c, Workers& workers, uint32_t tick) {
    // Only between two steps of those afar, so that nobody's time passes twice.
    parallel_for(workers, block_count(c.count), 64, [&](size_t begin, size_t end, int) {
        for (size_t block = begin; block < end; ++block) {
            if (ticks_since_due(block, tick) != 0) continue;
            bool afar = !c.onlookers.eyes.empty();
            const size_t last = std::min<size_t>(c.count, (block + 1) * k_block);
            for (size_t i = block * k_block; i < last && afar; ++i)
                afar = !is_there(c, static_cast<uint32_t>(i)) || !is_seen(c, static_cast<uint32_t>(i));
            c.afar[block] = afar;
        }
    });
}

}  // namespace flaneur
