#include "sim/fall/settle.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_up = 0.9f, k_down = 2.5f;
// Where the ground is uneven a ball has as much under it as is near: so it does not meet a riser all at once.
constexpr int k_rings = 3, k_rays = 6;
constexpr float k_unseen = 0.12f;
constexpr float k_ring = 0.035f, k_steep = 1.6f;  // metres; of metres, by which what is farther counts less

using Balls = std::array<Vec3, k_ball_count>;
using Heights = std::array<float, k_ball_count>;

struct GroundBelow {
    const Surroundings& around;
    float floor;
    float unseen = 0;  // metres, by which what is near a ball, and not under it, counts less
    bool is_plane = false, has_steps = false;
    Vec3 at{}, normal{0, 1, 0};
};

// A plane, if all that limbs may come to is one; with steps, if some of it is well off that plane.
GroundBelow ground_below(const Surroundings& around, float floor, const Balls& balls) {
    constexpr float k_level = 0.004f, k_rough = 0.06f, k_limbs[] = {0.5f, 1};  // metres
    constexpr size_t k_ways = 8, k_places = k_ball_count + 2 * k_ways;
    GroundBelow below{around, floor};
    below.is_plane = true;
    std::array<Vec3, k_places> places;
    std::copy(balls.begin(), balls.end(), places.begin());
    for (size_t i = 0; i < 2 * k_ways; ++i) {
        const Vec2 way = heading_direction(2 * k_pi * static_cast<float>(i % k_ways) / k_ways);
        places[k_ball_count + i] = balls[0] + at_height(way * k_limbs[i / k_ways], 0);
    }
    std::array<std::optional<GroundHit>, k_places> hits;
    ground_at(around, places, k_up, k_down, hits.data());
    for (size_t k = 0; k < k_places; ++k) {
        if (!hits[k] && k >= k_ball_count) continue;  // a wall's other side
        if (!hits[k]) below.has_steps = true;
        if (!hits[k] || below.has_steps) break;
        if (k == 0)
            below.at = at_height(on_ground(balls[0]), hits[0]->height), below.normal = hits[0]->normal;
        const Vec3 step = at_height(on_ground(places[k]), hits[k]->height) - below.at;
        const float off = std::fabs(dot(step, below.normal));
        if (off > k_level) below.is_plane = false;
        if (off > k_rough) below.has_steps = true;
    }
    if (below.has_steps) below.is_plane = false;
    return below;
}

float height_on(const GroundBelow& below, Vec2 place) {
    const Vec2 off = place - on_ground(below.at);
    return below.at.y - (below.normal.x * off.x + below.normal.z * off.z) / below.normal.y;
}

// Of the ground under each ball from `first` on.
void find_heights(const GroundBelow& below, std::span<const Vec3> balls, float* heights) {
    if (below.is_plane) {
        for (size_t k = 0; k < balls.size(); ++k) heights[k] = height_on(below, on_ground(balls[k]));
        return;
    }
    constexpr size_t k_samples = 1 + k_rings * k_rays;
    if (!below.has_steps) {
        std::array<std::optional<GroundHit>, k_ball_count> hits;
        ground_at(below.around, balls, k_up, k_down, hits.data());
        for (size_t k = 0; k < balls.size(); ++k) heights[k] = hits[k] ? hits[k]->height : below.floor;
        return;
    }
    static const auto offsets = [] {
        std::array<Vec2, k_samples> all{};
        for (int ray = 0; ray < k_rays; ++ray)
            for (int ring = 0; ring < k_rings; ++ring)
                all[static_cast<size_t>(1 + ray * k_rings + ring)] =
                    heading_direction(2 * k_pi * static_cast<float>(ray) / k_rays) *
                    (k_ring * static_cast<float>(ring + 1));
        return all;
    }();
    std::array<Vec3, k_samples> places;
    std::array<std::optional<GroundHit>, k_samples> hits;
    for (size_t k = 0; k < balls.size(); ++k) {
        for (size_t i = 0; i < k_samples; ++i) places[i] = balls[k] + at_height(offsets[i], 0);
        ground_at(below.around, places, k_up, k_down, hits.data());
        float highest = -1e6f;
        for (size_t i = 0; i < k_samples; ++i) {
            const float height = hits[i] ? hits[i]->height : i == 0 ? below.floor : -1e6f;
            const float less = i == 0 ? 0 : k_steep * length(offsets[i]) + below.unseen;
            highest = std::max(highest, height - less);
        }
        heights[k] = highest;
    }
}

// How far a ball is above the ground; negative in it.
float clear_of(const GroundBelow& below, const Segments& segments, int ball, Vec3 at, float height) {
    const float slope = below.is_plane ? std::max(below.normal.y, 0.5f) : 1;
    return at.y - height - segments.radius[static_cast<size_t>(ball)] / slope;
}

constexpr int k_shank_of[] = {12, 20}, k_elbow_of[] = {7, 15}, k_palm_of[] = {9, 17};  // balls
struct BallRange {
    int first, count;
};
constexpr BallRange k_trunk{0, 7}, k_left_arm{7, 3}, k_left_leg{10, 5}, k_right_arm{15, 3},
    k_right_leg{18, 5};
constexpr int k_legs = 3;  // balls of shank and foot, from that of the shank on

bool bears(int ball) {
    const Segment s = k_segment_of_ball[static_cast<size_t>(ball)];
    return s <= skull || s == left_thigh || s == right_thigh;
}

struct Setting {
    const Segments& segments;
    const PersonBlock& person;
    int lane;
    const GroundBelow& below;

    Balls balls(const BodyPose& pose) const { return balls_of(pose, segments, person, lane); }
    // The least that balls [first, first + count) are above the ground.
    float least(const Balls& at, int first, int count) const {
        Heights heights;
        const std::span<const Vec3> some{at.data() + first, static_cast<size_t>(count)};
        find_heights(below, some, heights.data());
        float least = 1e6f;
        for (int k = 0; k < count; ++k)
            least = std::min(least, clear_of(below, segments, first + k, some[static_cast<size_t>(k)],
                                             heights[static_cast<size_t>(k)]));
        return least;
    }
};

// Toes that are in the ground go up, and the ankle bends as far as it may.
void bend_foot(const Setting& s, BodyPose& pose, Side side) {
    constexpr float k_most = 0.6f, k_lazy = 0.2f, k_works = 0.6f;  // radians; as in lift_leg()
    const int foot = side == k_left ? left_foot : right_foot;
    const int tip = k_shank_of[side] + 2;
    const Balls at = s.balls(pose);
    const float deep = -s.least(at, tip, 1);
    if (deep <= 0) return;
    const Vec3 axis = rotate(pose.rotation[foot], {1, 0, 0});
    const Vec3 off = at[static_cast<size_t>(tip)] - places_of(pose, s.person, s.lane)[foot];
    const float lever = length(off), rises = cross(axis, off).y / lever;
    const float part = smoothstep(k_lazy, k_works, std::fabs(rises));
    turn_foot(
        pose, side,
        std::copysign(part * std::min(deep / (lever * std::max(std::fabs(rises), k_works)), k_most), rises));
}

// No nearer to the hip than a leg folds: past it the leg would go round all at once.
void set_ankle(const Setting& s, BodyPose& pose, Side side, Vec3 ankle) {
    constexpr float k_nearest = 0.23f;  // of the leg
    const auto thigh = static_cast<size_t>(side == k_left ? left_upper_leg : right_upper_leg);
    const auto at = places_of(pose, s.person, s.lane);
    const float nearest =
        k_nearest * (length(at[thigh + 1] - at[thigh]) + length(at[thigh + 2] - at[thigh + 1]));
    const Vec3 off = ankle - at[thigh];
    if (length(off) < nearest) ankle = at[thigh] + normalize_or(off, {0, -1, 0}) * nearest;
    reach_with_leg(pose, s.person, s.lane, side, ankle);
}

void lift_leg(const Setting& s, BodyPose& pose, Side side, bool keeps_foot) {
    constexpr float k_hangs_from = 0.3f, k_hangs_to = 0.8f;  // shanks, of the foot below the knee
    constexpr float k_most_bent = 2.6f;                      // radians of a knee
    constexpr float k_lazy = 0.3f, k_works = 0.7f;           // sines: what hardly rises is not turned far
    const int foot = side == k_left ? left_foot : right_foot;
    const int first = k_shank_of[side];
    float deep = -s.least(s.balls(pose), first, k_legs);
    if (deep <= 0) return;
    bend_foot(s, pose, side);
    deep = -s.least(s.balls(pose), first, k_legs);
    if (deep <= 0) return;
    const auto places = places_of(pose, s.person, s.lane);
    const float shank = length(places[foot] - places[foot - 1]);
    const float hangs =
        keeps_foot ? 1 : smoothstep(k_hangs_from, k_hangs_to, (places[foot - 1].y - places[foot].y) / shank);
    if (hangs > 0) set_ankle(s, pose, side, places[foot] + Vec3{0, hangs * deep, 0});
    for (int pass = 0; pass < 3; ++pass) {
        const Balls at = s.balls(pose);
        deep = -s.least(at, first, k_legs);
        if (deep <= 1e-3f) return;
        const Vec3 thigh = rotate(pose.rotation[foot - 2], {0, -1, 0});
        const Vec3 down = rotate(pose.rotation[foot - 1], {0, -1, 0});
        const float bent = arccos(clamp(dot(thigh, down), -1, 1));
        const Vec3 knee = places_of(pose, s.person, s.lane)[foot - 1];
        // Shank and foot turn about the knee; what is straight below it does not rise much by that.
        const Vec3 axis = rotate(pose.rotation[foot - 1], {1, 0, 0});
        const Vec3 rises = cross(axis, at[static_cast<size_t>(first + 1)] - knee);
        const float lever = std::max(length(rises), 0.1f);
        const float angle = deep / lever * smoothstep(k_lazy, k_works, rises.y / lever);
        fold_knee(pose, side, std::min(angle, std::max(k_most_bent - bent, 0.0f)));
    }
}

// From where it was a tick ago, no farther than it swings.
void swing_leg(const Setting& s, BodyPose& pose, const BodyPose& before, Side side) {
    constexpr float k_ankle_goes = 0.06f, k_foot_turns = 0.22f;  // metres, radians a tick
    const int foot = side == k_left ? left_foot : right_foot;
    const Vec3 was = places_of(before, s.person, s.lane)[foot];
    const Vec3 goes = places_of(pose, s.person, s.lane)[foot] - was;
    const float far = length(goes);
    if (far > k_ankle_goes) set_ankle(s, pose, side, was + goes * (k_ankle_goes / far));
    const Quat turn = pose.rotation[foot] * conjugate(before.rotation[foot]);
    const float cosine = std::min(std::fabs(turn.w), 1.0f), angle = 2 * arccos(cosine);
    if (angle <= k_foot_turns) return;
    const Quat held = nlerp(before.rotation[foot], pose.rotation[foot], k_foot_turns / angle);
    const Quat by = held * conjugate(pose.rotation[foot]);
    for (int j = foot; j <= foot + 1; ++j) pose.rotation[j] = normalize(by * pose.rotation[j]);
}

// The foot that is set down goes to the ground below it.
void plant(const Setting& s, BodyPose& pose, Side side, float part) {
    constexpr float k_farthest = 0.4f;
    if (part <= 0) return;
    const int foot = side == k_left ? left_foot : right_foot;
    const float clear = s.least(s.balls(pose), k_shank_of[side] + 1, 2);
    if (clear <= 0) return;
    const Vec3 ankle = places_of(pose, s.person, s.lane)[foot];
    set_ankle(s, pose, side, ankle - Vec3{0, part * std::min(clear, k_farthest), 0});
}

// Along its way on the ground, as far as arms are long; else out of it alone.
void set_hand(const Setting& s, BodyPose& pose, Side side, const Rests& rests) {
    if (rests.hands <= 0) return;
    const float radius = s.segments.radius[static_cast<size_t>(k_palm_of[side])];
    const auto k = static_cast<size_t>(side);
    const ArmWay &from = rests.arms_from[k], &to = rests.arms_to[k];
    const float t = rests.hands_on;
    const Vec3 places[] = {from.palm,
                           at_height(lerp(on_ground(from.palm), on_ground(to.palm), t), from.palm.y)};
    float heights[2];
    find_heights(s.below, places, heights);
    const float above = std::max(from.palm.y - heights[0] - radius, 0.0f) * (1 - smoothstep(0, 0.6f, t)) +
                        rests.hands_above[k] * smoothstep(0.4f, 1, t);
    const Vec3 at =
        at_height(on_ground(places[1]), heights[1] + radius + above + 4 * t * (1 - t) * rests.hands_lift);
    BodyPose rested = pose;
    set_arm(rested, s.person, s.lane, side, from, to, t, at);
    blend_arm(pose, rested, side, rests.hands);
}

// From where it was towards where it is to be, out of the ground: the palm is lifted, and the elbow goes
// round the line from shoulder to palm, over the top of its circle where that dips into the ground.
void swing_arm(const Setting& s, BodyPose& pose, const BodyPose& before, Side side) {
    constexpr float k_hand_goes = 0.05f, k_elbow_turns = 0.14f, k_elbow_flees = 0.09f,
                    k_hand_flees = 0.08f;              // metres and radians a tick
    constexpr float k_near = 0.55f, k_slowest = 0.3f;  // of the arm; of that
    constexpr float k_foreseen = 0.04f, k_most_bent = 0.3f, k_straightest = 0.995f, k_upright = 0.05f;
    const ArmPlaces now = arm_places(pose, s.person, s.lane, side),
                    was = arm_places(before, s.person, s.lane, side);
    const auto palm_ball = static_cast<size_t>(k_palm_of[side]),
               elbow_ball = static_cast<size_t>(k_elbow_of[side]);
    const float slope = s.below.is_plane ? std::max(s.below.normal.y, 0.5f) : 1;
    auto needs = [&](Vec3 at, size_t ball) {
        float height;
        find_heights(s.below, std::span<const Vec3>{&at, 1}, &height);
        return height + s.segments.radius[ball] / slope;
    };
    const float a = length(now.elbow - now.shoulder), b = length(now.palm - now.elbow);
    // Near the shoulder a palm that goes far would fling the elbow about.
    const float slowly = clamp(length(was.palm - was.shoulder) / (k_near * (a + b)), k_slowest, 1);
    Vec3 goes = now.palm - was.palm;
    if (const float far = length(goes); far > slowly * k_hand_goes)
        goes = goes * (slowly * k_hand_goes / far);
    Vec3 palm = was.palm + goes;
    palm.y = std::max(palm.y, std::min(needs(palm, palm_ball), was.palm.y + slowly * k_hand_flees));
    // What is too near the shoulder gives way along the ground.
    const Vec3 off = palm - now.shoulder;
    const float nearest = k_most_bent * (a + b), flat = nearest * nearest - off.y * off.y;
    if (flat > length_squared(on_ground(off)))
        palm = now.shoulder +
               at_height(normalize_or(on_ground(off), on_ground(was.palm - was.shoulder)) * std::sqrt(flat),
                         off.y);
    const Vec3 along = normalize_or(palm - now.shoulder, {0, -1, 0});
    const float reach = std::min(length(palm - now.shoulder), k_straightest * (a + b));
    palm = now.shoulder + along * reach;
    const float on = (a * a - b * b + reach * reach) / (2 * reach);
    const float wide = std::sqrt(std::max(a * a - on * on, 0.0f));
    const Vec3 middle = now.shoulder + along * on;
    const Vec3 rises = Vec3{0, 1, 0} - along * along.y;
    const float lever = length(rises);
    const bool is_upright = lever < k_upright;
    const Vec3 top = is_upright ? Vec3{0, 0, 1} - along * along.z : rises;
    const Vec3 up = top / length(top), aside = cross(along, up);
    // Of elbows, from the top of the circle on.
    auto angle_of = [&](Vec3 from) { return arctan2(dot(from, aside), dot(from, up)); };
    auto elbow_at = [&](float angle) {
        const SinCos at = sin_cos(angle);
        return middle + (up * at.cosine + aside * at.sine) * wide;
    };
    auto widest_at = [&](float angle, float spare) {
        if (is_upright) return k_pi;
        const float cosine = (needs(elbow_at(angle), elbow_ball) + spare - middle.y) / (wide * lever);
        return cosine <= -1 ? k_pi : cosine >= 1 ? 0.0f : arccos(cosine);
    };
    const float wanted = angle_of(now.elbow - now.shoulder), had = angle_of(was.elbow - was.shoulder);
    const float room = std::min(widest_at(wanted, k_foreseen), widest_at(had, k_foreseen));
    const float turns = room < k_pi ? clamp(wanted, -room, room) - had : wrap_angle(wanted - had);
    float angle = had + clamp(turns, -k_elbow_turns, k_elbow_turns);
    for (int pass = 0; pass < 2; ++pass) {
        const float most = widest_at(angle, 0), turn = wrap_angle(angle);
        if (most < k_pi) angle = turn + clamp(clamp(turn, -most, most) - turn, -k_elbow_flees, k_elbow_flees);
    }
    place_arm(pose, s.person, s.lane, side, palm, elbow_at(angle));
    // Wrists are not quite on the way from elbow to palm.
    const float deep = -s.least(s.balls(pose), k_palm_of[side] - 1, 2);
    if (deep > 0)
        place_arm(pose, s.person, s.lane, side, palm + Vec3{0, std::min(deep, k_hand_goes), 0},
                  elbow_at(angle));
}

float least_that_bears(const Setting& s, const Balls& at) {
    Heights heights;
    find_heights(s.below, at, heights.data());
    float least = 1e3f;
    for (int k = 0; k < k_ball_count; ++k) {
        const auto ball = static_cast<size_t>(k);
        if (bears(k)) least = std::min(least, clear_of(s.below, s.segments, k, at[ball], heights[ball]));
    }
    return least;
}

}  // namespace

float air_below(const BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                const Surroundings& around, float floor) {
    const Balls at = balls_of(pose, segments, person, lane);
    GroundBelow below = ground_below(around, floor, at);
    below.unseen = k_unseen;
    return std::max(least_that_bears({segments, person, lane, below}, at), 0.0f);
}

bool settle(BodyPose& pose, const BodyPose& before, const Segments& segments, const PersonBlock& person,
            int lane, const Surroundings& around, float floor, const Rests& rests, float& raised, float dt) {
    const Balls first = balls_of(pose, segments, person, lane);
    GroundBelow below = ground_below(around, floor, first);
    below.unseen = k_unseen * (1 - rests.sees_steps);
    const Setting s{segments, person, lane, below};
    const float least = least_that_bears(s, first);
    pose.hips.y -= rests.may_sink ? least : std::min(least, 0.0f);
    plant(s, pose, k_left, rests.left_foot);
    for (const Side side : {k_left, k_right}) {
        lift_leg(s, pose, side, rests.keeps_feet);
        swing_leg(s, pose, before, side);
    }
    const float most = raised + k_rises * dt;
    auto rise_out_of = [&](std::initializer_list<BallRange> parts) {
        const Balls at = s.balls(pose);
        float deep = 0;
        for (const BallRange& part : parts) deep = std::max(deep, -s.least(at, part.first, part.count));
        const float rises = clamp(most - raised, 0, deep);
        raised += rises;
        pose.hips.y += rises;
    };
    raised = std::max(raised - k_sinks * dt, 0.0f);
    pose.hips.y += raised;
    rise_out_of({k_trunk, k_left_leg, k_right_leg});
    for (const Side side : {k_left, k_right}) {
        set_hand(s, pose, side, rests);
        swing_arm(s, pose, before, side);
    }
    rise_out_of({k_left_arm, k_right_arm});
    if (raised > 1e-3f) plant(s, pose, k_left, rests.left_foot);
    return !below.has_steps;
}

std::array<float, 2> palms_above(const BodyPose& pose, const Segments& segments, const PersonBlock& person,
                                 int lane) {
    const Balls at = balls_of(pose, segments, person, lane);
    auto low = [&](int k) { return at[static_cast<size_t>(k)].y - segments.radius[static_cast<size_t>(k)]; };
    float lowest = 1e6f;
    for (int k = 0; k < k_ball_count; ++k)
        if (bears(k)) lowest = std::min(lowest, low(k));
    return {std::max(low(k_palm_of[k_left]) - lowest, 0.0f),
            std::max(low(k_palm_of[k_right]) - lowest, 0.0f)};
}

Vec3 keep_off_walls(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                    const Surroundings& around) {
    constexpr float k_near = 1.4f, k_most = 0.03f;  // metres
    const Vec3 was = pose.hips;
    if (!closest_wall(around, pose.hips, k_near)) return {};
    for (int pass = 0; pass < 2; ++pass) {  // a corner has two
        const auto balls = balls_of(pose, segments, person, lane);
        float deepest = 0;
        Vec3 out{};
        for (size_t k = 0; k < k_ball_count; ++k) {
            const auto wall = wall_beside(around, balls[k], k_near);
            if (!wall) continue;
            const float deep = segments.radius[k] - dot(balls[k] - wall->point, wall->normal);
            // What is behind a wall farther than that is on its other side, by itself.
            if (deep > deepest && deep < 0.6f) deepest = deep, out = wall->normal;
        }
        pose.hips += out * deepest;
    }
    const Vec3 aside = pose.hips - was;
    const float far = length(aside);
    if (far > k_most) pose.hips = was + aside * (k_most / far);
    return pose.hips - was;
}

Vec2 slope_at(const Surroundings& around, Vec3 place, float reach) {
    constexpr size_t k_places = 8;
    std::array<Vec3, k_places> at;
    std::array<std::optional<GroundHit>, k_places> hits;
    for (size_t i = 0; i < k_places; ++i)
        at[i] = place + at_height(heading_direction(2 * k_pi * static_cast<float>(i) / k_places) * reach, 0);
    ground_at(around, at, k_up, k_down, hits.data());
    Vec2 slope{};
    constexpr size_t k_pairs = k_places / 2;  // opposite ones together
    for (size_t i = 0; i < k_pairs; ++i) {
        const size_t other = i + k_pairs;
        if (!hits[i] || !hits[other]) continue;
        slope += on_ground(at[i] - place) * ((hits[i]->height - hits[other]->height) / (2 * reach * reach));
    }
    return slope * (2.0f / static_cast<float>(k_pairs));
}

}  // namespace flaneur
