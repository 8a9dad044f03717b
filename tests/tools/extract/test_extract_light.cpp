// Where lamps light a city, and where its ground is darkened.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/cities.h"
#include "tools/extract/extract.h"
#include "tools/extract/parts.h"

namespace flaneur {
namespace {

const City& district() {
    static const City city = generate_district({3, 1});
    return city;
}

glm::vec4 light_at(const LampMap& map, Vec3 place) {
    const auto x = static_cast<size_t>((place.x - map.low.x) / map.texel);
    const auto z = static_cast<size_t>((place.z - map.low.y) / map.texel);
    return map.texels.at(z * map.width + x);
}

TEST(Lamps, LightTheGroundBelowThem) {
    const LampMap map = extract_lamps(district());
    ASSERT_EQ(map.texels.size(), size_t{map.width} * map.height);
    for (const glm::vec4& texel : map.texels)
        for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(texel[c]));
    int lamps = 0;
    for (const Prop& prop : district().props) {
        if (prop.kind != PropKind::lamp) continue;
        ++lamps;
        const glm::vec4 light = light_at(map, prop.position);
        EXPECT_GT(light.y, 0.7f);
        EXPECT_LT(light.y, 4);
        EXPECT_NEAR(light.w, prop.position.y, 0.3f) << "the ground's height";
    }
    EXPECT_GT(lamps, 5);
}

TEST(Lamps, DoNotShineThroughHouses) {
    City open;
    Prop lamp;
    lamp.kind = PropKind::lamp;
    lamp.height = 5;
    lamp.position = {0, 0, 0};
    open.props = {lamp};
    open.ground.vertices = {{-20, 0, -20}, {-20, 0, 20}, {20, 0, 20}, {20, 0, -20}};
    open.ground.indices = {0, 1, 2, 0, 2, 3};
    open.ground.kinds = {Surface::plaza, Surface::plaza};
    open.ground_axes = {{1, 0}, {1, 0}};
    City walled = open;
    walled.ground.faces = {{{4, 0, 20}, {4, 0, -20}, 8, 8, FaceKind::garden_wall, ~0u}};
    index_city(open);
    index_city(walled);
    const LampMap before = extract_lamps(open), after = extract_lamps(walled);
    const Vec3 behind{7, 0, 0}, in_front{-7, 0, 0};
    EXPECT_GT(light_at(before, behind).y, 0.05f);
    EXPECT_EQ(light_at(after, behind), glm::vec4(0));
    EXPECT_EQ(light_at(after, in_front), light_at(before, in_front));
    EXPECT_GT(light_at(before, in_front).x, 0) << "from the lamp's side";
    open.props.clear();
    EXPECT_TRUE(extract_lamps(open).texels.empty());
}

TEST(Lamps, HangUnseenOverKerbsThatHaveNone) {
    City city = district();
    std::erase_if(city.props, [](const Prop& prop) { return prop.kind == PropKind::lamp; });
    const LampMap map = extract_lamps(city);
    int kerbs = 0, lit = 0;
    for (const Face& face : city.ground.faces) {
        if (face.kind != FaceKind::kerb) continue;
        ++kerbs;
        lit += light_at(map, face.a).y > 0;
    }
    EXPECT_GT(lit, 0.9 * kerbs);
}

TEST(Shades, LieOnTheGround) {
    CityMesh mesh;
    add_shades(district(), mesh);
    ASSERT_GT(mesh.indices.size(), 300u);
    ASSERT_EQ(mesh.indices.size() % 3, 0u);
    EXPECT_LT(*std::max_element(mesh.indices.begin(), mesh.indices.end()), mesh.vertices.size());
    for (const CityVertex& vertex : mesh.vertices) {
        const Vec3 place{vertex.position.x, vertex.position.y, vertex.position.z};
        const std::optional<GroundHit> hit = ground_at(district().ground, place, 0.1f, 0.1f);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(place.y - hit->height, 0.012f, 1e-3f);
        EXPECT_TRUE(vertex.uv.x == 0 || vertex.uv.x == 1);
        EXPECT_GT(vertex.uv.y, 0);
        EXPECT_LT(vertex.uv.y, 1);
    }
}

}  // namespace
}  // namespace flaneur
