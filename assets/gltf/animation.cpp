#include "assets/gltf/animation.h"

#include <tiny_gltf.h>

#include <algorithm>

#include "assets/gltf/accessor.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr size_t k_most_keys = 2'000'000;

// Where a time lies between two keys.
struct KeySpan {
    size_t from, to;
    float share, seconds;
};

KeySpan span_at(const std::vector<float>& times, float time) {
    auto after = size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    if (after == 0) return {0, 0, 0, 0};
    if (after == times.size()) return {after - 1, after - 1, 0, 0};
    float seconds = times[after] - times[after - 1];
    return {after - 1, after, (time - times[after - 1]) / seconds, seconds};
}

Quat slerp(Quat a, Quat b, float t) {
    float cosine = dot(a, b);
    if (cosine < 0) b = {-b.x, -b.y, -b.z, -b.w}, cosine = -cosine;
    float wa = 1 - t, wb = t;
    if (cosine < 0.9995f) {
        float angle = arccos(cosine), over = 1 / sin_cos(angle).sine;
        wa = sin_cos(angle * wa).sine * over;
        wb = sin_cos(angle * wb).sine * over;
    }
    return {a.x * wa + b.x * wb, a.y * wa + b.y * wb, a.z * wa + b.z * wb, a.w * wa + b.w * wb};
}

Quat unit_or(Quat q, Quat otherwise) { return dot(q, q) > 1e-12f ? normalize(q) : otherwise; }

// glTF 2.0, appendix C.
Quat value_at(const GltfTrack& track, float time) {
    KeySpan s = span_at(track.times, time);
    size_t width = track.path == GltfTrack::Path::rotation ? 4 : 3;
    bool spline = track.way == GltfTrack::Way::cubic_spline;
    auto get = [&](size_t key, size_t part) {
        const float* v = &track.values[(spline ? 3 * key + part : key) * width];
        return Quat{v[0], v[1], v[2], width == 4 ? v[3] : 0};
    };
    Quat a = get(s.from, 1), b = get(s.to, 1);
    if (s.from == s.to || track.way == GltfTrack::Way::step) return a;
    float t = s.share;
    if (!spline && width == 4) return slerp(unit_or(a, {}), unit_or(b, {}), t);
    float wa = 1 - t, wb = t, wo = 0, wi = 0;
    Quat out{0, 0, 0, 0}, in = out;
    if (spline) {
        out = get(s.from, 2), in = get(s.to, 0);
        wb = t * t * (3 - 2 * t), wa = 1 - wb;
        wo = s.seconds * t * (1 - t) * (1 - t), wi = s.seconds * t * t * (t - 1);
    }
    return {wa * a.x + wb * b.x + wo * out.x + wi * in.x, wa * a.y + wb * b.y + wo * out.y + wi * in.y,
            wa * a.z + wb * b.z + wo * out.z + wi * in.z, wa * a.w + wb * b.w + wo * out.w + wi * in.w};
}

struct NodeParts {
    Vec3 place, scale{1, 1, 1};
    Quat rotation;
};

// A node's transform as a product of translation, rotation and scale, exact where it is one.
NodeParts part_of(const Affine& a) {
    NodeParts p{a.t, {length(a.x), length(a.y), length(a.z)}, {}};
    if (determinant(a) < 0) p.scale.x = -p.scale.x;
    p.rotation = rotation_in({p.scale.x < 0 ? -a.x : a.x, a.y, a.z, {}});
    return p;
}

Affine joined(const NodeParts& p) {
    return {rotate(p.rotation, {p.scale.x, 0, 0}), rotate(p.rotation, {0, p.scale.y, 0}),
            rotate(p.rotation, {0, 0, p.scale.z}), p.place};
}

// `room` is how many keys the animation may have yet.
Result<GltfTrack> read_track(const tinygltf::Model& model, const tinygltf::AnimationSampler& sampler,
                             const tinygltf::AnimationChannel& channel, const std::string& what,
                             size_t& room) {
    GltfTrack track;
    track.node = channel.target_node;
    if (track.node < 0 || size_t(track.node) >= model.nodes.size())
        return Error{what + " moves a node that does not exist"};
    track.path = channel.target_path == "rotation" ? GltfTrack::Path::rotation
                 : channel.target_path == "scale"  ? GltfTrack::Path::scale
                                                   : GltfTrack::Path::translation;
    track.way = sampler.interpolation == "STEP"          ? GltfTrack::Way::step
                : sampler.interpolation == "CUBICSPLINE" ? GltfTrack::Way::cubic_spline
                                                         : GltfTrack::Way::linear;
    auto times = read_accessor(model, sampler.input, what + "'s times", room);
    if (!times) return times.error();
    auto values = read_accessor(model, sampler.output, what + "'s values", 3 * times->count);
    if (!values) return values.error();
    size_t each = track.way == GltfTrack::Way::cubic_spline ? 3 : 1;
    int width = track.path == GltfTrack::Path::rotation ? 4 : 3;
    if (times->components != 1 || times->count == 0 || values->components != width ||
        values->count != each * times->count)
        return Error{what + " does not have one value a key"};
    for (size_t k = 0; k < times->count; ++k)
        if (!(times->values[k] >= 0) || (k > 0 && !(times->values[k] > times->values[k - 1])))
            return Error{what + "'s times do not rise"};
    for (float v : values->values)
        if (!(v > -1e9f && v < 1e9f)) return Error{what + " has values beyond reason"};
    room -= times->count;
    track.times = std::move(times->values);
    track.values = std::move(values->values);
    return track;
}

}  // namespace

Quat rotation_in(const Affine& a) {
    Vec3 x = normalize_or(a.x, {1, 0, 0});
    Quat first = rotation_between({1, 0, 0}, x);
    Vec3 turned = rotate(first, {0, 1, 0});
    Vec3 y = normalize_or(a.y - x * dot(a.y, x), turned);
    // The rest is a turn about x.
    float cosine = dot(turned, y), sine = dot(cross(turned, y), x);
    Quat about{x.x * sine, x.y * sine, x.z * sine, 1 + cosine};
    return normalize(unit_or(about, {x.x, x.y, x.z, 0}) * first);
}

Result<GltfAnimation> read_animation(const tinygltf::Model& model, size_t index) {
    const tinygltf::Animation& from = model.animations[index];
    GltfAnimation animation;
    size_t room = k_most_keys;
    animation.name = from.name.empty() ? std::to_string(index) : from.name;
    for (size_t c = 0; c < from.channels.size(); ++c) {
        const tinygltf::AnimationChannel& channel = from.channels[c];
        std::string what = "animation '" + animation.name + "', channel " + std::to_string(c);
        if (channel.target_node < 0 || channel.target_path == "weights") continue;
        if (channel.target_path != "translation" && channel.target_path != "rotation" &&
            channel.target_path != "scale")
            continue;  // an extension's
        if (channel.sampler < 0 || size_t(channel.sampler) >= from.samplers.size())
            return Error{what + " names a sampler that does not exist"};
        auto track = read_track(model, from.samplers[size_t(channel.sampler)], channel, what, room);
        if (!track) return track.error();
        bool first = animation.tracks.empty();
        animation.begin = first ? track->times.front() : std::min(animation.begin, track->times.front());
        animation.end = first ? track->times.back() : std::max(animation.end, track->times.back());
        animation.tracks.push_back(std::move(*track));
    }
    if (animation.tracks.empty()) return Error{"animation '" + animation.name + "' moves nothing"};
    return animation;
}

std::vector<Affine> pose_nodes(const GltfScene& scene, const GltfAnimation& animation, float time) {
    size_t count = scene.nodes.size();
    std::vector<NodeParts> parts(count);
    std::vector<uint8_t> moves(count, 0), done(count, 0);
    for (const GltfTrack& track : animation.tracks) {
        auto n = size_t(track.node);
        if (!moves[n]) parts[n] = part_of(scene.nodes[n].local), moves[n] = 1;
        Quat v = value_at(track, time);
        if (track.path == GltfTrack::Path::rotation) parts[n].rotation = unit_or(v, {});
        if (track.path == GltfTrack::Path::translation) parts[n].place = {v.x, v.y, v.z};
        if (track.path == GltfTrack::Path::scale) parts[n].scale = {v.x, v.y, v.z};
    }
    std::vector<Affine> world(count);
    std::vector<size_t> path;
    for (size_t n = 0; n < count; ++n) {
        for (int at = int(n); at >= 0 && !done[size_t(at)]; at = scene.nodes[size_t(at)].parent)
            path.push_back(size_t(at));
        for (; !path.empty(); path.pop_back()) {
            size_t at = path.back();
            Affine local = moves[at] ? joined(parts[at]) : scene.nodes[at].local;
            int parent = scene.nodes[at].parent;
            world[at] = parent < 0 ? local : world[size_t(parent)] * local;
            done[at] = 1;
        }
    }
    return world;
}

}  // namespace flaneur
