#include "tools/flaneur/load.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

#include "assets/asteroid.h"
#include "assets/city.h"
#include "assets/gltf_clip.h"
#include "assets/navmesh_cache.h"
#include "assets/person_cache.h"
#include "assets/population.h"

namespace flaneur {

namespace {

constexpr uint32_t k_built_in_people = 24;

constexpr int k_most_blocks = 32;

bool is_terminal() {
    static const bool terminal = isatty(STDERR_FILENO) != 0;
    return terminal;
}

void print_notes(const std::string& source, const std::vector<std::string>& notes) {
    clear_progress();
    for (const std::string& note : notes) std::fprintf(stderr, "%s: %s\n", source.c_str(), note.c_str());
}

// Fills both: a kind for each character. The built-in people share what they have evenly.
Result<void> add_people(const Options& options, std::vector<Character>& characters,
                        std::vector<Kind>& kinds) {
    const Scene& scene = options.scene;
    kinds.clear();
    std::vector<PeopleShare> people = scene.people;
    if (people.empty()) people.emplace_back();
    for (const PeopleShare& some : people) {
        std::vector<Character> added;
        if (some.character.empty()) {
            added = make_people(draw_population(k_built_in_people, scene.seed), options.threads);
        } else {
            Result<Character> character = read_character(some.character);
            if (!character) return character.error();
            added.push_back(std::move(*character));
        }
        for (Character& c : added) {
            kinds.push_back(
                {c.body, some.share / static_cast<float>(added.size()), c.person.age, c.person.woman});
            characters.push_back(std::move(c));
        }
    }
    return {};
}

// Where what is dear to make is kept between runs, after the XDG base directory specification; empty:
// nowhere.
std::string cache_folder() {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache && *cache == '/') return std::string(cache) + "/flaneur";
    const char* home = std::getenv("HOME");
    return home && *home ? std::string(home) + "/.cache/flaneur" : "";
}

// FILE or FILE:CLIP; the name of an animation may have colons in it.
Result<std::vector<Clip>> load_idles(const Scene& scene) {
    std::vector<Clip> clips;
    for (const std::string& idle : scene.idles) {
        show_progress("reading " + idle);
        size_t colon = idle.find(':');
        std::string name = colon == std::string::npos ? "" : idle.substr(colon + 1);
        Result<Motion> motion = load_motion(idle.substr(0, colon), name);
        if (!motion) return motion.error();
        Result<Clip> clip = additive_clip(*motion);
        if (!clip) return Error{idle + ": " + clip.error().message};
        clips.push_back(std::move(*clip));
    }
    return clips;
}

// A district as large as the scene says, or as its walkers need to walk rather than queue: some 750 to a
// block.
int district_blocks(const Scene& scene) {
    int blocks = scene.blocks;
    while (blocks < k_most_blocks && blocks * blocks * 750 < scene.walkers) ++blocks;
    return blocks;
}

}  // namespace

Result<NavmeshPtr> load_navmesh(const City& city, int threads) {
    auto mesh = cached_navmesh(city, {}, threads, cache_folder(), [](float share) {
        show_progress("building the navigation mesh " + std::to_string(static_cast<int>(share * 100)) + " %");
    });
    clear_progress();
    return mesh;
}

void show_progress(const std::string& line) {
    if (is_terminal()) std::fprintf(stderr, "\r\033[K%s", line.c_str());
}

void clear_progress() { show_progress(""); }

Result<City> read_city(const Scene& scene) {
    show_progress("making the city");
    if (scene.asteroid) return make_asteroid(scene.seed, scene.walkers).stage;
    Result<City> city = scene.city.empty() ? generate_district({scene.seed, district_blocks(scene)})
                                           : load_city(scene.city, {scene.terrain, scene.scale});
    if (city) print_notes(city->name, city->notes);
    return city;
}

Result<Character> read_character(const std::string& path) {
    show_progress("reading " + path);
    Result<Character> character = load_character(path);
    if (character) print_notes(path, character->notes);
    return character;
}

std::vector<Character> make_people(const std::vector<PersonOptions>& options, int threads) {
    show_progress("making people");
    std::vector<Character> people(options.size());
    std::string folder = cache_folder();
    WorkersPtr workers = make_workers(threads);
    parallel_for(*workers, people.size(), 1, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) people[i] = cached_person(options[i], folder);
    });
    return people;
}

Result<Loaded> load(const Options& options) {
    const Scene& scene = options.scene;
    Loaded loaded;
    Result<City> city = read_city(scene);
    if (!city) return city.error();

    WorldOptions world;
    Result<void> peopled = add_people(options, loaded.characters, world.kinds);
    if (!peopled) return peopled.error();

    Result<std::vector<Clip>> idles = load_idles(scene);
    if (!idles) return idles.error();

    world.idles = std::move(*idles);
    world.walkers = static_cast<uint32_t>(scene.walkers);
    world.seed = scene.seed;
    world.threads = options.threads;
    world.hour = scene.hour;
    auto progress = [](std::string_view what, float done) {
        show_progress(std::string(what) + " " + std::to_string(static_cast<int>(done * 100)) + " %");
    };
    Result<NavmeshPtr> mesh = load_navmesh(*city, options.threads);
    if (!mesh) return mesh.error();
    auto made = make_world(std::move(*city), std::move(*mesh), world, progress);
    clear_progress();
    if (!made) return made.error();
    loaded.world = std::move(*made);
    if (scene.asteroid) {
        Result<void> set = set_down(*loaded.world, make_asteroid(scene.seed, scene.walkers).compound);
        if (!set) return set.error();
    }
    return loaded;
}

}  // namespace flaneur
