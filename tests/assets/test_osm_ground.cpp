// What lies between the houses of mapped cities: paving, railways, platforms; and what is no house.
#include <gtest/gtest.h>

#include <array>

#include "assets/cities.h"
#include "assets/osm/decks.h"
#include "assets/osm/map.h"
#include "assets/plan/masses.h"
#include "assets/plan/streets.h"
#include "sim/navigation/navmesh.h"
#include "tests/assets/city_checks.h"
#include "tests/assets/osm_drawing.h"

namespace flaneur {
namespace {

// The city of a drawing, which is about (0, 0).
City build(const Drawing& drawing) {
    Result<OsmMap> map = parse_osm(osm_of(drawing), "osm");
    EXPECT_TRUE(map) << map.error().message;
    OsmImport in{*map, projection_about(0, 0), {}, {}, {}};
    in.plan.low = {-60, -60};
    in.plan.high = {60, 60};
    in.plan.cell = 16;
    add_osm_buildings(in);
    add_osm_outdoors(in);
    return std::move(in.city);
}

// The ground at a place, about the height of kerbs.
struct Here {
    Surface kind;
    float height;
    bool is_bare;  // asphalt or ballast
};
Here here(const City& city, Vec2 p) {
    std::optional<GroundHit> hit = ground_at(city.ground, at_height(p, 0.2f), 0.5f, 0.5f);
    EXPECT_TRUE(hit) << p.x << ", " << p.z;
    if (!hit) return {Surface::water, -99, false};
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        bool inside = city.ground.kinds[t] == hit->kind;
        for (size_t e = 0; inside && e < 3; ++e) {
            Vec2 a = on_ground(corner(city, t, e)), b = on_ground(corner(city, t, (e + 1) % 3));
            inside = cross(p - a, b - a) >= 0;
        }
        if (inside) return {hit->kind, hit->height, city.ground_axes[t] == Vec2{}};
    }
    return {hit->kind, hit->height, false};
}
Surface kind_at(const City& city, Vec2 p) { return here(city, p).kind; }

std::string house() { return tag("building", "yes") + tag("height", "9") + tag("roof:shape", "flat"); }

// Houses along both sides of a street that runs east, so far from its middle.
Drawing street_of_houses(const std::string& tags, float off) {
    Drawing d;
    d.way({{-50, 0}, {50, 0}}, tags);
    for (float side : {-1.0f, 1.0f}) {
        float near = side * off, far = side * (off + 10);
        d.area({-30, std::min(near, far)}, {0, std::max(near, far)}, house());
        d.area({6, std::min(near, far)}, {30, std::max(near, far)}, house());
    }
    return d;
}

TEST(OsmGround, PedestrianStreetsArePavedFromWallToWall) {
    for (const char* kind : {"pedestrian", "living_street"}) {
        Drawing d = street_of_houses(tag("highway", kind), 9);
        d.area({-20, -9}, {-10, -5}, tag("landuse", "grass"));
        City city = build(d);
        check_city(city);
        for (float z = -8.9f; z < 9; z += 0.37f) {
            EXPECT_EQ(kind_at(city, {-5, z}), Surface::plaza) << kind << " at " << z;
            EXPECT_FLOAT_EQ(here(city, {-5, z}).height, k_kerb) << kind << " has no kerbs";
            EXPECT_FALSE(here(city, {-5, z}).is_bare) << "slabs";
        }
        EXPECT_EQ(kind_at(city, {3, 8}), Surface::plaza) << "in line with the houses";
        EXPECT_EQ(kind_at(city, {3, 11}), Surface::grass) << "but not between them";
        EXPECT_EQ(kind_at(city, {-15, -7}), Surface::grass) << "the map's own green";
        EXPECT_EQ(kind_at(city, {45, 6}), Surface::grass) << "no houses";
    }
}

TEST(OsmGround, PedestrianStreetsReachTheNextLane) {
    Drawing d;
    d.way({{-50, 0}, {50, 0}}, tag("highway", "pedestrian"));
    d.way({{-50, 10}, {50, 10}}, tag("highway", "residential") + tag("width", "6") + tag("sidewalk", "no"));
    City city = build(d);
    EXPECT_EQ(kind_at(city, {0, 5}), Surface::plaza);
    EXPECT_TRUE(here(city, {0, 8}).is_bare) << "the lane";
    EXPECT_EQ(kind_at(city, {0, -5}), Surface::grass);
}

TEST(OsmGround, LanesWithoutSidewalksReachTheHouses) {
    std::string lane = tag("highway", "residential") + tag("width", "5") + tag("sidewalk", "no");
    City city = build(street_of_houses(lane, 5));
    for (float z = -4.9f; z < 5; z += 0.37f) {
        EXPECT_TRUE(here(city, {-15, z}).is_bare) << z;
        EXPECT_FLOAT_EQ(here(city, {-15, z}).height, 0) << z;
    }
    // Houses with gardens before them keep those.
    City gardens = build(street_of_houses(lane, 12));
    EXPECT_EQ(kind_at(gardens, {-15, 4}), Surface::grass);
    City one_side = build(street_of_houses(tag("highway", "residential") + tag("width", "5") +
                                               tag("sidewalk", "left") + tag("sidewalk:width", "2"),
                                           5));
    EXPECT_EQ(kind_at(one_side, {-15, 4}), Surface::sidewalk);
    EXPECT_FLOAT_EQ(here(one_side, {-15, 4}).height, k_kerb);
}

TEST(OsmGround, AlleysReachTheHouses) {
    City city = build(street_of_houses(tag("highway", "footway") + tag("width", "2"), 2.5f));
    for (float z = -2.4f; z < 2.5f; z += 0.31f) EXPECT_EQ(kind_at(city, {-15, z}), Surface::path) << z;
    City service = build(street_of_houses(tag("highway", "service") + tag("service", "alley"), 3.5f));
    for (float z = -3.4f; z < 3.5f; z += 0.31f) EXPECT_TRUE(here(service, {-15, z}).is_bare) << z;
    // A path along one house runs through its garden.
    Drawing d;
    d.way({{-50, 0}, {50, 0}}, tag("highway", "footway") + tag("width", "2"));
    d.area({-30, 2.5f}, {0, 12}, house());
    EXPECT_EQ(kind_at(build(d), {-15, 1.8f}), Surface::grass);
}

TEST(OsmGround, SquaresReachTheHouses) {
    Drawing d;
    d.area({-20, -20}, {20, 20}, tag("place", "square"));
    d.area({-20, 23}, {20, 40}, house());
    City city = build(d);
    EXPECT_EQ(kind_at(city, {0, 22}), Surface::plaza);
    EXPECT_EQ(kind_at(city, {0, -22}), Surface::grass);

    // Round every corner alike, the one that the map begins with too.
    Drawing about;
    about.area({-20, -20}, {20, 20}, tag("place", "square"));
    for (float side : {-1.0f, 1.0f}) {
        about.area({-40, std::min(24 * side, 40 * side)}, {40, std::max(24 * side, 40 * side)}, house());
        about.area({std::min(24 * side, 40 * side), -23.5f}, {std::max(24 * side, 40 * side), 23.5f},
                   house());
    }
    City square = build(about);
    for (float x : {-22.0f, 22.0f})
        for (float z : {-22.0f, 22.0f}) EXPECT_EQ(kind_at(square, {x, z}), Surface::plaza) << x << ", " << z;
}

// Two carriageways that run together, 2 degrees apart: what is left between them is an island, and its end no
// wedge.
TEST(OsmGround, KerbsEndInNosesAndNoWedges) {
    Drawing d;
    std::string one_way =
        tag("highway", "primary") + tag("oneway", "yes") + tag("width", "6") + tag("sidewalk", "no");
    d.way({{-50, 0}, {50, 0}}, one_way);
    d.way({{-50, 10}, {50, 2}}, one_way);
    d.area({-50, -30}, {-40, -20}, house());
    City city = build(d);
    check_city(city);
    float narrowest = 99;
    for (float x = -49; x < 49; x += 0.5f) {
        float width = 0;
        for (float z = 2.9f; z < 9.9f - 0.08f * (x + 50); z += 0.02f)
            width += kind_at(city, {x, z}) == Surface::road ? 0 : 0.02f;
        if (width > 0) narrowest = std::min(narrowest, width);
    }
    EXPECT_GT(narrowest, 1);
    EXPECT_LT(narrowest, 2);
    EXPECT_NE(kind_at(city, {-45, 5}), Surface::road) << "the island";
}

// Rails that stand on ballast: the highest corners of roofs about there.
int upright_rails(const City& city, Vec2 low, Vec2 high) {
    int count = 0;
    for (Vec3 v : city.roof_vertices)
        count +=
            v.x > low.x && v.x < high.x && v.z > low.z && v.z < high.z && v.y > k_track + 0.08f && v.y < 0.5f;
    return count;
}

TEST(OsmGround, TracksAreNotWalkedOn) {
    // A railway to the east, which a footway crosses.
    Drawing d;
    int crossed = d.node(20, 0);
    d.way({d.node(-75, 0), crossed, d.node(75, 0)}, tag("railway", "rail"));
    d.way({d.node(20, -50), crossed, d.node(20, 50)}, tag("highway", "footway"));
    City city = build(d);
    EXPECT_EQ(kind_at(city, {-10, 0.5f}), Surface::track);
    EXPECT_EQ(kind_at(city, {-10, 2.2f}), Surface::track);
    EXPECT_FALSE(here(city, {-10, 0.5f}).is_bare) << "sleepers";
    EXPECT_TRUE(here(city, {-10, 2.2f}).is_bare) << "ballast";
    EXPECT_EQ(kind_at(city, {-10, 4}), Surface::grass);
    EXPECT_EQ(kind_at(city, {20, 0}), Surface::path) << "a crossing";
    EXPECT_GT(upright_rails(city, {-61, -1}, {19.2f, 1}), 0);
    EXPECT_EQ(upright_rails(city, {19.3f, -1}, {20.7f, 1}), 0);
    ASSERT_FALSE(city.grooves.empty());
    for (const City::Groove& g : city.grooves) EXPECT_NEAR(g.a.x, 20, 1.8f);
    Result<NavmeshPtr> mesh = build_navmesh(city.ground, {}, 1);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_FALSE(nearest(**mesh, 0, {-10, 0, 0}, {1, 1, 1}));
    std::optional<NavPoint> from = nearest(**mesh, 0, {-30, k_kerb, -10}, {1, 0.6f, 1}),
                            to = nearest(**mesh, 0, {-30, k_kerb, 10}, {1, 0.6f, 1});
    ASSERT_TRUE(from && to);
    Vec3 corners[64];
    int count = find_path(**mesh, 0, *from, *to, corners, 64);
    ASSERT_GT(count, 0);
    EXPECT_LT(length(corners[count - 1] - to->position), 0.1f);
    for (int i = 0; i + 1 < count; ++i) {
        if ((corners[i].z < 0) == (corners[i + 1].z < 0)) continue;
        float share = corners[i].z / (corners[i].z - corners[i + 1].z);
        EXPECT_NEAR(lerp(corners[i].x, corners[i + 1].x, share), 20, 2) << "over the crossing";
    }
}

TEST(OsmGround, YardsAreNotWalkedOn) {
    Drawing d;
    d.area({-50, -10}, {50, 10}, tag("landuse", "railway"));
    d.way({{0, -50}, {0, 50}}, tag("highway", "footway"));
    City city = build(d);
    EXPECT_EQ(kind_at(city, {-20, 5}), Surface::track);
    EXPECT_EQ(kind_at(city, {0, 5}), Surface::path);
}

TEST(OsmGround, TramsRunInTheStreet) {
    Drawing d;
    d.way({{-55, 0}, {30, 0}}, tag("highway", "residential") + tag("width", "8"));
    d.way({{-55, 1.5f}, {55, 1.5f}}, tag("railway", "tram"));
    City city = build(d);
    for (float x = -50; x < 28; x += 3) {
        EXPECT_EQ(kind_at(city, {x, 1.5f}), Surface::road) << x;
        EXPECT_EQ(kind_at(city, {x, 2.2f}), Surface::road) << x;
    }
    EXPECT_EQ(upright_rails(city, {-55, 0}, {30, 3}), 0);
    float flush = 0;
    for (const City::Groove& g : city.grooves) flush += length(g.b - g.a);
    EXPECT_GT(flush, 2 * 80);
    EXPECT_EQ(kind_at(city, {48, 1.5f}), Surface::track) << "beyond the street a bed of its own";
    EXPECT_GT(upright_rails(city, {40, 0}, {56, 3}), 0);

    // Up to their bridge too.
    Drawing bridge;
    bridge.way({{-55, 0}, {30, 0}}, tag("highway", "residential") + tag("width", "8"));
    int a = bridge.node(-55, 1.5f), b = bridge.node(32, 1.5f), c = bridge.node(55, 1.5f);
    bridge.way({a, b}, tag("railway", "tram"));
    bridge.way({b, c}, tag("railway", "tram") + tag("bridge", "yes") + tag("layer", "1"));
    EXPECT_EQ(kind_at(build(bridge), {-20, 1.5f}), Surface::road);
}

TEST(OsmGround, PlatformsAreSteppedUpTo) {
    Drawing d;
    d.way({{-55, 0}, {55, 0}}, tag("railway", "rail"));
    d.area({-30, 2}, {30, 7}, tag("railway", "platform") + tag("area", "yes"));
    d.way({{-30, -4}, {30, -4}}, tag("railway", "platform") + tag("width", "4"));
    d.way({{0, 40}, {0, 6}}, tag("highway", "footway"));
    City city = build(d);
    for (Vec2 p : {Vec2{0, 4}, Vec2{0, -4}}) {
        EXPECT_EQ(kind_at(city, p), Surface::plaza);
        EXPECT_NEAR(here(city, p).height, 0.36f, 1e-3f);
    }
    Result<NavmeshPtr> mesh = build_navmesh(city.ground, {}, 1);
    ASSERT_TRUE(mesh) << mesh.error().message;
    std::optional<NavPoint> from = nearest(**mesh, 0, {0, k_kerb, 30}, {1, 0.6f, 1}),
                            to = nearest(**mesh, 0, {10, 0.36f, 4.5f}, {1, 0.6f, 1});
    ASSERT_TRUE(from && to);
    Vec3 corners[64];
    int count = find_path(**mesh, 0, *from, *to, corners, 64);
    ASSERT_GT(count, 0);
    EXPECT_LT(length(corners[count - 1] - to->position), 0.1f);
    // Both drop to the ballast, with an edge that looks that way.
    for (float side : {-1.0f, 1.0f}) {
        std::optional<RayHit> edge = raycast(city.ground, {5, 0.1f, 0.3f * side}, {0, 0, side}, 4);
        ASSERT_TRUE(edge) << side;
        EXPECT_EQ(edge->what, RayHit::What::face);
        EXPECT_NEAR(edge->distance, 1.7f, 0.02f);
        EXPECT_LT(edge->normal.z * side, -0.9f);
    }
}

TEST(OsmGround, StreetsAndTracksPassOverOneAnother) {
    Drawing over;
    over.way({{-55, 0}, {55, 0}}, tag("railway", "rail"));
    int a = over.node(0, -55), b = over.node(0, -50), c = over.node(0, 50), e = over.node(0, 55);
    over.way({a, b}, tag("highway", "footway"));
    over.way({b, c}, tag("highway", "footway") + tag("bridge", "yes") + tag("layer", "1"));
    over.way({c, e}, tag("highway", "footway"));
    City city = build(over);
    std::optional<GroundHit> deck = ground_at(city.ground, {0, 5, 0}, 1, 1);
    ASSERT_TRUE(deck);
    EXPECT_GT(deck->height, 4);
    EXPECT_EQ(kind_at(city, {0, 0.1f}), Surface::track) << "the railway goes on below";

    Drawing under;
    int f = under.node(-58, 0), g = under.node(-10, 0), h = under.node(10, 0), i = under.node(58, 0);
    under.way({f, g}, tag("railway", "rail"));
    under.way({g, h}, tag("railway", "rail") + tag("bridge", "viaduct") + tag("layer", "1"));
    under.way({h, i}, tag("railway", "rail"));
    under.way({{0, -50}, {0, 50}}, tag("highway", "residential") + tag("width", "7"));
    City bridge = build(under);
    EXPECT_EQ(kind_at(bridge, {0, 0.3f}), Surface::road) << "the street goes on below";
    std::optional<GroundHit> bed = ground_at(bridge.ground, {0, 4.5f, 0.3f}, 1.5f, 1.5f);
    ASSERT_TRUE(bed);
    EXPECT_EQ(bed->kind, Surface::track);
    float lowest = 99;
    for (Vec3 v : bridge.roof_vertices)
        if (std::fabs(v.x) < 5 && std::fabs(v.z) < 0.8f && std::fabs(v.z) > 0.6f)
            lowest = std::min(lowest, v.y);
    EXPECT_GT(lowest, 3) << "rails on the bridge alone";
}

// Tracks leave the ground near their bridges only, however long the way is that leads there.
TEST(OsmGround, TracksAwayFromTheirBridgesAreCrossed) {
    // The way that crosses it is far from the bridge, or near.
    for (float crossing : {-40.0f, 15.0f}) {
        Drawing d;
        int crossed = d.node(crossing, 0), bend = d.node(25, 0), abutment = d.node(40, 0);
        d.way({d.node(-58, 0), crossed, bend, abutment}, tag("railway", "rail"));
        d.way({abutment, d.node(58, 0)}, tag("railway", "rail") + tag("bridge", "yes") + tag("layer", "1"));
        d.way({{50, -50}, {50, 50}}, tag("highway", "footway"));
        d.way({d.node(crossing, -50), crossed, d.node(crossing, 50)}, tag("highway", "footway"));
        City city = build(d);
        EXPECT_EQ(kind_at(city, {-30, 0.5f}), Surface::track) << "on the ground";
        EXPECT_NEAR(here(city, {-30, 0.5f}).height, k_track, 1e-3f);
        EXPECT_EQ(kind_at(city, {crossing, 0.5f}), Surface::path) << "a level crossing";
        std::optional<GroundHit> bridge = ground_at(city.ground, {50, 4, 0.5f}, 2.5f, 2.5f);
        ASSERT_TRUE(bridge);
        EXPECT_EQ(bridge->kind, Surface::track);
        EXPECT_GT(bridge->height, 3);
        Result<NavmeshPtr> mesh = build_navmesh(city.ground, {}, 1);
        ASSERT_TRUE(mesh) << mesh.error().message;
        std::optional<NavPoint> from = nearest(**mesh, 0, {crossing, k_kerb, -20}, {1, 0.6f, 1}),
                                to = nearest(**mesh, 0, {crossing, k_kerb, 20}, {1, 0.6f, 1});
        ASSERT_TRUE(from && to);
        Vec3 corners[64];
        int count = find_path(**mesh, 0, *from, *to, corners, 64);
        ASSERT_GT(count, 0);
        EXPECT_LT(length(corners[count - 1] - to->position), 0.1f);
        float walked = 0;
        for (int i = 0; i + 1 < count; ++i) walked += length(corners[i + 1] - corners[i]);
        EXPECT_LT(walked, 41) << "straight across";
    }
}

TEST(OsmGround, WhatIsHiddenIsNotLaid) {
    Drawing d;
    d.way({{-55, 0}, {55, 0}}, tag("railway", "rail") + tag("tunnel", "yes"));
    d.way({{-55, 10}, {55, 10}}, tag("railway", "subway") + tag("layer", "-2"));
    d.way({{-55, 20}, {55, 20}}, tag("railway", "abandoned"));
    d.area({-30, -12}, {30, -8}, tag("railway", "platform") + tag("level", "-1"));
    City city = build(d);
    for (float z : {0.0f, 10.0f, 20.0f, -10.0f}) EXPECT_EQ(kind_at(city, {5, z}), Surface::grass) << z;
    EXPECT_TRUE(city.grooves.empty());
}

TEST(OsmGround, WhatIsNoHouseHasNoWindows) {
    auto finish = [](const std::string& tags) {
        Drawing d;
        d.area({-5, -5}, {5, 5}, tags);
        City city = build(d);
        EXPECT_FALSE(city.buildings.empty()) << tags;
        return city.buildings.empty() ? Finish::windows : city.buildings[0].finish;
    };
    std::string yes = tag("building", "yes");
    EXPECT_EQ(finish(yes), Finish::windows);
    EXPECT_EQ(finish(tag("building", "apartments")), Finish::windows);
    EXPECT_EQ(finish(tag("building", "greenhouse")), Finish::glass);
    for (const char* kind : {"garage", "shed", "silo", "stadium", "barn", "water_tower"})
        EXPECT_EQ(finish(tag("building", kind)), Finish::plain) << kind;
    for (const char* kind : {"chimney", "obelisk", "tower"})
        EXPECT_EQ(finish(yes + tag("man_made", kind)), Finish::stone) << kind;
    for (const char* kind : {"storage_tank", "gasometer", "silo"})
        EXPECT_EQ(finish(tag("man_made", kind)), Finish::plain) << kind << ", which no building tag names";
    EXPECT_EQ(finish(yes + tag("historic", "monument")), Finish::stone);
    EXPECT_EQ(finish(tag("building", "tower") + tag("building:levels", "20")), Finish::windows)
        << "people live there";
    EXPECT_EQ(finish(yes + tag("historic", "monument") + tag("building:levels", "4")), Finish::windows);
}

TEST(OsmGround, ChurchesHaveTallWindows) {
    for (const std::string& tags :
         {tag("building", "church"), tag("building", "cathedral"), tag("building", "mosque"),
          tag("building", "yes") + tag("amenity", "place_of_worship")}) {
        Drawing d;
        d.area({-10, -20}, {10, 20}, tags + tag("height", "14") + tag("roof:shape", "flat"));
        City city = build(d);
        ASSERT_EQ(city.buildings.size(), 1u) << tags;
        EXPECT_GT(city.buildings[0].storey, 4.5f) << tags;
        EXPECT_EQ(city.buildings[0].finish, Finish::windows);
        EXPECT_EQ(city.buildings[0].style, 0) << "limestone";
    }
    // A church tower is of stone.
    Drawing d;
    d.area({-3, -3}, {3, 3}, tag("building", "church") + tag("height", "40") + tag("roof:shape", "flat"));
    EXPECT_EQ(build(d).buildings.at(0).finish, Finish::stone);
}

TEST(OsmGround, StructuresOfOnePointStand) {
    Drawing d;
    d.node(0, 0, tag("man_made", "chimney") + tag("height", "30") + tag("diameter", "4"));
    d.node(20, 0, tag("man_made", "tower") + tag("tower:type", "communication"));
    d.way({{-50, 30}, {50, 30}}, tag("highway", "residential"));
    City city = build(d);
    ASSERT_EQ(city.buildings.size(), 1u) << "aerials are on roofs";
    EXPECT_EQ(city.buildings[0].finish, Finish::stone);
    EXPECT_NEAR(city.buildings[0].top, 30, 1);
    EXPECT_FALSE(ground_at(city.ground, {0, 0, 0}, 1, 1)) << "nobody walks through it";
    EXPECT_TRUE(ground_at(city.ground, {2.3f, 0, 0}, 1, 1));
}

// A column on its plinth, whose relation says what both are.
TEST(OsmGround, RelationsSayWhatTheirPartsAre) {
    for (const std::string& what : {tag("historic", "monument"), tag("man_made", "column")}) {
        Drawing d;
        int plinth = d.next + 4;
        d.area({-10, -10}, {10, 10}, tag("building", "yes") + tag("height", "9"));
        int column = d.next + 4;
        d.area({12, -3}, {18, 3}, tag("building:part", "yes") + tag("height", "50"));
        auto member = [](int way, const std::string& role) {
            return "<member type=\"way\" ref=\"" + std::to_string(way) + "\" role=\"" + role + "\"/>";
        };
        d.ways += "<relation id=\"1\">" + member(plinth, "outline") + member(column, "part") +
                  tag("type", "building") + what + "</relation>";
        City city = build(d);
        ASSERT_EQ(city.buildings.size(), 2u);
        for (const Building& b : city.buildings) EXPECT_EQ(b.finish, Finish::stone) << b.top;
        float low = 99;
        for (const Building& b : city.buildings) low = std::min(low, b.top);
        EXPECT_FLOAT_EQ(low, 9) << "the plinth, once";
    }
}

// Parts without tags of their own are what their outline is, however broad; where people live in it they
// look out.
TEST(OsmGround, PartsAreWhatTheirOutlineIs) {
    auto finishes = [](const std::string& outline, const std::string& part) {
        Drawing d;
        d.area({-30, -30}, {30, 30}, outline + tag("height", "18"));
        for (float half : {13.0f, 9.0f, 3.0f}) {
            std::string from = std::to_string(static_cast<int>(60 - 3 * half));
            d.area(
                {-half, -half}, {half, half},
                part + tag("min_height", from) + tag("height", std::to_string(70 - static_cast<int>(half))));
        }
        std::array<int, 4> counts{};
        for (const Building& b : build(d).buildings) ++counts[static_cast<size_t>(b.finish)];
        return counts;
    };
    const std::string part = tag("building:part", "yes"), yes = tag("building", "yes");
    const auto windows = static_cast<size_t>(Finish::windows);
    for (const std::string& outline :
         {yes + tag("man_made", "tower") + tag("tower:type", "communication"),
          yes + tag("man_made", "communications_tower"), yes + tag("man_made", "mast"),
          yes + tag("man_made", "tower") + tag("tower:construction", "lattice"),
          yes + tag("tower:type", "observation"), tag("man_made", "tower")})
        EXPECT_EQ(finishes(outline, part)[windows], 0) << outline;
    EXPECT_GT(finishes(tag("building", "tower"), part)[windows], 0) << "a house of flats";
    for (int count : {finishes(tag("building", "tower") + tag("building:levels", "20"), part)[windows],
                      finishes(yes, part)[windows]})
        EXPECT_GE(count, 4);
}

}  // namespace
}  // namespace flaneur
