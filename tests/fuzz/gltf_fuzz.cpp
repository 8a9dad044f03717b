// libFuzzer's target for what reads glTF and VRM: any bytes are loaded or refused, as a character, as motion
// and as a city.
#include <tiny_gltf.h>

#include <cstdlib>

#include "assets/gltf/character/character.h"
#include "assets/gltf/character/clip.h"
#include "assets/gltf/city/city.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    auto model = parse_gltf(std::span(data, size), "/nowhere", "fuzz");
    if (!model) return 0;
    auto character = make_character(*model, "fuzz");
    if (character)
        for (const auto& level : character->lods)
            for (uint32_t i : level)
                if (i >= character->vertices.size()) std::abort();
    (void)make_motion(*model, "fuzz", "");
    auto city = make_gltf_city(*model, "fuzz");
    if (city)
        for (uint32_t i : city->scenery.indices)
            if (i >= city->scenery.vertices.size()) std::abort();
    return 0;
}
