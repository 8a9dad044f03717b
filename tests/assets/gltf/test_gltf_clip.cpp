#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "assets/gltf/character/clip.h"
#include "sim/base/math.h"
#include "tests/assets/tiny_man.h"
#include "tests/folder.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

const fs::path k_characters = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "characters";

float angle_between(Quat a, Quat b) {
    return 2 * std::acos(std::fmin(1.0f, std::fabs(dot(normalize(a), normalize(b)))));
}

std::vector<float> values_of(std::initializer_list<Quat> rotations) {
    std::vector<float> out;
    for (Quat q : rotations) out.insert(out.end(), {q.x, q.y, q.z, q.w});
    return out;
}

std::string write(const TestFolder& folder, const TinyMan& man, const std::string& name) {
    Bytes bytes = as_glb(man);
    return folder.write(name + ".glb", {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

RecordedMotion loaded(const TinyMan& man, const std::string& name) {
    TestFolder folder;
    auto motion = load_motion(write(folder, man, name), "sway");
    EXPECT_TRUE(motion) << (motion ? "" : motion.error().message);
    return motion ? *motion : RecordedMotion{};
}

// Arms held out when bound: lowering one by a quarter turn brings it to the canonical pose.
TEST(GltfClip, IsRelativeToTheCanonicalPose) {
    for (Quat turn : {Quat{}, rotation_x(k_pi / 2), rotation_y(k_pi) * rotation_z(k_pi / 2)}) {
        TinyMan man = tiny_man(turn);
        auto turned = [&](Quat q) { return turn * q * conjugate(turn); };
        animate(man, left_upper_arm, "rotation", "LINEAR", {0, 1},
                values_of({{}, turned(rotation_z(-k_pi / 2))}));
        animate(man, head, "rotation", "LINEAR", {0, 0.5f, 1},
                values_of({{}, turned(rotation_y(0.8f)), turned(rotation_y(0.8f))}));
        Vec3 up = rotate(turn, standard_body(1.7f).joints[hips]), raised = rotate(turn, {0, 0.1f, 0}) + up;
        animate(man, hips, "translation", "STEP", {0.25f, 1},
                {up.x, up.y, up.z, raised.x, raised.y, raised.z});
        RecordedMotion motion = loaded(man, "turned");
        ASSERT_EQ(motion.keys.size(), 31u);
        EXPECT_FLOAT_EQ(motion.rate, 30);
        EXPECT_FALSE(motion.loops);
        for (size_t k = 0; k < motion.keys.size(); ++k) {
            const LocalPose& pose = motion.keys[k];
            float t = float(k) / 30;
            auto arm = [&](Joint clavicle) {  // the clavicle goes a part of the way
                return pose.rotations[clavicle] * pose.rotations[size_t(clavicle) + 1];
            };
            EXPECT_LT(angle_between(arm(left_shoulder), rotation_z((1 - t) * k_pi / 2)), 2e-3f);
            EXPECT_LT(angle_between(arm(right_shoulder), rotation_z(-k_pi / 2)), 2e-3f);
            EXPECT_LT(angle_between(pose.rotations[head], rotation_y(0.8f * std::fmin(2 * t, 1.0f))), 2e-3f);
            for (Joint still : {hips, chest, left_hand, left_lower_leg, right_foot})
                EXPECT_LT(angle_between(pose.rotations[still], {}), 2e-3f) << k_joint_names[still];
            EXPECT_NEAR(pose.offset.y, k == 30 ? 0.1f : 0.0f, 1e-4f);
            EXPECT_NEAR(pose.offset.x, 0, 1e-4f);
        }
    }
}

TEST(GltfClip, CubicSplinesFollowTheirTangents) {
    TinyMan man = tiny_man();
    // Half-angle quaternions whose z is 0.2 t^2 (3 - 2 t) + 0.1 t (1 - t)^2, with w near 1.
    animate(man, chest, "rotation", "CUBICSPLINE", {0, 1},
            {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0.1f, 0, 0, 0, 0, 0, 0, 0, 0.2f, 1, 0, 0, 0, 0});
    RecordedMotion motion = loaded(man, "spline");
    ASSERT_EQ(motion.keys.size(), 31u);
    for (size_t k = 0; k <= 30; ++k) {
        float t = float(k) / 30;
        Quat wanted{0, 0, 0.2f * t * t * (3 - 2 * t) + 0.1f * t * (1 - t) * (1 - t), 1};
        EXPECT_LT(angle_between(motion.keys[k].rotations[chest], wanted), 2e-3f);
    }
}

TEST(GltfClip, EndsOnAKeyAndKnowsALoop) {
    TinyMan man = tiny_man();
    animate(man, spine, "rotation", "LINEAR", {0.5f, 1, 1.51f}, values_of({{}, rotation_x(0.2f), {}}));
    RecordedMotion motion = loaded(man, "loop");
    EXPECT_TRUE(motion.loops);
    EXPECT_EQ(motion.keys.size(), 30u);
    EXPECT_NEAR(motion.rate, 30 / 1.01f, 1e-3f);
    auto clip = additive_clip(motion);
    ASSERT_TRUE(clip);
    EXPECT_NEAR(clip->duration, 1.01f, 1e-4f);
    EXPECT_LT(angle_between(sample(*clip, 0.5f).rotations[spine], rotation_x(0.2f)), 0.01f);
    EXPECT_LT(angle_between(sample(*clip, 0).rotations[left_upper_arm], {}), 1e-3f);
}

TEST(GltfClip, NamesMayHaveColons) {
    TestFolder folder;
    std::string plain = write(folder, tiny_man(), "man"), odd = write(folder, tiny_man(), "man:1");
    auto expect = [](const std::string& text, const std::string& file, const std::string& clip) {
        EXPECT_EQ(split_clip(text).file, file) << text;
        EXPECT_EQ(split_clip(text).clip, clip) << text;
    };
    expect(plain, plain, "");
    expect(plain + ":Sway", plain, "Sway");
    expect(plain + ":Walk:slow", plain, "Walk:slow");
    expect(odd, odd, "");
    expect(odd + ":Sway", odd, "Sway");
    expect(odd + ":Walk:slow", odd, "Walk:slow");
    expect("nowhere.glb:Walk:slow.glb", "nowhere.glb:Walk:slow.glb", "");
    expect("nowhere.glb:Walk:slow", "nowhere.glb", "Walk:slow");
    expect("nowhere", "nowhere", "");
}

TEST(GltfClip, RefusesWithASentence) {
    TestFolder folder;
    auto refusal = [&](auto&& animate, const std::string& name = "Sway") {
        TinyMan man = tiny_man();
        animate(man);
        auto motion = load_motion(write(folder, man, "bad"), name);
        return motion ? "(was loaded)" : motion.error().message;
    };
    auto has = [](const std::string& message, std::string_view part) {
        return message.find(part) != std::string::npos && message.find("bad.glb") != std::string::npos;
    };
    auto sway = [](TinyMan& m) { animate(m, head, "rotation", "LINEAR", {0, 1}, values_of({{}, {}})); };
    EXPECT_PRED2(has, refusal(sway, "Jump"), "it has Man|Sway");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     m.gltf["animations"][0] = {
                         {"name", "Sway"}, {"channels", Json::array()}, {"samplers", Json::array()}};
                 }),
                 "moves nothing");
    EXPECT_PRED2(has, refusal([](TinyMan& m) { animate(m, 99, "rotation", "LINEAR", {0}, values_of({{}})); }),
                 "node that does not exist");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     animate(m, head, "rotation", "LINEAR", {1, 0}, values_of({{}, {}}));
                 }),
                 "times do not rise");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     animate(m, head, "rotation", "CUBICSPLINE", {0, 1}, values_of({{}, {}}));
                 }),
                 "one value a key");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     animate(m, head, "rotation", "LINEAR", {0, 1e6f}, values_of({{}, {}}));
                 }),
                 "ten minutes");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     animate(m, hips, "translation", "STEP", {0}, {0, 50, 0});
                 }),
                 "8 m");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     animate(m, head, "rotation", "STEP", {0}, {0, NAN, 0, 1});
                 }),
                 "not finite");
    EXPECT_FALSE(load_motion("/no/such/file.glb", ""));
}

TEST(GltfClip, CorpusMoves) {
    struct Known {
        const char *file, *name;
        bool loops;
    };
    int tried = 0;
    for (Known known : {Known{"khronos_CesiumMan.glb", "", true},
                        {"threejs_RobotExpressive.glb", "Wave", true},
                        {"kaykit_Knight.glb", "", true},
                        {"quaternius_cyberpunk_pack_Character.glb", "walk", true},
                        {"sketchbook_boxman.glb", "idle", true}}) {
        if (!fs::exists(k_characters / known.file)) continue;
        ++tried;
        auto motion = load_motion((k_characters / known.file).string(), known.name);
        ASSERT_TRUE(motion) << motion.error().message;
        EXPECT_EQ(motion->loops, known.loops) << known.file;
        auto clip = additive_clip(*motion);
        ASSERT_TRUE(clip);
        // Nobody's head leaves his shoulders, and somewhat moves.
        float moved = 0;
        for (const LocalPose& pose : motion->keys) {
            EXPECT_LT(angle_between(pose.rotations[neck], {}), 1.2f) << known.file;
            for (size_t j = 0; j < k_joint_count; ++j)
                moved = std::max(moved, angle_between(pose.rotations[j], motion->keys[0].rotations[j]));
        }
        EXPECT_GT(moved, 0.02f) << known.file;
    }
    if (tried == 0) GTEST_SKIP() << k_characters << " is not here: the files that it holds are not tried";
}

// Whatever lies there loads or says why not.
TEST(GltfClip, OddFilesAreLoadedOrRefused) {
    fs::path odd = k_characters.parent_path() / "odd";
    if (!fs::exists(odd)) GTEST_SKIP() << odd << " is not here: the files that it holds are not tried";
    size_t moved = 0, refused = 0;
    for (const auto& entry : fs::recursive_directory_iterator(odd)) {
        std::string kind = entry.path().extension().string();
        if (kind != ".glb" && kind != ".gltf" && kind != ".vrm") continue;
        auto motion = load_motion(entry.path().string(), "");
        motion ? ++moved : ++refused;
        if (!motion) {
            EXPECT_GT(motion.error().message.size(), entry.path().filename().string().size() + 10);
        }
    }
    std::cout << moved << " moved, " << refused << " refused\n";
    EXPECT_GT(moved + refused, 0u);
}

}  // namespace
}  // namespace flaneur
