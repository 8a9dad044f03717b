// A motion's glTF file, read again by tinygltf, has every joint where it was, and a doll that is bound to
// them.
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "sim/base/math.h"
#include "tools/flaneur/gait/measure/walk.h"
#include "tools/flaneur/motion/glb.h"

namespace flaneur {
namespace {

tinygltf::Model read_glb(const std::string& bytes) {
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(
        &model, &error, &warning, reinterpret_cast<const unsigned char*>(bytes.data()),
        static_cast<unsigned int>(bytes.size())));
    EXPECT_EQ(error + warning, "");
    return model;
}

// The values of an accessor, one after another, which lie within its view, aligned, and within what it says
// they do.
template <class T>
std::vector<T> values_of(const tinygltf::Model& model, int number, int component, int type, int target) {
    const tinygltf::Accessor& accessor = model.accessors.at(static_cast<size_t>(number));
    const tinygltf::BufferView& view = model.bufferViews.at(static_cast<size_t>(accessor.bufferView));
    EXPECT_EQ(accessor.componentType, component);
    EXPECT_EQ(accessor.type, type);
    EXPECT_EQ(view.target, target);
    const auto width = static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    std::vector<T> values(accessor.count * width);
    const size_t begin = view.byteOffset + accessor.byteOffset, size = values.size() * sizeof(T);
    EXPECT_EQ(begin % 4, 0u);
    EXPECT_EQ(view.byteStride, 0u);
    EXPECT_LE(accessor.byteOffset + size, view.byteLength);
    const std::vector<unsigned char>& data = model.buffers.at(0).data;
    if (begin + size > data.size()) throw std::out_of_range("beyond the buffer");
    std::memcpy(values.data(), data.data() + begin, size);
    for (size_t c = 0; c < accessor.minValues.size(); ++c) {
        double low = static_cast<double>(values[c]), high = low;
        for (size_t i = c; i < values.size(); i += width) {
            low = std::min(low, static_cast<double>(values[i]));
            high = std::max(high, static_cast<double>(values[i]));
        }
        EXPECT_EQ(low, accessor.minValues[c]);
        EXPECT_EQ(high, accessor.maxValues.at(c));
    }
    return values;
}

std::vector<float> floats(const tinygltf::Model& model, int number, int type, int target = 0) {
    return values_of<float>(model, number, TINYGLTF_COMPONENT_TYPE_FLOAT, type, target);
}

Vec3 vec3_at(const std::vector<float>& values, size_t i) {
    return {values.at(3 * i), values.at(3 * i + 1), values.at(3 * i + 2)};
}
Quat quat_at(const std::vector<float>& values, size_t i) {
    return {values.at(4 * i), values.at(4 * i + 1), values.at(4 * i + 2), values.at(4 * i + 3)};
}

// The animation's curves, by node.
struct Curves {
    std::vector<float> times;
    std::map<int, std::vector<float>> places, turns;
};

Curves curves_of(const tinygltf::Model& model) {
    Curves curves;
    const tinygltf::Animation& animation = model.animations.at(0);
    for (const tinygltf::AnimationChannel& channel : animation.channels) {
        const tinygltf::AnimationSampler& sampler =
            animation.samplers.at(static_cast<size_t>(channel.sampler));
        EXPECT_EQ(sampler.interpolation, "LINEAR");
        EXPECT_EQ(model.accessors.at(static_cast<size_t>(sampler.input)).minValues.size(), 1u);
        curves.times = floats(model, sampler.input, TINYGLTF_TYPE_SCALAR);
        const bool is_turn = channel.target_path == "rotation";
        EXPECT_TRUE(is_turn || channel.target_path == "translation") << channel.target_path;
        std::vector<float> values =
            floats(model, sampler.output, is_turn ? TINYGLTF_TYPE_VEC4 : TINYGLTF_TYPE_VEC3);
        EXPECT_EQ(values.size(), curves.times.size() * (is_turn ? 4 : 3));
        (is_turn ? curves.turns : curves.places)[channel.target_node] = values;
    }
    return curves;
}

// Where every node is at a key; at rest where there is none.
std::vector<JointPose> pose_at(const tinygltf::Model& model, const Curves* curves, size_t key) {
    std::vector<JointPose> poses(model.nodes.size());
    std::function<void(int, const JointPose&)> pose = [&](int number, const JointPose& up) {
        const tinygltf::Node& node = model.nodes.at(static_cast<size_t>(number));
        EXPECT_TRUE(node.matrix.empty() && node.rotation.empty() && node.scale.empty());
        Vec3 place;
        if (node.translation.size() == 3)
            place = {static_cast<float>(node.translation[0]), static_cast<float>(node.translation[1]),
                     static_cast<float>(node.translation[2])};
        Quat turn;
        if (curves && curves->places.count(number)) place = vec3_at(curves->places.at(number), key);
        if (curves && curves->turns.count(number)) turn = quat_at(curves->turns.at(number), key);
        JointPose& here = poses[static_cast<size_t>(number)];
        here = {up.position + rotate(up.rotation, place), up.rotation * turn};
        for (int child : node.children) pose(child, here);
    };
    for (int root : model.scenes.at(static_cast<size_t>(model.defaultScene)).nodes) pose(root, {});
    return poses;
}

std::vector<JointPoses> ticks_of(const Walk& walked) {
    std::vector<JointPoses> ticks;
    for (const Instant& now : walked.ticks) ticks.push_back(now.joints);
    return ticks;
}

size_t joint_named(const std::string& name) {
    return static_cast<size_t>(std::find(k_joint_names.begin(), k_joint_names.end(), name) -
                               k_joint_names.begin());
}

// Every joint where it was at every tick, turned by quaternions that never change their sign.
void expect_same(const Walk& walked) {
    const std::vector<JointPoses> ticks = ticks_of(walked);
    const tinygltf::Model model = read_glb(motion_glb(walked.body, ticks, 60));
    EXPECT_EQ(model.asset.generator, "flaneur");
    ASSERT_EQ(model.animations.size(), 1u);
    const Curves curves = curves_of(model);
    EXPECT_EQ(curves.turns.size(), static_cast<size_t>(k_joint_count));
    EXPECT_EQ(curves.places.size(), 1u);
    ASSERT_EQ(curves.times.size(), ticks.size());
    for (size_t t = 0; t < ticks.size(); ++t)
        EXPECT_NEAR(static_cast<double>(curves.times[t]), static_cast<double>(t) / 60, 1e-5);
    for (const auto& [node, turns] : curves.turns) {
        for (size_t t = 0; t < ticks.size(); ++t) {
            Quat turn = quat_at(turns, t);
            EXPECT_NEAR(dot(turn, turn), 1, 1e-5f);
            EXPECT_GT(dot(turn, quat_at(turns, t - (t > 0))), 0.7f) << node << " at " << t;
        }
    }

    double worst = 0;
    const std::vector<int>& joints = model.skins.at(0).joints;
    ASSERT_EQ(joints.size(), static_cast<size_t>(k_joint_count));
    for (size_t t = 0; t < ticks.size(); ++t) {
        std::vector<JointPose> poses = pose_at(model, &curves, t);
        for (int number : joints) {
            const std::string& name = model.nodes.at(static_cast<size_t>(number)).name;
            const size_t joint = joint_named(name);
            ASSERT_LT(joint, static_cast<size_t>(k_joint_count)) << name;
            const JointPose& here = poses[static_cast<size_t>(number)];
            double error = static_cast<double>(length(here.position - ticks[t][joint].position));
            worst = std::max(worst, error);
            EXPECT_LT(error, 2e-4) << name << " at " << t;
            EXPECT_GT(std::fabs(dot(here.rotation, ticks[t][joint].rotation)), 0.99999f) << name;
        }
    }
    testing::Test::RecordProperty("worst_um", static_cast<int>(std::lround(worst * 1e6)));
}

const Person k_person{standard_body(1.7f), {}};

Walk round_walk(double seconds) {
    return walk(ground_of(level_course(20)), k_person, seconds, [](double t) {
        return t < 1 ? Vec2{} : heading_direction(wrap_angle(static_cast<float>(t))) * 1.2f;
    });
}

// More than twice round: the hips' quaternion passes its own opposite.
TEST(MotionGlb, FollowsWhoTurnsRound) { expect_same(round_walk(16)); }

TEST(MotionGlb, FollowsARun) {
    expect_same(walk(ground_of(level_course(0)), k_person, 8, [](double t) {
        return Vec2{0, t < 1 ? 0.0f : 3};
    }));
}

TEST(MotionGlb, FollowsDownStairs) {
    expect_same(walk(ground_of(stairs_course(3, -0.17f, 0.29f)), k_person, 20, [](double t) {
        return Vec2{0, t < 1 ? 0.0f : 1.3f};
    }));
}

// The doll's vertices at a key, or at rest, as the skin has them.
struct Doll {
    tinygltf::Model model;
    std::vector<float> places, binds;
    std::vector<uint8_t> joints;

    std::vector<Vec3> skinned(const std::vector<JointPose>& poses) const {
        std::vector<Vec3> skinned;
        for (size_t v = 0; v < places.size() / 3; ++v) {
            const size_t joint = joints.at(4 * v);
            const float* bind = &binds.at(16 * joint);  // by columns
            const Vec3 p = vec3_at(places, v);
            const Vec3 local = {bind[0] * p.x + bind[4] * p.y + bind[8] * p.z + bind[12],
                                bind[1] * p.x + bind[5] * p.y + bind[9] * p.z + bind[13],
                                bind[2] * p.x + bind[6] * p.y + bind[10] * p.z + bind[14]};
            const JointPose& pose = poses.at(static_cast<size_t>(model.skins[0].joints.at(joint)));
            skinned.push_back(pose.position + rotate(pose.rotation, local));
        }
        return skinned;
    }
};

Doll read_doll(const std::string& glb) {
    Doll doll;
    doll.model = read_glb(glb);
    const tinygltf::Model& m = doll.model;
    const tinygltf::Primitive& surface = m.meshes.at(0).primitives.at(0);
    auto attribute = [&](const char* name) { return surface.attributes.at(name); };
    constexpr int k_vertices = TINYGLTF_TARGET_ARRAY_BUFFER, k_bytes = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    doll.places = floats(m, attribute("POSITION"), TINYGLTF_TYPE_VEC3, k_vertices);
    EXPECT_EQ(m.accessors[static_cast<size_t>(attribute("POSITION"))].minValues.size(), 3u);
    doll.joints = values_of<uint8_t>(m, attribute("JOINTS_0"), k_bytes, TINYGLTF_TYPE_VEC4, k_vertices);
    doll.binds = floats(m, m.skins.at(0).inverseBindMatrices, TINYGLTF_TYPE_MAT4);
    EXPECT_EQ(doll.binds.size(), 16u * k_joint_count);
    return doll;
}

TEST(MotionGlb, BindsADollToItsJoints) {
    const Walk walked = round_walk(3);
    const std::vector<JointPoses> ticks = ticks_of(walked);
    const Doll doll = read_doll(motion_glb(walked.body, ticks, 60));
    const tinygltf::Primitive& surface = doll.model.meshes[0].primitives[0];
    const size_t count = doll.places.size() / 3;

    std::vector<float> normals =
        floats(doll.model, surface.attributes.at("NORMAL"), TINYGLTF_TYPE_VEC3, TINYGLTF_TARGET_ARRAY_BUFFER);
    auto weights = values_of<uint8_t>(doll.model, surface.attributes.at("WEIGHTS_0"),
                                      TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, TINYGLTF_TYPE_VEC4,
                                      TINYGLTF_TARGET_ARRAY_BUFFER);
    auto indices = values_of<uint32_t>(doll.model, surface.indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                       TINYGLTF_TYPE_SCALAR, TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    ASSERT_EQ(normals.size(), 3 * count);
    ASSERT_EQ(weights.size(), 4 * count);
    ASSERT_EQ(doll.joints.size(), 4 * count);
    std::vector<int> flesh(k_joint_count);
    for (size_t v = 0; v < count; ++v) {
        EXPECT_EQ(weights[4 * v] + weights[4 * v + 1] + weights[4 * v + 2] + weights[4 * v + 3], 255);
        EXPECT_NEAR(length(vec3_at(normals, v)), 1, 1e-5f);
        ++flesh.at(doll.joints[4 * v]);
    }
    for (size_t j = 0; j < k_joint_count; ++j) EXPECT_GT(flesh[j], 0) << k_joint_names[j];
    ASSERT_EQ(indices.size() % 3, 0u);
    for (size_t i = 0; i < indices.size(); i += 3) {
        const Vec3 a = vec3_at(doll.places, indices[i]), b = vec3_at(doll.places, indices[i + 1]),
                   c = vec3_at(doll.places, indices[i + 2]);
        EXPECT_GT(dot(cross(b - a, c - a), vec3_at(normals, indices[i])), 0) << "seen from outside";
    }

    auto expect_standing = [&](const std::vector<Vec3>& body, const char* when) {
        float low = body[0].y, high = low;
        for (Vec3 p : body) low = std::min(low, p.y), high = std::max(high, p.y);
        EXPECT_NEAR(low, 0, 0.003f) << when;
        EXPECT_NEAR(high, walked.body.height, 0.02f) << when;
    };
    const Curves curves = curves_of(doll.model);
    expect_standing(doll.skinned(pose_at(doll.model, &curves, 0)), "at the first tick");
    // At rest it stands as it was bound, but where the motion begins.
    const std::vector<JointPose> rest = pose_at(doll.model, nullptr, 0);
    const Vec3 begin = ticks[0][hips].position - walked.body.joints[hips];
    const std::vector<Vec3> resting = doll.skinned(rest);
    for (size_t v = 0; v < count; ++v) EXPECT_LT(length(resting[v] - begin - vec3_at(doll.places, v)), 1e-5f);
    for (size_t j = 0; j < k_joint_count; ++j)
        EXPECT_LT(length(rest[j].position - begin - walked.body.joints[j]), 1e-5f) << k_joint_names[j];
    // Each block stays with its bone.
    const std::vector<JointPose> later = pose_at(doll.model, &curves, ticks.size() - 1);
    const std::vector<Vec3> moved = doll.skinned(later);
    for (size_t v = 0; v < count; ++v) {
        const size_t j = doll.joints[4 * v];
        const Vec3 from_joint = vec3_at(doll.places, v) - walked.body.joints[j];
        EXPECT_LT(length(moved[v] - ticks.back()[j].position - rotate(ticks.back()[j].rotation, from_joint)),
                  2e-4f);
    }
}

}  // namespace
}  // namespace flaneur
