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
    for_pairs_of_gates(g, 0, polygons_of(g), [&](uint32_t a, uint32_t b, uint32_t) {
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
    s.depth.resize(s.gate_of.size());
    for (uint32_t r = static_cast<uint32_t>(s.depth.size()); r-- > 0;) {
        if (s.first[r] < s.first[r + 1]) s.depth[r] = static_cast<uint16_t>(s.depth[s.to[s.first[r]]] + 1);
        s.height = std::max(s.height, s.depth[r] + 1u);
    }
    for (uint32_t r : s.to) s.to_depth.push_back(s.depth[r]);
    return s;
}

static uint32_t shortcut_between(const Shortcuts& s, uint32_t low, uint32_t high) {
    auto first = s.to.begin() + s.first[low], last = s.to.begin() + s.first[low + 1];
    return static_cast<uint32_t>(std::lower_bound(first, last, high) - s.to.begin());
}

void forget_costs(const Shortcuts& s, ShortcutCosts& c) {
    c.costs.assign(s.to.size(), k_no_way);
    c.through.assign(s.to.size(), k_no_gate);
}

void put_in_polygons(const Gates& g, const Shortcuts& s, ShortcutCosts& c, uint32_t begin, uint32_t end,
                     bool wheels, std::span<const float> slow) {
    for_pairs_of_gates(g, begin, end, [&](uint32_t a, uint32_t b, uint32_t polygon) {
        if (wheels && g.steps[polygon]) return;
        const auto [low, high] = std::minmax(s.rank_of[a], s.rank_of[b]);
        float& cost = c.costs[shortcut_between(s, low, high)];
        const float times = slow.empty() ? 1 : slow[polygon];
        cost = std::min(cost, times * cost_to_gate(g, g.middles[a], polygon, b));
    });
}

void put_in_ranks(const Shortcuts& s, ShortcutCosts& c, uint32_t begin, uint32_t end) {
    for (uint32_t r = begin; r < end; ++r) {
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
}

ShortcutCosts find_costs(const Gates& g, const Shortcuts& s, bool wheels, std::span<const float> slow) {
    ShortcutCosts c;
    forget_costs(s, c);
    put_in_polygons(g, s, c, 0, polygons_of(g), wheels, slow);
    put_in_ranks(s, c, 0, static_cast<uint32_t>(s.gate_of.size()));
    return c;
}

std::unique_ptr<WaySearch> make_search(const Gates& gates, const Shortcuts& shortcuts) {
    auto s = std::make_unique<WaySearch>();
    for (Climb* climb : {&s->up, &s->down}) {
        climb->costs.assign(shortcuts.height, k_no_way);
        climb->ranks.resize(shortcuts.height);
        climb->by.resize(shortcuts.height);
        climb->from.resize(shortcuts.height);
    }
    const size_t most = std::min(gates.gates.size(), k_most_gates);
    s->todo.reserve(most);
    s->way.reserve(most);
    s->doorways.reserve(most);
    s->reached.reserve(gates.costs.size());
    s->seen.resize(gates.costs.size());
    return s;
}

static uint32_t parent_of(const Shortcuts& s, uint32_t r) {
    return s.first[r] < s.first[r + 1] ? s.to[s.first[r]] : k_no_gate;
}

// Sets out from a place into its polygon's gates. Returns the lowest of their ranks; the others lie up the
// tree from there, since all are joined.
static uint32_t set_out(const Gates& g, const Shortcuts& s, Vec3 place, uint32_t polygon, Climb& climb) {
    uint32_t lowest = k_no_gate;
    for (uint32_t k = g.first[polygon]; k < g.first[polygon + 1]; ++k) {
        const uint32_t r = s.rank_of[g.of[k]];
        climb.costs[s.depth[r]] = cost_to_gate(g, place, polygon, g.of[k]);
        climb.by[s.depth[r]] = k_no_shortcut;
        lowest = std::min(lowest, r);
    }
    return lowest;
}

static void climb_from(const Shortcuts& s, const ShortcutCosts& c, uint32_t r, Climb& climb) {
    const uint16_t depth = s.depth[r];
    const float so_far = climb.costs[depth];
    for (uint32_t k = s.first[r]; k < s.first[r + 1]; ++k) {
        const float cost = so_far + c.costs[k];
        const uint16_t at = s.to_depth[k];
        if (cost < climb.costs[at]) climb.costs[at] = cost, climb.by[at] = k, climb.from[at] = depth;
    }
}

// The rank in which the cheapest way culminates.
static uint32_t meet(const Shortcuts& s, const ShortcutCosts& c, uint32_t from, uint32_t to, Climb& up,
                     Climb& down) {
    while (from != to) {
        uint32_t& lower = from < to ? from : to;
        Climb& climb = from < to ? up : down;
        climb.ranks[s.depth[lower]] = lower;
        climb_from(s, c, lower, climb);
        lower = parent_of(s, lower);
    }
    float least = k_no_way;
    uint32_t found = k_no_gate;
    for (uint32_t r = from; r != k_no_gate; r = parent_of(s, r)) {
        const uint16_t at = s.depth[r];
        up.ranks[at] = down.ranks[at] = r;
        if (up.costs[at] + down.costs[at] < least) least = up.costs[at] + down.costs[at], found = r;
        // What is dearer than the way found leads nowhere cheaper.
        if (up.costs[at] < least) climb_from(s, c, r, up);
        if (down.costs[at] < least) climb_from(s, c, r, down);
    }
    return found;
}

// Adds the gates of a shortcut but for the first.
static void unfold(const Shortcuts& s, const ShortcutCosts& c, const Unfolding& whole, WaySearch& w) {
    w.todo.push_back(whole);
    while (!w.todo.empty()) {
        const Unfolding next = w.todo.back();
        w.todo.pop_back();
        const uint32_t through = c.through[next.shortcut];
        if (through == k_no_gate) {
            w.way.push_back(s.gate_of[next.to]);
            continue;
        }
        uint32_t from = k_no_shortcut, to = k_no_shortcut;
        for (uint32_t k = s.first[through]; from == k_no_shortcut || to == k_no_shortcut; ++k) {
            if (s.to[k] == next.from) from = k;
            if (s.to[k] == next.to) to = k;
        }
        w.todo.push_back({to, through, next.to});
        w.todo.push_back({from, next.from, through});
    }
}

// Adds the gates from depth `at` down to where the climb set out, but for the first.
static void descend(const Shortcuts& s, const ShortcutCosts& c, const Climb& climb, uint16_t at,
                    WaySearch& w) {
    for (; climb.by[at] != k_no_shortcut; at = climb.from[at])
        unfold(s, c, {climb.by[at], climb.ranks[at], climb.ranks[climb.from[at]]}, w);
}

static void forget(const Shortcuts& s, uint32_t from, Climb& climb) {
    if (from == k_no_gate) return;
    std::fill_n(climb.costs.begin(), s.depth[from] + 1, k_no_way);
}

std::span<const uint32_t> cheapest_way(const Gates& g, const Shortcuts& s, const ShortcutCosts& c,
                                       WaySearch& w, const WayEnds& ends) {
    w.way.clear();
    const uint32_t from = set_out(g, s, ends.from, ends.from_polygon, w.up),
                   to = set_out(g, s, ends.to, ends.to_polygon, w.down);
    const uint32_t top = meet(s, c, from, to, w.up, w.down);
    if (top != k_no_gate) {
        w.way.push_back(s.gate_of[top]);
        descend(s, c, w.up, s.depth[top], w);
        std::reverse(w.way.begin(), w.way.end());
        descend(s, c, w.down, s.depth[top], w);
    }
    forget(s, from, w.up);
    forget(s, to, w.down);
    return w.way;
}

}  // namespace flaneur
