// What shows of it: heads, hands that go along with words, hands in hands.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/company/kinship.h"
#include "sim/company/talk.h"
#include "sim/deeds/bend.h"
#include "sim/fall/body_pose.h"
#include "sim/fall/limbs.h"
#include "sim/hands/holds.h"
#include "sim/pose/arm.h"

namespace flaneur {

namespace {

// Whether it still is of that group, in full view.
bool is_seen(const Crowd& c, uint32_t group, uint32_t i) {
    return c.fellows[i].group == group && c.at_once[i / k_block] == 1;
}

void let_hands_hang(GaitBlock& g, int lane, uint32_t tick) {
    constexpr int32_t k_pause = 60;  // ticks
    if (g.posture[lane] != 0) {
        g.posture[lane] = static_cast<int32_t>(Posture::hang);
        for (HoldBlock& hold : g.holds) hold.wanted[lane] = static_cast<int32_t>(Hold::none);
    }
    g.next_posture[lane] = std::max(g.next_posture[lane], static_cast<int32_t>(tick) + k_pause);
}

bool holds_a_hand(const Company& company, const Group& g, uint32_t i) {
    if (has_a_hand(company.bearings[i])) return true;
    for (uint32_t k = 0; k < g.count; ++k)
        if (company.bearings[g.members[k].index].holds == i) return true;
    return false;
}

// Hands that go along with what one says.
void move_hands(const Company& company, const Group& group, const Crowd& c, Gait& gait, uint32_t member,
                uint32_t tick, uint64_t seed) {
    const bool greets = group.does == Together::meets && group.stage == Encounter::sees;
    const auto tells_as = static_cast<int32_t>(greets ? Hold::waves : Hold::tells);
    constexpr auto k_none = static_cast<int32_t>(Hold::none);
    auto is_ours = [](int32_t hold) {
        return hold == static_cast<int32_t>(Hold::waves) || hold == static_cast<int32_t>(Hold::tells);
    };
    const uint32_t i = group.members[member].index;
    const int lane = lane_of(i);
    GaitBlock& g = gait.blocks[i / k_block];
    const PersonBlock& p = gait.people[i / k_block];
    if (p.postures[0][lane] == 0) return;
    const bool in_hand = holds_a_hand(company, group, i);
    if (in_hand) let_hands_hang(g, lane, tick);
    const bool may_tell = greets || (group.speech == Speech::speech && group.speaker == member);
    const bool tells_now = is_ours(g.holds[k_left].kind[lane]) || is_ours(g.holds[k_right].kind[lane]) ||
                           is_ours(g.holds[k_left].wanted[lane]) || is_ours(g.holds[k_right].wanted[lane]);
    if (!may_tell && !tells_now) return;
    for (const Side side : {k_left, k_right}) {
        HoldBlock& hold = g.holds[side];
        const bool is_free = (p.free_hands[lane] & 1 << side) != 0 && g.hands[side].reach[lane] == 0;
        const bool tells = is_free && !in_hand && g.running[lane] == 0 && g.jump[lane] == 0 &&
                           c.identity.ahead[i] == 0 && gestures(group, c, member, side, tick, seed);
        if (tells) {
            let_hands_hang(g, lane, tick);
            hold.wanted[lane] = tells_as;
        } else if (is_ours(hold.wanted[lane])) {
            hold.wanted[lane] = k_none;
        }
        if (is_ours(hold.kind[lane]) && hold.share[lane] > 0)
            set_hold(g, p, lane, side, static_cast<Hold>(hold.wanted[lane]), 1, 0,
                     beat_of(group, side, p.height[lane], tick, seed));
    }
}

void bow_head(std::vector<PoseBlock>& poses, uint32_t i, float angle) {
    Posed at{poses[i / k_block], i % k_block};
    at.set(head, at.place_os(head), normalize(at.rotation(head) * rotation_x(angle)));
}

// Radians down to the face of another.
float down_to(const Crowd& c, const Gait& gait, uint32_t i, uint32_t whom) {
    constexpr float k_eyes = 0.93f, k_share = 0.75f, k_up = 0.3f, k_down = 0.45f;
    auto eyes = [&](uint32_t w) {
        return c.motion.position[w].y + k_eyes * gait.people[w / k_block].height[w % k_block];
    };
    const float far = length(on_ground(c.motion.position[whom] - c.motion.position[i]));
    return clamp(k_share * arctan2(eyes(i) - eyes(whom), std::max(far, 0.4f)), -k_up, k_down);
}

// One whose hand is in another's, mostly a child's in that of an adult.
struct Holding {
    const Crowd& c;
    const Gait& gait;
    uint32_t child, adult;
    Someone of(uint32_t i) const { return {gait.people[i / k_block], lane_of(i)}; }
};

// The side on which one has the other.
Side side_of(const Crowd& c, uint32_t i, uint32_t other) {
    const Vec2 ahead = heading_direction(c.motion.heading[i]);
    const Vec2 to = on_ground(c.motion.position[other] - c.motion.position[i]);
    return dot(to, Vec2{ahead.z, -ahead.x}) > 0 ? k_left : k_right;
}

bool has_hand_for(const Gait& gait, uint32_t i, Side side) {
    return (gait.people[i / k_block].free_hands[i % k_block] & 1 << side) != 0 &&
           gait.blocks[i / k_block].hands[side].reach[i % k_block] == 0 &&
           gait.blocks[i / k_block].jump[i % k_block] == 0;
}

// Whether they are so beside each other that hands meet, and go on to.
bool can_hold(const Holding& h, Side child_side, Side adult_side, bool held) {
    const Crowd& c = h.c;
    constexpr float k_nearest = 0.3f, k_farthest = 0.75f, k_still = 0.88f, k_beside = 0.35f, k_abreast = 0.3f,
                    k_level = 0.35f;
    const Vec3 off = c.motion.position[h.adult] - c.motion.position[h.child];
    const float far = length(on_ground(off));
    if (is_down(c, h.child) || is_down(c, h.adult) || passage_of(c, h.child) || passage_of(c, h.adult) ||
        own_of(c.called, h.child) || own_of(c.called, h.adult))
        return false;
    if (!has_hand_for(h.gait, h.child, child_side) || !has_hand_for(h.gait, h.adult, adult_side))
        return false;
    const float turned = std::fabs(wrap_angle(c.motion.heading[h.child] - c.motion.heading[h.adult]));
    const Vec2 ahead = heading_direction(c.motion.heading[h.adult]);
    const float on = std::fabs(dot(on_ground(off), ahead)), aside = std::fabs(cross(on_ground(off), ahead));
    return side_of(c, h.child, h.adult) == child_side && side_of(c, h.adult, h.child) == adult_side &&
           far > k_nearest && far < (held ? k_still : k_farthest) && turned < (held ? 1.3f : 0.8f) &&
           on < (held ? 1.0f : 0.9f) * k_beside && aside > (held ? 0.8f : 1.0f) * k_abreast &&
           std::fabs(off.y) < k_level;
}

// Where both palms meet: below the adult's shoulder, as low as its arm hangs, towards the child, and within
// reach of both.
Vec3 meeting_place(const Holding& h, Vec3 adult_shoulder, Vec3 child_shoulder, Vec3 adult_palm,
                   Vec3 child_palm) {
    constexpr float k_hangs = 0.94f, k_midway = 0.5f, k_near_adult = 0.22f, k_taller = 0.4f;
    constexpr float k_swing = 0.3f, k_ahead = 0.05f, k_above = 0.1f;
    const float adult_reach = reach_of_arm(h.of(h.adult).person, lane_of(h.adult)),
                child_reach = reach_of_arm(h.of(h.child).person, lane_of(h.child));
    const Vec2 ahead = heading_direction(h.c.motion.heading[h.adult]);
    const Vec2 between = on_ground(child_shoulder - adult_shoulder);
    const float swing = 0.5f * (dot(on_ground(adult_palm - adult_shoulder), ahead) +
                                dot(on_ground(child_palm - child_shoulder), ahead));
    // As low as the arm of the taller one hangs, and nearer to that; no higher than the child's shoulder.
    const float taller = clamp((adult_shoulder.y - child_shoulder.y) / k_taller, 0, 1);
    const float lowest =
        std::max(adult_shoulder.y - k_hangs * adult_reach, child_shoulder.y - k_hangs * child_reach);
    const float height = std::min(lowest, child_shoulder.y + k_above * child_reach);
    Vec3 meets = at_height(on_ground(adult_shoulder) + between * lerp(k_midway, k_near_adult, taller) +
                               ahead * (k_ahead + k_swing * swing),
                           height);
    // Close by a shoulder it is before it, or the arm would be folded up; and no arm goes far back.
    auto bring_before = [&](Vec3 shoulder, float heading, float back, float least) {
        const Vec3 way = at_height(heading_direction(heading), 0);
        const Vec3 off = meets - shoulder;
        const float along = dot(off, way), lacks = least * least - length_squared(off);
        const float folded = lacks > 0 ? std::sqrt(along * along + lacks) - along : 0;
        meets += way * std::max(folded, -back - along);
    };
    bring_before(adult_shoulder, h.c.motion.heading[h.adult], 0.5f * adult_reach, 0.8f * adult_reach);
    bring_before(child_shoulder, h.c.motion.heading[h.child], -0.06f * child_reach, 0.72f * child_reach);
    for (int pass = 0; pass < 4; ++pass)
        for (const bool of_adult : {true, false}) {
            const Vec3 from = of_adult ? adult_shoulder : child_shoulder;
            const float most = 0.95f * (of_adult ? adult_reach : child_reach), far = length(meets - from);
            if (far > most) meets = from + (meets - from) * (most / far);
        }
    return meets;
}

// The joints of an arm that has been set anew from its shoulder on.
void write_arm(std::vector<PoseBlock>& poses, Someone who, uint32_t i, Side side, const BodyPose& pose) {
    const int first = side == k_left ? left_upper_arm : right_upper_arm;
    Posed at{poses[i / k_block], i % k_block};
    Vec3 place = at.place_os(first);
    for (int j = first; j < first + 3; ++j) {
        const Quat turn = pose.rotation[static_cast<size_t>(j)];
        at.set(j, place, turn);
        if (j == first + 2) break;
        const auto &from = who.person.joints[j], &to = who.person.joints[j + 1];
        place += rotate(turn, {to[0][who.lane] - from[0][who.lane], to[1][who.lane] - from[1][who.lane],
                               to[2][who.lane] - from[2][who.lane]});
    }
}

// Where the elbow of an arm points that goes from its shoulder that way, as reach_for() has it: as far behind
// and out of it as of an arm that hangs, wherever it goes, so that no way makes it turn over.
Vec3 elbow_of(const BodyPose& pose, Side side, Vec3 way) {
    constexpr Vec3 k_hangs{0, -1, 0}, k_points{0.2f, 0, -1};
    Vec3 to = normalize_or(rotate(conjugate(pose.rotation[upper_chest]), way), k_hangs);
    if (side == k_right) to.x = -to.x;
    // Straight up there is no such way: there as if it were before it.
    constexpr float k_highest = 0.3f;
    if (to.y > k_highest) to = normalize_or({to.x, k_highest, to.z + to.y - k_highest}, {0, 0, 1});
    const Vec3 axis = cross(k_hangs, to);
    const float cosine = dot(k_hangs, to);
    const Vec3 turned = k_points * cosine + cross(axis, k_points) +
                        axis * (dot(axis, k_points) / std::max(1 + cosine, 0.05f));
    return turned + k_hangs * (1.5f * std::max(1 - cosine, 0.0f));
}

// Whether hands can meet, where all of `share` is put on it, and whether arms had the time to.
struct Met {
    bool can = true, yet = true;
};
Met put_hands_together(const Holding& h, Side child_side, Side adult_side, float share,
                       const std::vector<PoseBlock>& previous, std::vector<PoseBlock>& poses) {
    BodyPose adult = body_pose_of(poses, h.adult), child = body_pose_of(poses, h.child);
    const Someone grown = h.of(h.adult), small = h.of(h.child);
    const ArmPlaces of_adult = arm_places(adult, grown.person, grown.lane, adult_side),
                    of_child = arm_places(child, small.person, small.lane, child_side);
    const Vec3 meets = meeting_place(h, of_adult.shoulder, of_child.shoulder, of_adult.palm, of_child.palm);
    const Vec3 to_child =
        at_height(normalize_or(on_ground(of_child.shoulder - of_adult.shoulder), heading_direction(0)), 0);
    const Vec3 ahead = at_height(heading_direction(h.c.motion.heading[h.adult]), 0);
    // The adult's palm faces the child and back, its fingers down; the child's hand lies in it.
    const Vec3 faces = normalize_or(to_child * 0.8f - ahead * 0.6f, to_child);
    const Vec3 down = normalize_or(of_adult.palm - of_adult.shoulder, {0, -1, 0});
    const Vec3 fingers = normalize_or(Vec3{0, -1, 0} + ahead * 0.35f + down * 0.5f, down);
    const Vec3 out = normalize_or(meets - of_child.shoulder, {0, -1, 0});
    const Vec3 childs = normalize_or(out + ahead * 0.3f, out);
    auto square = [](Vec3 v, Vec3 to) { return normalize_or(v - to * dot(v, to), {0, 1, 0}); };
    reach_for(adult, grown, adult_side, {meets, square(faces, fingers), fingers},
              elbow_of(adult, adult_side, meets - of_adult.shoulder), share);
    reach_for(child, small, child_side, {meets, square(-faces, childs), childs},
              elbow_of(child, child_side, meets - of_child.shoulder), share);
    write_arm(poses, grown, h.adult, adult_side, adult);
    write_arm(poses, small, h.child, child_side, child);
    constexpr float k_touch = 0.008f, k_most = 12 * k_tick;  // metres; radians
    const float apart =
        length(palm_of(adult, grown, adult_side).place - palm_of(child, small, child_side).place);
    Met met{share < 1 || apart < k_touch, true};
    auto slow = [&](uint32_t i, Side side) {
        met.yet &=
            !slow_arm({previous[i / k_block], i % k_block}, {poses[i / k_block], i % k_block}, side, k_most);
    };
    slow(h.adult, adult_side);
    slow(h.child, child_side);
    return met;
}

// Arms that let go hang again in their own time. Whether they do.
bool part_hands(const Holding& h, Side child_side, Side adult_side, const std::vector<PoseBlock>& previous,
                std::vector<PoseBlock>& poses) {
    constexpr float k_most = 6 * k_tick;  // radians
    auto is_late = [&](uint32_t i, Side side) {
        return slow_arm({previous[i / k_block], i % k_block}, {poses[i / k_block], i % k_block}, side,
                        k_most);
    };
    const bool childs = is_late(h.child, child_side), adults = is_late(h.adult, adult_side);
    return !childs && !adults;
}

// Whether a hand of one of the group is already in that of somebody other than `by`.
bool is_taken(const Company& company, const Group& g, uint32_t whose, Side side, uint32_t by) {
    for (uint32_t k = 0; k < g.count; ++k) {
        const uint32_t m = g.members[k].index;
        const Bearing& b = company.bearings[m];
        if (m == by || !has_a_hand(b) || b.grip <= 0) continue;
        if (m == whose && own_side(b) == side) return true;
        if (b.holds == whose && others_side(b) == side) return true;
    }
    return false;
}

void hold_hand(Company& company, const Crowd& c, const Gait& gait, uint32_t group, uint32_t i,
               const std::vector<PoseBlock>& previous, std::vector<PoseBlock>& poses) {
    constexpr float k_takes = k_tick / 0.6f, k_parts = k_tick / 0.4f;
    Bearing& b = company.bearings[i];
    const Holding h{c, gait, i, b.holds};
    const bool together = is_seen(c, group, i) && is_seen(c, group, b.holds);
    // Of both, so that neither changes hands while they hold.
    if (b.grip <= 0)
        b.holds_side = static_cast<uint32_t>(side_of(c, i, b.holds)) |
                       static_cast<uint32_t>(side_of(c, b.holds, i)) << 1;
    const Side own = own_side(b), others = others_side(b);
    const Group& g = company.groups[group];
    const bool is_free =
        b.grip > 0 || (!is_taken(company, g, i, own, i) && !is_taken(company, g, b.holds, others, i));
    const bool holds = together && is_free && !lets_go(b) && can_hold(h, own, others, b.grip > 0);
    const float before = b.grip;
    b.grip = clamp(b.grip + (holds ? k_takes : -k_parts), 0, 1);
    if (std::max(before, b.grip) <= 0 || !together || is_down(c, i) || is_down(c, b.holds)) return;
    if (!holds) {
        if (!part_hands(h, own, others, previous, poses)) b.grip = std::max(b.grip, k_parts);
        return;
    }
    const Met met = put_hands_together(h, own, others, smoothstep(0, 1, b.grip), previous, poses);
    if (!met.can) b.holds_side |= k_lets_go;
    if (!met.can || !met.yet) b.grip = std::min(b.grip, 1 - k_takes);
}

// Right hands of two who greet each other, whose arms are bent.
void shake_hands(Company& company, const Group& g, const Crowd& c, const Gait& gait, uint32_t tick,
                 std::vector<PoseBlock>& poses) {
    constexpr float k_reaches = k_tick / 0.5f, k_parts = k_tick / 0.5f, k_nearest = 0.6f, k_farthest = 1.25f;
    constexpr float k_low = 0.62f, k_deep = 0.028f, k_hertz = 2.3f;  // of an arm; metres
    const uint32_t a = g.members[0].index, b = g.members[1].index;
    float& share = company.bearings[a].grip;
    const float far = length(on_ground(c.motion.position[b] - c.motion.position[a]));
    const bool shakes = g.stage == Encounter::greets && g.shakes_hands != 0 && far > k_nearest &&
                        far < k_farthest && has_hand_for(gait, a, k_right) && has_hand_for(gait, b, k_right);
    share = clamp(share + (shakes ? k_reaches : -k_parts), 0, 1);
    if (share <= 0 || is_down(c, a) || is_down(c, b)) return;
    const Holding h{c, gait, a, b};
    BodyPose one = body_pose_of(poses, a), other = body_pose_of(poses, b);
    const Someone who = h.of(a), whom = h.of(b);
    const Vec3 own = arm_places(one, who.person, who.lane, k_right).shoulder,
               others = arm_places(other, whom.person, whom.lane, k_right).shoulder;
    const float reach = std::min(reach_of_arm(who.person, who.lane), reach_of_arm(whom.person, whom.lane));
    const float since = static_cast<float>(tick - g.stage_began) * k_tick;
    Vec3 meets = (own + others) * 0.5f;
    meets.y = std::min(own.y, others.y) - k_low * reach +
              k_deep * sin_cos(2 * k_pi * k_hertz * since).sine * smoothstep(0.6f, 0.9f, since);
    const Vec3 way = normalize_or(Vec3{others.x - own.x, 0, others.z - own.z}, {0, 0, 1});
    const Vec3 faces = cross({0, 1, 0}, way);  // to the left of who holds it out
    const float eased = smoothstep(0, 1, share);
    reach_for(one, who, k_right, {meets, faces, way}, {0.5f, -1, -0.6f}, eased);
    reach_for(other, whom, k_right, {meets, -faces, -way}, {0.5f, -1, -0.6f}, eased);
    set_body_pose(poses, who.person, a, one);
    set_body_pose(poses, whom.person, b, other);
}

}  // namespace

void bear_themselves(const Company& company, const Crowd& c, Gait& gait, Workers& workers, uint32_t tick,
                     uint64_t seed) {
    parallel_for(workers, company.groups.size(), 32, [&](size_t begin, size_t end, int) {
        for (size_t n = begin; n < end; ++n) {
            const Group& g = company.groups[n];
            for (uint32_t k = 0; k < g.count; ++k) {
                const uint32_t i = g.members[k].index;
                if (!is_seen(c, static_cast<uint32_t>(n), i)) continue;
                const Bearing& b = company.bearings[i];
                float& interest = gait.blocks[i / k_block].interest[i % k_block];
                if (b.gazes != 0)
                    interest = b.gaze;
                else if (tick - b.gaze_began < k_decision_ticks)
                    interest = 0;
                move_hands(company, g, c, gait, k, tick, seed);
            }
        }
    });
}

void pose_company(Company& company, const Crowd& c, const Gait& gait, Workers& workers, uint32_t tick,
                  uint64_t seed, const std::vector<PoseBlock>& previous, std::vector<PoseBlock>& poses) {
    constexpr float k_bows = 1.6f * k_tick;  // radians
    parallel_for(workers, company.groups.size(), 16, [&](size_t begin, size_t end, int) {
        for (size_t n = begin; n < end; ++n) {
            const Group& g = company.groups[n];
            for (uint32_t k = 0; k < g.count; ++k) {
                const uint32_t i = g.members[k].index, number = static_cast<uint32_t>(n);
                if (c.fellows[i].group != number) continue;  // is gone, and somebody else may be there
                Bearing& b = company.bearings[i];
                if (!is_seen(c, number, i) || is_down(c, i)) {
                    b.bows = b.grip = 0;
                    continue;
                }
                // Heads of those who sit are turned to others as their bodies are (sim/pastimes).
                const bool looks =
                    b.gazes != 0 && c.fellows[b.whom].group == number && g.does != Together::sits;
                b.bows += clamp((looks ? down_to(c, gait, i, b.whom) : 0) - b.bows, -k_bows, k_bows);
                const float pitch = b.bows + nod_of(g, k, tick, seed);
                if (pitch != 0) bow_head(poses, i, pitch);
                if (has_a_hand(b)) hold_hand(company, c, gait, number, i, previous, poses);
            }
            const bool two = g.does == Together::meets && g.count > 1;
            if (two && is_seen(c, static_cast<uint32_t>(n), g.members[0].index) &&
                is_seen(c, static_cast<uint32_t>(n), g.members[1].index))
                shake_hands(company, g, c, gait, tick, poses);
        }
    });
}

}  // namespace flaneur
