#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/wkt.h"
#include "tools/flaneur/options/commands.h"
#include "tools/flaneur/options/refusal.h"
#include "tools/flaneur/options/spelling.h"

namespace flaneur {
namespace {

constexpr const char* k_measure_footer =
    R"(Runs without Vulkan. FILE: trajectories, measured or simulated, as docs/trajectories.md says which: of PeTrack and jpscore
(.txt), JuPedSim (.sqlite), the Juelich archive (.h5), ours (.csv). Places are those of the file: x to the east, y to the
north, metres; where it has no walkable area and --walkable gives none, the box about everybody is taken for it.
What is measured, all of it where none of these is asked for; docs/measures.md has the formulas and whose they are:
  --voronoi       density (counted, and by Voronoi cells) and speed in --area, frame by frame
  --fundamental   speed and flow over density
  --service       how long which of Fruin's levels of service
  --profile 0.2   maps of density, speed and flow
  --ttc           time to collision
  --dwell         who is in --area how long
  --individual    each person in each frame: speed, acceleration, cell, neighbours, time to collision
  --line          who crosses it when: N-t curve, flow; with --passing the speed and density of who walks through beside it
--out FOLDER gets a .csv of each, a .json and charts; --out FILE.csv FILE-area.csv and so on; FILE.json, FILE.svg that alone.
Examples:
  flaneur measure corridor.txt                                  a table on the terminal
  flaneur measure corridor.txt --out out/corridor               everything
  flaneur measure neck.txt --line '-0.4,0 0.4,0' --passing 1 --area '-0.5,0.5 0.5,1.5' --out out/neck
  flaneur measure neck.txt --walkable 'POLYGON ((-3 -2, 3 -2, 3 8, -3 8, -3 -2))' --voronoi --cutoff 0.8
  flaneur sim --seconds 120 --trajectories out/square.sqlite && flaneur measure out/square.sqlite --out out/square.svg)";

// "x,y x,y ..", y to the north.
bool read_places(std::string_view text, std::vector<Vec2>& to) {
    for (const std::string_view part : split(text, ' ')) {
        if (part.empty()) continue;
        const std::vector<std::string_view> numbers = split(part, ',');
        float x = 0, y = 0;
        if (numbers.size() != 2 || !parse_number(numbers[0], x) || !parse_number(numbers[1], y)) return false;
        if (!(std::fabs(x) <= 1e5f && std::fabs(y) <= 1e5f)) return false;
        to.push_back({x, 0 - y});
    }
    return !to.empty();
}

Result<Moments> parse_frames(const std::string& text) {
    Result<Moments> part = parse_part(text);
    if (part && part->first == std::floor(part->first) && part->last == std::floor(part->last)) return part;
    return Error{excerpt(text) + " is not FROM:TO, two whole numbers such as 250:1000"};
}

Result<Vec2> parse_direction(const std::string& text) {
    std::vector<Vec2> places;
    if (read_places(text, places) && places.size() == 1 && length(places[0]) > 1e-6f) return places[0];
    return Error{excerpt(text) + " is no direction, as 'x,y': 1,0 is east"};
}

// One of some words.
template <class T>
Result<T> parse_word(const std::string& text, std::initializer_list<std::pair<const char*, T>> words) {
    std::vector<std::string> known;
    for (const auto& [word, value] : words) {
        if (text == word) return value;
        known.emplace_back(word);
    }
    return Error{excerpt(text) + " is none of " + joined(known) + "." + did_you_mean(text, known)};
}
Result<AtEnds> parse_borders(const std::string& text) {
    return parse_word<AtEnds>(text, {{"exclude", AtEnds::exclude},
                                     {"adaptive", AtEnds::adaptive},
                                     {"single_sided", AtEnds::single_sided}});
}
Result<FieldMethod> parse_method(const std::string& text) {
    return parse_word<FieldMethod>(text, {{"classic", FieldMethod::classic},
                                          {"voronoi", FieldMethod::voronoi},
                                          {"gaussian", FieldMethod::gaussian}});
}
Result<ServiceOf> parse_service(const std::string& text) {
    return parse_word<ServiceOf>(
        text, {{"walkway", ServiceOf::walkway}, {"stairs", ServiceOf::stairs}, {"queue", ServiceOf::queue}});
}

bool is_name(std::string_view text) {
    return !text.empty() && text.size() <= 40 && std::all_of(text.begin(), text.end(), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
    });
}

}  // namespace

Result<Moments> parse_part(const std::string& text) {
    const std::vector<std::string_view> ends = split(text, ':');
    Moments part;
    if (ends.size() == 2 && parse_number(ends[0], part.first) && parse_number(ends[1], part.last) &&
        part.first >= 0 && part.last >= part.first && part.last <= 1e9)
        return part;
    return Error{excerpt(text) + " is not FROM:TO, such as 10:40"};
}

Result<std::vector<WalkablePolygon>> parse_area(const std::string& text) {
    std::vector<WalkablePolygon> area;
    std::vector<Vec2> places;
    if (read_places(text, places)) {
        if (places.size() == 2)
            places = {places[0], {places[1].x, places[0].z}, places[1], {places[0].x, places[1].z}};
        area = {{std::move(places), {}}};
    } else {
        Result<std::vector<WalkablePolygon>> read = parse_wkt(text);
        if (!read)
            return Error{excerpt(text) +
                         " is neither two opposite corners, as 'x,y x,y', nor more corners, nor " +
                         "POLYGON ((x y, ..), ..)"};
        area = std::move(*read);
    }
    for (const WalkablePolygon& polygon : area) {
        if (area_of(polygon.outer) < wide(k_least_zone))
            return Error{excerpt(text) + " is an area of less than 0.05 square metres"};
        if (!is_simple(polygon.outer))
            return Error{excerpt(text) + " has edges that cross or touch each other"};
    }
    return area;
}

Result<CountLine> parse_line(const std::string& text) {
    std::string_view rest = text;
    CountLine line;
    if (const size_t colon = rest.find(':'); colon != rest.npos && is_name(rest.substr(0, colon))) {
        line.name = rest.substr(0, colon);
        rest.remove_prefix(colon + 1);
    }
    std::string places(rest);
    constexpr std::string_view k_linestring = "LINESTRING";
    if (rest.starts_with(k_linestring)) {  // (x y, x y)
        places.erase(0, k_linestring.size());
        std::erase_if(places, [](char c) { return c == '(' || c == ')'; });
        std::string turned;
        for (const std::string_view part : split(places, ',')) {
            std::string place;
            for (const std::string_view number : split(part, ' '))
                if (!number.empty()) place.append(place.empty() ? "" : ",").append(number);
            turned.append(place).append(" ");
        }
        places = turned;
    }
    std::vector<Vec2> ends;
    if (!read_places(places, ends) || ends.size() != 2)
        return Error{excerpt(text) + " is no line: two ends, as 'x,y x,y' or NAME:'x,y x,y'"};
    line.a = ends[0], line.b = ends[1];
    if (length_of(line) < k_least_line) return Error{excerpt(text) + " is a line shorter than 5 cm"};
    return line;
}

void add_measure(CLI::App& app, Options& options) {
    MeasureOptions& measure = options.measure;
    CLI::App* command = app.add_subcommand("measure", "Measure trajectories: density, speed, flow and more")
                            ->footer(k_measure_footer);
    command->callback([&] { options.command = Command::measure; });
    command->add_option("file", options.file, "Trajectories: .txt, .sqlite, .h5 or .csv")
        ->type_name("FILE")
        ->required();
    command
        ->add_option_function<std::vector<std::string>>(
            "--line",
            [&measure](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) {
                    Result<CountLine> line = parse_line(text);
                    if (!line)
                        throw CLI::ValidationError("--line " + line.error().message,
                                                   CLI::ExitCodes::ValidationError);
                    measure.lines.push_back(std::move(*line));
                }
            },
            "Measure who crosses it, by its ends; may be given several times")
        ->type_name("[NAME:]'X,Y X,Y'")
        ->allow_extra_args(false)
        ->take_all();
    add_parsed(*command, "--area", parse_area, measure.area,
               "Measure in it: two corners, more corners, or well-known text", "'X,Y X,Y ..'",
               "the walkable area");
    add_parsed(*command, "--walkable", parse_area, measure.walkable,
               "Where people can be, which cuts cells, instead of what the file says", "'X,Y X,Y ..'",
               "that of the file");
    add_parsed(*command, "--seconds", parse_part, measure.seconds, "Only this part of the time", "FROM:TO",
               "all");
    add_parsed(*command, "--frames", parse_frames, measure.frames, "Only these frames, both ends among them",
               "FROM:TO", "all");
    command->add_flag("--voronoi", measure.voronoi, "Density and speed in the area, frame by frame");
    command->add_flag("--fundamental", measure.fundamental, "Speed and flow over density");
    command->add_flag("--service", measure.service, "How long which level of service");
    command->add_option("--profile", measure.profile, "Maps of squares this long, metres")
        ->type_name("SIDE")
        ->check(number_between(0.02, 100.0));
    command->add_flag("--ttc", measure.ttc, "Time to collision");
    command->add_flag("--dwell", measure.dwell, "Who is in the area how long");
    command->add_flag("--individual", measure.individual, "Each person in each frame");
    command
        ->add_option("--passing", measure.passing,
                     "Also measure who walks through an area this wide to the left of each line")
        ->type_name("WIDTH")
        ->needs(command->get_option("--line"))
        ->check(number_between(0.05, 1000.0));
    command->add_option("--flow-seconds", measure.flow_seconds, "Over which a flow through a line is told")
        ->type_name("T")
        ->check(number_between(0.1, 1e6))
        ->capture_default_str();
    command
        ->add_option("--cutoff", measure.cut_off, "How far a Voronoi cell reaches, metres; 0: to the walls")
        ->type_name("RADIUS")
        ->check(number_between(0, 1000.0))
        ->capture_default_str();
    command
        ->add_option("--frame-step", measure.frame_step,
                     "Speeds are those from so many frames before to as many after")
        ->type_name("N")
        ->transform(whole_between(1, 100000))
        ->default_str("a fifth of a second");
    add_parsed(*command, "--borders", parse_borders, measure.at_ends,
               "What is taken for speed where that is cut short: exclude, adaptive, single_sided", "WORD",
               "single_sided");
    add_parsed(*command, "--direction", parse_direction, measure.direction,
               "Take speeds along it, below 0 for who goes the other way", "X,Y", "whichever way one goes");
    add_parsed(*command, "--profile-method", parse_method, measure.profile_method,
               "How maps are made: classic, voronoi, gaussian", "WORD", "voronoi");
    command->add_option("--radius", measure.radius, "Of people, for time to collision, metres")
        ->type_name("R")
        ->check(number_between(0.01, 5.0))
        ->capture_default_str();
    add_parsed(*command, "--service-of", parse_service, measure.service_of,
               "Whose levels of service: walkway, stairs, queue", "WORD", "walkway");
    add_threads_option(*command, options, "Threads that measure; 0: one a core");
    command->add_option("--out", options.out, "Write a .csv, a .json, an .svg, or all of them into a folder")
        ->type_name("FILE");
    add_reading_options(*command, options.reading);
}

}  // namespace flaneur
