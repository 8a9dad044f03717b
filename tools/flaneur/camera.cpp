#include "tools/flaneur/camera.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "sim/base/math.h"
#include "tools/flaneur/convert.h"

namespace flaneur {

namespace {

constexpr float k_fov = 0.557f;      // 32 degrees upright: 54 across at 16:9, a 35 mm lens
constexpr float k_eye = 1.6f;        // of the street camera, metres
constexpr float k_sight = 60;        // how far ahead it cares, metres
constexpr size_t k_candidates = 48;  // places that it tries
constexpr int k_headings = 24;
constexpr float k_half_view = 0.45f;  // radians, on the ground plane

Camera make_camera(Vec3 eye, Vec3 target) {
    Camera camera;
    camera.eye = to_glm(eye);
    camera.target = to_glm(target);
    camera.vertical_fov = k_fov;
    return camera;
}

bool sees(const City& city, Vec3 from, Vec3 to) {
    Vec3 way = to - from;
    float distance = length(way);
    return distance < 1e-3f || !raycast(city, from, way / distance, distance);
}

Vec3 heading_vector(float yaw) {
    Vec2 d = heading_direction(yaw);
    return {d.x, 0, d.z};
}

// Where walkers stand who have most others around, as places to look from; the city's middle if there is
// nobody.
std::vector<Vec3> places_to_stand(const World& world) {
    const City& city = world.city;
    Vec2 middle = (city.low + city.high) * 0.5f;
    constexpr size_t k_sample = 1000;
    constexpr float k_company = 25;
    size_t stride = world.crowd.count / k_sample + 1;
    std::vector<std::pair<float, uint32_t>> ids;
    for (size_t i = 0; i < world.crowd.count; i += stride) {
        float company = 0;
        for (size_t j = 0; j < world.crowd.count; j += stride) {
            float distance = length(world.crowd.position[i] - world.crowd.position[j]);
            if (distance < k_company) company += 1 - distance / k_company;
        }
        ids.push_back({-company, static_cast<uint32_t>(i)});
    }
    size_t kept = std::min(k_candidates, ids.size());
    std::partial_sort(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(kept), ids.end());
    std::vector<Vec3> places;
    for (size_t i = 0; i < kept; ++i) places.push_back(world.crowd.position[ids[i].second]);
    if (!places.empty()) return places;
    for (float x = -40; x <= 40; x += 8) {
        for (float z = -40; z <= 40; z += 8) {
            Vec3 above{middle.x + x, 500, middle.z + z};
            if (auto hit = ground(city, above, 500, 1500)) places.push_back({above.x, hit->height, above.z});
        }
    }
    if (places.empty()) places.push_back({middle.x, 0, middle.z});
    return places;
}

// How good the view from `eye` is in each direction.
std::vector<float> rate_headings(const World& world, Vec3 eye) {
    std::vector<float> rating(k_headings, 0.0f);
    auto add = [&](Vec3 at, float worth) {
        float yaw = heading_of({at.x - eye.x, at.z - eye.z});
        for (int h = 0; h < k_headings; ++h) {
            float off = wrap_angle(yaw - static_cast<float>(h) * (2 * k_pi / k_headings));
            if (std::fabs(off) < k_half_view) rating[static_cast<size_t>(h)] += worth;
        }
    };
    for (uint32_t i = 0; i < world.crowd.count; ++i) {
        Vec3 chest = world.crowd.position[i] + Vec3{0, 1.3f, 0};
        float distance = length(chest - eye);
        if (distance > k_sight || distance < 0.35f) continue;  // far off, or whose eye it is
        if (distance < 3) {
            add(chest, distance < 1.5f ? -20 : -2);  // would fill the picture
        } else if (sees(world.city, eye, chest)) {
            add(chest, 6 / (6 + distance));
        }
    }
    for (const Prop& prop : world.city.props) {
        float distance = length(Vec2{prop.position.x - eye.x, prop.position.z - eye.z});
        if (distance < 5) add(prop.position, prop.kind == PropKind::bollard ? -0.5f : -3);
    }
    for (int h = 0; h < k_headings; ++h) {
        float yaw = static_cast<float>(h) * (2 * k_pi / k_headings);
        auto sight = [&](float off) {
            auto hit = raycast(world.city, eye, heading_vector(yaw + off), k_sight);
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
    return rating;
}

// Tops of facades near the middle, at most so many, as what an overview has to show.
struct Front {
    Vec3 top;
    Vec3 out;
};
std::vector<Front> fronts_near(const City& city, Vec2 middle) {
    constexpr float k_near = 400;
    constexpr size_t k_most = 240;
    std::vector<Front> all, kept;
    for (const Face& f : city.faces) {
        Vec2 a = on_ground(f.a), b = on_ground(f.b), centre = (a + b) * 0.5f;
        if (f.kind != FaceKind::facade || length(b - a) < 4 || length(centre - middle) > k_near) continue;
        Vec2 along = normalize_or(b - a, {1, 0});
        all.push_back({at_height(centre, (f.a_top + f.b_top) * 0.5f), {-along.z, 0, along.x}});
    }
    for (size_t i = 0; i < all.size(); i += all.size() / k_most + 1) kept.push_back(all[i]);
    return kept;
}

}  // namespace

Camera overview_camera(const World& world, Vec3 to_sun) {
    // Over a street near the middle, looking the way that shows most people and houses in the light; at
    // `k_dip` the horizon lies in the upper fifth of the picture.
    constexpr float k_height = 35, k_dip = 0.172f, k_reach = 170;
    constexpr size_t k_places = 16, k_people = 400;
    const City& city = world.city;
    Vec2 middle = (city.low + city.high) * 0.5f;
    std::vector<std::pair<float, Vec3>> streets;
    for (size_t t = 0; t < city.ground_kinds.size(); ++t) {
        Surface kind = city.ground_kinds[t];
        if (kind != Surface::crossing && kind != Surface::plaza && kind != Surface::road) continue;
        Vec3 p = city.ground_vertices[city.ground_indices[3 * t]];
        streets.push_back({length(on_ground(p) - middle), p});
    }
    std::sort(streets.begin(), streets.end(), [](const auto& a, const auto& b) {
        return std::tie(a.first, a.second.x, a.second.z) < std::tie(b.first, b.second.x, b.second.z);
    });
    std::vector<Vec3> places;
    for (const auto& street : streets) {
        Vec3 p = street.second;
        auto near = [&](Vec3 q) { return length(on_ground(q) - on_ground(p)) < 25; };
        if (places.size() < k_places && std::none_of(places.begin(), places.end(), near)) places.push_back(p);
    }
    if (places.empty()) places.push_back(at_height(middle, 0));
    std::vector<Front> fronts = fronts_near(city, middle);

    float best = -1;
    Camera camera;
    for (Vec3 place : places) {
        Vec3 eye = place + Vec3{0, k_height, 0};
        if (raycast(city, place + Vec3{0, 1, 0}, {0, 1, 0}, k_height)) continue;
        std::vector<float> rating(k_headings, 0.0f);
        auto add = [&](Vec3 at, float worth) {
            float yaw = heading_of(on_ground(at - eye));
            for (int h = 0; h < k_headings; ++h) {
                float off = wrap_angle(yaw - static_cast<float>(h) * (2 * k_pi / k_headings));
                if (std::fabs(off) < k_half_view) rating[static_cast<size_t>(h)] += worth;
            }
        };
        for (const Front& front : fronts) {
            Vec3 at = front.top + front.out * 0.3f;
            float distance = length(at - eye);
            if (distance < 1.6f * k_height || dot(front.out, eye - at) <= 0 || !sees(city, eye, at)) continue;
            add(at, 1 + 3 * std::max(0.0f, dot(front.out, to_sun)));
        }
        size_t stride = std::max<size_t>(1, world.crowd.count / k_people);
        for (size_t i = 0; i < world.crowd.count; i += stride) {
            Vec3 chest = world.crowd.position[i] + Vec3{0, 1.3f, 0};
            float distance = length(chest - eye);
            if (distance > k_reach || distance < 1.6f * k_height || !sees(city, eye, chest)) continue;
            add(chest, 1);
        }
        for (int h = 0; h < k_headings; ++h) {
            float yaw = static_cast<float>(h) * (2 * k_pi / k_headings);
            Vec3 ahead = heading_vector(yaw) * (k_height / k_dip) - Vec3{0, k_height, 0};
            float far = length(ahead);
            auto hit = raycast(city, eye, ahead / far, far);
            float open = hit ? hit->distance / far : 1;
            float rated = rating[static_cast<size_t>(h)] * 0.2f + 3 * open;
            if (rated <= best) continue;
            best = rated;
            camera = make_camera(eye, eye + ahead);
        }
    }
    return camera;
}

Camera street_camera(const World& world) {
    float best = -1e30f;
    Camera camera;
    for (Vec3 place : places_to_stand(world)) {
        Vec3 eye = place + Vec3{0, k_eye, 0};
        std::vector<float> rating = rate_headings(world, eye);
        auto top = std::max_element(rating.begin(), rating.end());
        if (*top <= best) continue;
        best = *top;
        float yaw = static_cast<float>(top - rating.begin()) * (2 * k_pi / k_headings);
        camera = make_camera(eye, eye + heading_vector(yaw) * 10.0f + Vec3{0, -0.35f, 0});
    }
    return camera;
}

Camera follow_camera(const World& world, uint32_t walker, float between) {
    Vec2 velocity = world.crowd.velocity[walker];
    float back = (1 - between) * k_tick;
    Vec3 feet = world.crowd.position[walker] - Vec3{velocity.x, 0, velocity.z} * back;
    Vec3 ahead = heading_vector(world.crowd.heading[walker] - world.crowd.turn_rate[walker] * back);
    Vec3 head = feet + Vec3{0, 1.6f, 0};
    Vec3 right{-ahead.z, 0, ahead.x};
    Vec3 away = ahead * -3.5f + Vec3{0, 0.4f, 0} + right * 0.5f;  // over the right shoulder
    float distance = length(away);
    Vec3 direction = away / distance;
    if (auto hit = raycast(world.city, head, direction, distance + 0.3f))
        distance = std::max(hit->distance - 0.3f, 0.6f);
    return make_camera(head + direction * distance, feet + Vec3{0, 1.25f, 0} + ahead * 2.5f + right * 0.2f);
}

Camera choose_camera(const World& world, const Sun& sun, const CameraChoice& choice, float between) {
    switch (choice.kind) {
        case CameraChoice::Kind::overview:
            return overview_camera(world, {sun.direction.x, sun.direction.y, sun.direction.z});
        case CameraChoice::Kind::street:
            return street_camera(world);
        case CameraChoice::Kind::follow:
            return follow_camera(world, choice.walker, between);
        case CameraChoice::Kind::fixed:
            return make_camera(choice.eye, choice.target);
    }
    return {};
}

}  // namespace flaneur
