// Sixteen walkers who decide where to go, side by side, and the kernels that do it for all of them at once.
// Private to sim/crowd.
#pragma once

#include "sim/base/block.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/half_planes.h"

namespace flaneur {

inline constexpr float k_horizon = 1.5f;  // seconds within which no one shall be met
inline constexpr float k_margin = 0.06f;  // metres kept between bodies
inline constexpr float k_depth = 0.8f;    // of a body from front to back, against its width
// Seconds that a walker needs to cover the gap ahead: to those who go the same way, if it has been held up,
// and to those who do not.
inline constexpr float k_headway = 1, k_hurried_headway = 0.3f, k_meeting_headway = 0.45f;
// How far to either side a body is ahead, of the width of both; and to one who has been held up.
inline constexpr float k_swath = 0.6f, k_hurried_swath = 0.2f;
inline constexpr int k_prams_near = 3 * k_block * k_neighbours;  // of all sixteen, who may push one each

// What may not be come near: from a walker on its lane to something else, metres and m/s.
struct Meeting {
    Vec2 between, velocity;  // the other's
    float radii = 0;         // at which they touch
    float share = 0;         // of the change that the walker makes: 1, a half, or 0: none at all
    float hurry = 0;         // 1 / seconds within which they shall not touch
    float swath = 0;         // metres to either side within which it is ahead
    float pace = 0;          // 1 / seconds that the walker takes for a gap ahead
    int lane = 0;
};

// The same of all lanes' k-th neighbours.
struct MeetingRows {
    LaneRow x, z, velocity_x, velocity_z, radii, share, hurry, swath, pace;
};

struct PlaneRows {
    LaneRow x, z, offset;  // normal and offset of a HalfPlane; offsets of none are k_no_offset
};
inline constexpr float k_no_offset = -1e9f;
inline constexpr HalfPlane k_no_plane{{0, 0}, k_no_offset};

inline void set_plane(PlaneRows& rows, int lane, const HalfPlane& plane) {
    rows.x.lanes[lane] = plane.normal.x;
    rows.z.lanes[lane] = plane.normal.z;
    rows.offset.lanes[lane] = plane.offset;
}

struct Deciders {
    int count = 0;
    uint32_t at[k_block];  // in SeenRows
    LaneRow velocity_x, velocity_z, wish_x, wish_z, most, waited;
    LaneRow
        makes_room;  // 1: to the right of its course, for those who come the other way far ahead; -1: left
    int near_count[k_block];
    uint32_t near[k_block][k_neighbours];  // in SeenRows
    int rows = 0;                          // of neighbours
    MeetingRows neighbours[k_neighbours];
    int firm = 0;  // planes that are kept whatever happens come first
    PlaneRows planes[k_most_planes];
    int pram_count = 0;
    Meeting prams[k_prams_near];
    LaneRow chosen_x, chosen_z;
};

// Finds each one's k_neighbours nearest within k_neighbour_reach, ties by their order in the rows.
void find_nearest(const CrowdScratch& scratch, Deciders& deciders);

// Others than the walker at `me` of the rows whose bodies lie within `reach` of `place`, by their order; at
// most `room`. Returns how many.
int find_within(const CrowdScratch& scratch, Vec3 place, uint32_t me, float reach, uint32_t* found, int room);

// From wishes, neighbours and firm planes to the velocities chosen. `side` is +1 where people pass each other
// on the right, -1 on the left.
void choose_velocities(Deciders& deciders, float side);

}  // namespace flaneur
