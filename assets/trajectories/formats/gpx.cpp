// GPX: each track somebody, as a watch or a phone has them: degrees, metres above the sea, UTC.
#include "assets/files/words.h"
#include "assets/trajectories/formats.h"
#include "assets/trajectories/formats/xml.h"

namespace flaneur {

Result<FoundTracks> parse_gpx(const TrajectorySource& source) {
    FoundTracks found;
    found.format = "GPX";
    found.is_in_degrees = true;
    FoundRow row;
    std::vector<FoundRow> track;
    std::string name;
    double latitude = 0, longitude = 0;
    bool is_in_track = false, is_in_point = false, has_time = false;
    size_t tracks = 0;
    const XmlHandlers handlers{
        .begin = [&](std::string_view element, XmlAttributes a) -> std::string {
            if (element == "trk") {
                is_in_track = true, name.clear(), track.clear();
            } else if (is_in_track && element == "trkpt") {
                if (!parse_number(a["lat"], latitude) || !parse_number(a["lon"], longitude))
                    return "a point without degrees";
                is_in_point = true, has_time = false;
                row = {.x = longitude, .y = latitude, .facing = {}};
            }
            return {};
        },
        .end = [&](std::string_view element, std::string_view text) -> std::string {
            if (is_in_point && element == "time") {
                const std::optional<double> moment = seconds_of_moment(text);
                if (!moment) return "a time that is none";
                row.time = *moment, has_time = true;
            } else if (is_in_point && element == "ele") {
                if (parse_number(text, row.z)) found.has_heights = true;
            } else if (is_in_track && !is_in_point && element == "name") {
                name = text.substr(0, 200);
            } else if (is_in_point && element == "trkpt") {
                is_in_point = false;
                if (track.size() >= k_most_sightings) return "more positions than are read";
                if (has_time)
                    track.push_back(row);
                else
                    ++found.left_out;
            } else if (element == "trk" && is_in_track) {
                is_in_track = false;
                ++tracks;
                if (name.empty()) name = "track " + std::to_string(tracks);
                // Two of the same name are two.
                if (found.number_of_name.contains(name)) name += " (" + std::to_string(tracks) + ")";
                if (track.empty()) return {};
                const uint32_t who = who_is(found, name);
                for (FoundRow& at : track) {
                    at.who = who;
                    if (Result<void> added = add_row(found, at); !added) return added.error().message;
                }
            }
            return {};
        },
        .keeps_text = true};
    if (Result<void> walked = walk_xml(source.text, handlers); !walked) return walked.error();
    if (found.has_heights) found.heights = HeightsOf::ground;
    return found;
}

}  // namespace flaneur
