#include "sim/gait/footing.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/gait/curves/swing-inl.h"

namespace flaneur {

static constexpr float k_level = 0.02f;         // metres; heights this near are one surface
static constexpr float k_margin = 0.012f;       // metres between a sole and an edge
static constexpr float k_turning_room = 0.03f;  // and where it rises, if there is that much
static constexpr float k_toe_room = 0.045f;     // and before the toes, which roll on when the heel rises
static constexpr float k_half_width = 0.045f;   // and beside its middle
static constexpr float k_most_shift = 0.22f;    // metres
static constexpr float k_riser = 0.05f;         // metres; higher edges are steps
static constexpr float k_soonest_fall = 0.7f, k_latest_fall = 0.17f, k_passes = 0.05f;  // shares of a swing
static constexpr float k_easily_higher = 0.03f;                                         // metres
static constexpr float k_ledge = 1.1f;  // metres; higher ones cannot be jumped on

FootPlace get_place(const FootPlaces& from, int lane) {
    float nx = from.normal_x[lane], nz = from.normal_z[lane];
    return {{from.x[lane], from.y[lane], from.z[lane]},
            from.yaw[lane],
            {nx, std::sqrt(std::max(0.0f, 1 - nx * nx - nz * nz)), nz}};
}

void set_place(FootPlaces& to, int lane, const FootPlace& p) {
    to.x[lane] = p.position.x;
    to.y[lane] = p.position.y;
    to.z[lane] = p.position.z;
    to.yaw[lane] = p.yaw;
    to.normal_x[lane] = p.normal.x;
    to.normal_z[lane] = p.normal.z;
}

float height_on(const FootPlaces& foot, int lane, Vec2 at) {
    float nx = foot.normal_x[lane], nz = foot.normal_z[lane];
    float ny = std::sqrt(std::max(1 - nx * nx - nz * nz, 0.01f));
    return foot.y[lane] - (nx * (at.x - foot.x[lane]) + nz * (at.z - foot.z[lane])) / ny;
}

FootSize foot_size(const PersonBlock& p, int lane) {
    float ball = p.joints[left_toes][2][lane] - p.joints[left_foot][2][lane];
    return {p.heel[lane], ball, ball + p.toe[lane]};
}

namespace {

namespace kernel = HWY_NAMESPACE;

kernel::SwingEnds<float> ends_between(const FootPlace& from, const FootPlace& to) {
    Vec3 far = to.position - from.position;
    return {{from.position.x, from.position.y, from.position.z},
            {far.x, far.y, far.z},
            from.normal.x,
            from.normal.z,
            to.normal.x - from.normal.x,
            to.normal.z - from.normal.z};
}

Vec3 position_of(const kernel::V3<float>& v) { return {v.x, v.y, v.z}; }

Vec3 ahead_by(Vec3 from, Vec2 direction, float distance) {
    return {from.x + direction.x * distance, from.y, from.z + direction.z * distance};
}

std::optional<GroundHit> under(const Surroundings& around, Vec3 point) {
    return ground_at(around, point, k_step_up, k_step_down);
}

constexpr int k_ball = 2;  // of the four points

// The ground under four points of a sole.
struct Sampled {
    float along[4];
    std::optional<GroundHit> hits[4];
    bool whole = true;  // all there
    bool one = true;    // and of one plane
    int gap = 0;        // the points gap and gap + 1 differ most
    float highest = -1e9f;
};

Sampled sample(const Surroundings& around, Vec3 at, Vec2 ahead, const FootSize& size) {
    Sampled s{{-size.heel, 0.3f * size.ball, size.ball, size.tip}, {}};
    for (int i = 0; i < 4; ++i) {
        s.hits[i] = under(around, ahead_by(at, ahead, s.along[i]));
        s.whole = s.whole && s.hits[i];
        if (s.hits[i]) s.highest = std::max(s.highest, s.hits[i]->height);
    }
    float worst = 0;
    for (int i = 0; i < 3; ++i) {
        const auto &a = s.hits[i], &b = s.hits[i + 1];
        float off = a && b ? 0.0f : (a || b ? 1.0f : 0.0f);
        if (a && b) {
            // Against the rise that the slope of either triangle gives; a bend between two is no edge.
            auto slope = [&](Vec3 n) { return -(n.x * ahead.x + n.z * ahead.z) / std::max(n.y, 0.2f); };
            float step = s.along[i + 1] - s.along[i], rise = b->height - a->height;
            off = std::min(std::fabs(rise - slope(a->normal) * step),
                           std::fabs(rise - slope(b->normal) * step));
        }
        if (off > worst) worst = off, s.gap = i;
    }
    s.one = s.whole && worst <= k_level;
    return s;
}

FootPlace on_surface(Vec3 at, float yaw, Vec2 ahead, const Sampled& s) {
    const GroundHit& mid = *s.hits[1];
    float slope = -(mid.normal.x * ahead.x + mid.normal.z * ahead.z) / std::max(mid.normal.y, 0.2f);
    // Amid what lies a little higher and lower.
    float low = 0, high = 0;
    for (int i = 0; i < 4; ++i) {
        float off = s.hits[i]->height - mid.height - slope * (s.along[i] - s.along[1]);
        low = std::min(low, off);
        high = std::max(high, off);
    }
    return {{at.x, mid.height + 0.5f * (low + high) - slope * s.along[1], at.z}, yaw, mid.normal};
}

// Metres by which the ground `along` the foot from a place lies above the slope there; 0 where there is none.
float rise_over(const Surroundings& around, const FootPlace& place, Vec2 ahead, float along) {
    auto hit = under(around, ahead_by(place.position, ahead, along));
    if (!hit) return 0;
    float slope = -(place.normal.x * ahead.x + place.normal.z * ahead.z) / std::max(place.normal.y, 0.2f);
    return hit->height - place.position.y - slope * along;
}

// A foot whose side would stand in what rises beside it, or over what falls away, moves off there.
Footing off_edge_beside(const Surroundings& around, const Footing& found, Vec2 ahead, const FootSize& size) {
    const FootPlace& place = found.place;
    const Vec2 left{ahead.z, -ahead.x};
    auto is_edge = [&](float aside) {
        const FootPlace beside{ahead_by(place.position, left, aside), place.yaw, place.normal};
        return std::fabs(rise_over(around, beside, ahead, size.ball)) > k_riser ||
               std::fabs(rise_over(around, beside, ahead, -size.heel)) > k_riser;
    };
    bool edge_left = is_edge(k_half_width), edge_right = is_edge(-k_half_width);
    if (edge_left == edge_right) return found;
    Vec3 at = ahead_by(place.position, left, edge_left ? -k_half_width : k_half_width);
    Sampled moved = sample(around, at, ahead, size);
    return moved.one ? Footing{on_surface(at, place.yaw, ahead, moved), true, true, true} : found;
}

// A foot turns over heel and toes, which then reach a little farther than when it is flat: one that has come
// too near to what rises behind it or before it moves away from there, if it finds room.
Footing with_room(const Surroundings& around, const Footing& found, Vec2 ahead, const FootSize& size) {
    const FootPlace& place = found.place;
    auto rises = [&](float along) { return rise_over(around, place, ahead, along) > k_level; };
    bool behind = rises(-size.heel - k_turning_room), before = rises(size.tip + k_turning_room);
    if (behind == before) return found;
    Vec3 at = ahead_by(place.position, ahead, behind ? k_turning_room : -k_turning_room);
    Sampled moved = sample(around, at, ahead, size);
    return moved.one ? Footing{on_surface(at, place.yaw, ahead, moved), true, true, true} : found;
}

Footing with_room_around(const Surroundings& around, const Footing& found, Vec2 ahead, const FootSize& size) {
    return off_edge_beside(around, with_room(around, found, ahead, size), ahead, size);
}

}  // namespace

Footing find_footing(const Surroundings& around, const FootPlace& wanted, const FootSize& size,
                     float outward) {
    Vec2 ahead = heading_direction(wanted.yaw);
    Sampled s = sample(around, wanted.position, ahead, size);
    if (s.one) {
        Footing found{on_surface(wanted.position, wanted.yaw, ahead, s), true, true, false};
        return with_room_around(around, found, ahead, size);
    }

    // The edge lies between two of the points: halve its place, then stand on the nearer side of it.
    float low = s.along[s.gap], high = s.along[s.gap + 1];
    const auto &a = s.hits[s.gap], &b = s.hits[s.gap + 1];
    for (int i = 0; i < 4; ++i) {
        float middle = (low + high) * 0.5f;
        auto hit = under(around, ahead_by(wanted.position, ahead, middle));
        bool before =
            hit ? a && (!b || std::fabs(hit->height - a->height) < std::fabs(hit->height - b->height)) : !a;
        (before ? low : high) = middle;
    }
    auto stands_at = [&](Vec3 at) -> std::optional<Footing> {
        Sampled moved = sample(around, at, ahead, size);
        if (!moved.one) return {};
        return with_room_around(around, {on_surface(at, wanted.yaw, ahead, moved), true, true, true}, ahead,
                                size);
    };
    // An edge along the foot, or the corner of one: beside it.
    const Vec2 beside{ahead.z, -ahead.x};
    auto height_beside = [&](float aside) {
        auto hit = under(around, ahead_by(wanted.position, beside, aside));
        return hit ? hit->height : -1e9f;
    };
    if (std::fabs(height_beside(0.06f) - height_beside(-0.06f)) > k_riser) {
        for (float aside : {0.06f, 0.12f, -0.06f}) {
            Vec3 at = ahead_by(wanted.position, beside, outward * aside);
            if (auto found = stands_at(at)) return *found;
        }
    }
    float over = high + size.heel + k_margin, back = low - size.tip - k_toe_room;
    if (std::fabs(back) < std::fabs(over)) std::swap(over, back);
    for (float shift : {over, back}) {
        if (std::fabs(shift) > k_most_shift) continue;
        Vec3 at = ahead_by(wanted.position, ahead, shift);
        if (auto found = stands_at(at)) return *found;
    }
    if (!s.hits[k_ball]) return {wanted, false, false, false};  // heels alone bear nobody
    FootPlace place = wanted;
    place.position.y = s.highest;
    place.normal = {0, 1, 0};
    return {place, true, false, true};
}

bool meets_edge(const Surroundings& around, const FootPlace& place, const FootSize& size) {
    Vec2 ahead = heading_direction(place.yaw);
    for (float along : {-size.heel - k_margin, size.tip + k_margin}) {
        if (rise_over(around, place, ahead, along) > k_riser) return true;
    }
    return false;
}

bool bears_tip(const Surroundings& around, const FootPlace& place, const FootSize& size, float height) {
    auto hit = under(around, ahead_by(place.position, heading_direction(place.yaw), size.tip));
    return hit && std::fabs(hit->height - height) < k_level;
}

float step_between(const FootPlace& from, const FootPlace& to) {
    return kernel::step_between(ends_between(from, to));
}

Footing clear_of_edge(const Surroundings& around, const Footing& down, Vec2 direction, const FootSize& size,
                      float outward) {
    constexpr float k_room = 0.06f;
    float height = down.place.position.y;
    auto above = [&](float behind) {
        auto hit = under(around, ahead_by(down.place.position, direction, -size.heel - behind));
        return hit && hit->height > height + k_level;
    };
    if (!above(k_room)) return down;
    float low = 0, high = k_room;
    for (int i = 0; i < 4; ++i) {
        float middle = (low + high) * 0.5f;
        (above(middle) ? high : low) = middle;
    }
    FootPlace place = down.place;
    place.position = ahead_by(place.position, direction, k_room - low);
    Footing moved = find_footing(around, place, size, outward);
    bool same = moved.found && std::fabs(moved.place.position.y - height) < k_level;
    return same ? moved : down;
}

namespace {

// Metres that the way between these ends has to be higher in its middle, with toes and heel at some shares of
// its time, for these to pass.
template <size_t N>
float missing_height(const Surroundings& around, const kernel::SwingEnds<float>& ends, Vec2 ahead,
                     const FootSize& size, float running, float pace, const float (&times)[N]) {
    float missing = 0;
    for (float u : times) {
        kernel::SwingTime<float> time = kernel::swing_time(u);
        Vec3 place = position_of(kernel::swing_path(ends, time, running, pace).place);
        // The heel is high after it has left, and when it steps down.
        for (float along : {size.tip, u < 0.45f ? size.ball : -size.heel}) {
            auto hit = under(around, ahead_by(place, ahead, along));
            float lift = along < 0 && ends.far.y < -0.07f ? 0.04f : 0;
            if (hit) missing = std::max(missing, (hit->height - place.y - lift) / time.hop);
        }
    }
    return missing;
}

}  // namespace

Clearing clear_ground(const Surroundings& around, const FootPlace& from, const FootPlace& to,
                      const FootSize& size, float running, float pace, bool slowly) {
    constexpr float k_early[] = {0.06f, 0.1f, 0.15f, 0.2f},
                    k_later[] = {0.25f, 0.35f, 0.45f, 0.55f, 0.65f, 0.75f};
    kernel::SwingEnds<float> ends = ends_between(from, to);
    Vec2 ahead = heading_direction(from.yaw + 0.5f * wrap_angle(to.yaw - from.yaw));
    auto missing = [&](const auto& times, const FootSize& sole) {
        return missing_height(around, ends, ahead, sole, running, pace, times);
    };
    Clearing clearing;
    float rise = to.position.y - from.position.y;
    if (rise < -k_riser) {
        // It may come down as soon as its heel has passed the edge.
        ends.edge = k_soonest_fall;
        for (float u : {0.25f, 0.35f, 0.45f, 0.55f, 0.65f, 0.75f, 0.82f, 0.88f}) {
            Vec3 heel = position_of(kernel::swing_path(ends, kernel::swing_time(u), running, pace).place);
            auto hit = under(around, ahead_by(heel, ahead, -size.heel - k_margin));
            if (hit && hit->height > to.position.y + k_riser)
                ends.edge = std::max(1 - u - k_passes, k_latest_fall);
        }
    } else if (rise > k_riser) {
        const FootSize roomy{size.heel, size.ball, size.tip + k_toe_room};
        for (float waits : {0.0f, 0.25f, 0.5f, 0.75f, 1.0f}) {
            ends.edge = (slowly ? 2 : 1) * waits;
            if (missing(k_early, roomy) <= 0 && missing(k_later, roomy) < k_easily_higher) break;
        }
    }
    clearing.edge = ends.edge;
    clearing.obstacle = std::min(missing(k_later, size), 0.35f);
    return clearing;
}

Tread next_tread(const Surroundings& around, Vec3 from, Vec2 direction, float aside, float reach) {
    constexpr float k_stride = 0.06f, k_back = 0.24f;
    const Vec3 lane = ahead_by(from, {direction.z, -direction.x}, aside);
    Tread tread;
    float at = 0;
    bool on_level = false, begun = false;
    for (float d = -k_back; d < reach; d += k_stride) {
        auto hit = under(around, ahead_by(lane, direction, d));
        if (!on_level) {
            // The edge before it may lie behind `from`, or the last one ahead, where edges run aslant.
            on_level = hit && std::fabs(hit->height - from.y) < k_riser;
            if (on_level) at = hit->height, tread.level = d;
            continue;
        }
        if (!hit) return tread;
        float step = hit->height - at;
        if (std::fabs(step) >= k_riser) {
            float low = d - k_stride, high = d;
            for (int i = 0; i < 4; ++i) {
                float middle = (low + high) * 0.5f;
                auto between = under(around, ahead_by(lane, direction, middle));
                bool before = !between || std::fabs(between->height - at) < k_riser;
                (before ? low : high) = middle;
            }
            if (begun) {
                tread.end = low;
                return tread;
            }
            begun = true;
            tread.begin = tread.end = high;
            tread.height = hit->height;
            tread.down = step < 0;
        }
        at = hit->height;
    }
    return tread;
}

FarSide far_side(const Surroundings& around, Vec3 from, Vec2 direction, float reach) {
    constexpr float k_stride = 0.1f;
    bool gap = false;
    for (float d = k_stride; d < reach; d += k_stride) {
        Vec3 at = ahead_by(from, direction, d);
        auto hit = ground_at(around, at, k_ledge, k_step_down);
        bool blocked = !hit || hit->height > from.y + k_step_up;
        if (hit && (gap || blocked)) return {d, hit->height};
        gap = gap || blocked;
    }
    return {};
}

}  // namespace flaneur
