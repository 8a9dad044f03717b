#include "tools/flaneur/load/load.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string>

#include "assets/additions.h"
#include "assets/cache/cache_file.h"
#include "assets/cache/navmesh_cache.h"
#include "assets/cache/person_cache.h"
#include "assets/cities.h"
#include "assets/demand/demand_file.h"
#include "assets/files/file.h"
#include "assets/gltf/character/clip.h"
#include "assets/gltf/city/triangles.h"
#include "assets/idles.h"
#include "assets/pastimes/places.h"
#include "assets/population.h"
#include "assets/quayside.h"
#include "assets/stages/asteroid.h"
#include "assets/stages/course.h"
#include "assets/stages/dais.h"
#include "assets/stages/field.h"
#include "assets/stages/gallery.h"
#include "assets/stages/planets.h"
#include "assets/stages/platform.h"
#include "assets/stages/yard.h"
#include "assets/traced/hall.h"
#include "assets/traced/ways.h"
#include "sim/alongside/alongside.h"
#include "sim/base/zone.h"
#include "sim/pastimes/pastimes.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/sent.h"

namespace flaneur {

namespace {

constexpr uint32_t k_built_in_people = 24;

constexpr int k_most_blocks = 32;

void print_notes(const std::string& source, const std::vector<std::string>& notes) {
    std::string line;
    for (const std::string& note : notes) say((line = source).append(": ").append(note));
}

// Those of a scene, each once: who is named again is not loaded again, but is a larger part of all walkers.
std::vector<PeopleShare> distinct_people(const Scene& scene) {
    std::vector<PeopleShare> distinct;
    for (const PeopleShare& some : scene.people) {
        auto known = std::find_if(distinct.begin(), distinct.end(),
                                  [&](const PeopleShare& d) { return d.character == some.character; });
        if (known == distinct.end()) {
            distinct.push_back(some);
        } else {
            known->share += some.share;
        }
    }
    if (distinct.empty()) distinct.emplace_back();
    return distinct;
}

// Fills these: a kind for each character, without its share, and its part. The built-in people but for those
// who push prams share what they have evenly.
Result<void> add_people(const Options& options, Loaded& loaded, std::vector<Kind>& kinds) {
    const Scene& scene = options.scene;
    kinds.clear();
    for (const PeopleShare& some : distinct_people(scene)) {
        std::vector<Character> added;
        std::vector<float> shares;
        if (some.character.empty()) {
            std::vector<PersonOptions> people = draw_population(k_built_in_people, scene.seed);
            const std::vector<Pusher> pushers = draw_pushers(scene.seed);
            float others = 1;
            for (const Pusher& pusher : pushers) others -= pusher.share;
            shares.assign(people.size(), others / static_cast<float>(people.size()));
            for (const Pusher& pusher : pushers) {
                people.push_back(pusher.person);
                shares.push_back(pusher.share);
            }
            auto made = make_people(people, options.threads);
            if (!made) return made.error();
            added = std::move(*made);
        } else {
            Result<Character> character = read_character(some.character, options.force);
            if (!character) return character.error();
            added.push_back(std::move(*character));
            shares = {1};
        }
        for (size_t i = 0; i < added.size(); ++i) {
            Character& c = added[i];
            kinds.push_back({c.body, 1, c.person.age, c.person.woman});
            loaded.parts.push_back({some.character, shares[i]});
            loaded.characters.push_back(std::move(c));
        }
    }
    return {};
}

Result<std::vector<Clip>> load_idles(const Scene& scene) {
    std::vector<Clip> clips;
    std::set<std::string> known;
    for (const std::string& idle : scene.idles) {
        if (!known.insert(idle).second) continue;
        if (std::optional<Clip> own = built_in_idle(idle)) {
            clips.push_back(std::move(*own));
            continue;
        }
        show_progress("reading " + idle);
        ClipName name = split_clip(idle);
        Result<RecordedMotion> motion = load_motion(name.file, name.clip);
        if (!motion) return motion.error();
        Result<Clip> clip = additive_clip(*motion);
        if (!clip) return Error{idle + ": " + clip.error().message};
        clips.push_back(std::move(*clip));
    }
    return clips;
}

}  // namespace

bool grows_with_walkers(const Scene& scene) { return is_of(scene, BuiltIn::district); }

// A district as large as the scene says, or as its walkers need to walk rather than queue: some 750 to a
// block.
int district_blocks(const Scene& scene) {
    int blocks = scene.blocks;
    while (blocks < k_most_blocks && blocks * blocks * 750 < scene.walkers) ++blocks;
    return blocks;
}

static float times_usual(const PeopleMix& mix, const PersonOptions& person) {
    float times = 1;
    if (person.age < k_grown_up) times *= mix.children;
    if (person.age >= k_old_age) times *= mix.old;
    if (person.stick) times *= mix.canes;
    if (person.pram) times *= mix.prams;
    if (person.phone) times *= mix.phones;
    return times;
}

std::vector<float> shares_of(const std::vector<PeopleShare>& people, const PeopleMix& mix,
                             const std::vector<Character>& characters,
                             const std::vector<PeopleShare>& parts) {
    std::vector<float> shares;
    for (size_t i = 0; i < parts.size(); ++i) {
        float share = people.empty() ? 1.0f : 0.0f;
        for (const PeopleShare& some : people)
            if (some.character == parts[i].character) share += some.share;
        const bool is_built_in = parts[i].character.empty();
        shares.push_back(share * parts[i].share * (is_built_in ? times_usual(mix, characters[i].person) : 1));
    }
    return shares;
}

void set_shares(WorldOptions& options, const std::vector<float>& shares) {
    for (size_t i = 0; i < shares.size(); ++i) options.kinds[i].share = shares[i];
}

void set_shares(World& world, const std::vector<float>& shares) {
    for (size_t i = 0; i < shares.size(); ++i) world.kinds[i].share = world.folk[i].share = shares[i];
}

// Where people can walk in a city: as an earlier run kept it, or built.
static Result<NavmeshPtr> load_navmesh(const Ground& ground, const NavmeshSettings& settings, int threads) {
    FLANEUR_ZONE("navigation mesh");
    auto mesh = cached_navmesh(ground, settings, threads, cache_folder(), [](float share) {
        show_progress("building the navigation mesh " + std::to_string(static_cast<int>(share * 100)) + " %");
        return !is_stopping();
    });
    clear_progress();
    return mesh;
}

CityOptions city_options(const Scene& scene) {
    return {scene.terrain, scene.scale, scene.center, scene.radius, [](std::string_view what, float done) {
                show_progress(std::string(what) + " " + std::to_string(static_cast<int>(done * 100)) + " %");
            }};
}

// A file's triangles as a closed shape.
static Result<RockMesh> load_rock(const std::string& path) {
    constexpr float k_long = 36;  // metres
    show_progress("reading " + path);
    Result<GltfTriangles> read = load_triangles(path);
    if (!read) return read.error();
    Result<RockMesh> solid = make_rock_mesh(std::move(read->vertices), std::move(read->indices), k_long);
    if (!solid) return Error{path + " " + solid.error().message + "."};
    return solid;
}

// Of a scene that is_small_world().
static Result<SmallWorld> make_small_world(const Scene& scene) {
    constexpr float k_ring = 13, k_tube = 5;  // metres
    constexpr int k_around = 192, k_across = 80;
    if (Result<void> found = find_files(scene); !found) return found.error();
    show_progress("making the rock");
    if (is_of(scene, BuiltIn::planets)) return make_planets(scene.seed, scene.walkers);
    if (scene.rock.empty()) return make_asteroid(scene.seed, scene.walkers);
    Result<RockMesh> solid =
        scene.rock == k_torus ? make_torus(k_ring, k_tube, k_around, k_across) : load_rock(scene.rock);
    if (!solid) return solid.error();
    return make_rock(*solid, scene.seed, scene.walkers);
}

Result<std::shared_ptr<const Trajectories>> read_recorded(const Scene& scene) {
    show_progress("reading " + scene.trajectories);
    Result<Trajectories> read = read_trajectories(scene.trajectories, scene.reading);
    if (!read) return read.error();
    print_notes(scene.trajectories, read->assumed);
    return std::make_shared<const Trajectories>(std::move(*read));
}

uint32_t last_tick_of(const Trajectories& recorded) {
    const std::vector<Sighting>& all = recorded.sightings;
    const uint32_t frames = all.back().frame - all.front().frame;
    if (frames == 0) return static_cast<uint32_t>(k_picture * 60);
    return static_cast<uint32_t>(std::min(std::round(frames / wide(recorded.fps) * 60), 1.0 * k_last_tick));
}

Result<City> read_city(const Scene& scene) {
    Result<City> city = read_bare_city(scene);
    if (!city) return city;
    if (Result<void> done = add_to_city(*city, scene.added); !done) return done.error();
    return city;
}

Result<City> read_bare_city(const Scene& scene) {
    FLANEUR_ZONE("read the city");
    if (Result<void> found = find_files(scene); !found) return found.error();
    show_progress("making the city");
    constexpr int k_many_blocks = 12;
    if (const int blocks = district_blocks(scene);
        grows_with_walkers(scene) && blocks > scene.blocks && blocks >= k_many_blocks)
        say(scene.name + ": grows to " + std::to_string(blocks) + " times " + std::to_string(blocks) +
            " blocks for " + std::to_string(scene.walkers) + " walkers, which may take minutes to make.");
    if (is_recorded(scene)) {
        const Result<std::shared_ptr<const Trajectories>> recorded = read_recorded(scene);
        return recorded ? Result<City>(build_hall(**recorded, scene.name)) : recorded.error();
    }
    if (is_small_world(scene)) {
        Result<SmallWorld> world = make_small_world(scene);
        if (!world) return world.error();
        return std::move(world->stage);
    }
    if (is_of(scene, BuiltIn::platform)) return build_platform(platform_of(scene));
    if (is_of(scene, BuiltIn::field)) return build_field(scene.seed);
    if (is_of(scene, BuiltIn::gallery)) return build_gallery(scene.seed);
    if (is_of(scene, BuiltIn::quayside)) return build_quayside(scene.seed);
    if (is_of(scene, BuiltIn::yard)) return build_yard(scene.seed);
    if (is_of(scene, BuiltIn::course)) return build_course(scene.seed, scene.flat);
    Result<City> city = scene.city.empty()
                            ? generate_district({scene.seed, district_blocks(scene), scene.trams})
                            : load_city(scene.city, city_options(scene));
    if (is_stopping()) return interrupted();
    if (city) print_notes(scene.city.empty() ? scene.name : scene.city, city->notes);
    return city;
}

Result<Character> read_character(const std::string& path, bool force) {
    show_progress("reading " + path);
    Result<Character> character = load_character(path, {force, cache_folder()});
    if (character) print_notes(path, character->notes);
    return character;
}

Result<std::vector<Character>> make_people(const std::vector<PersonOptions>& options, int threads) {
    FLANEUR_ZONE("make people");
    show_progress("making people");
    std::vector<Character> people(options.size());
    std::string folder = cache_folder();
    WorkersPtr workers = make_workers(threads);
    parallel_for(*workers, people.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end && !is_stopping(); ++i) people[i] = cached_person(options[i], folder);
    });
    if (is_stopping()) return interrupted();
    return people;
}

std::vector<std::string> files_of(const Scene& scene) {
    std::vector<std::string> paths{scene.city, scene.terrain, scene.demand, scene.trajectories};
    if (scene.rock != k_torus) paths.push_back(scene.rock);
    for (const PeopleShare& some : scene.people) paths.push_back(some.character);
    for (const std::string& idle : scene.idles)
        if (!is_built_in_idle(idle)) paths.push_back(split_clip(idle).file);
    return paths;
}

std::string city_name(const Scene& scene) {
    return scene.city.empty() ? scene.name : std::filesystem::path(scene.city).stem().string();
}

Result<void> find_files(const Scene& scene) {
    for (const std::string& path : files_of(scene)) {
        if (path.empty()) continue;
        if (Result<void> found = find_file(path); !found) return found;
    }
    return {};
}

// On which side its people pass each other.
static PassOn side_of(const Scene& scene, const City& city) {
    const bool is_left = city.on_earth && is_driven_on_left(city.on_earth->middle);
    return scene.side.value_or(is_left ? PassOn::left : PassOn::right);
}

// Who leaves and who is sent, and room for those sent.
static Result<void> settle_coming(const Scene& scene, Loaded& loaded, WorldOptions& world) {
    constexpr uint32_t k_most_at_once = 20'000;
    if (!scene.stays && !is_recorded(scene) && !is_small_world(scene) && !is_of(scene, BuiltIn::course))
        world.leaving = k_usual_leaving;
    world.capacity = world.walkers;
    if (scene.demand.empty()) return {};
    Result<SentPeople> sent = load_demand(scene.demand, *loaded.city);
    if (!sent) return sent.error();
    print_notes(scene.demand, sent->notes);
    world.sendings = std::move(sent->sendings);
    loaded.sent_names = std::move(sent->names);
    uint32_t people = 0;
    for (const Sending& sending : world.sendings) people += sending.people;
    world.capacity = std::min(world.walkers + std::min(people, k_most_at_once), uint32_t{k_max_walkers});
    return {};
}

static void set_figures(std::vector<FigurePlan> plans, std::shared_ptr<const Ground> ground, World& world) {
    std::vector<Body> bodies;
    for (const Kind& kind : world.kinds) bodies.push_back(kind.body);
    world.figures = make_figures(std::move(plans), std::move(ground), bodies, world.seed);
}

static void set_deeds(std::vector<DoerPlan> plans, Things things, std::shared_ptr<const Ground> ground,
                      size_t first_mover, World& world) {
    std::vector<Body> bodies;
    for (const Kind& kind : world.kinds) bodies.push_back(kind.body);
    world.deeds = make_deeds(std::move(plans), std::move(things), std::move(ground), bodies, world.seed);
    world.deeds.first_mover = first_mover;
    if (world.deeds.plans.empty()) return;
    lead_movers(world.deeds, world.movers);
    forget_previous(world.movers);
}

// Who has both hands free and legs that reach from stone to stone.
static void spare_course(std::vector<Kind>& kinds) {
    constexpr float k_shortest = 0.56f;  // metres, of legs
    for (Kind& kind : kinds)
        if (kind.body.cane != Vec3{} || kind.body.pram != Vec3{} || leg_length(kind.body) < k_shortest)
            kind.share = 0;
}

Result<Loaded> load(const Options& options) {
    FLANEUR_ZONE("load");
    const Scene& scene = options.scene;
    if (!is_recorded(scene) && usual_walkers(scene.built) != usual_walkers(BuiltIn::district) &&
        scene.walkers == usual_walkers(scene.built))
        say(std::to_string(scene.walkers) +
            " walkers, as many as surely find room here; --walkers says how many.");
    Loaded loaded;
    std::optional<SmallWorld> round;
    if (is_small_world(scene)) {
        Result<SmallWorld> made = make_small_world(scene);
        if (!made) return made.error();
        round = std::move(*made);
    }
    std::shared_ptr<const Trajectories> recorded = options.recorded;
    if (is_recorded(scene) && !recorded) {
        Result<std::shared_ptr<const Trajectories>> read = read_recorded(scene);
        if (!read) return read.error();
        recorded = std::move(*read);
    }
    Result<City> bare = recorded ? Result<City>(build_hall(*recorded, scene.name))
                        : round  ? Result<City>(std::move(round->stage))
                                 : read_bare_city(scene);
    if (!bare) return bare.error();
    if (!scene.lamps) take_lamps(bare->crossings);
    loaded.city = loaded.bare = std::make_shared<const City>(std::move(*bare));
    if (!scene.added.empty()) {
        City city = *loaded.bare;
        if (Result<void> done = add_to_city(city, scene.added); !done) return done.error();
        loaded.city = std::make_shared<const City>(std::move(city));
    }

    WorldOptions world;
    world.destinations = loaded.city->destinations;
    Result<void> peopled = add_people(options, loaded, world.kinds);
    if (!peopled) return peopled.error();
    set_shares(world, shares_of(scene.people, scene.mix, loaded.characters, loaded.parts));
    if (is_of(scene, BuiltIn::course)) spare_course(world.kinds);

    Result<std::vector<Clip>> idles = load_idles(scene);
    if (!idles) return idles.error();

    world.idles = std::move(*idles);
    world.walkers = static_cast<uint32_t>(scene.walkers);
    world.seed = scene.seed;
    world.threads = options.threads;
    world.hour = scene.hour;
    world.pass_on = side_of(scene, *loaded.city);
    world.habit = scene.habit;
    world.platform = platform_of(scene);
    world.drunk = scene.drunk;
    world.drunks = static_cast<uint32_t>(std::min(scene.drunks, scene.walkers));
    world.pushes = scene.pushes;
    world.throws = scene.balls;
    world.helpers = scene.helpers;
    world.crossings = loaded.city->crossings;
    world.jaywalkers = scene.jaywalkers;
    world.groups = scene.groups;
    world.acquaintances = scene.acquaintances;
    world.along = scene.along;
    world.lanes = loaded.city->lanes;
    world.traffic = scene.traffic;
    world.limbs = scene.limbs;
    world.pastimes = scene.pastimes;
    world.pastime_places = pastime_places(*loaded.city);
    if (is_of(scene, BuiltIn::platform)) world.navmesh.agent_radius = k_off_the_edge;
    if (Result<void> settled = settle_coming(scene, loaded, world); !settled) return settled.error();
    std::shared_ptr<const Traces> traces;
    if (recorded) {
        show_progress("making ways of " + scene.trajectories);
        RecordedWays ways = make_ways(*recorded, scene.entering, scene.seed);
        print_notes(scene.trajectories, told(ways.figures));
        traces = std::make_shared<const Traces>(std::move(ways.traces));
        world.capacity = traces->most;
    }
    auto progress = [](std::string_view what, float done) {
        show_progress(std::string(what) + " " + std::to_string(static_cast<int>(done * 100)) + " %");
        return !is_stopping();
    };
    Result<NavmeshPtr> mesh = load_navmesh(loaded.city->ground, world.navmesh, options.threads);
    if (!mesh) return mesh.error();
    Result<std::vector<std::string>> unwalkable = check_sent(world.sendings, loaded.sent_names, **mesh);
    if (!unwalkable) return Error{"The demand " + excerpt(scene.demand) + " " + unwalkable.error().message};
    print_notes(scene.demand, *unwalkable);
    FLANEUR_ZONE("set people down");
    auto made = make_world(std::shared_ptr<const Ground>(loaded.city, &loaded.city->ground), std::move(*mesh),
                           world, progress);
    clear_progress();
    if (!made) return made.error();
    loaded.world = std::move(*made);
    if (round) {
        Result<void> set = set_down(*loaded.world, std::move(round->compound),
                                    static_cast<uint32_t>(scene.creatures), std::move(round->gravity));
        if (!set) return set.error();
    }
    if (traces) follow_traces(*loaded.world, std::move(traces));
    if (is_of(scene, BuiltIn::course)) {
        if (Result<void> set = set_on_course(*loaded.world, make_course(scene.flat)); !set)
            return set.error();
        if (scene.look) look_at(*loaded.world, scene.look);
    }
    if (is_of(scene, BuiltIn::gallery)) {
        loaded.world->linkages = make_linkages(make_exhibits(scene.seed));
        set_figures(make_figure_plans(loaded.world->kinds), make_figure_ground(), *loaded.world);
    }
    if (scene.steppers > 0) {
        Result<void> set =
            let_step(*loaded.world, static_cast<uint32_t>(scene.steppers), {scene.steppers_way});
        if (!set) return set.error();
    }
    if (!round && scene.creatures > 0) {
        Result<void> set = set_loose(*loaded.world, static_cast<uint32_t>(scene.creatures));
        if (!set) return set.error();
    }
    if (is_of(scene, BuiltIn::yard)) {
        const Things things = yard_things({});
        loaded.world->movers = make_movers(yard_movers(things));
        set_deeds(yard_plans(loaded.world->kinds, {}), things, make_yard_ground({}), 0, *loaded.world);
    }
    return loaded;
}

PeopleOrder order_people(const Loaded& loaded, uint64_t seed, uint32_t walkers) {
    const World& world = *loaded.world;
    PeopleOrder order;
    WorldOptions& options = order.options;
    options.destinations = loaded.city->destinations;
    options.kinds = world.kinds;
    options.idles = world.idles.clips;
    options.walkers = walkers;
    options.seed = seed;
    options.threads = thread_count(*world.workers);
    options.hour = world.crowd.demand.hour;
    options.pass_on = world.crowd.pass_on;
    options.habit = world.habit;
    options.platform = world.platform;
    options.drunk = world.drunk;
    options.drunks = std::min(world.drunks, walkers);
    options.pushes = world.pushes;
    options.throws = world.balls.planned;
    options.helpers = world.bystanders.helpers;
    if (minds_lamps(world.crowd.kerbs)) options.crossings = world.crowd.kerbs.map->crossings;
    options.jaywalkers = world.jaywalkers;
    options.groups = world.company.shares;
    options.acquaintances = world.company.acquaintances;
    if (world.alongside) options.along = world.alongside->shares;
    options.pastimes = world.pastimes->shares;
    options.pastime_places = world.pastimes->places;
    if (world.roads) {
        options.lanes = world.roads->lanes;
        if (options.crossings.all.empty()) options.crossings = world.roads->crossings;
    }
    options.traffic = world.vehicles.traffic;
    options.limbs = is_on(world.crowd.march) ? LimbLead::curves : LimbLead::gait;
    options.curves = world.crowd.march.how;
    options.navmesh = settings_of(*world.navmesh);
    options.leaving = world.crowd.demand.leaving;
    options.sendings = world.coming.sendings;
    if (!options.sendings.empty()) options.capacity = world.crowd.capacity;
    order.ground = world.ground;
    order.mesh = navmesh_bytes(*world.navmesh);
    if (world.roam) {
        order.compound = world.roam->compound;
        order.gravity = world.roam->gravity;
        order.creatures = static_cast<uint32_t>(world.roam->creatures.size());
    }
    if (is_on_course(world)) order.course = course_of(world);
    if (world.stepping && !is_on_course(world)) {
        order.steppers_ways = world.stepping->ways;
        order.steppers = std::min(static_cast<uint32_t>(world.stepping->bipeds.all.size()), walkers);
    }
    if (!world.herd.creatures.empty()) order.creatures = static_cast<uint32_t>(world.herd.creatures.size());
    order.linkages = world.linkages.all;
    order.figures = world.figures.plans;
    order.traces = world.traced.traces;
    if (order.traces) options.capacity = order.traces->most, options.walkers = 0;
    order.movers = world.movers.all;
    order.doers = world.deeds.plans;
    order.things = world.deeds.things;
    order.deed_ground = world.deeds.ground;
    order.first_deed_mover = world.deeds.first_mover;
    order.figure_ground = world.figures.ground;
    return order;
}

Result<std::unique_ptr<World>> make_people(const PeopleOrder& order,
                                           const std::function<bool(std::string_view, float)>& progress) {
    Result<NavmeshPtr> mesh =
        restore_navmesh(*order.ground, order.options.navmesh, order.mesh, order.options.threads);
    if (!mesh) return mesh.error();
    auto made = make_world(order.ground, std::move(*mesh), order.options, progress);
    if (made && order.compound) {
        Result<void> set = set_down(**made, *order.compound, order.creatures, order.gravity);
        if (!set) return set.error();
    }
    if (made && order.traces) follow_traces(**made, order.traces);
    if (made && order.course) {
        if (Result<void> set = set_on_course(**made, *order.course); !set) return set.error();
    }
    if (made && !order.compound && !order.course) {
        (*made)->linkages = make_linkages(order.linkages);
        (*made)->movers = make_movers(order.movers);
        set_figures(order.figures, order.figure_ground, **made);
        if (order.steppers > 0)
            if (Result<void> set = let_step(**made, order.steppers, order.steppers_ways); !set)
                return set.error();
        if (order.creatures > 0)
            if (Result<void> set = set_loose(**made, order.creatures); !set) return set.error();
        set_deeds(order.doers, order.things, order.deed_ground, order.first_deed_mover, **made);
    }
    return made;
}

}  // namespace flaneur
