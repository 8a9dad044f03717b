// Ways of inverse kinematics beside each other: chains of ten joints, as in table 8 of "An implementation
// guide to procedural animation", which is from Aristidou & Lasenby (2011), and trees by chance.
#include <cstdio>

#include "sim/base/math.h"
#include "sim/base/rng.h"
#include "sim/linkages/linkages.h"
#include "tools/flaneur/bench/bench.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"

namespace flaneur {

namespace {

constexpr int k_joints = 10;
constexpr float k_bone = 0.1f;  // metres
constexpr int k_tries = 1000, k_most = 5000;
constexpr float k_tolerance = 0.001f;  // of the chain's length

// By the table, iterations.
struct Row {
    Solver solver;
    double table;
};
constexpr Row k_rows[] = {{Solver::fabrik, 15.461},
                          {Solver::ccd, 26.308},
                          {Solver::transpose, 1311.190},
                          {Solver::damped, 998.648}};

struct Tried {
    std::vector<double> iterations;
    std::vector<double> ms;  // a solution, the mean of each batch
    double us = 0;           // a solution
    int missed = 0;
};

// Evenly in the ball that the chain reaches.
Vec3 target_of(uint32_t n, float reach) {
    Vec3 p;
    uint32_t draw = 0;
    do {
        for (float* x : {&p.x, &p.y, &p.z}) *x = random_between({1, n}, -reach, reach, draw++);
    } while (length(p) > reach);
    return p;
}

template <class Solve>
Tried try_all(int tries, float tolerance, const Solve& solve) {
    constexpr int k_batches = 20;
    Tried out;
    const int each = tries / k_batches;
    for (int batch = 0; batch < k_batches; ++batch) {
        const auto start = std::chrono::steady_clock::now();
        for (int n = batch * each; n < (batch + 1) * each; ++n) {
            const Solved solved = solve(static_cast<uint32_t>(n));
            out.iterations.push_back(solved.iterations);
            out.missed += solved.off > tolerance;
        }
        out.ms.push_back(ms_since(start) / each);
    }
    for (const double ms : out.ms) out.us += 1000 * ms / k_batches;
    return out;
}

Tried try_solver(Solver solver) {
    const Linkage rest = chain_linkage(k_joints, k_bone, solver);
    constexpr float k_reach = k_bone * (k_joints - 1);
    const std::span bones = std::span(rest.bones).subspan(1);
    return try_all(k_tries, k_tolerance * k_reach, [&](uint32_t n) {
        std::vector<Vec3> places = rest.rest;
        return solve_chain(solver, places, bones, target_of(n, k_reach), {k_tolerance * k_reach, k_most});
    });
}

// Trees by chance whose tips are to go where they were before all joints turned by chance.
Tried try_trees(int joints) {
    constexpr int k_trees = 200;
    return try_all(k_trees, k_tolerance * k_bone * k_joints, [&](uint32_t n) {
        Linkage tree = random_tree_linkage(joints, k_bone, n + 1);
        tree.method.patience = {k_tolerance * k_bone * k_joints, k_most};
        std::vector<Vec3> turned(tree.rest.size());
        for (size_t j = 1; j < turned.size(); ++j) {
            const auto parent = static_cast<size_t>(tree.shape.parents[j]);
            const Vec3 bone = tree.rest[j] - tree.rest[parent];
            const Vec3 by = target_of(static_cast<uint32_t>(j) + 100 * n, 0.7f);
            turned[j] =
                turned[parent] + normalize_or(normalize_or(bone, {0, 1, 0}) + by, {0, 1, 0}) * tree.bones[j];
        }
        std::vector<Vec3> targets(tree.leads.size());
        for (size_t j = 0; j < turned.size(); ++j)
            if (const int e = tree.shape.effectors[j]; e != k_no_effector)
                targets[static_cast<size_t>(e)] = turned[j];
        std::vector<Vec3> places = tree.rest;
        return solve_linkage(tree, tree.method, places, targets);
    });
}

double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double v : values) sum += v;
    return sum / static_cast<double>(values.size());
}

void tell(Figures& figures, const std::string& name, const Tried& tried, double table) {
    const double average = mean(tried.iterations), median = quantile(tried.iterations, 0.5);
    char beside[16] = "";
    if (table > 0) std::snprintf(beside, sizeof beside, "%.1f", table);
    std::printf("%-26s %10.1f %8.0f %10s %9.2f %12.3f %9d\n", name.c_str(), average, median, beside, tried.us,
                tried.us / average, tried.missed);
    figures.counts.emplace_back(name + ", iterations", average);
    figures.series.push_back({name, tried.ms, {}, "ns"});
    figures.counts.emplace_back(name + ", missed", tried.missed);
}

}  // namespace

Result<Figures> bench_ik() {
    Figures figures;
    figures.setting = {{"joints", k_joints}, {"targets", k_tries}};
    std::printf(
        "%d targets all over the reach of a chain of %d joints that is bowed a little, to a thousandth of "
        "its\n"
        "length, %d iterations at most; then trees by chance, whose tips are to go where they have been\n\n",
        k_tries, k_joints, k_most);
    std::printf("%-26s %10s %8s %10s %9s %12s %9s\n", "", "iterations", "median", "table", "us",
                "us/iteration", "missed");
    for (const Row& row : k_rows) {
        const auto number = static_cast<size_t>(row.solver);
        show_progress(std::string(k_solver_names[number]));
        const Tried tried = try_solver(row.solver);
        clear_progress();
        if (is_stopping()) return interrupted();
        tell(figures, std::string(k_solver_names[number]), tried, row.table);
    }
    for (const int joints : {8, 16, 32, 64}) {
        const Tried tried = try_trees(joints);
        if (is_stopping()) return interrupted();
        tell(figures, "FABRIK, trees of " + std::to_string(joints), tried, 0);
    }
    std::printf(
        "\ntable: average iterations by Aristidou & Lasenby (2011), who give neither tolerance nor "
        "targets\n");
    return figures;
}

}  // namespace flaneur
