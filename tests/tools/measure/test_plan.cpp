#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "assets/files/words.h"
#include "assets/scene.h"
#include "sim/world.h"
#include "tests/sim/small_grounds.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/measure/count.h"
#include "tools/flaneur/measure/csv.h"

namespace flaneur {
namespace {

// An L, clockwise, and the same the other way round.
const std::vector<Vec2> k_bent = {{0, 0}, {6, 0}, {6, 2}, {2, 2}, {2, 6}, {0, 6}};

TEST(Plan, ZonesHoldWhatIsWithinThem) {
    std::vector<Vec2> turned(k_bent.rbegin(), k_bent.rend());
    for (const auto& corners : {k_bent, turned}) {
        EXPECT_DOUBLE_EQ(area_of(corners), 20);
        EXPECT_TRUE(is_within(corners, {5, 1}));
        EXPECT_TRUE(is_within(corners, {1, 5}));
        EXPECT_FALSE(is_within(corners, {4, 4})) << "in the bend";
        EXPECT_FALSE(is_within(corners, {7, 1}));
        EXPECT_FALSE(is_within(corners, {-1, 2})) << "level with corners";
        EXPECT_TRUE(is_within(corners, {1, 2})) << "level with corners";
        EXPECT_FALSE(is_within(corners, {3, 6}));
    }
    // Zones side by side: a place on the edge between is in one of them.
    const std::vector<Vec2> left = {{0, 0}, {3, 1}, {3, 5}, {0, 5}}, right = {{3, 1}, {8, 0}, {8, 6}, {3, 5}};
    for (const float z : {1.0f, 1.5f, 4.999f})
        EXPECT_EQ(is_within(left, {3, z}) + is_within(right, {3, z}), 1) << z;
}

TEST(Plan, OutlinesThatCrossThemselvesAreNone) {
    EXPECT_TRUE(is_simple(k_bent));
    EXPECT_FALSE(is_simple(std::vector<Vec2>{{0, 0}, {4, 4}, {4, 0}, {0, 4}}));
    EXPECT_FALSE(is_simple(std::vector<Vec2>{{0, 0}, {4, 0}, {2, 0}})) << "folds back";
    EXPECT_FALSE(is_simple(std::vector<Vec2>{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}})) << "touches itself";
}

TEST(Plan, TrianglesFillAZone) {
    std::vector<Vec2> comb;
    for (int i = 0; i < 12; ++i)
        comb.push_back({static_cast<float>(i), i % 2 ? 5.0f : 1.0f + 0.1f * static_cast<float>(i)});
    comb.push_back({11, 0}), comb.push_back({0, 0});
    for (std::vector<Vec2> corners : {k_bent, comb}) {
        for (int turn = 0; turn < 2; ++turn) {
            double area = 0;
            const std::vector<uint32_t> triangles = fill_of(corners);
            ASSERT_EQ(triangles.size(), 3 * (corners.size() - 2));
            for (size_t i = 0; i < triangles.size(); i += 3) {
                const Vec2 a = corners[triangles[i]], b = corners[triangles[i + 1]],
                           c = corners[triangles[i + 2]];
                EXPECT_GE(cross(b - a, c - a), 0);
                area += static_cast<double>(cross(b - a, c - a)) / 2;
                EXPECT_TRUE(is_within(corners, (a + b + c) / 3) || cross(b - a, c - a) == 0);
            }
            EXPECT_NEAR(area, area_of(corners), 1e-4);
            std::reverse(corners.begin(), corners.end());
        }
    }
}

TEST(Plan, IsToldAsItIsRead) {
    MeasurePlan plan;
    plan.lines = {parse_count_line("gate:3.25,-4/8,1e1").value(), parse_count_line("0,0/0,0.5").value()};
    plan.zones = {parse_count_zone("0,0/6,0/6,2/2,2/2,6/0.1,6").value()};
    ASSERT_TRUE(name_all(plan));
    EXPECT_EQ(plan.lines[1].name, "L1");
    EXPECT_EQ(plan.zones[0].name, "Z1");
    EXPECT_EQ(told(plan.lines[0]), "gate:3.25,-4/8,10");
    EXPECT_EQ(parse_count_line(told(plan.lines[0])).value(), plan.lines[0]);
    EXPECT_EQ(parse_count_zone(told(plan.zones[0])).value(), plan.zones[0]);
    const Result<MeasurePlan> again = parse_plan(plan_json(plan), "measures.json");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(*again, plan);
}

TEST(Plan, RefusesInASentence) {
    for (const char* text : {"", "3,4", "3,4/5", "3,4/5,x", "3,4/5,6/7,8", "a b:0,0/1,1", ":0,0/1,1",
                             "0,0/nan,1", "0,0/0,0.01", "0,0/1e9,1"})
        EXPECT_FALSE(parse_count_line(text)) << text;
    for (const char* text : {"0,0/1,1", "0,0/4,4/4,0/0,4", "0,0/0.1,0/0,0.1", "0,0/1,0/2,0"})
        EXPECT_FALSE(parse_count_zone(text)) << text;
    for (const char* json : {"", "[]", "{\"lines\": 3}", "{\"lines\": [{\"from\": [0, 0]}]}",
                             "{\"zones\": [{\"corners\": [[0, 0], [1, 0]]}]}", "{\"lines\": \"ab\"}",
                             "{\"lines\": [{\"name\": \"../x\", \"from\": [0, 0], \"to\": [1, 0]}]}",
                             "{\"zones\": [{\"corners\": [[0, 0], [1, \"0\"], [2, 2]]}]}"}) {
        const Result<MeasurePlan> plan = parse_plan(json, "it.json");
        ASSERT_FALSE(plan) << json;
        EXPECT_TRUE(plan.error().message.starts_with("it.json ")) << plan.error().message;
    }
    MeasurePlan twins;
    twins.lines = {parse_count_line("a:0,0/1,1").value(), parse_count_line("a:0,0/2,1").value()};
    EXPECT_FALSE(name_all(twins));
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream lines(csv);
    for (std::string line; std::getline(lines, line);) {
        rows.emplace_back();
        for (std::string_view cell : split(line, ',')) rows.back().emplace_back(cell);
    }
    return rows;
}

TEST(Csv, HoldsWhatWasCounted) {
    LineCount line{
        {"L1", {0, 0}, {0, 4}}, 0, {{1.25, 7, true, 1.5f, {0, 2.5f}}, {3.5, 9, false, 0.75f, {0, 1}}}, {}};
    auto rows = rows_of(line_csv(line));
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[0],
              (std::vector<std::string>{"time_s", "walker", "direction", "speed_m_per_s", "x_m", "z_m"}));
    EXPECT_EQ(rows[1], (std::vector<std::string>{"1.2500", "7", "right", "1.500", "0.000", "2.500"}));
    EXPECT_EQ(rows[2][2], "left");
    ZoneCount zone{{"Z1", k_bent}, 0, 20, {{60, 3, 0.15f, 0.125f, 1.25f}, {120, 0, 0, 0, 0}}};
    rows = rows_of(zone_csv(zone));
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1], (std::vector<std::string>{"1.00", "3", "0.1500", "0.1250", "1.250"}));
    EXPECT_EQ(rows[2][4], "") << "nobody has no speed";
    EXPECT_EQ(csv_path("out/a.csv", "L1"), "out/a-L1.csv");
    EXPECT_EQ(csv_path("a", "Z2"), "a-Z2.csv");
}

// On ground that is high up, by its edge and far off, however long the line is.
TEST(Count, ALineOffAllGroundIsKnown) {
    Ground ground = square(20);
    for (Vec3& corner : ground.vertices) corner.y += 300;
    ground.faces.clear();
    index_ground(ground);
    const auto world = make_world_on(ground, {.capacity = 1});
    ASSERT_TRUE(world) << world.error().message;
    struct Case {
        Vec2 a, b;
        bool is_off;
    };
    const Case cases[] = {{{-3, 0}, {3, 0}, false},        {{9, -9}, {9, -8}, false},
                          {{10.2f, 0}, {10.2f, 4}, false}, {{5, 5}, {5.05f, 5}, false},
                          {{-900, 2}, {900, 2}, false},    {{12, 0}, {12, 4}, true},
                          {{-900, 14}, {900, 14}, true},   {{1e5f, 0}, {1e5f, 9}, true}};
    for (const Case& c : cases)
        EXPECT_EQ(is_off_ground({"L1", c.a, c.b}, **world), c.is_off) << c.a.x << "," << c.a.z;
}

// A city's people, told tick by tick, and the same once more as if by another pace: the counts are the same,
// and every crossing is one.
TEST(Count, OfACityIsTheSameEachTime) {
    Options options;
    options.scene = load_scene("corner").value();
    options.scene.walkers = 80;
    std::string texts[2];
    for (std::string& text : texts) {
        Result<Loaded> loaded = load(options);
        ASSERT_TRUE(loaded) << loaded.error().message;
        World& world = *loaded->world;
        MeasurePlan plan;
        const Vec3 middle = world.crowd.motion.position[world.crowd.count / 2];
        plan.lines.push_back({"L1", {middle.x - 200, middle.z + 1}, {middle.x + 200, middle.z + 2}});
        plan.zones.push_back(
            {"Z1",
             {{middle.x - 30, middle.z - 30}, {middle.x + 30, middle.z - 30}, {middle.x, middle.z + 30}}});
        Counts counts;
        set_plan(counts, plan, world.tick);
        count_people(counts, world);
        std::vector<bool> was_right(world.crowd.count);
        for (uint32_t i = 0; i < world.crowd.count; ++i)
            was_right[i] = world.crowd.motion.position[i].z > middle.z + 1.5f;
        for (int tick = 0; tick < 20 * 60; ++tick) step(world), count_people(counts, world);
        for (const LineCount& line : counts.lines) text.append(line_csv(line));
        for (const ZoneCount& zone : counts.zones) text.append(zone_csv(zone));
        EXPECT_GT(counts.lines[0].crossings.size(), 5u);
        ASSERT_EQ(counts.zones[0].samples.size(), 21u);
    }
    EXPECT_EQ(texts[0], texts[1]);
}

// What `flaneur sim` writes is what the model gives that the window uses.
TEST(Csv, OfSimIsThatOfTheModel) {
    Options options;
    options.command = Command::sim;
    options.scene = load_scene("corner").value();
    options.scene.walkers = 70;
    options.seconds = 15;
    options.plan.lines = {parse_count_line("-40,2/40,2").value()};
    options.plan.zones = {parse_count_zone("yard:-20,-20/20,-20/20,20/-20,20").value()};
    ASSERT_TRUE(name_all(options.plan));
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / ("flaneur-" + std::to_string(getpid()));
    options.measures = (folder / "flow.csv").string();
    const Result<void> done = run_sim(options);
    ASSERT_TRUE(done) << done.error().message;
    Result<Loaded> loaded = load(options);
    ASSERT_TRUE(loaded) << loaded.error().message;
    Counts counts;
    set_plan(counts, options.plan, 0);
    count_people(counts, *loaded->world);
    for (int tick = 0; tick < 15 * 60; ++tick) step(*loaded->world), count_people(counts, *loaded->world);
    auto text_of = [&](const char* name) {
        std::ifstream file(folder / name);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    EXPECT_EQ(text_of("flow-L1.csv"), line_csv(counts.lines[0]));
    EXPECT_EQ(text_of("flow-yard.csv"), zone_csv(counts.zones[0]));
    EXPECT_GT(counts.lines[0].crossings.size(), 3u);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace flaneur
