#include "sim/alone/alone.h"

namespace flaneur {

Vec3 set_down(const Ground& ground, Vec2 place, float near) {
    const Vec3 point = at_height(place, near);
    const auto under = ground_at(ground, point, 1, 3);
    return under ? Vec3{place.x, under->height, place.z} : point;
}

void keep(RootRows& rows, size_t i, Vec3 position, const Motion& motion) {
    rows.position[i] = position;
    rows.velocity[i] = motion.velocity, rows.wish[i] = motion.aim;
    rows.heading[i] = motion.heading, rows.turn_rate[i] = motion.turn_rate;
    rows.brakes[i] = motion.brakes;
}

RootMotion told_of(RootRows& rows) {
    return {rows.position.data(),  rows.velocity.data(), rows.heading.data(),
            rows.turn_rate.data(), rows.wish.data(),     rows.brakes.data()};
}

}  // namespace flaneur
