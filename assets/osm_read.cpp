#include <algorithm>
#include <exception>
#include <filesystem>
#include <osmium/handler.hpp>
#include <osmium/io/any_compression.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/reader.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>

#include "assets/osm_map.h"

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

// Of several versions of an object the one that comes last stays.
template <class T>
static void sort_by_id(std::vector<T>& items) {
    std::stable_sort(items.begin(), items.end(), [](const T& a, const T& b) { return a.id < b.id; });
    std::reverse(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end(), [](const T& a, const T& b) { return a.id == b.id; }),
                items.end());
    std::reverse(items.begin(), items.end());
}

namespace {

struct Collector : osmium::handler::Handler {
    OsmMap& map;
    explicit Collector(OsmMap& m) : map(m) {}

    static OsmTags tags_of(const osmium::OSMObject& object) {
        OsmTags tags;
        for (const osmium::Tag& tag : object.tags()) tags.items.emplace_back(tag.key(), tag.value());
        return tags;
    }

    void node(const osmium::Node& node) {
        if (!node.visible() || !node.location().valid()) return;
        map.nodes.push_back({node.id(), node.location().lon(), node.location().lat(), tags_of(node)});
    }

    void way(const osmium::Way& way) {
        if (!way.visible()) return;
        if (way.nodes().size() > k_osm_most_nodes) {
            ++map.too_long;
            return;
        }
        OsmWay w{way.id(), {}, tags_of(way)};
        for (const osmium::NodeRef& ref : way.nodes()) {
            if (w.nodes.empty() || w.nodes.back() != ref.ref()) w.nodes.push_back(ref.ref());
        }
        map.ways.push_back(std::move(w));
    }

    void relation(const osmium::Relation& relation) {
        std::string_view type = relation.tags().get_value_by_key("type", "");
        if (!relation.visible() || (type != "multipolygon" && type != "building")) return;
        OsmRelation r{relation.id(), {}, tags_of(relation)};
        for (const osmium::RelationMember& member : relation.members()) {
            if (member.type() != osmium::item_type::way) continue;
            std::string_view role = member.role();
            if (role == "outer" || role == "inner" || role == "outline" || role.empty()) {
                r.ways.push_back({member.ref(), role == "inner"});
            }
        }
        map.relations.push_back(std::move(r));
    }
};

}  // namespace

static Result<OsmMap> read_from(const osmium::io::File& file, const std::string& name) {
    OsmMap map;
    try {
        osmium::io::Reader reader{file, osmium::osm_entity_bits::nwr};
        Collector collector{map};
        osmium::apply(reader, collector);
        osmium::Box box = reader.header().joined_boxes();
        reader.close();
        if (box.valid() && box.bottom_left().valid()) {
            map.box = {box.bottom_left().lon(), box.bottom_left().lat(), box.top_right().lon(),
                       box.top_right().lat()};
        }
    } catch (const std::exception& e) {
        return Error{"The map " + name + " cannot be read (" + e.what() +
                     "); it may be cut short or be no .osm or .osm.pbf file. Download or export it again."};
    }
    sort_by_id(map.nodes);
    sort_by_id(map.ways);
    sort_by_id(map.relations);
    return map;
}

Result<OsmMap> read_osm(const std::string& path) {
    std::error_code no_file;
    if (!std::filesystem::is_regular_file(path, no_file))
        return Error{"There is no file " + path + " to read a map from; check the path."};
    return read_from(osmium::io::File{path}, path);
}

Result<OsmMap> parse_osm(std::string_view bytes, const std::string& format) {
    return read_from(osmium::io::File{bytes.data(), bytes.size(), format}, "in memory");
}

}  // namespace flaneur
