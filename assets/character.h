// People as the rest of the program takes them: a body for the simulation, a skinned mesh for the eye.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "sim/pose/body.h"

namespace flaneur {

// What a vertex is made of, so that walkers who share a mesh can differ in colour.
enum class Tint : uint8_t { none, skin, hair, top, bottom, shoes, accent };
inline constexpr int k_tint_count = 7;

struct CharacterVertex {
    Vec3 position, normal;            // bind pose, model space: metres, +y up, facing +z
    float u = 0, v = 0;               // glTF convention: (0, 0) is the upper left corner of the texture
    uint32_t colour = 0xffffffff;     // sRGB, R in the lowest byte; multiplies texture and tint
    uint16_t texture = k_no_texture;  // index into Character::textures
    Tint tint = Tint::none;
    uint8_t joints[4] = {0, 0, 0, 0};     // Joint
    uint8_t weights[4] = {255, 0, 0, 0};  // sum to 255, falling
    uint8_t spare = 0;                    // so that all bytes are set
    static constexpr uint16_t k_no_texture = 0xffff;
};

// 8-bit sRGB with straight alpha, rows from the top.
struct Texture {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
};

// How old somebody is and what is worn, of which the built-in generator makes a person.
enum class Hair : uint8_t {
    cropped,
    parted,
    full,
    curly,
    bald,  // but for a fringe round the back
    bob,
    bangs,
    shoulder_length,
    long_hair,
    bun,
    ponytail,
};
inline constexpr int k_hair_count = 11;
enum class Beard : uint8_t { none, moustache, full };
enum class Top : uint8_t { t_shirt, shirt, sweater, hoodie };
enum class Over : uint8_t { none, jacket, open_jacket, coat, vest };
enum class Bottom : uint8_t { slim, straight, wide, shorts, skirt, long_skirt, dress };
enum class Shoes : uint8_t { sneakers, leather, boots, pumps };
enum class Hat : uint8_t { none, cap, beanie, brimmed };
enum class Bag : uint8_t { none, backpack, shoulder_bag, handbag };

struct PersonOptions {
    uint64_t seed = 1;     // draws the face
    float height = 1.72f;  // metres, crown above ground
    bool woman = false;    // or girl
    float age = 30;        // years, 5..85
    float build = 0;       // -1 slight .. 1 heavy
    Hair hair = Hair::cropped;
    Beard beard = Beard::none;
    Top top = Top::sweater;
    Over over = Over::none;
    Bottom bottom = Bottom::straight;
    Shoes shoes = Shoes::sneakers;
    Hat hat = Hat::none;
    Bag bag = Bag::none;
    bool glasses = false, scarf = false, headphones = false;
    bool phone = false, stick = false;  // in the right hand, one of them
};

// What a file held and how it was read, for those who ask.
struct Found {
    // The node that each joint was taken from: its name, or "node 7" where it has none; empty where the joint
    // was made up by proportion.
    std::array<std::string, k_joint_count> nodes;
    Vec3 up{0, 1, 0}, ahead{0, 0, 1};  // of the character, in the file's axes
    float scale = 0;                   // metres a unit of the file; 0: no file
    size_t skins = 0, materials = 0;   // in use
    size_t triangles = 0;
    std::vector<std::string> clips;  // animations, by name or "animation 3"
};

struct Character {
    std::string name;
    Body body;
    // A vertex v bound to joint j stands, in the canonical pose, at
    // body.joints[j] + rotate(bind_to_canonical[j], v - bind_joints[j]).
    std::array<Vec3, k_joint_count> bind_joints;
    std::array<Quat, k_joint_count> bind_to_canonical;
    std::vector<CharacterVertex> vertices;
    std::vector<std::vector<uint32_t>> lods;  // triangle lists over `vertices`, finest first, at least one
    std::vector<Texture> textures;            // base colours
    std::vector<std::string> notes;           // what was repaired or ignored, a sentence each
    PersonOptions person;                     // what a built-in person was made of
    Found found;                              // in its file; as it is when the generator made it
};

// A glTF 2.0 file (.gltf or .glb) with a skinned humanoid. Limbs and facing are found by geometry with names
// as hints; units and axes are made canonical. Refuses, by name of what is missing, what cannot be mapped.
Result<Character> load_character(const std::string& path);

// A person made by the built-in generator. The same options give the same mesh.
Character generate_person(const PersonOptions& options);

// Appends the levels of detail after the first: about 3000, 1500, 500 (1000 with textures) and 180 triangles,
// skipping those that would not be coarser than the one before; orders indices and vertices for the vertex
// cache.
void build_lods(Character& character);

}  // namespace flaneur
