// Draws a picture of a crowd on a square, without a window, into picture.ppm: who walks comes from sim, how
// they look from assets, and renderer draws what extract makes of both on any Vulkan device, lavapipe too.
#include <flaneur/assets/population.h>
#include <flaneur/extract/extract.h>
#include <flaneur/renderer/renderer.h>
#include <flaneur/renderer/shapes.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

using namespace flaneur;

static void check(const auto& result) {
    if (result) return;
    std::fprintf(stderr, "picture: %s\n", result.error().message.c_str());
    std::exit(1);
}

int main() {
    // A square before two houses, and thirty people, each of a shape of their own.
    SceneMeshes scene;
    add_ground(scene.city, {-60, -60}, {60, 60}, 0, k_material_plaza, vertex_colour(0xb8aa92));
    add_block(scene.city, {-60, 26}, {4, 45}, 0, 13,
              {k_material_facade, vertex_colour(0xd9c7a3), facade_extra(3.2f, true)},
              {k_material_roof, vertex_colour(0x9a5b45)});
    add_block(scene.city, {4, 28}, {60, 45}, 0, 8.5f,
              {k_material_facade, vertex_colour(0xa8664e), facade_extra(2.8f, false, 3, WindowKind::arched)},
              {k_material_roof, vertex_colour(0x5b626b)});
    std::vector<Character> characters;
    WorldOptions options{.capacity = 30, .kinds = {}};
    for (const PersonOptions& person : draw_population(30, 7)) {
        const Character& made = characters.emplace_back(generate_person(person));
        scene.people.push_back(extract_character(made));
        options.kinds.push_back({made.body, 1, person.age, person.woman});
    }

    // They stroll about it for five seconds.
    const Vec3 corners[] = {{-7, 0, -7}, {-7, 0, 9}, {7, 0, 9}, {7, 0, -7}};
    const uint32_t triangles[] = {0, 1, 2, 0, 2, 3};
    Result<WorldPtr> world = make_world({corners, triangles}, options);
    check(world);
    for (uint32_t kind = 0; kind < characters.size(); ++kind)
        check(add_walker(**world, {.kind = kind, .wanders = true}));
    for (int tick = 0; tick < 300; ++tick) step(**world);

    Result<RendererPtr> renderer = make_renderer({});
    check(renderer);
    check(upload_scene(**renderer, scene));
    PeopleFrame people;
    extract_people(**world, characters, people);
    FrameInput frame;
    frame.camera = {.eye = {2, 1.7f, -12}, .target = {0.3f, 1.35f, 0}, .vertical_fov = 0.42f};
    frame.sun = {.direction = {0.8f, 0.45f, -0.4f}};
    frame.walkers = people.walkers;
    frame.palette = people.palette;
    frame.grounds = people.grounds;
    Result<Image> image = draw_image(**renderer, frame, 960, 540);
    check(image);
    std::ofstream file("picture.ppm", std::ios::binary);
    file << "P6 960 540 255\n";
    for (size_t i = 0; i < image->rgba.size(); i += 4)
        file.write(reinterpret_cast<const char*>(&image->rgba[i]), 3);
    return file.flush() ? 0 : 1;
}
