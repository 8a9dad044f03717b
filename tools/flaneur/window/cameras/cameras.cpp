#include "tools/flaneur/window/cameras/cameras.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/cameras/map.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

void ease_lens(Camera& camera, float lens, float seconds) {
    constexpr float k_rate = 9, k_there = 2e-4f;  // 1/s; radians
    const float off = lens - camera.vertical_fov;
    camera.vertical_fov = std::fabs(off) < k_there ? lens : lens - off * std::exp(-k_rate * seconds);
}

// Between bar and timeline, where they are laid out.
CameraChoice whole_map(const Viewer& v, const World& world, Size size) {
    const float top = v.layout.wish.bar_foot, foot = v.layout.plan.timeline_top;
    return v.has_panels && foot > top ? map_between(world, size, top, foot) : map_of_all(world, size);
}

// Of a glide, so that it is seen where pictures take long.
constexpr float k_longest = 0.12f;  // seconds between two pictures

}  // namespace

void begin_cameras(const Scene& scene, Viewer& v) {
    Cameras fresh;
    fresh.fov = scene.fov;
    fresh.has_lens = scene.fov > 0;
    fresh.path = std::move(v.cameras.path);
    fresh.pad = v.cameras.pad;
    std::copy(std::begin(v.cameras.path_file), std::end(v.cameras.path_file), std::begin(fresh.path_file));
    v.cameras = std::move(fresh);
    v.choice = scene.camera;
    v.chosen = false;
}

CameraMode mode_of(const Viewer& v) {
    if (v.cameras.is_on_path) return CameraMode::path;
    if (v.cameras.is_walking) return CameraMode::walk;
    switch (v.choice.kind) {
        case CameraChoice::Kind::street:
            return CameraMode::street;
        case CameraChoice::Kind::overview:
            return CameraMode::overview;
        case CameraChoice::Kind::crowd:
            return CameraMode::crowd;
        case CameraChoice::Kind::follow:
            return CameraMode::follow;
        case CameraChoice::Kind::eyes:
            return CameraMode::eyes;
        case CameraChoice::Kind::map:
            return CameraMode::map;
        case CameraChoice::Kind::fixed:
            break;
    }
    return CameraMode::fly;
}

float lens_of(const Viewer& v) { return v.cameras.fov > 0 ? v.cameras.fov : k_fov; }

void choose(Viewer& v, const CameraChoice& choice) {
    v.choice = choice;
    v.chosen = false;
    v.cameras.is_walking = v.cameras.is_on_path = v.cameras.is_playing = false;
}

void choose(Viewer& v, CameraChoice::Kind kind) { choose(v, CameraChoice{kind, v.choice.walker, {}, {}}); }

void take_off(Viewer& v) {
    Cameras& c = v.cameras;
    end(c.glide);
    c.is_walking = c.is_on_path = c.is_playing = false;
    v.choice.kind = CameraChoice::Kind::fixed;
    v.chosen = true;
    v.camera.clear_air = 0;
    v.camera.up = {0, 1, 0};
}

CameraChoice kept_choice(const Viewer& v) {
    const bool is_led = goes_along(v.choice.kind) || v.choice.kind == CameraChoice::Kind::map;
    if (is_led) return v.choice;
    const Camera& camera = is_gliding(v.cameras.glide) ? v.cameras.glide.to : v.camera;
    const CameraKey key = key_of(camera, 0);
    return {CameraChoice::Kind::fixed, v.choice.walker, key.eye, key.target};
}

void look_at_map(const Show& show, Viewer& v) {
    Cameras& c = v.cameras;
    const bool is_map = v.choice.kind == CameraChoice::Kind::map;
    if (is_map && v.choice == c.whole_map && c.near_map.across > 0) return choose(v, c.near_map);
    if (is_map && v.choice != c.whole_map) c.near_map = v.choice;
    if (!is_map && c.has_shown) {
        const glm::vec2 window = v.layout.wish.window;
        const Size size{static_cast<int>(window.x), static_cast<int>(window.y)};
        const Camera& here = is_gliding(c.glide) ? c.glide.to : v.camera;
        c.near_map = map_around(*show.loaded.world, here, size_of_one(v, size));
    }
    choose(v, CameraChoice::Kind::map);
    tell(v, std::string("All of the city. The wheel zooms in at the cursor") +
                (c.near_map.across > 0 ? ", 5 goes back and forth between this and nearby." : "."));
}

void set_foot(const Show& show, Viewer& v) {
    if (v.cameras.is_walking) return take_off(v);
    const World& world = *show.loaded.world;
    const std::optional<Stroll> walk = set_foot(world, v.camera);
    if (!walk)
        return tell(v, world.roam ? "One walks on foot in cities: here up is not one way."
                                  : "There is no ground to walk on, below or where you look.");
    choose(v, CameraChoice::Kind::fixed);
    v.cameras.walk = *walk;
    v.cameras.is_walking = true;
    tell(v, "On foot: W A S D walk, Shift runs, drag to look about; E or G lifts off.");
}

void show_path(Viewer& v, double seconds, bool plays) {
    Cameras& c = v.cameras;
    if (c.path.keys.empty()) return tell(v, "The path has no key yet: keep one in the room Cameras.");
    if (!c.is_on_path) {
        choose(v, CameraChoice::Kind::fixed);
        c.is_on_path = true;
    }
    c.path_time = std::clamp(seconds, 0.0, duration(c.path));
    c.is_playing = plays;
}

void add_key(Viewer& v) {
    constexpr double k_pace = 6, k_least = 2;  // metres a second; seconds
    if (v.choice.kind == CameraChoice::Kind::map)
        return tell(v, "A path goes through the city: leave the map for its keys.");
    CameraPath& path = v.cameras.path;
    const Camera& camera = is_gliding(v.cameras.glide) ? v.cameras.glide.to : v.camera;
    CameraKey key = key_of(camera, 0);
    if (!path.keys.empty()) {
        const double way = static_cast<double>(length(key.eye - path.keys.back().eye));
        key.time = path.keys.back().time + std::max(k_least, std::round(2 * way / k_pace) / 2);
    }
    path.keys.push_back(key);
    tell(v, "Key " + std::to_string(path.keys.size()) + " of the path is kept.");
}

Steering read_pad(GLFWwindow* window, float seconds, Viewer& v) {
    const Pad before = std::exchange(v.cameras.pad, {});
    for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick) {
        GLFWgamepadstate state;
        if (!glfwGetGamepadState(joystick, &state)) continue;
        std::copy(std::begin(state.axes), std::end(state.axes), v.cameras.pad.axes.begin());
        std::transform(std::begin(state.buttons), std::end(state.buttons), v.cameras.pad.buttons.begin(),
                       [](unsigned char button) { return button == GLFW_PRESS; });
        break;
    }
    const Pad& now = v.cameras.pad;
    auto is_pressed = [&](int button) {
        return now.buttons[static_cast<size_t>(button)] && !before.buttons[static_cast<size_t>(button)];
    };
    if (glfwGetWindowAttrib(window, GLFW_FOCUSED) != GLFW_TRUE) return {};
    if (is_pressed(GLFW_GAMEPAD_BUTTON_A)) v.presses.push_back({GLFW_KEY_SPACE, 0, false});
    if (is_pressed(GLFW_GAMEPAD_BUTTON_B)) {
        v.selected.reset();
        if (mode_of(v) != CameraMode::fly) take_off(v);
    }
    return steering_of(now, seconds);
}

bool steer(const Show& show, const Steering& hands, float seconds, Viewer& v) {
    if (!v.cameras.has_shown) return false;
    switch (mode_of(v)) {
        case CameraMode::map:
            return steer_map(v.choice, hands, seconds);
        case CameraMode::walk:
            if (hands.up != 0) return fly(hands, seconds, v);
            return walk(*show.loaded.world, hands, seconds, v.cameras.walk);
        default:
            return fly(hands, seconds, v);
    }
}

bool move_camera(const Show& show, Size size, float seconds, float between, Viewer& v) {
    Cameras& c = v.cameras;
    const World& world = *show.loaded.world;
    using enum CameraChoice::Kind;
    const bool is_round = v.choice.kind == overview || v.choice.kind == fixed || v.choice.kind == follow;
    if (world.roam && !is_round) choose(v, overview);
    const bool is_new = !std::exchange(v.chosen, true);
    const float lens = lens_of(v);
    if (goes_along(v.choice.kind) && c.rig.choice != v.choice) advance(c.rig, world, v.choice);
    if (v.choice.kind == CameraChoice::Kind::map && v.choice.across == 0)
        v.choice = c.whole_map = whole_map(v, world, size);

    Camera wanted = is_gliding(c.glide) ? c.glide.to : v.camera;
    bool is_led = false;
    switch (mode_of(v)) {
        case CameraMode::follow:
        case CameraMode::eyes:
            wanted = camera_of(c.rig, c.fov, between);
            is_led = !v.clock.is_paused;
            break;
        case CameraMode::map:
            wanted = map_camera(world, v.choice, size);
            break;
        case CameraMode::walk:
            wanted = camera_of(gaze_of(c.walk, is_new ? lens : wanted.vertical_fov));
            ease_lens(wanted, lens, seconds);
            break;
        case CameraMode::path:
            is_led = c.is_playing;
            if (c.is_playing) c.path_time += static_cast<double>(seconds);
            if (c.path_time >= duration(c.path)) c.path_time = duration(c.path), c.is_playing = false;
            wanted = camera_at(c.path, c.path_time);
            break;
        default:
            if (is_new)
                wanted = choose_camera(show, v.choice, c.fov, size, between);
            else
                ease_lens(wanted, lens, seconds);
    }
    if (is_new && c.has_shown) begin(c.glide, world, v.camera, wanted);
    if (v.record.wants_picture || v.record.wants_panels || v.wants_command || v.wants_bench_command)
        end(c.glide);  // of what it comes to
    c.has_shown = true;
    c.glide.to = wanted;
    c.glide.passed += std::min(seconds, k_longest);
    const Camera before = std::exchange(v.camera, camera_of(c.glide));
    return is_led || is_gliding(c.glide) || before.vertical_fov != v.camera.vertical_fov;
}

}  // namespace flaneur
