#include "assets/pastimes/edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/math.h"
#include "sim/ground/grid.h"

namespace flaneur {

namespace {

constexpr float k_level = 0.03f;  // metres within which heights are the same
constexpr float k_apart = 0.62f;  // metres from one seat to the next

// The upper edge of a face, seen from its free side.
struct Edge {
    Vec2 a, b, along, out;  // along, out: unit
    float length = 0, a_top = 0, b_top = 0;
    float top(float from_a) const { return a_top + (b_top - a_top) * (from_a / length); }
};
Edge edge_of(const Face& face) {
    Edge e{on_ground(face.a), on_ground(face.b), {}, {}, 0, face.a_top, face.b_top};
    e.length = length(e.b - e.a);
    e.along = normalize_or(e.b - e.a, {1, 0});
    e.out = {-e.along.z, e.along.x};
    return e;
}

uint32_t next_bench(const City& city, const std::vector<Seat>& seats) {
    const auto props = static_cast<uint32_t>(city.props.size());
    return seats.empty() ? props : std::max(props, seats.back().bench + 1);
}

std::optional<float> ground_height(const City& city, Vec2 at, float from, float up, float down) {
    const auto hit = ground_at(city.ground, at_height(at, from), up, down);
    return hit ? std::optional(hit->height) : std::nullopt;
}
bool is_ground(const City& city, Vec2 at, float height) {
    return ground_height(city, at, height, k_level, k_level).has_value();
}

// Metres from the edge to the wall's other side, at least `least`; 0: there is none.
float thickness_of(const City& city, const Edge& e, Vec2 at, float top, float least) {
    constexpr float k_most = 1.5f;
    float depth = 0;
    const Vec2 box{k_most, k_most};
    for_items_of_box(city.ground.wall_grid, at - box, at + box, [&](uint32_t item) {
        const Face& face = city.ground.faces[item];
        if (face.kind != FaceKind::garden_wall) return;
        const Edge other = edge_of(face);
        const float behind = dot(at - other.a, e.out), beside = dot(at - other.a, other.along);
        if (dot(other.out, e.out) > -0.999f || behind < least || behind > k_most) return;
        if (beside < 0 || beside > other.length || std::fabs(other.top(beside) - top) > k_level) return;
        if (depth == 0 || behind < depth) depth = behind;
    });
    return depth;
}

// Calls visit(edge, n, place, top) for places `apart` metres from each other on the level edges of walls, no
// nearer than `end` to their ends.
template <class Visit>
void for_wall_places(const City& city, float apart, float end, const Visit& visit) {
    constexpr float k_steepest = 0.04f;
    for (const Face& face : city.ground.faces) {
        const Edge e = edge_of(face);
        if (face.kind != FaceKind::garden_wall || e.length < 2 * end ||
            std::fabs(e.b_top - e.a_top) > k_steepest * e.length)
            continue;
        const auto count = 1 + static_cast<int>((e.length - 2 * end) / apart);
        const float begins = 0.5f * (e.length - apart * static_cast<float>(count - 1));
        for (int n = 0; n < count; ++n) {
            const float from_a = begins + apart * static_cast<float>(n);
            visit(e, n, e.a + e.along * from_a, e.top(from_a));
        }
    }
}

// As deep as one can sit there: on the wall, or on the ground that goes on behind it at its height; 0: one
// cannot.
float depth_behind(const City& city, const Edge& e, Vec2 at, float top) {
    constexpr float k_least = 0.24f, k_enough = 0.5f;
    if (is_ground(city, at - e.out * k_least, top) && is_ground(city, at - e.out * k_enough, top))
        return k_enough;
    return thickness_of(city, e, at, top, k_least);
}

// Whether a wall or a house stands where the back would be.
bool is_built_over(const City& city, const Edge& e, Vec2 at, float top) {
    constexpr float k_back = 0.35f, k_room = 0.3f;  // metres: over the seat; from behind its edge
    return closest_wall(city.ground, at_height(at - e.out * 0.12f, top + k_back), k_room).has_value();
}

// Whether somebody sits there who faces the other way, back to back.
bool is_taken_behind(const std::vector<Seat>& seats, size_t from, Vec2 at, Vec2 out, float depth) {
    constexpr float k_each = 0.4f;  // metres that one needs
    return depth < 2 * k_each &&
           std::any_of(seats.begin() + static_cast<std::ptrdiff_t>(from), seats.end(), [&](const Seat& s) {
               return dot(s.facing, out) < 0 && length(on_ground(s.edge) - at) < depth + 0.5f * k_apart;
           });
}

}  // namespace

void add_wall_seats(const City& city, std::vector<Seat>& seats) {
    constexpr float k_lowest = 0.35f, k_highest = 0.6f, k_before = 0.3f, k_end = 0.3f, k_most_depth = 0.4f;
    const size_t first = seats.size();
    uint32_t bench = 0;
    for_wall_places(city, k_apart, k_end, [&](const Edge& e, int n, Vec2 at, float top) {
        if (n == 0) bench = next_bench(city, seats);
        const auto ground =
            ground_at(city.ground, at_height(at + e.out * k_before, top - k_lowest), 0, k_highest - k_lowest);
        if (!ground || is_carriageway(ground->kind) || !is_walked(ground->kind) || ground->normal.y < 0.995f)
            return;
        const float depth = depth_behind(city, e, at, top);
        if (depth == 0 || is_built_over(city, e, at, top) || is_taken_behind(seats, first, at, e.out, depth))
            return;
        seats.push_back({at_height(at, top), e.out, std::min(depth, k_most_depth), bench,
                         static_cast<uint32_t>(n % 2), SeatOn::wall});
    });
}

namespace {

// How a flight goes on below a riser.
struct Below {
    int risers = 0;   // with this one
    float tread = 0;  // metres, of the next tread down
};
Below look_down(const City& city, Vec2 at, Vec2 out, float top) {
    constexpr float k_step = 0.01f, k_landing = 0.8f, k_least_riser = 0.06f, k_most_riser = 0.25f;
    Below below;
    float height = top, last = 0;
    for (float d = k_step; d - last < k_landing; d += k_step) {
        const auto hit = ground_height(city, at + out * d, height, k_level, k_most_riser);
        if (!hit) break;
        if (height - *hit < k_least_riser) continue;
        if (++below.risers == 2) below.tread = d - last;
        height = *hit, last = d;
    }
    return below;
}

// Metres that the tread goes on inward from the end of a riser.
float width_of(const City& city, const Edge& e, Vec2 end, Vec2 inward, float top) {
    constexpr float k_step = 0.25f, k_most = 30, k_off = 0.08f;
    float width = 0;
    for (float w = 0.5f * k_step; w < k_most; w += k_step) {
        const Vec2 at = end + inward * w;
        if (!is_ground(city, at - e.out * k_off, top) || is_ground(city, at + e.out * k_off, top)) break;
        width = w + 0.5f * k_step;
    }
    return width;
}

// Columns of seats along a side of a flight of that width: of narrow ones, along one side only.
int columns_of(float width, bool is_first_side) {
    if (width < 3 || (width < 3.6f && !is_first_side)) return 0;
    return width < 5 ? 1 : width < 7 ? 2 : 3;
}

}  // namespace

void add_step_seats(const City& city, std::vector<Seat>& seats) {
    constexpr float k_least_rise = 0.1f, k_most_rise = 0.2f, k_off = 0.08f;
    constexpr float k_beside = 0.64f;  // metres: the mesh leads no nearer to a wall
    constexpr float k_least_tread = 0.24f, k_most_tread = 0.6f;
    constexpr int k_every = 4, k_feet = 2;  // treads; those below a seat that feet are on
    for (const Face& face : city.ground.faces) {
        const Edge e = edge_of(face);
        const float rise = face.a_top - face.a.y;
        if (face.kind != FaceKind::riser || e.length < 0.05f || std::fabs(e.b_top - e.a_top) > k_level ||
            rise < k_least_rise || rise > k_most_rise)
            continue;
        for (const float side : {1.0f, -1.0f}) {
            const Vec2 end = side > 0 ? e.a : e.b, inward = e.along * side;
            if (is_ground(city, end - inward * k_off - e.out * k_off, e.a_top)) continue;  // it goes on
            const int columns = columns_of(width_of(city, e, end, inward, e.a_top), side > 0);
            if (columns == 0) continue;
            const Below below = look_down(city, end + inward * k_beside, e.out, e.a_top);
            if (below.risers % k_every != k_feet || below.tread < k_least_tread || below.tread > k_most_tread)
                continue;
            const uint32_t bench = next_bench(city, seats);
            for (int n = 0; n < columns; ++n) {
                const Vec2 at = end + inward * (k_beside + k_apart * static_cast<float>(n));
                // The tread is about as deep as the one below it.
                seats.push_back({at_height(at, e.a_top), e.out, below.tread, bench, n == 0 ? 0u : 1u,
                                 SeatOn::steps, below.tread});
            }
        }
    }
}

void add_railings(const City& city, std::vector<Railing>& railings) {
    constexpr float k_lowest = 0.9f, k_highest = 1.2f, k_before = 0.3f, k_end = 0.4f;
    constexpr float k_thin = 0.05f, k_thick = 0.5f, k_beyond = 0.5f, k_drop = 1, k_each = 0.8f;
    for_wall_places(city, k_each, k_end, [&](const Edge& e, int, Vec2 at, float top) {
        const auto ground =
            ground_at(city.ground, at_height(at + e.out * k_before, top - k_lowest), 0, k_highest - k_lowest);
        if (!ground || !is_walked(ground->kind) || ground->kind == Surface::road) return;
        const float thick = thickness_of(city, e, at, top, k_thin);
        if (thick == 0 || thick > k_thick) return;
        const auto beyond = ground_at(city.ground, at_height(at - e.out * (thick + k_beyond), top), 0,
                                      top - ground->height + k_drop);
        if (beyond && beyond->kind != Surface::water) return;
        railings.push_back({at_height(at, top), -e.out});
    });
}

}  // namespace flaneur
