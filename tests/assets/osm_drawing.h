// Small maps drawn by tests.
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

// A map drawn in metres about the equator: +x east, +z south, as the city will have them.
struct Drawing {
    std::string nodes, ways;
    int next = 1;

    int node(float x, float z, const std::string& tags = "") {
        // The map below is square to a tenth of a per cent.
        char place[80];
        std::snprintf(place, sizeof place, "lon=\"%.9f\" lat=\"%.9f\"", static_cast<double>(x) / 111319.5,
                      static_cast<double>(-z) / 110574.3);
        nodes += "<node id=\"" + std::to_string(next) + "\" " + place + ">" + tags + "</node>";
        return next++;
    }
    void way(const std::vector<int>& refs, const std::string& tags) {
        ways += "<way id=\"" + std::to_string(next++) + "\">";
        for (int ref : refs) ways += "<nd ref=\"" + std::to_string(ref) + "\"/>";
        ways += tags + "</way>";
    }
    // A rectangle between two corners.
    void area(Vec2 low, Vec2 high, const std::string& tags) {
        std::vector<int> refs{node(low.x, low.z), node(high.x, low.z), node(high.x, high.z),
                              node(low.x, high.z)};
        refs.push_back(refs[0]);
        way(refs, tags);
    }
    void way(const std::vector<Vec2>& points, const std::string& tags) {
        std::vector<int> refs;
        for (Vec2 p : points) refs.push_back(node(p.x, p.z));
        way(refs, tags);
    }
};

inline std::string tag(const std::string& key, const std::string& value) {
    return "<tag k=\"" + key + "\" v=\"" + value + "\"/>";
}

inline std::string osm_of(const Drawing& drawing) {
    return "<osm version=\"0.6\">" + drawing.nodes + drawing.ways + "</osm>";
}

}  // namespace flaneur
