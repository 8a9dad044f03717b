#include <gtest/gtest.h>

#include "sim/base/tick.h"
#include "tools/flaneur/window/record/present.h"
#include "tools/flaneur/window/record/record.h"
#include "tools/flaneur/window/time/clock.h"

namespace flaneur {
namespace {

// Ticks of a film of so many pictures, whatever time each of them takes.
uint32_t ticks_of(Clock& clock, uint32_t step, uint32_t pictures, double each) {
    Record record;
    record.filming = Filming{};
    record.filming->step = step;
    uint32_t ticks = 0;
    for (uint32_t i = 0; i < pictures; ++i) {
        ticks += ticks_due(clock, seconds_to_pass(record, each));
        const bool is_usual = !clock.is_paused && clock.rate == 1;
        EXPECT_TRUE(!is_usual || between_pictures(record, clock) == 1) << "each tick as it is";
    }
    return ticks;
}

TEST(Filming, EachPictureIsItsStepsLater) {
    for (const double each : {0.0001, 1.0 / 60, 0.4, 30.0})
        for (const uint32_t step : {1u, 2u}) {
            Clock clock;
            EXPECT_EQ(ticks_of(clock, step, 1000, each), 1000 * step) << each;
            EXPECT_EQ(clock.kept_back, 0);
        }
    Clock slow{.rate = 0.5f}, fast{.rate = 16}, still{.is_paused = true};
    EXPECT_EQ(ticks_of(slow, 2, 300, 1), 300u);
    EXPECT_EQ(ticks_of(fast, 2, 100, 1), 3200u);
    EXPECT_EQ(ticks_of(still, 2, 100, 1), 0u);
    EXPECT_EQ(seconds_to_pass(Record{}, 0.25), 0.25) << "without a film time is what it is";
}

TEST(Filming, TellsHowLongTheFilmIs) {
    Filming filming;
    filming.step = 2, filming.began = 100;
    EXPECT_EQ(told_progress(filming, 100), "0.0 s, drawn in 0 s");
    filming.pictures = 60;
    EXPECT_EQ(told_progress(filming, 131), "2.0 s, drawn in 31 s");
    filming.all = 360;
    EXPECT_EQ(told_progress(filming, 131), "2.0 of 12 s, about 3 min to go") << "155 s";
    filming.pictures = 0;
    EXPECT_EQ(told_progress(filming, 100), "0.0 of 12 s");
}

TEST(Turntable, GoesOnceRoundAndComesBack) {
    Turntable turn;
    turn.middle = {3, 1, -2};
    turn.from.eye = {13, 6, -2};
    turn.from.target = {12, 5.5f, -2};
    turn.pictures = 360;
    for (uint32_t i = 0; i <= 360; i += 30) {
        const Camera camera = turned(turn, turn.middle, i);
        EXPECT_NEAR(glm::length(camera.eye - turn.middle), glm::length(turn.from.eye - turn.middle), 1e-3f);
        EXPECT_NEAR(camera.eye.y, 6, 1e-5f);
        EXPECT_NEAR(glm::length(camera.target - camera.eye), glm::length(turn.from.target - turn.from.eye),
                    1e-3f);
    }
    EXPECT_NEAR(glm::length(turned(turn, turn.middle, 360).eye - turn.from.eye), 0, 1e-3f);
    EXPECT_NEAR(glm::length(turned(turn, turn.middle, 180).eye - glm::vec3(-7, 6, -2)), 0, 1e-3f);
    const glm::vec3 walked(1, 0, 4);
    EXPECT_NEAR(glm::length(turned(turn, turn.middle + walked, 0).eye - turn.from.eye - walked), 0, 1e-4f);
}

TEST(Presentation, ViewsComeAndGoGently) {
    EXPECT_EQ(darkness_at(0), 1);
    EXPECT_EQ(darkness_at(k_view_seconds), 1);
    EXPECT_EQ(darkness_at(k_view_seconds / 2), 0);
    EXPECT_EQ(title_at(0), 0);
    EXPECT_EQ(title_at(4), 1);
    EXPECT_EQ(title_at(k_view_seconds), 0);
    Presentation p;
    p.from.eye = {0, 10, -50};
    p.middle = {0, 0, 0};
    p.from.target = {0, 9.8f, -49};
    constexpr double k_frame = 1.0 / 60;
    for (const bool goes_nearer : {false, true})
        for (p.seconds = 0; p.seconds < k_view_seconds; p.seconds += k_frame) {
            Presentation next = p;
            next.seconds += k_frame;
            const glm::vec3 now = presented(p, goes_nearer).eye, then = presented(next, goes_nearer).eye;
            EXPECT_LT(glm::length(then - now), 1 * k_frame) << "metres, at less than one a second";
            EXPECT_LT(std::abs(darkness_at(next.seconds) - darkness_at(p.seconds)), 0.05f) << "no flash";
        }
    p.middle = p.from.eye;
    EXPECT_EQ(presented(p, true).eye, p.from.eye) << "nothing is ahead";
}

TEST(Pictures, AreOfTheChosenSize) {
    PictureChoice choice;
    EXPECT_EQ(*size_of(choice, {700, 300}), (Size{700, 300}));
    choice.extent = Extent::uhd_8k;
    EXPECT_EQ(*size_of(choice, {700, 300}), (Size{7680, 4320}));
    choice.extent = Extent::typed;
    EXPECT_EQ(*size_of(choice, {700, 300}), (Size{1600, 900}));
    for (const char* typed : {"", "12", "0x5", "-3x4", "99999x9"}) {
        std::snprintf(choice.typed, sizeof choice.typed, "%s", typed);
        EXPECT_FALSE(size_of(choice, {700, 300})) << typed;
    }
}

TEST(Filming, TellsThatTimeWasStopped) {
    Filming filming;
    filming.step = 2, filming.pictures = 90;
    EXPECT_EQ(told_standstill(filming), "");
    filming.still = 45;
    EXPECT_EQ(told_standstill(filming), "; time was stopped in 1.5 s of it");
    filming.still = 90;
    EXPECT_EQ(told_standstill(filming), "; time was stopped in all of it");
}

}  // namespace
}  // namespace flaneur
