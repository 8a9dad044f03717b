#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "sim/base/math.h"
#include "sim/gait/hands.h"
#include "sim/gait/steps.h"

namespace flaneur {

namespace {

constexpr float k_beside = 0.2f;        // arms, of the tip from below the shoulder outward
constexpr float k_ahead = 0.08f;        // legs, of the tip from the left ankle
constexpr float k_off = 0.16f;          // metres that the tip may be off beside one who stands
constexpr float k_own_step = 0.45f;     // seconds that a step of its own takes
constexpr float k_reached = 0.98f;     // of cane and arm together
constexpr float k_planned = 0.97f;     // the same as it comes down
constexpr float k_hop = 0.05f;          // metres above even ground
constexpr float k_over = 0.02f;         // and above an edge
constexpr float k_highest = 0.3f;
constexpr float k_off_edge = 0.06f;     // metres, of a tip that stands
constexpr float k_edge = 0.02f;         // metres high
constexpr float k_settled = 0.06f;      // seconds before it comes down in which its place is kept
constexpr float k_following = 13;       // 1/s, of its place towards the goal
constexpr float k_take = 2.5f;          // 1/s, of the hand's hold
constexpr float k_climb = 0.4f;         // of its way, in which it climbs at first, or comes down at last

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

// The ground there, or a little before or after an edge that is too near.
std::optional<Vec3> ground_for_tip(const Bearer& b, Vec3 at) {
    Vec2 way = normalize_or(b.s.velocity, heading_direction(b.s.heading)) * k_off_edge;
    for (float shift : {0.0f, -1.0f, 1.0f, -2.0f}) {
        Vec3 middle = at + at_height(way * shift, 0);
        const Vec3 points[] = {middle, middle - at_height(way, 0), middle + at_height(way, 0)};
        std::optional<GroundHit> hits[3];
        ground_at(b.s.around, points, k_step_up, k_step_down, hits);
        auto is_even = [&](int i) {
            if (!hits[i] || !hits[0]) return false;
            Vec3 n = hits[0]->normal, by = points[i] - middle;
            float slope = -(n.x * by.x + n.z * by.z) / std::max(n.y, 0.2f);
            return std::fabs(hits[i]->height - hits[0]->height - slope) < k_edge;
        };
        if (is_even(1) && is_even(2)) return at_height(on_ground(middle), hits[0]->height);
    }
    return std::nullopt;
}

// Its way, at a share of it: it climbs before it goes on, and goes on before it comes down.
struct Way {
    float onward, upward, hop;
};
Way way_at(float share, bool up) {
    float s = share, product = s * (1 - s);
    float upward = up ? smoothstep(0, k_climb, s) : smoothstep(1 - k_climb, 1, s);
    return {s * s * s * (10 - s * (15 - 6 * s)), upward, 16 * product * product};
}

// What it must rise above its way to pass over all ground.
float clearance(const Bearer& b, const Cane& c) {
    constexpr int k_samples = 9;
    Vec3 points[k_samples];
    std::optional<GroundHit> hits[k_samples];
    Way ways[k_samples];
    for (int i = 0; i < k_samples; ++i) {
        ways[i] = way_at(static_cast<float>(i + 1) / (k_samples + 1), c.goal.y > c.from.y);
        points[i] = lerp(c.from, c.goal, ways[i].onward);
        points[i].y = std::max(c.from.y, c.goal.y);
    }
    ground_at(b.s.around, points, k_step_up, k_step_down, hits);
    float rise = k_hop;
    for (int i = 0; i < k_samples; ++i) {
        if (!hits[i]) continue;
        float is = lerp(c.from.y, c.goal.y, ways[i].upward);
        rise = std::max(rise, (hits[i]->height + k_over * std::min(1.0f, 4 * ways[i].hop) - is) / ways[i].hop);
    }
    return std::min(rise, k_highest);
}

// Where the right shoulder is, about.
Vec3 shoulder_of(const Bearer& b) {
    Vec3 s = joint(b.s, right_upper_arm), h = joint(b.s, hips);
    Vec2 ahead = heading_direction(b.s.heading), right{-ahead.z, ahead.x};
    float lean = b.s.person.lean[b.s.lane] * b.g.amplitude[b.s.lane] + b.s.person.stoop[b.s.lane];
    Vec2 place = on_ground(b.s.root) - right * s.x + ahead * (s.z + lean * (s.y - h.y));
    return at_height(place, b.g.base[b.s.lane] + s.y - b.s.person.crouch[b.s.lane] -
                                (0.015f + 0.03f * b.g.amplitude[b.s.lane]) * b.s.leg_length);
}

// `at`, or as near to it as the arm will reach `seconds` from now.
Vec3 within_reach(const Bearer& b, const Cane& c, Vec3 at, float seconds) {
    Vec2 by = (b.s.velocity + expected_velocity(b.s, seconds)) * (0.5f * seconds);
    Vec3 shoulder = shoulder_of(b) + at_height(by, b.g.rise[b.s.lane] * length(by));
    float reach = k_planned * (b.arm + length(c.tip_hs)), down = shoulder.y - at.y;
    float most = std::sqrt(std::max(reach * reach - down * down, 0.0f));
    Vec2 away = on_ground(at - shoulder);
    float far = length(away);
    return far > most ? at_height(on_ground(shoulder) + away * (most / far), at.y) : at;
}

void plan(const Bearer& b, Cane& c) {
    auto ground = ground_for_tip(b, within_reach(b, c, wished(b, c.left), c.left));
    c.lost = !ground;
    if (!ground) return;
    c.goal = *ground;
    c.clear = clearance(b, c);
}

// Sets it down where the body is.
void set_down(const Bearer& b, Cane& c) {
    c.share = 1;
    c.goal = c.from = b.s.root;
    plan(b, c);
    c.from = c.to = c.goal;
}

bool must_step(const Bearer& b, const Cane& c) {
    if (length(shoulder_of(b) - c.to) > k_reached * (b.arm + length(c.tip_hs))) return true;
    return b.g.standing[b.s.lane] && length(on_ground(c.to) - at_rest(b, b.s.root, b.s.heading)) > k_off;
}

void lift(const Bearer& b, Cane& c, float seconds) {
    c.from = c.goal = c.to;
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

void advance(const Bearer& b, Cane& c) {
    const float dt = b.s.dt;
    const bool swings = b.g.feet[k_left].swinging[b.s.lane] != 0, swung = c.steps != 0;
    c.steps = swings;
    bool able = b.g.running[b.s.lane] == 0 && b.g.jump[b.s.lane] == 0;
    if (c.held == 0) {
        if (able) set_down(b, c);
    } else if (c.share >= 1) {
        if (swings && !swung) {
            lift(b, c, until_contact(b));
        } else if (must_step(b, c)) {
            lift(b, c, b.g.standing[b.s.lane] ? k_own_step : clamp(until_contact(b), 0.3f, 0.8f));
        }
    }
    if (c.share < 1) {
        bool lands = swung && !swings;
        c.left = swings ? until_contact(b) : c.left - dt;
        if (b.s.replans && c.left > k_settled && !lands) plan(b, c);
        float share = std::min(1.0f, dt * std::max(k_following, 2.5f / std::max(c.left, dt)));
        c.to += (c.goal - c.to) * share;
        c.rise += (c.clear - c.rise) * share;
        c.share += (1 - c.share) * std::min(1.0f, dt / std::max(c.left, dt));
        if (lands || c.left <= 0) {
            c.share = 1;
            c.to = c.goal;
        }
    }
    c.held = clamp(c.held + (able && c.lost == 0 ? k_take : -k_take) * dt, 0, 1);
}

}  // namespace

Vec3 tip_of(const Cane& c) {
    if (c.share >= 1) return c.to;
    Way way = way_at(c.share, c.to.y > c.from.y);
    Vec3 tip = lerp(c.from, c.to, way.onward);
    tip.y = lerp(c.from.y, c.to.y, way.upward) + c.rise * way.hop;
    return tip;
}

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
    if (cane.lost == 0) cane.held = 1;
    gait.canes.insert(at, cane);
}

void advance_cane(const Gait& gait, Cane& cane, const Stepper& stepper) {
    advance(bearer_of(gait, stepper, cane.walker), cane);
}

}  // namespace flaneur
