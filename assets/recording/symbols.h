// Whole numbers of waves as bits, written and read by the same code. How large a number is likely to be is
// told by those of the same wave before it in the group, its neighbours in the wave's channel, and how much
// of late this one moved against others. Private to assets/recording.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <vector>

#include "assets/recording/coder.h"
#include "assets/recording/waves.h"

namespace flaneur {

inline constexpr int k_step_bits = 6;         // a step is one of 64
inline constexpr int k_most_value = 1 << 20;  // of a number

inline bool code_bit(BitWriter& to, Odds& odds, bool bit) { return to.put(odds, bit), bit; }
inline bool code_bit(BitReader& from, Odds& odds, bool) { return from.get(odds); }
inline uint32_t code_even(BitWriter& to, uint32_t value, int count) {
    return to.put_even(value, count), value;
}
inline uint32_t code_even(BitReader& from, uint32_t, int count) { return from.get_even(count); }

struct Symbols {
    static constexpr int k_sizes = 14, k_near = 5, k_stir = 3, k_lengths = 22;

    explicit Symbols(int channels)
        : typical(channels * k_most_samples),
          steps{std::vector<Odds>(channels << k_step_bits), std::vector<Odds>(channels << k_step_bits)},
          usual_means{std::vector<uint32_t>(channels), std::vector<uint32_t>(channels)} {}

    std::vector<uint32_t> typical;  // of each channel's waves: mean size, in 1/256
    int seen = 0;                   // tracks before
    // Without a key, and with one.
    std::vector<Odds> steps[2];
    std::vector<uint32_t> usual_means[2];
    int means_seen[2] = {};
    Odds mean_length[2][2 * k_sizes][k_lengths], mean_sign[2];
    Odds length[k_stir][k_sizes][k_near][k_lengths];
    Odds mantissa[k_lengths][4], mean_mantissa[k_lengths][4];
    Odds sign;
    Odds ends[k_stir][2 * k_sizes];
    uint32_t moved = 0, usual = 0;  // of this track so far

    static int size_class(uint32_t typical_size) {  // in half octaves
        const uint32_t t = typical_size * 2 + 1;
        const int octave = std::bit_width(t) - 1;
        const int half = octave > 0 ? static_cast<int>(t >> (octave - 1) & 1) : 0;
        return octave * 2 + half;
    }
    int stir() const {
        const uint64_t more = uint64_t{moved} * 2, less = usual;
        return more < less ? 0 : moved > 2 * uint64_t{usual} ? 2 : 1;
    }
    void begin_track() { moved = usual = 256; }
    void end_track(bool has_key) {
        ++seen;
        ++means_seen[has_key];
    }

    template <class Coder>
    int code_step(Coder& coder, int channel, bool has_key, int step) {
        Odds* tree = &steps[has_key][channel << k_step_bits];
        int node = 1;
        for (int bit = k_step_bits - 1; bit >= 0; --bit)
            node = node << 1 | code_bit(coder, tree[node], step >> bit & 1);
        return node - (1 << k_step_bits);
    }

    template <class Coder>
    int code_value(Coder& coder, Odds* odds, Odds (&second)[k_lengths][4], Odds& odds_of_sign, int value) {
        const auto size = static_cast<uint32_t>(std::abs(value));
        int bits = 0;
        const int wanted = std::bit_width(size);
        while (bits < k_lengths - 1 && code_bit(coder, odds[bits], bits < wanted)) ++bits;
        if (bits == 0) return 0;
        uint32_t read = 1;
        int left = bits - 1;
        if (left > 0) {
            --left;
            read = read << 1 | code_bit(coder, second[bits][0], size >> left & 1);
        }
        if (left > 0) {
            --left;
            read = read << 1 | code_bit(coder, second[bits][1 + (read & 1)], size >> left & 1);
        }
        if (left > 0) read = read << left | code_even(coder, size & ((1u << left) - 1), left);
        const bool negative = code_bit(coder, odds_of_sign, value < 0);
        return negative ? -static_cast<int>(read) : static_cast<int>(read);
    }

    // What lasts: the first wave, or by how much it is not that of the key.
    template <class Coder>
    int code_mean(Coder& coder, int channel, bool has_key, int value) {
        uint32_t& usual_mean = usual_means[has_key][channel];
        const int size = std::min(size_class(usual_mean), 2 * k_sizes - 1);
        value = code_value(coder, mean_length[has_key][size], mean_mantissa, mean_sign[has_key], value);
        learn(usual_mean, value, means_seen[has_key]);
        return value;
    }

    // The waves from the second on, of which the first `count` of `values` are not all that there are: others
    // are 0. Gives how many up to the last that is not 0, or a few more.
    template <class Coder>
    int code_channel(Coder& coder, int channel, int samples, int* values, int count) {
        uint32_t* means = &typical[channel * k_most_samples];
        uint32_t rest = 0;
        for (int wave = 1; wave < samples; ++wave) rest += means[wave];
        int wave = 1;
        for (; wave < samples; ++wave) {
            if (wave % 4 == 1) {
                Odds& odds = ends[stir()][std::min(size_class(rest), 2 * k_sizes - 1)];
                if (!code_bit(coder, odds, wave < count)) break;
            }
            rest -= means[wave];
            const int size = std::min(size_class(means[wave]) / 2, k_sizes - 1);
            Odds* odds = length[stir()][size][beside(values, means, wave)];
            values[wave] = code_value(coder, odds, mantissa, sign, wave < count ? values[wave] : 0);
            if (wave == 1) continue;
            moved += std::min(std::abs(values[wave]), 255) * 256;
            usual += std::min(means[wave], 255u * 256);
            if (moved > 1u << 26 || usual > 1u << 26) moved /= 2, usual /= 2;
        }
        for (int w = 1; w < samples; ++w) learn(means[w], w < wave ? values[w] : 0, seen);
        return wave;
    }

  private:
    static void learn(uint32_t& typical_size, int value, int before) {
        const int now = std::min(std::abs(value), k_most_value) * 256, then = static_cast<int>(typical_size);
        typical_size = static_cast<uint32_t>(then + ((now - then) >> (before < 3    ? 1 + before
                                                                      : before < 12 ? 3
                                                                                    : 4)));
    }
    // Whether the two waves before are larger or smaller than they mostly are.
    static int beside(const int* values, const uint32_t* means, int wave) {
        if (wave < 2) return 0;
        const int other = wave > 2 ? wave - 2 : 1;
        const uint32_t near =
            256 * std::min(2u * std::abs(values[wave - 1]) + std::abs(values[other]), 1u << 16);
        const uint32_t expected = 2 * means[wave - 1] + means[other];
        return near == 0 ? 1 : near < expected / 2 ? 2 : near <= 2 * expected ? 3 : 4;
    }
};

}  // namespace flaneur
