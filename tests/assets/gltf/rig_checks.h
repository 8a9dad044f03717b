// What tests of rigs share: men of boxes, read and looked at.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "assets/gltf/character/character.h"
#include "tests/assets/tiny_man.h"

namespace flaneur {

using Bones = std::vector<TinyBone>;

inline Result<Character> loaded(const Bones& bones, const CharacterOptions& options = {}) {
    auto model = parse_gltf(as_glb(tiny_rig(bones)), "/nowhere", "man.glb");
    return model ? make_character(*model, "man.glb", options) : model.error();
}

inline const Character& plain_man() {
    static const Character k_man = *loaded(tiny_bones());
    return k_man;
}

inline bool noted(const Character& c, const std::string& what) {
    return std::any_of(c.notes.begin(), c.notes.end(),
                       [&](const std::string& note) { return note.find(what) != std::string::npos; });
}

inline void mirror(const std::function<void(const std::string&, float)>& side) {
    side("left_", 1);
    side("right_", -1);
}

// By joint: how many boxes it moves.
inline std::array<size_t, k_joint_count> boxes_of(const Character& c) {
    constexpr size_t k_corners = 36;
    std::array<size_t, k_joint_count> count{};
    for (uint32_t i : c.lods[0]) ++count[c.vertices[i].joints[0]];
    for (size_t& n : count) n /= k_corners;
    return count;
}

}  // namespace flaneur
