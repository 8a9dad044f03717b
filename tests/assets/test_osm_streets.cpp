// Streets, steps, bridges, walls and places of mapped cities.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

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

namespace fs = std::filesystem;

// The streets of a drawing on a terrain, which is about (0, 0) if the drawing is. A frame keeps it so.
City build(Drawing drawing, const std::function<float(Vec2)>& terrain = {}) {
    Result<OsmMap> map = parse_osm(osm_of(drawing), "osm");
    EXPECT_TRUE(map) << map.error().message;
    OsmImport in{*map, projection_about(0, 0), {}, {}, {}};
    in.plan.low = {-60, -60};
    in.plan.high = {60, 60};
    in.plan.cell = 16;
    in.plan.terrain = terrain;
    add_osm_outdoors(in);
    return std::move(in.city);
}

float height(const City& city, Vec2 p, float about) {
    std::optional<GroundHit> hit = ground_at(city.ground, at_height(p, about), 1, 1);
    EXPECT_TRUE(hit) << p.x << ", " << p.z << " about " << about;
    return hit ? hit->height : -99;
}

// How far from `to` the way from `from` ends.
float path_ends_short(const Navmesh& mesh, Vec3 from, Vec3 to) {
    std::optional<NavPoint> a = nearest(mesh, 0, from, {1, 0.6f, 1}), b = nearest(mesh, 0, to, {1, 0.6f, 1});
    EXPECT_TRUE(a && b);
    if (!a || !b) return 99;
    Vec3 corners[256];
    int count = find_path(mesh, 0, *a, *b, corners, 256);
    return count > 0 ? length(corners[count - 1] - b->position) : 99;
}

NavmeshPtr mesh_of(const City& city) {
    Result<NavmeshPtr> mesh = build_navmesh(city.ground, {}, 1);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return mesh ? std::move(*mesh) : nullptr;
}

// The tracks of a drawing of 400 by 400 metres, and all its lanes.
Lanes lanes_of(Drawing drawing) {
    Result<OsmMap> map = parse_osm(osm_of(drawing), "osm");
    EXPECT_TRUE(map) << map.error().message;
    OsmImport in{*map, projection_about(0, 0), {}, {}, {}};
    in.plan.low = {-200, -200};
    in.plan.high = {200, 200};
    add_osm_lanes(in);
    return std::move(in.city.lanes);
}

TEST(OsmStreets, TramsHaveLanesOnTheirTracks) {
    // Two tracks side by side, in pieces that were drawn this way and that, are driven on the right; what is
    // said is believed; and where a street crosses them both have a junction.
    for (const bool says : {false, true}) {
        Drawing d;
        d.way(std::vector<Vec2>{{-260, 0}, {-90, 0}, {260, 0}},
              tag("highway", "secondary") + tag("width", "11"));
        const std::string track = tag("railway", "tram"), one_way = says ? tag("oneway", "yes") : "";
        const int joint = d.node(20, 61.6f);
        d.way({d.node(-260, 61.6f), joint}, track + one_way);
        d.way({joint, d.node(260, 61.6f)}, track + one_way);
        d.way(std::vector<Vec2>{{260, 58.4f}, {90, 58.4f}, {-260, 58.4f}}, track + one_way);
        d.way(std::vector<Vec2>{{40, -260}, {40, -90}, {40, 260}},
              tag("highway", "residential") + tag("width", "8"));
        d.way(std::vector<Vec2>{{-260, -80}, {-90, -80}, {260, -80}}, track + tag("tunnel", "yes"));
        d.node(-50, 61.6f, tag("railway", "tram_stop"));
        const Lanes lanes = lanes_of(d);
        uint32_t tracks = 0, stops = 0, junctions = 0;
        for (uint32_t i = 0; i < lanes.all.size(); ++i) {
            const Lane& lane = lanes.all[i];
            if (!lane.is_track) continue;
            const OnLane middle = on_lane(lanes, i, lane.length / 2);
            EXPECT_NEAR(std::fabs(middle.at.z - 60), 1.6f, 0.05f);
            EXPECT_EQ(middle.along.x > 0, middle.at.z > 60);
            tracks += !is_curve(lane), junctions += is_curve(lane), stops += lane.stop_count;
            EXPECT_EQ(lane.conflict_count, is_curve(lane) ? 2u : 0u);
        }
        EXPECT_EQ(tracks, 4u);
        EXPECT_EQ(junctions, 2u);
        EXPECT_EQ(stops, 1u);
    }
}

TEST(OsmStreets, RisersAreWalkable) {
    EXPECT_EQ(riser_count(0.05f, 0), 0);
    EXPECT_EQ(riser_count(3.2f, 0), 20);
    EXPECT_EQ(riser_count(-3.2f, 0), 20);
    EXPECT_EQ(riser_count(3.2f, 18), 18);
    EXPECT_EQ(riser_count(3.2f, 5), 13) << "none is higher than a quarter of a metre";
    EXPECT_EQ(riser_count(1, 400), 10) << "none is lower than a decimetre";
}

TEST(OsmStreets, StepsClimbTheHill) {
    // A slope of 3 in 10 to the north, with a stair straight up it between two footways.
    Drawing d;
    int a = d.node(0, 40), b = d.node(0, 12), c = d.node(0, -12), e = d.node(0, -40);
    d.way({a, b}, tag("highway", "footway"));
    d.way({b, c}, tag("highway", "steps") + tag("width", "3"));
    d.way({c, e}, tag("highway", "footway"));
    City city = build(d, [](Vec2 p) { return 12 - 0.3f * p.z; });
    // Up along the middle: levels, and between them risers of one size.
    int risers = 0;
    float before = height(city, {0, 11.98f}, 8.5f), lowest = before;
    for (float z = 11.98f; z > -11.98f; z -= 0.02f) {
        float now = height(city, {0.4f, z}, before);
        if (std::fabs(now - before) > 1e-4f) {
            ++risers;
            EXPECT_GT(now - before, 0.12f) << z;
            EXPECT_LT(now - before, 0.2f) << z;
        }
        before = now;
    }
    EXPECT_NEAR(before - lowest, 24 * 0.3f, 0.02f);
    EXPECT_NEAR(static_cast<float>(risers), 7.2f / 0.16f, 3);
    EXPECT_NEAR(lowest, 12 - 0.3f * 12 + 0.12f, 0.02f);
    int drawn = 0;
    for (const Face& f : city.ground.faces) {
        Vec2 middle = lerp(on_ground(f.a), on_ground(f.b), 0.5f);
        bool across =
            std::fabs(f.b.z - f.a.z) < 0.01f && std::fabs(middle.x) < 1.6f && std::fabs(middle.z) < 11.9f;
        drawn += f.kind == FaceKind::riser && across && length(on_ground(f.b) - on_ground(f.a)) > 0.2f;
    }
    EXPECT_GE(drawn, risers);
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (city.ground.kinds[t] == Surface::steps) {
            EXPECT_LT(city.ground_axes[t].z, -0.99f) << "the way up is north";
        }
    }
    NavmeshPtr mesh = mesh_of(city);
    ASSERT_TRUE(mesh);
    Vec3 foot{0, 12 - 6 + 0.12f, 20}, top{0, 12 + 6 + 0.12f, -20};
    EXPECT_LT(path_ends_short(*mesh, foot, top), 0.1f);
    EXPECT_LT(path_ends_short(*mesh, top, foot), 0.1f);
}

TEST(OsmStreets, StepsOnLevelGroundStayLevel) {
    Drawing d;
    d.way({{0, 20}, {0, -20}}, tag("highway", "steps") + tag("step_count", "12"));
    City city = build(d);
    for (float z = -19; z < 19; z += 0.37f) EXPECT_FLOAT_EQ(height(city, {0, z}, 0), k_kerb);
}

TEST(OsmStreets, BridgeIsWalkedOverAndUnder) {
    // A walkway over a street, with steps up to it on either side.
    Drawing d;
    d.way({{0, 50}, {0, -50}}, tag("highway", "residential") + tag("width", "7"));
    int a = d.node(-40, 0), b = d.node(-28, 0), c = d.node(-16, 0), e = d.node(16, 0), f = d.node(28, 0),
        g = d.node(40, 0);
    d.way({a, b}, tag("highway", "footway"));
    d.way({b, c}, tag("highway", "steps"));
    d.way({c, e}, tag("highway", "footway") + tag("bridge", "yes") + tag("layer", "1") + tag("width", "3"));
    d.way({e, f}, tag("highway", "steps"));
    d.way({f, g}, tag("highway", "footway"));
    City city = build(d);
    float deck = height(city, {0, 0}, k_level_height);
    EXPECT_NEAR(deck, k_level_height + k_kerb, 0.02f);
    EXPECT_FLOAT_EQ(height(city, {0, 0}, 0), 0) << "the street goes on below";
    NavmeshPtr mesh = mesh_of(city);
    ASSERT_TRUE(mesh);
    EXPECT_LT(path_ends_short(*mesh, {-36, k_kerb, 0}, {0, deck, 0}), 0.1f);
    EXPECT_LT(path_ends_short(*mesh, {36, k_kerb, 0}, {0, deck, 0}), 0.1f);
    EXPECT_LT(path_ends_short(*mesh, {5, k_kerb, 20}, {5, k_kerb, -20}), 0.1f);
    // Railings on both sides of the deck stop walkers; nothing stops them along it.
    for (float x = -14; x < 14; x += 1.7f) {
        for (float side : {-1.0f, 1.0f}) {
            std::optional<RayHit> rail = raycast(city.ground, {x, deck + 0.6f, 0}, {0, 0, side}, 3);
            ASSERT_TRUE(rail) << x;
            EXPECT_NEAR(rail->distance, 1.5f, 0.3f);
        }
    }
    EXPECT_FALSE(raycast(city.ground, {-14, deck + 0.6f, 0}, {1, 0, 0}, 28));
    // Steps go up without a gap.
    float before = k_kerb;
    for (float x = -30; x < -14; x += 0.05f) {
        std::optional<GroundHit> hit = ground_at(city.ground, {x, before, 0.3f}, 0.3f, 0.3f);
        ASSERT_TRUE(hit) << x;
        before = hit->height;
    }
    EXPECT_NEAR(before, deck, 0.02f);
}

// A walkway over a street, with steps up to it in the west; in the east it ends at `x`.
Drawing half_a_bridge(float x) {
    Drawing d;
    d.way({{0, 50}, {0, -50}}, tag("highway", "residential") + tag("width", "7"));
    int a = d.node(-40, 0), b = d.node(-28, 0), c = d.node(-16, 0), e = d.node(x, 0);
    d.way({a, b}, tag("highway", "footway"));
    d.way({b, c}, tag("highway", "steps"));
    d.way({c, e}, tag("highway", "footway") + tag("bridge", "yes") + tag("layer", "1") + tag("width", "3"));
    return d;
}

// Whether a wall that a walker on the deck cannot pass closes its end, looking along `out`.
bool is_closed(const City& city, Vec2 end, Vec2 out, float deck) {
    Vec2 side{-out.z, out.x};
    for (float off : {-1.3f, -0.7f, 0.0f, 0.7f, 1.3f}) {
        Vec3 eye = at_height(end - out + side * off, deck + 0.9f);
        std::optional<RayHit> hit = raycast(city.ground, eye, {out.x, 0, out.z}, 3);
        if (!hit || hit->distance > 1.3f) return false;
    }
    return true;
}

TEST(OsmStreets, BridgesThatEndInTheAirComeDownBySteps) {
    City city = build(half_a_bridge(12));
    float deck = height(city, {0, 0}, k_level_height), before = deck;
    EXPECT_NEAR(deck, k_level_height + k_kerb, 0.02f);
    EXPECT_FLOAT_EQ(height(city, {0, 0}, 0), 0) << "the street goes on below";
    for (float x = 0; x < 30; x += 0.05f) {
        std::optional<GroundHit> hit = ground_at(city.ground, {x, before, 0.3f}, 0.3f, 0.3f);
        ASSERT_TRUE(hit) << x;
        before = hit->height;
    }
    EXPECT_NEAR(before, k_kerb, 1e-3f);
    NavmeshPtr mesh = mesh_of(city);
    ASSERT_TRUE(mesh);
    EXPECT_LT(path_ends_short(*mesh, {30, k_kerb, 0}, {0, deck, 0}), 0.1f);
    EXPECT_LT(path_ends_short(*mesh, {-36, k_kerb, 0}, {30, k_kerb, 0}), 0.1f);
    EXPECT_LT(path_ends_short(*mesh, {13, k_kerb, 20}, {13, k_kerb, -20}), 0.1f) << "under the end";

    for (float x = 12; x < 24; x += 0.1f) {
        if (ground_at(city.ground, {x, k_kerb, 0}, 0.5f, 0.5f)) continue;
        for (float side : {-1.0f, 1.0f})
            EXPECT_TRUE(raycast(city.ground, {x, 0.4f, side * 4}, {0, 0, -side}, 4))
                << x << ": a hole in the ground";
    }

    // A house stands ahead: they turn away from it.
    Drawing blocked = half_a_bridge(12);
    blocked.area({17, -20}, {30, 20}, tag("building", "yes"));
    city = build(blocked);
    mesh = mesh_of(city);
    ASSERT_TRUE(mesh);
    EXPECT_FALSE(is_closed(city, {12, 0}, {1, 0}, deck) && is_closed(city, {12, 0}, {0, 1}, deck) &&
                 is_closed(city, {12, 0}, {0, -1}, deck));
    EXPECT_LT(path_ends_short(*mesh, {8, k_kerb, 40}, {0, deck, 0}), 0.1f);
}

TEST(OsmStreets, BridgesThatAreLongEnoughComeDownThemselves) {
    // They rise from the ground; at the border of the map they go on beyond.
    for (std::string kind : {"residential", "footway"}) {
        for (float x : {45.0f, 58.0f}) {
            Drawing d;
            d.way({{-15, 50}, {-15, -50}}, tag("highway", "residential") + tag("width", "7"));
            int a = d.node(-58, 0), b = d.node(-50, 0), c = d.node(x, 0);
            d.way({a, b}, tag("highway", kind));
            d.way({b, c}, tag("highway", kind) + tag("bridge", "yes"));
            City city = build(d);
            EXPECT_TRUE(ground_at(city.ground, {-15, 3.5f, 0}, 2, 2)) << "over the street";
            EXPECT_EQ(ground_at(city.ground, {x - 1, 3, 0}, 2.5f, 2.5f).has_value(), x > 50) << kind;
            NavmeshPtr mesh = mesh_of(city);
            ASSERT_TRUE(mesh);
            if (x < 50) {
                EXPECT_LT(path_ends_short(*mesh, {-54, 0, 0}, {x + 2, k_kerb, 0}), 0.1f) << kind;
            }
            for (Surface s : city.ground.kinds) ASSERT_NE(s, Surface::steps);
        }
    }
}

TEST(OsmStreets, BridgesWithoutRoomForStepsAreClosedAndStandOnPiers) {
    // In a lake, where there is no ground to come down to, and at the border of the map.
    Drawing lake = half_a_bridge(16);
    std::vector<int> shore{lake.node(10, -50), lake.node(50, -50), lake.node(50, 50), lake.node(10, 50)};
    shore.push_back(shore[0]);
    lake.way(shore, tag("natural", "water"));
    for (bool in_lake : {true, false}) {
        float x = in_lake ? 16.0f : 55.0f;
        Drawing d = in_lake ? lake : half_a_bridge(x);
        // What it leads over is near the border, too.
        d.way({{42, 50}, {42, -50}}, tag("highway", "footway"));
        City city = build(d);
        float deck = height(city, {x - 0.5f, 0}, k_level_height);
        EXPECT_NEAR(deck, k_level_height + k_kerb, 0.02f);
        EXPECT_TRUE(is_closed(city, {x, 0}, {1, 0}, deck));
        EXPECT_FALSE(ground_at(city.ground, {x + 0.5f, deck, 0}, 3, 1)) << "it ends square";
        EXPECT_TRUE(raycast(city.ground, {x + 2, 1.5f, 0}, {-1, 0, 0}, 4)) << "a pier";
        EXPECT_FALSE(raycast(city.ground, {x + 2, 1.5f, 1.9f}, {-1, 0, 0}, 4)) << "beside the pier";
    }
}

TEST(OsmStreets, BridgeOverWaterStaysOnTheGround) {
    Drawing d;
    std::vector<int> shore{d.node(-8, -50), d.node(8, -50), d.node(8, 50), d.node(-8, 50)};
    shore.push_back(shore[0]);
    d.way(shore, tag("natural", "water"));
    int a = d.node(-40, 0), b = d.node(-10, 0), c = d.node(10, 0), e = d.node(40, 0);
    d.way({a, b}, tag("highway", "footway"));
    d.way({b, c}, tag("highway", "footway") + tag("bridge", "yes") + tag("width", "4"));
    d.way({c, e}, tag("highway", "footway"));
    City city = build(d);
    for (float x = -38; x < 38; x += 0.21f) EXPECT_NEAR(height(city, {x, 0}, 0), k_kerb, 1e-3f) << x;
    EXPECT_LT(height(city, {0, 6}, 0), 0) << "water beside it";
    NavmeshPtr mesh = mesh_of(city);
    ASSERT_TRUE(mesh);
    EXPECT_LT(path_ends_short(*mesh, {-30, k_kerb, 0}, {30, k_kerb, 0}), 0.1f);
    EXPECT_TRUE(raycast(city.ground, {0, 0.6f, 0}, {0, 0, 1}, 3)) << "a railing";
}

TEST(OsmStreets, DoubledSidewalkIsLaidOnce) {
    // One side is tagged on the road and drawn as a way of its own, 6 m from the centre.
    auto pavement = [](const std::string& sidewalk, bool drawn) {
        Drawing d;
        d.way({{-50, 0}, {50, 0}}, tag("highway", "residential") + tag("width", "8") + sidewalk);
        if (drawn)
            d.way({{-50, -6}, {50, -6}},
                  tag("highway", "footway") + tag("footway", "sidewalk") + tag("width", "2.2"));
        City city = build(d);
        double width = 0;
        int levels = 0;
        for (float z = -20; z < 0; z += 0.05f) {
            std::optional<GroundHit> hit = ground_at(city.ground, {3, 0, z}, 1, 1);
            width += hit && hit->kind == Surface::sidewalk ? 0.05 : 0;
            levels = std::max(levels, triangles_at(city, {3.01f, z}));
        }
        EXPECT_EQ(levels, 1);
        return width;
    };
    // To the way's outer edge, and the paved strip beyond.
    double separate = pavement(tag("sidewalk", "separate"), true);
    EXPECT_NEAR(separate, 3.1 + 5, 0.2);
    EXPECT_NEAR(pavement(tag("sidewalk", "both"), true), separate, 0.01);
    EXPECT_NEAR(pavement("", true), separate, 0.01);
    EXPECT_NEAR(pavement(tag("sidewalk", "both"), false), 3 + 5, 0.2);
}

TEST(OsmStreets, WallsLeaveGapsForWays) {
    Drawing d;
    d.way({{-40, 10}, {40, 10}}, tag("barrier", "wall") + tag("height", "2"));
    d.way({{0, -30}, {0, 40}}, tag("highway", "footway"));
    d.node(20, 10, tag("barrier", "gate"));
    City city = build(d);
    auto blocked = [&](float x) { return raycast(city.ground, {x, 1, 0}, {0, 0, 1}, 20).has_value(); };
    EXPECT_TRUE(blocked(-30));
    EXPECT_TRUE(blocked(10));
    EXPECT_TRUE(blocked(30));
    EXPECT_FALSE(blocked(0)) << "a footway passes";
    EXPECT_FALSE(blocked(0.9f));
    EXPECT_FALSE(blocked(20)) << "a gate";
    NavmeshPtr mesh = mesh_of(city);
    ASSERT_TRUE(mesh);
    EXPECT_LT(path_ends_short(*mesh, {0, k_kerb, -20}, {0, k_kerb, 30}), 0.1f);
}

TEST(OsmStreets, PlacesLieOnTheGround) {
    fs::path corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "osm";
    if (!fs::exists(corpus)) GTEST_SKIP() << "There is no " << corpus << ": tests on real maps are left out.";
    Result<City> city = load_osm((corpus / "berlin_neukolln_2024.osm").string());
    ASSERT_TRUE(city);
    int counts[k_destination_count] = {};
    for (const Destination& place : city->destinations) {
        ++counts[static_cast<size_t>(place.kind)];
        std::optional<GroundHit> hit = ground_at(city->ground, place.position, 0.05f, 0.05f);
        ASSERT_TRUE(hit);
        EXPECT_NE(hit->kind, Surface::water);
        EXPECT_NE(hit->kind, Surface::road);
        EXPECT_NEAR(length(place.facing), 1, 1e-3f);
        EXPECT_GT(place.weight, 0);
    }
    for (DestinationKind kind :
         {DestinationKind::door, DestinationKind::shop, DestinationKind::bench, DestinationKind::edge})
        EXPECT_GT(counts[static_cast<size_t>(kind)], 3) << static_cast<int>(kind);
}

TEST(OsmStreets, ArmsOfAJunctionAreCrossedWithoutStripes) {
    Drawing drawing;
    int middle = drawing.node(0, 0);
    drawing.way({drawing.node(-55, 0), middle, drawing.node(55, 0)}, tag("highway", "residential"));
    drawing.way({middle, drawing.node(0, 55)}, tag("highway", "residential"));
    City city = build(drawing);
    int arms = 0;
    for (Vec2 way : {Vec2{1, 0}, Vec2{-1, 0}, Vec2{0, 1}}) {
        bool crossed = false;
        for (float off = 5; off < 15; off += 0.5f) {
            std::optional<GroundHit> hit = ground_at(city.ground, at_height(way * off, 0), 1, 1);
            crossed |= hit && hit->kind == Surface::crossing;
        }
        arms += crossed;
    }
    EXPECT_EQ(arms, 3);
    for (size_t t = 0; t < city.ground.kinds.size(); ++t) {
        if (city.ground.kinds[t] == Surface::crossing) {
            EXPECT_EQ(length(city.ground_axes[t]), 0);
        }
    }
}

}  // namespace
}  // namespace flaneur
