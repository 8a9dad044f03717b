#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "sim/base/math.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

namespace {

constexpr double k_longest_step = 0.1;               // seconds of simulation for one frame, at most
constexpr float k_walk_speed = 4, k_run_speed = 25;  // of the flying eye, metres a second
constexpr float k_look_speed = 0.003f;               // radians a pixel
constexpr float k_steepest = 1.55f;                  // radians
constexpr double k_title_seconds = 0.5, k_note_seconds = 4;
constexpr double k_idle_seconds = 0.1;  // between looks at the keys while nothing is drawn

struct WindowDelete {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowPtr = std::unique_ptr<GLFWwindow, WindowDelete>;

struct GlfwSession {
    bool started = glfwInit() == GLFW_TRUE;
    ~GlfwSession() { glfwTerminate(); }
};

// What the keys and the mouse do to.
struct Viewer {
    CameraChoice choice;
    bool paused = false, wants_picture = false, looking = false, chosen = false;
    bool lists_keys = false;
    std::vector<WorkView> toggles;  // in the order of their keys
    uint32_t walkers = 0;
    Camera camera;
    float yaw = 0, pitch = 0;  // of the flying eye
    double mouse_x = 0, mouse_y = 0;
};

Viewer& viewer_of(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }

void choose(Viewer& v, CameraChoice::Kind kind) {
    v.choice.kind = kind;
    v.chosen = false;
}

void on_key(GLFWwindow* window, int key, int, int action, int) {
    if (action != GLFW_PRESS) return;
    Viewer& v = viewer_of(window);
    bool following = v.choice.kind == CameraChoice::Kind::follow;
    switch (key) {
        case GLFW_KEY_ESCAPE:
            glfwSetWindowShouldClose(window, GLFW_TRUE);
            break;
        case GLFW_KEY_SPACE:
            v.paused = !v.paused;
            break;
        case GLFW_KEY_F12:
            v.wants_picture = true;
            break;
        case GLFW_KEY_1:
            choose(v, CameraChoice::Kind::street);
            break;
        case GLFW_KEY_2:
            choose(v, CameraChoice::Kind::overview);
            break;
        case GLFW_KEY_TAB:
            if (v.walkers > 0 && following) v.choice.walker = (v.choice.walker + 1) % v.walkers;
            [[fallthrough]];
        case GLFW_KEY_3:
            if (v.walkers > 0) choose(v, CameraChoice::Kind::follow);
            break;
        case GLFW_KEY_F1:
            v.lists_keys = !v.lists_keys;
            break;
        default:
            if (key >= GLFW_KEY_F2 && key < GLFW_KEY_F2 + k_work_views)
                v.toggles.push_back(static_cast<WorkView>(key - GLFW_KEY_F2));
            break;
    }
}

// From wherever the camera is, the eye flies on freely.
void take_off(Viewer& v) {
    if (v.choice.kind == CameraChoice::Kind::fixed) return;
    v.choice.kind = CameraChoice::Kind::fixed;
    v.chosen = true;
}

void read_angles(Viewer& v) {
    glm::vec3 d = glm::normalize(v.camera.target - v.camera.eye);
    v.yaw = heading_of({d.x, d.z});
    v.pitch = std::clamp(arctan2(d.y, std::hypot(d.x, d.z)), -k_steepest, k_steepest);
}

void fly(GLFWwindow* window, Viewer& v, float seconds) {
    auto down = [&](int a, int b) {
        return glfwGetKey(window, a) == GLFW_PRESS || glfwGetKey(window, b) == GLFW_PRESS ? 1.0f : 0.0f;
    };
    float ahead = down(GLFW_KEY_W, GLFW_KEY_UP) - down(GLFW_KEY_S, GLFW_KEY_DOWN);
    float left = down(GLFW_KEY_A, GLFW_KEY_LEFT) - down(GLFW_KEY_D, GLFW_KEY_RIGHT);
    float up = down(GLFW_KEY_E, GLFW_KEY_PAGE_UP) - down(GLFW_KEY_Q, GLFW_KEY_PAGE_DOWN);
    float speed = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) > 0 ? k_run_speed : k_walk_speed;

    double x = 0, y = 0;
    glfwGetCursorPos(window, &x, &y);
    bool looking = glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS ||
                   glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_RIGHT) == GLFW_PRESS;
    float turn = 0, tilt = 0;
    if (looking && v.looking) {
        turn = static_cast<float>(v.mouse_x - x) * k_look_speed;
        tilt = static_cast<float>(v.mouse_y - y) * k_look_speed;
    }
    v.looking = looking;
    v.mouse_x = x;
    v.mouse_y = y;
    if (ahead == 0 && left == 0 && up == 0 && turn == 0 && tilt == 0) return;

    take_off(v);
    read_angles(v);
    v.yaw += turn;
    v.pitch = std::clamp(v.pitch + tilt, -k_steepest, k_steepest);
    SinCos pitch = sin_cos(v.pitch);
    Vec2 d = heading_direction(v.yaw);
    glm::vec3 forward{d.x * pitch.cosine, pitch.sine, d.z * pitch.cosine};
    glm::vec3 sideways{d.z, 0, -d.x};
    v.camera.eye += (forward * ahead + sideways * left + glm::vec3(0, up, 0)) * (speed * seconds);
    v.camera.target = v.camera.eye + forward;
}

// Of the tick, and of no picture that is there.
std::string picture_path(uint32_t tick) {
    std::string stem = "out/view-" + std::to_string(tick), path = stem + ".png";
    std::error_code ignored;
    for (int number = 2; std::filesystem::exists(path, ignored); ++number)
        path = stem + "-" + std::to_string(number) + ".png";
    return path;
}

// Fails only with the device; tells whether the picture could be written.
Result<std::string> save_picture(Show& show, const FrameInput& frame, Size size) {
    Result<Image> image = draw_image(*show.renderer, frame, static_cast<uint32_t>(size.width),
                                     static_cast<uint32_t>(size.height));
    if (!image) return image.error();
    std::string path = picture_path(show.loaded.world->tick);
    Result<PartFilePtr> file = open_file(path);
    Result<void> written = file ? write_png(std::move(*file), image->rgba, size) : file.error();
    std::string told = written ? "Wrote " + path : written.error().message;
    say(told);
    return told;
}

// Shown for a while in place of the figures.
struct TitleNote {
    std::string text;
    double until = 0;  // of glfwGetTime
};

void show_title(GLFWwindow* window, const Show& show, const TitleNote& note, double fps) {
    char figures[256];
    std::snprintf(figures, sizeof figures, "%.0f fps - %u walkers - %s", fps, show.loaded.world->crowd.count,
                  device_name(*show.renderer).c_str());
    std::string title = "flaneur - " + (glfwGetTime() < note.until ? printable(note.text) : figures);
    glfwSetWindowTitle(window, title.c_str());
}

// Loads on a thread of its own, so that the window says how far that is, and closes at once.
Result<Show> load_show(GLFWwindow* window, RendererPtr renderer, const Options& options) {
    auto loading = std::async(std::launch::async, [&] { return make_show(std::move(renderer), options); });
    while (loading.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        glfwWaitEventsTimeout(k_idle_seconds);
        if (glfwWindowShouldClose(window)) end_now(0);
        glfwSetWindowTitle(window, printable("flaneur: " + progress_line()).c_str());
    }
    return loading.get();
}

Result<void> run_loop(Show& show, GLFWwindow* window, Viewer& v, uint32_t close_after) {
    World& world = *show.loaded.world;
    double last = glfwGetTime(), due = 0, title_time = last;
    uint32_t drawn = 0, title_frames = 0;
    TitleNote note;
    while (!glfwWindowShouldClose(window)) {
        if (is_stopping()) return interrupted("the window is closed");
        const bool is_hidden = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
        if (is_hidden)
            glfwWaitEventsTimeout(k_idle_seconds);
        else
            glfwPollEvents();
        double now = glfwGetTime();
        double passed = now - last;
        last = now;
        if (!v.paused) due = std::min(due + passed, k_longest_step);
        for (; due >= static_cast<double>(k_tick); due -= static_cast<double>(k_tick)) step(show);
        auto between = static_cast<float>(due / static_cast<double>(k_tick));

        if (v.choice.kind == CameraChoice::Kind::follow || !v.chosen) {
            v.camera = choose_camera(*show.loaded.city, world, show.sun, v.choice, between);
            v.chosen = true;
        }
        fly(window, v, static_cast<float>(passed));
        for (WorkView view : std::exchange(v.toggles, {}))
            set_work_views(show, toggled(show.work_views, view));
        Size size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        if (!is_hidden && size.width > 0 && size.height > 0) {
            FrameInput frame = extract_frame(show, v.camera, size, between);
            if (v.lists_keys) add_key_list(show.work_views, show.overlay, frame);
            if (Result<void> done = draw_window(*show.renderer, frame); !done) return done;
            if (std::exchange(v.wants_picture, false)) {
                Result<std::string> told = save_picture(show, frame, size);
                if (!told) return told.error();
                note = {*told, glfwGetTime() + k_note_seconds};
                title_time = 0;  // at once
            }
            ++title_frames;
            if (close_after > 0 && ++drawn >= close_after) break;
        }
        if (now - title_time >= k_title_seconds) {
            show_title(window, show, note, title_frames / (now - title_time));
            title_time = now;
            title_frames = 0;
        }
    }
    return {};
}

Result<void> view(const Options& options, std::atomic<uint32_t>& messages) {
    if (Result<void> found = find_files(options.scene); !found) return found;
    GlfwSession glfw;
    auto refused = [](const std::string& what) {
        const char* why = nullptr;
        glfwGetError(&why);
        return Error{what + (why ? " (" + std::string(why) + ")" : "") +
                     ". Where there is no display, `flaneur render` writes pictures and films."};
    };
    if (!glfw.started) return refused("There is no display to open a window on");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    WindowPtr window(
        glfwCreateWindow(options.scene.size.width, options.scene.size.height, "flaneur", nullptr, nullptr));
    if (!window) return refused("The window cannot be opened");

    Result<RendererPtr> renderer = make_window_renderer(renderer_options(options, messages), window.get());
    if (!renderer) return renderer.error();
    Viewer viewer;
    viewer.choice = options.scene.camera;
    glfwSetWindowUserPointer(window.get(), &viewer);
    glfwSetKeyCallback(window.get(), on_key);
    Result<Show> show = load_show(window.get(), std::move(*renderer), options);
    if (!show) return show.error();
    viewer.walkers = show->loaded.world->crowd.count;
    return run_loop(*show, window.get(), viewer, options.close_after);
}

}  // namespace

Result<void> run_view(const Options& options) {
    std::atomic<uint32_t> messages = 0;
    Result<void> done = view(options, messages);
    return done ? check_messages(messages) : done;
}

}  // namespace flaneur
