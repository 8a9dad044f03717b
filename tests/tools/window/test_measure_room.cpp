#include <gtest/gtest.h>
#include <imgui.h>

#include "renderer/view.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/change/hand.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/measure/moments.h"
#include "tools/flaneur/window/measure/plot.h"

namespace flaneur {
namespace {

constexpr Size k_size{800, 450};

// A hand that draws on the square of a small city, seen from above.
class MeasureRoomTest : public testing::Test {
  protected:
    void SetUp() override {
        ImGui::CreateContext();  // whose clock notes go by
        show.loaded = loaded_scene("corner", 20);
        const Vec3 at = show.loaded.world->crowd.motion.position[0];
        v.choice.kind = CameraChoice::Kind::fixed;
        v.camera = {.eye = {at.x, at.y + 30, at.z + 0.1f}, .target = {at.x, at.y, at.z}};
        v.room = Room::measure;
    }
    void TearDown() override { ImGui::DestroyContext(); }
    void frame(const Mouse& now) {
        draw_with_mouse(show, before, now, k_size, false, v);
        before = now;
    }
    void click(double x, double y) {
        frame({.x = x, .y = y, .is_held = true, .held_x = x, .held_y = y});
        frame({.x = x, .y = y, .held_x = x, .held_y = y, .has_clicked = true});
        v.measure.clicked_at = -1e9;  // not a double one
    }
    glm::vec2 pixel_of(glm::vec3 place) {
        const glm::vec4 at =
            make_view(v.camera, k_size.width, k_size.height).clip_from_world * glm::vec4(place, 1);
        return {(at.x / at.w * 0.5f + 0.5f) * k_size.width, (at.y / at.w * 0.5f + 0.5f) * k_size.height};
    }
    const MeasureRoom& room() const { return v.measure; }
    Show show;
    Viewer v;
    Mouse before;
};

TEST_F(MeasureRoomTest, TwoClicksMakeALineThatCounts) {
    take_tool(MarkingKind::line, v);
    click(300, 200), click(500, 260);
    ASSERT_EQ(room().drawn.size(), 1u);
    EXPECT_EQ(room().drawn[0].name, "L1");
    EXPECT_FALSE(room().tool) << "the next click selects";
    ASSERT_EQ(room().counts.lines.size(), 1u);
    EXPECT_EQ(room().counts.lines[0].line, plan_of(room().drawn).lines[0]);
    EXPECT_LT(glm::length(pixel_of(room().drawn[0].points[1]) - glm::vec2(500.5f, 260.5f)), 2);
    take_tool(MarkingKind::line, v);
    click(300, 300), click(500, 300);
    EXPECT_EQ(room().drawn[1].name, "L2");
}

// From so high above that a map of a whole city is seen.
TEST_F(MeasureRoomTest, LinesAreDrawnOnWideMapsToo) {
    CameraChoice map{CameraChoice::Kind::map, 0, {}, {}};
    map.across = 4000;
    v.camera = map_camera(*show.loaded.world, map, k_size);
    ASSERT_GT(v.camera.eye.y, 5000);
    take_tool(MarkingKind::line, v);
    click(395, 225), click(405, 225);
    ASSERT_EQ(room().drawn.size(), 1u);
    EXPECT_NEAR(length_of(room().drawn[0].points, false).flat, 10 * 4000.0 / k_size.width, 0.5);
}

TEST_F(MeasureRoomTest, AZoneEndsWhereItBegan) {
    take_tool(MarkingKind::zone, v);
    click(300, 200), click(500, 220), click(450, 320), click(302, 201);
    ASSERT_EQ(room().drawn.size(), 1u) << v.note;
    EXPECT_EQ(room().drawn[0].points.size(), 3u);
}

TEST_F(MeasureRoomTest, FlowsSayWhereToOnAMap) {
    const CountLine line{"L1", {0, 0}, {10, 0}};  // to the east
    EXPECT_STREQ(compass(line, 1), "S");
    EXPECT_STREQ(compass(line, -1), "N");
    EXPECT_STREQ(compass({"L1", {0, 0}, {-3, 3}}, 1), "NW");
    EXPECT_STREQ(compass({"L1", {0, 0}, {0, -3}}, 1), "E");
}

TEST_F(MeasureRoomTest, ZonesTakeCornersUntilTheyAreFinished) {
    take_tool(MarkingKind::zone, v);
    click(300, 150), click(500, 150), click(500, 300);
    EXPECT_TRUE(room().drawn.empty());
    undo_drawing(show, v);
    EXPECT_EQ(room().draft.size(), 2u);
    click(500, 320), click(310, 320);
    finish_draft(show, v);
    ASSERT_EQ(room().counts.zones.size(), 1u);
    EXPECT_EQ(room().counts.zones[0].zone.corners.size(), 4u);
    EXPECT_GT(room().counts.zones[0].area, 50);
    take_tool(MarkingKind::distance, v);
    click(300, 150), click(400, 150);
    EXPECT_TRUE(abandon_drawing(v)) << "the draft";
    EXPECT_TRUE(abandon_drawing(v)) << "the tool";
    EXPECT_FALSE(abandon_drawing(v));
    EXPECT_EQ(room().drawn.size(), 1u);
}

TEST_F(MeasureRoomTest, PointsAreDraggedAndAllIsUndone) {
    take_tool(MarkingKind::line, v);
    click(300, 200), click(500, 260);
    const std::vector<Marking> first = room().drawn;
    const glm::vec2 grip = pixel_of(first[0].points[1]);
    frame({.x = grip.x, .y = grip.y});
    EXPECT_EQ(room().handle, 1u);
    frame({.x = grip.x, .y = grip.y, .is_held = true, .held_x = grip.x, .held_y = grip.y});
    EXPECT_TRUE(room().is_dragging);
    const Mouse moved{.x = 520, .y = 300, .is_held = true, .held_x = grip.x, .held_y = grip.y};
    EXPECT_TRUE(draw_with_mouse(show, before, moved, k_size, false, v)) << "it does not turn the eye";
    before = moved;
    frame({.x = 520, .y = 300, .held_x = grip.x, .held_y = grip.y});
    EXPECT_FALSE(room().is_dragging);
    EXPECT_LT(glm::length(pixel_of(room().drawn[0].points[1]) - glm::vec2(520.5f, 300.5f)), 2);
    EXPECT_EQ(room().counts.lines[0].line, plan_of(room().drawn).lines[0]);
    const std::vector<Marking> second = room().drawn;
    undo_drawing(show, v);
    EXPECT_EQ(room().drawn, first);
    redo_drawing(show, v);
    EXPECT_EQ(room().drawn, second);
    undo_drawing(show, v);
    take_tool(MarkingKind::line, v);
    click(300, 300), click(500, 300);
    redo_drawing(show, v);
    EXPECT_EQ(room().drawn.size(), 2u) << "what is drawn anew leaves nothing to go on to";
    undo_drawing(show, v), undo_drawing(show, v);
    redo_drawing(show, v);
    v.measure.selected = 0;
    remove_selected(show, v);
    EXPECT_TRUE(room().drawn.empty() && room().counts.lines.empty());
    undo_drawing(show, v);
    EXPECT_EQ(room().drawn, first);
    EXPECT_EQ(room().counts.lines.size(), 1u);
}

TEST_F(MeasureRoomTest, KeysMayComeInTheMiddleOfADrag) {
    for (const bool is_removed : {false, true}) {
        take_tool(MarkingKind::line, v);
        click(300, 200), click(500, 260);
        const glm::vec2 grip = pixel_of(room().drawn.back().points[1]);
        frame({.x = grip.x, .y = grip.y});
        frame({.x = grip.x, .y = grip.y, .is_held = true, .held_x = grip.x, .held_y = grip.y});
        frame({.x = 520, .y = 300, .is_held = true, .held_x = grip.x, .held_y = grip.y});
        ASSERT_TRUE(room().is_dragging);
        if (is_removed)
            remove_selected(show, v);
        else
            EXPECT_TRUE(abandon_drawing(v));
        frame({.x = 540, .y = 300, .is_held = true, .held_x = grip.x, .held_y = grip.y});
        EXPECT_FALSE(room().is_dragging);
        EXPECT_EQ(plan_of(room().counts), plan_of(room().drawn)) << "what is drawn is what counts";
    }
    EXPECT_EQ(room().drawn.size(), 1u);
}

TEST_F(MeasureRoomTest, AZoneNeverCrossesItself) {
    take_tool(MarkingKind::zone, v);
    click(300, 150), click(500, 320), click(500, 150), click(310, 320);
    finish_draft(show, v);
    EXPECT_TRUE(room().drawn.empty());
    EXPECT_EQ(room().draft.size(), 4u) << "it can be mended";
    undo_drawing(show, v), undo_drawing(show, v);
    click(310, 320);
    finish_draft(show, v);
    ASSERT_EQ(room().drawn.size(), 1u);
    // A corner is dragged beyond the edge opposite.
    take_tool(MarkingKind::zone, v);
    click(560, 150), click(760, 150), click(760, 320), click(560, 320);
    finish_draft(show, v);
    const std::vector<Marking> whole = room().drawn;
    const glm::vec2 grip = pixel_of(whole.back().points[0]);
    frame({.x = grip.x, .y = grip.y});
    frame({.x = grip.x, .y = grip.y, .is_held = true, .held_x = grip.x, .held_y = grip.y});
    frame({.x = 790, .y = 240, .is_held = true, .held_x = grip.x, .held_y = grip.y});
    frame({.x = 790, .y = 240, .held_x = grip.x, .held_y = grip.y});
    EXPECT_EQ(room().drawn, whole) << "it goes back";
}

TEST_F(MeasureRoomTest, OptionsSayWhatIsDrawn) {
    take_tool(MarkingKind::line, v);
    click(300, 200), click(500, 260);
    const MeasurePlan plan = plan_of(room().drawn);
    const std::string words = options_of(plan);
    ASSERT_TRUE(words.starts_with("--line L1:")) << words;
    EXPECT_EQ(parse_count_line(words.substr(7)).value(), plan.lines[0]) << "to the last digit";
}

TEST_F(MeasureRoomTest, ElsewhereTheMouseIsFree) {
    v.room = Room::none;
    take_tool(MarkingKind::line, v);
    v.room = Room::layers;
    click(300, 200), click(500, 260);
    EXPECT_TRUE(room().drawn.empty() && room().draft.empty());
}

TEST_F(MeasureRoomTest, ACloseOfAStreetIsSeenBeforeTheClick) {
    v.room = Room::change;
    v.change.tool = AddedKind::barrier;
    bool is_seen = false;
    Mouse was;
    for (double x = 100; x < 800 && !is_seen; x += 50) {
        const Mouse now{.x = x, .y = 225};
        take_mouse(show, was, now, k_size, false, v);
        is_seen = v.change.ghost.has_value();
        was = now;
    }
    ASSERT_TRUE(is_seen);
    const Addition seen = *v.change.ghost;
    EXPECT_TRUE(current(v.change.designs).added.empty()) << "nothing is closed yet";
    const double x = was.x;
    take_mouse(show, was, {.x = x, .y = 225, .is_held = true, .held_x = x, .held_y = 225}, k_size, false, v);
    was.is_held = true;
    take_mouse(show, was, {.x = x, .y = 225, .has_clicked = true}, k_size, false, v);
    ASSERT_EQ(current(v.change.designs).added.size(), 1u);
    EXPECT_EQ(current(v.change.designs).added[0], seen) << "what was seen is what is closed";
    EXPECT_NE(v.note.find(crossed_by(*show.loaded.world->ground, seen)), std::string::npos) << v.note;
}

// As measures are drawn: one end, the other end. The first click by itself puts nothing down.
TEST_F(MeasureRoomTest, WallsAreDrawnByTwoClicksToo) {
    v.room = Room::change;
    v.change.tool = AddedKind::wall;
    Mouse was;
    auto click_at = [&](double x, double y) {
        for (const Mouse& now :
             {Mouse{.x = x, .y = y}, Mouse{.x = x, .y = y, .is_held = true, .held_x = x, .held_y = y},
              Mouse{.x = x, .y = y, .has_clicked = true}}) {
            take_mouse(show, was, now, k_size, false, v);
            was = now;
        }
    };
    click_at(300, 225);
    EXPECT_TRUE(current(v.change.designs).added.empty());
    EXPECT_FALSE(v.note.empty()) << "what to do next is said";
    click_at(301, 225);
    EXPECT_TRUE(current(v.change.designs).added.empty()) << "shorter than a wall may be";
    click_at(420, 240);
    ASSERT_EQ(current(v.change.designs).added.size(), 1u);
    EXPECT_GE(length(current(v.change.designs).added[0].to - current(v.change.designs).added[0].at), 0.5f);
    click_at(300, 300);
    EXPECT_TRUE(abandon_line(v)) << "Esc gives up what has one end";
    EXPECT_FALSE(abandon_line(v));
    click_at(500, 225);
    EXPECT_EQ(current(v.change.designs).added.size(), 1u) << "that was another first end";
}

TEST(Plot, TellsWhatACurveIsAt) {
    const std::vector<glm::vec2> points = {{0, 1}, {2, 3}, {2, 7}, {4, 7}};
    PlotCurve curve{"", 0, points};
    EXPECT_FLOAT_EQ(value_at(curve, 1).value(), 2);
    EXPECT_FLOAT_EQ(value_at(curve, 2).value(), 7) << "after a step";
    EXPECT_FLOAT_EQ(value_at(curve, 4).value(), 7);
    EXPECT_FALSE(value_at(curve, 4.1f));
    EXPECT_FALSE(value_at(curve, -0.1f));
    curve.is_stepped = true;
    EXPECT_FLOAT_EQ(value_at(curve, 1.9f).value(), 1);
    EXPECT_FALSE(value_at({"", 0, {}}, 0));
}

TEST(Charts, ShowTheMomentThatIsLookedAt) {
    auto is = [](Stretch s, double from, double to) {
        EXPECT_EQ(s.from, from);
        EXPECT_EQ(s.to, to);
    };
    is(plotted(600, 600, 600), 10, 70);         // just begun
    is(plotted(600, 6000, 6000), 10, 130);      // all of it
    is(plotted(600, 60000, 60000), 700, 1000);  // the last five minutes
    is(plotted(600, 60000, 48000), 700, 1000);  // in which an earlier moment is
    is(plotted(600, 60000, 30000), 350, 650);   // or those about it
    is(plotted(600, 60000, 660), 10, 310);
}

TEST(Charts, KnowTheirHighestMoments) {
    MeasureRoom room;
    EXPECT_FALSE(peak_of_zones(room, 0) || peak_of_lines(room, 0));
    ZoneCount zone;
    zone.zone.name = "Z1";
    zone.samples = {{60, 1, 0.1f, 0, 0}, {120, 4, 0.4f, 0, 0}, {180, 2, 0.2f, 0, 0}, {240, 4, 0.4f, 0, 0}};
    EXPECT_EQ(densest(zone, 0)->tick, 120u) << "the first of several";
    EXPECT_EQ(densest(zone, 121)->tick, 240u) << "as far as the past goes back";
    EXPECT_FALSE(densest(zone, 300));
    LineCount line;
    line.line.name = "L1";
    line.since = 300;
    for (const double seconds : {6.0, 7.0, 8.0, 9.0, 12.0, 31.0, 34.0, 47.0, 48.0, 49.0})
        line.crossings.push_back({seconds, 0, true, 1, {}});
    const std::optional<Height> most = fullest(line, 0, 49 * 60);
    ASSERT_TRUE(most);
    EXPECT_EQ(most->tick, 35 * 60u) << "the middle of a whole step";
    EXPECT_EQ(most->value, 12) << "a minute";
    EXPECT_EQ(fullest(line, 0, 50 * 60)->tick, 45 * 60u);
    EXPECT_FALSE(fullest(line, 0, 600));
    room.counts.zones = {zone}, room.counts.lines = {line}, room.counts.tick = 49 * 60;
    EXPECT_EQ(peak_of_zones(room, 0)->tick, 120u);
    EXPECT_EQ(peak_of_lines(room, 0)->told, "over L1 went most, 12 people a minute");
}

TEST(Plot, TimeHasStepsOfClocks) {
    EXPECT_EQ(time_step(60), 15);
    EXPECT_EQ(time_step(300), 60);
    EXPECT_EQ(time_step(3), 1);
    EXPECT_EQ(time_step(40000), 3 * 3600);
}

}  // namespace
}  // namespace flaneur
