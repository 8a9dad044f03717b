#include "tools/flaneur/window/asked.h"

#include <GLFW/glfw3.h>

#include "sim/base/math.h"
#include "tools/flaneur/window/ask/ask.h"
#include "tools/flaneur/window/pick.h"

namespace flaneur {
namespace {

constexpr float k_slack = 0.0072f;  // of the lens, that one may point beside somebody
constexpr float k_above = 0.04f;    // metres, of lines over the ground
constexpr uint32_t k_asked = ink(0x58c4d2), k_pointed_at = ink(0xffffff, 0.7f), k_way = ink(0x58c4d2, 0.8f);

glm::vec3 over_ground(Vec3 place) { return {place.x, place.y + k_above, place.z}; }

Pen pen_of(uint32_t colour) {
    Pen pen{.place = GizmoPlace::in_world};
    pen.pixels = 2.5f;
    pen.colour = colour;
    return pen;
}

void add_ring(std::vector<GizmoLine>& lines, glm::vec3 middle, float radius, uint32_t colour) {
    add_circle(lines, pen_of(colour), middle, {0, 1, 0}, radius);
}

void add_way(const World& world, uint32_t walker, std::vector<GizmoLine>& lines) {
    const Journey& journey = world.crowd.journeys[walker];
    if (walker == world.crowd.driven.walker || journey.arrived || journey.corner >= journey.corner_count)
        return;
    glm::vec3 from = over_ground(world.crowd.motion.position[walker]);
    for (size_t i = journey.corner; i < journey.corner_count; ++i) {
        const glm::vec3 to = over_ground(world.crowd.corners[size_t{walker} * k_corners + i]);
        add_line(lines, pen_of(k_way), from, to);
        from = to;
    }
    add_ring(lines, over_ground(journey.goal.position), 0.3f, k_asked);
}

// What is no walker is told about only once the cursor rests, or is clicked.
bool has_rested(glm::vec2 pixel, Asking& asking) {
    constexpr double k_seconds = 0.35;
    const double now = glfwGetTime();
    if (pixel != asking.cursor) asking.cursor = pixel, asking.still_since = now;
    return now - asking.still_since > k_seconds;
}

std::optional<Thing> thing_at(const Show& show, glm::vec3 way, Viewer& v) {
    if (show.loaded.world->roam) return {};
    const glm::vec3 eye = v.camera.eye;
    return thing_along(index_of(show, v), {eye.x, eye.y, eye.z}, {way.x, way.y, way.z});
}

void add_outline(const CityIndex& index, const Thing& thing, uint32_t colour, std::vector<GizmoLine>& lines) {
    for (const auto& [a, b] : outline_of(index, thing)) add_line(lines, pen_of(colour), a, b);
}

}  // namespace

void ask(const Show& show, const Mouse& mouse, Size size, bool is_panels, Viewer& v) {
    v.hovered.reset(), v.asking.hovered.reset();
    if (is_panels || (mouse.is_held && !mouse.has_clicked)) return;
    const glm::vec2 pixel(static_cast<float>(mouse.x), static_cast<float>(mouse.y));
    v.hovered = walker_along(*show.loaded.world, v.camera, ray_through(v.camera, size, pixel),
                             k_slack * v.camera.vertical_fov);
    const bool is_drawing = v.room == Room::measure;
    if (!v.hovered && (mouse.has_clicked || (has_rested(pixel, v.asking) && !is_drawing)))
        v.asking.hovered = thing_at(show, ray_through(v.camera, size, pixel), v);
    if (!mouse.has_clicked) return;
    v.selected = v.hovered;
    v.asking.selected = v.asking.hovered;
}

void mark_asked(const Viewer& v, Show& show, FrameInput& frame) {
    const World& world = *show.loaded.world;
    std::vector<GizmoLine>& lines = show.overlay.lines;
    auto ring = [&](uint32_t walker, uint32_t colour) {
        const glm::vec3 middle = show.people.walkers[walker].centre;
        const float foot = world.crowd.motion.position[walker].y + k_above;
        add_ring(lines, {middle.x, foot, middle.z}, 0.45f, colour);
    };
    if (v.hovered && v.hovered != v.selected) ring(*v.hovered, k_pointed_at);
    if (v.selected && is_there(world.crowd, *v.selected)) {
        ring(*v.selected, k_asked);
        if (!world.roam) add_way(world, *v.selected, lines);
    }
    const Asking& asking = v.asking;
    const bool is_asked = asking.hovered && asking.selected && is_same(*asking.hovered, *asking.selected);
    if (asking.hovered && asking.hovered->kind != ThingKind::ground && !is_asked)
        add_outline(asking.index, *asking.hovered, k_pointed_at, lines);
    if (asking.selected) add_outline(asking.index, *asking.selected, k_asked, lines);
    frame.lines = lines;
}

}  // namespace flaneur
