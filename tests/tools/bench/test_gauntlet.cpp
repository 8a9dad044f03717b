#include <gtest/gtest.h>

#include "tests/folder.h"
#include "tools/flaneur/bench/gauntlet/gauntlet.h"

namespace flaneur {
namespace {

GauntletRun some_run(const std::string& machine, double faster) {
    GauntletRun run;
    run.machine = machine, run.device = "a <device>", run.version = "1.2", run.seconds = 61;
    run.notes = {"nothing & nobody was left out"};
    run.scores = {{"sim", "tick", 1000, 2 / faster, "ms"},
                  {"sim", "decision", 1000, 300 / faster, "ns"},
                  {"frame", "street", 500, 40 / faster, "ms"},
                  {"frame", "street, all threads", 500, 55 / faster, "ms"},
                  {"pose", "core, avx2", 0, 90 / faster, "ns"},
                  {"gait", "knee.rmse", 0, 6.5 / faster, "", {}, 5},
                  {"gait", "toe_out.deg", 0, 6, "", 2, 12}};
    return run;
}

TEST(GauntletRun, ComesBackFromItsFile) {
    const GauntletRun run = some_run("here", 1);
    Result<GauntletRun> back = read_run(run_json(run));
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->machine, "here");
    EXPECT_EQ(back->notes, run.notes);
    EXPECT_EQ(back->is_quick, run.is_quick);
    ASSERT_EQ(back->scores.size(), run.scores.size());
    EXPECT_EQ(back->scores[2].size, 500);
    EXPECT_EQ(back->scores[2].value, 40);
    ASSERT_TRUE(find_score(*back, "pose", "core, avx2", 0));
    EXPECT_EQ(back->scores.back().low, 2);
    EXPECT_EQ(back->scores.back().high, 12);
    EXPECT_EQ(back->scores[0].low, std::nullopt);
    EXPECT_FALSE(find_score(*back, "sim", "tick", 999));
}

TEST(GauntletRun, RefusesWhatIsNone) {
    for (const char* text :
         {"", "{", "[]", "{\"gauntlet\": 1}", "{\"gauntlet\": \"a\"}", "{\"gauntlet\": 2}"})
        EXPECT_FALSE(read_run(text)) << text;
}

TEST(GauntletRun, OthersAreThoseOfTheSameKind) {
    const TestFolder folder;
    GauntletRun quick = some_run("quick", 1);
    quick.is_quick = true;
    folder.write("b.json", run_json(some_run("b", 1)));
    folder.write("a.json", run_json(some_run("a", 1)));
    folder.write("c.json", run_json(quick));
    folder.write("d.json", "no");
    folder.write("e.txt", "no");
    std::vector<std::string> notes;
    Result<std::vector<GauntletRun>> others = read_others(folder.path.string(), false, notes);
    ASSERT_TRUE(others);
    ASSERT_EQ(others->size(), 2u);
    EXPECT_EQ((*others)[0].machine, "a");
    EXPECT_EQ(notes.size(), 2u);
    EXPECT_FALSE(read_others(folder / "nowhere", false, notes));
}

TEST(GauntletHtml, ShowsAllMachinesAndEscapesThem) {
    const std::vector<GauntletRun> others = {some_run("<b>there</b>", 2)};
    const std::string page = gauntlet_html(some_run("here", 1), others);
    EXPECT_EQ(page.find("<b>there"), std::string::npos);
    EXPECT_NE(page.find("&lt;b&gt;there"), std::string::npos);
    EXPECT_NE(page.find(">20<"), std::string::npos);  // frames of the other
    EXPECT_EQ(page.find("http://", page.find("</svg>")), page.find("http://www.w3.org", page.find("</svg>")));
    EXPECT_EQ(page.find("src="), std::string::npos);  // it stands on its own
}

TEST(GoalsMarkdown, TellsMetMissedAndNotMeasured) {
    const std::string text = goals_markdown(some_run("here", 1));
    EXPECT_NE(text.find("| neighbours found and a velocity chosen, 1,000 walkers | 350 | 300 |  | met |"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("| a street, 500 walkers in the city | 30 | 40 | 55 | missed by 33 % |"),
              std::string::npos);
    EXPECT_NE(text.find("| 10,000 walkers | 350 |  |  | not measured |"), std::string::npos);
    EXPECT_NE(text.find("| knee.rmse | up to 5 | 6.5 | missed |"), std::string::npos);
    EXPECT_NE(text.find("| toe_out.deg | 2 .. 12 | 6 | met |"), std::string::npos);
    EXPECT_NE(text.find("Shading of the city"), std::string::npos);            // why
    EXPECT_EQ(text.find("A draw is made for each level"), std::string::npos);  // is not asked
}

TEST(Goals, HaveReasons) {
    for (const Goal& goal : all_goals()) {
        EXPECT_GT(goal.most, 0) << goal.what;
        EXPECT_TRUE(std::string(goal.why).ends_with('.')) << goal.what;
    }
}

}  // namespace
}  // namespace flaneur
