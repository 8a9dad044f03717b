#include "tools/flaneur/window/ask/techniques.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr int k_columns = 4;    // at most,
constexpr float k_column = 80;  // as wide as this at least, at scale 1

template <bool Techniques::*Is>
void turn(Show&, Viewer& v) {
    bool& is_on = v.techniques.on.*Is;
    is_on = !is_on;
}

constexpr std::array k_actions = {
    Action{"Before and after: techniques of bodies side by side", "Shift+J", GLFW_KEY_J, GLFW_MOD_SHIFT,
           split_techniques},
    Action{"Technique: gait, steps on the ground; off: limbs by curves", "", 0, 0, turn<&Techniques::gait>},
    Action{"Technique: feet, legs solved to the ground", "", 0, 0, turn<&Techniques::feet>},
    Action{"Technique: soles, tilted with the ground", "", 0, 0, turn<&Techniques::soles>},
    Action{"Technique: heels that rise", "", 0, 0, turn<&Techniques::heels>},
    Action{"Technique: pelvis, as high as legs reach", "", 0, 0, turn<&Techniques::pelvis>},
    Action{"Technique: limits of joints", "", 0, 0, turn<&Techniques::limits>},
    Action{"Technique: trunk against the pelvis", "", 0, 0, turn<&Techniques::trunk>},
    Action{"Technique: look, heads that turn", "", 0, 0, turn<&Techniques::look>},
    Action{"Technique: walls, hands on them", "", 0, 0, turn<&Techniques::walls>},
    Action{"Technique: holds, hands in pockets and on straps", "", 0, 0, turn<&Techniques::holds>},
    Action{"Technique: canes in hands", "", 0, 0, turn<&Techniques::canes>},
    Action{"Technique: prams, hands on handles", "", 0, 0, turn<&Techniques::prams>},
    Action{"Technique: idles, recorded motion", "", 0, 0, turn<&Techniques::idles>},
    Action{"Techniques: all on", "", 0, 0, [](Show&, Viewer& v) { v.techniques.on = {}; }},
};
static_assert(k_actions.size() == k_techniques.size() + 2);

// Whether it makes a difference: without the gait most do not.
bool holds(const TechniqueInfo& technique, const Techniques& on) {
    const auto is = [&](bool Techniques::*other) { return technique.is_on == other; };
    return on.gait || is(&Techniques::gait) || is(&Techniques::canes) || is(&Techniques::prams) ||
           is(&Techniques::idles);
}

void lay_out_half(const char* name, float middle, const std::string& text, Size size, float foot) {
    ImGui::SetNextWindowPos({middle * static_cast<float>(size.width), foot}, ImGuiCond_Always, {0.5f, 1});
    if (ImGui::Begin(name, nullptr, k_plain | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(0.3f * static_cast<float>(size.width));
        ImGui::TextUnformatted(text.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace

std::span<const Action> technique_actions() { return k_actions; }

void follow_switches(const TechniqueSwitches& switches, Show& show) {
    show.without.on = switches.on;
    show.draws_whole = switches.is_split;
}

void split_techniques(Show&, Viewer& v) {
    v.techniques.is_split = !v.techniques.is_split;
    if (!v.techniques.is_split) return;
    v.time.beside.reset();
    if (v.techniques.on == Techniques{})
        tell(v, "Switch something off in the room Gait to see a difference.");
}

std::string told_off(const Techniques& on) {
    std::string off;
    for (const TechniqueInfo& technique : k_techniques)
        if (!(on.*technique.is_on)) off.append(off.empty() ? "without " : ", ").append(technique.name);
    return off;
}

void lay_out_techniques(Show& show, Viewer& v, float width, float scale) {
    if (!ImGui::CollapsingHeader("Techniques", ImGuiTreeNodeFlags_DefaultOpen)) return;
    const int columns = std::clamp(static_cast<int>(width / (k_column * scale)), 1, k_columns);
    if (ImGui::BeginTable("techniques", columns, 0, {width, 0})) {
        for (const TechniqueInfo& technique : k_techniques) {
            ImGui::TableNextColumn();
            ImGui::BeginDisabled(!holds(technique, v.techniques.on));
            ImGui::Checkbox(technique.name.data(), &(v.techniques.on.*technique.is_on));
            ImGui::EndDisabled();
            if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) continue;
            constexpr float k_tip = 320;
            begin_tip_beside(k_tip * scale);
            ImGui::Text("On: %s.", technique.what.data());
            ImGui::Text("Off: %s.", technique.without.data());
            ImGui::PopTextWrapPos();
            ImGui::EndTooltip();
        }
        ImGui::EndTable();
    }
    bool is_split = v.techniques.is_split;
    if (ImGui::Checkbox("before and after", &is_split)) split_techniques(show, v);
    tip("all on in the left half, as switched here in the right one (Shift+J)");
    ImGui::SameLine();
    if (ImGui::Button("All on")) v.techniques.on = {};
    tip("bodies as they are");
}

void lay_out_halves(const Viewer& v, Size size) {
    if (!v.techniques.is_split) return;
    const PanelLayout& layout = v.layout;
    // With letters so large that no panel fits between the halves, one lies over where they are named.
    const bool has_panel = std::any_of(layout.plan.sides.begin(), layout.plan.sides.end(),
                                       [](const PanelPlace& place) { return place.is_there; });
    if (has_panel && !layout.wish.is_between) return;
    const std::string off = told_off(v.techniques.on);
    const float foot = layout.plan.row_foot - layout.wish.state.y - layout.plan.edge / 2;
    lay_out_half("left half", 0.25f, "all on", size, foot);
    lay_out_half("right half", 0.75f, off.empty() ? "all on, too" : off, size, foot);
}

}  // namespace flaneur
