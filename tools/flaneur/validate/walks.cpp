// Tests of few people: ways, stairs, times, speeds.
#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/validate/play.h"
#include "tools/flaneur/validate/tests.h"

namespace flaneur {
namespace {

ValidationFinding never(std::string what, const std::string& expected) {
    return {std::move(what), expected, "not there in time", Validity::missed};
}

// Stairs along +x between two landings; steps are Face risers.
struct Stairs {
    Arena arena;
    float run = 0, rise = 0;  // metres, of all steps
};

Stairs make_stairs() {
    constexpr float k_rise = 0.17f, k_tread = 0.29f, k_half = 1, k_landing = 4;
    constexpr int k_steps = 30;  // 10.08 m along the slope
    std::vector<FloorQuad> floors;
    std::vector<Face> risers;
    auto level = [&](float from, float to, float y, Surface kind) {
        floors.push_back({{{from, y, -k_half}, {from, y, k_half}, {to, y, k_half}, {to, y, -k_half}}, kind});
    };
    level(-k_landing, 0, 0, Surface::plaza);
    for (int i = 0; i < k_steps; ++i) {
        const float x = static_cast<float>(i) * k_tread, y = static_cast<float>(i) * k_rise;
        risers.push_back({{x, y, -k_half}, {x, y, k_half}, y + k_rise, y + k_rise, FaceKind::riser});
        if (i + 1 < k_steps) level(x, x + k_tread, y + k_rise, Surface::steps);
    }
    const float run = static_cast<float>(k_steps - 1) * k_tread, rise = static_cast<float>(k_steps) * k_rise;
    level(run, run + k_landing, rise, Surface::plaza);
    return {make_arena(floors, risers), run, rise};
}

// Seconds between two lines of x, to the tick.
std::optional<double> seconds_between(const Play& play, float from, float to) {
    std::optional<double> at_from, at_to;
    const bool east = to > from;
    for (const Sighting& s : play.tracks.sightings) {
        const double now = s.frame / wide(play.tracks.fps);
        if (!at_from && (east ? s.at.x >= from : s.at.x <= from)) at_from = now;
        if (!at_to && (east ? s.at.x >= to : s.at.x <= to)) at_to = now;
    }
    if (!at_from || !at_to) return std::nullopt;
    return *at_to - *at_from;
}

}  // namespace

Result<Findings> test_corridor(ValidationNotes&) {
    const Rectangle floor[] = {{{-1, -1}, {44, 1}}};
    const Guest guest{.from = {0, 0, 0},
                      .goal = {43, 0, 0},
                      .exit = {{40, -1}, {44, 1}},
                      .speed = 1.33f,
                      .heading = k_east};
    Result<Play> played = play(make_arena(floor), {&guest, 1}, {.seconds = 60});
    if (!played) return played.error();
    const std::optional<float> left = last_left(*played);
    if (!left) return Findings{never("time over 40 m", "26 - 34 s")};
    return Findings{within("time over 40 m", wide(*left), 26, 34, "s")};
}

Result<Findings> test_stairs(ValidationNotes&) {
    const Stairs stairs = make_stairs();
    const float low = 0.15f * stairs.run, middle = 0.5f * stairs.run, high = 0.85f * stairs.run;
    const double slope = std::hypot(wide(stairs.run), wide(stairs.rise)) / wide(stairs.run);
    Findings findings;
    double speeds[2] = {};
    for (const bool up : {true, false}) {
        Guest guest{
            .from = {-2, 0, 0}, .goal = {stairs.run + 3, stairs.rise, 0}, .speed = 1.34f, .heading = k_east};
        if (!up) std::swap(guest.from, guest.goal), guest.heading = -k_east;
        Result<Play> played = play(stairs.arena, {&guest, 1}, {.seconds = 40, .sample_ticks = 1});
        if (!played) return played.error();
        const std::string way = up ? "up" : "down";
        const auto first = seconds_between(*played, up ? low : high, middle);
        const auto second = seconds_between(*played, middle, up ? high : low);
        if (!first || !second) {
            findings.push_back(never("speed " + way, "0.55 - 0.8 m/s"));
            continue;
        }
        const double way_half = wide(middle - low) * slope;
        speeds[up ? 0 : 1] = 2 * way_half / (*first + *second);
        findings.push_back(within("speed along the slope, " + way, speeds[up ? 0 : 1], 0.55, 0.80, "m/s"));
        findings.push_back(
            within("second half of the stairs over the first, " + way, *first / *second, 0.9, 1.1, ""));
    }
    return findings;
}

Result<Findings> test_premovement(ValidationNotes&) {
    const Rectangle floors[] = {{{0, 0}, {8, 5}}, {{8, 2}, {12, 3}}};
    std::vector<Guest> guests;
    for (uint32_t i = 0; i < 10; ++i)
        guests.push_back({.from = {1.0f + 1.4f * static_cast<float>(i % 5), 0, i < 5 ? 1.2f : 3.8f},
                          .goal = {11.5f, 0, 2.5f},
                          .exit = {{8.5f, 2}, {12, 3}},
                          .heading = k_east,
                          .starts = random_between({5, i, 0, Purpose::pause}, 10, 100)});
    Result<Play> played = play(make_arena(floors), guests, {.seconds = 130});
    if (!played) return played.error();
    double earliest = 1e9, latest = -1e9;
    for (size_t i = 0; i < guests.size(); ++i) {
        const double late = wide(played->fates[i].moved.value_or(1e6f) - guests[i].starts);
        earliest = std::min(earliest, late);
        latest = std::max(latest, late);
    }
    return Findings{
        {"who sets off, after the own time", "0 - 2 s",
         short_number(earliest) + " - " + told_number(latest, "s"), verdict_of(earliest >= 0 && latest <= 2)},
        {"who gets out", "10 of 10", std::to_string(count_left(*played)) + " of 10",
         verdict_of(count_left(*played) == guests.size())}};
}

Result<Findings> test_corner(ValidationNotes&) {
    const Rectangle floors[] = {{{0, 0}, {12, 2}}, {{10, 2}, {12, 12}}};
    const Arena arena = make_arena(floors);
    std::vector<Guest> guests;
    for (const Vec2 place : spread({{0.4f, 0.4f}, {6, 1.6f}}, 20, 6))
        guests.push_back({.from = at_height(place, 0),
                          .goal = {11, 0, 11.5f},
                          .exit = {{10, 10}, {12, 12}},
                          .speed = weidmann_wish(6, static_cast<uint32_t>(guests.size())),
                          .heading = k_east});
    Result<Play> played = play(arena, guests, {.seconds = 90, .sample_ticks = 1});
    if (!played) return played.error();
    const auto outside = std::count_if(played->tracks.sightings.begin(), played->tracks.sightings.end(),
                                       [&](const Sighting& s) { return !is_on(arena, s.at); });
    return Findings{{"places behind a wall, of all after every tick", "0", std::to_string(outside),
                     verdict_of(outside == 0)},
                    {"who gets round", std::to_string(guests.size()) + " of " + std::to_string(guests.size()),
                     std::to_string(count_left(*played)) + " of " + std::to_string(guests.size()),
                     verdict_of(count_left(*played) == guests.size())}};
}

Result<Findings> test_ages(ValidationNotes&) {
    constexpr uint32_t k_people = 400;  // RiMEA asks for 50, whose means tell nothing by age
    constexpr float k_apart = 2.5f;
    const Rectangle floor[] = {{{-3, -2}, {26, k_apart * k_people + 2}}};
    PlayOptions options{.seconds = 45};
    options.kinds.clear();
    std::vector<Guest> guests;
    std::vector<float> ages;
    for (uint32_t i = 0; i < k_people; ++i) {
        const bool woman = i % 2 == 1;
        ages.push_back(20 + 60 * (static_cast<float>(i) + 0.5f) / k_people);
        options.kinds.push_back(
            {.body = standard_body(woman ? 1.65f : 1.78f), .age = ages.back(), .woman = woman});
        const float z = k_apart * static_cast<float>(i);
        guests.push_back({.from = {-2, 0, z},
                          .goal = {25, 0, z},
                          .exit = {{20, z - 3}, {26, z + 3}},
                          .speed = 0,
                          .heading = k_east,
                          .kind = i});
    }
    options.sample_ticks = 3;
    Result<Play> played = play(make_arena(floor), guests, options);
    if (!played) return played.error();
    // Over the last 20 m: nobody still sets off.
    std::vector<double> speeds(k_people, 0);
    std::vector<float> passed(k_people, -1);
    for (const Sighting& s : played->tracks.sightings)
        if (passed[s.id] < 0 && s.at.x >= 0) passed[s.id] = static_cast<float>(s.frame) / played->tracks.fps;
    double sum = 0, squares = 0, groups[3] = {}, counts[3] = {};
    for (uint32_t i = 0; i < k_people; ++i) {
        if (!played->fates[i].left || passed[i] < 0)
            return Findings{never("400 adults over 20 m", "all within 45 s")};
        speeds[i] = 20 / wide(*played->fates[i].left - passed[i]);
        sum += speeds[i];
        const auto group = static_cast<size_t>((ages[i] - 20) / 20);
        groups[group] += speeds[i];
        ++counts[group];
    }
    const double mean = sum / k_people;
    for (const double speed : speeds) squares += (speed - mean) * (speed - mean);
    for (size_t g = 0; g < 3; ++g) groups[g] /= counts[g];
    return Findings{
        within("mean speed (Weidmann: 1.34)", mean, 1.34 * 0.8, 1.34 * 1.2, "m/s"),
        within("its spread between people (Weidmann: 0.26)", std::sqrt(squares / (k_people - 1)), 0.13, 0.39,
               "m/s"),
        {"aged 20-40, 40-60, 60-80", "falling, to 0.05 m/s",
         short_number(groups[0]) + ", " + short_number(groups[1]) + ", " + told_number(groups[2], "m/s"),
         verdict_of(groups[0] >= groups[1] - 0.05 && groups[1] > groups[2])}};
}

}  // namespace flaneur
