#include "tools/flaneur/overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/stepping.h"
#include "tools/extract/convert.h"
#include "tools/extract/ids.h"
#include "tools/flaneur/overlay/lettering.h"
#include "tools/flaneur/overlay/shapes.h"

namespace flaneur {

namespace {

constexpr float k_letters = 10;  // pixels that capitals are tall
constexpr float k_margin = 18;   // pixels
constexpr uint32_t k_white = ink(0xf6f3ec), k_grey = ink(0xb9b6ae);

constexpr LegendEntry k_level_legend[] = {
    {"finest mesh", k_level_colours[0]}, {"second", k_level_colours[1]},   {"third", k_level_colours[2]},
    {"fourth", k_level_colours[3]},      {"coarsest", k_level_colours[4]}, {"impostor", k_level_colours[5]}};

// Metres a second, rising.
struct SpeedColour {
    float speed;
    const char* what;
    uint32_t colour;
};
constexpr SpeedColour k_speed_colours[] = {{0, "stands", ink(0x34508f)},
                                           {0.6f, "0.6 m/s", ink(0x3f9f9a)},
                                           {1.2f, "1.2 m/s", ink(0xa3c95f)},
                                           {1.6f, "1.6 m/s", ink(0xf1d04a)},
                                           {2.2f, "2.2 m/s", ink(0xb83a2c)}};

// Fruin's levels of service on walkways, people to a square metre (J. J. Fruin, Pedestrian Planning and
// Design, 1971: 35, 25, 15, 10 and 5 square feet a person).
constexpr LegendEntry k_density_legend[] = {
    {"A  below 0.31 people/m2", k_fruin_colours[0]}, {"B  0.31 to 0.43", k_fruin_colours[1]},
    {"C  0.43 to 0.72", k_fruin_colours[2]},         {"D  0.72 to 1.08", k_fruin_colours[3]},
    {"E  1.08 to 2.15", k_fruin_colours[4]},         {"F  above 2.15", k_fruin_colours[5]}};

constexpr LegendEntry k_walkable_legend[] = {
    {"road", k_surface_colours[0]},  {"sidewalk", k_surface_colours[1]}, {"crossing", k_surface_colours[2]},
    {"plaza", k_surface_colours[3]}, {"path", k_surface_colours[4]},     {"steps", k_surface_colours[5]},
    {"grass", k_surface_colours[6]}};

constexpr LegendEntry k_overdraw_legend[] = {{"drawn once", ink(0x291409)},
                                             {"four times", ink(0xa35224)},
                                             {"eight times", ink(0xffa347)},
                                             {"sixteen times and more", ink(0xffff8f)}};

constexpr LegendEntry k_skeleton_legend[] = {
    {"left", k_left_colour}, {"right", k_right_colour}, {"trunk", k_trunk_colour}};

constexpr LegendEntry k_way_legend[] = {{"largest circles; blocked rays", k_barred_colour},
                                        {"the circle it goes along", k_chosen_colour},
                                        {"free rays", k_free_colour}};
constexpr LegendEntry k_exhibit_legend[] = {{"where a figure goes", k_free_colour},
                                            {"where a target will be, four seconds", k_chosen_colour}};
constexpr LegendEntry k_stepper_legend[] = {{"where the left foot is wanted", k_left_colour},
                                            {"the right one", k_right_colour},
                                            {"the ray down", k_ray_colours[0]},
                                            {"no ground; nothing in reach", k_barred_colour},
                                            {"the reach of feet", k_white},
                                            {"a step", k_chosen_colour}};
constexpr LegendEntry k_probe_legend[] = {{"ray down ahead", k_ray_colours[0]},
                                          {"ray down behind", k_ray_colours[1]},
                                          {"normal ahead", k_normal_colours[0]},
                                          {"normal behind", k_normal_colours[1]},
                                          {"their mean", k_mean_colour}};

uint32_t mixed(uint32_t a, uint32_t b, float t) {
    uint32_t out = 0;
    for (uint32_t shift = 0; shift < 32; shift += 8) {
        const float from = static_cast<float>(a >> shift & 255), to = static_cast<float>(b >> shift & 255);
        out |= static_cast<uint32_t>(std::lround(from + (to - from) * t)) << shift;
    }
    return out;
}

uint32_t speed_colour(float speed) {
    size_t i = 1;
    while (i + 1 < std::size(k_speed_colours) && speed > k_speed_colours[i].speed) ++i;
    const SpeedColour &low = k_speed_colours[i - 1], &high = k_speed_colours[i];
    return mixed(low.colour, high.colour,
                 std::clamp((speed - low.speed) / (high.speed - low.speed), 0.0f, 1.0f));
}

void colour_by_speed(const World& world, PeopleFrame& people) {
    for (uint32_t i = 0; i < world.crowd.count; ++i)
        std::fill_n(people.walkers[i].instance.tints, k_tints,
                    speed_colour(length(world.crowd.motion.velocity[i])));
    for (size_t i = world.crowd.count; i < people.walkers.size(); ++i) {
        WalkerDraw& draw = people.walkers[i];
        if (kind_of_id(draw.id) != IdKind::creature) continue;
        const Creature& creature = creatures_of(world)[number_of_id(draw.id)];
        std::fill_n(draw.instance.tints, k_tints,
                    speed_colour(creature_walkers(world).moved[creature.walker] / k_tick));
    }
}

// From the lower left corner up, each row on a dark ground. Kept apart, so that it lies over all other lines.
struct LetteredLegend {
    static constexpr float k_row = 1.9f * k_letters, k_indent = 30;
    std::vector<GizmoLine> grounds, rows;
    float row = 0;

    void add_row(std::string_view text, uint32_t colour, uint32_t swatch) {
        constexpr glm::vec3 corner(0, 1, 0);
        const float y = -(k_margin + row * k_row), left = k_margin + (swatch != 0 ? k_indent : 0);
        auto bar = [&](float from, float to, float pixels, uint32_t ink) {
            Pen pen{.a = corner, .b = corner, .place = GizmoPlace::on_picture};
            pen.shift_a = {from, y - 0.5f * k_letters};
            pen.shift_b = {to, y - 0.5f * k_letters};
            pen.pixels = pixels;
            pen.colour = ink;
            return pen;
        };
        grounds.push_back(bar(k_margin, left + text_width(text, k_letters), k_row + 2, ink(0x1b1e22, 0.6f)));
        if (swatch != 0) rows.push_back(bar(k_margin + 4, k_margin + 16, 10, swatch | 0xff000000u));
        add_text(rows, {corner, {left, y}, GizmoPlace::on_picture}, text, colour, k_letters);
    }
    void add(const Legend& legend) {
        for (size_t i = legend.entries.size(); i-- > 0; ++row)
            add_row(legend.entries[i].what, k_white, legend.entries[i].colour);
        add_row(legend.title, k_grey, 0);
        row += 1.6f;
    }
};

void letter_legends(WorkViews views, const World& world, Overlay& overlay) {
    LetteredLegend lettered;
    for (const Legend& legend : legends_of(views, world)) lettered.add(legend);
    for (const auto* lines : {&lettered.grounds, &lettered.rows})
        overlay.lines.insert(overlay.lines.end(), lines->begin(), lines->end());
}

}  // namespace

std::vector<Legend> legends_of(WorkViews views, const World& world) {
    using enum WorkView;
    std::vector<Legend> legends;
    auto add = [&](WorkView view, const char* title, std::span<const LegendEntry> entries) {
        const bool is_of_ground = view == density || view == walkable;
        if (views[view] && !(world.roam && is_of_ground))
            legends.push_back({title, {entries.begin(), entries.end()}});
    };
    std::vector<LegendEntry> speeds;
    for (const SpeedColour& colour : k_speed_colours) speeds.push_back({colour.what, colour.colour});
    add(overdraw, "Overdraw", k_overdraw_legend);
    add(lods, "Levels of detail", k_level_legend);
    add(speed, "Speed", speeds);
    add(density, "Density", k_density_legend);
    add(walkable, "Walkable", k_walkable_legend);
    add(skeletons, "Skeletons", k_skeleton_legend);
    if (world.roam)
        add(ways, "Ways", k_probe_legend);
    else if (is_on_course(world))
        add(ways, "Ways", k_stepper_legend);
    else if (!world.figures.plans.empty())
        add(ways, "Ways", k_exhibit_legend);
    else
        add(ways, "Ways", k_way_legend);
    return legends;
}

void follow_trails(const World& world, Trails& trails) {
    const Crowd& crowd = world.crowd;
    if (world.tick % k_trail_ticks != 0) return;
    trails.places.resize(size_t{crowd.count} * k_trail_places);
    for (uint32_t i = 0; i < crowd.count; ++i)
        trails.places[i * k_trail_places + trails.taken % k_trail_places] = place_of(world, i);
    ++trails.taken;
}

glm::vec3 joint_turned(const PeopleFrame& people, uint32_t walker, const Character& character, Joint joint,
                       glm::vec3 v) {
    const Quat back = conjugate(character.bind_to_canonical[joint]);
    const glm::vec4 turn = people.palette[people.walkers[walker].instance.palette + joint].rotation;
    return to_glm(rotate(Quat{turn.x, turn.y, turn.z, turn.w}, rotate(back, Vec3{v.x, v.y, v.z})));
}

glm::vec3 joint_place(const OverlayInput& input, const PeopleFrame& people, uint32_t walker, Joint joint) {
    const WalkerDraw& draw = people.walkers[walker];
    const Character& character = input.characters[draw.mesh];
    const JointTransform& moved = people.palette[draw.instance.palette + joint];
    const Quat turn{moved.rotation.x, moved.rotation.y, moved.rotation.z, moved.rotation.w};
    return glm::vec3(moved.translation) +
           to_glm(rotate(turn, character.bind_joints[joint] * draw.instance.scale));
}

void lay_over(const OverlayInput& input, WorkViews views, PeopleFrame& people, Overlay& overlay,
              FrameInput& frame) {
    using enum WorkView;
    overlay.lines.clear();
    overlay.fills.clear();
    if (views.mask == 0) return;
    if (views[wireframe]) frame.surfaces = Surfaces::wireframe;
    if (views[normals]) frame.surfaces = Surfaces::normals;
    if (views[overdraw]) frame.surfaces = Surfaces::overdraw;
    if (views[lods]) frame.people_colours = PeopleColours::levels;
    if (views[speed]) {
        frame.people_colours = PeopleColours::tints;
        colour_by_speed(input.world, people);
    }
    if (views[density]) add_density(input, overlay);
    if (views[walkable]) add_walkable(input, overlay);
    if (views[trails]) add_trails(input, overlay);
    if (views[ways]) add_ways(input, overlay);
    if (views[skeletons]) {
        frame.are_ghosts = true;
        add_skeletons(input, people, overlay);
    }
    if (views[gizmos]) {
        add_gait_gizmos(input, people, overlay);
        add_linkage_gizmos(input, overlay);
        add_figure_gizmos(input, overlay);
        add_deed_gizmos(input, overlay);
    }
    if (overlay.letters_legends) letter_legends(views, input.world, overlay);
    frame.lines = overlay.lines;
    frame.fills = overlay.fills;
}

}  // namespace flaneur
