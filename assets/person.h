// Who somebody of the built-in people is: of these options the generator makes a body, a face and clothes
// (see generate_person in assets/character.h, and draw_population for a street's worth of them).
#pragma once

#include <cstdint>

#include "sim/body/wear.h"

namespace flaneur {

// Hair, and what is worn and carried.
enum class Hair : uint8_t {
    cropped,
    parted,
    full,
    curly,
    bald,  // but for a fringe round the back
    bob,
    bangs,
    shoulder_length,
    long_hair,
    bun,
    ponytail,
};
inline constexpr int k_hair_count = 11;
enum class Beard : uint8_t { none, moustache, full };
enum class Top : uint8_t { t_shirt, shirt, sweater, hoodie };
enum class Over : uint8_t { none, jacket, open_jacket, coat, vest };
enum class Bottom : uint8_t { slim, straight, wide, shorts, skirt, long_skirt, dress };
enum class Shoes : uint8_t { sneakers, leather, boots, pumps };
enum class Hat : uint8_t { none, cap, beanie, brimmed };

struct PersonOptions {
    uint64_t seed = 1;     // draws the face
    float height = 1.72f;  // metres, crown above ground
    bool woman = false;    // or girl
    float age = 30;        // years, 5..85
    float build = 0;       // -1 slight .. 1 heavy
    Hair hair = Hair::cropped;
    Beard beard = Beard::none;
    Top top = Top::sweater;
    Over over = Over::none;
    Bottom bottom = Bottom::straight;
    Shoes shoes = Shoes::sneakers;
    Hat hat = Hat::none;
    Bag bag = Bag::none;
    bool glasses = false, scarf = false, headphones = false;
    bool phone = false, stick = false;  // in the right hand, one of them
    bool pram = false;  // pushes one, with both hands: neither of those then, nor a bag or scarf
};

}  // namespace flaneur
