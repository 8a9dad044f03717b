// How high the body rides, over float or Lanes.
#if defined(FLANEUR_SIM_GAIT_HEIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_GAIT_HEIGHT_INL_H
#undef FLANEUR_SIM_GAIT_HEIGHT_INL_H
#else
#define FLANEUR_SIM_GAIT_HEIGHT_INL_H
#endif

#include "sim/base/rows-inl.h"
#include "sim/body/body.h"
#include "sim/gait/curves/norms.h"
#include "sim/gait/curves/rise-inl.h"
#include "sim/gait/curves/swing-inl.h"
#include "sim/gait/rows.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

inline constexpr float k_base_stiffness = 12;      // 1/s, critically damped
inline constexpr float k_step_down_least = 0.03f;  // metres
inline constexpr float k_farthest_ahead = 0.6f;    // seconds that are foreseen
inline constexpr float k_soonest = 0.08f;          // seconds
inline constexpr float k_most_effort = 9;          // m/s2
inline constexpr float k_most_lift = 5;            // m/s2, with which one lifts oneself
// Of a step that a small child climbs: share by which it rises while both feet stand, and share of the swing
// until which it has risen.
inline constexpr float k_child_rises = 0.3f, k_child_lifts = 0.8f;
inline constexpr float k_let_down_effort = 5,
                       k_first_effort = 6;  // m/s2, from which on one lets the body down
inline constexpr float k_descends = 0.1f;  // metres for each metre ahead, of one who goes down stairs already
inline constexpr float k_lets_down = 0.05f;        // m/s, of one who has begun to
inline constexpr float k_lets_down_later = 0.06f;  // seconds after a foot lands off a kerb, that it is down
// Down stairs the leg that lands takes up the rest of the fall: over so much of the time that both feet
// stand, but what is left is a share of the way, whose square times the way is so many legs.
inline constexpr float k_stairs_later = 1.2f, k_stairs_rest = 0.015f;
inline constexpr float k_step_most = 0.2f;    // metres
inline constexpr float k_most_sink = 0.2f;    // legs
inline constexpr float k_just_landed = 0.1f;  // of the cycle
// Of the cycle, until which a foot is flat; sine and cosine of twice that angle; seconds before it, in which
// what the leg then lets the pelvis is met.
inline constexpr float k_bears = 0.36f, k_bears_sine = -0.98229f, k_bears_cosine = -0.18738f;
inline constexpr float k_gives_soon = 0.2f;
// A heel begins to rise at such a time of a natural walk, shares of its cycle, a little before pose_foot lets
// it, and is tilted by so many radians as the foot leaves.
inline constexpr float k_heel_gives_from = 0.35f, k_heel_gives = 1.05f;
inline constexpr float k_heel_gives_pace = 0.6f;      // more for each pace over the natural one
inline constexpr float k_contact_pitch_sine = 0.27f;  // of a foot that comes down on its heel
inline constexpr float k_tiptoe_sine = 0.247f;        // of one that comes down on its ball

// FootPlaces of one lane, or of several.
template <class T>
struct Stand {
    V3<T> place;
    T yaw, nx, nz;
};
template <class T>
HWY_INLINE Stand<T> stand_at(const FootPlaces& p, size_t lane) {
    return {{row<T>(p.x, lane), row<T>(p.y, lane), row<T>(p.z, lane)},
            row<T>(p.yaw, lane),
            row<T>(p.normal_x, lane),
            row<T>(p.normal_z, lane)};
}
template <class M, class T>
HWY_INLINE Stand<T> select(M m, Stand<T> a, Stand<T> b) {
    return {select(m, a.place, b.place), select(m, a.yaw, b.yaw), select(m, a.nx, b.nx),
            select(m, a.nz, b.nz)};
}
// The height at `at` of the plane on which a foot stands there.
template <class T>
HWY_INLINE T height_on(const Stand<T>& foot, V2<T> at) {
    T ny = sqrt(max(T(1.0f) - foot.nx * foot.nx - foot.nz * foot.nz, T(0.01f)));
    return foot.place.y - (foot.nx * (at.x - foot.place.x) + foot.nz * (at.z - foot.place.z)) / ny;
}
// Metres by which a foot at `to` stands above the slope of the ground at `from`.
template <class T>
HWY_INLINE T step_between(const Stand<T>& from, const Stand<T>& to) {
    return step_between(
        SwingEnds<T>{from.place, to.place - from.place, from.nx, from.nz, to.nx - from.nx, to.nz - from.nz});
}

// What the heights of walkers side by side go by.
template <class T>
struct Climber {
    V2<T> root, velocity, wish, facing;
    T speed, leg, dt;
    T swings[2], stands;  // 0 or 1
    Stand<T> from[2], to[2], goal[2];
    T phase[2], rate[2], until[2];  // of feet; of the phase, 1/s; seconds until one that swings lands
    T on_from[2];                   // height_on(from) at the root
    T duty, tread, base, base_velocity, rise;
};

template <class T>
HWY_INLINE Climber<T> climber_at(const GaitBlock& g, const PersonBlock& p, const StepperRows& s, float dt,
                                 size_t lane) {
    Climber<T> c;
    c.root = {row<T>(s.x, lane), row<T>(s.z, lane)};
    c.velocity = {row<T>(s.velocity_x, lane), row<T>(s.velocity_z, lane)};
    c.wish = {row<T>(s.wish_x, lane), row<T>(s.wish_z, lane)};
    c.facing = {row<T>(s.facing_x, lane), row<T>(s.facing_z, lane)};
    c.speed = sqrt(dot(c.velocity, c.velocity));
    c.leg = row<T>(p.joints[left_upper_leg][1], lane);
    c.dt = T(dt);
    c.stands = row<T>(s.stands, lane);
    T frequency = row<T>(g.frequency, lane);
    for (int side = 0; side < 2; ++side) {
        const FootBlock& foot = g.feet[side];
        c.swings[side] = row<T>(s.swings[side], lane);
        c.from[side] = stand_at<T>(foot.from, lane);
        c.to[side] = stand_at<T>(foot.to, lane);
        c.goal[side] = stand_at<T>(foot.goal, lane);
        c.phase[side] = row<T>(foot.phase, lane);
        c.rate[side] = max(row<T>(foot.rate, lane), frequency * T(k_least_swing));
        c.until[side] = (T(1.0f) - c.phase[side]) / c.rate[side];
        c.on_from[side] = height_on(c.from[side], c.root);
    }
    c.duty = row<T>(g.duty, lane);
    c.tread = row<T>(g.tread, lane);
    c.base = row<T>(g.base, lane);
    c.base_velocity = row<T>(g.base_velocity, lane);
    c.rise = row<T>(g.rise, lane);
    return c;
}

// The acceleration that moves a body at `velocity` by so many metres in the time given, and leaves it at
// rest: one that changes evenly, whose square is the least over that time.
template <class T>
HWY_INLINE T least_effort(T by, T velocity, T seconds) {
    return clamp((T(6.0f) * by / seconds - T(4.0f) * velocity) / seconds, T(-k_most_effort),
                 T(k_most_effort));
}

// The height of the ground for the pelvis: that of the foot which carries it; of the lower foot when it steps
// down, by the time that foot lands; and it rises only as the higher foot takes the load.
template <class T>
HWY_INLINE T carrying_height(const Climber<T>& c, T load) {
    T half = T(0.5f), one = T(1.0f), left = c.on_from[k_left], right = c.on_from[k_right];
    T low = min(left, right), high = max(left, right);
    // Whoever has stepped down stays down.
    auto is_left_high = left > right;
    T last_left = select(c.phase[k_left] < c.phase[k_right], one, T(0.0f)),
      left_high = select(is_left_high, one, T(0.0f));
    auto has_stepped_down = (c.stands < half) & (abs(last_left - left_high) > half);
    auto is_child = c.leg < T(k_both_feet_leg);
    T share = select(is_left_high, load, one - load);
    share = share * select(is_child, T(k_child_rises), T(0.6f));
    T on_both = select(has_stepped_down, low, lerp(low, high, share));

    auto l = c.swings[k_left] > half, r = c.swings[k_right] > half, flies = l & r;
    T to_left = height_on(c.to[k_left], c.root), to_right = height_on(c.to[k_right], c.root);
    T from = select(flies, lerp(left, right, half), select(l, right, left));
    T to = select(flies, lerp(to_left, to_right, half), select(l, to_left, to_right));
    T phase = select(l, c.phase[k_left], c.phase[k_right]);
    T u = smoothstep(c.duty, lerp(c.duty, one, T(0.6f)), phase);
    T swinging = select(flies | (to < from), lerp(from, to, u), from);
    // A child lifts itself onto a step for most of the swing.
    auto climbs =
        is_child & (abs(c.swings[k_left] - c.swings[k_right]) > half) & (from - low > T(k_step_down_least));
    T up = smoothstep(c.duty, lerp(c.duty, one, T(k_child_lifts)), phase);
    swinging = select(climbs & (to >= from - T(k_step_down_least)),
                      lerp(low, from, lerp(T(k_child_rises), one, up)), swinging);
    return select(l | r, swinging, on_both);
}

// How a body is let down onto the lower foot that swings.
template <class T, class M>
struct Descent {
    M begins;        // that foot is to land lower than the one that carries, and than the body is
    T by;            // metres up that the body moves: 0 or less
    T until, later;  // seconds until the foot lands, and from then on until the body is down
    T from;          // height of the foot that carries
};

// Seconds from a landing, `drop` below the foot that carries, until the body is down: on stairs and off a
// kerb.
template <class T>
HWY_INLINE T down_later(const Climber<T>& c, T drop, T rate) {
    T both = max(c.duty - T(0.5f), T(0.0f));
    T rest = min(sqrt(T(k_stairs_rest) * c.leg / max(drop, T(k_step_down_least))), T(0.5f));
    T stairs = min(both * T(k_stairs_later), (T(1.0f) - c.duty) * rest / (T(1.0f) - rest)) / rate;
    stairs = select(c.leg < T(k_both_feet_leg), T(0.0f), stairs);
    return select(c.tread > T(0.0f), stairs, T(k_lets_down_later));
}

template <class T>
HWY_INLINE auto descent_of(const Climber<T>& c) {
    auto l = c.swings[k_left] > T(0.5f);
    auto one_swings = abs(c.swings[k_left] - c.swings[k_right]) > T(0.5f);
    T to = height_on(select(l, c.goal[k_left], c.goal[k_right]), c.root);
    T from = select(l, c.on_from[k_right], c.on_from[k_left]), by = to - c.base;
    auto begins = one_swings & (to <= from - T(k_step_down_least)) & (by <= T(0.0f));
    T rate = select(l, c.rate[k_left], c.rate[k_right]);
    T until = select(l, c.until[k_left], c.until[k_right]);
    return Descent<T, decltype(begins)>{begins, by, until, down_later(c, from - to, rate), from};
}

// Metres that the body is still above where it is let down to as the foot lands: what least_effort leaves.
template <class T, class M>
HWY_INLINE T left_at_landing(const Descent<T, M>& d, T velocity) {
    T whole = max(d.until + d.later, T(k_soonest)), share = min(d.later / whole, T(1.0f));
    T left = (T(0.0f) - d.by) * (T(3.0f) - T(2.0f) * share) + velocity * whole * (T(1.0f) - share);
    return max(left * share * share, T(0.0f));
}

// What speeds the body up or down with the ground: a spring, or what lets it down onto a lower foot.
template <class T>
HWY_INLINE T base_drive(const Climber<T>& c, T target) {
    T w = T(k_base_stiffness);
    auto stairs = (c.tread > T(0.0f)) & (c.rise < T(-k_descends));
    auto d = descent_of(c);
    T spring = min(w * w * (target - c.base) - T(2.0f) * w * c.base_velocity, T(k_most_lift));
    // Off a kerb, and onto the first stair, as late as may be, so that the knee which carries does not bend
    // for long; down stairs evenly.
    T effort = least_effort(d.by, c.base_velocity, max(d.until + d.later, T(k_soonest)));
    T waits = w * w * (d.from - c.base) - T(2.0f) * w * c.base_velocity;
    T hard = select(c.tread > T(0.0f), T(k_first_effort), T(k_let_down_effort));
    T urged = smoothstep(T(0.5f), T(1.0f), (T(0.0f) - effort) / hard);
    urged = select(stairs | (c.base_velocity < T(-k_lets_down)), T(1.0f), urged);
    return select(d.begins, lerp(min(waits, T(0.0f)), effort, urged), spring);
}

template <class T>
HWY_INLINE void advance_base(Climber<T>& c, T load) {
    // Slopes are met ahead of the spring. Down stairs it is not the spring that leads.
    T leads = select(c.tread > T(0.0f), max(c.rise, T(0.0f)), c.rise);
    T target = carrying_height(c, load) + T(1.2f / k_base_stiffness) * leads * c.speed;
    c.base_velocity = c.base_velocity + base_drive(c, target) * c.dt;
    c.base = c.base + c.base_velocity * c.dt;
    T rise =
        select(c.speed > T(0.2f), clamp(c.base_velocity / max(c.speed, T(0.2f)), T(-0.8f), T(0.8f)), T(0.0f));
    c.rise = c.rise + (rise - c.rise) * min(T(1.0f), T(3.0f) * c.dt);
}

// What bounds the height of a pelvis: a foot at `place`, below the hip of `side`.
template <class T, class M>
struct Bound {
    int side;
    Stand<T> place, other;  // of this foot, and where the other one stands
    M lands, leaves;        // it is about to, or just has; its heel gives. Else it stands flat
    V2<T> root;
    T base;  // the height of the ground there
    T rise;  // see rise-inl.h
};

// Metres by which the pelvis would be higher than the leg lets it.
template <class T, class M>
HWY_INLINE T too_high(const GaitBlock& g, const PersonBlock& p, const Climber<T>& c, const Bound<T, M>& b,
                      size_t lane) {
    T zero = T(0.0f), one = T(1.0f);
    T hip_x = row<T>(p.joints[left_upper_leg][0], lane) * T(b.side == k_left ? 1.0f : -1.0f);
    T ankle = row<T>(p.joints[left_foot][1], lane), reach = (c.leg - ankle) * T(k_straightest);
    T ball = row<T>(p.joints[left_toes][2], lane) - row<T>(p.joints[left_foot][2], lane);
    T amplitude = row<T>(g.amplitude, lane);
    SinCosOf<T> yaw = sin_cos(b.place.yaw);
    V2<T> ahead{yaw.sine, yaw.cosine}, at{b.place.place.x, b.place.place.z};
    T up = ankle, by = zero;  // of the ankle over the foot's place, and ahead of it
    T forefoot = row<T>(g.feet[b.side].forefoot, lane);
    if (any(forefoot > zero)) {
        T after = heel_up_after(c.phase[b.side] * T(k_norm_toe_off) / c.duty);
        forefoot = forefoot * select(c.swings[b.side] > T(0.5f), one, after);
        up = up + ball * T(k_tiptoe_sine) * forefoot;
        by = by + ankle * T(k_tiptoe_sine) * forefoot;
    }
    if (any(b.leaves)) {
        // The heel may rise as high as it is when the foot leaves.
        T ball_height = row<T>(p.joints[left_toes][1], lane), instep = ankle - ball_height;
        T gives = smoothstep(T(k_heel_gives_from / k_norm_toe_off), one, c.phase[b.side] / c.duty);
        T fast = T(k_heel_gives_pace) * max(row<T>(g.pace, lane) - T(k_natural_pace), zero);
        SinCosOf<T> tilt = sin_cos(T(k_heel_gives) * gives + fast);
        T forward = ball - ball * tilt.cosine + instep * tilt.sine;
        T raised = instep * tilt.cosine + ball * tilt.sine + ball_height;
        raised = raised + height_on(b.place, at + ahead * forward) - b.place.place.y;
        up = select(b.leaves, raised, up);
        by = select(b.leaves, forward, by);
    }
    if (any(b.lands)) {
        T onward = amplitude * max(row<T>(g.course, lane), zero);
        T pitch = T(k_contact_pitch_sine) * row<T>(p.strike, lane) * onward;
        T heel_up = row<T>(p.heel, lane) * pitch;
        up = select(b.lands, up + heel_up * (one - forefoot), up);
        by = select(b.lands, by - ankle * pitch * (one - forefoot), by);
    }
    V2<T> hip = b.root + V2<T>{c.facing.z, zero - c.facing.x} * hip_x;
    V2<T> off = at + ahead * by - hip;
    T flat2 = dot(off, off), reach2 = reach * reach;
    T hip_height = b.base + c.leg * (one + b.rise) - row<T>(g.crouch, lane) -
                   row<T>(p.crouch, lane) * smoothstep(row<T>(g.amplitude, lane) * T(k_crouches));
    T slow = max(T(k_natural_pace) - row<T>(g.pace, lane), zero) * amplitude;
    T above = hip_height + T(k_spare_slow) * slow - b.place.place.y - up;
    T step = clamp(step_between(b.place, b.other), zero, T(k_step_most));
    above = select(b.lands & (c.tread <= zero), above + T(k_downstep) * step, above);
    auto is_beyond = (above > zero) & (above * above + flat2 > reach2);
    return select(is_beyond, above - sqrt(max(reach2 - flat2, T(0.25f) * reach2)), zero);
}

// The pelvis comes down in time for what the next contact will let it, and for the legs that carry it; and up
// again at leisure.
template <class T>
HWY_INLINE void advance_sink(GaitBlock& g, const PersonBlock& p, const Climber<T>& c, size_t lane, T& sink,
                             T& velocity) {
    T zero = T(0.0f), half = T(0.5f);
    T over = over_natural(row<T>(g.pace, lane)), climb = clamp(c.rise, zero, T(k_steepest));
    auto rise_at = [&](SinCosOf<T> twice) {
        return pelvis_rise(row<T>(g.step, lane), over, row<T>(g.amplitude, lane), climb, twice);
    };
    auto walks = (row<T>(g.running, lane) <= half) & (row<T>(g.jump, lane) <= zero);
    Harmonics<T, 2> wave = harmonics<2>(row<T>(g.phase, lane));
    T rise_now = rise_at({wave.sine[1], wave.cosine[1]}), rise_then = rise_at({zero, T(1.0f)});
    T rise_given = rise_at({T(k_bears_sine), T(k_bears_cosine)});
    T load = row<T>(g.load, lane);
    auto descent = descent_of(c);
    T left = left_at_landing(descent, c.base_velocity);
    // What the legs that carry need now, and how hard one has to sink for what they and the next landing
    // will.
    T now = zero, effort = T(-k_most_effort), most = T(k_most_sink) * c.leg, w = T(k_sink_release);
    T frequency = max(row<T>(g.frequency, lane), T(0.1f));
    for (int side = 0; side < 2; ++side) {
        auto swings = c.swings[side] > half, stands = c.swings[side] <= half;
        const Stand<T>& other = c.from[1 - side];
        // At its landing.
        T seconds = min(c.until[side], T(k_farthest_ahead));
        V2<T> change = c.wish - c.velocity;
        T missing = sqrt(dot(change, change)), most_change = T(k_reaction) * seconds;
        V2<T> expected = c.velocity + change * (min(missing, most_change) / max(missing, T(1e-6f)));
        V2<T> root = c.root + (c.velocity + expected) * (half * seconds);
        T base = min(height_on(c.goal[side], root), height_on(other, root));
        base = base + max(c.base - max(c.on_from[1 - side], base), zero);
        base = base + select(descent.begins, left, zero);
        // Or where it stands: now, or as soon as its heel gives.
        auto landed = stands & (c.phase[side] < T(k_just_landed)) & (c.stands < half);
        V2<T> ahead = c.root - V2<T>{c.from[side].place.x, c.from[side].place.z};
        auto bears = stands & (c.phase[side] < T(k_bears)) & (dot(ahead, c.facing) < T(k_behind_0) * c.leg);
        T gives_in = (T(k_bears) - c.phase[side]) / frequency;
        auto soon = bears & (gives_in < T(k_gives_soon)) & (c.stands < half);
        T flat = select(bears | landed, T(1.0f), zero);
        gives_in = select(soon, gives_in, zero);
        V2<T> here = c.root + c.velocity * gives_in;
        Bound<T, decltype(swings)> bound{side,
                                         select(swings, c.goal[side], c.from[side]),
                                         other,
                                         swings | landed,
                                         stands & (flat < half),
                                         {select(swings, root.x, here.x), select(swings, root.z, here.z)},
                                         select(swings, base, c.base),
                                         select(swings, rise_then, select(soon, rise_given, rise_now))};
        T amount = select(walks, too_high(g, p, c, bound, lane), zero);
        // A leg that rests bends instead.
        T carries = side == k_left ? load : T(1.0f) - load;
        amount = min(amount * select(c.stands > half, smoothstep(T(0.2f), half, carries), T(1.0f)), most);
        T until = max(select(swings, seconds, gives_in), T(k_soonest));
        T needs = select((swings | soon) & (amount > sink), least_effort(amount - sink, velocity, until),
                         T(-k_most_effort));
        effort = max(effort, needs);
        now = select(stands & (gives_in <= zero), max(now, amount), now);
    }
    T a = select(now > sink, least_effort(now - sink, velocity, T(k_soonest)),
                 w * w * (now - sink) - T(2.0f) * w * velocity);
    // As late as may be, so that knees do not bend for a landing that is far.
    a = lerp(a, max(a, effort), smoothstep(T(0.5f * k_sink_effort), T(k_sink_effort), effort));
    velocity = velocity + a * c.dt;
    sink = sink + velocity * c.dt;
}

template <class T>
HWY_INLINE void advance_heights(GaitBlock& g, const PersonBlock& p, const StepperRows& s, float dt,
                                size_t lane) {
    auto moves = row<T>(s.moves, lane) > T(0.5f);
    if (!any(moves)) return;
    Climber<T> c = climber_at<T>(g, p, s, dt, lane);
    advance_base(c, row<T>(g.load, lane));
    T sink = row<T>(g.sink, lane), velocity = row<T>(g.sink_velocity, lane);
    advance_sink(g, p, c, lane, sink, velocity);
    auto keep = [&](T value, float* to) { store(select(moves, value, row<T>(to, lane)), to + lane); };
    keep(c.base, g.base);
    keep(c.base_velocity, g.base_velocity);
    keep(c.rise, g.rise);
    keep(sink, g.sink);
    keep(velocity, g.sink_velocity);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
