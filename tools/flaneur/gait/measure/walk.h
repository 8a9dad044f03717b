// One person walked over ground made for it, and everything about it written down each tick.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "sim/body/body.h"
#include "sim/gait/gait.h"
#include "sim/ground/ground.h"
#include "sim/pose/pose.h"
#include "sim/pose/trail.h"

namespace flaneur {

struct FootInstant {
    Sole sole;
    float ground[3] = {};  // height under heel, ball and tip; the point's own where there is none
    bool swinging = false;
};

// A foot of the pose as it is now.
FootInstant foot_instant(const Ground& ground, const Gait& gait, const std::vector<PoseBlock>& poses,
                         size_t walker, Side side);

// A cane's tip, and the ground below it; the tip's own height where there is none.
struct CaneInstant {
    bool stands = false;
    Vec3 tip{};
    float ground = 0;
};

struct Instant {
    Vec3 root;
    Vec2 velocity;
    float heading = 0;
    std::array<JointPose, k_joint_count> joints;
    FootInstant feet[2];
    float load = 0.5f;              // share of the body that the left leg carries
    bool holds[2] = {};             // whether a hand has something, or is on its way to it; not a cane
    CaneInstant cane;               // of one who has one
    std::optional<PramPlace> pram;  // the same
    Trail trail;
};

inline Vec3 place(const Instant& now, Joint joint) { return now.joints[joint].position; }

// Joints of one side.
struct LimbJoints {
    Joint upper_leg, lower_leg, foot, upper_arm, lower_arm, hand;
};
inline constexpr LimbJoints k_limbs[2] = {
    {left_upper_leg, left_lower_leg, left_foot, left_upper_arm, left_lower_arm, left_hand},
    {right_upper_leg, right_lower_leg, right_foot, right_upper_arm, right_lower_arm, right_hand}};

struct Walk {
    Body body;
    double rate = 60;  // ticks a second
    std::vector<Instant> ticks;
    uint64_t hash = 0;  // of every pose: equal for equal walks on any machine
};

// Heights along +z, metres, and where they change.
struct Course {
    std::vector<float> edges;  // the first and the last are its ends
    std::function<float(float z)> height = [](float) { return 0.0f; };
    // Level between two edges, at the height of its middle; else straight from one's height to the other's.
    bool is_stepped = false;
    Surface kind = Surface::sidewalk;
    float half_width = 10;
    std::optional<Surface> ends{};  // of the first and the last piece, if another
};

inline constexpr int k_flight_steps = 40;

// Level ground that one who begins at (0, 0) and goes so many metres, wherever, does not leave.
Course level_course(float way);
// A flight of k_flight_steps whose risers are `rise` high, down where that is negative, between level
// sidewalks.
Course stairs_course(float begin, float rise, float tread);
// 60 m that rise by `grade` metres in one.
Course slope_course(float begin, float grade);
// Up a kerb, and down again 4 m on.
Course kerb_course(float begin, float height);

// The ground of a course, with its index.
Ground ground_of(const Course& course);
// The upright face of each of its steps; to be indexed then.
void add_risers(Ground& ground, const Course& course);

// Who walks: a body and its manner.
struct Person {
    Body body;
    Manner manner;
    uint64_t draws = 0;  // what chance brings: when hands do what, how feet come to stand
};

// The velocity, m/s on the ground plane, that the person would like at a time. Legs follow it as fast as they
// can (next_motion).
using Wish = std::function<Vec2(double time)>;

// Whether one who goes at `speed` m/s on the level takes stairs faster than any walk.
bool runs_on_stairs(const Person& person, double speed);

// At `speed` m/s, turned by so many degrees from +z to the left; a half turn goes to its own side too.
Vec2 turned_by(double degrees, double speed);

// Walks for `seconds` from (0, 0), facing +z, and leaps with the step after `leaps` seconds, if above 0. One
// who stands turns to `look` (unit; (0, 0): nowhere in particular), if that is given.
Walk walk(const Ground& ground, const Person& person, double seconds, const Wish& wish, double leaps = 0,
          const Wish& look = {});

}  // namespace flaneur
