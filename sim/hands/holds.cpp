#include "sim/hands/holds.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

// Of a left hand; a right one mirrors it. Heights are from the hips' joint, in those of the shoulder over it.
// `ahead` is in the girth ahead, or behind where it is negative, and `clear` is added to that, in the body's
// height. `out` is in half the width of the shoulders, and in the girth of the hip where a hand is at its
// side. On the ground all are in the body's height.
//
// On its way the hand goes round the body by `round_out` and `round_ahead`, of the body's height.
struct HoldShape {
    HoldAnchor anchor;
    float out, up, ahead, clear;
    float elbow, twist, bend, side;  // see HoldBlock
    float round_out, round_ahead;
};

constexpr HoldShape k_shapes[k_hold_count] = {
    // none
    {},
    // pocket
    {HoldAnchor::pelvis, 0.83f, -0.115f, 0.12f, 0, -0.335f, 0.11f, 0.23f, 0.07f, 0.04f, 0.01f},
    // hip
    {HoldAnchor::pelvis, 1.2f, 0.204f, 0, 0, -0.707f, 0.08f, -0.124f, 0.338f, 0.05f, -0.02f},
    // clasp_over
    {HoldAnchor::pelvis, 0.43f, -0.02f, 1, 0.032f, -0.583f, -0.083f, -0.116f, -0.212f, 0.02f, 0.05f},
    // clasp_under
    {HoldAnchor::pelvis, 0.43f, -0.02f, 1, 0.018f, -0.583f, -0.083f, -0.116f, -0.212f, 0.02f, 0.05f},
    // behind_over
    {HoldAnchor::pelvis, 0.42f, 0.05f, -1, 0.014f, -0.549f, -0.165f, -0.079f, -0.051f, 0.03f, -0.05f},
    // behind_under
    {HoldAnchor::pelvis, 0.42f, 0.05f, -1, 0.002f, -0.549f, -0.165f, -0.079f, -0.051f, 0.03f, -0.05f},
    // fold_over
    {HoldAnchor::chest, -0.09f, 0.5f, 1, 0.032f, -0.795f, 0.13f, 0.059f, -0.279f, 0.02f, 0.05f},
    // fold_under
    {HoldAnchor::chest, -0.05f, 0.41f, 1, 0.022f, -0.795f, 0.1f, -0.04f, -0.314f, 0.02f, 0.05f},
    // across
    {HoldAnchor::chest, -0.42f, 0.204f, 1, 0.017f, -0.643f, 0.009f, -0.073f, -0.33f, 0.02f, 0.05f},
    // bag_strap
    {HoldAnchor::chest, 0.46f, 0.52f, 1, 0.022f, -0.499f, 0.13f, -0.405f, -0.265f, 0.02f, 0.02f},
    // pack_strap
    {HoldAnchor::chest, 0.65f, 0.574f, 1, 0.027f, -0.374f, 0.083f, -0.551f, -0.172f, 0.02f, 0.02f},
    // handle
    {HoldAnchor::ground, 0.1f, 0.56f, 0.2f, 0, -0.394f, -0.22f, -0.011f, 0.348f, 0.02f, 0.02f},
    // tells
    {HoldAnchor::chest, 0.98f, 0.32f, 1, 0.11f, -0.35f, 0.2f, 0.05f, 0.05f, 0.03f, 0.02f},
    // waves
    {HoldAnchor::chest, 1.5f, 1.32f, 1, 0.09f, -0.2f, 0.1f, -0.1f, 0, 0.04f, 0.06f},
};

constexpr float k_time = 0.9f;                    // seconds that a hand takes
constexpr float k_hurry = 0.55f;                  // of that, as one walks off
constexpr float k_shortest = 10, k_longest = 40;  // seconds that a posture lasts
constexpr float k_fastest = 1.55f;                // m/s, of who walks with a hand in a pocket,
constexpr float k_strolls = 1.0f;                 // and with both behind the back
constexpr float k_sets_off = 0.15f;               // m/s
constexpr uint32_t k_ask_ticks = 6;               // one who holds looks so often whether it still may

// What both hands have in each posture: the left one, or that of the side that one prefers, and the other.
struct Pair {
    Hold own, other;
    float walking;  // factor on how often, of one who walks
};
constexpr Pair k_pairs[k_posture_count] = {
    {Hold::none, Hold::none, 1.8f},
    {Hold::pocket, Hold::none, 1},
    {Hold::pocket, Hold::pocket, 0.7f},
    {Hold::hip, Hold::none, 0},
    {Hold::hip, Hold::hip, 0},
    {Hold::clasp_over, Hold::clasp_under, 0},
    {Hold::behind_over, Hold::behind_under, 0.5f},
    {Hold::fold_over, Hold::fold_under, 0},
    {Hold::across, Hold::none, 0},
    {Hold::bag_strap, Hold::none, 1},
};

Vec3 joint(const PersonBlock& p, int j, int lane) {
    return {p.joints[j][0][lane], p.joints[j][1][lane], p.joints[j][2][lane]};
}

// Where the wrist is once it is there, mirrored to its side.
Vec3 place_of(const HoldShape& shape, const PersonBlock& p, int lane, Side side) {
    float mirror = side == k_left ? 1.0f : -1.0f;
    Vec3 hip = joint(p, hips, lane), shoulder = joint(p, left_upper_arm, lane);
    float height = p.height[lane];
    if (shape.anchor == HoldAnchor::ground) return Vec3{shape.out * mirror, shape.up, shape.ahead} * height;
    float up = shape.up * (shoulder.y - hip.y);
    if (shape.anchor == HoldAnchor::pelvis) {
        float depth = shape.ahead < 0 ? p.girth[2][lane] : p.girth[1][lane];
        float clear = (shape.ahead < 0 ? -shape.clear : shape.clear) * height;
        float width = std::fabs(shape.ahead) == 1 ? shoulder.x : p.girth[0][lane];
        return {shape.out * width * mirror, up, shape.ahead * depth + clear};
    }
    Vec3 middle = joint(p, upper_chest, lane);
    return {(shape.out - 1) * shoulder.x * mirror, hip.y + up - shoulder.y,
            middle.z - shoulder.z + shape.ahead * p.girth[3][lane] + shape.clear * height};
}

// The hand as far as its share of the way says.
void put_hand(HoldBlock& hold, const PersonBlock& p, int lane, Side side, Vec3 moved) {
    const HoldShape& shape = k_shapes[hold.kind[lane]];
    float mirror = side == k_left ? 1.0f : -1.0f, share = hold.share[lane];
    float weight = share * share * (3 - 2 * share), height = p.height[lane];
    // The pose goes `weight` of the way from where the arm swings to this place.
    float round = 4 * (1 - weight) * height;
    Vec3 place =
        place_of(shape, p, lane, side) + moved + Vec3{shape.round_out * mirror, 0, shape.round_ahead} * round;
    hold.x[lane] = place.x;
    hold.y[lane] = place.y;
    hold.z[lane] = place.z;
    hold.anchor[lane] = static_cast<float>(shape.anchor);
    hold.elbow[lane] = shape.elbow * mirror;
    hold.twist[lane] = shape.twist * mirror * weight;
    hold.bend[lane] = shape.bend * weight;
    hold.side[lane] = shape.side * mirror * weight;
    hold.weight[lane] = weight;
}

enum class Doing { stands, walks, else_ };

struct Stroller {
    const GaitBlock& g;
    const PersonBlock& p;
    int lane;
    float speed, wish;
};

Doing doing_of(const Stroller& s) {
    int lane = s.lane;
    if (s.g.jump[lane] > 0 || s.g.running[lane] > 0 || s.speed > k_fastest) return Doing::else_;
    if (s.g.tread[lane] > 0 || std::fabs(s.g.rise[lane]) > 0.06f) return Doing::else_;
    if (s.wish < k_sets_off && s.g.amplitude[lane] < 0.2f) return Doing::stands;
    return s.speed > 0.5f && s.wish > 0.5f && s.g.amplitude[lane] > 0.8f ? Doing::walks : Doing::else_;
}

// Whether one may go on as it does.
bool may_keep(const Stroller& s, Posture posture) {
    bool goes = s.wish > k_sets_off || s.g.amplitude[s.lane] > 0.2f;
    if (!goes) return true;
    if (s.g.jump[s.lane] > 0 || s.g.running[s.lane] > 0 || s.g.tread[s.lane] > 0) return false;
    if (std::fabs(s.g.rise[s.lane]) > 0.08f) return false;
    if (k_pairs[static_cast<int>(posture)].walking == 0) return false;
    return std::max(s.speed, s.wish) < (posture == Posture::behind ? k_strolls : k_fastest);
}

Posture choose_posture(const Stroller& s, Doing doing, RandomKey chance) {
    float weights[k_posture_count], all = 0;
    for (int i = 0; i < k_posture_count; ++i) {
        weights[i] = s.p.postures[i][s.lane] * (doing == Doing::walks ? k_pairs[i].walking : 1);
        if (!may_keep(s, static_cast<Posture>(i))) weights[i] = 0;
        all += weights[i];
    }
    float drawn = random_unit(chance) * all;
    for (int i = 0; i < k_posture_count; ++i) {
        if (drawn < weights[i]) return static_cast<Posture>(i);
        drawn -= weights[i];
    }
    return Posture::hang;
}

bool is_settled(const HoldBlock& hold, int lane) {
    return hold.kind[lane] == hold.wanted[lane] && (hold.kind[lane] == 0 || hold.share[lane] == 1);
}

// The side of a posture of one hand.
Side own_side(const PersonBlock& p, int lane, Posture posture, RandomKey chance) {
    if (posture == Posture::strap && p.bag[lane] == static_cast<int32_t>(Bag::shoulder_bag)) return k_left;
    RandomKey always = chance;
    always.when = 0;
    bool left_handed = random_unit(always, 2) < 0.3f, other = random_unit(chance, 2) < 0.25f;
    Side side = left_handed == other ? k_right : k_left;
    return (p.free_hands[lane] & (1 << side)) != 0 ? side : side == k_left ? k_right : k_left;
}

void take(GaitBlock& g, const Stroller& s, Posture posture, RandomKey chance) {
    int lane = s.lane;
    Pair pair = k_pairs[static_cast<int>(posture)];
    Side side = own_side(s.p, lane, posture, chance);
    if (posture == Posture::strap && s.p.bag[lane] == static_cast<int32_t>(Bag::backpack)) {
        bool both = s.p.free_hands[lane] == 3 && random_unit(chance, 3) < 0.5f;
        pair.own = Hold::pack_strap, pair.other = both ? Hold::pack_strap : Hold::none;
    }
    g.posture[lane] = static_cast<int32_t>(posture);
    g.holds[side].wanted[lane] = static_cast<int32_t>(pair.own);
    g.holds[side == k_left ? k_right : k_left].wanted[lane] = static_cast<int32_t>(pair.other);
}

void ask(GaitBlock& g, const Stroller& s, RandomKey chance, uint32_t tick) {
    int lane = s.lane;
    auto posture = static_cast<Posture>(g.posture[lane]);
    int32_t& next = g.next_posture[lane];
    chance.when = tick;
    auto wait = [&](float least, float most) {
        return static_cast<int32_t>(tick) + static_cast<int32_t>(random_between(chance, least, most, 4) * 60);
    };
    bool touches = g.hands[k_left].reach[lane] > 0 || g.hands[k_right].reach[lane] > 0;
    if (posture != Posture::hang && (touches || !may_keep(s, posture))) {
        take(g, s, Posture::hang, chance);
        next = wait(3, 12);
    }
    Doing doing = doing_of(s);
    if (doing == Doing::else_ || touches) return;
    if (static_cast<int32_t>(doing) != g.doing[lane]) next = std::min(next, wait(0.5f, 6));
    g.doing[lane] = static_cast<int32_t>(doing);
    if (static_cast<int32_t>(tick) < next) return;
    take(g, s, choose_posture(s, doing, chance), chance);
    next = wait(k_shortest, k_longest);
}

}  // namespace

void set_hold(GaitBlock& g, const PersonBlock& person, int lane, Side side, Hold wanted, float time, float dt,
              Vec3 moved) {
    HoldBlock& hold = g.holds[side];
    float& share = hold.share[lane];
    int32_t &kind = hold.kind[lane], asked = static_cast<int32_t>(wanted);
    if (share == 0) kind = asked;
    if (kind == 0) return;
    bool is_there = share == 1 && kind == asked;
    if (is_there && moved.x == 0 && moved.y == 0 && moved.z == 0) return;
    share = clamp(kind == asked ? share + dt / time : share - dt / time, 0, 1);
    put_hand(hold, person, lane, side, moved);
    if (share == 0) kind = 0;
}

void advance_holds(Gait& gait, size_t begin, size_t end, const RootMotion& root, uint64_t seed, uint32_t tick,
                   float dt) {
    for (size_t i = begin; i < end; ++i) {
        GaitBlock& g = gait.blocks[i / k_block];
        const PersonBlock& p = gait.people[i / k_block];
        int lane = static_cast<int>(i % k_block);
        if (p.postures[0][lane] == 0) continue;
        auto walker = static_cast<uint32_t>(i);
        bool asks = tick % k_ask_ticks == walker % k_ask_ticks;
        if (!asks && is_settled(g.holds[k_left], lane) && is_settled(g.holds[k_right], lane)) continue;
        Vec2 wish = root.wish ? root.wish[i] : root.velocity[i];
        Stroller s{g, p, lane, length(root.velocity[i]), length(wish)};
        RandomKey chance{seed, walker, 0, Purpose::hold};
        if (asks) ask(g, s, chance, tick);
        bool leaves = s.wish > k_sets_off && g.posture[lane] == 0;
        float time = (leaves ? k_hurry : 1) * k_time * random_between(chance, 0.8f, 1.4f, 1);
        for (Side side : {k_left, k_right})
            set_hold(g, p, lane, side, static_cast<Hold>(g.holds[side].wanted[lane]), time, dt);
    }
}

}  // namespace flaneur
