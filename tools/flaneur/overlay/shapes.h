// Figures of lines: what gizmos are put together from. Colours are sRGB and alpha, R in the lowest byte.
#pragma once

#include <vector>

#include "renderer/scene.h"

namespace flaneur {

// How the lines of a figure are drawn; their ends are the figure's.
using Pen = GizmoLine;

// 0xrrggbb and an opacity 0..1 as gizmos take them.
constexpr uint32_t ink(uint32_t rgb, float opacity = 1) {
    return static_cast<uint32_t>(opacity * 255 + 0.5f) << 24 | (rgb & 0xff) << 16 | (rgb & 0xff00) |
           rgb >> 16;
}

void add_line(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 a, glm::vec3 b);
void add_point(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 at);
// The head is a fifth of the length, at most 0.12 m, and lies square to `up`.
void add_arrow(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 from, glm::vec3 to, glm::vec3 up);
// About a unit normal.
void add_circle(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 middle, glm::vec3 normal,
                float radius);
// From `from` over to `to`, `rise` metres above the line between both in its middle.
void add_arc(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 from, glm::vec3 to, float rise);
// Three short lines along the axes.
void add_cross(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 at, float reach);
// The outline of a shoe: `heel` and `tip` are its ends on the ground, `normal` the ground's.
void add_footprint(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 heel, glm::vec3 tip,
                   glm::vec3 normal);
// A filled circle.
void add_disc(std::vector<GizmoCorner>& fills, glm::vec3 middle, glm::vec3 normal, float radius,
              uint32_t colour);

}  // namespace flaneur
