// A small map of OpenStreetMap, being written.
#pragma once

#include <algorithm>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace flaneur {

// In ten-millionths of a degree, which OpenStreetMap counts in: 11 mm at the equator. East and north.
using Corners = std::vector<std::pair<int, int>>;

inline Corners box(int x, int y, int wide, int deep) {
    return {{x, y}, {x + wide, y}, {x + wide, y + deep}, {x, y + deep}};
}

// It has a street to begin with. Tags are "key=value key=value".
struct Sketch {
    std::string nodes, ways, relations;
    int node_count = 0, way_count = 0;

    Sketch() { way({{-9000, -2500}, {9000, -2500}}, "highway=residential", false); }

    static std::string tags_of(const std::string& tags) {
        std::string xml;
        for (size_t at = 0; at < tags.size();) {
            size_t is = tags.find('=', at), end = std::min(tags.find(' ', at), tags.size());
            xml +=
                "<tag k='" + tags.substr(at, is - at) + "' v='" + tags.substr(is + 1, end - is - 1) + "'/>";
            at = end + 1;
        }
        return xml;
    }
    int way(const Corners& corners, const std::string& tags, bool closed = true) {
        std::string refs;
        int first = node_count + 1;
        for (auto [x, y] : corners) {
            char text[96];
            std::snprintf(text, sizeof text, "<node id='%d' lon='%.7f' lat='%.7f'/>", ++node_count, x * 1e-7,
                          y * 1e-7);
            nodes += text;
            refs += "<nd ref='" + std::to_string(node_count) + "'/>";
        }
        if (closed) refs += "<nd ref='" + std::to_string(first) + "'/>";
        ways += "<way id='" + std::to_string(++way_count) + "'>" + refs + tags_of(tags) + "</way>";
        return way_count;
    }
    void multipolygon(int outer, int inner, const std::string& tags) {
        relations += "<relation id='1'><member type='way' ref='" + std::to_string(outer) +
                     "' role='outer'/><member type='way' ref='" + std::to_string(inner) +
                     "' role='inner'/><tag k='type' v='multipolygon'/>" + tags_of(tags) + "</relation>";
    }
    std::string xml() const { return "<osm version='0.6'>" + nodes + ways + relations + "</osm>"; }
};

}  // namespace flaneur
