#include "tools/flaneur/options/options.h"

#include <iostream>

#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/like.h"
#include "tools/flaneur/options/refusal.h"
#include "tools/flaneur/options/unused.h"

namespace flaneur {

namespace {

constexpr const char* k_footer = R"(Examples:
  flaneur view                                             walk about in the built-in city
  flaneur render --out out/city.png                        a picture of it
  flaneur render --city berlin.osm --walkers 2000 --frames 600:1200 --out out/berlin.mp4
  flaneur sim --seconds 60 --hash                          the same number on every x86-64 machine
  flaneur check --sim --with OTHER_FLANEUR                 the first tick, walker and field in which two builds differ
  flaneur sim --seconds 60 --record out/a.flr              a minute, to be shown by flaneur replay out/a.flr
  flaneur export out/a.flr out/a.glb --walkers 10:20       some of those people for Blender, with how they moved
  flaneur validate                                         the tests of RiMEA and NIST, expected beside measured
  flaneur measure corridor.txt --out out/corridor          density, speed, flow and more of any trajectories
  flaneur bench frame --walkers 2000                       where the time of a frame goes
  flaneur people --count 24 --sheet out/people.png         who lives there
  flaneur inspect me.glb                                   what is found in a character
  flaneur city --city berlin.osm --out out/berlin.glb      a city, to open elsewhere
  flaneur cache --clear                                    remove what is kept between runs
`flaneur render --help` and so on tell more.)";

// Several files do not go to one stream.
Result<void> check_folders(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        if (option->get_type_name().starts_with("FOLDER") &&
            option->results() == std::vector<std::string>{"-"})
            return Error{option->get_name() +
                         " - is no folder: several files do not go to standard output. Give the name of a "
                         "folder, ./- if that is what it is called."};
    return {};
}

Result<std::variant<std::monostate, Options>> parse_words(int argc, char** argv) {
    using Parsed = std::variant<std::monostate, Options>;
    Options options;
    SceneWords words;
    CLI::App app("flaneur fills a city with people and lets you watch, check and profile them.", "flaneur");
    app.footer(k_footer);
    app.set_version_flag("--version", "flaneur " FLANEUR_VERSION);
    app.require_subcommand(1);
    app.option_defaults()->take_last();
    app.get_formatter()->column_width(32);
    add_view(app, words, options);
    add_render(app, words, options);
    add_sim(app, words, options);
    add_check(app, words, options);
    add_validate(app, options);
    add_measure(app, options);
    add_replay(app, words, options);
    add_export(app, words, options);
    add_diff(app, options);
    add_join(app, options);
    add_bench(app, words, options);
    add_gait(app, words, options);
    add_people(app, words, options);
    add_inspect(app, words, options);
    add_city(app, words, options);
    add_scenes(app, options);
    add_cache(app, options);

    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) {
        app.exit(asked, std::cout, std::cerr);
        return Parsed();
    } catch (const CLI::ParseError& error) {
        return refusal(app, error, argc, argv);
    }
    const CLI::App& command = *app.get_subcommands().front();
    for (int i = 2; i < argc; ++i) options.words.emplace_back(argv[i]);
    if (options.starts && command.count("--scene") + command.count("--city") == 0) {
        words.scene = "corner";  // quick to load, behind what one chooses from
        options.words.insert(options.words.end(), {"--scene", words.scene});
    }
    if (Result<void> filled = check_values(command); !filled) return filled.error();
    if (Result<void> named = check_folders(command); !named) return named.error();
    Result<void> settled = settle_scene(words, options);
    if (!settled) return settled.error();
    if (Result<void> used = check_used(command, options); !used) return used.error();
    if (Result<void> compared = settle_check(command, options); !compared) return compared.error();
    if (Result<void> measured = settle_measures(options); !measured) return measured.error();
    return Parsed(std::move(options));
}

}  // namespace

Result<std::variant<std::monostate, Options>> parse_options(int argc, char** argv) {
    if (argc < 2 || std::string_view(argv[1]) != "render") return parse_words(argc, argv);
    const std::vector<std::string> said(argv + 2, argv + argc);
    Result<std::vector<std::string>> words = words_like(said);
    if (!words) return words.error();
    std::vector<char*> all = {argv[0], argv[1]};
    for (std::string& word : *words) all.push_back(word.data());
    all.push_back(nullptr);
    auto parsed = parse_words(static_cast<int>(all.size()) - 1, all.data());
    Options* const options = parsed ? std::get_if<Options>(&*parsed) : nullptr;
    if (options) options->inputs.push_back(options->like = picture_of_like(said));
    return parsed;
}

}  // namespace flaneur
