// How high raised ways lie.
#include "assets/osm/decks.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "assets/plan/streets.h"

namespace flaneur {

namespace {

constexpr float k_piece = 4;  // metres

struct Link {
    uint32_t a, b;
    float length, slope;
};

// A point of a raised way. Nodes of the map are one point for all ways that share them.
struct DeckJoint {
    Vec2 at;
    float terrain = 0, height = 0;
    float most = 1e9f;     // as high as the slope up from the ground allows
    float wanted = -1e9f;  // as high as it has to be
    bool fixed = false;
};

struct Net {
    std::vector<DeckJoint> joints;
    std::vector<Link> links;
    std::vector<DeckPiece> pieces;  // heights to be filled; one for each link
};

float steepest(const OsmHighway& highway) {
    return highway.kind == Surface::steps ? 0.65f : highway.drives ? 0.09f : 0.14f;
}

bool share_a_node(const OsmWay& a, const OsmWay& b) {
    return std::any_of(a.nodes.begin(), a.nodes.end(), [&](int64_t id) {
        return std::find(b.nodes.begin(), b.nodes.end(), id) != b.nodes.end();
    });
}

// Places where ways on the ground have their corners, sorted.
std::vector<Point> places_on_ground(const OsmImport& in) {
    std::vector<Point> places;
    for (const SegmentIndex* lines : {&in.streets, &in.tracks})
        for (const LinePiece& s : lines->segments)
            for (Vec2 p : {s.a, s.b}) places.push_back(to_point(p));
    std::sort(places.begin(), places.end(), point_less);
    return places;
}

Net make_net(const OsmImport& in, const std::vector<Point>& ground) {
    Net net;
    std::vector<std::pair<Point, uint32_t>> shared;  // corners of raised ways, for finding them again
    for (const OsmStreet& street : in.raised)
        for (const std::vector<Vec2>& line : street.lines)
            for (Vec2 p : line) shared.push_back({to_point(p), 0});
    std::sort(shared.begin(), shared.end(),
              [](const auto& a, const auto& b) { return point_less(a.first, b.first); });
    shared.erase(std::unique(shared.begin(), shared.end(),
                             [](const auto& a, const auto& b) { return a.first == b.first; }),
                 shared.end());
    auto add_joint = [&](Vec2 p) {
        DeckJoint joint;
        joint.at = p;
        joint.terrain = joint.height = terrain_at(in.plan, p);
        net.joints.push_back(joint);
        return static_cast<uint32_t>(net.joints.size() - 1);
    };
    for (auto& [point, joint] : shared) {
        joint = add_joint(to_metres(point));
        net.joints[joint].fixed = std::binary_search(ground.begin(), ground.end(), point, point_less);
    }
    auto joint_of = [&](Vec2 p) {
        Point point = to_point(p);
        return std::lower_bound(shared.begin(), shared.end(), point,
                                [](const auto& a, Point b) { return point_less(a.first, b); })
            ->second;
    };
    for (uint32_t s = 0; s < in.raised.size(); ++s) {
        const OsmStreet& street = in.raised[s];
        for (uint32_t l = 0; l < street.lines.size(); ++l) {
            const std::vector<Vec2>& line = street.lines[l];
            for (size_t i = 0; i + 1 < line.size(); ++i) {
                float whole = length(line[i + 1] - line[i]);
                if (whole < 0.01f) continue;
                int parts = std::max(1, static_cast<int>(std::ceil(whole / k_piece)));
                uint32_t from = joint_of(line[i]), last = joint_of(line[i + 1]);
                for (int k = 1; k <= parts; ++k) {
                    float share = static_cast<float>(k) / static_cast<float>(parts);
                    uint32_t to = k == parts ? last : add_joint(lerp(line[i], line[i + 1], share));
                    net.links.push_back(
                        {from, to, whole / static_cast<float>(parts), steepest(street.highway)});
                    DeckPiece piece;
                    piece.a = net.joints[from].at;
                    piece.b = net.joints[to].at;
                    piece.street = s;
                    piece.line = l;
                    net.pieces.push_back(piece);
                    from = to;
                }
            }
        }
    }
    return net;
}

// Steps that lead up from the ground begin there, though no other way may be mapped.
void fix_feet_of_steps(const OsmImport& in, Net& net) {
    std::vector<uint8_t> raised(net.joints.size(), 0), walks(net.joints.size(), 0);
    for (size_t i = 0; i < net.links.size(); ++i) {
        int level = in.raised[net.pieces[i].street].highway.level;
        (level > 0 ? raised : walks)[net.links[i].a] += 1;
        (level > 0 ? raised : walks)[net.links[i].b] += 1;
    }
    for (size_t j = 0; j < net.joints.size(); ++j) net.joints[j].fixed |= walks[j] == 1 && raised[j] == 0;
}

// Where a raised way has to be high: over whatever passes below it, and all along walkways that touch the
// ground nowhere themselves.
void find_wants(const OsmImport& in, Net& net) {
    std::vector<uint8_t> touches(in.raised.size(), 0);
    for (size_t i = 0; i < net.links.size(); ++i) {
        if (net.joints[net.links[i].a].fixed || net.joints[net.links[i].b].fixed)
            touches[net.pieces[i].street] = 1;
    }
    SegmentIndex pieces;
    for (uint32_t i = 0; i < net.pieces.size(); ++i) pieces.add(net.pieces[i].a, net.pieces[i].b, i, 0);
    pieces.sort();
    auto want = [&](uint32_t joint, int level) {
        DeckJoint& j = net.joints[joint];
        j.wanted = std::max(j.wanted, j.terrain + k_level_height * static_cast<float>(level));
    };
    for (uint32_t i = 0; i < net.pieces.size(); ++i) {
        const DeckPiece& piece = net.pieces[i];
        const OsmStreet& street = in.raised[piece.street];
        int level = street.highway.level;
        if (level == 0) continue;
        if (street.highway.kind != Surface::steps && !touches[piece.street] && !street.highway.drives) {
            want(net.links[i].a, level);
            want(net.links[i].b, level);
        }
        auto crossed = [&](Vec2 a, Vec2 b, const OsmWay& below, float half) {
            if (!crossing_on(piece.a, piece.b, a, b) || share_a_node(*street.way, below)) return;
            Vec2 middle = (piece.a + piece.b) * 0.5f;
            float reach = half + 3;
            pieces.near(middle, reach, [&](const LinePiece& s) {
                if (net.pieces[s.owner].street != piece.street) return;
                for (uint32_t joint : {net.links[s.owner].a, net.links[s.owner].b}) {
                    if (length(net.joints[joint].at - middle) < reach) want(joint, level);
                }
            });
            want(net.links[i].a, level);
            want(net.links[i].b, level);
        };
        for (const SegmentIndex* lines : {&in.streets, &in.tracks}) {
            lines->near((piece.a + piece.b) * 0.5f, k_piece,
                        [&](const LinePiece& s) { crossed(s.a, s.b, in.map.ways[s.owner], s.half); });
        }
        pieces.near((piece.a + piece.b) * 0.5f, k_piece, [&](const LinePiece& s) {
            const OsmStreet& other = in.raised[net.pieces[s.owner].street];
            if (other.highway.level < level && other.highway.level > 0)
                crossed(s.a, s.b, *other.way, other.highway.width * 0.5f);
        });
    }
}

// How high the slope of each link allows every joint to be, if the sources lie on the ground.
std::vector<float> limits_from(const Net& net, const std::vector<uint32_t>& sources) {
    std::vector<std::vector<uint32_t>> links_of(net.joints.size());
    for (uint32_t i = 0; i < net.links.size(); ++i) {
        links_of[net.links[i].a].push_back(i);
        links_of[net.links[i].b].push_back(i);
    }
    using Reached = std::pair<float, uint32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
    std::vector<float> most(net.joints.size(), 1e9f);
    for (uint32_t j : sources) {
        most[j] = net.joints[j].terrain;
        queue.push({most[j], j});
    }
    while (!queue.empty()) {
        auto [height, j] = queue.top();
        queue.pop();
        if (height > most[j]) continue;
        for (uint32_t i : links_of[j]) {
            const Link& link = net.links[i];
            uint32_t other = link.a == j ? link.b : link.a;
            float up = height + link.length * link.slope;
            if (net.joints[other].fixed || up >= most[other]) continue;
            most[other] = up;
            queue.push({up, other});
        }
    }
    return most;
}

void find_limits(Net& net) {
    std::vector<uint32_t> fixed;
    for (uint32_t j = 0; j < net.joints.size(); ++j)
        if (net.joints[j].fixed) fixed.push_back(j);
    std::vector<float> most = limits_from(net, fixed);
    for (uint32_t j = 0; j < net.joints.size(); ++j) net.joints[j].most = most[j];
}

// Evenly between what is fixed: each free joint tends to the mean of its neighbours, over and over (Jacobi).
void relax(Net& net) {
    auto bounded = [](const DeckJoint& j, float height) {
        return std::min(std::max({height, j.terrain, j.wanted}), std::max(j.most, j.terrain));
    };
    for (DeckJoint& j : net.joints) {
        if (!j.fixed) j.height = bounded(j, j.terrain);
    }
    std::vector<float> sum(net.joints.size()), weight(net.joints.size());
    for (int round = 0; round < 300; ++round) {
        std::fill(sum.begin(), sum.end(), 0.0f);
        std::fill(weight.begin(), weight.end(), 0.0f);
        for (const Link& link : net.links) {
            // Gentle ways pull more: a flight takes up the height that a walkway keeps.
            float pull = 1 / (link.length * link.slope * link.slope);
            sum[link.a] += pull * net.joints[link.b].height, weight[link.a] += pull;
            sum[link.b] += pull * net.joints[link.a].height, weight[link.b] += pull;
        }
        for (size_t j = 0; j < net.joints.size(); ++j) {
            DeckJoint& joint = net.joints[j];
            if (!joint.fixed && weight[j] > 0) joint.height = bounded(joint, sum[j] / weight[j]);
        }
    }
}

Net solve(const OsmImport& in, const std::vector<Point>& ground) {
    Net net = make_net(in, ground);
    fix_feet_of_steps(in, net);
    find_wants(in, net);
    find_limits(net);
    relax(net);
    for (size_t i = 0; i < net.pieces.size(); ++i) {
        const DeckJoint &a = net.joints[net.links[i].a], &b = net.joints[net.links[i].b];
        DeckPiece& piece = net.pieces[i];
        // Tracks lie lower on the ground than the ways that decks go on as.
        float sunk = in.raised[piece.street].highway.kind == Surface::track ? k_kerb - k_track : 0;
        piece.a_height = a.height - (a.fixed ? sunk : 0);
        piece.b_height = b.height - (b.fixed ? sunk : 0);
        piece.starts_on_ground = a.fixed;
        piece.ends_on_ground = b.fixed;
    }
    return net;
}

// Whether an end may lie on the ground without what has to be high becoming lower.
bool may_come_down(const OsmImport& in, const Net& net, const DeckEnd& end) {
    const Link& link = net.links[end.piece];
    const OsmHighway& highway = in.raised[net.pieces[end.piece].street].highway;
    std::vector<Surface> not_on = highway.drives
                                      ? std::vector<Surface>{Surface::water}
                                      : std::vector<Surface>{Surface::water, Surface::road, Surface::track};
    if (!has_room(in, {end.at - end.out, end.at + end.out}, highway.width * 0.5f, not_on)) return false;
    std::vector<float> most = limits_from(net, {end.is_start ? link.a : link.b});
    for (size_t j = 0; j < net.joints.size(); ++j)
        if (most[j] < std::min(net.joints[j].wanted, net.joints[j].most)) return false;
    return true;
}

}  // namespace

std::vector<DeckPiece> solve_decks(OsmImport& in) {
    std::vector<Point> ground = places_on_ground(in);
    Net net = solve(in, ground);
    size_t before = ground.size() + in.raised.size();
    for (const DeckEnd& end : open_ends(in, net.pieces)) {
        if (is_at_border(in.plan, end.at)) continue;
        const OsmHighway& highway = in.raised[net.pieces[end.piece].street].highway;
        if (may_come_down(in, net, end)) {
            ground.push_back(to_point(end.at));
        } else if (!highway.drives && highway.kind != Surface::track) {
            add_flight_down(in, net.pieces, end);
        }
    }
    if (ground.size() + in.raised.size() > before) {
        std::sort(ground.begin(), ground.end(), point_less);
        net = solve(in, ground);
    }
    for (const DeckEnd& end : open_ends(in, net.pieces))
        (end.is_start ? net.pieces[end.piece].starts_open : net.pieces[end.piece].ends_open) = true;
    return net.pieces;
}

}  // namespace flaneur
