// A way among walls by rays, with neither map nor goal: "The Walker Report".
#pragma once

#include <iterator>
#include <optional>

#include "sim/base/rng.h"

namespace flaneur {

inline constexpr float k_ray_ahead = 4,
                       k_ray_aside = 5;  // metres, usually, of the ray straight on and of the others
inline constexpr float k_fan[] = {-90, -60, -45, -30, -20, -10, 0, 10, 20, 30, 45, 60, 90};  // degrees
inline constexpr float k_fan_behind[] = {-130, -120, -100, 100, 120, 130};  // if none of those is free

inline constexpr float k_near_wall = 1;  // metres of the ray ahead, where all others are short

// By how many degrees, more than 0 to the left, one turns before whom the ray ahead has met something: by one
// of the free ones by chance. None: all are blocked. clear(degrees) says how many metres a ray of `reach`
// comes.
template <class Clear>
std::optional<float> free_way(const Clear& clear, float reach, RandomKey key) {
    auto choose = [&](const auto& fan) -> std::optional<float> {
        float free[std::size(k_fan)];
        uint32_t count = 0;
        for (const float degrees : fan)
            if (clear(degrees) >= reach) free[count++] = degrees;
        if (count == 0) return {};
        return free[static_cast<uint32_t>(random_unit(key) * static_cast<float>(count))];
    };
    static_assert(std::size(k_fan) >= std::size(k_fan_behind));
    if (const auto ahead = choose(k_fan)) return ahead;
    return choose(k_fan_behind);
}

// By how many one turns where all are blocked: to the longest of all and of the way back. Only near a wall,
// which is `ahead` metres off, and nearer than to what is at the longest's end: so nobody turns about and
// about in a small room. 0: one goes on.
template <class Clear>
float longest_way(const Clear& clear, float ahead) {
    if (ahead >= k_near_wall) return 0;
    float longest = 2 * ahead, turn = 0;
    auto take = [&](float degrees) {
        const float metres = clear(degrees);
        if (metres > longest) longest = metres, turn = degrees;
    };
    for (const float degrees : k_fan) take(degrees);
    for (const float degrees : k_fan_behind) take(degrees);
    take(180);
    return turn;
}

}  // namespace flaneur
