#include "tools/flaneur/window/gui.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>

#include "letters.h"
#include "tools/flaneur/window/layout.h"

namespace flaneur {
namespace {

constexpr float k_letter_size = 15;  // pixels, at scale 1

// What panels are painted in, sRGB: dark, or light.
struct Paint {
    ImGuiCol what;
    uint32_t dark, light;
    float alpha;
};
constexpr Paint k_paints[] = {
    {ImGuiCol_Text, 0xf2efe9, 0x20242a, 1},
    {ImGuiCol_TextDisabled, 0xa7a29a, 0x5b5f66, 1},
    {ImGuiCol_WindowBg, 0x1b1e22, 0xf6f4ef, 0.9f},
    {ImGuiCol_PopupBg, 0x1b1e22, 0xf6f4ef, 0.97f},
    {ImGuiCol_FrameBg, 0x353a41, 0xdcdad3, 0.95f},
    {ImGuiCol_FrameBgHovered, 0x454c55, 0xcdcbc4, 1},
    {ImGuiCol_FrameBgActive, 0x4f5862, 0xbfbdb6, 1},
    {ImGuiCol_Button, 0x353a41, 0xdcdad3, 0.95f},
    {ImGuiCol_ButtonHovered, 0x4b5763, 0xc6cfd2, 1},
    {ImGuiCol_ButtonActive, 0x2f7f8c, 0x7fc4cf, 1},
    {ImGuiCol_CheckMark, 0x58c4d2, 0x14707e, 1},
    // The number stands over the knob.
    {ImGuiCol_SliderGrab, 0x2a7583, 0x8fcad3, 1},
    {ImGuiCol_SliderGrabActive, 0x338a99, 0x7fc4cf, 1},
    {ImGuiCol_Header, 0x2f7f8c, 0x7fc4cf, 0.6f},
    {ImGuiCol_HeaderHovered, 0x2f7f8c, 0x7fc4cf, 0.8f},
    {ImGuiCol_HeaderActive, 0x2f7f8c, 0x7fc4cf, 1},
    {ImGuiCol_TitleBgActive, 0x24282d, 0xe6e3dc, 1},
    {ImGuiCol_PlotHistogram, 0x58c4d2, 0x14707e, 1},
    {ImGuiCol_NavHighlight, 0x58c4d2, 0x14707e, 1},
};

// Calm, of few lines: what is looked at is the city.
void set_style(float scale, bool is_light) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    is_light ? ImGui::StyleColorsLight(&style) : ImGui::StyleColorsDark(&style);
    style.WindowRounding = style.FrameRounding = style.GrabRounding = style.PopupRounding = 4;
    style.WindowBorderSize = 0;
    style.WindowPadding = {10, 8};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    for (const Paint& paint : k_paints) {
        const uint32_t rgb = is_light ? paint.light : paint.dark;
        style.Colors[paint.what] = {static_cast<float>(rgb >> 16 & 255) / 255,
                                    static_cast<float>(rgb >> 8 & 255) / 255,
                                    static_cast<float>(rgb & 255) / 255, paint.alpha};
    }
    style.ScaleAllSizes(scale);
}

float display_scale(GLFWwindow* window) {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    return std::clamp(std::max(x, y), 1.0f, 3.0f);
}

// Copies a picture into the one that letters are in, and says where it is there.
glm::vec4 lay_in(const RgbaImage& picture, const ImFontAtlasCustomRect& place, int width, int height,
                 unsigned char* texels) {
    const size_t row = size_t{4} * picture.width;
    for (size_t y = 0; y < picture.height; ++y)
        std::memcpy(texels + 4 * ((place.Y + y) * static_cast<size_t>(width) + place.X),
                    &picture.rgba[y * row], row);
    // Half a texel within, so that no neighbour is mixed in.
    const auto u = [&](float x) { return (static_cast<float>(place.X) + x) / static_cast<float>(width); };
    const auto v = [&](float y) { return (static_cast<float>(place.Y) + y) / static_cast<float>(height); };
    return {u(0.5f), v(0.5f), u(static_cast<float>(picture.width) - 0.5f),
            v(static_cast<float>(picture.height) - 0.5f)};
}

}  // namespace

Result<void> hand_letters(Gui& gui, Renderer& renderer) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    const float size = std::round(k_letter_size * gui.scale);
    // ImGui does not write to what it does not own.
    auto* letters = const_cast<unsigned char*>(k_letters_ttf);
    if (!atlas.AddFontFromMemoryTTF(letters, static_cast<int>(sizeof k_letters_ttf), size, &config) ||
        !atlas.AddFontFromMemoryTTF(letters, static_cast<int>(sizeof k_letters_ttf), std::round(1.5f * size),
                                    &config))
        return Error{"The letters of the panels cannot be read."};
    std::vector<int> places;
    for (const RgbaImage& picture : gui.pictures)
        places.push_back(
            atlas.AddCustomRectRegular(static_cast<int>(picture.width), static_cast<int>(picture.height)));
    unsigned char* texels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsRGBA32(&texels, &width, &height);
    gui.boxes.clear();
    for (size_t i = 0; i < places.size(); ++i)
        gui.boxes.push_back(
            lay_in(gui.pictures[i], *atlas.GetCustomRectByIndex(places[i]), width, height, texels));
    const Letters all{
        static_cast<uint32_t>(width), static_cast<uint32_t>(height),
        std::span(texels, size_t{4} * static_cast<size_t>(width) * static_cast<size_t>(height))};
    return upload_letters(renderer, all);
}

ImFont* title_font() { return ImGui::GetIO().Fonts->Fonts[1]; }

Result<GuiPtr> make_gui(GLFWwindow* window, Renderer& renderer, float scale,
                        std::vector<RgbaImage> pictures) {
    GuiPtr gui(new Gui);
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    gui->scale = scale > 0 ? scale : display_scale(window);
    gui->pictures = std::move(pictures);
    set_style(gui->scale, gui->is_light);
    ImGui_ImplGlfw_InitForOther(window, false);
    glfwSetScrollCallback(window, ImGui_ImplGlfw_ScrollCallback);
    glfwSetWindowFocusCallback(window, ImGui_ImplGlfw_WindowFocusCallback);
    glfwSetCursorEnterCallback(window, ImGui_ImplGlfw_CursorEnterCallback);
    if (Result<void> loaded = hand_letters(*gui, renderer); !loaded) return loaded.error();
    return gui;
}

void GuiDelete::operator()(Gui* gui) const {
    if (ImGui::GetCurrentContext()) {
        if (ImGui::GetIO().BackendPlatformUserData) ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    delete gui;
}

Result<void> suit_gui(Gui& gui, GLFWwindow* window, Renderer& renderer, float scale, bool is_light) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    const float most = most_scale({static_cast<float>(width), static_cast<float>(height)});
    const float wanted = std::min(scale > 0 ? scale : display_scale(window), most);
    if (wanted == gui.scale && is_light == gui.is_light) return {};
    const bool is_larger = wanted != gui.scale;
    gui.scale = wanted;
    gui.is_light = is_light;
    set_style(gui.scale, is_light);
    return is_larger ? hand_letters(gui, renderer) : Result<void>();
}

void begin_gui(Gui&, GLFWwindow* window, const GuiInput& input) {
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    io.ConfigFlags = input.moves ? ImGuiConfigFlags_NavEnableKeyboard : ImGuiConfigFlags_None;
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    for (const int key : {input.tap, input.typed.key})
        if (key > 0) io.KeysDown[key] = true;
    for (const unsigned letter : input.typed.letters) io.AddInputCharacter(letter);
    const int mods = input.typed.key > 0 ? input.typed.mods : input.held;
    io.KeyCtrl = (mods & GLFW_MOD_CONTROL) != 0, io.KeyShift = (mods & GLFW_MOD_SHIFT) != 0;
    io.KeyAlt = (mods & GLFW_MOD_ALT) != 0, io.KeySuper = false;
    // Outside of the window it is nowhere, unless a button is held.
    const std::array<bool, 3>& down = input.pointer.is_down;
    const bool is_held = down[0] || down[1] || down[2];
    if (is_held || glfwGetWindowAttrib(window, GLFW_HOVERED) == GLFW_TRUE)
        io.MousePos = {static_cast<float>(input.pointer.x), static_cast<float>(input.pointer.y)};
    else
        io.MousePos = {-1e30f, -1e30f};
    std::copy(down.begin(), down.end(), std::begin(io.MouseDown));
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
Wheel gui_wheel(bool is_inverted) {
    if (gui_has_mouse()) return {};
    const ImGuiIO& io = ImGui::GetIO();
    // To the side it counts to the left.
    if (io.KeyShift) return {0, -io.MouseWheel - io.MouseWheelH};
    return {is_inverted ? -io.MouseWheel : io.MouseWheel, -io.MouseWheelH};
}
bool is_on_panel(double x, double y) {
    if (!ImGui::GetCurrentContext()) return false;
    const ImGuiContext& gui = *ImGui::GetCurrentContext();
    if (gui.OpenPopupStack.Size > 0) return true;
    const ImVec2 place(static_cast<float>(x), static_cast<float>(y));
    return std::any_of(gui.Windows.begin(), gui.Windows.end(), [&](const ImGuiWindow* panel) {
        return panel->WasActive && !panel->Hidden && !(panel->Flags & ImGuiWindowFlags_NoMouseInputs) &&
               panel->OuterRectClipped.Contains(place);
    });
}
bool gui_has_field() { return ImGui::GetCurrentContext() && ImGui::GetIO().WantTextInput; }
bool gui_has_keys() {
    return ImGui::GetCurrentContext() && (ImGui::GetIO().WantTextInput || ImGui::GetIO().ConfigFlags != 0);
}

}  // namespace flaneur
