#include "sim/roam.h"

#include "sim/base/math.h"

namespace flaneur {

namespace {

Roam::Frame frame_on(const SurfaceWalkers& w, size_t i) {
    return {w.position[i], frame_of(w.up[i], w.ahead[i])};
}

}  // namespace

Result<Roam> make_roam(Compound compound, const Crowd& crowd, uint64_t seed) {
    Roam roam;
    roam.compound = std::move(compound);
    roam.walkers =
        place_on_surface(roam.compound, crowd.identity.preferred_speed, crowd.identity.radius, seed);
    if (roam.walkers.position.size() != crowd.count)
        return Error{"There is nothing to walk on where walkers are set down; give it closed shapes."};
    for (size_t i = 0; i < crowd.count; ++i) roam.frames.push_back(frame_on(roam.walkers, i));
    roam.previous_frames = roam.frames;
    return roam;
}

void step_roam(Roam& roam, Crowd& crowd, Gait& gait, Workers& workers, uint64_t seed, uint32_t tick) {
    roam.previous_frames.swap(roam.frames);
    look_round(roam.walkers);
    // A block of the gait's walkers at least, which lie side by side.
    parallel_for(workers, crowd.count, 4 * k_block, [&](size_t begin, size_t end, int) {
        SurfaceWalkers& w = roam.walkers;
        walk_on_surface(roam.compound, w, begin, end, seed, tick, k_tick);
        for (size_t i = begin; i < end; ++i) {
            roam.frames[i] = frame_on(w, i);
            Vec2 way = heading_direction(crowd.motion.heading[i]) * w.moved[i];
            crowd.motion.velocity[i] = crowd.motion.wish[i] = way / k_tick;
            crowd.motion.turn_rate[i] = w.turn_rate[i];
            carry_feet(gait, i, crowd.motion.position[i], -w.turn_rate[i] * k_tick, at_height(-way, 0));
        }
    });
}

JointPose set_onto(const Roam::Frame& frame, Vec3 root, float heading, const JointPose& joint) {
    Quat turn = frame.rotation * rotation_y(-heading);
    return {frame.position + rotate(turn, joint.position - root), turn * joint.rotation};
}

}  // namespace flaneur
