#include "tools/flaneur/window/change/change.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/files/file.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/view/sun.h"
#include "tools/flaneur/window/change/people.h"
#include "tools/flaneur/window/change/platform.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/time/time.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

namespace {

constexpr uint32_t k_portion = 100;  // people who come or go at one time

// Where the sun stands at an hour; at that of the scene that was opened, where it has it.
void set_daylight(Show& show, const Design& design, const Scene& opened) {
    show.sun = scene_sun(scene_with(opened, design), show.loaded.city->latitude);
    show.lit_windows = lit_windows(design.hour);
}

void carry_time_and_weather(Show& show, Viewer& v) {
    Change& c = v.change;
    const Design& wanted = current(c.designs);
    show.is_overcast = c.carried.is_overcast = wanted.is_overcast;
    if (c.carried.hour == wanted.hour && c.carried.hour_set == wanted.hour_set) return;
    c.carried.hour = wanted.hour, c.carried.hour_set = wanted.hour_set;
    set_hour(*show.loaded.world, wanted.hour);
    set_daylight(show, wanted, c.scene);
    c.late = std::max(c.late, show.loaded.world->tick);
    changed_by_hand(v.time, *show.loaded.world);
}

// Who comes from now on; everybody who is there stays.
void carry_shares(Show& show, Viewer& v) {
    Change& c = v.change;
    const Design& wanted = current(c.designs);
    if (c.carried.mix == wanted.mix && c.carried.who == wanted.who) return;
    c.carried.mix = wanted.mix, c.carried.who = wanted.who;
    const Loaded& loaded = show.loaded;
    set_shares(*loaded.world, shares_of(wanted.who, wanted.mix, loaded.characters, loaded.parts));
    c.late = std::max(c.late, std::max(loaded.world->tick, 1u));
    changed_by_hand(v.time, *loaded.world);
}

void carry_people(Show& show, Viewer& v) {
    Change& c = v.change;
    World& world = *show.loaded.world;
    const Design& wanted = current(c.designs);
    if (c.carried.people == wanted.people || world.roam) return;
    if (!c.home || c.home_people != wanted.people) {
        c.home = find_neighbourhood(*world.ground, *world.navmesh, wanted.people);
        c.home_people = wanted.people;
    }
    std::optional<uint32_t> kept = v.selected;
    if (v.choice.kind == CameraChoice::Kind::follow) kept = v.choice.walker;
    if (world.crowd.driven.walker != k_nobody) kept = world.crowd.driven.walker;
    const Result<bool> done = approach(world, wanted.people, k_portion, *c.home, v.camera, kept);
    c.carried.people = kept_people(world);
    c.late = std::max(c.late, std::max(world.tick, 1u));
    if (!done) {
        tell(v, done.error().message);
        Design fewer = wanted;
        fewer.people = c.carried.people;
        change(c.designs, fewer, c.designs.gesture);
    }
    if (!done || *done) changed_by_hand(v.time, world);
    // Whoever was followed may be gone.
    const bool follows = v.choice.kind == CameraChoice::Kind::follow;
    if (follows && !is_there(world.crowd, v.choice.walker)) take_off(v);
}

// Targets that a hand holds, and methods.
void carry_exhibits(Show& show, Viewer& v) {
    Change& c = v.change;
    World& world = *show.loaded.world;
    const Design& wanted = current(c.designs);
    if (!set_exhibits(c.carried, wanted, world)) return;
    c.carried.held = wanted.held, c.carried.methods = wanted.methods;
    c.late = std::max(c.late, std::max(world.tick, 1u));
    changed_by_hand(v.time, world);
}

// What of the platform can be as it is wanted already; the outline that its ground is to have now.
std::vector<Vec2> carry_platform(Show& show, Viewer& v) {
    Change& c = v.change;
    World& world = *show.loaded.world;
    const std::vector<Vec2>& wanted = current(c.designs).platform;
    if (wanted.empty()) return {};
    const PlatformStep step = next_step(world, c.ground, wanted);
    const std::vector<Vec2>& ground = step.ground.empty() ? c.ground : step.ground;
    if (!step.is_for_circles) return ground;
    if (Result<void> done = change_platform(world, wanted); !done) {
        tell(v, done.error().message);
        give_up(c.designs);
        return c.ground;
    }
    c.carried.platform = wanted;
    c.late = std::max(c.late, std::max(world.tick, 1u));
    changed_by_hand(v.time, world);
    return ground;
}

// Takes in what has been made, and has the next thing made.
Result<void> carry_additions(Show& show, Viewer& v) {
    Change& c = v.change;
    if (show.loaded.world->roam) return {};
    if (std::optional<Result<Made>> made = finish(c.making)) {
        if (!*made) {
            tell(v, made->error().message);
            give_up(c.designs);
            c.selected.reset();
            return {};
        }
        const bool is_city = (**made).city != nullptr;
        // Meanwhile somebody may have come back onto ground that was to go.
        const std::vector<Vec2>& outline = current(c.designs).platform;
        const bool is_cut = (**made).bare && (**made).ground == outline;
        if (is_cut && !holds_everybody(*show.loaded.world, *(**made).mesh)) return {};
        c.carried.added = (**made).added;
        c.ground = (**made).ground;
        const bool stays_beside = is_city && v.time.beside && !v.time.beside->city;
        if (stays_beside) v.time.beside->city = show.loaded.city;
        if (Result<void> done = move_in(show, std::move(**made), stays_beside); !done) return done;
        if (is_city) {
            c.home.reset();
            c.late = std::max(c.late, show.loaded.world->tick);
            changed_by_hand(v.time, *show.loaded.world);
        }
    }
    if (is_making(c.making)) return {};
    const std::vector<Addition>& wanted = current(c.designs).added;
    const std::vector<Vec2> ground = carry_platform(show, v);
    if (ground == c.ground && wanted == c.carried.added && (!is_dark(show) || show.has_lamps)) return {};
    Order order = order_of(show, c, wanted);
    order.ground = ground;
    begin(c.making, std::move(order));
    return {};
}

}  // namespace

Order order_of(const Show& show, const Change& c, std::vector<Addition> added) {
    const World& world = *show.loaded.world;
    Order order;
    order.bare = show.loaded.bare, order.city = show.loaded.city;
    order.before = c.carried.added, order.added = std::move(added);
    order.with_lamps = is_dark(show);
    order.mesh = navmesh_bytes(*world.navmesh);
    order.settings = settings_of(*world.navmesh);
    order.ground = order.ground_before = c.ground;
    return order;
}

void start_changes(const Options& options, const Show& show, Viewer& v) {
    Change& c = v.change;
    const Scene& scene = c.scene = options.scene;
    if (!options.inputs.empty() && has_ending(options.inputs[0], ".json"))
        std::snprintf(c.path, sizeof c.path, "%s", options.inputs[0].c_str());
    v.walkers = people_count(*show.loaded.world);
    c.carried = {.added = scene.added,
                 .hour = scene.hour,
                 .is_overcast = scene.is_overcast,
                 .people = people_count(*show.loaded.world),
                 .who = scene.people,
                 .mix = scene.mix,
                 .held = show.loaded.world->linkages.held,
                 .methods = show.loaded.world->linkages.methods,
                 .platform = is_of(scene, BuiltIn::platform) ? platform_of(scene) : std::vector<Vec2>()};
    c.ground = c.carried.platform;
    c.designs = {{c.carried}, 0, 0, {0}};
    c.driving.is_by_turns = scene.limbs == LimbLead::curves;
}

bool is_as_opened(const Change& c) {
    const Design& now = c.carried;
    return c.late == 0 && now.added == c.scene.added && now.hour == c.scene.hour &&
           now.people == static_cast<uint32_t>(c.scene.walkers) && now.who == c.scene.people &&
           now.mix == c.scene.mix && (now.platform.empty() || now.platform == platform_of(c.scene));
}

void want(Viewer& v, Design next, uint64_t gesture) {
    Designs& designs = v.change.designs;
    if (next == current(designs)) return;
    change(designs, std::move(next), gesture);
    designs.deeds.resize(designs.all.size());
    designs.deeds[designs.at] = ++v.deeds;
}

Result<void> carry_on(Show& show, Viewer& v) {
    carry_time_and_weather(show, v);
    carry_shares(show, v);
    carry_people(show, v);
    carry_exhibits(show, v);
    v.walkers = people_count(*show.loaded.world);
    return carry_additions(show, v);
}

}  // namespace flaneur
