#include <algorithm>
#include <chrono>
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"

namespace flaneur {

namespace {

constexpr uint32_t k_points = 1 << 16;
constexpr float k_foot_up = 0.45f, k_foot_down = 0.8f;  // as feet ask
constexpr float k_hand_reach = 0.8f;                    // metres, as hands ask
constexpr float k_hand_height = 1.1f, k_eye_height = 1.6f, k_sight = 30;
constexpr double k_ground_goal = 60, k_wall_goal = 150;

// Anywhere that people like to walk, in no order.
std::vector<Vec3> random_points(const City& city, const Navmesh& mesh) {
    std::vector<Vec3> points;
    for (uint32_t i = 0; i < k_points; ++i) {
        RandomKey key{1, i, 0, Purpose::spawn};
        Vec3 p =
            random_place(mesh, 0, random_unit(key, 0), random_unit(key, 1), random_unit(key, 2)).position;
        if (auto hit = ground_at(city.ground, p, 1, 2)) p.y = hit->height;
        points.push_back(p);
    }
    return points;
}

// Where feet come down: four points of either sole, walker by walker.
std::vector<Vec3> foot_points(const Crowd& crowd) {
    std::vector<Vec3> points;
    for (uint32_t i = 0; i < crowd.count; ++i) {
        Vec2 ahead = heading_direction(crowd.motion.heading[i]), left{ahead.z, -ahead.x};
        for (float side : {0.08f, -0.08f}) {
            for (float along : {0.25f, 0.32f, 0.45f, 0.5f})
                points.push_back(crowd.motion.position[i] + at_height(ahead * along + left * side, 0));
        }
    }
    return points;
}

std::vector<Vec3> raised(std::vector<Vec3> points, float height) {
    for (Vec3& p : points) p.y += height;
    return points;
}

// Nanoseconds that each call of query(point, index) takes; it returns whether it found something.
template <class Query>
Kernel kernel(const std::string& name, const std::vector<Vec3>& points, double goal, const Query& query) {
    auto ns = [&points, query] {
        size_t found = 0;
        double each = ns_each(points.size(), [&] {
            for (size_t i = 0; i < points.size(); ++i) found += query(points[i], i);
        });
        return found == ~size_t{0} ? 0 : each;  // what is counted is not left out
    };
    return {name, ns, {goal, goal, goal}};
}

}  // namespace

Result<Figures> bench_city(const Options& options) {
    auto start = std::chrono::steady_clock::now();
    Result<City> read = read_city(options.scene);
    if (!read) return read.error();
    City city = std::move(*read);
    double import_ms = ms_since(start);

    WorkersPtr workers = make_workers(options.threads);
    int threads = thread_count(*workers);
    start = std::chrono::steady_clock::now();
    Result<NavmeshPtr> mesh = build_navmesh(city.ground, {}, threads, [](float share) {
        show_progress("building the navigation mesh " + std::to_string(static_cast<int>(share * 100)) + " %");
        return !is_stopping();
    });
    clear_progress();
    if (!mesh) return mesh.error();
    double navmesh_ms = ms_since(start);
    std::string kept = navmesh_bytes(**mesh);
    start = std::chrono::steady_clock::now();
    mesh = restore_navmesh(city.ground, {}, kept, threads);
    if (!mesh) return mesh.error();
    double restore_ms = ms_since(start);

    Folk anyone;
    Result<Crowd> crowd = populate(city.ground, surroundings_of(city.ground), city.destinations, **mesh,
                                   *workers, static_cast<uint32_t>(options.scene.walkers), {&anyone, 1},
                                   options.scene.seed, options.scene.hour);
    if (!crowd) return crowd.error();
    for (uint32_t tick = 0; tick < options.warm_up; ++tick)
        step_crowd(*crowd, surroundings_of(city.ground), **mesh, *workers, tick, options.scene.seed);

    std::vector<Vec3> anywhere = random_points(city, **mesh), feet = foot_points(*crowd);
    std::vector<Vec3> eyes = raised(anywhere, k_eye_height), hands = raised(anywhere, k_hand_height),
                      near_feet = raised(feet, k_hand_height);
    auto on_ground_at = [&](Vec3 p, size_t) {
        return ground_at(city.ground, p, k_foot_up, k_foot_down).has_value();
    };
    auto wall_at = [&](Vec3 p, size_t) { return closest_wall(city.ground, p, k_hand_reach).has_value(); };
    auto seen_from = [&](Vec3 p, size_t i) {
        Vec2 way = heading_direction(static_cast<float>(i % 628) * 0.01f - 3.14f);
        return raycast(city.ground, p, at_height(way, 0), k_sight).has_value();
    };
    auto ground_of_all = [&city](const std::string& name, const std::vector<Vec3>& points) {
        auto ns = [&city, &points, hits = std::vector<std::optional<GroundHit>>(points.size())]() mutable {
            return ns_each(points.size(),
                           [&] { ground_at(city.ground, points, k_foot_up, k_foot_down, hits.data()); });
        };
        return Kernel{name, ns, {k_ground_goal, k_ground_goal, k_ground_goal}};
    };
    std::vector<Kernel> kernels = {kernel("ground, anywhere", anywhere, k_ground_goal, on_ground_at),
                                   ground_of_all("ground, anywhere, in batches", anywhere),
                                   kernel("wall, anywhere", hands, k_wall_goal, wall_at),
                                   kernel("ray, anywhere", eyes, 0, seen_from)};
    if (!feet.empty()) {
        kernels.push_back(kernel("ground, feet", feet, k_ground_goal, on_ground_at));
        kernels.push_back(ground_of_all("ground, feet, in batches", feet));
        kernels.push_back(kernel("wall, feet", near_feet, k_wall_goal, wall_at));
    }
    // They take turns, so that a busy neighbour meets all.
    std::vector<std::vector<double>> samples(kernels.size());
    for (uint32_t r = 0; r < options.bench_frames; ++r) {
        if (is_stopping()) return interrupted();
        for (size_t k = 0; k < kernels.size(); ++k) samples[k].push_back(kernels[k].ns());
    }

    Figures figures;
    figures.setting = {{"city", city_name(options.scene)},
                       {"walkers", crowd->count},
                       {"threads", threads},
                       {"measured", options.bench_frames}};
    figures.counts = {{"import ms", import_ms},
                      {"navmesh ms", navmesh_ms},
                      {"navmesh kept ms", restore_ms},
                      {"ground triangles", static_cast<double>(city.ground.kinds.size())},
                      {"faces", static_cast<double>(city.ground.faces.size())}};
    print_setting(figures);
    for (const auto& [name, value] : figures.counts) std::printf("%-20s %9.0f\n", name.c_str(), value);
    std::printf("\n%-20s %9s %9s %9s\n", "ns a query", "median", "least", "goal");
    for (size_t k = 0; k < kernels.size(); ++k) {
        const double goal = kernels[k].goals[0];
        std::printf("%-20s %9.1f %9.1f", kernels[k].name.c_str(), quantile(samples[k], 0.5),
                    *std::min_element(samples[k].begin(), samples[k].end()));
        if (goal > 0) std::printf(" %9.0f", goal);
        std::printf("\n");
        add_kernel(figures, kernels[k].name, samples[k]);
    }
    return figures;
}

}  // namespace flaneur
