#include "tools/flaneur/window/change/room.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/exhibits/exhibits.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

namespace {

constexpr float k_width = 360;  // pixels, at scale 1

// Of those of one linkage, or of all; none: nothing was held.
void let_sway(const Show& show, Viewer& v, std::optional<size_t> of) {
    const Linkages& linkages = show.loaded.world->linkages;
    Design next = current(v.change.designs);
    for (size_t t = 0; t < next.held.size(); ++t)
        if (!of || linkage_of(linkages, t) == *of) next.held[t] = {};
    if (next == current(v.change.designs))
        return tell(v, "No target is held: drag one with the left button.");
    want(v, std::move(next));
}

void as_it_was(const Show& show, Viewer& v, size_t i) {
    Design next = current(v.change.designs);
    next.methods[i] = show.loaded.world->linkages.all[i].method;
    want(v, std::move(next));
}

void set_method(Viewer& v, size_t i, const Method& method, uint64_t gesture = 0) {
    Design next = current(v.change.designs);
    next.methods[i] = method;
    want(v, std::move(next), gesture);
}

// The next solver that the chosen exhibit takes.
void next_solver(Show& show, Viewer& v) {
    const Linkages& linkages = show.loaded.world->linkages;
    const auto chosen = v.exhibits.chosen;
    if (!has_exhibits(*show.loaded.world) || !chosen || *chosen >= linkages.all.size())
        return tell(v, "Click an exhibit's target, or its row in the room Exhibits, to choose it.");
    Method method = current(v.change.designs).methods[*chosen];
    if (linkages.all[*chosen].kind != Linkage::Kind::chain)
        return tell(v, linkages.all[*chosen].name + " is no chain: FABRIK alone moves it.");
    do {
        method.solver = static_cast<Solver>((static_cast<uint32_t>(method.solver) + 1) % k_solver_count);
    } while (!takes(linkages.all[*chosen], method));
    set_method(v, *chosen, method);
    tell(v, "By " + told_method(linkages.all[*chosen], method));
}

void lay_out_figures(const Linkages& linkages, Viewer& v, float scale) {
    ExhibitsRoom& room = v.exhibits;
    constexpr float k_new = 0.05f;  // share of a picture's figure in what is shown
    if (room.us.size() != linkages.all.size()) {
        room.us.clear();
        for (const double ms : linkages.solve_ms) room.us.push_back(1e3f * static_cast<float>(ms));
    }
    if (!ImGui::BeginTable("figures", 4, ImGuiTableFlags_SizingStretchProp, {k_width * scale, 0})) return;
    ImGui::TableSetupColumn("exhibit", ImGuiTableColumnFlags_WidthStretch, 3);
    ImGui::TableSetupColumn("iterations", ImGuiTableColumnFlags_WidthStretch, 1.35f);
    for (const char* name : {"mm off", "us"})
        ImGui::TableSetupColumn(name, ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableHeadersRow();
    for (size_t i = 0; i < linkages.all.size(); ++i) {
        room.us[i] += k_new * (1e3f * static_cast<float>(linkages.solve_ms[i]) - room.us[i]);
        ImGui::PushID(static_cast<int>(i));
        ImGui::TableNextColumn();
        const std::string name = told_method(linkages.all[i], linkages.methods[i]);
        if (ImGui::Selectable(name.c_str(), room.chosen == i, ImGuiSelectableFlags_SpanAllColumns))
            room.chosen = i;
        ImGui::TableNextColumn();
        const bool is_most = linkages.solved[i].iterations >= linkages.methods[i].patience.iterations;
        ImGui::TextColored(is_most ? warning_colour() : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%d",
                           linkages.solved[i].iterations);
        ImGui::TableNextColumn();
        ImGui::Text("%.1f", 1e3 * static_cast<double>(linkages.solved[i].off));
        ImGui::TableNextColumn();
        ImGui::Text("%.1f", static_cast<double>(room.us[i]));
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void lay_out_solvers(const Linkage& linkage, size_t i, const Method& method, Viewer& v) {
    if (linkage.kind != Linkage::Kind::chain) {
        ImGui::TextDisabled("FABRIK: no other method here knows trees and limits");
        return;
    }
    if (!ImGui::BeginCombo("method", k_solver_names[static_cast<size_t>(method.solver)].data())) return;
    for (uint32_t s = 0; s < k_solver_count; ++s) {
        Method other = method;
        other.solver = static_cast<Solver>(s);
        if (!takes(linkage, other)) continue;
        if (ImGui::Selectable(k_solver_names[s].data(), other == method)) set_method(v, i, other);
    }
    ImGui::EndCombo();
}

void lay_out_chosen(const Show& show, Viewer& v, size_t i, float scale) {
    const Linkages& linkages = show.loaded.world->linkages;
    const Linkage& linkage = linkages.all[i];
    Method method = current(v.change.designs).methods[i];
    ImGui::Separator();
    if (linkage.kind == Linkage::Kind::chain)
        ImGui::Text("A chain of %d joints", static_cast<int>(linkage.rest.size()));
    else
        ImGui::Text("%s, %d target%s", linkage.name.c_str(), static_cast<int>(linkage.leads.size()),
                    linkage.leads.size() == 1 ? "" : "s");
    ImGui::PushItemWidth(190 * scale);
    lay_out_solvers(linkage, i, method, v);
    float millimetres = 1e3f * method.patience.tolerance;
    const bool is_near = ImGui::SliderFloat("tolerance", &millimetres, 0.01f, 100, "%.2f mm",
                                            ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    const uint64_t gesture = gesture_of_item(v.change);
    tip("it stops once it is so near to its targets");
    if (is_near) {
        method.patience.tolerance = 1e-3f * millimetres;
        set_method(v, i, method, gesture);
    }
    const bool is_long = ImGui::SliderInt("most iterations", &method.patience.iterations, 1, 2000, "%d",
                                          ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp);
    const uint64_t other_gesture = gesture_of_item(v.change);
    tip("it stops after so many in a tick, wherever it is");
    if (is_long) set_method(v, i, method, other_gesture);
    ImGui::PopItemWidth();
    if (ImGui::Button("Let it sway")) let_sway(show, v, i);
    tip("its targets go back to where they swayed");
    ImGui::SameLine();
    if (ImGui::Button("As it was")) as_it_was(show, v, i);
    tip("method, tolerance and iterations as the scene has them");
}

constexpr std::array k_actions = {
    Action{
        "Exhibits: methods, figures; drag the red balls, which stay", "Shift+T", GLFW_KEY_T, GLFW_MOD_SHIFT,
        [](Show& show, Viewer& v) {
            if (!has_exhibits(*show.loaded.world))
                return tell(v, "Nothing here is moved by methods to choose from: see the scene ik-gallery.");
            v.room = v.room == Room::exhibits ? Room::none : Room::exhibits;
        }},
    Action{"Let all targets sway again", "Alt+T", GLFW_KEY_T, GLFW_MOD_ALT,
           [](Show& show, Viewer& v) { let_sway(show, v, {}); }},
    Action{"Another method for the chosen exhibit", "Ctrl+T", GLFW_KEY_T, GLFW_MOD_CONTROL, next_solver},
};

}  // namespace

void lay_out_exhibits(Show& show, Viewer& v, float scale) {
    const Linkages& linkages = show.loaded.world->linkages;
    if (!has_exhibits(*show.loaded.world)) {
        ImGui::TextDisabled("Nothing here is moved by methods to choose from.");
        return;
    }
    lay_out_figures(linkages, v, scale);
    std::optional<size_t>& chosen = v.exhibits.chosen;
    if (chosen && *chosen >= linkages.all.size()) chosen.reset();
    if (chosen)
        lay_out_chosen(show, v, *chosen, scale);
    else
        ImGui::TextDisabled("Click a row, or drag a red ball, to choose an exhibit.");
    if (ImGui::Button("Let all sway")) let_sway(show, v, {});
    tip("Alt+T");
}

std::span<const Action> exhibit_actions() { return k_actions; }

}  // namespace flaneur
