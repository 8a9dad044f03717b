// What cameras that place themselves have in the picture: what there is to see, wherever it lies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "sim/sim.h"
#include "sim/world.h"
#include "tools/flaneur/view/camera.h"

namespace flaneur {
namespace {

constexpr float k_aspect = 16.0f / 9;

bool is_in_picture(const Camera& camera, Vec3 at) {
    glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0))), up = glm::cross(right, ahead);
    glm::vec3 way = glm::vec3(at.x, at.y, at.z) - camera.eye;
    float depth = glm::dot(way, ahead), half = std::tan(camera.vertical_fov / 2) * depth;
    return depth > 0 && std::fabs(glm::dot(way, up)) < half &&
           std::fabs(glm::dot(way, right)) < half * k_aspect;
}

// A meadow of 300 x 300 m, at a height, with a row of people somewhere.
WorldPtr meadow_with_people(float height, Vec3 first, int count) {
    constexpr float k_half = 150;
    const Vec3 corners[] = {{-k_half, height, -k_half},
                            {-k_half, height, k_half},
                            {k_half, height, k_half},
                            {k_half, height, -k_half}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    WorldOptions options;
    options.capacity = static_cast<uint32_t>(count);
    Result<WorldPtr> world = make_world({corners, triangles, {}}, options);
    EXPECT_TRUE(world);
    for (int i = 0; i < count; ++i) {
        WalkerOptions walker;
        walker.place = first + Vec3{static_cast<float>(i), 0, 0};
        EXPECT_TRUE(add_walker(**world, walker));
    }
    return std::move(*world);
}

TEST(Overview, HasPeopleInThePictureWhereverTheyAre) {
    const Vec3 to_sun{0, 0.6f, 0.8f};
    for (Vec3 first : {Vec3{0, 0, 0}, Vec3{-145, 0, -145}, Vec3{100, 0, -60}}) {
        for (float height : {0.0f, 430.0f, -90.0f}) {
            Vec3 at = first + Vec3{0, height, 0};
            WorldPtr world = meadow_with_people(height, at, 20);
            Camera camera = overview_camera(*world, {}, to_sun);
            for (int i = 0; i < 20; ++i) {
                Vec3 person = at + Vec3{static_cast<float>(i), 1, 0};
                EXPECT_TRUE(is_in_picture(camera, person)) << first.x << " " << height << " " << i;
            }
            EXPECT_LT(glm::distance(camera.eye, {at.x + 10, at.y, at.z}), 60) << "nor are they specks";
            EXPECT_GT(camera.eye.y, height + 1);
        }
    }
}

TEST(Overview, LooksAtTheGroundWhereNobodyIs) {
    WorldPtr world = meadow_with_people(0, {}, 0);
    Camera camera = overview_camera(*world, {}, {0, 1, 0});
    EXPECT_TRUE(is_in_picture(camera, {0, 0, 0}));
    EXPECT_GT(camera.eye.y, 10);
}

// Four fronts about a middle.
void add_house(Ground& ground, Vec3 foot, float half, float high, uint32_t building) {
    const Vec2 corners[] = {{-half, half}, {half, half}, {half, -half}, {-half, -half}};
    for (size_t i = 0; i < 4; ++i) {
        Vec3 a = foot + at_height(corners[i], 0), b = foot + at_height(corners[(i + 1) % 4], 0);
        ground.faces.push_back({a, b, foot.y + high, foot.y + high, FaceKind::facade, building});
    }
}

// A village in the west, and a tower in the east that has more front than all of it, in one piece or in as
// many parts as it has storeys.
TEST(Overview, IsNotFilledByOneHouse) {
    for (int parts : {1, 40}) {
        auto ground = std::make_shared<Ground>();
        ground->vertices = {{-300, 0, -300}, {-300, 0, 300}, {300, 0, 300}, {300, 0, -300}};
        ground->indices = {0, 1, 2, 0, 2, 3};
        ground->kinds = {Surface::grass, Surface::grass};
        float storey = 140.0f / static_cast<float>(parts);
        for (int i = 0; i < parts; ++i)
            add_house(*ground, {200, static_cast<float>(i) * storey, 0}, 45, storey,
                      9 + static_cast<uint32_t>(i));
        std::vector<Building> buildings(9 + static_cast<size_t>(parts));
        for (uint32_t i = 0; i < buildings.size(); ++i) buildings[i].seed = std::min(i, 9u);
        for (uint32_t i = 0; i < 9; ++i)
            add_house(*ground,
                      {-220 + 25.0f * static_cast<float>(i % 3), 0, -25 + 25.0f * static_cast<float>(i / 3)},
                      4, 8, i);
        index_ground(*ground);
        auto world = make_world(ground, WorldOptions{});
        ASSERT_TRUE(world) << world.error().message;
        Camera camera = overview_camera(**world, buildings, {0, 0.6f, 0.8f});
        EXPECT_TRUE(is_in_picture(camera, {-195, 4, 0})) << parts;
        EXPECT_LT(camera.eye.x, 0) << parts;
    }
}

// A row of people, and a shelter right beside it.
TEST(StreetCamera, LooksPastWhatWouldFillThePicture) {
    WorldPtr world = meadow_with_people(0, {-10, 0, 0}, 20);
    auto looks_at_shelter = [&](const City& city) {
        Camera camera = street_camera(city, *world);
        Vec3 eye{camera.eye.x, 0, camera.eye.z};
        int filled = 0;
        for (const Prop& prop : city.props) {
            Vec3 way = prop.position - eye;
            filled += length(way) < 12 && is_in_picture(camera, prop.position + Vec3{0, 1.3f, 0});
        }
        return filled > 0;
    };
    City city;
    Camera empty = street_camera(city, *world);
    Vec3 heading{empty.target.x - empty.eye.x, 0, empty.target.z - empty.eye.z};
    Prop shelter;
    shelter.kind = PropKind::shelter;
    shelter.position = Vec3{empty.eye.x, 0, empty.eye.z} + heading * (7 / length(heading));
    city.props.push_back(shelter);
    EXPECT_FALSE(looks_at_shelter(city));
}

// How far up the picture something is: 0 at its lower edge, 1 at the upper one.
float height_in_picture(const Camera& camera, Vec3 at) {
    glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
    glm::vec3 up = glm::cross(glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0))), ahead);
    glm::vec3 way = glm::vec3(at.x, at.y, at.z) - camera.eye;
    return 0.5f + 0.5f * glm::dot(way, up) / glm::dot(way, ahead) / std::tan(camera.vertical_fov / 2);
}

// One who stands at the middle of a place with a wall so far behind, in the picture from hat to soles.
void expect_whole(float height, float wall) {
    auto ground = std::make_shared<Ground>();
    ground->vertices = {{-30, 2, -30}, {-30, 2, 30}, {30, 2, 30}, {30, 2, -30}};
    ground->indices = {0, 1, 2, 0, 2, 3};
    ground->kinds = {Surface::grass, Surface::grass};
    add_house(*ground, {0, 2, -wall - 5}, 5, 8, 0);
    index_ground(*ground);
    WorldOptions options;
    options.capacity = 1;
    options.kinds = {{standard_body(height / 1.1f)}};
    auto world = make_world_on(*ground, options);
    ASSERT_TRUE(world) << world.error().message;
    WalkerOptions walker;
    walker.place = Vec3{0, 2, 0};
    walker.scale = 1.1f;
    ASSERT_TRUE(add_walker(**world, walker));
    Camera camera = follow_camera(**world, 0, 1);
    EXPECT_TRUE(sees(*ground, {camera.eye.x, camera.eye.y, camera.eye.z}, {0, 2 + height, 0}));
    constexpr float k_margin = 0.025f;
    const float hat = 0.07f * height, hind = 0.3f * height;
    const Vec3 crown{0, 2 + height + hat, 0}, soles{0, 2, 0}, hind_sole{0, 2, -hind};
    float top = height_in_picture(camera, crown), bottom = height_in_picture(camera, soles);
    EXPECT_TRUE(is_in_picture(camera, crown) && is_in_picture(camera, soles)) << height << " " << wall;
    EXPECT_LT(top, 1 - k_margin) << height << " " << wall;
    EXPECT_GT(bottom, k_margin) << height << " " << wall;
    EXPECT_GT(height_in_picture(camera, hind_sole), k_margin) << height << " " << wall;
    EXPECT_GT(top - bottom, 0.6f) << "nor is it a speck: " << height << " " << wall;
}

TEST(FollowCamera, ShowsSmallAndTallFromHatToSoles) {
    for (float height : {1.0f, 1.7f, 2.0f})
        for (float wall : {20.0f, 2.5f}) expect_whole(height, wall);
}

}  // namespace
}  // namespace flaneur
