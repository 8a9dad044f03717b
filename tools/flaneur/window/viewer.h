// What keys, mouse and panels of the window do to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/scene.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/window/ask/ask.h"
#include "tools/flaneur/window/ask/find.h"
#include "tools/flaneur/window/ask/gait.h"
#include "tools/flaneur/window/ask/techniques.h"
#include "tools/flaneur/window/cameras/cameras.h"
#include "tools/flaneur/window/change/change.h"
#include "tools/flaneur/window/events.h"
#include "tools/flaneur/window/exhibits/exhibits.h"
#include "tools/flaneur/window/frame/costs.h"
#include "tools/flaneur/window/kept/kept.h"
#include "tools/flaneur/window/layout.h"
#include "tools/flaneur/window/measure/measure.h"
#include "tools/flaneur/window/open/open.h"
#include "tools/flaneur/window/record/present.h"
#include "tools/flaneur/window/record/record.h"
#include "tools/flaneur/window/settings/panel_keys.h"
#include "tools/flaneur/window/settings/settings.h"
#include "tools/flaneur/window/steppers/steppers.h"
#include "tools/flaneur/window/time/clock.h"
#include "tools/flaneur/window/time/time.h"

namespace flaneur {

// What the panel on the left is about: one thing at a time.
enum class Room : uint8_t {
    none,
    layers,
    cameras,
    time,
    measure,
    find,
    gait,
    change,
    exhibits,
    record,
    frame,
    settings
};

struct KeyPress {
    int key = 0, mods = 0;
    bool repeats = false;
};

// What is looked for among all actions.
struct Palette {
    bool is_open = false;
    char typed[64] = {};
    int chosen = 0;
};

struct Viewer {
    Clock clock;
    Timeline time;
    CameraChoice choice;
    bool chosen = false;  // the choice's camera has been taken
    Camera camera;
    Cameras cameras;
    Keeping keeping;
    bool is_loading = true;
    Events events;
    Costs costs;
    std::vector<KeyPress> presses;                            // not acted upon yet
    bool wants_command = false, wants_bench_command = false;  // copied
    bool wants_close = false;
    bool lists_keys = false, has_panels = true;
    Room room = Room::none;
    Palette palette;
    double escaped_at = -1e9;       // of the window's time
    std::vector<WorkView> toggles;  // in the order of their keys
    uint32_t walkers = 0;
    std::optional<uint32_t> hovered, selected;  // walkers, by slot
    Asking asking;
    PeopleSearch search;
    GaitWatch watch;
    TechniqueSwitches techniques;
    MeasureRoom measure;
    double fps = 0;
    PanelLayout layout;
    std::string note;       // told for a while
    double note_until = 0;  // of the panels' time
    Change change;
    ExhibitsRoom exhibits;
    SteppersHand steppers;
    uint64_t deeds = 0;  // that were done so far and can be undone, here and in the room Measure
    Opening opening;
    Record record;
    Presentation presentation;
    Settings settings, kept_settings;  // these in their file
    int letters_percent = 100;         // while they are dragged
    PanelKeys panel_keys;
    float resolution = 1;  // share of the window's pixels that the picture is drawn in
    std::string quality;   // that is wanted of pictures, as --quality; empty: what the device draws by itself
};

}  // namespace flaneur
