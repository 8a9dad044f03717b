#include "tools/flaneur/window/change/people.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/tick.h"

namespace flaneur {

namespace {

constexpr float k_sight = 150, k_chest = 1.2f, k_half_view = 0.6f;  // metres, and the cosine
constexpr uint32_t k_tries = 16;                                    // places out of sight that are tried,
constexpr uint32_t k_more_tries = 64;                               // and places at all

Vec3 from_glm(glm::vec3 v) { return {v.x, v.y, v.z}; }

// A place by chance; `count` and `tries` make it another each time.
Vec3 draw_place(const World& w, const Neighbourhood& home, uint32_t count, uint32_t tries) {
    const RandomKey key{w.seed ^ w.tick, count, tries, Purpose::spawn};
    return random_place_near(*w.navmesh, 0, home.centre, home.radius, random_unit(key, 0),
                             random_unit(key, 1), random_unit(key, 2))
        .position;
}

bool add_one(World& w, const Neighbourhood& home, const Camera& camera) {
    const auto count = static_cast<uint32_t>(walkers(w).size());
    for (uint32_t t = 0; t < k_more_tries; ++t) {
        WalkerOptions options;
        options.place = draw_place(w, home, count, t);
        options.wanders = true;
        options.heading = random_between({w.seed ^ w.tick, count, t, Purpose::spawn}, -k_pi, k_pi, 3);
        if (t < k_tries && may_see(*w.ground, camera, *options.place)) continue;
        if (add_walker(w, options)) return true;
    }
    return false;
}

// By chance all over the city, so that those who stay are spread as all were; but nobody close by vanishes
// while others are left.
void remove_some(World& w, uint32_t count, const Camera& camera, std::optional<uint32_t> kept) {
    constexpr float k_close = 30;  // metres
    struct Candidate {
        float order;
        WalkerId id;
    };
    std::vector<Candidate> all;
    const Vec3 eye = from_glm(camera.eye);
    for (const WalkerId id : walkers(w)) {
        if (is_creature(w.herd, id.index)) continue;
        const Vec3 at = w.crowd.motion.position[id.index];
        float order = random_unit({w.seed ^ w.tick, id.index, 0, Purpose::spawn}, 4);
        if (length(at - eye) < k_close && may_see(*w.ground, camera, at)) order += 1;
        if (kept == id.index) order = 2;
        all.push_back({order, id});
    }
    count = std::min(count, static_cast<uint32_t>(all.size()));
    std::partial_sort(all.begin(), all.begin() + count, all.end(),
                      [](const Candidate& a, const Candidate& b) {
                          return a.order != b.order ? a.order < b.order : a.id.index < b.id.index;
                      });
    for (uint32_t i = 0; i < count; ++i) remove_walker(w, all[i].id);
}

}  // namespace

bool may_see(const Ground& ground, const Camera& camera, Vec3 place) {
    const Vec3 eye = from_glm(camera.eye), way = place + Vec3{0, k_chest, 0} - eye;
    const float distance = length(way);
    if (distance > k_sight) return false;
    if (distance < 1) return true;
    const Vec3 ahead = normalize_or(from_glm(camera.target - camera.eye), {0, 0, 1});
    if (dot(way, ahead) < k_half_view * distance) return false;
    return !raycast(ground, eye, way / distance, distance);
}

Result<bool> approach(World& w, uint32_t people, uint32_t most, const Neighbourhood& home,
                      const Camera& camera, std::optional<uint32_t> kept) {
    const uint32_t there = kept_people(w);
    if (there > people) {
        remove_some(w, std::min(there - people, most), camera, kept);
        return there - people <= most;
    }
    const uint32_t slots = people + static_cast<uint32_t>(w.herd.goes_as.size());
    if (slots > w.crowd.capacity) make_room(w, std::max(slots, w.crowd.capacity + w.crowd.capacity / 2));
    const uint32_t missing = people - there;
    for (uint32_t i = 0; i < std::min(missing, most); ++i)
        if (!add_one(w, home, camera))
            return Error{"No more than " + std::to_string(people_count(w)) +
                         " people find room here: take fewer, or more ground."};
    return missing <= most;
}

}  // namespace flaneur
