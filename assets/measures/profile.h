// Fields over the ground: density, speed and flow of people on a grid of squares, as means over frames
// (PedPy: compute_profiles, which has them frame by frame).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/measures/tracks.h"
#include "assets/measures/voronoi.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

// Squares in rows from north to south, as a map is read: that of column c and row r has its north-west corner
// at low + square * (c, r). A square counts whole, whatever walls take of it.
struct ProfileGrid {
    Vec2 low;          // metres
    float square = 0;  // its side, metres
    int columns = 0, rows = 0;
};
inline constexpr int k_most_field_squares = 4'000'000;
// That covers a rectangle from its north-west corner on.
ProfileGrid profile_grid(const Rectangle& area, float square);
inline size_t count_of(const ProfileGrid& grid) {
    return static_cast<size_t>(grid.columns) * static_cast<size_t>(grid.rows);
}

enum class FieldMethod : uint8_t {
    classic,   // N / square^2, and the mean of v_i of those in the square (CLASSIC, MEAN)
    voronoi,   // by parts of cells, as AreaMoment has them of an area (VORONOI)
    gaussian,  // everybody is a normal distribution about where they are (GAUSSIAN)
};
// The full width at half maximum of what `gaussian` makes of one; sigma = width / (2 sqrt(2 ln 2)), metres.
inline constexpr float k_gaussian_width = 0.5f;

// A value a square. Means over frames of density, people to a square metre, and of flow, density times speed,
// 1/(m s). Speed is the mean of those who were there, m/s, each by how long and with how much of the square
// (by Gaussians: with what weight at its middle): NaN where nobody was.
struct Profiles {
    ProfileGrid grid;
    size_t frames = 0;  // of which it is
    std::vector<float> density = {}, speed = {}, flow = {};
};
// Of every `every`th frame of the range in which anybody is anywhere. `speeds` has one a sighting; whose is
// NaN counts for density alone.
struct ProfileOf {
    FieldMethod method = FieldMethod::voronoi;
    float gaussian_width = k_gaussian_width;
    FrameRange range;
    uint32_t every = 1;
};
Profiles profiles_of(const TrackTable& table, const CellGround& ground, std::span<const float> speeds,
                     const ProfileGrid& grid, const ProfileOf& what, Workers& workers);

}  // namespace flaneur
