#include "tools/flaneur/window/record/capture.h"

#include <utility>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/record/record.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

void ask_for_capture(Show& show, Viewer& v) {
    v.record.wants_capture = can_capture(*show.renderer);
    if (!v.record.wants_capture)
        report(v, "RenderDoc is not loaded, which captures pictures: start with `flaneur view --capture`.");
}

bool begin_asked_capture(Show& show, Viewer& v) {
    if (!std::exchange(v.record.wants_capture, false)) return false;
    const Result<void> begun = begin_capture(*show.renderer);
    if (!begun) report(v, begun.error().message);
    return static_cast<bool>(begun);
}

void end_asked_capture(Show& show, Viewer& v) {
    const Result<std::string> written =
        end_capture(*show.renderer, free_path("view", show.loaded.world->tick, ".rdc"));
    report(v, written ? "Captured " + *written + ", which qrenderdoc opens" : written.error().message);
}

}  // namespace flaneur
