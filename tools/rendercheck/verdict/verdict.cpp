#include "tools/rendercheck/verdict/verdict.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "tools/rendercheck/verdict/boxes.h"
#include "tools/rendercheck/verdict/flip.h"

namespace flaneur {
namespace {

float channel_difference(float a, float b) {
    if (a == b) return 0;
    const bool a_is_none = std::isnan(a), b_is_none = std::isnan(b);
    if (a_is_none && b_is_none) return 0;
    if (a_is_none || b_is_none || std::isinf(a) || std::isinf(b)) return 255;
    const float by = std::max({1.0f, std::fabs(a), std::fabs(b)});
    return std::fabs(a / by - b / by) * 255;
}

std::vector<float> differences_of(const CheckedPicture& a, const CheckedPicture& b) {
    std::vector<float> out(a.rgba.size() / 4, 0.0f);
    for (size_t i = 0; i < a.rgba.size(); ++i) {
        const float difference = a.deep.empty()
                                     ? static_cast<float>(std::abs(int{a.rgba[i]} - int{b.rgba[i]}))
                                     : channel_difference(a.deep[i], b.deep[i]);
        out[i / 4] = std::max(out[i / 4], difference);
    }
    return out;
}

bool is_finite_in_one_alone(const CheckedPicture& a, const CheckedPicture& b, size_t pixel) {
    if (a.deep.empty()) return false;
    for (size_t i = 4 * pixel; i < 4 * pixel + 4; ++i)
        if (std::isfinite(a.deep[i]) != std::isfinite(b.deep[i])) return true;
    return false;
}

// Which pixels count.
std::vector<uint8_t> counting(const CheckedPicture& picture, const MayDiffer& may_differ) {
    std::vector<uint8_t> counts(picture.rgba.size() / 4, 1);
    if (may_differ.mask)
        for (size_t i = 0; i < counts.size(); ++i) {
            const uint8_t* mask = &may_differ.mask->rgba[4 * i];
            if (mask[0] + mask[1] + mask[2] > 3 * 127) counts[i] = 0;
        }
    for (const PixelBox& box : may_differ.ignored) {
        const int right = std::min(box.left + box.width, picture.width);
        const int bottom = std::min(box.top + box.height, picture.height);
        for (int y = std::max(box.top, 0); y < bottom; ++y)
            for (int x = std::max(box.left, 0); x < right; ++x)
                counts[static_cast<size_t>(y) * static_cast<size_t>(picture.width) + static_cast<size_t>(x)] =
                    0;
    }
    return counts;
}

std::array<double, 4> channels_at(const CheckedPicture& picture, size_t pixel) {
    std::array<double, 4> out;
    for (size_t c = 0; c < 4; ++c) {
        const size_t i = 4 * pixel + c;
        out[c] = picture.precision == Precision::floats    ? double{picture.deep[i]}
                 : picture.precision == Precision::sixteen ? double{picture.deep[i]} * 255
                                                           : static_cast<double>(picture.rgba[i]);
    }
    return out;
}

std::string number(double value, const char* format = "%.3g") {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

void give_reasons(Judgement& out, const Tolerance& tolerance) {
    auto beyond = [](size_t count, double share, size_t pixels) {
        return static_cast<double>(count) > share * static_cast<double>(pixels);
    };
    if (out.no_numbers > 0)
        out.reasons.push_back(std::to_string(out.no_numbers) +
                              " pixels are no numbers, or infinite, in one of the two alone, and none may.");
    if (beyond(out.differing, tolerance.differing, out.pixels))
        out.reasons.push_back(std::to_string(out.differing) + " pixels differ (" +
                              told_share(out.differing, out.pixels) + "), and " +
                              number(tolerance.differing * 100) + " % may.");
    if (beyond(out.over, tolerance.over, out.pixels))
        out.reasons.push_back(std::to_string(out.over) + " pixels differ by more than " +
                              number(tolerance.step) + "/255 (" + told_share(out.over, out.pixels) +
                              "), and " + number(tolerance.over * 100) + " % may.");
    if (out.densest > tolerance.in_window)
        out.reasons.push_back(std::to_string(out.densest) + " pixels differ by more than " +
                              number(tolerance.step) + "/255 within 16x16 pixels at " +
                              std::to_string(out.densest_window.left) + "," +
                              std::to_string(out.densest_window.top) + ", and " +
                              std::to_string(tolerance.in_window) + " may.");
    if (out.mean_flip > tolerance.flip)
        out.reasons.push_back("Mean FLIP is " + number(out.mean_flip) + ", and may be " +
                              number(tolerance.flip) + ".");
}

Judgement refused(std::string reason) {
    Judgement out;
    out.reasons.push_back(std::move(reason));
    return out;
}

}  // namespace

Judgement judge(const CheckedPicture& picture, const CheckedPicture& reference, const Tolerance& tolerance,
                const MayDiffer& may_differ) {
    if (picture.width != reference.width || picture.height != reference.height)
        return refused("It has " + told_size(picture) + " pixels, and the reference has " +
                       told_size(reference) + ".");
    if (picture.precision != reference.precision)
        return refused(std::string("It has ") + told_precision(picture.precision) +
                       ", and the reference has " + told_precision(reference.precision) + ".");
    if (may_differ.mask && told_size(*may_differ.mask) != told_size(reference))
        return refused("The mask has " + told_size(*may_differ.mask) + " pixels, and the picture has " +
                       told_size(reference) + ".");
    Judgement out;
    out.differences = differences_of(picture, reference);
    const std::vector<uint8_t> counts = counting(picture, may_differ);
    size_t worst = 0;
    for (size_t i = 0; i < counts.size(); ++i) {
        if (!counts[i]) {
            out.differences[i] = 0;
            continue;
        }
        ++out.pixels;
        const double difference = double{out.differences[i]};
        if (difference > out.worst) out.worst = difference, worst = i;
        if (difference > 0) ++out.differing;
        if (is_finite_in_one_alone(picture, reference, i)) ++out.no_numbers;
        if (difference > tolerance.step) ++out.over;
        for (size_t t = 0; t < k_thresholds.size(); ++t)
            if (difference > k_thresholds[t]) ++out.beyond[t];
    }
    if (out.differing == 0) {
        out.is_equal = out.passes = true;
        out.differences.clear();
        return out;
    }
    const auto width = static_cast<size_t>(picture.width);
    out.worst_x = static_cast<int>(worst % width), out.worst_y = static_cast<int>(worst / width);
    out.worst_new = channels_at(picture, worst), out.worst_reference = channels_at(reference, worst);
    out.limit = out.over > 0 ? static_cast<float>(tolerance.step) : 0.0f;
    if (out.over > 0)
        out.densest = densest_window(out.differences, picture.width, out.limit, k_window, out.densest_window);
    out.boxes = changed_boxes(out.differences, picture.width, out.limit, out.more_boxes);
    out.flip = picture.precision == Precision::floats ? hdr_flip(reference.deep, picture.deep, picture.width)
                                                      : flip(reference.rgba, picture.rgba, picture.width);
    double sum = 0;
    for (size_t i = 0; i < counts.size(); ++i) {
        if (!counts[i]) out.flip[i] = 0;
        sum += double{out.flip[i]};
        out.max_flip = std::max(out.max_flip, double{out.flip[i]});
    }
    out.mean_flip = sum / static_cast<double>(out.pixels);
    give_reasons(out, tolerance);
    out.passes = out.reasons.empty();
    return out;
}

std::string told_share(size_t part, size_t whole) {
    if (part == 0 || whole == 0) return "0 %";
    return number(100 * static_cast<double>(part) / static_cast<double>(whole)) + " %";
}

}  // namespace flaneur
