#include "tools/rendercheck/verdict/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/glm.hpp>
#include <numeric>

namespace flaneur {

namespace {

using Plane = std::vector<float>;

constexpr float k_pi = 3.14159265f;
// Linear sRGB to XYZ, by columns; the white of D65.
const glm::mat3 k_xyz_from_rgb(0.41238656f, 0.21263682f, 0.01933062f, 0.35759149f, 0.71518298f, 0.11919716f,
                               0.18045049f, 0.07218020f, 0.95037259f);
const glm::vec3 k_white(0.950428545f, 1.0f, 1.088900371f);

// A picture by channels.
struct Channels {
    std::array<Plane, 3> planes;
    glm::vec3 at(size_t i) const { return {planes[0][i], planes[1][i], planes[2][i]}; }
    void set(size_t i, glm::vec3 v) {
        for (int c = 0; c < 3; ++c) planes[static_cast<size_t>(c)][i] = v[c];
    }
};

float linear_from_srgb(uint8_t value) {
    const float s = static_cast<float>(value) / 255;
    return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

// Opponent colours: lightness, red against green, blue against yellow.
glm::vec3 ycxcz_from_xyz(glm::vec3 xyz) {
    const glm::vec3 v = xyz / k_white;
    return {116 * v.y - 16, 500 * (v.x - v.y), 200 * (v.y - v.z)};
}

glm::vec3 xyz_from_ycxcz(glm::vec3 c) {
    const float y = (c.x + 16) / 116;
    return glm::vec3(y + c.y / 500, y, y - c.z / 200) * k_white;
}

// CIELAB, its colours weaker where it is dark, as Hunt observed.
glm::vec3 hunt_lab_from_xyz(glm::vec3 xyz) {
    constexpr float delta = 6.0f / 29;
    auto curve = [](float t) {
        return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29;
    };
    const glm::vec3 v = xyz / k_white;
    const float y = curve(v.y), lightness = 116 * y - 16;
    return {lightness, 0.01f * lightness * 500 * (curve(v.x) - y),
            0.01f * lightness * 200 * (y - curve(v.z))};
}

float hyab(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 d = a - b;
    return std::fabs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

// Along rows, and then along columns; pixels at the border go on beyond it.
Plane convolve(const Plane& in, int width, const Plane& across, const Plane& down) {
    const int height = static_cast<int>(in.size()) / width;
    auto pass = [&](const Plane& from, const Plane& weights, int count, int lines, int step, int line_step) {
        const int reach = static_cast<int>(weights.size()) / 2;
        Plane out(from.size());
        for (int line = 0; line < lines; ++line)
            for (int i = 0; i < count; ++i) {
                float sum = 0;
                for (int k = -reach; k <= reach; ++k)
                    sum +=
                        weights[static_cast<size_t>(k + reach)] *
                        from[static_cast<size_t>(line * line_step + std::clamp(i + k, 0, count - 1) * step)];
                out[static_cast<size_t>(line * line_step + i * step)] = sum;
            }
        return out;
    };
    return pass(pass(in, across, width, height, 1, width), down, height, width, width, 1);
}

// exp(-x^2 / spread) at whole pixels, and their sum taken out.
struct Bell {
    Plane weights;
    float sum = 0;
};

Bell bell(int reach, float spread) {
    Bell out;
    for (int k = -reach; k <= reach; ++k)
        out.weights.push_back(std::exp(-static_cast<float>(k * k) / spread));
    out.sum = std::accumulate(out.weights.begin(), out.weights.end(), 0.0f);
    for (float& w : out.weights) w /= out.sum;
    return out;
}

// As the eye blurs each of the opponent colours.
Channels blurred(const Channels& in, int width, float pixels_per_degree) {
    struct Gauss {
        float a, b;
    };
    constexpr Gauss k_sensitivity[3][2] = {
        {{1, 0.0047f}, {0, 0}}, {{1, 0.0053f}, {0, 0}}, {{34.1f, 0.04f}, {13.5f, 0.025f}}};
    const int reach =
        static_cast<int>(std::ceil(3 * std::sqrt(0.04f / (2 * k_pi * k_pi)) * pixels_per_degree));
    Channels out;
    for (size_t c = 0; c < 3; ++c) {
        Plane& sum = out.planes[c];
        sum.assign(in.planes[c].size(), 0);
        float total = 0;
        for (const Gauss& g : k_sensitivity[c]) {
            if (g.a == 0) continue;
            const Bell one = bell(reach, g.b * pixels_per_degree * pixels_per_degree / (k_pi * k_pi));
            const float share = g.a * std::sqrt(k_pi / g.b) * one.sum * one.sum;
            const Plane part = convolve(in.planes[c], width, one.weights, one.weights);
            for (size_t i = 0; i < sum.size(); ++i) sum[i] += share * part[i];
            total += share;
        }
        for (float& v : sum) v /= total;
    }
    return out;
}

// How strong edges and points are about each pixel.
struct Features {
    Plane edges, points;
};

Features find_features(const Channels& in, int width, float pixels_per_degree) {
    constexpr float k_width = 0.082f;  // of an edge, degrees
    const float deviation = 0.5f * k_width * pixels_per_degree;
    const int reach = static_cast<int>(std::ceil(3 * deviation));
    const Plane smooth = bell(reach, 2 * deviation * deviation).weights;
    Plane slope, bend;
    for (int k = -reach; k <= reach; ++k) {
        const float x = static_cast<float>(k), g = smooth[static_cast<size_t>(k + reach)];
        slope.push_back(-x * g);
        bend.push_back((x * x / (deviation * deviation) - 1) * g);
    }
    for (Plane* weights : {&slope, &bend}) {
        float above = 0, below = 0;
        for (float w : *weights) (w > 0 ? above : below) += std::fabs(w);
        for (float& w : *weights) w /= w > 0 ? above : below;
    }
    Plane light = in.planes[0];
    for (float& v : light) v = (v + 16) / 116;
    auto magnitude = [&](const Plane& filter) {
        Plane out = convolve(light, width, filter, smooth);
        const Plane down = convolve(light, width, smooth, filter);
        for (size_t i = 0; i < out.size(); ++i) out[i] = std::sqrt(out[i] * out[i] + down[i] * down[i]);
        return out;
    };
    return {magnitude(slope), magnitude(bend)};
}

// A picture as it is compared.
struct Perceived {
    Channels lab;  // blurred
    Features features;
};

// `rgb`: linear, 0 .. 1.
Perceived see(const Channels& rgb, int width, float pixels_per_degree) {
    const size_t count = rgb.planes[0].size();
    Channels opponents;
    for (Plane& plane : opponents.planes) plane.resize(count);
    for (size_t i = 0; i < count; ++i) opponents.set(i, ycxcz_from_xyz(k_xyz_from_rgb * rgb.at(i)));
    Perceived seen{blurred(opponents, width, pixels_per_degree),
                   find_features(opponents, width, pixels_per_degree)};
    const glm::mat3 rgb_from_xyz = glm::inverse(k_xyz_from_rgb);
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 blurred_rgb = rgb_from_xyz * xyz_from_ycxcz(seen.lab.at(i));
        seen.lab.set(i, hunt_lab_from_xyz(k_xyz_from_rgb * glm::clamp(blurred_rgb, 0.0f, 1.0f)));
    }
    return seen;
}

std::vector<float> compare(const Perceived& one, const Perceived& other) {
    constexpr float k_power = 0.7f, k_knee = 0.4f, k_at_knee = 0.95f;
    const float most = std::pow(hyab(hunt_lab_from_xyz(k_xyz_from_rgb * glm::vec3(0, 1, 0)),
                                     hunt_lab_from_xyz(k_xyz_from_rgb * glm::vec3(0, 0, 1))),
                                k_power);
    const float knee = k_knee * most;
    std::vector<float> errors(one.features.edges.size());
    for (size_t i = 0; i < errors.size(); ++i) {
        const float raw = std::pow(hyab(one.lab.at(i), other.lab.at(i)), k_power);
        const float colour =
            raw < knee ? raw * k_at_knee / knee : k_at_knee + (raw - knee) / (most - knee) * (1 - k_at_knee);
        const float edge = std::fabs(one.features.edges[i] - other.features.edges[i]);
        const float point = std::fabs(one.features.points[i] - other.features.points[i]);
        const float feature = std::sqrt(std::max(edge, point) / std::sqrt(2.0f));
        errors[i] = std::pow(std::min(colour, 1.0f), 1 - std::min(feature, 1.0f));
    }
    return errors;
}

Channels linear_of(const std::vector<uint8_t>& rgba) {
    std::array<float, 256> linear;
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = linear_from_srgb(static_cast<uint8_t>(i));
    Channels out;
    for (Plane& plane : out.planes) plane.resize(rgba.size() / 4);
    for (size_t i = 0; i < rgba.size() / 4; ++i)
        out.set(i, {linear[rgba[4 * i]], linear[rgba[4 * i + 1]], linear[rgba[4 * i + 2]]});
    return out;
}

// The tone curve of ACES as K. Narkowicz fitted it, (a x^2 + b x + c) / (d x^2 + e x + f), without the
// exposure that it comes with.
struct ToneCurve {
    float a = 0.6f * 0.6f * 2.51f, b = 0.6f * 0.03f, c = 0, d = 0.6f * 0.6f * 2.43f, e = 0.6f * 0.59f,
          f = 0.14f;
    float operator()(float x) const { return (a * x * x + b * x + c) / (d * x * x + e * x + f); }
    // Where it reaches y.
    float inverse(float y) const {
        const float p = (b - y * e) / (a - y * d), q = (c - y * f) / (a - y * d);
        return -p / 2 + std::sqrt(p * p / 4 - q);
    }
};

Channels exposed(const std::vector<float>& rgba, float exposure) {
    const ToneCurve tone;
    const float scale = std::exp2(exposure);
    Channels out;
    for (Plane& plane : out.planes) plane.resize(rgba.size() / 4);
    for (size_t i = 0; i < rgba.size() / 4; ++i)
        for (size_t c = 0; c < 3; ++c) {
            // So bright that the curve is level, before its squares are too large to tell.
            const float value = std::min(rgba[4 * i + c] * scale, 1e9f);
            out.planes[c][i] = value > 0 ? std::clamp(tone(value), 0.0f, 1.0f) : 0;
        }
    return out;
}

}  // namespace

std::vector<float> flip(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int width,
                        float pixels_per_degree) {
    assert(width > 0 && !a.empty() && a.size() == b.size() && a.size() / 4 % static_cast<size_t>(width) == 0);
    return compare(see(linear_of(a), width, pixels_per_degree), see(linear_of(b), width, pixels_per_degree));
}

double mean_flip(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int width,
                 float pixels_per_degree) {
    return mean_of(flip(a, b, width, pixels_per_degree));
}

double mean_of(const std::vector<float>& errors) {
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

Exposures exposures_of(const std::vector<float>& reference) {
    constexpr float k_bright = 0.85f;  // as bright as a screen should show what matters
    std::vector<float> luminances;
    for (size_t i = 0; i < reference.size(); i += 4) {
        const float y = 0.2126f * reference[i] + 0.7152f * reference[i + 1] + 0.0722f * reference[i + 2];
        luminances.push_back(std::isfinite(y) && y > 0 ? y : 0);
    }
    const auto median = luminances.begin() + static_cast<ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), median, luminances.end());
    const float most = *std::max_element(luminances.begin(), luminances.end());
    if (most <= 0) return {0, 0, 2};
    const float shown = ToneCurve().inverse(k_bright);
    Exposures out{std::log2(shown / most), 0, 0};
    // Where half of it is black there is no median to show.
    out.stop = *median > 0 ? std::log2(shown / *median) : out.start;
    out.count = std::min(std::max(2, static_cast<int>(std::ceil(out.stop - out.start))), 40);
    return out;
}

std::vector<float> hdr_flip(const std::vector<float>& reference, const std::vector<float>& other, int width,
                            float pixels_per_degree) {
    assert(width > 0 && !reference.empty() && reference.size() == other.size());
    const Exposures exposures = exposures_of(reference);
    std::vector<float> worst(reference.size() / 4, 0.0f);
    for (int n = 0; n < exposures.count; ++n) {
        const float exposure = exposures.start + (exposures.stop - exposures.start) * static_cast<float>(n) /
                                                     static_cast<float>(exposures.count - 1);
        const std::vector<float> errors = compare(see(exposed(reference, exposure), width, pixels_per_degree),
                                                  see(exposed(other, exposure), width, pixels_per_degree));
        for (size_t i = 0; i < worst.size(); ++i) worst[i] = std::max(worst[i], errors[i]);
    }
    return worst;
}

}  // namespace flaneur
