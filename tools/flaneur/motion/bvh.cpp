#include "tools/flaneur/motion/bvh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "sim/base/math.h"

namespace flaneur {

namespace {

void append_numbers(std::string& text, std::initializer_list<double> values) {
    char number[32];
    for (double v : values) {
        std::snprintf(number, sizeof number, " %.6f", v);
        text += number;
    }
}

void append_offset(std::string& text, const std::string& indent, Vec3 by) {
    text += indent + "OFFSET";
    append_numbers(text, {static_cast<double>(by.x), static_cast<double>(by.y), static_cast<double>(by.z)});
    text += "\n";
}

// The joints in the order in which they are nested.
void append_joint(std::string& text, const Body& body, size_t joint, size_t depth,
                  std::vector<size_t>& order) {
    bool is_root = k_joint_parents[joint] == k_no_parent;
    const std::string outer(depth, '\t'), inner(depth + 1, '\t');
    Vec3 parent = is_root ? Vec3{} : body.joints[static_cast<size_t>(k_joint_parents[joint])];
    order.push_back(joint);
    text += outer + (is_root ? "ROOT " : "JOINT ") + std::string(k_joint_names[joint]) + "\n" + outer + "{\n";
    append_offset(text, inner, is_root ? Vec3{} : body.joints[joint] - parent);
    text += inner + (is_root ? "CHANNELS 6 Xposition Yposition Zposition" : "CHANNELS 3") +
            " Zrotation Xrotation Yrotation\n";
    bool is_end = true;
    for (size_t child = 0; child < k_joint_count; ++child) {
        if (k_joint_parents[child] != static_cast<int>(joint)) continue;
        append_joint(text, body, child, depth + 1, order);
        is_end = false;
    }
    if (is_end) {
        text += inner + "End Site\n" + inner + "{\n";
        append_offset(text, inner + "\t", bone_end(body, joint));
        text += inner + "}\n";
    }
    text += outer + "}\n";
}

// Turns about z, x and y, in this order, the outermost first; degrees.
struct Angles {
    double z = 0, x = 0, y = 0;
};

// The angle and so many whole turns as bring it nearest to `to`.
double near(double angle, double to) { return to + std::remainder(angle - to, 360); }

Angles near(Angles a, const Angles& to) { return {near(a.z, to.z), near(a.x, to.x), near(a.y, to.y)}; }

double distance(const Angles& a, const Angles& b) {
    return std::fabs(a.z - b.z) + std::fabs(a.x - b.x) + std::fabs(a.y - b.y);
}

// Of the angles that a rotation can be told by, those nearest to the ones of the tick before: so a knee goes
// on beyond 90 degrees, and who walks round in a circle beyond 180.
Angles angles_of(Quat q, const Angles& before) {
    auto degrees = [](float sine, float cosine) {
        return std::atan2(static_cast<double>(sine), static_cast<double>(cosine)) /
               static_cast<double>(k_radians);
    };
    Vec3 x = rotate(q, {1, 0, 0}), y = rotate(q, {0, 1, 0}), z = rotate(q, {0, 0, 1});
    float upright = std::hypot(y.x, y.y);
    double about_x = degrees(y.z, upright);
    constexpr float k_blind = 1e-4f;  // where z and y turn about one axis, and only their sum is known
    if (upright < k_blind) {
        double both = degrees(x.y, x.x);
        return near({y.z > 0 ? both - before.y : both + before.y, about_x, before.y}, before);
    }
    Angles one{degrees(-y.x, y.y), about_x, degrees(-x.z, z.z)};
    Angles here = near(one, before), over = near({one.z + 180, 180 - one.x, one.y + 180}, before);
    return distance(here, before) <= distance(over, before) ? here : over;
}

}  // namespace

std::string bvh_text(const Body& body, const std::vector<JointPoses>& ticks, double rate) {
    std::string text = "HIERARCHY\n";
    std::vector<size_t> order;
    append_joint(text, body, hips, 0, order);
    char line[64];
    std::snprintf(line, sizeof line, "MOTION\nFrames: %zu\nFrame Time: %.7f\n", ticks.size(), 1 / rate);
    text += line;
    std::array<Angles, k_joint_count> angles;
    for (const JointPoses& poses : ticks) {
        const size_t begins = text.size();
        for (size_t joint : order) {
            bool is_root = k_joint_parents[joint] == k_no_parent;
            Vec3 p = poses[joint].position;
            if (is_root)
                append_numbers(
                    text, {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
            Angles& its = angles[joint];
            its = angles_of(own_turn(poses, joint), its);
            append_numbers(text, {its.z, its.x, its.y});
        }
        text.erase(begins, 1);
        text += "\n";
    }
    return text;
}

}  // namespace flaneur
