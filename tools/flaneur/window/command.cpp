#include "tools/flaneur/window/command.h"

#include <array>
#include <string_view>

#include "tools/flaneur/options/shell_words.h"

namespace flaneur {
namespace {

// Options of one value that what is shown says anew, or that only a window has; and those without a value.
constexpr std::array<std::string_view, 6> k_replaced = {"--camera", "--view", "--size",
                                                        "--frames", "--out",  "--close-after"};
constexpr std::array<std::string_view, 1> k_of_windows = {"--start"};

Vec3 from_glm(glm::vec3 v) { return {v.x, v.y, v.z}; }

CameraChoice camera_of(const Shown& shown) {
    if (shown.choice.kind == CameraChoice::Kind::follow) return shown.choice;
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
    for (std::string& word : without_options(words, k_replaced, k_of_windows)) all.push_back(std::move(word));
    auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) all.insert(all.end(), {option, value});
    };
    add("--camera", told_camera(camera_of(shown)));
    add("--view", views_of(shown.views));
    add("--size", std::to_string(shown.size.width) + "x" + std::to_string(shown.size.height));
    add("--frames", std::to_string(shown.tick));
    add("--out", "picture.png");
    if (shown.is_transparent) all.emplace_back("--transparent");
    return shell_line(all);
}

}  // namespace flaneur
