#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>

#include "tools/flaneur/output.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

struct Folder : testing::Test {
    Folder() {
        char name[] = "/tmp/flaneur-test-XXXXXX";
        path = mkdtemp(name);
    }
    ~Folder() override { fs::remove_all(path); }
    size_t entries() const { return static_cast<size_t>(std::distance(fs::directory_iterator(path), {})); }
    fs::path path;
};
using Files = Folder;
using Outputs = Folder;

const Size k_size{5, 3};
const std::vector<uint8_t> k_grey(5 * 3 * 4, 128);

TEST_F(Files, AppearWhenTheyAreWhole) {
    std::string name = path / "new" / "text";
    Result<PartFilePtr> file = open_file(name);
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_FALSE(fs::exists(name));
    std::fputs("words", (*file)->file);
    ASSERT_TRUE(keep_file(std::move(*file)));
    std::string text;
    std::ifstream(name) >> text;
    EXPECT_EQ(text, "words");
    EXPECT_EQ(std::distance(fs::directory_iterator(path / "new"), {}), 1);
}

TEST_F(Files, GivenUpLeaveNeitherThemselvesNorTheirFolders) {
    {
        Result<PartFilePtr> file = open_file(path / "a" / "b" / "text");
        ASSERT_TRUE(file);
        EXPECT_EQ(entries(), 1u);
    }
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Files, GivenUpLeaveWhatWasThere) {
    std::ofstream(path / "text") << "old";
    { ASSERT_TRUE(open_file(path / "text")); }
    std::string text;
    std::ifstream(path / "text") >> text;
    EXPECT_EQ(text, "old");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, AreRefusedWhereTheyCannotBe) {
    std::ofstream(path / "text") << "old";
    EXPECT_FALSE(open_file(path / "text" / "text"));
    EXPECT_FALSE(open_file(path));
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, ThatDoNotFitAreRefused) {
    PartFilePtr full(new PartFile);
    full->path = path / "text";
    full->part = "/dev/full";
    full->file = std::fopen("/dev/full", "wb");
    ASSERT_TRUE(full->file);
    std::fputs("words", full->file);
    full->part = path / "part";  // so that /dev/full stays
    EXPECT_FALSE(keep_file(std::move(full)));
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Outputs, NumberPicturesByTick) {
    TickRange ticks{8, 12, 2};
    Result<OutputPtr> output = open_output(path / "%04d.png", k_size, ticks);
    ASSERT_TRUE(output) << output.error().message;
    for (uint32_t tick : {8u, 10u, 12u}) ASSERT_TRUE(write_image(**output, k_grey, tick));
    ASSERT_TRUE(finish_output(**output));
    for (const char* name : {"0008.png", "0010.png", "0012.png"}) EXPECT_GT(fs::file_size(path / name), 50u);
    EXPECT_EQ(entries(), 3u);
}

TEST_F(Outputs, RefuseWhatTheyCouldNotFinish) {
    for (const char* name : {"a.png", "%s.png", "%d%d.png", "%5d.png", "%0999d.png", "%.png"})
        EXPECT_FALSE(open_output(path / name, k_size, {0, 10, 1})) << name;
    EXPECT_FALSE(open_output(path / "a.jpg", k_size, {0, 0, 1}));
    EXPECT_FALSE(open_output("", k_size, {0, 0, 1}));
    EXPECT_EQ(entries(), 0u);
}

TEST_F(Outputs, AFilmGivenUpLeavesNothing) {
    {
        Result<OutputPtr> output = open_output(path / "a.mp4", k_size, {0, 10, 1});
        ASSERT_TRUE(output) << output.error().message;
        ASSERT_TRUE(write_image(**output, k_grey, 0));
    }
    EXPECT_EQ(entries(), 0u);
}

}  // namespace
}  // namespace flaneur
