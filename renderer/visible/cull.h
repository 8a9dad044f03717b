// Who is drawn, how finely: pure functions from a frame's walkers and the city's chunks to lists of draws.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/light/shadow_box.h"
#include "renderer/visible/occlusion.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

struct MeshRange {
    uint32_t first_index = 0, index_count = 0;
};

// Where a person's mesh lies in the shared buffers; finest level first, at most k_max_lods.
struct PersonRanges {
    std::vector<MeshRange> lods;
    int32_t vertex_offset = 0;
    glm::vec3 soles[2] =
        {};  // middles of the left and right sole in the bind pose, moved by k_left_foot, k_right_foot
    uint32_t first_cell = k_no_cell;  // of its k_person_cells impostors
    bool is_thing = false;            // see PersonMesh
    static constexpr uint32_t k_no_cell = ~0u;
};

// The level after those of meshes: an impostor.
inline constexpr uint32_t k_impostor_level = k_max_lods;
// About the size where one level follows another, by this share of it, both are drawn, in turns of pixels.
inline constexpr float k_turns = 0.015f;
inline constexpr uint8_t k_unseen = 0xff;

// How a body is drawn: the finer of two levels, hidden in these pixels of each 4x4, where the coarser is
// seen.
struct Levels {
    uint8_t fine = k_unseen, coarse = k_unseen;
    uint16_t hidden = 0;
};

// As vkCmdDrawIndexedIndirect takes it.
struct DrawCommand {
    uint32_t index_count, instance_count, first_index;
    int32_t vertex_offset;
    uint32_t first_instance;
};

// Instances sorted by (level, mesh), in the order of the walkers within each, and a draw for each such
// bucket. Walkers between two levels are in both.
struct CrowdDraws {
    std::vector<WalkerInstance> instances;
    std::vector<ImpostorInstance> impostors;  // in the order of the walkers
    std::vector<DrawCommand> draws;
    std::vector<glm::vec4> spheres;  // about the bodies of instances, then of impostors: centre, radius
    uint32_t triangles = 0;
    std::vector<Levels> levels;    // of each walker
    std::vector<uint32_t> firsts;  // scratch: one a chunk of walkers and bucket
};

struct CrowdInput {
    std::span<const WalkerDraw> walkers;
    std::span<const PersonRanges> people;
    size_t palette_size = 0;    // walkers that refer beyond it are left out, as are those of unknown meshes
    float impostor_pixels = 0;  // smaller ones are impostors, if their meshes have any
    bool is_finest = false;     // all by their finest meshes
    uint32_t companion = ~0u;   // see FrameInput
    const OcclusionMap* hidden = nullptr;  // who is out of sight behind walls; null: nobody
    Workers* workers = nullptr;            // who help; null: nobody
};

// body(chunk, begin, end) for consecutive chunks of the walkers, on every thread.
inline constexpr size_t k_chunk = 1024;  // walkers
inline size_t chunk_count(const CrowdInput& input) { return (input.walkers.size() + k_chunk - 1) / k_chunk; }
template <class Body>
void in_chunks(const CrowdInput& input, const Body& body) {
    auto run = [&](size_t first, size_t last, int) {
        for (size_t chunk = first; chunk < last; ++chunk)
            body(chunk, chunk * k_chunk, std::min((chunk + 1) * k_chunk, input.walkers.size()));
    };
    if (input.workers && input.walkers.size() > k_chunk)
        parallel_for(*input.workers, chunk_count(input), 1, run);
    else
        run(0, chunk_count(input), 0);
}

// Whether a walker's mesh and joints are there.
bool is_drawable(const CrowdInput& input, const WalkerDraw& walker);

glm::vec3 moved_by(const JointTransform& joint, glm::vec3 v);

// Those that the view sees.
void cull_crowd(const CrowdInput& input, const View& view, CrowdDraws& out);

// Those within `reach` of the eye that the view sees, or whose shadows it may see; meshes are as coarse as
// the box's texels, and at least a level coarser than in view, and walkers seen as impostors throw their
// impostors' shadows.
void cull_shadow_casters(const CrowdInput& input, const View& view, const ShadowBox& box, glm::vec3 to_sun,
                         float reach, CrowdDraws& out);

// A piece of the city: triangles that lie together, as they are drawn from near and from far away.
struct CityChunk {
    glm::vec3 low, high;
    MeshRange near, far;
};
// A piece is seen from far away where a metre of it is nowhere larger than so many pixels.
inline constexpr float k_fine_pixels = 25;

// Appends a draw for each chunk that the view sees and no wall hides, nearest first; returns how many.
uint32_t cull_chunks(std::span<const CityChunk> chunks, const View& view, const OcclusionMap& hidden,
                     std::vector<DrawCommand>& draws);

// Appends a draw for each chunk that may throw a shadow into the box, as it is drawn from near or from far.
uint32_t cull_chunk_casters(std::span<const CityChunk> chunks, const ShadowBox& box, bool is_near,
                            std::vector<DrawCommand>& draws);

}  // namespace flaneur
