#include "tools/flaneur/window/measure/drawing.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "renderer/view.h"
#include "tools/flaneur/window/ask/ask.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/pick.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {
namespace {

constexpr double k_again_seconds = 0.4;                  // between the clicks of a double one
constexpr float k_again_pixels = 8, k_grip_pixels = 10;  // how near to what one points at
constexpr size_t k_most_steps = 200;                     // to go back

size_t least_points(MarkingKind kind) { return is_closed(kind) ? 3 : 2; }

// Where places are seen, pixels; none behind the eye.
struct Projection {
    glm::mat4 clip_from_world;
    Size size;

    Projection(const Camera& camera, Size of)
        : clip_from_world(make_view(camera, static_cast<uint32_t>(std::max(of.width, 1)),
                                    static_cast<uint32_t>(std::max(of.height, 1)))
                              .clip_from_world),
          size(of) {}
    std::optional<glm::vec2> pixel(glm::vec3 place) const {
        const glm::vec4 at = clip_from_world * glm::vec4(place, 1);
        if (at.w <= 0.05f) return {};
        return glm::vec2((at.x / at.w * 0.5f + 0.5f) * static_cast<float>(size.width),
                         (at.y / at.w * 0.5f + 0.5f) * static_cast<float>(size.height));
    }
};

// To a millimetre on the map: nobody clicks better, and numbers are short.
glm::vec3 rounded(glm::vec3 p) { return {std::round(p.x * 1000) / 1000, p.y, std::round(p.z * 1000) / 1000}; }

float distance_to(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
    const glm::vec2 way = b - a;
    const float share = std::clamp(glm::dot(p - a, way) / std::max(glm::dot(way, way), 1e-9f), 0.0f, 1.0f);
    return glm::length(a + way * share - p);
}

// What is drawn within reach of a pixel, the nearest.
std::optional<size_t> drawn_at(const MeasureRoom& room, const Projection& seen, glm::vec2 pixel) {
    std::optional<size_t> nearest;
    float least = k_grip_pixels;
    for (size_t i = 0; i < room.outlines.size() && i < room.drawn.size(); ++i)
        for (size_t k = 1; k < room.outlines[i].size(); ++k) {
            const auto a = seen.pixel(room.outlines[i][k - 1]), b = seen.pixel(room.outlines[i][k]);
            if (!a || !b) continue;
            if (const float away = distance_to(pixel, *a, *b); away < least) least = away, nearest = i;
        }
    return nearest;
}

std::optional<size_t> handle_at(const Marking& drawn, const Projection& seen, glm::vec2 pixel) {
    std::optional<size_t> nearest;
    float least = k_grip_pixels;
    for (size_t i = 0; i < drawn.points.size(); ++i)
        if (const auto at = seen.pixel(drawn.points[i]))
            if (const float away = glm::length(*at - pixel); away < least) least = away, nearest = i;
    return nearest;
}

std::string new_name(const std::vector<Marking>& drawn, MarkingKind kind) {
    for (int number = 1;; ++number) {
        std::string name(1, k_drawn_names[static_cast<size_t>(kind)][0]);
        name.append(std::to_string(number));
        auto is_called = [&](const Marking& one) { return one.name == name; };
        if (std::none_of(drawn.begin(), drawn.end(), is_called)) return name;
    }
}

void change_to(std::vector<Marking> drawn, const Show& show, Viewer& v) {
    MeasureRoom& room = v.measure;
    room.drawn = std::move(drawn);
    if (room.selected && *room.selected >= room.drawn.size()) room.selected.reset();
    room.hovered.reset(), room.handle.reset();
    count_drawn(show, v);
}

// What was drawn last in `from` is what is drawn now, and that goes to `to`.
void go_to_last(std::vector<DrawnBefore>& from, std::vector<DrawnBefore>& to, const Show& show, Viewer& v) {
    to.push_back({v.measure.drawn, from.back().deed});
    std::vector<Marking> drawn = std::move(from.back().drawn);
    from.pop_back();
    change_to(std::move(drawn), show, v);
}

void add_point(const Show& show, const Projection& seen, glm::vec3 place, glm::vec2 pixel, Viewer& v) {
    MeasureRoom& room = v.measure;
    const double now = glfwGetTime();
    const bool is_again =
        now - room.clicked_at < k_again_seconds && glm::length(pixel - room.clicked) < k_again_pixels;
    room.clicked_at = now, room.clicked = pixel;
    if (is_again && room.draft.size() >= least_points(*room.tool)) return finish_draft(show, v);
    if (is_again && !room.draft.empty()) return;
    if (is_closed(*room.tool) && room.draft.size() >= least_points(*room.tool))
        if (const auto first = seen.pixel(room.draft[0]);
            first && glm::length(*first - pixel) < k_grip_pixels)
            return finish_draft(show, v);
    room.draft.push_back(place);
    if (*room.tool == MarkingKind::line && room.draft.size() == 2) finish_draft(show, v);
}

void drag(const Show& show, const Mouse& now, glm::vec3 place, Viewer& v) {
    MeasureRoom& room = v.measure;
    if (now.is_held) {
        room.drawn[*room.selected].points[*room.handle] = place;
        room.outlines.clear();
        return;
    }
    room.is_dragging = false;
    // Where that makes no zone, it goes back.
    const Marking& drawn = room.drawn[*room.selected];
    if (is_closed(drawn.kind) && !is_simple(on_map(drawn.points))) {
        tell(v, drawn.name + " would cross itself: it is as it was.");
        room.drawn = std::move(room.before.back().drawn);
        room.before.pop_back();
        room.outlines.clear();
        return;
    }
    count_drawn(show, v);
}

}  // namespace

Length length_of(const std::vector<glm::vec3>& points, bool is_closed) {
    Length length;
    for (size_t i = 1; i < points.size() + (is_closed ? 1 : 0); ++i) {
        const glm::vec3 way = points[i % points.size()] - points[i - 1];
        length.along += static_cast<double>(glm::length(way));
        length.flat += static_cast<double>(std::hypot(way.x, way.z));
    }
    return length;
}

std::vector<Vec2> on_map(const std::vector<glm::vec3>& points) {
    std::vector<Vec2> flat;
    flat.reserve(points.size());
    for (const glm::vec3& p : points) flat.push_back({p.x, p.z});
    return flat;
}

MeasurePlan plan_of(const std::vector<Marking>& drawn) {
    MeasurePlan plan;
    for (const Marking& one : drawn) {
        const std::vector<Vec2> flat = on_map(one.points);
        if (one.kind == MarkingKind::line) plan.lines.push_back({one.name, flat[0], flat[1]});
        if (one.kind == MarkingKind::zone) plan.zones.push_back({one.name, flat});
    }
    return plan;
}

const char* compass(const CountLine& line, int side) {
    constexpr const char* k_ways[] = {"N", "NE", "E", "SE", "S", "SW", "W", "NW"};
    // To the right of who looks to the east is the south, which is +z.
    const Vec2 way = line.b - line.a, to = Vec2{-way.z, way.x} * static_cast<float>(side);
    const float turn = std::atan2(to.x, -to.z) / glm::quarter_pi<float>();
    return k_ways[(std::lround(turn) + 8) % 8];
}

void remember(Viewer& v) {
    MeasureRoom& room = v.measure;
    room.before.push_back({room.drawn, ++v.deeds});
    if (room.before.size() > k_most_steps) room.before.erase(room.before.begin());
    room.after.clear();
}

void count_drawn(const Show& show, Viewer& v) {
    const World& world = *show.loaded.world;
    set_plan(v.measure.counts, plan_of(v.measure.drawn), world.tick);
    count_people(v.measure.counts, world);
    v.measure.outlines.clear();
}

void count_anew(const Show& show, Viewer& v) {
    begin_anew(v.measure.counts, show.loaded.world->tick);
    if (v.time.beside) begin_anew(v.time.beside->counts, v.time.beside->world->tick);
}

void take_tool(MarkingKind kind, Viewer& v) {
    MeasureRoom& room = v.measure;
    v.room = Room::measure;
    room.draft.clear();
    room.selected.reset();
    room.tool = kind;
}

void finish_draft(const Show& show, Viewer& v) {
    MeasureRoom& room = v.measure;
    if (!room.tool) return;
    const MarkingKind kind = *room.tool;
    if (room.draft.size() < least_points(kind))
        return tell(v,
                    is_closed(kind) ? "It takes three corners and more." : "It takes two points and more.");
    const std::vector<Vec2> flat = on_map(room.draft);
    if (is_closed(kind) && (!is_simple(flat) || area_of(flat) < static_cast<double>(k_least_zone)))
        return tell(v, "Its outline crosses itself: Ctrl+Z takes the last corner back.");
    if (kind == MarkingKind::line && length_of(CountLine{"", flat[0], flat[1]}) < k_least_line) {
        room.draft.pop_back();
        return tell(v, "A line of less than 5 cm counts nobody: click farther off.");
    }
    remember(v);
    room.drawn.push_back({kind, new_name(room.drawn, kind), std::exchange(room.draft, {})});
    room.selected = room.drawn.size() - 1;
    room.tool.reset();
    count_drawn(show, v);
}

void undo_drawing(const Show& show, Viewer& v) {
    MeasureRoom& room = v.measure;
    if (!room.draft.empty()) return room.draft.pop_back();
    if (room.before.empty()) return tell(v, "There is nothing drawn to go back to.");
    go_to_last(room.before, room.after, show, v);
    tell(v, "What was drawn last is undone; Ctrl+Y does it again.");
}

void redo_drawing(const Show& show, Viewer& v) {
    if (!v.measure.after.empty()) go_to_last(v.measure.after, v.measure.before, show, v);
}

void remove_selected(const Show& show, Viewer& v) {
    MeasureRoom& room = v.measure;
    if (!room.selected) return;
    remember(v);
    std::vector<Marking> drawn = room.drawn;
    drawn.erase(drawn.begin() + static_cast<std::ptrdiff_t>(*room.selected));
    room.selected.reset();
    change_to(std::move(drawn), show, v);
}

bool abandon_drawing(Viewer& v) {
    MeasureRoom& room = v.measure;
    if (v.room != Room::measure) return false;
    if (!room.draft.empty()) return room.draft.clear(), true;
    if (room.tool) return room.tool.reset(), true;
    if (room.selected) return room.selected.reset(), true;
    return false;
}

bool draw_with_mouse(const Show& show, const Mouse& before, const Mouse& now, Size size, bool is_panels,
                     Viewer& v) {
    MeasureRoom& room = v.measure;
    room.under.reset();
    if (!room.is_dragging) room.handle.reset();
    if (!is_panels) room.hovered.reset();
    if (v.room != Room::measure || show.loaded.world->roam) return room.is_dragging = false;
    if (is_panels && !room.is_dragging) return false;
    const glm::vec2 pixel(static_cast<float>(now.x), static_cast<float>(now.y));
    if (room.is_dragging && !(room.selected && room.handle)) {  // let go of by a key meanwhile
        room.is_dragging = false;
        count_drawn(show, v);
    }
    if (room.is_dragging || room.tool)
        room.under = rounded(place_under(show, v, ray_through(v.camera, size, pixel)));
    if (room.is_dragging) {
        drag(show, now, *room.under, v);
        return true;
    }
    if (room.tool) {
        if (now.has_clicked) add_point(show, Projection(v.camera, size), *room.under, pixel, v);
        return now.has_clicked;
    }
    const Projection seen(v.camera, size);
    if (room.selected) room.handle = handle_at(room.drawn[*room.selected], seen, pixel);
    if (room.handle && now.is_held && !before.is_held) {
        remember(v);
        return room.is_dragging = true;
    }
    room.hovered = drawn_at(room, seen, pixel);
    if (!now.has_clicked) return false;
    if (room.handle) return true;
    room.selected = room.hovered;
    return room.selected.has_value();
}

}  // namespace flaneur
