#include "tools/flaneur/window/events.h"

#include <cmath>
#include <utility>

namespace flaneur {
namespace {

constexpr double k_seen = 4;      // pixels of a drag
constexpr int k_most_waited = 4;  // pictures, until a field that was opened is there

}  // namespace

void add_event(std::deque<MouseEvent>& events, const MouseEvent& event) {
    if (event.button < 0 && !events.empty() && events.back().button < 0)
        events.back() = event;
    else
        events.push_back(event);
}

void take_events(std::deque<MouseEvent>& events, Pointer& pointer) {
    const Pointer before = pointer;
    const bool was_held = before.is_down[0] || before.is_down[1] || before.is_down[2];
    while (!events.empty()) {
        const MouseEvent event = events.front();
        const bool has_moved = std::hypot(pointer.x - before.x, pointer.y - before.y) >= k_seen;
        if (event.button >= 0 && !event.is_down && was_held && has_moved) return;
        events.pop_front();
        pointer.x = event.x, pointer.y = event.y;
        if (event.button < 0 || event.button >= static_cast<int>(pointer.is_down.size())) continue;
        pointer.is_down[static_cast<size_t>(event.button)] = event.is_down;
        return;
    }
}

TypedNow take_typed(Typing& typing, bool has_field, bool gets_field) {
    TypedNow now;
    if (!has_field) {
        typing.last = 0;
        if (!gets_field || ++typing.pictures > k_most_waited) typing.waiting.clear();
        return now;
    }
    typing.pictures = 0;
    std::deque<Typed>& waiting = typing.waiting;
    for (; !waiting.empty() && waiting.front().letter != 0; waiting.pop_front())
        now.letters.push_back(waiting.front().letter);
    // The same key twice is let go of in between.
    if (!waiting.empty() && waiting.front().key != typing.last) {
        now.key = waiting.front().key, now.mods = waiting.front().mods;
        waiting.pop_front();
    }
    typing.last = now.key;
    return now;
}

}  // namespace flaneur
