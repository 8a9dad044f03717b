#include "tools/flaneur/window/record/present.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>

#include "sim/base/math.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/gui.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/record/record.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

constexpr double k_dip = 0.9;                        // seconds of darkness coming or going
constexpr float k_swing = 7 * k_radians;             // to each side
constexpr float k_nearer = 0.2f, k_most_metres = 3;  // of the way to what is ahead, and at most

using ViewKind = CameraChoice::Kind;
constexpr std::array k_city = {ViewKind::street, ViewKind::overview, ViewKind::crowd};
constexpr std::array k_small_world = {ViewKind::overview};

std::span<const ViewKind> views_of(const World& world) {
    return world.roam ? std::span<const ViewKind>(k_small_world) : std::span<const ViewKind>(k_city);
}

float eased(double x) {
    const auto t = static_cast<float>(std::clamp(x, 0.0, 1.0));
    return t * t * (3 - 2 * t);
}

void next_view(const Show& show, Viewer& v) {
    Presentation& p = v.presentation;
    const std::span<const ViewKind> views = views_of(*show.loaded.world);
    p.view = (p.view + 1) % static_cast<int>(views.size());
    p.seconds = 0;
    const World& world = *show.loaded.world;
    CameraChoice choice;
    choice.kind = views[static_cast<size_t>(p.view)];
    p.from = choose_camera(show, choice, 0, {}, 1);
    p.middle = looked_at(world, p.from);
}

}  // namespace

float darkness_at(double seconds) {
    return std::max(1 - eased(seconds / k_dip), eased((seconds - k_view_seconds + k_dip) / k_dip));
}

float title_at(double seconds) { return std::min(eased((seconds - 1) / 1.5), 1 - eased((seconds - 7) / 2)); }

Camera presented(const Presentation& p, bool goes_nearer) {
    const auto share = static_cast<float>(std::clamp(p.seconds / k_view_seconds, 0.0, 1.0));
    if (!goes_nearer) return turned_round(p.from, p.middle, (2 * share - 1) * k_swing);
    const glm::vec3 to = p.middle - p.from.eye;
    const float distance = glm::length(to);
    if (!(distance > 1e-3f)) return p.from;
    const glm::vec3 step = to * (share * std::min(k_nearer, k_most_metres / distance));
    Camera camera = p.from;
    camera.eye += step, camera.target += step;
    return camera;
}

void ask_for_presentation(Show&, Viewer& v) {
    v.presentation = Presentation();
    v.presentation.is_on = true;
    v.presentation.choice_before = v.choice;
    v.presentation.camera_before = v.camera;
    v.room = Room::none;
    v.lists_keys = false;
    v.selected.reset();
    take_off(v);
}

void end_presentation(Viewer& v) {
    if (!v.presentation.is_on) return;
    v.presentation.is_on = false;
    v.choice = v.presentation.choice_before;
    v.camera = v.presentation.camera_before;
    v.chosen = true;
}

void go_on_presenting(const Show& show, Viewer& v, double passed) {
    Presentation& p = v.presentation;
    if (!p.is_on) return;
    p.seconds += passed;
    if (p.view < 0 || p.seconds >= k_view_seconds) next_view(show, v);
    const ViewKind kind = views_of(*show.loaded.world)[static_cast<size_t>(p.view)];
    v.camera = presented(p, kind == ViewKind::street);
}

void lay_out_presentation(const Show& show, const Viewer& v, Size size, float scale) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_None);
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const ImVec2 corner{static_cast<float>(size.width), static_cast<float>(size.height)};
    auto black = [](float alpha) { return ImGui::ColorConvertFloat4ToU32({0, 0, 0, alpha}); };
    const float alpha = title_at(v.presentation.seconds), dark = darkness_at(v.presentation.seconds);
    const std::string title = printable(v.opening.name) + "   " + clock_text(show).substr(0, 5);
    const ImVec2 at{44 * scale, corner.y - 84 * scale};
    ImFont* const font = title_font();
    // On a ground that darkens softly towards the edge, so that it is read over anything.
    list.AddRectFilledMultiColor({0, corner.y - 170 * scale}, corner, black(0), black(0), black(0.6f * alpha),
                                 black(0.6f * alpha));
    list.AddText(font, font->FontSize, at, ImGui::ColorConvertFloat4ToU32({1, 1, 1, alpha}), title.c_str());
    if (dark > 0) list.AddRectFilled({0, 0}, corner, black(dark));
}

}  // namespace flaneur
