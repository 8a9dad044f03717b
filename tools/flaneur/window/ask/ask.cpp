#include "tools/flaneur/window/ask/ask.h"

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/navigate.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

const CityIndex& index_of(const Show& show, Viewer& v) {
    if (v.asking.index.city != show.loaded.city) {
        v.asking.index = index_things(show.loaded.city);
        v.asking.hovered.reset(), v.asking.selected.reset();
    }
    return v.asking.index;
}

glm::vec3 place_under(const Show& show, Viewer& v, glm::vec3 way) {
    const glm::vec3 eye = v.camera.eye;
    if (!show.loaded.world->roam)
        if (const auto thing =
                thing_along(index_of(show, v), {eye.x, eye.y, eye.z}, {way.x, way.y, way.z}, false))
            return eye + way * thing->distance;
    return place_along(*show.loaded.world, v.camera, way);
}

}  // namespace flaneur
