#include <gtest/gtest.h>

#include <cmath>

#include "assets/measures/moments.h"
#include "assets/measures/profile.h"
#include "assets/measures/service.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/rng.h"

namespace flaneur {
namespace {

constexpr CutOff k_three{3, 24};

std::vector<Vec2> box_corners(float x, float z, float to_x, float to_z) {
    return {{x, z}, {to_x, z}, {to_x, to_z}, {x, to_z}};
}

VoronoiCell cell_of(std::span<const Vec2> people, uint32_t who, std::span<const WalkablePolygon> area,
                    CutOff cut_off) {
    VoronoiCell cell;
    make_cell(people_grid(people), who, cell_ground(area, cut_off), cell);
    return cell;
}

// Cells in the middle of a lattice are what one lattice place has, so the density is exact wherever the zone
// is cut, where counting jumps.
TEST(Voronoi, IsExactWhereCountingJumps) {
    std::vector<Vec2> people;
    for (int i = -12; i < 12; ++i)
        for (int k = -12; k < 12; ++k)
            people.push_back({0.9f * static_cast<float>(i), 1.1f * static_cast<float>(k)});
    for (const float aside : {0.0f, 0.2f, 0.47f, 0.61f}) {
        const Vec2 zone[] = {{-1.3f + aside, -1}, {1.5f + aside, -1}, {1.1f + aside, 1.4f}, {-1 + aside, 1}};
        EXPECT_NEAR(voronoi_density(zone, people, k_three), 1 / (0.9 * 1.1), 2e-5) << aside;
        // A concave one, too.
        const Vec2 arrow[] = {{-2 + aside, -2}, {2 + aside, -2}, {aside, 0}, {2 + aside, 2}, {-2 + aside, 2}};
        EXPECT_NEAR(voronoi_density(arrow, people, k_three), 1 / (0.9 * 1.1), 2e-5) << aside;
    }
    // A zone so large that most cells are not cut.
    const Vec2 zone[] = {{-8.4f, -9}, {8.1f, -9.3f}, {8.6f, 9.9f}, {-8, 9.1f}};
    EXPECT_NEAR(voronoi_density(zone, people, k_three), 1 / (0.9 * 1.1), 2e-5);
    const Vec2 alone[] = {{0, 0}};
    const std::vector<Vec2> all = box_corners(-9, -9, 9, 9);
    EXPECT_NEAR(voronoi_density(all, alone, k_three), 1.0 / (18 * 18), 1e-6) << "one person, within";
    EXPECT_EQ(voronoi_density(all, {}, k_three), 0);
}

TEST(Voronoi, HexagonsHaveSixNeighbours) {
    std::vector<Vec2> people;
    const float height = std::sqrt(0.75f);
    for (int row = 0; row < 9; ++row)
        for (int k = 0; k < 9; ++k)
            people.push_back(
                {static_cast<float>(k) + (row % 2 == 1 ? 0.5f : 0), height * static_cast<float>(row)});
    const uint32_t middle = 4 * 9 + 4;
    const VoronoiCell cell = cell_of(people, middle, {}, k_three);
    EXPECT_NEAR(cell.area, std::sqrt(0.75), 1e-5);
    EXPECT_EQ(cell.neighbours.size(), 6u);
    EXPECT_NEAR(distance_to_nearest(people_grid(people), middle), 1, 1e-6f);
    EXPECT_NEAR(cell_of(people, middle, {}, {0.5f, 12}).area, 3 * 0.25, 1e-5) << "a dodecagon of radius 0.5";
    EXPECT_TRUE(cell_of(people, middle, {}, {0.4f, 12}).neighbours.empty()) << "cut off before they touch";
}

TEST(Voronoi, ReachesTheWallsWithoutACutOff) {
    const std::vector<WalkablePolygon> room = {{box_corners(0, 0, 10, 4), {}}};
    const std::vector<Vec2> two = {{2, 1}, {6, 1}};
    EXPECT_NEAR(cell_of(two, 0, room, {}).area, 16, 1e-4);
    EXPECT_NEAR(cell_of(two, 1, room, {}).area, 24, 1e-4);
    EXPECT_NEAR(cell_of(std::vector<Vec2>{{2, 1}}, 0, room, {}).area, 40, 1e-4);
}

// Of a cell that a wall cuts in two the piece is kept in which its owner stands, and a pillar is taken out.
TEST(Voronoi, WallsCutCells) {
    const std::vector<WalkablePolygon> room = {
        {box_corners(0, 0, 10, 4), {box_corners(4, 1, 4.2f, 4), box_corners(1, 1, 1.5f, 1.5f)}}};
    const std::vector<Vec2> one = {{3.5f, 3}};
    const double half = 3 * 0.8 * 0.8;  // of a dodecagon
    const VoronoiCell beside = cell_of(one, 0, room, {0.8f, 12});
    EXPECT_GT(beside.area, half / 2);
    EXPECT_LT(beside.area, half);
    for (Vec2 p : beside.rings[0]) EXPECT_LT(p.x, 0.5f + 1e-4f) << "beyond the wall";
    const VoronoiCell other = cell_of(std::vector<Vec2>{{4.7f, 3}}, 0, room, {0.8f, 12});
    EXPECT_NEAR(other.area, beside.area, 1e-4);
    for (Vec2 p : other.rings[0]) EXPECT_GT(p.x, -0.5f - 1e-4f) << "beyond the wall";
    const std::vector<WalkablePolygon> booth = {{box_corners(0, 0, 4, 4), {box_corners(1, 1, 2, 2)}},
                                                {box_corners(1.1f, 1.1f, 1.9f, 1.9f), {}}};
    EXPECT_NEAR(cell_of(std::vector<Vec2>{{1.5f, 1.5f}}, 0, booth, {0.8f, 12}).area, 0.64, 1e-4)
        << "what is all round the booth is not theirs";
    // Round the end of the wall it is one piece, and not convex.
    const VoronoiCell round = cell_of(std::vector<Vec2>{{3.5f, 1}}, 0, room, {0.8f, 12});
    EXPECT_FALSE(round.is_convex);
    const VoronoiCell pillar = cell_of(std::vector<Vec2>{{1.25f, 0.9f}}, 0, room, {0.8f, 12});
    EXPECT_NEAR(pillar.area, half - 0.25, 1e-4) << "all of the pillar is within";
    EXPECT_EQ(cell_of(std::vector<Vec2>{{1.25f, 1.25f}}, 0, room, {0.8f, 12}).area, 0) << "in the pillar";
    EXPECT_EQ(cell_of(std::vector<Vec2>{{-1, 1}}, 0, room, {0.8f, 12}).area, 0) << "outside";
}

// The tree of pieces changes nothing: the same cells as from the whole area at once.
TEST(Voronoi, GroundInPiecesIsTheSameGround) {
    WalkablePolygon town{box_corners(0, 0, 60, 60), {}};
    for (int i = 0; i < 6; ++i)
        for (int k = 0; k < 6; ++k) {
            const float x = 3 + 10 * static_cast<float>(i), z = 3 + 10 * static_cast<float>(k);
            town.holes.push_back({{x, z}, {x + 5, z + 1}, {x + 4, z + 6}, {x + 1, z + 4}});
        }
    const CellGround tree = cell_ground({&town, 1}, {1.5f, 12});
    EXPECT_GT(tree.pieces.size(), 50u);
    std::vector<Vec2> people;
    for (uint32_t i = 0; i < 600; ++i)
        people.push_back({random_between({1, i, 0, Purpose::body}, -1, 61),
                          random_between({2, i, 0, Purpose::body}, -1, 61)});
    CellGround whole = cell_ground({&town, 1}, {});
    whole.cut_off = {1.5f, 12};
    const MeasuredArea near_by = measured_area({&town, 1}, {}, {1.5f, 12});
    const std::vector<WalkablePolygon> part = {{{{10, 70}, {33, 20}, {28, 40}, {50, -9}, {-5, -9}}, {}}};
    const MeasuredArea half = measured_area(part, {}, {1.5f, 12}), half_whole = measured_area(part, {});
    const PeopleGrid grid = people_grid(people);
    VoronoiCell a, b;
    size_t off = 0;
    for (uint32_t i = 0; i < people.size(); ++i) {
        make_cell(grid, i, tree, a);
        make_cell(grid, i, whole, b);
        EXPECT_NEAR(a.area, b.area, 1e-4) << people[i].x << ", " << people[i].z;
        // All of a cell is on the ground, and what of it is in an area does not depend on how that is cut.
        EXPECT_NEAR(area_within(near_by, a, people[i]), a.area, 1e-4);
        EXPECT_NEAR(area_within(half, a, people[i]), area_within(half_whole, b, people[i]), 1e-4);
        off += b.area == 0;
    }
    EXPECT_GT(off, 50u);
    EXPECT_LT(off, 300u);
}

// Cells of all share out the ground: nothing is left, nothing is given twice.
TEST(Voronoi, CellsAreAPartition) {
    const std::vector<WalkablePolygon> room = {{box_corners(0, 0, 12, 5), {}}};
    for (uint32_t seed = 0; seed < 20; ++seed) {
        std::vector<Vec2> people;
        for (uint32_t i = 0; i < 1 + seed * 8; ++i)
            people.push_back({random_between({seed, i, 0, Purpose::body}, 0, 12),
                              random_between({seed, i, 1, Purpose::body}, 0, 5)});
        const PeopleGrid grid = people_grid(people);
        const CellGround ground = cell_ground(room, {});
        VoronoiCell cell;
        double sum = 0;
        for (uint32_t i = 0; i < people.size(); ++i) make_cell(grid, i, ground, cell), sum += cell.area;
        EXPECT_NEAR(sum, 60, 1e-3) << seed;
    }
}

TEST(Voronoi, AreasCountWhatIsWalkable) {
    const std::vector<WalkablePolygon> room = {{box_corners(0, 0, 10, 4), {box_corners(2, 0, 4, 2)}}};
    EXPECT_NEAR(measured_area(room, room).square_metres, 36, 1e-6);
    const std::vector<WalkablePolygon> zone = {{box_corners(2, 0, 6, 9), {}}};
    const MeasuredArea area = measured_area(zone, room);
    EXPECT_NEAR(area.square_metres, 12, 1e-6);
    EXPECT_TRUE(is_in(area, {3, 3}));
    EXPECT_FALSE(is_in(area, {1, 3}));
    EXPECT_NEAR(measured_area(zone, {}).square_metres, 36, 1e-6);
    const VoronoiCell cell = cell_of(std::vector<Vec2>{{5, 3}}, 0, room, {});
    EXPECT_NEAR(cell.area, 36, 1e-3);
    EXPECT_NEAR(area_within(area, cell, {5, 3}), 12, 1e-3) << "neither is convex";
}

// Whatever the method, people are neither made nor lost where maps reach far enough.
TEST(Profiles, SumUpToPeople) {
    Trajectories tracks;
    tracks.fps = 10;
    tracks.area = {{box_corners(0, 0, 12, 6), {box_corners(5, 2, 6, 4)}}};
    for (uint32_t f = 0; f < 40; ++f)
        for (uint32_t i = 0; i < 7; ++i)
            tracks.sightings.push_back({f,
                                        i,
                                        {2 + 0.05f * static_cast<float>(f) + 0.4f * static_cast<float>(i),
                                         1.3f + 0.5f * static_cast<float>(i % 2)},
                                        0,
                                        {}});
    const TrackTable table = track_table(tracks);
    const std::vector<float> speeds = speeds_of(velocities(table, 2, AtEnds::single_sided));
    const CellGround ground = cell_ground(tracks.area, {1, 12});
    const ProfileGrid grid = profile_grid({{0, 0}, {12, 6}}, 0.31f);
    const WorkersPtr one = make_workers(1), three = make_workers(3);
    for (const FieldMethod method : {FieldMethod::classic, FieldMethod::voronoi, FieldMethod::gaussian}) {
        const ProfileOf what{.method = method, .gaussian_width = 0.5f, .range = {}, .every = 1};
        const Profiles p = profiles_of(table, ground, speeds, grid, what, *one);
        EXPECT_EQ(p.frames, 40u);
        double people = 0, flow = 0;
        for (size_t k = 0; k < count_of(grid); ++k) people += wide(p.density[k]), flow += wide(p.flow[k]);
        const double square = wide(grid.square) * wide(grid.square);
        EXPECT_NEAR(people * square, 7, 2e-3) << static_cast<int>(method);
        EXPECT_NEAR(flow * square, 7 * 0.5, 2e-3) << "each goes half a metre a second";
        for (float speed : p.speed)
            EXPECT_TRUE(std::isnan(speed) || std::fabs(speed - 0.5f) < 1e-4f) << speed;
        const Profiles again = profiles_of(table, ground, speeds, grid, what, *three);
        EXPECT_TRUE(p.density == again.density) << "on more threads";
        const Profiles few =
            profiles_of(table, ground, speeds, grid, {.method = method, .range = {10, 19}, .every = 3}, *one);
        EXPECT_EQ(few.frames, 4u);
    }
}

TEST(Fruin, LevelsAreTheLettersOfTheTables) {
    EXPECT_EQ(fruin_level(0), 0);
    EXPECT_EQ(fruin_level(0.31f), 0);
    EXPECT_EQ(fruin_level(0.32f), 1);
    EXPECT_EQ(fruin_level(0.7f), 2);
    EXPECT_EQ(fruin_level(2.2f), 5);
    // Square feet a person.
    const float walkways[] = {35, 25, 15, 10, 5}, stairs[] = {20, 15, 10, 7, 4}, queues[] = {13, 10, 7, 3, 2};
    for (int k = 0; k < 5; ++k) {
        EXPECT_NEAR(k_fruin_densities[k], 10.7639f / walkways[k], 0.006f);
        EXPECT_NEAR(k_fruin_stairs[k], 10.7639f / stairs[k], 0.006f);
        EXPECT_NEAR(k_fruin_queues[k], 10.7639f / queues[k], 0.006f);
    }
    EXPECT_EQ(fruin_level(0.6f, ServiceOf::stairs), 1);
    EXPECT_EQ(fruin_level(4, ServiceOf::queue), 4);
}

}  // namespace
}  // namespace flaneur
