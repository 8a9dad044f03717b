// A scene on the device: vertices and indices of the city, and of all people.
#pragma once

#include "renderer/loaded/city_mesh.h"
#include "renderer/loaded/impostors.h"
#include "renderer/people/skin.h"

namespace flaneur {

struct GpuScene {
    Buffer city_vertices{"city vertices"}, city_indices{"city indices"}, person_vertices{"person vertices"},
        person_indices{"person indices"};
    GpuImage textures{"textures of people"},
        scenery{"pictures of scenery"};  // arrays, of people and of the city; layer 0 is white
    std::array<std::vector<CityChunk>, k_city_classes> chunks;
    std::vector<Wall> walls;
    std::vector<WallGroup> wall_groups;
    std::vector<PersonRanges> people;
    std::vector<SkinMesh> skin_meshes;  // every level of people's meshes
    Impostors impostors;
    GpuImage lamps{"light of lamps"};  // LampMap, in half floats
    std::vector<vec4> lamp_texels;     // the same numbers, for the host
    glm::vec4 lamp_map{0};             // FrameConstants::lamp_map
    float ground_low = 0;              // metres
    bool is_textured = false;
};

// Fills an empty `scene`; after a failure destroy_scene() frees what had been made. Refuses meshes that refer
// to vertices, joints or textures that are not there.
Result<void> make_scene(const Device& device, const Pipelines& pipelines, const SceneMeshes& meshes,
                        GpuScene& scene);

// Fills the city's part of a scene, of which nothing is there: all but its pictures.
Result<void> make_city(const Device& device, const PreparedCity& city, GpuScene& scene);
// The same of its lamps.
Result<void> make_lamps(const Device& device, const LampMap& map, GpuScene& scene);
// Exchanges these parts of two scenes.
void swap_cities(GpuScene& a, GpuScene& b);
void swap_lamps(GpuScene& a, GpuScene& b);

void destroy_scene(const Device& device, GpuScene& scene);

}  // namespace flaneur
