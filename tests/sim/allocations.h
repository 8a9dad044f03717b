#pragma once

#include <cstddef>

namespace flaneur {

// How often operator new was called in this program so far, on any thread.
size_t allocations();

}  // namespace flaneur
