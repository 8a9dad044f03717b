#include "sim/company/shape.h"

#include <algorithm>

#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_abreast = 0.75f, k_hand_in_hand = 0.58f, k_in_file = 0.95f;  // metres
constexpr float k_behind_of_three = 0.3f, k_behind_of_four = 0.35f;

bool hold_hands(const Group& group, std::span<const Bearing> bearings, uint32_t a, uint32_t b) {
    const uint32_t i = group.members[a].index, k = group.members[b].index;
    return bearings[i].holds == k || bearings[k].holds == i;
}

}  // namespace

Shape walking_shape(const Group& group, std::span<const Bearing> bearings, float narrow, bool mirrored) {
    Shape shape;
    float left = 0;
    for (uint32_t k = 0; k < group.count; ++k) {
        if (k > 0) left -= hold_hands(group, bearings, k - 1, k) ? k_hand_in_hand : k_abreast;
        const bool is_inner = k > 0 && k + 1 < group.count;
        const float behind = !is_inner ? 0 : group.count == 3 ? k_behind_of_three : k_behind_of_four;
        shape.at[k] = {mirrored ? -left : left, -behind};
    }
    const Vec2 own = shape.at[group.leader];
    // One behind the other: who leads goes first, and then those who are nearer to it.
    uint32_t before = 0;
    for (uint32_t far = 0; far < group.count; ++far)
        for (const bool is_after : {false, true}) {
            const uint32_t k = is_after ? group.leader + far : group.leader - far;
            if (k >= group.count || (far == 0 && is_after)) continue;
            const Vec2 abreast = shape.at[k] - own;
            shape.at[k] = lerp(abreast, Vec2{0, -k_in_file * static_cast<float>(before)}, narrow);
            ++before;
            shape.left = std::max(shape.left, shape.at[k].x);
            shape.right = std::max(shape.right, -shape.at[k].x);
        }
    return shape;
}

Circle ring_of(const Group& group, const Crowd& crowd, Vec2 way, bool at_right_angle) {
    constexpr float k_radius_of_two = 0.44f, k_radius_at_angle = 0.62f, k_radius_of_three = 0.52f,
                    k_radius_of_four = 0.62f;
    const bool is_pair = group.count == 2;
    const float radius = group.count == 3  ? k_radius_of_three
                         : group.count > 3 ? k_radius_of_four
                         : at_right_angle  ? k_radius_at_angle
                                           : k_radius_of_two;
    Circle ring;
    const Vec2 own = on_ground(crowd.motion.position[group.members[group.leader].index]);
    ring.middle = own + way * radius;
    // The others' places, each to who is nearest to it by the least sum of squares.
    std::array<Vec2, k_most_company> free{};
    const float turn = is_pair && at_right_angle ? 0.5f * k_pi : 2 * k_pi / static_cast<float>(group.count);
    uint32_t others[k_most_company] = {}, n = 0;
    for (uint32_t k = 0; k < group.count; ++k)
        if (k != group.leader) others[n++] = k;
    const float from = heading_of(-way);
    for (uint32_t k = 0; k < n; ++k)
        free[k] = ring.middle + heading_direction(from + turn * static_cast<float>(k + 1)) * radius;
    std::array<uint32_t, k_most_company> order{0, 1, 2, 3}, best = order;
    float least = 1e9f;
    do {
        float sum = 0;
        for (uint32_t k = 0; k < n; ++k)
            sum += length_squared(free[order[k]] -
                                  on_ground(crowd.motion.position[group.members[others[k]].index]));
        if (sum < least) least = sum, best = order;
    } while (std::next_permutation(order.begin(), order.begin() + n));
    ring.at[group.leader] = own;
    for (uint32_t k = 0; k < n; ++k) ring.at[others[k]] = free[best[k]];
    return ring;
}

}  // namespace flaneur
