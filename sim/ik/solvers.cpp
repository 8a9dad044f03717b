#include "sim/ik/solvers.h"

#include <algorithm>
#include <cassert>

#include "sim/base/math.h"
#include "sim/ik/fabrik-inl.h"
#include "sim/ik/solve.h"
#include "sim/ik/two_bone-inl.h"

namespace flaneur {

namespace {

namespace here = HWY_NAMESPACE;

struct Chain {
    std::span<Vec3> places;
    std::span<const float> bones;
    Vec3 target;
};

Vec3 to_target(const Chain& c) { return c.target - c.places.back(); }

here::V3<float> of(Vec3 p) { return {p.x, p.y, p.z}; }
Vec3 of(here::V3<float> p) { return {p.x, p.y, p.z}; }

void reach(const Chain& c) {
    here::V3<float> p[k_most_chain_joints];
    std::ranges::transform(c.places, p, [](Vec3 place) { return of(place); });
    here::fabrik(p, c.bones.data(), static_cast<int>(c.places.size()), of(c.target), 0.0f, 1);
    for (size_t i = 0; i < c.places.size(); ++i) c.places[i] = of(p[i]);
}

// Sets bone i, which began at `before`, where it now begins, turned; `before` becomes where it ended.
void turn_bone(const Chain& c, size_t i, Quat turn, Vec3& before) {
    const Vec3 bone = rotate(turn, c.places[i + 1] - before);
    before = c.places[i + 1];
    c.places[i + 1] = c.places[i] + normalize_or(bone, {0, 1, 0}) * c.bones[i];
}

// Turns bone i, and all after it, by turns[0] .. turns[i], the last of them first.
void turn_bones(const Chain& c, const Quat* turns) {
    Quat turn{0, 0, 0, 1};
    Vec3 before = c.places[0];
    for (size_t i = 0; i < c.bones.size(); ++i) {
        turn = normalize(turn * turns[i]);
        turn_bone(c, i, turn, before);
    }
}

void descend(const Chain& c) {
    for (size_t i = c.bones.size(); i-- > 0;) {
        const Vec3 end = c.places.back() - c.places[i], wanted = c.target - c.places[i];
        if (length(end) < 1e-6f || length(wanted) < 1e-6f) continue;
        const Quat turn = rotation_between(normalize_or(end, {}), normalize_or(wanted, {}));
        Vec3 before = c.places[i];
        for (size_t j = i; j < c.bones.size(); ++j) turn_bone(c, j, turn, before);
    }
}

// A ball joint at p turns the end e about any axis: its part of the Jacobian is v -> v x (e - p). So J J^T is
// the sum over joints of |r|^2 - r r^T with r = e - p, and joint i turns by r x (what J^T is put to).
struct Squared {
    float xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};
Squared squared_jacobian(const Chain& c) {
    Squared m;
    for (size_t i = 0; i < c.bones.size(); ++i) {
        const Vec3 r = c.places.back() - c.places[i];
        m.xx += r.y * r.y + r.z * r.z;
        m.yy += r.x * r.x + r.z * r.z;
        m.zz += r.x * r.x + r.y * r.y;
        m.xy -= r.x * r.y;
        m.xz -= r.x * r.z;
        m.yz -= r.y * r.z;
    }
    return m;
}
Vec3 times(const Squared& m, Vec3 v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
// x of m x = v, by Cramer's rule; m is positive definite.
Vec3 solved(const Squared& m, Vec3 v) {
    const Vec3 a{m.xx, m.xy, m.xz}, b{m.xy, m.yy, m.yz}, d{m.xz, m.yz, m.zz};
    return Vec3{dot(v, cross(b, d)), dot(a, cross(v, d)), dot(a, cross(b, v))} / dot(a, cross(b, d));
}

// Every joint turns by the cross product of its way to the end with `push`, half a radian at most.
void turn_by(const Chain& c, Vec3 push) {
    constexpr float k_most_turn = 0.5f;
    Quat turns[k_most_chain_joints];
    for (size_t i = 0; i < c.bones.size(); ++i) {
        const Vec3 turn = cross(c.places.back() - c.places[i], push);
        const float angle = length(turn);
        const SinCos half = sin_cos(std::min(angle, k_most_turn) * 0.5f);
        const Vec3 axis = normalize_or(turn, {}) * half.sine;
        turns[i] = {axis.x, axis.y, axis.z, half.cosine};
    }
    turn_bones(c, turns);
}

void follow_transpose(const Chain& c) {
    const Vec3 error = to_target(c), moved = times(squared_jacobian(c), error);
    const float moved2 = length_squared(moved);
    if (moved2 > 1e-20f) turn_by(c, error * (dot(error, moved) / moved2));
}

void follow_damped(const Chain& c) {
    float reach = 0;
    for (const float bone : c.bones) reach += bone;
    // A tenth of the reach: enough where the chain is stretched and J J^T is all but singular.
    const float damping = 0.01f * reach * reach;
    Squared m = squared_jacobian(c);
    m.xx += damping;
    m.yy += damping;
    m.zz += damping;
    turn_by(c, solved(m, to_target(c)));
}

// The plane of the limb is kept.
void close(const Chain& c) {
    assert(c.places.size() == 3);
    const Vec3 aim = normalize_or(c.target - c.places[0], {0, -1, 0});
    const Vec3 across = c.places[1] - c.places[0];
    Vec3 front = normalize_or(across - aim * dot(across, aim), {0, 0, 1});
    // As two_bone has it: +z is where the middle goes, -y where the limb hangs.
    const Vec3 side = cross(front, aim);
    const here::V3<float> target{0, -length(c.target - c.places[0]), 0};
    const auto size = here::limb_sizes(c.bones[0], c.bones[1]);
    const auto limb = here::two_bone(target, {0.0f, 1.0f}, size, 1.0f, 0.0f);
    auto out = [&](here::V3<float> p) { return c.places[0] + side * p.x - aim * p.y + front * p.z; };
    c.places[1] = out(limb.middle);
    c.places[2] = out(limb.end);
}

void iterate(Solver solver, const Chain& chain) {
    switch (solver) {
        case Solver::fabrik:
            return reach(chain);
        case Solver::ccd:
            return descend(chain);
        case Solver::transpose:
            return follow_transpose(chain);
        case Solver::damped:
            return follow_damped(chain);
        case Solver::two_bone:
            return close(chain);
    }
}

}  // namespace

Solved solve_chain(Solver solver, std::span<Vec3> places, std::span<const float> bones, Vec3 target,
                   const Patience& patience) {
    assert(places.size() == bones.size() + 1 && places.size() >= 2 && places.size() <= k_most_chain_joints);
    const Chain chain{places, bones, target};
    Solved out{0, length(to_target(chain))};
    while (out.iterations < patience.iterations && out.off > patience.tolerance) {
        iterate(solver, chain);
        ++out.iterations;
        out.off = length(to_target(chain));
        if (solver == Solver::two_bone) break;
    }
    return out;
}

}  // namespace flaneur
