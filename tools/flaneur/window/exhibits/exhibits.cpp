#include "tools/flaneur/window/exhibits/exhibits.h"

#include <algorithm>

#include "renderer/view.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/shapes.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/pick.h"
#include "tools/flaneur/window/viewer.h"

namespace flaneur {

namespace {

constexpr float k_slack = 16;      // pixels beside a target's outline
constexpr float k_target = 0.06f;  // metres, of its radius
constexpr float k_farthest = 4;    // metres from its exhibit's root that a target is dragged
constexpr float k_lowest = 0.05f;  // metres over the ground

struct Seen {
    glm::vec2 pixel;
    float radius, depth;  // pixels; metres ahead of the eye
};
std::optional<Seen> seen(const View& view, Size size, Vec3 place) {
    const glm::vec4 at = view.clip_from_world * glm::vec4(to_glm(place), 1);
    if (at.w <= 0) return std::nullopt;
    return Seen{{(at.x / at.w * 0.5f + 0.5f) * static_cast<float>(size.width),
                 (at.y / at.w * 0.5f + 0.5f) * static_cast<float>(size.height)},
                k_target * view.pixels_at_one_metre / at.w,
                at.w};
}

// Not beyond where it is of use, nor into the ground.
Vec3 within_reach(const Linkage& linkage, Vec3 place) {
    const Vec3 out = place - linkage.root.middle;
    const float distance = length(out);
    if (distance > k_farthest) place = linkage.root.middle + out * (k_farthest / distance);
    place.y = std::max(place.y, k_lowest);
    return place;
}

void hold(const Linkages& linkages, const TargetGrip& grip, Vec3 place, Viewer& v) {
    Design next = current(v.change.designs);
    place = within_reach(linkages.all[linkage_of(linkages, grip.target)], place);
    next.held[grip.target] = {place, 1};
    want(v, std::move(next), grip.gesture);
}

}  // namespace

bool has_exhibits(const World& world) {
    return std::ranges::any_of(world.linkages.all,
                               [](const Linkage& f) { return f.kind != Linkage::Kind::led; });
}

size_t linkage_of(const Linkages& linkages, size_t target) {
    size_t i = 0;
    while (target >= linkages.ranges[i].targets + linkages.all[i].leads.size()) ++i;
    return i;
}

std::string told_method(const Linkage& linkage, const Method& method) {
    return linkage.kind == Linkage::Kind::chain
               ? std::string(k_solver_names[static_cast<size_t>(method.solver)])
               : linkage.name;
}

std::optional<size_t> target_at(const World& world, const Camera& camera, Size size, glm::vec2 pixel) {
    const View view =
        make_view(camera, static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height));
    std::optional<size_t> nearest;
    float least = k_slack, depth = 0;
    for (size_t t = 0; t < world.linkages.targets.size(); ++t) {
        const auto at = seen(view, size, world.linkages.targets[t]);
        if (!at) continue;
        const float beside = std::max(glm::length(at->pixel - pixel) - at->radius, 0.0f);
        // Of those under the cursor, the one in front.
        if (beside > least || (beside == least && nearest && at->depth >= depth)) continue;
        least = beside, depth = at->depth;
        nearest = t;
    }
    if (!nearest) return nearest;
    const Vec3 eye{camera.eye.x, camera.eye.y, camera.eye.z}, way = world.linkages.targets[*nearest] - eye;
    const float distance = length(way);
    const bool is_hidden =
        raycast(*world.ground, eye, way / distance, std::max(distance - k_target, 0.0f)).has_value();
    return is_hidden ? std::nullopt : nearest;
}

Vec3 in_facing_plane(const Camera& camera, Size size, glm::vec2 pixel, Vec3 at) {
    constexpr float k_steepest = 0.05f;  // cosine
    const glm::vec3 ahead = glm::normalize(camera.target - camera.eye),
                    way = ray_through(camera, size, pixel);
    const float along = glm::dot(way, ahead);
    if (along < k_steepest) return at;
    const glm::vec3 p = camera.eye + way * (glm::dot(to_glm(at) - camera.eye, ahead) / along);
    return {p.x, p.y, p.z};
}

bool set_exhibits(const Design& before, const Design& wanted, World& world) {
    if (before.held == wanted.held && before.methods == wanted.methods) return false;
    Linkages& linkages = world.linkages;
    for (size_t t = 0; t < linkages.held.size(); ++t)
        if (before.held[t] != wanted.held[t]) linkages.held[t] = wanted.held[t];
    for (size_t i = 0; i < linkages.methods.size(); ++i)
        if (before.methods[i] != wanted.methods[i]) linkages.methods[i] = wanted.methods[i];
    return true;
}

void set_exhibits(const Design& wanted, World& world) {
    if (wanted.held.size() != world.linkages.held.size()) return;
    world.linkages.held = wanted.held;
    world.linkages.methods = wanted.methods;
}

bool drag_target(const Show& show, const Mouse& before, const Mouse& now, Size size, bool is_elsewhere,
                 Viewer& v) {
    const World& world = *show.loaded.world;
    ExhibitsRoom& room = v.exhibits;
    auto pixel = [](double x, double y) { return glm::vec2(static_cast<float>(x), static_cast<float>(y)); };
    if (!has_exhibits(world) || v.presentation.is_on) {
        room.grip.reset(), room.hovered.reset();
        return false;
    }
    if (room.grip && room.grip->target >= world.linkages.targets.size()) room.grip.reset();
    if (room.grip && now.is_held) {
        const Vec3 to = in_facing_plane(v.camera, size, pixel(now.x, now.y), room.grip->was);
        if (now.x != before.x || now.y != before.y)
            hold(world.linkages, *room.grip, room.grip->was + (to - room.grip->from), v);
        return true;
    }
    if (room.grip) {
        room.grip.reset();
        return true;  // its click asks about nobody
    }
    room.hovered =
        is_elsewhere || now.is_held ? std::nullopt : target_at(world, v.camera, size, pixel(now.x, now.y));
    if (is_elsewhere || !now.is_held || before.is_held) return false;
    const glm::vec2 at = pixel(now.held_x, now.held_y);
    const auto target = target_at(world, v.camera, size, at);
    if (!target) return false;
    const Vec3 was = world.linkages.targets[*target];
    room.grip = {*target, in_facing_plane(v.camera, size, at, was), was, v.change.next_gesture++};
    room.chosen = linkage_of(world.linkages, *target);
    hold(world.linkages, *room.grip, was, v);  // it waits for the hand
    return true;
}

void mark_targets(const Viewer& v, Show& show, FrameInput& frame) {
    const Linkages& linkages = show.loaded.world->linkages;
    if (!v.has_panels || linkages.targets.empty()) return;
    constexpr uint32_t k_pointed = ink(0xffe27a), k_held = ink(0xffffff, 0.75f);
    const glm::vec3 facing = glm::normalize(v.camera.eye - v.camera.target);
    for (size_t t = 0; t < linkages.targets.size(); ++t) {
        const bool is_pointed = v.exhibits.grip ? v.exhibits.grip->target == t : v.exhibits.hovered == t;
        if (!is_pointed && !linkages.held[t].is_held) continue;
        Pen pen{.place = GizmoPlace::in_world};
        pen.pixels = 2.5f;
        pen.colour = is_pointed ? k_pointed : k_held;
        // Where it is to be: while time is stopped it is not there yet.
        const Vec3 at = linkages.held[t].is_held ? linkages.held[t].place : linkages.targets[t];
        add_circle(show.overlay.lines, pen, to_glm(at), facing, 1.6f * k_target);
    }
    frame.lines = show.overlay.lines;
}

}  // namespace flaneur
