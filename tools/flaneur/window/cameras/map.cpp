#include "tools/flaneur/window/cameras/map.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

// What is right and down in the picture, on the ground; +x is east and +z is south.
struct Axes {
    Vec2 right, down;
};
Axes axes_of(const CameraChoice& map) {
    const SinCos a = sin_cos(map.bearing * k_radians);
    return {{a.cosine, a.sine}, {-a.sine, a.cosine}};
}

void zoom_by(CameraChoice& map, float factor) {
    map.across = std::clamp(map.across * factor, k_least_across, k_most_across);
}

void draw_north(ImDrawList& list, ImVec2 middle, float radius, float bearing) {
    const SinCos a = sin_cos(-bearing * k_radians);  // where north is on the screen, clockwise from up
    auto at = [&](float x, float y) {
        return ImVec2(middle.x + radius * (x * a.cosine - y * a.sine),
                      middle.y + radius * (x * a.sine + y * a.cosine));
    };
    const ImU32 bright = ImGui::GetColorU32(ImGuiCol_Text), dim = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    list.AddTriangleFilled(at(0, -1), at(0.34f, 0.35f), at(0, 0.12f), dim);
    list.AddTriangleFilled(at(0, -1), at(0, 0.12f), at(-0.34f, 0.35f), bright);
    const ImVec2 size = ImGui::CalcTextSize("N"), foot = at(0, 0.72f);
    list.AddText({std::round(foot.x - size.x / 2), std::round(foot.y - size.y / 2)}, bright, "N");
}

void draw_scale(ImDrawList& list, ImVec2 left, float pixels, float scale) {
    const ImU32 bright = ImGui::GetColorU32(ImGuiCol_Text);
    const float tick = 5 * scale, thick = 2 * scale;
    list.AddLine({left.x, left.y}, {left.x + pixels, left.y}, bright, thick);
    for (const float x : {left.x, left.x + pixels})
        list.AddLine({x, left.y - tick}, {x, left.y + thick / 2}, bright, thick);
}

}  // namespace

CameraChoice map_around(const World& world, const Camera& camera, Size size) {
    constexpr float k_sight = 500, k_least = 100, k_most = 1500;  // metres
    if (world.roam) return {};
    const glm::vec3 way = glm::normalize(camera.target - camera.eye);
    const auto hit =
        raycast(*world.ground, {camera.eye.x, camera.eye.y, camera.eye.z}, {way.x, way.y, way.z}, k_sight);
    const float distance = hit ? hit->distance : 0;
    const glm::vec3 middle = camera.eye + way * distance;
    const float wide = static_cast<float>(size.width) / static_cast<float>(std::max(size.height, 1));
    CameraChoice map;
    map.kind = CameraChoice::Kind::map;
    map.middle = {middle.x, middle.z};
    map.across = std::clamp(2 * distance * std::tan(camera.vertical_fov / 2) * wide, k_least, k_most);
    return map;
}

CameraChoice map_between(const World& world, Size size, float top, float foot) {
    CameraChoice map = map_of_all(world, {size.width, std::max(static_cast<int>(foot - top), 1)});
    const float metres = map.across / static_cast<float>(size.width);
    map.middle.z += 0.5f * (static_cast<float>(size.height) - top - foot) * metres;
    return map;
}

Vec2 place_under(const CameraChoice& map, Size size, glm::vec2 pixel) {
    const Axes axes = axes_of(map);
    const float metres = map.across / static_cast<float>(size.width);
    const float x = (pixel.x + 0.5f - 0.5f * static_cast<float>(size.width)) * metres;
    const float y = (pixel.y + 0.5f - 0.5f * static_cast<float>(size.height)) * metres;
    return map.middle + axes.right * x + axes.down * y;
}

void zoom_map(CameraChoice& map, Size size, glm::vec2 pixel, float notches) {
    constexpr float k_notch = 0.85f;
    const Vec2 before = place_under(map, size, pixel);
    zoom_by(map, std::pow(k_notch, notches));
    map.middle += before - place_under(map, size, pixel);
}

void pan_map(CameraChoice& map, Size size, glm::vec2 from, glm::vec2 to) {
    map.middle += place_under(map, size, from) - place_under(map, size, to);
}

void turn_map(CameraChoice& map, float angle) {
    // What turns counter-clockwise has what is clockwise of it come up.
    map.bearing = wrap_angle((map.bearing * k_radians) + angle) / k_radians;
}

bool steer_map(CameraChoice& map, const Steering& hands, float seconds) {
    constexpr float k_pace = 0.6f, k_fast = 1.8f, k_zoom = 1.2f;  // of the width, of the scale, a second
    if (hands.ahead == 0 && hands.left == 0 && hands.up == 0) return false;
    const Axes axes = axes_of(map);
    const float way = map.across * (hands.is_fast ? k_fast : k_pace) * seconds;
    map.middle += (axes.right * -hands.left - axes.down * hands.ahead) * way;
    zoom_by(map, std::exp(hands.up * k_zoom * seconds));
    return true;
}

ScaleBar scale_bar(float metres_a_pixel, float most) {
    const float longest = metres_a_pixel * most;
    const float ten = std::pow(10.0f, std::floor(std::log10(longest)));
    float metres = ten;
    for (const float factor : {2.0f, 5.0f})
        if (factor * ten <= longest) metres = factor * ten;
    return {metres, metres / metres_a_pixel};
}

std::string told_length(float metres) {
    const bool is_far = metres >= 1000;
    char text[32];
    std::snprintf(text, sizeof text, "%g %s", static_cast<double>(is_far ? metres / 1000 : metres),
                  is_far ? "km" : "m");
    return text;
}

void lay_out_map(Viewer& v, Size size, float scale) {
    glm::vec2& extent = v.layout.wish.map;
    if (v.choice.kind != CameraChoice::Kind::map || !(v.choice.across > 0)) {
        extent = {};
        return;
    }
    if (extent.x > 0 && !v.layout.plan.has_map) return;
    const PanelPlan& plan = v.layout.plan;
    const float width = static_cast<float>(size.width);
    const float most = 150 * scale, north = 17 * scale, gap = 10 * scale;
    const ScaleBar bar = scale_bar(v.choice.across / static_cast<float>(size_of_one(v, size).width), most);
    ImGui::SetNextWindowPos({width - plan.edge, plan.row_foot}, ImGuiCond_Always, {1, 1});
    if (ImGui::Begin("map", nullptr, k_plain | ImGuiWindowFlags_NoInputs)) {
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const std::string label = told_length(bar.metres);
        const float line = ImGui::GetTextLineHeight();
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::Dummy({bar.pixels + gap + 2 * north, std::max(2 * north + 4 * scale, line + 10 * scale)});
        const float middle = at.y + north + 2 * scale;
        const float text = ImGui::CalcTextSize(label.c_str()).x;
        list.AddText({std::round(at.x + (bar.pixels - text) / 2), std::round(middle - line)},
                     ImGui::GetColorU32(ImGuiCol_Text), label.c_str());
        draw_scale(list, {std::round(at.x), std::round(middle + 8 * scale)}, bar.pixels, scale);
        draw_north(list, {at.x + bar.pixels + gap + north, middle}, north, v.choice.bearing);
    }
    extent = {ImGui::GetWindowWidth(), ImGui::GetWindowHeight()};
    ImGui::End();
}

}  // namespace flaneur
