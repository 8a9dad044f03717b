#include "assets/scene.h"

#include <algorithm>
#include <filesystem>

#include "assets/files/file.h"
#include "assets/files/json_place.h"
#include "assets/files/words.h"
#include "assets/idles.h"
#include "assets/scene/keys.h"
#include "embedded/scenes.h"

namespace flaneur {

namespace {

constexpr size_t k_most_bytes = 1 << 20;

const EmbeddedFile* built_in(const std::string& name) {
    const auto* at = std::find_if(std::begin(k_scene_files), std::end(k_scene_files),
                                  [&](const EmbeddedFile& file) { return file.name == name; });
    return at == std::end(k_scene_files) ? nullptr : at;
}

Result<std::string> scene_text(const std::string& name_or_path) {
    if (const EmbeddedFile* file = built_in(name_or_path)) return std::string(file->text);
    if (!has_ending(name_or_path, ".json"))
        return Error{"There is no scene \"" + excerpt(name_or_path) + "\"; the built-in ones are " +
                     joined(scene_names()) + ", and FILE.json is read as one."};
    Result<Bytes> bytes = read_bytes(name_or_path, k_most_bytes);
    if (!bytes) return Error{"Cannot read the scene " + name_or_path + ": it " + bytes.error().message + "."};
    return std::string(bytes->begin(), bytes->end());
}

}  // namespace

Result<Scene> parse_scene(std::string_view text, const std::string& name) {
    Scene scene;
    scene.name = name;
    std::vector<SceneFault> faults = read_scene(text, scene);
    if (faults.empty()) return scene;
    const SceneFault& first = faults.front();
    return Error{"Scene " + name + ", line " + std::to_string(first.line) + ", column " +
                 std::to_string(first.column) + ": " + first.what + "."};
}

Result<Scene> load_scene(const std::string& name_or_path) {
    Result<std::string> text = scene_text(name_or_path);
    if (!text) return text.error();
    Result<Scene> scene = parse_scene(*text, name_or_path);
    if (!scene || built_in(name_or_path)) return scene;
    std::filesystem::path path = name_or_path;
    scene->name = path.stem().string();
    auto beside = [&](std::string& other) { other = (path.parent_path() / other).string(); };
    if (!scene->city.empty()) beside(scene->city);
    if (!scene->terrain.empty()) beside(scene->terrain);
    if (!scene->rock.empty() && scene->rock != k_torus) beside(scene->rock);
    if (!scene->demand.empty()) beside(scene->demand);
    if (is_recorded(*scene)) beside(scene->trajectories);
    if (!scene->reading.geometry.empty()) beside(scene->reading.geometry);
    for (PeopleShare& people : scene->people) {
        if (!people.character.empty()) beside(people.character);
    }
    for (std::string& idle : scene->idles)
        if (!is_built_in_idle(idle)) beside(idle);
    return scene;
}

Result<std::vector<SceneFault>> check_scene(const std::string& name_or_path) {
    Result<std::string> text = scene_text(name_or_path);
    if (!text) return text.error();
    Scene scene;
    std::vector<SceneFault> faults = read_scene(*text, scene);
    const CameraChoice& camera = scene.camera;
    const bool is_of_walker =
        camera.kind == CameraChoice::Kind::follow || camera.kind == CameraChoice::Kind::eyes;
    if (faults.empty() && is_of_walker &&
        camera.walker >= static_cast<uint32_t>(scene.walkers + scene.creatures)) {
        JsonPlace place = place_in_json(*text, {"camera"}, false);
        faults.push_back({place.line, place.column,
                          "\"camera\" follows nobody: walkers are numbered from 0, and there are " +
                              std::to_string(scene.walkers)});
    }
    return faults;
}

Scene scene_of_trajectories(const std::string& path) {
    Scene scene;
    scene.name = std::filesystem::path(path).stem().string();
    scene.trajectories = path;
    scene.walkers = 0;
    scene.camera.kind = CameraChoice::Kind::overview;
    return scene;
}

Result<Vec2> parse_origin(const std::string& text) {
    constexpr float k_most = 1e8f;
    const std::vector<std::string_view> parts = split(text, ',');
    Vec2 origin;
    if (parts.size() == 2 && parse_number(parts[0], origin.x) && parse_number(parts[1], origin.z) &&
        std::fabs(origin.x) <= k_most && std::fabs(origin.z) <= k_most)
        return origin;
    return Error{excerpt(text) + " is no place EAST,NORTH, such as 120,-40"};
}

std::vector<std::string> scene_names() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : k_scene_files) names.emplace_back(file.name);
    // Files are in the order of their names with endings.
    std::ranges::sort(names);
    return names;
}

}  // namespace flaneur
