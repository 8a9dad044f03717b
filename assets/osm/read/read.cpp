#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <osmium/io/compression.hpp>
#include <sstream>

#include "assets/files/file.h"
#include "assets/osm/cut.h"
#include "assets/osm/map.h"
#include "assets/osm/read/objects.h"
#include "assets/osm/window.h"

namespace {

// What makes a map too much to be read, as part of a sentence.
struct TooMuch : std::runtime_error {
    using std::runtime_error::runtime_error;
};
struct TooLarge : TooMuch {
    using TooMuch::TooMuch;
};

osmium::io::Decompressor* bounded(osmium::io::file_compression how, int fd);
osmium::io::Decompressor* bounded(osmium::io::file_compression how, const char* bytes, size_t size);

// libosmium's own decompressors register below, where they are included, and find their places taken.
bool take_place(osmium::io::file_compression how) {
    return osmium::io::CompressionFactory::instance().register_compression(
        how, [](int, osmium::io::fsync) -> osmium::io::Compressor* { throw TooMuch("is only read"); },
        [how](int fd) { return bounded(how, fd); },
        [how](const char* bytes, size_t size) { return bounded(how, bytes, size); });
}
[[maybe_unused]] const bool k_bounds_gzip = take_place(osmium::io::file_compression::gzip);
[[maybe_unused]] const bool k_bounds_bzip2 = take_place(osmium::io::file_compression::bzip2);

}  // namespace

#include <osmium/io/any_compression.hpp>
#include <osmium/io/xml_input.hpp>

namespace {

// OpenStreetMap's XML shrinks to a tenth or a twentieth, what it packs itself to a third, and what is all
// alike to a thousandth.
constexpr size_t k_most_times = 100;

// `room` and `packed` in bytes; the room is that of a small file.
size_t room_for(size_t packed, size_t room) { return std::max(room, packed * k_most_times); }

TooMuch bomb() { return TooMuch("unpacks to more than a hundred times its size, as no map does"); }

class BoundedDecompressor final : public osmium::io::Decompressor {
  public:
    BoundedDecompressor(osmium::io::Decompressor* inner, size_t packed)
        : m_inner(inner), m_room(room_for(packed, size_t{16} << 20)) {}
    std::string read() override {
        std::string bytes = m_inner->read();
        if (bytes.size() > m_room) throw bomb();
        m_room -= bytes.size();
        return bytes;
    }
    void close() override { m_inner->close(); }

  private:
    std::unique_ptr<osmium::io::Decompressor> m_inner;
    size_t m_room;
};

osmium::io::Decompressor* bounded(osmium::io::file_compression how, int fd) {
    struct stat about {};
    size_t size = fstat(fd, &about) == 0 ? static_cast<size_t>(about.st_size) : 0;
    bool gzip = how == osmium::io::file_compression::gzip;
    std::unique_ptr<osmium::io::Decompressor> inner;
    if (gzip) inner = std::make_unique<osmium::io::GzipDecompressor>(fd);
    if (!gzip) inner = std::make_unique<osmium::io::Bzip2Decompressor>(fd);
    return new BoundedDecompressor(inner.release(), size);
}

osmium::io::Decompressor* bounded(osmium::io::file_compression how, const char* bytes, size_t size) {
    bool gzip = how == osmium::io::file_compression::gzip;
    std::unique_ptr<osmium::io::Decompressor> inner;
    if (gzip) inner = std::make_unique<osmium::io::GzipBufferDecompressor>(bytes, size);
    if (!gzip) inner = std::make_unique<osmium::io::Bzip2BufferDecompressor>(bytes, size);
    return new BoundedDecompressor(inner.release(), size);
}

}  // namespace

namespace flaneur {

std::string_view OsmTags::operator[](std::string_view key) const {
    for (const auto& [k, v] : items) {
        if (k == key) return v;
    }
    return {};
}

template <class T>
static const T* find_id(const std::vector<T>& sorted, int64_t id) {
    auto at =
        std::lower_bound(sorted.begin(), sorted.end(), id, [](const T& t, int64_t i) { return t.id < i; });
    return at != sorted.end() && at->id == id ? &*at : nullptr;
}

const OsmNode* OsmMap::node(int64_t id) const { return find_id(nodes, id); }
const OsmWay* OsmMap::way(int64_t id) const { return find_id(ways, id); }

namespace {

// What is made of libosmium's objects. Whatever is taken costs some of the room.
struct Taker {
    size_t room;  // bytes

    void spend(size_t bytes) {
        if (bytes > room) throw TooLarge("holds more nodes, ways and tags than can be taken in");
        room -= bytes;
    }

    OsmTags tags_of(const osmium::OSMObject& object) {
        OsmTags tags;
        for (const osmium::Tag& tag : object.tags()) {
            auto& item = tags.items.emplace_back(tag.key(), tag.value());
            spend(sizeof item + item.first.size() + item.second.size());
        }
        return tags;
    }

    OsmNode node(const osmium::Node& node) {
        spend(sizeof(OsmNode));
        return {node.id(), node.location().lon(), node.location().lat(), tags_of(node)};
    }

    OsmWay way(const osmium::Way& way) {
        spend(sizeof(OsmWay) + way.nodes().size() * sizeof(int64_t));
        OsmWay w{way.id(), {}, tags_of(way)};
        for (const osmium::NodeRef& ref : way.nodes()) {
            if (w.nodes.empty() || w.nodes.back() != ref.ref()) w.nodes.push_back(ref.ref());
        }
        return w;
    }

    OsmRelation relation(const osmium::Relation& relation) {
        spend(sizeof(OsmRelation) + relation.members().size() * sizeof(OsmRelation::Member));
        OsmRelation r{relation.id(), {}, tags_of(relation)};
        for (const osmium::RelationMember& member : relation.members()) {
            if (member.type() != osmium::item_type::way) continue;
            std::string_view role = member.role();
            if (role == "outer" || role == "inner" || role == "outline" || role == "part" || role.empty()) {
                r.ways.push_back({member.ref(), role == "inner", role == "part"});
            }
        }
        return r;
    }
};

bool is_wanted(const osmium::Node& node) { return node.visible() && node.location().valid(); }
bool is_wanted(const osmium::Way& way) { return way.visible(); }
bool is_wanted(const osmium::Relation& relation) {
    std::string_view type = relation.tags().get_value_by_key("type", "");
    return relation.visible() && (type == "multipolygon" || type == "building");
}

// For cut_to.
struct FileSource {
    const Input& input;
    const TellProgress& tell;
    Taker taker;
    int passes = 0, too_long = 0;

    template <class Visit>
    void nodes(Visit visit) {
        read_objects<osmium::Node>(input, kinds::node, tell, next(), [&](const osmium::Node& n) {
            if (is_wanted(n))
                visit(n.id(), n.location().lon(), n.location().lat(), [&] { return taker.node(n); });
        });
    }
    template <class Visit>
    void ways(Visit visit) {
        too_long = 0;
        read_objects<osmium::Way>(input, kinds::way, tell, next(), [&](const osmium::Way& w) {
            if (!is_wanted(w)) return;
            if (w.nodes().size() > k_osm_most_nodes)
                ++too_long;
            else
                visit(
                    w.id(), w.nodes().size(), [&](size_t i) { return w.nodes()[i].ref(); },
                    [&] { return taker.way(w); });
        });
    }
    template <class Visit>
    void relations(Visit visit) {
        std::vector<int64_t> members;
        read_objects<osmium::Relation>(input, kinds::relation, tell, next(), [&](const osmium::Relation& r) {
            if (!is_wanted(r)) return;
            members.clear();
            for (const osmium::RelationMember& m : r.members())
                if (m.type() == osmium::item_type::way) members.push_back(m.ref());
            visit(
                members.size(), [&](size_t i) { return members[i]; }, [&] { return taker.relation(r); });
        });
    }

  private:
    std::string_view next() {
        constexpr std::string_view k_passes[] = {"reading the map, nodes in sight", "reading the map, ways",
                                                 "reading the map, areas",
                                                 "reading the map, ways and nodes beyond"};
        return k_passes[std::min<size_t>(static_cast<size_t>(passes++), std::size(k_passes) - 1)];
    }
};

std::optional<OsmBox> bounds_of(osmium::io::Reader& reader) {
    osmium::Box box = reader.header().joined_boxes();
    if (!box.valid()) return std::nullopt;
    return OsmBox{box.left(), box.bottom(), box.right(), box.top()};
}

// A byte of a .pbf becomes up to a hundred in memory before any object is seen, so little is let through.
void refuse_bomb(const File& file) {
    if (file.format() != osmium::io::file_format::pbf) return;
    auto check = [](std::istream& bytes, size_t packed) {
        if (unpacked_size(bytes) > room_for(packed, size_t{1} << 20)) throw bomb();
    };
    if (file.buffer()) {
        std::istringstream bytes(std::string(file.buffer(), file.buffer_size()));
        check(bytes, file.buffer_size());
    } else {
        std::ifstream bytes(file.filename(), std::ios::binary);
        check(bytes, std::filesystem::file_size(file.filename()));
    }
}

// libosmium goes by small letters, and takes what begins with http: for an address.
Result<File> file_of(const std::string& path) {
    if (Result<void> found = find_file(path); !found) return found.error();
    if (access(path.c_str(), R_OK) != 0)
        return Error{"The map " + path + " cannot be read: " + std::strerror(errno) + "."};
    const char* format = has_ending(path, ".osm")       ? "osm"
                         : has_ending(path, ".osm.gz")  ? "osm.gz"
                         : has_ending(path, ".osm.bz2") ? "osm.bz2"
                         : has_ending(path, ".pbf")     ? "pbf"
                                                        : "";
    return File{std::filesystem::absolute(path).string(), format};
}

// What `read` makes of a file, and what libosmium throws as a sentence that ends with `advice` where it is
// too much.
template <class Read>
auto guarded(const std::string& name, const std::string& advice, Read read) -> Result<decltype(read())> {
    try {
        return read();
    } catch (const TooMuch& e) {
        return Error{"The map " + name + " " + e.what() + "; " +
                     (advice.empty() ? "download or export it again" : advice) + "."};
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& e) {
        if (std::string_view(e.what()).find("entities") != std::string_view::npos)
            return Error{"The map " + name +
                         " has XML entities of its own, which are not read; export it again without them."};
        // Where XML breaks off is worth knowing; what a parser of packed maps calls its trouble is not.
        bool is_packed = dynamic_cast<const osmium::pbf_error*>(&e) != nullptr ||
                         dynamic_cast<const protozero::exception*>(&e) != nullptr;
        return Error{"The map " + name + " cannot be read" +
                     (is_packed ? "" : " (" + excerpt(e.what()) + ")") +
                     "; it may be cut short or be no .osm or .osm.pbf file. Download or export it again."};
    }
}

// The same of what goes through a file several times, if need be again.
template <class Read>
auto guarded_input(const std::string& path, const std::string& advice, Read read)
    -> Result<decltype(read(std::declval<const Input&>()))> {
    Result<File> file = file_of(path);
    if (!file) return file.error();
    return guarded(path, advice, [&] {
        refuse_bomb(*file);
        Input input{*file};
        if (file->format() == osmium::io::file_format::pbf) {
            osmium::io::Header header = osmium::io::Reader{*file, kinds::nothing}.header();
            if (!header.has_multiple_object_versions()) input.meta = osmium::io::read_meta::no;
            input.blobs = blobs_of(path);
            if (input.blobs) find_kinds(input);
        }
        try {
            return read(input);
        } catch (const Unsorted&) {
            input.blobs.reset();
            return read(input);
        }
    });
}

// Extracts about the antimeridian have longitudes near 180 and -180; theirs go on beyond 180 where that makes
// them narrower. Nodes of nothing that is built do not count.
void unroll(OsmMap& map) {
    auto any = [&](auto test) { return std::any_of(map.nodes.begin(), map.nodes.end(), test); };
    if (!any([](const OsmNode& n) { return n.longitude > 90; }) ||
        !any([](const OsmNode& n) { return n.longitude < -90; }))
        return;
    double west = 180, east = -180, west_on = 360, east_on = 0;
    for (const OsmWay& way : map.ways) {
        if (!way.tags.has("building") && !way.tags.has("highway")) continue;
        for (int64_t id : way.nodes) {
            const OsmNode* node = map.node(id);
            if (!node) continue;
            double plain = node->longitude, on = plain < 0 ? plain + 360 : plain;
            west = std::min(west, plain), east = std::max(east, plain);
            west_on = std::min(west_on, on), east_on = std::max(east_on, on);
        }
    }
    if (west > east || east_on - west_on >= east - west) return;
    for (OsmNode& node : map.nodes) node.longitude += node.longitude < 0 ? 360 : 0;
    map.box = std::nullopt;  // which ends at 180
}

Result<OsmMap> read_from(const Input& input, const std::string& name, const OsmReading& how,
                         bool* too_large) {
    const char* advice = "cut out a part of a few kilometres (osmium extract does)";
    return guarded(name, advice, [&] {
        refuse_bomb(input.file);
        OsmMap map;
        Taker taker{how.most};
        // Whatever is in the file costs something, taken or not.
        auto take = [&](const osmium::OSMObject& object) {
            if (object.type() == osmium::item_type::node) {
                const auto& node = static_cast<const osmium::Node&>(object);
                is_wanted(node) ? map.nodes.push_back(taker.node(node)) : taker.spend(sizeof(OsmNode));
            } else if (object.type() == osmium::item_type::way) {
                const auto& way = static_cast<const osmium::Way&>(object);
                bool is_long = way.nodes().size() > k_osm_most_nodes;
                map.too_long += way.visible() && is_long;
                is_wanted(way) && !is_long ? map.ways.push_back(taker.way(way)) : taker.spend(sizeof(OsmWay));
            } else if (object.type() == osmium::item_type::relation) {
                const auto& relation = static_cast<const osmium::Relation&>(object);
                is_wanted(relation) ? map.relations.push_back(taker.relation(relation))
                                    : taker.spend(sizeof(OsmRelation));
            }
        };
        try {
            {
                osmium::io::Reader header{input.file, osmium::osm_entity_bits::nothing};
                map.box = bounds_of(header);
            }
            read_objects<osmium::OSMObject>(input, kinds::nwr, how.tell, "reading the map", take);
        } catch (const TooLarge&) {
            if (too_large) *too_large = true;
            throw;
        }
        sort_by_id(map.nodes);
        sort_by_id(map.ways);
        sort_by_id(map.relations);
        unroll(map);
        return map;
    });
}

}  // namespace

Result<OsmMap> read_osm(const std::string& path, const OsmReading& how, bool* too_large) {
    Result<File> file = file_of(path);
    return file ? read_from({*file}, path, how, too_large) : file.error();
}

Result<OsmMap> parse_osm(std::string_view bytes, const std::string& format, size_t most) {
    return read_from({File{bytes.data(), bytes.size(), format}}, "in memory", {most}, nullptr);
}

Result<OsmMap> read_osm_window(const std::string& path, const OsmWindow& window, const OsmReading& how) {
    return guarded_input(path, "choose a smaller --radius", [&](const Input& input) {
        FileSource source{input, how.tell, {how.most}};
        OsmMap map = cut_to(window, source);
        map.too_long = source.too_long;
        return map;
    });
}

Result<std::optional<OsmBox>> read_osm_bounds(const std::string& path) {
    Result<File> file = file_of(path);
    if (!file) return file.error();
    return guarded(path, "", [&] {
        osmium::io::Reader reader{*file, osmium::osm_entity_bits::nothing};
        return bounds_of(reader);
    });
}

Result<std::vector<OsmSight>> survey_osm(const std::string& path, const TellProgress& tell) {
    struct Seen {
        int64_t node;
        float interest, nodes;
    };
    return guarded_input(path, "", [&](const Input& input) {
        std::vector<Seen> seen;
        size_t every = 1, count = 0;  // of so many ways one is looked at
        read_objects<osmium::Way>(input, kinds::way, tell, "looking for where there is most to see, ways",
                                  [&](const osmium::Way& way) {
                                      if (!is_wanted(way) || way.nodes().empty()) return;
                                      OsmSight sight =
                                          sight_of(way.get_value_by_key("highway", ""),
                                                   way.get_value_by_key("building", ""), way.nodes().size());
                                      if (sight.nodes == 0 || count++ % every != 0) return;
                                      seen.push_back({way.nodes()[0].ref(), sight.interest, sight.nodes});
                                      if (seen.size() < k_osm_most_sights) return;
                                      every *= 2;
                                      size_t kept = 0;
                                      for (size_t i = 0; i < seen.size(); i += 2) seen[kept++] = seen[i];
                                      seen.resize(kept);
                                  });
        // Among relations none may be that was not seen.
        if (input.blobs)
            read_objects<osmium::Relation>(input, kinds::relation, tell,
                                           "looking for where there is most to see, areas",
                                           [](const osmium::Relation&) {});
        std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.node < b.node; });
        std::vector<OsmSight> sights;
        auto scale = static_cast<float>(every);
        read_objects<osmium::Node>(input, kinds::node, tell, "looking for where there is most to see, places",
                                   [&](const osmium::Node& node) {
                                       if (!is_wanted(node)) return;
                                       auto at = std::lower_bound(
                                           seen.begin(), seen.end(), node.id(),
                                           [](const Seen& s, int64_t id) { return s.node < id; });
                                       for (; at != seen.end() && at->node == node.id(); ++at)
                                           sights.push_back({node.location().lon(), node.location().lat(),
                                                             at->interest * scale, at->nodes * scale});
                                   });
        return sights;
    });
}

}  // namespace flaneur
