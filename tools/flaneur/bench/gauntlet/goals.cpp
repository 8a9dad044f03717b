// What the project aims at, on two shared cores without a GPU where nothing else is said.
#include <cmath>

#include "tools/flaneur/bench/gauntlet/gauntlet.h"
#include "tools/flaneur/plot/plot.h"

namespace flaneur {

namespace {

constexpr const char* k_posing = "The pose: nanoseconds a walker, one thread";
constexpr const char* k_steering = "Steering: nanoseconds a decision, one thread";
constexpr const char* k_crowding = "The crowd: milliseconds a tick, all threads";
constexpr const char* k_picturing = "Pictures at 1280x720, medium quality: milliseconds";
constexpr const char* k_drawing = "Draws of a picture";
constexpr const char* k_peers = "Copies of one character, as other renderers draw them: milliseconds";

constexpr const char* k_why_core =
    "Core counts the pelvis that falls and is caught, heels and limits, which the probe behind the goal had "
    "not; and shared cores run up to a fifth slower than idle ones.";
constexpr const char* k_why_fabrik = "The goal is of a probe on an idle core; a busy sibling costs as much.";
constexpr const char* k_why_steer =
    "Neighbours are looked for across a grid that no longer fits the caches, and bounded acceleration, walls "
    "and lanes come on top of half-planes alone.";
constexpr const char* k_why_tick =
    "Moving and stepping are plain code, one walker after another, and everybody is posed whether seen or "
    "not.";
constexpr const char* k_why_picture =
    "Shading of the city and of people in blocks of 4 x 4, and the tick where there are many; neighbours on "
    "shared cores add a third on busy days.";
constexpr const char* k_why_few =
    "What does not depend on the number of copies, clearing, the ground, light and copying back, takes some "
    "10 ms already.";
constexpr const char* k_why_flip =
    "Distant copies lose visor and stripes with their coarser meshes and pictures.";
constexpr const char* k_why_draws =
    "A draw is made for each level of each character and each piece of the city in sight.";

constexpr Goal k_goals[] = {
    {k_posing, "gait, forward kinematics, 4 IK and feet, SSE4", "pose", "core, sse4", 0, 130, k_why_core},
    {k_posing, "the same, AVX2", "pose", "core, avx2", 0, 80, k_why_core},
    {k_posing, "the same, AVX-512", "pose", "core, avx512", 0, 60, k_why_core},
    {k_posing, "with looks and both hands on walls, SSE4", "pose", "full, sse4", 0, 250, k_why_core},
    {k_posing, "the same, AVX2", "pose", "full, avx2", 0, 130, k_why_core},
    {k_posing, "the same, AVX-512", "pose", "full, avx512", 0, 100, k_why_core},
    {k_posing, "blend tree of three clips, SSE4", "pose", "blend tree, 3 clips, sse4", 0, 180, k_why_fabrik},
    {k_posing, "the same, AVX2", "pose", "blend tree, 3 clips, avx2", 0, 100, k_why_fabrik},
    {k_posing, "the same, AVX-512", "pose", "blend tree, 3 clips, avx512", 0, 70, k_why_fabrik},
    {k_posing, "FABRIK, a chain of 4 bones, SSE4", "pose", "FABRIK chain, sse4", 0, 27, k_why_fabrik},
    {k_posing, "the same, AVX2", "pose", "FABRIK chain, avx2", 0, 20, k_why_fabrik},
    {k_posing, "the same, AVX-512", "pose", "FABRIK chain, avx512", 0, 15, k_why_fabrik},
    {k_steering, "neighbours found and a velocity chosen, 1,000 walkers", "sim", "decision", 1e3, 350,
     k_why_steer},
    {k_steering, "10,000 walkers", "sim", "decision", 1e4, 350, k_why_steer},
    {k_steering, "100,000 walkers", "sim", "decision", 1e5, 350, k_why_steer},
    {k_crowding, "100,000 walkers in real time", "sim", "tick", 1e5, 1000.0 / 60, k_why_tick},
    {k_picturing, "a street, 500 walkers in the city", "frame", "street", 500, 30, k_why_picture},
    {k_picturing, "2,000", "frame", "street", 2000, 40, k_why_picture},
    {k_picturing, "10,000", "frame", "street", 1e4, 65, k_why_picture},
    {k_picturing, "before the densest throng, 500 walkers", "frame", "crowd", 500, 35, k_why_picture},
    {k_picturing, "2,000", "frame", "crowd", 2000, 50, k_why_picture},
    {k_picturing, "10,000", "frame", "crowd", 1e4, 80, k_why_picture},
    {k_drawing, "indirect ones, 10,000 walkers", "frame", "sub-draws", 1e4, 300, k_why_draws},
    {k_drawing, "direct ones", "frame", "direct draws", 1e4, 20, k_why_draws},
    {k_peers, "with levels of detail, 100 copies", "peers", "with LOD", 100, 10, k_why_few},
    {k_peers, "500", "peers", "with LOD", 500, 15, k_why_few},
    {k_peers, "1,000", "peers", "with LOD", 1000, 20, k_why_few},
    {k_peers, "every triangle, 100 copies", "peers", "every triangle", 100, 30, k_why_few},
    {k_peers, "500", "peers", "every triangle", 500, 60, k_why_few},
    {k_peers, "1,000", "peers", "every triangle", 1000, 80, k_why_few},
    {k_peers, "mean FLIP between the two, 100 copies", "peers", "FLIP", 100, 0.02, k_why_flip},
    {k_peers, "500", "peers", "FLIP", 500, 0.02, k_why_flip},
    {k_peers, "1,000", "peers", "FLIP", 1000, 0.02, k_why_flip},
};

std::string verdict_of(const Goal& goal, const GauntletScore* score) {
    if (!score) return "not measured";
    return score->value <= goal.most
               ? "met"
               : "missed by " + std::to_string(std::lround(100 * (score->value / goal.most - 1))) + " %";
}

// A walk beside people's: bars are those of `flaneur gait --check`.
std::string walk_markdown(const GauntletRun& run) {
    std::string rows;
    bool is_all_met = true;
    for (const GauntletScore& score : run.scores) {
        if (score.part != "gait") continue;
        const bool is_met =
            score.value >= score.low.value_or(score.value) && score.value <= score.high.value_or(score.value);
        is_all_met = is_all_met && is_met;
        std::string bar = score.low ? short_number(*score.low) : "";
        bar += score.low && score.high ? " .. " : score.low ? " or more" : "";
        bar += score.high ? (score.low ? "" : "up to ") + short_number(*score.high) : "";
        rows += "| " + score.name + " | " + bar + " | " + short_number(score.value) + " | " +
                (is_met ? "met" : "missed") + " |\n";
    }
    if (rows.empty()) return {};
    return "\n## The walk: a man of 30 on level ground at his usual speed\n\nWhat each quantity is, and "
           "where the bars are from, "
           "`flaneur gait --check` tells, of other ways and people too.\n\n| | bar | measured | "
           "|\n|---|---|---|---|\n" +
           rows +
           (is_all_met ? ""
                       : "\nBars are held to people's spread; those missed by a few percent are owed, as "
                         "[gait.md](gait.md) tells.\n");
}

}  // namespace

std::span<const Goal> all_goals() { return k_goals; }

std::string goals_markdown(const GauntletRun& run) {
    std::string text =
        "# Performance\n\nWhat the project aims at beside what a machine measures. Written by\n\n"
        "    flaneur bench gauntlet --markdown docs/performance.md\n\n";
    text += "- Machine: " + run.machine + "\n";
    if (!run.device.empty()) text += "- Drawn on: " + run.device + "\n";
    text += "- flaneur " + run.version + (run.is_quick ? ", a quick run" : ", a full run") + " of " +
            short_number(std::round(run.seconds)) + " s\n";
    for (const std::string& note : run.notes) text += "- " + note + "\n";
    text +=
        "\nGoals are of two cores that do nothing else; on shared ones times differ by a third from hour to "
        "hour.\n";
    std::string topic, missed;
    auto end_topic = [&] {
        if (!missed.empty()) text += "\n" + missed + "\n";
        missed.clear();
    };
    for (const Goal& goal : k_goals) {
        const GauntletScore* score = find_score(run, goal.part, goal.name, goal.size);
        const GauntletScore* work =
            find_score(run, goal.part, std::string(goal.name) + ", all threads", goal.size);
        if (topic != goal.topic) {
            end_topic();
            topic = goal.topic;
            text += "\n## " + topic +
                    "\n\n| | goal | measured | work of all threads | |\n|---|---|---|---|---|\n";
        }
        text += std::string("| ") + goal.what + " | " + short_number(goal.most) + " | " +
                (score ? short_number(score->value) : "") + " | " + (work ? short_number(work->value) : "") +
                " | " + verdict_of(goal, score) + " |\n";
        const bool is_missed = score && score->value > goal.most;
        if (is_missed && missed.find(goal.why) == std::string::npos)
            missed += (missed.empty() ? "" : " ") + std::string(goal.why);
    }
    end_topic();
    return text + walk_markdown(run);
}

}  // namespace flaneur
