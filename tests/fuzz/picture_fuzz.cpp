// libFuzzer's target for the pictures of textures: any bytes are decoded or are refused.
#include <cstdlib>

#include "assets/files/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    constexpr size_t k_most_pixels =
        1'000'000;  // of a texture 32 times as many, which would take as much longer
    auto picture = decode_picture({data, size}, k_most_pixels);
    if (!picture) return 0;
    if (picture->width < 1 || picture->height < 1) std::abort();
    size_t pixels = static_cast<size_t>(picture->width) * static_cast<size_t>(picture->height);
    if (pixels > k_most_pixels || picture->rgba.size() != 4 * pixels) std::abort();
    return 0;
}
