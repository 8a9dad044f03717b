#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>
#include <optional>

#include "assets/trajectories/wkt.h"
#include "assets/trajectories/write.h"
#include "python/native/native.h"
#include "sim/base/math.h"

namespace py = pybind11;

namespace flaneur {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Counts = py::array_t<int64_t, py::array::c_style | py::array::forcecast>;
constexpr const char* k_heights[] = {"nothing", "ground", "heads"};  // by HeightsOf

std::unique_ptr<Tracks> read(const std::string& path, double unit, double fps, const std::string& up,
                             const std::string& geometry) {
    if (!(unit >= 0 && unit < 1e6) || !(fps >= 0 && fps < 1e6))
        throw Refusal("unit and fps are numbers above 0, or None.");
    if (!up.empty() && up != "y" && up != "z") throw Refusal("up is 'y', 'z' or None.");
    TrajectoryReading reading{static_cast<float>(unit), static_cast<float>(fps), up.empty() ? '\0' : up[0]};
    reading.geometry = geometry;
    auto tracks = std::make_unique<Tracks>();
    std::optional<Error> failed;
    {
        const py::gil_scoped_release released;
        Result<Trajectories> result = read_trajectories(path, reading);
        if (result) {
            tracks->of = std::move(*result);
            tracks->table = track_table(tracks->of);
        } else {
            failed = result.error();
        }
    }
    if (failed) throw Refusal(failed->message);
    return tracks;
}

std::string told_row(size_t row) { return "Row " + std::to_string(row) + " of the frame "; }

// One row of a table, which must be such as files have.
Sighting sighting_at(size_t row, int64_t id, int64_t frame, double x, double y, double z) {
    constexpr double k_farthest = 1e6;  // metres
    constexpr int64_t k_most = 4'000'000'000;
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
        throw Refusal(told_row(row) + "has a place that is no number: leave such rows out, as by dropna().");
    if (std::max({std::abs(x), std::abs(y), std::abs(z)}) > k_farthest)
        throw Refusal(told_row(row) + "has a place farther than 1000 km from the origin: places are metres.");
    if (id < 0 || id > k_most || frame < 0 || frame > k_most)
        throw Refusal(told_row(row) +
                      "has an id or a frame below 0 or above 4e9; frames are counted from 0 on.");
    return {static_cast<uint32_t>(frame),
            static_cast<uint32_t>(id),
            {static_cast<float>(x), static_cast<float>(-y)},
            static_cast<float>(z),
            {}};
}

std::unique_ptr<Tracks> tracks_of(const Counts& ids, const Counts& frames, const Numbers& x, const Numbers& y,
                                  const std::optional<Numbers>& z, double fps, const std::string& wkt,
                                  const std::string& heights) {
    const auto count = static_cast<size_t>(ids.size());
    if (count == 0) throw Refusal("Nobody is in that frame.");
    if (count > k_most_sightings)
        throw Refusal("More than " + std::to_string(k_most_sightings) + " rows are too many.");
    if (!(fps > 0 && fps < 1e6)) throw Refusal("fps is how many frames there are to a second, above 0.");
    const auto kind = std::find(std::begin(k_heights), std::end(k_heights), heights);
    if (kind == std::end(k_heights)) throw Refusal("heights is 'nothing', 'ground' or 'heads'.");
    auto tracks = std::make_unique<Tracks>();
    Trajectories& to = tracks->of;
    to.format = "a frame";
    to.fps = static_cast<float>(fps);
    to.heights = z ? static_cast<HeightsOf>(kind - std::begin(k_heights)) : HeightsOf::nothing;
    to.sightings.reserve(count);
    for (size_t i = 0; i < count; ++i)
        to.sightings.push_back(
            sighting_at(i, ids.data()[i], frames.data()[i], x.data()[i], y.data()[i], z ? z->data()[i] : 0));
    std::sort(to.sightings.begin(), to.sightings.end(), [](const Sighting& a, const Sighting& b) {
        return a.frame != b.frame ? a.frame < b.frame : a.id < b.id;
    });
    const auto twice = std::adjacent_find(
        to.sightings.begin(), to.sightings.end(),
        [](const Sighting& a, const Sighting& b) { return a.frame == b.frame && a.id == b.id; });
    if (twice != to.sightings.end())
        throw Refusal("Person " + std::to_string(twice->id) + " is twice in frame " +
                      std::to_string(twice->frame) + ".");
    if (!wkt.empty()) {
        Result<std::vector<WalkablePolygon>> area = parse_wkt(wkt);
        if (!area) throw Refusal("The geometry " + area.error().message);
        to.area = std::move(*area);
    }
    tracks->table = track_table(to);
    return tracks;
}

py::dict columns_of(const Tracks& tracks) {
    const std::vector<Sighting>& rows = tracks.of.sightings;
    const double fps = wide(tracks.of.fps);
    py::dict to;
    to["id"] = column<int64_t>(rows, [](const Sighting& s) { return s.id; });
    to["frame"] = column<int64_t>(rows, [](const Sighting& s) { return s.frame; });
    to["time"] = column<double>(rows, [=](const Sighting& s) { return s.frame / fps; });
    to["x"] = column<double>(rows, [](const Sighting& s) { return s.at.x; });
    to["y"] = column<double>(rows, [](const Sighting& s) { return 0 - s.at.z; });
    to["z"] = column<double>(rows, [](const Sighting& s) { return s.height; });
    return to;
}

// Frame by frame into the open file; what fails is told.
Result<void> write_frames(const Tracks& tracks, TrajectoryFormat format, FILE* file,
                          const std::string& path) {
    Result<TrajectoryWriterPtr> writer = begin_trajectories(format, file, path, tracks.of.fps, tracks.of.area,
                                                            "flaneur " FLANEUR_VERSION, tracks.of.heights);
    if (!writer) return writer.error();
    for (size_t k = 0; k < tracks.table.frames.size(); ++k)
        if (!add_frame(**writer, tracks.table.frames[k], seen_in(tracks.table, k))) break;
    return finish_trajectories(std::move(*writer));
}

// Beside the file, which is there when it is whole.
void write(const Tracks& tracks, const std::string& path) {
    const std::optional<TrajectoryFormat> format = trajectory_format_of(path);
    if (!format)
        throw Refusal(path +
                      " must end in .csv, .sqlite, .txt, .xml, .json, .geojson or .traj, which tells its "
                      "format.");
    const std::string part = path + ".part";
    FILE* file = std::fopen(part.c_str(), "wb");
    if (!file) throw Refusal("Cannot write " + path + ".");
    Result<void> written;
    {
        const py::gil_scoped_release released;
        written = write_frames(tracks, *format, file, part);
        if (std::fclose(file) != 0 && written) written = Error{"the disk may be full."};
        if (written && std::rename(part.c_str(), path.c_str()) != 0)
            written = Error{"it cannot be put in its place."};
    }
    if (written) return;
    std::remove(part.c_str());
    throw Refusal("Cannot write " + path + ": " + written.error().message);
}

py::dict names_of(const Tracks& tracks) {
    py::dict names;
    for (const Tracked& t : tracks.of.tracked)
        if (!t.name.empty()) names[py::int_(t.id)] = t.name;
    return names;
}

}  // namespace

py::class_<Tracks> add_tracks(py::module_& module) {
    py::class_<Tracks> tracks(module, "Tracks");
    tracks.def_static("read", read)
        .def_static("of", tracks_of)
        .def("columns", columns_of)
        .def("write", write)
        .def_property_readonly("names", names_of)
        .def_property_readonly("vehicles", [](const Tracks& t) { return ids_of_vehicles(t.of); })
        .def_property_readonly("fps", [](const Tracks& t) { return t.of.fps; })
        .def_property_readonly("format", [](const Tracks& t) { return t.of.format; })
        .def_property_readonly("assumed", [](const Tracks& t) { return t.of.assumed; })
        .def_property_readonly("heights",
                               [](const Tracks& t) { return k_heights[static_cast<size_t>(t.of.heights)]; })
        .def_property_readonly("area",
                               [](const Tracks& t) { return t.of.area.empty() ? "" : wkt_of(t.of.area); });
    return tracks;
}

}  // namespace flaneur
