#include "tools/flaneur/sheets/take.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/crowd/locomotion.h"
#include "tools/flaneur/gait/measure/measure.h"

namespace flaneur {

namespace {

// Seconds: stands; then turns, changes or leaps; shown of a turn; of a change; of a leap; stands at the end.
constexpr double k_stand = 1, k_steady = 5, k_turn = 2.7, k_change = 5, k_leap = 1.8, k_stop = 3;
constexpr double k_turn_standing = 3.6, k_aside = 0.24, k_settle = 1.2;  // seconds; m/s aside; seconds after
constexpr float k_begin = 9;  // metres: where stairs, slopes and kerbs begin

Course course_of(const GaitOptions& gait) {
    if (!gait.stairs.empty())
        return stairs_course(k_begin, static_cast<float>(gait.stairs == "up" ? gait.riser : -gait.riser),
                             static_cast<float>(gait.tread));
    if (gait.slope != 0) return slope_course(k_begin, static_cast<float>(gait.slope / 100));
    if (gait.kerb != 0) return kerb_course(k_begin, static_cast<float>(gait.kerb));
    return level_course(0);
}

// For one who goes so many metres.
Ground ground_of(const GaitOptions& gait, float way) {
    Course course = gait.turn != 0 ? level_course(way) : course_of(gait);
    course.edges.back() = std::max(course.edges.back(), way);
    Ground ground = ground_of(course);
    if (course.is_stepped) add_risers(ground, course);
    if (gait.wall > 0) {
        auto x = static_cast<float>(gait.wall);
        ground.faces.push_back(
            {{x, 0, course.edges.front()}, {x, 0, course.edges.back()}, 2.4f, 2.4f, FaceKind::garden_wall});
    }
    index_ground(ground);
    return ground;
}

Take take_on(Ground ground, const GaitOptions& gait, const Person& person, double speed, double seconds) {
    Vec2 onward{0, static_cast<float>(speed)};
    Vec2 turned = turned_by(gait.turn, speed), changed{0, static_cast<float>(gait.change)};
    Take take;
    take.ground = std::move(ground);
    take.walk = walk(
        take.ground, person, seconds,
        [&](double t) {
            if (t < k_stand || t >= seconds - k_stop) return Vec2{};
            if (t < k_steady) return onward;
            if (gait.turn != 0) return turned;
            return gait.change != 0 && t < k_steady + k_change ? changed : onward;
        },
        gait.leap != 0 ? k_steady : 0);
    take.last = static_cast<double>(take.walk.ticks.size());
    return take;
}

// Seconds of stepping aside.
double steps_aside(const GaitOptions& gait) { return std::fabs(gait.aside) / k_aside; }

Take take_standing(const GaitOptions& gait, const Person& person) {
    const Vec2 aside{static_cast<float>(gait.aside > 0 ? k_aside : -k_aside), 0};
    Take take;
    take.ground = ground_of(gait, 0);
    take.walk = walk(
        take.ground, person, gait.stand,
        [&](double t) { return t >= k_steady && t < k_steady + steps_aside(gait) ? aside : Vec2{}; }, 0,
        [&](double t) { return gait.turn != 0 && t >= k_steady ? turned_by(gait.turn, 1) : Vec2{}; });
    take.last = static_cast<double>(take.walk.ticks.size());
    return take;
}

}  // namespace

Take make_take(const GaitOptions& gait, const Person& person, double speed, double seconds) {
    if (gait.stand > 0) return take_standing(gait, person);
    return take_on(ground_of(gait, static_cast<float>(std::max(speed, gait.change) * seconds)), gait, person,
                   speed, seconds);
}

Take make_moment(const GaitOptions& gait, const Person& person, double speed) {
    if (gait.stand > 0) {
        Take take = take_standing(gait, person);
        if (gait.turn == 0 && gait.aside == 0) return take;
        take.first = (k_steady - 0.3) * take.walk.rate;
        double lasts = gait.turn != 0 ? k_turn_standing : steps_aside(gait) + k_settle;
        take.last = std::min(take.last, take.first + lasts * take.walk.rate);
        return take;
    }
    float from = k_begin + (gait.kerb != 0 ? -0.9f : 4 * static_cast<float>(gait.tread));
    double walked = k_steady + k_turn +
                    static_cast<double>(
                        from / stair_speed(static_cast<float>(speed), stair_pace(leg_length(person.body)))) +
                    3;
    // What is shown lies near the beginning.
    Take take = take_on(ground_of(gait, 0), gait, person, speed, walked + k_stop);
    const std::vector<Instant>& ticks = take.walk.ticks;
    if (gait.turn != 0) {
        take.first = (k_steady - 0.3) * take.walk.rate;
        take.last = take.first + k_turn * take.walk.rate;
        return take;
    }
    if (gait.leap != 0) {
        take.first = k_steady * take.walk.rate;
        take.last = take.first + k_leap * take.walk.rate;
        return take;
    }
    auto there = std::find_if(ticks.begin(), ticks.end(), [&](const Instant& i) { return i.root.z >= from; });
    auto tick = static_cast<size_t>(there - ticks.begin());
    take.first = static_cast<double>(tick);
    take.last = take.first + take.walk.rate;
    for (const MeasuredStride& stride : strides(take.walk, tick, ticks.size())) {
        if (stride.side != k_left) continue;
        take.first = stride.begin;
        take.last = stride.end;
        break;
    }
    return take;
}

}  // namespace flaneur
