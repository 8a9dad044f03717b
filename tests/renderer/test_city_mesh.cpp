#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/loaded/city_mesh.h"
#include "renderer/shapes.h"
#include "tests/renderer/synthetic_scene.h"

namespace flaneur {
namespace {

using Triangle = std::array<std::array<float, 3>, 3>;

std::vector<Triangle> triangles(const std::vector<CityVertex>& vertices,
                                const std::vector<uint32_t>& indices) {
    std::vector<Triangle> out(indices.size() / 3);
    for (size_t i = 0; i < indices.size(); ++i) {
        const glm::vec3 p = vertices[indices[i]].position;
        out[i / 3][i % 3] = {p.x, p.y, p.z};
    }
    std::sort(out.begin(), out.end());
    return out;
}

TEST(CityMesh, ChunksHoldEveryTriangleOnceAndTheirBoundsHoldThem) {
    const CityMesh mesh = synthetic_city();
    const Result<PreparedCity> city = prepare_city(mesh);
    ASSERT_TRUE(city);
    EXPECT_EQ(triangles(city->vertices, city->indices), triangles(mesh.vertices, mesh.indices));
    uint32_t covered = 0;
    for (int kind = 0; kind < k_city_classes; ++kind)
        for (const CityChunk& chunk : city->chunks[kind]) {
            covered += chunk.near.index_count;
            for (uint32_t i = 0; i < chunk.near.index_count; ++i) {
                const CityVertex& vertex = city->vertices[city->indices[chunk.near.first_index + i]];
                EXPECT_EQ(city_class(vertex.material), static_cast<CityClass>(kind));
                for (int c = 0; c < 3; ++c) {
                    EXPECT_GE(vertex.position[c], chunk.low[c]);
                    EXPECT_LE(vertex.position[c], chunk.high[c]);
                }
            }
        }
    EXPECT_EQ(covered, mesh.indices.size());
    EXPECT_EQ(city->ground_low, 0);
}

TEST(CityMesh, WallsHoldWholeWindows) {
    const Result<PreparedCity> city = prepare_city(synthetic_city());
    ASSERT_TRUE(city);
    int walls = 0;
    for (size_t i = 0; i < city->vertices.size(); i += 4) {  // quads
        if (city->vertices[i].material != k_material_facade) continue;
        const glm::vec2 end = city->vertices[i + 2].uv;
        EXPECT_NEAR(end.x / k_bay, std::round(end.x / k_bay), 1e-3f);
        EXPECT_GE(end.x, k_bay * 0.99f);
        EXPECT_NEAR(end.y, city->vertices[i].normal[3], 1e-4f);
        ++walls;
    }
    EXPECT_GT(walls, 50);
}

TEST(CityMesh, NarrowWallsHaveNone) {
    CityMesh mesh;
    for (glm::vec2 uv : {glm::vec2(0, 0), {1, 0}, {1, 9}, {0, 9}}) {
        CityVertex vertex{};
        vertex.position = {uv, 0};
        vertex.uv = uv;
        vertex.material = static_cast<uint16_t>(k_material_facade);
        vertex.extra = facade_extra(3, false);
        mesh.vertices.push_back(vertex);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    const Result<PreparedCity> city = prepare_city(mesh);
    ASSERT_TRUE(city);
    for (const CityVertex& vertex : city->vertices) EXPECT_EQ(vertex.normal[3], 0);
}

// Of a silo or a shed: v stays metres, as the shader reads it.
TEST(CityMesh, WallsMayHaveNoWindowsOrPanesAlone) {
    auto storeys = [](float storey) {
        CityMesh mesh;
        add_wall(mesh, {9, 0, 0}, {0, 0, 0}, 8, k_material_facade, vertex_colour(0xd8c9ae),
                 facade_extra(storey, false));
        const Result<PreparedCity> city = prepare_city(mesh);
        EXPECT_TRUE(city);
        float high = 0;
        for (const CityVertex& vertex : city->vertices) high = std::max(high, vertex.uv.y);
        return std::pair(static_cast<int>(city->vertices[0].normal[3]), high);
    };
    EXPECT_EQ(storeys(k_no_windows), std::pair(0, 4.0f));
    EXPECT_EQ(storeys(k_all_glass), std::pair(4, 4.0f));
    EXPECT_EQ(storeys(4).first, 2);
}

TEST(CityMesh, RefusesBrokenMeshesInASentence) {
    CityMesh mesh = synthetic_city();
    mesh.indices.push_back(0);
    EXPECT_FALSE(prepare_city(mesh));
    mesh.indices.pop_back();
    mesh.indices[5] = static_cast<uint32_t>(mesh.vertices.size());
    EXPECT_FALSE(prepare_city(mesh));
    mesh = synthetic_city();
    mesh.vertices[3].position.y = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(prepare_city(mesh));
    EXPECT_TRUE(prepare_city({}));
}

}  // namespace
}  // namespace flaneur
