// Building the decks of raised ways.
#include <algorithm>
#include <cmath>
#include <map>

#include "assets/osm/decks.h"
#include "assets/plan/masses.h"
#include "assets/plan/streets.h"

namespace flaneur {

namespace {

constexpr float k_railing = 1.05f, k_railing_width = 0.18f;  // metres
constexpr float k_flush = 0.3f;        // what is no farther below or above goes on as one surface, metres
constexpr float k_half_riser = 0.13f;  // so far treads lie off their slope, metres
constexpr float k_buried = 0.7f;       // abutments reach this far below the ground, metres

int level_of(const OsmStreet& street) { return std::max(1, street.highway.level); }

struct Halves {
    float left, right;
};

// From the centre line to the edges of the deck.
Halves halves_of(const OsmStreet& street) {
    float half = street.highway.width * 0.5f;
    if (!street.highway.drives) return {half, half};
    return {half + tagged_sidewalk(street, true), half + tagged_sidewalk(street, false)};
}

// The heights of the decks of one level, along the nearest piece.
struct DeckField {
    SegmentIndex index;
    const std::vector<DeckPiece>* pieces = nullptr;

    float operator()(Vec2 p) const {
        const LinePiece* s = nullptr;
        for (float reach : {6.0f, 30.0f}) {
            if (!s) s = index.nearest(p, reach);
        }
        if (!s) return 0;
        const DeckPiece& piece = (*pieces)[s->owner];
        return lerp(piece.a_height, piece.b_height, closest_on(*s, p));
    }
};

// The plane of a piece, `above` metres higher.
Lift lift_of(const DeckPiece& piece, float above) {
    Vec2 along = piece.b - piece.a;
    Lift lift;
    lift.base = piece.a_height + above;
    lift.low = -1e6f;
    lift.high = 1e6f;
    lift.origin = piece.a;
    lift.slope = along * ((piece.b_height - piece.a_height) / std::max(length_squared(along), 1e-6f));
    lift.absolute = true;
    return lift;
}

// Adds the streets of one level to its plan.
void add_deck_streets(GroundPlan& plan, const OsmImport& in, const std::vector<DeckPiece>& decks, int level) {
    for (size_t first = 0; first < decks.size();) {
        size_t end = first + 1;
        while (end < decks.size() && decks[end].street == decks[first].street &&
               decks[end].line == decks[first].line)
            ++end;
        const DeckPiece &head = decks[first], &tail = decks[end - 1];
        const OsmStreet& street = in.raised[head.street];
        const std::vector<Vec2>& line = street.lines[head.line];
        size_t begin = first;
        first = end;
        if (level_of(street) != level) continue;
        if (street.highway.kind == Surface::steps) {
            Flight flight;
            flight.line = line;
            flight.width = street.highway.width;
            flight.from = head.a_height + k_kerb;
            flight.to = tail.b_height + k_kerb;
            flight.risers = stated_risers(street.way->tags);
            add_flight(plan, flight);
            continue;
        }
        bool drives = street.highway.drives;
        Surface foot = street.highway.kind == Surface::path ? Surface::sidewalk : street.highway.kind;
        Halves halves = halves_of(street);
        float half = street.highway.width * 0.5f;
        for (size_t i = begin; i < end; ++i) {
            bool round_start = i > begin || !(decks[i].starts_on_ground || decks[i].starts_open);
            bool round_end = i + 1 < end || !(decks[i].ends_on_ground || decks[i].ends_open);
            auto add = [&](int rank, Surface kind, float lift, float left, float right) {
                Area area;
                area.rank = rank;
                area.kind = kind;
                if (street.way->tags.is("highway", "service") || kind == Surface::track) area.axis = {};
                area.lift = lift_of(decks[i], lift);
                add_strip(area.rings, {decks[i].a, decks[i].b}, left, right, round_start, round_end);
                plan.areas.push_back(std::move(area));
            };
            if (drives) add(k_rank_road, Surface::road, 0, half, half);
            if (foot == Surface::track) {
                add(k_rank_road, foot, k_kerb, k_sleeper * 0.5f, k_sleeper * 0.5f);
                plan.areas.back().axis = normalize_or(decks[i].b - decks[i].a, {1, 0});
            }
            if (!drives || halves.left + halves.right > 2 * half) {
                add(k_rank_sidewalk, drives ? Surface::sidewalk : foot, k_kerb, halves.left, halves.right);
            }
        }
    }
}

// Buildings take their part of the decks that they stand in the way of, up to a walker's head.
void add_building_solids(GroundPlan& plan, const OsmImport& in, const DeckField& field) {
    constexpr float k_walker = 1.9f, k_margin = 0.5f;
    Area solid;
    solid.rank = k_rank_solid;
    solid.solid = true;
    std::vector<uint32_t> near;
    for (const OsmMass& mass : in.masses) {
        if (mass.rings.empty() || mass.rings[0].empty()) continue;
        Vec2 low = to_metres(mass.rings[0][0]), high = low;
        for (Point p : mass.rings[0]) {
            Vec2 q = to_metres(p);
            low = {std::min(low.x, q.x), std::min(low.z, q.z)};
            high = {std::max(high.x, q.x), std::max(high.z, q.z)};
        }
        near.clear();
        field.index.near((low + high) * 0.5f, length(high - low) * 0.5f + 8,
                         [&](const LinePiece& s) { near.push_back(s.owner); });
        std::sort(near.begin(), near.end());
        near.erase(std::unique(near.begin(), near.end()), near.end());
        Rings under;
        for (uint32_t i : near) {
            const DeckPiece& piece = (*field.pieces)[i];
            float bottom = std::min(piece.a_height, piece.b_height),
                  top = std::max(piece.a_height, piece.b_height);
            if (mass.bottom > top + k_walker || mass.eaves < bottom + 0.1f) continue;
            Halves halves = halves_of(in.raised[piece.street]);
            add_strip(under, {piece.a, piece.b}, halves.left + k_margin, halves.right + k_margin, true);
        }
        for (Ring& ring : intersect(under, mass.rings)) solid.rings.push_back(std::move(ring));
    }
    if (!solid.rings.empty()) plan.areas.push_back(std::move(solid));
}

struct DeckEdge {
    Vec3 a, b;          // the deck lies to their left as seen from above with x to the right and z down
    Vec2 a_out, b_out;  // from there to the outer edge of a railing, in its widths
};

// Square to an edge, away from the deck.
Vec2 out_of(Vec3 a, Vec3 b) {
    Vec2 along = on_ground(b) - on_ground(a);
    return normalize_or(Vec2{-along.z, along.x}, {1, 0});
}

// Edges of the triangles from `first` on that no other of them shares.
std::vector<DeckEdge> free_edges(const City& city, size_t first) {
    struct Half {
        Point low, high;
        DeckEdge edge;
    };
    std::vector<Half> halves;
    for (size_t t = first; t < city.ground.kinds.size(); ++t) {
        for (size_t k = 0; k < 3; ++k) {
            Vec3 a = city.ground.vertices[city.ground.indices[t * 3 + k]];
            Vec3 b = city.ground.vertices[city.ground.indices[t * 3 + (k + 1) % 3]];
            Point p = to_point(on_ground(a)), q = to_point(on_ground(b));
            bool forward = p.X != q.X ? p.X < q.X : p.Y < q.Y;
            halves.push_back({forward ? p : q, forward ? q : p, {a, b, out_of(a, b), out_of(a, b)}});
        }
    }
    auto key = [](const Half& h) { return std::tuple(h.low.X, h.low.Y, h.high.X, h.high.Y); };
    std::stable_sort(halves.begin(), halves.end(),
                     [&](const Half& a, const Half& b) { return key(a) < key(b); });
    std::vector<DeckEdge> edges;
    for (size_t i = 0; i < halves.size();) {
        size_t end = i + 1;
        while (end < halves.size() && key(halves[end]) == key(halves[i])) ++end;
        if (end == i + 1) edges.push_back(halves[i].edge);
        i = end;
    }
    return edges;
}

// The ground that goes on beside a place on an edge.
std::optional<GroundHit> ground_beside(const City& city, Vec3 p, Vec2 out) {
    return ground_at(city.ground, at_height(on_ground(p) + out * 0.12f, p.y), k_flush, k_flush);
}

// Railings that meet at a corner have one outer edge. After the ground is laid.
void mitre(const City& city, std::vector<DeckEdge>& edges) {
    constexpr float k_least = 0.05f, k_sharpest = -0.3f;  // metres; cosine between edges
    std::map<std::pair<int64_t, int64_t>, DeckEdge*> starts;
    auto key = [](Vec3 p) {
        Point at = to_point(on_ground(p));
        return std::pair<int64_t, int64_t>(at.X, at.Y);
    };
    auto has_railing = [&](Vec3 at, Vec3 other, Vec2 out) {
        float whole = length(on_ground(other) - on_ground(at));
        return whole > k_least && !ground_beside(city, lerp(at, other, std::min(0.5f, 0.1f / whole)), out);
    };
    for (DeckEdge& edge : edges) starts[key(edge.a)] = &edge;
    for (DeckEdge& edge : edges) {
        auto found = starts.find(key(edge.b));
        if (found == starts.end()) continue;
        DeckEdge& next = *found->second;
        Vec2 out = out_of(edge.a, edge.b), other = out_of(next.a, next.b);
        if (dot(out, other) < k_sharpest || !has_railing(edge.b, edge.a, out) ||
            !has_railing(next.a, next.b, other))
            continue;
        edge.b_out = next.a_out = (out + other) * (1 / (1 + dot(out, other)));
    }
}

void add_triangle(City& city, Vec3 a, Vec3 b, Vec3 c, uint32_t building) {
    for (Vec3 p : {a, b, c}) {
        city.roof_indices.push_back(static_cast<uint32_t>(city.roof_vertices.size()));
        city.roof_vertices.push_back(p);
    }
    city.roof_buildings.push_back(building);
}

// What ends a deck along a short edge: a railing, the flank of the slab or of the abutment, a kerb, or
// nothing, where another surface or a house goes on.
void finish_edge(OsmImport& in, const DeckField& field, const DeckEdge& edge, uint32_t building) {
    City& city = in.city;
    auto [a, b, a_out, b_out] = edge;
    Vec2 along = on_ground(b) - on_ground(a), out = out_of(a, b);
    if (length(along) < 0.004f) return;
    auto beyond_at = [&, start = a, end = b](float share) {
        return ground_beside(city, lerp(start, end, share), out);
    };
    Vec3 middle = (a + b) * 0.5f;
    constexpr float k_shortest = 0.2f;
    if (length(along) > k_shortest && beyond_at(0.1f).has_value() != beyond_at(0.9f).has_value()) {
        finish_edge(in, field, {a, middle, a_out, out}, building);
        finish_edge(in, field, {middle, b, out, b_out}, building);
        return;
    }
    if (std::optional<GroundHit> beyond = beyond_at(0.5f)) {
        float down = middle.y - beyond->height;
        if (down > 0.01f) {
            city.ground.faces.push_back(
                {{a.x, a.y - down, a.z}, {b.x, b.y - down, b.z}, a.y, b.y, FaceKind::riser, ~0u});
        }
        // What is higher beyond, a platform for one, ends at the deck.
        if (down < -0.01f) city.ground.faces.push_back({b, a, b.y - down, a.y - down, FaceKind::riser, ~0u});
        return;
    }
    std::optional<WallPoint> wall = closest_wall(city.ground, middle + Vec3{0, 1, 0}, 0.25f);
    bool at_house = wall && wall->face != ~0u && city.ground.faces[wall->face].kind == FaceKind::facade;
    auto clearance = [&](Vec3 p) { return p.y - terrain_at(in.plan, on_ground(p)); };
    bool in_air = std::min(clearance(a), clearance(b)) > k_headroom + k_half_riser;
    auto bottom = [&](Vec3 p) {
        return in_air ? p.y - k_deck : terrain_at(in.plan, on_ground(p)) - k_buried;
    };
    float width = at_house ? 0 : k_railing_width;
    Vec3 outer_a = a + at_height(a_out * width, 0), outer_b = b + at_height(b_out * width, 0);
    // Along steps the railing follows their slope.
    auto top = [&](Vec3 p) {
        return at_house ? p.y : clamp(field(on_ground(p)) + k_kerb, p.y - 0.15f, p.y + 0.15f) + k_railing;
    };
    float top_a = top(a), top_b = top(b);
    Vec3 foot_a{outer_a.x, std::min(bottom(a), a.y), outer_a.z},
        foot_b{outer_b.x, std::min(bottom(b), b.y), outer_b.z};
    city.ground.faces.push_back({foot_a, foot_b, top_a, top_b, FaceKind::garden_wall, building});
    if (at_house) return;
    city.ground.faces.push_back({b, a, top_b, top_a, FaceKind::garden_wall, building});
    Vec3 ia{a.x, top_a, a.z}, ib{b.x, top_b, b.z}, oa{outer_a.x, top_a, outer_a.z},
        ob{outer_b.x, top_b, outer_b.z};
    add_triangle(city, ia, ob, ib, building);
    add_triangle(city, ia, oa, ob, building);
}

// The deck as seen from below.
void add_undersides(OsmImport& in, size_t first, uint32_t building) {
    City& city = in.city;
    for (size_t t = first; t < city.ground.kinds.size(); ++t) {
        Vec3 p[3];
        bool in_air = false;
        for (size_t k = 0; k < 3; ++k) {
            p[k] = city.ground.vertices[city.ground.indices[t * 3 + k]];
            in_air |= p[k].y - terrain_at(in.plan, on_ground(p[k])) > k_headroom;
            p[k].y -= k_deck;
        }
        if (in_air) add_triangle(city, p[0], p[2], p[1], building);
    }
}

}  // namespace

uint32_t wall_building(OsmImport& in) {
    if (in.walls == ~0u) {
        in.walls = static_cast<uint32_t>(in.city.buildings.size());
        Building walls;
        walls.top = 1;
        in.city.buildings.push_back(walls);
    }
    return in.walls;
}

static ClipperLib::IntRect box_of(const Rings& rings) {
    ClipperLib::IntRect box{INT64_MAX, INT64_MAX, INT64_MIN, INT64_MIN};
    for (const Ring& ring : rings) {
        for (Point p : ring) {
            box = {std::min<ClipperLib::cInt>(box.left, p.X), std::min<ClipperLib::cInt>(box.top, p.Y),
                   std::max<ClipperLib::cInt>(box.right, p.X), std::max<ClipperLib::cInt>(box.bottom, p.Y)};
        }
    }
    return box;
}

void clear_ground_below(OsmImport& in, const std::vector<DeckPiece>& decks) {
    Area solid;
    solid.rank = k_rank_solid;
    solid.solid = true;
    std::vector<std::pair<ClipperLib::IntRect, const Ring*>> water;  // with their boxes
    for (const Area& area : in.plan.areas) {
        if (area.kind != Surface::water) continue;
        for (const Ring& ring : area.rings) water.push_back({box_of({ring}), &ring});
    }
    for (const DeckPiece& piece : decks) {
        float a = piece.a_height - terrain_at(in.plan, piece.a),
              b = piece.b_height - terrain_at(in.plan, piece.b);
        constexpr float k_high = k_headroom - k_kerb;  // as measured from pavements
        if (std::min(a, b) >= k_high) continue;
        auto share_at = [&](float height) {
            return clamp((height - a) / (std::fabs(b - a) > 1e-3f ? b - a : 1e-3f), 0, 1);
        };
        float first = a >= k_high ? share_at(k_high) : 0, last = b >= k_high ? share_at(k_high) : 1;
        Vec2 along = normalize_or(piece.b - piece.a, {1, 0});
        Halves halves = halves_of(in.raised[piece.street]);
        // The surfaces overlap by a hair where they meet.
        constexpr float k_hair = 0.01f;
        // As they are laid: flights of steps end straight.
        bool is_round = in.raised[piece.street].highway.kind != Surface::steps;
        bool round_start = is_round && !piece.starts_on_ground && !piece.starts_open && first <= 0,
             round_end = is_round && !piece.ends_on_ground && !piece.ends_open && last >= 1;
        Vec2 from = piece.a + along * (piece.starts_on_ground ? k_hair : 0),
             to = piece.b - along * (piece.ends_on_ground ? k_hair : 0);
        auto add = [&](Rings& rings, float start, float end, float more) {
            add_strip(rings, {lerp(from, to, start), lerp(from, to, end)}, halves.left + more,
                      halves.right + more, round_start && start <= 0, round_end && end >= 1);
        };
        // Railings stand outside the deck; where there is none it ends flush with the ground.
        float flush = k_flush + (is_round ? 0 : k_half_riser), level = clamp(share_at(flush), first, last);
        add(solid.rings, first, level, a > flush ? k_railing_width : 0);
        add(solid.rings, level, last, b > flush ? k_railing_width : 0);
        Rings wide;
        add(wide, first, last, k_railing_width);
        ClipperLib::IntRect box = box_of(wide);
        Rings below;  // a lake far away takes as long to clip as one below
        for (const auto& [its, ring] : water) {
            if (its.left <= box.right && its.right >= box.left && its.top <= box.bottom &&
                its.bottom >= box.top)
                below.push_back(*ring);
        }
        for (Ring& ring : intersect(wide, below)) solid.rings.push_back(std::move(ring));
        // The face of the abutment, where one can walk on below.
        Vec2 side{along.z, -along.x};
        auto close = [&](float share, bool forward) {
            Vec2 at = lerp(piece.a, piece.b, share);
            Vec2 left = at + side * (halves.left + k_railing_width),
                 right = at - side * (halves.right + k_railing_width);
            if (forward) std::swap(left, right);
            float foot = terrain_at(in.plan, at) - k_buried,
                  top = lerp(piece.a_height, piece.b_height, share) + k_kerb - k_deck;
            in.city.ground.faces.push_back({at_height(left, foot), at_height(right, foot), top, top,
                                            FaceKind::garden_wall, wall_building(in)});
        };
        if (a >= k_high) close(first, false);
        if (b >= k_high) close(last, true);
    }
    if (!solid.rings.empty()) in.plan.areas.push_back(std::move(solid));
}

void lay_decks(OsmImport& in, const std::vector<DeckPiece>& decks) {
    City& city = in.city;
    struct Laid {
        DeckField field;
        size_t first;
        std::vector<DeckEdge> edges;
    };
    std::vector<Laid> laid;
    for (int level = 1; level <= 5; ++level) {
        DeckField field;
        field.pieces = &decks;
        for (uint32_t i = 0; i < decks.size(); ++i) {
            if (level_of(in.raised[decks[i].street]) == level) field.index.add(decks[i].a, decks[i].b, i, 0);
        }
        if (field.index.segments.empty()) continue;
        field.index.sort();
        GroundPlan plan;
        plan.low = in.plan.low;
        plan.high = in.plan.high;
        plan.cell = in.plan.cell;
        add_building_solids(plan, in, field);
        add_deck_streets(plan, in, decks, level);
        size_t first = city.ground.kinds.size();
        lay_ground(plan, city);
        laid.push_back({field, first, free_edges(city, first)});
    }
    index_city(city);
    if (laid.empty()) return;
    uint32_t building = wall_building(in);
    constexpr float k_piece = 2;  // metres
    for (size_t l = 0; l < laid.size(); ++l) {
        mitre(city, laid[l].edges);
        for (const DeckEdge& edge : laid[l].edges) {
            Vec2 out = out_of(edge.a, edge.b);
            int parts = std::max(1, static_cast<int>(std::ceil(length(edge.b - edge.a) / k_piece)));
            for (int i = 0; i < parts; ++i) {
                auto at = [&](int k) {
                    return lerp(edge.a, edge.b, static_cast<float>(k) / static_cast<float>(parts));
                };
                finish_edge(in, laid[l].field,
                            {at(i), at(i + 1), i == 0 ? edge.a_out : out, i + 1 == parts ? edge.b_out : out},
                            building);
            }
        }
    }
    add_undersides(in, laid.front().first, building);
    index_city(city);
}

}  // namespace flaneur
