#include "tools/flaneur/view/camera.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "renderer/view.h"
#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/flaneur/view/rig.h"
#include "tools/flaneur/view/show.h"

namespace flaneur {

Camera make_camera(Vec3 eye, Vec3 target) {
    Camera camera;
    camera.eye = to_glm(eye);
    camera.target = to_glm(target);
    camera.vertical_fov = k_fov;
    return camera;
}

bool sees(const Ground& ground, Vec3 from, Vec3 to) {
    Vec3 way = to - from;
    float distance = length(way);
    return distance < 1e-3f || !raycast(ground, from, way / distance, distance);
}

namespace {

constexpr float k_eye = 1.6f;        // of the street camera, metres
constexpr float k_sight = 60;        // how far ahead it cares, metres
constexpr size_t k_candidates = 48;  // places that it tries
constexpr int k_headings = 24;
constexpr float k_half_view = 0.45f;  // radians, on the ground plane

Vec3 heading_vector(float yaw) {
    Vec2 d = heading_direction(yaw);
    return {d.x, 0, d.z};
}

// Round the edge of all ground: who looks at what was recorded is none of those in it.
std::vector<Vec3> places_at_the_edge(const Ground& ground) {
    constexpr int k_sides = 32;
    constexpr float k_in = 0.5f, k_over = 500;  // metres
    const Vec2 middle = (ground.low + ground.high) * 0.5f, half = (ground.high - ground.low) * 0.5f;
    std::vector<Vec3> places;
    for (int side = 0; side < k_sides; ++side) {
        const Vec2 way = heading_direction(static_cast<float>(side) * (2 * k_pi / k_sides));
        const float reach =
            std::min(half.x / std::max(std::fabs(way.x), 1e-3f), half.z / std::max(std::fabs(way.z), 1e-3f));
        const Vec2 at = middle + way * std::max(reach - k_in, 0.0f);
        if (const auto hit = ground_at(ground, at_height(at, k_over), 0, 2 * k_over))
            places.push_back(at_height(at, hit->height));
    }
    return places;
}

// Where walkers stand who have most others around, as places to look from; the city's middle if there is
// nobody.
std::vector<Vec3> places_to_stand(const World& world) {
    const Ground& ground = *world.ground;
    Vec2 middle = (ground.low + ground.high) * 0.5f;
    if (is_on(world.traced))
        if (std::vector<Vec3> edge = places_at_the_edge(ground); !edge.empty()) return edge;
    constexpr size_t k_sample = 1000;
    constexpr float k_company = 25;
    size_t stride = world.crowd.count / k_sample + 1;
    std::vector<std::pair<float, uint32_t>> ids;
    for (size_t i = 0; i < world.crowd.count; i += stride) {
        float company = 0;
        for (size_t j = 0; j < world.crowd.count; j += stride) {
            float distance = length(world.crowd.motion.position[i] - world.crowd.motion.position[j]);
            if (distance < k_company) company += 1 - distance / k_company;
        }
        ids.push_back({-company, static_cast<uint32_t>(i)});
    }
    size_t kept = std::min(k_candidates, ids.size());
    std::partial_sort(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(kept), ids.end());
    std::vector<Vec3> places;
    for (size_t i = 0; i < kept; ++i) places.push_back(world.crowd.motion.position[ids[i].second]);
    if (!places.empty()) return places;
    for (float x = -40; x <= 40; x += 8) {
        for (float z = -40; z <= 40; z += 8) {
            Vec3 above{middle.x + x, 500, middle.z + z};
            if (auto hit = ground_at(ground, above, 500, 1500))
                places.push_back({above.x, hit->height, above.z});
        }
    }
    if (places.empty()) places.push_back({middle.x, 0, middle.z});
    return places;
}

// How good the view from `eye` is in each direction.
std::vector<float> rate_headings(const City& city, const World& world, Vec3 eye) {
    std::vector<float> rating(k_headings, 0.0f);
    auto add = [&](Vec3 at, float worth) {
        float yaw = heading_of({at.x - eye.x, at.z - eye.z});
        for (int h = 0; h < k_headings; ++h) {
            float off = wrap_angle(yaw - static_cast<float>(h) * (2 * k_pi / k_headings));
            if (std::fabs(off) < k_half_view) rating[static_cast<size_t>(h)] += worth;
        }
    };
    for (uint32_t i = 0; i < world.crowd.count; ++i) {
        if (!is_there(world.crowd, i)) continue;
        Vec3 chest = world.crowd.motion.position[i] + Vec3{0, 1.3f, 0};
        float distance = length(chest - eye);
        if (distance > k_sight || distance < 0.35f) continue;  // far off, or whose eye it is
        if (distance < 3) {
            add(chest, distance < 1.5f ? -20 : -2);  // would fill the picture
        } else if (sees(*world.ground, eye, chest)) {
            add(chest, 6 / (6 + distance));
        }
    }
    for (const Prop& prop : city.props) {
        Vec2 way = on_ground(prop.position - eye);
        float distance = length(way);
        if (distance < 5) add(prop.position, prop.kind == PropKind::bollard ? -0.5f : -3);
        if (distance > k_sight || prop.kind == PropKind::bollard) continue;
        // Large ones take so much of the picture's breadth, wherever in it they stand.
        constexpr float k_small = 0.12f, k_for_room = 30;
        Vec2 half = half_footprint(prop);
        float breadth = prop.kind == PropKind::tree ? prop.radius * 0.5f : std::max(half.x, half.z);
        float angle = std::atan2(breadth, std::max(distance, 0.1f)), share = angle / k_half_view;
        if (share < k_small) continue;
        for (int h = 0; h < k_headings; ++h) {
            float off = wrap_angle(heading_of(way) - static_cast<float>(h) * (2 * k_pi / k_headings));
            if (std::fabs(off) < k_half_view + 0.5f * angle)
                rating[static_cast<size_t>(h)] -= k_for_room * (share - k_small);
        }
    }
    for (int h = 0; h < k_headings; ++h) {
        float yaw = static_cast<float>(h) * (2 * k_pi / k_headings);
        auto sight = [&](float off) {
            auto hit = raycast(*world.ground, eye, heading_vector(yaw + off), k_sight);
            return hit ? hit->distance : k_sight;
        };
        float& r = rating[static_cast<size_t>(h)];
        r += 3 * sight(0) / k_sight;
        // Houses on both sides make a street of it.
        for (float off : {-0.5f, -0.25f, 0.25f, 0.5f}) {
            float far = sight(off);
            r += far < 4 ? -1.5f : far < 45 ? 1.0f : 0.0f;
        }
    }
    // In a wall, or so near that it would fill the picture.
    constexpr float k_near_wall = 0.5f;
    for (int h = 0; h < k_headings; ++h) {
        float yaw = static_cast<float>(h) * (2 * k_pi / k_headings);
        if (!raycast(*world.ground, eye, heading_vector(yaw), k_near_wall)) continue;
        for (float& r : rating) r -= 100;
        break;
    }
    return rating;
}

}  // namespace

Camera street_camera(const City& city, const World& world) {
    float best = -1e30f;
    Camera camera;
    for (Vec3 place : places_to_stand(world)) {
        Vec3 eye = place + Vec3{0, k_eye, 0};
        std::vector<float> rating = rate_headings(city, world, eye);
        auto top = std::max_element(rating.begin(), rating.end());
        if (*top <= best) continue;
        best = *top;
        float yaw = static_cast<float>(top - rating.begin()) * (2 * k_pi / k_headings);
        camera = make_camera(eye, eye + heading_vector(yaw) * 10.0f + Vec3{0, -0.35f, 0});
    }
    return camera;
}

Camera crowd_camera(const World& world) {
    constexpr size_t k_sample = 300;
    constexpr int k_sides = 16;
    constexpr float k_near = 12, k_dearth = 0.7f;  // metres; what a view without anybody so near is worth
    constexpr float k_clear = 45;                  // metres to which people count whole, and less beyond
    constexpr float k_throng = 30;                 // metres
    const std::vector<Vec3>& places = world.crowd.motion.position;
    std::vector<Vec3> chests;
    for (size_t i = 0; i < world.crowd.count; i += world.crowd.count / k_sample + 1) {
        if (!is_there(world.crowd, static_cast<uint32_t>(i))) continue;
        chests.push_back(places[i] + Vec3{0, 1.2f, 0});
    }
    if (chests.empty()) return make_camera({0, k_eye, 0}, {0, k_eye, 10});
    auto throng = [&](Vec3 at) {
        return std::count_if(chests.begin(), chests.end(), [&](Vec3 p) { return length(p - at) < k_throng; });
    };
    const Vec3 middle = *std::max_element(chests.begin(), chests.end(),
                                          [&](Vec3 a, Vec3 b) { return throng(a) < throng(b); });
    float best = -1;
    Camera camera;
    for (const float height : {2.0f, 3.0f, 5.0f, 8.0f, 12.0f, 18.0f, 25.0f})
        for (const float away : {8.0f, 15.0f, 25.0f, 40.0f, 60.0f, 90.0f, 140.0f})
            for (int side = 0; side < k_sides; ++side) {
                const Vec3 out = heading_vector(static_cast<float>(side) * (2 * k_pi / k_sides));
                const Vec3 place = middle + out * away;
                const auto ground = ground_at(*world.ground, place + Vec3{0, 300, 0}, 300, 600);
                if (!ground || raycast(*world.ground, place + Vec3{0, 300, 0}, {0, -1, 0}, 300 - 0.5f))
                    continue;
                const Vec3 eye{place.x, ground->height + height, place.z};
                const Camera tried = make_camera(eye, middle + Vec3{0, 1, 0} + out * (0.25f * away));
                const View view = make_view(tried, 16, 9);
                float seen = 0;
                bool is_near = false;
                for (const Vec3 chest : chests) {
                    if (!sees_sphere(view, to_glm(chest), 0.3f) || !sees(*world.ground, eye, chest)) continue;
                    const float distance = length(chest - eye);
                    seen += std::min(1.0f, k_clear / distance);
                    is_near = is_near || distance < k_near;
                }
                const float worth = seen * (is_near ? 1.0f : k_dearth);
                if (worth <= best) continue;
                best = worth;
                camera = tried;
            }
    return camera;
}

namespace {

constexpr float k_hat = 0.1f;  // over the crown; a share of the height of the one who is followed

Vec3 crown_of(const Behind& place) { return place.feet + Vec3{0, place.height, 0}; }

}  // namespace

Vec3 eye_behind(const Behind& place) {
    constexpr float k_behind = 2.35f, k_aside = 0.4f;  // shares of the height
    Vec3 ahead = heading_vector(place.heading + place.round), right{-ahead.z, 0, ahead.x};
    Vec3 away = (ahead * -k_behind + right * k_aside + Vec3{0, k_hat, 0}) * place.height;
    return crown_of(place) + away + Vec3{0, place.lift, 0};
}

float clear_behind(const Ground& ground, const Behind& place) {
    constexpr float k_off_walls = 0.3f, k_least_distance = 0.6f;  // metres
    Vec3 head = crown_of(place), away = eye_behind(place) - head;
    float distance = length(away);
    auto hit = raycast(ground, head, away / distance, distance + k_off_walls);
    return hit ? std::min(distance, std::max(hit->distance - k_off_walls, k_least_distance)) : distance;
}

Camera camera_behind(const Behind& place) {
    constexpr float k_stride = 0.35f;  // how far back a foot gets, a share of the height
    constexpr float k_margin = 0.13f;  // of the picture, above and below in all
    constexpr float k_widest = 1.4f;   // lens, where there is little room
    Vec3 ahead = heading_vector(place.heading + place.round), right{-ahead.z, 0, ahead.x};
    Vec3 head = crown_of(place), eye = head + (eye_behind(place) - head) * place.reach;
    // From the crown of the hat to the sole of the hind foot.
    float away_along = length(on_ground(eye - place.feet)), above = eye.y - place.feet.y;
    float top = std::atan2((1 + k_hat) * place.height - above, away_along);
    float bottom = std::atan2(-above, std::max(away_along - k_stride * place.height, 0.2f));
    float pitch = 0.5f * (top + bottom);
    Camera camera =
        make_camera(eye, eye + (ahead + right * -0.08f) * std::cos(pitch) + Vec3{0, std::sin(pitch), 0});
    camera.vertical_fov = std::clamp((top - bottom) / (1 - k_margin), k_fov, k_widest);
    return camera;
}

uint32_t companion_of(const CameraChoice& choice) {
    return choice.kind == CameraChoice::Kind::follow ? choice.walker : ~0u;
}

Camera follow_camera(const World& world, uint32_t walker, float between) {
    Vec2 velocity = world.crowd.motion.velocity[walker];
    float back = (1 - between) * k_tick;
    Behind place;
    place.feet = world.crowd.motion.position[walker] - Vec3{velocity.x, 0, velocity.z} * back;
    place.heading = world.crowd.motion.heading[walker] - world.crowd.motion.turn_rate[walker] * back;
    place.height =
        world.kinds[world.crowd.identity.body[walker]].body.height * world.crowd.identity.scale[walker];
    place.reach = clear_behind(*world.ground, place) / length(eye_behind(place) - crown_of(place));
    return camera_behind(place);
}

// What stands between two places, and is not seen by rays, as seen from above.
static bool is_beside_obstacles(const Ground& ground, Vec2 from, Vec2 to) {
    constexpr float k_room = 0.2f;  // metres
    const Vec2 way = to - from;
    return std::none_of(ground.obstacles.begin(), ground.obstacles.end(), [&](const Obstacle& o) {
        const Vec2 at = on_ground(o.position);
        const float along = clamp(dot(at - from, way) / std::max(length_squared(way), 1e-6f), 0, 1);
        return length(at - (from + way * along)) < std::max(o.half.x, o.half.z) + k_room;
    });
}

Camera framing_camera(const World& world, Vec3 feet, float height, Vec3 from, float fov) {
    constexpr float k_share = 1.0f / 3, k_least = 1;  // of the picture; metres
    constexpr float k_dips[] = {0.12f, 0.35f, 0.7f};  // radians that one looks down
    constexpr float k_obstacle = 0.8f;                // as much as so many radians round
    const Vec3 middle = feet + Vec3{0, 0.5f * height, 0}, away = from - middle;
    const float distance = std::max(height / k_share / (2 * std::tan(fov / 2)), k_least);
    const float nearest = length(on_ground(away)) > 1e-3f ? heading_of(on_ground(away)) : 0;
    Camera best = make_camera(middle + Vec3{0, distance, 0.01f}, middle);
    float least = 1e9f;
    for (const float dip : k_dips)
        for (int side = 0; side < k_headings; ++side) {
            const float off = wrap_angle(static_cast<float>(side) * (2 * k_pi / k_headings));
            const Vec3 out = heading_vector(nearest + off) * std::cos(dip) + Vec3{0, std::sin(dip), 0};
            const Vec3 eye = middle + out * distance;
            float cost = std::fabs(off) + 2 * dip;
            if (!is_beside_obstacles(*world.ground, on_ground(eye), on_ground(feet))) cost += k_obstacle;
            if (cost >= least || !ground_at(*world.ground, eye, 0, 3 * distance)) continue;
            bool is_seen = true;
            for (const float part : {0.1f, 0.5f, 0.95f})
                is_seen = is_seen && sees(*world.ground, feet + Vec3{0, part * height, 0}, eye + out * 0.3f);
            if (!is_seen) continue;
            least = cost;
            best = make_camera(eye, middle);
        }
    best.vertical_fov = fov;
    return best;
}

Camera choose_camera(const Show& show, const CameraChoice& choice, float fov, Size size, float between) {
    const City& city = *show.loaded.city;
    const World& world = *show.loaded.world;
    auto chosen = [&]() -> Camera {
        switch (choice.kind) {
            case CameraChoice::Kind::overview:
                return overview_camera(world, city.buildings,
                                       {show.sun.direction.x, show.sun.direction.y, show.sun.direction.z});
            case CameraChoice::Kind::street:
                return street_camera(city, world);
            case CameraChoice::Kind::crowd:
                return crowd_camera(world);
            case CameraChoice::Kind::follow:
                if (!world.roam) return follow_camera(world, choice.walker, between);
                [[fallthrough]];
            case CameraChoice::Kind::eyes: {
                CameraRig rig;
                advance(rig, world, choice);
                return camera_of(rig, 0, between);
            }
            case CameraChoice::Kind::map:
                return map_camera(world, choice, size);
            case CameraChoice::Kind::fixed:
                return make_camera(choice.eye, choice.target);
        }
        return {};
    };
    Camera camera = chosen();
    if (fov > 0 && choice.kind != CameraChoice::Kind::map) camera.vertical_fov = fov;
    return camera;
}

}  // namespace flaneur
