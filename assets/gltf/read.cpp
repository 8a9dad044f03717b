#include "assets/gltf/read.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <exception>
#include <filesystem>

#include "assets/gltf/accessor.h"
#include "assets/gltf/file.h"
#include "assets/gltf/mesh.h"

namespace flaneur {

namespace {

Affine local_transform(const tinygltf::Node& node) {
    auto f = [](double v) { return float(v); };
    if (node.matrix.size() == 16) {
        const auto& m = node.matrix;
        return {{f(m[0]), f(m[1]), f(m[2])},
                {f(m[4]), f(m[5]), f(m[6])},
                {f(m[8]), f(m[9]), f(m[10])},
                {f(m[12]), f(m[13]), f(m[14])}};
    }
    Affine a;
    Vec3 scale{1, 1, 1};
    if (node.scale.size() == 3) scale = {f(node.scale[0]), f(node.scale[1]), f(node.scale[2])};
    if (node.rotation.size() == 4) {
        Quat q{f(node.rotation[0]), f(node.rotation[1]), f(node.rotation[2]), f(node.rotation[3])};
        if (dot(q, q) > 1e-12f) {
            q = normalize(q);
            a = {rotate(q, {1, 0, 0}), rotate(q, {0, 1, 0}), rotate(q, {0, 0, 1}), {}};
        }
    }
    a.x = a.x * scale.x, a.y = a.y * scale.y, a.z = a.z * scale.z;
    if (node.translation.size() == 3)
        a.t = {f(node.translation[0]), f(node.translation[1]), f(node.translation[2])};
    return a;
}

bool finite(const Affine& a) {
    for (Vec3 v : {a.x, a.y, a.z, a.t})
        for (float f : {v.x, v.y, v.z})
            if (!(f > -1e9f && f < 1e9f)) return false;
    return true;
}

Result<void> read_nodes(const tinygltf::Model& model, GltfScene& scene) {
    size_t count = model.nodes.size();
    scene.nodes.resize(count);
    for (size_t n = 0; n < count; ++n) {
        const tinygltf::Node& node = model.nodes[n];
        GltfNode& out = scene.nodes[n];
        out.name = node.name;
        out.local = local_transform(node);
        if (!finite(out.local))
            return Error{"node " + std::to_string(n) + " has a transform that is not finite"};
        out.mesh = node.mesh >= 0 && size_t(node.mesh) < model.meshes.size() ? node.mesh : -1;
        out.skin = node.skin >= 0 && size_t(node.skin) < model.skins.size() ? node.skin : -1;
        if (out.mesh != node.mesh && node.mesh >= 0)
            return Error{"node " + std::to_string(n) + " names a mesh that does not exist"};
        if (out.skin != node.skin && node.skin >= 0)
            return Error{"node " + std::to_string(n) + " names a skin that does not exist"};
        for (int child : node.children) {
            if (child < 0 || size_t(child) >= count)
                return Error{"node " + std::to_string(n) + " has a child that does not exist"};
            if (scene.nodes[size_t(child)].parent >= 0)
                return Error{"node " + std::to_string(child) + " has two parents"};
            scene.nodes[size_t(child)].parent = int(n);
        }
    }
    std::vector<uint8_t> done(count, 0);
    for (size_t n = 0; n < count; ++n) {
        std::vector<int> path;
        for (int at = int(n); at >= 0 && !done[size_t(at)]; at = scene.nodes[size_t(at)].parent) {
            path.push_back(at);
            if (path.size() > count) return Error{"the nodes form a cycle"};
        }
        for (; !path.empty(); path.pop_back()) {
            GltfNode& node = scene.nodes[size_t(path.back())];
            node.world = node.parent < 0 ? node.local : scene.nodes[size_t(node.parent)].world * node.local;
            if (!finite(node.world)) return Error{"the nodes' transforms grow beyond reason"};
            done[size_t(path.back())] = 1;
        }
    }
    return {};
}

// Nodes outside the default scene are not shown, if that scene shows anything.
void choose_scene(const tinygltf::Model& model, GltfScene& scene) {
    size_t chosen = model.defaultScene >= 0 ? size_t(model.defaultScene) : 0;
    if (chosen >= model.scenes.size()) return;
    std::vector<uint8_t> root(scene.nodes.size(), 0);
    for (int node : model.scenes[chosen].nodes)
        if (node >= 0 && size_t(node) < root.size()) root[size_t(node)] = 1;
    bool any = false;
    for (size_t n = 0; n < root.size(); ++n) {
        int at = int(n);
        while (at >= 0 && !root[size_t(at)]) at = scene.nodes[size_t(at)].parent;
        scene.nodes[n].shown = at >= 0;
        any |= at >= 0 && scene.nodes[n].mesh >= 0;
    }
    for (GltfNode& node : scene.nodes) node.shown |= !any;
}

Result<void> read_skins(const tinygltf::Model& model, GltfScene& scene) {
    for (size_t s = 0; s < model.skins.size(); ++s) {
        const tinygltf::Skin& skin = model.skins[s];
        std::string what = "skin " + std::to_string(s);
        GltfSkin out;
        for (int joint : skin.joints) {
            if (joint < 0 || size_t(joint) >= scene.nodes.size())
                return Error{what + " names a joint that does not exist"};
            out.joints.push_back(joint);
        }
        out.inverse_binds.resize(out.joints.size());
        if (skin.inverseBindMatrices >= 0) {
            auto data = read_accessor(model, skin.inverseBindMatrices, "the inverse bind matrices of " + what,
                                      model.nodes.size());
            if (!data) return data.error();
            if (data->components != 16 || data->count < out.joints.size())
                return Error{what + " has fewer inverse bind matrices than joints"};
            for (size_t j = 0; j < out.joints.size(); ++j) {
                const float* m = &data->values[j * 16];
                Affine a{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
                if (!finite(a) || !invertible(a))
                    return Error{what +
                                 " has an inverse bind matrix that cannot be inverted; export it again"};
                out.inverse_binds[j] = a;
            }
        }
        scene.skins.push_back(std::move(out));
    }
    return {};
}

// The bones' names that VRM 0 and VRM 1 give outright.
void read_vrm(const tinygltf::Model& model, GltfScene& scene) {
    scene.humanoid.resize(scene.nodes.size());
    auto name_node = [&](const tinygltf::Value& node, const std::string& bone) {
        if (node.IsInt() && node.GetNumberAsInt() >= 0 && size_t(node.GetNumberAsInt()) < scene.nodes.size())
            scene.humanoid[size_t(node.GetNumberAsInt())] = bone;
    };
    for (const char* extension : {"VRM", "VRMC_vrm"}) {
        auto found = model.extensions.find(extension);
        if (found == model.extensions.end() || !found->second.IsObject()) continue;
        const tinygltf::Value& humanoid = found->second.Get("humanoid");
        if (!humanoid.IsObject()) continue;
        const tinygltf::Value& bones = humanoid.Get("humanBones");
        if (bones.IsArray())
            for (size_t i = 0; i < bones.ArrayLen(); ++i) {
                const tinygltf::Value& bone = bones.Get(int(i));
                if (bone.IsObject() && bone.Get("bone").IsString())
                    name_node(bone.Get("node"), bone.Get("bone").Get<std::string>());
            }
        if (bones.IsObject())
            for (const std::string& key : bones.Keys()) {
                const tinygltf::Value& bone = bones.Get(key);
                if (bone.IsObject()) name_node(bone.Get("node"), key);
            }
    }
}

}  // namespace

Result<tinygltf::Model> parse_gltf(const std::string& path) {
    auto bytes = read_bytes(path, k_most_gltf_bytes);
    if (!bytes) return Error{path + ": " + bytes.error().message};
    return parse_gltf(*bytes, std::filesystem::path(path).parent_path().string(), path);
}

Result<tinygltf::Model> parse_gltf(std::span<const uint8_t> bytes, const std::string& folder,
                                   const std::string& path) {
    auto refuse = [&](const std::string& why) { return Error{path + ": " + why}; };
    auto file = open_gltf(bytes, folder);
    if (!file) return refuse(file.error().message);
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error, warning;
    bool loaded = false;
    try {
        loaded = loader.LoadASCIIFromString(&model, &error, &warning, file->json.data(),
                                            unsigned(file->json.size()), "");
    } catch (const std::exception& e) {  // an index out of range
        error = e.what();
    }
    while (!error.empty() && (error.back() == '\n' || error.back() == '.')) error.pop_back();
    std::replace(error.begin(), error.end(), '\n', ' ');
    if (!loaded)
        return refuse("is no sound glTF 2.0 file (" + (error.empty() ? "a property is missing" : error) +
                      "); export it again as .glb");
    for (Bytes& bytes_of : file->buffers) model.buffers.emplace_back().data = std::move(bytes_of);
    for (Bytes& bytes_of : file->images) model.images.emplace_back().image = std::move(bytes_of);
    return model;
}

Error too_much(const GltfUse& use) {
    return Error{"has more than " + std::to_string(use.most_vertices / 1'000'000) + " million vertices or " +
                 std::to_string(use.most_corners / 3'000'000) +
                 " million triangles; simplify it (with Blender's Decimate or gltfpack -si)"};
}

Result<GltfScene> read_scene(const tinygltf::Model& model, const std::string& path, const GltfUse& use) {
    auto refuse = [&](const Error& e) { return Error{path + ": " + e.message}; };
    GltfScene scene;
    try {
        if (auto done = read_nodes(model, scene); !done) return refuse(done.error());
        choose_scene(model, scene);
        if (auto done = read_skins(model, scene); !done) return refuse(done.error());
        read_vrm(model, scene);
        for (size_t a = 0; a < model.animations.size(); ++a) {
            const std::string& name = model.animations[a].name;
            scene.clips.push_back(name.empty() ? "animation " + std::to_string(a) : name);
        }
        auto meshes = read_meshes(model, use, scene);
        if (!meshes) return refuse(meshes.error());
        scene.meshes = std::move(*meshes);
    } catch (const std::bad_alloc&) {
        return Error{path + ": needs more memory than there is"};
    }
    return scene;
}

}  // namespace flaneur
