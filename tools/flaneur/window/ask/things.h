// What of a city is under the cursor, and what is known of it.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/city.h"

namespace flaneur {

enum class ThingKind : uint8_t {
    ground,
    building,
    wall,
    prop,
    model
};  // model: of a city that was brought in

struct Thing {
    ThingKind kind = ThingKind::ground;
    uint32_t index = 0;  // of the ground triangle, the building, the face, the prop; of a model's solid
    float distance = 0;  // metres from the eye
    Vec3 place, normal;
};
// Whether two of them are one: places on one kind of ground, a face of one building.
bool is_same(const Thing& a, const Thing& b);

// A city, so that its things are found quickly.
struct CityIndex {
    struct House {
        Vec3 low{1e9f, 1e9f, 1e9f}, high{-1e9f, -1e9f, -1e9f};
        std::vector<uint32_t> faces, roofs;  // indices of both
    };
    std::shared_ptr<const City> city;
    std::vector<House> houses;
};
CityIndex index_things(std::shared_ptr<const City> city);

// The first thing from `eye` along `way`, a unit vector, within 3 km; props are passed through if so asked.
std::optional<Thing> thing_along(const CityIndex& index, Vec3 eye, Vec3 way, bool meets_props = true);

// Of a building: what it covers of the ground, square metres, by where its walls stand; none where these do
// not close.
std::optional<double> footprint_of(const CityIndex& index, uint32_t building);
// How many storeys its windows show; none where it has no windows.
std::optional<int> storeys_of(const Building& building);

// What it is, in a few words, and what is known of it, a line each.
struct ThingFacts {
    std::string title;
    std::vector<std::string> lines;
};
ThingFacts facts_of(const CityIndex& index, const Thing& thing);

// Its edges, two ends each.
std::vector<std::pair<glm::vec3, glm::vec3>> outline_of(const CityIndex& index, const Thing& thing);

const char* told(Surface surface);
const char* told(DestinationKind kind);

}  // namespace flaneur
