#include "tools/flaneur/window/time/time.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>

#include "sim/base/tick.h"
#include "sim/state.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/recording/check.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/watch.h"

namespace flaneur {
namespace {

constexpr double k_piece_seconds = 0.2;  // of going, between two pictures
// Around where one went, states are kept so close together that the next steps back cost little.
constexpr uint32_t k_near = 60, k_near_ticks = 6;

// What was made of the world before it jumped.
void forget_past(Show& show) { show.overlay.trails = {}; }

// Somebody is asked about and followed who is there; else let go of.
void look_at(Viewer& v, const World& world, uint32_t walker) {
    if (walker >= world.crowd.count || !is_there(world.crowd, walker)) return;
    v.selected = walker;
    v.choice.walker = walker;
    choose(v, CameraChoice::Kind::follow);
}

// The state from which `tick` is reached soonest: strictly before it, so that the tick before it is known
// too, unless only the very state leads there. Loads it where the world is not nearer.
Result<void> approach(Show& show, Timeline& time, uint32_t tick) {
    World& world = *show.loaded.world;
    if (world.tick == tick && !time.is_rough) return {};
    std::optional<uint32_t> from;
    if (tick > 0 && !is_for_good(*time.history, tick)) from = kept_before(*time.history, tick - 1);
    if (!from) from = kept_before(*time.history, tick);
    if (!from || (world.tick < tick && world.tick >= *from)) return {};
    forget_past(show);
    time.is_rough = true;
    return restore(*time.history, *from, world);
}

bool is_event_found(const Viewer& v, const World& world, uint32_t since) {
    const Event* found = event_after(v.time.watch.events, since, v.time.wants);
    return found && found->tick == world.tick;
}

void arrive(Show& show, Viewer& v) {
    const Going going = *std::exchange(v.time.going, std::nullopt);
    v.clock.due = 0;
    if (!going.is_for_event) return;
    v.clock.is_paused = true;
    const World& world = *show.loaded.world;
    if (const Event* event = event_after(v.time.watch.events, world.tick - 1, v.time.wants)) {
        look_at(v, world, event->walker);
        tell(v, run_time(event->tick) + ": " + event_text(*event));
    }
}

// What lies under the hand at once, as near as it is kept; exact once the hand lets go.
void scrub(Show& show, Timeline& time) {
    World& world = *show.loaded.world;
    const std::optional<uint32_t> kept = kept_before(*time.history, *time.scrubbed_to);
    if (!kept || *kept == world.tick) return;
    forget_past(show);
    time.is_rough = true;
    (void)restore(*time.history, *kept, world);
}

// In place of the run that is shown.
void take_run(Show& show, Viewer& v, std::unique_ptr<World> world) {
    show.loaded.world = std::move(world);
    show.people = {};
    show.without = {};
    forget_past(show);
    v.walkers = show.loaded.world->crowd.count;
    v.hovered.reset();
    v.selected.reset();
    if (v.choice.walker >= v.walkers) v.choice.walker = 0;
    v.clock.due = 0;
    ++v.time.run;
    set_exhibits(v.change.carried, *show.loaded.world);
    begin_run(v.time, *show.loaded.world);
    recall_marks(show, v);
    tell(v, "Seed " + std::to_string(show.loaded.world->seed) + ", from the start");
}

// The next tick of the recording that is shown, which may still be written; at its end time stands still.
void play_tick(Show& show, Viewer& v) {
    Playing& playing = *show.playing;
    const World& world = *show.loaded.world;
    if (world.tick >= playing.last) (void)look_again(playing);
    v.time.latest = playing.last;
    if (world.tick >= playing.last) {
        v.clock.is_paused = true;
        return;
    }
    step(show);
    if (!playing.failed) return;
    v.clock.is_paused = true;
    tell(v, std::exchange(playing.failed, std::nullopt)->message);
}

// Any tick of it at once.
void play_at(Show& show, Viewer& v, uint32_t tick) {
    const Playing& playing = *show.playing;
    const Result<void> shown = go_straight(show, std::clamp(tick, playing.first, playing.last));
    v.cameras.rig = {};
    if (shown) return;
    v.clock.is_paused = true;
    tell(v, shown.error().message);
}

// What was changed since the last tick of all is recorded before the next one.
void record_change(const Show& show, const Timeline& time) {
    if (!show.taking) return;
    if (time.is_led) note_led(*show.taking);
    const World& world = *show.loaded.world;
    const bool is_changed = !time.changes.empty() && time.changes.back() == world.tick;
    if (is_changed && time.latest == world.tick) note_change(*show.taking, world);
}

}  // namespace

Anew::~Anew() {
    is_given_up = true;
    if (ready.valid()) ready.wait();
}

void begin_run(Timeline& time, const World& world) {
    if (!time.history) time.history = make_history(static_cast<size_t>(time.most_mib) << 20);
    forget(*time.history);
    if (!time.first_seed) time.first_seed = world.seed;
    const EventBounds bounds = time.watch.bounds;
    time.watch = {};
    time.watch.bounds = bounds;
    time.latest = world.tick;
    time.going.reset();
    time.scrubbed_to.reset();
    time.marks.clear();
    time.changes.clear();
    time.seed = time.beside_seed = static_cast<int>(std::min<uint64_t>(world.seed + 1, 0x7fffffff));
    time.beside_people = static_cast<int>(2 * people_count(world));
    time.mark = state_mark(world);
    time.ground = world.ground.get();
    follow(*time.history, world);
    watch(time.watch, world);
}

void changed_by_hand(Timeline& time, const World& world) {
    const uint64_t mark = state_mark(world);
    if (mark != time.mark || world.ground.get() != time.ground) forget(*time.history);
    time.mark = mark;
    time.ground = world.ground.get();
    keep_for_good(*time.history, world);
    std::erase_if(time.watch.events, [&](const Event& event) { return event.tick > world.tick; });
    if (time.watch.seen > world.tick) {
        time.watch.has_begun = false;
        watch(time.watch, world);
    }
    constexpr uint32_t k_one = 60;  // a hand on a slider changes it again and again
    std::vector<uint32_t>& changes = time.changes;
    while (!changes.empty() && changes.back() + k_one > world.tick) changes.pop_back();
    changes.push_back(world.tick);
    time.going.reset();
    time.latest = world.tick;
}

// Who was followed or asked about and has left is let go of.
static void let_go_of_gone(Viewer& v, const World& world) {
    for (const uint32_t walker : world.coming.gone) {
        if (v.selected == walker) v.selected.reset();
        if (!goes_along(v.choice.kind) || v.choice.walker != walker) continue;
        take_off(v);
        tell(v, "Walker " + std::to_string(walker) + ", whom the camera went along with, has left.");
    }
}

void make_tick(Show& show, Viewer& v) {
    if (show.playing) return play_tick(show, v);
    record_change(show, v.time);
    look_from(show, v.camera);
    step(show);
    v.time.is_rough = false;
    World& world = *show.loaded.world;
    let_go_of_gone(v, world);
    // What was changed by hand after this tick is changed again.
    if (world.tick < v.time.latest && is_for_good(*v.time.history, world.tick))
        (void)restore(*v.time.history, world.tick, world);
    if (v.time.is_led)
        forget(*v.time.history);
    else
        follow(*v.time.history, world);
    watch(v.time.watch, world);
    watch_tick(show, v, world.tick > v.time.latest);
    v.time.latest = std::max(v.time.latest, world.tick);
}

void go_to(Viewer& v, const World& world, int64_t tick) {
    const std::vector<uint32_t> kept = kept_ticks(*v.time.history);
    const int64_t first = kept.empty() ? world.tick : kept.front();
    const auto to = static_cast<uint32_t>(std::clamp<int64_t>(tick, first, k_wherever >> 1));
    v.time.going = Going{.from = world.tick, .to = to};
}

void go_to_event(Viewer& v, const World& world, const Event& event) {
    go_to(v, world, event.tick);
    v.time.going->is_for_event = true;
}

void go_to_next_event(Show& show, Viewer& v) {
    const World& world = *show.loaded.world;
    if (show.playing) return tell(v, "Nothing is watched for in what was recorded.");
    if (world.roam) return tell(v, "Nothing is watched for where people roam round a compound.");
    if (world.crowd.slots.living.empty()) return tell(v, "Nobody is there to whom something could happen.");
    if (const Event* event = event_after(v.time.watch.events, world.tick, v.time.wants))
        return go_to_event(v, world, *event);
    v.time.going = Going{.from = world.tick, .to = k_wherever, .is_for_event = true};
}

void go_to_event_before(Show& show, Viewer& v) {
    const World& world = *show.loaded.world;
    const Event* event = event_before(v.time.watch.events, world.tick, v.time.wants);
    if (!event) return tell(v, "Nothing is known to have happened before.");
    go_to_event(v, world, *event);
}

bool go_on(Show& show, Viewer& v, double now) {
    Timeline& time = v.time;
    if (show.playing && (time.scrubbed_to || time.going)) {
        play_at(show, v, time.scrubbed_to ? *time.scrubbed_to : time.going->to);
        if (!time.scrubbed_to) arrive(show, v);
        return true;
    }
    if (time.scrubbed_to) {
        scrub(show, time);
        v.cameras.rig = {};
        return true;
    }
    if (!time.going) return false;
    Going& going = *time.going;
    World& world = *show.loaded.world;
    if (going.began == 0) {
        going.began = now;
        const uint32_t was = world.tick;
        if (Result<void> near = approach(show, time, is_search(going) ? time.latest : going.to); !near) {
            time.going.reset();
            tell(v, near.error().message);
            return false;
        }
        if (world.tick != was) v.cameras.rig = {};  // who is gone along with is elsewhere
        if (!is_search(going)) going.from = world.tick;
    }
    const auto start = std::chrono::steady_clock::now();
    for (;;) {
        const bool is_there =
            is_search(going) ? is_event_found(v, world, going.from) : world.tick >= going.to;
        if (is_there) {
            arrive(show, v);
            return true;
        }
        const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
        if (spent.count() > k_piece_seconds) return true;
        make_tick(show, v);
        if (!is_search(going) && going.to - world.tick <= k_near && world.tick % k_near_ticks == 0)
            keep_now(*time.history, world);
    }
}

std::optional<Progress> progress_of(const Timeline& time, const World& world, double now) {
    constexpr double k_long = 0.2;
    if (time.anew) return Progress{time.anew->done, true};
    if (!time.going || time.going->began == 0) return std::nullopt;
    const Going& going = *time.going;
    const bool is_long = now - going.began > k_long;
    if (is_search(going) || going.to <= going.from) return Progress{0, is_long};
    const float share =
        static_cast<float>(world.tick - going.from) / static_cast<float>(going.to - going.from);
    return Progress{std::clamp(share, 0.0f, 1.0f), is_long};
}

bool stop_going(Viewer& v) {
    if (v.time.anew) {
        v.time.anew->is_given_up = true;
        return true;
    }
    if (!v.time.going) return false;
    v.time.going.reset();
    v.clock.is_paused = true;
    return true;
}

// In another city, if one is ordered.
static void make_run(Anew& anew, PeopleOrder people, const std::optional<Order>& city) {
    if (city) {
        Result<Made> made = make(*city);
        if (!made) {
            anew.world = made.error();
            return;
        }
        if (made->city) {
            people.ground = std::shared_ptr<const Ground>(made->city, &made->city->ground);
            people.mesh = navmesh_bytes(*made->mesh);
            people.options.destinations = made->city->destinations;
        }
        anew.made = std::move(*made);
    }
    anew.world = make_people(people, [&](std::string_view, float done) {
        anew.done = done;
        return !anew.is_given_up;
    });
}

void make_anew(Viewer& v, PeopleOrder people, std::optional<BesideChoice> beside, std::optional<Order> city) {
    if (v.time.anew) return tell(v, "People are being made already: Esc gives them up.");
    v.time.anew = std::make_unique<Anew>();
    Anew& anew = *v.time.anew;
    anew.beside = std::move(beside);
    anew.seed = people.options.seed;
    anew.ready = std::async(std::launch::async, [&anew, people = std::move(people), city = std::move(city)] {
        make_run(anew, people, city);
    });
}

void restart(Show& show, Viewer& v, uint64_t seed) {
    if (show.playing) return tell(v, "A recording is shown: its people are those who were there.");
    const World& world = *show.loaded.world;
    PeopleOrder people = order_people(show.loaded, seed, kept_people(world));
    if (v.change.late > 0) people.options.hour = v.change.carried.hour;  // from which on it was set last
    make_anew(v, std::move(people));
}

void take_people_anew(Show& show, Viewer& v) {
    if (!v.time.anew || v.time.anew->ready.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
        return;
    const std::unique_ptr<Anew> anew = std::move(v.time.anew);
    anew->ready.get();
    Result<std::unique_ptr<World>>& world = anew->world;
    if (anew->is_given_up) return tell(v, "Given up: everybody is still who they were.");
    if (!world) return tell(v, world.error().message);
    if (anew->beside)
        put_beside(show, v, std::move(*world), *anew);
    else
        take_run(show, v, std::move(*world));
}

void mark_moment(Viewer& v, const World& world) {
    std::vector<Mark>& marks = v.time.marks;
    const auto at = std::lower_bound(marks.begin(), marks.end(), world.tick,
                                     [](const Mark& mark, uint32_t tick) { return mark.tick < tick; });
    if (at != marks.end() && at->tick == world.tick)
        return tell(v, "This moment is marked already: " + at->name);
    const Mark mark{world.tick, "Mark " + std::to_string(marks.size() + 1), kept_choice(v), v.cameras.fov};
    marks.insert(at, mark);
    tell(v, mark.name + ", at " + run_time(mark.tick));
}

void go_to_mark(Viewer& v, const World& world, const Mark& mark) {
    go_to(v, world, mark.tick);
    v.cameras.fov = mark.fov;
    choose(v, mark.choice);
}

const Mark* mark_after(const Timeline& time, uint32_t tick) {
    for (const Mark& mark : time.marks)
        if (mark.tick > tick) return &mark;
    return nullptr;
}

const Mark* mark_before(const Timeline& time, uint32_t tick) {
    for (size_t i = time.marks.size(); i-- > 0;)
        if (time.marks[i].tick < tick) return &time.marks[i];
    return nullptr;
}

std::string run_time(uint32_t tick) {
    const uint32_t tenths = tick / 6, seconds = tenths / 10, minutes = seconds / 60;
    char text[48];
    if (minutes >= 60)
        std::snprintf(text, sizeof text, "%u:%02u:%02u.%u", minutes / 60, minutes % 60, seconds % 60,
                      tenths % 10);
    else
        std::snprintf(text, sizeof text, "%u:%02u.%u", minutes, seconds % 60, tenths % 10);
    return text;
}

}  // namespace flaneur
