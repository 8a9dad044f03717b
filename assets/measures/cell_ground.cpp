#include "assets/measures/cell_ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/base/planar.h"

namespace flaneur {
namespace {

constexpr float k_shortest = 1e-4f;   // metres, of an edge that cuts: rounding turns shorter ones any way
constexpr size_t k_few_corners = 12;  // that are not worth halving
constexpr int k_deepest = 24;

using PieceRings = std::vector<std::vector<Vec2>>;

double area_in(const PieceRings& rings) {
    double sum = 0;
    for (const std::vector<Vec2>& ring : rings) sum += signed_area_of(ring);
    return sum;
}

PieceRings part_of(const PieceRings& rings, const Rectangle& box) {
    const std::vector<Vec2> corners = {box.low, {box.high.x, box.low.z}, box.high, {box.low.x, box.high.z}};
    PieceRings part;
    std::vector<Vec2> scratch;
    for (std::vector<Vec2> ring : rings) {
        cut_by(ring, scratch, corners);
        if (area_of(ring) > 1e-9) part.push_back(std::move(ring));
    }
    return part;
}

void make_piece(CellGround& ground, size_t at, const PieceRings& rings, int depth) {
    const Rectangle box = ground.pieces[at].box;
    const Vec2 size = box.high - box.low;
    const float reach = ground.cut_off.radius;
    size_t corners = 0;
    for (const std::vector<Vec2>& ring : rings) corners += ring.size();
    const bool is_leaf =
        reach <= 0 || corners <= k_few_corners || depth == k_deepest || std::max(size.x, size.z) <= 2 * reach;
    if (is_leaf) {
        const Vec2 wide_size = size + Vec2{2 * reach, 2 * reach};
        const double all = wide(wide_size.x) * wide(wide_size.z);
        CellGround::Piece& piece = ground.pieces[at];
        if (rings.empty())
            piece.shape = CellGround::Shape::none;
        else if (reach > 0 && area_in(rings) >= all * (1 - 1e-6))
            piece.shape = CellGround::Shape::all;
        else if (rings.size() == 1 && is_convex_ring(rings[0]))
            piece.shape = CellGround::Shape::convex;
        else
            piece.shape = CellGround::Shape::any;
        piece.rings = rings;
        return;
    }
    const auto halves = static_cast<uint32_t>(ground.pieces.size());
    ground.pieces[at].halves = halves;
    Rectangle low = box, high = box;
    const Vec2 middle = (box.low + box.high) * 0.5f;
    if (size.x >= size.z)
        low.high.x = high.low.x = middle.x;
    else
        low.high.z = high.low.z = middle.z;
    for (const Rectangle& half : {low, high}) {
        ground.pieces.emplace_back();
        ground.pieces.back().box = half;
    }
    make_piece(ground, halves, part_of(rings, widened(low, reach)), depth + 1);
    make_piece(ground, halves + 1, part_of(rings, widened(high, reach)), depth + 1);
}

}  // namespace

void cut_by(std::vector<Vec2>& polygon, std::vector<Vec2>& scratch, Vec2 normal, float most) {
    scratch.clear();
    cut(
        polygon, [&](Vec2 p) { return most - dot(normal, p); }, [&](Vec2 p) { scratch.push_back(p); });
    std::swap(polygon, scratch);
}

void cut_by(std::vector<Vec2>& polygon, std::vector<Vec2>& scratch, std::span<const Vec2> convex, Vec2 by) {
    for (size_t k = 0; k < convex.size() && !polygon.empty(); ++k) {
        const Vec2 a = convex[k] + by, b = convex[k + 1 < convex.size() ? k + 1 : 0] + by;
        if (length_squared(b - a) < k_shortest * k_shortest) continue;
        const Vec2 out = Vec2{b.z - a.z, a.x - b.x} / length(b - a);
        cut_by(polygon, scratch, out, dot(out, a));
    }
}

bool is_convex_ring(std::span<const Vec2> ring) {
    double turned = 0;
    for (size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], c = ring[(i + 2) % ring.size()];
        if (crossed(a, b, c) < -1e-6 * wide(length(b - a) * length(c - b))) return false;
        const Vec2 way = b - a, next = c - b;
        turned += std::atan2(wide(cross(way, next)), wide(dot(way, next)));
    }
    return ring.size() >= 3 && turned < 6.3;  // once round, not twice
}

CellGround cell_ground(std::span<const WalkablePolygon> area, CutOff cut_off) {
    CellGround ground{.cut_off = cut_off};
    PieceRings rings;
    for (const WalkablePolygon& polygon : area) {
        auto add = [&](std::vector<Vec2> ring, bool is_hole) {
            if ((signed_area_of(ring) < 0) != is_hole) std::reverse(ring.begin(), ring.end());
            rings.push_back(std::move(ring));
        };
        add(polygon.outer, false);
        for (const std::vector<Vec2>& hole : polygon.holes) add(hole, true);
    }
    if (rings.empty()) return ground;
    ground.box = {rings[0][0], rings[0][0]};
    for (const std::vector<Vec2>& ring : rings)
        for (Vec2 p : ring) {
            ground.box.low = {std::min(ground.box.low.x, p.x), std::min(ground.box.low.z, p.z)};
            ground.box.high = {std::max(ground.box.high.x, p.x), std::max(ground.box.high.z, p.z)};
        }
    ground.pieces.emplace_back();
    ground.pieces[0].box = ground.box;
    make_piece(ground, 0, rings, 0);
    return ground;
}

const CellGround::Piece& piece_at(const CellGround& ground, Vec2 place) {
    size_t at = 0;
    while (const uint32_t halves = ground.pieces[at].halves) {
        const Vec2 middle = ground.pieces[halves].box.high;
        const Vec2 begin = ground.pieces[halves + 1].box.low;
        const bool is_high =
            begin.x > ground.pieces[at].box.low.x ? place.x >= middle.x : place.z >= middle.z;
        at = halves + is_high;
    }
    return ground.pieces[at];
}

bool is_on(const CellGround::Piece& piece, Vec2 place) {
    bool is_odd = false;
    for (const std::vector<Vec2>& ring : piece.rings) is_odd ^= is_within(ring, place);
    return is_odd;
}

}  // namespace flaneur
