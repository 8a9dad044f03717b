// How finely pictures are drawn: what each level spends.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace flaneur {

enum class Quality : uint8_t { low, medium, high, ultra };

struct QualityLevel {
    const char* name;
    uint32_t samples;            // of each pixel along each edge, 1 or 2
    uint32_t shadow_resolution;  // texels along a map's edge
    float detail;                // people are drawn as finely as if they were so much larger
    bool smooths_edges;          // by FXAA
    bool has_occlusion;          // ambient occlusion from the depths on the picture
};
const QualityLevel& quality_level(Quality quality);

// "low", "medium", "high", "ultra".
std::optional<Quality> quality_named(const std::string& name);

}  // namespace flaneur
