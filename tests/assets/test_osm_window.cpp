// What is drawn of maps that are larger than a city, or lie where longitudes are odd.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/cities.h"
#include "assets/osm/cut.h"
#include "assets/osm/map.h"
#include "assets/osm/window.h"
#include "tests/assets/city_checks.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

// A map under way: ids count on over all that is drawn.
struct Drawn {
    std::string nodes, ways, relations;
    int next_node = 0, next_way = 0;

    int node(double latitude, double longitude) {
        char text[96];
        std::snprintf(text, sizeof text, "<node id=\"%d\" lat=\"%.7f\" lon=\"%.7f\"/>\n", ++next_node,
                      latitude, longitude);
        nodes += text;
        return next_node;
    }
    int way(const std::vector<int>& ids, const std::string& tags) {
        ways += "<way id=\"" + std::to_string(++next_way) + "\">";
        for (int id : ids) ways += "<nd ref=\"" + std::to_string(id) + "\"/>";
        ways += tags + "</way>\n";
        return next_way;
    }
    std::string text(const std::string& bounds = "") const {
        return "<osm version=\"0.6\">" + bounds + nodes + ways + relations + "</osm>";
    }
};

std::string tag(const std::string& key, const std::string& value) {
    return "<tag k=\"" + key + "\" v=\"" + value + "\"/>";
}

constexpr double k_degree = 111'200;  // metres, about

// Blocks of 100 m with a house in each, streets between them from end to end, and a courtyard house in every
// third: from a corner at the equator to the north and east.
void add_town(Drawn& map, double south, double west, int blocks) {
    double side = 100 / k_degree;
    for (int i = 0; i <= blocks; ++i) {
        std::vector<int> east, north;
        for (int k = 0; k <= blocks; ++k) {
            east.push_back(map.node(south + i * side, west + k * side));
            north.push_back(map.node(south + k * side, west + i * side));
        }
        map.way(east, tag("highway", "residential"));
        map.way(north, tag("highway", i % 2 ? "footway" : "residential"));
    }
    auto square = [&](double y, double x, double half, const std::string& tags) {
        int a = map.node(y - half, x - half), b = map.node(y - half, x + half),
            c = map.node(y + half, x + half), d = map.node(y + half, x - half);
        return map.way({a, b, c, d, a}, tags);
    };
    for (int row = 0; row < blocks; ++row) {
        for (int column = 0; column < blocks; ++column) {
            double y = south + (row + 0.5) * side, x = west + (column + 0.5) * side;
            std::string house =
                tag("building", "yes") + tag("height", std::to_string(8 + (row * 7 + column) % 9));
            if ((row + column) % 3 != 0) {
                square(y, x, side * 0.25, house);
                continue;
            }
            int outer = square(y, x, side * 0.3, ""), inner = square(y, x, side * 0.1, "");
            map.relations += "<relation id=\"" + std::to_string(outer) + "\"><member type=\"way\" ref=\"" +
                             std::to_string(outer) + "\" role=\"outer\"/><member type=\"way\" ref=\"" +
                             std::to_string(inner) + "\" role=\"inner\"/>" + tag("type", "multipolygon") +
                             house + "</relation>\n";
        }
    }
}

std::string message(const Result<City>& city) { return city ? "" : city.error().message; }

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(OsmWindow, IsTheSameAsCuttingByHand) {
    Drawn drawn;
    add_town(drawn, 0, 0, 12);
    auto at = [&](double north, double east) { return drawn.node(north / k_degree, east / k_degree); };
    // A lake of three ways, one of them far to the east; and a road that goes there in one piece.
    int south = at(520, 560), north = at(580, 560), south_east = at(520, 1150), north_east = at(580, 1150);
    drawn.relations += "<relation id=\"9000\">";
    for (const std::vector<int>& shore : std::vector<std::vector<int>>{
             {north_east, north, south}, {south, south_east}, {south_east, north_east}})
        drawn.relations +=
            "<member type=\"way\" ref=\"" + std::to_string(drawn.way(shore, "")) + "\" role=\"outer\"/>";
    drawn.relations += tag("type", "multipolygon") + tag("natural", "water") + "</relation>\n";
    drawn.way({at(640, 540), at(660, 1190)}, tag("highway", "primary"));
    drawn.way({at(560, 600), at(560, 1100)}, tag("barrier", "wall"));
    TestFolder folder;
    std::string path = folder.write("town.osm", drawn.text());
    const MapPlace middle{600 / k_degree, 520 / k_degree};
    Result<City> cut = load_osm(path, {"", 1, middle, 260});
    ASSERT_TRUE(cut) << message(cut);
    check_city(*cut);
    Vec2 low, high;
    for (Vec3 v : cut->ground.vertices) {
        low = {std::min(low.x, v.x), std::min(low.z, v.z)};
        high = {std::max(high.x, v.x), std::max(high.z, v.z)};
    }
    for (float side : {-low.x, -low.z, high.x, high.z}) EXPECT_NEAR(side, 260 + 6, 0.1f) << "streets end";
    Vec2 walls = cut->ground.high - cut->ground.low;
    EXPECT_GT(walls.x, 2 * 266 + 5) << "houses at the edge are whole";
    ASSERT_TRUE(cut->on_earth);
    EXPECT_NEAR(cut->on_earth->middle.latitude, middle.latitude, 1e-6);
    EXPECT_NEAR(cut->on_earth->middle.longitude, middle.longitude, 1e-6);
    EXPECT_EQ(cut->on_earth->radius, 260);

    for (const Face& face : cut->ground.faces) {
        if (face.building < cut->buildings.size() && face.kind == FaceKind::garden_wall) {
            EXPECT_LT(std::max(face.a.x, face.b.x), 270) << "walls end";
        }
    }
    auto kind_at = [&](float right, float up) {  // of the middle
        auto hit = ground_at(cut->ground, {right, 0, -up}, 1, 3);
        return hit ? hit->kind : Surface::grass;
    };
    EXPECT_EQ(kind_at(168, -52), Surface::water);
    EXPECT_EQ(kind_at(130, 43.4f), Surface::road);

    // By hand: the whole map, of which a box is drawn.
    Result<OsmMap> whole = read_osm(path);
    ASSERT_TRUE(whole);
    OsmMap in_memory = cut_map(*whole, window_about(middle, 260));
    const Projection& p = in_memory.window->project;
    whole->box = OsmBox{
        middle.longitude - 260 / p.metres_per_longitude, middle.latitude - 260 / p.metres_per_latitude,
        middle.longitude + 260 / p.metres_per_longitude, middle.latitude + 260 / p.metres_per_latitude};
    Result<City> by_hand = city_of(*whole, path, {});
    ASSERT_TRUE(by_hand);
    EXPECT_EQ(hash_city(*cut), hash_city(*by_hand));
    EXPECT_LT(cut->buildings.size(), 40u) << "of 144";

    // Of what was read as of the file.
    in_memory.box = whole->box;
    EXPECT_LT(in_memory.nodes.size(), whole->nodes.size() / 2);
    Result<City> of_memory = city_of(in_memory, path, {});
    ASSERT_TRUE(of_memory);
    EXPECT_EQ(hash_city(*cut), hash_city(*of_memory));
}

TEST(OsmWindow, WaysCrossItBetweenTwoNodes) {
    // A street and a railway from far to the west to far to the east; one that passes by.
    Drawn drawn;
    add_town(drawn, 0, 0, 3);
    auto at = [&](double north, double east) { return drawn.node(north / k_degree, east / k_degree); };
    int street = drawn.way({at(1150, -900), at(1150, 2900)}, tag("highway", "residential")),
        slanting = drawn.way({at(-400, -500), at(2400, 2300)}, tag("railway", "rail")),
        beside = drawn.way({at(1600, -900), at(1600, 2900)}, tag("highway", "residential")),
        corner = drawn.way({at(1000, -900), at(3500, 1600)}, tag("highway", "residential"));
    TestFolder folder;
    std::string path = folder.write("long.osm", drawn.text());
    const MapPlace middle{1050 / k_degree, 1000 / k_degree};
    OsmWindow window = window_about(middle, 200);
    Result<OsmMap> map = read_osm_window(path, window);
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_TRUE(map->way(street));
    EXPECT_TRUE(map->way(slanting));
    EXPECT_FALSE(map->way(beside));
    EXPECT_FALSE(map->way(corner)) << "it passes by the corner";
    Result<City> city = load_osm(path, {"", 1, middle, 200});
    ASSERT_TRUE(city) << message(city);
    const MapPlace about = city->on_earth->middle;
    Vec2 on_street = projection_about(about.longitude, about.latitude).at(middle.longitude, 1150 / k_degree);
    std::optional<GroundHit> road = ground_at(city->ground, at_height(on_street, 0), 1, 1);
    ASSERT_TRUE(road);
    EXPECT_EQ(road->kind, Surface::road);
    Result<OsmMap> whole = read_osm(path);
    ASSERT_TRUE(whole);
    OsmMap cut = cut_map(*whole, window);
    EXPECT_EQ(cut.ways.size(), map->ways.size());
}

// Whatever the order, as many as fit are kept, the nearest ones.
TEST(OsmWindow, TheBeltNarrowsWhereThereIsMuchAbout) {
    const OsmWindow window = window_about({0, 0}, 100);
    std::vector<size_t> kept;
    for (bool is_reversed : {false, true}) {
        Belt belt{window};
        belt.most = 40;
        for (int k = 0; k < 400; ++k) {
            int i = is_reversed ? 399 - k : k;
            belt.add(i, (101 + 10 * i) / k_degree, 0);
        }
        belt.sort();
        EXPECT_TRUE(belt.find(0));
        EXPECT_FALSE(belt.find(399));
        EXPECT_LE(belt.places.size(), 40u);
        EXPECT_GT(belt.places.size(), 20u);
        kept.push_back(belt.places.size());
    }
    EXPECT_EQ(kept[0], kept[1]);
}

TEST(OsmWindow, ObjectsMayStandInAnyOrder) {
    Drawn drawn;
    add_town(drawn, 0, 0, 8);
    TestFolder folder, other;
    std::string turned = "<osm version=\"0.6\">" + drawn.relations + drawn.ways + drawn.nodes + "</osm>";
    const CityOptions options{"", 1, MapPlace{400 / k_degree, 400 / k_degree}, 150};
    Result<City> sorted = load_osm(folder.write("a.osm", drawn.text()), options),
                 unsorted = load_osm(other.write("a.osm", turned), options);
    ASSERT_TRUE(sorted && unsorted) << message(sorted) << message(unsorted);
    EXPECT_EQ(hash_city(*sorted), hash_city(*unsorted));
}

// Memory is counted in what is taken in, not in what the system says.
TEST(OsmWindow, WhatLiesOutsideTakesNoRoom) {
    Drawn drawn;
    add_town(drawn, 0, 0, 2);
    std::string far;
    for (int i = 0; i < 20'000; ++i) {
        std::string id = std::to_string(1'000'000 + i);
        far +=
            "<node id=\"" + id + "\" lat=\"1\" lon=\"1." + id + "\"><tag k=\"name\" v=\"far away\"/></node>";
        far += "<way id=\"" + id + "\"><nd ref=\"" + id + "\"/><nd ref=\"1000000\"/></way>";
        far += "<relation id=\"" + id + "\"><member type=\"way\" ref=\"" + id + "\" role=\"outer\"/>" +
               tag("type", "multipolygon") + "</relation>";
    }
    drawn.nodes += far;
    TestFolder folder;
    std::string path = folder.write("far.osm", drawn.text());
    constexpr size_t k_room = 20'000;  // bytes: one each of what is far away would be too much
    bool is_too_large = false;
    EXPECT_FALSE(read_osm(path, {k_room}, &is_too_large));
    EXPECT_TRUE(is_too_large);
    Result<OsmMap> map = read_osm_window(path, window_about({100 / k_degree, 100 / k_degree}, 120), {k_room});
    ASSERT_TRUE(map) << map.error().message;
    EXPECT_LT(map->nodes.size(), 60u);
    EXPECT_EQ(map->way(1'000'000), nullptr);
    Result<OsmMap> none = read_osm_window(path, window_about({1, 1.1}, 3000), {k_room});
    ASSERT_FALSE(none) << "20,000 nodes within";
    EXPECT_TRUE(says(none.error().message, "smaller --radius")) << none.error().message;
}

TEST(OsmWindow, LargeMapsAreDrawnWhereThereIsMostToSee) {
    Drawn drawn;
    add_town(drawn, 0, 0, 3);
    add_town(drawn, 9000 / k_degree, 8000 / k_degree, 7);
    TestFolder folder;
    std::string path = folder.write("two.osm", drawn.text());
    Result<City> city = load_osm(path, {"", 1, {}, 600});
    ASSERT_TRUE(city) << message(city);
    ASSERT_TRUE(city->on_earth);
    EXPECT_NEAR(city->on_earth->middle.latitude, 9350 / k_degree, 300 / k_degree);
    EXPECT_NEAR(city->on_earth->middle.longitude, 8350 / k_degree, 300 / k_degree);
    EXPECT_NEAR(city->on_earth->map_width, 8700, 50);
    ASSERT_FALSE(city->notes.empty());
    EXPECT_TRUE(says(city->notes[0], "the map is 8.7 x 9.6 km; drawn are 1.2 x 1.2 km about 0.08"))
        << city->notes[0];

    // Without a radius it is as much as somebody waits for; a small map is whole.
    std::vector<OsmSight> sights = sights_of(*read_osm(path));
    OsmChoice choice = choose_window(sights, std::nullopt, 0);
    EXPECT_FALSE(choice.is_whole);
    EXPECT_GE(choice.window.half, 1000);
    for (OsmSight& sight : sights) sight.nodes *= 1000;  // as if it were dense
    EXPECT_LT(choose_window(sights, std::nullopt, 0).window.half, choice.window.half);
    Drawn small;
    add_town(small, 0, 0, 3);
    EXPECT_TRUE(choose_window(sights_of(*read_osm(folder.write("small.osm", small.text()))), std::nullopt, 0)
                    .is_whole);

    // A map that holds too much to be read whole is looked through for the same place.
    Result<std::vector<OsmSight>> survey = survey_osm(path, {});
    ASSERT_TRUE(survey);
    OsmChoice again = choose_window(*survey, std::nullopt, 0);
    EXPECT_EQ(again.window.project.latitude, choice.window.project.latitude);
    EXPECT_EQ(again.window.project.longitude, choice.window.project.longitude);
    EXPECT_EQ(again.window.half, choice.window.half);
}

// Nothing after the header is read: it could not be.
TEST(OsmWindow, HeadersAreBelievedAtOnce) {
    TestFolder folder;
    auto bounds = [](const char* far) {
        return std::string("<osm version=\"0.6\"><bounds minlat=\"0\" minlon=\"0\" maxlat=\"") + far +
               "\" maxlon=\"" + far + "\"/><node id=\"1\" lat=\"0\" lon=\"0\"/>";
    };
    std::string broken = "<way <way", pad = "<!--" + std::string(17 << 20, 'x') + "-->";
    Result<City> vast = load_osm(folder.write("vast.osm", bounds("2") + pad + broken));
    ASSERT_FALSE(vast);
    EXPECT_TRUE(says(vast.error().message, "say where with --center")) << vast.error().message;
    std::string path = folder.write("near.osm", bounds("0.1") + pad + broken);
    Result<City> elsewhere = load_osm(path, {"", 1, MapPlace{52, 13}, 500});
    ASSERT_FALSE(elsewhere);
    EXPECT_TRUE(says(elsewhere.error().message, "--center 52.0000,13.0000 is not there"))
        << elsewhere.error().message;
    Result<City> within = load_osm(path, {"", 1, MapPlace{0.05, 0.05}, 500});
    ASSERT_FALSE(within);
    EXPECT_TRUE(says(within.error().message, "cannot be read")) << within.error().message;
}

TEST(OsmWindow, EmptyPlacesAreRefused) {
    Drawn drawn;
    add_town(drawn, 0, 0, 3);
    TestFolder folder;
    Result<City> none = load_osm(folder.write("town.osm", drawn.text()), {"", 1, MapPlace{1, 1}, 500});
    ASSERT_FALSE(none);
    EXPECT_TRUE(says(none.error().message, "within 500 m of 1.0000,1.0000")) << none.error().message;
}

TEST(OsmWindow, TheAntimeridianIsAPlaceLikeOthers) {
    Drawn drawn, moved;
    add_town(drawn, 0, 0, 5);
    // The same town, its middle at 180 degrees.
    add_town(moved, 0, 180 - 250 / k_degree, 5);
    std::string text = moved.text(R"(<bounds minlat="0" minlon="-180" maxlat="0.1" maxlon="180"/>)");
    for (size_t at = 0; (at = text.find("lon=\"180.", at)) != std::string::npos;) {
        size_t end = text.find('"', at + 5);
        char turned[32];
        std::snprintf(turned, sizeof turned, "%.7f", std::stod(text.substr(at + 5, end - at - 5)) - 360);
        text.replace(at + 5, end - at - 5, turned);
    }
    // A tree far away is no reason to draw the whole parallel.
    text.replace(text.find("<way"), 0, "<node id=\"99999\" lat=\"0\" lon=\"12\"/>");
    TestFolder folder;
    std::string path = folder.write("date.osm", text);
    Result<City> plain = load_osm(folder.write("plain.osm", drawn.text()));
    ASSERT_TRUE(plain) << message(plain);
    for (std::optional<MapPlace> center :
         {std::optional<MapPlace>(), std::optional(MapPlace{250 / k_degree, 180}),
          std::optional(MapPlace{250 / k_degree, -180})}) {
        Result<City> city = load_osm(path, {"", 1, center, 0});
        ASSERT_TRUE(city) << message(city);
        EXPECT_NEAR(city->ground.high.x - city->ground.low.x, plain->ground.high.x - plain->ground.low.x,
                    0.1f);
        EXPECT_EQ(city->buildings.size(), plain->buildings.size());
        EXPECT_NEAR(std::fabs(city->on_earth->middle.longitude), 180, 1e-6);
    }
}

TEST(OsmWindow, PolesArePlacesLikeOthers) {
    auto crossing = [](double latitude, double west, double east) {
        Drawn drawn;
        int a = drawn.node(latitude, west), b = drawn.node(latitude, east);
        drawn.way({a, b}, tag("highway", "residential"));
        return drawn.text();
    };
    TestFolder folder;
    // 100 m along the parallel: a degree there is 9.7 km.
    Result<City> near = load_osm(folder.write("near.osm", crossing(85, 10, 10.0103)));
    ASSERT_TRUE(near) << message(near);
    EXPECT_NEAR(near->ground.high.x - near->ground.low.x, 100 + 12, 1);
    EXPECT_NEAR(near->on_earth->middle.latitude, 85, 1e-4);
    EXPECT_NEAR(near->on_earth->middle.longitude, 10.00515, 1e-4);
    // Over the pole: 2 * 0.0005 degrees.
    for (double pole : {1.0, -1.0}) {
        Result<City> over = load_osm(folder.write("over.osm", crossing(pole * 89.9995, 0, 180)));
        ASSERT_TRUE(over) << message(over);
        Vec2 size = over->ground.high - over->ground.low;
        EXPECT_NEAR(std::max(size.x, size.z), 111.7f + 12, 1);
        Result<City> chosen = load_osm(folder.write("over.osm", crossing(pole * 89.9995, 0, 180)),
                                       {"", 1, MapPlace{pole * 90, 0}, 300});
        ASSERT_TRUE(chosen) << message(chosen);
        size = chosen->ground.high - chosen->ground.low;
        EXPECT_NEAR(std::max(size.x, size.z), 111.7f + 12, 1);
    }
    // North is up: on the meridian of the middle, a node nearer to the pole has the smaller z.
    for (double pole : {1.0, -1.0}) {
        Projection p = projection_about(20, pole * 86);
        EXPECT_LT(p.at(20, pole * 86 + 0.01).z, -1000);
        EXPECT_GT(p.at(20.1, pole * 86).x, 700);
        EXPECT_NEAR(p.at(20.1, pole * 86).z, -pole * 0.68f, 0.1f) << "parallels bend about the pole";
    }
}

}  // namespace
}  // namespace flaneur
