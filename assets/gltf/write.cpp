#include "assets/gltf/write.h"

#include <cassert>
#include <cmath>

#include "assets/gltf/glb.h"

namespace flaneur {

namespace {

// "left_upper_arm" is VRM's "leftUpperArm".
std::string vrm_name(std::string_view joint) {
    std::string name;
    bool raised = false;
    for (char c : joint) {
        if (c != '_') name += raised ? static_cast<char>(c - 'a' + 'A') : c;
        raised = c == '_';
    }
    return name;
}

using JointNames = std::array<std::string, k_joint_count>;

// Nodes 0 .. 21 are the joints in the pose of the bind.
void add_skeleton(tinygltf::Model& model, const Character& c, const JointNames& names) {
    std::array<std::array<float, 16>, k_joint_count> inverse_binds{};
    tinygltf::Skin skin;
    for (size_t j = 0; j < k_joint_count; ++j) {
        Vec3 place = c.bind_joints[j];
        tinygltf::Node node;
        node.name = names[j];
        int parent = k_joint_parents[j];
        node.translation = numbers(parent < 0 ? place : place - c.bind_joints[static_cast<size_t>(parent)]);
        model.nodes.push_back(node);
        if (parent >= 0) model.nodes[static_cast<size_t>(parent)].children.push_back(static_cast<int>(j));
        inverse_binds[j] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -place.x, -place.y, -place.z, 1};
        skin.joints.push_back(static_cast<int>(j));
    }
    skin.skeleton = hips;
    skin.inverseBindMatrices =
        add_accessor(model, inverse_binds, TINYGLTF_TYPE_MAT4, TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
    model.skins.push_back(skin);
}

tinygltf::Primitive add_surface(tinygltf::Model& model, const Character& c,
                                const std::array<uint32_t, k_tint_count>& tints) {
    std::vector<Vec3> places, normals;
    std::vector<std::array<uint16_t, 4>> colours;
    std::vector<std::array<uint8_t, 4>> joints, weights;
    for (const CharacterVertex& v : c.vertices) {
        places.push_back(v.position);
        normals.push_back(normalize_or(v.normal, {0, 1, 0}));
        std::array<uint16_t, 4> colour;
        colour.fill(0xffff);
        for (int i = 0; i < 3; ++i) {
            float light = light_of(v.colour, 8 * i) * light_of(tints[static_cast<size_t>(v.tint)], 8 * i);
            colour[static_cast<size_t>(i)] = static_cast<uint16_t>(std::lround(light * 0xffff));
        }
        colours.push_back(colour);
        auto& own_joints = joints.emplace_back();
        auto& own_weights = weights.emplace_back();
        for (size_t i = 0; i < 4; ++i) {
            own_weights[i] = v.weights[i];
            own_joints[i] = v.weights[i] > 0 ? v.joints[i] : uint8_t{0};  // as the format wants it
        }
    }
    constexpr int k_bytes = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    constexpr int k_shorts = TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT,
                  k_vertices = TINYGLTF_TARGET_ARRAY_BUFFER;
    tinygltf::Primitive surface;
    surface.mode = TINYGLTF_MODE_TRIANGLES;
    surface.material = 0;
    auto& attributes = surface.attributes;
    attributes["POSITION"] = add_positions(model, places);
    attributes["NORMAL"] =
        add_accessor(model, normals, TINYGLTF_TYPE_VEC3, TINYGLTF_COMPONENT_TYPE_FLOAT, k_vertices);
    attributes["COLOR_0"] = add_accessor(model, colours, TINYGLTF_TYPE_VEC4, k_shorts, k_vertices, true);
    attributes["JOINTS_0"] = add_accessor(model, joints, TINYGLTF_TYPE_VEC4, k_bytes, k_vertices);
    attributes["WEIGHTS_0"] = add_accessor(model, weights, TINYGLTF_TYPE_VEC4, k_bytes, k_vertices, true);
    surface.indices =
        add_accessor(model, c.lods[0], TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return surface;
}

// In a scene of its own, at rest.
tinygltf::Model model_of(const Character& c, const std::array<uint32_t, k_tint_count>& tints,
                         const JointNames& names) {
    assert(c.textures.empty() && !c.vertices.empty());
    tinygltf::Model model = begin_glb();
    add_skeleton(model, c, names);

    tinygltf::Material material;
    material.name = "person";
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    model.materials.push_back(material);
    tinygltf::Mesh mesh;
    mesh.name = c.name;
    mesh.primitives.push_back(add_surface(model, c, tints));
    model.meshes.push_back(mesh);

    tinygltf::Node body;
    body.name = c.name;
    body.mesh = 0;
    body.skin = 0;
    model.nodes.push_back(body);
    tinygltf::Scene scene;
    scene.nodes = {hips, k_joint_count};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    return model;
}

void add_animation(tinygltf::Model& model, const GlbMotion& motion) {
    constexpr int k_floats = TINYGLTF_COMPONENT_TYPE_FLOAT;
    assert(!motion.times.empty() && motion.hips.size() == motion.times.size());
    int times = add_accessor(model, motion.times, TINYGLTF_TYPE_SCALAR, k_floats, 0);
    model.accessors.back().minValues = {static_cast<double>(motion.times.front())};
    model.accessors.back().maxValues = {static_cast<double>(motion.times.back())};
    tinygltf::Animation animation;
    animation.name = "motion";
    auto add_channel = [&](size_t joint, const char* path, int values) {
        tinygltf::AnimationSampler sampler;
        sampler.input = times;
        sampler.output = values;
        sampler.interpolation = "LINEAR";
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation.samplers.size());
        channel.target_node = static_cast<int>(joint);
        channel.target_path = path;
        animation.samplers.push_back(sampler);
        animation.channels.push_back(channel);
    };
    add_channel(hips, "translation", add_accessor(model, motion.hips, TINYGLTF_TYPE_VEC3, k_floats, 0));
    for (size_t j = 0; j < k_joint_count; ++j) {
        assert(motion.turns[j].size() == motion.times.size());
        add_channel(j, "rotation", add_accessor(model, motion.turns[j], TINYGLTF_TYPE_VEC4, k_floats, 0));
    }
    model.animations.push_back(animation);
}

}  // namespace

std::array<std::string, k_joint_count> vrm_joint_names() {
    JointNames names;
    for (size_t j = 0; j < k_joint_count; ++j) names[j] = vrm_name(k_joint_names[j]);
    return names;
}

std::string character_glb(const Character& c, const std::array<uint32_t, k_tint_count>& tints) {
    tinygltf::Model model = model_of(c, tints, vrm_joint_names());
    return finish_glb(model);
}

std::string character_glb(const Character& c, const std::array<uint32_t, k_tint_count>& tints,
                          const GlbMotion& motion) {
    JointNames names;
    for (size_t j = 0; j < k_joint_count; ++j) names[j] = k_joint_names[j];
    tinygltf::Model model = model_of(c, tints, names);
    model.nodes[hips].translation = numbers(motion.hips.front());
    add_animation(model, motion);
    return finish_glb(model);
}

}  // namespace flaneur
