// Pieces of SVG pictures, as texts.
#pragma once

#include <string>
#include <string_view>

namespace flaneur {

// `pattern` as printf has it, of numbers.
std::string printed(const char* pattern, double a, double b = 0, double c = 0, double d = 0);

// Text as SVG and HTML have it: <, >, &, " and ' are written out, control characters left out.
std::string escaped(std::string_view text);

// Opens a white picture of so many pixels, up to which `style` (CSS of the classes in it) applies to its
// texts and lines; "</svg>" closes it.
std::string svg_begin(double width, double height, std::string_view style);

// A line of text whose left end is there, or whose right end or middle where its class is so anchored.
std::string svg_label(double x, double y, std::string_view classes, std::string_view text);

// A round distance between grid lines, 1, 2, 5, 10 ..: five of them at most.
double grid_step(double span);

}  // namespace flaneur
