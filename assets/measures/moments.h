// Density, speed and flow in a measurement area, frame by frame, and what they tell of each other.
//
// Methods are named as by J. Zhang, W. Klingsch, A. Schadschneider, A. Seyfried, Transitions in pedestrian
// fundamental diagrams of straight corridors and T-junctions, J. Stat. Mech. P06004, 2011: A by crossings of
// a line, B by passages of an area (both in lines.h), C by who is in an area, D by Voronoi cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/measures/tracks.h"
#include "assets/measures/voronoi.h"
#include "sim/base/parallel_for.h"

namespace flaneur {

// A(M) is how much of the area is walkable. PedPy takes all of it: the same where no wall stands in it.
struct AreaMoment {
    uint32_t frame = 0;
    uint32_t people = 0;       // N, in the area
    double classic = 0;        // N / A(M), people to a square metre (C; compute_classic_density)
    double voronoi = 0;        // sum of A(V_i and M) / A(V_i), over A(M) (D; compute_voronoi_density)
    double mean_speed = 0;     // of those inside, m/s (C; compute_mean_speed_per_frame); NaN: nobody is
    double voronoi_speed = 0;  // sum of v_i A(V_i and M), over A(M), m/s (D; compute_voronoi_speed)
    double covered = 0;        // sum of A(V_i and M), over A(M): what of the area anybody's cell has
};
// The speed of those whose cells reach in, each by how much of the area it has; NaN: none does. PedPy's
// voronoi_speed counts what nobody has as speed 0.
inline double speed_where_covered(const AreaMoment& moment) { return moment.voronoi_speed / moment.covered; }

// Of each frame of the range in which anybody is anywhere. `area` and `ground` are made with the same
// cut-off. `speeds` has one a sighting; whose is NaN counts for density, and not for speed.
std::vector<AreaMoment> area_moments(const TrackTable& table, const MeasuredArea& area,
                                     const CellGround& ground, std::span<const float> speeds,
                                     FrameRange range, Workers& workers);

// One a sighting; area 0: no cell.
struct PersonalSpace {
    float area = 0;     // of the cell, square metres; 1 / area is PedPy's individual density
    float nearest = 0;  // metres to whoever is nearest, neighbour or not; infinite: nobody else is there
    uint32_t neighbours = 0;  // whose cells share an edge with it (compute_neighbors),
    float mean_distance = 0;  // and how far they are off, on average (compute_neighbor_distance)
};
std::vector<PersonalSpace> personal_spaces(const TrackTable& table, const CellGround& ground,
                                           FrameRange range, Workers& workers);

// A fundamental diagram: density, speed, and flow through a metre of width as density times speed, of moments
// whose densities lie between `from` and `from + step`.
struct FundamentalBin {
    double from = 0;
    size_t moments = 0;
    double density = 0, speed = 0, flow = 0;  // means; 1/m2, m/s, 1/(m s)
    double speed_spread = 0;                  // standard deviation, m/s
};
enum class DensityMethod : uint8_t { classic, voronoi };  // C and D
struct FundamentalPoint {
    double density = 0, speed = 0;
};
// Of moments when anybody is in the area, or by cells has some of it; with speeds as speed_where_covered().
std::vector<FundamentalPoint> fundamental_points(std::span<const AreaMoment> moments, DensityMethod method);
// Rising; empty bins are left out.
std::vector<FundamentalBin> fundamental_bins(std::span<const FundamentalPoint> points, double step);

// U. Weidmann, Transporttechnik der Fussgaenger, 1993: m/s at so many people to a square metre.
double weidmann_speed(double density);

// Somebody's stay in an area without a gap: from the first frame inside to the last one. Who is seen inside
// in every frame from a to b stays (b - a + 1) / fps seconds.
struct Sojourn {
    uint32_t id = 0, first = 0, last = 0;
};
// By person, then by frame.
std::vector<Sojourn> sojourns(const TrackTable& table, const MeasuredArea& area, FrameRange range);
double seconds_of(const Sojourn& sojourn, float fps);

}  // namespace flaneur
