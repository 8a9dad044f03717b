#include "sim/roam.h"
#include "tools/flaneur/bench/bench.h"

namespace flaneur {

namespace {

constexpr uint32_t k_creatures = 16, k_ticks = 60;
constexpr uint64_t k_seed = 1;

struct Beasts {
    Roam roam;
    Linkages bones;
};

Beasts beasts_on_a_ball() {
    Beasts b;
    b.roam.compound.spheres = {{{0, 0, 0}, 12}};
    index_compound(b.roam.compound);
    constexpr float k_size = 1.5f, k_speed = 0.9f;
    b.roam.walkers = place_on_surface(b.roam.compound, std::vector<float>(k_creatures, k_speed),
                                      std::vector<float>(k_creatures, creature_radius(k_size)), k_seed);
    for (uint32_t n = 0; n < b.roam.walkers.position.size(); ++n)
        b.roam.creatures.push_back(make_creature(rays_of(b.roam.compound), b.roam.walkers, n, k_size));
    b.bones = make_bones(b.roam.creatures);
    return b;
}

}  // namespace

Kernel creature_kernel() {
    return {"creature",
            [beasts = beasts_on_a_ball(), workers = std::shared_ptr(make_workers(1)), tick = 0u]() mutable {
                Roam& roam = beasts.roam;
                const size_t count = roam.creatures.size();
                return ns_each(count * k_ticks, [&] {
                    for (uint32_t end = tick + k_ticks; tick < end; ++tick) {
                        look_round(roam.walkers);
                        walk_on_surface(roam.compound, roam.walkers, 0, count, k_seed, tick, k_tick);
                        step_creatures(roam, beasts.bones, *workers);
                    }
                });
            }};
}

}  // namespace flaneur
