// Balls as one mesh, in three colours.
#include "sim/balls.h"

#include <algorithm>
#include <array>

#include "assets/colour.h"
#include "sim/base/math.h"
#include "tools/extract/convert.h"
#include "tools/extract/extract.h"
#include "tools/extract/ids.h"
#include "tools/extract/turned.h"

namespace flaneur {

PersonMesh extract_ball() {
    constexpr int k_rings = 12;
    constexpr uint32_t k_leather = rgb(0x8a4b2f), k_band = rgb(0xd9c7a0), k_cap = rgb(0x5d3221);
    PersonMesh mesh;
    mesh.lods.resize(1);
    mesh.is_thing = true;
    std::vector<TurnedRing> rings;
    for (int n = 0; n <= k_rings; ++n) {
        const SinCos at = sin_cos(k_pi * static_cast<float>(n) / k_rings);
        const uint32_t colour = n < 2 || n > k_rings - 2 ? k_cap : n > 4 && n < 8 ? k_band : k_leather;
        rings.push_back({n % k_rings == 0 ? 0 : at.sine, -at.cosine, colour});
    }
    add_turned(mesh, rings, 0);
    return mesh;
}

void add_balls(const Balls& balls, uint32_t mesh, PeopleFrame& frame, float between, uint32_t first_id) {
    for (size_t i = 0; i < balls.all.size(); ++i) {
        const Ball& ball = balls.all[i];
        const Vec3 at = lerp(balls.previous_places[i], ball.place, between);
        const uint32_t id = id_of(IdKind::mover, first_id + static_cast<uint32_t>(i));
        add_rigid(frame, thing_to_draw(frame, mesh, id, at, ball.radius, ball.radius),
                  transform_of(at, ball.turn));
    }
}

}  // namespace flaneur
