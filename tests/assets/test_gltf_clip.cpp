#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "assets/gltf_clip.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

namespace fs = std::filesystem;

const fs::path k_characters = fs::path(FLANEUR_SHARED_DIR) / "corpus" / "characters";

float angle_between(Quat a, Quat b) {
    return 2 * std::acos(std::fmin(1.0f, std::fabs(dot(normalize(a), normalize(b)))));
}

// A glTF file with a man of boxes who stands with his arms held out. Every joint of standard_body is a node
// of that number; the file's axes may be turned as a whole.
class TinyMan {
  public:
    explicit TinyMan(Quat turn = {}) {
        Body body = standard_body(1.7f);
        places_ = body.joints;
        for (int j : {left_lower_arm, left_hand, right_lower_arm, right_hand}) {
            Joint shoulder = j < right_shoulder ? left_upper_arm : right_upper_arm;
            Vec3 hanging = body.joints[size_t(j)] - body.joints[shoulder];
            float side = j < right_shoulder ? 1.0f : -1.0f;
            places_[size_t(j)] = body.joints[shoulder] + Vec3{-hanging.y * side, 0, 0};
        }
        for (int j = 0; j < k_joint_count; ++j) {
            int parent = k_joint_parents[size_t(j)];
            Vec3 from = parent < 0 ? Vec3{} : places_[size_t(parent)];
            Vec3 t = rotate(turn, places_[size_t(j)] - from);
            std::string children;
            for (int c = 0; c < k_joint_count; ++c)
                if (k_joint_parents[size_t(c)] == j) comma(children) += std::to_string(c);
            nodes_ += "{\"name\":\"" + std::string(k_joint_names[size_t(j)]) + "\",\"translation\":[" +
                      text(t) + "]" + (children.empty() ? "" : ",\"children\":[" + children + "]") + "},";
            comma(skin_) += std::to_string(j);
            add_box(j, body, turn);
        }
        position_ = put(positions_, "FLOAT", "VEC3");
        joint_ = put(joints_, "UNSIGNED_BYTE", "VEC4");
        weight_ = put(weights_, "FLOAT", "VEC4");
        index_ = put(indices_, "UNSIGNED_SHORT", "SCALAR");
        std::vector<float> binds;
        for (Vec3 p : places_) {
            Vec3 q = rotate(turn, p);
            binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -q.x, -q.y, -q.z, 1});
        }
        bind_ = put(binds, "FLOAT", "MAT4");
    }

    void animate(int node, const std::string& path, const std::string& way, const std::vector<float>& times,
                 const std::vector<float>& values) {
        int input = put(times, "FLOAT", "SCALAR");
        int output = put(values, "FLOAT", path == "rotation" ? "VEC4" : "VEC3");
        std::string sampler = std::to_string(channel_count_++);
        comma(samplers_) += "{\"input\":" + std::to_string(input) + ",\"output\":" + std::to_string(output) +
                            ",\"interpolation\":\"" + way + "\"}";
        comma(channels_) += "{\"sampler\":" + sampler + ",\"target\":{\"node\":" + std::to_string(node) +
                            ",\"path\":\"" + path + "\"}}";
    }

    std::string write(const std::string& name) const {
        fs::path folder = fs::path(testing::TempDir());
        std::ofstream(folder / (name + ".bin"), std::ios::binary)
            .write(bytes_.data(), std::streamsize(bytes_.size()));
        auto n = [](int i) { return std::to_string(i); };
        std::string path = (folder / (name + ".gltf")).string();
        std::ofstream(path) << "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,22]}],"
                            << "\"nodes\":[" << nodes_ << "{\"mesh\":0,\"skin\":0}],\"skins\":[{\"joints\":["
                            << skin_ << "],\"inverseBindMatrices\":" << bind_ << "}],"
                            << "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":" << n(position_)
                            << ",\"JOINTS_0\":" << n(joint_) << ",\"WEIGHTS_0\":" << n(weight_)
                            << "},\"indices\":" << n(index_) << "}]}],\"animations\":[{\"name\":\"Man|Sway\","
                            << "\"samplers\":[" << samplers_ << "],\"channels\":[" << channels_ << "]}],"
                            << "\"buffers\":[{\"uri\":\"" << name << ".bin\",\"byteLength\":" << bytes_.size()
                            << "}],\"bufferViews\":[" << views_ << "],\"accessors\":[" << accessors_ << "]}";
        return path;
    }

  private:
    static std::string text(Vec3 v) {
        return std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z);
    }
    static std::string& comma(std::string& list) { return list += list.empty() ? "" : ","; }

    void add_box(int j, const Body& body, Quat turn) {
        Vec3 from = places_[size_t(j)], to = from + Vec3{0, 0.12f, 0};
        for (int c = j + 1; c < k_joint_count; ++c)
            if (k_joint_parents[size_t(c)] == j && c != left_shoulder && c != right_shoulder &&
                c != left_upper_leg && c != right_upper_leg)
                to = places_[size_t(c)];
        if (j == left_hand || j == right_hand) to = from + Vec3{j == left_hand ? 0.15f : -0.15f, 0, 0};
        if (j == left_toes || j == right_toes) to = from + Vec3{0, 0, body.toe};
        auto first = uint16_t(positions_.size() / 3);
        for (int corner = 0; corner < 8; ++corner) {
            Vec3 p =
                (corner & 4 ? to : from) + Vec3{corner & 1 ? 0.02f : -0.02f, 0, corner & 2 ? 0.02f : -0.02f};
            p.y = std::fmax(p.y, 0.0f);
            p = rotate(turn, p);
            positions_.insert(positions_.end(), {p.x, p.y, p.z});
            joints_.insert(joints_.end(), {uint8_t(j), 0, 0, 0});
            weights_.insert(weights_.end(), {1, 0, 0, 0});
        }
        for (int i : {0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5,
                      2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 7, 3, 1, 5, 7})
            indices_.push_back(uint16_t(first + i));
    }

    template <class T>
    int put(const std::vector<T>& values, const std::string& component, const std::string& type) {
        size_t each = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 16;
        int code = component == "FLOAT" ? 5126 : component == "UNSIGNED_SHORT" ? 5123 : 5121;
        size_t begin = bytes_.size(), size = values.size() * sizeof(T);
        bytes_.resize((begin + size + 3) / 4 * 4);
        std::memcpy(bytes_.data() + begin, values.data(), size);
        comma(views_) += "{\"buffer\":0,\"byteOffset\":" + std::to_string(begin) +
                         ",\"byteLength\":" + std::to_string(size) + "}";
        comma(accessors_) += "{\"bufferView\":" + std::to_string(accessor_count_) +
                             ",\"componentType\":" + std::to_string(code) + ",\"type\":\"" + type +
                             "\",\"count\":" + std::to_string(values.size() / each) + "}";
        return accessor_count_++;
    }

    std::array<Vec3, k_joint_count> places_;
    std::vector<float> positions_, weights_;
    std::vector<uint8_t> joints_;
    std::vector<uint16_t> indices_;
    std::vector<char> bytes_;
    std::string nodes_, skin_, views_, accessors_, samplers_, channels_;
    int accessor_count_ = 0, channel_count_ = 0, position_, joint_, weight_, index_, bind_;
};

std::vector<float> values_of(std::initializer_list<Quat> rotations) {
    std::vector<float> out;
    for (Quat q : rotations) out.insert(out.end(), {q.x, q.y, q.z, q.w});
    return out;
}

Motion loaded(const TinyMan& man, const std::string& name) {
    auto motion = load_motion(man.write(name), "sway");
    EXPECT_TRUE(motion) << (motion ? "" : motion.error().message);
    return motion ? *motion : Motion{};
}

// Arms held out when bound: lowering one by a quarter turn brings it to the canonical pose.
TEST(GltfClip, IsRelativeToTheCanonicalPose) {
    for (Quat turn : {Quat{}, rotation_x(k_pi / 2), rotation_y(k_pi) * rotation_z(k_pi / 2)}) {
        TinyMan man(turn);
        auto turned = [&](Quat q) { return turn * q * conjugate(turn); };
        man.animate(left_upper_arm, "rotation", "LINEAR", {0, 1},
                    values_of({{}, turned(rotation_z(-k_pi / 2))}));
        man.animate(head, "rotation", "LINEAR", {0, 0.5f, 1},
                    values_of({{}, turned(rotation_y(0.8f)), turned(rotation_y(0.8f))}));
        Vec3 up = rotate(turn, standard_body(1.7f).joints[hips]), raised = rotate(turn, {0, 0.1f, 0}) + up;
        man.animate(hips, "translation", "STEP", {0.25f, 1},
                    {up.x, up.y, up.z, raised.x, raised.y, raised.z});
        Motion motion = loaded(man, "turned");
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
            EXPECT_NEAR(pose.way.y, k == 30 ? 0.1f : 0.0f, 1e-4f);
            EXPECT_NEAR(pose.way.x, 0, 1e-4f);
        }
    }
}

TEST(GltfClip, CubicSplinesFollowTheirTangents) {
    TinyMan man;
    // Half-angle quaternions whose z is 0.2 t^2 (3 - 2 t) + 0.1 t (1 - t)^2, with w near 1.
    man.animate(chest, "rotation", "CUBICSPLINE", {0, 1},
                {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0.1f, 0, 0, 0, 0, 0, 0, 0, 0.2f, 1, 0, 0, 0, 0});
    Motion motion = loaded(man, "spline");
    ASSERT_EQ(motion.keys.size(), 31u);
    for (size_t k = 0; k <= 30; ++k) {
        float t = float(k) / 30;
        Quat wanted{0, 0, 0.2f * t * t * (3 - 2 * t) + 0.1f * t * (1 - t) * (1 - t), 1};
        EXPECT_LT(angle_between(motion.keys[k].rotations[chest], wanted), 2e-3f);
    }
}

TEST(GltfClip, EndsOnAKeyAndKnowsALoop) {
    TinyMan man;
    man.animate(spine, "rotation", "LINEAR", {0.5f, 1, 1.51f}, values_of({{}, rotation_x(0.2f), {}}));
    Motion motion = loaded(man, "loop");
    EXPECT_TRUE(motion.loops);
    EXPECT_EQ(motion.keys.size(), 30u);
    EXPECT_NEAR(motion.rate, 30 / 1.01f, 1e-3f);
    auto clip = additive_clip(motion);
    ASSERT_TRUE(clip);
    EXPECT_NEAR(clip->duration, 1.01f, 1e-4f);
    EXPECT_LT(angle_between(sample(*clip, 0.5f).rotations[spine], rotation_x(0.2f)), 0.01f);
    EXPECT_LT(angle_between(sample(*clip, 0).rotations[left_upper_arm], {}), 1e-3f);
}

TEST(GltfClip, RefusesWithASentence) {
    auto refusal = [](auto&& animate, const std::string& name = "Sway") {
        TinyMan man;
        animate(man);
        auto motion = load_motion(man.write("bad"), name);
        return motion ? "(was loaded)" : motion.error().message;
    };
    auto has = [](const std::string& message, std::string_view part) {
        return message.find(part) != std::string::npos && message.find("bad.gltf") != std::string::npos;
    };
    auto sway = [](TinyMan& m) { m.animate(head, "rotation", "LINEAR", {0, 1}, values_of({{}, {}})); };
    EXPECT_PRED2(has, refusal(sway, "Jump"), "it has Man|Sway");
    EXPECT_PRED2(has, refusal([](TinyMan&) {}), "moves nothing");
    EXPECT_PRED2(has, refusal([](TinyMan& m) { m.animate(99, "rotation", "LINEAR", {0}, values_of({{}})); }),
                 "node that does not exist");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     m.animate(head, "rotation", "LINEAR", {1, 0}, values_of({{}, {}}));
                 }),
                 "times do not rise");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     m.animate(head, "rotation", "CUBICSPLINE", {0, 1}, values_of({{}, {}}));
                 }),
                 "one value a key");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     m.animate(head, "rotation", "LINEAR", {0, 1e6f}, values_of({{}, {}}));
                 }),
                 "ten minutes");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     m.animate(hips, "translation", "STEP", {0}, {0, 50, 0});
                 }),
                 "8 m");
    EXPECT_PRED2(has, refusal([](TinyMan& m) {
                     m.animate(head, "rotation", "STEP", {0}, {0, NAN, 0, 1});
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
