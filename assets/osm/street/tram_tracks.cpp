// Tracks of trams as roads: what goes on without a switch is one, in the direction that is driven.
#include <algorithm>
#include <cmath>

#include "assets/osm/street/laying.h"

namespace flaneur {

namespace {

constexpr float k_width = 2.65f, k_speed = 50 / 3.6f;  // metres; m/s where tags say none
constexpr float k_nearest = 2, k_farthest = 6;         // metres between two that lie side by side
constexpr float k_parallel = 0.94f, k_look = 5;        // cosine; metres between looks
constexpr float k_stated = 1000;                       // metres of what lies beside that tags outweigh

struct Tracks {
    Laying laying;
    std::vector<float> says;  // by road: 1 where tags say that it is driven as drawn, -1 where the other way
};

bool is_stop(const OsmTags& tags) {
    return tags.is("railway", "tram_stop") ||
           (tags.is("public_transport", "stop_position") && tags.is("tram", "yes"));
}

// How many metres of a road say that it is driven as it was drawn, by the side that the other track is on.
float says_beside(const std::vector<Road>& roads, size_t number, bool drives_left) {
    const std::vector<Vec2>& line = roads[number].line;
    float says = 0;
    for (size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2 way = normalize_or(line[i + 1] - line[i], {1, 0}), to_left{way.z, -way.x};
        const float whole = length(line[i + 1] - line[i]);
        for (float at = k_look / 2; at < whole; at += k_look) {
            const Vec2 here = line[i] + way * at;
            float nearest = k_farthest, side = 0;
            for (size_t other = 0; other < roads.size(); ++other) {
                const std::vector<Vec2>& l = roads[other].line;
                for (size_t k = 0; other != number && k + 1 < l.size(); ++k) {
                    const Vec2 along = normalize_or(l[k + 1] - l[k], {1, 0});
                    const Vec2 off = lerp(l[k], l[k + 1], closest_on(l[k], l[k + 1], here)) - here;
                    const float far = length(off), aside = dot(off, to_left);
                    if (std::fabs(aside) < k_nearest || far > nearest ||
                        std::fabs(dot(along, way)) < k_parallel)
                        continue;
                    nearest = far, side = aside > 0 ? 1.0f : -1.0f;
                }
            }
            says += drives_left ? -side * k_look : side * k_look;
        }
    }
    return says;
}

Road turned(Road road) {
    std::reverse(road.line.begin(), road.line.end());
    std::swap(road.from, road.to);
    return road;
}

// Joins roads through nodes where no other begins, and turns each into the direction that most of it says.
std::vector<Road> joined(const Tracks& tracks, bool drives_left) {
    const std::vector<Road>& roads = tracks.laying.plan.roads;
    std::vector<std::vector<uint32_t>> at(tracks.laying.plan.nodes.size());
    for (uint32_t r = 0; r < roads.size(); ++r) at[roads[r].from].push_back(r), at[roads[r].to].push_back(r);
    std::vector<uint8_t> is_used(roads.size(), 0);
    std::vector<Road> all;
    auto says = [&](uint32_t r) {
        return tracks.says[r] != 0 ? k_stated * tracks.says[r] : says_beside(roads, r, drives_left);
    };
    auto follow = [&](uint32_t first, uint32_t node) {
        Road chain = roads[first].from == node ? roads[first] : turned(roads[first]);
        float sum = roads[first].from == node ? says(first) : -says(first);
        is_used[first] = 1;
        while (at[chain.to].size() == 2) {
            const uint32_t next = is_used[at[chain.to][0]] ? at[chain.to][1] : at[chain.to][0];
            if (is_used[next]) break;
            is_used[next] = 1;
            const bool is_along = roads[next].from == chain.to;
            const Road more = is_along ? roads[next] : turned(roads[next]);
            sum += is_along ? says(next) : -says(next);
            chain.line.insert(chain.line.end(), more.line.begin() + 1, more.line.end());
            chain.to = more.to;
            chain.speed = std::min(chain.speed, more.speed);
        }
        if (chain.from != chain.to) all.push_back(sum < 0 ? turned(std::move(chain)) : std::move(chain));
    };
    for (uint32_t n = 0; n < at.size(); ++n)
        for (const uint32_t r : at[n])
            if (at[n].size() != 2 && !is_used[r]) follow(r, n);
    return all;
}

}  // namespace

void add_tram_tracks(Laying& l) {
    Tracks tracks{{l.in, l.low, l.high, {}, {}, {}}, {}};
    Laying& laying = tracks.laying;
    auto each = [&](auto visit) {
        for (const OsmWay& way : l.in.map.ways)
            if (way.tags.is("railway", "tram") && !way.nodes.empty())
                if (const auto track = track_of(way.tags); track && track->level == 0) visit(way);
    };
    each([&](const OsmWay& way) {
        for (const int64_t id : way.nodes) ++laying.uses[id];
        ++laying.uses[way.nodes.front()], ++laying.uses[way.nodes.back()];
    });
    each([&](const OsmWay& way) {
        const float limit = parse_number(way.tags["maxspeed"]).value_or(0) / 3.6f;
        Road like;
        like.width = k_width, like.speed = k_speed;
        like.backward = 0;
        like.is_track = true;
        if (limit > 1) like.speed = std::min(limit, k_speed);
        lay_along(laying, way, like);
        const float stated = is_one_of(way.tags["oneway"], {"yes", "true", "1"}) ? 1.0f
                             : way.tags.is("oneway", "-1")                       ? -1.0f
                                                                                 : 0.0f;
        tracks.says.resize(laying.plan.roads.size(), stated);
    });
    open_ends(laying);
    for (const OsmNode& node : l.in.map.nodes)
        if (is_stop(node.tags)) l.plan.tram_stops.push_back(l.in.project(node));
    const auto first = static_cast<uint32_t>(l.plan.nodes.size());
    l.plan.nodes.insert(l.plan.nodes.end(), laying.plan.nodes.begin(), laying.plan.nodes.end());
    for (Road& road : joined(tracks, l.plan.drives_left)) {
        road.from += first, road.to += first;
        l.plan.roads.push_back(std::move(road));
    }
}

}  // namespace flaneur
