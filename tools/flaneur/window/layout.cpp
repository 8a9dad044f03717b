#include "tools/flaneur/window/layout.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr float k_between = 1.0f / 3;                       // of the window's width, at most
constexpr float k_least_between = 260;                      // that are worth it, at scale 1
constexpr float k_small_width = 500, k_small_height = 360;  // of a window, at scale 1

bool is_shown(const PanelWish& wish, SidePanel side) { return wish.is_shown[static_cast<size_t>(side)]; }
glm::vec2 whole(const PanelWish& wish, SidePanel side) {
    return is_shown(wish, side) ? wish.whole[static_cast<size_t>(side)] : glm::vec2(0);
}
constexpr SidePanel k_right[] = {SidePanel::figures, SidePanel::card, SidePanel::legend};

// All that lies on the right, one below the other.
glm::vec2 right_column(const PanelWish& wish, float edge) {
    glm::vec2 column(0);
    for (const SidePanel side : k_right) {
        if (!is_shown(wish, side)) continue;
        const glm::vec2 size = whole(wish, side);
        column = {std::max(column.x, size.x), column.y + size.y + (column.y > 0 ? edge : 0)};
    }
    return column;
}

// Whether what tells fits beside a note in the middle.
bool is_beside_note(const PanelWish& wish, float width, float edge) {
    return wish.note.x == 0 || (wish.window.x - wish.note.x) / 2 >= width + 2 * edge;
}

PanelPlan plan(const PanelWish& wish) {
    PanelPlan p;
    const glm::vec2 points = wish.window / wish.scale;
    const bool is_small = points.x < k_small_width || points.y < k_small_height;
    p.edge = (is_small ? 5.0f : k_edge) * wish.scale;
    p.bar_rows = is_small ? 1 : 2;
    p.timeline_top = wish.window.y - p.edge - k_timeline * wish.scale;
    p.row_foot = p.timeline_top - p.edge;
    const bool has_sides = std::find(wish.is_shown.begin(), wish.is_shown.end(), true) != wish.is_shown.end();
    const bool is_told = !is_small || !has_sides;
    p.has_state = is_told && is_beside_note(wish, wish.state.x, p.edge);
    p.has_map = is_told && wish.map.x > 0 && is_beside_note(wish, wish.map.x, p.edge);
    if (p.has_map && wish.state.x + wish.map.x + 3 * p.edge > wish.window.x) p.has_state = false;
    auto over = [&](float row) { return row > 0 ? p.row_foot - row - p.edge : p.row_foot; };
    const float row = is_told ? std::max(k_state * wish.scale, wish.map.y) : 0;
    const float foot = over(std::max(row, wish.note.y));

    const glm::vec2 left = whole(wish, SidePanel::room), right = right_column(wish, p.edge);
    const float wide = wish.window.x - 2 * p.edge;
    const float columns = left.x + right.x + (left.x > 0 && right.x > 0 ? p.edge : 0);
    // What is filmed is told in the middle, if both columns leave it room, and else above them.
    float top = wish.bar_foot + p.edge;
    p.film_top = top;
    const float middle = wish.window.x / 2 - p.edge - wish.film.x / 2;
    const bool is_film_above = wish.film.x > 0 && std::max(left.x, right.x) + p.edge > middle;
    const float film = is_film_above ? wish.film.y + p.edge : 0;
    top += film;
    const bool is_shared =
        wish.is_between && std::count(wish.is_shown.begin(), wish.is_shown.end(), true) > 1;
    // A note, which comes and goes, changes nothing.
    p.has_tabs = is_shared || columns > wide || right.y > over(row) - top;
    if (p.has_tabs) p.film_top = wish.tabs_foot + p.edge, top = p.film_top + film;

    const float high = std::max(foot - top, 1.0f);
    float down = top;
    for (size_t i = 0; i < k_sides; ++i) {
        const auto side = static_cast<SidePanel>(i);
        PanelPlace& place = p.sides[i];
        place.is_there = wish.is_shown[i] && (!p.has_tabs || side == wish.chosen);
        place.at = {p.edge, top};
        place.most = {wide, high};
        if (wish.is_between) {
            place.at.x = wish.window.x / 2, place.pivot.x = 0.5f;
            place.most.x = k_between * wish.window.x;
            continue;
        }
        if (p.has_tabs || side == SidePanel::room) continue;
        const bool is_lowest = side == SidePanel::legend;
        place.at = {wish.window.x - p.edge, is_lowest ? foot : down};
        place.pivot = {1, is_lowest ? 1 : 0};
        place.most.y = std::max(foot - down, 1.0f);
        if (wish.is_shown[i]) down += wish.whole[i].y + p.edge;
    }
    return p;
}

}  // namespace

PanelPlan plan_panels(const PanelWish& wish) {
    const PanelPlan whole = plan(wish);
    if (!whole.has_tabs || !wish.is_glimpse) return whole;
    PanelWish less = wish;
    less.is_shown[static_cast<size_t>(SidePanel::card)] = false;
    return plan(less);
}

float most_scale(glm::vec2 window) {
    constexpr glm::vec2 k_least{320, 240};
    const glm::vec2 times = window / k_least;
    return std::max(std::floor(std::min(times.x, times.y) * 4) / 4, 1.0f);
}

void plan_picture(Viewer& v, glm::vec2 window, float scale, const std::array<bool, k_sides>& shown,
                  bool is_glimpse) {
    PanelLayout& layout = v.layout;
    PanelWish& wish = layout.wish;
    const std::array<bool, k_sides> before = std::exchange(wish.is_shown, shown);
    wish.is_between = v.techniques.is_split && k_between * window.x >= k_least_between * scale;
    const bool is_other_room = std::exchange(layout.room, static_cast<uint8_t>(v.room)) != layout.room;
    for (size_t i = 0; i < k_sides; ++i) {
        const bool is_new = !before[i] || (i == 0 && is_other_room);
        if (!shown[i] || is_new || scale != wish.scale) wish.whole[i] = {};
        const bool was_glimpse = i == static_cast<size_t>(SidePanel::card) && wish.is_glimpse;
        const bool is_mere = i == static_cast<size_t>(SidePanel::card) && is_glimpse;
        const bool gives_way = is_mere || (wish.is_between && i > 0 && shown[0]);
        if (shown[i] && (is_new || was_glimpse) && !gives_way) wish.chosen = static_cast<SidePanel>(i);
    }
    if (!shown[static_cast<size_t>(wish.chosen)]) {
        const auto first = std::find(shown.begin(), shown.end(), true);
        if (first != shown.end()) wish.chosen = static_cast<SidePanel>(first - shown.begin());
    }
    wish.window = window, wish.scale = scale, wish.is_glimpse = is_glimpse;
    layout.plan = plan_panels(wish);
}

float width_in(const Viewer& v, SidePanel side, float pixels) {
    const float most = v.layout.plan.sides[static_cast<size_t>(side)].most.x;
    const ImGuiStyle& style = ImGui::GetStyle();
    return std::min(fitted(pixels, v.layout.wish.scale),
                    most - 3 * style.WindowPadding.x - style.ScrollbarSize);
}

bool begin_side(Viewer& v, SidePanel side, const char* name, bool* is_open, int flags) {
    const PanelPlan& plan = v.layout.plan;
    const PanelPlace& place = plan.sides[static_cast<size_t>(side)];
    if (!place.is_there) return false;
    ImGui::SetNextWindowPos({place.at.x, place.at.y}, ImGuiCond_Always, {place.pivot.x, place.pivot.y});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {place.most.x, place.most.y});
    // A tab has its name.
    if (plan.has_tabs) flags |= ImGuiWindowFlags_NoTitleBar;
    flags &= ~ImGuiWindowFlags_NoScrollbar;
    ImGui::Begin(name, is_open, flags | ImGuiWindowFlags_HorizontalScrollbar);
    return true;
}

void end_side(Viewer& v, SidePanel side) {
    const ImVec2 size = ImGui::GetWindowSize();
    v.layout.wish.whole[static_cast<size_t>(side)] = {size.x + ImGui::GetScrollMaxX(),
                                                      size.y + ImGui::GetScrollMaxY()};
    ImGui::End();
}

}  // namespace flaneur
