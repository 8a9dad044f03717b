#include <cmath>
#include <limits>

#include "assets/measures/lines.h"
#include "assets/measures/moments.h"
#include "assets/measures/profile.h"
#include "assets/measures/service.h"
#include "assets/trajectories/wkt.h"
#include "python/native/native.h"
#include "sim/base/math.h"
#include "sim/base/parallel_for.h"

namespace py = pybind11;

namespace flaneur {
namespace {

constexpr double k_speed_seconds = 0.2;  // before and after, where nothing is said
constexpr const char* k_ends[] = {"exclude", "adaptive", "single_sided"};  // by AtEnds
constexpr const char* k_methods[] = {"classic", "voronoi", "gaussian"};    // by FieldMethod
constexpr const char* k_services[] = {"walkway", "stairs", "queue"};       // by ServiceOf

template <class Kind, size_t N>
Kind kind_of_word(const char* const (&words)[N], const std::string& word, const char* what) {
    for (size_t k = 0; k < N; ++k)
        if (word == words[k]) return static_cast<Kind>(k);
    std::string all;
    for (size_t k = 0; k < N; ++k) all.append(k == 0 ? "" : k + 1 < N ? ", " : " or ").append(words[k]);
    throw Refusal(std::string(what) + " is " + all + ", not '" + word + "'.");
}

std::vector<WalkablePolygon> polygons_of(const std::string& wkt, const char* what) {
    Result<std::vector<WalkablePolygon>> polygons = parse_wkt(wkt);
    if (!polygons) throw Refusal(std::string("The ") + what + " " + polygons.error().message);
    return std::move(*polygons);
}

// Frames before and after; 0: of a fifth of a second.
uint32_t step_of(const Tracks& tracks, int64_t frame_step) {
    if (frame_step < 0 || frame_step > 1'000'000) throw Refusal("frame_step is a number of frames above 0.");
    if (frame_step > 0) return static_cast<uint32_t>(frame_step);
    return static_cast<uint32_t>(std::max(1L, std::lround(k_speed_seconds * wide(tracks.of.fps))));
}

std::vector<float> speeds_now(const Tracks& tracks, int64_t frame_step, const std::string& ends) {
    return speeds_of(
        velocities(tracks.table, step_of(tracks, frame_step), kind_of_word<AtEnds>(k_ends, ends, "ends")));
}

py::dict speeds(const Tracks& tracks, int64_t frame_step, const std::string& ends) {
    const std::vector<Vec2> v =
        velocities(tracks.table, step_of(tracks, frame_step), kind_of_word<AtEnds>(k_ends, ends, "ends"));
    py::dict to;
    to["v_x"] = column<double>(v, [](Vec2 of) { return of.x; });
    to["v_y"] = column<double>(v, [](Vec2 of) { return 0 - of.z; });
    to["speed"] = column<double>(speeds_of(v), [](float of) { return of; });
    return to;
}

CutOff cut_off_of(double metres) {
    if (!(metres >= 0 && metres < 1e6)) throw Refusal("cut_off is metres, or 0 for none.");
    return {static_cast<float>(metres)};
}

py::dict moments(const Tracks& tracks, const std::string& area_wkt, const std::string& walkable_wkt,
                 double cut_off, int64_t frame_step, const std::string& ends) {
    const std::vector<WalkablePolygon> outlines = polygons_of(area_wkt, "area");
    const std::vector<WalkablePolygon> walkable = polygons_of(walkable_wkt, "geometry");
    const CutOff cut = cut_off_of(cut_off);
    const std::vector<float> v = speeds_now(tracks, frame_step, ends);
    std::vector<AreaMoment> rows;
    double metres = 0;
    {
        const py::gil_scoped_release released;
        const MeasuredArea area = measured_area(outlines, walkable, cut);
        metres = area.square_metres;
        const WorkersPtr workers = make_workers(0);
        if (metres >= 0.01)
            rows = area_moments(tracks.table, area, cell_ground(walkable, cut), v, {}, *workers);
    }
    if (metres < 0.01) throw Refusal("Nobody can walk in that area.");
    const double fps = wide(tracks.of.fps);
    py::dict to;
    to["frame"] = column<int64_t>(rows, [](const AreaMoment& m) { return m.frame; });
    to["time"] = column<double>(rows, [=](const AreaMoment& m) { return m.frame / fps; });
    to["people"] = column<int64_t>(rows, [](const AreaMoment& m) { return m.people; });
    to["classic"] = column<double>(rows, [](const AreaMoment& m) { return m.classic; });
    to["density"] = column<double>(rows, [](const AreaMoment& m) { return m.voronoi; });
    to["mean_speed"] = column<double>(rows, [](const AreaMoment& m) { return m.mean_speed; });
    to["voronoi_speed"] = column<double>(rows, [](const AreaMoment& m) { return m.voronoi_speed; });
    to["covered"] = column<double>(rows, [](const AreaMoment& m) { return m.covered; });
    return to;
}

py::dict spaces(const Tracks& tracks, const std::string& walkable_wkt, double cut_off) {
    const std::vector<WalkablePolygon> walkable = polygons_of(walkable_wkt, "geometry");
    const CutOff cut = cut_off_of(cut_off);
    std::vector<PersonalSpace> rows;
    {
        const py::gil_scoped_release released;
        const WorkersPtr workers = make_workers(0);
        rows = personal_spaces(tracks.table, cell_ground(walkable, cut), {}, *workers);
    }
    py::dict to;
    to["area"] = column<double>(rows, [](const PersonalSpace& s) { return s.area; });
    to["density"] = column<double>(rows, [](const PersonalSpace& s) {
        return s.area > 0 ? 1 / wide(s.area) : std::numeric_limits<double>::quiet_NaN();
    });
    to["nearest"] = column<double>(rows, [](const PersonalSpace& s) { return s.nearest; });
    to["neighbours"] = column<int64_t>(rows, [](const PersonalSpace& s) { return s.neighbours; });
    return to;
}

py::tuple flow(const Tracks& tracks, std::array<double, 4> line, double seconds, int64_t frame_step,
               const std::string& ends) {
    for (const double n : line)
        if (!std::isfinite(n)) throw Refusal("A line is two places, (x, y) each.");
    if (line[0] == line[2] && line[1] == line[3]) throw Refusal("The ends of a line are two places.");
    if (!(seconds > 0 && seconds < 1e7)) throw Refusal("seconds are above 0.");
    const MeasuredLine where{{static_cast<float>(line[0]), static_cast<float>(-line[1])},
                             {static_cast<float>(line[2]), static_cast<float>(-line[3])}};
    const std::vector<float> v = speeds_now(tracks, frame_step, ends);
    const std::vector<LineCrossed> all = line_crossings(tracks.table, where, {});
    const std::vector<LineCrossed> first = first_crossings(all);
    const float fps = tracks.of.fps;
    const auto delta = static_cast<uint32_t>(std::max(1L, std::lround(seconds * wide(fps))));
    const std::vector<FlowInterval> rows = flow_intervals(first, v, delta, tracks.table.frames.back(), fps);
    py::dict crossings, intervals;
    crossings["id"] = column<int64_t>(first, [](const LineCrossed& c) { return c.id; });
    crossings["frame"] = column<int64_t>(first, [](const LineCrossed& c) { return c.frame; });
    crossings["time"] = column<double>(first, [=](const LineCrossed& c) { return c.frames / wide(fps); });
    crossings["to_left"] = column<bool>(first, [](const LineCrossed& c) { return c.to_left; });
    crossings["x"] = column<double>(first, [](const LineCrossed& c) { return c.at.x; });
    crossings["y"] = column<double>(first, [](const LineCrossed& c) { return 0 - c.at.z; });
    const double metres = std::hypot(line[2] - line[0], line[3] - line[1]);
    intervals["first"] = column<int64_t>(rows, [](const FlowInterval& i) { return i.first; });
    intervals["last"] = column<int64_t>(rows, [](const FlowInterval& i) { return i.last; });
    intervals["people"] = column<int64_t>(rows, [](const FlowInterval& i) { return i.people; });
    intervals["flow"] = column<double>(rows, [](const FlowInterval& i) { return i.flow; });
    intervals["specific_flow"] = column<double>(rows, [=](const FlowInterval& i) { return i.flow / metres; });
    intervals["speed"] = column<double>(rows, [](const FlowInterval& i) { return i.mean_speed; });
    return py::make_tuple(crossings, intervals);
}

py::array_t<float> map_of(const ProfileGrid& grid, const std::vector<float>& values) {
    return py::array_t<float>({grid.rows, grid.columns}, values.data());
}

py::dict profiles(const Tracks& tracks, const std::string& area_wkt, const std::string& walkable_wkt,
                  double square, const std::string& method, double width, int64_t every, double cut_off,
                  int64_t frame_step, const std::string& ends) {
    const std::vector<WalkablePolygon> outlines = polygons_of(area_wkt, "area");
    const std::vector<WalkablePolygon> walkable = polygons_of(walkable_wkt, "geometry");
    const CutOff cut = cut_off_of(cut_off);
    const std::vector<float> v = speeds_now(tracks, frame_step, ends);
    if (!(square > 0 && square < 1e6)) throw Refusal("square is the side of one, metres.");
    if (!(width > 0 && width < 1e6)) throw Refusal("width is metres, above 0.");
    if (every < 1 || every > 1'000'000) throw Refusal("every is a number of frames, 1 or more.");
    const ProfileOf what{.method = kind_of_word<FieldMethod>(k_methods, method, "method"),
                         .gaussian_width = static_cast<float>(width),
                         .range = {},
                         .every = static_cast<uint32_t>(every)};
    const Rectangle box = cell_ground(outlines, cut).box;
    const Vec2 size = box.high - box.low;
    if (!(std::ceil(wide(size.x) / square) * std::ceil(wide(size.z) / square) <= k_most_field_squares))
        throw Refusal("That takes more than " + std::to_string(k_most_field_squares) +
                      " squares: make them larger, or the area smaller.");
    Profiles made;
    {
        const py::gil_scoped_release released;
        const WorkersPtr workers = make_workers(0);
        made = profiles_of(tracks.table, cell_ground(walkable, cut), v,
                           profile_grid(box, static_cast<float>(square)), what, *workers);
    }
    py::dict to;
    const ProfileGrid& grid = made.grid;
    const double side = wide(grid.square), west = wide(grid.low.x), north = 0 - wide(grid.low.z);
    to["density"] = map_of(grid, made.density);
    to["speed"] = map_of(grid, made.speed);
    to["flow"] = map_of(grid, made.flow);
    to["extent"] = py::make_tuple(west, west + grid.columns * side, north - grid.rows * side, north);
    to["frames"] = made.frames;
    return to;
}

py::array_t<int64_t> levels(const py::array_t<double, py::array::c_style | py::array::forcecast>& densities,
                            const std::string& of) {
    const auto kind = kind_of_word<ServiceOf>(k_services, of, "of");
    const std::vector<double> all(densities.data(), densities.data() + densities.size());
    return column<int64_t>(
        all, [=](double d) { return std::isfinite(d) ? fruin_level(static_cast<float>(d), kind) : -1; });
}

}  // namespace

void add_measures(py::module_& module, py::class_<Tracks>& tracks) {
    tracks.def("speeds", speeds)
        .def("moments", moments)
        .def("spaces", spaces)
        .def("flow", flow)
        .def("profiles", profiles);
    module.def("levels", levels);
}

}  // namespace flaneur
