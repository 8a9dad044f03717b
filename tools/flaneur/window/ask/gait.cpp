#include "tools/flaneur/window/ask/gait.h"

#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>

#include "sim/base/math.h"
#include "sim/gait/footing.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/window/actions.h"
#include "tools/flaneur/window/ask/curves.h"
#include "tools/flaneur/window/ask/techniques.h"
#include "tools/flaneur/window/measure/plot.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr size_t k_most_prints = 24;
constexpr size_t k_speed_ticks = 600;
constexpr size_t k_most_strides = 6;  // of a leg, the last ones
constexpr float k_wide = 400;         // of the room, at scale 1

constexpr std::array k_actions = {
    Action{"Gait of the selected walker", "J", GLFW_KEY_J, 0,
           [](Show&, Viewer& v) { v.room = v.room == Room::gait ? Room::none : Room::gait; }},
    Action{"Steps of the selected walker, in the city", "", 0, 0,
           [](Show&, Viewer& v) { v.watch.shows_steps = !v.watch.shows_steps; }},
};

Instant instant_of(const World& world, uint32_t walker) {
    const CrowdMotion& motion = world.crowd.motion;
    Instant now;
    now.root = motion.position[walker];
    now.velocity = motion.velocity[walker];
    now.heading = motion.heading[walker];
    for (int j = 0; j < k_joint_count; ++j)
        now.joints[static_cast<size_t>(j)] = joint_pose(world.poses, walker, static_cast<Joint>(j));
    for (const Side side : {k_left, k_right})
        now.feet[side] = foot_instant(*world.ground, world.gait, world.poses, walker, side);
    return now;
}

void add_print(const World& world, Side side, GaitWatch& watch) {
    const int lane = static_cast<int>(watch.walker % k_block);
    const FootPlace place = get_place(world.gait.blocks[watch.walker / k_block].feet[side].to, lane);
    const FootSize size = foot_size(world.gait.people[watch.walker / k_block], lane);
    const Vec2 ahead = heading_direction(place.yaw);
    const Vec3 way{ahead.x, -(place.normal.x * ahead.x + place.normal.z * ahead.z) / place.normal.y, ahead.z};
    watch.prints.push_back({to_glm(place.position + way * size.heel), to_glm(place.position + way * size.tip),
                            to_glm(place.normal), side});
    if (watch.prints.size() > k_most_prints) watch.prints.erase(watch.prints.begin());
}

std::vector<glm::vec2> points_of(const Cycle& cycle, const Cycle* sd = nullptr, double times = 0) {
    std::vector<glm::vec2> points;
    for (size_t i = 0; i < cycle.size(); ++i)
        points.push_back({static_cast<float>(i), static_cast<float>(cycle[i] + (sd ? times * (*sd)[i] : 0))});
    return points;
}

struct Angle {
    const char* title;
    Cycle Curves::*curve;
    Cycle Reference::*norm;
    Cycle Reference::*sd;
};
constexpr Angle k_angles[] = {
    {"hip, against the vertical, degrees", &Curves::thigh, &Reference::thigh, &Reference::thigh_sd},
    {"knee, degrees", &Curves::knee, &Reference::knee, &Reference::knee_sd},
    {"ankle, degrees", &Curves::ankle, &Reference::ankle, &Reference::ankle_sd}};

void begin_anew(GaitWatch& watch) {
    const bool shows_steps = watch.shows_steps;
    watch = GaitWatch();
    watch.shows_steps = shows_steps;
}

uint32_t plot_colour(Side side) { return side == k_left ? k_left_colour : k_right_colour; }

void lay_out_angle(const GaitWatch& watch, const Angle& angle, float mark, bool is_last, float width,
                   float scale) {
    const Cycle &norm = k_reference.*angle.norm, &sd = k_reference.*angle.sd;
    const std::vector<glm::vec2> low = points_of(norm, &sd, -1), high = points_of(norm, &sd, 1);
    std::array<std::vector<glm::vec2>, 2> own;
    glm::vec2 span(1e9f, -1e9f);
    auto widen = [&](const std::vector<glm::vec2>& points) {
        for (glm::vec2 p : points) span = {std::min(span.x, p.y), std::max(span.y, p.y)};
    };
    widen(low), widen(high);
    for (const Side side : {k_left, k_right})
        if (watch.legs[side]) own[side] = points_of(watch.legs[side]->curves.*angle.curve), widen(own[side]);
    const PlotCurve curves[] = {{"left", plot_colour(k_left), own[k_left]},
                                {"right", plot_colour(k_right), own[k_right]}};
    const PlotBand bands[] = {{low, high, ImGui::GetColorU32(ImGuiCol_Text, 0.18f)}};
    const float room = 0.06f * (span.y - span.x);
    Plot plot{angle.title,
              is_last ? "% of the gait cycle, from the foot's contact" : "",
              {0, span.x - room},
              {100, span.y + room}};
    plot.bands = bands;
    plot.curves = curves;
    plot.mark = mark;
    lay_out_plot(plot, {width, (is_last ? 124.0f : 108.0f) * scale}, scale);
}

}  // namespace

std::span<const Action> gait_actions() { return k_actions; }

std::optional<uint32_t> watched(const Viewer& v) {
    if (v.selected) return v.selected;
    using enum CameraChoice::Kind;
    const bool is_along = v.choice.kind == follow || v.choice.kind == eyes;
    return is_along ? std::optional(v.choice.walker) : std::nullopt;
}

void watch_gait(const World& world, std::optional<uint32_t> walker, GaitWatch& watch) {
    if (!walker || world.roam || !is_there(world.crowd, *walker)) {
        begin_anew(watch);
        return;
    }
    const uint32_t generation = world.crowd.slots.generation[*walker];
    const bool goes_on = !watch.walk.ticks.empty() && watch.walker == *walker &&
                         watch.generation == generation && world.tick == watch.tick + 1;
    if (!goes_on) {
        begin_anew(watch);
        watch.walker = *walker, watch.generation = generation;
        watch.walk.body = world.kinds[world.crowd.identity.body[*walker]].body;
    }
    watch.tick = world.tick;
    std::vector<Instant>& ticks = watch.walk.ticks;
    if (ticks.size() >= 2 * k_watched_ticks)
        ticks.erase(ticks.begin(), ticks.begin() + static_cast<std::ptrdiff_t>(k_watched_ticks));
    ticks.push_back(instant_of(world, *walker));
    for (const Side side : {k_left, k_right}) {
        const bool stands = !ticks.back().feet[side].swinging;
        const bool stood = ticks.size() > 1 && !ticks[ticks.size() - 2].feet[side].swinging;
        if (stands && !stood) add_print(world, side, watch), ++watch.contacts;
    }
}

void measure_legs(GaitWatch& watch) {
    if (watch.known_contacts == watch.contacts) return;
    watch.known_contacts = watch.contacts;
    const std::vector<MeasuredStride> all = strides(watch.walk, 0, watch.walk.ticks.size());
    double seconds = 0, metres = 0;
    int count = 0;
    for (const Side side : {k_left, k_right}) {
        std::vector<MeasuredStride> own;
        for (auto s = all.rbegin(); s != all.rend() && own.size() < k_most_strides; ++s)
            if (s->side == side) own.insert(own.begin(), *s);
        watch.legs[side].reset();
        if (own.empty()) continue;
        WatchedLeg& leg = watch.legs[side].emplace();
        leg.curves = curves_of(watch.walk, own);
        leg.strides = static_cast<int>(own.size());
        for (const MeasuredStride& s : own) {
            leg.stance += (s.toe_off - s.begin) / (s.end - s.begin) / static_cast<double>(own.size());
            const Instant &from = watch.walk.ticks[static_cast<size_t>(s.begin)],
                          &to = watch.walk.ticks[static_cast<size_t>(s.end)];
            seconds += (s.end - s.begin) / watch.walk.rate, ++count;
            metres += static_cast<double>(length(on_ground(to.root - from.root)));
        }
    }
    watch.seconds = count > 0 ? seconds / count : 0;
    watch.metres = count > 0 ? metres / count : 0;
}

void mark_gait(Show& show, Viewer& v, FrameInput& frame) {
    const GaitWatch& watch = v.watch;
    const World& world = *show.loaded.world;
    const std::optional<uint32_t> who = watched(v);
    if (!watch.shows_steps || !v.has_panels || !who || world.roam || watch.walk.ticks.empty()) return;
    for (const GaitWatch::Print& print : watch.prints) {
        Pen pen{.pixels = 1.5f, .place = GizmoPlace::in_world_hidden};
        pen.colour = (plot_colour(print.side) & 0xffffffu) | 0xa0000000u;
        const glm::vec3 lift = print.normal * 0.01f;
        add_footprint(show.overlay.lines, pen, print.heel + lift, print.tip + lift, print.normal);
    }
    if (show.people.walkers[*who].instance.palette != k_no_palette) {
        const Without* without = show.draws_whole ? nullptr : &show.without;
        const OverlayInput input{world, show.loaded.characters, v.camera, 1, without};
        add_contact_marks(input, *who, show.overlay);
        add_gizmos_of(input, show.people, *who, show.overlay);
    }
    frame.lines = show.overlay.lines;
    frame.fills = show.overlay.fills;
}

void lay_out_speed(const GaitWatch& watch, float width, float scale) {
    const std::vector<Instant>& ticks = watch.walk.ticks;
    const size_t count = std::min(ticks.size(), k_speed_ticks + 1);
    std::vector<glm::vec2> speed;
    float most = 1.5f;
    for (size_t i = ticks.size() - count; i < ticks.size(); ++i) {
        const float ago = -static_cast<float>(ticks.size() - 1 - i) / 60;
        speed.push_back({ago, length(ticks[i].velocity)});
        most = std::max(most, speed.back().y);
    }
    const PlotCurve curves[] = {{"", IM_COL32(88, 196, 210, 255), speed}};
    Plot plot{"speed, m/s", "seconds ago", {-10, 0}, {0, round_top(most)}};
    plot.curves = curves;
    lay_out_plot(plot, {width, 104 * scale}, scale);
}

std::string told_of_curves(const Techniques& on) {
    std::string told = "Curves: the walk, all techniques on";
    const std::string off = told_off(on);
    if (!off.empty()) told.append("; bodies are drawn ").append(off);
    return told.append(".");
}

// Strides and curves of whoever is watched.
static void lay_out_watched(const World& world, uint32_t who, Viewer& v, float width, float scale) {
    GaitWatch& watch = v.watch;
    measure_legs(watch);
    if (!watch.legs[k_left] && !watch.legs[k_right])
        ImGui::TextDisabled("No. %u has not made a whole stride since you asked.", who);
    else
        ImGui::Text("stride %.2f m in %.2f s, %.0f steps a minute", watch.metres, watch.seconds,
                    watch.seconds > 0 ? 120 / watch.seconds : 0.0);
    for (const Side side : {k_left, k_right})
        if (watch.legs[side])
            ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(plot_colour(side)),
                               "%s: mean of %d stride%s, stands for %.0f %% of it",
                               side == k_left ? "left" : "right", watch.legs[side]->strides,
                               watch.legs[side]->strides == 1 ? "" : "s", 100 * watch.legs[side]->stance);
    ImGui::TextWrapped("%s", told_of_curves(v.techniques.on).c_str());
    const GaitBlock& gait = world.gait.blocks[who / k_block];
    const size_t lane = who % k_block;
    const float mark = gait.standing[lane] ? -1e9f : 100 * gait.feet[k_left].phase[lane];
    for (const Angle& angle : k_angles)
        lay_out_angle(watch, angle, mark, &angle == std::end(k_angles) - 1, width, scale);
    ImGui::TextDisabled(
        "Band: grown people on level ground at 1.1 to 1.33 m/s, mean and standard deviation (Winter 1991; "
        "Fukuchi, Fukuchi & Duarte 2018). Upright line: where the left leg is now.");
    lay_out_speed(watch, width, scale);
}

void lay_out_gait(Show& show, Viewer& v, float scale) {
    const World& world = *show.loaded.world;
    const float width = width_in(v, SidePanel::room, k_wide);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    lay_out_techniques(show, v, width, scale);
    lay_out_curves(show, v, width);
    ImGui::Checkbox("steps, contacts and targets", &v.watch.shows_steps);
    const std::optional<uint32_t> who = watched(v);
    if (who && !world.roam && is_there(world.crowd, *who))
        lay_out_watched(world, *who, v, width, scale);
    else
        ImGui::TextDisabled(world.roam ? "On the asteroid steps are not measured."
                                       : "Click somebody, or follow them (3), to see how they walk.");
    ImGui::PopTextWrapPos();
}

}  // namespace flaneur
