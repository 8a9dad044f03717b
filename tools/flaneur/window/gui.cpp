#include "tools/flaneur/window/gui.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "letters.h"

namespace flaneur {
namespace {

constexpr float k_letter_size = 15;  // pixels, at scale 1

// Dark, calm, of few lines: what is looked at is the city.
void set_style(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = style.FrameRounding = style.GrabRounding = style.PopupRounding = 4;
    style.WindowBorderSize = 0;
    style.WindowPadding = {10, 8};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    auto set = [&](ImGuiCol colour, uint32_t rgb, float alpha) {
        style.Colors[colour] = {static_cast<float>(rgb >> 16 & 255) / 255,
                                static_cast<float>(rgb >> 8 & 255) / 255, static_cast<float>(rgb & 255) / 255,
                                alpha};
    };
    set(ImGuiCol_Text, 0xf2efe9, 1);
    set(ImGuiCol_TextDisabled, 0xa7a29a, 1);
    set(ImGuiCol_WindowBg, 0x1b1e22, 0.86f);
    set(ImGuiCol_PopupBg, 0x1b1e22, 0.96f);
    set(ImGuiCol_FrameBg, 0x353a41, 0.9f);
    set(ImGuiCol_FrameBgHovered, 0x454c55, 1);
    set(ImGuiCol_FrameBgActive, 0x4f5862, 1);
    set(ImGuiCol_Button, 0x353a41, 0.9f);
    set(ImGuiCol_ButtonHovered, 0x4b5763, 1);
    set(ImGuiCol_ButtonActive, 0x2f7f8c, 1);
    set(ImGuiCol_CheckMark, 0x58c4d2, 1);
    set(ImGuiCol_SliderGrab, 0x58c4d2, 1);
    set(ImGuiCol_SliderGrabActive, 0x7fdbe6, 1);
    set(ImGuiCol_Header, 0x2f7f8c, 0.6f);
    set(ImGuiCol_HeaderHovered, 0x2f7f8c, 0.8f);
    set(ImGuiCol_TitleBgActive, 0x24282d, 1);
    set(ImGuiCol_PlotHistogram, 0x58c4d2, 1);
    set(ImGuiCol_NavHighlight, 0x58c4d2, 1);
    style.ScaleAllSizes(scale);
}

float display_scale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    return std::clamp(std::max(x, y), 1.0f, 3.0f);
}

Result<void> load_letters(Renderer& renderer, float scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    const float size = std::round(k_letter_size * scale);
    // ImGui does not write to what it does not own.
    auto* letters = const_cast<unsigned char*>(k_letters_ttf);
    if (!atlas.AddFontFromMemoryTTF(letters, static_cast<int>(sizeof k_letters_ttf), size, &config))
        return Error{"The letters of the panels cannot be read."};
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsAlpha8(&texels, &width, &height);
    const Letters all{static_cast<uint32_t>(width), static_cast<uint32_t>(height),
                      std::span(texels, static_cast<size_t>(width) * static_cast<size_t>(height))};
    return upload_letters(renderer, all);
}

}  // namespace

Result<GuiPtr> make_gui(GLFWwindow* window, Renderer& renderer, float scale) {
    GuiPtr gui(new Gui);
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    gui->scale = scale > 0 ? scale : display_scale(window);
    set_style(gui->scale);
    ImGui_ImplGlfw_InitForOther(window, true);
    if (Result<void> loaded = load_letters(renderer, gui->scale); !loaded) return loaded.error();
    return gui;
}

void GuiDelete::operator()(Gui* gui) const {
    if (ImGui::GetCurrentContext()) {
        if (ImGui::GetIO().BackendPlatformUserData) ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    delete gui;
}

void begin_gui(Gui&) {
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

Panels end_gui(Gui& gui) {
    ImGui::Render();
    const ImDrawData& data = *ImGui::GetDrawData();
    gui.vertices.clear(), gui.indices.clear(), gui.draws.clear();
    for (const ImDrawList* list : std::span(data.CmdLists, static_cast<size_t>(data.CmdListsCount))) {
        const auto first_vertex = static_cast<uint32_t>(gui.vertices.size());
        const auto first_index = static_cast<uint32_t>(gui.indices.size());
        for (const ImDrawVert& v : list->VtxBuffer)
            gui.vertices.push_back({{v.pos.x * data.FramebufferScale.x, v.pos.y * data.FramebufferScale.y},
                                    {v.uv.x, v.uv.y},
                                    v.col});
        gui.indices.insert(gui.indices.end(), list->IdxBuffer.begin(), list->IdxBuffer.end());
        for (const ImDrawCmd& command : list->CmdBuffer) {
            if (command.UserCallback || command.ElemCount == 0) continue;
            const ImVec4 clip = command.ClipRect;
            gui.draws.push_back(
                {first_index + command.IdxOffset, command.ElemCount,
                 static_cast<int32_t>(first_vertex + command.VtxOffset),
                 glm::vec4(clip.x * data.FramebufferScale.x, clip.y * data.FramebufferScale.y,
                           clip.z * data.FramebufferScale.x, clip.w * data.FramebufferScale.y)});
        }
    }
    return {gui.vertices, gui.indices, gui.draws};
}

bool gui_has_mouse() { return ImGui::GetCurrentContext() && ImGui::GetIO().WantCaptureMouse; }
Wheel gui_wheel() {
    if (gui_has_mouse()) return {};
    const ImGuiIO& io = ImGui::GetIO();
    // To the side it counts to the left.
    if (io.KeyShift) return {0, -io.MouseWheel - io.MouseWheelH};
    return {io.MouseWheel, -io.MouseWheelH};
}
bool gui_has_keys() { return ImGui::GetCurrentContext() && ImGui::GetIO().WantTextInput; }

}  // namespace flaneur
