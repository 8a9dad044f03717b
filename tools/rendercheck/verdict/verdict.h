// Whether a picture is the one that it should be: equal, or so near that nobody sees a difference and nothing
// small is missing.
//
// Shares of the whole picture do not see one walker missing far away, so there is a limit for each place too:
// the densest window of 16x16 pixels, wherever it lies.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/rendercheck/picture/picture.h"

namespace flaneur {

// In pixels, from the left and the top.
struct PixelBox {
    int left = 0, top = 0, width = 0, height = 0;
};

// All of it must hold where pictures are not equal.
struct Tolerance {
    double differing = 0.001;  // share of pixels that may differ at all
    double over = 0.0002;      // share of those that may differ by more than `step`
    double step = 2;           // 255ths of a channel
    int in_window = 16;        // pixels over `step` in any window of 16x16
    double flip = 1;           // mean FLIP; 1: it is told and does not judge
};

inline constexpr int k_window = 16;  // pixels, each way
// Differences, in 255ths, beyond which pixels are counted.
inline constexpr std::array<int, 8> k_thresholds = {0, 1, 2, 4, 8, 16, 64, 128};

struct ChangedBox {
    PixelBox box;
    size_t pixels = 0;  // that differ within it, over the tolerance's step if any do
};

struct Judgement {
    bool is_equal = false;  // every pixel that counts
    bool passes = false;
    std::vector<std::string> reasons;  // why not, a sentence each
    size_t pixels = 0;                 // that count: all but those that may differ
    size_t differing = 0, over = 0;
    size_t no_numbers =
        0;            // of floats, where one of the two has no number, or infinity, and the other has one
    float limit = 0;  // boxes hold what differs by more: the step, or 0 where nothing does
    std::array<size_t, k_thresholds.size()> beyond{};
    double worst = 0;  // difference in 255ths, of the worst channel of the worst pixel
    int worst_x = 0, worst_y = 0;
    std::array<double, 4> worst_new{}, worst_reference{};  // its channels, in 255ths, or as floats are
    int densest = 0;                                       // pixels over the step in the densest window
    PixelBox densest_window;
    std::vector<ChangedBox> boxes;  // of what changed, most pixels first, 24 at most
    size_t more_boxes = 0;
    double mean_flip = 0, max_flip = 0;
    std::vector<float> differences;  // of each pixel, 255ths; empty where they are equal
    std::vector<float> flip;         // of each pixel, the same
};

// Pixels that may differ: where `mask` is lighter than half, and in `ignored`.
struct MayDiffer {
    std::optional<CheckedPicture> mask;
    std::vector<PixelBox> ignored;
};

// How much channels differ: of sRGB in 255ths; of floats the same where they are at most 1, and a share of
// the larger beyond, so that noise in a lamp weighs no more than noise in a wall. What is no number differs
// by 255 from what is, and where only one of the two has a number, no tolerance covers it. Pictures of
// different sizes or precisions do not pass, and are not looked at further. A mask of another size than the
// reference is a reason too.
Judgement judge(const CheckedPicture& picture, const CheckedPicture& reference, const Tolerance& tolerance,
                const MayDiffer& may_differ = {});

// "0.41 %"; "0 %" is none.
std::string told_share(size_t part, size_t whole);

}  // namespace flaneur
