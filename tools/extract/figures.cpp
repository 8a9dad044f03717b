// People who are not of the crowd.
#include "sim/figures/figures.h"

#include <algorithm>

#include "assets/outfit.h"
#include "sim/base/levels.h"
#include "sim/deeds/deeds.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"

namespace flaneur {

namespace {

// One person more, whose joints are these, beside those of the crowd.
void add_one(const JointPose* joints, const Character& character, uint32_t kind, uint32_t number,
             float heading, const Surroundings& around, PeopleFrame& frame) {
    WalkerDraw draw;
    draw.mesh = kind;
    draw.id = id_of(IdKind::exhibit, number);
    draw.centre = to_glm(joints[hips].position);
    draw.radius = k_body_sphere * character.body.height;
    draw.instance.scale = 1;
    draw.instance.palette = static_cast<uint32_t>(frame.palette.size());
    // A pair is dressed alike.
    std::ranges::copy(outfit(character.person, 0, kind), draw.instance.tints);
    draw.heading = heading;
    draw.presence = 255;
    draw.phase = -1;
    frame.grounds.resize(frame.palette.size() / k_palette_joints);
    frame.grounds.push_back(find_ground_below(around, joints));
    frame.palette.resize(frame.palette.size() + k_palette_joints);
    pose_character(character, 1, joints, &frame.palette[draw.instance.palette]);
    frame.walkers.push_back(draw);
}

}  // namespace

void add_figures(const Troupe& figures, const std::vector<Character>& characters, PeopleFrame& frame,
                 float between) {
    if (figures.plans.empty()) return;
    const Surroundings around = surroundings_of(*figures.ground);
    for (size_t i = 0; i < figures.plans.size(); ++i) {
        const uint32_t kind = figures.plans[i].kind;
        JointPose joints[k_joint_count];
        for (size_t j = 0; j < k_joint_count; ++j)
            joints[j] = joint_between(figures, i, static_cast<Joint>(j), between);
        add_one(joints, characters[kind], kind, static_cast<uint32_t>(i), figures.moves[i].motion.heading,
                around, frame);
    }
}

void add_doers(const Deeds& deeds, const std::vector<Character>& characters, PeopleFrame& frame,
               float between, uint32_t first_id) {
    if (deeds.plans.empty()) return;
    const Surroundings around = surroundings_of(*deeds.ground);
    for (size_t i = 0; i < deeds.plans.size(); ++i) {
        const uint32_t kind = deeds.plans[i].kind;
        JointPose joints[k_joint_count];
        for (size_t j = 0; j < k_joint_count; ++j)
            joints[j] = joint_between(deeds, i, static_cast<Joint>(j), between);
        add_one(joints, characters[kind], kind, first_id + static_cast<uint32_t>(i),
                deeds.doers[i].motion.heading, around, frame);
    }
}

}  // namespace flaneur
