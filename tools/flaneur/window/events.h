// What hands do between two pictures, in its order, however few pictures there are: nothing gets lost, and a
// press is where the cursor was when it was made.
#pragma once

#include <array>
#include <deque>
#include <vector>

namespace flaneur {

struct MouseEvent {
    double x = 0, y = 0;  // pixels
    int button = -1;      // one of GLFW_MOUSE_BUTTON_*; -1: it has moved
    bool is_down = false;
};
// The mouse in one picture.
struct Pointer {
    double x = 0, y = 0;
    std::array<bool, 3> is_down{};  // by GLFW_MOUSE_BUTTON_*
};
void add_event(std::deque<MouseEvent>& events, const MouseEvent& event);
// The next picture's: so many events that a button goes up or down once at most, and the cursor is where it
// did. A drag's end is in a picture of its own, so that the way to it is seen.
void take_events(std::deque<MouseEvent>& events, Pointer& pointer);

// What is typed in a field.
struct Typed {
    unsigned letter = 0;    // Unicode; 0: a key
    int key = 0, mods = 0;  // of GLFW
};
struct Typing {
    std::deque<Typed> waiting;
    int last = 0;      // key that the field was told of in the last picture
    int pictures = 0;  // that they have waited for a field
};
// The next picture's: letters, and one key after them.
struct TypedNow {
    std::vector<unsigned> letters;
    int key = 0, mods = 0;
};
// `has_field`: whether one types; `gets_field`: whether one will, soon. Else they are for nothing.
TypedNow take_typed(Typing& typing, bool has_field, bool gets_field);

struct Events {
    std::deque<MouseEvent> mouse;
    Pointer pointer;
    double x = 0, y = 0;  // of the last event
    Typing typing;
};

}  // namespace flaneur
