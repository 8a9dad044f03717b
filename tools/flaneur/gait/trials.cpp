#include "tools/flaneur/gait/trials.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>

#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/gait/curves/norms.h"
#include "tools/flaneur/gait/cane.h"
#include "tools/flaneur/gait/measure/contact.h"
#include "tools/flaneur/gait/measure/limits.h"
#include "tools/flaneur/gait/measure/running.h"
#include "tools/flaneur/gait/measure/stance.h"
#include "tools/flaneur/gait/measure/transients.h"

namespace flaneur {

namespace {

constexpr double k_stand = 1;  // seconds before walking
constexpr double k_never = 1e9;
constexpr double k_settle = 4;  // seconds from standing to a steady walk

std::string text(const char* format, double a, double b = 0) {
    char buffer[96];
    std::snprintf(buffer, sizeof buffer, format, a, b);
    return buffer;
}

// For so many seconds at a speed.
Ground flat_ground(double speed, double seconds) {
    return ground_of(level_course(static_cast<float>(speed * seconds)));
}

Vec2 onward(double speed) { return {0, static_cast<float>(speed)}; }

size_t tick_at(const Walk& w, double seconds) { return static_cast<size_t>(seconds * w.rate); }

// The first tick at which the root is past z.
size_t tick_past(const Walk& w, float z) {
    size_t t = 0;
    while (t < w.ticks.size() && w.ticks[t].root.z < z) ++t;
    return t;
}

Report finished(Report report, const std::vector<Bar>& bars) {
    report.verdicts = judge(report.quantities, bars);
    return report;
}

// Takes those bars of `bars` away and says so.
template <class Applies>
void leave_out(Report& report, std::vector<Bar>& bars, const char* why, Applies&& is_of_these) {
    LeftOut out{{}, why};
    for (const Bar& bar : bars)
        if (is_of_these(std::string_view(bar.quantity))) out.quantities.push_back(bar.quantity);
    if (out.quantities.empty()) return;
    std::erase_if(bars, [&](const Bar& bar) { return is_of_these(std::string_view(bar.quantity)); });
    report.left_out.push_back(std::move(out));
}

bool is_of_arms(std::string_view name) {
    return name.starts_with("upper_arm") || name.starts_with("elbow") || name.starts_with("arm_") ||
           name == "jerk_wrist.m_s3";
}

// Norms of people who turn as they like, while a pram turns no faster than its axle rolls round.
constexpr const char* k_pushes_no_pram = "the norms are of people who push no pram";
bool is_of_free_turns(std::string_view name) {
    return name == "turn.s" || name == "turn_peak.deg_s" || name == "turn_least_speed.m_s" ||
           name == "bend_exponent";
}

// Of one who has a cane, its bars too.
Report finished(Report report, std::vector<Bar> bars, const Person& person, bool is_level) {
    if (person.body.cane != Vec3{})
        for (const Bar& bar : cane_bars(is_level)) bars.push_back(bar);
    if (person.body.pram != Vec3{}) leave_out(report, bars, k_pushes_no_pram, is_of_free_turns);
    return finished(std::move(report), bars);
}

// Steady walking between two ticks, its curves and quantities.
Report steady(const Walk& w, size_t first, size_t last) {
    Level level = measure_level(w, first, last);
    return {"", "", level.curves, level.quantities, {}, w.hash};
}

// The greater of each, of the same quantities in the same order, or of none yet.
void keep_most(Quantities& most, const Quantities& more) {
    if (most.empty()) most = more;
    for (size_t q = 0; q < more.size(); ++q) most[q].value = std::max(most[q].value, more[q].value);
}

}  // namespace

Report try_level(const Person& person, double speed, double seconds) {
    double stop = seconds - 3;
    Walk w = walk(flat_ground(speed, seconds), person, seconds,
                  [&](double t) { return onward(t >= k_stand && t < stop ? speed : 0); });
    Level level = measure_level(w, tick_at(w, k_stand + k_settle), tick_at(w, stop));
    Report r{"", "", level.curves, level.quantities, {}, w.hash};
    append(r.quantities, measure_fall(w, tick_at(w, k_stand + k_settle), tick_at(w, stop)));
    append(r.quantities, measure_start(w, tick_at(w, k_stand), speed));
    append(r.quantities, measure_stop(w, tick_at(w, stop)));
    append(r.quantities, measure_body(w, tick_at(w, k_stand)));
    append(r.quantities, measure_cane(w, tick_at(w, k_stand)));
    r.name = text("level_%.2f", speed);
    r.title = text("Level ground, %.2f m/s", speed);
    std::vector<Bar> bars = level_bars(speed, static_cast<double>(leg_length(person.body)));
    if (!level.has_free_arm)
        leave_out(r, bars, "both hands hold something, and arms that do swing little", is_of_arms);
    return finished(std::move(r), std::move(bars), person, true);
}

Report try_stand(const Person& person, double seconds) {
    Walk w = walk(flat_ground(0, seconds), person, seconds, [](double) { return Vec2{}; });
    Report r;
    r.name = "stand";
    r.title = text("Standing, %.0f s", seconds);
    r.quantities = measure_body(w, tick_at(w, k_stand));
    append(r.quantities, measure_stance(w, tick_at(w, k_stand)));
    r.poses = w.hash;
    // After a walk, with time for the last step and for the weight to go to one leg.
    constexpr double k_stop = 4, k_seconds = 12, k_stands = 8;
    Walk stop = walk(flat_ground(1.3, k_seconds), person, k_seconds,
                     [](double t) { return onward(t > k_stand && t < k_stop ? 1.3 : 0); });
    r.quantities.push_back(
        {"stop_knee.deg", value_of(measure_stance(stop, tick_at(stop, k_stands)), "stand_knee.deg")});
    // Others of that body.
    std::vector<Quantities> people;
    for (uint32_t i = 1; i <= 24; ++i) {
        Person other{person.body, draw_manner(person.manner, {i, 0, 0, Purpose::style}), person.draws + i};
        Walk stands = walk(flat_ground(0, k_settle), other, k_settle, [](double) { return Vec2{}; });
        people.push_back(measure_stance(stands, tick_at(stands, k_stand)));
    }
    append(r.quantities, measure_stances(people));
    return finished(std::move(r), stand_bars());
}

Report try_turn(const Person& person, double speed, double degrees) {
    Vec2 after = turned_by(degrees, speed);
    double asked = k_stand + k_settle, seconds = asked + 6;
    Walk w = walk(flat_ground(speed, seconds), person, seconds, [&](double t) {
        return t < k_stand ? Vec2{} : t < asked ? onward(speed) : after;
    });
    Report r;
    r.poses = w.hash;
    r.quantities = measure_turn(w, tick_at(w, asked));
    append(r.quantities, measure_contact(w, strides(w, tick_at(w, asked - 1), tick_at(w, asked + 5))));
    append(r.quantities, measure_body(w, tick_at(w, k_stand)));
    append(r.quantities, measure_cane(w, tick_at(w, k_stand)));
    r.name = text("turn_%.0f", degrees);
    r.title = text("Turn by %.0f degrees at %.2f m/s", degrees, speed);
    return finished(std::move(r), turn_bars(degrees), person, true);
}

Report try_bends(const Person& person, double speed) {
    Quantities body;
    // A line through (log curvature, log speed) by least squares.
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    constexpr double k_seconds = k_stand + 20;
    uint64_t poses = 0;
    for (double rate : {0.7, 0.9, 1.1, 1.3, 1.5}) {
        Walk w = walk(flat_ground(speed, k_seconds), person, k_seconds, [&](double t) {
            double angle = std::max(0.0, t - k_stand - 2) * rate;
            Vec2 way = heading_direction(
                wrap_angle(static_cast<float>(std::remainder(angle, 2 * std::numbers::pi))));
            return t < k_stand ? Vec2{} : way * static_cast<float>(speed);
        });
        poses = mix(poses ^ w.hash);
        // One whole turn of the circle, of the pelvis.
        size_t last = w.ticks.size() - 1;
        size_t first = last - static_cast<size_t>(std::lround(2 * std::numbers::pi / rate * w.rate));
        double way = 0;
        for (size_t t = first; t < last; ++t) {
            way += static_cast<double>(
                length(on_ground(place(w.ticks[t + 1], hips)) - on_ground(place(w.ticks[t], hips))));
        }
        double v = way / (static_cast<double>(last - first) / w.rate);
        double a = std::log(rate / v), b = std::log(v);
        keep_most(body, measure_body(w, tick_at(w, k_stand)));
        ++n, x += a, y += b, xx += a * a, xy += a * b;
    }
    Report r{"bends", text("Bends at %.2f m/s", speed), {}, {}, {}, poses};
    r.quantities.push_back({"bend_exponent", (n * xy - x * y) / (n * xx - x * x)});
    append(r.quantities, body);
    std::vector<Bar> bars = bends_bars();
    if (person.body.pram != Vec3{}) leave_out(r, bars, k_pushes_no_pram, is_of_free_turns);
    return finished(std::move(r), bars);
}

Report try_stairs(const Person& person, double speed, bool up, double riser, double tread) {
    // Who runs has room to; on the level everybody goes at that speed.
    const bool runs = runs_on_stairs(person, speed);
    const float k_begin = runs ? 9 : 3;
    auto rise = static_cast<float>(up ? riser : -riser), run = static_cast<float>(tread);
    Ground ground = ground_of(stairs_course(k_begin, rise, run));
    Walk w = walk(ground, person, 40, [&](double t) { return onward(t < k_stand ? 0 : speed); });
    Report r = steady(w, tick_past(w, k_begin + 4 * run), tick_past(w, k_begin + (k_flight_steps - 4) * run));
    double stairs = 0, odd = 0, steps = 0, leg = static_cast<double>(leg_length(person.body));
    bool both = sets_both_feet(leg_length(person.body));
    for (const MeasuredStride& s :
         strides(w, tick_past(w, k_begin + 4 * run), tick_past(w, k_begin + 30 * run))) {
        const Instant& a = w.ticks[static_cast<size_t>(s.begin + 0.2 * (s.end - s.begin))];
        const Instant& b = w.ticks[static_cast<size_t>(s.begin + 0.7 * (s.end - s.begin))];
        Side other = s.side == k_left ? k_right : k_left;
        double ascent = static_cast<double>(b.feet[other].sole.ball.y - a.feet[s.side].sole.ball.y);
        double climbed = std::fabs(ascent) / riser;
        stairs += climbed;
        odd += std::fabs(climbed - 1) > 0.1 && !(both && std::fabs(climbed) < 0.1);
        ++steps;
    }
    if (steps > 0) {
        append(r.quantities, {{"stairs_a_step", stairs / steps}, {"odd_steps.pct", 100 * odd / steps}});
    }
    append(r.quantities,
           runs ? measure_body(w, tick_past(w, k_begin - 0.6f), tick_past(w, k_begin + k_flight_steps * run))
                : measure_body(w, tick_at(w, k_stand)));
    append(r.quantities, measure_cane(w, tick_at(w, k_stand)));
    r.name = up ? "stairs_up" : "stairs_down";
    if (runs) r.name += "_run";
    r.title = text(up ? "Stairs up, risers of %.2f and treads of %.2f m"
                      : "Stairs down, risers of %.2f and treads of %.2f m",
                   riser, tread);
    if (runs) r.title += text(", at a run of %.1f m/s", speed);
    return finished(std::move(r), runs ? stairs_run_bars(up) : stairs_bars(up, leg), person, false);
}

Report try_slope(const Person& person, double speed, double percent) {
    constexpr float k_begin = 3;
    Ground ground = ground_of(slope_course(k_begin, static_cast<float>(percent / 100)));
    Walk w = walk(ground, person, 40, [&](double t) { return onward(t < k_stand ? 0 : speed); });
    Report r = steady(w, tick_past(w, k_begin + 4), tick_past(w, k_begin + 40));
    append(r.quantities, measure_body(w, tick_at(w, k_stand)));
    append(r.quantities, measure_cane(w, tick_at(w, k_stand)));
    Report level = try_level(person, speed, 15);
    r.poses = mix(r.poses ^ level.poses);
    double here = value_of(r.quantities, "speed.m_s"), there = value_of(level.quantities, "speed.m_s");
    r.quantities.push_back({"speed.against_level", here / there});
    r.quantities.push_back(
        {"knee_contact.against_level",
         value_of(r.quantities, "knee_contact.deg") - value_of(level.quantities, "knee_contact.deg")});
    r.name = percent > 0 ? "slope_up" : "slope_down";
    r.title = text("Slope of %.0f %%, %.2f m/s", percent, speed);
    return finished(std::move(r), slope_bars(percent), person, false);
}

Report try_kerb(const Person& person, double speed, double height) {
    // At twelve distances, so that the kerb comes at every part of a step.
    Report r;
    for (int i = 0; i < 12; ++i) {
        float begin = 6 + 0.11f * static_cast<float>(i);
        Ground ground = ground_of(kerb_course(begin, static_cast<float>(height)));
        Walk w = walk(ground, person, 14, [&](double t) { return onward(t < k_stand ? 0 : speed); });
        r.poses = mix(r.poses ^ w.hash);
        Quantities here = measure_contact(w, strides(w, tick_past(w, begin - 2), tick_past(w, begin + 7)));
        append(here, measure_body(w, tick_at(w, k_stand)));
        append(here, measure_cane(w, tick_at(w, k_stand)));
        keep_most(r.quantities, here);
    }
    r.name = "kerb";
    r.title = text("A kerb of %.2f m up and down, %.2f m/s", height, speed);
    return finished(std::move(r), kerb_bars(), person, false);
}

Report try_leap(const Person& person, double speed, double width) {
    // Asked for at twelve times, at every part of a step.
    Report r;
    double shortest = k_never, narrowest = k_never;
    for (int i = 0; i < 12; ++i) {
        double asked = k_stand + k_settle + 0.1 * i;
        Walk w = walk(
            flat_ground(speed, 12), person, asked + 4,
            [&](double t) { return onward(t < k_stand ? 0 : speed); }, asked);
        r.poses = mix(r.poses ^ w.hash);
        size_t first = tick_at(w, asked), last = w.ticks.size();
        Quantities here = measure_contact(w, strides(w, first, last));
        append(here, measure_body(w, first));
        append(here, measure_leap(w, first));
        shortest = std::min(shortest, value_of(here, "flight.s"));
        narrowest = std::min(narrowest, value_of(here, "leapt.m"));
        keep_most(r.quantities, here);
    }
    append(r.quantities, {{"flight_least.s", shortest}, {"leapt_least.m", narrowest}});
    r.name = text("leap_%.2f", speed);
    r.title = text("A leap over %.2f m at %.2f m/s", width, speed);
    return finished(std::move(r), leap_bars(width));
}

Report try_change(const Person& person, double speed) {
    constexpr double k_faster = k_stand + k_settle, k_slower = k_faster + 6, k_seconds = k_slower + 5;
    double leg = static_cast<double>(leg_length(person.body)), run = 3.1 * std::sqrt(leg / 0.9);
    Walk w = walk(flat_ground(run, k_seconds), person, k_seconds, [&](double t) {
        return onward(t < k_stand ? 0 : t > k_faster && t < k_slower ? run : speed);
    });
    Report r;
    r.poses = w.hash;
    r.name = "change";
    r.title = text("From a walk at %.2f m/s to a run at %.2f m/s and back", speed, run);
    r.quantities = measure_change(w, tick_at(w, k_faster), w.ticks.size());
    append(r.quantities, measure_contact(w, strides(w, tick_at(w, k_faster), w.ticks.size())));
    append(r.quantities, measure_body(w, tick_at(w, k_faster)));
    return finished(std::move(r), change_bars());
}

Report try_gaits(const Person& person) {
    Report r{"gaits", "From walk to run", {}, {}, {}, 0};
    for (int i = 16; i <= 28; ++i) {
        double speed = i / 10.0;
        Report level = try_level(person, speed, 14);
        r.poses = mix(r.poses ^ level.poses);
        if (value_of(level.quantities, "double_support.pct") >= 0) continue;
        r.quantities.push_back({"run_from.m_s", speed});
        double leg = static_cast<double>(leg_length(person.body));
        r.quantities.push_back({"run_from.froude", speed * speed / (static_cast<double>(k_gravity) * leg)});
        break;
    }
    return finished(std::move(r), gaits_bars());
}

}  // namespace flaneur
