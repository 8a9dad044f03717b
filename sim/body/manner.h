// How one person's walk differs from another's of the same body.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

// What the hands of one who stands do.
enum class Posture : int32_t {
    hang,
    pocket,   // one in it
    pockets,  // both
    hip,      // one on it
    hips,     // both
    clasp,    // one in the other, before the body
    behind,   // the same behind it
    fold,     // arms folded
    across,   // one holds the other arm, which hangs
    strap,    // of a bag
};
inline constexpr int k_posture_count = 10;
inline constexpr std::string_view k_posture_names[k_posture_count] = {
    "hang", "pocket", "pockets", "hip", "hips", "clasp", "behind", "fold", "across", "strap"};

// As it is, the neutral manner of a grown person.
struct Manner {
    float stride = 1;             // factors on the length of steps,
    float lead = 1;               // on how far ahead of the body a foot lands,
    float arm_swing[2] = {1, 1};  // on how far arms swing, left and right,
    float sway = 1;               // on what the pelvis does,
    float strike = 1;             // and on how far toes point up as a heel comes down,
    float clearance = 0;          // legs by which feet swing higher over the ground
    float linger = 0;             // share of the cycle that feet stand longer
    float toe_out = 6 * k_radians;
    float step_width = 0.055f;  // between the lines of both feet, of the person's height
    // Of one who stands: between the ankles and from one foot ahead to the other, of the person's height; and
    // radians that the foot of the relaxed leg points farther out.
    float stance_width = 0.105f;
    float stance_ahead = 0.03f;
    float stance_turn = 8 * k_radians;
    float lean = 6 * k_radians;         // of the trunk, forward +
    float stoop = 0;                    // of the chest over the pelvis, forward +
    float carriage = 8.5f * k_radians;  // of the arms, away from the body
    float elbow = 0;                    // radians that elbows are bent beyond the middle
    float crouch = 0;  // by which the pelvis is lower, and knees more bent, of the leg's length
    // How much one step differs from the next: standard deviation of its time, as a share, and of the way
    // that a foot lands beside its line, in the person's height.
    float unevenness = 0;
    float curiosity = 0.3f;  // of every two seconds, in how many the head turns to something aside
    float touches = 0.5f;    // how likely it is one of those who trail a hand along walls
    float reel = 0;          // radians of sway to each side and ahead, walking too; 0: none
    float limp = 0;  // share by which a step of the left foot is quicker, one of the right foot slower
    // How often each posture is taken, against the others. All 0: hands hang.
    std::array<float, k_posture_count> postures{};
};

// The middle manner at an age in years. What follows from size and speed alone is not in it.
//
// Children take longer steps for their legs, farther apart for their height, than grown people (Lythgo et
// al., Gait & Posture 33, 2011), those beyond eighty shorter and wider ones than at seventy (Hollman et al.,
// Gait & Posture 34, 2011; statures of 1.72 and 1.58 m), and their arms swing less (Mirelman et al., PLoS ONE
// 10, 2015, which says that, not how much: a fifth less here); the old stoop. Feet of children stand for less
// of the cycle, those of the old for more (Lythgo, Hollman). No two steps are alike: grown
// people's times differ by a hundredth, widths by 20 mm (CMU motion capture), children's and the old's by
// more.
Manner manner_at_age(float years);

// Manner::postures of the middle one of that age: half the time and more hands hang, least of those who stand
// with folded arms are children, and the old have theirs behind the back. Chosen, not measured.
std::array<float, k_posture_count> postures_at_age(float years, bool woman);

// One person's, as people spread around a middle manner. One arm swings farther than the other, by a third
// most often (CMU motion capture); feet come down with toes up by 4 degrees more or less (Fukuchi 2018), and
// swing some 4 mm higher or lower (Winter 1991). How they stand is chosen, not measured: ankles 0.08 to 0.16
// of the height apart, one up to 0.06 of it ahead.
Manner draw_manner(const Manner& middle, RandomKey key);
// Of one who has had so much to drink, 0..1. Who is drunk walks with shorter steps (Demura and Uchiyama,
// Sport Sciences for Health 4, 2008), with wider ones and feet turned out (Gimunova et al., Scientific
// Reports 12, 2022), sways, takes no step like the one before, holds the arms off and stands broadly; how
// much of each is chosen.
void add_drink(Manner& manner, float drunk);
// Only of Manner::postures: everybody has favourites.
void vary_postures(Manner& manner, RandomKey key);

}  // namespace flaneur
