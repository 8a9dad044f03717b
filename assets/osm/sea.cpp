// The sea, which the map knows only by its coastlines.
#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "assets/plan/masses.h"

namespace flaneur {

namespace {

// Where on the border of the box a point lies: 0..4 clockwise on the map from the north-western corner.
double border_place(Point low, Point high, Point p) {
    auto share = [](int64_t v, int64_t from, int64_t to) {
        return std::clamp(static_cast<double>(v - from) / static_cast<double>(to - from), 0.0, 1.0);
    };
    int64_t north = std::abs(p.Y - low.Y), east = std::abs(high.X - p.X), south = std::abs(high.Y - p.Y),
            west = std::abs(p.X - low.X);
    int64_t least = std::min({north, east, south, west});
    if (least == north) return share(p.X, low.X, high.X);
    if (least == east) return 1 + share(p.Y, low.Y, high.Y);
    if (least == south) return 2 + 1 - share(p.X, low.X, high.X);
    return 3 + 1 - share(p.Y, low.Y, high.Y);
}

Point border_point(Point low, Point high, double place) {
    Point corners[5] = {low, {high.X, low.Y}, high, {low.X, high.Y}, low};
    int side = std::min(3, static_cast<int>(place));
    double t = place - side;
    Point a = corners[side], b = corners[side + 1];
    return {a.X + std::llround(static_cast<double>(b.X - a.X) * t),
            a.Y + std::llround(static_cast<double>(b.Y - a.Y) * t)};
}

double length_of(const Ring& line) {
    double sum = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        sum += static_cast<double>(length(to_metres(line[i + 1]) - to_metres(line[i])));
    }
    return sum;
}

// Whether much of the map's streets lies in the ring: then its coastline was cut short, and it is no sea.
bool holds_streets(const OsmImport& in, const Ring& ring) {
    int streets = 0, inside = 0;
    for (const OsmWay& way : in.map.ways) {
        std::optional<OsmHighway> highway = highway_of(way.tags);
        if (!highway || !highway->drives || way.nodes.empty()) continue;
        const OsmNode* node = in.map.node(way.nodes[way.nodes.size() / 2]);
        if (!node) continue;
        ++streets;
        inside += contains({ring}, to_point(in.project(*node)));
    }
    return inside * 5 > streets;
}

}  // namespace

// Coastlines have the sea on their right hand. Each stretch inside the box is led on along the border,
// clockwise on the map, to where the next one comes in.
void add_osm_sea(OsmImport& in) {
    std::vector<std::vector<int64_t>> coast;
    for (const OsmWay& way : in.map.ways) {
        if (way.tags.is("natural", "coastline") && way.nodes.size() >= 2) coast.push_back(way.nodes);
    }
    // Head to tail: a coastline's direction matters.
    for (size_t i = 0; i < coast.size(); ++i) {
        for (size_t k = 0; k < coast.size();) {
            if (k == i || coast[i].front() == coast[i].back() || coast[k].front() != coast[i].back()) {
                ++k;
                continue;
            }
            coast[i].insert(coast[i].end(), coast[k].begin() + 1, coast[k].end());
            coast.erase(coast.begin() + static_cast<std::ptrdiff_t>(k));
            if (k < i) --i;
            k = 0;
        }
    }
    Point low = to_point(in.plan.low), high = to_point(in.plan.high);
    Rings closed, open;
    for (const std::vector<int64_t>& nodes : coast) {
        Ring line;
        for (int64_t id : nodes) {
            if (const OsmNode* node = in.map.node(id)) line.push_back(to_point(in.project(*node)));
        }
        if (line.size() < 2) continue;
        if (nodes.front() == nodes.back()) {
            line.pop_back();
            closed.push_back(std::move(line));
            continue;
        }
        ClipperLib::Clipper clipper;
        clipper.AddPath(line, ClipperLib::ptSubject, false);
        clipper.AddPath(rectangle(low, high), ClipperLib::ptClip, true);
        ClipperLib::PolyTree tree;
        clipper.Execute(ClipperLib::ctIntersection, tree);
        Rings inside;
        ClipperLib::OpenPathsFromPolyTree(tree, inside);
        for (Ring& part : inside) {
            if (part.size() < 2 || length_of(part) < 100) continue;  // stumps at the border lead astray
            // Clipper may turn a line round: find a corner of the original and see which way it went on.
            for (size_t i = 0; i + 1 < line.size(); ++i) {
                auto a = std::find(part.begin(), part.end(), line[i]),
                     b = std::find(part.begin(), part.end(), line[i + 1]);
                if (a == part.end() || b == part.end()) continue;
                if (b < a) std::reverse(part.begin(), part.end());
                break;
            }
            open.push_back(std::move(part));
        }
    }
    Rings sea;
    std::vector<bool> used(open.size());
    for (size_t first = 0; first < open.size(); ++first) {
        if (used[first]) continue;
        Ring ring;
        for (size_t at = first; !used[at];) {
            used[at] = true;
            ring.insert(ring.end(), open[at].begin(), open[at].end());
            double from = border_place(low, high, open[at].back()), nearest = 1e9;
            size_t next = first;
            for (size_t k = 0; k < open.size(); ++k) {
                double ahead = border_place(low, high, open[k].front()) - from;
                if (ahead <= 0) ahead += 4;
                if ((!used[k] || k == first) && ahead < nearest) nearest = ahead, next = k;
            }
            ring.push_back(border_point(low, high, from));
            for (int corner = 1; corner <= 8; ++corner) {
                if (corner > from && corner < from + nearest)
                    ring.push_back(border_point(low, high, corner % 4));
            }
            double to = from + nearest;
            ring.push_back(border_point(low, high, to >= 4 ? to - 4 : to));
            at = next;
        }
        ring = positive(std::move(ring));
        if (!holds_streets(in, ring)) sea.push_back(std::move(ring));
    }
    sea = unite(sea);
    Rings islands, basins;
    for (Ring& ring : closed) {
        // With the sea on the right, an island runs counter-clockwise on the map: negatively.
        (twice_area(ring) < 0 ? islands : basins).push_back(positive(ring));
    }
    sea.insert(sea.end(), basins.begin(), basins.end());
    if (sea.empty()) return;
    for (const Region& region : regions_of(subtract(unite(sea), islands))) {
        Area water;
        water.rank = k_rank_water;
        water.kind = Surface::water;
        water.lift = level(-0.6f);
        water.rings = rings_of(region);
        in.plan.areas.push_back(std::move(water));
    }
}

}  // namespace flaneur
