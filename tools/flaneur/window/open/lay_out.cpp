#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/window/open/complete.h"
#include "tools/flaneur/window/open/open.h"
#include "tools/flaneur/window/open/start.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr int k_rows = 10;  // of what a typed path may become

void copy_typed(PathPrompt& prompt, const std::string& text) {
    std::strncpy(prompt.typed, text.c_str(), sizeof prompt.typed - 1);
}

// ImGui has the text while one types.
int replace_typed(ImGuiInputTextCallbackData* data) {
    PathPrompt& prompt = *static_cast<PathPrompt*>(data->UserData);
    if (!prompt.becomes) return 0;
    data->DeleteChars(0, data->BufTextLen);
    data->InsertChars(0, prompt.becomes->c_str());
    prompt.becomes.reset();
    return 0;
}

void look_for(PathPrompt& prompt) {
    if (prompt.looked_for == prompt.typed && !prompt.rows.empty()) return;
    prompt.looked_for = prompt.typed;
    prompt.found = completions(prompt.typed);
    prompt.rows = prompt.found;
    const std::string above = folder_above(prompt.typed);
    if (!above.empty()) prompt.rows.insert(prompt.rows.begin(), above);
    prompt.chosen = -1;
}

void become(PathPrompt& prompt, const std::string& text) {
    prompt.becomes = text;
    prompt.chosen = -1;
    prompt.wants_focus = true;
}

// A folder is looked into; a file is opened.
void take(Viewer& v, const std::string& path) {
    if (path.ends_with('/'))
        become(v.opening.prompt, path);
    else
        open_path(v, path);
}

void lay_out_prompt(Viewer& v, Size size, float scale) {
    PathPrompt& prompt = v.opening.prompt;
    if (!prompt.is_open) return;
    look_for(prompt);
    const DialogPlace place = dialog_place(size.height, k_rows + 1, scale);
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, place.top}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({fitted(620, scale), 0});
    ImGui::SetNextWindowBgAlpha(1);
    std::optional<std::string> clicked;
    if (ImGui::Begin("open", nullptr, k_plain & ~ImGuiWindowFlags_NoFocusOnAppearing)) {
        if (ImGui::IsWindowAppearing() || std::exchange(prompt.wants_focus, false))
            ImGui::SetKeyboardFocusHere();
        ImGui::SetNextItemWidth(-1);
        ImGui::InputTextWithHint("##path", "a map, a city, a character or a scene", prompt.typed,
                                 sizeof prompt.typed,
                                 ImGuiInputTextFlags_AutoSelectAll | ImGuiInputTextFlags_CallbackAlways |
                                     ImGuiInputTextFlags_CallbackCompletion,
                                 replace_typed, &prompt);
        if (ImGui::BeginChild("found", {0, place.list - ImGui::GetTextLineHeightWithSpacing()})) {
            const size_t above = prompt.rows.size() - prompt.found.size();
            for (size_t i = 0; i < prompt.rows.size(); ++i) {
                const std::string& path = prompt.rows[i];
                const size_t slash = path.size() < 2 ? std::string::npos : path.rfind('/', path.size() - 2);
                const std::string own = slash == std::string::npos ? path : path.substr(slash + 1);
                const std::string name = i < above ? "..  the folder above" : own;
                const bool is_chosen = static_cast<int>(i) == prompt.chosen;
                ImGui::PushID(static_cast<int>(i));
                if (ImGui::Selectable(printable(name).c_str(), is_chosen)) clicked = path;
                if (is_chosen && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
                ImGui::PopID();
            }
            if (prompt.found.empty()) ImGui::TextDisabled("nothing here that can be opened");
        }
        ImGui::EndChild();
        if (prompt.found.size() > 1)
            ImGui::TextDisabled("Tab completes what all %zu begin with, Enter opens", prompt.found.size());
        else
            ImGui::TextDisabled("Tab completes, Enter opens, Esc leaves it");
    }
    ImGui::End();
    if (clicked) take(v, *clicked);
}

void press_in_prompt(int key, Viewer& v) {
    PathPrompt& prompt = v.opening.prompt;
    look_for(prompt);  // what was typed since the last picture too
    const int last = static_cast<int>(prompt.rows.size()) - 1;
    if (key == GLFW_KEY_ESCAPE) prompt.is_open = false;
    if (key == GLFW_KEY_DOWN) prompt.chosen = std::min(prompt.chosen + 1, last);
    if (key == GLFW_KEY_UP) prompt.chosen = std::max(prompt.chosen - 1, -1);
    const bool is_chosen = prompt.chosen >= 0 && prompt.chosen <= last;
    const std::string chosen = is_chosen ? prompt.rows[static_cast<size_t>(prompt.chosen)] : prompt.typed;
    if (key == GLFW_KEY_TAB) become(prompt, is_chosen ? chosen : completed(prompt.typed, prompt.found));
    if ((key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER) && !chosen.empty()) take(v, chosen);
}

void lay_out_under_way(const Opening& opening, Size size, float scale) {
    if (!opening.under_way || opening.is_unwanted) return;
    lay_out_loading(city_name(opening.under_way->options.scene), printable(progress_line()),
                    "Esc gives it up", size, scale);
}

}  // namespace

void ask_for_path(Show&, Viewer& v) {
    Opening& opening = v.opening;
    opening.prompt = PathPrompt();
    opening.prompt.is_open = true;
    std::error_code error;
    std::filesystem::path begin;
    if (!opening.recent.empty()) begin = std::filesystem::path(opening.recent.front()).parent_path();
    if (!std::filesystem::is_directory(begin, error)) begin = std::filesystem::current_path(error);
    if (!begin.empty()) copy_typed(opening.prompt, begin == "/" ? "/" : begin.string() + "/");
    opening.prompt.becomes = opening.prompt.typed;  // with nothing selected, to go on from
}

void open_start_screen(Show&, Viewer& v) { v.opening.start.is_open = true; }

void lay_out_opening(Show& show, Viewer& v, Size size, float scale) {
    lay_out_start(show, v, size, scale);
    lay_out_prompt(v, size, scale);
    lay_out_under_way(v.opening, size, scale);
}

bool press_in_opening(int key, int mods, Show& show, Viewer& v) {
    if (mods & GLFW_MOD_CONTROL) return false;
    if (v.opening.prompt.is_open) return press_in_prompt(key, v), true;
    return v.opening.start.is_open && press_in_start(key, show, v);
}

}  // namespace flaneur
