// The blobs that a .pbf is packed in, so that who goes through it again unpacks only those with what is
// wanted. Private to assets/osm/read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace flaneur {

// Blobs in a row, about a megabyte.
struct PbfStretch {
    uint64_t at = 0;             // in the file, bytes
    size_t size = 0, first = 0;  // of all of them and of the first
};

struct PbfBlobs {
    std::string path, header;  // the first blob of the file, without which no other can be read
    std::vector<PbfStretch> stretches;
    // Of the first stretch that begins with no node, and of the first that begins with a relation; see
    // held_by.
    size_t ways = 0, relations = 0;

    // Again a .pbf: the header, and the beginning of a stretch or all of it.
    std::string bytes(const PbfStretch& stretch, bool only_first = false) const;
};

// Goes from frame to frame and unpacks nothing. None if they do not fill the file to its end.
std::optional<PbfBlobs> blobs_of(const std::string& path);

// How many bytes the blobs of a .pbf say that they unpack to, as far as they can be told apart; libosmium
// goes by what they say.
uint64_t unpacked_size(std::istream& file);

}  // namespace flaneur
