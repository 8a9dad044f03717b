#include "sim/linkages/linkages.h"

#include <algorithm>
#include <cassert>

#include "sim/base/math.h"
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

Solved solve_limbs(const Linkage& f, std::span<Vec3> places, std::span<const Vec3> targets) {
    Point p[k_most_chain_joints], led[k_most_chain_joints];
    std::ranges::transform(places, p, [](Vec3 place) { return of(place); });
    std::ranges::transform(targets, led, [](Vec3 place) { return of(place); });
    Solved out{0, off(f, places, targets)};
    while (out.iterations < f.patience.iterations && out.off > f.patience.tolerance) {
        iterate(f, p, led);
        ++out.iterations;
        for (size_t j = 0; j < places.size(); ++j) places[j] = of(p[j]);
        out.off = off(f, places, targets);
    }
    return out;
}

// Where it begins: at rest, or as it was.
void set_out(const Linkage& f, std::span<Vec3> places, Vec3 root) {
    const Vec3 moved = root - places[0];
    for (size_t j = 0; j < places.size(); ++j) places[j] = f.is_eager ? root + f.rest[j] : places[j] + moved;
}

}  // namespace

Solved solve_linkage(const Linkage& f, std::span<Vec3> places, std::span<const Vec3> targets) {
    if (f.kind == Linkage::Kind::chain)
        return solve_chain(f.solver, places, chain_bones(f), targets[0], f.patience);
    return solve_limbs(f, places, targets);
}

Vec3 sway_at(const Sway& sway, uint32_t tick) {
    auto wave = [&](int axis) {
        const uint32_t period = sway.period[axis];
        const uint32_t at = (tick % period + sway.start[axis]) % period;
        return sin_cos(2 * k_pi * static_cast<float>(at) / static_cast<float>(period)).sine;
    };
    return sway.middle + Vec3{sway.reach.x * wave(0), sway.reach.y * wave(1), sway.reach.z * wave(2)};
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
    }
    linkages.previous_places = linkages.places;
    linkages.previous_targets = linkages.targets;
    linkages.solved.resize(linkages.all.size());
    return linkages;
}

void step_linkages(Linkages& linkages, Workers& workers, uint32_t tick) {
    linkages.previous_places = linkages.places;
    linkages.previous_targets = linkages.targets;
    parallel_for(workers, linkages.all.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) {
            const Linkage& f = linkages.all[i];
            if (f.kind == Linkage::Kind::led) continue;
            const std::span targets =
                std::span(linkages.targets).subspan(linkages.ranges[i].targets, f.leads.size());
            std::ranges::transform(f.leads, targets.begin(),
                                   [&](const Sway& lead) { return sway_at(lead, tick + 1); });
            const std::span places = places_of(linkages, i);
            set_out(f, places, sway_at(f.root, tick + 1));
            linkages.solved[i] = solve_linkage(f, places, targets);
        }
    });
}

}  // namespace flaneur
