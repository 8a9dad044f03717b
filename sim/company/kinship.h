// Who would go with whom, and groups that begin and end. Private to sim/company.
#pragma once

#include "sim/company/company.h"

namespace flaneur {

// What one is to another with whom it goes.
enum class Kin : uint8_t { spouse, friends, parent, child };
inline constexpr float k_couples = 0.55f;  // of pairs of grown people; judged
inline constexpr float k_unfit = 40;       // from which on one does not fit

// How little one fits who would be that to the other, in years. Friends and couples are about as old
// (McPherson, Smith-Lovin & Cook, Annual Review of Sociology 27, 2001), friends rather of one sex; parents
// are some thirty years older than children.
float misfit(const Folk& one, const Folk& other, Kin kin);

// How many of all people are to be in groups of each size, still.
using Quota = std::array<float, k_most_company>;
// The size of one, of `least` at least.
uint32_t draw_size(const Quota& quota, uint32_t least, RandomKey key);

// One of nobody, to be filled. It is where it is until the next one is asked for.
Group& vacant_group(Company& company);
inline uint32_t number_of(const Company& company, const Group& group) {
    return static_cast<uint32_t>(&group - company.groups.data());
}

// They go together from now on, in this order, and who leads goes on about its errand.
Group& begin_group(Company& company, Crowd& crowd, std::span<const Folk> folk, std::span<const WalkerId> who,
                   uint32_t leader, uint64_t seed);
// One more, at the end where it stands or that is nearer.
void add_member(Company& company, Crowd& crowd, std::span<const Folk> folk, Group& group, WalkerId who,
                uint64_t seed);
// One goes by itself from now on, and wanders.
void leave_group(Company& company, Crowd& crowd, Group& group, uint32_t member, std::span<const Folk> folk);
// All do.
void end_group(Company& company, Crowd& crowd, Group& group, std::span<const Folk> folk);

inline bool has_a_hand(const Bearing& bearing) { return bearing.holds != k_nobody; }

}  // namespace flaneur
