// A street's worth of different people for the built-in generator.
#pragma once

#include <cstdint>
#include <vector>

#include "assets/character.h"

namespace flaneur {

// Half of them women, an eighth children from five years on, a sixth old; heights as guided by age and sex,
// garments, cuts and things carried dealt like cards, so that 24 people show nearly every one of them. The
// same arguments give the same people, and fewer people are the first of more.
std::vector<PersonOptions> draw_population(uint32_t count, uint64_t seed);

// Who of a street pushes a pram: of women and of men of 22 to 45 years one in k_pushing each, and now and
// then a grandparent of 55 to 70. Three people; `share` is how many they each are of all walkers. They carry
// nothing else, and wear no scarf.
struct Pusher {
    PersonOptions person;
    float share;
};
std::vector<Pusher> draw_pushers(uint64_t seed);
inline constexpr float k_pushing = 0.03f;

// The mean height in metres of girls and boys from five years on, and of adults; after the growth references
// of the World Health Organization (2007), with adults of 1.62 m and 1.755 m.
float mean_height(bool woman, float age);

}  // namespace flaneur
