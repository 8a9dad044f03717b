// Tracks among lanes: where they lie, where they meet, and what cannot be driven at one time with them.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/base/math.h"
#include "sim/base/planar.h"
#include "sim/lanes/draft.h"
#include "sim/lanes/lines.h"

namespace flaneur {

namespace {

constexpr float k_tram = 2.4f;  // metres across; German law allows 2.65 (BOStrab)
constexpr float k_half_bus = 1.25f, k_half_van = 0.97f, k_bus_lane = 3.05f;  // metres; of lanes with buses
constexpr float k_between = 0.15f;                     // metres between what goes side by side
constexpr int k_tram_rank = 100;                       // above all roads'
constexpr float k_most_bend = 0.5f;                    // radians at a node: switches lead no other way
constexpr float k_same_way = 0.9f, k_against = -0.8f;  // cosines
constexpr int k_merges = 14, k_crosses = 20;  // places, about metres: of a run that is kept free, at most
constexpr int k_margin = 2, k_least = 3;      // the same: beyond what two share; of what is left of a lane
constexpr int k_room = 8, k_room_of_tracks = 12;  // the same: between two that are cut out

// Places [from, to] of a draft.
struct Span {
    int from = 0, to = 0;
};
// Two that cannot be driven at one time.
struct Clash {
    uint32_t track = 0, other = 0;
    Span on_track, on_other;
    uint32_t pieces[2] = {k_no_lane, k_no_lane};  // drafts that are cut out
};
// The place of a track that is nearest to one of another draft.
struct Near {
    uint32_t track = 0;
    int place = 0, at = 0;
    float far = 0;
};

int count_of(const Draft& d) { return static_cast<int>(d.line.size()); }
Vec2 along(const Draft& d, int place) {
    const int k = std::clamp(place, 0, count_of(d) - 1);
    const auto a = static_cast<size_t>(std::max(k - 1, 0)),
               b = static_cast<size_t>(std::min(k + 1, count_of(d) - 1));
    return normalize_or(d.line[b] - d.line[a], {1, 0});
}

// Metres between the middles of two that cannot pass each other.
float clear_of(const Lane& other) {
    const float half = other.is_track ? k_tram / 2 : other.width < k_bus_lane ? k_half_van : k_half_bus;
    return k_tram / 2 + half + k_between;
}

// Places of tracks by squares of the plane.
struct TrackPlace {
    int x, z;
    uint32_t track;
    int at;
};
constexpr float k_square = 4;
int square_at(float v) { return static_cast<int>(std::floor(v / k_square)); }
bool is_before(const TrackPlace& a, const TrackPlace& b) {
    return std::tie(a.x, a.z, a.track, a.at) < std::tie(b.x, b.z, b.track, b.at);
}

std::vector<TrackPlace> places_of_tracks(const std::vector<Draft>& drafts) {
    std::vector<TrackPlace> all;
    for (uint32_t i = 0; i < drafts.size(); ++i)
        for (int k = 0; drafts[i].lane.is_track && k < count_of(drafts[i]); ++k) {
            const Vec2 p = drafts[i].line[static_cast<size_t>(k)];
            all.push_back({square_at(p.x), square_at(p.z), i, k});
        }
    std::sort(all.begin(), all.end(), is_before);
    return all;
}

// Whether two tracks meet at a node, where join_tracks() has looked after them.
bool meet(const Draft& a, const Draft& b) {
    auto touches = [](const Draft& d, uint32_t node) {
        return is_curve(d.lane) ? d.lane.node == node : d.from == node || d.to == node;
    };
    if (is_curve(a.lane)) return touches(b, a.lane.node);
    return touches(b, a.from) || touches(b, a.to);
}

// The nearest place of each track that a draft comes near, in order of track and place.
std::vector<Near> near_tracks(const std::vector<Draft>& drafts, uint32_t number,
                              const std::vector<TrackPlace>& places) {
    const Draft& d = drafts[number];
    const float reach = clear_of(d.lane);
    std::vector<Near> all;
    for (int k = 0; k < count_of(d); ++k) {
        const Vec2 p = d.line[static_cast<size_t>(k)];
        for (int x = square_at(p.x - reach); x <= square_at(p.x + reach); ++x)
            for (int z = square_at(p.z - reach); z <= square_at(p.z + reach); ++z) {
                auto at = std::lower_bound(places.begin(), places.end(), TrackPlace{x, z, 0, 0}, is_before);
                for (; at != places.end() && at->x == x && at->z == z; ++at) {
                    const Draft& track = drafts[at->track];
                    const float far = length(track.line[static_cast<size_t>(at->at)] - p);
                    if (far > reach || at->track == number) continue;
                    if (d.lane.is_track && (at->track > number || meet(track, d))) continue;
                    all.push_back({at->track, k, at->at, far});
                }
            }
    }
    std::sort(all.begin(), all.end(), [](const Near& a, const Near& b) {
        return std::tie(a.track, a.place, a.far, a.at) < std::tie(b.track, b.place, b.far, b.at);
    });
    const auto last = std::unique(all.begin(), all.end(), [](const Near& a, const Near& b) {
        return a.track == b.track && a.place == b.place;
    });
    all.erase(last, all.end());
    return all;
}

// What a run of places near a track comes to: nothing where one follows the other all along.
void judge(std::vector<Draft>& drafts, uint32_t number, std::span<const Near> run,
           std::vector<Clash>& clashes) {
    Draft& track = drafts[run[0].track];
    const Draft& d = drafts[number];
    auto cosine = [&](const Near& n) { return dot(along(track, n.at), along(d, n.place)); };
    float nearest = 1e9f;
    for (const Near& n : run) nearest = std::min(nearest, n.far);
    const bool same = cosine(run.front()) > k_same_way, ends_same = cosine(run.back()) > k_same_way;
    // Of two that begin as one, one is behind the other.
    if (same && (run.front().place == 0 || run.front().at == 0)) return;
    const auto count = static_cast<int>(run.size());
    const bool is_against = cosine(run[run.size() / 2]) < k_against;
    const bool only_touches = nearest > clear_of(d.lane) - (same ? k_between + 0.2f : 0.02f);
    if (only_touches && (is_against || (same && ends_same))) return;
    if (is_against && count > k_crosses) {
        track.is_left_out = true;
        return;
    }
    if (ends_same && count > k_merges) run = run.first(k_merges);
    Clash clash{run[0].track, number, {run[0].at, run[0].at}, {run.front().place, run.back().place}};
    for (const Near& n : run) {
        clash.on_track.from = std::min(clash.on_track.from, n.at);
        clash.on_track.to = std::max(clash.on_track.to, n.at);
    }
    clashes.push_back(clash);
}

std::vector<Clash> find_clashes(std::vector<Draft>& drafts) {
    const std::vector<TrackPlace> places = places_of_tracks(drafts);
    std::vector<Clash> clashes;
    for (uint32_t i = 0; i < drafts.size() && !places.empty(); ++i) {
        const std::vector<Near> near = near_tracks(drafts, i, places);
        for (size_t begin = 0; begin < near.size();) {
            size_t end = begin + 1;
            while (end < near.size() && near[end].track == near[begin].track &&
                   near[end].place <= near[end - 1].place + 2)
                ++end;
            judge(drafts, i, std::span(near).subspan(begin, end - begin), clashes);
            begin = end;
        }
    }
    return clashes;
}

// Cuts places [from, to] out of a draft as a curve at `node`; what is beyond is a draft of its own.
uint32_t cut_out(LaneMaking& m, uint32_t number, Span span, uint32_t node) {
    const auto piece = static_cast<uint32_t>(m.drafts.size()), beyond = piece + 1;
    Draft cut = m.drafts[number], rest = cut;
    const auto line = cut.line.begin();
    cut.line.assign(line + span.from, line + span.to + 1);
    rest.line.erase(rest.line.begin(), rest.line.begin() + span.to);
    for (const uint32_t next : rest.nexts)
        if (is_curve(m.drafts[next].lane)) m.drafts[next].from = beyond;
    Draft& d = m.drafts[number];
    d.line.resize(static_cast<size_t>(span.from) + 1);
    d.nexts = {piece}, d.to = node, d.lane.is_gate_out = 0;
    cut.nexts = {beyond}, cut.conflicts.clear();
    cut.from = number, cut.to = beyond;
    cut.lane.node = node, cut.lane.is_gate_in = cut.lane.is_gate_out = 0;
    rest.from = node, rest.lane.is_gate_in = 0;
    m.drafts.push_back(std::move(cut));
    m.drafts.push_back(std::move(rest));
    return piece;
}

// Where one draft is cut, for which of which clashes.
struct Cut {
    Span span;
    std::vector<std::pair<size_t, int>> clashes;
};

void cut_draft(LaneMaking& m, uint32_t number, std::vector<Cut>& wanted, std::vector<Clash>& clashes) {
    auto tell = [&](const Cut& cut, uint32_t piece) {
        for (const auto& [clash, which] : cut.clashes) clashes[clash].pieces[which] = piece;
    };
    if (is_curve(m.drafts[number].lane)) {
        for (const Cut& cut : wanted) tell(cut, number);
        return;
    }
    std::sort(wanted.begin(), wanted.end(),
              [](const Cut& a, const Cut& b) { return a.span.from < b.span.from; });
    const int count = count_of(m.drafts[number]);
    const int room = m.drafts[number].lane.is_track ? k_room_of_tracks : k_room;
    std::vector<Cut> cuts;
    for (const Cut& cut : wanted) {
        if (!cuts.empty() && cut.span.from < cuts.back().span.to + room) {
            cuts.back().span.to = std::max(cuts.back().span.to, cut.span.to);
            cuts.back().clashes.insert(cuts.back().clashes.end(), cut.clashes.begin(), cut.clashes.end());
        } else {
            cuts.push_back(cut);
        }
    }
    for (size_t k = cuts.size(); k-- > 0;) {
        const Span span{std::max(cuts[k].span.from - k_margin, k_least),
                        std::min(cuts[k].span.to + k_margin, count - 1 - k_least)};
        if (span.to - span.from < 2) continue;
        // At the junction whose curves it crosses, if it does.
        uint32_t node = k_no_lane;
        for (const auto& [clash, which] : cuts[k].clashes) {
            const Lane& other = m.drafts[which == 0 ? clashes[clash].other : clashes[clash].track].lane;
            if (is_curve(other) && !other.is_track) node = std::min(node, other.node);
        }
        if (node == k_no_lane) node = static_cast<uint32_t>(m.roads_at.size()), m.roads_at.emplace_back();
        tell(cuts[k], cut_out(m, number, span, node));
    }
}

}  // namespace

void lay_track(LaneMaking& m, uint32_t number) {
    const Road& road = m.plan.roads[number];
    const float whole = length_along(road.line), from = m.back_from[number], to = whole - m.back_to[number];
    if (to - from < 1) return;
    add_lane(m, number, piece_of(road.line, from, to), false, 0, 1, road.width);
    m.drafts.back().lane.is_track = 1;
    m.drafts.back().lane.rank = k_tram_rank;
}

void join_tracks(LaneMaking& m, uint32_t node) {
    for (const uint32_t a : m.into[node])
        for (const uint32_t b : m.out_of[node]) {
            if (!m.drafts[a].lane.is_track || !m.drafts[b].lane.is_track) continue;
            const uint32_t in = m.drafts[a].road, out = m.drafts[b].road;
            const Road &from = m.plan.roads[in], &to = m.plan.roads[out];
            const float turn = angle_between(-leaves(from, node), leaves(to, node));
            const float whole = length_along(from.line), before = m.back_to[in], after = m.back_from[out];
            if (std::fabs(turn) > k_most_bend || before + after < 0.2f) continue;
            Draft d;
            d.line = piece_of(from.line, whole - before, whole);
            const std::vector<Vec2> beyond = piece_of(to.line, 0, after);
            d.line.insert(d.line.end(), beyond.begin() + 1, beyond.end());
            d.line = evenly(d.line);
            d.from = a, d.to = b;
            d.lane = m.drafts[a].lane;
            d.lane.is_gate_in = d.lane.is_gate_out = 0;
            d.lane.node = node;
            d.lane.turn = turn;
            const auto number = static_cast<uint32_t>(m.drafts.size());
            m.drafts[a].nexts.push_back(number);
            d.nexts.push_back(b);
            m.drafts.push_back(std::move(d));
        }
}

void cut_at_tracks(LaneMaking& m) {
    std::vector<Clash> clashes = find_clashes(m.drafts);
    std::erase_if(clashes, [&](const Clash& clash) {
        return m.drafts[clash.track].is_left_out || m.drafts[clash.other].is_left_out;
    });
    std::vector<std::vector<Cut>> cuts(m.drafts.size());
    for (size_t k = 0; k < clashes.size(); ++k) {
        cuts[clashes[k].track].push_back({clashes[k].on_track, {{k, 0}}});
        cuts[clashes[k].other].push_back({clashes[k].on_other, {{k, 1}}});
    }
    for (uint32_t i = 0; i < cuts.size(); ++i)
        if (!cuts[i].empty()) cut_draft(m, i, cuts[i], clashes);
    for (const Clash& clash : clashes) {
        const auto [a, b] = std::tie(clash.pieces[0], clash.pieces[1]);
        if (a == k_no_lane || b == k_no_lane || a == b) continue;
        for (const auto& [mine, other] : {std::pair{a, b}, std::pair{b, a}})
            if (std::vector<uint32_t>& all = m.drafts[mine].conflicts;
                std::ranges::find(all, other) == all.end())
                all.push_back(other);
    }
}

void find_halts(const LaneMaking& m, const Draft& track, float stop, std::vector<float>& out) {
    constexpr float k_on = 1, k_beside = 6;                        // metres from a track
    constexpr float k_half = 15, k_off_line = 0.3f, k_apart = 40;  // of a tram; before a line; between halts
    if (is_curve(track.lane)) return;
    auto nearest = [](const Draft& d, Vec2 stop_at) {
        std::pair<float, size_t> least{1e9f, 0};
        for (size_t k = 0; k < d.line.size(); ++k) least = std::min(least, {length(d.line[k] - stop_at), k});
        return least;
    };
    const size_t first = out.size();
    const float apart = length_along(track.line) / static_cast<float>(track.line.size() - 1);
    for (const Vec2 at : m.plan.tram_stops) {
        float any = k_beside;
        for (const Draft& d : m.drafts)
            if (d.lane.is_track && !is_curve(d.lane) && !d.is_left_out)
                any = std::min(any, nearest(d, at).first);
        const auto [far, place] = nearest(track, at);
        if (far > (any < k_on ? k_on : k_beside) || place == 0 || place + 1 == track.line.size()) continue;
        out.push_back(std::min(static_cast<float>(place) * apart + k_half, stop - k_off_line));
    }
    std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end());
    // One of those that are side by side.
    const auto begin = out.begin() + static_cast<std::ptrdiff_t>(first);
    out.erase(std::unique(begin, out.end(), [](float a, float b) { return b - a < k_apart; }), out.end());
}

}  // namespace flaneur
