#include "assets/district.h"

#include <algorithm>
#include <cmath>

#include "assets/city.h"
#include "assets/streets.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_belt = 46;  // beyond the outermost streets, metres

struct Line {
    float width = 8, sidewalk = 3.5f;
    bool avenue = false, trees = false;
    float at = 0, bow = 0;  // place across, and how far its middle strays from it

    float total() const { return width + 2 * sidewalk; }
};

// The lines of one direction, from low to high.
std::vector<Line> lay_lines(Dice& dice, int blocks) {
    std::vector<Line> lines(static_cast<size_t>(blocks) + 1);
    auto avenue = static_cast<size_t>((blocks + 1) / 2);
    for (size_t i = 0; i < lines.size(); ++i) {
        Line& line = lines[i];
        line.avenue = i == avenue;
        line.width = line.avenue ? 12 : dice.between(7, 9);
        line.sidewalk = line.avenue ? 5 : dice.between(3, 4.2f);
        line.trees = line.avenue || (line.sidewalk > 3.4f && dice.chance(0.6f));
        bool inner = i > 0 && i + 1 < lines.size();
        line.bow = inner ? dice.between(-9, 9) : dice.between(-3, 3);
        if (i > 0)
            line.at = lines[i - 1].at + dice.between(62, 80) + (lines[i - 1].total() + line.total()) * 0.5f;
    }
    float middle = lines.back().at * 0.5f;
    for (Line& line : lines) line.at -= middle;
    return lines;
}

struct Layout {
    int blocks = 4;
    std::vector<Line> columns, rows;
    std::vector<Vec2> nodes;  // row by row

    Vec2 node(int i, int j) const { return nodes[static_cast<size_t>(j * (blocks + 1) + i)]; }
};

Layout lay_out(const DistrictOptions& options) {
    Layout layout;
    layout.blocks = std::clamp(options.blocks, 1, 32);
    Dice dice{{options.seed, 0xd15731c7u, 0, Purpose::city}};
    layout.columns = lay_lines(dice, layout.blocks);
    layout.rows = lay_lines(dice, layout.blocks);
    // The hill lies between the first two rows: these stay straight, so that the slope has room.
    layout.rows[0].bow = layout.rows[1].bow = 0;
    int n = layout.blocks;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            const Line &column = layout.columns[static_cast<size_t>(i)],
                       &row = layout.rows[static_cast<size_t>(j)];
            auto arch = [n](int k) {
                float t = static_cast<float>(k) / static_cast<float>(n);
                return 4 * t * (1 - t);
            };
            Vec2 p{column.at + column.bow * arch(j), row.at + row.bow * arch(i)};
            layout.nodes.push_back(p +
                                   Vec2{dice.between(-2.5f, 2.5f), j < 2 ? 0 : dice.between(-2.5f, 2.5f)});
        }
    }
    return layout;
}

// Trees and lamps along both sidewalks of the stretch p-q, which is clear of its junctions.
void furnish_street(District& d, Dice& dice, const Line& line, Vec2 p, Vec2 q) {
    float distance = length(q - p);
    Vec2 along = normalize_or(q - p, {1, 0}), left{along.z, -along.x};
    if (distance < 12) return;
    float kerb = line.width * 0.5f + 0.9f, pitch = line.avenue ? 9.0f : 12.0f;
    for (float side : {-1.0f, 1.0f}) {
        float yaw = heading_of(left * -side);
        int trees = static_cast<int>(distance / pitch);
        for (int t = 0; t < trees && line.trees; ++t) {
            if (!line.avenue && dice.chance(0.12f)) continue;
            float s = (static_cast<float>(t) + 0.5f) * distance / static_cast<float>(trees);
            add_tree(d, dice, p + along * s + left * (side * kerb), line.avenue ? 1.0f : 0.8f);
        }
        int lamps = std::max(1, static_cast<int>(distance / 27));
        if (!line.avenue && side < 0) continue;
        for (int t = 0; t < lamps; ++t) {
            float s = static_cast<float>(t) * distance / static_cast<float>(lamps);
            Vec2 at = p + along * s + left * (side * (kerb - 0.25f));
            add_prop(d, dice, PropKind::lamp, at, yaw, line.avenue ? 7.5f : 5.5f);
        }
    }
}

void lay_streets(District& d, const Layout& layout, uint64_t seed) {
    int n = layout.blocks;
    Dice dice{{seed, 0x57ee7u, 0, Purpose::city}};
    for (int k = 0; k <= n; ++k) {
        for (bool is_row : {false, true}) {
            const Line& line = (is_row ? layout.rows : layout.columns)[static_cast<size_t>(k)];
            Street street{{}, line.width, line.sidewalk, line.sidewalk};
            for (int m = 0; m <= n; ++m)
                street.line.push_back(is_row ? layout.node(m, k) : layout.node(k, m));
            add_street(d.plan, street);
        }
    }
    // How far from either end each stretch is clear: [node][direction +x, +z, -x, -z].
    std::vector<std::array<float, 4>> clear(layout.nodes.size());
    constexpr int k_step[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            std::vector<Arm> arms;
            std::vector<int> ways;
            for (int w = 0; w < 4; ++w) {
                int x = i + k_step[w][0], z = j + k_step[w][1];
                if (x < 0 || z < 0 || x > n || z > n) continue;
                const Line& line =
                    w % 2 == 0 ? layout.rows[static_cast<size_t>(j)] : layout.columns[static_cast<size_t>(i)];
                arms.push_back(
                    {normalize_or(layout.node(x, z) - layout.node(i, j), {1, 0}), line.width * 0.5f});
                ways.push_back(w);
            }
            std::vector<float> straight = add_corners(d.plan, layout.node(i, j), arms, 3.5f);
            for (size_t a = 0; a < arms.size(); ++a) {
                const Line& line = ways[a] % 2 == 0 ? layout.rows[static_cast<size_t>(j)]
                                                    : layout.columns[static_cast<size_t>(i)];
                float breadth = line.avenue ? 4.5f : 3.5f, at = straight[a] + breadth * 0.5f;
                Vec2 u = arms[a].direction;
                add_crossing(d.plan, layout.node(i, j) + u * at, u, {-u.z, u.x}, arms[a].half_width, breadth,
                             true);
                clear[static_cast<size_t>(j * (n + 1) + i)][static_cast<size_t>(ways[a])] =
                    at + breadth * 0.5f + 2;
            }
        }
    }
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
            for (int w = 0; w < 2; ++w) {
                int x = i + k_step[w][0], z = j + k_step[w][1];
                if (x > n || z > n) continue;
                const Line& line =
                    w == 0 ? layout.rows[static_cast<size_t>(j)] : layout.columns[static_cast<size_t>(i)];
                Vec2 p = layout.node(i, j), q = layout.node(x, z), u = normalize_or(q - p, {1, 0});
                float from = clear[static_cast<size_t>(j * (n + 1) + i)][static_cast<size_t>(w)];
                float to = clear[static_cast<size_t>(z * (n + 1) + x)][static_cast<size_t>(w + 2)];
                furnish_street(d, dice, line, p + u * from, q - u * to);
            }
        }
    }
}

Block block_at(const Layout& layout, int i, int j, uint64_t seed) {
    const Line &west = layout.columns[static_cast<size_t>(i)],
               &east = layout.columns[static_cast<size_t>(i) + 1];
    const Line &north = layout.rows[static_cast<size_t>(j)], &south = layout.rows[static_cast<size_t>(j) + 1];
    Block block;
    block.corners = inset_quad(
        {layout.node(i, j), layout.node(i + 1, j), layout.node(i + 1, j + 1), layout.node(i, j + 1)},
        {north.total() * 0.5f, east.total() * 0.5f, south.total() * 0.5f, west.total() * 0.5f});
    block.busy = {north.avenue, east.avenue, south.avenue, west.avenue};
    block.dice = {{seed, static_cast<uint32_t>(j * 64 + i + 1), 0, Purpose::city}};
    return block;
}

// Rows of houses across the outermost streets close the views; behind them lie gardens.
void lay_belt(District& d, const Layout& layout, uint64_t seed) {
    int n = layout.blocks;
    for (int k = 0; k < n; ++k) {
        for (int side = 0; side < 4; ++side) {
            const Line& line = side == 0   ? layout.rows[0]
                               : side == 2 ? layout.rows.back()
                               : side == 1 ? layout.columns.back()
                                           : layout.columns[0];
            Vec2 a, b;
            if (side == 0) a = layout.node(k + 1, 0), b = layout.node(k, 0);
            if (side == 1) a = layout.node(n, k + 1), b = layout.node(n, k);
            if (side == 2) a = layout.node(k, n), b = layout.node(k + 1, n);
            if (side == 3) a = layout.node(0, k), b = layout.node(0, k + 1);
            Block block;
            block.dice = {{seed, 0xbe170000u + static_cast<uint32_t>(k * 4 + side), 0, Purpose::city}};
            block.busy = {line.avenue, line.avenue, line.avenue, line.avenue};
            // Walking from a to b, the houses stand to the right hand on the map: the positive side.
            Vec2 along = normalize_or(b - a, {1, 0}), out{-along.z, along.x};
            Vec2 front_a = a + out * (line.total() * 0.5f), front_b = b + out * (line.total() * 0.5f);
            float depth = block.dice.between(11.5f, 13.5f);
            // A gap between neighbouring stretches leaves room where the line bends.
            Quad strip{front_a + along * 1.2f, front_b - along * 1.2f, front_b - along * 1.2f + out * depth,
                       front_a + along * 1.2f + out * depth};
            fill_strip(d, block, strip, side, false, false, 4 + block.dice.pick(2), false);
            for (int t = 0; t < 5; ++t) {
                float along_row = block.dice.unit(), behind = depth + block.dice.between(6, 20);
                Vec2 at = lerp(front_a, front_b, along_row) + out * behind;
                add_tree(d, block.dice, at, block.dice.between(0.8f, 1.2f));
            }
        }
    }
}

void fill_blocks(District& d, const Layout& layout, uint64_t seed) {
    int n = layout.blocks, square_i = n / 2, square_j = n / 2;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            Block block = block_at(layout, i, j, seed);
            auto faces_square = [&](int x, int z) { return x == square_i && z == square_j; };
            block.busy[0] |= faces_square(i, j - 1);
            block.busy[1] |= faces_square(i + 1, j);
            block.busy[2] |= faces_square(i, j + 1);
            block.busy[3] |= faces_square(i - 1, j);
            bool beside = std::abs(i - square_i) + std::abs(j - square_j) <= 1;
            float lot = block.dice.unit();
            if (i == square_i && j == square_j) {
                fill_square(d, block);
            } else if (n > 1 && j > 0 && !beside && lot < 0.12f) {
                fill_park(d, block);
            } else if (!beside && lot < 0.3f) {
                fill_villas(d, block);
            } else if (j > 0 && !beside && lot < 0.42f) {
                fill_slabs(d, block);
            } else {
                fill_perimeter(d, block);
            }
        }
    }
}

}  // namespace

City generate_district(const DistrictOptions& options) {
    Layout layout = lay_out(options);
    District d;
    d.city.name = "district";
    Vec2 extent{layout.columns.back().at + k_belt, layout.rows.back().at + k_belt};
    d.plan.low = -extent;
    d.plan.high = extent;
    d.plan.cell = 12;
    if (layout.blocks > 1) {
        // A hill to the north: level along its streets, eased in and out between the first two rows.
        float top = layout.rows[0].at + layout.rows[0].total() * 0.5f + 5;
        float foot = layout.rows[1].at - layout.rows[1].total() * 0.5f - 5, rise = 0.05f * (foot - top);
        // Straight within each row of cells, so that pieces of one cell lie in one plane.
        float first_row = d.plan.low.z, row = d.plan.cell;
        d.plan.terrain = [=](Vec2 p) {
            float at = (p.z - first_row) / row, k = std::floor(at);
            auto height = [&](float line) {
                return rise * (1 - smoothstep(top, foot, first_row + line * row));
            };
            return lerp(height(k), height(k + 1), at - k);
        };
    }
    lay_streets(d, layout, options.seed);
    fill_blocks(d, layout, options.seed);
    lay_belt(d, layout, options.seed);
    add_area(d, k_rank_rest, Surface::grass, flat(k_kerb),
             {rectangle(to_point(d.plan.low), to_point(d.plan.high))});
    lay_ground(d.plan, d.city);
    index_city(d.city);

    // Props were placed on the map; now there is ground to stand them on.
    std::erase_if(d.city.props, [&](Prop& prop) {
        std::optional<GroundHit> hit = ground(d.city, at_height(on_ground(prop.position), 0), 60, 60);
        if (hit) prop.position.y = hit->height;
        return !hit || hit->kind == Surface::road || hit->kind == Surface::crossing ||
               hit->kind == Surface::water;
    });
    return std::move(d.city);
}

}  // namespace flaneur
