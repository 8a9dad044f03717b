#include "sim/fall/settle.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_up = 0.9f, k_down = 2.5f;
// Where the ground is uneven a ball has as much under it as is near: so it does not meet a riser all at once.
constexpr int k_rings = 3, k_rays = 6;
constexpr float k_ring = 0.035f, k_steep = 1.6f;  // metres; of metres, by which what is farther counts less

using Balls = std::array<Vec3, k_ball_count>;
using Heights = std::array<float, k_ball_count>;

struct GroundBelow {
    const Surroundings& around;
    float floor;
    bool is_plane = false, has_steps = false;
    Vec3 at{}, normal{0, 1, 0};
};

// A plane, if all that limbs may come to is one; with steps, if some of it is well off that plane.
GroundBelow ground_below(const Surroundings& around, float floor, const Balls& balls) {
    constexpr float k_level = 0.004f, k_rough = 0.06f, k_limbs[] = {0.5f, 1};  // metres
    constexpr size_t k_ways = 8, k_places = k_ball_count + 2 * k_ways;
    GroundBelow below{around, floor, true};
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
            highest = std::max(highest, height - k_steep * length(offsets[i]));
        }
        heights[k] = highest;
    }
}

// How far a ball is above the ground; negative in it.
float clear_of(const GroundBelow& below, const Segments& segments, int ball, Vec3 at, float height) {
    const float slope = below.is_plane ? std::max(below.normal.y, 0.5f) : 1;
    return at.y - height - segments.radius[static_cast<size_t>(ball)] / slope;
}

constexpr int k_shank_of[] = {12, 20}, k_palm_of[] = {9, 17};  // balls
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

void lift_leg(const Setting& s, BodyPose& pose, Side side, bool keeps_foot) {
    constexpr float k_hangs_from = 0.3f, k_hangs_to = 0.8f;  // shanks, of the foot below the knee
    constexpr float k_most_bent = 2.6f;                      // radians of a knee
    constexpr float k_lazy = 0.3f, k_works = 0.7f;           // sines: what hardly rises is not turned far
    const int foot = side == k_left ? left_foot : right_foot;
    const int first = k_shank_of[side];
    float deep = -s.least(s.balls(pose), first, k_legs);
    if (deep <= 0) return;
    const auto places = places_of(pose, s.person, s.lane);
    const float shank = length(places[foot] - places[foot - 1]);
    const float hangs =
        keeps_foot ? 1 : smoothstep(k_hangs_from, k_hangs_to, (places[foot - 1].y - places[foot].y) / shank);
    if (hangs > 0) reach_with_leg(pose, s.person, s.lane, side, places[foot] + Vec3{0, hangs * deep, 0});
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

// The foot that is set down goes to the ground below it.
void plant(const Setting& s, BodyPose& pose, Side side, float part) {
    constexpr float k_farthest = 0.4f;
    if (part <= 0) return;
    const int foot = side == k_left ? left_foot : right_foot;
    const float clear = s.least(s.balls(pose), k_shank_of[side] + 1, 2);
    if (clear <= 0) return;
    const Vec3 ankle = places_of(pose, s.person, s.lane)[foot];
    reach_with_leg(pose, s.person, s.lane, side, ankle - Vec3{0, part * std::min(clear, k_farthest), 0});
}

// Along its way on the ground, as far as arms are long; else out of it alone.
void set_hand(const Setting& s, BodyPose& pose, Side side, const Rests& rests) {
    const int ball = k_palm_of[side];
    const float radius = s.segments.radius[static_cast<size_t>(ball)];
    if (rests.hands > 0) {
        const ArmWay& from = rests.arms_from[static_cast<size_t>(side)];
        const ArmWay& to = rests.arms_to[static_cast<size_t>(side)];
        const float t = rests.hands_on;
        const Vec3 places[] = {from.palm,
                               at_height(lerp(on_ground(from.palm), on_ground(to.palm), t), from.palm.y)};
        float heights[2];
        find_heights(s.below, places, heights);
        const float above = std::max(from.palm.y - heights[0] - radius, 0.0f) * (1 - smoothstep(0, 0.6f, t));
        const Vec3 at =
            at_height(on_ground(places[1]), heights[1] + radius + above + 4 * t * (1 - t) * rests.hands_lift);
        BodyPose rested = pose;
        set_arm(rested, s.person, s.lane, side, from, to, t, at);
        blend_arm(pose, rested, side, rests.hands);
    }
    const float hand = s.least(s.balls(pose), ball - 1, 2);
    if (hand < 0)
        reach_with_arm(pose, s.person, s.lane, side,
                       palm_of(pose, s.person, s.lane, side) - Vec3{0, hand, 0});
}

}  // namespace

bool settle(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
            const Surroundings& around, float floor, const Rests& rests, float& raised, float dt) {
    const Balls first = balls_of(pose, segments, person, lane);
    const GroundBelow below = ground_below(around, floor, first);
    const Setting s{segments, person, lane, below};
    Heights heights;
    find_heights(below, first, heights.data());
    float least = 1e3f;
    for (int k = 0; k < k_ball_count; ++k) {
        const size_t ball = static_cast<size_t>(k);
        if (bears(k)) least = std::min(least, clear_of(below, segments, k, first[ball], heights[ball]));
    }
    pose.hips.y -= rests.may_sink ? least : std::min(least, 0.0f);
    plant(s, pose, k_left, rests.left_foot);
    for (const Side side : {k_left, k_right}) lift_leg(s, pose, side, rests.keeps_feet);
    for (const Side side : {k_left, k_right}) set_hand(s, pose, side, rests);
    const float deep = std::max(-s.least(s.balls(pose), 0, k_ball_count), 0.0f);
    raised = std::max(deep, raised - k_sinks * dt);
    pose.hips.y += raised;
    if (raised > 1e-3f) plant(s, pose, k_left, rests.left_foot);
    return !below.has_steps;
}

void keep_off_walls(BodyPose& pose, const Segments& segments, const PersonBlock& person, int lane,
                    const Surroundings& around) {
    constexpr float k_near = 1.4f;
    if (!closest_wall(around, pose.hips, k_near)) return;
    for (int pass = 0; pass < 2; ++pass) {  // a corner has two
        const auto balls = balls_of(pose, segments, person, lane);
        float deepest = 0;
        Vec3 out{};
        for (size_t k = 0; k < k_ball_count; ++k) {
            const auto wall = closest_wall(around, balls[k], k_near);
            if (!wall) continue;
            const float deep = segments.radius[k] - dot(balls[k] - wall->point, wall->normal);
            // What is behind a wall farther than that is on its other side, by itself.
            if (deep > deepest && deep < 0.6f) deepest = deep, out = wall->normal;
        }
        pose.hips += out * deepest;
    }
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
