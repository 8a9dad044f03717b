#include "tools/flaneur/window/open/start.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "assets/scene.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/open/open.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr float k_card = 208, k_picture = 117, k_gap = 14;  // at scale 1: width, height of what it shows

// How they are laid out: the cards in rows, files below each other, then what asks for a path.
struct Choices {
    int scenes = 0, files = 0, columns = 1;
    int path() const { return scenes + files; }
};
Choices choices_of(const Opening& opening) {
    return {static_cast<int>(scene_names().size()), static_cast<int>(opening.recent.size()),
            opening.start.columns};
}

void choose(Show& show, Viewer& v, const Choices& c, int which) {
    if (which < c.scenes)
        open_scene(v, scene_names()[static_cast<size_t>(which)]);
    else if (which < c.path())
        open_path(v, v.opening.recent[static_cast<size_t>(which - c.scenes)]);
    else
        ask_for_path(show, v);
}

// A scene by its picture, its name and what it says of itself; whether it was clicked.
bool lay_out_card(const std::string& name, const std::string& about, const glm::vec4& picture, bool is_chosen,
                  float scale) {
    const ImVec2 from = ImGui::GetCursorScreenPos(), extent{k_card * scale, (k_picture + 62) * scale};
    const bool is_clicked = ImGui::InvisibleButton(name.c_str(), extent);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 to{from.x + extent.x, from.y + extent.y}, edge{to.x, from.y + k_picture * scale};
    const float round = 6 * scale;
    list.AddRectFilled(
        from, to, ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_FrameBgHovered : ImGuiCol_FrameBg),
        round);
    list.AddImageRounded(ImGui::GetIO().Fonts->TexID, from, edge, {picture.x, picture.y},
                         {picture.z, picture.w}, 0xffffffffu, round, ImDrawFlags_RoundCornersTop);
    if (is_chosen) list.AddRect(from, to, ImGui::GetColorU32(ImGuiCol_CheckMark), round, 0, 2.5f * scale);
    const float inset = 10 * scale;
    list.AddText({from.x + inset, edge.y + 6 * scale}, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize() * 0.87f, {from.x + inset, edge.y + 25 * scale},
                 ImGui::GetColorU32(ImGuiCol_TextDisabled), about.c_str(), nullptr, extent.x - 2 * inset);
    return is_clicked;
}

int lay_out_cards(const Opening& opening, const Choices& c, float scale) {
    int clicked = -1, number = 0;
    const float left = ImGui::GetCursorPosX();
    for (const std::string& name : scene_names()) {
        if (number % c.columns != 0)
            ImGui::SameLine(0, k_gap * scale);
        else
            ImGui::SetCursorPosX(left);
        const Result<Scene> scene = load_scene(name);
        const auto at = static_cast<size_t>(number);
        const glm::vec4 picture = at < opening.pictures.size() ? opening.pictures[at] : glm::vec4(0);
        if (lay_out_card(name, scene ? scene->about : "", picture, opening.start.chosen == number, scale))
            clicked = number;
        if (opening.start.has_moved && opening.start.chosen == number) ImGui::SetScrollHereY();
        ++number;
    }
    return clicked;
}

int lay_out_files(const Opening& opening, const Choices& c, float scale) {
    int clicked = -1, number = c.scenes;
    if (c.files > 0) ImGui::TextDisabled("Opened of late");
    const float low = ImGui::GetTextLineHeightWithSpacing();
    const float height = std::min(static_cast<float>(c.files), 6.0f) * low + 4 * scale;
    if (c.files > 0 && ImGui::BeginChild("files", {0, height})) {
        for (const std::string& path : opening.recent) {
            const std::filesystem::path whole(path);
            ImGui::PushID(number);
            if (ImGui::Selectable(printable(whole.filename().string()).c_str(),
                                  opening.start.chosen == number))
                clicked = number;
            if (opening.start.chosen == number && !ImGui::IsItemVisible()) ImGui::SetScrollHereY();
            ImGui::SameLine(250 * scale);
            ImGui::TextDisabled("%s", printable(whole.parent_path().string()).c_str());
            ImGui::PopID();
            ++number;
        }
    }
    if (c.files > 0) ImGui::EndChild();
    return clicked;
}

}  // namespace

void lay_out_start(Show& show, Viewer& v, Size size, float scale) {
    Opening& opening = v.opening;
    if (!opening.start.is_open) return;
    const float room = static_cast<float>(size.width) - 80 * scale, each = (k_card + k_gap) * scale;
    opening.start.columns = std::clamp(static_cast<int>((room + k_gap * scale) / each), 1,
                                       static_cast<int>(scene_names().size()));
    const Choices c = choices_of(opening);
    const auto columns = static_cast<float>(c.columns);
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, static_cast<float>(size.height) / 2},
                            ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {static_cast<float>(size.width) - 2 * k_edge * scale,
                                                 static_cast<float>(size.height) - 2 * k_edge * scale});
    int clicked = -1;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20 * scale, 16 * scale});
    if (ImGui::Begin("start", nullptr, k_plain & ~ImGuiWindowFlags_NoScrollbar)) {
        ImGui::PushFont(title_font());
        ImGui::TextUnformatted("flaneur");
        ImGui::PopFont();
        ImGui::TextDisabled("Choose a city to stroll, or drop a file on the window.");
        ImGui::Dummy({columns * k_card * scale + (columns - 1) * k_gap * scale, 2 * scale});
        clicked = lay_out_cards(opening, c, scale);
        ImGui::Dummy({0, 2 * scale});
        clicked = std::max(clicked, lay_out_files(opening, c, scale));
        const bool is_chosen = opening.start.chosen == c.path();
        if (is_chosen)
            ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        if (ImGui::Button("Open a file...")) clicked = c.path();
        if (is_chosen) ImGui::PopStyleColor();
        go_beside("Go on with what is shown", scale);
        if (ImGui::Button("Go on with what is shown")) opening.start.is_open = false;
        constexpr const char* k_hint = "arrows and Enter choose, Esc goes on";
        go_beside(k_hint, scale);
        ImGui::TextDisabled("%s", k_hint);
    }
    ImGui::End();
    ImGui::PopStyleVar();
    opening.start.has_moved = false;
    if (clicked >= 0) choose(show, v, c, clicked);
}

bool press_in_start(int key, Show& show, Viewer& v) {
    Opening& opening = v.opening;
    const Choices c = choices_of(opening);
    int& chosen = opening.start.chosen;
    const bool is_in_cards = chosen < c.scenes;
    int to = chosen;
    switch (key) {
        case GLFW_KEY_ESCAPE:
            opening.start.is_open = false;
            break;
        case GLFW_KEY_ENTER:
        case GLFW_KEY_KP_ENTER:
        case GLFW_KEY_SPACE:
            choose(show, v, c, chosen);
            break;
        case GLFW_KEY_RIGHT:
        case GLFW_KEY_TAB:
            to = chosen + 1;
            break;
        case GLFW_KEY_LEFT:
            to = chosen - 1;
            break;
        case GLFW_KEY_DOWN:
            to = is_in_cards ? std::min(chosen + c.columns, c.scenes) : chosen + 1;
            break;
        case GLFW_KEY_UP:
            to = is_in_cards ? chosen - c.columns : chosen - 1;
            break;
        default:
            return false;
    }
    if (to >= 0) chosen = std::min(to, c.path());
    opening.start.has_moved = true;
    return true;
}

}  // namespace flaneur
