#include <gtest/gtest.h>

#include <array>

#include "assets/files/picture.h"
#include "tests/folder.h"
#include "tools/flaneur/options/like.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/options/shell_words.h"

namespace flaneur {
namespace {

using Words = std::vector<std::string>;

TEST(ShellWords, AreWhatALineWasMadeOf) {
    for (const Words& words : {Words{"a", "--b=c", "d e"}, Words{"", "it's", "\"", "a\\b", "'"},
                               Words{"\t\n x"}, Words{"ünï/cödé", "$HOME;rm *"}, Words{}}) {
        const Result<Words> read = shell_words(shell_line(words));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(*read, words);
    }
    EXPECT_EQ(*shell_words("  a  \"b c\"d \\ e "), (Words{"a", "b cd", " e"}));
    EXPECT_FALSE(shell_words("a 'b"));
}

TEST(ShellWords, LoseOptionsWithTheirValues) {
    const std::array<std::string_view, 2> options = {"--size", "--out"};
    const std::array<std::string_view, 1> flags = {"--force"};
    EXPECT_EQ(without_options({"a", "--size", "1x1", "--force", "--out=x", "b", "--sized", "c", "--size"},
                              options, flags),
              (Words{"a", "b", "--sized", "c"}));
}

// A picture of one pixel that holds a text.
std::string picture(const TestFolder& folder, const std::string& name, const std::string& comment) {
    const std::array<uint8_t, 3> grey = {9, 9, 9};
    return folder.write(name, encode_png(grey, 1, 1, 3, comment));
}

TEST(Like, TakesThePicturesOptionsUnderThoseGiven) {
    TestFolder folder;
    const std::string file =
        picture(folder, "a.png",
                "flaneur render --scene corner --character 'a b.glb' --transparent --size 8x6 --frames 3 "
                "--out picture.png");
    EXPECT_EQ(*words_like({"--out", "x.png"}), (Words{"--out", "x.png"}));
    EXPECT_EQ(*words_like({"--like", file}),
              (Words{"--scene", "corner", "--character", "a b.glb", "--transparent", "--size", "8x6",
                     "--frames", "3", "--out", "picture.png"}));
    EXPECT_EQ(*words_like({"--size=9x9", "--like=" + file, "--character", "you.glb", "--transparent"}),
              (Words{"--scene", "corner", "--frames", "3", "--out", "picture.png", "--size=9x9",
                     "--character", "you.glb", "--transparent"}));
}

TEST(Like, IsParsedAsACommandLine) {
    TestFolder folder;
    const std::string file =
        picture(folder, "a.png", "flaneur render --scene corner --size 8x6 --out picture.png");
    Words words = {"flaneur", "render", "--like", file, "--out", "b.png"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    auto parsed = parse_options(static_cast<int>(argv.size()), argv.data());
    ASSERT_TRUE(parsed) << parsed.error().message;
    const Options& options = std::get<Options>(*parsed);
    EXPECT_EQ(options.scene.name, "corner");
    EXPECT_EQ(options.scene.size, (Size{8, 6}));
    EXPECT_EQ(options.out, "b.png");
    EXPECT_NE(std::find(options.inputs.begin(), options.inputs.end(), file), options.inputs.end())
        << "nothing is written over it";
}

TEST(Like, RefusesPicturesWithoutACommand) {
    TestFolder folder;
    for (const std::string& file :
         {picture(folder, "none.png", ""), picture(folder, "other.png", "a holiday"),
          picture(folder, "sim.png", "flaneur sim --seconds 3"),
          picture(folder, "open.png", "flaneur render 'x"),
          picture(folder, "loop.png", "flaneur render --like b.png --out a.png"),
          folder.write("text.png", "hello"), folder.write("empty.png", ""), folder / "nowhere.png"}) {
        const Result<Words> words = words_like({"--like", file, "--out", "x.png"});
        ASSERT_FALSE(words) << file;
        EXPECT_TRUE(words.error().message.starts_with("--like ")) << words.error().message;
    }
}

}  // namespace
}  // namespace flaneur
