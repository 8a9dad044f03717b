#include "tools/flaneur/window/command.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>

namespace flaneur {
namespace {

// Options of one value that what is shown says anew, or that only a window has.
constexpr std::array k_replaced = {"--camera", "--view", "--size", "--frames", "--out", "--close-after"};
// And those that a scene's file holds.
constexpr std::array k_of_scene = {"--scene", "--city",    "--center",    "--radius", "--terrain",
                                   "--scale", "--seed",    "--character", "--idle",   "--walkers",
                                   "--time",  "--weather", "--quality"};

bool is_one_of(std::span<const char* const> options, std::string_view option) {
    return std::find(options.begin(), options.end(), option) != options.end();
}

bool is_replaced(std::string_view option, const Shown& shown) {
    if (shown.is_overcast && option == "--weather") return true;
    return is_one_of(k_replaced, option) || (!shown.scene.empty() && is_one_of(k_of_scene, option));
}

std::string quoted(const std::string& word) {
    auto is_plain = [](unsigned char c) {
        return std::isalnum(c) ||
               std::string_view("_-./,:=+@%").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
    std::string out(1, '\'');
    for (const char c : word) {
        if (c == '\'')
            out.append("'\\''");
        else
            out.push_back(c);
    }
    out.push_back('\'');
    return out;
}

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
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string_view option = std::string_view(words[i]).substr(0, words[i].find('='));
        if (!is_replaced(option, shown))
            all.push_back(words[i]);
        else if (option.size() == words[i].size())
            ++i;  // and its value
    }
    auto add = [&](const char* option, const std::string& value) {
        if (!value.empty()) all.insert(all.end(), {option, value});
    };
    add("--scene", shown.scene);
    if (shown.is_overcast) add("--weather", *shown.is_overcast ? "overcast" : "clear");
    add("--camera", told_camera(camera_of(shown)));
    add("--view", views_of(shown.views));
    add("--size", std::to_string(shown.size.width) + "x" + std::to_string(shown.size.height));
    add("--frames", std::to_string(shown.tick));
    add("--out", "picture.png");
    std::string text;
    for (const std::string& word : all) text.append(text.empty() ? "" : " ").append(quoted(word));
    return text;
}

}  // namespace flaneur
