#include "tools/flaneur/window/watch.h"

#include "tools/flaneur/measure/count.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

void watch_tick(const Show& show, Viewer& v, bool is_new) {
    if (is_new) count_people(v.measure.counts, *show.loaded.world);
    watch_gait(*show.loaded.world, watched(v), v.watch);
    ride(*show.loaded.world, v.cameras, v.choice);
}

}  // namespace flaneur
