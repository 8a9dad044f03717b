// trajectories_seeds FOLDER: small files of every format for the fuzzer to begin with.
#include <cstdio>

#include "assets/trajectories/write.h"
#include "tests/assets/trajectories/tiny_hdf5.h"
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    using namespace flaneur;
    const std::filesystem::path folder = seeds_folder(argc, argv);
    const std::vector<WalkablePolygon> room = {{{{-5, -4}, {5, -4}, {5, 6}}, {{{0, 0}, {1, 0}, {1, 1}}}}};
    const Sighting people[] = {{0, 3, {1.5f, -2}, 0.1f, {1, 0}}, {0, 8, {0.5f, 2}, 0, {0, 1}}};
    for (const char* name : {"a.csv", "a.sqlite", "a.txt", "a.xml", "a.json", "a.traj"}) {
        const std::string path = (folder / name).string();
        FILE* file = std::fopen(path.c_str(), "wb");
        if (!file) return 1;
        Result<TrajectoryWriterPtr> writer =
            begin_trajectories(*trajectory_format_of(name), file, path, 8, room, "nobody's");
        if (!writer || !add_frame(**writer, 0, people) || !add_frame(**writer, 1, {people, 1}) ||
            !finish_trajectories(std::move(*writer)))
            return 1;
        std::fclose(file);
    }
    write_seed(folder / "a.h5", tiny_hdf5({{7, 0, 1.5, 2.5, 1.7}, {7, 1, 1.75, 2.5, 1.7}}, 12.5,
                                          "POLYGON ((0 0, 4 0, 4 3, 0 0))"));
    const std::pair<const char*, std::string> texts[] = {
        {"b.txt", "#framerate:8.00\n#X,Y,Z: (in metres)\n1 0 1.5 0 0 9 9 9\n"},
        {"c.csv", "\"t\",\"id\",\"x\",\"y\"\n\"s\",\"\",\"m\",\"m\"\n0.0,3,1,2\n1.5,3,1.5,2\n"},
        {"d.csv", "recordingId,trackId,frame,xCenter,yCenter,heading,width,length\n0,0,0,10,-5,90,0,0\n"},
        {"e.csv", "time [ms];agent;x [cm];y [cm]\n0,5;eve;100;60\n100;eve;110;60\n"},
        {"f.txt", "0 1 0.5 1.5\n10 1 0.9 1.5\n20 1 1.4 1.5\n"},
        {"a.gpx",
         "<gpx><trk><trkseg><trkpt lat='50' lon='6'><ele>9</ele><time>2024-05-01T12:00:00Z</time></trkpt>"
         "</trkseg></trk></gpx>"},
        {"a.vsp", "1 - the number of splines\n2 - Num of control points\n1 2 3 4\n20 2 12 4\n"},
        {"a.geojson",
         R"({"features": [{"geometry": {"type": "Point", "coordinates": [7, 51]}, "properties": {"id": 4,
            "time": 0}}, {"geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1]]]}}]})"},
        {"room.xml",
         "<geometry><room id='0'><subroom id='0' A_x='1' C_z='2'><polygon><vertex px='0' py='0'/>"
         "<vertex px='4' py='0'/><vertex px='4' py='2'/></polygon></subroom></room></geometry>"},
        {"net.xml",
         "<net><edge id='a'><lane id='a_0' width='4' shape='0,0 10,0'/></edge>"
         "<junction id='j' shape='10,-2 14,-2 14,2 10,2'/></net>"},
        {"floor.xml", "<floor><layer><wall><point x='0' y='0'/><point x='4' y='0'/></wall></layer></floor>"},
        {"a.scenario", R"({"topography": {"attributes": {"bounds": {"x": 0, "y": 0, "width": 8, "height": 6}},
            "obstacles": [{"shape": {"type": "CIRCLE", "radius": 1, "center": {"x": 2, "y": 2}}}]}})"}};
    for (const auto& [name, text] : texts) write_seed(folder / name, text);
}
