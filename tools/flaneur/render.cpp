#include <csignal>
#include <cstdio>

#include "tools/flaneur/camera.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/output.h"
#include "tools/flaneur/show.h"

namespace flaneur {

namespace {

volatile std::sig_atomic_t interrupted = 0;

void stop_on_signals() {
    for (int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
}

Result<void> draw_all(Show& show, const Options& options, Output& output) {
    World& world = *show.loaded.world;
    const TickRange& ticks = options.ticks;
    uint32_t pictures = count(ticks);
    Camera camera;
    for (uint32_t i = 0; i < pictures; ++i) {
        uint32_t tick = ticks.first + i * ticks.step;
        while (world.tick < tick && !interrupted) {
            if (i == 0 && world.tick % 60 == 0)
                show_progress("simulating, tick " + std::to_string(world.tick));
            step(show);
        }
        if (interrupted) return Error{"Interrupted; " + options.out + " is not done."};
        show_progress("picture " + std::to_string(i + 1) + " of " + std::to_string(pictures));
        if (i == 0 || options.camera.kind == CameraChoice::Kind::follow)
            camera = choose_camera(world, show.sun, options.camera, 1);
        Result<Image> image =
            draw_image(*show.renderer, extract_frame(show, camera, options.size, 1),
                       static_cast<uint32_t>(options.size.width), static_cast<uint32_t>(options.size.height));
        if (!image) return image.error();
        Result<void> written = write_image(output, image->rgba, tick);
        if (!written) return written;
    }
    return finish_output(output);
}

Result<void> render(const Options& options, std::atomic<uint32_t>& messages) {
    Result<OutputPtr> output = open_output(options.out, options.size, options.ticks);
    if (!output) return output.error();
    Result<RendererPtr> renderer = make_renderer(renderer_options(options, messages));
    if (!renderer) return renderer.error();
    Result<Show> show = make_show(std::move(*renderer), options);
    if (!show) return show.error();
    Result<void> drawn = draw_all(*show, options, **output);
    clear_progress();
    if (drawn) std::fprintf(stderr, "Wrote %s\n", options.out.c_str());
    return drawn;
}

}  // namespace

Result<void> run_render(const Options& options) {
    stop_on_signals();
    std::atomic<uint32_t> messages = 0;
    Result<void> done = render(options, messages);
    return done ? check_messages(messages) : done;
}

}  // namespace flaneur
