#include <array>
#include <string_view>

#include "sim/base/spans.h"
#include "sim/pastimes/pastimes.h"

namespace flaneur {

namespace {

constexpr std::array<std::string_view, 9> k_words = {"",
                                                     "sits",
                                                     "leans at the wall",
                                                     "looks at a shop window",
                                                     "glances at a shop window",
                                                     "stands in line",
                                                     "takes a picture",
                                                     "looks up at a house",
                                                     "leans on a railing"};
constexpr std::array<std::string_view, 5> k_sits = {"sits on a bench", "sits on the rim of a fountain",
                                                    "sits on the edge of a planter", "sits on a low wall",
                                                    "sits on the steps"};
constexpr std::array<std::string_view, 9> k_coming = {"",
                                                      "goes to sit down",
                                                      "goes to lean at a wall",
                                                      "goes to look at a shop window",
                                                      "",
                                                      "goes to stand in line",
                                                      "stops to take a picture",
                                                      "stops to look up",
                                                      "goes to look over a railing"};
constexpr std::array<std::string_view, 4> k_haste = {"", "strolls", "is in a hurry", "runs for the bus"};
constexpr std::array<std::string_view, 4> k_phone = {"", "texting", "on the phone", ""};
constexpr std::array<std::string_view, 4> k_phone_alone = {"", "texts on the way", "is on the phone", ""};
constexpr std::array<std::string_view, 7> k_ranks = {"is served", "second", "third",  "fourth",
                                                     "fifth",     "sixth",  "seventh"};
constexpr std::array<std::string_view, 9> k_counts = {"none", "one", "two",   "three", "four",
                                                      "five", "six", "seven", "eight"};

std::string told_line(const Pastimes& all, const Pastime& p) {
    if (p.rank == 0) return "is served first of those who wait";
    const std::string rank =
        p.rank < k_ranks.size() ? std::string(k_ranks[p.rank]) : "no. " + std::to_string(p.rank + 1);
    const uint32_t count = all.at_service[p.place];
    const std::string of = count < k_counts.size() ? std::string(k_counts[count]) : std::to_string(count);
    return rank + " of a queue of " + of + ", waits for a coffee";
}

}  // namespace

std::string told_pastime(const Pastimes& all, uint32_t walker, uint32_t tick) {
    const Pastime* p = own_of(all.all, walker);
    if (!p) return {};
    const bool phones = p->phone != PhoneUse::none && tick < p->phone_until;
    const auto phone = static_cast<size_t>(phones ? p->phone : PhoneUse::none);
    const auto what = static_cast<size_t>(p->phase == StayPhase::over ? Staying::nowhere : p->what);
    std::string told;
    if (p->phase == StayPhase::comes && p->what != Staying::queues)
        told = k_coming[what];
    else if (what == static_cast<size_t>(Staying::queues))
        told = told_line(all, *p);
    else if (what == static_cast<size_t>(Staying::sits))
        told = k_sits[static_cast<size_t>(all.places.seats[p->place].on)];
    else
        told = k_words[what];
    if (told.empty()) told = k_haste[static_cast<size_t>(p->haste)];
    if (told.empty()) return std::string(k_phone_alone[phone]);
    if (!k_phone[phone].empty()) told.append(", ").append(k_phone[phone]);
    return told;
}

}  // namespace flaneur
