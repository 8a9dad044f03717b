// The bars and curves of the program against the files that they were taken from, where these are at hand:
// shared/gait beside the checkout.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tools/flaneur/gait/bars.h"

namespace flaneur {
namespace {

using Json = nlohmann::json;

const std::string k_folder = std::string(FLANEUR_SHARED_DIR) + "/gait/";

TEST(GaitTargets, CurvesAreThoseOfTheFile) {
    std::ifstream file(k_folder + "adult_target_noSA_101.csv");
    if (!file) GTEST_SKIP() << "no " << k_folder;
    const Cycle* columns[] = {
        &k_reference.thigh,      &k_reference.thigh_sd,    &k_reference.knee,
        &k_reference.knee_sd,    &k_reference.ankle,       &k_reference.ankle_sd,
        &k_reference.foot_pitch, &k_reference.pelvis_list, &k_reference.pelvis_rotation};
    size_t row = 0;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || !std::isdigit(static_cast<unsigned char>(line[0]))) continue;
        std::istringstream cells(line);
        std::string cell;
        std::getline(cells, cell, ',');
        for (const Cycle* column : columns) {
            ASSERT_TRUE(std::getline(cells, cell, ','));
            EXPECT_DOUBLE_EQ((*column)[row], std::stod(cell)) << line;
        }
        ++row;
    }
    EXPECT_EQ(row, static_cast<size_t>(k_percents));
}

TEST(GaitTargets, ARunIsJudgedAsOneWhereItBegins) {
    auto is_run = [](const std::vector<Bar>& bars) {
        return std::none_of(bars.begin(), bars.end(), [](const Bar& bar) {
            return std::string_view(bar.quantity) == "walk_ratio.m_spm";
        });
    };
    EXPECT_TRUE(is_run(level_bars(2.13, 0.9))) << "Froude number 0.51";
    EXPECT_FALSE(is_run(level_bars(2.08, 0.9))) << "Froude number 0.49";
}

// Every bar of targets.json that is two numbers or one is ours too, not looser.
TEST(GaitTargets, BarsAreThoseOfTheFile) {
    std::ifstream file(k_folder + "targets.json");
    if (!file) GTEST_SKIP() << "no " << k_folder;
    Json targets = Json::parse(file);
    std::vector<Bar> bars = level_bars(1.3, 0.9);
    for (const Bar& bar : turn_bars(180)) bars.push_back(bar);
    auto held = [&](const std::string& name, double low, double high) {
        for (const Bar& bar : bars) {
            if (name != bar.quantity) continue;
            EXPECT_GE(bar.low, low) << name;
            EXPECT_LE(bar.high, high) << name;
            return;
        }
        ADD_FAILURE() << "no bar for " << name;
    };
    auto range = [&](const std::string& name, const Json& pair) {
        held(name, pair.at(0).get<double>(), pair.at(1).get<double>());
    };
    auto most = [&](const std::string& name, const Json& value) { held(name, -k_open, value.get<double>()); };

    const Json& joint = targets.at("joint");
    for (const char* name : {"thigh", "knee", "ankle", "foot_pitch"}) {
        const Json& j = joint.at(name);
        most(std::string(name) + ".rmse", j.at("rmse"));
        if (j.contains("rmse0")) most(std::string(name) + ".rmse0", j.at("rmse0"));
        held(std::string(name) + ".r", j.at("r").get<double>(), k_open);
    }
    most("pelvis_list.rmse", joint.at("pelvis_obliq").at("rmse"));
    range("pelvis_list.range", joint.at("pelvis_obliq").at("rom"));
    most("pelvis_rotation.rmse", joint.at("pelvis_rot").at("rmse"));
    range("pelvis_rotation.range", joint.at("pelvis_rot").at("rom"));
    range("upper_arm.range", joint.at("shoulder_flex").at("rom"));
    range("elbow.range", joint.at("elbow_flex").at("rom"));
    range("elbow.mean", joint.at("elbow_flex").at("mean"));

    const Json& marks = targets.at("landmarks");
    const std::pair<const char*, const char*> both[] = {
        {"knee_swing_peak", "knee_swing_peak"}, {"knee_loading_peak", "knee_loading_peak"},
        {"thigh_back", "thigh_max_ext"},        {"ankle_up", "ankle_max_df"},
        {"ankle_down", "ankle_max_pf"},         {"foot_pitch_low", "foot_pitch_to"}};
    for (auto [ours, theirs] : both) {
        range(std::string(ours) + ".deg", marks.at(theirs).at("deg"));
        range(std::string(ours) + ".pct", marks.at(theirs).at("pct"));
    }
    range("knee_contact.deg", marks.at("knee_ic").at("deg"));
    range("foot_pitch_contact.deg", marks.at("foot_pitch_ic").at("deg"));
    range("foot_flat.pct", marks.at("foot_flat").at("pct"));
    range("heel_off.pct", marks.at("heel_off").at("pct"));
    range("knee_speed.deg_s", marks.at("knee_vel_deg_s").at("peak"));

    const Json& timing = targets.at("spatiotemporal");
    range("walk_ratio.m_spm", timing.at("walk_ratio_m_per_spm"));
    range("step_width.m", timing.at("step_width_m"));
    range("toe_out.deg", timing.at("toe_out_deg"));
    range("toe_clearance.mm", timing.at("mtc_mm"));
    range("toe_clearance.pct", timing.at("mtc_pct"));
    range("pelvis_high.pct", targets.at("pelvis").at("vertical_max_pct"));
    const Json& upper = targets.at("upper");
    range("trunk_pelvis.deg", upper.at("trunk_pelvis_phase_deg_v>1.1"));
    range("arm_leg.deg", upper.at("arm_leg_phase_ipsi_deg"));
    range("head_yaw.deg", upper.at("head_rot_pp"));
    range("head_pitch.deg", upper.at("head_pitch_pp"));

    const Json& contact = targets.at("contact");
    most("planted_ankle_drift.mm", contact.at("planted_ankle_drift_mm_15_30pct"));
    most("planted_toe_drift.mm", contact.at("planted_toe_drift_mm_15_45pct"));
    most("slip_speed_p99.m_s", contact.at("slip_speed_p99_m_s"));
    most("skate_zhang.mm", contact.at("zhang_mm_per_frame30_planted_only"));
    const Json& jerk = targets.at("smooth").at("mean_jerk_m_s3_lp10Hz");
    for (const char* part : {"pelvis", "head", "wrist", "ankle"})
        range("jerk_" + std::string(part) + ".m_s3", jerk.at(part));
    const Json& transients = targets.at("transients");
    range("start.steps", transients.at("init_steps_to_90pct"));
    range("stop.steps", transients.at("stop_steps"));
    range("turn.s", transients.at("uturn_180_s"));
    range("turn_peak.deg_s", transients.at("uturn_peak_yaw_deg_s"));
    for (const Bar& bar : bends_bars()) bars.push_back(bar);
    range("bend_exponent", transients.at("speed_curvature_exponent"));
    range("head_lead.ms", transients.at("head_lead_ms"));
}

TEST(GaitTargets, SpeedsBendTheBars) {
    auto bar = [](double speed, const std::string& name) {
        for (const Bar& b : level_bars(speed, 0.9))
            if (name == b.quantity) return b;
        return Bar{"", 0, 0, 0, ""};
    };
    EXPECT_NEAR(bar(1.24, "stance.pct").low, 57.8, 1e-9);
    EXPECT_NEAR(bar(1.37, "stance.pct").high, 59.7 + 2.5, 1e-9);
    EXPECT_NEAR(bar(0.94, "cadence.spm").low, 0.9 * 98, 1e-9);
    EXPECT_NEAR(bar(1.6, "pelvis_vertical.mm").high, 1.3 * 48, 1e-9);
    EXPECT_STREQ(bar(1.5, "knee.rmse").quantity, "");         // a norm of natural speed
    EXPECT_STREQ(bar(3.1, "walk_ratio.m_spm").quantity, "");  // a run
}

}  // namespace
}  // namespace flaneur
