// Cities from glTF files: any still scene as ground and walls.
#pragma once

#include <string>

#include "assets/city.h"
#include "sim/base/result.h"

namespace tinygltf {
class Model;
}

namespace flaneur {

// A .glb or .gltf as a city: every triangle that the file shows becomes scenery; those that face up within 40
// degrees and have headroom become ground too, the rest stops walkers. Kinds of ground come from words in the
// names of materials and nodes (road, sidewalk, crossing, grass, water, stairs, path; else plaza); leaves
// stop nobody, and what is called a roof or a car is not walked on. Flat places that nothing leads up to,
// roofs above all, are left out. A file's unit is taken for a metre times `scale`. A file that lies far from
// its origin is moved: its middle to x = z = 0, its lowest large ground to y = 0. Refuses, in a sentence,
// what load_character refuses for safety, and what has no ground to walk on, such as a single house.
Result<City> load_gltf_city(const std::string& path, float scale = 1);

// The same of a parsed file; `path` names it in sentences.
Result<City> make_gltf_city(const tinygltf::Model& model, const std::string& path, float scale = 1);

}  // namespace flaneur
