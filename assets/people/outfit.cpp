#include "assets/outfit.h"

#include <algorithm>
#include <initializer_list>

#include "assets/colour.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

// The ten tones of the Monk scale (Ellis Monk, 2022).
constexpr uint32_t k_skin[] = {rgb(0xf6ede4), rgb(0xf3e7db), rgb(0xf7ead0), rgb(0xeadaba), rgb(0xd7bd96),
                               rgb(0xa07e56), rgb(0x825c43), rgb(0x604134), rgb(0x3a312a), rgb(0x292420)};
// Cumulative shares of a mixed city, of 100.
constexpr int k_skin_shares[] = {3, 10, 22, 42, 60, 74, 85, 93, 97, 100};

// Colours to pick from; what stands twice is picked more often.
struct Palette {
    std::array<uint32_t, 10> colours{};
    size_t size;
    Palette(std::initializer_list<uint32_t> from) : size(from.size()) {
        std::copy(from.begin(), from.end(), colours.begin());
    }
};

constexpr uint32_t k_charcoal = rgb(0x3a3d42), k_navy = rgb(0x26324a), k_denim = rgb(0x4f6a8a),
                   k_black = rgb(0x1f2023), k_camel = rgb(0xb08a5a), k_olive = rgb(0x6a6b4a),
                   k_cream = rgb(0xe9e1d2), k_white = rgb(0xf2f0ec), k_burgundy = rgb(0x6b2b35),
                   k_rust = rgb(0xa4532f), k_teal = rgb(0x2f6b6b), k_mustard = rgb(0xc59a3d),
                   k_red = rgb(0xb23a36), k_sky = rgb(0x7fb0d0), k_grey = rgb(0x8a8d90),
                   k_brown = rgb(0x4a362a), k_stone = rgb(0xb9ae98), k_pale_grey = rgb(0xc4c5c4),
                   k_dark_denim = rgb(0x34445c), k_tan = rgb(0x8a6238), k_rose = rgb(0xc09a94);

const Palette k_fair_hair = {rgb(0x2a211c), rgb(0x3b2a20), rgb(0x4f3826), rgb(0x4f3826),
                             rgb(0x6e4f31), rgb(0x8f6b42), rgb(0xb4935f), rgb(0x7a3f24)};
const Palette k_dark_hair = {rgb(0x191614), rgb(0x1f1a17), rgb(0x2a211c), rgb(0x33271f)};
const Palette k_grey_hair = {rgb(0x77746f), rgb(0x97948f), rgb(0xb3b0aa), rgb(0xcfccc6)};
const Palette k_bright = {k_mustard, k_red, k_sky};

// What a garment is cut from.
Palette upper_colours(const PersonOptions& p) {
    switch (p.over) {
        case Over::coat:
            return {k_camel, k_charcoal, k_navy, k_black, k_grey, k_olive, k_brown, k_burgundy, k_stone};
        case Over::vest:
            return {k_navy, k_black, k_olive, k_charcoal, k_burgundy, k_rust, k_teal};
        case Over::open_jacket:
            return {k_charcoal, k_navy, k_brown, k_grey, k_camel, k_black, k_olive, k_dark_denim};
        case Over::jacket:
            return {k_navy, k_olive, k_black, k_charcoal, k_brown, k_teal, k_dark_denim, k_stone};
        case Over::none:
            break;
    }
    switch (p.top) {
        case Top::shirt:
            return {k_white, k_sky, k_cream, k_white, k_dark_denim, k_pale_grey, k_rose, k_navy};
        case Top::t_shirt:
            return p.bottom == Bottom::dress
                       ? Palette{k_navy, k_burgundy, k_olive, k_teal, k_black, k_rust, k_rose, k_cream}
                       : Palette{k_white, k_pale_grey, k_navy, k_cream, k_charcoal, k_olive, k_white, k_rust};
        case Top::hoodie:
            return {k_grey, k_navy, k_charcoal, k_burgundy, k_olive, k_pale_grey, k_black, k_teal};
        case Top::sweater:
            break;
    }
    return {k_cream, k_navy, k_charcoal, k_camel, k_burgundy, k_grey, k_olive, k_teal, k_rust, k_stone};
}

Palette lower_colours(const PersonOptions& p) {
    switch (p.bottom) {
        case Bottom::slim:
            return {k_dark_denim, k_black, k_denim, k_charcoal, k_black, k_navy};
        case Bottom::straight:
            return p.age > 62 ? Palette{k_charcoal, k_navy, k_brown, k_grey, k_stone, k_olive}
                              : Palette{k_denim, k_dark_denim, k_charcoal, k_navy, k_stone, k_black, k_olive};
        case Bottom::wide:
            return {k_denim, k_black, k_cream, k_camel, k_navy, k_olive, k_charcoal};
        case Bottom::shorts:
            return {k_stone, k_navy, k_denim, k_olive, k_charcoal};
        default:
            return {k_navy, k_charcoal, k_black, k_olive, k_camel, k_burgundy, k_denim, k_brown};
    }
}

Palette shoe_colours(const PersonOptions& p) {
    switch (p.shoes) {
        case Shoes::sneakers:
            return {k_white, k_white, k_charcoal, k_black, k_pale_grey, k_navy, k_olive};
        case Shoes::leather:
            return {k_brown, k_black, rgb(0x3b2c22), k_tan};
        case Shoes::boots:
            return {k_black, rgb(0x3b2c22), k_brown, k_black};
        case Shoes::pumps:
            return {k_black, k_brown, k_navy, k_tan, k_burgundy};
    }
    return {k_black};
}

// What lies between: the shirt under a jacket, or, where there is none, a scarf, a hat, a bag.
Palette accent_colours(const PersonOptions& p) {
    if (p.over == Over::none)
        return {k_charcoal, k_navy, k_burgundy, k_camel, k_olive, k_grey, k_rust, k_teal};
    if (p.top == Top::shirt) return {k_white, k_white, k_sky, k_cream};
    if (p.top == Top::hoodie) return {k_grey, k_charcoal, k_pale_grey, k_navy};
    return {k_white, k_cream, k_grey, k_pale_grey, k_stone, k_charcoal, k_navy};
}

float lightness(uint32_t colour) {
    auto channel = [&](int shift) { return static_cast<float>(colour >> shift & 0xffu); };
    return .30f * channel(0) + .59f * channel(8) + .11f * channel(16);
}

// A colour a little lighter or darker, by up to `amount`.
uint32_t varied(uint32_t colour, float amount, RandomKey key, uint32_t index) {
    return shaded(colour, 1 + random_between(key, -amount, amount, index));
}

// A chip of the Monk scale shows skin as it is perceived; as an albedo under a bright sun the pale ones would
// be white, so they are brought down to what is measured on skin, the more the paler they are.
uint32_t skin_albedo(uint32_t chip) {
    constexpr float k_pale[3] = {0.86f, 0.76f, 0.70f};
    // The darkest are as warm as the others and catch more light than their chips say, or features would be
    // lost.
    constexpr float k_deep[3] = {74, 54, 42};
    float deep = .8f * smoothstep(96, 50, static_cast<float>(chip & 0xffu));
    uint32_t out = 0xff000000u;
    for (int i = 0; i < 3; ++i) {
        float channel = static_cast<float>(chip >> (8 * i) & 0xffu);
        float pale = smoothstep(40, 200, channel);
        channel = lerp(channel, k_deep[i], deep);
        out |= static_cast<uint32_t>(channel * lerp(1, k_pale[i], pale)) << (8 * i);
    }
    return out;
}

}  // namespace

std::array<uint32_t, k_tint_count> outfit(const PersonOptions& person, uint64_t seed, uint32_t walker) {
    RandomKey key{seed, walker, 0, Purpose::colour};
    uint32_t draw = 0;
    auto pick = [&](const Palette& from) { return from.colours[random_bits(key, draw++) % from.size]; };
    int share = static_cast<int>(random_bits(key, draw++) % 100);
    size_t tone = 0;
    while (k_skin_shares[tone] <= share) ++tone;

    std::array<uint32_t, k_tint_count> tints;
    auto set = [&](Tint tint, uint32_t colour, float amount) {
        tints[static_cast<size_t>(tint)] = varied(colour, amount, key, draw++);
    };
    tints[static_cast<size_t>(Tint::none)] = 0xffffffffu;
    set(Tint::skin, skin_albedo(k_skin[tone]), 0.03f);
    uint32_t hair = tone < 5 ? pick(k_fair_hair) : pick(k_dark_hair), grey = pick(k_grey_hair);
    // Grey comes between forty and seventy.
    if (random_unit(key, draw++) < smoothstep(40, 68, person.age)) hair = grey;
    set(Tint::hair, hair, 0.08f);

    uint32_t top = pick(upper_colours(person)), bottom = pick(lower_colours(person));
    uint32_t again = pick(lower_colours(person));
    // Darker below more often than not, and not one colour from neck to ankle, unless it is black.
    if (lightness(bottom) > lightness(top) && random_unit(key, draw++) < .6f &&
        lightness(again) < lightness(bottom))
        bottom = again;
    if (bottom == top && top != k_black) bottom = top == k_charcoal ? k_stone : k_charcoal;
    uint32_t accent = pick(accent_colours(person)), shoes = pick(shoe_colours(person));
    if (accent == top) accent = lightness(top) > 120 ? k_charcoal : k_pale_grey;
    // One in eight wears something bright, of the young one in four; the rest then keeps quiet.
    if (random_bits(key, draw++) % (person.age < 16 ? 4 : 8) == 0) {
        bool small = person.over == Over::none && (person.scarf || person.hat != Hat::none);
        bool quiet = lightness(bottom) < 90 || bottom == k_stone || bottom == k_denim;
        if (small && !quiet)
            accent = pick(k_bright);
        else if (person.over != Over::coat || person.age < 60)
            top = pick(k_bright), bottom = quiet ? bottom : k_navy;
    }
    set(Tint::bottom, bottom, 0.1f);
    set(Tint::top, top, 0.07f);
    set(Tint::shoes, shoes, 0.08f);
    set(Tint::accent, accent, 0.04f);
    return tints;
}

}  // namespace flaneur
