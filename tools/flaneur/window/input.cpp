#include "tools/flaneur/window/input.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "sim/base/math.h"
#include "tools/flaneur/window/gui.h"

namespace flaneur {
namespace {

constexpr float k_walk_speed = 4, k_run_speed = 25;  // of the flying eye, metres a second
constexpr float k_look_speed = 0.003f;               // radians a pixel
constexpr float k_steepest = 1.55f;                  // radians
constexpr double k_drag = 4;                         // pixels that a click may move

Viewer& viewer_of(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }

// Of a field in which Enter, Esc and arrows choose among what is found.
bool is_choice(int key) {
    return key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_ESCAPE ||
           key == GLFW_KEY_UP || key == GLFW_KEY_DOWN;
}

// Keys of a field. Those that are held down wait for none.
void add_typed(int key, int mods, bool repeats, Viewer& v) {
    std::deque<Typed>& waiting = v.events.typing.waiting;
    if (gui_has_field()) {
        const bool is_other = !edits(key, mods) || (has_own_field(v) && is_choice(key)) ||
                              (v.panel_keys.are_on && is_panel_key(key));
        if (!is_other && (!repeats || waiting.empty())) waiting.push_back({0, key, mods});
    } else if (mods & GLFW_MOD_CONTROL) {
        waiting.clear();  // before this key opened a field
    }
}

// While a city is loaded nothing can be done but to close the window. The palette and the name of a file have
// keys of their own, though one types in them.
void on_key(GLFWwindow* window, int key, int, int action, int mods) {
    Viewer& v = viewer_of(window);
    if (action == GLFW_RELEASE) return;
    if (!v.is_loading) add_typed(key, mods, action == GLFW_REPEAT, v);
    const bool has_own_keys = has_own_field(v) || v.panel_keys.are_on;
    // These are nothing that one types; and a field that was left counts as one until the next picture.
    const bool is_typed = key != GLFW_KEY_ESCAPE && (!(mods & GLFW_MOD_CONTROL) || edits(key, mods));
    if (gui_has_keys() && !has_own_keys && is_typed) return;
    if (v.is_loading && key == GLFW_KEY_ESCAPE) v.wants_close = true;
    if (!v.is_loading) v.presses.push_back({key, mods, action == GLFW_REPEAT});
}

void on_letter(GLFWwindow* window, unsigned letter) {
    Viewer& v = viewer_of(window);
    if (!v.is_loading) v.events.typing.waiting.push_back({letter, 0, 0});
}

void add_mouse(Viewer& v, int button, bool is_down) {
    if (!v.is_loading) add_event(v.events.mouse, {v.events.x, v.events.y, button, is_down});
}
void on_cursor(GLFWwindow* window, double x, double y) {
    Viewer& v = viewer_of(window);
    v.events.x = x, v.events.y = y;
    add_mouse(v, -1, false);
}
// The window asks where the cursor is now; its last event tells where it was then.
void on_button(GLFWwindow* window, int button, int action, int) {
    add_mouse(viewer_of(window), button, action == GLFW_PRESS);
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
    glfwSetCharCallback(window, on_letter);
    glfwSetCursorPosCallback(window, on_cursor);
    glfwSetMouseButtonCallback(window, on_button);
    Events& events = viewer.events;
    glfwGetCursorPos(window, &events.x, &events.y);
    events.pointer.x = events.x, events.pointer.y = events.y;
}

bool edits(int key, int mods) {
    constexpr int k_keys[] = {GLFW_KEY_ENTER,  GLFW_KEY_KP_ENTER, GLFW_KEY_ESCAPE, GLFW_KEY_BACKSPACE,
                              GLFW_KEY_DELETE, GLFW_KEY_INSERT,   GLFW_KEY_LEFT,   GLFW_KEY_RIGHT,
                              GLFW_KEY_UP,     GLFW_KEY_DOWN,     GLFW_KEY_HOME,   GLFW_KEY_END};
    constexpr int k_with_control[] = {GLFW_KEY_A, GLFW_KEY_C, GLFW_KEY_V, GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_Z};
    auto is_among = [key](const auto& keys) {
        return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
    };
    return is_among(k_keys) || ((mods & GLFW_MOD_CONTROL) && is_among(k_with_control));
}

bool has_own_field(const Viewer& v) {
    return v.palette.is_open || v.opening.prompt.is_open || v.change.is_naming;
}

void read_mouse(const Pointer& pointer, bool is_on_panel, Mouse& mouse) {
    const Mouse before = mouse;
    mouse.x = pointer.x, mouse.y = pointer.y;
    mouse.is_down = pointer.is_down;
    auto holds = [&](size_t button, bool held) {
        return pointer.is_down[button] && (held || (!is_on_panel && !before.is_down[button]));
    };
    mouse.is_held = holds(GLFW_MOUSE_BUTTON_LEFT, before.is_held);
    mouse.pans = holds(GLFW_MOUSE_BUTTON_MIDDLE, before.pans);
    mouse.orbits = holds(GLFW_MOUSE_BUTTON_RIGHT, before.orbits);
    if (mouse.is_held && !before.is_held) mouse.held_x = mouse.x, mouse.held_y = mouse.y;
    mouse.has_clicked = before.is_held && !mouse.is_held &&
                        std::hypot(mouse.x - mouse.held_x, mouse.y - mouse.held_y) < k_drag;
}

bool is_of_panels(const Mouse& before, const Mouse& now, bool is_on_panel) {
    auto is_citys = [](const Mouse& mouse) { return mouse.is_held || mouse.pans || mouse.orbits; };
    if (is_citys(now) || is_citys(before)) return false;
    return is_on_panel || now.is_down[0] || now.is_down[1] || now.is_down[2];
}

GuiInput gui_input(GLFWwindow* window, Viewer& v) {
    auto held = [&](int left, int right, int mod) {
        return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS ? mod : 0;
    };
    GuiInput input{.pointer = v.events.pointer,
                   .typed = take_typed(v.events.typing, gui_has_field(), has_own_field(v)),
                   .moves = v.panel_keys.are_on,
                   .tap = next_tap(v.panel_keys)};
    input.held = held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL) |
                 held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT) |
                 held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
    return input;
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
