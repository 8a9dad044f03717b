// How large people are on a picture when their levels of detail take turns: for those who make levels and
// those who draw them.
#pragma once

namespace flaneur {

inline constexpr int k_person_levels = 5;

// A body whose sphere is less than so many pixels across takes the next coarser level.
inline constexpr float k_level_pixels[k_person_levels - 1] = {840, 420, 150, 70};

// The radius of that sphere, in heights of the body. A person stands 0.8 of it high.
inline constexpr float k_body_sphere = 0.62f;

}  // namespace flaneur
