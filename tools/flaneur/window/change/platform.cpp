#include "tools/flaneur/window/change/platform.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "assets/stages/platform.h"
#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/ways/platform.h"
#include "tools/flaneur/view/show.h"
#include "tools/flaneur/window/change/room.h"
#include "tools/flaneur/window/input.h"
#include "tools/flaneur/window/panels.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {

namespace {

constexpr float k_grasp = 0.03f;            // radians about a corner, as the eye has it
constexpr float k_stands = k_off_the_edge;  // metres of room of one who is on it
constexpr float k_over = 0.06f;             // metres, of lines over the ground
constexpr uint32_t k_line = ink(0xf4c95d), k_held = ink(0x58c4d2), k_bad = ink(0xe2604a);

Vec2 middle_of(const std::vector<Vec2>& outline) {
    Vec2 middle{};
    for (const Vec2 corner : outline) middle += corner / static_cast<float>(outline.size());
    return middle;
}

// To a centimetre, so that files are read easily.
Vec2 rounded(Vec2 p) { return {std::round(p.x * 100) / 100, std::round(p.z * 100) / 100}; }

bool is_within(const Platform& platform, const std::vector<Vec2>& outline) {
    constexpr float k_rounding = 0.01f;  // metres
    return std::ranges::all_of(outline, [&](Vec2 p) { return room_at(platform, p) >= -k_rounding; });
}

void want_outline(const Show& show, Viewer& v, const std::vector<Vec2>& outline, uint64_t gesture) {
    const World& world = *show.loaded.world;
    if (const std::string why = why_not(world, outline); !why.empty()) return tell(v, why);
    Design next = current(v.change.designs);
    next.platform = outline;
    want(v, std::move(next), gesture);
}

bool is_on_platform(const Viewer& v) { return !v.change.carried.platform.empty(); }

}  // namespace

PlatformStep next_step(const World& world, const std::vector<Vec2>& ground, const std::vector<Vec2>& wanted) {
    PlatformStep step;
    const Result<Platform> there = make_platform(ground), then = make_platform(wanted);
    if (!there || !then) return step;
    for (const WalkerId id : world.crowd.slots.living)
        step.off += room_at(*then, on_ground(world.crowd.motion.position[id.index])) < k_stands;
    if (!is_within(*there, wanted)) {
        step.ground = outline_about(ground, wanted);
        return step;
    }
    step.is_for_circles = world.platform != wanted;
    if (ground != wanted && step.off == 0) step.ground = wanted;
    return step;
}

bool holds_everybody(const World& world, Navmesh& mesh) {
    constexpr float k_aside = 0.005f;  // metres
    prepare_queries(mesh, 1);
    return std::ranges::all_of(world.crowd.slots.living, [&](WalkerId id) {
        const Vec3 at = world.crowd.motion.position[id.index];
        const auto place = nearest(mesh, 0, at, {0.3f, 1, 0.3f});
        return place && length(on_ground(place->position - at)) <= k_aside;
    });
}

std::vector<Vec2> outline_about(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    std::vector<Vec2> all = a;
    all.insert(all.end(), b.begin(), b.end());
    std::ranges::sort(all, [](Vec2 p, Vec2 q) { return p.x != q.x ? p.x < q.x : p.z < q.z; });
    all.erase(std::unique(all.begin(), all.end()), all.end());
    // Andrew's monotone chain.
    std::vector<Vec2> hull(2 * all.size());
    size_t n = 0;
    auto add = [&](Vec2 p, size_t least) {
        while (n >= least && crossed(hull[n - 2], hull[n - 1], p) <= 0) --n;
        hull[n++] = p;
    };
    for (const Vec2 p : all) add(p, 2);
    const size_t back = n + 1;
    for (size_t i = all.size() - 1; i-- > 0;) add(all[i], back);
    hull.resize(n - 1);
    if (hull.size() <= k_platform_edges && make_platform(hull)) return hull;
    Vec2 low = all[0], high = low;
    for (const Vec2 p : all) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    return {low, {high.x, low.z}, high, {low.x, high.z}};
}

std::vector<Vec2> turned_outline(const std::vector<Vec2>& outline, float size, float turn) {
    const Vec2 middle = middle_of(outline);
    const SinCos by = sin_cos(turn);
    std::vector<Vec2> out;
    for (const Vec2 corner : outline) {
        const Vec2 p = (corner - middle) * size;
        out.push_back(
            rounded(middle + Vec2{p.x * by.cosine - p.z * by.sine, p.x * by.sine + p.z * by.cosine}));
    }
    return out;
}

std::vector<Vec2> even_outline(const std::vector<Vec2>& outline, int corners) {
    const Vec2 middle = middle_of(outline);
    const float area = std::fabs(static_cast<float>(signed_area_of(outline)));
    const float apart = 2 * k_pi / static_cast<float>(corners);
    const float radius = std::sqrt(area / (0.5f * static_cast<float>(corners) * sin_cos(apart).sine));
    std::vector<Vec2> out;
    out.reserve(static_cast<size_t>(corners));
    for (int i = 0; i < corners; ++i)
        out.push_back(rounded(middle + heading_direction(apart * (static_cast<float>(i) + 0.5f)) * radius));
    return out;
}

std::string why_not(const World& world, const std::vector<Vec2>& outline) {
    const Result<Platform> platform = make_platform(outline);
    if (!platform) return platform.error().message;
    for (const Vec2 corner : outline)
        if (!(length(corner) <= k_widest_platform))
            return "The platform must lie within 400 m of the origin.";
    for (const Wayfarer& way : world.crowd.wayfarers) {
        if (way.kind != Wayfarer::Kind::stagger) continue;
        if (!nearest_with_room(*platform, on_ground(world.crowd.motion.position[way.walker]),
                               room_to_turn(strider_of(world.crowd, way.walker))))
            return "That is too narrow for those who are on it to turn.";
    }
    return "";
}

void lay_out_platform(const Show& show, Viewer& v, float scale) {
    if (!is_on_platform(v)) return;
    Change& c = v.change;
    const std::vector<Vec2>& now = current(c.designs).platform;
    ImGui::Spacing();
    ImGui::TextUnformatted("Platform");
    ImGui::SameLine();
    ImGui::TextDisabled("%.0f m2", std::fabs(signed_area_of(now)));
    // Sliders that begin in their middle and change what there was when they were taken hold of.
    auto slide = [&](const char* name, float& value, float usual, float low, float high, const char* format) {
        ImGui::SetNextItemWidth(170 * scale);
        const bool is_set = ImGui::SliderFloat(name, &value, low, high, format, ImGuiSliderFlags_AlwaysClamp);
        const uint64_t gesture = gesture_of_item(c);
        if (ImGui::IsItemActivated()) c.outline_was = now;
        if (is_set)
            want_outline(show, v,
                         turned_outline(c.outline_was, c.platform_size / 100, c.platform_turn * k_radians),
                         gesture);
        if (!ImGui::IsItemActive()) value = usual;
    };
    slide("size", c.platform_size, 100, 30, 300, "%.0f %%");
    slide("turn", c.platform_turn, 0, -180, 180, "%.0f degrees");
    int corners = static_cast<int>(now.size());
    ImGui::SetNextItemWidth(170 * scale);
    if (ImGui::SliderInt("corners", &corners, 3, k_platform_edges, "%d", ImGuiSliderFlags_AlwaysClamp))
        want_outline(show, v, even_outline(now, corners), gesture_of_item(c));
    else
        gesture_of_item(c);
    tip("all alike; or drag a corner in the picture");
    const uint32_t off = next_step(*show.loaded.world, c.ground, now).off;
    if (off > 0)
        ImGui::TextDisabled("%u on the way onto it", off);
    else if (c.ground != now)
        ImGui::TextDisabled("being cut");
}

void lay_out_drink(Show& show, Viewer& v, float scale) {
    World& world = *show.loaded.world;
    const bool staggers = std::ranges::any_of(
        world.crowd.wayfarers, [](const Wayfarer& way) { return way.kind == Wayfarer::Kind::stagger; });
    if (!staggers) return;
    if (float drunk = world.drunk; slide_share("drunk", drunk, scale)) {
        set_drunk(world, drunk);
        changed_by_hand(v.time, world);
    }
    tip("of those who stagger: wider and uneven steps, and a trunk that reels");
}

bool take_corner(const Show& show, const Mouse& before, const Mouse& now, std::optional<Vec3> place,
                 Viewer& v) {
    Change& c = v.change;
    if (!is_on_platform(v) || c.tool) return false;
    std::vector<Vec2> outline = current(c.designs).platform;
    if (c.corner && *c.corner < outline.size()) {
        if (place) c.corner_at = rounded(on_ground(*place));
        if (now.is_held) return true;
        outline[*c.corner] = c.corner_at;
        c.corner.reset();
        want_outline(show, v, outline, 0);
        return true;
    }
    c.corner.reset();
    if (!now.is_held || before.is_held || !place) return false;
    for (size_t i = 0; i < outline.size(); ++i) {
        const glm::vec3 eye = v.camera.eye;
        const Vec3 from{eye.x, eye.y, eye.z};
        const Vec3 there = at_height(outline[i], 0) - from, here = *place - from;
        if (length(cross(there, here)) > k_grasp * length(there) * length(here)) continue;
        c.corner = i;
        c.corner_at = outline[i];
        return true;
    }
    return false;
}

void mark_platform(const Viewer& v, std::vector<GizmoLine>& lines) {
    const Change& c = v.change;
    if (!is_on_platform(v)) return;
    std::vector<Vec2> outline = current(c.designs).platform;
    Pen pen{.place = GizmoPlace::in_world};
    pen.pixels = 2.5f;
    pen.colour = k_line;
    if (c.corner && *c.corner < outline.size()) {
        outline[*c.corner] = c.corner_at;
        pen.colour = make_platform(outline) ? k_held : k_bad;
    }
    auto over = [](Vec2 p) { return glm::vec3(p.x, k_over, p.z); };
    for (size_t i = 0; i < outline.size(); ++i) {
        add_line(lines, pen, over(outline[i]), over(outline[(i + 1) % outline.size()]));
        add_circle(lines, pen, over(outline[i]), {0, 1, 0}, 0.3f);
    }
}

}  // namespace flaneur
