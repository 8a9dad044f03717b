#include "tools/flaneur/gait/crowd.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/gait/measure/limits.h"
#include "tools/flaneur/gait/measure/signal.h"
#include "tools/flaneur/output/figures.h"

namespace flaneur {

namespace {

constexpr float k_degrees = 1 / k_radians;
constexpr float k_hair = 0.5f;          // degrees beyond a limit that nobody sees
constexpr float k_steady_speed = 0.7f;  // m/s
constexpr float k_steady_turn = 0.15f;  // rad/s
constexpr uint32_t k_settles = 60;      // ticks
constexpr float k_level = 0.02f;        // metres
constexpr float k_shoe = 0.34f;         // of its length, how wide a shoe is
constexpr float k_over = 0.05f;         // metres of height, by which one shoe passes over the other

bool finite(const JointPose& p) {
    return std::isfinite(p.position.x + p.position.y + p.position.z + p.rotation.x + p.rotation.y +
                         p.rotation.z + p.rotation.w);
}

void watch_joints(WalkerWatch& watch, const World& world, size_t i) {
    const PersonBlock& person = world.gait.people[i / k_block];
    size_t lane = i % k_block;
    const bool runs = world.gait.blocks[i / k_block].running[lane] > 0;
    JointPose poses[k_joint_count];
    for (size_t j = 0; j < k_joint_count; ++j) {
        auto joint = static_cast<Joint>(j);
        poses[j] = joint_pose(world.poses, i, joint);
        if (!finite(poses[j])) {
            ++watch.not_finite;
            watch.seen = false;
            return;
        }
        bool root = k_joint_parents[j] == k_no_parent;
        auto parent = static_cast<size_t>(root ? 0 : k_joint_parents[j]);
        Quat up = root ? Quat{} : poses[parent].rotation;
        Quat against = conjugate(up) * poses[j].rotation;
        JointWatch& seen = watch.joints[j];
        if (watch.seen) {
            float spin = angle_between(seen.last, against) / k_tick;
            const bool may = runs && j >= left_upper_leg && spin <= k_jump_running;
            seen.jumps += !may && spin > k_jump;
            if (!may && spin > seen.spin) {
                seen.spin = spin;
                seen.spin_tick = world.tick;
            }
        }
        seen.last = against;
        if (root) continue;
        float over = beyond_limits(joint, joint_angles(joint, up, poses[j].rotation));
        seen.outside += over > k_hair;
        if (over > seen.beyond) {
            seen.beyond = over;
            seen.beyond_tick = world.tick;
        }
        auto rest = [&](size_t of) {
            return Vec3{person.joints[of][0][lane], person.joints[of][1][lane], person.joints[of][2][lane]};
        };
        const auto& places = world.poses[i / k_block].position;
        auto is = [&](size_t of) {
            return Vec3{places[of][0][lane], places[of][1][lane], places[of][2][lane]};
        };
        float error = std::fabs(length(is(j) - is(parent)) - length(rest(j) - rest(parent)));
        if (error > watch.bone_error.most) watch.bone_error = {error, world.tick};
    }
    watch.seen = true;
}

void watch_leg(WalkerWatch& watch, const World& world, size_t i, const FootInstant& foot) {
    Vec2 ahead = heading_direction(world.crowd.motion.heading[i]);
    auto at = [&](Joint joint) { return joint_pose(world.poses, i, joint).position; };
    auto incline = [&](Vec3 bone) {
        return arctan2(bone.x * ahead.x + bone.z * ahead.z, -bone.y) * k_degrees;
    };
    Vec3 knee = at(left_lower_leg), ankle = at(left_foot);
    float thigh = incline(knee - at(left_upper_leg)), shank = incline(ankle - knee);
    Vec3 sole = foot.sole.ball - foot.sole.heel;
    float pitch = arctan2(sole.y, std::sqrt(sole.x * sole.x + sole.z * sole.z)) * k_degrees;
    float speed = length(world.crowd.motion.velocity[i]);
    auto under = ground_at(*world.ground, world.crowd.motion.position[i]);
    bool level = under && under->normal.y > 0.9995f &&
                 std::fabs(foot.ground[0] - world.crowd.motion.position[i].y) < 0.02f;
    bool steady =
        level && speed > k_steady_speed && std::fabs(world.crowd.motion.turn_rate[i]) < k_steady_turn;
    watch.legs.push_back({thigh, thigh - shank, pitch - shank, speed, foot.swinging, steady});
}

void note_worst(WalkerWatch& watch, Worst which, float value, uint32_t tick) {
    WorstWatch& worst = watch.worst[which];
    if (value > worst.most) worst = {value, tick};
}

// Percent; see worst_low.
float pelvis_low(const World& world, size_t i, float pelvis_y) {
    const GaitBlock& gait = world.gait.blocks[i / k_block];
    size_t lane = i % k_block;
    if (gait.running[lane] > 0 || gait.jump[lane] > 0) return 0;
    float ground = std::numeric_limits<float>::max();
    for (const FootBlock& foot : gait.feet) ground = std::min({ground, foot.from.y[lane], foot.to.y[lane]});
    float upright = world.gait.people[i / k_block].joints[hips][1][lane];
    return 100 * (1 - (pelvis_y - ground) / upright);
}

// Metres; see worst_beside.
float feet_beside(const World& world, size_t i) {
    const CrowdMotion& motion = world.crowd.motion;
    const Vec2 ahead = heading_direction(motion.heading[i]), left{ahead.z, -ahead.x};
    auto at = [&](Joint joint) { return joint_pose(world.poses, i, joint).position; };
    const Vec3 pelvis = at(hips);
    auto beside = [&](Joint foot) { return dot(on_ground(at(foot) - pelvis), left); };
    const float l = beside(left_foot), r = beside(right_foot);
    // Who turns to the left has them on the right.
    const float turns = length(motion.velocity[i]) * motion.turn_rate[i] / k_gravity;
    const float outside = turns * (pelvis.y - motion.position[i].y);
    return std::max(
        {std::min(l, r) + std::min(outside, 0.0f), -std::max(l, r) - std::max(outside, 0.0f), 0.0f});
}

// Metres; see worst_shoes. Shoes are as long as from heel to tip and of one width.
float shoes_overlap(const FootInstant (&feet)[2]) {
    const Sole &l = feet[k_left].sole, &r = feet[k_right].sole;
    const Vec3 along = l.tip - l.heel, other = r.tip - r.heel;
    const float wide = k_shoe * length(along);
    float most = 0;
    for (int i = 0; i <= 12; ++i) {
        const Vec3 at = l.heel + along * (static_cast<float>(i) / 12);
        const float on = closest_on(on_ground(r.heel), on_ground(r.tip), on_ground(at));
        const Vec3 apart = at - r.heel - other * on;
        if (std::fabs(apart.y) < k_over) most = std::max(most, wide - length(on_ground(apart)));
    }
    return most;
}

// How evenly the body moves, but in its first second, in which it takes its place.
void watch_body(WalkerWatch& watch, const World& world, size_t i, const FootInstant (&feet)[2]) {
    Vec2 velocity = world.crowd.motion.velocity[i];
    float head_y = joint_pose(world.poses, i, head).position.y,
          pelvis_y = joint_pose(world.poses, i, hips).position.y;
    if (watch.ticks >= k_settles) {
        float slowing = (length(watch.velocity) - length(velocity)) / k_tick;
        note_worst(watch, worst_slowing, slowing, world.tick);
        float root_y = world.crowd.motion.position[i].y;
        bool level = true;
        for (const FootInstant& foot : feet)
            for (float ground : foot.ground) level = level && std::fabs(ground - root_y) < k_level;
        note_worst(watch, level ? worst_head_rise : worst_head_step, std::fabs(head_y - watch.head) / k_tick,
                   world.tick);
        float falls = (2 * watch.pelvis[1] - watch.pelvis[0] - pelvis_y) / (k_tick * k_tick);
        if (!feet[k_left].swinging || !feet[k_right].swinging)
            note_worst(watch, worst_fall, falls, world.tick);
        note_worst(watch, worst_low, pelvis_low(world, i, pelvis_y), world.tick);
        note_worst(watch, worst_beside, 1000 * feet_beside(world, i), world.tick);
        const bool swings = feet[k_left].swinging || feet[k_right].swinging;
        note_worst(watch, swings ? worst_passing : worst_shoes, 1000 * shoes_overlap(feet), world.tick);
    }
    watch.velocity = velocity;
    watch.head = head_y;
    watch.pelvis[0] = watch.pelvis[1];
    watch.pelvis[1] = pelvis_y;
    ++watch.ticks;
}

void watch_feet(WalkerWatch& watch, const FootInstant (&feet)[2], uint32_t tick) {
    for (Side side : {k_left, k_right}) {
        StanceWatch& foot = watch.feet[side];
        if (auto stance = watch_stance(foot, feet[side])) watch.stances.push_back(*stance);
        if (!foot.standing) continue;
        watch.slips.push_back(foot.slip);
        note_worst(watch, worst_drift, 1000 * foot.stance.drift, tick);
        note_worst(watch, worst_below, 1000 * foot.stance.below, tick);
        note_worst(watch, worst_above, 1000 * foot.stance.above, tick);
    }
}

struct LegCurves {
    Cycle thigh{}, knee{}, ankle{};
    double speed = 0;
    int strides = 0;
};

LegCurves leg_curves(const std::vector<WalkerWatch::Leg>& legs) {
    Samples thigh, knee, ankle;
    for (const auto& leg : legs) {
        thigh.push_back(static_cast<double>(leg.thigh));
        knee.push_back(static_cast<double>(leg.knee));
        ankle.push_back(static_cast<double>(leg.ankle));
    }
    LegCurves m;
    auto add = [](Cycle& to, const Cycle& more) {
        for (size_t p = 0; p < to.size(); ++p) to[p] += more[p];
    };
    size_t begin = 0;
    for (size_t t = 1; t < legs.size(); ++t) {
        if (!legs[t - 1].swinging || legs[t].swinging) continue;
        bool steady = begin > 0;
        double speed = 0;
        for (size_t k = begin; k < t; ++k) {
            steady = steady && legs[k].steady;
            speed += static_cast<double>(legs[k].speed) / static_cast<double>(t - begin);
        }
        if (steady) {
            double from = static_cast<double>(begin) - 0.5, to = static_cast<double>(t) - 0.5;
            add(m.thigh, cycle_of(thigh, from, to));
            add(m.knee, cycle_of(knee, from, to));
            add(m.ankle, cycle_of(ankle, from, to));
            m.speed += speed;
            ++m.strides;
        }
        begin = t;
    }
    for (Cycle* c : {&m.thigh, &m.knee, &m.ankle})
        for (double& v : *c) v /= std::max(m.strides, 1);
    m.speed /= std::max(m.strides, 1);
    return m;
}

double deviation(const std::vector<double>& values) {
    double n = static_cast<double>(values.size()), sum = 0, squares = 0;
    for (double v : values) sum += v / n;
    for (double v : values) squares += (v - sum) * (v - sum) / (n - 1);
    return std::sqrt(squares);
}

// The standard deviation between people, averaged over the cycle.
double spread(const std::vector<LegCurves>& people, const Cycle LegCurves::*curve) {
    double sum = 0;
    for (size_t p = 0; p < 100; ++p) {
        std::vector<double> values;
        values.reserve(people.size());
        for (const LegCurves& m : people) values.push_back((m.*curve)[p]);
        sum += deviation(values) / 100;
    }
    return sum;
}

// The worst of all, and whose it is: the first one's where nobody has any.
struct WorstOfAll {
    WorstWatch worst;
    size_t walker = 0;
};
void keep_worst(WorstOfAll& all, WorstWatch one, size_t walker) {
    if (one.most > all.worst.most) all = {one, walker};
}
WorstOfAll worst_of_all(const std::vector<WalkerWatch>& watches, int kind) {
    WorstOfAll all;
    for (size_t i = 0; i < watches.size(); ++i) keep_worst(all, watches[i].worst[kind], i);
    return all;
}
// Nobody's where nobody has any.
Quantity quantity_of(const char* name, const WorstOfAll& all) {
    Quantity q{name, static_cast<double>(all.worst.most)};
    if (all.worst.most > 0) q.moment = Moment{all.walker, all.worst.tick};
    return q;
}

// Another one has come in there.
void begin_anew(WalkerWatch& watch, uint32_t generation) {
    watch.generation = generation;
    watch.ticks = 0;
    watch.seen = false;
    for (StanceWatch& foot : watch.feet) foot = {};
    watch.legs.clear();
}

}  // namespace

void watch_walker(WalkerWatch& watch, const World& world, size_t i) {
    if (!is_there(world.crowd, static_cast<uint32_t>(i))) return;
    const uint32_t generation = world.crowd.slots.generation[i];
    if (generation != watch.generation) begin_anew(watch, generation);
    watch_joints(watch, world, i);
    const FootInstant feet[2] = {foot_instant(*world.ground, world.gait, world.poses, i, k_left),
                                 foot_instant(*world.ground, world.gait, world.poses, i, k_right)};
    watch_feet(watch, feet, world.tick);
    watch_body(watch, world, i, feet);
    watch_leg(watch, world, i, feet[k_left]);
}

Report judge_crowd(const std::vector<WalkerWatch>& watches, const World& world, const std::string& city) {
    std::vector<double> drift{0}, below{0}, above{0}, slip{0};
    double not_finite = 0, outside = 0, jumps = 0;
    WorstOfAll beyond, bone, spin;
    std::vector<LegCurves> people;
    std::vector<double> speeds;
    for (size_t i = 0; i < watches.size(); ++i) {
        const WalkerWatch& w = watches[i];
        std::vector<Stance> stances = w.stances;
        for (const StanceWatch& foot : w.feet)
            if (foot.standing) stances.push_back(foot.stance);
        for (const Stance& s : stances) {
            drift.push_back(1000 * static_cast<double>(s.drift));
            below.push_back(1000 * static_cast<double>(s.below));
            above.push_back(1000 * static_cast<double>(s.above));
        }
        for (float s : w.slips) slip.push_back(1000 * static_cast<double>(s));
        not_finite += w.not_finite;
        for (const JointWatch& joint : w.joints) {
            outside += joint.outside;
            jumps += joint.jumps;
            keep_worst(beyond, {joint.beyond, joint.beyond_tick}, i);
            keep_worst(spin, {joint.spin, joint.spin_tick}, i);
        }
        keep_worst(bone, w.bone_error, i);
        LegCurves m = leg_curves(w.legs);
        if (m.strides < 3) continue;
        people.push_back(m);
        speeds.push_back(m.speed);
    }
    Report r;
    auto spread_over = [&](const std::string& name, std::vector<double>& values) {
        r.quantities.push_back({name + "_p50.mm", quantile(values, 0.5)});
        r.quantities.push_back({name + "_p99.mm", quantile(values, 0.99)});
    };
    r.quantities.push_back({"stances", static_cast<double>(drift.size() - 1)});
    spread_over("drift", drift);
    spread_over("drift_a_tick", slip);
    spread_over("penetration", below);
    spread_over("float", above);
    append(r.quantities, {{"joints_outside", outside},
                          quantity_of("joints_outside_most.deg", beyond),
                          {"not_finite", not_finite},
                          quantity_of("bone_error.m", bone),
                          quantity_of("joint_speed.deg_s", spin),
                          {"joint_jumps", jumps},
                          {"steady_walkers", static_cast<double>(people.size())}});
    for (int kind = 0; kind < worst_count; ++kind)
        r.quantities.push_back(quantity_of(k_worst[kind].name, worst_of_all(watches, kind)));
    if (people.size() > 1) {
        append(r.quantities, {{"spread_thigh.deg", spread(people, &LegCurves::thigh)},
                              {"spread_knee.deg", spread(people, &LegCurves::knee)},
                              {"spread_ankle.deg", spread(people, &LegCurves::ankle)},
                              {"spread_speed.m_s", deviation(speeds)}});
    }
    r.name = "crowd";
    r.title = std::to_string(watches.size()) + " walkers in " + printable(city) + " for " +
              std::to_string(std::lround(world.tick * static_cast<double>(k_tick))) + " s";
    r.verdicts = judge(r.quantities, crowd_bars(people.size()));
    return r;
}

std::vector<std::string> worst_places(const std::vector<WalkerWatch>& watches) {
    struct Line {
        uint32_t jumps = 0, outside = 0;
        const JointWatch *fastest = nullptr, *farthest = nullptr;
        size_t fast_walker = 0, far_walker = 0;
    };
    std::vector<std::string> texts;
    for (size_t j = 0; j < k_joint_count; ++j) {
        Line line;
        for (size_t i = 0; i < watches.size(); ++i) {
            const JointWatch& joint = watches[i].joints[j];
            line.jumps += joint.jumps;
            line.outside += joint.outside;
            if (!line.fastest || joint.spin > line.fastest->spin) line.fastest = &joint, line.fast_walker = i;
            if (!line.farthest || joint.beyond > line.farthest->beyond)
                line.farthest = &joint, line.far_walker = i;
        }
        std::string name(k_joint_names[j]);
        char text[160];
        if (line.jumps > 0) {
            std::snprintf(text, sizeof text, "%s jumps %u times, most at %.0f deg/s: walker %zu, tick %u",
                          name.c_str(), line.jumps, static_cast<double>(line.fastest->spin), line.fast_walker,
                          line.fastest->spin_tick);
            texts.push_back(text);
        }
        if (line.outside > 0) {
            std::snprintf(text, sizeof text,
                          "%s is beyond its limits for %u ticks, most by %.0f deg: walker %zu, tick %u",
                          name.c_str(), line.outside, static_cast<double>(line.farthest->beyond),
                          line.far_walker, line.farthest->beyond_tick);
            texts.push_back(text);
        }
    }
    for (int kind = 0; kind < worst_count && !watches.empty(); ++kind) {
        auto [most, walker] = worst_of_all(watches, kind);
        auto beyond = std::count_if(watches.begin(), watches.end(), [&](const WalkerWatch& w) {
            return w.worst[kind].most > k_worst[kind].goal;
        });
        char text[160];
        std::snprintf(text, sizeof text, "%s is %.3g: walker %zu, tick %u; %zu beyond the goal of %g",
                      k_worst[kind].name, static_cast<double>(most.most), walker, most.tick,
                      static_cast<size_t>(beyond), static_cast<double>(k_worst[kind].goal));
        texts.push_back(text);
    }
    return texts;
}

}  // namespace flaneur
