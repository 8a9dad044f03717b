// The bridge from simulation to picture: cities and characters (assets/city.h, assets/character.h) as meshes,
// and the walkers of a world (sim/sim.h) as what a frame shows of them, for the renderer
// (renderer/renderer.h).
//
//     std::vector<Character> characters;  // give the world a Kind for each, in the same order
//     Result<void> uploaded = upload_scene(*renderer, extract_scene(city, characters));
//     PeopleFrame people;                 // kept, as is `frame`
//     for (;;) {
//         step(*world);
//         extract_people(*world, characters, people);
//         frame.walkers = people.walkers;
//         frame.palette = people.palette;
//         frame.grounds = people.grounds;
//         Result<void> drawn = draw_window(*renderer, frame);
//     }
//
// Nothing here changes a world, draws or keeps what it is handed. Metres, seconds, radians; right-handed, +y
// up; colours are sRGB, R in the lowest byte.
#pragma once

#include <vector>

#include "assets/character.h"
#include "assets/city.h"
#include "renderer/scene.h"
#include "renderer/view.h"
#include "sim/pose/trail.h"
#include "sim/sim.h"

namespace flaneur {

// What is uploaded once: the city's ground, facades, roofs, props and scenery, and people[i] of
// characters[i]. Without lamps. Runs on threads of its own, one for each core.
SceneMeshes extract_scene(const City& city, const std::vector<Character>& characters);

// Its part of the city alone.
CityMesh extract_city(const City& city);

// Where the light of street lamps and shop windows falls, for SceneMeshes::lamps; houses stop it. Only seen
// when it is dark. Takes seconds for a large city, on all cores.
LampMap extract_lamps(const City& city);

// A character's mesh, for SceneMeshes::people: its vertices, levels of detail and textures, and the walk that
// its impostors are baked from.
PersonMesh extract_character(const Character& character);

struct Without;  // of sim/without.h

// The moving part of a frame. It is of one world; kept between frames, it allocates only while that grows.
struct PeopleFrame {
    // By WalkerId::index. Of those who are gone, nothing is drawn. Clothes are in `instance.tints`, by Tint,
    // drawn by chance for each walker and the same in each frame; write others over them after each call.
    std::vector<WalkerDraw> walkers;
    std::vector<JointTransform> palette;
    std::vector<GroundBelow> grounds;  // of each who has a part of the palette, in its order
    std::vector<uint32_t> posed;       // indices of those who have a part of the palette, in its order

    struct Outfit {
        WalkerId wearer;
        uint32_t tints[k_tints];
    };
    std::vector<Outfit> outfits;  // what everyone wears, by WalkerId::index
};

// Everyone in the world; one of kind i as characters[i], of which there must be one for each kind. `between`
// is 0 for the tick before the last .. 1 for the last. Only those get joints whom `needs` asks for, as
// pose_needs() of renderer.h has it for a camera; as it is made here, everyone does. With `without`, caught
// up with the world and not whole, bodies are as that has them, but for those far away, who are pictures.
// Runs on the world's own threads, so that there may be one such call at a time for each world, and none
// beside step().
void extract_people(const World& world, const std::vector<Character>& characters, PeopleFrame& people,
                    float between = 1, const PoseNeeds& needs = {}, const Without* without = nullptr);

struct Linkages;  // of sim/linkages/linkages.h
// What of a world's linkages is uploaded, to come after its people in SceneMeshes::people, the first as mesh
// `first_mesh`; and adds them as they are between ticks to what extract_people() found.
std::vector<PersonMesh> extract_linkages(const Linkages& linkages);
// `first_id`: how many exhibits come before them.
void add_linkages(const Linkages& linkages, uint32_t first_mesh, PeopleFrame& people, float between = 1,
                  uint32_t first_id = 0);

struct Movers;  // of sim/movers/movers.h
// The same of a world's movers, each a mesh; they come before linkages.
std::vector<PersonMesh> extract_movers(const Movers& movers);
void add_movers(const Movers& movers, uint32_t first_mesh, PeopleFrame& people, float between = 1);

struct Balls;  // of sim/balls.h
// The same of a world's balls, whose one mesh comes after linkages. `first_id`: how many movers there are.
PersonMesh extract_ball();
void add_balls(const Balls& balls, uint32_t mesh, PeopleFrame& people, float between = 1,
               uint32_t first_id = 0);

// The same of the phones that people have in their hands, whose one mesh comes after the ball.
PersonMesh extract_phone();
void add_phones(const World& world, uint32_t mesh, PeopleFrame& people, float between = 1);

// The same of what goes along with a world's people: dogs, wheelchairs, instruments and the like; they come
// after vehicles. None where nobody has company.
std::vector<PersonMesh> extract_alongside(const World& world);
void add_alongside(const World& world, uint32_t first_mesh, PeopleFrame& people, float between = 1);
// How many meshes of vehicles come after the phone: none where nobody could drive.
uint32_t vehicle_mesh_count(const World& world);
// What is uploaded for a world's vehicles, and they themselves as they are between ticks, with those who ride
// bicycles.
std::vector<PersonMesh> extract_vehicles();
void add_vehicles(const World& world, const std::vector<Character>& characters, uint32_t first_mesh,
                  PeopleFrame& people, float between = 1);

struct Troupe;  // of sim/figures/figures.h
// Adds a world's figures to what extract_people() found, before its linkages: figure i as characters[its
// kind].
void add_figures(const Troupe& figures, const std::vector<Character>& characters, PeopleFrame& people,
                 float between = 1);
struct Deeds;  // of sim/deeds/deeds.h
// The same of those who do things; they come last.
void add_doers(const Deeds& deeds, const std::vector<Character>& characters, PeopleFrame& people,
               float between, uint32_t first_id);

// For who moves people without a world: writes k_palette_joints transforms to `palette`, which draw a
// character at `scale` times its size with these k_joint_count poses, by Joint and as pose_of() of sim.h
// gives them. What hangs on people swings if it is told how they have moved of late (sim/pose/trail.h); else
// it hangs as if they kept still. A pram that is pushed stands where that says, or on level ground ahead.
// A walking stick that has fallen has its grip where `stick` says.
void pose_character(const Character& character, float scale, const JointPose* joints, JointTransform* palette,
                    const Trail* trail = nullptr, const PramPlace* pram = nullptr,
                    const JointPose* stick = nullptr);

// For the same: the ground below one with these k_joint_count poses, and below the pram.
GroundBelow find_ground_below(const Surroundings& around, const JointPose* joints,
                              const PramPlace* pram = nullptr);

}  // namespace flaneur
