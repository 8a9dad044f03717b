// From the wanted velocity to one that avoids the others and the border of the mesh.
#include <algorithm>
#include <cmath>

#include "sim/base/segment.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/half_planes.h"
#include "sim/crowd/places.h"

namespace flaneur {

static constexpr float k_horizon = 1.5f;         // seconds within which no one shall be met
static constexpr float k_untangle = 0.3f;        // seconds to end an overlap in
static constexpr float k_margin = 0.04f;         // metres kept between bodies
static constexpr float k_border_horizon = 0.2f;  // seconds to the border, of one who is nearly there
static constexpr float k_border_braking = 2;     // m/s2, at most, of one who comes to it
static constexpr float k_border_reach = 1;       // metres
static constexpr float k_grazes = 0.02f;         // metres beyond its end by which one still touches a border
static constexpr float k_clear_of_end = 0.03f;   // m/s, at which one gets clear of the end of a border
static constexpr int k_borders = 6;
static constexpr float k_headway = 0.5f;      // seconds: a walker needs this long to cover the gap ahead
static constexpr float k_keep_right = 0.15f;  // of the speed, where others come the other way
static constexpr float k_patience = 0.7f;     // seconds without getting nearer before one gives way
static constexpr float k_give_way = 0.6f;     // of the speed, to the right, for each second of that
static constexpr float k_in_the_way = 0.35f;  // metres between bodies at which one is in the way
static constexpr uint32_t k_most_heirs = 16;
static constexpr float k_haste = 1.1f;  // times the preferred speed, at most

// Walkers who meet head-on must not both wait: each takes its share of the change, on the side where it is
// smallest.
static HalfPlane avoid(Vec2 between, Vec2 velocity, Vec2 other_velocity, float radius, float share) {
    Vec2 relative = velocity - other_velocity, change;
    Vec2 normal;
    float distance_squared = length_squared(between);
    float horizon = distance_squared > radius * radius ? k_horizon : k_untangle;
    Vec2 w = relative - between / horizon;  // from the centre of the cut-off circle
    float along = dot(w, between);
    if (distance_squared <= radius * radius ||
        (along < 0 && along * along > radius * radius * length_squared(w))) {
        float l = length(w);
        // Two at one place and speed: apart along x, each its way would need an id; the push of `move` parts
        // them.
        normal = l > 1e-6f ? w / l : Vec2{1, 0};
        change = normal * (radius / horizon - l);
    } else {
        // The nearer side of the cone that touches the other's circle.
        float tangent = std::sqrt(distance_squared - radius * radius);
        Vec2 side;
        if (cross(between, w) > 0) {
            side = Vec2{between.x * tangent - between.z * radius, between.x * radius + between.z * tangent} /
                   distance_squared;
            normal = {-side.z, side.x};
        } else {
            side = Vec2{between.x * tangent + between.z * radius, -between.x * radius + between.z * tangent} /
                   distance_squared;
            normal = {side.z, -side.x};
        }
        change = side * dot(relative, side) - relative;
    }
    return {normal, dot(velocity + change * share, normal)};
}

// Calls visit(from me to the other, sum of radii) for each pram that is near, mine or the other's.
template <class Visit>
static void for_prams(const Seen& me, const Seen& other, const Visit& visit) {
    Vec2 between = on_ground(other.position - me.position);
    const bool mine = length_squared(me.ahead) > 0, theirs = length_squared(other.ahead) > 0;
    if (theirs) visit(between + other.ahead, me.radius + k_pram_radius);
    if (mine) visit(between - me.ahead, k_pram_radius + other.radius);
    if (mine && theirs) visit(between + other.ahead - me.ahead, 2 * k_pram_radius);
}

// V(s) = (s - l) / T with s the distance to the first body in the way (Tordeux, Chraibi and Seyfried 2016,
// without their force: ORCA has done that). Those who walk ahead at a like speed leave room as they go.
static float headway_speed(const Crowd& c, const Seen& me, const Claim& claim, Vec2 direction) {
    float speed = 1e9f;
    const uint32_t* slots = &c.scratch.neighbours[size_t{me.id} * k_neighbours];
    for (int k = 0; k < c.scratch.neighbour_count[me.id]; ++k) {
        const Seen& other = c.scratch.sorted[slots[k]];
        if (claim < other.claim) continue;  // makes way
        auto keep_headway = [&](Vec2 between, float l) {
            float ahead = dot(between, direction), aside = std::fabs(cross(direction, between));
            if (ahead <= 0 || aside >= l) return;
            float gap = ahead - std::sqrt(l * l - aside * aside);
            float leaving = std::max(0.0f, dot(other.velocity, direction));
            speed = std::min(speed, std::max(0.0f, gap / k_headway) + 0.9f * leaving);
        };
        keep_headway(on_ground(other.position - me.position), me.radius + other.radius);
        for_prams(me, other, keep_headway);
    }
    return speed;
}

// One's own claim, or a better one of somebody into whose way one has come.
static Claim claim_of(const Crowd& c, const Seen& me) {
    Claim claim;
    if (c.journeys[me.id].insists_since != k_never) claim = {c.journeys[me.id].insists_since, me.id, 0};
    const uint32_t* slots = &c.scratch.neighbours[size_t{me.id} * k_neighbours];
    for (int k = 0; k < c.scratch.neighbour_count[me.id]; ++k) {
        const Seen& other = c.scratch.sorted[slots[k]];
        Claim inherited = other.claim;
        if (++inherited.heirs > k_most_heirs || !(inherited < claim)) continue;
        Vec2 to_me = on_ground(me.position - other.position);
        float distance = length(to_me), speed = length(other.velocity);
        float gap = distance - me.radius - other.radius;
        bool in_the_way = gap < k_in_the_way && dot(other.velocity, to_me) > 0.4f * distance * speed;
        if (in_the_way) claim = inherited;
    }
    return claim;
}

// How fast one may come nearer to a border that is so far away: as one can slow down evenly.
static float border_speed(float distance) {
    float last = k_border_horizon * k_border_braking;
    return std::sqrt(2 * k_border_braking * distance + last * last) - last;
}

// Whether one at `p` with this velocity runs into the border from a to a + ab sooner or later, ahead of it.
static bool runs_into(Vec2 p, Vec2 velocity, Vec2 a, Vec2 ab) {
    float nearing = cross(velocity, ab), along = cross(a - p, velocity);
    float grazes = k_grazes * length(velocity);
    return nearing > 1e-6f && along >= -grazes && along <= nearing + grazes;
}

// A border whose end is what is nearest of it: one passes that end if that is less of a change than to stop.
static HalfPlane pass_end(Vec2 velocity, Vec2 away, float distance, Vec2 inward, float to_line, Vec2 beyond) {
    Vec2 aside{-away.z / distance, away.x / distance};
    if (dot(aside, beyond) < 0) aside = aside * -1;
    float most = border_speed(to_line), to_stop = -dot(velocity, inward) - most;
    return -dot(velocity, aside) < to_stop ? HalfPlane{aside, k_clear_of_end} : HalfPlane{inward, -most};
}

// The middle of a pram comes no nearer to borders than it can stop from, and not farther beyond: a turn may
// have brought it there.
static int keep_pram_in(const Navmesh& mesh, const Seen& me, HalfPlane* planes, int count) {
    constexpr float k_front = 0.2f;   // metres that its wheels reach farther ahead than the mesh's own margin
    constexpr float k_beyond = 0.6f;  // metres: else it is the border of another part of the mesh
    BorderLine lines[k_borders];
    Vec3 middle = me.position + at_height(me.ahead, 0);
    int borders = borders_near(mesh, middle, k_border_reach, lines, k_borders);
    for (int b = 0; b < borders; ++b) {
        Vec2 a = on_ground(lines[b].a), ab = on_ground(lines[b].b) - a;
        Vec2 inward = inward_of(lines[b]), p = on_ground(middle) - a;
        float along = dot(p, ab) / length_squared(ab), inside = dot(p, inward);
        bool is_mine = dot(on_ground(me.position) - a, inward) > 0;
        if (along < 0 || along > 1 || inside < -k_beyond || !is_mine) continue;
        planes[count++] = {inward, -border_speed(std::max(inside - k_front, 0.0f))};
    }
    return count;
}

static Vec2 choose_velocity(const Crowd& c, const Navmesh& mesh, const Seen& me, const Claim& claim,
                            uint32_t tick) {
    static_assert(2 * k_borders + 4 * k_neighbours <= k_most_planes);
    HalfPlane planes[k_most_planes];
    uint32_t i = me.id;
    Vec2 p = on_ground(me.position), velocity = c.motion.velocity[i], wish = c.decision.wanted[i];

    int count = 0;
    BorderLine lines[k_borders];
    // Who walks back onto the mesh crosses its border.
    const bool is_beside = c.way_back[i].polygon != 0;
    int borders = is_beside ? 0 : borders_near(mesh, me.position, k_border_reach, lines, k_borders);
    for (int b = 0; b < borders; ++b) {
        Vec2 a = on_ground(lines[b].a), ab = on_ground(lines[b].b) - a;
        float t = closest_on(a, on_ground(lines[b].b), p);
        Vec2 away = p - (a + ab * t), inward = inward_of(lines[b]);
        if (dot(away, inward) < -0.05f) continue;  // seen from behind: the border of another part of the mesh
        float distance = length(away);
        bool tip = t <= 0 || t >= 1;  // passed to either side
        if (tip && distance < 0.02f) continue;
        float to_line = dot(p - a, inward);
        if (!tip) {
            planes[count++] = {inward, -border_speed(distance)};
        } else if (to_line > 0 && runs_into(p, velocity, a, ab)) {
            planes[count++] = pass_end(velocity, away, distance, inward, to_line, t <= 0 ? ab * -1 : ab);
        } else {
            planes[count++] = {away / distance, -distance / k_border_horizon};
        }
    }
    if (length_squared(me.ahead) > 0 && !is_beside) count = keep_pram_in(mesh, me, planes, count);
    int firm = count;

    const uint32_t* slots = &c.scratch.neighbours[size_t{i} * k_neighbours];
    float oncoming = 0;
    for (int k = 0; k < c.scratch.neighbour_count[i]; ++k) {
        const Seen& other = c.scratch.sorted[slots[k]];
        Vec2 between = on_ground(other.position - me.position);
        // Who has the better claim goes as far as there is room, and the others make way.
        if (!(claim < other.claim)) {
            float share = other.claim < claim ? 1.0f : 0.5f;
            planes[count++] =
                avoid(between, velocity, other.velocity, me.radius + other.radius + k_margin, share);
            for_prams(me, other, [&](Vec2 apart, float radius) {
                planes[count++] = avoid(apart, velocity, other.velocity, radius, share);
            });
        }
        if (dot(other.velocity, wish) < 0 && dot(between, wish) > 0) oncoming = 1;
    }
    // Those who do not get on in a jam give way to the right, ever more, until two streams have sorted
    // themselves.
    float waited = static_cast<float>(tick - c.journeys[i].closest_tick) * k_tick;
    float right = oncoming * (k_keep_right + k_give_way * clamp(waited - k_patience, 0, 2));
    wish += Vec2{-wish.z, wish.x} * right;

    float most = std::max(c.identity.preferred_speed[i], 0.3f) * k_haste;
    if (i == c.driven.walker) most = k_fastest_driven;
    Vec2 v = best_velocity(planes, count, firm, most, wish);
    float speed = length(v);
    if (speed < 1e-4f) return {0, 0};
    return v * std::min(1.0f, headway_speed(c, me, claim, v / speed) / speed);
}

void steer(Crowd& c, const Navmesh& mesh, Workers& workers, uint32_t tick) {
    for_deciders(c, workers, tick, [&](const Seen& me) {
        Claim claim = claim_of(c, me);
        c.decision.chosen[me.id] = choose_velocity(c, mesh, me, claim, tick);
        c.decision.claim[me.id] = claim;
    });
}

}  // namespace flaneur
