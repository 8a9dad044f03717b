// Where dogs go: beside or ahead of whom they belong to, to trees and posts, out of others' way.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "sim/alongside/parts.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr float k_lead = 1.9f;         // metres from the hand that a dog goes at most
constexpr float k_beside_most = 1.0f;  // metres within which others keep clear of it and the lead
constexpr float k_quicken = 1.7f;      // 1/s, towards its place
constexpr float k_quickest = 3.2f;     // m/s
constexpr float k_speeds_up = 4;       // m/s2
constexpr float k_turns = 2.0f;        // rad/s
constexpr float k_turns_standing = 0.8f;
constexpr float k_person = 0.20f;       // metres, half of a body's width at a dog's height, and feet
constexpr float k_minds = 1.1f;         // metres from others that it keeps, where it can
constexpr float k_thin = 0.35f;         // metres: half of what may be sniffed at, at most
constexpr float k_smells = 1.7f;        // metres
constexpr uint32_t k_looks_every = 40;  // ticks
constexpr float k_parted = 1.1f;        // metres from its owner, from where on it goes round what is between
constexpr float k_sits_after = 3.5f;    // seconds that its owner stands
constexpr size_t k_most_near = 96;
constexpr float k_dogs_near =
    3.6f;  // metres from a dog within which the owners of those are that it may touch

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }
DogDoes does_of(const Dog& dog) { return static_cast<DogDoes>(dog.does); }

void set_does(Dog& dog, DogDoes does, uint32_t tick, float seconds) {
    dog.does = static_cast<uint32_t>(does);
    dog.since = tick;
    dog.until = tick + ticks_of(seconds);
}

RandomKey key_of(const World& w, const Dog& dog, uint32_t when) {
    return {w.seed, dog.walker, dog.generation + 131 * when, Purpose::along};
}

// The nearest thin thing beside its way that it likes, by chance once for each.
const Obstacle* something_to_sniff(const World& w, const Dog& dog) {
    const Obstacle* found = nullptr;
    float least = k_smells;
    const Vec2 at = on_ground(dog.position);
    for (size_t k = 0; k < w.ground->obstacles.size(); ++k) {
        const Obstacle& o = w.ground->obstacles[k];
        const Vec2 to = on_ground(o.position) - at;
        if (std::fabs(to.x) > k_smells || std::fabs(to.z) > k_smells) continue;
        const float far = length(to);
        if (far >= least || std::max(o.half.x, o.half.z) > k_thin ||
            std::fabs(o.position.y - dog.position.y) > 1)
            continue;
        if (random_unit(key_of(w, dog, static_cast<uint32_t>(k) + 7), 3) > 0.35f) continue;
        found = &o, least = far;
    }
    return found;
}

bool may_stop_there(const World& w, const Dog& dog) {
    const Surface s = w.crowd.motion.under[dog.walker].kind;
    return !is_carriageway(s) && s != Surface::steps && can_be_called(w, dog.walker);
}

// Its owner waits while it sniffs.
void begin_to_sniff(World& w, Dog& dog, const Obstacle& o) {
    const uint32_t i = dog.walker;
    dog.finds = on_ground(o.position);
    set_does(dog, DogDoes::sniffs, w.tick, random_between(key_of(w, dog, w.tick), 3.5f, 8, 4));
    const Vec2 at = on_ground(w.crowd.motion.position[i]);
    const Vec2 goes = at + w.crowd.motion.velocity[i] * 0.45f;
    const Vec2 to_dog = normalize_or(dog.finds - goes, heading_direction(w.crowd.motion.heading[i]));
    call(w.crowd, {i, goes, to_dog, w.crowd.identity.preferred_speed[i]});
}

void think_dog(World& w, Dog& dog) {
    const uint32_t i = dog.walker;
    const bool stands = length(w.crowd.motion.velocity[i]) < 0.08f;
    switch (does_of(dog)) {
        case DogDoes::goes:
            if (stands) set_does(dog, DogDoes::waits, w.tick, 0);
            if ((w.tick + i) % k_looks_every != 0 || w.tick < dog.until || !may_stop_there(w, dog)) return;
            if (const Obstacle* o = something_to_sniff(w, dog)) begin_to_sniff(w, dog, *o);
            return;
        case DogDoes::sniffs:
            if (w.tick < dog.until && own_of(w.crowd.called, i) && !is_down(w.crowd, i)) return;
            call_off(w.crowd, i);
            // It goes on for a while before it finds the next one.
            set_does(dog, DogDoes::goes, w.tick, random_between(key_of(w, dog, w.tick), 8, 30, 5));
            return;
        case DogDoes::waits:
        case DogDoes::sits:
            if (!stands) return set_does(dog, DogDoes::goes, w.tick, 4);
            if (does_of(dog) == DogDoes::waits && w.tick - dog.since > ticks_of(k_sits_after))
                set_does(dog, DogDoes::sits, w.tick, 0);
            return;
    }
}

// Where it would like to be.
Vec2 place_of(const World& w, const Dog& dog) {
    const CrowdMotion& m = w.crowd.motion;
    const Vec2 owner = on_ground(m.position[dog.walker]);
    if (does_of(dog) == DogDoes::sniffs) {
        const float before = shape_of(dog.breed).half_long * dog.size + 0.45f * withers_of(dog);
        return dog.finds - normalize_or(dog.finds - on_ground(dog.position), {0, 1}) * before;
    }
    const Vec2 ahead = heading_direction(m.heading[dog.walker]);
    // Beside one who stands, as at a kerb.
    const float on = lerp(0.1f, dog.ahead, smoothstep(0.1f, 0.7f, length(m.velocity[dog.walker])));
    return owner + ahead * on + left_of(ahead) * dog.side;
}

// Away from those whom it would run into.
Vec2 keep_off(const World& w, const Dog& dog, Vec2 wanted) {
    std::array<uint32_t, k_most_near> near;
    const size_t count = those_near(w, dog.position, k_minds + 0.5f, near);
    const Vec2 nose =
        on_ground(dog.position) + heading_direction(dog.heading) * shape_of(dog.breed).half_long;
    for (const uint32_t i : std::span(near).first(count)) {
        const Vec2 off = nose - on_ground(w.crowd.motion.position[i]);
        const float far = length(off), room = i == dog.walker ? 0.45f : k_minds;
        if (far > room || far < 1e-4f || std::fabs(w.crowd.motion.position[i].y - dog.position.y) > 1)
            continue;
        wanted += off * ((1 - far / room) * 1.2f / far);
    }
    return wanted;
}

// Out of a disk; the dog is two, before and behind.
void push_out(Vec2& at, Vec2 way, float half_long, float radius, Vec2 other, float room) {
    for (const float end : {half_long, -half_long}) {
        const Vec2 off = at + way * end - other;
        const float far = length(off), touching = radius + room;
        if (far >= touching) continue;
        at += (far > 1e-4f ? off / far : left_of(way)) * (touching - far);
    }
}

Vec2 out_of_bodies(const World& w, const Dog& dog, Vec2 at) {
    const DogShape& s = shape_of(dog.breed);
    const Vec2 way = heading_direction(dog.heading);
    const float half_long = s.half_long * dog.size, radius = s.radius * dog.size;
    std::array<uint32_t, 4 * k_most_near> near;
    const size_t count = those_near(w, dog.position, k_dogs_near, near);
    const std::vector<Dog>& dogs = w.alongside->previous_dogs;
    for (const uint32_t i : std::span(near).first(count)) {
        const Dog* other = i == dog.walker ? nullptr : own_of(dogs, i);
        if (!other || length(on_ground(other->position) - at) > 1.6f) continue;
        const Vec2 their =
            heading_direction(other->heading) * (shape_of(other->breed).half_long * other->size);
        for (const float end : {1.0f, -1.0f})
            push_out(at, way, half_long, radius, on_ground(other->position) + their * end,
                     shape_of(other->breed).radius * other->size);
    }
    // Its owner last: nobody has it between the feet.
    for (const bool own : {false, true})
        for (const uint32_t i : std::span(near).first(count))
            if ((i == dog.walker) == own && std::fabs(w.crowd.motion.position[i].y - dog.position.y) < 1)
                push_out(at, way, half_long, radius, on_ground(w.crowd.motion.position[i]), k_person);
    return at;
}

// No farther than its lead lets it.
Vec2 on_lead(const World& w, Vec2 at, uint32_t owner) {
    const Vec2 from = on_ground(w.crowd.motion.position[owner]), off = at - from;
    const float far = length(off);
    return far > k_lead ? from + off * (k_lead / far) : at;
}

DogWish wish_of(const World& w, const Dog& dog) {
    const CrowdMotion& m = w.crowd.motion;
    DogWish wish;
    const Vec2 to = place_of(w, dog) - on_ground(dog.position);
    const float far = length(to), owner = length(m.velocity[dog.walker]);
    const bool sniffs = does_of(dog) == DogDoes::sniffs;
    wish.facing =
        sniffs ? heading_of(normalize_or(dog.finds - on_ground(dog.position), heading_direction(dog.heading)))
               : dog.heading;
    wish.sits = does_of(dog) == DogDoes::sits;
    if (wish.sits) return wish;
    // One who stands keeps still about there.
    const bool stays = owner < 0.1f && far < (dog.moves < 0.2f ? 0.5f : 0.12f);
    if (stays && !sniffs) return wish;
    if (sniffs && far < 0.06f) return wish;
    wish.velocity = (sniffs ? Vec2{} : m.velocity[dog.walker]) + to * k_quicken;
    const float most = std::min(k_quickest, sniffs ? 0.9f : 1.25f * owner + 0.9f),
                speed = length(wish.velocity);
    if (speed > most) wish.velocity = wish.velocity * (most / speed);
    wish.velocity = keep_off(w, dog, wish.velocity);
    return wish;
}

// Turns and speeds up as four legs can: along itself, hardly aside, and not far back.
void steer_dog(Dog& dog, const DogWish& wish, float dt) {
    const float wanted = length(wish.velocity);
    const float to = wanted > 0.12f ? heading_of(wish.velocity / wanted) : wish.facing;
    const float off = wrap_angle(to - dog.heading);
    // On the spot no faster than feet follow.
    const float most_turn = lerp(k_turns_standing, k_turns, smoothstep(0.1f, 0.5f, length(dog.velocity)));
    const float rate = clamp(3.5f * off, -most_turn, most_turn);
    dog.turn_rate += clamp(rate - dog.turn_rate, -14 * dt, 14 * dt);
    dog.heading = wrap_angle(dog.heading + dog.turn_rate * dt);
    const Vec2 way = heading_direction(dog.heading), left = left_of(way);
    float on = dot(wish.velocity, way), aside = clamp(dot(wish.velocity, left), -0.22f, 0.22f);
    // Who must turn far slows down for it.
    on = std::max(on, -0.15f) * smoothstep(-0.5f, 0.6f, sin_cos(off).cosine + 0.15f);
    const Vec2 goal = way * on + left * aside, by = goal - dog.velocity;
    const float most = k_speeds_up * dt, far = length(by);
    dog.velocity += far > most ? by * (most / far) : by;
    if (wanted == 0 && length(dog.velocity) < 0.03f) dog.velocity = {};
}

void mind_senses(const World& w, Dog& dog, float dt) {
    const bool sniffs = does_of(dog) == DogDoes::sniffs && length(dog.velocity) < 0.3f;
    // On the way it has its nose down now and then.
    const RandomKey key = key_of(w, dog, w.tick / 150);
    const bool noses = does_of(dog) == DogDoes::goes && dog.trots < 0.3f && random_unit(key, 6) < 0.3f;
    const float down = sniffs  ? 0.92f + 0.08f * sin_cos(0.35f * static_cast<float>(w.tick % 18)).sine
                       : noses ? 0.62f
                               : 0;
    dog.nose += clamp(down - dog.nose, -1.6f * dt, 1.6f * dt);
    float gaze = 0, pitch = 0;
    if (does_of(dog) == DogDoes::waits || does_of(dog) == DogDoes::sits) {
        // By turns up to its owner and about.
        if (random_unit(key, 7) < 0.5f) {
            const Vec2 to = on_ground(w.crowd.motion.position[dog.walker] - dog.position);
            gaze = clamp(wrap_angle(heading_of(normalize_or(to, {0, 1})) - dog.heading), -1.1f, 1.1f),
            pitch = 0.6f;
        } else {
            gaze = random_between(key, -0.8f, 0.8f, 8);
        }
    } else if (!sniffs) {
        gaze = random_between(key, -0.35f, 0.35f, 8);
    }
    dog.gaze += (gaze - dog.gaze) * std::min(3.5f * dt, 1.0f);
    dog.gaze_pitch += (pitch - dog.gaze_pitch) * std::min(3.5f * dt, 1.0f);
    const float wags = random_unit(key, 9) < 0.45f ? 1 : 0.15f;
    dog.wags += (wags - dog.wags) * std::min(2 * dt, 1.0f);
    dog.wag += (1.1f + 1.7f * dog.wags) * dt;
    dog.wag -= std::floor(dog.wag);
}

void walk_dog(const World& w, Dog& dog, uint32_t ticks, int thread) {
    const uint32_t i = dog.walker;
    const float dt = static_cast<float>(ticks) * k_tick;
    constexpr float k_lost = 4;  // metres: it was left behind where no way leads
    if (length(w.crowd.motion.position[i] - dog.position) > k_lost) {
        const float heading = dog.heading;
        dog = make_dog(w, i, thread);
        dog.heading = heading;
        stand_dog(dog, w.around);
        return;
    }
    const DogWish wish = wish_of(w, dog);
    const Vec2 from = on_ground(dog.position);
    steer_dog(dog, wish, dt);
    Vec2 to = from + dog.velocity * dt;
    // Whoever comes into its way, it gets out of there as fast as it runs; one that falls behind its owner
    // squeezes through.
    const Vec2 out = out_of_bodies(w, dog, to) - to;
    const float pushed = length(out), most = k_quickest * dt;
    const float yields =
        1 - 0.8f * smoothstep(1.4f, k_lead, length(to - on_ground(w.crowd.motion.position[i])));
    to += out * (yields * std::min(1.0f, most / std::max(pushed, 1e-4f)));
    // A lead pulls, but never throws.
    const Vec2 pulled = on_lead(w, to, i) - to;
    to += pulled * std::min(1.0f, 2 * most / std::max(length(pulled), 1e-4f));
    const NavPoint here{dog.position, dog.polygon};
    NavPoint end = move_along(*w.navmesh, thread, here, at_height(to, dog.position.y));
    // Where something is between, it goes round it, for a while to one side.
    const float far = length(from - on_ground(w.crowd.motion.position[i])), wanted = length(to - from);
    if (far > k_parted && length(on_ground(end.position) - from) < 0.4f * wanted) {
        const SinCos by = sin_cos((w.tick / 150 + i) % 2 == 0 ? 1.3f : -1.3f);
        const Vec2 way = to - from;
        const Vec2 round{way.x * by.cosine + way.z * by.sine, way.z * by.cosine - way.x * by.sine};
        end = move_along(*w.navmesh, thread, here, at_height(from + round, dog.position.y));
    }
    dog.polygon = end.polygon;
    dog.position = end.position;
    if (const auto hit = ground_at(w.around, end.position, 0.5f, 1)) dog.position.y = hit->height;
    const Vec2 went = (on_ground(dog.position) - from) / dt;
    // What pushes it aside is not what it wants; its feet mind where it goes.
    const Vec2 by = went - dog.velocity;
    const float off = length(by);
    if (off > 1e-4f) dog.velocity += by * std::min(1.0f, 6 * dt / off);
    constexpr uint32_t k_at_once = 3;  // ticks that a stride can be told in
    const uint32_t steps = (ticks + k_at_once - 1) / k_at_once;
    for (uint32_t n = 0; n < steps; ++n) step_dog(dog, wish, w.around, dt / static_cast<float>(steps));
    mind_senses(w, dog, dt);
}

}  // namespace

Dog make_dog(const World& w, uint32_t i, int thread) {
    const CrowdMotion& m = w.crowd.motion;
    Dog dog;
    dog.walker = i, dog.generation = w.crowd.slots.generation[i];
    const RandomKey key{w.seed, i, dog.generation, Purpose::along};
    dog.breed = static_cast<Breed>(random_bits(key, 11) % k_breeds);
    dog.coat = static_cast<uint32_t>(random_bits(key, 12) % 16);
    dog.size = random_between(key, 0.92f, 1.08f, 13);
    const bool has_left = (person_of(w, i).free_hands[i % k_block] & 1 << k_left) != 0;
    const float side = has_left ? 1.0f : -1.0f;
    dog.side = side * random_between(key, 0.55f, 0.75f, 14);
    dog.ahead = random_between(key, 0.1f, 0.75f, 15);
    dog.heading = m.heading[i];
    dog.wag = random_unit(key, 16), dog.phase = random_unit(key, 17);
    const Vec2 way = heading_direction(dog.heading);
    const Vec2 at = on_ground(m.position[i]) + way * dog.ahead + left_of(way) * dog.side;
    const NavPoint end =
        move_along(*w.navmesh, thread, {m.position[i], m.polygon[i]}, at_height(at, m.position[i].y));
    dog.position = end.position, dog.polygon = end.polygon;
    if (const auto hit = ground_at(w.around, end.position, 0.5f, 1)) dog.position.y = hit->height;
    stand_dog(dog, w.around);
    return dog;
}

void think_dogs(World& w) {
    for (Dog& dog : w.alongside->dogs) think_dog(w, dog);
}

void find_dogs_anew(World& w) {
    if (!w.alongside) return;
    for (Dog& dog : w.alongside->dogs) {
        const CrowdMotion& m = w.crowd.motion;
        const auto place = nearest(*w.navmesh, 0, dog.position);
        const NavPoint at = place ? *place : NavPoint{m.position[dog.walker], m.polygon[dog.walker]};
        dog.position = at.position, dog.polygon = at.polygon;
    }
}

void walk_dogs(World& w) {
    Alongside& a = *w.alongside;
    parallel_for(*w.workers, a.dogs.size(), 4, [&](size_t begin, size_t end, int thread) {
        // Along with who has it.
        for (size_t k = begin; k < end; ++k)
            if (const uint32_t ticks = ticks_due(w.crowd, a.dogs[k].walker / k_block, w.tick))
                walk_dog(w, a.dogs[k], ticks, thread);
    });
    for (const Dog& dog : a.dogs) {
        GoesBeside* own = own_of(w.crowd.beside, dog.walker);
        if (!own) continue;
        const Vec2 to = on_ground(dog.position - w.crowd.motion.position[dog.walker]);
        const float far = length(to);
        own->to = far > k_beside_most ? to * (k_beside_most / far) : to;
    }
}

}  // namespace flaneur
