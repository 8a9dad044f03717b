// What becomes of everybody when the mesh is exchanged for another under their feet.
#include <algorithm>

#include "sim/crowd/crowd.h"

namespace flaneur {

static constexpr float k_on_it = 0.01f;     // metres beside the mesh that are rounding
static constexpr float k_beside = 1.0f;     // metres that a path passes a change by and is sought again
static constexpr float k_goal_near = 3.0f;  // metres that a goal may move

// The nearest place of the mesh, looked for ever farther out.
static std::optional<NavPoint> nearest_at_all(const Navmesh& mesh, Vec3 p) {
    for (float reach : {0.5f, 2.0f, 8.0f, 40.0f})
        if (auto found = nearest(mesh, 0, p, {reach, std::max(reach * 0.5f, 1.5f), reach})) return found;
    return std::nullopt;
}

static bool crosses(Vec2 a, Vec2 b, const Rectangle& area) {
    float enter = 0, leave = 1;
    auto clip = [&](float from, float way, float low, float high) {
        if (std::fabs(way) < 1e-9f) {
            if (from < low || from > high) leave = -1;
            return;
        }
        const float t0 = (low - from) / way, t1 = (high - from) / way;
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
    };
    clip(a.x, b.x - a.x, area.low.x, area.high.x);
    clip(a.z, b.z - a.z, area.low.z, area.high.z);
    return enter <= leave;
}

static bool path_crosses(const Crowd& c, uint32_t i, std::span<const Rectangle> changed) {
    const Journey& j = c.journeys[i];
    Vec2 from = on_ground(c.motion.position[i]);
    for (int k = j.corner; k < j.corner_count; ++k) {
        const Vec2 to = on_ground(c.corners[size_t{i} * k_corners + static_cast<size_t>(k)]);
        for (const Rectangle& area : changed)
            if (crosses(from, to, widened(area, k_beside))) return true;
        from = to;
    }
    return false;
}

// Stands on the other mesh now; or walks back to it, if it has gone from under the feet.
static void set_foot(Crowd& c, const NavmeshPassage& p, const Navmesh& mesh, uint32_t i, uint32_t tick) {
    const bool was_beside = c.way_back[i].polygon != 0;
    const uint32_t same = passed(p, c.motion.polygon[i]);
    c.motion.polygon[i] = same;
    if (same && !was_beside) return;
    c.way_back[i] = {};
    const Vec3 at = c.motion.position[i];
    const auto place = nearest_at_all(mesh, at);
    if (!place) return;
    c.motion.polygon[i] = place->polygon;
    if (length(on_ground(place->position - at)) <= k_on_it) return;
    c.way_back[i] = *place;
    // Others make way.
    c.journeys[i].insists_since = tick;
    c.journeys[i].insists_from = on_ground(at);
}

static void look_again(Crowd& c, const NavmeshPassage& p, const Navmesh& mesh,
                       std::span<const Rectangle> changed, uint32_t i, uint32_t tick) {
    Journey& j = c.journeys[i];
    const uint32_t same = passed(p, j.goal.polygon);
    bool is_lost = false, has_moved = false;
    if (same) {
        j.goal.polygon = same;
    } else {
        const auto place = nearest(mesh, 0, j.goal.position, {k_goal_near, 1.5f, k_goal_near});
        is_lost = !place;
        has_moved = place && length(on_ground(place->position - j.goal.position)) > k_on_it;
        j.goal = place ? *place : NavPoint{c.motion.position[i], c.motion.polygon[i]};
    }
    const bool is_cut_off = !are_joined(mesh, c.motion.polygon[i], j.goal.polygon, by_of(c, i));
    if (j.path_due == PathDue::to_new_goal) return;
    const bool goes = j.corner < j.corner_count;
    if (j.errand == Errand::wander && (is_lost || is_cut_off) && goes) {
        j.path_due = PathDue::to_new_goal;
    } else if (goes && (has_moved || is_cut_off || path_crosses(c, i, changed))) {
        j.path_due = PathDue::to_goal;
    } else {
        return;
    }
    j.stuck = 0;
    j.closest_tick = tick;
}

void change_mesh(Crowd& c, const Navmesh& from, const Navmesh& to, std::span<const Rectangle> changed,
                 uint32_t tick) {
    c.traffic = make_traffic(to);
    const NavmeshPassage p = passage(from, to);
    for (uint32_t i = 0; i < c.count; ++i) {
        if (!is_there(c, i)) continue;
        set_foot(c, p, to, i, tick);
        look_again(c, p, to, changed, i, tick);
    }
}

void make_room(Crowd& c, uint32_t capacity) {
    if (capacity <= c.capacity) return;
    Crowd wider = make_crowd(capacity);
    auto keep = [](auto& to, auto& from) { std::copy(from.begin(), from.end(), to.begin()); };
    auto keep_all = [&](auto& to, auto& from, auto... arrays) { (keep(to.*arrays, from.*arrays), ...); };
    using Who = CrowdIdentity;
    keep_all(wider.identity, c.identity, &Who::preferred_speed, &Who::radius, &Who::lateral, &Who::body,
             &Who::scale, &Who::stair_pace, &Who::ahead, &Who::room, &Who::patience, &Who::linger);
    using Move = CrowdMotion;
    keep_all(wider.motion, c.motion, &Move::position, &Move::velocity, &Move::wish, &Move::heading,
             &Move::turn_rate, &Move::feet, &Move::brakes, &Move::polygon, &Move::under, &Move::filed);
    using Mind = CrowdDecision;
    keep_all(wider.decision, c.decision, &Mind::wanted, &Mind::course, &Mind::aim, &Mind::looks,
             &Mind::chosen, &Mind::claim);
    keep_all(wider, c, &Crowd::journeys, &Crowd::corners, &Crowd::way_back);
    keep(wider.slots.place, c.slots.place);
    keep(wider.slots.generation, c.slots.generation);
    wider.slots.living.insert(wider.slots.living.end(), c.slots.living.begin(), c.slots.living.end());
    wider.slots.left.insert(wider.slots.left.end(), c.slots.left.begin(), c.slots.left.end());
    wider.count = c.count;
    wider.widest = c.widest;
    wider.next_path = c.next_path;
    wider.demand = std::move(c.demand);
    wider.traffic = std::move(c.traffic);
    wider.fellows = std::move(c.fellows);
    wider.driven = c.driven;
    mind_lamps(wider.kerbs, c.kerbs.map, capacity);
    keep_all(wider.kerbs, c.kerbs, &Kerbs::waits, &Kerbs::manners);
    wider.roadway = std::move(c.roadway);
    wider.downed = c.downed;
    wider.called = c.called;
    wider.beside = c.beside;
    wider.march = std::move(c.march);
    wider.pass_on = c.pass_on;
    wider.onlookers = std::move(c.onlookers);
    keep(wider.at_once, c.at_once);
    wider.wayfarers = std::move(c.wayfarers);
    wider.leads = c.leads;
    wider.passages.insert(wider.passages.end(), c.passages.begin(), c.passages.end());
    c = std::move(wider);
}

}  // namespace flaneur
