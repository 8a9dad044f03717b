// A loaded city on a device, ready to be drawn tick by tick.
#pragma once

#include <atomic>

#include "renderer/renderer.h"
#include "sim/without.h"
#include "tools/extract/extract.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/recording/playing.h"
#include "tools/flaneur/recording/taking.h"

namespace flaneur {

struct Show {
    RendererPtr renderer;
    Loaded loaded;
    PlayingPtr playing;  // what is shown instead of simulated; null: ticks are
    TakingPtr taking;    // records each tick; null: nobody does
    Sun sun;
    bool is_overcast = false;
    float lit_windows = 0;   // share
    bool has_lamps = false;  // the light of the city's lamps has been handed to the device
    PeopleFrame people;
    Without without;           // how bodies are drawn,
    bool draws_whole = false;  // or whole all the same
    float lod = 0;             // metres beyond which people go in less detail; 0: nobody does
    WorkViews work_views;
    Overlay overlay;
    bool hides_dots = false;  // of people on wide maps, for what else is coloured there
};

// Counts what the validation layer says, with --validate, until the renderer is gone.
RendererOptions renderer_options(const Options& options, std::atomic<uint32_t>& messages);
// Refuses if it said anything.
Result<void> check_messages(uint32_t messages);

// A show without a renderer, and what is to be uploaded for it.
struct PreparedShow {
    Show show;
    SceneMeshes meshes;
};
// Loads what the options name. Says on stderr what an import repaired, and how far it is.
Result<PreparedShow> prepare_show(const Options& options);
// Puts what was prepared, which is moved from, in place of all that `show` has but its renderer. After a
// failure both are as they were.
Result<void> upload_show(Show& show, PreparedShow& prepared, WorkViews views);
// The same show once more, by a renderer that was made anew.
Result<void> upload_again(Show& show);
// Says on stderr which device draws.
void say_device(const Renderer& renderer);

// All of it.
Result<Show> make_show(RendererPtr renderer, const Options& options);

// Whether lamps are lit.
bool is_dark(const Show& show);
bool is_dark(const Sun& sun, bool is_overcast);

// The next ticks are looked at by this camera: see look_from() in sim/sim.h. A long lens looks farther.
void look_from(Show& show, const Camera& camera);

// One tick, simulated or as it was recorded, and what the views for work keep of it. Where a recording has
// none, nothing changes, and Playing::failed says why.
void step(Show& show);
// To a tick of the recording that is shown; what the views for work keep begins anew.
Result<void> go_straight(Show& show, uint32_t tick);

// Shows these from the next frame on. Where the device draws no wireframe, normals take its place, and stderr
// says so.
void set_work_views(Show& show, WorkViews views);

// The frame between the world's last two ticks, valid until the next call, for a picture of this size.
FrameInput extract_frame(Show& show, const Camera& camera, Size size, float between);

}  // namespace flaneur
