#include <algorithm>
#include <cmath>

#include "assets/masses.h"
#include "assets/osm_map.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_storey = 3.2f;
constexpr float k_passage = 3.8f, k_out_of_passage = 0.8f;  // height; beyond either end, metres

struct Found {
    int64_t id;
    const OsmTags* tags;
    Region region;
    bool part = false;
    Rings parts;                                    // of an outline: what its building:parts cover
    float lowest_part = 0;                          // top of the lowest of them, metres
    std::vector<std::pair<Rings, float>> floating;  // parts that start above the ground, and where
};

bool is_one_of(std::string_view value, std::initializer_list<std::string_view> values) {
    return std::find(values.begin(), values.end(), value) != values.end();
}

bool is_house(std::string_view type) {
    return is_one_of(
        type, {"house", "detached", "semidetached_house", "terrace", "bungalow", "farm", "cabin", "villa"});
}

bool is_shed(std::string_view type) {
    return is_one_of(type, {"garage", "garages", "shed", "hut", "kiosk", "carport", "roof", "service",
                            "toilets", "greenhouse", "transformer_tower", "container", "guardhouse"});
}

// Storeys by what is usual for the kind of building where the map is silent. `usual` are those of the
// surroundings.
float default_storeys(const OsmTags& tags, double square_metres, float usual, uint64_t id) {
    std::string_view type = tags["building"];
    if (type.empty() || type == "yes") type = tags["building:part"];
    float vary = std::floor(random_unit({id, 0, 0, Purpose::city}, 7) * 3) - 1;
    if (is_shed(type) || square_metres < 30) return 1;
    if (is_house(type)) return type == "bungalow" ? 1 : 2;
    if (is_one_of(type, {"church", "cathedral", "chapel", "mosque", "synagogue", "temple"})) return 4;
    if (is_one_of(type, {"warehouse", "industrial", "supermarket", "hangar", "stadium", "grandstand",
                         "train_station"}))
        return 2.5f;
    if (is_one_of(type, {"school", "kindergarten", "public", "civic", "hospital"})) return 3;
    if (is_one_of(type, {"office", "hotel", "skyscraper", "tower"})) return std::max(usual + 2, 6.0f);
    if (square_metres < 80) return std::min(usual, 2.0f);
    return std::max(2.0f, usual + vary);
}

std::optional<float> storeys_of(const OsmTags& tags) {
    std::optional<float> levels = parse_number(tags["building:levels"]);
    return levels && *levels >= 0.5f && *levels < 200 ? levels : std::nullopt;
}

std::optional<float> height_of(const OsmTags& tags) {
    std::optional<float> height = parse_metres(tags["height"]);
    if (!height) height = parse_metres(tags["building:height"]);
    return height && *height >= 1 && *height < 900 ? height : std::nullopt;
}

float bottom_of(const OsmTags& tags) {
    std::optional<float> height = parse_metres(tags["min_height"]);
    return height ? *height : parse_number(tags["building:min_level"]).value_or(0) * k_storey;
}

// The median of the storeys that the map states, for those that it does not.
float usual_storeys(const std::vector<Found>& all) {
    std::vector<float> known;
    for (const Found& f : all) {
        std::optional<float> levels = storeys_of(*f.tags), height = height_of(*f.tags);
        if (is_shed((*f.tags)["building"]) || area(rings_of(f.region)) < 60) continue;
        if (levels) known.push_back(*levels);
        if (!levels && height) known.push_back(*height / k_storey);
    }
    if (known.size() < 8) return 4;
    std::nth_element(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2),
                     known.end());
    return clamp(std::floor(known[known.size() / 2] + 0.5f), 2, 12);
}

std::vector<Found> find_buildings(OsmImport& in) {
    std::vector<Found> all;
    auto consider = [&](int64_t id, const OsmTags& tags, auto regions) {
        std::string_view building = tags["building"], part = tags["building:part"];
        bool wanted = !building.empty() && building != "no",
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
            all.push_back({id, &tags, std::move(region), is_part, {}, 0, {}});
        }
    };
    for (const OsmWay& way : in.map.ways) {
        consider(way.id, way.tags, [&] {
            in.counts.open_buildings += !way.closed();
            return regions_of_way(in, way);
        });
    }
    for (const OsmRelation& relation : in.map.relations) {
        consider(relation.id, relation.tags, [&] { return regions_of_relation(in, relation); });
    }
    // Parts stand in the place of their outline; what they leave of it is built to the height of the lowest
    // of them.
    for (Found& outline : all) {
        if (outline.part) continue;
        Rings rings = rings_of(outline.region);
        for (const Found& part : all) {
            if (!part.part || !contains(rings, part.region.outer[0])) continue;
            Rings whole = rings_of(part.region), covered = intersect(rings, whole);
            if (area(covered) < 1) continue;
            float top = height_of(*part.tags).value_or(storeys_of(*part.tags).value_or(1) * k_storey);
            outline.lowest_part = outline.parts.empty() ? top : std::min(outline.lowest_part, top);
            outline.parts.insert(outline.parts.end(), whole.begin(), whole.end());
            if (bottom_of(*part.tags) > 0.5f) outline.floating.push_back({covered, bottom_of(*part.tags)});
        }
    }
    return all;
}

// Ways through buildings at street level.
Rings find_passages(OsmImport& in) {
    Rings passages;
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
            Rings strip;
            add_strip(strip, line, half, half, false);
            passages.insert(passages.end(), strip.begin(), strip.end());
        }
    }
    return unite(passages);
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
    std::sort(shops.begin(), shops.end(),
              [](Point a, Point b) { return a.X != b.X ? a.X < b.X : a.Y < b.Y; });
    return shops;
}

bool has_shop(const Found& f, const std::vector<Point>& shops) {
    std::string_view type = (*f.tags)["building"];
    if (f.tags->has("shop") || is_one_of(type, {"retail", "commercial", "supermarket", "kiosk"})) return true;
    auto [west, east] = std::minmax_element(f.region.outer.begin(), f.region.outer.end(),
                                            [](Point a, Point b) { return a.X < b.X; });
    auto at =
        std::lower_bound(shops.begin(), shops.end(), west->X, [](Point p, int64_t x) { return p.X < x; });
    for (; at != shops.end() && at->X <= east->X; ++at) {
        if (contains({f.region.outer}, *at)) return true;
    }
    return false;
}

uint8_t style_of(const OsmTags& tags, uint64_t id) {
    std::string_view material = tags["building:material"];
    if (material == "brick") return 3;
    if (material == "concrete" || material == "glass" || material == "metal") return 4;
    if (material == "limestone" || material == "stone" || material == "sandstone") return 0;
    constexpr uint8_t styles[] = {0, 1, 1, 1, 2, 3, 4, 5, 5, 6, 6, 7, 8, 9};
    return styles[static_cast<size_t>(random_unit({id, 0, 0, Purpose::city}, 3) * 14)];
}

void set_roof(Mass& mass, const OsmTags& tags, float storeys, uint64_t id) {
    std::string_view shape = tags["roof:shape"], type = tags["building"];
    Ring simple = without_collinear(mass.footprint.outer, 250);
    bool quad = mass.footprint.holes.empty() && simple.size() == 4 && is_convex(simple);
    float u = random_unit({id, 0, 0, Purpose::city}, 5);
    if (is_one_of(shape, {"gabled", "saltbox", "gambrel", "half-hipped", "round"})) {
        mass.roof = quad ? RoofKind::gable : RoofKind::mansard;
    } else if (is_one_of(shape, {"hipped", "side_hipped"})) {
        mass.roof = quad ? RoofKind::hip : RoofKind::mansard;
    } else if (is_one_of(shape, {"pyramidal", "cone", "dome", "onion"})) {
        mass.roof = RoofKind::pyramid;
    } else if (shape == "mansard") {
        mass.roof = RoofKind::mansard;
    } else if (shape.empty() && is_house(type)) {
        mass.roof = quad ? RoofKind::gable : RoofKind::mansard;
    } else if (shape.empty() && storeys <= 6 && (type == "apartments" || type == "residential")) {
        mass.roof = u < 0.6f ? RoofKind::mansard : RoofKind::flat;
    }
    std::optional<float> height = parse_metres(tags["roof:height"]);
    float least = 1e9f;
    if (quad) {
        for (size_t i = 0; i < 4; ++i)
            least = std::min(least, length(to_metres(simple[i]) - to_metres(simple[(i + 1) % 4])));
    }
    switch (mass.roof) {
        case RoofKind::flat:
            mass.roof_height = mass.eaves - mass.bottom > 6 ? 0.7f : 0.2f;
            break;
        case RoofKind::mansard:
            mass.roof_height = 2.2f;
            break;
        case RoofKind::pyramid:
            mass.roof_height = height.value_or(4);
            break;
        default:
            mass.roof_height = height.value_or(clamp(least * 0.35f, 1.5f, 5));
            break;
    }
    mass.roof_height = clamp(mass.roof_height, 0, 30);
    if (mass.roof == RoofKind::gable || mass.roof == RoofKind::hip) {
        mass.footprint.outer = simple;
        float first = length(to_metres(simple[1]) - to_metres(simple[0])),
              second = length(to_metres(simple[2]) - to_metres(simple[1]));
        mass.gable_across = (second > first) != tags.is("roof:orientation", "across");
    }
}

float lowest_ground(const GroundPlan& plan, const Region& region) {
    float lowest = terrain_at(plan, to_metres(region.outer[0]));
    for (Point p : region.outer) lowest = std::min(lowest, terrain_at(plan, to_metres(p)));
    return lowest;
}

// Under three decimetres wide: parts and outline drawn not quite alike.
bool is_sliver(const Region& region) {
    float around = 0;
    for (size_t i = 0; i < region.outer.size(); ++i) {
        around += length(to_metres(region.outer[i]) - to_metres(region.outer[(i + 1) % region.outer.size()]));
    }
    return area(rings_of(region)) < 0.15 * static_cast<double>(around);
}

void build(OsmImport& in, const Found& f, const Rings& passages, const std::vector<Point>& shops,
           float usual) {
    const OsmTags& tags = *f.tags;
    auto id = static_cast<uint64_t>(f.id);
    double square_metres = area(rings_of(f.region));
    std::optional<float> height = height_of(tags), levels = storeys_of(tags);
    if (!height && !levels) ++in.counts.default_heights;
    float storeys =
        levels.value_or(height ? *height / k_storey : default_storeys(tags, square_metres, usual, id));
    float bottom = bottom_of(tags);
    bool canopy = tags.is("building", "roof") || tags.is("building", "carport");

    Mass mass;
    mass.footprint = f.region;
    float top = height.value_or(storeys * k_storey + 0.8f);
    if (canopy) bottom = std::max(top, 3.6f) - 0.5f, top = bottom + 0.5f;
    bottom = clamp(bottom, 0, std::max(0.0f, top - 0.5f));
    mass.bottom = bottom;
    mass.eaves = std::max(top, bottom + 0.5f);
    if (!canopy) set_roof(mass, tags, storeys, id);
    // `height` counts to the ridge.
    bool pitched = mass.roof != RoofKind::flat;
    if (height && pitched && mass.eaves - mass.roof_height > bottom + 2.2f) mass.eaves -= mass.roof_height;
    mass.underside = bottom > 1;

    Building building;
    building.base = bottom;
    building.top = mass.eaves;
    building.storey = clamp(levels && *levels >= 1 ? (mass.eaves - bottom) / *levels : k_storey, 2.6f, 4.5f);
    building.style = style_of(tags, id);
    building.has_shop = bottom < 0.5f && has_shop(f, shops);
    building.seed = static_cast<uint32_t>(random_bits({id, 0, 0, Purpose::city}));

    // What stands on the ground takes the ground away.
    float foot = lowest_ground(in.plan, f.region);
    auto add = [&](const Mass& m) {
        Building b = building;
        b.base = m.bottom + foot;
        b.top += foot;
        Mass own = m;
        own.bottom += foot;
        own.eaves += foot;
        own.building = static_cast<uint32_t>(in.city.buildings.size());
        in.city.buildings.push_back(b);
        add_mass(in.city, own);
        if (m.bottom >= 0.5f) return;
        Area solid;
        solid.rank = k_rank_solid;
        solid.solid = true;
        solid.rings = rings_of(m.footprint);
        in.plan.areas.push_back(std::move(solid));
    };
    Rings footprint = rings_of(mass.footprint);
    Rings passage = bottom < 0.5f ? intersect(footprint, passages) : Rings{};
    if (area(passage) <= 1 && f.parts.empty()) {
        add(mass);
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
            piece.underside = low > 1;
            add(piece);
        }
    };
    // In pieces: what its parts leave, the storeys over passages, and what carries parts that start above it.
    Rings parts = unite(f.parts);
    float top_of_own = parts.empty() ? mass.eaves : std::min(mass.eaves, f.lowest_part);
    Rings beside = area(passage) > 1 ? subtract(footprint, passages) : footprint;
    add_flat(subtract(beside, parts), bottom, top_of_own);
    if (mass.eaves > k_passage + 1.5f) add_flat(subtract(passage, parts), k_passage, mass.eaves);
    Rings grounded = parts;
    for (const auto& [rings, low] : f.floating) grounded = subtract(grounded, rings);
    for (const auto& [rings, low] : f.floating)
        add_flat(subtract(subtract(rings, grounded), passages), 0, low);
}

}  // namespace

void add_osm_buildings(OsmImport& in) {
    std::vector<Found> all = find_buildings(in);
    Rings passages = find_passages(in);
    std::vector<Point> shops = find_shops(in);
    float usual = usual_storeys(all);
    for (const Found& f : all) build(in, f, passages, shops, usual);
}

}  // namespace flaneur
