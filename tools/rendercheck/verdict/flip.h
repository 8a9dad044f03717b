// How different two pictures look to somebody who flips between them: LDR-FLIP of Andersson et al., FLIP: A
// Difference Evaluator for Alternating Images (High-Performance Graphics 2020), and HDR-FLIP of the same,
// Visualizing Errors in Rendered High Dynamic Range Images (Eurographics 2021).
#pragma once

#include <cstdint>
#include <vector>

namespace flaneur {

// Of a screen 0.7 m wide with 3840 pixels, seen from 0.7 m.
inline constexpr float k_pixels_per_degree = 67;

// The error of each pixel, rows from the top: 0 none .. 1 black against white, or as bad. `a` and `b` are
// RGBA in sRGB, alpha not read, of the same size, at least one pixel.
std::vector<float> flip(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int width,
                        float pixels_per_degree = k_pixels_per_degree);

double mean_flip(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, int width,
                 float pixels_per_degree = k_pixels_per_degree);

double mean_of(const std::vector<float>& errors);

// Stops between which a picture of linear light shows its brightest (start) and its middle (stop) well, and
// how many are looked at.
struct Exposures {
    float start = 0, stop = 0;
    int count = 0;
};
Exposures exposures_of(const std::vector<float>& reference);

// The same of linear RGBA: the worst of each pixel over the exposures of the reference, tone-mapped by ACES.
// What is negative or no number is black.
std::vector<float> hdr_flip(const std::vector<float>& reference, const std::vector<float>& other, int width,
                            float pixels_per_degree = k_pixels_per_degree);

}  // namespace flaneur
