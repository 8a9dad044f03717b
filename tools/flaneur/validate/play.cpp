#include "tools/flaneur/validate/play.h"

#include <algorithm>
#include <cmath>

#include "sim/base/rng.h"
#include "sim/base/tick.h"
#include "sim/world.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {
namespace {

constexpr float k_patience = 5;  // seconds that one who cannot be set down may wait where nobody else is

struct Cast {
    WorldPtr world;
    std::vector<WalkerId> ids;  // by guest
    std::vector<uint8_t> here, sent;
    size_t left = 0;
};

// Whoever is due and finds room.
Result<void> let_in(Cast& cast, std::span<const Guest> guests, Play& play, float now) {
    for (size_t i = 0; i < guests.size(); ++i) {
        const Guest& guest = guests[i];
        if (play.fates[i].entered || guest.enters > now) continue;
        WalkerOptions options{.place = guest.from, .heading = guest.heading, .kind = guest.kind};
        if (guest.speed > 0) options.speed = guest.speed;
        Result<WalkerId> id = add_walker(*cast.world, options);
        if (!id) {
            const bool alone = walkers(*cast.world).empty() && now > guest.enters + k_patience;
            if (alone) return id.error();
            continue;
        }
        cast.ids[i] = *id;
        cast.here[i] = 1;
        cast.world->crowd.motion.velocity[id->index] = guest.velocity;
        play.fates[i].entered = now;
    }
    return {};
}

Result<void> send_off(Cast& cast, std::span<const Guest> guests, float now) {
    for (size_t i = 0; i < guests.size(); ++i) {
        if (!cast.here[i] || cast.sent[i] || guests[i].starts > now) continue;
        if (Result<void> sent = send_to(*cast.world, cast.ids[i], guests[i].goal); !sent) return sent;
        cast.sent[i] = 1;
    }
    return {};
}

void look(Cast& cast, std::span<const Guest> guests, Play& play, float now) {
    for (size_t i = 0; i < guests.size(); ++i) {
        if (!cast.here[i]) continue;
        const WalkerMotion motion = *motion_of(*cast.world, cast.ids[i]);
        if (!play.fates[i].moved && length(motion.velocity) > k_moving) play.fates[i].moved = now;
        if (!is_in(guests[i].exit, on_ground(motion.position))) continue;
        remove_walker(*cast.world, cast.ids[i]);
        cast.here[i] = 0;
        ++cast.left;
        play.fates[i].left = now;
    }
}

void sample(const Cast& cast, Play& play, uint32_t frame) {
    for (size_t i = 0; i < cast.ids.size(); ++i) {
        if (!cast.here[i]) continue;
        const WalkerMotion motion = *motion_of(*cast.world, cast.ids[i]);
        play.tracks.sightings.push_back(
            {frame, static_cast<uint32_t>(i), on_ground(motion.position), motion.position.y, {}});
    }
}

}  // namespace

Result<Play> play(const Arena& arena, std::span<const Guest> guests, const PlayOptions& options) {
    Result<WorldPtr> world = make_world_on(arena.ground, {.capacity = static_cast<uint32_t>(guests.size()),
                                                          .seed = options.seed,
                                                          .threads = 1,
                                                          .kinds = options.kinds,
                                                          .navmesh = arena_mesh()});
    if (!world) return world.error();
    Cast cast{std::move(*world), {}, {}, {}, 0};
    cast.ids.resize(guests.size());
    cast.here.resize(guests.size());
    cast.sent.resize(guests.size());
    Play play;
    play.fates.resize(guests.size());
    play.tracks.area = arena.area;
    if (options.sample_ticks > 0)
        play.tracks.fps = static_cast<float>(k_ticks_a_second) / static_cast<float>(options.sample_ticks);
    const auto ticks = static_cast<uint32_t>(std::lround(options.seconds * k_ticks_a_second));
    for (uint32_t tick = 0; tick < ticks && cast.left < guests.size(); ++tick) {
        if (is_stopping()) return interrupted();
        const float now = static_cast<float>(tick) * k_tick;
        if (Result<void> came = let_in(cast, guests, play, now); !came) return came.error();
        if (Result<void> went = send_off(cast, guests, now); !went) return went.error();
        if (options.before_tick) options.before_tick(*cast.world, cast.ids);
        if (options.sample_ticks > 0 && tick % options.sample_ticks == 0)
            sample(cast, play, tick / options.sample_ticks);
        step(*cast.world);
        play.seconds = static_cast<float>(tick + 1) * k_tick;
        look(cast, guests, play, play.seconds);
    }
    return play;
}

std::optional<float> last_left(const Play& play) {
    float last = 0;
    for (const GuestFate& fate : play.fates) {
        if (!fate.left) return std::nullopt;
        last = std::max(last, *fate.left);
    }
    return last;
}

size_t count_left(const Play& play) {
    return static_cast<size_t>(std::count_if(play.fates.begin(), play.fates.end(),
                                             [](const GuestFate& fate) { return fate.left.has_value(); }));
}

std::vector<Vec2> spread(const Rectangle& over, size_t count, uint64_t seed) {
    // Rows of a lattice of triangles, `apart` from each other.
    constexpr float k_row = 0.866f;
    const Vec2 size = over.high - over.low;
    std::vector<Vec2> places;
    float apart = 0;
    for (apart = std::sqrt(size.x * size.z / (k_row * static_cast<float>(std::max<size_t>(count, 1))));
         apart > k_body_width; apart *= 0.995f) {
        places.clear();
        const auto rows = static_cast<size_t>(size.z / (apart * k_row)) + 1;
        for (size_t row = 0; row < rows; ++row)
            for (float x = row % 2 == 0 ? 0 : apart / 2; x <= size.x; x += apart)
                places.push_back(over.low + Vec2{x, static_cast<float>(row) * apart * k_row});
        if (places.size() >= count) break;
    }
    // Those that are too many go by chance; each strays as far as leaves the others room.
    const float stray = std::max(0.0f, (apart - k_body_width) / 2 - 0.005f);
    for (size_t i = places.size(); i-- > 1;) {
        const auto other = static_cast<size_t>(
            random_unit({seed, static_cast<uint32_t>(i), 0, Purpose::spawn}) * static_cast<float>(i + 1));
        std::swap(places[i], places[std::min(other, i)]);
    }
    if (places.size() > count) places.resize(count);
    for (size_t i = 0; i < places.size(); ++i) {
        const RandomKey key{seed, static_cast<uint32_t>(i), 1, Purpose::spawn};
        places[i] +=
            Vec2{random_between(key, -stray, stray, 0), random_between(key, -stray, stray, 1)} * 0.7f;
        places[i] = {clamp(places[i].x, over.low.x, over.high.x),
                     clamp(places[i].z, over.low.z, over.high.z)};
    }
    return places;
}

float weidmann_wish(uint64_t seed, uint32_t number) {
    return clamp(1.34f + 0.26f * random_normal({seed, number, 2, Purpose::body}), 0.8f, 1.9f);
}

}  // namespace flaneur
