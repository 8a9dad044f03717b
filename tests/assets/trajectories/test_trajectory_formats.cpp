// Formats of others, each as small as tells it.
#include <gtest/gtest.h>

#include <algorithm>

#include "assets/trajectories/geometry.h"
#include "assets/trajectories/trajectories.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

Trajectories read_text(const TestFolder& folder, const std::string& name, const std::string& text,
                       const TrajectoryReading& reading = {}) {
    Result<Trajectories> read = read_trajectories(folder.write(name, text), reading);
    EXPECT_TRUE(read) << read.error().message;
    return read ? std::move(*read) : Trajectories{};
}

// Where somebody is; far away if nowhere.
Vec2 place_of(const Trajectories& tracks, uint32_t frame, uint32_t id) {
    for (const Sighting& s : tracks.sightings)
        if (s.frame == frame && s.id == id) return s.at;
    return {-1e6f, -1e6f};
}

bool is_near(Vec2 a, Vec2 b) { return length(a - b) < 1e-3f; }

bool is_assumed(const Trajectories& tracks, const std::string& what) {
    return std::any_of(tracks.assumed.begin(), tracks.assumed.end(),
                       [&](const std::string& sentence) { return sentence.find(what) != std::string::npos; });
}

TEST(TrajectoryFormats, TablesNameTheirColumns) {
    TestFolder folder;
    // Semicolons, decimal commas, CRLF, a mark of UTF-8, rows in any order, words for people.
    Trajectories t = read_text(folder, "a.dat",
                               "\xEF\xBB\xBFtime [s];agent;y [cm];x [cm]\r\n0,5;eve;100;60\r\n0;eve;100;0\r\n"
                               "0;adam;250,5;1000\r\n");
    EXPECT_EQ(t.fps, 2);
    ASSERT_EQ(t.tracked.size(), 2u);
    EXPECT_EQ(t.tracked[0].name, "eve");
    EXPECT_EQ(t.tracked[1].name, "adam");
    EXPECT_TRUE(is_near(place_of(t, 1, 0), {0.6f, -1}));
    EXPECT_TRUE(is_near(place_of(t, 0, 1), {10, -2.505f}));
    // Tabs, a quoted name, a unit behind a stroke, rows without a place.
    t = read_text(folder, "b.csv", "\"ped id\"\tframe\tx/mm\ty/mm\n7\t0\t1500\tnan\n7\t1\t1500\t2000\n");
    EXPECT_EQ(t.sightings.size(), 1u);
    EXPECT_TRUE(is_near(place_of(t, 1, 7), {1.5f, -2}));
    EXPECT_TRUE(is_assumed(t, "1 rows without a place"));
    // Vissim, whose comments begin with a star.
    t = read_text(folder, "c.pp",
                  "* File\n$PEDESTRIAN:NO;SIMSEC;COORDCENTX;COORDCENTY\n4;0.2;1;2\n4;0.4;1.2;2\n");
    EXPECT_EQ(t.fps, 5);
    EXPECT_TRUE(is_near(place_of(t, 2, 4), {1.2f, -2}));
}

TEST(TrajectoryFormats, UnitRateAndColumnsAreFoundByHowPeopleWalk) {
    TestFolder folder;
    std::string by_id, by_frame;
    for (int frame = 0; frame <= 50; frame += 10)
        for (int id = 1; id < 4; ++id)
            by_frame += std::to_string(frame) + "\t" + std::to_string(id) + "\t" +
                        std::to_string(0.05 * frame + 3 * id) + "\t" + std::to_string(2 * id) + "\n";
    // Every tenth frame of 25 a second, as the crowds of ETH and UCY are handed on.
    Trajectories t = read_text(folder, "a.txt", by_frame);
    EXPECT_EQ(t.fps, 2.5f);
    EXPECT_TRUE(is_near(place_of(t, 1, 2), {6.5f, -4}));
    EXPECT_TRUE(is_assumed(t, "frame, id"));
    EXPECT_TRUE(is_assumed(t, "25 frames a second"));
    for (int id = 1; id < 4; ++id)
        for (int frame = 0; frame < 5; ++frame)
            by_id += std::to_string(id) + " " + std::to_string(frame) + " " +
                     std::to_string(5 * frame + 300 * id) + " 0 176\n";
    t = read_text(folder, "b.txt", by_id);
    EXPECT_TRUE(is_near(place_of(t, 2, 1), {3.1f, 0}));
    EXPECT_EQ(t.heights, HeightsOf::heads);
    EXPECT_TRUE(is_assumed(t, "Centimetres"));
    // What is known better.
    t = read_text(folder, "b.txt", by_id, {.unit = 0.1f, .fps = 5, .origin = Vec2{300, 0}});
    EXPECT_EQ(t.fps, 5);
    EXPECT_TRUE(is_near(place_of(t, 2, 1), {1, 0}));
    EXPECT_EQ(t.heights, HeightsOf::ground);
    // Milliseconds, and upwards along y.
    t = read_text(folder, "c.csv", "id,time,x,y,z\n1,0,0,1.7,0\n1,100,0.01,1.7,0.13\n1,200,0.02,1.71,0.26\n");
    EXPECT_EQ(t.fps, 10);
    EXPECT_TRUE(is_near(place_of(t, 2, 1), {0.02f, 0.26f}));
    EXPECT_TRUE(is_assumed(t, "upwards"));
    EXPECT_EQ(t.heights, HeightsOf::heads);
    // Far from where the map begins.
    t = read_text(folder, "d.csv", "id,t,x,y\n1,0,600000,5600000\n1,1,600001,5600000\n");
    EXPECT_NEAR(length(place_of(t, 1, 1) - place_of(t, 0, 1)), 1, 1e-4);
    EXPECT_TRUE(is_assumed(t, "5600000"));
}

TEST(TrajectoryFormats, WhatIsOddIsToldOrRefused) {
    TestFolder folder;
    std::string rows = "#framerate: 10\n";
    for (int frame = -3; frame < 200; ++frame)
        rows += "5 " + std::to_string(frame) + " 1 " + std::to_string(frame * 0.1) + "\n";
    rows += "5 7 3 3\n5 8 1 0.8\n";
    const Trajectories t = read_text(folder, "a.txt", rows);
    EXPECT_EQ(t.sightings.size(), 203u);
    EXPECT_EQ(t.sightings[0].frame, 0u);
    EXPECT_TRUE(is_assumed(t, "Frame 0 is the first"));
    EXPECT_TRUE(is_assumed(t, "once more at a time"));
    // One frame alone says no rate.
    EXPECT_EQ(read_text(folder, "b.csv", "id,t,x,y\n1,4,0,0\n2,4,1,1\n").fps, 25);
    // Uneven times.
    const Trajectories uneven =
        read_text(folder, "c.csv", "id,t,x,y\n1,0,0,0\n1,0.7,0.7,0\n1,1.1,1.1,0\n1,2.9,2.9,0\n1,9,40,0\n");
    EXPECT_TRUE(is_assumed(uneven, "not even"));
    for (const Sighting& s : uneven.sightings)
        if (s.at.x < 3) {
            EXPECT_NEAR(s.at.x, static_cast<float>(s.frame) / uneven.fps, 1e-4);
        }
    EXPECT_EQ(uneven.sightings.size(), 10u);
}

TEST(TrajectoryFormats, PathfinderHasARowOfUnits) {
    TestFolder folder;
    const Trajectories t =
        read_text(folder, "a.csv",
                  "\"t\",\"id\",\"name\",\"x\",\"y\",\"z\"\n\"s\",\"\",\"\",\"m\",\"m\",\"m\"\n"
                  "0.0,3,\"00004\",1,2,0.5\n1.0,3,\"00004\",1.5,2,0.5\n");
    EXPECT_EQ(t.format, "CSV of Pathfinder");
    EXPECT_EQ(t.fps, 1);
    EXPECT_TRUE(is_near(place_of(t, 1, 3), {1.5f, -2}));
}

TEST(TrajectoryFormats, SumoHasVehiclesToo) {
    TestFolder folder;
    folder.write("grid.net.xml",
                 "<net><edge id='a'><lane id='a_0' width='4' shape='0,0 10,0'/></edge>"
                 "<edge id=':b' function='internal'><lane id=':b_0' shape='50,50 60,60'/></edge>"
                 "<junction id='j' shape='10,-2 14,-2 14,2 10,2'/></net>");
    const Trajectories t = read_text(
        folder, "grid_fcd.xml",
        "<!-- <net-file value=\"grid.net.xml\"/> --><fcd-export><timestep time='10.0'>"
        "<person id='p' x='1' y='2' angle='90'/><vehicle id='p' type='tram' x='5' y='0'/></timestep>"
        "<timestep time='10.5'><person id='p' x='2' y='2'/></timestep></fcd-export>");
    EXPECT_EQ(t.fps, 2);
    ASSERT_EQ(t.tracked.size(), 2u);
    EXPECT_EQ(t.tracked[1].kind, TrackedKind::tram);
    EXPECT_EQ(t.tracked[1].name, "p");
    EXPECT_EQ(t.sightings[0].frame, 20u);
    EXPECT_NEAR(t.sightings[0].facing.x, 1, 1e-5);
    ASSERT_EQ(t.area.size(), 1u);
    EXPECT_EQ(t.area[0].outer.size(), 4u);
}

TEST(TrajectoryFormats, VadereStepsAndScenario) {
    TestFolder folder;
    folder.write(
        "some.scenario",
        R"({"scenario": {"topography": {"attributes": {"bounds": {"x": 0, "y": 0, "width": 8, "height": 6},
                 "boundingBoxWidth": 0.5, "bounded": true}, "obstacles": [{"shape": {"type": "RECTANGLE", "x": 2,
                 "y": 2, "width": 1, "height": 1}}, {"shape": {"type": "STAR"}}]}}})");
    const Trajectories t =
        read_text(folder, "postvis.traj",
                  "#IDXCOL=2,DATACOL=6,SEP=' '\npedestrianId simTime endTime-PID1 startX-PID1 "
                  "startY-PID1 endX-PID1 endY-PID1 targetId-PID2\n"
                  "1 0.4 1.07 1 1 1.67 1 8\n1 1.07 1.63 1.67 1 2.23 1 8\n2 0.4 0.91 5 5 5 5.5 8\n");
    EXPECT_EQ(t.format, "steps of Vadere");
    EXPECT_GE(t.fps, 5);
    for (const Sighting& s : t.sightings)
        if (s.id == 1) {
            EXPECT_NEAR(s.at.x, 0.6f + static_cast<float>(s.frame) / t.fps, 1e-3);
        }
    ASSERT_EQ(t.area.size(), 1u);
    EXPECT_EQ(t.area[0].holes.size(), 1u);
    EXPECT_TRUE(is_assumed(t, "some.scenario"));
    EXPECT_TRUE(is_assumed(t, "1 obstacles without"));
}

TEST(TrajectoryFormats, StairsOfJuPedSimClimb) {
    const Result<WalkableGeometry> read = parse_geometry(
        "<geometry unit='m'><rooms><room id='0'><subroom id='0' C_z='0' A_x='0' B_y='0'>"
        "<polygon><vertex px='0' py='0'/><vertex px='4' py='0'/></polygon>"
        "<polygon><vertex px='4' py='2'/><vertex px='0' py='2'/><vertex px='0' py='0'/></polygon></subroom>"
        "<subroom id='1' A_x='0.5' B_y='0' C_z='-2'><polygon><vertex px='4' py='0'/><vertex px='8' py='0'/>"
        "<vertex px='8' py='2'/><vertex px='4' py='2'/></polygon></subroom><crossings>"
        "<crossing id='0' subroom1_id='0' subroom2_id='1'><vertex px='4' py='0'/><vertex px='4.0 ' py='2'/>"
        "</crossing></crossings></room></rooms></geometry>");
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->area.size(), 2u);
    EXPECT_TRUE(read->assumed.empty());
    EXPECT_EQ(read->area[0].outer.size(), 4u);
    EXPECT_EQ(read->area[1].outer.size(), 4u);
    EXPECT_EQ(read->area[1].level, -2);
    EXPECT_EQ(read->area[1].rise.x, 0.5f);
}

TEST(TrajectoryFormats, DegreesBecomeMetres) {
    TestFolder folder;
    const Trajectories walk = read_text(
        folder, "a.gpx",
        "<gpx><trk><name>Ada</name><trkseg>"
        "<trkpt lat='51.00000' lon='7.0'><ele>100</ele><time>2024-05-01T12:00:00Z</time></trkpt>"
        "<trkpt lat='51.00001' lon='7.0'><ele>101</ele><time>2024-05-01T14:00:01+02:00</time></trkpt>"
        "<trkpt lat='51.00001' lon='7.00001'><time>2024-05-01T12:00:02Z</time></trkpt></trkseg></trk></gpx>");
    EXPECT_EQ(walk.fps, 1);
    ASSERT_EQ(walk.sightings.size(), 3u);
    EXPECT_EQ(walk.tracked[0].name, "Ada");
    EXPECT_NEAR(walk.sightings[0].at.z - walk.sightings[1].at.z, 1.1126, 1e-3);
    EXPECT_NEAR(walk.sightings[2].at.x - walk.sightings[1].at.x, 0.7018, 1e-3);
    const Trajectories points = read_text(folder, "b.geojson",
                                          R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [7, 51]}, "properties": {"id": 4, "time": 0}},
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [7, 51.00001]}, "properties": {"id": 4, "time": 1}}]})");
    EXPECT_EQ(points.sightings[1].id, 4u);
    EXPECT_NEAR(length(points.sightings[1].at - points.sightings[0].at), 1.1126, 1e-3);
    EXPECT_TRUE(is_assumed(points, "Degrees"));
}

TEST(TrajectoryFormats, RecordingsOfRoadsHaveClassesBesideThem) {
    TestFolder folder;
    folder.write("00_recordingMeta.csv", "recordingId,locationId,frameRate\n0,1,12.5\n");
    folder.write("00_tracksMeta.csv", "recordingId,trackId,class\r\n0,0,pedestrian\r\n0,1,truck_bus\r\n");
    const Trajectories t = read_text(folder, "00_tracks.csv",
                                     "recordingId,trackId,frame,xCenter,yCenter,heading,width,length\n"
                                     "0,0,0,10,-5,90,0,0\n0,1,0,20,-8,0,2.5,11.5\n0,1,1,21,-8,0,2.5,11.5\n");
    EXPECT_EQ(t.fps, 12.5f);
    ASSERT_EQ(t.tracked.size(), 2u);
    EXPECT_EQ(t.tracked[0].kind, TrackedKind::person);
    EXPECT_EQ(t.tracked[1].kind, TrackedKind::bus);
    EXPECT_EQ(t.tracked[1].length, 11.5f);
    EXPECT_NEAR(t.sightings[0].facing.z, -1, 1e-5);
}

TEST(TrajectoryFormats, SplinesArePixels) {
    TestFolder folder;
    const Trajectories t = read_text(folder, "a.vsp",
                                     "1 - the number of splines\n3 - Num of control points\n"
                                     "-100.0 20.0 0 90.5 - (2D point, m_id)\n-40 20 25 90\n80 20 75 90\n");
    EXPECT_EQ(t.fps, 1);
    EXPECT_NEAR(t.sightings[1].at.x - t.sightings[0].at.x, 1.34, 1e-3);
    EXPECT_TRUE(is_assumed(t, "Pixels"));
}

}  // namespace
}  // namespace flaneur
