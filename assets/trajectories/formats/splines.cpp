// .vsp of the crowds by example of the University of Cyprus: for each person some points in pixels about the
// middle of a film of 25 frames a second, which are joined by straight lines.
#include <cmath>

#include "assets/files/words.h"
#include "assets/trajectories/formats.h"

namespace flaneur {
namespace {

constexpr double k_film = 25;  // frames a second

struct SplineText {
    std::string_view rest;
    size_t line = 0;

    // The numbers that a line begins with, of which there must be `wanted`.
    bool numbers(double* to, size_t wanted) {
        std::string_view row;
        do {
            if (rest.empty()) return false;
            const size_t end = rest.find('\n');
            row = rest.substr(0, end);
            rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
            ++line;
        } while (row.find_first_not_of(" \t\r") == std::string_view::npos);
        size_t found = 0;
        for (const std::string_view word : split(row, ' ')) {
            if (word.empty()) continue;
            if (found == wanted || !parse_number(word, to[found])) break;
            ++found;
        }
        return found == wanted;
    }
};

}  // namespace

Result<FoundTracks> parse_splines(const TrajectorySource& source) {
    FoundTracks found;
    found.format = "splines of UCY";
    found.is_in_pixels = true;
    SplineText text{source.text};
    auto broken = [&](const char* what) {
        return Error{"has in line " + std::to_string(text.line) + " no " + what};
    };
    double people = 0, points = 0;
    if (!text.numbers(&people, 1) || !(people >= 0 && people < 1e6)) return broken("number of splines");
    for (int64_t person = 0; person < static_cast<int64_t>(people); ++person) {
        if (!text.numbers(&points, 1) || !(points >= 0 && points < 1e6)) return broken("number of points");
        for (int64_t i = 0; i < static_cast<int64_t>(points); ++i) {
            double at[3] = {};
            if (!text.numbers(at, 3)) return broken("\"x y frame\"");
            Result<void> added = add_row(
                found,
                {.time = at[2] / k_film, .x = at[0], .y = at[1], .who = who_is(found, person), .facing = {}});
            if (!added) return Error{"has " + added.error().message};
        }
    }
    found.assumed.push_back("25 frames a second, as UCY filmed.");
    return found;
}

}  // namespace flaneur
