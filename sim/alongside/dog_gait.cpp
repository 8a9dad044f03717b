#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/alongside/dog.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_up = 0.45f, k_down = 0.8f;             // metres in which ground is looked for
constexpr float k_walks_at = 0.38f, k_trots_at = 0.62f;  // Froude numbers
constexpr float k_walk_lag = 0.22f, k_trot_lag = 0.5f;
constexpr float k_short = 0.875f;  // of who keeps by somebody: short quick strides
// Hips that a foot may be behind its home or aside of it while the other one of its end stands, and at all,
// for it not to leave before its time.
constexpr float k_behind = 0.52f, k_aside = 0.22f, k_away = 0.68f;
constexpr float k_still = 0.06f;       // m/s
constexpr float k_off_home = 0.12f;    // hips, of a foot of one who stands
constexpr float k_own_step = 3.2f;     // shares a second, of a step of its own
constexpr float k_rides = 9;           // 1/s, critically damped: the trunk over the ground
constexpr float k_lift = 0.16f;        // hips, that a pad rises in a step
constexpr float k_sits_ahead = 0.56f;  // withers, that hind feet come ahead to sit

float froude(const Dog& dog, float speed) { return speed * speed / (k_gravity * hip_height(dog)); }

// By x of the shape, 1 left, and whether it is a hind leg.
bool is_hind(int leg) { return leg >= k_hind_left; }

// The phase of a foot.
float phase_of(const Dog& dog, int leg) {
    const float lag = lerp(k_walk_lag, k_trot_lag, smoothstep(0, 1, dog.trots));
    float phase = dog.phase;
    if (leg == k_hind_right || leg == k_fore_right) phase += 0.5f;
    if (!is_hind(leg)) phase -= lag;
    return phase - std::floor(phase);
}

// Where a foot of one who stands like that would be, on the plane.
Vec2 home_of(const Dog& dog, int leg) {
    const DogShape& shape = shape_of(dog.breed);
    const float w = withers_of(dog);
    Vec3 pad = shape.pads[static_cast<size_t>(leg)] * w;
    if (is_hind(leg)) pad.z += k_sits_ahead * w * dog.sits;
    // A bent trunk turns each end its own way.
    const float yaw = dog.heading + (is_hind(leg) ? -0.5f : 0.5f) * dog.bend;
    const Vec2 ahead = heading_direction(yaw);
    return on_ground(dog.position) + ahead * pad.z + left_of(ahead) * pad.x;
}

Vec3 on_the_ground(const Surroundings& around, Vec2 at, float near) {
    const auto hit = ground_at(around, at_height(at, near), k_up, k_down);
    return at_height(at, hit ? hit->height : near);
}

// As near to there as no edge is, along the dog.
Vec3 off_edges(const Surroundings& around, const Dog& dog, Vec3 at) {
    constexpr float k_edge = 0.03f, k_keeps = 0.045f;  // metres
    const Vec2 way = heading_direction(dog.heading) * k_keeps;
    auto differs = [&](Vec2 by) {
        return std::fabs(on_the_ground(around, on_ground(at) + by, at.y).y - at.y) > k_edge;
    };
    const bool ahead = differs(way), behind = differs(-way);
    if (ahead == behind) return at;
    return on_the_ground(around, on_ground(at) + (ahead ? -way : way), at.y);
}

// Where the foot is to come down, so that it stands half of its time ahead of home and half behind.
Vec3 landing_of(const Dog& dog, int leg, float seconds, float stance, const Surroundings& around) {
    const Vec2 goes = dog.velocity * (seconds + 0.5f * stance);
    const float turn = dog.turn_rate * seconds;
    const Vec2 arm = home_of(dog, leg) - on_ground(dog.position);
    const SinCos by = sin_cos(turn);
    // Headings grow towards +x.
    const Vec2 turned{arm.x * by.cosine + arm.z * by.sine, arm.z * by.cosine - arm.x * by.sine};
    return off_edges(around, dog,
                     on_the_ground(around, on_ground(dog.position) + turned + goes, dog.feet[leg].at.y));
}

// The pad on its way: over the higher end and what lies between.
void swing(DogFoot& foot, float lift, const Surroundings& around) {
    const float t = smoothstep(0, 1, foot.share), up = foot.share;
    Vec3 at = lerp(foot.from, foot.to, t);
    const float climbs = std::max(foot.to.y - foot.from.y, 0.0f),
                falls = std::max(foot.from.y - foot.to.y, 0.0f);
    // It rises before it goes ahead over an edge, and comes down behind one.
    at.y = foot.from.y + (climbs > 0 ? climbs * smoothstep(0, 0.55f, up) : -falls * smoothstep(0.45f, 1, up));
    at.y += (lift + 0.12f * std::max(climbs, falls)) * 4 * up * (1 - up);
    // Over what is there, and is in a moment.
    const Vec3 soon = lerp(foot.from, foot.to, smoothstep(0, 1, std::min(up + 0.12f, 1.0f)));
    for (const Vec3 over : {at, soon}) at.y = std::max(at.y, on_the_ground(around, on_ground(over), at.y).y);
    foot.at = at;
}

struct Rhythm {
    float frequency = 0;  // strides a second
    float stance = 0.3f;  // seconds that a foot stands
};

Rhythm rhythm_of(const Dog& dog, float speed) {
    const float h = hip_height(dog), f = std::max(froude(dog, speed), 0.02f);
    // F^0.34 and F^0.14 by what there is: both are within 2 % of these from 0.02 to 3.
    const float root = std::sqrt(f), fourth = std::sqrt(root), eighth = std::sqrt(fourth);
    const float stride = k_short * 2.4f * h * fourth * std::sqrt(eighth * std::sqrt(eighth));
    const float slow = 1.0f / std::max(stride, 0.05f);
    const float frequency = clamp(speed * slow, 0.0f, 4.5f);
    return {frequency, dog.duty / std::max(frequency, 0.4f)};
}

void choose_gait(Dog& dog, float speed, float dt) {
    const float f = froude(dog, speed);
    const float wants = smoothstep(k_walks_at, k_trots_at, f);
    dog.trots += clamp(wants - dog.trots, -1.2f * dt, 1.2f * dt);
    const float eighth = std::sqrt(std::sqrt(std::sqrt(std::max(f, 0.05f))));
    const float duty = clamp(0.52f / eighth, 0.42f, 0.72f);
    dog.duty += (duty - dog.duty) * std::min(4 * dt, 1.0f);
    const float goes = smoothstep(0.03f, 0.35f, speed);
    dog.moves += (goes - dog.moves) * std::min(6 * dt, 1.0f);
}

bool stands(const DogFoot& foot) { return foot.share >= 1; }

void begin_step(DogFoot& foot, Vec3 to, float pace) {
    foot.from = foot.at;
    foot.to = to;
    foot.share = 0;
    foot.pace = pace;
}

// One that would be dragged, as in a narrow bend, leaves early.
bool is_dragged(const Dog& dog, int leg) {
    constexpr int k_mate[] = {k_fore_right, k_fore_left, k_hind_right, k_hind_left};
    const Vec2 off = home_of(dog, leg) - on_ground(dog.feet[leg].at),
               way = normalize_or(dog.velocity, {0, 0});
    const float h = hip_height(dog);
    if (length(off) > k_away * h) return true;
    const bool is_far = dot(off, way) > k_behind * h || std::fabs(cross(off, way)) > k_aside * h;
    return is_far && stands(dog.feet[k_mate[leg]]);
}

// Feet of one who goes: each as its phase has it.
void stride_on(Dog& dog, const Rhythm& rhythm, const Surroundings& around, float dt) {
    const float lift = k_lift * hip_height(dog);
    for (int leg = 0; leg < 4; ++leg) {
        DogFoot& foot = dog.feet[leg];
        const float phase = phase_of(dog, leg);
        const float swings = (1 - dog.duty) / std::max(rhythm.frequency, 0.4f);  // seconds
        if (stands(foot)) {
            if (phase < dog.duty && !is_dragged(dog, leg)) continue;
            begin_step(foot, landing_of(dog, leg, swings, rhythm.stance, around), 0);
        }
        // Of the swing, by its phase; one that began late hurries.
        const float due = phase < dog.duty ? 1 : 1 - (1 - phase) / (1 - dog.duty);
        const float late = std::max(due - foot.share, 0.0f);
        foot.share =
            std::min(foot.share + dt / std::max(swings, dt) * (0.95f + std::min(1.2f * late, 0.35f)), 1.0f);
        const float seconds = (1 - foot.share) * swings;
        // One that comes late stands shorter.
        const float rests = phase < dog.duty ? (dog.duty - phase) / std::max(rhythm.frequency, 0.4f) - seconds
                                             : rhythm.stance;
        // The place is kept for the last of it.
        if (foot.share < 0.7f) {
            const Vec3 to = landing_of(dog, leg, seconds, clamp(rests, 0, rhythm.stance), around);
            foot.to += (to - foot.to) * std::min(14 * dt, 1.0f);
            foot.to = off_edges(around, dog, on_the_ground(around, on_ground(foot.to), foot.to.y));
        }
        if (foot.share >= 1)
            foot.at = foot.to;
        else
            swing(foot, lift, around);
    }
}

// Feet of one who stands: one after the other comes to where it should be.
void shift_feet(Dog& dog, const Surroundings& around, float dt) {
    const float lift = 0.7f * k_lift * hip_height(dog);
    bool is_any = false;
    for (DogFoot& foot : dog.feet) {
        if (stands(foot)) continue;
        is_any = true;
        foot.share = std::min(foot.share + std::max(foot.pace, k_own_step) * dt, 1.0f);
        if (foot.share >= 1)
            foot.at = foot.to;
        else
            swing(foot, lift, around);
    }
    if (is_any) return;
    int worst = -1;
    const float least = k_off_home * hip_height(dog);
    float most = least;
    auto off = [&](int leg) { return length(on_ground(dog.feet[leg].at) - home_of(dog, leg)); };
    for (int leg = 0; leg < 4; ++leg)
        if (off(leg) > most) most = off(leg), worst = leg;
    if (worst < 0) return;
    // The foot across the body goes along where it has to soon.
    const int across = k_hind_right - worst;
    if (off(across) > 0.5f * least)
        begin_step(dog.feet[across], on_the_ground(around, home_of(dog, across), dog.feet[across].at.y),
                   k_own_step);
    begin_step(dog.feet[worst], on_the_ground(around, home_of(dog, worst), dog.feet[worst].at.y), k_own_step);
}

void spring(float& value, float& rate, float goal, float dt) {
    rate += ((goal - value) * k_rides - 2 * rate) * (k_rides * dt);
    value += rate * dt;
}

// Trunk ends ride over the ground between where the feet of each stand and land.
void ride(Dog& dog, float dt) {
    auto height = [&](int left, int right) {
        auto of = [&](const DogFoot& foot) {
            return lerp(foot.from.y, foot.to.y, stands(foot) ? 1 : foot.share);
        };
        return 0.5f * (of(dog.feet[left]) + of(dog.feet[right]));
    };
    spring(dog.fore, dog.fore_rate, height(k_fore_left, k_fore_right), dt);
    spring(dog.hind, dog.hind_rate, height(k_hind_left, k_hind_right), dt);
}

}  // namespace

float hip_height(const Dog& dog) { return shape_of(dog.breed).joints[dog_left_thigh].y * withers_of(dog); }

void stand_dog(Dog& dog, const Surroundings& around) {
    for (int leg = 0; leg < 4; ++leg) {
        const Vec3 at = on_the_ground(around, home_of(dog, leg), dog.position.y);
        dog.feet[leg] = {at, at, at, 1, 0};
    }
    dog.fore = 0.5f * (dog.feet[k_fore_left].at.y + dog.feet[k_fore_right].at.y);
    dog.hind = 0.5f * (dog.feet[k_hind_left].at.y + dog.feet[k_hind_right].at.y);
    dog.fore_rate = dog.hind_rate = 0;
}

void step_dog(Dog& dog, const DogWish& wish, const Surroundings& around, float dt) {
    const float speed = length(dog.velocity);
    choose_gait(dog, speed, dt);
    const Rhythm rhythm = rhythm_of(dog, speed);
    const bool goes = speed > k_still;
    if (goes) {
        // A stride is never so slow that a foot is left behind.
        dog.phase += std::max(rhythm.frequency, 0.7f * dog.moves) * dt;
        dog.phase -= std::floor(dog.phase);
        stride_on(dog, rhythm, around, dt);
    } else {
        shift_feet(dog, around, dt);
    }
    const float bend = clamp(0.35f * dog.turn_rate, -0.5f, 0.5f);
    dog.bend += (bend - dog.bend) * std::min(5 * dt, 1.0f);
    const float sits = wish.sits && !goes ? 1.0f : 0.0f;
    dog.sits += clamp(sits - dog.sits, -1.7f * dt, 1.1f * dt);
    ride(dog, dt);
}

}  // namespace flaneur
