// Where one goes from one polygon of the mesh into another: what ways are made of. Private to sim/navigation.
//
// A gate is the piece of edge that two polygons share. A way leads from the middle of one gate to the middle
// of another of the same polygon, which costs their distance times what a metre there costs.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/base/vec.h"

namespace flaneur {

struct Navmesh;

struct Gate {
    Vec3 left, right;      // its ends, as seen by who goes from polygons[0] to polygons[1]
    uint32_t polygons[2];  // their numbers, the smaller first
};

struct Gates {
    std::vector<Gate> gates;
    std::vector<Vec3> middles;    // one a gate
    std::vector<uint32_t> first;  // of polygon p: of[first[p] .. first[p + 1]) are its gates, in rising order
    std::vector<uint32_t> of;
    std::vector<float> costs;    // one a polygon: of a metre there
    std::vector<uint8_t> steps;  // one a polygon: 1: wheels do not enter
};

// Of all polygons of the mesh, by polygon_number().
Gates find_gates(const Navmesh& mesh);

inline uint32_t behind(const Gate& gate, uint32_t polygon) {
    return gate.polygons[gate.polygons[0] == polygon ? 1 : 0];
}

// Of who goes from there to gate `gate` of the polygon.
inline float cost_to_gate(const Gates& g, Vec3 place, uint32_t polygon, uint32_t gate) {
    return g.costs[polygon] * length(g.middles[gate] - place);
}

inline uint32_t polygons_of(const Gates& g) { return static_cast<uint32_t>(g.first.size()) - 1; }

// Calls visit(gate, other gate, polygon) for all pairs of gates of polygons [begin, end), the smaller first.
template <class Visit>
void for_pairs_of_gates(const Gates& g, uint32_t begin, uint32_t end, Visit visit) {
    for (uint32_t p = begin; p < end; ++p)
        for (uint32_t i = g.first[p]; i < g.first[p + 1]; ++i)
            for (uint32_t j = i + 1; j < g.first[p + 1]; ++j) visit(g.of[i], g.of[j], p);
}

}  // namespace flaneur
