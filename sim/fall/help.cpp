#include "sim/fall/help.h"

#include <algorithm>

#include "sim/base/math.h"
#include "sim/fall/limbs.h"

namespace flaneur {

namespace {

Vec3 joint_of(const PersonBlock& person, int lane, Joint j) {
    return {person.joints[j][0][lane], person.joints[j][1][lane], person.joints[j][2][lane]};
}
int shoulder_of(Side side) { return side == k_left ? left_upper_arm : right_upper_arm; }

}  // namespace

Stoop stoop_for(const PersonBlock& person, int lane, const PersonBlock& other, int other_lane, float low) {
    constexpr float k_kneeling = 0.62f, k_above = 0.3f;  // of the height; metres over the other's shoulder
    constexpr float k_least_lean = 0.3f, k_most_lean = 0.9f;  // radians
    const float leg = joint_of(person, lane, left_upper_leg).y,
                own = joint_of(person, lane, left_upper_arm).y;
    const float down = own - (low + k_kneeling * joint_of(other, other_lane, left_upper_arm).y + k_above);
    // First knees, as far as one does without squatting, then the trunk.
    const float crouch = clamp(0.4f * down, 0.03f * leg, 0.17f * leg);
    return {crouch, clamp(k_least_lean + 1.2f * (down - crouch), k_least_lean, k_most_lean)};
}

bool take_hand(BodyPose& pose, const PersonBlock& person, int lane, BodyPose& other,
               const PersonBlock& other_person, int other_lane, const Hands& hands) {
    constexpr float k_below = 0.16f, k_apart = 0.01f;  // metres
    const Vec3 own = places_of(pose, person, lane)[static_cast<size_t>(shoulder_of(hands.own))];
    const Vec3 others =
        places_of(other, other_person, other_lane)[static_cast<size_t>(shoulder_of(hands.other))];
    const float own_reach = reach_of_arm(person, lane), others_reach = reach_of_arm(other_person, other_lane);
    const Vec3 way = others - own;
    const float far = length(way);
    const Vec3 along = normalize_or(way, {0, -1, 0});
    // Arms sag a little between two who are near.
    const float sag = k_below * (1 - smoothstep(0.6f, 0.95f, far / (own_reach + others_reach)));
    // Where arms of their lengths meet; a hand that is only offered is held out farther.
    constexpr float k_offered = 0.85f;  // of the arm
    const float share = std::min(far * own_reach / (own_reach + others_reach), own_reach);
    const float offered = std::min(k_offered * own_reach, std::max(far - 0.15f, share));
    const Vec3 meets = own + along * lerp(offered, share, hands.holds) - Vec3{0, sag, 0};
    const Vec3 palm = palm_of(pose, person, lane, hands.own);
    const bool reaches =
        reach_with_arm(pose, person, lane, hands.own, lerp(palm, meets - along * k_apart, hands.reach));
    if (hands.holds <= 0) return false;
    const Vec3 others_palm = palm_of(other, other_person, other_lane, hands.other);
    const bool comes = reach_with_arm(other, other_person, other_lane, hands.other,
                                      lerp(others_palm, meets + along * k_apart, hands.holds));
    return reaches && comes;
}

}  // namespace flaneur
