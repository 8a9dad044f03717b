#include <algorithm>
#include <cmath>
#include <map>

#include "assets/osm/house.h"
#include "assets/osm/map.h"
#include "assets/plan/masses.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_passage = 3.8f, k_out_of_passage = 0.8f;  // height; beyond either end, metres
constexpr float k_near = 250;                               // neighbours that a building is like, metres
constexpr float k_least_room = 2.6f;  // from the highest ground at a building to its eaves

struct FoundBuilding {
    int64_t id;
    const OsmTags* tags;
    Region region;
    Point low, high;  // its box
    bool part = false;
    const FoundBuilding* whole = nullptr;           // of a part: what it is a part of
    float foot = 0, peak = 0;                       // lowest and highest ground along it
    Rings parts;                                    // of an outline: what its building:parts cover
    float lowest_part = 0;                          // top of the lowest of them, above the foot, metres
    std::vector<std::pair<Rings, float>> floating;  // parts that start above the ground, and where
};

bool apart(const FoundBuilding& a, Point low, Point high) {
    return a.high.X < low.X || high.X < a.low.X || a.high.Y < low.Y || high.Y < a.low.Y;
}

void measure(const GroundPlan& plan, FoundBuilding& f) {
    f.low = f.high = f.region.outer[0];
    f.foot = f.peak = terrain_at(plan, to_metres(f.low));
    for (size_t i = 0; i < f.region.outer.size(); ++i) {
        Point p = f.region.outer[i], q = f.region.outer[(i + 1) % f.region.outer.size()];
        f.low = {std::min(f.low.X, p.X), std::min(f.low.Y, p.Y)};
        f.high = {std::max(f.high.X, p.X), std::max(f.high.Y, p.Y)};
        int steps =
            plan.terrain ? std::min(64, 1 + static_cast<int>(length(to_metres(q) - to_metres(p)) / 4)) : 0;
        for (int s = 0; s < steps; ++s) {
            float y = terrain_at(
                plan, lerp(to_metres(p), to_metres(q), static_cast<float>(s) / static_cast<float>(steps)));
            f.foot = std::min(f.foot, y), f.peak = std::max(f.peak, y);
        }
    }
}

// What sort of building a relation says it is, its outline and parts are.
void join_outlines(OsmImport& in) {
    for (const OsmRelation& relation : in.map.relations) {
        if (!relation.tags.is("type", "building")) continue;
        for (const OsmRelation::Member& member : relation.ways) {
            const OsmWay* way = in.map.way(member.way);
            if (!way || member.inner) continue;
            OsmTags& tags = in.joined[way->id];
            if (tags.items.empty()) tags = way->tags;
            for (const auto& item : relation.tags.items) {
                if (is_one_of(item.first, {"man_made", "historic", "amenity"})) tags.items.push_back(item);
            }
        }
    }
}

std::vector<FoundBuilding> find_buildings(OsmImport& in) {
    std::vector<FoundBuilding> all;
    auto consider = [&](int64_t id, const OsmTags& tags, auto regions) {
        std::string_view building = tags["building"], part = tags["building:part"];
        bool wanted =
                 (!building.empty() && building != "no") ||
                 (building.empty() && part.empty() && is_structure(tags) && !tags.is("type", "building")),
             is_part = !wanted && !part.empty() && part != "no";
        if (!wanted && !is_part) return;
        if (is_hidden(tags)) {
            ++in.counts.hidden;
            return;
        }
        for (Region& region : regions()) {
            Ring& outer = region.outer;
            Point p = outer[0];
            if (p.X < to_point(in.plan.low).X || p.Y < to_point(in.plan.low).Y ||
                p.X > to_point(in.plan.high).X || p.Y > to_point(in.plan.high).Y) {
                ++in.counts.outside;
                continue;
            }
            outer = without_collinear(outer, 40);
            for (Ring& hole : region.holes) hole = without_collinear(hole, 40);
            FoundBuilding found{id, &tags, std::move(region), {}, {}, is_part, nullptr, 0, 0, {}, 0, {}};
            measure(in.plan, found);
            all.push_back(std::move(found));
        }
    };
    join_outlines(in);
    for (const OsmNode& node : in.map.nodes) {
        if (std::optional<Ring> ring = round_structure(node.tags, in.project(node)))
            consider(node.id, node.tags, [&] { return std::vector<Region>{{*ring, {}}}; });
    }
    for (const OsmWay& way : in.map.ways) {
        auto joined = in.joined.find(way.id);
        consider(way.id, joined == in.joined.end() ? way.tags : joined->second, [&] {
            in.counts.open_buildings += !way.closed();
            return regions_of_way(in, way);
        });
    }
    for (const OsmRelation& relation : in.map.relations) {
        consider(relation.id, relation.tags, [&] { return regions_of_relation(in, relation); });
    }
    return all;
}

// What stands around buildings, for what their tags leave open.
struct BuildingsAround {
    struct Known {
        Vec2 place;
        float storeys;
    };
    std::vector<Known> known;  // sorted by x
    float usual = 4;           // of the whole map
    bool pitched = false, tiles = false;
    std::vector<std::pair<int, int>>
        traffic;                // squares of k_square metres with streets for cars in them; sorted
    std::vector<Point> shared;  // corners of two buildings; sorted

    static constexpr float k_square = 12;
    static int square(float v) { return static_cast<int>(std::floor(v / k_square)); }
};

float median(std::vector<float>& values) {
    auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

BuildingsAround look_around(OsmImport& in, const std::vector<FoundBuilding>& all) {
    BuildingsAround around;
    // In Europe small houses have pitched roofs, south of the Alps of terracotta; elsewhere who knows.
    double west = in.project.longitude, north = in.project.latitude;
    around.pitched = north > 35 && north < 72 && west > -11 && west < 42;
    around.tiles = around.pitched && north < 45.6;
    std::vector<float> storeys;
    std::vector<Point> corners;
    for (const FoundBuilding& f : all) {
        if (!f.part) corners.insert(corners.end(), f.region.outer.begin(), f.region.outer.end());
        std::optional<float> levels = known_storeys(*f.tags);
        if (!levels || is_outbuilding(*f.tags) || area(rings_of(f.region)) < 60) continue;
        storeys.push_back(*levels);
        around.known.push_back({to_metres(f.region.outer[0]), *levels});
    }
    if (storeys.size() >= 8) around.usual = clamp(std::floor(median(storeys) + 0.5f), 2, 12);
    std::stable_sort(around.known.begin(), around.known.end(),
                     [](const auto& a, const auto& b) { return a.place.x < b.place.x; });
    std::sort(corners.begin(), corners.end(), point_less);
    for (size_t i = 0; i + 1 < corners.size(); ++i) {
        bool again = !around.shared.empty() && around.shared.back() == corners[i];
        if (corners[i] == corners[i + 1] && !again) around.shared.push_back(corners[i]);
    }
    for (const OsmWay& way : in.map.ways) {
        std::optional<OsmHighway> highway = highway_of(way.tags);
        if (!highway || !highway->drives) continue;
        for (int64_t id : way.nodes) {
            const OsmNode* node = in.map.node(id);
            if (!node) continue;
            Vec2 p = in.project(*node);
            around.traffic.push_back({BuildingsAround::square(p.x), BuildingsAround::square(p.z)});
        }
    }
    std::sort(around.traffic.begin(), around.traffic.end());
    return around;
}

OsmSurroundings surroundings_of(const BuildingsAround& around, const FoundBuilding& f) {
    OsmSurroundings s{around.usual, around.pitched, around.tiles, false};
    Vec2 here = lerp(to_metres(f.low), to_metres(f.high), 0.5f);
    std::vector<float> near;
    auto at = std::lower_bound(around.known.begin(), around.known.end(), here.x - k_near,
                               [](const auto& known, float x) { return known.place.x < x; });
    for (; at != around.known.end() && at->place.x < here.x + k_near && near.size() < 1000; ++at) {
        if (length(at->place - here) < k_near) near.push_back(at->storeys);
    }
    if (near.size() >= 6) s.storeys = clamp(std::floor(median(near) + 0.5f), 2, 12);

    int neighbours = 0;
    for (Point p : f.region.outer)
        neighbours += std::binary_search(around.shared.begin(), around.shared.end(), p, point_less);
    bool cars = false;
    for (int x = BuildingsAround::square(to_metres(f.low).x) - 1;
         x <= BuildingsAround::square(to_metres(f.high).x) + 1; ++x) {
        std::pair<int, int> from{x, BuildingsAround::square(to_metres(f.low).z) - 1};
        auto first = std::lower_bound(around.traffic.begin(), around.traffic.end(), from);
        cars |= first != around.traffic.end() && first->first == x &&
                first->second <= BuildingsAround::square(to_metres(f.high).z) + 1;
    }
    s.old = around.pitched && neighbours >= 3 && !cars;
    return s;
}

// A way through buildings at street level, with its box.
struct Passage {
    Rings rings;
    Point low, high;
};

std::vector<Passage> find_passages(const OsmImport& in) {
    std::vector<Passage> passages;
    for (const OsmWay& way : in.map.ways) {
        bool through = way.tags.is("tunnel", "building_passage") ||
                       is_one_of(way.tags["covered"], {"yes", "arcade", "colonnade"});
        std::optional<OsmHighway> highway = highway_of(way.tags);
        if (!through || !highway) continue;
        float half = std::max(highway->width, 3.0f) * 0.5f;
        for (std::vector<Vec2> line : lines_of(in, way)) {
            // A little longer than drawn, so that no film of wall stays in front of the way.
            line.front() += normalize_or(line[0] - line[1], {}) * k_out_of_passage;
            size_t last = line.size() - 1;
            line.back() += normalize_or(line[last] - line[last - 1], {}) * k_out_of_passage;
            Passage passage;
            add_strip(passage.rings, line, half, half, false);
            passage.rings = unite(passage.rings);
            if (passage.rings.empty()) continue;
            passage.low = passage.high = passage.rings[0][0];
            for (Point p : passage.rings[0]) {
                passage.low = {std::min(passage.low.X, p.X), std::min(passage.low.Y, p.Y)};
                passage.high = {std::max(passage.high.X, p.X), std::max(passage.high.Y, p.Y)};
            }
            passages.push_back(std::move(passage));
        }
    }
    return passages;
}

// Nodes that stand for a shop or a restaurant at the street.
std::vector<Point> find_shops(const OsmImport& in) {
    std::vector<Point> shops;
    for (const OsmNode& node : in.map.nodes) {
        if (node.tags.items.empty()) continue;
        if (node.tags.has("shop") ||
            is_one_of(node.tags["amenity"],
                      {"restaurant", "cafe", "bar", "pub", "fast_food", "pharmacy", "bank", "ice_cream"})) {
            shops.push_back(to_point(in.project(node)));
        }
    }
    std::sort(shops.begin(), shops.end(), point_less);
    return shops;
}

bool has_shop(const FoundBuilding& f, const std::vector<Point>& shops) {
    std::string_view type = (*f.tags)["building"];
    if (f.tags->has("shop") || is_one_of(type, {"retail", "commercial", "supermarket", "kiosk"})) return true;
    auto at =
        std::lower_bound(shops.begin(), shops.end(), f.low.X, [](Point p, int64_t x) { return p.X < x; });
    for (; at != shops.end() && at->X <= f.high.X; ++at) {
        if (contains({f.region.outer}, *at)) return true;
    }
    return false;
}

// Under three decimetres wide: parts and outline drawn not quite alike.
bool is_sliver(const Region& region) {
    float around = 0;
    for (size_t i = 0; i < region.outer.size(); ++i) {
        around += length(to_metres(region.outer[i]) - to_metres(region.outer[(i + 1) % region.outer.size()]));
    }
    return area(rings_of(region)) < 0.15 * static_cast<double>(around);
}

// The ground below the storeys over a passage, where no way is drawn.
void pave(OsmImport& in, const Rings& rings) {
    Area paved;
    paved.rank = k_rank_apron;
    paved.kind = Surface::path;
    paved.lift = flat(k_kerb);
    paved.rings = rings;
    in.plan.areas.push_back(std::move(paved));
}

// What stands already, by squares of the map that its box touches.
struct Standing {
    static constexpr int64_t k_square = 64'000;                            // millimetres
    std::map<std::pair<int64_t, int64_t>, std::vector<uint32_t>> squares;  // indices of OsmImport::masses

    template <class Visit>
    void visit(Point low, Point high, Visit&& each) {
        for (int64_t x = low.X / k_square; x <= high.X / k_square; ++x)
            for (int64_t y = low.Y / k_square; y <= high.Y / k_square; ++y) each(squares[{x, y}]);
    }
};

// Maps draw some houses over others, where two walls in one place would flicker: what of a mass is inside
// others as low and as high is left out.
std::vector<Region> beside_others(const OsmImport& in, Standing& standing, const FoundBuilding& f,
                                  const Mass& mass) {
    constexpr double k_least = 0.5;  // square metres
    constexpr float k_alike = 0.01f;
    std::vector<uint32_t> near;
    standing.visit(f.low, f.high, [&](auto& some) { near.insert(near.end(), some.begin(), some.end()); });
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
    Rings rings = rings_of(mass.footprint);
    const float top = mass.eaves + (mass.roof == RoofKind::flat ? 0 : mass.roof_height);
    bool is_whole = true;
    for (uint32_t i : near) {
        const OsmMass& other = in.masses[i];
        if (other.bottom > mass.bottom + k_alike || other.eaves < top - k_alike) continue;
        if (area(intersect(rings, other.rings)) < k_least) continue;
        rings = subtract(rings, other.rings);
        is_whole = false;
    }
    if (is_whole) return {mass.footprint};
    std::vector<Region> left = regions_of(rings);
    std::erase_if(left, is_sliver);
    return left;
}

struct Context {
    BuildingsAround around;
    std::vector<Passage> passages;
    std::vector<Point> shops;
    Standing standing{};
};

OsmHouse house_of(const FoundBuilding& f, const Context& context) {
    return house_of(*f.tags, f.whole ? *f.whole->tags : *f.tags, f.region, surroundings_of(context.around, f),
                    static_cast<uint64_t>(f.id));
}

// Parts stand in the place of their outline; what they leave of it is built to the height of the lowest of
// them.
void assign_parts(std::vector<FoundBuilding>& all, const Context& context) {
    std::vector<FoundBuilding*> parts;
    for (FoundBuilding& f : all) {
        if (f.part) parts.push_back(&f);
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const FoundBuilding* a, const FoundBuilding* b) { return a->low.X < b->low.X; });
    for (FoundBuilding& outline : all) {
        if (outline.part) continue;
        Rings rings = rings_of(outline.region);
        auto first = std::lower_bound(parts.begin(), parts.end(), outline.low.X - 1000,
                                      [](const FoundBuilding* part, int64_t x) { return part->low.X < x; });
        for (auto at = first; at != parts.end() && (*at)->low.X < outline.high.X; ++at) {
            FoundBuilding& part = **at;
            if (part.whole || apart(part, outline.low, outline.high)) continue;
            std::optional<Vec2> middle = middle_of(part.region.outer);
            if (!contains(rings, part.region.outer[0]) && !(middle && contains(rings, to_point(*middle))))
                continue;
            Rings whole = rings_of(part.region), covered = intersect(rings, whole);
            if (area(covered) < 0.5 * area(whole)) continue;
            part.whole = &outline;
            part.foot = outline.foot, part.peak = outline.peak;
            OsmHouse house = house_of(part, context);
            float top = house.top - house.roof_height;
            outline.lowest_part = outline.parts.empty() ? top : std::min(outline.lowest_part, top);
            outline.parts.insert(outline.parts.end(), whole.begin(), whole.end());
            if (house.bottom > 0.5f) outline.floating.push_back({covered, house.bottom});
        }
    }
}

void build(OsmImport& in, const FoundBuilding& f, const OsmHouse& house, Context& context) {
    OsmCounts& counts = in.counts;
    count_built(counts, f.part ? OsmSort::part : OsmSort::building);
    if (!f.part && house.default_height) count_built(counts, OsmSort::without_height);

    Mass mass;
    mass.footprint = f.region;
    mass.roof = house.roof;
    mass.roof_height = house.roof_height;
    mass.ridge = house.ridge;
    mass.bottom = f.foot + house.bottom;
    bool pitched = house.roof != RoofKind::flat;
    mass.eaves = f.foot + house.top - (pitched ? house.roof_height : 0);
    // On a slope a usual height counts from the middle of the ground.
    if (house.default_height) mass.eaves += 0.5f * (f.peak - f.foot);
    if (house.bottom < 0.5f && !is_outbuilding(*f.tags))
        mass.eaves = std::max(mass.eaves, f.peak + k_least_room);
    mass.underside = house.bottom > 1;
    if (house.canopy || (mass.underside && !f.part)) {
        // It stays above everyone's head, up the slope too.
        float raise = std::max(0.0f, f.peak + 2.5f - mass.bottom);
        mass.bottom += raise, mass.eaves += raise;
    }
    mass.eaves = std::max(mass.eaves, mass.bottom + 0.3f);
    bool on_ground = house.bottom < 0.5f;
    if (mass.footprint.holes.empty() && (pitched || house.roof_height > 0)) {
        Ring simple = without_collinear(mass.footprint.outer, 250);
        if (simple.size() == 4 && pitched) mass.footprint.outer = simple;
    }

    Building building;
    building.top = mass.eaves;
    building.storey = house.storey;
    building.style = house.style;
    building.wall_colour = house.wall_colour;
    building.roof_colour = house.roof_colour;
    building.finish = house.finish;
    building.has_shop = on_ground && house.finish == Finish::windows && has_shop(f, context.shops);
    building.seed = static_cast<uint32_t>(
        random_bits({static_cast<uint64_t>(f.whole ? f.whole->id : f.id), 0, 0, Purpose::city}));

    // What stands on the ground takes the ground away.
    auto add = [&](const Mass& m) {
        RoofKind got = m.roof;
        for (const Region& region : beside_others(in, context.standing, f, m)) {
            Building b = building;
            b.base = m.bottom;
            b.top = m.eaves;
            Mass own = m;
            own.footprint = region;
            own.building = static_cast<uint32_t>(in.city.buildings.size());
            in.city.buildings.push_back(b);
            got = add_mass(in.city, own);
            auto index = static_cast<uint32_t>(in.masses.size());
            context.standing.visit(f.low, f.high, [&](auto& some) { some.push_back(index); });
            in.masses.push_back({rings_of(region), m.bottom, m.eaves});
            if (m.bottom > f.foot + 0.5f) continue;
            Area solid;
            solid.rank = k_rank_solid;
            solid.solid = true;
            solid.rings = rings_of(region);
            in.plan.areas.push_back(std::move(solid));
        }
        return got;
    };
    Rings footprint = rings_of(mass.footprint), passages;
    for (const Passage& p : context.passages) {
        if (!apart(f, p.low, p.high)) passages.insert(passages.end(), p.rings.begin(), p.rings.end());
    }
    Rings passage = intersect(footprint, passages);
    float ceiling = f.foot;
    for (const Ring& ring : passage) {
        for (Point p : ring) ceiling = std::max(ceiling, terrain_at(in.plan, to_metres(p)));
    }
    ceiling += k_passage;
    // On a slope a way may run through what begins a storey above the foot.
    bool is_passed = area(passage) > 1 && mass.bottom < ceiling;
    if (!is_passed && f.parts.empty()) {
        RoofKind got = add(mass);
        count_built(counts,
                    static_cast<OsmSort>(static_cast<int>(OsmSort::roof_flat) + static_cast<int>(got)));
        counts.flat_instead += got != mass.roof;
        return;
    }
    auto add_flat = [&](const Rings& rings, float low, float high) {
        for (const Region& region : regions_of(rings)) {
            if (is_sliver(region)) continue;
            Mass piece = mass;
            piece.footprint = region;
            piece.roof = RoofKind::flat;
            piece.roof_height = 0;
            piece.bottom = low;
            piece.eaves = std::max(high, low + 0.3f);
            piece.underside = low > f.foot + 1;
            add(piece);
        }
    };
    // In pieces: what its parts leave, the storeys over passages, and what carries parts that start above it.
    Rings parts = unite(f.parts);
    float top_of_own = parts.empty() ? mass.eaves : std::min(mass.eaves, f.foot + f.lowest_part);
    Rings beside = is_passed ? subtract(footprint, passages) : footprint;
    add_flat(subtract(beside, parts), mass.bottom, top_of_own);
    if (is_passed) {
        if (on_ground) {
            count_built(counts, OsmSort::passage);
            pave(in, passage);
        }
        if (mass.eaves > ceiling + 0.6f) add_flat(subtract(passage, parts), ceiling, mass.eaves);
    }
    Rings grounded = parts;
    for (const auto& [rings, low] : f.floating) grounded = subtract(grounded, rings);
    for (const auto& [rings, low] : f.floating)
        add_flat(subtract(subtract(rings, grounded), passages), f.foot, f.foot + low);
}

}  // namespace

void add_osm_buildings(OsmImport& in) {
    std::vector<FoundBuilding> all = find_buildings(in);
    Context context{look_around(in, all), find_passages(in), find_shops(in)};
    assign_parts(all, context);
    // The highest first: it keeps its shape where others overlap it.
    std::vector<std::pair<const FoundBuilding*, OsmHouse>> houses;
    houses.reserve(all.size());
    for (const FoundBuilding& f : all) houses.push_back({&f, house_of(f, context)});
    auto eaves = [](const auto& h) {
        return h.first->foot + h.second.top - (h.second.roof == RoofKind::flat ? 0 : h.second.roof_height);
    };
    std::stable_sort(houses.begin(), houses.end(),
                     [&](const auto& a, const auto& b) { return eaves(a) > eaves(b); });
    for (const auto& [found, house] : houses) build(in, *found, house, context);
}

}  // namespace flaneur
