#include "tests/assets/tiny_man.h"

#include <algorithm>
#include <stdexcept>

namespace flaneur {

namespace {

struct Boxes {
    std::vector<float> positions, weights;
    std::vector<uint8_t> joints;
    std::vector<uint16_t> indices;
};

void add_box(Boxes& out, int joint, Vec3 from, Vec3 to, Quat turn) {
    auto first = uint16_t(out.positions.size() / 3);
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 p = (corner & 4 ? to : from) + Vec3{corner & 1 ? 0.02f : -0.02f, 0, corner & 2 ? 0.02f : -0.02f};
        p.y = std::max(p.y, 0.0f);
        p = rotate(turn, p);
        out.positions.insert(out.positions.end(), {p.x, p.y, p.z});
        out.joints.insert(out.joints.end(), {uint8_t(joint), 0, 0, 0});
        out.weights.insert(out.weights.end(), {1, 0, 0, 0});
    }
    for (int i : {0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5,
                  2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 7, 3, 1, 5, 7})
        out.indices.push_back(uint16_t(first + i));
}

void put_word(Bytes& out, size_t word) {
    for (int shift : {0, 8, 16, 24}) out.push_back(uint8_t(word >> shift));
}

}  // namespace

std::vector<TinyBone> tiny_bones() {
    Body body = standard_body(1.7f);
    auto places = body.joints;
    for (int j : {left_lower_arm, left_hand, right_lower_arm, right_hand}) {
        size_t shoulder = j < right_shoulder ? left_upper_arm : right_upper_arm;
        Vec3 hanging = body.joints[size_t(j)] - body.joints[shoulder];
        places[size_t(j)] = body.joints[shoulder] + Vec3{j < right_shoulder ? -hanging.y : hanging.y, 0, 0};
    }
    std::vector<TinyBone> bones;
    for (int j = 0; j < k_joint_count; ++j) {
        Vec3 place = places[size_t(j)], to = place + Vec3{0, 0.12f, 0};
        for (int c = j + 1; c < k_joint_count; ++c)
            if (k_joint_parents[size_t(c)] == j && c != left_shoulder && c != right_shoulder &&
                c != left_upper_leg && c != right_upper_leg)
                to = places[size_t(c)];
        if (j == left_hand || j == right_hand) to = place + Vec3{j == left_hand ? 0.15f : -0.15f, 0, 0};
        if (j == left_toes || j == right_toes) to = place + Vec3{0, 0, body.toe};
        bones.push_back({std::string(k_joint_names[size_t(j)]), k_joint_parents[size_t(j)], place, to});
    }
    return bones;
}

int find_bone(const std::vector<TinyBone>& bones, const std::string& name) {
    for (size_t j = 0; j < bones.size(); ++j)
        if (bones[j].name == name) return int(j);
    throw std::invalid_argument("no bone " + name);
}

void add_bone(std::vector<TinyBone>& bones, const std::string& name, const std::string& parent, Vec3 place,
              Vec3 to) {
    bones.push_back({name, parent.empty() ? -1 : find_bone(bones, parent), place, to});
}
void add_helper(std::vector<TinyBone>& bones, const std::string& name, const std::string& parent,
                Vec3 place) {
    bones.push_back({name, parent.empty() ? -1 : find_bone(bones, parent), place, place, false});
}

void drop_bone(std::vector<TinyBone>& bones, const std::string& name, bool keep_flesh) {
    int gone = find_bone(bones, name), parent = bones[size_t(gone)].parent;
    if (keep_flesh) bones[size_t(parent)].to = bones[size_t(gone)].to;
    bones.erase(bones.begin() + gone);
    for (TinyBone& bone : bones)
        if (bone.parent == gone)
            bone.parent = parent;
        else if (bone.parent > gone)
            --bone.parent;
}

std::vector<TinyBone> bones_below(const std::vector<TinyBone>& first, int parent,
                                  std::vector<TinyBone> bones) {
    std::vector<TinyBone> all = first;
    for (TinyBone& bone : bones) {
        bone.parent = bone.parent < 0 ? parent : bone.parent + int(first.size());
        all.push_back(bone);
    }
    return all;
}

void split_bone(std::vector<TinyBone>& bones, const std::string& name) {
    int first = find_bone(bones, name);
    TinyBone& bone = bones[size_t(first)];
    Vec3 half = lerp(bone.place, bone.to, 0.5f);
    TinyBone second{name + ".001", first, half, bone.to};
    bone.to = half;
    bones.insert(bones.begin() + first + 1, second);
    for (size_t j = size_t(first) + 2; j < bones.size(); ++j)
        if (bones[j].parent >= first) ++bones[j].parent;
}

TinyMan tiny_rig(const std::vector<TinyBone>& bones, Quat turn) {
    TinyMan man;
    Json& gltf = man.gltf;
    Boxes boxes;
    std::vector<float> binds;
    gltf["asset"]["version"] = "2.0";
    gltf["scene"] = 0;
    for (size_t j = 0; j < bones.size(); ++j) {
        const TinyBone& bone = bones[j];
        Vec3 from = bone.parent < 0 ? Vec3{} : bones[size_t(bone.parent)].place;
        Vec3 t = rotate(turn, bone.place - from), bound = rotate(turn, bone.place);
        gltf["nodes"].push_back({{"name", bone.name}, {"translation", {t.x, t.y, t.z}}});
        if (bone.parent < 0)
            gltf["scenes"][0]["nodes"].push_back(j);
        else
            gltf["nodes"][size_t(bone.parent)]["children"].push_back(j);
        if (bone.carries_flesh) add_box(boxes, int(j), bone.place, bone.to, turn);
        binds.insert(binds.end(), {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -bound.x, -bound.y, -bound.z, 1});
        gltf["skins"][0]["joints"].push_back(j);
    }
    gltf["scenes"][0]["nodes"].push_back(bones.size());
    gltf["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    Json& primitive = gltf["meshes"][0]["primitives"][0];
    primitive["attributes"]["POSITION"] = add_accessor(man, boxes.positions, "VEC3");
    primitive["attributes"]["JOINTS_0"] = add_accessor(man, boxes.joints, "VEC4");
    primitive["attributes"]["WEIGHTS_0"] = add_accessor(man, boxes.weights, "VEC4");
    primitive["indices"] = add_accessor(man, boxes.indices, "SCALAR");
    gltf["skins"][0]["inverseBindMatrices"] = add_accessor(man, binds, "MAT4");
    return man;
}

TinyMan tiny_man(Quat turn) { return tiny_rig(tiny_bones(), turn); }

int add_accessor(TinyMan& man, const void* data, size_t bytes, int component, const char* type,
                 size_t count) {
    size_t begin = man.bytes.size(), number = man.gltf["accessors"].size();
    man.bytes.resize((begin + bytes + 3) / 4 * 4);
    std::memcpy(man.bytes.data() + begin, data, bytes);
    man.gltf["accessors"].push_back({{"bufferView", man.gltf["bufferViews"].size()},
                                     {"componentType", component},
                                     {"type", type},
                                     {"count", count}});
    man.gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes}});
    man.gltf["buffers"][0]["byteLength"] = man.bytes.size();
    return int(number);
}

void animate(TinyMan& man, int node, const char* path, const char* way, const std::vector<float>& times,
             const std::vector<float>& values) {
    bool turns = std::string_view(path) == "rotation";
    int input = add_accessor(man, times, "SCALAR"),
        output = add_accessor(man, values, turns ? "VEC4" : "VEC3");
    Json& animation = man.gltf["animations"][0];
    animation["name"] = "Man|Sway";
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", way}});
}

Bytes as_glb(const TinyMan& man) {
    std::string json = man.gltf.dump();
    json.resize((json.size() + 3) / 4 * 4, ' ');
    Bytes out = {'g', 'l', 'T', 'F', 2, 0, 0, 0};
    put_word(out, 28 + json.size() + man.bytes.size());
    put_word(out, json.size());
    put_word(out, 0x4e4f534a);
    out.insert(out.end(), json.begin(), json.end());
    put_word(out, man.bytes.size());
    put_word(out, 0x004e4942);
    out.insert(out.end(), man.bytes.begin(), man.bytes.end());
    return out;
}

Bytes as_gltf(const TinyMan& man) {
    Json gltf = man.gltf;
    gltf["buffers"][0]["uri"] = "data:application/octet-stream;base64," + as_base64(man.bytes);
    std::string json = gltf.dump();
    return {json.begin(), json.end()};
}

std::string as_base64(const Bytes& bytes) {
    constexpr const char* k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t n = 0; n < 3; ++n) bits = bits << 8 | (i + n < bytes.size() ? bytes[i + n] : 0u);
        for (size_t n = 0; n < 4; ++n)
            out += i + n > bytes.size() ? '=' : k_digits[bits >> (18 - 6 * n) & 63];
    }
    return out;
}

}  // namespace flaneur
