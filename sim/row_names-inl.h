// The rows of the structs that hold sixteen walkers, by name, and that none is left out.
#pragma once

#include <cstddef>

#include "sim/animation/layer.h"
#include "sim/base/field_name.h"
#include "sim/gait/gait.h"
#include "sim/pose/pose.h"

namespace flaneur {

// Each calls each(name, row) for all that the struct has, in its order: a row is one number of each lane, or
// an array of such rows.
template <class Each>
constexpr void for_each_row(const FootPlaces& p, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    add("x", p.x), add("y", p.y), add("z", p.z), add("yaw", p.yaw);
    add("normal_x", p.normal_x), add("normal_z", p.normal_z);
}

template <class Each>
constexpr void for_each_row(const FootBlock& f, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    const FieldName from{"from", of}, to{"to", of}, goal{"goal", of};
    for_each_row(f.from, &from, each);
    for_each_row(f.to, &to, each);
    add("obstacle", f.obstacle), add("round", f.round), add("edge", f.edge), add("phase", f.phase);
    add("pivots", f.pivots), add("forefoot", f.forefoot), add("swinging", f.swinging), add("rate", f.rate);
    for_each_row(f.goal, &goal, each);
    add("wished_x", f.wished_x), add("wished_z", f.wished_z), add("wished_yaw", f.wished_yaw);
    add("goal_round", f.goal_round), add("beside", f.beside);
    add("stance_ahead", f.stance_ahead), add("stance_out", f.stance_out), add("stance_turn", f.stance_turn);
}

template <class Each>
constexpr void for_each_row(const HandBlock& h, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    add("x", h.x), add("y", h.y), add("z", h.z);
    add("normal_x", h.normal_x), add("normal_z", h.normal_z), add("reach", h.reach);
}

template <class Each>
constexpr void for_each_row(const HoldBlock& h, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    add("x", h.x), add("y", h.y), add("z", h.z), add("anchor", h.anchor), add("elbow", h.elbow);
    add("twist", h.twist), add("bend", h.bend), add("side", h.side), add("weight", h.weight);
    add("share", h.share), add("kind", h.kind), add("wanted", h.wanted);
}

template <class Each>
constexpr void for_each_row(const GaitBlock& g, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    add("x", g.x), add("z", g.z), add("heading", g.heading), add("phase", g.phase), add("duty", g.duty);
    add("load", g.load), add("load_rate", g.load_rate), add("amplitude", g.amplitude);
    add("running", g.running), add("pace", g.pace), add("step", g.step), add("course", g.course);
    add("forward", g.forward), add("push", g.push), add("drive", g.drive), add("bank", g.bank);
    add("rise", g.rise), add("climb", g.climb), add("lift", g.lift), add("crouch", g.crouch);
    add("base", g.base), add("base_velocity", g.base_velocity);
    add("sink", g.sink), add("sink_velocity", g.sink_velocity);
    add("breath", g.breath), add("inhaled", g.inhaled);
    add("tilt_ahead", g.tilt_ahead), add("tilt_aside", g.tilt_aside);
    add("look", g.look), add("interest", g.interest), add("standing", g.standing);
    add("frequency", g.frequency), add("quicker", g.quicker), add("first", g.first);
    add("relaxed", g.relaxed), add("restless", g.restless);
    add("tread", g.tread), add("jump", g.jump), add("flight", g.flight);
    const FieldName left{"left", of}, right{"right", of}, left_hand{"left_hand", of},
        right_hand{"right_hand", of}, left_hold{"left_hold", of}, right_hold{"right_hold", of};
    for_each_row(g.feet[k_left], &left, each);
    for_each_row(g.feet[k_right], &right, each);
    for_each_row(g.hands[k_left], &left_hand, each);
    for_each_row(g.hands[k_right], &right_hand, each);
    for_each_row(g.holds[k_left], &left_hold, each);
    for_each_row(g.holds[k_right], &right_hold, each);
    add("posture", g.posture), add("next_posture", g.next_posture), add("doing", g.doing);
}

template <class Each>
constexpr void for_each_row(const PersonBlock& p, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    add("joints", p.joints), add("heel", p.heel), add("toe", p.toe), add("stride", p.stride);
    add("lead", p.lead), add("arm_swing", p.arm_swing), add("sway", p.sway), add("strike", p.strike);
    add("clearance", p.clearance), add("linger", p.linger), add("toe_out", p.toe_out);
    add("step_width", p.step_width), add("stance_width", p.stance_width);
    add("stance_ahead", p.stance_ahead), add("stance_turn", p.stance_turn);
    add("lean", p.lean), add("stoop", p.stoop), add("carriage", p.carriage), add("elbow", p.elbow);
    add("crouch", p.crouch), add("unevenness", p.unevenness), add("stray", p.stray), add("limp", p.limp),
        add("reel", p.reel), add("curiosity", p.curiosity), add("touches", p.touches);
    add("height", p.height), add("girth", p.girth), add("postures", p.postures);
    add("free_hands", p.free_hands), add("bag", p.bag);
}

template <class Each>
constexpr void for_each_row(const PoseBlock& p, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& row) { each(FieldName{name, of}, row); };
    add("origin", p.origin), add("position", p.position), add("rotation", p.rotation);
    add("rising", p.rising), add("sunk", p.sunk);
}

// Of those who have a cane or push a pram: each(name, value).
template <class Each>
constexpr void for_each_value(const Cane& c, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& value) { each(FieldName{name, of}, value); };
    add("walker", c.walker), add("tip_hs", c.tip_hs), add("tip", c.tip), add("velocity", c.velocity);
    add("from", c.from), add("to", c.to), add("goal", c.goal), add("gone", c.gone), add("share", c.share);
    add("left", c.left), add("rise", c.rise), add("clear", c.clear), add("held", c.held);
    add("steps", c.steps), add("lost", c.lost);
}

template <class Each>
constexpr void for_each_value(const PramPlace& p, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& value) { each(FieldName{name, of}, value); };
    add("place", p.place), add("yaw", p.yaw), add("pitch", p.pitch), add("roll", p.roll);
    add("wheel", p.wheel);
}

template <class Each>
constexpr void for_each_value(const Pram& p, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& value) { each(FieldName{name, of}, value); };
    add("walker", p.walker), add("scale", p.scale), add("handle", p.handle), add("aside", p.aside);
    add("aside_rate", p.aside_rate), add("off", p.off), add("slope", p.slope);
    const FieldName now{"now", of}, before{"before", of};
    for_each_value(p.now, &now, each);
    for_each_value(p.before, &before, each);
}

template <class Each>
constexpr void for_each_value(const ClipPlay& p, const FieldName* of, const Each& each) {
    auto add = [&](std::string_view name, const auto& value) { each(FieldName{name, of}, value); };
    add("walker", p.walker), add("clip", p.clip), add("phase", p.phase), add("fade", p.fade);
}

// What is new in these has to be listed above: hashes cover it, and a check must have a name for it.
template <class Block>
constexpr size_t listed_bytes() {
    size_t bytes = 0;
    auto add = [&](const FieldName&, const auto& member) { bytes += sizeof member; };
    const Block block{};
    if constexpr (requires { for_each_row(block, nullptr, add); })
        for_each_row(block, nullptr, add);
    else
        for_each_value(block, nullptr, add);
    return bytes;
}
static_assert(listed_bytes<GaitBlock>() == sizeof(GaitBlock) &&
              listed_bytes<PersonBlock>() == sizeof(PersonBlock) &&
              listed_bytes<PoseBlock>() == sizeof(PoseBlock) && listed_bytes<Cane>() == sizeof(Cane) &&
              listed_bytes<Pram>() == sizeof(Pram));
static_assert(listed_bytes<ClipPlay>() + 2 == sizeof(ClipPlay));  // two of them are padding

}  // namespace flaneur
