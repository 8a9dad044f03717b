#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include "renderer/renderer.h"
#include "tests/renderer/synthetic_scene.h"

// renderer_picture OUT.png [street|overview] [walkers] [width height] [frames]
int main(int argc, char** argv) {
    using namespace flaneur;
    auto argument = [&](int i, const char* otherwise) { return argc > i ? argv[i] : otherwise; };
    const std::string out = argument(1, "out.png"), view = argument(2, "street");
    const int walkers = std::atoi(argument(3, "500"));
    const uint32_t width = static_cast<uint32_t>(std::atoi(argument(4, "1280")));
    const uint32_t height = static_cast<uint32_t>(std::atoi(argument(5, "720")));
    const int frames = std::atoi(argument(6, "1"));
    auto now = [] { return std::chrono::steady_clock::now(); };
    auto ms_since = [&](auto begin) {
        return std::chrono::duration<double, std::milli>(now() - begin).count();
    };

    const SyntheticScene scene = synthetic_scene(walkers);
    const auto begin = now();
    Result<RendererPtr> renderer = make_renderer({});
    if (!renderer) return std::fprintf(stderr, "%s\n", renderer.error().message.c_str()), 1;
    if (auto done = upload_scene(**renderer, scene.meshes); !done)
        return std::fprintf(stderr, "%s\n", done.error().message.c_str()), 1;
    std::printf("%s; ready after %.0f ms\n", device_name(**renderer).c_str(), ms_since(begin));
    const FrameInput frame = scene.frame(view == "street" ? street_camera() : overview_camera());
    Image image;
    std::map<std::string, double> least;
    for (int i = 0; i < frames; ++i) {
        const auto start = now();
        Result<Image> drawn = draw_image(**renderer, frame, width, height);
        if (!drawn) return std::fprintf(stderr, "%s\n", drawn.error().message.c_str()), 1;
        image = std::move(*drawn);
        const double took = ms_since(start);
        if (i == 0) std::printf("first frame %.1f ms\n", took);
        auto keep = [&](const std::string& name, double ms) {
            auto [at, is_new] = least.emplace(name, ms);
            if (ms < at->second) at->second = ms;
        };
        if (i > 0) {
            keep("whole", took);
            keep("cpu", frame_stats(**renderer).cpu_record_ms);
            for (const auto& stage : frame_stats(**renderer).stages) keep(stage.name, stage.gpu_ms);
        }
    }
    for (const auto& [name, ms] : least) std::printf("%-14s %6.2f ms\n", name.c_str(), ms);
    const FrameStats& stats = frame_stats(**renderer);
    std::printf("%u walkers, %u in shadow, %u triangles, %u sub-draws\n", stats.walkers_drawn,
                stats.walkers_in_shadow, stats.triangles, stats.sub_draws);
    return stbi_write_png(out.c_str(), static_cast<int>(width), static_cast<int>(height), 4,
                          image.rgba.data(), 0)
               ? 0
               : 1;
}
