// Rigid moving things as meshes of one joint.
#include "sim/movers/movers.h"

#include <algorithm>
#include <array>
#include <vector>

#include "assets/colour.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"
#include "tools/extract/turned.h"

namespace flaneur {

namespace {

constexpr std::array<uint32_t, k_matter_count> k_colours = {
    rgb(0xa98a63), rgb(0x6f5338), rgb(0xb3ac9e), rgb(0x8b9299), rgb(0xb49f78), rgb(0xb98f5c), rgb(0xb2503c)};
constexpr float k_bevel = 0.012f;  // metres, of edges; less of what is thin

float bevel_of(const MoverSolid& solid) {
    return std::min(k_bevel, 0.3f * std::min({solid.half.x, solid.half.y, solid.half.z}));
}

// A box whose edges are broken: a vertex for each corner and each of the three faces there.
void add_box(PersonMesh& mesh, const MoverSolid& solid, uint32_t colour) {
    const auto first = static_cast<uint32_t>(mesh.vertices.size());
    const float bevel = bevel_of(solid);
    auto sign = [](uint32_t corner, int axis) { return (corner >> axis & 1u) != 0 ? 1.0f : -1.0f; };
    auto number = [&](uint32_t corner, int axis) { return first + 3 * corner + static_cast<uint32_t>(axis); };
    for (uint32_t corner = 0; corner < 8; ++corner)
        for (int axis = 0; axis < 3; ++axis) {
            float at[3] = {solid.half.x, solid.half.y, solid.half.z};
            for (int k = 0; k < 3; ++k) at[k] = sign(corner, k) * (at[k] - (k == axis ? 0 : bevel));
            PersonVertex v{};
            v.position = {at[0], at[1], at[2]};
            v.colour = colour;
            v.normal[axis] = packed(sign(corner, axis));
            v.weights[0] = 255;
            v.texture = ~0u;
            mesh.vertices.push_back(v);
        }
    // Whichever way round is counter-clockwise from outside.
    auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
        auto at = [&](uint32_t index) {
            const glm::vec3 p = mesh.vertices[index].position;
            return Vec3{p.x, p.y, p.z};
        };
        const bool is_outward = dot(cross(at(b) - at(a), at(c) - at(a)), at(a) + at(b) + at(c)) > 0;
        for (const uint32_t index : {a, is_outward ? b : c, is_outward ? c : b})
            mesh.lods[0].push_back(index);
    };
    for (int axis = 0; axis < 3; ++axis) {
        const uint32_t u = 1u << ((axis + 1) % 3), w = 1u << ((axis + 2) % 3), far = 1u << axis;
        for (const uint32_t side : {0u, far}) {
            add(number(side, axis), number(side | u, axis), number(side | u | w, axis));
            add(number(side, axis), number(side | u | w, axis), number(side | w, axis));
        }
        // The edges along this axis, between the faces of the other two.
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (const uint32_t corner : {0u, u, w, u | w}) {
            add(number(corner, a), number(corner, b), number(corner | far, b));
            add(number(corner, a), number(corner | far, b), number(corner | far, a));
        }
    }
    for (uint32_t corner = 0; corner < 8; ++corner)
        add(number(corner, 0), number(corner, 1), number(corner, 2));
}

void add_cylinder(PersonMesh& mesh, const MoverSolid& solid, uint32_t colour) {
    const float r = solid.half.x, h = solid.half.y, bevel = bevel_of(solid);
    const TurnedRing rings[] = {{0, -h, colour},         {r - bevel, -h, colour}, {r - bevel, -h, colour},
                                {r, -h + bevel, colour}, {r, -h + bevel, colour}, {r, h - bevel, colour},
                                {r, h - bevel, colour},  {r - bevel, h, colour},  {r - bevel, h, colour},
                                {0, h, colour}};
    add_turned(mesh, rings, 0);
}

// Turned and set into the thing.
void place(PersonMesh& mesh, size_t first, const MoverSolid& solid) {
    for (size_t i = first; i < mesh.vertices.size(); ++i) {
        PersonVertex& v = mesh.vertices[i];
        const Vec3 at = solid.middle + rotate(solid.turn, {v.position.x, v.position.y, v.position.z});
        v.position = to_glm(at);
        constexpr float k_unit = 1.0f / 127;
        const Vec3 normal =
            rotate(solid.turn, Vec3{static_cast<float>(v.normal[0]), static_cast<float>(v.normal[1]),
                                    static_cast<float>(v.normal[2])} *
                                   k_unit);
        v.normal[0] = packed(normal.x), v.normal[1] = packed(normal.y), v.normal[2] = packed(normal.z);
    }
}

}  // namespace

std::vector<PersonMesh> extract_movers(const Movers& movers) {
    std::vector<PersonMesh> meshes(movers.all.size());
    for (size_t i = 0; i < meshes.size(); ++i) {
        PersonMesh& mesh = meshes[i];
        mesh.lods.resize(1);
        mesh.is_thing = true;
        for (const MoverSolid& solid : movers.all[i].solids) {
            const size_t first = mesh.vertices.size();
            const uint32_t colour = shaded(k_colours[static_cast<size_t>(solid.matter)], solid.shade);
            if (solid.form == MoverSolid::Form::box)
                add_box(mesh, solid, colour);
            else
                add_cylinder(mesh, solid, colour);
            place(mesh, first, solid);
        }
    }
    return meshes;
}

void add_movers(const Movers& movers, uint32_t first_mesh, PeopleFrame& frame, float between) {
    for (size_t i = 0; i < movers.all.size(); ++i) {
        const Placement at = placement_between(movers.previous_places[i], movers.places[i], between);
        const auto number = static_cast<uint32_t>(i);
        add_rigid(frame,
                  thing_to_draw(frame, first_mesh + number, id_of(IdKind::mover, number), at.position,
                                movers.radius[i]),
                  transform_of(at.position, at.turn));
    }
}

}  // namespace flaneur
