// Time in the window: back and forth in a run, marks and events in it, and runs anew.
//
// A run is one world from its first tick on. Going to a tick loads the nearest state that is kept before it
// (history/history.h) and steps on from there, a piece a picture, so that the window keeps answering.
#pragma once

#include <atomic>
#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assets/look.h"
#include "tools/flaneur/history/events.h"
#include "tools/flaneur/history/history.h"
#include "tools/flaneur/window/change/making.h"
#include "tools/flaneur/window/time/beside.h"

namespace flaneur {

struct Action;
struct PeopleOrder;

// A moment that somebody wants to find again, and from where it was looked at.
struct Mark {
    uint32_t tick = 0;
    std::string name;
    CameraChoice choice;
    float fov = 0;  // as Cameras::fov
    bool operator==(const Mark&) const = default;
};

// On the way to another moment.
struct Going {
    uint32_t from = 0, to = 0;  // ticks
    bool is_for_event = false;  // whoever it is about is followed then
    double began = 0;           // seconds, of the window's time; 0: not yet
};
inline constexpr uint32_t k_wherever = ~0u;  // Going::to: on until there is an event
inline bool is_search(const Going& going) { return going.to == k_wherever; }

// People who are made anew, on a thread of their own: in place of those who are there, or beside them.
struct Anew {
    uint64_t seed = 1;
    std::optional<BesideChoice> beside;
    std::optional<Made> made;  // the city that they walk in, if one was ordered
    std::atomic<bool> is_given_up = false;
    std::atomic<float> done = 0;                     // share
    Result<std::unique_ptr<World>> world = Error{};  // once it is ready
    std::future<void> ready;
    ~Anew();  // gives them up
};

struct Timeline {
    HistoryPtr history;
    int most_mib = static_cast<int>(k_history_bytes >> 20);
    Watch watch;
    uint32_t run = 0;                    // how many runs there were before this one
    std::optional<uint64_t> first_seed;  // of the first one, which the command line tells
    uint32_t latest = 0;                 // tick, as far as this run has come
    uint64_t mark = 0;                   // state_mark of what is kept, and its ground
    const Ground* ground = nullptr;
    bool is_led =
        false;  // somebody is led by a hand, which is not simulated again: no past is kept meanwhile

    std::optional<Going> going;
    bool is_rough = false;  // the world is as it was kept, and what was a tick before is not known
    std::optional<uint32_t> scrubbed_to;  // tick under the hand that drags on the timeline
    std::unique_ptr<Anew> anew;
    std::unique_ptr<Beside> beside;

    std::vector<Mark> marks;        // by tick
    std::vector<uint32_t> changes;  // ticks after which the world was changed by hand, in order
    EventFilter wants{true, true, true, true};
    // Typed, of the next run and of the one beside it.
    int seed = 0, beside_seed = 0, beside_people = 0;
};

// Makes the timeline know a world whose first tick it is at, or that it is at now: the begin of a run.
void begin_run(Timeline& time, const World& world);

// The world has been changed by other than its ticks, after this tick: people came or were sent elsewhere,
// the city is another. What was kept of later is no longer to come, nor are events; where the ground, the
// hour or the capacity is another, what was kept of before cannot be had any more either. To be called after
// each such change, and after each tick in which somebody is led by hand.
void changed_by_hand(Timeline& time, const World& world);

// One tick of the world, and all that looks at every tick.
void make_tick(Show& show, Viewer& viewer);

// From the next picture on the world goes to `tick`; not before its first.
void go_to(Viewer& viewer, const World& world, int64_t tick);
// To the next event, whoever it is about is followed then; where none is known yet the run goes on until
// there is one. And to the one before, if there is.
void go_to_next_event(Show& show, Viewer& viewer);
void go_to_event_before(Show& show, Viewer& viewer);
void go_to_event(Viewer& viewer, const World& world, const Event& event);
// Goes on towards where it is to go for a while that leaves the window alive, or follows a hand on the
// timeline. `now`: the window's time. True while time does not go by for itself.
bool go_on(Show& show, Viewer& viewer, double now);
// How far it is, none: it goes nowhere.
struct Progress {
    float share = 0;       // 0..1
    bool is_long = false;  // one has to wait for it
};
std::optional<Progress> progress_of(const Timeline& time, const World& world, double now);
// Stops where it is, or gives up the people who are made anew. False if there is neither.
bool stop_going(Viewer& viewer);

// Makes people in the background, in another city first, if one is ordered: in place of those who are there,
// or beside them. Not while some are being made, which is told.
void make_anew(Viewer& viewer, PeopleOrder people, std::optional<BesideChoice> beside = {},
               std::optional<Order> city = {});
// Other people, or the same, begin a run in place of this one.
void restart(Show& show, Viewer& viewer, uint64_t seed);
// Takes those who are made. To be called once a picture.
void take_people_anew(Show& show, Viewer& viewer);

void mark_moment(Viewer& viewer, const World& world);
// There, with its camera.
void go_to_mark(Viewer& viewer, const World& world, const Mark& mark);
const Mark* mark_after(const Timeline& time, uint32_t tick);
const Mark* mark_before(const Timeline& time, uint32_t tick);

// The keys of all this.
std::span<const Action> time_actions();
// Along the lower edge: what is kept, now, marks and events; a hand on it goes there.
void lay_out_timeline(Show& show, Viewer& viewer, Size size, float scale);
// The room on the left.
void lay_out_time(Show& show, Viewer& viewer, float scale);

// "1:02:03.5", minutes and seconds at least; of a tick since the first.
std::string run_time(uint32_t tick);

}  // namespace flaneur
