// Geometry of JuPedSim's jpscore: rooms of subrooms, each a plane z = A_x x + B_y y + C_z whose outline is
// walls, and crossings and transitions to others.
#include <algorithm>
#include <cmath>
#include <map>

#include "assets/files/words.h"
#include "assets/trajectories/formats/xml.h"
#include "assets/trajectories/geometry.h"

namespace flaneur {
namespace {

constexpr float k_same = 0.005f;  // metres
constexpr size_t k_most_pieces = 100'000, k_most_in_room = 2'000;

using WallLine = std::vector<Vec2>;

struct Subroom {
    std::vector<WallLine> pieces;  // walls, and ways to others
    size_t walls = 0;              // of them, the first ones
    std::vector<WallLine> obstacles;
    float level = 0;
    Vec2 rise{};
};
// By room and subroom.
using Subrooms = std::map<std::pair<std::string, std::string>, Subroom>;

bool is_same_corner(Vec2 a, Vec2 b) { return length(a - b) < k_same; }

float ring_area(const WallLine& ring) {
    float twice = 0;
    for (size_t i = 0; i < ring.size(); ++i) twice += cross(ring[i], ring[(i + 1) % ring.size()]);
    return std::fabs(twice) / 2;
}

// Puts pieces end to end, as long as one fits.
WallLine chained(std::vector<WallLine>& pieces) {
    WallLine line = std::move(pieces.back());
    pieces.pop_back();
    while (!is_same_corner(line.front(), line.back()) || line.size() < 3) {
        const auto next = std::find_if(pieces.begin(), pieces.end(), [&](const WallLine& piece) {
            return is_same_corner(piece.front(), line.back()) || is_same_corner(piece.back(), line.back());
        });
        if (next == pieces.end()) break;
        if (!is_same_corner(next->front(), line.back())) std::reverse(next->begin(), next->end());
        line.insert(line.end(), next->begin() + 1, next->end());
        pieces.erase(next);
    }
    return line;
}

void add_subroom(WalkableGeometry& geometry, const std::string& name, Subroom room) {
    std::vector<WallLine> walls(room.pieces.begin(),
                                room.pieces.begin() + static_cast<std::ptrdiff_t>(room.walls));
    WalkablePolygon polygon{
        .outer = {}, .holes = std::move(room.obstacles), .level = room.level, .rise = room.rise};
    std::vector<WallLine> rings;
    size_t open = 0;
    while (!room.pieces.empty()) {
        WallLine line = chained(room.pieces);
        // Its beginning may go on too.
        std::reverse(line.begin(), line.end());
        room.pieces.push_back(std::move(line));
        line = chained(room.pieces);
        if (line.size() > 1 && is_same_corner(line.front(), line.back()))
            line.pop_back();
        else
            ++open;
        if (line.size() > 2) rings.push_back(std::move(line));
    }
    std::stable_sort(rings.begin(), rings.end(),
                     [](const WallLine& a, const WallLine& b) { return ring_area(a) > ring_area(b); });
    if (rings.empty()) {
        for (WallLine& wall : walls) geometry.walls.push_back(std::move(wall));
        return;
    }
    if (open > 0)
        geometry.assumed.push_back("The outline of " + name + " is open: its ends are joined straight.");
    polygon.outer = std::move(rings[0]);
    polygon.holes.insert(polygon.holes.end(), rings.begin() + 1, rings.end());
    geometry.area.push_back(std::move(polygon));
}

struct GeometryReader {
    Subrooms subrooms;
    size_t pieces = 0;
    std::string room, subroom;
    WallLine line;
    bool is_in_subroom = false, is_in_obstacle = false;
    std::vector<std::pair<std::string, std::string>> joins;  // what the way that is read joins
};

std::string begin_room(GeometryReader& r, std::string_view name, XmlAttributes a) {
    auto number = [&](std::string_view key) {
        float value = 0;
        return parse_number(a[key], value) && std::fabs(value) <= 1e5f ? value : 0;
    };
    if (name == "geometry" && a.has("unit") && a["unit"] != "m") return "a unit other than m";
    if (name == "room") r.room = a["id"];
    if (name == "subroom") {
        r.is_in_subroom = true;
        r.subroom = a["id"];
        Subroom& subroom = r.subrooms[{r.room, r.subroom}];
        subroom.level = number("C_z");
        subroom.rise = {number("A_x"), 0 - number("B_y")};
    }
    if (name == "obstacle") r.is_in_obstacle = true;
    if (name == "polygon" || name == "crossing" || name == "transition") r.line.clear();
    if (name == "crossing")
        r.joins = {{r.room, std::string(a["subroom1_id"])}, {r.room, std::string(a["subroom2_id"])}};
    if (name == "transition")
        r.joins = {{std::string(a["room1_id"]), std::string(a["subroom1_id"])},
                   {std::string(a["room2_id"]), std::string(a["subroom2_id"])}};
    if (name == "vertex") {
        auto coordinate = [](std::string_view text, float& to) {
            while (text.ends_with(' ')) text.remove_suffix(1);
            while (text.starts_with(' ')) text.remove_prefix(1);
            return parse_number(text, to) && std::fabs(to) <= 1e5f;
        };
        Vec2 at{};
        if (!coordinate(a["px"], at.x) || !coordinate(a["py"], at.z))
            return "a vertex without px and py within 100 km";
        at.z = 0 - at.z;
        if (++r.pieces > k_most_pieces) return "more vertices than are read";
        r.line.push_back(at);
    }
    return {};
}

std::string end_room(GeometryReader& r, std::string_view name) {
    if (name == "subroom") r.is_in_subroom = false;
    if (name == "obstacle") r.is_in_obstacle = false;
    if (name == "polygon" && r.is_in_subroom) {
        Subroom& subroom = r.subrooms[{r.room, r.subroom}];
        if (r.is_in_obstacle && r.line.size() > 1 && is_same_corner(r.line.front(), r.line.back()))
            r.line.pop_back();
        if (r.is_in_obstacle && r.line.size() > 2) subroom.obstacles.push_back(r.line);
        if (!r.is_in_obstacle && r.line.size() > 1) {
            subroom.pieces.push_back(r.line);
            ++subroom.walls;
        }
        if (subroom.pieces.size() > k_most_in_room) return "a subroom of very many walls";
    }
    // Ways stand after all subrooms of theirs.
    if ((name == "crossing" || name == "transition") && r.line.size() > 1)
        for (const auto& join : r.joins)
            if (const auto found = r.subrooms.find(join); found != r.subrooms.end()) {
                if (found->second.pieces.size() > k_most_in_room) return "a subroom of very many ways";
                found->second.pieces.push_back(r.line);
            }
    return {};
}

}  // namespace

Result<WalkableGeometry> parse_jps_geometry(std::string_view xml) {
    GeometryReader reader;
    Result<void> walked = walk_xml(
        xml, {.begin = [&](std::string_view name, XmlAttributes a) { return begin_room(reader, name, a); },
              .end = [&](std::string_view name, std::string_view) { return end_room(reader, name); }});
    if (!walked) return walked.error();
    WalkableGeometry geometry;
    for (auto& [name, subroom] : reader.subrooms)
        add_subroom(geometry, "subroom " + name.second + " of room " + name.first, std::move(subroom));
    if (geometry.area.empty() && geometry.walls.empty()) return Error{"has no room with walls"};
    return geometry;
}

}  // namespace flaneur
