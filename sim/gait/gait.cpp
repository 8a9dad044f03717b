#include "sim/gait/gait.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/gait/curves-inl.h"
#include "sim/gait/norms.h"

namespace flaneur {

float stride_length(float v, float leg) {
    return 2 * k_step_factor * leg * std::sqrt(v / std::sqrt(k_gravity * leg));
}

float duty_factor(float v) { return clamp(0.603f - 0.06f * (v - 1.24f), 0.57f, 0.66f); }

namespace {

constexpr float k_home_slack = 0.13f;  // a standing foot farther from its place than this steps, metres
constexpr float k_home_twist = 0.55f;  // or turned farther than this, radians
constexpr float k_slowest = 0.62f;     // cycles/s while a foot is in the air
constexpr float k_shuffle = 0.95f;     // cycles/s of stepping on the spot
constexpr float k_early = 0.006996f;       // share of the cycle by which the body trusts a foot before it is down
constexpr float k_lead = 0.3891f;        // share of a foot's time on the ground before the hip passes over it
constexpr float k_settled = 0.88f;     // share of the swing after which the landing place is kept
constexpr float k_standing_speed = 0.08f;  // m/s
constexpr float k_lost = 1.2f;             // legs; a planted foot farther from its place is set down anew
constexpr float k_base_stiffness = 9.0f;   // 1/s, of the critically damped pelvis height

struct Place {
    Vec3 position;
    float yaw;
    Vec3 normal;
};

void set_place(FootBlock::Place& to, int lane, const Place& p) {
    to.x[lane] = p.position.x;
    to.y[lane] = p.position.y;
    to.z[lane] = p.position.z;
    to.yaw[lane] = p.yaw;
    to.normal_x[lane] = p.normal.x;
    to.normal_z[lane] = p.normal.z;
}

Place get_place(const FootBlock::Place& from, int lane) {
    float nx = from.normal_x[lane], nz = from.normal_z[lane];
    return {{from.x[lane], from.y[lane], from.z[lane]},
            from.yaw[lane],
            {nx, std::sqrt(std::max(0.0f, 1 - nx * nx - nz * nz)), nz}};
}

struct FootSize {
    float heel, ball, tip;  // from the ankle along the foot: backward, forward, forward
};

FootSize foot_size(const PersonBlock& p, int lane) {
    float ball = p.joints[left_toes][2][lane] - p.joints[left_foot][2][lane];
    return {p.heel[lane], ball, ball + p.toe[lane]};
}

// Heights under heel, ball and tip of a foot. `whole` is false if part of it would stand on nothing.
struct Footing {
    bool whole = true;
    float low = 0, high = 0;
    Vec3 normal;
};
Footing footing(const City& city, Vec3 at, float yaw, const FootSize& size) {
    Vec2 ahead = heading_direction(yaw);
    Footing f;
    const float along[3] = {-size.heel, size.ball, size.tip};
    for (int i = 0; i < 3; ++i) {
        Vec3 point = at + Vec3{ahead.x * along[i], 0, ahead.z * along[i]};
        auto hit = ground(city, point, 0.45f, 0.8f);
        if (!hit) {
            f.whole = false;
            continue;
        }
        f.low = i == 0 ? hit->height : std::min(f.low, hit->height);
        f.high = i == 0 ? hit->height : std::max(f.high, hit->height);
        if (i == 1) f.normal = hit->normal;
    }
    return f;
}

// The place nearest to `wanted` where a whole foot finds one surface: not half on a kerb, nor over the edge
// of a step. `root` is known to stand on ground; feet are drawn towards it where there is none.
Place find_footing(const City& city, Vec3 wanted, float yaw, const FootSize& size, Vec3 root) {
    Vec2 ahead = heading_direction(yaw);
    constexpr float k_shifts[] = {0, 0.06f, -0.06f, 0.12f, -0.12f, 0.18f, -0.18f};
    for (float shift : k_shifts) {
        Vec3 at = wanted + Vec3{ahead.x * shift, 0, ahead.z * shift};
        Footing f = footing(city, at, yaw, size);
        if (!f.whole) continue;
        float length = size.heel + size.tip;
        float rise = f.high - f.low;
        bool sloped = f.normal.y < 0.999f && rise < length * 0.5f;
        if (rise > 0.02f && !sloped) continue;
        auto hit = ground(city, at, 0.45f, 0.8f);
        if (hit) return {{at.x, hit->height, at.z}, yaw, f.normal};
    }
    for (float pull : {0.0f, 0.35f, 0.7f, 1.0f}) {
        Vec3 at = lerp(wanted, Vec3{root.x, wanted.y, root.z}, pull);
        Footing f = footing(city, at, yaw, size);
        auto hit = ground(city, at, 0.45f, 0.8f);
        if (hit) return {{at.x, f.whole ? f.high : hit->height, at.z}, yaw, {0, 1, 0}};
    }
    return {{wanted.x, root.y, wanted.z}, yaw, {0, 1, 0}};
}

// How far the ground between two places stands above the straight line between them.
float obstacle_between(const City& city, Vec3 from, Vec3 to) {
    float excess = 0;
    for (int i = 1; i <= 5; ++i) {
        float t = static_cast<float>(i) / 6;
        Vec3 p = lerp(from, to, t);
        if (auto hit = ground(city, p, 0.45f, 0.8f)) excess = std::max(excess, hit->height - p.y);
    }
    return excess;
}

Place home(const PersonBlock& person, int lane, Side side, Vec3 root, float heading) {
    float across = (side == k_left ? 0.5f : -0.5f) * person.step_width[lane];
    Vec2 ahead = heading_direction(heading);
    Vec3 left{ahead.z, 0, -ahead.x};
    float toe_out = side == k_left ? person.toe_out[lane] : -person.toe_out[lane];
    return {root + left * across, heading + toe_out, {0, 1, 0}};
}

float foot_phase(float phase, Side side) {
    float p = side == k_left ? phase : phase + 0.5f;
    return p >= 1 ? p - 1 : p;
}

// Where the foot will come down if the walker goes on as it does.
Place plan_landing(const City& city, const PersonBlock& person, int lane, Side side, Vec3 root, Vec2 velocity,
                   float heading, float turn_rate, float time_left, float contact_time) {
    float turn = clamp(turn_rate * time_left, -1.2f, 1.2f);
    SinCos half = sin_cos(turn * 0.5f);
    Vec2 v{velocity.x * half.cosine + velocity.z * half.sine,
           velocity.z * half.cosine - velocity.x * half.sine};
    Vec2 ahead = v * (time_left + k_lead * contact_time);
    Place wanted = home(person, lane, side, root + at_height(ahead, 0), heading + turn);
    return find_footing(city, wanted.position, wanted.yaw, foot_size(person, lane), root);
}

void touch_down(FootBlock& foot, int lane) {
    foot.swinging[lane] = 0;
    foot.obstacle[lane] = 0;
    Place landed = get_place(foot.to, lane);
    landed.yaw = wrap_angle(landed.yaw);
    set_place(foot.from, lane, landed);
    set_place(foot.to, lane, landed);
}

void replant(FootBlock& foot, int lane, const City& city, const PersonBlock& person, Side side, Vec3 root,
             float heading) {
    Place p = home(person, lane, side, root, heading);
    p = find_footing(city, p.position, p.yaw, foot_size(person, lane), root);
    set_place(foot.to, lane, p);
    touch_down(foot, lane);
}

struct Misfit {
    float distance = 0, twist = 0;
    float amount() const { return std::max(distance / k_home_slack, twist / k_home_twist); }
};
Misfit misfit(const FootBlock& foot, const PersonBlock& person, int lane, Side side, Vec3 root,
              float heading) {
    Place wanted = home(person, lane, side, root, heading);
    Place is = get_place(foot.to, lane);
    return {length(on_ground(wanted.position) - on_ground(is.position)),
            std::fabs(wrap_angle(wanted.yaw - is.yaw))};
}

void advance_walker(GaitBlock& g, const PersonBlock& person, int lane, Vec3 root, Vec2 velocity,
                    float heading, float turn_rate, const City& city, RandomKey key, float dt) {
    float speed = length(velocity);
    float leg = person.joints[left_upper_leg][1][lane];
    g.x[lane] = root.x;
    g.z[lane] = root.z;
    g.heading[lane] = heading;

    float wanted_amplitude = smoothstep(0.1f, 0.85f, speed);
    g.amplitude[lane] += clamp(wanted_amplitude - g.amplitude[lane], -2.6f * dt, 2.6f * dt);
    g.duty[lane] += clamp(duty_factor(speed) - g.duty[lane], -0.2f * dt, 0.2f * dt);
    float duty = g.duty[lane];

    FootBlock* feet = g.feet;
    bool in_air = feet[k_left].swinging[lane] || feet[k_right].swinging[lane];
    Misfit off[2] = {misfit(feet[k_left], person, lane, k_left, root, heading),
                     misfit(feet[k_right], person, lane, k_right, root, heading)};

    // Phase: by distance; never slower than a step can hang in the air; at rest when there is nothing to do.
    float stride = stride_length(std::max(speed, 0.05f), leg) * person.stride[lane];
    float frequency = speed / stride;
    bool wants_step = speed > k_standing_speed || off[k_left].amount() > 1 || off[k_right].amount() > 1;
    if (!wants_step && !in_air) {
        g.standing[lane] = 1;
        frequency = 0;
    } else {
        if (g.standing[lane] && g.amplitude[lane] < 0.25f) {
            // The worse foot goes first.
            Side first = off[k_left].amount() >= off[k_right].amount() ? k_left : k_right;
            float phase = first == k_left ? duty : duty + 0.5f;
            g.phase[lane] = phase >= 1 ? phase - 1 : phase;
        }
        g.standing[lane] = 0;
        float twist = std::max(off[k_left].twist, off[k_right].twist);
        float least = twist > k_home_twist || speed < 0.12f ? k_shuffle : k_slowest;
        frequency = std::max(frequency, least);
    }
    // A foot left behind, by a hard turn say, is fetched sooner.
    float behind = std::max(off[k_left].distance, off[k_right].distance);
    if (frequency > 0 && behind > 0.75f * leg) frequency = std::max(frequency, 1.5f);
    float phase = g.phase[lane] + frequency * dt;
    g.phase[lane] = phase >= 1 ? phase - 1 : phase;

    for (Side side : {k_left, k_right}) {
        FootBlock& foot = feet[side];
        float p = foot_phase(g.phase[lane], side);
        foot.phase[lane] = p;
        if (foot.swinging[lane] && p < 0.5f) touch_down(foot, lane);
        if (!foot.swinging[lane]) {
            bool lost = off[side].distance > k_lost * leg;
            if (lost) replant(foot, lane, city, person, side, root, heading);
            if (p < duty || p >= 0.98f || g.standing[lane]) continue;
        }
        float time_left = (1 - p) / std::max(frequency, k_slowest);
        float share = (p - duty) / (1 - duty);
        bool leaves = !foot.swinging[lane];
        if (!leaves && share > k_settled) continue;
        Place landing = plan_landing(city, person, lane, side, root, velocity, heading, turn_rate, time_left,
                                     duty / std::max(frequency, k_slowest));
        Place now = get_place(foot.from, lane);
        landing.yaw = now.yaw + wrap_angle(landing.yaw - now.yaw);
        if (leaves) {
            foot.swinging[lane] = 1;
        } else {
            Place before = get_place(foot.to, lane);
            float blend = std::min(1.0f, 14 * dt);
            landing.position = lerp(before.position, landing.position, blend);
            landing.yaw = lerp(before.yaw, landing.yaw, blend);
            landing.normal = lerp(before.normal, landing.normal, blend);
            if (auto hit = ground(city, landing.position, 0.45f, 0.8f)) {
                float sooner = std::min(1.0f, 3 * dt / std::max(time_left - 0.05f, dt));
                landing.position.y = lerp(landing.position.y, hit->height, sooner);
            }
        }
        set_place(foot.to, lane, landing);
        if (leaves) foot.obstacle[lane] = obstacle_between(city, now.position, landing.position);
    }

    // The pelvis rides on the ground under the feet that carry it.
    float left = HWY_NAMESPACE::left_load(foot_phase(g.phase[lane] + k_early, k_left), duty);
    g.load[lane] = left;
    float target = feet[k_left].from.y[lane] * left + feet[k_right].from.y[lane] * (1 - left);
    float w = k_base_stiffness;
    float& velocity_y = g.base_velocity[lane];
    velocity_y += (w * w * (target - g.base[lane]) - 2 * w * velocity_y) * dt;
    g.base[lane] += velocity_y * dt;

    // Heads turn into a bend before the body does, and now and then to something of interest.
    float interest = random_unit(key) < 0.3f ? random_between(key, -0.9f, 0.9f, 1) : 0;
    float look = clamp(turn_rate * 0.35f + interest * 0.6f, -0.9f, 0.9f);
    g.look[lane] += (look - g.look[lane]) * std::min(1.0f, 3.5f * dt);
}

}  // namespace

void start_gait(Gait& gait, size_t count, const std::vector<Body>& bodies, const uint32_t* body,
                const float* scale, const RootMotion& root, const City& city, uint64_t seed) {
    gait.count = count;
    gait.blocks.assign(block_count(count), {});
    gait.people.assign(block_count(count), {});
    // Lanes past the last walker hold a body too, so that kernels meet only sound numbers.
    for (size_t i = 0; i < gait.blocks.size() * k_block; ++i) {
        PersonBlock& person = gait.people[i / k_block];
        GaitBlock& g = gait.blocks[i / k_block];
        int lane = static_cast<int>(i % k_block);
        bool real = i < count;
        const Body& b = bodies[real ? body[i] : 0];
        float s = real ? scale[i] : 1;
        for (int j = 0; j < k_joint_count; ++j) {
            person.joints[j][0][lane] = b.joints[j].x * s;
            person.joints[j][1][lane] = b.joints[j].y * s;
            person.joints[j][2][lane] = b.joints[j].z * s;
        }
        RandomKey key{seed, static_cast<uint32_t>(i), 0, Purpose::style};
        person.heel[lane] = b.heel * s;
        person.toe[lane] = b.toe * s;
        person.stride[lane] = 1 + 0.04f * random_normal(key, 0);
        person.arm_swing[lane] = clamp(1 + 0.25f * random_normal(key, 1), 0.4f, 1.6f);
        person.sway[lane] = clamp(1 + 0.2f * random_normal(key, 2), 0.5f, 1.6f);
        person.toe_out[lane] = k_radians * clamp(6 + 2.5f * random_normal(key, 3), 1.0f, 12.0f);
        person.step_width[lane] = std::max(0.055f * b.height * s + 0.012f * random_normal(key, 4),
                                           0.5f * b.joints[left_upper_leg].x * s);
        person.lean[lane] = k_radians * clamp(3 + 1.5f * random_normal(key, 5), -1.0f, 8.0f);
        person.carriage[lane] = k_radians * clamp(8.5f + 1.5f * random_normal(key, 6), 6.5f, 13.0f);

        g.duty[lane] = duty_factor(0);
        g.phase[lane] = random_unit(key, 200) < 0.5f ? 0.05f : 0.55f;
        g.load[lane] = 0.5f;
        g.course[lane] = 1;
        g.standing[lane] = 1;
        Vec3 at = real ? root.position[i] : Vec3{};
        float heading = real ? root.heading[i] : 0;
        g.x[lane] = at.x;
        g.z[lane] = at.z;
        g.base[lane] = at.y;
        g.heading[lane] = heading;
        for (Side side : {k_left, k_right}) {
            g.feet[side].phase[lane] = foot_phase(g.phase[lane], side);
            if (real) {
                replant(g.feet[side], lane, city, person, side, at, heading);
            } else {
                Place p = home(person, lane, side, at, heading);
                set_place(g.feet[side].to, lane, p);
                set_place(g.feet[side].from, lane, p);
            }
        }
    }
}

void advance_gait(Gait& gait, size_t begin, size_t end, const RootMotion& root, const City& city,
                  uint64_t seed, uint32_t tick, float dt) {
    for (size_t i = begin; i < end; ++i) {
        // What a walker looks at changes every two seconds, not for all at once.
        uint32_t glance = (tick + static_cast<uint32_t>(i) * 37) / 120;
        RandomKey key{seed, static_cast<uint32_t>(i), glance, Purpose::look};
        advance_walker(gait.blocks[i / k_block], gait.people[i / k_block], static_cast<int>(i % k_block),
                       root.position[i], root.velocity[i], root.heading[i], root.turn_rate[i], city, key, dt);
    }
}

}  // namespace flaneur
