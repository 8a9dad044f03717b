#include "assets/recording/track_encode.h"

#include <algorithm>
#include <cmath>

namespace flaneur {

// A tree of somebody's size, and how it is gone through.
struct TrackChain {
    size_t joints = 0;
    std::array<uint8_t, k_most_recorded_joints> parents{};
    std::array<Vec3, k_most_recorded_joints> offsets{};
    std::array<uint8_t, k_most_recorded_joints> heir{};   // a joint's only child, at which it aims; 0: none
    std::array<float, k_most_recorded_joints> reach{};    // of the longest bone to a child
    std::array<float, k_most_recorded_joints> allowed{};  // share of the bound that a place may be off
};

namespace {

constexpr int k_finest = (1 << k_step_bits) - 1;
// Of the bound: bones of those who reach for something are up to 0.04 mm longer than they should be, and
// roundings differ a little.
constexpr float k_within = 0.96f;

// Joints of the trunk have short bones and hand their errors on to all limbs: they get a share of the
// bound that grows with how many bones it is to the root.
TrackChain chain_of(const BoneTree& tree, float scale) {
    TrackChain chain;
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
void quantise(const float (&weights)[3][k_most_samples], const Waves& waves, int step, CodedCurves& coded) {
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
              CodedCurves& coded) {
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

// Squares of errors, in those of the bound, beyond which even_out() mends nothing.
constexpr float k_hopeless = 3;

// The coarsest step near `guess` at which the largest square of an error, worst(coded) in those of the bound,
// is 1 at most; what is coded then. False where none is fine enough.
template <class Worst>
bool find_step(const float (&weights)[3][k_most_samples], const Waves& waves, const Vec3* curve, int guess,
               CodedCurves& coded, CodedCurves& other, const Worst& worst) {
    const auto fits = [&](int step, CodedCurves& as) {
        quantise(weights, waves, step, as);
        const float error = worst(as);
        if (error <= 1 || error > k_hopeless) return error <= 1;
        even_out(weights, waves, curve, as);
        return worst(as) <= 1;
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

}  // namespace

void TrackEncoder::put_root(const Waves& waves) {
    float weights[3][k_most_samples];
    weigh(samples.root, waves, weights);
    const float by = 1 / (bound.place * bound.place * k_within * k_within);
    const auto worst = [&](const CodedCurves& c) {
        float most = 0;
        for (int s = 0; s < waves.samples && most <= k_hopeless; ++s)
            most = std::max(most, length_squared(c.read[s] - samples.root[s]) * by);
        return most;
    };
    const int guess = guess_of(0, bound.place * 1.5f);
    const bool held = find_step(weights, waves, samples.root, guess, coded, other, worst);
    missed += !held;
    put_coded(0);
}

void TrackEncoder::put_joint(const TrackChain& chain, size_t joint, const Waves& waves) {
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
    const float by_turn = 1 / (half_turn * half_turn);
    const float by_place = 1 / (bound.place * bound.place * k_within * k_within);
    const auto worst = [&](const CodedCurves& c) {
        float most = 0;
        for (int s = 0; s < n && most <= k_hopeless; ++s) {
            const Quat local = turn_of(c.read[s]);
            read[s] = joint == 0 ? local : turns[chain.parents[joint]][s] * local;
            const Quat off = conjugate(samples.turns[joint][s]) * read[s];
            most = std::max(most, length_squared(Vec3{off.x, off.y, off.z}) * by_turn);
        }
        for (size_t child = joint + 1; child < chain.joints; ++child) {
            if (chain.parents[child] != joint) continue;
            const float by = by_place / (chain.allowed[child] * chain.allowed[child]);
            for (int s = 0; s < n && most <= k_hopeless; ++s) {
                const Vec3 place = places[joint][s] + rotate(read[s], chain.offsets[child]);
                most = std::max(most, length_squared(place - true_places[child][s]) * by);
            }
        }
        return most;
    };
    const bool held = find_step(weights, waves, curve, guess_of(joint + 1, room), coded, other, worst);
    missed += !held;
    for (int s = 0; s < n; ++s) {
        const Quat local = turn_of(coded.read[s]);
        read[s] = joint == 0 ? local : turns[chain.parents[joint]][s] * local;
    }
    for (size_t child = joint + 1; child < chain.joints; ++child)
        if (chain.parents[child] == joint)
            for (int s = 0; s < n; ++s)
                places[child][s] = places[joint][s] + rotate(read[s], chain.offsets[child]);
    put_coded(static_cast<int>(joint + 1));
}

void TrackEncoder::put_coded(int at) {
    const bool has_key = key_steps != nullptr;
    const int step = coded.step, from = has_key ? key_steps[at] : 0;
    symbols.code_step(mean_bits, at, has_key, (step - from) & k_finest);
    for (int c = 0; c < 3; ++c) {
        const int channel = 3 * at + c, mean = coded.counts[c] > 0 ? coded.values[c][0] : 0;
        // A root's mean is from the track's own origin.
        const bool has_mean = has_key && at > 0;
        const int usual = has_mean ? steps_to(key_means[channel], step, samples.count) : 0;
        symbols.code_mean(mean_bits, channel, has_mean, mean - usual);
        symbols.code_channel(wave_bits, channel, samples.count, coded.values[c], coded.counts[c]);
        means.means.push_back(mean_of(mean, step, samples.count));
    }
    means.steps.push_back(static_cast<uint8_t>(step));
    guesses[at] = step;
}

int TrackEncoder::guess_of(size_t at, float size) const {
    return key_steps ? key_steps[at] : guesses[at] > 0 ? guesses[at] : step_near(size);
}

TrackEncoder::TrackEncoder(const MotionBound& of, std::string& means_to, std::string& waves_to, size_t joints)
    : bound(of),
      half_turn(sin_cos(of.turn / 2).sine * k_within),
      mean_bits{means_to},
      wave_bits{waves_to},
      symbols(static_cast<int>(3 * (joints + 1))) {}

void TrackEncoder::put(const BoneTree& tree, float scale, const uint8_t* steps, const float* usual) {
    const TrackChain chain = chain_of(tree, scale);
    const Waves& waves = waves_of(samples.count);
    key_steps = steps;
    key_means = usual;
    for (int s = 0; s < samples.count; ++s) {
        true_places[0][s] = places[0][s] = {};
        for (size_t j = 1; j < chain.joints; ++j)
            true_places[j][s] = true_places[chain.parents[j]][s] +
                                rotate(samples.turns[chain.parents[j]][s], chain.offsets[j]);
    }
    symbols.begin_track();
    put_root(waves);
    for (size_t j = 0; j < chain.joints; ++j) put_joint(chain, j, waves);
    symbols.end_track(steps != nullptr);
}

void TrackEncoder::finish() {
    mean_bits.finish();
    wave_bits.finish();
}

}  // namespace flaneur
