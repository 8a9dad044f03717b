// A BVH file, read again by its own words, has every joint where it was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/math.h"
#include "tools/flaneur/gait/measure/walk.h"
#include "tools/flaneur/motion/bvh.h"

namespace flaneur {
namespace {

struct Bone {
    std::string name;
    int parent = -1;
    Vec3 offset;
    int channels = 0;
};

struct Read {
    std::vector<Bone> bones;  // with end sites, which have no channels
    size_t frames = 0;
    double frame_time = 0;
    std::vector<std::vector<double>> rows;
};

Read read_bvh(const std::string& text) {
    Read read;
    std::istringstream in(text);
    std::vector<int> open;
    std::string word;
    int last = -1;
    while (in >> word && word != "MOTION") {
        if (word == "ROOT" || word == "JOINT" || word == "End") {
            Bone bone;
            in >> bone.name;
            bone.parent = open.empty() ? -1 : open.back();
            read.bones.push_back(bone);
            last = static_cast<int>(read.bones.size()) - 1;
        } else if (word == "{") {
            open.push_back(last);
        } else if (word == "}") {
            open.pop_back();
        } else if (word == "OFFSET") {
            Vec3& o = read.bones.back().offset;
            in >> o.x >> o.y >> o.z;
        } else if (word == "CHANNELS") {
            in >> read.bones.back().channels;
            std::string order, channel;
            for (int c = 0; c < read.bones.back().channels; ++c) {
                in >> channel;
                order += channel.substr(0, 1);
            }
            EXPECT_EQ(order, read.bones.back().channels == 6 ? "XYZZXY" : "ZXY");
        }
    }
    EXPECT_TRUE(open.empty());
    in >> word >> read.frames >> word >> word >> read.frame_time;
    std::string line;
    std::getline(in, line);
    while (std::getline(in, line)) {
        std::istringstream numbers(line);
        read.rows.emplace_back();
        for (double v; numbers >> v;) read.rows.back().push_back(v);
    }
    return read;
}

Quat about(Vec3 axis, double degrees) {
    double half = degrees * static_cast<double>(k_radians) / 2;
    auto s = static_cast<float>(std::sin(half));
    return {axis.x * s, axis.y * s, axis.z * s, static_cast<float>(std::cos(half))};
}

// Every joint where it was, and no channel that jumps.
void expect_same(const Walk& walked) {
    std::vector<JointPoses> ticks;
    for (const Instant& now : walked.ticks) ticks.push_back(now.joints);
    Read read = read_bvh(bvh_text(walked.body, ticks, 60));
    EXPECT_EQ(read.frames, ticks.size());
    ASSERT_EQ(read.rows.size(), ticks.size());
    EXPECT_NEAR(read.frame_time, 1.0 / 60, 1e-6);
    ASSERT_EQ(read.bones.size(), k_joint_count + 5u) << "head, hands and toes end";

    for (size_t t = 0; t < ticks.size(); ++t) {
        const std::vector<double>& row = read.rows[t];
        ASSERT_EQ(row.size(), 3 * k_joint_count + 3);
        for (size_t c = 3; t > 0 && c < row.size(); ++c)
            EXPECT_LT(std::fabs(row[c] - read.rows[t - 1][c]), 120) << "channel " << c << " of frame " << t;
        size_t next = 0;
        std::vector<Vec3> places;
        std::vector<Quat> turns;
        for (const Bone& bone : read.bones) {
            bool is_root = bone.parent < 0;
            Vec3 place = bone.offset;
            if (is_root) {
                place = {static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2])};
                next = 3;
            } else {
                auto up = static_cast<size_t>(bone.parent);
                place = places[up] + rotate(turns[up], bone.offset);
            }
            Quat turn = is_root ? Quat{} : turns[static_cast<size_t>(bone.parent)];
            if (bone.channels > 0) {
                turn = turn * about({0, 0, 1}, row[next]) * about({1, 0, 0}, row[next + 1]) *
                       about({0, 1, 0}, row[next + 2]);
                next += 3;
                bool known = false;
                for (size_t j = 0; j < k_joint_count; ++j) {
                    if (k_joint_names[j] != bone.name) continue;
                    known = true;
                    EXPECT_LT(length(place - ticks[t][j].position), 2e-4f) << bone.name << " " << t;
                }
                EXPECT_TRUE(known) << bone.name;
            }
            places.push_back(place);
            turns.push_back(turn);
        }
        EXPECT_EQ(next, row.size());
        auto lowest = std::min_element(places.begin(), places.end(),
                                       [](const Vec3& a, const Vec3& b) { return a.y < b.y; });
        if (t == 0) {
            EXPECT_NEAR(lowest->y, 0, 0.002) << "of a foot that stands";
        }
    }
}

const Person k_person{standard_body(1.7f), {}};

TEST(Bvh, FollowsWhoTurnsRound) {
    expect_same(walk(ground_of(level_course(20)), k_person, 12, [](double t) {
        return t < 1 ? Vec2{} : heading_direction(wrap_angle(static_cast<float>(t))) * 1.2f;
    }));
}

// Knees beyond 90 degrees.
TEST(Bvh, FollowsARun) {
    expect_same(walk(ground_of(level_course(0)), k_person, 8, [](double t) {
        return Vec2{0, t < 1 ? 0.0f : 3};
    }));
}

TEST(Bvh, FollowsDownStairs) {
    expect_same(walk(ground_of(stairs_course(3, -0.17f, 0.29f)), k_person, 20, [](double t) {
        return Vec2{0, t < 1 ? 0.0f : 1.3f};
    }));
}

// Straight through where z and y turn about one axis: what comes out of it is what went in.
TEST(Bvh, GoesOnWhereAnglesAreBlind) {
    Walk made;
    made.body = k_person.body;
    for (int t = 0; t < 240; ++t) {
        Instant now;
        double bent = static_cast<double>(t);
        for (size_t j = 0; j < k_joint_count; ++j) {
            bool is_root = k_joint_parents[j] == k_no_parent;
            auto up = static_cast<size_t>(is_root ? 0 : k_joint_parents[j]);
            const JointPose& parent = now.joints[up];
            Quat own = j == left_lower_leg ? about({1, 0, 0}, bent) : Quat{};
            now.joints[j].rotation = is_root ? Quat{} : parent.rotation * own;
            now.joints[j].position =
                is_root
                    ? made.body.joints[j]
                    : parent.position + rotate(parent.rotation, made.body.joints[j] - made.body.joints[up]);
        }
        made.ticks.push_back(now);
    }
    expect_same(made);
}

}  // namespace
}  // namespace flaneur
