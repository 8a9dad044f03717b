// Colours of the timeline. Private to tools/flaneur/window/time.
#pragma once

#include <cstdint>

#include "tools/flaneur/history/events.h"

namespace flaneur {

inline constexpr uint32_t k_event_colours[k_event_kinds] = {0xe7b23c, 0xe2604a, 0xd98ad0, 0x7fc97a};

}  // namespace flaneur
