#include <gtest/gtest.h>

#include "tests/rendercheck/drawing.h"
#include "tools/rendercheck/check/things.h"

namespace flaneur {
namespace {

constexpr const char* k_legend =
    R"({"width": 8, "things": [{"id": 65537, "kind": "walker", "number": 3, "pixels": 4, "box": [0, 0, 2, 2]}, {"id": 0, "kind": "nothing", "number": 0},
        {"id": 9, "kind": "prop", "what": "bench", "number": 12}, {"id": 8, "kind": "house", "number": 1048575}]})";

std::vector<uint8_t> ids_png() {
    CheckedPicture ids = street(0, 8, 8);
    paint(ids, {0, 0, 8, 8}, 0, 0, 0);
    paint(ids, {0, 0, 2, 2}, 1, 0, 1);
    paint(ids, {4, 4, 1, 1}, 9, 0, 0);
    const std::string png = png_text(ids);
    return {png.begin(), png.end()};
}

TEST(Things, AreNamedByTheirLegend) {
    IdPicture picture;
    ASSERT_TRUE(read_ids(ids_png(), k_legend, picture));
    EXPECT_EQ(picture.ids[9], 65537u);
    EXPECT_EQ(picture.names.at(65537), "walker 3");
    EXPECT_EQ(picture.names.at(0), "sky");
    EXPECT_EQ(picture.names.at(9), "bench 12");
    EXPECT_EQ(picture.names.at(8), "house");
}

TEST(Things, BrokenLegendsAreNone) {
    IdPicture picture;
    for (const char* broken : {"", "{", "[]", R"({"things": 3})", R"({"things": [3]})",
                               R"({"things": [{"id": "x"}]})", R"({"things": [{"id": 1, "kind": 4}]})"})
        EXPECT_FALSE(read_ids(ids_png(), broken, picture)) << broken;
    EXPECT_FALSE(read_ids({1, 2, 3}, k_legend, picture));
}

TEST(Things, AShortLegendSaysTheSame) {
    const std::string brief = short_legend(k_legend);
    EXPECT_EQ(brief.find("pixels"), std::string::npos);
    IdPicture one, other;
    ASSERT_TRUE(read_ids(ids_png(), k_legend, one));
    ASSERT_TRUE(read_ids(ids_png(), brief, other));
    EXPECT_EQ(one.names, other.names);
    EXPECT_EQ(short_legend("{"), "");
}

}  // namespace
}  // namespace flaneur
