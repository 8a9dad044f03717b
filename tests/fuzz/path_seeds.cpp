// path_seeds FOLDER: small camera paths for the fuzzer to begin with.
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    std::filesystem::path folder = seeds_folder(argc, argv);
    int number = 0;
    for (const char* path :
         {R"({"keys": [{"time": 0, "eye": [0, 1.7, -20], "target": [0, 1.5, 0], "fov": 32}]})",
          R"({"keys": [{"time": 1e-3, "eye": [1e6, -1e6, 0.1], "target": [0, 0, 0]},
                                          {"time": 36000, "eye": [0, 0, 0], "target": [1, 0, 0], "fov": 150}]})",
          R"({"keys": [[]], "a\u001b": 1e999})"})
        write_seed(folder / (std::to_string(++number) + ".json"), std::string(path));
}
