// Phones that people have in their hands, as one mesh.
#include <algorithm>
#include <array>

#include "assets/colour.h"
#include "sim/pastimes/handheld.h"
#include "sim/world.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"

namespace flaneur {

PersonMesh extract_phone() {
    constexpr uint32_t k_case = rgb(0x1b1d21), k_screen = rgb(0xa9c3d8);
    PersonMesh mesh;
    mesh.lods.resize(1);
    mesh.is_thing = true;
    // A slab, and the screen before it, whose edges are left dark.
    const Vec3 half = k_phone * 0.5f;
    auto face = [&](Vec3 middle, Vec3 right, Vec3 up, uint32_t colour) {
        const Vec3 normal = normalize_or(cross(right, up), {0, 0, 1});
        const auto first = static_cast<uint32_t>(mesh.vertices.size());
        for (const Vec3 at :
             {middle - right - up, middle + right - up, middle + right + up, middle - right + up}) {
            PersonVertex v{};
            v.position = to_glm(at);
            v.colour = colour;
            v.normal[0] = packed(normal.x), v.normal[1] = packed(normal.y), v.normal[2] = packed(normal.z);
            v.weights[0] = 255;
            v.texture = ~0u;
            mesh.vertices.push_back(v);
        }
        for (const uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.lods[0].push_back(first + k);
    };
    const Vec3 x{half.x, 0, 0}, y{0, half.y, 0}, z{0, 0, half.z};
    face(z, x, y, k_case), face(-z, -x, y, k_case);
    face(x, -z, y, k_case), face(-x, z, y, k_case);
    face(y, x, -z, k_case), face(-y, x, z, k_case);
    face(z * 1.02f, x * 0.9f, y * 0.94f, k_screen);
    return mesh;
}

void add_phones(const World& world, uint32_t mesh, PeopleFrame& frame, float between) {
    for (const Pastime& p : world.pastimes->all) {
        const auto at = phone_of(*world.pastimes, world.gait, p.walker, world.tick,
                                 joint_between(world, p.walker, right_hand, between));
        if (!at) continue;
        constexpr float k_radius = 0.5f * k_phone.y + k_phone.x;
        add_rigid(frame, thing_to_draw(frame, mesh, id_of(IdKind::walker, p.walker), at->position, k_radius),
                  transform_of(at->position, at->rotation));
    }
}

}  // namespace flaneur
