#include "tools/flaneur/gait/people/table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "tools/flaneur/gait/report.h"

namespace flaneur {

namespace {

struct Column {
    const char* title;
    size_t first, count;  // tasks
};
constexpr Column k_columns[] = {{"0.6", 0, 1},     {"0.7", 1, 1},   {"0.8", 2, 1},
                                {"0.9", 3, 1},     {"1.0", 4, 1},   {"usual", 5, 1},
                                {"turn", 6, 1},    {"bends", 7, 1}, {"stairs", 8, 2},
                                {"slopes", 10, 2}, {"kerb", 12, 1}, {"all", 0, k_task_count}};

const char* place_of(Trial trial) {
    switch (trial) {
        case Trial::level:
        case Trial::usual:
            return "level";
        case Trial::turn:
            return "turn";
        case Trial::bends:
            return "bends";
        case Trial::stairs_up:
            return "stairs up";
        case Trial::stairs_down:
            return "stairs down";
        case Trial::slope_up:
            return "slope up";
        case Trial::slope_down:
            return "slope down";
        case Trial::kerb:
            break;
    }
    return "kerb";
}

// How far beyond its bar, in widths of the bar, or of its one bound.
double excess(const Verdict& v) {
    if (!v.measured || !std::isfinite(v.value)) return k_open;
    double beyond = std::max({v.bar.low - v.value, v.value - v.bar.high, 0.0});
    bool is_closed = v.bar.low > -k_open && v.bar.high < k_open;
    double width =
        is_closed ? v.bar.high - v.bar.low : std::fabs(v.bar.low > -k_open ? v.bar.low : v.bar.high);
    return width > 0 ? beyond / width : beyond;
}

struct Score {
    int met = 0, asked = 0;
};

std::string score_text(Score score) { return std::to_string(score.met) + "/" + std::to_string(score.asked); }

void print_row(const std::string& who, const Score (&scores)[std::size(k_columns)]) {
    std::printf("%-16s", who.c_str());
    for (const Score& score : scores) std::printf(" %9s", score_text(score).c_str());
    std::printf("\n");
}

void add(Score& score, const std::vector<Report>& reports, size_t first, const Column& column) {
    for (size_t i = first + column.first; i < first + column.first + column.count; ++i) {
        score.asked += static_cast<int>(reports[i].verdicts.size());
        score.met += static_cast<int>(reports[i].verdicts.size()) - failed_count(reports[i]);
    }
}

bool is_of_the_same(const Who& a, const Who& b) { return a.sex == b.sex && a.age == b.age && b.style > 0; }

}  // namespace

std::vector<Miss> misses_of(const std::vector<Who>& people, const std::vector<Report>& reports) {
    std::map<std::pair<std::string, std::string>, Miss> misses;
    std::map<std::pair<std::string, std::string>, std::set<std::string>> asked, missing;
    for (size_t i = 0; i < reports.size(); ++i) {
        const Who& who = people[i / k_task_count];
        const Task& task = k_tasks[i % k_task_count];
        std::string person = word_of({who.sex, who.age, 0});
        for (const Verdict& v : reports[i].verdicts) {
            auto key = std::make_pair(std::string(place_of(task.trial)), std::string(v.bar.quantity));
            Miss& miss = misses[key];
            asked[key].insert(person);
            ++miss.of_walks;
            if (v.pass) continue;
            missing[key].insert(person);
            ++miss.walks;
            if (miss.walks > 1 && excess(v) <= excess(miss.worst)) continue;
            miss.worst = v;
            char speed[32];
            std::snprintf(speed, sizeof speed, ", %.2f m/s", speed_of(who, task));
            miss.whose = name_of(who) + speed;
        }
    }
    std::vector<Miss> found;
    for (auto& [key, miss] : misses) {
        if (miss.walks == 0) continue;
        miss.place = key.first;
        miss.quantity = key.second;
        miss.people = static_cast<int>(missing[key].size());
        miss.of_people = static_cast<int>(asked[key].size());
        found.push_back(std::move(miss));
    }
    std::stable_sort(found.begin(), found.end(), [](const Miss& a, const Miss& b) {
        return a.people != b.people ? a.people > b.people : a.walks > b.walks;
    });
    return found;
}

void print_table(const std::vector<Who>& people, const std::vector<Report>& reports) {
    std::printf("%-16s", "");
    for (const Column& column : k_columns) std::printf(" %9s", column.title);
    std::printf("\n");
    for (size_t i = 0; i < people.size();) {
        // A middle manner is a row; the styles after it are one together.
        size_t end = i + 1;
        while (people[i].style > 0 && end < people.size() && is_of_the_same(people[i], people[end])) ++end;
        Score scores[std::size(k_columns)];
        for (size_t c = 0; c < std::size(k_columns); ++c)
            for (size_t k = i; k < end; ++k) add(scores[c], reports, k * k_task_count, k_columns[c]);
        print_row(people[i].style == 0 ? name_of(people[i]) : "  " + std::to_string(end - i) + " styles",
                  scores);
        i = end;
    }
}

void print_misses(const std::vector<Miss>& misses) {
    if (misses.empty()) return;
    std::printf("\n%8s %10s  %-12s %-27s %10s   %-18s %s\n", "people", "walks", "on", "miss", "worst", "bar",
                "whose");
    for (const Miss& m : misses) {
        std::printf("%8s %10s  %-12s %-27s %10s   %-18s %s\n", score_text({m.people, m.of_people}).c_str(),
                    score_text({m.walks, m.of_walks}).c_str(), m.place.c_str(), m.quantity.c_str(),
                    measured_text(m.worst).c_str(), bar_text(m.worst.bar).c_str(), m.whose.c_str());
    }
}

}  // namespace flaneur
