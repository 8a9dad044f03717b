#include "tools/flaneur/view/show.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "assets/cache/cache_file.h"
#include "renderer/light/daylight.h"
#include "renderer/view.h"
#include "sim/base/math.h"
#include "sim/base/zone.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/view/sun.h"

namespace flaneur {

RendererOptions renderer_options(const Options& options, std::atomic<uint32_t>& messages) {
    auto count = [&messages](const std::string& message) {
        ++messages;
        clear_progress();
        std::fprintf(stderr, "%s\n", message.c_str());
    };
    RendererOptions out{options.device, quality_named(options.scene.quality), options.validate, count};
    out.warms_up = true;
    out.captures = options.captures;
    out.lights_on_host = options.lights_on_host;
    return out;
}

// Impostors of the same people on the same device are kept between runs.
static Result<void> upload_with_impostors(Renderer& renderer, SceneMeshes& meshes) {
    constexpr uint64_t k_most_bytes = 64 << 20;
    const std::string folder = cache_folder();
    if (folder.empty()) return upload_scene(renderer, meshes);
    const uint64_t key = impostors_key(renderer, meshes.people);
    const std::string path = kept_path(folder, "impostors", key);
    if (const std::optional<std::string> kept = read_kept(path, key, k_most_bytes)) {
        meshes.impostors.resize(kept->size() / sizeof(uint32_t));
        std::memcpy(meshes.impostors.data(), kept->data(), meshes.impostors.size() * sizeof(uint32_t));
    }
    if (Result<void> done = upload_scene(renderer, meshes); !done || !meshes.impostors.empty()) return done;
    const Result<std::vector<uint32_t>> baked = baked_impostors(renderer);
    if (!baked) return {};  // they are baked anew next time
    keep(path, key, {reinterpret_cast<const char*>(baked->data()), baked->size() * sizeof(uint32_t)});
    return {};
}

Result<void> check_messages(uint32_t messages) {
    if (messages == 0) return {};
    return Error{"The validation layer had something to say (" + std::to_string(messages) +
                 " times); see above."};
}

bool is_dark(const Sun& sun, bool is_overcast) { return make_daylight(sun, is_overcast).lamps > 0; }
bool is_dark(const Show& show) { return is_dark(show.sun, show.is_overcast); }

// Its city, its people, and then its movers, linkages, the ball, the phone, vehicles where one drives, and
// what goes along with people.
static SceneMeshes extract_show(const Show& show) {
    SceneMeshes meshes = extract_scene(*show.loaded.city, show.loaded.characters);
    for (PersonMesh& mover : extract_movers(show.loaded.world->movers))
        meshes.people.push_back(std::move(mover));
    for (PersonMesh& linkage : extract_linkages(show.loaded.world->linkages))
        meshes.people.push_back(std::move(linkage));
    meshes.people.push_back(extract_ball());
    meshes.people.push_back(extract_phone());
    if (show.loaded.world->roads)
        for (PersonMesh& vehicle : extract_vehicles()) meshes.people.push_back(std::move(vehicle));
    for (PersonMesh& thing : extract_alongside(*show.loaded.world)) meshes.people.push_back(std::move(thing));
    return meshes;
}

Result<PreparedShow> prepare_show(const Options& options) {
    PlayingPtr playing;
    if (!options.replay.empty()) {
        Result<PlayingPtr> opened = open_playing(options.replay, options.threads);
        if (!opened) return opened.error();
        playing = std::move(*opened);
    }
    Result<Loaded> loaded = load(options);
    if (!loaded) return loaded.error();
    show_progress("handing the city to the device");
    PreparedShow prepared;
    Show& show = prepared.show;
    show.loaded = std::move(*loaded);
    show.sun = scene_sun(options.scene, show.loaded.city->latitude);
    show.is_overcast = options.scene.is_overcast;
    show.lit_windows = lit_windows(options.scene.hour);
    show.without.on = options.techniques;
    show.lod = options.lod;
    if (playing) {
        // Bodies are recorded as they were drawn.
        show.draws_whole = playing->head.as == RecordedAs::motion;
        if (Result<void> shown = show_tick(*playing, *show.loaded.world, playing->first); !shown)
            return shown.error();
        show.playing = std::move(playing);
    }
    FLANEUR_ZONE("make meshes");
    prepared.meshes = extract_show(show);
    show.has_lamps = is_dark(show);
    if (show.has_lamps) prepared.meshes.lamps = extract_lamps(*show.loaded.city);
    return prepared;
}

Result<void> upload_show(Show& show, PreparedShow& prepared, WorkViews views) {
    FLANEUR_ZONE("hand the scene to the device");
    Result<void> uploaded = upload_with_impostors(*show.renderer, prepared.meshes);
    clear_progress();
    if (!uploaded) return uploaded;
    prepared.show.renderer = std::move(show.renderer);
    show = std::move(prepared.show);
    set_work_views(show, views);
    return {};
}

Result<void> upload_again(Show& show) {
    SceneMeshes meshes = extract_show(show);
    if (show.has_lamps) meshes.lamps = extract_lamps(*show.loaded.city);
    return upload_with_impostors(*show.renderer, meshes);
}

void say_device(const Renderer& renderer) {
    say("Drawing on " + device_name(renderer) + ", " + quality_name(renderer) + " quality");
}

Result<Show> make_show(RendererPtr renderer, const Options& options) {
    say_device(*renderer);
    Result<PreparedShow> prepared = prepare_show(options);
    if (!prepared) return prepared.error();
    Show show;
    show.renderer = std::move(renderer);
    if (Result<void> uploaded = upload_show(show, *prepared, options.scene.views); !uploaded)
        return uploaded.error();
    return show;
}

// Views for work are of what is near the eye; of a map, of what is near its middle.
static Camera close_camera(Camera camera) {
    constexpr float k_above = 10;  // metres
    const bool is_map = camera.clear_air > 0;
    if (is_map) camera.eye = camera.target - k_above * glm::normalize(camera.target - camera.eye);
    return camera;
}

// On a map of so much that people would be specks they are dots, but where density is shown, which they would
// hide; legends lie over them.
static void dot_people(Show& show, const View& view, const Camera& camera, FrameInput& frame) {
    constexpr float k_speck = 5, k_dot = 3.5f;  // pixels of a metre, and of a dot
    constexpr uint32_t k_person = ink(0xf7f4ee);
    const float metre = view.pixels_at_one_metre / glm::length(camera.target - camera.eye);
    if (camera.clear_air == 0 || metre > k_speck || show.work_views[WorkView::density] || show.hides_dots)
        return;
    std::vector<GizmoLine> dots;
    for (const WalkerId id : show.loaded.world->crowd.slots.living) {
        const WalkerDraw& walker = show.people.walkers[id.index];
        if (!sees_sphere(view, walker.centre, walker.radius)) continue;
        Pen pen;
        pen.pixels = k_dot;
        pen.colour =
            frame.people_colours == PeopleColours::tints ? walker.instance.tints[0] | 0xff000000u : k_person;
        add_point(dots, pen, walker.centre + glm::vec3(0, walker.radius, 0));
    }
    std::vector<GizmoLine>& lines = show.overlay.lines;
    lines.insert(lines.begin(), dots.begin(), dots.end());
    frame.lines = lines;
}

FrameInput extract_frame(Show& show, const Camera& camera, Size size, float between) {
    FLANEUR_ZONE("extract");
    const PoseNeeds needs = pose_needs(*show.renderer, camera, show.sun, static_cast<uint32_t>(size.width),
                                       static_cast<uint32_t>(size.height));
    if (!show.draws_whole) catch_up(show.without, *show.loaded.world);
    extract_people(*show.loaded.world, show.loaded.characters, show.people, between, needs,
                   show.draws_whole ? nullptr : &show.without);
    add_figures(show.loaded.world->figures, show.loaded.characters, show.people, between);
    const World& world = *show.loaded.world;
    const auto characters = static_cast<uint32_t>(show.loaded.characters.size()),
               movers = static_cast<uint32_t>(world.movers.all.size());
    add_movers(world.movers, characters, show.people, between);
    add_linkages(world.linkages, characters + movers, show.people, between,
                 static_cast<uint32_t>(world.figures.plans.size()));
    const uint32_t ball = characters + movers + static_cast<uint32_t>(world.linkages.all.size());
    add_balls(world.balls, ball, show.people, between, movers);
    add_phones(world, ball + 1, show.people, between);
    add_vehicles(world, show.loaded.characters, ball + 2, show.people, between);
    add_alongside(world, ball + 2 + vehicle_mesh_count(world), show.people, between);
    add_doers(world.deeds, show.loaded.characters, show.people, between,
              static_cast<uint32_t>(world.figures.plans.size() + world.linkages.all.size()));
    FrameInput frame;
    frame.camera = camera;
    frame.sun = show.sun;
    frame.walkers = show.people.walkers;
    frame.palette = show.people.palette;
    frame.grounds = show.people.grounds;
    frame.is_overcast = show.is_overcast;
    frame.lit_windows = show.lit_windows;
    const uint32_t lens_ticks = world.tick / k_lamp_ticks;
    frame.lens_time = static_cast<float>(lens_ticks);
    const Camera close = close_camera(camera);
    lay_over({*show.loaded.world, show.loaded.characters, close, between,
              show.draws_whole ? nullptr : &show.without},
             show.work_views, show.people, show.overlay, frame);
    dot_people(show, make_view(camera, static_cast<uint32_t>(size.width), static_cast<uint32_t>(size.height)),
               camera, frame);
    return frame;
}

void look_from(Show& show, const Camera& camera) {
    constexpr float k_usual_lens = 32 * k_radians;
    if (show.lod <= 0) return look_from(*show.loaded.world, {});
    auto half = [](float lens) {
        const SinCos h = sin_cos(lens / 2);
        return h.sine / h.cosine;
    };
    const float longer = std::max(half(k_usual_lens) / half(camera.vertical_fov), 1.0f);
    const Vec3 eye{camera.eye.x, camera.eye.y, camera.eye.z};
    look_from(*show.loaded.world, {&eye, 1}, show.lod * longer);
}

void step(Show& show) {
    World& world = *show.loaded.world;
    if (!show.draws_whole) keep_previous(show.without, world);
    if (show.playing) {
        const Result<void> shown = show_tick(*show.playing, world, world.tick + 1);
        if (!shown) show.playing->failed = shown.error();
    } else {
        step(world);
    }
    if (show.taking) (void)take(*show.taking, world);  // finish_taking() tells what failed
    if (show.work_views[WorkView::trails])
        follow_trails(*show.loaded.world, show.overlay.trails);
    else
        show.overlay.trails = {};
}

Result<void> go_straight(Show& show, uint32_t tick) {
    show.overlay.trails = {};
    return show_tick(*show.playing, *show.loaded.world, tick);
}

void set_work_views(Show& show, WorkViews views) {
    if (views[WorkView::wireframe] && !can_draw_wireframe(*show.renderer)) {
        say("This device draws no wireframe (it lacks fillModeNonSolid): normals are shown instead.");
        views = toggled(views, WorkView::normals);
    }
    show.work_views = views;
}

}  // namespace flaneur
