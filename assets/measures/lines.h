// Who crosses a line, and who passes the area beside one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assets/measures/moments.h"
#include "assets/measures/tracks.h"

namespace flaneur {

struct MeasuredLine {
    Vec2 a, b;  // its left is that of who stands at `a` and looks to `b`
};

// A crossing is where somebody was last on one side and is now on the other, having gone through the line
// between its ends; who stands on the line has not crossed it yet. The frame is the first one beyond it
// (PedPy: compute_crossing_frames, which counts who touches it and goes back, too).
struct LineCrossed {
    uint32_t frame = 0, id = 0;
    double frames = 0;  // when, to the fraction of a frame
    bool to_left = false;
    Vec2 at;
    uint32_t sighting = 0;  // that of the frame
};
// By frame, then by id; all of each person's.
std::vector<LineCrossed> line_crossings(const TrackTable& table, const MeasuredLine& line, FrameRange range);
// Each person's first one alone, as an N-t curve has them (PedPy: compute_n_t).
std::vector<LineCrossed> first_crossings(std::span<const LineCrossed> crossings);

// Method A: flow over so many frames. The first interval begins with the first crossing; each ends with the
// last one of `delta` frames, and the next begins there. J = N / t (PedPy: compute_flow). Speeds are those of
// who crosses, as `speeds` has them in the frame of the crossing.
struct FlowInterval {
    uint32_t first = 0, last = 0;  // frames
    uint32_t people = 0;
    double flow = 0;        // people a second
    double mean_speed = 0;  // m/s; NaN: not known
};
std::vector<FlowInterval> flow_intervals(std::span<const LineCrossed> crossings,
                                         std::span<const float> speeds, uint32_t delta, uint32_t last_frame,
                                         float fps);

// Method B: those who go through the area between a line and its like `width` metres to its left, in by one
// of them and out by the other, without leaving it between (PedPy: compute_frame_range_in_area,
// compute_passing_speed, compute_passing_density).
struct PassedThrough {
    uint32_t id = 0;
    uint32_t entered = 0, left = 0;  // the first frame inside, and the first one that is not any more
    double speed = 0;                // width over the time from one to the other, m/s
    double density = 0;              // mean over that time of how many are in the area, over its size, 1/m2
};
// By id, then by frame. The area is that of `area_beside`.
std::vector<PassedThrough> passages(const TrackTable& table, const MeasuredLine& line, float width,
                                    FrameRange range);
std::vector<Vec2> area_beside(const MeasuredLine& line, float width);

}  // namespace flaneur
