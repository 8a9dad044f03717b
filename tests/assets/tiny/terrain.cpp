#include "tests/assets/tiny/terrain.h"

#include <cstdlib>
#include <fstream>
#include <vector>

namespace flaneur {

void write_hgt(const std::string& path, int side, const HeightOf& height) {
    std::ofstream file(path, std::ios::binary);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            int h = height(column, row);
            file.put(static_cast<char>(h >> 8)).put(static_cast<char>(h));
        }
    }
}

void write_tiff(const std::string& path, uint32_t columns, uint32_t rows, const TiffKind& kind,
                const HeightOf& height) {
    static const TIFFFieldInfo k_fields[] = {
        {33550, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelPixelScale")},
        {33922, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("ModelTiepoint")},
        {34735, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeyDirectory")},
    };
    TIFF* tiff = TIFFOpen(path.c_str(), "w");
    if (!tiff) std::abort();
    TIFFMergeFieldInfo(tiff, k_fields, 3);
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, columns);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, rows);
    TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, kind.floats ? 32 : 16);
    TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, kind.floats ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_INT);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, kind.compression);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    double half = kind.point ? 0 : 0.5;
    double scale[3] = {1.0 / 1200, 1.0 / 1200, 0}, tie[6] = {half, half, 0, 7.40, 43.75, 0};
    uint16_t raster = kind.point ? 2 : 1;
    uint16_t keys[] = {1, 1, 0, 3, 1024, 0, 1, kind.model, 1025, 0, 1, raster, 3072, 0, 1, 32632};
    TIFFSetField(tiff, 33550, 3, scale);
    TIFFSetField(tiff, 33922, 6, tie);
    TIFFSetField(tiff, 34735, 16, keys);
    uint32_t block = kind.tiled ? 32 : columns, high = kind.tiled ? 32 : 1;
    if (kind.tiled) {
        TIFFSetField(tiff, TIFFTAG_TILEWIDTH, block);
        TIFFSetField(tiff, TIFFTAG_TILELENGTH, high);
    } else {
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 7);
    }
    for (uint32_t y = 0; y < rows; y += high) {
        for (uint32_t x = 0; x < columns; x += block) {
            std::vector<float> floats;
            std::vector<int16_t> whole;
            for (uint32_t i = 0; i < block * high; ++i) {
                int h = height(static_cast<int>(x + i % block), static_cast<int>(y + i / block));
                floats.push_back(static_cast<float>(h));
                whole.push_back(static_cast<int16_t>(h));
            }
            void* data = kind.floats ? static_cast<void*>(floats.data()) : whole.data();
            bool written = kind.tiled ? TIFFWriteTile(tiff, data, x, y, 0, 0) >= 0
                                      : TIFFWriteScanline(tiff, data, y, 0) >= 0;
            if (!written) std::abort();
        }
    }
    TIFFClose(tiff);
}

}  // namespace flaneur
