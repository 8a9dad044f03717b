#include "tools/flaneur/check/parting.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <map>
#include <string_view>

#include "assets/files/file.h"

namespace flaneur {
namespace {

constexpr size_t k_most_rows = 16, k_most_walkers = 12;  // that are told one by one

using IndexPairs = std::vector<std::pair<size_t, size_t>>;

IndexPairs pairs_of(const std::vector<StateField>& here, const std::vector<StateField>& there,
                    CommonFields& common) {
    IndexPairs pairs;
    std::map<std::string_view, size_t> places;
    for (size_t i = 0; i < there.size(); ++i) places.emplace(there[i].name, i);
    for (size_t i = 0; i < here.size(); ++i) {
        const auto found = places.find(here[i].name);
        const bool is_common = found != places.end() && there[found->second].kind == here[i].kind;
        if (is_common)
            pairs.emplace_back(i, found->second);
        else
            common.only_here.push_back(here[i].name);
        if (is_common) places.erase(found);
    }
    for (const StateField& field : there)
        if (places.contains(field.name)) common.only_there.push_back(field.name);
    return pairs;
}

// By the order in which a tick makes them, what is constant first: who differs from the start differs in all
// that follows. Bodies turn before they move, feet carry what rides on them, and what the crowd is told of
// feet comes last. The longest beginning counts.
size_t stage_of(std::string_view name) {
    constexpr std::string_view k_stages[] = {
        "person.",        "who.",    "generation",   "journey.", "crowd.", "decision.",    "motion.turn_rate",
        "motion.heading", "motion.", "surface.",     "gait.x",   "gait.z", "gait.heading", "gait.left.",
        "gait.right.",    "gait.",   "motion.feet.", "cane.",    "pram.",  "pose.",        "idle."};
    size_t stage = std::size(k_stages), longest = 0;
    for (size_t i = 0; i < std::size(k_stages); ++i)
        if (k_stages[i].size() > longest && name.starts_with(k_stages[i]))
            stage = i, longest = k_stages[i].size();
    return stage;
}

void sort_by_stage(Parting& parting) {
    std::ranges::stable_sort(parting.fields, {},
                             [](const FieldDifference& d) { return stage_of(d.field.name); });
}

// 12 17 31 and 5 more
std::string told_walkers(const std::vector<uint32_t>& walkers) {
    std::string text;
    for (size_t i = 0; i < std::min(walkers.size(), k_most_walkers); ++i)
        text.append(i ? " " : "").append(std::to_string(walkers[i]));
    if (walkers.size() > k_most_walkers)
        text.append(" and ").append(std::to_string(walkers.size() - k_most_walkers)).append(" more");
    return text;
}

std::string told_names(const std::vector<std::string>& names) {
    std::string text;
    for (size_t i = 0; i < std::min(names.size(), k_most_rows); ++i)
        text.append(i ? ", " : "").append(excerpt(names[i]));
    if (names.size() > k_most_rows)
        text.append(" and ").append(std::to_string(names.size() - k_most_rows)).append(" more");
    return text;
}

std::string told_row(const FieldDifference& d) {
    auto value = [&](const std::optional<uint32_t>& word) {
        return word ? told_word(d.field, *word) : std::string("?");
    };
    char text[200];
    std::snprintf(text, sizeof text, "  %-36s %7s %7s  %14s %14s\n", excerpt(d.field.name).c_str(),
                  d.walkers ? std::to_string(d.walkers).c_str() : "",
                  d.walker ? std::to_string(*d.walker).c_str() : "", value(d.here).c_str(),
                  value(d.there).c_str());
    return text;
}

}  // namespace

CommonFields common_fields(const StateFields& here, const StateFields& there) {
    CommonFields common;
    common.walkers = pairs_of(here.walkers, there.walkers, common);
    common.crowd = pairs_of(here.crowd, there.crowd, common);
    return common;
}

bool are_different(const StatePair& pair, const StateDigest& here, const StateDigest& there) {
    if (are_all(pair.common)) return here.hash != there.hash;
    return !parting_of(pair, 0, here, there).fields.empty();
}

Parting parting_of(const StatePair& pair, uint32_t tick, const StateDigest& here, const StateDigest& there) {
    Parting parting;
    parting.tick = tick;
    for (const auto& [i, j] : pair.common.walkers)
        if (here.fields[i] != there.fields[j])
            parting.fields.push_back({.field = pair.fields_here.walkers[i]});
    const size_t after_here = pair.fields_here.walkers.size(), after_there = pair.fields_there.walkers.size();
    for (const auto& [i, j] : pair.common.crowd)
        if (here.fields[after_here + i] != there.fields[after_there + j])
            parting.fields.push_back({.field = pair.fields_here.crowd[i]});
    parting.knows_walkers = are_all(pair.common);
    if (parting.knows_walkers)
        for (uint32_t w = 0; w < here.walkers.size(); ++w)
            if (here.walkers[w] != there.walkers[w]) parting.walkers.push_back(w);
    // Where one walker differs, it is the one who differs in each field.
    if (parting.walkers.size() == 1)
        for (FieldDifference& d : parting.fields)
            if (!d.field.name.starts_with("crowd.")) d.walkers = 1, d.walker = parting.walkers[0];
    sort_by_stage(parting);
    return parting;
}

Parting parting_of(const StatePair& pair, uint32_t tick, uint32_t walkers, const std::vector<uint32_t>& here,
                   const std::vector<uint32_t>& there) {
    Parting parting;
    parting.tick = tick;
    const size_t row_here = pair.fields_here.walkers.size(), row_there = pair.fields_there.walkers.size();
    std::vector<bool> differs(walkers);
    for (const auto& [i, j] : pair.common.walkers) {
        FieldDifference d{.field = pair.fields_here.walkers[i]};
        for (uint32_t w = 0; w < walkers; ++w) {
            const uint32_t a = here[w * row_here + i], b = there[w * row_there + j];
            if (a == b) continue;
            if (d.walkers++ == 0) d.walker = w, d.here = a, d.there = b;
            differs[w] = true;
        }
        if (d.walkers > 0) parting.fields.push_back(d);
    }
    for (const auto& [i, j] : pair.common.crowd) {
        const uint32_t a = here[walkers * row_here + i], b = there[walkers * row_there + j];
        if (a != b) parting.fields.push_back({pair.fields_here.crowd[i], 0, {}, a, b});
    }
    for (uint32_t w = 0; w < walkers; ++w)
        if (differs[w]) parting.walkers.push_back(w);
    sort_by_stage(parting);
    return parting;
}

std::string told_first(const Parting& parting) {
    if (parting.fields.empty()) return "only their hashes tell, no field of anybody does";
    const FieldDifference& first = parting.fields[0];
    const std::string field = excerpt(first.field.name);
    if (first.walker) return "walker " + std::to_string(*first.walker) + ", " + field;
    return parting.walkers.empty() ? field : field + ", among walkers " + told_walkers(parting.walkers);
}

std::string told_alone(const CommonFields& common) {
    std::string told;
    if (!common.only_here.empty()) told += "Fields here alone: " + told_names(common.only_here) + "\n";
    if (!common.only_there.empty()) told += "Fields there alone: " + told_names(common.only_there) + "\n";
    return told;
}

std::string told_parting(const Parting& parting, uint32_t walkers, const CommonFields& common) {
    char text[160];
    std::snprintf(text, sizeof text, "The first difference is after tick %u, at %.3f s: ", parting.tick,
                  parting.tick / 60.0);
    std::string told = text + told_first(parting) + ".\n";
    const size_t fields = common.walkers.size() + common.crowd.size();
    if (parting.knows_walkers)
        std::snprintf(text, sizeof text, "There %zu of %u walkers differ, and %zu of %zu fields:\n",
                      parting.walkers.size(), walkers, parting.fields.size(), fields);
    else
        std::snprintf(text, sizeof text, "There %zu of %zu fields differ:\n", parting.fields.size(), fields);
    told += text;
    std::snprintf(text, sizeof text, "  %-36s %7s %7s  %14s %14s\n", "field", "walkers", "first", "here",
                  "there");
    if (!parting.fields.empty()) told += text;
    for (size_t i = 0; i < std::min(parting.fields.size(), k_most_rows); ++i)
        told += told_row(parting.fields[i]);
    if (parting.fields.size() > k_most_rows)
        told += "  and " + std::to_string(parting.fields.size() - k_most_rows) + " more\n";
    if (!parting.walkers.empty()) told += "Walkers: " + told_walkers(parting.walkers) + "\n";
    return told + told_alone(common);
}

}  // namespace flaneur
