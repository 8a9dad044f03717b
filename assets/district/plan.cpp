#include "assets/district/plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr uint32_t k_none = ~0u;

// The lattice while it is made: node (i, j) is nodes[j * (n + 1) + i], cell (i, j) lies between nodes (i, j)
// and (i + 1, j + 1). Each cell has two halves, north-east (0) and south-west (1), apart where a diagonal
// runs between them.
struct Lattice {
    int n = 4;
    Dice dice;
    std::vector<float> columns, rows;  // before bending
    std::vector<Vec2> jitter;          // of nodes
    std::vector<uint32_t> row_ways,
        column_ways;                 // way to the east, to the south of a node; k_none: taken out
    std::vector<uint32_t> half_of;   // union-find over halves
    float phase[4] = {}, reach = 0;  // of the bending
    StreetPlan plan;

    size_t node(int i, int j) const { return static_cast<size_t>(j * (n + 1) + i); }
    size_t half(int i, int j, int which) const { return static_cast<size_t>((j * n + i) * 2 + which); }
    uint32_t group(size_t h) {
        while (half_of[h] != h) h = half_of[h] = half_of[half_of[h]];
        return static_cast<uint32_t>(h);
    }
    void join(size_t a, size_t b) {
        uint32_t x = group(a), y = group(b);
        half_of[std::max(x, y)] = std::min(x, y);
    }
};

// Like a sine of so many turns, by parabolas.
float wave(float turns) {
    float x = 2 * (turns - std::floor(turns)) - 1;
    return 4 * x * (1 - std::fabs(x));
}

Vec2 bent(const Lattice& l, Vec2 p) {
    // North of the second row columns run straight, and rows do: there the hill has to be a plane.
    float z = std::max(p.z, l.rows[1]);
    float free = l.n > 1 ? smoothstep(l.rows[1], l.rows[2 < l.n ? 2 : l.rows.size() - 1], p.z) : 1;
    float dx = l.reach * (wave(z / 330 + l.phase[0]) + 0.35f * wave(z / 150 + l.phase[1]));
    float dz = l.reach * free * (wave(p.x / 310 + l.phase[2]) + 0.35f * wave(p.x / 140 + l.phase[3]));
    return p + Vec2{dx, dz};
}

// From node (i, j) to (x, z) along the bent lattice.
std::vector<Vec2> bent_line(const Lattice& l, int i, int j, int x, int z) {
    auto place = [&](int a, int b) {
        return Vec2{l.columns[static_cast<size_t>(a)], l.rows[static_cast<size_t>(b)]};
    };
    constexpr int k_parts = 3;
    std::vector<Vec2> line{l.plan.nodes[l.node(i, j)]};
    for (int k = 1; k < k_parts; ++k) {
        float t = static_cast<float>(k) / k_parts;
        line.push_back(bent(l, lerp(place(i, j), place(x, z), t)) +
                       lerp(l.jitter[l.node(i, j)], l.jitter[l.node(x, z)], t));
    }
    line.push_back(l.plan.nodes[l.node(x, z)]);
    return line;
}

void lay_nodes(Lattice& l) {
    Dice& dice = l.dice;
    auto spread = [&](std::vector<float>& lines) {
        lines.assign(1, 0);
        for (int k = 0; k < l.n; ++k) lines.push_back(lines.back() + dice.between(78, 98));
        float middle = lines.back() * 0.5f;
        for (float& at : lines) at -= middle;
    };
    spread(l.columns);
    spread(l.rows);
    for (float& p : l.phase) p = dice.unit();
    l.reach = l.n > 1 ? 11 : 2;
    for (int j = 0; j <= l.n; ++j) {
        for (int i = 0; i <= l.n; ++i) {
            bool is_loose = l.n == 1 || j > 1;
            Vec2 away{is_loose ? dice.between(-3, 3) : 0, is_loose ? dice.between(-3, 3) : 0};
            l.jitter.push_back(away);
            l.plan.nodes.push_back(
                bent(l, {l.columns[static_cast<size_t>(i)], l.rows[static_cast<size_t>(j)]}) + away);
        }
    }
}

uint32_t add_way(Lattice& l, WayKind kind, size_t from, size_t to, std::vector<Vec2> line) {
    Way way;
    way.kind = kind;
    way.from = static_cast<uint32_t>(from);
    way.to = static_cast<uint32_t>(to);
    way.line = std::move(line);
    l.plan.ways.push_back(std::move(way));
    return static_cast<uint32_t>(l.plan.ways.size() - 1);
}

void lay_ways(Lattice& l) {
    int n = l.n;
    l.row_ways.assign(l.plan.nodes.size(), k_none);
    l.column_ways = l.row_ways;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            if (i < n)
                l.row_ways[l.node(i, j)] =
                    add_way(l, WayKind::street, l.node(i, j), l.node(i + 1, j), bent_line(l, i, j, i + 1, j));
            if (j < n)
                l.column_ways[l.node(i, j)] =
                    add_way(l, WayKind::street, l.node(i, j), l.node(i, j + 1), bent_line(l, i, j, i, j + 1));
        }
    }
    // What goes on as one street is as wide all along.
    auto widen = [&](uint32_t way, float width, float sidewalk, bool trees) {
        Way& w = l.plan.ways[way];
        w.width = width;
        w.sidewalk = sidewalk;
        w.has_trees = trees;
    };
    for (int k = 0; k <= n; ++k) {
        for (bool is_row : {false, true}) {
            float width = l.dice.between(6.6f, 9), sidewalk = l.dice.between(2.8f, 4.4f);
            bool trees = sidewalk > 3.3f && l.dice.chance(0.75f);
            for (int m = 0; m < n; ++m)
                widen(is_row ? l.row_ways[l.node(m, k)] : l.column_ways[l.node(k, m)], width, sidewalk,
                      trees);
        }
    }
}

// Takes a way out, or makes something else of it, and joins what it parted.
void take_row_way(Lattice& l, int i, int j) {
    uint32_t& way = l.row_ways[l.node(i, j)];
    if (way == k_none) return;
    l.plan.ways[way].kind = WayKind::none;
    way = k_none;
    if (j > 0 && j < l.n) l.join(l.half(i, j - 1, 1), l.half(i, j, 0));
}
void take_column_way(Lattice& l, int i, int j) {
    uint32_t& way = l.column_ways[l.node(i, j)];
    if (way == k_none) return;
    l.plan.ways[way].kind = WayKind::none;
    way = k_none;
    if (i > 0 && i < l.n) l.join(l.half(i - 1, j, 0), l.half(i, j, 1));
}

void make_avenue(Way& way) {
    way.kind = WayKind::avenue;
    way.width = 10.5f;
    way.sidewalk = 4.8f;
    way.has_trees = true;
}

// A diagonal avenue from near the north-west to the square's corner, and from the corner opposite on to the
// south-east; another comes down to the square from the hill, and leaves it to the south.
void lay_avenues(Lattice& l, int c) {
    auto diagonal = [&](int k) {
        uint32_t way = add_way(l, WayKind::avenue, l.node(k, k), l.node(k + 1, k + 1),
                               {l.plan.nodes[l.node(k, k)], l.plan.nodes[l.node(k + 1, k + 1)]});
        make_avenue(l.plan.ways[way]);
    };
    if (l.n >= 3) {
        for (int k = 0; k < l.n; ++k) {
            if (k != c && k >= 1)
                diagonal(k);
            else
                l.join(l.half(k, k, 0), l.half(k, k, 1));
        }
        for (int k = 1; k < c; ++k) {
            take_column_way(l, k + 1, k);
            take_row_way(l, k, k + 1);
        }
        for (int k = c + 1; k < l.n; ++k) {
            take_column_way(l, k, k);
            take_row_way(l, k, k);
        }
        for (int j = 0; j <= c; ++j) make_avenue(l.plan.ways[l.column_ways[l.node(c + 1, j)]]);
        for (int j = c + 1; j < l.n; ++j) make_avenue(l.plan.ways[l.column_ways[l.node(c, j)]]);
    } else {
        for (int k = 0; k < l.n; ++k) l.join(l.half(k, k, 0), l.half(k, k, 1));
    }
}

// Trams halt about every 300 metres.
void lay_tracks(Lattice& l) {
    for (int i = 0; l.n > 1 && i < l.n; ++i) {
        Way& way = l.plan.ways[l.row_ways[l.node(i, 1)]];
        make_avenue(way);
        way.has_tracks = true;
        way.has_tram_stop = i % 3 == 1;
    }
}

void make_lane(Way& way, WayKind kind, float width) {
    way.kind = kind;
    way.width = width;
    way.sidewalk = 0;
    way.has_trees = false;
}

// Here and there a way is for people on foot, or is not there at all.
void thin_out(Lattice& l, int c) {
    std::vector<int> arms(l.plan.nodes.size(), 0);
    auto count = [&](const Way& way) {
        if (way.carries_cars()) ++arms[way.from], ++arms[way.to];
    };
    for (const Way& way : l.plan.ways) count(way);
    std::vector<uint8_t> is_merged(l.half_of.size(), 0), halves(l.half_of.size(), 0);
    for (size_t h = 0; h < is_merged.size(); ++h) ++halves[l.group(h)];
    for (size_t h = 0; h < is_merged.size(); ++h) is_merged[h] = halves[l.group(h)] != 2;
    auto spare = [&](const Way& way) {
        return way.kind == WayKind::street && arms[way.from] > 2 && arms[way.to] > 2;
    };
    auto release = [&](const Way& way) { --arms[way.from], --arms[way.to]; };
    if (l.n > 1) {
        Way& stairs = l.plan.ways[l.column_ways[l.node(1, 0)]];
        release(stairs);
        make_lane(stairs, WayKind::stairs, 8);
        stairs.line = {stairs.line.front(), stairs.line.back()};
        if (l.n > 3) {
            Way& below = l.plan.ways[l.column_ways[l.node(1, 1)]];
            release(below);
            make_lane(below, WayKind::lane, 6.5f);
        }
    }
    auto is_single = [&](int i, int j) {
        return !is_merged[l.half(i, j, 0)] && !is_merged[l.half(i, j, 1)] && !(i == c && j == c);
    };
    for (int j = 0; j < l.n; ++j) {
        for (int i = 0; i < l.n; ++i) {
            for (bool is_row : {true, false}) {
                float lot = l.dice.unit(), width = l.dice.between(4.2f, 7);
                if (is_row ? j == 0 : i == 0) continue;
                uint32_t index = (is_row ? l.row_ways : l.column_ways)[l.node(i, j)];
                if (index == k_none || !spare(l.plan.ways[index])) continue;
                int x = is_row ? i : i - 1, z = is_row ? j - 1 : j;
                bool at_square = (i == c && j == c) || (x == c && z == c);
                if (at_square) continue;
                if (lot < 0.17f) {
                    release(l.plan.ways[index]);
                    make_lane(l.plan.ways[index], WayKind::lane, width);
                } else if (lot < 0.34f && is_single(i, j) && is_single(x, z)) {
                    release(l.plan.ways[index]);
                    is_row ? take_row_way(l, i, j) : take_column_way(l, i, j);
                    for (int which : {0, 1})
                        is_merged[l.half(i, j, which)] = is_merged[l.half(x, z, which)] = 1;
                }
            }
        }
    }
}

// Streets that go on beyond the outermost ones, off the map.
void lay_ways_out(Lattice& l, int c, float belt, bool tracks) {
    int n = l.n;
    for (int side = 0; side < 4; ++side) {
        bool was_last = false;
        for (int k = 1; k < n; ++k) {
            bool must = l.n >= 3 && ((side == 0 && k == c + 1) || (side == 2 && k == c));
            must |= tracks && k == 1 && side % 2 == 1;
            bool drawn = l.dice.chance(0.4f);
            if (!must && (!drawn || was_last)) {
                was_last = false;
                continue;
            }
            was_last = true;
            int i = side == 0 || side == 2 ? k : side == 1 ? n : 0, j = side == 0 ? 0 : side == 2 ? n : k;
            constexpr Vec2 k_out[4] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
            size_t node = l.node(i, j);
            Vec2 from = l.plan.nodes[node];
            uint32_t inner = side == 0   ? l.column_ways[l.node(i, 0)]
                             : side == 2 ? l.column_ways[l.node(i, n - 1)]
                             : side == 1 ? l.row_ways[l.node(n - 1, j)]
                                         : l.row_ways[l.node(0, j)];
            Way way;
            if (inner != k_none && l.plan.ways[inner].carries_cars()) way = l.plan.ways[inner];
            way.kind = way.kind == WayKind::avenue ? WayKind::avenue : WayKind::street;
            way.leads_out = true;
            way.has_tram_stop = false;
            way.from = static_cast<uint32_t>(node);
            way.to = static_cast<uint32_t>(l.plan.nodes.size());
            float reach = belt + 40;
            way.line = {from, from + k_out[side] * reach};
            l.plan.nodes.push_back(way.line.back());
            l.plan.ways.push_back(std::move(way));
        }
    }
}

// The middle lines around half a cell.
Ring half_ring(const Lattice& l, int i, int j, int which) {
    std::vector<Vec2> line = which == 0 ? bent_line(l, i, j, i + 1, j) : bent_line(l, i, j, i, j + 1);
    std::vector<Vec2> more =
        which == 0 ? bent_line(l, i + 1, j, i + 1, j + 1) : bent_line(l, i, j + 1, i + 1, j + 1);
    line.insert(line.end(), more.begin() + 1, more.end());
    Ring ring;
    for (Vec2 p : line) ring.push_back(to_point(p));
    return positive(ring);
}

void find_blocks(Lattice& l, int c) {
    int n = l.n;
    auto cells = static_cast<size_t>(n) * static_cast<size_t>(n);
    std::vector<std::vector<uint32_t>> ways(cells * 2);
    std::vector<Rings> rings(cells * 2);
    auto touch = [&](uint32_t way, size_t half) {
        if (way != k_none) ways[l.group(half)].push_back(way);
    };
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            if (i < n && j < n) touch(l.row_ways[l.node(i, j)], l.half(i, j, 0));
            if (i < n && j > 0) touch(l.row_ways[l.node(i, j)], l.half(i, j - 1, 1));
            if (i < n && j < n) touch(l.column_ways[l.node(i, j)], l.half(i, j, 1));
            if (i > 0 && j < n) touch(l.column_ways[l.node(i, j)], l.half(i - 1, j, 0));
        }
    }
    for (uint32_t w = 0; w < l.plan.ways.size(); ++w) {
        const Way& way = l.plan.ways[w];
        int i = static_cast<int>(way.from) % (n + 1), j = static_cast<int>(way.from) / (n + 1);
        if (way.leads_out || way.to != l.node(std::min(i + 1, n), std::min(j + 1, n)) || i == n || j == n)
            continue;
        touch(w, l.half(i, j, 0));
        touch(w, l.half(i, j, 1));
    }
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            for (int which : {0, 1}) rings[l.group(l.half(i, j, which))].push_back(half_ring(l, i, j, which));
        }
    }
    auto use_of = [&](size_t group, Dice& dice) {
        auto is_cell = [&](int i, int j) {
            if (i < 0 || j < 0 || i >= n || j >= n) return false;
            return l.group(l.half(i, j, 0)) == group || l.group(l.half(i, j, 1)) == group;
        };
        float lot = dice.unit();
        if (is_cell(c, c)) return BlockUse::square;
        if (n >= 4 ? is_cell(c + 1, c - 1) : n > 1 && is_cell(0, n - 1)) return BlockUse::park;
        int j = static_cast<int>(group / 2) / n, i = static_cast<int>(group / 2) % n;
        if (j == 0) return lot < 0.25f && i > 1 ? BlockUse::villas : BlockUse::houses;
        if (std::abs(i - c) + std::abs(j - c) <= 1) return BlockUse::houses;
        return lot < 0.07f  ? BlockUse::park
               : lot < 0.2f ? BlockUse::villas
               : lot < 0.3f ? BlockUse::slabs
                            : BlockUse::houses;
    };
    for (size_t g = 0; g < rings.size(); ++g) {
        if (rings[g].empty()) continue;
        Dice dice{{l.dice.key.seed, static_cast<uint32_t>(g), 7, Purpose::city}};
        BlockPlan block;
        block.use = use_of(g, dice);
        block.ways = ways[g];
        std::sort(block.ways.begin(), block.ways.end());
        block.ways.erase(std::unique(block.ways.begin(), block.ways.end()), block.ways.end());
        Rings strips;
        for (uint32_t w : block.ways) {
            const Way& way = l.plan.ways[w];
            add_strip(strips, way.line, way.half(), way.half(), true);
        }
        double largest = 100;
        for (const Region& region : regions_of(subtract(unite(rings[g]), strips))) {
            double size = area({region.outer});
            if (size <= largest) continue;
            largest = size;
            block.outline = region.outer;
        }
        block.ring = simple_outline(block.outline);
        if (!block.ring.empty()) l.plan.plots.push_back(std::move(block));
    }
}

// Heights along one axis: level along each street line, rising and falling between, level at 0 where `flat`.
float rise_at(float at, const std::vector<float>& lines, const std::vector<float>& heights) {
    constexpr float k_level = 14;
    if (at <= lines.front()) return heights.front() + 1.8f * smoothstep(10, 60, lines.front() - at);
    if (at >= lines.back()) return heights.back() + 1.8f * smoothstep(10, 60, at - lines.back());
    size_t k = 0;
    while (at > lines[k + 1]) ++k;
    return lerp(heights[k], heights[k + 1], smoothstep(lines[k] + k_level, lines[k + 1] - k_level, at));
}

void shape_terrain(Lattice& l, int c) {
    StreetPlan& plan = l.plan;
    Relief& t = plan.relief;
    // The square, the stairs and the park by the square lie level.
    auto heights = [&](int axis) {
        std::vector<float> h;
        for (int k = 0; k <= l.n; ++k) {
            float drawn = l.dice.between(0.4f, 2.6f);
            bool is_south = axis == 1;
            bool is_level = l.n == 1 || k == c || k == c + 1 || k == 1 ||
                            (is_south && (k == 0 || k == c - 1)) || (!is_south && k == c + 2);
            h.push_back(is_level ? 0 : drawn);
        }
        return h;
    };
    std::vector<float> east = heights(0), south = heights(1);
    constexpr float k_ease = 6;
    float top = l.rows[0] + 11, foot = l.rows[1] - 11;
    t.slope = l.n > 1 ? 0.078f : 0;
    t.plane_top = top + k_ease + t.cell;
    t.plane_foot = foot - k_ease - t.cell;
    // The integral of a slope that comes and goes evenly.
    auto ramp = [&](float x) {
        return x < -k_ease ? 0 : x > k_ease ? x : (x + k_ease) * (x + k_ease) / (4 * k_ease);
    };
    t.origin = plan.low;
    auto sample = [&](float from, float to, auto height) {
        std::vector<float> samples;
        for (float at = from; at < to + 2 * t.cell; at += t.cell) samples.push_back(height(at));
        return samples;
    };
    t.east = sample(plan.low.x, plan.high.x, [&](float x) { return rise_at(x, l.columns, east); });
    t.south = sample(plan.low.z, plan.high.z, [&](float z) {
        float hill = t.slope * (ramp(foot - z) - ramp(top - z));
        return hill + (z < l.rows[1] ? 0 : rise_at(z, l.rows, south));
    });
}

}  // namespace

float Relief::height(Vec2 p) const {
    auto along = [this](const std::vector<float>& samples, float at) {
        float s = clamp(at / cell, 0, static_cast<float>(samples.size()) - 1.001f), k = std::floor(s);
        auto i = static_cast<size_t>(k);
        return lerp(samples[i], samples[i + 1], s - k);
    };
    return along(east, p.x - origin.x) + along(south, p.z - origin.z);
}

Station station(const std::vector<Vec2>& line, float s) {
    Station there{line.front(), {0, 1}};
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        float piece = length(line[i + 1] - line[i]);
        there.along = normalize_or(line[i + 1] - line[i], {0, 1});
        there.at = line[i] + there.along * s;
        if (s <= piece) break;
        s -= piece;
    }
    return there;
}

StreetPlan plan_streets(uint64_t seed, int blocks, float belt, float cell, bool tracks) {
    Lattice l;
    l.n = std::clamp(blocks, 1, 32);
    l.plan.blocks = l.n;
    l.dice.key = {seed, 0xd15731c7u, 0, Purpose::city};
    auto halves = static_cast<size_t>(l.n) * static_cast<size_t>(l.n) * 2;
    l.half_of.resize(halves);
    std::iota(l.half_of.begin(), l.half_of.end(), 0u);
    int c = l.n / 2;
    lay_nodes(l);
    lay_ways(l);
    for (int j = 0; j < l.n; ++j) {
        for (int i = 0; i < l.n; ++i) {
            if (i != j) l.join(l.half(i, j, 0), l.half(i, j, 1));
        }
    }
    lay_avenues(l, c);
    if (tracks) lay_tracks(l);
    thin_out(l, c);
    StreetPlan& plan = l.plan;
    plan.low = plan.high = plan.nodes[0];
    for (Vec2 p : plan.nodes) {
        plan.low = {std::min(plan.low.x, p.x), std::min(plan.low.z, p.z)};
        plan.high = {std::max(plan.high.x, p.x), std::max(plan.high.z, p.z)};
    }
    plan.low += {-belt, -belt};
    plan.high += {belt, belt};
    plan.relief.cell = cell;
    shape_terrain(l, c);
    find_blocks(l, c);
    lay_ways_out(l, c, belt, tracks);

    plan.ways_at.resize(plan.nodes.size());
    for (uint32_t w = 0; w < plan.ways.size(); ++w) {
        if (plan.ways[w].kind == WayKind::none) continue;
        plan.ways_at[plan.ways[w].from].push_back(w);
        plan.ways_at[plan.ways[w].to].push_back(w);
    }
    // Clockwise on the map.
    for (int k = 0; k < l.n; ++k) plan.outer.push_back(l.row_ways[l.node(k, 0)]);
    for (int k = 0; k < l.n; ++k) plan.outer.push_back(l.column_ways[l.node(l.n, k)]);
    for (int k = l.n; k-- > 0;) plan.outer.push_back(l.row_ways[l.node(k, l.n)]);
    for (int k = l.n; k-- > 0;) plan.outer.push_back(l.column_ways[l.node(0, k)]);
    return std::move(l.plan);
}

}  // namespace flaneur
