#include "sim/roam.h"

#include "sim/base/math.h"
#include "sim/base/rng.h"

namespace flaneur {

namespace {

Roam::Frame frame_on(const SurfaceWalkers& w, size_t i) {
    return {w.position[i], frame_of(w.up[i], w.ahead[i])};
}

float size_of_creature(uint64_t seed, uint32_t number) {
    return random_between({seed, number, 2, Purpose::spawn}, 1.1f, 1.9f);
}
// A third of its length a second at least, as it likes.
float speed_of_creature(uint64_t seed, uint32_t number, float size) {
    return size * random_between({seed, number, 3, Purpose::spawn}, 0.45f, 0.7f);
}

}  // namespace

Result<Roam> make_roam(Compound compound, const Crowd& crowd, uint32_t creatures, uint64_t seed) {
    Roam roam;
    roam.compound = std::move(compound);
    std::vector<float> speed = crowd.identity.preferred_speed, radius = crowd.identity.radius;
    speed.resize(crowd.count), radius.resize(crowd.count);
    for (uint32_t n = 0; n < creatures; ++n) {
        const float size = size_of_creature(seed, n);
        speed.push_back(speed_of_creature(seed, n, size));
        radius.push_back(creature_radius(size));
    }
    roam.walkers = place_on_surface(roam.compound, speed, radius, seed);
    const size_t placed = roam.walkers.position.size();
    if (placed == 0 && !speed.empty())
        return Error{"There is nothing to walk on where walkers are set down; give it closed shapes."};
    if (placed != speed.size())
        return Error{"Only " + std::to_string(placed) + " of " + std::to_string(crowd.count) +
                     " walkers and " + std::to_string(creatures) +
                     " creatures find room all round it; ask for fewer."};
    for (uint32_t n = 0; n < creatures; ++n)
        roam.creatures.push_back(
            make_creature(roam.compound, roam.walkers, crowd.count + n, size_of_creature(seed, n)));
    for (size_t i = 0; i < crowd.count; ++i) roam.frames.push_back(frame_on(roam.walkers, i));
    roam.previous_frames = roam.frames;
    return roam;
}

void step_roam(Roam& roam, Crowd& crowd, Gait& gait, Workers& workers, uint64_t seed, uint32_t tick) {
    roam.previous_frames.swap(roam.frames);
    look_round(roam.walkers);
    for (const Creature& c : roam.creatures)
        walk_on_surface(roam.compound, roam.walkers, c.walker, c.walker + 1, seed, tick, k_tick);
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

Linkages make_bones(const std::vector<Creature>& creatures) {
    std::vector<Linkage> all;
    all.reserve(creatures.size());
    for (const Creature& creature : creatures) all.push_back(creature_linkage(creature.size));
    Linkages bones = make_linkages(std::move(all));
    for (size_t n = 0; n < creatures.size(); ++n)
        place_creature(bones.all[n], creatures[n], places_of(bones, n));
    bones.previous_places = bones.places;
    return bones;
}

void step_creatures(Roam& roam, Linkages& linkages, Workers& workers) {
    parallel_for(workers, roam.creatures.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t n = begin; n < end; ++n) {
            Creature& creature = roam.creatures[n];
            step_creature(roam.compound, roam.walkers, creature, k_tick);
            place_creature(linkages.all[n], creature, places_of(linkages, n));
        }
    });
}

JointPose set_onto(const Roam::Frame& frame, Vec3 root, float heading, const JointPose& joint) {
    Quat turn = frame.rotation * rotation_y(-heading);
    return {frame.position + rotate(turn, joint.position - root), turn * joint.rotation};
}

}  // namespace flaneur
