// Who may enter a junction. A curve through it is held by those who are on it and by one who was let in; as
// long as it is, nobody is let onto what crosses it. Of two who come, the one from the main road goes first,
// then who does not turn across the other, then who comes from the right (or left, where one drives left);
// but who has waited long is not kept any more. Nobody is let in for whom there is no room beyond, so that
// what has entered always gets out.
#include <algorithm>
#include <cmath>

#include "sim/base/tick.h"
#include "sim/vehicles/drive.h"

namespace flaneur {

namespace {

constexpr float k_kept = 8;       // seconds that one who stands lets others go first
constexpr float k_soon = 4.5f;    // seconds from a junction within which one is let go first
constexpr float k_beyond = 1.5f;  // metres more than it is long that are free beyond
constexpr float k_flows = 4;      // m/s of the last one beyond, who makes room
constexpr float k_turns = 0.6f;   // radians

// Metres to where it waits before what it wants to enter.
float to_line(const Lanes& lanes, const Vehicle& v) {
    float base = -v.metres;
    for (int k = k_here; k + 1 < k_route && v.route[k] != k_no_lane; ++k) {
        if (v.route[k + 1] == v.wants) return base + lanes.all[v.route[k]].stop;
        base += lanes.all[v.route[k]].length;
    }
    return 1e9f;
}

Vec2 comes_along(const Lanes& lanes, uint32_t curve) { return on_lane(lanes, curve, 0).along; }

// Whether `other`, on a curve that crosses, goes before the one on `mine`.
bool goes_first(const Lanes& lanes, uint32_t other, uint32_t mine) {
    const Lane &a = lanes.all[other], &b = lanes.all[mine];
    if (a.rank != b.rank) return a.rank > b.rank;
    const float across = lanes.drives_left ? -1.0f : 1.0f;
    const bool mine_turns = b.turn * across > k_turns, other_turns = a.turn * across > k_turns;
    const Vec2 my_way = comes_along(lanes, mine), other_way = comes_along(lanes, other);
    const bool is_oncoming = dot(my_way, other_way) < -0.5f;
    if (is_oncoming) return mine_turns && !other_turns;
    // One who comes from the right goes to the left of the way ahead.
    return cross(my_way, other_way) * across < 0;
}

bool has_room_beyond(const Vehicles& vs, const Vehicle& v) {
    const Lanes& lanes = vs.map->lanes;
    const float needs = shape_of(v).length + k_beyond;
    const auto* at = std::find(std::begin(v.route) + k_here, std::end(v.route), v.wants);
    float room = 0;
    // Those who are on the curve already go there too.
    if (vs.held[v.wants] > 0) room -= static_cast<float>(vs.held[v.wants]) * needs;
    for (++at; at < std::end(v.route) && *at != k_no_lane && room < needs; ++at) {
        const bool is_whole = vs.free[*at] >= lanes.all[*at].length;
        room += vs.free[*at];
        if (lanes.all[*at].is_gate_out && is_whole) return true;
        if (!is_whole) break;
    }
    return room >= needs;
}

bool must_wait(const Vehicles& vs, uint32_t number, float waited) {
    const Lanes& lanes = vs.map->lanes;
    const Vehicle& v = vs.all[number];
    const auto conflicts = conflicts_of(lanes, lanes.all[v.wants]);
    for (const uint32_t curve : conflicts)
        if (vs.held[curve] > 0) return true;
    if (!has_room_beyond(vs, v)) return true;
    if (waited > k_kept) return false;
    for (const uint32_t other : vs.comers) {
        const Vehicle& o = vs.all[other];
        if (other == number || o.granted == o.wants || o.wants == k_no_lane) continue;
        if (std::ranges::find(conflicts, o.wants) == conflicts.end() || !goes_first(lanes, o.wants, v.wants))
            continue;
        const float seconds = to_line(lanes, o) / std::max(o.speed, 2.0f);
        if (seconds < k_soon && has_room_beyond(vs, o)) return true;
    }
    return false;
}

}  // namespace

void find_held(Vehicles& vs) {
    const Lanes& lanes = vs.map->lanes;
    std::fill(vs.held.begin(), vs.held.end(), 0u);
    for (size_t i = 0; i < lanes.all.size(); ++i) vs.free[i] = lanes.all[i].length;
    for (const Vehicle& v : vs.all) {
        if (!is_there(v)) continue;
        if (v.granted != k_no_lane) ++vs.held[v.granted];
        float rear = v.metres - shape_of(v).length;
        const bool flows = v.speed > k_flows;
        for (int k = k_here;; --k) {
            const uint32_t lane = v.route[k];
            ++vs.held[lane];
            if (!flows) vs.free[lane] = std::min(vs.free[lane], std::max(rear, 0.0f));
            if (rear >= 0 || k == 0 || v.route[k - 1] == k_no_lane) break;
            rear += lanes.all[v.route[k - 1]].length;
        }
    }
}

void grant(Vehicles& vs, uint32_t tick) {
    constexpr float k_near = 12;  // metres, or what it takes to stop
    const Lanes& lanes = vs.map->lanes;
    vs.comers.clear();
    for (uint32_t n = 0; n < vs.all.size(); ++n) {
        const Vehicle& v = vs.all[n];
        if (is_there(v) && v.wants != k_no_lane && v.granted != v.wants) vs.comers.push_back(n);
    }
    for (const uint32_t n : vs.comers) {
        Vehicle& v = vs.all[n];
        if (to_line(lanes, v) > k_near + v.speed * v.speed / 3) continue;
        if (must_wait(vs, n, stood(v, tick))) continue;
        v.granted = v.wants;
        ++vs.held[v.granted];
    }
}

}  // namespace flaneur
