#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "assets/cache/person_cache.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

void expect_same(const Character& a, const Character& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.body.height, b.body.height);
    EXPECT_EQ(a.body.joints[head].y, b.body.joints[head].y);
    EXPECT_EQ(a.person.age, b.person.age);
    EXPECT_EQ(a.lods, b.lods);
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    for (size_t v = 0; v < a.vertices.size(); ++v) {
        ASSERT_EQ(a.vertices[v].position.x, b.vertices[v].position.x);
        ASSERT_EQ(a.vertices[v].colour, b.vertices[v].colour);
        ASSERT_EQ(0, std::memcmp(a.vertices[v].weights, b.vertices[v].weights, 4));
    }
}

TEST(PersonCache, GivesWhatTheGeneratorMakes) {
    TestFolder folder;
    PersonOptions options;
    options.age = 40;
    Character made = generate_person(options);
    expect_same(made, cached_person(options, folder.path.string()));
    ASSERT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1);
    fs::path file = fs::directory_iterator(folder.path)->path();
    fs::create_hard_link(file, folder / "same");
    expect_same(made, cached_person(options, folder.path.string()));
    EXPECT_EQ(fs::hard_link_count(file), 2u) << "read, not made anew";
    fs::remove(folder / "same");

    // A byte changed, and a file cut short: made anew.
    {
        std::fstream damaged(file, std::ios::in | std::ios::out | std::ios::binary);
        damaged.seekp(5000);
        damaged.put('x').put('y').put('z');
    }
    expect_same(made, cached_person(options, folder.path.string()));
    fs::resize_file(file, 1000);
    expect_same(made, cached_person(options, folder.path.string()));
    EXPECT_GT(fs::file_size(file), 100000u);

    options.age = 41;
    cached_person(options, folder.path.string());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 2);
}

TEST(PersonCache, NeedsNoFolder) {
    PersonOptions options;
    Character made = generate_person(options);
    expect_same(made, cached_person(options, ""));
    expect_same(made, cached_person(options, "/dev/null/none"));
}

}  // namespace
}  // namespace flaneur
