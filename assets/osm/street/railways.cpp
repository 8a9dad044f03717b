// Railways: tracks on their ballast, rails in streets, platforms.
#include <algorithm>
#include <cmath>
#include <queue>

#include "assets/colour.h"
#include "assets/osm/decks.h"
#include "assets/osm/map.h"
#include "assets/plan/masses.h"
#include "assets/plan/rails.h"
#include "assets/plan/roofs.h"
#include "assets/plan/streets.h"

namespace flaneur {

namespace {

bool is_yes(const OsmTags& tags, std::string_view key) { return tags.has(key) && !tags.is(key, "no"); }

bool is_tram(const OsmTags& tags) { return tags.is("railway", "tram"); }

// Trams take what is left over between streets, trains their own bed.
void add_track(GroundPlan& plan, const std::vector<Vec2>& line, float half, uint8_t rank) {
    Area sleepers;
    sleepers.rank = rank;
    sleepers.kind = Surface::track;
    sleepers.lift = flat(k_track);
    Area ballast = sleepers;
    ballast.axis = {};
    add_strip(ballast.rings, line, half, half, false);
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        sleepers.axis = normalize_or(line[i + 1] - line[i], {1, 0});
        sleepers.rings.clear();
        add_strip(sleepers.rings, {line[i], line[i + 1]}, k_sleeper * 0.5f, k_sleeper * 0.5f, false);
        plan.areas.push_back(sleepers);
    }
    plan.areas.push_back(std::move(ballast));
}

// Tracks climb to their bridges over so many metres of the ways before them, for each level.
constexpr float k_climb = 60;

// A track, apart where it leaves the ground.
struct CutTrack {
    std::vector<std::vector<Vec2>> ground, raised;
};

// How many metres of climb are left at each place of the tracks: bridges have them all, what leads up to them
// less and less. Ways on the ground that cross a track, or share a bed with it, keep it there. Trams climb
// with their street.
struct Climbs {
    std::vector<Point> places;  // sorted
    std::vector<float> left;

    float& at(Vec2 p) {
        auto place = std::lower_bound(places.begin(), places.end(), to_point(p), point_less);
        return left[static_cast<size_t>(place - places.begin())];
    }
};

bool is_cut(const OsmStreet& track) { return track.highway.level == 0 && !is_tram(track.way->tags); }

Climbs find_climbs(const OsmImport& in, const std::vector<OsmStreet>& tracks) {
    Climbs climbs;
    for (const OsmStreet& track : tracks)
        for (const std::vector<Vec2>& line : track.lines)
            for (Vec2 p : line) climbs.places.push_back(to_point(p));
    std::sort(climbs.places.begin(), climbs.places.end(), point_less);
    climbs.places.erase(std::unique(climbs.places.begin(), climbs.places.end()), climbs.places.end());
    climbs.left.assign(climbs.places.size(), 0);
    std::vector<uint8_t> is_held(climbs.places.size());
    for (const LinePiece& s : in.streets.segments) {
        for (Vec2 p : {s.a, s.b}) {
            auto place =
                std::lower_bound(climbs.places.begin(), climbs.places.end(), to_point(p), point_less);
            if (place != climbs.places.end() && *place == to_point(p))
                is_held[static_cast<size_t>(place - climbs.places.begin())] = 1;
        }
    }
    auto index_of = [&](Vec2 p) { return static_cast<uint32_t>(&climbs.at(p) - climbs.left.data()); };
    std::priority_queue<std::pair<float, uint32_t>> queue;  // the most left first
    auto reach = [&](uint32_t place, float left) {
        if (is_held[place] || left <= climbs.left[place]) return;
        climbs.left[place] = left;
        queue.push({left, place});
    };
    std::vector<std::pair<uint32_t, std::pair<uint32_t, float>>> links;  // from, to and how far
    for (const OsmStreet& track : tracks) {
        for (const std::vector<Vec2>& line : track.lines) {
            for (Vec2 p : line)
                if (track.highway.level > 0)
                    reach(index_of(p), k_climb * static_cast<float>(track.highway.level));
            for (size_t i = 0; is_cut(track) && i + 1 < line.size(); ++i) {
                uint32_t a = index_of(line[i]), b = index_of(line[i + 1]);
                float whole = length(line[i + 1] - line[i]);
                links.push_back({a, {b, whole}});
                links.push_back({b, {a, whole}});
            }
        }
    }
    std::sort(links.begin(), links.end());
    while (!queue.empty()) {
        auto [left, place] = queue.top();
        queue.pop();
        if (left < climbs.left[place]) continue;
        auto link = std::lower_bound(links.begin(), links.end(), place,
                                     [](const auto& l, uint32_t from) { return l.first < from; });
        for (; link != links.end() && link->first == place; ++link)
            reach(link->second.first, left - link->second.second);
    }
    return climbs;
}

// Which parts of a track leave the ground.
CutTrack cut_track(const OsmStreet& track, Climbs& climbs) {
    CutTrack cut;
    if (track.highway.level > 0) cut.raised = track.lines;
    if (is_tram(track.way->tags) && track.highway.level == 0) cut.ground = track.lines;
    if (!is_cut(track)) return cut;
    for (const std::vector<Vec2>& line : track.lines) {
        std::vector<std::vector<Vec2>>* last = nullptr;
        auto add = [&](std::vector<std::vector<Vec2>>& parts, Vec2 a, Vec2 b) {
            if (last != &parts) parts.push_back({a});
            parts.back().push_back(b);
            last = &parts;
        };
        for (size_t i = 0; i + 1 < line.size(); ++i) {
            constexpr float k_least = 1;  // metres of ground between two climbs
            Vec2 a = line[i], b = line[i + 1];
            float up = climbs.at(a), down = climbs.at(b), whole = length(b - a);
            if (up + down > whole - k_least && up + down > 0) {
                add(cut.raised, a, b);
                continue;
            }
            Vec2 foot = lerp(a, b, up / whole), other = lerp(a, b, 1 - down / whole);
            if (up > 0) add(cut.raised, a, foot);
            add(cut.ground, up > 0 ? foot : a, down > 0 ? other : b);
            if (down > 0) add(cut.raised, other, b);
        }
    }
    return cut;
}

}  // namespace

std::optional<OsmHighway> track_of(const OsmTags& tags) {
    std::string_view railway = tags["railway"];
    if (!is_tram(tags) && railway != "rail" && railway != "light_rail" && railway != "subway" &&
        railway != "narrow_gauge" && railway != "funicular" && railway != "preserved")
        return std::nullopt;
    std::optional<float> storey = parse_number(tags["level"]);
    if (is_hidden(tags) || is_yes(tags, "tunnel") || (storey && *storey < 0)) return std::nullopt;
    OsmHighway track;
    track.width = is_tram(tags) ? 3.2f : 5;
    track.kind = Surface::track;
    track.level = level_of(tags);
    return track;
}

std::optional<float> platform_of(const OsmTags& tags) {
    bool is_for_trams = is_yes(tags, "tram") && !is_yes(tags, "train");
    bool is_platform =
        tags.is("railway", "platform") ||
        (tags.is("public_transport", "platform") &&
         (is_for_trams || is_yes(tags, "train") || is_yes(tags, "light_rail") || is_yes(tags, "subway")));
    std::optional<float> storey = parse_number(tags["level"]);
    if (!is_platform || is_hidden(tags) || is_yes(tags, "tunnel") || (storey && *storey < 0))
        return std::nullopt;
    return is_for_trams ? 2 * k_kerb : 3 * k_kerb;
}

void add_osm_railways(OsmImport& in) {
    constexpr float k_platform_width = 3.2f;
    std::vector<OsmStreet> tracks;
    for (const OsmWay& way : in.map.ways) {
        if (std::optional<OsmHighway> track = track_of(way.tags)) {
            OsmStreet street{&way, *track, lines_of(in, way)};
            if (street.lines.empty()) continue;
            count_built(in.counts, OsmSort::track);
            tracks.push_back(std::move(street));
        }
        std::optional<float> height = platform_of(way.tags);
        if (!height || way.closed()) continue;
        OsmHighway platform{clamp(parse_metres(way.tags["width"]).value_or(k_platform_width), 1.5f, 20), 0,
                            false, Surface::plaza, level_of(way.tags)};
        OsmStreet street{&way, platform, lines_of(in, way)};
        if (street.lines.empty()) continue;
        count_built(in.counts, OsmSort::platform);
        if (platform.level > 0) {
            in.raised.push_back(std::move(street));
            continue;
        }
        Area area;
        area.rank = k_rank_platform;
        area.kind = Surface::plaza;
        area.lift = flat(*height);
        for (const std::vector<Vec2>& line : street.lines)
            add_strip(area.rings, line, platform.width * 0.5f, platform.width * 0.5f, false);
        in.plan.areas.push_back(std::move(area));
    }
    Climbs climbs = find_climbs(in, tracks);
    for (OsmStreet& track : tracks) {
        CutTrack cut = cut_track(track, climbs);
        for (const std::vector<Vec2>& line : cut.ground) {
            add_track(in.plan, line, track.highway.width * 0.5f,
                      is_tram(track.way->tags) ? k_rank_tram : k_rank_track);
            in.tracks.add(line, static_cast<uint32_t>(track.way - in.map.ways.data()),
                          track.highway.width * 0.5f);
        }
        if (cut.raised.empty()) continue;
        track.lines = std::move(cut.raised);
        in.raised.push_back(std::move(track));
    }
    in.tracks.sort();
}

void lay_osm_rails(OsmImport& in, const std::vector<DeckPiece>& decks) {
    constexpr float k_piece = 2, k_flat_piece = 60;  // on terrain and without, metres
    Rails rails{in.city};
    auto lay = [&](Vec3 a, Vec3 b) { lay_rails(rails, a, b); };
    for (const LinePiece& s : in.tracks.segments) {
        float piece = in.plan.terrain ? k_piece : k_flat_piece;
        int parts = std::max(1, static_cast<int>(std::ceil(length(s.b - s.a) / piece)));
        auto at = [&](int i) {
            Vec2 p = lerp(s.a, s.b, static_cast<float>(i) / static_cast<float>(parts));
            return at_height(p, terrain_at(in.plan, p) + k_track);
        };
        for (int i = 0; i < parts; ++i) lay(at(i), at(i + 1));
    }
    for (const DeckPiece& piece : decks) {
        if (in.raised[piece.street].highway.kind == Surface::track)
            lay(at_height(piece.a, piece.a_height + k_kerb), at_height(piece.b, piece.b_height + k_kerb));
    }
}

}  // namespace flaneur
