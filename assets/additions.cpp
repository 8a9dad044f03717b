#include "assets/additions.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_to_ground = 3;                                      // metres up and down
constexpr float k_wall_height = 2, k_wall_half = 0.15f, k_piece = 6;  // metres
constexpr float k_wall_foot = 0.3f;                                   // metres under the ground
constexpr float k_barrier_height = 1, k_barrier_width = 2;            // metres, the latter at most
constexpr float k_before_door = 0.7f, k_before_bench = 0.55f;         // metres
constexpr float k_to_house = 3, k_near_wall = 4, k_hand = 1.2f;       // metres
constexpr float k_entrance_weight = 3;

std::optional<Vec3> on_the_ground(const Ground& ground, Vec3 p) {
    const auto hit = ground_at(ground, p, k_to_ground, k_to_ground);
    if (!hit) return std::nullopt;
    return Vec3{p.x, hit->height, p.z};
}

bool is_water(const Ground& ground, Vec3 p) {
    const auto hit = ground_at(ground, p, k_to_ground, k_to_ground);
    return hit && hit->kind == Surface::water;
}

// Calls put(a, b) for the pieces of it, of `longest` metres at most, that have ground at both ends; returns
// how many.
template <class Put>
int for_pieces(const Ground& ground, const Addition& added, float longest, const Put& put) {
    const float whole = length(on_ground(added.to - added.at));
    const int pieces = std::max(1, static_cast<int>(std::ceil(whole / longest - 1e-3f)));
    int found = 0;
    auto joint = [&](int i) {
        const float share = static_cast<float>(i) / static_cast<float>(pieces);
        return on_the_ground(ground, lerp(added.at, added.to, share));
    };
    for (int i = 0; i < pieces; ++i) {
        const std::optional<Vec3> a = joint(i), b = joint(i + 1);
        if (a && b) put(*a, *b), ++found;
    }
    return found;
}

void add_wall_piece(City& city, Vec3 a, Vec3 b) {
    const Vec2 along = normalize_or(on_ground(b - a), {1, 0});
    const Vec3 out = at_height(Vec2{-along.z, along.x} * k_wall_half, 0);
    const Vec3 foot{0, -k_wall_foot, 0};
    const float a_top = a.y + k_wall_height, b_top = b.y + k_wall_height;
    const Vec3 corners[] = {a + out, b + out, b - out, a - out};
    const float tops[] = {a_top, b_top, b_top, a_top};
    for (size_t i = 0; i < 4; ++i) {
        const size_t next = (i + 1) % 4;
        city.ground.faces.push_back(
            {corners[i] + foot, corners[next] + foot, tops[i], tops[next], FaceKind::garden_wall});
    }
    const auto first = static_cast<uint32_t>(city.roof_vertices.size());
    for (size_t i = 0; i < 4; ++i) city.roof_vertices.push_back({corners[i].x, tops[i], corners[i].z});
    for (uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u}) city.roof_indices.push_back(first + corner);
    city.roof_buildings.insert(city.roof_buildings.end(), {~0u, ~0u});
}

void put(City& city, const Prop& prop) {
    city.props.push_back(prop);
    city.ground.obstacles.push_back({prop.position, prop.yaw, half_footprint(prop)});
}

void add_barrier(City& city, Vec3 a, Vec3 b) {
    const Vec2 along = on_ground(b - a);
    const float yaw = heading_of(Vec2{-along.z, along.x});
    put(city, {PropKind::barrier, lerp(a, b, 0.5f), yaw, k_barrier_height, length(along) * 0.5f, 0});
}

// `seed`: the same for the same place.
uint32_t seed_of(Vec3 p) {
    return static_cast<uint32_t>(mix(static_cast<uint64_t>(static_cast<int64_t>(p.x * 100)) << 32 ^
                                     static_cast<uint64_t>(static_cast<int64_t>(p.z * 100))));
}

Prop prop_of(const Addition& a, Vec3 place) {
    Prop prop;
    prop.position = place;
    prop.yaw = wrap_angle(a.turn * k_radians);
    prop.seed = seed_of(place);
    switch (a.kind) {
        case AddedKind::car:
            prop.kind = PropKind::car, prop.height = 1.47f;
            break;
        case AddedKind::tree:
            prop.kind = PropKind::tree, prop.height = 7.5f, prop.radius = 2.1f;
            break;
        case AddedKind::bench:
            prop.kind = PropKind::bench, prop.height = 0.8f;
            break;
        case AddedKind::lamp:
            prop.kind = PropKind::lamp, prop.height = 5.5f;
            break;
        default:
            prop.kind = PropKind::planter, prop.height = 1.1f;
            break;
    }
    return prop;
}

std::string told(const Addition& a, size_t number) {
    auto metres = [](float v) {
        std::string text = std::to_string(std::round(v * 10) / 10);
        return text.substr(0, text.find('.') + 2);
    };
    std::string text = "Number " + std::to_string(number + 1) + " of what is added, ";
    text += a.kind == AddedKind::entrance ? "an " : "a ";
    text += k_added_names[static_cast<size_t>(a.kind)];
    return text + " at " + metres(a.at.x) + "," + metres(a.at.y) + "," + metres(a.at.z) + ", ";
}

// Whether a thing of this size would stand in a solid, such as a plinth.
bool is_in_solid(const Ground& ground, Vec3 place, Vec2 half) {
    constexpr float k_foot = 0.1f, k_low = 1;  // metres; what is higher up lets things stand below
    const float least = std::min(half.x, half.z);
    const Vec3 foot = place + Vec3{0, k_foot, 0};
    const auto above = raycast(ground, foot, {0, 1, 0}, k_low);
    if (above && above->what == RayHit::What::solid) return true;
    const auto beside = closest_wall(ground, foot, least);
    return beside && beside->face == ~0u;
}

// What is wrong with it there; empty: nothing.
std::string add_one(City& city, const Addition& a) {
    const Ground& ground = city.ground;
    for (Vec3 p : {a.at, is_drawn_out(a.kind) ? a.to : a.at})
        if (!(p.x > ground.low.x + 1 && p.x < ground.high.x - 1 && p.z > ground.low.z + 1 &&
              p.z < ground.high.z - 1))
            return "lies beyond the city";
    if (is_water(ground, a.at)) return "lies in the water: put it on the ground";
    if (is_drawn_out(a.kind) && is_water(ground, a.to))
        return "ends in the water: both ends lie on the ground";
    if (is_drawn_out(a.kind)) {
        const bool is_wall = a.kind == AddedKind::wall;
        const int pieces =
            for_pieces(ground, a, is_wall ? k_piece : k_barrier_width, [&](Vec3 from, Vec3 to) {
                is_wall ? add_wall_piece(city, from, to) : add_barrier(city, from, to);
            });
        return pieces > 0 ? "" : "has no ground within 3 m up and down";
    }
    const auto place = on_the_ground(ground, a.at);
    if (!place) return "has no ground within 3 m up and down";
    if (a.kind == AddedKind::entrance) {
        const auto wall = entrance_at(ground, *place);
        if (!wall) return "has no house within 3 m to lead into";
        const auto step = on_the_ground(ground, {wall->point.x + wall->normal.x * k_before_door, place->y,
                                                 wall->point.z + wall->normal.z * k_before_door});
        if (!step) return "has no ground before it";
        city.destinations.push_back(
            {DestinationKind::door, *step, on_ground(wall->normal) * -1, k_entrance_weight});
        return "";
    }
    const Prop prop = prop_of(a, *place);
    if (is_in_solid(ground, *place, half_footprint(prop))) return "would stand in what is there";
    for (const Prop& other : city.props) {
        const Vec2 half = half_footprint(prop), others = half_footprint(other);
        const float near = 0.7f * (std::min(half.x, half.z) + std::min(others.x, others.z));
        const Vec3 apart = other.position - *place;
        if (length(on_ground(apart)) < near && std::fabs(apart.y) < 1) return "would stand in what is there";
    }
    put(city, prop);
    if (a.kind == AddedKind::bench) {
        const Vec2 ahead = heading_direction(prop.yaw);
        const Vec3 seat = prop.position + at_height(ahead * k_before_bench, 0);
        if (const auto step = on_the_ground(ground, seat))
            city.destinations.push_back({DestinationKind::bench, *step, ahead, 1});
    }
    return "";
}

}  // namespace

Rectangle area_of(const Addition& a) {
    if (is_drawn_out(a.kind))
        return widened({{std::min(a.at.x, a.to.x), std::min(a.at.z, a.to.z)},
                        {std::max(a.at.x, a.to.x), std::max(a.at.z, a.to.z)}},
                       0.9f);
    const Vec2 half = half_footprint(prop_of(a, a.at));
    return widened({on_ground(a.at), on_ground(a.at)}, half.x + half.z + 0.5f);
}

std::optional<WallPoint> entrance_at(const Ground& ground, Vec3 place) {
    const auto wall = closest_wall(ground, place + Vec3{0, k_hand, 0}, k_to_house);
    const bool is_house = wall && wall->face != ~0u && ground.faces[wall->face].kind == FaceKind::facade;
    return is_house ? wall : std::nullopt;
}

float usual_turn(const Ground& ground, Vec3 place) {
    const auto wall = closest_wall(ground, place + Vec3{0, k_hand, 0}, k_near_wall);
    return wall ? std::round(heading_of(on_ground(wall->normal)) / k_radians) : 0.0f;
}

Result<void> add_to_city(City& city, std::span<const Addition> added) {
    const size_t faces = city.ground.faces.size();
    for (size_t i = 0; i < added.size(); ++i)
        if (const std::string fault = add_one(city, added[i]); !fault.empty())
            return Error{told(added[i], i) + fault + "."};
    if (city.ground.faces.size() > faces) index_ground(city.ground);
    return {};
}

}  // namespace flaneur
