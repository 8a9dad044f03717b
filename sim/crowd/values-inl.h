// What the crowd keeps of one walker, by name: the one list that hash_crowd and the checks of the simulation
// go by (sim/fields.h).
#pragma once

#include <span>

#include "sim/base/field_name.h"
#include "sim/base/spans.h"
#include "sim/crowd/crowd.h"

namespace flaneur {

// Calls each(name, value) in a fixed order; of what only some walkers have with a pointer, null of the
// others, and of a list with a span.
template <class Each>
void for_each_value(const Crowd& c, uint32_t i, const Each& each) {
    constexpr FieldName k_who{"who"}, k_motion{"motion"}, k_decision{"decision"}, k_journey{"journey"};
    auto add = [&](const FieldName& of, std::string_view name, const auto& value) {
        each(FieldName{name, &of}, value);
    };
    const CrowdIdentity& who = c.identity;
    add(k_who, "preferred_speed", who.preferred_speed[i]);
    add(k_who, "radius", who.radius[i]);
    add(k_who, "lateral", who.lateral[i]);
    add(k_who, "body", who.body[i]);
    add(k_who, "scale", who.scale[i]);
    add(k_who, "room", who.room[i]);
    add(k_who, "patience", who.patience[i]);
    add(k_who, "linger", who.linger[i]);
    const CrowdMotion& m = c.motion;
    add(k_motion, "position", m.position[i]);
    add(k_motion, "velocity", m.velocity[i]);
    add(k_motion, "wish", m.wish[i]);
    add(k_motion, "heading", m.heading[i]);
    add(k_motion, "turn_rate", m.turn_rate[i]);
    add(k_motion, "feet", m.feet[i]);
    add(k_motion, "brakes", m.brakes[i]);
    add(k_motion, "polygon", m.polygon[i]);
    const FieldName under{"under", &k_motion};
    add(under, "height", m.under[i].height);
    add(under, "normal", m.under[i].normal);
    add(under, "kind", m.under[i].kind);
    const FieldName filed{"filed", &k_motion};
    add(filed, "column", m.filed[i].column);
    add(filed, "row", m.filed[i].row);
    const CrowdDecision& d = c.decision;
    add(k_decision, "wanted", d.wanted[i]);
    add(k_decision, "course", d.course[i]);
    add(k_decision, "aim", d.aim[i]);
    add(k_decision, "looks", d.looks[i]);
    add(k_decision, "chosen", d.chosen[i]);
    add(k_decision, "claim", d.claim[i]);
    const Journey& j = c.journeys[i];
    add(k_journey, "goal", j.goal);
    add(k_journey, "facing", j.facing);
    add(k_journey, "stay", j.stay);
    add(k_journey, "trip", j.trip);
    add(k_journey, "pause_until", j.pause_until);
    add(k_journey, "path_start", j.path_start);
    add(k_journey, "stretch_start", j.stretch_start);
    add(k_journey, "turned_at", j.turned_at);
    add(k_journey, "closest", j.closest);
    add(k_journey, "closest_tick", j.closest_tick);
    add(k_journey, "hurries_until", j.hurries_until);
    add(k_journey, "insists_since", j.insists_since);
    add(k_journey, "insists_from", j.insists_from);
    add(k_journey, "errand", j.errand);
    add(k_journey, "path_due", j.path_due);
    add(k_journey, "corner", j.corner);
    add(k_journey, "corner_count", j.corner_count);
    add(k_journey, "stuck", j.stuck);
    add(k_journey, "arrived", j.arrived);
    add(k_journey, "leaves", j.leaves);
    add(k_journey, "door_tries", j.door_tries);
    add(k_journey, "corners",
        std::span<const Vec3>(c.corners.data() + size_t{i} * k_corners + j.corner,
                              size_t{j.corner_count} - j.corner));
    each(FieldName{"at_once"}, c.at_once[i / k_block]);
    const Wayfarer* way = own_of(c.wayfarers, i);
    auto add_of_way = [&](std::string_view name, auto Wayfarer::*part) {
        constexpr FieldName k_way{"way"};
        each(FieldName{name, &k_way}, way ? &(way->*part) : nullptr);
    };
    add_of_way("kind", &Wayfarer::kind), add_of_way("waits", &Wayfarer::waits),
        add_of_way("turns", &Wayfarer::turns);
    add_of_way("whom", &Wayfarer::whom), add_of_way("range", &Wayfarer::range),
        add_of_way("bearing", &Wayfarer::bearing);
    add_of_way("stride", &Wayfarer::stride), add_of_way("platform", &Wayfarer::platform);
    const Passage* passage = passage_of(c, i);
    auto add_of_passage = [&](std::string_view name, auto Passage::*part) {
        constexpr FieldName k_passage{"passage"};
        each(FieldName{name, &k_passage}, passage ? &(passage->*part) : nullptr);
    };
    add_of_passage("kind", &Passage::kind), add_of_passage("shown", &Passage::shown),
        add_of_passage("door", &Passage::door);
    if (minds_lamps(c.kerbs)) {
        const KerbWait* wait = waits_at_kerb(c.kerbs, i) ? &c.kerbs.waits[i] : nullptr;
        auto add_of_wait = [&](std::string_view name, auto KerbWait::*part) {
            constexpr FieldName k_wait{"wait"};
            each(FieldName{name, &k_wait}, wait ? &(wait->*part) : nullptr);
        };
        add_of_wait("kerb", &KerbWait::kerb), add_of_wait("spot", &KerbWait::spot);
        add_of_wait("since", &KerbWait::since), add_of_wait("to", &KerbWait::to);
    }
    if (!c.fellows.empty()) {
        const Fellow& fellow = c.fellows[i];
        constexpr FieldName k_fellow{"fellow"};
        add(k_fellow, "group", fellow.group), add(k_fellow, "leads", fellow.leads);
        add(k_fellow, "pace", fellow.pace), add(k_fellow, "most", fellow.most);
        add(k_fellow, "spot", fellow.spot), add(k_fellow, "since", fellow.since);
        add(k_fellow, "drift", fellow.drift), add(k_fellow, "facing", fellow.facing);
    }
    add(k_journey, "way_back", c.way_back[i].polygon ? &c.way_back[i] : nullptr);
}

}  // namespace flaneur
