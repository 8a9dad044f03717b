// Files of people who are sent: what is read of them, and what is refused.
#include <gtest/gtest.h>

#include <fstream>

#include "assets/city.h"
#include "assets/demand/demand_file.h"

namespace flaneur {
namespace {

City map_about(double latitude, double longitude) {
    City city;
    city.on_earth = OnEarth{{latitude, longitude}, 0, 0, 0};
    return city;
}

std::string refusal_of(std::string_view json) {
    const Result<SentPeople> sent = parse_demand(json, City());
    return sent ? "" : sent.error().message;
}

std::string sumo_refusal_of(std::string_view xml) {
    const Result<SentPeople> sent = parse_sumo_persons(xml, City());
    return sent ? "" : sent.error().message;
}

void expect_told(const std::string& told, const char* part) {
    EXPECT_NE(told.find(part), std::string::npos) << told;
}

TEST(DemandFile, SaysWhoGoesWhereAndWhen) {
    const Result<SentPeople> sent = parse_demand(R"({
        "about": "two ways",
        "places": { "station": [[0, 0], [4, 0], [4, 6]], "roof": { "at": [1, 2], "height": 5.5 } },
        "people": [
            { "from": "station", "to": [30, -8.5], "number": 60, "begin": 10, "end": 610, "group": 3 },
            { "from": "roof", "to": "station", "per_minute": 12, "begin": 60, "end": 90, "speed": 1.1 },
            { "from": [1, 1], "to": [2, 2] } ] })",
                                                 City());
    ASSERT_TRUE(sent) << sent.error().message;
    ASSERT_EQ(sent->sendings.size(), 3u);
    const Sending &a = sent->sendings[0], &b = sent->sendings[1], &c = sent->sendings[2];
    EXPECT_EQ(a.from.corners, (std::vector<Vec2>{{0, 0}, {4, 0}, {4, 6}}));
    EXPECT_EQ(a.to.corners, (std::vector<Vec2>{{30, -8.5f}}));
    EXPECT_EQ(a.people, 60u);
    EXPECT_EQ(a.group, 3u);
    EXPECT_EQ(a.begin, 10);
    EXPECT_EQ(a.end, 610);
    EXPECT_EQ(b.from.height, 5.5f);
    EXPECT_EQ(b.people, 6u);
    EXPECT_EQ(b.speed, 1.1f);
    EXPECT_EQ(c.people, 1u);
    EXPECT_EQ(c.begin, c.end);
    ASSERT_EQ(sent->notes.size(), 1u);
    expect_told(sent->notes[0], "groups do not walk together yet");
}

TEST(DemandFile, DegreesAreOfMaps) {
    constexpr std::string_view k_text = R"({ "people": [ { "from": "52.5, 13.4", "to": "52.501,13.4" } ] })";
    expect_told(refusal_of(R"({ "people": [ { "from": "52.5,13.4", "to": [0, 0] } ] })"), "only a map");
    expect_told(refusal_of(k_text), "LAT,LON");  // of a space before a number
    const Result<SentPeople> sent = parse_demand(
        R"({ "people": [ { "from": "52.5,13.4", "to": "52.501,13.402" } ] })", map_about(52.5, 13.4));
    ASSERT_TRUE(sent) << sent.error().message;
    const Vec2 from = sent->sendings[0].from.corners[0], to = sent->sendings[0].to.corners[0];
    EXPECT_LT(length(from), 0.01f);
    EXPECT_NEAR(to.z, -111.3f, 0.3f) << "to the north";
    EXPECT_NEAR(to.x, 135.8f, 0.3f);
}

TEST(DemandFile, RefusesWithASentence) {
    expect_told(refusal_of("{\n  x"), "is not JSON in line 2, column 3");
    expect_told(refusal_of("[]"), "sends nobody");
    expect_told(refusal_of(R"({ "people": [], "persons": 3 })"), "persons, which is not known");
    expect_told(refusal_of(R"({ "people": [] })"), "sends nobody");
    expect_told(refusal_of("{ \"people\": [],\n\"people\": [] }"),
                "in line 2, column 1 the key \"people\" twice");
    expect_told(refusal_of("{\n\"people\": [\n3 ] }"), "in line 3 people 1 that is no object");
    expect_told(refusal_of(R"({ "people": [ { "from": [0, 0] } ] })"), R"(without "to")");
    auto with = [](const std::string& more) {
        return refusal_of(R"({ "people": [ { "from": [0, 0], "to": [1, 1], )" + more + " } ] }");
    };
    EXPECT_EQ(with(R"("number": 2)"), "");
    expect_told(with(R"("number": 0)"), R"("number" is not a number from 1)");
    expect_told(with(R"("number": 1.5)"), "not whole");
    expect_told(with(R"("number": 2, "per_minute": 3, "end": 5)"), "both");
    expect_told(with(R"("per_minute": 3)"), R"(no "end")");
    expect_told(with(R"("begin": 9, "end": 5)"), R"("end" is before)");
    expect_told(with(R"("speed": 9)"), R"("speed" is not a number from 0.3 to 2)");
    expect_told(with(R"("group": 0)"), R"("group")");
    expect_told(with("\n\"when\": 0"), "in line 2 people 1 with when, which is not known");
    expect_told(with("\n\n\"per_minute\": 0, \"end\": 9"), "in line 3 people 1 whose \"per_minute\" is not");
    expect_told(with(R"("per_minute": 0.01, "end": 9)"), "who are nobody");
    expect_told(with(R"("name": 3)"), R"("name" is no text)");
    expect_told(refusal_of(R"({ "people": [ { "from": [[0, 0], [1, 1]], "to": [1, 1] } ] })"),
                "three corners");
    auto from = [](const std::string& place) {
        return refusal_of(R"({ "places": { "here": [4, 4] }, "people": [ { "to": "here", "from": )" + place +
                          " } ] }");
    };
    EXPECT_EQ(from(R"({ "at": "here", "height": 3 })"), "");
    expect_told(from(R"("nowhere")"), R"(neither "LAT,LON" nor the name of one of "places": here)");
    expect_told(from(R"({ "at": "nowhere" })"), R"(neither "LAT,LON" nor the name of one of "places": here)");
    expect_told(from(R"(["here", "here", "here"])"), "no corner of an area");
    expect_told(from("[1e9, 0]"), "more than 1000000 m from the middle");
    expect_told(from(R"("95,13.4")"), "nowhere on Earth");
    expect_told(from(R"({ "height": 3 })"), R"(an object without "at")");
    expect_told(from("[[1, 1], [1, 1], [1, 1]]"), "goes round no ground");
    EXPECT_EQ(from("[[1, 1], [2, 1], [2, 2]]"), "");
    expect_told(from("true"), "neither a place nor three corners");
    expect_told(refusal_of(R"({ "places": { "a": { "at": "b" }, "b": [0, 0] }, "people": [] })"),
                R"(nor the name of one of "places" above it)");
    std::string corners = "[[0, 0]";
    for (int i = 0; i < 1000; ++i) corners += ", [" + std::to_string(i) + ", 1]";
    expect_told(from(corners + "]"), "an area of 1001 corners, and 1000 are the most");
    expect_told(refusal_of("{ \"places\": {\n\"a\": { \"at\": [0, 0], \"high\": 2 } }, \"people\": [] }"),
                "in line 2 a place a that is one with high");
}

// Else a small file would need very much memory.
TEST(DemandFile, RefusesVeryManyCornersOfAreas) {
    std::string text = R"({ "places": { "here": [[0, 0])";
    for (int i = 0; i < 999; ++i) text += ", [" + std::to_string(i) + ", 1]";
    text += R"(] }, "people": [ { "from": "here", "to": "here" })";
    for (int i = 0; i < 500; ++i) text += R"(, { "from": "here", "to": "here" })";
    expect_told(refusal_of(text + "] }"), "people 501 with whom the areas");
}

TEST(DemandFile, NamesWhomItSends) {
    const Result<SentPeople> sent = parse_demand(
        R"({ "people": [ { "name": "early shift", "from": [0, 0], "to": [1, 1] },
                         { "from": [0, 0], "to": [1, 1] } ] })",
        City());
    ASSERT_TRUE(sent) << sent.error().message;
    EXPECT_EQ(sent->names, (std::vector<std::string>{"early shift", "people 2"}));
}

TEST(DemandFile, PersonsOfSumoThatHavePlaces) {
    const Result<SentPeople> sent = parse_sumo_persons(R"(<?xml version="1.0"?>
        <routes>
            <person id="a" depart="12.50"><walk fromXY="-20,4" toXY="30,-8" speed="1.2"/></person>
            <person id="b" depart="0:01:30"><personTrip fromXY="1,2" toXY="3,4"/><ride lines="x"/></person>
            <personFlow id="c" begin="10" end="70" perHour="600"><walk fromXY="0,0" toXY="5,5"/></personFlow>
            <personFlow id="d" begin="0" end="60" number="7"><walk fromXY="0,0" toXY="5,5"/></personFlow>
            <personFlow id="e" begin="0" end="60" period="20"><walk fromXY="0,0" toXY="5,5"/></personFlow>
            <person id="f" depart="0"/>
            <vehicle id="v" depart="0"/>
        </routes>)",
                                                       City());
    ASSERT_TRUE(sent) << sent.error().message;
    ASSERT_EQ(sent->sendings.size(), 5u);
    const std::vector<Sending>& s = sent->sendings;
    EXPECT_EQ(s[0].from.corners, (std::vector<Vec2>{{-20, -4}})) << "y is to the north, z to the south";
    EXPECT_EQ(s[0].to.corners, (std::vector<Vec2>{{30, 8}}));
    EXPECT_EQ(s[0].begin, 12.5f);
    EXPECT_EQ(s[0].speed, 1.2f);
    EXPECT_EQ(s[1].begin, 90);
    EXPECT_EQ(s[2].people, 10u);
    EXPECT_EQ(s[2].end, 70);
    EXPECT_EQ(s[3].people, 7u);
    EXPECT_EQ(s[4].people, 3u);
    EXPECT_EQ(sent->names[1], "person b");
    EXPECT_EQ(sent->names[4], "personFlow e");
    ASSERT_EQ(sent->notes.size(), 2u);
    expect_told(sent->notes[0], "1 rides and stops");
    expect_told(sent->notes[1], "1 persons and flows have no walk");
}

TEST(DemandFile, PersonsOfSumoThatAreRefused) {
    auto person = [](const std::string& inner) {
        return sumo_refusal_of("<routes>\n<person depart=\"0\">" + inner + "</person></routes>");
    };
    EXPECT_EQ(person(R"(<walk fromXY="0,0" toXY="5,5"/>)"), "");
    expect_told(person(R"(<walk edges="a b c"/>)"), "in line 2 a walk without \"fromXY\"");
    expect_told(person(R"(<walk from="a" to="b"/>)"), "needs SUMO's net");
    expect_told(person(R"(<walk fromXY="0,0" toXY="5"/>)"), "is no place");
    expect_told(person(R"(<walk fromLonLat="13.4,52.5" toXY="5,5"/>)"), "only a map");
    expect_told(person(R"(<walk fromXY="0,0" toXY="5,5"/><walk fromXY="5,5" toXY="9,5"/>)"),
                "more than one walk");
    expect_told(sumo_refusal_of("<routes><person/></routes>"), "without \"depart\"");
    expect_told(sumo_refusal_of(R"(<routes><person depart="triggered"/></routes>)"), "no time");
    expect_told(sumo_refusal_of("<routes></routes>"), "sends nobody");
    expect_told(sumo_refusal_of("<osm></osm>"), "no routes of SUMO");
    expect_told(sumo_refusal_of("<routes>"), "is no XML");
    expect_told(sumo_refusal_of(R"(<!DOCTYPE a [<!ENTITY b "c">]><routes/>)"), "entity");
    expect_told(sumo_refusal_of(R"(<routes><personFlow begin="0" end="9"/></routes>)"), "sends nobody");
    expect_told(sumo_refusal_of(R"(<routes><personFlow begin="0" end="9" number="3" period="2"/></routes>)"),
                R"("number" beside a rate)");
    const Result<SentPeople> paced = parse_sumo_persons(
        R"(<routes><personFlow begin="5" number="3" period="20"><walk fromXY="0,0" toXY="5,5"/></personFlow></routes>)",
        City());
    ASSERT_TRUE(paced) << paced.error().message;
    EXPECT_EQ(paced->sendings[0].people, 3u);
    EXPECT_EQ(paced->sendings[0].end, 65);
}

TEST(DemandFile, ThoseOfTheDocumentsAreRead) {
    for (const char* name : {"morning.json", "persons.rou.xml"}) {
        const Result<SentPeople> sent =
            load_demand(std::string(FLANEUR_SOURCE_DIR "/examples/demand/") + name, City());
        ASSERT_TRUE(sent) << sent.error().message;
        EXPECT_GT(sent->sendings.size(), 1u);
    }
    const Result<SentPeople> none = load_demand("/nowhere/demand.json", City());
    ASSERT_FALSE(none);
    expect_told(none.error().message, "The demand /nowhere/demand.json ");
}

}  // namespace
}  // namespace flaneur
