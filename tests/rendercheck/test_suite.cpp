#include <gtest/gtest.h>

#include "tests/folder.h"
#include "tools/rendercheck/suite/suite.h"

namespace flaneur {
namespace {

std::string fault(std::string_view json) {
    const Result<Suite> suite = parse_suite(json, "s.json");
    return suite ? "" : suite.error().message;
}

void expect_fault(std::string_view json, std::string_view part) {
    const std::string said = fault(json);
    EXPECT_NE(said.find(part), std::string::npos) << json << "\n" << said;
}

TEST(Suite, HasDefaultsAndCases) {
    const Result<Suite> suite = parse_suite(R"({
        "//": "what is said here is for people",
        "golden": "right", "key": "mine", "programs": {"draw": "bin/draw"}, "env": {"A": "1", "B": null},
        "defaults": {"size": "64x32", "time_limit": 5, "tolerance": {"over": 0.5}, "tags": ["slow"], "env": {"C": "{suite}"}},
        "cases": [
            {"name": "one", "command": ["{draw}", "{out}"]},
            {"name": "two", "command": "{draw} > {out}", "shell": true, "tolerance": {"in_window": 3}, "tags": [], "env": {"A": null}},
            {"name": "three", "command": ["x"], "pictures": ["a.png", "b.exr"], "ignore": [[1, 2, 3, 4]], "runs": 3}
        ]})",
                                            "dir/s.json");
    ASSERT_TRUE(suite) << suite.error().message;
    ASSERT_EQ(suite->cases.size(), 3u);
    const SuiteCase &one = suite->cases[0], &two = suite->cases[1], &three = suite->cases[2];
    EXPECT_EQ(one.width, 64);
    EXPECT_EQ(one.tolerance.over, 0.5);
    EXPECT_EQ(one.tags, std::vector<std::string>{"slow"});
    EXPECT_EQ(two.tolerance.over, 0.5);
    EXPECT_EQ(two.tolerance.in_window, 3);
    EXPECT_TRUE(two.tags.empty());
    EXPECT_EQ(three.pictures.size(), 2u);
    EXPECT_EQ(three.runs, 3);
    EXPECT_EQ(three.ignored.at(0).height, 4);

    const Placeholders places = placeholders_of(*suite, "/tmp/x y");
    const std::string draw = suite->folder + "/bin/draw";
    EXPECT_EQ(*command_of(one, places), (std::vector<std::string>{draw, "/tmp/x y/out.png"}));
    EXPECT_EQ(*command_of(two, places),
              (std::vector<std::string>{"/bin/sh", "-c", draw + " > '/tmp/x y/out.png'"}));
    const Environment env = *environment_of(*suite, two, places);
    EXPECT_EQ(env.at("A"), std::nullopt);
    EXPECT_EQ(env.at("B"), std::nullopt);
    EXPECT_EQ(env.at("C"), suite->folder);
}

TEST(Suite, SaysWhatIsWrongAndWhere) {
    expect_fault("{", "is no JSON");
    expect_fault("[]", "must be an object");
    expect_fault("{}", "\"cases\" is missing");
    expect_fault(R"({"cases": [], "casses": 1})",
                 "\"casses\" is no key that is known here. Did you mean cases");
    expect_fault(R"({"cases": [{"name": "a"}]})", "case a: \"command\" is missing");
    expect_fault(R"({"cases": [{"command": ["x"]}]})", "cases[0].\"name\" is missing");
    expect_fault(R"({"cases": [{"name": "../a", "command": ["x"]}]})", "is no name");
    expect_fault(R"({"cases": [{"name": "a", "command": "rm -rf x"}]})", "takes \"shell\": true");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "shell": true}]})", "must be one string");
    expect_fault(R"({"cases": [{"name": "a", "command": []}]})", "the first of them the program");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x", 1]}]})", "list of words");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "size": "64"}]})", "WIDTHxHEIGHT");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "size": "64x32x"}]})", "WIDTHxHEIGHT");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "tolerance": {"ovr": 1}}]})",
                 "case a: tolerance.\"ovr\"");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "tolerance": {"over": 2}}]})", "from 0 to 1");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "time_limit": 0}]})", "time_limit");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "ignore": [[1, 2, 3]]}]})", "list of boxes");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "picture": "p.png", "stdout": true}]})",
                 "one of the three");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "pictures": ["p.png", "q/p.exr"]}]})",
                 "names p twice");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"]}, {"name": "a", "command": ["x"]}]})",
                 "another case");
    expect_fault(R"({"programs": {"out": "x"}, "cases": [{"name": "a", "command": ["x"]}]})",
                 "no name for one");
    expect_fault(R"({"env": {"A": 1}, "cases": [{"name": "a", "command": ["x"]}]})",
                 "must be a string, or null");
    expect_fault(R"({"cases": [{"name": "a", "command": ["x"], "parts": [{"name": "ids"}]}]})",
                 "parts[0].\"file\"");
    expect_fault(R"({"key": "../..", "cases": [{"name": "a", "command": ["x"]}]})", "\"key\"");
    EXPECT_EQ(fault(R"({"cases": [{"name": "a", "command": ["x"]}]})"), "");
}

TEST(Suite, IsNoTowerOfBrackets) {
    EXPECT_NE(fault(std::string(100000, '[')), "");
    EXPECT_NE(fault(std::string(50000, '[') + std::string(50000, ']')), "");
}

TEST(Placeholders, OnlyNamesThatAreKnownAreFilled) {
    const Placeholders places{{"out", "a'b c"}, {"dir", "d"}};
    EXPECT_EQ(*filled("{out}/{dir}", places), "a'b c/d");
    EXPECT_EQ(*filled("x {out}", places, true), "x 'a'\\''b c'");
    EXPECT_EQ(*filled("{\"a\": {1}} {} {{out}", places), "{\"a\": {1}} {} {out}");
    const Result<std::string> unknown = filled("{ouut}", places);
    ASSERT_FALSE(unknown);
    EXPECT_NE(unknown.error().message.find("Did you mean out?"), std::string::npos)
        << unknown.error().message;
}

TEST(Filters, ChooseByNamesAndTags) {
    SuiteCase one;
    one.name = "night_rain";
    one.tags = {"weather", "slow"};
    for (const char* fits : {"", "night_rain", "night*", "weather", "day,slow", "-fast"})
        EXPECT_TRUE(is_chosen(one, fits)) << fits;
    for (const char* fits : {"night", "day", "-slow", "night*,-slow", "-*"})
        EXPECT_FALSE(is_chosen(one, fits)) << fits;
}

}  // namespace
}  // namespace flaneur
