#include "sim/creature/creature.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/base/math.h"

namespace flaneur {

namespace {

// Of the size.
constexpr float k_high = 0.42f;                  // of the trunk over the surface
constexpr float k_beside = 0.72f;                // feet at rest, from the middle,
constexpr float k_before[] = {0.56f, 0, -0.6f};  // and ahead of it
constexpr float k_hip_beside = 0.13f, k_hip_before[] = {0.2f, 0.02f, -0.17f};
constexpr float k_bones[] = {0.17f, 0.52f, 0.64f};    // coxa, femur, tibia
constexpr float k_reach = 0.24f;                      // how far a foot is left before it steps,
constexpr float k_beyond = 0.8f;                      // and of that, how far ahead it is put
constexpr float k_lift = 0.2f;                        // of a step
constexpr float k_shortest = 0.1f, k_longest = 0.3f;  // seconds, of a step
constexpr float k_settle = 8;                         // a second, of its height
constexpr float k_leg = 1.25f;                        // of its 1.33 m of bones, how far it is stretched
constexpr float k_most_rise = 0.25f;                  // of the trunk with its feet
constexpr float k_creeps = 0.05f;                     // metres a second
constexpr float k_leap_crouch = 0.8f;                 // of people's crouch before and after a leap
constexpr float k_leap_settle = 20;                   // a second, of its height meanwhile
constexpr float k_draws = 5;                          // a second, of its feet in flight
constexpr float k_drawn[] = {0.7f, -0.6f};            // of where they rest: beside and before; size, below
constexpr float k_reaches = 0.45f;                    // seconds before it lands
constexpr int k_leg_joints = 4;                       // hip, coxa's end, knee, foot

// Of the trunk, after its middle: head, neck of the abdomen, abdomen, two antennae of two.
struct Part {
    int parent;
    Vec3 at;  // from its parent
    float girth;
};
constexpr Part k_trunk[] = {{0, {0, 0.05f, 0.34f}, 0.085f},      {0, {0, 0.02f, -0.24f}, 0.07f},
                            {2, {0, 0.02f, -0.4f}, 0.15f},       {1, {0.07f, 0.14f, 0.12f}, 0.014f},
                            {1, {-0.07f, 0.14f, 0.12f}, 0.014f}, {4, {0.06f, 0.03f, 0.2f}, 0.009f},
                            {5, {-0.06f, 0.03f, 0.2f}, 0.009f}};
constexpr float k_girths[] = {0.045f, 0.035f, 0.022f};

float side_of(int leg) { return leg < 3 ? 1.0f : -1.0f; }
bool is_even(int leg) { return leg % 2 == 0; }  // left front and hind, right middle

std::optional<SurfaceHit> cast_ray(const Rays& rays, Vec3 origin, Vec3 direction, float reach) {
    return rays.cast(rays.asked, origin, direction, reach);
}

struct Axes {
    Vec3 left, up, ahead;
    Vec3 operator()(Vec3 v) const { return left * v.x + up * v.y + ahead * v.z; }
};
Axes axes_of(const Creature& c) { return {cross(c.up, c.ahead), c.up, c.ahead}; }

Vec3 square_to(Vec3 v, Vec3 up, Vec3 otherwise) { return normalize_or(v - up * dot(v, up), otherwise); }

Vec3 hip_of(const Creature& c, int leg) {
    return c.middle + axes_of(c)(Vec3{side_of(leg) * k_hip_beside, 0, k_hip_before[leg % 3]} * c.size);
}

// Below its place beside the trunk, on ground that goes on as it is under the middle.
Vec3 home_of(const Creature& c, int leg) {
    return c.middle + axes_of(c)(Vec3{side_of(leg) * k_beside, -k_high, k_before[leg % 3]} * c.size);
}

// The surface that a foot finds about `spot`: a wall between the trunk and the air over it, the ground under
// it, or, where that falls away, what lies back under the trunk.
std::optional<SurfaceHit> foothold(const Rays& rays, const Creature& c, Vec3 spot) {
    const Vec3 over = spot + c.up * (0.9f * k_high * c.size), out = over - c.middle;
    const float far = length(out);
    const Vec3 way = normalize_or(out, c.ahead);
    if (auto wall = cast_ray(rays, c.middle, way, far)) return wall;
    if (auto ground = cast_ray(rays, over, -c.up, 2 * k_high * c.size)) return ground;
    const Vec3 below = spot - c.up * (k_high * c.size);
    const Vec3 back = normalize_or(c.middle - c.up * (2 * k_high * c.size) - below, -c.up);
    return cast_ray(rays, below, back, far);
}

struct Pace {
    Vec3 velocity;    // metres a second
    float turn_rate;  // radians a second about its up
    float seconds;    // that a step takes
};

// As quick as it takes for the standing feet not to be left much farther meanwhile.
Pace pace_of(const SurfaceWalkers& w, const Creature& c, float dt) {
    const float speed = w.moved[c.walker] / dt;
    const float feet = speed + std::fabs(w.turn_rate[c.walker]) * k_beside * c.size;
    return {c.ahead * speed, w.turn_rate[c.walker],
            clamp(0.5f * k_reach * c.size / std::max(feet, 0.01f), k_shortest, k_longest)};
}

void begin_step(const Rays& rays, const Creature& c, int number, const Pace& pace, CreatureLeg& leg) {
    const Vec3 home = home_of(c, number);
    const Vec3 goes = pace.velocity + cross(c.up, home - c.middle) * pace.turn_rate;
    const Vec3 lead = normalize_or(goes, {}) * (k_beyond * k_reach * c.size) + goes * pace.seconds;
    const bool is_going = length(goes) > k_creeps;
    auto found = foothold(rays, c, is_going ? home + lead : home);
    auto is_far = [&] { return !found || length(found->point - hip_of(c, number)) > k_leg * c.size; };
    if (is_far()) found = foothold(rays, c, home);
    // Over a sharp edge: to what its walker stands on.
    if (is_far()) found = cast_ray(rays, c.middle, -c.up, 4 * k_high * c.size);
    if (!found) return;
    leg = {leg.foot, leg.foot, found->point, found->normal, 0};
}

void swing(const Creature& c, CreatureLeg& leg, const Pace& pace, float dt) {
    leg.swing = std::min(leg.swing + dt / pace.seconds, 1.0f);
    const float t = smoothstep(0, 1, leg.swing);
    const Vec3 over = normalize_or(leg.normal + c.up, c.up);
    leg.foot = lerp(leg.from, leg.to, t) + over * (4 * t * (1 - t) * k_lift * c.size);
}

// Whether a foot has been left behind, and whether as far as its leg goes.
enum class Left : uint8_t { near, behind, far };
Left left_of(const Creature& c, int number) {
    const Vec3 foot = c.legs[number].foot, off = foot - home_of(c, number);
    if (length(foot - hip_of(c, number)) > k_leg * c.size) return Left::far;
    return length(off - c.up * dot(off, c.up)) > k_reach * c.size ? Left::behind : Left::near;
}

void step_legs(const Rays& rays, Creature& c, const Pace& pace, float dt) {
    bool is_up[2] = {}, is_due[2] = {};  // of each three
    for (int i = 0; i < k_creature_legs; ++i) {
        CreatureLeg& leg = c.legs[i];
        if (leg.swing < 1) swing(c, leg, pace, dt);
        is_up[is_even(i)] |= leg.swing < 1;
        is_due[is_even(i)] |= leg.swing == 1 && left_of(c, i) != Left::near;
    }
    // Where both are due, those go that did not go last: whose feet are left the farthest.
    if (is_due[0] && is_due[1]) {
        float most[2] = {};
        for (int i = 0; i < k_creature_legs; ++i)
            most[is_even(i)] = std::max(most[is_even(i)], length(c.legs[i].foot - home_of(c, i)));
        is_due[most[0] > most[1]] = false;
    }
    for (int i = 0; i < k_creature_legs; ++i) {
        CreatureLeg& leg = c.legs[i];
        const int three = is_even(i);
        if (leg.swing == 1 && ((is_due[three] && !is_up[1 - three]) || left_of(c, i) == Left::far))
            begin_step(rays, c, i, pace, leg);
    }
}

// Legs stretch as it leaves, are drawn in below it, and stretched again before it lands.
void fly_creature(const SurfaceWalkers& w, const Leap& leap, Creature& c, float dt) {
    const Vec3 before = c.middle;
    const Axes was = axes_of(c);
    c.up = w.up[c.walker];
    c.ahead = square_to(w.ahead[c.walker], c.up, c.ahead);
    c.middle = w.position[c.walker] + c.up * (k_high * c.size);
    const Axes is = axes_of(c);
    const float reaches = smoothstep(leap.lasts - k_reaches, leap.lasts, leap.seconds);
    for (int i = 0; i < k_creature_legs; ++i) {
        CreatureLeg& leg = c.legs[i];
        const Vec3 home = home_of(c, i) - c.middle;
        const float high = dot(home, c.up);
        const Vec3 drawn = (home - c.up * high) * k_drawn[0] + c.up * (k_drawn[1] * c.size);
        // The foot goes along with the trunk.
        const Vec3 off = leg.foot - before;
        const Vec3 along = is({dot(off, was.left), dot(off, was.up), dot(off, was.ahead)});
        leg.foot = c.middle + lerp(along, lerp(drawn, home, reaches), std::min(k_draws * dt, 1.0f));
        leg.from = leg.to = leg.foot;
        leg.normal = c.up;
        leg.swing = 0.5f;
    }
}

void land_creature(const Rays& rays, const SurfaceWalkers& w, Creature& c) {
    c.middle = w.position[c.walker] + c.up * (k_high * c.size);
    for (int i = 0; i < k_creature_legs; ++i) {
        CreatureLeg& leg = c.legs[i];
        auto found = foothold(rays, c, home_of(c, i));
        if (!found) found = cast_ray(rays, c.middle, -c.up, 4 * k_high * c.size);
        if (found) leg = {leg.foot, leg.foot, found->point, found->normal, 0};
    }
}

}  // namespace

float creature_radius(float size) { return 0.8f * size; }
float creature_height(float size) { return k_high * size; }
bool is_standing(const Creature& c) {
    return std::ranges::all_of(c.legs, [](const CreatureLeg& leg) { return leg.swing == 1; });
}

Creature make_creature(const Rays& rays, const SurfaceWalkers& w, uint32_t walker, float size) {
    Creature c;
    c.size = size;
    c.walker = walker;
    c.up = w.up[walker];
    c.ahead = w.ahead[walker];
    c.middle = w.position[walker] + c.up * (k_high * size);
    for (int i = 0; i < k_creature_legs; ++i) {
        CreatureLeg& leg = c.legs[i];
        leg.foot = leg.from = leg.to = home_of(c, i);
        leg.normal = c.up;
        if (const auto found = foothold(rays, c, leg.foot)) {
            leg.foot = leg.from = leg.to = found->point;
            leg.normal = found->normal;
        }
    }
    return c;
}

void step_creature(const Rays& rays, const SurfaceWalkers& w, Creature& c, float dt) {
    const Leap& leap = w.leaps[c.walker];
    if (leap.stage == LeapStage::flies) return fly_creature(w, leap, c, dt);
    const bool lands = leap.stage == LeapStage::absorbs && leap.seconds == 0;
    if (lands) land_creature(rays, w, c);
    const Vec3 place = w.position[c.walker];
    const float high = dot(c.middle - place, c.up);
    c.up = turned_towards(c.up, w.up[c.walker], k_creature_turn * dt);
    c.ahead = square_to(w.ahead[c.walker], c.up, c.ahead);
    float feet = 0;
    for (const CreatureLeg& leg : c.legs) feet += dot(leg.to - place, c.up) / k_creature_legs;
    const float crouch = k_leap_crouch * leap_crouch(leap, c.size);
    const float wanted = k_high * c.size - crouch + clamp(feet, -k_most_rise * c.size, k_most_rise * c.size);
    c.middle =
        place + c.up * lerp(high, wanted, std::min((crouch > 0 ? k_leap_settle : k_settle) * dt, 1.0f));
    step_legs(rays, c, pace_of(w, c, dt), dt);
}

Linkage creature_linkage(float size) {
    Linkage f;
    f.kind = Linkage::Kind::led;
    f.name = "a creature of six legs";
    std::vector<int> parents;
    auto joint = [&](int parent, float bone, float girth) {
        parents.push_back(parent);
        f.bones.push_back(bone * size);
        f.girth.push_back(girth * size);
        f.rest.push_back({});
    };
    joint(-1, 0, 0.115f);
    for (const Part& part : k_trunk) joint(part.parent, length(part.at), part.girth);
    for (int leg = 0; leg < k_creature_legs; ++leg) {
        const int hip = static_cast<int>(parents.size());
        joint(0, length(Vec3{k_hip_beside, 0, k_hip_before[leg % 3]}), 0.05f);
        for (int bone = 0; bone < 3; ++bone) joint(hip + bone, k_bones[bone], k_girths[bone]);
    }
    f.shape = *make_tree_shape(parents, {});
    Creature c;
    c.size = size;
    c.up = {0, 1, 0};
    c.ahead = {0, 0, 1};
    for (int leg = 0; leg < k_creature_legs; ++leg) c.legs[leg].foot = home_of(c, leg);
    place_creature(f, c, f.rest);
    return f;
}

void place_creature(const Linkage& f, const Creature& c, std::span<Vec3> places) {
    const Axes axes = axes_of(c);
    places[0] = c.middle;
    size_t at = 1;
    for (const Part& part : k_trunk)
        places[at++] = places[static_cast<size_t>(part.parent)] + axes(part.at * c.size);
    for (int number = 0; number < k_creature_legs; ++number, at += k_leg_joints) {
        const Vec3 foot = c.legs[number].foot, hip = hip_of(c, number);
        const Vec3 out = square_to(foot - hip, c.up, axes.left * side_of(number));
        // A knee that stands up, from which the legs are bent: so it never turns over.
        const std::span leg = places.subspan(at, k_leg_joints);
        leg[0] = hip;
        leg[1] = hip + (out * 0.8f + c.up * 0.6f) * (k_bones[0] * c.size);
        leg[2] = leg[1] + (out * 0.6f + c.up * 0.8f) * (k_bones[1] * c.size);
        leg[3] = leg[2] + (out * 0.5f - c.up * 0.866f) * (k_bones[2] * c.size);
        solve_chain(Solver::fabrik, leg, std::span(f.bones).subspan(at + 1, 3), foot, {0.0005f, 200});
    }
}

}  // namespace flaneur
