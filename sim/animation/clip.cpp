#include "sim/animation/clip.h"

#include <algorithm>
#include <cmath>

#include "sim/animation/clip-inl.h"

namespace flaneur {

namespace {

constexpr size_t k_most_keys = 100000;

int16_t quantised(float value, float unit) {
    return int16_t(clamp(std::floor(value / unit + 0.5f), -32767, 32767));
}

// One joint's rotations with the signs that make sums short: neighbours on one side, most of them on that of
// `rest`. Returns -1 where the loop closes onto the opposite sign: a joint that turns all the way round.
float settle_signs(std::vector<Quat>& rotations, Quat rest) {
    float side = 0;
    for (size_t k = 0; k < rotations.size(); ++k) {
        Quat& q = rotations[k];
        q = normalize(q);
        if (k > 0 && dot(q, rotations[k - 1]) < 0) q = {-q.x, -q.y, -q.z, -q.w};
        side += dot(q, rest);
    }
    if (side < 0)
        for (Quat& q : rotations) q = {-q.x, -q.y, -q.z, -q.w};
    return dot(rotations.back(), rotations.front()) < 0 ? -1.0f : 1.0f;
}

Result<void> check_keys(size_t joints, const std::vector<LocalPose>& keys) {
    for (const LocalPose& key : keys) {
        if (key.rotations.size() != joints)
            return Error{"a pose has " + std::to_string(key.rotations.size()) +
                         " joints and its skeleton has " + std::to_string(joints)};
        for (Quat q : key.rotations)
            if (float norm = dot(q, q); !(norm > 1e-12f && norm < 1e12f))
                return Error{"a pose has a rotation that is none; give unit quaternions"};
        for (float f : {key.offset.x, key.offset.y, key.offset.z})
            if (!(std::fabs(f) <= 32767 * k_offset_unit))
                return Error{"a pose carries its root more than 8 m away; take the travel out of the clip"};
    }
    return {};
}

}  // namespace

Result<Clip> make_clip(const Skeleton& skeleton, const std::vector<LocalPose>& keys, float rate, bool loops,
                       Curve curve) {
    if (auto sound = check_skeleton(skeleton); !sound) return sound.error();
    if (keys.empty() || keys.size() > k_most_keys)
        return Error{"a clip needs 1 to " + std::to_string(k_most_keys) + " keys"};
    if (!(rate > 1e-3f && rate < 1e6f)) return Error{"a clip needs a positive rate of keys a second"};
    size_t joints = skeleton.parents.size(), count = keys.size();
    if (auto sound = check_keys(joints, keys); !sound) return sound.error();

    Clip clip;
    clip.joints = uint32_t(joints);
    clip.keys = uint32_t(count);
    clip.loops = loops;
    clip.curve = curve;
    clip.duration = float(loops ? count : count - 1) / rate;
    size_t pieces = local_rows(joints) / 16;
    clip.rows.resize((count + 3) * pieces);
    auto put = [&](size_t row, size_t column, int16_t value) {
        clip.rows[row * pieces + column / 16].values[column % 16] = value;
    };
    // Row r holds key r - 1; those beyond the ends go round or stay, with the sign that goes on from there.
    auto key_of = [&](size_t row) {
        return loops ? (row + count - 1) % count : std::min(row > 0 ? row - 1 : 0, count - 1);
    };
    std::vector<Quat> rotations(count);
    for (size_t j = 0; j < joints; ++j) {
        for (size_t k = 0; k < count; ++k) rotations[k] = keys[k].rotations[j];
        float seam = settle_signs(rotations, skeleton.rotations[j]);
        for (size_t row = 0; row < count + 3; ++row) {
            bool beyond = row == 0 || row > count;
            Quat q = rotations[key_of(row)];
            float unit = k_rotation_unit * (loops && beyond ? seam : 1.0f);
            put(row, 4 * j, quantised(q.x, unit)), put(row, 4 * j + 1, quantised(q.y, unit));
            put(row, 4 * j + 2, quantised(q.z, unit)), put(row, 4 * j + 3, quantised(q.w, unit));
        }
    }
    for (size_t row = 0; row < count + 3; ++row) {
        Vec3 offset = keys[key_of(row)].offset;
        put(row, 4 * joints, quantised(offset.x, k_offset_unit));
        put(row, 4 * joints + 1, quantised(offset.y, k_offset_unit));
        put(row, 4 * joints + 2, quantised(offset.z, k_offset_unit));
    }
    return clip;
}

Result<Clip> make_additive_clip(const Skeleton& skeleton, std::vector<LocalPose> keys,
                                const LocalPose& reference, float rate, bool loops, Curve curve) {
    size_t joints = skeleton.parents.size();
    if (auto sound = check_keys(joints, keys); !sound) return sound.error();
    if (auto sound = check_keys(joints, {reference}); !sound) return sound.error();
    for (LocalPose& key : keys) {
        for (size_t j = 0; j < joints; ++j)
            key.rotations[j] = conjugate(normalize(reference.rotations[j])) * key.rotations[j];
        key.offset = key.offset - reference.offset;
    }
    Skeleton differences = skeleton;
    differences.rotations.assign(joints, {});
    return make_clip(differences, keys, rate, loops, curve);
}

LocalPose sample(const Clip& clip, float phase) {
    namespace kernel = HWY_NAMESPACE;
    kernel::TapList<4> list;
    kernel::KeyTime<float> time = kernel::key_time(clip, phase);
    kernel::add_taps(list, clip, time.key, time.fraction, 1);
    auto sum = [&](size_t column) {
        float total = 0;
        size_t part = column / 16;
        for (size_t t = 0; t < list.count; ++t)
            total += list.taps[t].weight * list.taps[t].row[part].values[column % 16];
        return total;
    };
    LocalPose pose;
    for (size_t j = 0; j < clip.joints; ++j) {
        kernel::Q4<float> q{sum(4 * j), sum(4 * j + 1), sum(4 * j + 2), sum(4 * j + 3)};
        q = kernel::normalize_or_identity(q);
        pose.rotations.push_back({q.x, q.y, q.z, q.w});
    }
    size_t offset = 4 * size_t(clip.joints);
    pose.offset = Vec3{sum(offset), sum(offset + 1), sum(offset + 2)} * k_offset_unit;
    return pose;
}

}  // namespace flaneur
