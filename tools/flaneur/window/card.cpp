#include "tools/flaneur/window/card.h"

#include <imgui.h>

#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

const char* doing(const World& world, uint32_t walker) {
    const Journey& journey = world.crowd.journeys[walker];
    if (walker == world.crowd.driven.walker) return "goes as you say";
    if (journey.arrived) return "stands at its goal";
    if (world.tick < journey.pause_until) return "waits a moment";
    if (journey.path_due != PathDue::no) return "looks for a way";
    if (journey.stuck > 0) return "does not get on";
    return "on the way";
}

}  // namespace

void lay_out_card(Show& show, Viewer& v, Size size, float scale) {
    const World& world = *show.loaded.world;
    if (v.selected && !is_there(world.crowd, *v.selected)) v.selected.reset();
    const std::optional<uint32_t> who = v.selected ? v.selected : v.hovered;
    if (!who) return;
    const uint32_t walker = *who, kind = world.crowd.identity.body[walker];
    const Character& character = show.loaded.characters[kind];
    const float height = world.kinds[kind].body.height * world.crowd.identity.scale[walker];
    const Vec2 velocity = world.crowd.motion.velocity[walker];
    ImGui::SetNextWindowPos({static_cast<float>(size.width) - k_edge * scale, k_edge * scale},
                            ImGuiCond_Always, {1, 0});
    if (!ImGui::Begin("who", nullptr, k_plain)) return ImGui::End();
    if (character.found.scale == 0)
        ImGui::Text("%s, %.0f", character.person.woman ? "Woman" : "Man",
                    static_cast<double>(character.person.age));
    else
        ImGui::Text("%s", character.name.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("no. %u", walker);
    ImGui::Text("%.2f m tall", static_cast<double>(height));
    ImGui::Text("%.2f m/s, likes %.2f", static_cast<double>(length(velocity)),
                static_cast<double>(world.crowd.identity.preferred_speed[walker]));
    if (!world.roam) {
        const Vec3 goal = world.crowd.journeys[walker].goal.position,
                   at = world.crowd.motion.position[walker];
        ImGui::Text("%s, %.0f m to go", doing(world, walker), static_cast<double>(length(goal - at)));
    }
    if (!v.selected) {
        ImGui::TextDisabled("click to keep, F to follow");
    } else {
        if (ImGui::Button("Follow")) v.choice.walker = walker, choose(v, CameraChoice::Kind::follow);
        tip("F");
        ImGui::SameLine();
        if (ImGui::Button(is_driving(show) ? "Stop driving" : "Drive")) drive_asked(show, v);
        tip("X");
        ImGui::SameLine();
        if (ImGui::Button("Let go")) v.selected.reset();
    }
    ImGui::End();
}

}  // namespace flaneur
