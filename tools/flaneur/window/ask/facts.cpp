#include "tools/flaneur/window/ask/facts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "sim/alongside/alongside.h"
#include "sim/base/spans.h"
#include "sim/base/tick.h"
#include "sim/pastimes/pastimes.h"
#include "sim/stepping.h"

namespace flaneur {
namespace {

constexpr float k_beside = 2.1f;      // metres that one stands beside where one wanted to go, at most
constexpr uint32_t k_hesitates = 60;  // ticks without getting nearer that are told

float seconds_of(uint32_t ticks) { return static_cast<float>(ticks) * k_tick; }

// The place of which a goal was made: near it, and looked at the same way.
std::optional<DestinationKind> kind_at(const Demand& demand, Vec3 place, Vec2 facing) {
    std::optional<DestinationKind> kind;
    float least = k_beside;
    for (int k = 0; k < k_destination_count; ++k)
        for (const Attraction& attraction : demand.attractions[k]) {
            const float away = length(attraction.place.position - place);
            const bool is_same_way = facing == Vec2{} || facing == attraction.facing;
            if (away < least && is_same_way) least = away, kind = static_cast<DestinationKind>(k);
        }
    return kind;
}

void find_doing(const World& world, WalkerFacts& f) {
    const Crowd& crowd = world.crowd;
    const Journey& journey = crowd.journeys[f.number];
    const uint32_t tick = world.tick;
    if (world.roam || is_stepping(world, f.number)) {
        f.doing = Doing::roams;
        return;
    }
    f.to_go = length(journey.goal.position - f.place);
    const float wait = tick < journey.pause_until ? seconds_of(journey.pause_until - tick) : 0;
    const uint32_t lost_for = tick - journey.closest_tick;
    const Claim& claim = crowd.decision.claim[f.number];
    const float wanted = length(crowd.decision.wanted[f.number]);
    const Bystander* minds = own_of(world.bystanders.all, f.number);
    f.pastime = told_pastime(*world.pastimes, f.number, tick);
    if (is_staying(*world.pastimes, f.number)) {
        f.doing = Doing::has_a_pastime;
    } else if (is_down(crowd, f.number)) {
        f.doing = Doing::is_down;
    } else if (waits_at_kerb(crowd.kerbs, f.number)) {
        const Lamp lamp = lamp_at(plan_of(*crowd.kerbs.map, crowd.kerbs.waits[f.number].kerb), tick);
        // Who comes too late waits until it is green again.
        f.doing = lamp.light == Light::green ? Doing::is_at_lamp : Doing::waits_for_lamp;
        f.seconds = seconds_of(lamp.left);
    } else if (minds && tick < minds->until && minds->does != Concern::glances) {
        f.doing = Doing::minds, f.minds = k_concern_words[static_cast<size_t>(minds->does)];
    } else if (!f.pastime.empty()) {
        f.doing = Doing::has_a_pastime;
    } else if (std::string with = company_words(world.company, crowd, world.folk, f.number); !with.empty()) {
        f.doing = Doing::is_with, f.with = std::move(with);
    } else if (journey.arrived && journey.errand == Errand::arrive) {
        f.doing = Doing::arrived;
    } else if (journey.arrived && wait > 0) {
        f.doing = Doing::stays, f.seconds = wait;
    } else if (has_traffic(crowd.roadway) && crowd.scratch.lets_pass[f.number] != 0) {
        f.doing = Doing::lets_pass;
    } else if (wait > 0) {
        f.doing = Doing::is_lost, f.seconds = wait;
    } else if (journey.path_due != PathDue::no) {
        f.doing = Doing::seeks;
    } else if (lost_for > k_hesitates) {
        f.doing = Doing::is_stuck, f.seconds = seconds_of(lost_for);
    } else if (claim.since != k_never && claim.owner != f.number) {
        f.doing = Doing::gives_way, f.whom = claim.owner;
    } else if (wanted > 0.3f && f.speed < 0.6f * wanted &&
               length(crowd.decision.chosen[f.number]) < 0.7f * wanted) {
        f.doing = Doing::is_held;
    }
}

}  // namespace

WalkerFacts quick_facts_of(const Show& show, uint32_t walker) {
    const World& world = *show.loaded.world;
    const uint32_t kind = world.crowd.identity.body[walker];
    const Character& character = show.loaded.characters[kind];
    WalkerFacts f;
    f.number = walker;
    f.height = world.kinds[kind].body.height * world.crowd.identity.scale[walker];
    f.speed = length(world.crowd.motion.velocity[walker]);
    f.preferred = world.crowd.identity.preferred_speed[walker];
    f.place = world.crowd.motion.position[walker];
    f.is_built_in = character.found.scale == 0;
    if (f.is_built_in) {
        const PersonOptions& person = character.person;
        f.age = person.age, f.is_woman = person.woman;
        f.cane = person.stick, f.pram = person.pram, f.phone = person.phone, f.glasses = person.glasses;
        f.bag = person.bag;
    } else {
        f.name = character.name;
    }
    f.personality = personality_of(world, walker);
    if (is_creature(world.herd, walker))
        f.creature = world.herd.creatures[walker - world.herd.goes_as.front()].size;
    f.along = told_along(world, walker);
    find_doing(world, f);
    return f;
}

WalkerFacts facts_of(const Show& show, uint32_t walker) {
    WalkerFacts f = quick_facts_of(show, walker);
    const World& world = *show.loaded.world;
    if (world.roam) return f;
    const Journey& journey = world.crowd.journeys[walker];
    f.to = kind_at(world.crowd.demand, journey.goal.position, journey.facing);
    if (!journey.arrived && length(journey.path_start - on_ground(journey.goal.position)) > 2 * k_beside)
        f.from = kind_at(world.crowd.demand, at_height(journey.path_start, f.place.y), {});
    return f;
}

std::string told_who(const WalkerFacts& f) {
    if (f.creature > 0) return "Creature of six legs";
    if (!f.is_built_in) return f.name;
    const bool is_child = f.age < k_grown_up;
    const char* sex = f.is_woman ? (is_child ? "Girl" : "Woman") : (is_child ? "Boy" : "Man");
    return std::string(sex) + ", " + std::to_string(static_cast<int>(f.age + 0.5f));
}

std::string told_nature(const Personality& p) {
    constexpr float k_tells = 0.7f;  // standard scores
    struct {
        float score;
        const char *more, *less;
    } traits[] = {{p.extraversion, "outgoing", "reserved"},
                  {p.agreeableness, "obliging", "headstrong"},
                  {p.conscientiousness, "dutiful", "easy-going"},
                  {p.neuroticism, "anxious", "calm"},
                  {p.openness, "curious", "incurious"}};
    std::ranges::stable_sort(traits, std::greater{}, [](const auto& t) { return std::fabs(t.score); });
    std::string told;
    for (const auto& trait : {traits[0], traits[1]}) {
        if (std::fabs(trait.score) < k_tells) break;
        told.append(told.empty() ? "" : ", ").append(trait.score > 0 ? trait.more : trait.less);
    }
    return told;
}

static std::string told_errand(const WalkerFacts& f) {
    char text[96] = "";
    switch (f.doing) {
        case Doing::walks:
            return "on the way";
        case Doing::stays:
            std::snprintf(text, sizeof text, "stays for %.0f s more", static_cast<double>(f.seconds));
            return text;
        case Doing::arrived:
            return "stands where it was sent";
        case Doing::seeks:
            return "waits for a way to be found";
        case Doing::is_lost:
            std::snprintf(text, sizeof text, "found no way, tries again in %.0f s",
                          static_cast<double>(f.seconds));
            return text;
        case Doing::is_stuck:
            std::snprintf(text, sizeof text, "has not got on for %.0f s", static_cast<double>(f.seconds));
            return text;
        case Doing::gives_way:
            std::snprintf(text, sizeof text, "gives way to no. %u, who could not get on", f.whom);
            return text;
        case Doing::is_held:
            return "is slowed down by others or walls near";
        case Doing::roams:
            return "roams";
        case Doing::waits_for_lamp:
            std::snprintf(text, sizeof text, "waits for the lamp, %.0f s more",
                          static_cast<double>(f.seconds));
            return text;
        case Doing::is_at_lamp:
            return "stands at the lamp, which is green";
        case Doing::lets_pass:
            return "waits until those have passed who drive";
        case Doing::is_down:
            return "has fallen";
        case Doing::minds:
            return std::string(f.minds);
        case Doing::has_a_pastime:
            return f.pastime;
        case Doing::is_with:
            return f.with;
    }
    return text;
}

std::string told_doing(const WalkerFacts& f) {
    const std::string errand = told_errand(f);
    return f.along.empty() ? errand : std::string(f.along) + "; " + errand;
}

const char* told(Bag bag) {
    constexpr const char* names[] = {"no bag", "a backpack", "a shoulder bag", "a handbag"};
    return names[static_cast<size_t>(bag)];
}

}  // namespace flaneur
