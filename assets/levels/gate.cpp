#include "assets/levels/gate.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "sim/base/math.h"

namespace flaneur {

namespace {

using Turns = std::array<Quat, k_joint_count>;

// Of each joint against its parent, out of the canonical pose.
Turns turns_of(int pose) {
    Turns turns{};
    if (pose == 1) {  // mid-stride, the left leg ahead
        turns[left_upper_leg] = rotation_x(-0.5f);
        turns[left_lower_leg] = rotation_x(0.2f);
        turns[right_upper_leg] = rotation_x(0.35f);
        turns[right_lower_leg] = rotation_x(0.6f);
        turns[left_upper_arm] = rotation_x(0.4f);
        turns[right_upper_arm] = rotation_x(-0.4f);
        turns[left_lower_arm] = turns[right_lower_arm] = rotation_x(-0.4f);
    } else if (pose == 2) {  // arms raised and bent
        turns[left_upper_arm] = rotation_z(2.4f);
        turns[right_upper_arm] = rotation_z(-2.4f);
        turns[left_lower_arm] = rotation_z(0.5f);
        turns[right_lower_arm] = rotation_z(-0.5f);
    }
    return turns;
}

struct PosedJoint {
    Quat turn;
    Vec3 place;
};

std::array<PosedJoint, k_joint_count> joints_of(const Body& body, int pose) {
    const Turns turns = turns_of(pose);
    std::array<PosedJoint, k_joint_count> joints;
    for (size_t j = 0; j < joints.size(); ++j) {
        const int parent = k_joint_parents[j];
        if (parent == k_no_parent) {
            joints[j] = {turns[j], body.joints[j]};
            continue;
        }
        const PosedJoint& above = joints[size_t(parent)];
        joints[j] = {above.turn * turns[j],
                     above.place + rotate(above.turn, body.joints[j] - body.joints[size_t(parent)])};
    }
    return joints;
}

// The vertices from `first` on.
void pose_vertices(const Character& c, int pose, size_t first, PosedMesh& mesh) {
    auto joints = joints_of(c.body, pose);
    for (size_t j = 0; j < joints.size(); ++j) {
        PosedJoint& joint = joints[j];
        joint.turn = joint.turn * c.bind_to_canonical[j];
        joint.place -= rotate(joint.turn, c.bind_joints[j]);
    }
    mesh.places.resize(c.vertices.size());
    mesh.normals.resize(c.vertices.size());
    for (size_t i = first; i < c.vertices.size(); ++i) {
        const CharacterVertex& v = c.vertices[i];
        Vec3 place, normal;
        for (size_t n = 0; n < 4 && v.weights[n] > 0; ++n) {
            const PosedJoint& joint = joints[v.joints[n]];
            const float weight = float(v.weights[n]) / 255;
            place += (joint.place + rotate(joint.turn, v.position)) * weight;
            normal += rotate(joint.turn, v.normal) * weight;
        }
        mesh.places[i] = place;
        mesh.normals[i] = normal;
    }
}

// Room for a body that raises its arms; what reaches farther, such as wings, is measured as far as that.
SideView view_of(const Character& c, const PosedMesh& mesh) {
    const float height = std::max(c.body.height, 0.01f), most = 0.8f * height;
    float reach = 0, top = 0, bottom = 0;
    for (uint32_t i : c.lods[0]) {
        const Vec3 p = mesh.places[i];
        reach = std::max(reach, p.x * p.x + p.z * p.z);
        top = std::max(top, p.y);
        bottom = std::min(bottom, p.y);
    }
    reach = std::min(std::sqrt(reach), most);
    top = std::min(top, 1.5f * height);
    bottom = std::max(bottom, -0.1f * height);
    SideView view;
    view.pixels_per_metre = pixels_of_level(1) / height;
    view.left = -reach;
    view.bottom = bottom;
    view.width = int(2 * reach * view.pixels_per_metre) + 2;
    view.height = int((top - bottom) * view.pixels_per_metre) + 2;
    return view;
}

SideView turned(SideView view, int side) {
    const SinCos turn = sin_cos(2 * k_pi * float(side) / LevelGate::k_sides);
    view.sine = turn.sine;
    view.cosine = turn.cosine;
    return view;
}

// What some pixels show together.
struct SideSum {
    int covered = 0;
    std::array<int, 3> colour{};
    void add(uint32_t rgba) {
        if (rgba == 0) return;
        ++covered;
        for (size_t n = 0; n < 3; ++n) colour[n] += int(rgba >> (8 * n) & 0xffu);
    }
    void add(const SideSum& other) {
        covered += other.covered;
        for (size_t n = 0; n < 3; ++n) colour[n] += other.colour[n];
    }
};

SideSum sum_of(const SidePicture& picture, const SideView& view, int left, int low, int edge) {
    SideSum sum;
    const int right = std::min(left + edge, view.width), high = std::min(low + edge, view.height);
    for (int y = low; y < high; ++y) {
        const uint32_t* row = &picture.rgba[size_t(y) * size_t(view.width)];
        for (int x = left; x < right; ++x) sum.add(row[x]);
    }
    return sum;
}

// Whether nothing is in a square of pixels.
bool is_empty(const SidePicture& picture, const SideView& view, int left, int low, int edge) {
    const int right = std::min(left + edge, view.width), high = std::min(low + edge, view.height);
    uint32_t any = 0;
    for (int y = low; y < high; ++y) {
        const uint32_t* row = &picture.rgba[size_t(y) * size_t(view.width)];
        for (int x = left; x < right; ++x) any |= row[x];
    }
    return any == 0;
}

// `edge`: drawn pixels to one that is seen.
LevelDifference compared(const SidePicture& a, const SidePicture& b, const SideView& view, int edge) {
    constexpr int k_square = 3;
    double covered = 0, apart = 0, both = 0, distance = 0;
    for (int low = 0; low < view.height; low += k_square * edge)
        for (int left = 0; left < view.width; left += k_square * edge) {
            const int square = k_square * edge;
            if (is_empty(a, view, left, low, square) && is_empty(b, view, left, low, square)) continue;
            SideSum whole_a, whole_b;
            for (int n = 0; n < k_square * k_square; ++n) {
                const int x = left + n % k_square * edge, y = low + n / k_square * edge;
                const SideSum of_a = sum_of(a, view, x, y, edge), of_b = sum_of(b, view, x, y, edge);
                apart += std::abs(of_a.covered - of_b.covered);
                whole_a.add(of_a);
                whole_b.add(of_b);
            }
            covered += whole_a.covered;
            const int shared = std::min(whole_a.covered, whole_b.covered);
            if (shared == 0) continue;
            float difference = 0;
            for (size_t n = 0; n < 3; ++n)
                difference += std::fabs(float(whole_a.colour[n]) / float(whole_a.covered) -
                                        float(whole_b.colour[n]) / float(whole_b.covered));
            both += shared;
            distance += double(difference) / (3 * 255) * shared;
        }
    return {covered > 0 ? float(apart / covered) : 0, both > 0 ? float(distance / both) : 0};
}

}  // namespace

bool is_within(const LevelDifference& d, int level) {
    const LevelDifference& most = k_most_difference[size_t(level)];
    return d.silhouette <= most.silhouette && d.colour <= most.colour;
}

float pixels_of_level(int level) { return k_level_pixels[level - 1] / (2 * k_body_sphere); }

LevelGate make_gate(const Character& c) {
    LevelGate gate;
    for (int pose = 0; pose < LevelGate::k_poses; ++pose) {
        PosedMesh& mesh = gate.poses[size_t(pose)];
        pose_vertices(c, pose, 0, mesh);
        SideView& view = gate.views[size_t(pose)];
        view = view_of(c, mesh);
        for (int side = 0; side < LevelGate::k_sides; ++side)
            draw_side(c, mesh, c.lods[0], turned(view, side), gate.pictures.emplace_back());
    }
    return gate;
}

LevelDifference difference_of(LevelGate& gate, const Character& c, std::span<const uint32_t> triangles,
                              int level) {
    // Pictures are drawn as large as the first level is seen, and those of others seen by squares of pixels.
    const int edge = int(pixels_of_level(1) / pixels_of_level(level));
    LevelDifference worst;
    SidePicture picture;
    for (int pose = 0; pose < LevelGate::k_poses; ++pose) {
        PosedMesh& mesh = gate.poses[size_t(pose)];
        pose_vertices(c, pose, mesh.places.size(), mesh);  // those that are new
        for (int side = 0; side < LevelGate::k_sides; ++side) {
            const SideView view = turned(gate.views[size_t(pose)], side);
            draw_side(c, mesh, triangles, view, picture);
            const LevelDifference d =
                compared(gate.pictures[size_t(pose * LevelGate::k_sides + side)], picture, view, edge);
            worst = {std::max(worst.silhouette, d.silhouette), std::max(worst.colour, d.colour)};
            if (!is_within(worst, level)) return worst;
        }
    }
    return worst;
}

}  // namespace flaneur
