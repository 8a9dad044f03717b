#include "tools/flaneur/window/ask/things.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/window/pick.h"

namespace flaneur {
namespace {

constexpr const char* k_surface_names[k_surface_count] = {
    "road", "sidewalk", "crossing", "plaza", "path", "steps", "grass", "water", "railway track"};
constexpr const char* k_destination_names[k_destination_count] = {"a door", "a shop",         "a bench",
                                                                  "a stop", "the map's edge", "a square"};
constexpr const char* k_prop_names[k_prop_count] = {
    "Tree",   "Street lamp", "Bench",  "Bollard",           "Bin",    "Parked car", "Fountain",
    "Statue", "Planter",     "Signal", "Shelter of a stop", "Barrier"};
static_assert(k_prop_names[k_prop_count - 1] != nullptr);

template <class... Values>
std::string text_of(const char* form, Values... values) {
    char text[160];
    std::snprintf(text, sizeof text, form, values...);
    return text;
}

// How far along a ray a triangle is met, from either side (Moller & Trumbore, Journal of Graphics Tools 2,
// 1997).
std::optional<float> meet(Vec3 eye, Vec3 way, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 ab = b - a, ac = c - a, p = cross(way, ac);
    const float scale = dot(ab, p);
    if (std::fabs(scale) < 1e-9f) return {};
    const Vec3 from = eye - a;
    const float u = dot(from, p) / scale;
    const Vec3 q = cross(from, ab);
    const float v = dot(way, q) / scale, t = dot(ac, q) / scale;
    if (u < 0 || v < 0 || u + v > 1 || t < 0) return {};
    return t;
}

// Where a ray is in a box, first and last, metres along it; none where it misses.
std::optional<std::pair<float, float>> span_in(Vec3 eye, Vec3 way, Vec3 low, Vec3 high, int& axis) {
    float first = 0, last = 1e9f;
    axis = 1;
    const float from[] = {eye.x, eye.y, eye.z}, along[] = {way.x, way.y, way.z};
    const float least[] = {low.x, low.y, low.z}, most[] = {high.x, high.y, high.z};
    for (int i = 0; i < 3; ++i) {
        if (std::fabs(along[i]) < 1e-9f) {
            if (from[i] < least[i] || from[i] > most[i]) return {};
            continue;
        }
        float a = (least[i] - from[i]) / along[i], b = (most[i] - from[i]) / along[i];
        if (a > b) std::swap(a, b);
        if (a > first) first = a, axis = i;
        last = std::min(last, b);
    }
    if (first > last) return {};
    return std::pair(first, last);
}

// A point against a prop, along its own side (x), up and along its yaw (z), and back.
Vec3 into(const Prop& prop, Vec3 v) {
    const SinCos yaw = sin_cos(prop.yaw);
    return {v.x * yaw.cosine - v.z * yaw.sine, v.y, v.x * yaw.sine + v.z * yaw.cosine};
}
Vec3 out_of(const Prop& prop, Vec3 v) {
    const SinCos yaw = sin_cos(prop.yaw);
    return {v.x * yaw.cosine + v.z * yaw.sine, v.y, v.z * yaw.cosine - v.x * yaw.sine};
}

// A tree's crown stands on its trunk; other things fill a box.
bool has_crown(const Prop& prop) { return prop.kind == PropKind::tree && prop.radius > 0; }
float crown_height(const Prop& prop) { return std::max(prop.height - prop.radius, 0.5f * prop.height); }

std::optional<float> meet_prop(const Prop& prop, Vec3 eye, Vec3 way, Vec3& normal) {
    const Vec3 from = eye - prop.position;
    const float near = prop.height + prop.radius + 3, along = -dot(from, way);
    if (length_squared(from + way * along) > near * near) return {};
    const Vec2 half = half_footprint(prop);
    int axis = 1;
    const Vec3 eye_in = into(prop, from), way_in = into(prop, way);
    std::optional<float> met;
    if (const auto span =
            span_in(eye_in, way_in, {-half.x, 0, -half.z}, {half.x, prop.height, half.z}, axis)) {
        met = span->first;
        Vec3 side{};
        (axis == 0   ? side.x
         : axis == 1 ? side.y
                     : side.z) = (axis == 0   ? way_in.x
                                  : axis == 1 ? way_in.y
                                              : way_in.z) > 0
                                     ? -1.0f
                                     : 1.0f;
        normal = out_of(prop, side);
    }
    if (!has_crown(prop)) return met;
    const Vec3 to = Vec3{0, crown_height(prop), 0} - from;
    const float middle = dot(to, way), apart = length_squared(to) - middle * middle,
                room = prop.radius * prop.radius - apart;
    if (room < 0 || middle - std::sqrt(room) < 0) return met;
    const float distance = middle - std::sqrt(room);
    if (met && *met < distance) return met;
    normal = (from + way * distance - Vec3{0, crown_height(prop), 0}) / prop.radius;
    return distance;
}

struct RoofCorners {
    Vec3 a, b, c;
};
RoofCorners roof_corners(const City& city, uint32_t triangle) {
    const uint32_t* i = &city.roof_indices[size_t{triangle} * 3];
    return {city.roof_vertices[i[0]], city.roof_vertices[i[1]], city.roof_vertices[i[2]]};
}

void widen(CityIndex::House& house, Vec3 p) {
    house.low = {std::min(house.low.x, p.x), std::min(house.low.y, p.y), std::min(house.low.z, p.z)};
    house.high = {std::max(house.high.x, p.x), std::max(house.high.y, p.y), std::max(house.high.z, p.z)};
}

// As planners say it; of what can be stood on.
std::string told_slope(Vec3 normal) {
    const float flat = std::hypot(normal.x, normal.z), up = std::fabs(normal.y);
    if (up < 0.17f) return "upright";
    return text_of("slope %.1f %%", wide(100 * flat / up));
}

ThingFacts facts_of_building(const CityIndex& index, const Thing& thing) {
    const Building& building = index.city->buildings[thing.index];
    const CityIndex::House& house = index.houses[thing.index];
    ThingFacts facts{building.has_shop ? "Building with a shop" : "Building", {}};
    constexpr const char* k_finishes[] = {"", "walls of glass", "", "walls of stone"};
    if (const char* finish = k_finishes[static_cast<size_t>(building.finish)]; *finish)
        facts.lines.emplace_back(finish);
    const float eaves = building.top - building.base, ridge = house.high.y - building.base;
    const bool has_eaves = eaves > 1;  // a flight of steps and what it leads to have none
    if (const std::optional<int> storeys = has_eaves ? storeys_of(building) : std::nullopt)
        facts.lines.push_back(
            text_of("%d storey%s of %.1f m", *storeys, *storeys == 1 ? "" : "s", wide(building.storey)));
    if (has_eaves) facts.lines.push_back(text_of("%.1f m to the eaves", wide(eaves)));
    if (ridge > eaves + 0.3f) facts.lines.push_back(text_of("%.1f m to the top", wide(ridge)));
    if (const std::optional<double> area = footprint_of(index, thing.index))
        facts.lines.push_back(text_of("%.0f m\u00b2 of ground", *area));
    facts.lines.push_back(text_of("its ground lies at %.1f m", wide(building.base)));
    return facts;
}

ThingFacts facts_of_prop(const City& city, const Thing& thing) {
    const Prop& prop = city.props[thing.index];
    const Vec2 half = half_footprint(prop);
    ThingFacts facts{k_prop_names[static_cast<size_t>(prop.kind)], {}};
    facts.lines.push_back(text_of("%.1f m high", wide(prop.height)));
    if (has_crown(prop))
        facts.lines.push_back(text_of("its crown is %.1f m wide", wide(2 * prop.radius)));
    else
        facts.lines.push_back(text_of("%.2f by %.2f m", wide(2 * half.x), wide(2 * half.z)));
    return facts;
}

}  // namespace

const char* told(Surface surface) { return k_surface_names[static_cast<size_t>(surface)]; }
const char* told(DestinationKind kind) { return k_destination_names[static_cast<size_t>(kind)]; }

bool is_same(const Thing& a, const Thing& b) {
    if (a.kind == ThingKind::ground || a.kind == ThingKind::model)
        return a.kind == b.kind && a.place == b.place;
    return a.kind == b.kind && a.index == b.index;
}

CityIndex index_things(std::shared_ptr<const City> city) {
    CityIndex index;
    index.houses.resize(city->buildings.size());
    const std::vector<Face>& faces = city->ground.faces;
    for (uint32_t i = 0; i < faces.size(); ++i) {
        if (faces[i].building >= index.houses.size()) continue;
        CityIndex::House& house = index.houses[faces[i].building];
        house.faces.push_back(i);
        for (Vec3 p : {faces[i].a, faces[i].b, at_height(on_ground(faces[i].a), faces[i].a_top),
                       at_height(on_ground(faces[i].b), faces[i].b_top)})
            widen(house, p);
    }
    for (uint32_t t = 0; t < city->roof_buildings.size(); ++t) {
        if (city->roof_buildings[t] >= index.houses.size()) continue;
        CityIndex::House& house = index.houses[city->roof_buildings[t]];
        house.roofs.push_back(t);
        const RoofCorners roof = roof_corners(*city, t);
        for (Vec3 p : {roof.a, roof.b, roof.c}) widen(house, p);
    }
    index.city = std::move(city);
    return index;
}

std::optional<Thing> thing_along(const CityIndex& index, Vec3 eye, Vec3 way, bool meets_props) {
    const City& city = *index.city;
    Thing first;
    first.distance = k_far_sight;
    bool is_met = false;
    auto take = [&](ThingKind kind, uint32_t at, float distance, Vec3 normal) {
        if (distance >= first.distance) return;
        is_met = true;
        first = {kind, at, distance, eye + way * distance, dot(normal, way) > 0 ? -normal : normal};
    };
    if (const auto hit = raycast(city.ground, eye, way, k_far_sight)) {
        if (hit->what == RayHit::What::ground)
            take(ThingKind::ground, hit->index, hit->distance, hit->normal);
        if (hit->what == RayHit::What::solid) take(ThingKind::model, hit->index, hit->distance, hit->normal);
        if (hit->what == RayHit::What::face) {
            const uint32_t building = city.ground.faces[hit->index].building;
            const bool is_house = building < city.buildings.size();
            take(is_house ? ThingKind::building : ThingKind::wall, is_house ? building : hit->index,
                 hit->distance, hit->normal);
        }
    }
    for (uint32_t i = 0; i < index.houses.size(); ++i) {
        const CityIndex::House& house = index.houses[i];
        int axis = 0;
        const auto span = span_in(eye, way, house.low, house.high, axis);
        if (!span || span->first > first.distance) continue;
        for (uint32_t t : house.roofs) {
            const RoofCorners roof = roof_corners(city, t);
            if (const auto met = meet(eye, way, roof.a, roof.b, roof.c))
                take(ThingKind::building, i, *met,
                     normalize_or(cross(roof.b - roof.a, roof.c - roof.a), {0, 1, 0}));
        }
    }
    for (uint32_t i = 0; meets_props && i < city.props.size(); ++i) {
        Vec3 normal{0, 1, 0};
        if (const auto met = meet_prop(city.props[i], eye, way, normal))
            take(ThingKind::prop, i, *met, normal);
    }
    if (!is_met) return {};
    return first;
}

// By where its lowest walls stand: what is built on top of others has walls of its own higher up.
std::optional<double> footprint_of(const CityIndex& index, uint32_t building) {
    constexpr float k_above = 1.5f, k_gap = 0.05f;  // metres
    double twice = 0;
    Vec2 gap{};
    const float base = index.city->buildings[building].base;
    float lowest = 1e9f;
    for (uint32_t i : index.houses[building].faces)
        lowest = std::min(lowest, std::min(index.city->ground.faces[i].a.y, index.city->ground.faces[i].b.y));
    const Vec2 origin = on_ground(index.houses[building].low);
    for (uint32_t i : index.houses[building].faces) {
        const Face& face = index.city->ground.faces[i];
        if (std::min(face.a.y, face.b.y) > std::max(base, lowest) + k_above) continue;
        const Vec2 a = on_ground(face.a) - origin, b = on_ground(face.b) - origin;
        twice += wide(a.x) * wide(b.z) - wide(a.z) * wide(b.x);
        gap += b - a;
    }
    if (length(gap) > k_gap || std::fabs(twice) < 2) return {};
    return std::fabs(twice) / 2;
}

std::optional<int> storeys_of(const Building& building) {
    if (building.finish != Finish::windows || !(building.storey > 0.5f)) return {};
    return std::max(static_cast<int>(std::lround((building.top - building.base) / building.storey)), 1);
}

ThingFacts facts_of(const CityIndex& index, const Thing& thing) {
    const City& city = *index.city;
    const std::string place = text_of("%.1f m %s, %.1f m %s of the middle", std::fabs(wide(thing.place.x)),
                                      thing.place.x < 0 ? "west" : "east", std::fabs(wide(thing.place.z)),
                                      thing.place.z < 0 ? "north" : "south");
    ThingFacts facts;
    switch (thing.kind) {
        case ThingKind::building:
            return facts_of_building(index, thing);
        case ThingKind::prop:
            return facts_of_prop(city, thing);
        case ThingKind::wall: {
            const Face& face = city.ground.faces[thing.index];
            facts.title = face.kind == FaceKind::garden_wall ? "Wall" : "Face of the ground";
            facts.lines.push_back(text_of("%.2f m high, %.1f m long",
                                          wide(std::max(face.a_top - face.a.y, face.b_top - face.b.y)),
                                          wide(length(face.b - face.a))));
            break;
        }
        case ThingKind::model:
            facts.title = "Part of the city's model";
            facts.lines.push_back(text_of("here at a height of %.2f m", wide(thing.place.y)));
            facts.lines.push_back(told_slope(thing.normal));
            break;
        case ThingKind::ground:
            facts.title = told(city.ground.kinds[thing.index]);
            facts.title[0] = static_cast<char>(std::toupper(facts.title[0]));
            facts.lines.push_back(text_of("at a height of %.2f m", wide(thing.place.y)));
            facts.lines.push_back(told_slope(thing.normal));
            break;
    }
    facts.lines.push_back(place);
    return facts;
}

std::vector<std::pair<glm::vec3, glm::vec3>> outline_of(const CityIndex& index, const Thing& thing) {
    constexpr size_t k_most = 1200;
    std::vector<std::pair<glm::vec3, glm::vec3>> edges;
    const City& city = *index.city;
    auto add = [&](Vec3 a, Vec3 b) { edges.emplace_back(to_glm(a), to_glm(b)); };
    auto add_face = [&](const Face& face) {
        const Vec3 a = at_height(on_ground(face.a), face.a_top), b = at_height(on_ground(face.b), face.b_top);
        add(face.a, face.b), add(a, b), add(face.a, a);
    };
    if (thing.kind == ThingKind::building)
        for (uint32_t i : index.houses[thing.index].faces)
            if (edges.size() < k_most) add_face(city.ground.faces[i]);
    if (thing.kind == ThingKind::wall) {
        const Face& face = city.ground.faces[thing.index];
        add_face(face), add(face.b, at_height(on_ground(face.b), face.b_top));
    }
    auto add_ring = [&](Vec3 middle, Vec3 x, Vec3 z) {
        constexpr int k_sides = 24;
        auto at = [&](int i) {
            const SinCos angle = sin_cos(6.2831853f * static_cast<float>(i % k_sides) / k_sides);
            return middle + x * angle.cosine + z * angle.sine;
        };
        for (int i = 0; i < k_sides; ++i) add(at(i), at(i + 1));
    };
    if (thing.kind == ThingKind::prop && has_crown(city.props[thing.index])) {
        const Prop& prop = city.props[thing.index];
        const Vec3 x{prop.radius, 0, 0}, z{0, 0, prop.radius};
        add_ring(prop.position + Vec3{0, 0.05f, 0}, x, z);
        add_ring(prop.position + Vec3{0, crown_height(prop), 0}, x, z);
        add(prop.position, prop.position + Vec3{0, prop.height, 0});
    } else if (thing.kind == ThingKind::prop) {
        const Prop& prop = city.props[thing.index];
        const Vec2 half = half_footprint(prop);
        std::array<Vec3, 8> corners;
        for (size_t i = 0; i < 8; ++i)
            corners[i] = prop.position + out_of(prop, {i & 1 ? half.x : -half.x, i & 2 ? prop.height : 0,
                                                       i & 4 ? half.z : -half.z});
        for (size_t i = 0; i < 8; ++i)
            for (size_t bit : {size_t{1}, size_t{2}, size_t{4}})
                if (!(i & bit)) add(corners[i], corners[i | bit]);
    }
    if (thing.kind == ThingKind::ground || thing.kind == ThingKind::model) {
        constexpr float k_radius = 0.35f;
        const Vec3 aside = std::fabs(thing.normal.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
        const Vec3 x = normalize_or(cross(aside, thing.normal), {1, 0, 0}), z = cross(thing.normal, x);
        add_ring(thing.place + thing.normal * 0.03f, x * k_radius, z * k_radius);
    }
    return edges;
}

}  // namespace flaneur
