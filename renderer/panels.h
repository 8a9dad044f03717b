// Panels: windows, buttons and text over a picture, as sharp as the window whatever the picture's resolution.
// They are handed over as triangles, so that any library may lay them out; Dear ImGui's lists are of this
// shape.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace flaneur {

struct PanelVertex {
    glm::vec2 place;  // pixels from the upper left corner
    glm::vec2 uv;     // of the letters and pictures, 0..1
    uint32_t colour;  // sRGB, R in the lowest byte; alpha is not multiplied in. Times that of the texel
};
static_assert(sizeof(PanelVertex) == 20);

// Triangles that are seen within a rectangle.
struct PanelDraw {
    uint32_t first_index = 0, index_count = 0;
    int32_t vertex_offset = 0;  // added to each index
    glm::vec4 clip{0};          // left, top, right, bottom, pixels
};

// Drawn in the order of `draws`, later ones over earlier ones.
struct Panels {
    std::span<const PanelVertex> vertices;
    std::span<const uint16_t> indices;
    std::span<const PanelDraw> draws;
};

// All that panels show in one picture: letters and shapes, white with how much of a texel they cover as its
// alpha, and pictures beside them. sRGB, R, G, B and A a texel, rows from the top.
struct Letters {
    uint32_t width = 0, height = 0;
    std::span<const uint8_t> texels;
};

}  // namespace flaneur
