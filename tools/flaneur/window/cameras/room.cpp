// The room of the cameras.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/cameras/cameras.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

struct ModeRow {
    CameraMode mode;
    const char *name, *action;  // the action's name, for its key; null: moving does it
};
constexpr ModeRow k_modes[] = {
    {CameraMode::fly, "Fly", nullptr},
    {CameraMode::walk, "On foot", "Walk on foot, or lift off"},
    {CameraMode::street, "Street", "Look down the street"},
    {CameraMode::overview, "From above", "Look from above"},
    {CameraMode::crowd, "Densest crowd", "Look at the densest crowd"},
    {CameraMode::follow, "Behind somebody", "Follow somebody"},
    {CameraMode::eyes, "Somebody's eyes", "Look through somebody's eyes"},
    {CameraMode::map, "Map", "Map: all of the city, or where one was"},
};

const Action* action_named(const char* name) {
    for (const Action& action : camera_actions())
        if (name && std::string_view(action.name) == name) return &action;
    return nullptr;
}

void lay_out_modes(Show& show, Viewer& v, float scale) {
    const CameraMode now = mode_of(v);
    for (const ModeRow& row : k_modes) {
        const Action* action = action_named(row.action);
        if (ImGui::Selectable(row.name, now == row.mode, 0, {130 * scale, 0})) {
            if (action && now != row.mode) action->act(show, v);
            if (!action) take_off(v);
        }
        ImGui::SameLine(150 * scale);
        ImGui::TextDisabled("%s", action ? action->keys : "W A S D");
    }
}

void lay_out_lens(Viewer& v, float scale) {
    const bool has_lens = v.choice.kind != CameraChoice::Kind::map && !v.cameras.is_on_path;
    if (!has_lens)
        return ImGui::TextDisabled("%s",
                                   v.cameras.is_on_path ? "the path has its lenses" : "a map has no lens");
    auto degrees = v.camera.vertical_fov / k_radians;
    ImGui::SetNextItemWidth(120 * scale);
    if (ImGui::SliderFloat("##lens", &degrees, static_cast<float>(k_narrowest), static_cast<float>(k_widest),
                           "%.0f deg", ImGuiSliderFlags_AlwaysClamp)) {
        v.cameras.fov = fov_of(std::round(static_cast<double>(degrees)));
        if (!is_gliding(v.cameras.glide)) v.camera.vertical_fov = v.cameras.fov;
    }
    tip("the lens: from the lower border of the picture to the upper one ([ and ])");
    ImGui::SameLine();
    if (ImGui::Button("Usual")) v.cameras.fov = 0;
    tip("32 degrees, or what the one who is followed needs");
}

void lay_out_bookmarks(Show& show, Viewer& v, float scale) {
    std::span<const Action> actions = bookmark_actions();  // keep 1, go to 1, keep 2...
    bool has_any = false;
    for (size_t i = 0; i < k_bookmarks; ++i) {
        std::optional<Bookmark>& bookmark = v.cameras.bookmarks[i];
        if (!bookmark) continue;
        has_any = true;
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button(std::to_string(i + 1).c_str())) actions[2 * i + 1].act(show, v);
        tip(actions[2 * i + 1].keys);
        ImGui::SameLine();
        ImGui::SetNextItemWidth(120 * scale);
        ImGui::InputText("##name", bookmark->name, sizeof bookmark->name);
        ImGui::SameLine();
        if (ImGui::Button("x")) bookmark.reset();
        tip("forget it");
        ImGui::PopID();
    }
    if (!has_any) ImGui::TextDisabled("Ctrl+1 to 9 keep one, Alt+1 to 9 go back");
    const auto& all = v.cameras.bookmarks;
    const auto free = static_cast<size_t>(
        std::find_if(all.begin(), all.end(), [](const auto& b) { return !b.has_value(); }) - all.begin());
    if (free == k_bookmarks) return;
    if (ImGui::Button("Keep this camera")) actions[2 * free].act(show, v);
    tip(actions[2 * free].keys);
}

void save_path(Viewer& v) {
    const std::string file = v.cameras.path_file;
    const Result<void> kept = write_file(file, path_text(v.cameras.path));
    tell(v, kept ? "Wrote " + file + ": flaneur render --camera-path " + file +
                       " --out way.mp4 films it, with the options of this scene."
                 : kept.error().message);
}

void open_path(Viewer& v) {
    Result<CameraPath> path = load_path(v.cameras.path_file);
    if (!path) return tell(v, path.error().message);
    v.cameras.path = std::move(*path);
    if (v.cameras.is_on_path) take_off(v);
    v.cameras.path_time = 0;
    tell(v, std::string("Opened ") + v.cameras.path_file + ".");
}

// Its time, whither one goes to look, what replaces it and what takes it away.
void lay_out_key(Viewer& v, size_t i, float scale) {
    std::vector<CameraKey>& keys = v.cameras.path.keys;
    CameraKey& key = keys[i];
    constexpr double k_gap = 0.1;  // seconds between keys at least
    ImGui::PushID(static_cast<int>(i));
    auto time = static_cast<float>(key.time);
    ImGui::SetNextItemWidth(64 * scale);
    if (ImGui::DragFloat("##time", &time, 0.05f, 0, 0, "%.1f s")) {
        const double least = i > 0 ? keys[i - 1].time + k_gap : 0;
        const double most = i + 1 < keys.size() ? keys[i + 1].time - k_gap : k_longest_path;
        key.time = std::clamp(std::round(static_cast<double>(time) * 20) / 20, least, std::max(least, most));
    }
    tip("when: drag it, or Ctrl+click to type");
    ImGui::SameLine();
    if (ImGui::Button("Go")) show_path(v, key.time - keys.front().time, false);
    tip("look from this key");
    ImGui::SameLine();
    if (ImGui::Button("Here")) {
        const CameraKey here = key_of(v.camera, key.time);
        key = here;
    }
    tip("the key is where the camera is now");
    ImGui::SameLine();
    const bool is_gone = ImGui::Button("x");
    tip("take the key away");
    if (is_gone) {
        keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(i));
        if (keys.empty() && v.cameras.is_on_path) take_off(v);
    }
    ImGui::PopID();
}

void lay_out_path(Show& show, Viewer& v, float scale) {
    Cameras& c = v.cameras;
    if (ImGui::Button("Keep a key here")) add_key(v);
    tip("the path goes through it");
    for (size_t i = 0; i < c.path.keys.size(); ++i) lay_out_key(v, i, scale);
    if (!c.path.keys.empty()) {
        const Action& play = *action_named("Camera path: play, or stop");
        if (ImGui::Button(c.is_playing ? "Stop" : "Play")) play.act(show, v);
        ImGui::SameLine();
        auto time = static_cast<float>(c.path_time);
        ImGui::SetNextItemWidth(140 * scale);
        char format[48];
        std::snprintf(format, sizeof format, "%%.1f of %.1f s", duration(c.path));
        if (ImGui::SliderFloat("##at", &time, 0, static_cast<float>(duration(c.path)), format,
                               ImGuiSliderFlags_AlwaysClamp))
            show_path(v, static_cast<double>(time), false);
        tip("drag to see the path at that moment");
    }
    ImGui::SetNextItemWidth(-1);
    ImGui::InputText("##file", c.path_file, sizeof c.path_file);
    tip("the path's file, JSON");
    if (!c.path.keys.empty()) {
        if (ImGui::Button("Save")) save_path(v);
        ImGui::SameLine();
    }
    if (ImGui::Button("Open")) open_path(v);
}

void heading(const char* what) {
    ImGui::Spacing();
    ImGui::TextDisabled("%s", what);
    ImGui::Separator();
}

}  // namespace

void lay_out_cameras(Show& show, Viewer& v, float scale) {
    lay_out_modes(show, v, scale);
    heading("Lens");
    lay_out_lens(v, scale);
    heading("Bookmarks");
    lay_out_bookmarks(show, v, scale);
    heading("Path");
    lay_out_path(show, v, scale);
}

void mark_path(const Viewer& v, Show& show, FrameInput& frame) {
    const Cameras& c = v.cameras;
    if (v.room != Room::cameras || c.is_on_path || c.path.keys.empty()) return;
    constexpr double k_piece = 0.15;  // seconds
    constexpr uint32_t k_most_pieces = 2000;
    constexpr float k_out_of_sight = 1.5f;  // metres from the eye, where lines would lie across the picture
    constexpr uint32_t k_way = ink(0xf0b45a, 0.9f);
    Pen pen{.place = GizmoPlace::in_world};
    pen.pixels = 2.5f, pen.colour = k_way;
    std::vector<GizmoLine>& lines = show.overlay.lines;
    const auto pieces = std::min(static_cast<uint32_t>(duration(c.path) / k_piece) + 1, k_most_pieces);
    glm::vec3 last = camera_at(c.path, 0).eye;
    for (uint32_t i = 1; i <= pieces; ++i) {
        const glm::vec3 next = camera_at(c.path, duration(c.path) * i / pieces).eye;
        if (glm::length(next - v.camera.eye) > k_out_of_sight) add_line(lines, pen, last, next);
        last = next;
    }
    for (const CameraKey& key : c.path.keys) {
        const glm::vec3 eye(key.eye.x, key.eye.y, key.eye.z), to(key.target.x, key.target.y, key.target.z);
        if (glm::length(eye - v.camera.eye) < k_out_of_sight) continue;
        add_arrow(lines, pen, eye, eye + 1.2f * glm::normalize(to - eye), {0, 1, 0});
    }
    frame.lines = lines;
}

}  // namespace flaneur
