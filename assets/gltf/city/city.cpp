#include "assets/gltf/city/city.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <new>

#include "assets/cities.h"
#include "assets/files/file.h"
#include "assets/gltf/city/ground.h"
#include "assets/gltf/read.h"

namespace flaneur {

namespace {

constexpr float k_far = 20'000;         // no city is wider, metres
constexpr float k_most_ground = 40e6f;  // square metres of the rectangle about it: no map is drawn larger
constexpr float k_steepest = 0.766f;    // cosine of 40 degrees
constexpr float k_storey = 0.5f;        // heights of ground are counted in such slices, metres

struct Gathered {
    Scenery scenery;
    std::vector<Hint> hints;
};

std::string rounded(float v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", static_cast<double>(v));
    return text;
}

// The node's own name speaks before those above it; a material's before all.
Hint hint_of(const GltfScene& scene, const std::string& material, int node) {
    Hint hint;
    if (read_hint(material, hint)) return hint;
    for (; node >= 0; node = scene.nodes[size_t(node)].parent)
        if (read_hint(scene.nodes[size_t(node)].name, hint)) return hint;
    return hint;
}

// Where a skin's joints put the vertices at rest.
std::vector<Affine> rest_of(const GltfScene& scene, const GltfNode& node, const GltfPrimitive& p) {
    std::vector<Affine> out(p.positions.size(), node.world);
    if (node.skin < 0 || p.influences_per_vertex == 0) return out;
    const GltfSkin& skin = scene.skins[size_t(node.skin)];
    auto each = size_t(p.influences_per_vertex);
    for (size_t v = 0; v < out.size(); ++v) {
        Affine sum{{}, {}, {}, {}};
        float total = 0;
        for (size_t i = 0; i < each; ++i) {
            const auto& by = p.influences[v * each + i];
            if (by.joint >= skin.joints.size()) continue;
            Affine a = scene.nodes[size_t(skin.joints[by.joint])].world * skin.inverse_binds[by.joint];
            sum = {sum.x + a.x * by.weight, sum.y + a.y * by.weight, sum.z + a.z * by.weight,
                   sum.t + a.t * by.weight};
            total += by.weight;
        }
        if (total > 1e-6f) out[v] = {sum.x / total, sum.y / total, sum.z / total, sum.t / total};
    }
    return out;
}

// Directions square to a surface, under a transform that may stretch and mirror.
Vec3 moved_normal(const Affine& a, Vec3 n) {
    Vec3 moved = cross(a.y, a.z) * n.x + cross(a.z, a.x) * n.y + cross(a.x, a.y) * n.z;
    return determinant(a) < 0 ? -moved : moved;
}

Result<void> add_primitive(const GltfScene& scene, const GltfNode& node, const GltfPrimitive& p, float scale,
                           const Hint& hint, Gathered& out) {
    Scenery& s = out.scenery;
    auto first = static_cast<uint32_t>(s.vertices.size());
    std::vector<Affine> places = rest_of(scene, node, p);
    for (size_t v = 0; v < p.positions.size(); ++v) {
        Scenery::Vertex vertex;
        vertex.position = transform(places[v], p.positions[v]) * scale;
        float far = std::max(
            {std::fabs(vertex.position.x), std::fabs(vertex.position.y), std::fabs(vertex.position.z)});
        if (!(far < 1e9f)) return Error{"has vertices beyond reason; export it again"};
        if (!p.normals.empty()) vertex.normal = moved_normal(places[v], p.normals[v]);
        if (!p.uvs.empty()) vertex.uv = p.uvs[v];
        vertex.colour = p.colours[v];
        s.vertices.push_back(vertex);
    }
    bool mirrored = determinant(node.world) < 0;
    uint32_t picture = p.texture == CharacterVertex::k_no_texture ? ~0u : p.texture;
    for (size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        uint32_t a = first + p.indices[i], b = first + p.indices[i + 1], c = first + p.indices[i + 2];
        if (mirrored) std::swap(b, c);
        Vec3 pa = s.vertices[a].position;
        Vec3 normal = cross(s.vertices[b].position - pa, s.vertices[c].position - pa);
        if (!(dot(normal, normal) > 1e-16f)) continue;  // of no extent
        s.indices.insert(s.indices.end(), {a, b, c});
        s.pictures.push_back(picture);
        out.hints.push_back(hint);
    }
    return {};
}

// Vertices without a normal take those of their triangles, by area.
void finish_normals(Scenery& s) {
    std::vector<Vec3> sums(s.vertices.size());
    for (size_t i = 0; i + 2 < s.indices.size(); i += 3) {
        Vec3 a = s.vertices[s.indices[i]].position, b = s.vertices[s.indices[i + 1]].position,
             c = s.vertices[s.indices[i + 2]].position;
        for (size_t k = 0; k < 3; ++k) sums[s.indices[i + k]] += cross(b - a, c - a);
    }
    for (size_t v = 0; v < s.vertices.size(); ++v) {
        Vec3 sum = sums[v];
        float size = length(sum);
        Vec3 own = size > 0 ? sum / size : Vec3{0, 1, 0};
        Vec3 normal = s.vertices[v].normal;
        float long_enough = length(normal);
        s.vertices[v].normal = long_enough > 0 && long_enough < 1e30f ? normal / long_enough : own;
    }
}

Result<Gathered> gather(const tinygltf::Model& model, const GltfScene& scene, float scale) {
    Gathered out;
    size_t vertices = 0, corners = 0;
    auto visit = [&](auto&& take) {
        for (size_t n = 0; n < scene.nodes.size(); ++n) {
            const GltfNode& node = scene.nodes[n];
            if (!node.shown || node.mesh < 0) continue;
            for (const GltfPrimitive& p : scene.meshes[size_t(node.mesh)]) take(static_cast<int>(n), p);
        }
    };
    visit([&](int, const GltfPrimitive& p) {
        vertices += p.positions.size();
        corners += p.indices.size();
    });
    // The file may show a mesh many times.
    if (vertices > k_city_use.most_vertices || corners > k_city_use.most_corners) return too_much(k_city_use);
    out.scenery.vertices.reserve(vertices);
    out.scenery.indices.reserve(corners);
    Result<void> done;
    visit([&](int n, const GltfPrimitive& p) {
        if (!done) return;
        bool named = p.material >= 0 && size_t(p.material) < model.materials.size();
        Hint hint = hint_of(scene, named ? model.materials[size_t(p.material)].name : "", n);
        done = add_primitive(scene, scene.nodes[size_t(n)], p, scale, hint, out);
    });
    if (!done) return done.error();
    finish_normals(out.scenery);
    return out;
}

struct SceneBox {
    Vec3 low{1e30f, 1e30f, 1e30f}, high{-1e30f, -1e30f, -1e30f};
};
SceneBox box_of(const Scenery& s) {
    SceneBox box;
    for (uint32_t i : s.indices) {
        Vec3 p = s.vertices[i].position;
        box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
        box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
    }
    return box;
}

// Square metres that face along `up`, within 40 degrees.
double area_towards(const Scenery& s, Vec3 up) {
    double area = 0;
    for (size_t i = 0; i + 2 < s.indices.size(); i += 3) {
        Vec3 a = s.vertices[s.indices[i]].position;
        Vec3 n = cross(s.vertices[s.indices[i + 1]].position - a, s.vertices[s.indices[i + 2]].position - a);
        float size = length(n);
        if (dot(n, up) >= k_steepest * size) area += static_cast<double>(size) / 2;
    }
    return area;
}

// The height of the lowest slice that holds a tenth of all that faces up.
float lowest_level(const Scenery& s, float low, float high) {
    std::vector<double> slices(static_cast<size_t>((high - low) / k_storey) + 1), sums(slices.size());
    double all = 0;
    for (size_t i = 0; i + 2 < s.indices.size(); i += 3) {
        Vec3 a = s.vertices[s.indices[i]].position, b = s.vertices[s.indices[i + 1]].position,
             c = s.vertices[s.indices[i + 2]].position;
        Vec3 n = cross(b - a, c - a);
        float size = length(n), y = (a.y + b.y + c.y) / 3;
        if (n.y < k_steepest * size) continue;
        size_t slice = std::min(static_cast<size_t>((y - low) / k_storey), slices.size() - 1);
        slices[slice] += static_cast<double>(size);
        sums[slice] += static_cast<double>(size) * static_cast<double>(y);
        all += static_cast<double>(size);
    }
    for (size_t slice = 0; slice < slices.size(); ++slice)
        if (slices[slice] > 0 && slices[slice] >= all / 10)
            return static_cast<float>(sums[slice] / slices[slice]);
    return low;
}

void move_by(Scenery& s, Vec3 by) {
    for (Scenery::Vertex& v : s.vertices) v.position += by;
}

// Upright and about the origin.
Result<void> canonicalise(Scenery& s, std::vector<std::string>& notes) {
    if (s.indices.empty()) return Error{"shows no triangles; a city needs ground to walk on"};
    // glTF's up is +y. Where hardly anything faces it, the file was written by who thought of +z.
    double upright = area_towards(s, {0, 1, 0}), lying = area_towards(s, {0, 0, 1});
    if (lying > 20 * upright) {
        for (Scenery::Vertex& v : s.vertices) {
            v.position = {v.position.x, v.position.z, -v.position.y};
            v.normal = {v.normal.x, v.normal.z, -v.normal.y};
        }
        notes.push_back("Its ground faces +z; taken for up.");
    }
    SceneBox box = box_of(s);
    Vec3 size = box.high - box.low;
    float widest = std::max({size.x, size.y, size.z});
    if (!(widest <= k_far))
        return Error{"is " + rounded(widest) +
                     " m across, which is no city; give --scale, such as 0.01 for centimetres"};
    Vec3 by;
    bool beside = box.low.x > 0 || box.high.x < 0 || box.low.z > 0 || box.high.z < 0;
    if (beside) by = {-(box.low.x + box.high.x) / 2, 0, -(box.low.z + box.high.z) / 2};
    float level = lowest_level(s, box.low.y, box.high.y);
    if (std::fabs(level) > 1) by.y = -level;
    if (by == Vec3{}) return {};
    move_by(s, by);
    notes.push_back("Moved by " + rounded(by.x) + ", " + rounded(by.y) + ", " + rounded(by.z) +
                    " m, to stand about the origin.");
    return {};
}

void take_pictures(GltfScene& from, Scenery& to) {
    for (Texture& t : from.textures) to.images.push_back({t.width, t.height, std::move(t.rgba)});
}

}  // namespace

Result<City> load_gltf_city(const std::string& path, float scale) {
    auto model = parse_gltf(path);
    return model ? make_gltf_city(*model, path, scale) : model.error();
}

Result<City> load_city(const std::string& path, const CityOptions& options) {
    if (kind_of(path) == FileKind::map) return load_osm(path, options);
    if (!options.terrain.empty()) {
        return Error{path + " is a glTF scene and has its own ground; terrain (" + options.terrain +
                     ") lies under OpenStreetMap cities only."};
    }
    if (options.center || options.radius > 0)
        return Error{path +
                     " is a glTF scene; a center and a radius are cut out of OpenStreetMap maps only."};
    return load_gltf_city(path, options.scale);
}

Result<City> make_gltf_city(const tinygltf::Model& model, const std::string& path, float scale) {
    auto refuse = [&](const Error& e) { return Error{path + ": " + e.message}; };
    auto scene = read_scene(model, path, k_city_use);
    if (!scene) return scene.error();
    City city;
    try {
        auto gathered = gather(model, *scene, scale);
        if (!gathered) return refuse(gathered.error());
        city.ground.name = std::filesystem::path(path).stem().string();
        city.notes = std::move(scene->notes);
        city.scenery = std::move(gathered->scenery);
        city.scenery.holds_ground = true;
        if (auto done = canonicalise(city.scenery, city.notes); !done) return refuse(done.error());
        take_pictures(*scene, city.scenery);
        if (auto done = find_ground(city, gathered->hints); !done) return refuse(done.error());
        index_city(city);
        Vec2 size = city.ground.high - city.ground.low;
        if (size.x * size.z > k_most_ground)
            return refuse(
                Error{"has ground of " + std::to_string(std::lround(size.x)) + " x " +
                      std::to_string(std::lround(size.z)) +
                      " m, more than the 6 x 6 km that people find their ways about in; cut out a part, "
                      "or give --scale, such as 0.01 for centimetres"});
    } catch (const std::bad_alloc&) {
        return refuse(Error{"needs more memory than there is"});
    }
    return city;
}

}  // namespace flaneur
