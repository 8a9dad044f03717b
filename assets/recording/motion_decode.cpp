#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include "assets/recording/bytes.h"
#include "assets/recording/chain.h"
#include "assets/recording/motion.h"
#include "assets/recording/symbols.h"

namespace flaneur {

namespace {

constexpr size_t k_track_bytes = 8 + 4 + 4 + 4 + 1 + 1 + 8 + 12 + 1;

struct Group {
    size_t begin = 0, end = 0;  // tracks
    std::string_view bits;
    std::vector<float> values;
    std::vector<uint8_t> counts;
};

// One value of each track, tracks after tracks. There is room: see decode_motion().
template <class T, class Set>
void take_column(std::string_view& bytes, std::vector<MotionTrack>& tracks, const Set& set) {
    for (MotionTrack& track : tracks) {
        T value{};
        take_number(bytes, value);
        set(track, value);
    }
}

bool is_sound(const MotionTrack& track, uint32_t ticks, size_t trees) {
    return track.ticks > 0 && uint32_t{track.first} + track.ticks <= ticks && track.mover.tree < trees &&
           track.moves & 1 && std::bit_width(track.moves) <= track.ticks && track.mover.scale > 0 &&
           track.mover.scale < 1e6f;
}

void decode_group(Group& group, std::vector<MotionTrack>& tracks, size_t joints) {
    BitReader in(group.bits);
    Symbols symbols(static_cast<int>(3 * (joints + 1)));
    int values[k_most_samples];
    for (size_t i = group.begin; i < group.end; ++i) {
        const int samples = std::popcount(tracks[i].moves);
        tracks[i].values = group.values.size();
        tracks[i].counts = group.counts.size();
        symbols.begin_track();
        for (size_t j = 0; j <= joints; ++j) {
            const float step = step_of(symbols.code_step(in, static_cast<int>(j), 0));
            for (int c = 0; c < 3; ++c) {
                const int count = symbols.code_channel(in, static_cast<int>(3 * j) + c, samples, values, 0);
                group.counts.push_back(static_cast<uint8_t>(count));
                for (int wave = 0; wave < count; ++wave)
                    group.values.push_back(static_cast<float>(values[wave]) * step);
            }
        }
        symbols.end_track();
    }
}

}  // namespace

Result<RecordedMotion> decode_motion(std::string_view bytes, uint32_t first, uint32_t ticks,
                                     std::span<const BoneTree> trees, Workers& workers) {
    const Error broken{"is damaged: its motion does not add up"};
    RecordedMotion motion;
    motion.first = first;
    motion.ticks = ticks;
    uint32_t count = 0, group_count = 0;
    if (ticks > k_most_ticks || !take_number(bytes, count) || count > bytes.size() / k_track_bytes)
        return broken;
    std::vector<MotionTrack>& tracks = motion.tracks;
    tracks.resize(count);
    uint64_t id = 0;
    take_column<uint64_t>(bytes, tracks, [&](MotionTrack& t, uint64_t v) { t.mover.id = id += v; });
    take_column<uint32_t>(bytes, tracks, [](MotionTrack& t, uint32_t v) { t.mover.kind = v; });
    take_column<uint32_t>(bytes, tracks, [](MotionTrack& t, uint32_t v) { t.mover.tree = v; });
    take_column<float>(bytes, tracks, [](MotionTrack& t, float v) { t.mover.scale = v; });
    take_column<uint8_t>(bytes, tracks, [](MotionTrack& t, uint8_t v) { t.first = v; });
    take_column<uint8_t>(bytes, tracks, [](MotionTrack& t, uint8_t v) { t.ticks = v; });
    take_column<uint64_t>(bytes, tracks, [](MotionTrack& t, uint64_t v) { t.moves = v; });
    for (int axis = 0; axis < 3; ++axis)
        take_column<int32_t>(bytes, tracks, [axis](MotionTrack& t, int32_t v) { t.origin[axis] = v; });
    take_column<uint8_t>(bytes, tracks, [](MotionTrack& t, uint8_t v) { t.yaw = v; });
    for (const MotionTrack& track : tracks)
        if (!is_sound(track, ticks, trees.size())) return broken;

    if (!take_number(bytes, group_count) || group_count > count || bytes.size() / 8 < group_count)
        return broken;
    std::vector<Group> groups(group_count);
    std::string_view bits = bytes.substr(size_t{group_count} * 8);
    size_t at = 0;
    for (Group& group : groups) {
        uint32_t members = 0, size = 0;
        take_number(bytes, members);
        take_number(bytes, size);
        if (members == 0 || members > k_group || members > count - at || size > bits.size()) return broken;
        group.begin = at;
        group.end = at += members;
        group.bits = bits.substr(0, size);
        bits.remove_prefix(size);
        const size_t joints = trees[tracks[group.begin].mover.tree].parents.size();
        for (size_t i = group.begin; i < group.end; ++i)
            if (trees[tracks[i].mover.tree].parents.size() != joints) return broken;
    }
    if (at != count || !bits.empty()) return broken;

    parallel_for(workers, groups.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t g = begin; g < end; ++g)
            decode_group(groups[g], tracks, trees[tracks[groups[g].begin].mover.tree].parents.size());
    });
    for (Group& group : groups) {
        for (size_t i = group.begin; i < group.end; ++i) {
            tracks[i].values += motion.values.size();
            tracks[i].counts += motion.counts.size();
        }
        motion.values.insert(motion.values.end(), group.values.begin(), group.values.end());
        motion.counts.insert(motion.counts.end(), group.counts.begin(), group.counts.end());
    }
    return motion;
}

bool pose_at(const RecordedMotion& motion, size_t index, std::span<const BoneTree> trees, uint32_t tick,
             MotionPose& pose) {
    const MotionTrack& track = motion.tracks[index];
    if (tick < motion.first + track.first || tick - motion.first - track.first >= track.ticks) return false;
    const uint32_t since = tick - motion.first - track.first;
    const uint64_t until = since == 63 ? ~uint64_t{0} : (uint64_t{1} << (since + 1)) - 1;
    const int sample = std::popcount(track.moves & until) - 1;
    const Waves& waves = waves_of(std::popcount(track.moves));
    const float* value = motion.values.data() + track.values;
    const uint8_t* count = motion.counts.data() + track.counts;
    const auto next = [&] {
        float sum = 0;
        const float* form = waves.values.data() + sample;
        for (int wave = 0; wave < *count; ++wave) sum += *value++ * form[wave * waves.samples];
        ++count;
        return sum;
    };
    const auto vector = [&] {
        Vec3 v;
        v.x = next();
        v.y = next();
        v.z = next();
        return v;
    };
    const BoneTree& tree = trees[track.mover.tree];
    const Quat ahead = rotation_y(static_cast<float>(track.yaw) * k_yaw_step);
    pose.origin = {static_cast<float>(track.origin[0]) * k_origin_step,
                   static_cast<float>(track.origin[1]) * k_origin_step,
                   static_cast<float>(track.origin[2]) * k_origin_step};
    pose.places[0] = rotate(ahead, vector());
    pose.turns[0] = normalize(ahead * turn_of(vector()));
    for (size_t j = 1; j < tree.parents.size(); ++j) {
        const size_t parent = tree.parents[j];
        pose.places[j] =
            pose.places[parent] + rotate(pose.turns[parent], tree.offsets[j] * track.mover.scale);
        pose.turns[j] = normalize(pose.turns[parent] * turn_of(vector()));
    }
    return true;
}

BoneTree bone_tree_of(const Body& body) {
    BoneTree tree;
    tree.parents.assign(k_joint_count, 0);
    tree.offsets.assign(k_joint_count, {});
    for (size_t j = 1; j < k_joint_count; ++j) {
        tree.parents[j] = static_cast<uint8_t>(k_joint_parents[j]);
        tree.offsets[j] = body.joints[j] - body.joints[tree.parents[j]];
    }
    return tree;
}

BoneTree rigid_tree() { return {{0}, {Vec3{}}}; }

std::string encode_trees(std::span<const BoneTree> trees) {
    std::string bytes;
    put_number(bytes, static_cast<uint32_t>(trees.size()));
    for (const BoneTree& tree : trees) {
        put_number(bytes, static_cast<uint8_t>(tree.parents.size()));
        for (size_t j = 1; j < tree.parents.size(); ++j) {
            put_number(bytes, tree.parents[j]);
            put_number(bytes, tree.offsets[j].x);
            put_number(bytes, tree.offsets[j].y);
            put_number(bytes, tree.offsets[j].z);
        }
    }
    return bytes;
}

Result<std::vector<BoneTree>> decode_trees(std::string_view bytes) {
    const Error broken{"is damaged: its trees do not add up"};
    uint32_t count = 0;
    if (!take_number(bytes, count) || count > bytes.size()) return broken;
    std::vector<BoneTree> trees(count);
    for (BoneTree& tree : trees) {
        uint8_t joints = 0;
        if (!take_number(bytes, joints) || joints == 0 || joints > k_most_recorded_joints) return broken;
        tree.parents.assign(joints, 0);
        tree.offsets.assign(joints, {});
        for (size_t j = 1; j < joints; ++j) {
            Vec3& o = tree.offsets[j];
            if (!take_number(bytes, tree.parents[j]) || !take_number(bytes, o.x) ||
                !take_number(bytes, o.y) || !take_number(bytes, o.z) || tree.parents[j] >= j ||
                !(length(o) < 1e4f))
                return broken;
        }
    }
    if (!bytes.empty()) return broken;
    return trees;
}

}  // namespace flaneur
