// Simulation level of detail: by where somebody looks on from.
#include <algorithm>
#include <limits>

#include "sim/crowd/crowd.h"

namespace flaneur {

// Metres from a walker to the nearest eye, squared.
static float nearest_eye2(const Crowd& c, uint32_t i) {
    if (i == c.driven.walker || is_led(c, i)) return 0;
    float nearest = std::numeric_limits<float>::max();
    for (const Vec3 eye : c.onlookers.eyes)
        nearest = std::min(nearest, length_squared(c.motion.position[i] - eye));
    return nearest;
}

static uint32_t ticks_at_once(const Crowd& c, size_t block) {
    if (c.onlookers.eyes.empty()) return 1;
    const float reach2 = c.onlookers.reach * c.onlookers.reach;
    uint32_t ticks = k_farther_ticks;
    const size_t last = std::min<size_t>(c.count, (block + 1) * k_block);
    for (size_t i = block * k_block; i < last; ++i) {
        if (!is_there(c, static_cast<uint32_t>(i))) continue;
        const float d2 = nearest_eye2(c, static_cast<uint32_t>(i));
        if (d2 <= reach2) return 1;
        if (d2 <= 4 * reach2) ticks = k_afar_ticks;
    }
    return ticks;
}

void look_on(Crowd& c, Workers& workers, uint32_t tick) {
    parallel_for(workers, block_count(c.count), 64, [&](size_t begin, size_t end, int) {
        for (size_t block = begin; block < end; ++block) {
            // Only between two steps, and at a turn of those that it joins, so that nobody's time passes
            // twice.
            c.scratch.woken[block] = 0;
            const uint32_t turn = ticks_since_turn(block, tick, k_farther_ticks);
            if (turn % std::max<uint32_t>(c.at_once[block], k_afar_ticks) != 0) continue;
            const uint32_t most = turn == 0 ? k_farther_ticks : k_afar_ticks;
            const uint32_t ticks = std::min(ticks_at_once(c, block), most);
            c.scratch.woken[block] = ticks < c.at_once[block] && ticks == 1;
            c.at_once[block] = static_cast<uint8_t>(ticks);
        }
    });
}

}  // namespace flaneur
