#include "sim/company/company.h"
#include "sim/company/kinship.h"

namespace flaneur {

namespace {

constexpr float k_grown = 16;  // years

std::string number_of(uint32_t others) {
    constexpr const char* k_words[] = {"nobody", "one other", "two others", "three others"};
    return k_words[others];
}

std::string told(const Folk& folk) {
    if (folk.age < k_grown) return folk.woman ? "a girl" : "a boy";
    return folk.woman ? "a woman" : "a man";
}

std::string whom(const Group& g, const Crowd& c, std::span<const Folk> folk, uint32_t walker) {
    if (g.count != 2) return number_of(g.count - 1);
    const uint32_t other = g.members[g.members[0].index == walker ? 1 : 0].index;
    return told(folk[c.identity.body[other]]);
}

std::string speech_of(const Group& g, uint32_t member) {
    if (g.speech == Speech::laughter) return ", laughs";
    if (g.speech != Speech::speech) return "";
    return g.speaker == member ? ", speaks" : ", listens";
}

}  // namespace

std::string company_words(const Company& company, const Crowd& c, std::span<const Folk> folk,
                          uint32_t walker) {
    const Group* g = group_of(company, c, walker);
    if (!g) return "";
    uint32_t member = 0, behind = 0, holds = k_nobody;
    while (member < g->count && g->members[member].index != walker) ++member;
    if (member >= g->count) return "";
    const Bearing& b = company.bearings[walker];
    const std::string with = whom(*g, c, folk, walker);
    auto off_spot = [&](uint32_t i) { return length(on_ground(c.fellows[i].spot - c.motion.position[i])); };
    for (uint32_t k = 0; k < g->count; ++k) {
        const uint32_t i = g->members[k].index;
        if (k != g->leader && off_spot(i) > 1.5f) ++behind;
        const Bearing& other = company.bearings[i];
        if (other.holds == walker && other.grip >= 1) holds = i;
    }
    if (g->does == Together::meets) {
        if (g->stage == Encounter::talks && g->count > 2 && off_spot(walker) > 1.2f)
            return "goes up to " + with + " who talk";
        const char* stages[] = {"sees an acquaintance and greets", "goes up to an acquaintance",
                                g->shakes_hands != 0 ? "shakes hands with " : "greets ", "talks with ",
                                "parts from "};
        const auto stage = static_cast<size_t>(g->stage);
        return stages[stage] + (stage < 2 ? "" : with + speech_of(*g, member));
    }
    if (g->does == Together::parts) return "leaves with " + with;
    if (g->expects > 0) return "waits for who comes in after it";
    if (b.holds != k_nobody && b.grip >= 1) holds = b.holds;
    if (holds != k_nobody && g->does == Together::walks)
        return "walks hand in hand with " + told(folk[c.identity.body[holds]]) + speech_of(*g, member);
    if (g->does == Together::sits) return "sits with " + with + speech_of(*g, member);
    if (g->does != Together::walks) return "stands with " + with + speech_of(*g, member);
    if (g->waits != 0 && behind > 0 && member == g->leader) return "waits for the one who has fallen behind";
    if (member != g->leader && off_spot(walker) > 2.5f) return "catches up with " + with;
    return "walks with " + with + speech_of(*g, member);
}

}  // namespace flaneur
