#include "sim/world.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "sim/alongside/alongside.h"
#include "sim/base/spans.h"
#include "sim/base/zone.h"
#include "sim/body/pace.h"
#include "sim/crowd/places.h"
#include "sim/gait/hands.h"
#include "sim/pastimes/pastimes.h"
#include "sim/pose/cane.h"
#include "sim/pose/pram.h"
#include "sim/stepping.h"

namespace flaneur {

// Of who pushes a pram: the share of others' speed, and the fastest, m/s.
static constexpr float k_pushing_pace = 0.93f, k_fastest_pushing = 1.45f;
static constexpr float k_pram_middle = 0.5f;  // metres from the handle

Personality personality_of(const World& world, uint32_t walker) {
    const Crowd& c = world.crowd;
    const Kind& kind = world.kinds[c.identity.body[walker]];
    return draw_personality(kind.age, kind.woman,
                            {world.seed, walker, c.slots.generation[walker], Purpose::personality});
}

float drunk_of(const World& world, uint32_t walker) {
    const bool is_at_first = walker < world.drunks && world.crowd.slots.generation[walker] == 0;
    return world.drunks == 0 || is_at_first ? world.drunk : 0;
}

Manner manner_of(const World& world, uint32_t walker) {
    const Crowd& c = world.crowd;
    const Kind& kind = world.kinds[c.identity.body[walker]];
    Manner middle = manner_at_age(kind.age);
    middle.postures = postures_at_age(kind.age, kind.woman);
    const uint32_t generation = c.slots.generation[walker];
    Manner manner = draw_manner(middle, {world.seed, walker, generation, Purpose::style});
    add_personality(manner, personality_of(world, walker));
    add_drink(manner, drunk_of(world, walker));
    if (is_on(world.traced)) {
        // Whether there are walls nobody knows, and where people stand close they keep their elbows in.
        manner.touches = 0;
        for (const Posture wide : {Posture::hip, Posture::hips})
            manner.postures[static_cast<size_t>(wide)] = 0;
    }
    return manner;
}

Result<std::unique_ptr<World>> make_world(std::shared_ptr<const Ground> ground, const WorldOptions& options,
                                          const std::function<bool(std::string_view, float)>& progress) {
    const int threads = options.tasks.run ? 1 : options.threads;  // none of our own beside somebody's
    auto mesh = build_navmesh(*ground, options.navmesh, threads, [&](float share) {
        return !progress || progress("building the navigation mesh", share);
    });
    if (!mesh) return mesh.error();
    return make_world(std::move(ground), std::move(mesh).value(), options, progress);
}

// As it is now, and as if it had been before.
static void pose_everybody(World& w) {
    pose_blocks(w.gait, 0, w.gait.blocks.size(), w.poses);
    hold_canes(w.gait, 0, w.gait.canes.size(), w.poses);
    hold_prams(w.gait, 0, w.gait.prams.size(), w.poses);
    w.previous_poses = w.poses;
    w.trails.assign(w.poses.size(), {});
    w.previous_trails = w.trails;
}

void make_room_to_come(World& w) {
    make_room(w.coming, w.crowd);
    if (!comes_and_goes(w.coming, w.crowd)) return;
    w.gait.canes.reserve(w.crowd.capacity);
    w.gait.prams.reserve(w.crowd.capacity);
    w.newcomer.canes.reserve(1);
    w.newcomer.prams.reserve(1);
}

// Where nobody stands within so many metres.
static bool is_free(const CrowdMotion& m, uint32_t count, uint32_t walker, Vec3 place) {
    constexpr float k_apart = 1.2f;
    for (uint32_t i = 0; i < count; ++i)
        if (i != walker && length(m.position[i] - place) < k_apart) return false;
    return true;
}

// Who staggers pushes no pram: is like the first who pushes none.
static void take_prams_from_drunks(World& w) {
    CrowdIdentity& who = w.crowd.identity;
    const auto plain = std::ranges::find(who.ahead, 0.0f);
    if (plain == who.ahead.end()) return;
    const auto from = static_cast<size_t>(plain - who.ahead.begin());
    for (uint32_t i = 0; i < w.drunks; ++i) {
        if (who.ahead[i] == 0) continue;
        auto copy = [&](auto&... rows) { ((rows[i] = rows[from]), ...); };
        copy(who.preferred_speed, who.radius, who.lateral, who.body, who.scale, who.stair_pace, who.ahead,
             who.room, who.patience, who.linger);
    }
}

// Those who stagger there alone begin on the platform, where there is room.
static void put_drunks_on_platform(World& w) {
    const Result<Platform> platform = make_platform(w.platform);
    if (!platform) return;         // let_stagger() says why
    constexpr float k_over = 100;  // metres
    constexpr uint32_t k_tries = 30;
    Vec2 low = w.platform[0], high = low;
    for (const Vec2 c : w.platform) {
        low = {std::min(low.x, c.x), std::min(low.z, c.z)};
        high = {std::max(high.x, c.x), std::max(high.z, c.z)};
    }
    CrowdMotion& m = w.crowd.motion;
    for (uint32_t i = 0; i < w.drunks; ++i)
        for (uint32_t t = 0; t < k_tries; ++t) {
            const RandomKey key{w.seed, i, t, Purpose::spawn};
            const auto at = nearest_with_room(
                *platform, {random_between(key, low.x, high.x, 6), random_between(key, low.z, high.z, 7)},
                room_to_turn(strider_of(w.crowd, i)));
            const auto hit = at ? ground_at(w.around, at_height(*at, k_over), 0, 2 * k_over) : std::nullopt;
            const auto place = hit ? nearest(*w.navmesh, 0, at_height(*at, hit->height)) : std::nullopt;
            if (!place || !is_free(m, w.crowd.count, i, place->position)) continue;
            m.position[i] = at_height(*at, hit->height);
            m.polygon[i] = place->polygon;
            m.under[i] = *hit;
            m.filed[i] = filed_at(m.position[i]);
            w.crowd.scratch.is_ordered = false;
            break;
        }
}

// By the habit of those who are set down at the start.
static Result<void> set_off(World& world) {
    const Crowd& c = world.crowd;
    auto id_of = [&](uint32_t i) { return WalkerId{i, c.slots.generation[i]}; };
    if (world.habit == Habit::ramble)
        for (uint32_t i = 0; i < c.count; ++i) let_ramble(world, id_of(i));
    const uint32_t count = world.habit == Habit::stagger ? c.count : std::min(world.drunks, c.count);
    if (count == 0) return {};
    // First who needs the most room to turn: a platform that is refused is told how wide it has to be for
    // all.
    auto room_of = [&](uint32_t i) { return room_to_turn(strider_of(c, i)); };
    uint32_t widest = 0;
    for (uint32_t i = 1; i < count; ++i)
        if (room_of(i) > room_of(widest)) widest = i;
    if (Result<void> can = let_stagger(world, id_of(widest), world.platform); !can) return can;
    for (uint32_t i = 0; i < count; ++i) {
        if (i == widest) continue;
        if (Result<void> can = let_stagger(world, id_of(i), world.platform); !can) return can;
    }
    return {};
}

Result<void> change_platform(World& w, const std::vector<Vec2>& corners) {
    std::vector<uint32_t> who;
    for (const Wayfarer& way : w.crowd.wayfarers)
        if (way.kind == Wayfarer::Kind::stagger) who.push_back(way.walker);
    // First who needs the most room, as above.
    std::ranges::stable_sort(who, [&](uint32_t a, uint32_t b) {
        return room_to_turn(strider_of(w.crowd, a)) > room_to_turn(strider_of(w.crowd, b));
    });
    for (const uint32_t i : who)
        if (Result<void> can = let_stagger(w, {i, w.crowd.slots.generation[i]}, corners); !can) return can;
    w.platform = corners;
    return {};
}

Result<std::unique_ptr<World>> make_world(std::shared_ptr<const Ground> ground, NavmeshPtr mesh,
                                          const WorldOptions& options,
                                          const std::function<bool(std::string_view, float)>& progress) {
    auto world = std::make_unique<World>();
    world->ground = std::move(ground);
    world->around = options.around.ground ? options.around : surroundings_of(*world->ground);
    world->navmesh = std::move(mesh);
    world->seed = options.seed;
    world->workers = options.tasks.run ? make_workers(options.tasks) : make_workers(options.threads);
    world->drive = drive_crowd;
    prepare_queries(*world->navmesh, thread_count(*world->workers));

    if (progress && !progress("setting down the walkers", 0))
        return Error{"the world of '" + world->ground->name + "' was given up"};
    world->kinds = options.kinds;
    world->habit = options.habit;
    world->platform = options.platform;
    world->drunk = options.drunk;
    world->drunks = options.drunks;
    world->pushes = options.pushes;
    world->balls.planned = options.throws;
    world->bystanders.helpers = options.helpers;
    world->jaywalkers = options.jaywalkers;
    std::vector<Body> bodies;
    for (const Kind& kind : options.kinds) {
        bodies.push_back(kind.body);
        float leg = leg_length(kind.body);
        Folk folk{kind.share, usual_speed(kind.age, kind.woman, leg), fastest_walk(leg), stair_pace(leg)};
        folk.age = kind.age, folk.woman = kind.woman;
        if (kind.body.pram != Vec3{}) {
            folk.speed *= k_pushing_pace;
            folk.most = std::min(folk.most, k_fastest_pushing);
            folk.ahead = kind.body.pram.z + k_pram_middle;
        }
        world->folk.push_back(folk);
    }
    auto crowd =
        populate(*world->ground, world->around, options.destinations, *world->navmesh, *world->workers,
                 options.walkers, world->folk, options.seed, options.hour, options.capacity, options.leaving);
    if (!crowd) return crowd.error();
    world->crowd = std::move(crowd).value();
    world->crowd.pass_on = options.pass_on;
    world->company.shares = options.groups;
    world->company.acquaintances = options.acquaintances;
    const bool is_any = has_groups(options.groups) || options.acquaintances > 0;
    if (is_any && options.habit == Habit::wander && options.drunks == 0)
        form_groups(world->company, world->crowd, world->around, *world->navmesh, world->folk, options.seed);
    take_prams_from_drunks(*world);
    put_drunks_on_platform(*world);
    mind_lamps(*world, options.crossings);
    world->pastimes = std::make_shared<Pastimes>();
    set_places(*world->pastimes, options.pastime_places, *world->navmesh, world->crowd);
    set_shares(*world->pastimes, options.pastimes, world->crowd);
    if (has_lanes(options.lanes))
        world->roads = std::make_shared<const RoadMap>(make_road_map(options.lanes, options.crossings));
    set_traffic(*world, options.traffic);
    world->coming.sendings = options.sendings;
    world->coming.home = find_neighbourhood(*world->ground, *world->navmesh, options.walkers);

    FLANEUR_ZONE("start bodies");
    RootMotion root{world->crowd.motion.position.data(), world->crowd.motion.velocity.data(),
                    world->crowd.motion.heading.data(), world->crowd.motion.turn_rate.data(),
                    world->crowd.motion.wish.data()};
    std::vector<Manner> manners;
    const CrowdIdentity& who = world->crowd.identity;
    for (uint32_t i = 0; i < world->crowd.count; ++i) manners.push_back(manner_of(*world, i));
    start_gait(world->gait, world->crowd.count, bodies, who.body.data(), who.scale.data(), root,
               world->around, world->seed, manners.data());
    reserve_gait(world->gait, world->crowd.capacity, bodies[0], world->seed);
    world->newcomer.blocks.resize(1);
    world->newcomer.people.resize(1);
    world->newcomer_pose.resize(1);
    make_room_to_come(*world);
    world->idles = make_layer(options.idles, world->crowd.capacity);
    world->poses.resize(world->gait.blocks.size());
    pose_everybody(*world);
    go_by_curves(*world, options.limbs, options.curves);
    if (Result<void> done = set_off(*world); !done) return done.error();
    if (!world->pushes.empty()) make_room_to_fall(*world, world->crowd.capacity);
    if (!world->balls.planned.empty()) make_room_for_balls(*world);
    let_go_along(*world, options.along);
    if (progress) progress("setting down the walkers", 1);
    return world;
}

static void start_feet(World& w, uint32_t walker) {
    const CrowdIdentity& who = w.crowd.identity;
    const Passage* passage = passage_by_door(w.crowd, walker);
    const Indoors indoors{w.around, passage ? passage->door : Door{}};
    start_walker(w.gait, walker, w.kinds[who.body[walker]].body, who.scale[walker],
                 w.crowd.motion.position[walker], w.crowd.motion.heading[walker],
                 passage ? surroundings_of(indoors) : w.around, w.seed, manner_of(w, walker));
}

static void teach_to_leap(World& w) {
    constexpr float k_middle = 0.55f;               // of the height
    constexpr float k_youngest = 6, k_oldest = 65;  // years
    for (uint32_t i = 0; i < w.crowd.count; ++i) {
        const Kind& kind = w.kinds[w.crowd.identity.body[i]];
        w.roam->walkers.middle[i] = k_middle * kind.body.height * w.crowd.identity.scale[i];
        const bool is_free = kind.body.cane == Vec3{} && kind.body.pram == Vec3{};
        w.roam->walkers.leaps_at_will[i] = is_free && kind.age >= k_youngest && kind.age < k_oldest;
    }
}

Result<void> set_down(World& world, Compound compound, uint32_t creatures, Gravity gravity) {
    auto roam = make_roam(std::move(compound), world.crowd, creatures, world.seed, std::move(gravity));
    if (!roam) return roam.error();
    world.roam = std::make_unique<Roam>(std::move(roam).value());
    teach_to_leap(world);
    world.linkages = make_bones(world.roam->creatures);
    world.drive = drive_roam;
    // On the mesh they have neither place nor goal any more: each walks at its middle, and is carried from
    // there.
    Crowd& crowd = world.crowd;
    end_company(world.company, crowd);
    for (uint32_t i = 0; i < crowd.count; ++i) {
        crowd.motion.position[i] = {0, crowd.motion.under[i].height, 0};
        crowd.motion.heading[i] = 0;
        crowd.journeys[i] = {};
        start_feet(world, i);
    }
    pose_everybody(world);
    return {};
}

// Poses the walker's block as it is now, and writes its lane alone.
static void pose_newcomer(World& w, uint32_t walker) {
    size_t block = walker / k_block, lane = walker % k_block;
    w.newcomer.blocks[0] = w.gait.blocks[block];
    w.newcomer.people[0] = w.gait.people[block];
    pose_blocks(w.newcomer, 0, 1, w.newcomer_pose);
    copy_own(w.gait.canes, walker, lane, w.newcomer.canes);
    hold_canes(w.newcomer, 0, w.newcomer.canes.size(), w.newcomer_pose);
    copy_own(w.gait.prams, walker, lane, w.newcomer.prams);
    hold_prams(w.newcomer, 0, w.newcomer.prams.size(), w.newcomer_pose);
    const auto* from = reinterpret_cast<const unsigned char*>(&w.newcomer_pose[0]);
    for (auto* poses : {&w.poses, &w.previous_poses}) {
        auto* to = reinterpret_cast<unsigned char*>(&(*poses)[block]);
        for (size_t row = 0; row < sizeof(PoseBlock) / (4 * k_block); ++row) {
            size_t at = (row * k_block + lane) * 4;
            std::memcpy(to + at, from + at, 4);
        }
    }
    for (auto* trails : {&w.trails, &w.previous_trails}) forget_trail(*trails, walker);
    forget_plays(w.idles, walker);
}

void start_body(World& w, uint32_t walker) {
    start_feet(w, walker);
    set_pace(w, walker);
    set_lamp_manner(w, walker);
    pose_newcomer(w, walker);
    join_along(w, walker);
}

void end_body(World& w, uint32_t walker) {
    forget_fall(w, walker);
    forget_bystander(w, walker);
    leave_along(w, walker);
    (void)take_away(w.pastimes->all, walker);
    end_walker(w.gait, walker, w.kinds[0].body, w.seed);
    pose_newcomer(w, walker);
}

// One afar has gone several ticks at once, and is shown where it would be by now.
static Vec3 ahead_of_time(const World& w, size_t walker, float between) {
    const size_t block = walker / k_block;
    const uint32_t at_once = w.crowd.at_once[block];
    if (at_once == 1) return {};
    const auto since = static_cast<float>(ticks_since_turn(block, w.tick - 1, at_once));
    return at_height(w.crowd.motion.velocity[walker], 0) *
           ((static_cast<float>(at_once) - since - between) * k_tick);
}

JointPose joint_between(const World& w, size_t walker, Joint joint, float between) {
    JointPose pose = joint_between(w.previous_poses, w.poses, walker, joint, between);
    pose.position = pose.position - ahead_of_time(w, walker, between);
    return pose;
}

std::optional<PramPlace> pram_between(const World& w, size_t walker, float between) {
    Span own = prams_of(w.gait, walker, walker + 1);
    if (own.begin == own.end) return std::nullopt;
    const Pram& pram = w.gait.prams[own.begin];
    if (w.crowd.at_once[walker / k_block] == 1) return mixed_place(pram.before, pram.now, between);
    PramPlace place = pram.now;
    place.place = place.place - ahead_of_time(w, walker, between);
    return place;
}

Trail trail_between(const World& w, size_t walker, float between) {
    return mixed_trail(trail_of(w.previous_trails, walker), trail_of(w.trails, walker), between);
}

void change_ground(World& w, std::shared_ptr<const Ground> ground, NavmeshPtr mesh,
                   std::span<const Destination> destinations, std::span<const Rectangle> changed) {
    assert(!w.roam);
    const bool answers_itself = w.around.asked == w.ground.get();
    prepare_queries(*mesh, thread_count(*w.workers));
    change_mesh(w.crowd, *w.navmesh, *mesh, changed, w.tick);
    change_mesh(w.coming, *mesh);
    w.crowd.demand = make_demand(destinations, ground->low, ground->high, *mesh, w.crowd.demand.hour,
                                 w.crowd.demand.leaving);
    w.navmesh = std::move(mesh);
    find_dogs_anew(w);
    w.ground = std::move(ground);
    if (minds_lamps(w.crowd.kerbs)) mind_lamps(w, Crossings(w.crowd.kerbs.map->crossings));
    if (answers_itself) w.around = surroundings_of(*w.ground);
    if (w.stepping) w.stepping->ground = w.ground, w.stepping->moving.ground = w.ground.get();
}

void make_room(World& w, uint32_t capacity) {
    if (capacity <= w.crowd.capacity) return;
    make_room(w.crowd, capacity);
    if (is_on(w.company)) make_room(w.company, w.crowd, capacity);
    const size_t before = w.gait.blocks.size();
    reserve_gait(w.gait, capacity, w.kinds[0].body, w.seed);
    w.idles.wanted.resize(capacity, k_no_clip);
    w.idles.playing.resize(capacity, 0);
    w.idles.stood.resize(capacity, 0);
    w.idles.plays.reserve(capacity);
    w.poses.resize(w.gait.blocks.size());
    pose_blocks(w.gait, before, w.gait.blocks.size(), w.poses);
    w.previous_poses.resize(w.poses.size());
    w.trails.resize(w.poses.size());
    w.previous_trails.resize(w.poses.size());
    for (size_t block = before; block < w.poses.size(); ++block) w.previous_poses[block] = w.poses[block];
    if (is_on(w.traced)) w.traced.way_of.resize(capacity);
    make_room_to_come(w);
    set_shares(*w.pastimes, PastimeShares(w.pastimes->shares), w.crowd);
    if (is_on(w.crowd.march)) go_by_curves(w, LimbLead::curves, w.crowd.march.how);
}

void set_lamp_manner(World& w, uint32_t walker) {
    Kerbs& kerbs = w.crowd.kerbs;
    if (!minds_lamps(kerbs)) return;
    kerbs.manners[walker] = lamp_manner(w.kinds[w.crowd.identity.body[walker]].age, drunk_of(w, walker),
                                        personality_of(w, walker).conscientiousness, w.jaywalkers);
    if (is_creature(w.herd, walker)) kerbs.manners[walker].jaywalks = 0;
}

void set_traffic(World& w, float traffic) {
    make_vehicles(w.vehicles, w.crowd, traffic > 0 ? w.roads : nullptr, traffic, w.seed);
}

void set_jaywalkers(World& w, float share) {
    w.jaywalkers = share;
    for (const WalkerId id : w.crowd.slots.living) set_lamp_manner(w, id.index);
}

void mind_lamps(World& w, const Crossings& crossings) {
    const bool is_any = std::ranges::any_of(crossings.all, is_ruled);
    const auto map = is_any ? std::make_shared<const KerbMap>(make_kerb_map(crossings, *w.navmesh)) : nullptr;
    mind_lamps(w.crowd.kerbs, map, w.crowd.capacity);
    for (const WalkerId id : w.crowd.slots.living) set_lamp_manner(w, id.index);
}

void set_drunk(World& w, float drunk) {
    w.drunk = drunk;
    for (const WalkerId id : w.crowd.slots.living) {
        const uint32_t i = id.index, kind = w.crowd.identity.body[i];
        change_manner(w.gait, i, w.kinds[kind].body, w.crowd.identity.scale[i], manner_of(w, i));
        set_lamp_manner(w, i);
        if (companion_of(w, i)) join_along(w, i);  // whose hands stay full
    }
}

void set_pace(World& w, uint32_t walker) {
    March& march = w.crowd.march;
    if (!is_on(march)) return;
    const float leg = person_of(w, walker).joints[left_upper_leg][1][walker % k_block];
    march.pace[walker] = pace_of(march.how, leg);
}

void go_by_curves(World& w, LimbLead limbs, const LimbCurves& how) {
    March& march = w.crowd.march;
    march.how = how;
    const uint32_t slots = limbs == LimbLead::curves ? w.crowd.capacity : 0;
    march.pace.resize(slots);
    march.turns.resize(slots);
    for (uint32_t i = 0; i < slots; ++i) set_pace(w, i);
}

static float passed_hours(const World& w) { return static_cast<float>(w.tick) * (k_tick / 3600); }

static float within_a_day(float hour) { return hour - 24 * std::floor(hour / 24); }

float hour_now(const World& w) { return within_a_day(w.crowd.demand.hour + passed_hours(w)); }

void set_hour(World& w, float hour) { w.crowd.demand.hour = within_a_day(hour - passed_hours(w)); }

}  // namespace flaneur
