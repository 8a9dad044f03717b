// The changed city as the file of a scene.
#pragma once

#include <string>

#include "sim/base/result.h"
#include "tools/flaneur/options/options.h"

namespace flaneur {

struct Show;
struct Viewer;
struct Change;

// The scene that is wanted now, seen from where the camera is; its paths start at `folder`.
Scene changed_scene(const Show& show, const Viewer& viewer, const std::string& folder);

// Writes it to a .json file, which `--scene` takes. Says what will be otherwise when it is opened, if
// anything.
Result<std::string> save_scene(const Show& show, const Viewer& viewer, const std::string& path);

// Lets one type the name of the file; Enter saves, Esc does not.
void begin_naming(Viewer& viewer);
void press_in_name(int key, Show& show, Viewer& viewer);

}  // namespace flaneur
