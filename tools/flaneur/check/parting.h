// Where two runs part: the first tick whose states differ, and in what.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/fields.h"

namespace flaneur {

// The fields that two programs both have, as indices of one's and the other's; and those that one has alone.
struct CommonFields {
    std::vector<std::pair<size_t, size_t>> walkers, crowd;
    std::vector<std::string> only_here, only_there;
};
CommonFields common_fields(const StateFields& here, const StateFields& there);
inline bool are_all(const CommonFields& c) { return c.only_here.empty() && c.only_there.empty(); }

// What is read of two states of one tick.
struct StatePair {
    const StateFields& fields_here;
    const StateFields& fields_there;
    const CommonFields& common;
};

// Whether two states, of equally many walkers, differ in anything that both have.
bool are_different(const StatePair& pair, const StateDigest& here, const StateDigest& there);

struct FieldDifference {
    StateField field;
    uint32_t walkers = 0;  // how many differ in it; 0: it is of the crowd as a whole, or nobody knows
    std::optional<uint32_t> walker{};         // the first of those who do
    std::optional<uint32_t> here{}, there{};  // its words, as far as they are known
};

struct Parting {
    uint32_t tick = 0;
    std::vector<FieldDifference> fields;  // in the order in which a tick makes them
    std::vector<uint32_t> walkers;        // by number
    bool knows_walkers = true;            // false: fields differ in number, and digests do not tell of whom
};

// By what two digests say: fields and walkers apart from each other.
Parting parting_of(const StatePair& pair, uint32_t tick, const StateDigest& here, const StateDigest& there);
// By all values, of so many walkers.
Parting parting_of(const StatePair& pair, uint32_t tick, uint32_t walkers, const std::vector<uint32_t>& here,
                   const std::vector<uint32_t>& there);

// "walker 12, gait.left.phase"
std::string told_first(const Parting& parting);
// The fields that one of the two has alone, as lines; "": none.
std::string told_alone(const CommonFields& common);
// All of it, as lines.
std::string told_parting(const Parting& parting, uint32_t walkers, const CommonFields& common);

}  // namespace flaneur
