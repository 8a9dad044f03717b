// Pieces of alongside.h, between its own sources.
#pragma once

#include "sim/alongside/alongside.h"
#include "sim/fall/body_pose.h"

namespace flaneur {

struct PersonBlock;

// Dogs: who waits for them, and where they go.
void think_dogs(World& world);
void walk_dogs(World& world);
// The dog of one who has just come, beside it.
Dog make_dog(const World& world, uint32_t walker, int thread = 0);

// What one has is in its hands, which are free for nothing else.
void fill_hands(World& world, const Companion& companion);
// Which hand a lead is in: that on the dog's side.
Side lead_hand(const World& world, uint32_t walker);

// Wheels go by what their walkers did.
void roll_chairs(World& world);
Chair make_chair(const World& world, uint32_t walker);
// Seated in it, hands on the rims.
void sit_in_chair(const World& world, const Chair& chair, BodyPose& pose);
// By how much all of a chair is larger than one for a body of 1.7 m.
float chair_size(const World& world, uint32_t walker);

// Players and who listens to them.
void set_players(World& world);
void think_music(World& world);
void pose_player(const World& world, const Companion& companion, BodyPose& pose);
void pose_listener(const World& world, const Listener& listener, BodyPose& pose);

// A body, and how large it is.
struct Holder {
    const PersonBlock& person;
    int lane;
    uint32_t walker;
};
Holder holder_of(const World& world, uint32_t walker);
void hold_lead(const World& world, const Companion& companion, BodyPose& pose);
void hold_white_cane(const World& world, const Companion& companion, BodyPose& pose);
void hold_umbrella(const World& world, const Companion& companion, BodyPose& pose);

// The palm of one side comes to `palm` by `part`, 0..1, of how it is held, the elbow low and out.
void bring_palm(BodyPose& pose, const Holder& holder, Side side, Vec3 palm, Vec3 elbow_way, float part);

// Joints between two ticks.
struct BodyAt {
    Vec3 hips, chest, head, palms[2];
    Quat chest_turn, head_turn;
    float height;
};
BodyAt body_between(const World& world, uint32_t walker, float between);

// See held_between() of alongside.h.
Placement white_cane_between(const World& world, const Companion& companion, float between);
Placement umbrella_between(const World& world, const Companion& companion, float between);

// Whether one goes about by itself, in full, so that it can be asked to wait or to listen.
bool can_be_called(const World& world, uint32_t walker);

}  // namespace flaneur
