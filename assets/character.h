// People as files and the built-in generator give them: a body for the simulation, a skinned mesh for the
// eye.
//
//     Result<Character> me = load_character("me.glb");
//     Character somebody = generate_person({.seed = 7, .height = 1.8f, .age = 65});
//
// Give `body` to the simulation (Kind::body in sim/sim.h); draw `vertices` by one of the triangle lists in
// `lods`, skinned by the poses that it returns. Lengths are metres, +y is up, and who is at rest faces +z.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "assets/person.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"
#include "sim/body/body.h"

namespace flaneur {

struct Character;

struct CharacterOptions {
    bool force = false;      // two legs will do: what lacks arms or a head is taken, stiff above them
    std::string cache = "";  // a folder that keeps levels of detail between runs; empty: none
};

// A glTF 2.0 or VRM file (.glb, .gltf, .vrm) with a skinned humanoid. Limbs and facing are found by geometry
// with names as hints; units and axes are made canonical. Refuses, by name of what is missing, what cannot be
// mapped; says in `notes` what was repaired.
Result<Character> load_character(const std::string& path, const CharacterOptions& options = {});

// Whether a glTF file can be read and has a skin: else there is nobody in it.
bool has_skin(const std::string& path);

// A person made by the built-in generator. The same options give the same mesh. Takes some tenths of a
// second.
Character generate_person(const PersonOptions& options);

// For a character of one level that was made elsewhere: appends the levels of detail after the first, of
// about 3000, 1500, 500 and 180 triangles where so few keep the person. Parts, limbs and what separates
// colours are kept, and each level is measured against the finest, as large as it is drawn; where it differs
// by too much more triangles are tried, and in the end the level before stands in. `found.levels` says what
// came of it. Orders indices and vertices for the vertex cache. load_character has done so. Takes some tenths
// of a second, of a million triangles two seconds.
void build_lods(Character& character);

// What a vertex is made of, so that walkers who share a mesh can differ in colour.
enum class Tint : uint8_t { none, skin, hair, top, bottom, shoes, accent };
inline constexpr int k_tint_count = 7;

// Joints of what hangs on people, after those of the body: each swings about a place that moves with one of
// the body's.
enum Follower : uint8_t {
    skirt_front = k_joint_count,  // of a skirt or a coat
    skirt_back,
    carried_bag,
    loose_hair,
    scarf_end,
    walking_stick,  // in the right hand, or where it has fallen
};
inline constexpr int k_follower_count = 6;

struct CharacterVertex {
    Vec3 position, normal;            // bind pose, model space: metres, +y up, facing +z
    float u = 0, v = 0;               // glTF convention: (0, 0) is the upper left corner of the texture
    uint32_t colour = 0xffffffff;     // sRGB, R in the lowest byte; multiplies texture and tint
    uint16_t texture = k_no_texture;  // index into Character::textures
    Tint tint = Tint::none;
    uint8_t joints[4] = {0, 0, 0, 0};     // Joint
    uint8_t weights[4] = {255, 0, 0, 0};  // sum to 255, falling
    // The same where it hangs, with followers among the joints; weights of 0 where it does not.
    uint8_t hung_joints[4] = {0, 0, 0, 0};
    uint8_t hung_weights[4] = {0, 0, 0, 0};
    uint8_t spare = 0;  // so that all bytes are set
    static constexpr uint16_t k_no_texture = 0xffff;
};

// 8-bit sRGB with straight alpha, rows from the top.
struct Texture {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
};

// A level of detail against the finest, in the worst of pictures from eight sides in three poses, as large as
// it is seen from nearest.
struct MeasuredLevel {
    float pixels = 0;  // the body's height there
    size_t triangles = 0;
    float silhouette = 0;              // covered by one alone, of what the finest covers
    float colour = 0;                  // mean distance, 0..1
    std::vector<std::string> refused;  // what else was tried, and why it was not used
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
    std::vector<std::string> clips;     // animations, by name or "animation 3"
    std::vector<MeasuredLevel> levels;  // after the finest; none where that is coarse enough
};

// A follower turns about this place of the bind pose, which moves with a joint.
struct Hung {
    Vec3 place;
    uint32_t joint = hips;  // Joint
};

struct Character {
    std::string name;
    Body body;
    // A vertex v bound to joint j stands, in the canonical pose, at
    // body.joints[j] + rotate(bind_to_canonical[j], v - bind_joints[j]).
    std::array<Vec3, k_joint_count> bind_joints;
    std::array<Quat, k_joint_count> bind_to_canonical;
    std::vector<CharacterVertex> vertices;
    std::array<Hung, k_follower_count> followers;
    float robe_hem = 0;  // metres above ground in the bind pose, of a skirt or coat; 0: without
    // Triangle lists over `vertices`, finest first, at least one. One that may not be coarser than the one
    // before is the same; see sim/base/levels.h for when they are drawn.
    std::vector<std::vector<uint32_t>> lods;
    std::vector<Texture> textures;   // base colours
    std::vector<std::string> notes;  // what was repaired or ignored, a sentence each
    PersonOptions person;            // what a built-in person was made of
    Found found;                     // in its file; as it is when the generator made it
};

}  // namespace flaneur
