#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "sim/gait/footing.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/lettering.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

namespace {

constexpr float k_bones_reach = 100, k_marks_reach = 30, k_gizmos_reach = 15;  // metres from the eye
constexpr size_t k_most_with_gizmos = 8;

bool is_before(const Camera& camera, glm::vec3 place, float reach) {
    const glm::vec3 away = place - camera.eye;
    return glm::dot(away, camera.target - camera.eye) > -2 * glm::length(camera.target - camera.eye) &&
           glm::length(away) < reach;
}

uint32_t colour_of(Joint joint) {
    if (joint < left_shoulder) return k_trunk_colour;
    const bool is_left = joint <= left_hand || (joint >= left_upper_leg && joint <= left_toes);
    return is_left ? k_left_colour : k_right_colour;
}

// Metres, of a grown body, at the end near the trunk.
float girth_of(Joint joint) {
    switch (joint) {
        case spine:
        case chest:
        case upper_chest:
            return 0.026f;
        case left_lower_leg:
        case right_lower_leg:
            return 0.027f;
        case left_foot:
        case right_foot:
            return 0.021f;
        case left_lower_arm:
        case right_lower_arm:
            return 0.019f;
        default:
            return 0.016f;
    }
}

void add_bone(Overlay& overlay, uint32_t colour, glm::vec3 a, glm::vec3 b, float girth) {
    Pen pen{
        .radius_a = girth, .radius_b = 0.5f * girth, .pixels = 0.9f, .place = GizmoPlace::in_world_hidden};
    pen.colour = colour;
    add_line(overlay.lines, pen, a, b);
}

void add_skeleton(const OverlayInput& input, const PeopleFrame& people, uint32_t i, Overlay& overlay) {
    const WalkerDraw& draw = people.walkers[i];
    const Character& character = input.characters[draw.mesh];
    const float scale = draw.instance.scale, size = character.body.height * scale / 1.7f;
    std::array<glm::vec3, k_joint_count> joints;
    for (int j = 0; j < k_joint_count; ++j) joints[j] = joint_place(input, people, i, static_cast<Joint>(j));
    auto turned = [&](Joint joint, glm::vec3 v) {
        return joint_turned(people, i, character, joint, v * scale);
    };
    for (int j = 1; j < k_joint_count; ++j) {
        const Joint joint = static_cast<Joint>(j);
        add_bone(overlay, colour_of(joint), joints[k_joint_parents[j]], joints[j], girth_of(joint) * size);
    }
    const Body& body = character.body;
    for (Joint hand : {left_hand, right_hand})
        add_bone(overlay, colour_of(hand), joints[hand],
                 joints[hand] + turned(hand, {0, -0.1f * body.height / 1.7f, 0}), 0.013f * size);
    for (Joint toes : {left_toes, right_toes}) {
        const Joint foot = static_cast<Joint>(toes - 1);
        add_bone(overlay, colour_of(toes), joints[toes], joints[toes] + turned(toes, {0, 0, body.toe}),
                 0.012f * size);
        add_bone(overlay, colour_of(toes), joints[foot],
                 joints[foot] + turned(foot, {0, -0.8f * body.joints[foot].y, -0.8f * body.heel}),
                 0.016f * size);
    }
    // The skull, from the joint to the crown.
    const float crown = body.height - body.joints[head].y;
    Pen skull{.radius_a = 0.3f * crown * scale, .radius_b = 0.4f * crown * scale, .pixels = 2};
    skull.place = GizmoPlace::in_world_hidden;
    skull.colour = k_trunk_colour;
    add_line(overlay.lines, skull, joints[head] + turned(head, {0, 0.3f * crown, 0.08f * crown}),
             joints[head] + turned(head, {0, 0.6f * crown, 0}));
    for (int j = 0; j < k_joint_count; ++j) {
        Pen joint{.pixels = 1, .colour = k_joint_colour, .place = GizmoPlace::in_world_hidden};
        joint.radius_a = joint.radius_b = 1.25f * girth_of(static_cast<Joint>(j)) * size;
        add_point(overlay.lines, joint, joints[j]);
    }
}

void add_foot_gizmos(const World& world, uint32_t i, Side side, Overlay& overlay) {
    const int lane = static_cast<int>(i % k_block);
    const GaitBlock& gait = world.gait.blocks[i / k_block];
    const FootBlock& foot = gait.feet[side];
    const FootSize size = foot_size(world.gait.people[i / k_block], lane);
    const uint32_t colour = side == k_left ? k_left_colour : k_right_colour;
    auto print = [&](const FootPlace& place, float opacity) {
        const Vec2 ahead = heading_direction(place.yaw);
        const Vec3 way{ahead.x, -(place.normal.x * ahead.x + place.normal.z * ahead.z) / place.normal.y,
                       ahead.z};
        add_footprint(
            overlay.lines,
            {.pixels = 1.8f, .colour = (colour & 0xffffffu) | static_cast<uint32_t>(opacity * 255) << 24},
            to_glm(place.position + way * size.heel), to_glm(place.position + way * size.tip),
            to_glm(place.normal));
    };
    const FootPlace from = get_place(foot.from, lane), to = get_place(foot.to, lane);
    print(to, 1);
    if (!foot.swinging[lane]) return;
    print(from, 0.4f);
    add_arc(overlay.lines, {.pixels = 1.5f, .colour = (colour & 0xffffffu) | 0xc0000000u},
            to_glm(from.position), to_glm(to.position), 0.1f + foot.obstacle[lane]);
    add_cross(overlay.lines, {.pixels = 2, .colour = ink(0xf2c14e)}, to_glm(to.position), 0.05f);
}

void add_hand_gizmos(const World& world, const OverlayInput& input, const PeopleFrame& people, uint32_t i,
                     Side side, Overlay& overlay) {
    const size_t lane = i % k_block;
    const HandBlock& hand = world.gait.blocks[i / k_block].hands[side];
    if (!(hand.reach[lane] > 0.05f)) return;
    const glm::vec3 target(hand.x[lane], hand.y[lane], hand.z[lane]);
    const glm::vec3 normal(hand.normal_x[lane], 0, hand.normal_z[lane]);
    const uint32_t colour = ink(0xf2c14e, hand.reach[lane]);
    add_cross(overlay.lines, {.pixels = 2, .colour = colour}, target, 0.05f);
    add_circle(overlay.lines, {.pixels = 1.5f, .colour = colour}, target, normal, 0.07f);
    add_line(overlay.lines, {.pixels = 1.2f, .colour = colour}, target,
             joint_place(input, people, i, side == k_left ? left_upper_arm : right_upper_arm));
}

// Whether limbs go by curves.
bool are_led(const OverlayInput& input) {
    return input.without && !input.without->on.gait && !input.without->clocks.empty();
}

// The targets, as balls, and from where limbs go to them.
void add_curve_gizmos(const OverlayInput& input, const PeopleFrame& people, uint32_t i, Overlay& overlay) {
    const World& world = input.world;
    const Without& w = *input.without;
    const PlacedTargets targets =
        targets_of(world.gait, i, world.crowd.march.how, w.clocks, world.around, w.poses);
    auto add = [&](Vec3 target, Joint root, uint32_t colour) {
        Pen ball{.radius_a = 0.05f, .radius_b = 0.05f, .pixels = 1, .place = GizmoPlace::in_world_hidden};
        ball.colour = colour;
        add_point(overlay.lines, ball, to_glm(target));
        add_line(overlay.lines, {.pixels = 1.2f, .colour = colour}, to_glm(target),
                 joint_place(input, people, i, root));
    };
    for (Side side : {k_left, k_right}) {
        const uint32_t colour = side == k_left ? k_left_colour : k_right_colour;
        add(targets.feet[side], side == k_left ? left_upper_leg : right_upper_leg, colour);
        add(targets.hands[side], side == k_left ? left_upper_arm : right_upper_arm, colour);
    }
}

}  // namespace

void add_contact_marks(const OverlayInput& input, uint32_t i, Overlay& overlay) {
    const World& world = input.world;
    if (are_led(input)) return;
    for (Side side : {k_left, k_right}) {
        const FootBlock& foot = world.gait.blocks[i / k_block].feet[side];
        if (foot.swinging[i % k_block]) continue;
        const FootPlace place = get_place(foot.to, static_cast<int>(i % k_block));
        const Sole s = sole(world.poses, world.gait, i, side);
        const uint32_t colour = side == k_left ? k_left_colour : k_right_colour;
        for (const auto& [point, radius] : {std::pair{s.heel, 0.035f}, std::pair{s.ball, 0.05f}}) {
            const float above = dot(point - place.position, place.normal);
            if (above > 0.02f) continue;
            const glm::vec3 at = to_glm(point - place.normal * above);
            add_disc(overlay.fills, at, to_glm(place.normal), radius, (colour & 0xffffffu) | 0xb0000000u);
            add_circle(overlay.lines,
                       {.pixels = 1.3f, .colour = colour, .place = GizmoPlace::in_world_hidden}, at,
                       to_glm(place.normal), 1.6f * radius);
        }
    }
}

void add_gizmos_of(const OverlayInput& input, const PeopleFrame& people, uint32_t i, Overlay& overlay) {
    const World& world = input.world;
    const Crowd& crowd = world.crowd;
    const glm::vec3 up(0, 1, 0), lift(0, 0.02f, 0), at = to_glm(crowd.motion.position[i]) + lift;
    auto on_ground = [](Vec2 v) { return glm::vec3(v.x, 0, v.z); };
    add_circle(overlay.lines, {.pixels = 1.3f, .colour = ink(0xf6f3ec, 0.8f)}, at, up,
               crowd.identity.radius[i]);
    add_arrow(overlay.lines, {.pixels = 2.5f, .colour = ink(0x8fc15a)}, at,
              at + on_ground(crowd.motion.velocity[i]), up);
    add_arrow(overlay.lines, {.pixels = 1.3f, .colour = ink(0x8fc15a, 0.6f)}, at,
              at + on_ground(crowd.decision.wanted[i]), up);
    if (are_led(input)) add_curve_gizmos(input, people, i, overlay);
    for (Side side : {k_left, k_right}) {
        if (are_led(input)) break;
        add_foot_gizmos(world, i, side, overlay);
        add_hand_gizmos(world, input, people, i, side, overlay);
    }
    const Character& character = input.characters[crowd.identity.body[i]];
    const glm::vec3 eyes =
        joint_place(input, people, i, head) + joint_turned(people, i, character, head, {0, 0.09f, 0.1f});
    add_arrow(overlay.lines, {.pixels = 1.5f, .colour = ink(0x7cc6d6)}, eyes,
              eyes + joint_turned(people, i, character, head, {0, 0, 1}), up);
    glm::vec3 before = at;
    for (uint8_t c = crowd.journeys[i].corner;
         c < crowd.journeys[i].corner_count && c < crowd.journeys[i].corner + 3; ++c) {
        const glm::vec3 corner = to_glm(crowd.corners[size_t{i} * k_corners + c]) + lift;
        add_line(overlay.lines, {.pixels = 1.2f, .colour = ink(0xf6f3ec, 0.5f)}, before, corner);
        before = corner;
    }
    char words[64];
    std::snprintf(words, sizeof words, "%u  %.2f m/s", i,
                  static_cast<double>(length(crowd.motion.velocity[i])));
    const float height = character.body.height * crowd.identity.scale[i];
    add_text(overlay.lines, {at + glm::vec3(0, height + 0.12f, 0), {-0.5f * text_width(words, 9), 0}}, words,
             ink(0xf6f3ec), 9);
}

void add_creature_bones(const OverlayInput& input, Overlay& overlay) {
    const Linkages& all = input.world.linkages;
    for (size_t n = 0; n < creatures_of(input.world).size(); ++n) {
        const Linkage& f = all.all[n];
        const size_t first = all.ranges[n].joints;
        auto at = [&](size_t j) {
            return to_glm(lerp(all.previous_places[first + j], all.places[first + j], input.between));
        };
        for (size_t j = 1; j < f.rest.size(); ++j) {
            // Trunk, left and right legs, in the order of creature_linkage().
            const size_t legs = f.rest.size() - 4 * size_t{k_creature_legs};
            const uint32_t colour = j < legs                                 ? k_trunk_colour
                                    : j - legs < size_t{2 * k_creature_legs} ? k_left_colour
                                                                             : k_right_colour;
            add_bone(overlay, colour, at(static_cast<size_t>(f.shape.parents[j])), at(j), 0.4f * f.girth[j]);
        }
    }
}

// Bones know no depth among themselves: those behind are drawn first, joints after the bones that meet there.
void add_skeletons(const OverlayInput& input, const PeopleFrame& people, Overlay& overlay) {
    const glm::vec3 eye = input.camera.eye;
    std::vector<std::pair<float, uint32_t>> order;
    auto take = [&](uint32_t i) {
        const glm::vec3 centre = people.walkers[i].centre;
        if (is_before(input.camera, centre, k_bones_reach)) order.emplace_back(glm::length(centre - eye), i);
    };
    for (uint32_t i : people.posed) take(i);
    // People who are not of the crowd.
    const uint32_t crowd = input.world.crowd.count;
    for (uint32_t i = crowd; i < people.walkers.size(); ++i)
        if (people.walkers[i].mesh < input.characters.size()) take(i);
    add_creature_bones(input, overlay);
    std::sort(order.rbegin(), order.rend());
    auto depth_of = [&](const GizmoLine& line) {
        return glm::length(0.5f * (line.a + line.b) - eye) - (line.a == line.b ? 0.25f : 0.0f);
    };
    for (const auto& [distance, i] : order) {
        if (!input.world.roam && i < crowd && distance < k_marks_reach) add_contact_marks(input, i, overlay);
        const auto first = static_cast<std::ptrdiff_t>(overlay.lines.size());
        add_skeleton(input, people, i, overlay);
        std::stable_sort(overlay.lines.begin() + first, overlay.lines.end(),
                         [&](const GizmoLine& a, const GizmoLine& b) { return depth_of(a) > depth_of(b); });
    }
}

void add_gait_gizmos(const OverlayInput& input, const PeopleFrame& people, Overlay& overlay) {
    if (input.world.roam) return;
    std::vector<std::pair<float, uint32_t>> nearest;
    for (uint32_t i : people.posed) {
        const glm::vec3 centre = people.walkers[i].centre;
        if (is_before(input.camera, centre, k_gizmos_reach))
            nearest.emplace_back(glm::length(centre - input.camera.eye), i);
    }
    std::sort(nearest.begin(), nearest.end());
    if (nearest.size() > k_most_with_gizmos) nearest.resize(k_most_with_gizmos);
    for (const auto& [distance, i] : nearest) add_gizmos_of(input, people, i, overlay);
}

}  // namespace flaneur
