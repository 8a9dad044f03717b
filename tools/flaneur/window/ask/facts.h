// What the simulation knows of one of its people.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "assets/city.h"
#include "sim/body/personality.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

enum class Doing : uint8_t {
    walks,
    stays,           // at its goal, for a while
    arrived,         // where it was sent
    seeks,           // a path is due
    is_lost,         // no path was found; tries again
    is_stuck,        // gets no nearer to where it turns next
    gives_way,       // to one who has waited longer
    is_held,         // goes slower than it would like, since others are near
    roams,           // on a compound, where nobody has goals
    is_down,         // has fallen, lies or gets up
    minds,           // that somebody has fallen
    is_with,         // others
    has_a_pastime,   // sits, leans, looks at a window, queues, uses a phone
    waits_for_lamp,  // that is red
    is_at_lamp,      // that is green: starts in a moment, or has come too late
    lets_pass,       // who drives
};

struct WalkerFacts {
    uint32_t number = 0;
    bool is_built_in = true;    // else nobody knows age, sex and what is carried
    std::string name;           // of the file, if it is not built in
    float age = 0, height = 0;  // years, metres
    float creature = 0;         // metres from head to hind legs; 0: of a person
    bool is_woman = false;
    Personality personality;
    bool cane = false, pram = false, phone = false, glasses = false;
    Bag bag = Bag::none;
    float speed = 0, preferred = 0;  // m/s
    Vec3 place;
    Doing doing = Doing::walks;
    float seconds = 0;                        // that it stays still, is lost still, has been stuck
    uint32_t whom = 0;                        // it gives way to
    std::string_view minds;                   // what it does who minds,
    std::string pastime;                      // and who has a pastime
    std::string with;                         // whom it walks or talks with, and how
    std::string_view along;                   // what it does with what goes along with it; empty: nothing
    float to_go = 0;                          // metres, as the crow flies
    std::optional<DestinationKind> to, from;  // where it goes, and where it set out; none: nobody knows
};

// `walker` is there.
WalkerFacts facts_of(const Show& show, uint32_t walker);
// The same without where to and from, which take longer to find.
WalkerFacts quick_facts_of(const Show& show, uint32_t walker);

// "Girl, 11", or whose character it is.
std::string told_who(const WalkerFacts& facts);
// "outgoing, anxious": what it is more than most, at most two words of it; empty: like most.
std::string told_nature(const Personality& personality);
// "stays for 12 s more"
std::string told_doing(const WalkerFacts& facts);
const char* told(Bag bag);

}  // namespace flaneur
