#include "assets/osm/read/blobs.h"

#include <algorithm>
#include <fstream>
#include <istream>
#include <protozero/pbf_reader.hpp>
#include <protozero/varint.hpp>

namespace flaneur {

// Enough for libosmium's threads to be busy with, and little enough for several to be in memory.
static constexpr size_t k_stretch = size_t{1} << 20;
// What libosmium takes, bytes.
static constexpr size_t k_most_frame = 64 << 10, k_most_blob = 32 << 20;

static uint64_t file_size(std::istream& file) {
    return static_cast<uint64_t>(file.seekg(0, std::ios::end).tellg());
}

// Fewer bytes where the file ends before.
static std::string read_at(std::istream& file, uint64_t at, size_t size) {
    std::string bytes(size, '\0');
    file.seekg(static_cast<std::streamoff>(at)).read(bytes.data(), static_cast<std::streamsize>(size));
    bytes.resize(static_cast<size_t>(file.gcount()));
    return bytes;
}

// A blob and what stands before it.
struct BlobFrame {
    size_t before = 0, size = 0;  // of all of it; 0: it is none
};

// The length of a message, four bytes from the highest on, and the message, which says how long the blob is.
static BlobFrame frame_at(std::istream& file, uint64_t at) {
    size_t frame = 0;
    for (char byte : read_at(file, at, 4)) frame = frame << 8 | static_cast<uint8_t>(byte);
    if (frame > k_most_frame) return {};
    std::string bytes = read_at(file, at + 4, frame);
    constexpr uint32_t k_blob_size = protozero::tag_and_type(3, protozero::pbf_wire_type::varint);
    int64_t blob = 0;
    for (protozero::pbf_reader message(bytes); message.next();)
        message.tag_and_type() == k_blob_size ? void(blob = message.get_int32()) : message.skip();
    if (blob <= 0 || blob > static_cast<int64_t>(k_most_blob)) return {};
    return {4 + frame, 4 + frame + static_cast<size_t>(blob)};
}

// What a blob says that it unpacks to: goes from field to field, and leaves out what is packed.
static uint64_t unpacked_blob(std::istream& file, uint64_t at, uint64_t end) {
    constexpr size_t k_head = 2 * protozero::max_varint_length;
    constexpr uint64_t k_raw = protozero::tag_and_type(1, protozero::pbf_wire_type::length_delimited),
                       k_raw_size = protozero::tag_and_type(2, protozero::pbf_wire_type::varint);
    uint64_t size = 0;
    while (at < end) {
        std::string head = read_at(file, at, k_head);
        const char* next = head.data();
        uint64_t tag = protozero::decode_varint(&next, head.data() + head.size()),
                 value = protozero::decode_varint(&next, head.data() + head.size());
        if (tag == k_raw || tag == k_raw_size) size = std::max(size, value);
        at += static_cast<uint64_t>(next - head.data());
        bool is_packed = (tag & 7) == static_cast<uint64_t>(protozero::pbf_wire_type::length_delimited);
        if (is_packed && value > end - std::min(at, end)) break;
        if (is_packed) at += value;
    }
    return std::min<uint64_t>(size, k_most_blob);
}

uint64_t unpacked_size(std::istream& file) {
    uint64_t end = file_size(file), sum = 0;
    try {
        for (uint64_t at = 0; at < end;) {
            BlobFrame frame = frame_at(file, at);
            if (frame.size == 0) break;
            sum += unpacked_blob(file, at + frame.before, std::min(end, at + frame.size));
            at += frame.size;
        }
    } catch (const protozero::exception&) {
        return sum;
    }
    return sum;
}

std::string PbfBlobs::bytes(const PbfStretch& stretch, bool only_first) const {
    std::ifstream file(path, std::ios::binary);
    return header + read_at(file, stretch.at, only_first ? stretch.first : stretch.size);
}

std::optional<PbfBlobs> blobs_of(const std::string& path) {
    PbfBlobs blobs{path, "", {}};
    std::ifstream file(path, std::ios::binary);
    uint64_t end = file_size(file);
    try {
        size_t size = frame_at(file, 0).size;
        if (size == 0 || size > end) return std::nullopt;
        blobs.header = read_at(file, 0, size);
        for (uint64_t at = size; at < end; at += size) {
            size = frame_at(file, at).size;
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
