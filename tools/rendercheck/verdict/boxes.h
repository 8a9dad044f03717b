// Where pictures differ.
#pragma once

#include <vector>

#include "tools/rendercheck/verdict/verdict.h"

namespace flaneur {

// The most pixels beyond `limit` that lie in one window of `side` pixels each way, at any place; where, the
// first in reading order. Windows lie within the picture, and are the picture where that is smaller.
int densest_window(const std::vector<float>& differences, int width, float limit, int side, PixelBox& where);

// Pixels beyond `limit` with no more than 8 pixels between them, as boxes, most pixels first. Those that are
// too many are counted in `more`.
std::vector<ChangedBox> changed_boxes(const std::vector<float>& differences, int width, float limit,
                                      size_t& more);

}  // namespace flaneur
