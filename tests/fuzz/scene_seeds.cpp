// scene_seeds FOLDER: small scenes for the fuzzer to begin with.
#include "tests/fuzz/seeds.h"

int main(int argc, char** argv) {
    std::filesystem::path folder = seeds_folder(argc, argv);
    int number = 0;
    for (
        const char* scene :
        {R"({"walkers": 500, "seed": 1, "blocks": 4, "camera": "overview", "time": "17:30"})",
         R"({"city": "maps/a.osm", "terrain": "N43E007.hgt", "walkers": 2000, "weather": "overcast"})",
         R"({"city": "a.glb", "scale": 0.01, "sun_height": 40.5, "sun_heading": 120})",
         R"({"people": [{"character": "a.glb", "share": 1}, {"builtin": true, "share": 9}], "idles": ["a.glb:Idle"]})",
         R"({"built": "asteroid", "walkers": 100000, "seed": 18446744073709551615})",
         R"({"walkers": [[[[]]]], "city": {"a": ["\u001b[2J\n"]}})"})
        write_seed(folder / (std::to_string(++number) + ".json"), std::string(scene));
}
