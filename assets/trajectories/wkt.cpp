#include "assets/trajectories/wkt.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace flaneur {
namespace {

constexpr size_t k_most_wkt = size_t{64} << 20;

void put(std::string& text, const std::vector<Vec2>& ring) {
    text += '(';
    for (size_t i = 0; i <= ring.size() && !ring.empty(); ++i) {
        const Vec2 p = ring[i < ring.size() ? i : 0];
        char corner[96];
        // Not -0.
        std::snprintf(corner, sizeof corner, "%s%.3f %.3f", i > 0 ? ", " : "", static_cast<double>(p.x) + 0.0,
                      0.0 - static_cast<double>(p.z));
        text += corner;
    }
    text += ')';
}

void put(std::string& text, const WalkablePolygon& polygon) {
    text += '(';
    put(text, polygon.outer);
    for (const std::vector<Vec2>& hole : polygon.holes) {
        text += ", ";
        put(text, hole);
    }
    text += ')';
}

struct WktReader {
    std::string_view rest;

    void skip() {
        while (!rest.empty() && (rest[0] == ' ' || rest[0] == '\n' || rest[0] == '\t' || rest[0] == '\r'))
            rest.remove_prefix(1);
    }
    bool take(std::string_view word) {
        skip();
        if (!rest.starts_with(word)) return false;
        rest.remove_prefix(word.size());
        return true;
    }
    bool take(float& number) {
        skip();
        const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
        if (error != std::errc() || !std::isfinite(number) || std::fabs(number) > 1e5f) return false;
        rest.remove_prefix(static_cast<size_t>(end - rest.data()));
        return true;
    }
    bool take(std::vector<Vec2>& ring) {
        if (!take("(")) return false;
        do {
            float x = 0, y = 0, z = 0;
            if (!take(x) || !take(y)) return false;
            (void)take(z);  // some have a height
            ring.push_back({x, 0 - y});
        } while (take(","));
        if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
        return ring.size() > 2 && take(")");
    }
    bool take(WalkablePolygon& polygon) {
        if (!take("(") || !take(polygon.outer)) return false;
        while (take(","))
            if (!take(polygon.holes.emplace_back())) return false;
        return take(")");
    }
};

}  // namespace

std::string wkt_of(const std::vector<WalkablePolygon>& area) {
    std::string text = area.size() == 1 ? "POLYGON " : "MULTIPOLYGON ";
    if (area.empty()) return text + "EMPTY";
    if (area.size() > 1) text += '(';
    for (size_t i = 0; i < area.size(); ++i) {
        if (i > 0) text += ", ";
        put(text, area[i]);
    }
    if (area.size() > 1) text += ')';
    return text;
}

Result<std::vector<WalkablePolygon>> parse_wkt(std::string_view text) {
    const Error broken{"has a walkable area that is no POLYGON ((x y, ..), ..) within 100 km"};
    if (text.size() > k_most_wkt) return broken;
    WktReader reader{text};
    std::vector<WalkablePolygon> area;
    const bool many = reader.take("MULTIPOLYGON");
    if (!many && !reader.take("POLYGON")) return broken;
    (void)reader.take("Z");
    if (many && !reader.take("(")) return broken;
    do {
        if (!reader.take(area.emplace_back())) return broken;
    } while (many && reader.take(","));
    if (many && !reader.take(")")) return broken;
    reader.skip();
    if (!reader.rest.empty()) return broken;
    return area;
}

}  // namespace flaneur
