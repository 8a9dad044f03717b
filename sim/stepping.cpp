#include "sim/stepping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <string>
#include <utility>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/base/zone.h"
#include "sim/crowd/places.h"

namespace flaneur {

namespace {

// Of the biped's walker.
bool is_led_by(const World& w, size_t biped) { return is_led(w.crowd, w.stepping->bipeds.walkers[biped]); }

// Which of them is the walker.
size_t biped_of(const Bipeds& bipeds, uint32_t walker) {
    return static_cast<size_t>(std::ranges::lower_bound(bipeds.walkers, walker) - bipeds.walkers.begin());
}

// The crowd learns where they are.
void tell_crowd(World& w) {
    const Bipeds& bipeds = w.stepping->bipeds;
    CrowdMotion& m = w.crowd.motion;
    for (size_t n = 0; n < bipeds.all.size(); ++n) {
        const Biped& b = bipeds.all[n];
        const uint32_t i = bipeds.walkers[n];
        if (b.is_down != 0 || !is_led_by(w, n)) continue;
        const Vec3 now = at_height(b.body, w.gait.blocks[i / k_block].base[i % k_block]);
        if (!w.stepping->is_everybody)
            m.polygon[i] = move_along(*w.navmesh, 0, {m.position[i], m.polygon[i]}, now, By::feet).polygon;
        m.position[i] = now;
        m.velocity[i] = b.velocity;
        m.wish[i] = b.ahead * b.speed;
        m.heading[i] = b.heading;
        m.turn_rate[i] = b.turn_rate;
    }
}

// Who fell lies there, and goes on when it is up; others are where the crowd has shifted them.
void ask_crowd(World& w) {
    Stepping& s = *w.stepping;
    for (size_t n = 0; n < s.bipeds.all.size(); ++n) {
        Biped& b = s.bipeds.all[n];
        const uint32_t i = s.bipeds.walkers[n];
        if (!is_led_by(w, n)) {
            b.is_down = 1;  // it goes as one of the crowd
        } else if (is_down(w.crowd, i)) {
            b.is_down = 1;
            b.body = b.point = on_ground(w.crowd.motion.position[i]);
        } else if (b.is_down != 0) {
            go_on_standing(s.bipeds, n, on_ground(w.crowd.motion.position[i]), w.crowd.motion.heading[i],
                           s.moving, w.gait, w.tick);
        } else {
            const Vec2 shift = on_ground(w.crowd.motion.position[i]) - b.body;
            b.body += shift;
            b.point += shift;
        }
    }
}

// What somebody is to one who steps: disks, from the place of its point.
struct InTheWay {
    std::array<Vec2, 64> at;
    std::array<float, 64> radius;
    size_t count = 0;
};
InTheWay in_the_way(const World& w, const Biped& b, uint32_t walker) {
    constexpr float k_sees = 4;  // metres
    const CrowdMotion& m = w.crowd.motion;
    InTheWay found;
    auto add = [&](Vec2 off, float radius) {
        if (found.count == found.at.size()) return;
        found.at[found.count] = off;
        found.radius[found.count++] = radius;
    };
    std::array<uint32_t, 64> near;
    const size_t count = those_near(w, m.position[walker], k_sees, near);
    for (const uint32_t i : std::span(near).first(count)) {
        if (i == walker || std::fabs(m.position[i].y - m.position[walker].y) > k_other_level) continue;
        const Vec2 off = on_ground(m.position[i]) - b.point;
        const Downed* down = own_of(w.crowd.downed, i);
        if (!down) {
            add(off, w.crowd.identity.radius[i]);
            continue;
        }
        for (const LyingPart& part : down->parts)
            if (part.radius > 0) add(off + part.from, part.radius + k_off_who_lies);
    }
    return found;
}

// Metres that one can go on, so far to the left, before it comes to somebody.
float room_ahead(const InTheWay& others, const Biped& b, float own, float left) {
    constexpr float k_beside = 0.16f, k_at_once = 0.25f;  // metres
    const Vec2 beside = Vec2{b.ahead.z, -b.ahead.x} * left;
    float least = k_all_room;
    for (size_t k = 0; k < others.count; ++k) {
        const Vec2 off = others.at[k] - beside;
        const float along = dot(off, b.ahead), away = own + others.radius[k];
        if (along > 0 && std::fabs(cross(b.ahead, off)) < away + k_beside)
            least = std::min(least, along - others.radius[k]);
        // Whoever is at its side or before its body already.
        const Vec2 from_body = others.at[k] + b.point - b.body;
        if (left == 0 && length(from_body) < away + k_at_once && dot(from_body, b.ahead) > 0.3f * away)
            least = 0;
    }
    return least;
}

// How far to the left it goes on best, among others and on the mesh; it keeps to what it does.
void find_room(World& w, size_t biped) {
    constexpr float k_worth = 2.5f, k_turning = 0.6f, k_off = 0.25f;  // metres; metres for each metre aside
    Stepping& s = *w.stepping;
    const Biped& b = s.bipeds.all[biped];
    const uint32_t walker = s.bipeds.walkers[biped];
    const CrowdMotion& m = w.crowd.motion;
    const InTheWay others = in_the_way(w, b, walker);
    const float own = w.crowd.identity.radius[walker];
    s.bipeds.room[biped] = room_ahead(others, b, own, 0);
    if (s.is_everybody) return;
    float best = -1e9f;
    const WayPoint way = point_on(s.bipeds.ways[b.way], b.along);
    const Vec3 here = at_height(way.place, m.position[walker].y);
    for (const float aside : {0.0f, 0.35f, -0.35f, 0.7f, -0.7f}) {
        if (aside != 0 &&
            !is_clear(*w.navmesh, here, here + at_height(Vec2{way.ahead.z, -way.ahead.x} * aside, 0)))
            continue;
        const float room = std::min(room_ahead(others, b, own, aside - b.aside), k_worth);
        const float good = room - k_turning * std::fabs(aside - b.aside) - k_off * std::fabs(aside);
        if (good > best) best = good, s.bipeds.aside[biped] = aside;
    }
}

Result<void> set_on_ways(World& w, StepCourse course, std::vector<uint32_t> who) {
    constexpr float k_careful = 0.8f;  // of the speed that one prefers
    auto stepping = std::make_shared<Stepping>();
    stepping->ground = std::move(course.ground);
    stepping->moving = {stepping->ground.get(), &w.movers};
    stepping->ways = course.ways;
    stepping->is_everybody = who.size() == w.crowd.count;
    std::vector<BipedWay> ways;
    ways.reserve(course.ways.size());
    for (std::vector<Vec2>& line : course.ways) ways.push_back(make_way(std::move(line)));
    std::vector<float> likes;
    likes.reserve(who.size());
    for (const uint32_t i : who) likes.push_back(k_careful * w.crowd.identity.preferred_speed[i]);
    std::vector<Vec2> others;
    for (const WalkerId id : w.crowd.slots.living)
        if (!std::ranges::binary_search(who, id.index))
            others.push_back(on_ground(w.crowd.motion.position[id.index]));
    SetDown made =
        make_bipeds(std::move(ways), who, likes, course.is_flat, stepping->moving, w.gait, w.seed, others);
    if (made.placed < likes.size())
        return Error{"Only " + std::to_string(made.placed) + " of " + std::to_string(likes.size()) +
                     " walkers find room on the " + (stepping->is_everybody ? "course" : "way") +
                     "; ask for fewer."};
    stepping->bipeds = std::move(made.bipeds);
    w.stepping = std::move(stepping);
    for (const uint32_t i : who) go_by_way(w.crowd, {.walker = i, .kind = Wayfarer::Kind::is_led});
    tell_crowd(w);
    return {};
}

}  // namespace

Result<void> set_on_course(World& w, StepCourse course) {
    w.movers = make_movers(std::move(course.movers));
    std::vector<uint32_t> everybody(w.crowd.count);
    std::iota(everybody.begin(), everybody.end(), 0u);
    if (Result<void> set = set_on_ways(w, std::move(course), std::move(everybody)); !set) return set;
    w.around = surroundings_of(w.stepping->moving);
    pose_blocks(w.gait, 0, w.gait.blocks.size(), w.poses);
    w.previous_poses = w.poses;
    w.trails.assign(w.poses.size(), {});
    w.previous_trails = w.trails;
    return {};
}

Result<void> let_step(World& w, uint32_t count, std::vector<std::vector<Vec2>> ways) {
    constexpr float k_grown = 10;  // years
    std::vector<uint32_t> who;
    for (uint32_t i = w.drunks; i < w.crowd.count && who.size() < count; ++i) {
        const bool has_things = own_of(w.gait.canes, i) || own_of(w.gait.prams, i);
        if (is_there(w.crowd, i) && !has_things && w.kinds[w.crowd.identity.body[i]].age >= k_grown &&
            w.crowd.journeys[i].errand != Errand::by_way && !is_creature(w.herd, i))
            who.push_back(i);
    }
    if (who.empty()) return {};
    StepCourse course;
    course.ground = w.ground;
    course.ways = std::move(ways);
    return set_on_ways(w, std::move(course), std::move(who));
}

StepCourse course_of(const World& w) {
    return {w.stepping->ground, w.movers.all, w.stepping->ways, w.stepping->bipeds.is_flat};
}

void step_those_who_step(World& w) {
    FLANEUR_ZONE("gait", w.stage_ms[static_cast<size_t>(Stage::gait)]);
    Stepping& s = *w.stepping;
    s.bipeds.orders = s.orders[0];
    ask_crowd(w);
    const Driven& driven = w.crowd.driven;
    const bool is_alone = s.is_everybody && w.crowd.downed.empty();
    for (size_t n = 0; n < s.bipeds.all.size(); ++n) {
        if (s.bipeds.walkers[n] == driven.walker) {
            s.bipeds.orders.driven = static_cast<uint32_t>(n);
            s.bipeds.orders.wish = driven.wish;
        }
        s.bipeds.room[n] = k_all_room;
        if (!is_alone && s.bipeds.all[n].is_down == 0) find_room(w, n);
    }
    step_bipeds(s.bipeds, s.moving, w.gait, *w.workers, w.seed, w.tick);
    tell_crowd(w);
}

bool is_stepping(const World& w, uint32_t walker) { return w.stepping && is_led(w.crowd, walker); }

void shove(World& w, uint32_t walker, Vec2 change) {
    Bipeds& bipeds = w.stepping->bipeds;
    shove(bipeds, biped_of(bipeds, walker), change, w.gait);
}

bool can_fall(const World& w, uint32_t walker) {
    // Metres up and down for each metre away, and at once.
    constexpr float k_steep = 0.5f, k_drops = 0.3f, k_tread = 0.2f;
    if (!is_on_course(w)) return true;  // the mesh holds it
    const Vec3 at = w.crowd.motion.position[walker];
    if (mover_below(w.movers, at, 0.3f, 0.3f)) return false;
    for (const float away : {0.35f, 0.7f, 1.1f, 1.5f})
        for (int k = 0; k < 8; ++k) {
            const Vec2 way = heading_direction(k_pi / 4 * static_cast<float>(k)) * away;
            const auto hit = ground_at(*w.stepping->ground, at + at_height(way, 0), 1, 1);
            if (!hit || !is_walked(hit->kind) || hit->height > at.y + k_tread + k_steep * away ||
                hit->height < at.y - k_tread - k_drops * away)
                return false;
        }
    return true;
}

bool is_by_way(const World& w, uint32_t walker, Vec3 place) {
    constexpr float k_beside = 0.6f;  // metres
    const Bipeds& bipeds = w.stepping->bipeds;
    const BipedWay& way = bipeds.ways[bipeds.all[biped_of(bipeds, walker)].way];
    auto off = [&](Vec3 at) {
        return length(point_on(way, nearest_along(way, on_ground(at))).place - on_ground(at));
    };
    return off(place) <= std::max(k_beside, off(w.crowd.motion.position[walker]));
}

void look_at(World& w, std::optional<Vec3> place) {
    BipedOrders& orders = w.stepping->orders[0];
    orders.looks = place.has_value();
    orders.looked_at = place.value_or(Vec3{});
}

void go_to(World& w, std::optional<Vec3> goal) {
    BipedOrders& orders = w.stepping->orders[0];
    orders.has_goal = goal.has_value();
    orders.goal = goal.value_or(Vec3{});
}

uint64_t hash_bipeds(const Stepping& s) {
    static_assert(sizeof(Biped) % 4 == 0);
    const std::vector<Biped>& all = s.bipeds.all;
    return hash_bytes(hash_bytes(1, all.data(), all.size() * sizeof all[0]), s.orders.data(),
                      sizeof s.orders);
}

}  // namespace flaneur
