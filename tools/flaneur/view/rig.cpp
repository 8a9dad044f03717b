#include "tools/flaneur/view/rig.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/tick.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/view/camera.h"

namespace flaneur {
namespace {

float height_of(const World& world, uint32_t walker) {
    return world.kinds[world.crowd.identity.body[walker]].body.height * world.crowd.identity.scale[walker];
}

// --- behind a walker

constexpr float k_rounds[] = {0, 0.35f, -0.35f, 0.7f, -0.7f, 1.1f, -1.1f, 1.6f, -1.6f};  // radians
constexpr float k_lifts[] = {0, 0.45f};                                                  // metres
constexpr uint32_t k_look_ticks = 6;  // between two looks for a better place
constexpr float k_head = 0.32f;       // from the way of sight that a head is in it, metres
constexpr float k_kept = 0.3f;        // what staying where one is is worth

Behind behind_of(const CameraRig& rig, const World& world) {
    Behind place;
    place.feet = {rig.feet[0].value, rig.feet[1].value, rig.feet[2].value};
    place.heading = rig.heading.value;
    place.height = height_of(world, rig.choice.walker);
    place.round = rig.round.value;
    place.lift = rig.lift.value;
    return place;
}

// The heads of others that may get in the way.
std::vector<Vec3> heads_near(const World& world, uint32_t walker) {
    constexpr float k_near = 6;
    std::vector<Vec3> heads;
    const Vec3 at = world.crowd.motion.position[walker];
    for (uint32_t i = 0; i < world.crowd.count; ++i) {
        const Vec3 other = world.crowd.motion.position[i];
        if (i == walker || std::fabs(other.x - at.x) > k_near || std::fabs(other.z - at.z) > k_near ||
            !is_there(world.crowd, i))
            continue;
        heads.push_back(other + Vec3{0, 0.92f * height_of(world, i), 0});
    }
    return heads;
}

float distance_to_way(Vec3 point, Vec3 from, Vec3 to) {
    const Vec3 way = to - from;
    const float along = clamp(dot(point - from, way) / std::max(length_squared(way), 1e-6f), 0, 1);
    return length(point - (from + way * along));
}

// How much of the way from the crown to the eye no wall takes.
float clear_share(const Ground& ground, const Behind& place) {
    return clear_behind(ground, place) / length(eye_behind(place) - (place.feet + Vec3{0, place.height, 0}));
}

// The same, and less the nearer it comes to where walls will take some: so the eye is there before they are.
float room_about(const Ground& ground, Behind place) {
    constexpr int k_feelers = 4;                       // on either side
    constexpr float k_apart = 0.11f, k_given = 0.13f;  // radians between two; what one farther off lets have
    const float middle = place.round;
    float room = 1;
    for (int feeler = -k_feelers; feeler <= k_feelers; ++feeler) {
        place.round = middle + k_apart * static_cast<float>(feeler);
        room = std::min(room, clear_share(ground, place) + k_given * static_cast<float>(std::abs(feeler)));
    }
    return room;
}

// The place nearest to straight behind from which walls and heads hide least of the walker.
void look_for_place(CameraRig& rig, const World& world) {
    const std::vector<Vec3> heads = heads_near(world, rig.choice.walker);
    float least = 1e9f;
    const float round = rig.wanted_round, lift = rig.wanted_lift;
    for (const float r : k_rounds)
        for (const float l : k_lifts) {
            Behind place = behind_of(rig, world);
            place.round = r, place.lift = l;
            const Vec3 eye = eye_behind(place), crown = place.feet + Vec3{0, place.height, 0};
            const float whole = length(eye - crown);
            const float clear = clear_behind(*world.ground, place);
            float cost = std::fabs(r) + l + 3 * (1 - clear / whole);
            const Vec3 seen_from = crown + (eye - crown) * (clear / whole);
            for (const Vec3 head : heads)
                if (distance_to_way(head, seen_from, crown - Vec3{0, 0.3f * place.height, 0}) < k_head)
                    cost += 1.2f;
            if (r == round && l == lift) cost -= k_kept;
            if (cost >= least) continue;
            least = cost;
            rig.wanted_round = r, rig.wanted_lift = l;
        }
}

Gaze follow(CameraRig& rig, const World& world, float seconds) {
    constexpr float k_feet = 12, k_climb = 5, k_turn = 3.5f, k_round = 2.5f;  // stiffness
    constexpr float k_in = 10, k_back = 2.5f;  // before a wall, and when it is passed
    const uint32_t walker = rig.choice.walker;
    const Vec3 at = world.crowd.motion.position[walker];
    const float heading =
        rig.heading.value + wrap_angle(world.crowd.motion.heading[walker] - rig.heading.value);
    const bool is_new = rig.ticks == 0;
    if (is_new) {
        rig.feet[0] = {at.x}, rig.feet[1] = {at.y}, rig.feet[2] = {at.z}, rig.heading = {heading};
        rig.wanted_round = rig.wanted_lift = 0;
    }
    draw_towards(rig.feet[0], at.x, k_feet, seconds);
    draw_towards(rig.feet[1], at.y, k_climb, seconds);
    draw_towards(rig.feet[2], at.z, k_feet, seconds);
    draw_towards(rig.heading, heading, k_turn, seconds);
    if (rig.ticks % k_look_ticks == 0) look_for_place(rig, world);
    if (is_new) rig.round = {rig.wanted_round}, rig.lift = {rig.wanted_lift};
    draw_towards(rig.round, rig.wanted_round, k_round, seconds);
    draw_towards(rig.lift, rig.wanted_lift, k_round, seconds);

    Behind place = behind_of(rig, world);
    const float clear = clear_share(*world.ground, place), room = room_about(*world.ground, place);
    if (is_new) rig.reach = {clear};
    draw_towards(rig.reach, std::min(clear, room), room < rig.reach.value ? k_in : k_back, seconds);
    if (rig.reach.value > clear) rig.reach = {clear};
    place.reach = rig.reach.value;
    return gaze_of(camera_behind(place));
}

// --- through a walker's eyes

Gaze see(CameraRig& rig, const World& world, float seconds) {
    // What a head does with each step is left out of the picture, as brains leave it out.
    constexpr float k_sway = 3, k_height = 9, k_turn = 5, k_nod = 4;  // 1/s
    constexpr float k_most_pitch = 0.6f;
    const uint32_t walker = rig.choice.walker;
    const JointPose head_pose = joint_between(world, walker, head, 1);
    const float size = height_of(world, walker) / 1.72f;
    const Vec3 eyes = head_pose.position + rotate(head_pose.rotation, Vec3{0, 0.09f, 0.1f} * size);
    const Vec3 root = world.crowd.motion.position[walker];
    const Quat facing = rotation_y(world.crowd.motion.heading[walker]);
    const Vec3 from_root = rotate(conjugate(facing), eyes - root);
    const Vec3 way = rotate(head_pose.rotation, Vec3{0, 0, 1});
    const bool is_new = rig.ticks == 0;
    const float yaw = is_new ? heading_of({way.x, way.z})
                             : rig.yaw.value + wrap_angle(heading_of({way.x, way.z}) - rig.yaw.value);
    const float pitch =
        clamp(arctan2(way.y, std::sqrt(way.x * way.x + way.z * way.z)), -k_most_pitch, k_most_pitch);
    if (is_new) {
        rig.eyes_from_root = from_root;
        rig.eyes_height = {eyes.y}, rig.yaw = {yaw}, rig.pitch = {pitch};
    }
    rig.eyes_from_root = rig.eyes_from_root + (from_root - rig.eyes_from_root) * (k_sway * seconds);
    draw_towards(rig.eyes_height, eyes.y, k_height, seconds);
    draw_towards(rig.yaw, yaw, k_turn, seconds);
    draw_towards(rig.pitch, pitch, k_nod, seconds);
    const Vec3 level = root + rotate(facing, rig.eyes_from_root);
    return {{level.x, rig.eyes_height.value, level.z}, rig.yaw.value, rig.pitch.value, k_fov};
}

}  // namespace

void draw_towards(Spring& spring, float wanted, float stiffness, float seconds) {
    // The critically damped oscillator's exact solution.
    const float off = spring.value - wanted, fall = spring.speed + stiffness * off;
    const float left = exponential(-std::min(stiffness * seconds, 80.0f));
    spring.value = wanted + (off + fall * seconds) * left;
    spring.speed = (spring.speed - stiffness * fall * seconds) * left;
}

Camera camera_of(const Gaze& gaze) {
    const SinCos up = sin_cos(gaze.pitch);
    const Vec2 ahead = heading_direction(gaze.yaw);
    Camera camera = make_camera(gaze.eye, gaze.eye + Vec3{ahead.x * up.cosine, up.sine, ahead.z * up.cosine});
    camera.vertical_fov = gaze.fov;
    return camera;
}

Gaze gaze_of(const Camera& camera) {
    const glm::vec3 way = camera.target - camera.eye;
    return {{camera.eye.x, camera.eye.y, camera.eye.z},
            heading_of({way.x, way.z}),
            arctan2(way.y, std::sqrt(way.x * way.x + way.z * way.z)),
            camera.vertical_fov};
}

Gaze between(const Gaze& from, const Gaze& to, float share) {
    return {lerp(from.eye, to.eye, share), from.yaw + wrap_angle(to.yaw - from.yaw) * share,
            lerp(from.pitch, to.pitch, share),
            2 * std::atan(std::tan(from.fov / 2) *
                          std::pow(std::tan(to.fov / 2) / std::tan(from.fov / 2), share))};
}

void advance(CameraRig& rig, const World& world, const CameraChoice& choice) {
    if (rig.choice != choice) rig = CameraRig(), rig.choice = choice;
    if (world.roam) {
        if (choice.kind != CameraChoice::Kind::follow || choice.walker >= followed_count(world)) return;
        rig.is_round = true;
        follow_round(rig.round_rig, world, choice.walker, rig.ticks == 0, k_tick);
        ++rig.ticks;
        return;
    }
    const bool is_somebody =
        goes_along(choice.kind) && choice.walker < world.crowd.count && is_there(world.crowd, choice.walker);
    const bool is_same =
        rig.ticks == 0 || (is_somebody && rig.generation == world.crowd.slots.generation[choice.walker]);
    rig.is_left = goes_along(choice.kind) && rig.ticks > 0 && !is_same;
    if (!is_somebody || !is_same) return;
    rig.generation = world.crowd.slots.generation[choice.walker];
    rig.before = rig.now;
    rig.now =
        choice.kind == CameraChoice::Kind::follow ? follow(rig, world, k_tick) : see(rig, world, k_tick);
    if (rig.ticks == 0) rig.before = rig.now;
    ++rig.ticks;
}

Camera camera_of(const CameraRig& rig, float fov, float share) {
    if (rig.is_round) {
        Camera camera = camera_of(rig.round_rig, share);
        if (fov > 0) camera.vertical_fov = fov;
        return camera;
    }
    Gaze gaze = between(rig.before, rig.now, share);
    if (share == 1) gaze = rig.now;
    if (fov > 0) gaze.fov = fov;
    return camera_of(gaze);
}

}  // namespace flaneur
