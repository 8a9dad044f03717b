// Floating-car data of Eclipse SUMO: where persons and vehicles are, step by step.
#include <algorithm>
#include <cmath>

#include "assets/files/words.h"
#include "assets/trajectories/formats.h"
#include "assets/trajectories/formats/xml.h"
#include "sim/base/math.h"

namespace flaneur {
namespace {

// What an element tells of one who is there; a sentence if it tells too little.
std::string add_fcd_element(FoundTracks& found, XmlAttributes a, bool is_person, double time) {
    FoundRow row{.time = time, .facing = {}};
    double z = 0, angle = 0;
    if (!parse_number(a["x"], row.x) || !parse_number(a["y"], row.y))
        return "somebody without an x and a y that are numbers";
    if (a["id"].empty()) return "somebody without an id";
    if (a.has("z") && parse_number(a["z"], z)) found.has_heights = true;
    row.z = static_cast<float>(z);
    // Clockwise from north.
    if (parse_number(a["angle"], angle) && std::fabs(angle) <= 1e4) {
        const SinCos turn = sin_cos(wrap_angle(static_cast<float>(angle) * k_radians));
        row.facing = {turn.sine, 0 - turn.cosine};
    }
    // A person and a vehicle may be called the same.
    row.who = is_person ? who_is(found, a["id"]) : who_is(found, "vehicle " + std::string(a["id"]));
    while (found.tracked.size() < found.names.size()) {
        Tracked& tracked = found.tracked.emplace_back();
        tracked.id = static_cast<uint32_t>(found.tracked.size() - 1);
        if (is_person) continue;
        tracked.name = std::string(a["id"]);
        tracked.kind = kind_of_word(a["type"]);
        if (tracked.kind == TrackedKind::person) tracked.kind = TrackedKind::car;
    }
    if (Result<void> added = add_row(found, row); !added) return added.error().message;
    return {};
}

}  // namespace

Result<FoundTracks> parse_sumo_fcd(const TrajectorySource& source) {
    FoundTracks found;
    found.format = "FCD of SUMO";
    found.unit = 1;
    found.geometry_ending = ".net.xml";
    // SUMO writes its configuration before the data.
    const std::string_view head = source.text.substr(0, 16'384);
    found.is_in_degrees = head.find("fcd-output.geo value=\"true\"") != std::string_view::npos;
    if (const size_t at = head.find("<net-file value=\""); at != std::string_view::npos) {
        const size_t from = at + 17;
        found.geometry = head.substr(from, std::min<size_t>(head.find('"', from) - from, 256));
    }
    double time = 0;
    bool is_in_step = false;
    Result<void> walked =
        walk_xml(source.text, {.begin = [&](std::string_view name, XmlAttributes a) -> std::string {
                                   if (name == "timestep") {
                                       is_in_step = true;
                                       const std::optional<double> moment = seconds_of_moment(a["time"]);
                                       if (!parse_number(a["time"], time) && !moment)
                                           return "a timestep without a time";
                                       if (moment) time = *moment;
                                   } else if (is_in_step && (name == "person" || name == "vehicle")) {
                                       return add_fcd_element(found, a, name == "person", time);
                                   }
                                   return {};
                               },
                               .end = {}});
    if (!walked) return walked.error();
    // Only persons: they are called as they are in the file, and are what people are taken for.
    if (std::all_of(found.tracked.begin(), found.tracked.end(),
                    [](const Tracked& t) { return t.kind == TrackedKind::person; }))
        found.tracked.clear();
    return found;
}

}  // namespace flaneur
