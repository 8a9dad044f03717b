// Small elevation files, to be read as they are or broken first.
#pragma once

#include <tiffio.h>

#include <cstdint>
#include <functional>
#include <string>

namespace flaneur {

using HeightOf = std::function<int(int column, int row)>;

// An SRTM tile of so many samples a side.
void write_hgt(const std::string& path, int side, const HeightOf& height);

struct TiffKind {
    bool floats = false, tiled = false, point = true;
    uint16_t model = 2, compression = COMPRESSION_NONE;
};

// A GeoTIFF: 1/1200 of a degree a sample, the first one at 7.40, 43.75. Ends the program where it cannot be
// written.
void write_tiff(const std::string& path, uint32_t columns, uint32_t rows, const TiffKind& kind,
                const HeightOf& height);

}  // namespace flaneur
