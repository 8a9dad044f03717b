// What is measured, drawn in the city and named.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "renderer/view.h"
#include "tools/flaneur/overlay/overlay.h"
#include "tools/flaneur/overlay/shapes.h"
#include "tools/flaneur/window/measure/drawing.h"
#include "tools/flaneur/window/time/beside.h"
#include "tools/flaneur/window/viewer.h"
#include "tools/flaneur/window/widgets.h"

namespace flaneur {
namespace {

constexpr float k_above = 0.05f, k_step = 0.5f;  // metres: of lines over the ground; between looks at it
constexpr uint32_t k_colours[] = {0xe9dcf7, 0xe9dcf7, 0xf2c14e, 0x58c4d2};  // by MarkingKind
constexpr uint32_t k_edge = ink(0x14171a, 0.55f);

// Appends the way over the ground from one place to another, but for its first one. Where there is no ground
// near, as on a roof, it goes straight.
void drape(const Ground* ground, glm::vec3 a, glm::vec3 b, std::vector<glm::vec3>& to) {
    const int pieces =
        std::clamp(static_cast<int>(std::ceil(std::hypot(b.x - a.x, b.z - a.z) / k_step)), 1, 400);
    float before = a.y;
    for (int i = 1; i <= pieces; ++i) {
        glm::vec3 p = glm::mix(a, b, static_cast<float>(i) / static_cast<float>(pieces));
        if (ground)
            if (const auto hit = ground_at(*ground, {p.x, before, p.z}, 0.8f, 1.5f)) p.y = hit->height;
        before = p.y;
        to.push_back(p);
    }
}

std::vector<glm::vec3> outline(const World& world, const std::vector<glm::vec3>& points, bool is_closed) {
    std::vector<glm::vec3> all;
    if (points.empty()) return all;
    all.push_back(points[0]);
    for (size_t i = 1; i < points.size() + (is_closed ? 1 : 0); ++i)
        drape(world.ground.get(), points[i - 1], points[i % points.size()], all);
    for (glm::vec3& p : all) p.y += k_above;
    return all;
}

// Triangles over the ground that fill a zone, halved until their edges are short.
std::vector<glm::vec3> fill(const World& world, const std::vector<glm::vec3>& points) {
    constexpr float k_longest = 1.5f;
    constexpr size_t k_most = 30'000;
    const std::vector<uint32_t> triangles = fill_of(on_map(points));
    std::vector<std::array<glm::vec3, 3>> pieces;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3)
        pieces.push_back({points[triangles[i]], points[triangles[i + 1]], points[triangles[i + 2]]});
    std::vector<glm::vec3> all;
    while (!pieces.empty()) {
        const auto [a, b, c] = pieces.back();
        pieces.pop_back();
        const float ab = glm::length(b - a), bc = glm::length(c - b), ca = glm::length(a - c);
        const float most = std::max({ab, bc, ca});
        if (most > k_longest && all.size() + 3 * pieces.size() < k_most) {
            using Corners = std::array<glm::vec3, 3>;
            const auto [p, q, r] = most == ab   ? Corners{a, b, c}
                                   : most == bc ? Corners{b, c, a}
                                                : Corners{c, a, b};
            glm::vec3 middle = 0.5f * (p + q);
            if (world.ground)
                if (const auto hit = ground_at(*world.ground, {middle.x, middle.y, middle.z}, 1.5f, 3))
                    middle.y = hit->height;
            pieces.push_back({p, middle, r});
            pieces.push_back({middle, q, r});
            continue;
        }
        all.insert(all.end(), {a, b, c});
    }
    for (glm::vec3& p : all) p.y += 0.5f * k_above;
    return all;
}

// How much of them is ground that people walk on, square metres.
double walkable_of(const World& world, const std::vector<glm::vec3>& triangles) {
    if (!world.navmesh) return 0;
    constexpr Vec3 k_reach{0.3f, 1.5f, 0.3f};  // people's middles keep off walls
    double all = 0;
    for (size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const glm::vec3 a = triangles[i], b = triangles[i + 1], c = triangles[i + 2];
        const glm::vec3 middle = (a + b + c) / 3.0f;
        const Vec3 place{middle.x, middle.y, middle.z};
        const auto there = nearest(*world.navmesh, 0, place, k_reach);
        if (!there || length(on_ground(there->position - place)) > k_reach.x) continue;
        all += 0.5 * std::fabs(static_cast<double>((b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x)));
    }
    return all;
}

// By its level of service.
void add_fill(const Marking& drawn, const std::vector<glm::vec3>& triangles, const Counts& counts,
              std::vector<GizmoCorner>& fills) {
    constexpr uint32_t k_opacity = 0x50000000u;
    for (const ZoneCount& zone : counts.zones) {
        if (zone.zone.name != drawn.name) continue;
        const int level = fruin_level(zone_now(zone, counts).density);
        const uint32_t colour = (k_fruin_colours[level] & 0xffffffu) | k_opacity;
        for (const glm::vec3& corner : triangles) fills.push_back({corner, colour});
    }
}

struct Drawer {
    std::vector<GizmoLine>& lines;

    void stroke(const std::vector<glm::vec3>& points, uint32_t colour, float pixels) {
        for (const bool is_edge : {true, false})
            for (size_t i = 1; i < points.size(); ++i) {
                Pen pen{.pixels = is_edge ? pixels + 2.5f : pixels};
                pen.colour = is_edge ? k_edge : colour;
                add_line(lines, pen, points[i - 1], points[i]);
            }
    }
    void point(glm::vec3 at, uint32_t colour, float pixels) {
        for (const bool is_edge : {true, false}) {
            Pen pen{.pixels = is_edge ? pixels + 3 : pixels};
            pen.colour = is_edge ? k_edge : colour;
            add_point(lines, pen, at + glm::vec3(0, k_above, 0));
        }
    }
};

glm::vec3 middle_of(const std::vector<glm::vec3>& outline) {
    if (outline.empty()) return {};
    return outline[outline.size() / 2];
}
glm::vec3 centre_of(const std::vector<glm::vec3>& points) {
    glm::vec3 sum(0);
    for (const glm::vec3& p : points) sum += p;
    return sum / static_cast<float>(std::max<size_t>(points.size(), 1));
}

// A unit vector over the ground, to the right of a line.
glm::vec3 right_of(const Marking& line) {
    const glm::vec3 way = line.points[1] - line.points[0];
    const float length = std::max(std::hypot(way.x, way.z), 1e-6f);
    return {-way.z / length, 0, way.x / length};
}
float reach_of(const Marking& line) {
    return std::clamp(0.2f * glm::length(line.points[1] - line.points[0]), 0.5f, 2.0f);
}

template <class... Values>
std::string text_of(const char* form, Values... values) {
    char text[96];
    std::snprintf(text, sizeof text, form, values...);
    return text;
}

// What is written in the city: `colour` as ImGui has it.
struct Label {
    glm::vec3 place;
    std::string text;
    uint32_t colour;
};

void add_line_labels(const Marking& drawn, const std::vector<glm::vec3>& outline, const Counts& counts,
                     std::vector<Label>& labels) {
    const auto line = std::find_if(counts.lines.begin(), counts.lines.end(),
                                   [&](const LineCount& l) { return l.line.name == drawn.name; });
    if (line == counts.lines.end()) return;
    const Flow all = flow_of(*line, counts.shown, 1e9), lately = flow_of(*line, counts.shown, k_flow_seconds);
    const glm::vec3 middle = middle_of(outline), aside = right_of(drawn) * (reach_of(drawn) * 1.35f);
    labels.push_back(
        {outline.front(),
         is_settled(lately) ? text_of("%s  %.1f/min", drawn.name.c_str(), lately.per_minute) : drawn.name,
         k_colours[static_cast<size_t>(MarkingKind::line)]});
    auto told = [&](int side, uint32_t count) { return text_of("%u %s", count, compass(line->line, side)); };
    labels.push_back({middle + aside, told(1, all.right), k_right_rgb});
    labels.push_back({middle - aside, told(-1, all.left), k_left_rgb});
}

void add_labels(const MeasureRoom& room, const Counts& counts, std::vector<Label>& labels) {
    for (size_t i = 0; i < room.drawn.size() && i < room.outlines.size(); ++i) {
        const Marking& drawn = room.drawn[i];
        const char* name = drawn.name.c_str();
        const uint32_t colour = k_colours[static_cast<size_t>(drawn.kind)];
        const glm::vec3 centre = centre_of(drawn.points);
        switch (drawn.kind) {
            case MarkingKind::line:
                add_line_labels(drawn, room.outlines[i], counts, labels);
                break;
            case MarkingKind::zone:
                for (const ZoneCount& zone : counts.zones) {
                    if (zone.zone.name != drawn.name) continue;
                    const ZoneSample now = zone_now(zone, counts);
                    labels.push_back(
                        {centre,
                         text_of("%s  %u %s  %.2f/m\u00b2  %c", name, now.people,
                                 now.people == 1 ? "person" : "people", static_cast<double>(now.density),
                                 'A' + fruin_level(now.density)),
                         colour});
                }
                break;
            case MarkingKind::distance:
                labels.push_back({drawn.points.back(),
                                  text_of("%s  %.2f m", name, length_of(drawn.points, false).along), colour});
                break;
            case MarkingKind::area:
                labels.push_back(
                    {centre, text_of("%s  %.1f m\u00b2", name, area_of(on_map(drawn.points))), colour});
                break;
        }
    }
}

// How long and how large the draft is so far.
void add_draft_label(const MeasureRoom& room, std::vector<Label>& labels) {
    if (!room.tool || room.draft.empty()) return;
    std::vector<glm::vec3> points = room.draft;
    if (room.under) points.push_back(*room.under);
    std::string text = text_of("%.2f m", length_of(points, false).along);
    if (is_closed(*room.tool) && points.size() > 2) text = text_of("%.1f m\u00b2", area_of(on_map(points)));
    labels.push_back({points.back(), text, k_colours[static_cast<size_t>(*room.tool)]});
}

// What has been drawn, with what `counts` say of it.
void draw_kept(const MeasureRoom& room, const Counts& counts, bool is_open, Overlay& overlay) {
    Drawer draw{overlay.lines};
    for (size_t i = 0; i < room.drawn.size() && i < room.outlines.size(); ++i) {
        const Marking& drawn = room.drawn[i];
        const bool is_selected = is_open && room.selected == i, is_pointed_at = is_open && room.hovered == i;
        const uint32_t rgb = k_colours[static_cast<size_t>(drawn.kind)];
        const uint32_t colour = is_selected || is_pointed_at ? ink(0xffffff) : ink(rgb);
        add_fill(drawn, room.fills[i], counts, overlay.fills);
        draw.stroke(room.outlines[i], colour, is_selected ? 3.5f : 2.5f);
        if (drawn.kind == MarkingKind::line) {
            const glm::vec3 middle = middle_of(room.outlines[i]), aside = right_of(drawn) * reach_of(drawn);
            for (const bool is_right : {true, false}) {
                Pen pen{.pixels = 2};
                pen.colour = ink(is_right ? k_right_rgb : k_left_rgb);
                add_arrow(draw.lines, pen, middle, is_right ? middle + aside : middle - aside, {0, 1, 0});
            }
        }
        if (!is_selected && drawn.kind != MarkingKind::distance) continue;
        for (size_t k = 0; k < drawn.points.size(); ++k) {
            const bool is_held = is_selected && room.handle == k;
            draw.point(drawn.points[k], is_held ? ink(0xffffff) : ink(rgb), is_selected ? 9.0f : 5.0f);
        }
    }
}

struct Box {
    ImVec2 low, high;
};
bool overlap(const Box& a, const Box& b) {
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

// Above its place, or a few rows higher or lower where others are there.
Box free_place(ImVec2 at, ImVec2 size, float apart, const std::vector<Box>& taken) {
    const float row = size.y + apart;
    for (const float rows : {0.0f, -1.0f, 1.0f, -2.0f, 2.0f, -3.0f, 3.0f}) {
        const Box box{{at.x, at.y + rows * row}, {at.x + size.x, at.y + rows * row + size.y}};
        if (std::none_of(taken.begin(), taken.end(), [&](const Box& b) { return overlap(box, b); }))
            return box;
    }
    return {at, {at.x + size.x, at.y + size.y}};
}

// Over a picture of that size, which begins at `left`.
void write_labels(const std::vector<Label>& labels, const Camera& camera, Size size, float left,
                  float scale) {
    if (labels.empty()) return;
    const auto width = static_cast<float>(std::max(size.width, 1)),
               height = static_cast<float>(std::max(size.height, 1));
    const glm::mat4 clip_from_world =
        make_view(camera, static_cast<uint32_t>(width), static_cast<uint32_t>(height)).clip_from_world;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 room{6 * scale, 3 * scale};
    std::vector<Box> taken;
    for (const Label& label : labels) {
        const glm::vec4 at = clip_from_world * glm::vec4(label.place + glm::vec3(0, 0.25f, 0), 1);
        if (at.w <= 0.05f || std::fabs(at.x) > at.w) continue;
        const ImVec2 words = ImGui::CalcTextSize(label.text.c_str());
        const ImVec2 whole{words.x + 2 * room.x, words.y + 2 * room.y};
        const ImVec2 corner{left + std::round((at.x / at.w * 0.5f + 0.5f) * width - whole.x / 2),
                            std::round((at.y / at.w * 0.5f + 0.5f) * height - whole.y - 5 * scale)};
        const Box box = free_place(corner, whole, 2 * scale, taken);
        taken.push_back(box);
        list.AddRectFilled(box.low, box.high, IM_COL32(27, 30, 34, 205), 4 * scale);
        list.AddText({box.low.x + room.x, box.low.y + room.y}, panel_colour(label.colour),
                     label.text.c_str());
    }
}

}  // namespace

void mark_measures(Show& show, Viewer& v, FrameInput& frame) {
    MeasureRoom& room = v.measure;
    if (!v.has_panels || (room.drawn.empty() && room.draft.empty() && !room.under)) return;
    const World& world = *show.loaded.world;
    if (room.outlines.size() != room.drawn.size()) {
        room.outlines.clear(), room.fills.clear(), room.walkable.clear();
        for (const Marking& drawn : room.drawn) {
            room.outlines.push_back(outline(world, drawn.points, is_closed(drawn.kind)));
            room.fills.push_back(drawn.kind == MarkingKind::zone ? fill(world, drawn.points)
                                                                 : std::vector<glm::vec3>());
            room.walkable.push_back(walkable_of(world, room.fills.back()));
        }
    }
    draw_kept(room, room.counts, v.room == Room::measure, show.overlay);
    if (room.tool) {
        Drawer draw{show.overlay.lines};
        const uint32_t colour = ink(k_colours[static_cast<size_t>(*room.tool)]);
        std::vector<glm::vec3> points = room.draft;
        if (room.under) points.push_back(*room.under);
        draw.stroke(outline(world, points, is_closed(*room.tool) && points.size() > 2), colour, 2.5f);
        for (const glm::vec3& p : points) draw.point(p, colour, 7);
    }
    frame.lines = show.overlay.lines;
    frame.fills = show.overlay.fills;
}

void mark_measures_beside(const Viewer& v, const Counts& counts, Overlay& overlay, FrameInput& frame) {
    if (!v.has_panels || v.measure.drawn.empty()) return;
    draw_kept(v.measure, counts, false, overlay);
    frame.lines = overlay.lines;
    frame.fills = overlay.fills;
}

void lay_out_labels(const Viewer& v, Size size, float scale) {
    if (!v.has_panels) return;
    const Size one = size_of_one(v, size);
    const auto right = static_cast<float>(size.width - one.width);
    auto write = [&](const Counts& counts, float left, bool with_draft) {
        std::vector<Label> labels;
        add_labels(v.measure, counts, labels);
        if (with_draft) add_draft_label(v.measure, labels);
        write_labels(labels, v.camera, one, left, scale);
    };
    write(v.measure.counts, 0, true);
    if (has_two(v)) write(v.time.beside ? v.time.beside->counts : v.measure.counts, right, false);
}

}  // namespace flaneur
