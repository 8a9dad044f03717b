#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "assets/trajectories/trajectories.h"
#include "assets/trajectories/walkable.h"
#include "assets/trajectories/wkt.h"
#include "assets/trajectories/write.h"
#include "sim/base/rng.h"
#include "sim/ground/ground.h"
#include "tests/assets/trajectories/tiny_hdf5.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

const std::vector<WalkablePolygon> k_room = {
    {{{-5, -4}, {5, -4}, {5, 6}, {-5, 6}}, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}};

// Two people, of whom the second comes in frame 1 and stays for two.
std::vector<std::vector<Sighting>> two_people() {
    std::vector<std::vector<Sighting>> frames;
    for (uint32_t f = 0; f < 4; ++f) {
        const float t = static_cast<float>(f) / 8;
        frames.push_back({{f, 3, {1.5f + t, -2.25f}, 0.125f, {1, 0}}});
        if (f == 1 || f == 2) frames.back().push_back({f, 8, {-1.25f, 4.5f + t}, 0, {0, 1}});
    }
    return frames;
}

std::string write_two(const TestFolder& folder, const std::string& name) {
    const std::string path = folder.write(name, "");
    FILE* file = std::fopen(path.c_str(), "wb");
    auto writer = begin_trajectories(*trajectory_format_of(name), file, path, 8, k_room, "nobody's");
    EXPECT_TRUE(writer) << writer.error().message;
    for (const std::vector<Sighting>& people : two_people())
        EXPECT_TRUE(add_frame(**writer, people[0].frame, people));
    EXPECT_TRUE(finish_trajectories(std::move(*writer)));
    std::fclose(file);
    return path;
}

TEST(Trajectories, ComeBackAsTheyWereWritten) {
    TestFolder folder;
    for (const std::string name : {"a.csv", "a.sqlite", "a.txt", "a.xml", "a.json", "a.traj"}) {
        SCOPED_TRACE(name);
        Result<Trajectories> read = read_trajectories(write_two(folder, name));
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->fps, 8);
        std::vector<Sighting> wanted;
        for (const std::vector<Sighting>& people : two_people())
            wanted.insert(wanted.end(), people.begin(), people.end());
        ASSERT_EQ(read->sightings.size(), wanted.size());
        const bool is_database = name == "a.sqlite", is_flat = is_database || name == "a.traj";
        const bool has_no_facing = name == "a.txt" || name == "a.json" || name == "a.traj";
        EXPECT_EQ(read->heights, is_flat ? HeightsOf::nothing : HeightsOf::ground);
        for (size_t i = 0; i < wanted.size(); ++i) {
            const Sighting &is = read->sightings[i], &was = wanted[i];
            EXPECT_EQ(is.frame, was.frame);
            EXPECT_EQ(is.id, was.id);
            EXPECT_TRUE(is.at == was.at) << is.at.x << " " << is.at.z;
            EXPECT_EQ(is.height, is_flat ? 0 : was.height);
            EXPECT_LT(length(is.facing - (has_no_facing ? Vec2{} : was.facing)), 1e-5f);
        }
        ASSERT_EQ(read->area.size(), is_database ? 1u : 0u);
        if (!is_database) continue;
        ASSERT_EQ(read->area[0].outer.size(), 4u);
        EXPECT_TRUE(read->area[0].outer[2] == k_room[0].outer[2]);
        ASSERT_EQ(read->area[0].holes.size(), 1u);
    }
}

TEST(Trajectories, HaveNorthUpInFiles) {
    TestFolder folder;
    EXPECT_NE(bytes_of(write_two(folder, "a.txt")).find("\n3 0 1.5000 2.2500 0.1250\n"), std::string::npos);
    EXPECT_NE(
        bytes_of(write_two(folder, "a.csv")).find("\n1,0.1250,8,-1.2500,-4.6250,0.0000,0.0000,-1.0000\n"),
        std::string::npos);
    EXPECT_EQ(wkt_of(k_room).substr(0, 36), "POLYGON ((-5.000 4.000, 5.000 4.000,");
}

std::string value_of(const std::string& path, const char* query) {
    sqlite3* database = nullptr;
    sqlite3_stmt* row = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_prepare_v2(database, query, -1, &row, nullptr), SQLITE_OK) << query;
    std::string value;
    if (sqlite3_step(row) == SQLITE_ROW) value = reinterpret_cast<const char*>(sqlite3_column_text(row, 0));
    sqlite3_finalize(row);
    sqlite3_close(database);
    return value;
}

void run_query(const std::string& path, const char* query) {
    sqlite3* database = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, query, nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
}

TEST(Trajectories, DatabasesAreThoseOfJuPedSim) {
    TestFolder folder;
    const std::string path = write_two(folder, "a.sqlite");
    EXPECT_EQ(value_of(path, "PRAGMA integrity_check"), "ok");
    EXPECT_EQ(value_of(path, "SELECT group_concat(key) FROM metadata"),
              "about,fps,version,xmax,xmin,ymax,ymin");
    EXPECT_EQ(value_of(path, "SELECT group_concat(value) FROM metadata WHERE key <> 'about' ORDER BY rowid"),
              "2,8,-5,5,-6,4");
    EXPECT_EQ(value_of(path, "SELECT count(*) FROM frame_data JOIN geometry ON geometry_hash = hash"), "4");
    EXPECT_EQ(value_of(path, "SELECT group_concat(name) FROM pragma_table_info('trajectory_data')"),
              "frame,id,pos_x,pos_y,ori_x,ori_y");
    EXPECT_EQ(value_of(path, "SELECT name FROM sqlite_master WHERE name = 'frame_id_idx'"), "frame_id_idx");
    EXPECT_FALSE(fs::exists(path + "-journal"));
}

TEST(Trajectories, TextsAreInMetresOrCentimetres) {
    TestFolder folder;
    auto first = [&](const std::string& head, const std::string& rows) {
        Result<Trajectories> read = read_trajectories(folder.write("a.txt", head + rows));
        EXPECT_TRUE(read) << read.error().message;
        return read ? read->sightings[0].at : Vec2{};
    };
    const std::string rate = "# framerate: 10 fps\n";
    EXPECT_TRUE(first(rate + "# id frame x/cm y/cm z/cm\n", "1 0 250 -50 176\n") == (Vec2{2.5f, 0.5f}));
    EXPECT_TRUE(first(rate + "# id frame x/m y/m z/m\n", "1\t0\t250\t-50\r\n") == (Vec2{250, 50}));
    // Where no comment says, as fast as somebody goes: 15 m/s or 15 cm/s; 120 cm/s or 120 m/s.
    EXPECT_TRUE(first(rate, "1 0 250 50 0\n1 1 251.5 50 0\n") == (Vec2{250, -50}));
    EXPECT_TRUE(first(rate, "1 0 250 50 0\n1 1 262 50 0\n") == (Vec2{2.5f, -0.5f}));
    // 120 cm/s at 25 frames a second, where no comment says how many there are.
    EXPECT_TRUE(first("", "1 0 250 50 0\n1 1 254.8 50 0\n") == (Vec2{2.5f, -0.5f}));
    EXPECT_TRUE(first("#framerate:8.00\n#X,Y,Z: (in metres)\n", "1 0 1.5 0 0 9 9 9\n") == (Vec2{1.5f, 0}));
}

TEST(Trajectories, ArchivesAreRead) {
    TestFolder folder;
    const std::string path = folder.write("a.h5", tiny_hdf5({{7, 0, 1.5, 2.5, 1.7}, {7, 1, 1.75, 2.5, 1.7}},
                                                            12.5, "POLYGON ((0 0, 4 0, 4 3, 0 0))"));
    Result<Trajectories> read = read_trajectories(path);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->fps, 12.5f);
    ASSERT_EQ(read->sightings.size(), 2u);
    EXPECT_EQ(read->sightings[1].id, 7u);
    EXPECT_TRUE(read->sightings[1].at == (Vec2{1.75f, -2.5f}));
    ASSERT_EQ(read->area.size(), 1u);
    EXPECT_TRUE(read->area[0].outer[2] == (Vec2{4, -3}));
}

TEST(Trajectories, WhatCannotBeReadIsRefusedByName) {
    TestFolder folder;
    auto refused = [&](const std::string& name, const std::string& text, const std::string& why) {
        const std::string path = text.empty() ? folder / name : folder.write(name, text);
        Result<Trajectories> read = read_trajectories(path);
        ASSERT_FALSE(read) << name << ": " << text;
        EXPECT_NE(read.error().message.find(path), std::string::npos) << read.error().message;
        EXPECT_NE(read.error().message.find(why), std::string::npos) << read.error().message;
    };
    const std::string rate = "#framerate: 25\n";
    refused("nowhere.txt", "", "no file");
    refused("a.dat", "x", "no columns that are known");
    refused("b.dat",
            std::string("\x7f"
                        "ELF\0\1",
                        6),
            "no format that is known");
    refused("b.txt", rate, "nobody");
    refused("c.txt", rate + "1 0 nan 0 0\n", "nobody");
    refused("d.txt", rate + "1 0 1e9 0 0\n", "100 km");
    refused("D.txt", rate + "# in m\n1 0 0 0 0\n1 1 3e5 0 0\n", "100 km");
    refused("e.txt", rate + "1 0 1\n", "line 2");
    refused("E.txt", rate + "1 0 1 2\n1 1 1\n", "line 3");
    refused("f.txt", rate + "1 0 1 2 3\n1 0 1 5 3\n", "twice in frame 0");
    refused("h.txt", rate + "1.5 1 1 2 3\n", "line 2");
    refused("i.txt", "#framerate: 1e9\n1 0 1 2 3\n", "rate of frames");
    refused("j.csv", "id,frame,x,y\n1,0.5,0,0\n1,1.5,0,0\n", "whole numbers");
    refused("a.csv", "frame,id\n", "line 1");
    refused("b.csv", "frame,time_s,id,x_m,y_m,z_m,facing_x,facing_y\n0,0,1\n", "line 2");
    refused("c.csv", "id,t,x,y\n1,soon,0,0\n", "line 2");
    refused("d.csv", "\xff\xfei\0d\0", "UTF-16");
    refused("a.xml", "<fcd-export><timestep time='0'><person id='1' x='1'/></timestep></fcd-export>",
            "line 1");
    refused("b.xml", "<fcd-export><timestep time='0'>", "XML");
    refused("c.xml", "<net><edge/></net>", "another kind");
    refused("d.xml", "<!DOCTYPE a [<!ENTITY b 'c'>]><fcd-export/>", "entity");
    refused("a.json", "{", "JSON");
    refused("b.json", R"({"type": "FeatureCollection", "features": []})", "without anybody");
    refused("c.json",
            R"({"features": [{"temporalGeometry": {"datetimes": [1, 2], "coordinates": [[1, 2]]}}]})",
            "feature 1");
    refused("a.gz", std::string("\x1f\x8b\x08\0\0\0\0\0\0\0", 10), "cut short");
    refused("a.vsp", "2 - the number of splines\n2 - Num of control points\n1 2 3 4\n", "line 3");
    refused("a.sqlite", "SQLite format 3, and long enough for one to look at", "SQLite");
    refused("a.h5", "\x89HDF\r\n", "HDF5");

    auto changed = [&](const std::string& name, const char* query, const std::string& why) {
        write_two(folder, name);
        run_query(folder / name, query);
        refused(name, bytes_of(folder / name), why);
    };
    changed("b.sqlite", "DROP TABLE metadata", "metadata");
    changed("c.sqlite", "UPDATE metadata SET value = 'fast' WHERE key = 'fps'", "frames a second");
    changed("d.sqlite", "UPDATE geometry SET wkt = 'POLYGON ((1 2'", "walkable area");
    changed("e.sqlite", "UPDATE trajectory_data SET pos_x = 'here' WHERE id = 8", "no number");
    changed("f.sqlite", "UPDATE trajectory_data SET pos_x = 9e9 WHERE id = 8", "100 km");
    changed("g.sqlite",
            "ALTER TABLE trajectory_data RENAME TO old; CREATE VIEW trajectory_data AS SELECT * FROM old",
            "no plain table");
    const std::vector<HdfRow> row = {{7, 0, 1.5, 2.5, 1.7}};
    const std::string sound = tiny_hdf5(row, 25, "POLYGON ((0 0, 4 0, 4 3, 0 0))");
    refused("b.h5", tiny_hdf5({{7, 0, std::nan(""), 2.5, 1.7}}, 25, "POLYGON ((0 0, 4 0, 4 3, 0 0))"),
            "nobody");
    refused("d.h5", tiny_hdf5(row, -1, "POLYGON ((0 0, 4 0, 4 3, 0 0))"), "rate of frames");
    refused("e.h5", tiny_hdf5(row, 25, "CIRCLE (1)"), "walkable area");
    refused("f.h5", sound.substr(0, sound.size() - 1), "cut short");
    std::string chunked = sound;
    chunked[chunked.find(std::string("\x03\x01\x00\x0c", 4)) + 1] = 2;
    refused("g.h5", chunked, "h5repack");
}

// Whatever is cut off or changed, it is read or refused, and what is read is sound.
TEST(Trajectories, BrokenFilesAreReadSoundlyOrRefused) {
    TestFolder folder;
    folder.write("a.h5",
                 tiny_hdf5({{7, 0, 1.5, 2.5, 1.7}, {8, 0, 1, 2, 1}}, 25, "POLYGON ((0 0, 4 0, 4 3, 0 0))"));
    for (const char* name : {"a.csv", "a.txt", "a.sqlite", "a.xml", "a.json", "a.traj"})
        write_two(folder, name);
    folder.write("a.gpx",
                 "<gpx><trk><name>A</name><trkseg><trkpt lat='50' lon='6'><ele>99.5</ele>"
                 "<time>2024-05-01T12:00:00Z</time></trkpt><trkpt lat='50.00001' lon='6'>"
                 "<time>2024-05-01T12:00:01Z</time></trkpt></trkseg></trk></gpx>");
    folder.write("a.vsp", "1 - the number of splines\n2 - Num of control points\n1 2 3 4\n20 2 12 4\n");
    for (const std::string name :
         {"a.h5", "a.csv", "a.txt", "a.sqlite", "a.xml", "a.json", "a.traj", "a.gpx", "a.vsp"}) {
        const std::string sound = bytes_of(folder / name);
        const uint32_t count = name == "a.sqlite" ? 60 : 300;
        for (uint32_t n = 0; n < count; ++n) {
            std::string broken = sound;
            RandomKey key{1, n, 0, Purpose::body};
            if (n % 3 == 0) broken.resize(sound.size() * n / count);
            for (uint32_t k = 0; k < n % 5 && !broken.empty(); ++k) {
                const auto at =
                    static_cast<size_t>(random_unit(key, 2 * k) * static_cast<float>(broken.size()));
                broken[std::min(at, broken.size() - 1)] =
                    static_cast<char>(static_cast<uint8_t>(random_unit(key, 2 * k + 1) * 256));
            }
            Result<Trajectories> read = read_trajectories(folder.write("broken" + name, broken));
            if (!read) {
                EXPECT_TRUE(read.error().message.ends_with('.')) << read.error().message;
                continue;
            }
            EXPECT_GT(read->fps, 0);
            EXPECT_FALSE(read->sightings.empty());
            for (const Sighting& s : read->sightings) EXPECT_TRUE(std::isfinite(s.at.x + s.at.z + s.height));
        }
    }
}

TEST(Trajectories, OutlinesAreReadAndWritten) {
    const Result<std::vector<WalkablePolygon>> two = parse_wkt(
        " MULTIPOLYGON (((0 0, 2 0, 2 1, 0 0)), ((5 5, 9 5, 9 9, 5 5), (6 5.5, 7 5.5, 7 6, 6 5.5)))");
    ASSERT_TRUE(two);
    ASSERT_EQ(two->size(), 2u);
    EXPECT_EQ((*two)[1].holes.size(), 1u);
    const Result<std::vector<WalkablePolygon>> again = parse_wkt(wkt_of(*two));
    ASSERT_TRUE(again);
    EXPECT_EQ(wkt_of(*again), wkt_of(*two));
    for (const char* broken :
         {"", "POLYGON", "POLYGON ((0 0, 1 1))", "POLYGON ((0 0, 1 1, 2 0)", "POINT (1 2)",
          "POLYGON ((0 0, nan 1, 2 0, 0 0))", "POLYGON ((0 0, 1 1, 2 0, 0 0)) and more"})
        EXPECT_FALSE(parse_wkt(broken)) << broken;
}

void add_square(Ground& ground, Vec2 low, Vec2 high, float y, Surface kind) {
    const auto base = static_cast<uint32_t>(ground.vertices.size());
    for (Vec2 p : {Vec2{high.x, high.z}, Vec2{high.x, low.z}, Vec2{low.x, low.z}, Vec2{low.x, high.z}})
        ground.vertices.push_back({p.x, y, p.z});
    for (uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) ground.indices.push_back(base + i);
    ground.kinds.insert(ground.kinds.end(), 2, kind);
}

TEST(Trajectories, TheGroundThatIsWalkedOnIsTold) {
    // A square without its middle, a kerb along one side, water beside it, a bridge over all; a place apart.
    Ground ground;
    for (int i = 0; i < 9; ++i) {
        if (i == 4) continue;
        const int column = i % 3, row = i / 3;
        const Vec2 low{static_cast<float>(column), static_cast<float>(row)};
        add_square(ground, low, low + Vec2{1, 1}, i < 3 ? 0.12f : 0, Surface::plaza);
    }
    add_square(ground, {3, 0}, {9, 3}, -1, Surface::water);
    add_square(ground, {-1, 2.25f}, {4, 2.75f}, 5, Surface::path);  // corners in the middle of edges
    add_square(ground, {20, 20}, {21, 21}, 0, Surface::grass);
    index_ground(ground);
    const std::vector<WalkablePolygon> area = walkable_area(ground);
    ASSERT_EQ(area.size(), 2u);
    EXPECT_EQ(area[0].outer.size(), 12u) << wkt_of(area);
    ASSERT_EQ(area[0].holes.size(), 1u);
    EXPECT_EQ(area[0].holes[0].size(), 4u);
    EXPECT_EQ(area[1].outer.size(), 4u);
}

TEST(Trajectories, CorpusIsRead) {
    const fs::path corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "trajectories";
    if (!fs::exists(corpus)) GTEST_SKIP() << "there is no " << corpus;
    struct Known {
        const char* name;
        float fps;
        size_t people, polygons;
        Vec2 first;
    };
    for (const Known& known : {Known{"040_c_56_h-.txt", 25, 75, 0, {2.1569f, -2.659f}},
                               Known{"bi_corr_400_b_03.txt", 25, 480, 0, {-5.5456f, -3.09452f}},
                               Known{"jpsvis_stairs_trajectories.txt", 8, 7, 6, {1, -0.5f}},
                               Known{"pathfinder.csv", 1, 150, 0, {-9.618715f, 2.915757f}},
                               Known{"sumo_grid4x4_300peds_fcd.xml.gz", 2, 300, 1, {92.3f, -103.52f}},
                               Known{"vadere_postvis.traj", 8, 20, 1, {2.5464f, -6.9901f}},
                               Known{"trajectories.sqlite", 25, 30, 1, {-2.3353f, -8.2869f}},
                               Known{"00_01a.h5", 25, 46, 1, {-0.176f, -1.88047f}}}) {
        SCOPED_TRACE(known.name);
        Result<Trajectories> read = read_trajectories((corpus / known.name).string());
        ASSERT_TRUE(read) << read.error().message;
        EXPECT_EQ(read->fps, known.fps);
        EXPECT_EQ(read->area.size(), known.polygons);
        std::vector<uint32_t> ids;
        for (const Sighting& s : read->sightings) ids.push_back(s.id);
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        EXPECT_EQ(ids.size(), known.people);
        const auto first = std::find_if(read->sightings.begin(), read->sightings.end(),
                                        [](const Sighting& s) { return s.id == 1; });
        ASSERT_NE(first, read->sightings.end());
        EXPECT_NEAR(first->at.x, known.first.x, 1e-3);
        EXPECT_NEAR(first->at.z, known.first.z, 1e-3);
    }
}

// Even-odd, of one polygon and its holes.
bool is_inside(const WalkablePolygon& polygon, Vec2 p) {
    bool inside = false;
    auto count = [&](const std::vector<Vec2>& ring) {
        for (size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
            if ((ring[i].z > p.z) != (ring[j].z > p.z) &&
                p.x < ring[i].x + (ring[j].x - ring[i].x) * (p.z - ring[i].z) / (ring[j].z - ring[i].z))
                inside = !inside;
    };
    count(polygon.outer);
    for (const std::vector<Vec2>& hole : polygon.holes) count(hole);
    return inside;
}

// What lies beside them is theirs: people are on it, and as high as it is.
TEST(Trajectories, CorpusWalksOnItsGround) {
    const fs::path corpus = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "trajectories";
    if (!fs::exists(corpus)) GTEST_SKIP() << "there is no " << corpus;
    for (const char* name :
         {"sumo_grid4x4_300peds_fcd.xml.gz", "vadere_postvis.traj", "jpsvis_stairs_trajectories.txt"}) {
        SCOPED_TRACE(name);
        Result<Trajectories> read = read_trajectories((corpus / name).string());
        ASSERT_TRUE(read) << read.error().message;
        size_t on_it = 0;
        for (const Sighting& s : read->sightings)
            on_it += std::any_of(read->area.begin(), read->area.end(), [&](const WalkablePolygon& polygon) {
                const float height = polygon.level + dot(polygon.rise, s.at);
                return is_inside(polygon, s.at) &&
                       (read->heights == HeightsOf::nothing || std::fabs(height - s.height) < 0.02f);
            });
        EXPECT_GT(on_it * 100, read->sightings.size() * 99) << on_it << " of " << read->sightings.size();
    }
}

}  // namespace
}  // namespace flaneur
