// Colours of the timeline. Private to tools/flaneur/window/time.
#pragma once

#include <imgui.h>

#include "tools/flaneur/history/events.h"

namespace flaneur {

// 0xrrggbb.
inline ImU32 panel_colour(uint32_t rgb, float alpha = 1) {
    return IM_COL32(rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255, static_cast<int>(alpha * 255));
}

inline constexpr uint32_t k_event_colours[k_event_kinds] = {0xe7b23c, 0xe2604a, 0xd98ad0, 0x7fc97a};

}  // namespace flaneur
