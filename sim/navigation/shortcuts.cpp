#include "sim/navigation/shortcuts.h"

#include <algorithm>

#include "sim/navigation/dissection.h"

namespace flaneur {

static constexpr float k_no_way = 1e30f;
static constexpr size_t k_most_gates = 1 << 14;  // of a way, without allocating

// By rank, those to which gates of a higher rank are joined when it is their turn: its own, and those
// that gates taken out before leave it.
static std::vector<std::vector<uint32_t>> join_gates(const Gates& g, const std::vector<uint32_t>& rank_of) {
    std::vector<std::vector<uint32_t>> to(rank_of.size()), children(rank_of.size());
    for_pairs_of_gates(g, [&](uint32_t a, uint32_t b, uint32_t) {
        to[std::min(rank_of[a], rank_of[b])].push_back(std::max(rank_of[a], rank_of[b]));
    });
    std::vector<uint32_t> joined;
    for (uint32_t r = 0; r < to.size(); ++r) {
        std::vector<uint32_t>& own = to[r];
        std::sort(own.begin(), own.end());
        own.erase(std::unique(own.begin(), own.end()), own.end());
        for (uint32_t child : children[r]) {
            joined.clear();
            std::set_union(own.begin(), own.end(), to[child].begin() + 1, to[child].end(),
                           std::back_inserter(joined));
            own = joined;
        }
        if (!own.empty()) children[own[0]].push_back(r);
    }
    return to;
}

Shortcuts find_shortcuts(const Gates& gates, int threads) {
    Shortcuts s;
    s.gate_of = dissect(gates, threads);
    s.rank_of.resize(s.gate_of.size());
    for (uint32_t r = 0; r < s.gate_of.size(); ++r) s.rank_of[s.gate_of[r]] = r;
    s.first.push_back(0);
    for (const std::vector<uint32_t>& to : join_gates(gates, s.rank_of)) {
        s.to.insert(s.to.end(), to.begin(), to.end());
        s.first.push_back(static_cast<uint32_t>(s.to.size()));
    }
    return s;
}

static uint32_t shortcut_between(const Shortcuts& s, uint32_t low, uint32_t high) {
    auto first = s.to.begin() + s.first[low], last = s.to.begin() + s.first[low + 1];
    return static_cast<uint32_t>(std::lower_bound(first, last, high) - s.to.begin());
}

ShortcutCosts find_costs(const Gates& g, const Shortcuts& s, bool wheels) {
    ShortcutCosts c;
    c.costs.assign(s.to.size(), k_no_way);
    c.through.assign(s.to.size(), k_no_gate);
    for_pairs_of_gates(g, [&](uint32_t a, uint32_t b, uint32_t polygon) {
        if (wheels && g.steps[polygon]) return;
        const auto [low, high] = std::minmax(s.rank_of[a], s.rank_of[b]);
        float& cost = c.costs[shortcut_between(s, low, high)];
        cost = std::min(cost, cost_to_gate(g, g.middles[a], polygon, b));
    });
    for (uint32_t r = 0; r + 1 < s.first.size(); ++r) {
        for (uint32_t i = s.first[r]; i < s.first[r + 1]; ++i) {
            if (c.costs[i] >= k_no_way) continue;
            uint32_t k = s.first[s.to[i]];  // of a shortcut between the two that `r` is joined to
            for (uint32_t j = i + 1; j < s.first[r + 1]; ++j) {
                while (s.to[k] < s.to[j]) ++k;
                const float cost = c.costs[i] + c.costs[j];
                if (cost < c.costs[k]) c.costs[k] = cost, c.through[k] = r;
            }
        }
    }
    return c;
}

std::unique_ptr<WaySearch> make_search(const Gates& gates) {
    auto s = std::make_unique<WaySearch>();
    const size_t count = gates.gates.size();
    s->up.assign(count, k_no_way);
    s->down.assign(count, k_no_way);
    s->before.resize(count);
    s->after.resize(count);
    s->way.reserve(std::min(count, k_most_gates));
    s->doorways.reserve(std::min(count, k_most_gates));
    s->todo.reserve(std::max(count, gates.costs.size()));
    s->seen.resize(gates.costs.size());
    return s;
}

// Calls visit(rank) up the tree from `r` on.
template <class Visit>
static void climb(const Shortcuts& s, uint32_t r, Visit visit) {
    while (r != k_no_gate) {
        visit(r);
        r = s.first[r] < s.first[r + 1] ? s.to[s.first[r]] : k_no_gate;
    }
}

// Sets out from a place into its polygon's gates; returns the lowest rank among them. The others lie up the
// tree from there, since all are joined.
static uint32_t set_out(const Gates& g, const Shortcuts& s, Vec3 place, uint32_t polygon,
                        std::vector<float>& costs, std::vector<uint32_t>& came) {
    uint32_t lowest = k_no_gate;
    for (uint32_t k = g.first[polygon]; k < g.first[polygon + 1]; ++k) {
        const uint32_t r = s.rank_of[g.of[k]];
        costs[r] = cost_to_gate(g, place, polygon, g.of[k]);
        came[r] = k_no_gate;
        lowest = std::min(lowest, r);
    }
    return lowest;
}

static void spread(const Shortcuts& s, const ShortcutCosts& c, uint32_t r, std::vector<float>& costs,
                   std::vector<uint32_t>& came) {
    const float so_far = costs[r];
    for (uint32_t k = s.first[r]; k < s.first[r + 1]; ++k) {
        const float cost = so_far + c.costs[k];
        if (cost < costs[s.to[k]]) costs[s.to[k]] = cost, came[s.to[k]] = r;
    }
}

// The rank in which the cheapest way culminates.
static uint32_t meet(const Shortcuts& s, const ShortcutCosts& c, WaySearch& w, uint32_t from, uint32_t to) {
    auto parent = [&](uint32_t r) { return s.first[r] < s.first[r + 1] ? s.to[s.first[r]] : k_no_gate; };
    float least = k_no_way;
    uint32_t found = k_no_gate;
    while (from != to) {
        if (from < to) {
            spread(s, c, from, w.up, w.before);
            from = parent(from);
        } else {
            spread(s, c, to, w.down, w.after);
            to = parent(to);
        }
    }
    for (uint32_t r = from; r != k_no_gate; r = parent(r)) {
        if (w.up[r] + w.down[r] < least) least = w.up[r] + w.down[r], found = r;
        // What is dearer than the way found leads nowhere cheaper.
        if (w.up[r] < least) spread(s, c, r, w.up, w.before);
        if (w.down[r] < least) spread(s, c, r, w.down, w.after);
    }
    return found;
}

// Adds the gates from `from` (exclusive) to `to` (inclusive), which are joined.
static void unfold(const Shortcuts& s, const ShortcutCosts& c, uint32_t from, uint32_t to, WaySearch& w) {
    // Ranks to go to, the next one last.
    w.todo.assign(1, to);
    while (!w.todo.empty()) {
        const uint32_t next = w.todo.back();
        const auto [low, high] = std::minmax(from, next);
        const uint32_t through = c.through[shortcut_between(s, low, high)];
        if (through != k_no_gate) {
            w.todo.push_back(through);
            continue;
        }
        w.way.push_back(s.gate_of[next]);
        w.todo.pop_back();
        from = next;
    }
}

std::span<const uint32_t> cheapest_way(const Gates& g, const Shortcuts& s, const ShortcutCosts& c,
                                       WaySearch& w, const WayEnds& ends) {
    w.way.clear();
    const uint32_t from = set_out(g, s, ends.from, ends.from_polygon, w.up, w.before),
                   to = set_out(g, s, ends.to, ends.to_polygon, w.down, w.after);
    const uint32_t top = meet(s, c, w, from, to);
    if (top != k_no_gate) {
        // Down from the top, in both directions; then the first half is turned round.
        uint32_t at = top;
        w.way.push_back(s.gate_of[top]);
        for (; w.before[at] != k_no_gate; at = w.before[at]) unfold(s, c, at, w.before[at], w);
        std::reverse(w.way.begin(), w.way.end());
        for (at = top; w.after[at] != k_no_gate; at = w.after[at]) unfold(s, c, at, w.after[at], w);
    }
    climb(s, from, [&](uint32_t r) { w.up[r] = k_no_way; });
    climb(s, to, [&](uint32_t r) { w.down[r] = k_no_way; });
    return w.way;
}

}  // namespace flaneur
