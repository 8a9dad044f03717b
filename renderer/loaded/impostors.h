// Impostors: pictures of people from many sides in the phases of a walk, baked once from their meshes into
// one atlas that holds, for each texel, colour, tint and normal, so that each walker's picture is lit and
// dressed like its mesh.
#pragma once

#include <span>
#include <vector>

#include "renderer/device/resources.h"
#include "renderer/pipelines/pipelines.h"
#include "renderer/visible/cull.h"

namespace flaneur {

struct SceneMeshes;
struct PersonMesh;
struct GpuScene;

// The atlas is at most so large, 32 MiB; where there are many kinds of people, cells are smaller.
inline constexpr uint32_t k_atlas_width = 2048, k_atlas_height = 4096;  // texels

struct Impostors {
    GpuImage atlas{"impostor atlas"};
    Buffer cells{"impostor cells"};  // ImpostorCell
    float pixels = 0;                // a body whose sphere is smaller is drawn as an impostor
};

// The cells of `people` kinds of people side by side in an atlas.
struct CellGrid {
    uint32_t width = 0, height = 0;  // of a cell, texels; 0: so many kinds have no room
    uint32_t columns = 0, rows = 0;
};
CellGrid cell_grid(size_t people);

// Bakes the impostors of a scene whose meshes and textures have been uploaded, and sets each person's
// first_cell. Where no mesh has strides, or there is no room, the atlas is a single texel.
Result<void> bake_impostors(const Device& device, const Pipelines& pipelines, const SceneMeshes& meshes,
                            GpuScene& scene);
// The atlas, read back; and what it depends on.
Result<std::vector<uint32_t>> read_impostors(const Device& device, Impostors& impostors);
uint64_t impostors_key(const Device& device, std::span<const PersonMesh> people);
void destroy_impostors(const Device& device, Impostors& impostors);

}  // namespace flaneur
