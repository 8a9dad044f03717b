// Packed maps are gone through blob by blob where nodes, ways and relations stand in this order, and else as
// a whole: with the same map in the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <osmium/builder/attr.hpp>
#include <osmium/io/pbf_output.hpp>
#include <osmium/io/writer.hpp>
#include <tuple>

#include "assets/cities.h"
#include "assets/osm/map.h"
#include "assets/osm/read/blobs.h"
#include "assets/osm/window.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

using osmium::memory::Buffer;
namespace attr = osmium::builder::attr;

constexpr double k_degree = 111'200;  // metres, about

struct Kinds {
    Buffer nodes{1 << 20}, ways{1 << 20}, relations{1 << 20};
};

// A street of houses, one with a courtyard, that goes on to the far east.
Kinds draw_town() {
    Kinds town;
    int id = 0;
    auto node = [&](double north, double east) {
        osmium::builder::add_node(town.nodes, attr::_id(++id),
                                  attr::_location(east / k_degree, north / k_degree));
        return id;
    };
    auto way = [&](int way_id, const std::vector<osmium::object_id_type>& nodes, const char* key,
                   const char* value) {
        osmium::builder::add_way(town.ways, attr::_id(way_id), attr::_nodes(nodes), attr::_tag(key, value));
    };
    auto square = [&](double north, double east, double half) -> std::vector<osmium::object_id_type> {
        int a = node(north - half, east - half);
        node(north - half, east + half), node(north + half, east + half), node(north + half, east - half);
        return {a, a + 1, a + 2, a + 3, a};
    };
    for (int house = 0; house < 8; ++house)
        way(1 + house, square(60, 20 + house * 40, 12), "building", "yes");
    way(20, square(140, 100, 20), "note", "outer"), way(21, square(140, 100, 8), "note", "inner");
    way(22, {node(20, 0), node(20, 100), node(20, 300), node(20, 9000)}, "highway", "residential");
    osmium::builder::add_relation(town.relations, attr::_id(1),
                                  attr::_member(osmium::item_type::way, 20, "outer"),
                                  attr::_member(osmium::item_type::way, 21, "inner"),
                                  attr::_tag("type", "multipolygon"), attr::_tag("building", "yes"));
    return town;
}

// So much far away that each kind takes several stretches.
Kinds draw_rest() {
    Kinds rest;
    for (int i = 1000; i < 31'000; ++i) {
        std::string note = std::to_string(i) + std::string(100, static_cast<char>('a' + i % 26));
        osmium::builder::add_node(rest.nodes, attr::_id(i), attr::_location(0.5 + i * 1e-6, 0.5),
                                  attr::_tag("note", note.c_str()));
        osmium::builder::add_way(rest.ways, attr::_id(i), attr::_nodes({i, i + 1}),
                                 attr::_tag("note", note.c_str()));
        osmium::builder::add_relation(rest.relations, attr::_id(i),
                                      attr::_member(osmium::item_type::way, i, "outer"),
                                      attr::_tag("type", "multipolygon"), attr::_tag("note", note.c_str()));
    }
    return rest;
}

std::string write(const TestFolder& folder, const std::vector<const Buffer*>& buffers) {
    std::string path = folder / "map.pbf";
    osmium::io::Writer writer{osmium::io::File(path, "pbf,pbf_compression=none")};
    for (const Buffer* buffer : buffers)
        for (const osmium::memory::Item& item : *buffer) writer(item);
    writer.close();
    return path;
}

using Places = std::vector<std::tuple<double, double, float, float>>;
Places survey(const std::string& path) {
    Result<std::vector<OsmSight>> sights = survey_osm(path, {});
    EXPECT_TRUE(sights) << sights.error().message;
    Places places;
    if (!sights) return places;
    for (const OsmSight& s : *sights) places.emplace_back(s.longitude, s.latitude, s.interest, s.nodes);
    std::sort(places.begin(), places.end());
    return places;
}

TEST(OsmPbf, WhateverTheOrderTheMapIsTheSame) {
    Kinds town = draw_town(), rest = draw_rest();
    TestFolder folder, other, third;
    // The town is in the last stretch of each kind; in the second file its nodes come after all.
    std::string sorted = write(folder, {&rest.nodes, &town.nodes, &rest.ways, &town.ways, &rest.relations,
                                        &town.relations}),
                late = write(other, {&rest.nodes, &rest.ways, &town.ways, &rest.relations, &town.relations,
                                     &town.nodes}),
                turned = write(third, {&rest.relations, &town.relations, &rest.ways, &town.ways, &town.nodes,
                                       &rest.nodes});
    std::optional<PbfBlobs> blobs = blobs_of(sorted);
    ASSERT_TRUE(blobs);
    EXPECT_GT(blobs->stretches.size(), 8u) << "or there is nothing to skip";

    const OsmWindow window = window_about({80 / k_degree, 150 / k_degree}, 150);
    Result<OsmMap> whole = read_osm(sorted);
    ASSERT_TRUE(whole) << whole.error().message;
    OsmMap by_hand = cut_map(*whole, window);
    EXPECT_EQ(by_hand.ways.size(), 11u);
    Places places = survey(sorted);
    EXPECT_EQ(places.size(), 9u);
    std::vector<uint64_t> cities;
    for (const std::string& path : {sorted, late, turned}) {
        Result<OsmMap> map = read_osm_window(path, window);
        ASSERT_TRUE(map) << map.error().message;
        EXPECT_EQ(map->nodes.size(), by_hand.nodes.size()) << path;
        EXPECT_EQ(map->ways.size(), by_hand.ways.size()) << path;
        EXPECT_EQ(map->relations.size(), by_hand.relations.size()) << path;
        EXPECT_TRUE(map->node(by_hand.way(22)->nodes.back())) << "9 km away";
        EXPECT_EQ(survey(path), places) << path;
        Result<City> city = load_osm(path, {"", 1, MapPlace{80 / k_degree, 150 / k_degree}, 150});
        ASSERT_TRUE(city) << city.error().message;
        cities.push_back(hash_city(*city));
    }
    EXPECT_EQ(cities[0], cities[1]);
    EXPECT_EQ(cities[0], cities[2]);
}

TEST(OsmPbf, FilesCutShortAreRefused) {
    Kinds rest = draw_rest();
    TestFolder folder;
    std::string path = write(folder, {&rest.nodes, &rest.ways});
    std::filesystem::resize_file(path, std::filesystem::file_size(path) - 10);
    EXPECT_FALSE(blobs_of(path));
    Result<OsmMap> map = read_osm_window(path, window_about({0, 0}, 150));
    ASSERT_FALSE(map);
    EXPECT_NE(map.error().message.find("cannot be read"), std::string::npos) << map.error().message;
    EXPECT_FALSE(blobs_of(folder.write("none.pbf", "")));
    EXPECT_FALSE(blobs_of(folder.write("text.pbf", std::string("\0\0\0\4<osm", 8))));
}

}  // namespace
}  // namespace flaneur
