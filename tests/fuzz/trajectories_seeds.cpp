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
    for (const char* name : {"a.csv", "a.sqlite", "a.txt"}) {
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
    write_seed(folder / "b.txt", std::string("#framerate:8.00\n#X,Y,Z: (in metres)\n1 0 1.5 0 0 9 9 9\n"));
}
