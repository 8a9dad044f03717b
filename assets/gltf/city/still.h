// Things that do not move as glTF 2.0.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assets/city.h"

namespace flaneur {

struct StillMaterial {
    std::string name;
    uint32_t colour = ~0u;  // sRGB, R in the lowest byte
    float roughness = 0.9f, metallic = 0;
    int picture = -1;     // index into StillModel::pictures, or none
    bool is_cut = false;  // where the picture's alpha is below a half nothing is seen
};

// Triangles of one material, wound counter-clockwise from outside; one normal and colour a vertex.
struct StillSurface {
    size_t material = 0;
    std::vector<Vec3> positions, normals;
    std::vector<Vec2> uvs;          // empty: no picture
    std::vector<uint32_t> colours;  // sRGB, the picture's are multiplied by them; empty: the material's
    std::vector<uint32_t> indices;
};

struct StillMesh {
    std::string name;
    std::vector<StillSurface> surfaces;
};

struct StillModel {
    std::vector<StillMesh> meshes;  // each a node of its own
    std::vector<StillMaterial> materials;
    std::vector<Scenery::Picture> pictures;
};

// The bytes of a binary glTF file (.glb): metres, +y up. Equal vertices are written once, pictures as PNG.
// What a file shows that takes no notice of colours of vertices is the material's colour; where there are
// both, the file's colours are such that their product is the vertex's.
std::string still_glb(const StillModel& model);

}  // namespace flaneur
