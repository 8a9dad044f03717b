#include "tools/flaneur/window/change/lamps.h"

#include <imgui.h>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

void lay_out_lamps(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    if (!minds_lamps(world.crowd.kerbs)) return;
    float share = 100 * world.jaywalkers;
    ImGui::SetNextItemWidth(170 * scale);
    if (ImGui::SliderFloat("go on red", &share, 0, 100, "%.0f %%", ImGuiSliderFlags_AlwaysClamp)) {
        set_jaywalkers(world, share / 100);
        changed_by_hand(v.time, world);
    }
    tip("of those who come to a crossing while its lamp is red; at 100 % nobody minds lamps");
}

}  // namespace flaneur
