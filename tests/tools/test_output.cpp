#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>
#include <tuple>

#include "assets/files/file.h"
#include "assets/files/picture.h"
#include "tools/flaneur/output/film.h"
#include "tools/flaneur/output/output.h"

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

TEST_F(Files, AreNotWrittenOverWhatIsRead) {
    std::ofstream(path / "read.osm") << "a map";
    fs::create_symlink("read.osm", path / "link.osm");
    protect_inputs([&] {
        return std::vector<std::string>{(path / "read.osm").string(), "", (path / "nowhere").string()};
    });
    for (const char* name : {"read.osm", "link.osm", "./read.osm"}) {
        Result<PartFilePtr> file = open_file((path / name).string());
        ASSERT_FALSE(file) << name;
        EXPECT_NE(file.error().message.find("this command reads it"), std::string::npos)
            << file.error().message;
    }
    EXPECT_TRUE(open_file((path / "other.osm").string()));
    protect_inputs([] { return std::vector<std::string>{}; });
    EXPECT_TRUE(open_file((path / "read.osm").string()));
}

TEST_F(Files, KeepTransparencyWhereItIsAskedFor) {
    std::vector<uint8_t> rgba(5 * 3 * 4);
    for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<uint8_t>(i * 4);
    for (const Alpha alpha : {Alpha::dropped, Alpha::kept}) {
        const std::string name = path / "picture.png";
        ASSERT_TRUE(write_png(std::move(*open_file(name)), rgba, k_size, "", alpha));
        const DecodedPicture read = decode_picture(*read_bytes(name, 1 << 20), 100).value();
        for (size_t i = 0; i < rgba.size(); ++i)
            EXPECT_EQ(read.rgba[i], i % 4 == 3 && alpha == Alpha::dropped ? 255 : rgba[i]);
    }
}

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

bool write_words(const fs::path& to, const std::string& words) {
    Result<PartFilePtr> file = open_file(to);
    EXPECT_TRUE(file) << file.error().message;
    if (!file) return false;
    std::fputs(words.c_str(), (*file)->file);
    return static_cast<bool>(keep_file(std::move(*file)));
}

std::string words_of(const fs::path& from) {
    std::string text;
    std::ifstream(from) >> text;
    return text;
}

TEST_F(Files, ThatAreDevicesStayDevices) {
    for (auto [name, minor_number, takes] : {std::tuple{"null", 3u, true}, {"full", 7u, false}}) {
        fs::path device = path / name;  // one of our own: a mistake would replace the system's
        if (mknod(device.c_str(), S_IFCHR | 0600, makedev(1, minor_number)) != 0)
            GTEST_SKIP() << "only root makes devices";
        EXPECT_EQ(write_words(device, "words"), takes) << name;
        EXPECT_TRUE(fs::is_character_file(device)) << name;
        EXPECT_TRUE(open_file(device));
        EXPECT_TRUE(fs::is_character_file(device)) << "given up: " << name;
    }
    EXPECT_EQ(entries(), 2u);
}

TEST_F(Files, ThatArePipesAreWrittenTo) {
    fs::path pipe = path / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    std::string heard;
    std::thread listener([&] { heard = words_of(pipe); });
    EXPECT_TRUE(write_words(pipe, "words"));
    listener.join();
    EXPECT_EQ(heard, "words");
    EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(Files, WrittenThroughLinksLeaveThem) {
    fs::create_directory(path / "deep");
    fs::create_symlink("deep/target", path / "link");  // where nothing is yet
    fs::create_symlink(path / "link", path / "second");
    for (const char* words : {"first", "again"}) {
        EXPECT_TRUE(write_words(path / "second", words));
        EXPECT_TRUE(fs::is_symlink(path / "link") && fs::is_symlink(path / "second"));
        EXPECT_EQ(words_of(path / "deep" / "target"), words);
    }
    fs::create_symlink(path / "round", path / "round");
    EXPECT_FALSE(open_file(path / "round"));
}

TEST_F(Files, ThatAreProtectedStay) {
    std::ofstream(path / "text") << "old";
    fs::permissions(path / "text", fs::perms(0444));
    EXPECT_FALSE(open_file(path / "text"));
    EXPECT_EQ(words_of(path / "text"), "old");
    fs::permissions(path / "text", fs::perms(0640));
    EXPECT_TRUE(write_words(path / "text", "new"));
    EXPECT_EQ(fs::status(path / "text").permissions(), fs::perms(0640));
    EXPECT_EQ(entries(), 1u);
}

TEST_F(Files, MayHaveLongNames) { EXPECT_TRUE(write_words(path / std::string(250, 'a'), "words")); }

TEST_F(Files, AbandonedLeaveNothing) {
    Result<PartFilePtr> file = open_file(path / "a" / "b" / "text");
    ASSERT_TRUE(file);
    abandon_outputs();
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

TEST_F(Outputs, TakeNamesAsTheyAre) {
    for (const char* name : {"A.PNG", "-y.png", "night-21:15.mp4", "-y.mp4", "file:a.Mp4"}) {
        fs::path before = fs::current_path();
        fs::current_path(path);
        Result<OutputPtr> output = open_output(name, k_size, {0, 0, 1});
        ASSERT_TRUE(output) << output.error().message;
        EXPECT_TRUE(write_image(**output, k_grey, 0)) << name;
        EXPECT_TRUE(finish_output(**output)) << name;
        fs::current_path(before);
        EXPECT_TRUE(fs::exists(path / name)) << name;
    }
    EXPECT_EQ(entries(), 5u);
}

TEST_F(Outputs, AFilmIsNoDevice) {
    ASSERT_EQ(mkfifo((path / "a.mp4").c_str(), 0600), 0);
    EXPECT_FALSE(open_output(path / "a.mp4", k_size, {0, 10, 1}));  // nobody reads it, and nobody waits
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

// What stands in for a program of ffmpeg.
void write_program(const fs::path& file, const std::string& words) {
    std::ofstream(file) << "#!/bin/sh\n" << words << "\n";
    fs::permissions(file, fs::perms::owner_all);
}

// As by Ctrl-C while what was drawn is joined to what was there.
TEST_F(Outputs, FilmsThatAreBeingJoinedCanBeAbandoned) {
    const std::string paths = getenv("PATH");
    signal(SIGPIPE, SIG_IGN);  // as the program does
    write_program(path / "ffprobe", "printf '6\\n4\\n60/1\\n1\\n{\"--seed\":\"1\"}\\n'");
    fs::path joining = path / "joining";
    ASSERT_EQ(mkfifo(joining.c_str(), 0600), 0);
    write_program(path / "ffmpeg", "case \"$*\" in *concat*) echo yes > " + joining.string() +
                                       "; exec sleep 20;; esac; cat > /dev/null");
    std::ofstream(path / "film.mp4") << "begun";
    setenv("PATH", (path.string() + ":" + paths).c_str(), 1);
    Result<FilmPtr> film = open_film(path / "film.mp4", k_size, 1, "{\"--seed\":\"1\"}", true);
    ASSERT_TRUE(film) << film.error().message;
    EXPECT_EQ(pictures_begun_with(**film), 1u);
    EXPECT_TRUE(write_film(**film, k_grey));
    std::thread another([&] {
        EXPECT_EQ(words_of(joining), "yes");
        abandon_films();
    });
    EXPECT_FALSE(finish_film(std::move(*film))) << "ffmpeg went on";
    another.join();
    setenv("PATH", paths.c_str(), 1);
    EXPECT_EQ(words_of(path / "film.mp4"), "begun");
}

}  // namespace
}  // namespace flaneur
