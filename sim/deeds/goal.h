// Where one comes to stand for a deed, and how one gets there.
#pragma once

#include "sim/deeds/deeds.h"

namespace flaneur {

struct Spot {
    Vec2 at;
    float heading = 0;
};
// What legs are to do.
struct DoerWish {
    Vec2 wish{};  // m/s
    Vec2 look{};  // unit; none: as it is
};

// Along a line that leads to the goal from behind, slower and slower.
DoerWish wish_to(const Doer& doer, const Spot& goal, float speed);
// Whether it stands there, feet and all, within a few centimetres and degrees.
bool is_at(const Deeds& deeds, size_t doer, const Spot& goal);
// Steps backward from a goal.
DoerWish wish_back(const Spot& goal);

Someone someone(const Deeds& deeds, size_t doer);
float toes_ahead(const Deeds& deeds, size_t doer);  // metres from its root
void next_stage_of(Doer& doer, DoerStage stage);
void next_deed(Deeds& deeds, Doer& doer, size_t number);
const Deed& deed_of(const Deeds& deeds, size_t doer);

inline float seconds_in(const Doer& doer) { return static_cast<float>(doer.since) / 60; }

}  // namespace flaneur
