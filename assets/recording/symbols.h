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
    static constexpr int k_sizes = 14, k_near = 5, k_stir = 3, k_lengths = 22, k_rest = 8;

    explicit Symbols(int channels) : typical(channels * k_most_samples), steps(channels << k_step_bits) {}

    std::vector<uint32_t> typical;  // of each channel's waves: mean size, in 1/256
    int seen = 0;                   // tracks before
    std::vector<Odds> steps;
    Odds length[k_stir][k_sizes][k_near][k_lengths];
    Odds mantissa[k_lengths][4];
    Odds sign[2];
    Odds ends[k_stir][2 * k_sizes];
    uint32_t moved = 0, usual = 0;  // of this track so far

    static int size_class(uint32_t typical_size) {  // half octaves from 1/64 on
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
    void end_track() { ++seen; }

    template <class Coder>
    int code_step(Coder& coder, int channel, int step) {
        Odds* tree = &steps[channel << k_step_bits];
        int node = 1;
        for (int bit = k_step_bits - 1; bit >= 0; --bit)
            node = node << 1 | code_bit(coder, tree[node], step >> bit & 1);
        return node - (1 << k_step_bits);
    }

    template <class Coder>
    int code_value(Coder& coder, Odds* odds, int wave, int value) {
        const auto size = static_cast<uint32_t>(std::abs(value));
        int bits = 0;
        const int wanted = std::bit_width(size);
        while (bits < k_lengths - 1 && code_bit(coder, odds[bits], bits < wanted)) ++bits;
        if (bits == 0) return 0;
        uint32_t read = 1;
        int left = bits - 1;
        if (left > 0) {
            --left;
            read = read << 1 | code_bit(coder, mantissa[bits][0], size >> left & 1);
        }
        if (left > 0) {
            --left;
            read = read << 1 | code_bit(coder, mantissa[bits][1 + (read & 1)], size >> left & 1);
        }
        if (left > 0) read = read << left | code_even(coder, size & ((1u << left) - 1), left);
        const bool negative = code_bit(coder, sign[wave == 0], value < 0);
        return negative ? -static_cast<int>(read) : static_cast<int>(read);
    }

    // The first `count` of `values` are not all that there are: others are 0. Gives how many up to the last
    // that is not 0, or a few more.
    template <class Coder>
    int code_channel(Coder& coder, int channel, int samples, int* values, int count) {
        uint32_t* means = &typical[channel * k_most_samples];
        uint32_t rest = 0;
        for (int wave = 0; wave < samples; ++wave) rest += means[wave];
        int wave = 0;
        for (; wave < samples; ++wave) {
            if (wave % 4 == 0) {
                const bool more =
                    code_bit(coder, ends[stir()][std::min(size_class(rest), 2 * k_sizes - 1)], wave < count);
                if (!more) break;
            }
            rest -= means[wave];
            const uint32_t one = wave > 0 ? std::abs(values[wave - 1]) : 0;
            const uint32_t two = wave > 1 ? std::abs(values[wave - 2]) : one;
            const uint32_t near = std::min(2 * one + two, 1u << 16) * 256;
            const uint32_t expected = wave > 1 ? 2 * means[wave - 1] + means[wave - 2] : 0;
            const int beside = wave < 2               ? 0
                               : near == 0            ? 1
                               : near < expected / 2  ? 2
                               : near <= 2 * expected ? 3
                                                      : 4;
            const int size = std::min(size_class(means[wave]) / 2, k_sizes - 1);
            values[wave] =
                code_value(coder, length[stir()][size][beside], wave, wave < count ? values[wave] : 0);
            if (wave > 1) {
                moved += std::min(std::abs(values[wave]), 255) * 256;
                usual += std::min(means[wave], 255u * 256);
                if (moved > 1u << 26 || usual > 1u << 26) moved /= 2, usual /= 2;
            }
        }
        for (int w = 0; w < samples; ++w) {
            const int now = w < wave ? std::min(std::abs(values[w]), k_most_value) * 256 : 0;
            const int by = seen < 3 ? 1 + seen : seen < 12 ? 3 : 4;
            means[w] = static_cast<uint32_t>(static_cast<int>(means[w]) +
                                             ((now - static_cast<int>(means[w])) >> by));
        }
        return wave;
    }
};

}  // namespace flaneur
