#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "assets/gltf/write.h"
#include "assets/outfit.h"
#include "assets/population.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/console/console.h"
#include "tools/flaneur/console/ending.h"
#include "tools/flaneur/load/load.h"
#include "tools/flaneur/output/output.h"
#include "tools/flaneur/sheets/people_sheet.h"

namespace flaneur {

namespace {

std::string numbered(size_t i, size_t count) {
    std::string number = std::to_string(i + 1);
    size_t digits = std::max<size_t>(std::to_string(count).size(), 2);
    return std::string(digits - std::min(digits, number.size()), '0') + number;
}

std::string metres(float height) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2f m", static_cast<double>(height));
    return text;
}

std::string described(const Sitter& sitter) {
    const PersonOptions& person = sitter.character.person;
    std::string who = person.age < 16 ? (person.woman ? "girl" : "boy") : (person.woman ? "woman" : "man");
    std::string years = std::to_string(static_cast<int>(person.age));
    return who + ", " + years + ", " + metres(sitter.character.body.height);
}

// Those asked for; without a word about it, the built-in people.
std::vector<PeopleShare> wanted_people(const Options& options) {
    std::vector<PeopleShare> wanted = options.scene.people;
    if (wanted.empty()) wanted.emplace_back();
    return wanted;
}

Result<void> add_built_in(const Options& options, std::vector<Sitter>& sitters) {
    uint32_t count = options.people.count;
    auto people = make_people(draw_population(count, options.scene.seed), options.threads);
    if (!people) return people.error();
    for (uint32_t i = 0; i < count; ++i) {
        Sitter& sitter = sitters.emplace_back();
        sitter.character = std::move((*people)[i]);
        sitter.tints = outfit(sitter.character.person, options.scene.seed, i);
        sitter.caption = numbered(i, count) + " " + described(sitter);
    }
    return {};
}

Result<void> add_character(const std::string& path, bool force, std::vector<Sitter>& sitters) {
    Result<Character> character = read_character(path, force);
    if (!character) return character.error();
    Sitter& sitter = sitters.emplace_back();
    sitter.character = std::move(*character);
    sitter.tints.fill(0xffffffffu);  // none of which it has
    sitter.caption = sitter.character.name + ", " + metres(sitter.character.body.height);
    return {};
}

void print_table(const std::vector<Sitter>& sitters) {
    for (const Sitter& sitter : sitters) {
        std::printf("%-40s", printable(sitter.caption).c_str());
        for (const auto& level : sitter.character.lods) std::printf(" %6zu", level.size() / 3);
        std::printf(" triangles\n");
    }
}

Result<PartFilePtr> open_person(const std::string& folder, size_t i, size_t count) {
    std::string name = "person_" + numbered(i, count) + ".glb";
    return open_file((std::filesystem::path(folder) / name).string());
}

// `first` was opened early, to see that the folder can be written to.
Result<void> write_files(PartFilePtr first, const std::vector<Sitter>& sitters, const std::string& folder) {
    for (size_t i = 0; i < sitters.size(); ++i) {
        if (is_stopping())
            return interrupted(folder + " has " + std::to_string(i) + " of " +
                               std::to_string(sitters.size()) + " people");
        Result<PartFilePtr> file = i == 0 ? std::move(first) : open_person(folder, i, sitters.size());
        if (!file) return file.error();
        const std::string bytes = character_glb(sitters[i].character, sitters[i].tints);
        if (Result<void> kept = write_file(std::move(*file), bytes); !kept) return kept;
    }
    return {};
}

}  // namespace

Result<void> run_people(const Options& options) {
    const PeopleOptions& people = options.people;
    std::vector<PeopleShare> wanted = wanted_people(options);
    size_t count = 0, files = 0;
    for (const PeopleShare& some : wanted) {
        files += !some.character.empty();
        count += some.character.empty() ? people.count : 1;
    }
    if (!people.folder.empty() && files > 0)
        return Error{"people --out writes the built-in people; leave out --character, or --out."};
    PartFilePtr first;
    if (!people.folder.empty()) {
        Result<PartFilePtr> file = open_person(people.folder, 0, count);
        if (!file) return file.error();
        first = std::move(*file);
    }
#ifdef FLANEUR_VULKAN
    PartFilePtr sheet;
    if (!people.sheet.empty()) {
        Result<PartFilePtr> file = open_sheet(people, count);
        if (!file) return file.error();
        sheet = std::move(*file);
    }
#endif
    std::vector<Sitter> sitters;
    sitters.reserve(count);
    for (const PeopleShare& some : wanted) {
        Result<void> added = some.character.empty() ? add_built_in(options, sitters)
                                                    : add_character(some.character, options.force, sitters);
        if (!added) return added;
    }
    clear_progress();
    if (!people.folder.empty()) {
        if (Result<void> written = write_files(std::move(first), sitters, people.folder); !written)
            return written;
    }
#ifdef FLANEUR_VULKAN
    if (sheet) {
        bool one_scale = files == 0;
        Result<void> drawn = draw_sheet(std::move(sheet), sitters, one_scale, options);
        if (!drawn) return drawn;
    }
#endif
    print_table(sitters);
    return {};
}

}  // namespace flaneur
