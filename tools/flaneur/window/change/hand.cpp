#include "tools/flaneur/window/change/hand.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/stepping.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/platform.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/pick.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

namespace {

constexpr float k_beside = 0.35f;  // metres: next to something
constexpr float k_above = 0.05f;   // metres, of lines over the ground
constexpr const char* k_square = "square";
constexpr uint32_t k_new = ink(0x9dd977), k_chosen = ink(0x58c4d2), k_there = ink(0xffffff, 0.5f),
                   k_closed = ink(0xe2604a);

// The ground under a way from the eye, or at the foot of the wall that it meets.
std::optional<Vec3> ground_along(const World& world, const Camera& camera, glm::vec3 way) {
    const Vec3 eye{camera.eye.x, camera.eye.y, camera.eye.z}, ahead{way.x, way.y, way.z};
    const auto hit = raycast(*world.ground, eye, ahead, k_far_sight);
    if (!hit) return std::nullopt;
    Vec3 place = eye + ahead * hit->distance;
    if (hit->what == RayHit::What::ground) return place;
    const float side = dot(hit->normal, ahead) > 0 ? -1.0f : 1.0f;
    place += hit->normal * (side * 0.5f);
    const auto foot = ground_at(*world.ground, place, 0.5f, 60);
    if (!foot) return std::nullopt;
    return Vec3{place.x, foot->height, place.z};
}

// To a centimetre, so that files are read easily.
Vec3 rounded(Vec3 p) {
    auto to = [](float v) { return std::round(v * 100) / 100; };
    return {to(p.x), to(p.y), to(p.z)};
}

Addition new_one(const Ground& ground, AddedKind kind, Vec3 place) {
    Addition a{kind, rounded(place), {}, 0};
    if (is_turned(kind)) a.turn = usual_turn(ground, place);
    return a;
}

Addition moved(Addition a, Vec3 by) {
    a.at = rounded(a.at + by);
    if (is_drawn_out(a.kind)) a.to = rounded(a.to + by);
    return a;
}

void put_down(const World& world, const Addition& a, Viewer& v) {
    Design next = current(v.change.designs);
    if (next.added.size() >= k_most_added)
        return tell(v, "There is no more room for what is added: 1000 things.");
    if (a.kind == AddedKind::entrance && !entrance_at(*world.ground, a.at))
        return tell(v, "An entrance leads into a house: click within 3 m of its wall.");
    if (is_drawn_out(a.kind) && length(on_ground(a.to - a.at)) > k_longest_added)
        return tell(v, "That is too long: 200 m at most.");
    next.added.push_back(a);
    v.change.selected = next.added.size() - 1;
    want(v, std::move(next));
}

// Puts down a wall or a row of barriers that was drawn out, or one from wall to wall. Where no more than one
// end of it was clicked, what to do next; else null.
const char* end_line(const World& world, Viewer& v) {
    const Addition a = *v.change.ghost;
    if (length(on_ground(a.to - a.at)) >= k_shortest_added) {
        put_down(world, a, v);
        return nullptr;
    }
    if (a.kind == AddedKind::wall || v.change.grip.is_clicked)
        return "Click where it ends, half a metre away or farther.";
    const auto row = closure_at(*world.ground, a.at);
    if (!row) return "There is no street from wall to wall: click where the barrier ends.";
    const size_t before = current(v.change.designs).added.size();
    put_down(world, *row, v);
    if (current(v.change.designs).added.size() == before) return nullptr;
    char told[80];
    std::snprintf(told, sizeof told, "A %s is closed, %.1f m from wall to wall.",
                  crossed_by(*world.ground, *row), static_cast<double>(length(on_ground(row->to - row->at))));
    tell(v, told);
    return nullptr;
}

void end_move(Viewer& v) {
    Change& c = v.change;
    Design next = current(c.designs);
    if (*c.grip.moved >= next.added.size()) return;
    next.added[*c.grip.moved] = *c.ghost;
    want(v, std::move(next));
}

void let_go_of(const World& world, Viewer& v) {
    Change& c = v.change;
    if (c.ghost && c.grip.moved && *c.ghost != c.grip.was) end_move(v);
    if (const char* next = c.ghost && !c.grip.moved ? end_line(world, v) : nullptr) {
        c.grip.is_clicked = true;
        return tell(v, next);
    }
    c.grip = {};
    c.ghost.reset();
}

void hold(Vec3 place, Viewer& v) {
    Change& c = v.change;
    if (c.grip.moved) {
        c.ghost = moved(c.grip.was, place - c.grip.from);
        if (!is_drawn_out(c.ghost->kind)) c.ghost->at.y = rounded(place).y;
    } else if (c.ghost) {
        c.ghost->to = rounded(place);
    }
}

// Whether there is something at `place` to take hold of.
bool take_hold(Vec3 place, Viewer& v) {
    Change& c = v.change;
    const std::vector<Addition>& added = current(c.designs).added;
    if (const auto there = addition_at(added, place)) {
        c.selected = there;
        c.grip = {true, false, there, added[*there], place};
        c.ghost = added[*there];
        return true;
    }
    if (!c.tool || !is_drawn_out(*c.tool)) return false;
    c.grip = {true, false, {}, {}, place};
    c.ghost = Addition{*c.tool, rounded(place), rounded(place), 0};
    return true;
}

Pen pen_of(uint32_t colour, GizmoPlace place) {
    Pen pen{.place = place};
    pen.pixels = 2.5f;
    pen.colour = colour;
    return pen;
}

uint32_t colour_of(const Addition& a) { return is_drawn_out(a.kind) ? k_closed : k_there; }

void add_outline(const World& world, const Addition& a, const Pen& pen, std::vector<GizmoLine>& lines) {
    auto over = [](Vec3 p) { return glm::vec3(p.x, p.y + k_above, p.z); };
    if (is_drawn_out(a.kind)) {
        constexpr float k_half = 0.25f;
        const Vec2 along = normalize_or(on_ground(a.to - a.at), {1, 0});
        const Vec3 side = at_height(Vec2{-along.z, along.x} * k_half, 0);
        const Vec3 corners[] = {a.at + side, a.to + side, a.to - side, a.at - side};
        for (size_t i = 0; i < 4; ++i) add_line(lines, pen, over(corners[i]), over(corners[(i + 1) % 4]));
        return;
    }
    if (a.kind == AddedKind::entrance) {
        const auto wall = entrance_at(*world.ground, a.at);
        const Vec3 foot = wall ? Vec3{wall->point.x, a.at.y, wall->point.z} : a.at;
        add_circle(lines, pen, over(foot), {0, 1, 0}, 0.5f);
        if (wall) add_line(lines, pen, over(foot), over(foot) + glm::vec3(0, 2.1f, 0));
        return;
    }
    const Rectangle area = widened(area_of(a), -0.5f);
    const float radius = (area.high.x - area.low.x) * 0.5f;
    add_circle(lines, pen, over(a.at), {0, 1, 0}, radius);
    const Vec2 ahead = heading_direction(a.turn * k_radians) * (radius + 0.3f);
    add_line(lines, pen, over(a.at), over(a.at + at_height(ahead, 0)));
}

}  // namespace

std::optional<Addition> closure_at(const Ground& ground, Vec3 place) {
    constexpr int k_ways = 36;
    constexpr float k_broadest = 60, k_broad_square = 20, k_eye = 1;  // metres
    // As near to the wall as there is ground.
    auto end_before = [&](Vec2 way, float distance) {
        Vec3 end = place;
        for (float clear = 0.1f; clear < 1; clear += 0.1f) {
            end = place + at_height(way * (distance - clear), 0);
            if (ground_at(ground, end, 3, 3)) break;
        }
        return rounded(end);
    };
    std::optional<Addition> best;
    float least = k_broadest;
    for (int i = 0; i < k_ways; ++i) {
        const Vec2 way = heading_direction(static_cast<float>(i) * (k_pi / k_ways));
        const Vec3 from = place + Vec3{0, k_eye, 0};
        const auto one = raycast(ground, from, at_height(way, 0), k_broadest);
        const auto other = raycast(ground, from, at_height(way * -1, 0), k_broadest);
        if (!one || !other || one->distance + other->distance >= least) continue;
        least = one->distance + other->distance;
        best = Addition{AddedKind::barrier, end_before(way, one->distance),
                        end_before(way * -1, other->distance), 0};
    }
    // Nobody means all of a square by a click in it.
    const bool is_open =
        best && least > k_broad_square && crossed_by(ground, *best) == std::string_view(k_square);
    return is_open ? std::nullopt : best;
}

const char* crossed_by(const Ground& ground, const Addition& row) {
    constexpr float k_apart = 0.5f;  // metres
    bool has_road = false, has_path = false, has_plaza = false, has_steps = false;
    const auto pieces = static_cast<int>(length(on_ground(row.to - row.at)) / k_apart) + 1;
    for (int i = 0; i <= pieces; ++i) {
        const Vec3 place = lerp(row.at, row.to, static_cast<float>(i) / static_cast<float>(pieces));
        const auto under = ground_at(ground, place, 3, 3);
        if (!under) continue;
        const Surface kind = under->kind;
        has_road |= kind == Surface::road || kind == Surface::crossing || kind == Surface::track;
        has_path |= kind == Surface::path || kind == Surface::sidewalk;
        has_plaza |= kind == Surface::plaza;
        has_steps |= kind == Surface::steps;
    }
    return has_road    ? "street"
           : has_steps ? "flight of steps"
           : has_plaza ? k_square
           : has_path  ? "path"
                       : "yard";
}

std::optional<size_t> addition_at(std::span<const Addition> added, Vec3 place) {
    std::optional<size_t> found;
    float least = 1e9f;
    for (size_t i = 0; i < added.size(); ++i) {
        const Addition& a = added[i];
        const Vec2 p = on_ground(place), from = on_ground(a.at);
        const Vec2 to = is_drawn_out(a.kind) ? on_ground(a.to) : from;
        const float share = from == to ? 0 : closest_on(from, to, p);
        const float distance = length(lerp(from, to, share) - p);
        const Rectangle area = widened(area_of(a), -0.5f);
        const float half = is_drawn_out(a.kind)            ? 0.25f
                           : a.kind == AddedKind::entrance ? 0.8f
                                                           : (area.high.x - area.low.x) * 0.5f;
        if (distance > half + k_beside || distance >= least || std::fabs(a.at.y - place.y) > 4) continue;
        least = distance;
        found = i;
    }
    return found;
}

void turn_selected(Viewer& v, float degrees) {
    Design next = current(v.change.designs);
    if (!v.change.selected || *v.change.selected >= next.added.size() ||
        !is_turned(next.added[*v.change.selected].kind))
        return tell(v, "Click something that has been put down, to turn it.");
    float& turn = next.added[*v.change.selected].turn;
    turn = std::round(wrap_angle((turn + degrees) * k_radians) / k_radians);
    want(v, std::move(next));
}

void remove_selected(Viewer& v) {
    Design next = current(v.change.designs);
    if (!v.change.selected || *v.change.selected >= next.added.size())
        return tell(v, "Click something that has been put down, to remove it.");
    next.added.erase(next.added.begin() + static_cast<std::ptrdiff_t>(*v.change.selected));
    v.change.selected.reset();
    want(v, std::move(next));
}

bool take_mouse(const Show& show, const Mouse& before, const Mouse& now, Size size, bool is_panels,
                Viewer& v) {
    Change& c = v.change;
    const World& world = *show.loaded.world;
    if (v.room != Room::change || world.roam || is_on_course(world)) {
        c.grip = {};
        c.ghost.reset();
        return false;
    }
    if (c.selected && *c.selected >= current(c.designs).added.size()) c.selected.reset();
    auto place_at = [&](double x, double y) {
        const glm::vec2 pixel(static_cast<float>(x), static_cast<float>(y));
        return ground_along(world, v.camera, ray_through(v.camera, size, pixel));
    };
    const auto place = is_panels ? std::nullopt : place_at(now.x, now.y);
    const bool is_new = now.is_held && !before.is_held;
    if (!c.grip.is_held &&
        take_corner(show, before, now, is_new && !is_panels ? place_at(now.held_x, now.held_y) : place, v))
        return true;
    if (c.grip.is_held) {
        if (place) hold(*place, v);
        if (c.grip.is_clicked ? before.is_held && !now.is_held : !now.is_held) let_go_of(world, v);
        return true;
    }
    c.ghost.reset();
    if (now.is_held && !before.is_held) {
        const auto taken = place_at(now.held_x, now.held_y);
        const bool is_drawing = c.tool && is_drawn_out(*c.tool);
        if (!taken && is_drawing && !is_panels) tell(v, "There is no ground to begin on.");
        return taken ? take_hold(*taken, v) : is_drawing && !is_panels;
    }
    if (!c.tool) {
        if (now.has_clicked) c.selected.reset();
        return false;
    }
    if (now.has_clicked && place && !is_drawn_out(*c.tool)) {
        put_down(world, new_one(*world.ground, *c.tool, *place), v);
        return true;
    }
    if (place && !now.is_held && !is_drawn_out(*c.tool)) c.ghost = new_one(*world.ground, *c.tool, *place);
    if (place && !now.is_held && c.tool == AddedKind::barrier)
        c.ghost = closure_at(*world.ground, rounded(*place));
    return now.has_clicked || (now.is_held && is_drawn_out(*c.tool));
}

bool is_putting(const Viewer& v) { return v.room == Room::change && v.change.tool.has_value(); }

bool abandon_line(Viewer& v) {
    if (!v.change.grip.is_clicked) return false;
    v.change.grip = {};
    v.change.ghost.reset();
    return true;
}

void mark_added(const Viewer& v, Show& show, FrameInput& frame) {
    if (v.choice.kind != CameraChoice::Kind::map || !v.has_panels) return;
    for (const Addition& a : current(v.change.designs).added)
        add_outline(*show.loaded.world, a, pen_of(colour_of(a), GizmoPlace::in_world), show.overlay.lines);
    frame.lines = show.overlay.lines;
}

void mark_changes(const Viewer& v, Show& show, FrameInput& frame) {
    if (v.room != Room::change || !v.has_panels) return mark_added(v, show, frame);
    const Change& c = v.change;
    const World& world = *show.loaded.world;
    std::vector<GizmoLine>& lines = show.overlay.lines;
    const std::vector<Addition>& added = current(c.designs).added;
    for (size_t i = 0; i < added.size(); ++i) {
        const bool is_moved = c.grip.is_held && c.grip.moved == i;
        if (is_moved) continue;
        const uint32_t colour = c.selected == i ? k_chosen : colour_of(added[i]);
        add_outline(world, added[i], pen_of(colour, GizmoPlace::in_world), lines);
    }
    if (c.ghost) add_outline(world, *c.ghost, pen_of(k_new, GizmoPlace::in_world), lines);
    mark_platform(v, lines);
    frame.lines = lines;
}

}  // namespace flaneur
