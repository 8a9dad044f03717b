#pragma once

#include <cstddef>

namespace flaneur {

// How often memory was asked for in this program so far, by operator new at least, on any thread.
size_t allocations();

}  // namespace flaneur
