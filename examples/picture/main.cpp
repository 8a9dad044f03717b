// Draws a picture of a crowd on a square, without a window, into picture.ppm: who walks comes from sim, how
// they look from assets, and renderer draws it on whatever Vulkan device there is, lavapipe too.
#include <flaneur/assets/character.h>
#include <flaneur/assets/outfit.h>
#include <flaneur/assets/population.h>
#include <flaneur/renderer/renderer.h>
#include <flaneur/renderer/shapes.h>
#include <flaneur/sim/sim.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace flaneur;

static glm::vec3 to_glm(Vec3 v) { return {v.x, v.y, v.z}; }

static void check(const auto& result) {
    if (result) return;
    std::fprintf(stderr, "picture: %s\n", result.error().message.c_str());
    std::exit(1);
}

static PersonMesh mesh_of(const Character& character) {
    PersonMesh mesh;
    mesh.lods = character.lods;
    for (const CharacterVertex& from : character.vertices) {
        PersonVertex& v = mesh.vertices.emplace_back();
        v.position = to_glm(from.position);
        v.colour = from.colour;
        for (int i = 0; i < 3; ++i) v.normal[i] = static_cast<int8_t>(to_glm(from.normal)[i] * 127);
        v.normal[3] = static_cast<int8_t>(from.tint);
        std::copy_n(from.joints, 4, v.joints);
        std::copy_n(from.weights, 4, v.weights);
        v.texture = ~0u;
    }
    return mesh;
}

int main() {
    // A square with a house behind it, and thirty people, each of a shape of their own.
    SceneMeshes scene;
    add_ground(scene.city, {-60, -60}, {60, 60}, 0, k_material_plaza, vertex_colour(0xb8aa92));
    add_block(scene.city, {-30, 20}, {30, 40}, 0, 13,
              {k_material_facade, vertex_colour(0xd9c7a3), facade_extra(3.2f, true)},
              {k_material_roof, vertex_colour(0x9a5b45)});
    std::vector<Character> characters;
    WorldOptions options;
    options.kinds.clear();
    options.capacity = 30;
    for (const PersonOptions& person : draw_population(30, 7)) {
        characters.push_back(generate_person(person));
        scene.people.push_back(mesh_of(characters.back()));
        options.kinds.push_back({characters.back().body, 1, person.age, person.woman});
    }

    const Vec3 corners[] = {{-12, 0, -12}, {-12, 0, 16}, {12, 0, 16}, {12, 0, -12}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    Result<WorldPtr> world = make_world({corners, triangles, {}}, options);
    check(world);
    WalkerOptions stroller;
    stroller.wanders = true;
    for (stroller.kind = 0; stroller.kind < characters.size(); ++*stroller.kind)
        check(add_walker(**world, stroller));
    for (int tick = 0; tick < 300; ++tick) step(**world);

    // One draw for each walker, and the transforms of its joints from the mesh to the world.
    std::vector<WalkerDraw> draws;
    std::vector<JointTransform> palette;
    for (WalkerId walker : walkers(**world)) {
        uint32_t kind = motion_of(**world, walker)->kind;
        const Character& character = characters[kind];
        std::array<JointPose, k_joint_count> pose;
        pose_of(**world, walker, pose);
        WalkerDraw& draw = draws.emplace_back();
        draw.centre = to_glm(pose[hips].position);
        draw.mesh = kind;
        draw.instance.palette = static_cast<uint32_t>(palette.size());
        draw.instance.scale = 1;
        std::ranges::copy(outfit(character.person, 1, walker.index), draw.instance.tints);
        for (int j = 0; j < k_joint_count; ++j) {
            Quat turn = pose[j].rotation * character.bind_to_canonical[j];
            Vec3 shift = pose[j].position - rotate(turn, character.bind_joints[j]);
            palette.push_back({{turn.x, turn.y, turn.z, turn.w}, {to_glm(shift), 0}});
        }
    }

    Result<RendererPtr> renderer = make_renderer({});
    check(renderer);
    check(upload_scene(**renderer, scene));
    FrameInput frame;
    frame.camera.eye = {3, 1.7f, -16};
    frame.camera.target = {0, 1.4f, 0};
    frame.sun.direction = {0.48f, 0.6f, -0.64f};
    frame.walkers = draws;
    frame.palette = palette;
    Result<Image> image = draw_image(**renderer, frame, 960, 540);
    check(image);
    std::ofstream file("picture.ppm", std::ios::binary);
    file << "P6 960 540 255\n";
    for (size_t i = 0; i < image->rgba.size(); i += 4)
        file.write(reinterpret_cast<const char*>(&image->rgba[i]), 3);
    return file.flush() ? 0 : 1;
}
