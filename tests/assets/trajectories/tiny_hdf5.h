// A file as the Juelich data archive has them, made by hand: one group, one data set, two attributes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace flaneur {

struct HdfRow {
    int64_t id = 0, frame = 0;
    double x = 0, y = 0, z = 0;
};

std::string tiny_hdf5(const std::vector<HdfRow>& rows, double fps, std::string_view wkt);

}  // namespace flaneur
