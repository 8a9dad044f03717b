#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>

#include "tools/flaneur/window/record/record.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr std::array k_extents = {"as the window", "1920 x 1080", "3840 x 2160", "7680 x 4320", "typed:"};

// Which of them; the last one has a field to type in.
void lay_out_extent(const char* name, Extent& extent, char (&typed)[16], float scale) {
    ImGui::PushID(name);
    ImGui::SetNextItemWidth(150 * scale);
    int chosen = static_cast<int>(extent);
    if (ImGui::Combo("##size", &chosen, k_extents.data(), static_cast<int>(k_extents.size())))
        extent = static_cast<Extent>(chosen);
    if (extent == Extent::typed) {
        ImGui::SameLine();
        ImGui::SetNextItemWidth(100 * scale);
        ImGui::InputText("##typed", typed, sizeof typed);
    }
    ImGui::PopID();
}

}  // namespace

void lay_out_record(Show&, Viewer& v, float scale) {
    Record& r = v.record;
    ImGui::TextUnformatted("Picture");
    lay_out_extent("picture", r.picture.extent, r.picture.typed, scale);
    ImGui::Checkbox("the sky is transparent", &r.picture.is_transparent);
    ImGui::Checkbox("depth, in a further file", &r.picture.has_depth);
    tip(r.picture.is_exr ? "metres, 0 for the sky" : "16 bits of grey: centimetres, 0 for the sky");
    ImGui::Checkbox("ids, in a further file", &r.picture.has_ids);
    tip("which walker, house, tree, car, prop or ground each pixel shows:\na number each, and a .json that "
        "says "
        "what they are");
    if (r.picture.has_depth || r.picture.has_ids) {
        ImGui::Indent();
        int format = r.picture.is_exr;
        if (ImGui::RadioButton("as .png", &format, 0)) r.picture.is_exr = false;
        ImGui::SameLine();
        if (ImGui::RadioButton("as .exr", &format, 1)) r.picture.is_exr = true;
        ImGui::Unindent();
    }
    if (r.picture.extent == Extent::window) ImGui::Checkbox("with panels", &r.picture.has_panels);
    if (ImGui::Button("Write a picture")) r.wants_picture = true;
    tip("F12");
    ImGui::Dummy({0, 4 * scale});
    ImGui::TextUnformatted("Film");
    const bool is_filming = r.filming.has_value();
    ImGui::BeginDisabled(is_filming);
    lay_out_extent("film", r.film_extent, r.picture.typed, scale);
    int rate = r.is_smooth;
    if (ImGui::RadioButton("30 a second", &rate, 0)) r.is_smooth = false;
    ImGui::SameLine();
    if (ImGui::RadioButton("60", &rate, 1)) r.is_smooth = true;
    ImGui::SetNextItemWidth(150 * scale);
    ImGui::SliderInt("##length", &r.film_seconds, 0, 120,
                     r.film_seconds == 0 ? "until it is ended" : "%d s long", ImGuiSliderFlags_AlwaysClamp);
    ImGui::EndDisabled();
    tip("Of the film, whose time goes by in its own steps: where pictures take long to draw,\na second of it "
        "takes several to make.");
    if (ImGui::Button(is_filming ? "End the film" : "Record a film")) r.wants_film = true;
    tip("R");
    ImGui::BeginDisabled(is_filming);
    if (ImGui::Button("Film a turn")) r.wants_turn = true;
    tip("once round who was asked about, or what is in the middle (Shift+R)");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(110 * scale);
    ImGui::SliderInt("##turn", &r.turn_seconds, 3, 60, "in %d s", ImGuiSliderFlags_AlwaysClamp);
    ImGui::EndDisabled();
    ImGui::TextDisabled("They go into the folder out/.");
}

void lay_out_filming(Viewer& v, Size size) {
    if (!v.record.filming) {
        v.layout.wish.film = {};
        return;
    }
    const Filming& filming = *v.record.filming;
    ImGui::SetNextWindowPos({static_cast<float>(size.width) / 2, v.layout.plan.film_top}, ImGuiCond_Always,
                            {0.5f, 0});
    if (ImGui::Begin("filming", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) {
        const float height = ImGui::GetTextLineHeight();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddCircleFilled({at.x + height / 2, at.y + height / 2}, height * 0.36f,
                                                    0xff3030e0u);
        ImGui::Dummy({height, height});
        ImGui::SameLine();
        ImGui::TextUnformatted(told_progress(filming, glfwGetTime()).c_str());
        ImGui::SameLine();
        ImGui::TextDisabled("a film of %d x %d, R ends it", filming.size.width, filming.size.height);
        if (v.clock.is_paused) ImGui::TextColored(warning_colour(), "Time is stopped: Space lets it go on.");
    }
    v.layout.wish.film = {ImGui::GetWindowWidth(), ImGui::GetWindowHeight()};
    ImGui::End();
}

}  // namespace flaneur
