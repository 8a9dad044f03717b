// What a picture shows besides its light, as files (Image in renderer.h). Each says by the ending of its path
// how it is written; rows are from the top.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/flaneur/output/output.h"

namespace flaneur {

// How far away each pixel is, metres, infinite where there is nothing. In a .png of 16 bits of grey:
// centimetres, rounded, 65534 for all that is farther, 0 for nothing. In an .exr: metres, the channel Z of 32
// bits, 0 for nothing. Else as a portable float map, .pfm: the same, rows from the bottom, the least byte
// first.
Result<void> write_depths(PartFilePtr file, const std::vector<float>& depths, Size size);

// Whose each pixel is, below 2^24. In an .exr: the channel id of 32 bits, unsigned. Else as a .png of 8 bits
// a channel: red + 256 green + 65536 blue.
Result<void> write_ids(PartFilePtr file, const std::vector<uint32_t>& ids, Size size);

// Where the legend of ids goes: beside them, as .json.
std::string legend_path(const std::string& ids);

}  // namespace flaneur
