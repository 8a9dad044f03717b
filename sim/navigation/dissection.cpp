#include "sim/navigation/dissection.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "sim/base/parallel_for.h"

namespace flaneur {

static constexpr size_t k_smallest = 16;      // gates that are cut no further
static constexpr float k_least_half = 0.35f;  // of the gates, in each half
static constexpr Vec2 k_ways[] = {{1, 0}, {0, 1}, {0.7071f, 0.7071f}, {0.7071f, -0.7071f}};

namespace {

// A stretch of the order whose gates are still to be put in order.
struct Part {
    size_t begin, end;
};

enum class Half : uint8_t { near, far, between };

struct Cut {
    size_t way = 0;               // index of k_ways
    size_t at = 0;                // so many lie nearer
    size_t between = ~size_t{0};  // gates to take out
};

struct Dissection {
    const Gates* gates;
    std::vector<uint32_t> sorted[std::size(k_ways)];  // by place along each way, within each part
    std::vector<uint32_t> place;                      // by gate, in the part, along one way
    // By gate: where its part begins, or k_done. Read by all threads, and the next ones written.
    std::vector<uint32_t> part, next_part;
    std::vector<Half> half;  // by gate
};

constexpr uint32_t k_done = ~0u;

}  // namespace

// Calls visit(neighbour) for the gates of the same part that share a polygon with it.
template <class Visit>
static void for_neighbours(const Dissection& d, uint32_t gate, Visit visit) {
    const Gates& g = *d.gates;
    for (uint32_t p : g.gates[gate].polygons)
        for (uint32_t k = g.first[p]; k < g.first[p + 1]; ++k)
            if (g.of[k] != gate && d.part[g.of[k]] == d.part[gate]) visit(g.of[k]);
}

static void find_places(Dissection& d, const Part& part, size_t way) {
    for (size_t k = part.begin; k < part.end; ++k)
        d.place[d.sorted[way][k]] = static_cast<uint32_t>(k - part.begin);
}

// What a cut at each place would take out: those before it that have neighbours from there on.
static Cut best_cut(Dissection& d, const Part& part) {
    const size_t size = part.end - part.begin;
    const auto least = std::max<size_t>(1, static_cast<size_t>(static_cast<float>(size) * k_least_half));
    std::vector<int> change(size + 2);
    Cut best;
    for (size_t way = 0; way < std::size(k_ways); ++way) {
        find_places(d, part, way);
        std::fill(change.begin(), change.end(), 0);
        for (size_t k = part.begin; k < part.end; ++k) {
            const uint32_t gate = d.sorted[way][k];
            uint32_t last = d.place[gate];
            for_neighbours(d, gate, [&](uint32_t other) { last = std::max(last, d.place[other]); });
            ++change[d.place[gate] + 1];
            --change[last + 1];
        }
        int between = 0;
        for (size_t at = 0; at + least <= size; ++at) {
            between += change[at];
            if (at >= least && static_cast<size_t>(between) < best.between)
                best = {way, at, static_cast<size_t>(between)};
        }
    }
    return best;
}

// Cuts a part and puts what lies between the halves at its end. Returns the halves.
static std::array<Part, 2> cut(Dissection& d, const Part& part) {
    const Cut best = best_cut(d, part);
    find_places(d, part, best.way);
    std::array<size_t, 3> counts{};
    for (size_t k = part.begin; k < part.end; ++k) {
        const uint32_t gate = d.sorted[best.way][k];
        Half half = k - part.begin < best.at ? Half::near : Half::far;
        if (half == Half::near)
            for_neighbours(d, gate, [&](uint32_t other) {
                if (d.place[other] >= best.at) half = Half::between;
            });
        d.half[gate] = half;
        ++counts[static_cast<size_t>(half)];
    }
    std::vector<uint32_t> before;
    for (auto& sorted : d.sorted) {
        before.assign(sorted.begin() + static_cast<ptrdiff_t>(part.begin),
                      sorted.begin() + static_cast<ptrdiff_t>(part.end));
        std::array<size_t, 3> at{part.begin, part.begin + counts[0], part.begin + counts[0] + counts[1]};
        for (uint32_t gate : before) sorted[at[static_cast<size_t>(d.half[gate])]++] = gate;
    }
    const size_t middle = part.begin + counts[0], end = middle + counts[1];
    for (size_t k = part.begin; k < part.end; ++k)
        d.next_part[d.sorted[0][k]] =
            k < end ? static_cast<uint32_t>(k < middle ? part.begin : middle) : k_done;
    return {Part{part.begin, middle}, Part{middle, end}};
}

// Those with few neighbours first.
static void put_in_order(Dissection& d, const Part& part) {
    for (size_t k = part.begin; k < part.end; ++k) d.next_part[d.sorted[0][k]] = k_done;
    auto rank = [&](uint32_t gate) {
        const Gates& g = *d.gates;
        uint32_t neighbours = 0;
        for (uint32_t p : g.gates[gate].polygons) neighbours += g.first[p + 1] - g.first[p];
        return std::pair{neighbours, gate};
    };
    std::sort(d.sorted[0].begin() + static_cast<ptrdiff_t>(part.begin),
              d.sorted[0].begin() + static_cast<ptrdiff_t>(part.end),
              [&](uint32_t a, uint32_t b) { return rank(a) < rank(b); });
}

std::vector<uint32_t> dissect(const Gates& gates, int threads) {
    const size_t count = gates.gates.size();
    Dissection d;
    d.gates = &gates;
    d.place.resize(count);
    d.half.resize(count);
    d.part.assign(count, 0);
    d.next_part.assign(count, k_done);
    WorkersPtr workers = make_workers(threads);
    parallel_for(*workers, std::size(k_ways), 1, [&](size_t begin, size_t end, int) {
        for (size_t way = begin; way < end; ++way) {
            std::vector<std::pair<float, uint32_t>> along(count);
            for (uint32_t i = 0; i < count; ++i)
                along[i] = {dot(on_ground(gates.middles[i]), k_ways[way]), i};
            std::sort(along.begin(), along.end());
            for (const auto& [offset, gate] : along) d.sorted[way].push_back(gate);
        }
    });
    std::vector<Part> parts{{0, count}};
    while (!parts.empty()) {
        std::vector<std::array<Part, 2>> halves(parts.size());
        parallel_for(*workers, parts.size(), 1, [&](size_t begin, size_t end, int) {
            for (size_t k = begin; k < end; ++k) {
                if (parts[k].end - parts[k].begin > k_smallest)
                    halves[k] = cut(d, parts[k]);
                else
                    put_in_order(d, parts[k]);
            }
        });
        parts.clear();
        for (const auto& both : halves)
            for (const Part& half : both)
                if (half.begin < half.end) parts.push_back(half);
        d.part = d.next_part;
    }
    return std::move(d.sorted[0]);
}

}  // namespace flaneur
