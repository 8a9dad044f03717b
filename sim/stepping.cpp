#include "sim/stepping.h"

#include <string>
#include <utility>

#include "sim/base/hash.h"
#include "sim/base/tick.h"
#include "sim/base/zone.h"

namespace flaneur {

// The crowd learns where they are.
static void tell_crowd(World& w) {
    const Bipeds& bipeds = w.stepping->bipeds;
    CrowdMotion& m = w.crowd.motion;
    for (size_t i = 0; i < bipeds.all.size(); ++i) {
        const Biped& b = bipeds.all[i];
        m.position[i] = at_height(b.body, w.gait.blocks[i / k_block].base[i % k_block]);
        m.velocity[i] = b.velocity;
        m.wish[i] = b.ahead * b.speed;
        m.heading[i] = b.heading;
        m.turn_rate[i] = b.turn_rate;
    }
}

Result<void> set_on_course(World& w, StepCourse course) {
    constexpr float k_careful = 0.8f;  // of the speed that one prefers
    auto stepping = std::make_shared<Stepping>();
    w.movers = make_movers(std::move(course.movers));
    stepping->ground = std::move(course.ground);
    stepping->moving = {stepping->ground.get(), &w.movers};
    stepping->ways = course.ways;
    std::vector<BipedWay> ways;
    for (std::vector<Vec2>& line : course.ways) ways.push_back(make_way(std::move(line)));
    std::vector<float> likes;
    for (uint32_t i = 0; i < w.crowd.count; ++i)
        likes.push_back(k_careful * w.crowd.identity.preferred_speed[i]);
    SetDown made = make_bipeds(std::move(ways), likes, course.is_flat, stepping->moving, w.gait, w.seed);
    if (made.placed < likes.size())
        return Error{"Only " + std::to_string(made.placed) + " of " + std::to_string(likes.size()) +
                     " walkers find room on the course; ask for fewer."};
    stepping->bipeds = std::move(made.bipeds);
    w.around = surroundings_of(stepping->moving);
    w.stepping = std::move(stepping);
    w.drive = drive_steppers;
    for (uint32_t i = 0; i < w.crowd.count; ++i) w.crowd.journeys[i] = {};
    tell_crowd(w);
    pose_blocks(w.gait, 0, w.gait.blocks.size(), w.poses);
    w.previous_poses = w.poses;
    w.trails.assign(w.poses.size(), {});
    w.previous_trails = w.trails;
    return {};
}

StepCourse course_of(const World& w) {
    return {w.stepping->ground, w.movers.all, w.stepping->ways, w.stepping->bipeds.is_flat};
}

void drive_steppers(World& w) {
    FLANEUR_ZONE("gait", w.stage_ms[static_cast<size_t>(Stage::gait)]);
    Stepping& s = *w.stepping;
    s.bipeds.orders = s.orders[0];
    const Driven& driven = w.crowd.driven;
    if (driven.walker != k_nobody) {
        s.bipeds.orders.driven = driven.walker;
        s.bipeds.orders.wish = driven.wish;
    }
    step_bipeds(s.bipeds, s.moving, w.gait, *w.workers, w.seed, w.tick);
    tell_crowd(w);
}

void look_at(World& w, std::optional<Vec3> place) {
    BipedOrders& orders = w.stepping->orders[0];
    orders.looks = place.has_value();
    orders.looked_at = place.value_or(Vec3{});
}

void go_to(World& w, std::optional<Vec3> goal) {
    BipedOrders& orders = w.stepping->orders[0];
    orders.has_goal = goal.has_value();
    orders.goal = goal.value_or(Vec3{});
}

uint64_t hash_bipeds(const Stepping& s) {
    static_assert(sizeof(Biped) % 4 == 0);
    const std::vector<Biped>& all = s.bipeds.all;
    return hash_bytes(hash_bytes(1, all.data(), all.size() * sizeof all[0]), s.orders.data(),
                      sizeof s.orders);
}

}  // namespace flaneur
