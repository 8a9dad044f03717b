#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/zone.h"
#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/bench/paces.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/recording/check.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/ask/find.h"
#include "tools/flaneur/window/ask/gait.h"
#include "tools/flaneur/window/ask/techniques.h"
#include "tools/flaneur/window/asked.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/change/hand.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/command.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/kept/kept.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/navigate.h"
#include "tools/flaneur/window/open/open.h"
#include "tools/flaneur/window/open/pictures.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/record/capture.h"
#include "tools/flaneur/window/record/present.h"
#include "tools/flaneur/window/record/record.h"
#include "tools/flaneur/window/settings/settings.h"

namespace flaneur {

namespace {

constexpr double k_title_seconds = 0.5;
constexpr double k_idle_seconds = 0.1;  // between looks at the keys while nothing is drawn
// What passes at most from one picture to the next: for the clock, which says how far it is behind, and for
// what moves by itself. Where more did, the process or the machine was halted, and all goes on from there.
constexpr double k_longest_pause = 5, k_longest_move = 1;

struct WindowDelete {
    void operator()(GLFWwindow* window) const { glfwDestroyWindow(window); }
};
using WindowPtr = std::unique_ptr<GLFWwindow, WindowDelete>;

struct GlfwSession {
    bool started = glfwInit() == GLFW_TRUE;
    ~GlfwSession() { glfwTerminate(); }
};

void show_title(GLFWwindow* window, const Show& show, double fps) {
    char figures[256];
    std::snprintf(figures, sizeof figures, "flaneur - %.0f fps - %u walkers - %s", fps,
                  static_cast<uint32_t>(walkers(*show.loaded.world).size()),
                  device_name(*show.renderer).c_str());
    glfwSetWindowTitle(window, figures);
}

constexpr int k_most_lost = 5;  // devices, in the life of a window

// What a renderer of the window is made with.
struct Canvas {
    GLFWwindow* window;
    Gui& gui;
    Options options;  // as they hold for the renderer that there is
    std::atomic<uint32_t>& messages;
};

// Another takes the renderer's place, with the letters of the panels.
Result<void> remake_renderer(RendererPtr& renderer, const Canvas& canvas) {
    renderer.reset();
    Result<RendererPtr> anew =
        make_window_renderer(renderer_options(canvas.options, canvas.messages), canvas.window);
    if (!anew) return anew.error();
    renderer = std::move(*anew);
    return hand_letters(canvas.gui, *renderer);
}

// Does `act`; whenever that fails because a device was lost, says so and does act(true) with one made anew.
template <class Act>
Result<void> outlive_devices(RendererPtr& renderer, const Canvas& canvas, Act act) {
    Result<void> done = act(false);
    for (int lost = 0; !done && lost < k_most_lost && renderer && has_lost_device(*renderer); ++lost) {
        say(done.error().message);
        done = remake_renderer(renderer, canvas);
        if (done) done = act(true);
    }
    return done;
}

// Hands what is shown to a renderer that was made anew.
Result<void> show_again(Show& show, Viewer& v) {
    if (Result<void> uploaded = upload_again(show); !uploaded) return uploaded;
    if (v.time.beside && v.time.beside->city) v.time.beside.reset();  // not held any more
    return {};
}

// From now on pictures are of the quality that is wanted.
Result<void> change_quality(Show& show, Canvas& canvas, Viewer& v) {
    canvas.options.scene.quality = v.quality;
    if (Result<void> done = remake_renderer(show.renderer, canvas); !done) return done;
    if (Result<void> done = show_again(show, v); !done) return done;
    const bool is_apart = v.costs.is_apart;
    v.costs = {};
    v.costs.is_apart = is_apart;
    tell(v, "Drawn in " + quality_name(*show.renderer) + " quality.");
    return {};
}

// Loads on a thread of its own, while the window says how far that is, and closes at once.
Result<Show> load_show(const Canvas& canvas, RendererPtr renderer, const Options& options,
                       const Viewer& viewer) {
    GLFWwindow* window = canvas.window;
    Gui& gui = canvas.gui;
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
        begin_gui(gui, window, {});
        lay_out_loading(city_name(options.scene), line, "Esc closes", size, gui.scale);
        frame.panels = end_gui(gui);
        Result<void> drawn = draw_window(*renderer, frame);
        if (!drawn) {
            say(drawn.error().message);
            if (has_lost_device(*renderer)) drawn = remake_renderer(renderer, canvas);
            if (!drawn) end_now(1);
        }
    }
    Result<PreparedShow> prepared = loading.get();
    if (!prepared) return prepared.error();
    Show show;
    show.renderer = std::move(renderer);
    Result<void> uploaded = outlive_devices(
        show.renderer, canvas, [&](bool) { return upload_show(show, *prepared, options.scene.views); });
    if (!uploaded) return uploaded.error();
    return show;
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

// That of what is shown, which `command_for` writes.
void copy_command(GLFWwindow* window, const Show& show, Viewer& v, Size size,
                  std::string command_for(const Show&, const Viewer&, Size)) {
    const std::string none = why_no_command(v, *show.loaded.world);
    if (!none.empty()) return tell(v, none);
    const std::string command = command_for(show, v, size);
    glfwSetClipboardString(window, command.c_str());
    say(command);
    tell(v, (v.change.late > 0 ? k_told_otherwise : "Copied: ") + printable(command));
}

// Into the window: one picture, or two side by side.
Result<void> draw_runs(Show& show, Viewer& v, const FrameInput& frame, Size size, float between) {
    if (!has_two(v)) return draw_window(*show.renderer, frame);
    Result<Image> both = draw_side_by_side(show, v, frame, size, between);
    if (!both) return both.error();
    return show_image(*show.renderer, *both, frame.panels);
}

// Of the window's time.
void rest_until(double then) {
    FLANEUR_ZONE("rest");
    const double left = then - glfwGetTime();
    if (left > 0) std::this_thread::sleep_for(std::chrono::duration<double>(left));
}

// Until the window is closed, or `paces`, if there are some, are over.
Result<void> run_loop(Show& show, Canvas& canvas, Viewer& v, Paces* paces) {
    GLFWwindow* window = canvas.window;
    Gui& gui = canvas.gui;
    double last = glfwGetTime(), title_time = last, moved_at = last, picture_seconds = 0;
    uint32_t drawn = 0, title_frames = 0;
    Mouse mouse;
    Grip grip;
    double shift = 0;  // pixels that the run under the cursor lies to the right
    while (!v.wants_close && !glfwWindowShouldClose(window)) {
        if (is_stopping()) return interrupted("the window is closed");
        FLANEUR_ZONE("frame");
        const bool is_hidden = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
        {
            FLANEUR_ZONE("events");
            if (is_hidden)
                glfwWaitEventsTimeout(k_idle_seconds);
            else
                glfwPollEvents();
        }
        if (v.quality != canvas.options.scene.quality) {
            FLANEUR_ZONE("quality");
            if (Result<void> done = change_quality(show, canvas, v); !done) return done;
            last = glfwGetTime();
        }
        const double now = glfwGetTime();
        const double passed = is_hidden && v.record.filming
                                  ? 0
                                  : seconds_to_pass(v.record, std::min(now - last, k_longest_pause));
        if (v.record.filming) v.record.filming->began += std::max(now - last - k_longest_pause, 0.0);
        last = now;
        begin_picture(v.costs, now);
        go_on_opening(show, v);
        take_people_anew(show, v);
        act_on_presses(show, v);
        if (Result<void> done = carry_on(show, v); !done) return done;
        end_part(v.costs, CostOf::asked, glfwGetTime());
        steer_driven(window, show, v);
        v.time.is_led = is_driving(show) || is_led_by_pointer(show);
        const bool is_going = go_on(show, v, now);
        if (!is_going && !waits_for_beside(v, *show.loaded.world))
            for (uint32_t ticks = ticks_due(v.clock, passed); ticks > 0; --ticks, ++v.costs.now.ticks)
                make_tick(show, v);
        keep_up_beside(show, v);
        follow_switches(v.techniques, show);
        end_part(v.costs, CostOf::ticks, glfwGetTime());
        const World& world = *show.loaded.world;
        v.measure.counts.shown = std::min(world.tick, v.measure.counts.tick);
        const float between = is_going ? 1 : between_pictures(v.record, v.clock);

        take_events(v.events.mouse, v.events.pointer);
        const bool is_on = v.presentation.is_on || is_on_panel(v.events.pointer.x, v.events.pointer.y);
        const Mouse before = mouse;
        read_mouse(v.events.pointer, is_on, mouse);
        const bool is_panels = is_of_panels(before, mouse, is_on);
        Size size;
        glfwGetFramebufferSize(window, &size.width, &size.height);
        const Size one = size_of_one(v, size);
        if (!mouse.is_held && !mouse.pans && !mouse.orbits)
            shift = mouse.x > one.width ? size.width - one.width : 0;
        Mouse was = before, here = mouse;
        was.x -= shift, here.x -= shift;
        // What is drawn with takes the left button.
        Mouse free = here;
        const bool is_elsewhere = is_panels || shift > 0;
        follow_pointer(show, here, one, is_elsewhere, v);
        const bool is_taken = draw_with_mouse(show, was, here, one, is_elsewhere, v) ||
                              take_mouse(show, was, here, one, is_elsewhere, v) ||
                              drag_target(show, was, here, one, is_elsewhere || is_putting(v), v) ||
                              is_driving(show);
        if (is_taken) free.is_held = free.has_clicked = false;
        const auto seconds = static_cast<float>(std::min(passed, k_longest_move));
        Steering hands = steering_of(window, was, free, v) + read_pad(window, seconds, v);
        if (paces) hands = lead(*paces, v);
        bool is_moving = navigate(world, was, free, gui_wheel(v.settings.inverts_wheel), one, grip, v);
        is_moving |= !is_driving(show) && steer(show, hands, seconds, v);
        is_moving |= move_camera(show, one, seconds, between, v);
        go_on_presenting(show, v, static_cast<double>(seconds));
        for (WorkView view : std::exchange(v.toggles, {}))
            set_work_views(show, toggled(show.work_views, view));
        if (!is_hidden && size.width > 0 && size.height > 0) {
            choose_resolution(v, now, is_moving, picture_seconds, moved_at);
            show.overlay.letters_legends = true;
            if (Result<void> done = take_pictures(show, v, size, between); !done) return done;
            show.overlay.letters_legends = !v.has_panels;
            FrameInput frame = extract_frame(show, v.camera, one, between);
            frame.companion = companion_of(v.choice);
            if (std::exchange(v.wants_command, false)) copy_command(window, show, v, size, command_now);
            if (std::exchange(v.wants_bench_command, false))
                copy_command(window, show, v, size, bench_command_now);
            ask(show, free, one, is_elsewhere || is_taken || is_putting(v), v);
            find_people(show, v);
            mark_asked(v, show, frame);
            mark_path(v, show, frame);
            mark_found(show, v, frame);
            mark_gait(show, v, frame);
            mark_measures(show, v, frame);
            mark_changes(v, show, frame);
            mark_targets(v, show, frame);
            end_part(v.costs, CostOf::people, glfwGetTime());
            if (Result<void> done =
                    suit_gui(gui, window, *show.renderer, v.settings.letters, v.settings.is_light);
                !done)
                return done;
            v.opening.pictures = gui.boxes;
            begin_gui(gui, window, gui_input(window, v));
            lay_out_panels(show, v, size, gui.scale);
            frame.panels = end_gui(gui);
            keep_what_is_kept(v);
            if (Result<void> done = take_picture_with_panels(show, v, frame, size); !done) return done;
            frame.resolution = v.resolution;
            frame.times_passes = v.room == Room::frame && v.costs.is_apart;
            const double start = glfwGetTime();
            end_part(v.costs, CostOf::panels, start);
            const bool is_captured = begin_asked_capture(show, v);
            const Result<void> drawn_now = draw_runs(show, v, frame, size, between);
            if (is_captured) end_asked_capture(show, v);
            if (!drawn_now) return drawn_now;
            end_part(v.costs, CostOf::draw, glfwGetTime());
            end_picture(v.costs, frame_stats(*show.renderer), frame.times_passes);
            if (v.resolution == 1) picture_seconds = glfwGetTime() - start;
            ++title_frames;
            if (paces) {
                note_picture(*paces, glfwGetTime() - now, v.resolution);
                if (are_over(*paces)) break;
            }
            if (const uint32_t most = canvas.options.close_after; most > 0 && ++drawn >= most) break;
        }
        if (v.settings.fps > 0 && !v.record.filming) rest_until(now + 1.0 / v.settings.fps);
        if (now - title_time >= k_title_seconds) {
            v.fps = title_frames / (now - title_time);
            show_title(window, show, v.fps);
            title_time = now;
            title_frames = 0;
        }
    }
    return {};
}

Result<void> view(const Options& options, std::atomic<uint32_t>& messages, Paces* paces) {
    if (Result<void> found = find_files(options.scene); !found) return found;
    if (Result<void> allowed = check_record(options); !allowed) return allowed;
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
    begin_cameras(options.scene, viewer);
    begin_opening(options, viewer.opening);
    viewer.techniques.on = options.techniques;
    viewer.quality = options.scene.quality;
    Result<Settings> settings = read_settings(settings_file());
    if (!settings) say(settings.error().message);
    if (settings) viewer.settings = viewer.kept_settings = *settings;
    if (paces) viewer.settings.fps = 0;  // as fast as it goes
    listen(window.get(), viewer);
    Result<GuiPtr> gui = make_gui(window.get(), **renderer, viewer.settings.letters, scene_pictures());
    if (!gui) return gui.error();
    Canvas canvas{window.get(), **gui, options, messages};
    Result<Show> show = load_show(canvas, std::move(*renderer), options, viewer);
    if (!show) return show.error();
    viewer.is_loading = false;
    if (!settings) tell(viewer, printable(settings.error().message));
    start_changes(options, *show, viewer);
    begin_run(viewer.time, *show->loaded.world);
    if (show->playing) viewer.time.latest = show->playing->last;
    Result<TakingPtr> taking = begin_taking(options, *show->loaded.world);
    if (!taking) return taking.error();
    show->taking = std::move(*taking);
    if (paces)
        add_setting(paces->figures, options, *show->loaded.world);
    else
        recall(*show, viewer);
    Result<void> done = outlive_devices(show->renderer, canvas, [&](bool is_anew) -> Result<void> {
        if (is_anew) {
            if (Result<void> uploaded = show_again(*show, viewer); !uploaded) return uploaded;
            tell(viewer, "The graphics device was lost. A new one has taken over.");
        }
        return run_loop(*show, canvas, viewer, paces);
    });
    end_film(viewer);
    viewer.time.anew.reset();  // they are made of the show
    Result<void> recorded = finish_taking(std::move(show->taking));
    if (done && !recorded) return recorded;
    if (done && is_opening(viewer.opening)) end_now(0);  // nobody waits for what is being loaded
    return done;
}

}  // namespace

Result<void> run_view(const Options& options) {
    std::atomic<uint32_t> messages = 0;
    Result<void> done = view(options, messages, nullptr);
    return done ? check_messages(messages) : done;
}

Result<Figures> bench_window(const Options& options) {
    std::atomic<uint32_t> messages = 0;
    Paces paces;
    paces.pictures = options.bench_frames;
    Result<void> done = view(options, messages, &paces);
    if (done) done = check_messages(messages);
    if (!done) return done.error();
    if (!are_over(paces)) return Error{"The window was closed before all was measured."};
    return paces.figures;
}

}  // namespace flaneur
