#include "assets/stages/meadow.h"

#include "assets/colour.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr int k_rings = 26, k_spokes = 72;
constexpr float k_far = 420;  // metres that it reaches
constexpr float k_rise = 0.7f * k_far;
constexpr int k_trees = 90;
constexpr uint32_t k_meadow = rgb(0x748c50), k_wood = rgb(0x5c7a43);

float height_at(const Meadow& meadow, Vec2 p) {
    const float up = smoothstep(0, k_rise, length(p) - meadow.level);
    auto roll = [&](float x, float from) { return sin_cos(x * 0.014f + from).sine; };
    return -meadow.below +
           up * (20 + 9 * roll(p.x + 0.6f * p.z, meadow.turn) + 7 * roll(1.7f * p.z - p.x, 2 * meadow.turn));
}

}  // namespace

void add_land(Scenery& s, const Meadow& meadow) {
    const auto first = static_cast<uint32_t>(s.vertices.size());
    for (int ring = 0; ring <= k_rings; ++ring)
        for (int spoke = 0; spoke < k_spokes; ++spoke) {
            const SinCos at = sin_cos(2 * k_pi * static_cast<float>(spoke) / k_spokes);
            const float share = static_cast<float>(ring) / k_rings;
            const Vec2 p = Vec2{at.cosine, at.sine} * (meadow.from + share * share * k_far);
            constexpr float k_step = 2;
            const float height = height_at(meadow, p);
            const Vec3 normal{height - height_at(meadow, p + Vec2{k_step, 0}), k_step,
                              height - height_at(meadow, p + Vec2{0, k_step})};
            const float wood = smoothstep(
                0.25f, 0.7f, 0.5f + 0.5f * sin_cos(p.x * 0.031f - p.z * 0.023f + meadow.turn).sine);
            const uint32_t colour = wood * share > 0.3f ? k_wood : k_meadow;
            s.vertices.push_back(
                {at_height(p, height - (ring == 0 ? 0.3f : 0)), normalize_or(normal, {0, 1, 0}), {}, colour});
        }
    for (uint32_t ring = 0; ring < k_rings; ++ring)
        for (uint32_t spoke = 0; spoke < k_spokes; ++spoke) {
            const uint32_t next = (spoke + 1) % k_spokes, a = first + ring * k_spokes + spoke,
                           b = first + ring * k_spokes + next, c = a + k_spokes, d = b + k_spokes;
            for (const uint32_t k : {a, b, c, b, d, c}) s.indices.push_back(k);
            s.pictures.insert(s.pictures.end(), 2, ~0u);
            s.uses.insert(s.uses.end(), 2, SceneryUse::backdrop);
        }
}

void add_trees(City& city, const Meadow& meadow, float from, RandomKey key) {
    for (uint32_t k = 0; k < k_trees; ++k) {
        const SinCos at = sin_cos(2 * k_pi * random_unit(key, 10 + 3 * k));
        const float share = random_unit(key, 11 + 3 * k);
        const Vec2 p = Vec2{at.cosine, at.sine} * lerp(from, 150, share * share);
        const float size = random_unit(key, 12 + 3 * k);
        city.props.push_back({.kind = PropKind::tree,
                              .position = at_height(p, height_at(meadow, p)),
                              .height = lerp(5, 12, size),
                              .radius = lerp(1.8f, 4, size),
                              .seed = k});
    }
}

}  // namespace flaneur
