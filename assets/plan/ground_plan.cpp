#include "assets/plan/ground_plan.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

#include "sim/base/parallel_for.h"

namespace flaneur {

namespace {

constexpr float k_highest_step = 0.35f;  // higher ones are walls

// An edge as its lower and its higher corner, and which piece has it which way round.
struct RingEdge {
    Point low, high;
    uint32_t piece;
    bool forward;  // the piece runs from low to high

    auto key() const { return std::tuple(low.X, low.Y, high.X, high.Y, piece, forward); }
    bool along(const RingEdge& e) const { return low == e.low && high == e.high; }
};

void add_edges(std::vector<RingEdge>& edges, const Ring& ring, uint32_t piece) {
    for (size_t i = 0; i < ring.size(); ++i) {
        Point a = ring[i], b = ring[(i + 1) % ring.size()];
        bool forward = a.X != b.X ? a.X < b.X : a.Y < b.Y;
        edges.push_back(forward ? RingEdge{a, b, piece, true} : RingEdge{b, a, piece, false});
    }
}

// Between the edge p-q of a piece whose interior lies to its left and the other piece there, whose heights at
// p and q are given.
void add_face(City& city, Vec3 p, Vec3 q, float other_p, float other_q, bool steps) {
    float most = std::max(std::fabs(p.y - other_p), std::fabs(q.y - other_q));
    if (most < 1e-3f) return;
    // The free side of the higher piece's edge is to its right.
    Face face;
    face.a = {q.x, std::min(q.y, other_q), q.z};
    face.b = {p.x, std::min(p.y, other_p), p.z};
    face.a_top = std::max(q.y, other_q);
    face.b_top = std::max(p.y, other_p);
    if (p.y + q.y <= other_p + other_q) {
        std::swap(face.a, face.b);
        std::swap(face.a_top, face.b_top);
    }
    face.kind = most > k_highest_step ? FaceKind::garden_wall : steps ? FaceKind::riser : FaceKind::kerb;
    city.ground.faces.push_back(face);
}

}  // namespace

float lift_at(const Lift& lift, Vec2 p) {
    return clamp(lift.base + dot(p - lift.origin, lift.slope), lift.low, lift.high);
}

int64_t cell_of(const GroundPlan& plan) { return std::max<int64_t>(1000, std::llround(plan.cell * 1000.0f)); }

float height_of(const GroundPlan& plan, const Area& area, Vec2 p) {
    return (area.lift.absolute ? 0 : terrain_at(plan, p)) + lift_at(area.lift, p);
}

void facet_terrain(GroundPlan& plan) {
    struct Corners {
        Vec2 low;
        float cell;
        size_t columns, rows;
        std::vector<float> heights;
    };
    // Corners lie on whole millimetres, as pieces' do.
    auto corners = std::make_shared<Corners>();
    Corners& c = *corners;
    c.low = to_metres(to_point(plan.low));
    c.cell = static_cast<float>(cell_of(plan)) * 0.001f;
    auto count = [&](float from, float to) {
        return static_cast<size_t>(std::max(0.0f, (to - from) / c.cell)) + 2;
    };
    c.columns = count(c.low.x, plan.high.x), c.rows = count(c.low.z, plan.high.z);
    c.heights.resize(c.columns * c.rows);
    WorkersPtr workers = make_workers(0);
    parallel_for(*workers, c.rows, 8, [&](size_t begin, size_t end, int) {
        for (size_t row = begin; row < end; ++row) {
            for (size_t column = 0; column < c.columns; ++column) {
                Vec2 step{static_cast<float>(column), static_cast<float>(row)};
                c.heights[row * c.columns + column] = terrain_at(plan, c.low + step * c.cell);
            }
        }
    });
    plan.facets = true;
    plan.terrain = [corners](Vec2 p) {
        const Corners& grid = *corners;
        auto place = [&](float v, size_t count_of, float& rest) {
            v = clamp(v / grid.cell, 0, static_cast<float>(count_of - 1));
            auto at = std::min(static_cast<size_t>(v), count_of - 2);
            rest = v - static_cast<float>(at);
            return at;
        };
        float u = 0, v = 0;
        size_t column = place(p.x - grid.low.x, grid.columns, u), row = place(p.z - grid.low.z, grid.rows, v);
        const float* here = &grid.heights[row * grid.columns + column];
        float a = here[0], b = here[1], d = here[grid.columns], e = here[grid.columns + 1];
        // The diagonal runs from the square's low corner to its high one.
        return u >= v ? a + u * (b - a) + v * (e - b) : a + v * (d - a) + u * (e - d);
    };
}

void lay_ground(const GroundPlan& plan, City& city) {
    std::vector<Piece> pieces = cut_pieces(plan);
    auto height = [&](const Piece& piece, Point p) {
        return height_of(plan, plan.areas[piece.area], to_metres(p));
    };

    std::vector<std::vector<uint32_t>> triangles(pieces.size());
    WorkersPtr workers = make_workers(0);
    parallel_for(*workers, pieces.size(), 16, [&](size_t begin, size_t end, int) {
        for (size_t i = begin; i < end; ++i) triangles[i] = triangulate(pieces[i].region);
    });

    std::vector<RingEdge> edges;
    for (uint32_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        const Area& area = plan.areas[piece.area];
        auto first = static_cast<uint32_t>(city.ground.vertices.size());
        for (const Ring& ring : rings_of(piece.region)) {
            add_edges(edges, ring, i);
            for (Point p : ring) city.ground.vertices.push_back(at_height(to_metres(p), height(piece, p)));
        }
        for (size_t t = 0; t < triangles[i].size(); t += 3) {
            // Positive in x, z is clockwise seen from above.
            for (size_t corner : {t, t + 2, t + 1})
                city.ground.indices.push_back(first + triangles[i][corner]);
            city.ground.kinds.push_back(area.kind);
            city.ground_axes.push_back(area.axis);
        }
    }

    std::sort(edges.begin(), edges.end(),
              [](const RingEdge& a, const RingEdge& b) { return a.key() < b.key(); });
    for (size_t i = 0; i + 1 < edges.size(); ++i) {
        const RingEdge &e = edges[i], &f = edges[i + 1];
        if (!e.along(f) || e.forward == f.forward || e.piece == f.piece) continue;
        const Piece &forward = pieces[e.forward ? e.piece : f.piece],
                    &backward = pieces[e.forward ? f.piece : e.piece];
        float fl = height(forward, e.low), fh = height(forward, e.high);
        float bl = height(backward, e.low), bh = height(backward, e.high);
        bool steps = plan.areas[forward.area].kind == Surface::steps ||
                     plan.areas[backward.area].kind == Surface::steps;
        Vec3 low_f = at_height(to_metres(e.low), fl), high_f = at_height(to_metres(e.high), fh);
        if ((fl - bl) * (fh - bh) >= 0) {
            add_face(city, low_f, high_f, bl, bh, steps);
            continue;
        }
        // The two change places on the way: a wedge to either side.
        float t = (fl - bl) / ((fl - bl) - (fh - bh));
        Vec3 middle = lerp(low_f, high_f, t);
        add_face(city, low_f, middle, bl, middle.y, steps);
        add_face(city, middle, high_f, middle.y, bh, steps);
    }
}

}  // namespace flaneur
