#include "tools/flaneur/window/actions.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tools/flaneur/view/camera.h"
#include "tools/flaneur/window/cameras/cameras.h"
#include "tools/flaneur/window/cameras/map.h"
#include "tools/flaneur/window/panels.h"

namespace flaneur {
namespace {

using enum CameraChoice::Kind;

// Says so where it cannot.
bool is_city(const Show& show, Viewer& v) {
    if (show.loaded.world->roam) tell(v, "That is for cities: here up is not one way.");
    return !show.loaded.world->roam;
}

template <CameraChoice::Kind To>
void look(Show& show, Viewer& v) {
    if (To == overview || To == follow || is_city(show, v)) choose(v, To);
}

void look_down(Show& show, Viewer& v) {
    if (is_city(show, v)) look_at_map(show, v);
}

// Who was asked about, or is pointed at, or gone along with.
std::optional<uint32_t> somebody(const Show& show, const Viewer& v) {
    std::optional<uint32_t> who = v.selected ? v.selected : v.hovered;
    if (!who && goes_along(v.choice.kind)) who = v.choice.walker;
    const Crowd& crowd = show.loaded.world->crowd;
    return who && *who < crowd.count && is_there(crowd, *who) ? who : std::nullopt;
}

// The same; or else whoever is there from `first` on.
std::optional<uint32_t> somebody_or(const Show& show, const Viewer& v, uint32_t first) {
    if (const auto who = somebody(show, v)) return who;
    const Crowd& crowd = show.loaded.world->crowd;
    for (uint32_t i = 0; i < crowd.count; ++i)
        if (const uint32_t who = (first + i) % crowd.count; is_there(crowd, who)) return who;
    return {};
}

template <CameraChoice::Kind To>
void go_along(Show& show, Viewer& v) {
    const auto who = somebody_or(show, v, v.choice.walker);
    if (!who) return tell(v, "There is nobody.");
    if (To == eyes && !is_city(show, v)) return;
    v.choice.walker = *who;
    look<To>(show, v);
}

// In the same way, somebody else.
void go_along_with_next(Show& show, Viewer& v) {
    const bool is_going = goes_along(v.choice.kind);
    if (!is_going) return go_along<follow>(show, v);
    const World& world = *show.loaded.world;
    const uint32_t count = followed_count(world);
    for (uint32_t i = 1; i <= count; ++i) {
        const uint32_t who = (v.choice.walker + i) % count;
        if (who < world.crowd.count && !is_there(world.crowd, who)) continue;
        v.choice.walker = who;
        return choose(v, v.choice.kind);
    }
}

void follow_asked(Show& show, Viewer& v) {
    if (!v.selected && !v.hovered) return tell(v, "Click somebody, or point at them, to follow them.");
    go_along<follow>(show, v);
}

void frame_asked(Show& show, Viewer& v) {
    constexpr float k_map_across = 40;  // metres
    const auto who = somebody(show, v);
    if (!who) return tell(v, "Click somebody, or point at them, to look at them.");
    const World& world = *show.loaded.world;
    if (!is_city(show, v)) return;
    const Vec3 feet = world.crowd.motion.position[*who];
    if (v.choice.kind == map) {
        CameraChoice there = v.choice;
        there.middle = on_ground(feet);
        there.across = std::min(there.across, k_map_across);
        return choose(v, there);
    }
    const float height =
        world.kinds[world.crowd.identity.body[*who]].body.height * world.crowd.identity.scale[*who];
    const glm::vec3 eye = v.camera.eye;
    const CameraKey key = key_of(framing_camera(world, feet, height, {eye.x, eye.y, eye.z}, lens_of(v)), 0);
    choose(v, CameraChoice{fixed, *who, key.eye, key.target});
}

void north_up(Show&, Viewer& v) {
    if (v.choice.kind != map) return tell(v, "That is for the map: 5.");
    CameraChoice turned = v.choice;
    turned.bearing = 0;
    choose(v, turned);
}

template <int Degrees>
void change_lens(Show&, Viewer& v) {
    if (v.choice.kind == map) return tell(v, "A map has no lens: the wheel makes it larger.");
    const double now = std::round(static_cast<double>(lens_of(v) / k_radians));
    v.cameras.fov = fov_of(std::clamp(now + Degrees, k_narrowest, k_widest));
    tell(v, "Field of view: " + told_fov(v.cameras.fov) + " degrees upright.");
}

template <size_t Number>
void keep_bookmark(Show&, Viewer& v) {
    static_assert(Number >= 1 && Number <= k_bookmarks);
    std::optional<Bookmark>& bookmark = v.cameras.bookmarks[Number - 1];
    Bookmark kept{kept_choice(v), v.cameras.fov, {}};
    const char* what = kept.choice.kind == follow ? "behind no. %u"
                       : kept.choice.kind == eyes ? "the eyes of no. %u"
                       : kept.choice.kind == map  ? "a map"
                                                  : "a place";
    std::snprintf(kept.name, sizeof kept.name, what, kept.choice.walker);
    if (bookmark && bookmark->choice.kind == kept.choice.kind)  // its own name stays
        std::copy(std::begin(bookmark->name), std::end(bookmark->name), std::begin(kept.name));
    bookmark = kept;
    tell(v, "Kept as bookmark " + std::to_string(Number) + ": Alt+" + std::to_string(Number) +
                " goes back there.");
}

template <size_t Number>
void go_to_bookmark(Show&, Viewer& v) {
    const std::optional<Bookmark>& bookmark = v.cameras.bookmarks[Number - 1];
    const std::string number = std::to_string(Number);
    if (!bookmark) return tell(v, "There is no bookmark " + number + ": Ctrl+" + number + " keeps one.");
    v.cameras.fov = bookmark->fov;
    choose(v, bookmark->choice);
}

void play(Show&, Viewer& v) {
    const Cameras& c = v.cameras;
    if (c.is_on_path && c.is_playing) return show_path(v, c.path_time, false);
    const bool is_over = c.path_time >= duration(c.path);
    show_path(v, is_over ? 0 : c.path_time, true);
}

constexpr std::array k_actions = {
    Action{"Look down the street", "1", GLFW_KEY_1, 0, look<street>},
    Action{"Look from above", "2", GLFW_KEY_2, 0, look<overview>},
    Action{"Look at the densest crowd", "", 0, 0, look<crowd>},
    Action{"Follow somebody", "3", GLFW_KEY_3, 0, go_along<follow>},
    Action{"Look through somebody's eyes", "4", GLFW_KEY_4, 0, go_along<eyes>},
    Action{"The next one", "Tab", GLFW_KEY_TAB, 0, go_along_with_next},
    Action{"Map: all of the city, or where one was", "5", GLFW_KEY_5, 0, look_down},
    Action{"Map: north up", "", 0, 0, north_up},
    Action{"Walk on foot, or lift off", "G", GLFW_KEY_G, 0, [](Show& show, Viewer& v) { set_foot(show, v); }},
    Action{"Look at who was asked about", "F", GLFW_KEY_F, 0, frame_asked},
    Action{"Follow who was asked about", "Shift+F", GLFW_KEY_F, GLFW_MOD_SHIFT, follow_asked},
    Action{"Narrower lens", "[", GLFW_KEY_LEFT_BRACKET, 0, change_lens<-2>, true},
    Action{"Wider lens", "]", GLFW_KEY_RIGHT_BRACKET, 0, change_lens<2>, true},
    Action{"The usual lens", "", 0, 0, [](Show&, Viewer& v) { v.cameras.fov = 0; }},
    Action{"Cameras: modes, lens, bookmarks, path", "", 0, 0,
           [](Show&, Viewer& v) { v.room = v.room == Room::cameras ? Room::none : Room::cameras; }},
    Action{"Camera path: keep a key here", "", 0, 0, [](Show&, Viewer& v) { add_key(v); }},
    Action{"Camera path: play, or stop", "", 0, 0, play},
};

template <size_t Number>
constexpr Action keeping(const char* name, const char* keys) {
    return {name, keys, GLFW_KEY_0 + static_cast<int>(Number), GLFW_MOD_CONTROL, keep_bookmark<Number>};
}
template <size_t Number>
constexpr Action going(const char* name, const char* keys) {
    return {name, keys, GLFW_KEY_0 + static_cast<int>(Number), GLFW_MOD_ALT, go_to_bookmark<Number>};
}
constexpr std::array k_bookmark_actions = {
    keeping<1>("Keep this camera as 1", "Ctrl+1"), going<1>("Back to camera 1", "Alt+1"),
    keeping<2>("Keep this camera as 2", "Ctrl+2"), going<2>("Back to camera 2", "Alt+2"),
    keeping<3>("Keep this camera as 3", "Ctrl+3"), going<3>("Back to camera 3", "Alt+3"),
    keeping<4>("Keep this camera as 4", "Ctrl+4"), going<4>("Back to camera 4", "Alt+4"),
    keeping<5>("Keep this camera as 5", "Ctrl+5"), going<5>("Back to camera 5", "Alt+5"),
    keeping<6>("Keep this camera as 6", "Ctrl+6"), going<6>("Back to camera 6", "Alt+6"),
    keeping<7>("Keep this camera as 7", "Ctrl+7"), going<7>("Back to camera 7", "Alt+7"),
    keeping<8>("Keep this camera as 8", "Ctrl+8"), going<8>("Back to camera 8", "Alt+8"),
    keeping<9>("Keep this camera as 9", "Ctrl+9"), going<9>("Back to camera 9", "Alt+9"),
};

}  // namespace

std::span<const Action> camera_actions() { return k_actions; }
std::span<const Action> bookmark_actions() { return k_bookmark_actions; }

}  // namespace flaneur
