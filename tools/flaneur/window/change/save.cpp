#include "tools/flaneur/window/change/save.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "assets/files/file.h"
#include "assets/idles.h"
#include "sim/alongside/alongside.h"
#include "sim/pastimes/pastimes.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

namespace {

namespace fs = std::filesystem;

// Of a file beside the working folder, as another folder's files name it.
std::string from_folder(const std::string& path, const std::string& folder) {
    if (path.empty()) return path;
    std::error_code failed;
    const fs::path there = fs::absolute(path, failed),
                   here = fs::absolute(folder.empty() ? "." : folder, failed);
    fs::path way = there.lexically_normal().lexically_relative(here.lexically_normal());
    return way.empty() ? there.string() : way.string();
}

// An idle is FILE or FILE:CLIP, which both begin with the file.
void move_paths(Scene& s, const std::string& folder) {
    s.city = from_folder(s.city, folder);
    s.terrain = from_folder(s.terrain, folder);
    s.demand = from_folder(s.demand, folder);
    if (s.rock != k_torus) s.rock = from_folder(s.rock, folder);
    for (PeopleShare& people : s.people) people.character = from_folder(people.character, folder);
    for (std::string& idle : s.idles)
        if (!is_built_in_idle(idle)) idle = from_folder(idle, folder);
}

CameraChoice camera_of(const Viewer& v) {
    if (v.choice.kind == CameraChoice::Kind::follow) return v.choice;
    const Camera& c = v.camera;
    return {CameraChoice::Kind::fixed, 0, {c.eye.x, c.eye.y, c.eye.z}, {c.target.x, c.target.y, c.target.z}};
}

}  // namespace

Scene changed_scene(const Show& show, const Viewer& v, const std::string& folder) {
    const Design& d = current(v.change.designs);
    Scene s = scene_with(v.change.scene, d);
    if (!is_as_opened(v.change)) s.about.clear();  // which tells of the one that was opened
    s.drunk = show.loaded.world->drunk;
    s.groups = show.loaded.world->company.shares;
    s.acquaintances = show.loaded.world->company.acquaintances;
    if (s.lamps) s.jaywalkers = show.loaded.world->jaywalkers;
    if (show.loaded.world->alongside) s.along = show.loaded.world->alongside->shares;
    s.pastimes = show.loaded.world->pastimes->shares;
    s.traffic = show.loaded.world->vehicles.traffic;
    leave_out_nobody(s);
    s.views = show.work_views;
    s.quality = v.quality;
    const bool marches = is_on(show.loaded.world->crowd.march);
    s.limbs = marches && s.habit == Habit::ramble ? LimbLead::curves : LimbLead::gait;
    s.camera = camera_of(v);
    if (s.camera.kind == CameraChoice::Kind::follow && s.camera.walker >= d.people)
        s.camera = {CameraChoice::Kind::fixed,
                    0,
                    {v.camera.eye.x, v.camera.eye.y, v.camera.eye.z},
                    {v.camera.target.x, v.camera.target.y, v.camera.target.z}};
    move_paths(s, folder);
    return s;
}

Result<std::string> save_scene(const Show& show, const Viewer& v, const std::string& typed) {
    if (fs::path(typed).filename().empty()) return Error{"A scene needs a name, such as out/square.json."};
    const std::string path = has_ending(typed, ".json") ? typed : typed + ".json";
    const Scene scene = changed_scene(show, v, fs::path(path).parent_path().string());
    if (Result<void> done = write_file(path, scene_text(scene)); !done) return done.error();
    std::string told = "Wrote " + path + "; flaneur view --scene " + path + " opens it.";
    if (show.loaded.world->seed != scene.seed)
        told += " Its people will be those of seed " + std::to_string(scene.seed) + ", which the city is of.";
    constexpr int k_a_block = 750;  // people for whom the built-in district is not made larger
    if (is_of(scene, BuiltIn::district) && scene.walkers > scene.blocks * scene.blocks * k_a_block)
        told += " So many people will have a larger district then.";
    return told;
}

void begin_naming(Viewer& v) {
    v.room = Room::change;
    v.change.is_naming = v.change.starts_naming = true;
}

void press_in_name(int key, Show& show, Viewer& v) {
    Change& c = v.change;
    if (key == GLFW_KEY_ESCAPE) c.is_naming = false;
    if (key != GLFW_KEY_ENTER && key != GLFW_KEY_KP_ENTER) return;
    const Result<std::string> told = save_scene(show, v, c.path);
    tell(v, told ? *told : told.error().message);
    if (told) c.is_naming = false;
}

}  // namespace flaneur
