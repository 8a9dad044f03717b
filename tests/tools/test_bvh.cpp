// A BVH file, read again by its own words, has every joint where it was.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "sim/base/math.h"
#include "tools/flaneur/gait/bvh.h"
#include "tools/flaneur/gait/walk.h"

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

TEST(Bvh, PutsEveryJointWhereItWas) {
    Person person{standard_body(1.7f), {}};
    Ground ground = strip([](float) { return 0.0f; }, {-60, 600}, false);
    // A turn beyond half of one.
    Walk walked = walk(ground, person, 6, [](double t) {
        return t < 1 ? Vec2{} : heading_direction(static_cast<float>(t)) * 1.2f;
    });
    std::vector<JointPoses> ticks;
    for (const Instant& now : walked.ticks) ticks.push_back(now.joints);
    Read read = read_bvh(bvh_text(person.body, ticks, 60));
    EXPECT_EQ(read.frames, ticks.size());
    EXPECT_EQ(read.rows.size(), ticks.size());
    EXPECT_NEAR(read.frame_time, 1.0 / 60, 1e-6);
    ASSERT_EQ(read.bones.size(), k_joint_count + 5u) << "head, hands and toes end";

    for (size_t t = 0; t < ticks.size(); t += 7) {
        const std::vector<double>& row = read.rows[t];
        size_t next = 0;
        std::vector<Vec3> places;
        std::vector<Quat> turns;
        for (const Bone& bone : read.bones) {
            bool is_root = bone.parent < 0;
            Vec3 place = bone.offset;
            if (is_root) {
                ASSERT_GE(row.size(), 3u);
                place = {static_cast<float>(row[0]), static_cast<float>(row[1]), static_cast<float>(row[2])};
                next = 3;
            } else {
                auto up = static_cast<size_t>(bone.parent);
                place = places[up] + rotate(turns[up], bone.offset);
            }
            Quat turn = is_root ? Quat{} : turns[static_cast<size_t>(bone.parent)];
            if (bone.channels > 0) {
                ASSERT_GE(row.size(), next + 3);
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
    }
}

}  // namespace
}  // namespace flaneur
