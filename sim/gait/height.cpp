#include "sim/gait/height.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/body/body.h"
#include "sim/gait/rise-inl.h"

namespace flaneur {

static constexpr float k_base_stiffness = 12;      // 1/s, critically damped
static constexpr float k_step_down_least = 0.03f;  // metres
static constexpr float k_stairs_wait = 0.4f;       // of the swing
static constexpr float k_farthest_ahead = 0.6f;    // seconds that are foreseen
static constexpr float k_soonest = 0.08f;          // seconds
static constexpr float k_most_effort = 9;          // m/s2
static constexpr float k_step_most = 0.2f;         // metres
static constexpr float k_most_sink = 0.2f;         // legs
static constexpr float k_just_landed = 0.1f;       // of the cycle
static constexpr float k_bears = 0.36f;  // of a foot's phase on the ground, until its heel begins to give
static constexpr float k_heel_gives_0 = 0.45f, k_heel_gives_1 = 1.05f;  // radians, then and as it leaves
static constexpr float k_heel_gives_pace = 0.6f;      // more for each pace over the natural one
static constexpr float k_contact_pitch_sine = 0.27f;  // of a foot that comes down on its heel
static constexpr float k_tiptoe_sine = 0.247f;        // of one that comes down on its ball

namespace {

// The height of the ground for the pelvis: that of the foot which carries it; of the lower foot when it steps
// down, by the time that foot lands; and it rises only as the higher foot takes the load.
float carrying_height(const GaitBlock& g, int lane, Vec3 root, float leg) {
    const FootBlock &l = g.feet[k_left], &r = g.feet[k_right];
    if (!l.swinging[lane] && !r.swinging[lane]) {
        float left = height_on(l.from, lane, on_ground(root)),
              right = height_on(r.from, lane, on_ground(root));
        // Whoever has stepped down stays down.
        bool last_is_left = l.phase[lane] < r.phase[lane];
        // Small children stay below until the other foot comes after.
        if (std::fabs(left - right) > k_step_down_least && sets_both_feet(leg)) return std::min(left, right);
        bool left_is_high = left > right;
        if (!g.standing[lane] && last_is_left != left_is_high) return std::min(left, right);
        float high = left_is_high ? g.load[lane] : 1 - g.load[lane];
        return lerp(std::min(left, right), std::max(left, right), 0.6f * high);
    }
    bool both = l.swinging[lane] && r.swinging[lane];
    const FootBlock &swings = l.swinging[lane] ? l : r, &stands = l.swinging[lane] ? r : l;
    float from =
        both ? lerp(height_on(l.from, lane, on_ground(root)), height_on(r.from, lane, on_ground(root)), 0.5f)
             : height_on(stands.from, lane, on_ground(root));
    float to =
        both ? lerp(height_on(l.to, lane, on_ground(root)), height_on(r.to, lane, on_ground(root)), 0.5f)
             : height_on(swings.to, lane, on_ground(root));
    float duty = g.duty[lane];
    float u = smoothstep(duty, lerp(duty, 1, 0.6f), swings.phase[lane]);
    return both || to < from ? lerp(from, to, u) : from;
}

// The acceleration that moves a body at `velocity` by so many metres in the time given, and leaves it at
// rest: one that changes evenly, whose square is the least over that time.
float least_effort(float by, float velocity, float seconds) {
    return clamp((6 * by / seconds - 4 * velocity) / seconds, -k_most_effort, k_most_effort);
}

// Seconds until a swinging foot lands.
float until_contact(const GaitBlock& g, const FootBlock& foot, int lane) {
    return (1 - foot.phase[lane]) / std::max(foot.rate[lane], g.frequency[lane]);
}

// What lets the body down onto a lower foot by the time that it lands; 0: nothing does. On stairs the foot
// goes ahead, so that its knee need not bend far.
float let_down(const GaitBlock& g, const Stepper& s) {
    int lane = s.lane;
    bool left = g.feet[k_left].swinging[lane] != 0;
    if (left == (g.feet[k_right].swinging[lane] != 0)) return 0;
    const FootBlock &swings = g.feet[left ? k_left : k_right], &stands = g.feet[left ? k_right : k_left];
    float to = height_on(swings.goal, lane, on_ground(s.root));
    float begins = g.tread[lane] > 0 ? lerp(g.duty[lane], 1, k_stairs_wait) : 0;
    if (swings.phase[lane] < begins) return 0;
    float from = height_on(stands.from, lane, on_ground(s.root)), by = to - g.base[lane];
    if (to > from - k_step_down_least || by > 0) return 0;
    return least_effort(by, g.base_velocity[lane], std::max(until_contact(g, swings, lane), k_soonest));
}

void advance_base(GaitBlock& g, const Stepper& s, float speed) {
    int lane = s.lane;
    float w = k_base_stiffness,
          target = carrying_height(g, lane, s.root, s.leg_length) + 1.2f / w * g.rise[lane] * speed;
    float& velocity = g.base_velocity[lane];
    float down = let_down(g, s);
    velocity += (down != 0 ? down : w * w * (target - g.base[lane]) - 2 * w * velocity) * s.dt;
    g.base[lane] += velocity * s.dt;
    float rise = speed > 0.2f ? clamp(velocity / speed, -0.8f, 0.8f) : 0;
    g.rise[lane] += (rise - g.rise[lane]) * std::min(1.0f, 3 * s.dt);
}

// What a foot does while the pelvis is over it.
enum class Bears { lands, stands, leaves };

// Metres by which the pelvis at `root`, on ground at `base`, would be higher than the leg of `side` lets it,
// its foot at `place`, with `rise` as in rise-inl.h.
float too_high(const GaitBlock& g, const Stepper& s, Side side, const FootPlaces& place, Vec2 root,
               float base, float rise, Bears bears) {
    int lane = s.lane;
    const auto& joints = s.person.joints;
    float hip_x = joints[left_upper_leg][0][lane] * (side == k_left ? 1.0f : -1.0f);
    float ankle = joints[left_foot][1][lane], reach = (s.leg_length - ankle) * k_straightest;
    Vec2 hip = root + Vec2{s.facing.z, -s.facing.x} * hip_x;
    Vec2 foot{place.x[lane], place.z[lane]};
    float up = ankle;
    const bool lands = bears == Bears::lands;
    if (bears == Bears::leaves) {
        // The heel may rise as high as it is when the foot leaves.
        float ball = joints[left_toes][2][lane] - joints[left_foot][2][lane],
              ball_height = joints[left_toes][1][lane], instep = ankle - ball_height;
        float gives = smoothstep(k_bears, 1, g.feet[side].phase[lane] / g.duty[lane]);
        float fast = k_heel_gives_pace * std::max(g.pace[lane] - k_natural_pace, 0.0f);
        SinCos tilt = sin_cos(lerp(k_heel_gives_0, k_heel_gives_1, gives) + fast);
        float forward = ball - ball * tilt.cosine + instep * tilt.sine;
        Vec2 ahead = heading_direction(place.yaw[lane]);
        up = instep * tilt.cosine + ball * tilt.sine + ball_height;
        up += height_on(place, lane, foot + ahead * forward) - place.y[lane];
        foot += ahead * forward;
    }
    if (lands) {
        float ahead = g.amplitude[lane] * std::max(g.course[lane], 0.0f),
              forefoot = g.feet[side].forefoot[lane];
        float ball = joints[left_toes][2][lane] - joints[left_foot][2][lane];
        float pitch = k_contact_pitch_sine * s.person.strike[lane] * ahead;
        float heel_up = s.person.heel[lane] * pitch, back = ankle * pitch;
        up += lerp(heel_up, ball * k_tiptoe_sine, forefoot);
        foot -= heading_direction(place.yaw[lane]) * lerp(back, -ankle * k_tiptoe_sine, forefoot);
    }
    float flat2 = length_squared(foot - hip), reach2 = reach * reach;
    float hip_height = base + s.leg_length * (1 + rise) - g.crouch[lane] - s.person.crouch[lane];
    float slow = std::max(k_natural_pace - g.pace[lane], 0.0f) * g.amplitude[lane];
    float above = hip_height + k_spare_slow * slow - place.y[lane] - up;
    if (lands && g.tread[lane] <= 0)
        above +=
            k_downstep * clamp(step_between(get_place(place, lane), get_place(g.feet[1 - side].from, lane)),
                               0, k_step_most);
    if (above <= 0 || above * above + flat2 <= reach2) return 0;
    return above - std::sqrt(std::max(reach2 - flat2, 0.25f * reach2));
}

// The pelvis comes down in time for what the next contact will let it, and for the legs that carry it; and up
// again at leisure.
void advance_sink(GaitBlock& g, const Stepper& s) {
    namespace kernel = HWY_NAMESPACE;
    int lane = s.lane;
    // What the legs that carry need now, and what the next landing does in so many seconds.
    float now = 0, coming = 0, until = k_soonest, over = kernel::over_natural(g.pace[lane]);
    auto rise_at = [&](SinCosOf<float> twice) {
        return kernel::pelvis_rise(g.step[lane], over, g.amplitude[lane], clamp(g.rise[lane], 0, k_steepest),
                                   twice);
    };
    bool walks = g.running[lane] <= 0.5f && g.jump[lane] <= 0;
    for (Side side : {k_left, k_right}) {
        const FootBlock& foot = g.feet[side];
        if (walks && foot.swinging[lane]) {
            float seconds = std::min(until_contact(g, foot, lane), k_farthest_ahead);
            Vec2 root = on_ground(s.root) + (s.velocity + expected_velocity(s, seconds)) * (0.5f * seconds);
            const FootPlaces& stands = g.feet[1 - side].from;
            float base = std::min(height_on(foot.goal, lane, root), height_on(stands, lane, root));
            base += std::max(g.base[lane] - std::max(height_on(stands, lane, on_ground(s.root)), base), 0.0f);
            float amount = too_high(g, s, side, foot.goal, root, base, rise_at({0, 1}), Bears::lands);
            if (amount > coming) coming = amount, until = std::max(seconds, k_soonest);
        } else if (walks) {
            auto wave = kernel::harmonics<2>(g.phase[lane]);
            bool lands = foot.phase[lane] < k_just_landed && !g.standing[lane];
            bool stands = foot.phase[lane] < k_bears &&
                          dot(on_ground(s.root) - Vec2{foot.from.x[lane], foot.from.z[lane]}, s.facing) <
                              k_behind_0 * s.leg_length;
            Bears bears = lands ? Bears::lands : stands ? Bears::stands : Bears::leaves;
            now = std::max(now, too_high(g, s, side, foot.from, on_ground(s.root), g.base[lane],
                                         rise_at({wave.sine[1], wave.cosine[1]}), bears));
        }
    }
    float most = k_most_sink * s.leg_length;
    now = std::min(now, most), coming = std::min(coming, most);
    float &sink = g.sink[lane], &velocity = g.sink_velocity[lane], w = k_sink_release;
    float a =
        now > sink ? least_effort(now - sink, velocity, k_soonest) : w * w * (now - sink) - 2 * w * velocity;
    // As late as may be, so that knees do not bend for a landing that is far.
    if (coming > sink) {
        float effort = least_effort(coming - sink, velocity, until);
        a = lerp(a, std::max(a, effort), smoothstep(0.5f * k_sink_effort, k_sink_effort, effort));
    }
    velocity += a * s.dt;
    sink += velocity * s.dt;
}

}  // namespace

void advance_height(GaitBlock& g, const Stepper& s, float speed) {
    advance_base(g, s, speed);
    advance_sink(g, s);
}

}  // namespace flaneur
