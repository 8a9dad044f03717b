// What all readers share: who is who, rows, words of time and kind.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assets/files/words.h"
#include "assets/trajectories/formats.h"

namespace flaneur {
namespace {

constexpr double k_latest = 1e19;  // nanoseconds since 1970 are fewer

// Days after 1970-01-01 of the Gregorian calendar.
int64_t days_after_1970(int64_t year, int64_t month, int64_t day) {
    year -= month <= 2;
    const int64_t era = year / 400, of_era = year - era * 400;
    const int64_t of_year = (153 * (month + (month > 2 ? -3 : 9)) + 2) / 5 + day - 1;
    return era * 146'097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719'468;
}

// "12:30:15.2" as seconds.
std::optional<double> seconds_of_day(std::string_view text) {
    const std::vector<std::string_view> parts = split(text, ':');
    double seconds = 0;
    if (parts.size() < 2 || parts.size() > 3) return std::nullopt;
    for (const std::string_view part : parts) {
        double number = 0;
        if (!parse_number(part, number) || !(number >= 0 && number < 1000)) return std::nullopt;
        seconds = seconds * 60 + number;
    }
    return parts.size() == 2 ? seconds * 60 : seconds;
}

uint32_t intern_name(FoundTracks& found, std::string_view name) {
    const auto known = found.number_of_name.find(name);
    if (known != found.number_of_name.end()) return known->second;
    const auto number = static_cast<uint32_t>(found.names.size());
    found.names.emplace_back(name);
    found.number_of_name.emplace(name, number);
    return number;
}

}  // namespace

uint32_t who_is(FoundTracks& found, std::string_view name) {
    // As rows of one person lie together, or not.
    if (!found.rows.empty() && found.names[found.rows.back().who] == name) return found.rows.back().who;
    double number = 0;
    if (name.find_first_of(".eE") != std::string_view::npos && parse_number(name, number) &&
        std::fabs(number) < 1e15 && number == std::floor(number))
        return who_is(found, static_cast<int64_t>(number));
    return intern_name(found, name);
}

uint32_t who_is(FoundTracks& found, int64_t number) {
    char text[24];
    return intern_name(found, {text, std::to_chars(text, text + sizeof text, number).ptr});
}

Result<void> add_row(FoundTracks& found, const FoundRow& row) {
    if (!std::isfinite(row.x) || !std::isfinite(row.y) || !std::isfinite(row.z) ||
        !(std::fabs(row.time) < k_latest)) {
        ++found.left_out;
        return {};
    }
    if (found.rows.size() >= k_most_sightings)
        return Error{"more than " + std::to_string(k_most_sightings) + " positions, which are too many"};
    found.rows.push_back(row);
    return {};
}

std::optional<double> seconds_of_moment(std::string_view text) {
    if (text.size() < 10 || text[4] != '-' || text[7] != '-') return seconds_of_day(text);
    int64_t year = 0, month = 0, day = 0;
    if (!parse_number(text.substr(0, 4), year) || !parse_number(text.substr(5, 2), month) ||
        !parse_number(text.substr(8, 2), day) || year < 1 || month < 1 || month > 12 || day < 1 || day > 31)
        return std::nullopt;
    const auto days = static_cast<double>(days_after_1970(year, month, day));
    text.remove_prefix(10);
    if (text.empty()) return days * 86'400;
    if (text[0] != 'T' && text[0] != 't' && text[0] != ' ') return std::nullopt;
    text.remove_prefix(1);
    double zone = 0;
    if (text.ends_with('Z') || text.ends_with('z')) {
        text.remove_suffix(1);
    } else if (const size_t sign = text.find_first_of("+-"); sign != std::string_view::npos) {
        std::string_view offset = text.substr(sign + 1);
        double hours = 0;
        if (const std::optional<double> seconds = seconds_of_day(offset))
            zone = *seconds;
        else if (parse_number(offset.substr(0, 2), hours) && hours >= 0)
            zone = hours * 3600;
        else
            return std::nullopt;
        if (text[sign] == '-') zone = -zone;
        text = text.substr(0, sign);
    }
    const std::optional<double> seconds = seconds_of_day(text);
    if (!seconds) return std::nullopt;
    return days * 86'400 + *seconds - zone;
}

TrackedKind kind_of_word(std::string_view word) {
    std::string small(word.substr(0, 64));
    std::transform(small.begin(), small.end(), small.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    auto has = [&](std::string_view part) { return small.find(part) != std::string::npos; };
    if (has("ped") || has("person") || has("human")) return TrackedKind::person;
    if (has("bicycl") || has("bike") || has("cyclist")) return TrackedKind::bicycle;
    if (has("tram") || has("rail")) return TrackedKind::tram;
    if (has("bus") || has("coach")) return TrackedKind::bus;
    if (has("van") || has("truck") || has("trailer") || has("delivery")) return TrackedKind::van;
    if (has("car") || has("taxi") || has("passenger") || has("vehicle")) return TrackedKind::car;
    return TrackedKind::person;
}

std::string short_number(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    std::string shortened = text;
    if (shortened.find('.') != std::string::npos) {
        shortened.erase(shortened.find_last_not_of('0') + 1);
        if (shortened.ends_with('.')) shortened.pop_back();
    }
    return shortened;
}

}  // namespace flaneur
