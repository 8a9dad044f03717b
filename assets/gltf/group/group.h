// People who move, together in one glTF 2.0 file.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/character.h"

namespace flaneur {

inline constexpr size_t k_bone_count = size_t{k_joint_count} + k_follower_count;

// A vertex of the pose of the bind, bound to it, stands at shift + rotate(turn, scale * vertex).
struct DrawnBone {
    Quat turn;
    Vec3 shift;
};
using DrawnBones = std::array<DrawnBone, k_bone_count>;  // joints, then followers

struct GlbPerson {
    std::string name;  // no two of a group have the same
    const Character* character = nullptr;
    std::array<uint32_t, k_tint_count> tints{};  // sRGB, as outfit() gives them
    float scale = 1;                             // of the character's size
    std::vector<uint32_t> frames;                // in which it is there: one at least, rising
    std::vector<DrawnBones> poses;               // in each of these
};
struct GlbGroup {
    float fps = 60;
    uint32_t frames = 0;  // of the whole
    std::vector<GlbPerson> people;
};

// How far a vertex may be from where it was drawn in a frame, for fewer keys; roundings come on top.
inline constexpr float k_glb_bound = 0.0005f;                     // metres, and
inline constexpr float k_glb_turn = 0.1f * 3.14159265f / 180.0f;  // each bone against its parent, radians

// The bytes of a .glb. Each person is a node of its name, at its size where it stands first; below it a
// skeleton with VRM's names of humanoid bones, and those of what hangs on it and swings; and a skinned mesh,
// the finest level of detail. Those of one character share all of it but colours. The first animation,
// "everybody", moves all; after it comes one for each, of its name; of one person alone there is that one.
// Seconds count from frame 0. Who is not there in some frames has a size of 0 meanwhile, by steps. Between
// keys places are on straight lines, and turns, in 16 bits, on the short way.
std::string group_glb(const GlbGroup& group);

// What is in a file of several people, whoever wrote it: skeletons that share no joint, each with joints
// enough for a body.
struct GroupFound {
    std::vector<std::string> names, clips;
    size_t triangles = 0;
};
// Refuses, in a sentence, what cannot be read and what has fewer than two.
Result<GroupFound> find_group(const std::string& path);

}  // namespace flaneur
