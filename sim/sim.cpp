#include "sim/sim.h"

#include <cmath>
#include <cstdio>
#include <string>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/coming/passages.h"
#include "sim/stepping.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr uint32_t k_most_walkers = 1'000'000;
constexpr Vec3 k_reach{2, 2, 2};  // to the nearest walkable place, half extents, metres

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Within [low, high]; NaN is not.
bool is_within(float v, float low, float high) { return v >= low && v <= high; }

std::string at(Vec3 p) {
    char text[96];
    std::snprintf(text, sizeof text, "(%.2f, %.2f, %.2f)", static_cast<double>(p.x), static_cast<double>(p.y),
                  static_cast<double>(p.z));
    return text;
}

Result<Ground> ground_of(const Triangles& t, float max_slope_degrees) {
    size_t count = t.indices.size() / 3;
    if (t.indices.size() % 3 != 0) return Error{"The number of indices is not a multiple of three."};
    if (!t.kinds.empty() && t.kinds.size() != count)
        return Error{"There are " + std::to_string(t.kinds.size()) + " kinds of ground for " +
                     std::to_string(count) + " triangles: give one for each, or none."};
    for (size_t i = 0; i < t.positions.size(); ++i)
        if (!is_finite(t.positions[i])) return Error{"Position " + std::to_string(i) + " is not finite."};
    Ground ground;
    ground.name = "ground";
    ground.vertices.assign(t.positions.begin(), t.positions.end());
    float flattest_wall = sin_cos(max_slope_degrees * k_radians).cosine;
    for (size_t i = 0; i < count; ++i) {
        Vec3 corners[3];
        for (size_t k = 0; k < 3; ++k) {
            uint32_t index = t.indices[i * 3 + k];
            if (index >= t.positions.size())
                return Error{"Triangle " + std::to_string(i) + " refers to position " +
                             std::to_string(index) + ", but there are " + std::to_string(t.positions.size()) +
                             "."};
            corners[k] = t.positions[index];
        }
        Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (!(length(normal) > 1e-9f)) continue;
        if (normal.y >= flattest_wall * length(normal)) {
            for (size_t k = 0; k < 3; ++k) ground.indices.push_back(t.indices[i * 3 + k]);
            ground.kinds.push_back(t.kinds.empty() ? Surface::plaza : t.kinds[i]);
        } else {
            ground.solids.push_back({corners[0], corners[1], corners[2]});
        }
    }
    if (ground.indices.empty())
        return Error{"No triangle faces up: wind them counter-clockwise seen from above, with +y up."};
    index_ground(ground);
    return ground;
}

Result<void> check(const std::vector<Sending>& sendings) {
    auto is_sound = [](const SentPlace& area) {
        bool sound =
            (area.corners.size() == 1 || area.corners.size() >= 3) && std::isfinite(area.height.value_or(0));
        for (const Vec2 corner : area.corners)
            sound = sound && std::isfinite(corner.x) && std::isfinite(corner.z);
        return sound;
    };
    size_t people = 0;
    for (const Sending& sending : sendings) {
        people += sending.people;
        if (sending.group < 1 || !is_sound(sending.from) || !is_sound(sending.to) ||
            !is_within(sending.begin, 0, 1e7f) || !is_within(sending.end, sending.begin, 1e7f) ||
            (sending.speed != 0 && !is_within(sending.speed, 0.3f, 2)))
            return Error{
                "A sending is out of range: areas of one corner or at least three, finite, from 0 s or later "
                "to no earlier than that, groups of at least one, speed 0 or 0.3..2 m/s."};
    }
    if (people > k_most_sent) return Error{"The sendings send more than a million people: send fewer."};
    return {};
}

Result<void> check(const WorldOptions& o) {
    if (o.capacity > k_most_walkers || o.walkers > k_most_walkers)
        return Error{"There is room for a million walkers at most."};
    if (o.threads < 0 || o.threads > 1024) return Error{"WorldOptions::threads must be from 0 to 1024."};
    if (o.tasks.run && o.tasks.threads < 1) return Error{"TaskSystem::threads must be at least 1."};
    if (o.kinds.empty()) return Error{"There must be one kind of walkers at least."};
    for (size_t k = 0; k < o.kinds.size(); ++k) {
        const Kind& kind = o.kinds[k];
        bool sound = kind.share > 0 && std::isfinite(kind.share) && is_within(kind.age, 5, 100) &&
                     leg_length(kind.body) > 0.1f && thigh_length(kind.body) > 0.05f &&
                     shank_length(kind.body) > 0.05f;
        for (Vec3 joint : kind.body.joints) sound = sound && is_finite(joint);
        sound = sound && is_finite(kind.body.cane) && is_finite(kind.body.pram);
        const Girth& girth = kind.body.girth;
        for (float length : {kind.body.height, kind.body.heel, kind.body.toe, kind.body.carriage, girth.hip,
                             girth.belly, girth.back, girth.chest})
            sound = sound && std::isfinite(length);
        if (!sound)
            return Error{
                "Kind " + std::to_string(k) +
                " is out of range: share above 0, age 5..100, finite measures, legs longer than 0.1 m."};
    }
    const NavmeshSettings& n = o.navmesh;
    if (!is_within(n.cell, 0.02f, 2) || !is_within(n.cell_height, 0.01f, 1) || !is_within(n.tile, 8, 200) ||
        !is_within(n.agent_radius, 0, 2) || !is_within(n.agent_height, 0.5f, 4) ||
        !is_within(n.max_climb, 0, 1) || !is_within(n.max_slope_degrees, 0, 80))
        return Error{"A setting of the navigation mesh is out of range."};
    for (const Destination& d : o.destinations) {
        if (!is_finite(d.position) || !std::isfinite(d.facing.x) || !std::isfinite(d.facing.z) ||
            !std::isfinite(d.weight))
            return Error{"A destination has numbers that are not finite."};
        if (static_cast<int>(d.kind) >= k_destination_count)
            return Error{"A destination is of the kind " + std::to_string(static_cast<int>(d.kind)) +
                         ", which is none of DestinationKind."};
    }
    for (const Clip& clip : o.idles) {
        if (clip.joints != k_joint_count || clip.keys == 0 || clip.rows.empty())
            return Error{
                "An idle is no clip of the humanoid: make it by make_additive_clip(humanoid(body), ...)."};
    }
    for (const float share : o.leaving)
        if (!is_within(share, 0, 1)) return Error{"WorldOptions::leaving must be within 0 and 1."};
    if (Result<void> sound = check(o.sendings); !sound) return sound;
    if (!is_within(o.drunk, 0, 1)) return Error{"WorldOptions::drunk must be within 0 and 1."};
    if (o.drunks > o.walkers) return Error{"WorldOptions::drunks must be at most WorldOptions::walkers."};
    if (!is_within(o.helpers, 0, 1)) return Error{"WorldOptions::helpers must be within 0 and 1."};
    const AlongShares& along = o.along;
    for (const float share : {along.dogs, along.wheelchairs, along.white_canes, along.umbrellas})
        if (!is_within(share, 0, 1)) return Error{"Shares of WorldOptions::along must be within 0 and 1."};
    if (!is_within(o.jaywalkers, 0, 1)) return Error{"WorldOptions::jaywalkers must be within 0 and 1."};
    if (!is_within(o.acquaintances, 0, 1))
        return Error{"WorldOptions::acquaintances must be within 0 and 1."};
    float grouped = 0;
    for (const float share : o.groups) {
        if (!is_within(share, 0, 1)) return Error{"WorldOptions::groups must be within 0 and 1."};
        grouped += share;
    }
    if (grouped <= 0) return Error{"WorldOptions::groups must not all be 0."};
    for (const float share :
         {o.pastimes.sitting, o.pastimes.leaning, o.pastimes.phones, o.pastimes.windows, o.pastimes.queues})
        if (!is_within(share, 0, 1)) return Error{"WorldOptions::pastimes must be within 0 and 1."};
    if (!is_within(o.traffic, 0, 1)) return Error{"WorldOptions::traffic must be within 0 and 1."};
    for (const Crossing& c : o.crossings.all) {
        const bool sound = is_finite(c.centre) && std::isfinite(c.half_length) && c.half_length > 0 &&
                           std::isfinite(c.half_width) && c.half_width > 0 &&
                           std::fabs(cross(c.across, c.along)) > 0.1f &&
                           (!is_ruled(c) || c.plan < o.crossings.plans.size());
        if (!sound)
            return Error{"A crossing is out of range: finite measures above 0, a plan that is there."};
    }
    for (const LampPlan& plan : o.crossings.plans)
        if (plan.cycle == 0 ||
            std::max({plan.walk, plan.walk_ends, plan.drive, plan.drive_ends}) >= plan.cycle)
            return Error{"A plan of lamps is out of range: all its times must be below its cycle."};
    if (!is_within(o.hour, 0, 24)) return Error{"The hour must be within 0 and 24."};
    return {};
}

}  // namespace

void WorldDelete::operator()(World* world) const { delete world; }

static Result<WorldPtr> whole_world(std::shared_ptr<const Ground> ground, const WorldOptions& options) {
    auto made = make_world(std::move(ground), options);
    if (!made) return made.error();
    return WorldPtr(std::move(made).value().release());
}

Result<WorldPtr> make_world(const Triangles& triangles, const WorldOptions& options) {
    if (Result<void> sound = check(options); !sound) return sound.error();
    Result<Ground> ground = ground_of(triangles, options.navmesh.max_slope_degrees);
    if (!ground) return ground.error();
    return whole_world(std::make_shared<const Ground>(std::move(ground).value()), options);
}

Result<WorldPtr> make_world_on(const Ground& ground, const WorldOptions& options) {
    if (Result<void> sound = check(options); !sound) return sound.error();
    if (ground.triangle_grid.first.empty())
        return Error{"The ground is not indexed: call index_ground first."};
    return whole_world(std::make_shared<const Ground>(ground), options);
}

// Where a walker asked for stands, on the mesh; polygon 0: there is no room.
static NavPoint find_place(const World& w, const WalkerOptions& options, uint32_t slot, uint32_t generation) {
    auto fits = [&](NavPoint& p) {
        auto hit = ground_at(w.around, p.position, 1, 2);
        if (!hit) return false;
        p.position.y = hit->height;
        return has_room(w.crowd, p.position, options.radius);
    };
    if (options.place) {
        auto found = nearest(*w.navmesh, 0, *options.place, k_reach);
        return found && fits(*found) ? *found : NavPoint{};
    }
    constexpr uint32_t k_attempts = 64;
    for (uint32_t attempt = 0; attempt < k_attempts; ++attempt) {
        RandomKey key{w.seed, slot, generation * k_attempts + attempt, Purpose::spawn};
        NavPoint p =
            random_place(*w.navmesh, 0, random_unit(key, 0), random_unit(key, 1), random_unit(key, 2));
        if (fits(p)) return p;
    }
    return {};
}

Result<WalkerId> add_walker(World& w, const WalkerOptions& o) {
    if (is_on(w.traced)) return Error{"People here go where others were recorded: nobody else comes."};
    const CrowdSlots& slots = w.crowd.slots;
    if (slots.living.size() >= w.crowd.capacity)
        return Error{"The world is full with " + std::to_string(w.crowd.capacity) +
                     " walkers: remove some, or make it with a larger capacity."};
    if (o.kind && *o.kind >= w.kinds.size())
        return Error{"There is no kind " + std::to_string(*o.kind) + " of walkers."};
    if ((o.place && !is_finite(*o.place)) || !std::isfinite(o.heading) || !is_within(o.scale, 0.5f, 2) ||
        (o.speed && !is_within(*o.speed, 0.3f, 2)) || !is_within(o.radius, k_least_radius, k_widest_radius))
        return Error{
            "An option of the walker is out of range: a finite place and heading, scale 0.5..2, speed "
            "0.3..2 m/s, radius 0.1..0.5 m."};
    uint32_t slot = slots.left.empty() ? w.crowd.count : slots.left.back();
    uint32_t generation = slots.generation[slot];
    NavPoint place = find_place(w, o, slot, generation);
    if (place.polygon == 0) {
        if (!o.place) return Error{"There is no room for another walker; or none was found by chance."};
        return Error{"Nobody can be set down at " + at(*o.place) +
                     ": there is no walkable ground within 2 m, or somebody stands there."};
    }
    Walker walker = draw_walker(w.folk, {w.seed, slot, generation, Purpose::body});
    if (o.kind && *o.kind != walker.body) {
        const Folk one = w.folk[*o.kind];
        walker = draw_walker({&one, 1}, {w.seed, slot, generation, Purpose::body});
        walker.body = *o.kind;
    }
    walker.place = place;
    walker.heading = wrap_angle(o.heading);
    walker.scale = o.scale;
    if (o.speed) walker.preferred_speed = *o.speed;
    walker.radius = o.radius;
    walker.errand = o.wanders ? Errand::wander : Errand::arrive;
    uint32_t i = add_walker(w.crowd, w.around, walker);
    start_body(w, i);
    return w.crowd.slots.living.back();
}

bool is_alive(const World& w, WalkerId id) { return is_there(w.crowd, id); }

bool remove_walker(World& w, WalkerId id) {
    if (!is_alive(w, id)) return false;
    remove_walker(w.crowd, id.index);
    end_body(w, id.index);
    return true;
}

std::span<const WalkerId> walkers(const World& w) { return w.crowd.slots.living; }

static bool can_get_to(const World& w, uint32_t walker, uint32_t polygon) {
    return are_joined(*w.navmesh, w.crowd.motion.polygon[walker], polygon, by_of(w.crowd, walker));
}

Result<void> send_to(World& w, WalkerId id, Vec3 goal) {
    if (!is_alive(w, id)) return Error{"That walker is gone."};
    auto place = is_finite(goal) ? nearest(*w.navmesh, 0, goal, k_reach) : std::nullopt;
    if (!place) return Error{"There is no walkable ground within 2 m of " + at(goal) + "."};
    if (!can_get_to(w, id.index, place->polygon))
        return Error{"There is no way to " + at(goal) + " from where the walker is" +
                     (w.crowd.identity.ahead[id.index] > 0 ? " that a pram can take." : ".")};
    take_away(w.crowd.wayfarers, id.index);
    w.crowd.journeys[id.index].errand = Errand::arrive;
    send_to(w.crowd, id.index, *place);
    return {};
}

bool let_wander(World& w, WalkerId id) {
    if (!is_alive(w, id)) return false;
    take_away(w.crowd.wayfarers, id.index);
    turn_back(w.crowd, id.index);
    Journey& j = w.crowd.journeys[id.index];
    j.errand = Errand::wander;
    j.arrived = false;
    j.pause_until = 0;
    j.path_due = PathDue::to_new_goal;
    return true;
}

// Whether it can go by somebody, at a range of `least` to `most` metres.
static Result<void> check_way(const World& w, WalkerId id, const Wayfarer& way, float least, float most) {
    if (!is_alive(w, id)) return Error{"That walker is gone."};
    if (!is_alive(w, way.whom)) return Error{"The walker to go by is gone."};
    if (way.whom == id) return Error{"Nobody goes by himself."};
    if (is_within(way.range, least, most)) return {};
    char text[96];
    std::snprintf(text, sizeof text, "%g m is out of range: %g to %g m.", static_cast<double>(way.range),
                  static_cast<double>(least), static_cast<double>(most));
    return Error{text};
}

Result<void> let_follow(World& w, WalkerId id, WalkerId whom, float distance) {
    const Wayfarer way{.walker = id.index, .kind = Wayfarer::Kind::follow, .whom = whom, .range = distance};
    if (Result<void> can = check_way(w, id, way, 0.5f, 20); !can) return can;
    go_by_way(w.crowd, way);
    return {};
}

Result<void> let_lead(World& w, WalkerId id, WalkerId whom, Vec3 goal, float most) {
    const Wayfarer way{.walker = id.index, .kind = Wayfarer::Kind::lead, .whom = whom, .range = most};
    if (Result<void> can = check_way(w, id, way, 1, 50); !can) return can;
    if (Result<void> sent = send_to(w, id, goal); !sent) return sent;
    const NavPoint place = w.crowd.journeys[id.index].goal;
    go_by_way(w.crowd, way);
    send_to(w.crowd, id.index, place);
    return {};
}

Result<void> let_flee(World& w, WalkerId id, WalkerId whom, float range) {
    const Wayfarer way{
        .walker = id.index, .kind = Wayfarer::Kind::flee, .waits = 1, .whom = whom, .range = range};
    if (Result<void> can = check_way(w, id, way, 1, 100); !can) return can;
    go_by_way(w.crowd, way);
    return {};
}

bool let_ramble(World& w, WalkerId id) {
    if (!is_alive(w, id)) return false;
    go_by_way(w.crowd, {.walker = id.index, .kind = Wayfarer::Kind::ramble});
    return true;
}

// Whether the walker can go where it would on the platform: into each of its corners, as far as it turns
// there. Nearer to a sharp one the mesh, which keeps off the edges too, may have ended long before.
static Result<void> check_ground(const World& w, WalkerId id, const Platform& platform,
                                 std::span<const Vec2> corners, const Strider& who) {
    constexpr Vec3 k_near{0.5f, 5, 0.5f};  // metres
    const Crowd& c = w.crowd;
    const float height = c.motion.position[id.index].y;
    for (const Vec2 corner : corners) {
        const Vec3 place = at_height(*nearest_with_room(platform, corner, room_to_turn(who)), height);
        const auto found = nearest(*w.navmesh, 0, place, k_near);
        if (!found || !can_get_to(w, id.index, found->polygon))
            return Error{"The walker cannot get to all of the platform: not to " + at(place) + "."};
    }
    return {};
}

static Error too_narrow(const Strider& who, bool has_pram) {
    char text[160], how[32] = "with a pram";
    if (!has_pram) std::snprintf(how, sizeof how, "at %.1f m/s", static_cast<double>(who.speed));
    std::snprintf(text, sizeof text,
                  "The platform is too narrow to turn on %s: it must hold a circle %.1f m across.", how,
                  static_cast<double>(std::ceil(20 * room_to_turn(who)) / 10));
    return Error{text};
}

Result<void> let_stagger(World& w, WalkerId id, std::span<const Vec2> corners) {
    if (!is_alive(w, id)) return Error{"That walker is gone."};
    const Result<Platform> platform = make_platform(corners);
    if (!platform) return platform.error();
    Wayfarer way{.walker = id.index, .kind = Wayfarer::Kind::stagger, .platform = *platform};
    const Crowd& c = w.crowd;
    const Wayfarer* known = own_of(c.wayfarers, id.index);
    if (known && known->kind == way.kind) way.stride = known->stride;
    const Strider who = strider_of(c, id.index);
    if (!nearest_with_room(*platform, on_ground(c.motion.position[id.index]), room_to_turn(who)))
        return too_narrow(who, c.identity.ahead[id.index] > 0);
    if (Result<void> can = check_ground(w, id, *platform, corners, who); !can) return can;
    go_by_way(w.crowd, way);
    return {};
}

bool let_jump(World& w, WalkerId id) {
    if (!is_alive(w, id)) return false;
    jump(w.gait, id.index);
    return true;
}

bool push(World& w, WalkerId id, Vec2 impulse) {
    if (!is_alive(w, id) || w.roam || is_on(w.traced) || (w.stepping && w.stepping->bipeds.is_flat) ||
        is_creature(w.herd, id.index) || own_of(w.crowd.passages, id.index) ||
        w.crowd.identity.ahead[id.index] > 0 || stays_put(w.crowd, id.index))
        return false;
    push_walker(w, id.index, impulse / mass_of(person_of(w, id.index), id.index % k_block));
    return true;
}

bool has_fallen(const World& w, WalkerId id) { return is_alive(w, id) && is_down(w.crowd, id.index); }

bool has_arrived(const World& w, WalkerId id) {
    return is_alive(w, id) && w.crowd.journeys[id.index].errand != Errand::wander &&
           has_arrived(w.crowd, id.index);
}

void look_from(World& w, std::span<const Vec3> eyes, float reach) {
    w.crowd.onlookers.eyes.assign(eyes.begin(), eyes.end());
    w.crowd.onlookers.reach = reach;
}

std::optional<WalkerMotion> motion_of(const World& w, WalkerId id) {
    if (!is_alive(w, id)) return std::nullopt;
    const CrowdMotion& m = w.crowd.motion;
    const uint32_t i = id.index;
    const Passage* passage = passage_of(w.crowd, i);
    return WalkerMotion{m.position[i],
                        m.velocity[i],
                        m.heading[i],
                        w.crowd.identity.body[i],
                        w.crowd.identity.scale[i],
                        passage ? presence(*passage, 1) : 1};
}

ComingCount coming_count(const World& w) {
    const Coming& coming = w.coming;
    ComingCount count{coming.came, coming.left, waiting(coming), 0};
    for (const SentSoFar& sent : coming.so_far) count.lost += sent.lost;
    return count;
}

std::vector<SentCount> sent_counts(const World& w) {
    const Coming& coming = w.coming;
    std::vector<SentCount> counts;
    for (const SentSoFar& sent : coming.so_far)
        counts.push_back({.came = sent.came, .arrived = sent.arrived, .lost = sent.lost});
    for (const WalkerId id : w.crowd.slots.living)
        if (is_under_way(coming, w.crowd, id.index)) ++counts[coming.sending_of[id.index]].under_way;
    for (const Entrant& e : coming.sent.entrants) ++counts[e.sending].waiting;
    for (size_t s = 0; s < counts.size(); ++s)
        counts[s].later = coming.sendings[s].people - counts[s].came - counts[s].waiting - counts[s].lost;
    return counts;
}

bool pose_of(const World& w, WalkerId id, std::span<JointPose, k_joint_count> joints, float between) {
    if (!is_alive(w, id)) return false;
    for (size_t j = 0; j < joints.size(); ++j)
        joints[j] = joint_between(w, id.index, static_cast<Joint>(j), between);
    return true;
}

}  // namespace flaneur
