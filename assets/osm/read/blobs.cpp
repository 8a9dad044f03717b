#include "assets/osm/read/blobs.h"

#include <fstream>
#include <protozero/pbf_reader.hpp>

namespace flaneur {

// Enough for libosmium's threads to be busy with, and little enough for several to be in memory.
static constexpr size_t k_stretch = size_t{1} << 20;
// What libosmium takes, bytes.
static constexpr size_t k_most_frame = 64 << 10, k_most_blob = 32 << 20;

// Fewer bytes where the file ends before.
static std::string read_at(std::ifstream& file, uint64_t at, size_t size) {
    std::string bytes(size, '\0');
    file.seekg(static_cast<std::streamoff>(at)).read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<size_t>(file.gcount()));
    return bytes;
}

// A blob with what stands before it: the length of a message, four bytes from the highest on, and the
// message, which says how long the blob is. 0 if it is none.
static size_t framed_size(std::ifstream& file, uint64_t at) {
    size_t frame = 0;
    for (char byte : read_at(file, at, 4)) frame = frame << 8 | static_cast<uint8_t>(byte);
    if (frame > k_most_frame) return 0;
    std::string bytes = read_at(file, at + 4, frame);
    constexpr uint32_t k_blob_size = protozero::tag_and_type(3, protozero::pbf_wire_type::varint);
    int64_t blob = 0;
    for (protozero::pbf_reader message(bytes); message.next();)
        message.tag_and_type() == k_blob_size ? void(blob = message.get_int32()) : message.skip();
    return blob > 0 && blob <= static_cast<int64_t>(k_most_blob) ? 4 + frame + static_cast<size_t>(blob) : 0;
}

std::string PbfBlobs::bytes(const PbfStretch& stretch, bool only_first) const {
    std::ifstream file(path, std::ios::binary);
    return header + read_at(file, stretch.at, only_first ? stretch.first : stretch.size);
}

std::optional<PbfBlobs> blobs_of(const std::string& path) {
    PbfBlobs blobs{path, "", {}};
    std::ifstream file(path, std::ios::binary);
    auto end = static_cast<uint64_t>(file.seekg(0, std::ios::end).tellg());
    try {
        size_t size = framed_size(file, 0);
        if (size == 0 || size > end) return std::nullopt;
        blobs.header = read_at(file, 0, size);
        for (uint64_t at = size; at < end; at += size) {
            size = framed_size(file, at);
            if (size == 0 || size > end - at) return std::nullopt;
            if (blobs.stretches.empty() || blobs.stretches.back().size >= k_stretch)
                blobs.stretches.push_back({at, 0, size});
            blobs.stretches.back().size += size;
        }
    } catch (const protozero::exception&) {
        return std::nullopt;
    }
    return blobs;
}

}  // namespace flaneur
