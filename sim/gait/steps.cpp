#include "sim/gait/steps.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "sim/base/math.h"
#include "sim/body/body.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/shoes.h"

namespace flaneur {

static constexpr float k_longest_lead = 0.46f;  // legs, from the root to a landing foot
// Added by one who goes aside: to the share of the stance that it leads, and metres to the most.
static constexpr float k_aside_lead = 0.2f, k_most_aside = 0.06f;
static constexpr float k_leap_lead = 0.36f;                 // likewise, where it lands from a leap
static constexpr float k_outward = 0.95f, k_inward = 0.5f;  // radians, of a landing foot against the heading
static constexpr float k_apart = 0.75f;  // of the step width, at least, between the lines of both feet
static constexpr float k_beside_most = 0.05f, k_crosses = 0.15f, k_crosses_before = 0.2f;  // metres
static constexpr float k_converges = 0.1f;  // radians between feet, of one who turns on the spot
static constexpr float k_wide_way =
    0.1f;  // metres round the other foot, for which one would rather land beside it
static constexpr float k_turns = 0.15f;  // radians until the next step, of one who turns
static constexpr float k_longest_step = 1.15f, k_longest_run_step = 2.3f;  // legs, from the other foot
static constexpr float k_moved = 0.02f,
                       k_turned = 0.08f;       // metres, radians; changes that are planned for anew
static constexpr float k_worth_it = 0.05f;     // metres, of a step of one who stands
static constexpr float k_settled = 0.09f;      // seconds before contact in which the landing place is kept
static constexpr float k_about_there = 0.25f;  // metres between a landing that is kept and what is wished
static constexpr float k_committed = 0.3f;     // seconds before contact in which it stays on its level
static constexpr float k_at_hand = 0.04f;      // metres from the body's, of a level that it may change to
static constexpr float k_committed_stopping = 0.15f;  // and of one who stops on stairs
static constexpr float k_following = 13;              // 1/s, of the landing place towards its goal
static constexpr float k_most_twist = 0.75f, k_easy_twist = 0.3f;  // radians of a leg, before its foot turns
                                                                   // on the ball; with its heel up
static constexpr float k_heel_rises = 6;                           // 1/s, of one that does
static constexpr float k_stair = 0.07f;           // metres between feet that begin a flight of steps
static constexpr float k_clear_of_edge = 0.1f;    // metres
static constexpr float k_farthest_shift = 0.34f;  // legs
static constexpr float k_deepest = 0.22f;         // legs from foot to foot, down a slope
static constexpr float k_over_edge = 0.06f;       // metres
static constexpr float k_lunge = 0.52f;           // legs, from the body ahead to a foot as it lands
static constexpr float k_longest_down = 0.84f;    // from the other foot
static constexpr float k_first_lead = 0.36f;      // and onto the first stair down
static constexpr float k_still_up = 0.72f;        // phase of a swing, until which it may come down later
static constexpr float k_off_riser = 0.02f;       // metres
static constexpr float k_reach_treads = 1.0f;     // metres
static constexpr float k_beside = 0.1f;           // metres from foot to foot, of one that has come beside
static constexpr float k_over_foot = 0.65f;  // treads from a foot, on which one who stands still can stand
static constexpr float k_one_step = 0.45f;   // metres, of a tread that nobody takes in two

// Which way is outward: +1, to the left, or -1.
static float outward_of(Side side) { return side == k_left ? 1.0f : -1.0f; }
static Vec2 outward_from(Vec2 facing, Side side) { return Vec2{facing.z, -facing.x} * outward_of(side); }

Vec2 expected_velocity(const Stepper& s, float seconds) {
    Vec2 change = s.wish - s.velocity;
    float l = length(change), most = s.brakes * seconds;
    return l > most ? s.velocity + change * (most / l) : s.wish;
}

// The way that a body goes in so many seconds from `velocity` on, if it slows down to the speed `to`.
static Vec2 slowing_way(const Stepper& s, Vec2 velocity, float to, float seconds) {
    const float speed = length(velocity), less = speed - to;
    if (less <= 0) return velocity * seconds;
    const float hard = std::min(std::max(less / s.brakes - 1 / k_gentle, 0.0f), seconds),
                rest = less - s.brakes * hard,
                gently = (1 - exponential(-k_gentle * (seconds - hard))) / k_gentle;
    return velocity * ((to * seconds + 0.5f * (less + rest) * hard + rest * gently) / speed);
}

// Likewise, towards its wish.
static Vec2 way_under(const Stepper& s, Vec2 velocity, float seconds) {
    return slowing_way(s, velocity, std::min(length(s.wish), length(velocity)), seconds);
}

Vec2 stopping_way(const Stepper& s) {
    constexpr float k_rests = 3;  // seconds
    return slowing_way(s, s.velocity, 0, k_rests);
}

FootPlace home(const GaitBlock& g, const PersonBlock& person, int lane, Side side, Vec3 root, float heading) {
    const FootBlock& foot = g.feet[side];
    float outward = outward_of(side);
    float across = outward * (0.5f * person.step_width[lane] + foot.stance_out[lane]);
    Vec2 ahead = heading_direction(heading);
    Vec3 left{ahead.z, 0, -ahead.x};
    float toe_out = outward * (person.toe_out[lane] + foot.stance_turn[lane]);
    return {
        root + left * across + at_height(ahead * foot.stance_ahead[lane], 0), heading + toe_out, {0, 1, 0}};
}

// Where the ground has no better place for it, a foot would step in vain.
float Misfit::amount(float slack) const {
    return std::max(std::min(distance, unasked) / slack, twist / k_home_twist);
}

namespace {

Side other(Side side) { return side == k_left ? k_right : k_left; }

// Where the foot should land if the walker goes on towards its wish, before the ground is asked.
FootPlace wished_landing(const GaitBlock& g, const Stepper& s, Side side, float seconds, float frequency) {
    float duty = g.duty[s.lane];
    // Who steps aside has the body between the feet, not beyond them.
    float aside = (1 - std::fabs(g.course[s.lane])) * (1 - g.amplitude[s.lane]);
    float lead_time =
        lerp(k_lead * s.person.lead[s.lane], k_run_lead, g.running[s.lane]) + k_aside_lead * aside * aside;
    float stands = lead_time * duty / frequency, until = seconds + stands;
    Vec2 later = expected_velocity(s, seconds);
    // Who walks turns by turning, below. Steps get quicker with the root of the speed.
    float speed2 = length_squared(s.velocity);
    if (speed2 > 0.09f) {
        float gain = std::max(dot(later, s.velocity) / speed2, 0.0f), quicker = std::sqrt(gain);
        later = s.velocity * gain;
        if (gain > 1) seconds *= 2 / (1 + quicker), stands /= quicker;
    }

    float turn = s.turn_rate * until;
    if (wishes_to_go(s)) {
        float rest = wrap_angle(heading_of(s.wish) - s.heading);
        turn = rest > 0 ? std::min(turn, rest) : std::max(turn, rest);
    }
    turn = clamp(turn, -1.2f, 1.2f);
    // No farther ahead of the root than the other foot will be behind it: so high does the pelvis stand.
    const FootPlaces& to = g.feet[other(side)].to;
    Vec2 there{to.x[s.lane], to.z[s.lane]};
    Vec2 ahead = (s.velocity + later) * (0.5f * seconds), lead = way_under(s, later, stands);
    float leads = length(lead),
          behind = dot(on_ground(s.root) + ahead - there, lead) / std::max(leads, 1e-4f);
    float most_lead = 0.96f * std::max(behind, 0.0f) + 0.01f + k_most_aside * aside * aside;
    bool alone = !g.feet[other(side)].swinging[s.lane] && g.flight[s.lane] <= 0;
    most_lead = std::min(most_lead, lerp(k_longest_lead, 1.0f, g.running[s.lane]) * s.leg_length);
    if (alone && leads > most_lead) lead = lead * (most_lead / leads);
    // A leap ends on a foot well ahead.
    if (!alone && g.flight[s.lane] > 0 && g.running[s.lane] <= 0 && leads > 1e-4f)
        lead = lead * (std::max(leads, k_leap_lead * s.leg_length) / leads);
    ahead += lead;
    SinCos half = sin_cos(turn * 0.5f);
    ahead = {ahead.x * half.cosine + ahead.z * half.sine, ahead.z * half.cosine - ahead.x * half.sine};
    float heading = s.heading + turn;
    FootPlace place = home(g, s.person, s.lane, side, s.root + at_height(ahead, 0), heading);

    // On its own side of the other foot, and within a step of it.
    const Vec2 facing = heading_direction(heading), outward = outward_from(facing, side);
    Vec2 apart = on_ground(place.position) - there + outward * g.feet[side].beside[s.lane];
    float missing = k_apart * s.person.step_width[s.lane] - dot(apart, outward);
    if (missing > 0) {
        // Where that would lead far beside the body, it crosses over in front of the other one.
        const bool before = dot(apart, facing) > k_crosses_before;
        apart +=
            outward * (before ? std::max(std::min(missing, k_beside_most), missing - k_crosses) : missing);
    }
    float step = length(apart);
    float longest = g.flight[s.lane] > 0 ? 1.6f : lerp(k_longest_step, k_longest_run_step, g.running[s.lane]);
    longest *= s.leg_length;
    if (alone && step > longest) apart = apart * (longest / step);
    place.position.x = there.x + apart.x;
    place.position.z = there.z + apart.z;
    place.position.y = to.y[s.lane];

    float out = outward_of(side), yaw = wrap_angle(place.yaw - s.heading) * out;
    place.yaw = s.heading + out * clamp(yaw, -k_inward, k_outward);

    const FootPlace beside = get_place(g.feet[other(side)].to, s.lane);
    // Who turns on the spot keeps the feet together, and so from pointing to each other.
    const float inward = out * wrap_angle(beside.yaw - place.yaw);
    if (!wishes_to_go(s)) place.yaw += out * std::max(inward - k_converges, 0.0f);
    if (g.tread[s.lane] <= 0) {
        const FootSize size = foot_size(s.person, s.lane);
        keep_shoes_apart(place, beside, size, outward);
        const bool turns = std::fabs(turn) > k_turns;
        const float round =
            turns ? way_round(get_place(g.feet[side].from, s.lane), place, beside, size, out) : 0;
        place.position += at_height(outward * clamp(round - k_wide_way, 0, k_beside_most), 0);
    }
    return place;
}

// On stairs one tread is a step: the foot lands on the next one after the other foot's; of small children,
// beside the other foot where that has gone ahead. The height of a tread that it climbs to, if it does.
std::optional<float> keep_to_treads(GaitBlock& g, const Stepper& s, Side side, const FootSize& size,
                                    FootPlace& wished, float seconds) {
    FootPlace from = get_place(g.feet[side].from, s.lane), there = get_place(g.feet[other(side)].to, s.lane);
    Vec2 direction = normalize_or(s.velocity, s.facing);
    bool both = sets_both_feet(s.leg_length);
    const Vec2 to = on_ground(wished.position - there.position);
    const float along = dot(to, direction), aside = to.x * direction.z - to.z * direction.x;
    Tread next = next_tread(s.around, there.position, direction, aside, k_reach_treads);
    const bool stands = length(s.velocity) < k_standing_speed;
    // Who stops sets the feet on the tread over which the body comes to rest.
    const Vec2 rests = on_ground(s.root) + stopping_way(s);
    const bool gathers = !wishes_to_go(s) && std::fabs(dot(rests - on_ground(there.position), direction)) <
                                                 k_over_foot * g.tread[s.lane];
    const bool apart = std::fabs(step_between(from, there)) > k_stair;
    if (g.tread[s.lane] > 0 && (gathers || (both && apart))) {
        // Where edges run aslant, what lies beside that foot may be another tread.
        float low = next.level + size.heel + k_off_riser, high = next.begin - size.tip;
        float beside = both && next.begin > next.level ? std::max(std::min(0.0f, high), low) : 0;
        wished.position += at_height(direction * (beside - along), 0);
        return {};
    }
    float& tread = g.tread[s.lane];
    if (next.end <= next.begin) {
        tread = 0;
        return {};
    }
    float low = next.begin + size.heel + k_off_riser,
          high = next.end - size.tip - (next.down ? 0 : k_off_riser);
    // Down, the toes come near the next edge, and the heel passes clear of the last one.
    // On a tread shorter than the foot, toes hang over down, heels up.
    float fit = next.down ? clamp(along + k_clear_of_edge, low, std::max(low, high))
                          : clamp(along, std::min(low, high), high);
    // Long treads take two steps, and so may the one before a flight; on it, who slows down goes on to the
    // next if the body comes after.
    const float depth = next.end - next.begin;
    const Vec2 body = on_ground(s.root) + way_under(s, s.velocity, seconds);
    const float lead = dot(on_ground(there.position) - body, direction) + fit;
    const bool goes_on = tread > 0 && depth < k_one_step && lead < k_longest_lead * s.leg_length;
    const bool begins = tread > 0 || !next.down || lead < k_first_lead * s.leg_length;
    const bool steps = goes_on || (begins && fit - along < k_farthest_shift * s.leg_length);
    if (steps || !stands) tread = steps ? depth : 0;
    if (!steps) return {};
    wished.position += at_height(direction * (fit - along), 0);
    return next.down ? std::nullopt : std::optional(next.height);
}

// A step down passes its edge by a little, or stays before it, where the next one begins.
Footing down_or_before(const Stepper& s, Side side, const Footing& down, const FootPlace& wished, Vec3 there,
                       Vec2 direction, const FootSize& size, float seconds) {
    Footing over = clear_of_edge(s.around, down, direction, size, outward_of(side));
    float level = s.root.y - k_stair;
    float shift = dot(on_ground(over.place.position - wished.position), direction);
    if (shift < k_over_edge || s.root.y < down.place.position.y + k_stair) return over;
    Vec2 body = on_ground(s.root) + way_under(s, s.velocity, seconds);
    const float step = dot(on_ground(over.place.position - there), direction);
    bool lunges = dot(on_ground(over.place.position) - body, direction) > k_lunge * s.leg_length ||
                  step > k_longest_down * s.leg_length;
    for (float back : {0.08f, 0.16f, 0.24f, 0.32f}) {
        if (!lunges && back > shift + k_over_edge) break;  // the longer step is less of a change
        FootPlace nearer = wished;
        nearer.position += at_height(direction * -back, 0);
        Footing before = find_footing(s.around, nearer, size, outward_of(side));
        if (before.found && before.whole && before.place.position.y > level) return before;
    }
    return over;
}

// Where the ground has offered a place on the other shoe, one beside it, if there is.
Footing beside_shoe(const Stepper& s, Side side, const Footing& footing, const FootPlace& there,
                    const FootSize& size) {
    FootPlace place = footing.place;
    keep_shoes_apart(place, there, size, outward_from(heading_direction(place.yaw), side));
    if (place.position == footing.place.position) return footing;
    const Footing off = find_footing(s.around, place, size, outward_of(side));
    const bool good =
        off.found && off.whole && std::fabs(off.place.position.y - footing.place.position.y) < k_stair;
    return good && room_between(off.place, there, size) > room_between(footing.place, there, size) ? off
                                                                                                   : footing;
}

// Finds the landing for `wished`; false if a jump has to.
bool plan(GaitBlock& g, const Stepper& s, Side side, FootPlace wished, bool leaves, float seconds) {
    FootBlock& foot = g.feet[side];
    FootSize size = foot_size(s.person, s.lane);
    foot.wished_x[s.lane] = wished.position.x;
    foot.wished_z[s.lane] = wished.position.z;
    foot.wished_yaw[s.lane] = wished.yaw;
    FootPlace there = get_place(g.feet[other(side)].to, s.lane);
    Vec2 direction = normalize_or(s.velocity, s.facing);
    Vec3 here{s.root.x, there.position.y, s.root.z};
    if (g.flight[s.lane] > 0) {
        FarSide far = far_side(s.around, here, direction, k_longest_jump);
        float short_of = far.distance + size.heel + 0.05f - dot(on_ground(wished.position - here), direction);
        if (far.distance > 0) wished.position.y = far.height;
        if (far.distance > 0 && short_of > 0) wished.position += at_height(direction * short_of, 0);
    }
    std::optional<float> climbs_to;
    if (g.tread[s.lane] > 0) climbs_to = keep_to_treads(g, s, side, size, wished, seconds);
    Footing footing = find_footing(s.around, wished, size, outward_of(side));
    const bool begins = !footing.found || std::fabs(step_between(there, footing.place)) > k_stair;
    if (begins && g.tread[s.lane] <= 0 && g.running[s.lane] < 0.5f && g.flight[s.lane] <= 0) {
        climbs_to = keep_to_treads(g, s, side, size, wished, seconds);
        if (g.tread[s.lane] > 0) footing = find_footing(s.around, wished, size, outward_of(side));
    }
    // Up treads shorter than the foot, heels hang over.
    if (climbs_to && footing.found && footing.place.position.y < *climbs_to - k_stair &&
        bears_tip(s.around, wished, size, *climbs_to)) {
        footing = {wished, true, false, true};
        footing.place.position.y = *climbs_to;
        footing.place.normal = {0, 1, 0};
    }
    // Nobody reaches far down a steep slope.
    float down = there.position.y - footing.place.position.y, deepest = k_deepest * s.leg_length;
    if (leaves && footing.found && down > deepest && g.flight[s.lane] <= 0 &&
        std::fabs(step_between(there, footing.place)) < k_stair) {
        FootPlace nearer = wished;
        nearer.position = lerp(there.position, wished.position, deepest / down);
        Footing shorter = find_footing(s.around, nearer, size, outward_of(side));
        if (shorter.found) footing = shorter, wished = nearer;
    }
    if (footing.found && g.tread[s.lane] <= 0 && step_between(there, footing.place) < -k_stair)
        footing = down_or_before(s, side, footing, wished, there.position, direction, size, seconds);
    // A body cannot be let down, or lifted, in no time.
    bool goes = g.tread[s.lane] <= 0 || wishes_to_go(s);
    bool committed =
        !leaves && seconds < (goes ? k_committed : k_committed_stopping) && g.flight[s.lane] <= 0;
    auto is_near = [&](const Footing& f) {
        const float y = f.place.position.y;
        return f.found && (!committed || std::fabs(y - foot.goal.y[s.lane]) < k_stair ||
                           std::fabs(y - g.base[s.lane]) < k_at_hand);
    };
    auto find_towards = [&](Vec3 to, std::initializer_list<float> pulls) {
        for (float pull : pulls) {
            FootPlace nearer = wished;
            nearer.position = lerp(wished.position, to, pull);
            footing = find_footing(s.around, nearer, size, outward_of(side));
            if (is_near(footing)) return;
        }
    };
    if (committed && !is_near(footing)) {
        // As near to there as its level goes.
        const Vec3 kept{foot.goal.x[s.lane], wished.position.y, foot.goal.z[s.lane]};
        find_towards(kept, {0.25f, 0.5f, 0.75f});
        if (!is_near(footing) && length(on_ground(wished.position - kept)) < k_about_there) return true;
    }
    if (!is_near(footing)) {
        bool jumps = leaves && g.flight[s.lane] <= 0 && g.amplitude[s.lane] > 0.3f;
        if (jumps && far_side(s.around, here, direction, k_longest_jump).distance > 0) return false;
        // Nearer to the root, which is known to stand on ground.
        Vec2 root = on_ground(s.root) + s.velocity * (committed ? seconds : 0);
        Vec3 known = at_height(root, wished.position.y);
        find_towards(known, {0.35f, 0.7f, 1.0f});
        if (committed && !is_near(footing)) return true;
        if (!footing.found) footing.place.position.y = s.root.y;
    }
    if (g.tread[s.lane] <= 0 && footing.found) footing = beside_shoe(s, side, footing, there, size);
    FootPlace from = get_place(foot.from, s.lane), landing = footing.place;
    landing.yaw = from.yaw + wrap_angle(landing.yaw - from.yaw);
    set_place(foot.goal, s.lane, landing);
    foot.goal_round[s.lane] =
        g.running[s.lane] > 0 ? 0
                              : outward_of(side) * way_round(from, landing, there, size, outward_of(side));
    if (leaves) foot.obstacle[s.lane] = 0;
    if (leaves || footing.stepped) {
        Clearing clearing = clear_ground(s.around, from, landing, size, g.running[s.lane], g.pace[s.lane],
                                         sets_both_feet(s.leg_length));
        foot.obstacle[s.lane] = std::max(foot.obstacle[s.lane], clearing.obstacle);
        // A foot that has begun to come down goes on.
        if (leaves || g.feet[side].phase[s.lane] < k_still_up) foot.edge[s.lane] = clearing.edge;
    }
    return true;
}

}  // namespace

std::optional<Side> astride(const GaitBlock& g, const Stepper& s) {
    const FootBlock &l = g.feet[k_left], &r = g.feet[k_right];
    if (g.tread[s.lane] <= 0 || l.swinging[s.lane] || r.swinging[s.lane]) return {};
    if (std::fabs(l.to.y[s.lane] - r.to.y[s.lane]) < k_stair) return {};
    auto ahead = [&](const FootBlock& foot) {
        return dot(Vec2{foot.to.x[s.lane], foot.to.z[s.lane]} - on_ground(s.root), s.facing);
    };
    // Where it has not found room beside the other one, it has not.
    if (std::fabs(ahead(l) - ahead(r)) < k_beside) return {};
    return std::fabs(ahead(l)) > std::fabs(ahead(r)) ? k_left : k_right;
}

bool stays(GaitBlock& g, const Stepper& s, Side side) {
    FootBlock& foot = g.feet[side];
    FootPlace is = get_place(foot.from, s.lane),
              wished = home(g, s.person, s.lane, side, s.root, s.heading + s.turn_rate * k_turn_ahead);
    wished.position.y = is.position.y;
    Footing footing = find_footing(s.around, wished, foot_size(s.person, s.lane), outward_of(side));
    bool moves = footing.found && length(footing.place.position - is.position) > k_worth_it;
    // Who stands on one stair with both feet does not go to another one for it.
    const bool beside = std::fabs(is.position.y - g.feet[other(side)].to.y[s.lane]) < k_stair;
    if (g.tread[s.lane] > 0 && beside && std::fabs(footing.place.position.y - is.position.y) > k_stair)
        moves = false;
    if (moves || std::fabs(wrap_angle(wished.yaw - is.yaw)) > k_home_twist) return false;
    foot.wished_x[s.lane] = wished.position.x;
    foot.wished_z[s.lane] = wished.position.z;
    foot.wished_yaw[s.lane] = wished.yaw;
    return true;
}

bool lift_off(GaitBlock& g, const Stepper& s, Side side, float seconds, float frequency) {
    FootBlock& foot = g.feet[side];
    foot.beside[s.lane] = s.person.stray[s.lane] * g.amplitude[s.lane] * random_normal(s.chance);
    if (!plan(g, s, side, wished_landing(g, s, side, seconds, frequency), true, seconds)) return false;
    foot.swinging[s.lane] = 1;
    set_place(foot.to, s.lane, get_place(foot.goal, s.lane));
    foot.round[s.lane] = foot.goal_round[s.lane];
    return true;
}

void swing(GaitBlock& g, const Stepper& s, Side side, float seconds, float frequency) {
    FootBlock& foot = g.feet[side];
    // However slowly it goes on, its place is kept from the same part of its way on.
    float left = seconds;
    if (g.jump[s.lane] <= 0) left = std::min(left, (1 - foot.phase[s.lane]) / frequency);
    if (s.replans && left > k_settled) {
        FootPlace wished = wished_landing(g, s, side, seconds, frequency);
        float moved = std::max(std::fabs(wished.position.x - foot.wished_x[s.lane]),
                               std::fabs(wished.position.z - foot.wished_z[s.lane]));
        float turned = std::fabs(wished.yaw - foot.wished_yaw[s.lane]);
        if (moved > k_moved || turned > k_turned) plan(g, s, side, wished, false, left);
    }
    // Swiftly enough to be there in time.
    float share = std::min(1.0f, s.dt * std::max(k_following, 2.5f / std::max(seconds, s.dt)));
    auto follow = [&](float* to, const float* goal) { to[s.lane] += (goal[s.lane] - to[s.lane]) * share; };
    follow(foot.to.x, foot.goal.x);
    follow(foot.to.y, foot.goal.y);
    follow(foot.to.z, foot.goal.z);
    follow(foot.to.yaw, foot.goal.yaw);
    follow(foot.to.normal_x, foot.goal.normal_x);
    follow(foot.to.normal_z, foot.goal.normal_z);
    follow(foot.round, foot.goal_round);
    approach(foot.pivots[s.lane], 0, k_heel_rises * s.dt);
}

void touch_down(GaitBlock& g, const Stepper& s, Side side) {
    FootBlock& foot = g.feet[side];
    foot.swinging[s.lane] = 0;
    foot.obstacle[s.lane] = foot.round[s.lane] = foot.goal_round[s.lane] = 0;
    FootPlace landed = get_place(foot.goal, s.lane);
    landed.yaw = wrap_angle(landed.yaw);
    set_place(foot.from, s.lane, landed);
    set_place(foot.to, s.lane, landed);
}

void replant(GaitBlock& g, const Stepper& s, Side side) {
    Footing footing = find_footing(s.around, home(g, s.person, s.lane, side, s.root, s.heading),
                                   foot_size(s.person, s.lane), outward_of(side));
    set_place(g.feet[side].goal, s.lane, footing.place);
    touch_down(g, s, side);
}

void pivot(GaitBlock& g, const Stepper& s, Side side) {
    FootBlock& foot = g.feet[side];
    const FootPlace was = get_place(foot.from, s.lane);
    FootPlace is = was;
    float toe_out = s.person.toe_out[s.lane] + foot.stance_turn[s.lane];
    if (side == k_right) toe_out = -toe_out;
    float off = wrap_angle(s.heading + toe_out - is.yaw);
    float most = lerp(k_most_twist, k_easy_twist,
                      smoothstep(0.65f * g.duty[s.lane], 0.95f * g.duty[s.lane], foot.phase[s.lane]));
    float excess = off > 0 ? std::max(off - most, 0.0f) : std::min(off + most, 0.0f);
    approach(foot.pivots[s.lane], excess != 0 ? 1.0f : 0.0f, k_heel_rises * s.dt);
    if (excess == 0) return;
    excess = clamp(excess, -4 * s.dt, 4 * s.dt);
    FootSize size = foot_size(s.person, s.lane);
    float ball = size.ball;
    Vec2 before = heading_direction(is.yaw) * ball, after = heading_direction(is.yaw + excess) * ball;
    Vec2 by = before - after;
    is.position += Vec3{by.x, -(is.normal.x * by.x + is.normal.z * by.z) / std::max(is.normal.y, 0.2f), by.z};
    is.yaw = wrap_angle(is.yaw + excess);
    if (meets_edge(s.around, is, size)) return;
    const FootBlock& beside = g.feet[other(side)];
    if (!beside.swinging[s.lane] && turns_onto(was, is, get_place(beside.to, s.lane), size)) return;
    set_place(foot.from, s.lane, is);
    set_place(foot.to, s.lane, is);
    set_place(foot.goal, s.lane, is);
}

}  // namespace flaneur
