// Tests of streams: the diagram, single file, both ways at once.
#include <algorithm>
#include <cmath>

#include "assets/measures/moments.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "tools/flaneur/plot/plot.h"
#include "tools/flaneur/validate/play.h"
#include "tools/flaneur/validate/tests.h"

namespace flaneur {
namespace {

// One crowd of the diagram: its mean in the measuring area, and how many a second cross the middle of that
// for each metre of width.
struct Stream {
    MeanFlow mean;
    double flow = 0;
};

Result<Stream> stream_at(double density) {
    constexpr float k_long = 60, k_wide = 5, k_low = 35, k_high = 45;
    constexpr double k_first = 8, k_last = 18;
    const Rectangle floor[] = {{{-1, 0}, {110, k_wide}}};
    const auto count = static_cast<size_t>(density * wide(k_long * k_wide));
    std::vector<Guest> guests;
    for (const Vec2 place : spread({{0, 0.25f}, {k_long, k_wide - 0.25f}}, count, 4))
        guests.push_back({.from = at_height(place, 0),
                          .goal = {109, 0, clamp(place.z, 0.5f, k_wide - 0.5f)},
                          .exit = {{100, 0}, {110, k_wide}},
                          .speed = weidmann_wish(4, static_cast<uint32_t>(guests.size())),
                          .heading = k_east});
    Result<Play> played =
        play(make_arena(floor), guests, {.seconds = static_cast<float>(k_last) + 0.5f, .sample_ticks = 6});
    if (!played) return played.error();
    Stream stream{mean_of(flow_samples(played->tracks, {{k_low, 0}, {k_high, k_wide}}, 1, k_first, k_last)),
                  0};
    const std::vector<double> crossings = crossings_at(played->tracks, (k_low + k_high) / 2);
    const auto crossed = std::count_if(crossings.begin(), crossings.end(),
                                       [](double at) { return at >= k_first && at < k_last; });
    stream.flow = static_cast<double>(crossed) / (k_last - k_first) / wide(k_wide);
    return stream;
}

constexpr float k_ring_radius = 26 / 6.2831853f;  // metres, of the middle of the way
constexpr int k_ring_sides = 48;

Vec2 on_ring(float angle, float radius = k_ring_radius) {
    const SinCos turned = sin_cos(wrap_angle(angle));
    return {radius * turned.sine, radius * turned.cosine};
}

// 0.8 m wide: who is 0.5 m wide cannot pass.
Arena make_ring() {
    constexpr float k_half = 0.4f;
    std::vector<FloorQuad> floors;
    for (int i = 0; i < k_ring_sides; ++i) {
        const float a = 6.2831853f * static_cast<float>(i) / k_ring_sides,
                    b = 6.2831853f * static_cast<float>((i + 1) % k_ring_sides) / k_ring_sides;
        floors.push_back({{at_height(on_ring(a, k_ring_radius - k_half), 0),
                           at_height(on_ring(a, k_ring_radius + k_half), 0),
                           at_height(on_ring(b, k_ring_radius + k_half), 0),
                           at_height(on_ring(b, k_ring_radius - k_half), 0)}});
    }
    return make_arena(floors);
}

// The mean speed, m/s, of so many who go round and round.
Result<double> ring_speed(const Arena& ring, uint32_t people) {
    constexpr double k_first = 20, k_last = 40;
    std::vector<Guest> guests;
    for (uint32_t i = 0; i < people; ++i) {
        const float angle = 6.2831853f * static_cast<float>(i) / static_cast<float>(people);
        guests.push_back({.from = at_height(on_ring(angle), 0),
                          .goal = at_height(on_ring(angle + 1.5f), 0),
                          .speed = 1.24f,
                          .heading = wrap_angle(angle + k_east)});
    }
    PlayOptions options{.seconds = static_cast<float>(k_last), .sample_ticks = 6};
    uint32_t tick = 0;
    // A goal that is a quarter of the way ahead, told anew each second, one after another.
    options.before_tick = [&](World& world, std::span<const WalkerId> ids) {
        for (size_t i = 0; i < ids.size(); ++i) {
            if ((tick + 7 * i) % 60 != 0 || tick == 0) continue;
            const auto motion = motion_of(world, ids[i]);
            if (!motion) continue;
            const float angle = std::atan2(motion->position.x, motion->position.z);
            (void)send_to(world, ids[i], at_height(on_ring(angle + 1.5f), 0));
        }
        ++tick;
    };
    Result<Play> played = play(ring, guests, options);
    if (!played) return played.error();
    // How far they came round, along the middle.
    std::vector<float> last(people, 0);
    std::vector<uint8_t> is_known(people, 0);
    double way = 0, seconds = 0;
    for (const Sighting& s : played->tracks.sightings) {
        const double now = s.frame / wide(played->tracks.fps);
        if (now < k_first) continue;
        const float angle = std::atan2(s.at.x, s.at.z);
        if (is_known[s.id]) {
            way += wide(wrap_angle(angle - last[s.id]) * k_ring_radius);
            seconds += 1 / wide(played->tracks.fps);
        }
        last[s.id] = angle;
        is_known[s.id] = 1;
    }
    return seconds > 0 ? way / seconds : 0;
}

// A. Seyfried et al., J. Stat. Mech. P10002, 2005: single file, metres a person = 0.36 + 1.06 v.
double single_file_speed(double per_metre) { return std::clamp((1 / per_metre - 0.36) / 1.06, 0.0, 1.24); }

// Christian Rex and Hartmut Loewen's measure of lanes, Phys. Rev. E 75, 2007: of each person who has others
// within 0.5 m to the side, the square of what share more of them go its way; 0 mixed, 1 in lanes.
double lanes_in(const Trajectories& tracks, const Rectangle& zone, uint32_t eastward) {
    double sum = 0, count = 0;
    const auto& all = tracks.sightings;
    for (size_t first = 0, last = 0; first < all.size(); first = last) {
        while (last < all.size() && all[last].frame == all[first].frame) ++last;
        uint32_t ways[2] = {};
        for (size_t i = first; i < last; ++i)
            if (is_in(zone, all[i].at)) ++ways[all[i].id < eastward];
        if (ways[0] < 3 || ways[1] < 3) continue;  // nothing to mix
        for (size_t i = first; i < last; ++i) {
            if (!is_in(zone, all[i].at)) continue;
            double same = 0, other = 0;
            for (size_t k = first; k < last; ++k) {
                if (!is_in(zone, all[k].at) || std::fabs(all[k].at.z - all[i].at.z) > 0.5f) continue;
                ((all[k].id < eastward) == (all[i].id < eastward) ? same : other) += 1;
            }
            sum += (same - other) * (same - other) / ((same + other) * (same + other));
            ++count;
        }
    }
    return count > 0 ? sum / count : 0;
}

// Of five who like 0.8 to 1.6 m/s, from the first to the last who is past 38 of 43 m, through a door of 1.2
// m; none: not all were. Together the fastest leads, waiting for the slowest, and the others follow.
Result<std::optional<double>> seconds_between_arrivals(bool together) {
    constexpr size_t k_people = 5;
    constexpr float k_line = 38, k_behind = 3;  // metres
    const Rectangle floors[] = {{{-4, -4}, {20, 4}}, {{20, -0.6f}, {21, 0.6f}}, {{21, -4}, {46, 4}}};
    std::vector<Guest> guests;
    for (size_t i = 0; i < k_people; ++i) {
        const float at = static_cast<float>(i);
        guests.push_back(
            {.from = {0, 0, at - 2}, .goal = {43, 0, at - 2}, .speed = 0.8f + 0.2f * at, .heading = k_east});
    }
    PlayOptions options{.seconds = 120, .sample_ticks = 6};
    bool are_told = !together;
    options.before_tick = [&](World& world, std::span<const WalkerId> ids) {
        if (are_told) return;
        const WalkerId first = ids.back(), last = ids.front();
        are_told = static_cast<bool>(let_lead(world, first, last, guests.back().goal, k_behind));
        for (const WalkerId id : ids.first(k_people - 1))
            are_told = are_told && static_cast<bool>(let_follow(world, id, first));
    };
    Result<Play> played = play(make_arena(floors), guests, options);
    if (!played) return played.error();
    std::optional<double> arrivals[k_people];
    for (const Sighting& s : played->tracks.sightings)
        if (!arrivals[s.id] && s.at.x > k_line) arrivals[s.id] = s.frame / wide(played->tracks.fps);
    double first = 1e9, last = 0;
    for (const std::optional<double>& arrival : arrivals) {
        if (!arrival) return std::optional<double>();
        first = std::min(first, *arrival), last = std::max(last, *arrival);
    }
    return std::optional(last - first);
}

}  // namespace

Result<Findings> test_diagram(ValidationNotes& notes) {
    Findings findings;
    notes.diagram.clear();
    bool falls = true;
    double last = 1e9;
    for (const double density : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0}) {
        Result<Stream> stream = stream_at(density);
        if (!stream) return stream.error();
        const MeanFlow& mean = stream->mean;
        notes.diagram.push_back(mean);
        falls = falls && mean.speed < last;
        last = mean.speed;
        const double wanted = weidmann_speed(mean.density), product = mean.density * mean.speed;
        const std::string at = "at " + told_number(mean.density, "/m2");
        if (mean.density <= 3.05)
            findings.push_back({"speed " + at, told_number(wanted, "m/s") + " +- 20 %",
                                told_number(mean.speed, "m/s"),
                                verdict_of(std::fabs(mean.speed / wanted - 1) <= 0.2)});
        findings.push_back({"people over a line " + at,
                            "density x speed, " + told_number(product, "/m/s") + " +- 15 %",
                            told_number(stream->flow, "/m/s"),
                            verdict_of(std::fabs(stream->flow - product) <= 0.15 * product + 0.03)});
    }
    findings.push_back(
        {"speed over density", "falling", falls ? "falling" : "not falling throughout", verdict_of(falls)});
    return findings;
}

Result<Findings> test_ring(ValidationNotes&) {
    const Arena ring = make_ring();
    Findings findings;
    double last = 1e9;
    bool falls = true;
    for (const uint32_t people : {13u, 20u, 26u, 33u, 39u, 45u}) {
        const double density = people / 26.0;
        Result<double> speed = ring_speed(ring, people);
        if (!speed) return speed.error();
        falls = falls && *speed < last + 0.02;
        last = *speed;
        const double wanted = single_file_speed(density);
        findings.push_back(
            {"speed at " + told_number(density, "/m"),
             short_number(std::max(0.0, wanted - 0.2)) + " - " + told_number(wanted + 0.2, "m/s"),
             told_number(*speed, "m/s"), verdict_of(std::fabs(*speed - wanted) <= 0.2)});
    }
    findings.push_back(
        {"speed over density", "falling", falls ? "falling" : "not falling throughout", verdict_of(falls)});
    return findings;
}

Result<Findings> test_counterflow(ValidationNotes&) {
    const Rectangle floors[] = {{{0, -5}, {10, 5}}, {{10, -1}, {20, 1}}, {{20, -5}, {30, 5}}};
    const Rectangle corridor{{10, -1}, {20, 1}};
    Findings findings;
    float last = 0;
    bool rises = true;
    double lanes = 0;
    for (const uint32_t others : {0u, 10u, 50u, 100u}) {
        std::vector<Guest> guests;
        for (const Vec2 place : spread({{0.5f, -4.5f}, {8, 4.5f}}, 100, 28))
            guests.push_back({.from = at_height(place, 0),
                              .goal = {29, 0, place.z},
                              .exit = {{26, -5}, {30, 5}},
                              .heading = k_east});
        for (const Vec2 place : spread({{22, -4.5f}, {25.5f, 4.5f}}, others, 29))
            guests.push_back({.from = at_height(place, 0),
                              .goal = {1, 0, place.z},
                              .exit = {{0, -5}, {4, 5}},
                              .heading = -k_east});
        for (size_t i = 0; i < guests.size(); ++i)
            guests[i].speed = weidmann_wish(28, static_cast<uint32_t>(i));
        Result<Play> played = play(make_arena(floors), guests, {.seconds = 240, .sample_ticks = 30});
        if (!played) return played.error();
        const bool all = count_left(*played) == guests.size();
        findings.push_back(
            {"100 against " + std::to_string(others), "all get through within 240 s",
             all ? told_number(wide(*last_left(*played)), "s")
                 : std::to_string(count_left(*played)) + " of " + std::to_string(guests.size()),
             verdict_of(all)});
        rises = rises && all && *last_left(*played) >= last - 1;
        last = last_left(*played).value_or(1e9f);
        if (others == 50) lanes = lanes_in(played->tracks, corridor, 100);
    }
    findings.push_back(
        {"time over those who come against", "rising", rises ? "rising" : "not rising", verdict_of(rises)});
    findings.push_back({"lanes of 100 against 50 (0 mixed, 1 lanes)", ">= 0.5", short_number(lanes),
                        verdict_of(lanes >= 0.5)});
    return findings;
}

Result<Findings> test_groups(ValidationNotes&) {
    Findings findings;
    for (const bool together : {false, true}) {
        Result<std::optional<double>> between = seconds_between_arrivals(together);
        if (!between) return between.error();
        const bool all = between->has_value();
        const double seconds = between->value_or(0);
        findings.push_back({together ? "arrivals of a group" : "arrivals of the same, each alone",
                            together ? "within 10 s of each other" : "more than 15 s apart",
                            all ? "within " + told_number(seconds, "s") : "not all got there",
                            verdict_of(all && (together ? seconds <= 10 : seconds > 15))});
    }
    return findings;
}

}  // namespace flaneur
