// Recordings as commands make and show them.
#include <gtest/gtest.h>

#include <map>

#include "assets/recording/recorder.h"
#include "sim/sim.h"
#include "sim/world.h"
#include "tests/folder.h"
#include "tests/tools/loaded.h"
#include "tools/flaneur/recording/difference.h"
#include "tools/flaneur/recording/playing.h"
#include "tools/flaneur/recording/program.h"
#include "tools/flaneur/recording/shown.h"
#include "tools/flaneur/recording/taking.h"

namespace flaneur {
namespace {

constexpr uint32_t k_recorded = 150;  // ticks

Options options_of(const char* scene, int walkers, const std::string& path, RecordedAs as, float error) {
    Options options;
    options.scene = load_scene(scene).value();
    options.scene.walkers = walkers;
    options.techniques = usual_techniques(options.scene.limbs);
    options.record = {path, as, error};
    return options;
}

std::vector<uint32_t> seen(const World& world) {
    ColumnTick tick;
    take_shown(world, world.poses, true, tick);
    return tick.words;
}

// Records a run; what was seen after some of its ticks.
using Moments = std::map<uint32_t, std::vector<uint32_t>>;
Moments record(const Options& options, void (*change)(World&, Taking&) = nullptr) {
    Moments moments;
    Result<Loaded> loaded = load(options);
    if (!loaded) {
        ADD_FAILURE() << loaded.error().message;
        return moments;
    }
    World& world = *loaded->world;
    Result<TakingPtr> taking = begin_taking(options, world);
    if (!taking) {
        ADD_FAILURE() << taking.error().message;
        return moments;
    }
    for (uint32_t tick = 0; tick <= k_recorded; ++tick) {
        if (tick > 0) {
            step(world);
            EXPECT_TRUE(take(**taking, world));
        }
        if (tick % 10 < 2) moments[tick] = seen(world);
        if (tick == 65 && change) change(world, **taking);
    }
    const Result<void> finished = finish_taking(std::move(*taking));
    EXPECT_TRUE(finished) << finished.error().message;
    return moments;
}

// From any tick to any other what is seen is as it was, to the last bit.
void expect_seen(const Options& options, const Moments& moments) {
    Result<PlayingPtr> playing = open_playing(options.record.path, 2);
    ASSERT_TRUE(playing) << playing.error().message;
    EXPECT_EQ((*playing)->first, 0u);
    EXPECT_EQ((*playing)->last, k_recorded);
    Result<Loaded> loaded = load(options);
    ASSERT_TRUE(loaded);
    for (const uint32_t tick : {0u, 1u, 31u, 100u, 101u, 90u, 150u, 20u, 21u, 61u, 71u}) {
        const Result<void> shown = show_tick(**playing, *loaded->world, tick);
        ASSERT_TRUE(shown) << shown.error().message;
        EXPECT_EQ(loaded->world->tick, tick);
        EXPECT_TRUE(seen(*loaded->world) == moments.at(tick)) << options.scene.name << ", tick " << tick;
    }
    EXPECT_FALSE(show_tick(**playing, *loaded->world, k_recorded + 1));
}

TEST(Recording, OfMotionToTheLastBitIsSeenAsItWas) {
    const TestFolder folder;
    for (const auto& [scene, walkers] :
         {std::pair("life", 60), std::pair("asteroid", 20), std::pair("ik-gallery", 5)}) {
        const Options options = options_of(scene, walkers, folder / scene, RecordedAs::motion, 0);
        expect_seen(options, record(options));
    }
}

TEST(Recording, OfInputsIsRepeatedWithWhatCameFromOutside) {
    const TestFolder folder;
    const Options options = options_of("corner", 40, folder / "a", RecordedAs::inputs, 0);
    const auto change = [](World& world, Taking& taking) {
        for (uint32_t w = 0; w < 8; ++w) push(world, world.crowd.slots.living[w], {250, 40});
        note_change(taking, world);
    };
    const Moments changed = record(options, change);
    expect_seen(options, changed);
    const Options other = options_of("corner", 40, folder / "b", RecordedAs::inputs, 0);
    EXPECT_FALSE(record(other).at(150) == changed.at(150)) << "who is pushed goes elsewhere";
    const Result<void> same = compare_recordings(folder / "a", folder / "b", 0, options);
    ASSERT_FALSE(same);
    EXPECT_NE(same.error().message.find("part at tick 66: walker"), std::string::npos)
        << same.error().message;
}

TEST(Recording, OfMotionIsWithinItsBound) {
    const TestFolder folder;
    Options options = options_of("life", 60, folder / "a", RecordedAs::motion, 0.001f);
    record(options);
    Options exact = options;
    exact.record = {folder / "b", RecordedAs::motion, 0};
    record(exact);
    const Result<void> near = compare_recordings(folder / "a", folder / "b", 0.0021f,
                                                 options);  // 1 mm of the hips, and of joints from there
    EXPECT_TRUE(near) << near.error().message;
    const Result<void> nearer = compare_recordings(folder / "a", folder / "b", 0.0002f, options);
    EXPECT_FALSE(nearer);
}

TEST(Recording, OfInputsIsRefusedByAnotherVersion) {
    const TestFolder folder;
    for (const auto& [as, is_refused] :
         {std::pair(RecordedAs::inputs, true), std::pair(RecordedAs::motion, false)}) {
        const RecordingHead head{"0.0.7 (abc)", as, "corner", scene_text(load_scene("corner").value()),
                                 false,         0,  0};
        const std::string path = folder / (is_refused ? "a" : "b");
        Result<RecorderPtr> recorder = begin_recorder(path, recording_head(head));
        ASSERT_TRUE(recorder);
        ASSERT_TRUE(finish_recorder(std::move(*recorder)));
        const Result<PlayingPtr> playing = open_playing(path, 1);
        ASSERT_FALSE(playing);
        const std::string& why = playing.error().message;
        EXPECT_EQ(why.find("0.0.7 (abc)") != std::string::npos, is_refused) << why;
        EXPECT_EQ(why.find(this_program()) != std::string::npos, is_refused) << why;
        EXPECT_EQ(why.find("holds no tick") != std::string::npos, !is_refused) << why;
    }
}

TEST(Recording, OfInputsEndsWhereItCannotTellWhatChanged) {
    const TestFolder folder;
    const Options options = options_of("corner", 20, folder / "a", RecordedAs::inputs, 0);
    Result<Loaded> loaded = load(options);
    ASSERT_TRUE(loaded);
    World& world = *loaded->world;
    Result<TakingPtr> taking = begin_taking(options, world);
    ASSERT_TRUE(taking);
    step(world);
    EXPECT_TRUE(take(**taking, world));
    set_hour(world, 3);
    note_change(**taking, world);
    step(world);
    EXPECT_FALSE(take(**taking, world));
    const Result<void> finished = finish_taking(std::move(*taking));
    ASSERT_FALSE(finished);
    EXPECT_NE(finished.error().message.find("ends at tick 1"), std::string::npos) << finished.error().message;
}

}  // namespace
}  // namespace flaneur
