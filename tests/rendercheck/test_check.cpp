// The program from outside: exit codes, references, and suites that mean no good.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/rendercheck/drawing.h"
#include "tools/rendercheck/process/process.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct SuiteTest : testing::Test {
    const TestFolder folder;
    std::string out;  // what was printed last
    Json suite{{"key", "test"}, {"cases", Json::array()}};

    SuiteTest() { fs::create_directories(folder / "tmp"); }

    int run(const std::vector<std::string>& words) {
        ProcessPlan plan;
        plan.words = {RENDERCHECK};
        plan.words.insert(plan.words.end(), words.begin(), words.end());
        plan.folder = folder.path.string();
        plan.env = {{"TMPDIR", folder / "tmp"}};
        plan.stdout_file = folder / "out.txt", plan.stderr_file = folder / "err.txt";
        const ProcessEnd end = *run_process(plan);
        out = text("out.txt") + text("err.txt");
        EXPECT_EQ(end.how, HowEnded::exited) << out;
        EXPECT_EQ(end.left_over, 0) << out;
        EXPECT_TRUE(fs::is_empty(folder / "tmp")) << "something was left in the temporary folder";
        return end.code;
    }
    int check(std::vector<std::string> words = {}) {
        folder.write("suite.json", suite.dump());
        words.insert(words.begin(), {"run", "suite.json"});
        return run(words);
    }
    std::string text(const std::string& name) const {
        std::ifstream file(folder / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    void draw(const std::string& name, const CheckedPicture& picture) const {
        folder.write(name, png_text(picture));
    }
    Json& add(const std::string& name, const std::string& line) {
        suite["cases"].push_back({{"name", name}, {"command", line}, {"shell", true}, {"time_limit", 20}});
        return suite["cases"].back();
    }
    bool says(const std::string& words) const { return out.find(words) != std::string::npos; }
};

TEST_F(SuiteTest, PassesFailsAndIsBlessed) {
    draw("a.png", street());
    draw("b.png", street(11));
    add("one", "cp a.png {out}");
    EXPECT_EQ(check(), 2) << out;
    EXPECT_TRUE(says("NO REFERENCE one")) << out;
    EXPECT_TRUE(says("--filter one --bless")) << out;
    EXPECT_EQ(check({"--bless"}), 0) << out;
    EXPECT_TRUE(fs::exists(folder / "golden/test/one.png"));
    EXPECT_EQ(check(), 0) << out;
    suite["cases"][0]["command"] = "cp b.png {out}";
    EXPECT_EQ(check(), 1) << out;
    EXPECT_TRUE(says("40 pixels differ by more than 2/255 within 16x16")) << out;
    EXPECT_TRUE(says("4x10 at 240,100 (40)")) << out;
    EXPECT_EQ(check({"--bless"}), 0) << out;
    EXPECT_EQ(check(), 0) << out;
}

TEST_F(SuiteTest, BlessTouchesOnlyWhatFails) {
    draw("a.png", street());
    add("one", "cp a.png {out}");
    add("two", "cp a.png {out}");
    ASSERT_EQ(check({"--bless"}), 0) << out;
    const auto before = fs::last_write_time(folder / "golden/test/one.png");
    CheckedPicture noisy = street();
    pixel(noisy, 3, 3)[0] ^= 1;
    draw("noisy.png", noisy);
    draw("b.png", street(3));
    suite["cases"][0]["command"] = "cp noisy.png {out}";  // within the tolerance
    suite["cases"][1]["command"] = "cp b.png {out}";
    EXPECT_EQ(check({"--bless"}), 0) << out;
    EXPECT_TRUE(says("Blessed 1 pictures")) << out;
    EXPECT_EQ(fs::last_write_time(folder / "golden/test/one.png"), before);
}

TEST_F(SuiteTest, ReferencesOfAnotherDeviceAreNotOurs) {
    draw("a.png", street());
    add("one", "cp a.png {out}");
    ASSERT_EQ(check({"--bless"}), 0) << out;
    suite["key"] = "other";
    EXPECT_EQ(check(), 2) << out;
    EXPECT_TRUE(says("There are references of test, and none of this device")) << out;
    EXPECT_EQ(check({"--bless"}), 3) << out;
    EXPECT_FALSE(fs::exists(folder / "golden/other"));
    EXPECT_EQ(check({"--references", "test"}), 0) << out;
    EXPECT_EQ(check({"--bless", "--force"}), 0) << out;
    EXPECT_TRUE(fs::exists(folder / "golden/other/one.png"));
}

TEST_F(SuiteTest, WhatAlternatesIsFlakyAndNeverPasses) {
    draw("a.png", street());
    draw("b.png", street(11));
    add("flicker",
        "if [ -e {suite}/odd ]; then rm {suite}/odd; cp b.png {out}; else touch {suite}/odd; cp a.png {out}; "
        "fi");
    suite["cases"][0]["runs"] = 2;
    EXPECT_EQ(check({"--bless"}), 1) << out;
    EXPECT_TRUE(says("FLAKY flicker")) << out;
    EXPECT_FALSE(fs::exists(folder / "golden/test/flicker.png"));
    // Run once, it differs from its reference now and then, and is run again.
    suite["cases"][0]["runs"] = 1;
    fs::remove(folder / "odd");
    ASSERT_EQ(check({"--bless"}), 0) << out;
    ASSERT_TRUE(fs::exists(folder / "odd"));
    EXPECT_EQ(check(), 1) << out;
    EXPECT_TRUE(says("FLAKY flicker")) << out;
    EXPECT_TRUE(says("It differs from itself")) << out;
    EXPECT_EQ(check({"--runs", "3"}), 1) << out;
}

TEST_F(SuiteTest, SeveralPicturesAndStdout) {
    draw("a.png", street());
    draw("b.png", street(11));
    add("film", "cp a.png {dir}/f1.png; cp b.png {dir}/f2.png")["pictures"] = {"f1.png", "f2.png"};
    add("printed", "cat a.png")["stdout"] = true;
    ASSERT_EQ(check({"--bless"}), 0) << out;
    EXPECT_TRUE(fs::exists(folder / "golden/test/film/f2.png"));
    EXPECT_EQ(check({"--jobs", "2"}), 0) << out;
    suite["cases"][0]["command"] = "cp a.png {dir}/f1.png; cp a.png {dir}/f2.png";
    EXPECT_EQ(check(), 1) << out;
    EXPECT_TRUE(says("f2: ")) << out;
    suite["cases"][0]["command"] = "cp a.png {dir}/f1.png";
    EXPECT_EQ(check(), 4) << out;
    EXPECT_TRUE(says("wrote no f2.png")) << out;
}

TEST_F(SuiteTest, ReportsAreWritten) {
    draw("a.png", street());
    draw("b.png", street(11));
    add("good", "cp a.png {out}");
    add("bad", "cp a.png {out}");
    ASSERT_EQ(check({"--bless"}), 0) << out;
    suite["cases"][1]["command"] = "cp b.png {out}; echo '<b>' >&2";
    EXPECT_EQ(check({"--html", "r/page.html", "--junit", "r/junit.xml", "--github", "--keep", "kept"}), 1)
        << out;
    EXPECT_TRUE(says("::error title=Render check bad::")) << out;
    EXPECT_TRUE(says("1 of 2 cases pass")) << out;
    const std::string page = text("r/page.html"), junit = text("r/junit.xml");
    for (const char* alt : {"\"new\"", "\"reference\"", "\"difference\"", "\"flip\""})
        EXPECT_NE(page.find(std::string("alt=") + alt), std::string::npos) << alt;
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    EXPECT_NE(page.find("&lt;b&gt;"), std::string::npos);
    EXPECT_NE(junit.find("tests=\"2\" failures=\"1\" errors=\"0\""), std::string::npos) << junit;
    EXPECT_TRUE(fs::exists(folder / "kept/bad/run1/files/out.png"));
}

TEST_F(SuiteTest, PartsSayWhichPassAndWhatIsThere) {
    draw("a.png", street());
    draw("b.png", street(11));
    CheckedPicture ids = street(0);
    paint(ids, {0, 0, 320, 180}, 1, 0, 0);
    CheckedPicture fewer = ids;
    paint(ids, {240, 100, 4, 10}, 2, 0, 0);
    draw("ids_a.png", ids);
    draw("ids_b.png", fewer);
    folder.write(
        "legend.json",
        R"({"things": [{"id": 1, "kind": "ground", "number": 7, "what": "road"}, {"id": 2, "kind": "walker", "number": 57}]})");
    add("one",
        "cp a.png {out}; cp a.png {dir}/depth.png; cp ids_a.png {dir}/ids.png; cp legend.json "
        "{dir}/ids.json");
    suite["cases"][0]["parts"] = {{{"name", "depth"}, {"file", "depth.png"}, {"keep", "hash"}},
                                  {{"name", "ids"}, {"file", "ids.png"}, {"legend", "ids.json"}}};
    ASSERT_EQ(check({"--bless"}), 0) << out;
    EXPECT_TRUE(fs::exists(folder / "golden/test/one.parts/depth.hash"));
    fs::remove(folder / "golden/test/one.parts/depth.hash");
    ASSERT_EQ(check({"--bless"}), 0) << out;
    EXPECT_TRUE(says("Blessed 0 pictures")) << out;
    EXPECT_TRUE(fs::exists(folder / "golden/test/one.parts/depth.hash"));
    EXPECT_EQ(check(), 0) << out;
    suite["cases"][0]["command"] =
        "cp b.png {out}; cp a.png {dir}/depth.png; cp ids_b.png {dir}/ids.png; cp legend.json {dir}/ids.json";
    EXPECT_EQ(check(), 1) << out;
    EXPECT_TRUE(says("The first pass that differs is ids: depth is the same, ids differs.")) << out;
    EXPECT_TRUE(says("Gone from the picture: walker 57 (40).")) << out;
    EXPECT_TRUE(says("At 240,100: road (40), walker 57 before (40).")) << out;
}

TEST_F(SuiteTest, ValidationMessagesFail) {
    draw("a.png", street());
    add("good", "cp a.png {out}; echo 'VUID-vkCmdDraw-None-02700 and so on' >&2");
    EXPECT_EQ(check({"--bless"}), 4) << out;
    EXPECT_TRUE(says("The validation layer says: VUID-vkCmdDraw")) << out;
}

TEST_F(SuiteTest, RequiresADevice) {
    draw("a.png", street());
    add("one", "cp a.png {out}");
    suite["device"] = "Voodoo";
    EXPECT_EQ(check(), 3) << out;
    suite.erase("device");
    suite["env"] = {{"VK_ICD_FILENAMES", "/none"}, {"VK_DRIVER_FILES", "/none"}};
    EXPECT_EQ(check({"--require-device", "llvmpipe"}), 3) << out;
    // Without Vulkan, a key of one's own serves.
    EXPECT_EQ(check({"--bless"}), 0) << out;
    suite.erase("key");
    EXPECT_EQ(check(), 3) << out;
    EXPECT_TRUE(says("give the suite a \"key\" of its own")) << out;
}

TEST_F(SuiteTest, UsageIsRefused) {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{},
                                               {"runn", "x"},
                                               {"run"},
                                               {"run", "none.json"},
                                               {"run", "x.json", "--blss"},
                                               {"compare", "a.png"},
                                               {"explain", "x.json"}})
        EXPECT_EQ(run(words), 5) << out;
    run({"runn", "x.json"});
    EXPECT_TRUE(says("There is no command runn. Did you mean run?")) << out;
    run({"run", "x.json", "--blss"});
    EXPECT_TRUE(says("Did you mean --bless?")) << out;
    add("one", "true {ouut}");
    EXPECT_EQ(check(), 5) << out;
    EXPECT_TRUE(says("Did you mean out?")) << out;
    suite["cases"][0]["command"] = "true";
    suite["cases"][0]["picture"] = "{dirr}/a.png";
    EXPECT_EQ(check(), 5) << out;
    EXPECT_TRUE(says("Did you mean dir?")) << out;
    suite["cases"][0].erase("picture");
    EXPECT_EQ(check({"--filter", "oen"}), 5) << out;
    EXPECT_TRUE(says("Did you mean one?")) << out;
    EXPECT_EQ(check({"--program", "x=y"}), 5) << out;
}

TEST_F(SuiteTest, InitWritesASuiteThatRuns) {
    draw("a.png", street());
    EXPECT_EQ(run({"init", "first.json", "--", "cp", "a.png", "b.png"}), 0) << out;
    EXPECT_EQ(run({"init", "first.json", "--", "cp", "a.png", "b.png"}), 5) << "it is there already";
    Json first = Json::parse(text("first.json"));
    first["key"] = "test";
    EXPECT_EQ(first["cases"][0]["command"], Json({"cp", "a.png", "{out}"}));
    folder.write("first.json", first.dump());
    EXPECT_EQ(run({"run", "first.json", "--bless"}), 0) << out;
    EXPECT_EQ(run({"run", "first.json"}), 0) << out;
    EXPECT_EQ(run({"explain", "first.json", "first"}), 0) << out;
    EXPECT_TRUE(says("which is there")) << out;
    EXPECT_EQ(run({"init", "odd.json", "--", "draw", "{x}", "a.png"}), 0) << out;
    EXPECT_EQ(Json::parse(text("odd.json"))["cases"][0]["command"], Json({"draw", "{{x}", "{out}"}));
    // Asked, it may print its picture.
    suite["cases"].push_back(
        {{"name", "asks"},
         {"shell", true},
         {"stdout", true},
         {"command",
          "printf 'cat a.png\\n-\\n' | " RENDERCHECK " init {dir}/asked.json >&2; "
          "grep -q '\"a.png\"' {dir}/asked.json && grep -q stdout {dir}/asked.json && cat a.png"}});
    EXPECT_EQ(check({"--bless"}), 0) << out;
}

TEST_F(SuiteTest, ComparesTwo) {
    draw("a.png", street());
    draw("b.png", street(11));
    EXPECT_EQ(run({"compare", "a.png", "a.png"}), 0);
    EXPECT_EQ(run({"compare", "a.png", "b.png", "--html", "c.html"}), 1);
    EXPECT_EQ(run({"compare", "a.png", "none.png"}), 2);
    EXPECT_EQ(run({"compare", "a.png", "b.png", "--json"}), 1);
    const Json told = Json::parse(out);
    EXPECT_EQ(told["differing"], 40);
    EXPECT_EQ(told["boxes"][0]["box"], Json({240, 100, 4, 10}));
    EXPECT_EQ(run({"compare", "a.png", "b.png", "--in-window", "40", "--over", "0.001"}), 0) << out;
}

// What means no good.

TEST_F(SuiteTest, PathsWithSpacesAndQuotes) {
    const std::string odd = "it's \"odd\" $(touch pwned); `x` {a}\n";
    const std::string dir = folder / odd;
    fs::create_directories(dir);
    std::ofstream(dir + "/a.png", std::ios::binary) << png_text(street());
    suite["cases"].push_back({{"name", "words"}, {"command", {"cp", "a.png", "{out}"}}});
    suite["cases"].push_back({{"name", "line"}, {"command", "cp {suite}/a.png {out}"}, {"shell", true}});
    std::ofstream(dir + "/s.json") << suite.dump();
    EXPECT_EQ(run({"run", odd + "/s.json", "--bless"}), 0) << out;
    EXPECT_EQ(run({"run", odd + "/s.json", "--html", odd + "/r.html"}), 0) << out;
    EXPECT_TRUE(fs::exists(dir + "/golden/test/line.png"));
    for (const auto& entry : fs::recursive_directory_iterator(folder.path))
        EXPECT_NE(entry.path().filename(), "pwned");
}

TEST_F(SuiteTest, ThatNeverEnds) {
    add("endless", "echo here >&2; trap '' TERM; while :; do sleep 0.05; done")["time_limit"] = 0.3;
    EXPECT_EQ(check(), 4) << out;
    EXPECT_TRUE(says("did not end within 0.3 s")) << out;
    EXPECT_TRUE(says("here")) << out;
}

TEST_F(SuiteTest, ThatWritesNothingOrNoPicture) {
    add("nothing", "true");
    add("text", "echo no picture > {out}");
    add("empty", ": > {out}");
    add("folder", "mkdir {out}");
    add("pipe", "mkfifo {out}");
    add("fails", "exit 7");
    add("crashes", "kill -ABRT $$");
    suite["cases"].push_back({{"name", "unknown"}, {"command", {"no-such-program"}}});
    EXPECT_EQ(check({"--jobs", "4"}), 4) << out;
    for (const char* line : {"wrote no out.png", "neither a PNG", "is empty", "no regular file",
                             "ended with 7", "signal 6", "cannot be started", "0 of 8 cases pass; 8 failed"})
        EXPECT_TRUE(says(line)) << line << "\n" << out;
    EXPECT_EQ(check({"--bless"}), 4) << out;
    EXPECT_FALSE(fs::exists(folder / "golden"));
}

// Reports are read by programs that end at a byte that is no text.
TEST_F(SuiteTest, ThatPrintsWhatIsNoText) {
    add("latin", "printf '\\377 caf\\351\\n'; exit 1");
    add("long", "yes 'é' | head -n 9000 | tr -d '\\n'; printf x; exit 1");
    EXPECT_EQ(check({"--junit", folder / "r.xml", "--html", folder / "r.html"}), 4) << out;
    for (const char* report : {"r.xml", "r.html"}) {
        const std::string told = text(report);
        EXPECT_NO_THROW((void)Json(told).dump()) << report;
        EXPECT_NE(told.find("caf\xef\xbf\xbd"), std::string::npos) << report;
    }
    EXPECT_NO_THROW((void)Json(out).dump());
}

TEST_F(SuiteTest, ThatNamesAMaskThatIsNotThere) {
    draw("a.png", street());
    add("masked", "cp a.png {out}")["mask"] = "none.png";
    EXPECT_EQ(check({"--bless"}), 5) << out;
    EXPECT_TRUE(says("\"mask\" is none.png, which is no file beside the suite")) << out;
}

TEST_F(SuiteTest, ThatWritesAHugeHeader) {
    std::string png = png_text(street(0, 8, 8));
    png.replace(16, 8, std::string("\0\0\x75\x30\0\0\x75\x30", 8));
    folder.write("huge.png", png);  // its checksum is wrong too
    add("huge", "cp huge.png {out}");
    EXPECT_EQ(check(), 4) << out;
    folder.write("sized.png", png_text(street(0, 8, 8)));
    suite["cases"] = Json::array();
    add("sized", "cp sized.png {out}")["size"] = "9x8";
    EXPECT_EQ(check(), 4) << out;
    EXPECT_TRUE(says("has 8x8 pixels, and the suite says 9x8")) << out;
}

TEST_F(SuiteTest, ThatForks) {
    draw("a.png", street());
    add("forks",
        "setsid sh -c 'echo $$ > {suite}/pid; sleep 1000' & cp a.png {out}; while [ ! -s {suite}/pid ]; do "
        "sleep 0.02; done");
    EXPECT_EQ(check({"--bless"}), 0) << out;
    EXPECT_FALSE(fs::exists("/proc/" + std::to_string(std::stol(text("pid")))));
}

TEST_F(SuiteTest, ThatFillsTheDisk) {
    add("fills", "cat /dev/zero > {out}")["disk_limit"] = 1;
    add("in_small_files",
        "n=0; while :; do head -c 400000 /dev/zero > {dir}/$n; n=$(((n + 1) % 30)); sleep 0.01; done")
        ["disk_limit"] = 1;
    add("talks", "yes; exit 1")["disk_limit"] = 1;
    // Quicker than anybody looks; and those who go on after a child's end.
    draw("a.png", street());
    add("at_once", "head -c 3000000 /dev/zero > {dir}/t; cp a.png {out}")["disk_limit"] = 1;
    add("in_pieces",
        "for n in 1 2 3 4; do head -c 900000 /dev/zero > {dir}/$n; done; cp a.png {out}")["disk_limit"] = 1;
    add("by_a_child", "head -c 3000000 /dev/zero > {dir}/t; exit $?")["disk_limit"] = 1;
    EXPECT_EQ(check(), 4) << out;
    EXPECT_TRUE(says("wrote more than the 1 MiB that it may")) << out;
    EXPECT_FALSE(says("ended with")) << out;
    EXPECT_TRUE(says("0 of 6 cases pass; 6 failed")) << out;
}

// Interrupted: everything ends, nothing is kept.
TEST_F(SuiteTest, ThatIsInterrupted) {
    add("waits", "echo $$ > {suite}/pid; sleep 1000")["time_limit"] = 1000;
    folder.write("suite.json", suite.dump());
    ProcessPlan plan;
    plan.words = {RENDERCHECK, "run", "suite.json"};
    plan.folder = folder.path.string();
    plan.env = {{"TMPDIR", folder / "tmp"}};
    Process process = *start_process(plan);
    while (text("pid").empty()) usleep(10000);
    stop_process(process);
    std::optional<ProcessEnd> end;
    while (!(end = poll_process(process))) usleep(10000);
    EXPECT_FALSE(fs::exists("/proc/" + std::to_string(std::stol(text("pid")))));
    EXPECT_TRUE(fs::is_empty(folder / "tmp"));
}

}  // namespace
}  // namespace flaneur
