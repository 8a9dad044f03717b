#include <gtest/gtest.h>

#include <cmath>

#include "assets/scene.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/window/ask/things.h"

namespace flaneur {
namespace {

// A house of 6 by 4 m with a flat roof beside a car, on a lawn.
std::shared_ptr<City> lawn() {
    auto city = std::make_shared<City>();
    Ground& ground = city->ground;
    ground.vertices = {{-50, 0, -50}, {-50, 0, 50}, {50, 0, 50}, {50, 0, -50}};
    ground.indices = {0, 1, 2, 0, 2, 3};
    ground.kinds = {Surface::grass, Surface::grass};
    Building house;
    house.top = 6.4f;
    city->buildings.push_back(house);
    const Vec3 corners[] = {{0, 0, 0}, {0, 0, 4}, {6, 0, 4}, {6, 0, 0}};
    for (int i = 0; i < 4; ++i)
        ground.faces.push_back({corners[i], corners[(i + 1) % 4], 6.4f, 6.4f, FaceKind::facade, 0});
    for (Vec3 c : corners) city->roof_vertices.push_back({c.x, 6.4f, c.z});
    city->roof_indices = {0, 1, 2, 0, 2, 3};
    city->roof_buildings = {0, 0};
    Prop car;
    car.kind = PropKind::car, car.position = {-5, 0, 0}, car.height = 1.5f;
    city->props.push_back(car);
    index_city(*city);
    return city;
}

Thing at(const CityIndex& index, Vec3 eye, Vec3 target) {
    const auto thing = thing_along(index, eye, normalize_or(target - eye, {}));
    EXPECT_TRUE(thing);
    return thing.value_or(Thing{});
}

TEST(Things, AreFoundUnderTheCursor) {
    const CityIndex index = index_things(lawn());
    const Vec3 eye{-20, 12, 20};
    EXPECT_EQ(at(index, eye, {-10, 0, 8}).kind, ThingKind::ground);
    const Thing wall = at(index, eye, {1, 3, 4}), roof = at(index, eye, {3, 6.4f, 2});
    EXPECT_EQ(wall.kind, ThingKind::building);
    EXPECT_EQ(roof.kind, ThingKind::building) << "a roof is not passed through";
    EXPECT_NEAR(roof.place.y, 6.4f, 1e-3f);
    EXPECT_GT(roof.normal.y, 0.99f);
    EXPECT_TRUE(is_same(wall, roof));
    const Thing car = at(index, eye, {-5, 0.7f, 0});
    EXPECT_EQ(car.kind, ThingKind::prop);
    EXPECT_NEAR(length(car.place - Vec3{-5, 0.7f, 0}), 1.2f, 1.2f);
    const auto through = thing_along(index, eye, normalize_or(Vec3{-5, 0.7f, 0} - eye, {}), false);
    ASSERT_TRUE(through);
    EXPECT_EQ(through->kind, ThingKind::ground);
    EXPECT_FALSE(thing_along(index, eye, {0, 1, 0}));
}

TEST(Things, OfAHouseAreMeasured) {
    const CityIndex index = index_things(lawn());
    ASSERT_TRUE(footprint_of(index, 0));
    EXPECT_NEAR(*footprint_of(index, 0), 24, 1e-3);
    EXPECT_EQ(storeys_of(index.city->buildings[0]), 2);
    Building plain = index.city->buildings[0];
    plain.finish = Finish::plain;
    EXPECT_FALSE(storeys_of(plain)) << "where there are no windows nobody knows";
    const ThingFacts facts = facts_of(index, at(index, {-20, 12, 20}, {3, 6.4f, 2}));
    EXPECT_EQ(facts.title, "Building");
    EXPECT_FALSE(facts.lines.empty());
}

// In the built-in city most houses close, and cover no more than their roofs.
TEST(Things, OfTheDistrictHaveFootprints) {
    Scene scene = load_scene("corner").value();
    auto city = std::make_shared<City>(read_city(scene).value());
    const CityIndex index = index_things(city);
    int known = 0;
    for (uint32_t i = 0; i < index.houses.size(); ++i) {
        const auto area = footprint_of(index, i);
        if (!area) continue;
        ++known;
        double roofs = 0;
        for (uint32_t t : index.houses[i].roofs) {
            const uint32_t* c = &city->roof_indices[size_t{t} * 3];
            const Vec2 a = on_ground(city->roof_vertices[c[0]]), b = on_ground(city->roof_vertices[c[1]]),
                       d = on_ground(city->roof_vertices[c[2]]);
            roofs += static_cast<double>(std::fabs(cross(b - a, d - a))) / 2;
        }
        EXPECT_GT(*area, 5) << i;
        EXPECT_LT(*area, 1.02 * roofs) << i;  // which jut out over walls, or lie over each other
    }
    EXPECT_GT(known, static_cast<int>(index.houses.size()) / 2) << index.houses.size();
}

}  // namespace
}  // namespace flaneur
