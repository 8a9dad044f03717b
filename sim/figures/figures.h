// People who go for ever along ways of their own, on ground of their own: a crowd knows nothing of them. Each
// shows one thing that bodies do, beside the same without it: a pair that walks in step, a body that thirteen
// key poses make, a key pose by itself.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/alone/alone.h"
#include "sim/base/parallel_for.h"
#include "sim/crowd/locomotion.h"
#include "sim/figures/key_poses.h"
#include "sim/gait/gait.h"
#include "sim/ground/ground.h"
#include "sim/pose/techniques.h"

namespace flaneur {

inline constexpr uint32_t k_no_twin = ~0u;

struct FigurePlan {
    // What makes the body: the gait and its techniques; the tree of key poses, on the gait's feet; one key.
    enum class By : uint8_t { techniques, keys, statue };
    std::string name;
    By by = By::techniques;
    std::vector<Vec2> way;  // a closed line that it goes along; one place: it stands there
    float heading = 0;      // of one who stands, yaw
    float start = 0;        // metres along the way
    float speed = 1.2f;     // m/s, of one who goes
    bool varies = false;    // stands, walks, runs, leaps and creeps by turns, `speed` being a walk's
    Techniques on;
    // An earlier figure of which this one is the twin: it walks as that one does, to the last bit, `aside`.
    uint32_t twin_of = k_no_twin;
    Vec3 aside{};
    KeyCurves curves;
    KeyPose key = KeyPose::stand;
    uint32_t kind = 0;  // of the world's: whose body it has
};

// Where one is.
struct FigureMove {
    Vec3 position{};
    float along = 0;   // metres of its way, of the place that it goes for
    float crouch = 0;  // of a body by keys, 0..1
    Motion motion;
};

// One who goes where somebody says, and no way of its own.
struct FigureLead {
    uint32_t figure = k_no_twin;  // k_no_twin: nobody
    Vec2 wish{};                  // m/s
    uint32_t creeps = 0;          // 1: by the key poses that creep, if keys make it
};

struct Troupe {
    std::vector<FigurePlan> plans;
    std::shared_ptr<const Ground> ground;
    std::vector<Body> bodies;      // of each
    std::vector<BlendTree> trees;  // of each; empty where no keys make it
    std::vector<LocalPose> keys;   // of each, of which statues are
    std::vector<FigureMove> moves;
    FigureLead lead;
    Gait gait;
    std::vector<PoseBlock> whole, before;          // as the gait has them, after the last tick and before
    std::vector<PoseBlock> poses, previous_poses;  // as they are seen, the same
    std::vector<Techniques> sets;                  // that plans have on, each once
    // Of one tick alone.
    RootRows rows;
    std::vector<PoseBlock> bare;
};

// What everybody does in a tick who varies, m/s and share: a round of k_figure_round ticks.
inline constexpr uint32_t k_figure_round = 2400;
struct FigureWish {
    float speed = 0, crouch = 0;
    bool leaps = false;  // begins to
};
FigureWish figure_wish(const FigurePlan& plan, uint32_t tick);

// Standing at the start of their ways. `bodies` are of the plans' kinds.
Troupe make_figures(std::vector<FigurePlan> plans, std::shared_ptr<const Ground> ground,
                    const std::vector<Body>& bodies, uint64_t seed);
// One that keys make goes as `lead` says from now on, or k_no_twin: all go their ways, from where they are.
// It stays on its ground, off walls and out of the others.
void lead_figure(Troupe& figures, uint32_t figure);
// It leaps with its next step.
void leap(Troupe& figures);
// A tick, which allocates nothing.
void step_figures(Troupe& figures, uint64_t seed, uint32_t tick);
// What follows from moves and gait, after these were written over.
void pose_figures_anew(Troupe& figures);

// A joint `between` 0, the tick before the last, and 1, the last.
JointPose joint_between(const Troupe& figures, size_t figure, Joint joint, float between);

}  // namespace flaneur
