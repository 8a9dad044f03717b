#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "assets/cache/levels_cache.h"
#include "tests/assets/levels/horrors.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

Character palette_man(uint32_t tint) {
    BallLook look;
    look.colours = {tint};
    look.swatches = {0.1f, 0.6f};
    look.texture = 0;
    Character c = ball_man(1, 14, 16, {look});
    c.textures.push_back(palette_texture());
    return c;
}

void expect_same(const Character& a, const Character& b) {
    EXPECT_EQ(a.lods, b.lods);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_EQ(0, std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof a.vertices[0]));
    ASSERT_EQ(a.found.levels.size(), b.found.levels.size());
    for (size_t i = 0; i < a.found.levels.size(); ++i) {
        const MeasuredLevel &one = a.found.levels[i], &other = b.found.levels[i];
        EXPECT_EQ(one.pixels, other.pixels);
        EXPECT_EQ(one.triangles, other.triangles);
        EXPECT_EQ(one.silhouette, other.silhouette);
        EXPECT_EQ(one.colour, other.colour);
        EXPECT_EQ(one.refused, other.refused);
    }
}

size_t files_of(const TestFolder& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder.path), {}));
}

TEST(LevelsCache, GivesWhatIsMade) {
    TestFolder folder;
    const Character brought = palette_man(0xffffffff);
    Character made = brought;
    build_lods(made);
    ASSERT_GT(made.lods.size(), 1u);
    auto expect_made = [&] {
        Character kept = brought;
        cached_lods(kept, folder.path.string());
        expect_same(made, kept);
    };
    expect_made();
    ASSERT_EQ(files_of(folder), 1u);
    const fs::path file = fs::directory_iterator(folder.path)->path();
    fs::create_hard_link(file, folder / "same");
    expect_made();
    EXPECT_EQ(fs::hard_link_count(file), 2u) << "read, not made anew";
    fs::remove(folder / "same");

    std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(5000).put('x').put('y');
    expect_made();
    fs::resize_file(file, 1000);
    expect_made();
    EXPECT_GT(fs::file_size(file), 10000u);
}

// Whatever a level is made from names its file.
TEST(LevelsCache, KnowsWhoseLevelsTheyAre) {
    TestFolder folder;
    auto keep = [&](auto change) {
        Character c = palette_man(0xffffffff);
        change(c);
        cached_lods(c, folder.path.string());
        return files_of(folder);
    };
    EXPECT_EQ(keep([](Character&) {}), 1u);
    EXPECT_EQ(keep([](Character& c) { c.vertices[7].colour = 0xff0000ff; }), 2u);
    EXPECT_EQ(keep([](Character& c) { c.textures[0].rgba[5] ^= 1; }), 3u);
    EXPECT_EQ(keep([](Character& c) { c.body.joints[head].y += 0.01f; }), 4u);
    EXPECT_EQ(keep([](Character& c) { c.bind_joints[left_hand].x += 0.01f; }), 5u);
    EXPECT_EQ(keep([](Character& c) { c.lods[0].resize(c.lods[0].size() - 3); }), 6u);
    EXPECT_EQ(keep([](Character& c) { c.name = "else"; }), 6u) << "which no level shows";
}

TEST(LevelsCache, NeedsNoFolder) {
    Character made = palette_man(0xffffffff), kept = made;
    build_lods(made);
    cached_lods(kept, "/dev/null/none");
    expect_same(made, kept);
}

}  // namespace
}  // namespace flaneur
