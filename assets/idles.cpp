#include "assets/idles.h"

#include <algorithm>
#include <span>
#include <vector>

#include "sim/animation/skeleton.h"
#include "sim/base/math.h"
#include "sim/body/body.h"

namespace flaneur {

namespace {

// Degrees, against how one stands. Of the trunk, over its three joints, and of the head: ahead, to the left
// side, turned to the left. Of arms, left and right: raised ahead, out, turned in, and the elbow's bend.
struct Attitude {
    float seconds;
    float trunk[3], head[3];
    float raise[2], out[2], in[2], elbow[2];
};

constexpr Attitude k_stretch[] = {
    {0, {}, {}, {}, {}, {}, {}},
    {0.7f, {3, 0, 0}, {6, 0, 0}, {38, 34}, {6, 6}, {0, 0}, {30, 34}},
    {1.5f, {-5, 0, 0}, {-10, 0, 0}, {128, 122}, {16, 16}, {0, 0}, {42, 46}},
    {2.3f, {-10, 3, 2}, {-20, 2, 0}, {164, 158}, {20, 18}, {0, 0}, {22, 26}},
    {3.0f, {-11, -6, -3}, {-22, -5, 0}, {166, 162}, {18, 22}, {0, 0}, {16, 18}},
    {3.7f, {-4, 0, 0}, {-8, 0, 0}, {112, 106}, {44, 42}, {0, 0}, {26, 30}},
    {4.6f, {3, 0, 0}, {6, 0, 0}, {22, 18}, {16, 14}, {0, 0}, {12, 14}},
    {5.4f, {}, {}, {}, {}, {}, {}},
    {12, {}, {}, {}, {}, {}, {}},
};
constexpr Attitude k_look_out[] = {
    {0, {}, {}, {}, {}, {}, {}},
    {0.6f, {0, 0, 4}, {-3, 0, 14}, {0, 66}, {0, 12}, {0, 14}, {0, 72}},
    {1.1f, {-2, 0, 9}, {-5, 0, 22}, {0, 116}, {2, 16}, {0, 26}, {4, 106}},
    {2.2f, {-2, 0, 3}, {-6, 0, 6}, {0, 118}, {2, 16}, {0, 26}, {4, 106}},
    {3.2f, {-2, 0, -8}, {-5, 0, -22}, {0, 117}, {2, 16}, {0, 25}, {4, 105}},
    {4.0f, {0, 0, -6}, {-2, 0, -14}, {0, 60}, {0, 12}, {0, 12}, {0, 66}},
    {4.9f, {}, {}, {}, {}, {}, {}},
    {10.5f, {}, {}, {}, {}, {}, {}},
};
constexpr Attitude k_neck[] = {
    {0, {}, {}, {}, {}, {}, {}},
    {0.8f, {2, 0, 0}, {12, 8, 0}, {60, 0}, {24, 0}, {10, 0}, {96, 0}},
    {1.5f, {3, -3, 0}, {20, 14, -6}, {104, 0}, {42, 0}, {30, 0}, {132, 0}},
    {2.4f, {2, -4, 0}, {8, -18, 8}, {106, 0}, {44, 0}, {32, 0}, {134, 0}},
    {3.3f, {1, -2, 0}, {-8, -6, 14}, {100, 0}, {42, 0}, {30, 0}, {130, 0}},
    {4.1f, {0, 0, 0}, {0, 6, 6}, {44, 0}, {18, 0}, {8, 0}, {70, 0}},
    {5.0f, {}, {}, {}, {}, {}, {}},
    {13, {}, {}, {}, {}, {}, {}},
};
constexpr std::span<const Attitude> k_attitudes[] = {k_stretch, k_look_out, k_neck};
static_assert(std::size(k_attitudes) == std::size(k_idle_names));

Quat turned(const float (&ahead_side_left)[3], float share) {
    return normalize(rotation_y(ahead_side_left[2] * share * k_radians) *
                     rotation_z(-ahead_side_left[1] * share * k_radians) *
                     rotation_x(ahead_side_left[0] * share * k_radians));
}

LocalPose pose_of(const Attitude& a) {
    LocalPose pose;
    pose.rotations.assign(k_joint_count, Quat{});
    for (const Joint joint : {spine, chest, upper_chest}) pose.rotations[joint] = turned(a.trunk, 1 / 3.0f);
    for (const Joint joint : {neck, head}) pose.rotations[joint] = turned(a.head, 0.5f);
    constexpr Joint k_arms[] = {left_upper_arm, right_upper_arm};
    for (int side = 0; side < 2; ++side) {
        const float outward = side == 0 ? 1.0f : -1.0f;
        const size_t arm = k_arms[side];
        pose.rotations[arm] =
            normalize(rotation_z(outward * a.out[side] * k_radians) * rotation_x(-a.raise[side] * k_radians) *
                      rotation_y(-outward * a.in[side] * k_radians));
        pose.rotations[arm + 1] = rotation_x(-a.elbow[side] * k_radians);
    }
    return pose;
}

// Between two of them, eased, so that what is held for a moment is at rest there.
LocalPose pose_at(std::span<const Attitude> all, float seconds) {
    size_t next = 1;
    while (next + 1 < all.size() && all[next].seconds <= seconds) ++next;
    const Attitude &from = all[next - 1], &to = all[next];
    const float share = smoothstep(from.seconds, to.seconds, seconds);
    LocalPose pose = pose_of(from);
    const LocalPose then = pose_of(to);
    for (size_t j = 0; j < pose.rotations.size(); ++j)
        pose.rotations[j] = nlerp(pose.rotations[j], then.rotations[j], share);
    return pose;
}

}  // namespace

bool is_built_in_idle(std::string_view name) {
    return std::ranges::find(k_idle_names, name) != std::end(k_idle_names);
}

std::optional<Clip> built_in_idle(std::string_view name) {
    constexpr float k_rate = 15;
    const auto found = std::ranges::find(k_idle_names, name);
    if (found == std::end(k_idle_names)) return std::nullopt;
    const std::span<const Attitude> all = k_attitudes[found - std::begin(k_idle_names)];
    std::vector<LocalPose> keys;
    const int count = static_cast<int>(all.back().seconds * k_rate);
    keys.reserve(static_cast<size_t>(count));
    for (int k = 0; k < count; ++k) keys.push_back(pose_at(all, static_cast<float>(k) / k_rate));
    const LocalPose still = keys[0];
    return *make_additive_clip(humanoid(standard_body(1.7f)), std::move(keys), still, k_rate, true,
                               Curve::linear);
}

}  // namespace flaneur
