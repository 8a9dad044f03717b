// libFuzzer's target for scenes: any bytes are a scene within its bounds or are refused in a short sentence.
#include <cstdlib>
#include <string_view>

#include "assets/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace flaneur;
    auto scene = parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz");
    if (!scene) {
        const std::string& message = scene.error().message;
        if (message.size() > 500) std::abort();
        for (char c : message)
            if (static_cast<unsigned char>(c) < 0x20) std::abort();
        return 0;
    }
    bool bounded = scene->walkers >= 0 && scene->walkers <= k_max_walkers && scene->scale >= k_least_scale &&
                   scene->scale <= k_most_scale && scene->blocks >= 1 && scene->hour >= 0 &&
                   scene->hour < 24 && !(scene->built != BuiltIn::district && !scene->city.empty());
    for (const PeopleShare& people : scene->people)
        bounded = bounded && people.share >= k_least_share && people.share <= k_most_share;
    if (!bounded) std::abort();
    return 0;
}
