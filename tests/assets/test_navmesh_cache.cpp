#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "assets/cache/navmesh_cache.h"
#include "assets/cities.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

size_t files_in(const fs::path& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), {}));
}

void expect_same(const Navmesh& a, const Navmesh& b) {
    auto p = navmesh_triangles(a), q = navmesh_triangles(b);
    ASSERT_EQ(p.size(), q.size());
    EXPECT_EQ(0, std::memcmp(p.data(), q.data(), p.size() * sizeof p[0]));
}

TEST(NavmeshCache, KeepsWhatIsBuiltAndTrustsNothingElse) {
    TestFolder folder;
    std::string kept = folder.path.string();
    City city = generate_district({1, 1});
    auto built = build_navmesh(city.ground, {}, 1);
    ASSERT_TRUE(built);
    bool asked = false;
    auto get = [&] {
        asked = false;
        auto mesh = cached_navmesh(city.ground, {}, 1, kept, [&](float) { return asked = true; });
        EXPECT_TRUE(mesh);
        expect_same(**built, **mesh);
    };
    get();
    EXPECT_TRUE(asked);
    ASSERT_EQ(files_in(folder.path), 1u);
    get();
    EXPECT_FALSE(asked) << "built although it was kept";

    // Damaged anywhere, or cut short, it is built again.
    fs::path file = fs::directory_iterator(folder.path)->path();
    uintmax_t size = fs::file_size(file);
    for (uintmax_t at : {uintmax_t{3}, uintmax_t{20}, size / 2, size - 1}) {
        {
            std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
            bytes.seekg(static_cast<std::streamoff>(at));
            char c = static_cast<char>(bytes.get() ^ 4);
            bytes.seekp(static_cast<std::streamoff>(at));
            bytes.put(c);
        }
        get();
        EXPECT_TRUE(asked) << "byte " << at;
    }
    fs::resize_file(file, size / 3);
    get();
    EXPECT_TRUE(asked);

    // Another city and other settings have files of their own.
    NavmeshSettings wide;
    wide.agent_radius = 0.5f;
    ASSERT_TRUE(cached_navmesh(city.ground, wide, 1, kept));
    EXPECT_EQ(files_in(folder.path), 2u);
    city.ground.obstacles.pop_back();
    ASSERT_TRUE(cached_navmesh(city.ground, {}, 1, kept));
    EXPECT_EQ(files_in(folder.path), 3u);
    ASSERT_TRUE(cached_navmesh(city.ground, {}, 1, ""));
    ASSERT_TRUE(cached_navmesh(city.ground, {}, 1, "/proc/none"));
}

}  // namespace
}  // namespace flaneur
