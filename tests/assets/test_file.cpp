#include <gtest/gtest.h>
#include <sys/stat.h>

#include "assets/files/file.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

TEST(Files, AreOfAKindByTheirEndings) {
    for (const char* map : {"a.osm", "b.OSM", "c.osm.pbf", "d.pbf", "e.osm.gz", "f.Osm.Bz2", "x.glb/y.osm"})
        EXPECT_EQ(kind_of(map), FileKind::map) << map;
    for (const char* gltf : {"a.glb", "M.GLTF", "b.VRM", "maps.osm/a.glb", "berlin.osm.glb"})
        EXPECT_EQ(kind_of(gltf), FileKind::gltf) << gltf;
    for (const char* other : {"", "osm", ".os", "a.osm.txt", "a.osm/b", "a.gz", "glb"})
        EXPECT_EQ(kind_of(other), FileKind::other) << other;
}

TEST(Files, AreReadWholeOrRefused) {
    TestFolder folder;
    Result<Bytes> bytes = read_bytes(folder.write("five", "12345"), 5);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(std::string(bytes->begin(), bytes->end()), "12345");
    EXPECT_EQ(read_bytes(folder.write("none", ""), 5)->size(), 0u);
    EXPECT_NE(read_bytes(folder / "five", 4).error().message.find("larger"), std::string::npos);
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    auto says = [](const std::string& path, const char* words) {
        return read_bytes(path, 5).error().message.find(words) != std::string::npos;
    };
    EXPECT_TRUE(says(folder / "nowhere", "cannot be opened"));
    EXPECT_TRUE(says(folder / "", "is a folder"));
    EXPECT_TRUE(says(folder / "pipe", "is a pipe or a device"));
    EXPECT_TRUE(says("/dev/zero", "is a pipe or a device"));
}

TEST(Files, AreQuotedShortAndPlain) {
    EXPECT_EQ(excerpt("Jörg's house"), "Jörg's house");
    EXPECT_EQ(excerpt("\x1b[2J\a\n\x7f"), "?[2J???");
    EXPECT_EQ(excerpt(std::string(60, 'a')), std::string(60, 'a'));
    EXPECT_EQ(excerpt(std::string(61, 'a')), std::string(57, 'a') + "...");
    std::string cut = excerpt(std::string(56, 'a') + "\u00f6\u00f6\u00f6");
    EXPECT_EQ(cut, std::string(56, 'a') + "...") << "no half letters";
}

TEST(Files, JsonIsMeasuredBeforeItIsParsed) {
    EXPECT_TRUE(check_json(R"({"a": [[1, 2], "[[[[{{{{,,,,\"[["]})", 3, 6));
    EXPECT_FALSE(check_json("[[[[1]]]]", 3, 9));
    EXPECT_FALSE(check_json("[1, 2, 3]", 3, 2));
    EXPECT_FALSE(check_json("[[[[", 3, 9));
    EXPECT_TRUE(check_json("]]]]]", 3, 9)) << "the parser's to refuse";
}

}  // namespace
}  // namespace flaneur
