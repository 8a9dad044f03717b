// Who is near: walkers in the order of places, by counting.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/places.h"

namespace flaneur {

static constexpr float k_insistence = 0.6f;  // m/s, at most, that one with a claim asks for

// Walkers of each square in the order of their slots: each of those who sort takes a quarter of the slots.
void order_places(Crowd& c, Workers& workers, bool anew) {
    CrowdScratch& s = c.scratch;
    const size_t cells = s.cell_first.size() - 1, share = (c.count + k_sorters - 1) / k_sorters;
    auto for_slots = [&](size_t sorter, const auto& visit) {
        const size_t end = std::min<size_t>(c.count, (sorter + 1) * share);
        for (size_t i = sorter * share; i < end; ++i)
            if (is_there(c, static_cast<uint32_t>(i))) visit(static_cast<uint32_t>(i));
    };
    parallel_for(workers, k_sorters, 1, [&](size_t sorter, size_t, int) {
        uint32_t* tally = &s.tallies[sorter * cells];
        std::fill_n(tally, cells, 0u);
        for_slots(sorter, [&](uint32_t i) {
            if (anew) c.motion.filed[i] = filed_at(c.motion.position[i]);
            ++tally[cell_of(s, c.motion.filed[i])];
        });
    });
    uint32_t before = 0;
    for (size_t cell = 0; cell < cells; ++cell) {
        s.cell_first[cell] = before;
        for (size_t sorter = 0; sorter < k_sorters; ++sorter) {
            const uint32_t own = s.tallies[sorter * cells + cell];
            s.tallies[sorter * cells + cell] = before;
            before += own;
        }
    }
    s.cell_first[cells] = before;
    parallel_for(workers, k_sorters, 1, [&](size_t sorter, size_t, int) {
        for_slots(sorter, [&](uint32_t i) {
            s.order[s.tallies[sorter * cells + cell_of(s, c.motion.filed[i])]++] = i;
        });
    });
    s.is_ordered = true;
}

static void look_at(Crowd& c, size_t at) {
    SeenRows& rows = c.scratch.seen;
    const uint32_t i = c.scratch.order[at];
    const CrowdDecision& d = c.decision;
    const Vec3 p = c.motion.position[i];
    Vec2 velocity = c.motion.velocity[i], ahead;
    if (d.claim[i].since != k_never) {
        const Vec2 asked = d.claim[i].heirs > 0 ? d.chosen[i] : d.wanted[i];
        velocity = asked * std::min(1.0f, k_insistence / std::max(length(asked), 1e-4f));
    }
    if (c.identity.ahead[i] > 0)
        ahead = heading_direction(c.motion.heading[i]) * c.identity.ahead[i];
    else if (const GoesBeside* own = c.beside.empty() ? nullptr : own_of(c.beside, i))
        ahead = own->to;
    rows.x[at] = p.x, rows.y[at] = p.y, rows.z[at] = p.z;
    rows.all[at] = {p, velocity, ahead, d.course[i], d.aim[i], c.identity.radius[i], i, d.claim[i]};
}

// Metres that anybody may be from where all were filed last: those afar go all of a step at once.
static float farthest_strayed(const Crowd& c) {
    uint8_t most = 1;
    for (const uint8_t ticks : c.at_once) most = std::max(most, ticks);
    return k_tick * std::max(k_decision_ticks * k_fastest, most * k_fastest_afar);
}

void find_neighbours(Crowd& c, Workers& workers, uint32_t tick) {
    const bool anew = tick % k_decision_ticks == 0;
    const bool is_kept = !anew && c.scratch.is_ordered;
    if (!is_kept) order_places(c, workers, anew);
    c.scratch.strays = farthest_strayed(c);
    // Those afar are as they were when they were looked at last, but in their turn and after it.
    auto is_as_it_was = [&](size_t block) {
        return is_kept && ticks_due(c, block, tick) == 0 && ticks_due(c, block, tick - 1) == 0;
    };
    parallel_for(workers, c.slots.living.size(), 1024, [&](size_t begin, size_t end, int) {
        for (size_t at = begin; at < end; ++at)
            if (!is_as_it_was(c.scratch.order[at] / k_block)) look_at(c, at);
    });
}

float deepest_overlap(const Crowd& c) {
    const CrowdScratch& s = c.scratch;
    float deepest = -1;
    for (uint32_t at = 0; at < s.cell_first.back(); ++at) {
        const Seen& me = s.seen.all[at];
        for_seen_near(s, me.position, me.radius + c.widest, [&](uint32_t begin, uint32_t end) {
            for (uint32_t k = begin; k < end; ++k) {
                const Seen& other = s.seen.all[k];
                const Vec3 off = other.position - me.position;
                if (other.id == me.id || std::fabs(off.y) > k_other_level) continue;
                deepest = std::max(deepest, me.radius + other.radius - length(on_ground(off)));
            }
        });
    }
    return deepest;
}

}  // namespace flaneur
