// From the wanted velocity to one that avoids the others and the border of the mesh.
#include <algorithm>
#include <cmath>

#include "sim/base/planar.h"
#include "sim/base/spans.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/deciders.h"
#include "sim/crowd/places.h"
#include "sim/lanes/near.h"

namespace flaneur {

static constexpr float k_border_horizon = 0.2f;  // seconds to the border, of one who is nearly there
static constexpr float k_border_braking = 2;     // m/s2, at most, of one who comes to it
static constexpr float k_border_reach = 1;       // metres
static constexpr float k_grazes = 0.02f;         // metres beyond its end by which one still touches a border
static constexpr float k_clear_of_end = 0.03f;   // m/s, at which one gets clear of the end of a border
static constexpr int k_borders = 6;
static constexpr float k_narrow = 0.2f, k_pinched = 0.04f;        // metres between two borders
static constexpr float k_opposite = -0.8f, k_parallel = -0.998f;  // cosines between them
static constexpr float k_in_the_way = 0.35f;  // metres between bodies, or prams, at which one is in the way
static constexpr float k_against = -0.5f;     // cosine between the courses of two who meet
static constexpr float k_throng = 0.15f;      // metres between bodies
static constexpr float k_shuffle = 0.24f;     // m/s, of one who does not turn for it
static constexpr float k_rocks = 0.26f, k_stands = 0.03f, k_least = 0.1f;  // m/s, of one who stands
static constexpr float k_retreat = 0.6f;  // m/s, up to which one goes back without a turn
static constexpr float k_onward = 0.3f;   // cosine to the course
static constexpr uint32_t k_most_heirs = 16;
static constexpr float k_same_way = 0.5f;  // cosine between the courses of two who go together
static constexpr float k_thronged = 1.3f;  // metres, within which all are whom one in a throng minds;
static constexpr float k_looks_ahead = 8, k_looks_aside = 0.5f;  // and where it looks who comes,
static constexpr float k_beside = 0.3f;         // who are so far to the usual side, on the whole, or not
static constexpr int k_looked_at = 256;         // people
static constexpr float k_pram_headway = 0.35f;  // seconds: who meets a pram gets past it
static constexpr float k_follows = 0.6f;        // seconds within which one shall not touch one ahead
static constexpr float k_off_who_talk = 0.12f;  // metres, and from who stands with others
static constexpr float k_fellows_horizon = 0.5f, k_fellows_headway = 0.3f;  // seconds, of those together
static constexpr int k_vehicles = 3;                                        // that one keeps off at one time
static constexpr int k_firm = 2 * k_borders + k_vehicles;
static_assert(k_firm + k_neighbours <= k_most_planes);

// Whether two with these courses go the same way.
static bool go_together(Vec2 mine, Vec2 theirs) { return dot(mine, theirs) > k_same_way; }

// Whether one, or the pram that it pushes, is where another, or the other's pram, would go.
static bool is_in_the_way(const Seen& me, const Seen& other) {
    const Vec2 to_me = on_ground(me.position - other.position);
    const float speed = length(other.velocity);
    auto is_before = [&](Vec2 way, float radii) {
        const float distance = length(way);
        return distance - radii < k_in_the_way && dot(other.velocity, way) > 0.4f * distance * speed;
    };
    const bool mine = me.ahead != Vec2{}, theirs = other.ahead != Vec2{};
    return is_before(to_me, me.radius + other.radius) ||
           (mine && is_before(to_me + me.ahead, k_pram_radius + other.radius)) ||
           (theirs && is_before(to_me - other.ahead, me.radius + k_pram_radius)) ||
           (mine && theirs && is_before(to_me + me.ahead - other.ahead, 2 * k_pram_radius));
}

// One's own claim, or a better one of somebody into whose way one has come.
static Claim claim_of(const SeenRows& rows, const Deciders& d, int lane, uint32_t insists) {
    const Seen& me = rows.all[d.at[lane]];
    Claim claim;
    if (insists != k_never) claim = {insists, me.id, 0};
    for (int k = 0; k < d.near_count[lane]; ++k) {
        const Seen& other = rows.all[d.near[lane][k]];
        Claim inherited = other.claim;
        if (inherited.since == k_never || ++inherited.heirs > k_most_heirs || !(inherited < claim)) continue;
        if (is_in_the_way(me, other)) claim = inherited;
    }
    return claim;
}

// Who has the better claim goes as far as there is room, and the others make way.
static float share_of(const Claim& mine, const Claim& theirs) {
    return mine < theirs ? 0.0f : theirs < mine ? 1.0f : 0.5f;
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

// Who goes through a door goes on in line or waits: it cannot step aside there, nor turn back.
static int keep_in_line(Vec2 wanted, HalfPlane* planes) {
    constexpr float k_sways = 0.02f;  // m/s
    const Vec2 way = normalize_or(wanted, {0, 0}), aside{-way.z, way.x};
    planes[0] = {way, 0};
    planes[1] = {aside, -k_sways};
    planes[2] = {aside * -1, -k_sways};
    return 3;
}

namespace {
// Borders beside which one is.
struct Sides {
    Vec2 inward[k_borders];
    float room[k_borders];  // metres
    int count = 0;
};
}  // namespace

// Adds a border beside, and returns whether one is between it and another that all but cross each other, as
// simplified ones sometimes do: one gets past there, as far as the mesh itself lets one.
static bool is_pinched_by(Vec2 inward, float room, Sides& sides) {
    bool is_pinched = false;
    for (int k = 0; k < sides.count; ++k) {
        const float across = room + sides.room[k], cosine = dot(inward, sides.inward[k]);
        is_pinched |= cosine < k_opposite && across < (cosine > k_parallel ? k_narrow : k_pinched);
    }
    sides.inward[sides.count] = inward;
    sides.room[sides.count++] = room;
    return is_pinched;
}

// The front of a pram comes no nearer to borders than it can stop from, and its middle not farther beyond: a
// turn may have brought it there, or past the end of one. Where two borders all but meet about it, it gets
// past as its pusher does.
static int keep_pram_in(const Navmesh& mesh, const Seen& me, HalfPlane* planes, int count) {
    constexpr float k_beyond = 0.6f;  // metres: else it is the border of another part of the mesh
    constexpr float k_cuts = 0.15f;   // metres, of a border's ends
    BorderLine lines[k_borders];
    const Vec2 ahead = normalize_or(me.ahead, {0, 0});
    const int count_of_body = count;
    bool is_pinched = false;
    Sides sides;
    Vec3 middle = me.position + at_height(me.ahead, 0);
    int borders = borders_near(mesh, middle, k_border_reach, lines, k_borders);
    for (int b = 0; b < borders; ++b) {
        Vec2 a = on_ground(lines[b].a), ab = on_ground(lines[b].b) - a;
        Vec2 inward = inward_of(lines[b]), p = on_ground(middle) - a;
        const float far = length(ab), along = dot(p, ab) / far, inside = dot(p, inward);
        bool is_mine = dot(on_ground(me.position) - a, inward) > 0;
        if (along < k_cuts || along > far - k_cuts || inside < -k_beyond || !is_mine) continue;
        const float room = inside - k_pram_reach * std::max(-dot(inward, ahead), 0.0f);
        planes[count++] = {inward, -border_speed(std::max(room, 0.0f))};
        is_pinched |= is_pinched_by(inward, room, sides);
    }
    return is_pinched ? count_of_body : count;
}

// What keeps one on the mesh.
static int keep_in(const Navmesh& mesh, const Seen& me, bool lifts, Vec2 velocity, HalfPlane* planes) {
    int count = 0;
    BorderLine lines[k_borders];
    bool is_pinched = false;
    Sides sides;
    const Vec2 p = on_ground(me.position);
    const int borders = borders_near(mesh, me.position, k_border_reach, lines, k_borders);
    for (int b = 0; b < borders; ++b) {
        Vec2 a = on_ground(lines[b].a), ab = on_ground(lines[b].b) - a;
        float t = closest_on(a, on_ground(lines[b].b), p);
        Vec2 away = p - (a + ab * t), inward = inward_of(lines[b]);
        if (dot(away, inward) < -0.05f) continue;  // seen from behind: the border of another part of the mesh
        float distance = length(away);
        bool tip = t <= 0 || t >= 1;  // passed to either side
        // Of two borders at whose corner one is neither holds one off the other's line.
        constexpr float k_at_end = 0.02f;  // metres
        if (distance < k_at_end && std::min(t, 1 - t) * length(ab) < k_at_end) continue;
        float to_line = dot(p - a, inward);
        if (!tip) {
            planes[count++] = {inward, -border_speed(distance)};
            is_pinched |= is_pinched_by(inward, distance, sides);
        } else if (to_line > 0 && runs_into(p, velocity, a, ab)) {
            planes[count++] = pass_end(velocity, away, distance, inward, to_line, t <= 0 ? ab * -1 : ab);
        } else {
            planes[count++] = {away / distance, -distance / k_border_horizon};
        }
    }
    if (is_pinched) count = 0;
    return me.ahead == Vec2{} || lifts ? count : keep_pram_in(mesh, me, planes, count);
}

// Bodies of vehicles, as walls that may go away.
static int keep_off_vehicles(const Roadway& roadway, const Seen& me, HalfPlane* planes, int count) {
    constexpr float k_apart = 0.08f;  // metres
    const int most = std::min(count + k_vehicles, k_firm);
    const Vec2 p = on_ground(me.position);
    if (!is_near_vehicles(roadway, p)) return count;
    for_boxes_near(roadway, p, k_border_reach + me.radius, [&](uint32_t k) {
        const VehicleBox& box = roadway.boxes[k];
        if (count == most || std::fabs(box.y - me.position.y) > k_other_level) return;
        const OffBox off = off_box(box, p);
        const float room = off.far - me.radius - k_apart;
        if (room > k_border_reach) return;
        const float leaves = std::min(dot(box.ahead, off.out) * box.speed, 0.0f);
        planes[count++] = {off.out, leaves - border_speed(std::max(room, 0.0f))};
    });
    return count;
}

// Prams that are near, one's own or the other's. No claim is so good that one minds none: they cannot step
// aside.
static void add_prams(const Seen& me, const Seen& other, float share, int lane, Deciders& d) {
    share = std::max(share, 0.5f);
    const Vec2 between = on_ground(other.position - me.position);
    const bool mine = length_squared(me.ahead) > 0, theirs = length_squared(other.ahead) > 0;
    auto add = [&](Vec2 apart, float radii) {
        d.prams[d.pram_count++] = {apart,           other.velocity,        radii, share, 1 / k_horizon,
                                   k_swath * radii, 1 / k_meeting_headway, lane};
    };
    if (theirs) add(between + other.ahead, me.radius + k_pram_radius);
    if (mine) add(between - me.ahead, k_pram_radius + other.radius);
    if (mine && theirs) add(between + other.ahead - me.ahead, 2 * k_pram_radius);
}

// Trunk and legs of one who lies there.
static void add_lying(const Downed& down, const Seen& me, const Seen& other, int lane, Deciders& d) {
    constexpr float k_half = 0.28f;  // metres across
    const Vec2 between = on_ground(other.position - me.position);
    for (const Vec2 end : {down.across, down.along}) {
        const float radii = me.radius + k_half;
        d.prams[d.pram_count++] = {between + end * 0.7f,  {},  radii, 1, 1 / k_horizon, k_swath * radii,
                                   1 / k_meeting_headway, lane};
    }
}

// Returns whether some of them stand close and none of them comes the other way.
static bool add_neighbours(const Crowd& c, const Seen& me, const Intent& intent, const Claim& claim, int lane,
                           Deciders& d) {
    const SeenRows& rows = c.scratch.seen;
    bool is_close = false, meets = false;
    const bool any_down = !c.downed.empty(), any_fellows = !c.fellows.empty();
    for (int k = 0; k < d.near_count[lane]; ++k) {
        const Seen& other = rows.all[d.near[lane][k]];
        float share = share_of(claim, other.claim), hurry = 1 / k_horizon;
        // Of those who go the same way the one behind makes room for the one ahead, and not the other way
        // round: so of any two one is free to go, and nobody waits for somebody who waits for him.
        const bool has_pram = me.ahead != Vec2{} || other.ahead != Vec2{};
        float swath = k_swath, pace = has_pram ? 1 / k_pram_headway : 1 / k_meeting_headway;
        if (any_fellows && !has_pram && are_together(c.fellows, me.id, other.id)) {
            // They walk shoulder to shoulder, and neither is behind.
            hurry = 1 / k_fellows_horizon, pace = 1 / k_fellows_headway;
            swath = k_hurried_swath;
        } else if (!has_pram && go_together(me.course, other.course)) {
            hurry = 1 / k_follows;
            pace = (intent.hurries ? 1 / k_hurried_headway : 1 / k_headway) / intent.room;
            swath = intent.hurries ? k_hurried_swath : k_swath;
            // Whoever is nearer to where both go, by the squares of the distances to their aims.
            const Vec2 p = on_ground(me.position), q = on_ground(other.position);
            const float before = dot(p - q, p + q - me.aim - other.aim);
            if (before != 0) share = before > 0 ? 1.0f : 0.0f;
        }
        const Vec2 between = on_ground(other.position - me.position);
        // Nobody passes between those who stand together.
        const bool stand_together =
            any_fellows && c.fellows[other.id].facing != Vec2{} && !are_together(c.fellows, me.id, other.id);
        const float radii = me.radius + other.radius + (stand_together ? k_off_who_talk : 0);
        meets |= dot(me.course, other.course) < k_against;
        is_close |= length_squared(between) < (radii + k_throng) * (radii + k_throng);
        MeetingRows& to = d.neighbours[k];
        to.x.lanes[lane] = between.x;
        to.z.lanes[lane] = between.z;
        to.velocity_x.lanes[lane] = other.velocity.x;
        to.velocity_z.lanes[lane] = other.velocity.z;
        to.radii.lanes[lane] = radii;
        to.share.lanes[lane] = share;
        to.hurry.lanes[lane] = hurry;
        to.swath.lanes[lane] = swath * radii;
        to.pace.lanes[lane] = pace;
        if (const Downed* down = any_down ? own_of(c.downed, other.id) : nullptr) {
            to.share.lanes[lane] = 1;
            add_lying(*down, me, other, lane, d);
        } else if (has_pram) {
            add_prams(me, other, share, lane, d);
        }
    }
    return is_close && !meets;
}

// Lanes of walkers who are not there, and neighbours and planes that some of them have not, do no harm.
static void clear(Deciders& d) {
    d.rows = d.pram_count = 0;
    for (int lane = 0; lane < d.count; ++lane) d.rows = std::max(d.rows, d.near_count[lane]);
    for (int k = 0; k < d.rows; ++k) d.neighbours[k] = {};
    for (LaneRow* row :
         {&d.velocity_x, &d.velocity_z, &d.wish_x, &d.wish_z, &d.most, &d.waited, &d.makes_room})
        *row = {};
}

static void set_firm(const HalfPlane (&firm)[k_block][k_firm], const int (&counts)[k_block], Deciders& d) {
    d.firm = *std::max_element(counts, counts + d.count);
    for (int k = 0; k < d.firm; ++k)
        for (int lane = 0; lane < k_block; ++lane) {
            const bool is_one = lane < d.count && k < counts[lane];
            set_plane(d.planes[k], lane, is_one ? firm[lane][k] : k_no_plane);
        }
}

// Who steps aside or back in a throng does not turn for it, nor who goes back a little anywhere.
static Vec2 shuffled(Vec2 v, Vec2 course, bool is_thronged) {
    const float speed = length(v), onward = dot(v, course);
    if (speed < k_shuffle || course == Vec2{} || onward > k_onward * speed) return v;
    if (!is_thronged && (onward > 0 || speed > k_retreat)) return v;
    return v * (k_shuffle / speed);
}

// Whoever hardly gets on stands rather than rock to and fro or back off from where it wants to go, nor does
// one who wants to stand set off for next to nothing: but to make way for who has a claim.
static Vec2 settled(Vec2 v, Vec2 velocity, Vec2 wanted, bool makes_way) {
    const float speed = length(v), wants = length(wanted);
    if (speed > k_rocks || makes_way) return v;
    const bool stands = length(velocity) < k_stands;
    const bool turns_back = !stands && dot(v, velocity) < 0;
    const bool sets_off = stands && wants < k_rocks && speed < k_least;
    const bool backs_off = wants > k_rocks && dot(v, wanted) < 0;
    return turns_back || sets_off || backs_off ? Vec2{} : v;
}

// One in a throng has no eyes for those who come the other way but over others' heads. It makes room for them
// before they meet, or both streams would fill all the way there is: see Deciders::makes_room. `side` is the
// usual one, 1 or -1.
static float side_to_make_room(const CrowdScratch& s, const Deciders& d, int lane, float side) {
    const Seen& me = s.seen.all[d.at[lane]];
    if (d.near_count[lane] < k_neighbours || me.course == Vec2{}) return 0;
    for (int k = 0; k < k_neighbours; ++k) {
        const Vec2 off = on_ground(s.seen.all[d.near[lane][k]].position - me.position);
        if (length_squared(off) > k_thronged * k_thronged) return 0;
    }
    uint32_t ahead[k_looked_at];
    const float half = k_looks_ahead / 2;
    const int count =
        find_within(s, me.position + at_height(me.course * half, 0), d.at[lane], half, ahead, k_looked_at);
    float aside = 0, come = 0;
    for (int k = 0; k < count; ++k) {
        const Seen& other = s.seen.all[ahead[k]];
        const float off = cross(me.course, on_ground(other.position - me.position));
        if (std::fabs(off) > k_looks_aside || dot(other.course, me.course) > k_against) continue;
        aside += off, come += 1;
    }
    if (come == 0) return 0;
    return aside * side > k_beside * come ? -side : side;
}

// The wish of one who does not get on because somebody stands right in front who means to stand there, such
// as one who sits between it and a bench's end: aside, where the mesh lets it. To go straight there as well
// as others let one would end in such a corner.
static Vec2 round_who_stands(const Crowd& c, const Navmesh& mesh, int thread, const Deciders& d, int lane,
                             Vec2 wanted) {
    constexpr float k_held = 0.1f, k_goes = 0.5f, k_before = 0.8f, k_in_front = 0.5f, k_aside = 0.7f,
                    k_same = 0.03f;            // m/s; metres; cosine; metres
    constexpr float k_turn = 75 * k_pi / 180;  // radians
    const Seen& me = c.scratch.seen.all[d.at[lane]];
    const float speed = length(wanted);
    if (speed < k_goes || length(c.motion.velocity[me.id]) > k_held) return wanted;
    const Vec2 way = wanted / speed;
    for (int k = 0; k < d.near_count[lane]; ++k) {
        const Seen& other = c.scratch.seen.all[d.near[lane][k]];
        const Vec2 between = on_ground(other.position - me.position);
        const float far = length(between);
        const bool stands =
            length(c.decision.wanted[other.id]) < k_stands && length(other.velocity) < k_stands;
        if (!stands || far > k_before || dot(between, way) < k_in_front * far) continue;
        const float nearer = cross(way, between) > 0 ? -1.0f : 1.0f, yaw = heading_of(way);
        for (const float side : {nearer, -nearer}) {
            const Vec2 aside = heading_direction(yaw - side * k_turn) * k_aside;
            const NavPoint from{me.position, c.motion.polygon[me.id]};
            const NavPoint to = move_along(mesh, thread, from, me.position + at_height(aside, 0));
            if (length(on_ground(to.position - me.position) - aside) < k_same)
                return aside * (speed / k_aside);
        }
    }
    return wanted;
}

static void decide(Crowd& c, const Navmesh& mesh, int thread, Deciders& d) {
    const SeenRows& rows = c.scratch.seen;
    find_nearest(c.scratch, d);
    clear(d);
    HalfPlane firm[k_block][k_firm];
    int firm_count[k_block];
    bool is_thronged[k_block];
    const float side = c.pass_on == PassOn::right ? 1.0f : -1.0f;
    for (int lane = 0; lane < d.count; ++lane) {
        const Seen& me = rows.all[d.at[lane]];
        const Intent& intent = c.scratch.intents[me.id];
        const Vec2 velocity = c.motion.velocity[me.id];
        const Claim claim = claim_of(rows, d, lane, intent.insists);
        c.decision.claim[me.id] = claim;
        d.velocity_x.lanes[lane] = velocity.x, d.velocity_z.lanes[lane] = velocity.z;
        const Vec2 wish = round_who_stands(c, mesh, thread, d, lane, intent.wanted);
        d.wish_x.lanes[lane] = wish.x, d.wish_z.lanes[lane] = wish.z;
        d.most.lanes[lane] = intent.most, d.waited.lanes[lane] = intent.waited;
        d.makes_room.lanes[lane] = side_to_make_room(c.scratch, d, lane, side);
        // Who walks back onto the mesh crosses its border.
        firm_count[lane] =
            intent.by_door ? keep_in_line(intent.wanted, firm[lane])
            : intent.is_beside
                ? 0
                : keep_in(mesh, me, intent.lifts || c.identity.ahead[me.id] == 0, velocity, firm[lane]);
        if (has_traffic(c.roadway) && !intent.by_door)
            firm_count[lane] = keep_off_vehicles(c.roadway, me, firm[lane], firm_count[lane]);
        is_thronged[lane] = add_neighbours(c, me, intent, claim, lane, d);
    }
    set_firm(firm, firm_count, d);
    choose_velocities(d, side);
    for (int lane = 0; lane < d.count; ++lane) {
        const Seen& me = rows.all[d.at[lane]];
        const Vec2 chosen{d.chosen_x.lanes[lane], d.chosen_z.lanes[lane]};
        const Vec2 goes = shuffled(chosen, me.course, is_thronged[lane]);
        // Who staggers does not stand as others do, and keeps off edges that the mesh does not know.
        c.decision.chosen[me.id] = c.scratch.intents[me.id].staggers
                                       ? goes
                                       : settled(goes, c.motion.velocity[me.id], c.decision.wanted[me.id],
                                                 c.decision.claim[me.id].heirs > 0);
    }
}

void steer(Crowd& c, const Navmesh& mesh, Workers& workers, uint32_t tick) {
    // In the order of places, so that those who decide together share neighbours and ground.
    parallel_for(workers, c.slots.living.size(), 512, [&](size_t begin, size_t end, int thread) {
        Deciders d;
        for (size_t at = begin; at < end; ++at) {
            if (decides(c, c.scratch.order[at] / k_block, tick)) d.at[d.count++] = static_cast<uint32_t>(at);
            if (d.count == k_block || (at + 1 == end && d.count > 0)) decide(c, mesh, thread, d), d.count = 0;
        }
    });
}

}  // namespace flaneur
