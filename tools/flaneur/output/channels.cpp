#include "tools/flaneur/output/channels.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>

#include "assets/files/file.h"
#include "assets/files/picture.h"

namespace flaneur {
namespace {

// One channel of 32 bits.
template <class Value>
Result<void> write_exr(PartFilePtr f, const char* name, Imf::PixelType type, const std::vector<Value>& values,
                       Size size) {
    static_assert(sizeof(Value) == 4);
    Imf::StdOSStream bytes;
    {
        Imf::Header header(size.width, size.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        header.channels().insert(name, Imf::Channel(type));
        Imf::FrameBuffer pixels;
        pixels.insert(name, Imf::Slice::Make(type, values.data(), header.dataWindow()));
        Imf::OutputFile file(bytes, header, 0);
        file.setFrameBuffer(pixels);
        file.writePixels(size.height);
    }
    return write_compressed(std::move(f), bytes.str());
}

}  // namespace

Result<void> write_depths(PartFilePtr f, const std::vector<float>& depths, Size size) {
    static constexpr float k_most = 65534;
    const auto width = static_cast<size_t>(size.width), height = static_cast<size_t>(size.height);
    assert(depths.size() == width * height);
    if (has_ending(f->path, ".png")) {
        std::vector<uint16_t> centimetres(depths.size());
        std::transform(depths.begin(), depths.end(), centimetres.begin(), [](float metres) {
            if (std::isinf(metres)) return uint16_t{0};
            return static_cast<uint16_t>(std::clamp(std::round(metres * 100), 1.0f, k_most));
        });
        return write_compressed(std::move(f),
                                encode_png(centimetres, size.width, size.height, "centimetres"));
    }
    std::vector<float> metres = depths;
    for (float& far : metres)
        if (std::isinf(far)) far = 0;
    if (has_ending(f->path, ".exr")) return write_exr(std::move(f), "Z", Imf::FLOAT, metres, size);
    std::fprintf(f->file, "Pf\n%d %d\n-1.0\n", size.width, size.height);
    for (size_t y = height; y-- > 0;) std::fwrite(&metres[y * width], sizeof(float), width, f->file);
    return keep_file(std::move(f));
}

Result<void> write_ids(PartFilePtr f, const std::vector<uint32_t>& ids, Size size) {
    assert(ids.size() == static_cast<size_t>(size.width) * static_cast<size_t>(size.height));
    if (has_ending(f->path, ".exr")) return write_exr(std::move(f), "id", Imf::UINT, ids, size);
    std::vector<uint8_t> rgb;
    rgb.reserve(ids.size() * 3);
    for (const uint32_t id : ids)
        for (const uint32_t shift : {0u, 8u, 16u}) rgb.push_back(static_cast<uint8_t>(id >> shift & 0xffu));
    return write_compressed(std::move(f), encode_png(rgb, size.width, size.height, 3));
}

std::string legend_path(const std::string& ids) { return ids.substr(0, ids.rfind('.')) + ".json"; }

}  // namespace flaneur
