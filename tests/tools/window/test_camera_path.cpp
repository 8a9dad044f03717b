#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assets/look.h"
#include "tools/flaneur/view/path.h"

namespace flaneur {
namespace {

// A way with a stop, a sharp turn, and lenses that would overshoot.
CameraPath way() {
    CameraPath path;
    auto add = [&](double time, Vec3 eye, Vec3 way, double fov) {
        path.keys.push_back({time, eye, eye + way, fov_of(fov)});
    };
    add(1, {0, 1.7f, -20}, {0, 0, 1}, 32);
    add(3.5, {2.25f, 1.6f, -8}, {0.3f, -0.1f, 1}, 90);
    add(5, {2.25f, 1.6f, -8}, {-1, 0, -0.1f}, 90);
    add(5.4, {10, 20, 0}, {0.2f, -1, -0.5f}, 30);
    add(9, {-3, 4, 30}, {0, -0.2f, -1}, 33);
    return path;
}

TEST(CameraPath, GoesThroughItsKeysFromRestToRest) {
    const CameraPath path = way();
    EXPECT_DOUBLE_EQ(duration(path), 8);
    for (const CameraKey& key : path.keys) {
        const Camera at = camera_at(path, key.time - path.keys.front().time);
        EXPECT_LT(glm::length(at.eye - glm::vec3(key.eye.x, key.eye.y, key.eye.z)), 1e-4f) << key.time;
        const Vec3 way = normalize_or(key.target - key.eye, {});
        const glm::vec3 seen = glm::normalize(at.target - at.eye);
        EXPECT_LT(glm::length(seen - glm::vec3(way.x, way.y, way.z)), 1e-3f) << key.time;
        EXPECT_NEAR(at.vertical_fov, key.fov, 1e-5f) << key.time;
    }
    auto moved = [&](double a, double b) {
        return glm::length(camera_at(path, a).eye - camera_at(path, b).eye);
    };
    EXPECT_EQ(moved(-5, 0), 0);
    EXPECT_EQ(moved(8, 50), 0);
    EXPECT_LT(moved(0, 0.05), 0.2f * moved(1, 1.05)) << "it starts slowly";
    EXPECT_LT(moved(8, 7.95), 0.2f * moved(6, 6.05)) << "and ends so";
    EXPECT_LT(moved(2.5, 3.25), 1e-4f) << "where two keys are in one place it stays";
}

TEST(CameraPath, IsSmoothAndItsLensOvershootsNowhere) {
    const CameraPath path = way();
    for (size_t i = 1; i < path.keys.size(); ++i) {
        const CameraKey &a = path.keys[i - 1], &b = path.keys[i];
        const auto [low, high] = std::minmax(a.fov, b.fov);
        for (int step = 0; step <= 50; ++step) {
            const double time = std::lerp(a.time, b.time, step / 50.0) - 1;
            const float fov = camera_at(path, time).vertical_fov;
            EXPECT_GE(fov, low - 1e-5f) << time;
            EXPECT_LE(fov, high + 1e-5f) << time;
        }
    }
    Camera last = camera_at(path, 0);
    for (double time = 0.01; time < 8; time += 0.01) {
        const Camera now = camera_at(path, time);
        EXPECT_LT(glm::length(now.eye - last.eye), 1) << time;
        EXPECT_NEAR(glm::length(now.target - now.eye), 1, 1e-3f);
        EXPECT_GT(glm::dot(now.target - now.eye, last.target - last.eye), 0.97f)
            << time << ": it never jumps";
        last = now;
    }
}

TEST(CameraPath, HasOneKeyAtLeast) {
    CameraPath path;
    path.keys.push_back(way().keys[1]);
    EXPECT_EQ(duration(path), 0);
    EXPECT_EQ(camera_at(path, 3).vertical_fov, path.keys[0].fov);
}

TEST(CameraPath, IsReadAsItWasWritten) {
    CameraPath path = way();
    path.keys[2].fov = 0.557f, path.keys[2].eye.x = 1.0f / 3;
    const std::string text = path_text(path);
    const Result<CameraPath> read = parse_path(text);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->keys.size(), path.keys.size());
    for (size_t i = 0; i < path.keys.size(); ++i) {
        EXPECT_EQ(read->keys[i].time, path.keys[i].time);
        EXPECT_EQ(read->keys[i].eye, path.keys[i].eye);
        EXPECT_EQ(read->keys[i].target, path.keys[i].target);
        EXPECT_EQ(read->keys[i].fov, path.keys[i].fov);
    }
    EXPECT_EQ(path_text(*read), text);
}

TEST(CameraPath, RefusesWhatIsBroken) {
    const std::string key = R"({"time": 0, "eye": [0, 1, 2], "target": [1, 1, 2]})";
    EXPECT_TRUE(parse_path(R"({"keys": [)" + key + "]}"));
    auto refused = [](const std::string& text, const std::string& why) {
        const Result<CameraPath> path = parse_path(text);
        ASSERT_FALSE(path) << text;
        EXPECT_NE(path.error().message.find(why), std::string::npos) << path.error().message;
    };
    auto keys = [](const std::string& second) {
        return R"({"keys": [{"time": 1, "eye": [0, 1, 2], "target": [1, 1, 2]}, )" + second + "]}";
    };
    refused("", "JSON");
    refused("{", "JSON");
    refused("[]", "no camera path");
    refused(R"({"keys": 3})", "no camera path");
    refused(R"({"keys": []})", "no key");
    refused(R"({"keys": [)" + key + R"(], "loop": true})", "loop");
    refused(keys("3"), "key 2 that is no object");
    refused(keys(key), "no later");
    refused(keys(R"({"time": 2, "eye": [0, 1], "target": [1, 1, 2]})"), "three numbers");
    refused(keys(R"({"time": 2, "eye": [0, 1, 1e9], "target": [1, 1, 2]})"), "\"eye\"");
    refused(keys(R"({"time": 2, "eye": [0, 1, 2], "target": [0, 1, 2]})"), "where it stands");
    refused(keys(R"({"time": 2, "eye": [0, 1, 2], "target": [1, 1, 2], "fov": 0})"), "\"fov\"");
    refused(keys(R"({"time": 2, "eye": [0, 1, 2], "target": [1, 1, 2], "fov": 151})"), "150");
    refused(keys(R"({"time": "2", "eye": [0, 1, 2], "target": [1, 1, 2]})"), "\"time\"");
    refused(keys(R"({"time": 2, "eye": [0, 1, 2]})"), "without \"target\"");
    refused(keys(R"({"time": 2, "eye": [0, 1, 2], "target": [1, 1, 2], "roll": 1})"), "roll");
    refused(keys(R"({"time": 1e999, "eye": [0, 1, 2], "target": [1, 1, 2]})"), "JSON");
    const Result<CameraPath> nowhere = load_path("/nowhere/way.json");
    ASSERT_FALSE(nowhere);
    EXPECT_NE(nowhere.error().message.find("/nowhere/way.json"), std::string::npos);
}

}  // namespace
}  // namespace flaneur
