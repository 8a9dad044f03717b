#include <gtest/gtest.h>

#include <cmath>

#include "sim/ways/rays.h"
#include "tools/extract/ids.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/overlay/lettering.h"
#include "tools/flaneur/overlay/overlay.h"

namespace flaneur {
namespace {

TEST(Lettering, EveryLetterFitsItsLine) {
    for (char c = '!'; c <= '~'; ++c) {
        std::vector<GizmoLine> lines;
        add_text(lines, {}, std::string_view(&c, 1), ~0u, 6);
        EXPECT_FALSE(lines.empty()) << c;
        for (const GizmoLine& line : lines)
            for (glm::vec2 p : {line.shift_a, line.shift_b})
                EXPECT_TRUE(p.x >= 0 && p.x <= 4 && p.y >= -7 && p.y <= 2) << c << ": " << p.x << ", " << p.y;
    }
    EXPECT_FLOAT_EQ(text_width("no", 12), 2 * text_width("no", 6));
    EXPECT_GT(text_width("nono", 6), 2 * text_width("no", 6));
    EXPECT_EQ(text_width("", 6), 0);
}

// A few people in a small city, some seconds in.
class OverlayTest : public testing::Test {
  protected:
    void SetUp() override {
        Options options;
        Result<Scene> corner = load_scene("corner");
        ASSERT_TRUE(corner);
        options.scene = *corner;
        options.scene.walkers = 12;
        Result<Loaded> made = load(options);
        ASSERT_TRUE(made) << made.error().message;
        loaded = std::move(*made);
        for (int i = 0; i < 120; ++i) {
            step(*loaded.world);
            follow_trails(*loaded.world, overlay.trails);
        }
        const Vec3 p = loaded.world->crowd.motion.position[0];
        camera.eye = {p.x + 3, p.y + 4, p.z + 3};
        camera.target = {p.x, p.y, p.z};
    }
    FrameInput frame_of(WorkViews views) {
        extract_people(*loaded.world, loaded.characters, people);
        FrameInput frame;
        lay_over({*loaded.world, loaded.characters, camera}, views, people, overlay, frame);
        return frame;
    }
    Loaded loaded;
    Camera camera;
    PeopleFrame people;
    Overlay overlay;
};

TEST_F(OverlayTest, EachViewShowsSomethingAndNoneNothing) {
    const FrameInput none = frame_of({});
    EXPECT_TRUE(none.lines.empty() && none.fills.empty() && !none.are_ghosts);
    EXPECT_EQ(none.surfaces, Surfaces::lit);
    for (const char* name : {"density", "walkable", "trails", "skeletons", "gizmos"}) {
        const FrameInput frame = frame_of(parse_work_views({name}).value());
        EXPECT_GT(frame.lines.size() + frame.fills.size(), 100u) << name;
        EXPECT_EQ(frame.fills.size() % 3, 0u) << name;
        for (const GizmoLine& line : frame.lines)
            for (glm::vec3 p : {line.a, line.b})
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << name;
    }
}

// What the two documents draw: of one who staggers two circles and a third, of one who rambles rays.
TEST(Ways, AreDrawnOfThoseWithoutAGoal) {
    for (const char* scene : {"drunk-stride", "walker-report", "walker-curves"}) {
        Options options;
        options.scene = load_scene(scene).value();
        options.scene.walkers = 3;
        Result<Loaded> loaded = load(options);
        ASSERT_TRUE(loaded) << loaded.error().message;
        for (int tick = 0; tick < 120; ++tick) step(*loaded->world);
        Camera camera;
        camera.eye = {0, 8, 20};
        camera.target = {0, 0, 0};
        Overlay overlay;
        add_ways({*loaded->world, loaded->characters, camera}, overlay);
        size_t barred = 0, chosen = 0, free = 0;
        for (const GizmoLine& line : overlay.lines) {
            barred += line.colour == k_barred_colour;
            chosen += line.colour == k_chosen_colour;
            free += line.colour == k_free_colour;
        }
        if (std::string(scene) == "drunk-stride") {
            EXPECT_GT(barred, chosen);
            EXPECT_GT(chosen, 30u);
            EXPECT_EQ(free, 0u);
        } else {
            EXPECT_GE(barred + free, 3 * std::size(k_fan));
            EXPECT_GT(free, 0u);
            EXPECT_EQ(chosen, 0u);
        }
    }
}

// Of each who walks on the asteroid two rays, the normals that they met and their mean.
TEST(Ways, AreDrawnOnTheAsteroid) {
    Options options;
    options.scene = load_scene("asteroid").value();
    options.scene.walkers = 30;
    options.scene.creatures = 1;
    Result<Loaded> loaded = load(options);
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (int tick = 0; tick < 60; ++tick) step(*loaded->world);
    Camera camera;
    camera.eye = {0, 0, 30};
    camera.target = {0, 0, 0};
    Overlay overlay;
    add_ways({*loaded->world, loaded->characters, camera}, overlay);
    EXPECT_GT(overlay.lines.size(), 0u);
    EXPECT_EQ(overlay.lines.size() % 5, 0u);
}

// Trails lie on the rock, creatures have bones and speeds, and nothing is told of a ground plane.
TEST(SmallWorlds, ShowWhatThereIs) {
    Options options;
    options.scene = load_scene("planets").value();
    options.scene.walkers = 30;
    options.scene.creatures = 2;
    Result<Loaded> loaded = load(options);
    ASSERT_TRUE(loaded) << loaded.error().message;
    World& world = *loaded->world;
    Overlay overlay;
    for (int tick = 0; tick < 240; ++tick) {
        step(world);
        follow_trails(world, overlay.trails);
    }
    Camera camera;
    camera.eye = {20, 8, 30};
    camera.target = {0, 0, 0};
    PeopleFrame people;
    extract_people(world, loaded->characters, people);
    add_linkages(world.linkages, static_cast<uint32_t>(loaded->characters.size()), people);
    auto frame_of = [&](const char* view) {
        FrameInput frame;
        lay_over({world, loaded->characters, camera}, parse_work_views({view}).value(), people, overlay,
                 frame);
        return frame;
    };
    EXPECT_GT(frame_of("trails").lines.size(), 30u);
    EXPECT_GT(frame_of("skeletons").lines.size(), 2 * 31u);
    for (const char* none : {"density", "walkable"}) {
        EXPECT_EQ(frame_of(none).lines.size() + frame_of(none).fills.size(), 0u) << none;
        EXPECT_TRUE(legends_of(parse_work_views({none}).value(), world).empty()) << none;
    }
    frame_of("speed");
    size_t creatures = 0;
    for (const WalkerDraw& draw : people.walkers) {
        if (kind_of_id(draw.id) != IdKind::creature) continue;
        ++creatures;
        EXPECT_LT(number_of_id(draw.id), 2u);
        EXPECT_NE(draw.instance.tints[0], 0xffffffffu);
    }
    EXPECT_GE(creatures, 2u);
}

TEST_F(OverlayTest, BonesLieInTheirBodies) {
    frame_of(parse_work_views({"skeletons"}).value());
    for (uint32_t i = 0; i < 12; ++i)
        for (int j = 0; j < k_joint_count; ++j) {
            const Vec3 truth = joint_pose(loaded.world->poses, i, static_cast<Joint>(j)).position;
            const glm::vec3 drawn =
                joint_place({*loaded.world, loaded.characters, camera}, people, i, static_cast<Joint>(j));
            EXPECT_NEAR(glm::length(drawn - glm::vec3(truth.x, truth.y, truth.z)), 0, 1e-3f);
        }
}

TEST_F(OverlayTest, SpeedsColourPeople) {
    frame_of(parse_work_views({"speed"}).value());
    for (const WalkerDraw& walker : people.walkers)
        for (uint32_t tint : walker.instance.tints) EXPECT_EQ(tint, walker.instance.tints[0]);
}

}  // namespace
}  // namespace flaneur
