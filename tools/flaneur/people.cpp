#include <cstdio>
#include <string>

#include "assets/gltf_write.h"
#include "assets/outfit.h"
#include "assets/population.h"
#include "tools/flaneur/commands.h"
#include "tools/flaneur/load.h"
#include "tools/flaneur/output.h"
#include "tools/flaneur/people_sheet.h"

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
    std::string years = std::to_string(static_cast<int>(sitter.character.person.age));
    return sitter.character.name + ", " + years + ", " + metres(sitter.character.body.height);
}

// The built-in people that the options ask for, dressed; or the characters that they name, as these are.
Result<std::vector<Sitter>> gather(const Options& options) {
    std::vector<Sitter> sitters;
    if (!options.scene.characters.empty()) {
        Result<std::vector<Character>> characters = load_characters(options.scene.characters);
        if (!characters) return characters.error();
        for (Character& character : *characters) {
            Sitter& sitter = sitters.emplace_back();
            sitter.character = std::move(character);
            sitter.tints = outfit(sitter.character.person, options.scene.seed, 0);
            sitter.caption = sitter.character.name + ", " + metres(sitter.character.body.height);
        }
        return sitters;
    }
    std::vector<PersonOptions> people = draw_population(options.people.count, options.scene.seed);
    std::vector<Character> characters = make_people(people, options.threads);
    for (size_t i = 0; i < people.size(); ++i) {
        Sitter& sitter = sitters.emplace_back();
        sitter.character = std::move(characters[i]);
        sitter.tints = outfit(people[i], options.scene.seed, static_cast<uint32_t>(i));
        sitter.caption = numbered(i, people.size()) + " " + described(sitter);
    }
    return sitters;
}

void print_table(const std::vector<Sitter>& sitters) {
    for (const Sitter& sitter : sitters) {
        std::printf("%-40s", sitter.caption.c_str());
        for (const auto& level : sitter.character.lods) std::printf(" %6zu", level.size() / 3);
        std::printf(" triangles\n");
    }
}

Result<void> write_files(const std::vector<Sitter>& sitters, const std::string& folder) {
    for (size_t i = 0; i < sitters.size(); ++i) {
        std::string name = "person_" + numbered(i, sitters.size()) + ".glb";
        Result<PartFilePtr> file = open_file(folder + "/" + name);
        if (!file) return file.error();
        std::string bytes = character_glb(sitters[i].character, sitters[i].tints);
        std::fwrite(bytes.data(), 1, bytes.size(), (*file)->file);
        if (Result<void> kept = keep_file(std::move(*file)); !kept) return kept;
    }
    return {};
}

}  // namespace

Result<void> run_people(const Options& options) {
    const PeopleOptions& people = options.people;
    const std::vector<std::string>& characters = options.scene.characters;
    if (!people.folder.empty() && !characters.empty())
        return Error{"people --out writes the built-in people; leave out --character, or --out."};
#ifdef FLANEUR_VULKAN
    PartFilePtr sheet;
    if (!people.sheet.empty()) {
        Result<PartFilePtr> file = open_sheet(people, characters.empty() ? people.count : characters.size());
        if (!file) return file.error();
        sheet = std::move(*file);
    }
#endif
    Result<std::vector<Sitter>> sitters = gather(options);
    clear_progress();
    if (!sitters) return sitters.error();
    if (!people.folder.empty()) {
        if (Result<void> written = write_files(*sitters, people.folder); !written) return written;
    }
#ifdef FLANEUR_VULKAN
    if (sheet) {
        if (Result<void> drawn = draw_sheet(std::move(sheet), *sitters, options); !drawn) return drawn;
    }
#endif
    print_table(*sitters);
    return {};
}

}  // namespace flaneur
