#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "sim/base/math.h"
#include "sim/gait/hands.h"
#include "sim/gait/steps.h"

namespace flaneur {

namespace {

constexpr float k_beside = 0.2f;     // arms, of the tip from below the shoulder outward
constexpr float k_ahead = 0.08f;     // legs, of the tip from the left ankle
constexpr float k_off = 0.16f;       // metres that the tip may be off beside one who stands
constexpr float k_own_step = 0.45f;  // seconds that a step of its own takes
constexpr float k_reached = 0.985f;  // of cane and arm together
constexpr float k_planned = 0.97f;   // the same as it comes down
constexpr float k_nearest = 0.90f;   // and of that, how high the shoulder is, for the arm not to fold
constexpr float k_folded = 0.86f;    // the same while it stands
constexpr float k_hop = 0.05f;       // metres above even ground
constexpr float k_over = 0.02f;      // and above an edge
constexpr float k_highest = 0.3f;
constexpr float k_carried = 0.94f;   // of what is planned, how high the shoulder is over a tip without ground
constexpr float k_off_edge = 0.06f;  // metres, of a tip that stands
constexpr float k_edge = 0.02f;      // metres high
constexpr float k_settled = 0.06f;   // seconds before it comes down in which its place is kept
constexpr float k_following = 13;    // 1/s, of its place towards the goal
constexpr float k_take = 2.5f;       // 1/s, of the hand's hold
constexpr float k_drop = 0.015f;     // legs, of the shoulder below where it is in the canonical pose,
constexpr float k_contact_drop = 0.03f;  // and more of one who walks, as a foot comes down
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
    return beside(b, on_ground(home(b.s.person, b.s.lane, k_left, root, heading).position), heading);
}

// Where it should come down `seconds` from now, before the ground is asked.
Vec3 wished(const Bearer& b, float seconds) {
    const FootBlock& foot = b.g.feet[k_left];
    if (foot.swinging[b.s.lane]) {
        float heading = foot.goal.yaw[b.s.lane] - b.s.person.toe_out[b.s.lane];
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
    float drop =
        b.s.person.crouch[b.s.lane] + (k_drop + walking_drop * b.g.amplitude[b.s.lane]) * b.s.leg_length;
    Vec2 place = on_ground(b.s.root) + by - right * s.x + ahead * (s.z + lean * (s.y - h.y));
    return at_height(place, b.g.base[b.s.lane] + s.y - drop);
}

float reach_of(const Bearer& b, const Cane& c) { return b.arm + length(c.tip_hs); }

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

// The pelvis rides between both feet then.
Vec3 shoulder_at_contact(const Bearer& b, const Cane& c) {
    Vec2 by = coming(b, c);
    Vec3 shoulder = shoulder_of(b, by, k_contact_drop);
    const FootBlock &l = b.g.feet[k_left], &r = b.g.feet[k_right];
    float climbs = b.g.rise[b.s.lane] * length(by);
    if (l.swinging[b.s.lane]) climbs = 0.5f * (l.goal.y[b.s.lane] + r.to.y[b.s.lane]) - b.g.base[b.s.lane];
    shoulder.y += climbs;
    return shoulder;
}

// Ground for the tip, within the arm's reach as it comes down: where it is wished, or nearer to the feet, a
// little before or after an edge.
std::optional<Vec3> find_ground(const Bearer& b, const Cane& c) {
    Vec3 shoulder = shoulder_at_contact(b, c), wish = wished(b, c.left);
    float reach = k_planned * reach_of(b, c);
    Vec2 left{b.s.facing.z, -b.s.facing.x}, way = normalize_or(b.s.velocity, b.s.facing) * k_off_edge;
    for (float inward : {0.0f, 0.1f, 0.2f}) {
        for (float shift : {0.0f, -1.0f, 1.0f, -2.0f, -4.0f}) {
            Vec3 at = within_reach(wish + at_height(left * inward + way * shift, 0), shoulder, reach);
            auto ground = even_ground(b, at, way);
            if (ground && length(*ground - shoulder) > reach)
                ground = even_ground(b, within_reach(*ground, shoulder, reach), way);
            if (!ground) continue;
            float far = length(*ground - shoulder);
            if (far < reach + 0.01f && shoulder.y - ground->y > k_nearest * reach) return ground;
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

void plan(const Bearer& b, Cane& c) {
    auto ground = find_ground(b, c);
    c.lost = !ground;
    if (ground) {
        c.goal = *ground;
    } else {
        Vec3 shoulder = shoulder_at_contact(b, c), wish = wished(b, c.left);
        float reach = k_planned * reach_of(b, c);
        wish.y = std::max(wish.y + k_over, shoulder.y - k_carried * reach);
        c.goal = within_reach(wish, shoulder, reach);
    }
    c.clear = clearance(b, c);
}

// Sets it down where the body is.
void set_down(const Bearer& b, Cane& c) {
    c.share = 1;
    c.left = 0;
    c.goal = c.from = b.s.root;
    plan(b, c);
    c.tip = c.from = c.to = c.goal;
}

bool must_step(const Bearer& b, const Cane& c) {
    bool behind = dot(on_ground(c.to - shoulder_of(b, {}, 0)), b.s.velocity) <= 0;
    Vec3 shoulder = shoulder_of(b, {}, behind ? k_stance_drop : k_contact_drop);
    if (length(c.to - shoulder) > k_reached * reach_of(b, c)) return true;
    if (c.lost == 0 && shoulder.y - c.to.y < k_folded * reach_of(b, c)) return true;
    return b.g.standing[b.s.lane] && length(on_ground(c.to) - at_rest(b, b.s.root, b.s.heading)) > k_off;
}

void lift(const Bearer& b, Cane& c, float seconds) {
    c.from = c.goal = c.to;
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
    float follow = std::min(1.0f, dt * std::max(k_following, 2.5f / std::max(c.left, dt)));
    c.to += (c.goal - c.to) * follow;
    c.rise += (c.clear - c.rise) * follow;
    c.share += (1 - c.share) * std::min(1.0f, dt / std::max(c.left, dt));
    if (lands || c.left <= 0 || c.share >= 1) {
        c.share = 1;
        c.tip = c.to = c.goal;
        return;
    }
    Way way = way_at(c.share, c.to.y > c.from.y);
    c.tip = place_on(way, c.from, c.to, c.gone, coming(b, c));
    c.tip.y += c.rise * way.hop;
    auto below = ground_at(b.s.around, c.tip, k_highest, 0);
    if (below) c.tip.y = std::max(c.tip.y, below->height);
}

void advance(const Bearer& b, Cane& c) {
    const bool steps = b.g.feet[k_left].swinging[b.s.lane] != 0, stepped = c.steps != 0;
    const bool able = b.g.running[b.s.lane] == 0 && b.g.jump[b.s.lane] == 0;
    c.steps = steps;
    if (c.held == 0) {
        if (able) set_down(b, c);
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

CaneSpan canes_of(const Gait& gait, size_t begin, size_t end) {
    auto before = [](const Cane& c, size_t walker) { return c.walker < walker; };
    auto first = std::lower_bound(gait.canes.begin(), gait.canes.end(), begin, before);
    auto last = std::lower_bound(first, gait.canes.end(), end, before);
    return {static_cast<size_t>(first - gait.canes.begin()), static_cast<size_t>(last - gait.canes.begin())};
}

void give_cane(Gait& gait, size_t walker, Vec3 tip_hs, const Stepper& stepper) {
    CaneSpan own = canes_of(gait, walker, walker + 1);
    auto at = gait.canes.begin() + static_cast<std::ptrdiff_t>(own.begin);
    if (own.begin < own.end) at = gait.canes.erase(at);
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
