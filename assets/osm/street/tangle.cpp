// Whether the lines of a map cross as those of places do.
#include <cmath>
#include <string>

#include "assets/osm/map.h"

namespace flaneur {

namespace {

// Towns and cities have one crossing without a common node, as of a bridge and what it leads over, to some
// seventeen straight pieces of their lines or more, and pieces are 170 m long at most on the average. Ground
// for what is more takes ever longer to cut.
constexpr size_t k_pieces_to_crossing = 2, k_few = 1000;
constexpr double k_piece_km = 1, k_few_km = 100;

SegmentIndex lines_on(const OsmImport& in) {
    SegmentIndex lines;
    for (uint32_t w = 0; w < in.map.ways.size(); ++w) {
        const OsmWay& way = in.map.ways[w];
        if (!highway_of(way.tags) && !track_of(way.tags) && !way.tags.has("barrier")) continue;
        const OsmNode* before = nullptr;
        for (int64_t id : way.nodes) {
            const OsmNode* node = in.map.node(id);
            if (before && node) lines.add(in.project(*before), in.project(*node), w, 0);
            before = node;
        }
    }
    lines.sort();
    return lines;
}

bool share_an_end(const LinePiece& a, const LinePiece& b) {
    auto same = [](Vec2 p, Vec2 q) { return p.x == q.x && p.z == q.z; };
    return same(a.a, b.a) || same(a.a, b.b) || same(a.b, b.a) || same(a.b, b.b);
}

}  // namespace

Result<void> refuse_tangle(const OsmImport& in, const std::string& path) {
    SegmentIndex lines = lines_on(in);
    double km = 0, most_km = k_few_km + k_piece_km * static_cast<double>(lines.segments.size());
    for (const LinePiece& s : lines.segments) km += static_cast<double>(length(s.b - s.a)) / 1000;
    if (km > most_km) {
        return Error{"The map " + path + " has " + std::to_string(std::lround(km)) +
                     " km of streets, tracks and walls in " + std::to_string(lines.segments.size()) +
                     " straight pieces, more than " + std::to_string(std::lround(most_km)) +
                     " km; no place has such long ones. Mend it or take another extract."};
    }
    size_t most = k_few + lines.segments.size() / k_pieces_to_crossing, crossings = 0;
    const auto& squares = lines.by_square;
    for (size_t first = 0, end = 0; first < squares.size(); first = end) {
        while (end < squares.size() && squares[end].first == squares[first].first) ++end;
        for (size_t i = first; i < end; ++i) {
            const LinePiece& a = lines.segments[squares[i].second];
            for (size_t j = i + 1; j < end; ++j) {
                const LinePiece& b = lines.segments[squares[j].second];
                if (a.owner == b.owner || share_an_end(a, b)) continue;
                std::optional<float> share = crossing_on(a.a, a.b, b.a, b.b);
                if (!share) continue;
                // They may run side by side through several squares.
                Vec2 at = lerp(a.a, a.b, *share);
                if (std::pair(SegmentIndex::square(at.x), SegmentIndex::square(at.z)) != squares[i].first)
                    continue;
                if (++crossings <= most) continue;
                auto id = [&](const LinePiece& s) { return std::to_string(in.map.ways[s.owner].id); };
                return Error{"The map " + path +
                             " has streets, tracks or walls that cross without a common node more than " +
                             std::to_string(most) + " times, ways " + id(a) + " and " + id(b) +
                             " for two; no place has so many to " + std::to_string(lines.segments.size()) +
                             " pieces of line. Mend it or take another extract."};
            }
        }
    }
    return {};
}

}  // namespace flaneur
