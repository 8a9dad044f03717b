#include <gtest/gtest.h>

#include <algorithm>

#include "assets/trajectories/trajectories.h"
#include "sim/world.h"
#include "tests/folder.h"
#include "tests/sim/small_grounds.h"
#include "tools/flaneur/tracks/record.h"

namespace flaneur {
namespace {

TEST(Tracks, AreWhereEverybodyWas) {
    TestFolder folder;
    Result<WorldPtr> made = make_world_on(corridor(30, 4), {.capacity = 2, .threads = 1});
    ASSERT_TRUE(made);
    World& world = **made;
    const WalkerId first = *add_walker(world, {.place = Vec3{2, 0, 0.5f}});
    ASSERT_TRUE(send_to(world, first, {28, 0, 0.5f}));
    TrackRecord coarse, fine;
    for (auto [record, name, fps] : {std::tuple{&coarse, "coarse.csv", 25u}, {&fine, "fine.sqlite", 60u}}) {
        record->file = open_tracks(folder / name).value();
        ASSERT_TRUE(begin_tracks(*record, world, fps));
    }
    std::vector<Vec3> places{motion_of(world, first)->position};
    for (int tick = 1; tick <= 240; ++tick) {
        if (tick == 121) {
            ASSERT_TRUE(remove_walker(world, first));
            ASSERT_TRUE(add_walker(world, {.place = Vec3{20, 0, -1}}));
        }
        step(world);
        ASSERT_TRUE(add_tick(coarse, world));
        ASSERT_TRUE(add_tick(fine, world));
        places.push_back(motion_of(world, walkers(world)[0])->position);
    }
    ASSERT_TRUE(finish_tracks(std::move(coarse)));
    ASSERT_TRUE(finish_tracks(std::move(fine)));

    Result<Trajectories> a = read_trajectories(folder / "coarse.csv"),
                         b = read_trajectories(folder / "fine.sqlite");
    ASSERT_TRUE(a) << a.error().message;
    ASSERT_TRUE(b) << b.error().message;
    EXPECT_EQ(a->fps, 25);
    EXPECT_EQ(b->fps, 60);
    ASSERT_EQ(b->sightings.size(), 241u);
    for (size_t i = 0; i < 241; ++i) {
        const Sighting& s = b->sightings[i];
        EXPECT_EQ(s.frame, i);
        EXPECT_EQ(s.id, i <= 120 ? 0u : 2u) << "another walker, in the same slot of two";
        EXPECT_NEAR(s.at.x, places[i].x, 1e-4);
        EXPECT_NEAR(s.at.z, places[i].z, 1e-4);
    }
    ASSERT_EQ(b->area.size(), 1u);
    EXPECT_EQ(b->area[0].outer.size(), 4u);
    // A frame is 2.4 ticks. The fiftieth is tick 120; none lies between that and tick 121.
    ASSERT_EQ(a->sightings.size(), 101u);
    for (uint32_t f = 0; f <= 100; ++f) {
        const double tick = f * 2.4;
        const auto low = std::min<size_t>(static_cast<size_t>(tick + 1e-6), 239);
        const double share = tick - static_cast<double>(low);
        EXPECT_EQ(a->sightings[f].frame, f);
        EXPECT_NEAR(a->sightings[f].at.x, places[low].x + share * (places[low + 1].x - places[low].x), 2e-4)
            << f;
    }
}

TEST(Tracks, WhoIsNotThereAfterBothTicksIsLeftOut) {
    TestFolder folder;
    Result<WorldPtr> made = make_world_on(corridor(30, 4), {.capacity = 2, .threads = 1});
    ASSERT_TRUE(made);
    World& world = **made;
    TrackRecord record;
    record.file = open_tracks(folder / "a.txt").value();
    ASSERT_TRUE(begin_tracks(record, world, 25));
    for (int tick = 1; tick <= 12; ++tick) {
        if (tick == 3) {  // before frame 1, at 2.4
            ASSERT_TRUE(add_walker(world, {.place = Vec3{20, 0, -1}}));
        }
        step(world);
        ASSERT_TRUE(add_tick(record, world));
    }
    ASSERT_TRUE(finish_tracks(std::move(record)));
    Result<Trajectories> read = read_trajectories(folder / "a.txt");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->sightings[0].frame, 2u);
    EXPECT_EQ(read->sightings.size(), 4u);
}

TEST(Tracks, GoToFilesOfKnownKinds) {
    EXPECT_FALSE(open_tracks("a.dat"));
    EXPECT_TRUE(open_tracks(""));
    TestFolder folder;
    const std::string link = folder / "link.sqlite";
    std::filesystem::create_symlink("/dev/null", link);
    EXPECT_NE(open_tracks(link).error().message.find("name of a file"), std::string::npos);
}

}  // namespace
}  // namespace flaneur
