#include "tools/flaneur/window/steppers/steppers.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <array>

#include "sim/stepping.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/change/drive.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/open/open.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/pick.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

namespace {

constexpr float k_far = 200;  // metres that a pointer reaches

bool steps(const Show& show) { return is_on_course(*show.loaded.world); }

void tell_of_course(Viewer& v) { tell(v, "That is for those on a course: see the scene stepper."); }

constexpr std::array k_actions = {
    Action{"On a course: heads turn to the pointer, or not", "Alt+Y", GLFW_KEY_Y, GLFW_MOD_ALT,
           [](Show& show, Viewer& v) {
               if (!steps(show)) return tell_of_course(v);
               v.steppers.eyes_follow = !v.steppers.eyes_follow;
               tell(v, v.steppers.eyes_follow ? "Heads turn to the pointer." : "Eyes look ahead.");
           }},
    Action{"On a course: who is driven goes to the pointer, or by keys", "Alt+X", GLFW_KEY_X, GLFW_MOD_ALT,
           [](Show& show, Viewer& v) {
               if (!steps(show)) return tell_of_course(v);
               v.steppers.driven_goes = !v.steppers.driven_goes;
               tell(v, v.steppers.driven_goes ? "Who is driven goes to the pointer."
                                              : "Who is driven goes by keys.");
           }},
    Action{"On a course: all of it in one line, or round", "", 0, 0,
           [](Show& show, Viewer& v) {
               if (!steps(show)) return tell_of_course(v);
               open_course(v, !show.loaded.world->stepping->bipeds.is_flat);
           }},
};

}  // namespace

std::optional<Vec3> place_under(const World& world, const Camera& camera, Size size, double x, double y) {
    const glm::vec3 way = ray_through(camera, size, {static_cast<float>(x), static_cast<float>(y)});
    const Vec3 eye{camera.eye.x, camera.eye.y, camera.eye.z}, along{way.x, way.y, way.z};
    const auto hit = raycast(*world.stepping->ground, eye, along, k_far);
    if (!hit) return std::nullopt;
    return eye + along * hit->distance;
}

bool is_led_by_pointer(const Show& show) {
    // Heads alone change nothing that comes after.
    return steps(show) && show.loaded.world->stepping->orders[0].has_goal != 0;
}

void follow_pointer(Show& show, const Mouse& mouse, Size size, bool is_elsewhere, Viewer& v) {
    if (!steps(show)) return;
    World& world = *show.loaded.world;
    SteppersHand& hand = v.steppers;
    const bool is_in =
        !is_elsewhere && mouse.x >= 0 && mouse.y >= 0 && mouse.x < size.width && mouse.y < size.height;
    hand.place = is_in ? place_under(world, v.camera, size, mouse.x, mouse.y) : std::nullopt;
    look_at(world, hand.eyes_follow ? hand.place : std::nullopt);
    const bool goes = hand.driven_goes && is_driving(show);
    // It stays where it is while the pointer is nowhere.
    if (goes && !hand.place && world.stepping->orders[0].has_goal != 0) return;
    go_to(world, goes ? hand.place : std::nullopt);
}

void lay_out_course(const Show& show, Viewer& v) {
    if (!steps(show)) return;
    ImGui::Spacing();
    bool is_flat = show.loaded.world->stepping->bipeds.is_flat;
    ImGui::BeginDisabled(is_opening(v.opening));
    if (ImGui::Checkbox("The course in one line", &is_flat)) open_course(v, is_flat);
    ImGui::EndDisabled();
    tip("each in a lane of its own, its feet in one plane; begins anew");
}

std::span<const Action> stepper_actions() { return k_actions; }

}  // namespace flaneur
