#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "assets/cities.h"
#include "assets/osm/house.h"
#include "assets/osm/map.h"
#include "assets/terrain/terrain.h"
#include "tests/assets/city_checks.h"
#include "tests/assets/osm_drawing.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

fs::path corpus() { return fs::path(FLANEUR_SHARED_DIR) / "corpus" / "osm"; }

#define NEEDS_CORPUS()         \
    if (!fs::exists(corpus())) \
    GTEST_SKIP() << "There is no " << corpus() << ": tests on real maps are left out."

// A file that goes when the test ends.
struct Temporary {
    TestFolder folder;
    fs::path path;
    Temporary(const std::string& name, const std::string& content) : path(folder.write(name, content)) {}
};

std::string read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A street of 110 m running east, a square house of 22 m to its north; degrees of 1e-4 are about 11 m at the
// equator.
const char* const k_street =
    R"(<way id="1"><nd ref="1"/><nd ref="2"/><tag k="highway" v="residential"/>%TAGS%</way>)";
const char* const k_nodes = R"(
<node id="1" lat="0" lon="0"/><node id="2" lat="0" lon="0.001"/>
<node id="3" lat="0.0002" lon="0.0004"/><node id="4" lat="0.0002" lon="0.0006"/>
<node id="5" lat="0.0004" lon="0.0006"/><node id="6" lat="0.0004" lon="0.0004"/>)";
const char* const k_house = R"(<way id="2"><nd ref="3"/><nd ref="4"/><nd ref="5"/><nd ref="6"/><nd ref="3"/>
<tag k="building" v="yes"/>%TAGS%</way>)";

std::string with_tags(std::string text, const std::string& tags) {
    text.replace(text.find("%TAGS%"), 6, tags);
    return text;
}

std::string map_of(const std::string& body) { return "<osm version=\"0.6\">" + body + "</osm>"; }

Result<City> load_text(const std::string& xml) {
    Temporary file("map.osm", xml);
    return load_osm(file.path.string());
}

TEST(Osm, ParsesLengths) {
    EXPECT_FLOAT_EQ(*parse_metres("12"), 12);
    EXPECT_FLOAT_EQ(*parse_metres("12.5 m"), 12.5f);
    EXPECT_FLOAT_EQ(*parse_metres("1,5"), 1.5f);
    EXPECT_NEAR(*parse_metres("40 ft"), 12.192f, 1e-4f);
    EXPECT_NEAR(*parse_metres("12'6\""), 3.81f, 1e-4f);
    for (const char* bad : {"", "m", "wide", "3;4", "-2", "1e99x", "12'x"})
        EXPECT_FALSE(parse_metres(bad)) << bad;
    EXPECT_FLOAT_EQ(*parse_number("-1"), -1);
    EXPECT_FALSE(parse_number("1;2"));
}

TEST(Osm, StairsSayHowManyStepsTheyHave) {
    auto risers = [](const std::string& count) { return stated_risers({{{"step_count", count}}}); };
    EXPECT_EQ(risers("12"), 12);
    EXPECT_EQ(risers("9999999999"), 1000);
    EXPECT_EQ(risers("-5"), 0);
    EXPECT_EQ(risers("many"), 0);
    EXPECT_EQ(stated_risers({}), 0);
}

// Though several steps of the import look at the way.
TEST(Osm, AMissingNodeIsToldOnce) {
    std::string way = R"(<node id="7" lat="0.00005" lon="0.0005"/><node id="8" lat="0.0005" lon="0.0005"/>
        <way id="3"><nd ref="7"/><nd ref="8"/><nd ref="77"/><tag k="highway" v="footway"/><tag k="tunnel" v="building_passage"/></way>)";
    Result<City> city = load_text(map_of(k_nodes + way + with_tags(k_street, "") + with_tags(k_house, "")));
    ASSERT_TRUE(city) << city.error().message;
    const std::vector<std::string>& notes = city->notes;
    EXPECT_EQ(std::count(notes.begin(), notes.end(),
                         "1 reference to a node that the file lacks, or has nowhere on Earth, was skipped."),
              1);
}

TEST(Osm, ProjectsToMetres) {
    // One minute of latitude is a nautical mile; at 60 degrees one of longitude is half as long.
    Projection p = projection_about(10, 60);
    Vec2 north = p({0, 10, 60 + 1.0 / 60, {}}), east = p({0, 10 + 1.0 / 60, 60, {}});
    EXPECT_NEAR(north.z, -1856.9f, 1);
    EXPECT_NEAR(north.x, 0, 1e-3f);
    EXPECT_NEAR(east.x, 930.0f, 1);
}

TEST(Osm, StreetGetsWidthKerbsAndSidewalks) {
    Result<City> city =
        load_text(map_of(k_nodes + with_tags(k_street, "<tag k='width' v='8'/>") + with_tags(k_house, "")));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    EXPECT_NEAR(city->latitude, 0.0002f, 1e-4f);
    // The box ends 6 m beyond the map; its middle is the street's and the house's: x from -61 to 61.
    float z = city->ground.high.z - 6;
    auto at = [&](float south) { return ground_at(city->ground, {0, 0, z + south}, 1, 1); };
    EXPECT_EQ(at(0)->kind, Surface::road);
    EXPECT_EQ(at(-3.9f)->kind, Surface::road);
    EXPECT_EQ(at(-4.1f)->kind, Surface::sidewalk);
    EXPECT_FLOAT_EQ(at(-4.1f)->height, 0.12f);
    EXPECT_EQ(at(4.1f)->kind, Surface::sidewalk);
    EXPECT_FALSE(at(-33)) << "inside the house";
}

TEST(Osm, SidewalkTagsAreObeyed) {
    auto kind = [&](const std::string& tags, float south) {
        Result<City> city = load_text(
            map_of(k_nodes + with_tags(k_street, "<tag k='width' v='8'/>" + tags) + with_tags(k_house, "")));
        return ground_at(city->ground, {-40, 0, city->ground.high.z - 6 + south}, 1, 1)->kind;
    };
    EXPECT_EQ(kind("<tag k='sidewalk' v='left'/>", -4.5f), Surface::sidewalk);
    EXPECT_EQ(kind("<tag k='sidewalk' v='left'/>", 4.5f), Surface::grass);
    EXPECT_EQ(kind("<tag k='sidewalk:right' v='no'/>", 4.5f), Surface::grass);
    EXPECT_EQ(kind("<tag k='sidewalk' v='no'/>", -4.5f), Surface::grass);
}

TEST(Osm, HeightsComeFromTags) {
    auto top = [&](const std::string& tags) {
        Result<City> city = load_text(map_of(k_nodes + with_tags(k_street, "") + with_tags(k_house, tags)));
        return city->buildings.at(0).top;
    };
    EXPECT_FLOAT_EQ(top("<tag k='height' v='17.5'/>"), 17.5f);
    EXPECT_FLOAT_EQ(top("<tag k='building:levels' v='3'/>"), 3 * 3.2f + 0.8f);
    EXPECT_NEAR(top("<tag k='height' v='12\"'/>"), top(""), 8);
    EXPECT_GT(top(""), 5);
}

// A part that says no height is as high as the houses about it, and so is what it leaves of its outline.
TEST(Osm, PartsStandInTheirNeighbourhood) {
    Drawing d;
    d.way(std::vector<Vec2>{{-200, 0}, {200, 0}}, tag("highway", "residential"));
    for (int i = 0; i < 10; ++i) {
        float x = -150 + 30 * static_cast<float>(i);
        if (i != 5)
            d.area({x, 10}, {x + 20, 30}, tag("building", "apartments") + tag("building:levels", "10"));
    }
    d.area({0, 10}, {20, 30}, tag("building", "yes"));
    d.area({0, 10}, {20, 20}, tag("building:part", "yes"));
    Result<City> city = load_text(osm_of(d));
    ASSERT_TRUE(city) << city.error().message;
    ASSERT_GE(city->buildings.size(), 11u);
    for (const Building& building : city->buildings) {
        if (building.top > 2) {
            EXPECT_GT(building.top, 27) << "nine storeys";
        }
    }
}

TEST(Osm, PassageLeadsThroughTheHouse) {
    std::string way = R"(<node id="7" lat="0.00005" lon="0.0005"/><node id="8" lat="0.0005" lon="0.0005"/>
        <way id="3"><nd ref="7"/><nd ref="8"/><tag k="highway" v="footway"/><tag k="tunnel" v="building_passage"/></way>)";
    Result<City> city = load_text(
        map_of(k_nodes + way + with_tags(k_street, "") + with_tags(k_house, "<tag k='height' v='15'/>")));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    Vec3 inside{0, 0, city->ground.high.z - 6 - 33};
    ASSERT_TRUE(ground_at(city->ground, inside, 1, 1));
    EXPECT_FALSE(ground_at(city->ground, inside + Vec3{5, 0, 0}, 1, 1));
    // Overhead the house goes on.
    bool storeys_above = false;
    for (const Building& b : city->buildings) storeys_above |= b.base > 3 && b.top > 14;
    EXPECT_TRUE(storeys_above);
}

TEST(Osm, CrossingLiesOnTheRoadWithDroppedKerbs) {
    std::string way = R"(<node id="9" lat="0" lon="0.0003"><tag k="highway" v="crossing"/></node>
        <way id="1"><nd ref="1"/><nd ref="9"/><nd ref="2"/><tag k="highway" v="residential"/><tag k="width" v="8"/></way>)";
    Result<City> city = load_text(map_of(k_nodes + way + with_tags(k_house, "")));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    float x = city->ground.low.x + 6 + 0.0003f * 111320, z = city->ground.high.z - 6;
    EXPECT_EQ(ground_at(city->ground, {x, 0, z + 3.5f}, 1, 1)->kind, Surface::crossing);
    EXPECT_FLOAT_EQ(ground_at(city->ground, {x, 0, z + 3.5f}, 1, 1)->height, 0);
    EXPECT_NEAR(ground_at(city->ground, {x, 0, z + 4.05f}, 1, 1)->height, 0.02f, 0.01f);
    EXPECT_NEAR(ground_at(city->ground, {x, 0, z + 5.5f}, 1, 1)->height, 0.12f, 1e-3f);
}

TEST(Osm, RefusesWhatIsNoCity) {
    Result<City> empty = load_text(map_of(""));
    ASSERT_FALSE(empty);
    EXPECT_NE(empty.error().message.find("neither buildings nor streets"), std::string::npos);
    Result<City> missing = load_osm("/nowhere/at all.osm");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("/nowhere/at all.osm"), std::string::npos);
    EXPECT_FALSE(load_osm("/"));
    // A street from here to the horizon, of which a part can be drawn, but not by who wants it all.
    std::string wide =
        map_of(R"(<node id="1" lat="0" lon="0"/><node id="2" lat="3" lon="1"/>)" + with_tags(k_street, ""));
    EXPECT_TRUE(load_text(wide));
    EXPECT_FALSE(city_of(*parse_osm(wide, "osm"), "wide", {}));
}

// As `gzip` packs it.
std::string gzipped(const std::string& text) {
    std::string out(compressBound(text.size()) + 64, '\0');
    z_stream stream{};
    EXPECT_EQ(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY), Z_OK);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

TEST(Osm, PackedMapsAreReadInCapitalsToo) {
    std::string text = map_of(k_nodes + with_tags(k_street, "") + with_tags(k_house, ""));
    TestFolder folder;
    for (const char* name : {"a.osm", "A.OSM"}) EXPECT_TRUE(load_osm(folder.write(name, text))) << name;
    for (const char* name : {"a.osm.gz", "A.Osm.GZ"})
        EXPECT_TRUE(load_osm(folder.write(name, gzipped(text)))) << name;
}

// Refused before it is unpacked, or taken in, as a whole.
TEST(Osm, BombsAreRefusedEarly) {
    auto refused = [](const Result<OsmMap>& map, const std::string& why) {
        ASSERT_FALSE(map);
        EXPECT_NE(map.error().message.find(why), std::string::npos) << map.error().message;
    };
    std::string blank(100 << 20, ' '), bomb = gzipped(map_of(blank));
    TestFolder folder;
    refused(parse_osm(bomb, "osm.gz"), "a hundred times");
    refused(read_osm(folder.write("blank.osm.gz", bomb)), "a hundred times");

    std::string nodes, ways, members;
    for (int i = 1; i <= 2000; ++i) {
        std::string id = std::to_string(i);
        nodes += "<node id=\"" + id + "\" lat=\"0." + id + "\" lon=\"0\"/>";
        ways += "<way id=\"" + id + "\"><nd ref=\"1\"/><nd ref=\"2\"/><tag k=\"a\" v=\"b\"/></way>";
        members += "<relation id=\"" + id + "\"><tag k=\"type\" v=\"route\"/></relation>";
    }
    for (const std::string& many : {nodes, ways, members}) {
        refused(parse_osm(map_of(many), "osm", 30'000), "more nodes, ways and tags");
        EXPECT_TRUE(parse_osm(map_of(many), "osm", 1'000'000));
    }
}

TEST(Osm, TwentyEightKilometresAreSoManyOnEveryParallel) {
    EXPECT_FALSE(is_too_wide({7, 43.7, 7.34, 43.94}));
    EXPECT_TRUE(is_too_wide({7, 43.7, 7.36, 43.94})) << "29 km from west to east";
    EXPECT_TRUE(is_too_wide({7, 43.7, 7.34, 43.96})) << "29 km from south to north";
    EXPECT_FALSE(is_too_wide({7, 60, 7.49, 60.1}));
}

TEST(Osm, TheAntimeridianIsNoEdge) {
    std::string nodes = R"(<bounds minlat="0" minlon="179.999" maxlat="0.001" maxlon="-179.999"/>
        <node id="1" lat="0" lon="179.9996"/><node id="2" lat="0" lon="-179.9994"/>)";
    Result<City> city = load_text(map_of(nodes + with_tags(k_street, "")));
    ASSERT_TRUE(city) << city.error().message;
    EXPECT_NEAR(city->ground.high.x - city->ground.low.x, 111.3f + 12, 1);
}

TEST(Osm, OddMapsDoNotCrash) {
    // A street of one node, of one place, with missing nodes; a house that crosses itself, one that stays
    // open, one of missing nodes; a relation without its ways; nonsense in tags.
    std::string odd = R"(<node id="10" lat="0" lon="0"/>
        <way id="10"><nd ref="1"/><tag k="highway" v="primary"/></way>
        <way id="11"><nd ref="1"/><nd ref="10"/><tag k="highway" v="primary"/></way>
        <way id="12"><nd ref="1"/><nd ref="77"/><nd ref="2"/><tag k="highway" v="footway"/></way>
        <way id="17"><tag k="highway" v="primary"/></way>
        <way id="13"><nd ref="3"/><nd ref="5"/><nd ref="4"/><nd ref="6"/><nd ref="3"/><tag k="building" v="yes"/></way>
        <way id="14"><nd ref="3"/><nd ref="4"/><nd ref="5"/><tag k="building" v="yes"/></way>
        <way id="15"><nd ref="3"/><nd ref="4"/><nd ref="78"/><nd ref="3"/><tag k="building" v="yes"/></way>
        <way id="16"><nd ref="3"/><nd ref="4"/><nd ref="3"/><tag k="building" v="yes"/></way>
        <relation id="1"><member type="way" ref="99" role="outer"/><tag k="type" v="multipolygon"/><tag k="building" v="yes"/></relation>)";
    Result<City> city = load_text(
        map_of(k_nodes + odd + with_tags(k_street, "<tag k='width' v='1e9'/><tag k='lanes' v='-4'/>") +
               with_tags(k_house, "<tag k='height' v='9999'/><tag k='min_height' v='-3'/>")));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    EXPECT_GE(city->notes.size(), 3u);
}

// The highest and the lowest corner of all roofs.
std::pair<float, float> roof_span(const City& city) {
    float low = 1e9f, high = -1e9f;
    for (Vec3 v : city.roof_vertices) low = std::min(low, v.y), high = std::max(high, v.y);
    return {low, high};
}

TEST(Osm, RoofsHaveTheirShapesAndHeights) {
    for (const char* shape : {"gabled", "hipped", "half-hipped", "pyramidal", "skillion", "gambrel", "round",
                              "mansard", "dome", "onion", "cone"}) {
        SCOPED_TRACE(shape);
        std::string tags =
            std::string("<tag k='height' v='12'/><tag k='roof:height' v='4'/><tag k='roof:shape' v='") +
            shape + "'/>";
        Result<City> city = load_text(map_of(k_nodes + with_tags(k_street, "") + with_tags(k_house, tags)));
        ASSERT_TRUE(city) << city.error().message;
        check_city(*city);
        auto [low, high] = roof_span(*city);
        EXPECT_NEAR(high, 12, 1e-3f);
        EXPECT_NEAR(low, 8, 1e-3f);
        EXPECT_FLOAT_EQ(city->buildings.at(0).top, 8);
        // Seen from above, the roof covers the house and nothing else, once; an onion bulges.
        double covered = 0;
        for (size_t t = 0; t < city->roof_buildings.size(); ++t) {
            Vec3 p[3];
            for (size_t k = 0; k < 3; ++k) p[k] = city->roof_vertices[city->roof_indices[3 * t + k]];
            covered += -0.5 * static_cast<double>(cross(on_ground(p[1]) - on_ground(p[0]),
                                                        on_ground(p[2]) - on_ground(p[0])));
        }
        EXPECT_NEAR(covered, 22.26 * 22.11, 6);
    }
}

TEST(Osm, PartsStandInPlaceOfTheirOutline) {
    // Over the house's western half; the other half is as high as the part's lowest top.
    std::string part = R"(<node id="7" lat="0.0002" lon="0.0005"/><node id="8" lat="0.0004" lon="0.0005"/>
        <way id="3"><nd ref="3"/><nd ref="7"/><nd ref="8"/><nd ref="6"/><nd ref="3"/>
        <tag k="building:part" v="yes"/><tag k="height" v="30"/><tag k="building:colour" v="red"/></way>)";
    Result<City> city = load_text(
        map_of(k_nodes + part + with_tags(k_street, "") + with_tags(k_house, "<tag k='height' v='15'/>")));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    ASSERT_EQ(city->buildings.size(), 2u);
    EXPECT_FLOAT_EQ(std::min(city->buildings[0].top, city->buildings[1].top), 15);
    EXPECT_FLOAT_EQ(std::max(city->buildings[0].top, city->buildings[1].top), 30);
    EXPECT_TRUE(city->buildings[0].wall_colour || city->buildings[1].wall_colour);
}

// A house of 6 m drawn over the eastern half of one of 9 m, and on to the east of it.
TEST(Osm, HousesDrawnOverOneAnotherShareNoWall) {
    const char* over = R"(<node id="7" lat="0.0002" lon="0.0005"/><node id="8" lat="0.0002" lon="0.0007"/>
<node id="9" lat="0.0004" lon="0.0007"/><node id="10" lat="0.0004" lon="0.0005"/>)";
    const char* low = R"(<way id="3"><nd ref="7"/><nd ref="8"/><nd ref="9"/><nd ref="10"/><nd ref="7"/>
<tag k="building" v="yes"/><tag k="height" v="6"/><tag k="roof:shape" v="flat"/></way>)";
    Result<City> city =
        load_text(map_of(std::string(k_nodes) + over + with_tags(k_street, "") +
                         with_tags(k_house, "<tag k='height' v='9'/><tag k='roof:shape' v='flat'/>") + low));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    ASSERT_EQ(city->buildings.size(), 2u);
    // The fronts to the north and south, by house: 22 m of the high one, 11 m of the low one.
    float width[2] = {0, 0};
    for (const Face& f : city->ground.faces) {
        if (f.kind != FaceKind::facade || std::abs(f.b.z - f.a.z) > 0.1f) continue;
        width[f.a_top > 8 ? 0 : 1] += std::abs(f.b.x - f.a.x);
    }
    EXPECT_NEAR(width[0], 2 * 22.3f, 0.5f);
    EXPECT_NEAR(width[1], 2 * 11.1f, 0.5f);
}

// A spire of 20 m whose walls are lower than the house that it stands in.
TEST(Osm, RoofsAboveOtherHousesStay) {
    const char* spire = R"(<node id="7" lat="0.00025" lon="0.00045"/><node id="8" lat="0.00025" lon="0.0005"/>
<node id="9" lat="0.0003" lon="0.0005"/><node id="10" lat="0.0003" lon="0.00045"/>
<way id="3"><nd ref="7"/><nd ref="8"/><nd ref="9"/><nd ref="10"/><nd ref="7"/><tag k="building" v="yes"/>
<tag k="height" v="20"/><tag k="roof:shape" v="pyramidal"/><tag k="roof:height" v="13"/></way>)";
    Result<City> city = load_text(
        map_of(std::string(k_nodes) + with_tags(k_street, "") +
               with_tags(k_house, "<tag k='height' v='9'/><tag k='roof:shape' v='flat'/>") + spire));
    ASSERT_TRUE(city) << city.error().message;
    float peak = 0;
    for (Vec3 v : city->roof_vertices) peak = std::max(peak, v.y);
    EXPECT_NEAR(peak, 20, 0.2f);
}

TEST(Osm, ColoursAreReadAndTamed) {
    for (const char* none : {"", "#12", "#12345g", "octarine", "#1234567"})
        EXPECT_EQ(parse_colour(none, false), 0u) << none;
    EXPECT_EQ(parse_colour("#fff", false), parse_colour("#FFFFFF", false));
    uint32_t red = parse_colour("#ff0000", false), black = parse_colour("black", true);
    EXPECT_GT(red & 0xff, red >> 8 & 0xff);
    EXPECT_LT(red & 0xff, 0xf8u) << "nothing glares";
    EXPECT_GT(black & 0xff, 0x30u) << "nothing is pitch-dark";
    EXPECT_EQ(red >> 24, 0xffu);
}

TEST(Osm, TalliesTellWhatWasBuilt) {
    Result<City> city = load_text(map_of(k_nodes + with_tags(k_street, "<tag k='sidewalk' v='both'/>") +
                                         with_tags(k_house, "<tag k='roof:shape' v='dome'/>")));
    ASSERT_TRUE(city);
    auto tally = [&](const std::string& what) {
        for (const City::Tally& t : city->tallies) {
            if (t.what == what) return std::pair(t.found, t.built);
        }
        return std::pair(0, 0);
    };
    EXPECT_EQ(tally("buildings"), std::pair(1, 1));
    EXPECT_EQ(tally("without height or levels"), std::pair(1, 1));
    EXPECT_EQ(tally("roofs dome"), std::pair(1, 1));
    EXPECT_EQ(tally("roads with sidewalk=*").first, 1);
}

// What is built of points is found too, and so is what stands without being called a building.
TEST(Osm, TalliesCountWhatIsNoBuildingByName) {
    Result<City> city =
        load_text(map_of(k_nodes + std::string(R"(
<node id="7" lat="0.0006" lon="0.0002"><tag k="man_made" v="chimney"/></node>
<node id="8" lat="0.0006" lon="0.0004"><tag k="man_made" v="obelisk"/><tag k="height" v="9"/></node>
<node id="9" lat="0.0006" lon="0.0006"><tag k="man_made" v="mast"/><tag k="height" v="9"/></node>
<node id="10" lat="0.001" lon="0"/>)") +
                         with_tags(k_street, "") +
                         R"(<way id="2"><nd ref="3"/><nd ref="4"/><nd ref="5"/><nd ref="6"/><nd ref="3"/>
<tag k="man_made" v="silo"/></way>
<way id="3"><nd ref="1"/><nd ref="10"/><tag k="highway" v="footway"/></way>)"));
    ASSERT_TRUE(city);
    for (const City::Tally& t : city->tallies) {
        int expected = t.what == "buildings" ? 3 : t.what == "without height or levels" ? 2 : -1;
        if (expected < 0) continue;
        EXPECT_EQ(t.built, expected) << t.what;
        EXPECT_EQ(t.found, expected) << t.what;
    }
    EXPECT_EQ(city->buildings.size(), 3u);
}

// Bounded time and memory, whatever numbers say.
TEST(Osm, HostileSizesStaySmall) {
    for (const char* tags :
         {"<tag k='building:levels' v='1000000'/>", "<tag k='height' v='1e9'/>",
          "<tag k='height' v='100000000'/>",
          "<tag k='roof:height' v='99999999'/><tag k='roof:shape' v='onion'/>",
          "<tag k='roof:levels' v='999999'/><tag k='roof:shape' v='hipped'/>",
          "<tag k='min_height' v='99999999'/>", "<tag k='building:min_level' v='-99999999'/>"}) {
        Result<City> city = load_text(map_of(k_nodes + with_tags(k_street, "") + with_tags(k_house, tags)));
        ASSERT_TRUE(city) << tags;
        EXPECT_LT(roof_span(*city).second, 1200) << tags;
    }
    // A way of 100,000 nodes, one that crosses itself a million times, and a street round half the earth.
    std::string nodes, longest = "<way id='9'>", star = "<way id='10'>";
    for (int i = 0; i < 100'000; ++i) {
        std::string id = std::to_string(1000 + i % 1500);
        longest += "<nd ref='" + id + "'/>";
        if (i >= 1500) continue;
        int to = i * 743 % 1500;
        nodes += "<node id='" + id + "' lat='" + std::to_string(0.0006 + 1e-6 * (to % 39)) + "' lon='" +
                 std::to_string(1e-6 * (to / 39)) + "'/>";
        star += "<nd ref='" + id + "'/>";
    }
    longest += "<tag k='highway' v='footway'/></way>";
    star += "<nd ref='1000'/><tag k='building' v='yes'/></way>";
    nodes += "<node id='7' lat='0' lon='179'/>";
    std::string far_away = "<way id='11'><nd ref='1'/><nd ref='7'/><tag k='highway' v='footway'/></way>";
    std::string box = "<bounds minlat='0' minlon='0' maxlat='0.001' maxlon='0.001'/>";
    Result<City> city = load_text(map_of(box + k_nodes + nodes + with_tags(k_street, "") +
                                         with_tags(k_house, "") + longest + star + far_away));
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    EXPECT_LT(city->ground.kinds.size(), 200'000u);
}

// Flat, on the same map raised by a slope of one in ten.
TEST(Osm, TerrainCarriesHousesAndStreets) {
    std::string slope(2 * 1201 * 1201, '\0');
    for (size_t i = 0; i < 1201u * 1201; ++i) {  // 9.3 m higher with each sample to the east
        size_t height = i % 1201 * 8;
        slope[2 * i] = static_cast<char>(height >> 8), slope[2 * i + 1] = static_cast<char>(height);
    }
    Temporary hgt("N00E000.hgt", slope);
    const fs::path& tile = hgt.path;
    Temporary file("map.osm",
                   map_of(k_nodes + with_tags(k_street, "") + with_tags(k_house, "<tag k='height' v='9'/>")));
    Result<City> city = load_osm(file.path.string(), {tile.string()});
    Result<Terrain> terrain = read_terrain(tile.string(), {0, 0, 0.001, 0.0004});
    auto filed = [&](float x) { return height_at(*terrain, 0.0005 + static_cast<double>(x) / 111'320, 0); };
    ASSERT_TRUE(city) << city.error().message;
    check_city(*city);
    float z = city->ground.high.z - 6;
    auto height = [&](float x) { return ground_at(city->ground, {x, 5, z}, 20, 20)->height; };
    EXPECT_GT(height(30) - height(-30), 3);
    EXPECT_NEAR(height(30) - height(-30), filed(30) - filed(-30), 0.2f);
    EXPECT_NEAR(height(-54), 0.6f, 0.7f) << "y = 0 is the lowest ground";
    // The house stands from its lowest ground and is as high as it says above it.
    const Building& house = city->buildings.at(0);
    EXPECT_NEAR(house.top - house.base, 9, 0.3f);
    EXPECT_NEAR(house.base, height(-11), 0.5f);
}

TEST(Osm, RealMapsMakeSoundCities) {
    NEEDS_CORPUS();
    for (const char* name :
         {"berlin_neukolln_2024.osm", "monaco_2021.osm.pbf", "austin_downtown_2019.osm.pbf",
          "london_moorgate_2024.osm.pbf", "taipei_2024.osm", "nyc_manhattan_2015_unsorted.osm.pbf"}) {
        SCOPED_TRACE(name);
        Result<City> city = load_osm((corpus() / name).string());
        ASSERT_TRUE(city) << city.error().message;
        EXPECT_GT(city->buildings.size(), 50u);
        check_city(*city);
    }
}

TEST(Osm, ImportRepeatsItself) {
    NEEDS_CORPUS();
    std::string path = (corpus() / "berlin_neukolln_2024.osm").string();
    EXPECT_EQ(hash_city(*load_osm(path)), hash_city(*load_osm(path)));
}

TEST(Osm, TestDataLoadsOrIsRefused) {
    NEEDS_CORPUS();
    Result<City> none = load_osm((corpus() / "osm-testdata" / "multipolygon_testcases.osm").string());
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("multipolygon_testcases.osm"), std::string::npos);
    Result<City> grid = load_osm((corpus() / "osm-testdata" / "grid_all.osm").string());
    if (!grid) {
        EXPECT_NE(grid.error().message.find("grid_all.osm"), std::string::npos);
    }
}

TEST(Osm, SpoiltFilesDoNotCrash) {
    NEEDS_CORPUS();
    for (const char* name : {"taipei_2024.osm", "london_moorgate_2024.osm.pbf"}) {
        std::string whole = read(corpus() / name);
        for (size_t seed = 0; seed < 6; ++seed) {
            std::string spoilt = whole;
            for (size_t i = 0; i < 40; ++i) {
                uint64_t r = random_bits({seed, 0, 0, Purpose::spawn}, static_cast<uint32_t>(i));
                spoilt[r % spoilt.size()] = static_cast<char>(r >> 56);
            }
            Temporary file(name, spoilt);
            Result<City> city = load_osm(file.path.string());
            if (!city) {
                EXPECT_FALSE(city.error().message.empty());
            }
        }
    }
}

// A small map of everything, cut short or with bytes changed, is loaded or refused.
TEST(Osm, SpoiltSmallMapsDoNotCrash) {
    std::string whole =
        map_of(k_nodes + with_tags(k_street, "<tag k='sidewalk' v='both'/><tag k='lanes' v='2'/>") +
               with_tags(k_house, "<tag k='height' v='12'/><tag k='roof:shape' v='gabled'/>") +
               R"(<way id="5"><nd ref="1"/><nd ref="4"/><nd ref="5"/><tag k="highway" v="steps"/></way>
        <way id="6"><nd ref="2"/><nd ref="6"/><tag k="barrier" v="wall"/></way>
        <relation id="1"><member type="way" ref="2" role="outer"/><tag k="type" v="multipolygon"/>
        <tag k="leisure" v="park"/></relation>)");
    int loaded = 0;
    for (uint64_t seed = 0; seed < 400; ++seed) {
        std::string spoilt = whole;
        for (uint32_t i = 0; i < 1 + seed % 4; ++i) {
            uint64_t r = random_bits({seed, 0, 0, Purpose::spawn}, i);
            // Mostly digits and letters for others, so that much of it still can be read.
            char& victim = spoilt[r % spoilt.size()];
            victim = seed % 5 == 0 ? static_cast<char>(r >> 56) : static_cast<char>('0' + (r >> 56) % 75);
        }
        if (seed % 7 == 0) spoilt.resize(spoilt.size() * (seed + 1) / 402);
        Result<OsmMap> map = parse_osm(spoilt, "osm");
        if (!map) continue;
        Result<City> city = city_of(*map, "spoilt", {});
        loaded += city ? 1 : 0;
    }
    EXPECT_GT(loaded, 20);
}

TEST(Osm, CutFilesAndNoiseAreRefused) {
    NEEDS_CORPUS();
    for (const char* name :
         {"berlin_neukolln_2024.osm", "monaco_2021.osm.pbf", "london_moorgate_2024.osm.pbf"}) {
        std::string whole = read(corpus() / name);
        for (size_t part : {1, 3, 5, 9}) {
            Temporary file(name, whole.substr(0, whole.size() * part / 10));
            Result<City> city = load_osm(file.path.string());
            ASSERT_FALSE(city) << name << " cut to " << part << " tenths";
            EXPECT_NE(city.error().message.find(file.path.string()), std::string::npos);
        }
    }
    for (const char* name : {"noise.osm", "noise.osm.pbf", "noise.xyz", "noise"}) {
        Temporary file(name, "\x7f not a map \x01\x02\x03 at all");
        EXPECT_FALSE(load_osm(file.path.string())) << name;
        Temporary empty(std::string("empty_") + name, "");
        EXPECT_FALSE(load_osm(empty.path.string())) << name;
    }
}

}  // namespace
}  // namespace flaneur
