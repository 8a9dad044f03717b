// What is paved from wall to wall: where cars do not part people from houses.
#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "assets/plan/masses.h"

namespace flaneur {

namespace {

constexpr float k_step = 1;          // between looks at the houses, metres
constexpr float k_gap = 12;          // between houses, where the pavement goes on in line with them, metres
constexpr float k_into_wall = 0.4f;  // so that no strip is left before a wall askew, metres
constexpr float k_overhead = 2.4f;   // what begins higher above the ground stops no pavement, metres

// A place of a line, and the way out from it to one side.
struct Look {
    Vec2 at, out;
    float along;               // metres from the line's start
    std::optional<float> off;  // to the wall
};

// Every metre, and round the corners; `side` is 1 to the left.
std::vector<Look> looks_of(const std::vector<Vec2>& line, float side) {
    std::vector<Look> looks;
    float along = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        Vec2 a = line[i], b = line[i + 1], way = normalize_or(b - a, {1, 0});
        Vec2 out = Vec2{way.z, -way.x} * side;
        if (!looks.empty()) {
            // Out of a bend to its outer side too.
            Vec2 before = looks.back().out;
            for (float share : {0.25f, 0.5f, 0.75f})
                looks.push_back({a, normalize_or(lerp(before, out, share), out), along, {}});
        }
        float whole = length(b - a);
        int steps = std::max(1, static_cast<int>(std::ceil(whole / k_step)));
        for (int s = 0; s <= steps; ++s) {
            float share = static_cast<float>(s) / static_cast<float>(steps);
            looks.push_back({lerp(a, b, share), out, along + whole * share, {}});
        }
        along += whole;
    }
    return looks;
}

// Closed: bounded by what is known before it and after it, as far as both are near.
void bridge_gaps(std::vector<Look>& looks) {
    for (size_t i = 0; i < looks.size(); ++i) {
        if (looks[i].off) continue;
        size_t end = i;
        while (end < looks.size() && !looks[end].off) ++end;
        if (i > 0 && end < looks.size() && looks[end].along - looks[i - 1].along < k_gap) {
            const Look &first = looks[i - 1], &last = looks[end];
            float span = std::max(last.along - first.along, 1e-3f), from = *first.off, to = *last.off;
            for (size_t k = i; k < end; ++k)
                looks[k].off = lerp(from, to, (looks[k].along - first.along) / span);
        }
        i = end;
    }
}

// The walls that stand on the ground.
SegmentIndex find_walls(const OsmImport& in) {
    SegmentIndex walls;
    for (const OsmMass& mass : in.masses) {
        for (const Ring& ring : mass.rings) {
            for (size_t i = 0; i < ring.size(); ++i) {
                Vec2 a = to_metres(ring[i]), b = to_metres(ring[(i + 1) % ring.size()]);
                if (mass.bottom < terrain_at(in.plan, a) + k_overhead) walls.add(a, b, 0, 0);
            }
        }
    }
    walls.sort();
    return walls;
}

Rings paved_of(const OsmImport& in, const SegmentIndex& walls, const OsmPaving& paving) {
    Rings paved;
    std::vector<Look> sides[2];
    for (int s = 0; s < 2; ++s) {
        float far = s == 0 ? paving.left : paving.right;
        if (far <= 0) continue;
        sides[s] = looks_of(paving.line, s == 0 ? 1.0f : -1.0f);
        for (Look& look : sides[s]) {
            Vec2 end = look.at + look.out * far;
            float nearest = 2;
            auto meet = [&](const LinePiece& piece) {
                if (std::optional<float> share = crossing_on(look.at, end, piece.a, piece.b))
                    nearest = std::min(nearest, *share);
            };
            walls.near(lerp(look.at, end, 0.5f), far * 0.5f, meet);
            auto meet_street = [&](const LinePiece& piece) {
                if (piece.half > 0) meet(piece);
            };
            if (paving.to_streets) in.streets.near(lerp(look.at, end, 0.5f), far * 0.5f, meet_street);
            if (nearest <= 1) look.off = nearest * far;
        }
    }
    if (paving.needs_both) {
        for (size_t i = 0; i < std::min(sides[0].size(), sides[1].size()); ++i) {
            if (!sides[0][i].off || !sides[1][i].off) sides[0][i].off = sides[1][i].off = std::nullopt;
        }
    }
    for (std::vector<Look>& looks : sides) {
        bridge_gaps(looks);
        for (size_t i = 0; i + 1 < looks.size(); ++i) {
            const Look &a = looks[i], &b = looks[i + 1];
            if (!a.off || !b.off) continue;
            // A house that stands back: up to its wall at once; the one before it hides the rest.
            float off = std::max(*a.off, *b.off) + k_into_wall;
            Ring ring = positive(
                {to_point(a.at), to_point(b.at), to_point(b.at + b.out * off), to_point(a.at + a.out * off)});
            if (twice_area(ring) > 0) paved.push_back(std::move(ring));
        }
    }
    return unite(paved);
}

}  // namespace

void pave_to_walls(OsmImport& in) {
    SegmentIndex walls = find_walls(in);
    for (const OsmPaving& paving : in.pavings) {
        Area area = paving.area;
        area.rank = k_rank_apron;
        area.rings = paved_of(in, walls, paving);
        if (!area.rings.empty()) in.plan.areas.push_back(std::move(area));
    }
}

}  // namespace flaneur
