#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>

#include "renderer/people/skin.h"
#include "renderer/view.h"
#include "tests/renderer/synthetic_scene.h"
#include "tests/renderer/test_renderer.h"

namespace flaneur {
namespace {

constexpr uint32_t k_walkers = 500, k_triangles = 200;

struct Crowd {
    std::vector<PersonVertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<WalkerInstance> instances;
    std::vector<JointTransform> palette;
};

// Vertices have their numbers for colours, and walkers theirs for tints. Triangles about `size` metres large
// in a body of 2 m, moved by one to four joints; walkers in a ring about the origin, their joints turned
// anyhow.
Crowd random_crowd(float size) {
    Crowd crowd;
    std::mt19937 random(7);
    auto number = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    auto point = [&](float reach) {
        return glm::vec3(number(-reach, reach), number(-reach, reach), number(-reach, reach));
    };
    for (uint32_t i = 0; i < k_triangles; ++i) {
        const glm::vec3 middle = point(1);
        PersonVertex vertex{};
        const int bones = static_cast<int>(i % 4) + 1;
        for (int k = 0; k < bones; ++k) {
            vertex.joints[k] = static_cast<uint8_t>(random() % k_palette_joints);
            vertex.weights[k] = static_cast<uint8_t>(255 / bones);
        }
        vertex.weights[0] = static_cast<uint8_t>(vertex.weights[0] + 255 - bones * (255 / bones));
        for (int c = 0; c < 3; ++c) {
            vertex.position = middle + point(size);
            vertex.normal[c] = 127;
            vertex.colour = static_cast<uint32_t>(crowd.vertices.size());
            crowd.indices.push_back(vertex.colour);
            crowd.vertices.push_back(vertex);
            vertex.normal[c] = 0;
        }
    }
    for (uint32_t i = 0; i < k_walkers; ++i) {
        const float angle = 0.1f * static_cast<float>(i), away = 4 + 0.1f * static_cast<float>(i);
        crowd.instances.push_back({i * k_palette_joints, number(0.8f, 1.2f), {i}, 0});
        for (int j = 0; j < k_palette_joints; ++j) {
            const glm::vec4 turn(point(1), number(0.5f, 1));
            const glm::vec3 place = glm::vec3(std::sin(angle), 0, std::cos(angle)) * away + point(0.1f);
            crowd.palette.push_back({glm::normalize(turn), glm::vec4(place, 0)});
        }
    }
    return crowd;
}

struct Skinned {
    std::vector<SkinnedVertex> vertices;
    std::vector<uint32_t> indices;
    std::vector<DrawCommand> draws;
    const SkinnedVertex& at(const DrawCommand& draw, uint32_t i) const {
        return vertices[static_cast<size_t>(draw.vertex_offset) + indices[draw.first_index + i]];
    }
};

Skinned skinned(const Crowd& crowd, const SkinView& view) {
    const std::vector<SkinMesh> meshes = {make_skin_mesh(crowd.vertices, crowd.indices, 0)};
    const DrawCommand draw{static_cast<uint32_t>(crowd.indices.size()), k_walkers, 0, 0, 0};
    const SkinPlan plan = plan_skin(std::span(&draw, 1), meshes);
    EXPECT_EQ(plan.draws, 1u);
    Skinned out{std::vector<SkinnedVertex>(plan.vertices), std::vector<uint32_t>(plan.indices), {}};
    SkinScratch scratch;
    for (const SkinBatch& batch : plan.batches)
        out.draws.push_back(skin_batch(plan, batch, crowd.instances, crowd.palette, view, scratch,
                                       out.vertices.data(), out.indices.data()));
    return out;
}

// shaders/people/skin.glsl, more exactly.
struct Reference {
    glm::dvec3 place, normal;
};
Reference reference(const Crowd& crowd, uint32_t walker, uint32_t vertex) {
    const PersonVertex& from = crowd.vertices[vertex];
    const glm::dvec3 v = glm::dvec3(from.position) * double{crowd.instances[walker].scale};
    auto rotate = [](glm::dvec4 q, glm::dvec3 p) {
        const glm::dvec3 t = 2.0 * glm::cross(glm::dvec3(q), p);
        return p + q.w * t + glm::cross(glm::dvec3(q), t);
    };
    glm::dvec3 place(0);
    glm::dvec4 turn(0);
    for (int k = 0; k < 4; ++k) {
        const JointTransform& joint = crowd.palette[crowd.instances[walker].palette + from.joints[k]];
        const glm::dvec4 q(joint.rotation),
            own(crowd.palette[crowd.instances[walker].palette + from.joints[0]].rotation);
        const double weight = from.weights[k] / 255.0;
        place += weight * (rotate(q, v) + glm::dvec3(joint.translation));
        turn += weight * (glm::dot(own, q) < 0 ? -q : q);
    }
    const glm::dvec3 normal = glm::dvec3(from.normal[0], from.normal[1], from.normal[2]) / 127.0;
    return {place, rotate(glm::normalize(turn), normal)};
}

glm::dvec3 normal_of(const SkinnedVertex& vertex) {
    glm::dvec3 n;
    for (int c = 0; c < 3; ++c) n[c] = (static_cast<int32_t>(vertex.normal << (22 - 10 * c)) >> 22) / 511.0;
    return n;
}

// Whether a triangle covers the centre of a pixel of the picture, or reaches before the near plane.
bool shows_something(const Crowd& crowd, uint32_t walker, uint32_t triangle, const SkinView& view) {
    const glm::dmat4 clip_from_world(view.clip_from_world);
    const glm::dvec2 size(view.width, view.height);
    glm::dvec2 p[3], low(1e9), high(-1e9);
    for (uint32_t c = 0; c < 3; ++c) {
        const glm::dvec4 clip =
            clip_from_world * glm::dvec4(reference(crowd, walker, 3 * triangle + c).place, 1);
        if (clip.z >= clip.w) return true;
        p[c] = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size;
        low = glm::min(low, p[c]), high = glm::max(high, p[c]);
    }
    low = glm::max(low - 0.5, 0.0), high = glm::min(high, size);
    for (double y = std::ceil(low.y) + 0.5; y < high.y; ++y)
        for (double x = std::ceil(low.x) + 0.5; x < high.x; ++x) {
            auto is_inside = [&](glm::dvec2 a, glm::dvec2 b) {
                return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x) < 0;
            };
            if (is_inside(p[0], p[1]) && is_inside(p[1], p[2]) && is_inside(p[2], p[0])) return true;
        }
    return false;
}

TEST(Skin, PutsVerticesWhereTheFormulaDoes) {
    Crowd crowd = random_crowd(0.3f);
    // Of a triangle and its reverse one is seen.
    for (size_t i = 0; i < 3 * k_triangles; i += 3)
        for (size_t corner : {0, 2, 1}) crowd.indices.push_back(crowd.indices[i + corner]);
    const Camera camera{.eye = {0, 300, 0}, .target = {1, 0, 0}, .vertical_fov = 0.6f};
    const Skinned out = skinned(crowd, skin_view(make_view(camera, 1000, 1000), 30000, 30000));
    double place = 0, normal = 0;
    size_t drawn = 0;
    for (const DrawCommand& draw : out.draws) {
        drawn += draw.index_count;
        for (uint32_t i = 0; i < draw.index_count; ++i) {
            const SkinnedVertex& vertex = out.at(draw, i);
            const Reference expected = reference(crowd, vertex.tint, vertex.colour);
            place = std::max(place, glm::length(glm::dvec3(vertex.place) - expected.place));
            normal = std::max(normal, glm::length(normal_of(vertex) - expected.normal));
        }
    }
    EXPECT_GT(drawn, size_t{k_walkers} * k_triangles * 3 * 99 / 100);  // but for those seen from the edge
    RecordProperty("largest_difference_um", std::to_string(place * 1e6));
    EXPECT_LT(place, 2e-5);
    EXPECT_LT(normal, 2.0 / 511);
}

// In 127ths a normal may be longer than one. Turned along an axis it must not come out as the opposite.
TEST(Skin, ALongNormalPointsWhereItShould) {
    Crowd crowd = random_crowd(0.3f);
    const glm::vec3 long_normal = glm::vec3(127, 8, -8) / 127.0f;
    for (PersonVertex& vertex : crowd.vertices)
        vertex.normal[0] = 127, vertex.normal[1] = 8, vertex.normal[2] = -8;
    std::vector<glm::vec3> axes;
    for (int a = 0; a < 3; ++a)
        for (float sign : {-1.0f, 1.0f}) axes.push_back({}), axes.back()[a] = sign;
    for (size_t i = 0; i < crowd.palette.size(); ++i) {
        const glm::vec3 from = glm::normalize(long_normal), to = axes[i / k_palette_joints % axes.size()];
        crowd.palette[i].rotation = glm::normalize(glm::vec4(glm::cross(from, to), 1 + glm::dot(from, to)));
    }
    const Camera camera{.eye = {0, 300, 0}, .target = {1, 0, 0}, .vertical_fov = 0.6f};
    const Skinned out = skinned(crowd, skin_view(make_view(camera, 1000, 1000), 30000, 30000));
    size_t drawn = 0;
    for (const DrawCommand& draw : out.draws) {
        drawn += draw.index_count;
        for (uint32_t i = 0; i < draw.index_count; ++i) {
            const SkinnedVertex& vertex = out.at(draw, i);
            const glm::dvec3 axis(axes[vertex.tint % axes.size()]);
            ASSERT_LT(glm::length(normal_of(vertex) - axis), 2.0 / 511) << vertex.tint;
        }
    }
    EXPECT_GT(drawn, 1000u);
}

TEST(Skin, LeavesOutOnlyWhatShowsNothing) {
    const Crowd crowd = random_crowd(0.08f);
    const Camera camera{.eye = {3, 2, 0}, .target = {30, 0, 10}, .vertical_fov = 0.6f};
    const SkinView view = skin_view(make_view(camera, 640, 400), 640, 400);
    const Skinned out = skinned(crowd, view);
    std::vector<uint8_t> is_kept(size_t{k_walkers} * k_triangles);
    size_t kept = 0, seen = 0;
    for (const DrawCommand& draw : out.draws)
        for (uint32_t i = 0; i < draw.index_count; i += 3, ++kept)
            is_kept[out.at(draw, i).tint * k_triangles + out.at(draw, i).colour / 3] = 1;
    for (uint32_t walker = 0; walker < k_walkers; ++walker)
        for (uint32_t t = 0; t < k_triangles; ++t) {
            const bool shows = shows_something(crowd, walker, t, view);
            seen += shows;
            ASSERT_TRUE(is_kept[walker * k_triangles + t] || !shows) << walker << " " << t;
        }
    EXPECT_GT(seen, 500u);
    EXPECT_LT(kept, seen + seen / 2);
}

TEST(Skin, HostAndDeviceDrawTheSamePicture) {
    const SyntheticScene scene = synthetic_scene(150);
    for (const Quality quality : {Quality::medium, Quality::high}) {
        for (const bool is_finest : {false, true}) {
            Image pictures[2];
            for (const bool is_host : {false, true}) {
                RendererOptions options = validated();
                options.quality = quality;
                options.skins_on_host = is_host;
                Result<RendererPtr> renderer = make_renderer(options);
                ASSERT_TRUE(renderer) << renderer.error().message;
                ASSERT_TRUE(upload_scene(**renderer, scene.meshes));
                FrameInput frame = scene.frame(street_camera());
                frame.is_finest = is_finest;
                pictures[is_host] = *draw_image(**renderer, frame, 320, 180);
                EXPECT_GT(frame_stats(**renderer).walkers_drawn, 20u);
            }
            size_t differing = 0;
            for (size_t i = 0; i < pictures[0].rgba.size(); ++i)
                differing += std::abs(pictures[0].rgba[i] - pictures[1].rgba[i]) > 3;
            EXPECT_LT(differing, pictures[0].rgba.size() / 5000);
        }
    }
}

}  // namespace
}  // namespace flaneur
