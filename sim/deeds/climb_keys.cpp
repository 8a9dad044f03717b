#include "sim/deeds/climb_keys.h"

#include <algorithm>
#include <cassert>

#include "sim/base/math.h"
#include "sim/gait/gait.h"

namespace flaneur {

namespace {

void set(ClimbKey& key, size_t channel, Vec3 v) {
    key[channel] = v.x, key[channel + 1] = v.y, key[channel + 2] = v.z;
}

struct Maker {
    ClimbKeys keys;
    ClimbKey now{};
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

}  // namespace

ClimbKeys keys_to_step(const ClimbSizes& s, const ClimbStances& st) {
    Maker m;
    const float k = s.k, over = s.height + s.ankle + 0.07f * k, near = s.half + 0.16f * k,
                far = s.half + 0.12f * k;
    const Vec3 palm{-0.42f * k, s.height, 0.4f * s.half};
    const float high = st.hips[0].y;
    m.hips(st.hips[0]);
    for (const Side side : {k_left, k_right}) m.foot(side, st.ankles[0][side], 0, 0);
    m.hand(k_left, palm + Vec3{0.6f * k, 0.3f * k, 0}, 0, 0);
    m.hand(k_right, palm + Vec3{0, 0.2f * k, -0.1f * k}, 0, 0), m.put(0);
    m.hips({st.hips[0].x - 0.03f * k, high - 0.05f * k, st.hips[0].z - 0.02f * k});
    const float low = clamp(150 * (0.56f - s.height / s.leg), 0, 12);  // degrees that it bends one more
    m.turn(-6, 26 + low, 26, 0), m.hand(k_right, palm, 1, 0), m.put(0.6f);
    m.hips({st.hips[0].x - 0.05f * k, high - 0.08f * k, st.hips[0].z - 0.03f * k});
    m.turn(-4, 12 + low, 34, -6), m.foot(k_left, {0.14f * k, over, -near}, 1, 0.25f), m.put(0.45f);
    m.hips({-0.05f * k, high - 0.08f * k, -near});
    m.foot(k_right, st.ankles[0][k_right], 0, 0.42f);
    m.turn(0, 12 + low, 34, -4), m.foot(k_left, {0.13f * k, over, far}, 1, 0.15f), m.put(0.42f);
    m.hips({-0.01f * k, high - clamp(0.13f - 0.6f * (s.height / s.leg - 0.5f), 0.07f, 0.13f) * k, 0.02f * k});
    m.foot(k_right, st.ankles[0][k_right] + Vec3{0, 0.1f * k, 0.0f * k}, 0.5f, 0.9f);
    m.turn(0, 16, 30, 0), m.foot(k_left, st.ankles[1][k_left], 0, 0.1f), m.put(0.42f);
    m.hips({0.04f * k, high - 0.08f * k, 0.2f * k});
    m.turn(-34, 16, 30, 10), m.foot(k_right, {-0.2f * k, over + 0.05f * k, -near - 0.1f * k}, 1, 0.6f);
    m.hand(k_right, palm + Vec3{-0.2f * k, 0.3f * k, 0.2f * k}, 0.8f, -10), m.put(0.48f);
    m.hips({0.06f * k, high - 0.04f * k, 0.3f * k});
    m.turn(-20, 10, 24, 8), m.foot(k_left, st.ankles[1][k_left], 0, 0);
    m.foot(k_right, {-0.16f * k, over + 0.05f * k, far}, 1, 0.4f);
    m.hand(k_right, palm + Vec3{-0.25f * k, 0.4f * k, 0.25f * k}, 0.8f, -10), m.put(0.4f);
    m.hips({st.hips[1].x + 0.02f * k, high - 0.02f * k, st.hips[1].z - 0.03f * k});
    m.now[c_hold + 1] = 0;  // of the right hand
    m.turn(0, 6, 8, 0), m.foot(k_right, st.ankles[1][k_right], 0, 0), m.put(0.45f);
    m.hips(st.hips[1]), m.turn(0, 0, 0, 0), m.put(0.4f);
    return m.keys;
}

ClimbKeys keys_to_sit(const ClimbSizes& s, const ClimbStances& st) {
    Maker m;
    const float k = s.k, h = s.height, over = h + s.ankle + 0.07f * k, out = s.half + 0.16f * k;
    const float sits = h + s.seat, x = -0.14f * k;
    const Vec3 left_palm{0.34f * k, h, 0.0f}, right_palm{0.05f * k, h, -0.35f * s.half};
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
    m.hips({st.hips[0].x, 0.5f * (st.hips[0].y + up), st.hips[0].z - 0.06f * k});
    m.turn(8, 14, 30, 12);
    m.foot(
        k_left,
        {st.ankles[0][k_left].x, std::max(0.5f * (st.hips[0].y + up) - 0.95f * s.leg, st.ankles[0][k_left].y),
         st.ankles[0][k_left].z},
        up > 1.01f * st.hips[0].y ? 0.6f : 0.0f, 0);
    m.foot(k_right, {-0.46f * k, 0.6f * h, -out - 0.22f * k}, 1, 1), m.put(0.42f);
    m.hips({x * 0.6f, up, near});
    m.turn(10, 6, 36, 16);
    m.hand(k_left, left_palm, 1, 10), m.hand(k_right, right_palm, 1, 15);
    m.foot(k_right, {-0.52f * k, over + 0.02f * k, -out - 0.06f * k}, 1, 1);
    m.foot(k_left, {st.ankles[0][k_left].x, lifted, near - 0.03f * k}, 1, 0), m.put(0.4f);
    m.hips({x, std::max(sits + 0.13f * k, up), -0.5f * s.half});
    m.turn(56, 10, 46, 10);
    m.hand(k_left, left_palm, 1, 40), m.hand(k_right, right_palm, 1, 50);
    m.foot(k_left, {x + 0.1f * k, std::max(sits - 0.86f * s.leg, s.ankle + 0.05f * k), -s.half - 0.22f * k},
           1, 0.6f);
    m.foot(k_right, {-0.4f * k, over, out}, 1, 0.6f), m.put(0.45f);
    // Astride.
    m.hips({x, sits, 0});
    m.turn(88, 18, 44, 0);
    m.hand(k_left, left_palm, 1, 65), m.hand(k_right, right_palm, 1, 80);
    m.foot(k_right, astride(k_right), 1, 0.45f), m.foot(k_left, astride(k_left), 1, 0.45f);
    m.put(0.5f);
    // One hand and then the other go behind, over the thighs, and the trunk leans back.
    const Vec3 right_behind{x - 0.27f * k, h, 0.4f * s.half}, left_behind{x - 0.16f * k, h, -0.6f * s.half};
    m.hips({x, sits, 0.01f});
    m.turn(90, 2, 6, 2);
    m.hand(k_right, {x + 0.25f * k, h + 0.38f * k, s.half + 0.2f * k}, 0.85f, 90), m.put(0.32f);
    m.turn(94, -10, 4, 2);
    m.hand(k_right, right_behind, 1, 100);
    m.hand(k_left, {x + 0.18f * k, h + 0.37f * k, -s.half - 0.22f * k}, 0.85f, 80), m.put(0.36f);
    m.turn(94, -16, 4, 2);
    m.hand(k_left, left_behind, 1, 80);
    m.foot(k_left, {x + 0.46f * k, std::max(h - 0.1f * k, s.ankle + 0.1f), -s.half - 0.24f * k}, 1, 0.2f),
        m.put(0.38f);
    // The left leg over.
    m.turn(98, -18, 4, 4), m.hips({x, sits + 0.02f * k, 0.02f});
    m.foot(k_left, {x + 0.6f * k, over + 0.05f * k, -out}, 1, 0.1f), m.put(0.38f);
    m.turn(64, -14, 6, 2);
    m.hand(k_left, {x + 0.02f * k, h + 0.14f * k, -s.half - 0.08f * k}, 0.8f, 40);
    m.hand(k_right, right_behind, 1, 60);
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
    for (const Side side : {k_left, k_right}) m.now[c_hold + static_cast<size_t>(side)] = 0.5f;
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

ClimbKey at_time(const ClimbKeys& keys, float time) {
    size_t n = 0;
    while (n + 2 < keys.count && keys.all[n + 1][c_time] <= time) ++n;
    const ClimbKey &a = keys.all[n], &b = keys.all[n + 1];
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
    ClimbKey now = a;
    now[c_time] = time;
    const float t2 = t * t, t3 = t2 * t;
    for (size_t c = c_time + 1; c < k_channels; ++c)
        now[c] = (2 * t3 - 3 * t2 + 1) * a[c] + (t3 - 2 * t2 + t) * span * tangent(n, c) +
                 (3 * t2 - 2 * t3) * b[c] + (t3 - t2) * span * tangent(n + 1, c);
    return now;
}

}  // namespace flaneur
