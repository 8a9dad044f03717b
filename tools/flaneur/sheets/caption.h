// Small plain letters on pictures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/flaneur/options/options.h"

namespace flaneur {

// Writes one line of ASCII onto an RGBA picture, its upper left corner at (x, y). Letters are some 7 *
// `scale` pixels tall; what does not fit is cut off.
void draw_caption(std::vector<uint8_t>& rgba, Size size, int x, int y, int scale, const std::string& line);

}  // namespace flaneur
