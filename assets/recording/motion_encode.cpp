#include <algorithm>
#include <cmath>
#include <cstring>

#include "assets/recording/bytes.h"
#include "assets/recording/chain.h"
#include "assets/recording/motion.h"
#include "assets/recording/symbols.h"

namespace flaneur {

namespace {

constexpr int k_finest = (1 << k_step_bits) - 1;
// Of the bound, what encoder and decoder may differ by in roundings.
constexpr float k_within = 0.96f;

// One that is there from tick `first` on without a break.
struct Run {
    RecordedMover mover;
    size_t joints = 0;
    uint32_t first = 0, ticks = 0;
    size_t begin = 0;  // into where it is, tick by tick
};
struct Sighted {
    uint64_t id;
    uint32_t tick, index;
    bool is_thing;
};

// A tree of somebody's size, and how it is gone through.
struct Chain {
    size_t joints = 0;
    std::array<uint8_t, k_most_recorded_joints> parents{};
    std::array<Vec3, k_most_recorded_joints> offsets{};
    std::array<uint8_t, k_most_recorded_joints>
        heir{};  // the only child of a joint, at which it aims; 0: none
    std::array<float, k_most_recorded_joints> reach{};  // of the longest bone to a child
    std::array<float, k_most_recorded_joints>
        allowed{};  // how far from its place a joint may be, of the bound
};

// Joints of the trunk have short bones and hand their errors on to all limbs: they get a share of the bound
// that grows with how many bones it is to the root.
Chain chain_of(const BoneTree& tree, float scale) {
    Chain chain;
    chain.joints = tree.parents.size();
    std::array<int, k_most_recorded_joints> depth{}, children{};
    for (size_t j = 1; j < chain.joints; ++j) {
        const uint8_t parent = tree.parents[j];
        chain.parents[j] = parent;
        chain.offsets[j] = tree.offsets[j] * scale;
        depth[j] = depth[parent] + 1;
        chain.heir[parent] = ++children[parent] == 1 ? static_cast<uint8_t>(j) : 0;
        const float bone = length(chain.offsets[j]);
        chain.reach[parent] = std::max(chain.reach[parent], bone);
        const float share =
            bone > 0.2f * scale ? 1 : std::min(0.4f + 0.12f * static_cast<float>(depth[j]), 1.0f);
        chain.allowed[j] = std::max(share, chain.allowed[parent]);
    }
    return chain;
}

// Where one is at its samples: ticks at which it is not as at the tick before. Along the axes of its yaw, and
// places from its origin.
struct Samples {
    int count = 0;
    uint64_t moves = 0;
    std::array<int32_t, 3> origin{};
    uint8_t yaw = 0;
    Vec3 root[k_most_samples];
    Quat turns[k_most_recorded_joints][k_most_samples];
};

struct Seen {
    double at[3];
    Quat turns[k_most_recorded_joints];

    friend bool operator==(const Seen& a, const Seen& b) = delete;
};

Quat unit(Quat q) {
    const float squared = dot(q, q);
    return squared > 1e-6f && squared < 1e6f ? normalize(q) : Quat{};
}
double finite(double value) { return std::fabs(value) < 5e7 ? value : 0; }

void see(const MotionFrame& frame, const Sighted& at, size_t joints, Seen& seen) {
    if (at.is_thing) {
        const RigidMember& thing = frame.things[at.index];
        seen.at[0] = finite(wide(thing.place.x));
        seen.at[1] = finite(wide(thing.place.y));
        seen.at[2] = finite(wide(thing.place.z));
        seen.turns[0] = unit(thing.turn);
        return;
    }
    const uint32_t walker = frame.bodies[at.index].walker;
    const BodyBlock& block = frame.blocks[walker / k_block];
    const int lane = lane_of(walker);
    for (int axis = 0; axis < 3; ++axis)
        seen.at[axis] = finite(wide(block.origin[axis][lane]) + wide(block.hips[axis][lane]));
    for (size_t j = 0; j < joints; ++j) {
        const auto& q = block.rotation[j];
        seen.turns[j] = unit({q[0][lane], q[1][lane], q[2][lane], q[3][lane]});
    }
}

bool are_equal(const Seen& a, const Seen& b, size_t joints) {
    return std::memcmp(a.at, b.at, sizeof a.at) == 0 &&
           std::memcmp(a.turns, b.turns, joints * sizeof(Quat)) == 0;
}

void sample(const MotionFrames& frames, const Run& run, const Sighted* sighted, Samples& samples,
            std::vector<Seen>& seen) {
    seen.resize(k_most_samples);
    samples.count = 0;
    samples.moves = 0;
    for (uint32_t t = 0; t < run.ticks; ++t) {
        Seen& now = seen[samples.count];
        see(frames.frames[run.first + t], sighted[run.begin + t], run.joints, now);
        if (samples.count > 0 && are_equal(now, seen[samples.count - 1], run.joints)) continue;
        samples.moves |= uint64_t{1} << t;
        ++samples.count;
    }
    const Seen& middle = seen[samples.count / 2];
    for (int axis = 0; axis < 3; ++axis)
        samples.origin[axis] = static_cast<int32_t>(std::lround(middle.at[axis] / wide(k_origin_step)));
    const Quat facing = middle.turns[0];
    const float yaw = facing.y == 0 && facing.w == 0 ? 0 : 2 * arctan2(facing.y, facing.w);
    samples.yaw = static_cast<uint8_t>(std::lround(yaw / k_yaw_step) & 255);
    const Quat back = conjugate(rotation_y(static_cast<float>(samples.yaw) * k_yaw_step));
    for (int s = 0; s < samples.count; ++s) {
        Vec3 from;
        from.x = static_cast<float>(seen[s].at[0] - wide(k_origin_step) * samples.origin[0]);
        from.y = static_cast<float>(seen[s].at[1] - wide(k_origin_step) * samples.origin[1]);
        from.z = static_cast<float>(seen[s].at[2] - wide(k_origin_step) * samples.origin[2]);
        samples.root[s] = rotate(back, from);
        for (size_t j = 0; j < run.joints; ++j) samples.turns[j][s] = back * seen[s].turns[j];
    }
}

// Three curves as waves of a step, and as they will be read.
struct Coded {
    int step = 0;
    int values[3][k_most_samples];
    int counts[3];
    Vec3 read[k_most_samples];
};

void weigh(const Vec3* curve, const Waves& waves, float (&weights)[3][k_most_samples]) {
    const int n = waves.samples;
    for (int wave = 0; wave < n; ++wave) {
        const float* form = waves.of(wave);
        float x = 0, y = 0, z = 0;
        for (int s = 0; s < n; ++s) {
            x += form[s] * curve[s].x;
            y += form[s] * curve[s].y;
            z += form[s] * curve[s].z;
        }
        weights[0][wave] = x;
        weights[1][wave] = y;
        weights[2][wave] = z;
    }
}

// Waves that are smaller than most of a step are left out: they save more than they would mend.
void quantise(const float (&weights)[3][k_most_samples], const Waves& waves, int step, Coded& coded) {
    const int n = waves.samples;
    const float size = step_of(step);
    coded.step = step;
    float read[3][k_most_samples] = {};
    for (int c = 0; c < 3; ++c) {
        coded.counts[c] = 0;
        for (int wave = 0; wave < n; ++wave) {
            const float steps = clamp(weights[c][wave] / size, -1e6f, 1e6f);
            const float shy = wave < 2 ? 0.5f : 0.4f;
            const int value = static_cast<int>(std::fabs(steps) + shy) * (steps < 0 ? -1 : 1);
            coded.values[c][wave] = value;
            if (value == 0) continue;
            coded.counts[c] = wave + 1;
            const float weight = static_cast<float>(value) * size;
            const float* form = waves.of(wave);
            for (int s = 0; s < n; ++s) read[c][s] += weight * form[s];
        }
    }
    for (int s = 0; s < n; ++s) coded.read[s] = {read[0][s], read[1][s], read[2][s]};
}

// Turns a few roundings the other way, each where that makes the largest error smaller.
void even_out(const float (&weights)[3][k_most_samples], const Waves& waves, const Vec3* curve,
              Coded& coded) {
    const int n = waves.samples;
    const float size = step_of(coded.step);
    float off[3][k_most_samples], squared[k_most_samples];
    for (int s = 0; s < n; ++s) {
        const Vec3 e = coded.read[s] - curve[s];
        off[0][s] = e.x, off[1][s] = e.y, off[2][s] = e.z;
        squared[s] = length_squared(e);
    }
    for (int turn = 0; turn < 6; ++turn) {
        const int worst = static_cast<int>(std::max_element(squared, squared + n) - squared);
        float best = squared[worst] * 0.98f;
        int channel = -1, of_wave = 0, by = 0;
        for (int c = 0; c < 3; ++c)
            for (int wave = 0; wave < coded.counts[c]; ++wave) {
                const float* form = waves.of(wave);
                const int way = off[c][worst] * form[worst] > 0 ? -1 : 1;
                const float rest = weights[c][wave] / size - static_cast<float>(coded.values[c][wave]);
                if (rest * static_cast<float>(way) < 0.2f) continue;
                const float step = static_cast<float>(way) * size;
                const auto then = [&](int s) {
                    return squared[s] + step * form[s] * (2 * off[c][s] + step * form[s]);
                };
                float most = then(worst);
                for (int s = 0; s < n && most < best; ++s) most = std::max(most, then(s));
                if (most < best) best = most, channel = c, of_wave = wave, by = way;
            }
        if (channel < 0) break;
        coded.values[channel][of_wave] += by;
        const float* form = waves.of(of_wave);
        const float step = static_cast<float>(by) * size;
        for (int s = 0; s < n; ++s) {
            squared[s] += step * form[s] * (2 * off[channel][s] + step * form[s]);
            off[channel][s] += step * form[s];
        }
    }
    for (int s = 0; s < n; ++s) coded.read[s] = curve[s] + Vec3{off[0][s], off[1][s], off[2][s]};
}

// The coarsest step near `guess` at which `holds(coded)`; what is coded then. False where none is fine
// enough.
template <class Holds>
bool find_step(const float (&weights)[3][k_most_samples], const Waves& waves, const Vec3* curve, int guess,
               Coded& coded, Coded& other, const Holds& holds) {
    const auto fits = [&](int step, Coded& as) {
        quantise(weights, waves, step, as);
        if (holds(as)) return true;
        even_out(weights, waves, curve, as);
        return holds(as);
    };
    if (fits(guess, coded)) {
        for (int step = guess - 1; step >= 0 && step > guess - 8; --step) {
            if (!fits(step, other)) return true;
            std::swap(coded, other);
        }
        return true;
    }
    for (int step = guess + 1; step <= k_finest; ++step)
        if (fits(step, coded)) return true;
    return false;
}

int step_near(float size) {
    int step = 0;
    while (step < k_finest && step_of(step) > size) ++step;
    return step;
}

struct Encoder {
    const MotionBound bound;
    const float half_turn;  // sine of half the bound's angle
    BitWriter out;
    Symbols symbols;
    uint64_t missed = 0;
    Samples samples;
    std::vector<Seen> seen;
    Coded coded, other;
    Vec3 curve[k_most_samples];
    std::array<int, k_most_recorded_joints + 1> guesses{};  // steps of the track before; of the root first
    Quat turns[k_most_recorded_joints][k_most_samples];     // as they will be read
    Vec3 places[k_most_recorded_joints][k_most_samples],
        true_places[k_most_recorded_joints][k_most_samples];  // from the root

    Encoder(const MotionBound& b, std::string& bytes, size_t joints)
        : bound(b),
          half_turn(sin_cos(b.turn / 2).sine * k_within),
          out{bytes},
          symbols(static_cast<int>(3 * (joints + 1))) {}

    int guess_of(size_t at, float size) { return guesses[at] > 0 ? guesses[at] : step_near(size); }
    void put(int channel, int n) {
        guesses[channel / 3] = coded.step;
        symbols.code_step(out, channel / 3, coded.step);
        for (int c = 0; c < 3; ++c)
            symbols.code_channel(out, channel + c, n, coded.values[c], coded.counts[c]);
    }
    void put_root(const Waves& waves);
    void put_joint(const Chain& chain, size_t joint, const Waves& waves);
    void put_track(const Chain& chain);
};

void Encoder::put_root(const Waves& waves) {
    float weights[3][k_most_samples];
    weigh(samples.root, waves, weights);
    const float most = bound.place * k_within;
    const bool held = find_step(weights, waves, samples.root, guess_of(0, bound.place * 1.5f), coded, other,
                                [&](const Coded& c) {
                                    for (int s = 0; s < waves.samples; ++s)
                                        if (length_squared(c.read[s] - samples.root[s]) > most * most)
                                            return false;
                                    return true;
                                });
    missed += !held;
    put(0, waves.samples);
}

void Encoder::put_joint(const Chain& chain, size_t joint, const Waves& waves) {
    const int n = waves.samples;
    const size_t heir = chain.heir[joint];
    const float least = chain.reach[joint] * 0.2f;
    Vec3 last{};
    for (int s = 0; s < n; ++s) {
        Quat wanted = samples.turns[joint][s];
        if (heir > 0) {
            const Vec3 points = rotate(wanted, chain.offsets[heir]),
                       should = true_places[heir][s] - places[joint][s];
            if (length(should) > least && chain.reach[joint] > 0.01f) {
                const Vec3 by = vector_of(rotation_between(points / length(points), should / length(should)));
                const float most = bound.turn / 2;
                wanted = normalize(turn_of(length(by) > most ? by * (most / length(by)) : by) * wanted);
            }
        }
        Vec3 v = vector_of(joint == 0 ? wanted : conjugate(turns[chain.parents[joint]][s]) * wanted);
        // Half a turn is reached from both sides: on from where it was.
        const float angle = length(v);
        if (s > 0 && angle > 1e-3f && length_squared(v - last) > k_pi * k_pi) {
            const Vec3 round = v * (1 - 2 * k_pi / angle);
            if (length_squared(round - last) < length_squared(v - last)) v = round;
        }
        curve[s] = last = v;
    }
    float weights[3][k_most_samples];
    weigh(curve, waves, weights);
    float room = bound.turn * 1.4f;
    for (size_t child = joint + 1; child < chain.joints; ++child)
        if (chain.parents[child] == joint)
            room = std::min(room, 1.4f * bound.place * chain.allowed[child] /
                                      std::max(length(chain.offsets[child]), 1e-3f));
    Quat* read = turns[joint];
    const auto holds = [&](const Coded& c) {
        for (int s = 0; s < n; ++s) {
            const Quat local = turn_of(c.read[s]);
            read[s] = joint == 0 ? local : turns[chain.parents[joint]][s] * local;
            const Quat off = conjugate(samples.turns[joint][s]) * read[s];
            if (length_squared(Vec3{off.x, off.y, off.z}) > half_turn * half_turn) return false;
        }
        for (size_t child = joint + 1; child < chain.joints; ++child) {
            if (chain.parents[child] != joint) continue;
            const float most = bound.place * chain.allowed[child] * k_within;
            for (int s = 0; s < n; ++s) {
                const Vec3 place = places[joint][s] + rotate(read[s], chain.offsets[child]);
                if (length_squared(place - true_places[child][s]) > most * most) return false;
            }
        }
        return true;
    };
    const bool held = find_step(weights, waves, curve, guess_of(joint + 1, room), coded, other, holds);
    missed += !held;
    for (int s = 0; s < n; ++s) {
        const Quat local = turn_of(coded.read[s]);
        read[s] = joint == 0 ? local : turns[chain.parents[joint]][s] * local;
    }
    for (size_t child = joint + 1; child < chain.joints; ++child)
        if (chain.parents[child] == joint)
            for (int s = 0; s < n; ++s)
                places[child][s] = places[joint][s] + rotate(read[s], chain.offsets[child]);
    put(static_cast<int>(3 * (joint + 1)), n);
}

void Encoder::put_track(const Chain& chain) {
    const Waves& waves = waves_of(samples.count);
    for (int s = 0; s < samples.count; ++s) {
        true_places[0][s] = places[0][s] = {};
        for (size_t j = 1; j < chain.joints; ++j)
            true_places[j][s] = true_places[chain.parents[j]][s] +
                                rotate(samples.turns[chain.parents[j]][s], chain.offsets[j]);
    }
    symbols.begin_track();
    put_root(waves);
    for (size_t j = 0; j < chain.joints; ++j) put_joint(chain, j, waves);
    symbols.end_track();
}

// By joints, then by id, then by time: what moves alike lies together.
void find_runs(const MotionFrames& frames, std::span<const BoneTree> trees, std::vector<Run>& runs,
               std::vector<Sighted>& sighted) {
    const auto mover_of = [&](const Sighted& s) -> const RecordedMover& {
        const MotionFrame& frame = frames.frames[s.tick];
        return s.is_thing ? frame.things[s.index].mover : frame.bodies[s.index].mover;
    };
    const auto joints_of = [&](const Sighted& s) { return trees[mover_of(s).tree].parents.size(); };
    for (uint32_t t = 0; t < frames.ticks; ++t) {
        const MotionFrame& frame = frames.frames[t];
        for (uint32_t i = 0; i < frame.bodies.size(); ++i)
            sighted.push_back({frame.bodies[i].mover.id, t, i, false});
        for (uint32_t i = 0; i < frame.things.size(); ++i)
            sighted.push_back({frame.things[i].mover.id, t, i, true});
    }
    std::sort(sighted.begin(), sighted.end(), [&](const Sighted& a, const Sighted& b) {
        const size_t more = joints_of(a), less = joints_of(b);
        return std::tie(less, a.id, a.tick) < std::tie(more, b.id, b.tick);
    });
    for (size_t i = 0; i < sighted.size(); ++i) {
        const RecordedMover& mover = mover_of(sighted[i]);
        if (!runs.empty() && runs.back().mover == mover &&
            runs.back().first + runs.back().ticks == sighted[i].tick) {
            ++runs.back().ticks;
        } else {
            runs.push_back({mover, joints_of(sighted[i]), sighted[i].tick, 1, i});
        }
    }
}

struct Group {
    size_t begin = 0, end = 0;  // runs
    std::string bits;
    uint64_t missed = 0;
};

// What is told of a run beside its waves.
struct Told {
    std::array<int32_t, 3> origin;
    uint64_t moves;
    uint8_t yaw;
};

}  // namespace

std::string encode_motion(const MotionFrames& frames, std::span<const BoneTree> trees,
                          const MotionBound& bound, Workers& workers, uint64_t& missed) {
    std::vector<Run> runs;
    std::vector<Sighted> sighted;
    find_runs(frames, trees, runs, sighted);
    std::vector<Group> groups;
    for (size_t i = 0; i < runs.size(); ++i) {
        if (groups.empty() || i - groups.back().begin == k_group || runs[i].joints != runs[i - 1].joints)
            groups.push_back({i, i, {}, 0});
        groups.back().end = i + 1;
    }
    std::vector<Told> told(runs.size());
    parallel_for(workers, groups.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t g = begin; g < end; ++g) {
            Group& group = groups[g];
            const auto encoder = std::make_unique<Encoder>(bound, group.bits, runs[group.begin].joints);
            for (size_t i = group.begin; i < group.end; ++i) {
                sample(frames, runs[i], sighted.data(), encoder->samples, encoder->seen);
                encoder->put_track(chain_of(trees[runs[i].mover.tree], runs[i].mover.scale));
                told[i] = {encoder->samples.origin, encoder->samples.moves, encoder->samples.yaw};
            }
            encoder->out.finish();
            group.missed = encoder->missed;
        }
    });
    std::string bytes;
    put_number<uint32_t>(bytes, static_cast<uint32_t>(runs.size()));
    uint64_t before = 0;
    for (const Run& run : runs) put_number(bytes, run.mover.id - std::exchange(before, run.mover.id));
    for (const Run& run : runs) put_number(bytes, run.mover.kind);
    for (const Run& run : runs) put_number(bytes, run.mover.tree);
    for (const Run& run : runs) put_number(bytes, run.mover.scale);
    for (const Run& run : runs) put_number(bytes, static_cast<uint8_t>(run.first));
    for (const Run& run : runs) put_number(bytes, static_cast<uint8_t>(run.ticks));
    for (const Told& one : told) put_number(bytes, one.moves);
    for (int axis = 0; axis < 3; ++axis)
        for (const Told& one : told) put_number(bytes, one.origin[axis]);
    for (const Told& one : told) put_number(bytes, one.yaw);
    put_number<uint32_t>(bytes, static_cast<uint32_t>(groups.size()));
    for (const Group& group : groups) {
        put_number<uint32_t>(bytes, static_cast<uint32_t>(group.end - group.begin));
        put_number<uint32_t>(bytes, static_cast<uint32_t>(group.bits.size()));
        missed += group.missed;
    }
    for (const Group& group : groups) bytes += group.bits;
    return bytes;
}

void take_poses(const std::vector<PoseBlock>& poses, std::span<const BodyMember> bodies,
                std::span<const RigidMember> things, MotionFrame& frame) {
    frame.blocks.resize(poses.size());
    for (size_t b = 0; b < poses.size(); ++b) {
        std::memcpy(frame.blocks[b].origin, poses[b].origin, sizeof poses[b].origin);
        std::memcpy(frame.blocks[b].hips, poses[b].position[hips], sizeof frame.blocks[b].hips);
        std::memcpy(frame.blocks[b].rotation, poses[b].rotation, sizeof poses[b].rotation);
    }
    frame.bodies.assign(bodies.begin(), bodies.end());
    frame.things.assign(things.begin(), things.end());
}

}  // namespace flaneur
