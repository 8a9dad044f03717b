#include "tools/flaneur/window/command.h"

#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "renderer/renderer.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/options/shell_words.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/save.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

// Options of one value that what is shown says anew, or that only a window has; those that a scene's file
// holds; and those without a value.
constexpr std::array<std::string_view, 8> k_replaced = {"--camera", "--fov",    "--view", "--without",
                                                        "--size",   "--frames", "--out",  "--close-after"};
constexpr std::array<std::string_view, 14> k_of_scene = {
    "--scene",     "--city", "--center",  "--radius", "--terrain", "--scale",   "--seed",
    "--character", "--idle", "--walkers", "--time",   "--weather", "--quality", "--side"};
constexpr std::array<std::string_view, 1> k_of_windows = {"--start"};

std::vector<std::string_view> replaced_by(const Shown& shown) {
    std::vector<std::string_view> all(k_replaced.begin(), k_replaced.end());
    if (!shown.scene.empty()) all.insert(all.end(), k_of_scene.begin(), k_of_scene.end());
    if (shown.is_overcast) all.emplace_back("--weather");
    if (!shown.quality.empty()) all.emplace_back("--quality");
    return all;
}

Vec3 from_glm(glm::vec3 v) { return {v.x, v.y, v.z}; }

CameraChoice camera_of(const Shown& shown) {
    if (shown.choice.kind == CameraChoice::Kind::map) return shown.choice;
    return {CameraChoice::Kind::fixed, 0, from_glm(shown.camera.eye), from_glm(shown.camera.target)};
}

std::string views_of(WorkViews views) {
    std::string text;
    for (const std::string& view : names_of(views)) text.append(text.empty() ? "" : ",").append(view);
    return text;
}

struct Line {
    std::vector<std::string> words;

    void add(const char* option, const std::string& value) {
        if (!value.empty()) words.insert(words.end(), {option, value});
    }
};

// A command of the words that opened the window, seen as it is shown.
Line line_of(std::vector<std::string> command, const std::vector<std::string>& words, const Shown& shown) {
    Line line{std::move(command)};
    for (std::string& word : without_options(words, replaced_by(shown), k_of_windows))
        line.words.push_back(std::move(word));
    line.add("--scene", shown.scene);
    if (shown.is_overcast) line.add("--weather", *shown.is_overcast ? "overcast" : "clear");
    line.add("--quality", shown.quality);
    line.add("--camera", told_camera(camera_of(shown)));
    const bool has_lens = shown.choice.kind != CameraChoice::Kind::map &&
                          (shown.has_lens || shown.camera.vertical_fov != k_fov);
    line.add("--fov", has_lens ? told_fov(shown.camera.vertical_fov) : "");
    line.add("--size", std::to_string(shown.size.width) + "x" + std::to_string(shown.size.height));
    return line;
}

Shown shown_now(const Show& show, const Viewer& v, Size size) {
    Shown shown{v.choice,
                v.camera,
                show.work_views,
                size,
                show.loaded.world->tick,
                v.record.picture.is_transparent,
                v.cameras.has_lens,
                {},
                {}};
    shown.techniques = show.without.on;
    shown.limbs = v.change.scene.limbs;
    if (v.change.scene.is_overcast != show.is_overcast) shown.is_overcast = show.is_overcast;
    if (v.change.scene.quality != v.quality) shown.quality = quality_name(*show.renderer);
    return shown;
}

// Where the city has been changed: names the scene that says all of it, once that is written.
void write_changed(const Show& show, const Viewer& v, Shown& shown) {
    if (is_as_opened(v.change)) return;
    const std::string path = "out/view-" + std::to_string(shown.tick) + ".json";
    const Result<std::string> saved = save_scene(show, v, path);
    if (!saved) return say(saved.error().message);
    shown.scene = path;
    // Who is gone along with is somewhere else there.
    if (shown.choice.kind != CameraChoice::Kind::map) shown.choice.kind = CameraChoice::Kind::fixed;
    shown.is_overcast.reset();
    shown.quality.clear();
}

}  // namespace

std::string command_of(const std::vector<std::string>& words, const Shown& shown) {
    Line line = line_of({"flaneur", "render"}, words, shown);
    line.add("--view", views_of(shown.views));
    line.add("--without", told_without(shown.techniques, shown.limbs));
    line.add("--frames", std::to_string(shown.tick));
    line.add("--out", "picture.png");
    if (shown.is_transparent) line.words.emplace_back("--transparent");
    return shell_line(line.words);
}

std::string bench_command_of(const std::vector<std::string>& words, const Shown& shown) {
    Line line = line_of({"flaneur", "bench", "frame"}, words, shown);
    line.add("--warm-up", std::to_string(shown.tick));
    return shell_line(line.words);
}

std::string why_no_command(const Viewer& v, const World& world) {
    if (v.time.beside) return "No command draws two runs side by side.";
    if (v.techniques.is_split) return "No command draws before and after side by side; Shift+J ends that.";
    if (world.seed == v.time.first_seed) return "";
    return "No command draws this: its people are of another seed than the city's own, " +
           std::to_string(*v.time.first_seed) + ".";
}

std::string command_now(const Show& show, const Viewer& v, Size size) {
    Shown shown = shown_now(show, v, size);
    write_changed(show, v, shown);
    const bool is_otherwise = !shown.scene.empty() && v.change.late > 0;
    return command_of(v.opening.words, shown) + (is_otherwise ? "  # changed while people walked" : "");
}

std::string bench_command_now(const Show& show, const Viewer& v, Size size) {
    Shown shown = shown_now(show, v, size);
    write_changed(show, v, shown);
    return bench_command_of(v.opening.words, shown);
}

}  // namespace flaneur
