#include "sim/alongside/alongside.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/alongside/parts.h"
#include "sim/base/hash.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/fall/limbs.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr float k_youngest = 12;                                 // years, of who has any of it
constexpr float k_slowest_chair = 0.8f, k_fastest_chair = 1.1f;  // m/s
constexpr float k_chair_radius = 0.36f;                          // metres
constexpr float k_slower_blind = 0.9f;                           // of their pace
constexpr float k_holds = 2.5f;                                  // 1/s, hands take and let go

const Kind& kind_of(const World& w, uint32_t i) { return w.kinds[w.crowd.identity.body[i]]; }

// What one has who came, by chance; none of those whose hands are full, of children and of creatures.
std::optional<Along> draw(const World& w, uint32_t i) {
    const Kind& kind = kind_of(w, i);
    if (kind.age < k_youngest || kind.body.cane != Vec3{} || kind.body.pram != Vec3{} ||
        is_creature(w.herd, i) || is_led(w.crowd, i) || passage_by_door(w.crowd, i))
        return std::nullopt;
    const AlongShares& c = w.alongside->shares;
    const RandomKey key{w.seed, person_number(w.crowd, {i, w.crowd.slots.generation[i]}), 0, Purpose::along};
    float chance = random_unit(key);
    auto falls_to = [&](float share) { return (chance -= share) < 0; };
    if (falls_to(c.dogs)) return Along::dog;
    const Wear& wear = kind.body.wear;
    if (falls_to(c.wheelchairs)) {
        const bool fits = wear.pockets && wear.bag != Bag::handbag && !wear.phone &&
                          surface_of(*w.navmesh, w.crowd.motion.polygon[i]) != Surface::steps;
        return fits ? std::optional(Along::wheelchair) : std::nullopt;
    }
    const bool has_right = !wear.phone;
    if (falls_to(c.white_canes)) return has_right ? std::optional(Along::white_cane) : std::nullopt;
    if (falls_to(c.umbrellas)) return has_right ? std::optional(Along::umbrella) : std::nullopt;
    return std::nullopt;
}

template <class Item>
bool has_room(const std::vector<Item>& list) {
    return list.size() < list.capacity();
}
template <class Item>
void put(std::vector<Item>& list, const Item& item) {
    list.insert(take_away(list, item.walker), item);
}

// What crowd and body have to know of it.
void take_along(World& w, uint32_t i, Along what) {
    Alongside& a = *w.alongside;
    if (!has_room(a.companions) || (what == Along::dog && !has_room(a.dogs)) ||
        (what == Along::wheelchair && !has_room(a.chairs)))
        return;
    put(a.companions, {i, w.crowd.slots.generation[i], what, 1});
    CrowdIdentity& who = w.crowd.identity;
    if (what == Along::dog) {
        put(a.dogs, make_dog(w, i));
        put(w.crowd.beside, GoesBeside{i, {}});
    } else if (what == Along::wheelchair) {
        put(a.chairs, make_chair(w, i));
        const RandomKey key{w.seed, i, w.crowd.slots.generation[i], Purpose::along};
        who.ahead[i] = k_axle_to_middle + 0.02f;
        who.radius[i] = k_chair_radius;
        who.preferred_speed[i] = random_between(key, k_slowest_chair, k_fastest_chair, 1);
        w.crowd.widest = std::max(w.crowd.widest, k_chair_radius);
        w.crowd.journeys[i].path_due = PathDue::to_new_goal;
    } else if (what == Along::white_cane) {
        who.preferred_speed[i] *= k_slower_blind;
    }
    fill_hands(w, *own_of(a.companions, i));
}

size_t room_for(const World& w, float share) {
    if (share <= 0) return 0;
    return static_cast<size_t>(1.3f * share * static_cast<float>(w.crowd.capacity)) + 16;
}

// Where it allocates, so that ticks do not.
void make_room_for(World& w) {
    Alongside& a = *w.alongside;
    const size_t dogs = room_for(w, a.shares.dogs), chairs = room_for(w, a.shares.wheelchairs);
    a.dogs.reserve(dogs), a.previous_dogs.reserve(dogs);
    w.crowd.beside.reserve(dogs + k_most_musicians);
    a.chairs.reserve(chairs), a.previous_chairs.reserve(chairs);
    a.companions.reserve(dogs + chairs + room_for(w, a.shares.white_canes) + room_for(w, a.shares.umbrellas) +
                         k_most_musicians);
    constexpr size_t k_most_listeners = 12;
    a.listeners.reserve(a.shares.musicians * k_most_listeners);
    w.crowd.called.reserve(w.crowd.called.capacity() + a.listeners.capacity() + dogs);
}

// Who had a wheelchair walks, as others of its kind.
void stand_up(World& w, uint32_t i) {
    CrowdIdentity& who = w.crowd.identity;
    const Folk one = w.folk[who.body[i]];
    const Walker drawn = draw_walker({&one, 1}, {w.seed, i, w.crowd.slots.generation[i], Purpose::body});
    who.ahead[i] = 0;
    who.radius[i] = drawn.radius;
    who.preferred_speed[i] = drawn.preferred_speed;
}

// How hands take hold again of who has been down.
void take_hold(World& w) {
    for (Companion& c : w.alongside->companions) {
        const float to = is_down(w.crowd, c.walker) ? 0.0f : 1.0f;
        c.holds = clamp(c.holds + clamp(to - c.holds, -k_holds * k_tick, k_holds * k_tick), 0, 1);
    }
}

}  // namespace

void fill_hands(World& w, const Companion& c) {
    const bool is_right = c.what == Along::white_cane || c.what == Along::umbrella;
    const int32_t full = is_right ? 1 << k_right : c.what == Along::dog ? 1 << lead_hand(w, c.walker) : 3;
    w.gait.people[c.walker / k_block].free_hands[c.walker % k_block] &= ~full;
}

bool can_be_called(const World& w, uint32_t i) {
    return is_there(w.crowd, i) && !is_down(w.crowd, i) && !is_led(w.crowd, i) &&
           !own_of(w.crowd.passages, i) && !own_of(w.crowd.called, i) && !own_of(w.bystanders.all, i) &&
           w.crowd.driven.walker != i && w.crowd.way_back[i].polygon == 0 &&
           w.crowd.at_once[i / k_block] == 1 && !waits_at_kerb(w.crowd.kerbs, i) &&
           w.gait.blocks[i / k_block].jump[i % k_block] == 0;
}

void let_go_along(World& w, const AlongShares& shares) {
    if (!is_any(shares)) return;
    w.alongside = std::make_shared<Alongside>();
    Alongside& a = *w.alongside;
    a.shares = shares;
    a.shares.musicians = std::min(shares.musicians, k_most_musicians);
    make_room_for(w);
    for (const WalkerId id : std::vector<WalkerId>(w.crowd.slots.living)) join_along(w, id.index);
    set_players(w);
    pose_alongside(w);
    w.previous_poses = w.poses;
    forget_previous(a);
}

void change_along(World& w, const AlongShares& shares) {
    Alongside& a = *w.alongside;
    const uint32_t musicians = a.shares.musicians;
    a.shares = shares;
    a.shares.musicians = musicians;
    for (const Companion& c : std::vector<Companion>(a.companions)) {
        if (c.what > Along::umbrella) continue;
        const Dog* dog = own_of(a.dogs, c.walker);
        if (dog && dog->does == static_cast<uint32_t>(DogDoes::sniffs)) call_off(w.crowd, c.walker);
        if (c.what == Along::wheelchair) stand_up(w, c.walker);
        leave_along(w, c.walker);
    }
    make_room_for(w);
    for (const WalkerId id : std::vector<WalkerId>(w.crowd.slots.living)) join_along(w, id.index);
    forget_previous(a);
}

void join_along(World& w, uint32_t walker) {
    if (!w.alongside) return;
    const Companion* own = own_of(w.alongside->companions, walker);
    if (own && own->generation == w.crowd.slots.generation[walker]) return fill_hands(w, *own);
    leave_along(w, walker);
    if (const auto what = draw(w, walker)) take_along(w, walker, *what);
}

void leave_along(World& w, uint32_t walker) {
    if (!w.alongside) return;
    Alongside& a = *w.alongside;
    if (own_of(a.companions, walker))
        w.gait.people[walker / k_block].free_hands[walker % k_block] =
            free_hands_of(kind_of(w, walker).body.wear);
    (void)take_away(a.companions, walker);
    (void)take_away(a.dogs, walker);
    (void)take_away(a.chairs, walker);
    (void)take_away(a.listeners, walker);
    (void)take_away(w.crowd.beside, walker);
}

void think_alongside(World& w) {
    if (!w.alongside) return;
    // Doors are too narrow for what goes along: one comes and goes as who pushes a pram.
    for (const Companion& c : w.alongside->companions) w.crowd.journeys[c.walker].door_tries = 0;
    think_dogs(w);
    think_music(w);
}

void move_alongside(World& w) {
    if (!w.alongside) return;
    Alongside& a = *w.alongside;
    forget_previous(a);
    walk_dogs(w);
    roll_chairs(w);
    take_hold(w);
}

void pose_alongside(World& w) {
    if (!w.alongside) return;
    const Alongside& a = *w.alongside;
    parallel_for(*w.workers, a.companions.size(), 4, [&](size_t begin, size_t end, int) {
        for (size_t k = begin; k < end; ++k) {
            const Companion& c = a.companions[k];
            if (is_down(w.crowd, c.walker) || ticks_due(w.crowd, c.walker / k_block, w.tick) == 0) continue;
            BodyPose pose = body_pose_of(w.poses, c.walker);
            if (c.what == Along::dog)
                hold_lead(w, c, pose);
            else if (c.what == Along::wheelchair)
                sit_in_chair(w, *own_of(a.chairs, c.walker), pose);
            else if (c.what == Along::white_cane)
                hold_white_cane(w, c, pose);
            else if (c.what == Along::umbrella)
                hold_umbrella(w, c, pose);
            else
                pose_player(w, c, pose);
            set_body_pose(w.poses, w.gait.people[c.walker / k_block], c.walker, pose);
        }
    });
    for (const Listener& l : a.listeners) {
        if (l.heeds <= 0 || is_down(w.crowd, l.walker) || own_of(a.companions, l.walker)) continue;
        BodyPose pose = body_pose_of(w.poses, l.walker);
        pose_listener(w, l, pose);
        set_body_pose(w.poses, w.gait.people[l.walker / k_block], l.walker, pose);
    }
}

uint32_t player_count(const World& w) {
    if (!w.alongside) return 0;
    return static_cast<uint32_t>(std::ranges::count_if(w.alongside->players, [&](const Player& p) {
        return is_there(w.crowd, p.walker) && w.crowd.slots.generation[p.walker] == p.generation;
    }));
}

const Companion* companion_of(const World& w, uint32_t walker) {
    return w.alongside ? own_of(w.alongside->companions, walker) : nullptr;
}

std::string_view told_along(const World& w, uint32_t walker) {
    if (!w.alongside) return "";
    if (const Companion* c = own_of(w.alongside->companions, walker)) {
        if (c->what == Along::dog) {
            const Dog* dog = own_of(w.alongside->dogs, walker);
            if (dog && dog->does == static_cast<uint32_t>(DogDoes::sniffs))
                return "waits while the dog sniffs";
            if (dog && dog->sits > 0.5f) return "with a dog that sits";
        }
        constexpr std::array<std::string_view, k_along_count> k_words = {
            "walks a dog",        "in a wheelchair",  "feels the way with a white cane",
            "under an umbrella",  "plays the guitar", "plays the violin",
            "plays the accordion"};
        return k_words[static_cast<size_t>(c->what)];
    }
    if (const Listener* l = own_of(w.alongside->listeners, walker))
        return l->heeds > 0 && l->claps != 0 ? "claps to the music" : "listens to the music";
    return "";
}

uint64_t hash_alongside(const Alongside& a) {
    uint64_t hash = 1;
    for_each_list(
        a, [&](const auto& list) { hash = hash_bytes(hash, list.data(), list.size() * sizeof list[0]); });
    return hash;
}

void forget_previous(Alongside& a) {
    a.previous_dogs.assign(a.dogs.begin(), a.dogs.end());
    a.previous_chairs.assign(a.chairs.begin(), a.chairs.end());
}

}  // namespace flaneur
