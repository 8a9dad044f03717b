// The table of formats: how a file begins, and who reads it.
#include <zlib.h>

#include <algorithm>
#include <filesystem>

#include "assets/files/file.h"
#include "assets/trajectories/formats.h"
#include "assets/trajectories/geometry.h"

namespace flaneur {
namespace {

constexpr size_t k_most_track_bytes = size_t{1} << 30;
constexpr size_t k_head_bytes = 16'384;  // bytes that tell a format

bool head_has(std::string_view head, std::string_view what) {
    return head.find(what) != std::string_view::npos;
}
bool looks_like_xml(std::string_view head) {
    const size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first != std::string_view::npos && head[first] == '<';
}
bool looks_like_json(std::string_view head) {
    const size_t first = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    return first != std::string_view::npos && head[first] == '{';
}

Result<FoundTracks> refuse_xml(const TrajectorySource&) {
    return Error{"is XML of another kind: of XML, <fcd-export> of SUMO and <gpx> are read"};
}

struct TrackFormat {
    bool (*looks)(std::string_view head);
    Result<FoundTracks> (*read)(const TrajectorySource&);
};
// The first that looks so.
constexpr TrackFormat k_track_formats[] = {
    {[](std::string_view h) { return h.starts_with("\x89HDF"); }, parse_juelich},
    {[](std::string_view h) { return h.starts_with("SQLite format 3"); }, read_jupedsim},
    {[](std::string_view h) { return looks_like_xml(h) && head_has(h, "<fcd-export"); }, parse_sumo_fcd},
    {[](std::string_view h) { return looks_like_xml(h) && head_has(h, "<gpx"); }, parse_gpx},
    {looks_like_xml, refuse_xml},
    {looks_like_json, parse_features},
    {[](std::string_view h) { return head_has(h.substr(0, 200), "number of splines"); }, parse_splines},
    {[](std::string_view) { return true; }, parse_table},
};

// What gzip head_has packed; the same where it head_has not.
Result<std::string> unpacked(const Bytes& bytes) {
    std::string text;
    if (bytes.size() < 2 || bytes[0] != 0x1f || bytes[1] != 0x8b)
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    z_stream stream{};
    if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return Error{"cannot be unpacked"};
    stream.next_in = const_cast<Bytef*>(bytes.data());
    stream.avail_in = static_cast<uInt>(bytes.size());
    int state = Z_OK;
    while (state == Z_OK && text.size() < k_most_track_bytes) {
        const size_t before = text.size();
        text.resize(std::min(k_most_track_bytes, before + std::max<size_t>(before, 65'536)));
        stream.next_out = reinterpret_cast<Bytef*>(text.data() + before);
        stream.avail_out = static_cast<uInt>(text.size() - before);
        state = inflate(&stream, Z_NO_FLUSH);
        text.resize(text.size() - stream.avail_out);
    }
    inflateEnd(&stream);
    if (state == Z_STREAM_END) return text;
    if (text.size() >= k_most_track_bytes) return Error{"head_has more than a gigabyte packed in it"};
    return Error{"is packed by gzip and cut short, or broken"};
}

std::string_view text_of_bytes(const Bytes& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Result<FoundTracks> find_rows(const std::string& path) {
    Result<Bytes> bytes = read_bytes(path, k_most_track_bytes);
    if (!bytes) return bytes.error();
    std::string text;
    if (bytes->size() > 1 && (*bytes)[0] == 0x1f && (*bytes)[1] == 0x8b) {
        Result<std::string> inside = unpacked(*bytes);
        if (!inside) return inside.error();
        text = std::move(*inside);
        if (text.starts_with("SQLite")) return Error{"is a packed database: unpack it first"};
        bytes->clear();
        bytes->shrink_to_fit();
    }
    const TrajectorySource source{path, text.empty() ? text_of_bytes(*bytes) : std::string_view(text)};
    const std::string_view head = source.text.substr(0, k_head_bytes);
    for (const TrackFormat& format : k_track_formats)
        if (format.looks(head)) return format.read(source);
    return Error{"is of no format that is known"};
}

Result<WalkableGeometry> read_geometry(const std::string& path) {
    const Result<Bytes> bytes = read_bytes(path, k_most_track_bytes);
    if (!bytes) return bytes.error();
    const Result<std::string> text = unpacked(*bytes);
    if (!text) return text.error();
    return parse_geometry(*text);
}

// Ground from the file that is asked for, or one beside.
Result<void> add_geometry(FoundTracks& found, const std::string& path, const std::string& asked) {
    std::string file = asked;
    if (file.empty() && found.area.empty())
        file = geometry_beside(path, found.geometry_ending, found.geometry);
    if (file.empty()) {
        if (!found.geometry.empty() && found.area.empty())
            found.assumed.push_back("Its geometry is " + excerpt(found.geometry) +
                                    ", which is not beside it.");
        return {};
    }
    const std::string name = std::filesystem::path(file).filename().string();
    Result<WalkableGeometry> geometry = read_geometry(file);
    if (!geometry) {
        if (!asked.empty())
            return Error{"head_has a geometry, " + file + ", which " + geometry.error().message};
        found.assumed.push_back("The geometry beside it, " + name + ", is left out: it " +
                                geometry.error().message + ".");
        return {};
    }
    found.area = std::move(geometry->area);
    found.walls = std::move(geometry->walls);
    if (asked.empty())
        found.assumed.push_back("Where people can be is told by " + name + ", which lies beside it.");
    for (std::string& sentence : geometry->assumed) found.assumed.push_back(std::move(sentence));
    if (found.is_in_frames && found.fps <= 0 && geometry->seconds_a_step > 0)
        found.fps = 1 / geometry->seconds_a_step;
    return {};
}

}  // namespace

const Tracked* tracked_of(const Trajectories& tracks, uint32_t id) {
    const auto found = std::ranges::lower_bound(tracks.tracked, id, {}, &Tracked::id);
    return found != tracks.tracked.end() && found->id == id ? &*found : nullptr;
}

std::vector<uint32_t> ids_of_vehicles(const Trajectories& tracks) {
    std::vector<uint32_t> ids;
    for (const Tracked& t : tracks.tracked)
        if (t.kind != TrackedKind::person) ids.push_back(t.id);
    return ids;
}

Result<Trajectories> read_trajectories(const std::string& path, const TrajectoryReading& reading) {
    if (Result<void> is_there = find_file(path); !is_there)
        return Error{"Nobody's ways are read: " + is_there.error().message};
    Result<FoundTracks> found = find_rows(path);
    Result<void> grounded = found ? add_geometry(*found, path, reading.geometry) : found.error();
    Result<Trajectories> read = grounded ? settle_trajectories(std::move(*found), reading) : grounded.error();
    if (read) return read;
    std::string why = read.error().message;
    if (why.ends_with('.')) why.pop_back();
    return Error{"Nobody's ways are read, for " + path + " " + why + "."};
}

}  // namespace flaneur
