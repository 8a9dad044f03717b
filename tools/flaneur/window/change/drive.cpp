#include "tools/flaneur/window/change/drive.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

namespace {

constexpr float k_run = 3, k_run_with_pram = 1.6f;  // m/s
constexpr float k_dead = 0.2f;                      // of a stick
constexpr float k_goes = 0.3f;                      // m/s, at which one goes on rather than stands
constexpr float k_turn_of_key = 45;                 // degrees

struct Asked {
    Vec2 way;  // x to the right, z ahead; of length 1 at most
    bool runs = false, creeps = false;
};

Asked asked_of(GLFWwindow* window) {
    Asked asked;
    if (gui_has_keys()) return asked;
    auto held = [&](int a, int b) {
        return glfwGetKey(window, a) == GLFW_PRESS || glfwGetKey(window, b) == GLFW_PRESS ? 1.0f : 0.0f;
    };
    asked.way = {held(GLFW_KEY_D, GLFW_KEY_RIGHT) - held(GLFW_KEY_A, GLFW_KEY_LEFT),
                 held(GLFW_KEY_W, GLFW_KEY_UP) - held(GLFW_KEY_S, GLFW_KEY_DOWN)};
    asked.runs = held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) > 0;
    asked.creeps = glfwGetKey(window, GLFW_KEY_Q) == GLFW_PRESS;
    GLFWgamepadstate pad;
    if (glfwGetGamepadState(GLFW_JOYSTICK_1, &pad) == GLFW_TRUE) {
        const Vec2 stick{pad.axes[GLFW_GAMEPAD_AXIS_LEFT_X], -pad.axes[GLFW_GAMEPAD_AXIS_LEFT_Y]};
        if (length(stick) > k_dead) asked.way = stick;
        asked.runs |= pad.buttons[GLFW_GAMEPAD_BUTTON_A] == GLFW_PRESS;
        asked.creeps |= pad.buttons[GLFW_GAMEPAD_BUTTON_B] == GLFW_PRESS;
    }
    const float much = length(asked.way);
    if (much > 1) asked.way = asked.way / much;
    return asked;
}

// On the ground, as the camera sees it.
Vec2 seen_way(const Viewer& v, Vec2 way) {
    const glm::vec3 sight = v.camera.target - v.camera.eye;
    const Vec2 ahead = normalize_or(Vec2{sight.x, sight.z}, {0, 1}), right{-ahead.z, ahead.x};
    return ahead * way.z + right * way.x;
}

}  // namespace

// From where it is now.
static void begin_driving(const Show& show, Viewer& v) {
    const World& world = *show.loaded.world;
    const Crowd& c = world.crowd;
    Driving& d = v.change.driving;
    const Vec2 velocity = c.motion.velocity[c.driven.walker];
    d.goes_on = length(velocity) > k_goes;
    d.heading = c.motion.heading[c.driven.walker];
    d.turn = {};
    d.tick = world.tick;
}

static void tell_keys(const World& world, Viewer& v) {
    tell(
        v,
        world.roam
            ? "Arrows or W A S D: walk. Shift: run. Space: leap, onto the body overhead where it is near "
              "enough. Esc lets it go its own way."
        : v.change.driving.is_by_turns
            ? "Up: go on. Down: stop. Left, Right: turn by 45 degrees. Shift: run. Space: jump. Esc gives it "
              "back to its errand."
            : "Arrows or W A S D: walk. Shift: run. Space: jump. Esc gives it back to its errand.");
}

static bool is_figure_led(const Show& show) { return show.loaded.world->figures.lead.figure != k_no_twin; }

bool is_driving(const Show& show) {
    return show.loaded.world->crowd.driven.walker != k_nobody || is_figure_led(show);
}

bool let_go_of_driven(Show& show, Viewer& v) {
    if (!is_driving(show)) return false;
    let_go(show.loaded.world->crowd);
    if (is_figure_led(show)) lead_figure(show.loaded.world->figures, k_no_twin);
    tell(v, "Goes about its own errand again.");
    return true;
}

void drive_figure(Show& show, Viewer& v) {
    World& world = *show.loaded.world;
    Troupe& figures = world.figures;
    auto is_by_keys = [](const FigurePlan& plan) {
        return plan.by == FigurePlan::By::keys && plan.twin_of == k_no_twin;
    };
    const auto begin = figures.plans.begin(), end = figures.plans.end();
    const auto after = is_figure_led(show) ? begin + figures.lead.figure + 1 : begin;
    const auto next = std::find_if(after, end, is_by_keys);
    if (next == end && let_go_of_driven(show, v)) return;
    if (next == end) return tell(v, "Bodies that key poses make walk in the scene ik-gallery.");
    let_go(world.crowd);
    lead_figure(figures, static_cast<uint32_t>(next - begin));
    // From where the eye is, but near.
    constexpr float k_away = 6.5f, k_high = 2.4f, k_breast = 1;  // metres
    const Vec3 at = figures.moves[figures.lead.figure].position;
    const Vec2 from = normalize_or(Vec2{v.camera.eye.x - at.x, v.camera.eye.z - at.z}, {0, 1}) * k_away;
    choose(v, CameraChoice{CameraChoice::Kind::fixed, v.choice.walker, at + at_height(from, k_high),
                           at + Vec3{0, k_breast, 0}});
    v.change.late = std::max(v.change.late, std::max(world.tick, 1u));
    tell(v, next->name + ": arrows or W A S D walk, Shift runs, Q creeps, Space leaps, Esc lets it go.");
}

void drive_asked(Show& show, Viewer& v) {
    if (let_go_of_driven(show, v)) return;
    World& world = *show.loaded.world;
    std::optional<uint32_t> who = v.selected ? v.selected : v.hovered;
    if (!who && v.choice.kind == CameraChoice::Kind::follow) who = v.choice.walker;
    if (!who || !is_there(world.crowd, *who))
        return tell(v, "Click or follow somebody, or point at them, to drive them.");
    drive(world.crowd, *who);
    v.choice.walker = *who;
    v.selected = who;
    choose(v, CameraChoice::Kind::follow);
    v.change.late = std::max(v.change.late, std::max(world.tick, 1u));
    begin_driving(show, v);
    tell_keys(world, v);
}

void drive_by_turns(Show& show, Viewer& v, bool is_by_turns) {
    v.change.driving.is_by_turns = is_by_turns;
    if (!is_driving(show)) return;
    begin_driving(show, v);
    tell_keys(*show.loaded.world, v);
}

bool press_in_drive(int key, int mods, Show& show, Viewer& v) {
    Driving& d = v.change.driving;
    if (!d.is_by_turns || !is_driving(show) || is_figure_led(show) || show.loaded.world->roam ||
        (mods & (GLFW_MOD_CONTROL | GLFW_MOD_ALT)))
        return false;
    auto is_one_of = [&](int a, int b) { return key == a || key == b; };
    if (is_one_of(GLFW_KEY_UP, GLFW_KEY_W)) return d.goes_on = true;
    if (is_one_of(GLFW_KEY_DOWN, GLFW_KEY_S)) return d.goes_on = false, true;
    const bool is_left = is_one_of(GLFW_KEY_LEFT, GLFW_KEY_A);
    if (!is_left && !is_one_of(GLFW_KEY_RIGHT, GLFW_KEY_D)) return false;
    if (is_turning(d.turn)) return true;
    d.goes_on = true;
    d.turn =
        begin_turn(show.loaded.world->crowd.march.how, d.heading, is_left ? k_turn_of_key : -k_turn_of_key);
    return true;
}

Vec2 wish_by_turns(const World& world, Driving& d, std::optional<float> speed) {
    const Crowd& c = world.crowd;
    const uint32_t walker = c.driven.walker;
    if (is_turning(d.turn)) d.heading = turn_on(d.turn, static_cast<float>(world.tick - d.tick) * k_tick);
    d.tick = world.tick;
    if (!d.goes_on) return {};
    const float own = is_on(c.march) ? c.march.pace[walker] : c.identity.preferred_speed[walker];
    return heading_direction(d.heading) * speed.value_or(own);
}

// Who was asked about, or is pointed at or followed.
static std::optional<uint32_t> meant(const Show& show, const Viewer& v) {
    std::optional<uint32_t> who = v.selected ? v.selected : v.hovered;
    if (!who && v.choice.kind == CameraChoice::Kind::follow) who = v.choice.walker;
    return who && is_there(show.loaded.world->crowd, *who) ? who : std::nullopt;
}

// Why push() refuses somebody.
static const char* why_not_pushed(const World& world, uint32_t walker) {
    if (world.roam) return "Nobody is pushed where people walk all round.";
    if (world.stepping && world.stepping->bipeds.is_flat)
        return "Nobody is pushed on a course in one line: its walkers keep to one plane.";
    if (is_creature(world.herd, walker)) return "It has six legs, and no push fells it.";
    if (world.crowd.identity.ahead[walker] > 0) return "Whoever pushes a pram is not pushed.";
    return "Whoever comes in or leaves just now is not pushed: wait a moment.";
}

void push_asked(Show& show, Viewer& v, float impulse) {
    World& world = *show.loaded.world;
    const std::optional<uint32_t> who = meant(show, v);
    if (!who) return tell(v, "Click or follow somebody, or point at them, to push them.");
    const Vec3 at = world.crowd.motion.position[*who];
    const Vec2 way = normalize_or(Vec2{at.x - v.camera.eye.x, at.z - v.camera.eye.z}, {0, 1});
    if (!push(world, {*who, world.crowd.slots.generation[*who]}, way * impulse))
        return tell(v, why_not_pushed(world, *who));
    v.change.late = std::max(v.change.late, std::max(world.tick, 1u));
    changed_by_hand(v.time, world);
}

void throw_asked(Show& show, Viewer& v, float mass) {
    constexpr float k_chest = 1.25f, k_ahead = 12, k_least = 9, k_spare = 1.25f;  // metres, m/s
    World& world = *show.loaded.world;
    if (world.roam) return tell(v, "Here a ball would fall for ever.");
    const Vec3 eye{v.camera.eye.x, v.camera.eye.y, v.camera.eye.z};
    const glm::vec3 ahead = glm::normalize(v.camera.target - v.camera.eye);
    PlannedThrow how{.from = eye, .at = eye + Vec3{ahead.x, ahead.y, ahead.z} * k_ahead, .mass = mass};
    if (const std::optional<uint32_t> who = meant(show, v)) {
        how.at = world.crowd.motion.position[*who] + Vec3{0, k_chest, 0};
        // Where they will be by then.
        const float far = length(how.at - eye),
                    speed = std::max(k_least, k_spare * std::sqrt(k_gravity * far));
        how.at += at_height(world.crowd.motion.velocity[*who] * (far / speed), 0);
    }
    how.speed = std::max(k_least, k_spare * std::sqrt(k_gravity * length(how.at - eye)));
    throw_ball(world, thrown(how));
    v.change.late = std::max(v.change.late, std::max(world.tick, 1u));
    changed_by_hand(v.time, world);
}

bool jump_driven(Show& show) {
    if (!is_driving(show)) return false;
    World& world = *show.loaded.world;
    if (is_figure_led(show)) {
        leap(world.figures);
        return true;
    }
    const uint32_t walker = world.crowd.driven.walker;
    if (world.roam) {
        ask_leap(world.roam->walkers, walker);
        return true;
    }
    return let_jump(world, {walker, world.crowd.slots.generation[walker]});
}

void steer_driven(GLFWwindow* window, Show& show, Viewer& v) {
    if (!is_driving(show)) return;
    Crowd& crowd = show.loaded.world->crowd;
    const uint32_t walker = crowd.driven.walker;
    const Asked asked = asked_of(window);
    if (is_figure_led(show)) {
        constexpr float k_walk = 1.3f, k_creep = 0.75f;  // m/s
        FigureLead& lead = show.loaded.world->figures.lead;
        lead.creeps = asked.creeps ? 1 : 0;
        lead.wish = seen_way(v, asked.way) * (asked.creeps ? k_creep : asked.runs ? k_run : k_walk);
        return;
    }
    const float run = crowd.identity.ahead[walker] > 0 ? k_run_with_pram : k_run;
    if (v.change.driving.is_by_turns && !show.loaded.world->roam) {
        const std::optional<float> speed = asked.runs ? std::optional(run) : std::nullopt;
        crowd.driven.wish = wish_by_turns(*show.loaded.world, v.change.driving, speed);
        return;
    }
    const glm::vec3 way = v.camera.target - v.camera.eye;
    if (World& world = *show.loaded.world; world.roam) {
        SurfaceWalkers& w = world.roam->walkers;
        const Vec3 up = w.up[walker], sight{way.x, way.y, way.z};
        const Vec3 on = normalize_or(sight - up * dot(sight, up), w.ahead[walker]), aside = cross(on, up);
        const float most = asked.runs ? k_run : crowd.identity.preferred_speed[walker];
        w.wish[walker] = (on * asked.way.z + aside * asked.way.x) * most;
        return;
    }
    crowd.driven.wish = seen_way(v, asked.way) * (asked.runs ? run : crowd.identity.preferred_speed[walker]);
}

}  // namespace flaneur
