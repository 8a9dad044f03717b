#include "sim/fall/tumble.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/fall/lane.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/fall/tumble.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "sim/base/rows-inl.h"
#include "sim/pose/range-inl.h"

#ifndef FLANEUR_SIM_FALL_RANGES
#define FLANEUR_SIM_FALL_RANGES
namespace flaneur {

// Where a limb may point that swings all ways: within so much of an axis, as its carrier sees it; and how far
// it may be turned about itself.
struct SwingCone {
    Vec3 axis;  // unit; of a left limb, right ones mirror it
    float cosine = -1, per_sine = 1;
    RangeEnd half_twist{1, 0};  // any
};
struct SegmentRanges {
    JointRange of[k_segment_count];
    SwingCone cones[k_segment_count];
};

// Two balls of a body that do not pass through each other.
struct BallPair {
    int a, b;
};

}  // namespace flaneur
#endif

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

using L = Lanes;

namespace {

constexpr BallPair k_pairs[] = {{11, 19}, {12, 20}, {13, 21}, {11, 20}, {12, 19}, {9, 0}, {17, 1}, {9, 5},
                                {17, 5},  {7, 5},   {15, 5},  {9, 6},   {17, 6},  {8, 2}, {16, 2}};
constexpr size_t k_pair_count = sizeof k_pairs / sizeof k_pairs[0];
constexpr float k_fastest = 15, k_fastest_spin = 40;  // m/s, rad/s: nobody falls farther than 11 m

// A segment while it is worked on.
struct At {
    V3<L> place;
    Q4<L> rotation;
};

HWY_INLINE At load_at(const TumbleBlock& b, size_t s, size_t lane) {
    return {load_place<L>(b.place[s], lane), load_rotation<L>(b.rotation[s], lane)};
}
// Of a group of lanes some of which change: what the others do must not hang by their company.
HWY_INLINE At select(LaneMask m, const At& a, const At& b) {
    return {select(m, a.place, b.place), select(m, a.rotation, b.rotation)};
}
HWY_INLINE void store_at(TumbleBlock& b, size_t s, size_t lane, const At& at) {
    store_place(at.place, b.place[s], lane);
    store_rotation(at.rotation, b.rotation[s], lane);
}

// A small turn, as an axis times an angle, after q.
HWY_INLINE Q4<L> turned_by(Q4<L> q, V3<L> turn) {
    const L half(0.5f);
    Q4<L> d{turn.x * half, turn.y * half, turn.z * half, L(0.0f)};
    Q4<L> more = d * q;
    return normalize(Q4<L>{q.x + more.x, q.y + more.y, q.z + more.z, q.w + more.w});
}
// The other way: the turn from `from` to `to`.
HWY_INLINE V3<L> turn_between(Q4<L> from, Q4<L> to) {
    Q4<L> d = to * conjugate(from);
    L twice = select(d.w < L(0.0f), L(-2.0f), L(2.0f));
    return {d.x * twice, d.y * twice, d.z * twice};
}

HWY_INLINE V3<L> scaled(V3<L> a, V3<L> b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
// How a segment answers a moment.
HWY_INLINE V3<L> eased(const At& at, V3<L> ease, V3<L> moment) {
    return rotate(at.rotation, scaled(ease, rotate(conjugate(at.rotation), moment)));
}

// Where one segment is taken hold of, and what it sets against that along a direction.
struct Grip {
    V3<L> arm;      // from the middle
    V3<L> answers;  // turn for an impulse along the direction
    L weight;       // metres of that place for such an impulse
};
HWY_INLINE Grip grip(const At& at, V3<L> ease, L lightness, V3<L> arm, V3<L> along) {
    V3<L> moment = cross(arm, along), answers = eased(at, ease, moment);
    return {arm, answers, lightness + dot(moment, answers)};
}
HWY_INLINE void give(At& at, const Grip& g, L lightness, V3<L> along, L impulse) {
    at.place = at.place + along * (lightness * impulse);
    at.rotation = turned_by(at.rotation, g.answers * impulse);
}

struct Solver {
    const TumbleShapes& shapes;
    const TumbleAims& aims;
    const TumblePlanes& planes;
    const SegmentRanges& ranges;
    TumbleBlock& block;
    TumbleBlock before;  // the short step
    size_t lane;
    L h;

    V3<L> ease(size_t s) const { return load_place<L>(shapes.ease[s], lane); }
    L lightness(size_t s) const { return row<L>(shapes.lightness[s], lane); }
};

// The spin halfway through a short step that keeps its angular momentum: long bodies do not spin evenly.
HWY_INLINE V3<L> steady_spin(const At& at, V3<L> ease, V3<L> spin, L h) {
    V3<L> own = rotate(conjugate(at.rotation), spin);
    V3<L> momentum = rotate(at.rotation, V3<L>{own.x / ease.x, own.y / ease.y, own.z / ease.z});
    return eased({at.place, turned_by(at.rotation, spin * (h * L(0.5f)))}, ease, momentum);
}

HWY_INLINE void go_on(Solver& w) {
    for (size_t s = 0; s < k_segment_count; ++s) {
        At at = load_at(w.block, s, w.lane);
        store_at(w.before, s, w.lane, at);
        V3<L> v = load_place<L>(w.block.velocity[s], w.lane);
        v.y = v.y - L(k_gravity) * w.h;
        at.place = at.place + v * w.h;
        at.rotation = turned_by(
            at.rotation, steady_spin(at, w.ease(s), load_place<L>(w.block.spin[s], w.lane), w.h) * w.h);
        store_at(w.block, s, w.lane, at);
    }
}

constexpr float k_back_a_step = 0.3f;  // of what a joint is beyond its range

// What brings a joint back that is beyond its range, as an axis times an angle.
HWY_INLINE V3<L> back_into_range(const Solver& w, size_t s, const At& carrier, const At& at) {
    const float outward = s >= right_thigh || (s >= right_arm && s <= right_palm) ? -1.0f : 1.0f;
    const bool points_ahead = s == left_sole || s == right_sole;
    Q4<L> turn = conjugate(carrier.rotation) * at.rotation;
    Q4<L> part = points_ahead ? Q4<L>{turn.x, -turn.z, turn.y, turn.w} : turn;
    const LaneMask poor = beyond(part, w.ranges.of[s], outward);
    V3<L> none{L(0.0f), L(0.0f), L(0.0f)};
    if (!any(poor)) return none;
    Q4<L> held = within(part, w.ranges.of[s], outward);
    if (points_ahead) held = {held.x, held.z, -held.y, held.w};
    return select(poor, turn_between(at.rotation, carrier.rotation * held), none);
}

// The same of knees and elbows, whose two bones keep their x in common, and which bend about it.
HWY_INLINE V3<L> back_onto_hinge(const Solver& w, size_t s, const At& carrier, const At& at) {
    const JointRange& range = w.ranges.of[s];
    const V3<L> x{L(1.0f), L(0.0f), L(0.0f)};
    V3<L> by = cross(rotate(at.rotation, x), rotate(carrier.rotation, x));
    V3<L> along = rotate(conjugate(carrier.rotation) * at.rotation, V3<L>{L(0.0f), L(-1.0f), L(0.0f)});
    auto past = [&](RangeEnd end) { return along.z * L(end.cosine) + along.y * L(end.sine); };
    L low = past(range.bend_low), high = past(range.bend_high);
    // Behind both ends the nearer one counts.
    L nearer_high = along.z * L(range.bend_high.sine - range.bend_low.sine) -
                    along.y * L(range.bend_high.cosine - range.bend_low.cosine);
    LaneMask is_low = low<L(0.0f), is_high = high> L(0.0f);
    LaneMask takes_high = is_high & ((low >= L(0.0f)) | (nearer_high > L(0.0f)));
    // About x bends turn the other way round.
    L excess = select(takes_high, high, select(is_low, low, L(0.0f)));
    return by + rotate(carrier.rotation, x) * excess;
}

// The same of shoulders, hips and wrists.
HWY_INLINE V3<L> back_into_cone(const Solver& w, size_t s, const At& carrier, const At& at) {
    const SwingCone& cone = w.ranges.cones[s];
    const bool is_right = s >= right_thigh || (s >= right_arm && s <= right_palm);
    V3<L> axis = rotate(carrier.rotation,
                        V3<L>{L(is_right ? -cone.axis.x : cone.axis.x), L(cone.axis.y), L(cone.axis.z)});
    V3<L> along = rotate(at.rotation, V3<L>{L(0.0f), L(-1.0f), L(0.0f)});
    L excess = max(L(cone.cosine) - dot(along, axis), L(0.0f)) * L(cone.per_sine);
    V3<L> by = normalize(cross(along, axis)) * excess;
    Q4<L> turn = conjugate(carrier.rotation) * at.rotation;
    SinCosOf<L> twist = twist_about_y(turn);
    L beyond_twist =
        max(abs(twist.sine) * L(cone.half_twist.cosine) - twist.cosine * L(cone.half_twist.sine), L(0.0f));
    L back = select(twist.sine < L(0.0f), L(2.0f), L(-2.0f)) * beyond_twist;
    by = by - along * back;
    if (s != left_thigh && s != right_thigh) return by;
    // Legs part only so far.
    constexpr float k_parted = 0.68f;  // sine
    V3<L> outward = rotate(carrier.rotation, V3<L>{L(is_right ? -1.0f : 1.0f), L(0.0f), L(0.0f)});
    L parts = max(dot(along, outward) - L(k_parted), L(0.0f));
    return by + normalize(cross(outward, along)) * (parts * L(1.4f));
}

constexpr bool is_ball_joint(size_t s) {
    return s == left_arm || s == right_arm || s == left_thigh || s == right_thigh || s == left_palm ||
           s == right_palm;
}
constexpr bool is_hinge(size_t s) {
    return s == left_forearm || s == right_forearm || s == left_shank || s == right_shank;
}

// Limits at once, muscles as hard as they pull.
HWY_INLINE void turn_joint(Solver& w, size_t s, At& carrier, At& at) {
    V3<L> by = is_hinge(s)        ? back_onto_hinge(w, s, carrier, at)
               : is_ball_joint(s) ? back_into_cone(w, s, carrier, at)
                                  : back_into_range(w, s, carrier, at);
    by = by * L(k_back_a_step);
    L haste = row<L>(w.aims.haste[s], w.lane) * w.h;
    L pull = haste * haste / (L(1.0f) + haste * haste);
    by = by + turn_between(at.rotation, carrier.rotation * load_rotation<L>(w.aims.turn[s], w.lane)) * pull;
    L angle2 = dot(by, by);
    const V3<L> ease_a = w.ease(static_cast<size_t>(k_segments[s].parent)), ease_b = w.ease(s);
    V3<L> axis = by * (L(1.0f) / sqrt(max(angle2, L(1e-14f))));
    V3<L> answers_a = eased(carrier, ease_a, axis), answers_b = eased(at, ease_b, axis);
    L impulse = sqrt(angle2) / max(dot(axis, answers_a) + dot(axis, answers_b), L(1e-9f));
    carrier.rotation = turned_by(carrier.rotation, answers_a * (L(0.0f) - impulse));
    at.rotation = turned_by(at.rotation, answers_b * impulse);
}

HWY_INLINE void join(Solver& w, size_t s, At& carrier, At& at) {
    const size_t p = static_cast<size_t>(k_segments[s].parent);
    V3<L> arm_a = rotate(carrier.rotation, load_place<L>(w.shapes.socket[s], w.lane));
    V3<L> arm_b = rotate(at.rotation, load_place<L>(w.shapes.pivot[s], w.lane));
    V3<L> gap = (at.place + arm_b) - (carrier.place + arm_a);
    L length = sqrt(max(dot(gap, gap), L(1e-14f)));
    V3<L> along = gap * (L(1.0f) / length);
    Grip a = grip(carrier, w.ease(p), w.lightness(p), arm_a, along);
    Grip b = grip(at, w.ease(s), w.lightness(s), arm_b, along);
    L impulse = length / (a.weight + b.weight);
    give(carrier, a, w.lightness(p), along, impulse);
    give(at, b, w.lightness(s), along, L(0.0f) - impulse);
}

HWY_INLINE void solve_joints(Solver& w) {
    for (size_t s = 1; s < k_segment_count; ++s) {
        const size_t p = static_cast<size_t>(k_segments[s].parent);
        At carrier = load_at(w.block, p, w.lane), at = load_at(w.block, s, w.lane);
        turn_joint(w, s, carrier, at);
        join(w, s, carrier, at);
        store_at(w.block, p, w.lane, carrier);
        store_at(w.block, s, w.lane, at);
    }
}

// Of one ball with a plane: what remains of how deep it was in it, metres, and 1 where they may touch.
struct Contact {
    L slack, is_near;
};
// `slack` metres of what it is in remain.
HWY_INLINE void keep_out(Solver& w, size_t ball, V3<L> normal, L offset, L slack, L is_near) {
    const size_t s = k_segment_of_ball[ball];
    const At as_it_was = load_at(w.block, s, w.lane);
    At at = as_it_was;
    L radius = row<L>(w.shapes.radius[ball], w.lane);
    V3<L> from = load_place<L>(w.shapes.ball[ball], w.lane);
    V3<L> arm = rotate(at.rotation, from) - normal * radius;
    L depth = offset - slack - dot(normal, at.place + arm);
    LaneMask touches = (depth > L(0.0f)) & (is_near > L(0.0f));
    if (!any(touches)) return;
    const V3<L> ease = w.ease(s);
    const L lightness = w.lightness(s);
    Grip g = grip(at, ease, lightness, arm, normal);
    L impulse = depth / g.weight;
    give(at, g, lightness, normal, impulse);
    // Friction holds the place that touches, as far as it is pressed on.
    At was = load_at(w.before, s, w.lane);
    V3<L> touching = rotate(at.rotation, from) - normal * radius;
    V3<L> slid = (at.place + touching) - (was.place + (rotate(was.rotation, from) - normal * radius));
    slid = slid - normal * dot(slid, normal);
    L far = sqrt(max(dot(slid, slid), L(1e-14f)));
    V3<L> along = slid * (L(1.0f) / far);
    Grip f = grip(at, ease, lightness, touching, along);
    L back = min(far / f.weight, impulse * L(k_grip));
    give(at, f, lightness, along, L(0.0f) - back);
    store_at(w.block, s, w.lane, select(touches, at, as_it_was));
}

// Balls of one body that are in each other part, a fifth in each short step.
HWY_INLINE void part_balls(Solver& w, BallPair pair, L is_near) {
    const size_t sa = k_segment_of_ball[pair.a], sb = k_segment_of_ball[pair.b];
    const At was_a = load_at(w.block, sa, w.lane), was_b = load_at(w.block, sb, w.lane);
    At a = was_a, b = was_b;
    V3<L> arm_a = rotate(a.rotation, load_place<L>(w.shapes.ball[pair.a], w.lane));
    V3<L> arm_b = rotate(b.rotation, load_place<L>(w.shapes.ball[pair.b], w.lane));
    V3<L> apart = (b.place + arm_b) - (a.place + arm_a);
    L room = row<L>(w.shapes.radius[pair.a], w.lane) + row<L>(w.shapes.radius[pair.b], w.lane);
    L d2 = dot(apart, apart);
    LaneMask touch = (d2 < room * room) & (is_near > L(0.0f));
    if (!any(touch)) return;
    L d = sqrt(max(d2, L(1e-10f)));
    V3<L> along = apart * (L(1.0f) / d);
    L deep = (room - d) * L(0.2f);
    Grip ga = grip(a, w.ease(sa), w.lightness(sa), arm_a, along);
    Grip gb = grip(b, w.ease(sb), w.lightness(sb), arm_b, along);
    L impulse = deep / (ga.weight + gb.weight);
    give(a, ga, w.lightness(sa), along, L(0.0f) - impulse);
    give(b, gb, w.lightness(sb), along, impulse);
    store_at(w.block, sa, w.lane, select(touch, a, was_a));
    store_at(w.block, sb, w.lane, select(touch, b, was_b));
}

HWY_INLINE V3<L> at_most(V3<L> v, float most) {
    L l2 = dot(v, v);
    return v * select(l2 > L(most * most), L(most) / sqrt(max(l2, L(1e-12f))), L(1.0f));
}

// What became of them is how they move.
HWY_INLINE void find_velocities(Solver& w) {
    L rate = L(1.0f) / w.h;
    for (size_t s = 0; s < k_segment_count; ++s) {
        At was = load_at(w.before, s, w.lane), at = load_at(w.block, s, w.lane);
        store_place(at_most((at.place - was.place) * rate, k_fastest), w.block.velocity[s], w.lane);
        store_place(at_most(turn_between(was.rotation, at.rotation) * rate, k_fastest_spin), w.block.spin[s],
                    w.lane);
    }
    for (size_t s = 1; s < k_segment_count; ++s) {
        const size_t p = static_cast<size_t>(k_segments[s].parent);
        V3<L> carrier = load_place<L>(w.block.spin[p], w.lane), own = load_place<L>(w.block.spin[s], w.lane);
        V3<L> against = own - carrier;
        L slow = min(row<L>(w.aims.drag[s], w.lane) * w.h, L(0.5f));
        // Shared so that what one gains the other loses.
        V3<L> ease_a = w.ease(p), ease_b = w.ease(s);
        L ea = ease_a.x + ease_a.y + ease_a.z, eb = ease_b.x + ease_b.y + ease_b.z;
        L share = ea / (ea + eb);
        store_place(carrier + against * (slow * share), w.block.spin[p], w.lane);
        store_place(own - against * (slow * (L(1.0f) - share)), w.block.spin[s], w.lane);
    }
}

}  // namespace

void tumble_here(const TumbleShapes& shapes, const TumbleAims& aims, const TumblePlanes& planes,
                 const SegmentRanges& ranges, float dt, TumbleBlock& block) {
    for (size_t lane = 0; lane < k_block; lane += lane_count()) {
        Solver w{shapes, aims, planes, ranges, block, {}, lane, L(dt / k_tumble_steps)};
        // What cannot touch in this tick, by how it moves, is not asked in its short steps: by lane, so that
        // nobody's company matters.
        constexpr float k_spare = 0.1f;  // metres
        const L time(dt);
        struct Ball {
            V3<L> place, velocity;
            L speed;
        } balls[k_ball_count];
        for (size_t k = 0; k < k_ball_count; ++k) {
            const size_t s = k_segment_of_ball[k];
            const At at = load_at(block, s, lane);
            V3<L> arm = rotate(at.rotation, load_place<L>(shapes.ball[k], lane));
            V3<L> v = load_place<L>(block.velocity[s], lane) + cross(load_place<L>(block.spin[s], lane), arm);
            balls[k] = {at.place + arm, v, sqrt(dot(v, v))};
        }
        Contact ground[k_ball_count], wall[k_ball_count];
        auto contact = [&](size_t k, V3<L> normal, const float* offset) {
            L depth = row<L>(offset, lane) + row<L>(shapes.radius[k], lane) - dot(normal, balls[k].place);
            L comes = depth + balls[k].speed * time + L(k_spare);
            return Contact{max(depth, L(0.0f)), select(comes > L(0.0f), L(1.0f), L(0.0f))};
        };
        for (size_t k = 0; k < k_ball_count; ++k) {
            ground[k] = contact(k, load_place<L>(planes.normal[k], lane), planes.offset[k]);
            if (planes.has_walls)
                wall[k] = contact(k, load_place<L>(planes.wall[k], lane), planes.wall_offset[k]);
        }
        L pair_near[k_pair_count];
        for (size_t p = 0; p < k_pair_count; ++p) {
            const auto a = static_cast<size_t>(k_pairs[p].a), b = static_cast<size_t>(k_pairs[p].b);
            V3<L> apart = balls[b].place - balls[a].place, moves = balls[b].velocity - balls[a].velocity;
            L reach = row<L>(shapes.radius[a], lane) + row<L>(shapes.radius[b], lane) +
                      sqrt(dot(moves, moves)) * time + L(k_spare);
            pair_near[p] = select(dot(apart, apart) < reach * reach, L(1.0f), L(0.0f));
        }
        auto is_any = [](L near) { return any(near > L(0.0f)); };
        for (int step = 0; step < k_tumble_steps; ++step) {
            go_on(w);
            solve_joints(w);
            for (size_t p = 0; p < k_pair_count; ++p)
                if (is_any(pair_near[p])) part_balls(w, k_pairs[p], pair_near[p]);
            for (size_t k = 0; k < k_ball_count; ++k) {
                auto keep = [&](Contact& c, V3<L> normal, const float* offset) {
                    c.slack = max(c.slack - L(k_comes_out) * w.h, L(0.0f));
                    keep_out(w, k, normal, row<L>(offset, lane), c.slack, c.is_near);
                };
                if (is_any(ground[k].is_near))
                    keep(ground[k], load_place<L>(planes.normal[k], lane), planes.offset[k]);
                if (planes.has_walls && is_any(wall[k].is_near))
                    keep(wall[k], load_place<L>(planes.wall[k], lane), planes.wall_offset[k]);
            }
            find_velocities(w);
        }
    }
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace flaneur {

HWY_EXPORT(tumble_here);

// Trunk and skull stand on what carries them: as if they hung, their ranges are turned round. Limbs are laid
// so that elbows and knees bend in the plane of their own x. Shoulders and hips have cones for their ranges
// of joint_limits.h, which have no angle at which a limb could point either way.
static SegmentRanges find_ranges() {
    auto upright = [](JointLimits l) {
        return JointLimits{{-l.bend.high, -l.bend.low}, {-l.side.high, -l.side.low}, l.twist};
    };
    auto cone = [](Vec3 axis, float degrees, float twist) {
        const SinCos wide = sin_cos(degrees * k_radians), half = sin_cos(0.5f * twist * k_radians);
        return SwingCone{axis / length(axis), wide.cosine, 1 / wide.sine, {half.sine, half.cosine}};
    };
    constexpr JointLimits k_hinge_up = {{-3, 148}, {-6, 6}, {-80, 80}};
    constexpr JointLimits k_hinge_back = {{-150, 4}, {-6, 6}, {-15, 15}};
    SegmentRanges r;
    constexpr JointLimits k_half_a_trunk = {{-15, 38}, {-20, 20}, {-20, 20}};
    r.of[pelvis] = r.of[belly] = r.of[thorax] = range_of(upright(k_half_a_trunk));
    r.of[skull] = range_of(upright(joint_limits::k_neck));
    r.of[left_forearm] = r.of[right_forearm] = range_of(k_hinge_up);
    r.of[left_shank] = r.of[right_shank] = range_of(k_hinge_back);
    r.of[left_sole] = r.of[right_sole] = range_of(joint_limits::k_ankle);
    r.cones[left_arm] = r.cones[right_arm] = cone({0.45f, -0.55f, 0.7f}, 95, 180);
    r.cones[left_palm] = r.cones[right_palm] = cone({0, -1, 0}, 70, 180);
    r.cones[left_thigh] = r.cones[right_thigh] = cone({0.15f, -0.75f, 0.65f}, 75, 45);
    return r;
}

void tumble(const TumbleShapes& shapes, const TumbleAims& aims, const TumblePlanes& planes, float dt,
            TumbleBlock& block) {
    static const SegmentRanges ranges = find_ranges();
    HWY_DYNAMIC_DISPATCH(tumble_here)(shapes, aims, planes, ranges, dt, block);
}

void set_shape(TumbleShapes& shapes, int lane, const Segments& s) {
    for (int i = 0; i < k_segment_count; ++i) {
        const Vec3 inertia = s.inertia[i];
        shapes.lightness[i][lane] = 1 / s.mass[i];
        set_row(shapes.ease[i], lane, {1 / inertia.x, 1 / inertia.y, 1 / inertia.z});
        set_row(shapes.pivot[i], lane, s.pivot[i]);
        set_row(shapes.socket[i], lane, s.socket[i]);
    }
    for (int k = 0; k < k_ball_count; ++k) {
        set_row(shapes.ball[k], lane, s.ball[k]);
        shapes.radius[k][lane] = s.radius[k];
    }
}

namespace {
struct Energy {
    float of_motion = 0, of_height = 0;
};
Energy energies_of(const TumbleBlock& block, const Segments& s, int lane) {
    Energy energy;
    for (int i = 0; i < k_segment_count; ++i) {
        const Vec3 spin = rotate(conjugate(turn_of(block.rotation[i], lane)), row_of(block.spin[i], lane));
        const Vec3 moment{s.inertia[i].x * spin.x, s.inertia[i].y * spin.y, s.inertia[i].z * spin.z};
        energy.of_motion +=
            0.5f * (s.mass[i] * length_squared(row_of(block.velocity[i], lane)) + dot(moment, spin));
        energy.of_height += s.mass[i] * k_gravity * block.place[i][1][lane];
    }
    return energy;
}
}  // namespace

float energy_of(const TumbleBlock& block, const Segments& segments, int lane) {
    const Energy energy = energies_of(block, segments, lane);
    return energy.of_motion + energy.of_height;
}

float keep_energy(TumbleBlock& block, const Segments& segments, int lane, float most) {
    const Energy energy = energies_of(block, segments, lane);
    const float has = energy.of_motion + energy.of_height;
    if (has <= most) return has;
    const float left = std::max(most - energy.of_height, 0.0f);
    if (energy.of_motion > left) calm(block, lane, std::sqrt(left / energy.of_motion));
    return energy.of_height + std::min(left, energy.of_motion);
}

}  // namespace flaneur
#endif
