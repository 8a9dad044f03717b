// How values on the command line are read.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "tools/flaneur/options/options.h"
#include "tools/flaneur/options/spelling.h"

namespace flaneur {

// Whether `text` is a number, which `to` then is; of one beyond all doubles, infinite.
static bool is_number(std::string_view text, double& to) {
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
    if (error == std::errc::result_out_of_range) to = std::numeric_limits<double>::infinity();
    return error != std::errc::invalid_argument && end == text.data() + text.size();
}

Result<PeopleShare> parse_people(const std::string& text) {
    PeopleShare people{text};
    size_t colon = text.rfind(':');
    double share = 0;
    if (colon != std::string::npos && is_number(std::string_view(text).substr(colon + 1), share)) {
        people.character.resize(colon);
        people.share = static_cast<float>(share);
        if (!(share >= k_least_share && share <= k_most_share))
            return Error{excerpt(people.character) + excerpt(text.substr(colon)) +
                         " has a share that is not from 0.001 to 1000"};
    }
    if (people.character.empty()) return Error{excerpt(text) + " names no file"};
    if (people.character == "builtin") people.character.clear();
    return people;
}

Result<Moments> parse_moments(const std::string& text) {
    size_t colon = std::min(text.find(':'), text.size());
    std::string_view from = std::string_view(text).substr(0, colon),
                     to = std::string_view(text).substr(std::min(colon + 1, text.size()));
    Moments moments;
    if (is_number(from, moments.first) && is_number(to, moments.last) && moments.first >= 0 &&
        moments.last > moments.first && moments.last <= k_longest_walk)
        return moments;
    return Error{excerpt(text) + " is not seconds as FROM:TO, such as 0.5:3, of a walk of 600 at most"};
}

Result<Techniques> parse_without(const std::string& text) {
    std::vector<std::string> known;
    known.reserve(k_techniques.size());
    for (const TechniqueInfo& technique : k_techniques) known.emplace_back(technique.name);
    Techniques techniques;
    if (text == "none") return techniques;
    for (const std::string_view name : split(text, ',')) {
        if (name.empty()) return Error{excerpt(text) + " has a comma that no technique stands beside"};
        const auto* found = std::ranges::find(k_techniques, name, &TechniqueInfo::name);
        if (found == k_techniques.end())
            return Error{excerpt(std::string(name)) + " is no technique; there are " + joined(known) + "." +
                         did_you_mean(name, known)};
        techniques.*found->is_on = false;
    }
    return techniques;
}

Techniques usual_techniques(LimbLead limbs) {
    Techniques techniques;
    techniques.gait = limbs == LimbLead::gait;
    return techniques;
}

std::string told_without(Techniques techniques, LimbLead limbs) {
    if (techniques == usual_techniques(limbs)) return "";
    if (techniques == Techniques{}) return "none";
    std::string text;
    for (const TechniqueInfo& technique : k_techniques)
        if (!(techniques.*technique.is_on)) text.append(text.empty() ? "" : ",").append(technique.name);
    return text;
}

Result<uint64_t> parse_seed(const std::string& text) {
    uint64_t seed = 0;
    if (parse_number(text, seed)) return seed;
    return Error{excerpt(text) + " is not a whole number from 0 to 18446744073709551615"};
}

Result<WalkerRange> parse_walkers(const std::string& text) {
    const size_t colon = text.find(':');
    auto whole = [](std::string_view number, double low, double high, uint32_t& to) {
        double value = 0;
        if (!is_number(number, value) || !(value >= low && value <= high) || value != std::floor(value))
            return false;
        to = static_cast<uint32_t>(value);
        return true;
    };
    WalkerRange range;
    if (colon == std::string::npos) {
        if (!whole(text, 0, k_max_walkers, range.first))
            return Error{excerpt(text) + " is not a whole number from 0 to " + std::to_string(k_max_walkers)};
        range.last = range.first;
        return range;
    }
    const std::string_view view = text;
    if (!whole(view.substr(0, colon), 1, k_most_swept, range.first) ||
        !whole(view.substr(colon + 1), 1, k_most_swept, range.last) || range.first >= range.last)
        return Error{excerpt(text) + " is not FIRST:LAST, rising whole numbers from 1 to " +
                     std::to_string(k_most_swept)};
    return range;
}

Result<std::vector<WalkerRange>> parse_who(const std::string& text) {
    std::vector<WalkerRange> who;
    for (const std::string_view part : split(text, ',')) {
        const std::vector<std::string_view> ends = split(part, ':');
        WalkerRange range;
        if (ends.size() > 2 || !parse_number(ends.front(), range.first) ||
            !parse_number(ends.back(), range.last) || range.first > range.last)
            return Error{excerpt(text) + " says not who: numbers and ranges of them, such as 3,7,10:20"};
        who.push_back(range);
    }
    return who;
}

Result<TickRange> parse_ticks(const std::string& text) {
    auto parts = split(text, ':');
    uint64_t first = 0, last = 0, step = 1;
    bool good = parts.size() <= 3 && parse_number(parts[0], first);
    last = first;
    if (good && parts.size() > 1) good = parse_number(parts[1], last);
    if (good && parts.size() > 2) good = parse_number(parts[2], step) && step > 0;
    if (!good) return Error{excerpt(text) + " is not a tick (600) or a range of ticks (0:600 or 0:600:2)"};
    if (first > last) return Error{excerpt(text) + " ends before it begins"};
    if (last > k_last_tick || step > k_last_tick)
        return Error{excerpt(text) + " goes beyond tick 10000000, 46 hours of simulated time"};
    TickRange ticks{static_cast<uint32_t>(first), static_cast<uint32_t>(last), static_cast<uint32_t>(step)};
    return ticks;
}

Result<Shard> parse_shard(const std::string& text) {
    const auto parts = split(text, '/');
    Shard shard;
    const bool is_shard = parts.size() == 2 && parse_number(parts[0], shard.number) &&
                          parse_number(parts[1], shard.of) && shard.number >= 1 && shard.number <= shard.of &&
                          shard.of <= k_most_shards;
    if (is_shard) return shard;
    return Error{excerpt(text) + " is no part such as 3/8, the third of eight; there are 100000 at most"};
}

}  // namespace flaneur
