#include "sim/state.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>

#include "sim/alongside/alongside.h"
#include "sim/base/hash.h"
#include "sim/pastimes/pastimes.h"
#include "sim/stepping.h"

namespace flaneur {
namespace {

constexpr uint64_t k_mark = 0x61'74'73'2e'72'75'6c'66;  // "flur.sta"

// What is new in these has to be listed below, if the next tick depends on it.
static_assert(sizeof(CrowdIdentity) == 10 * 24 && sizeof(CrowdMotion) == 10 * 24 &&
              sizeof(CrowdDecision) == 6 * 24 && sizeof(CrowdSlots) == 4 * 24 && sizeof(Gait) == 8 + 4 * 24);
static_assert(sizeof(Crowd) == sizeof(Demand) + sizeof(CrowdScratch) + 8 + 24 * (6 + 10 + 10 + 6 + 7) + 48 +
                                   sizeof(Onlookers) + 24 + sizeof(Traffic) + sizeof(March) + sizeof(Kerbs) +
                                   sizeof(Roadway));

// Before all else; how many of each follow.
struct Head {
    uint64_t mark = k_mark, world = 0;
    uint32_t tick = 0, count = 0, next_path = 0;
    float widest = 0, strays = 0;
    Driven driven{};
    uint32_t living = 0, left = 0, corners = 0, canes = 0, prams = 0, plays = 0;
    uint32_t ways = 0, passages = 0, traffic = 0, downed = 0, falls = 0, tumbles = 0, called = 0;
    uint32_t bystanders = 0, balls = 0, groups = 0, vacant_groups = 0;
    uint32_t beside = 0, rods = 0, along[5] = {}, pastimes = 0;
    uint32_t successors = 0, next_successor = 0, sent = 0, next_sent = 0, numbered = 0, gone = 0,
             came = 0;  // of Coming
    LimbCurves how{};
    uint32_t marches = 0;
    FigureLead lead{};
    uint32_t next_trace = 0, pad = 0;
};
static_assert(std::is_trivially_copyable_v<Head> && sizeof(Head) == 240, "has no gap at the end");

// Calls each(vector, how many of its first items) for what has a fixed place and size as long as nobody comes
// or goes, what is constant first. W is a World, const or not.
template <class W, class Each>
void for_each_array(W& w, uint32_t count, const Each& each) {
    auto& c = w.crowd;
    auto all = [&](auto&... arrays) { (each(arrays, arrays.size()), ...); };
    auto some = [&](auto&... arrays) { (each(arrays, size_t{count}), ...); };
    all(w.gait.people);
    auto& who = c.identity;
    some(who.preferred_speed, who.radius, who.lateral, who.body, who.scale, who.stair_pace, who.ahead,
         who.room, who.patience, who.linger);
    some(c.slots.generation, c.slots.place);
    all(w.gait.blocks, w.poses, w.trails, c.at_once, c.traffic.slow, c.traffic.coming);
    auto& m = c.motion;
    some(m.position, m.velocity, m.wish, m.heading, m.turn_rate, m.feet, m.brakes, m.polygon, m.under,
         m.filed);
    auto& d = c.decision;
    some(d.wanted, d.course, d.aim, d.looks, d.chosen, d.claim);
    some(c.journeys, c.way_back);
    if (minds_lamps(c.kerbs)) some(c.kerbs.waits, c.kerbs.manners);
    if (is_on(w.company)) some(c.fellows), all(w.company.bearings);
    all(w.idles.wanted, w.idles.playing, w.idles.stood);
    all(w.traced.way_of);
    all(w.figures.moves, w.figures.gait.blocks, w.figures.whole);
    all(w.deeds.doers, w.deeds.parcels, w.deeds.leaves, w.deeds.gait.blocks, w.deeds.whole, w.deeds.poses);
    all(w.coming.so_far, w.coming.sending_of, w.linkages.places, w.linkages.targets, w.linkages.methods,
        w.linkages.held, w.herd.creatures, w.movers.places);
    all(w.vehicles.all);
    if (w.stepping) all(w.stepping->bipeds.all, w.stepping->orders);
    if (!w.roam) return;
    auto& s = w.roam->walkers;
    all(s.position, s.up, s.ahead, s.speed, s.pace, s.turn_rate, s.moved, s.radius, s.probes, s.leaps, s.wish,
        w.roam->frames, w.roam->creatures);
}

// The same for lists that grow and shrink, but the corners.
template <class W, class Each>
void for_each_list(W& w, const Head& head, const Each& each) {
    each(w.crowd.slots.living, head.living);
    each(w.crowd.slots.left, head.left);
    each(w.crowd.wayfarers, head.ways);
    each(w.crowd.passages, head.passages);
    each(w.crowd.downed, head.downed);
    each(w.crowd.called, head.called);
    each(w.crowd.beside, head.beside);
    each(w.bystanders.all, head.bystanders);
    each(w.company.groups, head.groups);
    each(w.pastimes->all, head.pastimes);
    each(w.falls.all, head.falls);
    each(w.falls.rods, head.rods);
    if (w.alongside) {
        size_t k = 0;
        for_each_list(*w.alongside, [&](auto& list) { each(list, head.along[k++]); });
    }
    each(w.balls.all, head.balls);
    each(w.falls.blocks, head.tumbles);
    each(w.crowd.march.pace, head.marches);
    each(w.crowd.march.turns, head.marches);
    each(w.gait.canes, head.canes);
    each(w.gait.prams, head.prams);
    each(w.idles.plays, head.plays);
    each(w.coming.successors.entrants, head.successors);
    each(w.coming.sent.entrants, head.sent);
}

size_t bytes_after(const World& w, const Head& head) {
    size_t bytes = head.corners * sizeof(Vec3);
    auto add = [&](const auto& array, size_t items) { bytes += items * sizeof(array[0]); };
    for_each_array(w, head.count, add);
    for_each_list(w, head, add);
    return bytes;
}

// The corners ahead of a walker; those behind nobody asks for any more.
template <class C>
auto corners_ahead(C& crowd, uint32_t walker) {
    const Journey& j = crowd.journeys[walker];
    const size_t first = std::min(j.corner, j.corner_count);
    return std::span(crowd.corners).subspan(size_t{walker} * k_corners + first, j.corner_count - first);
}

Head head_of(const World& w) {
    auto size = [](const auto& list) { return static_cast<uint32_t>(list.size()); };
    const Crowd& c = w.crowd;
    Head head{.world = state_mark(w), .tick = w.tick, .count = c.count, .next_path = c.next_path};
    head.widest = c.widest;
    head.strays = c.scratch.strays;
    head.driven = c.driven;
    head.how = c.march.how;
    head.marches = size(c.march.pace);
    head.lead = w.figures.lead;
    head.traffic = c.traffic.done;
    head.next_trace = w.traced.next;
    head.living = size(c.slots.living);
    head.left = size(c.slots.left);
    head.ways = size(c.wayfarers);
    head.passages = size(c.passages);
    head.downed = size(c.downed);
    head.called = size(c.called);
    head.beside = size(c.beside);
    head.rods = size(w.falls.rods);
    if (w.alongside) {
        size_t k = 0;
        for_each_list(*w.alongside, [&](const auto& list) { head.along[k++] = size(list); });
    }
    head.bystanders = size(w.bystanders.all);
    head.groups = size(w.company.groups);
    head.vacant_groups = w.company.vacant;
    head.falls = size(w.falls.all);
    head.pastimes = size(w.pastimes->all);
    head.balls = size(w.balls.all);
    head.tumbles = size(w.falls.blocks);
    for (uint32_t i = 0; i < c.count; ++i) head.corners += size(corners_ahead(c, i));
    head.canes = size(w.gait.canes);
    head.prams = size(w.gait.prams);
    head.plays = size(w.idles.plays);
    const Coming& coming = w.coming;
    head.successors = size(coming.successors.entrants);
    head.next_successor = coming.successors.next;
    head.sent = size(coming.sent.entrants);
    head.next_sent = coming.sent.next;
    head.numbered = coming.numbered;
    head.gone = coming.left;
    head.came = coming.came;
    return head;
}

std::optional<Head> read_head(std::span<const std::byte> bytes) {
    Head head;
    if (bytes.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, bytes.data(), sizeof head);
    return head.mark == k_mark ? std::optional(head) : std::nullopt;
}

}  // namespace

uint64_t state_mark(const World& w) {
    uint64_t hash = mix(w.seed);
    auto add = [&](const auto&... values) { ((hash = hash_bytes(hash, &values, sizeof values)), ...); };
    add(w.crowd.capacity, w.crowd.demand.hour, w.crowd.pass_on, w.crowd.demand.leaving);
    for (const Sending& sending : w.coming.sendings)
        add(sending.people, sending.begin, sending.end, sending.speed);
    for (const Kind& kind : w.kinds) add(kind.share, kind.age, kind.body.height, kind.body.joints);
    for (const Clip& clip : w.idles.clips) add(clip.keys, clip.duration);
    if (w.alongside) add(w.alongside->players.size());
    const Ground& ground = *w.ground;
    for (size_t size :
         {w.kinds.size(), w.idles.clips.size(), ground.vertices.size(), ground.indices.size(),
          ground.faces.size(), ground.solids.size(), ground.obstacles.size(), w.linkages.places.size(),
          w.figures.plans.size(), w.deeds.plans.size(), w.movers.all.size(), w.crowd.kerbs.waits.size(),
          w.company.bearings.size(), w.pastimes->places.seats.size(), w.vehicles.all.size(),
          is_on(w.traced) ? w.traced.traces->knots.size() : 0,
          w.stepping ? w.stepping->bipeds.all.size() + 1 : 0,
          w.roam ? w.roam->compound.vertices.size() + w.roam->compound.spheres.size() +
                       w.roam->compound.capsules.size() + 1
                 : 0})
        add(static_cast<uint64_t>(size));
    add(ground.low, ground.high);
    return hash;
}

void save_state(const World& w, std::vector<std::byte>& bytes) {
    const Head head = head_of(w);
    bytes.resize(sizeof head + bytes_after(w, head));
    std::byte* at = bytes.data();
    auto write = [&](const void* from, size_t size) {
        if (size > 0) std::memcpy(at, from, size);
        at += size;
    };
    auto add = [&](const auto& array, size_t items) {
        static_assert(std::is_trivially_copyable_v<std::decay_t<decltype(array[0])>>);
        write(array.data(), items * sizeof(array[0]));
    };
    write(&head, sizeof head);
    for_each_array(w, head.count, add);
    for_each_list(w, head, add);
    for (uint32_t i = 0; i < head.count; ++i) {
        const auto corners = corners_ahead(w.crowd, i);
        write(corners.data(), corners.size_bytes());
    }
}

std::optional<uint32_t> tick_of_state(std::span<const std::byte> bytes) {
    const std::optional<Head> head = read_head(bytes);
    return head ? std::optional(head->tick) : std::nullopt;
}

Result<void> load_state(World& w, std::span<const std::byte> bytes) {
    const std::optional<Head> head = read_head(bytes);
    if (!head) return Error{"These bytes are no state of a world."};
    if (head->world != state_mark(w))
        return Error{
            "This state is of another world: one of another seed, other ground or other people. It fits only "
            "the world that it was saved of."};
    Crowd& c = w.crowd;
    const bool fits = head->count <= c.capacity && head->living <= head->count && head->left <= head->count &&
                      (head->driven.walker == k_nobody || head->driven.walker < head->count) &&
                      (head->marches == 0 || head->marches == c.capacity);
    const size_t wanted = fits ? sizeof *head + bytes_after(w, *head) : 0;
    if (bytes.size() != wanted)
        return Error{"This state is cut short or damaged: it has " + std::to_string(bytes.size()) +
                     " bytes, and " + std::to_string(wanted) + " were written."};
    bytes = bytes.subspan(sizeof *head);
    auto read = [&](void* to, size_t size) {
        if (size > 0) std::memcpy(to, bytes.data(), size);
        bytes = bytes.subspan(size);
    };
    auto take = [&](auto& array, size_t items) {
        read(static_cast<void*>(array.data()), items * sizeof(array[0]));
    };
    w.tick = head->tick;
    c.next_path = head->next_path;
    c.widest = head->widest;
    c.scratch.strays = head->strays;
    c.driven = head->driven;
    w.company.vacant = head->vacant_groups;
    c.march.how = head->how;
    w.figures.lead = head->lead;
    w.traced.next = head->next_trace;
    c.count = head->count;
    Coming& coming = w.coming;
    coming.successors.next = head->next_successor;
    coming.sent.next = head->next_sent;
    coming.numbered = head->numbered;
    coming.left = head->gone;
    coming.came = head->came;
    std::fill(c.slots.place.begin() + head->count, c.slots.place.end(), k_nobody);
    std::fill(c.slots.generation.begin() + head->count, c.slots.generation.end(), 0);
    for_each_array(w, head->count, take);
    for_each_list(w, *head, [&](auto& list, size_t items) {
        list.resize(items);
        take(list, items);
    });
    for (uint32_t i = 0; i < c.count; ++i) {
        const auto corners = corners_ahead(c, i);
        read(corners.data(), corners.size_bytes());
    }
    c.scratch.is_ordered = false;
    c.traffic.done = head->traffic;
    restore(c.traffic, *w.navmesh);
    forget_previous(w);
    find_places(w.vehicles);
    if (has_traffic(w.vehicles)) show_vehicles(w.vehicles, c);
    w.balls.previous_places.clear();
    for (const Ball& ball : w.balls.all) w.balls.previous_places.push_back(ball.place);
    pose_figures_anew(w.figures);
    return {};
}

void forget_previous(World& w) {
    w.previous_poses = w.poses;
    w.previous_trails = w.trails;
    if (w.roam) w.roam->previous_frames = w.roam->frames;
    w.linkages.previous_places = w.linkages.places;
    w.linkages.previous_targets = w.linkages.targets;
    forget_previous(w.movers);
    forget_previous(w.deeds);
    if (w.alongside) forget_previous(*w.alongside);
}

}  // namespace flaneur
