#include "tools/flaneur/recording/shown.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "sim/alongside/alongside.h"
#include "sim/pastimes/pastimes.h"
#include "sim/state.h"

namespace flaneur {

namespace {

// Steps of what is no body, far below what is seen.
constexpr float k_place = 1.0f / 1024, k_angle = 1.0f / 1024, k_turn = 1.0f / 4096,  // metres, radians, of 1
    k_way = 1.0f / 256,  // metres and radians, of what cameras follow
    k_afar = 1.0f / 64,  // of how those are drawn who are far away
    k_pace = 1.0f / 16, k_share = 1.0f / 256;
constexpr float k_none = 0;  // whole numbers

// A number, or several, of an item.
struct Part {
    std::string_view name;
    size_t offset, bytes;
    float step;
};

template <class T, class M>
Part part(std::string_view name, M T::*member, float step = k_none) {
    static const T some{};
    const auto* at = reinterpret_cast<const std::byte*>(&(some.*member));
    return {name, static_cast<size_t>(at - reinterpret_cast<const std::byte*>(&some)), sizeof(M), step};
}
template <class T, class M, class N>
Part part(std::string_view name, M T::*member, N M::*inner, float step) {
    Part out = part(name, member, step);
    out.offset += part(name, inner).offset, out.bytes = sizeof(N);
    return out;
}
// The item itself.
template <class T>
Part all_of(std::string_view name, float step = k_none) {
    return {name, 0, sizeof(T), step};
}

using Parts = std::initializer_list<Part>;

// Calls fixed(vector, how many of its first items, parts) for what has its size for good, and list(vector,
// parts) for what grows and shrinks. W is a World, const or not.
template <class W, class Fixed, class List>
void for_each_shown(W& w, const Fixed& fixed, const List& list) {
    auto& c = w.crowd;
    const size_t count = c.count, blocks = block_count(c.count);
    fixed(c.identity.body, count, {all_of<uint32_t>("who.body")});
    fixed(c.identity.scale, count, {all_of<float>("who.scale", k_bits)});
    fixed(c.motion.position, count, {all_of<Vec3>("motion.position", k_way)});
    fixed(c.motion.heading, count, {all_of<float>("motion.heading", k_way)});
    fixed(c.motion.velocity, count, {all_of<Vec2>("motion.velocity", k_pace)});
    fixed(c.motion.turn_rate, count, {all_of<float>("motion.turn_rate", k_pace)});
    fixed(c.at_once, blocks, {all_of<uint8_t>("at_once")});
    fixed(w.gait.people, blocks,
          {part("person.height", &PersonBlock::height, k_bits),
           part("person.free_hands", &PersonBlock::free_hands)});
    fixed(w.gait.blocks, blocks,
          {part("gait.heading", &GaitBlock::heading, k_afar), part("gait.phase", &GaitBlock::phase, k_share),
           part("gait.amplitude", &GaitBlock::amplitude, k_afar),
           part("gait.frequency", &GaitBlock::frequency, k_pace),
           part("gait.tread", &GaitBlock::tread, k_place)});
    list(c.passages, {part("passages.walker", &Passage::walker), part("passages.kind", &Passage::kind),
                      part("passages.shown", &Passage::shown)});
    list(c.downed, {part("downed.walker", &Downed::walker)});
    list(w.falls.rods, {part("rods.walker", &LooseRod::walker), part("rods.grip", &LooseRod::grip, k_place),
                        part("rods.grip_before", &LooseRod::grip_before, k_place),
                        part("rods.turn", &LooseRod::turn, k_turn)});
    list(w.gait.prams, {part("prams.walker", &Pram::walker), part("prams.scale", &Pram::scale, k_bits),
                        part("prams.handle", &Pram::handle, k_place), part("prams.now", &Pram::now, k_place),
                        part("prams.before", &Pram::before, k_place)});
    list(w.pastimes->all, {part("pastimes.walker", &Pastime::walker), part("pastimes.what", &Pastime::what),
                           part("pastimes.phase", &Pastime::phase), part("pastimes.phone", &Pastime::phone),
                           part("pastimes.phone_began", &Pastime::phone_began),
                           part("pastimes.phone_until", &Pastime::phone_until)});
    if (w.alongside) {
        auto& a = *w.alongside;
        list(a.companions, {part("companions.walker", &Companion::walker),
                            part("companions.generation", &Companion::generation),
                            part("companions.what", &Companion::what),
                            part("companions.holds", &Companion::holds, k_share)});
        list(a.dogs, {part("dogs.walker", &Dog::walker),
                      part("dogs.generation", &Dog::generation),
                      part("dogs.breed", &Dog::breed),
                      part("dogs.coat", &Dog::coat),
                      part("dogs.size", &Dog::size, k_bits),
                      part("dogs.position", &Dog::position, k_place),
                      part("dogs.velocity", &Dog::velocity, k_pace),
                      part("dogs.heading", &Dog::heading, k_angle),
                      part("dogs.turn_rate", &Dog::turn_rate, k_pace),
                      part("dogs.phase", &Dog::phase, k_angle),
                      part("dogs.duty", &Dog::duty, k_angle),
                      part("dogs.trots", &Dog::trots, k_share),
                      part("dogs.moves", &Dog::moves, k_share),
                      part("dogs.fore", &Dog::fore, k_place),
                      part("dogs.hind", &Dog::hind, k_place),
                      part("dogs.bend", &Dog::bend, k_angle),
                      part("dogs.sits", &Dog::sits, k_angle),
                      part("dogs.nose", &Dog::nose, k_angle),
                      part("dogs.gaze", &Dog::gaze, k_angle),
                      part("dogs.gaze_pitch", &Dog::gaze_pitch, k_angle),
                      part("dogs.wag", &Dog::wag, k_angle),
                      part("dogs.wags", &Dog::wags, k_angle),
                      part("dogs.feet", &Dog::feet, k_place)});
        list(a.chairs,
             {part("chairs.walker", &Chair::walker), part("chairs.wheels", &Chair::wheels, k_angle)});
        list(a.players,
             {part("players.walker", &Player::walker), part("players.at", &Player::at, k_place),
              part("players.facing", &Player::facing, k_turn), part("players.beat", &Player::beat, k_angle),
              part("players.stands", &Player::stands), part("players.hat", &Player::hat, k_place)});
    }
    list(w.vehicles.all, {part("vehicles.kind", &Vehicle::kind), part("vehicles.route", &Vehicle::route),
                          part("vehicles.speed", &Vehicle::speed, k_pace),
                          part("vehicles.acceleration", &Vehicle::acceleration, k_pace)});
    list(w.vehicles.places, {part("vehicles.middle", &VehiclePlace::middle, k_place),
                             part("vehicles.heading", &VehiclePlace::heading, k_angle),
                             part("vehicles.pitch", &VehiclePlace::pitch, k_angle),
                             part("vehicles.steer", &VehiclePlace::steer, k_angle),
                             part("vehicles.rolled", &VehiclePlace::rolled, k_place),
                             part("vehicles.presence", &VehiclePlace::presence, k_share)});
    list(w.balls.all, {part("balls.place", &Ball::place, k_place), part("balls.turn", &Ball::turn, k_turn),
                       part("balls.radius", &Ball::radius, k_bits)});
    fixed(w.movers.places, w.movers.places.size(),
          {part("movers.position", &Placement::position, k_place),
           part("movers.turn", &Placement::turn, k_turn)});
    fixed(w.linkages.places, w.linkages.places.size(), {all_of<Vec3>("linkages.places", k_place)});
    fixed(w.linkages.targets, w.linkages.targets.size(), {all_of<Vec3>("linkages.targets", k_place)});
    fixed(w.figures.moves, w.figures.moves.size(),
          {part("figures.heading", &FigureMove::motion, &Motion::heading, k_way)});
    fixed(w.figures.poses, w.figures.poses.size(),
          {part("figures.origin", &PoseBlock::origin, k_place),
           part("figures.places", &PoseBlock::position, k_place),
           part("figures.turns", &PoseBlock::rotation, k_turn)});
    fixed(w.deeds.doers, w.deeds.doers.size(),
          {part("doers.heading", &Doer::motion, &Motion::heading, k_way)});
    fixed(w.deeds.poses, w.deeds.poses.size(),
          {part("doers.origin", &PoseBlock::origin, k_place),
           part("doers.places", &PoseBlock::position, k_place),
           part("doers.turns", &PoseBlock::rotation, k_turn)});
    if (!w.roam) return;
    auto& frames = w.roam->frames;
    fixed(frames, frames.size(),
          {part("roam.position", &Roam::Frame::position, k_place),
           part("roam.rotation", &Roam::Frame::rotation, k_turn)});
    auto& leaps = w.roam->walkers.leaps;
    fixed(leaps, leaps.size(),
          {part("leaps.stage", &Leap::stage), part("leaps.seconds", &Leap::seconds, k_place),
           part("leaps.lasts", &Leap::lasts, k_place), part("leaps.velocity", &Leap::velocity, k_place),
           part("leaps.landing", &Leap::landing, k_place)});
}

const Parts k_poses = {part("poses.origin", &PoseBlock::origin, k_bits),
                       part("poses.places", &PoseBlock::position, k_bits),
                       part("poses.turns", &PoseBlock::rotation, k_bits)};
const Parts k_trails = {part("trails.moving", &TrailBlock::moving, k_bits),
                        part("trails.turning", &TrailBlock::turning, k_bits)};
const Parts k_living = {part("living.slot", &WalkerId::index),
                        part("living.generation", &WalkerId::generation)};

constexpr size_t words_of(const Part& p) { return (p.bytes + 3) / 4; }

void add_items(ColumnTick& tick, const std::byte* items, size_t stride, size_t count, const Parts& parts,
               bool is_exact) {
    for (const Part& p : parts) {
        const size_t words = words_of(p), begin = tick.words.size();
        tick.parts.push_back({p.name, is_exact && p.step > 0 ? k_bits : p.step, static_cast<uint32_t>(count),
                              static_cast<uint32_t>(words), begin});
        tick.words.resize(begin + words * count);
        uint32_t* to = tick.words.data() + begin;
        if (p.bytes % 4 != 0) std::fill(to, to + words * count, 0);
        if (p.bytes == stride && stride % 4 == 0 && count > 0) {
            std::memcpy(to, items, stride * count);
            continue;
        }
        for (size_t i = 0; i < count; ++i, to += words)
            std::memcpy(to, items + i * stride + p.offset, p.bytes);
    }
}

template <class V>
const std::byte* bytes_in(const V& items) {
    return reinterpret_cast<const std::byte*>(items.data());
}

// Of a chunk at a tick.
struct Reader {
    const ColumnChunk& chunk;
    uint32_t tick;

    const ColumnChunk::Column* find(const Part& p) const {
        const auto at = chunk.columns.find(p.name);
        if (at == chunk.columns.end() || at->second.words != words_of(p)) return nullptr;
        return at->second.items[tick] == k_no_items ? nullptr : &at->second;
    }
    std::optional<uint32_t> count(const Parts& parts) const {
        for (const Part& p : parts)
            if (const ColumnChunk::Column* c = find(p)) return c->items[tick];
        return std::nullopt;
    }
    void read(std::byte* items, size_t stride, size_t count, const Parts& parts) const {
        for (const Part& p : parts) {
            const ColumnChunk::Column* c = find(p);
            if (!c) continue;
            const auto words = static_cast<uint32_t>(words_of(p));
            const auto most = static_cast<uint32_t>(std::min<size_t>(count, c->items[tick]));
            for (uint32_t i = 0; i < most; ++i)
                for (uint32_t k = 0; k < words; ++k) {
                    const uint32_t word = value_of(chunk, *c, tick, i, k);
                    std::memcpy(items + i * stride + p.offset + 4 * k, &word,
                                std::min<size_t>(4, p.bytes - 4 * k));
                }
        }
    }
    template <class V>
    void read_fixed(V& items, size_t count, const Parts& parts) const {
        read(reinterpret_cast<std::byte*>(items.data()), sizeof(items[0]), std::min(count, items.size()),
             parts);
    }
};

void keep_previous(World& w) {
    forget_previous(w);
    w.vehicles.previous = w.vehicles.places;
    w.figures.previous_poses = w.figures.poses;
}

// Who is there; whoever is new in a slot was nowhere before.
void put_living(const Reader& reader, World& w) {
    auto& slots = w.crowd.slots;
    const std::optional<uint32_t> count = reader.count(k_living);
    if (!count) return;
    std::vector<WalkerId> living(*count);
    reader.read_fixed(living, living.size(), k_living);
    std::erase_if(living, [&](const WalkerId& id) { return id.index >= w.crowd.count; });
    std::fill(slots.place.begin(), slots.place.end(), k_nobody);
    slots.living.clear();
    for (const WalkerId& id : living) {
        if (slots.place[id.index] != k_nobody) continue;
        slots.place[id.index] = static_cast<uint32_t>(slots.living.size());
        slots.generation[id.index] = id.generation;
        slots.living.push_back(id);
    }
}

// What a later version may count that this one does not, and what only damage could tell.
void leave_out_unknown(World& w) {
    const uint32_t count = w.crowd.count;
    auto is_nobody = [&](const auto& item) { return item.walker >= count; };
    for (uint32_t i = 0; i < count; ++i)
        if (w.crowd.identity.body[i] >= w.kinds.size()) w.crowd.identity.body[i] = 0;
    for (uint8_t& at_once : w.crowd.at_once) at_once = std::max(at_once, uint8_t{1});
    std::erase_if(w.crowd.passages, is_nobody);
    std::erase_if(w.crowd.downed, is_nobody);
    std::erase_if(w.falls.rods, is_nobody);
    std::erase_if(w.gait.prams, is_nobody);
    std::erase_if(w.pastimes->all, is_nobody);
    auto& all = w.vehicles.all;
    const bool has_others = std::ranges::any_of(
        all, [](const Vehicle& v) { return static_cast<uint32_t>(v.kind) >= k_vehicle_kinds; });
    if (has_others || !w.vehicles.map) all.clear();
    const auto first = std::ranges::find(all, VehicleKind::tram, &Vehicle::kind);
    w.vehicles.first_tram = static_cast<uint32_t>(first - all.begin());
    size_t sections = 0;
    for (const Vehicle& v : all) sections += sections_of(v);
    const bool has_late =
        std::any_of(first, all.end(), [](const Vehicle& v) { return v.kind != VehicleKind::tram; });
    if (has_late) all.clear();
    w.vehicles.places.resize(std::max(sections, w.vehicles.places.size()));
    if (w.vehicles.previous.size() != w.vehicles.places.size()) w.vehicles.previous = w.vehicles.places;
    if (!w.alongside) return;
    auto& a = *w.alongside;
    std::erase_if(a.companions, is_nobody);
    std::erase_if(a.companions,
                  [](const Companion& c) { return static_cast<uint32_t>(c.what) >= k_along_count; });
    std::erase_if(a.dogs, is_nobody);
    std::erase_if(a.dogs, [](const Dog& dog) { return static_cast<uint32_t>(dog.breed) >= k_breeds; });
    std::erase_if(a.chairs, is_nobody);
    std::erase_if(a.players, is_nobody);
}

}  // namespace

void take_shown(const World& w, const std::vector<PoseBlock>& poses, bool is_exact, ColumnTick& tick) {
    clear(tick);
    auto fixed = [&](const auto& items, size_t count, const Parts& parts) {
        add_items(tick, bytes_in(items), sizeof(items[0]), count, parts, is_exact);
    };
    auto list = [&](const auto& items, const Parts& parts) { fixed(items, items.size(), parts); };
    list(w.crowd.slots.living, k_living);
    for_each_shown(w, fixed, list);
    if (!is_exact) return;
    fixed(poses, block_count(w.crowd.count), k_poses);
    fixed(w.trails, block_count(w.crowd.count), k_trails);
}

void put_shown(const ColumnChunk& chunk, uint32_t tick, World& w) {
    const Reader reader{chunk, tick};
    keep_previous(w);
    if (const auto slots = reader.count({all_of<uint32_t>("who.body")})) {
        constexpr uint32_t k_most = 1u << 21;
        const uint32_t count = std::min(*slots, k_most);
        make_room(w, count);
        w.crowd.count = count;
    }
    put_living(reader, w);
    for_each_shown(
        w, [&](auto& items, size_t count, const Parts& parts) { reader.read_fixed(items, count, parts); },
        [&](auto& items, const Parts& parts) {
            if (const std::optional<uint32_t> count = reader.count(parts)) items.resize(*count);
            reader.read_fixed(items, items.size(), parts);
        });
    reader.read_fixed(w.poses, w.poses.size(), k_poses);
    reader.read_fixed(w.trails, w.trails.size(), k_trails);
    leave_out_unknown(w);
    auto& before = w.balls.previous_places;
    const size_t balls = before.size();
    before.resize(w.balls.all.size());
    for (size_t i = balls; i < before.size(); ++i) before[i] = w.balls.all[i].place;
    w.tick = chunk.first + tick;
}

}  // namespace flaneur
