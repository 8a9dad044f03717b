#include "assets/gltf_write.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <span>
#include <sstream>

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

// An sRGB channel of 8 bits as light.
float light_of(uint32_t colour, int shift) {
    float c = static_cast<float>(colour >> shift & 0xffu) / 255;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

std::vector<double> numbers(Vec3 v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Appends an accessor over bytes of its own, four of them aligned; gives its number. `target` 0: no vertices.
template <class T>
int add_accessor(tinygltf::Model& model, std::span<const T> values, int type, int component, int target) {
    std::vector<uint8_t>& bytes = model.buffers[0].data;
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = bytes.size();
    view.byteLength = values.size_bytes();
    view.target = target;
    bytes.resize(bytes.size() + (values.size_bytes() + 3) / 4 * 4);
    std::memcpy(bytes.data() + view.byteOffset, values.data(), values.size_bytes());

    tinygltf::Accessor accessor;
    accessor.bufferView = static_cast<int>(model.bufferViews.size());
    accessor.type = type;
    accessor.componentType = component;
    size_t size = static_cast<size_t>(tinygltf::GetComponentSizeInBytes(static_cast<uint32_t>(component)) *
                                      tinygltf::GetNumComponentsInType(static_cast<uint32_t>(type)));
    accessor.count = values.size_bytes() / size;
    model.bufferViews.push_back(view);
    model.accessors.push_back(accessor);
    return static_cast<int>(model.accessors.size()) - 1;
}

// Nodes 0 .. 21 are the joints in the pose of the bind.
void add_skeleton(tinygltf::Model& model, const Character& c) {
    std::array<std::array<float, 16>, k_joint_count> inverse_binds{};
    tinygltf::Skin skin;
    for (size_t j = 0; j < k_joint_count; ++j) {
        Vec3 place = c.bind_joints[j];
        tinygltf::Node node;
        node.name = vrm_name(k_joint_names[j]);
        int parent = k_joint_parents[j];
        node.translation = numbers(parent < 0 ? place : place - c.bind_joints[static_cast<size_t>(parent)]);
        model.nodes.push_back(node);
        if (parent >= 0) model.nodes[static_cast<size_t>(parent)].children.push_back(static_cast<int>(j));
        inverse_binds[j] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -place.x, -place.y, -place.z, 1};
        skin.joints.push_back(static_cast<int>(j));
    }
    skin.skeleton = hips;
    skin.inverseBindMatrices = add_accessor<std::array<float, 16>>(model, inverse_binds, TINYGLTF_TYPE_MAT4,
                                                                   TINYGLTF_COMPONENT_TYPE_FLOAT, 0);
    model.skins.push_back(skin);
}

tinygltf::Primitive add_surface(tinygltf::Model& model, const Character& c,
                                const std::array<uint32_t, k_tint_count>& tints) {
    std::vector<Vec3> places, normals;
    std::vector<std::array<uint16_t, 4>> colours;
    std::vector<std::array<uint8_t, 4>> joints, weights;
    Vec3 low = c.vertices[0].position, high = low;
    for (const CharacterVertex& v : c.vertices) {
        places.push_back(v.position);
        normals.push_back(normalize_or(v.normal, {0, 1, 0}));
        low = {std::min(low.x, v.position.x), std::min(low.y, v.position.y), std::min(low.z, v.position.z)};
        high = {std::max(high.x, v.position.x), std::max(high.y, v.position.y),
                std::max(high.z, v.position.z)};
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
    constexpr int k_floats = TINYGLTF_COMPONENT_TYPE_FLOAT, k_bytes = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    constexpr int k_vertices = TINYGLTF_TARGET_ARRAY_BUFFER;
    auto add = [&]<class T>(const std::vector<T>& values, int type, int component) {
        return add_accessor<T>(model, values, type, component, k_vertices);
    };
    auto accessor = [&](int n) -> tinygltf::Accessor& { return model.accessors[static_cast<size_t>(n)]; };
    tinygltf::Primitive surface;
    surface.mode = TINYGLTF_MODE_TRIANGLES;
    surface.material = 0;
    auto& attributes = surface.attributes;
    attributes["POSITION"] = add(places, TINYGLTF_TYPE_VEC3, k_floats);
    accessor(attributes["POSITION"]).minValues = numbers(low);
    accessor(attributes["POSITION"]).maxValues = numbers(high);
    attributes["NORMAL"] = add(normals, TINYGLTF_TYPE_VEC3, k_floats);
    attributes["COLOR_0"] = add(colours, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    accessor(attributes["COLOR_0"]).normalized = true;
    attributes["JOINTS_0"] = add(joints, TINYGLTF_TYPE_VEC4, k_bytes);
    attributes["WEIGHTS_0"] = add(weights, TINYGLTF_TYPE_VEC4, k_bytes);
    accessor(attributes["WEIGHTS_0"]).normalized = true;
    surface.indices =
        add_accessor<uint32_t>(model, c.lods[0], TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                               TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    return surface;
}

}  // namespace

std::string character_glb(const Character& c, const std::array<uint32_t, k_tint_count>& tints) {
    assert(c.textures.empty() && !c.vertices.empty());
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "flaneur";
    model.buffers.emplace_back();
    add_skeleton(model, c);

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

    std::ostringstream bytes;
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&model, bytes, false, true);
    return std::move(bytes).str();
}

}  // namespace flaneur
