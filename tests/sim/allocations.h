#pragma once

#include <cstddef>

namespace flaneur {

// How often memory was asked for in this program so far, by operator new at least, on any thread. Under
// sanitizers on the calling thread: what starts another, whenever that comes to run, asks for memory there.
size_t allocations();

}  // namespace flaneur
