// Where people of a mapped city come from and go to.
#include <algorithm>
#include <cmath>

#include "assets/osm/map.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_before_door = 0.7f;  // metres
constexpr float k_from_wall = 0.45f;   // no destination is nearer to a wall, metres

// The ground at `p` where one can stand clear of walls and off the carriageway.
std::optional<Vec3> standing(const OsmImport& in, Vec2 p) {
    std::optional<GroundHit> hit = ground_at(in.city.ground, at_height(p, terrain_at(in.plan, p)), 1.5f, 3);
    if (!hit || is_carriageway(hit->kind) || !is_walked(hit->kind)) return std::nullopt;
    Vec3 at = at_height(p, hit->height);
    if (closest_wall(in.city.ground, at + Vec3{0, 0.5f, 0}, k_from_wall)) return std::nullopt;
    return at;
}

// Where one stands before the door that a house has in this face about `place`, or else right before that:
// doors are drawn in the middle of bays.
std::optional<Vec3> before_door(const OsmImport& in, const Face& face, Vec2 place, Vec2 out) {
    const Vec2 door = door_on(on_ground(face.a), on_ground(face.b), place);
    if (std::optional<Vec3> at = standing(in, door + out * k_before_door)) return at;
    return standing(in, place + out * k_before_door);
}

// The same at `p` or around it within `radius`, the nearest first.
std::optional<Vec3> standing_near(const OsmImport& in, Vec2 p, float radius) {
    if (std::optional<Vec3> at = standing(in, p)) return at;
    for (float r = 0.8f; r <= radius; r += 0.8f) {
        for (int turn = 0; turn < 12; ++turn) {
            Vec2 q = p + heading_direction(k_pi * static_cast<float>(turn) / 6) * r;
            if (std::optional<Vec3> at = standing(in, q)) return at;
        }
    }
    return std::nullopt;
}

void add(OsmImport& in, DestinationKind kind, Vec3 at, Vec2 facing, float weight) {
    in.city.destinations.push_back({kind, at, facing, weight});
}

bool is_business(const OsmTags& tags) {
    constexpr std::string_view k_open[] = {"restaurant", "cafe",      "bar",    "pub",     "fast_food",
                                           "pharmacy",   "bank",      "cinema", "theatre", "ice_cream",
                                           "library",    "nightclub", "clinic", "casino",  "post_office",
                                           "doctors",    "food_court"};
    return tags.has("shop") ||
           std::find(std::begin(k_open), std::end(k_open), tags["amenity"]) != std::end(k_open);
}

float business_weight(const OsmTags& tags) {
    std::string_view shop = tags["shop"];
    return shop == "mall" || shop == "department_store" ? 6 : shop == "supermarket" ? 4 : 1;
}

// How many people a building sends out, by its size.
float door_weight(const Building& b) { return clamp((b.top - b.base) / b.storey, 1, 30); }

// Entrances of the map; they speak for their buildings, which are marked.
void add_entrances(OsmImport& in, std::vector<uint8_t>& has_door) {
    for (const OsmNode& node : in.map.nodes) {
        std::string_view entrance = node.tags["entrance"];
        if (entrance.empty() || entrance == "no" || entrance == "emergency" || is_hidden(node.tags)) continue;
        Vec2 p = in.project(node);
        std::optional<WallPoint> wall =
            closest_wall(in.city.ground, at_height(p, terrain_at(in.plan, p) + 1), 1);
        if (!wall) continue;
        Vec2 out = on_ground(wall->normal);
        std::optional<RayHit> face =
            raycast(in.city.ground, wall->point + wall->normal * 0.1f, -wall->normal, 0.2f);
        if (!face || face->what != RayHit::What::face) continue;
        const std::optional<Vec3> at =
            before_door(in, in.city.ground.faces[face->index], on_ground(wall->point), out);
        if (!at) continue;
        uint32_t building = in.city.ground.faces[face->index].building;
        if (building >= has_door.size()) continue;
        has_door[building] = 1;
        add(in, DestinationKind::door, *at, -out, door_weight(in.city.buildings[building]));
    }
}

// For every other building the middle of that facade which is nearest to a street.
void add_doors(OsmImport& in, const std::vector<uint8_t>& has_door) {
    struct Door {
        float away = 1e9f;
        uint32_t face = ~0u;
    };
    std::vector<Door> doors(in.city.buildings.size());
    for (uint32_t f = 0; f < in.city.ground.faces.size(); ++f) {
        const Face& face = in.city.ground.faces[f];
        if (face.kind != FaceKind::facade || face.building >= doors.size() || has_door[face.building])
            continue;
        Vec2 a = on_ground(face.a), b = on_ground(face.b), middle = lerp(a, b, 0.5f);
        if (length(b - a) < 1.6f || std::min(face.a_top - face.a.y, face.b_top - face.b.y) < 2.2f) continue;
        if (face.a.y > terrain_at(in.plan, middle) + 1) continue;
        const LinePiece* street = in.streets.nearest(middle, 60);
        if (!street) continue;
        Vec2 towards = lerp(street->a, street->b, closest_on(*street, middle)) - middle;
        Vec2 out = normalize_or(Vec2{a.z - b.z, b.x - a.x}, {1, 0});
        float away = length(towards);
        // A facade that looks another way is a worse place for a door.
        if (dot(towards, out) < 0.5f * away) away += 20;
        Door& door = doors[face.building];
        if (away < door.away) door = {away, f};
    }
    for (uint32_t i = 0; i < doors.size(); ++i) {
        if (doors[i].face == ~0u) continue;
        const Face& face = in.city.ground.faces[doors[i].face];
        Vec2 a = on_ground(face.a), b = on_ground(face.b);
        Vec2 out = normalize_or(Vec2{a.z - b.z, b.x - a.x}, {1, 0});
        const std::optional<Vec3> at = before_door(in, face, lerp(a, b, 0.5f), out);
        if (at) add(in, DestinationKind::door, *at, -out, door_weight(in.city.buildings[i]));
    }
}

// A shop is entered by the nearest door, or where its house is nearest.
void add_shop(OsmImport& in, Vec2 p, float weight, size_t doors) {
    const Destination* best = nullptr;
    float least = 20;
    for (size_t i = 0; i < doors; ++i) {
        float d = length(on_ground(in.city.destinations[i].position) - p);
        if (d < least) least = d, best = &in.city.destinations[i];
    }
    if (best) {
        Destination shop = *best;
        add(in, DestinationKind::shop, shop.position, shop.facing, weight);
        return;
    }
    std::optional<WallPoint> wall =
        closest_wall(in.city.ground, at_height(p, terrain_at(in.plan, p) + 1), 20);
    if (!wall) return;
    Vec2 out = on_ground(wall->normal);
    const Vec2 place = on_ground(wall->point);
    const bool is_house = wall->face != ~0u && in.city.ground.faces[wall->face].kind == FaceKind::facade;
    const std::optional<Vec3> at = is_house ? before_door(in, in.city.ground.faces[wall->face], place, out)
                                            : standing(in, place + out * k_before_door);
    if (at) add(in, DestinationKind::shop, *at, -out, weight);
}

bool is_stop(const OsmTags& tags) {
    return tags.is("highway", "bus_stop") || tags.is("railway", "tram_stop") ||
           tags.is("railway", "subway_entrance") || tags.is("railway", "train_station_entrance");
}

bool is_square(const OsmTags& tags) { return tags.is("place", "square") || tags.is("highway", "pedestrian"); }

void add_square(OsmImport& in, const Region& region) {
    float size = static_cast<float>(area(rings_of(region)));
    if (size < 150) return;
    Vec2 middle = middle_of(region.outer).value_or(to_metres(region.outer[0]));
    std::optional<Vec3> at = standing_near(in, middle, 6);
    if (at && contains(rings_of(region), to_point(on_ground(*at))))
        add(in, DestinationKind::square, *at, {0, 1}, clamp(size / 500, 0.5f, 10));
}

void add_edge(OsmImport& in, Vec2 p, Vec2 out, const OsmHighway& highway) {
    std::optional<Vec3> at = standing_near(in, p - out, highway.width * 0.5f + 4);
    if (at) add(in, DestinationKind::edge, *at, out, highway.drives ? highway.width * 0.4f : 1);
}

// Where streets cross the border of the map, on their pavement.
void add_border_edges(OsmImport& in) {
    Vec2 low = in.plan.low, high = in.plan.high;
    constexpr float k_inside = 3;  // metres
    auto inside = [&](Vec2 p) {
        return p.x > low.x + k_inside && p.z > low.z + k_inside && p.x < high.x - k_inside &&
               p.z < high.z - k_inside;
    };
    for (const LinePiece& s : in.streets.segments) {
        bool a = inside(s.a), b = inside(s.b);
        if (a == b) continue;
        Vec2 here = a ? s.a : s.b, there = a ? s.b : s.a, out = normalize_or(there - here, {1, 0});
        for (int i = 0; i < 24; ++i) {
            Vec2 middle = lerp(here, there, 0.5f);
            (inside(middle) ? here : there) = middle;
        }
        add_edge(in, here, out, *highway_of(in.map.ways[s.owner].tags));
    }
}

// Extracts without stated bounds end where their streets do: carriageways that lead nowhere, with no house
// ahead.
void add_loose_ends(OsmImport& in) {
    std::vector<int64_t> nodes;
    std::vector<uint32_t> roads;
    for (const LinePiece& s : in.streets.segments) {
        if (s.half > 0 && (roads.empty() || roads.back() != s.owner)) roads.push_back(s.owner);
    }
    std::sort(roads.begin(), roads.end());
    roads.erase(std::unique(roads.begin(), roads.end()), roads.end());
    for (uint32_t road : roads)
        nodes.insert(nodes.end(), in.map.ways[road].nodes.begin(), in.map.ways[road].nodes.end());
    std::sort(nodes.begin(), nodes.end());
    for (uint32_t road : roads) {
        const OsmWay& way = in.map.ways[road];
        if (way.tags.is("noexit", "yes")) continue;
        size_t last = way.nodes.size() - 1;
        for (auto [end, before] : {std::pair<size_t, size_t>{0, 1}, {last, last - 1}}) {
            auto shared = std::equal_range(nodes.begin(), nodes.end(), way.nodes[end]);
            const OsmNode *a = in.map.node(way.nodes[end]), *b = in.map.node(way.nodes[before]);
            if (shared.second - shared.first != 1 || !a || !b) continue;
            Vec2 p = in.project(*a), out = normalize_or(p - in.project(*b), {1, 0});
            Vec3 eye = at_height(p, terrain_at(in.plan, p) + 2);
            if (!raycast(in.city.ground, eye, at_height(out, 0), 80))
                add_edge(in, p, out, *highway_of(way.tags));
        }
    }
}

}  // namespace

void add_osm_destinations(OsmImport& in) {
    OsmCounts counts = in.counts;  // what is read once more is not counted again
    std::vector<uint8_t> has_door(in.city.buildings.size(), 0);
    add_entrances(in, has_door);
    add_doors(in, has_door);
    size_t doors = in.city.destinations.size();
    for (const OsmNode& node : in.map.nodes) {
        if (node.tags.items.empty() || is_hidden(node.tags)) continue;
        Vec2 p = in.project(node);
        if (is_business(node.tags)) add_shop(in, p, business_weight(node.tags), doors);
        if (!is_stop(node.tags)) continue;
        std::optional<Vec3> at = standing_near(in, p, 8);
        if (!at) continue;
        const LinePiece* street = in.streets.nearest(p, 20);
        Vec2 facing =
            street ? lerp(street->a, street->b, closest_on(*street, p)) - on_ground(*at) : Vec2{0, 1};
        add(in, DestinationKind::stop, *at, normalize_or(facing, {0, 1}), node.tags.has("railway") ? 4 : 1);
    }
    for (const OsmWay& way : in.map.ways) {
        if (!way.closed() || is_hidden(way.tags)) continue;
        bool square = is_square(way.tags) && (way.tags.is("area", "yes") || way.tags.has("place"));
        if (!square && !is_business(way.tags)) continue;
        for (const Region& region : regions_of_way(in, way)) {
            if (square) add_square(in, region);
            if (is_business(way.tags))
                add_shop(in, middle_of(region.outer).value_or(to_metres(region.outer[0])),
                         business_weight(way.tags), doors);
        }
    }
    for (const OsmRelation& relation : in.map.relations) {
        if (!is_square(relation.tags) || is_hidden(relation.tags)) continue;
        for (const Region& region : regions_of_relation(in, relation)) add_square(in, region);
    }
    for (const Prop& prop : in.city.props) {
        if (prop.kind != PropKind::bench) continue;
        Vec2 ahead = heading_direction(prop.yaw);
        if (std::optional<Vec3> at = standing(in, on_ground(prop.position) + ahead * 0.7f))
            add(in, DestinationKind::bench, *at, ahead, 1);
    }
    in.map.box ? add_border_edges(in) : add_loose_ends(in);
    in.counts = counts;
}

}  // namespace flaneur
