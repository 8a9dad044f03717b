// Bits by how likely they are: an adaptive binary range coder, after that of LZMA (Igor Pavlov, "LZMA
// specification", 2015), with likelihoods of sixteen bits that are the mean of one that learns fast and one
// that learns well. Private to assets/recording.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace flaneur {

// How likely a bit is 0, of 65,536.
struct Odds {
    uint16_t fast = 1 << 15, slow = 1 << 15;

    uint32_t of_zero() const { return (uint32_t{fast} + slow) >> 5; }  // of 4,096: 0 .. 4,095
    void learn(bool bit) {
        fast = static_cast<uint16_t>(bit ? fast - (fast >> 4) : fast + ((65535 - fast) >> 4));
        slow = static_cast<uint16_t>(bit ? slow - (slow >> 7) : slow + ((65535 - slow) >> 7));
    }
};

inline uint32_t share_of(uint32_t range, const Odds& odds) {
    return (range >> 12) * (odds.of_zero() < 31 ? 31 : odds.of_zero() > 4065 ? 4065 : odds.of_zero());
}

// Appends to `bytes`; finish() puts what is still held back.
struct BitWriter {
    std::string& bytes;
    uint64_t low = 0;
    uint32_t range = ~0u;
    uint64_t held = 1;  // bytes that a carry may change yet
    uint8_t first = 0;  // of those, before 0xff's

    void put(Odds& odds, bool bit) {
        const uint32_t share = share_of(range, odds);
        if (bit) {
            low += share;
            range -= share;
        } else {
            range = share;
        }
        odds.learn(bit);
        while (range < 1u << 24) shift();
    }
    // The last `count` bits of a value, all as likely; the highest first.
    void put_even(uint32_t value, int count) {
        while (count-- > 0) {
            range >>= 1;
            if (value >> count & 1) low += range;
            while (range < 1u << 24) shift();
        }
    }
    void finish() {
        for (int i = 0; i < 5; ++i) shift();
    }

  private:
    void shift() {
        if (low < 0xff000000u || low >> 32) {
            const auto carry = static_cast<uint8_t>(low >> 32);
            for (uint8_t next = first; held > 0; --held, next = 0xff)
                bytes.push_back(static_cast<char>(next + carry));
            first = static_cast<uint8_t>(low >> 24);
        }
        ++held;
        range <<= 8;
        low = (low & 0x00ffffff) << 8;
    }
};

// Of what BitWriter wrote; behind its end there are zeros.
struct BitReader {
    std::string_view bytes;
    size_t at = 0;
    uint32_t range = ~0u, code = 0;

    explicit BitReader(std::string_view from) : bytes(from) {
        for (int i = 0; i < 5; ++i) code = code << 8 | next();
    }
    bool get(Odds& odds) {
        const uint32_t share = share_of(range, odds);
        const bool bit = code >= share;
        if (bit) {
            code -= share;
            range -= share;
        } else {
            range = share;
        }
        odds.learn(bit);
        fill();
        return bit;
    }
    uint32_t get_even(int count) {
        uint32_t value = 0;
        while (count-- > 0) {
            range >>= 1;
            const bool bit = code >= range;
            if (bit) code -= range;
            value = value << 1 | bit;
            fill();
        }
        return value;
    }

  private:
    uint32_t next() { return at < bytes.size() ? static_cast<uint8_t>(bytes[at++]) : 0; }
    void fill() {
        while (range < 1u << 24) {
            range <<= 8;
            code = code << 8 | next();
        }
    }
};

}  // namespace flaneur
