#include "tools/flaneur/window/input.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/window/gui.h"

namespace flaneur {
namespace {

constexpr float k_walk_speed = 4, k_run_speed = 25;  // of the flying eye, metres a second
constexpr float k_look_speed = 0.003f;               // radians a pixel
constexpr float k_steepest = 1.55f;                  // radians
constexpr double k_drag = 4;                         // pixels that a click may move

Viewer& viewer_of(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }

// While a city is loaded nothing can be done but to close the window. The palette and the name of a file have
// keys of their own, though one types in them.
void on_key(GLFWwindow* window, int key, int, int action, int mods) {
    Viewer& v = viewer_of(window);
    const bool has_own_keys =
        v.palette.is_open || v.opening.prompt.is_open || v.panel_keys.are_on || v.change.is_naming;
    // These are nothing that one types.
    const bool is_typed = key != GLFW_KEY_ESCAPE && !(key == GLFW_KEY_Q && (mods & GLFW_MOD_CONTROL));
    if (action == GLFW_RELEASE || (gui_has_keys() && !has_own_keys && is_typed)) return;
    if (v.is_loading && key == GLFW_KEY_ESCAPE) v.wants_close = true;
    if (!v.is_loading) v.presses.push_back({key, mods, action == GLFW_REPEAT});
}

void on_drop(GLFWwindow* window, int count, const char** paths) {
    std::vector<std::string>& dropped = viewer_of(window).opening.dropped;
    dropped.insert(dropped.end(), paths, paths + count);
}

}  // namespace

void listen(GLFWwindow* window, Viewer& viewer) {
    glfwSetWindowUserPointer(window, &viewer);
    glfwSetKeyCallback(window, on_key);
    glfwSetDropCallback(window, on_drop);
    glfwSetInputMode(window, GLFW_STICKY_MOUSE_BUTTONS, GLFW_TRUE);  // clicks between two frames too
}

void read_mouse(GLFWwindow* window, bool is_panels, Mouse& mouse) {
    const Mouse before = mouse;
    glfwGetCursorPos(window, &mouse.x, &mouse.y);
    auto holds = [&](int button, bool held) {
        return glfwGetMouseButton(window, button) == GLFW_PRESS && (held || !is_panels);
    };
    mouse.is_held = holds(GLFW_MOUSE_BUTTON_LEFT, before.is_held);
    mouse.pans = holds(GLFW_MOUSE_BUTTON_MIDDLE, before.pans);
    mouse.orbits = holds(GLFW_MOUSE_BUTTON_RIGHT, before.orbits);
    if (mouse.is_held && !before.is_held) mouse.held_x = mouse.x, mouse.held_y = mouse.y;
    mouse.has_clicked = before.is_held && !mouse.is_held &&
                        std::hypot(mouse.x - mouse.held_x, mouse.y - mouse.held_y) < k_drag;
}

Steering steering_of(GLFWwindow* window, const Mouse& before, const Mouse& now, const Viewer& v) {
    const bool is_typing = gui_has_keys() || v.opening.start.is_open;
    // Ctrl and Alt make actions of letters.
    auto held = [&](int key) { return glfwGetKey(window, key) == GLFW_PRESS; };
    const bool is_action = held(GLFW_KEY_LEFT_CONTROL) || held(GLFW_KEY_RIGHT_CONTROL) ||
                           held(GLFW_KEY_LEFT_ALT) || held(GLFW_KEY_RIGHT_ALT);
    auto down = [&](int a, int b) { return !is_typing && !is_action && (held(a) || held(b)) ? 1.0f : 0.0f; };
    Steering out;
    out.ahead = down(GLFW_KEY_W, GLFW_KEY_UP) - down(GLFW_KEY_S, GLFW_KEY_DOWN);
    out.left = down(GLFW_KEY_A, GLFW_KEY_LEFT) - down(GLFW_KEY_D, GLFW_KEY_RIGHT);
    out.up = down(GLFW_KEY_E, GLFW_KEY_PAGE_UP) - down(GLFW_KEY_Q, GLFW_KEY_PAGE_DOWN);
    out.is_fast = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) > 0;
    if (before.is_held && now.is_held) {
        out.turn = static_cast<float>(before.x - now.x) * k_look_speed;
        out.tilt =
            static_cast<float>(before.y - now.y) * k_look_speed * (v.settings.inverts_look ? -1.0f : 1.0f);
    }
    return out;
}

bool fly(const Steering& hands, float seconds, Viewer& v) {
    if (hands == Steering{.is_fast = hands.is_fast}) return false;
    take_off(v);
    const glm::vec3 way = glm::normalize(v.camera.target - v.camera.eye);
    const float slope = arctan2(way.y, std::hypot(way.x, way.z));
    const SinCos pitch =
        sin_cos(std::clamp(std::clamp(slope, -k_steepest, k_steepest) + hands.tilt, -k_steepest, k_steepest));
    const Vec2 d = heading_direction(heading_of({way.x, way.z}) + hands.turn);
    const glm::vec3 forward{d.x * pitch.cosine, pitch.sine, d.z * pitch.cosine};
    const glm::vec3 sideways{d.z, 0, -d.x};
    const float speed = (hands.is_fast ? k_run_speed : k_walk_speed) * v.settings.pace;
    v.camera.eye +=
        (forward * hands.ahead + sideways * hands.left + glm::vec3(0, hands.up, 0)) * (speed * seconds);
    v.camera.target = v.camera.eye + forward;
    return true;
}

}  // namespace flaneur
