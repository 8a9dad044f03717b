#include "tools/flaneur/gait/people/everyone.h"

#include <atomic>

#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {

namespace {

constexpr double k_seconds = 25, k_riser = 0.17, k_tread = 0.29, k_kerb = 0.12;

Body body_of(const Who& who) { return standard_body(static_cast<float>(usual_height(who))); }

Report try_trial(const Person& person, Trial trial, double speed) {
    switch (trial) {
        case Trial::level:
        case Trial::usual:
            return try_level(person, speed, k_seconds);
        case Trial::turn:
            return try_turn(person, speed, 180);
        case Trial::bends:
            return try_bends(person, speed);
        case Trial::stairs_up:
        case Trial::stairs_down:
            return try_stairs(person, speed, trial == Trial::stairs_up, k_riser, k_tread);
        case Trial::slope_up:
            return try_slope(person, speed, k_slope);
        case Trial::slope_down:
            return try_slope(person, speed, -k_slope);
        case Trial::kerb:
            break;
    }
    return try_kerb(person, speed, k_kerb);
}

Report try_task(const Who& who, const Task& task) {
    Person person{body_of(who), manner_of(who)};
    double speed = speed_of(who, task), leg = static_cast<double>(leg_length(person.body));
    Report report = try_trial(person, task.trial, speed);
    report.verdicts = judge(report.quantities, bars_of(who, leg, task.trial, speed));
    report.person = word_of(who);
    report.title = name_of(who) + ": " + report.title;
    if (task.trial == Trial::usual) report.name = "usual_" + report.name;
    if (who.style > 0) report.curves = {};
    return report;
}

}  // namespace

std::vector<Who> everyone() {
    std::vector<Who> people;
    for (Sex sex : {Sex::woman, Sex::man})
        for (double age : {4, 8, 14, 20, 40, 60, 80})
            for (uint64_t style = 0; style <= k_styles; ++style) people.push_back({sex, age, style});
    return people;
}

double speed_of(const Who& who, const Task& task) {
    auto leg = static_cast<double>(leg_length(body_of(who)));
    return task.share > 0 ? task.share * fastest_speed(who, leg) : liked_speed(who, leg);
}

Result<std::vector<Report>> try_everyone(const std::vector<Who>& people, Workers& workers) {
    std::vector<Report> reports(people.size() * k_task_count);
    std::atomic<size_t> done = 0;
    parallel_for(workers, reports.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end && !is_stopping(); ++i) {
            reports[i] = try_task(people[i / k_task_count], k_tasks[i % k_task_count]);
            show_progress("walking, " + std::to_string(++done) + " of " + std::to_string(reports.size()) +
                          " walks");
        }
    });
    clear_progress();
    if (is_stopping()) return interrupted();
    return reports;
}

}  // namespace flaneur
