// Where people of cities sit: on what is there, at heights that one sits at, with ground for the feet.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "assets/cities.h"
#include "assets/osm/map.h"
#include "assets/pastimes/places.h"
#include "assets/quayside.h"
#include "sim/base/math.h"
#include "sim/pastimes/pastimes.h"
#include "sim/world.h"
#include "tests/assets/osm_drawing.h"

namespace flaneur {
namespace {

std::array<int, 5> count(const std::vector<Seat>& seats) {
    std::array<int, 5> counts{};
    for (const Seat& s : seats) ++counts[static_cast<size_t>(s.on)];
    return counts;
}

// How many of them one gets to, of each kind.
std::array<int, 5> reached(const City& city) {
    WorldOptions options{.walkers = 1, .seed = 1, .threads = 1};
    options.pastime_places = pastime_places(city);
    auto world = make_world(std::shared_ptr<const Ground>(&city.ground, [](const Ground*) {}), options);
    EXPECT_TRUE(world) << world.error().message;
    std::array<int, 5> counts{};
    const Pastimes& all = *(*world)->pastimes;
    for (size_t s = 0; s < all.before_seat.size(); ++s)
        counts[static_cast<size_t>(all.places.seats[s].on)] += all.before_seat[s].polygon != 0;
    return counts;
}

void expect_fit(const City& city, const std::vector<Seat>& seats) {
    for (const Seat& s : seats) {
        const Vec2 at = on_ground(s.edge);
        auto ground = [&](float ahead) {
            return ground_at(city.ground, at_height(at + s.facing * ahead, s.edge.y), 0.01f, 1);
        };
        if (s.on == SeatOn::steps) {
            const auto own = ground(-0.1f), next = ground(0.5f * s.tread), feet = ground(1.5f * s.tread);
            ASSERT_TRUE(own && next && feet);
            EXPECT_NEAR(own->height, s.edge.y, 0.005f);
            EXPECT_GT(s.edge.y - next->height, 0.09f);
            EXPECT_LT(s.edge.y - next->height, 0.21f);
            EXPECT_NEAR(s.edge.y - feet->height, 2 * (s.edge.y - next->height), 0.01f);
        } else if (s.on == SeatOn::wall) {
            const auto feet = ground(0.3f);
            ASSERT_TRUE(feet);
            EXPECT_NEAR(s.edge.y - feet->height, 0.475f, 0.13f);
            // The stone is there: a hand's breadth under the edge, and no more over it.
            const auto below = closest_wall(city.ground, s.edge - Vec3{0, 0.1f, 0}, 0.02f);
            EXPECT_TRUE(below);
            EXPECT_FALSE(closest_wall(city.ground, s.edge + Vec3{0, 0.05f, 0}, 0.02f));
        }
    }
}

void tell(const char* name, const City& city) {
    const auto seats = pastime_places(city).seats;
    const auto all = count(seats), there = reached(city);
    std::printf(
        "%s: seats of benches %d of %d, fountains %d of %d, planters %d of %d, walls %d of %d, steps "
        "%d of %d\n",
        name, there[0], all[0], there[1], all[1], there[2], all[2], there[3], all[3], there[4], all[4]);
}

TEST(Seats, AreOnWallsStepsAndPlantersOfCities) {
    const City quay = build_quayside(1), town = generate_district({.seed = 1, .blocks = 3});
    for (const auto& [name, city] : {std::pair{"quayside", &quay}, std::pair{"district", &town}}) {
        tell(name, *city);
        const auto seats = pastime_places(*city).seats;
        expect_fit(*city, seats);
        EXPECT_GT(count(seats)[4], 10);
        EXPECT_GT(count(seats)[2], 10);
        for (const SeatOn on : {SeatOn::planter, SeatOn::steps}) {
            const auto kind = static_cast<size_t>(on);
            EXPECT_GE(reached(*city)[kind], 0.65 * count(seats)[kind]) << kind;
        }
    }
}

City drawn(const Drawing& d, const std::function<float(Vec2)>& terrain = {}) {
    Result<OsmMap> map = parse_osm(osm_of(d), "osm");
    EXPECT_TRUE(map) << map.error().message;
    OsmImport in{*map, projection_about(0, 0), {}, {}, {}};
    in.plan.low = {-60, -60}, in.plan.high = {60, 60};
    in.plan.cell = 16;
    in.plan.terrain = terrain;
    add_osm_outdoors(in);
    return std::move(in.city);
}

TEST(Seats, AreOnLowWallsOfMapsAndNotOnHighThinOrSlopingOnes) {
    for (const auto& [height, sits] :
         {std::pair{"0.5", true}, std::pair{"0.45", true}, std::pair{"1.2", false}}) {
        Drawing d;
        d.way({{-30, 8}, {30, 8}}, tag("barrier", "wall") + tag("height", height));
        d.way({{-30, -8}, {30, -8}}, tag("barrier", "handrail") + tag("height", height));
        d.way({{-60, 0}, {60, 0}}, tag("highway", "pedestrian") + tag("width", "6"));
        const City city = drawn(d);
        tell(height, city);
        const auto seats = pastime_places(city).seats;
        expect_fit(city, seats);
        EXPECT_EQ(seats.size() > 40, sits);
        for (size_t a = 0; a < seats.size(); ++a)
            for (size_t b = 0; b < a; ++b) EXPECT_GT(length(seats[a].edge - seats[b].edge), 0.5f);
    }
}

// People look out over the quay's parapet, and over nothing else there.
TEST(Seats, RailingsAreWhereOneLooksOut) {
    const City quay = build_quayside(1);
    const auto railings = pastime_places(quay).railings;
    EXPECT_GT(railings.size(), 50u);
    for (const Railing& r : railings) {
        EXPECT_GT(r.facing.z, 0.99f);
        const Vec2 at = on_ground(r.at);
        const auto before = ground_at(quay.ground, at_height(at - r.facing * 0.4f, r.at.y), 0, 1.3f);
        ASSERT_TRUE(before);
        EXPECT_NEAR(r.at.y - before->height, 1.05f, 0.15f);
        const auto beyond = ground_at(quay.ground, at_height(at + r.facing, r.at.y), 0, 1.9f);
        EXPECT_TRUE(!beyond || beyond->kind == Surface::water);
    }
}

// Of those who walk on a flight everybody passes by all who sit there: sideways metres that stay free.
TEST(Seats, LeaveRoomOnFlights) {
    constexpr float k_half_body = 0.25f;
    for (const float width : {2.6f, 3.0f, 3.4f, 3.8f, 5.2f, 8.0f}) {
        Drawing d;
        const int a = d.node(0, 30), b = d.node(0, 12), c = d.node(0, -12), e = d.node(0, -30);
        d.way({a, b}, tag("highway", "footway") + tag("width", std::to_string(width)));
        d.way({b, c},
              tag("highway", "steps") + tag("width", std::to_string(width)) + tag("step_count", "48"));
        d.way({c, e}, tag("highway", "footway") + tag("width", std::to_string(width)));
        const City city = drawn(d, [](Vec2 p) { return 12 - 0.3f * p.z; });
        const auto seats = pastime_places(city).seats;
        expect_fit(city, seats);
        float free = width;
        std::vector<float> rows;
        for (const Seat& s : seats) {
            EXPECT_EQ(s.on, SeatOn::steps);
            float left = -0.5f * width, right = 0.5f * width;
            for (const Seat& other : seats) {
                if (std::fabs(other.edge.z - s.edge.z) > 0.6f) continue;
                if (other.edge.x < 0) left = std::max(left, other.edge.x + k_half_body);
                if (other.edge.x > 0) right = std::min(right, other.edge.x - k_half_body);
            }
            free = std::min(free, right - left);
            rows.push_back(s.edge.z);
        }
        std::printf("%.1f m wide: %zu seats, %.2f m free\n", wide(width), seats.size(), wide(free));
        EXPECT_EQ(seats.empty(), width < 3);
        EXPECT_GT(free, 1.8f);
        // Nobody has feet in the back: rows are more than three treads apart.
        std::sort(rows.begin(), rows.end());
        for (size_t k = 1; k < rows.size(); ++k)
            EXPECT_TRUE(rows[k] - rows[k - 1] < 0.1f || rows[k] - rows[k - 1] > 1.5f);
    }
}

}  // namespace
}  // namespace flaneur
