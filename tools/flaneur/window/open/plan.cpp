#include "tools/flaneur/window/open/plan.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "assets/character.h"
#include "assets/files/file.h"
#include "tools/flaneur/options/shell_words.h"

namespace flaneur {
namespace {

using Names = std::vector<std::string_view>;

// What is said of a place, of people there, and of how a window begins.
const Names k_place = {"--scene", "--city", "--center", "--radius", "--terrain", "--scale", "--camera"};
const Names k_people = {"--character", "--idle", "--walkers", "--time",
                        "--weather",   "--side", "--seed",    "--view"};
constexpr std::array<std::string_view, 1> k_beginning = {"--start"};
constexpr std::array<std::string_view, 5> k_once = {"--frames", "--replay", "--record", "--record-as",
                                                    "--record-error"};

bool ends_in(const std::string& path, std::initializer_list<std::string_view> endings) {
    for (const std::string_view ending : endings)
        if (has_ending(path, ending)) return true;
    return false;
}

std::vector<std::string> without(const std::vector<std::string>& words, const Names& options) {
    return without_options(without_options(words, k_once, k_beginning), options);
}

void add(std::vector<std::string>& words, const char* option, std::string value) {
    words.emplace_back(option);
    words.push_back(std::move(value));
}

ShowWish wish_of(std::vector<std::string> words, std::string told = {}) {
    ShowWish wish;
    wish.words = std::move(words);
    wish.told = std::move(told);
    return wish;
}

Result<ShowWish> parsed(ShowWish wish) {
    std::vector<std::string> all = {"flaneur", "view"};
    all.insert(all.end(), wish.words.begin(), wish.words.end());
    std::vector<char*> pointers;
    pointers.reserve(all.size() + 1);
    for (std::string& word : all) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    auto options = parse_options(static_cast<int>(all.size()), pointers.data());
    if (!options) return options.error();
    if (!std::holds_alternative<Options>(*options)) return Error{"There is nothing to show."};
    wish.options = std::move(std::get<Options>(*options));
    return wish;
}

// Whether an OpenStreetMap city is shown.
bool has_map(const std::vector<std::string>& words) {
    const Result<ShowWish> now = parsed(wish_of(without(words, {"--terrain"})));
    return now && kind_of(now->options.scene.city) == FileKind::map;
}

// As `told` says who is how many of all.
std::string told_share(const ShowWish& wish, const std::string& name) {
    const size_t kinds = wish.options.scene.people.size();
    return name + " walks now: " + (kinds == 2 ? "half" : "one in " + std::to_string(kinds)) +
           " of the people, whose others stay.";
}

}  // namespace

Result<ShowWish> wish_for_file(const std::vector<std::string>& words, const std::string& path) {
    if (Result<void> found = find_file(path); !found) return found.error();
    const std::string name = std::filesystem::path(path).filename().string();
    ShowWish wish = wish_of(words);
    wish.file = path;
    const FileKind kind = kind_of(path);
    if (has_ending(path, ".json")) {
        wish.words = without(without(words, k_place), k_people);
        add(wish.words, "--scene", path);
    } else if (kind == FileKind::map ||
               (kind == FileKind::gltf && !has_ending(path, ".vrm") && !has_skin(path))) {
        wish.words = without(words, k_place);
        add(wish.words, "--city", path);
    } else if (kind == FileKind::gltf) {
        if (std::find(words.begin(), words.end(), path + ":1") != words.end())
            return Error{name + " walks here already."};
        wish.words = without(words, {"--camera"});
        if (!has_option(words, "--character")) add(wish.words, "--character", "builtin");
        add(wish.words, "--character", path + ":1");
    } else if (ends_in(path, {".hgt", ".hgt.zip", ".tif", ".tiff"})) {
        if (!has_map(words))
            return Error{name +
                         " is heights under a map, and no map is shown: open an .osm or .osm.pbf first."};
        wish.words = without(words, {"--terrain", "--camera"});
        add(wish.words, "--terrain", path);
    } else {
        return Error{
            name +
            " cannot be opened here: a map is an .osm or .osm.pbf, a city or a character a .glb, .gltf or "
            ".vrm, a scene a .json, and heights under a map are a .hgt or .tif."};
    }
    Result<ShowWish> done = parsed(std::move(wish));
    if (!done) return Error{name + " cannot be opened: " + done.error().message};
    const bool is_person = kind == FileKind::gltf && done->options.scene.city != path;
    done->told = is_person ? told_share(*done, name) : name + " is open.";
    return done;
}

Result<ShowWish> wish_for_scene(const std::vector<std::string>& words, const std::string& name) {
    ShowWish wish = wish_of(without(without(words, k_place), k_people), "The scene " + name + " is open.");
    add(wish.words, "--scene", name);
    return parsed(std::move(wish));
}

Result<ShowWish> wish_for_course(const std::vector<std::string>& words, bool is_flat, int walkers,
                                 uint64_t seed) {
    ShowWish wish = wish_of(without(words, {"--scene", "--camera", "--walkers", "--seed"}),
                            is_flat ? "The course is in one line." : "The course goes round.");
    add(wish.words, "--scene", is_flat ? "stepper-flat" : "stepper");
    add(wish.words, "--walkers", std::to_string(std::min(walkers, k_course_walkers)));
    add(wish.words, "--seed", std::to_string(seed));
    return parsed(std::move(wish));
}

}  // namespace flaneur
