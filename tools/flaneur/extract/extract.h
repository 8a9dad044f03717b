// The bridge from simulation to picture, and the only one: it turns a world into what the renderer draws.
#pragma once

#include <vector>

#include "assets/character.h"
#include "assets/city.h"
#include "renderer/view.h"
#include "sim/world.h"

namespace flaneur {

// What is uploaded once: the city's surfaces, facades, roofs and props, and the characters' meshes. World
// walkers whose body is i are drawn as characters[i].
SceneMeshes extract_scene(const City& city, const std::vector<Character>& characters);
// Where the light of street lamps and shop windows falls; houses stop it.
LampMap extract_lamps(const City& city);
// Whether a facade has shop windows at its foot.
bool is_shop_front(const City& city, const Face& face);
// Appends what darkens the ground where little sky is seen from it.
void add_shades(const City& city, CityMesh& mesh);
// Appends scenery to a mesh, with its pictures.
void add_scenery(const Scenery& scenery, CityMesh& mesh);

PersonMesh extract_character(const Character& character);

// The palette, k_palette_joints long, that draws a character at `scale` times its size with these places and
// rotations of its k_joint_count joints.
void pose_character(const Character& character, float scale, const JointPose* joints,
                    JointTransform* palette);

// Colours of each walker's skin, hair and clothes; constant over a run.
struct Wardrobe {
    struct Outfit {
        uint32_t tints[k_tints];
    };
    std::vector<Outfit> outfits;
};
Wardrobe make_wardrobe(const World& world, const std::vector<Character>& characters);

// The moving part of a frame; kept between frames so that its memory is.
struct PeopleFrame {
    std::vector<WalkerDraw> walkers;
    std::vector<JointTransform> palette;
    std::vector<uint32_t> posed;  // those who have a part of the palette, in order
};

// Walkers between the world's last two ticks: `between` 0 is the one before last, 1 the last. Only those get
// joints of whom the picture shows them.
void extract_people(const World& world, const std::vector<Character>& characters, const Wardrobe& wardrobe,
                    float between, const PoseNeeds& needs, PeopleFrame& frame);

}  // namespace flaneur
