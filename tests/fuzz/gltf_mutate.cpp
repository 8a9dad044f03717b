// How libFuzzer changes glTF: as JSON too.
#include <cstring>
#include <random>

#include "assets/gltf/json.h"

namespace {

using namespace flaneur;

constexpr size_t k_header = 20;  // of a .glb up to its JSON

// Everything in the tree below `at`, itself included.
void collect(Json& at, std::vector<Json*>& all) {
    all.push_back(&at);
    if (at.is_structured())
        for (Json& below : at) collect(below, all);
}

// Changes one value to another that is likely to hurt: a number to one at a limit, a part to a copy of
// another part, or nothing.
void mutate(Json& gltf, std::minstd_rand& random) {
    std::vector<Json*> all;
    collect(gltf, all);
    Json& victim = *all[random() % all.size()];
    constexpr int64_t k_numbers[] = {
        -1,   0,     1,     2,          3,          4,          5,
        7,    255,   256,   5120,       5121,       5123,       5125,
        5126, 65535, 65536, 0x7fffffff, 0x80000000, 0xffffffff, 0x7fffffffffffffff};
    switch (random() % 5) {
        case 0:
            victim = k_numbers[random() % std::size(k_numbers)];
            break;
        case 1:
            if (victim.is_number()) victim = victim.get<double>() + double(random() % 7) - 3;
            break;
        case 2:
            if (victim.is_array() && !victim.empty()) victim.erase(random() % victim.size());
            if (victim.is_object() && !victim.empty())
                victim.erase(std::next(victim.begin(), long(random() % victim.size())).key());
            break;
        case 3:
            if (victim.is_array() && !victim.empty())
                victim.push_back(Json(victim[random() % victim.size()]));
            break;
        default:
            victim = Json(*all[random() % all.size()]);
    }
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t most);

// Half of the time mutates a .glb's JSON as JSON, which bytes changed at random seldom remain.
extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t most, unsigned seed) {
    std::minstd_rand random(seed);
    uint32_t length = 0;
    if (size > k_header) std::memcpy(&length, data + 12, 4);
    bool is_glb = size > k_header && std::memcmp(data, "glTF", 4) == 0 && length <= size - k_header;
    if (!is_glb || random() % 2 == 0) return LLVMFuzzerMutate(data, size, most);
    Json gltf = Json::parse(data + k_header, data + k_header + length, nullptr, false);
    if (gltf.is_discarded()) return LLVMFuzzerMutate(data, size, most);
    for (unsigned n = 1 + random() % 3; n > 0; --n) mutate(gltf, random);
    std::string text = gltf.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    size_t rest = size - k_header - length, total = k_header + text.size() + rest;
    if (total > most) return LLVMFuzzerMutate(data, size, most);
    std::memmove(data + k_header + text.size(), data + k_header + length, rest);
    std::memcpy(data + k_header, text.data(), text.size());
    auto whole = uint32_t(total), json = uint32_t(text.size());
    std::memcpy(data + 8, &whole, 4);
    std::memcpy(data + 12, &json, 4);
    return total;
}
