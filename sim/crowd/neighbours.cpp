// Who is near: walkers sorted onto a grid by counting, then the nearest few of each.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/places.h"

namespace flaneur {

static constexpr float k_insistence = 0.6f;  // m/s, at most, that one with a claim asks for

static Seen seen(const Crowd& c, uint32_t i) {
    const CrowdDecision& d = c.decision;
    Seen seen{c.motion.position[i], i, c.motion.velocity[i], c.identity.radius[i], d.claim[i], {}};
    if (c.identity.ahead[i] > 0) seen.ahead = heading_direction(c.motion.heading[i]) * c.identity.ahead[i];
    if (seen.claim.since != k_never) {
        Vec2 asked = seen.claim.heirs > 0 ? d.chosen[i] : d.wanted[i];
        seen.velocity = asked * std::min(1.0f, k_insistence / std::max(length(asked), 1e-4f));
    }
    return seen;
}

static void sort_by_cell(Crowd& c) {
    CrowdScratch& s = c.scratch;
    const CrowdMotion& m = c.motion;
    std::fill(s.cell_first.begin(), s.cell_first.end(), 0);
    for (uint32_t i = 0; i < c.count; ++i) {
        if (!is_there(c, i)) continue;
        uint32_t x = static_cast<uint32_t>(seen_column(m.position[i].x)) & (s.cells_x - 1);
        uint32_t z = static_cast<uint32_t>(seen_column(m.position[i].z)) & (s.cells_z - 1);
        s.cell[i] = z * s.cells_x + x;
        ++s.cell_first[s.cell[i] + 1];
    }
    for (size_t k = 1; k < s.cell_first.size(); ++k) s.cell_first[k] += s.cell_first[k - 1];
    // Filled from the back, with the ends as cursors: afterwards each cursor stands at its cell's first
    // walker.
    for (uint32_t i = c.count; i-- > 0;)
        if (is_there(c, i)) s.sorted[--s.cell_first[s.cell[i] + 1]] = seen(c, i);
    std::rotate(s.cell_first.begin(), s.cell_first.begin() + 1, s.cell_first.end());
    s.cell_first.back() = static_cast<uint32_t>(c.slots.living.size());
}

static void nearest_walkers(Crowd& c, const Seen& me) {
    const CrowdScratch& s = c.scratch;
    Vec3 p = me.position;
    uint32_t i = me.id;
    float distances[k_neighbours];
    uint32_t* slots = &c.scratch.neighbours[size_t{i} * k_neighbours];
    int count = 0;
    float reach = k_neighbour_reach * k_neighbour_reach;
    auto look_at = [&](uint32_t begin, uint32_t end) {
        for (uint32_t k = begin; k < end; ++k) {
            const Seen& other = s.sorted[k];
            float d = length_squared(on_ground(other.position) - on_ground(p));
            if (d > reach || other.id == i || std::fabs(other.position.y - p.y) > k_other_level) continue;
            int at = count;
            while (at > 0 && (distances[at - 1] > d ||
                              (distances[at - 1] == d && s.sorted[slots[at - 1]].id > other.id)))
                --at;
            if (at == k_neighbours) continue;
            if (count < k_neighbours) ++count;
            for (int m = count - 1; m > at; --m) {
                distances[m] = distances[m - 1];
                slots[m] = slots[m - 1];
            }
            distances[at] = d;
            slots[at] = k;
            if (count == k_neighbours) reach = distances[count - 1];
        }
    };
    for_seen_near(s, p, k_neighbour_reach, look_at);
    c.scratch.neighbour_count[i] = static_cast<uint8_t>(count);
}

float deepest_overlap(const Crowd& c) {
    const CrowdScratch& s = c.scratch;
    float deepest = -1;
    for (const Seen& me : std::span(s.sorted).first(c.slots.living.size())) {
        for_seen_near(s, me.position, me.radius + c.widest, [&](uint32_t begin, uint32_t end) {
            for (uint32_t k = begin; k < end; ++k) {
                const Seen& other = s.sorted[k];
                Vec3 off = other.position - me.position;
                if (other.id == me.id || std::fabs(off.y) > k_other_level) continue;
                deepest = std::max(deepest, me.radius + other.radius - length(on_ground(off)));
            }
        });
    }
    return deepest;
}

void find_neighbours(Crowd& c, Workers& workers, uint32_t tick) {
    sort_by_cell(c);
    for_deciders(c, workers, tick, [&](const Seen& me) { nearest_walkers(c, me); });
}

}  // namespace flaneur
