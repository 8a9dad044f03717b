// terrain_seeds FOLDER: small elevation files for the fuzzer to begin with.
#include <zip.h>

#include "tests/assets/tiny/terrain.h"
#include "tests/fuzz/seeds.h"

namespace {

using namespace flaneur;

// An archive of `file`, which it goes by another name in.
void zip_up(const std::string& path, const std::string& file, const char* name) {
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    zip_source_t* source = archive ? zip_source_file(archive, file.c_str(), 0, -1) : nullptr;
    if (!source || zip_file_add(archive, name, source, 0) < 0 || zip_close(archive) != 0) {
        std::cerr << "Cannot write " << path << "\n";
        std::exit(1);
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::filesystem::path folder = seeds_folder(argc, argv);
    auto hill = [](int column, int row) { return column % 97 == 3 ? -32768 : (column + 2 * row) / 8; };
    int number = 0;
    for (bool floats : {false, true})
        for (bool tiled : {false, true})
            for (int compression : {COMPRESSION_NONE, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_LZW,
                                    COMPRESSION_PACKBITS, COMPRESSION_ZSTD, COMPRESSION_LZMA}) {
                auto packed = static_cast<uint16_t>(compression);
                if (!TIFFIsCODECConfigured(packed)) continue;
                write_tiff((folder / (std::to_string(++number) + ".tif")).string(), 61, 50,
                           {floats, tiled, floats, 2, packed}, hill);
            }
    // The beginning of a tile: as it is cut short, and as the target draws it out.
    write_hgt((folder / "short.hgt").string(), 77, hill);
    write_seed(folder / "odd.hgt", std::string(77, '\1'));
    std::string tile = (folder / "tile").string();
    write_hgt(tile, 1201, [](int, int row) { return row / 64; });
    zip_up((folder / "tile.zip").string(), tile, "N43E007.hgt");
    zip_up((folder / "below.zip").string(), tile, "a/N43E007.HGT");
    std::filesystem::remove(tile);
}
