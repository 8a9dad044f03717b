// picture_seeds FOLDER: small pictures for the fuzzer to begin with.
#include "tests/assets/tiny/pictures.h"
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    using namespace flaneur;
    std::filesystem::path folder = seeds_folder(argc, argv);
    int number = 0;
    auto write = [&](const char* ending, const Bytes& bytes) {
        write_seed(folder / (std::to_string(++number) + ending), bytes);
    };
    for (bool interlaced : {false, true}) {
        for (int bits : {1, 8, 16}) write(".png", png_of({PNG_COLOR_TYPE_GRAY, bits, interlaced}));
        for (bool see_through : {false, true}) {
            write(".png", png_of({PNG_COLOR_TYPE_PALETTE, 4, interlaced, see_through}));
            write(".png", png_of({PNG_COLOR_TYPE_RGB, 8, interlaced, see_through}));
        }
        write(".png", png_of({PNG_COLOR_TYPE_RGBA, 16, interlaced}));
    }
    for (bool progressive : {false, true}) {
        write(".jpg", jpeg_of(JCS_GRAYSCALE, 1, progressive));
        write(".jpg", jpeg_of(JCS_RGB, 3, progressive));
        write(".jpg", jpeg_of(JCS_CMYK, 4, progressive));
    }
    for (bool lossless : {false, true}) write(".webp", webp_of(lossless));
}
