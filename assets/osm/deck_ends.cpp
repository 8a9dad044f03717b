// Ends of raised ways that nothing carries on: closed, and brought down to the ground or held up.
#include <algorithm>
#include <cmath>
#include <map>

#include "assets/osm/decks.h"
#include "assets/plan/masses.h"
#include "sim/base/math.h"

namespace flaneur {

namespace {

constexpr float k_flush = 0.3f;    // what is no higher above the ground is no end in the air, metres
constexpr float k_margin = 0.5f;   // to houses, metres
constexpr float k_walker = 1.9f;   // up to a walker's head, metres
constexpr float k_border = 8;      // how far from the border of the ground ways end that go on beyond, metres
constexpr float k_slope = 0.55f;   // of flights that no map tells of
constexpr float k_landing = 1.5f;  // free before their lowest step, metres

struct Box {
    Vec2 low{1e9f, 1e9f}, high{-1e9f, -1e9f};

    void add(Vec2 p) {
        low = {std::min(low.x, p.x), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.z, p.z)};
    }
    bool meets(const Box& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.z <= other.high.z &&
               other.low.z <= high.z;
    }
};

bool meets(const Rings& strip, const Rings& rings) {
    auto box_of = [](const Ring& ring) {
        Box box;
        for (Point p : ring) box.add(to_metres(p));
        return box;
    };
    for (const Ring& a : strip)
        for (const Ring& b : rings)
            if (box_of(a).meets(box_of(b)) && !intersect({a}, {b}).empty()) return true;
    return false;
}

bool is_in_house(const OsmImport& in, const Rings& strip, float bottom, float top) {
    return std::any_of(in.masses.begin(), in.masses.end(), [&](const OsmMass& mass) {
        return mass.bottom < top && mass.eaves > bottom && meets(strip, mass.rings);
    });
}

// Whether another way, without a common node, goes on where this one ends.
bool is_at_deck(const OsmImport& in, const std::vector<DeckPiece>& decks, const DeckEnd& end) {
    const DeckPiece& own = decks[end.piece];
    float half = in.raised[own.street].highway.width * 0.5f;
    return std::any_of(decks.begin(), decks.end(), [&](const DeckPiece& other) {
        if (other.street == own.street && other.line == own.line) return false;
        float share = closest_on({other.a, other.b}, end.at);
        Vec2 away = lerp(other.a, other.b, share) - end.at;
        return std::fabs(lerp(other.a_height, other.b_height, share) - end.height) < k_flush &&
               dot(away, end.out) > -0.1f &&
               length(away) < half + in.raised[other.street].highway.width * 0.5f;
    });
}

// Whether a flight would run into raised ways, but for the one that it starts from.
bool runs_into_decks(const OsmImport& in, const std::vector<DeckPiece>& decks, const DeckEnd& end,
                     Vec2 foot) {
    float half = in.raised[decks[end.piece].street].highway.width * 0.5f;
    for (const DeckPiece& other : decks) {
        float reach = half + in.raised[other.street].highway.width * 0.5f;
        constexpr int k_looks = 8;
        for (int i = 1; i <= k_looks; ++i) {
            Vec2 p = lerp(end.at, foot, static_cast<float>(i) / k_looks);
            bool is_start = length(p - end.at) < reach + half;
            if (!is_start && length(lerp(other.a, other.b, closest_on({other.a, other.b}, p)) - p) < reach)
                return true;
        }
    }
    return false;
}

// A pier below a deck, from the ground to its underside.
void add_pier(OsmImport& in, Area& solid, Vec2 at, Vec2 along, float height, float half) {
    constexpr float k_thick = 0.3f;  // half of it, metres
    constexpr float k_buried = 0.7f;
    along = along * k_thick;
    float foot = terrain_at(in.plan, at) - k_buried, top = height + k_kerb - k_deck;
    if (top - foot - k_buried < k_headroom - k_deck ||
        !has_room(in, {at - along, at + along}, half, {Surface::road, Surface::track}))
        return;
    Vec2 side = normalize_or(Vec2{-along.z, along.x}, {1, 0}) * half;
    Vec2 corners[4] = {at - along + side, at + along + side, at + along - side, at - along - side};
    for (size_t i = 0; i < 4; ++i) {
        in.city.ground.faces.push_back({at_height(corners[i], foot), at_height(corners[(i + 1) % 4], foot),
                                        top, top, FaceKind::garden_wall, wall_building(in)});
    }
    add_strip(solid.rings, {at - along, at + along}, half, half, false);
}

}  // namespace

bool is_at_border(const GroundPlan& plan, Vec2 p) {
    return p.x < plan.low.x + k_border || p.z < plan.low.z + k_border || p.x > plan.high.x - k_border ||
           p.z > plan.high.z - k_border;
}

bool has_room(const OsmImport& in, const std::vector<Vec2>& line, float half,
              const std::vector<Surface>& not_on) {
    Rings strip;
    add_strip(strip, line, half, half, false);
    return std::none_of(in.plan.areas.begin(), in.plan.areas.end(), [&](const Area& area) {
        bool is_taken = area.solid || std::find(not_on.begin(), not_on.end(), area.kind) != not_on.end();
        return is_taken && meets(strip, area.rings);
    });
}

std::vector<DeckEnd> open_ends(const OsmImport& in, const std::vector<DeckPiece>& decks) {
    std::map<std::pair<int64_t, int64_t>, int> met;
    auto key = [](Vec2 p) { return std::pair<int64_t, int64_t>(to_point(p).X, to_point(p).Y); };
    for (const DeckPiece& piece : decks) ++met[key(piece.a)], ++met[key(piece.b)];
    std::vector<DeckEnd> ends;
    for (uint32_t i = 0; i < decks.size(); ++i) {
        for (bool is_start : {true, false}) {
            const DeckPiece& piece = decks[i];
            DeckEnd end{
                is_start ? piece.a : piece.b, {}, is_start ? piece.a_height : piece.b_height, i, is_start};
            end.out = normalize_or(is_start ? piece.a - piece.b : piece.b - piece.a, {1, 0});
            float half = in.raised[piece.street].highway.width * 0.5f + k_margin;
            Rings strip;
            add_strip(strip, {end.at - end.out * 0.1f, end.at + end.out * half}, half, half, false);
            if (met[key(end.at)] == 1 && !(is_start ? piece.starts_on_ground : piece.ends_on_ground) &&
                end.height > terrain_at(in.plan, end.at) + k_flush && !is_at_deck(in, decks, end) &&
                !is_in_house(in, strip, end.height + 0.1f, end.height + k_walker))
                ends.push_back(end);
        }
    }
    return ends;
}

bool add_flight_down(OsmImport& in, const std::vector<DeckPiece>& decks, const DeckEnd& end) {
    const DeckPiece& piece = decks[end.piece];
    float half = in.raised[piece.street].highway.width * 0.5f;
    for (float turn : {0.0f, 0.7854f, -0.7854f, 1.5708f, -1.5708f}) {
        SinCos way = sin_cos(turn);
        Vec2 along = end.out * way.cosine + Vec2{-end.out.z, end.out.x} * way.sine;
        // Where the flight turns away, the deck goes on for a landing.
        Vec2 top = turn == 0 ? end.at : end.at + along * half, foot = top;
        for (int round = 0; round < 3; ++round)
            foot = top + along * ((end.height - terrain_at(in.plan, foot)) / k_slope);
        Vec2 clear = foot + along * k_landing;
        Rings strip;
        add_strip(strip, {top, clear}, half + k_margin, half + k_margin, false);
        float ground = terrain_at(in.plan, foot);
        if (length(foot - top) < 0.5f || is_at_border(in.plan, clear) || ground > end.height ||
            !has_room(in, {top, clear}, half + k_margin, {Surface::road, Surface::track, Surface::water}) ||
            is_in_house(in, strip, ground, end.height + k_walker) || runs_into_decks(in, decks, end, foot))
            continue;
        std::vector<Vec2>& line = in.raised[piece.street].lines[piece.line];
        if (turn != 0) line.insert(end.is_start ? line.begin() : line.end(), top);
        OsmStreet flight = in.raised[piece.street];
        flight.highway = {2 * half, 0, false, Surface::steps, 0};
        flight.lines = {{top, foot}};
        in.raised.push_back(std::move(flight));
        return true;
    }
    return false;
}

void add_piers(OsmImport& in, const std::vector<DeckPiece>& decks) {
    constexpr float k_inside = 0.5f;  // of the end, metres
    Area solid;
    solid.rank = k_rank_solid;
    solid.solid = true;
    Vec2 low = in.plan.low + Vec2{k_inside, k_inside}, high = in.plan.high - Vec2{k_inside, k_inside};
    auto is_inside = [&](Vec2 p) { return p.x > low.x && p.z > low.z && p.x < high.x && p.z < high.z; };
    for (const DeckPiece& piece : decks) {
        Vec2 along = normalize_or(piece.b - piece.a, {1, 0});
        float whole = length(piece.b - piece.a), half = in.raised[piece.street].highway.width * 0.4f;
        auto stand = [&](float share) {
            add_pier(in, solid, lerp(piece.a, piece.b, share), along,
                     lerp(piece.a_height, piece.b_height, share), half);
        };
        if (piece.starts_open && is_inside(piece.a)) stand(std::min(0.5f, k_inside / whole));
        if (piece.ends_open && is_inside(piece.b)) stand(std::max(0.5f, 1 - k_inside / whole));
        // Where the ground ends below a way that goes on.
        if (is_inside(piece.a) == is_inside(piece.b)) continue;
        float inside = is_inside(piece.a) ? 0 : 1, outside = 1 - inside;
        for (int round = 0; round < 10; ++round) {
            float middle = (inside + outside) * 0.5f;
            (is_inside(lerp(piece.a, piece.b, middle)) ? inside : outside) = middle;
        }
        stand(inside);
    }
    if (!solid.rings.empty()) in.plan.areas.push_back(std::move(solid));
}

}  // namespace flaneur
