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
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/asked.h"
#include "tools/flaneur/window/command.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/navigate.h"
#include "tools/flaneur/window/panels.h"

namespace flaneur {

namespace {

constexpr double k_title_seconds = 0.5;
constexpr double k_idle_seconds = 0.1;  // between looks at the keys while nothing is drawn

struct WindowDelete {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowPtr = std::unique_ptr<GLFWwindow, WindowDelete>;

struct GlfwSession {
    bool started = glfwInit() == GLFW_TRUE;
    ~GlfwSession() { glfwTerminate(); }
};

// Of the tick, and of no picture that is there.
std::string picture_path(uint32_t tick) {
    std::string stem = "out/view-" + std::to_string(tick), path = stem + ".png";
    std::error_code ignored;
    for (int number = 2; std::filesystem::exists(path, ignored); ++number)
        path = stem + "-" + std::to_string(number) + ".png";
    return path;
}

// Fails only with the device; tells whether the picture could be written.
Result<std::string> save_picture(Show& show, Viewer& v, const FrameInput& frame, Size size, float between,
                                 const std::string& command) {
    Result<Image> image = v.time.beside ? draw_side_by_side(show, v, frame, size, between)
                                        : draw_image(*show.renderer, frame, static_cast<uint32_t>(size.width),
                                                     static_cast<uint32_t>(size.height));
    if (!image) return image.error();
    std::string path = picture_path(show.loaded.world->tick);
    Result<PartFilePtr> file = open_file(path);
    Result<void> written = file ? write_png(std::move(*file), image->rgba, size, command) : file.error();
    std::string told = written ? "Wrote " + path : written.error().message;
    say(told);
    return told;
}

void show_title(GLFWwindow* window, const Show& show, double fps) {
    char figures[256];
    std::snprintf(figures, sizeof figures, "flaneur - %.0f fps - %u walkers - %s", fps,
                  show.loaded.world->crowd.count, device_name(*show.renderer).c_str());
    glfwSetWindowTitle(window, figures);
}

// Loads on a thread of its own, while the window says how far that is, and closes at once.
Result<Show> load_show(GLFWwindow* window, Gui& gui, RendererPtr renderer, const Options& options,
                       const Viewer& viewer) {
    say_device(*renderer);
    auto loading = std::async(std::launch::async, [&] { return prepare_show(options); });
    while (loading.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
        glfwWaitEventsTimeout(k_idle_seconds);
        if (viewer.wants_close || glfwWindowShouldClose(window)) end_now(0);
        const std::string line = printable(progress_line());
        glfwSetWindowTitle(window, ("flaneur: " + line).c_str());
        Size size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        if (size.width <= 0 || size.height <= 0) continue;
        FrameInput frame;
        begin_gui(gui);
        lay_out_loading(city_name(options.scene), line, size);
        frame.panels = end_gui(gui);
        if (Result<void> drawn = draw_window(*renderer, frame); !drawn) {
            say(drawn.error().message);
            end_now(1);
        }
    }
    Result<PreparedShow> prepared = loading.get();
    if (!prepared) return prepared.error();
    return upload_show(std::move(renderer), std::move(*prepared), options.scene.views);
}

// What a CPU draws while the eye moves is coarser, if whole pictures take too long; sharp once it rests.
constexpr double k_slow_fps = 24, k_rest_seconds = 0.25;
constexpr float k_coarse = 0.6f;

// Decides about the next picture's resolution.
void choose_resolution(Viewer& v, double now, bool is_moving, double picture_seconds, double& moved_at) {
    if (is_moving) moved_at = now;
    const bool rests = now - moved_at > k_rest_seconds;
    if (rests)
        v.resolution = 1;
    else if (v.resolution == 1 && picture_seconds > 1 / k_slow_fps)
        v.resolution = k_coarse;
}

// Into the window: this run, or two side by side.
Result<void> draw_runs(Show& show, Viewer& v, const FrameInput& frame, Size size, float between) {
    if (!v.time.beside) return draw_window(*show.renderer, frame);
    Result<Image> both = draw_side_by_side(show, v, frame, size, between);
    if (!both) return both.error();
    return show_image(*show.renderer, *both, frame.panels);
}

// Why none is copied; "": one is.
std::string why_no_command(const Viewer& v, const World& world) {
    if (v.time.beside) return "No command draws two runs side by side.";
    if (world.seed == v.time.first_seed) return "";
    return "No command draws this: its people are of another seed than the city's own, " +
           std::to_string(*v.time.first_seed) + ".";
}

Result<void> run_loop(Show& show, GLFWwindow* window, Gui& gui, Viewer& v,
                      const std::vector<std::string>& words, uint32_t close_after) {
    begin_run(v.time, *show.loaded.world);
    double last = glfwGetTime(), title_time = last, moved_at = last, picture_seconds = 0;
    uint32_t drawn = 0, title_frames = 0;
    Mouse mouse;
    Grip grip;
    double shift = 0;  // pixels that the run under the cursor lies to the right
    while (!v.wants_close && !glfwWindowShouldClose(window)) {
        if (is_stopping()) return interrupted("the window is closed");
        const bool is_hidden = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
        if (is_hidden)
            glfwWaitEventsTimeout(k_idle_seconds);
        else
            glfwPollEvents();
        const double now = glfwGetTime(), passed = now - last;
        last = now;
        take_people_anew(show, v);
        act_on_presses(show, v);
        const bool is_going = go_on(show, v, now);
        if (!is_going)
            for (uint32_t ticks = ticks_due(v.clock, passed); ticks > 0; --ticks) make_tick(show, v);
        keep_up_beside(show, v);
        const World& world = *show.loaded.world;
        const float between = is_going ? 1 : between_ticks(v.clock);

        const bool is_following = v.choice.kind == CameraChoice::Kind::follow;
        if (is_following || !v.chosen) {
            v.camera = choose_camera(*show.loaded.city, world, show.sun, v.choice, between);
            v.chosen = true;
        }
        const bool is_panels = gui_has_mouse();
        const Mouse before = mouse;
        read_mouse(window, is_panels, mouse);
        Size size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        bool is_moving = fly(window, before, mouse, static_cast<float>(passed), v);
        const Size one = size_of_one(v, size);
        if (!mouse.is_held && !mouse.pans && !mouse.orbits)
            shift = mouse.x > one.width ? size.width - one.width : 0;
        Mouse was = before, here = mouse;
        was.x -= shift, here.x -= shift;
        is_moving |= navigate(world, was, here, gui_wheel(), one, grip, v);
        is_moving |= is_following && !v.clock.is_paused;
        for (WorkView view : std::exchange(v.toggles, {}))
            set_work_views(show, toggled(show.work_views, view));
        if (!is_hidden && size.width > 0 && size.height > 0) {
            choose_resolution(v, now, is_moving, picture_seconds, moved_at);
            auto extract = [&] {
                FrameInput frame = extract_frame(show, v.camera, one, between);
                frame.companion = companion_of(v.choice);
                return frame;
            };
            FrameInput frame = extract();
            const std::string none = why_no_command(v, world);
            const std::string command =
                none.empty() && (v.wants_picture || v.wants_command)
                    ? command_of(words, {v.choice, v.camera, show.work_views, size, world.tick})
                    : std::string();
            if (std::exchange(v.wants_picture, false)) {
                // Legends stand where they do without panels.
                const float foot = std::exchange(show.overlay.legend_foot, 0.0f);
                Result<std::string> told = save_picture(show, v, extract(), size, between, command);
                if (!told) return told.error();
                show.overlay.legend_foot = foot;
                frame = extract();
                tell(v, printable(*told));
            }
            if (!none.empty() && std::exchange(v.wants_command, false)) tell(v, none);
            if (std::exchange(v.wants_command, false)) {
                glfwSetClipboardString(window, command.c_str());
                say(command);
                tell(v, "Copied: " + printable(command));
            }
            ask(show, here, one, is_panels || shift > 0, v);
            mark_asked(v, show, frame);
            begin_gui(gui);
            lay_out_panels(show, v, size, gui.scale);
            frame.panels = end_gui(gui);
            frame.resolution = v.resolution;
            const double start = glfwGetTime();
            if (Result<void> done = draw_runs(show, v, frame, size, between); !done) return done;
            if (v.resolution == 1) picture_seconds = glfwGetTime() - start;
            ++title_frames;
            if (close_after > 0 && ++drawn >= close_after) break;
        }
        if (now - title_time >= k_title_seconds) {
            v.fps = title_frames / (now - title_time);
            show_title(window, show, v.fps);
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
    listen(window.get(), viewer);
    Result<GuiPtr> gui = make_gui(window.get(), **renderer, 0);
    if (!gui) return gui.error();
    Result<Show> show = load_show(window.get(), **gui, std::move(*renderer), options, viewer);
    if (!show) return show.error();
    viewer.is_loading = false;
    viewer.walkers = show->loaded.world->crowd.count;
    Result<void> done = run_loop(*show, window.get(), **gui, viewer, options.words, options.close_after);
    viewer.time.anew.reset();  // they are made of the show
    return done;
}

}  // namespace

Result<void> run_view(const Options& options) {
    std::atomic<uint32_t> messages = 0;
    Result<void> done = view(options, messages);
    return done ? check_messages(messages) : done;
}

}  // namespace flaneur
