// How people come in and leave: through doors, where the house hides them, and else by coming into sight and
// going out of it where they are.
//
// Who leaves by a door goes straight on through it and is gone a metre behind the wall; who comes in by one
// begins there. One at a time goes through a door. While it does it is beside the mesh, as one is from under
// whose feet the mesh has gone: others make room for it and it for them.
#pragma once

#include "sim/crowd/crowd.h"

namespace flaneur {

// Puts a walker that has just come in behind the door, from where it goes to where it stands now.
void come_by_door(Crowd& crowd, uint32_t walker, const Door& door, uint32_t tick);
// Or lets it come into sight where it stands.
void appear(Crowd& crowd, uint32_t walker);

// Whether one who is to leave is out of sight. If not, it is brought to be: it goes through the door that it
// faces, waits for it, gets before it once more, also if others hold it up there, or, where that cannot be,
// goes out of sight where it stands.
bool has_left(Crowd& crowd, const Surroundings& around, uint32_t walker, uint32_t tick);

// Whether somebody goes through this door, or through one so near that they would meet behind it.
bool is_in_use(const Crowd& crowd, const Door& door);

// A tick of all who come in or leave.
void step_passages(Crowd& crowd);

// How much is seen of one who comes in or leaves, 0..1, `between` 0, the tick before the last, and 1, the
// last. Of all others everything is.
float presence(const Passage& passage, float between);

}  // namespace flaneur
