#include <gtest/gtest.h>

#include "tools/flaneur/window/ask/filter.h"

namespace flaneur {
namespace {

WalkerFacts somebody(float age, bool is_woman) {
    WalkerFacts f;
    f.number = 12;
    f.age = age, f.is_woman = is_woman, f.height = 1.6f;
    f.speed = 1.2f, f.preferred = 1.3f;
    return f;
}
bool asks_for(const char* text, const WalkerFacts& facts) {
    const Result<Filter> filter = parse_filter(text);
    EXPECT_TRUE(filter) << text << ": " << (filter ? "" : filter.error().message);
    return filter && holds(*filter, facts);
}

TEST(Filter, WordsMustAllHold) {
    WalkerFacts f = somebody(74, true);
    f.cane = true;
    EXPECT_TRUE(asks_for("over 70", f));
    EXPECT_TRUE(asks_for("Woman over 70 with CANE", f));
    EXPECT_FALSE(asks_for("woman over 75 with cane", f));
    EXPECT_FALSE(asks_for("man", f));
    EXPECT_FALSE(asks_for("child", f));
    EXPECT_TRUE(asks_for("old women, walking", f));
    EXPECT_FALSE(asks_for("over 74", f)) << "not those who are just as old";
    EXPECT_TRUE(asks_for("12", f));
    EXPECT_TRUE(asks_for("no. 12", f));
    EXPECT_TRUE(asks_for("#12", f));
    EXPECT_FALSE(asks_for("13", f));
}

TEST(Filter, OrAndNot) {
    WalkerFacts f = somebody(30, false);
    f.pram = true;
    EXPECT_TRUE(asks_for("cane or pram", f));
    EXPECT_TRUE(asks_for("woman with cane or man with pram", f));
    EXPECT_FALSE(asks_for("cane or woman with pram", f));
    EXPECT_TRUE(asks_for("not waiting", f));
    EXPECT_FALSE(asks_for("not man", f));
    f.doing = Doing::stays;
    EXPECT_TRUE(asks_for("waiting", f));
    EXPECT_FALSE(asks_for("not waiting", f));
}

TEST(Filter, SpeedsHeightsAndPlaces) {
    WalkerFacts f = somebody(30, false);
    EXPECT_TRUE(asks_for("slower than 1.5", f));
    EXPECT_FALSE(asks_for("faster than 1.5 m/s", f));
    EXPECT_TRUE(asks_for("taller than 1.5 metres", f));
    EXPECT_FALSE(asks_for("to shop", f));
    f.to = DestinationKind::shop;
    EXPECT_TRUE(asks_for("to shop", f));
    EXPECT_TRUE(asks_for("going to a shop", f));
    EXPECT_TRUE(parse_filter("to shop").value().asks_where_to);
    EXPECT_FALSE(parse_filter("woman").value().asks_where_to);
    const Zones zones{{"Z1", "Gate"},
                      [](const std::string& zone, Vec3 place) { return zone == "Gate" && place.x > 0; }};
    f.place = {1, 0, 0};
    EXPECT_TRUE(holds(parse_filter("in gate", zones).value(), f));
    EXPECT_FALSE(holds(parse_filter("in z1", zones).value(), f));
    EXPECT_FALSE(parse_filter("in Z3", zones));
}

TEST(Filter, NobodyKnowsTheAgeOfWhoIsBroughtIn) {
    WalkerFacts f = somebody(0, false);
    f.is_built_in = false;
    for (const char* text : {"over 70", "under 6", "child", "man", "woman", "old"})
        EXPECT_FALSE(asks_for(text, f)) << text;
}

TEST(Filter, ErrorsNameTheWordAndThoseThatAreKnown) {
    const Result<Filter> filter = parse_filter("woman wearing red");
    ASSERT_FALSE(filter);
    EXPECT_NE(filter.error().message.find("wearing"), std::string::npos);
    EXPECT_NE(filter.error().message.find("over 70"), std::string::npos);
    for (const char* text : {"over", "over seventy", "faster than", "not", "or", "woman or", "or woman", "to",
                             "to moon", "in", "no. x"})
        EXPECT_FALSE(parse_filter(text)) << text;
    EXPECT_TRUE(parse_filter("").value().any.empty());
    EXPECT_TRUE(parse_filter("  ").value().any.empty());
}

// Every example of the hint is understood.
TEST(Filter, HintsAreTrue) {
    const Zones zones{{"Z1"}, [](const std::string&, Vec3) { return false; }};
    for (const char* text : {"woman",
                             "man",
                             "girl",
                             "boy",
                             "child",
                             "adult",
                             "old",
                             "over 70",
                             "under 6",
                             "taller than 1.9",
                             "shorter than 1.2",
                             "cane",
                             "pram",
                             "phone",
                             "glasses",
                             "bag",
                             "backpack",
                             "faster than 1.5",
                             "slower than 0.5",
                             "standing",
                             "walking",
                             "running",
                             "waiting",
                             "stuck",
                             "slowed",
                             "to door",
                             "to shop",
                             "to bench",
                             "to stop",
                             "to square",
                             "to edge",
                             "in Z1",
                             "12",
                             "woman over 70 with cane",
                             "child or pram",
                             "not waiting"})
        EXPECT_TRUE(parse_filter(text, zones)) << text;
}

}  // namespace
}  // namespace flaneur
