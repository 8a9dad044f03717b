#include "tools/flaneur/window/panels/palette.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

// What hands do that are no actions.
struct Hand {
    const char *what, *keys;
};
constexpr std::array k_hands = {
    Hand{"Fly; Shift: fast", "W A S D, arrows"},
    Hand{"Down, up", "Q E"},
    Hand{"Look about; along a map", "drag"},
    Hand{"Nearer, farther", "wheel"},
    Hand{"To the side", "Shift+wheel"},
    Hand{"Drag along", "drag, middle"},
    Hand{"Look round; turn a map", "drag, right"},
    Hand{"Ask who or what that is", "click"},
};

void lay_out_row(const char* what, const char* keys) {
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(keys);
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", what);
}

struct Match {
    const Action* action;
    const char* group;
    int worth;
};
std::vector<Match> find(const char* typed) {
    std::vector<Match> found;
    for (const ActionGroup& group : action_groups())
        for (const Action& action : group.actions)
            if (const int worth = match(typed, action.name); worth > 0)
                found.push_back({&action, group.name, worth});
    std::stable_sort(found.begin(), found.end(),
                     [](const Match& a, const Match& b) { return a.worth > b.worth; });
    return found;
}

// It is closed first, for the action may open it again.
void choose_action(const Action& action, Show& show, Viewer& v) {
    v.palette.is_open = false;
    action.act(show, v);
}

}  // namespace

void lay_out_keys(Viewer& v, Size size, float scale) {
    if (!v.lists_keys) return;
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {static_cast<float>(size.width) - 2 * k_edge * scale,
                                                 static_cast<float>(size.height) - 2 * k_edge * scale});
    if (ImGui::Begin("Keys", &v.lists_keys, k_room)) {
        ImGui::PushTextWrapPos(fitted(1e9f, scale));
        auto table = [&](const char* name, auto rows) {
            ImGui::TextUnformatted(name);
            if (!ImGui::BeginTable(name, 2)) return;
            ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 130 * scale);
            rows();
            ImGui::EndTable();
        };
        table("Mouse and flying", [] {
            for (const Hand& hand : k_hands) lay_out_row(hand.what, hand.keys);
        });
        for (const ActionGroup& group : action_groups())
            table(group.name, [&] {
                if (group.in_short) return lay_out_row(group.in_short, group.keys_in_short);
                for (const Action& action : group.actions)
                    if (*action.keys) lay_out_row(action.name, action.keys);
            });
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

void lay_out_palette(Show& show, Viewer& v, Size size, float scale) {
    Palette& palette = v.palette;
    if (!palette.is_open) return;
    const DialogPlace place = dialog_place(size.height, 14, scale);
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, place.top}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({fitted(520, scale), 0});
    const Action* chosen = nullptr;
    if (ImGui::Begin("palette", nullptr, k_plain & ~ImGuiWindowFlags_NoFocusOnAppearing)) {
        if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
        ImGui::SetNextItemWidth(-1);
        ImGui::InputTextWithHint("##typed", "what would you like to do?", palette.typed,
                                 sizeof palette.typed);
        if (ImGui::IsItemEdited()) palette.chosen = 0;
        const std::vector<Match> found = find(palette.typed);
        const int last = static_cast<int>(found.size()) - 1;
        palette.chosen = std::clamp(palette.chosen, 0, std::max(last, 0));
        if (found.empty()) ImGui::TextDisabled("nothing of that name");
        if (ImGui::BeginChild("found", {0, place.list})) {
            for (int i = 0; i <= last; ++i) {
                const Match& row = found[static_cast<size_t>(i)];
                ImGui::PushID(row.action);
                if (ImGui::Selectable(row.action->name, i == palette.chosen)) chosen = row.action;
                if (i == palette.chosen && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
                const char* keys = *row.action->keys ? row.action->keys : row.group;
                // Where that would lie over the name, it is left out.
                const float right =
                    std::min(370 * scale, ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(keys).x);
                if (right > ImGui::CalcTextSize(row.action->name).x + 10 * scale) {
                    ImGui::SameLine(right);
                    ImGui::TextDisabled("%s", keys);
                }
                ImGui::PopID();
            }
        }
        ImGui::EndChild();
    }
    ImGui::End();
    if (chosen) choose_action(*chosen, show, v);
}

void press_in_palette(int key, Show& show, Viewer& v) {
    Palette& palette = v.palette;
    if (key == GLFW_KEY_ESCAPE) palette.is_open = false;
    if (key == GLFW_KEY_DOWN) ++palette.chosen;
    if (key == GLFW_KEY_UP) --palette.chosen;
    if (key != GLFW_KEY_ENTER && key != GLFW_KEY_KP_ENTER) return;
    const std::vector<Match> found = find(palette.typed);
    const auto chosen = static_cast<size_t>(palette.chosen);
    if (chosen < found.size()) choose_action(*found[chosen].action, show, v);
}

}  // namespace flaneur
