// What is to be counted: lines that people cross and zones in which they are, over the ground plane, on every
// level: of a bridge and what is below it, both count. Metres, x to the east and z to the south.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/planar.h"
#include "sim/base/result.h"
#include "sim/base/vec.h"

namespace flaneur {

// From `a` to `b`. Its right is that of one who stands at `a` and looks to `b`.
struct CountLine {
    std::string name;  // letters, digits, - and _: files are called after it
    Vec2 a, b;
    bool operator==(const CountLine&) const = default;
};

// A polygon that does not cross itself, of any shape and either way round.
struct CountZone {
    std::string name;
    std::vector<Vec2> corners;
    bool operator==(const CountZone&) const = default;
};

// No two of them are called the same.
struct MeasurePlan {
    std::vector<CountLine> lines;
    std::vector<CountZone> zones;
    bool operator==(const MeasurePlan&) const = default;
};
inline bool is_empty(const MeasurePlan& plan) { return plan.lines.empty() && plan.zones.empty(); }

inline constexpr size_t k_most_corners = 200;
inline constexpr float k_least_line = 0.05f, k_least_zone = 0.05f;  // metres, square metres

float length_of(const CountLine& line);
// Whether no two of its edges cross or touch, but at the corners where they meet.
bool is_simple(std::span<const Vec2> corners);

// Triangles that fill a polygon which does not cross itself, three indices of its corners each, all one way
// round.
std::vector<uint32_t> fill_of(std::span<const Vec2> corners);

// "x,z/x,z" and "x,z/x,z/x,z...", with "NAME:" before it if it has one. Errors are sentences without a full
// stop that begin with the text.
Result<CountLine> parse_count_line(const std::string& text);
Result<CountZone> parse_count_zone(const std::string& text);
std::string told(const CountLine& line);
std::string told(const CountZone& zone);

// Names those without one L1, L2, .. and Z1, Z2, .. Refuses names that are there twice.
Result<void> name_all(MeasurePlan& plan);

// {"lines": [{"name", "from": [x, z], "to": [x, z]}], "zones": [{"name", "corners": [[x, z], ..]}]}
std::string plan_json(const MeasurePlan& plan);
// Errors begin with `name`, which is what the file is called.
Result<MeasurePlan> parse_plan(std::string_view json, const std::string& name);
Result<MeasurePlan> read_plan(const std::string& path);

}  // namespace flaneur
