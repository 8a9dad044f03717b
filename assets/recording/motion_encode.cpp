#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <tuple>
#include <utility>

#include "assets/recording/bytes.h"
#include "assets/recording/motion.h"
#include "assets/recording/track_encode.h"

namespace flaneur {

namespace {

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

struct Seen {
    double at[3];
    Quat turns[k_most_recorded_joints];
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

void sample(const MotionFrames& frames, const Run& run, const Sighted* sighted, SampledTrack& samples,
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
    std::string means, waves;   // bits
    MotionMeans learned;
    uint64_t missed = 0;
};

// What is told of a run beside its waves.
struct Told {
    std::array<int32_t, 3> origin;
    uint64_t moves;
    uint8_t yaw;
};

void encode_group(const MotionFrames& frames, std::span<const BoneTree> trees, const MotionBound& bound,
                  const MotionMeans* key, std::span<const Run> runs, const Sighted* sighted, Group& group,
                  Told* told) {
    const size_t joints = runs[group.begin].joints;
    const auto encoder = std::make_unique<TrackEncoder>(bound, group.means, group.waves, joints);
    std::vector<Seen> seen(k_most_samples);
    for (size_t i = group.begin; i < group.end; ++i) {
        const RecordedMover& mover = runs[i].mover;
        SampledTrack& samples = encoder->samples;
        sample(frames, runs[i], sighted, samples, seen);
        const MotionMeans::One* usual = find_mean(key, mover, joints);
        encoder->put(trees[mover.tree], mover.scale, usual ? &key->steps[usual->begin] : nullptr,
                     usual ? &key->means[3 * usual->begin] : nullptr);
        told[i] = {samples.origin, samples.moves, samples.yaw};
    }
    encoder->finish();
    group.missed = encoder->missed;
    group.learned = std::move(encoder->means);
}

std::string head_of(const std::vector<Run>& runs, const std::vector<Told>& told, const MotionMeans* key) {
    std::string bytes;
    put_number(bytes, static_cast<uint32_t>(runs.size()));
    put_number(bytes, key ? key->first : k_no_key);
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
    return bytes;
}

}  // namespace

EncodedMotion encode_motion(const MotionFrames& frames, std::span<const BoneTree> trees,
                            const MotionBound& bound, const MotionMeans* key, Workers& workers) {
    std::vector<Run> runs;
    std::vector<Sighted> sighted;
    find_runs(frames, trees, runs, sighted);
    std::vector<Group> groups;
    for (size_t i = 0; i < runs.size(); ++i) {
        if (groups.empty() || i - groups.back().begin == k_group || runs[i].joints != runs[i - 1].joints)
            groups.emplace_back().begin = i;
        groups.back().end = i + 1;
    }
    std::vector<Told> told(runs.size());
    parallel_for(workers, groups.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t g = begin; g < end; ++g)
            encode_group(frames, trees, bound, key, runs, sighted.data(), groups[g], told.data());
    });

    EncodedMotion encoded;
    std::string& bytes = encoded.bytes = head_of(runs, told, key);
    put_number(bytes, static_cast<uint32_t>(groups.size()));
    for (const Group& group : groups) {
        put_number(bytes, static_cast<uint32_t>(group.end - group.begin));
        put_number(bytes, static_cast<uint32_t>(group.means.size()));
        put_number(bytes, static_cast<uint32_t>(group.waves.size()));
    }
    for (const Group& group : groups) bytes += group.means;
    for (const Group& group : groups) bytes += group.waves;
    encoded.means.first = frames.first;
    for (const Run& run : runs) add_one(encoded.means, run.mover, run.joints);
    for (const Group& group : groups) {
        add_means(encoded.means, group.learned);
        encoded.missed += group.missed;
    }
    sort_ones(encoded.means);
    return encoded;
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
