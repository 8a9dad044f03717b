// Velocities that meet nobody, over float or Lanes: the half-planes of optimal reciprocal collision avoidance
// and the best point in them (van den Berg, Guy, Lin and Manocha 2011).
#if defined(FLANEUR_SIM_CROWD_VELOCITY_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FLANEUR_SIM_CROWD_VELOCITY_INL_H
#undef FLANEUR_SIM_CROWD_VELOCITY_INL_H
#else
#define FLANEUR_SIM_CROWD_VELOCITY_INL_H
#endif

#include "sim/base/rows-inl.h"
#include "sim/crowd/deciders.h"

HWY_BEFORE_NAMESPACE();
namespace flaneur::HWY_NAMESPACE {

inline constexpr float k_untangle = 0.3f;   // seconds to end an overlap in
inline constexpr float k_parallel = 1e-5f;  // slopes
inline constexpr float k_overtakes = 3.5f;  // metres ahead, of those who are slower
inline constexpr float k_in_front = 1.3f;   // of the width of both, to either side: one is to be overtaken
inline constexpr float k_swerves = 0.95f;   // of the speed
inline constexpr float k_closer = 0.035f;   // metres that one behind may press into one who goes ahead
inline constexpr float k_hardly_larger = 0.2f;  // m/s
inline constexpr float k_keep_side = 0.12f;     // of the speed, where others come the other way,
inline constexpr float k_clears = 0.6f;         // and, from each of them that one would meet,
inline constexpr float k_sees = 4;              // as near as that, metres,
inline constexpr float k_in_line = 1;           // and so little aside;
inline constexpr float k_usual = 0.2f;          // to the usual side, unless they are so far on that
inline constexpr float k_makes_room = 0.4f;     // of the speed, where they come far ahead of a throng
inline constexpr float k_patience = 0.7f;       // seconds without getting nearer before one gives way
inline constexpr float k_give_way = 0.6f;       // of the speed, to that side, for each second of that

template <class T>
struct Meet {
    V2<T> between, velocity;
    T radii, share, hurry, swath, pace;
};
template <class T>
HWY_INLINE Meet<T> meeting(const MeetingRows& rows, size_t lane) {
    auto of = [lane](const LaneRow& r) { return row<T>(r.lanes, lane); };
    return {{of(rows.x), of(rows.z)},
            {of(rows.velocity_x), of(rows.velocity_z)},
            of(rows.radii),
            of(rows.share),
            of(rows.hurry),
            of(rows.swath),
            of(rows.pace)};
}

template <class T>
struct Plane {
    V2<T> normal;
    T offset;
};
template <class T>
HWY_INLINE Plane<T> plane_of(const PlaneRows& rows, size_t lane) {
    auto of = [lane](const LaneRow& r) { return row<T>(r.lanes, lane); };
    return {{of(rows.x), of(rows.z)}, of(rows.offset)};
}

// Walkers who meet head-on must not both wait: each takes its share of the change, on the side where it is
// smallest, or on that where people pass (see choose_velocities) if it is hardly larger there.
template <class T>
HWY_INLINE Plane<T> avoid(Meet<T> m, V2<T> velocity, T usual_side) {
    const T zero = T(0.0f), one = T(1.0f), tiny = T(1e-12f);
    const T margin = select(m.hurry > T(1.0f), T(0.0f) - T(k_closer), T(k_margin));
    const T radius = m.radii + margin, radius2 = radius * radius, distance2 = dot(m.between, m.between);
    const V2<T> relative = velocity - m.velocity;
    auto apart = distance2 > radius2;
    const T hurry = select(apart, m.hurry, T(1 / k_untangle));
    const V2<T> w = relative - m.between * hurry;  // from the centre of the cut-off circle
    const T along = dot(w, m.between), w2 = dot(w, w);
    auto round = (distance2 <= radius2) | ((along < zero) & (along * along > radius2 * w2));
    // Out of the circle. Two at one place and speed are parted along x, each its way would need an id; the
    // push of `move` parts them.
    const T l = sqrt(w2);
    const V2<T> out = select(l > T(1e-6f), w * (one / max(l, T(1e-6f))), V2<T>{one, zero});
    const V2<T> to_rim = out * (radius * hurry - l);
    // The nearer side of the cone that touches the other's circle.
    const T tangent = sqrt(max(distance2 - radius2, zero)), per = one / max(distance2, tiny);
    const T facing = dot(velocity, m.velocity), towards = dot(velocity, m.between);
    const T most = dot(velocity, velocity) * dot(m.velocity, m.velocity);
    auto meets = (towards > zero) & (facing < zero) & (facing * facing > T(0.5f) * most);
    const T lean = select(meets, usual_side * T(k_hardly_larger) * sqrt(distance2), zero);
    const T turn = select(cross(m.between, w) + lean > zero, one, zero - one), r = radius * turn;
    const V2<T> side{(m.between.x * tangent - m.between.z * r) * per,
                     (m.between.x * r + m.between.z * tangent) * per};
    const V2<T> to_side = side * dot(relative, side) - relative;
    const V2<T> normal = select(round, out, V2<T>{zero - side.z * turn, side.x * turn});
    const V2<T> change = select(round, to_rim, to_side);
    return {normal, dot(velocity + change * m.share, normal)};
}

template <class T>
struct Best {
    V2<T> velocity;
    T failed;  // 1: the planes leave nothing
};

// The velocity of length <= most nearest to `wish` inside all planes; plane after plane, as in half_planes.h.
template <class T>
HWY_INLINE Best<T> best_within(const PlaneRows* planes, int count, T most, V2<T> wish, size_t lane) {
    const T zero = T(0.0f), one = T(1.0f);
    const T length = sqrt(dot(wish, wish));
    V2<T> v = wish * select(length > most, most / max(length, T(1e-6f)), one);
    T failed = zero;
    for (int i = 0; i < count; ++i) {
        const Plane<T> own = plane_of<T>(planes[i], lane);
        auto broken = (dot(v, own.normal) < own.offset) & (failed < T(0.5f));
        if (!any(broken)) continue;
        const V2<T> foot = own.normal * own.offset, along{zero - own.normal.z, own.normal.x};
        const T room = most * most - own.offset * own.offset;
        T high = sqrt(max(room, zero)), low = zero - high;
        auto nothing = room < zero;
        for (int j = 0; j < i; ++j) {
            // Along the edge plane j reads slope * t >= need.
            const Plane<T> other = plane_of<T>(planes[j], lane);
            const T slope = dot(along, other.normal), need = other.offset - dot(foot, other.normal);
            auto parallel = abs(slope) < T(k_parallel);
            nothing = nothing | (parallel & (need > T(1e-6f)));
            const T t = need / select(parallel, one, slope);
            low = select(parallel, low, select(slope > zero, max(low, t), low));
            high = select(parallel, high, select(slope > zero, high, min(high, t)));
        }
        nothing = nothing | (low > high);
        const V2<T> on_edge = foot + along * clamp(dot(along, wish), low, high);
        v = select(broken, select(nothing, v, on_edge), v);
        failed = select(broken, select(nothing, one, failed), failed);
    }
    return {v, failed};
}

// V(s) = (s - l) / T with s the distance to the first body in the way (Tordeux, Chraibi and Seyfried 2016,
// without their force: the half-planes have done that). Those who walk ahead at a like speed leave room as
// they go. No bound of one who makes way.
template <class T>
HWY_INLINE T headway_speed(Meet<T> m, V2<T> direction) {
    const T zero = T(0.0f), none = T(1e9f);
    const T ahead = dot(m.between, direction), aside = abs(cross(direction, m.between));
    auto counts = (ahead > zero) & (aside < m.swath) & (m.share > zero);
    return select(counts, max(zero, (ahead - T(k_depth) * m.radii) * m.pace), none);
}

}  // namespace flaneur::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
