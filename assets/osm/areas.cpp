#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "assets/plan/masses.h"

namespace flaneur {

std::vector<std::vector<Vec2>> lines_of(const OsmImport& in, const OsmWay& way) {
    std::vector<std::vector<Vec2>> lines(1);
    for (int64_t id : way.nodes) {
        if (const OsmNode* node = in.map.node(id)) {
            lines.back().push_back(in.project(*node));
        } else if (!lines.back().empty()) {
            lines.emplace_back();
        }
    }
    std::erase_if(lines, [](const std::vector<Vec2>& line) { return line.size() < 2; });
    return lines;
}

// Outlines that cross themselves a few times are mended; what crosses itself more often is no outline.
static constexpr int k_most_crossings = 100;

// None where a node is missing, or where it is a tangle.
static std::optional<Ring> ring_of(OsmImport& in, const std::vector<int64_t>& nodes) {
    Ring ring;
    for (int64_t id : nodes) {
        const OsmNode* node = in.map.node(id);
        if (!node) return std::nullopt;
        ring.push_back(to_point(in.project(*node)));
    }
    ring.pop_back();
    if (is_tangled(ring, k_most_crossings)) {
        ++in.counts.tangled;
        return std::nullopt;
    }
    return positive(std::move(ring));
}

// Specks of less than a square metre are errors of drawing.
static std::vector<Region> large_regions(const Rings& rings) {
    std::vector<Region> regions = regions_of(rings);
    std::erase_if(regions, [](const Region& r) { return area(rings_of(r)) < 1; });
    return regions;
}

std::vector<Region> regions_of_way(OsmImport& in, const OsmWay& way) {
    if (!way.closed()) return {};
    std::optional<Ring> ring = ring_of(in, way.nodes);
    return ring ? large_regions({*ring}) : std::vector<Region>{};
}

// Joins ways end to end into closed rings; empty where any stays open.
static std::vector<std::vector<int64_t>> close_rings(std::vector<std::vector<int64_t>> parts) {
    std::vector<std::vector<int64_t>> rings;
    while (!parts.empty()) {
        std::vector<int64_t> ring = std::move(parts.front());
        parts.erase(parts.begin());
        while (ring.front() != ring.back()) {
            auto next = std::find_if(parts.begin(), parts.end(), [&](const std::vector<int64_t>& p) {
                return p.front() == ring.back() || p.back() == ring.back();
            });
            if (next == parts.end()) return {};
            if (next->front() != ring.back()) std::reverse(next->begin(), next->end());
            ring.insert(ring.end(), next->begin() + 1, next->end());
            parts.erase(next);
        }
        if (ring.size() > 3) rings.push_back(std::move(ring));
    }
    return rings;
}

std::vector<Region> regions_of_relation(OsmImport& in, const OsmRelation& relation) {
    Rings sides[2];
    for (bool inner : {false, true}) {
        std::vector<std::vector<int64_t>> parts;
        for (const OsmRelation::Member& member : relation.ways) {
            if (member.inner != inner || member.part) continue;
            const OsmWay* way = in.map.way(member.way);
            if (way && way->nodes.size() >= 2) parts.push_back(way->nodes);
            if (!way && !inner) parts.clear();
            if (!way) break;
        }
        bool any = !parts.empty();
        std::vector<std::vector<int64_t>> closed = close_rings(std::move(parts));
        if (!inner && (!any || closed.empty())) {
            ++in.counts.broken_relations;
            return {};
        }
        for (const std::vector<int64_t>& nodes : closed) {
            std::optional<Ring> ring = ring_of(in, nodes);
            if (ring) sides[inner].push_back(std::move(*ring));
        }
    }
    return large_regions(subtract(unite(sides[0]), sides[1]));
}

namespace {

struct AreaKind {
    int rank;
    Surface kind;
    float lift = k_kerb;
};

std::optional<AreaKind> area_kind(const OsmTags& tags) {
    if (is_hidden(tags)) return std::nullopt;
    if (tags.is("amenity", "fountain")) return AreaKind{k_rank_basin, Surface::water, k_kerb + 0.4f};
    if (tags.is("natural", "water") || is_one_of(tags["waterway"], {"riverbank", "dock"}) ||
        tags.is("leisure", "swimming_pool")) {
        return AreaKind{k_rank_water, Surface::water, -0.3f};
    }
    if (std::optional<float> height = platform_of(tags))
        return AreaKind{k_rank_platform, Surface::plaza, *height};
    if (is_one_of(tags["highway"], {"pedestrian", "footway", "platform"}) || tags.is("place", "square") ||
        is_one_of(tags["area:highway"], {"pedestrian", "footway"}) || tags.is("man_made", "pier")) {
        return AreaKind{k_rank_plaza, Surface::plaza};
    }
    if (is_one_of(tags["amenity"], {"parking", "fuel", "bus_station"}) ||
        is_one_of(tags["highway"], {"service", "residential"})) {
        return AreaKind{k_rank_path, Surface::road};
    }
    if (is_one_of(tags["leisure"],
                  {"park", "garden", "pitch", "playground", "golf_course", "dog_park", "track"}) ||
        is_one_of(tags["landuse"], {"grass", "forest", "meadow", "village_green", "recreation_ground",
                                    "cemetery", "flowerbed", "orchard"}) ||
        is_one_of(tags["natural"], {"wood", "scrub", "grassland", "heath", "shrubbery"})) {
        return AreaKind{k_rank_grass, Surface::grass};
    }
    if (is_one_of(tags["natural"], {"beach", "sand", "bare_rock", "shingle"}) ||
        is_one_of(tags["landuse"], {"construction", "brownfield"})) {
        return AreaKind{k_rank_grass, Surface::path};
    }
    if (tags.is("landuse", "railway")) return AreaKind{k_rank_grass, Surface::track, k_track};
    return std::nullopt;
}

// Tags that make an area of a closed way only when it says so: closed footways are mostly loops.
bool may_be_area(const OsmTags& tags) {
    return !(tags.has("highway") && !tags.is("highway", "platform")) || tags.is("area", "yes") ||
           tags.has("area:highway");
}

}  // namespace

// Squares reach the houses about them.
static void pave_about(OsmImport& in, const Area& square) {
    constexpr float k_about = 6;  // metres
    for (const Ring& ring : square.rings) {
        OsmPaving paving;
        for (Point p : ring) paving.line.push_back(to_metres(p));
        for (size_t i : {0, 1}) paving.line.push_back(paving.line[i]);  // round the first corner too
        paving.left = k_about;
        paving.area = square;
        paving.area.rings.clear();
        in.pavings.push_back(std::move(paving));
    }
}

void add_osm_areas(OsmImport& in) {
    auto add = [&](const OsmTags& tags, const std::vector<Region>& regions) {
        std::optional<AreaKind> kind = area_kind(tags);
        if (!regions.empty()) count_built(in.counts, tags, OsmSort::pedestrian_area, OsmSort::water);
        if (!regions.empty() && kind && kind->rank == k_rank_platform)
            count_built(in.counts, OsmSort::platform);
        for (const Region& region : regions) {
            Area area;
            area.rank = kind->rank;
            area.kind = kind->kind;
            area.lift = flat(kind->lift);
            if (kind->kind == Surface::track) area.axis = {};
            if (kind->rank == k_rank_water) area.lift = level(lowest_ground(in.plan, region) + kind->lift);
            area.rings = rings_of(region);
            if (kind->rank == k_rank_plaza) pave_about(in, area);
            in.plan.areas.push_back(std::move(area));
        }
    };
    for (const OsmWay& way : in.map.ways) {
        if (way.closed() && may_be_area(way.tags) && area_kind(way.tags))
            add(way.tags, regions_of_way(in, way));
    }
    for (const OsmRelation& relation : in.map.relations) {
        if (area_kind(relation.tags)) add(relation.tags, regions_of_relation(in, relation));
    }
}

}  // namespace flaneur
