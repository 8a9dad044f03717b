// A way among walls by rays, with neither map nor goal: "The Walker Report".
#pragma once

#include <iterator>
#include <optional>

#include "sim/base/rng.h"

namespace flaneur {

inline constexpr float k_ray_ahead = 4, k_ray_aside = 5;  // metres, of the ray straight on and of the others
inline constexpr float k_fan[] = {-90, -60, -45, -30, -20, -10, 0, 10, 20, 30, 45, 60, 90};  // degrees
inline constexpr float k_fan_behind[] = {-130, -120, -100, 100, 120, 130};  // if none of those is free

// By how many degrees, more than 0 to the left, one turns before whom the ray ahead has met something: by one
// of the free ones by chance. None: all are blocked. is_free(degrees) says whether a ray of k_ray_aside
// metres meets nothing.
template <class IsFree>
std::optional<float> free_way(const IsFree& is_free, RandomKey key) {
    auto choose = [&](const auto& fan) -> std::optional<float> {
        float free[std::size(k_fan)];
        uint32_t count = 0;
        for (const float degrees : fan)
            if (is_free(degrees)) free[count++] = degrees;
        if (count == 0) return {};
        return free[static_cast<uint32_t>(random_unit(key) * static_cast<float>(count))];
    };
    static_assert(std::size(k_fan) >= std::size(k_fan_behind));
    if (const auto ahead = choose(k_fan)) return ahead;
    return choose(k_fan_behind);
}

}  // namespace flaneur
