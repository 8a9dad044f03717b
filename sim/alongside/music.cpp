// Who plays on squares, how hands go with it, and who stops to listen.
//
// Whatever there is to look at draws strangers together (Whyte, "The Social Life of Small Urban Spaces",
// 1980); they stand at the far end of social distance, 2 to 3.6 m (Hall, "The Hidden Dimension", 1966).
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "sim/alongside/parts.h"
#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/spans.h"
#include "sim/fall/limbs.h"
#include "sim/world.h"

namespace flaneur {

namespace {

constexpr float k_tempo = 1.6f;                       // beats a second
constexpr float k_nearest = 2.1f, k_farthest = 3.6f;  // metres
constexpr float k_arc = 1.15f;                        // radians to each side of where it faces
constexpr float k_hears = 8;                          // metres
constexpr float k_stops = 0.22f;                      // of those who come by
constexpr size_t k_most = 8;                          // who listen to one
constexpr uint32_t k_looks_every = 15;                // ticks
constexpr float k_hat_ahead = 0.95f;                  // metres
constexpr float k_open = 0.16f;                       // metres that an accordion opens

uint32_t ticks_of(float seconds) { return static_cast<uint32_t>(seconds / k_tick); }
float wave(float beats) { return sin_cos(2 * k_pi * (beats - std::floor(beats))).sine; }

const Player* player_of(const World& w, uint32_t walker) {
    for (const Player& p : w.alongside->players)
        if (p.walker == walker) return &p;
    return nullptr;
}

// Out from the nearest border of the mesh, or any way where none is near.
Vec2 open_way(const World& w, Vec3 at, RandomKey key) {
    BorderLine lines[8];
    const int count = borders_near(*w.navmesh, at, 4, lines, 8);
    if (count == 0) return heading_direction(random_between(key, -k_pi, k_pi, 21));
    Vec2 way;
    for (int k = 0; k < count; ++k) way += inward_of(lines[k]);
    return normalize_or(way, heading_direction(random_between(key, -k_pi, k_pi, 21)));
}

// How much room there is before one who plays there: metres all round half of the arc.
bool has_room_before(const World& w, Vec3 at, Vec2 facing) {
    constexpr float k_room = 3.2f;
    for (const float aside : {-0.7f, 0.0f, 0.7f}) {
        const Vec2 way = facing + left_of(facing) * aside;
        if (!is_clear(*w.navmesh, at, at + at_height(normalize_or(way, facing) * k_room, 0))) return false;
    }
    return true;
}

std::optional<NavPoint> place_to_play(const World& w, uint32_t number, uint32_t tries) {
    const RandomKey key{w.seed, number, tries, Purpose::along};
    const auto& squares = w.crowd.demand.attractions[static_cast<size_t>(DestinationKind::square)];
    if (!squares.empty() && tries < 60) return squares[random_bits(key, 22) % squares.size()].place;
    const NavPoint place =
        random_place_near(*w.navmesh, 0, w.coming.home.centre, w.coming.home.radius, random_unit(key, 23),
                          random_unit(key, 24), random_unit(key, 25));
    const Surface kind = surface_of(*w.navmesh, place.polygon);
    if (kind != Surface::plaza && kind != Surface::path && kind != Surface::sidewalk) return std::nullopt;
    return place;
}

bool is_near_others(const World& w, Vec2 at) {
    constexpr float k_apart = 14;  // metres
    return std::ranges::any_of(w.alongside->players,
                               [&](const Player& p) { return length(p.at - at) < k_apart; });
}

// A grown one with both hands free.
uint32_t kind_that_plays(const World& w, RandomKey key) {
    uint32_t seen = 0, found = 0;
    for (uint32_t k = 0; k < w.kinds.size(); ++k) {
        const Kind& kind = w.kinds[k];
        const Wear& wear = kind.body.wear;
        if (kind.age < 17 || kind.body.cane != Vec3{} || kind.body.pram != Vec3{} || wear.bag != Bag::none ||
            wear.phone)
            continue;
        // Each of them as likely.
        if (random_bits(key, 30 + k) % ++seen == 0) found = k;
    }
    return found;
}

void set_player(World& w, uint32_t number) {
    for (uint32_t tries = 0; tries < 120; ++tries) {
        const auto place = place_to_play(w, number, tries);
        if (!place || is_near_others(w, on_ground(place->position))) continue;
        const RandomKey key{w.seed, number, tries, Purpose::along};
        const Vec2 facing = open_way(w, place->position, key);
        if (!has_room_before(w, place->position, facing)) continue;
        const Result<WalkerId> id = add_walker(
            w, {.place = place->position, .heading = heading_of(facing), .kind = kind_that_plays(w, key)});
        if (!id) continue;
        Alongside& a = *w.alongside;
        const uint32_t i = id->index;
        leave_along(w, i);
        const auto what = static_cast<Along>(static_cast<uint32_t>(Along::guitar) + number % 3);
        const Companion own{i, id->generation, what, 1};
        a.companions.insert(take_away(a.companions, i), own);
        fill_hands(w, own);
        const Vec2 at = on_ground(w.crowd.motion.position[i]);
        Player p;
        p.walker = i, p.generation = id->generation;
        p.at = at, p.facing = facing, p.stands = 1;
        p.beat = 7 * random_unit(key, 26);
        const Vec2 hat = at + facing * k_hat_ahead;
        p.hat = at_height(hat, w.crowd.motion.position[i].y);
        if (const auto hit = ground_at(w.around, p.hat, 0.5f, 1)) p.hat.y = hit->height;
        a.players.push_back(p);
        w.crowd.beside.insert(take_away(w.crowd.beside, i), GoesBeside{i, facing * (k_hat_ahead - 0.15f)});
        w.crowd.journeys[i].facing = facing;
        return;
    }
}

// A free place of the arc before one who plays; none where others stand.
std::optional<Vec2> place_to_listen(const World& w, const Player& p, RandomKey key) {
    constexpr float k_apart = 0.85f;  // metres, between listeners
    for (uint32_t tries = 0; tries < 6; ++tries) {
        const float turn = random_between(key, -k_arc, k_arc, 40 + tries);
        const float far = random_between(key, k_nearest, k_farthest, 50 + tries);
        const SinCos by = sin_cos(turn);
        const Vec2 at = p.at + (p.facing * by.cosine + left_of(p.facing) * by.sine) * far;
        const bool is_taken = std::ranges::any_of(w.alongside->listeners, [&](const Listener& l) {
            const Called* called = own_of(w.crowd.called, l.walker);
            return called && length(called->to - at) < k_apart;
        });
        if (!is_taken) return at;
    }
    return std::nullopt;
}

void call_listeners(World& w, uint32_t number) {
    Alongside& a = *w.alongside;
    const Player& p = a.players[number];
    size_t count = 0;
    for (const Listener& l : a.listeners) count += l.player == number;
    if (count >= k_most) return;
    std::array<uint32_t, 512> near;  // all who are: those there is no room for would be any
    const Vec3 at = w.crowd.motion.position[p.walker];
    const size_t found = those_near(w, at, k_hears, near);
    for (const uint32_t i : std::span(near).first(found)) {
        if (a.listeners.size() == a.listeners.capacity()) return;
        const Vec2 to = on_ground(w.crowd.motion.position[i]) - p.at;
        // Once for each whom the music reaches while it is on a trip.
        const RandomKey key{w.seed, i, w.crowd.journeys[i].trip * 31 + number, Purpose::along};
        const bool would = random_unit(key, 41) < k_stops * (1 + 0.3f * personality_of(w, i).openness);
        if (!would || dot(to, p.facing) < -0.2f * length(to) || own_of(a.listeners, i) ||
            own_of(a.companions, i) || is_creature(w.herd, i) || w.crowd.identity.ahead[i] > 0 ||
            !can_be_called(w, i) || w.crowd.journeys[i].leaves)
            continue;
        const auto place = place_to_listen(w, p, key);
        const Vec3 from = w.crowd.motion.position[i];
        if (!place || !is_clear(*w.navmesh, from, at_height(*place, from.y))) continue;
        Listener l;
        l.walker = i, l.generation = w.crowd.slots.generation[i];
        l.player = number;
        l.until = w.tick + ticks_of(random_between(key, 14, 60, 42));
        l.claps = random_unit(key, 43) < 0.35f ? 1 : 0;
        a.listeners.insert(take_away(a.listeners, i), l);
        call(w.crowd, {i, *place, normalize_or(p.at - *place, {0, 1}), w.crowd.identity.preferred_speed[i]});
        return;  // one at a time
    }
}

// Whether one has come to where it listens, and is to stay.
void mind_listener(World& w, Listener& l) {
    const Called* called = own_of(w.crowd.called, l.walker);
    const bool is_gone = !called || !is_there(w.crowd, l.walker) || is_down(w.crowd, l.walker) ||
                         w.crowd.slots.generation[l.walker] != l.generation;
    const bool goes_on = is_gone || w.tick >= l.until;
    const bool is_there_now = called &&
                              length(called->to - on_ground(w.crowd.motion.position[l.walker])) < 0.4f &&
                              length(w.crowd.motion.velocity[l.walker]) < 0.1f;
    const float to = !goes_on && is_there_now ? 1.0f : 0.0f;
    l.heeds = clamp(l.heeds + clamp(to - l.heeds, -1.6f * k_tick, 0.6f * k_tick), 0, 1);
    if (!is_gone && goes_on && l.heeds <= 0) call_off(w.crowd, l.walker);
}

// What an instrument is held by: the body's own axes.
struct Front {
    Vec3 ahead, left, up;
};
Front front_of(Quat chest) {
    return {rotate(chest, {0, 0, 1}), rotate(chest, {1, 0, 0}), rotate(chest, {0, 1, 0})};
}

Placement frame_of(Vec3 at, Vec3 neck, Vec3 out) {
    const Vec3 x = normalize_or(neck, {1, 0, 0}), z = normalize_or(out - x * dot(out, x), {0, 0, 1});
    const Quat first = rotation_between({1, 0, 0}, x);
    const Vec3 z0 = rotate(first, {0, 0, 1});
    return {at, normalize(rotation_about(x, arctan2(dot(cross(z0, z), x), dot(z0, z))) * first)};
}

// Where an instrument is on a chest; `height` of the body.
Placement instrument_at(Along what, Vec3 chest, Quat turn, float height) {
    const Front f = front_of(turn);
    const float s = height / 1.72f;
    if (what == Along::guitar)
        return frame_of(chest + (f.ahead * 0.185f - f.left * 0.06f - f.up * 0.255f) * s,
                        f.left * 0.90f + f.up * 0.42f + f.ahead * 0.10f, f.ahead);
    if (what == Along::violin)
        return frame_of(chest + (f.ahead * 0.20f + f.left * 0.155f + f.up * 0.125f) * s,
                        f.left * 0.55f + f.ahead * 0.83f - f.up * 0.06f, f.up * 0.85f - f.left * 0.45f);
    return frame_of(chest + (f.ahead * 0.255f - f.up * 0.10f) * s, f.left, f.ahead);
}

// How the music has it: -1 .. 1.
float stroke_of(const Player& p) { return wave(0.5f * p.beat); }
float bow_of(const Player& p) { return wave(0.25f * p.beat) + 0.15f * wave(0.75f * p.beat); }

float bellows_of(const Player& p) { return 0.5f + 0.5f * wave(0.125f * p.beat); }

constexpr Vec3 k_strings{0.02f, 0.0f, 0.055f};    // of a guitar, where the right hand strums
constexpr Vec3 k_bow_meets{0.02f, 0.0f, 0.035f};  // the strings of a violin
// Of its frame, from there to the hand.
Vec3 bow_way() { return normalize_or(Vec3{0.16f, -0.97f, 0.16f}, {0, -1, 0}); }

// How fast it goes by its phrase: hands wait at the ends of each.
void play_on(Player& p) {
    p.beat += k_tempo * k_tick;
    if (p.beat >= 64) p.beat -= 64;
}

}  // namespace

void set_players(World& w) {
    Alongside& a = *w.alongside;
    if (a.shares.musicians == 0) return;
    make_room(w, static_cast<uint32_t>(w.crowd.slots.living.size()) + a.shares.musicians);
    a.players.reserve(a.shares.musicians);
    for (uint32_t n = 0; n < a.shares.musicians; ++n) set_player(w, n);
}

void think_music(World& w) {
    Alongside& a = *w.alongside;
    for (Player& p : a.players) {
        const bool is_here =
            is_there(w.crowd, p.walker) && w.crowd.slots.generation[p.walker] == p.generation;
        p.stands = is_here && !is_down(w.crowd, p.walker) &&
                   length(on_ground(w.crowd.motion.position[p.walker]) - p.at) < 1.5f;
        if (p.stands != 0) play_on(p);
    }
    for (uint32_t n = 0; n < a.players.size(); ++n)
        if (a.players[n].stands != 0 && (w.tick + 5 * n) % k_looks_every == 0) call_listeners(w, n);
    for (Listener& l : a.listeners) mind_listener(w, l);
    std::erase_if(a.listeners, [&](const Listener& l) {
        const bool is_called = own_of(w.crowd.called, l.walker) != nullptr;
        return !is_called && l.heeds <= 0;
    });
}

void pose_player(const World& w, const Companion& c, BodyPose& pose) {
    const Player* p = player_of(w, c.walker);
    if (!p) return;
    const Holder h = holder_of(w, c.walker);
    const float height = h.person.height[h.lane], s = height / 1.72f;
    // It moves with the music.
    const float sways = 0.035f * wave(0.25f * p->beat);
    const Vec3 ahead = rotate(pose.rotation[hips], {0, 0, 1});
    for (int j = spine; j <= right_hand; ++j) {
        const float share = j == spine ? 0.4f : j == chest ? 0.8f : 1;
        pose.rotation[j] = normalize(rotation_about(ahead, share * sways) * pose.rotation[j]);
    }
    const float nods = 0.05f * wave(p->beat);
    const HeadTurn gaze = c.what == Along::guitar   ? HeadTurn{0.35f, -0.28f + nods}
                          : c.what == Along::violin ? HeadTurn{0.38f, -0.25f + 0.4f * nods}
                                                    : HeadTurn{0.1f * wave(0.125f * p->beat), nods};
    turn_head(pose, gaze, c.holds);
    const auto at = places_of(pose, h.person, h.lane);
    const Placement i = instrument_at(c.what, at[upper_chest], pose.rotation[upper_chest], height);
    const Front f = front_of(pose.rotation[upper_chest]);
    if (c.what == Along::guitar) {
        const float fret = 0.46f + 0.05f * wave(0.125f * p->beat);
        bring_palm(pose, h, k_left, to_world(i, Vec3{fret, -0.03f, 0.005f} * s),
                   f.left * 0.5f - f.up - f.ahead * 0.2f, c.holds);
        const Vec3 strum = k_strings + Vec3{0.0f, 0.055f * stroke_of(*p), 0.01f};
        bring_palm(pose, h, k_right, to_world(i, strum * s), f.left * -1.0f - f.up * 0.2f - f.ahead * 0.5f,
                   c.holds);
    } else if (c.what == Along::violin) {
        bring_palm(pose, h, k_left, to_world(i, Vec3{0.27f, 0.0f, -0.035f} * s), f.left * 0.15f - f.up,
                   c.holds);
        const Vec3 frog = k_bow_meets + bow_way() * (0.31f + 0.20f * bow_of(*p));
        bring_palm(pose, h, k_right, to_world(i, frog * s), f.left * -1.0f - f.up * 0.35f, c.holds);
    } else {
        const float open = 0.5f * (0.34f + k_open * bellows_of(*p));
        for (const Side side : {k_left, k_right}) {
            const float out = side == k_left ? 1.0f : -1.0f;
            const Vec3 palm{out * (open + 0.01f), 0.02f * wave(p->beat + 0.25f * out), 0.02f};
            bring_palm(pose, h, side, to_world(i, palm * s),
                       f.left * (0.9f * out) - f.up * 0.8f - f.ahead * 0.4f, c.holds);
        }
    }
}

void pose_listener(const World& w, const Listener& l, BodyPose& pose) {
    const Player& p = w.alongside->players[l.player];
    const Holder h = holder_of(w, l.walker);
    const float height = h.person.height[h.lane];
    const float heeds = smoothstep(0, 1, l.heeds);
    turn_head(pose,
              turn_to_look(pose, h.person, h.lane, w.crowd.motion.position[p.walker] + Vec3{0, 1.4f, 0}),
              0.9f * heeds);
    const float sways =
        (l.claps != 0 ? 0.012f : 0.04f) * wave(0.25f * p.beat + 0.1f * static_cast<float>(l.walker % 3));
    const Vec3 ahead = rotate(pose.rotation[hips], {0, 0, 1});
    for (int j = spine; j <= right_hand; ++j) {
        const float share = j == spine ? 0.4f : j == chest ? 0.8f : 1;
        pose.rotation[j] = normalize(rotation_about(ahead, heeds * share * sways) * pose.rotation[j]);
    }
    if (l.claps == 0 || h.person.free_hands[h.lane] != 3) return;
    // On each beat hands meet before the chest.
    const auto at = places_of(pose, h.person, h.lane);
    const Front f = front_of(pose.rotation[upper_chest]);
    const float apart =
        0.012f + 0.065f * (0.5f - 0.5f * sin_cos(2 * k_pi * (p.beat - std::floor(p.beat))).cosine);
    for (const Side side : {k_left, k_right}) {
        const float out = side == k_left ? 1.0f : -1.0f;
        const Vec3 palm = at[upper_chest] + f.ahead * (0.155f * height) - f.up * (0.055f * height) +
                          f.left * (out * apart * height * 0.6f);
        bring_palm(pose, h, side, palm, f.left * (0.7f * out) - f.up, heeds);
    }
}

Placement held_between(const World& w, const Companion& c, float between) {
    if (c.what == Along::white_cane) return white_cane_between(w, c, between);
    if (c.what == Along::umbrella) return umbrella_between(w, c, between);
    const BodyAt b = body_between(w, c.walker, between);
    return instrument_at(c.what, b.chest, b.chest_turn, b.height);
}

Placement bow_between(const World& w, const Companion& c, float between) {
    const Placement i = held_between(w, c, between);
    const BodyAt b = body_between(w, c.walker, between);
    // From the hand over the strings.
    const Vec3 meets = to_world(i, k_bow_meets * (b.height / 1.72f)), grip = b.palms[k_right];
    const Vec3 up = rotate(i.turn, {0, 0, 1});
    return frame_of(grip, grip - meets, up);
}

float bellows_between(const World& w, const Companion& c, float between) {
    const BodyAt b = body_between(w, c.walker, between);
    return length(b.palms[k_left] - b.palms[k_right]);
}

}  // namespace flaneur
