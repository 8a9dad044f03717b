// Recorded motion of a humanoid out of a glTF's animations.
#pragma once

#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/pose/clip.h"

namespace tinygltf {
class Model;
}

namespace flaneur {

// Keys at even times for the 22 joints, against the canonical pose.
struct Motion {
    std::string name;
    std::vector<LocalPose> keys;  // `way`: of the pelvis from where it was bound, metres of the file's body
    float rate = 30;              // keys a second: 30, or as near as it takes to end on a key
    bool loops = false;           // it ends as it begins, within 5 degrees; the last key is left out then
};

// The animation `name` of a .gltf or .glb file with a skinned humanoid (see load_character, whose joints and
// axes are taken). Case does not count, nor what stands before a '|'. An empty name takes "Idle", or
// the first with that word in its name, or the first of all. LINEAR, STEP and CUBICSPLINE; what it says of
// scales and morph targets is left out. Refuses, in a sentence, what is broken or not there, and names what
// there is.
Result<Motion> load_motion(const std::string& path, const std::string& name);

// load_motion of a file that was parsed; errors begin with `path`.
Result<Motion> make_motion(const tinygltf::Model& model, const std::string& path, const std::string& name);

// Motion as differences to its first key, for people of any size.
Result<Clip> additive_clip(const Motion& motion);

}  // namespace flaneur
