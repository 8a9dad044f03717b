#include "sim/base/isa.h"

#include <hwy/highway.h>

#include <string>

namespace flaneur {

namespace {

struct Isa {
    std::string_view name;
    int64_t target;  // Highway's
};

constexpr Isa k_isas[] = {
    {"scalar", HWY_SCALAR}, {"sse4", HWY_SSE4}, {"avx2", HWY_AVX2}, {"avx512", HWY_AVX3}, {"neon", HWY_NEON}};

// What the CPU has, whatever was chosen before.
int64_t available() {
    static const int64_t targets = hwy::SupportedTargets() & HWY_TARGETS;
    return targets;
}

}  // namespace

std::vector<std::string_view> isa_names() {
    std::vector<std::string_view> names;
    for (const Isa& isa : k_isas) {
        if (available() & isa.target) names.push_back(isa.name);
    }
    return names;
}

Result<void> use_isa(std::string_view name) {
    int64_t all = available();
    if (name == "best") {
        hwy::SetSupportedTargetsForTest(0);
        return {};
    }
    for (const Isa& isa : k_isas) {
        if (isa.name != name || !(all & isa.target)) continue;
        hwy::SetSupportedTargetsForTest(isa.target);
        return {};
    }
    std::string here;
    for (std::string_view had : isa_names()) here += std::string(had) + ", ";
    return Error{"This flaneur has no instruction set " + std::string(name) + " on this CPU; it has " + here +
                 "and best, the widest of them."};
}

}  // namespace flaneur
