#include "sim/coming/passages.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/crowd/places.h"

namespace flaneur {

static constexpr float k_apart = 3;            // metres between two doors that are used at a time
static constexpr float k_farthest = 1.8f;      // metres before a door from where one goes through it, at most
static constexpr float k_aside = 0.6f;         // and to its side;
static constexpr float k_steepest = 0.75f;     // nearer to it, less: metres to its side for one before it
static constexpr float k_turned = 0.4f;        // radians from the way in, at most
static constexpr uint32_t k_held_up = 8 * 60;  // ticks on the way to a door, after which one lets go of it

using Kind = Passage::Kind;

static void set_passage(Crowd& c, const Passage& passage) {
    c.passages.insert(take_away(c.passages, passage.walker), passage);
}

// Others make way for one who goes through a door, since it cannot step aside there.
static void insist(Crowd& c, uint32_t i, uint32_t tick) {
    c.journeys[i].insists_since = tick;
    c.journeys[i].insists_from = on_ground(c.motion.position[i]);
}

void come_by_door(Crowd& c, uint32_t i, const Door& door, uint32_t tick) {
    Vec3& place = c.motion.position[i];
    c.way_back[i] = {place, c.motion.polygon[i]};
    place = door.at + at_height(door.way * k_door_depth, 0);
    c.motion.filed[i] = filed_at(place);
    c.scratch.is_ordered = false;
    set_passage(c, {i, Kind::in, k_shown, door});
    insist(c, i, tick);
}

void appear(Crowd& c, uint32_t i) { set_passage(c, {i, Kind::appear, 0, {}}); }

bool is_in_use(const Crowd& c, const Door& door) {
    return std::ranges::any_of(
        c.passages, [&](const Passage& p) { return is_by_door(p) && length(p.door.at - door.at) < k_apart; });
}

// Whether there is another try to get before the door.
static bool tries_again(Journey& j, uint32_t tick) {
    if (--j.door_tries == 0) return false;
    j.arrived = false;
    j.path_due = PathDue::to_goal;
    j.closest_tick = tick;
    return true;
}

// Who is to go straight through a door, but for others does not get into the doorway, is not in line before
// it any more, where one neither steps aside nor back: it may stand in the way of those who hold it up.
static void let_go_if_held_up(Crowd& c, uint32_t i, const Door& door, uint32_t tick) {
    Journey& j = c.journeys[i];
    if (tick - j.insists_since <= k_held_up || is_within(door, c.motion.position[i])) return;
    turn_back(c, i);
    tries_again(j, tick);
}

// Whether it has been brought to leave by the door that it faces, or to wait for that.
static bool leave_by_door(Crowd& c, const Surroundings& around, uint32_t i, uint32_t tick) {
    Journey& j = c.journeys[i];
    const auto door = door_at(around, j.goal.position, j.facing);
    if (!door) return false;
    const Vec2 here = on_ground(c.motion.position[i]);
    const float before = -depth_in(*door, here), aside = std::fabs(aside_in(*door, here));
    if (before > k_farthest || aside > std::min(k_steepest * before, k_aside)) return tries_again(j, tick);
    j.facing = door->way;  // square to the wall, whatever the door is said to face
    if (is_in_use(c, *door) ||
        std::fabs(wrap_angle(heading_of(door->way) - c.motion.heading[i])) > k_turned) {
        j.pause_until = tick + k_decision_ticks;
        return true;
    }
    c.way_back[i] = {c.motion.position[i], c.motion.polygon[i]};
    set_passage(c, {i, Kind::out, k_shown, *door});
    insist(c, i, tick);
    return true;
}

bool has_left(Crowd& c, const Surroundings& around, uint32_t i, uint32_t tick) {
    const Passage* p = passage_of(c, i);
    if (p && p->kind == Kind::vanish) return p->shown == 0;
    if (p && p->kind == Kind::out) {
        if (depth_in(p->door, on_ground(c.motion.position[i])) >= k_door_depth) return true;
        let_go_if_held_up(c, i, p->door, tick);
    }
    if (p) return false;
    if (c.journeys[i].door_tries == 0 || !leave_by_door(c, around, i, tick))
        set_passage(c, {i, Kind::vanish, k_shown, {}});
    return false;
}

void step_passages(Crowd& c) {
    for (Passage& p : c.passages) {
        if (p.kind == Kind::appear) ++p.shown;
        if (p.kind == Kind::vanish && p.shown > 0) --p.shown;
    }
    // The mesh may be another one by now, and end before the door or go on behind it.
    std::erase_if(c.passages, [&](const Passage& p) {
        if (p.kind == Kind::appear) return p.shown >= k_shown;
        if (p.kind == Kind::vanish) return false;
        if (c.way_back[p.walker].polygon &&
            depth_in(p.door, on_ground(c.motion.position[p.walker])) >= -k_farthest)
            return false;
        c.journeys[p.walker].insists_since = k_never;
        return true;
    });
}

float presence(const Passage& p, float between) {
    if (is_by_door(p)) return 1;
    const float last = static_cast<float>(p.shown), before = p.kind == Kind::appear ? last - 1 : last + 1;
    return clamp(lerp(before, last, between) / k_shown, 0, 1);
}

}  // namespace flaneur
