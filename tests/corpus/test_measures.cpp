// Measures of recorded people. What is expected was computed by scipy.spatial.Voronoi (1.10) and shapely
// (1.8) from the definitions that PedPy documents: cells cut by the walkable area and by a dodecagon of that
// radius.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "assets/measures/lines.h"
#include "assets/measures/moments.h"
#include "assets/trajectories/wkt.h"

namespace flaneur {
namespace {

const char* const k_neck =
    "POLYGON ((3.5 -2, 3.5 8, -3.5 8, -3.5 -2, 3.5 -2), (-0.7 -1.1, -0.25 -1.1, -0.25 -0.15, -0.4 0, -2.8 0, "
    "-2.8 6.7, "
    "-3.05 6.7, -3.05 -0.3, -0.7 -0.3, -0.7 -1, -0.7 -1.1), (0.25 -1.1, 0.7 -1.1, 0.7 -0.3, 3.05 -0.3, 3.05 "
    "6.7, 2.8 "
    "6.7, 2.8 0, 0.4 0, 0.25 -0.15, 0.25 -1.1))";

struct Expected {
    uint32_t frame;
    float cut_off;
    double classic, voronoi, voronoi_speed, mean_speed;
};

void expect_moments(const Trajectories& tracks, const char* walkable, const char* outline, uint32_t step,
                    std::initializer_list<Expected> all) {
    const TrackTable table = track_table(tracks);
    const std::vector<WalkablePolygon> ground = *parse_wkt(walkable);
    const std::vector<float> speeds = speeds_of(velocities(table, step, AtEnds::single_sided));
    const WorkersPtr workers = make_workers(1);
    for (const Expected& e : all) {
        const CutOff cut_off{e.cut_off, 12};
        const MeasuredArea area = measured_area(*parse_wkt(outline), ground, cut_off);
        const std::vector<AreaMoment> moments =
            area_moments(table, area, cell_ground(ground, cut_off), speeds, {e.frame, e.frame}, *workers);
        ASSERT_EQ(moments.size(), 1u);
        EXPECT_NEAR(moments[0].classic, e.classic, 1e-5) << e.frame;
        EXPECT_NEAR(moments[0].voronoi, e.voronoi, 5e-5) << e.frame;
        EXPECT_NEAR(moments[0].voronoi_speed, e.voronoi_speed, 5e-5) << e.frame;
        EXPECT_NEAR(moments[0].mean_speed, e.mean_speed, 5e-5) << e.frame;
    }
}

Result<Trajectories> corpus(const char* name) {
    return read_trajectories(std::string(FLANEUR_SHARED_DIR) + "/corpus/trajectories/" + name);
}

TEST(MeasuresOfPeople, BothWaysInACorridor) {
    const Result<Trajectories> tracks = corpus("bi_corr_400_b_03.txt");
    if (!tracks) GTEST_SKIP() << "LEFT OUT: " << tracks.error().message;
    expect_moments(*tracks, "POLYGON ((-5.6 -0.3, 5 -0.3, 5 4.3, -5.6 4.3, -5.6 -0.3))",
                   "POLYGON ((-1 0.5, 1 0.5, 1 3.5, -1 3.5, -1 0.5))", 5,
                   {{1720, 1, 4.0 / 6, 0.6143878, 1.0216119, 1.0339646},
                    {1720, 0, 4.0 / 6, 0.5822315, 1.0474676, 1.0339646}});
}

TEST(MeasuresOfPeople, BeforeANeck) {
    const Result<Trajectories> tracks = corpus("040_c_56_h-.txt");
    if (!tracks) GTEST_SKIP() << "LEFT OUT: " << tracks.error().message;
    expect_moments(*tracks, k_neck, "POLYGON ((-0.4 0.5, 0.4 0.5, 0.4 1.3, -0.4 1.3, -0.4 0.5))", 25,
                   {{840, 1, 7.8125, 6.6319401, 0.0589512, 0.0635442}});
    const std::vector<LineCrossed> crossings =
        line_crossings(track_table(*tracks), {{0.4f, 0}, {-0.4f, 0}}, {});
    EXPECT_EQ(first_crossings(crossings).size(), 75u) << "all of the experiment";
}

}  // namespace
}  // namespace flaneur
