// People skinned on the host: where the device is a CPU, its own vertex stage runs on one thread and sets up
// even those triangles that show nothing, while the host's lanes and threads skin for a tenth of that. Only
// triangles that may cover a sample are handed on, with the vertices that they use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene.h"
#include "renderer/visible/cull.h"

namespace flaneur {

// A level of a person's mesh, with only the vertices that its triangles use, in the order of their use.
struct SkinMesh {
    struct Vertex {
        float place[3], normal[3];
        float weights[4];
        uint8_t joints[4];
        uint32_t bones;  // how many of them have weight
        glm::vec2 uv;
        uint32_t colour, tint, layer;  // sRGB; of the instance's; of the textures
    };
    uint32_t first_index = 0;  // as in the scene's index buffer, MeshRange::first_index
    std::vector<Vertex> vertices;
    std::vector<uint32_t> indices;
};

// `vertices` as they are uploaded: `texture` is a layer. At most four bones a vertex, as skin.glsl.
SkinMesh make_skin_mesh(std::span<const PersonVertex> vertices, std::span<const uint32_t> indices,
                        uint32_t first_index);

// As skinned.vert takes it.
struct SkinnedVertex {
    glm::vec3 place;  // in the world
    uint32_t normal;  // x, y, z times 511, ten bits each, x lowest
    glm::vec2 uv;
    uint32_t colour, tint;  // sRGB, R in the lowest byte
    uint32_t layer;         // and, from bit 16 on, where it is hidden, as WalkerInstance has it
};
static_assert(sizeof(SkinnedVertex) == 36);

// Walkers drawn by one mesh.
struct SkinRun {
    const SkinMesh* mesh = nullptr;
    uint32_t first_instance = 0, count = 0;
};
// Runs whose triangles are drawn together, and the stretches of the buffers that are kept for them: as much
// as they need if nothing is culled.
struct SkinBatch {
    uint32_t first_run = 0, run_count = 0;
    uint32_t first_vertex = 0, first_index = 0;
};
struct SkinPlan {
    std::vector<SkinRun> runs;
    std::vector<SkinBatch> batches;
    uint32_t vertices = 0, indices = 0;  // of the buffers
    uint32_t draws = 0;  // how many of the crowd's draws are in it: the first ones, as many as fit
};

// Meshes sorted by first_index. The plan does not depend on the number of threads.
SkinPlan plan_skin(std::span<const DrawCommand> draws, std::span<const SkinMesh> meshes);

// What is drawn into.
struct SkinView {
    glm::mat4 clip_from_world;
    float width = 0, height = 0;  // pixels
    float near = 0;               // clip coordinate w from which on things are seen
    uint32_t bones = 4;           // at most, that move a vertex
};
SkinView skin_view(const View& view, uint32_t width, uint32_t height);
// As shadow_crowd.vert draws.
SkinView skin_view(const ShadowBox& box, uint32_t resolution);

// Memory that a thread keeps from batch to batch.
struct SkinScratch {
    std::vector<float> palette, vertices;
    std::vector<uint32_t> survivors, numbers;
};

// Skins a batch's walkers and writes, at the beginning of its stretches, what the view may see of them, in
// the order of walkers and of their meshes' triangles. Returns the draw; its vertices count from
// first_vertex.
DrawCommand skin_batch(const SkinPlan& plan, const SkinBatch& batch,
                       std::span<const WalkerInstance> instances, std::span<const JointTransform> palette,
                       const SkinView& view, SkinScratch& scratch, SkinnedVertex* vertices,
                       uint32_t* indices);

}  // namespace flaneur
