#include "assets/trajectories/formats/columns.h"

#include <algorithm>

namespace flaneur {
namespace {

struct CalledColumn {
    Column column;
    std::string_view name;
};

// The first that fits wins, so that "id" is before "name", and places before other x.
constexpr CalledColumn k_called_columns[] = {
    {Column::id, "id"},
    {Column::id, "pedid"},
    {Column::id, "pedestrianid"},
    {Column::id, "personid"},
    {Column::id, "agentid"},
    {Column::id, "trackid"},
    {Column::id, "objectid"},
    {Column::id, "pid"},
    {Column::id, "no"},
    {Column::id, "ped"},
    {Column::id, "pedestrian"},
    {Column::id, "person"},
    {Column::id, "agent"},
    {Column::id, "track"},
    {Column::id, "walker"},
    {Column::id, "object"},
    {Column::id, "name"},
    {Column::frame, "frame"},
    {Column::frame, "fr"},
    {Column::frame, "frameid"},
    {Column::frame, "framenumber"},
    {Column::frame, "framenr"},
    {Column::frame, "timestep"},
    {Column::frame, "step"},
    {Column::frame, "tick"},
    {Column::time, "time"},
    {Column::time, "t"},
    {Column::time, "times"},
    {Column::time, "timems"},
    {Column::time, "simtime"},
    {Column::time, "simsec"},
    {Column::time, "seconds"},
    {Column::time, "sec"},
    {Column::time, "timestamp"},
    {Column::time, "timestampms"},
    {Column::time, "datetime"},
    {Column::x, "startx"},
    {Column::x, "x"},
    {Column::x, "xm"},
    {Column::x, "xcm"},
    {Column::x, "xmm"},
    {Column::x, "posx"},
    {Column::x, "positionx"},
    {Column::x, "xpos"},
    {Column::x, "xcenter"},
    {Column::x, "centerx"},
    {Column::x, "coordcentx"},
    {Column::x, "coordinatex"},
    {Column::x, "xcoordinate"},
    {Column::x, "xcoord"},
    {Column::x, "px"},
    {Column::x, "lon"},
    {Column::x, "longitude"},
    {Column::x, "lng"},
    {Column::y, "starty"},
    {Column::y, "y"},
    {Column::y, "ym"},
    {Column::y, "ycm"},
    {Column::y, "ymm"},
    {Column::y, "posy"},
    {Column::y, "positiony"},
    {Column::y, "ypos"},
    {Column::y, "ycenter"},
    {Column::y, "centery"},
    {Column::y, "coordcenty"},
    {Column::y, "coordinatey"},
    {Column::y, "ycoordinate"},
    {Column::y, "ycoord"},
    {Column::y, "py"},
    {Column::y, "lat"},
    {Column::y, "latitude"},
    {Column::z, "z"},
    {Column::z, "zm"},
    {Column::z, "zcm"},
    {Column::z, "zmm"},
    {Column::z, "posz"},
    {Column::z, "positionz"},
    {Column::z, "zpos"},
    {Column::z, "coordcentz"},
    {Column::z, "elevation"},
    {Column::z, "ele"},
    {Column::z, "altitude"},
    {Column::facing_x, "facingx"},
    {Column::facing_x, "orix"},
    {Column::facing_y, "facingy"},
    {Column::facing_y, "oriy"},
    {Column::turned, "angle"},    // jpscore
    {Column::turned, "heading"},  // inD
    {Column::kind, "class"},
    {Column::kind, "agenttype"},
    {Column::kind, "objecttype"},
    {Column::kind, "type"},
    {Column::kind, "kind"},
    {Column::kind, "label"},
    {Column::length, "length"},
    {Column::width, "width"},
    {Column::end_time, "endtime"},
    {Column::end_x, "endx"},
    {Column::end_y, "endy"},
};

// Small letters and digits: "pos_x" is "posx".
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name.substr(0, 64)) {
        if (c >= 'A' && c <= 'Z') plain += static_cast<char>(c - 'A' + 'a');
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) plain += c;
    }
    return plain;
}

// "x [cm]", "x(cm)", "x/cm", "x_cm" and "x in cm" as "x" and "cm".
struct NameAndUnit {
    std::string_view name, unit;
};
NameAndUnit taken_apart(std::string_view name) {
    // "$PEDESTRIAN:NO" of Vissim, "startX-PID1" of Vadere
    if (const size_t colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
    if (const size_t process = name.find("-PID"); process != std::string_view::npos)
        name = name.substr(0, process);
    for (const std::string_view mark : {"[", "(", "/", " in ", "_"}) {
        const size_t at = name.rfind(mark);
        if (at == std::string_view::npos || at == 0) continue;
        const std::string_view unit = name.substr(at + mark.size());
        if (metres_of(unit) > 0 || seconds_of_unit(unit) > 0) return {name.substr(0, at), unit};
    }
    return {name, {}};
}

}  // namespace

double metres_of(std::string_view word) {
    const std::string unit = plain_name(word);
    for (const std::string_view name : {"m", "metre", "metres", "meter", "meters"})
        if (unit == name) return 1;
    for (const std::string_view name : {"cm", "centimetres", "centimeters"})
        if (unit == name) return 0.01;
    for (const std::string_view name : {"mm", "millimetres", "millimeters"})
        if (unit == name) return 0.001;
    if (unit == "ft" || unit == "feet") return 0.3048;
    return 0;
}

double seconds_of_unit(std::string_view word) {
    const std::string unit = plain_name(word);
    if (unit == "s" || unit == "sec" || unit == "seconds") return 1;
    if (unit == "ms" || unit == "milliseconds") return 1e-3;
    if (unit == "us" || unit == "microseconds") return 1e-6;
    if (unit == "ns") return 1e-9;
    return 0;
}

Columns columns_of(const std::vector<std::string_view>& names) {
    Columns columns;
    std::array<size_t, k_column_count> rank;
    rank.fill(std::size(k_called_columns));
    for (size_t i = 0; i < names.size(); ++i) {
        const NameAndUnit apart = taken_apart(names[i]);
        const std::string plain = plain_name(apart.name);
        for (size_t k = 0; k < std::size(k_called_columns); ++k) {
            const auto column = static_cast<size_t>(k_called_columns[k].column);
            if (plain != k_called_columns[k].name || rank[column] <= k) continue;
            rank[column] = k;
            columns.at[column] = i;
            if (k_called_columns[k].column == Column::x) {
                columns.unit = metres_of(apart.unit);
                if (plain.ends_with("cm") || plain.ends_with("mm") || plain == "xm")
                    columns.unit = metres_of(std::string_view(plain).substr(1));
                columns.is_in_degrees = plain.starts_with("lon") || plain == "lng";
            }
            if (k_called_columns[k].column == Column::time)
                columns.second = plain.ends_with("ms") && plain != "times" ? 1e-3
                                 : plain.starts_with("sim") || plain.starts_with("sec")
                                     ? 1
                                     : seconds_of_unit(apart.unit);
        }
    }
    columns.is_named = true;
    return columns;
}

}  // namespace flaneur
