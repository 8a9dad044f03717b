#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "sim/base/math.h"
#include "tools/flaneur/view/camera.h"

namespace flaneur {

namespace {

constexpr float k_reach = 65;       // of what is framed, metres: farther off people are specks
constexpr float k_least_reach = 5;  // one person alone is not framed closer
constexpr float k_sky = 10'000;     // above and below all ground
constexpr size_t k_most_sights = 300, k_most_centres = 128;
constexpr int k_sides = 16;
constexpr float k_dips[] = {0.21f, 0.33f, 0.5f, 0.75f};  // radians below the horizon

// Something that there is to see.
struct Sight {
    Vec3 at;
    Vec3 out;         // where a front faces; zero: it looks the same from all sides
    float worth = 1;  // against others of its kind
};

bool is_front(const Sight& s) { return length_squared(s.out) > 0; }

std::vector<Sight> people_of(const World& world) {
    constexpr float k_chest = 1.3f;
    std::vector<Sight> people;
    if (is_on(world.traced)) {  // wherever anybody ever is
        const std::vector<TraceKnot>& knots = world.traced.traces->knots;
        for (size_t k = 0; k < knots.size(); k += knots.size() / k_most_sights + 1)
            people.push_back({knots[k].at + Vec3{0, k_chest, 0}, {}});
        return people;
    }
    for (WalkerId id : world.crowd.slots.living) {
        Sight& person = people.emplace_back();
        if (world.roam) {
            const Roam::Frame& frame = world.roam->frames[id.index];
            person.at = frame.position + rotate(frame.rotation, Vec3{0, k_chest, 0});
        } else {
            person.at = world.crowd.motion.position[id.index] + Vec3{0, k_chest, 0};
        }
    }
    return people;
}

// The upper halves of facades.
std::vector<Sight> fronts_of(const World& world) {
    std::vector<Sight> fronts;
    if (world.roam) return fronts;  // the stage is not in the picture
    for (const Face& f : world.ground->faces) {
        Vec2 a = on_ground(f.a), b = on_ground(f.b);
        float wide = length(b - a), high = (f.a_top - f.a.y + f.b_top - f.b.y) * 0.5f;
        if (f.kind != FaceKind::facade || wide < 2 || high < 2) continue;
        Vec2 along = (b - a) / wide;
        Vec3 out{-along.z, 0, along.x};
        Vec3 at = at_height((a + b) * 0.5f, (f.a.y + f.b.y) * 0.5f + 0.75f * high);
        fronts.push_back({at + out * 0.3f, out, wide});
    }
    return fronts;
}

// At most so many, evenly taken, worth 1 together.
std::vector<Sight> sample(const std::vector<Sight>& all) {
    std::vector<Sight> kept;
    for (size_t i = 0; i < all.size(); i += all.size() / k_most_sights + 1) kept.push_back(all[i]);
    float worth = 0;
    for (const Sight& s : kept) worth += s.worth;
    for (Sight& s : kept) s.worth /= worth;
    return kept;
}

std::vector<Sight> joined(std::vector<Sight> a, const std::vector<Sight>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

// Where most is within reach, and nothing that was tried; none where that is nowhere.
std::optional<Vec3> liveliest(const std::vector<Sight>& sights, const std::vector<Vec3>& tried) {
    float best = -1;
    std::optional<Vec3> centre;
    for (size_t i = 0; i < sights.size(); i += sights.size() / k_most_centres + 1) {
        Vec3 at = sights[i].at;
        if (std::any_of(tried.begin(), tried.end(), [&](Vec3 t) { return length(t - at) < k_reach; }))
            continue;
        float worth = 0;
        for (const Sight& s : sights) worth += s.worth * std::max(0.0f, 1 - length(s.at - at) / k_reach);
        if (worth > best) best = worth, centre = at;
    }
    return centre;
}

std::vector<Sight> near(const std::vector<Sight>& sights, Vec3 centre) {
    std::vector<Sight> kept;
    for (const Sight& s : sights)
        if (length(on_ground(s.at - centre)) <= k_reach) kept.push_back(s);
    return kept;
}

struct Subject {
    Vec3 centre;
    float radius;
    std::vector<Sight> sights;  // within it
};

// The middle of what is there where there is nothing to see.
Subject the_ground(const World& world) {
    const Ground& ground = *world.ground;
    Vec2 middle = (ground.low + ground.high) * 0.5f;
    auto hit = ground_at(ground, at_height(middle, 0), k_sky, k_sky);
    float radius = clamp(length(ground.high - ground.low) * 0.5f, k_least_reach, k_reach);
    return {at_height(middle, hit ? hit->height : 0), radius, {}};
}

// What is about a place, and no more than is there.
Subject subject_about(Vec3 centre, const std::vector<Sight>& people, const std::vector<Sight>& fronts) {
    Subject subject{};
    subject.sights = joined(sample(near(people, centre)), sample(near(fronts, centre)));
    Vec3 low = centre, high = centre;
    for (const Sight& s : subject.sights) {
        low = {std::min(low.x, s.at.x), std::min(low.y, s.at.y), std::min(low.z, s.at.z)};
        high = {std::max(high.x, s.at.x), std::max(high.y, s.at.y), std::max(high.z, s.at.z)};
    }
    subject.centre = (low + high) * 0.5f;
    subject.radius = clamp(length(high - low) * 0.5f, k_least_reach, k_reach);
    return subject;
}

// How much of the subject shows: fronts that face the eye, more so in the sun, and people.
float rate(const World& world, const Subject& subject, Vec3 eye, Vec3 to_sun) {
    float worth = 0;
    for (const Sight& s : subject.sights) {
        if (is_front(s) && dot(s.out, eye - s.at) <= 0) continue;
        if (!world.roam && !sees(*world.ground, eye, s.at)) continue;
        worth += s.worth * (is_front(s) ? 0.5f + std::max(0.0f, dot(s.out, to_sun)) : 1.5f);
    }
    return worth;
}

// How much of the picture, 0..1, one house takes.
float most_of_one_house(const World& world, std::span<const Building> buildings, Vec3 eye, Vec3 target) {
    constexpr int k_columns = 8, k_rows = 5;  // rays to either side of the middle
    constexpr float k_aspect = 16.0f / 9, k_far = 1000;
    if (world.roam) return 0;
    Vec3 ahead = normalize_or(target - eye, {1, 0, 0});
    Vec3 right = normalize_or(cross(ahead, {0, 1, 0}), {1, 0, 0}), up = cross(right, ahead);
    float half = std::tan(k_fov / 2);
    std::map<uint32_t, int> hits;  // by house
    for (int row = -k_rows; row <= k_rows; ++row) {
        for (int column = -k_columns; column <= k_columns; ++column) {
            Vec3 ray = ahead + up * (half * static_cast<float>(row) / k_rows) +
                       right * (half * k_aspect * static_cast<float>(column) / k_columns);
            auto hit = raycast(*world.ground, eye, ray / length(ray), k_far);
            if (!hit || hit->what != RayHit::What::face) continue;
            uint32_t building = world.ground->faces[hit->index].building;
            // Parts of one house have its seed.
            ++hits[building < buildings.size() ? buildings[building].seed : building];
        }
    }
    int most = 0;
    for (auto [house, count] : hits) most = std::max(most, count);
    return static_cast<float>(most) / ((2 * k_rows + 1) * (2 * k_columns + 1));
}

// From which side most of the subject shows.
Vec3 best_eye(const World& world, const Subject& subject, Vec3 to_sun) {
    constexpr float k_nearer = 0.72f;  // than what has the whole sphere in the picture: its rim is thin
    constexpr float k_clear = 3;       // metres, that the eye keeps from the ground below
    constexpr float k_over_walls =
        0.45f;  // radians below the horizon, where walls are cut low to be seen over
    constexpr float k_for_horizon = 0.15f;  // worth of a flatter view, each step
    float distance = k_nearer * subject.radius / std::sin(k_fov / 2);
    float best = -1;
    Vec3 eye;
    for (int d = 0; d < static_cast<int>(std::size(k_dips)); ++d) {
        for (int side = 0; side < k_sides; ++side) {
            Vec2 from = heading_direction(static_cast<float>(side) * (2 * k_pi / k_sides));
            float dip = k_dips[d];
            if (is_on(world.traced) && dip < k_over_walls) continue;
            Vec3 candidate = subject.centre + at_height(from * std::cos(dip), std::sin(dip)) * distance;
            auto below = ground_at(*world.ground, candidate, k_sky, k_sky);
            if (below && !world.roam) candidate.y = std::max(candidate.y, below->height + k_clear);
            float worth = rate(world, subject, candidate, to_sun) - k_for_horizon * static_cast<float>(d);
            if (worth > best) best = worth, eye = candidate;
        }
    }
    return eye;
}

}  // namespace

Camera overview_camera(const World& world, std::span<const Building> buildings, Vec3 to_sun) {
    constexpr float k_most = 0.25f;  // of the picture, that one house may take
    constexpr int k_tries = 8;
    std::vector<Sight> people = people_of(world), fronts = fronts_of(world);
    std::vector<Sight> all = joined(sample(people), sample(fronts));
    if (all.empty()) {
        Subject ground = the_ground(world);
        return make_camera(best_eye(world, ground, to_sun), ground.centre);
    }
    std::vector<Vec3> tried;
    float least = 2;
    Camera camera;
    while (tried.size() < k_tries && least > k_most) {
        std::optional<Vec3> centre = liveliest(all, tried);
        if (!centre) break;
        tried.push_back(*centre);
        Subject subject = subject_about(*centre, people, fronts);
        Vec3 eye = best_eye(world, subject, to_sun);
        float share = most_of_one_house(world, buildings, eye, subject.centre);
        if (share < least) least = share, camera = make_camera(eye, subject.centre);
    }
    return camera;
}

}  // namespace flaneur
