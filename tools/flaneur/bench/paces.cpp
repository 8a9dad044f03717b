#include "tools/flaneur/bench/paces.h"

#include <cmath>
#include <iterator>

#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

struct Part {
    const char* name;
    bool moves, has_panels;
};
constexpr Part k_parts[] = {{"at rest", false, false},
                            {"at rest, panels", false, true},
                            {"moving", true, false},
                            {"moving, panels", true, true}};
constexpr uint32_t k_settling = 12;  // pictures that do not count
constexpr float k_turn = 0.004f;     // radians a picture
constexpr uint32_t k_there = 60;     // pictures, and as many back

}  // namespace

Steering lead(const Paces& paces, Viewer& v) {
    const Part& part = k_parts[paces.part];
    v.has_panels = part.has_panels;
    v.room = part.has_panels ? Room::gait : Room::none;
    v.selected.reset();
    if (part.has_panels) v.selected = 0;
    if (!part.moves) return {};
    return {.turn = paces.shown / k_there % 2 == 0 ? k_turn : -k_turn};
}

void note_picture(Paces& paces, double seconds, float resolution) {
    const Part& part = k_parts[paces.part];
    if (paces.shown >= k_settling) add_sample(paces.figures, part.name, 1e3 * seconds);
    if (++paces.shown < k_settling + paces.pictures) return;
    paces.figures.counts.emplace_back(std::string(part.name) + ", percent of the window's pixels each way",
                                      std::lround(100 * resolution));
    ++paces.part;
    paces.shown = 0;
}

bool are_over(const Paces& paces) { return paces.part >= std::size(k_parts); }

}  // namespace flaneur
