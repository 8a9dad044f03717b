#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <functional>

#include "assets/files/file.h"
#include "sim/base/hash.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/gait/cane.h"
#include "tools/flaneur/gait/crowd.h"
#include "tools/flaneur/gait/people/table.h"
#include "tools/flaneur/gait/report.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/motion/bvh.h"
#include "tools/flaneur/motion/glb.h"
#include "tools/flaneur/output/film.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/sheets/strip.h"
#include "tools/flaneur/sheets/take.h"

namespace flaneur {

namespace {

Who who_of(const GaitOptions& gait) { return {gait.sex, gait.age, gait.style}; }
double height_of(const GaitOptions& gait) {
    return gait.height > 0 ? gait.height : usual_height(who_of(gait));
}
Person person_of(const GaitOptions& gait) {
    auto height = static_cast<float>(height_of(gait));
    Person person{standard_body(height), manner_of(who_of(gait))};
    if (gait.cane) person.body.cane = standard_cane(height);
    if (gait.pram) person.body.pram = standard_pram(person.body);
    person.body.wear = {gait.bag, true};
    free_hands(person.manner, who_of(gait), gait);
    person.draws = gait.style;
    return person;
}
double speed_of(const GaitOptions& gait) {
    if (gait.speed > 0) return gait.speed;
    return liked_speed(who_of(gait), static_cast<double>(leg_length(person_of(gait).body)));
}

std::vector<Report> every_trial(const Person& person, double speed, const GaitOptions& gait) {
    std::vector<Report> reports{try_level(person, speed, gait.seconds)};
    for (double other : {0.95, 1.5, 0.6}) reports.push_back(try_level(person, other, gait.seconds));
    const bool is_free = !gait.cane && !gait.pram;
    if (is_free) {
        for (double other : {2.2, 2.6, 3.1, 4.0, 5.0})
            reports.push_back(try_level(person, other, gait.seconds));
        reports.push_back(try_gaits(person));
        reports.push_back(try_change(person, speed));
    }
    reports.push_back(try_turn(person, speed, 180));
    reports.push_back(try_bends(person, speed));
    for (double on_level : {speed, 3.0}) {
        if (gait.pram || (gait.cane && on_level != speed)) continue;
        for (bool up : {true, false})
            reports.push_back(try_stairs(person, on_level, up, gait.riser, gait.tread));
    }
    if (is_free) reports.push_back(try_stand(person, 60));
    for (double percent : {8.0, -8.0}) reports.push_back(try_slope(person, speed, percent));
    reports.push_back(try_kerb(person, speed, 0.12));
    if (is_free)
        for (bool runs : {false, true})
            reports.push_back(try_leap(person, runs ? 3 : speed, runs ? 1.2 : 0.65));
    return reports;
}

std::vector<Report> chosen_trials(const Person& person, double speed, const GaitOptions& gait) {
    if (gait.stand > 0) return {try_stand(person, gait.stand)};
    if (gait.turn != 0) return {try_turn(person, speed, gait.turn)};
    if (!gait.stairs.empty()) return {try_stairs(person, speed, gait.stairs == "up", gait.riser, gait.tread)};
    if (gait.slope != 0) return {try_slope(person, speed, gait.slope)};
    if (gait.kerb != 0) return {try_kerb(person, speed, gait.kerb)};
    if (gait.leap != 0) return {try_leap(person, speed, gait.leap)};
    if (gait.check) return every_trial(person, speed, gait);
    return {try_level(person, speed, gait.seconds)};
}

std::vector<Report> try_person(const GaitOptions& gait) {
    double height = height_of(gait), speed = speed_of(gait);
    Person person = person_of(gait);
    std::printf("%s of %g years, %.2f m tall, leg %.2f m, %s manner\n",
                gait.sex == Sex::woman ? "A woman" : "A man", gait.age, height,
                static_cast<double>(leg_length(person.body)),
                gait.style == 0 ? "the middle" : ("style " + std::to_string(gait.style) + " of").c_str());
    std::vector<Report> reports = chosen_trials(person, speed, gait);
    for (Report& report : reports) report.person = word_of(who_of(gait));
    return reports;
}

// A body and what it did.
struct Recording {
    Body body;
    std::vector<JointPoses> ticks;
};

// Of the one who walks as asked.
Recording one_motion(const GaitOptions& gait) {
    Person person = person_of(gait);
    Recording motion{person.body, {}};
    Take take = make_take(gait, person, speed_of(gait), gait.seconds);
    for (const Instant& now : take.walk.ticks) motion.ticks.push_back(now.joints);
    return motion;
}

void add_tick(Recording& motion, const World& world, size_t walker) {
    if (motion.ticks.empty())
        motion.body = scaled_body(world.kinds[world.crowd.identity.body[walker]].body,
                                  world.crowd.identity.scale[walker]);
    JointPoses& poses = motion.ticks.emplace_back();
    for (size_t j = 0; j < k_joint_count; ++j)
        poses[j] = joint_pose(world.poses, walker, static_cast<Joint>(j));
}

// The crowd of the built-in city, or of the one that the scene names. Keeps the motion of one of them.
Result<Report> try_crowd(const Options& options, Recording& motion) {
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    World& world = *loaded->world;
    // Where people come and go by ways that are known, each way is watched by itself.
    const Traced& traced = world.traced;
    std::vector<WalkerWatch> watches(is_on(traced) ? traced.traces->ways.size() : world.crowd.count);
    auto ticks = static_cast<uint32_t>(std::lround(options.gait.seconds / static_cast<double>(k_tick)));
    while (world.tick < ticks) {
        if (is_stopping()) return interrupted();
        step(world);
        if (!options.gait.motion.empty()) add_tick(motion, world, static_cast<size_t>(options.gait.walker));
        parallel_for(*world.workers, world.crowd.count, 16, [&](size_t begin, size_t end, int) {
            for (size_t i = begin; i < end; ++i)
                watch_walker(watches[is_on(traced) ? traced.way_of[i] : i], world, i);
        });
        if (world.tick % 60 == 0) {
            show_progress("watching, " + std::to_string(world.tick / 60) + " s of " +
                          std::to_string(ticks / 60) + " s");
        }
    }
    clear_progress();
    for (const std::string& line : worst_places(watches)) std::printf("%s.\n", line.c_str());
    return judge_crowd(watches, world, city_name(options.scene));
}

// A file that is opened before anything is walked, and its text, or bytes, once all is.
struct Paper {
    const std::string& path;  // empty: not asked for
    std::function<std::string()> text;
    PartFilePtr file{};
};

Result<void> write(Paper& paper) { return write_file(std::move(paper.file), paper.text()); }

}  // namespace

Result<void> run_gait(const Options& options) {
    const GaitOptions& gait = options.gait;
    const bool is_glb = has_ending(gait.motion, ".glb");
    if (!gait.motion.empty() && !is_glb && !has_ending(gait.motion, ".bvh") && !is_stream(gait.motion))
        return Error{"--export writes a .bvh or a .glb, which " + gait.motion + " is not called."};
    if (!gait.posture.empty() &&
        std::ranges::find(k_posture_names, gait.posture) == std::end(k_posture_names))
        return Error{"--posture knows no '" + gait.posture + "': see --help."};
    const double fastest = fastest_with_cane(person_of(gait).body);
    if ((gait.cane || gait.pram) && speed_of(gait) > fastest) {
        char most[16];
        std::snprintf(most, sizeof most, "%.1f", std::floor(10 * fastest) / 10);
        return Error{std::string(gait.cane ? "--cane" : "--pram") +
                     " is for walks, and at that --speed this person runs: say " + std::string(most) +
                     " at most."};
    }
    if (gait.pram && (gait.cane || !gait.stairs.empty()))
        return Error{"Who pushes a --pram has no --cane, and takes no --stairs."};
    if (!gait.strip.empty() && !has_ending(gait.strip, ".png") && !is_film(gait.strip) &&
        !is_stream(gait.strip))
        return Error{"--strip draws a .png or an .mp4, which " + gait.strip + " is not called."};
    const auto as_file = is_glb ? motion_glb : bvh_text;
    std::vector<Report> reports;
    Recording motion;
    Paper papers[] = {
        {gait.csv, [&] { return reports_csv(reports); }},
        {options.json, [&] { return reports_json(reports); }},
        {gait.svg, [&] { return curves_svg(reports.front()); }},
        {gait.motion, [&] { return as_file(motion.body, motion.ticks, 1 / static_cast<double>(k_tick)); }}};
    for (Paper& paper : papers) {
        if (paper.path.empty()) continue;
        Result<PartFilePtr> file = open_file(paper.path);
        if (!file) return file.error();
        paper.file = std::move(*file);
    }
#ifdef FLANEUR_VULKAN
    if (!gait.strip.empty()) {
        Result<void> drawn = draw_strip(options, height_of(gait), speed_of(gait), person_of(gait).manner);
        if (!drawn) return drawn;
    }
#endif
    if (gait.everyone) {
        std::vector<Who> people = everyone();
        Result<std::vector<Report>> all = try_everyone(people, *make_workers(options.threads));
        if (!all) return all.error();
        reports = std::move(*all);
        print_table(people, reports);
        print_misses(misses_of(people, reports));
    } else if (gait.crowd > 0) {
        Result<Report> crowd = try_crowd(options, motion);
        if (!crowd) return crowd.error();
        reports.push_back(std::move(*crowd));
    } else {
        reports = try_person(gait);
        if (!gait.motion.empty()) motion = one_motion(gait);
    }
    int failed = 0, bars = 0;
    for (const Report& r : reports) {
        if (!gait.everyone) print_report(r, reports.size() == 1);
        failed += failed_count(r);
        bars += static_cast<int>(r.verdicts.size());
    }
    std::printf("\n%d of %d bars met.\n", bars - failed, bars);
    // One word for all that was walked, to compare machines by.
    uint64_t poses = 0;
    for (const Report& r : reports) poses = mix(poses ^ r.poses);
    if (gait.crowd == 0) std::printf("Poses %016" PRIx64 ".\n", poses);
    for (Paper& paper : papers) {
        if (!paper.file) continue;
        if (Result<void> done = write(paper); !done) return done;
    }
    if (!gait.check || failed == 0) return {};
    return Error{std::to_string(failed) + " of " + std::to_string(bars) + " bars are not met; " +
                 (gait.everyone ? "the list above names them." : "the lines above that say FAIL name them.")};
}

}  // namespace flaneur
