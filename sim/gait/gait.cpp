#include "sim/gait/gait.h"

#include <algorithm>
#include <cstring>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/base/rng.h"
#include "sim/gait/curves/fits.h"
#include "sim/gait/curves/norms.h"
#include "sim/gait/hands.h"
#include "sim/gait/jump.h"
#include "sim/gait/rest.h"
#include "sim/gait/rows.h"
#include "sim/gait/states.h"
#include "sim/gait/steps.h"

namespace flaneur {

float stride_length(float v, float leg) {
    return 2 * k_step_factor * leg * std::sqrt(v / std::sqrt(k_gravity * leg));
}

constexpr float k_pushing_lean = 0.05f;  // radians that who pushes a pram leans more

// Every row of a block is of lanes of four bytes.
static void clear_lane(GaitBlock& block, int lane) {
    auto* rows = reinterpret_cast<unsigned char*>(&block);
    for (size_t row = 0; row < sizeof(GaitBlock) / (4 * k_block); ++row)
        std::memset(rows + (row * k_block + static_cast<size_t>(lane)) * 4, 0, 4);
}

// Standing still.
static Stepper stepper_at(const Gait& gait, size_t i, const Surroundings& around, Vec3 root, float heading,
                          Vec2 facing) {
    int lane = static_cast<int>(i % k_block);
    const PersonBlock& person = gait.people[i / k_block];
    return {.person = person,
            .lane = lane,
            .around = around,
            .root = root,
            .heading = heading,
            .facing = facing,
            .leg_length = person.joints[left_upper_leg][1][lane]};
}

int32_t free_hands_of(const Wear& wear) { return wear.phone ? 1 : wear.bag == Bag::handbag ? 2 : 3; }

// How far arms swing and bend with what the person carries, and the postures that pockets, bags and full
// hands leave it.
static void set_arms(PersonBlock& p, int lane, const Body& b, float scale, const Manner& m) {
    const Wear& wear = b.wear;
    for (int side = 0; side < 2; ++side) {
        p.arm_swing[side][lane] = m.arm_swing[side];
        p.elbow[side][lane] = m.elbow;
        bool loaded = wear.bag == (side == k_left ? Bag::handbag : Bag::shoulder_bag);
        if (loaded) {
            p.arm_swing[side][lane] *= 0.33f;
            p.elbow[side][lane] += 0.12f;
        } else if (wear.bag == Bag::backpack) {
            p.arm_swing[side][lane] *= 0.8f;
            p.elbow[side][lane] += 0.06f;
        }
    }
    Girth girth = girth_of(b);
    const float sizes[] = {girth.hip, girth.belly, girth.back, girth.chest};
    for (int i = 0; i < 4; ++i) p.girth[i][lane] = sizes[i] * scale;
    p.height[lane] = b.height * scale;

    auto likes = m.postures;
    auto never = [&](Posture posture) { likes[static_cast<size_t>(posture)] = 0; };
    if (b.cane.x != 0 || b.cane.y != 0 || b.cane.z != 0 || b.pram.y != 0) likes = {};
    if (!wear.pockets) never(Posture::pocket), never(Posture::pockets);
    if (wear.bag == Bag::none || wear.bag == Bag::handbag) never(Posture::strap);
    if (wear.bag != Bag::none) never(Posture::behind);
    if (wear.phone || wear.bag == Bag::handbag) {
        for (Posture both : {Posture::pockets, Posture::hips, Posture::behind, Posture::fold}) never(both);
    }
    if (wear.phone) never(Posture::clasp);
    for (int i = 0; i < k_posture_count; ++i) p.postures[i][lane] = likes[static_cast<size_t>(i)];
    p.free_hands[lane] = free_hands_of(wear);
    p.bag[lane] = static_cast<int32_t>(wear.bag);
}

static void set_person(PersonBlock& person, int lane, const Body& b, float scale, const Manner& m) {
    for (int j = 0; j < k_joint_count; ++j) {
        person.joints[j][0][lane] = b.joints[j].x * scale;
        person.joints[j][1][lane] = b.joints[j].y * scale;
        person.joints[j][2][lane] = b.joints[j].z * scale;
    }
    person.heel[lane] = b.heel * scale;
    person.toe[lane] = b.toe * scale;
    person.stride[lane] = m.stride;
    person.lead[lane] = m.lead;
    person.sway[lane] = m.sway;
    person.strike[lane] = m.strike;
    person.clearance[lane] = m.clearance * leg_length(b) * scale;
    person.linger[lane] = m.linger;
    person.toe_out[lane] = m.toe_out;
    // Never so near that the thighs would meet.
    person.step_width[lane] = std::max(m.step_width * b.height, 0.5f * b.joints[left_upper_leg].x) * scale;
    person.stance_width[lane] = std::max(m.stance_width * b.height * scale, person.step_width[lane]);
    person.stance_ahead[lane] = m.stance_ahead * b.height * scale;
    person.stance_turn[lane] = m.stance_turn;
    person.lean[lane] = m.lean;
    person.carriage[lane] = std::max(m.carriage, b.carriage);
    person.crouch[lane] = m.crouch * leg_length(b) * scale;
    person.stoop[lane] = m.stoop;
    person.unevenness[lane] = m.unevenness;
    person.stray[lane] = m.unevenness * b.height * scale;
    person.limp[lane] = m.limp;
    person.reel[lane] = m.reel;
    person.curiosity[lane] = m.curiosity;
    person.touches[lane] = m.touches;
    set_arms(person, lane, b, scale, m);
}

static void set_walker(PersonBlock& person, int lane, const Body& body, float scale, const Manner& manner) {
    set_person(person, lane, body, scale, manner);
    if (body.pram != Vec3{}) person.lean[lane] += k_pushing_lean;
}

void change_manner(Gait& gait, size_t walker, const Body& body, float scale, const Manner& manner) {
    set_walker(gait.people[walker / k_block], static_cast<int>(walker % k_block), body, scale, manner);
}

// Without `around`, nobody: a lane that holds a body all the same, so that kernels meet only sound numbers.
static void start_lane(Gait& gait, size_t i, const Body& body, float scale, Vec3 at, float heading,
                       const Surroundings* around, uint64_t seed, const Manner& manner) {
    GaitBlock& g = gait.blocks[i / k_block];
    PersonBlock& person = gait.people[i / k_block];
    int lane = static_cast<int>(i % k_block);
    set_walker(person, lane, body, scale, manner);
    clear_lane(g, lane);
    g.duty[lane] = duty_factor(0);
    g.phase[lane] =
        random_unit({seed, static_cast<uint32_t>(i), 0, Purpose::first_step}) < 0.5f ? 0.05f : 0.55f;
    g.load[lane] = 0.5f;
    g.breath[lane] =
        k_breath_round * random_unit({seed, static_cast<uint32_t>(i), 0, Purpose::first_step}, 1);
    g.course[lane] = 1;
    g.standing[lane] = 1;
    g.x[lane] = at.x;
    g.z[lane] = at.z;
    g.base[lane] = at.y;
    g.heading[lane] = heading;
    g.first[lane] = g.relaxed[lane] = g.restless[lane] = -1;
    g.frequency[lane] = 1;
    const Surroundings nowhere;
    Stepper stepper =
        stepper_at(gait, i, around ? *around : nowhere, at, heading, heading_direction(heading));
    if (around) {
        const auto walker = static_cast<uint32_t>(i);
        const RandomKey look{seed, walker, 0, Purpose::look};
        stepper.chance = {seed, walker, 0, Purpose::first_step};
        advance_stance(g, stepper, look);
        g.load[lane] = resting_load(g, lane, look);
    }
    for (Side side : {k_left, k_right}) {
        g.feet[side].phase[lane] = k_rest;
        if (around) {
            replant(g, stepper, side);
        } else {
            set_place(g.feet[side].goal, lane, home(g, person, lane, side, at, heading));
            touch_down(g, stepper, side);
        }
    }
    give_cane(gait, i, around ? body.cane * scale : Vec3{}, stepper);
    give_pram(gait, i, around ? body.pram : Vec3{}, scale, stepper);
}

void start_gait(Gait& gait, size_t count, const std::vector<Body>& bodies, const uint32_t* body,
                const float* scale, const RootMotion& root, const Surroundings& around, uint64_t seed,
                const Manner* manner) {
    gait.count = count;
    gait.blocks.assign(block_count(count), {});
    gait.people.assign(block_count(count), {});
    gait.canes.clear();
    gait.prams.clear();
    for (size_t i = 0; i < gait.blocks.size() * k_block; ++i) {
        RandomKey key{seed, static_cast<uint32_t>(i), 0, Purpose::style};
        bool real = i < count;
        start_lane(gait, i, bodies[real ? body[i] : 0], real ? scale[i] : 1, real ? root.position[i] : Vec3{},
                   real ? root.heading[i] : 0, real ? &around : nullptr, seed,
                   manner && real ? manner[i] : draw_manner({}, key));
    }
}

void reserve_gait(Gait& gait, size_t capacity, const Body& body, uint64_t seed) {
    size_t before = gait.blocks.size() * k_block;
    gait.count = std::max(gait.count, capacity);
    gait.blocks.resize(block_count(gait.count));
    gait.people.resize(block_count(gait.count));
    for (size_t i = before; i < gait.blocks.size() * k_block; ++i) end_walker(gait, i, body, seed);
}

void start_walker(Gait& gait, size_t walker, const Body& body, float scale, Vec3 position, float heading,
                  const Surroundings& around, uint64_t seed, const Manner& manner) {
    start_lane(gait, walker, body, scale, position, heading, &around, seed, manner);
}

void end_walker(Gait& gait, size_t walker, const Body& body, uint64_t seed) {
    RandomKey key{seed, static_cast<uint32_t>(walker), 0, Purpose::style};
    start_lane(gait, walker, body, 1, {}, 0, nullptr, seed, draw_manner({}, key));
    gait.blocks[walker / k_block].standing[walker % k_block] = 0;  // wants to do nothing meanwhile
}

namespace {

// What a tick is of.
struct Tick {
    const RootMotion& root;
    const Surroundings& around;
    uint64_t seed;
    uint32_t number;
    float dt;
};

Stepper stepper_in(const Tick& tick, const Gait& gait, size_t i, Vec2 facing) {
    const RootMotion& root = tick.root;
    Stepper stepper = stepper_at(gait, i, tick.around, root.position[i], root.heading[i], facing);
    stepper.velocity = root.velocity[i];
    stepper.wish = root.wish ? root.wish[i] : root.velocity[i];
    stepper.turn_rate = root.turn_rate[i];
    if (root.brakes && root.brakes[i] > 0) stepper.brakes = root.brakes[i];
    stepper.dt = tick.dt;
    stepper.chance = {tick.seed, static_cast<uint32_t>(i), tick.number, Purpose::step};
    stepper.replans = (tick.number + i) % 3 == 0;
    // Every two seconds, not all at once.
    stepper.glances = (tick.number + i * 37) % 120 == 0;
    return stepper;
}

void advance_block(Gait& gait, size_t first, size_t last, const Tick& tick) {
    GaitBlock& g = gait.blocks[first / k_block];
    const PersonBlock& people = gait.people[first / k_block];
    StepperRows rows{};
    for (size_t i = first; i < last; ++i) set_rows(rows, g, tick.root, i);
    find_misfits(g, people, rows);
    advance_paces(g, people, rows, tick.dt);
    for (size_t i = first; i < last; ++i) {
        const RandomKey look{tick.seed, static_cast<uint32_t>(i), tick.number, Purpose::look};
        const size_t lane = i % k_block;
        const Stepper stepper = stepper_in(tick, gait, i, {rows.facing_x[lane], rows.facing_z[lane]});
        advance_walker(g, rows, stepper, look);
        set_feet(rows, g, stepper.lane);
    }
    advance_heights(g, people, rows, tick.dt);
}

void advance_block_afar(Gait& gait, size_t first, size_t last, const Tick& tick) {
    GaitBlock& g = gait.blocks[first / k_block];
    const PersonBlock& people = gait.people[first / k_block];
    StepperRows rows{};
    alignas(64) float height[k_block] = {};
    for (size_t i = first; i < last; ++i) {
        const size_t lane = i % k_block;
        const Vec3 at = tick.root.position[i];
        set_rows(rows, g, tick.root, i);
        height[lane] = at.y;
        g.x[lane] = at.x;
        g.z[lane] = at.z;
        g.heading[lane] = tick.root.heading[i];
    }
    advance_afar(g, people, rows, height, tick.dt);
    for (size_t i = first; i < last; ++i) {
        const size_t lane = i % k_block;
        for (Side side : {k_left, k_right}) g.feet[side].swinging[lane] = rows.swings[side][lane] > 0.5f;
        g.standing[lane] = length(tick.root.velocity[i]) <= k_standing_speed;
        g.first[lane] = g.relaxed[lane] = g.restless[lane] = -1;
    }
}

// Calls work(first, last) for each block of walkers [begin, end).
template <class Work>
void for_blocks(size_t begin, size_t end, const Work& work) {
    while (begin < end) {
        const size_t last = std::min(end, (begin / k_block + 1) * k_block);
        work(begin, last);
        begin = last;
    }
}

void advance_items(Gait& gait, size_t begin, size_t end, const Tick& tick) {
    auto stepper_of = [&](uint32_t walker) {
        return stepper_in(tick, gait, walker, heading_direction(tick.root.heading[walker]));
    };
    for (Span canes = canes_of(gait, begin, end); canes.begin < canes.end; ++canes.begin) {
        Cane& cane = gait.canes[canes.begin];
        advance_cane(gait, cane, stepper_of(cane.walker));
    }
    for (Span prams = prams_of(gait, begin, end); prams.begin < prams.end; ++prams.begin) {
        Pram& pram = gait.prams[prams.begin];
        advance_pram(pram, stepper_of(pram.walker));
    }
}

}  // namespace

void advance_gait(Gait& gait, size_t begin, size_t end, const RootMotion& root, const Surroundings& around,
                  uint64_t seed, uint32_t number, float dt) {
    const Tick tick{root, around, seed, number, dt};
    for_blocks(begin, end, [&](size_t first, size_t last) { advance_block(gait, first, last, tick); });
    advance_items(gait, begin, end, tick);
}

void advance_gait_afar(Gait& gait, size_t begin, size_t end, const RootMotion& root,
                       const Surroundings& around, uint64_t seed, uint32_t number, float dt) {
    const Tick tick{root, around, seed, number, dt};
    for_blocks(begin, end, [&](size_t first, size_t last) { advance_block_afar(gait, first, last, tick); });
    advance_items(gait, begin, end, tick);
}

Footwork footwork(const Gait& gait, size_t walker, Vec3 root) {
    const GaitBlock& g = gait.blocks[walker / k_block];
    const size_t lane = walker % k_block;
    Footwork work;
    const FootPlaces &l = g.feet[k_left].to, &r = g.feet[k_right].to;
    const Vec2 left = Vec2{l.x[lane], l.z[lane]} - on_ground(root),
               right = Vec2{r.x[lane], r.z[lane]} - on_ground(root);
    work.beside = left + (right - left) * closest_on(left, right, {0, 0});
    for (const FootBlock& foot : g.feet) {
        if (!foot.swinging[lane]) continue;
        const float seconds =
            (1 - foot.phase[lane]) / std::max(foot.rate[lane], k_least_swing * g.frequency[lane]);
        if (work.lands == 0 || seconds < work.lands) work.lands = seconds;
    }
    work.swings = static_cast<float>(g.feet[k_left].swinging[lane] - g.feet[k_right].swinging[lane]);
    return work;
}

void jump(Gait& gait, size_t walker) {
    begin_jump(gait.blocks[walker / k_block], static_cast<int>(walker % k_block));
}

void carry_feet(Gait& gait, size_t walker, Vec3 pivot, float yaw, Vec3 by) {
    GaitBlock& g = gait.blocks[walker / k_block];
    int lane = static_cast<int>(walker % k_block);
    SinCos turn = sin_cos(yaw);
    auto turned = [&](float x, float z) {
        return Vec2{x * turn.cosine + z * turn.sine, z * turn.cosine - x * turn.sine};
    };
    auto carried = [&](float x, float z) { return turned(x - pivot.x, z - pivot.z) + on_ground(pivot + by); };
    for (FootBlock& foot : g.feet) {
        for (FootPlaces* p : {&foot.from, &foot.to, &foot.goal}) {
            Vec2 place = carried(p->x[lane], p->z[lane]);
            p->x[lane] = place.x;
            p->y[lane] += by.y;
            p->z[lane] = place.z;
            p->yaw[lane] += yaw;
            Vec2 normal = turned(p->normal_x[lane], p->normal_z[lane]);
            p->normal_x[lane] = normal.x;
            p->normal_z[lane] = normal.z;
        }
        Vec2 wished = carried(foot.wished_x[lane], foot.wished_z[lane]);
        foot.wished_x[lane] = wished.x;
        foot.wished_z[lane] = wished.z;
        foot.wished_yaw[lane] += yaw;
    }
    g.base[lane] += by.y;
    Span own = canes_of(gait, walker, walker + 1);
    for (size_t i = own.begin; i < own.end; ++i) {
        Cane& cane = gait.canes[i];
        for (Vec3* p : {&cane.tip, &cane.from, &cane.to, &cane.goal})
            *p = at_height(carried(p->x, p->z), p->y + by.y);
    }
    Span pushed = prams_of(gait, walker, walker + 1);
    for (size_t i = pushed.begin; i < pushed.end; ++i) {
        PramPlace& at = gait.prams[i].now;
        at.place = at_height(carried(at.place.x, at.place.z), at.place.y + by.y);
        at.yaw = wrap_angle(at.yaw + yaw);
    }
}

}  // namespace flaneur
