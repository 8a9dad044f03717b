#include "tools/flaneur/export/people.h"

#include <algorithm>

#include "sim/base/tick.h"
#include "sim/world.h"
#include "tools/flaneur/tracks/record.h"

namespace flaneur {

namespace {

Vec3 place_in(const JointTransform& t) { return {t.translation.x, t.translation.y, t.translation.z}; }

void take_person(PeopleTaking& taking, const WalkerDraw& draw, const Character& character, uint32_t number,
                 uint32_t frame) {
    const auto [found, is_new] = taking.place_of.try_emplace(number, taking.group.people.size());
    if (is_new) {
        GlbPerson& person = taking.group.people.emplace_back();
        person.name = "walker " + std::to_string(number);
        person.character = &character;
        person.scale = draw.instance.scale;
        std::ranges::copy(draw.instance.tints, person.tints.begin());
    }
    GlbPerson& person = taking.group.people[found->second];
    person.frames.push_back(frame);
    DrawnBones& bones = person.poses.emplace_back();
    for (size_t b = 0; b < k_bone_count; ++b) {
        const JointTransform& t = taking.drawn.palette[draw.instance.palette + b];
        bones[b] = {{t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w}, place_in(t)};
    }
    ++taking.poses;
}

}  // namespace

void take_people(PeopleTaking& taking, const World& world, const std::vector<Character>& characters,
                 uint32_t tick) {
    const auto fps = static_cast<int64_t>(taking.group.fps);
    for (;; ++taking.group.frames) {
        const uint32_t frame = taking.group.frames;
        // In parts of a tick, from the one before.
        const int64_t past = int64_t{frame} * k_ticks_a_second - (int64_t{tick} - 1) * fps;
        if (past > fps) return;
        extract_people(world, characters, taking.drawn, static_cast<float>(past) / static_cast<float>(fps));
        for (const uint32_t i : taking.drawn.posed) {
            const uint32_t number = number_of(world, i, taking.has_their_numbers);
            taking.seen.insert(number);
            if (is_wanted(taking.wanted, number))
                take_person(taking, taking.drawn.walkers[i], characters[taking.drawn.walkers[i].mesh], number,
                            frame);
        }
    }
}

JointPoses joints_of(const GlbPerson& person, size_t i) {
    JointPoses joints;
    const Character& c = *person.character;
    for (size_t j = 0; j < k_joint_count; ++j) {
        const DrawnBone& bone = person.poses[i][j];
        joints[j].position = bone.shift + rotate(bone.turn, c.bind_joints[j] * person.scale);
        joints[j].rotation = bone.turn * conjugate(c.bind_to_canonical[j]);
    }
    return joints;
}

}  // namespace flaneur
