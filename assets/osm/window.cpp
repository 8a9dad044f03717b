#include "assets/osm/window.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "assets/files/file.h"
#include "assets/osm/cut.h"

namespace flaneur {

namespace {

// How long it takes on two cores, seconds: the navigation mesh of so much ground, and what a node of a house
// or street adds to it. As measured in dense and in open districts, see docs/city.md.
constexpr double k_seconds_per_km2 = 1.3, k_seconds_per_node = 80e-6;
// Beside reading, people and the picture itself somebody waits so long at most.
constexpr double k_patience = 17;
// Without --radius, about a middle that somebody chose.
constexpr float k_usual_radius = 1200;
constexpr float k_radii[] = {
    k_most_map_radius, 2500, 2250, 2000, 1800, 1600, 1400, 1200, 1000, 800, 600, 400, 250,
    k_least_map_radius};
// Wider files are not gone through for the place where there is most to see, degrees, unless they are small
// and only say so, bytes.
constexpr double k_most_searched = 1.5;
constexpr uintmax_t k_small = 16 << 20;
// What a .pbf holds takes more than so many times its size in memory.
constexpr uintmax_t k_packed = 4;

double seconds_for(double nodes, double width, double depth) {
    return nodes * k_seconds_per_node + width * depth * 1e-6 * k_seconds_per_km2;
}

// Sums over squares of the map, for those of any rectangle.
struct SumGrid {
    int columns = 0, rows = 0;
    std::vector<double> sums;  // of all squares to the west and north, one more a side than there are squares

    double& at(int column, int row) {
        return sums[static_cast<size_t>(row) * static_cast<size_t>(columns + 1) +
                    static_cast<size_t>(column)];
    }
    void sum_up() {
        for (int row = 1; row <= rows; ++row)
            for (int column = 1; column <= columns; ++column)
                at(column, row) += at(column - 1, row) + at(column, row - 1) - at(column - 1, row - 1);
    }
    double about(int column, int row, int reach) {
        int x0 = std::max(0, column - reach), x1 = std::min(columns, column + reach + 1);
        int y0 = std::max(0, row - reach), y1 = std::min(rows, row + reach + 1);
        return at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0);
    }
};

SumGrid make_sums(int columns, int rows) {
    return {columns, rows,
            std::vector<double>(static_cast<size_t>(columns + 1) * static_cast<size_t>(rows + 1))};
}

// For cut_to.
struct MapSource {
    const OsmMap& map;

    template <class Visit>
    void nodes(Visit visit) {
        for (const OsmNode& n : map.nodes) visit(n.id, n.longitude, n.latitude, [&] { return n; });
    }
    template <class Visit>
    void ways(Visit visit) {
        for (const OsmWay& w : map.ways)
            visit(
                w.id, w.nodes.size(), [&](size_t i) { return w.nodes[i]; }, [&] { return w; });
    }
    template <class Visit>
    void relations(Visit visit) {
        for (const OsmRelation& r : map.relations)
            visit(
                r.ways.size(), [&](size_t i) { return r.ways[i].way; }, [&] { return r; });
    }
};

bool is_in(const OsmBox& box, double longitude, double latitude) {
    double x = near_longitude(longitude, (box[0] + box[2]) * 0.5);
    return x >= box[0] && x <= box[2] && latitude >= box[1] && latitude <= box[3];
}

// The window's box, and within what the file states of itself, if it does.
std::optional<OsmBox> box_of(const OsmWindow& window, const std::optional<OsmBox>& stated) {
    const Projection& p = window.project;
    if (p.pole != 0) return std::nullopt;
    double east = static_cast<double>(window.half) / p.metres_per_longitude,
           north = static_cast<double>(window.half) / p.metres_per_latitude;
    OsmBox box{p.longitude - east, p.latitude - north, p.longitude + east, p.latitude + north};
    if (!stated || (*stated)[2] - (*stated)[0] > 180) return box;  // or wound round the Earth
    double middle = ((*stated)[0] + (*stated)[2]) * 0.5, turn = near_longitude(middle, p.longitude) - middle;
    return OsmBox{std::max(box[0], (*stated)[0] + turn), std::max(box[1], (*stated)[1]),
                  std::min(box[2], (*stated)[2] + turn), std::min(box[3], (*stated)[3])};
}

bool is_vast(const std::string& path, const OsmBox& box) {
    std::error_code unknown;
    bool is_wide = std::max(box[2] - box[0], box[3] - box[1]) > k_most_searched;
    return is_wide && std::filesystem::file_size(path, unknown) > k_small;
}

// Whether a file need not be tried.
bool is_surely_too_large(const std::string& path, size_t most) {
    std::error_code unknown;
    return has_ending(path, ".pbf") && std::filesystem::file_size(path, unknown) > most / k_packed;
}

std::string shown_box(const OsmBox& box) {
    return shown_place({box[1], box[0]}) + " to " + shown_place({box[3], box[2]});
}

std::string shown_km(float metres) {
    char text[24];
    std::snprintf(text, sizeof text, "%.1f", static_cast<double>(metres) / 1000);
    return text;
}

}  // namespace

OsmWindow window_about(const MapPlace& middle, float half) {
    return {projection_about(middle.longitude, middle.latitude), half};
}

std::string shown_place(const MapPlace& place) {
    char text[48];
    std::snprintf(text, sizeof text, "%.4f,%.4f", place.latitude, place.longitude);
    return text;
}

double near_longitude(double longitude, double about) {
    if (longitude - about > 180) return longitude - 360;
    return longitude - about < -180 ? longitude + 360 : longitude;
}

bool is_within(const OsmWindow& window, double longitude, double latitude, float beyond) {
    Vec2 p = window.project.at(near_longitude(longitude, window.project.longitude), latitude);
    return std::max(std::fabs(p.x), std::fabs(p.z)) <= window.half + beyond;
}

OsmSight sight_of(std::string_view highway, std::string_view building, size_t nodes) {
    bool is_house = !building.empty() && building != "no";
    if (!is_house && highway.empty()) return {};
    bool on_foot = highway == "footway" || highway == "pedestrian" || highway == "steps" ||
                   highway == "path" || highway == "living_street";
    return {0, 0, is_house ? 1.0f : on_foot ? 2.0f : 0.5f, static_cast<float>(nodes)};
}

std::vector<OsmSight> sights_of(const OsmMap& map) {
    std::vector<OsmSight> sights;
    for (const OsmWay& way : map.ways) {
        const OsmNode* node = way.nodes.empty() ? nullptr : map.node(way.nodes[0]);
        OsmSight sight = sight_of(way.tags["highway"], way.tags["building"], way.nodes.size());
        if (!node || sight.nodes == 0) continue;
        sight.longitude = node->longitude, sight.latitude = node->latitude;
        sights.push_back(sight);
    }
    return sights;
}

OsmChoice choose_window(const std::vector<OsmSight>& sights, const std::optional<OsmBox>& extent,
                        float radius) {
    OsmChoice choice;
    if (sights.empty()) return choice;
    OsmBox box = extent.value_or(OsmBox{1e9, 1e9, -1e9, -1e9});
    double about = extent ? (box[0] + box[2]) * 0.5 : sights[0].longitude;
    for (const OsmSight& s : sights) {
        if (extent) break;
        double x = near_longitude(s.longitude, about);
        box = {std::min(box[0], x), std::min(box[1], s.latitude), std::max(box[2], x),
               std::max(box[3], s.latitude)};
    }
    Projection project = projection_about((box[0] + box[2]) * 0.5, (box[1] + box[3]) * 0.5);
    double width = (box[2] - box[0]) * project.metres_per_longitude,
           depth = (box[3] - box[1]) * project.metres_per_latitude;
    choice.width = static_cast<float>(width), choice.depth = static_cast<float>(depth);

    // Squares of 100 m, or larger ones where there would be too many.
    double cell = 100;
    while (std::max(width, depth) / cell > 2000) cell *= 2;
    SumGrid interest = make_sums(static_cast<int>(width / cell) + 1, static_cast<int>(depth / cell) + 1),
            nodes = interest;
    std::vector<uint8_t> is_built(interest.sums.size());
    double all = 0;
    for (const OsmSight& s : sights) {
        if (extent && !is_in(box, s.longitude, s.latitude)) continue;
        int column = static_cast<int>((near_longitude(s.longitude, about) - box[0]) *
                                      project.metres_per_longitude / cell);
        int row = static_cast<int>((box[3] - s.latitude) * project.metres_per_latitude / cell);
        column = std::clamp(column, 0, interest.columns - 1), row = std::clamp(row, 0, interest.rows - 1);
        double& sum = interest.at(column + 1, row + 1);
        sum += static_cast<double>(s.interest);
        is_built[static_cast<size_t>(&sum - interest.sums.data())] = 1;
        nodes.at(column + 1, row + 1) += static_cast<double>(s.nodes);
        all += static_cast<double>(s.nodes);
    }
    constexpr double k_widest = 2 * static_cast<double>(k_most_map_radius);
    choice.is_whole =
        radius > 0 ? std::max(choice.width, choice.depth) <= 2 * radius
                   : seconds_for(all, width, depth) <= k_patience && width * depth <= k_widest * k_widest;
    if (choice.is_whole) return choice;
    interest.sum_up();
    nodes.sum_up();
    for (float half : k_radii) {
        if (radius > 0) half = radius;
        int reach = static_cast<int>(static_cast<double>(half) / cell), best_column = 0, best_row = 0;
        double most = -1;
        for (int row = 0; row < interest.rows; ++row) {
            for (int column = 0; column < interest.columns; ++column) {
                if (!is_built[static_cast<size_t>(&interest.at(column + 1, row + 1) - interest.sums.data())])
                    continue;
                // What is near the middle counts twice.
                double sum = interest.about(column, row, reach) + interest.about(column, row, reach / 2);
                if (sum > most) most = sum, best_column = column, best_row = row;
            }
        }
        // As the note says it, so that --center finds it again.
        auto rounded = [](double degrees) { return std::floor(degrees * 1e4 + 0.5) / 1e4; };
        MapPlace middle{
            rounded(box[3] - (best_row + 0.5) * cell / project.metres_per_latitude),
            rounded(near_longitude(box[0] + (best_column + 0.5) * cell / project.metres_per_longitude, 0))};
        choice.window = window_about(middle, half);
        double side = 2 * static_cast<double>(half);
        if (radius > 0 || seconds_for(nodes.about(best_column, best_row, reach), side, side) <= k_patience)
            break;
    }
    return choice;
}

OsmMap cut_map(const OsmMap& map, const OsmWindow& window) {
    MapSource source{map};
    OsmMap cut = cut_to(window, source);
    cut.too_long = map.too_long;
    return cut;
}

Result<OsmMap> read_drawn(const std::string& path, const CityOptions& options) {
    Result<std::optional<OsmBox>> stated = read_osm_bounds(path);
    if (!stated) return stated.error();
    const std::optional<OsmBox>& bounds = *stated;
    OsmReading how{k_osm_most_bytes, options.tell};
    std::optional<OsmMap> cut;
    OsmChoice choice;
    if (options.center) {
        choice.window = window_about(*options.center, options.radius > 0 ? options.radius : k_usual_radius);
        std::optional<OsmBox> box = box_of(choice.window, bounds);
        if (bounds && box && ((*box)[0] >= (*box)[2] || (*box)[1] >= (*box)[3])) {
            MapPlace swapped{options.center->longitude, options.center->latitude};
            return Error{"The map " + path + " reaches from " + shown_box(*bounds) +
                         " (latitude,longitude); --center " + shown_place(*options.center) + " is not there" +
                         (is_in(*bounds, swapped.longitude, swapped.latitude)
                              ? ", but " + shown_place(swapped) + " is: latitude comes first."
                              : ".")};
        }
        if (bounds && projection_about((*bounds)[0], (*bounds)[1]).pole == 0) {
            const Projection& p = choice.window.project;
            choice.width = static_cast<float>(((*bounds)[2] - (*bounds)[0]) * p.metres_per_longitude);
            choice.depth = static_cast<float>(((*bounds)[3] - (*bounds)[1]) * p.metres_per_latitude);
        }
    } else {
        if (bounds && is_vast(path, *bounds))
            return Error{"The map " + path + " reaches from " + shown_box(*bounds) +
                         " (latitude,longitude), too far to be searched for the place to draw; say where "
                         "with --center LAT,LON."};
        bool is_too_large = is_surely_too_large(path, how.most);
        Result<OsmMap> whole = is_too_large ? Error{} : read_osm(path, how, &is_too_large);
        if (!whole && !is_too_large) return whole;
        Result<std::vector<OsmSight>> sights = whole ? sights_of(*whole) : survey_osm(path, options.tell);
        if (!sights) return sights.error();
        choice = choose_window(*sights, whole ? extent_of(*whole) : bounds, options.radius);
        if (choice.is_whole || sights->empty()) return whole ? std::move(whole) : read_osm(path, how);
        if (whole) cut = cut_map(*whole, choice.window);
    }
    if (!cut) {
        Result<OsmMap> read = read_osm_window(path, choice.window, how);
        if (!read) return read;
        cut = std::move(*read);
    }
    cut->box = box_of(choice.window, bounds);
    cut->whole_width = choice.width, cut->whole_depth = choice.depth;
    if (!options.center) {
        const Projection& p = choice.window.project;
        std::string side = shown_km(2 * choice.window.half);
        cut->cut_note = "the map is " + shown_km(choice.width) + " x " + shown_km(choice.depth) +
                        " km; drawn are " + side + " x " + side + " km about " +
                        shown_place({p.latitude, p.longitude}) +
                        ", where there is most to see. --center LAT,LON and --radius M choose.";
    }
    return std::move(*cut);
}

}  // namespace flaneur
