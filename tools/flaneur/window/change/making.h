// A changed city is made beside the window, which goes on meanwhile.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assets/additions.h"
#include "renderer/renderer.h"
#include "sim/navigation/navmesh.h"

namespace flaneur {

struct Show;

// What is to be made, apart from everything that goes on.
struct Order {
    std::shared_ptr<const City> bare, city;   // without anything added, and as it is
    std::vector<Addition> before, added;      // what is added to `city`, and to the one that is made
    std::string mesh;                         // bytes of the mesh of `city`,
    NavmeshSettings settings;                 // and what it was made with
    bool with_lamps = false;                  // the light of lamps too
    std::vector<Vec2> ground_before, ground;  // outlines of a platform; none: it is no platform
    int threads = 0;
};
struct Made {
    std::vector<Addition> added;
    std::vector<Vec2> ground;
    std::shared_ptr<const City> bare;  // of another platform; else null
    std::shared_ptr<const City> city;  // null: the city stays, and only lamps were made
    NavmeshPtr mesh;
    std::vector<Rectangle> changed;
    std::shared_ptr<const PreparedCity> drawn;
    std::optional<LampMap> lamps;
};
// Where nothing differs, only lamps are made. Refuses, in a sentence, what add_to_city() refuses.
Result<Made> make(const Order& order);

struct Making {
    std::future<Result<Made>> coming;
    bool is_lamps = false;  // alone
};
inline bool is_making(const Making& making) { return making.coming.valid(); }
void begin(Making& making, Order order);
// If it is done.
std::optional<Result<Made>> finish(Making& making);

// Between two ticks: people walk in it from now on, and it is drawn. The renderer may hold the one that was
// drawn.
Result<void> move_in(Show& show, Made made, bool holds_old = false);

}  // namespace flaneur
