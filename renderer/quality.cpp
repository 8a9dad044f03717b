#include "renderer/quality.h"

#include <array>

namespace flaneur {
namespace {

constexpr std::array<QualityLevel, 4> k_levels = {{{"low", 1, 1024, 0.7f, false, false},
                                                   {"medium", 1, 2048, 1, true, false},
                                                   {"high", 2, 4096, 1.6f, true, false},
                                                   {"ultra", 2, 4096, 2.2f, true, true}}};

}  // namespace

const QualityLevel& quality_level(Quality quality) { return k_levels[static_cast<size_t>(quality)]; }

std::optional<Quality> quality_named(const std::string& name) {
    for (size_t i = 0; i < k_levels.size(); ++i)
        if (name == k_levels[i].name) return static_cast<Quality>(i);
    return {};
}

}  // namespace flaneur
