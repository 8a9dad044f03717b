// SQLite as JuPedSim writes it: tables metadata, geometry, frame_data and trajectory_data.
#include <sqlite3.h>

#include <cmath>
#include <cstdio>
#include <memory>

#include "assets/files/file.h"
#include "assets/files/words.h"
#include "assets/trajectories/formats.h"
#include "assets/trajectories/wkt.h"

namespace flaneur {
namespace {

struct CloseDatabase {
    void operator()(sqlite3* database) const { sqlite3_close_v2(database); }
};
struct EndStatement {
    void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using DatabasePtr = std::unique_ptr<sqlite3, CloseDatabase>;
using StatementPtr = std::unique_ptr<sqlite3_stmt, EndStatement>;

Error unread_database(sqlite3* database) {
    return Error{"cannot be read as SQLite of JuPedSim (" + excerpt(sqlite3_errmsg(database)) + ")"};
}

// A path as the URI that SQLite opens without looking for journals beside it.
std::string uri_of(const std::string& path) {
    std::string uri = "file:";
    for (const char c : path) {
        char text[4] = {c, 0, 0, 0};
        if (c == '%' || c == '?' || c == '#')
            std::snprintf(text, sizeof text, "%%%02x", static_cast<unsigned char>(c));
        uri += text;
    }
    return uri + "?immutable=1";
}

// Opened so that what a stranger's file has in its schema is never run.
Result<DatabasePtr> open_database(const std::string& path) {
    sqlite3* opened = nullptr;
    const int failed = sqlite3_open_v2(uri_of(path).c_str(), &opened,
                                       SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, nullptr);
    DatabasePtr database(opened);
    if (failed != SQLITE_OK) return unread_database(opened);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
    sqlite3_db_config(opened, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
    sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, 64 << 20);
    return database;
}

Result<StatementPtr> prepared(sqlite3* database, const char* query) {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database, query, -1, &statement, nullptr) != SQLITE_OK)
        return unread_database(database);
    return StatementPtr(statement);
}

std::string_view text_of(sqlite3_stmt* row, int column) {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(row, column));
    return text ? std::string_view(text, static_cast<size_t>(sqlite3_column_bytes(row, column))) : "";
}

// The first value that a query gives; empty: it gives none.
Result<std::string> first_of(sqlite3* database, const char* query) {
    Result<StatementPtr> statement = prepared(database, query);
    if (!statement) return statement.error();
    const int step = sqlite3_step(statement->get());
    if (step == SQLITE_ROW) return std::string(text_of(statement->get(), 0));
    return step == SQLITE_DONE ? Result<std::string>(std::string()) : unread_database(database);
}

// Whether all that is read is in plain tables: what a virtual one or computed columns do takes as long as
// they like.
Result<void> check_tables(sqlite3* database) {
    Result<std::string> odd = first_of(
        database,
        "SELECT name FROM sqlite_master WHERE name IN ('metadata', 'geometry', 'trajectory_data') AND "
        "(type <> 'table' OR sql NOT LIKE 'CREATE TABLE%' OR sql LIKE '% AS (%' OR sql LIKE '%GENERATED%')");
    if (!odd) return odd.error();
    if (!odd->empty()) return Error{"has " + excerpt(*odd) + ", which is no plain table"};
    return {};
}

}  // namespace

Result<FoundTracks> read_jupedsim(const TrajectorySource& source) {
    Result<DatabasePtr> database = open_database(source.path);
    if (!database) return database.error();
    if (Result<void> plain = check_tables(database->get()); !plain) return plain.error();

    FoundTracks found;
    found.format = "SQLite of JuPedSim";
    found.is_in_frames = true;
    found.unit = 1;
    Result<std::string> fps = first_of(database->get(), "SELECT value FROM metadata WHERE key = 'fps'");
    if (!fps) return fps.error();
    if (!parse_number(std::string_view(*fps), found.fps) || !(found.fps > 0))
        return Error{"has no number of frames a second in its metadata"};
    // Where doors open and close there are several; the first is told.
    Result<std::string> wkt = first_of(database->get(), "SELECT wkt FROM geometry ORDER BY rowid LIMIT 1");
    if (!wkt) return wkt.error();
    if (!wkt->empty()) {
        Result<std::vector<WalkablePolygon>> area = parse_wkt(*wkt);
        if (!area) return area.error();
        found.area = std::move(*area);
    }
    Result<StatementPtr> rows =
        prepared(database->get(), "SELECT frame, id, pos_x, pos_y, ori_x, ori_y FROM trajectory_data");
    if (!rows) return rows.error();
    int step = SQLITE_ROW;
    while ((step = sqlite3_step(rows->get())) == SQLITE_ROW) {
        sqlite3_stmt* row = rows->get();
        for (int column = 0; column < 4; ++column) {
            const int type = sqlite3_column_type(row, column);
            if (type != SQLITE_INTEGER && (type != SQLITE_FLOAT || column < 2))
                return Error{"has a position that is no number"};
        }
        const double x = sqlite3_column_double(row, 4), y = sqlite3_column_double(row, 5);
        const bool has_facing = std::fabs(x) <= 2 && std::fabs(y) <= 2;
        const Vec2 facing{static_cast<float>(x), 0 - static_cast<float>(y)};
        Result<void> added = add_row(found, {.time = static_cast<double>(sqlite3_column_int64(row, 0)),
                                             .x = sqlite3_column_double(row, 2),
                                             .y = sqlite3_column_double(row, 3),
                                             .who = who_is(found, int64_t{sqlite3_column_int64(row, 1)}),
                                             .facing = has_facing ? normalize_or(facing, {0, 0}) : Vec2{}});
        if (!added) return Error{"has " + added.error().message};
    }
    if (step != SQLITE_DONE) return unread_database(database->get());
    return found;
}

}  // namespace flaneur
