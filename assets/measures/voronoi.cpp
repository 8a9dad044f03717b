#include "assets/measures/voronoi.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <polyclipping/clipper.hpp>

#include "sim/base/math.h"
#include "sim/base/planar.h"

namespace flaneur {
namespace {

constexpr float k_same_spot = 1e-4f;  // metres
constexpr float k_no_edge = 1e-4f;    // metres, of an edge that two cells share
constexpr double k_grain = 1e6;       // of Clipper's whole numbers, to a metre
constexpr double k_untouched = 1e-6;  // share of a cell that rounding may take
constexpr float k_people_a_square = 2;
constexpr int k_most_squares = 1024;  // along a side

ClipperLib::Path to_clipper(std::span<const Vec2> ring, Vec2 by) {
    ClipperLib::Path path;
    path.reserve(ring.size());
    for (Vec2 p : ring) {
        const Vec2 q = p + by;
        path.emplace_back(std::llround(wide(q.x) * k_grain), std::llround(wide(q.z) * k_grain));
    }
    return path;
}

std::vector<Vec2> of_clipper(const ClipperLib::Path& path) {
    std::vector<Vec2> ring;
    ring.reserve(path.size());
    for (const ClipperLib::IntPoint& p : path)
        ring.push_back({static_cast<float>(static_cast<double>(p.X) / k_grain),
                        static_cast<float>(static_cast<double>(p.Y) / k_grain)});
    return ring;
}

double net_area_of(std::span<const std::vector<Vec2>> rings) {
    double sum = 0;
    for (const std::vector<Vec2>& ring : rings) sum += signed_area_of(ring);
    return sum;
}

float farthest(std::span<const Vec2> polygon) {
    float most = 0;
    for (Vec2 corner : polygon) most = std::max(most, length_squared(corner));
    return std::sqrt(most);
}

// What a cell is before others cut it.
void begin_cell(const CellGround& ground, const PeopleGrid& people, Vec2 at, std::vector<Vec2>& open) {
    open.clear();
    if (ground.cut_off.radius > 0) {
        for (int i = 0; i < ground.cut_off.sides; ++i) {
            const SinCos angle =
                sin_cos(6.2831853f * static_cast<float>(i) / static_cast<float>(ground.cut_off.sides));
            open.push_back(Vec2{angle.cosine, angle.sine} * ground.cut_off.radius);
        }
        return;
    }
    Rectangle box = ground.box;
    if (ground.pieces.empty()) {  // all that is known of it is where people are
        const Vec2 size = Vec2{static_cast<float>(people.columns), static_cast<float>(people.rows)};
        box = {people.low, people.low + size * people.square};
    }
    box = {{std::min(box.low.x, at.x) - at.x, std::min(box.low.z, at.z) - at.z},
           {std::max(box.high.x, at.x) - at.x, std::max(box.high.z, at.z) - at.z}};
    open = {box.low, {box.high.x, box.low.z}, box.high, {box.low.x, box.high.z}};
}

// Calls meet(other, away) with the others, by squares about one's own, as long as anybody nearer than reach()
// may be left, which may shrink meanwhile.
template <class Meet, class Reach>
void meet_others(const PeopleGrid& people, uint32_t who, const Meet& meet, const Reach& reach) {
    const Vec2 at = people.of[who];
    const auto column =
        std::clamp(static_cast<int>((at.x - people.low.x) / people.square), 0, people.columns - 1);
    const auto row = std::clamp(static_cast<int>((at.z - people.low.z) / people.square), 0, people.rows - 1);
    auto meet_square = [&](int x, int z) {
        if (x < 0 || z < 0 || x >= people.columns || z >= people.rows) return;
        const size_t square =
            static_cast<size_t>(z) * static_cast<size_t>(people.columns) + static_cast<size_t>(x);
        for (uint32_t k = people.begins[square]; k < people.begins[square + 1]; ++k)
            if (people.who[k] != who) meet(people.who[k], people.of[people.who[k]] - at);
    };
    const int rings = std::max({column, people.columns - 1 - column, row, people.rows - 1 - row});
    for (int ring = 0; ring <= rings && static_cast<float>(ring - 1) * people.square < reach(); ++ring) {
        for (int x = -ring; x <= ring; ++x) {
            meet_square(column + x, row - ring);
            if (ring > 0) meet_square(column + x, row + ring);
        }
        for (int z = 1 - ring; z < ring; ++z) {
            meet_square(column - ring, row + z);
            meet_square(column + ring, row + z);
        }
    }
}

void cut_by_others(const PeopleGrid& people, uint32_t who, VoronoiCell& cell) {
    float reach = farthest(cell.open);
    auto cut_by_one = [&](uint32_t other, Vec2 away) {
        const float apart = length(away);
        if (apart < k_same_spot || apart >= 2 * reach) return;
        const Vec2 towards = away / apart;
        const bool is_cut = std::any_of(cell.open.begin(), cell.open.end(),
                                        [&](Vec2 corner) { return dot(towards, corner) > apart / 2; });
        if (!is_cut) return;
        cut_by(cell.open, cell.scratch, towards, apart / 2);
        cell.cutters.push_back(other);
        reach = farthest(cell.open);
    };
    meet_others(people, who, cut_by_one, [&] { return 2 * reach; });
}

// The piece of what of the cell is on the ground, in which (0, 0) lies.
void take_own_piece(const CellGround::Piece& piece, Vec2 at, VoronoiCell& cell) {
    ClipperLib::Clipper clipper;
    for (const std::vector<Vec2>& ring : piece.rings)
        clipper.AddPath(to_clipper(ring, -at), ClipperLib::ptSubject, true);
    clipper.AddPath(to_clipper(cell.open, {}), ClipperLib::ptClip, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctIntersection, tree, ClipperLib::pftEvenOdd, ClipperLib::pftNonZero);
    for (const ClipperLib::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
        // 1: inside; -1: on the edge.
        auto lies_in = [](const ClipperLib::PolyNode* ring) {
            return ClipperLib::PointInPolygon({0, 0}, ring->Contour);
        };
        const auto& holes = node->Childs;
        if (node->IsHole() || lies_in(node) == 0) continue;
        if (std::any_of(holes.begin(), holes.end(), [&](auto* hole) { return lies_in(hole) == 1; })) continue;
        cell.rings.push_back(of_clipper(node->Contour));
        for (const ClipperLib::PolyNode* hole : node->Childs) cell.rings.push_back(of_clipper(hole->Contour));
        return;
    }
}

void cut_by_walls(const CellGround& ground, Vec2 at, VoronoiCell& cell) {
    cell.is_convex = true;
    if (!ground.pieces.empty()) {
        const CellGround::Piece& piece = piece_at(ground, at);
        if (piece.shape == CellGround::Shape::none) return;
        if (piece.shape != CellGround::Shape::all && !is_on(piece, at)) return;
        if (piece.shape == CellGround::Shape::convex) cut_by(cell.open, cell.scratch, piece.rings[0], -at);
        if (piece.shape == CellGround::Shape::any) {
            double on = 0;
            std::vector<Vec2> part;
            for (const std::vector<Vec2>& ring : piece.rings) {
                part.clear();
                for (Vec2 p : ring) part.push_back(p - at);
                cut_by(part, cell.scratch, cell.open);
                on += signed_area_of(part);
            }
            if (on < area_of(cell.open) * (1 - k_untouched)) {
                take_own_piece(piece, at, cell);
                cell.is_convex = cell.rings.size() == 1 && is_convex_ring(cell.rings[0]);
                return;
            }
        }
    }
    cell.rings.push_back(cell.open);
}

bool has_edge_with(const VoronoiCell& cell, Vec2 other) {
    const float apart = length(other);
    const Vec2 towards = other / apart;
    auto lies_between = [&](Vec2 p) { return std::fabs(dot(towards, p) - apart / 2) < k_no_edge / 4; };
    for (const std::vector<Vec2>& ring : cell.rings)
        for (size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i], b = ring[i + 1 < ring.size() ? i + 1 : 0];
            if (lies_between(a) && lies_between(b) && length(b - a) > k_no_edge) return true;
        }
    return false;
}

float distance_to_edge(std::span<const Vec2> zone, Vec2 p) {
    float least = 1e9f;
    for (size_t i = 0, j = zone.size() - 1; i < zone.size(); j = i++)
        least = std::min(least, length(lerp(zone[j], zone[i], closest_on(zone[j], zone[i], p)) - p));
    return least;
}

}  // namespace

PeopleGrid people_grid(std::span<const Vec2> people) {
    PeopleGrid grid{.of = people};
    if (people.empty()) {
        grid.begins = {0, 0};
        return grid;
    }
    Vec2 high = grid.low = people[0];
    for (Vec2 p : people) {
        grid.low = {std::min(grid.low.x, p.x), std::min(grid.low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    const Vec2 size = high - grid.low;
    const float most = std::max(size.x, size.z), count = static_cast<float>(people.size());
    grid.square = std::sqrt(std::max(size.x, 0.1f) * std::max(size.z, 0.1f) * k_people_a_square / count);
    grid.square = std::max({grid.square, 0.05f, most / k_most_squares});
    grid.columns = static_cast<int>(size.x / grid.square) + 1;
    grid.rows = static_cast<int>(size.z / grid.square) + 1;
    auto square_of = [&](Vec2 p) {
        const int x = std::min(static_cast<int>((p.x - grid.low.x) / grid.square), grid.columns - 1);
        const int z = std::min(static_cast<int>((p.z - grid.low.z) / grid.square), grid.rows - 1);
        return static_cast<size_t>(z) * static_cast<size_t>(grid.columns) + static_cast<size_t>(x);
    };
    grid.begins.assign(static_cast<size_t>(grid.columns) * static_cast<size_t>(grid.rows) + 1, 0);
    for (Vec2 p : people) ++grid.begins[square_of(p) + 1];
    for (size_t k = 1; k < grid.begins.size(); ++k) grid.begins[k] += grid.begins[k - 1];
    grid.who.resize(people.size());
    std::vector<uint32_t> next(grid.begins.begin(), grid.begins.end() - 1);
    for (uint32_t i = 0; i < people.size(); ++i) grid.who[next[square_of(people[i])]++] = i;
    return grid;
}

float distance_to_nearest(const PeopleGrid& people, uint32_t who) {
    float nearest = std::numeric_limits<float>::infinity();
    meet_others(
        people, who, [&](uint32_t, Vec2 away) { nearest = std::min(nearest, length(away)); },
        [&] { return nearest; });
    return nearest;
}

void make_cell(const PeopleGrid& people, uint32_t who, const CellGround& ground, VoronoiCell& cell) {
    const Vec2 at = people.of[who];
    cell.rings.clear(), cell.neighbours.clear(), cell.cutters.clear();
    begin_cell(ground, people, at, cell.open);
    cut_by_others(people, who, cell);
    cut_by_walls(ground, at, cell);
    cell.area = net_area_of(cell.rings);
    for (uint32_t other : cell.cutters)
        if (has_edge_with(cell, people.of[other] - at)) cell.neighbours.push_back(other);
}

MeasuredArea measured_area(std::span<const WalkablePolygon> outlines,
                           std::span<const WalkablePolygon> walkable, CutOff cut_off) {
    MeasuredArea area{.ground = cell_ground(outlines, cut_off)};
    if (outlines.empty()) return area;
    const CellGround whole = cell_ground(outlines, {});
    if (walkable.empty()) {
        area.square_metres = net_area_of(whole.pieces[0].rings);
        return area;
    }
    const Vec2 by = -whole.box.low;
    const CellGround ground = cell_ground(walkable, {});
    ClipperLib::Clipper clipper;
    for (const std::vector<Vec2>& ring : whole.pieces[0].rings)
        clipper.AddPath(to_clipper(ring, by), ClipperLib::ptSubject, true);
    for (const std::vector<Vec2>& ring : ground.pieces[0].rings)
        clipper.AddPath(to_clipper(ring, by), ClipperLib::ptClip, true);
    ClipperLib::Paths part;
    clipper.Execute(ClipperLib::ctIntersection, part, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    for (const ClipperLib::Path& path : part)
        area.square_metres += ClipperLib::Area(path) / (k_grain * k_grain);
    return area;
}

bool is_in(const MeasuredArea& area, Vec2 place) {
    return touch(area.ground.box, {place, place}) && is_on(piece_at(area.ground, place), place);
}

double area_within(const MeasuredArea& area, const VoronoiCell& cell, Vec2 owner) {
    if (cell.rings.empty()) return 0;
    Rectangle box{owner, owner};
    for (Vec2 p : cell.rings[0]) {
        box.low = {std::min(box.low.x, owner.x + p.x), std::min(box.low.z, owner.z + p.z)};
        box.high = {std::max(box.high.x, owner.x + p.x), std::max(box.high.z, owner.z + p.z)};
    }
    if (!touch(box, area.ground.box)) return 0;
    // Of an owner who is beside the area, it is the piece nearest to them, and what of the area lies near
    // them is near that, too.
    const CellGround::Piece& piece = piece_at(area.ground, owner);
    if (piece.shape == CellGround::Shape::none) return 0;
    if (piece.shape == CellGround::Shape::all && touch(piece.box, {owner, owner})) return cell.area;
    std::vector<Vec2> part, scratch;
    double sum = 0;
    if (cell.is_convex) {
        for (const std::vector<Vec2>& ring : piece.rings) {
            part.clear();
            for (Vec2 p : ring) part.push_back(p - owner);
            cut_by(part, scratch, cell.rings[0]);
            sum += signed_area_of(part);
        }
        return sum;
    }
    if (piece.shape != CellGround::Shape::any) {
        for (const std::vector<Vec2>& ring : cell.rings) {
            part = ring;
            cut_by(part, scratch, piece.rings[0], -owner);
            sum += signed_area_of(part);
        }
        return sum;
    }
    ClipperLib::Clipper clipper;
    for (const std::vector<Vec2>& ring : piece.rings)
        clipper.AddPath(to_clipper(ring, -owner), ClipperLib::ptSubject, true);
    for (const std::vector<Vec2>& ring : cell.rings)
        clipper.AddPath(to_clipper(ring, {}), ClipperLib::ptClip, true);
    ClipperLib::Paths both;
    clipper.Execute(ClipperLib::ctIntersection, both, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    for (const ClipperLib::Path& path : both) sum += ClipperLib::Area(path) / (k_grain * k_grain);
    return sum;
}

double voronoi_density(std::span<const Vec2> zone, std::span<const Vec2> people, CutOff cut_off) {
    const std::vector<WalkablePolygon> outline = {{{zone.begin(), zone.end()}, {}}};
    const MeasuredArea area = measured_area(outline, {}, cut_off);
    const Rectangle close = widened(area.ground.box, cut_off.radius),
                    wide_box = widened(area.ground.box, 3 * cut_off.radius);
    auto lies_in = [](const Rectangle& box, Vec2 p) { return touch(box, {p, p}); };
    std::vector<Vec2> near;
    for (Vec2 p : people)
        if (lies_in(wide_box, p)) near.push_back(p);
    const PeopleGrid grid = people_grid(near);
    const CellGround everywhere{.cut_off = cut_off};
    VoronoiCell cell;
    double sum = 0;
    for (uint32_t i = 0; i < near.size(); ++i) {
        if (!lies_in(close, near[i])) continue;
        // Cells far from the outline lie all within it, or all outside.
        if (distance_to_edge(zone, near[i]) >= cut_off.radius) {
            if (is_in(area, near[i])) ++sum;
            continue;
        }
        make_cell(grid, i, everywhere, cell);
        if (cell.area > 0) sum += area_within(area, cell, near[i]) / cell.area;
    }
    return sum / area_of(zone);
}

}  // namespace flaneur
