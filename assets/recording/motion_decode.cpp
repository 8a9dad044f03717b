#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>

#include "assets/recording/bytes.h"
#include "assets/recording/chain.h"
#include "assets/recording/motion.h"
#include "assets/recording/symbols.h"

namespace flaneur {

namespace {

// Of a chunk, of which 100,000 people have some 70 million.
constexpr size_t k_most_values = size_t{1} << 27;
constexpr size_t k_track_bytes = 8 + 4 + 4 + 4 + 1 + 1 + 8 + 12 + 1;

struct Group {
    size_t begin = 0, end = 0;  // tracks
    std::string_view means, waves;
    MotionMeans learned;
    std::vector<float> values;
    std::vector<uint8_t> counts;
};

// Bytes taken apart.
struct Parts {
    uint32_t key = k_no_key;
    std::vector<Group> groups;
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

// Steps and means alone.
void decode_means_of(Group& group, const std::vector<MotionTrack>& tracks, size_t joints,
                     const MotionMeans* key, Symbols& symbols) {
    BitReader in(group.means);
    for (size_t i = group.begin; i < group.end; ++i) {
        const int samples = std::popcount(tracks[i].moves);
        const MotionMeans::One* usual = find_mean(key, tracks[i].mover, joints);
        for (size_t j = 0; j <= joints; ++j) {
            const int from = usual ? key->steps[usual->begin + j] : 0, at = static_cast<int>(j);
            const int step = (symbols.code_step(in, at, usual, 0) + from) & ((1 << k_step_bits) - 1);
            group.learned.steps.push_back(static_cast<uint8_t>(step));
            for (int c = 0; c < 3; ++c) {
                const bool has_mean = usual && j > 0;
                const int of_key =
                    has_mean ? steps_to(key->means[3 * (usual->begin + j) + c], step, samples) : 0;
                const int mean = of_key + symbols.code_mean(in, 3 * at + c, has_mean, 0);
                group.learned.means.push_back(mean_of(mean, step, samples));
            }
        }
        symbols.end_track(usual);
    }
}

void decode_group(Group& group, std::vector<MotionTrack>& tracks, size_t joints, const MotionMeans* key,
                  std::atomic<size_t>& values_so_far) {
    const int channels = static_cast<int>(3 * (joints + 1));
    Symbols of_means(channels), symbols(channels);
    decode_means_of(group, tracks, joints, key, of_means);
    BitReader in(group.waves);
    int values[k_most_samples];
    const float* mean = group.learned.means.data();
    const uint8_t* step = group.learned.steps.data();
    for (size_t i = group.begin; i < group.end; ++i) {
        const int samples = std::popcount(tracks[i].moves);
        const float unit = std::sqrt(static_cast<float>(samples));
        tracks[i].values = group.values.size();
        tracks[i].counts = group.counts.size();
        symbols.begin_track();
        for (int channel = 0; channel < channels; ++channel) {
            const float size = step_of(step[channel / 3]);
            const int count = symbols.code_channel(in, channel, samples, values, 0);
            group.counts.push_back(static_cast<uint8_t>(count));
            group.values.push_back(*mean++ * unit);
            for (int wave = 1; wave < count; ++wave)
                group.values.push_back(static_cast<float>(values[wave]) * size);
        }
        symbols.end_track(false);
        step += joints + 1;
        if (values_so_far.load(std::memory_order_relaxed) + group.values.size() > k_most_values) break;
    }
    values_so_far += group.values.size();
}

// Fills `tracks` but for their waves.
Result<Parts> take_apart(std::string_view bytes, uint32_t ticks, std::span<const BoneTree> trees,
                         std::vector<MotionTrack>& tracks) {
    const Error broken{"is damaged: its motion does not add up"};
    Parts parts;
    uint32_t count = 0, group_count = 0;
    if (ticks > k_most_ticks || !take_number(bytes, count) || !take_number(bytes, parts.key) ||
        count > bytes.size() / k_track_bytes)
        return broken;
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

    if (!take_number(bytes, group_count) || group_count > count || bytes.size() / 12 < group_count)
        return broken;
    parts.groups.resize(group_count);
    std::string_view bits = bytes.substr(size_t{group_count} * 12);
    std::vector<uint32_t> wave_sizes;
    size_t at = 0;
    for (Group& group : parts.groups) {
        uint32_t members = 0, means = 0, waves = 0;
        take_number(bytes, members);
        take_number(bytes, means);
        take_number(bytes, waves);
        if (members == 0 || members > k_group || members > count - at || means > bits.size()) return broken;
        group.begin = at;
        group.end = at += members;
        group.means = bits.substr(0, means);
        bits.remove_prefix(means);
        wave_sizes.push_back(waves);
        const size_t joints = trees[tracks[group.begin].mover.tree].parents.size();
        for (size_t i = group.begin; i < group.end; ++i)
            if (trees[tracks[i].mover.tree].parents.size() != joints) return broken;
    }
    for (size_t g = 0; g < parts.groups.size(); ++g) {
        if (wave_sizes[g] > bits.size()) return broken;
        parts.groups[g].waves = bits.substr(0, wave_sizes[g]);
        bits.remove_prefix(wave_sizes[g]);
    }
    if (at != count || !bits.empty()) return broken;
    return parts;
}

size_t joints_of(const Group& group, const std::vector<MotionTrack>& tracks,
                 std::span<const BoneTree> trees) {
    return trees[tracks[group.begin].mover.tree].parents.size();
}

}  // namespace

std::optional<uint32_t> key_of(std::string_view bytes) {
    uint32_t count = 0, key = k_no_key;
    if (!take_number(bytes, count) || !take_number(bytes, key) || key == k_no_key) return {};
    return key;
}

Result<MotionMeans> decode_means(std::string_view bytes, uint32_t first, uint32_t ticks,
                                 std::span<const BoneTree> trees) {
    std::vector<MotionTrack> tracks;
    Result<Parts> parts = take_apart(bytes, ticks, trees, tracks);
    if (!parts) return parts.error();
    if (parts->key != k_no_key) return Error{"is damaged: what should be a key needs one"};
    MotionMeans means;
    means.first = first;
    for (Group& group : parts->groups) {
        const size_t joints = joints_of(group, tracks, trees);
        Symbols symbols(static_cast<int>(3 * (joints + 1)));
        decode_means_of(group, tracks, joints, nullptr, symbols);
        for (size_t i = group.begin; i < group.end; ++i) add_one(means, tracks[i].mover, joints);
        add_means(means, group.learned);
    }
    sort_ones(means);
    return means;
}

Result<MotionChunk> decode_motion(std::string_view bytes, uint32_t first, uint32_t ticks,
                                  std::span<const BoneTree> trees, const MotionMeans* key, Workers& workers) {
    MotionChunk motion;
    motion.first = first;
    motion.ticks = ticks;
    std::vector<MotionTrack>& tracks = motion.tracks;
    Result<Parts> parts = take_apart(bytes, ticks, trees, tracks);
    if (!parts) return parts.error();
    if (parts->key != (key ? key->first : k_no_key)) return Error{"is damaged: its motion needs another key"};
    std::vector<Group>& groups = parts->groups;
    std::atomic<size_t> values_so_far = 0;
    parallel_for(workers, groups.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t g = begin; g < end; ++g)
            decode_group(groups[g], tracks, joints_of(groups[g], tracks, trees), key, values_so_far);
    });
    if (values_so_far > k_most_values) return Error{"is damaged: more moves in it than can be"};
    motion.values.reserve(values_so_far);
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

bool pose_at(const MotionChunk& motion, size_t index, std::span<const BoneTree> trees, uint32_t tick,
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
