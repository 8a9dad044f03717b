#include "sim/fall/fall.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "sim/fall/lane.h"

namespace flaneur {

namespace {

// Degrees that each part is bent ahead, and the limbs also outward, elbows and knees as they bend.
struct Guard {
    float trunk, neck, neck_aside;
    float arm, arm_out, elbow;
    float thigh, thigh_out, knee;
};
constexpr Guard k_ahead = {6, -25, 0, 80, 18, 40, 22, 6, 45};
constexpr Guard k_back = {16, 38, 0, -38, 38, 25, 55, 10, 65};
constexpr Guard k_near = {6, 5, 22, 25, 68, 35, 35, 12, 45};  // of a fall to that side
constexpr Guard k_far = {6, 5, 22, 35, 30, 50, 35, 4, 55};
constexpr Guard k_slack = {4, 6, 0, 18, 26, 30, 10, 8, 16};

Quat bent(float ahead) { return rotation_x(-ahead * k_radians); }
Quat bent(float ahead, float outward, float side) {
    return rotation_z(side * outward * k_radians) * bent(ahead);
}

Guard mix_of(const Guard& a, const Guard& b, float t) {
    return {lerp(a.trunk, b.trunk, t), lerp(a.neck, b.neck, t),           lerp(a.neck_aside, b.neck_aside, t),
            lerp(a.arm, b.arm, t),     lerp(a.arm_out, b.arm_out, t),     lerp(a.elbow, b.elbow, t),
            lerp(a.thigh, b.thigh, t), lerp(a.thigh_out, b.thigh_out, t), lerp(a.knee, b.knee, t)};
}

// rad/s of muscles alone; see TumbleAims.
struct Haste {
    float trunk, neck, arm, leg;
};
constexpr Haste k_stiff = {16, 16, 8, 26}, k_guarded = {12, 14, 22, 9}, k_loose = {5, 6, 3, 3};
constexpr float k_stays = 0.05f, k_guards = 0.22f;  // seconds until one has felt it, and until arms go out
constexpr float k_slackens = 0.8f;                  // seconds
// Legs and trunk give way as the body leans so far, radians, half that of who falls back and sits down, or
// after so long, seconds.
constexpr float k_topples = 0.4f, k_toppled = 0.95f, k_stood = 1, k_stood_out = 1.5f;

// The step that would have saved it: the leg that is farther from where it goes swings there, degrees.
constexpr float k_step_ahead = 55, k_step_aside = 32, k_step_knee = 60, k_step_haste = 16;
constexpr float k_slack_pull = 0.35f;  // radians from where a limb lies that slack muscles draw it at most

// How far the body leans that stands on its feet, radians.
float lean_of(const TumbleBlock& block, int lane) {
    const Vec3 feet = (row_of(block.place[left_sole], lane) + row_of(block.place[right_sole], lane)) * 0.5f;
    const Vec3 up = row_of(block.place[thorax], lane) - feet;
    return arctan2(length(on_ground(up)), up.y);
}

constexpr int k_trunk_balls = 7;  // the first: pelvis, belly, thorax, skull

bool is_limb(int s, int left, int right, int parts) {
    return (s >= left && s < left + parts) || (s >= right && s < right + parts);
}
float pick(const Haste& h, int s) {
    return s == skull ? h.neck : s <= thorax ? h.trunk : is_limb(s, left_arm, right_arm, 3) ? h.arm : h.leg;
}

Quat guard_of(int s, const Guard& left, const Guard& right, float neck_aside) {
    const bool is_left = (s >= left_arm && s <= left_palm) || (s >= left_thigh && s <= left_sole);
    const Guard& g = is_left ? left : right;
    const float side = is_left ? 1.0f : -1.0f;
    switch (s) {
        case belly:
        case thorax:
            return rotation_x(0.5f * (left.trunk + right.trunk) * k_radians);
        case skull:
            return rotation_z(neck_aside * k_radians) *
                   rotation_x(0.5f * (left.neck + right.neck) * k_radians);
        case left_arm:
        case right_arm:
            return bent(g.arm, g.arm_out, side);
        case left_forearm:
        case right_forearm:
            return bent(g.elbow);
        case left_thigh:
        case right_thigh:
            return bent(g.thigh, g.thigh_out, side);
        case left_shank:
        case right_shank:
            return bent(-g.knee);
        default:
            return {};
    }
}

// Of the saving step: its leg, thigh and shank as they swing the `way` that the body sees, and 1 where it is
// the left one.
struct SavingStep {
    Quat thigh, shank;
    bool is_left;
};
SavingStep saving_step(const std::array<Quat, k_segment_count>& stood, Vec2 way) {
    constexpr float k_near_side = 0.5f;  // whether it is near counts as much as how far back it is
    auto reaches = [&](int thigh) {
        const Vec3 points = rotate(stood[thigh], {0, -1, 0});
        return points.x * way.x + points.z * way.z;
    };
    const bool is_left =
        reaches(left_thigh) - k_near_side * way.x < reaches(right_thigh) + k_near_side * way.x;
    const float aside = std::fabs(way.x), side = is_left ? 1.0f : -1.0f;
    return {bent(k_step_ahead * way.z * (way.z > 0 ? 1.0f : 0.5f), k_step_aside * aside, side),
            bent(-k_step_knee * (1 - 0.5f * aside)), is_left};
}

// Slack arms lift nothing: muscles draw them no farther than a little from where they are.
Quat drawn_from(const Quat& is, const Quat& turn) {
    const float cosine = std::fabs(is.x * turn.x + is.y * turn.y + is.z * turn.z + is.w * turn.w);
    const float angle = 2 * arctan2(std::sqrt(std::max(1 - cosine * cosine, 0.0f)), cosine);
    return angle > k_slack_pull ? nlerp(is, turn, k_slack_pull / angle) : turn;
}

}  // namespace

void topple(TumbleBlock& block, int lane, const Segments& segments, Vec2 to) {
    constexpr float k_foot = 0.1f, k_beyond = 0.14f;  // metres, of a foot ahead of its middle; beyond that
    auto place_of = [&](int s) { return row_of(block.place[s], lane); };
    Vec3 middle{}, goes{};
    for (int s = 0; s < k_segment_count; ++s) {
        const float share = segments.mass[s] / segments.whole;
        middle += place_of(s) * share;
        goes += row_of(block.velocity[s], lane) * share;
    }
    const Vec3 left = place_of(left_sole), right = place_of(right_sole);
    const float ground = std::min(left.y, right.y), high = std::max(middle.y - ground, 0.3f);
    const float edge = std::max(dot(on_ground(left), to), dot(on_ground(right), to)) + k_foot;
    const float rate = std::sqrt(k_gravity / high);
    const float enough = (edge + k_beyond - dot(on_ground(middle), to)) * rate;
    const float speed = std::max(dot(on_ground(goes), to), enough);
    for (int s = 0; s < k_segment_count; ++s) {
        const Vec2 own = on_ground(row_of(block.velocity[s], lane));
        const Vec2 gains = to * (speed * std::max(place_of(s).y - ground, 0.0f) / high - dot(own, to));
        block.velocity[s][0][lane] += gains.x;
        block.velocity[s][2][lane] += gains.z;
    }
}

std::array<Quat, k_segment_count> turns_of(const TumbleBlock& block, int lane) {
    std::array<Quat, k_segment_count> turns{};
    for (int s = 1; s < k_segment_count; ++s)
        turns[s] =
            conjugate(turn_of(block.rotation[k_segments[s].parent], lane)) * turn_of(block.rotation[s], lane);
    return turns;
}

void aim_fall(TumbleAims& aims, int lane, const TumbleBlock& block,
              const std::array<Quat, k_segment_count>& stood, Vec2 to, float seconds, float lain) {
    // The direction as the body sees it.
    const Vec3 own = rotate(conjugate(turn_of(block.rotation[thorax], lane)), at_height(to, 0));
    const Vec2 way = normalize_or(Vec2{own.x, own.z}, {0, 1});
    const float ahead = std::max(way.z, 0.0f) * way.z, back = std::max(-way.z, 0.0f) * -way.z;
    auto guard = [&](bool is_near) {
        const Guard g = mix_of(is_near ? k_near : k_far, ahead > back ? k_ahead : k_back, ahead + back);
        return mix_of(g, k_slack, smoothstep(0, k_slackens, lain));
    };
    const Guard left = guard(way.x > 0), right = guard(way.x < 0);
    const float neck_aside = (way.x > 0 ? 1.0f : -1.0f) * left.neck_aside;
    const float feels = smoothstep(k_stays, k_guards, seconds), slack = smoothstep(0, k_slackens, lain);
    const float gives = std::max({feels * smoothstep(k_topples, k_toppled, (1 + back) * lean_of(block, lane)),
                                  smoothstep(k_stood, k_stood_out, seconds), slack});
    const SavingStep step = saving_step(stood, way);
    const std::array<Quat, k_segment_count> are = turns_of(block, lane);
    for (int s = 1; s < k_segment_count; ++s) {
        const bool is_arm = is_limb(s, left_arm, right_arm, 3);
        const float guards = is_arm ? feels : gives;
        Quat turn = nlerp(stood[s], guard_of(s, left, right, neck_aside), guards);
        float haste = lerp(pick(k_stiff, s), pick(k_guarded, s), guards);
        const int thigh = step.is_left ? left_thigh : right_thigh;
        if (s == thigh || s == thigh + 1) {
            turn = nlerp(turn, s == thigh ? step.thigh : step.shank, feels * (1 - gives));
            haste = lerp(haste, k_step_haste, feels * (1 - gives));
        }
        set_row(aims.turn[s], lane, is_arm ? nlerp(turn, drawn_from(are[s], turn), slack) : turn);
        aims.haste[s][lane] = lerp(haste, pick(k_loose, s), slack);
        aims.drag[s][lane] = lerp(8, is_arm ? 6 : 15, slack);
    }
}

void find_planes(TumblePlanes& planes, int lane, const TumbleBlock& block, const TumbleShapes& shapes,
                 Vec3 origin, const Surroundings& around, float floor) {
    constexpr float k_up = 0.6f, k_down = 3, k_level = 0.02f, k_foreseen = 0.08f, k_near_wall = 1.4f;
    constexpr size_t k_ways_about = 8, k_places = k_ball_count + k_ways_about + k_ball_count;
    constexpr float k_about = 0.6f, k_beyond = 0.12f;  // metres
    std::array<Vec3, k_places> at;
    std::array<Vec3, k_ball_count> moving;
    for (int k = 0; k < k_ball_count; ++k) {
        const BallMotion ball = ball_motion(block, shapes, k, lane, origin);
        at[k] = ball.place;
        moving[k] = ball.velocity;
    }
    // Beside what is below them, what limbs may come to.
    for (size_t i = 0; i < k_ways_about; ++i)
        at[k_ball_count + i] =
            at[0] +
            at_height(heading_direction(2 * k_pi * static_cast<float>(i) / k_ways_about) * k_about, 0);
    for (size_t k = 0; k < k_ball_count; ++k) {
        const Vec2 out = normalize_or(on_ground(at[k] - at[0]), {0, 1});
        const Vec3 goes = at_height(on_ground(moving[k]) * k_tick, 0);
        at[k_ball_count + k_ways_about + k] =
            at[k] + goes + at_height(out * (shapes.radius[k][lane] + k_beyond), 0);
    }
    std::array<std::optional<GroundHit>, k_places> hits;
    ground_at(around, at, k_up, k_down, hits.data());
    auto set_ground = [&](int k, Vec3 place, Vec3 normal) {
        set_row(planes.normal[k], lane, normal);
        planes.offset[k][lane] = dot(normal, place - origin);
    };
    // Over one plane each meets what is below it.
    const std::optional<GroundHit> first = hits[0];
    bool is_plane = first.has_value();
    for (size_t k = 1; k < k_places && is_plane; ++k) {
        if (!hits[k] && k >= k_ball_count) continue;  // a wall's other side
        is_plane = hits[k].has_value();
        if (!is_plane) break;
        const Vec3 step = at_height(on_ground(at[k] - at[0]), hits[k]->height - first->height);
        is_plane = std::fabs(dot(step, first->normal)) < k_level &&
                   length_squared(hits[k]->normal - first->normal) < k_level;
    }
    for (int k = 0; k < k_ball_count; ++k) {
        set_row(planes.wall[k], lane, {0, 1, 0});
        planes.wall_offset[k][lane] = k_meets_nothing;
    }
    // On steps, kerbs and rubble a ball meets what is highest under it, and as a wall what is higher than its
    // middle close by.
    auto set_uneven = [&](int k) {
        const float r = shapes.radius[k][lane];
        const float far = r + 0.1f + k_foreseen * length(on_ground(moving[k]));
        const Vec3 normal = hits[k] ? hits[k]->normal : Vec3{0, 1, 0};
        const float height = hits[k] ? hits[k]->height : floor;
        set_ground(k, at_height(on_ground(at[k]), height), normal);
        auto height_at = [&](Vec2 by) {
            const auto hit = ground_at(around, at[k] + at_height(by, 0), k_up, k_down);
            return hit ? hit->height : height;
        };
        constexpr Vec2 k_ways[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
        Vec2 up_hill{};
        float highest = height, under = height;
        for (const Vec2 way : k_ways) {
            const float there = height_at(way * far);
            up_hill += way * (there - height);
            highest = std::max(highest, there);
            under = std::max(under, height_at(way * (0.7f * r)));
        }
        // Where it is by the end of the tick counts as well.
        const Vec3 goes = moving[k] * k_tick;
        const float low = at[k].y + std::min(goes.y, 0.0f);
        under = std::max(under, height_at(on_ground(goes)));
        if (under > height + k_level && under < at[k].y)
            set_ground(k, at_height(on_ground(at[k]), under), {0, 1, 0});
        const float climbs = length(up_hill);
        // What it is in already it comes out of upward.
        if (highest < low || climbs < k_level || height >= at[k].y) return;
        // How far its edge is.
        const Vec2 way = up_hill / climbs;
        float free = 0, full = far;
        for (int i = 0; i < 7; ++i) {
            const float middle = 0.5f * (free + full);
            (height_at(way * middle) < low ? free : full) = middle;
        }
        planes.has_walls = 1;
        set_row(planes.wall[k], lane, at_height(-way, 0));
        planes.wall_offset[k][lane] = dot(at_height(-way, 0), at[k] - origin) - free;
    };
    for (int k = 0; k < k_ball_count; ++k) {
        if (is_plane) {
            set_ground(k, at_height(on_ground(at[k]), hits[k]->height), hits[k]->normal);
            continue;
        }
        set_uneven(k);
    }
    if (!closest_wall(around, at[0], k_near_wall)) return;
    for (int k = 0; k < k_ball_count; ++k) {
        const float reach = shapes.radius[k][lane] + 0.1f + k_foreseen * length(moving[k]);
        const auto wall = wall_beside(around, at[k], reach);
        if (!wall) continue;
        planes.has_walls = 1;
        set_row(planes.wall[k], lane, wall->normal);
        planes.wall_offset[k][lane] = dot(wall->normal, wall->point - origin);
    }
}

void hold_back(TumblePlanes& planes, int lane, const TumbleBlock& block, const TumbleShapes& shapes,
               Vec3 origin, Vec2 place, Vec2 out) {
    constexpr float k_trunk = 0.3f, k_limbs = 0.7f;  // metres beyond the place
    const Vec3 normal = at_height(-out, 0);
    planes.has_walls = 1;
    for (int k = 0; k < k_ball_count; ++k) {
        const Vec2 edge = place + out * (k < k_trunk_balls ? k_trunk : k_limbs);
        const float offset = dot(normal, at_height(edge, origin.y) - origin);
        const Vec3 ball = ball_motion(block, shapes, k, lane).place;
        const float has = dot(row_of(planes.wall[k], lane), ball) - planes.wall_offset[k][lane];
        if (has < dot(normal, ball) - offset) continue;
        set_row(planes.wall[k], lane, normal);
        planes.wall_offset[k][lane] = offset;
    }
}

float liveliness(const TumbleBlock& block, const TumbleShapes& shapes, int lane) {
    float most = 0;
    for (int k = 0; k < k_ball_count; ++k)
        most = std::max(most, length_squared(ball_motion(block, shapes, k, lane).velocity));
    return std::sqrt(most);
}

bool is_down(const TumbleBlock& block, const TumbleShapes& shapes, const TumblePlanes& planes, int lane) {
    constexpr float k_touch = 0.03f;
    for (int k = 0; k < k_trunk_balls; ++k) {
        const Vec3 middle = ball_motion(block, shapes, k, lane).place;
        const float clear = dot(row_of(planes.normal[k], lane), middle) - planes.offset[k][lane];
        if (clear < shapes.radius[k][lane] + k_touch) return true;
    }
    return false;
}

}  // namespace flaneur
