// The room Measure: distances, areas, counting lines and zones, drawn on the ground with a few clicks.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/flaneur/measure/count.h"

namespace flaneur {

enum class MarkingKind : uint8_t { distance, area, line, zone };
inline constexpr const char* k_drawn_names[] = {"Distance", "Area", "Line", "Zone"};

// What has been drawn, corner after corner, metres.
struct Marking {
    MarkingKind kind = MarkingKind::distance;
    std::string name;  // D1, A1, L1, Z1
    std::vector<glm::vec3> points;
    bool operator==(const Marking&) const = default;
};
inline bool is_closed(MarkingKind kind) { return kind == MarkingKind::area || kind == MarkingKind::zone; }

// 0xrrggbb, of those who cross a line to its right and to its left.
inline constexpr uint32_t k_right_rgb = 0xf2c14e, k_left_rgb = 0x7cc6d6;
// Where to they go on a map: "N", "NE", "E", ..; `side` is 1 for the right and -1 for the left.
const char* compass(const CountLine& line, int side);

// What was drawn before or after the deed of that number; see Viewer::deeds.
struct DrawnBefore {
    std::vector<Marking> drawn;
    uint64_t deed = 0;
};

struct MeasureRoom {
    std::optional<MarkingKind> tool;  // is being drawn with; else what is there is chosen and dragged
    std::vector<glm::vec3> draft;     // what is not finished
    std::optional<glm::vec3> under;   // where the next click would be
    std::vector<Marking> drawn;
    std::optional<size_t> selected;          // of `drawn`
    std::optional<size_t> hovered;           // the same, under the cursor,
    std::optional<size_t> handle;            // and the point of the selected one that is,
    bool is_dragging = false;                // or is dragged
    std::vector<DrawnBefore> before, after;  // for going back, and on again
    Counts counts;
    double clicked_at = -1e9;  // of the window's time: a second click soon after finishes
    glm::vec2 clicked{0};
    char csv[256] = "out/measures.csv", json[256] = "measures.json";
    // On the ground, for drawing: of each that is drawn; made anew where they are fewer. Of zones, triangles
    // that fill them too.
    std::vector<std::vector<glm::vec3>> outlines, fills;
    std::vector<double> walkable;  // of the fills, square metres
};

// Metres along the points, as the ground lies and as a map shows it.
struct Length {
    double along = 0, flat = 0;
};
Length length_of(const std::vector<glm::vec3>& points, bool is_closed);
// Of what is drawn, on a map.
std::vector<Vec2> on_map(const std::vector<glm::vec3>& points);
// The lines and zones among all that is drawn.
MeasurePlan plan_of(const std::vector<Marking>& drawn);

}  // namespace flaneur
