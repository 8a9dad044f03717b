#include "assets/gltf/character/clip.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assets/files/file.h"
#include "assets/gltf/animation.h"
#include "assets/gltf/character/character.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_rate = 30, k_longest = 600, k_same_pose = 5 * k_radians;

std::string plain(std::string_view name) {
    size_t bar = name.rfind('|');
    std::string out(bar == std::string_view::npos ? name : name.substr(bar + 1));
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return out;
}

Result<size_t> find_animation(const tinygltf::Model& model, const std::string& name) {
    const auto& all = model.animations;
    if (all.empty()) return Error{"has no animations; export it with them"};
    auto find = [&](auto&& fits) { return size_t(std::find_if(all.begin(), all.end(), fits) - all.begin()); };
    std::string wanted = name.empty() ? "idle" : plain(name);
    size_t found = find([&](auto& a) { return a.name == name && !name.empty(); });
    if (found == all.size()) found = find([&](auto& a) { return plain(a.name) == wanted; });
    if (found < all.size()) return found;
    if (name.empty()) {
        found = find([&](auto& a) { return plain(a.name).find(wanted) != std::string::npos; });
        return found < all.size() ? found : 0;
    }
    std::string names;
    for (size_t i = 0; i < all.size() && i < 40; ++i)
        names += (names.empty() ? "" : ", ") + (all[i].name.empty() ? "(no name)" : all[i].name);
    return Error{"has no animation '" + name + "'; it has " + names};
}

// Poses the mapped joints of a scene whose nodes stand at `world`.
LocalPose pose_of(const MappedCharacter& mapped, const std::vector<Affine>& world) {
    const RigMap& map = mapped.map;
    auto in_axes = [&](Vec3 v) { return Vec3{dot(v, map.left), dot(v, map.up), dot(v, map.ahead)}; };
    LocalPose pose;
    pose.rotations.resize(k_joint_count);
    std::array<Quat, k_joint_count> turned;  // in model space
    for (size_t j = 0; j < k_joint_count; ++j) {
        int parent = k_joint_parents[j], rig = map.joints[j];
        Quat above = parent == k_no_parent ? Quat{} : turned[size_t(parent)];
        turned[j] = above;  // a joint that the file lacks goes along
        if (rig != k_not_found && size_t(rig) < mapped.nodes.size()) {
            const Affine& bind = mapped.binds[size_t(rig)];
            Affine now = world[size_t(mapped.nodes[size_t(rig)])];
            Quat q = rotation_in(now * inverse(bind));
            Vec3 axis = in_axes({q.x, q.y, q.z});
            turned[j] = Quat{axis.x, axis.y, axis.z, q.w} * conjugate(mapped.character.bind_to_canonical[j]);
            if (j == hips) pose.offset = in_axes(now.t - bind.t) * mapped.scale;
        }
        pose.rotations[j] = normalize(conjugate(above) * turned[j]);
    }
    return pose;
}

float widest_angle(const LocalPose& a, const LocalPose& b) {
    float least = 1;
    for (size_t j = 0; j < a.rotations.size(); ++j)
        least = std::min(least, std::fabs(dot(a.rotations[j], b.rotations[j])));
    return 2 * arccos(least);
}

Result<RecordedMotion> resample(const GltfScene& scene, const MappedCharacter& mapped,
                                const GltfAnimation& animation) {
    float length = animation.end - animation.begin;
    if (length > k_longest)
        return Error{"animation '" + animation.name + "' is longer than ten minutes; cut it"};
    for (const Affine& bind : mapped.binds)
        if (!invertible(bind)) return Error{"has a joint that is bound with no size"};
    auto steps = size_t(length * k_rate + 0.5f);
    RecordedMotion motion;
    motion.name = animation.name;
    motion.rate = steps > 0 ? float(steps) / length : k_rate;
    for (size_t k = 0; k <= steps; ++k) {
        float share = steps > 0 ? float(k) / float(steps) : 0;
        auto world = pose_nodes(scene, animation, animation.begin + length * share);
        motion.keys.push_back(pose_of(mapped, world));
    }
    motion.loops = steps > 1 && widest_angle(motion.keys.front(), motion.keys.back()) < k_same_pose;
    if (motion.loops) motion.keys.pop_back();
    return motion;
}

}  // namespace

ClipName split_clip(const std::string& text) {
    std::vector<size_t> ends = {text.size()};
    for (size_t i = text.size(); i-- > 0;)
        if (text[i] == ':') ends.push_back(i);
    auto split_at = [&](size_t end) {
        return ClipName{text.substr(0, end), end < text.size() ? text.substr(end + 1) : ""};
    };
    std::error_code unknown;
    for (size_t end : ends)
        if (std::filesystem::is_regular_file(text.substr(0, end), unknown)) return split_at(end);
    // It is not there; what it is called in the error.
    for (size_t end : ends)
        if (kind_of(text.substr(0, end)) == FileKind::gltf) return split_at(end);
    return split_at(text.size());
}

Result<RecordedMotion> load_motion(const std::string& path, const std::string& name) {
    auto model = parse_gltf(path);
    return model ? make_motion(*model, path, name) : model.error();
}

Result<RecordedMotion> make_motion(const tinygltf::Model& model, const std::string& path,
                                   const std::string& name) {
    auto refuse = [&](const Error& e) { return Error{path + ": " + e.message}; };
    auto scene = read_scene(model, path);
    if (!scene) return scene.error();
    auto found = find_animation(model, name);
    if (!found) return refuse(found.error());
    auto animation = read_animation(model, *found);
    if (!animation) return refuse(animation.error());
    auto mapped = map_character(*scene);
    if (!mapped) return refuse(mapped.error());
    auto motion = resample(*scene, *mapped, *animation);
    if (!motion) return refuse(motion.error());
    if (auto clip = additive_clip(*motion); !clip) return refuse(clip.error());
    return motion;
}

Result<Clip> additive_clip(const RecordedMotion& motion) {
    Skeleton skeleton = humanoid(standard_body(1.7f));  // of which only the shape of the tree counts
    return make_additive_clip(skeleton, motion.keys, motion.keys[0], motion.rate, motion.loops,
                              Curve::linear);
}

}  // namespace flaneur
