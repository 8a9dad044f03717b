#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "sim/base/math.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/hands.h"
#include "sim/gait/rows.h"
#include "sim/gait/steps.h"

namespace flaneur {

namespace {

constexpr float k_beside = 0.12f;    // arms, of the tip from below the shoulder outward
constexpr float k_ahead = 0.08f;     // legs, of the tip from the left ankle
constexpr float k_off = 0.16f;       // metres that the tip may be off beside one who stands
constexpr float k_own_step = 0.45f;  // seconds that a step of its own takes
constexpr float k_reached = 0.992f;  // of cane and arm together
constexpr float k_planned = 0.97f;   // the same as it comes down
constexpr float k_planned_standing = 0.99f;
constexpr float k_nearest = 0.90f;  // and of that, how high the shoulder is, for the arm not to fold
constexpr float k_folded = 0.86f;   // the same while it stands
constexpr float k_hop = 0.05f;      // metres above even ground
constexpr float k_over = 0.02f;     // and above an edge
constexpr float k_highest = 0.15f;
constexpr float k_fastest = 4;  // m/s, of the tip
constexpr float k_touches =
    0.018f;                       // metres from its goal, from where a tip that is late comes down at once,
constexpr float k_slows = 0.15f;  // and before, the share of its way that it goes in a tick
constexpr float k_skin = 0.002f;  // metres
// Of a tip that is carried: metres above the ground, and ahead or behind where ground is looked for; of cane
// and arm together, how high the shoulder is over it at least; 1/s, critically damped.
constexpr float k_carried = 0.04f, k_aside = 0.2f, k_lifted = 0.9f, k_stiffness = 14;
// Seconds in which it is set down beside a foot that stands, if that still stands so long, and the fewest in
// which it comes down with one.
constexpr float k_late = 0.25f, k_rests = 0.2f, k_soonest = 0.12f;
constexpr float k_same_step = 0.03f;     // metres
constexpr float k_room = 0.2f;           // legs from the middle of the body, for a cane to be clear of thighs
constexpr float k_off_edge = 0.06f;      // metres, of a tip that stands
constexpr float k_edge = 0.02f;          // metres high
constexpr float k_settled = 0.06f;       // seconds before it comes down in which its place is kept
constexpr float k_following = 13;        // 1/s, of its place towards the goal
constexpr float k_take = 2.5f;           // 1/s, of the hand's hold
constexpr float k_contact_drop = 0.03f;  // legs, of the shoulder of one who walks, as a foot comes down
constexpr float k_stance_drop = 0.015f;  // and while it stands
constexpr float k_climb = 0.4f;          // of its way, in which it climbs at first, or comes down at last

struct Bearer {
    const GaitBlock& g;
    Stepper s;
    float arm;  // metres
};

Vec3 joint(const Stepper& s, int j) {
    return {s.person.joints[j][0][s.lane], s.person.joints[j][1][s.lane], s.person.joints[j][2][s.lane]};
}

Bearer bearer_of(const Gait& gait, const Stepper& s, size_t i) {
    Vec3 elbow = joint(s, right_lower_arm);
    float arm = length(elbow - joint(s, right_upper_arm)) + length(joint(s, right_hand) - elbow);
    return {gait.blocks[i / k_block], s, arm};
}

// On its side of a left foot that stands at `foot` and belongs to a body that faces `heading`.
Vec2 beside(const Bearer& b, Vec2 foot, float heading) {
    Vec2 ahead = heading_direction(heading), right{-ahead.z, ahead.x};
    float out = 0.5f * b.s.person.step_width[b.s.lane] - joint(b.s, right_upper_arm).x + k_beside * b.arm;
    return foot + right * out + ahead * (k_ahead * b.s.leg_length);
}

// Beside one who stands, or will in a moment.
Vec2 at_rest(const Bearer& b, Vec3 root, float heading) {
    return beside(b, on_ground(home(b.g, b.s.person, b.s.lane, k_left, root, heading).position), heading);
}

Vec3 at_rest_on(const Bearer& b) { return at_height(at_rest(b, b.s.root, b.s.heading), b.s.root.y); }

// Where it should come down `seconds` from now, before the ground is asked.
Vec3 wished(const Bearer& b, float seconds) {
    const FootBlock& foot = b.g.feet[k_left];
    if (foot.swinging[b.s.lane]) {
        float heading = foot.goal.yaw[b.s.lane] - b.s.person.toe_out[b.s.lane] - foot.stance_turn[b.s.lane];
        return at_height(beside(b, {foot.goal.x[b.s.lane], foot.goal.z[b.s.lane]}, heading),
                         foot.goal.y[b.s.lane]);
    }
    float lead = b.g.standing[b.s.lane] ? 0 : 0.45f * b.g.duty[b.s.lane] / b.g.frequency[b.s.lane];
    Vec3 root = b.s.root + at_height(b.s.velocity * (seconds + lead), 0);
    return at_height(at_rest(b, root, b.s.heading), b.s.root.y);
}

// The ground there, if no edge is near.
std::optional<Vec3> even_ground(const Bearer& b, Vec3 at, Vec2 way) {
    const Vec3 points[] = {at, at - at_height(way, 0), at + at_height(way, 0)};
    std::optional<GroundHit> hits[3];
    ground_at(b.s.around, points, k_step_up, k_step_down, hits);
    for (int i : {1, 2}) {
        if (!hits[0] || !hits[i]) return std::nullopt;
        Vec3 n = hits[0]->normal, by = points[i] - at;
        float slope = -(n.x * by.x + n.z * by.z) / std::max(n.y, 0.2f);
        if (std::fabs(hits[i]->height - hits[0]->height - slope) > k_edge) return std::nullopt;
    }
    return at_height(on_ground(at), hits[0]->height);
}

// Where the right shoulder is, about, after the body has gone `by`.
Vec3 shoulder_of(const Bearer& b, Vec2 by, float walking_drop) {
    Vec3 s = joint(b.s, right_upper_arm), h = joint(b.s, hips);
    Vec2 ahead = b.s.facing, right{-ahead.z, ahead.x};
    float lean = b.s.person.lean[b.s.lane] * b.g.amplitude[b.s.lane] + b.s.person.stoop[b.s.lane];
    float amplitude = b.g.amplitude[b.s.lane];
    float drop = b.s.person.crouch[b.s.lane] * smoothstep(0, 1, amplitude * k_crouches) +
                 b.g.crouch[b.s.lane] + b.g.sink[b.s.lane] + walking_drop * amplitude * b.s.leg_length;
    Vec2 place = on_ground(b.s.root) + by - right * s.x + ahead * (s.z + lean * (s.y - h.y));
    return at_height(place, b.g.base[b.s.lane] + s.y - drop);
}

float reach_of(const Bearer& b, const Cane& c) { return b.arm + length(c.tip_hs); }

// How far the tip may be as it comes down.
float planned_reach(const Bearer& b, const Cane& c) {
    return lerp(k_planned_standing, k_planned, b.g.amplitude[b.s.lane]) * reach_of(b, c);
}

// `at`, or as near to it as the shoulder and that reach allow at its height.
Vec3 within_reach(Vec3 at, Vec3 shoulder, float reach) {
    float down = shoulder.y - at.y, most = std::sqrt(std::max(reach * reach - down * down, 0.0f));
    Vec2 away = on_ground(at - shoulder);
    float far = length(away);
    return far > most ? at_height(on_ground(shoulder) + away * (most / far), at.y) : at;
}

// What the body will go until the tip comes down.
Vec2 coming(const Bearer& b, const Cane& c) {
    return (b.s.velocity + expected_velocity(b.s, c.left)) * (0.5f * c.left);
}

// The pelvis rides on the lower foot as the other comes down.
Vec3 shoulder_at_contact(const Bearer& b, const Cane& c) {
    Vec2 by = coming(b, c);
    Vec3 shoulder = shoulder_of(b, by, k_contact_drop);
    const FootBlock &l = b.g.feet[k_left], &r = b.g.feet[k_right];
    if (l.swinging[b.s.lane]) {
        Vec2 at = on_ground(b.s.root) + by;
        shoulder.y +=
            std::min(height_on(l.goal, b.s.lane, at), height_on(r.to, b.s.lane, at)) - b.g.base[b.s.lane];
    } else {
        shoulder.y += b.g.base_velocity[b.s.lane] * c.left;
    }
    return shoulder;
}

// Whether that is on the step which the other foot leaves behind, not where the left one goes.
bool is_behind(const Bearer& b, Vec3 ground) {
    auto off = [&](Side side) {
        return std::fabs(height_on(b.g.feet[side].goal, b.s.lane, on_ground(ground)) - ground.y);
    };
    return off(k_left) > off(k_right) + k_same_step;
}

// Ground for the tip, within the arm's reach as it comes down: where it is wished, or nearer to the feet, a
// little before or after an edge.
std::optional<Vec3> find_ground(const Bearer& b, const Cane& c) {
    Vec3 shoulder = shoulder_at_contact(b, c), wish = wished(b, c.left);
    float reach = planned_reach(b, c);
    Vec2 left{b.s.facing.z, -b.s.facing.x}, way = normalize_or(b.s.velocity, b.s.facing) * k_off_edge;
    for (float inward : {0.0f, 0.1f, 0.2f}) {
        for (float shift : {0.0f, -1.0f, 1.0f, -2.0f, -4.0f}) {
            Vec3 at = within_reach(wish + at_height(left * inward + way * shift, 0), shoulder, reach);
            auto ground = even_ground(b, at, way);
            if (ground && length(*ground - shoulder) > reach)
                ground = even_ground(b, within_reach(*ground, shoulder, reach), way);
            if (!ground) continue;
            float far = length(*ground - shoulder);
            if (is_behind(b, *ground)) continue;
            if (far < reach + k_skin && shoulder.y - ground->y > k_nearest * reach) return ground;
        }
    }
    return std::nullopt;
}

// Its way, at a share of it: it climbs before it goes on, and goes on before it comes down. It swings ahead
// of the body as the arm does, so that it stays within reach where both its ends are.
struct Way {
    float onward, upward, hop;
};
Way way_at(float share, bool up) {
    float s = share, hop = 4 * s * (1 - s);
    float upward = up ? smoothstep(0, k_climb, s) : smoothstep(1 - k_climb, 1, s);
    return {s * s * s * (10 - s * (15 - 6 * s)), upward, hop * std::sqrt(hop)};
}
Vec3 place_on(const Way& way, Vec3 from, Vec3 to, Vec2 gone, Vec2 coming) {
    Vec2 place = lerp(on_ground(from) + gone, on_ground(to) - coming, way.onward);
    return at_height(place, lerp(from.y, to.y, way.upward));
}

// What it must rise above its way to pass over all ground.
float clearance(const Bearer& b, const Cane& c) {
    constexpr int k_samples = 15;
    Vec3 points[k_samples];
    std::optional<GroundHit> hits[k_samples];
    float is[k_samples], hop[k_samples];
    Vec2 all = coming(b, c) / std::max(1 - c.share, 0.05f);
    for (int i = 0; i < k_samples; ++i) {
        float share = static_cast<float>(i + 1) / (k_samples + 1);
        Way way = way_at(share, c.goal.y > c.from.y);
        points[i] = place_on(way, c.from, c.goal, all * share, all * (1 - share));
        is[i] = points[i].y;
        hop[i] = way.hop;
        points[i].y = std::max(c.from.y, c.goal.y);
    }
    ground_at(b.s.around, points, k_step_up, k_step_down, hits);
    float rise = k_hop;
    for (int i = 0; i < k_samples; ++i)
        if (hits[i]) rise = std::max(rise, (hits[i]->height - is[i]) / hop[i] + k_over);
    return std::min(rise, k_highest);
}

// Where a tip without ground to stand on is carried: beside the body, a little above what is underfoot, ahead
// of an edge down and behind one up for which the arm would have to fold.
Vec3 carried(const Bearer& b, const Cane& c) {
    constexpr int k_places = 6;
    constexpr float k_shifts[k_places] = {2, 1, 0, -0.5f, -1, -1.5f};
    Vec3 shoulder = shoulder_of(b, {}, k_stance_drop), middle = at_rest_on(b);
    Vec2 way = normalize_or(b.s.velocity, b.s.facing) * k_aside;
    Vec3 places[k_places];
    std::optional<GroundHit> hits[k_places];
    for (int i = 0; i < k_places; ++i) places[i] = middle + at_height(way * k_shifts[i], 0);
    ground_at(b.s.around, places, k_step_up, k_step_down, hits);
    float reach = reach_of(b, c), lowest = shoulder.y - k_planned * reach;
    auto height = [&](int i) { return hits[i] ? hits[i]->height + k_carried : lowest; };
    int best = height(0) < height(2) - k_same_step ? 0 : 2;
    const float highest = shoulder.y - k_lifted * reach;
    auto around = [&](int i) { return std::max(height(i), height(std::max(i - 1, 0))); };
    while (best + 1 < k_places && around(best) > highest) ++best;
    float ahead = around(std::max(best - 2, 0));
    places[best].y = std::max({lowest, around(best), std::min(ahead, highest)});
    return within_reach(places[best], shoulder, k_planned * reach);
}

// As far as it may in a tick; where ground is in its way, up first.
void move_tip(const Bearer& b, Cane& c, Vec3 to) {
    Vec3 by = to - c.tip;
    float far = length(by), most = k_fastest * b.s.dt;
    Vec3 next = far > most ? c.tip + by * (most / far) : to;
    // And before and behind, since the arm may be late.
    Vec3 onward = at_height(on_ground(next - c.tip), 0);
    const Vec3 points[] = {next, next + onward, next - onward};
    std::optional<GroundHit> hits[3];
    ground_at(b.s.around, points, k_step_up, 0, hits);
    float ground = next.y;
    for (const auto& hit : hits)
        if (hit && hit->height > next.y + k_skin) ground = std::max(ground, hit->height);
    if (ground > next.y) {
        float up = ground - c.tip.y;
        next = up > most / 2 ? c.tip + Vec3{0, most / 2, 0} : at_height(on_ground(next), ground);
    }
    c.velocity = (next - c.tip) / b.s.dt;
    c.tip = next;
}

void plan(const Bearer& b, Cane& c) {
    auto ground = find_ground(b, c);
    c.lost = !ground;
    c.goal = ground ? *ground : carried(b, c);
    if (ground) c.clear = clearance(b, c);
}

// Sets it down where the body is.
void set_down(const Bearer& b, Cane& c) {
    c.share = 1;
    c.left = 0;
    c.goal = c.from = b.s.root;
    plan(b, c);
    c.tip = c.from = c.to = c.goal;
    c.velocity = {};
}

Vec2 right_of(const Bearer& b) { return {-b.s.facing.z, b.s.facing.x}; }

// Metres by which a tip is so near the middle of the body that the cane would meet a thigh.
float too_near(const Bearer& b, Vec3 tip) {
    return k_room * b.s.leg_length - dot(on_ground(tip - b.s.root), right_of(b));
}

bool must_step(const Bearer& b, const Cane& c) {
    bool behind = dot(on_ground(c.to - shoulder_of(b, {}, 0)), b.s.velocity) <= 0;
    Vec3 shoulder = shoulder_of(b, {}, behind ? k_stance_drop : k_contact_drop);
    if (length(c.to - shoulder) > k_reached * reach_of(b, c)) return true;
    if (shoulder.y - c.to.y < k_folded * reach_of(b, c)) return true;
    if (too_near(b, c.to) > 0) return true;
    return b.g.standing[b.s.lane] && length(on_ground(c.to) - at_rest(b, b.s.root, b.s.heading)) > k_off;
}

void lift(const Bearer& b, Cane& c, float seconds) {
    c.from = c.goal = c.tip;
    c.gone = {};
    c.share = 0;
    c.left = seconds;
    c.rise = 0;
    plan(b, c);
    c.to = c.goal;
}

// Seconds until the left foot, which swings or will, comes down.
float until_contact(const Bearer& b) {
    const FootBlock& foot = b.g.feet[k_left];
    float rate = foot.swinging[b.s.lane] ? foot.rate[b.s.lane] : b.g.frequency[b.s.lane];
    return (1 - foot.phase[b.s.lane]) / std::max(rate, 0.1f);
}

// A tick of its way through the air. `lands`: the foot has come down with which it went.
void swing(const Bearer& b, Cane& c, bool lands) {
    const float dt = b.s.dt;
    c.left = c.steps != 0 ? until_contact(b) : c.left - dt;
    c.gone += b.s.velocity * dt;
    if (b.s.replans && c.left > k_settled && !lands) plan(b, c);
    if (c.lost != 0) return;
    float follow = std::min(1.0f, dt * std::max(k_following, 2.5f / std::max(c.left, dt)));
    c.to += (c.goal - c.to) * follow;
    c.rise += (c.clear - c.rise) * follow;
    c.share += (1 - c.share) * std::min(1.0f, dt / std::max(c.left, dt));
    if (lands || c.left <= 0 || c.share >= 1) {
        c.to = c.goal;
        // One that is late comes down as softly.
        Vec3 by = c.goal - c.tip;
        move_tip(b, c, length(by) < k_touches ? c.goal : c.tip + by * k_slows);
        c.left = 0;
        c.share = c.tip == c.goal ? 1 : 0.99f;
        return;
    }
    Way way = way_at(c.share, c.to.y > c.from.y);
    Vec3 tip = place_on(way, c.from, c.to, c.gone, coming(b, c));
    // No higher than the arm lifts it with ease: it comes down with a body that does.
    tip.y =
        std::min(tip.y + c.rise * way.hop, shoulder_of(b, {}, k_stance_drop).y - k_lifted * reach_of(b, c));
    tip += at_height(right_of(b) * (std::max(too_near(b, tip), 0.0f) * std::min(4 * (1 - c.share), 1.0f)), 0);
    move_tip(b, c, tip);
}

// A tick of being carried, until there is ground again, or the foot has come down to which it could go.
void carry(const Bearer& b, Cane& c) {
    const FootBlock& foot = b.g.feet[k_left];
    const int steps = spring_steps(b.s.dt);
    const float dt = b.s.dt / static_cast<float>(steps);
    for (int k = 0; k < steps; ++k) {
        const Vec3 by = carried(b, c) - c.tip, behind = c.velocity - at_height(b.s.velocity, 0);
        c.velocity += (by * k_stiffness - behind * 2) * (k_stiffness * dt);
        move_tip(b, c, c.tip + c.velocity * dt);
    }
    c.share = 1;
    c.to = c.goal = c.tip;
    if (!b.s.replans) return;
    float stands = (b.g.duty[b.s.lane] - foot.phase[b.s.lane]) / std::max(b.g.frequency[b.s.lane], 0.1f);
    if (c.steps != 0) {
        if (until_contact(b) > k_soonest) lift(b, c, until_contact(b));
    } else if (b.g.standing[b.s.lane] || stands > k_late + k_rests) {
        lift(b, c, k_late);
    }
}

void advance(const Bearer& b, Cane& c) {
    const bool steps = b.g.feet[k_left].swinging[b.s.lane] != 0, stepped = c.steps != 0;
    const bool able = b.g.running[b.s.lane] == 0 && b.g.jump[b.s.lane] == 0;
    c.steps = steps;
    if (c.held == 0) {
        if (able) set_down(b, c);
    } else if (c.lost != 0) {
        carry(b, c);
    } else if (c.share < 1) {
        swing(b, c, stepped && !steps);
    } else if (steps && !stepped) {
        lift(b, c, until_contact(b));
    } else if (must_step(b, c)) {
        lift(b, c, b.g.standing[b.s.lane] ? k_own_step : clamp(until_contact(b), 0.3f, 0.8f));
    }
    c.held = clamp(c.held + (able ? k_take : -k_take) * b.s.dt, 0, 1);
}

}  // namespace

Span canes_of(const Gait& gait, size_t begin, size_t end) { return span_of(gait.canes, begin, end); }

void give_cane(Gait& gait, size_t walker, Vec3 tip_hs, const Stepper& stepper) {
    auto at = take_away(gait.canes, walker);
    if (tip_hs == Vec3{}) return;
    Cane cane;
    cane.walker = static_cast<uint32_t>(walker);
    cane.tip_hs = tip_hs;
    set_down(bearer_of(gait, stepper, walker), cane);
    cane.held = 1;
    gait.canes.insert(at, cane);
}

void advance_cane(const Gait& gait, Cane& cane, const Stepper& stepper) {
    advance(bearer_of(gait, stepper, cane.walker), cane);
}

}  // namespace flaneur
