#include "tools/flaneur/overlay/shapes.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

namespace {

constexpr int k_round = 20;  // sides of a circle
constexpr float k_turn = 6.2831853f;

// Two unit vectors square to a unit normal and to each other.
struct Plane {
    glm::vec3 x, y;
};
Plane plane_of(glm::vec3 normal) {
    const glm::vec3 aside = std::fabs(normal.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 x = glm::normalize(glm::cross(aside, normal));
    return {x, glm::cross(normal, x)};
}

glm::vec3 on_circle(const Plane& plane, glm::vec3 middle, float radius, int i) {
    const float angle = k_turn * static_cast<float>(i % k_round) / k_round;
    return middle + radius * (std::cos(angle) * plane.x + std::sin(angle) * plane.y);
}

}  // namespace

void add_line(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 a, glm::vec3 b) {
    lines.push_back(pen);
    lines.back().a = a;
    lines.back().b = b;
}

void add_point(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 at) { add_line(lines, pen, at, at); }

void add_arrow(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 from, glm::vec3 to, glm::vec3 up) {
    const glm::vec3 way = to - from;
    const float length = glm::length(way);
    if (!(length > 1e-3f)) return;
    const float head = std::min(0.2f * length, 0.12f);
    const glm::vec3 ahead = way / length;
    const glm::vec3 across = glm::cross(up, ahead);
    add_line(lines, pen, from, to);
    for (float side : {-0.5f, 0.5f}) add_line(lines, pen, to, to - head * (ahead + side * across));
}

void add_circle(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 middle, glm::vec3 normal,
                float radius) {
    const Plane plane = plane_of(normal);
    for (int i = 0; i < k_round; ++i)
        add_line(lines, pen, on_circle(plane, middle, radius, i), on_circle(plane, middle, radius, i + 1));
}

void add_arc(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 from, glm::vec3 to, float rise) {
    constexpr int pieces = 14;
    auto at = [&](int i) {
        const float t = static_cast<float>(i) / pieces;
        return glm::mix(from, to, t) + glm::vec3(0, 4 * rise * t * (1 - t), 0);
    };
    for (int i = 0; i < pieces; ++i) add_line(lines, pen, at(i), at(i + 1));
}

void add_cross(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 at, float reach) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 arm(0);
        arm[axis] = reach;
        add_line(lines, pen, at - arm, at + arm);
    }
}

void add_footprint(std::vector<GizmoLine>& lines, const Pen& pen, glm::vec3 heel, glm::vec3 tip,
                   glm::vec3 normal) {
    // Along and half across, as shares of the length.
    constexpr float outline[][2] = {{0, 0},          {0.02f, 0.09f}, {0.12f, 0.13f},
                                    {0.35f, 0.115f}, {0.55f, 0.14f}, {0.72f, 0.18f},
                                    {0.86f, 0.16f},  {0.96f, 0.09f}, {1, 0}};
    const glm::vec3 way = tip - heel, across = glm::cross(normal, way);
    for (float side : {-1.0f, 1.0f})
        for (size_t i = 1; i < std::size(outline); ++i)
            add_line(lines, pen, heel + outline[i - 1][0] * way + side * outline[i - 1][1] * across,
                     heel + outline[i][0] * way + side * outline[i][1] * across);
}

void add_disc(std::vector<GizmoCorner>& fills, glm::vec3 middle, glm::vec3 normal, float radius,
              uint32_t colour) {
    const Plane plane = plane_of(normal);
    for (int i = 0; i < k_round; ++i) {
        fills.push_back({middle, colour});
        fills.push_back({on_circle(plane, middle, radius, i), colour});
        fills.push_back({on_circle(plane, middle, radius, i + 1), colour});
    }
}

}  // namespace flaneur
