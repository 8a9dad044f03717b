// Tests of crowds that leave rooms.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/validate/play.h"
#include "tools/flaneur/validate/tests.h"

namespace flaneur {
namespace {

// "131 s", or how many are out at the end.
std::string told_leaving(const Play& play) {
    if (const std::optional<float> left = last_left(play)) return told_number(wide(*left), "s");
    return std::to_string(count_left(play)) + " of " + std::to_string(play.fates.size()) + " within " +
           told_number(wide(play.seconds), "s");
}

// A door of 1 m in a wall, with floor behind it.
struct Exit {
    Vec2 middle, out;  // unit
};

Result<Play> leave_room(std::span<const Exit> exits, float seconds) {
    std::vector<Rectangle> floors{{{0, 0}, {30, 20}}};
    for (const Exit& e : exits) {
        const Vec2 side{std::fabs(e.out.z) * 0.5f, std::fabs(e.out.x) * 0.5f}, far = e.middle + e.out * 3;
        const Vec2 a = e.middle - side, b = far + side, c = e.middle + side, d = far - side;
        floors.push_back({{std::min({a.x, b.x, c.x, d.x}), std::min({a.z, b.z, c.z, d.z})},
                          {std::max({a.x, b.x, c.x, d.x}), std::max({a.z, b.z, c.z, d.z})}});
    }
    std::vector<Guest> guests;
    for (const Vec2 place : spread({{0.5f, 0.5f}, {29.5f, 19.5f}}, 1000, 9)) {
        const Exit& near = *std::min_element(exits.begin(), exits.end(), [&](const Exit& a, const Exit& b) {
            return length_squared(a.middle - place) < length_squared(b.middle - place);
        });
        const Vec2 goal = near.middle + near.out * 2.6f, past = near.middle + near.out * 0.5f;
        const Vec2 reach{near.out.x != 0 ? 3.0f : 1.0f, near.out.z != 0 ? 3.0f : 1.0f};
        // All beyond half a metre behind the door.
        Rectangle exit{past - reach, past + reach};
        if (near.out.x > 0) exit.low.x = past.x;
        if (near.out.x < 0) exit.high.x = past.x;
        if (near.out.z > 0) exit.low.z = past.z;
        if (near.out.z < 0) exit.high.z = past.z;
        guests.push_back({.from = at_height(place, 0),
                          .goal = at_height(goal, 0),
                          .exit = exit,
                          .speed = weidmann_wish(9, static_cast<uint32_t>(guests.size()))});
    }
    return play(make_arena(floors), guests, {.seconds = seconds});
}

// A room of 10 x 10 m whose way out is a neck in the middle of a wall.
struct Neck {
    float width = 1, length = 1;
};

Result<Play> leave_by(const Neck& neck) {
    const float half = neck.width / 2, end = 10 + neck.length;
    const Rectangle floors[] = {{{0, -5}, {10, 5}}, {{10, -half}, {end, half}}, {{end, -5}, {end + 5, 5}}};
    std::vector<Guest> guests;
    for (const Vec2 place : spread({{0.4f, -4.6f}, {9, 4.6f}}, 150, 12))
        guests.push_back({.from = at_height(place, 0),
                          .goal = {end + 4, 0, 0},
                          .exit = {{end + 0.5f, -5}, {end + 5, 5}},
                          .speed = weidmann_wish(12, static_cast<uint32_t>(guests.size())),
                          .heading = k_east});
    return play(make_arena(floors), guests, {.seconds = 240});
}

// People a second between the twentieth who is out and the hundred and twentieth; none: that one never is.
std::optional<double> flow_of(const Play& play) {
    constexpr size_t k_first = 20, k_last = 120;
    std::vector<float> out;
    for (const GuestFate& fate : play.fates)
        if (fate.left) out.push_back(*fate.left);
    std::sort(out.begin(), out.end());
    if (out.size() < k_last || out[k_last - 1] <= out[k_first - 1]) return std::nullopt;
    return static_cast<double>(k_last - k_first) / wide(out[k_last - 1] - out[k_first - 1]);
}

}  // namespace

Result<Findings> test_exits(ValidationNotes&) {
    const Exit exits[] = {{{0, 5}, {-1, 0}}, {{30, 15}, {1, 0}}, {{0, 15}, {-1, 0}}, {{30, 5}, {1, 0}}};
    constexpr float k_patience = 240;  // seconds, some twice of what is usual
    Result<Play> four = leave_room(exits, k_patience);
    if (!four) return four.error();
    const std::optional<float> many = last_left(*four);
    Findings findings{{"four exits", "all get out", told_leaving(*four), verdict_of(many.has_value())}};
    constexpr const char *k_what = "two exits over four", *k_expected = "1.7 - 2.3";
    if (!many) {
        findings.push_back({k_what, k_expected, "not tried, as four are jammed", Validity::missed});
        return findings;
    }
    Result<Play> two = leave_room({exits, 2}, 2.5f * *many);
    if (!two) return two.error();
    findings.push_back(
        {"two exits", "all get out", told_leaving(*two), verdict_of(last_left(*two).has_value())});
    if (const std::optional<float> few = last_left(*two))
        findings.push_back(within(k_what, wide(*few / *many), 1.7, 2.3, ""));
    else
        findings.push_back({k_what, k_expected, "above 2.5", Validity::missed});
    return findings;
}

Result<Findings> test_bottleneck(ValidationNotes&) {
    Findings findings;
    std::vector<double> widths, flows;
    for (const float width : {0.8f, 1.2f, 1.6f, 2.0f, 2.4f}) {
        Result<Play> played = leave_by({width, 1});
        if (!played) return played.error();
        const std::string what = "flow through " + told_number(wide(width), "m");
        if (const std::optional<double> flow = flow_of(*played)) {
            findings.push_back(within(what, *flow / wide(width), 1.5, 2.3, "/m/s"));
            widths.push_back(wide(width));
            flows.push_back(*flow);
        } else {
            findings.push_back({what, "1.5 - 2.3 /m/s", told_leaving(*played), Validity::missed});
        }
    }
    // How much of the flows' variance a straight line explains.
    const auto n = static_cast<double>(widths.size());
    double w = 0, f = 0, ww = 0, wf = 0, ff = 0;
    for (size_t i = 0; i < widths.size(); ++i) {
        w += widths[i], f += flows[i];
        ww += widths[i] * widths[i], wf += widths[i] * flows[i], ff += flows[i] * flows[i];
    }
    const double across = n * wf - w * f, spread_w = n * ww - w * w, spread_f = n * ff - f * f;
    const double explained = n >= 3 && spread_f > 0 ? across * across / (spread_w * spread_f) : 0;
    const bool grows = across > 0 && std::is_sorted(flows.begin(), flows.end());
    findings.push_back({"flow over width is a line", "growing, r2 >= 0.95",
                        std::string(grows ? "growing" : "not growing") + ", r2 " + short_number(explained),
                        verdict_of(widths.size() == 5 && grows && explained >= 0.95)});
    Result<Play> shorter = leave_by({1, 1});
    if (!shorter) return shorter.error();
    Result<Play> longer = leave_by({1, 5});
    if (!longer) return longer.error();
    findings.push_back({"a neck 1 m wide: 1 m long, 5 m long", "the longer one is slower",
                        told_leaving(*shorter) + ", " + told_leaving(*longer),
                        verdict_of(last_left(*shorter) && last_left(*longer) &&
                                   *last_left(*longer) > *last_left(*shorter))});
    return findings;
}

Result<Findings> test_large_corner(ValidationNotes&) {
    // Ahead of the crowd, which stands 30 m long: 10 m, then 20 m after the corner by its inner wall.
    constexpr float k_front = 30, k_inner = 30, k_outer = k_inner + 12;
    const std::vector<Vec2> places = spread({{0.4f, 0.4f}, {k_front, 5.6f}}, 500, 15);
    auto run = [&](const std::vector<Rectangle>& floors, Vec3 goal, Rectangle exit) {
        std::vector<Guest> guests;
        guests.reserve(places.size());
        for (const Vec2 place : places)
            guests.push_back({.from = at_height(place, 0),
                              .goal = goal,
                              .exit = exit,
                              .speed = weidmann_wish(15, static_cast<uint32_t>(guests.size())),
                              .heading = k_east});
        return play(make_arena(floors), guests, {.seconds = 240});
    };
    auto straight = [&](float way) {
        const float exit = k_front + way;
        return run({{{0, 0}, {exit + 5, 6}}}, {exit + 4, 0, 3}, {{exit, 0}, {exit + 5, 6}});
    };
    Result<Play> inner = straight(k_inner);
    if (!inner) return inner.error();
    Result<Play> corner = run({{{0, 0}, {46, 6}}, {{40, 6}, {46, 31}}}, {43, 0, 30}, {{40, 26}, {46, 31}});
    if (!corner) return corner.error();
    Result<Play> outer = straight(k_outer);
    if (!outer) return outer.error();
    const auto a = last_left(*inner), b = last_left(*corner), c = last_left(*outer);
    return Findings{{"straight, corner, straight by the outer way", "rising",
                     told_leaving(*inner) + ", " + told_leaving(*corner) + ", " + told_leaving(*outer),
                     verdict_of(a && b && c && *a < *b && *b < *c)}};
}

}  // namespace flaneur
