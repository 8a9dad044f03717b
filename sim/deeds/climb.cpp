#include "sim/deeds/climb.h"

#include <algorithm>
#include <cassert>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/pose/arm.h"

namespace flaneur {

namespace {

// One moment: places from the middle of the wall's foot, x to the left of the way, y up, z along it, metres;
// angles in radians.
enum Channel : size_t {
    c_time,
    c_hips,                // three
    c_yaw = c_hips + 3,    // of the hips, to the left
    c_pitch,               // of the hips, ahead
    c_bow,                 // of the trunk against them, ahead
    c_tilt,                // of the hips, to the left
    c_foot,                // three of each ankle
    c_free = c_foot + 6,   // of each foot: 0 as the gait stands .. 1 hangs
    c_splay = c_free + 2,  // of each knee: 0 ahead .. 1 outward
    c_hand = c_splay + 2,  // three of each palm
    c_hold = c_hand + 6,   // of each hand: 0 hangs .. 1 is there
    c_point = c_hold + 2,  // of the fingers of each, yaw to the left of the way
    k_channels = c_point + 2
};
using Key = std::array<float, k_channels>;
constexpr size_t k_most_keys = 16;
struct Keys {
    std::array<Key, k_most_keys> all;
    size_t count = 0;
};

struct Sizes {
    float k, leg, seat, half, height, ankle;
};
Sizes sizes_of(const Deeds& d, size_t i, const LowWall& wall) {
    const Body& b = d.bodies[i];
    const float k = b.height / 1.75f;
    return {k, leg_length(b), 0.115f * k, 0.5f * wall.thick, wall.height, b.joints[left_foot].y};
}

Vec3 get(const Key& key, size_t channel) { return {key[channel], key[channel + 1], key[channel + 2]}; }
void set(Key& key, size_t channel, Vec3 v) {
    key[channel] = v.x, key[channel + 1] = v.y, key[channel + 2] = v.z;
}

// How one stands before and after, in the wall's frame.
struct Stances {
    Vec3 hips[2], ankles[2][2];  // before and behind, left and right
};

struct Maker {
    Keys keys;
    Key now{};
    void put(float after) {
        assert(keys.count < k_most_keys);
        now[c_time] += after;
        keys.all[keys.count++] = now;
    }
    void hips(Vec3 at) { set(now, c_hips, at); }
    void turn(float yaw, float pitch, float bow, float tilt) {
        now[c_yaw] = yaw * k_radians, now[c_pitch] = pitch * k_radians;
        now[c_bow] = bow * k_radians, now[c_tilt] = tilt * k_radians;
    }
    void foot(Side side, Vec3 at, float is_free, float splay) {
        set(now, c_foot + 3 * static_cast<size_t>(side), at);
        now[c_free + static_cast<size_t>(side)] = is_free, now[c_splay + static_cast<size_t>(side)] = splay;
    }
    void hand(Side side, Vec3 at, float hold, float point) {
        set(now, c_hand + 3 * static_cast<size_t>(side), at);
        now[c_hold + static_cast<size_t>(side)] = hold;
        now[c_point + static_cast<size_t>(side)] = point * k_radians;
    }
};

// Leading with the left leg, the right hand on the wall.
Keys keys_to_step(const Sizes& s, const Stances& st) {
    Maker m;
    const float k = s.k, over = s.height + s.ankle + 0.07f * k, near = s.half + 0.16f * k,
                far = s.half + 0.12f * k;
    const Vec3 palm{-0.3f * k, s.height, 0.4f * s.half};
    const float high = st.hips[0].y;
    m.hips(st.hips[0]);
    for (const Side side : {k_left, k_right}) m.foot(side, st.ankles[0][side], 0, 0);
    m.hand(k_left, palm + Vec3{0.6f * k, 0.3f * k, 0}, 0, 0);
    m.hand(k_right, palm + Vec3{0, 0.2f * k, -0.1f * k}, 0, 0), m.put(0);
    m.hips({st.hips[0].x - 0.03f * k, high - 0.05f * k, st.hips[0].z - 0.02f * k});
    m.turn(-6, 26, 26, 0), m.hand(k_right, palm, 1, 0), m.put(0.6f);
    m.hips({st.hips[0].x - 0.05f * k, high - 0.03f * k, st.hips[0].z - 0.05f * k});
    m.turn(-4, 12, 34, -6), m.foot(k_left, {0.14f * k, over, -near}, 1, 0.25f), m.put(0.45f);
    m.hips({-0.05f * k, high - 0.06f * k, -near + 0.02f * k});
    m.turn(0, 12, 34, -4), m.foot(k_left, {0.13f * k, over, far}, 1, 0.15f), m.put(0.42f);
    m.hips({-0.01f * k, high - 0.11f * k, 0.03f * k});
    m.foot(k_right, st.ankles[0][k_right] + Vec3{0, 0.07f * k, 0.04f * k}, 0.5f, 0.9f);
    m.turn(0, 16, 30, 0), m.foot(k_left, st.ankles[1][k_left], 0, 0.1f), m.put(0.42f);
    m.hips({0.04f * k, high - 0.07f * k, 0.14f * k});
    m.turn(-34, 16, 30, 10), m.foot(k_right, {-0.34f * k, over + 0.03f * k, -near - 0.08f * k}, 1, 1);
    m.hand(k_right, palm, 0.9f, 0), m.put(0.48f);
    m.hips({0.06f * k, high - 0.04f * k, 0.24f * k});
    m.turn(-20, 10, 24, 8), m.foot(k_left, st.ankles[1][k_left], 0, 0);
    m.foot(k_right, {-0.26f * k, over + 0.03f * k, far}, 1, 0.7f);
    m.hand(k_right, palm + Vec3{-0.03f * k, 0.14f * k, 0.06f * k}, 0, -10), m.put(0.4f);
    m.hips({st.hips[1].x + 0.02f * k, high - 0.02f * k, st.hips[1].z - 0.03f * k});
    m.turn(0, 6, 8, 0), m.foot(k_right, st.ankles[1][k_right], 0, 0), m.put(0.45f);
    m.hips(st.hips[1]), m.turn(0, 0, 0, 0), m.put(0.4f);
    return m.keys;
}

// Leading with the right leg; turned to the left, astride.
Keys keys_to_sit(const Sizes& s, const Stances& st) {
    Maker m;
    const float k = s.k, h = s.height, over = h + s.ankle + 0.07f * k, out = s.half + 0.16f * k;
    const float sits = h + s.seat, x = -0.14f * k;
    const Vec3 left_palm{0.32f * k, h, 0.0f}, right_palm{0.0f, h, -0.2f * s.half};
    const float rides = std::max(h - 0.3f * k, s.ankle + 0.02f);  // of ankles, astride
    auto astride = [&](Side side) {
        const float z = s.half + 0.24f * k;
        return Vec3{x + 0.16f * k, rides, side == k_left ? -z : z};
    };
    m.hips(st.hips[0]);
    for (const Side side : {k_left, k_right}) m.foot(side, st.ankles[0][side], 0, 0);
    m.hand(k_left, left_palm + Vec3{0, 0.1f * k, -0.15f * k}, 0, 0);
    m.hand(k_right, right_palm + Vec3{-0.2f * k, 0.1f * k, -0.15f * k}, 0, 0), m.put(0);
    // Hands on it.
    const float stoop = clamp(1.15f * (1.02f - h / (1.1f * k)), 0, 1);
    m.hips({st.hips[0].x, st.hips[0].y - (0.04f + 0.1f * stoop) * k,
            st.hips[0].z - (0.02f + 0.05f * stoop) * k});
    m.turn(8, 10 + 22 * stoop, 12 + 30 * stoop, 0);
    m.hand(k_left, left_palm, 1, 0), m.hand(k_right, right_palm, 1, 0), m.put(0.65f);
    // The right leg up, the left one pushes off, and hangs.
    const float near = -s.half - 0.25f * k, up = std::max(sits - 0.03f * k, 0.96f * s.leg);
    const float lifted = std::max(up - 0.955f * s.leg, st.ankles[0][k_left].y);
    m.hips({st.hips[0].x, 0.5f * (st.hips[0].y + up), st.hips[0].z - 0.02f * k});
    m.turn(8, 14, 30, 12);
    m.foot(
        k_left,
        {st.ankles[0][k_left].x, std::max(0.5f * (st.hips[0].y + up) - 0.95f * s.leg, st.ankles[0][k_left].y),
         st.ankles[0][k_left].z},
        up > 1.01f * st.hips[0].y ? 0.6f : 0.0f, 0);
    m.foot(k_right, {-0.44f * k, 0.6f * h, -out - 0.16f * k}, 1, 1), m.put(0.42f);
    m.hips({x * 0.6f, up, near});
    m.turn(10, 6, 36, 16);
    m.hand(k_left, left_palm, 1, 10), m.hand(k_right, right_palm, 1, 15);
    m.foot(k_right, {-0.52f * k, over + 0.02f * k, -out - 0.06f * k}, 1, 1);
    m.foot(k_left, {st.ankles[0][k_left].x, lifted, near - 0.03f * k}, 1, 0), m.put(0.4f);
    m.hips({x, std::max(sits + 0.07f * k, up), -0.5f * s.half});
    m.turn(56, 10, 46, 10);
    m.hand(k_left, left_palm, 1, 40), m.hand(k_right, right_palm, 1, 50);
    m.foot(k_left, {x + 0.1f * k, std::max(sits - 0.86f * s.leg, s.ankle + 0.05f * k), -s.half - 0.22f * k},
           1, 0.3f);
    m.foot(k_right, {-0.4f * k, over, out}, 1, 0.6f), m.put(0.45f);
    // Astride.
    m.hips({x, sits, 0});
    m.turn(88, 18, 44, 0);
    m.hand(k_left, left_palm, 1, 65), m.hand(k_right, right_palm, 1, 80);
    m.foot(k_right, astride(k_right), 1, 0.45f), m.foot(k_left, astride(k_left), 1, 0.45f);
    m.put(0.5f);
    // The right hand goes behind, the trunk leans back.
    m.hips({x, sits, 0.01f});
    m.turn(90, 2, 6, 2);
    m.hand(k_right, {x - 0.1f * k, h + 0.13f * k, 0.8f * s.half}, 0.85f, 90), m.put(0.3f);
    m.turn(94, -14, 4, 2);
    m.hand(k_right, {x - 0.27f * k, h, 0.4f * s.half}, 1, 100);
    m.hand(k_left, left_palm, 0.9f, 60);
    m.foot(k_left, {x + 0.46f * k, std::max(h - 0.1f * k, s.ankle + 0.1f), -s.half - 0.24f * k}, 1, 0.2f),
        m.put(0.38f);
    // The left leg over.
    m.hand(k_left, left_palm + Vec3{-0.05f * k, 0.16f * k, 0}, 0.3f, 30);
    m.turn(98, -18, 4, 4), m.hips({x, sits + 0.02f * k, 0.02f});
    m.foot(k_left, {x + 0.6f * k, over + 0.05f * k, -out}, 1, 0.1f), m.put(0.38f);
    m.turn(64, -14, 6, 2);
    m.hand(k_left, {x + 0.3f * k, h + 0.13f * k, -0.5f * s.half}, 0.5f, 20);
    m.hand(k_right, {x - 0.27f * k, h, 0.4f * s.half}, 1, 60);
    m.foot(k_right, {x + 0.1f * k, rides, s.half + 0.26f * k}, 1, 0.3f);
    m.foot(k_left, {x + 0.54f * k, over + 0.05f * k, out}, 1, 0.1f), m.put(0.42f);
    // Sits, both hands beside.
    const float below = std::max(h - 0.3f * k, s.ankle + 0.03f), knee = s.half + 0.3f * k;
    m.turn(4, -6, 18, 0), m.hips({x, sits, 0.4f * s.half});
    m.hand(k_left, {x + 0.25f * k, h, 0.3f * s.half}, 1, 10),
        m.hand(k_right, {x - 0.25f * k, h, 0.3f * s.half}, 1, -10);
    m.foot(k_left, {x + 0.1f * k, below, knee}, 1, 0), m.foot(k_right, {x - 0.1f * k, below, knee}, 1, 0);
    m.put(0.5f);
    // Slides down.
    const float front = s.half + 0.15f * k;
    m.turn(0, 2, 18, 0), m.hips({x, sits - 0.01f * k, s.half + 0.07f * k});
    for (const Side side : {k_left, k_right})
        m.foot(side, st.ankles[1][side] + Vec3{0, std::max(sits - 0.97f * s.leg - s.ankle, 0.0f), 0}, 0.4f,
               0);
    m.put(0.4f);
    for (const Side side : {k_left, k_right}) m.now[c_hold + static_cast<size_t>(side)] = 0;
    m.turn(0, 6, 16, 0);
    m.hips({0.5f * (x + st.hips[1].x), std::min(sits, 0.93f * s.leg), std::max(front, 0.6f * st.hips[1].z)});
    for (const Side side : {k_left, k_right}) m.foot(side, st.ankles[1][side], 0, 0);
    m.put(0.4f);
    m.hips({st.hips[1].x, st.hips[1].y - 0.05f * k, st.hips[1].z - 0.01f}), m.turn(0, 6, 8, 0);
    m.put(0.4f);
    m.hips(st.hips[1]), m.turn(0, 0, 0, 0), m.put(0.35f);
    return m.keys;
}

// Monotone cubic curves through the keys (Fritsch & Carlson, SIAM Journal on Numerical Analysis 17, 1980):
// nothing leaves the span of two keys, and what is alike in two of them does not move between.
Key at_time(const Keys& keys, float time) {
    size_t n = 0;
    while (n + 2 < keys.count && keys.all[n + 1][c_time] <= time) ++n;
    const Key &a = keys.all[n], &b = keys.all[n + 1];
    const float span = b[c_time] - a[c_time], t = clamp((time - a[c_time]) / span, 0, 1);
    auto slope = [&](size_t from, size_t c) {
        return (keys.all[from + 1][c] - keys.all[from][c]) /
               (keys.all[from + 1][c_time] - keys.all[from][c_time]);
    };
    auto tangent = [&](size_t at, size_t c) {
        if (at == 0 || at + 1 >= keys.count) return 0.0f;
        const float before = slope(at - 1, c), after = slope(at, c);
        if (before * after <= 0) return 0.0f;
        return 2 * before * after / (before + after);  // their harmonic mean
    };
    Key now = a;
    now[c_time] = time;
    const float t2 = t * t, t3 = t2 * t;
    for (size_t c = c_time + 1; c < k_channels; ++c)
        now[c] = (2 * t3 - 3 * t2 + 1) * a[c] + (t3 - 2 * t2 + t) * span * tangent(n, c) +
                 (3 * t2 - 2 * t3) * b[c] + (t3 - t2) * span * tangent(n + 1, c);
    return now;
}

// The wall's frame, as the way goes over it.
struct Over {
    Vec3 foot;  // of its middle
    float yaw;  // of the way
    Vec3 world(Vec3 own) const { return foot + rotate(rotation_y(yaw), own); }
    Vec3 own(Vec3 world) const { return rotate(rotation_y(-yaw), world - foot); }
};
// Along the wall where `from` is.
Over over_of(const LowWall& wall, Vec2 from, bool onward) {
    const Vec2 along = heading_direction(wall.heading + 0.5f * k_pi);
    const float far = clamp(dot(from - wall.at, along), -wall.half_long, wall.half_long);
    return {at_height(wall.at + along * far, wall.floor), onward ? wall.heading : wall.heading + k_pi};
}

bool is_onward(const LowWall& wall, Vec2 from) {
    return dot(from - wall.at, heading_direction(wall.heading)) < 0;
}

float behind(const Deeds& d, size_t i, const LowWall& wall) {
    return 0.5f * wall.thick + d.bodies[i].heel + 0.13f * d.bodies[i].height / 1.75f;
}
float before(const Deeds& d, size_t i, const LowWall& wall) {
    return 0.5f * wall.thick + toes_ahead(d, i) + 0.1f;
}

// How one stands, by the gait's pose on this side or on the other one.
Stances stances_of(const Over& over, const BodyPose& stands, Someone who, float far, bool has_crossed) {
    Stances st;
    const auto places = places_of(stands, who.person, who.lane);
    const Vec3 by{0, 0, far}, here = has_crossed ? -by : Vec3{}, there = has_crossed ? Vec3{} : by;
    const Vec3 hips_own = over.own(stands.hips);
    st.hips[0] = hips_own + here, st.hips[1] = hips_own + there;
    for (const Side side : {k_left, k_right}) {
        const Vec3 ankle = over.own(places[side == k_left ? left_foot : right_foot]);
        st.ankles[0][side] = ankle + here, st.ankles[1][side] = ankle + there;
    }
    return st;
}

Keys keys_of(const Deeds& d, size_t i, const LowWall& wall, const Stances& st) {
    const Sizes s = sizes_of(d, i, wall);
    return s.height < k_steps_over * s.leg ? keys_to_step(s, st) : keys_to_sit(s, st);
}

// A leg to its ankle, its knee towards `pole`.
void leg_to(BodyPose& pose, Someone who, Side side, Vec3 ankle, Vec3 pole) {
    const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
    const auto places = places_of(pose, who.person, who.lane);
    const Vec3 hip = places[thigh];
    const float a = length(places[thigh + 1] - hip), b = length(places[thigh + 2] - places[thigh + 1]);
    const Vec3 way = normalize_or(ankle - hip, {0, -1, 0});
    const float reach = clamp(length(ankle - hip), std::fabs(a - b) + 0.12f * (a + b), 0.9985f * (a + b));
    const Vec3 bow = normalize_or(pole - way * dot(pole, way), pole);
    const float ahead = (a * a - b * b + reach * reach) / (2 * reach);
    const Vec3 knee = way * ahead + bow * std::sqrt(std::max(a * a - ahead * ahead, 0.0f)), end = way * reach;
    pose.rotation[thigh] = bone_rotation(normalize_or(knee, way), bow);
    pose.rotation[thigh + 1] = bone_rotation(normalize_or(end - knee, way), bow);
}

Quat tilted(float yaw, float pitch, float tilt) {
    return normalize(rotation_y(yaw) * rotation_z(-tilt) * rotation_x(pitch));
}

struct Climbing {
    const LowWall* wall = nullptr;
    Over over;
    Keys keys;
    Key now;
};
Climbing climbing_of(const Deeds& d, size_t i, const BodyPose& stands) {
    const Doer& doer = d.doers[i];
    Climbing c;
    c.wall = &d.things.walls[deed_of(d, i).thing];
    const bool onward = doer.side.x > 0, has_crossed = doer.has != 0;
    c.over = over_of(*c.wall, deed_of(d, i).at, onward);
    c.keys = keys_of(d, i, *c.wall, stances_of(c.over, stands, someone(d, i), doer.side.z, has_crossed));
    c.now = at_time(c.keys, seconds_in(doer));
    return c;
}

}  // namespace

Spot before_wall(const Deeds& d, size_t i, const LowWall& wall, bool onward) {
    const Over over = over_of(wall, deed_of(d, i).at, onward);
    return {on_ground(over.world({0, 0, -before(d, i, wall)})), over.yaw};
}

float climb_seconds(const Deeds& d, size_t i, const LowWall& wall) {
    const Keys keys = keys_of(d, i, wall, {});
    return keys.all[keys.count - 1][c_time];
}

DoerWish climb(Deeds& d, size_t i) {
    Doer& doer = d.doers[i];
    const LowWall& wall = d.things.walls[deed_of(d, i).thing];
    switch (doer.stage) {
        case DoerStage::go: {
            const bool onward = is_onward(wall, on_ground(doer.position));
            const Spot spot = before_wall(d, i, wall, onward);
            if (is_at(d, i, spot)) {
                next_stage_of(doer, DoerStage::act);
                const Vec2 way = heading_direction(spot.heading);
                const float from = dot(on_ground(doer.position) - wall.at, way);
                doer.side = {onward ? 1.0f : -1.0f, behind(d, i, wall) - from};
                doer.has = 0;
                return {{}, way};
            }
            return wish_to(doer, spot, d.plans[i].speed);
        }
        case DoerStage::act: {
            const float all = climb_seconds(d, i, wall),
                        yaw = doer.side.x > 0 ? wall.heading : wall.heading + k_pi;
            const Vec2 way = heading_direction(yaw);
            if (doer.has == 0 && seconds_in(doer) > 0.5f * all) {
                // The gait stands on the other side from now on; the body follows.
                const Vec3 by = at_height(way * doer.side.z, 0);
                carry_feet(d.gait, i, doer.position, 0, by);
                doer.position += by;
                doer.has = 1;
            }
            if (seconds_in(doer) < all) return {{}, way};
            doer.has = 0;
            next_deed(d, doer, i);
            return {{}, way};
        }
        default:
            return {};
    }
}

void pose_climbing(const Deeds& d, size_t i, BodyPose& pose) {
    const Doer& doer = d.doers[i];
    if (deed_of(d, i).what != Deed::What::climb || doer.stage != DoerStage::act) return;
    const Someone who = someone(d, i);
    const BodyPose stands = pose;
    const Climbing c = climbing_of(d, i, stands);
    const Key& now = c.now;
    const float seconds = seconds_in(doer), all = c.keys.all[c.keys.count - 1][c_time];
    pose.hips = c.over.world(get(now, c_hips));
    const Quat root = normalize(tilted(c.over.yaw + now[c_yaw], now[c_pitch], now[c_tilt]));
    pose.rotation.fill(root);
    turn_trunk(pose, now[c_bow], 0);
    // As the gait has it, from and to its hold.
    constexpr float k_blend = 0.4f;
    const float share = smoothstep(0, k_blend, seconds) * (1 - smoothstep(all - k_blend, all, seconds));
    const Vec3 hips_at = pose.hips;
    for (const Side side : {k_left, k_right}) {
        const size_t first = side == k_left ? left_upper_arm : right_upper_arm;
        Quat above = stands.rotation[upper_chest], on = pose.rotation[upper_chest];
        for (size_t j = first - 1; j < first + 3; ++j) {
            on = normalize(on * (conjugate(above) * stands.rotation[j]));
            above = stands.rotation[j], pose.rotation[j] = on;
        }
    }
    for (const Side side : {k_left, k_right}) {
        const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
        const auto n = static_cast<size_t>(side);
        const float out = side == k_left ? 1.0f : -1.0f, splay = now[c_splay + n], is_free = now[c_free + n];
        const Vec3 pole = rotate(root, {out * (0.1f + splay), 0.6f, 1 - 0.85f * splay});
        leg_to(pose, who, side, c.over.world(get(now, c_foot + 3 * n)), normalize_or(pole, {0, 0, 1}));
        keep_hip_within(pose, side, smoothstep(0, 1, is_free));
        const Quat hanging = normalize(pose.rotation[thigh + 1] * rotation_x(0.35f));
        pose.rotation[thigh + 2] = nlerp(stands.rotation[thigh + 2], hanging, smoothstep(0, 1, is_free));
        pose.rotation[thigh + 3] = nlerp(stands.rotation[thigh + 3], hanging, smoothstep(0, 1, is_free));
    }
    if (share < 1) {
        pose = mixed(stands, pose, share);
        pose.hips = hips_at;
        for (const Side side : {k_left, k_right}) {
            const size_t thigh = side == k_left ? left_upper_leg : right_upper_leg;
            const auto n = static_cast<size_t>(side);
            const Vec3 front = rotate(pose.rotation[thigh], {0, 0, 1});
            leg_to(pose, who, side, c.over.world(get(now, c_foot + 3 * n)), front);
            if (now[c_free + n] <= 0) {
                pose.rotation[thigh + 2] = stands.rotation[thigh + 2];
                pose.rotation[thigh + 3] = stands.rotation[thigh + 3];
            }
        }
    }
    const Vec3 ahead = c.over.world({now[c_hips], 0.35f * c.wall->height, now[c_hips + 2] + 0.9f});
    look_at(pose, who, ahead, 0.75f * share);
    auto palm_on = [&](size_t n) {
        Palm palm;
        palm.place = c.over.world(get(now, c_hand + 3 * n));
        palm.faces = {0, -1, 0};
        palm.fingers = at_height(heading_direction(c.over.yaw + now[c_point + n]), 0);
        return palm;
    };
    for (const Side side : {k_left, k_right}) {
        const auto n = static_cast<size_t>(side);
        const float holds = now[c_hold + n];
        lean_to(pose, who, side, wrist_of(palm_on(n), who, side).position, smoothstep(0, 1, holds), 0.75f);
    }
    for (const Side side : {k_left, k_right}) {
        const auto n = static_cast<size_t>(side);
        const Palm palm = palm_on(n);
        // Elbows go back and out of where the hips face, however the trunk bends.
        const float out = side == k_left ? 1.0f : -1.0f;
        Vec3 elbow = rotate(conjugate(pose.rotation[upper_chest]) * rotation_y(c.over.yaw + now[c_yaw]),
                            {0.6f * out, 0, -1});
        elbow.x *= out;
        reach_for(pose, who, side, palm, elbow, smoothstep(0, 1, now[c_hold + n]));
    }
}

ClimbHolds climb_holds(const Deeds& d, size_t i) {
    ClimbHolds holds;
    const Doer& doer = d.doers[i];
    if (deed_of(d, i).what != Deed::What::climb || doer.stage != DoerStage::act) return holds;
    const Climbing c = climbing_of(d, i, body_pose_of(d.whole, i));
    for (size_t n = 0; n < 2; ++n) {
        holds.palms[n] = c.over.world(get(c.now, c_hand + 3 * n));
        holds.hands[n] = c.now[c_hold + n] >= 0.999f && c.now[c_hand + 3 * n + 1] <= c.wall->height + 0.001f;
        holds.feet[n] = c.now[c_free + n] <= 0.001f;
    }
    return holds;
}

}  // namespace flaneur
