#include "assets/outfit.h"

#include <span>

#include "assets/colour.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

// The ten tones of the Monk scale (Ellis Monk, 2022).
constexpr uint32_t k_skin[] = {rgb(0xf6ede4), rgb(0xf3e7db), rgb(0xf7ead0), rgb(0xeadaba), rgb(0xd7bd96),
                               rgb(0xa07e56), rgb(0x825c43), rgb(0x604134), rgb(0x3a312a), rgb(0x292420)};
// Cumulative shares of a mixed city, of 100.
constexpr int k_skin_shares[] = {3, 10, 22, 42, 60, 74, 85, 93, 97, 100};

constexpr uint32_t k_fair_hair[] = {rgb(0x2a211c), rgb(0x3b2a20), rgb(0x4f3826), rgb(0x6e4f31), rgb(0x8f6b42),
                                    rgb(0xb4935f), rgb(0x7a3f24), rgb(0x8d8a86), rgb(0xb9b6b1)};
constexpr uint32_t k_dark_hair[] = {rgb(0x191614), rgb(0x1f1a17), rgb(0x2a211c), rgb(0x33271f),
                                    rgb(0x6f6c69)};

constexpr uint32_t k_charcoal = rgb(0x3a3d42), k_navy = rgb(0x26324a), k_denim = rgb(0x4f6a8a),
                   k_black = rgb(0x1f2023), k_camel = rgb(0xb08a5a), k_olive = rgb(0x6a6b4a),
                   k_cream = rgb(0xe9e1d2), k_white = rgb(0xf2f0ec), k_burgundy = rgb(0x6b2b35),
                   k_rust = rgb(0xa4532f), k_teal = rgb(0x2f6b6b), k_mustard = rgb(0xc59a3d),
                   k_red = rgb(0xb23a36), k_sky = rgb(0x7fb0d0), k_grey = rgb(0x8a8d90),
                   k_brown = rgb(0x4a362a);

constexpr uint32_t k_bottoms[] = {k_charcoal, k_navy,  k_denim, k_denim, k_black, k_black,
                                  k_charcoal, k_olive, k_brown, k_camel, k_grey};
constexpr uint32_t k_tops[] = {k_charcoal, k_navy, k_black, k_camel, k_olive, k_cream, k_white, k_white,
                               k_burgundy, k_rust, k_teal,  k_grey,  k_denim, k_cream, k_navy,  k_brown};
constexpr uint32_t k_bright[] = {k_mustard, k_red, k_sky, k_teal};
constexpr uint32_t k_shoes[] = {k_black, k_brown, rgb(0x3b2c22), k_charcoal, rgb(0xd8d5cf)};
constexpr uint32_t k_inner[] = {k_white, k_cream, k_white, k_sky, k_grey};

// A colour a little lighter or darker, by up to `amount`.
uint32_t varied(uint32_t colour, float amount, RandomKey key, uint32_t index) {
    return shaded(colour, 1 + random_between(key, -amount, amount, index));
}

// A chip of the Monk scale shows skin as it is perceived; as an albedo under a bright sun the pale ones would
// be white, so they are brought down to what is measured on skin, the more the paler they are.
uint32_t skin_albedo(uint32_t chip) {
    constexpr float k_pale[3] = {0.86f, 0.76f, 0.70f};
    uint32_t out = 0xff000000u;
    for (int i = 0; i < 3; ++i) {
        float channel = static_cast<float>(chip >> (8 * i) & 0xffu);
        float pale = smoothstep(40, 200, channel);
        out |= static_cast<uint32_t>(channel * lerp(1, k_pale[i], pale)) << (8 * i);
    }
    return out;
}

}  // namespace

std::array<uint32_t, k_tint_count> outfit(const PersonOptions& person, uint64_t seed, uint32_t walker) {
    RandomKey key{seed, walker, 0, Purpose::colour};
    uint32_t draw = 0;
    auto pick = [&](std::span<const uint32_t> from) { return from[random_bits(key, draw++) % from.size()]; };
    int share = static_cast<int>(random_bits(key, draw++) % 100);
    size_t tone = 0;
    while (k_skin_shares[tone] <= share) ++tone;

    std::array<uint32_t, k_tint_count> tints;
    auto set = [&](Tint tint, uint32_t colour, float amount) {
        tints[static_cast<size_t>(tint)] = varied(colour, amount, key, draw++);
    };
    tints[static_cast<size_t>(Tint::none)] = 0xffffffffu;
    set(Tint::skin, skin_albedo(k_skin[tone]), 0.03f);
    (void)person;
    set(Tint::hair, tone < 5 ? pick(k_fair_hair) : pick(k_dark_hair), 0.1f);
    uint32_t bottom = pick(k_bottoms), top = pick(k_tops);
    bool bright = random_bits(key, draw++) % 8 == 0;
    if (bright) top = pick(k_bright);
    // Not one colour from neck to ankle, unless it is black.
    if (top == bottom && top != k_black) top = k_cream;
    set(Tint::bottom, bottom, 0.1f);
    set(Tint::top, top, 0.07f);
    set(Tint::shoes, pick(k_shoes), 0.08f);
    set(Tint::accent, pick(k_inner), 0.03f);
    return tints;
}

}  // namespace flaneur
