#include "assets/trajectories/write.h"

#include <sqlite3.h>

#include <algorithm>
#include <map>
#include <vector>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/wkt.h"
#include "sim/base/hash.h"
#include "sim/base/math.h"

namespace flaneur {

struct TrajectoryWriter {
    TrajectoryFormat format{};
    FILE* file = nullptr;
    double fps = 25;
    bool fails = false;
    // By id: what features are written of, and of steps the last one alone.
    std::map<uint32_t, std::vector<Sighting>> paths;
    // SQLite's
    sqlite3* database = nullptr;
    sqlite3_stmt* add_person = nullptr;
    sqlite3_stmt* add_number = nullptr;
    int64_t geometry = 0;
};

void TrajectoryWriterDelete::operator()(TrajectoryWriter* writer) const {
    sqlite3_finalize(writer->add_person);
    sqlite3_finalize(writer->add_number);
    sqlite3_close_v2(writer->database);
    delete writer;
}

namespace {

// North of a z that counts to the south; never -0.
double north(float z) { return 0.0 - wide(z); }

// Nothing is beside the file while it is written: what is not finished is thrown away with it.
constexpr const char* k_tables =
    "PRAGMA journal_mode=OFF; PRAGMA synchronous=OFF; PRAGMA locking_mode=EXCLUSIVE; BEGIN;"
    "CREATE TABLE trajectory_data (frame INTEGER NOT NULL, id INTEGER NOT NULL, pos_x REAL NOT NULL, "
    "pos_y REAL NOT NULL, ori_x REAL NOT NULL, ori_y REAL NOT NULL);"
    "CREATE TABLE metadata(key TEXT NOT NULL UNIQUE PRIMARY KEY, value TEXT NOT NULL);"
    "CREATE TABLE geometry(hash INTEGER NOT NULL, wkt TEXT NOT NULL);"
    "CREATE UNIQUE INDEX geometry_hash on geometry(hash);"
    "CREATE TABLE frame_data(frame INTEGER NOT NULL, geometry_hash INTEGER NOT NULL);";

bool run_sql(TrajectoryWriter& writer, const char* text) {
    return sqlite3_exec(writer.database, text, nullptr, nullptr, nullptr) == SQLITE_OK;
}

// A statement with texts and one number in its places.
bool insert(TrajectoryWriter& writer, const char* statement, const std::string& a, const std::string& b) {
    sqlite3_stmt* prepared = nullptr;
    bool done =
        sqlite3_prepare_v2(writer.database, statement, -1, &prepared, nullptr) == SQLITE_OK &&
        sqlite3_bind_text(prepared, 1, a.data(), static_cast<int>(a.size()), SQLITE_STATIC) == SQLITE_OK &&
        sqlite3_bind_text(prepared, 2, b.data(), static_cast<int>(b.size()), SQLITE_STATIC) == SQLITE_OK &&
        sqlite3_step(prepared) == SQLITE_DONE;
    sqlite3_finalize(prepared);
    return done;
}

struct Bounds {
    Vec2 low{0, 0}, high{0, 0};
};

Bounds bounds_of(const std::vector<WalkablePolygon>& area) {
    Bounds bounds;
    if (!area.empty()) bounds = {area[0].outer[0], area[0].outer[0]};
    for (const WalkablePolygon& polygon : area)
        for (const Vec2 p : polygon.outer) {
            bounds.low = {std::min(bounds.low.x, p.x), std::min(bounds.low.z, p.z)};
            bounds.high = {std::max(bounds.high.x, p.x), std::max(bounds.high.z, p.z)};
        }
    return bounds;
}

bool begin_database(TrajectoryWriter& writer, const std::string& path,
                    const std::vector<WalkablePolygon>& area, const std::string& about) {
    if (sqlite3_open_v2(path.c_str(), &writer.database, SQLITE_OPEN_READWRITE, nullptr) != SQLITE_OK ||
        !run_sql(writer, k_tables))
        return false;
    const std::string wkt = wkt_of(area);
    writer.geometry = static_cast<int64_t>(sum_bytes(k_no_bytes, wkt));
    const Bounds bounds = bounds_of(area);
    constexpr const char* k_fact = "INSERT INTO metadata VALUES(?, ?)";
    const std::pair<const char*, std::string> facts[] = {
        {"version", "2"},
        {"fps", plainly(writer.fps)},
        {"xmin", plainly(wide(bounds.low.x))},
        {"xmax", plainly(wide(bounds.high.x))},
        {"ymin", plainly(north(bounds.high.z))},
        {"ymax", plainly(north(bounds.low.z))},
        {"about", about},
    };
    for (const auto& [key, value] : facts)
        if (!insert(writer, k_fact, key, value)) return false;
    return insert(writer, "INSERT INTO geometry VALUES(CAST(? AS INTEGER), ?)",
                  std::to_string(writer.geometry), wkt) &&
           sqlite3_prepare_v3(writer.database, "INSERT INTO trajectory_data VALUES(?, ?, ?, ?, ?, ?)", -1,
                              SQLITE_PREPARE_PERSISTENT, &writer.add_person, nullptr) == SQLITE_OK &&
           sqlite3_prepare_v3(writer.database, "INSERT INTO frame_data VALUES(?, ?)", -1,
                              SQLITE_PREPARE_PERSISTENT, &writer.add_number, nullptr) == SQLITE_OK;
}

bool step(sqlite3_stmt* statement) {
    const bool done = sqlite3_step(statement) == SQLITE_DONE;
    return sqlite3_reset(statement) == SQLITE_OK && done;
}

// To a ten thousandth of a metre, as the texts have it: so all formats say the same.
double rounded(double value) {
    return static_cast<double>(static_cast<int64_t>(value * 1e4 + (value < 0 ? -0.5 : 0.5))) / 1e4;
}

bool add_to_database(TrajectoryWriter& writer, uint32_t frame, std::span<const Sighting> people) {
    sqlite3_bind_int64(writer.add_number, 1, frame);
    sqlite3_bind_int64(writer.add_number, 2, writer.geometry);
    if (!step(writer.add_number)) return false;
    return std::all_of(people.begin(), people.end(), [&](const Sighting& s) {
        sqlite3_bind_int64(writer.add_person, 1, frame);
        sqlite3_bind_int64(writer.add_person, 2, s.id);
        sqlite3_bind_double(writer.add_person, 3, rounded(wide(s.at.x)));
        sqlite3_bind_double(writer.add_person, 4, rounded(north(s.at.z)));
        sqlite3_bind_double(writer.add_person, 5, rounded(wide(s.facing.x)));
        sqlite3_bind_double(writer.add_person, 6, rounded(north(s.facing.z)));
        return step(writer.add_person);
    });
}

constexpr const char* k_fcd_head =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<fcd-export xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
    "xsi:noNamespaceSchemaLocation=\"http://sumo.dlr.de/xsd/fcd_file.xsd\">\n";
constexpr const char* k_steps_head =
    "#IDXCOL=2,DATACOL=5,SEP=' '\n"
    "pedestrianId simTime endTime-PID1 startX-PID1 startY-PID1 endX-PID1 endY-PID1\n";
constexpr const char* k_features_head =
    "{\"type\": \"FeatureCollection\",\n"
    " \"crs\": {\"type\": \"Name\", \"properties\": {\"name\": \"metres to the east, to the north and "
    "up\"}},\n"
    " \"features\": [";

// Degrees clockwise from north, 0 .. 360.
double compass(Vec2 facing) {
    const double degrees = wide(arctan2(facing.x, 0 - facing.z)) * 180 / wide(k_pi);
    return degrees < 0 ? degrees + 360 : degrees;
}

void add_to_fcd(TrajectoryWriter& writer, double seconds, std::span<const Sighting> people) {
    std::fprintf(writer.file, "    <timestep time=\"%.4f\">\n", seconds);
    for (const Sighting& s : people) {
        std::fprintf(writer.file, "        <person id=\"%u\" x=\"%.4f\" y=\"%.4f\" z=\"%.4f\"", s.id,
                     rounded(wide(s.at.x)), rounded(north(s.at.z)), rounded(wide(s.height)));
        if (s.facing != Vec2{}) std::fprintf(writer.file, " angle=\"%.3f\"", compass(s.facing));
        std::fputs("/>\n", writer.file);
    }
    std::fputs("    </timestep>\n", writer.file);
}

// From where somebody was in the frame before; who is new takes a step on the spot.
void add_to_steps(TrajectoryWriter& writer, uint32_t frame, std::span<const Sighting> people) {
    for (const Sighting& s : people) {
        std::vector<Sighting>& last = writer.paths[s.id];
        const Sighting from = !last.empty() && last[0].frame + 1 == frame ? last[0] : s;
        std::fprintf(writer.file, "%u %.4f %.4f %.4f %.4f %.4f %.4f\n", s.id, from.frame / writer.fps,
                     frame / writer.fps, rounded(wide(from.at.x)), rounded(north(from.at.z)),
                     rounded(wide(s.at.x)), rounded(north(s.at.z)));
        last.assign(1, s);
        last[0].frame = frame;
    }
}

void write_features(const TrajectoryWriter& writer) {
    const char* between = "\n";
    for (const auto& [id, path] : writer.paths) {
        std::fprintf(writer.file,
                     "%s  {\"type\": \"Feature\", \"id\": %u, \"properties\": {},\n"
                     "   \"temporalGeometry\": {\"type\": \"MovingPoint\", \"datetimes\": [",
                     between, id);
        for (const Sighting& s : path)
            std::fprintf(writer.file, "%s%.3f", &s == path.data() ? "" : ", ", s.frame * 1000 / writer.fps);
        std::fputs("],\n    \"coordinates\": [", writer.file);
        for (const Sighting& s : path)
            std::fprintf(writer.file, "%s[%.4f, %.4f, %.4f]", &s == path.data() ? "" : ", ",
                         rounded(wide(s.at.x)), rounded(north(s.at.z)), rounded(wide(s.height)));
        std::fputs("]}}", writer.file);
        between = ",\n";
    }
    std::fputs("\n]}\n", writer.file);
}

}  // namespace

std::optional<TrajectoryFormat> trajectory_format_of(std::string_view path) {
    if (has_ending(path, ".csv")) return TrajectoryFormat::csv;
    if (has_ending(path, ".sqlite")) return TrajectoryFormat::sqlite;
    if (has_ending(path, ".txt")) return TrajectoryFormat::text;
    if (has_ending(path, ".xml")) return TrajectoryFormat::fcd;
    if (has_ending(path, ".json") || has_ending(path, ".geojson")) return TrajectoryFormat::features;
    if (has_ending(path, ".traj")) return TrajectoryFormat::steps;
    return std::nullopt;
}

Result<TrajectoryWriterPtr> begin_trajectories(TrajectoryFormat format, FILE* file, const std::string& path,
                                               float fps, const std::vector<WalkablePolygon>& area,
                                               const std::string& about, HeightsOf heights) {
    TrajectoryWriterPtr writer(new TrajectoryWriter);
    writer->format = format;
    writer->file = file;
    writer->fps = wide(fps);
    switch (format) {
        case TrajectoryFormat::csv:
            std::fputs("frame,time_s,id,x_m,y_m,z_m,facing_x,facing_y\n", file);
            break;
        case TrajectoryFormat::text:
            std::fprintf(file, "# %s\n# framerate: %s fps\n# z: height of the %s\n# id frame x/m y/m z/m\n",
                         about.c_str(), plainly(fps).c_str(),
                         heights == HeightsOf::heads ? "head" : "ground under the person");
            break;
        case TrajectoryFormat::fcd:
            std::fputs(k_fcd_head, file);
            break;
        case TrajectoryFormat::features:
            std::fputs(k_features_head, file);
            break;
        case TrajectoryFormat::steps:
            std::fputs(k_steps_head, file);
            break;
        case TrajectoryFormat::sqlite:
            if (!begin_database(*writer, path, area, about))
                return Error{std::string("SQLite cannot write there: ") + sqlite3_errmsg(writer->database) +
                             "."};
    }
    return writer;
}

bool add_frame(TrajectoryWriter& writer, uint32_t frame, std::span<const Sighting> people) {
    if (writer.format == TrajectoryFormat::sqlite) {
        writer.fails = writer.fails || !add_to_database(writer, frame, people);
        return !writer.fails;
    }
    const double seconds = frame / writer.fps;
    if (writer.format == TrajectoryFormat::fcd) add_to_fcd(writer, seconds, people);
    if (writer.format == TrajectoryFormat::steps) add_to_steps(writer, frame, people);
    if (writer.format == TrajectoryFormat::features)
        for (const Sighting& s : people) {
            writer.paths[s.id].push_back(s);
            writer.paths[s.id].back().frame = frame;
        }
    if (writer.format != TrajectoryFormat::text && writer.format != TrajectoryFormat::csv)
        return std::ferror(writer.file) == 0;
    for (const Sighting& s : people) {
        const double x = rounded(wide(s.at.x)), y = rounded(north(s.at.z)), z = rounded(wide(s.height));
        if (writer.format == TrajectoryFormat::text)
            std::fprintf(writer.file, "%u %u %.4f %.4f %.4f\n", s.id, frame, x, y, z);
        else
            std::fprintf(writer.file, "%u,%.4f,%u,%.4f,%.4f,%.4f,%.4f,%.4f\n", frame, seconds, s.id, x, y, z,
                         rounded(wide(s.facing.x)), rounded(north(s.facing.z)));
    }
    return std::ferror(writer.file) == 0;
}

Result<void> finish_trajectories(TrajectoryWriterPtr writer) {
    if (writer->format == TrajectoryFormat::fcd) std::fputs("</fcd-export>\n", writer->file);
    if (writer->format == TrajectoryFormat::features) write_features(*writer);
    if (writer->format != TrajectoryFormat::sqlite) return {};
    if (writer->fails ||
        !run_sql(*writer, "CREATE INDEX frame_id_idx ON trajectory_data(frame, id); COMMIT;"))
        return Error{std::string("SQLite cannot write there: ") + sqlite3_errmsg(writer->database) + "."};
    return {};
}

}  // namespace flaneur
