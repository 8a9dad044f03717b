#include "assets/measures/ttc.h"

#include <cmath>
#include <limits>

#include "sim/base/math.h"

namespace flaneur {

// Seconds, beyond which it is never: rounding lets two who walk side by side close in a little.
constexpr double k_longest_ttc = 3600;

float time_to_collision(Vec2 apart, Vec2 velocity, float reach) {
    constexpr float k_never = std::numeric_limits<float>::infinity();
    auto times = [](Vec2 a, Vec2 b) { return wide(a.x) * wide(b.x) + wide(a.z) * wide(b.z); };
    const double beyond = times(apart, apart) - wide(reach) * wide(reach), closing = times(apart, velocity);
    if (beyond <= 0) return 0;
    if (!(closing < 0)) return k_never;
    const double inner = closing * closing - times(velocity, velocity) * beyond;
    if (inner < 0) return k_never;
    const double seconds = beyond / (std::sqrt(inner) - closing);  // without taking like from like
    return seconds < k_longest_ttc ? static_cast<float>(seconds) : k_never;
}

std::vector<NextCollision> next_collisions(const TrackTable& table, std::span<const Vec2> velocities,
                                           float radius, FrameRange range, Workers& workers) {
    const std::vector<Sighting>& all = table.of->sightings;
    const auto [first, last] = frames_in(table, range);
    constexpr float k_unknown = std::numeric_limits<float>::quiet_NaN();
    std::vector<NextCollision> next(all.size());
    for (size_t i = 0; i < all.size(); ++i) next[i] = {k_unknown, all[i].id};
    parallel_for(workers, last - first, 8, [&, first = first](size_t begin, size_t end, int) {
        for (size_t k = first + begin; k < first + end; ++k)
            for (uint32_t i = table.begins[k]; i < table.begins[k + 1]; ++i) {
                if (std::isnan(velocities[i].x)) continue;
                next[i].seconds = std::numeric_limits<float>::infinity();
                for (uint32_t j = table.begins[k]; j < table.begins[k + 1]; ++j) {
                    if (i == j || std::isnan(velocities[j].x)) continue;
                    const float seconds =
                        time_to_collision(all[j].at - all[i].at, velocities[j] - velocities[i], 2 * radius);
                    if (seconds < next[i].seconds) next[i] = {seconds, all[j].id};
                }
            }
    });
    return next;
}

}  // namespace flaneur
