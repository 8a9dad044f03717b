#include "assets/gltf/group/group.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>

#include "assets/files/picture.h"
#include "assets/gltf/glb.h"
#include "assets/gltf/group/keys.h"
#include "assets/gltf/write.h"

namespace flaneur {

namespace {

constexpr int k_floats = TINYGLTF_COMPONENT_TYPE_FLOAT, k_bytes = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
constexpr int k_vertices = TINYGLTF_TARGET_ARRAY_BUFFER;
constexpr std::array<const char*, k_follower_count> k_follower_names = {
    "skirtFront", "skirtBack", "bag", "looseHair", "scarfEnd", "walkingStick"};

// Of bones one below the other each takes its part of the bound: hips, three of the back, neck or shoulder,
// head or arm, forearm, hand, what hangs on it.
constexpr float k_bone_depth = 9;

// What the people of one character share.
struct Wardrobe {
    std::array<Vec3, k_bone_count> places{};    // of bones, in the pose of the bind
    std::array<int, k_bone_count> parents{};    // k_no_parent: the person's own node
    std::array<float, k_bone_count> reaches{};  // how far what a bone moves is from it
    std::array<int, k_bone_count> joints{};     // of the skin; -1: nothing hangs on it
    int inverse_binds = -1;
    struct Surface {
        std::vector<uint32_t> vertices;  // of the character
        tinygltf::Primitive primitive;   // all but colours
    };
    std::vector<Surface> surfaces;  // one for each picture, and one without
};

bool hangs(const CharacterVertex& v) { return v.hung_weights[0] > 0; }
const uint8_t* joints_of(const CharacterVertex& v) { return hangs(v) ? v.hung_joints : v.joints; }
const uint8_t* weights_of(const CharacterVertex& v) { return hangs(v) ? v.hung_weights : v.weights; }

void find_bones(const Character& c, Wardrobe& w) {
    for (size_t b = 0; b < k_bone_count; ++b) {
        const bool is_joint = b < k_joint_count;
        const Hung* hung = is_joint ? nullptr : &c.followers[b - k_joint_count];
        w.places[b] = is_joint ? c.bind_joints[b] : hung->place;
        w.parents[b] = is_joint ? k_joint_parents[b] : static_cast<int>(hung->joint);
        w.joints[b] = is_joint ? static_cast<int>(b) : -1;
    }
    int count = k_joint_count;
    for (const uint32_t i : c.lods[0]) {
        const CharacterVertex& v = c.vertices[i];
        for (int k = 0; k < 4; ++k) {
            if (weights_of(v)[k] == 0) continue;
            for (int b = joints_of(v)[k]; b != k_no_parent; b = w.parents[static_cast<size_t>(b)]) {
                const auto bone = static_cast<size_t>(b);
                if (w.joints[bone] < 0) w.joints[bone] = count++;
                w.reaches[bone] = std::max(w.reaches[bone], length(v.position - w.places[bone]));
            }
        }
    }
}

void add_inverse_binds(tinygltf::Model& model, Wardrobe& w) {
    std::vector<std::array<float, 16>> all;
    for (size_t b = 0; b < k_bone_count; ++b) {
        if (w.joints[b] < 0) continue;
        all.resize(std::max(all.size(), static_cast<size_t>(w.joints[b]) + 1));
        const Vec3 p = w.places[b];
        all[static_cast<size_t>(w.joints[b])] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -p.x, -p.y, -p.z, 1};
    }
    w.inverse_binds = add_accessor(model, all, TINYGLTF_TYPE_MAT4, k_floats, 0);
}

int add_material(tinygltf::Model& model, const Texture* picture) {
    tinygltf::Material material;
    material.name = "person";
    material.pbrMetallicRoughness.metallicFactor = 0;
    material.pbrMetallicRoughness.roughnessFactor = 0.9;
    if (picture) {
        material.pbrMetallicRoughness.baseColorTexture.index =
            add_texture(model, picture->rgba, picture->width, picture->height);
        for (size_t i = 3; i < picture->rgba.size(); i += 4)
            if (picture->rgba[i] < 255) material.alphaMode = "MASK";
    }
    model.materials.push_back(material);
    return static_cast<int>(model.materials.size()) - 1;
}

// `indices` are of the surface's own vertices.
void add_shape(tinygltf::Model& model, const Character& c, const Wardrobe& w, Wardrobe::Surface& surface,
               const std::vector<uint32_t>& indices, const Texture* picture) {
    std::vector<Vec3> places, normals;
    std::vector<std::array<float, 2>> uvs;
    std::vector<std::array<uint8_t, 4>> joints, weights;
    for (const uint32_t i : surface.vertices) {
        const CharacterVertex& v = c.vertices[i];
        places.push_back(v.position);
        normals.push_back(normalize_or(v.normal, {0, 1, 0}));
        uvs.push_back({v.u, v.v});
        auto& own_joints = joints.emplace_back();
        auto& own_weights = weights.emplace_back();
        for (size_t k = 0; k < 4; ++k) {
            own_weights[k] = weights_of(v)[k];
            const int joint = w.joints[joints_of(v)[k]];
            own_joints[k] = own_weights[k] > 0 ? static_cast<uint8_t>(joint) : uint8_t{0};
        }
    }
    auto& attributes = surface.primitive.attributes;
    attributes["POSITION"] = add_positions(model, places);
    attributes["NORMAL"] = add_accessor(model, normals, TINYGLTF_TYPE_VEC3, k_floats, k_vertices);
    attributes["JOINTS_0"] = add_accessor(model, joints, TINYGLTF_TYPE_VEC4, k_bytes, k_vertices);
    attributes["WEIGHTS_0"] = add_accessor(model, weights, TINYGLTF_TYPE_VEC4, k_bytes, k_vertices, true);
    if (picture)
        attributes["TEXCOORD_0"] = add_accessor(model, uvs, TINYGLTF_TYPE_VEC2, k_floats, k_vertices);
    surface.primitive.indices =
        add_accessor(model, indices, TINYGLTF_TYPE_SCALAR, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                     TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    surface.primitive.material = add_material(model, picture);
    surface.primitive.mode = TINYGLTF_MODE_TRIANGLES;
}

Wardrobe add_wardrobe(tinygltf::Model& model, const Character& c) {
    Wardrobe w;
    find_bones(c, w);
    add_inverse_binds(model, w);
    for (size_t picture = 0; picture <= c.textures.size(); ++picture) {
        Wardrobe::Surface surface;
        std::vector<uint32_t> indices;
        std::vector<uint32_t> place_of(c.vertices.size(), ~0u);
        for (const uint32_t i : c.lods[0]) {
            // All three corners of a triangle have one picture.
            if (std::min<size_t>(c.vertices[i].texture, c.textures.size()) != picture) continue;
            if (place_of[i] == ~0u) {
                place_of[i] = static_cast<uint32_t>(surface.vertices.size());
                surface.vertices.push_back(i);
            }
            indices.push_back(place_of[i]);
        }
        if (indices.empty()) continue;
        const bool is_painted = picture < c.textures.size();
        add_shape(model, c, w, surface, indices, is_painted ? &c.textures[picture] : nullptr);
        w.surfaces.push_back(std::move(surface));
    }
    return w;
}

int add_mesh(tinygltf::Model& model, const GlbPerson& person, const Wardrobe& w) {
    tinygltf::Mesh mesh;
    mesh.name = person.character->name;
    for (const Wardrobe::Surface& surface : w.surfaces) {
        std::vector<std::array<uint16_t, 4>> colours;
        for (const uint32_t i : surface.vertices) {
            const CharacterVertex& v = person.character->vertices[i];
            auto& colour = colours.emplace_back();
            colour.fill(0xffff);
            for (int k = 0; k < 3; ++k)
                colour[static_cast<size_t>(k)] = static_cast<uint16_t>(
                    std::lround(light_of(v.colour, 8 * k) *
                                light_of(person.tints[static_cast<size_t>(v.tint)], 8 * k) * 0xffff));
        }
        tinygltf::Primitive& primitive = mesh.primitives.emplace_back(surface.primitive);
        primitive.attributes["COLOR_0"] = add_accessor(
            model, colours, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, k_vertices, true);
    }
    model.meshes.push_back(mesh);
    return static_cast<int>(model.meshes.size()) - 1;
}

// A curve of a node, as accessors.
struct Curve {
    int node = 0;
    const char* path = "";
    int times = 0, values = 0;
    bool steps = false;
};

// Times that several curves share are there once.
struct Clock {
    std::map<std::vector<float>, int> accessors;
};

int add_times(tinygltf::Model& model, Clock& clock, const std::vector<float>& times) {
    const auto [found, is_new] = clock.accessors.try_emplace(times, 0);
    if (!is_new) return found->second;
    found->second = add_accessor(model, times, TINYGLTF_TYPE_SCALAR, k_floats, 0);
    model.accessors.back().minValues = {static_cast<double>(times.front())};
    model.accessors.back().maxValues = {static_cast<double>(times.back())};
    return found->second;
}

template <class T>
std::vector<T> picked(const std::vector<T>& all, const std::vector<uint32_t>& keys) {
    std::vector<T> some;
    some.reserve(keys.size());
    for (const uint32_t key : keys) some.push_back(all[key]);
    return some;
}

// A person on its way into the file.
struct Staged {
    const GlbPerson* person;
    const Wardrobe* wardrobe;
    std::vector<float> times;
    int root = 0;
    std::array<int, k_bone_count> nodes{};
    std::vector<Curve> curves;
};

// Keys take a time of their own each, unless all frames are taken.
bool is_worth_it(size_t keys, size_t frames, size_t bytes) {
    return keys * (bytes + sizeof(float)) < frames * bytes;
}

void add_places(tinygltf::Model& model, Clock& clock, Staged& s, size_t bone,
                const std::vector<Vec3>& places) {
    const float most = k_glb_bound / k_bone_depth / s.person->scale;
    std::vector<uint32_t> keys = keys_of(s.times, places, most);
    tinygltf::Node& node = model.nodes[static_cast<size_t>(s.nodes[bone])];
    if (keys.size() == 1) {  // as most bones, which keep their lengths
        node.translation = numbers(places[0]);
        return;
    }
    const bool is_short = is_worth_it(keys.size(), places.size(), sizeof(Vec3));
    const int times = add_times(model, clock, is_short ? picked(s.times, keys) : s.times);
    const int values =
        add_accessor(model, is_short ? picked(places, keys) : places, TINYGLTF_TYPE_VEC3, k_floats, 0);
    s.curves.push_back({s.nodes[bone], "translation", times, values});
}

void add_turns(tinygltf::Model& model, Clock& clock, Staged& s, size_t bone, const std::vector<Quat>& turns) {
    const float reach = std::max(s.wardrobe->reaches[bone] * s.person->scale, 1e-3f);
    std::vector<uint32_t> keys =
        keys_of(s.times, turns, std::min(k_glb_bound / k_bone_depth / reach, k_glb_turn));
    const bool is_short = is_worth_it(keys.size(), turns.size(), 4 * sizeof(int16_t));
    const int times = add_times(model, clock, is_short ? picked(s.times, keys) : s.times);
    std::vector<std::array<int16_t, 4>> values;
    for (const Quat q : is_short ? picked(turns, keys) : turns) {
        auto& value = values.emplace_back();
        const float parts[4] = {q.x, q.y, q.z, q.w};
        for (size_t k = 0; k < 4; ++k)
            value[k] = static_cast<int16_t>(std::lround(clamp(parts[k], -1, 1) * 0x7fff));
    }
    s.curves.push_back(
        {s.nodes[bone], "rotation", times,
         add_accessor(model, values, TINYGLTF_TYPE_VEC4, TINYGLTF_COMPONENT_TYPE_SHORT, 0, true)});
}

// Where a bone is turned about, as drawn.
Vec3 place_of(const Staged& s, const DrawnBones& pose, size_t bone) {
    return pose[bone].shift + rotate(pose[bone].turn, s.wardrobe->places[bone] * s.person->scale);
}

// Of each bone against its parent, which comes before it.
void add_curves(tinygltf::Model& model, Clock& clock, Staged& s, Vec3 stands) {
    for (size_t bone = 0; bone < k_bone_count; ++bone) {
        if (s.wardrobe->joints[bone] < 0) continue;
        std::vector<Vec3> places;
        std::vector<Quat> turns;
        for (const DrawnBones& pose : s.person->poses) {
            const int parent = s.wardrobe->parents[bone];
            Quat back;
            Vec3 from = stands;
            if (parent != k_no_parent) {
                back = conjugate(pose[static_cast<size_t>(parent)].turn);
                from = place_of(s, pose, static_cast<size_t>(parent));
            }
            places.push_back(rotate(back, place_of(s, pose, bone) - from) * (1 / s.person->scale));
            Quat turn = normalize(back * pose[bone].turn);
            // A turn has two quaternions: the one nearer to the frame before.
            if (!turns.empty() && dot(turn, turns.back()) < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
            turns.push_back(turn);
        }
        add_places(model, clock, s, bone, places);
        add_turns(model, clock, s, bone, turns);
    }
}

// Who is not there is of no size.
void add_presence(tinygltf::Model& model, Clock& clock, const GlbGroup& group, Staged& s) {
    std::vector<float> times;
    std::vector<Vec3> sizes;
    const std::vector<uint32_t>& frames = s.person->frames;
    auto be = [&](uint32_t frame, float size) {
        times.push_back(static_cast<float>(frame) / group.fps);
        sizes.push_back({size, size, size});
    };
    if (frames.front() > 0) be(0, 0);
    for (size_t i = 0; i < frames.size(); ++i) {
        if (i == 0 || frames[i] != frames[i - 1] + 1) be(frames[i], s.person->scale);
        const bool is_last = i + 1 == frames.size();
        if (is_last ? frames[i] + 1 < group.frames : frames[i + 1] != frames[i] + 1) be(frames[i] + 1, 0);
    }
    if (times.size() == 1) return;  // there all the time
    const int at = add_times(model, clock, times);
    s.curves.push_back(
        {s.root, "scale", at, add_accessor(model, sizes, TINYGLTF_TYPE_VEC3, k_floats, 0), true});
}

Staged add_person(tinygltf::Model& model, Clock& clock, const GlbGroup& group, const GlbPerson& person,
                  const Wardrobe& w) {
    assert(!person.frames.empty() && person.frames.size() == person.poses.size());
    Staged s{&person, &w, {}, static_cast<int>(model.nodes.size()), {}, {}};
    for (const uint32_t frame : person.frames) s.times.push_back(static_cast<float>(frame) / group.fps);
    const Vec3 stands = place_of(s, person.poses[0], hips) - Vec3{0, w.places[hips].y * person.scale, 0};
    tinygltf::Node root;
    root.name = person.name;
    root.translation = numbers(stands);
    root.scale = numbers({person.scale, person.scale, person.scale});
    model.nodes.push_back(root);

    const std::array<std::string, k_joint_count> names = vrm_joint_names();
    tinygltf::Skin skin;
    skin.name = person.name;
    skin.inverseBindMatrices = w.inverse_binds;
    for (size_t b = 0; b < k_bone_count; ++b) {
        if (w.joints[b] < 0) continue;
        s.nodes[b] = static_cast<int>(model.nodes.size());
        const bool is_root = w.parents[b] == k_no_parent;
        const auto parent = is_root ? size_t{0} : static_cast<size_t>(w.parents[b]);
        tinygltf::Node node;
        node.name = b < k_joint_count ? names[b] : k_follower_names[b - k_joint_count];
        node.translation = numbers(is_root ? w.places[b] : w.places[b] - w.places[parent]);
        model.nodes.push_back(node);
        model.nodes[static_cast<size_t>(is_root ? s.root : s.nodes[parent])].children.push_back(s.nodes[b]);
        skin.joints.resize(std::max(skin.joints.size(), static_cast<size_t>(w.joints[b]) + 1));
        skin.joints[static_cast<size_t>(w.joints[b])] = s.nodes[b];
    }
    skin.skeleton = s.nodes[hips];
    tinygltf::Node body;
    body.name = person.name + " body";
    body.mesh = add_mesh(model, person, w);
    body.skin = static_cast<int>(model.skins.size());
    model.skins.push_back(skin);
    model.scenes[0].nodes.push_back(s.root);
    model.scenes[0].nodes.push_back(static_cast<int>(model.nodes.size()));
    model.nodes.push_back(body);
    add_curves(model, clock, s, stands);
    add_presence(model, clock, group, s);
    return s;
}

void add_clip(tinygltf::Animation& animation, const std::vector<Curve>& curves) {
    for (const Curve& curve : curves) {
        tinygltf::AnimationSampler sampler;
        sampler.input = curve.times;
        sampler.output = curve.values;
        sampler.interpolation = curve.steps ? "STEP" : "LINEAR";
        tinygltf::AnimationChannel channel;
        channel.sampler = static_cast<int>(animation.samplers.size());
        channel.target_node = curve.node;
        channel.target_path = curve.path;
        animation.samplers.push_back(sampler);
        animation.channels.push_back(channel);
    }
}

}  // namespace

std::string group_glb(const GlbGroup& group) {
    tinygltf::Model model = begin_glb();
    model.scenes.emplace_back();
    model.defaultScene = 0;
    Clock clock;
    std::map<const Character*, Wardrobe> wardrobes;
    std::vector<Staged> all;
    for (const GlbPerson& person : group.people) {
        auto found = wardrobes.find(person.character);
        if (found == wardrobes.end())
            found = wardrobes.emplace(person.character, add_wardrobe(model, *person.character)).first;
        all.push_back(add_person(model, clock, group, person, found->second));
    }
    if (all.size() > 1) {
        tinygltf::Animation& everybody = model.animations.emplace_back();
        everybody.name = "everybody";
        for (const Staged& s : all) add_clip(everybody, s.curves);
    }
    for (const Staged& s : all) {
        tinygltf::Animation& own = model.animations.emplace_back();
        own.name = s.person->name;
        add_clip(own, s.curves);
    }
    return finish_glb(model);
}

}  // namespace flaneur
