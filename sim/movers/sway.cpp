#include "sim/movers/sway.h"

#include "sim/base/math.h"

namespace flaneur {

Vec3 sway_at(const Sway& sway, uint32_t tick) {
    auto wave = [&](int axis) {
        const uint32_t period = sway.period[axis];
        const uint32_t at = (tick % period + sway.start[axis]) % period;
        float share = sin_cos(2 * k_pi * static_cast<float>(at) / static_cast<float>(period)).sine;
        for (uint32_t n = 0; n < sway.rests; ++n) share *= 1.5f - 0.5f * share * share;
        return share;
    };
    return sway.middle + Vec3{sway.reach.x * wave(0), sway.reach.y * wave(1), sway.reach.z * wave(2)};
}

}  // namespace flaneur
