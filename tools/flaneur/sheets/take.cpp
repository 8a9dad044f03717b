#include "tools/flaneur/sheets/take.h"

#include <algorithm>
#include <cmath>

#include "sim/base/math.h"
#include "sim/crowd/locomotion.h"
#include "tools/flaneur/gait/measure.h"

namespace flaneur {

namespace {

constexpr double k_stand = 1, k_steady = 5, k_turn = 2.7;      // seconds: stands; then turns; shown of a turn
constexpr float k_begin = 9;                                   // metres: where stairs, slopes and kerbs begin
constexpr float k_near = -60, k_far = 600, k_half_width = 10;  // metres, of the ground

// The upright face of each step between the levels of a strip of ground.
void add_risers(Ground& ground, const std::function<float(float)>& height, const std::vector<float>& edges) {
    for (size_t i = 1; i + 1 < edges.size(); ++i) {
        float z = edges[i];
        float before = height((edges[i - 1] + z) / 2), after = height((z + edges[i + 1]) / 2);
        Vec3 left{k_half_width, std::min(before, after), z}, right = left - Vec3{2 * k_half_width, 0, 0};
        if (after < before) std::swap(left, right);
        float top = std::max(before, after);
        ground.faces.push_back({left, right, top, top, FaceKind::riser});
    }
}

Ground ground_of(const GaitOptions& gait) {
    std::vector<float> edges{k_near};
    std::function<float(float)> height = [](float) { return 0.0f; };
    bool stepped = !gait.stairs.empty() || gait.kerb != 0;
    if (!gait.stairs.empty()) {
        constexpr int k_steps = 40;
        auto rise = static_cast<float>(gait.stairs == "up" ? gait.riser : -gait.riser);
        auto run = static_cast<float>(gait.tread);
        for (int i = 0; i < k_steps; ++i) edges.push_back(k_begin + static_cast<float>(i) * run);
        height = [=](float z) { return clamp(std::floor((z - k_begin) / run) + 1, 0, k_steps) * rise; };
    } else if (gait.slope != 0) {
        constexpr float k_length = 60;
        edges.insert(edges.end(), {k_begin, k_begin + k_length});
        auto grade = static_cast<float>(gait.slope / 100);
        height = [=](float z) { return clamp(z - k_begin, 0, k_length) * grade; };
    } else if (gait.kerb != 0) {
        edges.push_back(k_begin);
        auto kerb = static_cast<float>(gait.kerb);
        height = [=](float z) { return z > k_begin ? kerb : 0; };
    }
    edges.push_back(k_far);
    Ground ground = strip(height, edges, stepped, gait.stairs.empty() ? Surface::sidewalk : Surface::steps);
    if (stepped) add_risers(ground, height, edges);
    if (gait.wall > 0) {
        auto x = static_cast<float>(gait.wall);
        ground.faces.push_back({{x, 0, k_near}, {x, 0, k_far}, 2.4f, 2.4f, FaceKind::garden_wall});
    }
    index_ground(ground);
    return ground;
}

}  // namespace

Take make_take(const GaitOptions& gait, const Person& person, double speed) {
    Vec2 onward{0, static_cast<float>(speed)};
    Vec2 turned = heading_direction(static_cast<float>(gait.turn) * k_radians) * onward.z;
    float from = k_begin + (gait.kerb != 0 ? -0.9f : 4 * static_cast<float>(gait.tread));
    Take take;
    take.ground = ground_of(gait);
    double seconds = k_steady + k_turn + static_cast<double>(from / stair_speed(onward.z)) + 3;
    take.walk = walk(take.ground, person, seconds, [&](double t) {
        return t < k_stand ? Vec2{} : gait.turn != 0 && t >= k_steady ? turned : onward;
    });
    const std::vector<Instant>& ticks = take.walk.ticks;
    if (gait.turn != 0) {
        take.first = (k_steady - 0.3) * take.walk.rate;
        take.last = take.first + k_turn * take.walk.rate;
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
