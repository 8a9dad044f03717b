#include "sim/linkages/linkages.h"

#include <algorithm>
#include <cassert>

#include "sim/base/tick.h"
#include "sim/base/zone.h"
#include "sim/ik/fabrik-inl.h"
#include "sim/ik/fabrik_tree-inl.h"

namespace flaneur {

namespace {

namespace here = HWY_NAMESPACE;
using Point = here::V3<float>;

Point of(Vec3 p) { return {p.x, p.y, p.z}; }
Vec3 of(Point p) { return {p.x, p.y, p.z}; }

// The bones of a chain, from one joint to the next.
std::span<const float> chain_bones(const Linkage& f) { return std::span(f.bones).subspan(1); }

// One iteration for what solve_chain() does not know.
void iterate(const Linkage& f, Point* p, const Point* targets) {
    const int joints = static_cast<int>(f.shape.parents.size());
    const float* bones = chain_bones(f).data();
    if (f.kind == Linkage::Kind::tree) {
        Point offsets[k_most_chain_joints], proposed[k_most_chain_joints];
        here::fabrik_tree(f.shape, p, f.bones.data(), targets, 1, offsets, proposed);
    } else if (f.kind == Linkage::Kind::cones) {
        here::fabrik_limited(p, bones, f.limits.data(), of(f.axis), joints, targets[0], 0.0f, 1);
    } else {
        here::HingeLimit<float> limits[k_most_chain_joints];
        for (int i = 0; i + 1 < joints; ++i)
            limits[i] = here::hinge_limit(f.limits[static_cast<size_t>(i) * 2],
                                          f.limits[static_cast<size_t>(i) * 2 + 1]);
        here::fabrik_hinged(p, bones, limits, of(f.hinge), of(f.axis), joints, targets[0], 0.0f, 1);
    }
}

// The farthest that one of its ends is from where it is led.
float off(const Linkage& f, std::span<const Vec3> places, std::span<const Vec3> targets) {
    float most = 0;
    for (size_t j = 0; j < places.size(); ++j)
        if (const int e = f.shape.effectors[j]; e != k_no_effector)
            most = std::max(most, length(targets[static_cast<size_t>(e)] - places[j]));
    return most;
}

Solved solve_limbs(const Linkage& f, const Patience& patience, std::span<Vec3> places,
                   std::span<const Vec3> targets) {
    Point p[k_most_chain_joints], led[k_most_chain_joints];
    std::ranges::transform(places, p, [](Vec3 place) { return of(place); });
    std::ranges::transform(targets, led, [](Vec3 place) { return of(place); });
    Solved out{0, off(f, places, targets)};
    while (out.iterations < patience.iterations && out.off > patience.tolerance) {
        iterate(f, p, led);
        ++out.iterations;
        for (size_t j = 0; j < places.size(); ++j) places[j] = of(p[j]);
        out.off = off(f, places, targets);
    }
    return out;
}

// Where it begins: at rest, as it was, or between both, its bones turned towards where they rest.
void set_out(const Linkage& f, std::span<Vec3> places, Vec3 root) {
    const Vec3 moved = root - places[0];
    const bool is_between = f.recoil > 0 && f.recoil < 1;
    Vec3 was[k_most_chain_joints];
    std::ranges::copy(places, was);
    for (size_t j = 0; j < places.size(); ++j) {
        if (!is_between || j == 0) {
            places[j] = f.recoil >= 1 ? root + f.rest[j] : places[j] + moved;
            continue;
        }
        const auto parent = static_cast<size_t>(f.shape.parents[j]);
        const Vec3 bone = lerp(was[j] - was[parent], f.rest[j] - f.rest[parent], f.recoil);
        places[j] = places[parent] + normalize_or(bone, {0, 1, 0}) * f.bones[j];
    }
}

// Where a target is next that is at `now` and nobody holds.
Vec3 returning(Vec3 now, Vec3 sway) {
    const Vec3 way = sway - now;
    const float distance = length(way), most = k_return_speed * k_tick;
    return distance > most ? now + way * (most / distance) : sway;
}

}  // namespace

bool takes(const Linkage& f, const Method& method) {
    const bool is_patient = method.patience.tolerance > 0 && method.patience.iterations >= 1;
    if (f.kind != Linkage::Kind::chain) return is_patient && method.solver == Solver::fabrik;
    return is_patient && (method.solver != Solver::two_bone || f.rest.size() == 3);
}

Solved solve_linkage(const Linkage& f, const Method& method, std::span<Vec3> places,
                     std::span<const Vec3> targets) {
    assert(takes(f, method));
    if (f.kind == Linkage::Kind::chain)
        return solve_chain(method.solver, places, chain_bones(f), targets[0], method.patience);
    return solve_limbs(f, method.patience, places, targets);
}

std::span<Vec3> places_of(Linkages& linkages, size_t number) {
    return std::span(linkages.places)
        .subspan(linkages.ranges[number].joints, linkages.all[number].rest.size());
}

Linkages make_linkages(std::vector<Linkage> all) {
    Linkages linkages;
    linkages.all = std::move(all);
    for (const Linkage& f : linkages.all) {
        linkages.ranges.push_back(
            {static_cast<uint32_t>(linkages.places.size()), static_cast<uint32_t>(linkages.targets.size())});
        assert(f.leads.size() == static_cast<size_t>(f.shape.targets));
        const Vec3 root = sway_at(f.root, 0);
        for (const Vec3 rest : f.rest) linkages.places.push_back(root + rest);
        for (const Sway& lead : f.leads) linkages.targets.push_back(sway_at(lead, 0));
        linkages.methods.push_back(f.method);
    }
    linkages.previous_places = linkages.places;
    linkages.previous_targets = linkages.targets;
    linkages.solved.resize(linkages.all.size());
    linkages.solve_ms.resize(linkages.all.size());
    linkages.held.resize(linkages.targets.size());
    return linkages;
}

void step_linkages(Linkages& linkages, Workers& workers, uint32_t tick) {
    linkages.previous_places = linkages.places;
    linkages.previous_targets = linkages.targets;
    parallel_for(workers, linkages.all.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) {
            const Linkage& f = linkages.all[i];
            if (f.kind == Linkage::Kind::led) continue;
            FLANEUR_ZONE("linkage", linkages.solve_ms[i]);
            const uint32_t first = linkages.ranges[i].targets;
            const std::span targets = std::span(linkages.targets).subspan(first, f.leads.size());
            for (size_t e = 0; e < targets.size(); ++e) {
                const HeldTarget& held = linkages.held[first + e];
                targets[e] = held.is_held ? held.place : returning(targets[e], sway_at(f.leads[e], tick + 1));
            }
            const std::span places = places_of(linkages, i);
            set_out(f, places, sway_at(f.root, tick + 1));
            linkages.solved[i] = solve_linkage(f, linkages.methods[i], places, targets);
        }
    });
}

}  // namespace flaneur
