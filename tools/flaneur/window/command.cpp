#include "tools/flaneur/window/command.h"

#include <array>
#include <span>
#include <string_view>

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
constexpr std::array<std::string_view, 13> k_of_scene = {
    "--scene",     "--city", "--center",  "--radius", "--terrain", "--scale",  "--seed",
    "--character", "--idle", "--walkers", "--time",   "--weather", "--quality"};
constexpr std::array<std::string_view, 1> k_of_windows = {"--start"};

std::vector<std::string_view> replaced_by(const Shown& shown) {
    std::vector<std::string_view> all(k_replaced.begin(), k_replaced.end());
    if (!shown.scene.empty()) all.insert(all.end(), k_of_scene.begin(), k_of_scene.end());
    if (shown.is_overcast) all.emplace_back("--weather");
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

}  // namespace

std::string command_of(const std::vector<std::string>& words, const Shown& shown) {
    std::vector<std::string> all = {"flaneur", "render"};
    for (std::string& word : without_options(words, replaced_by(shown), k_of_windows))
        all.push_back(std::move(word));
    auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) all.insert(all.end(), {option, value});
    };
    add("--scene", shown.scene);
    if (shown.is_overcast) add("--weather", *shown.is_overcast ? "overcast" : "clear");
    add("--camera", told_camera(camera_of(shown)));
    const bool has_lens = shown.choice.kind != CameraChoice::Kind::map &&
                          (shown.has_lens || shown.camera.vertical_fov != k_fov);
    add("--fov", has_lens ? told_fov(shown.camera.vertical_fov) : "");
    add("--view", views_of(shown.views));
    add("--without", told_without(shown.techniques));
    add("--size", std::to_string(shown.size.width) + "x" + std::to_string(shown.size.height));
    add("--frames", std::to_string(shown.tick));
    add("--out", "picture.png");
    if (shown.is_transparent) all.emplace_back("--transparent");
    return shell_line(all);
}

std::string why_no_command(const Viewer& v, const World& world) {
    if (v.time.beside) return "No command draws two runs side by side.";
    if (v.techniques.is_split) return "No command draws before and after side by side; Shift+J ends that.";
    if (world.seed == v.time.first_seed) return "";
    return "No command draws this: its people are of another seed than the city's own, " +
           std::to_string(*v.time.first_seed) + ".";
}

std::string command_now(const Show& show, const Viewer& v, Size size) {
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
    if (v.change.scene.is_overcast != show.is_overcast) shown.is_overcast = show.is_overcast;
    const std::vector<std::string>& words = v.opening.words;
    if (is_as_opened(v.change)) return command_of(words, shown);
    const std::string path = "out/view-" + std::to_string(shown.tick) + ".json";
    const Result<std::string> saved = save_scene(show, v, path);
    if (!saved) {
        say(saved.error().message);
        return command_of(words, shown);
    }
    shown.scene = path;
    // Who is gone along with is somewhere else there.
    if (shown.choice.kind != CameraChoice::Kind::map) shown.choice.kind = CameraChoice::Kind::fixed;
    shown.is_overcast.reset();
    return command_of(words, shown) + (v.change.late > 0 ? "  # changed while people walked" : "");
}

}  // namespace flaneur
