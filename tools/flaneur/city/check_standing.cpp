#include "tools/flaneur/city/check_standing.h"

#include <algorithm>
#include <cmath>

#include "sim/alongside/alongside.h"
#include "sim/base/math.h"
#include "sim/base/spans.h"
#include "sim/pastimes/pastimes.h"

namespace flaneur {

namespace {

constexpr float k_stands_within = 0.35f;  // metres
constexpr uint32_t k_stand_ticks = 600;   // that are looked at together
constexpr uint32_t k_frozen_ticks = 300;
constexpr float k_same = 0.004f;                 // metres
constexpr float k_turns = 0.3f, k_goes = 0.12f;  // rad/s, m/s, from which on it counts
// Of one who marches: feet lifted more often, and yet it is within so many metres and radians of where it
// was.
constexpr uint32_t k_most_lifts = 8, k_most_changes = 6;
constexpr float k_got_nowhere = 0.2f, k_faces_the_same = 0.8f;

bool has_feet(const World& w, uint32_t i) {
    if (!is_there(w.crowd, i) || is_creature(w.herd, i) || is_down(w.crowd, i)) return false;
    if (w.alongside && !told_along(w, i).empty()) return false;  // goes in a wheelchair, plays
    const Pastime* p = own_of(w.pastimes->all, i);
    return !p || p->what != Staying::sits || p->phase == StayPhase::comes;
}

Vec3 joint_of(const World& w, uint32_t i, int joint) {
    return joint_between(w, i, static_cast<Joint>(joint), 1).position;
}

void note_joints(const World& w, uint32_t i, Stand& s) {
    for (int j = 0; j < k_joint_count; ++j) s.joints[static_cast<size_t>(j)] = joint_of(w, i, j);
}

void begin(const World& w, uint32_t i, uint32_t generation, Stand& s) {
    s = {.is = true, .generation = generation, .from = w.crowd.motion.position[i]};
    s.heading = w.crowd.motion.heading[i];
    note_joints(w, i, s);
    for (const int side : {0, 1}) s.swings_foot[static_cast<size_t>(side)] = true;
}

void look_at_feet(const World& w, uint32_t i, Stand& s) {
    const GaitBlock& gait = w.gait.blocks[i / k_block];
    const bool stands = length(w.crowd.motion.velocity[i]) < k_goes;
    for (const size_t side : {size_t{0}, size_t{1}}) {
        const bool swings = gait.feet[side].swinging[lane_of(i)] != 0;
        const Vec3 ankle = joint_of(w, i, side ? right_foot : left_foot),
                   toes = joint_of(w, i, side ? right_toes : left_toes);
        s.lifts += s.ticks > 1 && swings && !s.swings_foot[side];
        // One that turns on its ball or heel is not slid, nor one that rolls as it goes.
        if (stands && !swings && !s.swings_foot[side])
            s.slid = std::max(s.slid, std::min(length(on_ground(ankle - s.ankles[side])),
                                               length(on_ground(toes - s.toes[side]))));
        s.ankles[side] = ankle, s.toes[side] = toes, s.swings_foot[side] = swings;
    }
}

void look_at_way(const World& w, uint32_t i, Stand& s) {
    const float turn = wrap_angle(w.crowd.motion.heading[i] - s.heading);
    s.heading = w.crowd.motion.heading[i];
    s.turned += turn;
    if (std::fabs(turn) > k_turns * k_tick) {
        s.turns += turn * s.last_turn < 0;
        s.last_turn = turn;
    }
    const Vec2 v = w.crowd.motion.velocity[i];
    if (length(v) > k_goes) {
        s.swings += dot(v, s.last_velocity) < 0;
        s.last_velocity = v;
    }
}

void look_at_body(const World& w, uint32_t i, Stand& s) {
    bool moves = false;
    for (int j = 0; j < k_joint_count && !moves; ++j)
        moves = length(joint_of(w, i, j) - s.joints[static_cast<size_t>(j)]) > k_same;
    s.quiet = moves ? 0 : s.quiet + 1;
    s.longest_quiet = std::max(s.longest_quiet, s.quiet);
    if (moves) note_joints(w, i, s);
}

void count_in(const World& w, uint32_t i, const Stand& s, StandingTally& t) {
    ++t.all;
    t.frozen += s.longest_quiet > k_frozen_ticks;
    t.march += s.lifts > k_most_lifts && length(w.crowd.motion.position[i] - s.from) < k_got_nowhere &&
               std::fabs(s.turned) < k_faces_the_same;
    t.rock += s.turns > k_most_changes || s.swings > k_most_changes;
    t.slid = std::max(t.slid, s.slid);
}

}  // namespace

void look_at_standing(const World& w, StandingTally& t) {
    t.stands.resize(w.crowd.capacity);
    for (const WalkerId id : w.crowd.slots.living) {
        const uint32_t i = id.index;
        Stand& s = t.stands[i];
        if (!has_feet(w, i)) {
            s.is = false;
        } else if (!s.is || s.generation != id.generation ||
                   length(w.crowd.motion.position[i] - s.from) > k_stands_within) {
            begin(w, i, id.generation, s);
        } else {
            ++s.ticks;
            look_at_feet(w, i, s);
            look_at_way(w, i, s);
            look_at_body(w, i, s);
            if (s.ticks < k_stand_ticks) continue;
            count_in(w, i, s, t);
            s.is = false;
        }
    }
}

std::vector<Finding> standing_findings(const StandingTally& t) {
    if (t.all == 0) return {};
    auto percent = [&](uint64_t part) {
        return 100 * static_cast<double>(part) / static_cast<double>(t.all);
    };
    return {{"frozen, % of who stands", percent(t.frozen), 0, false, {}},
            {"march on the spot, % of who stands", percent(t.march), 1, false, {}},
            {"rock to and fro, % of who stands", percent(t.rock), 0.2, false, {}},
            {"slid of a foot that stands, m a tick", static_cast<double>(t.slid), 0.01, false, {}}};
}

}  // namespace flaneur
