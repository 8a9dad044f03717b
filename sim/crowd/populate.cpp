#include <algorithm>
#include <bit>
#include <cassert>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/base/zone.h"
#include "sim/body/personality.h"
#include "sim/crowd/crowd.h"
#include "sim/crowd/errand.h"

namespace flaneur {

static constexpr float k_body_radius = 0.2f;                   // as wide as shoulders are that give way
static constexpr float k_spacing = 2 * k_body_radius + 0.15f;  // between walkers at the start, metres

// Weidmann 1993: free speeds of pedestrians are nearly normal, with a deviation of 0.26 m/s at a mean
// of 1.34.
static constexpr float k_speed_deviation = 0.26f / 1.34f, k_least_speed = 0.7f;

namespace {
// The walkers placed so far by cell of the wrapped plane, as chains.
struct Placed {
    static constexpr uint32_t k_none = ~0u;
    std::vector<NavPoint> places;
    std::vector<uint32_t> head, next;
    uint32_t mask = 0;

    uint32_t cell(int x, int z) const {
        return static_cast<uint32_t>(
                   mix(uint64_t{static_cast<uint32_t>(x)} << 32 | static_cast<uint32_t>(z))) &
               mask;
    }
};
}  // namespace

static int column(float v) { return static_cast<int>(std::floor(v / k_spacing)); }

static bool is_free(const Placed& placed, Vec3 p) {
    for (int z = column(p.z) - 1; z <= column(p.z) + 1; ++z) {
        for (int x = column(p.x) - 1; x <= column(p.x) + 1; ++x) {
            for (uint32_t i = placed.head[placed.cell(x, z)]; i != Placed::k_none; i = placed.next[i]) {
                if (length_squared(placed.places[i].position - p) < k_spacing * k_spacing) return false;
            }
        }
    }
    return true;
}

// Where a place is on a curve that winds through all squares of the ground plane, near ones soon after each
// other (Morton 1966).
static uint64_t along_curve(Vec2 p) {
    constexpr float k_square = 4;  // metres
    auto spread = [](float v) {
        uint64_t bits = static_cast<uint32_t>(static_cast<int>(std::floor(v / k_square)) + (1 << 20));
        bits = (bits | bits << 16) & 0x0000ffff0000ffff;
        bits = (bits | bits << 8) & 0x00ff00ff00ff00ff;
        bits = (bits | bits << 4) & 0x0f0f0f0f0f0f0f0f;
        bits = (bits | bits << 2) & 0x3333333333333333;
        return (bits | bits << 1) & 0x5555555555555555;
    };
    return spread(p.x) | spread(p.z) << 1;
}

static float median(std::vector<float>& values) {
    auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// A crowd too thin for its city keeps there, so that one meets people.
Neighbourhood find_neighbourhood(const Ground& ground, const Navmesh& mesh, uint32_t walkers) {
    constexpr double k_room = 60;  // square metres a walker
    std::vector<float> xs, zs;
    for (const Face& f : ground.faces) {
        if (f.kind != FaceKind::facade) continue;
        xs.push_back((f.a.x + f.b.x) * 0.5f);
        zs.push_back((f.a.z + f.b.z) * 0.5f);
    }
    Neighbourhood n{(ground.low + ground.high) * 0.5f, 20};
    if (!xs.empty()) n.centre = {median(xs), median(zs)};
    float widest = length(ground.high - ground.low);
    while (n.radius < widest && place_area_near(mesh, n.centre, n.radius) < walkers * k_room)
        n.radius *= 1.25f;
    return n;
}

Walker draw_walker(std::span<const Folk> folk, RandomKey key) {
    float total = 0;
    for (const Folk& f : folk) total += f.share;
    float drawn = random_unit(key, 0) * total, before = 0;
    uint32_t body = 0;
    while (body + 1 < folk.size() && drawn >= (before += folk[body].share)) ++body;
    return draw_walker_as(folk, body, key);
}

Walker draw_walker_as(std::span<const Folk> folk, uint32_t body, RandomKey key) {
    Walker w;
    w.body = body;
    const Folk& own = folk[body];
    const Personality personality =
        draw_personality(own.age, own.woman, {key.seed, key.walker, key.when, Purpose::personality});
    const float pace = pace_score(personality, usual_personality(own.age, own.woman), random_normal(key, 1));
    w.preferred_speed = clamp(own.speed * (1 + k_speed_deviation * pace), k_least_speed, own.most);
    w.room = room_share(personality);
    w.patience = patience_share(personality);
    w.linger = linger_share(personality);
    w.radius = k_body_radius;
    w.scale = random_between(key, 0.95f, 1.05f, 2);
    w.stair_pace = own.stair_pace;
    w.ahead = own.ahead * w.scale;
    key.purpose = Purpose::lateral;
    w.lateral = random_between(key, 0.15f, 2.2f);
    return w;
}

void become(Crowd& c, uint32_t i, const Walker& w) {
    CrowdIdentity& who = c.identity;
    who.preferred_speed[i] = w.preferred_speed;
    who.radius[i] = w.radius;
    who.lateral[i] = w.lateral;
    who.body[i] = w.body;
    who.scale[i] = w.scale;
    who.stair_pace[i] = w.stair_pace;
    who.ahead[i] = w.ahead;
    who.room[i] = w.room;
    who.patience[i] = w.patience;
    who.linger[i] = w.linger;
}

// Where a walker might stand; polygon 0: not there.
static NavPoint place_by_chance(const Surroundings& around, const Navmesh& mesh, int thread,
                                const Neighbourhood& home, RandomKey key) {
    NavPoint p = random_place_near(mesh, thread, home.centre, home.radius, random_unit(key, 0),
                                   random_unit(key, 1), random_unit(key, 2));
    const auto hit = ground_at(around, p.position, 1, 2);
    if (!hit) return {};
    p.position.y = hit->height;
    return p;
}

// What those who do not fit would stand on.
static std::string told_ground(const Ground& ground) {
    const bool has_streets = std::any_of(ground.kinds.begin(), ground.kinds.end(), [](Surface kind) {
        return kind == Surface::sidewalk || kind == Surface::path;
    });
    return (has_streets ? "sidewalks, plazas and paths of '" : "ground of '") + ground.name + "'";
}

// One after the other, each where there is room between those before.
static Result<void> set_down(Crowd& c, const Ground& ground, const Surroundings& around, const Navmesh& mesh,
                             Workers& workers, uint32_t walkers, std::span<const Folk> folk, uint64_t seed) {
    FLANEUR_ZONE("set down");
    const Neighbourhood home = find_neighbourhood(ground, mesh, walkers);
    Placed placed;
    placed.mask = std::bit_ceil(std::max(walkers, 512u)) * 2 - 1;
    placed.head.assign(placed.mask + 1, Placed::k_none);
    placed.next.resize(walkers);
    placed.places.reserve(walkers);
    std::vector<NavPoint> first(walkers);
    parallel_for(workers, walkers, 256, [&](size_t begin, size_t end, int thread) {
        for (size_t i = begin; i < end; ++i)
            first[i] = place_by_chance(around, mesh, thread, home,
                                       {seed, static_cast<uint32_t>(i), 0, Purpose::spawn});
    });
    constexpr uint32_t k_attempts = 64;
    for (uint32_t i = 0; i < walkers; ++i) {
        NavPoint place = first[i];
        auto is_good = [&] { return place.polygon != 0 && is_free(placed, place.position); };
        uint32_t attempt = 0;
        while (!is_good() && ++attempt < k_attempts)
            place = place_by_chance(around, mesh, 0, home, {seed, i, attempt, Purpose::spawn});
        if (attempt == k_attempts) {
            // As many as are there would be set down in the same places.
            return Error{"Only " + std::to_string(i) + " of " + std::to_string(walkers) +
                         " walkers fit on the " + told_ground(ground) + ": take no more, or more ground."};
        }
        placed.places.push_back(place);
        uint32_t& head = placed.head[placed.cell(column(place.position.x), column(place.position.z))];
        placed.next[i] = head;
        head = i;
    }
    // Those who are near have slots that are near, so that they find each other in the cache.
    std::stable_sort(placed.places.begin(), placed.places.end(), [](const NavPoint& a, const NavPoint& b) {
        return along_curve(on_ground(a.position)) < along_curve(on_ground(b.position));
    });
    for (uint32_t i = 0; i < walkers; ++i) {
        Walker w = draw_walker(folk, {seed, i, 0, Purpose::body});
        w.place = placed.places[i];
        add_walker(c, around, w);
    }
    return {};
}

static void find_first_paths(Crowd& c, const Navmesh& mesh, Workers& workers, uint64_t seed) {
    FLANEUR_ZONE("first paths");
    parallel_for(workers, c.count, 64, [&](size_t begin, size_t end, int thread) {
        for (size_t i = begin; i < end; ++i) {
            plan_path(c, mesh, thread, static_cast<uint32_t>(i), 0, seed);
            Vec2 ahead = on_ground(c.corners[i * k_corners] - c.motion.position[i]);
            if (c.journeys[i].corner_count == 0 || length_squared(ahead) < 1e-6f) continue;
            c.motion.heading[i] = heading_of(ahead);
        }
    });
}

Result<Crowd> populate(const Ground& ground, const Surroundings& around,
                       std::span<const Destination> destinations, const Navmesh& mesh, Workers& workers,
                       uint32_t walkers, std::span<const Folk> folk, uint64_t seed, float hour,
                       uint32_t capacity, const Leaving& leaving) {
    assert(!folk.empty() || walkers == 0);
    Crowd c = make_crowd(std::max(walkers, capacity));
    c.traffic = make_traffic(mesh);
    c.demand = make_demand(destinations, ground.low, ground.high, mesh, hour, leaving);
    if (Result<void> done = set_down(c, ground, around, mesh, workers, walkers, folk, seed); !done)
        return done.error();
    find_first_paths(c, mesh, workers, seed);
    return c;
}

}  // namespace flaneur
