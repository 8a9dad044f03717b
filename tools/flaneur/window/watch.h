// All that looks at every tick.
#pragma once

namespace flaneur {

struct Show;
struct Viewer;

// After each tick. `is_new`: it has not been made before; else it is one of the past that is gone through
// again, whose people have been counted.
void watch_tick(const Show& show, Viewer& viewer, bool is_new);

}  // namespace flaneur
