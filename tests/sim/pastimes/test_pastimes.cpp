// People of a small square who sit, lean, look, line up and use phones, over many ticks and seeds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/deeds/bend.h"
#include "sim/fields.h"
#include "sim/pastimes/handheld.h"
#include "sim/pastimes/pastimes.h"
#include "sim/pastimes/seated.h"
#include "sim/pose/joint_limits.h"
#include "sim/state.h"
#include "sim/world.h"
#include "tests/sim/allocations.h"
#include "tests/sim/small_grounds.h"

namespace flaneur {
namespace {

constexpr Vec3 k_benches[] = {{-6, 0, -4}, {0, 0, -4}, {6, 0, -4}};

PastimePlaces places() {
    PastimePlaces all;
    for (uint32_t b = 0; b < 3; ++b)
        for (const float x : {-0.6f, 0.0f, 0.6f})
            all.seats.push_back({k_benches[b] + Vec3{x, 0.46f, 0.21f}, {0, 1}, 0.44f, b, x == 0 ? 1u : 0u});
    for (const float x : {-8.0f, -4.0f}) all.windows.push_back({{x, 0, 29.9f}, {0, -1}, 1.9f});
    all.services.push_back({{5, 0, 29.1f}, {0, 1}, {1, 0}, 12});
    all.sights.push_back({0, 0, 4});
    return all;
}

std::unique_ptr<World> made(const PastimeShares& shares, uint64_t seed = 1, uint32_t walkers = 50,
                            int threads = 1) {
    Ground ground = square(60);
    for (const Vec3 at : k_benches) ground.obstacles.push_back({at, 0, {0.8f, 0.3f}});
    index_ground(ground);
    WorldOptions options{.walkers = walkers, .seed = seed, .threads = threads};
    options.kinds = {{.body = standard_body(1.78f), .share = 2, .age = 30},
                     {.body = standard_body(1.64f), .share = 2, .age = 40, .woman = true},
                     {.body = standard_body(1.3f), .share = 1, .age = 9}};
    for (const Vec3 at : k_benches)
        options.destinations.push_back({DestinationKind::bench, at + Vec3{0, 0, 0.8f}, {0, 1}, 1});
    for (const float x : {-26.0f, -6.0f, 6.0f, 26.0f})
        options.destinations.push_back({DestinationKind::square, {x, 0, 28.5f}, {0, 1}, 1});
    for (const float x : {-28.5f, 28.5f})
        options.destinations.push_back({DestinationKind::square, {x, 0, -28}, {1, 0}, 1});
    options.pastimes = shares;
    options.pastime_places = places();
    auto world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    EXPECT_TRUE(world) << world.error().message;
    return std::move(*world);
}

const PastimeShares k_all{1, 1, 0.3f, 1, 0.2f}, k_and_haste{1, 1, 0.3f, 1, 0.2f, 1, 0.3f, 0.3f};

TEST(Pastimes, SwitchedOffNothingChanges) {
    // Places alone do nothing; and worlds without shares are as they were.
    auto with = made({}), without = made({});
    set_places(*without->pastimes, {}, *without->navmesh, without->crowd);
    for (int tick = 0; tick < 300; ++tick) step(*with), step(*without);
    EXPECT_EQ(hash_world(*with), hash_world(*without));
    EXPECT_TRUE(with->pastimes->all.empty());
}

TEST(Pastimes, AreTheSameForAnyNumberOfThreadsAndGoOnFromAState) {
    auto one = made(k_and_haste, 5, 50, 1), four = made(k_and_haste, 5, 50, 4);
    std::vector<std::byte> kept;
    for (int tick = 0; tick < 2400; ++tick) {
        step(*one), step(*four);
        if (tick == 1500) save_state(*one, kept);
    }
    EXPECT_FALSE(one->pastimes->all.empty());
    EXPECT_EQ(hash_world(*one), hash_world(*four));
    ASSERT_TRUE(load_state(*four, kept));
    while (four->tick < one->tick) step(*four);
    EXPECT_EQ(hash_world(*one), hash_world(*four));
}

TEST(Pastimes, AllocateNothing) {
    auto world = made(k_and_haste, 2);
    for (int tick = 0; tick < 600; ++tick) step(*world);
    const size_t before = allocations();
    for (int tick = 0; tick < 1800; ++tick) step(*world);
    EXPECT_EQ(allocations(), before);
}

// Whoever hurries is faster by a quarter, who strolls slower by as much; and nobody is either when it is
// over.
TEST(Pastimes, HurryAndStroll) {
    auto world = made({.hurrying = 0.4f, .strolling = 0.4f}, 3);
    World& w = *world;
    const std::vector<float> usual = w.crowd.identity.preferred_speed;
    double went[4] = {};
    int ticks[4] = {};
    for (int tick = 0; tick < 3600; ++tick) {
        step(w);
        for (const WalkerId id : w.crowd.slots.living) {
            const Pastime* p = own_of(w.pastimes->all, id.index);
            const auto haste = static_cast<size_t>(p ? p->haste : Haste::usual);
            const float speed = length(w.crowd.motion.velocity[id.index]);
            if (speed < 0.6f) continue;
            went[haste] += wide(speed / usual[id.index]), ++ticks[haste];
        }
    }
    for (int k = 0; k < 3; ++k) EXPECT_GT(ticks[k], 1000);
    EXPECT_NEAR(went[2] / ticks[2] / (went[0] / ticks[0]), 1.25, 0.12);
    EXPECT_NEAR(went[1] / ticks[1] / (went[0] / ticks[0]), 0.76, 0.1);
    set_shares(*w.pastimes, {}, w.crowd);
    for (int tick = 0; tick < 120; ++tick) step(w);
    EXPECT_EQ(w.crowd.identity.preferred_speed, usual);
}

// Those who are strangers look up at houses, with their heads; nobody does it on the spot for ever.
TEST(Pastimes, StrangersLookUpAtHouses) {
    Ground ground = corridor(80, 12);
    index_ground(ground);
    WorldOptions options{.walkers = 30, .seed = 2, .threads = 1};
    options.pastimes = {.tourists = 1};
    auto made_world = make_world(std::make_shared<const Ground>(std::move(ground)), options);
    ASSERT_TRUE(made_world) << made_world.error().message;
    World& w = **made_world;
    int looks = 0, up = 0;
    for (int tick = 0; tick < 7200; ++tick) {
        step(w);
        for (const Pastime& p : w.pastimes->all) {
            if (p.what != Staying::marvels || p.phase != StayPhase::stays) continue;
            ++looks;
            EXPECT_LT(w.tick - p.began, 12 * 60u);
            const Vec3 sees = rotate(joint_pose(w.poses, p.walker, head).rotation, {0, 0, 1});
            up += w.tick - p.began > 90 && sees.y > 0.3f;
        }
    }
    std::printf("%d ticks of looking, %d with the head up\n", looks, up);
    EXPECT_GT(looks, 1000);
    EXPECT_GT(up, looks / 3);
}

struct Seen {
    uint32_t sat = 0, leant = 0, looked = 0, glanced = 0, queued = 0, photographed = 0, middles_first = 0;
    float off_seat = 0, slid = 0, fastest = 0, off_wall = 0;
    uint64_t phone_ticks = 0, ticks = 0;
};

void check_seat(const World& w, const Pastime& p, Seen& seen) {
    const Seat& seat = w.pastimes->places.seats[p.place];
    const Someone who{w.gait.people[p.walker / k_block], static_cast<int>(p.walker % k_block)};
    for (const Joint hip : {left_upper_leg, right_upper_leg}) {
        const Vec3 at = joint_pose(w.poses, p.walker, hip).position;
        seen.off_seat = std::max(seen.off_seat, std::fabs(at.y - seat.edge.y - seat_of(who)));
        EXPECT_LT(dot(on_ground(at - seat.edge), seat.facing), 0);
    }
}

// The fastest that a leg's joint turns, rad/s.
float fastest_leg(const World& w, uint32_t walker) {
    float most = 0;
    for (int j = left_upper_leg; j < k_joint_count; ++j) {
        auto turn = [&](const std::vector<PoseBlock>& poses) {
            const auto parent = static_cast<Joint>(k_joint_parents[static_cast<size_t>(j)]);
            return conjugate(joint_pose(poses, walker, parent).rotation) *
                   joint_pose(poses, walker, static_cast<Joint>(j)).rotation;
        };
        const float same = std::fabs(dot(turn(w.previous_poses), turn(w.poses)));
        most = std::max(most, 2 * arccos(clamp(same, -1, 1)) / k_tick);
    }
    return most;
}

// What each did, and where who sits stood before, a tick earlier.
struct Earlier {
    std::vector<Staying> was;
    std::vector<Vec3> stood;
};

void watch(World& w, uint32_t ticks, Seen& seen, Earlier& earlier) {
    auto& [was, stood] = earlier;
    was.resize(w.crowd.count, Staying::nowhere);
    stood.resize(w.crowd.count);
    for (uint32_t t = 0; t < ticks; ++t) {
        step(w);
        std::vector<uint32_t> on_seat(w.pastimes->places.seats.size(), 0);
        for (const WalkerId id : w.crowd.slots.living) {
            const uint32_t i = id.index;
            const Pastime* p = own_of(w.pastimes->all, i);
            ++seen.ticks;
            seen.phone_ticks += p && p->phone != PhoneUse::none;
            const Staying what = p && p->phase != StayPhase::over ? p->what : Staying::nowhere;
            if (what == Staying::sits) {
                ++on_seat[p->place];
                if (p->phase == StayPhase::stays) check_seat(w, *p, seen);
                if (p->phase != StayPhase::comes) {
                    seen.fastest = std::max(seen.fastest, fastest_leg(w, i));
                    if (stood[i] != Vec3{})
                        seen.slid = std::max(seen.slid, length(w.crowd.motion.position[i] - stood[i]));
                    stood[i] = w.crowd.motion.position[i];
                }
            } else {
                stood[i] = {};
            }
            if (what == Staying::leans && p->phase == StayPhase::stays) {
                const float back = w.gait.people[i / k_block].girth[2][i % k_block];
                const Vec3 at = joint_pose(w.poses, i, hips).position;
                const float off = dot(on_ground(at - p->at), p->facing) - back;
                seen.off_wall = std::max(seen.off_wall, std::fabs(off));
            }
            if (what != was[i] && p && p->phase != StayPhase::over) {
                seen.sat += what == Staying::sits, seen.leant += what == Staying::leans;
                seen.looked += what == Staying::looks, seen.glanced += what == Staying::glances;
                seen.queued += what == Staying::queues, seen.photographed += what == Staying::photographs;
                if (what == Staying::sits && w.pastimes->places.seats[p->place].rank > 0) {
                    const uint32_t middle = p->place;
                    const auto& at = w.pastimes->at_seat;
                    seen.middles_first += at[middle - 1] == 0 || at[middle + 1] == 0;
                }
            }
            was[i] = what;
        }
        for (const uint32_t there : on_seat) EXPECT_LE(there, 1u);
    }
}

TEST(Pastimes, WhoSitsIsOnTheSeatAndNobodyElseIs) {
    Seen seen;
    for (const uint64_t seed : {1u, 2u, 3u}) {
        auto world = made(k_all, seed);
        Earlier earlier;
        watch(*world, 7200, seen, earlier);
    }
    std::printf(
        "%u sat, %u leant, %u looked, %u glanced, %u lined up, %u took pictures; off seats %.1f mm, off "
        "walls "
        "%.1f mm, slid %.2f mm, legs %.1f rad/s, phones %.1f %%\n",
        seen.sat, seen.leant, seen.looked, seen.glanced, seen.queued, seen.photographed,
        wide(seen.off_seat * 1000), wide(seen.off_wall * 1000), wide(seen.slid * 1000), wide(seen.fastest),
        100.0 * static_cast<double>(seen.phone_ticks) / static_cast<double>(seen.ticks));
    EXPECT_GT(seen.sat, 8u);
    EXPECT_GT(seen.leant, 0u);
    EXPECT_GT(seen.looked + seen.glanced, 0u);
    EXPECT_GT(seen.queued, 3u);
    EXPECT_EQ(seen.middles_first, 0u);
    EXPECT_LT(seen.off_seat, 0.02f);
    EXPECT_LT(seen.off_wall, 0.02f);
    EXPECT_LT(seen.slid, 0.0005f);
    EXPECT_LT(seen.fastest, k_fastest_walking);
    const double phones = static_cast<double>(seen.phone_ticks) / static_cast<double>(seen.ticks);
    EXPECT_GT(phones, 0.1);
    EXPECT_LT(phones, 0.4);
}

// Palms are on the railing, nobody has another's place, feet do not slide and eyes go out over it.
TEST(Pastimes, WhoLooksOverARailingHasBothHandsOnIt) {
    auto world = made({.leaning = 1}, 6, 40);
    World& w = *world;
    PastimePlaces all = places();
    for (int n = -33; n <= 33; ++n) all.railings.push_back({{0.8f * static_cast<float>(n), 1, 30}, {0, 1}});
    set_places(*w.pastimes, all, *w.navmesh, w.crowd);
    uint32_t ticks = 0, came = 0, ahead = 0;
    float off = 0, least_in = 1, most_in = 0, fastest = 0;
    for (int tick = 0; tick < 7200; ++tick) {
        step(w);
        std::vector<uint32_t> there(all.railings.size(), 0);
        for (const Pastime& p : w.pastimes->all) {
            if (p.what != Staying::leans_out || p.phase == StayPhase::over) continue;
            EXPECT_LE(++there[p.place], 1u);
            if (p.phase == StayPhase::comes) continue;
            fastest = std::max(fastest, fastest_leg(w, p.walker));
            if (p.phase != StayPhase::stays) continue;
            came += w.tick - p.began == 1, ++ticks;
            const Someone who{w.gait.people[p.walker / k_block], static_cast<int>(p.walker % k_block)};
            for (const Side side : {k_left, k_right}) {
                if (side == k_right && p.phone != PhoneUse::none) continue;
                const Vec3 palm = palm_of(body_pose_of(w.poses, p.walker), who, side).place;
                off = std::max(off, std::fabs(palm.y - 1));
                least_in = std::min(least_in, palm.z - 30), most_in = std::max(most_in, palm.z - 30);
            }
            ahead += rotate(joint_pose(w.poses, p.walker, head).rotation, {0, 0, 1}).z > 0.7f;
        }
    }
    std::printf(
        "%u leant out, for %.0f s; palms %.1f mm off the railing, %.0f to %.0f mm in; legs %.1f rad/s\n",
        came, wide(static_cast<float>(ticks) * k_tick), wide(off * 1000), wide(least_in * 1000),
        wide(most_in * 1000), wide(fastest));
    EXPECT_GT(came, 3u);
    EXPECT_LT(off, 0.01f);
    EXPECT_GT(least_in, 0.03f);
    EXPECT_LT(most_in, 0.12f);
    EXPECT_LT(fastest, k_fastest_walking);
    EXPECT_GT(ahead, ticks * 9 / 10);
}

TEST(Pastimes, WhoTextsIsSlowerAndLooksDown) {
    auto world = made({.phones = 1}, 4, 30);
    double texting = 0, usual = 0;
    uint32_t texters = 0;
    for (int tick = 0; tick < 1800; ++tick) {
        step(*world);
        for (const Pastime& p : world->pastimes->all) {
            if (p.phone != PhoneUse::texts || phone_out(p, world->tick) < 1) continue;
            if (p.usual_speed > 0) {
                texting += wide(world->crowd.identity.preferred_speed[p.walker]),
                    usual += wide(p.usual_speed);
                ++texters;
            }
            if (p.heed < 1 || p.gaze.pitch > -0.4f) continue;
            const Vec3 ahead = rotate(joint_pose(world->poses, p.walker, head).rotation, Vec3{0, 0, 1});
            const float down = -arctan2(ahead.y, std::sqrt(1 - ahead.y * ahead.y)) / k_radians;
            EXPECT_GT(down, 22) << p.walker;
            EXPECT_LT(down, 43) << p.walker;
        }
    }
    ASSERT_GT(texters, 1000u);
    // 15 .. 30 % slower (Lamberg & Muratori 2012).
    EXPECT_GT(texting / usual, 0.7);
    EXPECT_LT(texting / usual, 0.85);
}

TEST(PastimesLong, TenMinutesKeepToTheSharesAndNobodyIsStuck) {
    Seen seen;
    uint32_t stuck = 0, late = 0;
    float shortest = 1e9f, longest = 0;
    for (const uint64_t seed : {1u, 2u}) {
        auto world = made({1, 0.5f, 0.2f, 1, 0.1f}, seed);
        Earlier earlier;
        for (int minute = 0; minute < 60; ++minute) {
            watch(*world, 600, seen, earlier);
            for (const WalkerId id : world->crowd.slots.living) {
                const Journey& j = world->crowd.journeys[id.index];
                const bool waits = world->tick < j.pause_until || j.path_due != PathDue::no;
                stuck += !waits && world->tick - j.closest_tick > 25 * 60;
            }
            for (const Pastime& p : world->pastimes->all)
                late += p.phase == StayPhase::comes && p.what != Staying::queues &&
                        p.what != Staying::nowhere && world->tick - p.began > 16 * 60;
            for (const Pastime& p : world->pastimes->all) {
                if (p.what != Staying::sits || p.phase != StayPhase::stays) continue;
                const float stays = static_cast<float>(p.until - p.began) * k_tick;
                const float usual = stays / world->crowd.identity.linger[p.walker];
                shortest = std::min(shortest, usual), longest = std::max(longest, usual);
            }
        }
    }
    const double phones = static_cast<double>(seen.phone_ticks) / static_cast<double>(seen.ticks);
    std::printf(
        "%u sat for %.0f to %.0f s, %u leant, %u looked, %u glanced, %u lined up, %u took pictures; phones "
        "%.1f %%\n",
        seen.sat, wide(shortest), wide(longest), seen.leant, seen.looked, seen.glanced, seen.queued,
        seen.photographed, 100 * phones);
    EXPECT_EQ(stuck, 0u);
    EXPECT_EQ(late, 0u);
    EXPECT_GT(shortest, 105);
    EXPECT_LT(longest, 910);
    EXPECT_LT(seen.off_seat, 0.02f);
    EXPECT_GT(phones, 0.12);
    EXPECT_LT(phones, 0.28);
    EXPECT_GT(seen.glanced, 2 * seen.looked);
}

}  // namespace
}  // namespace flaneur
