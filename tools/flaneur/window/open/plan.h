// What becomes of the words that opened a window when a file is opened in it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/flaneur/options/options.h"

namespace flaneur {

// What is to be shown next.
struct ShowWish {
    std::vector<std::string> words;  // as they would follow `flaneur view`
    Options options;                 // what they say
    std::string file;                // that was opened, a full path; empty: a built-in scene
    std::string told;                // about it, once it is there
};

// A city, .osm, .osm.pbf or a glTF without a skeleton, comes in place of the one that `words` name, and its
// people stay; a character, a glTF with one or .vrm, joins them, with as large a share as each of the others,
// once; an elevation file, .hgt, .hgt.zip or .tif, goes under a map; a scene, .json, comes in place of all.
// What is said of the device, the window and threads stays. Refuses other files, and what cannot be opened.
Result<ShowWish> wish_for_file(const std::vector<std::string>& words, const std::string& path);

// The same of a built-in scene.
Result<ShowWish> wish_for_scene(const std::vector<std::string>& words, const std::string& name);

// The course in one line, or round, with so many people, as far as they find room; all else that was said
// stays.
Result<ShowWish> wish_for_course(const std::vector<std::string>& words, bool is_flat, int walkers,
                                 uint64_t seed);

}  // namespace flaneur
