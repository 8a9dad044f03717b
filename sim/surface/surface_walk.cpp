#include "sim/surface/surface_walk.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

constexpr float k_half = 0.22f;        // from the middle to the rays down, metres
constexpr float k_high = 0.5f;         // where they begin above the surface, metres
constexpr float k_deep = 1.2f;         // how far they reach, metres
constexpr float k_knee = 0.25f;        // height of the ray ahead, metres
constexpr float k_edge = 0.3f;         // how far it reaches, metres
constexpr float k_most_turn = 3.5f;    // of its up, radians a second
constexpr float k_gain = 0.8f;         // of its pace, metres a second each second
constexpr float k_hurry = 1.5f;        // most that it moves, against what it likes
constexpr float k_bend = 0.35f;        // of its way, radians a second
constexpr uint32_t k_bend_ticks = 90;  // for so long
constexpr float k_foresight = 2.5f;    // seconds in which it looks whom it meets
constexpr float k_room = 0.3f;         // metres that it means to keep from others' bodies,
constexpr float k_spare = 0.12f;       // and those before which it stops
constexpr float k_stands = 0.05f;      // metres a second
constexpr float k_swerve = 1.4f;       // radians a second, at most, to get out of their way
constexpr float k_brake = 3;           // metres a second each second, as it means to,
constexpr float k_hardest_brake = 6;   // and where another comes in its way
constexpr float k_same_side = 0.3f;    // cosine between the ups of those who can meet
constexpr float k_landed_turn = 0.3f;  // radians a second, of up
constexpr float k_gathers = 2.5f;      // m/s2, with which one stops who is to leap
constexpr float k_led_gain = 4;        // m/s2, of who is led by hand,
constexpr float k_led_turn = 3;        // its radians a second at most,
constexpr float k_led_comes = 5;       // and for each radian that it looks elsewhere than it is to go

// Between 0 and 1, smooth over time and unlike anybody else's.
float whim(uint64_t seed, size_t walker, uint32_t tick) {
    uint32_t n = tick / k_bend_ticks;
    auto at = [&](uint32_t i) {
        return random_unit({seed, static_cast<uint32_t>(walker), i, Purpose::destination});
    };
    float t = static_cast<float>(tick % k_bend_ticks) / static_cast<float>(k_bend_ticks);
    return lerp(at(n), at(n + 1), smoothstep(0, 1, t));
}

// Unit vector `v` turned about unit vector `axis`, to which it is square.
Vec3 turned(Vec3 v, Vec3 axis, float angle) {
    SinCos s = sin_cos(angle);
    return v * s.cosine + cross(axis, v) * s.sine;
}

Vec3 square_to(Vec3 v, Vec3 up) {
    Vec3 other = std::fabs(up.x) < 0.7f ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
    return normalize_or(v - up * dot(v, up), normalize_or(cross(up, other), {0, 0, 1}));
}

SurfaceProbe::Side cast_side(const Compound& compound, Vec3 from, Vec3 way, float reach) {
    SurfaceProbe::Side side;
    side.from = from;
    side.to = from + way * reach;
    if (auto hit = cast_ray(compound, from, way, reach)) {
        side.is_hit = true;
        side.point = hit->point;
        side.normal = hit->normal;
    }
    return side;
}

SurfaceProbe probe(const Compound& compound, Vec3 position, Vec3 up, Vec3 ahead) {
    SurfaceProbe out;
    for (int i : {0, 1}) {
        Vec3 from = position + ahead * (i == 0 ? k_half : -k_half) + up * k_high;
        out.sides[i] = cast_side(compound, from, -up, k_deep);
    }
    SurfaceProbe::Side level = cast_side(compound, position + up * k_knee, ahead, k_edge);
    level.is_level = true;
    if (level.is_hit) out.sides[0] = level;
    const auto& [front, back] = out.sides;
    if (front.is_hit && back.is_hit) {
        out.point = (front.point + back.point) * 0.5f;
        out.normal = normalize_or(front.normal + back.normal, up);
    } else if (front.is_hit || back.is_hit) {
        out.point = front.is_hit ? front.point : back.point;
        out.normal = front.is_hit ? front.normal : back.normal;
    }
    return out;
}

// What others make one do.
struct Meeting {
    float swerve = 0;      // radians a second
    float fastest = 1e9f;  // metres a second
};

Meeting meet_others(const SurfaceWalkers& w, size_t i, float dt) {
    const Vec3 here = w.position[i], up = w.up[i], ahead = w.ahead[i];
    const Vec3 velocity = ahead * w.pace[i];
    const float reach = w.radius[i] + w.widest + k_room + k_foresight * 2 * std::max(w.speed[i], 1.0f);
    auto level = [&](Vec3 v) { return v - up * dot(v, up); };
    Meeting out;
    float most = 0;
    auto at = std::ranges::lower_bound(w.seen, here.x - reach, {},
                                       [](const SurfaceSeen& s) { return s.position.x; });
    for (; at != w.seen.end() && at->position.x <= here.x + reach; ++at) {
        const Vec3 away = at->position - here;
        if (at->walker == i || dot(at->up, up) < k_same_side || length_squared(away) > reach * reach)
            continue;
        const Vec3 d = level(away), v = level(at->velocity - velocity);
        const float touch = w.radius[i] + at->radius, apart = length(d), along = dot(d, ahead);
        if (along <= 0) continue;  // whoever is behind sees to it
        // Whom it would run into straight on: it stops before.
        const Vec3 aside = d - ahead * along;
        if (length(aside) < touch + k_spare) {
            const float gap = std::max(apart - touch - k_spare - w.pace[i] * dt, 0.0f);
            const float theirs = std::max(dot(at->velocity, ahead), 0.0f);
            out.fastest = std::min(out.fastest, std::sqrt(2 * k_brake * gap) + (gap > 0 ? theirs : 0));
        }
        // Nearest in the next seconds.
        const float v2 = length_squared(v);
        const float when = v2 > 1e-6f ? clamp(-dot(d, v) / v2, 0, k_foresight) : 0;
        const Vec3 nearest = d + v * when;
        const float need = touch + k_room - length(nearest);
        if (need <= 0) continue;
        const float urgency = need / (touch + k_room) * (1 - 0.7f * when / k_foresight);
        if (urgency <= most) continue;
        most = urgency;
        // From where it will be; straight on: to the right.
        const float side = dot(cross(ahead, length_squared(nearest) > 1e-4f ? nearest : d), up);
        const float turn = k_swerve * std::min(2 * urgency, 1.0f);
        out.swerve = side < 0 ? turn : -turn;
    }
    // Among several one turns to and fro: who has come to stand turns on to one side.
    if (out.fastest < k_stands && w.pace[i] < k_stands) out.swerve = -k_swerve;
    return out;
}

// What one means to do in a tick, by itself.
struct Intent {
    float turn_rate = 0;  // radians a second
    float speed = 0;      // m/s
    float gain = k_gain;  // m/s2
};

Intent intent_of(const SurfaceWalkers& w, size_t i, uint64_t seed, uint32_t tick, float dt) {
    if (w.leaps[i].stage == LeapStage::gathers) return {0, std::max(w.pace[i] - k_gathers * dt, 0.0f)};
    if (w.leaps[i].stage != LeapStage::none) return {};
    if (i != w.led) return {k_bend * (2 * whim(seed, i, tick) - 1), w.speed[i], k_gain};
    const Vec3 up = w.up[i], ahead = w.ahead[i], wish = w.wish[i] - up * dot(w.wish[i], up);
    const float speed = length(wish);
    if (speed < k_stands) return {0, 0, k_led_gain};
    const float off = arctan2(dot(cross(ahead, wish), up), dot(ahead, wish));
    const float turn = clamp(k_led_comes * off, -k_led_turn, k_led_turn);
    // Who is to go back turns before it goes.
    return {turn, speed * clamp(dot(ahead, wish) / speed, 0, 1), k_led_gain};
}

}  // namespace

Quat frame_of(Vec3 up, Vec3 ahead) {
    Quat upright = rotation_between({0, 1, 0}, up);
    Vec3 forward = rotate(upright, {0, 0, 1});
    float sine = dot(cross(forward, ahead), up), cosine = dot(forward, ahead);
    return upright * rotation_y(arctan2(sine, cosine));
}

Vec3 turned_towards(Vec3 from, Vec3 to, float most) {
    SinCos s = sin_cos(most);
    float cosine = dot(from, to);
    if (cosine >= s.cosine) return to;
    Vec3 aside = normalize_or(to - from * cosine, {});
    return normalize_or(from * s.cosine + aside * s.sine, from);
}

void look_round(SurfaceWalkers& w) {
    const auto count = static_cast<uint32_t>(w.position.size());
    w.seen.reserve(2 * size_t{count});
    w.seen.clear();
    for (uint32_t i = 0; i < count; ++i) {
        const Leap& leap = w.leaps[i];
        if (leap.stage != LeapStage::flies)
            w.seen.push_back({w.position[i], w.up[i], w.ahead[i] * w.pace[i], w.radius[i], i});
        if (leap.stage == LeapStage::flies || leap.stage == LeapStage::crouches)
            w.seen.push_back({leap.place, leap.normal, {}, w.radius[i], i});
    }
    std::ranges::sort(w.seen, [](const SurfaceSeen& a, const SurfaceSeen& b) {
        return a.position.x != b.position.x ? a.position.x < b.position.x : a.walker < b.walker;
    });
}

SurfaceWalkers place_on_surface(const Compound& c, const std::vector<float>& speed,
                                const std::vector<float>& radius, uint64_t seed) {
    SurfaceWalkers w;
    std::vector<Vec3> middles;
    for (const Sphere& s : c.spheres) middles.push_back(s.centre);
    for (const Capsule& s : c.capsules) middles.push_back((s.a + s.b) * 0.5f);
    middles.insert(middles.end(), c.middles.begin(), c.middles.end());
    if (!c.vertices.empty() && c.middles.empty()) {
        Vec3 sum;
        for (Vec3 v : c.vertices) sum += v;
        middles.push_back(sum / static_cast<float>(c.vertices.size()));
    }
    if (middles.empty()) return w;
    constexpr uint32_t k_attempts = 64;
    constexpr float k_far = 1000;  // metres
    for (uint32_t i = 0; i < speed.size(); ++i) {
        for (uint32_t attempt = 0; attempt < k_attempts; ++attempt) {
            RandomKey key{seed, i, attempt, Purpose::spawn};
            auto middle = static_cast<size_t>(random_unit(key) * static_cast<float>(middles.size()));
            Vec3 way = normalize_or({random_normal(key, 1), random_normal(key, 2), random_normal(key, 3)},
                                    {0, 1, 0});
            auto hit = cast_ray(c, middles[std::min(middle, middles.size() - 1)] + way * k_far, -way, k_far);
            if (!hit) continue;
            const bool is_taken = std::ranges::any_of(w.seen, [&](const SurfaceSeen& other) {
                return length(other.position - hit->point) < other.radius + radius[i] + k_room;
            });
            if (is_taken) continue;
            w.seen.push_back({hit->point, hit->normal, {}, radius[i], i});
            float turn = random_between({seed, i, attempt, Purpose::destination}, -k_pi, k_pi);
            w.position.push_back(hit->point);
            w.up.push_back(hit->normal);
            w.ahead.push_back(turned(square_to({0, 0, 1}, hit->normal), hit->normal, turn));
            w.speed.push_back(speed[i]);
            w.radius.push_back(radius[i]);
            w.widest = std::max(w.widest, radius[i]);
            break;
        }
    }
    w.pace.resize(w.position.size());
    w.turn_rate.resize(w.position.size());
    w.moved.resize(w.position.size());
    w.probes.resize(w.position.size());
    w.leaps.resize(w.position.size());
    w.wish.resize(w.position.size());
    w.leaps_at_will.resize(w.position.size());
    w.stands.resize(w.position.size());
    w.middle.resize(w.position.size(), 1);
    return w;
}

void walk_on_surface(const Compound& compound, SurfaceWalkers& w, size_t begin, size_t end, uint64_t seed,
                     uint32_t tick, float dt) {
    for (size_t i = begin; i < end; ++i) {
        const LeapStage stage = w.leaps[i].stage;
        if (stage == LeapStage::flies || stage == LeapStage::crouches) {
            w.turn_rate[i] = w.moved[i] = w.pace[i] = 0;
            continue;
        }
        Vec3 position = w.position[i], up = w.up[i];
        const Meeting meeting = meet_others(w, i, dt);
        const Intent intent = intent_of(w, i, seed, tick, dt);
        const bool is_free = stage == LeapStage::none && i != w.led;
        w.turn_rate[i] = intent.turn_rate + (is_free ? meeting.swerve : 0);
        Vec3 ahead = turned(w.ahead[i], up, w.turn_rate[i] * dt);
        const float most = std::min({w.pace[i] + intent.gain * dt, intent.speed, meeting.fastest});
        w.pace[i] = std::max({most, w.pace[i] - k_hardest_brake * dt, 0.0f});
        Vec3 there = position + ahead * (w.pace[i] * dt);
        SurfaceProbe& p = w.probes[i];
        p = probe(compound, there, up, ahead);
        if (!p.sides[0].is_hit && !p.sides[1].is_hit) {  // nothing to stand on: back
            w.ahead[i] = -ahead;
            w.moved[i] = 0;
            continue;
        }
        // Both feet stand where one lands: up comes round without moving them.
        const float most_turn = stage == LeapStage::absorbs ? k_landed_turn : k_most_turn;
        up = turned_towards(up, p.normal, most_turn * dt);
        // The points' mean lies beside a curved surface: down, or up, to it.
        auto hit = surface_below(compound, p.point + up * k_high, up, k_deep);
        Vec3 next = hit ? hit->point : p.point;
        // In a corner the mean may jump.
        float way = length(next - position), farthest = k_hurry * w.pace[i] * dt;
        if (way > farthest) {
            next = lerp(position, next, farthest / way);
            if (auto on = surface_below(compound, next + up * k_high, up, k_deep)) next = on->point;
        }
        w.moved[i] = length(next - position);
        w.position[i] = next;
        w.up[i] = up;
        w.ahead[i] = square_to(ahead, up);
    }
}

}  // namespace flaneur
