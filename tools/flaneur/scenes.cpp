#include <cstdio>
#include <string>

#include "assets/scene.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"

namespace flaneur {

// Whether its people can be set down: on a stage that is made within a moment, as any other command does it.
static Result<void> try_stage(const Options& options, const Scene& scene) {
    const bool is_made_at_once = is_of(scene, BuiltIn::platform) || is_of(scene, BuiltIn::field) ||
                                 is_of(scene, BuiltIn::course) || is_of(scene, BuiltIn::quayside) ||
                                 is_small_world(scene);
    if (!is_made_at_once) return {};
    Options of_scene = options;
    of_scene.scene = scene;
    const Result<Loaded> loaded = load(of_scene);
    clear_progress();
    return loaded ? Result<void>() : loaded.error();
}

// Says what is wrong with a scene, or what it names that is not there; whether it is good.
static bool tell_faults(const Options& options, const std::string& file) {
    Result<std::vector<SceneFault>> faults = check_scene(file);
    if (!faults) {
        std::printf("%s\n", printable(faults.error().message).c_str());
        return false;
    }
    const std::string name = printable(file);
    for (const SceneFault& f : *faults)
        std::printf("%s:%d:%d: %s.\n", name.c_str(), f.line, f.column, printable(f.what).c_str());
    if (!faults->empty()) return false;
    Result<Scene> scene = load_scene(file);
    Result<void> found = scene ? find_files(*scene) : scene.error();
    if (found) found = try_stage(options, *scene);
    std::printf("%s: %s\n", name.c_str(), found ? "good" : printable(found.error().message).c_str());
    return static_cast<bool>(found);
}

Result<void> run_scenes(const Options& options) {
    if (options.schema) {
        std::fputs(scene_schema().c_str(), stdout);
        return {};
    }
    if (options.scene_files.empty()) {
        for (const std::string& name : scene_names()) {
            Result<Scene> scene = load_scene(name);
            if (!scene) return scene.error();
            std::printf("%-14s %s\n", name.c_str(), scene->about.c_str());
        }
        return {};
    }
    size_t bad = 0;
    for (const std::string& file : options.scene_files) {
        bad += !tell_faults(options, file);
    }
    if (bad == 0) return {};
    return Error{std::to_string(bad) + " of " + std::to_string(options.scene_files.size()) +
                 " scenes cannot be used; the lines above say why."};
}

}  // namespace flaneur
