#include "sim/gait/footing.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/gait/fits.h"

namespace flaneur {

static constexpr float k_level = 0.02f;       // metres; heights this near are one surface
static constexpr float k_margin = 0.012f;     // metres between a sole and an edge
static constexpr float k_toe_room = 0.045f;   // and before the toes, which roll on when the heel rises
static constexpr float k_most_shift = 0.22f;  // metres
static constexpr float k_riser = 0.05f;       // metres; higher edges are steps
static constexpr float k_ledge = 1.1f;        // metres; higher ones cannot be jumped on

Place get_place(const FootBlock::Place& from, int lane) {
    float nx = from.normal_x[lane], nz = from.normal_z[lane];
    return {{from.x[lane], from.y[lane], from.z[lane]},
            from.yaw[lane],
            {nx, std::sqrt(std::max(0.0f, 1 - nx * nx - nz * nz)), nz}};
}

void set_place(FootBlock::Place& to, int lane, const Place& p) {
    to.x[lane] = p.position.x;
    to.y[lane] = p.position.y;
    to.z[lane] = p.position.z;
    to.yaw[lane] = p.yaw;
    to.normal_x[lane] = p.normal.x;
    to.normal_z[lane] = p.normal.z;
}

FootSize foot_size(const PersonBlock& p, int lane) {
    float ball = p.joints[left_toes][2][lane] - p.joints[left_foot][2][lane];
    return {p.heel[lane], ball, ball + p.toe[lane]};
}

namespace {

Vec3 ahead_by(Vec3 from, Vec2 way, float distance) {
    return {from.x + way.x * distance, from.y, from.z + way.z * distance};
}

std::optional<GroundHit> under(const City& city, Vec3 point) {
    return ground(city, point, k_step_up, k_step_down);
}

// The ground under four points of a sole.
struct Sampled {
    float along[4];
    std::optional<GroundHit> hits[4];
    bool whole = true;  // all there
    bool one = true;    // and of one plane
    int gap = 0;        // the points gap and gap + 1 differ most
    float highest = -1e9f;
};

Sampled sample(const City& city, Vec3 at, Vec2 ahead, const FootSize& size) {
    Sampled s{{-size.heel, 0.3f * size.ball, size.ball, size.tip}, {}};
    for (int i = 0; i < 4; ++i) {
        s.hits[i] = under(city, ahead_by(at, ahead, s.along[i]));
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

Place on_surface(Vec3 at, float yaw, Vec2 ahead, const Sampled& s) {
    const GroundHit& mid = *s.hits[1];
    float slope = -(mid.normal.x * ahead.x + mid.normal.z * ahead.z) / std::max(mid.normal.y, 0.2f);
    return {{at.x, mid.height - slope * s.along[1], at.z}, yaw, mid.normal};
}

}  // namespace

Footing find_footing(const City& city, const Place& wanted, const FootSize& size) {
    Vec2 ahead = heading_direction(wanted.yaw);
    Sampled s = sample(city, wanted.position, ahead, size);
    if (s.one) return {on_surface(wanted.position, wanted.yaw, ahead, s), true, true, false};

    // The edge lies between two of the points: halve its place, then stand on the nearer side of it.
    float low = s.along[s.gap], high = s.along[s.gap + 1];
    const auto &a = s.hits[s.gap], &b = s.hits[s.gap + 1];
    for (int i = 0; i < 4; ++i) {
        float middle = (low + high) * 0.5f;
        auto hit = under(city, ahead_by(wanted.position, ahead, middle));
        bool before =
            hit ? a && (!b || std::fabs(hit->height - a->height) < std::fabs(hit->height - b->height)) : !a;
        (before ? low : high) = middle;
    }
    float over = high + size.heel + k_margin, back = low - size.tip - k_toe_room;
    if (std::fabs(back) < std::fabs(over)) std::swap(over, back);
    for (float shift : {over, back}) {
        if (std::fabs(shift) > k_most_shift) continue;
        Vec3 at = ahead_by(wanted.position, ahead, shift);
        Sampled moved = sample(city, at, ahead, size);
        if (moved.one) return {on_surface(at, wanted.yaw, ahead, moved), true, true, true};
    }
    if (s.highest < -1e8f) return {wanted, false, false, false};
    Place place = wanted;
    place.position.y = s.highest;
    place.normal = {0, 1, 0};
    return {place, true, false, true};
}

Footing clear_of_edge(const City& city, const Footing& down, Vec2 way, const FootSize& size) {
    constexpr float k_room = 0.12f;
    float height = down.place.position.y;
    auto above = [&](float behind) {
        auto hit = under(city, ahead_by(down.place.position, way, -size.heel - behind));
        return hit && hit->height > height + k_level;
    };
    if (!above(k_room)) return down;
    float low = 0, high = k_room;
    for (int i = 0; i < 4; ++i) {
        float middle = (low + high) * 0.5f;
        (above(middle) ? high : low) = middle;
    }
    Place place = down.place;
    place.position = ahead_by(place.position, way, k_room - low);
    Footing moved = find_footing(city, place, size);
    bool same = moved.found && std::fabs(moved.place.position.y - height) < k_level;
    return same ? moved : down;
}

// The way of a swing and its height above the straight one, at share u, as pose_foot has it.
struct SwingPoint {
    Vec3 at;
    float hop;
};
static SwingPoint swing_point(const Place& from, const Place& to, float u) {
    auto eased = [](float t) { return smoothstep(0, 1, t); };
    float rest = 1 - u, hop = 16 * u * u * rest * rest;
    Vec3 far = to.position - from.position;
    float nx = (from.normal.x + to.normal.x) * 0.5f, nz = (from.normal.z + to.normal.z) * 0.5f;
    float step = far.y + (nx * far.x + nz * far.z) * (1 + 0.5f * (nx * nx + nz * nz));
    float height = std::fabs(step), steep = smoothstep(k_step_0, k_step_1, height), v = step > 0 ? u : rest;
    float slope2 = step * step / (far.x * far.x + far.z * far.z + 0.01f);
    float waits = step > 0 ? steep : std::min(k_step_waits * slope2, 1.0f) * steep;
    float onward = eased((v - k_step_wait) / (1 - k_step_wait)),
          climbs = std::min(k_step_climbs + height, 1.0f),
          upward = eased(v / (step > 0 ? climbs : lerp(k_step_falls, climbs, waits)));
    float way = eased(u) - k_way_late * u * u * u * u * u * u * rest * rest - k_way * hop;
    way = lerp(way, step > 0 ? onward : 1 - onward, waits);
    float climb = lerp(way, step > 0 ? upward : 1 - upward, steep);
    return {from.position + Vec3{far.x * way, far.y * way + step * (climb - way), far.z * way}, hop};
}

float obstacle_between(const City& city, const Place& from, const Place& to, const FootSize& size) {
    constexpr float k_samples[] = {0.25f, 0.35f, 0.45f, 0.55f, 0.65f, 0.75f};
    Vec2 way = normalize_or(on_ground(to.position - from.position), {0, 1});
    float most = 0;
    for (float u : k_samples) {
        SwingPoint point = swing_point(from, to, u);
        // The heel is high after it has left, and when it steps down.
        for (float along : {size.tip, u < 0.45f ? size.ball : -size.heel}) {
            auto hit = under(city, ahead_by(point.at, way, along));
            float lift = along < 0 && to.position.y < from.position.y - 0.07f ? 0.04f : 0;
            if (hit) most = std::max(most, (hit->height - point.at.y - lift) / point.hop);
        }
    }
    return std::min(most, 0.35f);
}

Tread next_tread(const City& city, Vec3 from, Vec2 way, float reach) {
    constexpr float k_stride = 0.06f;
    Tread tread;
    Vec3 at = from;
    for (float d = k_stride; d < reach; d += k_stride) {
        auto hit = under(city, ahead_by(at, way, d));
        if (!hit) return {};
        float step = hit->height - at.y;
        if (std::fabs(step) >= k_riser) {
            float low = d - k_stride, high = d;
            for (int i = 0; i < 4; ++i) {
                float middle = (low + high) * 0.5f;
                auto between = under(city, ahead_by(at, way, middle));
                bool before = !between || std::fabs(between->height - at.y) < k_riser;
                (before ? low : high) = middle;
            }
            if (tread.begin > 0) {
                tread.end = low;
                return tread;
            }
            tread.begin = high;
            tread.down = step < 0;
        }
        at.y = hit->height;
    }
    return {};
}

FarSide far_side(const City& city, Vec3 from, Vec2 way, float reach) {
    constexpr float k_stride = 0.1f;
    bool gap = false;
    for (float d = k_stride; d < reach; d += k_stride) {
        Vec3 at = ahead_by(from, way, d);
        auto hit = ground(city, at, k_ledge, k_step_down);
        bool blocked = !hit || hit->height > from.y + k_step_up;
        if (hit && (gap || blocked)) return {d, hit->height};
        gap = gap || blocked;
    }
    return {};
}

}  // namespace flaneur
