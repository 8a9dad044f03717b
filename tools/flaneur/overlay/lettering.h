// Text as strokes of lines that keep their size on the picture.
#pragma once

#include <string_view>
#include <vector>

#include "renderer/scene.h"

namespace flaneur {

// Where a text begins: the left end of its base line, and `anchor` moved by `shift`.
struct TextPlace {
    glm::vec3 anchor{0};  // metres; on the picture, shares of its width and height
    glm::vec2 shift{0};   // pixels to the right and down
    GizmoPlace place = GizmoPlace::in_world;
};

// Appends one line of ASCII whose capitals are `height` pixels tall, on a soft dark edge. What is no
// printable ASCII is shown as a box.
void add_text(std::vector<GizmoLine>& lines, const TextPlace& where, std::string_view text, uint32_t colour,
              float height);

// How wide it is, pixels.
float text_width(std::string_view text, float height);

}  // namespace flaneur
