// People and ways in a city that is changed while they walk.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/additions.h"
#include "assets/cities.h"
#include "assets/scene.h"
#include "sim/world.h"
#include "tools/flaneur/window/change/design.h"
#include "tools/flaneur/window/change/hand.h"
#include "tools/flaneur/window/change/people.h"

namespace flaneur {
namespace {

std::shared_ptr<const City> bare() {
    static const auto city = std::make_shared<const City>(generate_district({3, 1}));
    return city;
}

NavmeshPtr whole_mesh(const Ground& ground) {
    auto mesh = build_navmesh(ground, {}, 1);
    EXPECT_TRUE(mesh);
    return std::move(mesh).value();
}

std::shared_ptr<const City> with(const std::vector<Addition>& added) {
    City city = *bare();
    const Result<void> done = add_to_city(city, added);
    EXPECT_TRUE(done) << (done ? "" : done.error().message);
    return std::make_shared<const City>(std::move(city));
}

NavmeshPtr changed_mesh(const Navmesh& before, const City& city, const std::vector<Rectangle>& changed) {
    const Ground& ground = bare()->ground;
    auto mesh = rebuild_navmesh(city.ground, {}, navmesh_bytes(before), ground.low, ground.high, changed, 1);
    EXPECT_TRUE(mesh);
    return std::move(mesh).value();
}

std::unique_ptr<World> people(uint32_t count, int threads) {
    WorldOptions options;
    options.walkers = count;
    options.threads = threads;
    options.destinations = bare()->destinations;
    auto world = make_world({bare(), &bare()->ground}, whole_mesh(bare()->ground), options);
    EXPECT_TRUE(world) << (world ? "" : world.error().message);
    return std::move(world).value();
}

void change_to(World& world, const std::vector<Addition>& before, const std::vector<Addition>& added) {
    const auto city = with(added);
    const auto areas = changed_areas(before, added);
    change_ground(world, {city, &city->ground}, changed_mesh(*world.navmesh, *city, areas),
                  city->destinations, areas);
}

// Metres of ground from somebody to the polygon that it stands on.
float beside_mesh(const World& world, uint32_t walker) {
    const CrowdMotion& m = world.crowd.motion;
    const NavPoint at{m.position[walker], m.polygon[walker]};
    return length(on_ground(move_along(*world.navmesh, 0, at, at.position).position - at.position));
}

// Planters, and walls and barriers between some of those who walk there now.
std::vector<Addition> things_among(const World& world) {
    std::vector<Addition> added;
    for (uint32_t i = 0; i < world.crowd.count; i += 25) {
        const Vec3 at = world.crowd.motion.position[i];
        Addition a{static_cast<AddedKind>(added.size() % 5), at, {}, 30};
        if (added.size() % 3 == 1)
            a = {AddedKind::wall, at + Vec3{-1.5f, 0, 0.1f}, at + Vec3{1.5f, 0, 0.1f}, 0};
        if (added.size() % 3 == 2) a = {AddedKind::barrier, at + Vec3{0, 0, -2}, at + Vec3{0, 0, 2}, 0};
        City city = *bare();
        if (add_to_city(city, {&a, 1})) added.push_back(a);
    }
    return added;
}

TEST(ChangedCity, MeshIsThatOfTheWholeCityBuiltAnew) {
    const auto world = people(500, 1);
    const std::vector<Addition> added = things_among(*world);
    ASSERT_GE(added.size(), 15u);
    const auto city = with(added);
    const NavmeshPtr before = whole_mesh(bare()->ground), anew = whole_mesh(city->ground);
    const NavmeshPtr changed = changed_mesh(*before, *city, changed_areas({}, added));
    EXPECT_NE(hash_navmesh(*before), hash_navmesh(*anew));
    EXPECT_EQ(hash_navmesh(*changed), hash_navmesh(*anew));
    EXPECT_EQ(navmesh_triangles(*changed), navmesh_triangles(*anew));
    const NavmeshPtr back = changed_mesh(*changed, *bare(), changed_areas(added, {}));
    EXPECT_EQ(hash_navmesh(*back), hash_navmesh(*before)) << "undone";
}

TEST(ChangedCity, NobodyIsLeftBesideTheMeshNorMovedAllAtOnce) {
    const auto world = people(500, 2);
    for (int tick = 0; tick < 120; ++tick) step(*world);
    const std::vector<Addition> added = things_among(*world);
    ASSERT_GE(added.size(), 15u);
    auto beside = [&] {
        uint32_t count = 0;
        for (const NavPoint& place : world->crowd.way_back) count += place.polygon != 0;
        return count;
    };
    auto walk = [&](int ticks) {
        for (int tick = 0; tick < ticks; ++tick) {
            const std::vector<Vec3> before = world->crowd.motion.position;
            step(*world);
            for (uint32_t i = 0; i < world->crowd.count; ++i) {
                const float moved = length(on_ground(world->crowd.motion.position[i] - before[i]));
                ASSERT_LT(moved, 0.06f) << "walker " << i << " in tick " << tick;
            }
        }
    };
    change_to(*world, {}, added);
    EXPECT_GT(beside(), 5u) << "things stand where people are";
    walk(300);
    EXPECT_EQ(beside(), 0u);
    for (uint32_t i = 0; i < world->crowd.count; ++i) {
        EXPECT_LT(beside_mesh(*world, i), 0.02f) << i;
        EXPECT_NE(island(*world->navmesh, world->crowd.motion.polygon[i]), ~0u) << i;
    }
    change_to(*world, added, {});
    walk(120);
    EXPECT_EQ(beside(), 0u);
}

TEST(ChangedCity, IsTheSameOnEveryNumberOfThreads) {
    uint64_t hashes[2];
    for (int run = 0; run < 2; ++run) {
        const auto world = people(200, run == 0 ? 1 : 4);
        for (int tick = 0; tick < 60; ++tick) step(*world);
        const std::vector<Addition> added = things_among(*world);
        change_to(*world, {}, added);
        set_hour(*world, 21);
        make_room(*world, 260);
        const auto home = find_neighbourhood(*world->ground, *world->navmesh, 230);
        ASSERT_TRUE(approach(*world, 230, 100, home, {}, {}));
        for (int tick = 0; tick < 60; ++tick) step(*world);
        change_to(*world, added, {});
        for (int tick = 0; tick < 60; ++tick) step(*world);
        hashes[run] = hash_world(*world);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(ChangedCity, PeopleGoAnotherWayWhereAStreetIsClosed) {
    const auto world = people(0, 1);
    make_room(*world, 1);
    // A destination and somebody who goes there, with a barrier in the middle of the way.
    const auto doors = std::span(bare()->destinations);
    std::optional<NavPoint> from, to;
    Vec3 corners[k_corners];
    int count = 0;
    for (size_t i = 1; i < doors.size() && count < 3; ++i) {
        from = nearest(*world->navmesh, 0, doors[0].position);
        to = nearest(*world->navmesh, 0, doors[i].position);
        if (from && to && length(from->position - to->position) > 40)
            count = find_path(*world->navmesh, 0, *from, *to, corners, k_corners);
    }
    ASSERT_GE(count, 3);
    const auto id = add_walker(*world, {.place = from->position});
    ASSERT_TRUE(id);
    ASSERT_TRUE(send_to(*world, *id, to->position));
    for (int tick = 0; tick < 10; ++tick) step(*world);
    const Vec3 middle = lerp(corners[0], corners[1], 0.5f);
    auto row = closure_at(bare()->ground, middle);
    if (!row) {
        const Vec2 way = normalize_or(on_ground(corners[1] - corners[0]), {1, 0});
        const Vec3 side = at_height(Vec2{-way.z, way.x} * 2, 0);
        row = Addition{AddedKind::barrier, middle - side, middle + side, 0};
    }
    auto path = [&] {
        const Journey& j = world->crowd.journeys[id->index];
        return std::vector<Vec3>(&world->crowd.corners[size_t{id->index} * k_corners],
                                 &world->crowd.corners[size_t{id->index} * k_corners + j.corner_count]);
    };
    const std::vector<Vec3> before = path();
    change_to(*world, {}, {*row});
    EXPECT_EQ(world->crowd.journeys[id->index].path_due, PathDue::to_goal);
    for (int tick = 0; tick < 4; ++tick) step(*world);
    EXPECT_NE(path(), before);
    const auto place = nearest(*world->navmesh, 0, lerp(row->at, row->to, 0.5f), {0.2f, 1, 0.2f});
    EXPECT_FALSE(place) << "nobody walks through the row";
}

// A floor between two walls.
Ground between_walls(Surface floor, float apart) {
    Ground ground;
    ground.vertices = {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}};
    ground.indices = {0, 1, 2, 0, 2, 3};
    ground.kinds = {floor, floor};
    for (const float x : {-apart / 2, apart / 2})
        ground.faces.push_back({{x, 0, -50}, {x, 0, 50}, 5, 5, FaceKind::facade, ~0u});
    index_ground(ground);
    return ground;
}

// Those who stay are spread as all were.
TEST(ChangedCity, PeopleLeaveFromAllOverTheCity) {
    const auto world = people(400, 1);
    const auto home = find_neighbourhood(*world->ground, *world->navmesh, 100);
    const Vec3 at = world->crowd.motion.position[0];
    const Camera camera{.eye = {at.x, at.y + 40, at.z}, .target = {at.x + 1, at.y, at.z}};
    auto near = [&] {
        size_t count = 0;
        for (const WalkerId id : walkers(*world))
            count += length(world->crowd.motion.position[id.index] - at) < 120;
        return static_cast<double>(count) / static_cast<double>(walkers(*world).size());
    };
    const double before = near();
    ASSERT_TRUE(approach(*world, 100, 1000, home, camera, {}));
    EXPECT_EQ(walkers(*world).size(), 100u);
    EXPECT_NEAR(near(), before, 0.15) << before;
}

TEST(ChangedCity, AClickClosesAStreetButNoSquare) {
    for (const Surface floor : {Surface::road, Surface::plaza})
        for (const float apart : {12.0f, 40.0f}) {
            const auto row = closure_at(between_walls(floor, apart), {1, 0, 0});
            ASSERT_EQ(row.has_value(), floor == Surface::road || apart < 20);
            if (!row) continue;
            EXPECT_NEAR(length(on_ground(row->to - row->at)), apart, 0.5f);
        }
}

TEST(ChangedCity, HasAsManyPeopleAsAreWanted) {
    const auto world = people(100, 1);
    const auto home = find_neighbourhood(*world->ground, *world->navmesh, 300);
    const Camera camera{.eye = {0, 1.6f, 0}, .target = {0, 1.6f, 1}};
    Result<bool> done = false;
    for (int i = 0; done && !*done; ++i) {
        const size_t before = walkers(*world).size();
        done = approach(*world, 300, 70, home, camera, {});
        EXPECT_LE(walkers(*world).size(), before + 70);
        ASSERT_LT(i, 10);
    }
    ASSERT_TRUE(done) << (done ? "" : done.error().message);
    EXPECT_EQ(walkers(*world).size(), 300u);
    for (int tick = 0; tick < 120; ++tick) step(*world);
    EXPECT_LT(deepest_overlap(world->crowd), k_most_overlap + 1e-3f);
    while (!*(done = approach(*world, 1, 70, home, camera, 42u))) ASSERT_TRUE(done);
    ASSERT_EQ(walkers(*world).size(), 1u);
    EXPECT_EQ(walkers(*world)[0].index, 42u) << "who is kept goes last";
    ASSERT_TRUE(*approach(*world, 0, 70, home, camera, 42u));
    EXPECT_TRUE(walkers(*world).empty());
    step(*world);
}

TEST(ChangedCity, SomebodyGoesAsTheHandSays) {
    const auto world = people(60, 1), same = people(60, 1);
    for (int tick = 0; tick < 30; ++tick) step(*world), step(*same);
    EXPECT_EQ(hash_world(*world), hash_world(*same));
    drive(world->crowd, 7);
    world->crowd.driven.wish = {0, 0};
    for (int tick = 0; tick < 120; ++tick) step(*world);
    EXPECT_LT(length(world->crowd.motion.velocity[7]), 0.2f) << "stands";
    float fastest = 0;
    for (float yaw : {0.0f, 1.6f, 3.1f, -1.6f}) {
        world->crowd.driven.wish = Vec2{std::sin(yaw), std::cos(yaw)} * 3;
        for (int tick = 0; tick < 120; ++tick) {
            step(*world);
            fastest = std::max(fastest, length(world->crowd.motion.velocity[7]));
        }
    }
    EXPECT_GT(fastest, 2.2f) << "runs";
    EXPECT_LT(beside_mesh(*world, 7), 0.02f);
    let_go(world->crowd);
    for (int tick = 0; tick < 600; ++tick) step(*world);
    EXPECT_LT(length(world->crowd.motion.velocity[7]), 2);
    EXPECT_EQ(world->crowd.journeys[7].path_due == PathDue::to_goal, false) << "has found its way";
}

TEST(Design, IsUndoneAndDoneAgain) {
    Designs d{{{.hour = 8, .people = 10}}, 0, 0};
    const Design first = current(d);
    Design next = first;
    for (int minute = 1; minute <= 5; ++minute)
        next.hour = 8 + static_cast<float>(minute) / 60, change(d, next, 3);
    change(d, next, 3);
    EXPECT_EQ(d.all.size(), 2u) << "one drag is one step";
    next.added.push_back({AddedKind::bench, {1, 0, 2}, {}, 90});
    change(d, next, 4);
    EXPECT_TRUE(undo(d));
    EXPECT_TRUE(current(d).added.empty());
    EXPECT_TRUE(undo(d));
    EXPECT_EQ(current(d), first);
    EXPECT_FALSE(undo(d));
    EXPECT_TRUE(redo(d));
    EXPECT_TRUE(redo(d));
    EXPECT_EQ(current(d), next);
    EXPECT_FALSE(redo(d));
    EXPECT_TRUE(undo(d));
    Design other = current(d);
    other.people = 3;
    change(d, other);
    EXPECT_FALSE(redo(d)) << "what was undone is forgotten";
    give_up(d);
    EXPECT_EQ(current(d).people, 10u);
}

TEST(Design, ChangesWhereThingsComeAndGo) {
    const Addition bench{AddedKind::bench, {10, 0, 10}, {}, 0}, tree{AddedKind::tree, {90, 0, 90}, {}, 0};
    EXPECT_TRUE(changed_areas({bench, tree}, {tree, bench}).empty());
    const auto areas = changed_areas({bench, tree}, {tree});
    ASSERT_EQ(areas.size(), 1u);
    EXPECT_LT(areas[0].low.x, 10);
    EXPECT_GT(areas[0].high.x, 10);
    EXPECT_EQ(changed_areas({bench, bench}, {bench}).size(), 1u);
}

TEST(ChangedCity, IsTheSameWhenItsSceneIsOpened) {
    const auto world = people(60, 1);
    Scene scene;
    scene.name = "it";
    scene.added = things_among(*world);
    for (const Destination& d : bare()->destinations)
        if (d.kind == DestinationKind::door && entrance_at(bare()->ground, d.position)) {
            scene.added.push_back({AddedKind::entrance, d.position, {}, 0});
            break;
        }
    scene.hour = 21.25f;
    scene.is_overcast = true;
    scene.walkers = 321;
    scene.seed = 12345678901234567890u;
    scene.camera = {CameraChoice::Kind::fixed, 0, {0.1f, 1.7f, -3}, {4, 5.25f, 6}};
    scene.people = {{"a/b \"c\".glb", 0.25f}, {"", 3}};
    scene.idles = {"me.glb:Idle"};
    scene.blocks = 2;
    const auto opened = parse_scene(scene_text(scene), "it");
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_EQ(*opened, scene);
    EXPECT_EQ(hash_city(*with(opened->added)), hash_city(*with(scene.added)));
    EXPECT_NE(hash_city(*with(opened->added)), hash_city(*bare()));
    Scene plain;
    plain.name = "it";
    EXPECT_EQ(*parse_scene(scene_text(plain), "it"), plain);
}

TEST(ChangedCity, RefusesWhatHasNoPlace) {
    auto refusal = [](const Addition& a) {
        City city = *bare();
        const Result<void> done = add_to_city(city, {&a, 1});
        return done ? std::string() : done.error().message;
    };
    EXPECT_NE(refusal({AddedKind::bench, {9000, 0, 0}, {}, 0}).find("beyond the city"), std::string::npos);
    EXPECT_NE(refusal({AddedKind::bench, {0, 500, 0}, {}, 0}).find("no ground"), std::string::npos);
    for (const char* text :
         {R"({"added": [{"what": "wall", "at": "0,0,0"}]})",
          R"({"added": [{"what": "bench", "at": "0,0,0", "to": "1,0,0"}]})",
          R"({"added": [{"what": "wall", "at": "0,0,0", "to": "0,0,0.2"}]})",
          R"({"added": [{"what": "sofa", "at": "0,0,0"}]})", R"({"added": [{"what": "bench"}]})",
          R"({"added": [{"what": "entrance", "at": "0,0,0", "turn": 3}]})"}) {
        const auto scene = parse_scene(text, "it");
        ASSERT_FALSE(scene) << text;
        EXPECT_NE(scene.error().message.find("line 1, column"), std::string::npos) << scene.error().message;
    }
}

}  // namespace
}  // namespace flaneur
