// inD, uniD, rounD and their kin: beside NN_tracks.csv lie NN_recordingMeta.csv, which has the rate of
// frames, and NN_tracksMeta.csv, which has classes.
#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/formats.h"

namespace flaneur {
namespace {

constexpr size_t k_most_meta_bytes = size_t{64} << 20;

std::string_view without_return(std::string_view line) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

size_t column_called(const std::vector<std::string_view>& names, std::string_view name) {
    size_t i = 0;
    while (i < names.size() && names[i] != name) ++i;
    return i;
}

}  // namespace

Result<void> add_recording_meta(FoundTracks& found, const std::string& path) {
    constexpr std::string_view k_ending = "_tracks.csv";
    const std::string stem =
        has_ending(path, k_ending) ? path.substr(0, path.size() - k_ending.size()) : path;
    auto rows_of = [](const Bytes& bytes) {
        return split({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, '\n');
    };
    if (const Result<Bytes> meta = read_bytes(stem + "_recordingMeta.csv", k_most_meta_bytes)) {
        const auto rows = rows_of(*meta);
        const auto names = split(without_return(rows[0]), ',');
        const auto values = split(rows.size() > 1 ? without_return(rows[1]) : "", ',');
        const size_t rate = column_called(names, "frameRate");
        if (rate < values.size() && parse_number(values[rate], found.fps) && found.fps > 0)
            found.assumed.push_back(short_number(found.fps) +
                                    " frames a second, as the recordingMeta beside it says.");
    }
    if (found.fps <= 0) {
        found.fps = 25;
        found.assumed.push_back("25 frames a second, as inD has: no recordingMeta lies beside it.");
    }
    const Result<Bytes> meta = read_bytes(stem + "_tracksMeta.csv", k_most_meta_bytes);
    if (!meta) return {};
    std::vector<size_t> place(found.names.size(), k_most_sightings);  // in `tracked`
    for (size_t i = 0; i < found.tracked.size(); ++i) place[found.tracked[i].id] = i;
    const auto rows = rows_of(*meta);
    const auto names = split(without_return(rows[0]), ',');
    const size_t track = column_called(names, "trackId"), kind = column_called(names, "class");
    for (size_t i = 1; i < rows.size(); ++i) {
        const auto words = split(without_return(rows[i]), ',');
        if (track >= words.size() || kind >= words.size()) continue;
        const auto who = found.number_of_name.find(words[track]);
        if (who == found.number_of_name.end()) continue;
        if (place[who->second] == k_most_sightings) {
            place[who->second] = found.tracked.size();
            found.tracked.push_back({.id = who->second, .name = {}});
        }
        found.tracked[place[who->second]].kind = kind_of_word(words[kind]);
    }
    return {};
}

}  // namespace flaneur
