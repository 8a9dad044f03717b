// Bars carried over to everybody, and what becomes of a population's walks.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "sim/base/math.h"
#include "tools/flaneur/gait/measure/limits.h"
#include "tools/flaneur/gait/people/ages.h"
#include "tools/flaneur/gait/people/table.h"

namespace flaneur {
namespace {

constexpr Who k_man = {Sex::man, 30, 0};

const Bar* find(const std::vector<Bar>& bars, const std::string& name) {
    for (const Bar& bar : bars)
        if (name == bar.quantity) return &bar;
    return nullptr;
}

// At the pace that 1.3 m/s are with the norm's leg.
std::vector<Bar> natural_bars(const Who& who, double leg) {
    return bars_of(who, leg, Trial::level, 1.3 * std::sqrt(leg / k_norm_leg));
}

TEST(GaitPeople, TheManOfTheNormsKeepsHisBars) {
    std::vector<Bar> bars = bars_of(k_man, k_norm_leg, Trial::usual, 1.3);
    for (const Bar& bar : level_bars(1.3, k_norm_leg)) {
        const Bar* carried = find(bars, bar.quantity);
        ASSERT_TRUE(carried) << bar.quantity;
        EXPECT_NEAR(carried->low, bar.low, 1e-9) << bar.quantity;
        EXPECT_NEAR(carried->high, bar.high, 1e-9) << bar.quantity;
    }
    std::vector<Bar> fast = bars_of(k_man, k_norm_leg, Trial::level, 1.5);
    for (const Bar& bar : level_bars(1.5, k_norm_leg)) {
        const Bar* carried = find(fast, bar.quantity);
        ASSERT_TRUE(carried) << bar.quantity;
        EXPECT_LE(carried->high, bar.high + 0.2) << bar.quantity << " is looser than for one man";
        EXPECT_GE(carried->low, bar.low - 0.2) << bar.quantity << " is looser than for one man";
    }
}

TEST(GaitPeople, BarsGrowWithTheLeg) {
    std::vector<Bar> tall = natural_bars(k_man, 0.9), small = natural_bars(k_man, 0.45);
    auto ratio = [&](const char* name) { return find(small, name)->high / find(tall, name)->high; };
    EXPECT_NEAR(ratio("step_width.m"), 0.5, 1e-9);
    EXPECT_NEAR(ratio("pelvis_vertical.mm"), 0.5, 1e-9);
    EXPECT_NEAR(ratio("cadence.spm"), std::sqrt(2), 1e-9);
    EXPECT_NEAR(ratio("jerk_head.m_s3"), std::sqrt(2), 1e-9);
    EXPECT_NEAR(ratio("walk_ratio.m_spm"), std::pow(0.5, 1.5), 1e-9);
    for (const char* name :
         {"knee.rmse", "stance.pct", "pelvis_up.m_s2", "stance_drift.mm", "joint_speed.deg_s"})
        EXPECT_NEAR(ratio(name), 1, 1e-9) << name;
    auto turn = [](double leg) { return find(bars_of(k_man, leg, Trial::turn, 1.3), "turn.s")->high; };
    EXPECT_NEAR(turn(0.45), std::sqrt(0.5) * turn(0.9), 1e-9);
}

TEST(GaitPeople, BarsMoveWithTheSpeed) {
    auto bars = [](double pace) {
        return bars_of(k_man, k_norm_leg, Trial::level, pace / pace_of(1, k_norm_leg));
    };
    // The means of Schwartz's classes: knees take the load with 19.3 and 23.8 degrees.
    EXPECT_NEAR(
        find(bars(0.568), "knee_loading_peak.deg")->low - find(bars(0.432), "knee_loading_peak.deg")->low,
        23.8 - 19.3, 1e-9);
    EXPECT_NEAR(find(bars(0.704), "ankle_down.deg")->high - find(bars(0.568), "ankle_down.deg")->high, 0.1,
                1e-9);
    EXPECT_GT(find(bars(0.549), "upper_arm.range")->low, 30);
    EXPECT_GE(find(bars(0.707), "pelvis_down.m_s2")->low, -9.81) << "nobody falls faster than freely";
    EXPECT_FALSE(find(bars(0.6), "knee.rmse")) << "curves are those of a natural speed";
    EXPECT_FALSE(find(bars(0.6), "start.steps"));
}

TEST(GaitPeople, StylesAreHeldToPhysicsAlone) {
    for (Trial trial : {Trial::usual, Trial::turn, Trial::stairs_down, Trial::slope_up, Trial::kerb}) {
        std::vector<Bar> bars = bars_of({Sex::woman, 20, 7}, 0.86, trial, 1.3);
        for (const char* name :
             {"stance_drift.mm", "penetration.mm", "joint_speed.deg_s", "joint_outside.deg"})
            EXPECT_TRUE(find(bars, name)) << name;
        for (const char* name : {"knee.rmse", "upper_arm.range", "cadence.spm", "head_lead.ms", "speed.m_s"})
            EXPECT_FALSE(find(bars, name)) << name;
        for (const Bar& bar : bars_of({Sex::woman, 20, 0}, 0.86, trial, 1.3)) {
            const Bar* same = find(bars, bar.quantity);
            if (same) {
                EXPECT_EQ(same->high, bar.high) << bar.quantity;
            }
        }
    }
    EXPECT_TRUE(find(bars_of({Sex::woman, 20, 7}, 0.86, Trial::usual, 1.3), "jerk_head.m_s3"));
}

TEST(GaitPeople, FastestWalksAreThoseOfTheirLegsAndAge) {
    EXPECT_NEAR(pace_of(fastest_speed({Sex::woman, 4, 0}, 0.55), 0.55), std::sqrt(k_run_froude), 1e-9);
    EXPECT_NEAR(fastest_speed({Sex::man, 80, 0}, 0.93), (1.83 + 1.65) / 2, 1e-9);
    EXPECT_NEAR(fastest_speed({Sex::woman, 62, 0}, 0.86), 1.87, 1e-9);
    for (const Who& who : everyone()) {
        double liked = speed_of(who, {Trial::usual, 0}), most = speed_of(who, {Trial::level, 1});
        EXPECT_LT(liked, most) << name_of(who);
    }
}

// The rows of the file that the tables were taken from, where it is at hand.
TEST(GaitPeople, NormsByAgeAreThoseOfTheFile) {
    std::ifstream file(std::string(FLANEUR_SHARED_DIR) + "/gait/spatiotemporal_by_age_sex.csv");
    if (!file) GTEST_SKIP() << "no shared/gait";
    int rows = 0;
    for (std::string line; std::getline(file, line);) {
        std::vector<std::string> cell;
        std::istringstream cells(line);
        for (std::string one; std::getline(cells, one, ',');) cell.push_back(one);
        if (cell.size() < 18 || cell[0] == "sex") continue;
        double from = std::stod(cell[1]), height = 0;
        Who who{cell[0] == "Male" ? Sex::man : Sex::woman, from, 0};
        if (from == 5) height = 1.095;
        if (from == 8) height = 1.27;
        if (from == 12) height = 1.53;
        if (from >= 70) height = who.sex == Sex::man ? 1.72 : 1.58;
        if (height == 0) continue;
        auto at = [&](size_t column) { return std::stod(cell[column]); };
        std::vector<Bar> bars = bars_of(who, 0.53 * height, Trial::level, at(4));
        auto expect = [&](const char* name, size_t column) {
            const Bar* bar = find(bars, name);
            ASSERT_TRUE(bar) << name << ": " << line;
            EXPECT_NEAR(bar->low, at(column) - 2 * at(column + 1), 1e-6) << name << ": " << line;
            EXPECT_NEAR(bar->high, at(column) + 2 * at(column + 1), 1e-6) << name << ": " << line;
        };
        expect("cadence.spm", 6);
        expect("step_length.m", 10);
        expect("stance.pct", 14);
        expect("double_support.pct", 16);
        if (from < 18) expect("step_width.m", 12);
        EXPECT_FALSE(find(bars, "walk_ratio.m_spm"));
        ++rows;
    }
    EXPECT_EQ(rows, 2 * (3 * 3 + 4));
}

TEST(GaitPeople, TheOldAreNotHeldToTheCurvesOfTheYoung) {
    std::vector<Bar> young = natural_bars({Sex::man, 40, 0}, 0.9), old = natural_bars({Sex::man, 80, 0}, 0.9);
    EXPECT_TRUE(find(young, "knee.rmse"));
    EXPECT_FALSE(find(old, "knee.rmse"));
    EXPECT_NEAR(find(old, "thigh_back.deg")->high - find(young, "thigh_back.deg")->high, 6, 1e-9);
    EXPECT_NEAR(find(old, "thigh_back.deg")->low, find(young, "thigh_back.deg")->low, 1e-9);
    EXPECT_TRUE(find(natural_bars({Sex::woman, 4, 0}, 0.55), "knee.rmse"));
}

// Somebody who stands on both feet for two seconds.
Walk standing() {
    Walk w{standard_body(1.75f), 60, {}};
    Instant now;
    for (size_t j = 0; j < k_joint_count; ++j) now.joints[j].position = w.body.joints[j];
    w.ticks.assign(120, now);
    return w;
}

TEST(GaitPeople, FindsWhatNoBodyDoes) {
    auto is = [](const Walk& w, const char* name) { return value_of(measure_body(w, 1), name); };
    Walk still = standing(), jumps = still, bends = still, falls = still;
    for (const Quantity& q : measure_body(still, 1)) EXPECT_NEAR(q.value, 0, 1e-6) << q.name;
    for (size_t t = 60; t < 120; ++t) {
        for (Joint joint :
             {left_lower_arm, left_hand})  // both, so that the hand does not turn against the arm
            jumps.ticks[t].joints[joint].rotation = rotation_x(-20 * k_radians);
        for (Joint joint : {right_lower_leg, right_foot, right_toes})
            bends.ticks[t].joints[joint].rotation = rotation_x(-15 * k_radians);
    }
    falls.ticks[80].joints[hips].position.y -= 0.01f;
    EXPECT_NEAR(is(jumps, "joint_speed.deg_s"), 1200, 1);
    EXPECT_NEAR(is(jumps, "joint_outside.deg"), 0, 1e-3);
    EXPECT_NEAR(is(bends, "joint_outside.deg"), 10, 0.1);
    EXPECT_NEAR(is(falls, "pelvis_fall.m_s2"), 0.01 * 3600, 0.1);
    for (size_t t = 79; t < 83; ++t)
        for (FootInstant& foot : falls.ticks[t].feet) foot.swinging = true;
    EXPECT_NEAR(is(falls, "pelvis_fall.m_s2"), 0, 1e-6) << "who leaps falls";
}

TEST(GaitPeople, MissesNameTheWorst) {
    std::vector<Who> people{{Sex::woman, 8, 0}, {Sex::woman, 8, 3}, {Sex::man, 80, 0}};
    std::vector<Report> reports(people.size() * k_task_count);
    auto put = [&](size_t person, size_t task, Verdict v) {
        reports[person * k_task_count + task].verdicts.push_back(v);
    };
    constexpr Bar k_drift{"stance_drift.mm", 0, 3, 0, ""}, k_lean{"trunk_lean.deg", 2, 8, 0, ""};
    for (size_t person = 0; person < 3; ++person) put(person, 12, {k_drift, 1, true, true});
    put(0, 0, {k_drift, 4, true, false});
    put(1, 4, {k_drift, 9, true, false});
    put(2, 1, {k_drift, 2, true, true});
    put(0, 5, {k_lean, 1, true, false});
    put(2, 5, {k_lean, 8.5, true, false});
    std::vector<Miss> misses = misses_of(people, reports);
    ASSERT_EQ(misses.size(), 2u) << "nobody drifts at the kerb";
    EXPECT_EQ(misses[0].quantity, "trunk_lean.deg");
    EXPECT_EQ(misses[0].people, 2);
    EXPECT_EQ(misses[0].worst.value, 1);
    EXPECT_EQ(misses[0].whose.substr(0, 13), "a woman of 8,");
    EXPECT_EQ(misses[1].place, "level");
    EXPECT_EQ(misses[1].people, 1);
    EXPECT_EQ(misses[1].of_people, 2);
    EXPECT_EQ(misses[1].walks, 2);
    EXPECT_EQ(misses[1].of_walks, 3);
    EXPECT_EQ(misses[1].worst.value, 9);
    EXPECT_EQ(misses[1].whose.substr(0, 21), "a woman of 8, style 3");
}

TEST(GaitPeople, ThreadsChangeNothing) {
    std::vector<Who> people{{Sex::woman, 8, 0}, {Sex::man, 80, 3}};
    Result<std::vector<Report>> one = try_everyone(people, *make_workers(1)),
                                three = try_everyone(people, *make_workers(3));
    ASSERT_TRUE(one && three);
    ASSERT_EQ(one->size(), 2 * k_task_count);
    for (size_t i = 0; i < one->size(); ++i) {
        EXPECT_EQ((*one)[i].person, i < k_task_count ? "woman_8" : "man_80_style_3");
        EXPECT_EQ((*one)[i].poses, (*three)[i].poses);
        EXPECT_EQ((*one)[i].name, (*three)[i].name);
        EXPECT_GT((*one)[i].verdicts.size(), 2u);
        for (const Verdict& v : (*one)[i].verdicts) EXPECT_TRUE(v.measured) << v.bar.quantity;
    }
}

}  // namespace
}  // namespace flaneur
