// Recorded motion of a humanoid out of a glTF's animations.
#pragma once

#include <string>
#include <vector>

#include "sim/animation/clip.h"
#include "sim/base/result.h"

namespace tinygltf {
class Model;
}

namespace flaneur {

// Keys at even times for the 22 joints, against the canonical pose.
struct RecordedMotion {
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
Result<RecordedMotion> load_motion(const std::string& path, const std::string& name);

// FILE or FILE:CLIP, either of which may have colons in it: the longest FILE that is there is meant.
struct ClipName {
    std::string file, clip;
};
ClipName split_clip(const std::string& text);

// load_motion of a file that was parsed; errors begin with `path`.
Result<RecordedMotion> make_motion(const tinygltf::Model& model, const std::string& path,
                                   const std::string& name);

// RecordedMotion as differences to its first key, for people of any size.
Result<Clip> additive_clip(const RecordedMotion& motion);

}  // namespace flaneur
