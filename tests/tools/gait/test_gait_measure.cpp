// Walks made up from known numbers, and the measures that must find these.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "sim/base/math.h"
#include "tools/flaneur/gait/bars.h"
#include "tools/flaneur/gait/crowd.h"
#include "tools/flaneur/gait/measure/contact.h"
#include "tools/flaneur/gait/measure/limits.h"
#include "tools/flaneur/gait/measure/transients.h"
#include "tools/flaneur/gait/report.h"

namespace flaneur {
namespace {

constexpr int k_cycle = 60, k_down = 37;  // ticks of a stride, and of them on the ground
constexpr float k_step = 0.6f, k_width = 0.1f;

// Straight along +z at 1.2 m/s, two steps a second of 0.6 m, feet 0.1 m apart and 6 degrees out, stance 37 of
// 60 ticks; each thigh swings by +-20 degrees, largest at contact, and each knee is bent by 10.
Walk made_up_walk(int ticks) {
    Walk w{standard_body(1.75f), 60, {}};
    const auto& rest = w.body.joints;
    for (int t = 0; t < ticks; ++t) {
        Instant now;
        now.root = {0, 0, 1.2f * static_cast<float>(t) / 60};
        now.velocity = {0, 1.2f};
        for (size_t j = 0; j < k_joint_count; ++j) now.joints[j].position = rest[j] + now.root;
        for (Side side : {k_left, k_right}) {
            const LimbJoints& limb = k_limbs[side];
            int since = t + (side == k_left ? 0 : k_cycle / 2);
            int stride = since / k_cycle, at = since % k_cycle;
            float angle = 20 * k_radians * sin_cos(2 * k_pi * static_cast<float>(at) / k_cycle).cosine;
            float shank = angle - 10 * k_radians;
            Vec3 hip = now.joints[limb.upper_leg].position;
            auto hang = [](float a) { return Vec3{0, -sin_cos(a).cosine, sin_cos(a).sine}; };
            now.joints[limb.lower_leg].position = hip + hang(angle) * 0.43f;
            now.joints[limb.foot].position = now.joints[limb.lower_leg].position + hang(shank) * 0.43f;

            FootInstant& foot = now.feet[side];
            foot.swinging = at >= k_down;
            float across = side == k_left ? k_width / 2 : -k_width / 2;
            float along = static_cast<float>(stride) * 2 * k_step - (side == k_right ? k_step : 0);
            float out = (side == k_left ? 6 : -6) * k_radians;
            Vec2 ahead = heading_direction(out);
            Vec3 ankle{across, foot.swinging ? 0.05f : 0, along};
            foot.sole = {ankle, ankle + at_height(ahead * 0.15f, 0), ankle + at_height(ahead * 0.2f, 0)};
            if (!foot.swinging) now.joints[limb.foot].position = {across, 0.07f, along};
        }
        w.ticks.push_back(now);
    }
    return w;
}

TEST(GaitMeasure, FindsTheTimingThatWasPutIn) {
    Level level = measure_level(made_up_walk(900), 100, 800);
    auto is = [&](const char* name) { return value_of(level.quantities, name); };
    EXPECT_NEAR(is("speed.m_s"), 1.2, 1e-3);
    EXPECT_NEAR(is("cadence.spm"), 120, 1e-6);
    EXPECT_NEAR(is("stance.pct"), 100.0 * k_down / k_cycle, 1e-6);
    EXPECT_NEAR(is("double_support.pct"), 100.0 * 2 * (k_down - 30) / k_cycle, 1e-6);
    EXPECT_NEAR(is("step_length.m"), k_step, 1e-4);
    EXPECT_NEAR(is("step_width.m"), k_width, 1e-4);
    EXPECT_NEAR(is("toe_out.deg"), 6, 1e-3);
    EXPECT_NEAR(is("walk_ratio.m_spm"), k_step / 120, 1e-6);
    EXPECT_NEAR(is("thigh.range"), 40, 0.2);
    EXPECT_NEAR(level.curves.thigh[50], -20, 0.3);
    EXPECT_NEAR(level.curves.knee[80], 10, 0.2);  // in the swing, where the made-up ankle hangs from the knee
    EXPECT_NEAR(is("penetration.mm"), 0, 1e-3);
    EXPECT_NEAR(is("stance_drift.mm"), 0, 1e-3);
}

Quantities contact_of(const Walk& w) { return measure_contact(w, strides(w, 100, 800)); }

TEST(GaitMeasure, FindsAFootThatSlides) {
    Walk w = made_up_walk(900);
    for (int t = 0; t < 900; ++t) {  // 12 mm/s in every stance, so 7.2 mm over its 36 ticks
        auto& foot = w.ticks[static_cast<size_t>(t)].feet[k_left];
        if (foot.swinging) continue;
        float slid = 0.012f * static_cast<float>(t % k_cycle) / 60;
        for (Vec3* p : {&foot.sole.heel, &foot.sole.ball, &foot.sole.tip}) p->x += slid;
        w.ticks[static_cast<size_t>(t)].joints[left_foot].position.x += slid;
    }
    Quantities q = contact_of(w);
    EXPECT_NEAR(value_of(q, "stance_drift.mm"), 7.2, 0.05);
    EXPECT_NEAR(value_of(q, "planted_ankle_drift.mm"), 12.0 * 9 / 60, 0.21);
    EXPECT_NEAR(value_of(q, "planted_toe_drift.mm"), 12.0 * 18 / 60, 0.21);
    EXPECT_NEAR(value_of(q, "slip_speed_p99.m_s"), 0.012, 1e-3);
    EXPECT_FALSE(judge(q, kerb_bars())[0].pass);
}

TEST(GaitMeasure, AFootMayTurnAboutHeelOrBall) {
    auto drift = [](Vec2 shift, float turn, bool about_ball) {
        StanceWatch watch;
        for (int t = 0; t <= 40; ++t) {
            float share = static_cast<float>(t) / 40;
            Vec2 ahead = heading_direction(turn * share);
            float behind = about_ball ? 0.2f : 0.0f;
            Vec3 heel = at_height(shift * share - ahead * behind, 0);
            FootInstant foot;
            foot.sole = {heel, heel + at_height(ahead * 0.2f, 0), heel + at_height(ahead * 0.26f, 0)};
            watch_stance(watch, foot);
        }
        return watch.stance.drift;
    };
    EXPECT_NEAR(drift({0, 0}, 1, true), 0, 1e-6f);
    EXPECT_NEAR(drift({0, 0}, 1, false), 0, 1e-6f);
    EXPECT_NEAR(drift({0.02f, 0}, 0, true), 0.02f, 1e-6f);
    EXPECT_GT(drift({0.02f, 0.02f}, 1, true), 0.02f);
}

TEST(GaitMeasure, FindsFeetUnderAndOverTheGround) {
    Walk sunk = made_up_walk(900), hovering = made_up_walk(900), dragging = made_up_walk(900);
    for (size_t t = 300; t < 360; ++t) {
        for (float& ground : sunk.ticks[t].feet[k_left].ground) ground = 0.006f;
        for (float& ground : hovering.ticks[t].feet[k_left].ground) ground = -0.008f;
        for (float& ground : dragging.ticks[t].feet[k_left].ground) ground = t < 340 ? 0 : 0.09f;
    }
    EXPECT_NEAR(value_of(contact_of(sunk), "penetration.mm"), 6, 1e-3);
    EXPECT_NEAR(value_of(contact_of(hovering), "float.mm"), 8, 1e-3);
    EXPECT_NEAR(value_of(contact_of(dragging), "swing_penetration.mm"), 40, 1e-3);
}

TEST(GaitMeasure, FindsTurnsAndTheLeadOfTheHead) {
    Walk w{standard_body(1.75f), 60, {}};
    auto turned = [](double t) {  // a half turn in two seconds from second 2 on, as a raised cosine
        double s = std::clamp((t - 2) / 2, 0.0, 1.0);
        return static_cast<float>((s - std::sin(2 * std::numbers::pi * s) / (2 * std::numbers::pi)) *
                                  std::numbers::pi);
    };
    for (int i = 0; i < 420; ++i) {
        Instant now;
        for (Joint joint : {hips, upper_chest}) now.joints[joint].rotation = rotation_y(turned(i / 60.0));
        now.joints[head].rotation = rotation_y(turned(i / 60.0 + 0.2));
        now.joints[hips].position = {0, 1, static_cast<float>(i) * 0.4f / 60};
        w.ticks.push_back(now);
    }
    Quantities q = measure_turn(w, 60);
    EXPECT_NEAR(value_of(q, "turn.deg"), 180, 0.5);
    EXPECT_NEAR(value_of(q, "turn.s"), 1.6, 0.1);
    EXPECT_NEAR(value_of(q, "turn_peak.deg_s"), 180, 6);
    EXPECT_NEAR(value_of(q, "head_lead.ms"), 200, 17);
    EXPECT_NEAR(value_of(q, "turn_least_speed.m_s"), 0.4, 0.01);
}

TEST(GaitMeasure, CountsStepsOfStartsAndStops) {
    Walk w = made_up_walk(600);
    for (size_t t = 0; t < w.ticks.size(); ++t) {  // at rest until tick 100, steady at 140; feet still at 400
        float speed = 1.2f * clamp((static_cast<float>(t) - 100) / 40, 0, 1);
        Vec3 before = t > 0 ? w.ticks[t - 1].joints[hips].position : Vec3{};
        w.ticks[t].joints[hips].position = before + Vec3{0, 0, speed / 60};
        if (t < 100 || t >= 400)
            for (FootInstant& foot : w.ticks[t].feet) foot.swinging = false;
    }
    // Contacts come at ticks 120, 150 ..; 90 % is reached about tick 136, within the second step.
    EXPECT_EQ(value_of(measure_start(w, 100, 1.2), "start.steps"), 2);
    EXPECT_NEAR(value_of(measure_start(w, 100, 1.2), "start.s"), 36 / 60.0, 0.1);
    EXPECT_EQ(value_of(measure_stop(w, 345), "stop.steps"), 3);  // at 360, 390 and 400
    EXPECT_NEAR(value_of(measure_stop(w, 345), "stop.s"), 55 / 60.0, 1e-9);
}

TEST(GaitBars, WhatIsOutsideMissingOrNoNumberFails) {
    std::vector<Bar> bars{{"a", 1, 2, 0, ""}, {"b", -k_open, 2, 0, ""}, {"c", 0, 1, 0, ""}};
    auto passes = [&](Quantities q) {
        int n = 0;
        for (const Verdict& v : judge(q, bars)) n += v.pass;
        return n;
    };
    EXPECT_EQ(passes({{"a", 1}, {"b", 2}, {"c", 0.5}}), 3);
    EXPECT_EQ(passes({{"a", 0.99}, {"b", 2.01}, {"c", std::nan("")}}), 0);
    EXPECT_EQ(passes({{"a", 1.5}}), 1);
}

TEST(GaitLimits, KnowWhatJointsOfPeopleDo) {
    auto over = [](Joint joint, Quat turn) { return beyond_limits(joint, joint_angles(joint, {}, turn)); };
    // A knee bends back: about +x.
    EXPECT_EQ(over(left_lower_leg, rotation_x(1.5f)), 0);
    EXPECT_NEAR(over(left_lower_leg, rotation_x(-10 * k_radians)), 5, 0.1);
    EXPECT_EQ(over(right_lower_arm, rotation_x(-2.0f)), 0);
    EXPECT_NEAR(over(right_lower_arm, rotation_x(15 * k_radians)), 10, 0.1);
    EXPECT_EQ(over(left_upper_leg, rotation_x(-1.5f)), 0);
    EXPECT_NEAR(over(left_upper_leg, rotation_x(45 * k_radians)), 10, 0.1);
    EXPECT_EQ(over(left_foot, rotation_x(40 * k_radians)), 0);
    EXPECT_NEAR(over(right_foot, rotation_x(-50 * k_radians)), 10, 0.1);
    EXPECT_NEAR(over(head, rotation_y(80 * k_radians)), 20, 0.1);
    // Left and right mirror each other.
    for (float angle : {-1.0f, -0.6f, 0.6f, 1.0f}) {
        EXPECT_NEAR(over(left_upper_leg, rotation_z(angle)), over(right_upper_leg, rotation_z(-angle)), 0.01);
        EXPECT_NEAR(over(left_upper_leg, rotation_y(angle)), over(right_upper_leg, rotation_y(-angle)), 0.01);
    }
    EXPECT_GT(over(left_upper_leg, rotation_z(-1.0f)), over(left_upper_leg, rotation_z(1.0f)));
}

// A world of one who stands on level ground.
World small_world() {
    World w;
    w.ground = std::make_shared<Ground>(ground_of(level_course(0)));
    w.kinds = {{standard_body(1.75f)}};
    w.crowd.motion.position = {Vec3{}};
    w.crowd.motion.velocity = {Vec2{}};
    w.crowd.motion.heading = {0};
    w.crowd.motion.turn_rate = {0};
    w.crowd.count = 1;
    w.crowd.slots.generation = {0};
    w.crowd.slots.place = {0};
    uint32_t body = 0;
    float scale = 1;
    RootMotion root{w.crowd.motion.position.data(), w.crowd.motion.velocity.data(),
                    w.crowd.motion.heading.data(), w.crowd.motion.turn_rate.data()};
    start_gait(w.gait, 1, {w.kinds[0].body}, &body, &scale, root, surroundings_of(*w.ground), 1);
    w.poses.resize(1);
    pose_blocks(w.gait, 0, 1, w.poses);
    return w;
}

TEST(GaitCrowd, FindsAJumpOfAJointALongBoneAndNoNumber) {
    World w = small_world();
    std::vector<WalkerWatch> watches(1);
    WalkerWatch& watch = watches[0];
    watch_walker(watch, w, 0);
    watch_walker(watch, w, 0);
    const JointWatch& seen = watch.joints[right_hand];
    EXPECT_LT(seen.spin, 1e-2f);
    EXPECT_LT(watch.bone_error.most, 1e-5f);
    EXPECT_EQ(seen.outside + seen.jumps, 0u);

    auto set_hand = [&](Quat q) {
        const float parts[4] = {q.x, q.y, q.z, q.w};
        for (int k = 0; k < 4; ++k) w.poses[0].rotation[right_hand][k][0] = parts[k];
    };
    JointPose hand = joint_pose(w.poses, 0, right_hand);
    w.tick = 7;
    set_hand(hand.rotation * rotation_x(-20 * k_radians));  // in a tick: 1200 degrees a second
    w.poses[0].position[right_hand][1][0] -= 0.003f;
    watch_walker(watch, w, 0);
    EXPECT_NEAR(seen.spin, 1200, 1);
    EXPECT_EQ(seen.spin_tick, 7u);
    EXPECT_EQ(seen.jumps, 1u);
    EXPECT_GT(watch.bone_error.most, 0.002f);

    set_hand(hand.rotation * rotation_x(2.0f));
    watch_walker(watch, w, 0);
    EXPECT_EQ(seen.outside, 1u);

    w.poses[0].position[head][0][0] = std::nanf("");
    watch_walker(watch, w, 0);
    EXPECT_EQ(watch.not_finite, 1u);

    // Of any length, with anything in it.
    const std::string town = "a \"town\" \\ of Zürich" + std::string(99, 'n');
    Report report = judge_crowd(watches, w, town);
    nlohmann::json json = nlohmann::json::parse(reports_json({report}), nullptr, false);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["trials"][0]["title"], "1 walkers in " + town + " for 0 s");
    for (const char* name : {"joint_speed.deg_s", "bone_error.m", "joints_outside", "not_finite"}) {
        for (const Verdict& v : report.verdicts) {
            if (std::string_view(v.bar.quantity) == name) {
                EXPECT_FALSE(v.pass) << name;
            }
        }
    }
    EXPECT_EQ(worst_places(watches).size(), 2u + worst_count);
}

TEST(GaitCrowd, TellsTheWorstAndWhoseItIs) {
    World w = small_world();
    std::vector<WalkerWatch> watches(2);
    Vec2& velocity = w.crowd.motion.velocity[0];
    velocity = {0, 1};
    for (w.tick = 1; w.tick < 80; ++w.tick)
        for (WalkerWatch& watch : watches) watch_walker(watch, w, 0);
    for (int kind = 0; kind < worst_count; ++kind)
        EXPECT_LT(watches[1].worst[kind].most, kind == worst_low ? 1 : 0.01f);

    auto lower = [&](float by) {
        for (Joint joint : {hips, head}) w.poses[0].position[joint][1][0] -= by;
    };
    velocity = {0, 0.9f};
    lower(0.01f);
    watch_walker(watches[1], w, 0);
    const auto& worst = watches[1].worst;
    EXPECT_NEAR(worst[worst_slowing].most, 6, 1e-3);
    EXPECT_NEAR(worst[worst_head_rise].most, 0.6, 1e-3);
    EXPECT_NEAR(worst[worst_fall].most, 36, 0.1);
    EXPECT_EQ(worst[worst_fall].tick, 80u);
    EXPECT_EQ(worst[worst_head_step].most, 0);

    w.tick = 81;
    w.poses[0].position[left_foot][1][0] -= 0.04f;  // planted, and drawn into the ground
    w.poses[0].position[left_toes][1][0] -= 0.04f;
    watch_walker(watches[1], w, 0);
    EXPECT_NEAR(worst[worst_below].most, 40, 1);

    w.tick = 82;
    float upright = w.gait.people[0].joints[hips][1][0], fell = worst[worst_low].most;
    EXPECT_LT(fell, 5);
    lower(0.3f);
    watch_walker(watches[1], w, 0);
    EXPECT_NEAR(worst[worst_low].most, fell + 30 / upright, 0.1);
    w.gait.blocks[0].feet[k_left].from.y[0] -= 0.3f;  // the other foot is low as well: one steps up
    w.poses[0].position[hips][1][0] += 0.01f;
    watch_walker(watches[1], w, 0);
    EXPECT_NEAR(worst[worst_low].most, fell + 30 / upright, 0.1);

    // Both feet to the right of the pelvis: of one who goes straight on, and of one whom a turn to the left
    // leans.
    const Vec2 facing = heading_direction(w.crowd.motion.heading[0]), left{facing.z, -facing.x};
    const Vec3 pelvis = joint_pose(w.poses, 0, hips).position;
    const float out = dot(on_ground(joint_pose(w.poses, 0, left_foot).position - pelvis), left);
    EXPECT_LT(worst[worst_beside].most, 0.01f);
    w.poses[0].position[hips][0][0] += 0.3f * left.x;
    w.poses[0].position[hips][2][0] += 0.3f * left.z;
    watch_walker(watches[1], w, 0);
    EXPECT_NEAR(worst[worst_beside].most, 1000 * (0.3f - out), 1);
    w.crowd.motion.turn_rate[0] = 1;
    WalkerWatch turns = watches[0];
    watch_walker(turns, w, 0);
    const float leans = (pelvis.y - w.crowd.motion.position[0].y) * 0.9f / k_gravity;
    EXPECT_NEAR(turns.worst[worst_beside].most, 1000 * (0.3f - out - leans), 1);

    bool is_told = false;
    for (const std::string& line : worst_places(watches))
        is_told =
            is_told || line == "root_slowing_max.m_s2 is 6: walker 1, tick 80; 1 beyond the goal of 3.5";
    EXPECT_TRUE(is_told);

    // And in the file, of each that has any.
    Report report = judge_crowd(watches, w, "a town");
    nlohmann::json json = nlohmann::json::parse(reports_json({report}), nullptr, false);
    int worst_told = 0;
    for (const nlohmann::json& q : json["trials"][0]["quantities"]) {
        EXPECT_EQ(q.contains("walker"), q.contains("second")) << q["name"];
        if (q["name"] == "root_slowing_max.m_s2" || q["name"] == "penetration_max.mm") {
            uint32_t tick = q["name"] == "penetration_max.mm" ? 81 : 80;
            EXPECT_EQ(q.value("walker", 9), 1) << q["name"];
            EXPECT_EQ(q.value("tick", 0u), tick) << q["name"];
            EXPECT_NEAR(q.value("second", 0.0), tick / 60.0, 1e-4) << q["name"];
            ++worst_told;
        }
        EXPECT_FALSE(q["name"] == "head_rise_steps_max.m_s" && q.contains("walker")) << "nobody's";
    }
    EXPECT_EQ(worst_told, 2);
}

}  // namespace
}  // namespace flaneur
