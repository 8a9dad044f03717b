// Trajectories by frame and by person, and how people move in them: for each sighting its velocity, speed and
// acceleration. What is not known is NaN.
//
// Frames are as files number them. A window is of frames, not of rows: who is not seen in a frame of it is at
// the end of what is known of them there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assets/trajectories/trajectories.h"

namespace flaneur {

// An index; `of` outlives it and stays as it is.
struct TrackTable {
    const Trajectories* of = nullptr;
    std::vector<uint32_t> frames = {};  // those in which anybody is, rising
    std::vector<uint32_t> begins = {};  // the first sighting of each, and last how many sightings there are
    std::vector<uint32_t> ids = {};     // of the people, rising
    std::vector<uint32_t> firsts =
        {};  // where in `by_person` each begins, and last how many sightings there are
    std::vector<uint32_t> by_person = {};  // sightings, a person after the other, by frame
    std::vector<uint32_t> ranks = {};      // where in `by_person` each sighting is
};
TrackTable track_table(const Trajectories& trajectories);

// Who is in frames[k].
std::span<const Sighting> seen_in(const TrackTable& table, size_t k);
// Sightings of the person ids[k], by frame.
std::span<const uint32_t> sightings_of(const TrackTable& table, size_t k);
// Of the same person, so many frames later, or earlier.
std::optional<uint32_t> later(const TrackTable& table, uint32_t sighting, int64_t frames);
// Both ends belong to it.
struct FrameRange {
    uint32_t first = 0, last = ~0u;
};
// Which of frames[] lie in a range: from the first of the pair to before the second.
std::pair<size_t, size_t> frames_in(const TrackTable& table, FrameRange range);

// What becomes of a window that is not all there (PedPy's SpeedCalculation):
enum class AtEnds : uint8_t {
    exclude,       // no speed
    adaptive,      // as many frames on both sides as there are
    single_sided,  // the half that is there, if one is
};

// (X(t + n) - X(t - n)) / (2 n / fps), n = `step` frames, metres a second; one a sighting. PedPy:
// compute_individual_speed.
std::vector<Vec2> velocities(const TrackTable& table, uint32_t step, AtEnds ends);
std::vector<float> speeds_of(std::span<const Vec2> velocities);
// v . d / |d|: below 0 for who goes the other way.
std::vector<float> speeds_along(std::span<const Vec2> velocities, Vec2 direction);

// (X(t + 2n) - 2 X(t) + X(t - 2n)) / (2 n / fps)^2, m/s^2, of the frame in the middle; one a sighting, none
// where the window is not all there. As PedPy's documentation has compute_individual_acceleration; its code
// of 2026 takes windows half as long, and gives them to their last frame.
std::vector<Vec2> accelerations(const TrackTable& table, uint32_t step);

}  // namespace flaneur
