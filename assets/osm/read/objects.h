// What is in a file, object by object, as libosmium gives it. Private to assets/osm/read.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/osm.hpp>
#include <osmium/thread/pool.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "assets/osm/read/blobs.h"
#include "assets/place.h"

namespace flaneur {

using osmium::io::File;
namespace kinds = osmium::osm_entity_bits;

// A file as libosmium takes it, and its blobs, if nodes, ways and relations stand in this order in them.
struct Input {
    File file;
    osmium::io::read_meta meta = osmium::io::read_meta::yes;
    std::optional<PbfBlobs> blobs{};
};

// Thrown where they do not.
struct Unsorted {};

// Threads that unpack. libosmium would leave two cores unused.
using Unpackers = osmium::thread::Pool;
inline Unpackers start_unpackers() {
    return Unpackers(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())));
}

// A stretch of a .pbf that is being unpacked.
struct OpenStretch {
    std::string bytes;
    osmium::io::Reader reader;
    OpenStretch(std::string packed, const Input& input, Unpackers& unpackers)
        : bytes(std::move(packed)),
          reader(File(bytes.data(), bytes.size(), "pbf"), kinds::nwr, input.meta, unpackers) {}
};

// Which kinds may be in the i-th stretch.
inline kinds::type held_by(const PbfBlobs& blobs, size_t i) {
    kinds::type held = kinds::nothing;
    if (i < blobs.ways) held |= kinds::node;
    if (i + 1 >= blobs.ways && i < blobs.relations) held |= kinds::way;
    if (i + 1 >= blobs.relations) held |= kinds::relation;
    return held;
}

// Finds where ways and relations begin: what the first blobs of few stretches begin with tells.
inline void find_kinds(Input& input) {
    Unpackers unpackers = start_unpackers();
    PbfBlobs& blobs = *input.blobs;
    auto first_of = [&](kinds::type kind) {
        auto at = std::partition_point(
            blobs.stretches.begin(), blobs.stretches.end(), [&](const PbfStretch& stretch) {
                OpenStretch open(blobs.bytes(stretch, true), input, unpackers);
                osmium::memory::Buffer buffer = open.reader.read();
                return buffer && kinds::from_item_type(buffer.begin()->type()) < kind;
            });
        return static_cast<size_t>(at - blobs.stretches.begin());
    };
    blobs.ways = first_of(kinds::way);
    blobs.relations = first_of(kinds::relation);
}

// Whether libosmium can go through its tags. Keys and values end with a zero each; one with a zero inside
// shifts those after it, and the last is then read from beyond the object.
inline bool has_whole_tags(const osmium::OSMObject& object) {
    const osmium::TagList& tags = object.tags();
    return std::count(tags.data() + sizeof tags, tags.data() + tags.byte_size(), '\0') % 2 == 0;
}

// Visits the objects of a file; `tell` hears how far it is.
template <class Object, class Visit>
void read_objects(const Input& input, kinds::type wanted, const TellProgress& tell, std::string_view what,
                  Visit visit) {
    Unpackers unpackers = start_unpackers();
    auto visit_all = [&](osmium::io::Reader& reader, kinds::type held, auto done) {
        while (osmium::memory::Buffer buffer = reader.read()) {
            for (const osmium::OSMObject& object : buffer.template select<osmium::OSMObject>()) {
                kinds::type kind = kinds::from_item_type(object.type());
                if ((kind & held) == 0) throw Unsorted();
                if ((kind & wanted) == 0) continue;
                if (!has_whole_tags(object)) throw std::runtime_error("a tag holds a zero");
                visit(static_cast<const Object&>(object));
            }
            if (tell) tell(what, std::min(1.0f, done()));
        }
        reader.close();
    };
    if (!input.blobs) {
        osmium::io::Reader reader{input.file, wanted, input.meta, unpackers};
        auto size = static_cast<float>(std::max(size_t{1}, reader.file_size()));
        visit_all(reader, kinds::nwr, [&] { return static_cast<float>(reader.offset()) / size; });
        return;
    }
    std::vector<size_t> stretches;
    for (size_t i = 0; i < input.blobs->stretches.size(); ++i)
        if ((held_by(*input.blobs, i) & wanted) != 0) stretches.push_back(i);
    std::unique_ptr<OpenStretch> here, next;  // which is unpacked while the one before is visited
    for (size_t i = 0; i <= stretches.size(); ++i) {
        here = std::move(next);
        if (i < stretches.size()) {
            const PbfStretch& stretch = input.blobs->stretches[stretches[i]];
            next = std::make_unique<OpenStretch>(input.blobs->bytes(stretch), input, unpackers);
        }
        if (here)
            visit_all(here->reader, held_by(*input.blobs, stretches[i - 1]),
                      [&] { return static_cast<float>(i) / static_cast<float>(stretches.size()); });
    }
}

}  // namespace flaneur
